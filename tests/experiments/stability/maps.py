#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the table of stability_sweep: how long a step each method holds.

    tests/experiments/stability/maps.py FILE.csv PICTURE.png

Needs Debian's python3-matplotlib. A cell has the longest step up to which the method holds, and its colour; the letter is
the first outcome beyond: D diverges, F false stress, L loses energy, G gains energy, P leaves the path."""
import csv
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

ROWS = {  # name of a map: heading, how a value is written
    "stiffness": ("Young's modulus", lambda v: f"{v:.0e} Pa".replace("e+", "e")),
    "spin": ("spin", lambda v: f"{v:g} rad/s"),
    "poisson": ("Poisson's ratio", lambda v: f"{v:g}"),
    "sliver": ("least angle", lambda v: f"{v:g}°"),
    "mass": ("block over ball", lambda v: f"{v:.0e}".replace("e+0", "e") if v > 1000 else f"{v:g}"),
}
LETTERS = {"diverges": "D", "false stress": "F", "loses": "L", "gains": "G", "off path": "P", "refuses": "refused"}


def read(path):
    """Outcomes by map, value, method and step, and the methods in their order."""
    found, methods = {}, []
    with open(path) as file:
        for row in csv.DictReader(file):
            if row["method"] not in methods:
                methods.append(row["method"])
            steps = found.setdefault(row["map"], {}).setdefault(float(row["value"]), {}).setdefault(row["method"], {})
            steps[float(row["step / s"])] = row["outcome"]
    return found, methods


def longest(outcomes):
    """The number of steps from the shortest on that hold, the last of them in s, and the first outcome beyond."""
    held = None
    for number, step in enumerate(sorted(outcomes)):
        if outcomes[step] != "holds":
            return number, held, outcomes[step]
        held = step
    return len(outcomes), held, ""


def written(step):
    return f"{1e6 * step:.0f} µs" if step < 9e-4 else f"{1e3 * step:.0f} ms"


def heading(method):
    name, _, kind = method.replace(" .5", " 0.5").partition(", ")
    return f"{textwrap.fill(name, 12)},\n{kind}" if kind else textwrap.fill(name, 12)


def main():
    found, methods = read(sys.argv[1])
    rows = [(name, value) for name in found for value in sorted(found[name], reverse=True)]
    pyplot.rcParams.update({"font.size": 9})
    picture, axes = pyplot.subplots(figsize=(12, 0.27 * len(rows) + 2.6))
    colours = matplotlib.colormaps["RdYlGn"]
    places, y = [], 0.0
    for k, (name, value) in enumerate(rows):
        y += 1.9 if k and rows[k - 1][0] != name else 1
        places.append(y)
        if not k or rows[k - 1][0] != name:
            axes.text(-0.6, y - 0.95, ROWS[name][0], ha="right", va="center", fontweight="bold", fontsize=10)
        for column, method in enumerate(methods):
            held, step, beyond = longest(found[name][value][method])
            most = len(found[name][value][method])
            face = "#dddddd" if beyond == "refuses" else colours(0.08 + 0.84 * held / most)
            axes.add_patch(pyplot.Rectangle((column - 0.5, y - 0.5), 1, 1, facecolor=face, edgecolor="white", lw=1.5))
            words = LETTERS[beyond] if not step else written(step) + (f" {LETTERS[beyond]}" if beyond else "")
            axes.text(column, y, words, ha="center", va="center", fontsize=8.5)
    axes.set_yticks(places, [ROWS[name][1](value) for name, value in rows])
    axes.set_xticks(range(len(methods)), [heading(m) for m in methods])
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.set_xlim(-0.5, len(methods) - 0.5)
    axes.set_ylim(places[-1] + 0.6, -0.5)
    axes.spines[:].set_visible(False)
    axes.set_xlabel("longest step that holds.  Beyond it:  D diverges · F false stress · L loses energy · G gains energy"
                    " · P leaves the path", fontsize=10)
    picture.tight_layout()
    picture.savefig(sys.argv[2], dpi=100, metadata={"Software": None})


if __name__ == "__main__":
    main()
