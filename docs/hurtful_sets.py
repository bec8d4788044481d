#!/usr/bin/env python3
"""Writes sets of seeds that hurt an exact engine, on N x N pixels, as .npy files into a folder: FOLDER [N=2048].

docs/performance.md measures them with `vorocl bench --points SET.npy --size 2048x2048 --bounds 0,0,2048,2048`.
"""
import os
import sys

import numpy


def sets(side):
    rng = numpy.random.default_rng(1)
    x, y = (axis.ravel() for axis in numpy.meshgrid(numpy.arange(side), numpy.arange(side)))
    turn = numpy.linspace(0, 2 * numpy.pi, 100_000, endpoint=False)
    middles = rng.uniform(0.15, 0.85, (5, 2)) * side
    clusters = middles[rng.integers(0, 5, 16384)] + rng.normal(0, side / 100, (16384, 2))

    def where(condition):
        return numpy.stack([x[condition], y[condition]], axis=1)

    yield "every-pixel", where(x >= 0)
    yield "checkerboard", where((x + y) % 2 == 0)
    yield "horizontal-line", where(y == side // 3)
    yield "vertical-line", where(x == side // 3)
    yield "diagonal-line", where(x == y)
    yield "ring", side / 2 + 0.45 * side * numpy.stack([numpy.cos(turn), numpy.sin(turn)], axis=1)
    yield "corner", rng.uniform(0, side / 16, (16384, 2))
    yield "five-clusters", numpy.clip(clusters, 0, side - 1)
    yield "two-blocks", where(((x < side // 4) & (y < side // 4)) | ((x >= side - side // 4) & (y >= side - side // 4)))
    yield "nine-pixels", rng.integers(0, 3, (100_000, 2)) * (side // 3) + side // 20
    yield "blocks-of-64", where((x // 64 + y // 64) % 2 == 0)
    yield "half-full-blocks-of-32", where(((x // 32 + y // 32) % 2 == 0) & (rng.random(x.size) < 0.5))


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: hurtful_sets.py FOLDER [N]")
    os.makedirs(sys.argv[1], exist_ok=True)
    for name, points in sets(int((sys.argv + ["2048"])[2])):
        numpy.save(f"{sys.argv[1]}/{name}.npy", numpy.floor(points.astype(float)) + 0.5)
