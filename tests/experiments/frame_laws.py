#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Judges the laws of mechanics from VTU frames alone, by nothing that the program says of itself.

    tests/experiments/frame_laws.py run [CASE ...] [--steps 0.1,1,4,16.7,33] [--sunder PATH] [--out DIR]
    tests/experiments/frame_laws.py stack [--boxes 5,20] [--steps 1,4,16.7]
    tests/experiments/frame_laws.py judge SCENE.json FOLDER      (of `sunder run SCENE -o FOLDER`)

From each frame and the scene file: masses (density x volume at rest / 4 a corner; the first frame, less
its displacement, is the shape at rest), P, L about the origin, kinetic energy, strain energy (each
component turned back by mass-weighted shape matching, then linear elasticity), the work of gravity and of
supports that move. Judged, and exit code 1 where a law is broken and no warning reports it:
  momentum  where nothing acts from outside: P and L change by no more than 1e-9 of the exchange,
            the sums over frames of |change of P| / 2 and |change of L| / 2 of each piece
  energy    kinetic + strain - work rises above no earlier minimum by more than 1e-6 of the most there was
  overlap   at rest (no vertex faster than 0.1 m/s) no vertex lies deeper in another piece or an obstacle than
            5 per cent of the mean edge: in the tetrahedra themselves, not the balls that contact uses, measured
            to the piece's surface (to the nearest face of the tetrahedron would be less inside a
            piece)
  stack     after 10 s the top is where it was put to within a hundredth of a box
Of report.json only the codes of `warnings` are read. Work that changes within a frame (a ramp of gravity,
a support that pulls) is integrated by trapezoids; a rise is judged less their largest error
("judged"). Free spheres are not in frames: their first energy may have gone into the bodies
("weak")."""
import argparse
import array
import csv
import itertools
import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import time

TREE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TREE / "meshes/scenes/charts"))
from make_meshes import medit

MOMENTUM, RISE, OVERLAP, STACK = 1e-9, 1e-6, 0.05, 0.01
AT_REST = 0.1  # m/s
# Warnings that name a law. `contact_not_converged` names gaps between balls, which say nothing of how deep
# the tetrahedra lie in each other.
TELLS = {"momentum": (), "energy": ("energy_rises", "energy_residual"), "overlap": ("contacts_left_out", "deep_overlap"), "stack": ()}
CODES = {"Float64": "d", "Float32": "f", "UInt32": "I", "Int32": "i", "UInt8": "B"}


# ---- vectors -------------------------------------------------------------------------------------

def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def scaled(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def norm(a):
    return math.sqrt(dot(a, a))


def cofactors(m):
    """Rows; the inverse's transpose times the determinant."""
    return (cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]))


def polar(a):
    """The rotation of the polar decomposition, by Newton's iteration."""
    for turn in range(60):
        c = cofactors(a)
        det = dot(a[0], c[0])
        if det == 0:
            raise ValueError("a piece without a rotation")
        size = 1.0
        if turn < 10:  # Higham's scaling
            size = math.sqrt(math.sqrt(sum(dot(r, r) for r in c) / sum(dot(r, r) for r in a)) / abs(det))
        new = [tuple(0.5 * (size * x + y / (size * det)) for x, y in zip(r, s)) for r, s in zip(a, c)]
        moved = max(abs(x - y) for r, s in zip(new, a) for x, y in zip(r, s))
        a = new
        if moved < 1e-14:
            break
    return a


# ---- frames --------------------------------------------------------------------------------------

def rows(flat):
    return list(zip(flat[0::3], flat[1::3], flat[2::3]))


class Frame:
    """One VTU file as `sunder run` writes it: raw appended data, little-endian, 64-bit headers."""

    def __init__(self, path, at):
        self.time, data = at, path.read_bytes()
        start = data.index(b'<AppendedData encoding="raw">')
        self.raw, head = {}, data[:start].decode()
        body = data.index(b"_", start) + 1
        for kind, name, offset in re.findall(r'<DataArray type="(\w+)" Name="(\w+)".*?offset="(\d+)"', head):
            place = body + int(offset)
            size = struct.unpack_from("<Q", data, place)[0]
            self.raw[name] = (CODES[kind], data[place + 8:place + 8 + size])
        self.x, self.v = rows(self.column("Points")), rows(self.column("velocity"))

    def column(self, name):
        kind, data = self.raw[name]
        values = array.array(kind)
        values.frombytes(data)
        return values

    def cells(self):
        return self.raw["connectivity"][1] + self.raw["component"][1]


def frames_of(folder):
    text = (folder / "frames.pvd").read_text()
    for at, name in re.findall(r'timestep="([^"]+)".*?file="([^"]+)"', text):
        yield Frame(folder / name, float(at))


# ---- bodies --------------------------------------------------------------------------------------

class Rest:
    """The constants: tetrahedra at rest, a row each, with their inverse edges and moduli."""

    def __init__(self, frame, scene):
        moved = rows(frame.column("displacement"))
        corners, body = frame.column("connectivity"), frame.column("body")
        self.corners = [tuple(sub(frame.x[v], moved[v]) for v in corners[4 * t:4 * t + 4]) for t in range(len(body))]
        self.inverse, self.volume, self.mass, self.moduli, edges = [], [], [], [], 0.0
        for p, b in zip(self.corners, body):
            edge = [sub(p[k], p[0]) for k in (1, 2, 3)]
            c = cofactors(edge)
            det = dot(edge[0], c[0])
            self.inverse.append(tuple(scaled(row, 1 / det) for row in c))  # gradients of shapes 1 to 3
            self.volume.append(det / 6)
            made = scene["bodies"][b].get("material", {})
            e, nu = made.get("young_modulus", 30e9), made.get("poisson_ratio", 0.2)
            self.mass.append(made.get("density", 2400) * det / 6)
            self.moduli.append((e * nu / (1 + nu) / (1 - 2 * nu), e / (2 + 2 * nu)))
            edges += sum(norm(sub(a, b)) for a, b in itertools.combinations(p, 2)) / 6
        self.mean_edge = edges / len(self.corners)
        self.total = sum(self.mass)


class Cells:
    """Tetrahedra, vertices and pieces, between two cracks."""

    def __init__(self, frame, rest):
        flat, self.of_tet = frame.column("connectivity"), frame.column("component").tolist()
        self.tets = [tuple(flat[k:k + 4]) for k in range(0, len(flat), 4)]
        n = len(frame.x)
        self.rest, self.mass, self.of_vertex = [None] * n, [0.0] * n, [None] * n
        self.pieces = {}
        for t, (tet, c) in enumerate(zip(self.tets, self.of_tet)):
            self.pieces.setdefault(c, []).append(t)
            for v, r in zip(tet, rest.corners[t]):
                self.rest[v], self.of_vertex[v] = r, c
                self.mass[v] += rest.mass[t] / 4
        self.vertices = {c: [] for c in self.pieces}
        for v, c in enumerate(self.of_vertex):
            if c is not None:
                self.vertices[c].append(v)


def gradient(x, tet, inverse):
    """Rows of du/dX + 1 of one tetrahedron."""
    a, b, c, d = x[tet[0]], x[tet[1]], x[tet[2]], x[tet[3]]
    (g0, g1, g2) = inverse
    out = []
    for i in (0, 1, 2):
        p, q, r = b[i] - a[i], c[i] - a[i], d[i] - a[i]
        out.append((p * g0[0] + q * g1[0] + r * g2[0], p * g0[1] + q * g1[1] + r * g2[1], p * g0[2] + q * g1[2] + r * g2[2]))
    return out


def density(f, moduli):
    xx, yy, zz = f[0][0] - 1, f[1][1] - 1, f[2][2] - 1
    xy, yz, zx = 0.5 * (f[0][1] + f[1][0]), 0.5 * (f[1][2] + f[2][1]), 0.5 * (f[2][0] + f[0][2])
    trace = xx + yy + zz
    return 0.5 * moduli[0] * trace * trace + moduli[1] * (xx * xx + yy * yy + zz * zz + 2 * (xy * xy + yz * yz + zx * zx))


def centre(points, vertices, mass):
    whole = sum(mass[v] for v in vertices)
    return tuple(sum(mass[v] * points[v][i] for v in vertices) / whole for i in (0, 1, 2))


def turned_back(points, fitted, vertices, cells):
    """R^T x of a piece's vertices, R by shape matching of `fitted` to the shape at rest; and R."""
    g, r0 = centre(fitted, vertices, cells.mass), centre(cells.rest, vertices, cells.mass)
    a = [[0.0] * 3 for _ in range(3)]
    for v in vertices:
        p, q, m = sub(fitted[v], g), sub(cells.rest[v], r0), cells.mass[v]
        for row, s in zip(a, p):
            s *= m
            row[0] += s * q[0]
            row[1] += s * q[1]
            row[2] += s * q[2]
    turn = polar(a)
    columns = list(zip(*turn))
    return {v: (dot(columns[0], points[v]), dot(columns[1], points[v]), dot(columns[2], points[v])) for v in vertices}, turn


def piece_frames(frame, cells, held):
    """Every piece of more than one tetrahedron (those are rigid). A held piece has the frame of its
    supports, which the displacement gives: x less it is the rigid reference."""
    reference = None
    for c, tets in cells.pieces.items():
        if len(tets) == 1:
            continue
        vertices, fitted = cells.vertices[c], frame.x
        if held and any(v in held for v in vertices):
            reference = reference or [sub(x, d) for x, d in zip(frame.x, rows(frame.column("displacement")))]
            fitted = reference
        yield c, tets, *turned_back(frame.x, fitted, vertices, cells)


def strain_energy(turned, rest, cells):
    total = 0.0
    for _, tets, back, _ in turned:
        for t in tets:
            total += rest.volume[t] * density(gradient(back, cells.tets[t], rest.inverse[t]), rest.moduli[t])
    return total


def kinetic_energy(frame, cells):
    return 0.5 * sum(m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) for m, v in zip(cells.mass, frame.v))


def momenta(frame, vertices, mass):
    p, l = [0.0] * 3, [0.0] * 3
    for v, m in zip(vertices, mass):
        s = scaled(frame.v[v], m)
        for out, add in ((p, s), (l, cross(frame.x[v], s))):
            out[0] += add[0]
            out[1] += add[1]
            out[2] += add[2]
    return tuple(p), tuple(l)


def momenta_of_pieces(frame, cells, rest, pieces):
    """P and L of groups of tetrahedra, which may be pieces of a later frame."""
    for tets in pieces:
        rows_, mass = [], []
        for t in tets:
            rows_ += cells.tets[t]
            mass += [rest.mass[t] / 4] * 4
        yield momenta(frame, rows_, mass)


# ---- actions from outside ------------------------------------------------------------------------

def gravity_at(scene, at):
    said = scene.get("gravity", {})
    g, ramp = said.get("acceleration", [0, 0, -9.81]), said.get("ramp_time", 0)
    return tuple(scaled(g, min(1.0, at / ramp) if ramp else 1.0))


def held_vertices(scene, frame, cells):
    """Rows held at the start, each with its velocity; bodies with `held` may not be rotated here."""
    found, body = {}, frame.column("body")
    for t, tet in enumerate(cells.tets):
        made = scene["bodies"][body[t]]
        for box in made.get("held", []):
            for v in tet:
                at = sub(cells.rest[v], made.get("translation", (0, 0, 0)))
                if all(a <= x <= b for a, x, b in zip(box["minimum"], at, box["maximum"])):
                    found[v] = tuple(box.get("velocity", (0, 0, 0)))
    return found


def stress_forces(back, turn, tet, rest, t):
    """Forces, in the world, that a tetrahedron asks of its four corners."""
    f, (lam, mu) = gradient(back, tet, rest.inverse[t]), rest.moduli[t]
    e = [[0.5 * (f[i][j] + f[j][i]) - (i == j) for j in range(3)] for i in range(3)]
    trace = e[0][0] + e[1][1] + e[2][2]
    stress = [[2 * mu * e[i][j] + (lam * trace if i == j else 0) for j in range(3)] for i in range(3)]
    inverse = rest.inverse[t]
    for shape in (tuple(-sum(g[k] for g in inverse) for k in range(3)), *inverse):
        force = [dot(row, shape) * rest.volume[t] for row in stress]
        yield tuple(dot(row, force) for row in turn)


def supports(turned, rest, cells, held, g):
    """By piece: force of its supports (by elasticity and weight), its power, their largest
    speed."""
    found = {}
    for c, tets, back, turn in turned:
        mine = [v for v in cells.vertices[c] if v in held]
        if not mine:
            continue
        parts = [(v, scaled(g, -cells.mass[v])) for v in mine]
        for t in tets:
            tet = cells.tets[t]
            if tet[0] in held or tet[1] in held or tet[2] in held or tet[3] in held:
                parts += [(v, f) for v, f in zip(tet, stress_forces(back, turn, tet, rest, t)) if v in held]
        found[c] = (tuple(sum(f[i] for _, f in parts) for i in range(3)), sum(dot(f, held[v]) for v, f in parts),
                    max(norm(held[v]) for v in mine))
    return found


# ---- laws ----------------------------------------------------------------------------------------

class Rise:
    """The largest rise above any earlier minimum."""

    def __init__(self):
        self.lowest, self.size, self.at = math.inf, 0.0, 0.0

    def see(self, level, at):
        self.lowest = min(self.lowest, level)
        if level - self.lowest > self.size:
            self.size, self.at = level - self.lowest, at


class Passed:
    """Drift of P and L, and the exchange between pieces."""

    def __init__(self):
        self.start = self.last = self.before = None
        self.p = self.l = self.drift_p = self.drift_l = 0.0

    def see(self, frame, cells, rest):
        whole = momenta(frame, range(len(frame.v)), cells.mass)
        self.start = self.start or whole
        if self.before:
            was, had = self.before
            pieces = cells.pieces.values()
            for (p0, l0), (p1, l1) in zip(momenta_of_pieces(was, had, rest, pieces), momenta_of_pieces(frame, cells, rest, pieces)):
                self.p += norm(sub(p1, p0)) / 2
                self.l += norm(sub(l1, l0)) / 2
        self.drift_p = max(self.drift_p, norm(sub(whole[0], self.start[0])))
        self.drift_l = max(self.drift_l, norm(sub(whole[1], self.start[1])))
        self.before = (frame, cells)

    def seen(self):
        return {"passed_P": self.p, "passed_L": self.l, "drift_P": self.drift_p / (self.p or 1.0),
                "drift_L": self.drift_l / (self.l or 1.0)}


class Works:
    """Work since the start: `mean` by trapezoids; `most`: its upper bound. This has the larger
    gravity of both ends of a frame and the supports' force at its end (as the scheme has it). Any
    other change of a held piece's momentum counts at the fastest of its supports."""

    def __init__(self, scene):
        self.scene, self.mean, self.most, self.gravity, self.before = scene, 0.0, 0.0, 0.0, None

    def see(self, frame, rest, cells, held, turned):
        g = gravity_at(self.scene, frame.time)
        at = centre(frame.x, range(len(frame.x)), cells.mass)
        pulls = supports(turned, rest, cells, held, g) if held else {}
        power = sum(p for _, p, _ in pulls.values())
        if self.before:
            was, had, g0, at0, power0 = self.before
            way, span = scaled(sub(at, at0), rest.total), frame.time - was.time
            weight = (dot(g0, way), dot(g, way))
            self.gravity += sum(weight) / 2
            self.mean += sum(weight) / 2 + (power0 + power) * span / 2
            self.most += max(weight) + power * span
            for parent in {had.of_tet[cells.pieces[c][0]] for c in pulls}:
                self.most += self.unseen(was, had, frame, cells, pulls, parent, g, span)
        self.before = (frame, cells, g, at, power)

    def unseen(self, was, had, frame, cells, pulls, parent, g, span):
        """J, at most, that came to a held piece neither by weight nor by the known forces of its
        supports. The piece as it was through the step: cracks come after."""
        change, speed = scaled(momentum_of(was, had, parent), -1), 0.0
        for c, tets in cells.pieces.items():
            if had.of_tet[tets[0]] == parent:
                force, _, fastest = pulls.get(c, ((0, 0, 0), 0, 0))
                mass, p = sum(cells.mass[v] for v in cells.vertices[c]), momentum_of(frame, cells, c)
                change = tuple(d + q - span * (f + mass * w) for d, q, f, w in zip(change, p, force, g))
                speed = max(speed, fastest)
        return speed * norm(change)


def momentum_of(frame, cells, piece):
    vertices = cells.vertices[piece]
    return tuple(sum(cells.mass[v] * frame.v[v][i] for v in vertices) for i in (0, 1, 2))


def isolated(scene):
    return not (any(gravity_at(scene, math.inf)) or scene.get("obstacles") or
                any(b.get("held") or b.get("loads") for b in scene["bodies"]))


def free_balls(scene):
    """J that spheres with a mass have at the start, and may give to the bodies unseen."""
    return sum(0.5 * o["mass"] * dot(o.get("velocity", (0, 0, 0)), o.get("velocity", (0, 0, 0)))
               for o in scene.get("obstacles", []) if o.get("mass"))


class Energy:
    """Kinetic + strain - work: its largest rise, as it is and less the largest error of the
    work."""

    def __init__(self, scene):
        self.balls, self.works, self.start, self.most = free_balls(scene), Works(scene), None, 0.0
        self.raised, self.surely, self.highest = Rise(), Rise(), -math.inf

    def see(self, frame, rest, cells, held):
        turned = list(piece_frames(frame, cells, held))
        energy = kinetic_energy(frame, cells) + strain_energy(turned, rest, cells)
        self.works.see(frame, rest, cells, held, turned)
        self.start = energy if self.start is None else self.start
        self.most = max(self.most, energy, self.start + self.works.gravity, self.start + self.balls)
        self.raised.see(energy - self.works.mean, frame.time)
        self.surely.see(energy - self.works.most, frame.time)
        self.highest = max(self.highest, energy - self.works.most)

    def seen(self):
        surely = max(0.0, self.highest - self.start - self.balls) if self.balls else self.surely.size
        share = 1 / self.most if self.most else 0.0
        return {"most_J": self.most, "rise_J": self.raised.size, "rise_share": self.raised.size * share,
                "rise_at_s": self.raised.at, "judged_rise_share": surely * share, "weak": bool(self.balls)}


def judge_frames(scene, folder):
    """Everything that is seen in the frames of one run, by name; the last frame and its cells."""
    rest = cells = key = frame = None
    energy, passed, held, count = Energy(scene), Passed(), {}, 0
    for count, frame in enumerate(frames_of(folder), 1):
        rest = rest or Rest(frame, scene)
        if frame.cells() != key:
            key, cells = frame.cells(), Cells(frame, rest)
        if count == 1:
            held = held_vertices(scene, frame, cells)
        energy.see(frame, rest, cells, held)
        if isolated(scene):
            passed.see(frame, cells, rest)
    seen = {"seconds": frame.time, "frames": count, "pieces": len(cells.pieces), "fastest": max(map(norm, frame.v))}
    seen |= energy.seen() | overlaps(frame, cells, rest, scene)
    return seen | (passed.seen() if isolated(scene) else {}), frame, cells


# ---- overlap -------------------------------------------------------------------------------------

def planes_of(x, tet):
    """Outward unit normals and offsets of a tetrahedron's faces."""
    found = []
    for i, j, k, other in ((1, 2, 3, 0), (0, 2, 3, 1), (0, 1, 3, 2), (0, 1, 2, 3)):
        a = x[tet[i]]
        n = cross(sub(x[tet[j]], a), sub(x[tet[k]], a))
        size = norm(n)
        if size == 0:
            return None
        n = scaled(n, (1 if dot(n, sub(x[tet[other]], a)) < 0 else -1) / size)
        found.append((n, dot(n, a)))
    return found


def grid_of(x, tets, size):
    grid = {}
    for t, tet in enumerate(tets):
        ends = [(math.floor(min(x[v][i] for v in tet) / size), math.floor(max(x[v][i] for v in tet) / size)) for i in range(3)]
        for cell in itertools.product(*(range(a, b + 1) for a, b in ends)):
            grid.setdefault(cell, []).append(t)
    return grid


def inside(x, cells, size):
    """(vertex, tetrahedron, distance to its nearest face) for vertices in other pieces; 0 between two tetrahedra."""
    grid, planes = grid_of(x, cells.tets, size), {}
    for v, c in enumerate(cells.of_vertex):
        if c is None:
            continue
        p = x[v]
        for t in grid.get(tuple(math.floor(a / size) for a in p), ()):
            if cells.of_tet[t] == c:
                continue
            if t not in planes:
                planes[t] = planes_of(x, cells.tets[t])
            if planes[t]:
                depth = min(o - n[0] * p[0] - n[1] * p[1] - n[2] * p[2] for n, o in planes[t])
                if depth > -1e-9 * size:
                    yield v, t, max(0.0, depth)


def boundary_of(tets):
    seen = {}
    for tet in tets:
        for face in itertools.combinations(sorted(tet), 3):
            seen[face] = seen.get(face, 0) + 1
    return [face for face, times in seen.items() if times == 1]


def to_triangle(p, a, b, c):
    """Distance of a point from a triangle."""
    ab, ac, ap = sub(b, a), sub(c, a), sub(p, a)
    n = cross(ab, ac)
    area = dot(n, n)
    if area > 0:
        s, t = dot(cross(ap, ac), n) / area, dot(cross(ab, ap), n) / area
        if s >= 0 and t >= 0 and s + t <= 1:
            return abs(dot(ap, n)) / math.sqrt(area)
    return min(to_edge(p, a, b), to_edge(p, b, c), to_edge(p, c, a))


def to_edge(p, a, b):
    ab = sub(b, a)
    s = max(0.0, min(1.0, dot(sub(p, a), ab) / (dot(ab, ab) or 1.0)))
    return norm(sub(p, (a[0] + s * ab[0], a[1] + s * ab[1], a[2] + s * ab[2])))


def obstacle_depth(shape, at, p):
    """How deep a point is in a plane, a sphere or a box that has not been turned; below 0: outside."""
    move = scaled(shape.get("velocity", (0, 0, 0)), at)
    if "plane" in shape:
        n = shape["plane"].get("normal", (0, 0, 1))
        size = norm(n)
        return shape["plane"].get("offset", 0) - dot(n, sub(p, move)) / size
    if "sphere" in shape:
        return shape["sphere"]["radius"] - norm(sub(sub(p, move), shape["sphere"]["center"]))
    q = sub(sub(p, move), shape["box"]["center"])
    return min(h - abs(a) for h, a in zip(shape["box"]["half_extent"], q))


def overlaps(frame, cells, rest, scene):
    """Deepest overlaps over the mean edge: to the nearest face of the tetrahedron met, to the surface of the
    piece met (not less), and in obstacles."""
    deepest, surface, faces, seen = 0.0, 0.0, {}, set()
    for v, t, depth in inside(frame.x, cells, rest.mean_edge):
        deepest = max(deepest, depth)
        c = cells.of_tet[t]
        if len(cells.pieces[c]) > 1:
            if (v, c) in seen:
                continue
            seen.add((v, c))
            if c not in faces:
                faces[c] = boundary_of([cells.tets[k] for k in cells.pieces[c]])
            depth = least_distance(frame.x, frame.x[v], faces[c])
        surface = max(surface, depth)
    fixed = [o for o in scene.get("obstacles", []) if not o.get("mass")]
    into = max((obstacle_depth(o, frame.time, p) for o in fixed for p in frame.x), default=0.0)
    return {"overlap": deepest / rest.mean_edge, "overlap_surface": surface / rest.mean_edge,
            "in_obstacles": max(0.0, into) / rest.mean_edge}


def least_distance(x, p, faces):
    least = math.inf
    for i, j, k in faces:
        a, b, c = x[i], x[j], x[k]
        if all(min(a[d], b[d], c[d]) - least < p[d] < max(a[d], b[d], c[d]) + least for d in (0, 1, 2)):
            least = min(least, to_triangle(p, a, b, c))
    return least


# ---- cases ---------------------------------------------------------------------------------------

def box_mesh(path, cells, size):
    """Kuhn's six tetrahedra a cell, centred on the origin, as MEDIT."""
    count = [n + 1 for n in cells]
    at = lambda p: p[0] + count[0] * (p[1] + count[1] * p[2])
    points = [tuple(size[a] * ((i, j, k)[a] / cells[a] - 0.5) for a in range(3))
              for k in range(count[2]) for j in range(count[1]) for i in range(count[0])]
    tets = []
    for cell in itertools.product(*map(range, cells)):
        for order in itertools.permutations(range(3)):
            p, way = list(cell), [at(cell)]
            for axis in order:
                p[axis] += 1
                way.append(at(p))
            if order in ((0, 2, 1), (1, 0, 2), (2, 1, 0)):
                way[1], way[2] = way[2], way[1]
            tets.append(way)
    path.write_text(medit(points, tets))
    return path.name


def shipped(name, folder):
    """One of the four scenes; `bunny_rest` is the bunny until its pieces lie still."""
    scene = json.loads((TREE / "meshes/scenes" / f"{name.removesuffix('_rest')}.json").read_text())
    for body in scene["bodies"]:
        body["mesh"] = str((TREE / "meshes/scenes" / body["mesh"]).resolve())
    scene.pop("$schema", None)
    scene.pop("output", None)
    return scene


def monolith_bodies(name, folder):
    """The monolith with cubes of the balls' mass, volume and speed, which frames show, in their place."""
    scene, edge = shipped("monolith", folder), 0.18 * (4 * math.pi / 3) ** (1 / 3)
    mesh = box_mesh(folder / "cube.mesh", (3, 3, 3), (edge,) * 3)
    for ball in [o for o in scene["obstacles"] if o.get("mass")]:
        scene["obstacles"].remove(ball)
        scene["bodies"].append({"mesh": mesh, "translation": ball["sphere"]["center"], "velocity": ball["velocity"],
                                "material": {"density": ball["mass"] / edge ** 3, "tensile_strength": 1e15}})
    return scene


def meet(name, folder):
    """Two cubes meet off centre, turned and spinning, with friction."""
    mesh = box_mesh(folder / "cube.mesh", (3, 3, 3), (0.2,) * 3)
    made = {"young_modulus": 1e9, "poisson_ratio": 0.25, "density": 2000}
    return {"fracture": {"mode": "off"}, "gravity": {"acceleration": [0, 0, 0]}, "contact": {"friction": 0.5}, "bodies": [
        {"mesh": mesh, "material": made, "translation": [-0.15, 0, 0], "velocity": [1.5, 0.2, 0], "spin": [0, 1, 2]},
        {"mesh": mesh, "material": made, "translation": [0.15, 0.06, 0.04], "velocity": [-1.5, 0, 0.1],
         "rotation": {"axis": [1, 2, 3], "angle": 35}}]}


def burst(name, folder):
    """A cube that its own spin tears apart; pieces strike each other as they leave."""
    return {"gravity": {"acceleration": [0, 0, 0]}, "bodies": [
        {"mesh": box_mesh(folder / "cube.mesh", (4, 4, 4), (0.2,) * 3), "velocity": [0.3, -0.2, 0.5], "spin": [25, 15, 50],
         "material": {"young_modulus": 1e9, "poisson_ratio": 0.2, "density": 2400, "tensile_strength": 2e4}}]}


def pile(name, folder):
    """A box falls on its edge, shatters and comes to rest as a heap."""
    return {"obstacles": [{"plane": {"normal": [0, 0, 1]}, "friction": 0.5}], "bodies": [
        {"mesh": box_mesh(folder / "box.mesh", (5, 4, 3), (0.5, 0.4, 0.3)), "translation": [0, 0, 0.35], "velocity": [0, 0, -3],
         "rotation": {"axis": [1, 0.4, 0], "angle": 30},
         "material": {"young_modulus": 1e9, "poisson_ratio": 0.2, "density": 2400, "tensile_strength": 5e5}}]}


def stack(name, folder):
    """Boxes of 0.1 m on each other on a plane; `stack_5` has five."""
    mesh = box_mesh(folder / "cube.mesh", (2, 2, 2), (0.1,) * 3)
    return {"fracture": {"mode": "off"}, "obstacles": [{"plane": {"normal": [0, 0, 1]}}],
            "bodies": [{"mesh": mesh, "translation": [0, 0, 0.05 + 0.1 * k]} for k in range(int(name.split("_")[1]))]}


# Scene; s simulated, and with the finest steps; frames at most.
CASES = {"bar": (shipped, 0.4, 0.06, 600), "block": (shipped, 4.0, 1.8, 4000), "bunny": (shipped, 0.12, 0.025, 200),
         "monolith": (shipped, 0.8, 0.1, 1000), "monolith_bodies": (monolith_bodies, 0.8, 0.1, 1000),
         "meet": (meet, 0.4, 0.15, 1600), "burst": (burst, 0.3, 0.06, 800), "pile": (pile, 3.0, 0.3, 3000)}
# Run where they are named; only the end is of interest.
AT_LENGTH = {"block_rest": (shipped, 10.0, 10.0, 100), "monolith_rest": (shipped, 4.0, 4.0, 20),
             "bunny_rest": (shipped, 1.0, 1.0, 10)}
FINEST = 2e-4  # s
STACK_CASE = (stack, 10.0, 10.0, 200)


def write_scene(name, step, folder):
    make, long, short, frames = (CASES | AT_LENGTH).get(name, STACK_CASE)
    scene = make(name, folder)
    steps = max(1, math.ceil((short if step < FINEST else long) / step - 1e-9))
    scene |= {"name": name, "time_step": step, "duration": steps * step,
              "output": {"frame_interval": step * math.ceil(steps / frames)}}
    path = folder / "scene.json"
    path.write_text(json.dumps(scene, indent=1))
    return path


def warnings_of(folder):
    return sorted({w["code"] for w in json.loads((folder / "report.json").read_text()).get("warnings", [])})


def broken_laws(seen):
    found = []
    if max(seen.get("drift_P", 0), seen.get("drift_L", 0)) > MOMENTUM:
        found.append("momentum")
    if seen["judged_rise_share"] > RISE:
        found.append("energy")
    if seen["fastest"] <= AT_REST and max(seen["overlap_surface"], seen["in_obstacles"]) > OVERLAP:
        found.append("overlap")
    if abs(seen.get("top", 0)) > STACK:
        found.append("stack")
    return found


def judge(name, step, scene_path, folder):
    scene = json.loads(scene_path.read_text())
    seen, last, cells = judge_frames(scene, folder)
    if name.startswith("stack"):
        seen |= top_of(scene, folder, last, cells)
    warned, broken = warnings_of(folder), broken_laws(seen)
    silent = [law for law in broken if not set(TELLS[law]) & set(warned)]
    return {"case": name, "step_ms": 1e3 * step, **seen, "broken": " ".join(broken), "silent": " ".join(silent),
            "warnings": " ".join(warned)}


def top_of(scene, folder, last, cells):
    """How far the last box' centre is from where it was put, and from where it was after 1 s, over a box."""
    vertices = cells.vertices[max(cells.vertices)]
    now = centre(last.x, vertices, cells.mass)
    settled = next((f for f in frames_of(folder) if f.time >= 1), last)
    return {"top": math.dist(now, scene["bodies"][-1]["translation"]) / 0.1,
            "top_since_1s": math.dist(now, centre(settled.x, vertices, cells.mass)) / 0.1}


def run_case(said, name, step):
    folder = said.out / f"{name}_{1e3 * step:g}ms"
    folder.mkdir(parents=True, exist_ok=True)
    scene, begun = write_scene(name, step, folder), time.time()
    if not (said.keep and (folder / "out/report.json").exists()):
        done = subprocess.run([said.sunder, "run", scene, "-o", folder / "out", "--force", "--quiet"], capture_output=True, text=True)
        if done.returncode:
            return {"case": name, "step_ms": 1e3 * step, "broken": f"exit code {done.returncode}", "silent": "failed",
                    "warnings": done.stderr.strip().splitlines()[-1] if done.stderr else ""}
    ran = time.time()
    row = judge(name, step, scene, folder / "out")
    print(f"{name} {1e3 * step:g} ms: run {ran - begun:.0f} s, judged {time.time() - ran:.0f} s", file=sys.stderr, flush=True)
    return row


# ---- tables --------------------------------------------------------------------------------------

COLUMNS = {"case": "case", "step_ms": "step, ms", "seconds": "s", "frames": "frames", "pieces": "pieces",
           "passed_P": "P passed, N s",
           "drift_P": "drift of P", "drift_L": "drift of L", "most_J": "most, J", "rise_J": "rise, J", "rise_share": "rise / most",
           "judged_rise_share": "judged", "overlap": "overlap / edge", "overlap_surface": "to the surface",
           "in_obstacles": "in obstacles",
           "fastest": "fastest, m/s", "top": "top / box", "top_since_1s": "since 1 s", "broken": "broken",
           "silent": "and not told", "warnings": "warnings"}


def text_of(value):
    return "" if value is None else value if isinstance(value, str) else f"{value:.3g}"


def markdown(rows_):
    used = [k for k in COLUMNS if any(k in r for r in rows_)]
    lines = ["| " + " | ".join(COLUMNS[k] for k in used) + " |", "|" + "---|" * len(used)]
    for row in rows_:
        cells = {k: text_of(row.get(k)) for k in used}
        if row.get("weak") and "judged_rise_share" in cells:
            cells["judged_rise_share"] += " (weak)"
        lines.append("| " + " | ".join(cells[k] for k in used) + " |")
    return "\n".join(lines)


def write_csv(path, rows_):
    names = list(dict.fromkeys(k for row in rows_ for k in row))
    with path.open("w", newline="") as file:
        table = csv.DictWriter(file, names)
        table.writeheader()
        table.writerows(rows_)


def numbers(text):
    return [float(word) for word in text.split(",")]


def words():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name, steps in (("run", "0.1,1,4,16.7,33"), ("stack", "1,4,16.7")):
        one = commands.add_parser(name)
        one.add_argument("--steps", type=numbers, default=steps, help="ms, with commas")
        one.add_argument("--sunder", type=pathlib.Path, default=TREE / "build/release/sunder")
        one.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/laws"), help="scenes, frames and the CSV")
        one.add_argument("--keep", action="store_true", help="judge runs that are there already")
    commands.choices["run"].add_argument("cases", nargs="*", metavar="CASE", help=", ".join(CASES | AT_LENGTH))
    commands.choices["stack"].add_argument("--boxes", type=numbers, default="5,20")
    one = commands.add_parser("judge")
    one.add_argument("scene", type=pathlib.Path)
    one.add_argument("folder", type=pathlib.Path)
    return parser


def main():
    said = words().parse_args()
    if said.command == "judge":
        step = json.loads(said.scene.read_text())["time_step"]
        table = [judge(said.scene.stem, step, said.scene, said.folder)]
    else:
        names = said.cases or list(CASES) if said.command == "run" else [f"stack_{n:g}" for n in said.boxes]
        table = []
        for name, step in itertools.product(names, said.steps):
            table.append(run_case(said, name, step / 1e3))
            write_csv(said.out / f"{said.command}.csv", table)
    print(markdown(table))
    return 1 if any(row["silent"] for row in table) else 0


if __name__ == "__main__":
    sys.exit(main())
