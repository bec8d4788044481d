"""Coins segmented and expanded: coins.py PICTURE. Needs scikit-image and matplotlib."""

import math
import sys

import matplotlib
from skimage import color, data, filters, measure, morphology, segmentation

import vorocl

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

image = data.coins()
edges = filters.sobel(image)
markers = (image > 150) * 2 + (image < 30) * 1
coins = morphology.remove_small_holes(segmentation.watershed(edges, markers) == 2, max_size=500)
labels = measure.label(morphology.remove_small_objects(coins, max_size=500))

shown = [
    ("segmented", labels),
    ("expanded by 10 pixels", vorocl.expand_labels(labels, 10)),
    ("expanded until they meet", vorocl.expand_labels(labels, math.inf)),
]
figure, axes = pyplot.subplots(1, 3, figsize=(12, 3.3), layout="constrained")
for axis, (title, regions) in zip(axes, shown):
    axis.imshow(color.label2rgb(regions, image, alpha=0.4, bg_label=0))
    axis.set(title=title, xticks=[], yticks=[])
figure.savefig(sys.argv[1], dpi=100)
