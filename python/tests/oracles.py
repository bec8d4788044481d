"""What the tests compare with: brute force in NumPy and SciPy's k-d tree."""

import numpy as np
from scipy.spatial import cKDTree


PARTS = 4096  # of a pixel, to which positions are rounded


def rounded(points, snap=False):
    """Where exact diagrams have points: at the centres of their pixels, or at 1/4096 of a pixel and never out of it."""
    points = np.asarray(points, float)
    pixels = np.floor(points)
    return pixels + (0.5 if snap else np.minimum(np.rint((points - pixels) * PARTS), PARTS - 1) / PARTS)


def from_below(y, height):
    """y counted from the other end: what lies on a pixel's edge lies in the pixel still."""
    pixels = np.floor(y)
    return height - 1 - pixels + np.minimum(1 - (y - pixels), (PARTS - 1) / PARTS)


def pixel_centres(shape):
    """(H * W, 2): x and y of every pixel's centre, row by row."""
    rows, columns = np.indices(shape)
    return np.column_stack([columns.ravel(), rows.ravel()]) + 0.5


def offsets(a, b, shape, periodic):
    """|a - b| per axis, the shorter way round where that is periodic."""
    apart = np.abs(a - b)
    for axis, size in enumerate((shape[1], shape[0])):
        if periodic[axis]:
            apart[..., axis] = np.minimum(apart[..., axis], size - apart[..., axis])
    return apart


def brute_force(points, shape, periodic=(False, False), metric="euclidean", snap=False):
    """Labels by the definition: the nearest position of a point, the first of them row by row, the lowest row of it."""
    points = rounded(points, snap)
    there = np.flatnonzero(~np.isnan(points).any(axis=1))
    order = there[np.lexsort((there, points[there, 0], points[there, 1]))]
    apart = offsets(pixel_centres(shape)[:, None], points[None, order], shape, periodic)
    distances = (apart**2).sum(axis=2) if metric == "euclidean" else apart.sum(axis=2)
    return order[distances.argmin(axis=1)].astype(np.uint32).reshape(shape)


def assert_nearest(labels, points, periodic=(False, False), metric="euclidean", snap=False):
    """Every pixel's label is a point at the least distance that SciPy's k-d tree finds, but for what rounding does."""
    points = np.floor(points) + 0.5 if snap else points
    centres = pixel_centres(labels.shape)
    box = [size if axis else 0 for size, axis in zip(labels.shape[::-1], periodic)]
    tree = cKDTree(points, boxsize=box if any(periodic) else None)
    norm = 2 if metric == "euclidean" else 1
    least, _ = tree.query(centres, p=norm)
    apart = offsets(centres, points[labels.ravel()], labels.shape, periodic)
    np.testing.assert_allclose(np.linalg.norm(apart, norm, axis=1), least, rtol=1e-12, atol=1e-9 if snap else 2**-11)
