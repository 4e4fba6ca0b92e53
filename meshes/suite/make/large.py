# SPDX-License-Identifier: MIT
"""Rings round an edge and stars round a vertex of 64 to 131 200 tetrahedra: a search that gives up,
a table that forgets when it grows, a counter of 8 or 16 bits go wrong in them."""

import shapes
from case import Case, box_case
from family import Family
from operations import SHATTERS, breaks, fan, glue, plane, split, split_side


def of_size(k, kind, operations, name=None, **more):
    """A body that the JSON only names."""
    body = {"edge_ring": shapes.edge_ring, "vertex_star": shapes.vertex_star}[kind](k)
    return Case(name or f"{k}", body, operations, written={kind: k}, **more)


def checkerboard(k):
    """Every second tetrahedron on the other side: a break at the middle point splits all faces
    there but those between two of one side."""
    return {"positive": list(range(0, k, 2)), "negative": list(range(1, k, 2))}


def ring_cuts(k):
    """One cut opens the ring: round its edge all k have to be walked. The next one is walked to from
    the far side, over k - 1, and takes one tetrahedron off; another one is taken off from its own
    side, so that all the others leave. Then halves of halves, and gluing."""
    return [split(0, 1, 2), split_side(1, 4), split_side(1, 3),
            fan(0, 1, 0, 0, tetrahedron=k // 2), glue(0, 1, 3), plane((0, 1, 0), 0)]


def rings():
    for k in (64, 300, 1000, 10000):
        yield of_size(k, "edge_ring", ring_cuts(k))
    for k, orders in ((64, SHATTERS), (300, SHATTERS), (1000, SHATTERS[2:])):
        for order in orders:
            word = order["shatter"] if isinstance(order["shatter"], str) else "seeded"
            yield of_size(k, "edge_ring", [order], f"{k}-shatter-{word}")
    for k in (64, 300):
        yield of_size(k, "edge_ring", breaks(1, 0), f"{k}-labelled", cracks=[checkerboard(k)],
                      shows="one break splits every face of the ring")


def star_cuts(k):
    """Two slits from opposite sides make the link of the middle point a ring: a third cut parts no
    vertex there, which only a search round all of it can tell. With the last one, of a plane
    through the point, two halves of k / 2 come apart. Round the upper pole a cut is walked to from
    its far side, over k / 2 - 1, and at another one all but one of k / 2 - 1 leave."""
    half = k // 2
    one, other = half // 4, 3 * half // 4  # places on the rim with x = 0
    return [split(0, 2, 3 + one), split_side(one + 1, 3 + one + 2),
            split_side(one + 1, 3 + one + 1), split(0, 1, 3 + other), split(0, 2, 3 + other), glue(0, 2, 3 + other), fan(0, 1, 0, 0)]


def stars():
    for k in (64, 304, 1000, 10000):
        yield of_size(k, "vertex_star", star_cuts(k))
    for k in (64, 304, 1000):
        yield of_size(k, "vertex_star", [fan(0, 0, 0, 1), fan(0, 1, 1, 0)], f"{k}-equator",
                      shows="the last face of a fan of k / 2 parts the middle point")
    for k in (64, 304):
        yield of_size(k, "vertex_star", [plane((1, 2, 3), 0), {"shatter": {"seed": k}}],
                      f"{k}-shatter")
        yield of_size(k, "vertex_star", breaks(0, 1, 2), f"{k}-labelled",
                      cracks=[checkerboard(k)])


    points, tets = shapes.vertex_star(256)
    turned = [t if n % 7 else (t[0], t[1], t[3], t[2]) for n, t in enumerate(tets)]
    yield Case("256-inverted", (points, turned), [fan(0, 1, 2, 3)],
               shows="256 volumes say that the first tetrahedron is inverted: counted in 8 bits none "
                     "does")


def beyond_16_bits():
    k = 131200
    yield of_size(k, "vertex_star", star_cuts(k), "star-of-131200")
    yield box_case("heap-of-66792", (22, 23, 22), [SHATTERS[0]])


HERE = "built here"
FAMILIES = [
    Family("48-large-rings", "edges with rings of 64 to 10 000 tetrahedra", HERE, rings, slow=True),
    Family("49-large-stars", "vertices with stars of 64 to 10 000 tetrahedra", HERE, stars,
           slow=True),
    Family("50-beyond-16-bits", "a star, a ring and components that 16 bits cannot count", HERE,
           beyond_16_bits, slow=True),
]
