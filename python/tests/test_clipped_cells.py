"""Cells clipped to regions, against Shapely's Voronoi polygons, SciPy's ridges and counts of lattices."""

from pathlib import Path

import geopandas
import numpy as np
import pandas
import pytest
import shapely
from scipy.spatial import Voronoi

import vorocl

SAMPLES = Path(__file__).parents[2] / "samples"
SQUARE = (0.0, 0.0, 8.0, 8.0)
LATTICE = np.stack(np.meshgrid(np.arange(0.5, 8), np.arange(0.5, 8)), axis=-1).reshape(-1, 2)


def coast(seed, corners=400):
    """An island with bays, three lakes, one of which has an island, and smaller islands around it."""
    rng = np.random.default_rng(seed)
    angles = np.sort(rng.uniform(0, 2 * np.pi, corners))
    waves = sum(rng.uniform(0, 0.5) / k * np.cos(k * angles + rng.uniform(0, 6)) for k in range(1, 30))
    radii = 2.3 * np.exp(0.35 * waves / np.abs(waves).max())
    land = shapely.Polygon(4 + radii[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])).buffer(0)
    lakes = shapely.union_all([shapely.Point(4 + x, 4 + y).buffer(0.4) for x, y in [(0, 0), (0.9, 0.6), (-0.6, -0.8)]])
    islands = [shapely.Point(x, y).buffer(0.3) for x, y in [(0.6, 0.7), (7.2, 1), (1, 7.3), (7.5, 7.5), (0.4, 4.5)]]
    return shapely.union_all([shapely.difference(land, lakes), shapely.Point(4, 4).buffer(0.15), *islands])


def random_points(seed, count):
    """At places that are not rounded."""
    return np.round(np.random.default_rng(seed).uniform(0, 8, (count, 2)) * 2**20) / 2**20


def areas_by_shapely(points, region, bounds):
    everywhere = shapely.box(*bounds)
    polygons = shapely.get_parts(
        shapely.voronoi_polygons(shapely.MultiPoint(points), extend_to=everywhere, ordered=True)
    )
    return shapely.area(shapely.intersection(shapely.intersection(polygons, everywhere), region))


def check_sums(found, region):
    """What is left is the region, and each side of a cell is one of the region's or one of two cells."""
    assert found.cells["area"].sum() == pytest.approx(region.area, rel=1e-12)
    assert found.cells["perimeter"].sum() == pytest.approx(region.length + 2 * found.pairs["length"].sum(), rel=1e-9)


@pytest.mark.parametrize("seed, count", [(1, 40), (2, 1000), (3, 5000)])
def test_cells_on_a_coast_with_lakes_and_islands(seed, count):
    region, points = coast(seed), random_points(seed, count)
    whole = vorocl.exact_cells(points, SQUARE)
    found = whole.clip(region)
    assert found.cells.dtype == vorocl.EXACT_CELL and found.pairs.dtype == vorocl.EXACT_PAIR and len(found) == count
    polygons = found.to_shapely()
    assert set(shapely.get_type_id(polygons)) <= {3, 6} and shapely.is_valid(polygons).all()
    full = found.cells["area"] > 0
    assert (full == ~shapely.is_empty(polygons)).all() and np.isnan(found.cells["centroid_x"][~full]).all()
    np.testing.assert_allclose(found.cells["area"], areas_by_shapely(points, region, SQUARE), atol=1e-9)
    np.testing.assert_allclose(found.cells["area"], shapely.area(polygons), atol=1e-12)
    np.testing.assert_allclose(found.cells["centroid_y"][full], shapely.get_y(shapely.centroid(polygons[full])), rtol=1e-12)
    touches = shapely.distance(polygons, region.boundary) < 1e-9
    np.testing.assert_array_equal(found.cells["touches_border"], touches)
    check_sums(found, region)

    voronoi = Voronoi(points)  # of which some ridges go on outside the square
    lines = {}
    for pair, (begin, end) in zip(voronoi.ridge_points, voronoi.ridge_vertices):
        if begin < 0:
            continue
        line = shapely.intersection(shapely.LineString(voronoi.vertices[[begin, end]]), region)
        if line.length > 1e-9:
            lines[tuple(sorted(pair.tolist()))] = line.length, line.centroid.x, line.centroid.y
    pairs = {(a, b): edge for a, b, *edge in found.pairs.tolist() if edge[0] > 1e-9}
    assert lines.keys() <= pairs.keys()
    assert all(line == pytest.approx(pairs[pair], abs=1e-9) for pair, line in lines.items())
    rest = pairs.keys() - lines.keys()  # of cells whose edges SciPy takes to infinity
    assert all(-1 in voronoi.regions[voronoi.point_region[a]] for a, b in rest) and len(rest) < 4
    ends = np.concatenate([found.pairs["a"], found.pairs["b"]])
    np.testing.assert_array_equal(np.bincount(ends, minlength=count), found.cells["neighbours"])


def test_weighted_cells_and_absent_points_are_clipped_too():
    region, points = coast(4), random_points(4, 600)
    points[7], points[9] = np.nan, points[8]
    weights = np.random.default_rng(4).uniform(0, 0.3, 600)
    whole = vorocl.exact_cells(points, SQUARE, weights=weights)
    assert (whole.cells["area"] == 0).sum() > 2
    found = whole.clip(region)
    check_sums(found, region)
    np.testing.assert_allclose(found.cells["area"], shapely.area(shapely.intersection(whole.to_shapely(), region)), atol=1e-12)


def test_catchments_of_a_country_s_cities():
    country = geopandas.read_file(SAMPLES / "italy.geojson")
    region = country.union_all()
    cities = np.round(np.loadtxt(SAMPLES / "cities-5000.csv", delimiter=",", skiprows=1) * 2**20) / 2**20
    cities = cities[shapely.contains_xy(region, *cities.T)]
    bounds = (6.0, 35.0, 19.0, 48.0)
    found = vorocl.exact_cells(cities, bounds).clip(country)
    np.testing.assert_allclose(found.cells["area"], areas_by_shapely(cities, region, bounds), atol=1e-9)
    check_sums(found, region)
    sites = pandas.DataFrame({"name": [f"city {row}" for row in range(len(cities))]}, index=range(100, 100 + len(cities)))
    located = geopandas.GeoDataFrame(sites, geometry=geopandas.points_from_xy(*cities.T), crs="EPSG:4326")
    for data in sites, located:
        frame = found.to_geopandas(data=data)
        assert frame.crs == "EPSG:4326" and frame.columns[0] == "name" and (frame.index == sites.index).all()
        inside = located.sjoin(frame[["geometry"]], predicate="within")
        assert len(inside) == len(cities) and (inside.index == inside["index_right"]).all()
    with pytest.raises(vorocl.BadArgument, match="EPSG:4326.*EPSG:3035.*to_crs"):
        found.to_geopandas(data=located.to_crs("EPSG:3035"))
    with pytest.raises(vorocl.BadArgument, match="EPSG:4326.*EPSG:3035.*to_crs"):
        found.to_geopandas("EPSG:3035")
    assert found.to_geopandas("WGS 84").crs == "EPSG:4326"


def test_a_region_along_edges_has_none_of_the_cells_behind_them():
    whole = vorocl.exact_cells(LATTICE, SQUARE)
    found = whole.clip(shapely.box(2, 2, 5, 6))
    assert (found.cells["area"] > 0).sum() == 12 and found.cells["area"].sum() == 12
    assert len(found.pairs) == 2 * 4 + 3 * 3 and (found.pairs["length"] == 1).all()
    assert found.cells["touches_border"].sum() == 10
    beside = whole.clip(shapely.box(2, 2, 5, 6) - shapely.box(3, 3, 3.5, 4))  # 26 and 27 meet at the hole's side alone
    assert (beside.cells["area"] > 0).sum() == 12 and len(beside.pairs) == 16
    assert (26, 27) not in beside.pairs[["a", "b"]].tolist()
    halves = whole.clip([shapely.box(0, 0, 4, 8), shapely.box(4, 0, 8, 8)])  # which are one
    np.testing.assert_array_equal(halves.pairs, whole.pairs)
    np.testing.assert_array_equal(halves.cells, whole.cells)
    apart = whole.clip(geopandas.GeoSeries([shapely.box(0, 0, 3, 8), None, shapely.box(5, 0, 8, 8)]))
    assert apart.cells["area"].sum() == 48 and len(apart.pairs) == 2 * (3 * 7 + 2 * 8)


def test_cells_in_parts_with_holes_and_beside_the_region():
    region = shapely.box(1, 1, 7, 7) - shapely.box(3.25, 1, 3.75, 7) - shapely.box(5.25, 5.25, 5.75, 5.75)
    found = vorocl.exact_cells(LATTICE, SQUARE).clip(region)
    polygons = found.to_shapely()
    assert polygons[8 * 2 + 3].geom_type == "MultiPolygon" and found.cells["area"][8 * 2 + 3] == 0.5
    assert shapely.get_num_interior_rings(polygons[8 * 5 + 5]) == 1 and found.cells["area"][8 * 5 + 5] == 0.75
    assert polygons[0].is_empty and found.cells[0]["neighbours"] == 0 and np.isnan(found.cells[0]["centroid_x"])
    pair = found.pairs[(found.pairs["a"] == 8 * 2 + 3) & (found.pairs["b"] == 8 * 3 + 3)]
    assert pair["length"] == 0.5 and pair["midpoint_x"] == 3.5 and pair["midpoint_y"] == 3
    assert repr(found) == "<vorocl.ClippedCells of 64 points>"
    beyond = vorocl.exact_cells(LATTICE, SQUARE).clip(shapely.box(7.5, 7.5, 20, 20))  # of which the rectangle has a part
    assert beyond.cells["area"].sum() == 0.25 and len(beyond.pairs) == 0
    nothing = vorocl.exact_cells(LATTICE, SQUARE).clip(shapely.box(9, 9, 20, 20))
    assert nothing.cells["area"].sum() == 0 and len(nothing.to_geopandas()) == 64


@pytest.mark.parametrize(
    "region, message",
    [
        (shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)]), "Self-intersection.*make_valid"),
        (shapely.LineString([(0, 0), (2, 2)]), "must be polygons"),
        ((0, 0, 2, 2), "must be polygons"),
        (None, "region is empty"),
        (shapely.Polygon(), "region is empty"),
        (geopandas.GeoSeries([], dtype=object), "region is empty"),
    ],
)
def test_what_is_no_region_is_refused(region, message):
    with pytest.raises(vorocl.BadArgument, match=message):
        vorocl.exact_cells(LATTICE, SQUARE).clip(region)


def test_volumes_and_periodic_planes_are_refused():
    with pytest.raises(vorocl.BadArgument, match="clipped cells are of planes"):
        vorocl.exact_cells([(1, 1, 1)], (0, 0, 0, 2, 2, 2)).clip(shapely.box(0, 0, 1, 1))
    with pytest.raises(vorocl.BadArgument, match="periodic axis"):
        vorocl.exact_cells(LATTICE, SQUARE, periodic=(False, True)).clip(shapely.box(0, 0, 1, 1))
