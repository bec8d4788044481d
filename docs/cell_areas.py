#!/usr/bin/env python3
"""How far areas, neighbours and perimeters of cells are from those that Voro++ and freud compute from the positions, for the
first frame of a LAMMPS dump whose box is periodic in x and y: cell_areas.py COMMAND DUMP [WIDTH...]. Needs NumPy,
freud-analysis and the command voro++."""
import csv
import os
import subprocess
import sys
import tempfile

import freud
import numpy as np

command, dump = sys.argv[1:3]
widths = [int(width) for width in sys.argv[3:]] or [200, 800, 1600, 3200]


def read_frame(path):
    """The ids and positions of the first frame, and the bounds of its box."""
    with open(path) as file:
        lines = file.read().split("\n")
    count = int(lines[3])
    bounds = [[float(bound) for bound in line.split()[:2]] for line in lines[5:7]]
    columns = lines[8].split()[2:]
    rows = np.array([[float(value) for value in line.split()] for line in lines[9 : 9 + count]])
    return rows[:, columns.index("id")].astype(int), rows[:, [columns.index("x"), columns.index("y")]], bounds


def of_freud(positions, bounds):
    """Areas and numbers of neighbours."""
    (x0, x1), (y0, y1) = bounds
    centred = np.zeros((len(positions), 3))
    centred[:, :2] = positions - [(x0 + x1) / 2, (y0 + y1) / 2]
    voronoi = freud.locality.Voronoi()
    voronoi.compute((freud.box.Box(x1 - x0, y1 - y0, is2D=True), centred))
    return voronoi.volumes, np.bincount(np.asarray(voronoi.nlist[:])[:, 0], minlength=len(positions))


def of_voro(ids, positions, bounds, folder):
    """Areas, numbers of neighbours and perimeters: those of a layer of height 1."""
    (x0, x1), (y0, y1) = bounds
    path = os.path.join(folder, "particles")
    with open(path, "w") as file:
        file.writelines(f"{i} {x!r} {y!r} 0\n" for i, (x, y) in zip(ids, positions.tolist()))
    sides = [repr(side) for side in (x0, x1, y0, y1, -0.5, 0.5)]
    subprocess.run(["voro++", "-px", "-py", "-c", "%i %v %s %F", *sides, path], check=True, stdout=subprocess.DEVNULL)
    cells = {int(row[0]): row[1:] for row in np.loadtxt(path + ".vol")}
    area, faces, surface = np.array([cells[i] for i in ids]).T
    return area, faces - 2, surface - 2 * area


def of_raster(ids, width, axes, folder):
    """Areas, numbers of neighbours and perimeters."""
    path = os.path.join(folder, "cells.csv")
    subprocess.run([command, "cells", "--trajectory", dump, "--width", str(width), "--periodic", axes, "--cells", path],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(path) as file:
        cells = {int(cell["id"]): cell for cell in csv.DictReader(file)}
    return (np.array([float(cells[i][column]) for i in ids]) for column in ("area", "neighbours", "perimeter"))


def rms(errors):
    return 100 * np.sqrt(np.mean(errors**2))


ids, positions, bounds = read_frame(dump)
with tempfile.TemporaryDirectory() as folder:
    area, neighbours, perimeter = of_voro(ids, positions, bounds, folder)
    freud_area, freud_neighbours = of_freud(positions, bounds)
    difference = np.abs(freud_area / area - 1).max()
    print(f"freud and Voro++: areas differ by at most {difference:.1e}, numbers of neighbours in "
          f"{np.sum(freud_neighbours != neighbours)} cells of {len(ids)}\n")
    print("| width | pixels per cell | periodic | rms error of the area | greatest | equal numbers of neighbours | "
          "mean perimeter, to that of Voro++ |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for width in widths:
        (x0, x1), (y0, y1) = bounds
        pixels = width * round(width * (y1 - y0) / (x1 - x0)) / len(ids)
        for axes in "none", "xy":
            found, found_neighbours, found_perimeter = of_raster(ids, width, axes, folder)
            error = found / area - 1
            print(f"| {width} | {pixels:.0f} | {axes} | {rms(error):.2f} % | {100 * np.abs(error).max():.1f} % | "
                  f"{100 * np.mean(found_neighbours == neighbours):.1f} % | "
                  f"{found_perimeter.mean() / perimeter.mean():.3f} |")
