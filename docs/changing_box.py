#!/usr/bin/env python3
"""How many labels of a box that goes from square to 1.9 : 1 name the particle that is nearest in data units:
changing_box.py COMMAND. Needs NumPy and SciPy."""
import os
import subprocess
import sys
import tempfile

import numpy as np
from scipy.spatial import cKDTree

command = sys.argv[1]
FRAMES, WIDTH = 11, 800


def write_dump(path, count):
    """Uniformly random particles that go with a box of constant area; returns the boxes and the positions."""
    parts = np.random.default_rng(3).uniform(-0.5, 0.5, (count, 2))
    frames = []
    with open(path, "w") as file:
        for frame in range(FRAMES):
            ratio = 1 + 0.9 * frame / (FRAMES - 1)
            sides = np.array([30 * ratio**0.5, 30 / ratio**0.5])
            positions = parts * sides
            (x, y), rows = (sides / 2).tolist(), positions.tolist()
            file.write(f"ITEM: TIMESTEP\n{frame}\nITEM: NUMBER OF ATOMS\n{count}\nITEM: BOX BOUNDS pp pp pp\n"
                       f"{-x!r} {x!r}\n{-y!r} {y!r}\n-0.5 0.5\nITEM: ATOMS id x y\n")
            file.writelines(f"{i} {at!r} {above!r}\n" for i, (at, above) in enumerate(rows))
            frames.append((sides, positions))
    return frames


def equal_share(labels, shown, sides, positions):
    """Of the pixels in the box, where the labels show a rectangle with these sides about the origin."""
    height, width = labels.shape
    x = ((np.arange(width) + 0.5) / width - 0.5) * shown[0]
    y = (0.5 - (np.arange(height) + 0.5) / height) * shown[1]
    at = np.stack(np.meshgrid(x, y), axis=-1)
    inside = np.all(np.abs(at) < sides / 2, axis=-1)
    tree = cKDTree(np.mod(positions + sides / 2, sides), boxsize=sides)
    return 100 * np.mean(tree.query(at[inside] + sides / 2)[1] == labels[inside])


print("| particles | pixels per cell | `--fit` | least equal labels of a frame | greatest |")
print("| --- | --- | --- | --- | --- |")
for count in 150, 1200:
    with tempfile.TemporaryDirectory() as folder:
        dump = os.path.join(folder, "dump")
        frames = write_dump(dump, count)
        widest = np.max([sides for sides, _ in frames], axis=0)
        for fit in "frame", "all":
            subprocess.run([command, "simulate", "--trajectory", dump, "--width", str(WIDTH), "--fit", fit, "--labels",
                            folder + "/%d.npy"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            shares = [equal_share(np.load(f"{folder}/{i}.npy"), widest if fit == "all" else sides, sides, positions)
                      for i, (sides, positions) in enumerate(frames)]
            pixels = (WIDTH / widest[0])**2 * 900 / count
            print(f"| {count} | {pixels:.0f} | {fit} | {min(shares):.2f} % | {max(shares):.2f} % |")
