#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""`sunder static` on bodies refined by `sunder refine`, against closed forms.

    tests/experiments/cells/convergence.py [--levels 3] [--sunder build/release/sunder] [--check]

hanging  a column with rolling sides and a held top, under its weight:
         u = -rho g (L^2 - z^2) / (2 M), M = E (1 - nu) / ((1 + nu) (1 - 2 nu)), stress rho g z
         along z and nu / (1 - nu) of it across. The mesh is a box with its inner points moved at
         random.
sphere   an octant of a thick-walled sphere under pressure from within (Lame). It is made of a body between two parallel
         triangles, which is refined; then every point is moved along its ray so that x + y + z becomes its radius.

A line per level: tetrahedra; errors relative to the closed form of the strain energy, of the
displacement and of the node stress (root of the mean square over all vertices, weighed by volume,
over that of the closed form), and the order of each: log2 of the error before over this one.
--check: exit code 1 unless orders of the last level are those of linear tetrahedra: 2, 2, and at
least 1. Needs python3-meshio and python3-numpy (Debian)."""
import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile

import meshio
import numpy as np

TREE = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(TREE / "meshes/scenes/charts"))
from make_meshes import box, medit

E, NU, RHO, G = 2e9, 0.3, 1000.0, 9.81


def held(axis, low, high):
    """A box that holds everything between two planes along their axis."""
    minimum, maximum = [-9] * 3, [9] * 3
    minimum[axis], maximum[axis] = low, high
    return {"minimum": minimum, "maximum": maximum, "axes": ["xyz"[axis]]}


class Hanging:
    length, side = 1.0, 0.5

    def mesh(self):
        points, cells = box((2, 2, 4), (0, 0, 0), (self.side, self.side, self.length))
        draw, size = random.Random(5), (self.side, self.side, self.length)
        inside = lambda p: all(1e-9 < x < s - 1e-9 for x, s in zip(p, size))
        return [tuple(x + (draw.random() - 0.5) * 0.1 for x in p) if inside(p) else p for p in points], cells

    def place(self, points):
        return points

    def scene(self):
        tiny = 1e-9
        rolls = [held(a, x - tiny, x + tiny) for a in (0, 1) for x in (0, self.side)]
        return {"held": rolls + [held(2, self.length - tiny, self.length + tiny)]}, [0, 0, -G]

    def exact(self, x):
        m = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
        u, stress = np.zeros_like(x), np.zeros((len(x), 3, 3))
        u[:, 2] = -RHO * G * (self.length ** 2 - x[:, 2] ** 2) / (2 * m)
        stress[:, 2, 2] = RHO * G * x[:, 2]
        stress[:, 0, 0] = stress[:, 1, 1] = NU / (1 - NU) * stress[:, 2, 2]
        return u, stress, self.side ** 2 * (RHO * G) ** 2 * self.length ** 3 / (6 * m)


class Sphere:
    inner, outer, pressure = 1.0, 2.0, 1e6

    def mesh(self, n=2, layers=2):
        """Layers x + y + z = const, triangles of each with n edges a side."""
        grid = [(i, j, n - i - j) for i in range(n + 1) for j in range(n + 1 - i)]
        row = {p: r for r, p in enumerate(grid)}
        points = [tuple(s * c / n for c in p) for k in range(layers + 1)
                  for s in [self.inner + (self.outer - self.inner) * k / layers] for p in grid]
        cells = []
        triangles = [(row[i, j, n - i - j], row[i + 1, j, n - i - j - 1], row[i, j + 1, n - i - j - 1])
                     for i in range(n) for j in range(n - i)]
        triangles += [(row[i + 1, j, n - i - j - 1], row[i + 1, j + 1, n - i - j - 2], row[i, j + 1, n - i - j - 1])
                      for i in range(n - 1) for j in range(n - 1 - i)]
        for k in range(layers):
            for t in triangles:
                a, b, c = sorted(t)
                low, high = k * len(grid), (k + 1) * len(grid)
                for cell in ([a + low, b + low, c + low, c + high], [a + low, b + low, b + high, c + high],
                             [a + low, a + high, b + high, c + high]):
                    x = np.array([points[p] for p in cell])
                    if np.linalg.det(x[1:] - x[0]) < 0:
                        cell[2], cell[3] = cell[3], cell[2]
                    cells.append(tuple(cell))
        return points, cells

    def place(self, points):
        return points * (points.sum(axis=1) / np.linalg.norm(points, axis=1))[:, None]

    def scene(self):
        inside = self.inner * (1 + 1e-9)
        load = {"minimum": [-9] * 3, "maximum": [inside] * 3, "pressure": self.pressure}
        return {"held": [held(a, -9, 1e-9) for a in range(3)], "loads": [load]}, [0, 0, 0]

    def exact(self, x):
        a, b, p = self.inner, self.outer, self.pressure
        r = np.linalg.norm(x, axis=1)
        n = x / r[:, None]
        c = p * a ** 3 / (b ** 3 - a ** 3)
        radial = lambda s: c * ((1 - 2 * NU) * s / E + (1 + NU) * b ** 3 / (2 * E * s ** 2))
        along, across = c * (1 - b ** 3 / r ** 3), c * (1 + b ** 3 / (2 * r ** 3))
        nn = n[:, :, None] * n[:, None, :]
        stress = across[:, None, None] * np.eye(3) + (along - across)[:, None, None] * nn
        return radial(r)[:, None] * n, stress, 0.5 * p * np.pi / 2 * a ** 2 * radial(a)


def run(program, *words):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, words))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def level_of(program, case, coarse, level, folder):
    """(tetrahedra, errors of energy, displacement, stress)."""
    fine, frame, scene = folder / f"fine{level}.mesh", folder / "frame.vtu", folder / "scene.json"
    if level > 0:
        run(program, "refine", coarse, fine, "--levels", level)
    else:
        fine = coarse
    mesh = meshio.read(fine)
    points = case.place(mesh.points)
    cells = mesh.cells_dict["tetra"]
    placed = folder / "placed.mesh"
    placed.write_text(medit([tuple(map(float, p)) for p in points], cells.tolist()))
    body, gravity = case.scene()
    body.update(mesh=str(placed), material={"young_modulus": E, "poisson_ratio": NU, "density": RHO, "tensile_strength": 1e12})
    scene.write_text(json.dumps({"bodies": [body], "gravity": {"acceleration": gravity}}))
    answer = json.loads(run(program, "static", scene, "-o", frame, "--json"))
    out = meshio.read(frame)
    u = np.asarray(out.point_data["displacement"])
    x = np.asarray(out.points) - u
    stress = np.asarray(out.point_data["node_stress"])
    stress = stress[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(len(x), 3, 3)  # xx yy zz xy yz xz
    exact_u, exact_stress, energy = case.exact(x)
    t = out.cells_dict["tetra"]
    volume = np.abs(np.linalg.det(x[t[:, 1:]] - x[t[:, :1]])) / 6
    weight = np.zeros(len(x))
    for i in range(4):
        np.add.at(weight, t[:, i], volume / 4)
    of = lambda a: np.sqrt((weight * (a.reshape(len(x), -1) ** 2).sum(axis=1)).sum())
    return len(t), [abs(answer["strain_energy"] / energy - 1), of(u - exact_u) / of(exact_u),
                    of(stress - exact_stress) / of(exact_stress)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--levels", type=int, default=3)
    parser.add_argument("--sunder", default=str(TREE / "build/release/sunder"))
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    right = True
    for case in (Hanging(), Sphere()):
        print(f"{type(case).__name__.lower()}\nlevel tetrahedra     energy  order  displacement  order  node stress  order")
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            coarse = folder / "coarse.mesh"
            coarse.write_text(medit(*case.mesh()))
            before = None
            for level in range(arguments.levels + 1):
                count, errors = level_of(arguments.sunder, case, coarse, level, folder)
                orders = [np.log2(b / e) for b, e in zip(before, errors)] if before else [np.nan] * 3
                print(f"{level:5} {count:10} {errors[0]:10.3e} {orders[0]:6.2f} {errors[1]:13.3e} {orders[1]:6.2f} "
                      f"{errors[2]:12.3e} {orders[2]:6.2f}", flush=True)
                before = errors
            right &= orders[0] > 1.8 and orders[1] > 1.8 and orders[2] > 0.95
    return 0 if right or not arguments.check else 1


if __name__ == "__main__":
    sys.exit(main())
