"""Cells of a melt, pixels and polygons, by their numbers of neighbours: exact_edges.py PICTURE. Needs matplotlib."""

import sys
from pathlib import Path

import matplotlib
import numpy as np

import vorocl

matplotlib.use("Agg")
from matplotlib import collections, colors, pyplot  # noqa: E402

file = Path(__file__).parents[2] / "samples" / "lj-melt.lammpstrj"
with open(file) as lines:
    head = [next(lines) for _ in range(9)]
    particles = int(head[3])
    points = np.loadtxt(lines, usecols=(2, 3), max_rows=particles)  # of the first frame
(x0, x1), (y0, y1) = (map(float, line.split()) for line in head[5:7])
box, periodic = (x0, y0, x1, y1), (True, True)

cells = vorocl.exact_cells(points, box, periodic=periodic)
pixels_per_length = 5
shape = round((y1 - y0) * pixels_per_length), round((x1 - x0) * pixels_per_length)
labels = vorocl.diagram(points, shape, bounds=box, periodic=periodic, y_up=True)

figure, axis = pyplot.subplots(figsize=(7.6, 5.8), layout="constrained")
numbers = [4, 5, 6, 7, 8]
scale = colors.ListedColormap(["#2c5f8a", "#8fb8d8", "#eeeeee", "#f0b48c", "#b5562b"])
norm = colors.BoundaryNorm(np.arange(3.5, 9), scale.N)
image = cells.cells["neighbours"][labels]
picture = axis.imshow(image, extent=(x0, x1, y0, y1), cmap=scale, norm=norm, interpolation="nearest")
polygons = [cells.polygon(row) for row in range(len(cells))]
axis.add_collection(collections.PolyCollection(polygons, facecolor="none", edgecolor="black", linewidth=1))
axis.plot(*points.T, ".", color="black", markersize=3)
axis.set(xlim=(4, 18), ylim=(4, 14.5), xlabel="x", ylabel="y", aspect="equal")
figure.colorbar(picture, ax=axis, label="neighbours, of the polygons", ticks=numbers, shrink=0.8)
figure.savefig(sys.argv[1], dpi=100)
