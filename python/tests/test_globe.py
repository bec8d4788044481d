"""Great circles, against brute force by unit vectors and the haversine."""

import numpy as np
import pytest

import vorocl

RADIUS = 6371.0088
METRIC = {"metric": "great-circle"}


def places(count, seed=1):
    rng = np.random.default_rng(seed)
    return np.column_stack([rng.uniform(-180, 180, count), np.degrees(np.arcsin(rng.uniform(-1, 1, count)))])


def vectors(degrees):
    lon, lat = np.radians(degrees).T
    return np.column_stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])


def centres(shape, bounds, y_up):
    (height, width), (x0, y0, x1, y1) = shape, bounds
    y, x = np.indices(shape) + 0.5
    y = height - y if y_up else y
    return np.column_stack([(x0 + x * (x1 - x0) / width).ravel(), (y0 + y * (y1 - y0) / height).ravel()])


def ways(a, b):
    """Kilometres from each of `a` to each of `b`."""
    chords = np.linalg.norm(vectors(a)[:, None] - vectors(b)[None], axis=2)
    return 2 * RADIUS * np.arcsin(np.minimum(chords / 2, 1))


@pytest.mark.parametrize("bounds, y_up", [((-180, -90, 180, 90), True), ((170, -50, 200, -20), False)])
def test_labels_and_distances_are_those_of_brute_force(bounds, y_up):
    points, shape = places(80), (30, 60)
    grid = vorocl.Grid(shape, bounds=bounds, y_up=y_up)
    all_ways = ways(centres(shape, bounds, y_up), points)
    labels = vorocl.diagram(points, grid, **METRIC)
    chosen = all_ways[np.arange(labels.size), labels.ravel()]
    assert (chosen - all_ways.min(axis=1)).max() < 2e-5
    distances = vorocl.distances(points, grid, **METRIC)
    np.testing.assert_allclose(distances.ravel(), chosen, rtol=1e-6, atol=1e-5)
    cells = vorocl.cells(points, grid, **METRIC)
    np.testing.assert_array_equal(cells["pixels"], np.bincount(labels.ravel(), minlength=80))
    np.testing.assert_array_equal(vorocl.areas(points, grid, **METRIC), cells["area"])
    filled = cells["pixels"] > 0
    np.testing.assert_array_equal(
        cells["largest_distance"][filled],
        [distances[labels == id].max() for id in np.flatnonzero(filled)],
    )
    assert np.isnan(cells["largest_distance"][~filled]).all()


def test_the_globe_is_the_default_and_goes_round():
    points = places(40, 2)
    labels = vorocl.diagram(points, (18, 36), **METRIC)
    whole = vorocl.Grid((18, 36), bounds=(-180, -90, 180, 90))
    np.testing.assert_array_equal(labels, vorocl.diagram(points, whole, **METRIC))
    np.testing.assert_array_equal(labels, vorocl.diagram(points + (360, 0), whole, **METRIC))
    assert vorocl.areas(points, (18, 36), **METRIC).sum() == pytest.approx(4 * np.pi * RADIUS**2)
    pairs, lengths = vorocl.adjacency(points, (18, 36), units="pixels", **METRIC)
    beside = {tuple(sorted(pair)) for pair in zip(labels.ravel(), np.roll(labels, -1, axis=1).ravel())}
    below = {tuple(sorted(pair)) for pair in zip(labels[1:].ravel(), labels[:-1].ravel())}
    assert {tuple(pair) for pair in pairs.tolist()} == {pair for pair in beside | below if pair[0] != pair[1]}
    assert abs(vorocl.vertices(points, (18, 36), **METRIC)).max() <= 180


def test_objects_know_the_globe():
    points = places(20, 3)
    points[4] = np.nan
    grid = vorocl.Grid((18, 36), bounds=(-180, -90, 180, 90), periodic=(True, False))
    seeds = vorocl.Seeds(points, grid)
    diagram = vorocl.Diagram(grid)
    diagram.fill(seeds, metric="great-circle")
    cells = diagram.cells()
    assert np.isnan(cells["x"][4]) and cells["area"][4] == 0
    other = vorocl.Diagram(grid)
    other.write(diagram.read(), seeds, "great-circle")
    np.testing.assert_array_equal(other.areas(), cells["area"])
    diagram.fill(seeds)
    assert "perimeter" in diagram.cells().dtype.names and "perimeter" not in cells.dtype.names


@pytest.mark.parametrize(
    "arguments, says",
    [
        ({"method": "jfa"}, "great circles"),
        ({"outside": "refuse"}, "outside='refuse'"),
        ({"periodic": (True, False)}, "periodic by themselves"),
        ({"bounds": (0, 0, 361, 90)}, "no longer than 360"),
        ({"bounds": (0, 0, 36, 91)}, "-90 to 90"),
        ({"bounds": (170, -50, -170, 50)}, r"date line .*\(170.0, -50.0, 190.0, 50.0\)"),
    ],
)
def test_what_is_not_of_the_globe_is_refused(arguments, says):
    with pytest.raises(vorocl.BadArgument, match=says):
        vorocl.diagram([(1, 1)], (9, 9), **METRIC, **arguments)


def test_without_bounds_all_show_the_globe_or_refuse():
    points = np.array([(-120, 30), (100, -20), (7, 80)], float)
    labels = vorocl.diagram(points, (18, 36), **METRIC)
    np.testing.assert_array_equal(vorocl.Simulation((18, 36), **METRIC).step(points).read(), labels)
    with pytest.raises(vorocl.BadArgument, match="seeds in degrees: give them bounds"):
        vorocl.Diagram((18, 36)).fill(vorocl.Seeds(points, (18, 36)), **METRIC)
    with pytest.raises(vorocl.BadArgument, match="seeds in degrees: give them bounds"):
        vorocl.Diagram((18, 36)).write(labels, vorocl.Seeds(points, (18, 36)), **METRIC)
    with pytest.raises(vorocl.BadArgument, match="pixels of a mask"):
        vorocl.from_mask(np.eye(5), **METRIC)


def test_latitudes_beyond_a_pole_are_named():
    with pytest.raises(vorocl.BadPoint, match="point 1 .*-90 to 90"):
        vorocl.diagram([(1, 1), (2, 91)], (9, 9), **METRIC)


def test_measures_that_are_of_planes_are_refused():
    with pytest.raises(vorocl.BadArgument, match="great circles distances are in kilometres"):
        vorocl.distances([(1, 1)], (9, 9), units="pixels", **METRIC)
    with pytest.raises(vorocl.BadArgument, match='units="pixels"'):
        vorocl.adjacency([(1, 1)], (9, 9), **METRIC)
    labels = vorocl.diagram([(1, 1), (50, 3)], (9, 9), **METRIC)
    with pytest.raises(vorocl.BadArgument, match="great circles.*similarity"):
        vorocl.errors(labels, [(1, 1), (50, 3)], bounds=(-180, -90, 180, 90), **METRIC)
