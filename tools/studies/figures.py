#!/usr/bin/python3
"""Draws the figures of docs/evaluation.md (needs python3-matplotlib).

evaluation: of a table that study.py evaluate has written, each against n and against the density.
lengths: the histogram of the regions' lengths in a diagram, as the square root of the area and as the larger side of the bounding
box, with L_avg, 2 L_avg and the normal curve of the same mean and deviation. Prints the numbers as CSV.
montage: pictures in rows, each under its caption, as "caption=picture.png". An empty argument leaves its place empty.
"""

import argparse
import csv
import math
import os
import statistics
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402

TEXTS = ["version", "device", "method", "metric"]
NUMBERS = [
    "step_length", "frames", "timed_frames", "repeats", "n", "seeds", "pixels_per_seed", "waves",
    "milliseconds_median", "milliseconds_least", "milliseconds_greatest", "speedup_over_jfa", "speedup_over_djfae",
    "similarity_to_euclidean_jfa_mean", "similarity_to_jfa_mean", "similarity_to_exact_mean",
]
MARKERS = "osD^vP*X<>hp"
DENSITY = "pixels per seed (fewer: denser)"
SIDE = "n (grid of n × n pixels)"


class BadInput(Exception):
    """What is wrong with a table or a picture, in one line."""


def read_table(path):
    """The rows, with numbers as floats. One device and one evaluation."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            missing = [name for name in TEXTS + NUMBERS if name not in (reader.fieldnames or [])]
            if missing:
                raise BadInput(f"{path} is no table of study.py evaluate: it has no column {missing[0]}")
            rows = [read_row(path, reader.line_num, row) for row in reader]
    except OSError as error:
        raise BadInput(f"cannot read {path}: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise BadInput(f"{path} is no table of study.py evaluate: {error}") from error
    if not rows:
        raise BadInput(f"{path} holds no configuration yet")
    for name in ["version", "device", "step_length", "frames", "timed_frames"]:
        if len({row[name] for row in rows}) > 1:
            raise BadInput(f"{path} mixes evaluations: its rows differ in {name}")
    return rows


def read_row(path, line, row):
    values = {name: row[name] for name in TEXTS}
    for name in NUMBERS:
        try:
            values[name] = float(row[name])
        except (TypeError, ValueError):
            raise BadInput(f"{path}:{line}: {name} is {row[name]!r} and no number") from None
    return values


def djfa_waves(n, pixels_per_seed, d_max):
    """The waves of dJFA: steps 2^ceil(log2(max(2 L, d_max))), half of it, ..., 1, where L^2 = pixels per seed; the first
    step is at most JFA's."""
    if n == 1:
        return 0
    most = jfa_waves(n)
    waves = 1
    while waves < most and (4 ** (waves - 1) < 4 * pixels_per_seed or 2 ** (waves - 1) < d_max):
        waves += 1
    return waves


def jfa_waves(n):
    return math.ceil(math.log2(n)) if n > 1 else 0


def steps_of_staircase(rows):
    """The densities, powers of four, where the number of waves changes on some of the grids."""
    d_max = rows[0]["step_length"]
    lowest, highest = extent(rows, "pixels_per_seed")
    found = []
    for power in range(16):
        density = 4.0**power
        if not lowest <= density <= highest:
            continue
        if any(djfa_waves(n, density, d_max) < djfa_waves(n, density * 1.001, d_max) for n in sides(rows)):
            found.append(density)
    return found


def sides(rows):
    return sorted({row["n"] for row in rows})


def extent(rows, name):
    values = [row[name] for row in rows]
    return min(values), max(values)


def of(rows, method, metric):
    return [row for row in rows if row["method"] == method and row["metric"] == metric]


def by_side(rows):
    """Rows of one n, each group with its label."""
    return [(f"n = {n:,.0f}", [row for row in rows if row["n"] == n]) for n in sides(rows)]


def asked_for_counts(rows):
    """Whether the evaluation was of some numbers of seeds, rather than of some densities: there are fewer of them."""
    return len({row["seeds"] for row in rows}) < len(densities_of(rows))


def by_density(rows):
    """Rows of nearly one density, each group with its label: that of its largest grid, which is rounded least."""
    groups = [[row for row in rows if row["pixels_per_seed"] in group] for group in densities_of(rows)]
    return [(f"{max(group, key=lambda row: row['n'])['pixels_per_seed']:,.0f} pixels per seed", group) for group in groups]


def by_count(rows):
    """Rows of one number of seeds, each group with its label."""
    counts = sorted({row["seeds"] for row in rows})
    return [(f"{count:,.0f} seeds", [row for row in rows if row["seeds"] == count]) for count in counts]


def densities_of(rows):
    """Groups of densities that differ by rounding alone: a percentage of the pixels is rounded to whole seeds."""
    densities, group = [], []
    for density in sorted({row["pixels_per_seed"] for row in rows}):
        if group and density > 1.1 * group[0]:
            densities.append(group)
            group = []
        group.append(density)
    return densities + [group]


def colours(count):
    """In order of brightness, which every reader can tell."""
    return [plt.get_cmap("viridis")(0.9 * i / max(count - 1, 1)) for i in range(count)]


class Axis:
    """What a figure's x axis shows: n or the density, with a line for each value of the other."""

    def __init__(self, name, rows):
        self.name = name
        self.column = "n" if name == "n" else "pixels_per_seed"
        self.label = SIDE if name == "n" else DENSITY
        self.of_counts = name == "n" and asked_for_counts(rows)
        self.groups = by_side(rows) if name != "n" else by_count(rows) if self.of_counts else by_density(rows)
        self.extent = extent(rows, self.column)
        self.ticks = sides(rows) if name == "n" else None

    def dress(self, panel):
        panel.set_xscale("log")
        panel.set_xlabel(self.label)
        if self.ticks and len(self.ticks) <= 8:
            panel.set_xticks(self.ticks)
        panel.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}"))
        panel.xaxis.set_minor_formatter(NullFormatter())
        low, high = self.extent
        panel.set_xlim(low / 1.25, high * 1.25)
        if self.name != "n":
            panel.invert_xaxis()
        panel.grid(True, which="major", color="0.9")

    def draw(self, panel, method, metric, value, style="-", spread=None, labelled=True):
        """One line a group: value(row) against n or the density, with bars for the `spread` of it."""
        for i, (label, rows) in enumerate(self.groups):
            line = sorted(of(rows, method, metric), key=lambda row: row[self.column])
            x, y = [row[self.column] for row in line], [value(row) for row in line]
            look = {
                "color": colours(len(self.groups))[i], "marker": MARKERS[i % len(MARKERS)], "markersize": 5,
                "linestyle": style, "linewidth": 1.4, "label": label if labelled else None,
            }
            if style == "--":
                look.update(markerfacecolor="white")
            if spread:
                bars = [[abs(value(row) - spread(row)[end]) for row in line] for end in (0, 1)]
                panel.errorbar(x, y, yerr=bars, capsize=2, elinewidth=0.8, **look)
            else:
                panel.plot(x, y, **look)


def new_figure(rows, title, shape, size, widths=None):
    figure, panels = plt.subplots(
        *shape, figsize=size, squeeze=False, layout="constrained", gridspec_kw={"width_ratios": widths}
    )
    first = rows[0]
    figure.suptitle(f"{title}\n{first['device']}, VoroCL {first['version']}", fontsize=11)
    return figure, panels


def legend_instead(panel, handles_and_labels):
    """Fills an empty panel with the legend of another one."""
    panel.axis("off")
    panel.legend(*handles_and_labels, loc="center left", fontsize=9, frameon=False)


def similarity_figure(rows, axis):
    frames = int(rows[0]["frames"])
    figure, panels = new_figure(rows, f"Similarity, mean of {frames} frames", (2, 3), (12, 7))
    drawn = [
        (panels[0][0], "euclidean", "similarity_to_jfa_mean", "dJFAe to JFA"),
        (panels[0][1], "euclidean", "similarity_to_exact_mean", "dJFAe to the exact diagram"),
        (panels[1][0], "manhattan", "similarity_to_euclidean_jfa_mean", "dJFAm to Euclidean JFA"),
        (panels[1][1], "manhattan", "similarity_to_jfa_mean", "dJFAm to Manhattan JFA"),
        (panels[1][2], "manhattan", "similarity_to_exact_mean", "dJFAm to the exact diagram"),
    ]
    for panel, metric, column, title in drawn:
        axis.draw(panel, "djfa", metric, lambda row, column=column: row[column])
        axis.dress(panel)
        panel.set_title(title, fontsize=10)
        panel.set_ylabel("similarity (% of the pixels)")
        panel.ticklabel_format(axis="y", useOffset=False)
        low, high = panel.get_ylim()
        if high - low < 1e-3:
            panel.set_ylim(high - 1e-3, high + 5e-5)
    legend_instead(panels[0][2], panels[0][0].get_legend_handles_labels())
    return figure


def times_figure(rows, axis):
    runs = f"{int(rows[0]['repeats'])} runs of {int(rows[0]['timed_frames'])} frames"
    figure, panels = new_figure(
        rows, f"Time of a diagram: median, least and greatest of {runs}", (1, 4), (14, 4.4), widths=[1, 1, 1, 0.4]
    )
    drawn = [("djfa", "euclidean", "dJFAe"), ("djfa", "manhattan", "dJFAm"), ("exact", "euclidean", "exact, Euclidean")]
    a_frame = 1 / rows[0]["timed_frames"]

    def median(row):
        return row["milliseconds_median"] * a_frame

    def spread(row):
        return row["milliseconds_least"] * a_frame, row["milliseconds_greatest"] * a_frame

    for panel, (method, metric, name) in zip(panels[0], drawn):
        axis.draw(panel, "jfa", "euclidean", median, style="--", spread=spread, labelled=False)
        axis.draw(panel, method, metric, median, spread=spread)
        axis.dress(panel)
        panel.set_yscale("log")
        panel.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        panel.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        panel.yaxis.set_minor_formatter(NullFormatter())
        panel.set_title(f"JFA (dashed) and {name} (solid)", fontsize=10)
        panel.set_ylabel("device time (ms per frame)")
    limits = [panel.get_ylim() for panel in panels[0][:3]]
    for panel in panels[0][:3]:
        panel.set_ylim(min(low for low, _ in limits), max(high for _, high in limits))
    legend_instead(panels[0][3], panels[0][0].get_legend_handles_labels())
    return figure


def speedup_figure(rows, axis):
    figure, panels = new_figure(rows, "Speedup, and the waves it comes from", (2, 3), (13.5, 8), [1, 1, 0.5])
    drawn = [
        (panels[0][0], "djfa", "euclidean", "speedup_over_jfa", r"$T_{JFA}\,/\,T_{dJFAe}$"),
        (panels[0][1], "djfa", "manhattan", "speedup_over_jfa", r"$T_{JFA}\,/\,T_{dJFAm}$"),
        (panels[1][0], "djfa", "manhattan", "speedup_over_djfae", r"$T_{dJFAe}\,/\,T_{dJFAm}$"),
    ]
    for panel, method, metric, column, title in drawn:
        axis.draw(panel, method, metric, lambda row, column=column: row[column])
        axis.dress(panel)
        panel.axhline(1, color="0.4", linewidth=0.8)
        panel.set_title(title, fontsize=11)
        panel.set_ylabel("speedup (ratio of device times)")
    waves = panels[1][1]
    axis.draw(waves, "djfa", "euclidean", lambda row: row["waves"], style="none")
    axis.dress(waves)
    waves.set_title("waves of dJFA: run (marks), by the formula (lines)", fontsize=10)
    waves.set_ylabel("waves per frame")
    draw_staircase(rows, axis, waves, lambda n, count: count)
    for panel in (panels[0][0], panels[0][1]):
        draw_staircase(rows, axis, panel, lambda n, count: jfa_waves(n) / count if count else 1)
    if axis.name != "n":
        for panel in panels[:, :2].flat:
            for density in steps_of_staircase(rows):
                panel.axvline(density, color="#d55e00", linestyle=":", linewidth=1)
    handles = list(waves.get_legend_handles_labels())
    handles[0].append(plt.Line2D([], [], color="0.5", linewidth=1.2, alpha=0.7))
    handles[1].append("waves of JFA / waves of dJFA")
    if axis.name != "n" and steps_of_staircase(rows):
        handles[0].append(plt.Line2D([], [], color="#d55e00", linestyle=":", linewidth=1))
        handles[1].append("where a step must fall")
    legend_instead(panels[0][2], handles)
    panels[1][2].axis("off")
    return figure


def draw_staircase(rows, axis, panel, value):
    """value(n, waves of dJFA) by the formula, along the axis, for each of its lines."""
    d_max = rows[0]["step_length"]
    low, high = axis.extent
    along = [low * (high / low) ** (i / 400) for i in range(401)]
    for i, (_, group) in enumerate(axis.groups):
        if axis.name == "n":
            density = statistics.median(row["pixels_per_seed"] for row in group)
            at = [(n, n * n / group[0]["seeds"] if axis.of_counts else density) for n in along]
        else:
            at = [(group[0]["n"], density) for density in along]
        y = [value(n, djfa_waves(n, density, d_max)) for n, density in at]
        panel.plot(along, y, color=colours(len(axis.groups))[i], linewidth=1.2, alpha=0.5, zorder=1)


def region_lengths(labels):
    """For each region that has a pixel: the square root of its area, and the larger side of its bounding box."""
    ids, region = np.unique(labels, return_inverse=True)
    region = region.reshape(labels.shape)
    area = np.bincount(region.ravel())
    sides = []
    for axis in (0, 1):
        place = np.broadcast_to(np.arange(labels.shape[axis]).reshape((-1, 1) if axis == 0 else (1, -1)), labels.shape)
        first, last = np.full(len(ids), labels.size), np.full(len(ids), -1)
        np.minimum.at(first, region, place)
        np.maximum.at(last, region, place)
        sides.append(last - first + 1)
    return {"square root of the area": np.sqrt(area), "larger side of the bounding box": np.maximum(*sides)}


def draw_lengths(panel, name, lengths, l_avg, share):
    mean, deviation = lengths.mean(), lengths.std()
    width = max(1, round(l_avg / 20))
    edges = np.arange(math.floor(lengths.min()), lengths.max() + 2 * width, width) - 0.5
    panel.hist(lengths, bins=edges, color="#9ecae1", edgecolor="white", linewidth=0.3, label="regions")
    x = np.linspace(edges[0], edges[-1], 400)
    curve = np.exp(-(((x - mean) / deviation) ** 2) / 2) / (deviation * math.sqrt(2 * math.pi))
    panel.plot(x, curve * len(lengths) * width, color="#d55e00", label="normal curve")
    panel.axvline(l_avg, color="0.2", linestyle="-", linewidth=1, label=r"$L_{avg}$")
    panel.axvline(2 * l_avg, color="0.2", linestyle="--", linewidth=1, label=r"$2\,L_{avg}$")
    panel.set_title(f"{name}: {share:.2f} % are under $2\\,L_{{avg}}$", fontsize=10)
    panel.set_xlabel("length (pixels)")
    panel.set_ylabel("regions")
    panel.legend(fontsize=8, frameon=False)


def draw_evaluation(options):
    rows = read_table(options.table)
    os.makedirs(options.output, exist_ok=True)
    for axis in Axis("n", rows), Axis("density", rows):
        for name, draw in ("similarity", similarity_figure), ("times", times_figure), ("speedup", speedup_figure):
            save(draw(rows, axis), os.path.join(options.output, f"{name}_{axis.name}.png"), options.dpi)


def draw_regions(options):
    try:
        labels = np.load(options.labels)
    except (OSError, ValueError) as error:
        raise BadInput(f"{options.labels}: {error}") from error
    if labels.ndim != 2:
        raise BadInput(f"{options.labels} is no image of labels")
    lengths = region_lengths(labels)
    regions = len(next(iter(lengths.values())))
    l_avg = math.sqrt(labels.size / regions)
    figure, panels = plt.subplots(1, 2, figsize=(11, 3.8), layout="constrained")
    figure.suptitle(f"{regions:,} regions on {labels.shape[1]:,} × {labels.shape[0]:,} pixels", fontsize=11)
    print("length,regions,l_avg,mean,deviation,greatest,percent_under_2_l_avg")
    for panel, (name, values) in zip(panels, lengths.items()):
        under = 100 * np.mean(values < 2 * l_avg)
        draw_lengths(panel, name, values, l_avg, under)
        print(f"{name},{regions},{l_avg:.6f},{values.mean():.6f},{values.std():.6f},{values.max():.6f},{under:.6f}")
    save(figure, options.output, options.dpi)


def draw_montage(options):
    rows, inches = math.ceil(len(options.pictures) / options.columns), options.inches
    figure, panels = plt.subplots(
        rows, options.columns, squeeze=False, layout="constrained",
        figsize=(inches * options.columns, (inches + 0.25) * rows),
    )
    for panel in panels.flat:
        panel.axis("off")
    for panel, argument in zip(panels.flat, options.pictures):
        if argument:
            caption, _, path = argument.rpartition("=")
            panel.imshow(plt.imread(path), interpolation="antialiased")
            panel.set_title(caption, fontsize=9)
    save(figure, options.output, options.dpi)


def save(figure, path, dpi):
    """The file is whole as soon as it has its name."""
    temporary = os.path.join(os.path.dirname(path), f".{os.getpid()}-figure.png")
    try:
        figure.savefig(temporary, dpi=dpi)
        os.replace(temporary, path)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True, metavar="evaluation|lengths|montage")

    def command(name, draw, dpi, output, what, **how):
        added = commands.add_parser(name)
        added.add_argument(what, **how)
        added.add_argument("-o", "--output", required=True, metavar=output)
        added.add_argument("--dpi", type=int, default=dpi, help="dots an inch (default: %(default)s)")
        added.set_defaults(draw=draw)
        return added

    command("evaluation", draw_evaluation, 150, "FOLDER", "table", help="what study.py evaluate -o has written (.csv)")
    command("lengths", draw_regions, 100, "PICTURE", "labels", help="what vorocl render --labels has written (.npy)")
    montage = command("montage", draw_montage, 100, "PICTURE", "pictures", nargs="+", metavar="CAPTION=PICTURE")
    montage.add_argument("--columns", type=int, default=3)
    montage.add_argument("--inches", type=float, default=2, help="width of each picture")
    options = parser.parse_args()
    try:
        options.draw(options)
    except (BadInput, OSError) as error:
        sys.exit(f"figures.py: error: {error}")


if __name__ == "__main__":
    main()
