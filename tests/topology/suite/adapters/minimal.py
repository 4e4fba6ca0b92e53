#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# The smallest kernel that the suite can judge: glued faces, searches and union-find. README.md beside
# it (in Sunder docs/reference/suite.md) tells its heart; take it as a start for one of your own.
import sys
from itertools import combinations
from math import isfinite


def parity(a, b):
    """1 when an even permutation leads from a to b, -1 when an odd one does."""
    places = [a.index(p) for p in b]
    return (-1) ** sum(x > y for x, y in combinations(places, 2))


class Kernel:
    def load(self, points, tetrahedra):
        self.tetrahedra, self.glued, waiting = tetrahedra, {}, {}
        if not tetrahedra or not all(isfinite(x) for p in points for x in p):
            return "refused no tetrahedron, or a coordinate that is no number"
        if len({frozenset(corners) for corners in tetrahedra}) < len(tetrahedra):
            return "refused a tetrahedron that is there twice"
        for t, corners in enumerate(tetrahedra):
            if len(set(corners)) < 4 or max(corners) >= len(points):
                return "refused a tetrahedron without four points"
            for opposite in corners:
                side, face = (t, opposite), frozenset(corners) - {opposite}
                other = waiting.setdefault(face, side)
                if other in self.glued:
                    return "refused a face of three tetrahedra"
                if other != side:
                    self.glued[side], self.glued[other] = other, side
        return "ok" if self.orientable() else "refused no common orientation"

    def orientable(self):
        """Whether no tetrahedron gets two senses when gluing hands its sense on."""
        sense = {}
        for seed in range(len(self.tetrahedra)):
            stack = [] if seed in sense else [(seed, 1)]
            while stack:
                t, s = stack.pop()
                if sense.setdefault(t, s) != s:
                    return False
                for opposite in self.tetrahedra[t]:
                    if (t, opposite) in self.glued:
                        u, v = self.glued[t, opposite]
                        moved = [opposite if p == v else p for p in self.tetrahedra[u]]
                        expected = -s * parity(self.tetrahedra[t], moved)
                        if u not in sense:
                            stack.append((u, expected))
                        elif sense[u] != expected:
                            return False
        return True

    def reaches(self, t, u, points):
        """Whether glued faces that contain all the points lead from t to u."""
        seen, queue = {t}, [t]
        for t in queue:
            for opposite in self.tetrahedra[t]:
                if opposite in points or (t, opposite) not in self.glued:
                    continue
                next_one = self.glued[t, opposite][0]
                if next_one not in seen:
                    seen.add(next_one)
                    queue.append(next_one)
            if u in seen:
                return True
        return False

    def split(self, t, opposite):
        if (t, opposite) not in self.glued:
            return "boundary"
        other = self.glued.pop((t, opposite))
        del self.glued[other]
        face = sorted(set(self.tetrahedra[t]) - {opposite})
        apart = lambda points: not self.reaches(t, other[0], points)
        vertices = [p for p in face if apart((p,))]
        edges = [e for e in combinations(face, 2) if apart(e)]
        flat = [p for e in edges for p in e]
        words = ["split", len(vertices), *vertices, len(edges), *flat, int(apart(()))]
        return " ".join(map(str, words))

    def glue(self, a, b):
        if a in self.glued or b in self.glued or a == b:
            return "refused"
        self.glued[a], self.glued[b] = b, a
        return "ok"

    def classes(self):
        """A name of its class for each (tetrahedron, points of one of its cells): union-find."""
        parent = {}

        def root(x):
            while parent.setdefault(x, x) != x:
                parent[x] = x = parent[parent[x]]
            return x

        for t, corners in enumerate(self.tetrahedra):
            for n in (0, 1, 2, 3):  # the tetrahedron, its corners, edges and faces
                for cell in combinations(sorted(corners), n):
                    root((t, cell))
                    for opposite in corners:
                        if opposite not in cell and (t, opposite) in self.glued:
                            parent[root((t, cell))] = root((self.glued[t, opposite][0], cell))
        return {x: root(x) for x in list(parent)}

    def counts(self):
        name = self.classes()
        count = lambda n: len({c for x, c in name.items() if len(x[1]) == n})
        sheet = {}  # boundary faces: grown together across edges
        at_edge = {}
        for t, corners in enumerate(self.tetrahedra):
            for opposite in corners:
                if (t, opposite) not in self.glued:
                    face = sorted(set(corners) - {opposite})
                    for edge in combinations(face, 2):
                        at_edge.setdefault(name[t, edge], []).append((t, opposite))
                        sheet.setdefault((t, opposite), []).append(name[t, edge])
        boundary, sheets = len(sheet), 0
        while sheet:
            sheets, queue = sheets + 1, [next(iter(sheet))]
            while queue:
                for edge in sheet.pop(queue.pop(), []):
                    queue += at_edge.pop(edge, [])
        cells = [count(1), count(2), count(3), len(self.tetrahedra), count(0), boundary, sheets]
        return " ".join(map(str, ["counts", *cells]))

    def vertices(self):
        return self.numbers([(t, (p,)) for t, row in enumerate(self.tetrahedra) for p in row])

    def components(self):
        return self.numbers([(t, ()) for t in range(len(self.tetrahedra))])

    def numbers(self, cells):
        """Names of classes as numbers, in the order of the cells asked for."""
        name, number = self.classes(), {}
        return [number.setdefault(name[c], len(number)) for c in cells]


def serve(kernel, name_and_gifts):
    """Reads questions and answers them, one line each, until there are no more."""
    read = sys.stdin.readline
    while line := read():
        word, *rest = line.split()
        if word == "hello":
            answer = "hello 1 " + name_and_gifts
        elif word == "mesh":
            points = [tuple(map(float, read().split())) for _ in range(int(rest[0]))]
            tetrahedra = [tuple(map(int, read().split())) for _ in range(int(rest[1]))]
            answer = kernel.load(points, tetrahedra)
        elif word == "split":
            answer = kernel.split(*map(int, rest))
        elif word == "glue":
            t, p, u, q = map(int, rest)
            answer = kernel.glue((t, p), (u, q))
        elif word == "counts":
            answer = kernel.counts()
        elif word == "vertices" or word == "components":
            answer = " ".join([word, *map(str, getattr(kernel, word)())])
        elif word == "homology" and hasattr(kernel, "homology"):
            answer = kernel.homology()
        elif word == "orientable":
            answer = f"orientable {int(kernel.orientable())}"
        elif word == "quit":
            return
        else:
            answer = "unknown"
        print(answer, flush=True)


if __name__ == "__main__":
    serve(Kernel(), "minimal glue orientable")
