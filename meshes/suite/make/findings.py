# SPDX-License-Identifier: MIT
"""Which findings a body must show, worked out from their definitions in topology/mesh/check.hpp with
exact numbers; whether one of them is an error that refuses the body."""

from collections import Counter
from fractions import Fraction

from twin import EDGES, Glued, UnionFind

ERRORS = {"empty_mesh", "no_tetrahedron", "index_out_of_range", "repeated_vertex",
          "duplicate_tetrahedron", "mirrored_tetrahedron", "overfull_face", "non_orientable"}
ROUNDING = 18 * 2.0 ** -52


def exact_volume(points, tet):
    """Six times the signed volume, exact."""
    o, *rest = ([Fraction(x) for x in points[p]] for p in tet)
    (a, b, c), (d, e, f), (g, h, i) = ([x - y for x, y in zip(p, o)] for p in rest)
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def volume_sign(points, tet):
    """0 where the volume is 0 to rounding. No body of the suite is near the limit of that."""
    volume = exact_volume(points, tet)
    if volume == 0:
        return 0
    coordinates = [points[p] for p in tet]
    largest = max(abs(x) for p in coordinates for x in p)
    length = max(abs(x - y) for p in coordinates[1:] for x, y in zip(p, coordinates[0]))
    limit = ROUNDING * max(largest, length) * length ** 2
    assert abs(volume) < limit / 4 or abs(volume) > 4 * limit, f"{tet}: volume near rounding"
    return 0 if abs(volume) < limit else 1 if volume > 0 else -1


def usable_tetrahedra(points, tets):
    """Codes of those that are not, and those that are."""
    codes, usable, first = set(), [], {}
    for t, tet in enumerate(tets):
        if any(not 0 <= p < len(points) for p in tet):
            codes.add("index_out_of_range")
        if len(set(tet)) < 4:
            codes.add("repeated_vertex")
        if len(set(tet)) < 4 or any(not 0 <= p < len(points) for p in tet):
            continue
        if volume_sign(points, tet) == 0:
            codes.add("flat_tetrahedron")
        inversions = sum(1 for i, j in EDGES if tet[i] > tet[j]) % 2
        earlier = first.get(key := tuple(sorted(tet)))
        if earlier is None:
            first[key] = inversions
            usable.append(t)
        else:
            codes.add("duplicate_tetrahedron" if inversions == earlier else "mirrored_tetrahedron")
    return codes, usable


def orientation_codes(points, tets, glued):
    """Signs that orient neighbours alike, then the majority of volumes decides which is up."""
    if not glued.orientable():
        return {"non_orientable"}
    sets = UnionFind(2 * len(tets))
    for h, across in enumerate(glued.other):
        if across > h:
            same = glued.place_sign(h) != glued.place_sign(across)
            for sign in (0, 1):
                sets.join(2 * (h // 4) + sign, 2 * (across // 4) + (sign if same else 1 - sign))
    members = {}
    for t, tet in enumerate(tets):
        roots = sets.root(2 * t), sets.root(2 * t + 1)
        # Sign of the file's order of corners, in the orientation that the lower root stands for.
        odd = sum(1 for i, j in EDGES if tet[i] > tet[j]) % 2
        side = (roots[0] < roots[1]) != bool(odd)
        members.setdefault(min(roots), []).append((t, side, volume_sign(points, tet)))
    codes = set()
    for group in members.values():
        votes = [(t, side == (sign > 0)) for t, side, sign in group if sign]
        yes = sum(1 for _, vote in votes if vote)
        if 2 * yes != len(votes):
            up = 2 * yes > len(votes)
        else:
            up = min(votes)[1] if votes else group[0][1]
        for _, side, sign in group:
            flipped = side != up
            codes |= {"inverted_tetrahedron"} if flipped else set()
            codes |= {"folded_tetrahedron"} if sign and (sign < 0) != flipped else set()
    return codes


def pinch_codes(glued):
    corners, edges = glued.orbits()
    vertices = {(corners.root(4 * t + i), p) for t, tet in enumerate(glued.tets)
                for i, p in enumerate(tet)}
    pairs = {(edges.root(6 * t + e), tuple(sorted((tet[i], tet[j]))))
             for t, tet in enumerate(glued.tets) for e, (i, j) in enumerate(EDGES)}
    codes = set()
    for code, orbits in (("pinched_vertex", vertices), ("pinched_edge", pairs)):
        if max(Counter(cell for _, cell in orbits).values(), default=0) > 1:
            codes.add(code)
    return codes


def findings(points, tets):
    """Sorted codes, and whether the body is refused."""
    if not tets:
        codes = {"no_tetrahedron", "unused_point"} if points else {"empty_mesh"}
        if len({tuple(p) for p in points}) < len(points):
            codes.add("coincident_points")
        return sorted(codes), True
    codes, usable = usable_tetrahedra(points, tets)
    kept = [tuple(tets[t]) for t in usable]
    glued = Glued(kept, at_most=len(tets))
    for sides in glued.sides.values():
        if len(sides) > 2:
            codes.add("overfull_face")
            glued.other[sides[0]] = glued.other[sides[1]] = -1  # none of them is sewn
    codes |= orientation_codes(points, kept, glued) | pinch_codes(glued)
    if set(range(len(points))) - {p for t in tets for p in t}:
        codes.add("unused_point")
    if len({tuple(0.0 + x for x in p) for p in points}) < len(points):
        codes.add("coincident_points")
    return sorted(codes), bool(codes & ERRORS)
