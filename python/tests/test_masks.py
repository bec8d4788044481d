"""Masks and images of labels, against SciPy's distance transform, scikit-image and brute force."""

import inspect
import os

import numpy as np
import pytest
from oracles import brute_force
from scipy import ndimage
from skimage import segmentation

import vorocl

rng = np.random.default_rng(18)
MASKS = 10_000 if "VOROCL_LONG_TESTS" in os.environ else 300
TYPES = [bool, "u1", "i1", "i2", "u2", "i4", "u4", "i8", "u8", "f2", "f4", "f8", "g", ">i4", ">f8"]


# --- masks of every kind: true where they are the foreground ---


def some_shape(random):
    kind = random.integers(7)
    if kind == 0:
        return (int(random.integers(1, 300)),)
    if kind == 1:  # longer than the runs that the engine takes at once
        return (int(random.integers(100, 300)), int(random.integers(1, 9)))
    if kind == 2:
        return (int(random.integers(1, 9)), int(random.integers(100, 300)))
    if kind == 3:
        return tuple(int(side) for side in random.integers(1, (60, 60)))
    if kind == 4:
        return (int(random.integers(60, 150)), int(random.integers(1, 5)), int(random.integers(1, 20)))
    if kind == 5:
        return (int(random.integers(1, 60)), int(random.integers(1, 60)), 1)
    return tuple(int(side) for side in random.integers(1, (16, 16, 24)))


def some_mask(random, shape):
    """Of at least one zero."""
    axes, kind = len(shape), random.integers(13)
    mask, places = np.ones(shape, bool), np.indices(shape)
    if kind < 4:
        mask = random.random(shape) < (0.5, 0.03, 0.9, 0.999)[kind]
    elif kind == 4:
        mask = places.sum(0) % 2 == 0
    elif kind == 5:  # a line of zeros
        mask[tuple(random.integers(side) for side in shape[:-1])] = False
    elif kind == 6:  # a plane of zeros
        mask[random.integers(shape[0])] = False
    elif kind == 7:
        mask[...] = False
        mask.flat[random.integers(mask.size)] = True
    elif kind in (8, 9):
        middle = random.uniform(0, shape)
        mask = sum((at - centre) ** 2 for at, centre in zip(places, middle)) < (max(shape) * random.random()) ** 2
        mask = mask == (kind == 8)
    elif kind == 10:
        mask = ndimage.gaussian_filter(random.random(shape), 2) > 0.5
    elif kind == 11:  # a lattice: many ties
        mask[tuple(slice(int(random.integers(3)), None, int(random.integers(2, 9))) for _ in range(axes))] = False
    elif kind == 12:
        mask = np.broadcast_to(random.random((shape[0],) + (1,) * (axes - 1)) < 0.8, shape).copy()
    if mask.all():
        mask.flat[random.integers(mask.size)] = False
    return mask


def as_numbers(random, mask):
    """The mask in some type, with any numbers but 0 for the foreground, and with any strides."""
    dtype = np.dtype(TYPES[random.integers(len(TYPES))])
    numbers = random.integers(1, 100, mask.shape)
    if dtype.kind == "f":
        numbers = numbers * random.choice([-0.25, 1e-3, np.inf], mask.shape)
        numbers[random.random(mask.shape) < 0.1] = np.nan
    elif dtype.kind == "i":
        numbers = numbers * random.choice([-1, 1], mask.shape)
    image = np.where(mask, numbers, 0).astype(dtype)
    if random.integers(4) == 0:
        image = np.asfortranarray(image)
    elif random.integers(4) == 0:
        image = np.repeat(image, 2, axis=-1)[..., ::2]
    return image


def nearest_by_brute_force(marked, sizes, periodic=()):
    """Of every pixel the number of the nearest marked one, in the order of rows; of several the first. In integers."""
    seeds, pixels = np.argwhere(marked), np.indices(marked.shape).reshape(marked.ndim, -1)
    squared = np.zeros((pixels.shape[1], len(seeds)), np.int64)
    for axis, size in enumerate(sizes):
        apart = abs(pixels[axis][:, None] - seeds[:, axis])
        if axis in periodic:
            apart = np.minimum(apart, marked.shape[axis] - apart)
        squared += (apart * size) ** 2
    return squared.argmin(1).reshape(marked.shape)


def random_masks(count, seed):
    for number in range(count):
        random = np.random.default_rng([seed, number])
        yield random, some_mask(random, some_shape(random))


def length_of(indices, sizes):
    """How far it is from each pixel to the one that it has the indices of."""
    offsets = (indices - np.indices(indices.shape[1:])).astype(float)
    return np.sqrt(sum((offset * size) ** 2 for offset, size in zip(offsets, sizes)))


def units_apart(a, b):
    """In units of the last place."""
    return (abs(a - b) / np.spacing(np.maximum(abs(b), 1e-300))).max(initial=0)


# --- distances and indices ---


def test_distances_are_the_bits_of_scipy():
    for random, mask in random_masks(MASKS, 1):
        image = as_numbers(random, mask)
        distances, indices = vorocl.distance_transform_edt(image, return_indices=True)
        expected = ndimage.distance_transform_edt(image)
        assert distances.dtype == expected.dtype and np.array_equal(distances, expected), (mask.shape, image.dtype)
        assert indices.dtype == np.int32 and not mask[tuple(indices)].any()
        assert np.array_equal(length_of(indices, (1,) * mask.ndim), expected)
        if mask.size * (~mask).sum() < 1e6:
            nearest = np.argwhere(~mask)[nearest_by_brute_force(~mask, (1,) * mask.ndim)]
            assert np.array_equal(np.moveaxis(nearest, -1, 0), indices), mask.shape


@pytest.mark.parametrize("shape", [(1000, 1300), (90, 100, 110)])
def test_one_of_both_is_what_both_are(shape):
    mask = ndimage.gaussian_filter(rng.random(shape), 3) > 0.5
    distances, indices = vorocl.distance_transform_edt(mask, return_indices=True)
    assert np.array_equal(distances, ndimage.distance_transform_edt(mask))
    assert np.array_equal(vorocl.distance_transform_edt(mask), distances)
    assert np.array_equal(vorocl.distance_transform_edt(mask, None, False, True), indices)


SIZES = [(0.065, 0.065, 0.2), (0.2, 0.065, 0.065), (2, 0.65, 0.65), (0.1625, 0.1625, 0.4), (3, 1.5, 1.5), (1, 1, 40), (997, 1000, 1)]


@pytest.mark.parametrize("sizes", SIZES)
def test_pixels_have_any_sizes_that_are_as_whole_numbers(sizes):
    for random, mask in random_masks(MASKS // 10, 2):
        sampling = sizes[3 - mask.ndim :] if mask.ndim > 1 else (sizes[0],)
        distances, indices = vorocl.distance_transform_edt(mask, sampling, return_indices=True)
        expected = ndimage.distance_transform_edt(mask, sampling=sampling)
        assert units_apart(distances, expected) <= 2, (mask.shape, sampling)
        assert units_apart(length_of(indices, sampling), expected) <= 2
        whole = [round(size * 10_000) for size in sampling]
        if mask.size * (~mask).sum() < 1e6:
            nearest = np.argwhere(~mask)[nearest_by_brute_force(~mask, whole)]
            assert np.array_equal(np.moveaxis(nearest, -1, 0), indices), (mask.shape, sampling)


def test_pixels_have_any_other_sizes_to_a_rounding():
    for random, mask in random_masks(MASKS, 3):
        sampling = 10 ** random.uniform(-1, 1, mask.ndim)
        distances, indices = vorocl.distance_transform_edt(mask, sampling, return_indices=True)
        expected = ndimage.distance_transform_edt(mask, sampling=sampling)
        assert not mask[tuple(indices)].any()
        assert units_apart(distances, length_of(indices, sampling)) <= 2
        # Of two zeros whose squares differ by less than the rounding does the farther one may be taken.
        sides = sum((side * max(sampling)) ** 2 for side in mask.shape)
        assert (distances**2 - expected**2 < 2**-19 * sides).all()
        assert (distances >= expected * (1 - 1e-14)).all()


def test_one_size_is_for_all_axes():
    mask = rng.random((9, 20, 30)) > 0.01
    expected = ndimage.distance_transform_edt(mask, sampling=0.1)
    for sampling in 0.1, (0.1, 0.1, 0.1), np.float32(0.1) * np.ones(3):
        assert np.allclose(vorocl.distance_transform_edt(mask, sampling=sampling), expected, rtol=1e-7, atol=0)
    assert units_apart(vorocl.distance_transform_edt(mask, sampling=0.1), expected) <= 2


# --- labels of masks ---


@pytest.mark.parametrize("periodic", [(False, False), (True, True)])
def test_seeds_of_a_mask_are_numbered_row_by_row(periodic):
    mask = rng.random((40, 53)) < 0.02
    rows, columns = np.nonzero(mask)
    expected = brute_force(np.column_stack([columns, rows]), mask.shape, periodic, snap=True)
    for image in mask, mask.astype(np.float32) * -0.5, mask.astype("u2").T.copy().T:
        for method in "exact", "jfa+2":
            labels = vorocl.from_mask(image, method=method, periodic=periodic)
            assert (labels != expected).mean() <= (0 if method == "exact" else 0.01)


def test_periodic_labels_are_those_of_a_mask_three_times_over():
    for random, mask in random_masks(MASKS // 3, 4):
        if mask.ndim == 1 or 1 in mask.shape[:2]:
            continue
        periodic = random.random(mask.ndim) < 0.7
        labels = vorocl.from_mask(~mask, periodic=tuple(periodic[::-1].tolist()))
        tiled = np.tile(mask, [3 if repeats else 1 for repeats in periodic])
        middle = tuple(slice(side, 2 * side) if repeats else slice(None) for side, repeats in zip(mask.shape, periodic))
        expected = ndimage.distance_transform_edt(tiled)[middle]
        apart = abs(np.moveaxis(np.argwhere(~mask)[labels], -1, 0) - np.indices(mask.shape))
        for axis in np.flatnonzero(periodic):
            apart[axis] = np.minimum(apart[axis], mask.shape[axis] - apart[axis])
        assert np.array_equal(np.sqrt((apart**2).sum(0)), expected), (mask.shape, periodic)
        if mask.size * (~mask).sum() < 1e6:
            nearest = nearest_by_brute_force(~mask, (1,) * mask.ndim, np.flatnonzero(periodic))
            assert np.array_equal(labels, nearest), (mask.shape, periodic)


@pytest.mark.parametrize("width", [1, 7, 8, 15, 16, 17, 32, 40, 65])
@pytest.mark.parametrize("dtype", ["f2", "f4", "f8", ">f4", "g"])
def test_nan_is_no_data(width, dtype):
    mask = np.full((30, width), np.nan, dtype)
    mask[5, width // 2], mask[20, width // 3] = 1, -np.inf
    expected = vorocl.from_mask(np.nan_to_num(mask) != 0)
    for method in "exact", "standard-flooding":
        assert np.array_equal(vorocl.from_mask(mask, method=method), expected)
    masked = np.ma.masked_array(np.ones(mask.shape), np.isnan(mask))
    assert np.array_equal(vorocl.from_mask(masked), expected)
    grown = vorocl.expand_labels(mask, np.inf)
    assert np.array_equal(grown, np.where(expected == 0, 1, -np.inf))
    mask[0, 0] = 0
    assert np.array_equal(vorocl.distance_transform_edt(mask), ndimage.distance_transform_edt(mask))


def test_no_seed_is_no_label():
    for image in np.zeros((4, 5)), np.full((3, 4, 5), np.nan), np.zeros((1, 6, 7), bool):
        assert (vorocl.from_mask(image) == vorocl.NO_LABEL).all()


def test_distances_are_those_of_the_distance_transform():
    points = rng.integers(0, (200, 150), (30, 2))
    mask = np.ones((150, 200))
    mask[points[:, 1], points[:, 0]] = 0
    out = np.empty((150, 200), np.float32)
    assert vorocl.distances(points + 0.5, (150, 200), out=out) is out
    np.testing.assert_allclose(out, ndimage.distance_transform_edt(mask), rtol=4e-7)
    manhattan = ndimage.distance_transform_cdt(mask, "taxicab")
    np.testing.assert_array_equal(vorocl.distances(points + 0.5, (150, 200), metric="manhattan"), manhattan)


# --- regions that grow ---


def some_labels(random, mask):
    return np.where(mask, 0, random.integers(1, 99, mask.shape))


@pytest.mark.parametrize("distance", [0, 0.5, 1, 2**0.5, 2, 13**0.5, 5, 12.3, 1e6, np.inf])
def test_regions_grow_as_those_of_scikit_image(distance):
    for random, mask in random_masks(MASKS // 10, 5):
        labels = some_labels(random, mask)
        expanded, expected = vorocl.expand_labels(labels, distance), segmentation.expand_labels(labels, distance)
        assert np.array_equal(expanded == 0, expected == 0), mask.shape
        seeds, nearest = labels[~mask], nearest_by_brute_force(~mask, (1,) * mask.ndim)
        assert np.array_equal(expanded, np.where(expected != 0, seeds[nearest], 0)), mask.shape  # ties: the first


@pytest.mark.parametrize("size", [0.65, 0.325, 0.7, 0.1625, 0.065, (2.1, 0.7), (0.2, 0.065), (0.3, 0.1), (1, np.pi), (np.pi, 1), np.pi])
def test_regions_grow_by_whole_pixels(size):
    row = np.zeros((3, 130), np.int32)
    row[0, 0] = 1
    along = size[1] if isinstance(size, tuple) else size
    for pixels in range(1, 129):
        expanded = vorocl.expand_labels(row, pixels * along, size)
        assert np.count_nonzero(expanded[0]) == pixels + 1
        expected = segmentation.expand_labels(row, pixels * along * (1 + 1e-15), size)  # and what is as far but for rounding
        assert np.array_equal(expanded, expected), pixels
        assert np.count_nonzero(vorocl.expand_labels(row[0], pixels * along, along)) == pixels + 1
    assert np.count_nonzero(vorocl.expand_labels([7, 0, 0, 0, 0], 0.3, 0.1)) == 4


@pytest.mark.parametrize("sizes", SIZES[:5])
def test_regions_grow_in_units_of_the_spacing(sizes):
    for random, mask in random_masks(MASKS // 10, 6):
        spacing = sizes[3 - mask.ndim :] if mask.ndim > 1 else (sizes[0],)
        labels, distance = some_labels(random, mask), random.uniform(0, 9) * max(spacing)
        expanded = vorocl.expand_labels(labels, distance, spacing)
        expected = segmentation.expand_labels(labels, distance, spacing)
        assert np.array_equal(expanded == 0, expected == 0), (mask.shape, spacing)


def test_labels_keep_their_type():
    labels = some_labels(rng, rng.random((60, 50)) < 0.99)
    expected = vorocl.expand_labels(labels, np.inf)
    for dtype in TYPES[1:]:
        expanded = vorocl.expand_labels(labels.astype(dtype), np.inf)
        assert expanded.dtype == np.dtype(dtype)
        assert np.array_equal(expanded, expected)
    assert vorocl.expand_labels(labels > 0, np.inf).dtype == bool
    assert not vorocl.expand_labels(np.zeros((5, 4), np.uint8), 3).any()


# --- one import that is changed ---


@pytest.mark.parametrize(
    "ours, theirs",
    [
        (vorocl.distance_transform_edt, ndimage.distance_transform_edt),
        (vorocl.expand_labels, segmentation.expand_labels),
    ],
)
def test_arguments_have_the_names_order_and_defaults_of_what_they_replace(ours, theirs):
    own = [(of.name, of.default) for of in inspect.signature(ours).parameters.values()]
    others = [(of.name, of.default) for of in inspect.signature(theirs).parameters.values()]
    assert own[: len(others)] == others


def test_results_go_into_arrays_of_the_caller():
    for shape in (30,), (20, 31), (1, 9, 8), (6, 7, 8):
        mask = rng.random(shape) > 0.02
        mask.flat[3] = False
        expected, places = vorocl.distance_transform_edt(mask, return_indices=True)
        for make in np.empty, lambda shape, dtype: np.empty(shape[::-1], dtype).T, lambda shape, dtype: np.empty((*shape, 2), dtype)[..., 1]:
            distances, indices = make(shape, np.float64), make((len(shape), *shape), np.int32)
            assert vorocl.distance_transform_edt(mask, distances=distances) is None
            assert np.array_equal(distances, expected)
            assert np.array_equal(vorocl.distance_transform_edt(mask, return_indices=True, indices=indices), expected)
            assert np.array_equal(indices, places)
            distances[...], indices[...] = 0, 0
            assert np.array_equal(vorocl.distance_transform_edt(mask, None, True, True, distances), places)
            assert vorocl.distance_transform_edt(mask, None, True, True, distances, indices) is None
            assert np.array_equal(distances, expected) and np.array_equal(indices, places)


@pytest.mark.parametrize("shape", [(30,), (20, 31), (1, 9, 8), (6, 7, 8)])
@pytest.mark.parametrize("sampling", [None, 0.3])
def test_distances_may_be_float32(shape, sampling):
    mask = rng.random(shape) > 0.02
    mask.flat[3] = False
    expected = vorocl.distance_transform_edt(mask, sampling)
    found = vorocl.distance_transform_edt(mask, sampling, float64_distances=False)
    assert found.dtype == np.float32
    assert np.array_equal(found, expected.astype(np.float32))
    given = np.zeros(shape[::-1], np.float32).T
    assert vorocl.distance_transform_edt(mask, sampling, distances=given, float64_distances=False) is None
    assert np.array_equal(given, found)


def test_masked_arrays_are_what_they_hold():
    mask = rng.random((20, 30)) > 0.1
    for dtype in bool, float:
        image = np.ma.array(mask.astype(dtype), mask=rng.random(mask.shape) < 0.5)
        assert np.array_equal(vorocl.distance_transform_edt(image), ndimage.distance_transform_edt(image))


@pytest.mark.parametrize("shape", [(0,), (0, 5), (3, 0), (2, 0, 4)])
def test_empty_arrays_have_empty_results(shape):
    image = np.ones(shape, np.int16)
    distances, indices = vorocl.distance_transform_edt(image, return_indices=True)
    expected, places = ndimage.distance_transform_edt(image, return_indices=True)
    for ours, theirs in (distances, expected), (indices, places), (vorocl.expand_labels(image), image):
        assert ours.shape == theirs.shape and ours.dtype == theirs.dtype


def test_lists_and_long_rows():
    assert vorocl.distance_transform_edt([0, 1, 1]).tolist() == [0, 1, 2]
    assert vorocl.expand_labels([0, 1, 0, 0, 0, 0, 2], distance=3).tolist() == [1, 1, 1, 1, 2, 2, 2]
    mask = rng.random(300_000) > 1e-4
    assert np.array_equal(vorocl.distance_transform_edt(mask), ndimage.distance_transform_edt(mask))


NO_WAY = [
    (lambda: vorocl.distance_transform_edt(np.ones((3, 4, 5))), "no zero"),
    (lambda: vorocl.distance_transform_edt(np.ones(5)), "no zero"),
    (lambda: vorocl.distance_transform_edt(np.zeros((2, 2, 2, 2))), "one to three axes"),
    (lambda: vorocl.distance_transform_edt(np.zeros((3, 4), complex)), "numbers or booleans"),
    (lambda: vorocl.distance_transform_edt(np.zeros((3, 4)), sampling=(1, 1001)), "1,?000 times"),
    (lambda: vorocl.distance_transform_edt(np.zeros((3, 4)), sampling=(1, 1, 1)), "or 2 of them"),
    (lambda: vorocl.distance_transform_edt(np.zeros((3, 4)), sampling=-1), "above 0"),
    (lambda: vorocl.distance_transform_edt(np.zeros((3, 4)), return_distances=False), "nothing is wanted"),
    (lambda: vorocl.distance_transform_edt(np.zeros(4), indices=np.zeros((1, 4), "i4")), "return_indices must be True"),
    (lambda: vorocl.distance_transform_edt(np.zeros(4), distances=np.zeros(4, "f4")), "distances must be float64"),
    (lambda: vorocl.distance_transform_edt(np.zeros(4), distances=np.zeros(5)), r"shape \(4,\)"),
    (lambda: vorocl.distance_transform_edt(np.zeros((2, 40_000))), "32,?768"),
    (lambda: vorocl.expand_labels(np.zeros((3, 4)), -1), "at least 0"),
]


@pytest.mark.parametrize("call, words", NO_WAY)
def test_what_masks_cannot_be_is_refused(call, words):
    with pytest.raises(vorocl.BadArgument, match=words):
        call()


# --- images larger than memory ---


@pytest.mark.parametrize("dtype", ["?", "u1", "f4", ">i2"])
@pytest.mark.parametrize("periodic", [(False, False), (True, False), (True, True)])
def test_tiles_of_a_mask_are_parts_of_its_labels_and_distances(tmp_path, dtype, periodic):
    shape, random = (130, 170), np.random.default_rng(5)
    for share in 0, 0.0001, 0.01, 0.6, 1:
        path = tmp_path / f"{share}.npy"
        mask = np.lib.format.open_memmap(path, "w+", np.dtype(dtype), shape)
        mask[...] = random.random(shape) < share
        labels, distances = np.zeros(shape, "u4"), np.zeros(shape, "f4")
        seeds = vorocl.mask_tiles(np.load(path, mmap_mode="r"), labels, distances, tile=48, periodic=periodic)
        assert seeds == np.count_nonzero(mask)
        np.testing.assert_array_equal(labels, vorocl.from_mask(mask, periodic=periodic))
        if seeds == 0:
            assert np.isinf(distances).all()
        elif not any(periodic):
            np.testing.assert_allclose(distances, ndimage.distance_transform_edt(mask == 0), rtol=3e-7)


def test_tiles_of_a_mask_may_be_written_one_by_one():
    mask, tiles = np.eye(100, dtype=bool), {}

    class Store:
        shape = mask.shape

        def __setitem__(self, where, pixels):
            tiles[where[0].start, where[1].start] = pixels.copy()

    assert vorocl.mask_tiles(mask, Store(), tile=64, metric="manhattan") == 100
    assert {where: pixels.shape for where, pixels in tiles.items()} == {
        (0, 0): (64, 64), (0, 64): (64, 36), (64, 0): (36, 64), (64, 64): (36, 36)
    }  # fmt: skip
    labels = np.block([[tiles[0, 0], tiles[0, 64]], [tiles[64, 0], tiles[64, 64]]])
    np.testing.assert_array_equal(labels, vorocl.from_mask(mask, metric="manhattan"))


def test_what_tiles_of_a_mask_cannot_be_is_refused():
    mask, labels = np.eye(5), np.zeros((5, 5), "u4")
    with pytest.raises(vorocl.BadArgument, match="two dimensions"):
        vorocl.mask_tiles(np.zeros((2, 3, 4)), labels)
    with pytest.raises(vorocl.BadArgument, match="nothing to make"):
        vorocl.mask_tiles(mask)
    with pytest.raises(vorocl.BadArgument, match=r"labels must be an array of the mask's shape, \(5, 5\); this is \(4, 5\)"):
        vorocl.mask_tiles(mask, labels[1:])
    with pytest.raises(vorocl.BadArgument, match="tile must be"):
        vorocl.mask_tiles(mask, labels, tile=0)

    class Full:
        shape = mask.shape

        def __setitem__(self, where, pixels):
            raise OSError("no space is left")

    with pytest.raises(OSError, match="no space"):
        vorocl.mask_tiles(mask, Full())


def test_one_dimension_is_that_of_scipy():
    for share in 0.001, 0.1, 0.9:
        image = rng.random(5000) > share
        image[rng.integers(5000)] = 0
        distances, indices = vorocl.distance_transform_edt(image, return_indices=True)
        np.testing.assert_array_equal(distances, ndimage.distance_transform_edt(image))
        np.testing.assert_array_equal(distances, abs(indices[0] - np.arange(5000)))
        zeros = np.flatnonzero(image == 0)  # of two as near the first
        np.testing.assert_array_equal(indices[0], zeros[abs(zeros - np.arange(5000)[:, None]).argmin(axis=1)])


def test_tiles_go_to_arrays_that_hold_them():
    mask = rng.random((40, 50)) < 0.1
    for dtype in np.uint8, np.int32, np.float32:
        with pytest.raises(vorocl.BadArgument, match="labels are uint32.*cannot hold"):
            vorocl.mask_tiles(mask, np.zeros(mask.shape, dtype))
    with pytest.raises(vorocl.BadArgument, match="distances are float32.*cannot hold"):
        vorocl.mask_tiles(mask, distances=np.zeros(mask.shape, np.float16))
    labels = np.zeros(mask.shape, np.int64)
    vorocl.mask_tiles(mask, labels)
    np.testing.assert_array_equal(labels, vorocl.from_mask(mask))


def test_a_plane_of_one_slice_has_periods_of_planes_and_of_volumes():
    mask = rng.random((1, 30, 40)) < 0.02
    for method in "exact", "jfa":
        expected = vorocl.from_mask(mask[0], method=method, periodic=(True, False))[None]
        for periodic in (True, False), (True, False, False), (True, False, True):
            np.testing.assert_array_equal(vorocl.from_mask(mask, method=method, periodic=periodic), expected)
