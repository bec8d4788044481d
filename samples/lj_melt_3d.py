"""Computes the Lennard-Jones melt lj-melt-3d.lammpstrj: lj_melt_3d.py FILE. Needs NumPy, and takes a minute or two.

864 particles in reduced units at the density 0.8442, as in LAMMPS's example "melt": they start on an fcc lattice, melt at
the temperature 3, are held at 0.9 for 600 steps and then move freely. Positions are rounded to four digits.
"""

import sys

import numpy as np

CELLS, DENSITY, STEP, CUTOFF = 6, 0.8442, 0.004, 2.5
side = CELLS * (4 / DENSITY) ** (1 / 3)
corners = np.stack(np.meshgrid(*[np.arange(CELLS)] * 3, indexing="ij"), axis=-1).reshape(-1, 1, 3)
positions = (corners + [[0, 0, 0], [0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]]).reshape(-1, 3) * side / CELLS
velocities = np.random.default_rng(87287).standard_normal(positions.shape)
velocities -= velocities.mean(axis=0)


def forces():
    total = np.zeros_like(positions)
    for i in range(0, len(positions), 108):
        ways = positions[i : i + 108, None] - positions
        ways -= side * np.round(ways / side)
        squares = (ways**2).sum(-1)
        squares[(squares == 0) | (squares > CUTOFF**2)] = np.inf
        sixth = squares**-3
        total[i : i + 108] = (((48 * sixth**2 - 24 * sixth) / squares)[..., None] * ways).sum(1)
    return total


def hold(temperature):
    global velocities
    velocities *= np.sqrt(temperature / (velocities**2).sum() * 3 * len(velocities))


with open(sys.argv[1], "w") as file:
    force = forces()
    for step in range(1501):
        if step < 700:
            hold(3.0 if step < 300 else 0.9)
        if step >= 1300 and step % 50 == 0:
            file.write(f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n{len(positions)}\nITEM: BOX BOUNDS pp pp pp\n")
            file.write(f"0 {side:.6f}\n" * 3 + "ITEM: ATOMS id type x y z\n")
            for id, position in enumerate(positions % side, 1):
                file.write(f"{id} 1 " + " ".join(f"{x:.4f}" for x in position) + "\n")
        velocities += STEP / 2 * force
        positions = positions + STEP * velocities
        force = forces()
        velocities += STEP / 2 * force
