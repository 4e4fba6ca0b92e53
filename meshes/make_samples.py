#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the structured sample meshes: ring, cube, two_tets, bar, monolith and slab (MSH 4.1 ASCII).

    python3 make_samples.py [FOLDER]        write them into FOLDER (default: this script's)
    python3 make_samples.py --check         say which committed files differ; exit 1 if any does

The bytes depend on nothing but this script. bunny.msh and ball.msh are made by sunder-mesh: see README.md.
"""

import itertools
import pathlib
import random
import sys


def volume(points, tet):
    """Signed volume times six."""
    o, a, b, c = (points[v] for v in tet)
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = ([p[k] - o[k] for k in range(3)] for p in (a, b, c))
    return ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)


def oriented(points, tets):
    """Swaps the last two rows of every tetrahedron of negative volume."""
    return [t if volume(points, t) > 0 else (t[0], t[1], t[3], t[2]) for t in tets]


def grid_row(divisions, cell):
    i, j, k = cell
    return (k * (divisions[1] + 1) + j) * (divisions[0] + 1) + i


def grid_points(divisions, lengths):
    nx, ny, nz = divisions
    return [tuple(lengths[a] * n / divisions[a] for a, n in enumerate((i, j, k)))
            for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]


def cells(divisions, holes=()):
    nx, ny, nz = divisions
    return [(i, j, k) for k in range(nz) for j in range(ny) for i in range(nx)
            if (i, j, k) not in holes]


def kuhn(divisions, lengths, holes=()):
    """Six tetrahedra a cell, along the monotone paths from its lowest corner to its highest."""
    points = grid_points(divisions, lengths)
    tets = []
    for cell in cells(divisions, holes):
        for path in itertools.permutations(range(3)):
            corner, tet = list(cell), [grid_row(divisions, cell)]
            for axis in path:
                corner[axis] += 1
                tet.append(grid_row(divisions, corner))
            tets.append(tuple(tet))
    used = sorted({v for t in tets for v in t})
    row = {v: n for n, v in enumerate(used)}
    points = [points[v] for v in used]
    return points, oriented(points, [tuple(row[v] for v in t) for t in tets])


def five_tets(divisions, lengths):
    """Five tetrahedra a cell: a corner cut off at each odd vertex, and the middle that is left."""
    points = grid_points(divisions, lengths)
    tets = []
    for cell in cells(divisions):
        corners = [tuple(c + d for c, d in zip(cell, shift))
                   for shift in itertools.product((0, 1), repeat=3)]
        even = [c for c in corners if sum(c) % 2 == 0]
        tets.append(tuple(grid_row(divisions, c) for c in even))
        for odd in (c for c in corners if sum(c) % 2 == 1):
            beside = [e for e in even if sum(abs(a - b) for a, b in zip(e, odd)) == 1]
            tets.append(tuple(grid_row(divisions, c) for c in [odd] + beside))
    return points, oriented(points, tets)


def jitter(points, lengths, amplitude, seed):
    """Moves every point by at most `amplitude` an axis, m, and rounds to 0.1 mm. A point on a side
    of the box stays on it; so do edges and corners."""
    source = random.Random(seed)
    moved = []
    for p in points:
        shifts = [amplitude[a] * (2 * source.random() - 1) for a in range(3)]
        moved.append(tuple(round(c if c in (0, lengths[a]) else c + shifts[a], 4)
                           for a, c in enumerate(p)))
    return moved


def split_edge(points, tets, a, b):
    """Halves the edge between rows a and b, and with it every tetrahedron that has it."""
    middle = len(points)
    points.append(tuple(round((p + q) / 2, 6) for p, q in zip(points[a], points[b])))
    result = []
    for t in tets:
        if a in t and b in t:
            result += [tuple(middle if v == end else v for v in t) for end in (b, a)]
        else:
            result.append(t)
    return result


def monolith():
    """A slab of 1 x 0.3 x 2 m in 6 x 2 x 7 cells of five tetrahedra, shaken so that cracks have no
    plane to follow; the middle cell of each upright edge is halved, which gives table 1's counts."""
    divisions, lengths = (6, 2, 7), (1.0, 0.3, 2.0)
    points, tets = five_tets(divisions, lengths)
    cell = [length / n for length, n in zip(lengths, divisions)]
    points = jitter(points, lengths, [0.2 * c for c in cell], seed=3)
    for i, j in itertools.product((0, 6), (0, 2)):
        tets = split_edge(points, tets, grid_row(divisions, (i, j, 3)),
                          grid_row(divisions, (i, j, 4)))
    points = [(round(x - 0.5, 6), round(y - 0.15, 6), z) for x, y, z in points]
    return points, oriented(points, tets)


def slab():
    """The monolith's box in 12 x 4 x 14 cells of five tetrahedra, shaken: four layers, which bend."""
    divisions, lengths = (12, 4, 14), (1.0, 0.3, 2.0)
    points, tets = five_tets(divisions, lengths)
    cell = [length / n for length, n in zip(lengths, divisions)]
    points = jitter(points, lengths, [0.2 * c for c in cell], seed=7)
    points = [(round(x - 0.5, 6), round(y - 0.15, 6), round(z, 6)) for x, y, z in points]
    return points, oriented(points, tets)


def bar():
    """A bar of 0.8 x 0.06 x 0.4 m in 24 x 2 x 12 Kuhn cells, shaken but for the lower quarter of its
    middle section, where a notch can be cut."""
    divisions, lengths = (24, 2, 12), (0.8, 0.06, 0.4)
    points, tets = kuhn(divisions, lengths)
    points = [tuple(round(c, 6) for c in p) for p in points]
    cell = [length / n for length, n in zip(lengths, divisions)]
    notch = [abs(x - 0.4) < 1e-9 and z < 0.1 + 1e-9 for x, y, z in points]
    shaken = jitter(points, lengths, [0.2 * c for c in cell], seed=5)
    points = [tuple(round(c, 6) for c in (p if fixed else q))
              for p, q, fixed in zip(points, shaken, notch)]
    return points, oriented(points, tets)


def two_tets():
    return ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1)], [(0, 1, 2, 3), (1, 0, 2, 4)])


SAMPLES = {
    "ring": lambda: kuhn((3, 3, 1), (3, 3, 1), holes=((1, 1, 0),)),
    "cube": lambda: kuhn((2, 2, 2), (2, 2, 2)),
    "two_tets": two_tets,
    "bar": bar,
    "monolith": monolith,
    "slab": slab,
}


def number(x):
    return str(int(x)) if x == int(x) else repr(x)


def msh(points, tets, region):
    """MSH 4.1 ASCII with one named region, as Sunder's own writer writes it."""
    low = [number(min(p[a] for p in points)) for a in range(3)]
    high = [number(max(p[a] for p in points)) for a in range(3)]
    v, t = len(points), len(tets)
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat",
             "$PhysicalNames", "1", f'3 1 "{region}"', "$EndPhysicalNames",
             "$Entities", "0 0 0 1", " ".join(["1"] + low + high + ["1 1 0"]), "$EndEntities",
             "$Nodes", f"1 {v} 1 {v}", f"3 1 0 {v}"]
    lines += [str(n + 1) for n in range(v)]
    lines += [" ".join(number(c) for c in p) for p in points]
    lines += ["$EndNodes", "$Elements", f"1 {t} 1 {t}", f"3 1 4 {t}"]
    lines += [" ".join(str(n + 1) for n in (row, *tet)) for row, tet in enumerate(tets)]
    lines += ["$EndElements"]
    return ("\n".join(lines) + "\n").encode()


def main(arguments):
    here = pathlib.Path(__file__).resolve().parent
    made = {f"{name}.msh": msh(*make(), name) for name, make in SAMPLES.items()}
    if arguments == ["--check"]:
        differing = [name for name, data in made.items()
                     if not (here / name).is_file() or (here / name).read_bytes() != data]
        for name in differing:
            print(f"{name} is not what make_samples.py makes; run it, or undo the change")
        return 1 if differing else 0
    if len(arguments) > 1 or (arguments and arguments[0].startswith("-")):
        print(__doc__, file=sys.stderr)
        return 2
    folder = pathlib.Path(arguments[0]) if arguments else here
    for name, data in made.items():
        (folder / name).write_bytes(data)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
