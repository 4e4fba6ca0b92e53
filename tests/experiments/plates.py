#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the table of `plates CASE --csv FILE`: the crack by the time at which it opened, and the published place.

    tests/experiments/plates.py FILE.csv PICTURE.png

Needs Debian's python3-matplotlib. The thick line is the crack path: the shortest chain of open faces from the notch to
the tip. Thin lines are the other open faces, grey ones are tied and still bear tension."""
import csv
import heapq
import math
import re
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot
from matplotlib.collections import LineCollection
from mpl_toolkits.axes_grid1 import make_axes_locatable

CASES = {  # title, published directions from the notch in degrees, length of their rays in mm
    "branching": ("Branching plate: 1 MPa on both long edges", None, 0),
    "kalthoff": ("Kalthoff's plate: upper half, struck at 16.5 m/s", (63, 73), 70),
    "tension": ("Compact tension of concrete, opened at 1.375 m/s", (45, 60), 75),
}


def read(path):
    """Name, numbers of the first line, and faces as (x0, y0, x1, y1, tied, opened)."""
    with open(path) as file:
        head = file.readline()
        faces = [tuple(map(float, row.values())) for row in csv.DictReader(file)]
    numbers = list(map(float, re.findall(r"[\d.]+", head)))
    names = ("length", "height", "cell", "start", "tip", "level", "until")
    return head[2:].split(",")[0], dict(zip(names, numbers)), faces


def path_of(faces, plate):
    """The shortest chain of open faces from the notch's tip to the end farthest from it, as (x0, y0, x1, y1, tied,
    opened). It jumps gaps of up to 2.5 cells, which take the time of the face behind them."""
    edges = {}
    points = set()
    for face in faces:
        if face[5] >= 0:
            a, b = face[:2], face[2:4]
            points |= {a, b}
            edges[a, b] = edges[b, a] = face
    tip = (plate["tip"], plate["level"])
    points.add(tip)
    way, back, queue = {tip: 0.0}, {}, [(0.0, tip)]
    while queue:
        at, here = heapq.heappop(queue)
        if at > way[here]:
            continue
        for there in points:
            gap = math.dist(here, there)
            if gap > 2.5 * plate["cell"]:
                continue
            cost = at + (gap if (here, there) in edges else 2 * gap)
            if cost < way.get(there, math.inf):
                way[there], back[there] = cost, here
                heapq.heappush(queue, (cost, there))
    end = max(way, key=lambda point: math.dist(tip, point))
    chain, opened = [], plate["until"]
    while end in back:
        opened = edges.get((end, back[end]), (opened,))[-1]
        chain.append((*end, *back[end], opened, opened))
        end = back[end]
    return chain


def lines(faces, **style):
    return LineCollection([[face[:2], face[2:4]] for face in faces], capstyle="round", **style)


def published(axes, case, plate):
    """The published results: a sector of directions, or where the branching plate forks."""
    _, angles, length = CASES[case]
    if angles:
        rim = [math.radians(angles[0] + k / 20 * (angles[1] - angles[0])) for k in range(21)]
        corners = [(plate["tip"], plate["level"])]
        corners += [(plate["tip"] + length * math.cos(a), plate["level"] + length * math.sin(a)) for a in rim]
        axes.fill(*zip(*corners), color="#56b4e9", alpha=0.35, lw=0,
                  label=f"published direction, {angles[0]}° to {angles[1]}°")
    else:
        axes.axvspan(plate["tip"] + 12, plate["tip"] + 14, color="#56b4e9", alpha=0.45, lw=0,
                     label="published place of the fork, 12 to 14 mm")


def main():
    case, plate, faces = read(sys.argv[1])
    opened = [face for face in faces if face[5] >= 0]
    path = path_of(faces, plate)
    ratio = plate["height"] / plate["length"]
    pyplot.rcParams.update({"font.size": 11})
    picture, axes = pyplot.subplots(figsize=(9, 9 * ratio * 0.84 + 0.9))
    axes.add_patch(pyplot.Rectangle((0, 0), plate["length"], plate["height"], facecolor="#f4f2ee", edgecolor="#555555"))
    published(axes, case, plate)
    axes.add_collection(lines([f for f in faces if f[5] < 0], colors="#b0b0b0", lw=1.2,
                              label="tied: softening, still bears tension"))
    first, last = min(f[5] for f in opened), plate["until"]
    shade = dict(cmap="inferno", norm=pyplot.Normalize(first, last + 0.15 * (last - first)))
    for chosen, width, label in ((opened, 1.4, "open crack faces"), (path, 4, "crack path, notch to tip")):
        axes.plot([], [], color="#7a1d6d", lw=width, label=label)
        drawn = lines(chosen, lw=width, **shade)
        drawn.set_array([face[5] for face in chosen])
        axes.add_collection(drawn)
    axes.plot([plate["start"], plate["tip"]], [plate["level"]] * 2, color="#0072b2", lw=4, solid_capstyle="butt",
              label="notch")
    bar = picture.colorbar(drawn, cax=make_axes_locatable(axes).append_axes("right", size=0.2, pad=0.12))
    bar.set_label("time at which the face opened, µs")
    bar.ax.set_ylim(first, last)
    axes.set_xlim(-0.01 * plate["length"], 1.01 * plate["length"])
    axes.set_ylim(-0.01 * plate["length"], plate["height"] + 0.01 * plate["length"])
    axes.set_aspect("equal")
    axes.set_xlabel("x, mm")
    axes.set_ylabel("y, mm")
    axes.set_title(f"{CASES[case][0]}, at {last:.0f} µs, cells of {plate['cell']:g} mm", loc="left", fontsize=12)
    axes.legend(loc="upper left", framealpha=0.95, fontsize=10)
    picture.tight_layout()
    picture.savefig(sys.argv[2], dpi=100, metadata={"Software": None})


if __name__ == "__main__":
    main()
