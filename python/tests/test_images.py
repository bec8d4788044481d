"""Masks and regions, against SciPy's distance transform and scikit-image."""

import numpy as np
import pytest
from oracles import brute_force
from scipy import ndimage
from skimage.segmentation import expand_labels

import vorocl

rng = np.random.default_rng(18)


@pytest.mark.parametrize("periodic", [(False, False), (True, True)])
def test_seeds_of_a_mask_are_numbered_row_by_row(periodic):
    mask = rng.random((40, 53)) < 0.02
    rows, columns = np.nonzero(mask)
    expected = brute_force(np.column_stack([columns, rows]), mask.shape, periodic, snap=True)
    for image in mask, mask.astype(np.float32) * -0.5, mask.astype("u2").T.copy().T:
        np.testing.assert_array_equal(vorocl.from_mask(image, periodic=periodic), expected)


def test_distances_are_those_of_the_distance_transform():
    points = rng.integers(0, (200, 150), (30, 2))
    mask = np.ones((150, 200))
    mask[points[:, 1], points[:, 0]] = 0
    out = np.empty((150, 200), np.float32)
    assert vorocl.distances(points + 0.5, (150, 200), out=out) is out
    np.testing.assert_allclose(out, ndimage.distance_transform_edt(mask), rtol=4e-7)
    manhattan = ndimage.distance_transform_cdt(mask, "taxicab")
    np.testing.assert_array_equal(vorocl.distances(points + 0.5, (150, 200), metric="manhattan"), manhattan)


def regions(shape):
    image = np.zeros(shape, np.int32)
    for label in range(1, 30):
        y, x = rng.integers(0, np.array(shape) - 5)
        image[y : y + rng.integers(1, 6), x : x + rng.integers(1, 6)] = label
    return image


@pytest.mark.parametrize("distance", [0, 0.5, 1, 2**0.5, 2, 13**0.5, 5, 12.3, 1e6])
def test_regions_grow_as_those_of_scikit_image(distance):
    image = regions((90, 120))
    ours, theirs = vorocl.expand_labels(image, distance), expand_labels(image, distance)
    np.testing.assert_array_equal(ours != 0, theirs != 0)
    # Where they differ, both labels are equally near.
    far = [ndimage.distance_transform_edt(image != label) for label in range(30)]
    for y, x in np.argwhere(ours != theirs):
        assert far[ours[y, x]][y, x] == far[theirs[y, x]][y, x]
    assert (ours != theirs).mean() < 0.1


def test_regions_fill_the_image_and_keep_their_type():
    image = regions((60, 50))
    rows, columns = np.nonzero(image)
    nearest = brute_force(np.column_stack([columns, rows]), image.shape, snap=True)  # ties: the first one row by row
    for dtype in np.uint8, np.int64, np.uint16, ">i4":
        grown = vorocl.expand_labels(image.astype(dtype))
        assert grown.dtype == np.dtype(dtype)
        np.testing.assert_array_equal(grown, image[rows, columns][nearest])
    assert not vorocl.expand_labels(np.zeros((5, 4), np.uint8), 3).any()
