#!/usr/bin/env python3
"""The table of docs/moving_seeds.md on motions that are not what dJFA takes for granted: motions.py COMMAND CSV runs them
and writes the table's values; motions.py CSV DOCUMENT puts them into the document. Needs NumPy to run."""
import csv
import json
import os
import subprocess
import sys
import tempfile

SIDE, FRAMES = 1000, 100
METHODS = {"jfa": ["jfa"], "paper": ["djfa", "--reach", "paper"], "measured": ["djfa", "--reach", "measured"]}


def reflected(at):
    at = at % (2 * SIDE)
    return at + (at >= SIDE) * (2 * SIDE - 1 - 2 * at)


def motions():
    """Names, and the frames: arrays of pixels; NaN where a seed is absent."""
    import numpy as np

    rng = np.random.default_rng(1)
    uniform = rng.uniform

    def walk(start, step):
        at = np.clip(np.floor(start), 0, SIDE - 1)
        for _ in range(FRAMES + 1):
            yield at
            at = reflected(at + rng.integers(-step, step + 1, at.shape))

    def sweep():
        blob = rng.normal(0, 30, (2000, 2))
        for frame in range(FRAMES + 1):
            yield np.clip(np.floor(blob + [reflected(100 + 20 * frame), SIDE / 2]), 0, SIDE - 1)

    def appear():
        seeds = np.concatenate([uniform(0, SIDE, (3000, 2)) * [0.3, 1], uniform(0, SIDE, (300, 2))])
        for frame, at in enumerate(walk(seeds, 3)):
            yield np.where(np.arange(len(at))[:, None] < 3000 + 3 * frame, at, np.nan)

    def discs():
        for frame, at in enumerate(walk(uniform(0, SIDE, (5000, 2)), 3)):
            centre = 200 + 600 * np.random.default_rng(frame // 10).uniform(size=2)
            cleared = (np.hypot(*(at - centre).T) < 150) & (frame % 10 < 5)
            yield np.where(cleared[:, None], np.nan, at)

    def holes(radius, centres):
        seeds = uniform(0, SIDE, (10000, 2))
        return walk(seeds[np.all([np.hypot(*(seeds - centre).T) >= radius for centre in centres], axis=0)], 5)

    def turnover(each, seeds=10000, step=5):
        """So many seeds vanish in each frame, and as many that were not there appear anywhere."""
        alive = np.arange(seeds * 11 // 10) < seeds
        for at in walk(uniform(0, SIDE, (len(alive), 2)), step):
            yield np.where(alive[:, None], at, np.nan)
            changed = [rng.choice(np.flatnonzero(which), each, False) for which in (alive, ~alive)]
            alive[np.concatenate(changed)] ^= True

    lattice = np.stack(np.meshgrid(np.arange(32, SIDE, 64), np.arange(32, SIDE, 64)), -1).reshape(-1, 2)

    def clusters_of(count):
        return walk(np.repeat(lattice, count, 0) + rng.normal(0, 3, (256 * count, 2)), 4)

    def lines(apart):
        return np.stack(np.meshgrid(np.arange(0, SIDE, 2), np.arange(apart // 2, SIDE, apart)), -1).reshape(-1, 2)

    turn = uniform(0, 2 * np.pi, 3000)
    clusters = np.repeat(uniform(0, SIDE, (16, 2)), 625, 0) + rng.normal(0, SIDE / 50, (10000, 2))
    corners = np.concatenate([uniform(0, 60, (5000, 2)), uniform(SIDE - 60, SIDE, (5000, 2))])
    yield "10,000 seeds spread evenly, step 5", walk(uniform(0, SIDE, (10000, 2)), 5)
    yield "10,000 seeds in a corner of 60 x 60 pixels, step 20", walk(uniform(0, 60, (10000, 2)), 20)
    yield "two such corners of 5,000, step 20", walk(corners, 20)
    yield "16 clusters, step 20", walk(clusters, 20)
    yield "a line of 1,000 seeds, step 2", walk(np.stack([np.arange(SIDE), np.full(SIDE, 500)], 1), 2)
    yield "a blob that sweeps 20 pixels per frame", sweep()
    yield "3 seeds that jump anywhere", (np.floor(uniform(0, SIDE, (3, 2))) for _ in range(FRAMES + 1))
    yield "a lattice of clusters of 40, 64 apart, step 4", clusters_of(40)
    yield "lines 64 apart, step 2", walk(lines(64), 2)
    yield "a gradient, step 5", walk(np.stack([SIDE * np.sqrt(uniform(0, 1, 10000)), uniform(0, SIDE, 10000)], 1), 5)
    yield "a ring of 3,000 seeds, step 3", walk(500 + 400 * np.stack([np.cos(turn), np.sin(turn)], 1), 3)
    yield "seeds that appear in empty space", appear()
    yield "discs that are cleared and refilled", discs()
    yield "10,000 seeds less three holes of radius 75, step 5", holes(75, [(200, 200), (750, 300), (450, 780)])
    yield "10,000 seeds less a hole of radius 60, step 5", holes(60, [(500, 400)])
    yield "10,000 seeds, of which one vanishes per frame and one appears, step 5", turnover(1)
    yield "10,000 seeds, of which ten vanish per frame and ten appear, step 5", turnover(10)
    yield "a lattice of clusters of 3, 64 apart, step 4", clusters_of(3)
    yield "a lattice of clusters of 6, 64 apart, step 4", clusters_of(6)
    yield "lines 24 apart, step 1", walk(lines(24), 1)
    yield "30 seeds, of which three vanish per frame and three appear, step 3", turnover(3, 30, 3)


def write_trajectory(frames, path):
    with open(path, "w", encoding="utf-8") as file:
        for number, at in enumerate(frames):
            rows = [f"{i + 1} {x + 0.5} {y + 0.5} 0\n" for i, (x, y) in enumerate(at) if x == x]
            file.write(f"ITEM: TIMESTEP\n{number}\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS ff ff ff\n"
                       f"0 {SIDE}\n0 {SIDE}\n0 1\nITEM: ATOMS id x y z\n" + "".join(rows))


def far_pixels(at):
    """The percentages of pixels (one in 8 x 8) that are farther than L, and than 1.5 L, from their nearest seed."""
    import numpy as np

    seeds = at[at[:, 0] == at[:, 0]]
    x = np.arange(0, SIDE, 8)
    nearest = [((seeds[None] - np.stack([x, np.full_like(x, y)], -1)[:, None]) ** 2).sum(-1).min(1) for y in x]
    squared_length = SIDE * SIDE / len(seeds)
    return [f"{100 * np.mean(np.array(nearest) > factor * squared_length):.2f}" for factor in (1, 2.25)]


def measure(command, path):
    import numpy as np

    with open(path, "w", newline="", encoding="utf-8") as file, tempfile.TemporaryDirectory() as folder:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["motion", "method", "similarity_mean", "similarity_least", "waves_least", "waves_greatest",
                        "frames_from_seeds", "jfa_frames", "farther_than_l", "farther_than_1.5_l"])
        for name, frames in motions():
            trajectory = os.path.join(folder, "motion.lammpstrj")
            frames = [np.array(at) for at in frames]
            write_trajectory(frames, trajectory)
            far = far_pixels(frames[0])
            for method, options in METHODS.items():
                done = subprocess.run([command, "simulate", "--trajectory", trajectory, "--width", str(SIDE), "--method",
                                       *options, "--compare-with", "exact", "--json"],
                                      check=True, stdout=subprocess.PIPE)
                result = json.loads(done.stdout)
                similarity, waves = result["similarity"], {"least": result["waves"], "greatest": result["waves"]}
                plans = result.get("plans", {"waves": waves, "frames_from_seeds": FRAMES, "jfa_frames": FRAMES})
                table.writerow([name, method, f"{similarity['mean']:.4f}", f"{similarity['least']:.4f}",
                                *(int(plans["waves"][which]) for which in ("least", "greatest")),
                                plans["frames_from_seeds"], plans["jfa_frames"], *far])
                file.flush()


def write_table(path, document):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = ["| motion | paper's plan | measured | JFA | waves: paper's plan, measured, JFA | frames from the seeds | "
             "farther than L, 1.5 L (%) |", "| --- | --- | --- | --- | --- | --- | --- |"]
    for name in dict.fromkeys(row["motion"] for row in rows):
        of = {row["method"]: row for row in rows if row["motion"] == name}
        percents = [f"{of[m]['similarity_mean']}, {of[m]['similarity_least']}" for m in ("paper", "measured", "jfa")]
        waves = []
        for row in (of["paper"], of["measured"], of["jfa"]):
            least, greatest = row["waves_least"], row["waves_greatest"]
            waves.append(least if least == greatest else f"{least} to {greatest}")
        far = f"{of['jfa']['farther_than_l']}, {of['jfa']['farther_than_1.5_l']}"
        lines.append(f"| {name} | {' | '.join(percents)} | {'; '.join(waves)} | {of['measured']['frames_from_seeds']} | {far} |")
    with open(document, encoding="utf-8") as file:
        text = file.read()
    begin, end = "<!-- table motions -->\n", "<!-- end -->"
    before, rest = text.split(begin)
    with open(document, "w", encoding="utf-8") as file:
        file.write(before + begin + "\n".join(lines) + "\n" + end + rest.split(end, 1)[1])


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: motions.py COMMAND CSV, or motions.py CSV DOCUMENT")
    write_table(*sys.argv[1:]) if sys.argv[1].endswith(".csv") else measure(*sys.argv[1:])
