#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs shipped scenes with some of their numbers changed: tests/experiments/soak/mutate.py SUNDER

Each run takes a few steps. It must end with a documented exit code and name the fault where that
is not 0; with exit code 0 its report has neither null nor NaN. A run that takes
longer than a minute (by a changed duration, or sub-steps of a stiff body) is interrupted, and must end with 130.
Prints the counts, and ends with 1 where something is wrong. Faulty scenes are kept in
found-mutated/.
  --seconds S   how long (300); --seed N; --scenes N: so many and no more"""
import argparse
import collections
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

TREE = pathlib.Path(__file__).resolve().parents[3]
# Scenes of small meshes, with every kind of key.
SCENES = ["block.json", "charts/monolith.json", "bar.json", "ball.json"]
EXTREMES = [1e17, 1e308, -1e300, 1e-300, 1e16, 1e-22, 1e20, -1e20, 1e-30, 5e-324, 0, -1, 1e9, 1e12, 1e-9,
            4294967295, 4294967296, -0.0, 1e100, 1e5]
DOCUMENTED = {0, 3, 4, 5, 130}


def numbers(value, path=()):
    """The paths of all numbers."""
    if isinstance(value, bool):
        return []
    if isinstance(value, (int, float)):
        return [path]
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else []
    return [p for key, inner in items for p in numbers(inner, (*path, key))]


def nulls(value, path=""):
    if value is None:
        return {path}
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else []
    return {p for key, inner in items for p in nulls(inner, f"{path}.{key}")}


def put(scene, path, number):
    for key in path[:-1]:
        scene = scene[key]
    scene[path[-1]] = number


def base_scene(name):
    """A shipped scene of ten steps, with keys that most scenes leave out."""
    scene = json.loads((TREE / "meshes" / "scenes" / name).read_text())
    folder = (TREE / "meshes" / "scenes" / name).parent
    for body in scene["bodies"]:
        body["mesh"] = str((folder / body["mesh"]).resolve())
        body.setdefault("translation", [0, 0, 0])
        body.setdefault("velocity", [0, 0, -1])
        body.setdefault("spin", [0, 0, 0.1])
        body.setdefault("material", {})
        for key, value in {"young_modulus": 3e10, "density": 2400, "tensile_strength": 3e6}.items():
            body["material"].setdefault(key, value)
    scene.pop("$schema", None)
    scene.setdefault("gravity", {}).setdefault("acceleration", [0, 0, -9.81])
    scene.setdefault("time_step", 1e-3)
    scene["duration"] = 10 * scene["time_step"]
    scene.setdefault("display_time_constant", 0.05)
    scene.setdefault("fracture", {}).update({"mode": "budget", "budget_time": 0.01, "smallest_piece": 0})
    scene.setdefault("impact", {}).setdefault("negligible", 0.1)
    scene.setdefault("ladder", {}).setdefault("sleep_after", 0.5)
    scene["output"] = {"frames": 1, "checkpoint": {"steps": 5, "minutes": 0}}
    return scene


def run(program, scene, folder, timeout=60):
    """The exit code, or the reason why it did not end, and its standard error."""
    file = folder / "scene.json"
    file.write_text(json.dumps(scene))
    with open(folder / "err", "w+b") as err:
        child = subprocess.Popen([program, "run", file, "--quiet", "--force", "-o", folder / "out"],
                                 stdout=subprocess.DEVNULL, stderr=err)
        try:
            code = child.wait(timeout)
        except subprocess.TimeoutExpired:
            child.terminate()
            try:
                code = child.wait(timeout)
            except subprocess.TimeoutExpired:
                child.kill()
                child.wait()
                return "no answer to SIGTERM", ""
        err.seek(0)
        text = err.read().decode(errors="replace")
    return code, text


def report_of(folder):
    def no_number(word):
        raise ValueError(word)
    return json.loads((folder / "out" / "report.json").read_text(), parse_constant=no_number)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--seconds", type=float, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scenes", type=int, default=10**9)
    a = parser.parse_args()
    chance = random.Random(a.seed)
    codes, causes, wrong = collections.Counter(), collections.Counter(), 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        bases = [base_scene(s) for s in SCENES]
        for scene, shipped in zip(bases, SCENES):
            code, err = run(a.program, scene, folder)
            if code != 0:
                sys.exit(f"{shipped} itself ends with {code}: {err}")
        start, count = time.monotonic(), 0
        while count < a.scenes and time.monotonic() - start < a.seconds:
            count += 1
            which = chance.randrange(len(bases))
            scene = json.loads(json.dumps(bases[which]))
            for path in chance.sample(numbers(scene), chance.choice([1, 1, 1, 2, 3])):
                put(scene, path, chance.choice(EXTREMES))
            code, err = run(a.program, scene, folder)
            codes[code] += 1
            fault = None
            if code not in DOCUMENTED:
                fault = f"ended with {code}"
            elif code not in (0, 130) and "error:" not in err:
                fault = f"exit code {code} without a word"
            elif code in (0, 130):
                try:
                    found = nulls(report_of(folder))
                    fault = f"null at {sorted(found)}" if found else None
                except ValueError as word:
                    fault = f"{word} in the report"
            else:
                causes[" ".join(re.findall(r"\[([a-z_]+)", err)[:1])] += 1
            if fault:
                wrong += 1
                kept = pathlib.Path("found-mutated")
                kept.mkdir(exist_ok=True)
                (kept / f"{a.seed}-{count}.json").write_text(json.dumps(scene, indent=1))
                print(f"scene {count}: {fault}\n{err}", flush=True)
    print(f"{count} scenes, seed {a.seed}: exit codes {dict(codes)}, wrong {wrong}; refused and ended by {dict(causes)}")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
