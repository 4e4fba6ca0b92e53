# SPDX-License-Identifier: MIT
"""Statics of order_charts.py: cantilever, clamped pane, three-point bending; Kirsch, Lame, torsion."""
import math
import statistics
import subprocess

import meshio
import numpy

from order_tools import BIG, grid, held_box, median_of, percent, solve_static, step_seconds, steps_for, table, write_mesh
from second_order import clamped as mindlin_clamped
from second_order import POISSON as NU
from second_order import PRESSURE, YOUNG, block, box, cantilever as timoshenko_end

MATERIAL = {"young_modulus": YOUNG, "poisson_ratio": NU, "density": 2500, "tensile_strength": 1e9}


def scene_of(order, held, loads, material=MATERIAL, duration=1.0):
    return {"gravity": {"acceleration": [0, 0, 0]}, "duration": duration, "fracture": {"mode": "off"},
            "bodies": [{"mesh": "body.mesh", "order": order, "material": material, "held": held, "loads": loads}]}


def top_pressure(size, pressure=PRESSURE):
    return [{"minimum": [-BIG, -BIG, size[2] * (1 - 1e-9)], "maximum": [BIG] * 3, "pressure": pressure}]


def nearest(nodes, where):
    rest, u, stress = nodes
    n = numpy.argmin(((rest - where) ** 2).sum(axis=1))
    return u[n], stress[n]


def cantilever_case(order, layers):
    """L/t = 20, pressure above: end's deflection; stress of the lower side from 0.15 to 0.45 of the
    length."""
    size = (1.0, 0.05, 0.05)
    across = max(8, round(20 * layers / (2.5 if order == 2 else 2.0)))
    across += across % 4 and 4 - across % 4
    mesh = block((across, max(1, layers), layers), size)
    exact = timoshenko_end(size[0], size[2])

    def seen(answer):
        nodes = answer["nodes"]
        w = abs(nearest(nodes, (size[0], size[1] / 2, size[2] / 2))[0][2])
        x = nodes[0][:, 0]
        low = (x > 0.15) & (x < 0.45) & (nodes[0][:, 2] < 1e-9)
        theory = 3 * PRESSURE * (size[0] - x[low]) ** 2 / size[2] ** 2
        return w, (-nodes[2][low, 0] / theory).mean()
    return mesh, scene_of(order, [box(size, 0, False)], top_pressure(size)), seen, exact, 1.0


def pane_case(order, layers):
    """0.3 x 0.3 x 0.006 m, clamped at its four sides: deflection and stress at the middle of the lower side."""
    size = (0.3, 0.3, 0.006)
    across = {1: {1: 24, 2: 36, 4: 68}, 2: {1: 20, 2: 24}}[order][layers]
    exact = mindlin_clamped(size[0], size[2])

    def seen(answer):
        nodes = answer["nodes"]
        u, stress = nearest(nodes, (0.15, 0.15, 0.0))
        return abs(u[2]), stress[0]
    sides = [box(size, axis, high) for axis in (0, 1) for high in (False, True)]
    return block((across, across, layers), size), scene_of(order, sides, top_pressure(size)), seen, *exact


def three_point_case(order, layers):
    """L/h = 9, a line of forces above the middle: deflection below it over Timoshenko's, and the stress there over
    3 F L / (2 b h^2) less the part of the line (0.27 F / (b h), von Karman and Seewald)."""
    length, width, height, force = 0.4, 0.02, 0.04, 1000.0
    cells = (40 if layers < 3 else 20 * layers, max(1, layers // 2), layers)
    left, right, middle = 0.02, 0.38, 0.2
    h = length / cells[0]
    left, right = round(left / h) * h, length - round(left / h) * h
    span = right - left

    def line(x, z, axes):
        return held_box((x - 1e-6, None, z - 1e-9), (x + 1e-6, None, z + 1e-9), axes)
    held = [line(left, 0, "z"), line(right, 0, "z"),
            held_box((middle - 1e-6, None, None), (middle + 1e-6, None, None), "x"),
            held_box((None, -1e-9, None), (None, 1e-9, None), "y")]
    loads = [{"minimum": [middle - 1e-6, -BIG, height - 1e-9], "maximum": [middle + 1e-6, BIG, height + 1e-9],
              "force": [0, 0, -force]}]
    inertia, shear = width * height ** 3 / 12, 5 / 6 * YOUNG / (2 * (1 + NU)) * width * height
    w = force * span ** 3 / (48 * YOUNG * inertia) + force * span / (4 * shear)
    stress = 1.5 * force * span / (width * height ** 2) - 0.27 * force / (width * height)

    def seen(answer):
        nodes = answer["nodes"]
        low = (abs(nodes[0][:, 0] - middle) < 1e-6) & (abs(nodes[0][:, 2]) < 1e-9)
        return abs(nodes[1][low, 2].mean()), nodes[2][low, 0].mean()
    return block(cells, (length, width, height)), scene_of(order, held, loads), seen, w, stress


def compared(sunder, folder, make, grids, repeats):
    """Rows of one body: order, layers, cells, errors of deflection and stress in per cent, ms of the command."""
    rows, points = [], []
    for order, layers in grids:
        (nodes, tetrahedra), scene, seen, w_exact, s_exact = make(order, layers)
        write_mesh(folder / "body.mesh", nodes, tetrahedra)
        answer, seconds = median_of(repeats, lambda: solve_static(sunder, folder, scene))
        w, s = seen(answer)
        # Said, as a held slender body takes corotational frames by itself.
        still = dict(scene, time_step=1e-3, ladder={"rigid": False, "quasi_static": False, "sleep": False},
                     energy_ledger=False, model="rigid_reference", integrator={"method": "floating_frame"})
        step = statistics.median(step_seconds(sunder, folder, still, steps_for(len(tetrahedra)))[0] for _ in range(repeats))
        rows.append([str(order), str(layers), str(len(tetrahedra)), percent(w, w_exact), percent(s, s_exact),
                     f"{1e3 * seconds:.0f}", f"{1e3 * step:.2f}"])
        points.append((order, 1e3 * seconds, abs(w / w_exact - 1), abs(s / s_exact - 1)))
        print(make.__name__, rows[-1], flush=True)
    return rows, points


def bending(sunder, folder, repeats=3):
    """Tables of the three bodies and the points of their chart."""
    lines, chart = [], {}
    for title, make, grids in (
            ("cantilever, L/t = 20", cantilever_case, [(2, 1), (2, 2), (1, 1), (1, 2), (1, 4), (1, 6), (1, 8)]),
            ("clamped pane, 0.3 x 0.3 x 0.006 m", pane_case, [(2, 1), (2, 2), (1, 1), (1, 2), (1, 4)]),
            ("three-point bending, L/h = 9", three_point_case,
             [(2, 1), (2, 2), (2, 4), (1, 2), (1, 4), (1, 8)])):
        rows, chart[title] = compared(sunder, folder, make, grids, repeats)
        lines += table([title + ": order", "layers", "cells", "deflection, % off", "stress, % off",
                        "static, ms", "ms a step"], rows)
    return lines, chart


def unstructured(sunder, folder, repeats):
    """Cantilevers of Delaunay cells (gmsh), L/t = 10: how much too stiff order 1 and 2 are by the mean edge e over
    the thickness."""
    size, rows = (1.0, 0.1, 0.1), []
    exact = timoshenko_end(size[0], size[2])
    for share in (1.0, 0.5, 1 / 3, 0.25, 0.18, 0.13):
        (folder / "body.geo").write_text(
            f'SetFactory("OpenCASCADE");\nBox(1) = {{0, 0, 0, {size[0]}, {size[1]}, {size[2]}}};\n'
            f"Mesh.MeshSizeMin = {share * size[2]};\nMesh.MeshSizeMax = {share * size[2]};\nMesh.MshFileVersion = 2.2;\n")
        subprocess.run(["gmsh", "-3", "-v", "0", "body.geo", "-o", "body.msh"], cwd=folder, check=True)
        made = meshio.read(folder / "body.msh")
        points, tetrahedra = made.points, made.cells_dict["tetra"]
        write_mesh(folder / "body.mesh", points, tetrahedra)
        edges = numpy.unique(numpy.sort(numpy.concatenate(
            [tetrahedra[:, [i, j]] for i in range(4) for j in range(i)])), axis=0)
        edge = numpy.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1).mean() / size[2]
        row = [f"{edge:.3f}", str(len(tetrahedra))]
        for order in (1, 2) if share > 0.2 else (1,):
            answer, _ = solve_static(sunder, folder, scene_of(order, [box(size, 0, False)], top_pressure(size)))
            rest, u, _ = answer["nodes"]
            end = rest[:, 0] > size[0] * (1 - 1e-9)
            soft = -u[end, 2].mean() / exact
            row.append(f"{100 * (soft - 1):+.1f}")
            if order == 1:
                row.append(f"{(1 / soft - 1) / edge ** 2:.2f}")
        rows.append(row + [""] * (5 - len(row)))
        print("unstructured", rows[-1], flush=True)
    return table(["mean edge e / t", "cells", "order 1, % off", "too stiff by, over (e/t)^2", "order 2, % off"],
                 rows), None


# Stress and displacement where nothing bends.

STEEL = {"young_modulus": 2e11, "poisson_ratio": 0.3, "density": 7800, "tensile_strength": 1e10}


def plane_strain(*symmetry):
    """Holds of a slab in plane strain, with the planes through the origin across `symmetry` held."""
    held = [held_box((None,) * 3, (None,) * 3, "z")]
    for axis in symmetry:
        low, high = [None] * 3, [None] * 3
        low["xyz".index(axis)], high["xyz".index(axis)] = -1e-9, 1e-9
        held.append(held_box(low, high, axis))
    return held


def kirsch_case(n, _):
    """A quarter of a plate of half width 10 and half height 20 with a hole of radius 1, pulled along y: rings of
    cells that grow from the hole. Stress at the hole's side over Heywood's for d/W = 0.1."""
    width, height = 10.0, 20.0
    ratio = 1 / width
    exact = (2 + (1 - ratio) ** 3) / (1 - ratio)
    radial, around = 3 * n, 4 * n

    def place(u, v, w):
        # Halves of the angle end at the corner of the plate.
        angle = math.pi / 2 * v
        inner = (math.cos(angle), math.sin(angle))
        outer = (width, height * 2 * v) if v <= 0.5 else (width * 2 * (1 - v), height)
        s = (math.exp(3.2 * u) - 1) / (math.exp(3.2) - 1)
        return (*((1 - s) * i + s * o for i, o in zip(inner, outer)), 0.3 / n * w)
    mesh = grid((radial, around, 1), place)
    # A slab without weight of its own in the section: plane strain keeps the stresses in the plane.
    pull = [{"minimum": [-BIG, height - 1e-9, -BIG], "maximum": [BIG] * 3, "pressure": -1e6}]

    def seen(answer):
        low = (abs(answer["nodes"][0][:, 0] - 1) < 1e-9) & (abs(answer["nodes"][0][:, 1]) < 1e-9)
        return answer["nodes"][1][low, 0].mean(), answer["nodes"][2][low, 1].mean() / 1e6
    # Of an infinite plate, plane strain: u at the hole's side is -S r (1 - nu^2) / E.
    return mesh, plane_strain("x", "y"), pull, seen, None, exact


def lame_case(n, _):
    """A quarter of a tube of radii 1 and 2 under pressure inside, plane strain: widening and hoop stress inside."""
    pressure, nu, young = 1e6, STEEL["poisson_ratio"], STEEL["young_modulus"]

    def place(u, v, w):
        angle, r = math.pi / 2 * v, 1 + u
        return (r * math.cos(angle), r * math.sin(angle), 0.5 / n * w)
    mesh = grid((2 * n, 3 * n + n % 2, 1), place)
    # Faces inside, and some across z, which is held.
    load = [{"minimum": [0, 0, -BIG], "maximum": [1 + 1e-9, 1 + 1e-9, BIG], "pressure": pressure}]
    widening = (1 + nu) * pressure / young * ((1 - 2 * nu) + 4) / 3

    def seen(answer):
        rest, u, stress = answer["nodes"]
        inside = abs(numpy.hypot(rest[:, 0], rest[:, 1]) - 1) < 1e-9
        radial = rest[inside, :2] / numpy.linalg.norm(rest[inside, :2], axis=1)[:, None]
        hoop = numpy.stack([-radial[:, 1], radial[:, 0]], axis=1)
        s = stress[inside]
        around = s[:, 0] * hoop[:, 0] ** 2 + s[:, 1] * hoop[:, 1] ** 2 + 2 * s[:, 3] * hoop[:, 0] * hoop[:, 1]
        return (u[inside, :2] * radial).sum(axis=1).mean(), around.mean()
    return mesh, plane_strain("x", "y"), load, seen, widening, pressure * 5 / 3


def torsion_case(n, order):
    """A bar of side 1 and length 1, both ends turned in their planes and free along the axis: torque of Saint-Venant,
    0.1406 G a^4 twist, and shear in the middle of a side, 0.6753 G a twist."""
    twist, shear = 1e-6, STEEL["young_modulus"] / (2 * (1 + STEEL["poisson_ratio"]))
    points, tetrahedra = block((n, n, n), (1.0, 1.0, 1.0))
    held = [held_box((0.5 - 1e-6, 0.5 - 1e-6, None), (0.5 + 1e-6, 0.5 + 1e-6, None), "z")]
    # Every node of both ends is turned by a box of its own. Boxes must hold a corner of a cell: those of middles of
    # edges reach down to one, and come first, as the last box that has a node moves it.
    parts = n * order
    for odd in ((1, 1), (1, 0), (0, 1), (0, 0)) if order == 2 else ((0, 0),):
        for z, angle in ((0.0, -twist / 2), (1.0, twist / 2)):
            for i in range(odd[0], parts + 1, order):
                for j in range(odd[1], parts + 1, order):
                    x, y = i / parts, j / parts
                    held.append(held_box(((i - odd[0]) / parts - 1e-6, (j - odd[1]) / parts - 1e-6, z - 1e-6),
                                         (x + 1e-6, y + 1e-6, z + 1e-6), "xy",
                                         (-angle * (y - 0.5), angle * (x - 0.5), 0)))

    def seen(answer):
        rest, _, stress = answer["nodes"]
        # Torque from the energy, torque times twist / 2; sigma_yz in the middle of the side x = 1.
        at = numpy.argmin(((rest - (1.0, 0.5, 0.5)) ** 2).sum(axis=1))
        return 2 * answer["strain_energy"] / twist, abs(stress[at, 4])
    return (points, tetrahedra), held, [], seen, 0.1406 * shear * twist, 0.6753 * shear * twist


def stresses(sunder, folder, repeats=3):
    lines, chart = [], {}
    for title, make, sizes, quantity in (
            ("plate with a hole", kirsch_case, {1: (1, 2, 4, 8, 16), 2: (1, 2, 4, 8)}, "none"),
            ("thick tube", lame_case, {1: (1, 2, 4, 8, 16), 2: (1, 2, 4, 8)}, "widening"),
            ("torsion of a square bar", torsion_case, {1: (2, 4, 8, 12), 2: (2, 4, 8)}, "torque")):
        rows, chart[title] = [], []
        for order in (1, 2):
            for n in sizes[order]:
                mesh, held, loads, seen, u_exact, s_exact = make(n, order)
                write_mesh(folder / "body.mesh", *mesh)
                scene = scene_of(order, held, loads, STEEL)
                answer, seconds = median_of(repeats, lambda: solve_static(sunder, folder, scene))
                u, s = seen(answer)
                rows.append([str(order), str(len(mesh[1])), percent(u, u_exact) if u_exact else "",
                             percent(s, s_exact), f"{1e3 * seconds:.0f}"])
                chart[title].append((order, 1e3 * seconds, abs(u / u_exact - 1) if u_exact else None,
                                     abs(s / s_exact - 1)))
                print(title, rows[-1], flush=True)
        head = [title + ": order", "cells", quantity + ", % off", "stress, % off", "ms"]
        if quantity == "none":
            head.pop(2)
            rows = [row[:2] + row[3:] for row in rows]
        lines += table(head, rows)
    return lines, chart
