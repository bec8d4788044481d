"""Volumes: labels against brute force, and SciPy's and scikit-image's functions of the same names."""

import numpy as np
import pytest
import vorocl
from scipy import ndimage
from scipy.spatial import cKDTree
from skimage import measure, segmentation

SHAPES = [(9, 14, 23), (40, 33, 37)]


def brute_force(points, shape):
    """The row of the nearest voxel; ties by z, y, x, row."""
    voxels = np.floor(points).astype(int)
    z, y, x = np.indices(shape)
    order = np.lexsort((np.arange(len(voxels)), voxels[:, 0], voxels[:, 1], voxels[:, 2]))
    distances = [(x - i) ** 2 + (y - j) ** 2 + (z - k) ** 2 for i, j, k in voxels[order]]
    return order[np.argmin(distances, axis=0)].astype(np.uint32)


def points_in(shape, count, seed):
    return np.random.default_rng(seed).uniform(0, shape[::-1], (count, 3))


def device_is_exact():
    """Exact diagrams of volumes are for CPUs."""
    try:
        vorocl.diagram([(0, 0, 0)], (2, 2, 2))
    except vorocl.BadArgument:
        return False
    return True


exact_alone = pytest.mark.skipif(not device_is_exact(), reason="exact diagrams of volumes are made by CPUs")


@exact_alone
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("count", [1, 5, 60])
def test_labels_are_those_of_brute_force(shape, count):
    points = points_in(shape, count, count)
    assert np.array_equal(vorocl.diagram(points, shape), brute_force(points, shape))


@exact_alone
@pytest.mark.parametrize("shape", [(60, 50, 70), (3, 1, 40)])
@pytest.mark.parametrize("count", [1, 20, 3000])
def test_periodic_labels_are_those_of_a_k_d_tree(shape, count):
    points = points_in(shape, count, count)
    labels = vorocl.diagram(points + 3 * np.array(shape[::-1]), shape, periodic=(True, True, True))
    centres = np.stack(np.indices(shape), axis=-1)[..., ::-1].reshape(-1, 3)
    voxels = np.floor(points)
    nearest, _ = cKDTree(voxels, boxsize=shape[::-1]).query(centres)
    apart = abs(centres - voxels[labels.ravel()])
    apart = np.minimum(apart, np.array(shape[::-1]) - apart)
    assert np.array_equal((apart**2).sum(1), np.round(nearest**2))
    tree = vorocl.distances(points, shape, periodic=(True, True, True))
    assert np.allclose(tree.ravel(), nearest, rtol=1e-6)
    assert vorocl.errors(labels, points, periodic=(True, True, True)).wrong_pixels == 0


def test_jump_flooding_is_judged_by_exact_labels():
    shape = (30, 40, 50)
    points = points_in(shape, 80, 1)
    flooded = vorocl.diagram(points, shape, method="jfa")
    expected = brute_force(points, shape)
    assert 99 < vorocl.similarity(flooded, expected) <= 100


@exact_alone
def test_errors_and_distances():
    shape = (12, 20, 30)
    points = points_in(shape, 40, 2)
    labels = brute_force(points, shape)
    assert vorocl.errors(labels, points).wrong_pixels == 0
    labels[5, 6, 7] = 39 if labels[5, 6, 7] != 39 else 38
    assert vorocl.errors(labels, points).wrong_pixels == 1
    voxels = np.ones(shape)
    x, y, z = np.floor(points).astype(int).T
    voxels[z, y, x] = 0
    assert np.allclose(vorocl.distances(points, shape), ndimage.distance_transform_edt(voxels), rtol=1e-6)


@exact_alone
def test_objects_take_volumes():
    shape = (6, 7, 8)
    seeds = vorocl.Seeds([(1.2, 2.5, 3.9), (np.nan, 0, 0), (7, 6, 5)], shape)
    assert seeds.alive == 2
    assert np.array_equal(seeds.read(), [(1.5, 2.5, 3.5), (np.nan,) * 3, (7.5, 6.5, 5.5)], equal_nan=True)
    simulation = vorocl.Simulation(shape)
    simulation.step([(0, 0, 0), (4, 4, 4)])
    assert simulation.step([(0, 0, 3), (4, 4, 4)]).read().shape == shape
    assert simulation.diagram.cells()["volume"].sum() == 6 * 7 * 8
    assert simulation.seeds.move_to([(0, 0, 0), (4, 4, 4)]) == 3


@pytest.mark.parametrize("shape", SHAPES)
def test_cells_are_those_of_scikit_image(shape):
    points = points_in(shape, 40, 5)
    points[7] = np.nan
    diagram = vorocl.Diagram(shape)
    diagram.fill(vorocl.Seeds(points, shape), method="jfa")
    labels, cells = diagram.read(), diagram.cells()
    assert cells.dtype == vorocl.CELL3
    assert np.isnan(cells["x"][7]) and cells["volume"][7] == 0 and np.isnan(cells["centroid_z"][7])
    assert np.array_equal(diagram.areas(), cells["volume"])
    x, y, z = (np.floor(points) + 0.5).T
    for name, expected in ("x", x), ("y", y), ("z", z):
        assert np.array_equal(cells[name], expected, equal_nan=True)
    distances = diagram.distances()
    for region in measure.regionprops(labels.astype(int) + 1):
        cell = cells[region.label - 1]
        assert cell["volume"] == region.area
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
    assert np.array_equal(diagram.cells()["surface"], surface)


@exact_alone
@pytest.mark.parametrize("shape", [(50, 70), (1, 20, 30), (24, 35, 46)])
@pytest.mark.parametrize("share", [0.0005, 0.02, 0.5, 0.99])
def test_distance_transform_is_that_of_scipy(shape, share):
    mask = np.random.default_rng(3).uniform(size=shape) > share
    mask.flat[mask.size // 3] = False
    expected = ndimage.distance_transform_edt(mask)
    distances, indices = vorocl.distance_transform_edt(mask, return_indices=True)
    assert distances.dtype == expected.dtype
    assert np.array_equal(distances, expected)
    assert indices.dtype == np.int32
    assert not mask[tuple(indices)].any()
    way = np.sqrt(((indices - np.indices(shape)) ** 2).sum(0))
    assert np.array_equal(way, expected)
    only = vorocl.distance_transform_edt(mask, return_distances=False, return_indices=True)
    assert np.array_equal(only, indices)


@exact_alone
def test_sampling_scales_distances():
    mask = np.random.default_rng(4).uniform(size=(9, 20, 30)) > 0.01
    expected = ndimage.distance_transform_edt(mask, sampling=0.25)
    assert np.array_equal(vorocl.distance_transform_edt(mask, sampling=(0.25, 0.25, 0.25)), expected)
    expected = ndimage.distance_transform_edt(mask, sampling=0.1)
    assert np.allclose(vorocl.distance_transform_edt(mask, sampling=0.1), expected, rtol=1e-15, atol=0)
    labels = np.where(mask, 0, np.arange(mask.size).reshape(mask.shape))
    assert np.array_equal(vorocl.expand_labels(labels, 0.5, 0.25), vorocl.expand_labels(labels, 2))


@exact_alone
@pytest.mark.parametrize("shape, sampling", [((50, 70), (3, 1.5)), ((24, 35, 46), (1, 0.25, 0.25)), ((1, 9, 40), (9, 1, 3))])
@pytest.mark.parametrize("share", [0.001, 0.3])
def test_pixels_may_be_longer_along_one_axis_than_along_another(shape, sampling, share):
    rng = np.random.default_rng(6)
    mask = rng.uniform(size=shape) > share
    mask.flat[mask.size // 3] = False
    expected = ndimage.distance_transform_edt(mask, sampling=sampling)
    distances, indices = vorocl.distance_transform_edt(mask, sampling, return_indices=True)
    assert np.allclose(distances, expected, rtol=1e-15, atol=0)
    assert not mask[tuple(indices)].any()
    sizes = np.reshape(sampling, (-1,) + (1,) * len(shape))
    way = np.sqrt((((indices - np.indices(shape)) * sizes) ** 2).sum(0))
    assert np.allclose(way, expected, rtol=1e-15, atol=0)
    labels = np.where(mask, 0, rng.integers(1, 99, shape))
    ours = vorocl.expand_labels(labels, 4, sampling)
    expanded = segmentation.expand_labels(labels, 4, sampling)
    assert np.array_equal(ours == 0, expanded == 0)
    assert (ours != expanded).mean() < 0.2  # ties, of which there are many among small multiples
    assert np.array_equal(ours[ours != 0], labels[tuple(indices)][ours != 0])


@exact_alone
@pytest.mark.parametrize("shape", [(60, 80), (1, 30, 40), (20, 30, 40)])
@pytest.mark.parametrize("distance", [1, 3, np.sqrt(5), 100])
def test_expanded_labels_are_those_of_scikit_image_but_for_ties(shape, distance):
    rng = np.random.default_rng(5)
    labels = np.where(rng.uniform(size=shape) < 0.004, rng.integers(1, 99, shape), 0)
    expected = segmentation.expand_labels(labels, distance)
    expanded = vorocl.expand_labels(labels, distance)
    assert expanded.dtype == labels.dtype
    assert np.array_equal(expanded == 0, expected == 0)
    nearest = ndimage.distance_transform_edt(labels == 0)
    for z in np.argwhere(expanded != expected):  # each label is as near
        for label in (expanded[tuple(z)], expected[tuple(z)]):
            squared = ((np.argwhere(labels == label) - z) ** 2).sum(1).min()
            assert squared == round(nearest[tuple(z)] ** 2)
    assert (expanded != expected).mean() < 0.05


WRONG_CALLS = [
    (lambda: vorocl.diagram([(1, 2)], (4, 5, 6)), r"shape \(N, 3\), rows \(x, y, z\)"),
    (lambda: vorocl.diagram([(1, 2, 3)], (5, 6)), r"shape \(N, 2\)"),
    (lambda: vorocl.diagram([(1, 2, 3)], (1, 5, 6)), r"one slice is a plane: give the shape \(5, 6\)"),
    (lambda: vorocl.diagram([(1, 2, 3)], (2, 3, 4, 5)), r"\(H, W\), or three \(D, H, W\)"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), bounds=(0, 0, 1, 1)), "bounds is for planes"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), periodic=(True, False)), "periodic must be three booleans"),
    (lambda: vorocl.diagram([(1, 2)], (5, 6), periodic=(False, False, True)), "periodic must be two booleans"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), y_up=True), "y_up is for planes"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), snap=False), "snap=False is for planes"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), method="djfa"), "volume of 6 x 5 x 4 voxels, which flooding"),
    (lambda: vorocl.diagram([(1, 2, 3)], (4, 5, 6), metric="manhattan"), "are Euclidean"),
    (lambda: vorocl.diagram([(1, 2, 9)], (4, 5, 6)), "outside the volume"),
    (lambda: vorocl.diagram([(1, 2, 3)], (2000, 2000, 2000)), r"2\^31 in all"),
    (lambda: vorocl.vertices([(1, 2, 3)], (4, 5, 6)), "which this measure cannot take"),
    (lambda: vorocl.relax([(1, 2, 3)], (4, 5, 6)), "Lloyd relaxation cannot take"),
    (lambda: vorocl.distance_transform_edt(np.ones((3, 4, 5))), "no zero"),
    (lambda: vorocl.distance_transform_edt(np.zeros((3, 4)), sampling=(1, 17)), "whole multiples, up to 16"),
    (lambda: vorocl.distance_transform_edt(np.zeros((3, 4)), sampling=(1, np.pi)), "whole multiples, up to 16"),
    (lambda: vorocl.expand_labels(np.ones((3, 6000), int), 1, spacing=(1, 3)), "16384 units of the spacing"),
    (lambda: vorocl.distance_transform_edt(np.zeros((3, 4)), sampling=(1, 1, 1)), "or 2 of them"),
    (lambda: vorocl.distance_transform_edt(np.zeros((3, 4)), sampling=-1), "above 0"),
    (lambda: vorocl.distance_transform_edt(np.zeros((3, 4)), return_distances=False), "nothing is wanted"),
    (lambda: vorocl.distance_transform_edt(np.zeros(5)), r"\(H, W\) or \(D, H, W\)"),
]


@exact_alone
@pytest.mark.parametrize("call, words", WRONG_CALLS)
def test_what_volumes_cannot_be_is_refused(call, words):
    with pytest.raises(vorocl.Error, match=words):
        call()
