#!/usr/bin/env python3
"""Measures a GPU piece by piece, keeps what was found in a JSON file, and makes the tables of it: see tools/gpu_report.sh."""
import argparse
import array
import json
import math
import os
import pathlib
import random
import shutil
import subprocess
import sys
import time

PIECES = ["check", "still", "moving", "hurtful", "kernels", "cupy"]
METHODS = ["jfa", "djfa", "exact"]
PIXELS_PER_SEED = [65536, 4096, 256, 64, 16, 4]
VOXELS_PER_SEED = [4096, 512, 64, 8]
ROOT = pathlib.Path(__file__).resolve().parents[3]
LABELS = pathlib.Path(__file__).with_name("labels.json")
started = time.monotonic()


def whole_numbers(text):
    try:
        numbers = [int(part) for part in text.split(",")]
    except ValueError:
        numbers = []
    if not numbers or min(numbers) < 1:
        raise argparse.ArgumentTypeError(f"\"{text}\" is no list of whole numbers above 0, with commas between")
    return numbers


parser = argparse.ArgumentParser(prog="gpu_report.sh", description=__doc__)
parser.add_argument("--piece", default=",".join(PIECES), help="some of them, with commas between; default: all")
parser.add_argument("--out", default="output/gpu.json", help="what was found; the tables go beside it, to a .md file")
parser.add_argument("--build", help="a build's folder that is used as it is; default: build-gpu, which is built")
parser.add_argument("--sizes", type=whole_numbers, default="2048,8192,10000", help="sides in pixels; all but random seeds are of the first one, volumes of an eighth of it")
parser.add_argument("--densities", type=whole_numbers, default=PIXELS_PER_SEED, help="pixels per seed")
parser.add_argument("--frames", default=30, type=int, help="of moving seeds, after the first one; default: 30")
parser.add_argument("--milliseconds", default=300, type=float, help="that each method is measured for; 0: labels alone")
parser.add_argument("--tests", default="", help="of the core's tests those whose names hold this; default: all")
parser.add_argument("--cases", default="", help="of the other pieces those whose names hold this; default: all")
parser.add_argument("--limit", default=420, type=float, help="seconds after which nothing is begun any more; default: 420")
parser.add_argument("--write-labels", action="store_true", help=f"keep the labels' hashes in {LABELS.name}, as the right ones")
parser.add_argument("--edt", nargs=2, help=argparse.SUPPRESS)  # a run of CuPy, in a process of its own
options = parser.parse_args()


def seconds_left():
    return options.limit - (time.monotonic() - started)


def run(command):
    """The output of a command. What it says when it fails, or takes too long, is a RuntimeError."""
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=max(seconds_left(), 1) + 50)
    except subprocess.TimeoutExpired as error:
        raise RuntimeError(f"{command[0]} took longer than {error.timeout:.0f} s")
    if done.returncode != 0:
        raise RuntimeError((done.stderr or done.stdout).strip()[-2000:] or f"{command[0]} ended with {done.returncode}")
    return done.stdout


def find_driver():
    """NVIDIA's driver is often there without the file that tells OpenCL's loader of it, in containers above all."""
    vendors = pathlib.Path(os.environ.get("OCL_ICD_VENDORS", "/etc/OpenCL/vendors"))
    files = list(vendors.glob("*.icd"))
    if any("nvidia" in file.read_text() for file in files):
        return
    folders = list(filter(None, os.environ.get("LD_LIBRARY_PATH", "").split(":")))
    folders += ["/usr/local/nvidia/lib64", "/usr/lib64", "/usr/lib/x86_64-linux-gnu"]
    libraries = [path for path in (pathlib.Path(folder) / "libnvidia-opencl.so.1" for folder in folders) if path.exists()]
    if libraries:
        own = out.parent / "vendors"
        own.mkdir(exist_ok=True)
        for file in files:
            shutil.copy(file, own)
        (own / "nvidia.icd").write_text(f"{libraries[0]}\n")
        os.environ["OCL_ICD_VENDORS"] = str(own.resolve())
    elif not files:
        sys.exit(f"gpu_report.sh: there is no OpenCL driver: no .icd file in {vendors}, and libnvidia-opencl.so.1 in none of "
                 + ", ".join(folders))


def measure(*arguments):
    return json.loads(run([build / "tools/measure", *arguments]))


def edt(sides, source):
    """Prints the times of CuPy's distance transform: the indices of random seeds or those of a file, the distances of a mask."""
    import cupy
    import numpy
    from cupyx.scipy.ndimage import distance_transform_edt

    width, height, depth = sides_of(sides)
    shape = (depth, height, width) if depth > 1 else (height, width)
    is_mask = source.endswith(".mask")
    if is_mask:
        pixels = cupy.asarray(numpy.fromfile(source, bool).reshape(shape))
    else:
        x, y = cupy.load(source).astype(int).T if source.endswith(".npy") else cupy.random.randint(0, width, (2, int(source)))
        pixels = cupy.ones(shape, dtype=bool)
        pixels[y, x] = False
    times = []
    begin_all = time.monotonic()
    while time.monotonic() - begin_all < 0.2 + options.milliseconds / 1000 or len(times) < 3:
        begin, end = cupy.cuda.Event(), cupy.cuda.Event()
        wall = time.perf_counter()
        begin.record()
        found = distance_transform_edt(pixels, return_distances=is_mask, return_indices=not is_mask, float64_distances=False)
        end.record()
        end.synchronize()
        if time.monotonic() - begin_all > 0.2 or len(times) < 3:
            times.append((1000 * (time.perf_counter() - wall), cupy.cuda.get_elapsed_time(begin, end)))
    walls, events = map(sorted, zip(*times))
    middle = len(times) // 2
    print(json.dumps({"version": cupy.__version__, "runs": len(times), "wall_ms": {"median": walls[middle], "least": walls[0]},
                      "event_ms": {"median": events[middle], "least": events[0]},
                      **({"squares": int(cupy.rint(found.astype(float) ** 2).sum())} if is_mask else {})}))


# --- what is measured: the sides of grids, and numbers of random seeds or files that lie on them (see measure.cpp) ---


def sides_of(grid):
    """Three numbers, of 2048, 600x300 or 256x256x256."""
    sides = [int(side) for side in str(grid).split("x")]
    return sides * 2 + [1] if len(sides) == 1 else (sides + [1])[:3]


def random_points(sides, share):
    rng = random.Random(1)
    return array.array("d", (side * rng.random() for _ in range(math.prod(sides) // share) for side in sides))


def ring(sides, count):
    turns = (2 * math.pi * i / count for i in range(count))
    return array.array("d", (sides[0] * x for turn in turns for x in (0.5 + 0.45 * math.cos(turn), 0.5 + 0.45 * math.sin(turn), 0)))


def cities(sides):
    lines = (ROOT / "samples/cities-5000.csv").read_text().splitlines()[1:]
    degrees = (map(float, line.split(",")) for line in lines)
    return array.array("d", (x for lon, lat in degrees for x in ((180 + lon) / 360 * sides[0], (90 - lat) / 180 * sides[1], 0)))


def noise(sides, share):
    """A mask with a zero in one pixel of so many."""
    rng = random.Random(1)
    mask = bytearray(b"\1") * math.prod(sides)
    for _ in range(-(-len(mask) // share)):
        mask[int(len(mask) * rng.random())] = 0
    return mask


def near(middle, squared, end):
    """What is from 0 to `end`, and no farther from the middle than so much, squared."""
    way = math.isqrt(squared)
    return range(max(middle - way, 0), min(middle + way + 1, end))


def balls(sides):
    """A mask with zeros in 40 balls that overlap, with radii of 2 to 10 % of the width."""
    rng = random.Random(1)
    width, height, depth = sides
    mask = bytearray(b"\1") * math.prod(sides)
    for _ in range(40):
        x, y, z = (int(side * rng.random()) for side in sides)
        radius = int(width * (0.02 + 0.08 * rng.random()))
        for k in near(z, radius ** 2, depth):
            for j in near(y, radius ** 2 - (k - z) ** 2, height):
                row, begin = near(x, radius ** 2 - (k - z) ** 2 - (j - y) ** 2, width), width * (j + height * k)
                mask[begin + row.start:begin + row.stop] = bytes(len(row))
    return mask


def made(grid, name, make, *arguments):
    """A grid and the file of this name that lies on it, which is made if it is not there."""
    path = out.parent / f"sources-{grid}" / name
    if not path.exists():
        path.parent.mkdir(exist_ok=True)
        path.with_suffix(".part").write_bytes(make(sides_of(grid), *arguments))
        path.with_suffix(".part").rename(path)
    return grid, path


def points(grid, shares):
    counts = {share: math.prod(sides_of(grid)) // share for share in shares}
    return [made(grid, f"points-{count}.points", random_points, share) for share, count in counts.items() if count > 0]


def hurtful_sets():
    folder = out.parent / f"sets-{sides[0]}"
    if not folder.exists():
        part = folder.with_suffix(".part")
        run([sys.executable, ROOT / "docs/hurtful_sets.py", part, sides[0]])
        part.rename(folder)
    return [(sides[0], path) for path in sorted(folder.glob("*.npy"))]


def sources_of(piece):
    side, volume = sides[0], "x".join([str(max(sides[0] // 8, 1))] * 3)
    centres = [(side, side * side // share) for side in (sides[:1] if piece == "kernels" else sides)
               for share in options.densities if side * side >= share]
    if piece == "hurtful":
        return hurtful_sets()
    if piece == "moving":
        return centres + points(side, options.densities)
    masks = [made(grid, *arguments) for grid in (side, volume)
             for arguments in (("noise-64.mask", noise, 64), ("noise-4096.mask", noise, 4096), ("balls.mask", balls))]
    if piece == "cupy":
        return masks + centres + hurtful_sets()
    crowds = [made("600x300", "cities.points", cities), made(side, "ring-65536.points", ring, 65536)]
    return centres + points(side, options.densities) + crowds + points(volume, VOXELS_PER_SEED) + masks


# --- the cases of each piece: their names, and functions that find a dictionary ---


def core_tests():
    for path in sorted((build / "tests/core").glob("test_*")):
        if path.is_file() and os.access(path, os.X_OK) and options.tests in path.name:
            yield path.name, lambda path=path: {"output": run([path]).strip()[-200:]}


def cases_of(piece):
    ms = options.milliseconds
    if piece == "check":
        if not options.build:
            run(["cmake", "--build", build])
        yield "known diagrams", lambda: measure("check")
        yield from core_tests()
        return
    if piece == "cupy":
        run([sys.executable, "-c", "import cupy"])
    more = [options.frames] if piece == "moving" else []
    for grid, source in sources_of(piece):
        name = " ".join(map(str, [grid, pathlib.Path(str(source)).stem, *more]))
        command = [build / "tools/measure", "still" if piece == "hurtful" else piece, grid, source, ms, *more]
        if piece == "cupy":
            command = [sys.executable, __file__, "--milliseconds", ms, "--edt", grid, source]
        if options.cases in name:
            yield name, lambda command=command: json.loads(run(command))


def measure_piece(piece):
    """Finds what is not known yet, and then again what failed. Returns whether nothing is left to do."""
    found = results.setdefault(piece, {})
    try:
        cases = dict(cases_of(piece))
    except RuntimeError as error:
        found["preparation"] = {"error": str(error)}
        print(f"{piece}: {error}", flush=True)
        return True
    found.pop("preparation", None)
    unknown = [name for name in cases if name not in found]
    failed = [name for name in cases if "error" in found.get(name, {})]
    for name in unknown + failed:
        if seconds_left() <= 0:
            print(f"{piece}: there is more to do; run it again", flush=True)
            return False
        try:
            found[name] = cases[name]()
        except RuntimeError as error:
            found[name] = {"error": str(error)}
        save()
        print(f"{piece}: {name}: {found[name].get('error', 'done')}", flush=True)
    return True


# --- labels ---


def verdict(piece, name, found):
    squares = results.get("cupy", {}).get(name, {}).get("squares") if piece == "still" else None
    if squares is not None and squares != found["methods"]["exact"].get("squares"):
        return "WRONG: CuPy has other distances"
    right = right_labels["labels"].get(f"{piece} {name}")
    if right is None:
        return "not compared"
    if right["seeds"] != found["seeds"]:
        return "not compared: the seeds are others"
    methods = {method: of_method["labels"] for method, of_method in found["methods"].items()}
    wrong = [method for method in METHODS if method in right and right[method] != methods.get(method)]
    unknown = [method for method in METHODS if method in methods and method not in right]
    known = "WRONG: " + ", ".join(wrong) if wrong else "right"
    return known + (f" (not compared: {', '.join(unknown)})" if unknown else "")


def write_labels():
    for piece in ("still", "moving", "hurtful"):
        for name, found in results.get(piece, {}).items():
            if "methods" in found:
                hashes = {method: found["methods"][method]["labels"] for method in METHODS if method in found["methods"]}
                right_labels["labels"][f"{piece} {name}"] = {"seeds": found["seeds"], **hashes}
    LABELS.write_text(json.dumps(right_labels, indent=1) + "\n")


# --- the tables ---


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def times(found):
    """Wall and event time in one cell, in milliseconds."""
    if "wall_ms" not in found:
        return found.get("error", "-").splitlines()[-1]
    return f"{found['wall_ms']['median']:.3f} / {found['event_ms']['median']:.3f}"


def rows_of_times(piece):
    for name, found in results[piece].items():
        if "methods" not in found:
            yield [name, *["-"] * len(METHODS), "-", "-", "-", found["error"].splitlines()[-1]]
            continue
        methods = found["methods"]
        wrong = ", ".join(str(methods.get(method, {}).get("wrong_pixels", "-")) for method in METHODS)
        cupy = results.get("cupy", {}).get(name, {})
        yield [name, found["seed_count"], *(times(methods.get(method, {})) for method in METHODS), times(cupy), wrong,
               verdict(piece, name, found)]


def tables():
    device = results["device"]
    yield f"# Measured on {device['device']}\n"
    yield (f"Driver {device['driver']}, {device['compute_units']} compute units at {device['megahertz']} MHz; "
           f"VoroCL {results['commit']}; {results['date']}.")
    yield ("Times are medians in milliseconds, on the wall / by the device's events, after 200 ms to warm up. Edt is CuPy's "
           "distance transform: indices of seeds, distances of masks. A case is a grid and what lies on it: a number of random "
           "seeds at centres of pixels or a hurtful set, points (points-N, cities, ring), which JFA snaps, or a mask (noise, balls), "
           "whose distances of float32 stand as exact.")
    titles = {"still": "Seeds that stand still, and masks", "hurtful": "Sets made to hurt (docs/hurtful_sets.py)",
              "moving": "Seeds that move by up to a pixel along each axis and frame: per frame from frame 1 on, on the wall with "
                        "the motion. That of points is a buffer of the device. The last number of a case is that of its frames"}
    for piece, title in titles.items():
        if results.get(piece):
            yield f"\n{title}.\n"
            yield table(["case", "seeds", *METHODS, "edt", "wrong pixels", "labels"], rows_of_times(piece))
    if results.get("kernels"):
        yield "\nKernels: microseconds of each launch by its events, medians.\n"
        rows = [[name, method, launch["kernel"], launch["items"], launch["group"], f"{launch['median_us']:.1f}"]
                for name, found in results["kernels"].items() for method in METHODS if "methods" in found
                for launch in found["methods"].get(method, [])]
        yield table(["case", "method", "kernel", "items", "group", "us"], rows)
    if results.get("check"):
        known = results["check"].get("known diagrams", {})
        wrong = known.get("wrong", [])
        yield f"\nOf {known.get('checked', 0)} known diagrams {len(wrong)} are wrong: {'; '.join(wrong) or 'none'}.\n"
        yield table(["test", "result"], [[name, found.get("error", "passed").splitlines()[-1]]
                                         for name, found in results["check"].items() if name != "known diagrams"])
    errors = [(piece, found["preparation"]["error"]) for piece, found in results.items()
              if piece in PIECES and "preparation" in found]
    for piece, error in errors:
        yield f"\nNothing of {piece}: {error.splitlines()[-1]}"


def failures():
    """What was found wrong, or failed."""
    for piece in PIECES:
        for name, found in results.get(piece, {}).items():
            if "error" in found and piece != "cupy":
                yield f"{piece}: {name}: {found['error'].splitlines()[-1]}"
            for answer in found.get("wrong", []):
                yield f"{piece}: wrong: {answer}"
            if "seeds" in found and verdict(piece, name, found).startswith("WRONG"):
                yield f"{piece}: {name}: {verdict(piece, name, found)}"


def save():
    out.with_suffix(".part").write_text(json.dumps(results, indent=1) + "\n")
    out.with_suffix(".part").rename(out)


def commit():
    try:
        return run(["git", "-C", ROOT, "describe", "--always", "--dirty"]).strip()
    except (RuntimeError, FileNotFoundError):
        note = pathlib.Path(os.environ.get("VOROCL_GPU_FOLDER", "")) / "commit"
        return note.read_text().strip() if note.is_file() else "of an unknown commit"


if options.edt:
    edt(*options.edt)
    sys.exit()
pieces = options.piece.split(",")
for piece in pieces:
    if piece not in PIECES:
        parser.error(f"there is no piece {piece}, but {', '.join(PIECES)}")
sides = options.sizes
out = pathlib.Path(options.out)
out.parent.mkdir(parents=True, exist_ok=True)
build = pathlib.Path(options.build or ROOT / "build-gpu").resolve()
if options.build and not (build / "tools" / "measure").exists():
    parser.error(f"--build {options.build}: there is no tools/measure; leave --build out to have it built")
right_labels = json.loads(LABELS.read_text())
results = json.loads(out.read_text()) if out.exists() else {}
find_driver()
try:
    if not options.build:
        run(["cmake", "--preset", "core", "-S", ROOT, "-B", build])
        run(["cmake", "--build", build, "--target", "measure"])
    device = measure("device")
except RuntimeError as error:
    sys.exit(f"gpu_report.sh: {error}")
if any(results.get("device", device)[key] != device[key] for key in ("device", "driver")):  # a driver may tell another memory each time
    sys.exit(f"gpu_report.sh: {out} is of {results['device']['device']} with driver {results['device']['driver']}; "
             "give another --out, or remove it")
results.update({"device": device, "commit": commit(), "date": time.strftime("%Y-%m-%d"), "command": sys.argv[1:]})
is_done = all([measure_piece(piece) for piece in pieces])
save()
if options.write_labels:
    write_labels()
report = "\n".join(tables()) + "\n"
out.with_suffix(".md").write_text(report)
print(report)
wrong = list(failures())
print("\n".join(wrong), file=sys.stderr)
sys.exit(1 if wrong else 0 if is_done else 3)
