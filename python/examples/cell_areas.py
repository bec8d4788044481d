"""Cell areas of particles that condense into clusters: cell_areas.py PICTURE. Needs MDAnalysis and matplotlib."""

import io
import re
import sys
import warnings
from pathlib import Path

import matplotlib
import MDAnalysis
import numpy as np
from MDAnalysis.lib.util import NamedStream

import vorocl

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

warnings.filterwarnings("ignore", module="MDAnalysis")  # a dump has no masses, and none are needed
dump = (Path(__file__).parents[2] / "samples" / "lj-clusters.lammpstrj").read_text()
# MDAnalysis wants three coordinates, and these particles live in a plane: all get z = 0.
dump = re.sub(r"(?m)^(\d+ \d+ \S+ \S+)\s*$", r"\1 0", dump).replace("id type x y", "id type x y z")
stream = NamedStream(io.StringIO(dump), "lj-clusters.lammpstrj")
universe = MDAnalysis.Universe(stream, format="LAMMPSDUMP", topology_format="LAMMPSDUMP")

width, height = universe.dimensions[:2]
shape = round(1200 * height / width), 1200
simulation = vorocl.Simulation(shape, bounds=(0, 0, width, height), periodic=(True, True), y_up=True)

steps, percentiles = [], []
for frame in universe.trajectory:
    diagram = simulation.step(frame.positions[:, :2])
    areas = diagram.areas()  # in the units of the simulation
    steps.append(frame.data["step"])
    percentiles.append(np.percentile(areas, [5, 25, 50, 75, 95]))

figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4), layout="constrained")
picture = left.imshow(np.log10(areas)[diagram.read()], extent=(0, width, 0, height), cmap="viridis")
left.set(title=f"step {steps[-1]}", xlabel="x / σ", ylabel="y / σ")
figure.colorbar(picture, ax=left, label="log$_{10}$(area of the cell / σ²)")
for values, label in zip(np.transpose(percentiles), ["5 %", "25 %", "median", "75 %", "95 %"]):
    right.plot(steps, values, "o-", label=label)
right.set(title="3,000 cells", xlabel="step", ylabel="area / σ²", yscale="log")
right.legend(loc="center left", bbox_to_anchor=(1, 0.5))
figure.savefig(sys.argv[1], dpi=100)
