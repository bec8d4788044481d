"""Seeds and diagrams that stay on the device, and simulations of moving seeds."""

from __future__ import annotations

import math
import sys
from typing import Any, List, NamedTuple, Optional, Tuple, Union, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _vorocl
from ._arguments import (
    Method,
    Metric,
    Outside,
    Truth,
    Units,
    output,
    row_of,
    to_labels,
    to_number,
    to_one_of,
    to_outside,
    to_points,
    to_snap,
    to_text,
    to_truth,
    to_units,
    to_weights,
)
from ._device import Buffer, Device, OnDevice, is_of_pyopencl, to_device
from ._errors import BadArgument
from ._grid import Bounds, Frame, Grid, Shape, Tilt, Unpack, to_globe, to_grid
from ._parameters import with_parameters

CELL = row_of(
    {
        np.float64: "x y z centroid_x centroid_y centroid_z largest_distance",
        np.uint32: "area perimeter neighbours",
        np.int32: "left top front right bottom back",
        np.bool_: "touches_border",
    }
)
"""One row of `cells` in pixels. Those of a plane leave out ``z``, ``centroid_z``, ``front`` and ``back``."""

GLOBE_CELL = row_of(
    {
        np.float64: "x y area centroid_x centroid_y largest_distance",
        np.uint32: "pixels neighbours",
        np.bool_: "touches_border",
    }
)
"""One row of `cells` by great circles."""


class DistanceErrors(NamedTuple):
    """What `errors` finds."""

    pixels: int
    wrong_pixels: int
    unlabelled_pixels: int
    largest_excess: float
    mean_excess: float

    @property
    def wrong_percent(self) -> float:
        """Of the pixels."""
        return 100 * self.wrong_pixels / self.pixels


def _refuse_weights(weights: Optional[ArrayLike]) -> None:
    if weights is not None:
        raise BadArgument("weights are those of arrays of NumPy's: points on the device have none")


def to_seeds(seeds: Seeds, metric: Metric) -> _vorocl.Seeds:
    if not isinstance(seeds, Seeds):
        raise BadArgument(f"seeds must be vorocl.Seeds; these are of type {type(seeds).__name__}")
    if to_text(metric, "metric") == "great-circle" and seeds.grid.bounds is None:
        raise BadArgument('metric="great-circle" needs seeds in degrees: give them bounds, such as (-180, -90, 180, 90)')
    return seeds._seeds


@with_parameters
class Seeds(OnDevice):
    """Points as seeds of a diagram, on the device.

    A seed's id is its row. A seed may be absent: it has an id and no cell. Exact diagrams take the points themselves
    unless they are snapped; a method that floods takes the pixels that hold them, and of seeds that share a pixel the
    lowest id owns the cell then.

    Parameters
    ----------
    <points, grid, outside, snap, weighted, device>

    Points may be a `pyopencl.array.Array` of float32 or float64 in the context of `device`, whole and contiguous. They
    stay on the device, are placed there behind what its queue holds, and nothing waits for them unless they may lie
    outside and count. All of them are present, so that a NaN is a bad point, which the next call that waits names.

    Raises
    ------
    BadPoint
        If a point is infinite, 2**31 pixels away, or outside where such points are refused.
    BadArgument, DeviceError

    Examples
    --------
    >>> import numpy as np, vorocl
    >>> seeds = vorocl.Seeds([(0.25, 0.75), (np.nan, 1), (7, 3)], (4, 8))
    >>> len(seeds), seeds.alive
    (3, 2)
    >>> seeds.read()
    array([[0.25, 0.75],
           [ nan,  nan],
           [7.  , 3.  ]])
    >>> vorocl.Seeds([(0.25, 0.75)], (4, 8), snap=True).read()
    array([[0.5, 0.5]])
    """

    def __init__(
        self,
        points: ArrayLike,
        grid: Union[Grid, Shape],
        *,
        outside: Outside = "count",
        snap: Optional[bool] = None,
        weights: Optional[ArrayLike] = None,
        device: Optional[Device] = None,
        **frame: Unpack[Frame],
    ) -> None:
        self._grid, self._outside = to_grid(grid, frame), to_outside(outside)  # the grid of the present frame
        self._are_in_data = self._grid.bounds is not None or self._grid.y_up  # and not in pixels with y down
        self._device = to_device(device)
        dimensions = len(self._grid.shape)
        how = self._outside, to_snap(snap)
        there = _points_there(points, dimensions)
        if there:
            _refuse_weights(weights)
            self._have_weights = False
            self._seeds = _vorocl.Seeds.from_buffer(self._device._device, self._grid._of(outside), there, *how)
        else:
            array = to_points(points, dimensions)
            given = to_weights(weights, len(array))
            self._have_weights = given is not None
            self._seeds = _vorocl.Seeds(self._device._device, self._grid._of(outside), array, *how, given)

    @property
    def grid(self) -> Grid:
        """The grid of the present frame."""
        return self._grid

    @property
    def device(self) -> Device:
        """Where they are."""
        return self._device

    def __len__(self) -> int:
        return self._seeds.size

    def __repr__(self) -> str:
        return f"<vorocl.Seeds of {len(self)} points>"

    @property
    def alive(self) -> int:
        """How many seeds are not absent."""
        return self._seeds.alive

    def move_to(
        self,
        points: ArrayLike,
        *,
        bounds: Optional[Bounds] = None,
        tilt: Optional[Tilt] = None,
        weights: Optional[ArrayLike] = None,
    ) -> Optional[int]:
        """Move the seeds to new points: a new frame. Their number may change.

        Parameters
        ----------
        points : array_like or pyopencl.array.Array
            As that of the constructor, in the same units. A seed that is absent may come back. Those on the device keep
            the bounds and the tilt.
        bounds : sequence of float, optional
            What the grid shows from this frame on, such as a simulation's box that changes. Without it, what it showed.
        tilt : float or (float, float, float), optional
            The tilt from this frame on, such as that of a box that is sheared. Without it, what it was.
        weights : array_like, optional
            Those of these points, as that of the constructor: seeds with weights go to points with weights.

        Returns
        -------
        int
            The greatest displacement of a seed along an axis since the last frame, in pixels; along a periodic axis the
            shorter way round. Seeds that appear or vanish do not count, and none does where the bounds or the tilt
            are others. None for points on the device: the call would have to wait for it.

        Raises
        ------
        BadPoint
            The seeds are where they were then.
        BadArgument, DeviceError

        Examples
        --------
        >>> import vorocl
        >>> seeds = vorocl.Seeds([(1, 1), (6, 2)], (4, 8))
        >>> seeds.move_to([(1, 3), (5, 2)])
        2
        """
        dimensions, is_same = len(self._grid.shape), bounds is None and tilt is None
        there = _points_there(points, dimensions)
        if there:
            if not is_same:
                raise BadArgument("points on the device keep the bounds and the tilt of their grid: make new Seeds of them")
            _refuse_weights(weights)
            self._seeds.move_to_buffer(there)
            return None
        grid = self._grid._showing(bounds, tilt)
        array = to_points(points, dimensions)
        given = to_weights(weights, len(array))
        self._seeds.move_to(array, None if is_same else grid._of(self._outside), given)
        self._grid, self._have_weights = grid, given is not None
        self._are_in_data = self._are_in_data or bounds is not None
        return int(self._seeds.displacement)

    @with_parameters
    def read(self, *, units: Optional[Units] = None) -> NDArray[np.float64]:
        """Return where exact diagrams have the seeds: the points, rounded to 1/4096 of a pixel, or snapped.

        Parameters
        ----------
        <units>

        Returns
        -------
        ndarray
            Shape (N, 2), rows (x, y), in a volume (N, 3), rows (x, y, z); NaN for a seed that is absent.
        """
        in_pixels = not to_units(units, self._are_in_data)
        points = np.empty((len(self), len(self._grid.shape)))
        self._seeds.read(points, in_pixels=in_pixels)
        return points


@with_parameters
class Diagram(OnDevice):
    """A Voronoi diagram: an image of labels, kept on the device.

    It keeps its working memory, so that filling it again allocates nothing. It remembers the metric and the seeds, where
    they were then: measures ask it for them. Threads that share a diagram take turns.

    Parameters
    ----------
    <grid>
        What its seeds have; their bounds and their tilt it takes from them.
    <device>
    labels : pyopencl.Buffer, optional
        Where the labels are to be: at least 4 bytes per pixel, of the device's context, which kernels can read and write.

    Raises
    ------
    BadArgument
        If the grid is not possible, or the buffer does not fit.
    DeviceMemoryError
        If the device cannot hold the labels.
    DeviceError

    Examples
    --------
    >>> import vorocl
    >>> seeds = vorocl.Seeds([(0.5, 0.5), (7.5, 3.5)], (4, 8))
    >>> diagram = vorocl.Diagram((4, 8))
    >>> _ = diagram.fill(seeds)
    >>> diagram.read()
    array([[0, 0, 0, 0, 0, 1, 1, 1],
           [0, 0, 0, 0, 1, 1, 1, 1],
           [0, 0, 0, 0, 1, 1, 1, 1],
           [0, 0, 0, 1, 1, 1, 1, 1]], dtype=uint32)
    """

    def __init__(
        self,
        grid: Union[Grid, Shape],
        *,
        device: Optional[Device] = None,
        labels: Optional[Buffer] = None,
        **frame: Unpack[Frame],
    ) -> None:
        made = to_grid(grid, frame)
        self._shape, self._units = made.shape, made._units  # the latter of its seeds, when it has some
        self._device = to_device(device)
        self._are_in_data = False  # what the points of its seeds are in
        self._on_globe = False  # by great circles
        self._of_weights = False  # a power diagram
        there = None if labels is None else _handle(labels)
        self._diagram = _vorocl.Diagram(self._device._device, made._of("count"), there)

    @property
    def device(self) -> Device:
        """Where it is."""
        return self._device

    @property
    def shape(self) -> Shape:
        """(H, W) in pixels, or (D, H, W) in voxels."""
        return self._shape

    def __repr__(self) -> str:
        return f"<vorocl.Diagram of the shape {self.shape}>"

    def fill(
        self,
        seeds: Seeds,
        method: Method = "exact",
        metric: Metric = "euclidean",
        max_displacement: Optional[float] = None,
    ) -> _vorocl.Report:
        """Give every pixel the id of its nearest seed. Enqueues the work and returns.

        Parameters
        ----------
        seeds : Seeds
            Of the diagram's shape, periodic axes and device.
        method : str, optional
            "exact", or one that floods and is approximate: "standard-flooding", "jfa", "jfa+1",
            "jfa+2", "1+jfa", "djfa", "low-resolution". "djfa" goes on from the labels that the diagram holds.
        metric : {"euclidean", "manhattan", "great-circle"}, optional
            Of "great-circle" the grid of the seeds has bounds in degrees, and cells reach across its ends if x is periodic.
        max_displacement : float, optional
            For "djfa" alone: how far a seed has moved along an axis, at most, since the diagram was last filled, in
            pixels. Without it, what the seeds know of it.

        Returns
        -------
        Report
            Its `milliseconds` is the device's time, for which it waits, `waves` the number of waves, and
            `host_milliseconds` the time that it took to enqueue the work.

        Raises
        ------
        BadArgument, DeviceMemoryError, DeviceError
        """
        displacement = None if max_displacement is None else to_number(max_displacement, "max_displacement")
        report = self._diagram.fill(
            to_seeds(seeds, metric), to_text(method, "method"), to_text(metric, "metric"), displacement, None
        )
        self._show(seeds, metric)
        return report

    def _show(self, seeds: Optional[Seeds], metric: Metric) -> None:
        """Note what its labels are of."""
        self._on_globe = seeds is not None and metric == "great-circle"
        self._of_weights = seeds is not None and seeds._have_weights
        if seeds is not None:
            self._are_in_data = seeds._are_in_data
            self._units = seeds.grid._units if seeds.grid.bounds else (1,) * len(self._shape)

    def read(self, out: Optional[NDArray[np.uint32]] = None) -> NDArray[np.uint32]:
        """Wait for the diagram and copy its labels.

        Parameters
        ----------
        out : ndarray, optional
            Where they go: uint32 of the diagram's shape, C-contiguous. Without it, a new array.

        Returns
        -------
        ndarray
            uint32 of the diagram's shape: the row of the nearest seed, or ``vorocl.NO_LABEL`` if there are no seeds.
        """
        labels = output(out, self._shape, np.uint32)
        self._diagram.read(labels)
        return labels

    def write(self, labels: ArrayLike, seeds: Optional[Seeds] = None, metric: Metric = "euclidean") -> None:
        """Write labels of the caller's, such as those that another program computed.

        Parameters
        ----------
        labels : array_like
            Integers of the diagram's shape. Those that are no seed's id count as none.
        seeds : Seeds, optional
            Which the labels name. Without them, measures that need seeds raise an error.
        metric : {"euclidean", "manhattan", "great-circle"}, optional
            By which they do.

        Raises
        ------
        BadArgument, DeviceError
        """
        image, named = to_labels(labels, shape=self._shape), None if seeds is None else to_seeds(seeds, metric)
        self._diagram.write(image, named, to_text(metric, "metric"))
        self._show(seeds, metric)

    @property
    def buffer(self) -> Buffer:
        """The labels as a buffer of pyopencl's, without a copy: a uint32 per pixel, row by row.

        They are valid for commands that are enqueued to the device's queue after `fill`.
        """
        import pyopencl

        return cast(Buffer, pyopencl.Buffer.from_int_ptr(self._diagram.buffer, retain=True))

    def _scale(self) -> Tuple[float, Optional[float], Optional[float]]:
        """The area of a pixel in the units of the points, the length of a unit of distances, and that of a pixel's side.

        Lengths are none where pixels are no squares, or voxels no cubes; that of a side is none where axes are spaced.
        """
        sides = self._shape[::-1]
        corners = np.array([(0.0, 0.0, 0.0), (*sides, 1.0)[:3]])
        self._diagram.to_data(corners)
        extents = [float(extent) for extent in abs(corners[1] - corners[0])][: len(sides)]
        area, units = math.prod(extents) / math.prod(sides), math.prod(self._units)

        if len(sides) == 3 or units > 1:
            lengths = [extent / (side * unit) for extent, side, unit in zip(extents, sides, self._units)]
            length = (area / units) ** (1 / len(sides)) if max(lengths) <= 1.01 * min(lengths) else None
            return area, length, length if units == 1 else None
        (width, height), (extent_x, extent_y) = sides, extents
        # To the nearest whole number of pixels, which may change a pixel's sides by 5 %.
        ratio = extent_x * height / (extent_y * width)
        is_square = max(ratio, 1 / ratio) <= 1.05 and (
            abs(height - width * extent_y / extent_x) <= 0.5 or abs(width - height * extent_x / extent_y) <= 0.5
        )
        length = math.sqrt(area) if is_square else None
        return area, length, length

    def _length(self, of_sides: bool = False) -> float:
        """The length of a unit of distances, or of a pixel's side, in the units of the points."""
        if self._on_globe:
            raise BadArgument('by great circles borders have no length in kilometres: give units="pixels"')
        length = self._scale()[2 if of_sides else 1]
        if length is None:
            raise BadArgument(
                'pixels are no squares in the units of the bounds, so lengths have no scale: give units="pixels", or a '
                "shape like that of the bounds"
            )
        return length

    def _in_data_of_plane(self, units: Optional[Units], what: str) -> bool:
        """Whether results are to be brought into the units of the data. On the globe they are in its own."""
        in_data = to_units(units, self._are_in_data or self._on_globe)
        if self._on_globe and not in_data:
            raise BadArgument(f'by great circles {what} are in kilometres: units="pixels" is for planes')
        return in_data and not self._on_globe

    @with_parameters
    def distances(
        self, out: Optional[NDArray[np.float32]] = None, *, units: Optional[Units] = None
    ) -> NDArray[np.float32]:
        """Return each pixel's distance to the seed of its label: see `vorocl.distances`.

        Parameters
        ----------
        out : ndarray, optional
            Where they go: float32 of the diagram's shape, C-contiguous. Without it, a new array.
        <units>
        """
        length = self._length() if self._in_data_of_plane(units, "distances") else 1
        values = output(out, self._shape, np.float32)
        self._diagram.distances(values)
        if length != 1:
            values *= np.float32(length)
        return values

    @with_parameters
    def cells(self, *, units: Optional[Units] = None) -> NDArray[Any]:
        """Measure the cell of every point.

        Parameters
        ----------
        <units>

        Returns
        -------
        ndarray
            A structured array with one row per point; ``pandas.DataFrame(...)`` makes a table of it. Its dtype in pixels has
            the fields of ``vorocl.CELL``, whole numbers of pixels. Along a periodic axis, pixels count where they lie the shorter
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

            By great circles there are ``x``, ``y``, ``area``, ``centroid_x``, ``centroid_y``, ``largest_distance``,
            ``pixels``, ``neighbours`` and ``touches_border``, in degrees, kilometres and square kilometres.

            In a volume there are ``z``, ``centroid_z``, ``front`` and ``back`` (the first and last
            slices) too. Its area is the volume of a cell, and its perimeter the voxel faces that it shares with others.

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
        >>> vorocl.cells([(0, 0, 0), (5, 0, 0)], (2, 3, 6), method="jfa")[["area", "centroid_z", "perimeter"]].tolist()
        [(18, 1.0, 6), (18, 1.0, 6)]
        """
        in_data = self._in_data_of_plane(units, "cells")
        if self._on_globe:
            return self._diagram.globe_cells().view(GLOBE_CELL)[:, 0]
        cells = self._diagram.cells().view(CELL)[:, 0]
        return self._in_data(cells) if in_data else cells[self._fields()]

    def _fields(self) -> List[str]:
        """Those of CELL that its cells have."""
        of_volumes = () if len(self._shape) == 3 else ("z", "centroid_z", "front", "back")
        return [name for name in CELL.names or () if name not in of_volumes]

    def _in_data(self, cells: NDArray[Any]) -> NDArray[Any]:
        """Rows of cells in pixels, in the units of the points."""
        area, length, side = self._scale()
        units = {"area": area, "perimeter": (side or 1) ** (len(self._shape) - 1), "largest_distance": length or 1}
        in_pixels = {"perimeter": side is None, "largest_distance": length is None}
        kept = ("neighbours", "touches_border")

        def name_of(field: str) -> str:
            return field + "_px" if in_pixels.get(field) else field

        types = [(name_of(field), CELL[field] if field in kept else np.float64) for field in self._fields()]
        result = np.empty(len(cells), np.dtype(types, align=True))
        for name in kept:
            result[name] = cells[name]
        for name, unit in units.items():
            result[name_of(name)] = cells[name] * unit
        is_empty = cells["area"] == 0
        ends = ("left", "top", "front"), ("right", "bottom", "back")
        for fields in ("x", "y", "z"), ("centroid_x", "centroid_y", "centroid_z"), *ends:
            places = np.column_stack([cells[field] for field in fields]).astype(np.float64) + (fields == ends[1])
            if fields in ends:
                places[is_empty] = np.nan
            self._diagram.to_data(places)
            for field, along in zip(fields, places.T):
                if field in (result.dtype.names or ()):
                    result[field] = along
        return result

    @with_parameters
    def areas(self, *, units: Optional[Units] = None) -> NDArray[Any]:
        """Measure the areas of the cells and nothing else, which takes a part of the time that `cells` takes.

        Parameters
        ----------
        <units>

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
        in_data = self._in_data_of_plane(units, "areas")
        if self._on_globe:
            return np.ascontiguousarray(self.cells()["area"])
        pixels = self._diagram.areas()[:, 0]
        return pixels * self._scale()[0] if in_data else pixels

    @with_parameters
    def adjacency(self, *, units: Optional[Units] = None) -> Tuple[NDArray[np.uint32], NDArray[Any]]:
        """Find the cells that touch, and how long their borders are.

        In an exact Euclidean diagram these are the edges of the Delaunay triangulation, but for cells that touch along
        less than a few pixels.

        Parameters
        ----------
        <units>

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
        length = self._length(of_sides=True) if to_units(units, self._are_in_data) else None
        rows = self._diagram.adjacency()
        return rows[:, :2], rows[:, 2] if length is None else rows[:, 2] * length ** (len(self._shape) - 1)

    @with_parameters
    def vertices(self, *, units: Optional[Units] = None) -> NDArray[np.float64]:
        """Find the vertices: the pixel corners where three or more cells meet.

        Parameters
        ----------
        <units>

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
        in_data = to_units(units, self._are_in_data)
        corners = self._diagram.vertices()
        if in_data:
            self._diagram.to_data(corners)
        return np.ascontiguousarray(corners[:, :2])

    def count_vertices(self) -> int:
        """Count the pixel corners where three or more cells meet, on the device."""
        return self._diagram.count_vertices()

    def errors(self, truth: Optional[Truth] = None) -> DistanceErrors:
        """Judge the labels by an exact diagram: see `vorocl.errors`.

        Parameters
        ----------
        truth : {"snapped", "true"}, optional
            Without it, what an exact diagram was made of; "snapped" for all other labels.
        """
        if self._on_globe:
            raise BadArgument(
                "errors are counted in pixels, and great circles have none: vorocl.similarity() compares labels with those of "
                'vorocl.diagram(points, grid, metric="great-circle")'
            )
        if self._of_weights:
            raise BadArgument(
                "errors are of distances, and a power diagram goes by weights too: vorocl.similarity() compares labels with "
                "those of vorocl.diagram(points, grid, weights=weights)"
            )
        return DistanceErrors(*self._diagram.errors(None if truth is None else to_truth(truth)))


def _points_there(points: Any, dimensions: int) -> Optional[Tuple[int, int, int, bool]]:
    """What a pyopencl.array.Array of points holds; None for everything else."""
    module = sys.modules.get("pyopencl.array")
    if module is None or not isinstance(points, module.Array):
        return None
    doubles = points.dtype == np.float64
    is_right = points.ndim == 2 and points.shape[1] == dimensions and points.size > 0
    is_plain = points.flags.c_contiguous and points.offset == 0
    if not is_right or not is_plain or not (doubles or points.dtype == np.float32):
        raise BadArgument(
            f"points on the device must be N rows of {dimensions} float32 or float64, whole and contiguous; this array has "
            f"the shape {points.shape} and the dtype {points.dtype}"
        )
    return points.base_data.int_ptr, points.shape[0], dimensions, bool(doubles)


def _handle(buffer: Buffer) -> int:
    if not is_of_pyopencl(buffer, "MemoryObjectHolder"):
        raise BadArgument(f"labels must be a pyopencl.Buffer; this is of type {type(buffer).__name__}")
    return int(buffer.int_ptr)


@with_parameters
class Simulation(OnDevice):
    """Seeds that move, and their diagram frame by frame. Nothing is allocated on the device after the first frame.

    Points that have weights get them with each frame: see `step`.

    Parameters
    ----------
    <grid>
    method : str, optional
        As that of `Diagram.fill`. "djfa" goes on from the last frame; "exact" is faster, and right.
    <metric, outside, snap, device>

    Attributes
    ----------
    seeds : Seeds
        In their present frame; none before the first.
    diagram : Diagram
        Of the present frame.
    report : Report
        Of the present frame; none before the first.

    Examples
    --------
    >>> import numpy as np, vorocl
    >>> points = np.random.default_rng(1).uniform(10, 54, (100, 2))
    >>> simulation = vorocl.Simulation((64, 64))
    >>> labels = np.empty((64, 64), np.uint32)
    >>> for frame in range(3):
    ...     _ = simulation.step(points + frame).read(out=labels)
    >>> int(simulation.diagram.cells()["area"].sum())
    4096
    """

    def __init__(
        self,
        grid: Union[Grid, Shape],
        *,
        method: Method = "exact",
        metric: Metric = "euclidean",
        outside: Outside = "count",
        snap: Optional[bool] = None,
        device: Optional[Device] = None,
        **frame: Unpack[Frame],
    ) -> None:
        self._method, self._metric = to_one_of(Method, method, "method"), to_one_of(Metric, metric, "metric")
        made = to_grid(grid, frame)
        if metric == "great-circle":
            made = to_globe(made, outside)
        self.diagram = Diagram(made, device=device)
        self.seeds = Seeds(
            (), made, outside=outside, snap=to_snap(snap, self._method), device=self.diagram.device
        )
        self.report: Optional[_vorocl.Report] = None

    def __repr__(self) -> str:
        return f"<vorocl.Simulation of {len(self.seeds)} points, method {self._method}, of the shape {self.diagram.shape}>"

    def step(
        self,
        points: ArrayLike,
        *,
        bounds: Optional[Bounds] = None,
        tilt: Optional[Tilt] = None,
        weights: Optional[ArrayLike] = None,
    ) -> Diagram:
        """Move the seeds to the points of the next frame, and fill the diagram. Enqueues the work and returns.

        Parameters
        ----------
        points : array_like
            As that of `Seeds`. Seeds may appear and vanish.
        bounds : sequence of float, optional
            What the grid shows from this frame on, such as a box that changes. Without it, what it showed.
        tilt : float or (float, float, float), optional
            The tilt from this frame on, such as that of a box that is sheared. Without it, what it was.
        weights : array_like, optional
            Those of these points: see `Seeds`. Frames with weights follow each other.

        Returns
        -------
        Diagram
            That of the simulation, to be read or measured.

        Raises
        ------
        BadPoint
            The frame counts as not made then.
        BadArgument, DeviceMemoryError, DeviceError
        """
        self.seeds.move_to(points, bounds=bounds, tilt=tilt, weights=weights)
        self.report = self.diagram.fill(self.seeds, self._method, self._metric)
        return self.diagram
