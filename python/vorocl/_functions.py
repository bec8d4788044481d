"""Diagrams and their measures by one call each, from arrays to arrays."""

from __future__ import annotations

import math
import threading
from typing import Any, NamedTuple, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _vorocl
from ._arguments import (
    Bounds,
    Method,
    Metric,
    Outside,
    Periodic,
    Sampling,
    Shape,
    Truth,
    Units,
    output,
    periodic_of,
    shape_of,
    shown,
    to_bounds,
    to_count,
    to_density,
    to_flag,
    to_grid,
    to_image,
    to_labels,
    to_number,
    to_outside,
    to_points,
    to_sampling,
    to_snap,
    to_text,
    to_truth,
    to_units,
)
from ._device import Device, to_device
from ._errors import BadArgument
from ._objects import Diagram, Seeds
from ._parameters import with_parameters

NO_LABEL = 0xFFFFFFFF
"""The label of a pixel that has no nearest seed, because there are no seeds."""

_CONTINUING = {method.name for method in _vorocl.methods() if method.continues}


class _Workspace(threading.local):
    """What the last call of a thread worked in, for the next one that is like it."""

    made_for: Optional[Tuple[Any, ...]] = None
    seeds: Seeds
    diagram: Diagram


_workspace = _Workspace()


def _filled(
    points: ArrayLike,
    shape: Shape,
    method: Method,
    metric: Metric,
    bounds: Optional[Bounds],
    periodic: Periodic,
    tilt: float,
    outside: Outside,
    y_up: bool,
    snap: Optional[bool],
    device: Optional[Device],
    labels: Optional[NDArray[np.uint32]] = None,
) -> Diagram:
    """The diagram, which is the thread's until its next call; or its labels alone, in an array."""
    grid = to_grid(shape, periodic, bounds, outside, y_up, tilt)
    shape, periodic, tilt = shape_of(grid), periodic_of(grid), grid.tilt
    corners, array = to_bounds(bounds), to_points(points, len(shape))
    snapped = to_snap(snap, shape, method)
    wanted = (shape, periodic, tilt, corners, to_outside(outside), y_up, snapped, to_device(device))
    if _workspace.made_for != wanted:
        _workspace.made_for = None
        seeds = Seeds(
            array,
            shape,
            bounds=corners,
            periodic=periodic,
            tilt=tilt,
            outside=outside,
            y_up=y_up,
            snap=snapped,
            device=device,
        )
        _workspace.seeds, _workspace.diagram = seeds, Diagram(shape, periodic=periodic, device=device)
        _workspace.made_for = wanted
    else:
        _workspace.seeds._seeds.move_to(array, None)  # without asking how far
    made = _workspace.diagram
    if method in _CONTINUING:
        made = Diagram(shape, periodic=periodic, device=device)  # or it would go on from the last call's labels
    if labels is None:
        made.fill(_workspace.seeds, method, metric)
    else:
        made._fill_into(_workspace.seeds, method, metric, labels)
    return made


@with_parameters
def diagram(
    points: ArrayLike,
    shape: Shape,
    *,
    method: Method = "exact",
    metric: Metric = "euclidean",
    bounds: Optional[Bounds] = None,
    periodic: Periodic = (False, False),
    tilt: float = 0.0,
    outside: Outside = "count",
    y_up: bool = False,
    snap: Optional[bool] = None,
    out: Optional[NDArray[np.uint32]] = None,
    device: Optional[Device] = None,
) -> NDArray[np.uint32]:
    """Give every pixel the row of its nearest point.

    "exact" takes the points themselves, rounded to 1/4096 of a pixel of the grid, and computes in integers: its labels
    are those of the point nearest to the pixel's centre, the same on every device. Of several points at the least
    distance the one with the least y wins, counted down the grid, then the one with the least x, then the one with the
    lowest row of `points`. A method that floods, and ``snap=True``, move points to the centres of their pixels first.

    In a volume, of a shape (D, H, W), points are rows (x, y, z), and each lies at the centre of its voxel: of several at
    the least distance the one with the least z wins, then y, then x, then the row. There "exact" is Euclidean and needs
    a CPU, "jfa" and its variants are the other methods, and there are no bounds, periods, tilts and points outside.

    Parameters
    ----------
    <points, shape, method, metric, bounds, periodic, tilt, outside, y_up, snap>
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
    A thread keeps the device memory of its last call, 5.4 bytes per pixel for "exact" and 13 for the others, until it
    makes a call with another grid; in a volume 4.2 and 12. `Diagram` keeps its own.

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
    """
    labels = output(out, shape_of(to_grid(shape, periodic)), np.uint32)
    _filled(points, shape, method, metric, bounds, periodic, tilt, outside, y_up, snap, device, labels)
    return labels


def _of_mask(
    mask: NDArray[Any],
    periodic: Periodic,
    device: Optional[Device],
    method: Method,
    metric: Metric,
    spacing: Sequence[int] = (1,),
) -> Diagram:
    """The diagram of the non-zero pixels of an image; one of a single slice is a plane's."""
    mask = mask[0] if mask.ndim == 3 and len(mask) == 1 else mask
    shape: Any = mask.shape
    grid = to_grid(shape, periodic)
    if max(spacing) > 1:
        grid = grid.spaced(spacing[-1], spacing[-2], spacing[0] if mask.ndim == 3 else 1)
    made = Diagram(shape, periodic=periodic, device=device)
    pixels = np.ascontiguousarray(mask != 0).view(np.uint8)
    seeds = _vorocl.Seeds.from_mask(made.device._device, grid, pixels)
    made._diagram.fill(seeds, to_text(method, "method"), to_text(metric, "metric"), None)
    return made


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
        Shape (H, W) or (D, H, W), of numbers or booleans.
    <method, metric, periodic>
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
    image = to_image(mask, "mask")
    if image.dtype.kind not in "biuf":
        raise BadArgument(f"mask must be numbers or booleans; this array has the dtype {image.dtype}")
    shape: Any = image.shape
    labels = output(out, shape, np.uint32)
    made = _of_mask(image, periodic, device, method, metric)
    made.read(labels.reshape(made.shape))
    return labels


@with_parameters
def expand_labels(
    labels: ArrayLike,
    distance: Optional[float] = None,
    spacing: Sampling = None,
    *,
    device: Optional[Device] = None,
) -> NDArray[Any]:
    """Grow labelled regions into the background, as ``skimage.segmentation.expand_labels`` does, without overlaps.

    Each pixel of the background takes the label of the nearest pixel that has one, by exact Euclidean distance
    between pixel centres. Of several at the least distance the one that comes first, row by row of the image, wins;
    scikit-image leaves it open which one does. Volumes need a CPU.

    Parameters
    ----------
    labels : array_like
        Shape (H, W) or (D, H, W), integers; 0 is the background.
    distance : float, optional
        How far regions grow, in pixels or in units of `spacing`: as far as this and no farther. Without it, until no
        background is left. (scikit-image grows by 1 without it.)
    spacing : float or sequence of float, optional
        The size of a pixel: a number, or one for each axis. They must be whole multiples, up to 16, of one size. Sizes
        that differ need a CPU, and a side then has at most 16,384 units of that size, such as 1,024 pixels of 16 units.
        Each new ratio builds the kernels anew, so its first call takes longer.
    <device>

    Returns
    -------
    ndarray
        The shape and dtype of `labels`. All 0 if there is no label.

    Raises
    ------
    BadArgument, DeviceMemoryError, DeviceError

    Examples
    --------
    >>> import vorocl
    >>> vorocl.expand_labels([[7, 0, 0, 0, 0, 9]], distance=1)
    array([[7, 7, 0, 0, 9, 9]])
    >>> vorocl.expand_labels([[7, 0, 0, 0, 0, 9]])
    array([[7, 7, 7, 9, 9, 9]])
    """
    image = to_image(labels, "labels")
    if image.dtype.kind not in "biu":
        raise BadArgument(f"labels must be integers; this array has the dtype {image.dtype}")
    farthest = math.inf if distance is None else to_number(distance, "distance")
    if not farthest >= 0:
        raise BadArgument(f"distance must be at least 0; this is {shown(distance)}")
    size, multiples = to_sampling(spacing, image.ndim, "spacing")
    made = _of_mask(image, (False, False), device, "exact", "euclidean", multiples)
    if distance is None:
        nearest = made.read()
    else:
        nearest = np.empty(made.shape, np.uint32)
        made._diagram.expand(farthest / size, nearest)
    known = np.zeros(np.count_nonzero(image) + 1, image.dtype)  # the background is the last one
    known[:-1] = image[image != 0]
    expanded: NDArray[Any] = known.take(np.minimum(nearest, len(known) - 1)).reshape(image.shape)
    return expanded


@with_parameters
def distance_transform_edt(
    mask: ArrayLike,
    sampling: Sampling = None,
    return_distances: bool = True,
    return_indices: bool = False,
    *,
    device: Optional[Device] = None,
) -> Any:
    """Give every non-zero pixel its distance to the nearest pixel that is zero, as SciPy's function of this name does.

    ``from vorocl import distance_transform_edt`` instead of ``from scipy.ndimage import ...`` is what changes. The
    distances are SciPy's, to the bit without a `sampling`, else to a rounding. Volumes need a CPU. Of several zeros at
    the least distance SciPy leaves open which one `indices` names; here it is the one that comes first, slice by slice
    and row by row.

    Parameters
    ----------
    mask : array_like
        Shape (H, W) or (D, H, W), of numbers or booleans. One pixel at least must be zero.
    sampling : float or sequence of float, optional
        The size of a pixel: a number, or one for each axis. They must be whole multiples, up to 16, of one size. Sizes
        that differ need a CPU, and a side then has at most 16,384 units of that size, such as 1,024 pixels of 16 units.
        Each new ratio builds the kernels anew, so its first call takes longer.
    return_distances, return_indices : bool, optional
        What is wanted: one of them or both.
    <device>

    Returns
    -------
    distances : ndarray
        float64 of the mask's shape, if `return_distances`.
    indices : ndarray
        int32, one axis before those of the mask: the index of the nearest zero along each axis, if `return_indices`.

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
    image = to_image(mask, "mask")
    if image.dtype.kind not in "biuf":
        raise BadArgument(f"mask must be numbers or booleans; this array has the dtype {image.dtype}")
    size, multiples = to_sampling(sampling, image.ndim, "sampling")
    wants_distances = to_flag(return_distances, "return_distances")
    wants_indices = to_flag(return_indices, "return_indices")
    if not (wants_distances or wants_indices):
        raise BadArgument("return_distances or return_indices must be True: nothing is wanted")
    zeros = image == 0
    if not zeros.any():
        raise BadArgument("mask has no zero that distances could be to")
    made = _of_mask(zeros, (False, False), device, "exact", "euclidean", multiples)
    results = []
    if wants_distances:
        squared = np.empty(made.shape, np.int32)
        made._diagram.integer_distances(squared)
        lengths = np.sqrt(squared, dtype=np.float64).reshape(image.shape)
        results.append(lengths if size == 1 else lengths * size)
    if wants_indices:
        nearest = made.read().reshape(image.shape)
        indices = np.empty((image.ndim, *image.shape), np.int32)
        for along, of_zeros in zip(indices, np.nonzero(zeros)):
            of_zeros.astype(np.int32).take(nearest, out=along)
        results.append(indices)
    return results[0] if len(results) == 1 else tuple(results)


@with_parameters
def distances(
    points: ArrayLike,
    shape: Shape,
    *,
    method: Method = "exact",
    metric: Metric = "euclidean",
    bounds: Optional[Bounds] = None,
    periodic: Periodic = (False, False),
    tilt: float = 0.0,
    outside: Outside = "count",
    y_up: bool = False,
    snap: Optional[bool] = None,
    units: Optional[Units] = None,
    out: Optional[NDArray[np.float32]] = None,
    device: Optional[Device] = None,
) -> NDArray[np.float32]:
    """Give every pixel the distance to its nearest point.

    Parameters
    ----------
    <points, shape, method, metric, bounds, periodic, tilt, outside, y_up, units>
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
    values = output(out, shape_of(to_grid(shape, periodic)), np.float32)
    return _filled(points, shape, method, metric, bounds, periodic, tilt, outside, y_up, snap, device).distances(values, units=units)


@with_parameters
def cells(
    points: ArrayLike,
    shape: Shape,
    *,
    method: Method = "exact",
    metric: Metric = "euclidean",
    bounds: Optional[Bounds] = None,
    periodic: Periodic = (False, False),
    tilt: float = 0.0,
    outside: Outside = "count",
    y_up: bool = False,
    snap: Optional[bool] = None,
    units: Optional[Units] = None,
    device: Optional[Device] = None,
) -> NDArray[Any]:
    """Measure the cell of every point.

    Parameters
    ----------
    <points, shape, method, metric, bounds, periodic, tilt, outside, y_up, snap, units, device>

    Returns
    -------
    ndarray
        A structured array with one row per point; ``pandas.DataFrame(...)`` makes a table of it. Its dtype in pixels is
        ``vorocl.CELL``, which has whole numbers of pixels. Along a periodic axis, pixels count where they lie the shorter
        way round from the point, which may be outside the grid. The fields are

        ``x``, ``y``
            The point's position in the diagram; NaN if the point is absent.
        ``area``
            0 if the point is absent, or others are nearer to all pixels. Areas sum to that of the grid.
        ``centroid_x``, ``centroid_y``
            The mean of the centres of the pixels; NaN of an empty cell.
        ``left``, ``top``, ``right``, ``bottom``
            In pixels the first and last columns and rows; right < left and bottom < top in an empty cell. In the units
            of the points the outer edges of these, so that top > bottom if y goes up; NaN of an empty cell.
        ``perimeter``
            Of the pixel edges that the cell shares with other cells: the grid's edge is no border.
        ``neighbours``
            Cells that it shares an edge with.
        ``largest_distance``
            Of its pixels to the point, in `metric`; NaN of an empty cell.
        ``touches_border``
            Whether it has a pixel next to a border of the grid; a periodic axis has none.

        Where pixels are no squares in the units of `bounds` a length has no scale: there the names of those in pixels
        say so, ``perimeter_px`` and ``largest_distance_px``.

        In a volume the dtype is ``vorocl.CELL3``, all in voxels: there are ``z``, ``centroid_z``, ``front`` and ``back``
        (the first and last slices) too, ``volume`` stands for the area, and ``surface``, of the voxel faces that the
        cell shares with others, for the perimeter.

    Raises
    ------
    BadPoint, BadArgument, DeviceMemoryError, DeviceError

    Examples
    --------
    >>> import vorocl
    >>> cells = vorocl.cells([(0.5, 0.5), (7.5, 3.5)], (4, 8))
    >>> cells["area"]
    array([16, 16], dtype=uint32)
    >>> cells[["left", "top", "right", "bottom"]][1].tolist()
    (3, 0, 7, 3)
    >>> whole = vorocl.cells([(1, 0.5)], (4, 8), bounds=(0, 0, 4, 2), y_up=True)[0]
    >>> whole[["area", "centroid_x", "centroid_y", "top"]].tolist()
    (8.0, 2.0, 1.0, 2.0)
    >>> vorocl.cells([(0, 0, 0), (5, 0, 0)], (2, 3, 6), method="jfa")[["volume", "centroid_z", "surface"]].tolist()
    [(18, 1.0, 6), (18, 1.0, 6)]
    """
    to_units(units, True)
    return _filled(points, shape, method, metric, bounds, periodic, tilt, outside, y_up, snap, device).cells(units=units)


@with_parameters
def areas(
    points: ArrayLike,
    shape: Shape,
    *,
    method: Method = "exact",
    metric: Metric = "euclidean",
    bounds: Optional[Bounds] = None,
    periodic: Periodic = (False, False),
    tilt: float = 0.0,
    outside: Outside = "count",
    y_up: bool = False,
    snap: Optional[bool] = None,
    units: Optional[Units] = None,
    device: Optional[Device] = None,
) -> NDArray[Any]:
    """Measure the areas of the cells and nothing else, which takes a part of the time that `cells` takes.

    Parameters
    ----------
    <points, shape, method, metric, bounds, periodic, tilt, outside, y_up, snap, units, device>

    Returns
    -------
    ndarray
        Shape (N,), by row of `points`, as the field ``area`` of `cells`: uint32 in pixels, else float64. In a volume
        the volumes, uint32 in voxels.

    Raises
    ------
    BadPoint, BadArgument, DeviceMemoryError, DeviceError

    Examples
    --------
    >>> import vorocl
    >>> vorocl.areas([(0.5, 0.5), (7.5, 3.5)], (4, 8))
    array([16, 16], dtype=uint32)
    >>> vorocl.areas([(0.25, 0.25), (3.75, 1.75)], (4, 8), bounds=(0, 0, 4, 2))
    array([4., 4.])
    """
    to_units(units, True)
    return _filled(points, shape, method, metric, bounds, periodic, tilt, outside, y_up, snap, device).areas(units=units)


@with_parameters
def adjacency(
    points: ArrayLike,
    shape: Shape,
    *,
    method: Method = "exact",
    metric: Metric = "euclidean",
    bounds: Optional[Bounds] = None,
    periodic: Periodic = (False, False),
    tilt: float = 0.0,
    outside: Outside = "count",
    y_up: bool = False,
    snap: Optional[bool] = None,
    units: Optional[Units] = None,
    device: Optional[Device] = None,
) -> Tuple[NDArray[np.uint32], NDArray[np.uint32]]:
    """Find the cells that touch, and how long their borders are.

    In an exact Euclidean diagram these are the edges of the Delaunay triangulation, but for cells that touch along
    less than a few pixels.

    Parameters
    ----------
    <points, shape, method, metric, bounds, periodic, tilt, outside, y_up, snap, units, device>

    Returns
    -------
    pairs : ndarray
        uint32, shape (M, 2): rows (a, b) with a < b, each pair once, sorted.
    lengths : ndarray
        Shape (M,): of the pixel edges that the cells share; uint32 in pixels, else float64. Where pixels are no squares
        in the units of `bounds` a length has no scale: then ``units="pixels"`` is needed. In a volume the areas of
        contact: of the voxel faces that the cells share.

    Raises
    ------
    BadPoint, BadArgument, DeviceMemoryError, DeviceError

    Examples
    --------
    >>> import vorocl
    >>> pairs, lengths = vorocl.adjacency([(0.5, 0.5), (4.5, 0.5), (8.5, 0.5)], (2, 9))
    >>> pairs.tolist(), lengths.tolist()
    ([[0, 1], [1, 2]], [2, 2])
    """
    to_units(units, True)
    return _filled(points, shape, method, metric, bounds, periodic, tilt, outside, y_up, snap, device).adjacency(units=units)


@with_parameters
def vertices(
    points: ArrayLike,
    shape: Shape,
    *,
    method: Method = "exact",
    metric: Metric = "euclidean",
    bounds: Optional[Bounds] = None,
    periodic: Periodic = (False, False),
    tilt: float = 0.0,
    outside: Outside = "count",
    y_up: bool = False,
    snap: Optional[bool] = None,
    units: Optional[Units] = None,
    device: Optional[Device] = None,
) -> NDArray[np.float64]:
    """Find the vertices: the pixel corners where three or more cells meet.

    Parameters
    ----------
    <points, shape, method, metric, bounds, periodic, tilt, outside, y_up, snap, units, device>

    Returns
    -------
    ndarray
        float64, shape (M, 2), rows (x, y), sorted by row of pixels and then column. Corners on the grid's edge do not
        count; along a periodic axis there is none, and the corners between the last pixels and the first are at its end.

    Raises
    ------
    BadPoint, BadArgument, DeviceMemoryError, DeviceError

    Examples
    --------
    >>> import vorocl
    >>> vorocl.vertices([(0.5, 0.5), (3.5, 0.5), (1.5, 3.5)], (4, 4)).tolist()
    [[2.0, 2.0]]
    """
    to_units(units, True)
    return _filled(points, shape, method, metric, bounds, periodic, tilt, outside, y_up, snap, device).vertices(units=units)


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
    shape: Shape,
    *,
    rounds: int = 100,
    density: Optional[ArrayLike] = None,
    method: Method = "exact",
    bounds: Optional[Bounds] = None,
    periodic: Periodic = (False, False),
    outside: Outside = "count",
    y_up: bool = False,
    snap: Optional[bool] = None,
    device: Optional[Device] = None,
) -> Relaxation:
    """Move points to the centroids of their cells, again and again: Lloyd's algorithm on pixels.

    A round moves every point to its cell's centroid, rounded to 1/4096 of a pixel, in Euclidean diagrams; to the pixel
    that is nearest to it where points are snapped. Ctrl-C ends it after a round.

    Parameters
    ----------
    <points, shape>
    rounds : int, optional
        How many at most. It ends before if no point would move by 1/64 of a pixel or more.
    density : array_like, optional
        How dense the points shall be: an image of `shape` with a number of at least 0 for each pixel. The centroids are
        those of cells whose pixels weigh as much (Secord 2002, "Weighted Voronoi stippling"). Weights are rounded to
        1/65535 of the greatest. Points whose cells weigh nothing stay. Many points come to lie as densely as the square
        root of the density: give its square for points as dense as it is.
    <method, bounds, periodic, outside, y_up, snap, device>

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
    seeds = Seeds(
        points,
        shape,
        bounds=bounds,
        periodic=periodic,
        outside=outside,
        y_up=y_up,
        snap=to_snap(snap, shape_of(to_grid(shape, periodic)), method),
        device=device,
    )
    made = Diagram(shape, periodic=periodic, device=device)
    weights = None if density is None else to_density(density, made.shape)
    done = made._diagram.relax(
        seeds._seeds, to_text(method, "method"), "euclidean", to_count(rounds, "rounds"), weights
    )
    places = np.empty((len(seeds), 2))
    seeds._seeds.read(places, in_pixels=False)
    return Relaxation(
        places, np.array(done.energies), np.array(done.moved, np.int64), done.converged
    )


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
    *,
    metric: Metric = "euclidean",
    bounds: Optional[Bounds] = None,
    periodic: Periodic = (False, False),
    tilt: float = 0.0,
    outside: Outside = "count",
    y_up: bool = False,
    truth: Truth = "snapped",
    device: Optional[Device] = None,
) -> _vorocl.DistanceErrors:
    """Judge labels by an exact diagram of the points: how many are wrong, and by how many pixels.

    A pixel that is as near to the point of its label as to that of the exact one is right: a tie may be given to any
    point.

    Parameters
    ----------
    labels : array_like
        Integers, shape (H, W) or (D, H, W): rows of `points`.
    <points, metric, bounds, periodic, tilt, outside, y_up, truth, device>

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
    seeds = Seeds(
        points, shape, bounds=bounds, periodic=periodic, tilt=tilt, outside=outside, y_up=y_up, device=device
    )
    judged = Diagram(shape, periodic=periodic, device=device)
    judged.write(image, seeds, metric)
    return judged.errors(truth)
