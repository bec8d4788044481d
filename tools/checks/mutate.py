#!/usr/bin/env python3
"""Plants mistakes in the sources, one at a time, and runs the tests that are to notice them.

A mistake ("mutant") changes one operator, number or word of a line. Which ones there are follows from the sources
alone; N of them are taken, spread over the files, and --first goes on behind those that were tried before.
kernels: the tests of BUILD read them from a copy of the folder (VOROCL_KERNEL_DIR), so that nothing is built; a mutant
that they pass runs under Oclgrind, too. host: each mutant is built in a copy of the project.

A mutant is killed by a test that fails or takes more than LIMIT seconds, or by the compiler; or it survives. Prints a
line for each, as of a CSV file. BUILD, by default build, is one whose tests pass, with -DCMAKE_UNITY_BUILD=OFF: each
test is a program then.
"""
import argparse
import csv
import fnmatch
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
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

# Of a file those of the first pattern that it matches: a folder of tests, and which of its programs are to notice mistakes.
FLOODING = "jump_flooding standard_flooding dynamic_jump_flooding low_resolution any_motion"
MEASURES = "c_api_measures similarity window_measures fields cells relaxation adjacency distance_errors cell_table true_measures"
TESTS = [
    ("kernels/exact/*", "core", "group_shape window exact_diagram volume_points"), ("kernels/flooding/*", "core", FLOODING),
    ("kernels/core/axis.cl", "core", "place"), ("kernels/core/place.cl", "core", "place point_buffers"),
    ("kernels/core/p*", "core", f"window seeds motion place {FLOODING} {MEASURES}"),
    ("kernels/core/*", "core", f"seeds displacement point_buffers tiles {FLOODING} {MEASURES}"),
    ("kernels/motion/*", "core", "motion seeds"), ("kernels/exact_cells/*", "core", "exact_cells exact_volumes"),
    ("kernels/masks/*", "core", "distance_transform"),
    ("kernels/*", "core", MEASURES),
    ("src/flooding/*plan.cpp", "core", "plan"), ("src/core/grid.cpp", "core", "axis grid plan"),
    ("src/core/*.cpp", "core", "axis seeds tiles displacement point_buffers window window_measures"),
    ("src/picture/*.cpp", "picture", "colors color_bar picture"),
    ("tools/formats/*.cpp", "formats", "points label_files vtk trajectory trajectory_errors xyz plane_files png"),
    ("tools/app/sources/*.cpp", "app", "bounds boxes particle_slots periodic_step simulate_trajectory"),
]


def tests_of(name):
    folder, stems = next(((folder, stems) for pattern, folder, stems in TESTS if fnmatch.fnmatch(name, pattern)), ("", ""))
    return [f"tests/{folder}/test_{stem}" for stem in stems.split()]


def code_of(text):
    """The text with all that is no code blanked out, at the same places."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    text = re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"", blank, text, flags=re.S)
    text = re.sub(r"^ *#(?!define)[^\n]*", blank, text, flags=re.M)
    return re.sub(r"^#define \w+(\([^)]*\))?", blank, text, flags=re.M)


def mutants_of(name, text):
    """All of a file: its name, the place, what stands there and what is to."""
    for pattern, by in OPERATORS:
        for match in re.finditer(pattern, code_of(text)):
            old = match.group(1)
            yield name, match.start(1), old, str(int(old) + 1) if by is None else by


def spread(files, folder):
    """The mutants of all files in turn, in an order that does not change."""
    rng = random.Random(1)
    queues = [list(mutants_of(name, (folder / name).read_text())) for name in files]
    for queue in queues:
        rng.shuffle(queue)
    while any(queues):
        for queue in filter(None, queues):
            yield queue.pop()


def fails(command, limit=None, **where):
    try:
        return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=limit, **where).returncode != 0
    except subprocess.TimeoutExpired:
        return True


def build_command(build, names):
    targets = {Path(test).name for name in names for test in tests_of(name)}
    return ["cmake", "--build", build, "--target", "vorocl_tool", *sorted(targets)]


def copy_project(folder, listed, names):
    """With all that the tests of these files need, built."""
    for name in listed:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, folder / name)
    os.environ.update(CCACHE_BASEDIR=str(folder), CCACHE_NOHASHDIR="1")
    ccache = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    configure = ["cmake", "--preset", "release", "-DVOROCL_BUILD_TESTS=ON", "-DVOROCL_WARNINGS_AS_ERRORS=ON",
                 "-DCMAKE_UNITY_BUILD=OFF", "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON", *ccache]
    for command in configure, build_command("build", names):
        subprocess.run(command, check=True, cwd=folder, stdout=subprocess.DEVNULL)


def killer_of(name, options, build, folder):
    """What notices the mutant in a file; empty if nothing does."""
    if options.what == "host" and fails(build_command(build, [name])):
        return "the compiler"
    for test in tests_of(name):
        if fails([build / test], options.limit, cwd=folder):
            return Path(test).name
    check = [ROOT / "tools/checks/kernels.sh", build / "tests/core/run_kernels"]
    return "Oclgrind" if options.what == "kernels" and fails(check, options.limit) else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["kernels", "host"])
    parser.add_argument("--count", type=int, default=100, metavar="N", help="how many mutants; default: 100")
    parser.add_argument("--first", type=int, default=0, metavar="I")
    parser.add_argument("--build", type=Path, default=ROOT / "build")
    parser.add_argument("--limit", type=float, default=900)
    options = parser.parse_args()
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split()
    with tempfile.TemporaryDirectory(prefix="vorocl-mutants-") as work:
        folder, build = Path(work), options.build.resolve()
        os.environ.setdefault("POCL_CACHE_DIR", f"{work}/cache")
        of_kernels = options.what == "kernels"
        programs = {f"tests/{folder}/test_{stem}" for _, folder, stems in TESTS for stem in stems.split()}
        if of_kernels and not all((build / program).exists() for program in programs):
            parser.error(f"{build} has no program for each test: configure it with -DCMAKE_UNITY_BUILD=OFF")
        # Sizes of lists are knobs, which change no result.
        files = [name for name in listed if tests_of(name) and name.startswith("kernels/") == of_kernels and "sizes" not in name]
        if of_kernels:
            shutil.copytree(ROOT / "kernels", folder / "kernels")
            os.environ["VOROCL_KERNEL_DIR"] = f"{work}/kernels"
        else:
            copy_project(folder, listed, files)
            build = folder / "build"
        survivors, report = 0, csv.writer(sys.stdout)
        mutants = list(spread(files, folder))[options.first:options.first + options.count]
        for number, (name, place, old, new) in enumerate(mutants, options.first):
            text = (folder / name).read_text()
            (folder / name).write_text(text[:place] + new + text[place + len(old):])
            killer = killer_of(name, options, build, folder)
            line = text.count("\n", 0, place)
            report.writerow([number, name, line + 1, old, new, killer or "SURVIVES", text.splitlines()[line].strip()])
            sys.stdout.flush()
            (folder / name).write_text(text)
            survivors += not killer
        print(f"{len(mutants)} mutants, {len(mutants) - survivors} killed, {survivors} survive")


if __name__ == "__main__":
    main()
