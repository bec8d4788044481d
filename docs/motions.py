#!/usr/bin/env python3
"""The table of docs/moving_seeds.md on motions that are not what dJFA takes for granted: motions.py COMMAND CSV [ROW]... runs
them, or those of some rows, and writes the table's values; motions.py CSV DOCUMENT puts them into the document. Needs NumPy to
run."""
import csv
import json
import os
import subprocess
import sys
import tempfile

SIDE, FRAMES = 1000, 100
METHODS = {"jfa": ["jfa"], "paper": ["djfa", "--reach", "paper"], "measured": ["djfa", "--reach", "measured"]}


def motions():
    """Names, numbers of the generator, frames, and options of the command. Frames are arrays of pixels; NaN where a seed is
    absent. `--periodic` stands for a periodic box, and `--side` for its side."""
    import numpy as np

    def reflected(at, side=SIDE):
        at = at % (2 * side)
        return at + (at >= side) * (2 * side - 1 - 2 * at)

    def even(rng, seeds, side=SIDE):
        return rng.uniform(0, side, (seeds, 2))

    def lattice(apart):
        line = np.arange(apart // 2, SIDE, apart)
        return np.stack(np.meshgrid(line, line), -1).reshape(-1, 2).astype(float)

    def circle(centre, radius, turn):
        return np.array(centre) + radius * np.stack([np.cos(turn), np.sin(turn)], 1)

    def walk(rng, start, step):
        at = np.clip(np.floor(start), 0, SIDE - 1)
        for _ in range(FRAMES + 1):
            yield at
            at = reflected(at + rng.integers(-step, step + 1, at.shape))

    def sweep(rng):
        blob = rng.normal(0, 30, (2000, 2))
        for frame in range(FRAMES + 1):
            yield np.clip(np.floor(blob + [reflected(100 + 20 * frame), SIDE / 2]), 0, SIDE - 1)

    def anywhere(rng, seeds):
        return (np.floor(even(rng, seeds)) for _ in range(FRAMES + 1))

    def appear(rng):
        seeds = np.concatenate([even(rng, 3000) * [0.3, 1], even(rng, 300)])
        for frame, at in enumerate(walk(rng, seeds, 3)):
            yield np.where(np.arange(len(at))[:, None] < 3000 + 3 * frame, at, np.nan)

    def cleared(frames, where):
        """The seeds are absent in the frames and at the places that a function tells."""
        for frame, at in enumerate(frames):
            yield np.where(where(at, frame)[:, None], np.nan, at)

    def in_disc(at, frame):
        centre = 200 + 600 * np.random.default_rng(frame // 10).uniform(size=2)
        return (np.hypot(*(at - centre).T) < 150) & (frame % 10 < 5)

    def holes(rng, radius, centres):
        seeds = even(rng, 10000)
        return walk(rng, seeds[np.all([np.hypot(*(seeds - centre).T) >= radius for centre in centres], axis=0)], 5)

    def turnover(rng, each, seeds=10000, step=5):
        """So many seeds vanish in each frame, and as many that were not there appear anywhere."""
        alive = np.arange(seeds * 11 // 10) < seeds
        for at in walk(rng, even(rng, len(alive)), step):
            yield np.where(alive[:, None], at, np.nan)
            changed = [rng.choice(np.flatnonzero(which), each, False) for which in (alive, ~alive)]
            alive[np.concatenate(changed)] ^= True

    def clusters_of(rng, count):
        return walk(rng, np.repeat(lattice(64), count, 0) + rng.normal(0, 3, (256 * count, 2)), 4)

    def lines(apart):
        return np.stack(np.meshgrid(np.arange(0, SIDE, 2), np.arange(apart // 2, SIDE, apart)), -1).reshape(-1, 2)

    def voids(rng, centres, radius, rim, step=5, start=None, turn=None, drift=0, side=SIDE, wraps=False):
        """Seeds walk, or drift too, outside discs, each with more seeds on its rim. `radius` and `centres` may depend on the
        frame. With `turn` the rims stay circles, which turn by so many pixels in a frame; else their seeds walk as others."""
        def at_frame(value, frame):
            return value(frame) if callable(value) else value

        at = np.floor(even(rng, side * side // 100, side) if start is None else start)
        turns = rng.uniform(0, 2 * np.pi, rim)
        if turn is None:
            first = at_frame(radius, 0)
            at = np.concatenate([at] + [circle(centre, first + 1, turns) for centre in at_frame(centres, 0)])
        for frame in range(FRAMES + 1):
            discs, most = at_frame(centres, frame), at_frame(radius, frame)
            for centre in discs:
                way = at - centre
                if wraps:
                    way -= side * np.round(way / side)
                far = np.maximum(np.hypot(*way.T), 1)[:, None]
                at = np.where(far <= most, np.round(centre + way / far * (most + 1)), at)
            at = at % side if wraps else np.clip(np.floor(at), 0, side - 1)
            rims = [] if turn is None else [circle(c, most + 1, turns + turn * frame / max(most, 1)) for c in discs]
            rims = [np.round(ring) % side if wraps else np.clip(np.round(ring), 0, side - 1) for ring in rims]
            yield np.concatenate([at, *rims])
            at = at + rng.integers(-step, step + 1, at.shape) + [drift, 0]
            at = at % side if wraps else reflected(at, side)

    def grid(count):
        return [((i + 0.5) * SIDE / count, (j + 0.5) * SIDE / count) for i in range(count) for j in range(count)]

    def spun(shape, turn):
        """A shape that turns around the centre."""
        for frame in range(FRAMES + 1):
            cosine, sine = np.cos(turn * frame), np.sin(turn * frame)
            yield np.clip(np.floor(shape @ np.array([[cosine, sine], [-sine, cosine]]) + SIDE / 2), 0, SIDE - 1)

    def roads(rng, apart, gap, slide):
        """Pairs of dense lines, which slide, and seeds that walk between."""
        middles = np.arange(apart // 2, SIDE, apart)
        x = np.arange(0, SIDE, 2)
        for frame, at in enumerate(walk(rng, even(rng, 8000), 1)):
            off = np.min(np.abs(at[:, 1, None] - middles), 1) > gap // 2
            yield np.concatenate([np.where(off[:, None], at, np.nan)] + [
                np.stack([(x + slide * frame) % SIDE, np.full(len(x), y + way)], 1)
                for y in middles for way in (-gap // 2, gap // 2)])

    def counterflow(rng, step):
        at = np.floor(even(rng, 10000))
        for _ in range(FRAMES + 1):
            yield at
            at = (at + np.where(at[:, 1, None] < SIDE / 2, [step, 0], [-step, 0])) % SIDE

    def front(rng):
        """A half plane of seeds whose front comes nearer to a lone seed, and goes back."""
        seeds = even(rng, 8000)
        for frame in range(FRAMES + 1):
            at = np.floor(seeds * [0.3 + 0.5 * abs(frame - 50) / 50, 1])
            yield np.concatenate([at, [[SIDE - 1, 20]]])

    def thinned(rng, walls):
        """One of three neighbouring pixels of walls, drawn anew in each frame, and nothing else."""
        threes = walls[:len(walls) // 3 * 3].reshape(-1, 3, 2)
        threes = threes[np.ptp(threes, axis=1).max(1) < 4]  # not of two walls
        for _ in range(FRAMES + 1):
            yield np.floor(threes[np.arange(len(threes)), rng.integers(0, 3, len(threes))])

    def walls_at(heights, slope=0):
        x = np.arange(SIDE)
        walls = np.concatenate([np.stack([x, y + slope * x], 1) for y in heights])
        return walls[(walls[:, 1] >= 0) & (walls[:, 1] < SIDE)]

    def honeycomb(inner):
        """The walls of hexagons that circles of that radius fill."""
        corners = inner * 2 / np.sqrt(3) * np.stack([np.cos(np.arange(7) * np.pi / 3), np.sin(np.arange(7) * np.pi / 3)], 1)
        along = np.linspace(0, 1, int(inner), endpoint=False)[:, None]
        hexagon = np.concatenate([a + along * (b - a) for a, b in zip(corners, corners[1:])])
        centres = [(i * inner * np.sqrt(3), (2 * j + i % 2) * inner) for i in range(-1, 12) for j in range(-1, 11)]
        walls = np.floor(np.concatenate([hexagon + centre for centre in centres]))
        return walls[np.all((walls >= 0) & (walls < SIDE), axis=1)]

    def shapes(rng, centres, curve, inside):
        """Seeds walk outside closed curves, and absent within them; the seeds of the curves are as a function of the frame has
        them, around the centres."""
        for frame, at in enumerate(walk(rng, even(rng, 10000), 1)):
            hidden = np.any([inside(at - centre, frame) for centre in centres], axis=0)
            rims = np.concatenate([np.floor(curve(rng, frame) + centre) for centre in centres])
            yield np.concatenate([np.where(hidden[:, None], np.nan, at), np.clip(rims, 0, SIDE - 1)])

    def polar(radius, seeds):
        """A rim whose radius depends on the direction and the frame."""
        turns = np.arange(seeds) * 2 * np.pi / seeds
        return (lambda rng, frame: radius(turns, frame)[:, None] * np.stack([np.cos(turns), np.sin(turns)], 1),
                lambda way, frame: np.hypot(*way.T) < radius(np.arctan2(way[:, 1], way[:, 0]), frame))

    def diamond(rng, _):
        x = np.repeat(np.arange(-58, 59, 2), 2) + rng.integers(-1, 2, 118)
        return np.stack([x, (59 - np.abs(x)) * np.tile([-1, 1], 59)], 1)

    def ellipse(turn, frame):
        turn = turn - 0.02 * frame
        return 26 * 240 / np.hypot(26 * np.cos(turn), 240 * np.sin(turn))

    square = np.concatenate([np.stack([np.linspace(-60, 60, 150), np.full(150, 61 * sign)], 1)[:, ::way]
                             for sign in (-1, 1) for way in (-1, 1)])
    arms = np.linspace(5, 480, 3000)
    spiral = arms[:, None] * np.stack([np.cos(arms / 25), np.sin(arms / 25)], 1)
    star = np.concatenate([np.arange(20, 490, 2)[:, None] * [[np.cos(t), np.sin(t)]] for t in np.arange(12) * np.pi / 6])
    streets = np.concatenate([np.stack(np.meshgrid(np.arange(0, SIDE, 2), np.arange(60, SIDE, 120)), -1).reshape(-1, 2)[:, ::way]
                              for way in (1, -1)])

    def around_square(rng):
        outside = even(rng, 10000) - SIDE / 2
        outside = outside[np.max(np.abs(outside), 1) > 61]
        return spun(np.concatenate([outside, square]), 0.03)

    def clusters(rng):
        return np.repeat(even(rng, 16), 625, 0) + rng.normal(0, SIDE / 50, (10000, 2))

    def corners(rng):
        return np.concatenate([rng.uniform(0, 60, (5000, 2)), rng.uniform(SIDE - 60, SIDE, (5000, 2))])

    def gradient(rng):
        return np.stack([SIDE * np.sqrt(rng.uniform(0, 1, 10000)), rng.uniform(0, SIDE, 10000)], 1)

    middle, periodic = [(500, 400)], ["--periodic"]
    rows = [
        ("10,000 seeds spread evenly, step 5", lambda rng: walk(rng, even(rng, 10000), 5)),
        ("10,000 seeds in a corner of 60 x 60 pixels, step 20", lambda rng: walk(rng, rng.uniform(0, 60, (10000, 2)), 20)),
        ("two such corners of 5,000, step 20", lambda rng: walk(rng, corners(rng), 20)),
        ("16 clusters, step 20", lambda rng: walk(rng, clusters(rng), 20)),
        ("a line of 1,000 seeds, step 2", lambda rng: walk(rng, np.stack([np.arange(SIDE), np.full(SIDE, 500)], 1), 2)),
        ("a blob that sweeps 20 pixels per frame", sweep),
        ("3 seeds that jump anywhere", lambda rng: anywhere(rng, 3)),
        ("a lattice of clusters of 40, 64 apart, step 4", lambda rng: clusters_of(rng, 40)),
        ("lines 64 apart, step 2", lambda rng: walk(rng, lines(64), 2)),
        ("a gradient, step 5", lambda rng: walk(rng, gradient(rng), 5)),
        ("a ring of 3,000 seeds, step 3", lambda rng: walk(rng, circle((500, 500), 400, rng.uniform(0, 2 * np.pi, 3000)), 3)),
        ("seeds that appear in empty space", appear),
        ("discs that are cleared and refilled", lambda rng: cleared(walk(rng, even(rng, 5000), 3), in_disc)),
        ("10,000 seeds less three holes of radius 75, step 5", lambda rng: holes(rng, 75, [(200, 200), (750, 300), (450, 780)])),
        ("10,000 seeds less a hole of radius 60, step 5", lambda rng: holes(rng, 60, middle)),
        ("10,000 seeds, of which one vanishes per frame and one appears, step 5", lambda rng: turnover(rng, 1)),
        ("10,000 seeds, of which ten vanish per frame and ten appear, step 5", lambda rng: turnover(rng, 10)),
        ("a lattice of clusters of 3, 64 apart, step 4", lambda rng: clusters_of(rng, 3)),
        ("a lattice of clusters of 6, 64 apart, step 4", lambda rng: clusters_of(rng, 6)),
        ("lines 24 apart, step 1", lambda rng: walk(rng, lines(24), 1)),
        ("30 seeds, of which three vanish per frame and three appear, step 3", lambda rng: turnover(rng, 3, 30, 3)),
        # Voids among 10,000 seeds that are else spread evenly, which no seed enters, with crowded rims.
        ("a void of radius 64 with 600 seeds on its rim, step 5", lambda rng: voids(rng, middle, 64, 600)),
        ("a void of radius 60 with 300, step 5", lambda rng: voids(rng, middle, 60, 300)),
        ("the same, step 1", lambda rng: voids(rng, middle, 60, 300, 1)),
        ("a rim of 300 that collapses", lambda rng: voids(rng, middle, lambda f: 90 - 0.8 * f, 300, 1, turn=0)),
        ("a rim of 200 that spins while all else stands still", lambda rng: voids(rng, middle, 60, 200, 0, turn=3)),
        ("a void that opens", lambda rng: voids(rng, middle, lambda f: 0.8 * f, 0)),
        ("the same, periodic", lambda rng: voids(rng, middle, lambda f: 0.8 * f, 0, wraps=True), periodic),
        ("an obstacle in a periodic stream", lambda rng: voids(rng, middle, 60, 0, 1, drift=3, wraps=True), periodic),
        ("a ring of 600 that expands", lambda rng: voids(rng, [(500, 500)], lambda f: 20 + f, 600, turn=0)),
        ("a void that moves", lambda rng: voids(rng, lambda f: [(200 + 5 * f, 500)], 60, 300)),
        ("a void at the border", lambda rng: voids(rng, [(0, 500)], 60, 300)),
        ("a void in a corner", lambda rng: voids(rng, [(0, 0)], 80, 300)),
        ("40,000 seeds on 2000 x 2000, three voids of radius 70",
         lambda rng: voids(rng, [(400, 500), (1500, 700), (900, 1500)], 70, 600, side=2000), ["--side", "2000"]),
        # Invented to break the present rule: rims that the waves just reach, thin cells, holes between measured rows.
        ("64 spinning rims of 100, radius 16, in a lattice 12 apart", lambda rng: voids(rng, grid(8), 16, 100, 0, lattice(12), 1.5)),
        ("64 spinning rims of 60, radius 12, in a lattice 12 apart", lambda rng: voids(rng, grid(8), 12, 60, 0, lattice(12), 3)),
        ("16 voids of radius 23 with 150, spinning", lambda rng: voids(rng, grid(4), 23, 150, 1, turn=3)),
        ("16 voids of radius 55 with 300, spinning", lambda rng: voids(rng, grid(4), 55, 300, 1, turn=3)),
        ("4 voids of radius 119 with 1,200, spinning", lambda rng: voids(rng, grid(2), 119, 1200, 1, turn=3)),
        ("a void of radius 246 with 2,000, spinning", lambda rng: voids(rng, grid(1), 246, 2000, 1, turn=3)),
        ("a void of radius 170 in a corner with 800, step 2", lambda rng: voids(rng, [(0, 0)], 170, 800, 2)),
        ("a square void of side 122 with crowded sides, turning", around_square),
        ("pairs of dense lines 24 apart, sliding", lambda rng: roads(rng, 120, 24, 3)),
        ("a spiral of 3,000, turning", lambda rng: spun(spiral, 0.02)),
        ("a star of 12 rays, turning", lambda rng: spun(star, 0.01)),
        ("streets 120 apart, step 1", lambda rng: walk(rng, streets, 1)),
        ("two halves that flow past each other, 13 per frame, periodic", lambda rng: counterflow(rng, 13), periodic),
        ("seeds in rows that are not measured, of which half are absent in every second frame",
         lambda rng: cleared(walk(rng, lines(8) - [0, 4], 0), lambda at, f: (at[:, 1] % 16 < 8) & (f % 2 == 1))),
        ("a strip of 60 columns that is cleared in every second frame",
         lambda rng: cleared(walk(rng, even(rng, 10000), 3), lambda at, f: (np.abs(at[:, 0] - 500) < 30) & (f % 2 == 1))),
        ("a front that comes nearer to a lone seed", front),
        ("a void of radius 60 with 300, spinning, Manhattan", lambda rng: voids(rng, middle, 60, 300, 1, turn=3),
         ["--metric", "manhattan"]),
        ("a void of radius 110 across the ends of periods with 1,000, spinning",
         lambda rng: voids(rng, [(0, 0)], 110, 1000, 1, turn=3, wraps=True), periodic),
        ("3,000 seeds spread evenly, step 40", lambda rng: walk(rng, even(rng, 3000), 40)),
        ("100 seeds spread evenly, step 25", lambda rng: walk(rng, even(rng, 100), 25)),
        # Invented to break the rule of the waves: rims at distances that the least plan just reaches, where JFA's other waves give
        # labels more ways, on periodic grids around the world too.
        ("36 voids of radius 26 with 170, spinning", lambda rng: voids(rng, grid(6), 26, 170, 1, turn=3)),
        ("16 voids of radius 58 with 370, spinning", lambda rng: voids(rng, grid(4), 58, 370, 1, turn=3)),
        ("4 voids of radius 122 with 770, spinning", lambda rng: voids(rng, grid(2), 122, 770, 1, turn=3)),
        ("a void of radius 250 with 1,570, spinning", lambda rng: voids(rng, grid(1), 250, 1570, 1, turn=3)),
        ("16 voids of radius 58 with 90, spinning", lambda rng: voids(rng, grid(4), 58, 90, 1, turn=3)),
        ("36 voids of radius 26 with 170, spinning, periodic",
         lambda rng: voids(rng, grid(6), 26, 170, 1, turn=3, wraps=True), periodic),
        ("a void of radius 26 with 170 on 130 x 130, spinning, periodic",
         lambda rng: voids(rng, [(65, 65)], 26, 170, 1, turn=3, side=130, wraps=True), ["--side", "130", "--periodic"]),
        ("a void of radius 58 with 370 on 260 x 260, spinning, periodic",
         lambda rng: voids(rng, [(130, 130)], 58, 370, 1, turn=3, side=260, wraps=True), ["--side", "260", "--periodic"]),
        ("a void of radius 122 with 770 on 515 x 515, spinning, periodic",
         lambda rng: voids(rng, [(257, 257)], 122, 770, 1, turn=3, side=515, wraps=True), ["--side", "515", "--periodic"]),
        ("lines 54 apart, one of three of their pixels, drawn anew in each frame", lambda rng: thinned(rng, walls_at(range(27, SIDE, 54)))),
        ("lines 118 apart, the same", lambda rng: thinned(rng, walls_at(range(59, SIDE, 118)))),
        ("lines of slope 1/3, 124 apart along y, the same", lambda rng: thinned(rng, walls_at(range(-300, SIDE, 124), 1 / 3))),
        ("a honeycomb of walls around circles of radius 59, the same", lambda rng: thinned(rng, honeycomb(59))),
        ("4 voids of radius 118 with 740 and a seed in the middle of each, spinning",
         lambda rng: (np.concatenate([at, np.floor(grid(2))]) for at in voids(rng, grid(2), 118, 740, 1, turn=3))),
        ("16 diamonds of radius 59 with 118 that jump by a pixel, Manhattan",
         lambda rng: shapes(rng, grid(4), diamond, lambda way, _: np.abs(way).sum(1) < 59), ["--metric", "manhattan"]),
        ("1,700 seeds spread evenly, step 5", lambda rng: walk(rng, even(rng, 1700), 5)),
        ("8,000 seeds spread evenly that drift, periodic",
         lambda rng: voids(rng, [], 0, 0, 2, even(rng, 8000), drift=3, wraps=True), periodic),
        ("16 flowers of radius 53 to 63 with 400, turning", lambda rng: shapes(
            rng, grid(4), *polar(lambda turn, f: 58 + 5 * np.sin(7 * turn + 0.1 * f), 400))),
        ("4 ellipses of 26 by 240 with 800, turning", lambda rng: shapes(rng, grid(2), *polar(ellipse, 800))),
        ("16 voids of radius 50 to 66 with 300 that breathe", lambda rng: voids(
            rng, grid(4), lambda f: 58 + 8 * np.sin(0.3 * f), 300, 1, turn=0)),
        ("a void of radius 60 with 200 on 150 x 150, spinning, periodic",
         lambda rng: voids(rng, [(75, 75)], 60, 200, 1, turn=3, side=150, wraps=True), ["--side", "150", "--periodic"]),
        ("a void of radius 46 with 70, and 18 seeds outside, on 150 x 150, spinning, periodic", lambda rng: voids(
            rng, [(75, 75)], 46, 70, 1, even(rng, 18, 150), turn=3, side=150, wraps=True), ["--side", "150", "--periodic"]),
        ("a void of radius 46 with 60, and 6 seeds outside, on 130 x 130, spinning, periodic", lambda rng: voids(
            rng, [(65, 65)], 46, 60, 1, even(rng, 6, 130), turn=3, side=130, wraps=True), ["--side", "130", "--periodic"]),
    ]
    for number, (name, make, *options) in enumerate(rows, 1):
        yield name, number, make(np.random.default_rng(number)), options[0] if options else []


def write_trajectory(frames, path, side, periodic):
    ends = "pp pp ff" if periodic else "ff ff ff"
    with open(path, "w", encoding="utf-8") as file:
        for number, at in enumerate(frames):
            rows = [f"{i + 1} {x + 0.5} {y + 0.5} 0\n" for i, (x, y) in enumerate(at) if x == x]
            file.write(f"ITEM: TIMESTEP\n{number}\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS {ends}\n"
                       f"0 {side}\n0 {side}\n0 1\nITEM: ATOMS id x y z\n" + "".join(rows))


def measure(command, path, wanted=()):
    with open(path, "w", newline="", encoding="utf-8") as file, tempfile.TemporaryDirectory() as folder:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["motion", "rng_seed", "method", "similarity_mean", "similarity_least", "waves_least", "waves_greatest"])
        for name, rng_seed, frames, options in motions():
            if wanted and rng_seed not in wanted:
                continue
            side = int(options[1]) if "--side" in options else SIDE
            metric = options if "--metric" in options else []
            trajectory = os.path.join(folder, "motion.lammpstrj")
            write_trajectory(frames, trajectory, side, "--periodic" in options)
            for method, of_method in METHODS.items():
                done = subprocess.run([command, "simulate", "--trajectory", trajectory, "--width", str(side), "--method",
                                       *of_method, *metric, "--compare-with", "exact", "--json"],
                                      check=True, stdout=subprocess.PIPE)
                result = json.loads(done.stdout)
                similarity, waves = result["similarity"], {"least": result["waves"], "greatest": result["waves"]}
                waves = result["plans"]["waves"] if "plans" in result else waves
                table.writerow([name, rng_seed, method, f"{similarity['mean']:.4f}", f"{similarity['least']:.4f}",
                                int(waves["least"]), int(waves["greatest"])])
                file.flush()


def write_table(path, document):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    lines = ["| rng seed | motion | paper's plan | measured | JFA | waves: paper's plan, measured, JFA |",
             "| --- | --- | --- | --- | --- | --- |"]
    for seed in dict.fromkeys(row["rng_seed"] for row in rows):
        of = {row["method"]: row for row in rows if row["rng_seed"] == seed}
        of = [of[method] for method in ("paper", "measured", "jfa")]
        percents = [f"{row['similarity_mean']}, {row['similarity_least']}" for row in of]
        waves = [" to ".join(dict.fromkeys([row["waves_least"], row["waves_greatest"]])) for row in of]
        lines.append(f"| {seed} | {of[0]['motion']} | {' | '.join(percents)} | {'; '.join(waves)} |")
    with open(document, encoding="utf-8") as file:
        text = file.read()
    begin, end = "<!-- table motions -->\n", "<!-- end -->"
    before, rest = text.split(begin)
    with open(document, "w", encoding="utf-8") as file:
        file.write(before + begin + "\n".join(lines) + "\n" + end + rest.split(end, 1)[1])


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("usage: motions.py COMMAND CSV [ROW]..., or motions.py CSV DOCUMENT")
    if sys.argv[1].endswith(".csv"):
        write_table(*sys.argv[1:])
    else:
        measure(sys.argv[1], sys.argv[2], set(map(int, sys.argv[3:])))
