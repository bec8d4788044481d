"""The catchments of Italy's cities, clipped to the country: catchments.py PICTURE. Needs GeoPandas and matplotlib."""

import sys
from pathlib import Path

import geopandas
import matplotlib
import numpy as np

import vorocl

matplotlib.use("Agg")
from matplotlib import colors, pyplot  # noqa: E402

samples = Path(__file__).parents[2] / "samples"
metres = "EPSG:3035"  # equal areas, for Europe
country = geopandas.read_file(samples / "italy.geojson").to_crs(metres)
places = np.loadtxt(samples / "cities-5000.csv", delimiter=",", skiprows=1)
cities = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*places.T), crs="EPSG:4326").to_crs(metres)
cities = cities[cities.within(country.union_all())]

cells = vorocl.exact_cells(cities.get_coordinates(), country.total_bounds).clip(country)
catchments = cells.to_geopandas(data=cities)
catchments["area_km2"] = catchments.area / 1e6
print(f"{len(catchments)} catchments of {catchments['area_km2'].median():.0f} km2 in the median")
print(f"{len(cells.pairs)} pairs touch, and {np.sum(catchments.geom_type == 'MultiPolygon')} are in several parts")

figure, axis = pyplot.subplots(figsize=(7.2, 6.6), layout="constrained")
shown = {"norm": colors.LogNorm(), "cmap": "YlGnBu", "edgecolor": "white", "linewidth": 0.4}
catchments.plot("area_km2", ax=axis, legend=True, legend_kwds={"label": "km²", "shrink": 0.7}, **shown)
cities.plot(ax=axis, color="black", markersize=1.5)
axis.set_axis_off()
figure.savefig(sys.argv[1], dpi=100)
