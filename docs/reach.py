#!/usr/bin/env python3
"""Draws the seeds that a tile needs (reach.png): those inside it, and those outside that own pixels of it. Found by
brute force, with another method than the library's. Needs NumPy and matplotlib."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

side, tiles = 512, 4
rng = np.random.default_rng(4)
uniform = rng.uniform(0, side, (120, 2))
angle, radius = rng.uniform(0, 2 * np.pi, 900), 60 * np.sqrt(rng.uniform(0, 1, 900))
disc = np.column_stack([400 + radius * np.cos(angle), 130 + radius * np.sin(angle)])
scenes = {"seeds everywhere": (uniform, (1, 1)), "all seeds in a disc": (disc, (0, 2))}

figure, axes = plt.subplots(1, len(scenes), figsize=(9, 4.4), dpi=110)
for axis, (title, (seeds, (column, row))) in zip(axes, scenes.items()):
    y, x = np.mgrid[0:side, 0:side]
    nearest = np.full((side, side), np.inf)
    labels = np.zeros((side, side), int)
    for number, (seed_x, seed_y) in enumerate(seeds):
        distance = (x - np.floor(seed_x)) ** 2 + (y - np.floor(seed_y)) ** 2
        labels[distance < nearest] = number
        nearest = np.minimum(nearest, distance)
    step = side // tiles
    left, top = column * step, row * step
    owners = np.unique(labels[top : top + step, left : left + step])
    inside = (seeds[:, 0] >= left) & (seeds[:, 0] < left + step) & (seeds[:, 1] >= top) & (seeds[:, 1] < top + step)
    needed = np.isin(np.arange(len(seeds)), owners) & ~inside
    borders = (labels != np.roll(labels, 1, 0)) | (labels != np.roll(labels, 1, 1))
    axis.imshow(np.where(borders, 0.85, 1), cmap="gray", vmin=0, vmax=1)
    for line in range(step, side, step):
        axis.axhline(line, color="0.6", lw=0.6)
        axis.axvline(line, color="0.6", lw=0.6)
    axis.add_patch(plt.Rectangle((left, top), step, step, fc="#0072b222", ec="#0072b2", lw=1.5))
    others = ~inside & ~needed
    axis.plot(*seeds[others].T, ".", color="0.5", ms=2.5, label=f"other seeds: {others.sum()}")
    axis.plot(*seeds[inside].T, ".", color="#0072b2", ms=6, label=f"in the tile: {inside.sum()}")
    axis.plot(*seeds[needed].T, ".", color="#d55e00", ms=6, label=f"outside, but own pixels of it: {needed.sum()}")
    axis.set(title=title, xticks=[], yticks=[], xlim=(0, side), ylim=(side, 0))
    axis.legend(loc="lower right", fontsize=7)
figure.tight_layout()
figure.savefig("reach.png")
