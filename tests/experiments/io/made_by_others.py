#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Files of other programs: made by them, read by sunder, sent through formats and compared.

Usage: made_by_others.py SUNDER [--keep FOLDER] [--only PROGRAM ...] [--page PAGE.md]

Makes more than 300 mesh files with Debian's gmsh, meshio, VTK, CalculiX' cgx, netgen, Blender,
OpenSCAD and assimp: bodies and surfaces, linear and of second order, every format, version and encoding that
they write and sunder reads. Each is read; then it goes through several formats and back. Both the
file and the returned mesh are written as VTK's text: the same bytes (and names of regions) are
`exact`, and so is one label per cell where the format has one (entities stand for regions that are
not there). Else it is `told` where sunder reported at one of the steps that something is lost or
left out, and `untold` where it did not.
Prints Markdown: a row per program and format; --page puts it between its marks. Exit code 1: a file
was not read, a round trip failed or lost something untold; 77: gmsh or meshio is not installed.
Programs that are not installed are left out, and said to be."""
import argparse
import importlib.util
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from collections import defaultdict

try:
    import meshio
except ImportError:
    meshio = None

MARKS = ("<!-- others -->", "<!-- end of others -->")
THROUGH = ["msh", "vtu", "inp", "unv"]
THROUGH_OF_SURFACES = ["msh", "vtp", "ply", "obj"]

BLOCK = """
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1:4} = 4; Transfinite Surface{1};
%s
out[] = Extrude{0, 0, 1}{ Surface{1}; Layers{3}; %s };
Physical Volume("block", 5) = {out[1]};
Physical Surface("bottom", 6) = {1};
Physical Curve("rim", 8) = {1, 2};
Physical Point("corner", 9) = {1};
Mesh.SecondOrderIncomplete = %d;
"""
OCC = 'SetFactory("OpenCASCADE");\n%s\nMesh.MeshSizeMin = %g; Mesh.MeshSizeMax = %g;\n'
BODIES = {
    "boxes": OCC % ('Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {1, 0, 0, 0.7, 1, 1}; Coherence;\n'
                    'Physical Volume("core", 7) = {1}; Physical Volume("shell", 3) = {2};\n'
                    'Physical Surface("all around", 9) = {1};', 0.6, 0.6),
    "ball": OCC % ('Sphere(1) = {0, 0, 0, 1};', 0.7, 0.7),
    "ring": OCC % ('Torus(1) = {0, 0, 0, 1, 0.3};\nPhysical Volume("ring") = {1};', 0.4, 0.4),
    "hexahedra": BLOCK % ("Recombine Surface{1};", "Recombine;", 0),
    "serendipity": BLOCK % ("Recombine Surface{1};", "Recombine;", 1),
    "prisms": BLOCK % ("", "Recombine;", 0),
    "wedges": BLOCK % ("", "Recombine;", 1),
}
GMSH_WAYS = [("msh1", "msh"), ("msh22", "msh"), ("msh22 -bin", "msh"), ("msh40", "msh"), ("msh41", "msh"),
             ("msh41 -bin", "msh"), ("msh41 -save_all", "msh"), ("msh41 -save_parametric", "msh"), ("mesh", "mesh"),
             ("vtk", "vtk"), ("vtk -bin", "vtk"), ("inp", "inp"), ("inp -save_all", "inp"), ("unv", "unv"),
             ("unv -save_all", "unv"), ("bdf -setnumber Mesh.BdfFieldFormat 0", "bdf"),
             ("bdf -setnumber Mesh.BdfFieldFormat 1", "bdf"), ("bdf -setnumber Mesh.BdfFieldFormat 2", "bdf"),
             ("stl", "stl"), ("stl -bin", "stl")]


def run(*words, **more):
    return subprocess.run([str(w) for w in words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=300, **more)


def by_gmsh(folder, needed=None):
    """`needed`: the ways that the other programs' files are made from, where gmsh's own are not asked for."""
    for name, geo in BODIES.items():
        source = folder / f"{name}.geo"
        source.write_text(geo)
        for order in (1, 2):
            for i, (words, ending) in enumerate(GMSH_WAYS):
                if ending == "stl" and order == 2 or needed and i not in needed:
                    continue
                whole = order == 2 and "Extrude" in geo and "Incomplete = 0" in geo
                if ending == "mesh" and order == 2 and "Extrude" in geo or ending == "inp" and whole:
                    continue  # gmsh 4.8 writes 27 and 18 nodes under the names of cells of 8 and 6: broken files
                out = folder / f"gmsh_{name}_{order}_{i:02}.{ending}"
                run("gmsh", source, "-3", "-order", order, "-format", *words.split(), "-o", out)
                yield "gmsh", words.split(" -setn")[0], out


def by_meshio(folder):
    ways = [("vtu text", "vtu", lambda p, m: m.write(p, binary=False)), ("vtu", "vtu", lambda p, m: m.write(p)),
            ("vtu plain", "vtu", lambda p, m: m.write(p, compression=None)),
            ("vtk 4.2", "vtk", lambda p, m: meshio.vtk.write(p, m, "4.2")),
            ("vtk 4.2 text", "vtk", lambda p, m: meshio.vtk.write(p, m, "4.2", binary=False)),
            ("vtk 5.1", "vtk", lambda p, m: meshio.vtk.write(p, m, "5.1")),
            ("vtk 5.1 text", "vtk", lambda p, m: meshio.vtk.write(p, m, "5.1", binary=False)),
            ("medit", "mesh", lambda p, m: meshio.medit.write(p, m)), ("medit binary", "meshb", lambda p, m: m.write(p)),
            ("abaqus", "inp", lambda p, m: meshio.abaqus.write(p, m)),
            ("nastran small", "nas", lambda p, m: meshio.nastran.write(p, m, "fixed-small", "fixed-small")),
            ("nastran large", "nas", lambda p, m: meshio.nastran.write(p, m, "fixed-large", "fixed-small")),
            ("gmsh 2.2", "msh", lambda p, m: meshio.gmsh.write(p, m, "2.2", binary=False)),
            ("gmsh 4.1", "msh", lambda p, m: meshio.gmsh.write(p, m, "4.1", binary=True)),
            ("tetgen", "node", lambda p, m: meshio.tetgen.write(p, m))]
    faces = [("off", "off", lambda p, m: m.write(p)), ("obj", "obj", lambda p, m: m.write(p)),
             ("stl", "stl", lambda p, m: m.write(p, binary=True)), ("stl text", "stl", lambda p, m: m.write(p)),
             ("ply", "ply", lambda p, m: m.write(p)), ("ply text", "ply", lambda p, m: m.write(p, binary=False))]
    for name in BODIES:
        for order in (1, 2):
            source = folder / f"gmsh_{name}_{order}_02.msh"
            try:
                mesh = meshio.read(source)
            except Exception:
                continue  # meshio does not know all of gmsh's cells
            mesh = meshio.Mesh(mesh.points, mesh.cells, point_data={"height": mesh.points[:, 2] / 3},
                               cell_data={k: v for k, v in mesh.cell_data.items() if k.startswith("gmsh:ph")})
            surface = [c for c in mesh.cells if c.type == "triangle"]
            for i, (words, ending, write) in enumerate(ways + (faces if surface and order == 1 else [])):
                out = folder / f"meshio_{name}_{order}_{i:02}.{ending}"
                own = mesh if i < len(ways) else meshio.Mesh(mesh.points, surface)
                try:
                    write(str(out), own)
                except BaseException:
                    out.unlink(missing_ok=True)  # a kind of cell that meshio does not write there
                    continue
                yield "meshio", words, out


def by_vtk(folder):
    import vtk
    sources = {"sphere": vtk.vtkSphereSource(), "cylinder": vtk.vtkCylinderSource(), "plane": vtk.vtkPlaneSource(),
               "cone": vtk.vtkConeSource(), "dodecahedron": vtk.vtkPlatonicSolidSource()}
    sources["dodecahedron"].SetSolidTypeToDodecahedron()
    stripper = vtk.vtkStripper()
    stripper.SetInputConnection(sources["sphere"].GetOutputPort())
    sources["strips"] = stripper
    contour = vtk.vtkFeatureEdges()
    contour.SetInputConnection(sources["plane"].GetOutputPort())
    sources["lines"] = contour
    for name, source in sources.items():
        source.Update()
        data = source.GetOutput()
        for version in (42, 51):
            for binary in (False, True):
                writer = vtk.vtkPolyDataWriter()
                writer.SetFileVersion(version)
                writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
                yield from vtk_file(writer, data, folder / f"vtk_{name}_{version}_{binary:d}.vtk", "vtk polydata")
        for mode in range(3):
            writer = vtk.vtkXMLPolyDataWriter()
            writer.SetDataMode(mode)
            yield from vtk_file(writer, data, folder / f"vtk_{name}_{mode}.vtp", "vtp")
        if name in ("lines", "strips"):
            continue
        triangles = vtk.vtkTriangleFilter()
        triangles.SetInputData(data)
        triangles.Update()
        for binary in (False, True):
            for words, writer in (("stl", vtk.vtkSTLWriter()), ("ply", vtk.vtkPLYWriter())):
                writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
                yield from vtk_file(writer, triangles.GetOutput(), folder / f"vtk_{name}_{binary:d}.{words}", words)
        yield from vtk_file(vtk.vtkOBJWriter(), data, folder / f"vtk_{name}.obj", "obj")
    for name in BODIES:
        for order in (1, 2):
            reader = vtk.vtkUnstructuredGridReader()
            reader.SetFileName(str(folder / f"gmsh_{name}_{order}_09.vtk"))
            reader.Update()
            for mode in range(3):
                writer = vtk.vtkXMLUnstructuredGridWriter()
                writer.SetDataMode(mode)
                yield from vtk_file(writer, reader.GetOutput(), folder / f"vtk_{name}_{order}_{mode}.vtu", "vtu")


def vtk_file(writer, data, out, words):
    writer.SetInputData(data)
    writer.SetFileName(str(out))
    if writer.Write() == 1:
        yield "VTK", words, out


def by_cgx(folder):
    for name in BODIES:
        for order in (1, 2):
            inside = folder / f"cgx_{name}_{order}"
            inside.mkdir()
            source = folder / f"gmsh_{name}_{order}_11.inp"
            if not source.exists():
                continue
            shutil.copy(source, inside / "in.inp")
            (inside / "do.fbl").write_text("read in.inp inp\nsend all abq\nsend all nas\nsend all stl\nquit\n")
            run("cgx", "-bg", "do.fbl", cwd=inside)
            for words, made, ending in (("abq", "all.msh", "inp"), ("nas", "all.bdf", "bdf"), ("stl", "all.stl", "stl")):
                if (inside / made).exists():
                    yield "cgx", words, (inside / made).rename(folder / f"cgx_{name}_{order}.{ending}")


def by_netgen(folder):
    program = """
import sys
from netgen.csg import *
bodies = {'brick': OrthoBrick(Pnt(0, 0, 0), Pnt(1, 2, 1)), 'ball': Sphere(Pnt(0, 0, 0), 1),
          'cut': OrthoBrick(Pnt(0, 0, 0), Pnt(1, 1, 1)) - Sphere(Pnt(0, 0, 0), 0.6)}
for name, body in bodies.items():
    geometry = CSGeometry()
    geometry.Add(body)
    mesh = geometry.GenerateMesh(maxh=0.7)
    for order in (1, 2):
        if order == 2: mesh.SecondOrder()
        for way, ending in (('Abaqus Format', 'inp'), ('Gmsh Format', 'msh'), ('Gmsh2 Format', 'msh'), ('STL Format', 'stl')):
            try: mesh.Export(f'netgen_{name}_{order}_{way.split()[0]}.{ending}', way)
            except Exception as e: print(e)
"""
    run("/usr/bin/python3", "-c", program, cwd=folder)
    for file in sorted(folder.glob("netgen_*")):
        yield "netgen", file.stem.split("_")[-1], file


def by_blender(folder):
    program = """
import bpy
for name in ('cube', 'uv_sphere', 'ico_sphere', 'torus', 'monkey', 'cylinder'):
    bpy.ops.object.select_all(action='SELECT'); bpy.ops.object.delete()
    getattr(bpy.ops.mesh, f'primitive_{name}_add')()
    out = f'blender_{name}'
    bpy.ops.export_mesh.stl(filepath=out + '_binary.stl')
    bpy.ops.export_mesh.stl(filepath=out + '_text.stl', ascii=True)
    bpy.ops.export_mesh.ply(filepath=out + '_binary.ply', use_ascii=False)
    bpy.ops.export_mesh.ply(filepath=out + '_text.ply', use_ascii=True)
    bpy.ops.wm.obj_export(filepath=out + '_.obj')
"""
    run("blender", "-b", "--python-expr", program, cwd=folder)
    for file in sorted(folder.glob("blender_*")):
        if file.suffix != ".mtl":
            yield "Blender", file.suffix[1:], file


def by_openscad(folder):
    models = {"box": "cube([1, 2, 3]);", "nut": "difference() { cylinder(3, 4, 4, $fn=6); cylinder(9, 2, 2, center=true); }",
              "ball": "sphere(2, $fn=16);"}
    for name, model in models.items():
        source = folder / f"{name}.scad"
        source.write_text(model)
        for ending in ("stl", "off"):
            out = folder / f"openscad_{name}.{ending}"
            run("openscad", "-o", out, source)
            if out.exists():
                yield "OpenSCAD", ending, out


def by_assimp(folder):
    for source in sorted(folder.glob("openscad_*.stl")) + sorted(folder.glob("blender_*_.obj")):
        for way, ending in (("obj", "obj"), ("stl", "stl"), ("stlb", "stl"), ("ply", "ply"), ("plyb", "ply")):
            out = folder / f"assimp_{source.stem}_{way}.{ending}"
            run("assimp", "export", source, out, f"-f{way}")
            if out.exists():
                yield "assimp", way, out


# The makers of files, and their needs: a command, or a module of Python.
MAKERS = [(by_gmsh, "gmsh"), (by_meshio, "python3-meshio"), (by_vtk, "python3-vtk9"), (by_cgx, "cgx"), (by_netgen, "python3-netgen"),
          (by_blender, "blender"), (by_openscad, "openscad"), (by_assimp, "assimp")]
MODULES = {"python3-meshio": "meshio", "python3-vtk9": "vtk", "python3-netgen": "netgen"}


def is_there(program):
    module = MODULES.get(program)
    return importlib.util.find_spec(module) is not None if module else shutil.which(program) is not None


def convert(sunder, source, out, *words):
    done = subprocess.run([sunder, "convert", source, out, "--json", *words], capture_output=True, text=True, timeout=120)
    try:
        return done.returncode, json.loads(done.stdout)
    except ValueError:
        return done.returncode, {}


def words_of(answer):
    return "; ".join(f"{f['severity']} {f['code']}: {f['text']}" for f in answer.get("findings", []))


def content(path):
    beside = pathlib.Path(f"{path}.regions")
    return path.read_text(), beside.read_text() if beside.exists() else ""


def labelled(text):
    """The file without regions and entities of cells, and one label a cell: its region, or its entity where it has
    none: formats with one label get that (docs/reference/formats.md)."""
    points, _, cells = text.partition("CELL_DATA ")
    labels = {}
    for name in ("region", "entity"):
        found = re.search(rf"^{name} 1 (\d+) int\n((?:-?\d+\n)+)", cells, re.M)
        if found:
            labels[name] = found[2].split()
            cells = cells[:found.start()] + cells[found.end():]
    cells = re.sub(r"FIELD FieldData \d+\n", "", cells)
    if len(labels) == 2:
        labels = {"region": [e if r == "0" else r for r, e in zip(labels["region"], labels["entity"])]}
    return points, cells.partition("\n")[2], next(iter(labels.values()), [])


def judge(sunder, file, folder):
    """(whether it is read, the result of each way through a format, words about faults)"""
    plain = folder / "plain.vtk"
    for old in folder.glob("*"):
        old.unlink()
    status, first = convert(sunder, file, plain, "--text")
    if status != 0:
        return False, {}, [f"not read: {words_of(first)}"]
    ways, said = {}, []
    is_surface = not any(word.endswith(("hedra", "prisms", "pyramids")) and n > 0
                         for word, n in first["counts"].items())
    for ending in THROUGH_OF_SURFACES if is_surface else THROUGH:
        middle, back = folder / f"middle.{ending}", folder / f"back_{ending}.vtk"
        there, one = convert(sunder, file, middle)
        again, two = convert(sunder, middle, back, "--text") if there == 0 else (0, {})
        codes = {finding.get("code") for finding in one.get("findings", [])}
        if there != 0 and "nothing_left" in codes:
            ways[ending] = "told"  # the format holds none of its cells: refused, and nothing is written
        elif there != 0 or again != 0:
            ways[ending] = "failed"
            said.append(f"{ending}: {words_of(one)} {words_of(two)}")
        elif content(plain) == content(back) or labelled(content(plain)[0]) == labelled(content(back)[0]):
            ways[ending] = "exact"
        elif not one["lossless"] or not two["lossless"] or not first["lossless"]:
            ways[ending] = "told"
        else:
            ways[ending] = "untold"
            said.append(f"{ending}: lost without a word")
    return True, ways, said


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sunder", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path, help="folder that the files stay in")
    parser.add_argument("--only", nargs="+", help="judge the files of these programs alone")
    parser.add_argument("--page", type=pathlib.Path, help="page to put the table into")
    options = parser.parse_args()
    sunder = options.sunder.resolve()
    if meshio is None or shutil.which("gmsh") is None:
        print("meshio or gmsh is not installed")
        sys.exit(77)
    rows, missing, good = defaultdict(lambda: defaultdict(int)), [], True
    with tempfile.TemporaryDirectory() as made, tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(made)
        if options.keep:
            folder = options.keep.resolve()
            folder.mkdir(parents=True, exist_ok=True)
        for maker, program in MAKERS:
            if not is_there(program):
                missing.append(program)
                continue
            wanted = lambda who: not options.only or who in options.only
            for who, words, file in maker(folder, (2, 9, 11)) if program == "gmsh" and not wanted("gmsh") else maker(folder):
                if not wanted(who) or not file.exists() or file.stat().st_size == 0:
                    continue
                is_read, ways, said = judge(sunder, file, pathlib.Path(scratch))
                row = rows[who, words]
                row["files"] += 1
                row["read"] += is_read
                for way in ways.values():
                    row[way] += 1
                good = good and is_read and not {"failed", "untold"} & set(ways.values())
                for text in said:
                    print(f"{file.name}: {text}", file=sys.stderr)
    columns = ["files", "read", "exact", "told", "failed", "untold"]
    lines = ["| made by | as | files | read | exact | told | failed | untold |", "|---|---|---|---|---|---|---|---|"]
    for (who, words), row in rows.items():
        lines.append(f"| {who} | {words} | " + " | ".join(str(row[c]) for c in columns) + " |")
    total = [sum(row[c] for row in rows.values()) for c in columns]
    lines.append("| all | | " + " | ".join(map(str, total)) + " |")
    if missing:
        lines.append(f"\nNot installed, and left out: {', '.join(missing)}.")
    table = "\n".join(lines)
    print(table)
    if options.page:
        text = options.page.read_text()
        begin, end = (text.index(mark) for mark in MARKS)
        options.page.write_text(text[:begin] + MARKS[0] + "\n" + table + "\n" + text[end:])
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
