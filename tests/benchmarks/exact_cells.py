#!/usr/bin/env python3
"""Times exact cells beside SciPy's and Shapely's Voronoi diagrams, of uniform and clustered points and of a lattice.

Needs the packages vorocl, scipy and shapely. Programs are interleaved; the least of some runs is printed, and the least
processor time, which other work on the machine changes less.
"""

import argparse
import time

import numpy as np
import shapely
from scipy.spatial import Voronoi

import vorocl

SIDE = 2.0**20


def uniform(count, random):
    return random.uniform(0, SIDE, (count, 2))


def clusters(count, random):
    points = SIDE * (random.choice([[0.2, 0.3], [0.7, 0.25], [0.5, 0.6]], count) + 0.02 * random.standard_normal((count, 2)))
    return np.clip(points, 0, SIDE - 1)


def lattice(count, random):
    side = int(count**0.5)
    step = SIDE // side
    return np.stack(np.meshgrid(np.arange(side), np.arange(side)), -1).reshape(-1, 2) * step + step / 2


WORK = {
    "vorocl": lambda points: vorocl.exact_cells(points, (0, 0, SIDE, SIDE)),
    "vorocl, periodic": lambda points: vorocl.exact_cells(points, (0, 0, SIDE, SIDE), periodic=(True, True)),
    "SciPy": Voronoi,
    "Shapely": lambda points: shapely.voronoi_polygons(shapely.multipoints(points)),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, nargs="+", default=[10_000, 100_000])
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    print("| points | program | ms | processor ms |\n| --- | --- | --- | --- |")
    for count in options.points:
        for make in uniform, clusters, lattice:
            points = make(count, np.random.default_rng(1))
            least = {name: [float("inf")] * 2 for name in WORK}
            for _ in range(options.repeat):
                for name, work in WORK.items():
                    wall, processor = time.perf_counter(), time.process_time()
                    work(points)
                    taken = time.perf_counter() - wall, time.process_time() - processor
                    least[name] = [1000 * new if 1000 * new < old else old for new, old in zip(taken, least[name])]
            for name, (wall, processor) in least.items():
                print(f"| {len(points):,} {make.__name__} | {name} | {wall:.0f} | {processor:.0f} |", flush=True)


main()
