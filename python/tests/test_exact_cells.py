"""Cells as polygons and polyhedra, against SciPy, freud, Shapely, GeoPandas and PyVista."""

import freud
import geopandas
import numpy as np
import pandas
import pytest
import pyvista
import shapely
from scipy.spatial import ConvexHull, Voronoi, cKDTree

import vorocl

rng = np.random.default_rng(30)
BOUNDS = (-1.0, 2.0, 3.0, 4.0)


@pytest.fixture(scope="module")
def points():
    return rng.uniform(BOUNDS[:2], BOUNDS[2:], (400, 2))


def edges_of(pairs):
    return {(int(a), int(b)) for a, b in pairs[["a", "b"]].tolist()}


def test_inner_cells_are_those_of_scipy(points):
    found = vorocl.exact_cells(points, BOUNDS)
    assert len(found) == 400 and found.cells.dtype == vorocl.EXACT_CELL and found.pairs.dtype == vorocl.EXACT_PAIR
    assert found.cells["certified"].all()
    assert found.cells["area"].sum() == pytest.approx(8, rel=1e-14)
    voronoi = Voronoi(points)
    inner = 0
    for row, region in enumerate(voronoi.point_region):
        corners = voronoi.regions[region]
        vertices = voronoi.vertices[corners]
        if -1 in corners or (vertices < BOUNDS[:2]).any() or (vertices > BOUNDS[2:]).any():
            continue
        inner += 1
        polygon = shapely.MultiPoint(vertices).convex_hull
        assert found.cells["area"][row] == pytest.approx(polygon.area, rel=1e-6)
        assert found.cells["perimeter"][row] == pytest.approx(polygon.length, rel=1e-6)
        assert found.cells["centroid_x"][row] == pytest.approx(polygon.centroid.x, abs=1e-6)
        assert not found.cells["touches_border"][row]
    assert inner > 300
    there = {(min(a, b), max(a, b)) for a, b in voronoi.ridge_points.tolist()}
    assert edges_of(found.pairs) <= there
    np.testing.assert_array_equal(
        np.bincount(np.concatenate([found.pairs["a"], found.pairs["b"]]), minlength=400), found.cells["neighbours"]
    )


@pytest.mark.parametrize("tilt", [0, 0.7, -1, 1.99])
def test_periodic_cells_are_those_of_freud(points, tilt):
    found = vorocl.exact_cells(points, BOUNDS, periodic=(True, True), tilt=tilt)
    box = freud.box.Box(4, 2, xy=tilt / 2, is2D=True)
    centred = np.column_stack([points - (1, 3), np.zeros(400)])
    voronoi = freud.locality.Voronoi().compute((box, centred))
    np.testing.assert_allclose(found.cells["area"], voronoi.volumes, rtol=1e-4)  # freud's are made in floats
    assert len(found.pairs) == 1200  # Euler's, on a torus
    there = {(min(a, b), max(a, b)) for a, b in voronoi.nlist[:].tolist()}
    assert len(edges_of(found.pairs) ^ there) <= 2  # edges of a float's rounding
    assert not found.cells["touches_border"].any()


def images_of(places, tilt):
    """Those around the box, since SciPy knows no period: they, whether each is the place itself, its row; and the box's edges."""
    sides = np.subtract(BOX[3:], BOX[:3])
    xy, xz, yz = tilt if isinstance(tilt, tuple) else (tilt, 0, 0)
    edges = np.array([(sides[0], 0, 0), (xy, sides[1], 0), (xz, yz, sides[2])])
    short = edges.copy()  # of the same lattice with tilts of half a side at most
    short[2] -= np.round(short[2, 1] / sides[1]) * short[1]
    short[1:, 0] -= np.round(short[1:, 0] / sides[0]) * sides[0]
    counts = np.stack(np.meshgrid(*[np.arange(-3, 4)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    images = places + (counts @ short)[:, None]
    near = ((images > np.subtract(BOX[:3], 1)) & (images < np.add(BOX[3:], 1))).all(axis=2)
    itself, row = near & ~counts.any(axis=1)[:, None], np.broadcast_to(np.arange(len(places)), near.shape)
    return images[near], itself[near], row[near], edges


TILTS = [0.7, (0.5, -0.6, 0.9), (-1.9, 2, 1), (2, 5.5, -3)]


@pytest.mark.parametrize("tilt", TILTS)
def test_cells_of_tilted_volumes_are_those_of_scipy(places, tilt):
    found = vorocl.exact_cells(places, BOX, periodic=(True,) * 3, tilt=tilt)
    assert found.cells["volume"].sum() == pytest.approx(8, rel=1e-13) and found.cells["certified"].all()
    images, itself, row, edges = images_of(places, tilt)
    voronoi = Voronoi(images)
    ridges = np.vstack([voronoi.ridge_points, voronoi.ridge_points[:, ::-1]])
    ridges = ridges[itself[ridges[:, 0]]]
    pairs, image = found.pairs, np.column_stack([found.pairs["image_" + axis] for axis in "xyz"])
    ways = places[pairs["b"]] + image @ edges - places[pairs["a"]]

    def faces(a, b, ways):
        return set(zip(a.tolist(), b.tolist(), map(tuple, (np.round(ways, 7) + 0.0).tolist())))

    of_scipy = faces(row[ridges[:, 0]], row[ridges[:, 1]], images[ridges[:, 1]] - images[ridges[:, 0]])
    assert faces(pairs["a"], pairs["b"], ways) | faces(pairs["b"], pairs["a"], -ways) == of_scipy
    for at in np.flatnonzero(itself)[::20]:
        vertices = voronoi.vertices[voronoi.regions[voronoi.point_region[at]]]
        assert found.cells["volume"][row[at]] == pytest.approx(ConvexHull(vertices).volume, rel=1e-8)
    parts = (pairs["area"] / np.linalg.norm(ways, axis=1))[:, None] * ways
    sums = np.zeros((len(places), 3))
    np.add.at(sums, pairs["a"], parts)
    np.add.at(sums, pairs["b"], -parts)
    np.testing.assert_allclose(sums, 0, atol=1e-10)


@pytest.mark.parametrize("tilt", TILTS)
def test_voxels_of_tilted_volumes_are_those_of_the_nearest_images(places, tilt):
    shape = (20, 40, 80)
    box = dict(bounds=BOX, periodic=(True,) * 3, tilt=tilt)
    labels = vorocl.diagram(places, shape, **box)
    images, _, row, _ = images_of(places, tilt)
    axes = [low + (np.arange(n) + 0.5) * (high - low) / n for low, high, n in zip(BOX[:3], BOX[3:], shape[::-1])]
    z, y, x = np.meshgrid(*axes[::-1], indexing="ij")
    away, nearest = cKDTree(images).query(np.stack([x, y, z], axis=-1))
    assert (labels != row[nearest]).mean() < 1e-4  # places are rounded to 1/4096 of a voxel
    np.testing.assert_allclose(vorocl.distances(places, shape, **box), away, atol=1e-4)
    simulation = vorocl.Simulation(shape, **dict(box, tilt=0))
    np.testing.assert_array_equal(simulation.step(places, tilt=tilt).read(), labels)


@pytest.mark.parametrize("tilt", [0, 0.7, -1, 1.99, 4 + 0.7])
def test_pixels_of_a_tilted_box_have_the_cells_of_freud(points, tilt):
    box = dict(bounds=BOUNDS, periodic=(True, True), tilt=tilt, y_up=True)
    areas = vorocl.areas(points, (800, 1600), **box)
    centred = np.column_stack([points - (1, 3), np.zeros(400)])
    voronoi = freud.locality.Voronoi().compute((freud.box.Box(4, 2, xy=tilt / 2, is2D=True), centred))
    assert np.sqrt(np.mean((areas - voronoi.volumes) ** 2)) < 0.005 * 8 / 400
    pairs, lengths = vorocl.adjacency(points, (800, 1600), **box)
    exact = vorocl.exact_cells(points, BOUNDS, periodic=(True, True), tilt=tilt).pairs
    pixels = 16 * 4 / 1600  # shorter edges may be missed, or invented; those of cells less than a pixel wide, too
    assert len(edges_of(exact[exact["length"] > pixels]) - {(int(a), int(b)) for a, b in pairs}) <= 2
    assert {(int(a), int(b)) for a, b in pairs[lengths > pixels]} <= edges_of(exact)
    # Of all images the nearest.
    distances = vorocl.distances(points, (20, 40), **box)
    x, y = np.meshgrid((np.arange(40) + 0.5) / 10 - 1, 4 - (np.arange(20) + 0.5) / 10)
    nearest = np.full((20, 40), np.inf)
    for row in range(-3, 4):
        for column in range(-6, 7):
            for px, py in points + (4 * column + tilt * row, 2 * row):
                np.minimum(nearest, np.hypot(x - px, y - py), out=nearest)
    np.testing.assert_allclose(distances, nearest, atol=0.1 / 4096)


def test_a_box_that_is_sheared(points):
    simulation = vorocl.Simulation((40, 80), bounds=BOUNDS, periodic=(True, True))
    for tilt in (0, 0.5, 1.9, -1.9):
        labels = simulation.step(points, tilt=tilt).read()
        box = dict(bounds=BOUNDS, periodic=(True, True), tilt=tilt)
        np.testing.assert_array_equal(labels, vorocl.diagram(points, (40, 80), **box))
        np.testing.assert_array_equal(simulation.diagram.areas(), vorocl.areas(points, (40, 80), **box))
    np.testing.assert_array_equal(simulation.step(points).read(), labels)  # the tilt stays
    shifted = (0, 2, 4, 4)
    np.testing.assert_array_equal(
        simulation.step(points, bounds=shifted).read(),
        vorocl.diagram(points, (40, 80), bounds=shifted, periodic=(True, True), tilt=-1.9),
    )
    assert vorocl.errors(labels, points, bounds=BOUNDS, periodic=(True, True), tilt=-1.9, truth="true").wrong_pixels == 0
    with pytest.raises(vorocl.BadArgument, match="tilted, which flooding cannot take"):
        vorocl.diagram(points, (40, 80), method="jfa", **box)
    with pytest.raises(vorocl.BadArgument, match="periodic in x and y"):
        vorocl.Seeds(points, (40, 80), tilt=1)
    with pytest.raises(vorocl.BadArgument, match="finite"):
        simulation.step(points, tilt=np.nan)


def test_shapely_and_geopandas_by_one_call(points, tmp_path):
    given = points.copy()
    given[7] = np.nan
    given[9] = given[8]
    found = vorocl.exact_cells(given, BOUNDS)
    polygons = found.to_shapely()
    assert polygons[7].is_empty and polygons[9].is_empty and shapely.is_valid(polygons).all()
    np.testing.assert_allclose(shapely.area(polygons), found.cells["area"], atol=1e-14)
    np.testing.assert_allclose(shapely.length(polygons), found.cells["perimeter"], atol=1e-13)
    assert shapely.union_all(polygons).area == pytest.approx(8)
    assert shapely.is_ccw(shapely.get_exterior_ring(polygons[0]))
    assert all(polygons[row].covers(shapely.Point(given[row])) for row in range(7))
    np.testing.assert_array_equal(found.polygon(0), shapely.get_coordinates(polygons[0])[:-1])
    frame = found.to_geopandas(crs="EPSG:32632")
    frame.to_file(tmp_path / "cells.geojson")
    again = geopandas.read_file(tmp_path / "cells.geojson")
    assert len(again) == 400 and again.geometry.area.sum() == pytest.approx(8)
    table = found.to_pandas()
    assert list(table.columns[:3]) == ["x", "y", "area"] and isinstance(table, pandas.DataFrame)
    assert vorocl.exact_cells(np.zeros((0, 2)), BOUNDS).to_shapely().shape == (0,)


def test_columns_of_the_points_stand_beside_their_polygons(points, tmp_path):
    found = vorocl.exact_cells(points, BOUNDS)
    ids = pandas.Index(range(900, 500, -1), name="id")
    sites = pandas.DataFrame({"name": [f"site {row}" for row in range(400)]}, index=ids)
    located = geopandas.GeoDataFrame(sites, geometry=geopandas.points_from_xy(*points.T), crs="EPSG:32632")
    for data, crs in [(sites, "EPSG:32632"), (located, None), (located, "EPSG:32632")]:
        frame = found.to_geopandas(crs, data)
        assert frame.columns[0] == "name" and frame.crs == "EPSG:32632"
        inside = located.sjoin(frame[["geometry"]], predicate="within")  # each point in the polygon of its own row
        assert len(inside) == 400 and (inside.index == inside["id_right"]).all()
    frame.to_file(tmp_path / "cells.gpkg")
    again = geopandas.read_file(tmp_path / "cells.gpkg")
    assert again.crs == "EPSG:32632" and (again["name"] == sites["name"].to_numpy()).all()
    assert (again["area"] == found.cells["area"]).all() and (again["id"] == sites.index).all()
    twice = found.to_geopandas(data=sites.set_axis([7] * 400))
    assert len(twice) == 400 and (twice["area"].to_numpy() == found.cells["area"]).all()


@pytest.mark.parametrize(
    "data, message",
    [
        (pandas.DataFrame({"name": ["a"]}), "a row for each of the 400 points, and has 1"),
        (pandas.DataFrame({"area": np.zeros(400)}), 'a column "area", and so have the cells'),
        ({"name": ["a"] * 400}, "must be a pandas.DataFrame, not dict"),
    ],
)
def test_columns_that_cannot_stand_there_are_refused(points, data, message):
    with pytest.raises(vorocl.BadArgument, match=message):
        vorocl.exact_cells(points, BOUNDS).to_geopandas(data=data)


def test_points_outside(points):
    moved = points + (2, 0)
    absent = vorocl.exact_cells(moved, BOUNDS, outside="absent").cells["area"]
    outside = moved[:, 0] > 3
    assert (absent[outside] == 0).all() and absent.sum() == pytest.approx(8)
    counted = vorocl.exact_cells(moved, BOUNDS).cells["area"]
    assert counted.sum() == pytest.approx(8) and 0 < (counted[outside] > 0).sum() < outside.sum()
    with pytest.raises(vorocl.BadPoint):
        vorocl.exact_cells(moved, BOUNDS, outside="refuse")


BOX = (-1.0, 2.0, 0.0, 3.0, 4.0, 1.0)


@pytest.fixture(scope="module")
def places():
    return rng.uniform(BOX[:3], BOX[3:], (600, 3))


def test_inner_polyhedra_are_those_of_scipy(places):
    found = vorocl.exact_cells(places, BOX, polyhedra=True)
    assert len(found) == 600 and found.cells.dtype == vorocl.EXACT_VOLUME_CELL and found.pairs.dtype == vorocl.EXACT_FACE
    assert found.cells["certified"].all() and found.cells["volume"].sum() == pytest.approx(8, rel=1e-14)
    voronoi = Voronoi(places)
    inner = 0
    for row, region in enumerate(voronoi.point_region):
        corners = voronoi.regions[region]
        vertices = voronoi.vertices[corners]
        if -1 in corners or (vertices < BOX[:3]).any() or (vertices > BOX[3:]).any():
            continue
        inner += 1
        hull = ConvexHull(vertices)
        assert found.cells["volume"][row] == pytest.approx(hull.volume, rel=1e-9)
        assert found.cells["surface"][row] == pytest.approx(hull.area, rel=1e-9)
        assert not found.cells["touches_border"][row]
        own, faces = found.polyhedron(row)
        assert len(faces) == found.offsets[row + 1] - found.offsets[row] == found.cells["neighbours"][row]
        same = ConvexHull(own)
        assert len(own) == len(same.vertices) and same.volume == pytest.approx(hull.volume, rel=1e-9)
        for corners in faces:  # counter-clockwise, seen from outside
            p, q, r = own[corners[:3]]
            assert np.cross(q - p, r - p) @ (p - places[row]) > 0
    assert inner > 150
    there = {(min(a, b), max(a, b)) for a, b in voronoi.ridge_points.tolist()}
    assert edges_of(found.pairs) <= there
    np.testing.assert_allclose(
        np.add.reduceat(found.areas, found.offsets[:-1]), found.cells["surface"], rtol=1e-12
    )


def test_periodic_volumes_are_those_of_freud(places):
    sides = np.subtract(BOX[3:], BOX[:3])
    found = vorocl.exact_cells(places, BOX, periodic=(True, True, True))
    box = freud.box.Box(*sides)
    voronoi = freud.locality.Voronoi().compute((box, places - BOX[:3] - sides / 2))
    np.testing.assert_allclose(found.cells["volume"], voronoi.volumes, rtol=2e-4)  # freud's are made in floats
    there = {(min(a, b), max(a, b)) for a, b in voronoi.nlist[:].tolist()}
    assert there <= edges_of(found.pairs)
    assert edges_of(found.pairs[found.pairs["area"] > 1e-4]) <= there  # freud leaves out smaller ones
    a, b = found.pairs["a"], found.pairs["b"]
    image = np.column_stack([found.pairs[f"image_{axis}"] for axis in "xyz"])
    way = places[b] + image * sides - places[a]
    share = (found.pairs["area"] / np.linalg.norm(way, axis=1))[:, None] * way
    sums = np.zeros((600, 3))
    np.add.at(sums, a, share)
    np.add.at(sums, b, -share)
    np.testing.assert_allclose(sums, 0, atol=1e-10)  # the surfaces are closed
    assert not found.cells["touches_border"].any()


def test_tables_of_volumes(places):
    given = places.copy()
    given[7] = np.nan
    given[9] = given[8]
    found = vorocl.exact_cells(given, BOX)
    frame = found.to_pandas()
    assert list(frame.columns[:4]) == ["x", "y", "z", "volume"] and len(frame) == 600
    assert (frame.loc[[7, 9], "volume"] == 0).all() and frame.loc[[7, 9], "centroid_z"].isna().all()
    assert frame["volume"].sum() == pytest.approx(8)
    assert len(vorocl.exact_cells(np.zeros((0, 3)), BOX, polyhedra=True).vertices) == 0
    for call, message in [
        (found.to_shapely, "of planes"),
        (found.to_geopandas, "of planes"),
        (lambda: found.polygon(0), "of planes"),
        (lambda: found.polyhedron(0), "polyhedra=True"),
        (found.to_pyvista, "polyhedra=True"),
        (lambda: vorocl.exact_cells(places[:, :2], BOUNDS, polyhedra=True), "of volumes"),
        (lambda: vorocl.exact_cells(places, BOUNDS), r"\(N, 2\)"),
        (lambda: vorocl.exact_cells(places, BOX, periodic=(True, True)), "three booleans"),
        (lambda: vorocl.exact_cells(places, BOX, periodic=(True, True, False), tilt=(0, 1, 0)), "periodic in x and z"),
        (lambda: vorocl.exact_cells(points, BOUNDS, periodic=(True, True), tilt=(1, 0, 0)), "tilt must be a number"),
        (lambda: vorocl.cells(places, (4, 5, 6), method="jfa", bounds=BOX, periodic=(True,) * 3, tilt=1), "is tilted"),
        (lambda: vorocl.exact_cells(places, 7), "bounds"),
    ]:
        with pytest.raises(vorocl.BadArgument, match=message):
            call()
    with pytest.raises(vorocl.BadPoint):
        vorocl.exact_cells(places + (0, 0, 1), BOX)


def test_pyvista_by_one_call(places):
    given = places.copy()
    given[7] = np.nan
    found = vorocl.exact_cells(given, BOX, polyhedra=True)
    grid = found.to_pyvista()
    assert grid.n_cells == 599 and list(grid["row"][6:8]) == [6, 8]
    assert (grid.celltypes == pyvista.CellType.POLYHEDRON).all()
    np.testing.assert_array_equal(grid["volume"], found.cells["volume"][grid["row"]])
    for cell in range(0, 599, 20):
        vertices, faces = found.polyhedron(grid["row"][cell])
        shown = grid.get_cell(cell)
        assert ConvexHull(shown.points).volume == pytest.approx(grid["volume"][cell], rel=1e-9)
        assert len(shown.faces) == len(faces)
        for face, corners in zip(shown.faces, faces):
            np.testing.assert_array_equal(face.points, vertices[corners])
    assert vorocl.exact_cells(np.zeros((0, 3)), BOX, polyhedra=True).to_pyvista().n_cells == 0


def test_weighted_cells_own_the_places_of_the_least_power(points, places):
    """Against every place of a lattice: which of all images of all points has the least squared distance less its weight."""
    for given, box, unit in [(points, BOUNDS, 8 / 400), (places, BOX, (8 / 600) ** (2 / 3))]:
        dimensions = given.shape[1]
        low, sides = np.array(box[:dimensions]), np.subtract(box[dimensions:], box[:dimensions])
        weights = rng.uniform(0, 2 * unit, len(given))
        weights[::100] = 8 * unit  # few heavy ones, beside which many are empty
        found = vorocl.exact_cells(given, box, periodic=(True,) * dimensions, weights=weights)
        sizes = found.cells["volume" if dimensions == 3 else "area"]
        assert found.cells["certified"].all() and sizes.sum() == pytest.approx(8, rel=1e-13)
        assert 0.1 < (sizes == 0).mean() < 0.9
        assert np.isnan(found.cells["centroid_x"][sizes == 0]).all() and (found.cells["neighbours"][sizes == 0] == 0).all()
        counts = 60 if dimensions == 3 else 400
        lattice = np.stack(np.meshgrid(*[(np.arange(counts) + 0.5) / counts] * dimensions), -1).reshape(-1, dimensions)
        owners = np.empty(len(lattice), int)
        for begin in range(0, len(lattice), 20000):
            ways = np.abs(low + sides * lattice[begin : begin + 20000, None] - given)
            powers = (np.minimum(ways, sides - ways) ** 2).sum(-1) - weights
            owners[begin : begin + 20000] = powers.argmin(1)
        counted = np.bincount(owners, minlength=len(given)) * 8 / len(lattice)
        surfaces = found.cells["surface" if dimensions == 3 else "perimeter"]
        assert (counted[sizes == 0] == 0).all()
        assert (np.abs(counted - sizes) <= surfaces * sides.max() / counts).all()
        a, b = found.pairs["a"], found.pairs["b"]  # what touches is no empty cell
        assert (sizes[a] > 0).all() and (sizes[b] > 0).all()


@pytest.mark.parametrize(
    "weights, message",
    [(np.zeros(399), r"shape \(400,\)"), (["a"] * 400, "array of numbers"), ([np.inf] + [0] * 399, "seed 0 is inf")],
)
def test_bad_weights_are_refused(points, weights, message):
    with pytest.raises(vorocl.BadArgument, match=message):
        vorocl.exact_cells(points, BOUNDS, weights=weights)
    points = points.copy()
    points[0] = np.nan  # of a point that is not there they do not count
    assert vorocl.exact_cells(points, BOUNDS, weights=[np.nan] + [1] * 399).cells["area"].sum() == pytest.approx(8)


def test_cells_keep_the_points_and_have_rows_from_the_end():
    points = np.array([(1.0, 1), (3, 1)])
    found = vorocl.exact_cells(points, (0, 0, 4, 2))
    points[:] = 99
    np.testing.assert_array_equal(found.points, [(1, 1), (3, 1)])
    np.testing.assert_array_equal(found.polygon(-1), found.polygon(1))
    assert found.polygon(-1)[:, 0].min() == 2
    solid = vorocl.exact_cells([(1, 1, 1), (3, 1, 1)], (0, 0, 0, 4, 2, 2), polyhedra=True)
    np.testing.assert_array_equal(solid.polyhedron(-1)[0], solid.polyhedron(1)[0])
    for row in 2, -3:
        with pytest.raises(IndexError):
            found.polygon(row)
        with pytest.raises(IndexError):
            solid.polyhedron(row)
