# SPDX-License-Identifier: MIT
"""Abstract triangulations: lists of four points each, from the literature or built here.

They have no natural place in space: `placed` puts their points somewhere and orients neighbours
alike, so that volumes disagree (folded tetrahedra) but topology does not.
"""

from itertools import combinations, permutations

from shapes import Random
from twin import EDGES, Glued
from findings import exact_volume

# M. E. Rudin, "An unshellable triangulation of a tetrahedron", Bull. Amer. Math. Soc. 64 (1958).
RUDIN_BALL = """
1 2 5 9, 1 2 5 10, 1 5 10 11, 1 7 10 11, 1 5 11 13, 1 7 11 13, 2 3 6 10, 2 3 6 11, 2 6 11 12,
2 8 11 12, 2 6 12 14, 2 8 12 14, 3 4 7 11, 3 4 7 12, 3 5 9 12, 3 7 9 12, 3 5 9 13, 3 7 9 13,
1 4 8 9, 4 6 9 10, 4 8 9 10, 1 4 8 12, 4 6 10 14, 4 8 10 14, 2 5 9 10, 2 6 9 10, 5 9 10 11,
9 10 11 12, 5 9 11 13, 3 6 10 11, 3 7 10 11, 6 10 11 12, 6 10 12 14, 4 7 11 12, 4 8 11 12,
7 9 11 12, 7 9 11 13, 1 5 9 12, 1 8 9 12, 8 9 10 12, 8 10 12 14"""
# G. M. Ziegler, "Shelling polyhedral 3-balls and 4-polytopes", Discrete Comput. Geom. 19 (1998).
ZIEGLER_BALL = """
1 2 3 4, 1 2 5 6, 1 5 6 9, 0 2 5 6, 3 6 7 8, 4 5 7 8, 2 3 6 7, 1 2 6 9, 0 2 6 7, 2 3 4 8, 1 3 4 7,
3 4 7 8, 1 2 4 9, 0 2 3 7, 2 3 6 8, 1 4 5 7, 1 4 5 8, 1 4 8 9, 0 1 2 3, 1 5 8 9, 0 1 2 5"""
# A. Bjorner, F. H. Lutz, "Simplicial manifolds, bistellar flips and a 16-vertex triangulation of
# the Poincare homology 3-sphere", Experiment. Math. 9 (2000).
POINCARE_SPHERE = """
1 2 4 9, 1 2 4 15, 1 2 6 14, 1 2 6 15, 1 2 9 14, 1 3 4 12, 1 3 4 15, 1 3 7 10, 1 3 7 12, 1 3 10 15,
1 4 9 12, 1 5 6 13, 1 5 6 14, 1 5 8 11, 1 5 8 13, 1 5 11 14, 1 6 13 15, 1 7 8 10, 1 7 8 11,
1 7 11 12, 1 8 10 13, 1 9 11 12, 1 9 11 14, 1 10 13 15, 2 3 5 10, 2 3 5 11, 2 3 7 10, 2 3 7 13,
2 3 11 13, 2 4 9 13, 2 4 11 13, 2 4 11 15, 2 5 8 11, 2 5 8 12, 2 5 10 12, 2 6 10 12, 2 6 10 14,
2 6 12 15, 2 7 9 13, 2 7 9 14, 2 7 10 14, 2 8 11 15, 2 8 12 15, 3 4 5 14, 3 4 5 15, 3 4 12 14,
3 5 10 15, 3 5 11 14, 3 7 12 13, 3 11 13 14, 3 12 13 14, 4 5 6 7, 4 5 6 14, 4 5 7 15, 4 6 7 11,
4 6 10 11, 4 6 10 14, 4 7 11 15, 4 8 9 12, 4 8 9 13, 4 8 10 13, 4 8 10 14, 4 8 12 14, 4 10 11 13,
5 6 7 13, 5 7 9 13, 5 7 9 15, 5 8 9 12, 5 8 9 13, 5 9 10 12, 5 9 10 15, 6 7 11 12, 6 7 12 13,
6 10 11 12, 6 12 13 15, 7 8 10 14, 7 8 11 15, 7 8 14 15, 7 9 14 15, 8 12 14 15, 9 10 11 12,
9 10 11 16, 9 10 15 16, 9 11 14 16, 9 14 15 16, 10 11 13 16, 10 13 15 16, 11 13 14 16, 12 13 14 15,
13 14 15 16"""
# D. W. Walkup, "The lower bound conjecture for 3- and 4-manifolds", Acta Math. 125 (1970).
PROJECTIVE_SPACE = """
1 2 3 7, 1 4 7 9, 2 3 4 8, 2 5 8 10, 3 6 7 10, 1 2 3 11, 1 4 7 10, 2 3 4 11, 2 5 9 10, 3 6 8 9,
1 2 6 9, 1 4 8 9, 2 3 7 8, 2 6 9 10, 3 6 9 10, 1 2 6 11, 1 4 8 10, 2 4 6 10, 3 4 5 9, 4 5 6 7,
1 2 7 9, 1 5 6 8, 2 4 6 11, 3 4 5 11, 4 5 6 11, 1 3 5 10, 1 5 6 11, 2 4 8 10, 3 4 8 9, 4 5 7 9,
1 3 5 11, 1 5 8 10, 2 5 7 8, 3 5 9 10, 4 6 7 10, 1 3 7 10, 1 6 8 9, 2 5 7 9, 3 6 7 8, 5 6 7 8"""


def facets(text):
    """From a list in text, points counted from 0 and each rising."""
    lists = [sorted(map(int, item.split())) for item in text.replace("\n", " ").split(",")]
    lowest = min(min(item) for item in lists)
    return [tuple(p - lowest for p in item) for item in lists]


def renamed(simplices):
    """Points (of any kind) as numbers from 0, in their order."""
    row = {p: n for n, p in enumerate(sorted({p for s in simplices for p in s}))}
    return sorted(tuple(sorted(row[p] for p in s)) for s in simplices)


def circle_times_sphere(twisted=False):
    """S1 x S2: three copies of the boundary of a tetrahedron in a ring, each prism between two
    cut in three along the order of its points; twisted: the ring closes with a reflection."""
    turn = (1, 0, 2, 3) if twisted else range(4)
    tets = []
    for third in range(3):
        near = [(third, n) for n in range(4)]
        far = [(third + 1, n) if third < 2 else (0, turn[n]) for n in range(4)]
        for a, b, c in combinations(range(4), 3):
            tets += [(near[a], near[b], near[c], far[c]), (near[a], near[b], far[b], far[c]),
                     (near[a], far[a], far[b], far[c])]
    return renamed(tets)


def three_torus():
    """3 x 3 x 3 cubes of Kuhn, opposite sides identified."""
    tets = []
    for cube in ((i, j, k) for k in range(3) for j in range(3) for i in range(3)):
        for path in permutations(range(3)):
            at, tet = list(cube), [cube]
            for axis in path:
                at[axis] = at[axis] + 1
                tet.append(tuple(x % 3 for x in at))
            tets.append(tet)
    return renamed(tets)


def lens_space(p, q):
    """The join of two circles of 2 p points is a 3-sphere; a p-th of a turn of the one with q
    p-ths of the other acts on it freely. Its barycentric subdivision modulo that, then edges
    contracted while that changes nothing."""
    n = 2 * p

    def moved(cell, times):
        return frozenset((c, (i + (2 if c == 0 else 2 * q) * times) % n) for c, i in cell)

    def orbit(cell):
        return min(tuple(sorted(moved(cell, times))) for times in range(p))

    tets = set()
    for i in range(n):
        for j in range(n):
            corners = [(0, i), (0, (i + 1) % n), (1, j), (1, (j + 1) % n)]
            for order in permutations(corners):
                tets.add(tuple(orbit(frozenset(order[:k + 1])) for k in range(4)))
    assert len(tets) == 24 * n * n // p
    return contracted(renamed(tets))


def closure(simplices):
    """All faces of all simplices."""
    return {frozenset(face) for s in simplices for k in range(1, len(s) + 1)
            for face in combinations(s, k)}


def contracted(tets):
    """Contracts edges a-b with link(a) n link(b) = link(ab), which keeps the manifold (Dey et al.
    1999), the first such edge each time, until there is none."""
    tets = {frozenset(t) for t in tets}
    while True:
        faces = closure(tets)
        around = {}
        for face in faces:
            for p in face:
                around.setdefault(p, set()).add(face)
        for a, b in sorted(tuple(sorted(f)) for f in faces if len(f) == 2):
            links = [{f - {p} for f in around[p] if len(f) > 1} for p in (a, b)]
            edge = frozenset((a, b))
            if links[0] & links[1] == {f - edge for f in around[a] if edge < f}:
                break
        else:
            return renamed(tets)
        tets = {frozenset(a if p == b else p for p in t) for t in tets if not edge <= t}


def without(tets, number):
    return [t for n, t in enumerate(tets) if n != number]


def placed(tets, seed):
    """Points on a grid of 64 m, no tetrahedron flat; oriented alike as far as possible, most
    volumes positive."""
    random = Random(seed)
    count = 1 + max(p for t in tets for p in t)
    while True:
        points = [tuple(random.below(65) for _ in range(3)) for _ in range(count)]
        volumes = [exact_volume(points, t) for t in tets]
        if all(volumes) and len(set(points)) == count:
            break
    return points, alike(tets, volumes)


def alike(tets, volumes):
    """Each face-connected set oriented from its first tetrahedron."""
    glued, up = Glued(tets), {}
    result = [tuple(t) for t in tets]
    for start in range(len(tets)):
        if start in up:
            continue
        up[start], members = True, [start]
        for t in members:
            for p in range(4):
                across = glued.other[4 * t + p]
                if across >= 0 and across // 4 not in up:
                    same = glued.place_sign(4 * t + p) != glued.place_sign(across)
                    up[across // 4] = up[t] == same
                    members.append(across // 4)
        positive = [up[t] != odd(tets[t]) for t in members]
        agree = sum(1 for t, plus in zip(members, positive) if plus == (volumes[t] > 0))
        for t, plus in zip(members, positive):
            if plus != (2 * agree >= len(members)):
                a, b, c, d = tets[t]
                result[t] = (a, b, d, c)
    return result


def odd(tet):
    return bool(sum(1 for i, j in EDGES if tet[i] > tet[j]) % 2)
