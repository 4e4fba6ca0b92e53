#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Times sunder, meshio and gmsh on the same files in the same run.

Usage: bench_convert.py SUNDER [--cells N] [--runs N] [--page PAGE.md]

The files are those of `sunder bench formats`: a box of 6 N^3 tetrahedra. Reading and writing: sunder and
meshio each within their own process, from and to files, medians of the runs. Whole commands, their
starting included: sunder convert, gmsh -save, meshio convert, and sunder check. Prints Markdown; --page
puts it into a page, between the lines that name it.
"""
import argparse
import contextlib
import io
import json
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import conversion_matrix

try:
    import meshio
except ImportError:
    meshio = None
GMSH = shutil.which("gmsh")
# File of `sunder bench formats`, and how meshio writes the like of it.
MESHIO = {
    "text4.1.msh": ("gmsh", {"binary": False}), "binary4.1.msh": ("gmsh", {}),
    "text2.2.msh": ("gmsh22", {"binary": False}), "binary2.2.msh": ("gmsh22", {}),
    "text.mesh": ("medit", {}), "binary.vtu": ("vtu", {"compression": None}),
    "binary_zlib.vtu": ("vtu", {}), "text.vtu": ("vtu", {"binary": False}),
    "binary4.2.vtk": ("vtk42", {}), "text4.2.vtk": ("vtk42", {"binary": False}),
    "binary5.1.vtk": ("vtk51", {}), "text.node": ("tetgen", {}), "text.inp": ("abaqus", {}), "text.bdf": ("nastran", {}),
    "text.off": ("off", {}), "text.obj": ("obj", {}), "binary.stl": ("stl", {"binary": True}),
    "text.stl": ("stl", {}), "binary.ply": ("ply", {}), "text.ply": ("ply", {"binary": False}),
}


def median_ms(work, runs):
    """Median over the runs, or None where the work fails."""
    times = []
    for _ in range(runs):
        begin = time.perf_counter()
        try:
            with contextlib.redirect_stdout(io.StringIO()), \
                    contextlib.redirect_stderr(io.StringIO()):
                work()
        except (Exception, SystemExit):
            return None
        times.append(1000 * (time.perf_counter() - begin))
    return statistics.median(times)


def by_meshio(path, out, runs):
    """How long meshio reads `path`, and how long it writes the like."""
    if meshio is None or path.name not in MESHIO:
        return None, None
    mesh = []
    read = median_ms(lambda: mesh.append(meshio.read(path)), runs)
    if read is None:
        return None, None
    file_format, options = MESHIO[path.name]
    return read, median_ms(lambda: meshio.write(out, mesh[0], file_format=file_format, **options),
                           runs)


def text_of(ms):
    return "" if ms is None else f"{ms:.0f}"


def times(theirs, ours):
    return "" if theirs is None else f"{theirs / ours:.1f}"


def read_and_write(rows, folder, runs):
    """A Markdown table of the times of single reads and writes."""
    lines = ["| file | MB | sunder reads, ms | meshio | times | sunder writes, ms | meshio | times |",
             "|---|---|---|---|---|---|---|---|"]
    for row in rows:
        path = folder / row["file"]
        read, write = by_meshio(path, folder / f"meshio{path.suffix}", runs)
        lines.append(f"| {row['file']} | {row['bytes'] / 1e6:.1f} | {row['read_ms']:.0f} | "
                     f"{text_of(read)} | {times(read, row['read_ms'])} | {row['write_ms']:.0f} | "
                     f"{text_of(write)} | {times(write, row['write_ms'])} |")
    return lines


def whole_commands(sunder, folder, runs):
    """A Markdown table of the times of whole commands."""
    lines = ["| command on text2.2.msh | sunder, ms | meshio | times | gmsh | times |",
             "|---|---|---|---|---|---|"]
    source = folder / "text2.2.msh"

    def run(*command):
        subprocess.run([str(word) for word in command], check=True, capture_output=True)

    for name, out, gmsh_format in (("to MSH 4.1", "whole.msh", "msh41"),
                                   ("to MEDIT", "whole.mesh", "mesh"),
                                   ("to Nastran", "whole.bdf", "bdf"),
                                   ("to UNV", "whole.unv", "unv"),
                                   ("to VTU", "whole.vtu", None),
                                   ("to legacy VTK", "whole.vtk", "vtk")):
        ours = median_ms(lambda: run(sunder, "convert", source, folder / out), runs)
        theirs = gmsh = None
        if meshio:
            code = ("import sys, meshio; "
                    "meshio.write(sys.argv[2], meshio.read(sys.argv[1]), binary=False)"
                    if out == "whole.msh" else
                    "import sys, meshio; meshio.write(sys.argv[2], meshio.read(sys.argv[1]))")
            theirs = median_ms(lambda: run(sys.executable, "-c", code, source, folder / out), runs)
        if GMSH and gmsh_format:
            gmsh = median_ms(lambda: run(GMSH, source, "-save", "-format", gmsh_format, "-o",
                                         folder / f"gmsh_{out}"), runs)
        lines.append(f"| {name} | {text_of(ours)} | {text_of(theirs)} | {times(theirs, ours)} | "
                     f"{text_of(gmsh)} | {times(gmsh, ours)} |")
    for file in ("text2.2.msh", "binary4.1.msh"):
        check = median_ms(lambda: run(sunder, "check", folder / file), runs)
        lines.append(f"| `sunder check {file}` | {text_of(check)} | | | | |")
    return lines


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("sunder")
    arguments.add_argument("--cells", type=int, default=41)
    arguments.add_argument("--runs", type=int, default=3)
    arguments.add_argument("--page")
    given = arguments.parse_args()
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        bench = json.loads(subprocess.run(
            [given.sunder, "bench", "formats", "--cells", str(given.cells), "--runs",
             str(max(3, given.runs)), "--keep", place, "--json"],
            check=True, capture_output=True, text=True).stdout)
        lines = [f"{bench['tetrahedra']} tetrahedra, {bench['points']} points; medians of "
                 f"{given.runs} runs; {conversion_matrix.versions()}.", ""]
        lines += read_and_write(bench["formats"], folder, given.runs)
        lines += [""] + whole_commands(given.sunder, folder, given.runs)
    text = "\n".join(lines) + "\n"
    print(text, end="")
    if given.page:
        conversion_matrix.put_into(given.page, "times", text, False)
    return 0


if __name__ == "__main__":
    sys.exit(main())
