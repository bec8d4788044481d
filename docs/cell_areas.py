#!/usr/bin/env python3
"""How far areas of cells are from those that freud computes, for a frame of a LAMMPS dump whose box is periodic in x and y:
cell_areas.py COMMAND DUMP. Needs NumPy and freud-analysis."""
import csv
import os
import subprocess
import sys
import tempfile

import freud
import numpy as np

command, dump = sys.argv[1:]
with open(dump) as file:
    lines = file.read().split("\n")
count = int(lines[3])
(x0, x1), (y0, y1) = ([float(bound) for bound in line.split()[:2]] for line in lines[5:7])
columns = lines[8].split()[2:]
rows = np.array([[float(value) for value in line.split()] for line in lines[9 : 9 + count]])
ids = rows[:, columns.index("id")].astype(int)
width, height = x1 - x0, y1 - y0
positions = np.zeros((count, 3))
positions[:, 0] = rows[:, columns.index("x")] - (x0 + x1) / 2
positions[:, 1] = rows[:, columns.index("y")] - (y0 + y1) / 2
voronoi = freud.locality.Voronoi()
voronoi.compute((freud.box.Box(width, height, is2D=True), positions))
neighbours = np.bincount(np.asarray(voronoi.nlist[:])[:, 0], minlength=count)

print("| width | pixels per cell | periodic | rms error of the area | greatest | equal numbers of neighbours |")
print("| --- | --- | --- | --- | --- | --- |")
for pixels in 200, 800, 1600, 3200:
    for axes in "none", "xy":
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "cells.csv")
            subprocess.run([command, "cells", "--trajectory", dump, "--width", str(pixels), "--periodic", axes,
                            "--cells", path], check=True, stdout=subprocess.DEVNULL)
            with open(path) as file:
                cells = {int(cell["id"]): cell for cell in csv.DictReader(file)}
        area = np.array([float(cells[i]["area"]) for i in ids])
        error = area * (width * height / area.sum()) / voronoi.volumes - 1
        equal = np.mean([int(cells[i]["neighbours"]) for i in ids] == neighbours)
        print(f"| {pixels} | {area.sum() / count:.0f} | {axes} | {100 * np.sqrt(np.mean(error**2)):.2f} % | "
              f"{100 * np.abs(error).max():.1f} % | {100 * equal:.1f} % |")
