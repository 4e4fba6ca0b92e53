#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Mesh files of other projects: read by sunder, compared with meshio and gmsh.

Usage: foreign_files.py SUNDER FOLDER [--most N] [--seed K] [--seconds S] [--differences]

FOLDER has one folder per project. Each file with an ending of a mesh is converted to VTU. A file is `read`, `reported`
(read, and something is lost or left out), `refused` (a message and exit code 3, or 4 where no cell is left), or `broken` (a signal, a hang, or an
answer of another kind). meshio and gmsh read it too, each in a process of its own. Two readers `agree` if they find the
same number of cells of each kind and the same sum of their centres, up to rounding; vertex cells, which readers keep or
leave out by taste, do not count. --most takes at most N files per project and ending, drawn by --seed.

Prints Markdown: a row per project and ending. --differences lists each file that is refused or read otherwise.
Exit code 1: a file is broken; 77: meshio or gmsh is not installed."""
import argparse
import collections
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

ENDINGS = {"msh", "mesh", "meshb", "vtk", "vtu", "vtp", "inp", "unv", "off", "obj", "stl", "ply", "node", "nas", "bdf",
           "dat", "ovm"}
BY_GMSH = {"msh", "mesh", "unv", "bdf", "nas", "dat", "stl", "vtk"}

# Run by a process of its own, as a reader may crash: prints {kind: [number, sum of centres]}.
MEASURE = """
import collections, json, sys
import meshio, numpy
mesh = meshio.read(sys.argv[1])
found = collections.defaultdict(lambda: [0, numpy.zeros(3)])
points = numpy.zeros((len(mesh.points), 3))
points[:, :mesh.points.shape[1]] = mesh.points
for block in mesh.cells:
    kind = block.type
    for row in block.data:
        one = found['polygon' if kind.startswith('polygon') else kind]
        one[0] += 1
        one[1] = one[1] + points[row].mean(axis=0)
sizes = numpy.abs(points).max(initial=0)
print(json.dumps({'size': float(sizes), 'kinds': {k: [n, list(s)] for k, (n, s) in found.items()}}))
"""


def files_of(folder, most, seed):
    """(project, ending, path) of the files, in order."""
    draw = random.Random(seed)
    for project in sorted(p for p in folder.iterdir() if p.is_dir()):
        by_ending = collections.defaultdict(list)
        for path in sorted(project.rglob("*")):
            words = path.name.lower().split(".")
            ending = words[-2] if words[-1] == "gz" and len(words) > 2 else words[-1]
            if path.is_file() and ending in ENDINGS:
                by_ending[ending].append(path)
        for ending, paths in sorted(by_ending.items()):
            for path in sorted(draw.sample(paths, most) if most and len(paths) > most else paths):
                yield project.name, ending, path


def measured(path):
    """The cells that meshio finds in a file, as MEASURE prints them; None if it cannot read it."""
    done = subprocess.run(["/usr/bin/python3", "-c", MEASURE, path], capture_output=True, text=True, timeout=120)
    try:
        return json.loads(done.stdout.splitlines()[-1]) if done.returncode == 0 else None
    except (ValueError, IndexError):
        return None


def by_sunder(sunder, path, out, seconds):
    """(state, words): how sunder takes the file."""
    try:
        done = subprocess.run([sunder, "convert", path, out, "--text", "--json"], capture_output=True, text=True,
                              errors="replace", timeout=seconds)
    except subprocess.TimeoutExpired:
        return "broken", f"no answer in {seconds} s"
    try:
        answer = json.loads(done.stdout)
    except ValueError:
        return "broken", f"exit code {done.returncode}, no JSON"
    words = "; ".join(f"{f['code']}: {f['text']}" for f in answer.get("findings", []) if f["severity"] != "remark")
    if words and (done.returncode == 3 or (done.returncode == 4 and "nothing_left" in words)):
        return "refused", words
    if done.returncode != 0:
        return "broken", f"exit code {done.returncode}: {words}"
    return ("read" if answer["lossless"] else "reported"), words


def with_known_ending(path, scratch):
    """The file, unpacked, with an ending by which meshio and gmsh recognise a Nastran deck."""
    if path.suffix == ".gz":
        plain = scratch / path.stem
        with plain.open("wb") as file:
            subprocess.run(["gzip", "-dc", path], stdout=file, check=False)
        return plain
    if path.suffix.lower() == ".dat":
        return pathlib.Path(shutil.copy(path, scratch / (path.stem + ".bdf")))
    return path


def by_meshio(path, scratch):
    return measured(with_known_ending(path, scratch))


def by_gmsh(path, scratch):
    out = scratch / "gmsh.msh"
    out.unlink(missing_ok=True)
    subprocess.run(["gmsh", with_known_ending(path, scratch), "-save", "-save_all", "-format", "msh22", "-o", out, "-v", "0"],
                   capture_output=True, timeout=120, check=False)
    return measured(out) if out.exists() else None


def differences(one, other):
    """Words of how two measurements differ; none if they agree."""
    size, wrong = max(one["size"], other["size"], 1e-300), []
    for kind in sorted(set(one["kinds"]) | set(other["kinds"])):
        if kind == "vertex":
            continue
        (n, s), (m, t) = (found["kinds"].get(kind, [0, [0, 0, 0]]) for found in (one, other))
        if n != m:
            wrong.append(f"{n} against {m} {kind}")
        elif max(abs(a - b) for a, b in zip(s, t)) > 1e-5 * size * max(n, 1):
            wrong.append(f"{kind} elsewhere")
    return ", ".join(wrong)


def tried(reader, path, scratch):
    try:
        return reader(path, scratch)
    except subprocess.TimeoutExpired:
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sunder", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--most", type=int, help="files per project and ending")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=120, help="after which a file hangs")
    parser.add_argument("--differences", action="store_true")
    options = parser.parse_args()
    if shutil.which("gmsh") is None or subprocess.run(["/usr/bin/python3", "-c", "import meshio"], check=False).returncode:
        print("meshio or gmsh is not installed")
        sys.exit(77)
    columns = ["files", "read", "reported", "refused", "broken", "read by meshio", "agree", "differ", "read by gmsh",
               "agree ", "differ "]
    rows = collections.defaultdict(collections.Counter)
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        for project, ending, path in files_of(options.folder, options.most, options.seed):
            out = scratch / "out.vtu"
            for old in scratch.glob("out.*"):
                old.unlink()
            state, words = by_sunder(options.sunder.resolve(), path, out, options.seconds)
            row = rows[project, ending]
            row.update(["files", state])
            found = measured(out) if out.exists() else None
            parts = [f"{state}" + (f" ({words[:300]})" if words and state != "read" else "")]
            for program, reader, mark in (("meshio", by_meshio, ""), ("gmsh", by_gmsh, " ")):
                if program == "gmsh" and ending not in BY_GMSH:
                    continue
                other = tried(reader, path, scratch)
                if other is None or not any(n for n, _ in other["kinds"].values()):
                    continue
                row[f"read by {program}"] += 1
                wrong = differences(found, other) if found else "only there"
                row[("differ" if wrong else "agree") + mark] += 1
                if wrong:
                    parts.append(f"{program}: {wrong}")
            if options.differences and (state in ("refused", "broken") or len(parts) > 1):
                print(f"{path.relative_to(options.folder)}: " + " | ".join(parts), flush=True)
    print("\n| project | ending | " + " | ".join(columns) + " |")
    print("|" + "---|" * (len(columns) + 2))
    total = collections.Counter()
    for (project, ending), row in rows.items():
        total.update(row)
        print(f"| {project} | {ending} | " + " | ".join(str(row[c]) for c in columns) + " |")
    print("| all | | " + " | ".join(str(total[c]) for c in columns) + " |")
    sys.exit(1 if total["broken"] else 0)


if __name__ == "__main__":
    main()
