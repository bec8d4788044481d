"""Seeds and diagrams that stay on the device, and simulations of moving seeds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Tuple, cast

import numpy as np

from . import _vorocl
from ._arguments import (
    Bounds,
    Periodic,
    Shape,
    output,
    shape_of,
    to_bounds,
    to_flag,
    to_grid,
    to_labels,
    to_number,
    to_outside,
    to_points,
    to_text,
)
from ._device import Device, is_of_pyopencl, to_device
from ._errors import BadArgument

if TYPE_CHECKING:
    import pyopencl
    from numpy.typing import ArrayLike, NDArray

CELL = np.dtype(
    [
        ("x", np.float64),
        ("y", np.float64),
        ("centroid_x", np.float64),
        ("centroid_y", np.float64),
        ("largest_distance", np.float64),
        ("area", np.uint32),
        ("perimeter", np.uint32),
        ("neighbours", np.uint32),
        ("left", np.int32),
        ("top", np.int32),
        ("right", np.int32),
        ("bottom", np.int32),
        ("touches_border", np.bool_),
    ],
    align=True,
)


def to_seeds(seeds: Seeds) -> _vorocl.Seeds:
    if not isinstance(seeds, Seeds):
        raise BadArgument(f"seeds must be vorocl.Seeds; these are of type {type(seeds).__name__}")
    return seeds._seeds


class Seeds:
    """Points as seeds of a diagram, on the device: each is snapped to the pixel that holds it.

    A seed's id is its row. A seed may be absent: it has an id and no cell. Of seeds that share a pixel the lowest id
    owns the cell, and the others have empty cells.

    Parameters
    ----------
    points : array_like
        Shape (N, 2), rows (x, y): in pixels, x to the right, y down, or in the units of `bounds`. Pixel i covers
        [i, i + 1). A row with a NaN is absent, and so is a row that is masked.
    shape : (int, int)
        The grid, (H, W) in pixels: sides from 1 to 32,768, along a periodic axis to 32,000, and at most 2**30 pixels.
    bounds : (float, float, float, float), optional
        (x0, y0, x1, y1), the rectangle of the points' plane that the grid shows: a point is in the column
        floor((x - x0) * W / (x1 - x0)); rows likewise.
        Without it, points are in pixels.
    periodic : (bool, bool), optional
        Which axes, x and y, are periodic: distances go the shorter way round, and points outside wrap.
    outside : {"count", "refuse"}, optional
        What is done about points outside the grid or the bounds. "count": the grid is a window of a larger plane, and
        they are seeds too, up to 2**31 pixels away; a method that floods refuses them, and so does a periodic grid, of
        points that are outside along its other axis. "refuse": they are an error; a point at x1 or y1 is in the last
        pixel then, as along the other axis of a periodic grid.
    y_up : bool, optional
        Whether y of the points goes up: rows are counted from the bottom then.
    device : Device, optional
        Without it, ``Device()``.

    Raises
    ------
    BadPoint
        If a point is infinite, 2**31 pixels away, or outside where such points are refused.
    BadArgument, DeviceError

    Examples
    --------
    >>> import numpy as np, vorocl
    >>> seeds = vorocl.Seeds([(0.2, 0.9), (np.nan, 1), (7, 3)], (4, 8))
    >>> len(seeds), seeds.alive
    (3, 2)
    >>> seeds.read()
    array([[0.5, 0.5],
           [nan, nan],
           [7.5, 3.5]])
    """

    def __init__(
        self,
        points: ArrayLike,
        shape: Shape,
        *,
        bounds: Optional[Bounds] = None,
        periodic: Periodic = (False, False),
        outside: str = "count",
        y_up: bool = False,
        device: Optional[Device] = None,
    ) -> None:
        grid = to_grid(shape, periodic)
        counts = to_outside(outside) == "count"
        corners, upwards, array = to_bounds(bounds), to_flag(y_up, "y_up"), to_points(points)
        self._device = to_device(device)
        self._seeds = _vorocl.Seeds(self._device._device, grid, corners, upwards, counts)
        self._seeds.move_to(array)

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

    def move_to(self, points: ArrayLike) -> int:
        """Move the seeds to new points: a new frame. Their number may change.

        Parameters
        ----------
        points : array_like
            As that of the constructor, in the same units. A seed that is absent may come back.

        Returns
        -------
        int
            The greatest displacement of a seed along an axis since the last frame, in pixels; along a periodic axis the
            shorter way round. Seeds that appear or vanish, or are outside, do not count.

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
        self._seeds.move_to(to_points(points))
        return self._seeds.displacement

    def read(self) -> NDArray[np.float64]:
        """Return the centres of the seeds' pixels.

        Returns
        -------
        ndarray
            Shape (N, 2), rows (x, y) in pixels, y down; NaN for a seed that is absent.
        """
        points = np.empty((len(self), 2))
        self._seeds.read(points)
        return points


class Diagram:
    """A Voronoi diagram: an image of labels, kept on the device.

    It keeps its working memory, so that filling it again allocates nothing. Threads that share a diagram take turns.

    Parameters
    ----------
    shape : (int, int)
        As that of the seeds that it will be filled from, and so are `periodic` and `device`.
    periodic : (bool, bool), optional
    device : Device, optional
    labels : pyopencl.Buffer, optional
        Where the labels are to be: at least 4 * H * W bytes of the device's context, which kernels can read and write.

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
    >>> seeds = vorocl.Seeds([(0, 0), (7, 3)], (4, 8))
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
        shape: Shape,
        *,
        periodic: Periodic = (False, False),
        device: Optional[Device] = None,
        labels: Optional[pyopencl.Buffer] = None,
    ) -> None:
        grid = to_grid(shape, periodic)
        self._shape = shape_of(grid)
        self._device = to_device(device)
        if labels is None:
            self._diagram = _vorocl.Diagram(self._device._device, grid)
        else:
            self._diagram = _vorocl.Diagram.over_buffer(self._device._device, grid, _handle(labels))

    @property
    def device(self) -> Device:
        """Where it is."""
        return self._device

    @property
    def shape(self) -> Tuple[int, int]:
        """(H, W) in pixels."""
        return self._shape

    def __repr__(self) -> str:
        return f"<vorocl.Diagram of the shape {self.shape}>"

    def fill(
        self,
        seeds: Seeds,
        method: str = "exact",
        metric: str = "euclidean",
        max_displacement: Optional[float] = None,
    ) -> _vorocl.Report:
        """Give every pixel the id of its nearest seed. Enqueues the work and returns.

        Parameters
        ----------
        seeds : Seeds
            Of the diagram's shape, periodic axes and device.
        method : str, optional
            "exact", or one that floods and is approximate: "standard-flooding", "jfa", "jfa+1",
            "jfa+2", "1+jfa", "djfa". "djfa" goes on from the labels that the diagram holds.
        metric : {"euclidean", "manhattan"}, optional
        max_displacement : float, optional
            For "djfa" alone: how far a seed has moved along an axis, at most, since the diagram was last filled, in
            pixels. Without it, seeds may have moved anywhere.

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
        return self._diagram.fill(
            to_seeds(seeds), to_text(method, "method"), to_text(metric, "metric"), displacement
        )

    def read(self, out: Optional[NDArray[np.uint32]] = None) -> NDArray[np.uint32]:
        """Wait for the diagram and copy its labels.

        Parameters
        ----------
        out : ndarray, optional
            Where they go: uint32 of the diagram's shape, C-contiguous. Without it, a new array.

        Returns
        -------
        ndarray
            uint32, shape (H, W): the row of the nearest seed, or ``vorocl.NO_LABEL`` if there are no seeds.
        """
        labels = output(out, self._shape, np.uint32)
        self._diagram.read(labels)
        return labels

    def write(self, labels: ArrayLike) -> None:
        """Write labels of the caller's, such as those that another program computed.

        Parameters
        ----------
        labels : array_like
            Integers of the diagram's shape. Those that are no seed's id count as none.
        """
        self._diagram.write(to_labels(labels))

    @property
    def buffer(self) -> pyopencl.Buffer:
        """The labels as a buffer of pyopencl's, without a copy: H * W uint32, row by row.

        They are valid for commands that are enqueued to the device's queue after `fill`.
        """
        import pyopencl

        return cast("pyopencl.Buffer", pyopencl.Buffer.from_int_ptr(self._diagram.buffer, retain=True))

    def distances(
        self, seeds: Seeds, metric: str = "euclidean", out: Optional[NDArray[np.float32]] = None
    ) -> NDArray[np.float32]:
        """Return each pixel's distance to the seed of its label: see `vorocl.distances`."""
        values = output(out, self._shape, np.float32)
        self._diagram.distances(to_seeds(seeds), to_text(metric, "metric"), values)
        return values

    def cells(self, seeds: Seeds, metric: str = "euclidean") -> NDArray[Any]:
        """Measure every cell: see `vorocl.cells`."""
        rows = self._diagram.cells(to_seeds(seeds), to_text(metric, "metric"))
        return rows.view(CELL).reshape(len(rows))

    def adjacency(self, seeds: Seeds) -> Tuple[NDArray[np.uint32], NDArray[np.uint32]]:
        """Find the cells that touch: see `vorocl.adjacency`."""
        rows = self._diagram.adjacency(to_seeds(seeds))
        return rows[:, :2], rows[:, 2]

    def count_vertices(self) -> int:
        """Count the pixel corners where three or more cells meet: see `vorocl.vertices`."""
        return self._diagram.count_vertices()

    def errors(self, seeds: Seeds, metric: str = "euclidean") -> _vorocl.DistanceErrors:
        """Judge the labels by the exact diagram: see `vorocl.errors`."""
        return self._diagram.errors(to_seeds(seeds), to_text(metric, "metric"))


def _handle(buffer: pyopencl.Buffer) -> int:
    if not is_of_pyopencl(buffer, "MemoryObjectHolder"):
        raise BadArgument(f"labels must be a pyopencl.Buffer; this is of type {type(buffer).__name__}")
    return int(buffer.int_ptr)


class Simulation:
    """Seeds that move, and their diagram frame by frame. Nothing is allocated on the device after the first frame.

    Parameters
    ----------
    shape, bounds, periodic, outside, y_up, device
        As those of `Seeds`.
    method, metric : str, optional
        As those of `Diagram.fill`. "djfa" goes on from the last frame, and is told how far seeds have moved.

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
    >>> simulation = vorocl.Simulation((64, 64), method="exact")
    >>> labels = np.empty((64, 64), np.uint32)
    >>> for frame in range(3):
    ...     _ = simulation.step(points + frame).read(out=labels)
    >>> int(simulation.diagram.cells(simulation.seeds)["area"].sum())
    4096
    """

    def __init__(
        self,
        shape: Shape,
        *,
        method: str = "djfa",
        metric: str = "euclidean",
        bounds: Optional[Bounds] = None,
        periodic: Periodic = (False, False),
        outside: str = "count",
        y_up: bool = False,
        device: Optional[Device] = None,
    ) -> None:
        self._method, self._metric = to_text(method, "method"), to_text(metric, "metric")
        self.diagram = Diagram(shape, periodic=periodic, device=device)
        self.seeds = Seeds(
            (), shape, bounds=bounds, periodic=periodic, outside=outside, y_up=y_up, device=self.diagram.device
        )
        self.report: Optional[_vorocl.Report] = None
        self._displacement = 0  # since the diagram was last filled

    def step(self, points: ArrayLike) -> Diagram:
        """Move the seeds to the points of the next frame, and fill the diagram. Enqueues the work and returns.

        Parameters
        ----------
        points : array_like
            As that of `Seeds`. Seeds may appear and vanish.

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
        self._displacement += self.seeds.move_to(points)
        self.report = self.diagram.fill(self.seeds, self._method, self._metric, self._displacement)
        self._displacement = 0
        return self.diagram
