"""Cells as polygons, and in volumes as polyhedra, without pixels."""

from __future__ import annotations

from importlib import import_module
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _vorocl
from ._arguments import Outside, row_of, shown, to_flag, to_outside, to_points, to_weights
from ._device import Device, to_device
from ._errors import BadArgument
from ._grid import Bounds, Grid, Periodic, Tilt, to_periodic
from ._parameters import with_parameters

_FOUND = {np.uint32: "neighbours", np.bool_: "touches_border certified"}

EXACT_CELL = row_of({np.float64: "area centroid_x centroid_y perimeter", **_FOUND})
"""One row of ``ExactCells.cells``."""

EXACT_PAIR = row_of({np.uint32: "a b", np.float64: "length midpoint_x midpoint_y"})
"""One row of ``ExactCells.pairs``."""

EXACT_VOLUME_CELL = row_of({np.float64: "volume centroid_x centroid_y centroid_z surface", **_FOUND})
"""One row of ``ExactCells.cells`` of a volume."""

EXACT_FACE = row_of({np.uint32: "a b", np.float64: "area", np.int32: "image_x image_y image_z"})
"""One row of ``ExactCells.pairs`` of a volume."""


class _Cells:
    """Points, and tables of their cells."""

    points: NDArray[np.float64]
    cells: NDArray[Any]
    pairs: NDArray[Any]
    _crs: Any = None  # of the polygons, if it is known

    def __len__(self) -> int:
        return len(self.cells)

    def __repr__(self) -> str:
        return f"<vorocl.{type(self).__name__} of {len(self)} points>"

    def to_shapely(self) -> NDArray[Any]:
        raise NotImplementedError

    def to_geopandas(self, crs: Any = None, data: Any = None) -> Any:
        """Return a GeoDataFrame of GeoPandas: the fields of `cells`, and the polygons, in a coordinate system.

        Parameters
        ----------
        crs : optional
            The coordinate system of the points, as GeoPandas takes it, such as "EPSG:25832"; else that of `data`, or of the
            region that clipped the cells.
        data : pandas.DataFrame, optional
            One row per point: its columns stand before the fields, and its index, such as ids, names the rows. Of a
            GeoDataFrame the geometry is left out, and the coordinate system is taken unless there is `crs`.

        Raises
        ------
        BadArgument
            If `data` has another number of rows, or a column of a name that the fields have, or another coordinate system
            than the region, as `crs` may have.

        Examples
        --------
        >>> import pandas
        >>> import vorocl
        >>> sites = pandas.DataFrame({"name": ["well", "spring"]}, index=[70, 90])
        >>> cells = vorocl.exact_cells([(1, 1), (3, 1)], (0, 0, 4, 2)).to_geopandas("EPSG:25832", sites)
        >>> print(cells.loc[90, "name"], cells.loc[90, "area"])
        spring 4.0
        >>> cells.to_file("cells.gpkg")  # doctest: +SKIP
        """
        polygons = self.to_shapely()
        geopandas: Any = import_module("geopandas")
        pandas: Any = import_module("pandas")
        fields = pandas.DataFrame(self.cells)
        if crs is None:
            crs = self._crs
        elif self._crs is not None and geopandas.GeoSeries(crs=crs).crs != self._crs:
            raise BadArgument(f"the region is in {self._crs}, and crs is {crs}: bring the cells to it by to_crs()")
        if data is None:
            return geopandas.GeoDataFrame(fields, geometry=polygons, crs=crs)
        if not isinstance(data, pandas.DataFrame):
            raise BadArgument(f"data must be a pandas.DataFrame, not {type(data).__name__}")
        if isinstance(data, geopandas.GeoDataFrame):
            if self._crs is not None and data.crs is not None and self._crs != data.crs:
                raise BadArgument(f"the region is in {self._crs}, and data in {data.crs}: bring one to the other's by to_crs()")
            crs = data.crs if crs is None else crs
            data = pandas.DataFrame(data.drop(columns=data.geometry.name))
        if len(data) != len(self):
            raise BadArgument(f"data must have a row for each of the {len(self)} points, and has {len(data)}")
        for name in [*fields.columns, "geometry"]:
            if name in data.columns:
                raise BadArgument(f'data has a column "{name}", and so have the cells: rename it')
        columns = {name: fields[name].to_numpy() for name in fields}
        return geopandas.GeoDataFrame(data.assign(**columns), geometry=polygons, crs=crs)

    def to_pandas(self) -> Any:
        """Return a DataFrame of pandas: ``x``, ``y`` and of a volume ``z`` of the points, and the fields of `cells`."""
        pandas: Any = import_module("pandas")
        frame = pandas.DataFrame(self.cells)
        for axis, name in enumerate("xyz"[: self.points.shape[1]]):
            frame.insert(axis, name, self.points[:, axis])
        return frame


class ExactCells(_Cells):
    """The cells of points as polygons, or as polyhedra, in the units of the points: what `exact_cells` returns.

    Attributes
    ----------
    points : ndarray
        Shape (N, 2), of a volume (N, 3): the points that were given.
    cells : ndarray
        Structured, one row per point. Of a plane ``area``, ``centroid_x``, ``centroid_y``, ``perimeter`` (with the sides
        of the rectangle); of a volume ``volume``, ``centroid_x``, ``centroid_y``, ``centroid_z``, ``surface``. Then
        ``neighbours`` (edges, or faces, that it shares with cells: the coordination number), ``touches_border``,
        ``certified`` (all decisions were certain). ``pandas.DataFrame(cells)`` makes a table of it. The cell of an absent
        point, of one that is not the first at its place, or with too small a weight is empty: its area is 0, its centroid
        NaN.
    pairs : ndarray
        Structured, one row per edge, or face, between two cells, sorted: ``a``, ``b`` (rows of the points, a <= b), and of
        a plane ``length``, ``midpoint_x``, ``midpoint_y``; of a volume ``area``, and ``image_x``, ``image_y``,
        ``image_z``: the face is normal to ``points[b] + image * periods - points[a]``. Across the ends of periods two
        cells may share several edges, and a cell may be its own neighbour.
    offsets, vertices, neighbours, lengths : ndarray
        Of a plane the polygons: that of point i has the edges from ``offsets[i]`` up to ``offsets[i + 1]``,
        counter-clockwise where y points up, from the lowest vertex on. Each begins at its row of `vertices`, has a length,
        and the cell `neighbours` behind it: ``NO_LABEL`` is a side of the rectangle.
    offsets, neighbours, areas : ndarray
        Of a volume: the faces of point i are those from ``offsets[i]`` up to ``offsets[i + 1]``. Each has an area, and the
        cell `neighbours` behind it.
    vertex_offsets, vertices, corner_offsets, corners : ndarray
        Of a volume, with ``polyhedra=True``: the vertices of point i are the rows of `vertices` from ``vertex_offsets[i]``
        up to ``vertex_offsets[i + 1]``. Face j has the corners from ``corner_offsets[j]`` up to ``corner_offsets[j + 1]``,
        rows of `vertices`, counter-clockwise as seen from outside.
    """

    offsets: NDArray[np.uint32]
    neighbours: NDArray[np.uint32]
    lengths: NDArray[np.float64]
    areas: NDArray[np.float64]
    vertices: NDArray[np.float64]
    vertex_offsets: NDArray[np.int64]
    corner_offsets: NDArray[np.int64]
    corners: NDArray[np.int64]

    def __init__(self, points: NDArray[np.float64], found: Dict[str, NDArray[Any]], goes_round: bool) -> None:
        self.points = points
        self._goes_round = goes_round
        rows = {"cells": EXACT_CELL, "pairs": EXACT_PAIR}
        if self._is_volume:
            rows = {"cells": EXACT_VOLUME_CELL, "pairs": EXACT_FACE}
        for name, array in found.items():
            array = array.view(rows.get(name, array.dtype))
            setattr(self, name, array[:, 0] if array.shape[1] == 1 else np.ascontiguousarray(array[:, : points.shape[1]]))

    @property
    def _is_volume(self) -> bool:
        return bool(self.points.shape[1] == 3)

    def _refuse_volume(self, what: str) -> None:
        if self._is_volume:
            raise BadArgument(f"{what} are of planes; these are the cells of a volume")

    def _require_polyhedra(self) -> None:
        if not hasattr(self, "corners"):
            raise BadArgument("these cells have no polyhedra: cut a volume with polyhedra=True")

    def polygon(self, row: int) -> NDArray[np.float64]:
        """Return the vertices of one cell of a plane, shape (K, 2): those of an empty cell are none."""
        self._refuse_volume("polygons")
        row = range(len(self))[row]  # counted from the end, too
        return self.vertices[self.offsets[row] : self.offsets[row + 1]]

    def polyhedron(self, row: int) -> Tuple[NDArray[np.float64], List[NDArray[np.int64]]]:
        """Return the vertices of one cell of a volume, shape (K, 3), and the corners of each face, rows of these.

        Raises
        ------
        BadArgument
            If the cells were cut without ``polyhedra=True``.

        Examples
        --------
        >>> import vorocl
        >>> found = vorocl.exact_cells([(1, 1, 1), (3, 1, 1)], (0, 0, 0, 4, 2, 2), polyhedra=True)
        >>> vertices, faces = found.polyhedron(0)
        >>> vertices.max(axis=0), len(faces)
        (array([2., 2., 2.]), 6)
        """
        self._require_polyhedra()
        row = range(len(self))[row]
        first, end = self.vertex_offsets[row], self.vertex_offsets[row + 1]
        begins = self.corner_offsets[self.offsets[row] : int(self.offsets[row + 1]) + 1]
        return self.vertices[first:end], [self.corners[begin:behind] - first for begin, behind in zip(begins, begins[1:])]

    def to_pyvista(self) -> Any:
        """Return an UnstructuredGrid of PyVista: the polyhedra of cells that are not empty, with their ``row`` and all fields.

        Raises
        ------
        BadArgument
            If the cells were cut without ``polyhedra=True``.

        Examples
        --------
        >>> import vorocl
        >>> found = vorocl.exact_cells([(1, 1, 1), (3, 1, 1)], (0, 0, 0, 4, 2, 2), polyhedra=True)
        >>> grid = found.to_pyvista()  # doctest: +SKIP
        >>> grid.plot(scalars="volume")  # doctest: +SKIP
        """
        self._require_polyhedra()
        pyvista: Any = import_module("pyvista")
        counts = np.diff(self.offsets.astype(np.int64))
        full = np.flatnonzero(counts)
        # As VTK has it: before the corners of each face stands how many they are, and before the faces of each cell how many
        # numbers follow, and how many faces.
        faces = np.insert(self.corners, self.corner_offsets[:-1], np.diff(self.corner_offsets))
        places = self.corner_offsets + np.arange(len(self.corner_offsets))
        begins = places[self.offsets[full]]
        heads = np.column_stack([1 + places[self.offsets[full + 1]] - begins, counts[full]])
        cells = np.insert(faces, np.repeat(begins, 2), heads.ravel())
        grid = pyvista.UnstructuredGrid(cells, np.full(len(full), pyvista.CellType.POLYHEDRON), self.vertices)
        grid.cell_data["row"] = full
        for name in EXACT_VOLUME_CELL.names or ():
            grid.cell_data[name] = self.cells[name][full]
        return grid

    def to_shapely(self) -> NDArray[Any]:
        """Return the polygons of Shapely, one per point, by one call of it; empty ones of empty cells.

        Examples
        --------
        >>> import vorocl
        >>> polygons = vorocl.exact_cells([(1, 1), (3, 1)], (0, 0, 4, 2)).to_shapely()
        >>> [polygon.area for polygon in polygons]
        [4.0, 4.0]
        """
        self._refuse_volume("polygons of Shapely")
        shapely: Any = import_module("shapely")
        begins, ends = self.offsets[:-1].astype(np.int64), self.offsets[1:].astype(np.int64)
        full = np.flatnonzero(ends > begins)
        starts, counts = begins[full], (ends - begins)[full]
        # Each ring ends with its first vertex.
        at = np.concatenate([[0], np.cumsum(counts + 1)])
        rows = np.arange(at[-1]) - np.repeat(at[:-1] - starts, counts + 1)
        rows[at[1:] - 1] = starts
        polygons = np.full(len(self), shapely.Polygon(), dtype=object)
        if len(full) > 0:
            rings = shapely.linearrings(self.vertices[rows], indices=np.repeat(np.arange(len(full)), counts + 1))
            polygons[full] = shapely.polygons(rings)
        return polygons

    def clip(self, region: Any) -> ClippedCells:
        """Return what of the cells of a plane lies in a region, such as a country; by Shapely 2.

        Parameters
        ----------
        region : shapely.Polygon, shapely.MultiPolygon, sequence of these, geopandas.GeoSeries or geopandas.GeoDataFrame
            All of them together, with their holes; in the units of the points. The coordinate system of GeoPandas is kept.

        Raises
        ------
        BadArgument
            If there is another geometry, one that is not valid or no area, and for cells of a volume or a periodic plane.

        Examples
        --------
        >>> import shapely
        >>> import vorocl
        >>> found = vorocl.exact_cells([(1, 1), (3, 1)], (0, 0, 4, 2)).clip(shapely.box(1, 0.5, 2.5, 5))
        >>> found.cells["area"], found.pairs["length"]
        (array([1.5 , 0.75]), array([1.5]))
        """
        self._refuse_volume("clipped cells")
        if self._goes_round:
            raise BadArgument("cells that go round a periodic axis cannot be clipped; cut them without periodic")
        return ClippedCells(self, region)

    def _edges(self) -> NDArray[np.float64]:
        """The ends of the edge of each pair, shape (K, 2, 2), of a plane that is not periodic."""
        begins, counts = self.offsets[:-1].astype(np.int64), np.diff(self.offsets)
        cells = np.repeat(np.arange(len(self), dtype=np.uint32), counts)
        behind = np.arange(1, len(cells) + 1)
        behind[(begins + counts - 1)[counts > 0]] = begins[counts > 0]
        edges = np.flatnonzero((self.neighbours > cells) & (self.neighbours < len(self)))
        edges = edges[np.lexsort((self.neighbours[edges], cells[edges]))]
        return np.stack([self.vertices[edges], self.vertices[behind[edges]]], axis=1)


class ClippedCells(_Cells):
    """What of the cells of a plane lies in a region: what `ExactCells.clip` returns.

    A cell may be in several parts, have holes, or be empty: then its area is 0, and its centroid NaN.

    Attributes
    ----------
    points : ndarray
        Shape (N, 2): the points that were given, those outside the region too.
    cells : ndarray
        As of `ExactCells`, of what is left: ``touches_border`` is true where the region's border cuts the cell or touches
        it, and ``perimeter`` has that border too.
    pairs : ndarray
        As of `ExactCells`: the pairs that still touch in the region, the length of their edge there, and its middle.
    """

    def __init__(self, whole: ExactCells, region: Any) -> None:
        shapely: Any = import_module("shapely")
        area, self._crs = _to_region(region)
        shapely.prepare(area)
        self.points, self.cells, self._polygons = whole.points, whole.cells.copy(), whole.to_shapely()
        inside = shapely.contains_properly(area, self._polygons)
        rest = np.flatnonzero(~inside)
        met = rest[shapely.intersects(area, self._polygons[rest])]
        # The region's parts are apart, and smaller than all of it.
        parts = shapely.get_parts(area)
        tree = shapely.STRtree(parts)
        of, part = tree.query(self._polygons[met])
        cut = _united(shapely.intersection(self._polygons[met[of]], parts[part]), of, len(met))
        self._polygons[rest] = shapely.Polygon()
        self._polygons[met] = cut
        left = self._polygons[rest]
        x, y = _centroids(left)
        changes = {
            "area": shapely.area(left),
            "centroid_x": x,
            "centroid_y": y,
            "perimeter": shapely.length(left),
            "touches_border": ~shapely.is_empty(left),
        }
        for name, values in changes.items():
            self.cells[name][rest] = values

        pairs = whole.pairs.copy()
        a, b = pairs["a"], pairs["b"]
        there = self.cells["area"] > 0
        pairs["length"][~(there[a] & there[b])] = 0
        some = np.flatnonzero((pairs["length"] > 0) & ~inside[a] & ~inside[b])
        lines = shapely.linestrings(whole._edges()[some])
        crossing = ~shapely.contains_properly(area, lines)
        some, lines = some[crossing], lines[crossing]
        of, part = tree.query(lines)
        lines = shapely.intersection(lines[of], parts[part])
        lines = shapely.difference(lines, shapely.boundary(parts)[part])  # along which a cell has no other beside it
        lengths = shapely.length(lines)
        of, lines, lengths = of[lengths > 0], lines[lengths > 0], lengths[lengths > 0]
        sums = np.bincount(of, lengths, minlength=len(some))
        pairs["length"][some] = sums
        for name, centres in zip(("midpoint_x", "midpoint_y"), _centroids(lines)):
            pairs[name][some] = np.bincount(of, lengths * centres, minlength=len(some)) / np.where(sums > 0, sums, 1)
        self.pairs = pairs[pairs["length"] > 0]
        both = np.concatenate([self.pairs["a"], self.pairs["b"]])
        self.cells["neighbours"] = np.bincount(both, minlength=len(self))

    def to_shapely(self) -> NDArray[Any]:
        """Return a Polygon or MultiPolygon of Shapely per point; empty ones of empty cells."""
        return self._polygons.copy()


def _centroids(geometries: NDArray[Any]) -> NDArray[np.float64]:
    """Their x and their y; NaN of empty ones."""
    shapely: Any = import_module("shapely")
    places, of = shapely.get_coordinates(shapely.centroid(geometries), return_index=True)
    found = np.full((2, len(geometries)), np.nan)
    found[:, of] = places.T
    return found


def _united(geometries: NDArray[Any], of: NDArray[np.intp], count: int) -> NDArray[Any]:
    """Their polygons, all `of` a number as one, without points and lines in which shapes meet."""
    shapely: Any = import_module("shapely")
    parts, rows = shapely.get_parts(geometries, return_index=True)
    flat = (shapely.get_dimensions(parts) == 2) & ~shapely.is_empty(parts)
    parts, of = parts[flat], of[rows[flat]]
    result = np.full(count, shapely.Polygon(), dtype=object)
    result[of] = parts
    several = (np.bincount(of, minlength=count) > 1)[of]
    rows, numbers = np.unique(of[several], return_inverse=True)
    if len(rows) > 0:
        result[rows] = shapely.multipolygons(parts[several], indices=numbers)
    return result


def _to_region(region: Any) -> Tuple[Any, Any]:
    """All polygons as one, and their coordinate system."""
    shapely: Any = import_module("shapely")
    given = np.atleast_1d(np.asarray(getattr(region, "geometry", region), dtype=object))
    given = given[~shapely.is_missing(given)]
    if not shapely.is_geometry(given).all() or not np.isin(shapely.get_type_id(given), (3, 6)).all():
        raise BadArgument(f"region must be polygons of Shapely or GeoPandas; this is {shown(region)}")
    for polygon in given[~shapely.is_valid(given)]:
        raise BadArgument(f"region is no valid polygon: {shapely.is_valid_reason(polygon)}; shapely.make_valid() may help")
    given = shapely.force_2d(given)
    area = given[0] if len(given) == 1 else shapely.union_all(given)
    if area.is_empty:
        raise BadArgument("region is empty")
    return area, getattr(region, "crs", None)


@with_parameters
def exact_cells(
    points: ArrayLike,
    bounds: Bounds,
    *,
    periodic: Periodic = (False, False),
    tilt: Tilt = 0.0,
    outside: Outside = "count",
    weights: Optional[ArrayLike] = None,
    polyhedra: bool = False,
    device: Optional[Device] = None,
) -> ExactCells:
    """Cut a rectangle, or a box, into the Euclidean Voronoi cells of points, as polygons or polyhedra, without pixels.

    Points, and the rectangle, are rounded to a power of two that is at most 2**-29 of the longer side, in a volume 2**-39
    of the longest; whole numbers, halves and so on stay as they are. Of these points the cells are exact: neighbours are
    decided in whole numbers, and cells that touch in a point (in a volume in an edge) are none. Vertices are right to about
    2**-50 of their distance from the point; in a volume where planes are almost parallel to 2**-36.

    Parameters
    ----------
    points : array_like
        Shape (N, 2), rows (x, y), in the units of `bounds`, or of a volume (N, 3), rows (x, y, z). A row with a NaN is
        absent, and so is a row that is masked.
    bounds : sequence of float
        (x0, y0, x1, y1), the rectangle, or of a volume (x0, y0, z0, x1, y1, z1), the box.
    periodic : (bool, bool), optional
        Which axes, x and y, are periodic: the rectangle is the period. Cells are whole across its ends, where they reach
        beyond it. Of a volume three: x, y and z.
    <tilt>
        Points are rounded to 2**-28 of the longer side then, in a volume to 2**-38 of the longest. Images of faces count
        the edges of the box: (width, 0, 0), (xy, height, 0) and (xz, yz, depth).
    outside : {"count", "absent", "refuse"}, optional
        What becomes of points outside the bounds. "count": they have what of the rectangle is nearest to them; in a volume
        they are refused. "absent": they have no cell. "refuse": they are an error.
    <weights>
        Weights are rounded to the square of what points are rounded to, or to 2**-53 of how far the greatest lies above
        them.
    polyhedra : bool, optional
        Of a volume: whether vertices and faces are made too. Cells are cut twice then.
    <device>

    Returns
    -------
    ExactCells

    Raises
    ------
    DeviceError
        Also if the device has no double precision (cl_khr_fp64).
    BadPoint, BadArgument, DeviceMemoryError

    Examples
    --------
    >>> import vorocl
    >>> found = vorocl.exact_cells([(1, 1), (3, 1), (1, 3), (3, 3)], (0, 0, 4, 4))
    >>> found.cells["area"]
    array([4., 4., 4., 4.])
    >>> found.pairs[["a", "b", "length"]].tolist()
    [(0, 1, 2.0), (0, 2, 2.0), (1, 3, 2.0), (2, 3, 2.0)]

    Two points in a box, each of which meets the other through two faces where x is periodic:

    >>> found = vorocl.exact_cells([(1, 1, 1), (3, 1, 1)], (0, 0, 0, 4, 2, 2), periodic=(True, False, False))
    >>> found.cells[["volume", "surface", "neighbours"]].tolist()
    [(8.0, 24.0, 2), (8.0, 24.0, 2)]
    >>> found.pairs.tolist()
    [(0, 1, 4.0, -1, 0, 0), (0, 1, 4.0, 0, 0, 0)]

    Two circles, of the radii 1 and 0.5, meet where tangents to both are as long:

    >>> vorocl.exact_cells([(1, 1), (3, 1)], (0, 0, 4, 2), weights=[1, 0.25]).cells["area"]
    array([4.375, 3.625])
    """
    if bounds is None:
        raise BadArgument(
            "bounds must be four numbers (x0, y0, x1, y1), or six of a volume (x0, y0, z0, x1, y1, z1); "
            f"these are {shown(bounds)}"
        )
    try:
        dimensions = 3 if len(bounds) == 6 else 2
    except (TypeError, ValueError):
        dimensions = 2
    with_polyhedra = to_flag(polyhedra, "polyhedra")
    if with_polyhedra and dimensions == 2:
        raise BadArgument("polyhedra are of volumes: give points (x, y, z), and six bounds")
    grid = Grid((2, 1, 1) if dimensions == 3 else (1, 1), bounds, periodic, tilt)._of(outside)
    array = to_points(points, dimensions)
    given = to_weights(weights, len(array))
    seeds = _vorocl.Seeds(to_device(device)._device, grid, array, to_outside(outside), True, given)
    found = _vorocl.exact_cells(seeds, with_polyhedra)
    return ExactCells(array.copy(), found, any(to_periodic(periodic, dimensions)))
