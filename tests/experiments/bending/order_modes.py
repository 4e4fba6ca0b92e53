# SPDX-License-Identifier: MIT
"""Natural frequencies of order_charts.py: stiffness and masses made here, CalculiX, beams and plates."""
import json
import subprocess

import numpy
import scipy.linalg
import scipy.sparse

from order_tools import percent, quadratic, table, timed, write_mesh
from second_order import EDGES, POISSON, YOUNG, block, box

DENSITY = 2500.0
MATERIAL = {"young_modulus": YOUNG, "poisson_ratio": POISSON, "density": DENSITY, "tensile_strength": 1e9}
FACTORIAL = [1, 1, 2, 6, 24]


def moment(powers):
    """Mean over a tetrahedron of a product of powers of its barycentric coordinates."""
    top = 1
    for p in powers:
        top *= FACTORIAL[p]
    bottom = 1.0
    for k in range(4, sum(powers) + 4):
        bottom *= k
    return top / bottom


def shapes():
    """The ten shape functions as polynomials {powers of barycentric coordinates: factor}."""
    found = []
    for i in range(4):
        one, two = [0] * 4, [0] * 4
        one[i], two[i] = 1, 2
        found.append({tuple(two): 2.0, tuple(one): -1.0})
    for i, j in EDGES:
        power = [0] * 4
        power[i] = power[j] = 1
        found.append({tuple(power): 4.0})
    return found


def consistent_mass():
    """Shares of a cell's mass: mean of N_i N_j."""
    N = shapes()
    return numpy.array([[sum(a * b * moment([x + y for x, y in zip(p, q)]) for p, a in n.items()
                             for q, b in m.items()) for m in N] for n in N])


GAUSS = [[0.5854101966249685 if i == k else 0.1381966011250105 for i in range(4)] for k in range(4)]


def four_point_mass():
    """The same by the four points of the stiffness, as CalculiX has it in C3D10."""
    N = numpy.array([[L[i] * (2 * L[i] - 1) for i in range(4)] + [4 * L[i] * L[j] for i, j in EDGES] for L in GAUSS])
    return N.T @ N / 4


HRZ = numpy.array([1 / 36] * 4 + [4 / 27] * 6)


def matrices(places, cells, mass):
    """Stiffness, mass by shares of a cell's (10 x 10) and HRZ's diagonal (a number a degree of freedom) of ten-node
    cells."""
    lame = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
    shear = YOUNG / (2 * (1 + POISSON))
    D = numpy.diag([2 * shear] * 3 + [shear] * 3)
    D[:3, :3] += lame
    rows, cols, stiff, heavy = [], [], [], []
    lumped = numpy.zeros(len(places))
    for cell in cells:
        x = places[cell[:4]]
        volume = numpy.linalg.det(x[1:] - x[0]) / 6
        gradient = numpy.linalg.inv(numpy.vstack([numpy.ones(4), x.T]))[:, 1:]  # of barycentric coordinates
        K = numpy.zeros((30, 30))
        for L in GAUSS:
            dN = [(4 * L[i] - 1) * gradient[i] for i in range(4)]
            dN += [4 * (L[i] * gradient[j] + L[j] * gradient[i]) for i, j in EDGES]
            B = numpy.zeros((6, 30))
            for n, (gx, gy, gz) in enumerate(dN):
                B[:, 3 * n:3 * n + 3] = [[gx, 0, 0], [0, gy, 0], [0, 0, gz], [gy, gx, 0], [0, gz, gy], [gz, 0, gx]]
            K += volume / 4 * B.T @ D @ B
        dof = (3 * numpy.asarray(cell)[:, None] + numpy.arange(3)).ravel()
        r, c = numpy.meshgrid(dof, dof, indexing="ij")
        rows.append(r.ravel())
        cols.append(c.ravel())
        stiff.append(K.ravel())
        heavy.append(numpy.kron(DENSITY * volume * mass, numpy.eye(3)).ravel())
        lumped[cell] += DENSITY * volume * HRZ
    n = 3 * len(places)
    where = (numpy.concatenate(rows), numpy.concatenate(cols))
    return (scipy.sparse.csc_matrix((numpy.concatenate(stiff), where), (n, n)),
            scipy.sparse.csc_matrix((numpy.concatenate(heavy), where), (n, n)), numpy.repeat(lumped, 3))


def dense_frequencies(K, M, free, count):
    values = scipy.linalg.eigh(K[free][:, free].toarray(), M[free][:, free].toarray(), eigvals_only=True)
    return numpy.sqrt(numpy.maximum(values[:count], 0)) / (2 * numpy.pi)


def free_of(places, held):
    fixed = numpy.zeros(len(places), bool)
    for b in held:
        fixed |= ((places >= b["minimum"]) & (places <= b["maximum"])).all(axis=1)
    return numpy.flatnonzero(numpy.repeat(~fixed, 3))


def sunder_frequencies(sunder, folder, order, held, count=10):
    scene = {"bodies": [{"mesh": "body.mesh", "order": order, "material": MATERIAL, "held": held}]}
    (folder / "scene.json").write_text(json.dumps(scene))
    text, seconds, _ = timed([sunder, "modes", folder / "scene.json", "--json", "--count", str(count)])
    piece = json.loads(text)["pieces"][0]
    return numpy.array(piece["frequencies"][piece["rigid_modes"]:][:count]), seconds


def calculix_frequencies(folder, places, cells, held, count=10):
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{n + 1}, {x:.15g}, {y:.15g}, {z:.15g}" for n, (x, y, z) in enumerate(places)]
    lines.append("*ELEMENT, TYPE=C3D10, ELSET=EALL")
    lines += [", ".join(str(n + 1) for n in [e, *nodes]) for e, nodes in enumerate(cells)]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", f"{YOUNG}, {POISSON}", "*DENSITY", f"{DENSITY}",
              "*SOLID SECTION, ELSET=EALL, MATERIAL=M", "*BOUNDARY"]
    for b in held:
        inside = ((places >= b["minimum"]) & (places <= b["maximum"])).all(axis=1)
        lines += [f"{n + 1}, 1, 3" for n in numpy.flatnonzero(inside)]
    lines += ["*STEP", "*FREQUENCY", str(count), "*NODE FILE", "U", "*END STEP", ""]
    (folder / "body.inp").write_text("\n".join(lines))
    subprocess.run(["ccx", "body"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    found = []
    for line in (folder / "body.dat").read_text().splitlines():
        words = line.split()
        if len(words) == 5 and words[0] == str(len(found) + 1) and len(found) < count:
            found.append(numpy.sqrt(float(words[1])) / (2 * numpy.pi))
    return numpy.array(found)


def exact(sunder, folder, _):
    """Small meshes of irregular cells: largest difference of the first ten frequencies of `sunder modes` from K and
    HRZ's M made here, and of CalculiX from K with the mass by four points and with the exact consistent one."""
    rows = []
    for name, cells, size, clamped in (("cantilever", (5, 1, 1), (1.0, 0.06, 0.05), True),
                                       ("cantilever, two layers", (4, 2, 2), (1.0, 0.12, 0.1), True),
                                       ("free bar", (4, 1, 1), (1.0, 0.12, 0.1), False)):
        points, tetrahedra = block(cells, size)
        inside = ((points > 1e-9) & (points < numpy.array(size) - 1e-9)).any(axis=1)
        random = numpy.random.default_rng(1)
        points[inside, 0] += 0.03 * random.uniform(-1, 1, inside.sum()) * (points[inside, 0] > 1e-9) * (
            points[inside, 0] < size[0] - 1e-9)
        write_mesh(folder / "body.mesh", points, tetrahedra)
        held = [box(size, 0, False)] if clamped else []
        places, ten = quadratic(points, tetrahedra)
        K, four, lumped = matrices(places, ten, four_point_mass())
        _, consistent, _ = matrices(places, ten, consistent_mass())
        free = free_of(places, held)
        skip = 0 if clamped else 6
        own = dense_frequencies(K, scipy.sparse.diags(lumped, format="csc"), free, 10 + skip)[skip:]
        ours, _ = sunder_frequencies(sunder, folder, 2, held)
        row = [name, str(len(tetrahedra)), f"{numpy.abs(ours / own - 1).max():.1e}"]
        if clamped:
            theirs = calculix_frequencies(folder, places, ten, held)
            row += [f"{numpy.abs(dense_frequencies(K, M, free, 10) / theirs - 1).max():.1e}"
                    for M in (four, consistent)]
        else:
            row += ["", ""]
        rows.append(row)
        print(rows[-1], flush=True)
    return table(["body", "cells", "Sunder from K and HRZ's M made here", "CalculiX from K and M by four points",
                  "CalculiX from K and the consistent M"], rows), None


def ritz(length, order, clamped, parts):
    """Frequencies of a line or plate by Rayleigh and Ritz: `parts(f, d, w)` gives stiffness and mass from values and
    derivatives of the functions at points of weight w."""
    x, weight = numpy.polynomial.legendre.leggauss(60)
    factor = numpy.polynomial.Polynomial([1, 1] if clamped == "one" else [1, 0, -1] if clamped == "both" else [1])
    functions = [factor * numpy.polynomial.legendre.Legendre.basis(k).convert(kind=numpy.polynomial.Polynomial)
                 for k in range(order)]
    f = numpy.array([p(x) for p in functions])
    d = numpy.array([p.deriv()(x) for p in functions]) * 2 / length
    K, M = parts(f, d, weight * length / 2)
    values = scipy.linalg.eigh(K, M, eigvals_only=True)
    return numpy.sqrt(numpy.maximum(values, 0)) / (2 * numpy.pi)


def timoshenko(length, depth, clamped):
    """Bending of a beam of rectangular section, one plane; shear factor 10 (1 + nu) / (12 + 11 nu) (Cowper)."""
    kappa = 10 * (1 + POISSON) / (12 + 11 * POISSON)
    S, D, rho, turn = (kappa * YOUNG / (2 * (1 + POISSON)) * depth, YOUNG * depth ** 3 / 12, DENSITY * depth,
                       DENSITY * depth ** 3 / 12)

    def parts(f, d, w):
        FF, DD, FD = (f * w) @ f.T, (d * w) @ d.T, (d * w) @ f.T
        zero = numpy.zeros_like(FF)
        return (numpy.block([[S * DD, -S * FD], [-S * FD.T, D * DD + S * FF]]),
                numpy.block([[rho * FF, zero], [zero, turn * FF]]))
    return ritz(length, 16, clamped, parts)


def beam_theory(length, width, depth, clamped, count=10):
    """The lowest frequencies of a bar: bending in both planes, twist (Saint-Venant), stretch; named."""
    mode = "one" if clamped else "none"
    rigid = 0 if clamped else 2
    found = [(f, "bending") for d in (width, depth) for f in timoshenko(length, d, mode)[rigid:rigid + 8]]
    a, b = max(width, depth), min(width, depth)
    series = sum(numpy.tanh(n * numpy.pi * a / (2 * b)) / n ** 5 for n in range(1, 99, 2))
    J = a * b ** 3 / 3 * (1 - 192 * b / (numpy.pi ** 5 * a) * series)
    polar = a * b * (a * a + b * b) / 12
    for name, c in (("twist", numpy.sqrt(YOUNG / (2 * (1 + POISSON)) * J / (DENSITY * polar))),
                    ("stretch", numpy.sqrt(YOUNG / DENSITY))):
        found += [((2 * n + 1) * c / (4 * length) if clamped else (n + 1) * c / (2 * length), name) for n in range(4)]
    return sorted(found)[:count]


def plate_theory(side, depth, count=10):
    """The lowest frequencies of a square plate of Mindlin, clamped all round."""
    S, D = 5 / 6 * YOUNG / (2 * (1 + POISSON)) * depth, YOUNG * depth ** 3 / (12 * (1 - POISSON ** 2))
    rho, turn, half = DENSITY * depth, DENSITY * depth ** 3 / 12, (1 - POISSON) / 2

    def parts(f, d, w):
        FF, DD, FD = (f * w) @ f.T, (d * w) @ d.T, (d * w) @ f.T
        k = numpy.kron
        mm = k(FF, FF)
        zero = numpy.zeros_like(mm)
        XY = D * (POISSON * k(FD, FD.T) + half * k(FD.T, FD))
        K = numpy.block([[S * (k(DD, FF) + k(FF, DD)), -S * k(FD, FF), -S * k(FF, FD)],
                         [-S * k(FD, FF).T, D * (k(DD, FF) + half * k(FF, DD)) + S * mm, XY],
                         [-S * k(FF, FD).T, XY.T, D * (k(FF, DD) + half * k(DD, FF)) + S * mm]])
        return K, numpy.block([[rho * mm, zero, zero], [zero, turn * mm, zero], [zero, zero, turn * mm]])
    return [(f, "bending") for f in ritz(side, 11, "both", parts)[:count]]


def modes(sunder, folder, _):
    """The lowest frequencies over theory's, by rank, as far as ranks are those of theory: orders 1 and 2, and C3D10
    with its own mass."""
    lines = []
    beam, plate = (1.0, 0.08, 0.05), (0.3, 0.3, 0.006)
    sides = [box(plate, axis, high) for axis in (0, 1) for high in (False, True)]
    for name, size, held, theory, grids in (  # left out: twists of order 2, which lie lower
            ("cantilever, 1 x 0.08 x 0.05 m", beam, [box(beam, 0, False)], beam_theory(*beam, True)[:9],
             ((8, 1, 1), (16, 1, 1), (32, 2, 2))),
            ("free bar, the same", beam, [], beam_theory(*beam, False)[:8], ((8, 1, 1), (16, 1, 1), (32, 2, 2))),
            ("clamped pane, 0.3 x 0.3 x 0.006 m", plate, sides, plate_theory(0.3, 0.006),
             ((12, 12, 1), (20, 20, 1), (32, 32, 1)))):
        columns, head = [], []
        for cells in grids:
            points, tetrahedra = block(cells, size)
            write_mesh(folder / "body.mesh", points, tetrahedra)
            for order in (1, 2):
                found, seconds = sunder_frequencies(sunder, folder, order, held)
                columns.append(found)
                head.append(f"order {order}, {len(tetrahedra)} cells ({seconds:.2f} s)")
                print(name, cells, order, seconds, found, flush=True)
            if held:
                columns.append(calculix_frequencies(folder, *quadratic(points, tetrahedra), held))
                head.append("C3D10, the same")
                print(name, cells, "ccx", columns[-1], flush=True)
        rows = [[str(k + 1), what, f"{f:.1f}", *(percent(c[k], f) for c in columns)]
                for k, (f, what) in enumerate(theory)]
        lines += table([name, "kind", "theory, Hz", *(h + ", % off" for h in head)], rows)
    return lines, None
