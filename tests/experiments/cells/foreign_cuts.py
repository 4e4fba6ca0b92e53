#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""`sunder cut --exact` on tetrahedra of other programs, compared with VTK's clip and rationals.

    tests/experiments/cells/foreign_cuts.py [--sunder build/release/sunder] [--mesher build/release/sunder-mesh] [--keep DIR]

Ten bodies by gmsh (Delaunay and HXT, one body of two regions), netgen, TetGen and VTK; with --mesher one
more by CGAL's Mesh_3. Each is cut by seven planes: across each axis through the middle, two at random, one through a vertex
and one through the three corners of a tetrahedron's face (as far as doubles say so). Of each cut:
  clean    `sunder check` ends with 0 and says no more than it says of the whole body, which came apart. A plane that passes
           nearer to a point than 1e-6 of an edge has a line of its own: an exact cut has to make
           flat tetrahedra there. It is made again with --tolerance 1e-6, which has to be clean; its
           volumes may then be out by 1e-6 of an edge
  exact    volume of each side, summed over the tetrahedra written, over the volume that rationals give of the same plane and
           the same points: relative difference, the largest over both sides
  VTK      the same against vtkTableBasedClipDataSet
A line a body: the worst of its planes. Exit code 1 when a check is not clean or a difference above 1e-12. Needs gmsh,
netgen, python3-netgen, tetgen, python3-vtk9, python3-meshio, python3-numpy (Debian)."""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile
from fractions import Fraction

import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

TREE = pathlib.Path(__file__).resolve().parents[3]

GMSH = {
    "gmsh-box-less-ball": (1, """Box(1) = {0,0,0,1,1,1}; Sphere(2) = {0.4,0.5,0.6,0.3};
        BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};"""),
    "gmsh-pipe": (10, """Cylinder(1) = {0,0,0,0,0.2,1,0.4}; Cylinder(2) = {0,0,-1,0.1,0,3,0.2};
        BooleanDifference(3) = {Volume{1}; Delete;}{Volume{2}; Delete;};"""),
    "gmsh-torus": (10, "Torus(1) = {0.1,0.2,0.3,0.7,0.25};"),
    "gmsh-two-regions": (1, """Box(1) = {0,0,0,1,1,1}; Sphere(2) = {0.5,0.5,0.5,0.3};
        BooleanFragments{Volume{1}; Delete;}{Volume{2}; Delete;}
        Physical Volume("ball", 1) = {2}; Physical Volume("around", 2) = {3};"""),
}


def run(*words, code=0):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
    if code is not None and done.returncode != code:
        raise SystemExit(f"{' '.join(map(str, words))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done


# ---- bodies: name, path of a mesh of theirs ------------------------------------------------------

def by_gmsh(folder, name):
    algorithm, text = GMSH[name]
    geo, out = folder / f"{name}.geo", folder / f"{name}.msh"
    geo.write_text('SetFactory("OpenCASCADE");\n' + text +
                   "\nMesh.CharacteristicLengthMin = 0.08;\nMesh.CharacteristicLengthMax = 0.1;\n"
                   f"Mesh.Algorithm3D = {algorithm};\n")
    run("gmsh", "-3", geo, "-o", out, "-v", "1")
    return out


NETGEN = """
import sys
from netgen.csg import CSGeometry, Cylinder, OrthoBrick, Pnt, Sphere
geometry, cube = CSGeometry(), OrthoBrick(Pnt(0, 0, 0), Pnt(1, 1, 1))
geometry.Add({})
geometry.GenerateMesh(maxh=0.12).Export(sys.argv[1], "Gmsh2 Format")
"""
NETGEN_BODIES = {"netgen-drilled": "cube - Cylinder(Pnt(0.5, 0.5, -1), Pnt(0.6, 0.4, 2), 0.25)",
                 "netgen-cube-and-ball": "cube * Sphere(Pnt(0.5, 0.5, 0.5), 0.65)"}


def by_netgen(folder, name):
    """In a process of its own: it says much."""
    run(sys.executable, "-c", NETGEN.format(NETGEN_BODIES[name]), folder / f"{name}.msh")
    return folder / f"{name}.msh"


def icosphere(radius, levels):
    """Points and triangles, outwards."""
    g = (1 + 5 ** 0.5) / 2
    points = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g), (g, 0, -1),
              (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7),
             (9, 8, 1)]
    for _ in range(levels):
        middles, finer = {}, []
        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append(tuple((x + y) / 2 for x, y in zip(points[a], points[b])))
            return middles[key]
        for a, b, c in faces:
            x, y, z = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, x, z), (x, b, y), (z, y, c), (x, y, z)]
        faces = finer
    return [tuple(radius * x / math.sqrt(sum(y * y for y in p)) for x in p) for p in points], faces


def by_tetgen(folder, name, sunder):
    """From a surface: .poly, as TetGen reads it."""
    holes = []
    if name == "tetgen-bunny":
        run(sunder, "convert", TREE / "meshes/bunny.msh", folder / "bunny.off")
        lines = (folder / "bunny.off").read_text().split("\n")
        words = " ".join(line for line in lines[1:] if not line.startswith("#")).split()
        n, m = int(words[0]), int(words[1])
        numbers = words[3:]
        points = [tuple(map(float, numbers[3 * i:3 * i + 3])) for i in range(n)]
        rest = numbers[3 * n:]
        faces = [tuple(map(int, rest[4 * i + 1:4 * i + 4])) for i in range(m)]
        volume = "5e-8"
    else:
        points, faces = icosphere(1, 2)
        inner, more = icosphere(0.5, 1)
        faces = faces + [tuple(len(points) + v for v in f) for f in more]
        points = points + [(x + 0.1, y, z - 0.2) for x, y, z in inner]
        holes, volume = [(0.1, 0, -0.2)], "0.003"
    text = [f"{len(points)} 3 0 0"] + [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(points)]
    text += [f"{len(faces)} 0"] + [f"1\n3 {a} {b} {c}" for a, b, c in faces]
    text += [str(len(holes))] + [f"{i} {x} {y} {z}" for i, (x, y, z) in enumerate(holes)] + ["0"]
    (folder / f"{name}.poly").write_text("\n".join(text) + "\n")
    run("tetgen", "-pq1.3", f"-a{volume}", "-Q", folder / f"{name}.poly")
    return folder / f"{name}.1.node"


def by_vtk(folder, name):
    draw = np.random.default_rng(7)
    points = draw.random((1500, 3)) if name == "vtk-cloud" else np.array(icosphere(1, 3)[0] + [
        tuple(p) for p in draw.uniform(-0.55, 0.55, (600, 3))])
    cloud = vtk.vtkPoints()
    cloud.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    data = vtk.vtkPolyData()
    data.SetPoints(cloud)
    mesher = vtk.vtkDelaunay3D()
    mesher.SetInputData(data)
    mesher.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    mesher.Update()
    grid = mesher.GetOutput()
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    x = vtk_to_numpy(grid.GetPoints().GetData())
    d = np.linalg.det(x[cells[:, 1:]] - x[cells[:, :1]])
    out = folder / f"{name}.vtu"
    meshio.write(out, meshio.Mesh(x, [("tetra", cells[np.abs(d) > 1e-9])]))  # its flat ones are no bodies
    return out


def by_cgal(folder, mesher):
    points, faces = icosphere(1, 3)
    points = [(x * (1 + 0.2 * math.sin(5 * z)), y, 1.5 * z) for x, y, z in points]
    off = folder / "egg.off"
    off.write_text(f"OFF\n{len(points)} {len(faces)} 0\n" + "\n".join("%r %r %r" % p for p in points) + "\n" +
                   "\n".join("3 %d %d %d" % f for f in faces) + "\n")
    out = folder / "cgal-mesh-3.msh"
    run(mesher, off, out, "--count", 6000)
    return out


# ---- volumes -------------------------------------------------------------------------------------

def det3(u, v, w):
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
            u[2] * (v[0] * w[1] - v[1] * w[0]))


def share_above(s):
    """Part of a tetrahedron's volume where the linear function with the values `s` at its corners is positive."""
    up = [i for i in range(4) if s[i] > 0]
    down = [i for i in range(4) if s[i] < 0]
    if not down or not up:
        return Fraction(1 if up else 0)
    if len(up) == 1 or len(down) == 1:
        one = up[0] if len(up) == 1 else down[0]
        corner = Fraction(1)
        for j in range(4):
            if j != one:
                corner *= s[one] / (s[one] - s[j]) if (s[j] > 0) != (s[one] > 0) else 1
        return corner if len(up) == 1 else 1 - corner
    (a, b), (c, d) = up, down
    at = lambda i, j: s[i] / (s[i] - s[j])  # how far from i towards j
    ac, ad, bc, bd = at(a, c), at(a, d), at(b, c), at(b, d)
    # The wedge a ac ad, b bc bd as three tetrahedra: determinants of their corners' weights.
    return ac * ad + ad * bc * (1 - ac) + bc * bd * (1 - ad)


def exact_sides(x, cells, normal, offset):
    """[above, below] in rationals; points times a power of two are whole numbers."""
    scale = 2 ** max(0, max(60 - math.frexp(v)[1] for v in np.unique(np.abs(x[x != 0]))[:1]))
    whole = [tuple(int(Fraction(float(v)) * scale) for v in p) for p in x]
    assert all(Fraction(w, scale) == Fraction(float(v)) for p, q in zip(whole, x) for w, v in zip(p, q))
    n = [Fraction(float(v)) for v in normal]
    side = [sum(a * b for a, b in zip(n, p)) - Fraction(float(offset)) * scale for p in whole]
    sides = [Fraction(0), Fraction(0)]
    for t in cells:
        p = [whole[v] for v in t]
        six = abs(det3(*([b - a for a, b in zip(p[0], q)] for q in p[1:])))
        above = share_above([side[v] for v in t])
        sides[0] += six * above
        sides[1] += six * (1 - above)
    return [float(v / 6 / Fraction(scale) ** 3) for v in sides]


def written_sides(path, normal, offset):
    mesh = meshio.read(path)
    x, t = mesh.points, mesh.cells_dict["tetra"]
    d = x @ normal - offset
    corners = d[t]
    farthest = np.take_along_axis(corners, np.abs(corners).argmax(axis=1)[:, None], axis=1)[:, 0]
    u, v, w = (x[t[:, i]] - x[t[:, 0]] for i in (1, 2, 3))
    volume = np.abs((u * np.cross(v, w)).sum(axis=1)) / 6
    return [math.fsum(volume[farthest > 0]), math.fsum(volume[farthest < 0])]


def vtk_sides(x, cells, normal, offset):
    cells = cells.copy()
    turned = np.linalg.det(x[cells[:, 1:]] - x[cells[:, :1]]) < 0  # netgen's; VTK counts them negative
    cells[turned] = cells[turned][:, [0, 2, 1, 3]]
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(x), deep=True))
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    rows = vtk.vtkCellArray()
    rows.SetData(4, numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells.astype(np.int64).ravel()), deep=True))
    grid.SetCells(vtk.VTK_TETRA, rows)
    length = np.linalg.norm(normal)
    plane = vtk.vtkPlane()
    plane.SetNormal(*(normal / length))
    plane.SetOrigin(*(normal * offset / length ** 2))
    sides = []
    for below in (0, 1):
        clip = vtk.vtkTableBasedClipDataSet()
        clip.SetInputData(grid)
        clip.SetClipFunction(plane)
        clip.SetInsideOut(below)
        clip.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
        size = vtk.vtkCellSizeFilter()
        size.SetInputConnection(clip.GetOutputPort())
        size.Update()
        sides.append(math.fsum(vtk_to_numpy(size.GetOutput().GetCellData().GetArray("Volume"))))
    return sides


# ---- cuts ----------------------------------------------------------------------------------------

def planes_of(x, cells, draw):
    low, high = x.min(axis=0), x.max(axis=0)
    middle = (low + high) / 2
    for axis in range(3):
        yield np.eye(3)[axis], middle[axis]
    for _ in range(2):
        n = draw.normal(size=3)
        yield n, float(n @ (middle + draw.uniform(-0.15, 0.15, 3) * (high - low)))
    near = np.argsort(np.linalg.norm(x - middle, axis=1))
    n = draw.normal(size=3)
    yield n, float(n @ x[near[0]])
    centres = x[cells].mean(axis=1)
    a, b, c = (x[v] for v in cells[np.linalg.norm(centres - middle, axis=1).argmin()][:3])
    n = np.cross(b - a, c - a)
    n /= np.linalg.norm(n)
    yield n, float(n @ a)


def findings(sunder, path):
    done = run(sunder, "check", path, "--json", code=None)
    said = json.loads(done.stdout)
    return done.returncode, {f["code"] for f in said.get("findings", []) if f["severity"] != "note"}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--sunder", default=str(TREE / "build/release/sunder"))
    parser.add_argument("--mesher", help="sunder-mesh, for a body by CGAL's Mesh_3")
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for the meshes")
    arguments = parser.parse_args()
    sunder = arguments.sunder
    with tempfile.TemporaryDirectory() as name:
        folder = arguments.keep or pathlib.Path(name)
        folder.mkdir(parents=True, exist_ok=True)
        bodies = [(n, by_gmsh(folder, n)) for n in GMSH]
        bodies += [(n, by_netgen(folder, n)) for n in NETGEN_BODIES]
        bodies += [(n, by_tetgen(folder, n, sunder)) for n in ("tetgen-bunny", "tetgen-ball-less-ball")]
        bodies += [(n, by_vtk(folder, n)) for n in ("vtk-cloud", "vtk-ball")]
        if arguments.mesher:
            bodies.append(("cgal-mesh-3", by_cgal(folder, arguments.mesher)))
        draw, right = np.random.default_rng(11), True
        print(f"{'body':24}{'tetrahedra':>11}{'planes':>8}{'clean':>7}{'divided':>9}{'exact':>10}{'VTK':>10}")
        for body, path in bodies:
            plain, out = folder / "plain.vtu", folder / "cut.vtu"
            run(sunder, "convert", path, plain)
            mesh = meshio.read(plain)
            x, cells = mesh.points.astype(float), mesh.cells_dict["tetra"]
            _, before = findings(sunder, plain)
            clean = planes = divided = 0
            worst = [0.0, 0.0]
            for normal, offset in planes_of(x, cells, draw):
                words = ",".join(repr(float(v)) for v in (*normal, offset))
                told = json.loads(run(sunder, "cut", plain, out, f"--plane={words}", "--exact", "--json").stdout)
                ours, exact = written_sides(out, normal, offset), exact_sides(x, cells, normal, offset)
                code, said = findings(sunder, out)
                if told["nearest_to_an_end"] < 1e-6 and not (code == 0 and said <= before):
                    run(sunder, "cut", plain, out, f"--plane={words}", "--exact", "--tolerance", "1e-6")
                    moved = max(abs(a / b - 1) for a, b in zip(written_sides(out, normal, offset), exact))
                    print(f"  {body}, plane {words}: divides an edge at {told['nearest_to_an_end']:.1e} of it, exit code "
                          f"{code}, {sorted(said - before)}; with --tolerance 1e-6 volumes differ by {moved:.1e}")
                    code, said = findings(sunder, out)
                planes += 1
                divided += told["divided"]
                clean += code == 0 and said <= before and told["after"]["components"] > told["before"]["components"]
                if code != 0 or not said <= before:
                    print(f"  {body}, plane {words}: exit code {code}, {sorted(said - before)}")
                theirs = vtk_sides(x, cells, normal, offset)
                for i, other in enumerate((exact, theirs)):
                    worst[i] = max(worst[i], *(abs(a / b - 1) for a, b in zip(ours, other)))
            print(f"{body:24}{len(cells):11}{planes:8}{clean:7}{divided:9}{worst[0]:10.1e}{worst[1]:10.1e}", flush=True)
            right &= clean == planes and max(worst) <= 1e-12
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
