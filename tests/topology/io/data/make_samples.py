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

# Abaqus' input by gmsh, by meshio, and by CalculiX' cgx; the latter's files are included by a small
# one.
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

# Nastran's bulk data and universal files by gmsh and meshio: the two boxes in the three kinds of
# fields, and a block of two hexahedra with its bottom, two edges and a corner, of both orders.
BLOCK = """
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1:4} = 2;
Transfinite Surface{1};
Recombine Surface{1};
out[] = Extrude{0, 0, 1}{ Surface{1}; Layers{2}; Recombine; };
Physical Volume("block", 5) = {out[1]};
Physical Surface("bottom", 6) = {1};
Physical Curve("rim", 8) = {1, 2};
Physical Point("corner", 9) = {1};
Mesh.SecondOrderIncomplete = 1;
"""
pathlib.Path("two_boxes.geo").write_text(GEO)
pathlib.Path("block.geo").write_text(BLOCK)
pathlib.Path("prisms.geo").write_text(BLOCK.replace("Recombine Surface{1};", ""))
regions = ("-setnumber", "Mesh.SaveElementTagType", "2")
for fields, name in enumerate(("free", "small", "large")):
    gmsh(f"gmsh_{name}.bdf", "-format", "bdf", "-setnumber", "Mesh.BdfFieldFormat", str(fields), *regions)
gmsh("gmsh.unv", "-format", "unv")
for stem in ("block", "prisms"):
    for order in "12":
        for ending in ("bdf", "unv"):
            gmsh(f"gmsh_{stem}_{order}.{ending}", "-format", ending, "-order", order, *regions, geo=f"{stem}.geo")
gmsh("gmsh_2nd.bdf", "-format", "bdf", "-order", "2", *regions)
gmsh("gmsh_2nd.unv", "-format", "unv", "-order", "2")
gmsh("gmsh_sets.unv", "-format", "unv", "-setnumber", "Mesh.SaveGroupsOfNodes", "1", geo="block.geo")
for name in ("two_boxes", "block", "prisms"):
    pathlib.Path(f"{name}.geo").unlink()
for fields in ("small", "large"):
    meshio.nastran.write(f"meshio_{fields}.nas", mesh, point_format=f"fixed-{fields}", cell_format=f"fixed-{fields}")
meshio.nastran.write("meshio_2nd.nas", meshio.read("gmsh_41_second_order.msh"), point_format="fixed-large",
                     cell_format="fixed-small")

# VTK's own files of surfaces: four triangles and a quadrilateral, a strip, a polyline, vertices.
def polydata():
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk
    import numpy
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    for i in range(12):
        points.InsertNextPoint(i % 4 / 3, i // 4 / 7, i * i / 11)
    data.SetPoints(points)

    def cells(*lists):
        array = vtk.vtkCellArray()
        for ids in lists:
            array.InsertNextCell(len(ids), ids)
        return array
    data.SetVerts(cells([0], [3, 7]))
    data.SetLines(cells([0, 1], [1, 2, 3]))
    data.SetPolys(cells([0, 1, 4], [1, 5, 4], [1, 2, 6, 5], [4, 5, 6, 10, 9]))
    data.SetStrips(cells([7, 6, 11, 10], [8, 4, 9]))

    def column(name, values, of):
        array = numpy_to_vtk(numpy.array(values), deep=True)
        array.SetName(name)
        of.AddArray(array)
    column("height", [i / 7 for i in range(12)], data.GetPointData())
    column("region", numpy.arange(10, 20, dtype=numpy.int32), data.GetCellData())
    column("flow", numpy.arange(30.0).reshape(10, 3), data.GetCellData())
    for version, name in ((42, "vtk_polydata_42"), (51, "vtk_polydata_51")):
        for binary in (False, True):
            writer = vtk.vtkPolyDataWriter()
            writer.SetFileVersion(version)
            writer.SetInputData(data)
            writer.SetFileName(name + ("_binary.vtk" if binary else ".vtk"))
            writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
            assert writer.Write() == 1
    for mode, name in ((0, "ascii"), (1, "base64"), (2, "raw")):
        writer = vtk.vtkXMLPolyDataWriter()
        writer.SetInputData(data)
        writer.SetFileName(f"vtk_{name}.vtp")
        writer.SetDataMode(mode)
        if mode == 0:
            writer.SetCompressorTypeToNone()
        if mode == 2:
            writer.EncodeAppendedDataOff()
        assert writer.Write() == 1


polydata()
