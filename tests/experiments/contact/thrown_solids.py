#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Throws balls and cubes at blocks that lie on a plane, runs each scene, and judges its frames.

    tests/experiments/contact/thrown_solids.py build/release/sunder build/release/experiments/contact_judge
                                               [--scenes 100] [--seed 1] [--keep DIR]

Cells are 1 mm to 1 m long, balls and cubes 0.01 to 10 cells, speeds 0.1 to 1 000 m/s, with spin;
steps are 1/60 s to 0.1 ms. Half of the blocks never break (fracture off), the others break at 3 MPa.
Prints how many scenes of either half had crossings, overlaps by more than 2 % of the mean edge at the
end of a step, a warning of deep_overlap though nothing overlaps by that much, or another end than 0.
A scene that did is kept in DIR."""
import argparse
import itertools
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import tempfile

ORDERS = list(itertools.permutations(range(3)))


def odd(order):
    return sum(order[a] > order[b] for a in range(3) for b in range(a + 1, 3)) % 2 == 1


def block(path, cells, size, bottom):
    """Writes a block of boxes of six tetrahedra (MEDIT), about x = y = 0, from z = bottom up."""
    def row(at):
        return (at[0] * (cells[1] + 1) + at[1]) * (cells[2] + 1) + at[2] + 1

    points = [(size[0] * (i / cells[0] - 0.5), size[1] * (j / cells[1] - 0.5), bottom + size[2] * k / cells[2])
              for i, j, k in itertools.product(*(range(n + 1) for n in cells))]
    tetrahedra = []
    for start in itertools.product(*(range(n) for n in cells)):
        for order in ORDERS:
            at, corners = list(start), [row(start)]
            for axis in order:
                at[axis] += 1
                corners.append(row(at))
            if odd(order):
                corners[:2] = corners[1::-1]
            tetrahedra.append(corners)
    lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(points))]
    lines += ["%r %r %r 0" % p for p in points]
    lines += ["Tetrahedra", str(len(tetrahedra))] + ["%d %d %d %d 0" % tuple(t) for t in tetrahedra] + ["End"]
    path.write_text("\n".join(lines) + "\n")


def scene(chance, folder, breaks):
    """A scene with its meshes in a folder."""
    cell, speed = 10 ** chance.uniform(-3, 0), 10 ** chance.uniform(-1, 3)
    radius, step = cell * 10 ** chance.uniform(-2, 1), chance.choice([1 / 60, 1e-3, 1e-4])
    layers, gap = chance.choice([1, 2]), radius * chance.choice([0.1, 1])
    block(folder / "block.mesh", (4, 4, layers), (4 * cell, 4 * cell, layers * cell), 0)
    material = {"young_modulus": 30e9, "poisson_ratio": 0.2, "density": 2400, "tensile_strength": 3e6}
    place = [chance.uniform(-1.5, 1.5) * cell, chance.uniform(-1.5, 1.5) * cell, layers * cell]
    velocity = [chance.gauss(0, 0.2) * speed, 0, -speed]
    fastest = 0.3 * speed / radius
    spin = [chance.gauss(0, 1) * fastest for _ in range(3)]
    bodies = [{"mesh": "block.mesh", "material": material}]
    obstacles = [{"plane": {"normal": [0, 0, 1]}}]
    if chance.random() < 0.5:
        place[2] += radius + gap
        obstacles.append({"sphere": {"center": place, "radius": radius}, "velocity": velocity, "spin": spin,
                          "mass": 4 / 3 * math.pi * radius ** 3 * chance.choice([2400, 7800])})
    else:
        side = 2 * radius / math.sqrt(3)
        block(folder / "cube.mesh", (2, 2, 2), (side, side, side), -side / 2)
        place[2] += radius + gap
        axis = [chance.gauss(0, 1) for _ in range(3)]
        # Bodies that turn faster deform by their spin alone.
        spin = [s * min(1, 1 / (step * fastest)) for s in spin]
        bodies.append({"mesh": "cube.mesh", "material": material, "translation": place, "velocity": velocity,
                       "spin": spin, "rotation": {"axis": axis, "angle": chance.uniform(0, 360)}})
    duration = min(200 * step, max(3 * step, 4 * gap / speed))
    fracture = {"crack": chance.choice(["paper", "object"])} if breaks else {"mode": "off"}
    return {"bodies": bodies, "obstacles": obstacles, "time_step": step, "duration": duration, "fracture": fracture}


def faults_of(args, folder):
    """The faults of a scene's run."""
    out = folder / "out"
    run = subprocess.run([args.program, "run", folder / "scene.json", "-o", out, "--force", "--frame-interval", "1e-9"],
                         capture_output=True, text=True, timeout=600)
    if run.returncode == 3 and "spun_too_far" in run.stderr:
        return []
    if run.returncode != 0:
        return ["ended with %d" % run.returncode]
    judged = subprocess.run([args.judge, out], capture_output=True, text=True, timeout=600).stdout
    deepest = max((float(d) for d in re.findall(r"deepest of \w+: .* m, (\S+) of the mean edge", judged)), default=0)
    faults = ["crossing"] if "crossing, " in judged else []
    faults += ["overlap"] if deepest > 0.02 else []
    faults += ["false warning"] if "deep_overlap" in run.stderr and deepest <= 0.02 else []
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("judge")
    parser.add_argument("--scenes", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep")
    args = parser.parse_args()
    counts = {True: {}, False: {}}
    for k in range(args.scenes):
        chance = random.Random(args.seed * 1000003 + k)
        breaks = k % 2 == 1
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "scene.json").write_text(json.dumps(scene(chance, folder, breaks), indent=1))
            try:
                faults = faults_of(args, folder)
            except subprocess.TimeoutExpired:
                faults = ["more than 600 s"]
            for fault in faults:
                counts[breaks][fault] = counts[breaks].get(fault, 0) + 1
            if faults:
                print("scene %d, %s: %s" % (k, "breaks" if breaks else "whole", ", ".join(faults)), flush=True)
            if faults and args.keep:
                shutil.copytree(folder, pathlib.Path(args.keep) / ("scene_%d" % k), dirs_exist_ok=True)
    for breaks, found in counts.items():
        number = args.scenes // 2 if breaks else args.scenes - args.scenes // 2
        print("%s: %d scenes, %s" % ("breaks" if breaks else "never breaks", number,
                                     ", ".join("%s %d" % f for f in sorted(found.items())) or "no fault"))


main()
