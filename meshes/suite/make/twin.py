# SPDX-License-Identifier: MIT
"""A glued body judged by union-find: counts, and what splitting and gluing faces does to it.

Half-face h = 4 t + p is the face of tetrahedron t opposite to its corner p (place in the file).
Corners, edges and faces of different tetrahedra are one cell exactly when a chain of glued faces
that contain it joins them. Nothing here walks round an edge or knows a dart.
"""

EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
EDGE_NUMBER = {pair: e for e, pair in enumerate(EDGES)}
EDGE_NUMBER.update({(j, i): e for (i, j), e in list(EDGE_NUMBER.items())})


class UnionFind:
    def __init__(self, size):
        self.parent = list(range(size))

    def root(self, i):
        parent = self.parent
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    def join(self, a, b):
        """Whether the two were apart before."""
        a, b = self.root(a), self.root(b)
        self.parent[a] = b
        return a != b

    def classes(self):
        return sum(1 for i, p in enumerate(self.parent) if i == p)


def face_points(tets, h):
    """The three points of a half-face, rising."""
    t, p = divmod(h, 4)
    return tuple(sorted(tets[t][i] for i in range(4) if i != p))


class Glued:
    """Tetrahedra and which half-faces are glued to each other (-1: boundary)."""

    def __init__(self, tets, at_most=2):
        """Glues all pairs of half-faces with the same points. A face of more than `at_most` (2)
        tetrahedra is a defect; with a larger `at_most` its first two are glued blindly."""
        self.tets = [tuple(t) for t in tets]
        self.other = [-1] * (4 * len(tets))
        self.sides = {}
        self.around = {}
        for t, corners in enumerate(self.tets):
            for p, point in enumerate(corners):
                self.around.setdefault(point, []).append(t)
                self.sides.setdefault(face_points(self.tets, 4 * t + p), []).append(4 * t + p)
        for face, sides in self.sides.items():
            assert len(sides) <= at_most, f"face {face} has {len(sides)} sides"
            if len(sides) >= 2:
                self.glue(sides[0], sides[1])

    def glue(self, a, b):
        self.other[a], self.other[b] = b, a

    def joined_around(self, a, b, points):
        """Whether tetrahedra a and b hang together through glued faces that contain `points`."""
        star = min((self.around[x] for x in points), key=len)
        local = {t: i for i, t in enumerate(star)}
        sets = UnionFind(len(star))
        for t in star:
            corners = self.tets[t]
            if any(x not in corners for x in points):
                continue
            for p in range(4):
                across = self.other[4 * t + p]
                if across >= 0 and corners[p] not in points:
                    sets.join(local[t], local[across // 4])
        return sets.root(local[a]) == sets.root(local[b])

    def split(self, h):
        """Unglues a face; the points and edges of it that come apart. None: a boundary face."""
        across = self.other[h]
        if across < 0:
            return None
        self.other[h] = self.other[across] = -1
        a, b = h // 4, across // 4
        face = face_points(self.tets, h)
        vertices = [p for p in face if not self.joined_around(a, b, (p,))]
        pairs = ((face[0], face[1]), (face[0], face[2]), (face[1], face[2]))
        edges = [list(e) for e in pairs if not self.joined_around(a, b, e)]
        return {"vertices": vertices, "edges": edges, "separated": None}

    def split_all(self, faces):
        """Splits one after the other. Which of them part a component is found backwards: with the
        faces put back, last first, a face parted one when it joins two sets again."""
        answers, done = [], []
        for h in faces:
            across = self.other[h]
            answer = self.split(h)
            answers.append(answer)
            if answer is not None:
                done.append((h // 4, across // 4, answer))
        sets = self.components()
        for a, b, answer in reversed(done):
            answer["separated"] = sets.join(a, b)
        return answers

    def components(self):
        sets = UnionFind(len(self.tets))
        for h, across in enumerate(self.other):
            if across > h:
                sets.join(h // 4, across // 4)
        return sets

    def orbits(self):
        """Union-find over corners 4 t + i, and over edges 6 t + e."""
        corners, edges = UnionFind(4 * len(self.tets)), UnionFind(6 * len(self.tets))
        for h, across in enumerate(self.other):
            if across < h:
                continue
            t, p = divmod(h, 4)
            u = across // 4
            there = [self.tets[u].index(x) if i != p else -1 for i, x in enumerate(self.tets[t])]
            for i in range(4):
                if i != p:
                    corners.join(4 * t + i, 4 * u + there[i])
            for e, (i, j) in enumerate(EDGES):
                if p not in (i, j):
                    edges.join(6 * t + e, 6 * u + EDGE_NUMBER[there[i], there[j]])
        return corners, edges

    def sheets(self, edges):
        """Boundary faces, and the surfaces they make up when joined across edges."""
        boundary = [h for h, across in enumerate(self.other) if across < 0]
        sets, first = UnionFind(len(boundary)), {}
        for n, h in enumerate(boundary):
            t, p = divmod(h, 4)
            for e, pair in enumerate(EDGES):
                if p not in pair:
                    sets.join(n, first.setdefault(edges.root(6 * t + e), n))
        return len(boundary), sets.classes()

    def counts(self):
        corners, edges = self.orbits()
        boundary, sheets = self.sheets(edges)
        return {"vertices": corners.classes(), "edges": edges.classes(),
                "faces": (len(self.other) + boundary) // 2, "tetrahedra": len(self.tets),
                "components": self.components().classes(), "boundary_faces": boundary,
                "boundary_sheets": sheets}

    def orientable(self):
        """Whether signs of the tetrahedra exist that give each glued face opposite signs from its
        two sides: union-find over (tetrahedron, sign)."""
        sets = UnionFind(2 * len(self.tets))
        for h, across in enumerate(self.other):
            if across < h:
                continue
            same = self.place_sign(h) != self.place_sign(across)
            for sign in (0, 1):
                sets.join(2 * (h // 4) + sign, 2 * (across // 4) + (sign if same else 1 - sign))
        return all(sets.root(2 * t) != sets.root(2 * t + 1) for t in range(len(self.tets)))

    def place_sign(self, h):
        """1 where the face counts negative in the boundary of its tetrahedron, points rising."""
        t, p = divmod(h, 4)
        return sum(1 for x in self.tets[t] if x < self.tets[t][p]) % 2

    def vertex_corners(self, tetrahedron, point):
        """All tetrahedra of the vertex orbit at that corner."""
        star = self.around[point]
        local = {t: i for i, t in enumerate(star)}
        sets = UnionFind(len(star))
        for t in star:
            for p in range(4):
                across = self.other[4 * t + p]
                if across >= 0 and self.tets[t][p] != point:
                    sets.join(local[t], local[across // 4])
        return [t for t in star if sets.root(local[t]) == sets.root(local[tetrahedron])]

    def vertex_orbits(self, point):
        """Number of vertex orbits at a point."""
        rest, orbits = set(self.around.get(point, ())), 0
        while rest:
            rest -= set(self.vertex_corners(min(rest), point))
            orbits += 1
        return orbits


def file_cells(tets):
    """Distinct index tuples: points, edges, faces."""
    edges = {tuple(sorted((t[i], t[j]))) for t in tets for i, j in EDGES}
    faces = {tuple(sorted(t[:p] + t[p + 1:])) for t in map(tuple, tets) for p in range(4)}
    return [len({p for t in tets for p in t}), len(edges), len(faces)]
