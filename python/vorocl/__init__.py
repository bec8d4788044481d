"""VoroCL: raster Voronoi diagrams of seeds that stand still or move, in OpenCL.

`diagram` gives every pixel of a grid the row of its nearest point. `distances`, `cells`, `areas`, `adjacency`, `vertices`
and `relax` measure the diagram of points or change it; `exact_cells` cuts cells as polygons or polyhedra; `from_mask`,
`expand_labels` and `distance_transform_edt` take images, also of volumes; `similarity` and `errors` compare labels.
A `Grid` says which stretch of the points' plane a diagram shows, and which axes repeat.
`Seeds`, `Diagram` and `Simulation` stay on a `Device`, for points that move and for programs that use OpenCL too.
"""

from ._opencl import load_opencl

load_opencl()  # before the first import of the extension module

from importlib.metadata import version as _version

from ._device import Device, DeviceDescription, devices
from ._errors import (
    BadArgument,
    BadPoint,
    DeviceError,
    DeviceMemoryError,
    Error,
    FileError,
    HostMemoryError,
    KernelBuildError,
)
from ._exact_cells import EXACT_CELL, EXACT_FACE, EXACT_PAIR, EXACT_VOLUME_CELL, ClippedCells, ExactCells, exact_cells
from ._functions import (
    NO_LABEL,
    Relaxation,
    adjacency,
    areas,
    cells,
    diagram,
    distance_transform_edt,
    distances,
    errors,
    expand_labels,
    from_mask,
    mask_tiles,
    relax,
    similarity,
    vertices,
)
from ._grid import Grid
from ._objects import CELL, Diagram, DistanceErrors, Seeds, Simulation
from ._preparation import prepare
from ._vorocl import Report

__version__ = _version("vorocl")

__all__ = [
    "BadArgument",
    "BadPoint",
    "CELL",
    "ClippedCells",
    "Device",
    "DeviceDescription",
    "DeviceError",
    "DeviceMemoryError",
    "Diagram",
    "DistanceErrors",
    "EXACT_CELL",
    "EXACT_FACE",
    "EXACT_PAIR",
    "EXACT_VOLUME_CELL",
    "Error",
    "ExactCells",
    "FileError",
    "Grid",
    "HostMemoryError",
    "KernelBuildError",
    "NO_LABEL",
    "Relaxation",
    "Report",
    "Seeds",
    "Simulation",
    "adjacency",
    "areas",
    "cells",
    "devices",
    "diagram",
    "distance_transform_edt",
    "distances",
    "errors",
    "exact_cells",
    "expand_labels",
    "from_mask",
    "mask_tiles",
    "prepare",
    "relax",
    "similarity",
    "vertices",
]
