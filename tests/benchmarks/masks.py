#!/usr/bin/env python3
"""Times what VoroCL makes of masks beside edt, SimpleITK, SciPy, OpenCV and scikit-image, in tables.

A number is the least processor time of all threads in ms, the median of the rounds behind it. Programs take turns. Each table
ends with what VoroCL takes of the peer's time: least by least, median by median. The distances of the first round are compared
with SciPy's, bit by bit, else with the squares of edt. Of SimpleITK, SciPy and scikit-image there are fewer rounds.

Needs the packages vorocl, numpy, scipy, scikit-image and edt, and with them SimpleITK and opencv-python-headless.
"""

import argparse
import resource
import statistics

import edt
import numpy as np
import skimage.data
import skimage.segmentation
from scipy import ndimage

import vorocl

SLOW = ("SimpleITK", "SciPy", "scikit-image")


# --- masks: what is not 0 is the foreground, whose distances to the zeros are looked for ---


def grid(shape):
    """Coordinates from slow to fast, of which a plane's first is 0 everywhere."""
    axes = np.ogrid[tuple(slice(0, side) for side in shape)]
    return axes if len(shape) == 3 else [np.zeros((1, 1), int), *axes]


def middle(shape):
    return [(side - 1) / 2 for side in (1,) * (3 - len(shape)) + tuple(shape)]


def from_middle(shape):
    return sum((axis - half) ** 2 for axis, half in zip(grid(shape), middle(shape)))


def balls(shape, count=300):
    random = np.random.default_rng(4)
    radius = max(2, min(shape) * 10 // 256 if len(shape) == 3 else min(shape) * 40 // 2048)
    mask = np.zeros(shape, bool)
    for place in random.uniform(radius, np.array(shape) - radius, (count, len(shape))):
        paint(mask, place, radius)
    return mask


def paint(mask, place, radius):
    """A ball, within the mask."""
    first = np.maximum((place - radius - 1).astype(int), 0)
    last = np.minimum((place + radius + 2).astype(int), mask.shape)
    box = tuple(slice(a, b) for a, b in zip(first, last))
    mask[box] |= sum((axis - at) ** 2 for axis, at in zip(np.ogrid[box], place)) < radius**2


def tubes(shape):
    """As vessels: thick lines along random walks."""
    random = np.random.default_rng(7)
    mask = np.zeros(shape, bool)
    for _ in range(12 if len(shape) == 3 else 20):
        place, way = random.uniform(0, shape), random.normal(size=len(shape))
        radius = random.uniform(2, 8) if len(shape) == 3 else random.uniform(3, 20)
        for _ in range(2 * max(shape)):
            way = way / np.linalg.norm(way) + random.normal(size=len(shape)) * 0.08
            place = place + way / np.linalg.norm(way)
            if (place < 0).any() or (place >= shape).any():
                break
            paint(mask, place, radius)
    return mask


def blobs(percent, size):
    def make(shape):
        made = skimage.data.binary_blobs(
            max(shape), n_dim=len(shape), volume_fraction=percent / 100, blob_size_fraction=size, rng=1
        )
        return np.ascontiguousarray(made[tuple(slice(0, side) for side in shape)])

    return make


def noise(one_in):
    def make(shape):
        mask = np.ones(shape, bool)
        mask.flat[np.random.default_rng(3).choice(mask.size, max(1, mask.size // one_in), replace=False)] = False
        return mask

    return make


def one_value(value, *corner):
    def make(shape):
        mask = np.full(shape, not value)
        mask[tuple(0 if corner else side // 2 for side in shape)] = value
        return mask

    return make


def where(says):
    """A mask of the places where a function of z, y, x, the shape is true."""
    return lambda shape: np.array(np.broadcast_to(says(*grid(shape), shape), shape))


def at(points):
    """A mask whose zeros are the points nearest to places."""

    def make(shape):
        mask = np.ones(shape, bool)
        places = np.rint(points(shape, np.random.default_rng(5))).astype(int)
        places = places[((places >= 0) & (places < shape)).all(1)]
        mask[tuple(places.T)] = False
        return mask

    return make


def shell(share):
    def make(shape):
        radius = share * min(shape)
        return np.ascontiguousarray((from_middle(shape) < radius**2) | (from_middle(shape) >= (radius + 1) ** 2))

    return make


def spiral(shape, random):
    turn = np.linspace(0, 40 * np.pi, 200_000)
    out = turn / turn[-1] * min(shape) / 2
    y, x = middle(shape)[1:]
    along = [np.full_like(turn, shape[0] / 2)] if len(shape) == 3 else []
    return np.stack([*along, y + out * np.cos(turn), x + out * np.sin(turn)], 1)


def helix(shape, random):
    turn = np.linspace(0, 40 * np.pi, 200_000)
    z, y, x = middle(shape)
    return np.stack(
        [turn / turn[-1] * shape[0], y + shape[1] * 0.45 * np.sin(turn), x + shape[2] * 0.45 * np.cos(turn)], 1
    )


def on_sphere(shape, random):
    ways = random.normal(size=(3000 if len(shape) == 3 else 1000, len(shape)))
    return np.array(middle(shape)[-len(shape) :]) + min(shape) * 0.49 * ways / np.linalg.norm(ways, axis=1)[:, None]


def lines(shape, random):
    share = np.linspace(0, 1, 4 * max(shape))[:, None]
    return np.concatenate([a + (b - a) * share for a, b in random.uniform(0, shape, (60, 2, len(shape)))])


def combs(z, y, x, shape):
    rows = y if len(shape) == 2 else y + z
    return ~(((x == 0) & (rows % 32 == 0)) | ((x == shape[-1] - 1) & (rows % 32 == 16)))


def random_sides(shape):
    mask, random = np.ones(shape, bool), np.random.default_rng(5)
    mask[..., 0] = random.random(shape[:-1]) < 0.99
    mask[..., -1] = random.random(shape[:-1]) < 0.99
    return mask


def rows_and_columns(along_x):
    def make(shape):
        sides = list(shape)
        sides[-1 if along_x else 0] = 1
        return np.array(np.broadcast_to(np.random.default_rng(5).random(sides) < 0.995, shape))

    return make


def blocks(shape):
    coarse = np.random.default_rng(5).random([-(-side // 32) for side in shape]) < 0.5
    for axis in range(len(shape)):
        coarse = np.repeat(coarse, 32, axis)
    return np.ascontiguousarray(coarse[tuple(slice(0, side) for side in shape)])


def slow(z, y, shape):
    return z if len(shape) == 3 else y


def outside(make):
    return lambda shape: ~make(shape)


one_ball = where(lambda z, y, x, shape: from_middle(shape) < (100 / 256 * min(shape)) ** 2)

MASKS = {
    "one ball": one_ball,
    "outside one ball": outside(one_ball),
    "300 balls": balls,
    "outside 300 balls": outside(balls),
    "blobs 10 %": blobs(10, 0.1),
    "blobs 50 %": blobs(50, 0.1),
    "blobs 90 %": blobs(90, 0.1),
    "fine blobs 50 %": blobs(50, 0.02),
    "tubes": tubes,
    "outside tubes": outside(tubes),
    "plane": where(lambda z, y, x, shape: slow(z, y, shape) != shape[0] // 3),
    "slabs 32 of 64": where(lambda z, y, x, shape: slow(z, y, shape) // 32 % 2 == 0),
    "noise 50 %": noise(2),
    "noise 1/8": noise(8),
    "noise 1/64": noise(64),
    "noise 1/4096": noise(4096),
    "checkerboard": where(lambda z, y, x, shape: (z + y + x) % 2 == 0),
    "all zero but one": one_value(True),
    "one zero (corner)": one_value(False, "corner"),
}

HARD = {
    "shell, large": shell(0.49),
    "shell, larger than the image": shell(0.7),
    "shell, half": shell(0.25),
    "parabola": where(
        lambda z, y, x, shape: abs(slow(z, y, shape) - np.sqrt(from_middle(shape) - (slow(z, y, shape) - (shape[0] - 1) / 2) ** 2) ** 2 / shape[0]) > 0.7
    ),
    "parabola, on its side": where(
        lambda z, y, x, shape: abs(x - (slow(z, y, shape) - shape[0] / 2) ** 2 / shape[0]) > 0.7
    ),
    "diagonal": where(lambda z, y, x, shape: slow(z, y, shape) != x),
    "line across a corner": where(lambda z, y, x, shape: slow(z, y, shape) + x != 20),
    "steep line": where(lambda z, y, x, shape: abs(x - slow(z, y, shape) / 8) > 0.5),
    "flat line": where(lambda z, y, x, shape: abs(x / 8 - slow(z, y, shape)) > 0.1),
    "two combs": where(combs),
    "two random sides": random_sides,
    "8 zeros": at(lambda shape, random: random.uniform(0, shape, (8, len(shape)))),
    "512 zeros": at(lambda shape, random: random.uniform(0, shape, (512, len(shape)))),
    "spiral": at(spiral),
    "helix": at(helix),
    "cylinder along y": where(
        lambda z, y, x, shape: abs(np.sqrt(from_middle(shape) - (y - (shape[-2] - 1) / 2) ** 2) - min(shape) * 0.49) > 0.7
    ),
    "random ones of a sphere": at(on_sphere),
    "60 lines": at(lines),
    "random columns": rows_and_columns(False),
    "random rows": rows_and_columns(True),
    "random blocks": blocks,
    "nested shells": where(lambda z, y, x, shape: np.sqrt(from_middle(shape)).astype(int) % 16 != 0),
    "thin walls": where(lambda z, y, x, shape: (slow(z, y, shape) % 16 != 0) & (y % 16 != 0) & (x % 16 != 0)),
    "diagonal walls": where(lambda z, y, x, shape: (z + y + x) % 64 != 0),
    "Sierpinski": where(lambda z, y, x, shape: ((z & y) | (y & x) | (z & x)) != 0),
    "outside Sierpinski": where(lambda z, y, x, shape: ((z & y) | (y & x) | (z & x)) == 0),
    "checkerboard of 32": where(lambda z, y, x, shape: (z // 32 + y // 32 + x // 32) % 2 == 0),
}
VOLUMES_ALONE = ("helix", "cylinder along y")


# --- seeds at the centres of pixels, as points ---


def random_points(share):
    return lambda shape, random: random.integers(0, shape[::-1], (int(np.prod(shape) * share), len(shape)))


def pixels(says):
    """The pixels where a function of z, y, x, the shape is true."""
    return lambda shape, random: np.argwhere(where(says)(shape))[:, ::-1]


SEEDS = {
    "random, 1/1024": random_points(1 / 1024),
    "random, 1/64": random_points(1 / 64),
    "random, 1/16": random_points(1 / 16),
    "random, 1/4": random_points(1 / 4),
    "every pixel": pixels(lambda z, y, x, shape: z + y + x >= 0),
    "blocks of 32": pixels(lambda z, y, x, shape: (z // 32 + y // 32 + x // 32) % 2 == 0),
    "checkerboard": pixels(lambda z, y, x, shape: (z + y + x) % 2 == 0),
    "rings": pixels(lambda z, y, x, shape: np.sqrt(from_middle(shape)).astype(int) % 32 == 0),
    "crowded": lambda shape, random: random.integers(0, np.array(shape[::-1]) // 16, (int(np.prod(shape) / 4), len(shape))),
}


# --- programs ---


def transforms_of(mask, indices, doubles):
    """How each program is called on a mask."""
    programs = {
        "VoroCL": lambda: vorocl.distance_transform_edt(mask, return_indices=indices, float64_distances=doubles),
        "edt": lambda: edt.edt(mask, parallel=1),
        "SciPy": lambda: ndimage.distance_transform_edt(mask, return_indices=indices),
    }
    if not indices:
        programs.update(itk_of(mask))
        if mask.ndim == 2:
            programs.update(opencv_of(mask))
    return programs


def itk_of(mask):
    try:
        import SimpleITK as itk
    except ImportError:
        return {}

    def transform():
        distances = itk.SignedMaurerDistanceMapImageFilter()
        distances.SetSquaredDistance(False)
        distances.SetUseImageSpacing(False)
        distances.SetInsideIsPositive(False)
        return itk.GetArrayFromImage(distances.Execute(itk.GetImageFromArray((~mask).astype(np.uint8))))

    return {"SimpleITK": transform}


def opencv_of(mask):
    try:
        import cv2
    except ImportError:
        return {}
    return {"OpenCV": lambda: cv2.distanceTransform(mask.view(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)}


def expansions_of(mask):
    """Regions of 32 pixels a side, where the mask is zero, grow to the end."""
    z, y, x = grid(mask.shape)
    labels = np.where(mask, 0, ((z // 32 * 997 + y // 32 * 37 + x // 32) % 1000).astype(np.int32) + 1)
    labels = np.ascontiguousarray(np.broadcast_to(labels, mask.shape), np.int32)
    return {
        "VoroCL": lambda: vorocl.expand_labels(labels, distance=np.inf),
        "scikit-image": lambda: skimage.segmentation.expand_labels(labels, distance=np.inf),
        "edt": lambda: edt.edt(mask, parallel=1),
    }


def seeded_of(points, shape):
    labels = np.empty(shape, np.uint32)
    seeds = vorocl.Seeds(points + 0.5, shape, snap=True)
    diagram = vorocl.Diagram(shape)

    return {
        "from points to labels": lambda: vorocl.diagram(points + 0.5, shape, snap=True, out=labels),
        "Seeds to Diagram": lambda: diagram.fill(seeds).milliseconds,
    }


def processor_ms():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return 1000 * (used.ru_utime + used.ru_stime)


def measure(programs, options):
    """The times of each program, and its first result."""
    times, results = {name: [] for name in programs}, {}
    for round_ in range(-1, options.repeat):  # the first one builds kernels and meets new memory
        for name, work in programs.items():
            if name in SLOW and not 0 <= round_ < options.slow:
                continue
            start = processor_ms()
            made = work()
            times[name].append(processor_ms() - start)
            results.setdefault(name, made)
            del made
    return {name: taken[1:] if name not in SLOW else taken for name, taken in times.items()}, results


def same_distances(results, mask):
    """Whether distances are SciPy's bits, else the roots of the squares of edt."""
    ours = results["VoroCL"]
    ours = ours[0] if isinstance(ours, tuple) else ours
    if ours.dtype == np.float32:
        return np.allclose(ours, np.sqrt(edt.edtsq(mask, parallel=1), dtype=np.float64), rtol=3e-7, atol=0)
    if "SciPy" in results:
        theirs = results["SciPy"]
        return np.array_equal(ours, theirs[0] if isinstance(theirs, tuple) else theirs)
    return np.array_equal(ours, np.sqrt(edt.edtsq(mask, parallel=1), dtype=np.float64))


def head(title, columns):
    print(f"\n{title}\n\n| " + " | ".join(columns) + " |\n|" + " --- |" * len(columns), flush=True)


def shown(times):
    return f"{min(times):.1f} ({statistics.median(times):.1f})" if times else "-"


def ratio(ours, theirs):
    return f"{min(ours) / min(theirs):.2f} ({statistics.median(ours) / statistics.median(theirs):.2f})"


def table_of_masks(work, shape, options):
    title = "distances and indices" if work == "indices" else work
    started = False
    chosen = {**MASKS, **HARD} if options.hard else MASKS
    for name, make in chosen.items():
        if (options.masks and name not in options.masks) or (len(shape) == 2 and name in VOLUMES_ALONE):
            continue
        mask = make(shape)
        programs = expansions_of(mask) if work == "expansion" else transforms_of(mask, work == "indices", not options.float32)
        programs = {p: f for p, f in programs.items() if p == "VoroCL" or p in options.peers}
        if not started:
            against = [peer for peer in programs if peer != "VoroCL"]
            check = [] if work == "expansion" else ["same distances"]
            head(f"{title}, {'x'.join(map(str, shape))}", ["mask", "zeros %", *programs, *(f"VoroCL / {p}" for p in against), *check])
            started = True
        times, results = measure(programs, options)
        row = [name, f"{100 * np.mean(~mask):.2f}", *(shown(times[p]) for p in programs)]
        row += [ratio(times["VoroCL"], times[p]) for p in against]
        if work != "expansion":
            row.append("yes" if same_distances(results, mask) else "NO")
        print("| " + " | ".join(row) + " |", flush=True)


def table_of_seeds(shape, options):
    started = False
    for name, make in SEEDS.items():
        if options.masks and name not in options.masks:
            continue
        points = make(shape, np.random.default_rng(2))
        programs = seeded_of(points, shape)
        if not started:
            head(f"seeds at centres, {'x'.join(map(str, shape))}", ["seeds", "points", *programs])
            started = True
        times, _ = measure(programs, options)
        print(f"| {name} | {len(points):,} | " + " | ".join(shown(times[p]) for p in programs) + " |", flush=True)


def shape_of(text):
    return tuple(int(side) for side in text.split("x"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", nargs="+", default=["distances", "indices", "expansion", "seeds"], help="the tables")
    parser.add_argument("--shapes", nargs="+", type=shape_of, default=[(256,) * 3, (2048,) * 2], help="as 256x256x256")
    parser.add_argument("--masks", nargs="+", help="these alone, by name")
    parser.add_argument("--hard", action="store_true", help="masks that are made to be hard, too")
    parser.add_argument("--float32", action="store_true", help="VoroCL's distances are float32, as those of edt")
    parser.add_argument("--peers", nargs="+", default=["edt", "SimpleITK", "SciPy", "OpenCV", "scikit-image"])
    parser.add_argument("--repeat", type=int, default=5, help="rounds")
    parser.add_argument("--slow", type=int, default=1, help="rounds of SimpleITK, SciPy and scikit-image")
    options = parser.parse_args()
    for shape in options.shapes:
        for work in options.work:
            if work != "seeds":
                table_of_masks(work, shape, options)
            elif len(shape) == 2:
                table_of_seeds(shape, options)


if __name__ == "__main__":
    main()
