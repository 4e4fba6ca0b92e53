#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs random valid scenes for a few steps each, and a heap for very many.

    tests/experiments/soak/soak.py build/release/sunder [--scenes 10000] [--seed 1] [--first 0]
                                   [--sanitized PROGRAM] [--keep DIR]
    tests/experiments/soak/soak.py build/release/sunder --heap [--steps 1000000]

A scene has one to four bodies (meshes of meshes/, turned, thrown, held, loaded, cut, with strengths
drawn or declared never to break), materials from rubber to steel, every method, model, mode,
criterion, way to find cracks and rung, obstacles of all kinds, free ones among them. It is right when
the run ends with 0, or with 3 or 5 and a finding that has a code; a signal, two minutes of
processor (with sanitizers twenty), or another end is wrong and its scene is kept. --sanitized: every
tenth scene is run by this program instead (the preset asan, or build/fuzz/sunder of tests/fuzz/run).
The codes of all findings that ended a run are counted.
--heap: blocks that fall into a heap and rest; the memory of the process is looked at as the steps go,
and must not grow in the last nine tenths by more than a tenth.
--minutes ends either after so long on the wall, and says how far it came."""
import argparse
import collections
import json
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

TREE = pathlib.Path(__file__).resolve().parents[3]
METHODS = ["floating_frame", "implicit_euler", "verlet", "broyden", "newton_cg", "sub_stepped", "modal"]


def vector(chance, size):
    return [chance.uniform(-size, size) for _ in range(3)]


def material(chance):
    m = {"young_modulus": 10 ** chance.uniform(5, 11), "poisson_ratio": chance.choice([0, 0.2, 0.3, 0.45]),
         "density": 10 ** chance.uniform(2, 4), "tensile_strength": 10 ** chance.uniform(3, 8)}
    m[chance.choice(["toughness", "fracture_energy"])] = 10 ** chance.uniform(0, 5)
    return m


def body(chance, place):
    mesh = chance.choice(["cube.msh"] * 6 + ["two_tets.msh", "monolith.msh", "ring.msh"])
    b = {"mesh": str(TREE / "meshes" / mesh), "material": material(chance),
         "translation": [chance.uniform(-1, 1), chance.uniform(-1, 1), 0.5 + 2.5 * place],
         "rotation": {"axis": [chance.random() + 0.01, chance.random(), chance.random()], "angle": chance.uniform(0, 360)},
         "velocity": vector(chance, chance.choice([0, 1, 30])), "spin": vector(chance, chance.choice([0, 0, 5]))}
    if chance.random() < 0.2:
        b["held"] = [{"minimum": [-9, -9, -9], "maximum": [9, 9, 0.01]}]
    if chance.random() < 0.2:
        b["loads"] = [{"minimum": [-9, -9, 0.4], "maximum": [9, 9, 9], "force": vector(chance, 100),
                       "ramp_time": chance.choice([0, 0.01])}]
    if chance.random() < 0.15:
        b["cuts"] = [{"plane": {"point": [0.4, 0.4, 0.4], "normal": vector(chance, 1)}}]
    if chance.random() < 0.2:
        b["strength"] = {"weibull": {"modulus": chance.choice([2, 5, 20]), "seed": chance.randrange(1000)}}
    if chance.random() < 0.1 and "held" not in b:
        b["rigid"] = True
    elif chance.random() < 0.2:
        b["order"] = 2
    return b


def obstacle(chance):
    kind = chance.choice(["sphere", "sphere", "box"])
    if kind == "sphere":
        o = {"sphere": {"center": [chance.uniform(-2, 2), chance.uniform(-2, 2), chance.uniform(3, 9)],
                        "radius": chance.uniform(0.05, 0.6)}}
    else:
        o = {"box": {"center": [chance.uniform(-2, 2), chance.uniform(-2, 2), chance.uniform(-1, 0)],
                     "half_extent": [chance.uniform(0.1, 0.8) for _ in range(3)]}}
    o["velocity"] = vector(chance, 5)
    if kind == "sphere" and chance.random() < 0.6:
        o["mass"] = 10 ** chance.uniform(-1, 3)
    return o


def scene(chance):
    method = chance.choice(METHODS[:1] * 6 + METHODS)
    model = chance.choice(["rigid_reference"] * 3 + ["corotational"])
    if model == "corotational":
        method = chance.choice(["implicit_euler", "newton_cg", "sub_stepped"])
    crack = chance.choice(["paper", "paper", "object", "cohesive"])
    if crack == "cohesive" and method != "floating_frame":
        crack = "object"
    fracture = {"mode": chance.choice(["all", "all", "budget", "off"]),
                "node_stress": chance.choice(["volume", "mass", "fit"]),
                "criterion": chance.choice(["stress", "stress", "energy"]),
                "crack": crack,
                "relax": chance.choice([0, 0, 1, 2]), "test": chance.choice(["eigenvalues", "gershgorin", "exact", "chain"]),
                "detection": chance.choice(["exact", "oracle", "dirty_counter", "walk"]),
                "face_order": chance.choice(["paper", "given"])}
    step = 10 ** chance.uniform(-5, -2.5)
    bodies = [body(chance, k) for k in range(chance.choice([1, 1, 2, 3, 4]))]
    contact = chance.choice(["impulses"] * 4 + ["penalty"])
    isolated = chance.choice(["rigid", "projection", "qr"])
    window = chance.random() < 0.7
    rubble = chance.choice(["off", "certified"])
    # One scene in twenty may have settings that are refused; of the others most run.
    if chance.random() < 0.95:
        if any("order" in b for b in bodies):
            contact, isolated = "impulses", "rigid"
            if fracture["node_stress"] == "fit":
                fracture["node_stress"] = "volume"
        if fracture["crack"] == "cohesive":
            contact, window = "impulses", True
            fracture.update({"relax": 0, "criterion": "stress"})
        if contact == "penalty":
            rubble = "off"
    return {
        "bodies": bodies,
        "obstacles": [{"plane": {"normal": [0, 0, 1], "offset": -chance.uniform(0, 2)}}] +
                     [obstacle(chance) for _ in range(chance.randrange(3))],
        "gravity": {"acceleration": chance.choice([[0, 0, -9.81], [0, 0, 0], vector(chance, 20)]),
                    "ramp_time": chance.choice([0, 0.01])},
        "time_step": step, "duration": chance.randrange(2, 8) * step,
        "model": model,
        "isolated": isolated,
        "integrator": {"method": method, "max_iterations": 60, "max_sub_steps": 200},
        "contact": {"method": contact, "between_pieces": chance.random() < 0.8,
                    "friction": chance.choice([0, 0.5, 1])},
        "impact": {"window": window, "max_sub_steps": 200},
        "fracture": fracture,
        "ladder": {"rigid": chance.random() < 0.5, "quasi_static": chance.random() < 0.5,
                   "sleep": chance.random() < 0.5, "rubble": rubble,
                   "declared_rubble": chance.choice([0, 0, 0.5])},
        "topology": {"kernel": chance.choice(["dense", "dense", "dense", "lcc"])},
        "output": {"frames": 0, "checkpoint": {"minutes": 0}},
    }


def limit_processor_time(seconds):
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))  # not of the wall: machines are shared


def run_scenes(said):
    ends, codes, wrong = collections.Counter(), collections.Counter(), 0
    start, sanitized = time.monotonic(), 0
    with tempfile.TemporaryDirectory() as place:
        place = pathlib.Path(place)
        for k in range(said.first, said.first + said.scenes):
            if said.minutes and time.monotonic() - start > 60 * said.minutes:
                break
            # A generator of its own for each: any scene can be made again by its number.
            text = json.dumps(scene(random.Random(f"{said.seed} {k}")), indent=1)
            path = place / "scene.json"
            path.write_text(text)
            is_sanitized = said.sanitized is not None and k % 10 == 0
            sanitized += is_sanitized
            program = said.sanitized if is_sanitized else said.sunder
            try:
                done = subprocess.run([program, "run", path, "--quiet", "--force", "-o", place / "out"],
                                      capture_output=True, timeout=3600,
                                      preexec_fn=lambda: limit_processor_time(1200 if is_sanitized else 120))
                code, err = done.returncode, done.stderr.decode(errors="replace")
            except subprocess.TimeoutExpired:
                code, err = "hang", ""
            ends[code] += 1
            named = re.findall(r"error: .* \[(\w+)", err)
            if code in (3, 5):
                codes.update(named[:1])
            if code != 0 and not (code in (3, 5) and named):
                wrong += 1
                kept = said.keep / f"scene_{said.seed}_{k}.json"
                kept.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(path, kept)
                print(f"scene {k}: {code}, kept as {kept}: {err.strip()[-300:]}", flush=True)
            if (k + 1) % 500 == 0:
                print(f"{k + 1} scenes, {time.monotonic() - start:.0f} s: exit codes {dict(ends)}", flush=True)
    print(f"{sum(ends.values())} scenes, {sanitized} of them under sanitizers, {time.monotonic() - start:.0f} s: "
          f"exit codes {dict(ends)}; {wrong} wrong")
    print("ended by: " + ", ".join(f"{n} x {c}" for c, n in codes.most_common()))
    return wrong


def memory_of(process):
    text = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    found = re.search(r"VmRSS:\s+(\d+)", text)
    return int(found[1]) / 1024 if found else None


def run_heap(said):
    """Blocks in a pile, one step after the other; MB of memory a tenth of the way each."""
    step = 1e-3
    heap = {"bodies": [{"mesh": str(TREE / "meshes/cube.msh"), "translation": [0.3 * (k % 3), 0.2 * (k % 2), 0.1 + 2.2 * k],
                        "material": {"young_modulus": 1e7, "tensile_strength": 2e4, "toughness": 1e3}}
                       for k in range(6)],
            "obstacles": [{"plane": {"normal": [0, 0, 1]}}], "time_step": step, "duration": said.steps * step,
            "ladder": {"rubble": "certified", "sleep": said.sleep},
            "output": {"frames": 0, "checkpoint": {"minutes": 0}}}
    with tempfile.TemporaryDirectory() as place:
        place = pathlib.Path(place)
        (place / "heap.json").write_text(json.dumps(heap))
        start = time.monotonic()
        process = subprocess.Popen([said.sunder, "run", place / "heap.json", "--quiet", "-o", place / "out"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        seen, told = [], False
        while process.poll() is None:
            time.sleep(1)
            if said.minutes and not told and time.monotonic() - start > 60 * said.minutes:
                process.send_signal(signal.SIGTERM)  # background jobs ignore SIGINT
                told = True
            if process.poll() is None and (mb := memory_of(process)):
                seen.append(mb)
        print(process.stdout.read().decode())
        report = place / "out/report.json"
        steps = json.loads(report.read_text())["steps"] if report.exists() else "no"
        tenths = [seen[len(seen) * k // 10] for k in range(10)] + [seen[-1]] if seen else []
        print(f"{steps} steps, {time.monotonic() - start:.0f} s, exit code {process.returncode}; MB by tenths of "
              f"the time: {' '.join(f'{mb:.1f}' for mb in tenths)}")
        grown = bool(tenths) and tenths[-1] > 1.1 * tenths[1]
        return process.returncode not in ((0, 130) if said.minutes else (0,)) or grown


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("sunder", type=lambda p: pathlib.Path(p).resolve())
    words.add_argument("--scenes", type=int, default=10000)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--first", type=int, default=0)
    words.add_argument("--sanitized", type=lambda p: pathlib.Path(p).resolve())
    words.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("found"))
    words.add_argument("--minutes", type=float, default=0)
    words.add_argument("--heap", action="store_true")
    words.add_argument("--steps", type=int, default=1000000)
    words.add_argument("--sleep", action="store_true", help="of a heap: what rests may fall asleep")
    said = words.parse_args()
    return 1 if (run_heap(said) if said.heap else run_scenes(said)) else 0


if __name__ == "__main__":
    sys.exit(main())
