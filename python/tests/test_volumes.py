"""Volumes: labels against brute force and SciPy's k-d tree, measures against scikit-image."""

import numpy as np
import pytest
import vorocl
from oracles import PARTS, rounded
from scipy import ndimage
from scipy.spatial import cKDTree
from skimage import measure

SHAPES = [(9, 14, 23), (40, 33, 37)]


def brute_force(points, shape, snap=False):
    """The row of the nearest point, in whole numbers of 1/4096 voxel; ties by z, y, x, row."""
    places = np.round(rounded(points, snap) * PARTS).astype(np.int64)
    z, y, x = np.indices(shape) * PARTS + PARTS // 2
    order = np.lexsort((np.arange(len(places)), places[:, 0], places[:, 1], places[:, 2]))
    distances = [(x - i) ** 2 + (y - j) ** 2 + (z - k) ** 2 for i, j, k in places[order]]
    return order[np.argmin(distances, axis=0)].astype(np.uint32)


def points_in(shape, count, seed):
    return np.random.default_rng(seed).uniform(0, shape[::-1], (count, 3))


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("count", [1, 5, 60])
@pytest.mark.parametrize("snap", [True, False])
def test_labels_are_those_of_brute_force(shape, count, snap):
    points = points_in(shape, count, count)
    assert np.array_equal(vorocl.diagram(points, shape, snap=snap), brute_force(points, shape, snap))


def power_of(points, weights, shape, labels, is_periodic):
    """Of each voxel, the squared distance to its point less the weight, the shorter way round."""
    sides = np.array(shape[::-1])
    ways = abs(np.stack(np.indices(shape), axis=-1)[..., ::-1] + 0.5 - points[labels])
    return (np.minimum(ways, sides - ways if is_periodic else np.inf) ** 2).sum(-1) - weights[labels]


@pytest.mark.parametrize("is_periodic", [True, False])
@pytest.mark.parametrize("on_grid", [True, False])
@pytest.mark.parametrize("side", [1, 6, 40])  # of the heaviest
def test_weighted_labels_are_those_of_a_k_d_tree_of_four_dimensions(is_periodic, on_grid, side):
    """As DAMASK has it: the root of what a weight lacks to the greatest is a coordinate."""
    shape, rng = (40, 50, 60), np.random.default_rng(side)
    points, weights = points_in(shape, 400, side), rng.uniform(0, side**2, 400)
    if on_grid:
        points, weights = np.floor(points * PARTS) / PARTS, np.floor(weights * 2048) / 2048
    box = [*shape[::-1], 10 * side + 1000] if is_periodic else None
    tree = cKDTree(np.column_stack((points, np.sqrt(weights.max() - weights))), boxsize=box)
    centres = np.stack(np.indices(shape), axis=-1)[..., ::-1].reshape(-1, 3) + 0.5
    expected = tree.query(np.column_stack((centres, np.zeros(len(centres)))))[1].reshape(shape)
    labels = vorocl.diagram(points, shape, periodic=(is_periodic,) * 3, weights=weights)
    lead = [power_of(points, weights, shape, each, is_periodic) for each in (labels, expected)]
    assert np.max(lead[0] - lead[1]) < (1e-9 if on_grid else 0.02)
    assert np.mean(labels != expected) < 1e-3
    scaled = vorocl.diagram(
        points / 8, shape, periodic=(is_periodic,) * 3, weights=weights / 64, bounds=(0, 0, 0, 7.5, 6.25, 5)
    )
    np.testing.assert_array_equal(scaled, labels)


def test_weights_of_planes_and_of_frames():
    rng = np.random.default_rng(5)
    points, weights = rng.uniform(0, 64, (200, 2)), rng.uniform(0, 30, 200)
    rows, columns = np.indices((64, 64)) + 0.5
    labels = vorocl.diagram(points, (64, 64), weights=weights)
    simulation = vorocl.Simulation((64, 64))
    for shift in range(3):
        moved = simulation.step(points + shift, weights=weights * shift)
        powers = (columns[..., None] - points[:, 0] - shift) ** 2 + (rows[..., None] - points[:, 1] - shift) ** 2
        powers -= weights * shift
        found = np.take_along_axis(powers, moved.read()[..., None].astype(int), axis=-1)[..., 0]
        assert np.max(found - powers.min(axis=-1)) < 0.02
    with pytest.raises(vorocl.BadArgument, match="give each a weight"):
        simulation.step(points)
    np.testing.assert_array_equal(vorocl.diagram(points, (64, 64), weights=weights + 7), labels)
    np.testing.assert_array_equal(vorocl.areas(points, (64, 64), weights=weights), np.bincount(labels.ravel(), minlength=200))
    np.testing.assert_array_equal(
        vorocl.diagram(points, (64, 64), weights=np.full(200, 3)), vorocl.diagram(points, (64, 64))
    )
    for method, words in (dict(method="jfa"), "jfa"), (dict(metric="manhattan"), "Euclidean"), (dict(snap=True), "snapped"):
        with pytest.raises(vorocl.BadArgument, match=words):
            vorocl.diagram(points, (64, 64), weights=weights, **method)
    with pytest.raises(vorocl.BadArgument, match="squares"):
        vorocl.diagram(points, (64, 64), bounds=(0, 0, 64, 32), weights=weights)


@pytest.mark.parametrize("shape", [(60, 50, 70), (3, 1, 40)])
@pytest.mark.parametrize("count", [1, 20, 3000])
@pytest.mark.parametrize("snap", [True, False])
def test_periodic_labels_are_those_of_a_k_d_tree(shape, count, snap):
    points = points_in(shape, count, count)
    box = dict(periodic=(True, True, True), snap=snap)
    labels = vorocl.diagram(points + 3 * np.array(shape[::-1]), shape, **box)
    centres = np.stack(np.indices(shape), axis=-1)[..., ::-1].reshape(-1, 3) + 0.5
    places = rounded(points, snap)
    nearest, _ = cKDTree(places, boxsize=shape[::-1]).query(centres)
    apart = abs(centres - places[labels.ravel()])
    apart = np.minimum(apart, np.array(shape[::-1]) - apart)
    np.testing.assert_allclose(np.sqrt((apart**2).sum(1)), nearest, rtol=1e-12)
    np.testing.assert_allclose(vorocl.distances(points, shape, **box).ravel(), nearest, rtol=1e-6, atol=1e-9)
    truth = "snapped" if snap else "true"
    assert vorocl.errors(labels, points, periodic=(True, True, True), truth=truth).wrong_pixels == 0


@pytest.mark.parametrize("kind", ["line", "sphere", "one voxel", "one point"])
def test_crowds_have_no_farther_label(kind):
    shape, rng = (40, 50, 45), np.random.default_rng(8)
    points = np.full((4000, 3), 20.3)
    if kind == "line":
        points[:, 0] = rng.uniform(0, 45, 4000)
    if kind == "sphere":
        away = rng.normal(size=(4000, 3))
        points += 15 * away / np.linalg.norm(away, axis=1)[:, None]
    if kind == "one voxel":
        points = 20 + rng.uniform(0, 1, (4000, 3))
    labels, places = vorocl.diagram(points, shape), rounded(points)
    centres = np.stack(np.indices(shape), axis=-1)[..., ::-1].reshape(-1, 3) + 0.5
    nearest = cKDTree(np.unique(places, axis=0)).query(centres)[0]
    np.testing.assert_allclose(np.linalg.norm(centres - places[labels.ravel()], axis=1), nearest, rtol=1e-12)
    if kind == "one point":
        assert (labels == 0).all()


def test_jump_flooding_is_judged_by_exact_labels():
    shape = (30, 40, 50)
    points = points_in(shape, 80, 1)
    flooded = vorocl.diagram(points, shape, method="jfa")
    expected = brute_force(points, shape, snap=True)
    assert 99 < vorocl.similarity(flooded, expected) <= 100


def test_errors_and_distances():
    shape = (12, 20, 30)
    points = points_in(shape, 40, 2)
    assert vorocl.errors(brute_force(points, shape), points, truth="true").wrong_pixels == 0
    assert vorocl.errors(brute_force(points, shape), points).wrong_pixels > 0
    labels = brute_force(points, shape, snap=True)
    assert vorocl.errors(labels, points).wrong_pixels == 0
    labels[5, 6, 7] = 39 if labels[5, 6, 7] != 39 else 38
    assert vorocl.errors(labels, points).wrong_pixels == 1
    voxels = np.ones(shape)
    x, y, z = np.floor(points).astype(int).T
    voxels[z, y, x] = 0
    snapped = vorocl.distances(points, shape, snap=True)
    assert np.allclose(snapped, ndimage.distance_transform_edt(voxels), rtol=1e-6)
    assert abs(vorocl.distances(points, shape) - snapped).max() > 0.3


def test_objects_take_volumes():
    shape = (6, 7, 8)
    seeds = vorocl.Seeds([(1.2, 2.5, 3.9), (np.nan, 0, 0), (7, 6, 5)], shape)
    assert seeds.alive == 2
    assert np.array_equal(seeds.read(), rounded([(1.2, 2.5, 3.9), (np.nan,) * 3, (7, 6, 5)]), equal_nan=True)
    simulation = vorocl.Simulation(shape)
    simulation.step([(0, 0, 0), (4, 4, 4)])
    assert simulation.step([(0, 0, 3), (4, 4, 4)]).read().shape == shape
    assert simulation.diagram.cells()["area"].sum() == 6 * 7 * 8
    assert simulation.seeds.move_to([(0, 0, 0), (4, 4, 4)]) == 3


@pytest.mark.parametrize("shape", SHAPES)
def test_cells_are_those_of_scikit_image(shape):
    points = points_in(shape, 40, 5)
    points[7] = np.nan
    diagram = vorocl.Diagram(shape)
    diagram.fill(vorocl.Seeds(points, shape), method="jfa")
    labels, cells = diagram.read(), diagram.cells()
    assert cells.dtype == vorocl.CELL
    assert np.isnan(cells["x"][7]) and cells["area"][7] == 0 and np.isnan(cells["centroid_z"][7])
    assert np.array_equal(diagram.areas(), cells["area"])
    x, y, z = rounded(points).T  # the points, where their voxels' centres were flooded
    for name, expected in ("x", x), ("y", y), ("z", z):
        assert np.array_equal(cells[name], expected, equal_nan=True)
    distances = diagram.distances()
    for region in measure.regionprops(labels.astype(int) + 1):
        cell = cells[region.label - 1]
        assert cell["area"] == region.area
        centroid = [cell["centroid_z"], cell["centroid_y"], cell["centroid_x"]]
        assert np.allclose(centroid, np.array(region.centroid) + 0.5, rtol=1e-12)
        first, last = region.bbox[:3], np.array(region.bbox[3:]) - 1
        assert [cell["front"], cell["top"], cell["left"]] == list(first)
        assert [cell["back"], cell["bottom"], cell["right"]] == list(last)
        assert cell["touches_border"] == (0 in first or (last == np.array(shape) - 1).any())
        assert np.isclose(cell["largest_distance"], distances[labels == region.label - 1].max(), rtol=1e-6)


@pytest.mark.parametrize("shape", SHAPES)
def test_adjacent_cells_share_faces(shape):
    points = points_in(shape, 40, 6)
    diagram = vorocl.Diagram(shape)
    diagram.fill(vorocl.Seeds(points, shape), method="jfa")
    labels, expected = diagram.read(), {}
    for axis in range(3):
        beside = np.moveaxis(labels, axis, 0)
        for a, b in zip(beside[:-1].ravel().tolist(), beside[1:].ravel().tolist()):
            if a != b:
                pair = min(a, b), max(a, b)
                expected[pair] = expected.get(pair, 0) + 1
    pairs, areas = diagram.adjacency()
    assert dict(zip(map(tuple, pairs.tolist()), areas.tolist())) == expected
    surface = np.zeros(40, int)
    for pair, faces in expected.items():
        surface[list(pair)] += faces
    assert np.array_equal(diagram.cells()["perimeter"], surface)


def test_volumes_lie_in_the_units_of_the_points():
    rng = np.random.default_rng(3)
    shape, bounds = (6, 7, 8), (-1.0, 10.0, 5.0, 3.0, 13.5, 8.0)  # 2 voxels in a unit
    low, high = np.array(bounds[:3]), np.array(bounds[3:])
    points = rng.uniform(low, high, (20, 3))
    points[0] = high  # the far end is inside
    voxels = np.minimum((points - low) * 2, np.array(shape[::-1]) - 1 / PARTS)
    pixels, data = vorocl.cells(voxels, shape), vorocl.cells(points, shape, bounds=bounds)
    assert np.array_equal(vorocl.diagram(points, shape, bounds=bounds), vorocl.diagram(voxels, shape))
    np.testing.assert_allclose(data["area"], pixels["area"] / 8)
    np.testing.assert_allclose(data["perimeter"], pixels["perimeter"] / 4)
    np.testing.assert_allclose(data["largest_distance"], pixels["largest_distance"] / 2)
    for axis, names in enumerate([("x", "centroid_x"), ("y", "centroid_y"), ("z", "centroid_z")]):
        for name in names:
            np.testing.assert_allclose(data[name], low[axis] + pixels[name] / 2)
    full = pixels["area"] > 0
    np.testing.assert_allclose(data["front"][full], low[2] + pixels["front"][full] / 2)
    np.testing.assert_allclose(data["back"][full], low[2] + (pixels["back"][full] + 1) / 2)
    in_pixels = vorocl.cells(points, shape, bounds=bounds, units="pixels")
    for name in vorocl.CELL.names:
        np.testing.assert_array_equal(in_pixels[name], pixels[name])
    np.testing.assert_allclose(vorocl.areas(points, shape, bounds=bounds), data["area"])
    np.testing.assert_allclose(vorocl.distances(points, shape, bounds=bounds), vorocl.distances(voxels, shape) / 2)
    pairs, faces = vorocl.adjacency(points, shape, bounds=bounds)
    assert np.array_equal(pairs, vorocl.adjacency(voxels, shape)[0])
    np.testing.assert_allclose(faces, vorocl.adjacency(voxels, shape)[1] / 4)
    seeds = vorocl.Seeds(points, shape, bounds=bounds, y_up=True)
    np.testing.assert_allclose(seeds.read()[1:], points[1:], atol=0.5 / PARTS)
    np.testing.assert_allclose(seeds.read(units="pixels")[1:, 1], 7 - voxels[1:, 1], atol=1 / PARTS)
    flat = vorocl.cells(points, (6, 7, 16), bounds=bounds)  # voxels are no cubes
    assert "perimeter_px" in flat.dtype.names and flat["area"].sum() == np.prod(high - low)
    with pytest.raises(vorocl.Error, match="no scale"):
        vorocl.distances(points, (6, 7, 16), bounds=bounds)
    outside = np.vstack([points, high + 1])
    with pytest.raises(vorocl.BadPoint, match="point 20"):
        vorocl.diagram(outside, shape, bounds=bounds)
    assert np.array_equal(vorocl.diagram(outside, shape, bounds=bounds, outside="absent"), vorocl.diagram(voxels, shape))
    wrapped = vorocl.Seeds(points + (4, 0, 0), shape, bounds=bounds, periodic=(True, False, False))
    np.testing.assert_allclose(wrapped.read()[1:], vorocl.Seeds(points, shape, bounds=bounds).read()[1:])
    diagram = vorocl.Diagram(shape)
    assert diagram.fill(seeds, "jfa").snapped and diagram.errors().wrong_pixels < 40


WRONG_CALLS = [
    (lambda: vorocl.diagram([(1, 2)], (4, 5, 6)), r"shape \(N, 3\), rows \(x, y, z\)"),
    (lambda: vorocl.diagram([(1, 2, 3)], (5, 6)), r"shape \(N, 2\)"),
    (lambda: vorocl.diagram([(1, 2, 3)], (1, 5, 6)), r"one slice is a plane: give the shape \(5, 6\)"),
    (lambda: vorocl.diagram([(1, 2, 3)], (2, 3, 4, 5)), r"\(H, W\), or three \(D, H, W\)"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), bounds=(0, 0, 1, 1)), "bounds must be six numbers"),
    (lambda: vorocl.diagram([(1, 2)], (5, 6), bounds=(0, 0, 0, 1, 1, 1)), "bounds must be four numbers"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), bounds=(0, 0, 3, 1, 1, 3)), "an extent along all axes"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), tilt=1), "periodic in x and y"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), periodic=(True, False)), "periodic must be three booleans"),
    (lambda: vorocl.diagram([(1, 2)], (5, 6), periodic=(False, False, True)), "periodic must be two booleans"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), method="jfa", snap=False), 'snap=False is for "exact"'),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), method="djfa"), "volume of 6 x 5 x 4 voxels, which flooding"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), metric="manhattan"), "are Euclidean"),
    (lambda: vorocl.diagram([(1, 2, 9)], (4, 5, 6)), "outside the grid"),
    (lambda: vorocl.diagram([(1, 2, 3)], (2000, 2000, 2000)), r"2\^31 in all"),
    (lambda: vorocl.vertices([(1, 2, 3)], (4, 5, 6)), "which the vertices of a diagram cannot take"),
]


@pytest.mark.parametrize("call, words", WRONG_CALLS)
def test_what_volumes_cannot_be_is_refused(call, words):
    with pytest.raises(vorocl.Error, match=words):
        call()


@pytest.mark.parametrize("shape, spacing", [((14, 9, 12), (1, 2, 4)), ((31, 40), (3, 1))])
@pytest.mark.parametrize("periodic", [False, True])
def test_voxels_may_be_longer_along_an_axis(shape, spacing, periodic):
    points = np.floor(np.random.default_rng(3).uniform(0, shape[::-1], (25, len(shape))) * PARTS) / PARTS
    grid = vorocl.Grid(shape, spacing=spacing, periodic=(periodic,) * len(shape))
    apart = abs(np.stack(np.indices(shape)[::-1], -1)[..., None, :] + 0.5 - points)
    apart = np.minimum(apart, np.array(shape[::-1]) - apart) if periodic else apart
    squared = ((apart * spacing) ** 2).sum(-1)
    labels = vorocl.diagram(points, grid)
    np.testing.assert_array_equal(np.take_along_axis(squared, labels[..., None].astype(int), -1)[..., 0], squared.min(-1))
    np.testing.assert_allclose(vorocl.distances(points, grid), np.sqrt(squared.min(-1)), rtol=1e-6)
    assert vorocl.errors(labels, points, grid, truth="true").wrong_pixels == 0

    # The same in the data, whose units are a fifth of these.
    bounds = (0.0,) * len(shape) + tuple(np.array(shape[::-1]) * spacing / 5)
    in_data = vorocl.Grid(shape, bounds=bounds, spacing=spacing, periodic=grid.periodic)
    there = points * spacing / 5
    np.testing.assert_allclose(vorocl.distances(there, in_data), np.sqrt(squared.min(-1)) / 5, rtol=1e-6)
    cells, whole = vorocl.cells(there, in_data), vorocl.cells(points, grid)
    np.testing.assert_allclose(cells["largest_distance"], whole["largest_distance"] / 5, rtol=1e-6)
    np.testing.assert_array_equal(cells["perimeter_px"], whole["perimeter"])
    np.testing.assert_allclose(cells["area"], whole["area"] * np.prod(spacing) / 5.0 ** len(shape))
    with pytest.raises(vorocl.BadArgument, match="lengths have no scale"):
        vorocl.adjacency(there, in_data)


@pytest.mark.parametrize("spacing", [(1, 1), (1, 1, 65), (1, 1, 0), (1, 1, 1.5), 2, "abc", (1, 1, None)])
def test_spacing_is_whole_numbers(spacing):
    with pytest.raises(vorocl.BadArgument, match="spacing must be 3 whole numbers from 1 to 64"):
        vorocl.Grid((4, 5, 6), spacing=spacing)
