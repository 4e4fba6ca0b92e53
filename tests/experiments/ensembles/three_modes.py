#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws the three crack modes in one chart: pieces and computing time on three mesh sizes.

    tests/experiments/ensembles/three_modes.py [docs/lab/ensembles/fragmentation.csv] [docs/images/three_modes.png]

The file is that of fragmentation.py. Each point is the mean over the meshes of one size. Needs python3-matplotlib."""
import collections
import csv
import statistics
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLORS = {"paper": "#d95f02", "cohesive": "#1b9e77", "object": "#0571b0"}
LEVELS = ["1x", "2x", "4x"]


def means(path):
    """{mode: [(elements, s, pieces, share of the mass in debris)]}, a row per mesh size."""
    rows = collections.defaultdict(list)
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["end"] == "finished" and row["group"] in LEVELS:
                rows[row["mode"], row["group"]].append(
                    [float(row[c]) for c in ("tetrahedra", "seconds", "pieces", "debris")])
    return {mode: [[statistics.mean(column) for column in zip(*rows[mode, level])] for level in LEVELS] for mode in COLORS}


def main():
    source = sys.argv[1] if len(sys.argv) > 1 else "docs/lab/ensembles/fragmentation.csv"
    out = sys.argv[2] if len(sys.argv) > 2 else "docs/images/three_modes.png"
    plt.rcParams.update({"font.size": 12, "axes.spines.top": False, "axes.spines.right": False})
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    for mode, points in means(source).items():
        elements, seconds, pieces, debris = zip(*points)
        left.plot(elements, pieces, "o-", color=COLORS[mode], lw=2.5, ms=8)
        right.plot(seconds, [100 * d for d in debris], "o-", color=COLORS[mode], lw=2.5, ms=8)
        left.annotate(mode, (elements[-1], pieces[-1]), (10, -4), textcoords="offset points", color=COLORS[mode])
        right.annotate(mode, (seconds[-1], 100 * debris[-1]), (8, -14), textcoords="offset points", color=COLORS[mode])
    left.set(xscale="log", yscale="log", xlabel="elements", ylabel="pieces", xlim=(2600, 19000))
    left.set_xticks([3000, 6000, 12000], ["3 000", "6 000", "12 000"])
    left.set_yticks([30, 100, 300, 1000], ["30", "100", "300", "1 000"])
    right.set(xscale="log", xlabel="seconds per run", ylabel="mass in debris, %", ylim=(0, 40), xlim=(0.8, 500))
    right.set_xticks([1, 10, 100], ["1", "10", "100"])
    for axes in (left, right):
        axes.minorticks_off()
        axes.grid(color="#e6e6e6")
    figure.savefig(out, dpi=110)


if __name__ == "__main__":
    main()
