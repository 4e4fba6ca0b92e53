#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes the sample meshes in this folder with gmsh 4.8.4, python3-meshio 5.0.0, TetGen 1.5.0,
admesh 0.98.4, openscad 2021.01 and assimp 5.2.0 (Debian 12).

Run it here, without arguments: python3 make_samples.py. Gmsh's files hold two boxes of 12 and 24
tetrahedra (physical groups "core" = 7 and "shell" = 3), meshio's the same mesh converted.
"""
import pathlib
import subprocess

import meshio

GEO = """
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 0.7, 1, 1};
Coherence;
Physical Volume("core", 7) = {1};
Physical Volume("shell", 3) = {2};
Physical Surface("all around", 9) = {1};
Mesh.MeshSizeMin = 2; Mesh.MeshSizeMax = 2;
"""


def gmsh(name, *options, geo="two_boxes.geo"):
    subprocess.run(["gmsh", geo, "-3", *options, "-o", name], check=True, stdout=subprocess.DEVNULL)


pathlib.Path("two_boxes.geo").write_text(GEO)
pathlib.Path("no_groups.geo").write_text(
    "\n".join(line for line in GEO.splitlines() if "Physical" not in line))
for version in ("22", "41"):
    gmsh(f"gmsh_{version}.msh", "-format", f"msh{version}")
    gmsh(f"gmsh_{version}_binary.msh", "-format", f"msh{version}", "-bin")
gmsh("gmsh_40.msh", "-format", "msh40")
gmsh("gmsh_41_all.msh", "-format", "msh41", "-save_all")
gmsh("gmsh_41_parametric.msh", "-format", "msh41", "-save_all", "-save_parametric")
gmsh("gmsh_41_no_groups.msh", "-format", "msh41", geo="no_groups.geo")
gmsh("gmsh_41_second_order.msh", "-format", "msh41", "-order", "2")
gmsh("gmsh.mesh", "-format", "mesh")
gmsh("gmsh.vtk", "-format", "vtk")

mesh = meshio.read("gmsh_41.msh")
volume = meshio.Mesh(mesh.points, [("tetra", mesh.cells_dict["tetra"])],
                     cell_data={"region": [mesh.get_cell_data("gmsh:physical", "tetra")]},
                     point_data={"height": mesh.points[:, 2]})
volume.write("meshio_ascii.vtu", binary=False)
volume.write("meshio_plain.vtu", compression=None)
volume.write("meshio_zlib.vtu", compression="zlib")
volume.write("meshio_zlib_32.vtu", compression="zlib", header_type="UInt32")
volume.write("meshio_lzma.vtu", compression="lzma")
meshio.medit.write("meshio.mesh", meshio.Mesh(mesh.points, volume.cells))
meshio.gmsh.write("meshio_41.msh", mesh, fmt_version="4.1", binary=False)
meshio.gmsh.write("meshio_22.msh", mesh, fmt_version="2.2", binary=False)

# Surfaces: all 46 triangles of the two boxes, the wall between them included.
gmsh("gmsh.stl", "-format", "stl", "-save_all")
gmsh("gmsh_binary.stl", "-format", "stl", "-bin", "-save_all")
surface = meshio.read("gmsh.stl")
surface = meshio.Mesh(surface.points, surface.cells)
surface.write("meshio.off")
surface.write("meshio.obj")
surface.write("meshio.stl", binary=False)
surface.write("meshio.ply", binary=False)
surface.write("meshio_binary.ply", binary=True)
run = lambda *words: subprocess.run(words, check=True, timeout=60, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.DEVNULL)
run("admesh", "-c", "gmsh.stl", "-a", "admesh.stl")
run("admesh", "-c", "gmsh.stl", "-b", "admesh_binary.stl")
pathlib.Path("box.scad").write_text("cube([1, 2, 3]);")
run("openscad", "-o", "openscad.off", "box.scad")
run("openscad", "-o", "openscad.stl", "box.scad")
run("admesh", "openscad.stl", "--write-off=admesh.off")
run("assimp", "export", "openscad.stl", "assimp.obj")
run("assimp", "export", "openscad.stl", "assimp.ply")
run("assimp", "export", "openscad.stl", "assimp_binary.ply", "-fplyb")
for name in ("box.scad", "assimp.mtl"):
    pathlib.Path(name).unlink()
pathlib.Path("two_boxes.geo").unlink()
pathlib.Path("no_groups.geo").unlink()

# TetGen's own files: the same two boxes, their facets and regions as tetgen -p wants them.
POLY = """12 3 1 1
{points}
11 1
{facets}
0
2
0 0.5 0.5 0.5 7 -1
1 1.3 0.5 0.5 3 -1
"""
CORNERS = [(x, y, z) for x in (0, 1, 1.7) for y in (0, 1) for z in (0, 1)]
FACETS = [(0, 1, 3, 2, 0), (4, 5, 7, 6, 9), (8, 9, 11, 10, 6)] + [
    (4 * i + a, 4 * i + b, 4 * i + b + 4, 4 * i + a + 4, 5 + i)
    for i in (0, 1) for a, b in ((0, 1), (1, 3), (3, 2), (2, 0))]
for stem, options in (("tetgen", "-pzAfeQ"), ("tetgen_2nd", "-pzAfeo2Q")):
    poly = pathlib.Path(f"{stem}.poly")
    poly.write_text(POLY.format(
        points="\n".join(f"{i} {x} {y} {z} {i + 0.5} {1 + i // 6}"
                         for i, (x, y, z) in enumerate(CORNERS)),
        facets="\n".join(f"1 0 {f[4]}\n4 {f[0]} {f[1]} {f[2]} {f[3]}" for f in FACETS)))
    subprocess.run(["tetgen", options, poly], check=True, stdout=subprocess.DEVNULL)
    poly.unlink()
meshio.tetgen.write("meshio.node", meshio.Mesh(
    mesh.points, [("tetra", mesh.cells_dict["tetra"])], point_data={"height": mesh.points[:, 2] / 3},
    cell_data={"tetgen:ref": [mesh.get_cell_data("gmsh:physical", "tetra")]}))

# Abaqus' input by gmsh, by meshio, and by CalculiX' cgx, whose files are included by a small one.
pathlib.Path("two_boxes.geo").write_text(GEO)
gmsh("gmsh.inp", "-format", "inp")
gmsh("gmsh_2nd.inp", "-format", "inp", "-order", "2", "-save_all")
pathlib.Path("two_boxes.geo").unlink()
meshio.abaqus.write("meshio.inp", mesh)
pathlib.Path("cgx.fbl").write_text(
    "read gmsh.inp inp\nsend all abq\nsend core abq nam\nsend shell abq nam\nquit\n")
subprocess.run(["cgx", "-bg", "cgx.fbl"], check=True, stdout=subprocess.DEVNULL)
pathlib.Path("cgx.fbl").unlink()
for name in ("all.msh", "core.nam", "shell.nam"):
    pathlib.Path(name).rename(f"calculix_{name}")
pathlib.Path("calculix.inp").write_text(
    "".join(f"*INCLUDE, INPUT=calculix_{name}\n" for name in ("all.msh", "core.nam", "shell.nam")) +
    "*SOLID SECTION, ELSET=Ecore, MATERIAL=steel\n*SOLID SECTION, ELSET=Eshell, MATERIAL=foam\n")
