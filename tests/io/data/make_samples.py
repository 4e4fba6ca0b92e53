#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes the sample meshes in this folder with gmsh 4.8.4 and python3-meshio 5.0.0 (Debian 12).

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
pathlib.Path("two_boxes.geo").unlink()
pathlib.Path("no_groups.geo").unlink()
