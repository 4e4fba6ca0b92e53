#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Reads the files of `sunder split -o` and `sunder convert` with meshio, gmsh and VTK.

Usage: others_read_it.py SUNDER MESHES SAMPLES. Exit code 77: nothing here to read it with.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

import_error = None
try:
    import meshio
except ImportError as error:
    import_error = error
try:
    import vtk
except ImportError:
    vtk = None
gmsh = shutil.which("gmsh")
if import_error and not gmsh and not vtk:
    print("neither meshio nor gmsh nor VTK is installed")
    sys.exit(77)



def read_by_vtk(path):
    """VTK's own answer: points, cells and the regions of the cells."""
    reader = (vtk.vtkXMLUnstructuredGridReader() if path.suffix == ".vtu"
              else vtk.vtkUnstructuredGridReader())
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    regions = grid.GetCellData().GetArray("region")
    return (grid.GetNumberOfPoints(), grid.GetNumberOfCells(),
            {int(regions.GetTuple1(i)) for i in range(grid.GetNumberOfCells())})


sunder, meshes = sys.argv[1], pathlib.Path(sys.argv[2])
with tempfile.TemporaryDirectory() as folder:
    for ending in ("vtu", "msh"):
        out = pathlib.Path(folder) / f"cut.{ending}"
        subprocess.run([sunder, "split", meshes / "ring.msh", "--plane", "0,1,0,1", "-o", out],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if not import_error:
            mesh = meshio.read(out)
            tetrahedra = mesh.cells_dict["tetra"]
            assert len(mesh.points) == 40, len(mesh.points)
            assert len(tetrahedra) == 48, len(tetrahedra)
            name = "region" if ending == "vtu" else "gmsh:physical"
            regions = [int(r) for block in mesh.cell_data[name] for r in block]
            assert set(regions) == {1, 2}, set(regions)
            # No point is shared by the two pieces: the vertices are really doubled.
            pieces = [{p for t, r in zip(tetrahedra, regions) if r == k for p in t} for k in (1, 2)]
            assert not pieces[0] & pieces[1]
            print(f"meshio reads {out.name}: 40 points, 48 tetrahedra, 2 regions")
        if gmsh and ending == "msh":
            again = pathlib.Path(folder) / "again.msh"
            result = subprocess.run([gmsh, out, "-save", "-format", "msh41", "-o", again],
                                    check=True, text=True, capture_output=True)
            assert "Error" not in result.stdout + result.stderr, result.stdout
            check = subprocess.run([sunder, "check", again], text=True, capture_output=True)
            assert check.returncode == 0, check.stdout + check.stderr
            assert "components                   2" in check.stdout, check.stdout
            print("gmsh reads and writes it again, with the same two components")

    # Every version and encoding of MSH, and VTU, as `sunder convert` writes them.
    original = pathlib.Path(sys.argv[3]) / "gmsh_41.msh"
    targets = [("mesh.vtu", []), ("text.vtu", ["--text"]), ("base64.vtu", ["--base64"]),
               ("raw_zlib.vtu", ["--zlib"]), ("base64_zlib.vtu", ["--base64", "--zlib"]),
               ("medit.mesh", []), ("medit.meshb", []), ("tetgen.node", []),
               ("abaqus.inp", [])]
    for version in ("4.2", "5.1"):
        targets += [(f"text{version}.vtk", ["--text", "--format-version", version]),
                    (f"binary{version}.vtk", ["--format-version", version])]
    for version in ("4.1", "4.0", "2.2", "1"):
        targets.append((f"text{version}.msh", ["--format-version", version]))
        if version != "1":
            targets.append((f"binary{version}.msh", ["--format-version", version, "--binary"]))
    for name, options in targets:
        out = pathlib.Path(folder) / name
        subprocess.run([sunder, "convert", original, out, *options], check=True,
                       stdout=subprocess.DEVNULL)
        # meshio does not read version 1, nor Gmsh's own files of 4.0; VTK's `int` is 8 bytes to it.
        if not import_error and name not in ("text1.msh", "text4.0.msh", "binary4.0.msh",
                                             "binary5.1.vtk"):
            mesh = meshio.read(out)
            assert len(mesh.points) == 23, (name, len(mesh.points))
            tetrahedra = sum(len(b.data) for b in mesh.cells if b.type == "tetra")
            assert tetrahedra == 48, (name, tetrahedra)
        if gmsh and not name.endswith((".vtu", ".vtk", ".meshb", ".node", ".inp",
                                          "binary4.0.msh")):  # text of 4.0 only
            again = pathlib.Path(folder) / "again.msh"
            result = subprocess.run([gmsh, out, "-save", "-format", "msh41", "-o", again],
                                    check=True, text=True, capture_output=True)
            assert "Error" not in result.stdout + result.stderr, (name, result.stdout)
            check = subprocess.run([sunder, "check", again, "--json"], text=True,
                                   capture_output=True)
            assert check.returncode == 0, (name, check.stdout)
            assert '"tetrahedra": 48' in check.stdout, (name, check.stdout)
        if vtk and out.suffix in (".vtu", ".vtk"):
            assert read_by_vtk(out) == (23, 52, {3, 7, 9}), (name, read_by_vtk(out))
        print(f"others read {name}")

    tetgen, ccx = shutil.which("tetgen"), shutil.which("ccx")
    if tetgen:
        # Its copy of the mesh, with the same regions, is named *.1.
        subprocess.run([tetgen, "-rQ", pathlib.Path(folder) / "tetgen.node"], check=True, timeout=50,
                       stdout=subprocess.DEVNULL)
        rows = (pathlib.Path(folder) / "tetgen.1.ele").read_text().splitlines()
        assert rows[0].split() == ["48", "4", "1"], rows[0]
        assert {row.split()[5] for row in rows[1:49]} == {"3", "7"}
        print("tetgen reads tetgen.node")
    if ccx:
        # A job that includes the mesh and names its sets.
        (pathlib.Path(folder) / "job.inp").write_text("""*INCLUDE, INPUT=abaqus.inp
*MATERIAL, NAME=steel
*ELASTIC
2e11, 0.3
*SOLID SECTION, ELSET=core, MATERIAL=steel
*SOLID SECTION, ELSET=shell, MATERIAL=steel
*SHELL SECTION, ELSET=all_around, MATERIAL=steel
0.01
*BOUNDARY
1, 1, 3
2, 1, 3
3, 1, 3
*STEP
*STATIC
*CLOAD
5, 1, 1.0
*END STEP
""")
        result = subprocess.run([ccx, "job"], cwd=folder, timeout=50, text=True, capture_output=True)
        assert "*ERROR" not in result.stdout, result.stdout
        assert "Job finished" in result.stdout, result.stdout
        print("ccx computes with abaqus.inp")
