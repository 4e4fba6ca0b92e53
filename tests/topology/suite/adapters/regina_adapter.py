#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# Regina's Triangulation3 as a kernel under judgement: split is unjoin, glue is join; cells,
# components, homology and orientability are Regina's. Regina is under the GPL: it is only ever run
# as this other process, on one's own machine, and nothing of it is linked or copied.
import sys
from itertools import combinations
from math import isfinite

import regina

import minimal

# Tetrahedra up to which it works out homology (its matrices are dense); the first argument.
LARGEST_HOMOLOGY = int(sys.argv[1]) if len(sys.argv) > 1 else 100


def glue_by_points(triangulation, rows, corners_of, sides):
    """Joins two facets, each (tetrahedron, opposite point), equal points together."""
    (t, p), (u, q) = sides
    there = [corners_of[u].index(q if x == p else x) for x in corners_of[t]]
    facet = triangulation.tetrahedron(rows[t])
    facet.join(corners_of[t].index(p), triangulation.tetrahedron(rows[u]), regina.Perm4(*there))


class ReginaKernel:
    def load(self, points, tetrahedra):
        self.corners = tetrahedra
        self.whole = regina.Triangulation3()
        self.whole.newTetrahedra(len(tetrahedra))
        self.rows = range(len(tetrahedra))
        self.around = [[] for _ in points]
        waiting = {}
        if not tetrahedra or not all(isfinite(x) for p in points for x in p):
            return "refused no tetrahedron, or a coordinate that is no number"
        if len({frozenset(c) for c in tetrahedra}) < len(tetrahedra):
            return "refused a tetrahedron that is there twice"
        for t, corners in enumerate(tetrahedra):
            if len(set(corners)) < 4 or max(corners) >= len(points):
                return "refused a tetrahedron without four points"
            for point in corners:
                self.around[point].append(t)
                face = frozenset(corners) - {point}
                waiting.setdefault(face, []).append((t, point))
        for sides in waiting.values():
            if len(sides) > 2:
                return "refused a face of three tetrahedra"
            if len(sides) == 2:
                glue_by_points(self.whole, self.rows, self.corners, sides)
        return "ok" if self.whole.isOrientable() else "refused no common orientation"

    def across(self, t, point):
        """The other side of a facet, or None on the boundary."""
        tetrahedron, place = self.whole.tetrahedron(t), self.corners[t].index(point)
        other = tetrahedron.adjacentTetrahedron(place)
        if other is None:
            return None
        u = other.index()
        return u, self.corners[u][tetrahedron.adjacentFacet(place)]

    def neighbourhood(self, points):
        """Regina's own triangulation of the tetrahedra at some points, glued as they are now: the
        cells at these points are the same as in the whole, which would take long to work out."""
        rows = {}
        for t in sorted({t for point in points for t in self.around[point]}):
            rows[t] = len(rows)
        local = regina.Triangulation3()
        local.newTetrahedra(len(rows))
        for t in rows:
            for point in self.corners[t]:
                other = self.across(t, point)
                if other and other[0] in rows and ((t, point) < other):
                    glue_by_points(local, rows, self.corners, ((t, point), other))
        return local, rows

    def split(self, t, opposite):
        other = self.across(t, opposite)
        if other is None:
            return "boundary"
        self.whole.tetrahedron(t).unjoin(self.corners[t].index(opposite))
        u = other[0]
        face = sorted(set(self.corners[t]) - {opposite})
        local, rows = self.neighbourhood(face)
        a, b = local.tetrahedron(rows[t]), local.tetrahedron(rows[u])
        at, bt = self.corners[t].index, self.corners[u].index
        vertices = [p for p in face if a.vertex(at(p)).index() != b.vertex(bt(p)).index()]
        edges = []
        for p, q in combinations(face, 2):
            if a.edge(at(p), at(q)).index() != b.edge(bt(p), bt(q)).index():
                edges.append((p, q))
        apart = a.component().index() != b.component().index() and not self.connected(t, u)
        flat = [p for e in edges for p in e]
        words = ["split", len(vertices), *vertices, len(edges), *flat, int(apart)]
        return " ".join(map(str, words))

    def connected(self, t, u):
        """A search over Regina's gluings from both sides in turn: Regina numbers components only by
        working out the whole skeleton again, which `components` does."""
        seen, queues = ({t}, {u}), ([t], [u])
        side, at = 0, [0, 0]
        while at[side] < len(queues[side]):
            row = queues[side][at[side]]
            at[side] += 1
            for facet in range(4):
                other = self.whole.tetrahedron(row).adjacentTetrahedron(facet)
                if other is None or other.index() in seen[side]:
                    continue
                if other.index() in seen[1 - side]:
                    return True
                seen[side].add(other.index())
                queues[side].append(other.index())
            side = 1 - side
        return False

    def glue(self, a, b):
        if a == b or self.across(*a) or self.across(*b):
            return "refused"
        glue_by_points(self.whole, self.rows, self.corners, (a, b))
        return "ok"

    def counts(self):
        t = self.whole
        cells = [t.countVertices(), t.countEdges(), t.countTriangles(), t.countTetrahedra()]
        more = [t.countComponents(), t.countBoundaryFacets(), self.sheets()]
        return " ".join(map(str, ["counts", *cells, *more]))

    def sheets(self):
        """Regina's boundary components join sheets that touch in a vertex; these do not."""
        at_edge, faces = {}, {}
        for triangle in self.whole.triangles():
            if triangle.isBoundary():
                faces[triangle.index()] = [triangle.edge(i).index() for i in range(3)]
                for edge in faces[triangle.index()]:
                    at_edge.setdefault(edge, []).append(triangle.index())
        sheets = 0
        while faces:
            sheets, queue = sheets + 1, [next(iter(faces))]
            while queue:
                for edge in faces.pop(queue.pop(), []):
                    queue += at_edge.pop(edge, [])
        return sheets

    def vertices(self):
        return [t.vertex(i).index() for t in self.whole.tetrahedra() for i in range(4)]

    def components(self):
        return [t.component().index() for t in self.whole.tetrahedra()]

    def homology(self):
        """From Regina's boundary matrices of the cells as they are: its own homology() cuts off
        vertices with links that are no spheres or discs, and such vertices come with every cut."""
        whole = self.whole
        if whole.size() > LARGEST_HOMOLOGY:
            return "homology none"
        maps = [regina.MatrixInt(1, whole.countVertices())]
        maps += [whole.boundaryMap(k) for k in (1, 2, 3)]
        maps.append(regina.MatrixInt(whole.size(), 1))
        groups = [regina.AbelianGroup(maps[k], maps[k + 1]) for k in range(4)]
        words = ["homology", *(g.rank() for g in groups)]
        for g in groups:
            words.append(g.countInvariantFactors())
            words += [g.invariantFactor(i) for i in range(g.countInvariantFactors())]
        return " ".join(map(str, words))

    def orientable(self):
        return self.whole.isOrientable()


if __name__ == "__main__":
    minimal.serve(ReginaKernel(), "regina glue homology orientable")
