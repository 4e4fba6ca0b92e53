#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""A two-material box through every ordered pair of formats, by sunder, meshio and gmsh.

Usage: conversion_matrix.py SUNDER [--plain | --carry] [--page PAGE.md [--check]]

The box has two named volumes, two named surfaces, numbers that do not count on, a field on its points
and one on its cells; --plain leaves out numbers and fields. For each pair A, B every program gets the
same file in A (written by sunder) and writes B. The surviving contents are read from B's file by
sunder, and, where sunder cannot read it, the pair has failed. Prints Markdown: a summary by target and
one matrix per program; with --carry instead the contents that each program brings into each format,
from four sources. --page puts it into a page, between the lines that name it; with --check the page
must be so already. Exit code 1: sunder failed somewhere, or lost contents that another program
kept, or the page differs;
77: meshio or gmsh is not installed, or (with --check) of another version than the page's.
"""
import argparse
import contextlib
import io
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import meshio
except ImportError:
    meshio = None
GMSH = shutil.which("gmsh")

# Name, ending, options of sunder, file_format and arguments of meshio, -format and options of gmsh.
FORMATS = [
    ("MSH 4.1", "msh", [], ("gmsh", {"binary": False}), ["msh41"]),
    ("MSH 4.1 binary", "msh", ["--binary"], ("gmsh", {}), ["msh41", "-bin"]),
    ("MSH 4.0", "msh", ["--format-version", "4.0"], None, ["msh40"]),
    ("MSH 2.2", "msh", ["--format-version", "2.2"], ("gmsh22", {"binary": False}), ["msh22"]),
    ("MSH 2.2 binary", "msh", ["--format-version", "2.2", "--binary"], ("gmsh22", {}),
     ["msh22", "-bin"]),
    ("MSH 1", "msh", ["--format-version", "1"], None, ["msh1"]),
    ("MEDIT", "mesh", [], ("medit", {}), ["mesh"]),
    ("MEDIT binary", "meshb", [], ("medit", {}), None),
    ("VTU", "vtu", [], ("vtu", {}), None),
    ("VTU text", "vtu", ["--text"], ("vtu", {"binary": False}), None),
    ("VTK 4.2", "vtk", [], ("vtk42", {}), ["vtk", "-bin"]),
    ("VTK 4.2 text", "vtk", ["--text"], ("vtk42", {"binary": False}), ["vtk"]),
    ("VTK 5.1", "vtk", ["--format-version", "5.1"], ("vtk51", {}), None),
    ("TetGen", "node", [], ("tetgen", {}), None),
    ("Abaqus", "inp", [], ("abaqus", {}), ["inp"]),
    ("Nastran", "bdf", [], ("nastran", {}), ["bdf"]),
    ("UNV", "unv", [], None, ["unv"]),
    ("OVM", "ovm", [], None, None),
    ("OFF", "off", [], ("off", {}), None),
    ("OBJ", "obj", [], ("obj", {}), None),
    ("STL", "stl", [], ("stl", {"binary": True}), ["stl", "-bin"]),
    ("STL text", "stl", ["--text"], ("stl", {}), ["stl"]),
    ("PLY", "ply", [], ("ply", {}), None),
    ("PLY text", "ply", ["--text"], ("ply", {"binary": False}), None),
    ("VTP", "vtp", [], None, None),
    ("VTP text", "vtp", ["--text"], None, None),
]
# Contents that another program keeps and sunder reports as lost: gmsh's sets Volume1, Surface1,
# ..., and its tables of properties, for which sunder writes the regions.
TOLD = {("Abaqus", "e"), ("UNV", "e")}
CARRY_SOURCES = ["MSH 4.1", "MEDIT", "VTU text", "VTK 4.2 text"]
# Contents that may survive, and the letter for their loss.
ITEMS = {"coordinates": "x", "tetrahedra": "T", "triangles": "F", "order": "o", "volumes": "v",
         "surfaces": "s", "names": "n", "entities": "e", "numbers": "i", "point data": "p",
         "cell data": "c"}


def box(plain):
    """The box in MSH 2.2: two cubes of six tetrahedra side by side."""
    def node(n):
        return n + 1 if plain else 3 * n + 5

    def cell(n):
        return n + 1 if plain else 2 * n + 20

    points = [(0.1 * i, j / 3, 0.7 * k) for i in range(3) for j in range(2) for k in range(2)]
    row = {(i, j, k): node(4 * i + 2 * j + k)
           for i in range(3) for j in range(2) for k in range(2)}
    steps = [(0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2), (0, 2, 1), (2, 1, 0)]
    tetrahedra, triangles = [], []
    for i in range(2):
        for n, order in enumerate(steps):
            at, corners = [i, 0, 0], [(i, 0, 0)]
            for axis in order:
                at[axis] += 1
                corners.append(tuple(at))
            if n >= 3:
                corners[2], corners[3] = corners[3], corners[2]
            tetrahedra.append((7 if i == 0 else 3, [row[c] for c in corners]))
    for i, tag in ((0, 2), (2, 6)):
        a, b, c, d = (row[i, j, k] for j, k in ((0, 0), (1, 0), (1, 1), (0, 1)))
        triangles += [(tag, (a, b, c)), (tag, (a, c, d))]
    text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n"
    text += '3 7 "core"\n3 3 "outer shell"\n2 2 "inlet"\n2 6 "outlet"\n$EndPhysicalNames\n'
    text += f"$Nodes\n{len(points)}\n"
    text += "".join(f"{node(n)} {x!r} {y!r} {z!r}\n" for n, (x, y, z) in enumerate(points))
    text += f"$EndNodes\n$Elements\n{len(triangles) + len(tetrahedra)}\n"
    cells = [(2, c) for c in triangles] + [(4, c) for c in tetrahedra]
    for n, (kind, (tag, corners)) in enumerate(cells):
        text += f"{cell(n)} {kind} 2 {tag} {tag + 30} {' '.join(map(str, corners))}\n"
    text += "$EndElements\n"
    if plain:
        return text
    text += "$NodeData\n1\n\"height\"\n1\n0\n3\n0\n1\n12\n"
    text += "".join(f"{node(n)} {p[2] / 3!r}\n" for n, p in enumerate(points))
    text += f"$EndNodeData\n$ElementData\n1\n\"damage\"\n1\n0\n3\n0\n1\n{len(cells)}\n"
    text += "".join(f"{cell(n)} {1 / (n + 3)!r}\n" for n in range(len(cells)))
    return text + "$EndElementData\n"


def sections(text):
    """The lines of each section of an MSH file."""
    found, lines = {}, iter(text.splitlines())
    for line in lines:
        if line.startswith("$"):
            body = []
            for inner in lines:
                if inner.startswith("$End"):
                    break
                body.append(inner)
            found.setdefault(line[1:], []).append(body)
    return found


def nearest(point):
    """A point's coordinates without their last digits, by which it is known again."""
    return tuple(round(x, 5) + 0.0 for x in point)


def contents(sunder, path, folder):
    """The contents that sunder reads from a file, item by item; None where it cannot be read."""
    again = folder / "judged.msh"
    for stale in (again, pathlib.Path(f"{again}.regions")):
        stale.unlink(missing_ok=True)
    if subprocess.run([sunder, "convert", path, again, "--format-version", "2.2"],
                      capture_output=True).returncode != 0:
        return None
    found = sections(again.read_text())
    points, known, entities = [], {}, {}
    for line in found["Nodes"][0][1:]:
        number, *xyz = line.split()
        points.append(tuple(map(float, xyz)))
        known[number] = nearest(points[-1])
    cells, order, number_of = {"2": {}, "4": {}}, [], {}
    for line in found["Elements"][0][1:]:
        words = line.split()
        tags = 3 + int(words[2])
        corners = [known[w] for w in words[tags:]]
        if words[1] in cells:
            cell = tuple(sorted(corners))
            cells[words[1]][cell] = words[3] if tags > 3 else "0"
            entities[cell] = words[4] if tags > 4 else "0"
            number_of[words[0]] = cell
            order.append(corners)
    names = {}
    for line in found.get("PhysicalNames", [[]])[0][1:]:
        dimension, number, name = line.split(" ", 2)
        names[dimension, number] = name
    data = {"NodeData": {}, "ElementData": {}}
    for kind, fields in data.items():
        of = known if kind == "NodeData" else number_of
        for body in found.get(kind, []):
            for line in body[8:]:
                number, *values = line.split()
                if len(values) == 1 and number in of:
                    fields[body[1], of[number]] = values
    return {
        "coordinates": dict.fromkeys(points),
        "tetrahedra": dict.fromkeys(cells["4"]),
        "triangles": dict.fromkeys(cells["2"]),
        "order": {"": ([nearest(p) for p in points], order)},
        "volumes": cells["4"] if set(cells["4"].values()) != {"0"} else {},
        "surfaces": cells["2"] if set(cells["2"].values()) != {"0"} else {},
        "names": names,
        # Where no entity is given they are written like the regions.
        "entities": entities if entities != cells["2"] | cells["4"] else {},
        "numbers": {} if list(known) == [str(n + 1) for n in range(len(known))] else
                   {cell: number for number, cell in (known | number_of).items()},
        "point data": data["NodeData"],
        "cell data": data["ElementData"],
    }


def survived(before, after):
    """The items of `before` that are the same in `after`; None where that could not be read."""
    if after is None:
        return None
    return {item for item, values in before.items()
            if values and all(k in after[item] and after[item][k] == v for k, v in values.items())}


def by_sunder(sunder, source, out, target):
    run = subprocess.run([sunder, "convert", source, out, *target[2]], capture_output=True)
    return run.returncode == 0


def by_meshio(_, source, out, target):
    file_format, arguments = target[3]
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            meshio.write(out, meshio.read(source), file_format=file_format, **arguments)
    except (Exception, SystemExit):
        return False
    return True


def by_gmsh(_, source, out, target):
    try:
        run = subprocess.run([GMSH, source, "-save", "-format", target[4][0], *target[4][1:],
                              "-o", out], capture_output=True, errors="replace", timeout=60)
    except subprocess.TimeoutExpired:
        return False
    return run.returncode == 0 and "Error" not in run.stdout + run.stderr


def convert_all(sunder, sources, targets, folder, programs):
    """For each program and pair the survivors: a set of items, or None where it failed."""
    results = {name: {} for name in programs}
    for source in sources:
        before = contents(sunder, sources[source], folder)
        for target in FORMATS:
            if target[0] not in targets:
                continue
            for program, (convert, handles) in programs.items():
                if not handles(target):
                    continue
                place = folder / "out"
                shutil.rmtree(place, ignore_errors=True)
                place.mkdir()
                out = place / f"box.{target[1]}"
                done = convert(sunder, sources[source], out, target)
                after = contents(sunder, out, folder) if done and out.exists() else None
                results[program][source, target[0]] = survived(before, after)
    return results


def judged(results, pair, program):
    """`=`, the letters of items lost though some program keeps them, `X`, or a blank."""
    if pair not in results[program]:
        return ""
    kept = results[program][pair]
    if kept is None:
        return "X"
    possible = set().union(*(r[pair] or set() for r in results.values() if pair in r))
    return "".join(letter for item, letter in ITEMS.items() if item in possible - kept) or "="


def carried(results, names, programs):
    """Which programs (S, M, G) bring which items into which formats, from any source."""
    lines = ["| to | " + " | ".join(ITEMS) + " |", "|---|" + "---|" * len(ITEMS)]
    for target in names:
        row = []
        for item in ITEMS:
            able = [program for program in programs
                    if any(kept and item in kept and pair[1] == target
                           for pair, kept in results[program].items())]
            row.append(" ".join(program[0].upper() for program in able))
        lines.append(f"| {target} | " + " | ".join(row) + " |")
    return lines


def summary(results, names, programs):
    """How many sources came through whole, in part, not at all."""
    def counts(marks):
        marks = [mark for mark in marks if mark]
        whole, failed = marks.count("="), marks.count("X")
        return f"{whole} / {len(marks) - whole - failed} / {failed}" if marks else "not written"

    lines = ["| to | " + " | ".join(programs) + " |", "|---|" + "---|" * len(programs)]
    for target in names:
        row = [counts([judged(results, (source, target), program) for source in names])
               for program in programs]
        lines.append(f"| {target} | " + " | ".join(row) + " |")
    totals = [counts([judged(results, pair, program) for pair in results[program]])
              for program in programs]
    lines.append("| **all** | " + " | ".join(f"**{total}**" for total in totals) + " |")
    return lines


def matrix(results, names, program):
    lines = ["", f"**{program}**", "", "| from \\ to | " + " | ".join(names) + " |",
             "|---|" + "---|" * len(names)]
    for source in names:
        marks = [judged(results, (source, target), program) for target in names]
        lines.append(f"| {source} | " + " | ".join(marks) + " |")
    return lines


def put_into(page, name, text, only_check):
    """Puts the text between the page's two lines of that name; whether it was there before."""
    begin, end = f"<!-- {name} -->\n", f"<!-- end of {name} -->\n"
    whole = pathlib.Path(page).read_text()
    if begin not in whole or end not in whole:
        sys.exit(f"{page} has no lines {begin.strip()} and {end.strip()}")
    before, rest = whole.split(begin)
    old, after = rest.split(end)
    if not only_check:
        pathlib.Path(page).write_text(before + begin + text + end + after)
    return old == text


def versions():
    gmsh = subprocess.run([GMSH, "--version"], capture_output=True, text=True)
    return f"meshio {meshio.__version__}, gmsh {(gmsh.stdout + gmsh.stderr).strip()}"


def all_sources(sunder, folder, plain):
    """The box as a file of each format that sunder knows."""
    (folder / "box.msh").write_text(box(plain))
    table = subprocess.run([sunder, "convert", "--formats"], capture_output=True, text=True,
                           check=True).stdout
    sources = {}
    for target in FORMATS:
        if f".{target[1]}" not in table:
            continue
        name = target[0].replace(" ", "_")
        (folder / name).mkdir()
        sources[target[0]] = folder / name / f"box.{target[1]}"
        subprocess.run([sunder, "convert", folder / "box.msh", sources[target[0]], *target[2]],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return sources


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("sunder")
    arguments.add_argument("--plain", action="store_true")
    arguments.add_argument("--carry", action="store_true")
    arguments.add_argument("--page")
    arguments.add_argument("--check", action="store_true")
    given = arguments.parse_args()
    if not meshio or not GMSH:
        print("meshio or gmsh is not installed")
        return 77
    if given.check and versions() not in pathlib.Path(given.page).read_text():
        print(f"the page was made by other versions than {versions()}")
        return 77
    programs = {"sunder": (by_sunder, lambda t: True), "meshio": (by_meshio, lambda t: t[3]),
                "gmsh": (by_gmsh, lambda t: t[4])}
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        targets = all_sources(given.sunder, folder, given.plain)
        sources = {name: path for name, path in targets.items()
                   if not given.carry or name in CARRY_SOURCES}
        results = convert_all(given.sunder, sources, targets, folder, programs)
    names = list(targets)
    lines = [f"Compared with sunder: {versions()}.", ""]
    if given.carry:
        lines += carried(results, names, programs)
    else:
        lines += summary(results, names, programs)
        for program in programs:
            lines += matrix(results, names, program)
    text = "\n".join(lines) + "\n"
    print(text, end="")
    worse = [(pair, judged(results, pair, "sunder")) for pair in results["sunder"]
             if judged(results, pair, "sunder") != "="
             and (pair[1], judged(results, pair, "sunder")) not in TOLD]
    for (source, target), mark in worse:
        print(f"sunder, {source} to {target}: {mark}", file=sys.stderr)
    name = "carry" if given.carry else "plain matrix" if given.plain else "matrix"
    differs = given.page and not put_into(given.page, name, text, given.check) and given.check
    if differs:
        print(f"{given.page} says something else", file=sys.stderr)
    return 1 if worse or differs else 0


if __name__ == "__main__":
    sys.exit(main())
