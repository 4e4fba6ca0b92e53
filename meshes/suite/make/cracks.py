# SPDX-License-Identifier: MIT
"""Cracks as labels given beforehand: whatever the order of the breaks, the same map.

Each group of cases has one body, one set of labels and one set of breaks in several orders; what is
expected at the end comes from the union over the breaks, without an order."""

import shapes
from case import Case, break_faces, centroid
from complexes import lens_space, placed
from family import Family
from operations import breaks, fan, glue
from twin import Glued, face_points


def labels(tets, side):
    """A crack by a function of the row of a tetrahedron: above 0 positive, below 0 negative."""
    rows = range(len(tets))
    return {"positive": [t for t in rows if side(t) > 0],
            "negative": [t for t in rows if side(t) < 0]}


def by_plane(body, normal, offset, band=0):
    """Sides of centres; those nearer than `band` have none."""
    points, tets = body

    def side(t):
        value = sum(n * x for n, x in zip(normal, centroid(points, tets[t]))) - offset
        return 0 if abs(value) < band else 1 if value >= 0 else -1
    return labels(tets, side)


def by_chance(tets, seed, none=0):
    """Any side, each for itself; `none` of ten tetrahedra have none."""
    random = shapes.Random(seed)
    drawn = [0 if random.below(10) < none else 2 * random.below(2) - 1 for _ in tets]
    return labels(tets, drawn.__getitem__)


def by_distance(tets, start, rule):
    """By the number of faces on the way from a tetrahedron."""
    glued, far = Glued(tets), {start: 0}
    queue = [start]
    for t in queue:
        for p in range(4):
            u = glued.other[4 * t + p] // 4
            if u >= 0 and u not in far:
                far[u] = far[t] + 1
                queue.append(u)
    return labels(tets, lambda t: rule(far.get(t, 0)))


def met(tets, *cracks):
    """(point, crack) for all points of faces whose sides differ: cracks and points rising."""
    glued = Glued(tets)
    return [(point, k) for k in range(len(cracks)) for point in sorted(glued.around)
            if break_faces(glued, cracks, {"point": point, "crack": k})]


def one_order(name, body, cracks, pairs, **more):
    """The cells at the end by the union over all breaks, the faces split from rising sides."""
    glued = Glued(body[1])
    faces = {h for point, k in pairs
             for h in break_faces(glued, cracks, {"point": point, "crack": k})}
    glued.split_all(sorted(faces))
    counts = glued.counts()
    cells = tuple(counts[k] for k in ("vertices", "edges", "faces", "tetrahedra", "components"))
    last = {"cells": cells, "sheets": counts["boundary_sheets"]}
    operations = [operation for point, k in pairs for operation in breaks(point, crack=k)]
    return Case(name, body, operations, cracks=cracks,
                page={"after": {len(pairs) - 1: last}}, **more)


def orders(name, body, cracks, pairs=None, seeds=(1,), **more):
    """A case an order: rising, falling, shuffled."""
    pairs = met(body[1], *cracks) if pairs is None else list(pairs)
    assert pairs, name
    yield one_order(f"{name}-rising", body, cracks, pairs, **more)
    yield one_order(f"{name}-falling", body, cracks, pairs[::-1], **more)
    for seed in seeds:
        mixed = list(pairs)
        shapes.Random(seed).shuffle(mixed)
        yield one_order(f"{name}-shuffled" + f"-{seed}" * (len(seeds) > 1), body, cracks, mixed,
                        **more)


def one_crack():
    box = shapes.kuhn_box(2, 2, 2)
    through = by_plane(box, (1, 0, 0), 1)
    yield from orders("through", box, [through], seeds=(1, 2),
                      shows="a plane's labels, all their points broken: the box parts")
    points = [p for p, _ in met(box[1], through)]
    yield one_order("through-each-twice", box, [through], [(p, 0) for p in points for _ in "ab"],
                    shows="the second break of a point finds nothing left")
    yield one_order("through-twice-round", box, [through], [(p, 0) for p in points + points[::-1]],
                    shows="all breaks once more, in reverse order: nothing is left")
    tilted = by_plane(box, (1, 2, 3), 6)
    yield from orders("tilted", box, [tilted], shows="a jagged sheet of faces")
    bar = shapes.kuhn_box(3, 2, 1)
    across = by_plane(bar, (1, 0, 0), 2)
    front = [(p, 0) for p, _ in met(bar[1], across) if bar[0][p][1] < 1]
    yield from orders("front", bar, [across], front,
                      shows="broken at half of its points: the crack ends inside the body")
    wide = shapes.kuhn_box(2, 4, 4)
    yield one_order("inside", wide, [by_plane(wide, (1, 0, 0), 1)],
                    [(shapes.grid_point((2, 4, 4), 1, 2, 2), 0)], written={"kuhn_box": [2, 4, 4]},
                    shows="one break deep inside: a disc of faces whose rim stays whole")
    yield one_order("nowhere", box, [through], [(0, 0), (2, 0), (26, 0)],
                    shows="points whose tetrahedra all have one label: empty fans")
    one_side = {"positive": through["positive"], "negative": []}
    yield one_order("one-side-only", box, [one_side], [(p, 0) for p in points],
                    shows="a label beside none is no crack")
    band = by_plane(box, (1, 2, 3), 6, band=0.375)
    yield from orders("undecided", box, [band],
                      shows="tetrahedra without a label between the sides: only faces from one "
                            "label to the other are cut")
    yield Case("glued-between", box, breaks(13, 4) + [glue(*sorted_face(box, through, 13))]
               + breaks(13, 22, 13) + [{"shatter": "falling"}], cracks=[through],
               shows="a face glued again is cut again by the next break of its point")
    yield Case("after-fans", box, [fan(13, 0, 0, 1), fan(12, 1, 1, 0)]
               + breaks(*points), cracks=[through],
               shows="a point that fans have parted is broken at each of its copies")
    other = [tuple(t) if n % 3 else (t[1], t[0], t[2], t[3]) for n, t in enumerate(box[1])]
    yield from orders("inverted", (box[0], other), [tilted],
                      shows="every third tetrahedron turned over in the file")


def sorted_face(body, crack, point):
    """The first face that a break of the point splits, by its points."""
    faces = break_faces(Glued(body[1]), [crack], {"point": point, "crack": 0})
    return face_points(body[1], faces[0])


def crossing():
    box = shapes.kuhn_box(2, 2, 2)
    x, y, z = (by_plane(box, n, 1) for n in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    pairs = met(box[1], x, y)
    yield from orders("two", box, [x, y], seeds=(1, 2),
                      shows="two planes cross: four pieces, whichever goes first")
    by_point = sorted(pairs)
    yield one_order("two-interleaved", box, [x, y], by_point,
                    shows="at each point both cracks, one after the other")
    some = [pair for pair in pairs if pair[0] in (1, 3, 4, 5, 7, 10, 12)]
    yield from orders("two-in-part", box, [x, y], some,
                      shows="broken near one side: fronts of both within the body")
    middle = [(13, k) for k in range(3)]
    yield from orders("three-at-a-point", box, [x, y, z], middle,
                      shows="three cracks break one inner point")
    least = [pair for pair in met(box[1], x, y, z) if pair[0] in (4, 10, 12, 13, 14, 16, 22)]
    yield from orders("three", box, [x, y, z], least,
                      shows="three planes, broken in the middles of the box and of its sides alone: "
                            "eight pieces")
    right = set(x["positive"])
    stopped = labels(box[1], lambda t: 0 if t not in right else 1 if t in set(y["positive"]) else -1)
    yield from orders("stopped", box, [x, stopped],
                      shows="a crack has labels on one side of another alone: it ends there")
    yield from orders("one-on-another", box, [x, {"positive": x["negative"],
                                                  "negative": x["positive"]}],
                      [(p, k) for p in (4, 10, 13, 16, 22) for k in (0, 1)],
                      shows="two cracks with the same faces, sides exchanged: the second finds none")


def at_will():
    star = shapes.octahedron_star()
    turn = by_distance(star[1], 0, lambda far: 1 - 2 * (far % 2))
    yield one_order("eight-copies", star, [turn], [(0, 0)],
                    shows="labels that alternate: one break parts a vertex into eight")
    yield from orders("all-of-a-star", star, [turn], shows="and here into all its tetrahedra")
    round_edge = shapes.closed_fan(8)
    quarters = labels(round_edge[1], lambda t: 1 if t % 4 < 2 else -1)
    yield from orders("four-sectors", round_edge, [quarters],
                      shows="a closed fan in four sectors: four copies of both ends")
    box = shapes.kuhn_box(2, 2, 2)
    cubes = labels(box[1], lambda t: 1 - 2 * ((t // 6 + t // 12 + t // 24) % 2))
    yield from orders("checkerboard", box, [cubes], [(p, 0) for p in (13, 4, 12, 14, 22, 1, 25)],
                      shows="cubes like a board: the middle has eight copies")
    moved = shapes.shuffled(shapes.jittered(box, 100, 45), 46)
    noise = [by_chance(moved[1], seed, none) for seed, none in ((1, 0), (2, 3), (3, 6))]
    some = [pair for n, pair in enumerate(met(moved[1], *noise)) if n % 6 == 0]
    yield from orders("noise", moved, noise, some, seeds=(1, 2),
                      shows="three cracks by chance, tetrahedra without labels, names shuffled")
    inner = next(t for t, tet in enumerate(box[1]) if 13 in tet)
    one = labels(box[1], lambda t: 1 if t == inner else -1)
    yield from orders("one-tetrahedron", box, [one], shows="one tetrahedron against all others")
    ring = shapes.ring(3, 3)
    half = by_plane(ring, (0, 1, 0), 1.5)
    yield from orders("ring", ring, [half], shows="cut across in two places: a handle goes first, "
                      "then the ring parts")
    where = {p for p, _ in met(ring[1], half) if ring[0][p][0] < 1.5}
    yield one_order("ring-opened", ring, [half], [(p, 0) for p in sorted(where)],
                    shows="cut across in one place only: the oracle's false yes")
    shell = shapes.shell(3, 3, 3)
    screw = labels(shell[1], lambda t: screw_side(centroid(shell[0], shell[1][t])))
    some = [pair for n, pair in enumerate(met(shell[1], screw)) if n % 4 == 0]
    yield from orders("shell", shell, [screw], some,
                      shows="round a cavity, along a surface that is no plane")
    sphere = shapes.simplex_boundary()
    yield from orders("closed", sphere, [labels(sphere[1], lambda t: 1 if t < 2 else -1)],
                      shows="a body without a boundary parts into two balls")
    manifold = placed(lens_space(3, 1), 47)
    near = by_distance(manifold[1], 0, lambda far: 1 if far < 3 else -1)
    some = [pair for n, pair in enumerate(met(manifold[1], near)) if n % 2 == 0]
    yield from orders("lens-space", manifold, [near], some,
                      shows="near and far in a closed manifold with torsion")
    for name, joined in (("vertex", {(0, 0): (0, 0)}), ("edge", {(0, 0): (0, 0), (0, 1): (0, 1)})):
        pinched = shapes.bent_bar(6, joined)
        touch = [p for p, tets in sorted(Glued(pinched[1]).around.items())
                 if Glued(pinched[1]).vertex_orbits(p) > 1]
        assert touch
        cracks = [by_chance(pinched[1], 7, 1), by_chance(pinched[1], 8)]
        pairs = [(p, k) for p in touch + [2, 3] for k in (0, 1)]
        yield from orders(f"pinched-{name}", pinched, cracks, pairs,
                          shows="a bar that touches itself: one break, copies that never met")
    two = shapes.side_by_side(shapes.two_tetrahedra(), shapes.open_fan(4))
    yield from orders("two-bodies", two, [labels(two[1], lambda t: 1 - 2 * (t % 2))],
                      shows="one crack through two bodies")


def screw_side(centre):
    x, y, z = (value - 1.5 for value in map(float, centre))
    quarter = (0 if y >= 0 else 3) if x >= 0 else (1 if y >= 0 else 2)
    return 1 if 4 * z >= 2 * quarter - 3 else -1


LABELS = "docs/explanation/cracks.md"
FAMILIES = [
    Family("45-labelled-cracks", "one crack by labels given beforehand: any order of its breaks "
           "leaves the same map", LABELS, one_crack),
    Family("46-crossing-cracks", "labels of several cracks: breaks of all of them in any order",
           LABELS, crossing),
    Family("47-labels-at-will", "labels that are no plane's: sectors, boards, chance, islands, rings, "
           "shells, closed and pinched bodies", LABELS, at_will),
]
