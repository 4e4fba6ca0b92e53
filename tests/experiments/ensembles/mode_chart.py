#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws how three crack modes depend on the mesh, from the table of fragmentation.py in docs/lab/ensembles.md:

    tests/experiments/ensembles/mode_chart.py [PICTURE.png]

Needs Debian's python3-matplotlib. One point is the mean over the meshes of one size."""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

TREE = pathlib.Path(__file__).resolve().parents[3]
MODES = {"paper": "#d55e00", "object": "#0072b2", "cohesive": "#009e73"}
PANELS = [  # title, column of the table, factor, top of the axis
    ("Large pieces (over 1 % of the mass)", 6, 1, 30),
    ("Dust, % of the mass", 8, 100, 42),
    ("Computing time per run, s", 4, 1, 36),
]


def table():
    """Rows of the fragmentation table as lists of words: mode, meshes, runs, tetrahedra, s, pieces, large, ..."""
    lines = (TREE / "docs/lab/ensembles.md").read_text().split("## The fragmentation chart")[1].splitlines()
    rows = [[word.strip() for word in line.strip("|").split("|")] for line in lines if line.startswith("| ")]
    return [row for row in rows if row[0] in MODES and row[1] in ("1x", "2x", "4x")]


def main():
    picture = sys.argv[1] if len(sys.argv) > 1 else TREE / "docs/images/three_modes.png"
    pyplot.rcParams.update({"font.size": 12.5, "axes.titlesize": 13.5})
    shown, panels = pyplot.subplots(1, 3, figsize=(12, 4.4))
    for axes, (title, column, factor, top) in zip(panels, PANELS):
        for mode, colour in MODES.items():
            rows = [row for row in table() if row[0] == mode]
            axes.plot([float(row[3]) for row in rows], [factor * float(row[column]) for row in rows], color=colour,
                      marker="o", ms=8, lw=2.6, label=f"mode {mode}")
        axes.set_xscale("log")
        axes.set_xticks([2905, 5803, 11668], ["2 900", "5 800", "11 700"])
        axes.minorticks_off()
        axes.set_xlim(2500, 13600)
        axes.set_ylim(0, top)
        axes.set_xlabel("elements in the ball")
        axes.set_title(title, loc="left")
        axes.grid(alpha=0.3)
        axes.spines[["top", "right"]].set_visible(False)
    handles, labels = panels[0].get_legend_handles_labels()
    shown.legend(handles, labels, loc="lower center", ncol=3, frameon=False)
    shown.suptitle("Mode cohesive leaves the same number of large pieces on every mesh.",
                   fontsize=14.5, fontweight="bold")
    shown.tight_layout(rect=(0, 0.07, 1, 1))
    shown.savefig(picture, dpi=110, metadata={"Software": None})


if __name__ == "__main__":
    main()
