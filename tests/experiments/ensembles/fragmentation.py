#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The fragmentation chart: how far an outcome is from that on finer meshes and shorter sub-steps, against the time it takes.

    tests/experiments/ensembles/fragmentation.py [--build build/release] [--out out/fragmentation] [--limit 600] [--table]

The ball of ensembles.py (falls at 10 m/s; 2.9, 5.8 and 11.6 thousand tetrahedra: ten, ten and five seeded meshes) in modes
`paper`, `object` and `cohesive` (G_c 40 J/m^2, so that cracks soften over 40 mm), to 3 ms: 14 times the way of a wave through
the ball after it touched the floor. For comparison: ten runs of one mesh moved by nothing (the
numerical-noise band), and five meshes of 2x with sub-steps of a wave's way through a cell and a
quarter of it. Distances are Kolmogorov's, of mass-weighted distributions of the pieces' sizes, each
the mean of its group. A run that is there already in OUT is kept; --table runs nothing. Written:
the tables to stdout, and fragmentation.csv (a row per run). mode_chart.py draws the table."""
import csv
import os
import statistics
import sys

import ensembles
import figures
import report

MODES = ["paper", "object", "cohesive"]
LEVELS = {"1x": 10, "2x": 10, "4x": 5}
STEPS = {" cell": ["time_step=1e-4"], " cell/4": ["time_step=7.8125e-7"]}
FRACTURE_ENERGY = 40  # J/m^2


def plan():
    """The runs: (level, member, changes, their name). All kinds of members in turn, so that the
    finished runs are even at any time."""
    kinds = [(level, count, [], "") for level, count in {**LEVELS, "starts": 10}.items()]
    kinds += [("2x", 5, changes, called) for called, changes in STEPS.items()]
    order = sorted((m / count, k) for k, (_, count, _, _) in enumerate(kinds) for m in range(count))
    return [(kinds[k][0], round(share * kinds[k][1]), kinds[k][2], kinds[k][3]) for share, k in order]


def group(records, mode, name):
    return [r for r in records if r["mode"] == mode and r["group"] == name and r["volumes"]]


def volumes(records, mode, name):
    return [r["volumes"] for r in group(records, mode, name)]


def distance(records, mode, one, other):
    a, b = volumes(records, mode, one), volumes(records, mode, other)
    return figures.kolmogorov(a, b) if a and b else None


def null_distance(records, mode):
    """Between halves of the runs of one mesh moved by nothing, and between halves of the ten meshes at 2x."""
    halves = lambda runs: figures.kolmogorov(runs[::2], runs[1::2]) if len(runs) > 1 else None
    return halves(volumes(records, mode, "starts")), halves(volumes(records, mode, "2x"))


def row(records, mode, name, debris, reference):
    mine = group(records, mode, name)
    if not mine:
        return None
    each = [figures.outcomes(r["volumes"], debris) for r in mine]
    large = [sum(v >= 0.01 * sum(r["volumes"]) for v in r["volumes"]) for r in mine]
    mean = lambda key: statistics.fmean(o[key] for o in each)
    return {"mode": mode, "group": name, "runs": len(mine), "seconds": statistics.median(r["seconds"] for r in mine),
            "tetrahedra": statistics.fmean(r["tetrahedra"] for r in mine), "pieces": mean("pieces"),
            "large": statistics.fmean(large), "largest": mean("largest"), "debris": mean("debris"),
            "distance": None if name == reference else distance(records, mode, name, reference)}


def rows_of(records, debris):
    found = []
    for mode in MODES:
        found += [row(records, mode, name, debris, "4x") for name in (*LEVELS, "starts")]
        found += [row(records, mode, "2x" + name, debris, "2x cell/4") for name in STEPS]
    return [r for r in found if r]


def table(rows, records):
    shown = lambda x: "" if x is None else f"{x:.3f}"
    lines = ["| mode | meshes, sub-steps | runs | tetrahedra | s a run | pieces | of 1 per cent or more | largest | debris | distance to the finest |",
             "|---|---|---|---|---|---|---|---|---|---|"]
    for r in rows:
        lines.append(f"| {r['mode']} | {r['group']} | {r['runs']} | {r['tetrahedra']:.0f} | {r['seconds']:.1f} | {r['pieces']:.1f} | "
                     f"{r['large']:.1f} | {r['largest']:.3f} | {r['debris']:.4f} | {shown(r['distance'])} |")
    lines += ["", "| mode | 2x to 4x | one mesh, moved by nothing: halves | ten meshes at 2x: halves |", "|---|---|---|---|"]
    for mode in MODES:
        moved, meshes = null_distance(records, mode)
        lines.append(f"| {mode} | {shown(distance(records, mode, '2x', '4x'))} | {shown(moved)} | {shown(meshes)} |")
    return "\n".join(lines)


def main():
    said = ensembles.options(__doc__, "out/fragmentation", 600).parse_args()
    os.nice(5)
    ensembles.BODIES["ball"]["duration"] = 0.003
    ensembles.BODIES["ball"]["size"]["4x"] = 0.0115
    records = []
    for level, member, changes, called in plan():
        for mode in MODES:
            energy = [f"bodies.0.material.fracture_energy={FRACTURE_ENERGY}"] if mode == "cohesive" else []
            record = ensembles.run(said, "ball", mode, level, member, [*energy, *changes], called)
            if record is None:
                continue
            records.append(record)
            if not said.table:
                print(mode, record["group"], member, record["end"], f"{len(record['volumes'])} pieces", f"{record['seconds']} s",
                      file=sys.stderr, flush=True)
    debris = report.debris_length(records)
    rows = rows_of(records, debris)
    print(f"Debris is smaller than {1e3 * debris:.3g} mm\n\n{table(rows, records)}")
    with open(said.out / "fragmentation.csv", "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["mode", "group", "member", "end", "seconds", "tetrahedra", "pieces", "largest", "debris"])
        for r in records:
            o = figures.outcomes(r["volumes"], debris) if r["volumes"] else dict.fromkeys(("pieces", "largest", "debris"), "")
            out.writerow([r["mode"], r["group"], r["member"], r["end"], r["seconds"], r.get("tetrahedra", ""), *o.values()])


if __name__ == "__main__":
    sys.exit(main())
