"""The cells of a Lennard-Jones melt, cut open: melt.py PICTURE. Needs matplotlib."""

import sys
from pathlib import Path

import matplotlib
import numpy as np

import vorocl

matplotlib.use("Agg")
from matplotlib import colormaps, pyplot  # noqa: E402

SIDE = 128  # voxels

lines = (Path(__file__).parents[2] / "samples" / "lj-melt-3d.lammpstrj").read_text().splitlines()
period = float(lines[5].split()[1])
rows = np.array([line.split() for line in lines[9 : 9 + int(lines[3])]], float)
labels = vorocl.diagram(rows[:, 2:] * SIDE / period, (SIDE,) * 3, periodic=(True, True, True))

volumes = np.bincount(labels.ravel(), minlength=len(rows)) * (period / SIDE) ** 3
low, high = np.percentile(volumes, (2, 98))
colours = colormaps["viridis"]((volumes - low) / (high - low))[:, :3]


def slice_across(axis, at):
    """A slice of the cube: the places of its pixels' corners, and their colours, with black between cells."""
    cells = np.take(labels, at - 1, axis=2 - axis)  # its rows and columns are along the other axes, the last one first
    border = np.zeros(cells.shape, bool)
    border[1:] |= cells[1:] != cells[:-1]
    border[:, 1:] |= cells[:, 1:] != cells[:, :-1]
    shade = (0.72, 0.86, 1.0)[axis]  # light from above
    along_columns, along_rows = np.meshgrid(np.arange(SIDE + 1), np.arange(SIDE + 1))
    places = [along_columns, along_rows]
    places.insert(axis, np.full_like(along_rows, at))
    return places, np.where(border[..., None], 0.05, colours[cells] * shade)


figure = pyplot.figure(figsize=(8, 6.5), layout="constrained")
axes = figure.add_subplot(projection="3d", proj_type="ortho", computed_zorder=False)
first_half, second_half = slice(0, SIDE // 2), slice(SIDE // 2, SIDE)
whole = [(first_half, first_half), (first_half, second_half), (second_half, first_half)]
for axis in range(3):
    # Behind the corner that is cut away, and outside, without that corner.
    for at, parts in ((SIDE // 2, [(second_half, second_half)]), (SIDE, whole)):
        places, colour = slice_across(axis, at)
        for rows_of, columns_of in parts:
            corners = slice(rows_of.start, rows_of.stop + 1), slice(columns_of.start, columns_of.stop + 1)
            x, y, z = (place[corners] for place in places)
            axes.plot_surface(x, y, z, facecolors=colour[rows_of, columns_of], rstride=1, cstride=1, shade=False)
axes.view_init(elev=28, azim=40)
axes.set_box_aspect((1, 1, 1), zoom=1.15)
axes.set_axis_off()
scale = pyplot.cm.ScalarMappable(pyplot.Normalize(low, high), "viridis")
figure.colorbar(scale, ax=axes, shrink=0.6, label="volume of the particle's cell")
figure.savefig(sys.argv[1], dpi=80)
