# SPDX-License-Identifier: MIT
"""Balls that cannot be taken apart tetrahedron by tetrahedron, and balls with a knotted hole."""

import complexes
import knots
from case import Case
from complexes import closure, facets, placed
from family import Family
from operations import fan, mixture, plane, rich, split_side
from twin import Glued


def boundary_faces(tets):
    """Of a face-connected complex: all faces of its boundary, as sets of points."""
    glued = Glued(tets)
    return closure([face for face, sides in glued.sides.items() if len(sides) == 1])


def removable(tets, number):
    """Whether a ball less this tetrahedron is a ball: it meets the boundary in whole faces, 1 to 3
    of them, and in nothing else."""
    boundary = boundary_faces(tets)
    own = closure([tets[number]]) - {frozenset(tets[number])}
    whole = {f for f in own if len(f) == 3 and f in boundary}
    return 1 <= len(whole) <= 3 and own & boundary == closure(whole)


def f_vector(tets):
    faces = closure(tets)
    return tuple(sum(1 for f in faces if len(f) == k) for k in (1, 2, 3, 4))


def taken_off(tets, number):
    """Splits the faces that hold a tetrahedron."""
    glued = Glued(tets)
    return [split_side(number, tets[number][p]) for p in range(4)
            if glued.other[4 * number + p] >= 0]


def unshellable(tets, seed):
    assert not any(removable(tets, n) for n in range(len(tets)))
    ball = {"built": {"betti": (1, 0, 0), "chi": 1, "sheets": 1}}
    body = placed(tets, seed)
    yield from rich("ball", body, seed, page=ball)
    published = (body[0], tets)
    yield Case("corners-as-published", published, mixture(body, seed + 1, 1),
               shows="corners in rising order: half of the tetrahedra are inverted")
    glued = Glued(tets)
    at_surface = [n for n in range(len(tets)) if min(glued.other[4 * n:4 * n + 4]) < 0]
    for n in at_surface[:4]:
        yield Case(f"without-tetrahedron-{n}", body, taken_off(body[1], n),
                   shows="no tetrahedron can be taken off so that a ball is left")


def ziegler():
    tets = facets(complexes.ZIEGLER_BALL)
    assert f_vector(tets) == (10, 38, 50, 21)
    yield from unshellable(tets, 25)


def rudin():
    tets = facets(complexes.RUDIN_BALL)
    assert f_vector(tets) == (14, 66, 94, 41)
    yield from unshellable(tets, 26)


def furch():
    assert knots.is_three_colourable()
    ball, exterior = knots.drilled(False), knots.drilled(True)
    end = next(n for n, p in enumerate(ball[0]) if p == (4, 4, 1))
    cuts = [fan(end, 0, 0, 1), plane((0, 0, 1), 1), plane((1, 0, 0), 4.5),
            {"shatter": {"seed": 27}}]
    yield Case("knotted-hole", ball, cuts,
               page={"built": {"betti": (1, 0, 0), "chi": 1, "sheets": 1}},
               shows="the hole ends one cube above the floor: a ball, with an arc of one edge "
                     "across it that is knotted")
    yield Case("knot-exterior", exterior, cuts[1:],
               page={"built": {"betti": (1, 1, 0), "chi": 0, "sheets": 1}},
               shows="drilled through: the outside of a trefoil, one handle")


FAMILIES = [
    Family("25-ziegler-ball", "the smallest known ball that cannot be shelled",
           "G. M. Ziegler, Shelling polyhedral 3-balls and 4-polytopes, Discrete Comput. Geom. 19 "
           "(1998); tried here with each", ziegler),
    Family("26-rudin-ball", "a subdivided tetrahedron that cannot be shelled",
           "M. E. Rudin, An unshellable triangulation of a tetrahedron, Bull. Amer. Math. Soc. 64 "
           "(1958); tried here with each", rudin),
    Family("27-furch-ball", "a hole along a trefoil", "R. Furch, Zur Grundlegung der "
           "kombinatorischen Topologie, Abh. Math. Sem. Hamburg 3 (1924)", furch, slow=True),
]
