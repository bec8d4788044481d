#!/usr/bin/env python3
"""Times whole runs of the command, from start to end, as a user waits for them: a table of medians and minima,
and of the least processor time, which other work on the machine changes less.

Programs are interleaved, so that what else the machine does meets all of them. What a run cannot be faster than stands
below the table: the shortest run of the device, reading the trajectory, and writing one frame's labels.
"""

import argparse
import os
import pathlib
import random
import statistics
import subprocess
import tempfile
import time

WIDTH, HEIGHT = 2500, 2000


def write_trajectory(path, particles, frames):
    """A LAMMPS dump of particles that walk at random in a periodic box, their rows in no order."""
    numbers = random.Random(1)
    points = [(numbers.uniform(0, WIDTH), numbers.uniform(0, HEIGHT)) for _ in range(particles)]
    order = numbers.sample(range(particles), particles)
    with open(path, "w") as file:
        for frame in range(frames):
            file.write(f"ITEM: TIMESTEP\n{frame}\nITEM: NUMBER OF ATOMS\n{particles}\n")
            file.write(f"ITEM: BOX BOUNDS pp pp pp\n0 {WIDTH}\n0 {HEIGHT}\n-0.5 0.5\nITEM: ATOMS id type x y z\n")
            file.writelines(f"{i + 1} 1 {points[i][0]:.6g} {points[i][1]:.6g} 0\n" for i in order)
            points = [((x + numbers.gauss(0, 1)) % WIDTH, (y + numbers.gauss(0, 1)) % HEIGHT) for x, y in points]


def milliseconds(work):
    start = time.perf_counter()
    work()
    return 1000 * (time.perf_counter() - start)


def processor_milliseconds():
    times = os.times()
    return 1000 * (times.children_user + times.children_system)


def run(program, arguments, folder):
    subprocess.run([program, *arguments.split()], cwd=folder, check=True, capture_output=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", nargs="+", type=os.path.abspath, help="vorocl, of one build or several")
    parser.add_argument("--repeat", type=int, default=5, help="runs of each, behind one that is not counted")
    parser.add_argument("--particles", type=int, default=200_000)
    parser.add_argument("--frames", type=int, default=10)
    parser.add_argument("--only", nargs="+", default=[""], help="the runs whose names hold one of these texts")
    options = parser.parse_args()

    picture = "render --random 16384 --size 2048x2048"
    film = f"simulate --trajectory t.lammpstrj --size {WIDTH}x{HEIGHT}"
    cases = {
        "`render --labels`": f"{picture} --labels l.npy",
        "`render -o x.png`": f"{picture} -o x.png",
        "`simulate`, no output": film,
        "`simulate --statistics`": f"{film} --statistics s.csv",
        "`simulate --labels`": f"{film} --labels l%03d.npy",
        "`simulate --cells`": f"{film} --cells c%03d.csv",
        "`simulate --cells --cell-columns id,area`": f"{film} --cells c%03d.csv --cell-columns id,area",
        "`simulate -o x.mp4`": f"{film} -o x.mp4",
    }
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        trajectory = folder / "t.lammpstrj"
        write_trajectory(trajectory, options.particles, options.frames)
        print(f"Milliseconds per run, or per frame of {options.particles:,} particles: median (least; processor)\n")
        print("| run |" + "".join(f" {program} |" for program in options.programs))
        print("| --- |" + " --- |" * len(options.programs))
        for title, arguments in cases.items():
            if not any(text in title for text in options.only):
                continue
            parts = options.frames if arguments.startswith("simulate") else 1
            walls, processors = ({program: [] for program in options.programs} for _ in range(2))
            for _ in range(options.repeat + 1):
                for program in options.programs:
                    before = processor_milliseconds()
                    walls[program].append(milliseconds(lambda: run(program, arguments, folder)) / parts)
                    processors[program].append((processor_milliseconds() - before) / parts)
            row = f"| {title} |"
            for program in options.programs:
                wall = walls[program][1:]
                row += f" {statistics.median(wall):.0f} ({min(wall):.0f}; {min(processors[program][1:]):.0f}) |"
            print(row, flush=True)

        def least(work):
            return min(milliseconds(work) for _ in range(options.repeat + 1))

        def write_labels():
            with open(folder / "labels", "wb") as file:
                file.write(labels)
                os.fsync(file.fileno())

        labels = bytes(4 * WIDTH * HEIGHT)
        small = "render --random 1 --size 1x1 --labels l.npy"
        print(f"\nOne pixel: {least(lambda: run(options.programs[0], small, folder)):.0f} ms. "
              f"Reading the trajectory: {least(trajectory.read_bytes) / options.frames:.1f} ms per frame. "
              f"Writing its labels to disk: {least(write_labels):.0f} ms.")


if __name__ == "__main__":
    main()
