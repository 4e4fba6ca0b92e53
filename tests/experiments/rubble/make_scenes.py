#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Scenes for rubble_frames and rubble_session that are not among the samples, with their meshes.

    tests/experiments/rubble/make_scenes.py FOLDER

table.json   the bunny falls 1 m from a table, as a new user writes it: steps of 1/240 s
vase.json    a vase of 7 776 tetrahedra, two layers in its wall, falls on a floor at 4 m/s
large.json   a block of 60 000 tetrahedra that floats; a ball strikes one of its corners every second
play.json    two slabs on a floor for somebody to play with: 414 tetrahedra each, steps of 1/240 s
"""
import json
import math
import pathlib
import sys

TREE = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(TREE / "meshes"))
from make_samples import cells, oriented
import itertools

FLOOR = [{"plane": {"normal": [0, 0, 1]}, "friction": 0.5}]
RUBBLE = {"rubble": "certified", "declared_rubble": 0.02}


def vase(around=36, layers=2, along=18, thickness=0.006):
    """A lathe's: six tetrahedra a cell; a hole of 2 cm in its foot, as a flower pot has."""
    outline = [(0.01, 0.0), (0.05, 0.0), (0.075, 0.06), (0.07, 0.13), (0.04, 0.18), (0.05, 0.22)]
    length = [0.0]
    for (r, z), (s, y) in zip(outline, outline[1:]):
        length.append(length[-1] + math.hypot(s - r, y - z))

    def at(part):
        way = part * length[-1]
        k = next(i for i in range(len(outline) - 1) if way <= length[i + 1] + 1e-12)
        share = (way - length[k]) / (length[k + 1] - length[k])
        (r, z), (s, y) = outline[k], outline[k + 1]
        return r + share * (s - r), z + share * (y - z)

    def point(i, j, k):
        r, z = at(k / along)
        before, after = at(max(0, k / along - 1e-3)), at(min(1, k / along + 1e-3))
        dr, dz = after[0] - before[0], after[1] - before[1]
        size = math.hypot(dr, dz)
        depth = thickness * j / layers
        r, z = r - depth * dz / size, z + depth * dr / size
        angle = 2 * math.pi * i / around
        return r * math.cos(angle), r * math.sin(angle), z

    row = {c: n for n, c in enumerate(itertools.product(range(around), range(layers + 1), range(along + 1)))}
    points = [point(*c) for c in row]
    tets = []
    for cell in cells((around, layers, along)):
        for path in itertools.permutations(range(3)):
            corner, tet = list(cell), []
            for axis in (None, *path):
                if axis is not None:
                    corner[axis] += 1
                tet.append(row[corner[0] % around, corner[1], corner[2]])
            tets.append(tuple(tet))
    return points, oriented(points, tets)


def block(counts, cell):
    """Cubes, six tetrahedra each."""
    row = {c: n for n, c in enumerate(itertools.product(*(range(n + 1) for n in counts)))}
    points = [tuple(cell * k for k in c) for c in row]
    tets = []
    for cube in cells(counts):
        for path in itertools.permutations(range(3)):
            corner, tet = list(cube), []
            for axis in (None, *path):
                if axis is not None:
                    corner[axis] += 1
                tet.append(row[tuple(corner)])
            tets.append(tuple(tet))
    return points, oriented(points, tets)


def balls(count, speed, sides):
    """One a second, at corners of a box in turn, along its longest diagonals."""
    for k in range(count):
        sign = [1 if k >> a & 1 else -1 for a in range(3)]
        at = [s / 2 + g * s / 2 * 0.9 for s, g in zip(sides, sign)]
        way = [-g / math.sqrt(3) for g in sign]
        start = [a - w * (speed * (k + 0.5) + 0.2) for a, w in zip(at, way)]
        yield {"sphere": {"center": start, "radius": 0.05}, "velocity": [speed * w for w in way], "mass": 1}


def medit(points, tets):
    lines = ["MeshVersionFormatted 2", "Dimension 3", "Vertices", str(len(points))]
    lines += [f"{x!r} {y!r} {z!r} 0" for x, y, z in points]
    lines += ["Tetrahedra", str(len(tets))]
    lines += [" ".join(str(v + 1) for v in t) + " 0" for t in tets]
    return "\n".join(lines + ["End", ""])


def scenes():
    clay = {"young_modulus": 3e9, "poisson_ratio": 0.2, "density": 2000, "tensile_strength": 5e6}
    bunny = {"young_modulus": 1e9, "poisson_ratio": 0.22, "density": 2400, "tensile_strength": 6e5}
    slab = {"young_modulus": 1e9, "poisson_ratio": 0.2, "density": 2400, "tensile_strength": 5e5}
    turn = {"axis": [1, 0.3, 0], "angle": 25}
    yield {"name": "table", "accuracy": "preview", "ladder": RUBBLE,
           "bodies": [{"mesh": "bunny.msh", "material": bunny, "rotation": turn, "translation": [0, 0, 1.1]}],
           "obstacles": FLOOR, "time_step": 1 / 240, "duration": 8}
    yield {"name": "vase", "accuracy": "preview", "ladder": RUBBLE,
           "bodies": [{"mesh": "vase.mesh", "material": clay, "rotation": turn, "translation": [0, 0, 0.08],
                       "velocity": [0, 0, -4]}],
           "obstacles": FLOOR, "time_step": 1e-3, "duration": 5}
    yield {"name": "large", "accuracy": "preview", "ladder": RUBBLE, "gravity": {"acceleration": [0, 0, 0]},
           "bodies": [{"mesh": "block.mesh", "material": {**clay, "tensile_strength": 1e6}}],
           "obstacles": list(balls(10, 8, (1, 1, 1.25))), "time_step": 1 / 240, "duration": 10.5}
    yield {"name": "play", "accuracy": "preview", "ladder": RUBBLE,
           "bodies": [{"mesh": "monolith.msh", "material": slab, "translation": [0, 0, 0.02]},
                      {"mesh": "monolith.msh", "material": slab, "translation": [3, 0, 0.02]}],
           "obstacles": FLOOR, "time_step": 1 / 240, "duration": 300}


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "vase.mesh").write_text(medit(*vase()))
    (folder / "block.mesh").write_text(medit(*block((20, 20, 25), 0.05)))
    for name in ("bunny.msh", "monolith.msh"):
        (folder / name).write_bytes((TREE / "meshes" / name).read_bytes())
    for scene in scenes():
        (folder / f"{scene['name']}.json").write_text(json.dumps(scene, indent=1) + "\n")


if __name__ == "__main__":
    main()
