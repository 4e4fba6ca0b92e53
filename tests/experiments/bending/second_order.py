#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Thin bodies by tetrahedra of first and second order, against theory and CalculiX on the same mesh.

    tests/experiments/bending/second_order.py SUNDER [--calculix]

Cantilevers (Timoshenko) and square plates, clamped or simply supported (Mindlin), of thickness ratio
1/20 and 1/100 with one and two layers of cells, under pressure on the upper face, by `sunder static`.
Prints deflection and stress at the middle (plates) or the deflection of the end (cantilevers) over
theory, and the time of the whole command. --calculix: the largest difference of a node's
displacement from C3D10's over the largest displacement (needs ccx). Needs python3-meshio.
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import meshio
import numpy

YOUNG, POISSON, PRESSURE = 7e10, 0.23, 1000.0
KUHN = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]
EDGES = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]  # CalculiX's middle nodes 5 to 10


def kuhn_cells(cells, points):
    """Tetrahedra of a block of (nx, ny, nz) cells with `points` x first, then y; diagonals
    alternate."""
    nx, ny, nz = cells

    def row(i, j, k):
        return i + (nx + 1) * (j + (ny + 1) * k)

    tetrahedra = []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                mirror = (i % 2, j % 2, k % 2)
                corner = [row(i + ((c & 1) ^ mirror[0]), j + ((c >> 1 & 1) ^ mirror[1]),
                              k + ((c >> 2) ^ mirror[2])) for c in range(8)]
                for a, b, c, d in KUHN:
                    t = [corner[a], corner[b], corner[c], corner[d]]
                    if numpy.linalg.det(points[t[1:]] - points[t[0]]) < 0:
                        t[2], t[3] = t[3], t[2]
                    tetrahedra.append(t)
    return numpy.array(tetrahedra)


def block(cells, size):
    """Points and tetrahedra of a block from the origin."""
    nx, ny, nz = cells
    points = numpy.array([(i * size[0] / nx, j * size[1] / ny, k * size[2] / nz)
                          for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)])
    return points, kuhn_cells(cells, points)


def scene(order, size, held):
    big = 1e3
    return {
        "gravity": {"acceleration": [0, 0, 0]},
        "bodies": [{
            "mesh": "body.msh", "order": order,
            "material": {"young_modulus": YOUNG, "poisson_ratio": POISSON, "density": 2500,
                         "tensile_strength": 1e12},
            "held": held,
            "loads": [{"minimum": [-big, -big, size[2] * (1 - 1e-9)], "maximum": [big, big, big],
                       "pressure": PRESSURE}],
        }],
    }


def box(size, axis, high, axes=None):
    """A held box round one side of a block."""
    minimum, maximum = [-1e3] * 3, [1e3] * 3
    if high:
        minimum[axis] = size[axis] * (1 - 1e-9)
    else:
        maximum[axis] = size[axis] * 1e-9
    held = {"minimum": minimum, "maximum": maximum}
    if axes:
        held["axes"] = axes
    return held


def solve(sunder, folder, order, size, held):
    """Displacements and node stresses (xx yy zz xy yz xz) at all nodes, their places, seconds."""
    (folder / "scene.json").write_text(json.dumps(scene(order, size, held)))
    began = time.time()
    subprocess.run([sunder, "static", folder / "scene.json", "-o", folder / "out.vtu", "--json"],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seconds = time.time() - began
    out = meshio.read(folder / "out.vtu")
    u = out.point_data["displacement"]
    return out.points - u, u, out.point_data["node_stress"], seconds


def calculix(folder, points, tetrahedra, size, held):
    """Places and displacements of C3D10 on the same mesh."""
    middle, places, elements = {}, list(map(tuple, points)), []
    for t in tetrahedra:
        nodes = list(t)
        for i, j in EDGES:
            key = (min(t[i], t[j]), max(t[i], t[j]))
            if key not in middle:
                middle[key] = len(places)
                places.append(tuple(0.5 * (points[t[i]] + points[t[j]])))
            nodes.append(middle[key])
        elements.append(nodes)
    places = numpy.array(places)
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{n + 1}, {x:.12g}, {y:.12g}, {z:.12g}" for n, (x, y, z) in enumerate(places)]
    lines.append("*ELEMENT, TYPE=C3D10, ELSET=EALL")
    lines += [", ".join(str(n + 1) for n in [e, *nodes]) for e, nodes in enumerate(elements)]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", f"{YOUNG}, {POISSON}",
              "*SOLID SECTION, ELSET=EALL, MATERIAL=M", "*BOUNDARY"]
    for b in held:
        inside = ((places >= b["minimum"]) & (places <= b["maximum"])).all(axis=1)
        for n in numpy.flatnonzero(inside):
            lines += [f"{n + 1}, {'xyz'.index(a) + 1}" for a in b.get("axes", "xyz")]
    lines += ["*STEP", "*STATIC", "*DLOAD"]
    faces = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]
    top = points[:, 2] > size[2] * (1 - 1e-9)
    for e, t in enumerate(tetrahedra):
        lines += [f"{e + 1}, P{f + 1}, {PRESSURE}" for f, face in enumerate(faces)
                  if all(top[t[k]] for k in face)]
    lines += ["*NODE PRINT, NSET=ALL", "U", "*END STEP", ""]
    (folder / "body.inp").write_text("\n".join(lines))
    subprocess.run(["ccx", "body"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    rows = [line.split() for line in (folder / "body.dat").read_text().splitlines()]
    u = numpy.array([[float(n) for n in row[1:]] for row in rows if len(row) == 4 and row[0].isdigit()])
    return places, u


def value_at(places, values, where):
    return values[numpy.argmin(((places - where) ** 2).sum(axis=1))]


def stiffness(t):
    return YOUNG * t ** 3 / (12 * (1 - POISSON ** 2)), 5 / 6 * YOUNG / (2 * (1 + POISSON)) * t


def simply_supported(a, t):
    """Deflection and stress at the middle of a square plate of Mindlin, hard supports: Navier's series."""
    D, S = stiffness(t)
    w = moment = 0.0
    for m in range(1, 400, 2):
        for n in range(1, 400, 2):
            k = (m * m + n * n) * (math.pi / a) ** 2
            q = 16 * PRESSURE / (math.pi ** 2 * m * n) * math.sin(m * math.pi / 2) * math.sin(n * math.pi / 2)
            w += q / (D * k * k) * (1 + D * k / S)
            moment += q * (m * m + POISSON * n * n) * (math.pi / a) ** 2 / (k * k)
    return w, 6 * moment / t ** 2


def clamped(a, t):
    """The same clamped, by Rayleigh and Ritz with products of Legendre polynomials for w and both turns."""
    D, S = stiffness(t)
    order = 13
    x, weight = numpy.polynomial.legendre.leggauss(40)
    bubble = [numpy.polynomial.Polynomial([1, 0, -1]) * numpy.polynomial.legendre.Legendre.basis(k)
              .convert(kind=numpy.polynomial.Polynomial) for k in range(order)]
    f = numpy.array([p(x) for p in bubble])
    d = numpy.array([p.deriv()(x) for p in bubble]) * 2 / a
    w1 = weight * a / 2
    M, K, C = (f * w1) @ f.T, (d * w1) @ d.T, (d * w1) @ f.T
    kron = numpy.kron
    n = order * order
    A = numpy.zeros((3 * n, 3 * n))
    half = (1 - POISSON) / 2
    W, X, Y = slice(0, n), slice(n, 2 * n), slice(2 * n, 3 * n)
    A[W, W] = S * (kron(K, M) + kron(M, K))
    A[X, X] = D * (kron(K, M) + half * kron(M, K)) + S * kron(M, M)
    A[Y, Y] = D * (kron(M, K) + half * kron(K, M)) + S * kron(M, M)
    A[W, X] = -S * kron(C, M)
    A[W, Y] = -S * kron(M, C)
    A[X, Y] = D * (POISSON * kron(C, C.T) + half * kron(C.T, C))
    A[X, W], A[Y, W], A[Y, X] = A[W, X].T, A[W, Y].T, A[X, Y].T
    load = numpy.zeros(3 * n)
    load[W] = PRESSURE * kron(f @ w1, f @ w1)
    q = numpy.linalg.solve(A, load)
    at = numpy.array([p(0.0) for p in bubble])
    slope = numpy.array([p.deriv()(0.0) for p in bubble]) * 2 / a
    w = q[W] @ kron(at, at)
    moment = D * (q[X] @ kron(slope, at) + POISSON * (q[Y] @ kron(at, slope)))
    return w, 6 * abs(moment) / t ** 2


def cantilever(length, t):
    inertia, shear = t ** 3 / 12, 5 / 6 * YOUNG / (2 * (1 + POISSON)) * t
    return PRESSURE * length ** 4 / (8 * YOUNG * inertia) + PRESSURE * length ** 2 / (2 * shear)


def cases():
    plate = (1.0, 1.0, 0.05)
    sides = [(axis, high) for axis in (0, 1) for high in (False, True)]
    for layers in (1, 2):
        yield ("clamped plate 1/20, finer", layers, plate, (16, 16, layers), [box(plate, *s) for s in sides],
               (0.5, 0.5, 0.0), clamped(1, 0.05))
    for ratio in (20, 100):
        t = 1 / ratio
        across = round(ratio / 2.5) if ratio < 100 else 34  # cells of at most 3 t
        across += across % 2
        for layers in (1, 2):
            beam = (1.0, 0.04, t) if ratio == 20 else (1.0, 0.02, t)
            yield (f"cantilever 1/{ratio}", layers, beam, (across, 1, layers),
                   [box(beam, 0, False)], (1.0, 0.5 * beam[1], 0.5 * t), (cantilever(1, t), None))
            plate = (1.0, 1.0, t)
            yield (f"clamped plate 1/{ratio}", layers, plate, (across, across, layers),
                   [box(plate, *s) for s in sides], (0.5, 0.5, 0.0), clamped(1, t))
            yield (f"supported plate 1/{ratio}", layers, plate, (across, across, layers),
                   [box(plate, *s, ["y", "z"] if s[0] == 0 else ["x", "z"]) for s in sides],
                   (0.5, 0.5, 0.0), simply_supported(1, t))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("sunder", type=lambda p: Path(p).resolve())
    parser.add_argument("--calculix", action="store_true")
    arguments = parser.parse_args()
    print("| body | layers | cells | deflection, 1 | 2 | stress, 1 | 2 | s, 1 | 2 | C3D10 |\n"
          "|---|---|---|---|---|---|---|---|---|---|")
    for name, layers, size, cells, held, where, (deflection, stress) in cases():
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            points, tetrahedra = block(cells, size)
            meshio.write(folder / "body.msh", meshio.Mesh(points, [("tetra", tetrahedra)]), "gmsh22")
            row = {}
            for order in (1, 2):
                places, u, node_stress, seconds = solve(arguments.sunder, folder, order, size, held)
                w = abs(value_at(places, u, where)[2]) / deflection
                s = abs(value_at(places, node_stress, where)[0]) / stress if stress else None
                row[order] = (w, s, seconds)
            off = ""
            if arguments.calculix:
                theirs, their_u = calculix(folder, points, tetrahedra, size, held)
                ours = {tuple(numpy.round(p, 9)): d for p, d in zip(places, u)}
                worst = max(numpy.abs(ours[tuple(numpy.round(p, 9))] - d).max() for p, d in zip(theirs, their_u))
                off = f"{worst / numpy.abs(their_u).max():.1e}"
            text = ["" if v is None else f"{v:.3f}" for k in (0, 1) for v in (row[1][k], row[2][k])]
            print(f"| {name} | {layers} | {len(tetrahedra)} | " + " | ".join(text) +
                  f" | {row[1][2]:.2f} | {row[2][2]:.2f} | {off} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
