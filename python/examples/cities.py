"""How far it is to the next of the world's 5,000 largest cities, in Europe: cities.py PICTURE. Needs matplotlib."""

import sys
from pathlib import Path

import matplotlib
import numpy as np

import vorocl

matplotlib.use("Agg")
from matplotlib import colors, pyplot  # noqa: E402

EARTH_RADIUS = 6371.0  # km
CENTRE = np.radians((10, 52))  # longitude and latitude: those of the EU's maps, EPSG:3035


def project(longitude, latitude):
    """Kilometres on a plane that touches the earth at the centre: Lambert's azimuthal equal-area projection."""
    longitude, latitude = np.radians(longitude) - CENTRE[0], np.radians(latitude)
    cosine = np.sin(CENTRE[1]) * np.sin(latitude) + np.cos(CENTRE[1]) * np.cos(latitude) * np.cos(longitude)
    scale = EARTH_RADIUS * np.sqrt(2 / (1 + cosine))
    x = np.cos(latitude) * np.sin(longitude)
    y = np.cos(CENTRE[1]) * np.sin(latitude) - np.sin(CENTRE[1]) * np.cos(latitude) * np.cos(longitude)
    return np.column_stack([scale * x, scale * y])


file = Path(__file__).parents[2] / "samples" / "cities-5000.csv"
x, y = np.loadtxt(file, delimiter=",", skiprows=1).T  # x = longitude + 180, y = 90 - latitude
points = project(x - 180, 90 - y)
bounds = (-1600, -1400, 1600, 1400)
# Far cities are stretched, and so far away that they are nobody's next here.
points = points[np.abs(points).max(axis=1) < 4000]
plane = vorocl.Grid((700, 800), bounds=bounds, y_up=True)
kilometres = vorocl.distances(points, plane)
labels = vorocl.diagram(points, plane)

figure, axis = pyplot.subplots(figsize=(7.6, 6), layout="constrained")
extent = (bounds[0], bounds[2], bounds[1], bounds[3])
picture = axis.imshow(kilometres, extent=extent, cmap="magma", norm=colors.AsinhNorm(50))
borders = (np.diff(labels, axis=1, prepend=labels[:, :1]) != 0) | (np.diff(labels, axis=0, prepend=labels[:1]) != 0)
axis.imshow(np.ma.masked_equal(borders, 0), extent=extent, cmap="gray_r", alpha=0.25, vmin=0)
axis.plot(*points.T, ",", color="white", alpha=0.7)
axis.set(xlabel="km east of 10° E, 52° N", ylabel="km north of it", xlim=extent[:2], ylim=extent[2:])
figure.colorbar(picture, ax=axis, label="km to the next city", ticks=[0, 20, 50, 100, 200, 400, 800], format="%d")
figure.savefig(sys.argv[1], dpi=100)
