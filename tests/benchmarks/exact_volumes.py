#!/usr/bin/env python3
"""Times exact cells of periodic volumes beside Voro++ (its command), OVITO, freud, pyvoro2 and peclet.voro.

Needs the packages vorocl, ovito, freud-analysis, pyvoro2 and peclet-voro, and the command voro++; those that cannot do a set
are left out from there on. Programs are interleaved; the least of some runs by the clock is printed, the least processor time, which
other work on the machine changes less, and how many cells have as many neighbours as VoroCL's.
"""

import argparse
import os
import resource
import subprocess
import tempfile
import time

import freud
import numpy as np
import peclet.voro
import pyvoro2
from ovito.data import DataCollection
from ovito.modifiers import VoronoiAnalysisModifier

import vorocl


def uniform(count, random):
    return random.uniform(0, 1, (count, 3))


def clusters(count, random):
    middles, spreads = random.uniform(0.2, 0.8, (50, 3)), 10 ** random.uniform(-3, -1.5, 50)
    of = np.arange(count) % 50
    return (middles[of] + spreads[of, None] * random.standard_normal((count, 3))) % 1


def lattice(count, random, noise=0.0):
    side = round(count ** (1 / 3))
    places = np.stack(np.meshgrid(*[np.arange(side)] * 3), -1).reshape(-1, 3) + 0.5
    return (places + noise * random.standard_normal(places.shape)) / side


def noisy_lattice(count, random):
    return lattice(count, random, 0.02)


def weighted(count, random):
    """Radii of spheres besides, of up to 0.7 spacings."""
    return np.column_stack([uniform(count, random), random.uniform(0, 0.7 / count ** (1 / 3), count)])


def by_vorocl(points):
    weights = points[:, 3] ** 2 if points.shape[1] > 3 else None
    return vorocl.exact_cells(points[:, :3], (0, 0, 0, 1, 1, 1), periodic=(True,) * 3, weights=weights).cells["neighbours"]


def by_voropp(points):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "points")
        np.savetxt(path, np.column_stack([np.arange(len(points)), points]), fmt="%d" + " %.17g" * points.shape[1])
        radii = ["-r"] if points.shape[1] > 3 else []
        subprocess.run(["voro++", *radii, "-p", "-c", "%i %v %s %F %n", *["0", "1"] * 3, path], check=True)
        counts = np.zeros(len(points), int)
        with open(path + ".vol") as table:
            for line in table:
                fields = line.split()
                counts[int(fields[0])] = int(fields[2])
        return counts


def by_ovito(points):
    data = DataCollection()
    data.create_particles(count=len(points)).create_property("Position", data=points)
    data.create_cell(np.eye(3), pbc=(True, True, True))
    data.apply(VoronoiAnalysisModifier(generate_bonds=True))
    return np.array(data.particles["Coordination"])


def by_freud(points):
    found = freud.locality.Voronoi()
    found.compute((freud.box.Box.cube(1000), (points - 0.5) * 1000))
    return np.array(found.nlist.neighbor_counts)


def by_pyvoro2(points):
    domain = pyvoro2.OrthorhombicCell(((0, 1),) * 3, periodic=(True,) * 3)
    radii = {"mode": "power", "radii": points[:, 3]} if points.shape[1] > 3 else {}
    found = pyvoro2.compute(points[:, :3], domain=domain, return_vertices=False, return_adjacency=False, output="cells", **radii)
    counts = np.zeros(len(points), int)
    for cell in found:
        counts[cell["id"]] = len(cell["faces"])
    return counts


def by_peclet(points):
    cells = peclet.voro.Tessellation()
    cells.set_domain((1, 1, 1))
    cells.build(points)
    cells.get_volumes()
    return cells.get_neighbor_counts()


WORK = {
    "VoroCL": by_vorocl,
    "Voro++": by_voropp,
    "OVITO": by_ovito,
    "freud": by_freud,
    "pyvoro2": by_pyvoro2,
    "peclet.voro": by_peclet,
}


def processor_time():
    return sum(use.ru_utime + use.ru_stime for use in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=100_000)
    parser.add_argument("--sets", nargs="+", default=["uniform", "noisy_lattice", "lattice", "clusters", "weighted"])
    parser.add_argument("--without", nargs="*", default=[], help="programs")
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    print("| points | program | ms | processor ms | of Voro++'s | cells with other neighbours |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name in options.sets:
        points = globals()[name](options.points, np.random.default_rng(1))
        least, found = {}, {}
        for _ in range(options.repeat):
            for program, work in WORK.items():
                if program in options.without:
                    continue
                wall, processor = time.perf_counter(), processor_time()
                try:
                    found[program] = work(points)
                except Exception as error:  # whatever a program says
                    print(f"| {len(points):,} {name} | {program} | {error} |")
                    options.without.append(program)
                    continue
                taken = 1000 * (time.perf_counter() - wall), 1000 * (processor_time() - processor)
                least[program] = [min(pair) for pair in zip(taken, least.get(program, taken))]
        for program, (wall, processor) in least.items():
            other = np.count_nonzero(found[program] != found["VoroCL"])
            share = processor / least["Voro++"][1]
            print(f"| {len(points):,} {name} | {program} | {wall:.0f} | {processor:.0f} | {share:.2f} | {other} |", flush=True)


main()
