"""What the tests compare with: brute force in NumPy and SciPy's k-d tree."""

import numpy as np
from scipy.spatial import cKDTree


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


def brute_force(points, shape, periodic=(False, False), metric="euclidean"):
    """Labels by the definition: the nearest pixel of a point, the first of them row by row, the lowest row of it."""
    points = np.floor(np.asarray(points, float)) + 0.5
    there = np.flatnonzero(~np.isnan(points).any(axis=1))
    order = there[np.lexsort((there, points[there, 0], points[there, 1]))]
    apart = offsets(pixel_centres(shape)[:, None], points[None, order], shape, periodic)
    distances = (apart**2).sum(axis=2) if metric == "euclidean" else apart.sum(axis=2)
    return order[distances.argmin(axis=1)].astype(np.uint32).reshape(shape)


def assert_nearest(labels, points, periodic=(False, False), metric="euclidean"):
    """Every pixel's label is a point at the least distance that SciPy's k-d tree finds."""
    points = np.floor(points) + 0.5
    centres = pixel_centres(labels.shape)
    box = [size if axis else 0 for size, axis in zip(labels.shape[::-1], periodic)]
    tree = cKDTree(points, boxsize=box if any(periodic) else None)
    norm = 2 if metric == "euclidean" else 1
    least, _ = tree.query(centres, p=norm)
    apart = offsets(centres, points[labels.ravel()], labels.shape, periodic)
    np.testing.assert_allclose(np.linalg.norm(apart, norm, axis=1), least, rtol=1e-12, atol=1e-9)
