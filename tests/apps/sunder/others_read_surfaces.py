#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Reads with meshio, gmsh and assimp the surfaces that `sunder convert` writes.

Usage: others_read_surfaces.py SUNDER SAMPLES. Exit code 77: nothing here to read them with.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import meshio
except ImportError:
    meshio = None
gmsh, assimp = shutil.which("gmsh"), shutil.which("assimp")
if not (meshio or gmsh or assimp):
    print("neither meshio nor gmsh nor assimp is installed")
    sys.exit(77)

sunder, body = sys.argv[1], pathlib.Path(sys.argv[2]) / "gmsh_41.msh"
# The boundary of the two boxes: 12 triangles fewer than all, which have the wall between them.
triangles, points = 40, 22


def output_of(*words):
    result = subprocess.run(words, check=True, text=True, capture_output=True, timeout=60)
    assert "Error" not in result.stdout + result.stderr, result.stdout
    return result.stdout


with tempfile.TemporaryDirectory() as folder:
    for name, options in [("surface.off", []), ("surface.obj", []), ("binary.ply", []),
                          ("text.ply", ["--text"]), ("binary.stl", []), ("text.stl", ["--text"])]:
        out = pathlib.Path(folder) / name
        output_of(sunder, "convert", body, out, *options)
        readers = []
        # meshio stumbles over properties of faces in binary PLY.
        if meshio and name != "binary.ply":
            mesh = meshio.read(out)
            found = sum(len(b.data) for b in mesh.cells if b.type == "triangle")
            assert (found, len(mesh.points)) == (triangles, points), (name, found, len(mesh.points))
            readers.append("meshio")
        if gmsh and out.suffix == ".stl":
            again = pathlib.Path(folder) / "again.vtu"
            output_of(gmsh, out, "-save", "-save_all", "-format", "msh41", "-o",
                      out.with_suffix(".msh"))
            text = output_of(sunder, "convert", out.with_suffix(".msh"), again)
            assert f" {triangles} triangles" in text, (name, text)
            readers.append("gmsh")
        if assimp and out.suffix != ".off":
            faces = re.search(r"Faces:\s+(\d+)", output_of(assimp, "info", out))
            assert int(faces.group(1)) == triangles, (name, faces.group(0))
            readers.append("assimp")
        print(f"{name}: {', '.join(readers) or 'nobody here reads it'}")
