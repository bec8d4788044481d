"""Labels, against brute force and SciPy's k-d tree."""

import pickle
import re
from dataclasses import replace

import numpy as np
import pytest
from oracles import assert_nearest, brute_force, from_below

import vorocl

AXES = [(False, False), (True, False), (False, True), (True, True)]
rng = np.random.default_rng(17)


@pytest.mark.parametrize("metric", ["euclidean", "manhattan"])
@pytest.mark.parametrize("periodic", AXES)
@pytest.mark.parametrize("snap", [True, False])
@pytest.mark.parametrize("count, shape", [(1, (5, 9)), (12, (31, 17)), (300, (40, 63))])
def test_ties_fall_as_defined(count, shape, snap, periodic, metric):
    points = rng.uniform(0, shape[::-1], (count, 2))  # many share a pixel
    points[: count // 2] = np.round(points[: count // 2] * 2) / 2 % shape[::-1]  # and pixels are equally near to some
    labels = vorocl.diagram(points, shape, periodic=periodic, metric=metric, snap=snap)
    assert labels.dtype == np.uint32 and labels.shape == shape
    np.testing.assert_array_equal(labels, brute_force(points, shape, periodic, metric, snap))


@pytest.mark.parametrize("metric", ["euclidean", "manhattan"])
@pytest.mark.parametrize("periodic", AXES)
@pytest.mark.parametrize("snap", [True, False])
def test_the_k_d_tree_finds_nothing_nearer(snap, periodic, metric):
    points = rng.uniform(0, (511, 300), (2000, 2))
    labels = vorocl.diagram(points, (300, 511), periodic=periodic, metric=metric, snap=snap)
    assert_nearest(labels, points, periodic, metric, snap)


def test_points_of_one_pixel_own_pixels_each():
    points = np.array([(20.125, 20.5), (20.875, 20.5), (20.5, 20.125), (20.5, 20.875)])
    labels = vorocl.diagram(points, (41, 41), snap=False)
    assert (labels[20, [0, 40]] == (0, 1)).all() and (labels[[0, 40], 20] == (2, 3)).all()
    assert (vorocl.diagram(points, (41, 41), snap=True) == 0).all()
    assert (vorocl.diagram(points, (41, 41), method="jfa") == 0).all()


@pytest.mark.parametrize("snap", [True, False])
@pytest.mark.parametrize("periodic", [(False, False), (True, False)])
def test_bounds_make_positions_in_pixels(periodic, snap):
    points = rng.uniform((-1, -1), (1, 1), (300, 2))
    labels = vorocl.diagram(points, (50, 70), bounds=(-1, -1, 1, 1), periodic=periodic, y_up=True, snap=snap)
    pixels = (points + 1) * (35, 25)
    pixels[:, 1] = from_below(pixels[:, 1], 50)
    np.testing.assert_array_equal(labels, brute_force(pixels, (50, 70), periodic, snap=snap))


FLOODING = ["standard-flooding", "jfa", "jfa+1", "jfa+2", "1+jfa", "djfa", "low-resolution"]


@pytest.mark.parametrize("method", FLOODING)
def test_methods_that_flood_take_no_points_within_pixels(method):
    for call in vorocl.diagram, vorocl.cells, vorocl.areas, vorocl.relax:
        with pytest.raises(vorocl.BadArgument, match=f'"{re.escape(method)}".*snap=False is for "exact"'):
            call([(1, 1)], (4, 8), method=method, snap=False)
    with pytest.raises(vorocl.BadArgument, match="snap=False"):
        vorocl.Simulation((4, 8), method=method, snap=False)
    points = rng.uniform(0, 64, (50, 2))
    expected = vorocl.diagram(np.floor(points) + 0.5, (64, 64), method=method)
    for snap in None, True:
        np.testing.assert_array_equal(vorocl.diagram(points, (64, 64), method=method, snap=snap), expected)
    diagram = vorocl.Diagram((64, 64))
    diagram.fill(vorocl.Seeds(points, (64, 64), snap=False), method)
    np.testing.assert_array_equal(diagram.read(), expected)


@pytest.mark.parametrize("method", FLOODING)
def test_methods_that_flood_are_nearly_right(method):
    points = rng.uniform(0, 128, (60, 2))
    vorocl.diagram(rng.uniform(0, 128, (60, 2)), (128, 128), method=method)
    labels = vorocl.diagram(points, (128, 128), method=method)
    assert vorocl.similarity(labels, brute_force(points, (128, 128), snap=True)) > 98
    again = vorocl.diagram(points, (128, 128), method=method)
    np.testing.assert_array_equal(labels, again)  # whatever the call before was


def test_rows_with_nan_are_absent():
    points = np.array([[1, 1], [np.nan, 2], [3, np.nan], [8, 5], [np.nan, np.nan]])
    labels = vorocl.diagram(points, (7, 10))
    np.testing.assert_array_equal(labels, brute_force(points, (7, 10)))
    masked = np.ma.masked_array(np.nan_to_num(points, nan=4), np.isnan(points))
    np.testing.assert_array_equal(labels, vorocl.diagram(masked, (7, 10)))


def test_no_points_leave_no_label():
    for none in [], np.empty((0, 2)), [[np.nan, np.nan]]:
        assert (vorocl.diagram(none, (3, 5)) == vorocl.NO_LABEL).all()
    assert np.isinf(vorocl.distances([], (3, 5))).all()


def test_bounds_map_to_pixels():
    points = rng.uniform((-180, -90), (180, 90), (50, 2))
    points[0] = 180, 90  # falls in the last pixel where points outside are refused
    pixels = np.minimum((points + (180, 90)) * (144, 72) / (360, 180), np.nextafter((144, 72), 0))
    plane = vorocl.Grid((72, 144), bounds=(-180, -90, 180, 90))
    np.testing.assert_array_equal(vorocl.diagram(points, plane, outside="refuse"), brute_force(pixels, (72, 144)))
    upside_down = vorocl.diagram(points, replace(plane, y_up=True), outside="refuse")
    pixels[:, 1] = from_below(pixels[:, 1], 72)
    np.testing.assert_array_equal(upside_down, brute_force(pixels, (72, 144)))


def test_a_grid_is_what_its_shape_and_keywords_say():
    frame = dict(bounds=(0, 0, 2, 1), periodic=[np.bool_(True), True], tilt=0.5, y_up=True)
    grid = vorocl.Grid((20, 40), **frame)
    assert grid == pickle.loads(pickle.dumps(grid)) == vorocl.Grid([20, 40], **frame) != vorocl.Grid((20, 40))
    assert grid == vorocl.Seeds([], (20, 40), **frame).grid and hash(grid) == hash(replace(grid, tilt=0.5))
    points = rng.uniform(0, (2, 1), (30, 2))
    for function in vorocl.diagram, vorocl.distances, vorocl.cells, vorocl.areas, vorocl.vertices:
        np.testing.assert_array_equal(function(points, grid), function(points, (20, 40), **frame))
    np.testing.assert_array_equal(vorocl.adjacency(points, grid)[1], vorocl.adjacency(points, (20, 40), **frame)[1])
    assert vorocl.errors(vorocl.diagram(points, grid), points, grid, truth="true").wrong_pixels == 0
    moved = vorocl.Simulation(grid).step(points).read()
    np.testing.assert_array_equal(moved, vorocl.diagram(points, grid))
    with pytest.raises(vorocl.BadArgument, match="bounds and y_up must be said in the vorocl.Grid"):
        vorocl.areas(points, grid, bounds=(0, 0, 1, 1), y_up=False)
    with pytest.raises(TypeError, match="unexpected keyword argument 'shape'"):
        vorocl.areas(points, grid, shape=(20, 40))


def test_y_goes_up_in_pixels():
    points = rng.uniform(0, (40, 30), (20, 2))
    flipped = np.column_stack([points[:, 0], from_below(points[:, 1], 30)])
    np.testing.assert_array_equal(vorocl.diagram(points, (30, 40), y_up=True), brute_force(flipped, (30, 40)))


@pytest.mark.parametrize("bounds", [None, (0, 0, 40, 30), (-20.0, 5.0, 20.0, 35.0)])
def test_points_wrap_along_periodic_axes(bounds):
    points = np.round(rng.uniform(0, (40, 30), (20, 2)) * 1024) / 1024 + ((bounds or (0, 0))[:2])
    periods = rng.integers(-3, 4, (20, 2)) * (40, 30)
    inside = vorocl.diagram(points, (30, 40), periodic=(True, True), bounds=bounds)
    wrapped = vorocl.diagram(points + periods, (30, 40), periodic=(True, True), bounds=bounds)
    np.testing.assert_array_equal(inside, wrapped)
    edge = vorocl.diagram([(-1e-20, 3)], (30, 40), periodic=(True, False))  # -1e-20 + 40 is 40
    assert (edge == 0).all()


def test_points_outside_are_named():
    points = np.full((9, 2), 3.0)
    for bad, bounds in [((10, 3), None), ((3, -0.001), None), ((np.inf, 1), None), ((5.001, 2), (0, 0, 5, 5))]:
        points[7] = bad
        with pytest.raises(vorocl.BadPoint, match="point 7") as caught:
            vorocl.diagram(points, (6, 10), bounds=bounds, outside="refuse")
        assert caught.value.row == 7 and caught.value.value == bad


@pytest.mark.parametrize("metric", ["euclidean", "manhattan"])
@pytest.mark.parametrize("bounds", [None, (0, 0, 40, 30), (-20.0, 5.0, 60.0, 65.0)])
def test_points_outside_count(bounds, metric):
    shape = (30, 40)
    x0, y0, x1, y1 = bounds or (0, 0, 40, 30)
    extent = np.array([x1 - x0, y1 - y0])
    points = rng.uniform((x0, y0) - extent, (x1, y1) + extent, (60, 2))
    points[0] = x1, y1  # the corner of the first pixel that is outside
    pixels = (points - (x0, y0)) * (40, 30) / extent
    labels = vorocl.diagram(points, shape, bounds=bounds, metric=metric)
    np.testing.assert_array_equal(labels, brute_force(pixels, shape, metric=metric))
    assert_nearest(labels, pixels, metric=metric)
    pixels[:, 1] = from_below(pixels[:, 1], 30)
    upside_down = vorocl.diagram(points, shape, bounds=bounds, metric=metric, y_up=True)
    np.testing.assert_array_equal(upside_down, brute_force(pixels, shape, metric=metric))


def test_one_far_point_owns_the_window():
    assert (vorocl.diagram([(2e9, -2e9)], (3, 5), snap=True) == 0).all()
    assert (vorocl.diagram([(2e9, -2e9), (-1, 1)], (3, 5)) == 1).all()
    with pytest.raises(vorocl.BadArgument, match="snap"):
        vorocl.diagram([(2e9, -2e9)], (3, 5), snap=False)
    with pytest.raises(vorocl.BadPoint, match="point 1"):
        vorocl.diagram([(0, 0), (2.0**31, 0)], (3, 5))
    assert (vorocl.diagram([(2, 2)], (3, 5)) == 0).all()  # the window before is forgotten


@pytest.mark.parametrize("method", ["jfa", "djfa", "standard-flooding"])
def test_methods_that_flood_refuse_points_outside(method):
    with pytest.raises(vorocl.BadArgument, match="outside"):
        vorocl.diagram([(0, 0), (-1, 2)], (4, 8), method=method)


@pytest.mark.parametrize("periodic", [(True, False), (False, True)])
def test_points_outside_count_along_the_other_axis_of_a_periodic_grid(periodic):
    points = rng.uniform((-60, -45), (100, 75), (80, 2))
    labels = vorocl.diagram(points, (30, 40), periodic=periodic)
    inside = points % [size if axis else 2**20 for axis, size in zip(periodic, (40, 30))]
    inside -= np.where(inside > 2**19, 2**20, 0)
    np.testing.assert_array_equal(labels, brute_force(inside, (30, 40), periodic))
    bounded = vorocl.diagram([(0, 0), (20, 4)], (4, 8), bounds=(0, 0, 8, 4), periodic=(True, False))
    np.testing.assert_array_equal(bounded, brute_force([(0, 0), (4, np.nextafter(4, 0))], (4, 8), (True, False)))


@pytest.mark.parametrize("bounds", [None, (0, 0, 40, 30)])
def test_points_outside_are_absent(bounds):
    points = rng.uniform(-20, 60, (60, 2))
    within = ((points >= 0) & (points < (40, 30))).all(axis=1)
    labels = vorocl.diagram(points, (30, 40), bounds=bounds, outside="absent", method="jfa+2")
    expected = brute_force(np.where(within[:, None], points, np.nan), (30, 40), snap=True)
    assert vorocl.similarity(labels, expected) > 99
    assert vorocl.Seeds(points, (30, 40), bounds=bounds, outside="absent").alive == within.sum()


def test_labels_go_where_they_are_wanted():
    points = rng.uniform(0, 50, (10, 2))
    out = np.zeros((50, 50), np.uint32)
    assert vorocl.diagram(points, (50, 50), out=out) is out
    first = out.copy()
    assert (vorocl.diagram(points, (50, 50)) == first).all()
    second = np.empty_like(out)
    vorocl.diagram(points[:1], (50, 50), out=second)
    assert (second == 0).all() and (out == first).all()  # each call has its array alone
    for method in ("jfa", "djfa", "standard-flooding"):
        vorocl.diagram(points, (50, 50), method=method, out=second)
        assert (second == vorocl.diagram(points, (50, 50), method=method)).all()
    np.testing.assert_array_equal(out, brute_force(points, (50, 50)))


@pytest.mark.parametrize("dtype", ["f4", ">f8", "i2", "u8", "f2"])
def test_points_of_all_types_and_strides(dtype):
    points = rng.integers(0, 20, (15, 2))
    expected = brute_force(points, (20, 20))
    wide = np.zeros((15, 5), points.dtype)
    wide[:, 3::-2] = points
    packed = np.zeros(15, [("flag", "i1"), ("xy", dtype, 2)])  # its numbers are not aligned
    packed["xy"] = points
    np.testing.assert_array_equal(vorocl.diagram(packed["xy"], (20, 20)), expected)
    layouts = points, np.asfortranarray(points), points[::-1][::-1], points.repeat(2, 0)[::2], points.tolist()
    for layout in *layouts, wide[:, 3::-2], np.ascontiguousarray(points[::-1])[::-1]:
        np.testing.assert_array_equal(vorocl.diagram(np.array(layout, dtype), (20, 20)), expected)
        np.testing.assert_array_equal(vorocl.diagram(layout, (20, 20)), expected)
    fixed = points.astype(dtype)
    fixed.flags.writeable = False
    np.testing.assert_array_equal(vorocl.diagram(fixed, (20, 20)), expected)


def test_shapes_are_numbers_of_any_kind():
    wanted = vorocl.diagram([(1, 1)], (3, 4))
    for shape in [3, 4], np.array([3, 4]), (np.int64(3), np.uint8(4)):
        np.testing.assert_array_equal(vorocl.diagram([(1, 1)], shape), wanted)
