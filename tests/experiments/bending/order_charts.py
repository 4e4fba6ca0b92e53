#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tetrahedra of order 1 and 2 side by side: errors against closed forms, and their costs.

    tests/experiments/bending/order_charts.py SUNDER [--only PART ...] [--page PAGE.md] [--repeats N]

Prints the tables of docs/lab/second_order.md. With --page they replace the text there between
`<!-- PART -->` and `<!-- end of PART -->`, and charts (by gnuplot) are written to charts/ next to
it. Times are of the processor, not of the wall, both orders in turn, the median of N runs (3).

Needs python3-meshio, python3-scipy; parts exact and modes also ccx (CalculiX),
unstructured also gmsh.
"""
import argparse
import subprocess
from pathlib import Path

import order_modes
import order_motion
import order_statics
import order_struck
from order_tools import in_folder

PARTS = {"exact": order_modes.exact, "modes": order_modes.modes, "bending": order_statics.bending,
         "unstructured": order_statics.unstructured,
         "stress": order_statics.stresses, "rod": order_motion.rod, "bar": order_motion.bar,
         "hertz": order_motion.hertz, "cup": order_motion.cup, "slender": order_motion.slender,
         "cost": order_motion.cost, "struck": order_struck.first_fans, "graded": order_struck.graded_fans,
         "broken": order_struck.broken}


def put_into(page, part, lines):
    text = page.read_text()
    begin, end = f"<!-- {part} -->\n", f"<!-- end of {part} -->"
    if begin not in text or end not in text:
        raise SystemExit(f"{page} has no {begin.strip()} and {end}")
    head, rest = text.split(begin, 1)
    tail = rest.split(end, 1)[1]
    page.write_text(head + begin + "\n".join(lines).rstrip() + "\n" + end + tail)


def draw(path, chart):
    """A panel a body: error of the first and of the second quantity against ms, both orders, on log scales."""
    script = [f"set terminal pngcairo size {480 * len(chart)},420 font 'DejaVu Sans,11'", f"set output '{path}'",
              "set logscale xy", "set grid", "set format y '%g'", "set format x '%g'", "set ylabel 'error'",
              "set key below maxcols 2 font ',9' samplen 1",
              f"set multiplot layout 1,{len(chart)}"]
    names = {2: ("deflection or displacement", 7), 3: ("stress", 5)}
    for title, points in chart.items():
        plots, data = [], []
        for order, color in ((1, 7), (2, 6)):
            for column, (name, shape) in names.items():
                found = sorted((p[1], p[column]) for p in points if p[0] == order and p[column] is not None)
                if not found:
                    continue
                dash = "" if column == 2 else " dt 2"
                plots.append(f"'-' with linespoints title 'order {order}, {name}' lc {color} lw 2 pt {shape}{dash}")
                data += [f"{ms} {max(error, 1e-5)}" for ms, error in found] + ["e"]
        script += [f"set title '{title}: error against ms'", "plot " + ", ".join(plots), *data]
    subprocess.run(["gnuplot"], input="\n".join(script + ["unset multiplot", ""]), text=True, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("sunder", type=lambda p: Path(p).resolve())
    parser.add_argument("--only", nargs="+", choices=PARTS, default=list(PARTS))
    parser.add_argument("--page", type=Path)
    parser.add_argument("--repeats", type=int, default=3)
    arguments = parser.parse_args()
    for part in arguments.only:
        lines, chart = in_folder(lambda folder: PARTS[part](arguments.sunder, folder, arguments.repeats))
        print("\n".join(lines), flush=True)
        if arguments.page:
            put_into(arguments.page, part, lines)
            if chart:
                draw(arguments.page.parent / "charts" / f"order_{part}.png", chart)


if __name__ == "__main__":
    main()
