# SPDX-License-Identifier: MIT
"""Larger bodies with one thing wrong: refused, or taken with a warning or a note."""

import shapes
from case import Case
from family import Family
from operations import SHATTERS, fan, mixture, plane, split
from twin import Glued


def box(seed, *cells):
    return shapes.jittered(shapes.kuhn_box(*cells), 100, seed)


def mirrored(body):
    points, tets = body
    return points, [(b, a, c, d) for a, b, c, d in tets]


def refused():
    points, tets = box(1, 2, 2, 1)
    face = next(f for f, sides in Glued(tets).sides.items() if len(sides) == 2)
    yield Case("third-on-an-inner-face", (points + [(3, 3, 3)], tets + [(*face, len(points))]))
    yield Case("every-tetrahedron-twice", (points, tets + tets))
    yield Case("every-tetrahedron-mirrored-too", (points, tets + mirrored((points, tets))[1]))
    yield Case("one-of-two-twisted",
               shapes.side_by_side(shapes.joined_ring(4, twisted=True), (points, tets)))
    a, b, c, _ = tets[10]
    yield Case("repeated-point-inside", (points, tets[:10] + [(a, b, c, c)] + tets[11:]))
    yield Case("last-row-out-of-range", (points[:-1], tets))


def taken():
    points, tets = shapes.kuhn_box(2, 2, 2)
    moved = list(points)
    moved[13] = (2.5, 2.75, 2.25)
    yield Case("folded", (moved, tets), mixture((moved, tets), 2) + [SHATTERS[2]],
               shows="the middle point lies outside: volumes disagree, orbits do not care")
    yield Case("all-inverted", mirrored((points, tets)), mixture((points, tets), 3) + [SHATTERS[1]])
    two = shapes.side_by_side(box(4, 2, 1, 1), mirrored(box(5, 1, 1, 2)))
    yield Case("one-of-two-inverted", two, mixture(two, 4) + [SHATTERS[0]])
    rise = {p: len(points) + n for n, p in enumerate(range(9, 18))}
    upper = [tuple(rise.get(p, p) for p in t) for t in tets[24:]]
    halves = points + [points[p] for p in rise], tets[:24] + upper
    yield Case("cracked", halves, [plane((0, 0, 1), 1), *mixture(halves, 5), SHATTERS[0]],
               page={"built": {"chi": 2, "sheets": 2}},
               shows="points in one place are not one point: two bodies lie against each other")
    spread = [points[p // 2] if p % 2 else (9, 9, p) for p in range(54)]
    odd = [tuple(2 * p + 1 for p in t) for t in tets]
    yield Case("unused-points-between", (spread, odd), [split(3, 9, 29), fan(27, 1, 1, 1),
                                                        plane((1, 0, 0), 0.5), SHATTERS[1]])
    flat = [(x, y, 0) for x, y, _ in points]
    yield Case("all-flat", (flat, tets), [plane((1, 0, 0), 1), fan(13, 0, 0, 1), SHATTERS[2]],
               page={"built": {"betti": (1, 0, 0)}})
    yield Case("all-in-one-place", ([(1, 2, 3)] * 27, tets), [fan(13, 1, 0, 0), SHATTERS[0]],
               page={"built": {"betti": (1, 0, 0)}})


FAMILIES = [
    Family("42-refused-bodies", "one defect in a sound body is found", "topology/mesh/check.hpp",
           refused),
    Family("43-doubtful-bodies", "what is no matter of topology does not change the answers",
           "topology/mesh/check.hpp", taken),
]
