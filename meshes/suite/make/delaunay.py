# SPDX-License-Identifier: MIT
"""Delaunay tetrahedra of random points, in whole numbers: Bowyer and Watson's insertion."""

from shapes import Random, drop_unused

SIZE = 1024
FAR = 10 ** 9  # corners of the tetrahedron that holds everything


def determinant(rows):
    """By the first column; whole numbers stay exact."""
    if len(rows) == 1:
        return rows[0][0]
    return sum((-1) ** n * row[0] * determinant([r[1:] for m, r in enumerate(rows) if m != n])
               for n, row in enumerate(rows) if row[0])


def volume(points, tet):
    o, *rest = (points[p] for p in tet)
    return determinant([[x - y for x, y in zip(p, o)] for p in rest])


def sphere(points, tet):
    """Coefficients c with c . (x, y, z, x^2 + y^2 + z^2, 1) > 0 inside the sphere of a positive
    tetrahedron."""
    lifted = [[*points[p], sum(x * x for x in points[p]), 1] for p in tet]
    return [-(-1) ** n * determinant([row[:n] + row[n + 1:] for row in lifted]) for n in range(5)]


def insert(points, tets, new):
    """`tets`: positive tetrahedra and their spheres. Those whose sphere holds the new point make
    way for the cone over their outline."""
    x = points[new]
    lifted = [*x, sum(a * a for a in x), 1]
    hit, outline = [], set()
    for tet, coefficients in tets.items():
        side = sum(a * b for a, b in zip(coefficients, lifted))
        assert side != 0, "five points on a sphere"
        if side > 0:
            hit.append(tet)
    for a, b, c, d in hit:
        del tets[a, b, c, d]
        for face in ((b, d, c), (a, c, d), (a, d, b), (a, b, c)):  # seen from inside
            i = face.index(min(face))
            face = face[i:] + face[:i]
            back = (face[0], face[2], face[1])
            outline ^= {face} if back not in outline else {back}
    for a, b, c in outline:
        tet = (a, b, c, new) if volume(points, (a, b, c, new)) > 0 else (a, c, b, new)
        assert volume(points, tet) > 0
        tets[tet] = sphere(points, tet)


def cloud(count, seed):
    """Points in a cube of 1 m, steps of 1/1024."""
    random = Random(seed)
    points = [tuple(random.below(SIZE) for _ in range(3)) for _ in range(count)]
    corners = [(-FAR, -FAR, -FAR), (4 * FAR, -FAR + 3, -FAR + 7),
               (-FAR + 5, 4 * FAR, -FAR + 11), (-FAR + 2, -FAR + 13, 4 * FAR)]
    every = points + corners
    outer = tuple(range(count, count + 4))
    assert volume(every, outer) > 0
    tets = {outer: sphere(every, outer)}
    for new in range(count):
        insert(every, tets, new)
    kept = sorted(t for t in tets if max(t) < count)
    return drop_unused([tuple(x / SIZE for x in p) for p in points], kept)
