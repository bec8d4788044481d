"""Coordination numbers and volumes in a Lennard-Jones melt, exact and by voxels: coordination.py PICTURE. Needs matplotlib."""

import sys
from pathlib import Path

import matplotlib
import numpy as np

import vorocl

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

SIDES = (32, 64, 128, 192)  # voxels

lines = (Path(__file__).parents[2] / "samples" / "lj-melt-3d.lammpstrj").read_text().splitlines()
period = float(lines[5].split()[1])
points = np.array([line.split() for line in lines[9 : 9 + int(lines[3])]], float)[:, 2:]
box = dict(bounds=(0, 0, 0, period, period, period), periodic=(True, True, True))

exact = vorocl.exact_cells(points, **box).cells
numbers, counts = np.unique(exact["neighbours"], return_counts=True)
print(f"{len(points)} particles: {exact['neighbours'].mean():.3f} neighbours, volumes sum to {exact['volume'].sum():.9g}")

right, errors = [], []
for side in SIDES:
    voxels = vorocl.cells(points, (side,) * 3, units="pixels", **box)
    volumes = voxels["area"] * (period / side) ** 3
    right.append(100 * np.mean(voxels["neighbours"] == exact["neighbours"]))
    errors.append(100 * np.sqrt(np.mean((volumes - exact["volume"]) ** 2)) / exact["volume"].mean())
    print(f"{side}^3 voxels: {right[-1]:.0f} % of the coordination numbers are right, volumes are off by {errors[-1]:.2f} %")

figure, (left, middle) = pyplot.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
left.bar(numbers, counts, color="0.3", label="exact")
left.step(*np.unique(voxels["neighbours"], return_counts=True), where="mid", color="tab:orange", label=f"{side}^3 voxels")
left.set(xlabel="neighbours", ylabel="particles")
left.legend()
middle.plot(SIDES, right, "o-", label="coordination numbers that are right, %")
middle.plot(SIDES, errors, "s-", label="error of a volume, %")
middle.set(xlabel="voxels along a side", ylim=(0, 100))
middle.legend()
figure.savefig(sys.argv[1], dpi=80)
