"""Measures of cells, against NumPy, freud and the labels themselves."""

import itertools

import freud
import numpy as np
import pandas
import pytest
import scipy.spatial
from oracles import brute_force, offsets, pixel_centres, rounded

import vorocl

rng = np.random.default_rng(19)
SHAPE = (70, 91)


@pytest.fixture(scope="module")
def points():
    points = rng.uniform(0, SHAPE[::-1], (60, 2))
    points[5] = np.nan
    points[9] = points[8]
    return points


def test_cells_are_measured_as_numpy_does(points):
    labels = brute_force(points, SHAPE)
    cells = vorocl.cells(points, SHAPE)
    assert set(cells.dtype.names) == set(vorocl.CELL.names) - {"z", "centroid_z", "front", "back"} and cells.shape == (60,)
    assert cells["area"].sum() == labels.size and cells["area"][5] == cells["area"][9] == 0
    assert np.isnan(cells[["x", "y", "centroid_x", "largest_distance"]][5].tolist()).all()
    assert cells["right"][9] < cells["left"][9] and np.isnan(cells["largest_distance"][9])
    for row, cell in enumerate(cells):
        y, x = np.nonzero(labels == row)
        assert cell["area"] == len(x)
        if len(x) == 0:
            continue
        assert (cell["x"], cell["y"]) == tuple(rounded(points[row]))
        assert (cell["left"], cell["top"], cell["right"], cell["bottom"]) == (x.min(), y.min(), x.max(), y.max())
        np.testing.assert_allclose((cell["centroid_x"], cell["centroid_y"]), (x.mean() + 0.5, y.mean() + 0.5))
        farthest = np.hypot(x + 0.5 - cell["x"], y + 0.5 - cell["y"]).max()
        np.testing.assert_allclose(cell["largest_distance"], farthest)
        at_border = x.min() == 0 or y.min() == 0 or x.max() == SHAPE[1] - 1 or y.max() == SHAPE[0] - 1
        assert cell["touches_border"] == at_border


@pytest.mark.parametrize("y_up", [False, True])
@pytest.mark.parametrize("periodic", [(False, False), (True, True)])
def test_measures_are_in_the_units_of_the_points(points, periodic, y_up):
    plane = dict(bounds=(10, -20, 10 + 91 / 8, -20 + 70 / 8), periodic=periodic, y_up=y_up)  # 8 pixels in a unit

    def to_data(x, y):
        return 10 + x / 8, -20 + (70 - y if y_up else y) / 8

    given = np.column_stack(to_data(*points.T))
    found, pixels = vorocl.cells(given, SHAPE, **plane), vorocl.cells(given, SHAPE, units="pixels", **plane)
    for name, values in ((name, vorocl.cells(points, SHAPE, periodic=periodic)[name]) for name in found.dtype.names):
        np.testing.assert_array_equal(pixels[name], values)
    np.testing.assert_allclose(np.column_stack([found["x"], found["y"]]), given, atol=0.51 / 8)
    np.testing.assert_allclose(found["area"], pixels["area"] / 64)
    np.testing.assert_allclose((found["centroid_x"], found["centroid_y"]), to_data(pixels["centroid_x"], pixels["centroid_y"]))
    for length in "perimeter", "largest_distance":
        np.testing.assert_allclose(found[length], pixels[length] / 8)
    full = pixels["area"] > 0
    np.testing.assert_allclose((found["left"], found["top"])[0][full], to_data(pixels["left"], 0)[0][full])
    np.testing.assert_allclose(found["top"][full], to_data(0, pixels["top"])[1][full])
    np.testing.assert_allclose(found["right"][full], to_data(pixels["right"] + 1.0, 0)[0][full])
    np.testing.assert_allclose(found["bottom"][full], to_data(0, pixels["bottom"] + 1.0)[1][full])
    assert np.isnan(found["left"][~full]).all() and np.isnan(found["bottom"][~full]).all()
    for same in "neighbours", "touches_border":
        np.testing.assert_array_equal(found[same], pixels[same])

    np.testing.assert_allclose(vorocl.areas(given, SHAPE, **plane), found["area"])
    np.testing.assert_array_equal(vorocl.areas(given, SHAPE, units="pixels", **plane), pixels["area"])
    pairs, lengths = vorocl.adjacency(given, SHAPE, **plane)
    expected, edges = vorocl.adjacency(points, SHAPE, periodic=periodic)
    np.testing.assert_array_equal(pairs, expected)
    np.testing.assert_allclose(lengths, edges / 8)
    np.testing.assert_allclose(
        vorocl.distances(given, SHAPE, **plane), vorocl.distances(points, SHAPE, periodic=periodic) / 8, rtol=1e-6
    )
    corners = vorocl.vertices(points, SHAPE, periodic=periodic)
    np.testing.assert_allclose(vorocl.vertices(given, SHAPE, **plane), np.column_stack(to_data(*corners.T)))


def test_lengths_without_a_scale_are_refused_or_named(points):
    plane = dict(bounds=(0, 0, 91, 35))
    given = points / (1, 2)
    cells = vorocl.cells(given, SHAPE, **plane)
    pixels = vorocl.cells(points, SHAPE)
    np.testing.assert_allclose(cells["area"], pixels["area"] / 2)
    for length in "perimeter", "largest_distance":
        assert length not in cells.dtype.names
        np.testing.assert_array_equal(cells[length + "_px"], pixels[length])
    for measure in vorocl.distances, vorocl.adjacency:
        with pytest.raises(vorocl.BadArgument, match='give units="pixels"'):
            measure(given, SHAPE, **plane)
    np.testing.assert_array_equal(vorocl.distances(given, SHAPE, units="pixels", **plane), vorocl.distances(points, SHAPE))


@pytest.mark.parametrize("shape, bounds", [((10, 1), (0, 0, 1, 10000)), ((1, 10), (0, 0, 10, 1.4))])
def test_one_row_of_long_pixels_has_no_scale(shape, bounds):
    with pytest.raises(vorocl.BadArgument, match='give units="pixels"'):
        vorocl.distances([(0.5, 0.5)], shape, bounds=bounds)
    assert "largest_distance_px" in vorocl.cells([(0.5, 0.5)], shape, bounds=bounds).dtype.names


@pytest.mark.parametrize("periodic", [(False, False), (True, False), (True, True)])
def test_pairs_are_those_of_the_labels(points, periodic):
    labels = brute_force(points, SHAPE, periodic)
    edges = []
    for axis in 0, 1:
        there = np.roll(labels, -1, axis)
        inside = labels.shape[axis] - (0 if periodic[1 - axis] else 1)
        edges.append(np.stack([labels, there], -1).take(range(inside), axis).reshape(-1, 2))
    edges = np.sort(np.concatenate(edges), axis=1)
    expected, lengths = np.unique(edges[edges[:, 0] != edges[:, 1]], axis=0, return_counts=True)
    pairs, found = vorocl.adjacency(points, SHAPE, periodic=periodic)
    np.testing.assert_array_equal(pairs, expected)
    np.testing.assert_array_equal(found, lengths)
    cells = vorocl.cells(points, SHAPE, periodic=periodic)
    np.testing.assert_array_equal(cells["neighbours"], np.bincount(pairs.ravel(), minlength=60))
    weights = np.repeat(lengths, 2)
    np.testing.assert_array_equal(cells["perimeter"], np.bincount(pairs.ravel(), weights, minlength=60))


@pytest.mark.parametrize("periodic", [(False, False), (True, False), (False, True), (True, True)])
def test_vertices_are_as_many_as_the_device_counts(points, periodic):
    found = vorocl.vertices(points, SHAPE, periodic=periodic)
    diagram = vorocl.Diagram(SHAPE, periodic=periodic)
    diagram.fill(vorocl.Seeds(points, SHAPE, periodic=periodic))
    assert len(found) == diagram.count_vertices() > 60
    np.testing.assert_array_equal(found, diagram.vertices())
    assert (np.lexsort((found[:, 0], found[:, 1])) == np.arange(len(found))).all()
    assert found.min() >= 1 and (found <= SHAPE[::-1]).all()
    labels = diagram.read()
    for x, y in found.astype(int):
        around = labels[np.ix_([y - 1, y % SHAPE[0]], [x - 1, x % SHAPE[1]])]
        assert len(np.unique(around)) >= 3


def test_areas_are_those_of_freud():
    shape = (400, 500)
    points = np.floor(rng.uniform(0, shape[::-1], (200, 2))) + 0.5
    cells = vorocl.cells(points, shape, periodic=(True, True))
    voronoi = freud.locality.Voronoi()
    centred = np.column_stack([points - (250, 200), np.zeros(200)])
    voronoi.compute((freud.box.Box(500, 400, is2D=True), centred))
    # A pixel is in the wrong cell only where a border cuts it.
    error = np.abs(cells["area"] - voronoi.volumes)
    assert (error <= 0.25 * cells["perimeter"]).all()
    assert error.max() > 0  # they are two ways to measure


def test_a_frame_of_pandas_takes_the_cells(points):
    frame = pandas.DataFrame(vorocl.cells(points, SHAPE))
    assert frame["area"].sum() == SHAPE[0] * SHAPE[1] and "centroid_x" in frame.columns and "z" not in frame.columns


def test_points_of_a_volume_relax_to_voxels():
    points = np.random.default_rng(3).random((12, 3)) * (20, 14, 10)
    density = np.ones((10, 14, 20))
    relaxed = vorocl.relax(points, (10, 14, 20), rounds=50, density=density)
    assert relaxed.converged and relaxed.points.shape == (12, 3) and relaxed.energies[-1] < relaxed.energies[0]
    labels = vorocl.diagram(relaxed.points, (10, 14, 20))
    for row, point in enumerate(relaxed.points):
        centroid = np.argwhere(labels == row).mean(axis=0)[::-1] + 0.5
        assert np.abs(centroid - point).max() <= 0.5


def test_relaxed_points_are_centroids():
    points = rng.uniform((-1, 2), (1, 4), (30, 2))
    bounds = (-1, 2, 1, 4)
    relaxed = vorocl.relax(points, (80, 80), rounds=300, bounds=bounds, y_up=True)
    assert relaxed.converged and len(relaxed.energies) == len(relaxed.moved) + 1
    assert (np.diff(relaxed.energies.astype(float)) <= 0).all() and relaxed.moved[0] > 0
    labels = vorocl.diagram(relaxed.points, (80, 80), bounds=bounds, y_up=True)
    centres = pixel_centres((80, 80))
    energy = 0
    for row, (x, y) in enumerate(relaxed.points):
        own = centres[labels.ravel() == row]
        place = ((x + 1) * 40, 80 - (y - 2) * 40)
        assert np.abs(own.mean(axis=0) - place).max() <= 0.5
        energy += ((own - place) ** 2).sum()
    np.testing.assert_allclose(relaxed.energies[-1], energy, rtol=1e-6)
    assert len(vorocl.relax(points, (80, 80), rounds=0, bounds=bounds).energies) == 1


def test_a_density_draws_points():
    points = np.random.default_rng(5).uniform(0, (90, 60), (150, 2))
    density = np.zeros((60, 90))
    density[:, :45], density[:, 45:] = 1, 16
    relaxed = vorocl.relax(points, (60, 90), rounds=1, density=density)
    labels = vorocl.diagram(points, (60, 90))
    row, column = np.indices(labels.shape)
    weight = np.bincount(labels.ravel(), density.ravel())
    centroids = [np.bincount(labels.ravel(), (density * (at + 0.5)).ravel()) / weight for at in (column, row)]
    # The weights are rounded to 1/65535 of the greatest, and positions to 1/4096.
    np.testing.assert_allclose(relaxed.points, np.transpose(centroids), atol=1e-3)
    squares = (column + 0.5 - points[labels, 0]) ** 2 + (row + 0.5 - points[labels, 1]) ** 2
    np.testing.assert_allclose(relaxed.energies[0], (density * squares).sum(), rtol=1e-3)
    as_integers = vorocl.relax(points, (60, 90), rounds=1, density=density.astype(np.uint8).tolist())
    np.testing.assert_array_equal(as_integers.points, relaxed.points)


def centroids_by_scipy(points, sides, periodic):
    """Of polygons or polyhedra in a box, where mirrored points make its sides, or images repeat it."""
    around, dimensions = [points], points.shape[1]
    for image in itertools.product((-1, 0, 1), repeat=dimensions):
        if any(image) and periodic:
            around.append(points + np.array(image) * sides)
        elif sum(map(abs, image)) == 1:
            mirrored = points.copy()
            axis = np.flatnonzero(image)[0]
            mirrored[:, axis] = (image[axis] + 1) * sides[axis] - points[:, axis]
            around.append(mirrored)
    cells = scipy.spatial.Voronoi(np.concatenate(around))
    centroids = []
    for region in cells.point_region[: len(points)]:
        corners = cells.vertices[cells.regions[region]]
        parts = corners[scipy.spatial.Delaunay(corners).simplices]
        sizes = abs(np.linalg.det(parts[:, 1:] - parts[:, :1]))
        centroids.append(sizes @ parts.mean(axis=1) / sizes.sum())
    return np.array(centroids)


@pytest.mark.parametrize("shape, periodic", [((9, 23), False), ((9, 23), True), ((5, 4, 6), False), ((5, 4, 6), True)])
def test_exact_rounds_are_those_of_scipys_cells(shape, periodic):
    sides = np.array([4.0, 3.0, 2.0][: len(shape)])
    bounds = (0, 0, 4, 3) if len(shape) == 2 else (0, 0, 0, 4, 3, 2)
    points = np.random.default_rng(6).uniform(0, sides, (30, len(shape)))
    axes = (periodic,) * len(shape)
    relaxed = vorocl.relax(points, shape, rounds=4, bounds=bounds, periodic=axes, exact=True)
    assert relaxed.moved.tolist() == [30] * 4 and relaxed.energies[-1] < relaxed.energies[0]
    for _ in range(4):
        points = centroids_by_scipy(points, sides, periodic)
        points = points % sides if periodic else points
    np.testing.assert_allclose(relaxed.points, points, atol=1e-6)
    with pytest.raises(vorocl.BadArgument, match="no density"):
        vorocl.relax(points, shape, bounds=bounds, exact=True, density=np.ones(shape))
    with pytest.raises(vorocl.BadArgument, match="snapped to pixels"):
        vorocl.relax(points, shape, bounds=bounds, exact=True, snap=True)


@pytest.mark.parametrize("truth", ["snapped", "true"])
def test_errors_are_those_of_brute_force(truth):
    points = rng.uniform(0, (60, 50), (40, 2))
    snap = truth == "snapped"
    right = brute_force(points, (50, 60), (True, False), snap=snap)
    labels = np.where(rng.random((50, 60)) < 0.1, rng.integers(0, 40, (50, 60)), right)
    labels[3, 4] = 40  # no point's
    found = vorocl.errors(labels, points, periodic=(True, False), truth=truth)
    centres, places = pixel_centres((50, 60)), rounded(points, snap)

    def distances(of):
        return np.linalg.norm(offsets(centres, places[of.ravel()], (50, 60), (True, False)), axis=1)

    excess = distances(np.where(labels == 40, right, labels)) - distances(right)
    assert found.pixels == 3000 and found.unlabelled_pixels == 1
    assert found.wrong_pixels == (excess > 0).sum() + 1
    np.testing.assert_allclose((found.largest_excess, found.mean_excess), (excess.max(), excess.mean()), rtol=2e-4)
    assert found.wrong_percent == 100 * found.wrong_pixels / 3000
    assert vorocl.similarity(labels, right) == 100 * np.count_nonzero(labels == right) / 3000


def test_a_power_diagram_is_not_judged_by_distances():
    seeds, diagram = vorocl.Seeds([(10, 16), (24, 16)], (32, 32), weights=[100, 0]), vorocl.Diagram((32, 32))
    diagram.fill(seeds)
    labels = diagram.read()
    simulation = vorocl.Simulation((32, 32))
    for judged in diagram, simulation.step([(10, 16), (24, 16)], weights=[100, 0]):
        for truth in None, "true", "snapped":
            with pytest.raises(vorocl.BadArgument, match="power diagram goes by weights"):
                judged.errors(truth)
    diagram.write(labels, vorocl.Seeds([(10, 16), (24, 16)], (32, 32)))
    wrong = np.count_nonzero(labels != vorocl.diagram([(10, 16), (24, 16)], (32, 32)))
    assert diagram.errors("true").wrong_pixels == wrong > 0


def test_lengths_in_a_spaced_grid_do_not_ask_where_y_points():
    points = np.array([(1.5, 0.5), (6.5, 2.5)])
    upwards = points * (1, -1) + (0, 4)
    for measure in vorocl.distances, lambda *of, **how: vorocl.adjacency(*of, **how)[1], vorocl.areas:
        expected = measure(points, (4, 8), spacing=(1, 3))
        found = measure(upwards, (4, 8), spacing=(1, 3), y_up=True)
        np.testing.assert_allclose(found, expected, atol=1e-3)


def test_a_diagram_is_judged_by_what_it_was_made_of():
    points = rng.uniform(0, (60, 50), (400, 2))
    seeds, diagram = vorocl.Seeds(points, (50, 60), snap=False), vorocl.Diagram((50, 60))
    diagram.fill(seeds)
    labels = diagram.read()
    assert diagram.errors().wrong_pixels == diagram.errors("true").wrong_pixels == 0
    assert diagram.errors("snapped").wrong_pixels == vorocl.errors(labels, points).wrong_pixels > 100
    diagram.fill(seeds, "jfa+2")
    assert diagram.errors().wrong_pixels == diagram.errors("snapped").wrong_pixels < 30
    assert diagram.errors("true").wrong_pixels > 100
    diagram.fill(vorocl.Seeds(points, (50, 60), snap=True))
    assert diagram.errors().wrong_pixels == 0 < diagram.errors("true").wrong_pixels
    diagram.write(labels, seeds)
    assert diagram.errors("true").wrong_pixels == 0 < diagram.errors().wrong_pixels


@pytest.mark.parametrize("periodic", [(False, False), (True, True)])
@pytest.mark.parametrize("metric", ["euclidean", "manhattan"])
def test_measures_are_of_the_points_themselves(metric, periodic):
    points = rng.uniform(0, SHAPE[::-1], (900, 2))
    plane = dict(metric=metric, periodic=periodic, snap=False)
    labels = brute_force(points, SHAPE, periodic, metric, snap=False)
    cells = vorocl.cells(points, SHAPE, **plane)
    np.testing.assert_array_equal(np.column_stack([cells["x"], cells["y"]]), rounded(points, snap=False))
    np.testing.assert_array_equal(cells["area"], np.bincount(labels.ravel(), minlength=900))
    apart = offsets(pixel_centres(SHAPE), rounded(points, snap=False)[labels.ravel()], SHAPE, periodic)
    distances = np.hypot(*apart.T) if metric == "euclidean" else apart.sum(axis=1)
    np.testing.assert_allclose(vorocl.distances(points, SHAPE, **plane).ravel(), distances, rtol=1e-6)
    farthest = np.zeros(900)
    np.maximum.at(farthest, labels.ravel(), distances)
    full = cells["area"] > 0
    np.testing.assert_allclose(cells["largest_distance"][full], farthest[full], rtol=1e-6)
    assert full.sum() > vorocl.areas(points, SHAPE, metric=metric, periodic=periodic, snap=True).astype(bool).sum()


def test_measures_know_the_points_outside():
    points = rng.uniform(-50, 150, (90, 2))
    labels = brute_force(points, SHAPE)
    cells = vorocl.cells(points, SHAPE)
    np.testing.assert_array_equal(cells["area"], np.bincount(labels.ravel(), minlength=90))
    np.testing.assert_array_equal(cells["x"], rounded(points)[:, 0])
    apart = offsets(pixel_centres(SHAPE), rounded(points)[labels.ravel()], SHAPE, (False, False))
    np.testing.assert_allclose(vorocl.distances(points, SHAPE).ravel(), np.hypot(*apart.T), rtol=1e-6)
    wrong = vorocl.errors(labels, points, truth="true")
    assert wrong.wrong_pixels == 0 and f"(pixels={labels.size}, wrong_pixels=0," in repr(wrong)
    pairs, lengths = vorocl.adjacency(points, SHAPE)
    assert lengths.sum() == (labels[1:] != labels[:-1]).sum() + (labels[:, 1:] != labels[:, :-1]).sum()
    with pytest.raises(vorocl.BadArgument, match="outside"):
        vorocl.relax(points, SHAPE)


def test_what_is_masked_does_not_count_or_is_refused():
    density = np.ma.array(np.ones((4, 8)), mask=False)
    density.data[:, :6] = 1e9
    density[:, :6] = np.ma.masked
    found = vorocl.relax([(1, 1), (6, 2)], (4, 8), density=density)
    np.testing.assert_array_equal(found.points, vorocl.relax([(1, 1), (6, 2)], (4, 8), density=density.filled(0)).points)
    labels = np.ma.array(np.zeros((4, 8), np.uint32), mask=np.eye(4, 8))
    for call in (lambda: vorocl.similarity(labels, labels.data), lambda: vorocl.errors(labels, [(1, 1)])):
        with pytest.raises(vorocl.BadArgument, match="must not be masked"):
            call()
