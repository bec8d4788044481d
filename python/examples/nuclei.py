"""Nuclei in a stack of a microscope, grown by 2.5 micrometres: nuclei.py PICTURE. Needs matplotlib."""

import sys
import time

import matplotlib
import numpy as np

import vorocl

matplotlib.use("Agg")
from matplotlib import colors, pyplot  # noqa: E402

SPACING = np.array((0.5, 0.2, 0.2))  # micrometres between slices, rows and columns
SHAPE, NUCLEI, REACH = (60, 512, 512), 430, 2.5

# What a segmentation would bring: the number of its nucleus at each voxel, 0 beside them.
rng = np.random.default_rng(6)
nuclei = np.zeros(SHAPE, np.uint16)
sides = SPACING * SHAPE
centres = rng.uniform(0.04, 0.96, (20000, 3)) * sides
taken = []
for centre in centres:
    if len(taken) < NUCLEI and all(np.linalg.norm(centre - other) > 6.8 for other in taken):
        taken.append(centre)
for number, centre in enumerate(taken, 1):
    axes = np.linalg.qr(rng.standard_normal((3, 3)))[0] / rng.uniform(2.2, 3.6, 3)[:, None]
    first = np.maximum((centre - 4) / SPACING, 0).astype(int)
    box = tuple(slice(at, at + round(8 / step) + 1) for at, step in zip(first, SPACING))
    z, y, x = np.indices(nuclei[box].shape)
    way = (np.stack((z, y, x), -1) + first + 0.5) * SPACING - centre
    nuclei[box][np.sum((way @ axes.T) ** 2, axis=-1) < 1] = number

start = time.perf_counter()
cells = vorocl.expand_labels(nuclei, distance=REACH, spacing=SPACING)
seconds = time.perf_counter() - start
voxel = SPACING.prod()
of_nuclei, of_cells = (np.bincount(labels.ravel())[1:] * voxel for labels in (nuclei, cells))
print(f"{len(taken)} nuclei of {np.median(of_nuclei):.0f} cubic micrometres in the median, {len(taken)} cells of")
print(f"{np.median(of_cells):.0f}, in {SHAPE[0]} slices of {SHAPE[1]} x {SHAPE[2]} voxels: {seconds:.2f} s")

colour = colors.ListedColormap(np.vstack(((0, 0, 0), rng.uniform(0.35, 1, (len(taken), 3)))))
figure, panels = pyplot.subplots(2, 1, figsize=(6.6, 7.6), height_ratios=(sides[1], sides[0]), layout="constrained")
for panel, at, aspect, title in zip(
    panels, (np.s_[SHAPE[0] // 2], np.s_[:, SHAPE[1] // 2]), (1, SPACING[0] / SPACING[2]), ("x, y", "x, z")
):
    inside = np.where(nuclei[at] > 0, 1.0, 0.55)[..., None]
    picture = colour(cells[at])[..., :3] * inside
    panel.imshow(picture, aspect=aspect, interpolation="nearest")
    panel.set(title=title, xticks=[], yticks=[])
figure.savefig(sys.argv[1], dpi=100)
