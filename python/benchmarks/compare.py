"""Times VoroCL beside SciPy, scikit-image, OpenCV, edt and freud, in one run: compare.py [--size 2048] [--repeat 11]

Prints a table in Markdown: for each number of seeds and task the least and the median time of every package, and how
many pixels it has wrong, by the distances of edt. The others take images, so points lie at the centres of their
pixels here. It is an error if VoroCL has wrong pixels. The packages take turns and may use all cores. Put
POCL_AFFINITY=1 before it.
"""

import argparse
import statistics
import sys
import time

import cv2
import edt
import freud
import numpy as np
import scipy.ndimage
import scipy.spatial
import skimage.segmentation

import vorocl


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, default=2048, help="pixels per side")
    parser.add_argument("--seeds", type=int, nargs="+", default=[64, 1024, 16384, 262144])
    parser.add_argument("--repeat", type=int, default=11, help="timed runs; one more warms up")
    options = parser.parse_args()
    print(f"{options.size} x {options.size} pixels on {vorocl.Device().name}\n")
    print("| seeds | task | package | least ms | median ms | wrong pixels |\n| --- | --- | --- | --- | --- | --- |")
    for count in options.seeds:
        points = np.random.default_rng(count).uniform(0, options.size, (count, 2))
        least = edt.edt(background_of(points, options.size), parallel=0)
        for task, packages in tasks(points, options.size).items():
            times = timed([run for run, _ in packages.values()], options.repeat)
            for (package, (run, distances)), taken in zip(packages.items(), times):
                wrong = "-" if distances is None else int((np.abs(distances(run()) - least) > 1e-3).sum())
                row = count, task, package, f"{min(taken):.1f}", f"{statistics.median(taken):.1f}", wrong
                print("|", " | ".join(map(str, row)), "|", flush=True)
                if package == "VoroCL" and distances and wrong > 0:
                    sys.exit("VoroCL's pixels are wrong")


def timed(ways, repeat):
    """For each way its times in milliseconds. They take turns."""
    times = [[] for _ in ways]
    for _ in range(repeat + 1):
        for way, taken in zip(ways, times):
            begin = time.perf_counter()
            way()
            taken.append(1000 * (time.perf_counter() - begin))
    return [taken[1:] for taken in times]


def background_of(points, size):
    """An image that is 0 where points are."""
    background = np.ones((size, size), np.uint8)
    columns, rows = np.floor(points).astype(int).T
    background[rows, columns] = 0
    return background


def tasks(points, size):
    """For each task and package: what is timed, and what makes distances of its result, if these can be wrong."""
    shape = (size, size)
    count, pixels = len(points), np.floor(points).astype(int)
    seeds = pixels[:, 1] * size + pixels[:, 0]  # as numbers of pixels
    background = background_of(points, size)
    regions = scipy.ndimage.label(scipy.ndimage.binary_dilation(background == 0, iterations=2))[0].astype(np.int32)
    rows, columns = np.indices(shape)
    centres = np.column_stack([columns.ravel(), rows.ravel()])
    labels, distances = np.empty(shape, np.uint32), np.empty(shape, np.float32)
    held, diagram, copy = vorocl.Seeds(points, shape, snap=True), vorocl.Diagram(shape), np.empty_like(labels)
    voronoi, box = freud.locality.Voronoi(), freud.box.Box(size, size, is2D=True)
    centred = np.column_stack([points - size / 2, np.zeros(count)])  # as they are: freud ends at two in one place

    def to_pixel(nearest):
        return np.hypot(columns - nearest % size, rows - nearest // size)

    def to_seed(numbers):
        return to_pixel(seeds[np.reshape(numbers, shape)])

    def scipy_transform():
        indices = scipy.ndimage.distance_transform_edt(background, return_distances=False, return_indices=True)
        return indices[0] * size + indices[1]

    def opencv_labels():
        return cv2.distanceTransformWithLabels(background, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)[1]

    def device_alone():
        diagram.fill(held)
        diagram.device.finish()

    def itself(found):
        return found

    return {
        "labels": {
            "VoroCL": (lambda: vorocl.diagram(points, shape, snap=True, out=labels), to_seed),
            "(VoroCL's device alone)": (device_alone, None),
            "(a copy of the labels)": (lambda: np.copyto(copy, labels), None),
            "SciPy, k-d tree": (lambda: scipy.spatial.cKDTree(pixels).query(centres, workers=-1)[1], to_seed),
            "SciPy, distance transform": (scipy_transform, to_pixel),
            "OpenCV": (opencv_labels, lambda found: to_pixel(np.unique(seeds)[found - 1])),  # from 1, row by row
        },
        "distances": {
            "VoroCL": (lambda: vorocl.distances(points, shape, snap=True, out=distances), itself),
            "SciPy": (lambda: scipy.ndimage.distance_transform_edt(background), itself),
            "OpenCV": (lambda: cv2.distanceTransform(background, cv2.DIST_L2, cv2.DIST_MASK_PRECISE), itself),
            "edt": (lambda: edt.edt(background, parallel=0), itself),
        },
        "regions expanded by 20": {
            "VoroCL": (lambda: vorocl.expand_labels(regions, 20), None),
            "scikit-image": (lambda: skimage.segmentation.expand_labels(regions, 20), None),
        },
        "areas of periodic cells": {
            "VoroCL": (lambda: vorocl.cells(points, shape, periodic=(True, True)), None),
            "freud, polygons": (lambda: voronoi.compute((box, centred)), None),
        },
    }


if __name__ == "__main__":
    main()
