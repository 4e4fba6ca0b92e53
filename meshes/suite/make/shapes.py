# SPDX-License-Identifier: MIT
"""Generators of bodies: (points, tetrahedra), positive volumes unless said otherwise."""

import math
from fractions import Fraction
from itertools import permutations

from findings import exact_volume


class Random:
    """The generator of seeded shatters: the same numbers everywhere."""

    def __init__(self, seed):
        self.state = seed

    def below(self, end):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2 ** 64
        return (self.state >> 33) % end

    def shuffle(self, items):
        for i in range(len(items) - 1, 0, -1):
            j = self.below(i + 1)
            items[i], items[j] = items[j], items[i]


def oriented(points, tets):
    """Exchanges the last two corners where the volume is negative."""
    return [tuple(t) if exact_volume(points, t) >= 0 else (t[0], t[1], t[3], t[2]) for t in tets]


def grid_point(cells, i, j, k):
    return (k * (cells[1] + 1) + j) * (cells[0] + 1) + i


def kuhn_cubes(cells, keep=lambda i, j, k: True):
    """The cubes that are kept, x fastest, each in its 6 monotone paths in lexicographic order of
    the axes. Points that no cube needs are left out."""
    nx, ny, nz = cells
    points = [(i, j, k) for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    tets = []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                for path in permutations(range(3)) if keep(i, j, k) else ():
                    at, tet = [i, j, k], [grid_point(cells, i, j, k)]
                    for axis in path:
                        at[axis] += 1
                        tet.append(grid_point(cells, *at))
                    if path in ((0, 2, 1), (1, 0, 2), (2, 1, 0)):  # the odd ones: det < 0
                        tet[2], tet[3] = tet[3], tet[2]
                    tets.append(tuple(tet))
    return drop_unused(points, tets)


def drop_unused(points, tets):
    row = {p: n for n, p in enumerate(sorted({p for t in tets for p in t}))}
    return [points[p] for p in row], [tuple(row[p] for p in t) for t in tets]


def kuhn_box(nx, ny, nz):
    return kuhn_cubes((nx, ny, nz))


def ring(nx, ny, nz=1):
    return kuhn_cubes((nx, ny, nz), lambda i, j, k: i in (0, nx - 1) or j in (0, ny - 1))


def shell(nx, ny, nz):
    return kuhn_cubes((nx, ny, nz), lambda i, j, k: i in (0, nx - 1) or j in (0, ny - 1)
                      or k in (0, nz - 1))


def crossing_channels():
    return kuhn_cubes((3, 3, 3), lambda i, j, k: k != 1 or (i != 1 and j != 1))


def on_circle(turn, radius, z):
    """Rounded to 1e-6 m, so that every machine's cosine gives the same."""
    angle = 2 * math.pi * turn
    return (round(radius * math.cos(angle), 6) + 0.0, round(radius * math.sin(angle), 6) + 0.0, z)


def fan(k, rim, span):
    """k tetrahedra round the edge 0-1; rim points 2, 3, ..."""
    points = [(0, 0, -1), (0, 0, 1)] + [on_circle(span * i / k, 1, 0) for i in range(rim)]
    return points, oriented(points, [(0, 1, 2 + i, 2 + (i + 1) % rim) for i in range(k)])


def closed_fan(k):
    return fan(k, k, 1.0)


def open_fan(k):
    return fan(k, k + 1, 0.75)


def rim(k):
    """The k points with whole x and y of the square |x| + |y| = k / 4, from (k / 4, 0) over
    (0, k / 4)."""
    side = k // 4
    assert k == 4 * side > 0
    corner = [(side - i, i, 0) for i in range(side)]
    return [turned for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))
            for turned in ((x * a - y * b, y * a + x * b, 0) for a, b, _ in corner)]


def edge_ring(k):
    """k tetrahedra round the edge 0-1; rim points 2, 3, ... Whole numbers at any size."""
    points = [(0, 0, -k // 4), (0, 0, k // 4)] + rim(k)
    return points, [(0, 1, 2 + i, 2 + (i + 1) % k) for i in range(k)]


def vertex_star(k):
    """k tetrahedra round the point 0: from each edge of the rim (points 3, 4, ...) one to the pole
    above (point 2), then from each one to the pole below (point 1)."""
    half = k // 2
    points = [(0, 0, 0), (0, 0, -half // 4), (0, 0, half // 4)] + rim(half)
    edges = [(3 + i, 3 + (i + 1) % half) for i in range(half)]
    return points, [(0, 2, a, b) for a, b in edges] + [(0, 1, b, a) for a, b in edges]


def octahedron_star():
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    tets = [(0, 1 + i, 1 + (i + 1) % 4, pole) for pole in (5, 6) for i in range(4)]
    return points, oriented(points, tets)


def one_tetrahedron():
    return [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1, 2, 3)]


def two_tetrahedra():
    points, tets = one_tetrahedron()
    return points + [(0, 0, -1)], tets + [(1, 0, 2, 4)]


def two_sharing_an_edge():
    points, tets = one_tetrahedron()
    points = points + [(0, -1, 0), (0, 0, -1)]
    return points, oriented(points, tets + [(0, 1, 4, 5)])


def two_sharing_a_vertex():
    points, tets = one_tetrahedron()
    points = points + [(-1, 0, 0), (0, -1, 0), (0, 0, -1)]
    return points, oriented(points, tets + [(0, 4, 5, 6)])


def bent_bar(k, joined):
    """A bar of k x 1 x 1 cubes bent into a full turn; `joined` sends (y, z) of the far end to a
    (y, z) of the near end."""
    points, tets = kuhn_box(k, 1, 1)
    points = [on_circle(x / k, 2 - y, z) for x, y, z in points]
    tets = oriented(points, tets)
    target = {grid_point((k, 1, 1), k, *far): grid_point((k, 1, 1), 0, *near)
              for far, near in joined.items()}
    return drop_unused(points, [tuple(target.get(p, p) for p in t) for t in tets])


def joined_ring(k, twisted=False):
    """The ends of a bent bar joined whole; twisted: (k, y, z) ~ (0, z, y), not orientable, and the
    volumes at the seam mean nothing."""
    ends = [(y, z) for y in (0, 1) for z in (0, 1)]
    return bent_bar(k, {(y, z): (z, y) if twisted else (y, z) for y, z in ends})


def simplex_boundary():
    points = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (1, 1, 1)]
    return points, oriented(points, [tuple(p for p in range(5) if p != q) for q in range(5)])


def side_by_side(a, b):
    """Two bodies in one mesh, b beyond a in x."""
    gap = max(p[0] for p in a[0]) - min(p[0] for p in b[0]) + 1
    points = list(a[0]) + [(p[0] + gap, p[1], p[2]) for p in b[0]]
    return points, list(a[1]) + [tuple(p + len(a[0]) for p in t) for t in b[1]]


def jittered(body, amplitude, seed):
    """Moves each point along each axis by a multiple of 1/1024 m, at most `amplitude` of them."""
    random = Random(seed)
    points = [tuple(x + (random.below(2 * amplitude + 1) - amplitude) / 1024 for x in p)
              for p in body[0]]
    return points, body[1]


def shuffled(body, seed):
    """The same body with points, tetrahedra and (evenly) corners in another order."""
    random, (points, tets) = Random(seed), body
    place, order = list(range(len(points))), list(range(len(tets)))
    random.shuffle(place)
    random.shuffle(order)
    new_points = [None] * len(points)
    for p, q in enumerate(place):
        new_points[q] = points[p]
    new_tets = []
    for t in order:
        a, b, c, d = (place[p] for p in tets[t])
        a, b, c, d = random_pick(random, ((a, b, c, d), (b, a, d, c), (c, d, a, b), (d, c, b, a)))
        new_tets.append(random_pick(random, ((a, b, c, d), (a, c, d, b), (a, d, b, c))))
    return new_points, new_tets


def random_pick(random, items):
    return items[random.below(len(items))]


def centroid(points, tet):
    return [sum(Fraction(points[p][i]) for p in tet) / 4 for i in range(3)]
