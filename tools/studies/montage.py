#!/usr/bin/python3
"""Lays pictures out in rows, each under its caption: montage.py -o out.png --columns 3 "caption=picture.png" ...
(needs python3-matplotlib). An empty argument leaves its place empty."""

import argparse
import math
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pictures", nargs="+", metavar="CAPTION=PICTURE")
    parser.add_argument("-o", "--output", required=True, metavar="PICTURE")
    parser.add_argument("--columns", type=int, default=3)
    parser.add_argument("--inches", type=float, default=2, help="width of each picture, at 100 dots an inch")
    arguments = parser.parse_args()
    rows = math.ceil(len(arguments.pictures) / arguments.columns)
    figure, panels = plt.subplots(
        rows, arguments.columns, squeeze=False, layout="constrained",
        figsize=(arguments.inches * arguments.columns, (arguments.inches + 0.25) * rows),
    )
    for panel in panels.flat:
        panel.axis("off")
    try:
        for panel, argument in zip(panels.flat, arguments.pictures):
            if not argument:
                continue
            caption, _, path = argument.rpartition("=")
            panel.imshow(plt.imread(path), interpolation="antialiased")
            panel.set_title(caption, fontsize=9)
        temporary = os.path.join(os.path.dirname(arguments.output), f".{os.getpid()}-montage.png")
        figure.savefig(temporary, dpi=100)
        os.replace(temporary, arguments.output)
    except OSError as error:
        sys.exit(f"montage.py: error: {error}")


if __name__ == "__main__":
    main()
