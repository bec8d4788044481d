"""Diagrams and their measures by one call each, from arrays to arrays."""

from __future__ import annotations

import inspect
import math
import sys
import threading
from typing import TYPE_CHECKING, Any, Callable, NamedTuple, Optional, Sequence, Tuple, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _vorocl
from ._arguments import (
    Method,
    Metric,
    Outside,
    Sampling,
    Truth,
    Units,
    output,
    shown,
    to_count,
    to_density,
    to_flag,
    to_image,
    to_labels,
    to_marked,
    to_mask,
    to_number,
    to_outside,
    to_pixels,
    to_points,
    to_sampling,
    to_snap,
    to_text,
    to_truth,
    to_units,
    to_weights,
    unmasked,
)
from ._device import Device, to_device
from ._errors import BadArgument
from ._grid import Frame, Grid, Periodic, Shape, Unpack, to_globe, to_grid, to_periodic
from ._objects import Diagram, DistanceErrors, Seeds
from ._parameters import with_parameters

if TYPE_CHECKING:
    from typing_extensions import ParamSpec

    How = ParamSpec("How")

Found = TypeVar("Found")

NO_LABEL = 0xFFFFFFFF
"""The label of a pixel that has no nearest seed, because there are no seeds."""

_PIXELS_AT_ONCE = 1 << 22
"""Of rows that are read together."""

_CONTINUING = {name for name, _, continues in _vorocl.methods() if continues}


class _Workspace(threading.local):
    """What the last call of a thread worked in, for the next one that is like it."""

    made_for: Optional[Tuple[Any, ...]] = None
    seeds: Seeds
    diagram: Diagram


_workspace = _Workspace()


def _filled(
    points: ArrayLike,
    grid: Grid,
    method: Method,
    metric: Metric,
    outside: Outside,
    snap: Optional[bool],
    weights: Optional[ArrayLike],
    device: Optional[Device],
    labels: Optional[NDArray[np.uint32]] = None,
) -> Diagram:
    """The diagram, which is the thread's until its next call; or its labels alone, in an array."""
    if metric == "great-circle":
        grid = to_globe(grid, outside)
    array, snapped = to_points(points, len(grid.shape)), to_snap(snap, method)
    given = to_weights(weights, len(array))
    wanted = (grid, to_outside(outside), snapped, to_device(device), given is None)
    if _workspace.made_for != wanted:
        _workspace.made_for = None
        _workspace.seeds = Seeds(array, grid, outside=outside, snap=snapped, weights=given, device=device)
        _workspace.diagram = Diagram(grid, device=device)
        _workspace.made_for = wanted
    else:
        _workspace.seeds._seeds.move_to(array, None, given)  # without asking how far
    made = _workspace.diagram
    if method in _CONTINUING:
        made = Diagram(grid, device=device)  # or it would go on from the last call's labels
    if labels is None:
        made.fill(_workspace.seeds, method, metric)
    else:
        made._diagram.fill(
            _workspace.seeds._seeds, to_text(method, "method"), to_text(metric, "metric"), None, labels
        )
    return made


@with_parameters
def diagram(
    points: ArrayLike,
    grid: Union[Grid, Shape],
    *,
    method: Method = "exact",
    metric: Metric = "euclidean",
    outside: Outside = "count",
    snap: Optional[bool] = None,
    weights: Optional[ArrayLike] = None,
    out: Optional[NDArray[np.uint32]] = None,
    device: Optional[Device] = None,
    **frame: Unpack[Frame],
) -> NDArray[np.uint32]:
    """Give every pixel the row of its nearest point.

    "exact" takes the points themselves, rounded to 1/4096 of a pixel of the grid, and computes in integers: its labels
    are those of the point nearest to the pixel's centre, the same on every device. Of several points at the least
    distance the one with the least y wins, counted down the grid, then the one with the least x, then the one with the
    lowest row of `points`. A method that floods, and ``snap=True``, move points to the centres of their pixels first.

    In a volume, of a shape (D, H, W), points are rows (x, y, z): of several at the least distance the one with the least
    z wins, then y, then x, then the row. There "exact" is Euclidean, "jfa" and its variants are the other
    methods, and points outside are refused unless they are to be absent.

    Parameters
    ----------
    <points, grid, method, metric, outside, snap, weighted>
    out : ndarray, optional
        Where the labels go: uint32 of the shape, C-contiguous. Without it, a new array.
    <device>

    Returns
    -------
    ndarray
        uint32 of the shape (H, W) or (D, H, W): rows of `points`, or ``NO_LABEL`` if there are no points.

    Raises
    ------
    BadPoint
        If a point is infinite, 2**31 pixels away, or outside where such points are refused.
    BadArgument, DeviceMemoryError, DeviceError

    Notes
    -----
    A thread keeps the device memory of its last call, 4 bytes per pixel for "exact" and 13 for the others, until it
    makes a call with another grid; in a volume 4 and 12. `Diagram` keeps its own.

    Examples
    --------
    >>> import vorocl
    >>> vorocl.diagram([(0.5, 0.5), (7.5, 3.5)], (4, 8))
    array([[0, 0, 0, 0, 0, 1, 1, 1],
           [0, 0, 0, 0, 1, 1, 1, 1],
           [0, 0, 0, 0, 1, 1, 1, 1],
           [0, 0, 0, 1, 1, 1, 1, 1]], dtype=uint32)
    >>> vorocl.diagram([(-157.5, 0), (22.5, 0)], (1, 8), bounds=(-180, -90, 180, 90), periodic=(True, False))
    array([[0, 0, 0, 1, 1, 1, 0, 0]], dtype=uint32)
    >>> vorocl.diagram([(0.5, 0.5, 0.5), (3.5, 0.5, 1.5)], (2, 1, 4))
    array([[[0, 0, 1, 1]],
    <BLANKLINE>
           [[0, 0, 1, 1]]], dtype=uint32)

    Two circles, of the radii 2 and 1, meet where tangents to both are as long:

    >>> vorocl.diagram([(1, 0.5), (7, 0.5)], (1, 8), weights=[4, 1])
    array([[0, 0, 0, 0, 1, 1, 1, 1]], dtype=uint32)
    """
    made = to_grid(grid, frame)
    labels = output(out, made.shape, np.uint32)
    _filled(points, made, method, metric, outside, snap, weights, device, labels)
    return labels


def _transform(
    pixels: NDArray[Any],
    marks_zeros: bool,
    device: Optional[Device],
    sizes: Optional[Sequence[float]] = None,
    periodic: Periodic = (False, False),
    farthest: float = math.inf,
    **targets: Optional[NDArray[Any]],
) -> bool:
    """Write into arrays what the nearest marked pixel of each one is; whether there is one."""
    shape: Any = pixels.shape
    distances, indices, ranks, values = map(targets.get, ("distances", "indices", "ranks", "values"))
    if pixels.ndim == 1:
        nearest = _nearest_in_row(pixels == 0 if marks_zeros else to_marked(pixels))
        if nearest is None:
            return False
        away = abs(nearest - np.arange(len(pixels))) * (sizes or [1])[0]
        if distances is not None:
            distances[...] = away
        if indices is not None:
            indices[0] = nearest
        if values is not None:
            grown = away <= farthest * (1 + 4 * sys.float_info.epsilon)  # as in planes
            values.view(pixels.dtype)[grown] = pixels[nearest[grown]]
        return True
    lengths = tuple(sizes or (1.0,) * pixels.ndim)
    if pixels.ndim == 3 and 1 in (shape[0], shape[2]):  # a plane, which lies in memory as a volume with this axis does
        flat, axes = (0, slice(1, 3)) if shape[0] == 1 else (2, slice(0, 2))
        periodic = periodic if flat == 0 else to_periodic(periodic, 3)[1:]
        shape, lengths = shape[axes], lengths[axes]
        if indices is not None:
            indices[flat] = 0
            indices = indices[axes]
    z, y, x = (1.0,) * (3 - len(shape)) + lengths
    grid = Grid(shape, periodic=periodic)._of("count")
    image, dtype = pixels.view(np.uint8), pixels.dtype.str[1:]
    floats = None if distances is None else distances.view(np.uint8)
    return _vorocl.transform(
        to_device(device)._device, grid, (x, y, z), image, dtype, marks_zeros, farthest, floats, indices, ranks, values
    )


def _nearest_in_row(marked: NDArray[np.bool_]) -> Optional[NDArray[np.intp]]:
    """Where in an array of one dimension the nearest marked element is, of two the first; None where there is none."""
    if not marked.any():
        return None
    count, here = len(marked), np.arange(len(marked))
    before = np.maximum.accumulate(np.where(marked, here, -2 * count))  # or too far away
    behind = np.minimum.accumulate(np.where(marked, here, 3 * count)[::-1])[::-1]
    return np.where(here - before <= behind - here, before, behind)


@with_parameters
def from_mask(
    mask: ArrayLike,
    *,
    method: Method = "exact",
    metric: Metric = "euclidean",
    periodic: Periodic = (False, False),
    out: Optional[NDArray[np.uint32]] = None,
    device: Optional[Device] = None,
) -> NDArray[np.uint32]:
    """Give every pixel its nearest non-zero pixel of an image.

    SciPy's ``distance_transform_edt(mask)`` looks for the nearest pixel that is zero: what this finds is that of
    ``mask == 0``. `distance_transform_edt` is SciPy's function itself.

    Parameters
    ----------
    mask : array_like
        Shape (H, W) or (D, H, W), of numbers or booleans. NaN is no data, and so are the masked pixels of a masked array:
        they are as zeros.
    <method, metric_of_pixels, periodic>
    out : ndarray, optional
        Where the labels go: uint32 of the mask's shape, C-contiguous. Without it, a new array.
    <device>

    Returns
    -------
    ndarray
        uint32 of the mask's shape: the number of the nearest non-zero pixel, counted from 0 row by row, as
        ``numpy.flatnonzero(mask)`` lists them; ``NO_LABEL`` if there is none.

    Raises
    ------
    BadArgument, DeviceMemoryError, DeviceError

    Examples
    --------
    >>> import vorocl
    >>> vorocl.from_mask([[0, 0, 0, 1], [0, 0, 0, 0], [1, 0, 0, 0]])
    array([[1, 0, 0, 0],
           [1, 1, 0, 0],
           [1, 1, 1, 0]], dtype=uint32)
    """
    pixels = to_pixels(to_image(unmasked(mask), "mask"), "mask")
    labels = output(out, pixels.shape, np.uint32)
    if to_text(metric, "metric") == "great-circle":
        raise BadArgument('metric="great-circle" is of points in degrees; the pixels of a mask have none')
    if pixels.ndim == 3 and len(pixels) == 1 and np.size(periodic) == 3:  # a plane, whose z repeats nothing
        periodic = to_periodic(periodic, 3)[:2]
    if to_text(method, "method") == "exact" and metric == "euclidean":
        _transform(pixels, False, device, periodic=periodic, ranks=labels)
        return labels
    pixels = pixels[0] if pixels.ndim == 3 and len(pixels) == 1 else pixels
    shape: Any = pixels.shape
    grid = Grid(shape, periodic=periodic)
    made = Diagram(grid, device=device)
    seeds = _vorocl.Seeds.from_mask(made.device._device, grid._of("count"), to_marked(pixels).view(np.uint8))
    made._diagram.fill(seeds, method, metric, None, None)
    made.read(labels.reshape(made.shape))
    return labels


@with_parameters
def mask_tiles(
    mask: Any,
    labels: Any = None,
    distances: Any = None,
    *,
    tile: int = 2048,
    metric: Metric = "euclidean",
    periodic: Periodic = (False, False),
    device: Optional[Device] = None,
) -> int:
    """Give every pixel of an image that may be larger than memory its nearest non-zero pixel, tile by tile.

    What `from_mask` and `distances` give of all of it. In memory there are a bit for each pixel, and a few tiles.

    Parameters
    ----------
    mask : array_like
        Shape (H, W), up to 2**31 - 1 pixels a side, of numbers or booleans; NaN is no data. Read once, by rows:
        ``mask[y0:y1]`` may be of a ``numpy.memmap``, and of an array of Zarr, HDF5 or Dask.
    labels, distances : array_like, optional
        Where the numbers of the nearest pixels go (uint32) and how far they are (float32, in pixels; infinity where there
        are none): ``labels[y0:y1, x0:x1] = ...`` is done for each tile. Without one of them it is not made.
    tile : int, optional
        The side of tiles in pixels, such as that of the chunks of `labels` or a multiple.
    <metric_of_pixels, periodic, device>

    Returns
    -------
    int
        How many pixels are not zero.

    Raises
    ------
    BadArgument, DeviceMemoryError, DeviceError
        And what reading and writing the arrays raises.

    Examples
    --------
    >>> import numpy, vorocl
    >>> mask = numpy.zeros((3, 40000), bool)
    >>> mask[1, 7] = mask[2, 39000] = True
    >>> distances = numpy.empty(mask.shape, numpy.float32)
    >>> vorocl.mask_tiles(mask, distances=distances)
    2
    >>> distances[1, :9].tolist()
    [7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0, 0.0, 1.0]
    """
    mask = mask if hasattr(mask, "shape") else to_image(unmasked(mask), "mask")
    shape = mask.shape
    if len(shape) != 2:
        raise BadArgument(f"mask must have two dimensions; this has the shape {shape}")
    for name, target in ("labels", labels), ("distances", distances):
        found = getattr(target, "shape", None)
        if target is not None and found != shape:
            raise BadArgument(f"{name} must be an array of the mask's shape, {shape}; this is {shown(found or target)}")
        held, made = getattr(target, "dtype", None), np.uint32 if name == "labels" else np.float32
        if isinstance(held, np.dtype) and not np.can_cast(made, held):
            raise BadArgument(f"{name} are {np.dtype(made)}, which this array cannot hold: its dtype is {held}")
    if labels is None and distances is None:
        raise BadArgument("nothing to make: give labels, distances or both")
    side = to_count(tile, "tile")
    if not 1 <= side <= 32_768:
        raise BadArgument(f"tile must be from 1 to 32,768; this is {side}")
    made_by = to_device(device)._device
    bits = _vorocl.PlaneMask(shape[1], shape[0], *to_periodic(periodic, 2))
    rows = max(1, _PIXELS_AT_ONCE // shape[1])
    for first in range(0, shape[0], rows):
        block = to_pixels(to_image(unmasked(mask[first : first + rows]), "mask"), "mask")
        bits.add_rows(to_marked(block).view(np.uint8))

    def put(y: int, x: int, found: Any, away: Any) -> None:
        for target, pixels in (labels, found), (distances, away):
            if target is not None:
                target[y : y + len(pixels), x : x + pixels.shape[1]] = pixels

    _vorocl.mask_tiles(made_by, bits, side, to_text(metric, "metric"), distances is not None, put)
    return bits.seeds


@with_parameters
def expand_labels(
    label_image: ArrayLike,
    distance: float = 1,
    spacing: Sampling = 1,
    *,
    device: Optional[Device] = None,
) -> NDArray[Any]:
    """Grow labelled regions into the background, as ``skimage.segmentation.expand_labels`` does, without overlaps.

    ``from vorocl import expand_labels`` instead of ``from skimage.segmentation import ...`` is what changes. Each pixel
    of the background takes the label of the nearest pixel that has one, by exact Euclidean distance between pixel
    centres. Of several at the least distance the one that comes first, row by row of the image, wins; scikit-image
    leaves it open which one does.

    Parameters
    ----------
    label_image : array_like
        One to three dimensions, of numbers; 0 is the background, and NaN and the masked pixels of a masked array are as 0.
    distance : float, optional
        How far regions grow, in pixels or in units of `spacing`: as far as this and no farther, but for a rounding, so that
        three pixels of 0.1 are 0.3. ``math.inf`` is until no background is left.
    spacing : float or sequence of float, optional
        The size of a pixel: a number, or one for each axis; none is more than 1,000 times another one.
    <device>

    Returns
    -------
    ndarray
        The shape and dtype of `label_image`. All 0 if there is no label.

    Raises
    ------
    BadArgument, DeviceMemoryError, DeviceError

    Examples
    --------
    >>> import math, vorocl
    >>> vorocl.expand_labels([[7, 0, 0, 0, 0, 9]])
    array([[7, 7, 0, 0, 9, 9]])
    >>> vorocl.expand_labels([7, 0, 0, 0, 0, 9], distance=math.inf)
    array([7, 7, 7, 9, 9, 9])
    """
    image = to_mask(unmasked(label_image), "label_image")
    farthest = to_number(distance, "distance")
    if not farthest >= 0:
        raise BadArgument(f"distance must be at least 0; this is {shown(distance)}")
    sizes = to_sampling(spacing, image.ndim, "spacing")
    pixels = to_pixels(image, "label_image")
    grown = np.zeros_like(pixels)
    if pixels.size > 0:
        _transform(pixels, False, device, sizes, farthest=farthest, values=grown.view(np.uint8))
    return grown.astype(image.dtype, copy=False)


@with_parameters
def distance_transform_edt(
    input: ArrayLike,
    sampling: Sampling = None,
    return_distances: bool = True,
    return_indices: bool = False,
    distances: Optional[NDArray[Any]] = None,
    indices: Optional[NDArray[np.int32]] = None,
    *,
    float64_distances: bool = True,
    device: Optional[Device] = None,
) -> Any:
    """Give every non-zero pixel its distance to the nearest pixel that is zero, as SciPy's function of this name does.

    ``from vorocl import distance_transform_edt`` instead of ``from scipy.ndimage import ...`` is what changes. The
    distances are SciPy's, to the bit without a `sampling`, else to a rounding (see there). Of several zeros at the least distance
    SciPy leaves open which one `indices` names; here it is the one that comes first, slice by slice and row by row.

    Parameters
    ----------
    input : array_like
        One to three dimensions, of numbers or booleans. One pixel at least must be zero. NaN is not.
    sampling : float or sequence of float, optional
        The size of a pixel: a number, or one for each axis; none is more than 1,000 times another one. Sizes that are to
        each other as whole numbers up to 1,000, such as 0.065, 0.065 and 0.2, are taken exactly. Others are rounded for
        comparisons: a zero whose distance is greater by a part of about n (D / s)**2 / 2**62 may be taken. D is the
        image's diagonal and s the least size; n is the number of pixels of the longest side, rounded up to a power of
        two. It is 2e-10 where D is 1,000 s and n 1,024. Images where it is more than 1 % are refused.
    return_distances, return_indices : bool, optional
        What is wanted: one of them or both.
    distances : ndarray, optional
        Where the distances go, which are not returned then: of the shape of `input`.
    indices : ndarray, optional
        Where the indices go, which are not returned then: int32, one axis before those of `input`.
    float64_distances : bool, optional
        Whether distances are float64, as SciPy's are, or float32, as those of CuPy and edt: half of the memory.
    <device>

    Returns
    -------
    distances : ndarray
        float64 or float32 of the shape of `input`, if `return_distances`.
    indices : ndarray
        int32, one axis before those of `input`: the index of the nearest zero along each axis, if `return_indices`.

    Raises
    ------
    BadArgument, DeviceMemoryError, DeviceError

    Examples
    --------
    >>> import vorocl
    >>> vorocl.distance_transform_edt([[0, 1, 1, 1]], sampling=0.5)
    array([[0. , 0.5, 1. , 1.5]])
    >>> vorocl.distance_transform_edt([[0, 1, 1, 0]], return_distances=False, return_indices=True)[1]
    array([[0, 0, 3, 3]], dtype=int32)
    """
    pixels = to_pixels(to_mask(input, "input"), "input")
    sizes = to_sampling(sampling, pixels.ndim, "sampling")
    shape, whole = pixels.shape, (pixels.ndim, *pixels.shape)
    of_distances = np.float64 if to_flag(float64_distances, "float64_distances") else np.float32
    far = _place(distances, return_distances, shape, of_distances, "distances")
    where = _place(indices, return_indices, whole, np.int32, "indices")
    if far is None and where is None:
        raise BadArgument("return_distances or return_indices must be True: nothing is wanted")
    if pixels.size > 0 and not _transform(pixels, True, device, sizes, distances=far, indices=where):
        raise BadArgument("input has no zero that distances could be to")
    results = []
    for given, made in (distances, far), (indices, where):
        if given is None:
            results += [] if made is None else [made]
        elif made is not None and made is not given:
            given[...] = made
    return results[0] if len(results) == 1 else tuple(results) or None


def _place(
    given: Optional[NDArray[Any]], wanted: bool, shape: Tuple[int, ...], dtype: Any, name: str
) -> Optional[NDArray[Any]]:
    """Where a function writes what is wanted: the caller's array, or a new one if there is none or it is not contiguous."""
    if not to_flag(wanted, f"return_{name}"):
        if given is not None:
            raise BadArgument(f"return_{name} must be True where `{name}` is an array")
        return None
    return output(given, shape, dtype, name, copied=True)


@with_parameters
def distances(
    points: ArrayLike,
    grid: Union[Grid, Shape],
    *,
    method: Method = "exact",
    metric: Metric = "euclidean",
    outside: Outside = "count",
    snap: Optional[bool] = None,
    weights: Optional[ArrayLike] = None,
    units: Optional[Units] = None,
    out: Optional[NDArray[np.float32]] = None,
    device: Optional[Device] = None,
    **frame: Unpack[Frame],
) -> NDArray[np.float32]:
    """Give every pixel the distance to its nearest point.

    Parameters
    ----------
    <points, grid, method, metric, outside, snap, weighted, units>
    out : ndarray, optional
        Where the distances go: float32 of the shape, C-contiguous. Without it, a new array.
    <device>

    Returns
    -------
    ndarray
        float32 of the shape: of the pixels' centres, within 3 units in the last place; infinite without points. Where
        pixels are no squares in the units of `bounds` a length has no scale: then ``units="pixels"`` is needed.

    Raises
    ------
    BadPoint, BadArgument, DeviceMemoryError, DeviceError

    Examples
    --------
    >>> import vorocl
    >>> vorocl.distances([(0.5, 0.5)], (2, 4), metric="manhattan")
    array([[0., 1., 2., 3.],
           [1., 2., 3., 4.]], dtype=float32)
    """
    to_units(units, True)
    made = to_grid(grid, frame)
    values = output(out, made.shape, np.float32)
    return _filled(points, made, method, metric, outside, snap, weights, device).distances(values, units=units)


def _measured(
    points: ArrayLike,
    grid: Union[Grid, Shape],
    *,
    method: Method = "exact",
    metric: Metric = "euclidean",
    outside: Outside = "count",
    snap: Optional[bool] = None,
    weights: Optional[ArrayLike] = None,
    units: Optional[Units] = None,
    device: Optional[Device] = None,
    **frame: Unpack[Frame],
) -> Diagram:
    """The diagram whose measures are asked for, in these units."""
    to_units(units, True)
    return _filled(points, to_grid(grid, frame), method, metric, outside, snap, weights, device)


def _of_points(diagram_of: Callable[How, Diagram], measure: Callable[..., Found]) -> Callable[How, Found]:
    """What a method measures of a diagram, as a function of its points, with the parameters of `diagram_of`."""

    def function(*arguments: How.args, **named: How.kwargs) -> Found:
        return measure(diagram_of(*arguments, **named), units=named.get("units"))

    made: Any = function
    made.__name__ = made.__qualname__ = measure.__name__
    returned = measure.__annotations__["return"]
    made.__annotations__ = {**diagram_of.__annotations__, "return": returned}
    made.__signature__ = inspect.signature(diagram_of).replace(return_annotation=returned)
    text = inspect.getdoc(measure)
    if text is not None:  # python -OO leaves none
        title = "Parameters\n----------\n"
        made.__doc__ = text.replace(title, title + "<points, grid, method, metric, outside, snap, weighted, device>\n")
    return with_parameters(function)


cells = _of_points(_measured, Diagram.cells)
areas = _of_points(_measured, Diagram.areas)
adjacency = _of_points(_measured, Diagram.adjacency)
vertices = _of_points(_measured, Diagram.vertices)


class Relaxation(NamedTuple):
    """What `relax` did."""

    points: NDArray[np.float64]
    """(N, 2): the points at the end, in the units that they were given in; NaN for absent ones."""
    energies: NDArray[np.float64]
    """At the start and after each round: the sum of the squared distances of all pixels to their points, in pixels; with a
    density the sum of density times squared distance."""
    moved: NDArray[np.int64]
    """The points that each round moved: one entry less than the energies."""
    converged: bool
    """Whether no point would move by 1/64 of a pixel or more."""


@with_parameters
def relax(
    points: ArrayLike,
    grid: Union[Grid, Shape],
    *,
    rounds: int = 100,
    density: Optional[ArrayLike] = None,
    exact: bool = False,
    method: Method = "exact",
    outside: Outside = "count",
    snap: Optional[bool] = None,
    device: Optional[Device] = None,
    **frame: Unpack[Frame],
) -> Relaxation:
    """Move points to the centroids of their cells, again and again: Lloyd's algorithm on pixels, or on polygons.

    A round moves every point to its cell's centroid, rounded to 1/4096 of a pixel, in Euclidean diagrams; to the pixel
    or voxel that is nearest to it where points are snapped, and in volumes, where a point that lies in it stays. Ctrl-C
    ends it after a round.

    Parameters
    ----------
    <points, grid>
    rounds : int, optional
        How many at most. It ends before if no point would move by 1/64 of a pixel or more.
    density : array_like, optional
        How dense the points shall be: an image of the grid with a number of at least 0 for each pixel. The centroids are
        those of cells whose pixels weigh as much (Secord 2002, "Weighted Voronoi stippling"). Weights are rounded to
        1/65535 of the greatest. Points whose cells weigh nothing stay. Many points come to lie as densely as the square
        root of the density: give its square for points as dense as it is.
    exact : bool, optional
        Move the points to the centroids of their polygons, in volumes of their polyhedra, as `exact_cells` cuts them:
        anywhere, so that cells become as even as polygons do where there are four pixels or more for each point. The
        energies are of pixels, and it ends when no point moves by 1/64 of one. Without a density, and not of snapped points.
    <method, outside, snap, device>

    Returns
    -------
    Relaxation
        With `points` in the units that they were given in, where they are at the end, `energies`, `moved` and
        `converged`.

    Raises
    ------
    BadPoint, BadArgument, DeviceMemoryError, DeviceError

    Examples
    --------
    >>> import vorocl
    >>> relaxed = vorocl.relax([(0.5, 0.5), (1.5, 0.5)], (4, 8))
    >>> relaxed.points.tolist(), relaxed.converged
    ([[2.0, 2.0], [6.0, 2.0]], True)
    """
    shown_by = to_grid(grid, frame)
    seeds = Seeds(points, shown_by, outside=outside, snap=to_snap(snap, method), device=device)
    made = Diagram(shown_by, device=device)
    weights = None if density is None else to_density(density, made.shape)
    is_exact = to_flag(exact, "exact")
    energies, moved, converged = made._diagram.relax(
        seeds._seeds, to_text(method, "method"), "euclidean", to_count(rounds, "rounds"), weights, is_exact
    )
    places = np.empty((len(seeds), len(made.shape)))
    seeds._seeds.read(places, in_pixels=False, themselves=is_exact)
    return Relaxation(places, np.array(energies), np.array(moved, np.int64), converged)


def similarity(a: ArrayLike, b: ArrayLike) -> float:
    """Return 100 * pixels with equal labels / all pixels, of two images of labels.

    Parameters
    ----------
    a, b : array_like
        Integers, both of one shape (H, W) or (D, H, W).

    Returns
    -------
    float
        Percent.

    Raises
    ------
    BadArgument

    Examples
    --------
    >>> import vorocl
    >>> vorocl.similarity([[0, 1], [1, 1]], [[0, 0], [1, 1]])
    75.0
    """
    first, second = to_labels(a, "a"), to_labels(b, "b")
    if first.shape != second.shape:
        raise BadArgument(f"labels of the shapes {first.shape} and {second.shape} cannot be compared")
    return 100 * int(np.count_nonzero(first == second)) / first.size


@with_parameters
def errors(
    labels: ArrayLike,
    points: ArrayLike,
    grid: Union[Grid, Shape, None] = None,
    *,
    metric: Metric = "euclidean",
    outside: Outside = "count",
    truth: Truth = "snapped",
    device: Optional[Device] = None,
    **frame: Unpack[Frame],
) -> DistanceErrors:
    """Judge labels by an exact diagram of the points: how many are wrong, and by how many pixels.

    A pixel that is as near to the point of its label as to that of the exact one is right: a tie may be given to any
    point.

    Parameters
    ----------
    labels : array_like
        Integers, shape (H, W) or (D, H, W): rows of `points`.
    <points>
    grid : Grid, optional
        That of the labels. Without it, the one of their shape, and what else a `Grid` says are keywords here, too.
    <metric, outside, truth, device>

    Returns
    -------
    DistanceErrors
        With `pixels`, `wrong_pixels`, `wrong_percent`, `unlabelled_pixels` (those of the wrong ones whose label is no
        point's), `largest_excess` and `mean_excess`: how much farther the point of a pixel's label is than its nearest
        point, in pixels, the mean over all pixels.

    Raises
    ------
    BadPoint, BadArgument, DeviceMemoryError, DeviceError

    Examples
    --------
    >>> import vorocl
    >>> wrong = vorocl.errors([[0, 0, 0, 1]], [(0.5, 0.5), (3.5, 0.5)])
    >>> wrong.wrong_pixels, wrong.largest_excess
    (1, 1.0)
    """
    image = to_labels(labels)
    to_truth(truth)
    shape: Any = image.shape
    shown_by = to_grid(shape if grid is None else grid, frame)
    seeds = Seeds(points, shown_by, outside=outside, device=device)
    judged = Diagram(shown_by, device=device)
    judged.write(image, seeds, metric)
    return judged.errors(truth)
