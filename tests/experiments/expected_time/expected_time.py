#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the time that `sunder run` expects with the time that it takes.

    tests/experiments/expected_time/expected_time.py SUNDER [--limit S] [SCENE.json ...]

Scenes: the samples (meshes/scenes/*.json) and those of scenes.py, or the files named. Each run has
one thread. A run that takes more than the limit (default: 300 s on the wall) ends there; its
expected time is then that of its simulated part. Prints a table, and how many ratios lie within a
factor of two. The factors of fracture/scene/expected_time.cpp come from this table."""
import argparse
import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import threading

HERE = pathlib.Path(__file__).resolve().parent
SAMPLES = HERE.parents[2] / "meshes/scenes"
sys.path.insert(0, str(HERE))
import scenes  # noqa: E402


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def expected_until(phases, time):
    """s of computing until the simulated time, by the phases of a report."""
    ends = [p["begin"] for p in phases[1:]] + [time]
    return sum(p["seconds_per_second"] * max(0, min(end, time) - p["begin"]) for p, end in zip(phases, ends))


def measure(program, scene, limit, folder):
    """Expected and used seconds, the simulated share, pieces."""
    out = pathlib.Path(folder) / scene.stem
    words = [program, "run", str(scene), "-o", str(out), "--force", "--frames", "2", "--threads", "1"]
    before = processor_seconds()
    child = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    ended = threading.Event()

    def stop():
        if not ended.wait(limit):
            child.terminate()
    watch = threading.Thread(target=stop)
    watch.start()
    lines = child.stderr.read().splitlines()
    child.wait()
    ended.set()
    watch.join()
    if child.returncode not in (0, 130):
        raise SystemExit(f"{scene}: exit code {child.returncode}\n" + "\n".join(lines[-5:]))
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    expected = report["settings"]["expected"]
    share = report["steps"] / expected["steps"]
    return dict(expected=expected_until(expected["phases"], report["time"]),
                used=processor_seconds() - before, share=share, pieces=report["components"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sunder")
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    parser.add_argument("--limit", type=float, default=300)
    arguments = parser.parse_intermixed_args()
    with tempfile.TemporaryDirectory() as folder:
        files = arguments.scenes or [f for f in sorted(SAMPLES.glob("*.json")) if "schema" not in f.name] + \
            scenes.write_all(pathlib.Path(folder) / "scenes")
        print("| scene | simulated share | expected, s | processor, s | expected / used | pieces |")
        print("|---|---|---|---|---|---|")
        within = 0
        for scene in files:
            m = measure(arguments.sunder, scene, arguments.limit, folder)
            ratio = m["expected"] / m["used"]
            within += 0.5 <= ratio <= 2
            print(f"| {scene.stem} | {m['share']:.2f} | {m['expected']:.2g} | {m['used']:.2g} | {ratio:.2g} | "
                  f"{m['pieces']} |", flush=True)
    print(f"\n{within} of {len(files)} within a factor of two")


if __name__ == "__main__":
    main()
