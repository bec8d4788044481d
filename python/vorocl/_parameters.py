"""The parameters that many functions share, described once: a decorator puts them into docstrings."""

from __future__ import annotations

import re
from typing import Any, TypeVar

_TEXTS = {
    "points": """\
points : array_like
    Shape (N, 2), rows (x, y): in pixels, x to the right, y down, or in the units of `bounds`. Pixel i covers
    [i, i + 1). A row with a NaN is absent, and so is a row that is masked. In a volume (N, 3), rows (x, y, z).""",
    "weights": """\
weights : array_like, optional
    Shape (N,), in squared units of the points: cells are those of the power diagram (Laguerre, radical), in which a place
    belongs to the point of the least squared distance less its weight. Of spheres give the squared radii. Cells may be
    empty, and a point may lie outside its cell.""",
    "weighted": """\
weights : array_like, optional
    Shape (N,), in squared units of the points: labels are those of the power diagram (Laguerre, radical), in which a place
    belongs to the point of the least squared distance less its weight. Of spheres give the squared radii. Points without
    a pixel are usual then, and distances are as without weights. "exact" alone takes weights, by the Euclidean metric, of
    pixels that are squares or cubes in the units of `bounds`, to 1 %; they are rounded to 2**-11 squared pixels.""",
    "snap": """\
snap : bool, optional
    Whether points are moved to the centres of their pixels, as methods that flood always do. Without it, "exact" takes
    the points themselves, rounded to 1/4096 of a pixel, and "exact" alone can: several points of one pixel may own
    pixels then.""",
    "truth": """\
truth : {"snapped", "true"}, optional
    Whether points at the centres of their pixels are the truth, as for methods that flood, or the points themselves,
    rounded to 1/4096 of a pixel.""",
    "grid": """\
grid : Grid or (int, int) or (int, int, int)
    A `Grid`; or its shape (H, W), of a volume (D, H, W). Then `bounds`, `periodic`, `tilt`, `y_up` and
    `spacing` are keywords here, too.""",
    "shape": """\
shape : (int, int) or (int, int, int)
    (H, W) in pixels: sides from 1 to 32,768, and at most 2**30 pixels. Along a periodic axis methods that flood take up
    to 32,000. Or a volume, (D, H, W) in voxels: sides up to 16,384, and as many voxels as 2048 x 1024 x 1024; along
    periodic axes half as many.""",
    "method": """\
method : str, optional
    "exact", or one that floods and is approximate: "standard-flooding", "jfa", "jfa+1", "jfa+2", "1+jfa", "djfa",
    "low-resolution".""",
    "metric": """\
metric : {"euclidean", "manhattan", "great-circle"}, optional
    How far a pixel's centre is from a point. "great-circle": on the globe, for "exact". Points are (longitude, latitude)
    in degrees, `bounds` are a part of the globe or, without them, (-180, -90, 180, 90), longitudes go round by
    themselves, distances are kilometres on a sphere of 6371.0088 km, and areas square kilometres.""",
    "metric_of_pixels": """\
metric : {"euclidean", "manhattan"}, optional
    How far the centres of two pixels are from each other.""",
    "bounds": """\
bounds : sequence of float, optional
    (x0, y0, x1, y1), the rectangle of the points' plane that the grid shows, or of a volume (x0, y0, z0, x1, y1, z1):
    a point is in the column floor((x - x0) * W / (x1 - x0)); rows and slices likewise. Where pixels are no squares in these units, the nearest point in
    pixels need not be the nearest in the plane. Without it, points are in pixels.""",
    "periodic": """\
periodic : (bool, bool), optional
    Which axes, x and y, are periodic: distances go the shorter way round, and points outside wrap. Of a volume three:
    x, y and z.""",
    "tilt": """\
tilt : float or (float, float, float), optional
    Of a box that is tilted in its plane, as LAMMPS's ``xy``: how far the copy of the grid at greater y is shifted along
    x, in the units of the points. The grid has the points of the parallelogram with the edges (width, 0) and
    (tilt, height). Both axes must be periodic then. Methods that flood know no tilt. Of a volume three: LAMMPS's ``xy``,
    ``xz`` and ``yz``.""",
    "outside": """\
outside : {"count", "absent", "refuse"}, optional
    What becomes of points outside the grid or the bounds. "count": the grid is a window of a larger plane, and they are
    seeds too. A method that floods refuses them. "exact" refuses one that may own pixels and lies more than 2**18
    pixels away, unless it is snapped. "absent": they have no cell. "refuse": they are an error. With the last two, a
    point at x1 or y1 of the bounds is in the last pixel, as along the other axis of a periodic grid. In a volume, and
    with a `spacing`, "count" refuses too.""",
    "y_up": """\
y_up : bool, optional
    Whether y of the points goes up: rows are counted from the bottom then. A point that lies between two rows belongs to
    the one above, and "exact" takes it 1/4096 of a pixel inside.""",
    "spacing": """\
spacing : sequence of int, optional
    As how many units distances count a pixel along x and y, in a volume a voxel along x, y and z: from 1 to 64, such as
    (1, 1, 4) for slices that lie four pixels apart. Distances in pixels are in these units then.""",
    "units": """\
units : {"data", "pixels"}, optional
    What results are in: the units of the points, or pixels, x to the right and y down. Without it, the units of the
    points; without `bounds` these are pixels, down or up by `y_up`.""",
    "device": """\
device : Device, optional
    Without it, ``Device()``.""",
}

Documented = TypeVar("Documented")


def with_parameters(documented: Documented) -> Documented:
    """Replace lines such as ``<points, shape>`` of a function's or class's docstring by the parameters they name."""
    text: Any = documented.__doc__
    if text is not None:  # python -OO leaves none

        def described(match: re.Match[str]) -> str:
            lines = "\n".join(_TEXTS[name] for name in match[2].split(", ")).split("\n")
            return "\n".join(match[1] + line for line in lines)

        documented.__doc__ = re.sub(r"^( *)<([a-z_, ]+)>$", described, text, flags=re.MULTILINE)
    return documented
