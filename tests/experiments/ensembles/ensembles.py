#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Outcomes of breaking bodies as distributions: many meshes, both crack modes, and noise.

    tests/experiments/ensembles/ensembles.py [SCENE ...] [--build build/release] [--out out/ensembles] [--limit 60] [--table]

Each scene runs in modes `paper` and `object` on
  1x        ten meshes of the body, made by sunder-mesh of its surface turned by a seeded rotation and turned back
  2x        five more with about twice the tetrahedra
  starts    the first of the ten, ten times, with place and velocity moved by up to 1e-12 (m, m/s)
  strengths the same, five times, with the strength times 1 + u, |u| <= 1e-6
`starts` and `strengths` are the numerical-noise band: their differences have no physical cause.
A run that is there already in OUT is kept. A run over the limit (s of the processor), or one that
failed, is named in the table and in the CSV and is part of no figure. Written: runs.csv (a row per
run), groups.json, sizes.png (gnuplot), and the tables to stdout.
--table runs nothing and makes them of the runs that are there."""
import argparse
import csv
import hashlib
import json
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile

import members
import report

TREE = pathlib.Path(__file__).resolve().parents[3]
SCENES = TREE / "meshes/scenes"
MODES = ("paper", "object")
GROUPS = {"1x": 10, "2x": 5, "starts": 10, "strengths": 5}


def bunny_surface(sunder):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "bunny.off"
        subprocess.run([sunder, "convert", TREE / "meshes/bunny.msh", path], check=True, capture_output=True)
        return members.read_off(path.read_text())


# The bodies: scene, duration (s), surface, whether that has edges, sizes of tetrahedra (m) at 1x,
# 2x.
BODIES = {
    "monolith": dict(scene=SCENES / "charts/monolith.json", duration=0.16, sharp=True, size={"1x": 0.2, "2x": 0.131},
                     surface=lambda sunder: members.box((-0.5, -0.15, 0), (0.5, 0.15, 2))),
    "ball": dict(scene=SCENES / "ensembles/ball.json", duration=0.01, sharp=False, size={"1x": 0.0182, "2x": 0.0145},
                 surface=lambda sunder: members.ball(0.1)),
    "pane": dict(scene=SCENES / "ensembles/pane.json", duration=0.01, sharp=True, size={"1x": 0.03, "2x": 0.021},
                 surface=lambda sunder: members.box((-0.2, -0.02, 0), (0.2, 0.02, 0.4))),
    "bunny": dict(scene=SCENES / "bunny.json", duration=0.03, sharp=False, size={"1x": 0.0116, "2x": 0.0087},
                  surface=bunny_surface),
}


def nudged(scene, group, member):
    """Changes of a scene by nothing, as `--set` takes them."""
    body = json.loads(scene.read_text())["bodies"][0]
    source = random.Random(f"{group} {member}")
    if group == "strengths":
        strength = body["material"]["tensile_strength"] * (1 + 1e-6 * source.uniform(-1, 1))
        return [f"bodies.0.material.tensile_strength={strength!r}"]
    if group == "starts":
        moved = lambda key: [x + 1e-12 * source.uniform(-1, 1) for x in body.get(key, [0, 0, 0])]
        return [f"bodies.0.{key}={json.dumps(moved(key))}" for key in ("translation", "velocity")]
    return []


def mesh_of(said, name, group, member):
    """The mesh of a member, made where it is not there."""
    body = BODIES[name]
    level, member = (group, member) if group in body["size"] else ("1x", 0)
    path = said.out / "meshes" / f"{name}_{level}_{member}.mesh"
    if not path.is_file():
        members.make_mesh(said.build, body["surface"](said.build / "sunder"), body["size"][level], body["sharp"],
                          f"{name} {level} {member}", path)
    return path


def pieces_of(folder):
    with open(folder / "fragments.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    return [float(row["volume"]) for row in rows], sum(int(row["tetrahedra"]) for row in rows)


def run(said, name, mode, group, member, more=(), called=""):
    """One run as a record; from its file where that was made by the same words. `more`: further
    changes of the scene; `called`: their name in the file's name."""
    body, mesh = BODIES[name], mesh_of(said, name, group, member)
    changes = [f"bodies.0.mesh={mesh}", f"duration={body['duration']!r}", f"fracture.crack={mode}",
               *nudged(body["scene"], group, member), *more]
    key = hashlib.sha256("\n".join([body["scene"].read_text(), mesh.read_text(), *changes[1:]]).encode()).hexdigest()
    path = said.out / "runs" / f"{name}_{mode}_{group}{called.replace('/', '_')}_{member}.json"
    if path.is_file():
        record = json.loads(path.read_text())
        if record["key"] == key:
            return record
    if said.table:
        return None
    record = {"key": key, "scene": name, "mode": mode, "group": group + called, "member": member, "end": "finished", "volumes": []}
    with tempfile.TemporaryDirectory() as folder:
        words = [said.build / "sunder", "run", body["scene"], "--quiet", "--frames", "0", "--force", "-o", folder]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        # Of processor time, so that a busy machine drops no run.
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (said.limit, said.limit + 5))
        done = subprocess.run([*words, *(w for c in changes for w in ("--set", c))], capture_output=True, text=True, preexec_fn=limit)
        if done.returncode == -signal.SIGXCPU:
            record["end"] = f"over {said.limit} s"
        elif done.returncode != 0:
            codes = re.findall(r"error: .*\[([a-z_]+)", done.stderr)
            record["end"] = f"exit code {done.returncode}: {', '.join(codes)}"
        else:
            record["volumes"], record["tetrahedra"] = pieces_of(pathlib.Path(folder))
        record["seconds"] = round(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 2)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(record))
    return record


def options(about, out, limit):
    """The command line that programs which run ensembles share."""
    words = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--build", type=lambda word: pathlib.Path(word).resolve(), default=TREE / "build/release")
    words.add_argument("--out", type=lambda word: pathlib.Path(word).resolve(), default=pathlib.Path(out).resolve())
    words.add_argument("--limit", type=int, default=limit, help="s of the processor a run may take")
    words.add_argument("--table", action="store_true")
    return words


def main():
    words = options(__doc__, "out/ensembles", 60)
    words.add_argument("scenes", nargs="*", choices=[*BODIES, []], metavar="SCENE", help=", ".join(BODIES))
    said = words.parse_args()
    os.nice(10)
    records = []
    # All kinds of members in turn, so that the finished runs are even at any time.
    order = sorted((m / n, group, m) for group, n in GROUPS.items() for m in range(n))
    for name in said.scenes or BODIES:
        for _, group, member in order:
            for mode in MODES:
                record = run(said, name, mode, group, member)
                if record is None:
                    continue
                records.append(record)
                if not said.table:
                    print(name, mode, group, member, record["end"], f"{len(record['volumes'])} pieces", f"{record['seconds']} s",
                          file=sys.stderr, flush=True)
    report.write(said.out, records)


if __name__ == "__main__":
    sys.exit(main())
