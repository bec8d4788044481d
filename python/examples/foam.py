"""The bubbles of a foam, of a table of spheres of several sizes: foam.py PICTURE. Needs SciPy and matplotlib."""

import sys
import time

import matplotlib
import numpy as np
from scipy.spatial import cKDTree

import vorocl

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

EDGE, BUBBLES, FILLED = 10.0, 3000, 0.62  # millimetres, and how much of the volume is in bubbles

# What a tomograph or another program would bring: bubbles that have pushed each other apart in a periodic box.
rng = np.random.default_rng(4)
radii = rng.lognormal(0, 0.35, BUBBLES)
radii *= (FILLED * EDGE**3 * 3 / (4 * np.pi) / np.sum(radii**3)) ** (1 / 3)
centres = rng.uniform(0, EDGE, (BUBBLES, 3))
for _ in range(300):
    pairs = cKDTree(centres, boxsize=EDGE).query_pairs(2 * radii.max(), output_type="ndarray")
    way = centres[pairs[:, 0]] - centres[pairs[:, 1]]
    way -= EDGE * np.round(way / EDGE)
    length = np.linalg.norm(way, axis=1)
    push = way * (0.5 * np.maximum(radii[pairs].sum(axis=1) / length - 1, 0))[:, None]
    for sign, column in (1, 0), (-1, 1):
        for axis in range(3):
            centres[:, axis] += np.bincount(pairs[:, column], sign * 0.5 * push[:, axis], BUBBLES)
    centres %= EDGE

box = dict(periodic=(True, True, True), weights=radii**2)  # weights of squared radii: planes through where spheres meet
start = time.perf_counter()
cells = vorocl.exact_cells(centres, (0, 0, 0, EDGE, EDGE, EDGE), **box).cells
seconds = time.perf_counter() - start
share = 4 / 3 * np.pi * radii**3 / cells["volume"]
print(f"{BUBBLES} cells in {seconds:.2f} s, with {cells['neighbours'].mean():.2f} neighbours each")
print(f"bubbles fill {share.mean():.3f} of their cells, with a standard deviation of {share.std():.3f}")

# The cells on a plane are a diagram of the plane: a squared distance is that in the plane and that to the plane.
away = (centres[:, 2] + EDGE / 2) % EDGE - EDGE / 2  # from the plane z = 0, the shorter way round
plane = vorocl.Grid((900, 900), bounds=(0, 0, EDGE, EDGE), periodic=(True, True), y_up=True)
labels = vorocl.diagram(centres[:, :2], plane, weights=radii**2 - away**2)

figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 5), layout="constrained")
limits = dict(vmin=0.4, vmax=0.8, cmap="viridis")
picture = left.imshow(share[labels], extent=(0, EDGE, 0, EDGE), **limits)
borders = (labels != np.roll(labels, 1, 0)) | (labels != np.roll(labels, 1, 1))
left.imshow(np.ma.array(borders, mask=~borders), extent=(0, EDGE, 0, EDGE), cmap="gray_r", vmin=0)
for centre, radius in zip(centres[:, :2], np.sqrt(np.maximum(radii**2 - away**2, 0))):
    left.add_patch(pyplot.Circle(centre, radius, fill=False, color="white", linewidth=0.6))
left.set(xlim=(0, EDGE), ylim=(0, EDGE), xticks=[], yticks=[])
figure.colorbar(picture, ax=left, label="share of the cell that the bubble fills")
right.scatter(radii, cells["neighbours"] + rng.uniform(-0.3, 0.3, BUBBLES), c=share, s=6, **limits)
right.set(xlabel="radius, mm", ylabel="neighbours", xscale="log")
figure.savefig(sys.argv[1], dpi=100)
