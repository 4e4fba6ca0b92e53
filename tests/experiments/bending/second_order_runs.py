#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What order 2 costs and gives: steps, bending at equal error, the load that breaks a beam, thin things
that are struck.

    tests/experiments/bending/second_order_runs.py SUNDER [--only cost|bending|three-point|struck ...]
                                                   [--pictures DIR]

cost         ms a step in free flight, the first step (which factors), memory of the process: bars of
             about 1 000, 6 000 and 20 000 cells of both orders.
bending      deflection of a cantilever over Timoshenko's beam and ms a step of its run, by order and
             layers: what an error costs.
three-point  load at which the node stress below the middle of a simply supported beam, away from the
             line of the load, reaches the strength, over beam theory's, by order and layers (by `sunder
             static`).
struck       a pane, a cup, a vase, a beam and a tile, of three meshes and both orders: when and where the
             first fan is, pieces and fans at the end; pictures at the end with --pictures.
Needs python3-meshio. Times are of this machine: compare rows of one run.
"""
import argparse
import json
import math
import subprocess
import tempfile
import time
from pathlib import Path

import meshio
import numpy

from second_order import KUHN, block

GLASS = {"young_modulus": 7e10, "poisson_ratio": 0.22, "density": 2500, "tensile_strength": 4e7,
         "toughness": 7.5e5}


def write_mesh(path, points, tetrahedra):
    meshio.write(path, meshio.Mesh(points, [("tetra", tetrahedra)]), file_format="gmsh22")


def run(sunder, folder, scene, options=()):
    """Report, events and peak memory (MB) of a run."""
    (folder / "scene.json").write_text(json.dumps(scene))
    command = [str(sunder), "run", folder / "scene.json", "-o", folder / "out", "--force", "--quiet",
               "--json", *options]
    script = ("import resource, subprocess, sys; "
              "p = subprocess.run(sys.argv[1:], stdout=subprocess.PIPE); "
              "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, p.returncode); "
              "sys.stdout.buffer.write(p.stdout)")
    out = subprocess.run(["python3", "-c", script, *map(str, command)], stdout=subprocess.PIPE, text=True,
                         check=True).stdout
    first, _, rest = out.partition("\n")
    peak, code = map(int, first.split())
    if code not in (0, 5):
        raise RuntimeError(f"sunder run ended with {code}")
    events = [json.loads(line) for line in (folder / "out" / "events.jsonl").read_text().splitlines()]
    return json.loads(rest), events, peak / 1024


def cost(sunder, folder):
    print("| cells | order | ms a step | first step, ms | memory, MB |\n|---|---|---|---|---|")
    for cells in ((12, 4, 4), (20, 7, 7), (34, 10, 10)):
        write_mesh(folder / "body.msh", *block(cells, (1.0, 0.3, 0.3)))
        for order in (1, 2):
            scene = {"gravity": {"acceleration": [0, 0, 0]}, "time_step": 1e-3, "duration": 0.03,
                     "fracture": {"mode": "off"}, "energy_ledger": False,
                     "ladder": {"rigid": False, "quasi_static": False, "sleep": False},
                     "bodies": [{"mesh": "body.msh", "order": order, "material": GLASS, "spin": [1, 2, 3]}]}
            report, _, peak = run(sunder, folder, scene, ["--frames", "0"])
            steps = report["step_ms"]
            print(f"| {report['tetrahedra']} | {order} | {steps['median']:.2f} | {steps['max']:.0f} | "
                  f"{peak:.0f} |", flush=True)


def cantilever_scene(order, size, pressure):
    big = 1e3
    return {"gravity": {"acceleration": [0, 0, 0]}, "time_step": 1e-3, "duration": 0.05,
            "fracture": {"mode": "off"},
            "ladder": {"rigid": False, "quasi_static": False, "sleep": False},
            "bodies": [{"mesh": "body.msh", "order": order, "material": GLASS,
                        "held": [{"minimum": [-big] * 3, "maximum": [1e-9, big, big]}],
                        "loads": [{"minimum": [-big, -big, size[2] * (1 - 1e-9)], "maximum": [big] * 3,
                                   "pressure": pressure}]}]}


def static(sunder, folder, scene):
    (folder / "scene.json").write_text(json.dumps(scene))
    out = subprocess.run([str(sunder), "static", folder / "scene.json", "--json", "--quiet"],
                         stdout=subprocess.PIPE, text=True, check=True).stdout
    return json.loads(out)["bodies"][0]


def bending(sunder, folder):
    print("| order | layers | cells | deflection over Timoshenko's | ms a step |\n|---|---|---|---|---|")
    size, pressure = (1.0, 0.1, 0.05), 1000.0
    young, poisson = GLASS["young_modulus"], GLASS["poisson_ratio"]
    inertia = size[2] ** 3 / 12
    exact = pressure * size[0] ** 4 / (8 * young * inertia) + pressure * size[0] ** 2 / (
        2 * 5 / 6 * young / (2 * (1 + poisson)) * size[2])
    for order, layers in ((2, 1), (2, 2), (1, 1), (1, 2), (1, 4), (1, 6), (1, 8)):
        across = 8 * layers if order == 2 else max(8, 10 * layers)
        write_mesh(folder / "body.msh", *block((across, max(1, layers), layers), size))
        scene = cantilever_scene(order, size, pressure)
        answer = static(sunder, folder, scene)
        report, _, _ = run(sunder, folder, scene, ["--frames", "0"])
        print(f"| {order} | {layers} | {report['tetrahedra']} | {answer['max_displacement']['value'] / exact:.4f} | "
              f"{report['step_ms']['median']:.3f} |", flush=True)


def three_point(sunder, folder):
    print("| order | layers | cells | breaking load over beam theory's |\n|---|---|---|---|")
    length, width, height, big = 0.4, 0.04, 0.04, 1e3
    span = length - 0.04
    for order, layers in ((1, 2), (1, 4), (2, 1), (2, 2), (2, 4)):
        cells = (max(40, 20 * layers), layers, layers)
        points, tetrahedra = block(cells, (length, width, height))
        write_mesh(folder / "body.msh", points, tetrahedra)
        h = length / cells[0]
        middle, force = length / 2, -1.0
        left, right = (length - span) / 2, (length + span) / 2

        def strip(x, z, axes=None, half=1e-6):
            held = {"minimum": [x - half, -big, z - 1e-9], "maximum": [x + half, big, z + 1e-9]}
            if axes:
                held["axes"] = axes
            return held
        scene = {"gravity": {"acceleration": [0, 0, 0]},
                 "bodies": [{"mesh": "body.msh", "order": order, "material": GLASS,
                             "held": [strip(left, 0, ["z"]), strip(right, 0, ["z"]),
                                      {"minimum": [middle - 1e-6, -big, -big], "maximum": [middle + 1e-6, big, big],
                                       "axes": ["x"]},
                                      {"minimum": [-big, -1e-9, -big], "maximum": [big, 1e-9, big], "axes": ["y"]}],
                             "loads": [{"minimum": [middle - 1e-6, -big, height - 1e-9],
                                        "maximum": [middle + 1e-6, big, height + 1e-9],
                                        "force": [0, 0, force]}]}]}
        (folder / "scene.json").write_text(json.dumps(scene))
        subprocess.run([str(sunder), "static", folder / "scene.json", "--quiet", "-o", folder / "out.vtu"],
                       stdout=subprocess.DEVNULL, check=True)
        out = meshio.read(folder / "out.vtu")
        rest = out.points - out.point_data["displacement"]
        lower = (abs(rest[:, 0] - middle) < 1e-6) & (abs(rest[:, 2]) < 1e-6)
        stress = out.point_data["node_stress"][lower, 0].max()
        # The strength over the stress at the lower side is the force that breaks it there; theory:
        # sigma = 3 F L / (2 b h^2).
        load = GLASS["tensile_strength"] / stress
        span_held = 2 * (middle - round(left / h) * h)
        theory = GLASS["tensile_strength"] * 2 * width * height ** 2 / (3 * span_held)
        print(f"| {order} | {layers} | {len(tetrahedra)} | {load / theory:.3f} |", flush=True)


def shell(radius, floor, height, thickness, around, up, layers=1):
    """A thin vessel of revolution about z: a floor with a hub, and a wall; cells across by `KUHN`."""
    profile = []  # (radius, z, normal) from the middle of the floor outwards and up
    across = max(2, min(up // 2, int(floor / thickness)))  # shorter cells fold where the floor meets the wall
    for k in range(1, across + 1):
        r = floor * k / across
        profile.append((r, 0.0, (0.0, -1.0)))
    for k in range(1, up + 1):
        z = height * k / up
        r = radius(z)
        profile.append((r, z, (1.0, 0.0)))
    # Corners between floor and wall look half-way.
    r, z, _ = profile[across - 1]
    profile[across - 1] = (r, z, (1.0, -1.0))
    points, index = [], {}
    for i, (r, z, (nr, nz)) in enumerate(profile):
        for j in range(around):
            a = 2 * math.pi * j / around
            for k in range(layers + 1):
                s = thickness * k / layers
                rr, zz = r - s * nr, z - s * nz
                index[i, j, k] = len(points)
                points.append((rr * math.cos(a), rr * math.sin(a), zz))
    hub = {}
    for k in range(layers + 1):
        hub[k] = len(points)
        points.append((0.0, 0.0, thickness * k / layers))
    tetrahedra = []

    def add(t):
        x = numpy.array([points[p] for p in t])
        d = numpy.linalg.det(x[1:] - x[0])
        if abs(d) < 1e-20:
            return
        tetrahedra.append(t if d > 0 else (t[0], t[1], t[3], t[2]))
    for i in range(len(profile) - 1):
        for j in range(around):
            for k in range(layers):
                mirror = (i % 2, j % 2, k % 2)
                corner = [index[i + ((c & 1) ^ mirror[0]), (j + ((c >> 1 & 1) ^ mirror[1])) % around,
                                k + ((c >> 2) ^ mirror[2])] for c in range(8)]
                for a in KUHN:
                    add(tuple(corner[c] for c in a))
    for j in range(around):
        for k in range(layers):
            # A prism of the hub; its diagonals leave the outer side as the ring beside has it.
            low = [hub[k], index[0, j, k], index[0, (j + 1) % around, k]]
            high = [hub[k + 1], index[0, j, k + 1], index[0, (j + 1) % around, k + 1]]
            if j % 2 == k % 2:
                parts = [(low[0], low[1], low[2], high[2]), (low[0], low[1], high[2], high[1]),
                         (low[0], high[1], high[2], high[0])]
            else:
                parts = [(low[0], low[1], low[2], high[1]), (low[0], low[2], high[2], high[1]),
                         (low[0], high[1], high[2], high[0])]
            for t in parts:
                add(t)
    return numpy.array(points), numpy.array(tetrahedra)


def above_floor(mesh, axis, angle):
    """A body turned by `angle` degrees about `axis` that falls at 4.43 m/s, as after 1 m, and is 0.1 mm above the
    floor."""
    unit = numpy.array(axis) / numpy.linalg.norm(axis)
    turn = math.radians(angle)
    p = mesh[0]
    turned = (p * math.cos(turn) + numpy.cross(unit, p) * math.sin(turn)
              + numpy.outer(p @ unit, unit) * (1 - math.cos(turn)))
    return {"translation": [0, 0, 1e-4 - turned[:, 2].min()], "velocity": [0, 0, -4.43],
            "rotation": {"axis": axis, "angle": angle}}


def struck_cases(level):
    """Name, mesh, scene at one of three finenesses."""
    floor = {"plane": {"normal": [0, 0, 1]}, "friction": 0.4}
    base = {"impact": {"fraction": 0.25}, "time_step": 1e-4, "duration": 0.004}
    n = (10, 14, 20)[level]
    for speed in (5, 10, 20):
        yield (f"pane 6 mm, ball at {speed} m/s", block((n, n, 1), (0.3, 0.3, 0.006)),
               dict(base, obstacles=[{"sphere": {"center": [0.15, 0.15, -0.0201], "radius": 0.02},
                                      "velocity": [0, 0, speed], "mass": 0.26}]), {})
    around, up = (16, 20, 28)[level], (8, 10, 14)[level]
    cup = shell(lambda z: 0.03 + 0.1 * z, 0.03, 0.09, 0.003, around, up)
    yield "cup falls 1 m", cup, dict(base, obstacles=[floor]), above_floor(cup, [1, 0, 0], 100)
    vase = shell(lambda z: 0.04 + 0.02 * math.sin(10 * z), 0.04, 0.25, 0.004, around, 2 * up)
    yield "vase falls 1 m", vase, dict(base, obstacles=[floor]), above_floor(vase, [1, 0.2, 0], 70)
    yield ("beam on two edges, ball", block((4 * n, 2, 1), (0.4, 0.04, 0.02)),
           dict(base, obstacles=[{"box": {"center": [0.02, 0.02, -0.0101], "half_extent": [0.01, 0.05, 0.01]}},
                                 {"box": {"center": [0.38, 0.02, -0.0101], "half_extent": [0.01, 0.05, 0.01]}},
                                 {"sphere": {"center": [0.2, 0.02, 0.0401], "radius": 0.02}, "velocity": [0, 0, -5],
                                  "mass": 0.5}]), {})
    tile = block((n, n, 1), (0.2, 0.2, 0.008))
    yield "tile falls 1 m, tilted", tile, dict(base, obstacles=[floor]), above_floor(tile, [1, 0.4, 0], 5)


def struck(sunder, folder, pictures):
    print("| thing | mesh | order | cells | first fan, ms | at, mm | fans | pieces | seconds |\n"
          "|---|---|---|---|---|---|---|---|---|")
    for level in range(3):
        for name, (points, tetrahedra), scene, placed in struck_cases(level):
            write_mesh(folder / "body.msh", points, tetrahedra)
            for order in (1, 2):
                scene["bodies"] = [dict(mesh="body.msh", order=order, material=GLASS, **placed)]
                options = ["--frames", "0"]
                if pictures and level == 1:
                    options += ["--png", "2"]
                began = time.time()
                report, events, _ = run(sunder, folder, scene, options)
                fans = [e for e in events if "normal" in e]
                first = fans[0] if fans else None
                at = [round(1e3 * x) for x in first["rest_position"]] if first else "-"
                when = f"{1e3 * first['time']:.3f}" if first else "-"
                print(f"| {name} | {level + 1} | {order} | {report['tetrahedra']} | {when} | {at} | {report['fans']} | "
                      f"{report['components']} | {time.time() - began:.0f} |", flush=True)
                if pictures and level == 1:
                    shots = sorted((folder / "out").glob("picture_*.png"))
                    word = name.replace(" ", "_").replace(",", "").replace("/", "")
                    pictures.mkdir(parents=True, exist_ok=True)
                    (pictures / f"{word}_{order}.png").write_bytes(shots[-1].read_bytes())


def main():
    parts = {"cost": cost, "bending": bending, "three-point": three_point, "struck": struck}
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("sunder", type=lambda p: Path(p).resolve())
    parser.add_argument("--only", nargs="+", choices=parts, default=list(parts))
    parser.add_argument("--pictures", type=Path)
    arguments = parser.parse_args()
    for name in arguments.only:
        with tempfile.TemporaryDirectory() as folder:
            more = (arguments.pictures,) if name == "struck" else ()
            parts[name](arguments.sunder, Path(folder), *more)
            print()


if __name__ == "__main__":
    main()
