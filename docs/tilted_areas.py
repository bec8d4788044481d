#!/usr/bin/env python3
"""How far areas and neighbours of cells of pixels are from those of cells that are cut as polygons, for the frames of a
trajectory whose box is sheared: tilted_areas.py COMMAND TRAJECTORY [WIDTH...]. Needs NumPy."""
import csv
import os
import subprocess
import sys
import tempfile

import numpy as np

command, trajectory = sys.argv[1:3]
widths = [int(width) for width in sys.argv[3:]] or [200, 800, 1600]


def measured(folder, *options):
    """Areas and numbers of neighbours, by frame and cell."""
    path = os.path.join(folder, "cells.csv")
    subprocess.run([command, "simulate", "--trajectory", trajectory, *options, "--cells", path, "--cell-columns",
                    "id,area,neighbours"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(path) as file:
        rows = [(int(row["frame"]), float(row["area"]), int(row["neighbours"])) for row in csv.DictReader(file)]
    frames, areas, neighbours = np.array(rows).T.reshape(3, int(rows[-1][0]) + 1, -1)
    return areas, neighbours


with tempfile.TemporaryDirectory() as folder:
    exact, edges = measured(folder, "--exact")
    print("| width | rms error of the area, first frame | all frames | greatest | equal numbers of neighbours |")
    print("| --- | --- | --- | --- | --- |")
    for width in widths:
        areas, neighbours = measured(folder, "--width", str(width))
        error = 100 * (areas / exact - 1)
        rms = np.sqrt(np.mean(error**2, axis=1))
        print(f"| {width} | {rms[0]:.2f} % | {np.sqrt(np.mean(rms**2)):.2f} % | {np.abs(error).max():.1f} % | "
              f"{100 * np.mean(neighbours == edges):.1f} % |")
