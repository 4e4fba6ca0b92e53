# SPDX-License-Identifier: MIT
"""A box of cubes with a hole drilled along a knot (Furch 1924, Bing 1964)."""

from shapes import kuhn_cubes

# A trefoil with its ends outside, on a grid of 4 x 3 x 2; the shortest there, found by trying all.
ARC = ("110 111 101 201 301 311 321 221 121 021 011 001 000 100 200 210 211").split()
CELLS = (9, 7, 5)


def hole(through):
    """Cubes from the top of the box along the arc to its floor; the floor's own cube only when
    the hole goes through."""
    corners = [tuple(2 * int(x) + 1 for x in at) for at in ARC]
    cubes = {corners[0], (*corners[-1][:2], CELLS[2] - 1)}
    for a, b in zip(corners, corners[1:]):
        cubes |= {b, tuple((x + y) // 2 for x, y in zip(a, b))}
    if through:
        cubes.add((*corners[0][:2], 0))
    return cubes


def drilled(through):
    cubes = hole(through)
    return kuhn_cubes(CELLS, lambda *at: at not in cubes)


def closed_arc():
    """The arc, closed far outside: up, round, and back from below."""
    inner = [tuple(map(float, at)) for at in ARC]
    (x, y, _), (u, v, _) = inner[-1], inner[0]
    return inner + [(x, y, 9.0), (20.0, y + 0.3, 9.0), (20.0, v - 0.4, -9.0), (u, v, -9.0)]


def crossings(polygon):
    """Seen from above, a little aslant: for each segment its crossings in their order, as
    (number of the crossing, whether it goes over)."""
    seen = [(x + 0.0137 * z + 0.00231 * y, y + 0.00913 * z - 0.00171 * x, z)
            for x, y, z in polygon]
    sides = list(zip(seen, seen[1:] + seen[:1]))
    on, count = [[] for _ in sides], 0
    for i, (a, b) in enumerate(sides):
        for j, (c, d) in list(enumerate(sides))[i + 2:]:
            r, s = (b[0] - a[0], b[1] - a[1]), (d[0] - c[0], d[1] - c[1])
            across = r[0] * s[1] - r[1] * s[0]
            if across == 0 or (i, j) == (0, len(sides) - 1):
                continue
            t = ((c[0] - a[0]) * s[1] - (c[1] - a[1]) * s[0]) / across
            u = ((c[0] - a[0]) * r[1] - (c[1] - a[1]) * r[0]) / across
            if not (0 < t < 1 and 0 < u < 1):
                continue
            above = a[2] + t * (b[2] - a[2]) > c[2] + u * (d[2] - c[2])
            on[i].append((t, count, above))
            on[j].append((u, count, not above))
            count += 1
    return [(number, over) for items in on for _, number, over in sorted(items)], count


def is_three_colourable():
    """Whether strands can have three colours, not all one, so that at each crossing all are alike
    or all differ (2 over = under + under modulo 3): no unknotted arc can (Fox)."""
    passes, count = crossings(closed_arc())
    rows, strand = [[0] * count for _ in range(count)], 0
    for number, over in passes:
        if over:
            rows[number][strand % count] += 2
        else:
            rows[number][strand % count] -= 1
            strand += 1
            rows[number][strand % count] -= 1
    rank = 0
    for column in range(count):
        pivot = next((r for r in rows[rank:] if r[column] % 3), None)
        if pivot is None:
            continue
        rows.remove(pivot)
        rows.insert(rank, pivot)
        for n, row in enumerate(rows):
            if n != rank and row[column] % 3:
                factor = row[column] * pivot[column]
                rows[n] = [(x - factor * y) % 3 for x, y in zip(row, pivot)]
        rank += 1
    return count - rank > 1
