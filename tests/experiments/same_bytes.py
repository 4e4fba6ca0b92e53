#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the output of two builds of `sunder`, byte by byte.

    tests/experiments/same_bytes.py BEFORE AFTER [--quick] [--keep DIR]

BEFORE and AFTER are two programs `sunder`, each in its own tree (build/release/sunder): each reads
the meshes and scenes of that tree. Compared are
  - the four scenes bar, block, monolith and bunny: events.jsonl, fragments.csv, cracks.csv and the
    frames at start and end (--quick: the first steps of each);
  - the answers of all fixtures of the suite (`suite --export`), and of `split` to a fan and a
  plane;
  - meshes/bar.msh through each of the formats, and `check --json` of the sample meshes.
Pictures and report.json and checkpoints are left out: those depend on drivers, these hold wall times.
A line per case; the exit code is 1 when anything differs."""
import argparse
import hashlib
import json
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile

SHORT = {"bar": 0.02, "block": 0.01, "monolith": 0.16, "bunny": 0.02}  # s
ENDINGS = ["msh", "mesh", "meshb", "vtu", "vtk", "node", "inp", "ovm", "ply", "off", "obj", "stl"]


def digests(folder):
    files = (p for p in sorted(folder.rglob("*")) if p.is_file())
    return {p.relative_to(folder).as_posix(): hashlib.sha256(p.read_bytes()).hexdigest()
            for p in files if p.name != "report.json" and p.suffix not in (".png", ".checkpoint")}


def run(program, *words):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True)
    return done.stdout, done.returncode


def scenes(program, tree, out, quick):
    for name, short in SHORT.items():
        words = ["--set", f"duration={short}"] if quick else []
        _, code = run(program, "run", tree / "meshes/scenes" / f"{name}.json", "-o", out / name,
                      "--quiet", "--frames", 2, *words)
        (out / name / "exit_code").write_text(str(code))


def answers(program, tree, out):
    folder = out / "suite"
    folder.mkdir(parents=True)
    archive = folder / "suite.tar.gz"
    run(program, "suite", "--fixtures", tree / "meshes/suite", "--export", archive)
    with tarfile.open(archive) as packed:  # less the page and the programs in it
        packed.extractall(folder, [m for m in packed if "/fixtures/" in m.name])
    archive.unlink()
    mesh = tree / "meshes/ring.msh"
    for name, words in {"plane": ["--plane", "1,0,0,1.01"], "fan": ["--fan", "7,0.3,1,0.2"]}.items():
        (folder / f"split_{name}").write_text(run(program, "split", mesh, *words, "--json")[0])
    for sample in sorted((tree / "meshes").glob("*.msh")):
        report = json.loads(run(program, "check", sample, "--json")[0])
        report.pop("file", None)
        (folder / f"check_{sample.stem}").write_text(json.dumps(report))


def conversions(program, tree, out):
    (out / "conversions").mkdir()
    for ending in ENDINGS:
        run(program, "convert", tree / "meshes/bar.msh", out / "conversions" / f"bar.{ending}")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("before", type=pathlib.Path)
    words.add_argument("after", type=pathlib.Path)
    words.add_argument("--quick", action="store_true")
    words.add_argument("--keep", type=pathlib.Path, help="folder to leave the files in")
    said = words.parse_args()
    folder = said.keep or pathlib.Path(tempfile.mkdtemp())
    for side, program in (("before", said.before.resolve()), ("after", said.after.resolve())):
        if side == "before" and (folder / side).is_dir():
            continue  # kept from an earlier call
        shutil.rmtree(folder / side, ignore_errors=True)
        (folder / side).mkdir(parents=True)
        tree = program.parents[2]
        scenes(program, tree, folder / side, said.quick)
        answers(program, tree, folder / side)
        conversions(program, tree, folder / side)
    differing = 0
    for case in sorted(p.name for p in (folder / "before").iterdir()):
        before, after = digests(folder / "before" / case), digests(folder / "after" / case)
        changed = sorted(k for k in before.keys() | after.keys() if before.get(k) != after.get(k))
        print(f"{case}: {len(before)} files, " + (f"{len(changed)} differ: {' '.join(changed[:20])}" if changed else "the same bytes"))
        differing += bool(changed)
    if not said.keep:
        shutil.rmtree(folder)
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
