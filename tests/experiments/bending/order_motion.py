# SPDX-License-Identifier: MIT
"""Runs of order_charts.py: spinning rod, bar on a wall, Hertz, falling cup, slender strip, cost of a step."""
import math
import statistics

import numpy
import scipy.integrate
import scipy.optimize

from order_tools import BIG, frames, grid, percent, run_scene, step_seconds, steps_for, table, write_mesh
from second_order import block
from thin_things import GLASS, shell

CONCRETE = {"young_modulus": 3e10, "poisson_ratio": 0.0, "density": 2400.0, "tensile_strength": 3e6}
FULL = {"rigid": False, "quasi_static": False, "sleep": False}


def base(order, material, h, duration, **more):
    """A scene of one body in which nothing breaks, without gravity."""
    body = {"mesh": "body.mesh", "order": order, "material": material, **more.pop("body", {})}
    return {"gravity": {"acceleration": [0, 0, 0]}, "fracture": {"mode": "off"}, "ladder": FULL, "time_step": h,
            "duration": duration, "bodies": [body], **more}


def node_masses(mesh, density):
    """HRZ's masses of the nodes of a frame; quarters of the cells' for order 1."""
    kind = "tetra10" if "tetra10" in mesh.cells_dict else "tetra"
    cells, x = mesh.cells_dict[kind], mesh.points
    edges = x[cells[:, 1:4]] - x[cells[:, :1]]
    weight = density * numpy.abs(numpy.linalg.det(edges)) / 6
    mass = numpy.zeros(len(x))
    for k in range(cells.shape[1]):
        share = 0.25 if kind == "tetra" else 1 / 36 if k < 4 else 4 / 27
        numpy.add.at(mass, cells[:, k], share * weight)
    return mass


def rod(sunder, folder, repeats):
    """A free rod, 1 x 0.1 x 0.1 m, at 50 rad/s: stretch and stress in the middle once it has come to rest."""
    rows, omega, E, rho = [], 50.0, CONCRETE["young_modulus"], CONCRETE["density"]
    stress, stretch = rho * omega ** 2 / 8, rho * omega ** 2 / (12 * E)
    for order, cells in ((1, (6, 1, 1)), (1, (12, 2, 2)), (1, (24, 4, 4)), (2, (4, 1, 1)), (2, (6, 1, 1)),
                         (2, (12, 2, 2))):
        write_mesh(folder / "body.mesh", *block(cells, (1.0, 0.1, 0.1)))
        scene = base(order, CONCRETE, 1e-3, 0.06, body={"spin": [0, 0, omega]})
        run_scene(sunder, folder, scene, ["--frames", "2"])
        (_, start), (_, end) = frames(folder)
        middle = abs(start.points[:, 0] - 0.5) < 1e-9
        ends = [end.points[abs(start.points[:, 0] - x) < 1e-9].mean(axis=0) for x in (0, 1)]
        long = numpy.linalg.norm(ends[1] - ends[0]) - 1
        found = end.point_data["largest_principal_stress"][middle].mean()
        step = statistics.median(step_seconds(sunder, folder, scene, steps_for(6 * math.prod(cells)))[0] for _ in range(repeats))
        rows.append([str(order), str(end.cells[0].data.shape[0]), percent(long, stretch), percent(found, stress),
                     f"{1e3 * step:.3f}"])
        print("rod", rows[-1], flush=True)
    return table(["spinning rod: order", "cells", "stretch, % off", "stress in the middle, % off", "ms a step"],
                 rows), None


def contact_history(folder, density, axis):
    """Times and momenta along an axis of all frames, and their least and largest node stress along it."""
    times, momenta, stress, mass = [], [], [], None
    for time, mesh in frames(folder):
        if mass is None:
            mass = node_masses(mesh, density)
        times.append(time)
        momenta.append(mass @ mesh.point_data["velocity"][:, axis])
        along = mesh.point_data["node_stress"][:, axis]
        stress.append((along.min(), along.max()))
    return numpy.array(times), numpy.array(momenta), numpy.array(stress)


def bar(sunder, folder, repeats):
    """A flat bar, 1 x 0.05 x 0.05 m, nu = 0, on a wall; steps of L/c / 64 in impact windows."""
    E, rho, v = CONCRETE["young_modulus"], CONCRETE["density"], 0.5
    c = math.sqrt(E / rho)
    h, rows = 1 / c / 64, []
    for order, n, across in ((1, 20, 1), (1, 40, 1), (1, 80, 1), (1, 40, 2), (2, 10, 1), (2, 20, 1), (2, 40, 1),
                             (2, 20, 2), (2, 40, 2)):
        write_mesh(folder / "body.mesh", *block((n, across, across), (1.0, 0.05, 0.05)))
        steps = 256
        scene = base(order, CONCRETE, h, h * steps, obstacles=[{"plane": {"normal": [1, 0, 0]}, "friction": 0}],
                     contact={"friction": 0}, output={"frame_interval": h},
                     body={"velocity": [-v, 0, 0], "translation": [0.37 * h * v, 0, 0]})
        run_scene(sunder, folder, scene)
        times, p, stress = contact_history(folder, rho, 0)
        force = numpy.diff(p) / numpy.diff(times) / (rho * c * v * 0.05 ** 2)
        pushed = numpy.flatnonzero(force > 0.01)
        lasted = (times[pushed[-1] + 1] - times[pushed[0]]) * c / 2
        plateau = (times[1:] > 0.25 / c) & (times[1:] < 1.75 / c)
        step = statistics.median(step_seconds(sunder, folder, scene, steps)[0] for _ in range(repeats))
        rows.append([str(order), f"{n} x {across} x {across} x 6", f"{lasted:.3f}", f"{force[plateau].mean():.3f}",
                     f"{force[plateau].std():.3f}", f"{-stress.min() / (rho * c * v):.3f}", f"{stress.max() / (rho * c * v):.3f}",
                     f"{p[-1] / (rho * 0.05 ** 2 * v):.3f}", f"{1e3 * step:.3f}"])
        print("bar", rows[-1], flush=True)
    return table(["bar on a wall: order", "cells", "time of contact / (2 L/c)", "force / (rho c v A), mean",
                  "its deviation", "largest compression / (rho c v)",
                  "largest tension / (rho c v)", "rebound", "ms a step"], rows), None


def grading(first, n):
    """k of sinh(k u) / sinh(k) such that the first of n parts is `first` of the whole."""
    return scipy.optimize.brentq(lambda k: math.sinh(k / n) / math.sinh(k) - first, 1e-6, 30)


def round_block(n, smallest):
    """A block of 1 m with a paraboloid of radius 1 m as lower face; cells of `smallest` in its
    middle."""
    nz = max(2, 2 * n // 3 + 1)
    k, kz = grading(min(smallest / 0.5, 0.98 / n), n), grading(min(smallest, 0.98 / nz), nz)

    def place(u, v, w):
        x, y = (0.5 * math.copysign(math.sinh(k * abs(2 * s - 1)) / math.sinh(k), 2 * s - 1) for s in (u, v))
        z = math.sinh(kz * w) / math.sinh(kz)
        return (x, y, z + (1 - z) * (x * x + y * y) / 2)
    return grid((2 * n, 2 * n, nz), place)


def hertz(sunder, folder, repeats):
    """The round block strikes a rigid plane at 3 m/s: time of contact, peak force, rebound over Hertz's. Nodes at the
    contact as far apart for both orders (20 mm), and half as far for order 2."""
    material = dict(CONCRETE, poisson_ratio=0.2)
    rho, v, modulus = material["density"], 3.0, material["young_modulus"] / (1 - 0.2 ** 2)
    rows = []
    for order, n, smallest in ((1, 6, 0.02), (1, 8, 0.02), (1, 12, 0.02), (2, 3, 0.04), (2, 4, 0.04), (2, 4, 0.02),
                               (2, 6, 0.04)):
        points, tetrahedra = round_block(n, smallest)
        write_mesh(folder / "body.mesh", points, tetrahedra)
        h = 2e-5
        scene = base(order, material, h, 3.6e-3, obstacles=[{"plane": {"normal": [0, 0, 1]}, "friction": 0}],
                     contact={"friction": 0, "max_contacts_per_pair": 1024},
                     impact={"negligible": 1e-6}, output={"frame_interval": h},
                     body={"velocity": [0, 0, -v], "translation": [0, 0, 0.4 * h * v]})
        _, seconds, _ = run_scene(sunder, folder, scene, limit=900)
        times, p, _ = contact_history(folder, rho, 2)
        mass = abs(p[0]) / v
        depth = (15 * mass * v * v / (16 * modulus)) ** 0.4
        force, lasts = 4 / 3 * modulus * depth ** 1.5, 2.87 * (mass ** 2 / (modulus ** 2 * v)) ** 0.2
        push = numpy.diff(p) / numpy.diff(times)
        pushed = numpy.flatnonzero(push > 1e-3 * force)
        rows.append([str(order), str(n), f"{1e3 * smallest:.0f}", str(len(tetrahedra)),
                     f"{(times[pushed[-1] + 1] - times[pushed[0]]) / lasts:.3f}", f"{push.max() / force:.3f}",
                     f"{p[-1] / mass / v:.3f}", f"{seconds:.1f}"])
        print("hertz", rows[-1], flush=True)
    return table(["round block: order", "cells in half the width", "least cell, mm", "cells", "time of contact",
                  "peak force", "rebound", "s, with the frames"], rows), None


def cup(sunder, folder, repeats):
    """A cup of 3 mm falls 1 m on its side, tilted by 10 degrees; nothing breaks. How much its mouth is out of round
    at most, and the largest tension of any vertex."""
    rows, floor = [], {"plane": {"normal": [0, 0, 1]}, "friction": 0.4}
    for order, layers, around, up in ((1, 1, 20, 10), (1, 1, 28, 14), (1, 2, 40, 20), (2, 1, 12, 6), (2, 1, 16, 8),
                                      (2, 1, 20, 10), (2, 1, 28, 14)):
        points, tetrahedra = shell(lambda z: 0.03 + 0.1 * z, 0.03, 0.09, 0.003, around, up, layers)
        write_mesh(folder / "body.mesh", points, tetrahedra)
        h = 5e-6
        scene = base(order, GLASS, h, 1e-3, obstacles=[floor], output={"frame_interval": 2 * h},
                     body={"translation": [0, 0, 0.0], "velocity": [0, 0, -4.43],
                           "rotation": {"axis": [1, 0, 0], "angle": 100}})
        # Its lowest point starts 10 um above the floor.
        turn = math.radians(100)
        low = (points[:, 1] * math.sin(turn) + points[:, 2] * math.cos(turn)).min()
        scene["bodies"][0]["translation"] = [0, 0, 1e-5 - low]
        _, seconds, _ = run_scene(sunder, folder, scene, limit=900)
        mouth = numpy.flatnonzero((points[:, 2] > 0.09 - 1e-9) & (numpy.hypot(*points.T[:2]) > 0.0385))
        across = [(a, b) for a in mouth for b in mouth if a < b and
                  numpy.linalg.norm(points[a, :2] + points[b, :2]) < 1e-6]
        out, peak, when = 0.0, 0.0, 0.0
        for time, mesh in frames(folder):
            # Points of the mesh keep their rows.
            for a, b in across:
                width = numpy.linalg.norm(mesh.points[a] - mesh.points[b])
                out = max(out, abs(width - numpy.linalg.norm(points[a] - points[b])))
            tension = mesh.point_data["largest_principal_stress"].max()
            if tension > peak:
                peak, when = tension, time
        rows.append([str(order), str(layers), str(len(tetrahedra)), f"{1e6 * out:.1f}", f"{peak / 1e6:.0f}",
                     f"{1e6 * when:.0f}", f"{seconds:.1f}"])
        print("cup", rows[-1], flush=True)
    return table(["falling cup: order", "layers", "cells", "out of round, um", "largest tension, MPa", "at, us",
                  "s, with the frames"], rows), None


def elastica(load):
    """End of a clamped strip of length 1 under its own weight, load = q L^3 / EI: (x, z)."""
    s = numpy.linspace(0, 1, 101)
    solved = scipy.integrate.solve_bvp(
        lambda s, y: numpy.vstack([y[1], load * (1 - s) * numpy.cos(y[0])]),
        lambda a, b: numpy.array([a[0], b[1]]), s, numpy.zeros((2, s.size)), tol=1e-8)
    theta = solved.sol(numpy.linspace(0, 1, 2001))[0]
    return scipy.integrate.simpson(numpy.cos(theta), dx=1 / 2000), scipy.integrate.simpson(numpy.sin(theta), dx=1 / 2000)


def slender(sunder, folder, repeats):
    """A strip of 20 to 1 under its own weight, slowly raised: one frame and a frame a tetrahedron."""
    size, E = (1.0, 0.05, 0.05), 1e7
    rows = []
    for load in (0.1, 0.5, 1.5, 4.7):
        x, z = elastica(load)
        density = 1000.0
        g = load * E * size[2] ** 2 / 12 / density
        rows.append([f"{load:g}", "elastica", "", f"{x:.3f}, {z:.3f}", "", ""])
        for order, layers, model in ((2, 1, "rigid_reference"), (2, 1, "corotational"), (1, 4, "rigid_reference"),
                                     (1, 4, "corotational")):
            cells = (16, 1, 1) if order == 2 else (10 * layers, max(1, layers // 2), layers)
            write_mesh(folder / "body.mesh", *block(cells, size))
            material = {"young_modulus": E, "poisson_ratio": 0.0, "density": density, "tensile_strength": 1e9}
            h = 0.02
            held = [{"minimum": [-BIG] * 3, "maximum": [1e-9, BIG, BIG]}]
            scene = base(order, material, h, 8.0, body={"held": held}, model=model)
            scene["gravity"] = {"acceleration": [0, 0, -g], "ramp_time": 4.0}
            scene["integrator"] = ({"damping": {"mass_factor": 10.0}} if model == "rigid_reference" else
                                   {"method": "implicit_euler"})
            run_scene(sunder, folder, scene, ["--frames", "2"], limit=600)
            (_, start), (_, end) = frames(folder)
            tip = end.points[abs(start.points[:, 0] - 1) < 1e-9].mean(axis=0) - (0, 0.025, 0.025)
            step = step_seconds(sunder, folder, scene, 30)[0]
            far = math.hypot(tip[0] - x, tip[2] - z) / math.hypot(x - 1, z)
            rows.append([f"{load:g}", f"order {order}, {layers} layers, " +
                         ("one frame" if model == "rigid_reference" else model), str(len(end.cells[0].data)),
                         f"{tip[0]:.3f}, {tip[2]:.3f}", f"{100 * far:.1f}", f"{1e3 * step:.2f}"])
            print("slender", rows[-1], flush=True)
    return table(["strip, q L^3 / EI", "by", "cells", "end at, L", "off, % of its way", "ms a step"], rows), None


def cost(sunder, folder, repeats):
    """Bars in free flight of about 1 000, 6 000 and 20 000 cells, both orders in turn."""
    rows = []
    for cells in ((12, 4, 4), (20, 7, 7), (34, 10, 10)):
        write_mesh(folder / "body.mesh", *block(cells, (1.0, 0.3, 0.3)))
        found = {1: [], 2: []}
        count = 6 * cells[0] * cells[1] * cells[2]
        for _ in range(repeats if count < 20000 else 1):
            for order in (1, 2):
                scene = base(order, GLASS, 1e-3, 0, energy_ledger=False, body={"spin": [1, 2, 3]})
                found[order].append(step_seconds(sunder, folder, scene, 30))
        one, two = ([statistics.median(column) for column in zip(*found[order])] for order in (1, 2))
        for order, (step, first, peak) in ((1, one), (2, two)):
            rows.append([str(count), str(order), f"{1e3 * step:.2f}", f"{1e3 * first:.0f}", f"{peak:.0f}",
                         "" if order == 1 else ", ".join(f"{a / b:.0f}" for a, b in zip(two, one))])
            print("cost", rows[-1], flush=True)
    return table(["bar in flight, cells", "order", "ms a step", "start and first step, ms", "memory, MB",
                  "ratios to order 1"], rows), None
