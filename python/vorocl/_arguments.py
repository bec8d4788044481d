"""Arguments as users give them, converted or refused in one sentence."""

from __future__ import annotations

import math
import operator
import reprlib
from typing import Any, Dict, List, Literal, Optional, Sequence, Tuple, TypeVar, Union, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _vorocl
from ._errors import BadArgument

Method = Literal["standard-flooding", "jfa", "jfa+1", "jfa+2", "1+jfa", "djfa", "low-resolution", "exact"]
Metric = Literal["euclidean", "manhattan", "great-circle"]
Outside = Literal["count", "absent", "refuse"]
Units = Literal["data", "pixels"]
Truth = Literal["snapped", "true"]
Text = TypeVar("Text", bound=str)

Sampling = Union[None, float, Sequence[float]]

MOST_SEEDS = 2**30  # the library's limit, known here before anything is converted


def shown(value: object) -> str:
    """A value in an error, on one line and short."""
    return " ".join(reprlib.repr(value).split())


def to_points(points: ArrayLike, dimensions: int = 2) -> NDArray[np.float64]:
    """(N, 2) or (N, 3) numbers, aligned, with strides of whole numbers; the masked rows of a masked array as NaN."""
    row = "(x, y, z)" if dimensions == 3 else "(x, y)"
    if isinstance(points, np.ma.MaskedArray):
        points = np.ma.filled(points.astype(np.float64), np.nan)
    try:
        array = np.asarray(points)
    except ValueError as error:
        raise BadArgument(f"points must be an array of N rows {row}: {error}") from None
    if array.shape == (0,):
        array = array.reshape(0, dimensions)
    if array.ndim != 2 or array.shape[1] != dimensions:
        raise BadArgument(
            f"points must have the shape (N, {dimensions}), rows {row}; this array has the shape {array.shape}"
        )
    if array.dtype.kind not in "biuf":
        raise BadArgument(f"points must be real numbers; this array has the dtype {array.dtype}")
    if len(array) > MOST_SEEDS:
        raise BadArgument(f"there are {len(array)} points; at most 2^30 are possible")
    if array.dtype == np.float64 and array.flags.aligned and all(step % 8 == 0 for step in array.strides):
        return array  # without a copy
    return np.ascontiguousarray(array, dtype=np.float64)


def to_bool(value: object) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError
    return bool(value)


def to_flag(value: bool, name: str) -> bool:
    """A boolean, and nothing that only counts as one."""
    try:
        return to_bool(value)
    except TypeError:
        raise BadArgument(f"{name} must be True or False; this is {shown(value)}") from None


def to_one_of(names: Any, value: Text, what: str) -> Text:
    """One of the names of a Literal."""
    possible = get_args(names)
    if not isinstance(value, str) or value not in possible:
        *others, last = (f'"{name}"' for name in possible)
        raise BadArgument(f"{what} must be {', '.join(others)} or {last}; this is {shown(value)}")
    return value


def to_weights(weights: Optional[ArrayLike], count: int) -> Optional[NDArray[np.float64]]:
    """One finite number per point."""
    if weights is None:
        return None
    try:
        given = np.asanyarray(weights)
        array = np.ascontiguousarray(given, dtype=np.float64) if np.isrealobj(given) else None
    except (TypeError, ValueError):
        array = None
    if array is None:
        raise BadArgument(f"weights must be an array of numbers; this is {shown(weights)}")
    if np.ma.is_masked(given):
        raise BadArgument("weights must not be masked; mask the points that are not there")
    if array.shape != (count,):
        raise BadArgument(f"weights must have the shape ({count},), one per point; this array has the shape {array.shape}")
    return array


def to_outside(outside: Outside) -> Outside:
    """What is done about points outside."""
    return to_one_of(Outside, outside, "outside")


_FLOODING = {name for name, exact, _ in _vorocl.methods() if not exact}


def to_snap(snap: Optional[bool], method: str = "exact") -> bool:
    """Whether points are moved to the centres of their pixels, which methods that flood always do."""
    floods = to_text(method, "method") in _FLOODING
    if snap is None:
        return floods
    if not to_flag(snap, "snap") and floods:
        raise BadArgument(f'the method "{method}" moves points to the centres of their pixels: snap=False is for "exact"')
    return snap


def to_truth(truth: Truth) -> bool:
    """Whether labels are judged by the points themselves."""
    return to_one_of(Truth, truth, "truth") == "true"


def to_units(units: Optional[Units], are_in_data: bool) -> bool:
    """Whether results are in the units of the data, which are not pixels if `are_in_data`."""
    return are_in_data if units is None else to_one_of(Units, units, "units") == "data"


def to_number(value: float, name: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise BadArgument(f"{name} must be a number; this is {shown(value)}") from None


def to_sampling(sampling: Sampling, axes: int, name: str) -> List[float]:
    """The sizes of a pixel along the axes."""
    if sampling is None:
        return [1.0] * axes
    try:
        sizes = [float(size) for size in np.broadcast_to(np.asarray(sampling, np.float64), (axes,))]
    except (TypeError, ValueError):
        raise BadArgument(f"{name} must be a number, or {axes} of them; this is {shown(sampling)}") from None
    if not all(math.isfinite(size) and size > 0 for size in sizes):
        raise BadArgument(f"{name} must be above 0 and finite; this is {shown(sampling)}")
    return sizes


def to_count(value: int, name: str) -> int:
    """A whole number that C holds."""
    try:
        count = operator.index(value)
    except TypeError:
        raise BadArgument(f"{name} must be a whole number; this is {shown(value)}") from None
    if not 0 <= count < 2**31:
        raise BadArgument(f"{name} must be from 0 to 2^31 - 1; this is {count}")
    return count


def to_text(value: Text, name: str) -> Text:
    if not isinstance(value, str) or not value.isascii():
        raise BadArgument(f"{name} must be a string of ASCII; this is {shown(value)}")
    return value


def to_image(image: ArrayLike, name: str, shape: Optional[Tuple[int, ...]] = None) -> NDArray[Any]:
    """An array with two axes, or with three, none of them empty; of the shape of a diagram, if there is one."""
    shapes = "(H, W) or (D, H, W)"
    try:
        array = np.asarray(image)
    except ValueError as error:
        raise BadArgument(f"{name} must be an array of the shape {shapes}: {error}") from None
    if array.ndim not in (2, 3) or array.size == 0:
        raise BadArgument(f"{name} must have the shape {shapes}; this array has the shape {array.shape}")
    if shape is not None and array.shape != shape:
        raise BadArgument(f"{name} must have the shape of the diagram, {shape}; this array has {array.shape}")
    return array


def unmasked(image: ArrayLike) -> ArrayLike:
    """The masked pixels of a masked array, which are no data, as zeros."""
    return image.filled(0) if isinstance(image, np.ma.MaskedArray) else image


def to_mask(image: ArrayLike, name: str) -> NDArray[Any]:
    """An array with one to three axes, as functions of SciPy's and scikit-image's take it: it may be empty."""
    try:
        array = np.atleast_1d(np.asarray(image))
    except ValueError as error:
        raise BadArgument(f"{name} must be an array: {error}") from None
    if array.ndim > 3:
        raise BadArgument(f"{name} must have one to three axes; this array has the shape {array.shape}")
    return array


def to_pixels(image: NDArray[Any], name: str) -> NDArray[Any]:
    """Numbers or booleans as the library reads them: C-contiguous, aligned and in this machine's byte order."""
    if image.dtype.kind not in "biuf":
        raise BadArgument(f"{name} must be numbers or booleans; this array has the dtype {image.dtype}")
    dtype = image.dtype.newbyteorder("=")
    if dtype.kind == "f" and dtype.itemsize not in (4, 8):
        dtype = np.dtype(np.float32 if dtype.itemsize < 4 else np.float64)
    return np.require(image, dtype, ["C", "A"])


def to_marked(pixels: NDArray[Any]) -> NDArray[np.bool_]:
    """Which pixels of a mask are marked: those that are not zero, and not NaN."""
    marked: NDArray[np.bool_] = (pixels != 0) & (pixels == pixels)
    return marked


def to_labels(labels: ArrayLike, name: str = "labels", shape: Optional[Tuple[int, ...]] = None) -> NDArray[np.uint32]:
    """(H, W) or (D, H, W) labels, C-contiguous, of any integers that uint32 holds."""
    array = to_image(labels, name, shape)
    if np.ma.is_masked(labels):
        raise BadArgument(f"{name} must not be masked; fill what is masked, such as with vorocl.NO_LABEL")
    if array.dtype.kind not in "iu":
        raise BadArgument(f"{name} must be integers; this array has the dtype {array.dtype}")
    if array.dtype != np.uint32 and (array.min() < 0 or array.max() > 0xFFFFFFFF):
        raise BadArgument(f"{name} must be from 0 to 2^32 - 1, as uint32")
    return np.ascontiguousarray(array, dtype=np.uint32)


def to_density(density: ArrayLike, shape: Tuple[int, ...]) -> NDArray[np.float32]:
    """Weights of pixels, C-contiguous; what they must be, the library says."""
    array = to_image(unmasked(density), "density", shape)
    if array.dtype.kind not in "biuf":
        raise BadArgument(f"density must be real numbers; this array has the dtype {array.dtype}")
    with np.errstate(over="ignore"):  # they become infinite
        return np.ascontiguousarray(array, dtype=np.float32)


def row_of(fields: Dict[Any, str]) -> np.dtype[Any]:
    """The dtype of a table's rows, as C++ has them: of each type the names of its fields."""
    return np.dtype([(name, kind) for kind, names in fields.items() for name in names.split()], align=True)


def new_array(shape: Tuple[int, ...], dtype: Any) -> NDArray[Any]:
    """An array of any values that begins where lines of a cache do, so that kernels write whole ones."""
    lines = 128
    size = math.prod(shape) * np.dtype(dtype).itemsize
    memory = np.empty(size + lines, np.uint8)
    return np.ndarray(shape, dtype, buffer=memory, offset=-memory.ctypes.data % lines)


def output(
    out: Optional[NDArray[Any]], shape: Tuple[int, ...], dtype: Any, name: str = "out", copied: bool = False
) -> NDArray[Any]:
    """The caller's array, or a new one; that too for one that cannot be written to in place, if it is `copied`."""
    if out is None:
        return new_array(shape, dtype)
    wanted = np.dtype(dtype)
    if not isinstance(out, np.ndarray):
        raise BadArgument(f"{name} must be an array of NumPy; this is of type {type(out).__name__}")
    if out.shape != tuple(shape) or out.dtype != wanted:
        raise BadArgument(
            f"{name} must be {wanted} of the shape {tuple(shape)}; this array is {out.dtype} of {out.shape}"
        )
    if not out.flags.writeable:
        raise BadArgument(f"{name} must be writable; this array is not")
    if out.flags.c_contiguous and out.flags.aligned:
        return out
    if not copied:
        raise BadArgument(f"{name} must be C-contiguous and aligned; this array is not")
    return new_array(shape, dtype)
