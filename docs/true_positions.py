#!/usr/bin/env python3
"""Prints the table of docs/true_positions.md: exact diagrams of snapped points and of the points themselves, judged by SciPy's
k-d tree in double."""
from pathlib import Path

import numpy
from scipy.spatial import cKDTree

import vorocl


def judged(points, shape, snap):
    """The share of pixels whose label is not the nearest point, by how much it is farther at most, and points without a pixel."""
    labels = vorocl.diagram(points, shape, snap=snap).ravel()
    rows, columns = numpy.indices(shape)
    centres = numpy.column_stack([columns.ravel(), rows.ravel()]) + 0.5
    least, _ = cKDTree(points).query(centres)
    excess = numpy.linalg.norm(centres - points[labels], axis=1) - least
    is_wrong = excess > 2**-11  # what rounding to 1/4096 pixel can do
    return 100 * is_wrong.mean(), excess.max(), len(points) - len(numpy.unique(labels))


def sets():
    rng = numpy.random.default_rng(1)
    shape = 1024, 1024
    for seeds in 300, 16_384, 262_144:
        yield f"{seeds:,} random points, {1024 * 1024 // seeds:,} pixels each", rng.uniform(0, 1024, (seeds, 2)), shape
    table = Path(__file__).parents[1] / "samples" / "cities-5000.csv"
    cities = numpy.genfromtxt(table, delimiter=",", skip_header=1, usecols=(0, 1))
    yield "5,000 cities on 1800 x 900", cities * 5, (900, 1800)


print("| points | wrong, snapped | farther by | without a pixel | wrong, themselves | farther by | without a pixel |")
print("| --- | --- | --- | --- | --- | --- | --- |")
for name, points, shape in sets():
    cells = [f"{share:.2f} % | {excess:.4f} px | {empty:,}" for share, excess, empty in (judged(points, shape, s) for s in (True, False))]
    print(f"| {name} | {' | '.join(cells)} |")
