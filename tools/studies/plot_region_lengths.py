#!/usr/bin/python3
"""Draws the histogram of the regions' lengths in a diagram, as the square root of the area and as the larger side of
the bounding box, with L_avg, 2 L_avg and the normal curve of the same mean and deviation. Prints the numbers as CSV
(needs python3-matplotlib)."""

import argparse
import math
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402


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


def draw(panel, name, lengths, l_avg):
    mean, deviation = lengths.mean(), lengths.std()
    width = max(1, round(l_avg / 20))
    edges = np.arange(math.floor(lengths.min()), lengths.max() + 2 * width, width) - 0.5
    panel.hist(lengths, bins=edges, color="#9ecae1", edgecolor="white", linewidth=0.3, label="regions")
    x = np.linspace(edges[0], edges[-1], 400)
    curve = np.exp(-(((x - mean) / deviation) ** 2) / 2) / (deviation * math.sqrt(2 * math.pi))
    panel.plot(x, curve * len(lengths) * width, color="#d55e00", label="normal curve")
    panel.axvline(l_avg, color="0.2", linestyle="-", linewidth=1, label=r"$L_{avg}$")
    panel.axvline(2 * l_avg, color="0.2", linestyle="--", linewidth=1, label=r"$2\,L_{avg}$")
    share = 100 * np.mean(lengths < 2 * l_avg)
    panel.set_title(f"{name}: {share:.2f} % are under $2\\,L_{{avg}}$", fontsize=10)
    panel.set_xlabel("length (pixels)")
    panel.set_ylabel("regions")
    panel.legend(fontsize=8, frameon=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("labels", help="what vorocl render --labels has written (.npy)")
    parser.add_argument("-o", "--output", metavar="PICTURE", required=True)
    parser.add_argument("--dpi", type=int, default=100)
    arguments = parser.parse_args()
    try:
        labels = np.load(arguments.labels)
    except (OSError, ValueError) as error:
        sys.exit(f"plot_region_lengths.py: error: {arguments.labels}: {error}")
    if labels.ndim != 2:
        sys.exit(f"plot_region_lengths.py: error: {arguments.labels} is no image of labels")
    lengths = region_lengths(labels)
    regions = len(next(iter(lengths.values())))
    l_avg = math.sqrt(labels.size / regions)
    figure, panels = plt.subplots(1, 2, figsize=(11, 3.8), layout="constrained")
    figure.suptitle(f"{regions:,} regions on {labels.shape[1]:,} × {labels.shape[0]:,} pixels", fontsize=11)
    print("length,regions,l_avg,mean,deviation,greatest,percent_under_2_l_avg")
    for panel, (name, values) in zip(panels, lengths.items()):
        draw(panel, name, values, l_avg)
        under = 100 * np.mean(values < 2 * l_avg)
        print(f"{name},{regions},{l_avg:.6f},{values.mean():.6f},{values.std():.6f},{values.max():.6f},{under:.6f}")
    try:
        figure.savefig(arguments.output, dpi=arguments.dpi)
    except OSError as error:
        sys.exit(f"plot_region_lengths.py: error: cannot write {arguments.output}: {error.strerror}")


if __name__ == "__main__":
    main()
