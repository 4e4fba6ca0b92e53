#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""`breaking_bunny.py PROGRAM [--until SECONDS] [--runs N]`: processor seconds of the paper's bunny.

Runs meshes/scenes/paper/bunny.json in each crack mode (toughness 0.06 MPa sqrt(m)). Each line has
medians of N runs (1): processor seconds, sub-steps, fans, pieces, the largest piece, damping,
contact work and the residual of the energy ledger over the energy moved. With `cohesive` the last
column is the cracks' energy over G_c times the area released.
"""
import argparse
import json
import pathlib
import resource
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODES = ["paper", "object", "cohesive"]


def scene_of(mode, until):
    path = ROOT / "meshes/scenes/paper/bunny.json"
    scene = json.loads(path.read_text())
    del scene["$schema"]
    body = scene["bodies"][0]
    body["mesh"] = str((path.parent / body["mesh"]).resolve())
    body["material"]["toughness"] = 6e4
    scene["fracture"]["crack"] = mode
    scene["duration"] = until
    scene["output"]["frames"] = 0
    return scene


def run(program, mode, until):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "scene.json")
        path.write_text(json.dumps(scene_of(mode, until)))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([program, "run", path, "-o", folder + "/out"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        report = json.loads(pathlib.Path(folder, "out/report.json").read_text())
    return after.ru_utime - before.ru_utime, report


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--until", type=float, default=0.0208)
    parser.add_argument("--runs", type=int, default=1)
    arguments = parser.parse_args()
    print(f"{'mode':9}{'s':>8}{'subs':>6}{'fans':>6}{'pieces':>7}"
          f"{'largest':>8}{'damping':>9}{'contact':>9}{'residual':>10}{'taken/due':>10}")
    for mode in MODES:
        runs = [run(arguments.program, mode, arguments.until)
                for _ in range(arguments.runs)]
        report = runs[0][1]
        energy = report["energy"]
        due = report["ties"]["fracture_energy_of_released"] if mode == "cohesive" else 0
        taken = f"{report['ties']['dissipated'] / due:10.3f}" if due else f"{'':10}"
        print(f"{mode:9}{statistics.median(r[0] for r in runs):8.1f}"
              f"{report['impact']['sub_steps']:6}{report['fans']:6}{report['components']:7}"
              f"{report['fragments']['largest_mass'] / report['fragments']['mass']:8.3f}"
              f"{energy['damping_work']:9.2f}{energy['contact_work']:9.2f}"
              f"{energy['residual_over_energy_moved']:10.1e}{taken}", flush=True)


if __name__ == "__main__":
    main()
