#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Variants of mesh files as people and programs write them: the answers of sunder, compared with those of meshio and gmsh.

Usage: format_variants.py SUNDER [--seeds N] [--only KIND ...] [--keep FOLDER]

Each kind below makes files at random from a mesh that is known: Nastran's bulk data with tabs, replication and
headers, partitioned MSH, sections and attributes that no mesh holds, headers and rows in every order. sunder has to
read the mesh that was meant, to report content that is left out (--strict ends with 1) and nothing else, and to name
the line of a row that is too long or too short. meshio and gmsh read the same files where they can.
Prints a row a kind. Exit code 1: a file was not read as meant; 77: meshio is not installed."""
import argparse
import contextlib
import functools
import io
import json
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile

try:
    import meshio
except ImportError:
    meshio = None

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1), (2, 0, 0.5)]
TETRAHEDRA = [(0, 1, 2, 3), (4, 2, 1, 3), (1, 5, 4, 3)]
TRIANGLES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


class Variant:
    """A file, its intended mesh (cells by the coordinates of their corners), and the expected
    report."""

    def __init__(self, name, content, cells, reports=False, line=None, arrays=None, regions=None, parts=0):
        self.name, self.cells, self.reports, self.line, self.arrays = name, cells, reports, line, arrays or {}
        self.regions, self.parts = regions, parts
        self.content = content.encode() if isinstance(content, str) else content


def cells_of(points, corners):
    return sorted(tuple(tuple(float(x) for x in points[i]) for i in c) for c in corners)


BODY = cells_of(POINTS, TETRAHEDRA)
SURFACE = cells_of(POINTS, TRIANGLES)


# Nastran ------------------------------------------------------------------------------------------------------------

def nastran_card(rng, way, name, fields):
    words = [str(f) for f in fields]
    if way == "free":
        return ",".join([name, *words])
    if way == "tabs":
        return "\t".join([name, *words])
    if way == "some tabs":  # a tab stands for the blanks up to the next field
        return "".join(w + ("\t" if len(w) < 8 and rng.random() < 0.5 else " " * (8 - len(w))) for w in [name, *words])
    if way == "large":
        rows = [words[i:i + 4] for i in range(0, len(words), 4)]
        lines = [f"{name + '*' if i == 0 else '*':8}" + "".join(f"{w:16}" for w in row) for i, row in enumerate(rows)]
        return "\n".join(lines + (["*"] if len(rows) % 2 else []))
    return "".join(f"{w:8}" for w in [name, *words])


HEADERS = ["", "$ made by hand\n$\n", "$$ pre-processor\n$$ ---------\n", "$MODEL\n"]
CONTROL = ["SOL 101\nCEND\n", "ID A,B\nSOL 1\nTIME 10\nCEND\n", "ANALYSIS STATICS\nSUBCASE 1\n  LOAD = 2\n",
           "DISPLACEMENT(PLOT) = ALL\nSET 1 = 1,2,3,\n  4,5\n", "TITLE = a body\nSPC = 1\n", "FORMAT H3D\nSCREEN OUT\n",
           "assign userfile='x.pch'\nsol 103\ncend\nmethod = 1\n", "PARAM,POST,-1\nSPC = 3\n"]


def nastran(rng):
    way = rng.choice(["free", "tabs", "some tabs", "large", "small"])
    control = rng.choice(CONTROL) if rng.random() < 0.7 else ""
    lines = [nastran_card(rng, way, "GRID", [i + 1, "", *(f"{x:.2f}" for x in p)]) for i, p in enumerate(POINTS)]
    lines += [nastran_card(rng, way, "CTETRA", [i + 1, 7, *(c + 1 for c in t)]) for i, t in enumerate(TETRAHEDRA)]
    rng.shuffle(lines)
    begin = "BEGIN BULK\n" if control or rng.random() < 0.5 else ""
    text = rng.choice(HEADERS) + control + begin + "\n".join(lines) + rng.choice(["\nENDDATA\n", "\n"])
    silent = {"ID", "CEND", "TITLE"}
    words = {line.split()[0].split("(")[0] for line in control.splitlines()}
    return Variant(f"{way}.bdf", text, BODY, reports=bool(words - silent))


def nastran_replication(rng):
    """A row of tetrahedra, each as the one before, moved along x."""
    n, free = rng.randint(2, 6), rng.random() < 0.6
    points = [(float(i), 0.0, 0.0) for i in range(n + 1)] + [(0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
    step = rng.choice(["*1.", "*(1.)", "*1", "*(1.0)"]) if free else "*(1.)"
    one = rng.choice(["*1", "*(1)"]) if free else "*(1)"
    image = rng.choice(["=({})", "={}"]) if free else "=({})"
    card = (lambda *w: ",".join(w)) if free else (lambda *w: "".join(f"{x:8}" for x in w))
    lines = [card("GRID", "1", "", "0.", "0.", "0.")]
    repeat_points = [card("=", one, "=", step, "==")]
    repeat_cells = [card("=", one, "=", one, one, "==")]
    for lines_of in (repeat_points, repeat_cells):
        left = (n if lines_of is repeat_points else n - 1) - 1
        if left > 0:
            lines_of += rng.choice([[card(image.format(left))], lines_of * left])
        elif left < 0:
            lines_of.clear()
    lines += repeat_points
    lines += [card("GRID", str(n + 2), "", "0.", "1.", "0."), card("GRID", str(n + 3), "", "0.", "0.", "1.")]
    lines += [card("CTETRA", "1", "3", "1", "2", str(n + 2), str(n + 3))] + repeat_cells
    cells = cells_of(points, [(i, i + 1, n + 1, n + 2) for i in range(n)])
    return Variant("replication.bdf", "BEGIN BULK\n" + "\n".join(lines) + "\nENDDATA\n", cells)


# MSH ----------------------------------------------------------------------------------------------------------------

def msh_2(version, names="", between="", behind="", points=POINTS):
    text = f"$MeshFormat\n{version} 0 8\n$EndMeshFormat\n{names}{between}$Nodes\n{len(points)}\n"
    text += "".join(f"{i + 1} {p[0]} {p[1]} {p[2]}\n" for i, p in enumerate(points)) + f"$EndNodes\n{between}"
    text += f"$Elements\n{len(TETRAHEDRA)}\n"
    text += "".join(f"{i + 1} 4 2 5 1 {' '.join(str(c + 1) for c in t)}\n" for i, t in enumerate(TETRAHEDRA))
    return text + "$EndElements\n" + behind


def msh_names(rng):
    rows = [(5, "core"), (9, "nobody's")][:rng.randint(1, 2)]
    text = "".join(f"{tag}{rng.choice(['', ' ', '  ', chr(9)])}\"{name}\"\n" for tag, name in rows)
    names = f"$PhysicalNames\n{len(rows)}\n{text}$EndPhysicalNames\n"
    return Variant("names.msh", msh_2(rng.choice(["2", "2.0"]), names), BODY, reports=len(rows) > 1)


def msh_sections(rng):
    name = rng.choice(["Periodic", "ElementNodeData", "InterpolationScheme", "Extra", "Parametrizations", "NodeData"])
    if name == "NodeData":
        time, step = rng.choice([(0.0, 1), (2.5, 0), (1e-3, 7)])
        rows = "".join(f"{i + 1} {i}\n" for i in range(len(POINTS)))
        extra = f'$NodeData\n1\n"t"\n1\n{time}\n3\n{step}\n1\n{len(POINTS)}\n{rows}$EndNodeData\n'
        return Variant("times.msh", msh_2("2.2", behind=extra), BODY, reports=True)
    extra = f"${name}\n{rng.randint(0, 3)}\n1 2 3\nwords\n$End{name}\n"
    behind = rng.random() < 0.5
    text = msh_2("2.2", between="" if behind else extra, behind=extra if behind else "")
    return Variant("sections.msh", text, BODY, reports=True)


BOXES = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {1, 0, 0, 0.7, 1, 1}; Coherence;
Physical Volume("core", 7) = {1}; Physical Volume("shell", 3) = {2};
Mesh.MeshSizeMin = 0.6; Mesh.MeshSizeMax = 0.6;
"""


@functools.cache
def boxes_by_gmsh(*words):
    """The bytes of gmsh's mesh of two boxes."""
    with tempfile.TemporaryDirectory() as name:
        source, out = pathlib.Path(name) / "boxes.geo", pathlib.Path(name) / "boxes.msh"
        source.write_text(BOXES)
        subprocess.run(["gmsh", str(source), "-3", *words, "-o", str(out)], capture_output=True, timeout=120)
        return out.read_bytes()


@functools.cache
def whole_boxes():
    with tempfile.TemporaryDirectory() as name:
        out = pathlib.Path(name) / "boxes.msh"
        out.write_bytes(boxes_by_gmsh("-format", "msh22"))
        mesh, cells = read_cells(out, False)
    return cells, regions_of(mesh, "gmsh:physical")


def msh_partitions(rng):
    if shutil.which("gmsh") is None:
        return msh_names(rng)
    parts, ghosts = rng.randint(2, 5), rng.random() < 0.3
    version = rng.choice(["msh22", "msh22 -bin", "msh40", "msh41", "msh41 -bin"])  # 4.8 writes no binary 4.0
    words = ["-part", str(parts), "-format", *version.split()]
    words += ["-setnumber", "Mesh.PartitionCreateGhostCells", "1"] if ghosts else []
    cells, regions = whole_boxes()
    reports = ghosts or not version.startswith("msh22")  # entities on seams lie in several partitions
    return Variant("partitioned.msh", boxes_by_gmsh(*words), cells, reports, regions=regions, parts=parts)


# VTK ----------------------------------------------------------------------------------------------------------------

def vtk_string(word):
    return struct.pack(">B", 0xC0 | len(word)) + word.encode() if len(word) < 64 else \
        struct.pack(">H", 0x8000 | len(word)) + word.encode()


VTK_TYPES = {"double": "d", "float": "f", "int": "i", "short": "h", "unsigned_char": "B", "vtkIdType": "i", "long": "q"}


def vtk_values(rng, kind, n, binary):
    """The values as the file has them, and as they are meant."""
    if kind == "string":
        words = ["w" * rng.randint(0, 90) for _ in range(n)]
        return (b"".join(map(vtk_string, words)) if binary else "\n".join(words).encode()), None
    if kind == "bit":
        bits = [rng.randint(0, 1) for _ in range(n)]
        packed = bytes(sum(b << (7 - k) for k, b in enumerate(bits[i:i + 8])) for i in range(0, n, 8))
        return (packed if binary else " ".join(map(str, bits)).encode()), bits
    values = [rng.randint(0, 9) for _ in range(n)]
    raw = struct.pack(f">{n}{VTK_TYPES[kind]}", *values)
    return (raw if binary else " ".join(map(str, values)).encode()), values


def vtk_attribute(rng, rows, binary, spell, i):
    """The bytes of one attribute, the array that is meant, whether it has to be reported."""
    word, components, kind = rng.choice(
        [("SCALARS", 1, None), ("VECTORS", 3, None), ("NORMALS", 3, "float"), ("TANGENTS", 3, "double"),
         ("TENSORS", 9, None), ("TENSORS6", 6, "double"), ("GLOBAL_IDS", 1, "vtkIdType"), ("PEDIGREE_IDS", 1, "int"),
         ("EDGE_FLAGS", 1, "int"), ("COLOR_SCALARS", rng.randint(1, 4), "color"), ("FIELD", 2, None),
         ("FIELD", 1, "string"), ("FIELD", rng.randint(1, 3), "bit"), ("TEXTURE_COORDINATES", 2, None)])
    kind = kind or rng.choice(list(VTK_TYPES))
    name = f"a{i}"
    if kind == "color":
        values, meant = vtk_values(rng, "unsigned_char" if binary else "float", rows * components, binary)
        return f"{spell(word)} {name} {components}\n".encode() + values, (name, meant), False
    values, meant = vtk_values(rng, kind, rows * components, binary)
    head = {"SCALARS": f"{spell(word)} {name} {kind}{rng.choice(['', ' 1'])}\n{spell('LOOKUP_TABLE')} default\n",
            "FIELD": f"{spell(word)} FieldData 1\n{name} {components} {rows} {kind}\n",
            "TEXTURE_COORDINATES": f"{spell(word)} {name} {components} {kind}\n"}
    text = head.get(word, f"{spell(word)} {name} {kind}\n")
    return text.encode() + values, (name, meant) if meant is not None else None, kind == "string"


def vtk_legacy(rng):
    binary, version = rng.random() < 0.5, rng.choice(["2.0", "3.0", "4.2"])
    spell = rng.choice([str.upper, str.lower])
    numbers = [len(t) if i == 0 else t[i - 1] for t in TETRAHEDRA for i in range(5)]
    flat = [float(x) for p in POINTS for x in p]
    types = [10] * len(TETRAHEDRA)

    def pack(letter, values):
        return struct.pack(f">{len(values)}{letter}", *values) if binary else " ".join(map(str, values)).encode()

    out = f"# vtk DataFile Version {version}\nx\n{spell('BINARY' if binary else 'ASCII')}\n".encode()
    out += f"{spell('DATASET')} {spell('UNSTRUCTURED_GRID')}\n".encode()
    reports = rng.random() < 0.3
    if reports:
        out += f"{spell('FIELD')} FieldData 1\ntime 1 1 double\n".encode() + pack("d", [0.25]) + b"\n"
    out += f"{spell('POINTS')} {len(POINTS)} double\n".encode() + pack("d", flat)
    out += f"\n{spell('CELLS')} {len(TETRAHEDRA)} {len(numbers)}\n".encode() + pack("i", numbers)
    out += f"\n{spell('CELL_TYPES')} {len(TETRAHEDRA)}\n".encode() + pack("i", types) + b"\n"
    arrays = {}
    for of, rows in (("POINT_DATA", len(POINTS)), ("CELL_DATA", len(TETRAHEDRA))):
        if rng.random() < 0.3:
            continue
        out += f"{spell(of)} {rows}\n".encode()
        for i in range(rng.randint(0, 3)):
            content, meant, is_told = vtk_attribute(rng, rows, binary, spell, f"{of[0].lower()}{i}")
            out += content + b"\n"
            reports = reports or is_told
            if meant:
                arrays[meant[0]] = meant[1]
    return Variant("legacy.vtk", out, BODY, reports, arrays=arrays)


# Surfaces -----------------------------------------------------------------------------------------------------------

def stl(rng):
    facets = []
    for t in TRIANGLES:
        normal = rng.choice(["facet", "facet normal", "facet normal 0 0 1", "FACET NORMAL nan nan nan", "facet normal 0 0"])
        rows = "\n".join("vertex " + " ".join(map(str, POINTS[c])) for c in t)
        facets.append(f"{normal}{rng.choice([chr(10), ' '])}outer loop\n{rows}\nendloop\nendfacet\n")
    return Variant("text.stl", "solid s\n" + "".join(facets) + "endsolid s\n", SURFACE)


def ply_strips(rng):
    """A band of triangles as one strip or several, with points that join strips twice."""
    n = rng.randint(4, 9)
    points = [(i // 2, i % 2, 0) for i in range(n)]
    cut = rng.randint(3, n)
    parts = [list(range(n))] if cut in (n, n - 1, n - 2) else [list(range(cut)), list(range(cut - 2, n))]
    triangles = [(p[k], p[k + 1], p[k + 2]) if k % 2 == 0 else (p[k + 1], p[k], p[k + 2])
                 for p in parts for k in range(len(p) - 2)]
    joined = [x for p in parts for x in [*p, -1]]
    rows = [joined if rng.random() < 0.5 else joined[:-1]] if rng.random() < 0.6 else [p for p in parts]
    if rng.random() < 0.5:
        rows = [[*rows[0][:1], *rows[0]] if len(rows) == 1 and len(parts) == 1 else rows[0], *rows[1:]]
        if rows[0][0] == rows[0][1]:  # the strip is turned by the point that comes twice
            triangles = [(b, a, c) for a, b, c in triangles]
    binary = rng.random() < 0.5
    head = f"ply\nformat {'binary_little_endian' if binary else 'ascii'} 1.0\nelement vertex {n}\n"
    head += "property float x\nproperty float y\nproperty float z\n"
    head += f"element tristrips {len(rows)}\nproperty list int int vertex_indices\nend_header\n"
    if binary:
        body = b"".join(struct.pack("<3f", *p) for p in points)
        body += b"".join(struct.pack(f"<{len(r) + 1}i", len(r), *r) for r in rows)
    else:
        body = "".join(f"{p[0]} {p[1]} {p[2]}\n" for p in points)
        body = (body + "".join(f"{len(r)} {' '.join(map(str, r))}\n" for r in rows)).encode()
    return Variant("strips.ply", head.encode() + body, turned(cells_of(points, triangles)))


def turned(cells):
    """Triangles from their least corner on: where they begin says nothing."""
    return sorted(c[c.index(min(c)):] + c[:c.index(min(c))] for c in cells)


def off(rng):
    letters = rng.sample(["ST", "C", "N"], rng.randint(0, 3))
    more = sum({"ST": 2, "C": 4, "N": 3}[x] for x in letters)
    points = "".join(" ".join(map(str, [*p, *[0.5] * more])) + "\n" for p in POINTS[:4])
    faces = "".join(f"3 {' '.join(map(str, t))}\n" for t in TRIANGLES)
    return Variant("header.off", "".join(letters) + f"OFF\n4 4 0\n{points}{faces}", SURFACE, reports=bool(letters))


def medit_plane(rng):
    points = [(float(i % 2), float(i // 2)) for i in range(4)]
    triangles = [(0, 1, 3), (0, 3, 2)]
    cells = cells_of([(*p, 0.0) for p in points], triangles)
    if rng.random() < 0.5:
        text = f"MeshVersionFormatted {rng.choice([1, 2])}\nDimension{rng.choice([' ', chr(10)])}2\nVertices\n4\n"
        text += "".join(f"{x} {y} 0\n" for x, y in points) + "Triangles\n2\n"
        return Variant("plane.mesh", text + "".join(f"{a + 1} {b + 1} {c + 1} 3\n" for a, b, c in triangles) + "End\n", cells)
    rows = [(3, struct.pack("<i", 2)), (4, struct.pack("<i", 4) + b"".join(struct.pack("<2di", *p, 0) for p in points)),
            (6, struct.pack("<i", 2) + b"".join(struct.pack("<4i", *(c + 1 for c in t), 3) for t in triangles))]
    out = struct.pack("<2i", 1, 2)
    for code, content in rows:
        out += struct.pack("<2i", code, len(out) + 8 + len(content)) + content
    return Variant("plane.meshb", out + struct.pack("<2i", 54, 0), cells)


# Units, parts, lines ------------------------------------------------------------------------------------------------

def unv_units(rng):
    factor = rng.choice([1.0, 1000.0, 100.0, 39.37007874015748])
    number = f"{factor:.17E}".replace("E", rng.choice(["D", "E"]))
    sets = [f"    -1\n   164\n         1SI units                    2\n{number:>25}{'1.0D+00':>25}{'1.0D+00':>25}\n"
            f"{'2.7315D+02':>25}\n    -1\n"]
    nodes = "".join(f"{i + 1:10}{1:10}{1:10}{11:10}\n" + "".join(f"{x * factor:25.16E}" for x in p) + "\n"
                    for i, p in enumerate(POINTS))
    elements = "".join(f"{i + 1:10}{111:10}{1:10}{1:10}{7:10}{4:10}\n" + "".join(f"{c + 1:10}" for c in t) + "\n"
                       for i, t in enumerate(TETRAHEDRA))
    text = f"    -1\n  2411\n{nodes}    -1\n    -1\n  2412\n{elements}    -1\n"
    return Variant("units.unv", "".join(sets) + text, BODY)


def abaqus_instance(rng):
    offset = rng.choice(["", "0,0,0\n", "0., 0., -0.0\n", "0.0, 0.0\n", "0., 0., 0.\n0., 0., 0., 0., 0., 1., 0.\n"])
    nodes = "".join(f"{i + 1}, {p[0]}, {p[1]}, {p[2]}\n" for i, p in enumerate(POINTS))
    cells = "".join(f"{i + 1}, {', '.join(str(c + 1) for c in t)}\n" for i, t in enumerate(TETRAHEDRA))
    text = f"*PART, NAME=p\n*NODE\n{nodes}*ELEMENT, TYPE=C3D4\n{cells}*END PART\n*ASSEMBLY, NAME=a\n"
    return Variant("instance.inp", text + f"*INSTANCE, NAME=i, PART=p\n{offset}*END INSTANCE\n*END ASSEMBLY\n", BODY)


def rows_at_fault(rng):
    """A row with a number too many, or one too few."""
    points = "".join(f"{p[0]} {p[1]} {p[2]}\n" for p in POINTS)
    faces = "".join(f"3 {' '.join(map(str, t))}\n" for t in TRIANGLES)
    kind = rng.choice(["msh", "medit", "ply", "off"])
    if kind == "msh":
        text, first, rows = msh_2("2.2"), 6, len(POINTS)
    elif kind == "medit":
        rows_of = "".join(f"{p[0]} {p[1]} {p[2]} 0\n" for p in POINTS)
        text = f"MeshVersionFormatted 2\nDimension 3\nVertices\n{len(POINTS)}\n{rows_of}Tetrahedra\n1\n1 2 3 4 1\nEnd\n"
        first, rows = 5, len(POINTS)
    elif kind == "ply":
        head = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        text = f"{head}element face 4\nproperty list uchar int vertex_indices\nend_header\n{points}{faces}"
        first, rows = 10, len(POINTS)
    else:
        text, first, rows = f"OFF\n6 4 0\n{points}{faces}", 3, len(POINTS)
    lines = text.split("\n")
    line = rng.randint(first, first + rows - 1)
    is_short = rng.random() < 0.5
    lines[line - 1] = lines[line - 1].rsplit(" ", 1)[0] if is_short else lines[line - 1] + " 0.25"
    return Variant(f"row.{kind if kind != 'medit' else 'mesh'}", "\n".join(lines), None, line=line)


KINDS = {"nastran": nastran, "nastran replication": nastran_replication, "MSH 2.0 names": msh_names, "MSH partitions": msh_partitions,
         "MSH sections": msh_sections, "VTK attributes": vtk_legacy, "STL normals": stl, "PLY strips": ply_strips,
         "OFF headers": off, "MEDIT plane": medit_plane, "UNV units": unv_units, "Abaqus instance": abaqus_instance,
         "rows at fault": rows_at_fault}


# The answers of sunder, meshio and gmsh -----------------------------------------------------------------------------

def read_cells(path, surface):
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        mesh = meshio.read(path)
    points = mesh.points if mesh.points.shape[1] == 3 else [(*p, 0.0) for p in mesh.points]
    kinds = {"tetra", "triangle"} if surface else {"tetra"}
    cells = sorted(c for block in mesh.cells if block.type in kinds for c in cells_of(points, block.data))
    return mesh, cells


def regions_of(mesh, name):
    """Tetrahedra with their regions."""
    return sorted((cell, int(region)) for block, column in zip(mesh.cells, mesh.cell_data[name]) if block.type == "tetra"
                  for cell, region in zip(([tuple(mesh.points[i]) for i in c] for c in block.data), column))


def is_same(cells, meant):
    def near(a, b):
        return all(abs(x - y) <= 1e-6 for p, q in zip(a, b) for x, y in zip(p, q))

    return len(cells) == len(meant) and all(any(near(c, m) for m in meant) for c in cells)


def convert(sunder, file, out, *words):
    done = subprocess.run([sunder, "convert", file, out, "--json", *words], capture_output=True, text=True, timeout=120)
    try:
        return done.returncode, json.loads(done.stdout)
    except ValueError:
        return done.returncode, {"findings": [{"text": done.stderr, "severity": "error"}]}


def judge(sunder, variant, folder):
    """The faults of sunder's answer; empty if the answer is as meant."""
    file, out = folder / variant.name, folder / "out.vtu"
    file.write_bytes(variant.content)
    status, answer = convert(sunder, file, out, "--text")
    words = "; ".join(f"{f['severity']} {f['text']}" for f in answer["findings"])
    if variant.line is not None:
        lines = [f.get("line") for f in answer["findings"] if f["severity"] == "error"]
        return "" if status == 3 and lines[:1] == [variant.line] else f"line {variant.line} is at fault, not {lines}: {words}"
    if status != 0:
        return f"not read: {words}"
    mesh, cells = read_cells(out, len(variant.cells[0]) == 3)  # partitions have triangles on their seams
    cells = turned(cells) if cells and len(cells[0]) == 3 and variant.name.endswith("ply") else cells
    if not is_same(cells, variant.cells):
        return f"other cells: {cells} for {variant.cells}"
    columns = {**mesh.point_data, **{k: [x for part in v for x in part] for k, v in mesh.cell_data.items()}}
    for name, meant in variant.arrays.items():
        found = columns.get(name)
        flat = [] if found is None else [float(x) for row in found for x in (row if hasattr(row, "__len__") else [row])]
        if flat != [float(x) for x in meant]:
            return f"array {name} is {flat}, not {meant}"
    if variant.regions is not None:
        if not has_regions(mesh, variant):
            return "other regions, or other partitions"
    strict, _ = convert(sunder, file, folder / "strict.vtu", "--strict")
    return "" if strict == int(variant.reports) else f"--strict ends with {strict}: {words}"


def has_regions(mesh, variant):
    regions = [r for _, r in regions_of(mesh, "region")]
    found = {int(p) for _, p in regions_of(mesh, "partition")}
    return sorted(regions) == sorted(r for _, r in variant.regions) and found == set(range(1, variant.parts + 1))


def others(variant, folder):
    """Whether meshio and gmsh read the file as it is meant: True, False; None where they do not read it."""
    if variant.cells is None:
        return None, None
    file, answers = folder / variant.name, []
    for program in ("meshio", "gmsh"):
        source = file
        if program == "gmsh":
            source = folder / "gmsh.msh"
            source.unlink(missing_ok=True)
            command = ["gmsh", str(file), "-0", "-save_all", "-format", "msh22", "-o", str(source)]
            if shutil.which("gmsh") is None or subprocess.run(command, capture_output=True, timeout=60).returncode != 0:
                answers.append(None)
                continue
        try:
            _, cells = read_cells(source, len(variant.cells[0]) == 3)
            cells = turned(cells) if variant.name.endswith("ply") and cells else cells
            answers.append(is_same(cells, variant.cells) if cells else None)
        except BaseException:  # meshio ends with SystemExit at times
            answers.append(None)
    return tuple(answers)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sunder", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=20, help="variants of each kind")
    parser.add_argument("--only", nargs="*", default=list(KINDS))
    parser.add_argument("--alone", action="store_true", help="without meshio and gmsh beside sunder")
    parser.add_argument("--keep", type=pathlib.Path, help="keep the files that went wrong here")
    arguments = parser.parse_args()
    if meshio is None:
        print("meshio is not installed")
        return 77
    failed = 0
    print("| kind | variants | as meant | meshio: same | other | not read | gmsh: same | other | not read |")
    print("|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for kind in arguments.only:
            good, answers = 0, []
            for seed in range(arguments.seeds):
                variant = KINDS[kind](random.Random(f"{kind} {seed}"))
                wrong = judge(arguments.sunder.resolve(), variant, folder)
                good += not wrong
                if wrong:
                    print(f"{kind} {seed}: {wrong[:400]}", file=sys.stderr)
                    if arguments.keep:
                        arguments.keep.mkdir(parents=True, exist_ok=True)
                        (arguments.keep / f"{kind.replace(' ', '_')}_{seed}_{variant.name}").write_bytes(variant.content)
                answers.append((None, None) if arguments.alone else others(variant, folder))
            failed += arguments.seeds - good
            counts = [sum(a[i] is x for a in answers) for i in (0, 1) for x in (True, False, None)]
            print(f"| {kind} | {arguments.seeds} | {good} | {' | '.join(map(str, counts))} |", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
