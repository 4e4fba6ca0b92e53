# SPDX-License-Identifier: MIT
"""Short names for operations, and sequences of them that suit any body."""

import shapes
from case import Case
from twin import Glued

BALL = (1, 0, 0)
SHATTERS = ({"shatter": "rising"}, {"shatter": "falling"}, {"shatter": {"seed": 1}})


def split(*face):
    return {"split": list(face)}


def split_side(tetrahedron, opposite):
    return {"split": {"tetrahedron": tetrahedron, "opposite": opposite}}


def glue(*face):
    return {"glue": list(face)}


def fan(point, *normal, tetrahedron=None):
    at = {} if tetrahedron is None else {"tetrahedron": tetrahedron}
    return {"fan": at | {"point": point, "normal": list(normal)}}


def plane(normal, offset):
    return {"plane": {"normal": list(normal), "offset": offset}}


def breaks(*points, crack=0):
    """Breaks of these points, one after the other."""
    return [{"break": {"point": point, "crack": crack}} for point in points]


def shatters(name, body, **more):
    """Three cases: all faces in the three orders."""
    return [Case(f"{name}-{order}", body, [operation], **more)
            for order, operation in zip(("rising", "falling", "seeded"), SHATTERS)]


def mixture(body, seed, rounds=2):
    """Fans in the middle and at the surface, single faces, a plane and gluing back, as a seed has
    it; normals are such that no centre is near a plane without lying on it."""
    random, (points, tets) = shapes.Random(seed), body
    glued = Glued(tets)
    interior = [face for face, sides in glued.sides.items() if len(sides) == 2]
    random.shuffle(interior)
    used = sorted(glued.around)
    operations = []
    for n in range(rounds):
        faces = interior[3 * n:3 * n + 3]
        operations += [split(*face) for face in faces]
        operations += [fan(used[random.below(len(used))], *normal(random)) for _ in range(2)]
        operations += [glue(*face) for face in faces[1:]]
    operations.append(plane(normal(random), offset(random, points)))
    return operations


def normal(random):
    """Half of them along an axis or a diagonal, so that centres lie exactly on the plane."""
    reach = 1 if random.below(2) else 9
    while True:
        n = [random.below(2 * reach + 1) - reach for _ in range(3)]
        if any(n):
            return n


def offset(random, points):
    """Of a plane near the middle: quarters."""
    middle = sum(p[0] for p in points) / len(points)
    return round(4 * middle) / 4 + random.below(9) / 4 - 1


def rich(name, body, seed, **more):
    """A mixture, then all that is left; and the three shatters of the intact body."""
    yield Case(f"{name}-mixture", body, mixture(body, seed) + [{"shatter": {"seed": seed}}], **more)
    yield from shatters(f"{name}-shatter", body, **more)
