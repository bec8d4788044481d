"""Draws an image with points: weighted Voronoi stippling (Secord 2002). Usage: stippling.py [PICTURE]"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import vorocl

# A lit sphere on paper: 0 is white, 1 is black.
row, column = np.indices((1000, 1800))
x, y = (column - 860) / 440, (row - 500) / 440
height = np.sqrt(np.clip(1 - x**2 - y**2, 0, None))
light = np.clip(-0.5 * x - 0.5 * y + 0.7 * height, 0, None)
shadow = np.clip(0.8 - 0.5 * np.hypot((x - 1.2) / 1.4, (y - 0.75) / 0.35), 0, None)
tone = np.where(height > 0, 1 - 0.95 * light, shadow)

# Points as dense as the tone, and the density of which they are the square root.
rng = np.random.default_rng(1)
pixels = rng.choice(tone.size, 6000, p=tone.ravel() / tone.sum())
points = np.column_stack([pixels % 1800, pixels // 1800]) + rng.uniform(0, 1, (6000, 2))
stippled = vorocl.relax(points, tone.shape, rounds=100, density=tone**2)

figure, axes = plt.subplots(1, 2, figsize=(12, 3.5), layout="constrained")
axes[0].imshow(tone, cmap="gray_r", extent=(0, 1800, 1000, 0))
axes[0].set_title("the tone")
axes[1].scatter(*stippled.points.T, s=1.2, c="black", linewidths=0)
axes[1].set(xlim=(0, 1800), ylim=(1000, 0), aspect="equal")
axes[1].set_title(f"{len(points)} points, {len(stippled.moved)} rounds")
for panel in axes:
    panel.axis("off")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "stippling.png", dpi=110)
