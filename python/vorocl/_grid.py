"""The grid of a diagram: its pixels, and what of the points' space they show."""

from __future__ import annotations

import functools
import operator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Callable, Optional, Sequence, Tuple, Type, TypedDict, Union

from . import _vorocl
from ._arguments import Outside, shown, to_bool, to_flag, to_outside
from ._errors import BadArgument
from ._parameters import with_parameters

if TYPE_CHECKING:
    from typing_extensions import Unpack as Unpack
else:  # at run time the type of the keywords alone
    Unpack = Type

Shape = Union[Tuple[int, int], Tuple[int, int, int]]
Bounds = Union[Tuple[float, float, float, float], Tuple[float, float, float, float, float, float]]
Periodic = Sequence[bool]
Tilt = Union[float, Tuple[float, float, float]]


@with_parameters
@dataclass(frozen=True)
class Grid:
    """The pixels of a diagram, or the voxels of a volume, and what of the points' space they show.

    Functions take one, or its shape alone with the other arguments by their names: ``areas(points, (4, 8), y_up=True)``
    is ``areas(points, Grid((4, 8), y_up=True))``. Grids are equal if all that they say is; ``dataclasses.replace()`` makes
    others of them.

    Parameters
    ----------
    <shape, bounds, periodic, tilt, y_up, spacing>

    Raises
    ------
    BadArgument
        If there is no such grid. What makes diagrams has further limits, which its errors name.

    Examples
    --------
    >>> import vorocl
    >>> plane = vorocl.Grid((1, 8), bounds=(-180, -90, 180, 90), periodic=(True, False))
    >>> vorocl.diagram([(-157.5, 0), (22.5, 0)], plane)
    array([[0, 0, 0, 1, 1, 1, 0, 0]], dtype=uint32)
    >>> vorocl.areas([(-157.5, 0), (22.5, 0)], plane, units="pixels")
    array([5, 3], dtype=uint32)
    >>> vorocl.distances([(0.5, 0.5, 0.5)], vorocl.Grid((3, 1, 2), spacing=(1, 1, 4)))[:, 0, 0].tolist()
    [0.0, 4.0, 8.0]
    """

    shape: Shape
    bounds: Optional[Bounds] = None
    periodic: Periodic = (False, False)
    tilt: Tilt = 0.0
    y_up: bool = False
    spacing: Optional[Sequence[int]] = None

    def __post_init__(self) -> None:
        shape = _to_shape(self.shape)
        checked = {
            "shape": shape,
            "bounds": _to_bounds(self.bounds, len(shape)),
            "periodic": to_periodic(self.periodic, len(shape)),
            "tilt": _to_tilt(self.tilt, len(shape)),
            "y_up": to_flag(self.y_up, "y_up"),
            "spacing": _to_spacing(self.spacing, len(shape)),
        }
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        self._of("count")  # the library refuses what is not possible

    def _of(self, outside: Outside) -> _vorocl.Grid:
        """For points of which those outside are dealt with so.

        Points at the bounds' far ends are inside, unless what is outside them counts all round: not in volumes and spaced
        planes, which refuse it.
        """
        is_plane = len(self.shape) == 2 and self.spacing is None
        counts = to_outside(outside) == "count" and not any(self.periodic) and is_plane
        return _made(self, self.bounds is not None and not counts)

    @property
    def _units(self) -> Tuple[int, ...]:
        """As how many units distances count a pixel, along each axis."""
        return tuple(self.spacing or (1,) * len(self.shape))

    def _showing(self, bounds: Optional[Bounds], tilt: Optional[Tilt]) -> Grid:
        """With other bounds or another tilt, where there are any."""
        return replace(
            self, bounds=self.bounds if bounds is None else bounds, tilt=self.tilt if tilt is None else tilt
        )


class Frame(TypedDict, total=False):
    """What a grid has besides its shape: the keywords of functions that take a shape."""

    bounds: Optional[Bounds]
    periodic: Periodic
    tilt: Tilt
    y_up: bool
    spacing: Optional[Sequence[int]]


def to_grid(grid: Union[Grid, Shape], frame: Frame) -> Grid:
    """A grid, or that of a shape and of what keywords say besides."""
    unknown = [name for name in frame if name not in Frame.__annotations__]
    if unknown:
        raise TypeError(f"got an unexpected keyword argument '{unknown[0]}'")
    if not isinstance(grid, Grid):
        return Grid(grid, **frame)
    if frame:
        raise BadArgument(f"{' and '.join(frame)} must be said in the vorocl.Grid, not beside it")
    return grid


def to_globe(grid: Grid, outside: Outside) -> Grid:
    """The grid as one of longitudes and latitudes: all of the globe without bounds, and round where it has all longitudes."""
    if len(grid.shape) != 2 or grid.spacing or grid.tilt or any(grid.periodic):
        raise BadArgument(
            'metric="great-circle" takes a plane of longitudes, which are periodic by themselves, and latitudes: no periodic, '
            "tilt or spacing, and no volume"
        )
    if to_outside(outside) != "count":
        raise BadArgument(f'metric="great-circle" counts all points: no outside={shown(outside)}')
    bounds: Any = grid.bounds or (-180.0, -90.0, 180.0, 90.0)
    return replace(grid, bounds=bounds, periodic=(bounds[2] - bounds[0] == 360, False))


@functools.lru_cache(maxsize=64)
def _made(grid: Grid, closed: bool) -> _vorocl.Grid:
    depth, height, width = [1, *grid.shape][-3:]
    x, y, z = [*grid.periodic, False][:3]
    units = [*grid._units, 1][:3]
    tilts = grid.tilt if isinstance(grid.tilt, tuple) else (grid.tilt, 0.0, 0.0)
    return _vorocl.Grid(width, height, depth, x, y, z, units, tilts, grid.bounds, grid.y_up, closed)


def _converted(values: Any, convert: Callable[[Any], Any]) -> Tuple[Any, ...]:
    """Each of some values, converted; none if it is not possible."""
    try:
        return tuple(convert(value) for value in values)
    except (TypeError, ValueError, OverflowError):
        return ()


def _to_shape(shape: Shape) -> Shape:
    far = 2**31  # past every limit, of which the library tells
    sides: Any = _converted(shape, lambda side: max(-far, min(operator.index(side), far)))
    if len(sides) not in (2, 3):
        raise BadArgument(
            f"a grid must be a vorocl.Grid or a shape: two whole numbers (H, W), or three (D, H, W); this is {shown(shape)}"
        )
    if len(sides) == 3 and sides[0] == 1:
        raise BadArgument(f"a volume of one slice is a plane: give the shape {sides[1:]}, and points (x, y)")
    checked: Shape = sides
    return checked


def to_periodic(periodic: Periodic, dimensions: int) -> Tuple[bool, ...]:
    axes = _converted(periodic, to_bool)
    if len(axes) == 2 and not any(axes):  # the default
        axes = (False,) * dimensions
    if len(axes) != dimensions:
        wanted = {2: "two booleans (x, y)", 3: "three booleans (x, y, z) for a volume"}
        raise BadArgument(f"periodic must be {wanted[dimensions]}; this is {shown(periodic)}")
    return axes


def _to_tilt(tilt: Tilt, dimensions: int) -> Tilt:
    tilts = _converted(tilt, float) if dimensions == 3 else ()
    if len(tilts) == 3:
        return (tilts[0], tilts[1], tilts[2]) if any(tilts[1:]) else tilts[0]
    try:
        return float(tilt)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        wanted = {2: "a number", 3: "a number, or three (xy, xz, yz)"}
        raise BadArgument(f"tilt must be {wanted[dimensions]}; this is {shown(tilt)}") from None


def _to_spacing(spacing: Optional[Sequence[int]], dimensions: int) -> Optional[Tuple[int, ...]]:
    if spacing is None:
        return None
    units = _converted(spacing, operator.index)
    if len(units) != dimensions or not all(1 <= unit <= 64 for unit in units):
        raise BadArgument(f"spacing must be {dimensions} whole numbers from 1 to 64; this is {shown(spacing)}")
    return units if max(units) > 1 else None


def _to_bounds(bounds: Optional[Bounds], dimensions: int) -> Optional[Bounds]:
    if bounds is None:
        return None
    corners: Any = _converted(bounds, float)
    if len(corners) != 2 * dimensions:
        numbers = {2: "four numbers (x0, y0, x1, y1)", 3: "six numbers (x0, y0, z0, x1, y1, z1) for a volume"}
        raise BadArgument(f"bounds must be {numbers[dimensions]}; this is {shown(bounds)}")
    if any(low == high for low, high in zip(corners, corners[dimensions:])):
        raise BadArgument(f"bounds must have an extent along all axes; these are {shown(bounds)}")
    if dimensions == 2 and -180 <= corners[2] < corners[0] <= 180:
        across = (*corners[:2], corners[2] + 360, corners[3])
        raise BadArgument(
            f"bounds must begin before they end; these are {shown(bounds)}. Across the date line longitudes go on, as {across}"
        )
    checked: Bounds = corners
    return checked
