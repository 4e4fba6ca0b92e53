#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""`sunder check` on bodies that pass through themselves: no wrong Betti number is called valid.

    tests/experiments/cells/overlapping_bodies.py [--sunder build/release/sunder] [--bodies 50] [--seed 1] [--keep DIR]

A body is a random polycube or a box with a cavity. Tubes run in curves from its surface to other
places of the surface, or to free ends, through walls, cavities and other tubes in between. Its
hexahedra become tetrahedra by `sunder convert --split`; bodies with a tube so bent that a
tetrahedron is turned inside out are drawn again. The truth is computed here from (tetrahedron,
corner) pairs joined across common faces, by ranks over GF(2) and GF(32749), without anything of
Sunder's. Printed for each body: the verdict of check, its Betti numbers and the true ones. A body
with other numbers than its boundary's is refined to more than 200 000 tetrahedra: there check has
to give none. Exit code 1: a wrong Betti number."""
import argparse
import collections
import itertools
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

import numpy

PRIMES = (2, 32749)
QUADS = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))  # of a hexahedron, outwards


# ---- a body ---------------------------------------------------------------------------------------

def polycube(draw):
    """Cubes of a random connected set, or of a box with a cavity: (points, hexahedra)."""
    if draw.random() < 0.5:
        size = [draw.randint(3, 5) for _ in range(3)]
        cubes = {c for c in itertools.product(*map(range, size)) if any(x in (0, n - 1) for x, n in zip(c, size))}
    else:
        cubes, wanted = {(0, 0, 0)}, draw.randint(8, 40)
        while len(cubes) < wanted:
            at, axis = list(draw.choice(sorted(cubes))), draw.randrange(3)
            at[axis] += draw.choice((-1, 1))
            cubes.add(tuple(at))
    rows, points, hexahedra = {}, [], []
    for x, y, z in sorted(cubes):
        corners = []
        for dx, dy, dz in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)):
            at = (x + dx, y + dy, z + dz)
            if at not in rows:
                rows[at] = len(points)
                points.append([float(v) for v in at])
            corners.append(rows[at])
        hexahedra.append(corners)
    return points, hexahedra


def surface(hexahedra):
    count = collections.Counter(tuple(sorted(h[i] for i in quad)) for h in hexahedra for quad in QUADS)
    return [[h[i] for i in quad] for h in hexahedra for quad in QUADS if count[tuple(sorted(h[i] for i in quad))] == 1]


def add_tube(points, hexahedra, draw):
    """Hexahedra along a curve from one face of the surface to another that shares no corner with it, or to a free end.
    Sections are squares that turn as little as they can; the remaining turn to the end's corners is
    spread evenly."""
    quads = surface(hexahedra)
    begin, end = draw.sample(quads, 2)
    if set(begin) & set(end):
        return
    first, last = (numpy.array([points[i] for i in quad]) for quad in (begin, end))
    normals = [numpy.cross(q[2] - q[0], q[3] - q[1]) for q in (first, last)]
    normals = [n / numpy.linalg.norm(n) for n in normals]
    is_free = draw.random() < 0.2
    a, b = first.mean(axis=0), last.mean(axis=0)
    if is_free:
        b, normals[1] = a + normals[0] * draw.uniform(3, 8), -normals[0]
    reach = max(4.0, draw.uniform(1, 3) * numpy.linalg.norm(b - a))
    parts = math.ceil(reach)
    s = numpy.linspace(0, 1, parts + 1)[:, None]
    way = ((2 * s**3 - 3 * s**2 + 1) * a + (s**3 - 2 * s**2 + s) * reach * normals[0]
           + (3 * s**2 - 2 * s**3) * b + (s**3 - s**2) * reach * -normals[1])
    along = ((6 * s**2 - 6 * s) * (a - b) + (3 * s**2 - 4 * s + 1) * reach * normals[0]
             + (3 * s**2 - 2 * s) * reach * -normals[1])
    along /= numpy.linalg.norm(along, axis=1)[:, None]
    offsets = [first - a]
    for k in range(parts):
        offsets.append(offsets[-1] @ rotation(along[k], along[k + 1]).T)
    twist, goal = 0.0, None
    if not is_free:
        other, target = end[::-1], (last - b)[::-1]
        def angle(turn):
            p, q = offsets[-1][0], numpy.roll(target, -turn, axis=0)[0]
            return math.atan2(numpy.cross(p, q) @ along[-1], p @ q)
        turn = min(range(4), key=lambda k: abs(angle(k)))
        twist, goal = angle(turn), other[turn:] + other[:turn]
    section = begin
    for k in range(1, parts + 1):
        if k == parts and goal:
            new = goal
        else:
            new = list(range(len(points), len(points) + 4))
            points.extend((way[k] + offsets[k] @ turned(along[k], twist * k / parts).T).tolist())
        hexahedra.append(section + new)
        section = new


def turned(axis, angle):
    """The matrix that turns by an angle about a unit vector."""
    x, y, z = axis
    k = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def rotation(a, b):
    """The smallest turn that takes one unit vector to another."""
    axis = numpy.cross(a, b)
    sine = numpy.linalg.norm(axis)
    return numpy.eye(3) if sine < 1e-12 else turned(axis / sine, math.atan2(sine, a @ b))


def write_hexahedra(path, points, hexahedra):
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(points))]
    lines += [f"{i + 1} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(points)]
    lines += ["$EndNodes", "$Elements", str(len(hexahedra))]
    lines += [f"{i + 1} 5 2 0 1 " + " ".join(str(v + 1) for v in h) for i, h in enumerate(hexahedra)]
    path.write_text("\n".join(lines + ["$EndElements", ""]))


def read_tetrahedra(path):
    """Of MEDIT's text."""
    words = iter(path.read_text().split())
    for word in words:
        if word == "Tetrahedra":
            return [[int(next(words)) for _ in range(5)][:4] for _ in range(int(next(words)))]
    raise SystemExit(f"{path}: no tetrahedra")


# ---- its homology -----------------------------------------------------------------------------------

def cells_of(tetrahedra):
    """Vertices, edges, faces and tetrahedra as orbits: corners are joined where they meet across a common face only."""
    parent = {(t, p): (t, p) for t, four in enumerate(tetrahedra) for p in four}

    def root(a):
        while parent[a] != a:
            parent[a] = parent[parent[a]]
            a = parent[a]
        return a

    edge_parent = {(t, *sorted(pair)): (t, *sorted(pair)) for t, four in enumerate(tetrahedra) for pair in itertools.combinations(four, 2)}

    def edge_root(a):
        while edge_parent[a] != a:
            a = edge_parent[a]
        return a

    sides = collections.defaultdict(list)
    for t, four in enumerate(tetrahedra):
        for three in itertools.combinations(sorted(four), 3):
            sides[three].append(t)
    for three, both in sides.items():
        if len(both) == 2:
            for p in three:
                parent[root((both[0], p))] = root((both[1], p))
            for pair in itertools.combinations(three, 2):
                edge_parent[edge_root((both[0], *pair))] = edge_root((both[1], *pair))
    boundary = [[], [], [], []]  # of each dimension's cells: {row of the cell below: sign}
    vertices = {r: i for i, r in enumerate(sorted({root(a) for a in parent}))}
    edges = {r: i for i, r in enumerate(sorted({edge_root(a) for a in edge_parent}))}
    faces = {three: i for i, three in enumerate(sorted(sides))}
    boundary[0] = [{} for _ in vertices]
    for t, a, b in edges:
        boundary[1].append({vertices[root((t, b))]: 1, vertices[root((t, a))]: -1})
    for three in faces:
        t = sides[three][0]
        a, b, c = three
        boundary[2].append({edges[edge_root((t, b, c))]: 1, edges[edge_root((t, a, c))]: -1, edges[edge_root((t, a, b))]: 1})
    for four in tetrahedra:
        a, b, c, d = sorted(four)
        boundary[3].append({faces[b, c, d]: 1, faces[a, c, d]: -1, faces[a, b, d]: 1, faces[a, b, c]: -1})
    return boundary


def rank(columns, prime):
    """Of a matrix by its columns: each is reduced by those with the same lowest row as its own."""
    by_lowest = {}
    for column in columns:
        column = {row: value % prime for row, value in column.items() if value % prime}
        while column:
            low = max(column)
            other = by_lowest.get(low)
            if other is None:
                by_lowest[low] = column
                break
            factor = column[low] * pow(other[low], -1, prime) % prime
            for row, value in other.items():
                left = (column.get(row, 0) - factor * value) % prime
                if left:
                    column[row] = left
                else:
                    column.pop(row, None)
    return len(by_lowest)


def betti_numbers(tetrahedra):
    """Of the orbits; the same over both primes, or None: then there is torsion."""
    boundary = cells_of(tetrahedra)
    found = set()
    for prime in PRIMES:
        ranks = [0] + [rank(boundary[d], prime) for d in (1, 2, 3)] + [0]
        found.add(tuple(len(boundary[d]) - ranks[d] - ranks[d + 1] for d in range(4)))
    return found.pop() if len(found) == 1 else None


# ---- the verdict of check ------------------------------------------------------------------------

def check(sunder, path, *words):
    done = subprocess.run([sunder, "check", path, "--json", *words], capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise SystemExit(f"{path}: exit code {done.returncode}: {done.stderr}")
    answer = json.loads(done.stdout)
    return answer, [f["code"] for f in answer["findings"]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sunder", type=pathlib.Path, default=pathlib.Path("build/release/sunder"))
    parser.add_argument("--bodies", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, help="folder that the meshes stay in")
    options = parser.parse_args()
    draw, tally, wrong, large = random.Random(options.seed), collections.Counter(), 0, None
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        number = 0
        while number < options.bodies:
            points, hexahedra = polycube(draw)
            for _ in range(draw.randint(1, 4)):
                add_tube(points, hexahedra, draw)
            cubes, body = folder / f"cubes_{number}.msh", folder / f"body_{number}.mesh"
            write_hexahedra(cubes, points, hexahedra)
            subprocess.run([options.sunder, "convert", cubes, body, "--split", "--quiet"], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            answer, codes = check(options.sunder, body)
            if {"folded_tetrahedron", "flat_tetrahedron"} & set(codes):
                continue
            number += 1
            truth = betti_numbers(read_tetrahedra(body))
            told = answer.get("betti")
            is_right = told is not None and truth is not None and list(told) == list(truth)[:len(told)]
            errors = [f["code"] for f in answer["findings"] if f["severity"] == "error"]
            verdict = ", ".join(sorted({*errors, *({"overlapping_faces"} & set(codes))})) or "valid"
            tally[verdict] += 1
            is_wrong = told is not None and not is_right
            wrong += is_wrong
            print(f"body {number}: {answer['counts']['tetrahedra']} tetrahedra, {verdict}, Betti numbers {told}, true {truth}"
                  + (" WRONG" if is_wrong else ""))
            if errors == ["overlapping_body"] and large is None:
                large = body
        for verdict, count in tally.most_common():
            print(f"{count} {verdict}")
        if large is not None:
            fine, levels = folder / "fine.msh", math.ceil(math.log(200001 / len(read_tetrahedra(large)), 8))
            subprocess.run([options.sunder, "refine", large, fine, "--levels", str(levels), "--quiet"], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            answer, codes = check(options.sunder, fine)
            asked_codes = check(options.sunder, fine, "--homology")[1]
            is_told = ("betti_by_sheets" in codes and answer.get("betti") is None and "overlapping_faces" in codes
                       and "overlapping_body" in asked_codes)
            print(f"refined to {answer['counts']['tetrahedra']}: "
                  + ("no Betti numbers where faces overlap; --homology computes them, and tells the body" if is_told else "NOT TOLD"))
            wrong += not is_told
    print(f"{wrong} wrong")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
