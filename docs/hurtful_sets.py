#!/usr/bin/env python3
"""Writes sets of seeds that hurt an exact engine, on 2048 x 2048 pixels, as .npy files into a folder.

docs/performance.md measures them with `vorocl bench --points SET.npy --size 2048x2048 --bounds 0,0,2048,2048`.
"""
import sys

import numpy

N = 2048


def sets():
    rng = numpy.random.default_rng(1)
    x, y = (axis.ravel() for axis in numpy.meshgrid(numpy.arange(N), numpy.arange(N)))
    turn = numpy.linspace(0, 2 * numpy.pi, 100_000, endpoint=False)
    middles = rng.uniform(0.15, 0.85, (5, 2)) * N
    clusters = middles[rng.integers(0, 5, 16384)] + rng.normal(0, N / 100, (16384, 2))

    def where(condition):
        return numpy.stack([x[condition], y[condition]], axis=1)

    yield "every-pixel", where(x >= 0)
    yield "checkerboard", where((x + y) % 2 == 0)
    yield "horizontal-line", where(y == N // 3)
    yield "vertical-line", where(x == N // 3)
    yield "diagonal-line", where(x == y)
    yield "ring", N / 2 + 0.45 * N * numpy.stack([numpy.cos(turn), numpy.sin(turn)], axis=1)
    yield "corner", rng.uniform(0, N / 16, (16384, 2))
    yield "five-clusters", numpy.clip(clusters, 0, N - 1)
    yield "two-blocks", where(((x < N // 4) & (y < N // 4)) | ((x >= N - N // 4) & (y >= N - N // 4)))
    yield "nine-pixels", rng.integers(0, 3, (100_000, 2)) * (N // 3) + 100
    yield "blocks-of-64", where((x // 64 + y // 64) % 2 == 0)
    yield "half-full-blocks-of-32", where(((x // 32 + y // 32) % 2 == 0) & (rng.random(x.size) < 0.5))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: hurtful_sets.py FOLDER")
    for name, points in sets():
        numpy.save(f"{sys.argv[1]}/{name}.npy", numpy.floor(points.astype(float)) + 0.5)
