#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""`until_struck.py PROGRAM [SCENE...] [--starts N] [--until SECONDS]`: the rubble of `preview`.

Runs scenes (default: monolith and bunny) with `accuracy: preview`, steps of 1/240 s, and each
value of `ladder.rubble` from N starts (3) that differ by 1e-12 m/s. Each line has means over the
starts, with the least and the largest in brackets: processor seconds, fans, pieces, pieces above a
hundredth of the mass, the share of the largest piece; then the median and the worst step in ms.
"""
import argparse
import json
import pathlib
import resource
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCENES = [ROOT / "meshes/scenes/monolith.json", ROOT / "meshes/scenes/bunny.json"]
RUBBLE = ["off", "certified", "until_struck"]


def run(program, path, rubble, start, until):
    scene = json.loads(path.read_text())
    scene.pop("$schema", None)
    for body in scene["bodies"]:
        if "mesh" in body:
            body["mesh"] = str((path.parent / body["mesh"]).resolve())
    velocity = scene["bodies"][0].setdefault("velocity", [0, 0, 0])
    velocity[0] += 1e-12 * start
    scene["accuracy"] = "preview"
    scene["time_step"] = 1 / 240
    scene["duration"] = until
    scene.setdefault("ladder", {})["rubble"] = rubble
    with tempfile.TemporaryDirectory() as folder:
        moved = pathlib.Path(folder, "scene.json")
        moved.write_text(json.dumps(scene))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run([program, "run", moved, "-o", folder + "/out", "--frames", "0"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        report = json.loads(pathlib.Path(folder, "out/report.json").read_text())
        rows = pathlib.Path(folder, "out/fragments.csv").read_text().splitlines()
    column = rows[0].split(",").index("mass")
    masses = [float(row.split(",")[column]) for row in rows[1:]]
    large = sum(mass > 0.01 * sum(masses) for mass in masses)
    return [seconds, report["fans"], report["components"], large, max(masses) / sum(masses),
            report["step_ms"]["median"], report["step_ms"]["max"]]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="*", type=pathlib.Path, default=SCENES)
    parser.add_argument("--starts", type=int, default=3)
    parser.add_argument("--until", type=float, default=0.2)
    parser.add_argument("--rubble", nargs="+", choices=RUBBLE, default=RUBBLE)
    arguments = parser.parse_args()
    print("| scene | `ladder.rubble` | processor, s | fans | pieces | large | largest "
          "| median step, ms | worst step, ms |\n|---|---|---|---|---|---|---|---|---|")
    for path in arguments.scenes:
        for rubble in arguments.rubble:
            runs = [run(arguments.program, path.resolve(), rubble, k, arguments.until)
                    for k in range(arguments.starts)]
            cells = [f"{statistics.mean(v):.3g} ({min(v):.3g}–{max(v):.3g})" for v in zip(*runs)]
            print(f"| {path.stem} | `{rubble}` | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
