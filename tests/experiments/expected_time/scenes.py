#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes scenes as users write them, with their meshes: default settings, everyday objects.

    tests/experiments/expected_time/scenes.py FOLDER

Meshes are grids of boxes with six tetrahedra each, mapped to the shape; inner points are shifted at
random (fixed seeds), as meshers leave them. expected_time.py compares predicted times with these."""
import json
import math
import pathlib
import random
import sys

GLASS = {"young_modulus": 70e9, "poisson_ratio": 0.22, "density": 2500, "tensile_strength": 45e6}
CERAMIC = {"young_modulus": 40e9, "poisson_ratio": 0.2, "density": 2200, "tensile_strength": 25e6,
           "toughness": 1e6}
BRICK = {"young_modulus": 15e9, "poisson_ratio": 0.2, "density": 1900, "tensile_strength": 2e6,
         "fracture_energy": 60}
CONCRETE = {"young_modulus": 30e9, "poisson_ratio": 0.2, "density": 2400, "tensile_strength": 3e6,
            "toughness": 1e6}
PLASTER = {"young_modulus": 5e9, "poisson_ratio": 0.2, "density": 1100, "tensile_strength": 2.5e6,
           "toughness": 0.15e6}
RUBBER = {"young_modulus": 2e6, "poisson_ratio": 0.45, "density": 1100, "tensile_strength": 5e6}
STEEL = {"young_modulus": 200e9, "poisson_ratio": 0.3, "density": 7800, "tensile_strength": 600e6}
GROUND = {"plane": {"normal": [0, 0, 1]}}

# Six tetrahedra around the diagonal of a unit box: one per order in which the axes are walked.
WALKS = [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]


def grid(cells, place, closed=False, shift=0.125, seed=1):
    """Points and tetrahedra of a grid of `cells` boxes, its corners put at place(u, v, w) with u, v,
    w from 0 to 1. `closed`: u = 1 is u = 0. Inner points move by up to `shift` of a cell."""
    n, rng = cells, random.Random(seed)
    at, points, tetrahedra = {}, [], []

    def row(i, j, k):
        i = i % n[0] if closed else i
        if (i, j, k) not in at:
            inner = (closed or 0 < i < n[0]) and 0 < j < n[1] and 0 < k < n[2]
            moved = [c + (rng.uniform(-shift, shift) if inner else 0) for c in (i, j, k)]
            at[i, j, k] = len(points)
            points.append(place(*(c / m for c, m in zip(moved, n))))
        return at[i, j, k]

    for i in range(n[0]):
        for j in range(n[1]):
            for k in range(n[2]):
                for walk in WALKS:
                    corner = [i, j, k]
                    rows = [row(*corner)]
                    for axis in walk:
                        corner[axis] += 1
                        rows.append(row(*corner))
                    tetrahedra.append(positive(points, rows))
    return points, tetrahedra


def positive(points, rows):
    a, b, c, d = (points[r] for r in rows)
    u, v, w = ([q - p for p, q in zip(a, x)] for x in (b, c, d))
    volume = (u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
              u[2] * (v[0] * w[1] - v[1] * w[0]))
    return rows if volume > 0 else [rows[0], rows[2], rows[1], rows[3]]


def box(size, cells, seed=1):
    return grid(cells, lambda u, v, w: (size[0] * u, size[1] * v, size[2] * w), seed=seed)


def ball(radius, cells):
    """A cube of cells, drawn to a ball."""
    def place(*u):
        x = [2 * t - 1 for t in u]
        longest, norm = max(map(abs, x)), math.sqrt(sum(t * t for t in x))
        return tuple(radius * t * (longest / norm if norm > 0 else 1) for t in x)
    return grid((cells,) * 3, place, shift=0)


def tube(height, cells, wall, radius):
    """An open vase: radius(w) m outside at the height w from 0 to 1, `wall` m thick; `cells` around,
    across the wall and up."""
    def place(u, v, w):
        r = radius(w) - wall * (1 - v)
        return r * math.cos(2 * math.pi * u), r * math.sin(2 * math.pi * u), height * w
    return grid(cells, place, closed=True)


def write_mesh(path, mesh):
    points, tetrahedra = mesh
    with open(path, "w", encoding="ascii") as out:
        out.write("MeshVersionFormatted 2\nDimension 3\nVertices\n%d\n" % len(points))
        out.writelines("%.17g %.17g %.17g 0\n" % tuple(p) for p in points)
        out.write("Tetrahedra\n%d\n" % len(tetrahedra))
        out.writelines("%d %d %d %d 0\n" % tuple(r + 1 for r in t) for t in tetrahedra)
        out.write("End\n")


def body(mesh, material, **keys):
    return {"mesh": mesh + ".mesh", "material": material, **keys}


def sphere(center, radius, velocity=None, mass=None):
    keys = {"velocity": velocity} if velocity else {}
    return {"sphere": {"center": center, "radius": radius}, **keys, **({"mass": mass} if mass else {})}


MESHES = {
    "pane": lambda: box((0.3, 0.006, 0.3), (30, 2, 30)),
    "brick": lambda: box((0.24, 0.115, 0.07), (6, 3, 2), seed=2),
    "vase": lambda: tube(0.3, (28, 2, 18), 0.008, lambda w: 0.07 + 0.03 * math.sin(4.5 * w)),
    "beam": lambda: box((1.0, 0.05, 0.1), (20, 2, 4), seed=3),
    "pillar": lambda: box((0.3, 0.3, 1.5), (4, 4, 20), seed=4),
    "block": lambda: box((0.1, 0.1, 0.1), (4, 4, 4), seed=5),
    "ball": lambda: ball(0.1, 8),
    "plate": lambda: box((0.25, 0.25, 0.012), (16, 16, 2), seed=7),
    "slab": lambda: box((0.8, 0.4, 0.1), (16, 8, 3), seed=8),
}


def scenes():
    """Name to scene."""
    made = {}
    margin = 0.009
    made["pane"] = {
        "bodies": [body("pane", GLASS, held=[
            {"minimum": [-1, -1, -1], "maximum": [1, 1, margin]},
            {"minimum": [-1, -1, 0.3 - margin], "maximum": [1, 1, 1]},
            {"minimum": [-1, -1, -1], "maximum": [margin, 1, 1]},
            {"minimum": [0.3 - margin, -1, -1], "maximum": [1, 1, 1]}])],
        "obstacles": [sphere([0.16, -0.03, 0.16], 0.025, [0, 10, 0], 0.51)], "duration": 0.03}
    made["drop"] = {
        "bodies": [body("brick", BRICK, translation=[0, 0, 0.15], velocity=[0, 0, -6],
                        rotation={"axis": [1, 0.3, 0], "angle": 35})],
        "obstacles": [GROUND], "duration": 0.1}
    wall = []
    for course in range(5):
        for i in range(4):
            wall.append(body("brick", BRICK, name=f"brick_{course}_{i}", translation=[
                0.25 * i + 0.125 * (course % 2), 0, 0.001 + 0.0711 * course]))
    made["wall"] = {"bodies": wall, "duration": 0.5, "obstacles": [
        {**GROUND, "friction": 0.7}, sphere([0.5, -0.3, 0.2], 0.08, [0, 12, 0], 17)]}
    made["vase"] = {
        "bodies": [body("vase", CERAMIC, translation=[0, 0, 0.8],
                        rotation={"axis": [0, 1, 0], "angle": 60})],
        "obstacles": [GROUND], "duration": 0.6}
    made["stack"] = {
        "bodies": [body("brick", BRICK, name=f"brick_{i}", translation=[0.01 * (i % 2), 0, 0.0705 * i])
                   for i in range(6)],
        "obstacles": [GROUND], "duration": 1.0}
    made["beam"] = {
        "bodies": [body("beam", STEEL, held=[{"minimum": [-1, -1, -1], "maximum": [0.001, 1, 1]}],
                        loads=[{"minimum": [0.999, -1, -1], "maximum": [2, 1, 1],
                                "force": [0, 0, -5000], "ramp_time": 0.2}])],
        "duration": 0.5}
    made["bent_beam"] = {
        "bodies": [body("beam", CONCRETE, held=[
            {"minimum": [-1, -1, -1], "maximum": [0.051, 1, 0.001]},
            {"minimum": [0.949, -1, -1], "maximum": [2, 1, 0.001]}],
            loads=[{"minimum": [0.45, -1, 0.099], "maximum": [0.55, 1, 1],
                    "force": [0, 0, -4000], "ramp_time": 0.1}])],
        "duration": 0.15}
    made["pillar"] = {
        "bodies": [body("pillar", CONCRETE, translation=[0, 0, 0])],
        "obstacles": [GROUND, sphere([0.15, -0.6, 1.1], 0.2, [0, 9, 0], 80)], "duration": 0.3}
    made["collision"] = {
        "bodies": [body("block", CONCRETE, name="left", velocity=[8, 0, 0], spin=[0, 0, 5]),
                   body("block", CONCRETE, name="right", translation=[0.2, 0.03, 0.02],
                        velocity=[-8, 0, 0])],
        "gravity": {"acceleration": [0, 0, 0]}, "duration": 0.05}
    made["bounce"] = {
        "bodies": [body("ball", RUBBER, translation=[0, 0, 0.5], velocity=[1, 0, 0])],
        "obstacles": [GROUND], "duration": 1.0}
    made["plaster_ball"] = {
        "bodies": [body("ball", PLASTER, translation=[0, 0, 0.15], velocity=[0, 0, -6])],
        "obstacles": [GROUND], "duration": 0.1}
    made["plate"] = {
        "bodies": [body("plate", CERAMIC, translation=[0, 0, 0.3],
                        rotation={"axis": [1, 0, 0], "angle": 70}, velocity=[0, 0, -2])],
        "obstacles": [GROUND], "duration": 0.3}
    made["heap"] = {
        "bodies": [body("block", CONCRETE, name=f"block_{i}", translation=[
            0.03 * (i % 3), 0.02 * (i % 2), 0.05 + 0.16 * i], rotation={
                "axis": [1, 1, 0.3], "angle": 25 * i}) for i in range(8)],
        "obstacles": [GROUND], "duration": 1.0}
    made["pressed"] = {
        "bodies": [body("slab", CONCRETE, held=[{"minimum": [-1, -1, -1], "maximum": [2, 2, 0.001]},
                        {"minimum": [-1, -1, 0.099], "maximum": [2, 2, 1],
                         "velocity": [0.02, 0, 0], "ramp_time": 0.01}])],
        "duration": 0.05}
    return {name: {"name": name, **scene} for name, scene in made.items()}


def write_all(folder):
    """The scene files, in the folder with their meshes."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in MESHES.items():
        write_mesh(folder / f"{name}.mesh", make())
    files = []
    for name, scene in scenes().items():
        files.append(folder / f"{name}.json")
        files[-1].write_text(json.dumps(scene, indent=1) + "\n", encoding="utf-8")
    return files


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for file in write_all(sys.argv[1]):
        print(file)
