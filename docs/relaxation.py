#!/usr/bin/env python3
"""Prints the table of docs/relaxation.md: how even cells are after rounds of Lloyd relaxation on pixels and on polygons, which
SciPy cuts: relaxation.py [ROUNDS]. Needs NumPy and SciPy."""
import sys

import numpy
from scipy.spatial import Voronoi

import vorocl

SEEDS = 3000


def polygons(points):
    """The corners, row after row, of the cells in the unit square, and where each begins: mirrored points make its sides."""
    mirrored = [points]
    for axis in 0, 1:
        for side in 0, 2:
            image = points.copy()
            image[:, axis] = side - image[:, axis]
            mirrored.append(image)
    diagram = Voronoi(numpy.concatenate(mirrored))
    cells = [diagram.regions[region] for region in diagram.point_region[: len(points)]]
    lengths = numpy.array([len(cell) for cell in cells])
    return diagram.vertices[numpy.concatenate(cells)], numpy.cumsum(lengths) - lengths


def areas_and_centroids(points):
    """Of the cells in the unit square: sums over the triangles between each edge and the point."""
    corners, begins = polygons(points)
    owner = numpy.repeat(numpy.arange(len(points)), numpy.diff(numpy.append(begins, len(corners))))
    following = numpy.arange(1, len(corners) + 1)
    following[numpy.append(begins[1:], len(corners)) - 1] = begins
    a, b = corners - points[owner], (corners - points[owner])[following]
    doubled = abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    sums = numpy.add.reduceat(doubled[:, None] * (a + b), begins)
    area = numpy.add.reduceat(doubled, begins)
    return area / 2, points + sums / (3 * area[:, None])


def deviation(points):
    """Of the areas of the cells in the unit square, in percent of their mean."""
    area, _ = areas_and_centroids(points)
    return 100 * area.std() / area.mean()


rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 100
start = numpy.random.default_rng(1).uniform(0, 1, (SEEDS, 2))
points = start
for _ in range(rounds):
    _, points = areas_and_centroids(points)
exact = deviation(points)
print(f"{SEEDS} random points, {rounds} rounds: deviation of area {deviation(start):.2f} %, then {exact:.2f} % on polygons\n")
found = deviation(vorocl.relax(start, (300, 300), rounds=rounds, bounds=(0, 0, 1, 1), exact=True).points)
print(f"relax(exact=True): {found:.2f} %\n")
print("| pixels | themselves | / polygons | snapped | / polygons |")
print("| --- | --- | --- | --- | --- |")
for side in 300, 600, 1200, 2400:
    cells = []
    for snap in False, True:
        relaxed = vorocl.relax(start, (side, side), rounds=rounds, bounds=(0, 0, 1, 1), snap=snap)
        found = deviation(relaxed.points)
        cells.append(f"{found:.2f} %{f' (ended after {len(relaxed.moved)})' if relaxed.converged else ''} | {found / exact:.2f}")
    print(f"| {side} x {side} | {' | '.join(cells)} |")
