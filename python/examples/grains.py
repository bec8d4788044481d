"""A periodic polycrystal, of a table of grains' centres and sizes, cut open: grains.py PICTURE. Needs matplotlib.

The table, grains.csv, and the voxels for ParaView, grains.vti, are written beside the picture.
"""

import sys
import time
from pathlib import Path

import numpy as np
from matplotlib import image

import vorocl

SIDE, GRAINS, EDGE = 256, 2000, 50.0  # voxels along a side; micrometres

# What another program would bring: rows of x, y, z and the radius of a sphere of the grain's volume.
picture = Path(sys.argv[1])
rng = np.random.default_rng(3)
radii = rng.lognormal(0, 0.35, GRAINS)
radii *= EDGE * (3 / (4 * np.pi) / (radii**3).sum()) ** (1 / 3)
table = np.column_stack((rng.uniform(0, EDGE, (GRAINS, 3)), radii))
np.savetxt(picture.with_name("grains.csv"), table, delimiter=",", header="x,y,z,radius", comments="", fmt="%.6f")

grains = np.loadtxt(picture.with_name("grains.csv"), delimiter=",", skiprows=1)
box = dict(bounds=(0, 0, 0, EDGE, EDGE, EDGE), periodic=(True, True, True), weights=grains[:, 3] ** 2)
start = time.perf_counter()
labels = vorocl.diagram(grains[:, :3], (SIDE,) * 3, **box)  # (z, y, x): the rows of the table
seconds = time.perf_counter() - start
volumes = np.bincount(labels.ravel(), minlength=GRAINS) * (EDGE / SIDE) ** 3
print(f"{SIDE}^3 voxels of {GRAINS} grains in {seconds:.2f} s; {np.sum(volumes == 0)} grains have none, and volumes")
print(f"follow the table's with a correlation of {np.corrcoef(volumes, grains[:, 3] ** 3)[0, 1]:.3f}")

# The voxels of an image of VTK's lie behind its header as they lie in memory.
with picture.with_name("grains.vti").open("wb") as file:
    extent = f"0 {SIDE} 0 {SIDE} 0 {SIDE}"
    file.write(f"""<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<ImageData WholeExtent="{extent}" Origin="0 0 0" Spacing="{EDGE / SIDE} {EDGE / SIDE} {EDGE / SIDE}">
<Piece Extent="{extent}"><CellData Scalars="grain">
<DataArray type="UInt32" Name="grain" format="appended" offset="0"/>
</CellData></Piece></ImageData>
<AppendedData encoding="raw">
_""".encode())
    file.write(np.uint64(labels.nbytes).tobytes() + labels.astype("<u4").tobytes())
    file.write(b"\n</AppendedData>\n</VTKFile>\n")

# Rays from the corner (1, 1, 1) on, until they meet what is left of the cube without the octant at that corner.
size, zoom = 3 * SIDE, 0.6
column, row = (np.mgrid[:size, :size][::-1] - size / 2) * zoom
right, up = np.array((-1, 1, 0)) / 2**0.5, np.array((-1, -1, 2)) / 6**0.5
start = SIDE / 2 + column[..., None] * right - row[..., None] * up
way = np.full((size, size), np.inf)  # towards the corner
face, is_inner = np.full((size, size), -1), np.zeros((size, size), bool)
for axis in range(3):
    for at in (SIDE / 2, SIDE):
        along = (at - start[..., axis]) * 3**0.5
        meets = start + along[..., None] / 3**0.5
        others = np.delete(meets, axis, axis=-1)
        is_beyond = (others > SIDE / 2).all(axis=-1)
        is_there = ((others >= 0) & (others < SIDE)).all(axis=-1) & (is_beyond == (at < SIDE))
        way[is_there], face[is_there], is_inner[is_there] = along[is_there], axis, at < SIDE
voxel = np.clip(np.where(np.isfinite(way), way, 0)[..., None] / 3**0.5 + start - 1e-6, 0, SIDE - 1).astype(int)
grain = np.where(face < 0, -1, labels[voxel[..., 2], voxel[..., 1], voxel[..., 0]].astype(int))
colours = np.vstack((rng.uniform(0.25, 0.95, (GRAINS, 3)), (1, 1, 1)))[grain]
colours *= (np.array((0.72, 0.86, 1.0, 1.0))[face] * np.where(is_inner, 0.8, 1))[..., None]  # light from above
edge = (grain != np.roll(grain, 1, 0)) | (grain != np.roll(grain, 1, 1)) | (face != np.roll(face, 1, 1))
image.imsave(picture, np.where(edge[..., None], 0.05, colours))
