#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The time of two programs on the same scenes, in turns: median of the ratios of a run's processor time and of its
median step.

    tests/experiments/bending/step_ratio.py OLD NEW SCENE.json ... [--runs 5]

Scenes of order 1 have to say so (`"order": 1` in the bodies) where OLD knows no other."""
import argparse
import json
import os
import statistics
import subprocess
import tempfile
from pathlib import Path


def measured(sunder, scene, folder):
    """Processor time of a run, s, its median step, ms, and its fans."""
    process = subprocess.Popen([sunder, "run", scene, "-o", folder, "--force", "--quiet", "--frames", "0"],
                               stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        raise SystemExit(f"{sunder} ended with {status} on {scene}")
    report = json.loads((folder / "report.json").read_text())
    return usage.ru_utime, report["step_ms"]["median"], report["fans"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("scenes", type=Path, nargs="+")
    parser.add_argument("--runs", type=int, default=5)
    arguments = parser.parse_args()
    print("| scene | processor time, new over old | median step, new over old | fans, old, new |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        for scene in arguments.scenes:
            whole, step = [], []
            for _ in range(arguments.runs):
                old = measured(arguments.old, scene, Path(name) / "old")
                new = measured(arguments.new, scene, Path(name) / "new")
                whole.append(new[0] / old[0])
                step.append(new[1] / old[1])
            print(f"| {scene.name} | {statistics.median(whole):.3f} | {statistics.median(step):.3f} | {old[2]}, {new[2]} |",
                  flush=True)


if __name__ == "__main__":
    main()
