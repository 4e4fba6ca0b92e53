#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Cuts a mesh with `sunder split -o` and reads the result with meshio and gmsh.

Usage: others_read_it.py SUNDER MESHES. Exit code 77: nothing here to read it with.
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
gmsh = shutil.which("gmsh")
if import_error and not gmsh:
    print("neither meshio nor gmsh is installed")
    sys.exit(77)

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
