#!/usr/bin/env python3
"""Makes rows of published tables again and compares them: check_rows.py COMMAND SOURCE_FOLDER [all]. Without `all` those that take
least. Exits with 77 where NumPy is not installed."""
import csv
import json
import os
import subprocess
import sys
import tempfile

command, source = sys.argv[1:3]
all_rows = sys.argv[3:] == ["all"]
try:
    import numpy  # noqa: F401  what motions.py needs
except ImportError:
    sys.exit(77)


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def run(*arguments):
    done = subprocess.run([command, *map(str, arguments), "--json"], check=True, stdout=subprocess.PIPE)
    return json.loads(done.stdout)


def compare(what, published, found):
    """Published numbers have their own number of digits."""
    if abs(float(published) - found) > 5e-5:
        stale.append(f"{what}: published {published}, now {found}")


stale = []
pages = os.path.join(source, "docs", "evaluation")


def study(what, keys, columns, *arguments):
    """Makes rows of the study again, with the least of times, and compares the columns."""
    with tempfile.TemporaryDirectory() as folder:
        again = os.path.join(folder, "again.csv")
        script = os.path.join(source, "tools", "studies", "study.py")
        subprocess.run([sys.executable, script, what, "-o", again, "--vorocl", command, "--timed-frames", "1", "--repeats", "1",
                        *arguments], check=True, stdout=subprocess.DEVNULL)
        name = {"evaluate": "evaluation", "ablation": "ablation"}[what] + ".csv"
        published = {tuple(row[key] for key in keys): row for row in table(os.path.join(pages, name))}
        for row in table(again):
            key = tuple(row[key] for key in keys)
            if "clusters" in row.get("setting", "") or "gradient" in row.get("setting", ""):
                continue  # drawn by another generator
            for column in columns:
                compare(f"{name}, {key}, {column}", published[key][column], float(row[column]))


errors = ["similarity_to_exact_mean", "similarity_to_exact_least", "wrong_percent_mean", "wrong_percent_greatest", "largest_excess",
          "mean_excess"]
study("evaluate", ["n", "seeds", "method", "metric"], errors + ["coincident_seeds", "waves", "similarity_to_jfa_mean",
      "similarity_to_jfa_least", "similarity_to_euclidean_jfa_mean", "similarity_to_euclidean_jfa_least"],
      *([] if all_rows else ["--sizes", "500", "--seeds", "13,15625"]))
if all_rows:
    study("ablation", ["study", "setting"], errors + ["d_max", "waves_mean"])
for row in table(os.path.join(pages, "tolerance.csv")):
    if not (all_rows or row["n"] == "1000"):
        continue
    exact = ["simulate", "--random", row["seeds"], "--size", f"{row['n']}x{row['n']}", "--frames", 1, "--step-length", 1, "--method",
             "exact", "--compare-with", "exact", "--compare-metric", "manhattan"]
    compare(f"tolerance.csv, n = {row['n']}", row["strict"], run(*exact)["similarity"]["mean"])
    compare(f"tolerance.csv, n = {row['n']}, tolerant", row["tolerant"],
            run(*exact, "--tolerance", float(row["n"]) * 1e-4)["similarity"]["mean"])
for row in table(os.path.join(pages, "extra_waves.csv")) if all_rows else []:
    tolerance = ["--tolerance", row["tolerance"]] if row["tolerance"] else []
    found = run("simulate", "--random", row["seeds"], "--size", f"{row['n']}x{row['n']}", "--frames", 20, "--step-length", 5, "--method",
                "djfa", "--reach", row["reach"], "--extra-waves", row["extra_waves"], "--compare-with", row["compare_with"], *tolerance)
    compare(f"extra_waves.csv, {row['seeds']} seeds, {row['compare_with']}", row["similarity"], found["similarity"]["mean"])
for row in table(os.path.join(pages, "resolution.csv")):
    if row["seeds"].isdigit() and row["method"] == "jfa" and (all_rows or row["round"] == "1" and row["seeds"] == "4096"):
        rows = run("bench", "--random", row["seeds"], "--rng-seed", row["round"], "--size", "2048x2048", "--methods",
                   "jfa,low-resolution", "--repeat", 1)["results"]
        for found, published in zip(rows, [r for r in table(os.path.join(pages, "resolution.csv"))
                                           if (r["seeds"], r["round"]) == (row["seeds"], row["round"])]):
            compare(f"resolution.csv, {row['seeds']} seeds, {found['method']}", published["wrong_pixels"], found["wrong_pixels"])

# Motions of few seeds take least.
motions = os.path.join(source, "docs", "motions")
with tempfile.TemporaryDirectory() as folder:
    again = os.path.join(folder, "motions.csv")
    subprocess.run([sys.executable, motions + ".py", command, again, *([] if all_rows else ["7", "54", "61", "77"])], check=True)
    published = {(row["rng_seed"], row["method"]): row for row in table(motions + ".csv")}
    for row in table(again):
        if row != published[row["rng_seed"], row["method"]]:
            stale.append(f"motions.csv: published {published[row['rng_seed'], row['method']]}, now {row}")
if stale:
    sys.exit("\n".join(stale))
