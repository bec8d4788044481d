#!/usr/bin/python3
"""Writes the tables of docs/evaluation.md between their marks, from the tables that the commands have written:
evaluation_tables.py DOCUMENT FOLDER, with evaluation.csv, ablation.csv and lengths.csv (and evaluation-10000.csv,
extra_waves.csv, plans.csv, resolution.csv and tolerance.csv, where they are there) in the folder."""

import argparse
import csv
import math
import os
import re
import sys


def read(folder, name):
    with open(os.path.join(folder, name), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise ValueError(f"{name} is empty")
    return rows


def number(row, column):
    return float(row[column])


class Evaluation:
    """Rows of study.py evaluate, by n, seeds, method and metric."""

    def __init__(self, rows):
        self.rows = {(int(row["n"]), int(row["seeds"]), row["method"], row["metric"]): row for row in rows}
        self.configurations = sorted({key[:2] for key in self.rows})

    def row(self, n, seeds, method="djfa", metric="euclidean"):
        return self.rows.get((n, seeds, method, metric))

    def value(self, n, seeds, column, method="djfa", metric="euclidean"):
        row = self.row(n, seeds, method, metric)
        return number(row, column) if row else None

    def all(self, column, method="djfa", metric="euclidean"):
        return [(self.value(n, seeds, column, method, metric), n, seeds) for n, seeds in self.configurations]

    def speedup(self, n, seeds, over, of, which="least"):
        """The time of one method over that of another, each a (method, metric), by least times or by medians."""
        rows = [self.row(n, seeds, *method) for method in (over, of)]
        if None in rows:
            return None
        slow, fast = (number(row, f"milliseconds_{which}") for row in rows)
        return slow / fast

    def speedups(self, over, of):
        return [(self.speedup(n, seeds, over, of), n, seeds) for n, seeds in self.configurations]


JFA, DJFAE, DJFAM, EXACT = ("jfa", "euclidean"), ("djfa", "euclidean"), ("djfa", "manhattan"), ("exact", "euclidean")
JFAM = ("jfa", "manhattan")
PUBLISHED_SIMILARITIES = {2000: 99.9955, 20000: 99.9921, 40000: 99.9935}  # by seeds on 2,000 x 2,000: V2ER2K


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "| " + " | ".join("---" for _ in head) + " |"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def shown(value, digits, unit=""):
    return "not run" if value is None else f"{value:,.{digits}f}{unit}"


def times_table(evaluation):
    head = [
        "n", "seeds", "pixels per seed", "JFA: waves", "ms per frame (least, greatest)", "dJFA: waves", "waves' ratio",
        "T_JFA / T_dJFAe (by medians)", "T_JFA / T_dJFAm", "T_dJFAe / T_dJFAm", "T_JFA / T_exact",
    ]
    rows = []
    for n, seeds in evaluation.configurations:
        jfa, djfa = evaluation.row(n, seeds, "jfa"), evaluation.row(n, seeds)
        frames = number(jfa, "timed_frames")
        median, least, greatest = (number(jfa, f"milliseconds_{name}") / frames for name in ("median", "least", "greatest"))

        def ratio(over, of, with_medians=False):
            least, medians = (evaluation.speedup(n, seeds, over, of, which) for which in ("least", "median"))
            return f"{least:.2f} ({medians:.2f})" if with_medians else f"{least:.2f}"

        rows.append([
            f"{n:,}", f"{seeds:,}", shown(number(jfa, "pixels_per_seed"), 0), jfa["waves"],
            f"{median:.2f} ({least:.2f}, {greatest:.2f})", djfa["waves"],
            shown(number(jfa, "waves") / number(djfa, "waves"), 2), ratio(JFA, DJFAE, True), ratio(JFA, DJFAM),
            ratio(DJFAE, DJFAM), ratio(JFA, EXACT),
        ])
    return table(head, rows)


def similarity_table(evaluation):
    head = [
        "n", "seeds", "dJFAe to JFA (least)", "dJFAe to exact", "JFA to exact", "dJFAm to Euclidean JFA (least)",
        "dJFAm to Manhattan JFA", "dJFAm to exact",
    ]
    rows = []
    for n, seeds in evaluation.configurations:
        djfae, djfam = evaluation.row(n, seeds), evaluation.row(n, seeds, metric="manhattan")

        def percent(row, reference, with_least=False):
            mean, least = (number(row, f"similarity_to_{reference}_{which}") for which in ("mean", "least"))
            return f"{mean:.4f} ({least:.4f})" if with_least else f"{mean:.4f}"

        rows.append([
            f"{n:,}", f"{seeds:,}", percent(djfae, "euclidean_jfa", True), percent(djfae, "exact"),
            percent(evaluation.row(n, seeds, "jfa"), "exact"), percent(djfam, "euclidean_jfa", True),
            percent(djfam, "jfa"), percent(djfam, "exact"),
        ])
    return table(head, rows)


def lengths_table(lengths):
    head = ["length", "regions", "mean / L_avg", "deviation / L_avg", "greatest / L_avg", "under 2 L_avg"]
    return table(head, [
        [row["length"], f"{int(row['regions']):,}"]
        + [shown(number(row, column) / number(row, "l_avg"), 3) for column in ("mean", "deviation", "greatest")]
        + [shown(number(row, "percent_under_2_l_avg"), 2, " %")]
        for row in lengths
    ])


def ablation_table(ablation):
    head = [
        "study", "setting", "d_max", "waves", "ms per frame (least, greatest)", "wrong pixels: mean", "greatest",
        "mean excess (pixels)", "largest", "two runs differ in",
    ]
    rows, before = [], None
    for row in ablation:
        frames = number(row, "timed_frames")
        median, least, greatest = (number(row, f"milliseconds_{name}") / frames for name in ("median", "least", "greatest"))
        rows.append([
            row["study"] if row["study"] != before else "", row["setting"], row["d_max"], f"{number(row, 'waves_mean'):g}",
            f"{median:.2f} ({least:.2f}, {greatest:.2f})", shown(number(row, "wrong_percent_mean"), 4, " %"),
            shown(number(row, "wrong_percent_greatest"), 4, " %"), f"{number(row, 'mean_excess'):.2g}",
            shown(number(row, "largest_excess"), 1),
            shown(number(row, "differing_between_runs_mean"), 4, " %") if "differing_between_runs_mean" in row else "",
        ])
        before = row["study"]
    return table(head, rows)


def verdict(ours, published, tolerance):
    """In words: whether ours is within a share of the published value."""
    if ours is None:
        return "not run here"
    if abs(ours - published) <= tolerance * published:
        return "agrees"
    return "greater" if ours > published else "less"


def range_verdict(values, low, high):
    inside = sum(low <= value <= high for value in values)
    return "agrees" if inside == len(values) else f"{inside} of {len(values)} within it"



def ratio_of_their_waves(n, seeds):
    """Of the authors' program: JFA's waves over those of dJFA, whose first step is 2 L_avg rounded down."""
    return (int(math.log2(n)) + 1) / (int(math.log2(2 * n / math.sqrt(seeds))) + 1)



def published_table(evaluation, large, lengths):
    head = ["published", "source", "value", "ours", "verdict", "why"]
    rows = []

    def add(name, source, value, ours, says, why=""):
        rows.append([name, source, value, ours, says, why])

    under = {row["length"]: number(row, "percent_under_2_l_avg") for row in lengths}
    for length, percent in under.items():
        why = "" if percent > 98.5 else "a convex region's box is longer than the root of its area"
        add(f"regions shorter than 2 L_avg ({length})", "text", "about 99 %", shown(percent, 2, " %"),
            "agrees" if percent > 98.5 else "less", why)
    for n, seeds, published in [(1000, 100, 1.2), (1000, 10000, 2.1), (10000, 1000000, 4.3), (20000, 4000000, 4.7)]:
        source = large if n >= 10000 else evaluation
        ours = source.speedup(n, seeds, JFA, DJFAE) if source else None
        waves = [source.value(n, seeds, "waves", method) for method in ("jfa", "djfa")] if source else [None]
        here = f"{waves[0] / waves[1]:.2f} here, " if ours is not None else ""
        why = f"the waves' ratio is {here}{ratio_of_their_waves(n, seeds):.2f} there; see section 8"
        add(f"speedup of dJFAe, {n:,}², {n * n // seeds:,} pixels per seed", "notebook", f"{published} ×",
            shown(ours, 2, " ×"), verdict(ours, published, 0.1), why)
    add("speedup of dJFAm, 20,000², 100 pixels per seed", "notebook", "5.1 ×", "not run", "not run here", "for a GPU: `evaluate --full`")
    of_djfae, of_djfam = evaluation.speedups(JFA, DJFAE), evaluation.speedups(JFA, DJFAM)
    between = evaluation.speedups(DJFAE, DJFAM)
    for name, source, published, ratios in [
        ("greatest speedup of dJFAe", "text", 4.5, of_djfae),
        ("greatest speedup of dJFAm, over the Euclidean JFA", "text", 5.0, of_djfam),
        ("greatest speedup of dJFAm, over the Manhattan JFA", "", None, evaluation.speedups(JFAM, DJFAM)),
        ("greatest speedup of all", "abstract", 5.3, of_djfae + of_djfam),
        ("greatest T_dJFAe / T_dJFAm", "text", 1.2, between),
    ]:
        best, n, seeds = max(ratios)
        says = verdict(best, published, 0.1) if published else ""
        reason = (
            "a squared distance costs no more than a Manhattan one here" if ratios is between
            else "grids up to 2,000², where JFA has 11 waves (15 on 20,000²); see section 8"
        )
        add(name, source, f"{published} ×" if published else "not given", f"{best:.2f} × ({n:,}², {seeds:,} seeds)", says,
            reason if says == "less" else "")
    slower = [
        evaluation.value(n, seeds, "waves", "jfa") / evaluation.value(n, seeds, "waves")
        for value, n, seeds in of_djfae + of_djfam if value < 1
    ]
    count = 2 * len(evaluation.configurations)
    add("dJFA takes less time than JFA", "text", "always", f"in {count - len(slower)} of {count} cases",
        "not always" if slower else "agrees",
        f"where it does not, JFA has at most {max(slower):.2f} times as many waves" if slower else "")
    for seeds, published in PUBLISHED_SIMILARITIES.items():
        ours = evaluation.value(2000, seeds, "similarity_to_euclidean_jfa_mean")
        says = "not run here" if ours is None else "nearer" if ours > published else "less near"
        add(f"similarity of dJFAe, 2,000², {seeds:,} seeds", "notebook", f"{published} %", shown(ours, 4, " %"), says,
            "not measured alike: see below")
    values = [value for value, _, _ in evaluation.all("similarity_to_euclidean_jfa_mean", metric="manhattan")]
    add("similarity of dJFAm to the Euclidean JFA", "text", "88 to 92 %", f"{min(values):.2f} to {max(values):.2f} %",
        range_verdict(values, 88, 92), "")
    values = [value for value, _, _ in evaluation.all("similarity_to_jfa_mean", metric="manhattan")]
    add("similarity of dJFAm to its own JFA", "", "not given", f"{min(values):.4f} to {max(values):.4f} %", "",
        "what is missing above is the metrics' difference")
    return table(head, rows)


def extra_waves_table(rows):
    """Of each number of seeds: the notebook's similarity, and ours by the plan and what it is held against."""
    ours = {
        (int(row["seeds"]), row["reach"], row["extra_waves"], row["compare_with"]): number(row, "similarity") for row in rows
    }
    head = [
        "seeds on 2,000 x 2,000", "notebook", "`--reach paper`, to JFA", "`--extra-waves 2`, to JFA",
        "`--extra-waves 2`, to JFA+2", "`--reach authors --extra-waves 2`, to JFA+2, within 1e-4 n",
    ]
    ways = [("paper", "0", "jfa"), ("paper", "2", "jfa"), ("paper", "2", "jfa+2"), ("authors", "2", "jfa+2")]
    return table(head, [
        [f"{seeds:,}", shown(value, 4)] + [shown(ours[seeds, *way], 4) for way in ways]
        for seeds, value in PUBLISHED_SIMILARITIES.items()
    ])


def plans_table(rows):
    """Of each number of seeds JFA and dJFA's plans: the least time of the runs, also as a share of JFA's."""
    runs = {}
    for row in rows:
        runs.setdefault((int(row["n"]), int(row["seeds"]), row["method"], row["reach"], row["extra_waves"]), []).append(row)
    times = {key: min(number(row, "milliseconds") for row in of) for key, of in runs.items()}
    head = ["pixels per seed", "plan", "waves", "ms per frame", "of JFA's", "wrong pixels"]
    lines, before = [], None
    for (n, seeds, method, reach, extra_waves), of in runs.items():
        time = times[n, seeds, method, reach, extra_waves]
        plan = "JFA" if method == "jfa" else f"`--reach {reach}" + (f" --extra-waves {extra_waves}`" if extra_waves != "0" else "`")
        lines.append([
            f"{n * n // seeds:,}" if seeds != before else "", plan, of[0]["waves"], shown(time, 2),
            shown(time / times[n, seeds, "jfa", "", ""], 2), shown(number(of[0], "wrong_percent"), 4, " %"),
        ])
        before = seeds
    return table(head, lines)


def resolution_table(rows):
    """Of each kind of seeds on 2048 x 2048: the least times, and the wrong pixels of all rounds' seeds."""
    runs = {}
    for row in rows:
        runs.setdefault(row["seeds"], {}).setdefault(row["method"], []).append(row)
    head = ["seeds", "pixels per seed", "JFA: ms", "wrong pixels", "low resolution: ms", "of JFA's", "wrong pixels", "exact: ms"]
    lines = []
    for seeds, methods in runs.items():
        time = {name: min(number(row, "milliseconds") for row in of) for name, of in methods.items()}
        wrong = {name: f"{sum(int(row['wrong_pixels']) for row in of) / len(of):,.0f}" for name, of in methods.items()}
        counted = seeds.isdigit()
        lines.append([
            f"{int(seeds):,}" if counted else seeds.replace("-", " "), f"{2048**2 // int(seeds):,}" if counted else "",
            shown(time["jfa"], 1), wrong["jfa"], shown(time["low-resolution"], 1),
            shown(time["low-resolution"] / time["jfa"], 2), wrong["low-resolution"], shown(time["exact"], 1),
        ])
    return table(head, lines)


def tolerance_table(rows):
    published = {(1000, 100): 90.2, (2000, 100): 90.8, (4000, 100): 92.5}
    head = ["n", "pixels per seed", "equal labels", "distances within 1e-4 n", "notebook"]
    return table(head, [
        [f"{n:,}", f"{n * n // int(row['seeds']):,}", shown(number(row, "strict"), 2), shown(number(row, "tolerant"), 2),
         shown(published[n, n * n // int(row["seeds"])], 1) if (n, n * n // int(row["seeds"])) in published else ""]
        for row in rows for n in [int(row["n"])]
    ])


def machine_line(rows):
    row = rows[0]
    return (f"Made by VoroCL {row['version']} on {row['device']} ({row['platform']} {row['driver']}), "
            f"{rows[0]['date'][:10]}: {row['frames']} frames for accuracy, {row['repeats']} runs of {row['timed_frames']} "
            f"frames for times, seeds moving by up to {row['step_length']} pixels along each axis per frame.")


def tables(folder):
    rows, ablation, lengths = (read(folder, name) for name in ("evaluation.csv", "ablation.csv", "lengths.csv"))
    evaluation = Evaluation(rows)
    large_path = os.path.join(folder, "evaluation-10000.csv")
    large = Evaluation(read(folder, "evaluation-10000.csv")) if os.path.exists(large_path) else None
    similarities = {
        name: made(read(folder, file))
        for name, file, made in (
            ("extra waves", "extra_waves.csv", extra_waves_table), ("plans", "plans.csv", plans_table),
            ("resolution", "resolution.csv", resolution_table),
            ("tolerance", "tolerance.csv", tolerance_table),
        )
        if os.path.exists(os.path.join(folder, file))
    }
    return {
        "machine": machine_line(rows),
        "lengths": lengths_table(lengths),
        "similarity": similarity_table(evaluation),
        "times": times_table(evaluation),
        "published": published_table(evaluation, large, lengths),
        "ablation": machine_line(ablation) + "\n\n" + ablation_table(ablation),
        **similarities,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("document")
    parser.add_argument("folder")
    arguments = parser.parse_args()
    try:
        with open(arguments.document, encoding="utf-8") as file:
            text = file.read()
        for name, lines in tables(arguments.folder).items():
            place = re.compile(rf"(<!-- table {name} -->\n).*?(<!-- end -->)", re.DOTALL)
            text, found = place.subn(lambda match, lines=lines: match[1] + lines + "\n" + match[2], text)
            if found != 1:
                raise ValueError(f"{arguments.document} must have one place \"<!-- table {name} -->\", and it has {found}")
        temporary = arguments.document + ".new"
        with open(temporary, "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(temporary, arguments.document)
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"evaluation_tables.py: error: {error}")


if __name__ == "__main__":
    main()
