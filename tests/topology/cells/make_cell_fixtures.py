# SPDX-License-Identifier: MIT
"""Writes data/cell_fixtures.json: operations on cells of bodies of meshes/suite, and their results.

    python3 tests/topology/cells/make_cell_fixtures.py > tests/topology/cells/data/cell_fixtures.json

A program of its own: tetrahedra as points, a set of cut triples, union-find over everything, ranks over
GF(2) by elimination, signs of planes in rationals. It reads nothing of Sunder but the bodies.
"""

import itertools
import json
import math
import pathlib
from fractions import Fraction

HERE = pathlib.Path(__file__).resolve().parent
SUITE = HERE.parent.parent.parent / "meshes/suite"


class Classes:
    """Union-find over anything."""

    def __init__(self):
        self.parent = {}

    def find(self, x):
        self.parent.setdefault(x, x)
        while self.parent[x] != x:
            self.parent[x] = self.parent[self.parent[x]]
            x = self.parent[x]
        return x

    def join(self, a, b):
        self.parent[self.find(a)] = self.find(b)


def rank(columns):
    """Of a matrix over GF(2), columns as whole numbers."""
    lowest = {}
    for column in columns:
        while column:
            low = column & -column
            if low not in lowest:
                lowest[low] = column
                break
            column ^= lowest[low]
    return len(lowest)


class Body:
    """Points by name; `cells` as tuples of names; `cut`: triples with two separate sides."""

    def __init__(self, points, cells):
        self.points = dict(enumerate(tuple(map(float, p)) for p in points))
        self.cells = [tuple(c) for c in cells]
        self.cut = set()
        self.names = {}  # of new points, by ends and weight: both sides of a crack have one

    def copy(self):
        other = Body([], [])
        other.points, other.cells, other.cut = dict(self.points), list(self.cells), set(self.cut)
        other.names = dict(self.names)
        return other

    def glue(self):
        """Pairs (cell, face as a triple) that are one face."""
        sides = {}
        for t, cell in enumerate(self.cells):
            for face in itertools.combinations(cell, 3):
                sides.setdefault(frozenset(face), []).append(t)
        return {f: ts for f, ts in sides.items() if len(ts) == 2 and f not in self.cut}, sides

    def classes(self):
        """Union-find over (cell, part of its points): vertices, edges, faces, cells."""
        glued, sides = self.glue()
        c = Classes()
        for t, cell in enumerate(self.cells):
            for n in (1, 2, 3, 4):
                for part in itertools.combinations(cell, n):
                    c.find((t, frozenset(part)))
        for face, (a, b) in glued.items():
            for n in (1, 2, 3):
                for part in itertools.combinations(face, n):
                    c.join((a, frozenset(part)), (b, frozenset(part)))
        return c, glued, sides

    def counts(self):
        c, glued, sides = self.classes()
        of = {n: {} for n in (1, 2, 3, 4)}
        for key in list(c.parent):
            root = c.find(key)
            of[len(key[1])].setdefault(root, len(of[len(key[1])]))
        boundary = {2: [], 3: [], 4: []}
        for n in (2, 3, 4):
            for root in of[n]:
                t, part = root
                column = 0
                for point in part:
                    column ^= 1 << of[n - 1][c.find((t, part - {point}))]
                boundary[n].append(column)
        ranks = {n: rank(boundary[n]) for n in (2, 3, 4)}
        ranks[1] = ranks[5] = 0
        betti = [len(of[n]) - ranks[n] - ranks[n + 1] for n in (1, 2, 3, 4)]
        pieces = Classes()
        for t in range(len(self.cells)):
            pieces.find(t)
        for a, b in glued.values():
            pieces.join(a, b)
        sheets = Classes()
        outer = [(t, f) for f, ts in sides.items() if f not in glued for t in ts]
        by_edge = {}
        for t, f in outer:
            sheets.find((t, f))
            for edge in itertools.combinations(f, 2):
                by_edge.setdefault(c.find((t, frozenset(edge))), []).append((t, f))
        for faces in by_edge.values():
            for other in faces[1:]:
                sheets.join(faces[0], other)
        return {"vertices": len(of[1]), "edges": len(of[2]), "faces": len(of[3]),
                "tetrahedra": len(of[4]),
                "components": len({pieces.find(t) for t in range(len(self.cells))}),
                "boundary_faces": len(outer),
                "boundary_sheets": len({sheets.find(x) for x in outer}), "betti_2": betti}

    # Operations.

    def divide(self, marked, weights):
        """`marked`: roots of edge classes; `weights`: of the end that sorts first, by pair of points."""
        c, _, _ = self.classes()
        after = []
        for t, cell in enumerate(self.cells):
            middles = {}
            for edge in itertools.combinations(cell, 2):
                pair = frozenset(edge)
                if c.find((t, pair)) in marked:
                    middles[pair] = self.middle(pair, weights)
            parts = divided(cell, middles, self.points)
            on = {m: pair for pair, m in middles.items()}
            for whole in itertools.combinations(cell, 3):
                if frozenset(whole) not in self.cut:
                    continue
                for part in parts:
                    for face in itertools.combinations(part, 3):
                        if all(on.get(p, {p}) <= set(whole) for p in face):
                            self.cut.add(frozenset(face))
            after += parts
        self.cells = after

    def middle(self, pair, weights):
        a, b = sorted(pair)
        w = weights.get(pair, 0.5)
        name = self.names.setdefault((a, b, w), len(self.points))
        x, y = self.points[a], self.points[b]
        self.points[name] = tuple((1 - w) * p + w * q for p, q in zip(x, y))
        return name

    def insert(self, cell, edge, weight):
        t = next(i for i, c in enumerate(self.cells) if set(c) == set(cell))
        c, _, _ = self.classes()
        root = c.find((t, frozenset(edge)))
        ring = {key[0] for key in list(c.parent) if len(key[1]) == 2 and c.find(key) == root}
        self.divide({root}, {frozenset(edge): weight})
        return {"ring": len(ring)}

    def refine(self, rows):
        c, _, _ = self.classes()
        edges = [[c.find((t, frozenset(e))) for e in itertools.combinations(cell, 2)]
                 for t, cell in enumerate(self.cells)]
        ends = list(itertools.combinations(range(4), 2))
        marked = {e for t in rows for e in edges[t]}
        red = green = 0
        grew = True
        while grew:
            grew, red, green = False, 0, 0
            for of in edges:
                has = [i for i in range(6) if of[i] in marked]
                corners = {k for i in has for k in ends[i]}
                if len(has) == 6:
                    red += 1
                elif len(has) in (1, 2) or (len(has) == 3 and len(corners) == 3):
                    green += 1
                elif has:
                    marked |= set(of)
                    grew = True
        self.divide(marked, {})
        return {"red": red, "green": green}

    def side(self, p, normal, offset):
        d = sum(Fraction(n) * Fraction(x) for n, x in zip(normal, self.points[p])) - Fraction(offset)
        assert d == 0 or abs(d) > Fraction(1, 10**6), "the plane nearly passes through a point"
        return d

    def slice(self, normal, offset):
        """A cut by a plane, its faces still sewn."""
        c, _, _ = self.classes()
        marked, weights, on_plane = set(), {}, set()
        d = {}
        for t, cell in enumerate(self.cells):
            for p in cell:
                d[p] = self.side(p, normal, offset)
                if d[p] == 0:
                    on_plane.add(c.find((t, frozenset([p]))))
        for t, cell in enumerate(self.cells):
            for edge in itertools.combinations(cell, 2):
                a, b = sorted(edge)
                if d[a] * d[b] < 0:
                    marked.add(c.find((t, frozenset(edge))))
                    weights[frozenset(edge)] = float(d[a] / (d[a] - d[b]))
        whole = set(self.points)
        self.divide(marked, weights)
        at = lambda p: d[p] if p in whole and p in d else 0
        sides = [max((at(p) for p in cell), key=abs) for cell in self.cells]
        glued, _ = self.glue()
        section = [f for f, (a, b) in glued.items()
                   if all(at(p) == 0 for p in f) and sides[a] * sides[b] < 0]
        volume = math.fsum(self.volume(cell) for cell, s in zip(self.cells, sides) if s > 0)
        return {"on_plane": len(on_plane), "new_vertices": len(marked),
                "section_faces": len(section), "positive_volume": volume}

    def volume(self, cell):
        a, b, c, d = (self.points[p] for p in cell)
        u, v, w = ([y - x for x, y in zip(a, q)] for q in (b, c, d))
        return abs(u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
                   u[2] * (v[0] * w[1] - v[1] * w[0])) / 6

    def near(self, place, within):
        rows = []
        for t, cell in enumerate(self.cells):
            distances = [math.dist(self.points[p], place) for p in cell]
            assert all(abs(x - within) > 1e-6 for x in distances), "a point at the very distance"
            if min(distances) < within:
                rows.append(t)
        return rows


def radius_ratio(x):
    """3 r / R: r = 3 V / S, and R by Crelle's formula."""
    sub = lambda a, b: [p - q for p, q in zip(a, b)]
    cross = lambda a, b: [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
    size = lambda a: math.hypot(*a)
    volume = abs(sum(p * q for p, q in zip(sub(x[1], x[0]),
                                           cross(sub(x[2], x[0]), sub(x[3], x[0]))))) / 6
    surface = sum(size(cross(sub(q, p), sub(r, p))) / 2
                  for p, q, r in itertools.combinations(x, 3))
    a, b, c = (math.dist(x[i], x[j]) * math.dist(x[k], x[l])
               for i, j, k, l in ((0, 1, 2, 3), (0, 2, 1, 3), (0, 3, 1, 2)))
    q = (a + b + c) * (a + b - c) * (a - b + c) * (b + c - a)
    return 216 * volume ** 2 / (surface * math.sqrt(q)) if q > 0 and surface > 0 else 0


# Bey's list as he writes it.
BEY = [(0, "01", "02", "03"), ("01", 1, "12", "13"), ("02", "12", 2, "23"), ("03", "13", "23", 3),
       ("01", "02", "03", "13"), ("01", "02", "12", "13"), ("02", "03", "13", "23"),
       ("02", "12", "13", "23")]


def eight(cell, middles, points):
    """Of the three edges inside the one with the best least radius ratio, that of 0 2 and 1 3 when
    none is better by 1e-9."""
    def parts(order):
        at = lambda n: order[n] if isinstance(n, int) else middles[frozenset(order[int(c)] for c in n)]
        return [tuple(map(at, part)) for part in BEY]
    choices = [parts([cell[i] for i in order]) for order in ((0, 1, 2, 3), (0, 2, 3, 1), (0, 3, 1, 2))]
    least = [min(radius_ratio([points[p] for p in part]) for part in choice[4:]) for choice in choices]
    best = 0
    for i in (1, 2):
        ratio = abs(least[i] / max(least[best], 1e-300) - 1)
        assert not 1e-12 < ratio < 1e-8, f"too near to tell: {least}"
        if least[i] > least[best] * (1 + 1e-9):
            best = i
    return choices[best]


def divided(cell, middles, points):
    """Parts of a cell."""
    if len(middles) == 6:
        return eight(cell, middles, points)
    for face in itertools.combinations(cell, 3):
        pairs = [frozenset(e) for e in itertools.combinations(face, 2)]
        if len(middles) == 3 and all(p in middles for p in pairs):
            top = (set(cell) - set(face)).pop()
            corner = [(top, p, *(middles[e] for e in pairs if p in e)) for p in face]
            return corner + [(top, *(middles[e] for e in pairs))]
    parts = [cell]
    # Any order gives as many cells, as long as faces agree.
    for pair in sorted(middles, key=middles.get):
        a, b = pair
        parts = [q for p in parts for q in
                 ([tuple(middles[pair] if x == a else x for x in p),
                   tuple(middles[pair] if x == b else x for x in p)]
                  if a in p and b in p else [p])]
    return parts


def body_of(name):
    file, case = name.split("/")
    for c in json.loads((SUITE / f"{file}.json").read_text())["cases"]:
        if c["name"] == case:
            return Body(c["body"]["points"], c["body"]["tetrahedra"])
    raise SystemExit(f"no case {name}")


def run(name, steps):
    body = body_of(name)
    past, told = [], []
    at_first = body.counts()
    for step in steps:
        (word, what), = step.items()
        more = {}
        if word != "undo":
            past.append(body.copy())
        if word == "split":
            body.cut.add(frozenset(what))
        elif word == "insert":
            more = body.insert(**what)
        elif word == "refine":
            rows = range(len(body.cells)) if what == "all" else body.near(what["near"], what["within"])
            more = body.refine(list(rows))
        elif word == "cut":
            more = body.slice(**what)
        elif word == "undo":
            for _ in range(what):
                body = past.pop()
        told.append({word: what, "after": {**body.counts(), **more}})
    return {"body": name, "before": at_first, "steps": told}


def near(place, within):
    return {"refine": {"near": place, "within": within}}


def plane(normal, offset):
    return {"cut": {"normal": normal, "offset": offset}}


def edge(cell, ends, weight=0.5):
    return {"insert": {"cell": cell, "edge": ends, "weight": weight}}


ALL = {"refine": "all"}


def fixtures():
    """(body, steps); every kind of body, operation and order of them."""
    def cell(name, t):
        return list(body_of(name).cells[t])

    for name in ("01-one-tetrahedron/four-faces", "02-two-tetrahedra/split-and-glue",
                 "05-closed-fan/k-6", "07-octahedron-star/round", "15-pinched-bar/at-an-edge",
                 "29-pinches/strangled-vertex", "22-two-bodies/cut-one", "20-inverted/second",
                 "14-closed-map/first-cut", "25-ziegler-ball/ball-mixture",
                 "30-lens-spaces/lens-2-1-closed-mixture",
                 "30-lens-spaces/projective-space-less-a-ball-mixture",
                 "33-poincare-sphere/poincare-sphere-closed-mixture"):
        c = cell(name, 0)
        yield name, [ALL, {"undo": 1}, edge(c, c[:2], 0.25), ALL, {"undo": 2}, edge(c, c[2:])]
    for name in ("08-figure-4/two-sections", "10-cavity/cavity", "16-joined-ring/cut-through",
                 "35-handles/two-crossing-tunnels", "29-pinches/two-cracks-meet"):
        yield name, [near([0, 0, 0], 0.3), near([0, 0, 0], 0.3), near([1, 1, 1], 0.7),
                     {"undo": 2}, near([1, 1, 0], 0.1)]
    third = 1 / 3
    for name in ("08-figure-4/two-sections", "10-cavity/cavity", "35-handles/two-crossing-tunnels"):
        for normal, offset in (([1, 0, 0], 1.5), ([1, 0, 0], 1), ([1, 1, 1], 2.25),
                               ([1, 2, 3], 4.3), ([0, 0, 1], third), ([1, -1, 0], 0),
                               ([0, 0, 1], 0), ([0, 1, 0], 77)):
            yield name, [plane(normal, offset)]
        # Where a second plane meets parts of a first, its count depends on their diagonals: not here.
        yield name, [plane([1, 0, 0], 1.5), ALL, {"undo": 2}, plane([0, 1, 0], 1.25),
                     plane([0, 1, 0], 2.75)]
    # Cracks: both sides are divided by planes and by refinement of all, one side by an edge of it.
    for name, faces in (("02-two-tetrahedra/split-and-glue", [[0, 1, 2]]),
                        ("07-octahedron-star/round", [[0, 1, 5], [0, 3, 5]]),
                        ("05-closed-fan/k-4", [[0, 1, 2], [0, 1, 4]])):
        c = cell(name, 0)
        yield name, ([{"split": f} for f in faces] +
                     [edge(c, c[:2], 0.75), {"undo": 1}, ALL, {"undo": 1},
                      plane([3, 2, 5], 0.3), {"undo": 1 + len(faces)}, ALL])


def main():
    all_fixtures = [run(name, steps) for name, steps in fixtures()]
    print('{\n "about": "made by make_cell_fixtures.py, which says how",\n "fixtures": [')
    lines = []
    for f in all_fixtures:
        steps = ",\n    ".join(json.dumps(s) for s in f["steps"])
        lines.append('  {"body": %s,\n   "before": %s,\n   "steps": [\n    %s]}' %
                     (json.dumps(f["body"]), json.dumps(f["before"]), steps))
    print(",\n".join(lines) + "\n ]\n}")


if __name__ == "__main__":
    main()
