#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""`shifted_runs.py SCENE PROGRAM [PROGRAM ...] [--runs N] [--set KEY=VALUE ...]`: programs compared.

Runs a scene N times (6) with each program. In run k the first body starts k nanometres higher, as
outcomes of breaking differ from start to start. Prints for each program the mean and its standard
error of some figures of `report.json`, processor seconds among them, and counts the warnings.
"""
import argparse
import collections
import json
import math
import pathlib
import statistics
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "meshes/scenes"))
import measure  # noqa: E402

FIGURES = {
    "seconds": lambda r: r["processor"],
    "fans": lambda r: r["fans"],
    "pieces": lambda r: r["components"],
    "largest": lambda r: r["fragments"]["largest_mass"] / r["fragments"]["mass"],
    "crack area": lambda r: r["cracks"]["area"],
    "not converged": lambda r: r["contact"]["not_converged"],
    "left out": lambda r: r["contact"]["left_out"],
    "contact work": lambda r: r["energy"]["contact_work"],
    "friction heat": lambda r: r["energy"]["friction_heat"],
    "push-out work": lambda r: r["energy"]["push_out_work"],
    "residual": lambda r: r["energy"]["residual_over_energy_moved"],
}


def run(program, scene, folder, settings):
    out = pathlib.Path(folder, "out")
    words = [program, "run", scene, "-o", out, "--force"]
    for one in ["energy_ledger=true", "output.frames=0", *settings]:
        words += ["--set", one]
    seconds = measure.processor_seconds([str(word) for word in words])
    return json.loads((out / "report.json").read_text()) | {"processor": seconds}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("programs", nargs="+", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=6)
    parser.add_argument("--set", action="append", default=[], dest="settings")
    arguments = parser.parse_args()
    place = json.loads(arguments.scene.read_text())["bodies"][0].get("translation", [0, 0, 0])
    reports = {program: [] for program in arguments.programs}
    with tempfile.TemporaryDirectory() as folder:
        for k in range(arguments.runs):
            moved = [place[0], place[1], place[2] + 1e-9 * k]
            settings = arguments.settings + [f"bodies.0.translation={json.dumps(moved)}"]
            for program, of in reports.items():
                of.append(run(program, arguments.scene, folder, settings))
    for program, of in reports.items():
        print(program)
        for name, figure in FIGURES.items():
            values = [figure(r) for r in of]
            error = statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else 0
            print(f"  {name:14}{statistics.mean(values):12.4g} +- {error:.2g}")
        warnings = collections.Counter(w["code"] for r in of for w in r["warnings"])
        print("  warnings      ", dict(warnings) or "none")


if __name__ == "__main__":
    main()
