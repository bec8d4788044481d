#!/usr/bin/env python3
"""Prints the tables of docs/true_positions.md: exact diagrams of snapped points and of the points themselves, judged by SciPy's
k-d tree in double, and their processor times beside jump flooding, in turn."""
from pathlib import Path
from time import process_time

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
    yield "5,000 cities on 1800 x 900", (cities * (1, -1) + (180, 90)) * 5, (900, 1800)


print("| points | wrong, snapped | farther by | without a pixel | wrong, not snapped | farther by | without a pixel |")
print("| --- | --- | --- | --- | --- | --- | --- |")
for name, points, shape in sets():
    cells = [f"{share:.2f} % | {excess:.4f} px | {empty:,}" for share, excess, empty in (judged(points, shape, s) for s in (True, False))]
    print(f"| {name} | {' | '.join(cells)} |")

SIDE = 2048


def timed_sets():
    rng = numpy.random.default_rng(1)
    for seeds in 64, 1024, 16_384, 65_536, 262_144, 1_048_576:
        yield f"{seeds:,} random points", rng.uniform(0, SIDE, (seeds, 2))
    places = numpy.arange(256) * 8
    yield "65,536 points of a lattice", numpy.stack(numpy.meshgrid(places + 2, places + 6), axis=-1).reshape(-1, 2)
    yield "65,536 random half pixels", rng.integers(0, 2 * SIDE, (65_536, 2)) / 2
    middles = rng.uniform(0.05, 0.95, (50, 2)) * SIDE
    clusters = middles[rng.integers(0, 50, 171_075)] + rng.normal(0, 20, (171_075, 2))
    yield "171,075 points of 50 clusters", numpy.clip(clusters, 0, SIDE - 1)
    angles = rng.uniform(0, 2 * numpy.pi, 65_536)
    yield "65,536 points of a ring", SIDE / 2 + 0.45 * SIDE * numpy.stack([numpy.cos(angles), numpy.sin(angles)], axis=1)
    yield "65,536 points of a vertical line", numpy.stack([numpy.full(65_536, 1000.5), rng.uniform(0, SIDE, 65_536)], axis=1)
    yield "65,536 points in one pixel", 1000 + rng.uniform(0, 1, (65_536, 2))


def least_milliseconds(points, rounds=11):
    """The processor's, of all threads, for exact diagrams of the points themselves and of snapped ones, and of JFA."""
    runs = [(vorocl.Seeds(points, (SIDE, SIDE), snap=snap), method) for snap, method in ((False, "exact"), (True, "exact"), (True, "jfa"))]
    diagram = vorocl.Diagram((SIDE, SIDE))
    least = [float("inf")] * len(runs)
    for turn in range(rounds + 1):
        for i, (seeds, method) in enumerate(runs):
            begin = process_time()
            diagram.fill(seeds, method).milliseconds
            if turn > 0:
                least[i] = min(least[i], 1000 * (process_time() - begin))
    return least


print("\n| ms | not snapped | snapped | JFA | not snapped / snapped |")
print("| --- | --- | --- | --- | --- |")
for name, points in timed_sets():
    themselves, snapped, flooded = least_milliseconds(points)
    print(f"| {name} | {themselves:.1f} | {snapped:.1f} | {flooded:.0f} | {themselves / snapped:.2f} |", flush=True)
