#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fills surfaces of others by each mesher, through `sunder break --scene-only`.

    tests/experiments/surfaces/fill_surfaces.py SUNDER FOLDER [--meshers auto,tetgen,gmsh] [--limit S]
        [--repair none|small|wrap] [--tetrahedra N] [--csv FILE]

FOLDER holds surfaces (STL, OBJ, PLY, OFF), none of which are ours to keep here. For each surface and
mesher the table has the time on the wall, tetrahedra, volume error and the largest distance between
skin and surface as a share of the longest side (20 cm), the smallest dihedral angle (degrees), repairs,
and the code of a refusal. `auto` is the choice of `sunder break`. The last
lines count the successes."""
import argparse
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

SIDE = 0.2
FILLED = re.compile(r"^(\S+) filled it with (\d+) tetrahedr\w+, volume (\S+) %, skin within (\S+) (um|mm|m) ", re.M)
UNIT = {"um": 1e-6, "mm": 1e-3, "m": 1}
COLUMNS = ["surface", "mesher", "by", "seconds", "tetrahedra", "volume_error", "distance", "smallest_angle", "repair",
           "refusal"]


def codes(text):
    """Codes of the errors that the program printed."""
    return re.findall(r"error: .*\[(\w+)\]$", text, re.M)


def words_of_repair(text):
    found = re.search(r"repaired the surface: (.*?); it moved", text.replace("\n", " "))
    return re.sub(r"\s+", " ", found.group(1)) if found else ""


def smallest_angle(sunder, mesh):
    done = subprocess.run([sunder, "check", "--json", mesh], capture_output=True, text=True, check=False)
    return json.loads(done.stdout)["quality"]["dihedral_angle"]["smallest"]["value"]


def fill(a, surface, mesher, folder):
    out = pathlib.Path(folder) / "out"
    words = [a.sunder, "break", surface, "--size", f"{SIDE}m", "--scene-only", "--force", "-o", out,
             "--repair", a.repair, "--tetrahedra", str(a.tetrahedra)]
    if mesher != "auto":
        words += ["--mesher", mesher]
    row = dict.fromkeys(COLUMNS, "")
    row.update(surface=surface.name, mesher=mesher)
    start = time.monotonic()
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=a.limit, check=False)
    except subprocess.TimeoutExpired:
        return {**row, "seconds": a.limit, "refusal": "too_long"}
    row["seconds"] = round(time.monotonic() - start, 1)
    row["repair"] = words_of_repair(done.stderr)
    match = None
    for match in FILLED.finditer(done.stderr):
        pass
    if done.returncode != 0 or match is None:
        refused = codes(done.stderr)
        row["refusal"] = refused[-1] if refused else f"exit {done.returncode}"
        return row
    by, count, volume, distance, unit = match.groups()
    mesh = next(out.glob("*.msh"))
    row.update(by=by, tetrahedra=int(count), volume_error=float(volume) / 100,
               distance=float(distance) * UNIT[unit] / SIDE, smallest_angle=round(smallest_angle(a.sunder, mesh), 2))
    mesh.unlink()
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sunder")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--meshers", default="auto,tetgen,gmsh")
    parser.add_argument("--limit", type=float, default=300)
    parser.add_argument("--repair", default="small")
    parser.add_argument("--tetrahedra", type=int, default=5000)
    parser.add_argument("--csv", type=pathlib.Path)
    a = parser.parse_args()
    surfaces = sorted(p for p in a.folder.iterdir() if p.suffix.lower() in (".stl", ".obj", ".ply", ".off"))
    if not surfaces:
        sys.exit(f"{a.folder} holds no surface (.stl, .obj, .ply, .off)")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        print("| " + " | ".join(COLUMNS) + " |\n|" + "---|" * len(COLUMNS))
        for surface in surfaces:
            for mesher in a.meshers.split(","):
                row = fill(a, surface, mesher, folder)
                rows.append(row)
                print("| " + " | ".join(f"{v:.2g}" if isinstance(v, float) else str(v) for v in row.values()) + " |",
                      flush=True)
    for mesher in a.meshers.split(","):
        own = [r for r in rows if r["mesher"] == mesher]
        print(f"{mesher}: {sum(not r['refusal'] for r in own)} of {len(own)} filled, "
              f"{sum(r['seconds'] for r in own):.0f} s")
    if a.csv:
        with open(a.csv, "w", encoding="utf-8", newline="") as out:
            writer = csv.DictWriter(out, COLUMNS)
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
