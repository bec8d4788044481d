#!/usr/bin/env python3
"""Times labels of volumes beside edt and SciPy, and counts the wrong voxels of jump flooding.

Needs the packages vorocl, edt and scipy, and a CPU as the device. Programs take turns, and the least of some rounds is
printed, in ms. Those named "points" (anywhere in the set's voxels) and "snapped" (at their centres) are from seeds on the device
to labels on the device; the others from array to array.
"""

import argparse
import time

import edt
import numpy as np
from scipy import ndimage

import vorocl


def seeds_of(name, side, random):
    """Voxels (x, y, z) of a set: a number is so many voxels per seed."""
    count = side**3 // 512
    if name == "plane":
        seeds = random.integers(0, side, (count, 3))
        seeds[:, 2] = side // 3
    elif name == "line":
        seeds = np.full((side, 3), side // 2)
        seeds[:, 0] = np.arange(side)
    elif name == "sphere":
        ways = random.standard_normal((count, 3))
        seeds = (side / 2 + 0.45 * side * ways / np.linalg.norm(ways, axis=1)[:, None]).astype(int)
    elif name == "corner":
        seeds = random.integers(0, side // 4, (count, 3))
    elif name == "solid":
        return np.argwhere(random.uniform(size=(side,) * 3) < 0.99)[:, ::-1]
    else:
        seeds = random.integers(0, side, (side**3 // int(name), 3))
    return seeds


class Work:
    """What is timed, of one set."""

    def __init__(self, seeds, side, random):
        self.mask = np.ones((side,) * 3, np.uint8)
        self.mask[seeds[:, 2], seeds[:, 1], seeds[:, 0]] = 0
        self.seeds = vorocl.Seeds(seeds + random.uniform(size=seeds.shape), self.mask.shape)
        self.centres = vorocl.Seeds(seeds + 0.5, self.mask.shape, snap=True)
        self.diagram = vorocl.Diagram(self.mask.shape)
        self.wrong = 0

    def points(self):
        return self.diagram.fill(self.seeds).milliseconds

    def snapped(self):
        return self.diagram.fill(self.centres).milliseconds

    def jfa(self):
        milliseconds = self.diagram.fill(self.centres, "jfa").milliseconds
        self.wrong = self.diagram.errors().wrong_pixels
        return milliseconds

    def distances(self):
        vorocl.distance_transform_edt(self.mask)

    def indices(self):
        vorocl.distance_transform_edt(self.mask, return_distances=False, return_indices=True)

    def edt(self):
        edt.edt(self.mask, parallel=2)

    def scipy(self):
        ndimage.distance_transform_edt(self.mask)

    def scipy_indices(self):
        ndimage.distance_transform_edt(self.mask, return_distances=False, return_indices=True)


def milliseconds(work):
    start = time.perf_counter()
    of_device = work()
    return 1e3 * (time.perf_counter() - start) if of_device is None else of_device


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--side", type=int, default=256)
    parser.add_argument("--sets", nargs="+", default=["4096", "512", "64", "8", "plane", "line", "sphere", "corner", "solid"])
    parser.add_argument("--work", nargs="+", default=["points", "snapped", "distances", "indices", "edt", "jfa", "scipy"])
    parser.add_argument("--repeat", type=int, default=4)
    options = parser.parse_args()
    print("| set | " + " | ".join(options.work) + " | wrong voxels of jfa |\n" + "| --- " * (len(options.work) + 2) + "|")
    for name in options.sets:
        random = np.random.default_rng(12)
        work = Work(seeds_of(name, options.side, random), options.side, random)
        least = dict.fromkeys(options.work, np.inf)
        for repetition in range(options.repeat):
            for what in options.work:
                if repetition > 0 and what.startswith("scipy"):
                    continue
                least[what] = min(least[what], milliseconds(getattr(work, what)))
        print(f"| {name} | " + " | ".join(f"{least[what]:.1f}" for what in options.work) + f" | {work.wrong} |", flush=True)


if __name__ == "__main__":
    main()
