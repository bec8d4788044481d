"""VoroCL: raster Voronoi diagrams of seeds that stand still or move, in OpenCL.

`diagram` gives every pixel of a grid the row of its nearest point. `distances`, `cells`, `adjacency`, `vertices` and
`relax` measure the diagram of points or change it; `from_mask` and `expand_labels` take images; `similarity` and
`errors` compare labels. `Seeds`, `Diagram` and `Simulation` stay on a `Device`, for points that move and for programs
that use OpenCL too.
"""

try:
    from . import _vorocl
except ImportError as error:
    if "libOpenCL" not in str(error):
        raise
    raise ImportError(
        "VoroCL needs an OpenCL loader and a driver: NVIDIA's for its GPUs, or PoCL for the CPU (on Debian and Ubuntu: "
        f"apt-get install ocl-icd-libopencl1 pocl-opencl-icd): {error}"
    ) from None

from ._device import Device, devices
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
from ._functions import (
    NO_LABEL,
    Relaxation,
    adjacency,
    cells,
    diagram,
    distances,
    errors,
    expand_labels,
    from_mask,
    relax,
    similarity,
    vertices,
)
from ._objects import CELL, Diagram, Seeds, Simulation
from ._vorocl import DeviceDescription, DistanceErrors, Report

__all__ = [
    "BadArgument",
    "BadPoint",
    "CELL",
    "Device",
    "DeviceDescription",
    "DeviceError",
    "DeviceMemoryError",
    "Diagram",
    "DistanceErrors",
    "Error",
    "FileError",
    "HostMemoryError",
    "KernelBuildError",
    "NO_LABEL",
    "Relaxation",
    "Report",
    "Seeds",
    "Simulation",
    "adjacency",
    "cells",
    "devices",
    "diagram",
    "distances",
    "errors",
    "expand_labels",
    "from_mask",
    "relax",
    "similarity",
    "vertices",
]
