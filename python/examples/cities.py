"""How far it is to the next of 5,000 cities: cities.py PICTURE. Needs matplotlib."""

import sys
from pathlib import Path

import matplotlib
import numpy as np

import vorocl

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

file = Path(__file__).parents[2] / "samples" / "cities-5000.csv"
points = np.loadtxt(file, delimiter=",", skiprows=1)  # x = longitude + 180, y = 90 - latitude
plane = dict(shape=(720, 1440), bounds=(0, 0, 360, 180), periodic=(True, False))
degrees = vorocl.distances(points, **plane) / 4
labels = vorocl.diagram(points, **plane)

figure, axis = pyplot.subplots(figsize=(10, 4.6), layout="constrained")
picture = axis.imshow(degrees, extent=(-180, 180, -90, 90), cmap="magma", norm="asinh")
borders = (np.diff(labels, axis=1, prepend=labels[:, -1:]) != 0) | (np.diff(labels, axis=0, prepend=labels[:1]) != 0)
axis.imshow(np.ma.masked_equal(borders, 0), extent=(-180, 180, -90, 90), cmap="gray_r", alpha=0.25, vmin=0)
axis.plot(points[:, 0] - 180, 90 - points[:, 1], ",", color="white", alpha=0.5)
axis.set(xlabel="longitude", ylabel="latitude")
figure.colorbar(picture, ax=axis, label="degrees of the map to the next city")
figure.savefig(sys.argv[1], dpi=100)
