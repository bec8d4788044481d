"""The cells of 5,000 of the world's cities on the globe, and how far it is to the next one: globe.py PICTURE. Needs matplotlib."""

import sys
from pathlib import Path

import matplotlib
import numpy as np

import vorocl

matplotlib.use("Agg")
from matplotlib import colors, pyplot  # noqa: E402

cities = np.loadtxt(Path(__file__).parents[2] / "samples" / "cities-5000.csv", delimiter=",", skiprows=1)
world = vorocl.Grid((1800, 3600), bounds=(-180, -90, 180, 90), y_up=True)
labels = vorocl.diagram(cities, world, metric="great-circle")
kilometres = vorocl.distances(cities, world, metric="great-circle")


def seen_from(longitude, latitude, image, size=900):
    """What of a map is seen of the globe from far above a place; masked beside it."""
    lon, lat = np.radians((longitude, latitude))
    y, x = np.mgrid[1 : -1 : size * 1j, -1 : 1 : size * 1j]
    beside = x**2 + y**2 >= 1
    up = np.sqrt(np.where(beside, 0, 1 - x**2 - y**2))
    north = np.arcsin(y * np.cos(lat) + up * np.sin(lat))
    east = lon + np.arctan2(x, up * np.cos(lat) - y * np.sin(lat))
    rows = np.clip((0.5 - north / np.pi) * image.shape[0], 0, image.shape[0] - 1).astype(int)
    columns = ((east / (2 * np.pi) + 0.5) * image.shape[1]).astype(int) % image.shape[1]
    return np.ma.array(image[rows, columns], mask=beside)


figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 5), layout="constrained")
seen = seen_from(10, 40, labels)
shuffled = np.random.default_rng(2).permutation(len(cities))
left.imshow(np.ma.array(shuffled[seen.data], mask=seen.mask), cmap="terrain")
borders = (np.diff(seen.data, axis=1, append=0) != 0) | (np.diff(seen.data, axis=0, append=0) != 0)
left.imshow(np.ma.array(borders, mask=seen.mask | ~borders), cmap="gray_r", vmin=0)
picture = right.imshow(seen_from(-150, -20, kilometres), cmap="magma", norm=colors.AsinhNorm(100))
figure.colorbar(picture, ax=right, label="km to the next city", ticks=[0, 100, 200, 500, 1000, 2000], format="%d")
for axis in left, right:
    axis.set_axis_off()
figure.savefig(sys.argv[1], dpi=100)
