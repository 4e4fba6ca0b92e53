#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Cells of every kind and order through every ordered pair of formats, by sunder, meshio and gmsh.

Usage: cells_matrix.py SUNDER [--alone] [--page PAGE.md [--check]]

The meshes have edges, triangles, quadrilaterals, tetrahedra, hexahedra, prisms, pyramids of first and second
order and a polygon, each with a region. For each pair A, B every program gets the same file in A (written by
sunder) and writes B; both files are then read by sunder, and each cell of A's file is looked for in B's: its
kind, its nodes in their order, its region. `=` all are there; `told`: some are not, and the program said so
(warnings of sunder; the others say nothing in a way that a program could read, so theirs are `lost`); X: it
failed, or nobody can read its file. --alone leaves meshio and gmsh out. Prints Markdown, into a page with --page, between its marks; with --check
the page must say so already. Exit code 1: sunder failed, or lost something untold, or the page differs; 77:
meshio or gmsh is not installed."""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile
from collections import Counter

import conversion_matrix as matrix

MARKS = ("<!-- cells -->", "<!-- end of cells -->")
HEADS = {"sunder": "sunder: whole / told / untold / failed", "meshio": "meshio: whole / lost / failed",
         "gmsh": "gmsh: whole / lost / failed"}
# VTK's types of the cells of each mesh, with how many nodes.
MESHES = {
    "first order": [(3, 2), (5, 3), (9, 4), (10, 4), (12, 8), (13, 6), (14, 5)],
    "second order": [(21, 3), (22, 6), (23, 8), (24, 10), (25, 20), (26, 15), (27, 13)],
    "second order, whole": [(21, 3), (22, 6), (28, 9), (24, 10), (29, 27), (32, 18)],
    "faces": [(5, 3), (9, 4), (7, 5), (7, 7)],
}


def vtk_file(kinds):
    """Two cells of each kind, each with points of its own that lie as they may, and its region."""
    points, cells, types, regions = [], [], [], []
    for place, (kind, nodes) in enumerate(kinds):
        for copy in range(2):
            first = len(points)
            for k in range(nodes):
                n = 100 * place + 40 * copy + k
                points.append((((n * 7) % 11) / 3, ((n * 5) % 13) / 7 + place, n / 9))
            cells.append(list(range(first, len(points))))
            types.append(kind)
            regions.append(1 + place % 3 + copy)
    text = "# vtk DataFile Version 4.2\ncells\nASCII\nDATASET UNSTRUCTURED_GRID\n"
    text += f"POINTS {len(points)} double\n" + "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in points)
    text += f"CELLS {len(cells)} {sum(len(c) + 1 for c in cells)}\n"
    text += "".join(f"{len(c)} {' '.join(map(str, c))}\n" for c in cells)
    text += f"CELL_TYPES {len(types)}\n" + "".join(f"{t}\n" for t in types)
    text += f"CELL_DATA {len(cells)}\nSCALARS region int 1\nLOOKUP_TABLE default\n"
    return text + "".join(f"{r}\n" for r in regions)


def contents(sunder, path, folder):
    """Each cell by its type, region and the places of its nodes; None where the file cannot be read."""
    out = folder / "judged.vtk"
    run = subprocess.run([sunder, "convert", path, out, "--text"], capture_output=True)
    if run.returncode != 0:
        return None
    words = iter(out.read_text().split())
    found = {}
    for word in words:
        if word == "POINTS":
            n = int(next(words))
            next(words)
            flat = [round(float(next(words)), 5) + 0.0 for _ in range(3 * n)]
            points = list(zip(flat[::3], flat[1::3], flat[2::3]))
        elif word == "CELLS":
            n = int(next(words))
            next(words)
            cells = [[int(next(words)) for _ in range(int(next(words)))] for _ in range(n)]
        elif word == "CELL_TYPES":
            types = [next(words) for _ in range(int(next(words)))]
        elif word == "region":
            count, rows = int(next(words)), int(next(words))
            next(words)
            found["region"] = [next(words) for _ in range(count * rows)]
            break
    regions = found.get("region", ["0"] * len(cells))
    return Counter((t, r, tuple(points[p] for p in c)) for t, r, c in zip(types, regions, cells))


def by_sunder(sunder, source, out, target):
    """Whether it is written, or reported to hold nothing; and whether a loss is reported."""
    run = subprocess.run([sunder, "convert", source, out, *target[2]], capture_output=True, text=True)
    told = "nothing is lost" not in run.stdout
    return (run.returncode == 0 or "nothing_left" in run.stderr), told


def verdict(before, after, told):
    if after is None:
        return "X"
    if not before - after:
        return "="
    return "told" if told else "lost"


def through(sunder, source, before, target, place, program):
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir()
    out = place / f"cells.{target[1]}"
    if program == "sunder":
        done, told = by_sunder(sunder, source, out, target)
        if done and not out.exists():
            return "told"
    else:
        write = matrix.by_meshio if program == "meshio" else matrix.by_gmsh
        done, told = write(sunder, source, out, target), False
    return verdict(before, contents(sunder, out, place) if done and out.exists() else None, told)


def tables(sunder, folder, programs):
    """Markdown, and whether sunder failed or lost anything untold."""
    lines, bad = [], []
    for name, kinds in MESHES.items():
        origin = folder / "origin.vtk"
        origin.write_text(vtk_file(kinds))
        rows = {}
        for source in matrix.FORMATS:
            file = folder / f"source.{source[1]}"
            for stale in folder.glob("source.*"):
                stale.unlink()
            done, _ = by_sunder(sunder, origin, file, source)
            if not done or not file.exists():
                continue
            before = contents(sunder, file, folder)
            for target in matrix.FORMATS:
                for program in programs:
                    writes = program == "sunder" or target[3 if program == "meshio" else 4]
                    if not writes:
                        continue
                    said = through(sunder, file, before, target, folder / "out", program)
                    rows.setdefault(target[0], {}).setdefault(program, Counter())[said] += 1
                    if program == "sunder" and said in ("X", "lost"):
                        bad.append(f"{name}: {source[0]} to {target[0]}: {said}")
        lines += ["", f"**{name}**, from {max(sum(r['sunder'].values()) for r in rows.values())} formats", "",
                  "| to | " + " | ".join(HEADS[p] for p in programs) + " |", "|---|" + "---|" * len(programs)]
        sums = {}
        for target, row in rows.items():
            cells = []
            for program in programs:
                count = row.get(program)
                if count is None:
                    cells.append("not written")
                    continue
                keys = ("=", "told", "lost", "X") if program == "sunder" else ("=", "lost", "X")
                cells.append(" / ".join(str(count[k]) for k in keys))
                sums.setdefault(program, Counter()).update(count)
            lines.append(f"| {target} | {' | '.join(cells)} |")
        total = [" / ".join(str(sums[p][k]) for k in
                            (("=", "told", "lost", "X") if p == "sunder" else ("=", "lost", "X")))
                 for p in programs]
        lines.append(f"| **all** | {' | '.join(f'**{t}**' for t in total)} |")
    return lines, bad


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sunder", type=pathlib.Path)
    parser.add_argument("--alone", action="store_true", help="only sunder")
    parser.add_argument("--page", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    if not options.alone and (matrix.meshio is None or matrix.GMSH is None):
        print("skipped: meshio or gmsh is not installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        lines, bad = tables(options.sunder.resolve(), pathlib.Path(folder),
                            ("sunder",) if options.alone else ("sunder", "meshio", "gmsh"))
    for text in bad:
        print(text, file=sys.stderr)
    text = "\n".join(lines).strip()
    if options.page is None:
        print(text)
        sys.exit(1 if bad else 0)
    page = options.page.read_text()
    begin, end = (page.index(mark) for mark in MARKS)
    new = page[:begin] + f"{MARKS[0]}\n{text}\n" + page[end:]
    if options.check:
        sys.exit(1 if bad or new != page else 0)
    options.page.write_text(new)
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
