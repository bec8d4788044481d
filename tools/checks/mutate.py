#!/usr/bin/env python3
"""Plants mistakes in the sources, one at a time, and runs the tests that are to notice them.

    mutate.py kernels|host [--count N] [--first I] [--build BUILD] [--limit LIMIT] [--report FILE]

A mistake ("mutant") changes one operator, number or word of a line. Which ones there are follows from the sources
alone; N of them are taken, spread over the files, and --first goes on behind those that were tried before.
kernels: the tests read them from a copy of the folder (VOROCL_KERNEL_DIR), so that nothing is built; a mutant that
the tests pass runs under Oclgrind, too. host: each mutant is built in a copy of the project.

A mutant is killed by a test that fails, crashes, or takes more than LIMIT seconds; by the compiler; or it survives.
Prints a line for each, and appends it to the report, a CSV file. BUILD, by default build/, is one whose tests pass.
"""
import argparse
import csv
import fnmatch
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# What is replaced: a pattern, and what takes the place of its group.
OPERATORS = [
    (r" (<) ", "<="), (r" (<=) ", "<"), (r" (>) ", ">="), (r" (>=) ", ">"), (r" (==) ", "!="), (r" (!=) ", "=="),
    (r" (&&) ", "||"), (r" (\|\|) ", "&&"), (r" (\+) ", "-"), (r" (-) ", "+"), (r" (\*) ", "+"), (r" (/) ", "*"),
    (r" (%) ", "+"), (r" (&) ", "|"), (r" (\|) ", "&"), (r" (<<) ", ">>"), (r" (>>) ", "<<"), (r" (\+=) ", "-="),
    (r"(\+\+)", "--"), (r"\b(min)\(", "max"), (r"\b(max)\(", "min"), (r"[( ](!)[a-z(]", ""),
    (r"(?<![\w.'\"])(\d+)(?![\w.'\"])", None),  # one more
    (r"\b(true)\b", "false"), (r"\b(false)\b", "true"), (r"\b(continue);", "break"),
    (r"(?<!int )\b(width)\b", "height"), (r"(?<!int )\b(height)\b", "width"),
]

# By kernel file, the first that matches: programs of tests/core/ and their arguments, the quickest first; "check" is
# `vorocl devices --check`.
GROUP = ["test_group_shape", "test_exact_diagram --run_test=random*,lowest*,frame* -- group"]
EXACT = ["check", "test_window", "test_exact_diagram --run_test=random*,lowest*,frame*"]
FLOODING = ["check", "test_jump_flooding", "test_standard_flooding", "test_dynamic_jump_flooding",
            "test_low_resolution"]
MEASURES = ["test_c_api_measures", "test_similarity", "test_window_measures", "test_fields", "test_cells",
            "test_relaxation", "test_adjacency", "test_distance_errors", "test_cell_table", "test_diagram_memory",
            "test_volume_cells"]
KERNEL_TESTS = [
    ("exact/group/*", GROUP), ("exact/*", EXACT),
    ("flooding/dynamic_jump_flooding.cl", FLOODING + ["test_any_motion"]), ("flooding/*", FLOODING),
    ("core/position.cl", FLOODING + ["test_window"] + MEASURES),
    ("core/vector.cl", FLOODING + MEASURES), ("core/seeds.cl", FLOODING + ["test_seeds", "test_method", "test_displacement", "test_point_buffers"]),
    ("core/axis.cl", ["test_place"]), ("core/place.cl", ["test_place", "test_point_buffers"]),
    ("core/philox.cl", ["test_seeds", "test_motion"]), ("motion/motion.cl", ["test_motion", "test_seeds"]),
    ("core/plane.cl", ["test_window", "test_window_measures"]),
    ("measures/seed_place.cl", ["test_window_measures"] + MEASURES),
    ("core/tiles.cl", ["test_tiles"]),
    ("measures/shapes.cl", ["test_true_measures", "test_tilted_grids"] + MEASURES),
    ("measures/home.cl", ["test_true_measures"] + MEASURES),
    ("measures/pair_table.cl", ["test_adjacency", "test_volume_cells"]),
    ("measures/adjacency.cl", ["test_c_api_measures", "test_window_measures", "test_adjacency", "test_volume_cells"]), ("measures/runs.cl", MEASURES),
    ("measures/vertices.cl", ["test_c_api_measures", "test_window_measures", "test_adjacency"]), ("*", MEASURES),
]

# By source: names of tests.
HOST_TESTS = [
    ("src/flooding/*plan.cpp", ["plan"]), ("src/core/grid.cpp", ["axis", "grid", "plan"]),
    ("src/core/snapping.hpp", ["axis", "seeds", "tiles"]), ("src/core/seeds*.cpp", ["seeds", "displacement", "point_buffers"]),
    ("src/core/placement.cpp", ["window", "seeds"]), ("tools/app/sources/placed_axis.cpp", ["bounds", "boxes"]),
    ("src/picture/palette.cpp", ["colors", "color_bar", "painter"]), ("src/picture/picture.cpp", ["colors", "picture"]),
    ("src/picture/color_bar.cpp", ["color_bar"]), ("src/core/outer_seeds.cpp", ["window", "window_measures"]),
    ("tools/formats/csv.cpp", ["points"]), ("tools/formats/npy.cpp", ["points", "label_files"]),
    ("tools/formats/tiff.cpp", ["label_files", "large_claims"]), ("tools/formats/vtk.cpp", ["vtk"]),
    ("tools/formats/numbered_files.cpp", ["output_files", "simulate_files"]),
    ("tools/formats/output_file.cpp", ["written_files", "resume_tiles"]),
    ("tools/formats/images/image_header.cpp", ["large_claims"]),
    ("tools/formats/trajectory/*.cpp", ["trajectory", "trajectory_errors", "xyz"]),
    ("tools/app/outputs/tile_journal.cpp", ["resume_tiles"]),
    ("tools/app/sources/particles.cpp", ["particle_slots", "periodic_step", "simulate_trajectory"]),
    ("tools/app/sources/bounds.cpp", ["bounds"]),
]


def code_of(text):
    """The text with all that is no code blanked out, at the same places."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    text = re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"", blank, text, flags=re.S)
    text = re.sub(r"^ *#(?!define)[^\n]*", blank, text, flags=re.M)
    return re.sub(r"^#define \w+(\([^)]*\))?", blank, text, flags=re.M)


def mutants_of(name, text):
    """All of a file: its name, the place, what stands there and what is to."""
    found = []
    for pattern, by in OPERATORS:
        for match in re.finditer(pattern, code_of(text)):
            old = match.group(1)
            found.append((name, match.start(1), old, str(int(old) + 1) if by is None else by))
    return found


def spread(files, folder):
    """The mutants of all files in turn, in an order that does not change."""
    rng = random.Random(1)
    queues = []
    for name in files:
        mutants = mutants_of(name, (folder / name).read_text())
        rng.shuffle(mutants)
        queues.append(mutants)
    while any(queues):
        for queue in queues:
            if queue:
                yield queue.pop()


def mutated(text, mutant):
    _, place, old, new = mutant
    return text[:place] + new + text[place + len(old):]


def line_of(text, place):
    """Its number, and what it says."""
    number = text.count("\n", 0, place) + 1
    return number, text.splitlines()[number - 1].strip()


def failure(command, cwd, environment, limit):
    """How a program ends that is stopped when a test fails, or after so many seconds; empty if all is well."""
    begin = time.monotonic()
    with tempfile.TemporaryFile("w+") as output:
        process = subprocess.Popen(command, cwd=cwd, env=environment, stdout=output, stderr=subprocess.STDOUT,
                                   start_new_session=True)
        text = ""
        while process.poll() is None and time.monotonic() - begin < limit and "error: in " not in text:
            time.sleep(0.05)
            output.seek(0)
            text = output.read()
        ended = process.poll()
        if ended is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        output.seek(0)
        text = output.read()
    if "error: in " in text or (ended or 0) > 0:
        return "fails"
    if ended is None:
        return "takes too long"
    return "crashes" if ended < 0 else ""


def first_that(patterns, name):
    return next((tests for pattern, tests in patterns if fnmatch.fnmatch(name, pattern)), None)


class Kernels:
    def __init__(self, build, work, limit):
        self.build, self.folder, self.limit = build, work / "kernels", limit
        shutil.copytree(ROOT / "kernels", self.folder)
        # Sizes of lists are knobs, which change no result.
        self.files = sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*.cl")
                            if path.stem != "sizes")
        self.environment = dict(os.environ, VOROCL_KERNEL_DIR=str(self.folder))

    def command(self, test):
        if test == "check":
            return [str(self.build / "tools/vorocl"), "devices", "--check"]
        program, *arguments = test.split()
        return [str(self.build / "tests/core" / program), *arguments]

    def verdict(self, name, work):
        for test in first_that(KERNEL_TESTS, name):
            how = failure(self.command(test), work, self.environment, self.limit)
            if how:
                return f"{test} {how}"
        check = [str(ROOT / "tools/checks/kernels.sh"), str(self.build / "tests/core/run_kernels")]
        return "Oclgrind" if failure(check, work, self.environment, self.limit) else ""


class Host:
    def __init__(self, build, work, limit):
        del build
        self.folder, self.limit = work / "copy", limit
        tracked = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True)
        for name in tracked.stdout.split("\n")[:-1]:
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.folder / name)
        self.files = [name for name in tracked.stdout.split("\n") if first_that(HOST_TESTS, name)]
        self.environment = dict(os.environ, CCACHE_BASEDIR=str(self.folder), CCACHE_NOHASHDIR="1")
        ccache = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        subprocess.run(["cmake", "--preset", "release", "-DVOROCL_WARNINGS_AS_ERRORS=ON",
                        "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON", *ccache], check=True, cwd=self.folder,
                       env=self.environment, stdout=subprocess.DEVNULL)
        for tests in sorted({tuple(tests) for _, tests in HOST_TESTS}):
            if not self.builds(tests):
                sys.exit(f"{', '.join(tests)} cannot be built without a mutant")

    def builds(self, tests):
        targets = ["vorocl_tool", *(f"test_{test}" for test in tests)]
        if "resume_tiles" in tests:
            targets.append("vorocl_faults")
        return subprocess.run(["cmake", "--build", "build", "--target", *targets], cwd=self.folder,
                              env=self.environment, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0

    def ctest(self, tests):
        return ["ctest", "--test-dir", "build", "--stop-on-failure", "-R", f"^({'|'.join(tests)})$"]

    def verdict(self, name, work):
        del work
        tests = first_that(HOST_TESTS, name)
        if not self.builds(tests):
            return "the compiler"
        how = failure(self.ctest(tests), self.folder, self.environment, self.limit)
        return f"{'|'.join(tests)} {how}" if how else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["kernels", "host"])
    parser.add_argument("--count", type=int, help="mutants; default 100 of kernels, 50 of the host")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("--limit", type=float, default=900)
    parser.add_argument("--report", type=Path)
    options = parser.parse_args()
    count = options.count or {"kernels": 100, "host": 50}[options.what]
    with tempfile.TemporaryDirectory(prefix="vorocl-mutants-") as folder:
        work = Path(folder)
        os.environ.setdefault("POCL_CACHE_DIR", str(work / "cache"))
        subject = {"kernels": Kernels, "host": Host}[options.what](options.build.resolve(), work, options.limit)
        mutants = list(spread(subject.files, subject.folder))[options.first:options.first + count]
        survivors = 0
        for number, mutant in enumerate(mutants, options.first):
            name, place, old, new = mutant
            path = subject.folder / name
            text = path.read_text()
            path.write_text(mutated(text, mutant))
            killer = subject.verdict(name, work)
            path.write_text(text)
            survivors += not killer
            row = [number, name, line_of(text, place)[0], old, new, killer or "SURVIVES",
                   line_of(mutated(text, mutant), place)[1]]
            print(*row, sep="  ", flush=True)
            if options.report:
                with options.report.open("a", newline="") as report:
                    csv.writer(report).writerow(row)
        print(f"{len(mutants)} mutants, {len(mutants) - survivors} killed, {survivors} survive")


if __name__ == "__main__":
    main()
