#!/usr/bin/env python3
"""Times labels by great circles beside those of other tools, and exact cells of a country beside QGIS's and GeoPandas's way.

Needs the packages vorocl, scipy, xarray-spatial, geopandas and pyvoro2. Programs are run in turn; the least processor time
of some runs is printed, the areas that they find, and how many of their labels are farther than the nearest seed, and by
how much at most.
"""

import argparse
import time
from pathlib import Path

import geopandas
import numpy as np
import pyvoro2.planar
import shapely
import xarray as xr
from scipy.spatial import SphericalVoronoi, cKDTree
from xrspatial import allocation

import vorocl

SAMPLES = Path(__file__).parents[2] / "samples"
RADIUS = 6371.0088


def vectors(degrees):
    lon, lat = np.radians(degrees).T
    return np.column_stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])


def centres(height, width):
    lon = -180 + (np.arange(width) + 0.5) * 360 / width
    lat = 90 - (np.arange(height) + 0.5) * 180 / height
    return lon, lat


def pixels(height, width):
    lon, lat = np.meshgrid(*centres(height, width))
    return np.column_stack([lon.ravel(), lat.ravel()])


def pixels_of(points, shape):
    """The rows and columns that points lie in."""
    rows, columns = (90 - points[:, 1]) * shape[0] / 180, (points[:, 0] + 180) * shape[1] / 360
    return rows.astype(int), columns.astype(int) % shape[1]


def kilometres(points, shape, labels):
    chords = np.linalg.norm(vectors(pixels(*shape)) - vectors(points)[labels.ravel()], axis=1)
    return 2 * RADIUS * np.arcsin(np.minimum(chords / 2, 1))


def by_vorocl(points, shape):
    return vorocl.diagram(points, shape, y_up=True, metric="great-circle")


def by_tree(points, shape):
    return cKDTree(vectors(points)).query(vectors(pixels(*shape)))[1].reshape(shape)


def by_allocation(points, shape):
    """Of points in the centres of pixels, each in one of its own."""
    lon, lat = centres(*shape)
    raster = np.zeros(shape)
    raster[pixels_of(points, shape)] = np.arange(len(points)) + 1
    image = xr.DataArray(raster, dims=("lat", "lon"), coords={"lat": lat, "lon": lon})
    return allocation(image, x="lon", y="lat", distance_metric="GREAT_CIRCLE").values.astype(int) - 1


def least_ms(programs, repeat):
    """By name the least processor time, and what was returned; the programs take turns."""
    least, results = dict.fromkeys(programs, float("inf")), {}
    for _ in range(repeat):
        for name, work in programs.items():
            begin = time.process_time()
            results[name] = work()
            least[name] = min(least[name], 1000 * (time.process_time() - begin))
    return least, results


def print_labels(title, points, shape, programs, repeat):
    least, labels = least_ms({name: lambda work=work: work(points, shape) for name, work in programs.items()}, repeat)
    nearest = cKDTree(vectors(points)).query(vectors(pixels(*shape)))[0]
    nearest = 2 * RADIUS * np.arcsin(np.minimum(nearest / 2, 1))
    for name, ms in least.items():
        ways = kilometres(points, shape, labels[name]) - nearest
        farther = f"{100 * (ways > 2e-5).mean():.2g} % | {max(ways.max(), 0):,.3g} km"
        print(f"| {title} | {name} | {ms:,.1f} | {farther} |", flush=True)


def print_areas(points, repeat):
    """Cells of the sphere, in square kilometres: those of pixels beside the exact ones."""
    programs = {
        "vorocl, 1800 x 900": lambda: vorocl.areas(points, (900, 1800), y_up=True, metric="great-circle"),
        "SciPy SphericalVoronoi": lambda: SphericalVoronoi(RADIUS * vectors(points), RADIUS).calculate_areas(),
    }
    least, areas = least_ms(programs, repeat)
    for name, ms in least.items():
        print(f"| {name} | {ms:,.1f} | {areas[name].sum():,.0f} |", flush=True)
    of_pixels, exact = areas.values()
    error = np.sqrt(np.mean((of_pixels - exact) ** 2)) / exact.mean()
    print(f"\nThe areas differ by {100 * error:.2g} % of their mean (rms).\n")


def print_country(points, repeat):
    country = geopandas.read_file(SAMPLES / "italy.geojson")
    west, south, east, north = box = country.total_bounds
    inside = points[(points[:, 0] > west) & (points[:, 0] < east) & (points[:, 1] > south) & (points[:, 1] < north)]

    def overlay():
        cells = shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(inside), extend_to=shapely.box(*box)))
        return geopandas.overlay(geopandas.GeoDataFrame(geometry=cells, crs=country.crs), country).geometry.area.sum()

    def by_pyvoro2():
        domain = pyvoro2.planar.Box(((west, east), (south, north)))
        cells = pyvoro2.planar.compute(inside, domain=domain, return_vertices=True).cells
        polygons = shapely.convex_hull([shapely.multipoints(cell["vertices"]) for cell in cells])
        return shapely.area(shapely.intersection(polygons, country.geometry.iloc[0])).sum()

    programs = {
        "vorocl.exact_cells().clip()": lambda: vorocl.exact_cells(inside, box).clip(country).cells["area"].sum(),
        "voronoi_polygons, geopandas.overlay": overlay,
        "pyvoro2, shapely.intersection": by_pyvoro2,
    }
    least, areas = least_ms(programs, repeat)
    for name, ms in least.items():
        print(f"| {name} | {ms:,.1f} | {areas[name]:.12g} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    cities = np.genfromtxt(SAMPLES / "cities-5000.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
    cities = np.unique(np.column_stack([cities["lon"], cities["lat"]]), axis=0)
    random = np.random.default_rng(1)
    meridian = np.column_stack([np.full(5000, 12.3), random.uniform(-90, 90, 5000)])
    equator = np.column_stack([random.uniform(-180, 180, 5000), np.zeros(5000)])
    many = np.column_stack([random.uniform(-180, 180, 10**6), np.degrees(np.arcsin(random.uniform(-1, 1, 10**6)))])
    small = (300, 600)
    lon, lat = centres(*small)
    rows, columns = pixels_of(cities, small)
    snapped = np.unique(np.column_stack([lon[columns], lat[rows]]), axis=0)

    both = {"vorocl": by_vorocl, "k-d tree of unit vectors, SciPy": by_tree}
    print("| seeds, pixels | program | processor ms | labels farther than the nearest | at most by |")
    print("| --- | --- | --- | --- | --- |")
    print_labels(f"{len(cities):,} cities, 1800 x 900", cities, (900, 1800), both, options.repeat)
    print_labels("1,000,000 at random, 1800 x 900", many, (900, 1800), both, options.repeat)
    print_labels("5,000 on a meridian, 1800 x 900", meridian, (900, 1800), both, options.repeat)
    print_labels("5,000 on the equator, 1800 x 900", equator, (900, 1800), both, options.repeat)
    three = {**both, "xarray-spatial": by_allocation}
    print_labels(f"{len(snapped):,} pixels with cities, 600 x 300", snapped, small, three, options.repeat)
    print("\n| areas of the cities' cells | processor ms | sum, km^2 |\n| --- | --- | --- |")
    print_areas(cities, options.repeat)
    print("| the cities' cells in Italy | processor ms | area, square degrees |\n| --- | --- | --- |")
    print_country(cities, options.repeat)


main()
