#!/usr/bin/env python3
"""The paper's experiment on seeds that move at random, and the ablation that it lacks: how near JFA and dJFA come to the exact
diagram, and how long each method takes. Each row is of runs of `vorocl simulate --json`, whose device VOROCL_DEVICE names.

evaluate: JFA, dJFA and the exact method, in both metrics, for each grid and each number of seeds.
ablation: dJFA with one choice changed at a time, by the Euclidean distance: its waves, its refresh, the seeds' motion and spread.

The table is a .csv file that grows with each grid and number of seeds. Of an ended run, --resume keeps those that are complete.
"""

import argparse
import csv
import datetime
import json
import math
import os
import random
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

PAPER = ("--reach", "paper")  # not the library's own plan
METHODS = [(method, metric) for metric in ("euclidean", "manhattan") for method in ("jfa", "djfa", "exact")]
EUCLIDEAN_JFA = METHODS[0]


class StudyError(Exception):
    """What is wrong, in one line."""


def mean_and(which, name, result):
    return {f"{name}_mean": result["mean"], f"{name}_{which}": result[which]}


def times_of(runs):
    """Milliseconds of the device for all frames of a timed run."""
    values = [run["milliseconds"] for run in runs]
    return dict(zip(("median", "least", "greatest"), (statistics.median(values), min(values), max(values))))


def errors_of(run):
    """Against the exact diagram of the metric."""
    names = "wrong_percent_mean", "wrong_percent_greatest", "largest_excess", "mean_excess"
    return {name: run["errors"][name] for name in names}


class Study:
    def __init__(self, options):
        self.options, self.command = options, options.vorocl
        selected = [device for device in self.run("devices")["devices"] if device["selected"]]
        if not selected:
            raise StudyError("there is no usable OpenCL device: see vorocl devices")
        version = subprocess.run([self.command, "--version"], check=True, capture_output=True, text=True).stdout.split()[-1]
        self.origin = {"version": version, "platform": selected[0]["platform"], "device": selected[0]["name"],
                       "driver": selected[0]["driver_version"]}
        for name in "rng_seed", "step_length", "frames", "timed_frames", "repeats":
            self.origin[name] = getattr(options, name)

    def run(self, *arguments):
        try:
            done = subprocess.run([self.command, *map(str, arguments), "--json"], capture_output=True, text=True, check=False)
        except OSError as error:
            raise StudyError(f"cannot run {self.command}: {error.strerror}; build it, or give --vorocl") from error
        if done.returncode != 0:
            raise StudyError((done.stderr.strip().splitlines() or [f"{self.command} failed"])[-1])
        return json.loads(done.stdout)

    def simulate(self, n, seeds, frames, method, *arguments, step_length=None, points=None):
        """A run of a method, (name, metric), with its own options behind it; `points` are where the seeds begin."""
        source = ["--random", seeds] if points is None else ["--points", points, "--bounds", f"0,0,{n},{n}", "--snap"]
        step_length = self.options.step_length if step_length is None else step_length
        plan = PAPER if method[0] == "djfa" else ()
        return self.run("simulate", *source, "--size", f"{n}x{n}", "--rng-seed", self.options.rng_seed, "--frames", frames,
                        "--step-length", step_length, "--method", method[0], "--metric", method[1], *plan, *arguments)

    def timed(self, all_arguments):
        """Runs of each, in turn, without another method beside them."""
        runs = [[] for _ in all_arguments]
        for _ in range(self.options.repeats):
            for found, (arguments, named) in zip(runs, all_arguments):
                found.append(self.simulate(*arguments, **named))
        return runs


def evaluate(study, n, seeds):
    """The rows of the paper's experiment."""
    found = {}

    def against(method, other):
        """The run that compares two: dJFA with the other, for it has a plan of its own, and all with the exact method."""
        pair = tuple(sorted((method, other), key=lambda one: ("djfa", "jfa", "exact").index(one[0])))
        if pair not in found:
            found[pair] = study.simulate(n, seeds, study.options.frames, pair[0], "--compare-with", pair[1][0],
                                         "--compare-metric", pair[1][1])
        return found[pair]

    def similarity(method, other):
        return {"mean": 100, "least": 100} if method == other else against(method, other)["similarity"]

    runs = study.timed([((n, seeds, study.options.timed_frames, method), {}) for method in METHODS])
    times = {method: times_of(timed) for method, timed in zip(METHODS, runs)}
    with tempfile.TemporaryDirectory() as folder:  # seeds on a pixel that another one has
        coincident = study.run("cells", "--random", seeds, "--size", f"{n}x{n}", "--rng-seed", study.options.rng_seed,
                               "--cells", os.path.join(folder, "cells.csv"), "--cell-columns", "id")["empty_cells"]
    for method, timed in zip(METHODS, runs):
        exact, median = ("exact", method[1]), times[method]["median"]
        errors = dict.fromkeys(("wrong_percent_mean", "wrong_percent_greatest", "largest_excess", "mean_excess"), 0)
        yield {
            "n": n, "seeds": seeds, "pixels_per_seed": n * n / seeds, "coincident_seeds": coincident,
            "method": method[0], "metric": method[1], "waves": timed[0]["waves"],
            **{f"milliseconds_{name}": value for name, value in times[method].items()},
            "host_milliseconds_median": statistics.median(run["host_milliseconds"] for run in timed),
            "speedup_over_jfa": times[EUCLIDEAN_JFA]["median"] / median,
            "speedup_over_djfae": times["djfa", "euclidean"]["median"] / median,
            **mean_and("least", "similarity_to_euclidean_jfa", similarity(method, EUCLIDEAN_JFA)),
            **mean_and("least", "similarity_to_jfa", similarity(method, ("jfa", method[1]))),
            **mean_and("least", "similarity_to_exact", similarity(method, exact)),
            **(errors if method == exact else errors_of(against(method, exact))),
        }


def spread_points(path, spread, n, seeds, rng_seed):
    """Pixels of a grid: clusters, normally distributed about 16 centres with a fiftieth of the side as deviation, or a
    gradient, whose density grows in proportion to x."""
    draw = random.Random(rng_seed)
    centres = [(draw.random(), draw.random()) for _ in range(16)]
    with open(path, "w", encoding="utf-8") as file:
        file.write("x,y\n")
        for i in range(seeds):
            point = [math.sqrt(draw.random()), draw.random()]
            if spread == "clusters":
                point = [draw.gauss(centre, 1 / 50) for centre in centres[i % 16]]
            file.write(",".join(str(min(max(math.floor(value * n), 0), n - 1) + 0.5) for value in point) + "\n")


def variants(n, seeds, options, folder):
    """Each (study, setting, method, options of the method, named arguments of simulate())."""
    for method in "jfa", "djfa", "exact":
        yield "method", method, method, (), {}
    for waves in 0, 1, 2:
        yield "von Neumann waves", waves, "djfa", ("--von-neumann-waves", waves), {}
    yield "von Neumann waves", "all", "djfa", ("--neighbourhood", "von-neumann"), {}
    for waves in 0, 1, 2:
        yield "extra waves", waves, "djfa", ("--extra-waves", waves), {}
    for interval in 0, 5, 10:
        yield "refresh interval", interval, "djfa", ("--refresh-interval", interval), {}
    for times in 1, 2, 3, 4:
        for method in "jfa", "djfa":
            yield "d_max", f"{times} L, {method}", method, (), {"step_length": round(times * math.sqrt(n * n / seeds))}
    for spread in "uniform", "clusters", "gradient":
        points = None if spread == "uniform" else os.path.join(folder, f"{spread}.csv")
        if points:
            spread_points(points, spread, n, seeds, options.rng_seed)
        for method in "jfa", "djfa":
            yield "seeds", f"{spread}, {method}", method, (), {"points": points}


def ablate(study, n, seeds):
    """The rows of the ablation."""
    with tempfile.TemporaryDirectory() as folder:
        every = list(variants(n, seeds, study.options, folder))
        runs = study.timed([((n, seeds, study.options.timed_frames, (method, "euclidean"), *arguments), named)
                            for _, _, method, arguments, named in every])
        for (choice, setting, method, arguments, named), timed in zip(every, runs):
            run = study.simulate(n, seeds, study.options.frames, (method, "euclidean"), *arguments, "--compare-with", "exact",
                                 **named)
            waves = run["waves"]
            if "plans" in run:  # those of a JFA in some frames
                least, greatest = (run["plans"]["waves"][which] for which in ("least", "greatest"))
                full = run["plans"]["jfa_frames"]
                waves = (full * greatest + (run["frames"] - full) * least) / run["frames"]
            yield {
                "n": n, "seeds": seeds, "study": choice, "setting": setting,
                "d_max": named.get("step_length", study.options.step_length), "waves_mean": waves,
                **{f"milliseconds_{name}": value for name, value in times_of(timed).items()},
                **mean_and("least", "similarity_to_exact", run["similarity"]), **errors_of(run),
            }


def complete_rows(path, origin):
    """By grid and number of seeds, of a table of the same origin."""
    rows = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            for name, value in origin.items():
                if row.get(name) != str(value):
                    raise StudyError(f"{path} is of another study: {name} is {row.get(name)} there and {value} here")
            rows.setdefault((row.get("n"), row.get("seeds")), []).append(row)
    most = max(map(len, rows.values()), default=0)
    return {key: found for key, found in rows.items() if len(found) == most and None not in found[-1].values()}


def write(path, rows):
    """All of them, or the table stays as it was."""
    temporary = f"{path}.new"
    with open(temporary, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    os.replace(temporary, path)


def seeds_of(text, n):
    """A number, or a percentage of the pixels."""
    count = round(float(text[:-1]) / 100 * n * n) if text.endswith("%") else int(text)
    if not 1 <= count <= 2**30:
        raise StudyError(f"--seeds: {text} of {n} x {n} pixels are {count} seeds; 1 to 2^30 are possible")
    return count


def run(options):
    options.study = {"evaluate": evaluate, "ablation": ablate}[options.what]
    is_evaluation = options.what == "evaluate"
    usual_sizes, usual_seeds = ("500,1000,2000", "0.005%,0.01%,0.05%,0.1%,0.5%,1%,3%,6.25%") if is_evaluation else ("1000", "1%")
    if options.full:
        usual_sizes, usual_seeds = "1000,2000,4000,5000,10000,20000", "0.01%,0.0125%,0.02%,0.05%,0.1%,0.2%,0.5%,1%"
    options.frames = options.frames or (100 if is_evaluation else 50)
    options.timed_frames = options.timed_frames or (options.frames if options.full else 10 if is_evaluation else 20)
    try:
        sides = sorted({int(side) for side in (options.sizes or usual_sizes).split(",")})
        every = [(n, count) for n in sides
                 for count in sorted({seeds_of(text, n) for text in (options.seeds or usual_seeds).split(",")})]
    except ValueError as error:
        raise StudyError(f"--sizes takes n,... and --seeds S|P%,...: {error}") from error
    if os.path.exists(options.output) and not options.resume:
        raise StudyError(f"{options.output} exists; --resume goes on with it, or give another file")
    study = Study(options)
    done = complete_rows(options.output, study.origin) if os.path.exists(options.output) else {}
    rows = [row for found in done.values() for row in found]
    for n, seeds in every:
        if (str(n), str(seeds)) in done:
            continue
        date = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
        rows += [{**study.origin, "date": date, **row} for row in options.study(study, n, seeds)]
        write(options.output, rows)
        print(f"{n} x {n} pixels, {seeds} seeds: {options.output} has {len(rows)} rows", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["evaluate", "ablation"])
    parser.add_argument("-o", "--output", metavar="FILE", required=True)
    parser.add_argument("--sizes", metavar="n,...", help="grids of n x n pixels (500,1000,2000; ablation: 1000)")
    parser.add_argument("--seeds", metavar="S|P%,...".replace("%", "%%"),
                        help="numbers of seeds, or percentages of the pixels (eight from 0.005%% to 6.25%%; ablation: 1%%)")
    parser.add_argument("--full", action="store_true", help="evaluate what the paper's authors do, on a GPU: up to 20000 pixels a side, "
                        "0.01%% to 1%% seeds, timed over all frames")
    parser.add_argument("--frames", type=int, metavar="A", help="over which accuracy is measured (100; ablation: 50)")
    parser.add_argument("--timed-frames", type=int, metavar="T", help="of a timed run (10; ablation: 20)")
    parser.add_argument("--repeats", type=int, default=3, metavar="R", help="timed runs of each method, which take turns (%(default)s)")
    parser.add_argument("--step-length", type=int, default=5, metavar="D", help="how far a seed moves at most along an axis per frame (%(default)s)")
    parser.add_argument("--rng-seed", type=int, default=1, metavar="R", help="seed of the random numbers (%(default)s)")
    parser.add_argument("--resume", action="store_true", help="go on with the table, if it exists")
    parser.add_argument("--vorocl", metavar="PROGRAM", default=str(Path(__file__).parents[2] / "build/tools/vorocl"))
    try:
        run(parser.parse_args())
    except (StudyError, OSError) as error:
        sys.exit(f"study.py: error: {error}")
    except KeyboardInterrupt:
        sys.exit("study.py: interrupted; the table has what is complete, and --resume goes on with the rest")


if __name__ == "__main__":
    main()
