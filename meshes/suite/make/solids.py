# SPDX-License-Identifier: MIT
"""Solids in space: cavities, handles, slivers, irregular grids, clouds; up to 50 400 tetrahedra."""

import pathlib

import shapes
from case import Case, box_case
from complexes import alike
from delaunay import cloud
from family import Family
from findings import exact_volume
from operations import fan, mixture, plane, rich, split_side
from shapes import kuhn_cubes

MESHES = pathlib.Path(__file__).resolve().parents[2]


def box_without(cells, holes):
    return kuhn_cubes(cells, lambda i, j, k: (i, j, k) not in holes)


def cavities():
    one_apart = box_without((5, 3, 3), {(1, 1, 1), (3, 1, 1)})
    yield Case("two", one_apart, mixture(one_apart, 34),
               page={"built": {"betti": (1, 0, 2), "sheets": 3}})
    at_corner = box_without((4, 4, 4), {(1, 1, 1), (2, 2, 2)})
    yield Case("two-that-touch", at_corner, [fan(62, 1, -1, 0), *mixture(at_corner, 35, 1)],
               page={"built": {"betti": (1, 0, 2), "sheets": 3}},
               shows="two cavities meet at a vertex: still two sheets, joined across no edge")
    three = box_without((7, 3, 3), {(1, 1, 1), (3, 1, 1), (5, 1, 1)})
    yield Case("three", three, [plane((1, 0, 0), 2), plane((1, 0, 0), 4.5), plane((0, 0, 1), 1.5)],
               page={"built": {"betti": (1, 0, 3), "sheets": 4}})
    ring_hole = {(i, j, 1) for i in (1, 2, 3) for j in (1, 2, 3)} - {(2, 2, 1)}
    ring_shaped = box_without((5, 5, 3), ring_hole)
    yield Case("ring-shaped", ring_shaped, [plane((0, 0, 1), 1), plane((1, 0, 0), 2.5)],
               page={"built": {"betti": (1, 1, 1), "sheets": 2}})
    nested = kuhn_cubes((5, 5, 5), lambda *at: min(at) == 0 or max(at) == 4 or at == (2, 2, 2))
    yield Case("piece-inside", nested, [plane((1, 0, 0), 2), plane((0, 1, 0), 2.5)],
               page={"built": {"betti": (2, 0, 1), "sheets": 3}},
               shows="a piece inside a cavity is a component like others")


def handles():
    for k in (1, 2, 5):
        body = kuhn_cubes((2 * k + 1, 3, 1), lambda i, j, _: j != 1 or i % 2 == 0)
        one_by_one = [plane((1, 0, 0), 1), plane((0, 1, 0), 1), plane((0, 1, 0), 2)]
        page = {"built": {"betti": (1, k, 0), "chi": 1 - k}}
        yield Case(f"chain-of-{k}", body, one_by_one, page=page)
        yield Case(f"chain-of-{k}-lengthwise", body,
                   [plane((0, 1, 0), 1.5), {"shatter": "falling"}], page=page,
                   shows="one plane cuts all the bars: all but the last cut handles, the last "
                         "parts the body")
        for case in rich(f"chain-of-{k}", body, 40 + k, page=page):
            if k < 5 or case.name.endswith(("mixture", "seeded")):
                yield case
    two_deep = kuhn_cubes((3, 3, 3), lambda i, j, k: not (i == j == 1) and not (j == k == 1))
    yield Case("two-crossing-tunnels", two_deep, mixture(two_deep, 46),
               page={"built": {"betti": (1, 3, 0)}})


def layer(lift):
    """Two layers of 2 x 2 cubes whose squares are cut along different diagonals, and a tetrahedron
    on the four points of each square between them: flat, or nearly so when points are lifted."""
    points, tets = shapes.kuhn_box(2, 2, 2)
    mirror = {shapes.grid_point((2, 2, 2), i, j, k): shapes.grid_point((2, 2, 2), 2 - i, j, k)
              for i in range(3) for j in range(3) for k in range(3)}
    upper = [tuple(mirror[p] for p in t) for t in tets[24:]]
    between = [(at, at + 1, at + 3, at + 4) for at in (9, 10, 12, 13)]
    random = shapes.Random(35)
    points = [(x, y, z + lift * (random.below(2049) - 1024) / 2 ** 30 if z == 1 else z)
              for x, y, z in points]
    tets = tets[:24] + upper + between
    return points, alike(tets, [exact_volume(points, t) for t in tets])


def slivers():
    for name, lift in (("flat", 0), ("a-micrometre-high", 1), ("a-millimetre-high", 1024)):
        body = layer(lift)
        yield from rich(name, body, 47 + lift,
                        page={"built": {"betti": (1, 0, 0), "sheets": 1}})
        yield Case(f"{name}-planes", body, [plane((0, 0, 1), 1), plane((1, 1, 0), 2)])
    points, tets = shapes.octahedron_star()
    low = [(x, y, z / 2 ** 20) for x, y, z in points]
    yield Case("flattened-star", (low, tets), [fan(0, 0, 0, 1), fan(0, 1, 1, 0)])


def grids():
    for name, cells, amplitude, seed in (("2-2-2", (2, 2, 2), 100, 1), ("3-2-2", (3, 2, 2), 150, 2),
                                         ("1-1-1", (1, 1, 1), 200, 3)):
        yield from rich(name, shapes.jittered(shapes.kuhn_box(*cells), amplitude, seed), 50 + seed)
    body = shapes.shuffled(shapes.jittered(shapes.kuhn_box(4, 3, 2), 100, 4), 5)
    yield from rich("shuffled", body, 54, shows="points, tetrahedra and corners in another order")
    body = shapes.jittered(shapes.kuhn_box(4, 4, 4), 120, 6)
    yield Case("4-4-4", body, mixture(body, 55, 3) + [{"shatter": {"seed": 55}}])
    body = shapes.jittered(kuhn_cubes((5, 4, 3), lambda i, j, k: i < 2 or j < 2 and k < 2), 120, 7)
    yield Case("angle", body, mixture(body, 56, 3) + [{"shatter": {"seed": 56}}])
    bodies = shapes.side_by_side(shapes.jittered(shapes.kuhn_box(2, 2, 2), 99, 8),
                                 shapes.jittered(shapes.ring(3, 3), 99, 9))
    yield Case("two-bodies", bodies, mixture(bodies, 57, 2) + [{"shatter": {"seed": 57}}])


def clouds():
    for count, seed in ((9, 1), (10, 2), (11, 3)):
        yield from rich(f"{count}-points", cloud(count, seed), 60 + seed)
    for count, seed in ((24, 4), (45, 5), (180, 6)):
        body = cloud(count, seed)
        last = [{"shatter": {"seed": seed}}]
        yield Case(f"{count}-points", body, mixture(body, 60 + seed, 4) + last)


def msh_body(path):
    """Points and tetrahedra of an MSH 4.1 ASCII file whose node tags are 1, 2, 3, ..."""
    words = iter(path.read_text().split("$Nodes\n")[1].replace("$", " $").split())
    blocks, count, _, _ = (int(next(words)) for _ in range(4))
    points = []
    for _ in range(blocks):
        *_, size = (int(next(words)) for _ in range(4))
        assert [int(next(words)) for _ in range(size)][0] == len(points) + 1
        points += [tuple(float(next(words)) for _ in range(3)) for _ in range(size)]
    assert len(points) == count and next(words) == "$EndNodes" and next(words) == "$Elements"
    blocks, _, _, _ = (int(next(words)) for _ in range(4))
    tets = []
    for _ in range(blocks):
        _, _, kind, size = (int(next(words)) for _ in range(4))
        assert kind == 4
        rows = [[int(next(words)) for _ in range(5)] for _ in range(size)]
        tets += [tuple(p - 1 for p in row[1:]) for row in rows]
    return points, tets


def bunny():
    body = msh_body(MESHES / "bunny.msh")
    written = {"mesh": "../bunny.msh"}
    inside = [fan(p, *n) for p, n in ((1200, (1, 0, 0)), (1300, (1, 2, 3)), (700, (0, 0, 1)),
                                      (5, (0, 1, 0)), (900, (0.5, -0.25, 1)))]
    yield Case("fans-and-planes", body, inside + [plane((1, 0, 0), 0), plane((0, 0, 1), 0.0625)],
               written=written)
    yield Case("shatter", body, [{"shatter": {"seed": 38}}], written=written)


def box_6000():
    body = shapes.kuhn_box(10, 10, 10)
    middle = shapes.grid_point((10, 10, 10), 5, 5, 5)
    fans = [fan(middle + p, *n) for p, n in ((0, (0, 0, 1)), (1, (1, 1, 1)), (11, (3, -1, 2)),
                                             (-2, (0, 1, 0)), (-5, (1, 0, 0)))]
    yield box_case("fans-and-planes", (10, 10, 10),
                   fans + [plane((0, 0, 1), 5), plane((1, 2, 3), 25.125)])
    yield box_case("mixture", (10, 10, 10), mixture(body, 58, 4))


def box_50400():
    middle = shapes.grid_point((20, 20, 21), 10, 10, 10)
    fans = [fan(middle + p, *n) for p, n in ((0, (0, 0, 1)), (1, (1, 1, 1)), (-10, (3, -1, 2)))]
    yield box_case("fans-and-a-plane", (20, 20, 21),
                   fans + [split_side(0, 0), plane((1, 0, 0), 10), plane((0, 0, 1), 20.5)])


HERE = "built here"
FAMILIES = [
    Family("34-cavities", "each cavity is a sheet of the boundary and a unit of b2", HERE,
           cavities),
    Family("35-handles", "chains of 1, 2 and 5 handles: each can fool the oracle once", HERE,
           handles),
    Family("36-slivers", "flat tetrahedra and nearly flat ones inside: topology does not ask for "
           "volumes", HERE, slivers),
    Family("37-grids", "grids with points moved, shuffled, and of other outlines", HERE, grids),
    Family("38-clouds", "Delaunay tetrahedra of random points: stars of every size", HERE, clouds,
           slow=True),
    Family("39-bunny", "the sample mesh", "meshes/README.md", bunny, slow=True),
    Family("40-box-6000", "fans and planes in 6 000 tetrahedra", HERE, box_6000, slow=True),
    Family("41-box-50400", "fans and planes in 50 400 tetrahedra", HERE, box_50400, slow=True),
]
