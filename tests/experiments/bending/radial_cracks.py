#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Radial cracks of a struck disc of plexiglas: how many, by the speed of the ball, next to the
count of Vandenberghe, Vermorel and Villermaux (Physical Review Letters 110, 174302, 2013): 4 to 8,
growing with the root of the speed.

    tests/experiments/bending/radial_cracks.py SUNDER [--cell 0.003] [--centre 0.001] [--radius 0.03] [--seeds 3]
                                               [--orders 2] [--one-frame] [--step S] [--viscosity S] [--speeds KM_H ...]
                                               [--set KEY=VALUE ...]

A disc 1 mm thick, one layer of cells from an uneven mesh of triangles (python3-gmsh), free; a ball of steel, 4 mm, meets
its middle. After 0.2 ms a ring of it is looked at: parts of the ring that hang together across faces are the sectors
between radial cracks. One sector: no crack crosses the ring. Each tetrahedron has a frame of its own, in sub-steps,
damped as plexiglas is (--viscosity; a loss factor of 0.05 at 0.16 MHz); with --one-frame the whole disc has one, with
impact windows and their own viscosity."""
import argparse
import collections
import json
import math
import tempfile
from pathlib import Path

import gmsh
import meshio
import numpy

from order_tools import run_scene, write_mesh

PLEXIGLAS = {"young_modulus": 3.3e9, "poisson_ratio": 0.37, "density": 1190, "tensile_strength": 7e7,
             "toughness": 1.1e6}
THICKNESS, BALL = 1e-3, 2e-3


def disc(radius, cell, centre, seed):
    """Points and tetrahedra: prisms over triangles, each cut by the order of its points, so that neighbours agree.
    Triangles have edges of `centre` where the ball is, growing outwards to `cell`."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    for name, value in (("RandomSeed", seed), ("MeshSizeMax", cell), ("MeshSizeMin", centre),
                        ("MeshSizeExtendFromBoundary", 0), ("Algorithm", 5)):
        gmsh.option.setNumber("Mesh." + name, value)
    gmsh.model.occ.addDisk(0, 0, 0, radius, radius)
    gmsh.model.occ.rotate([(2, 1)], 0, 0, 0, 0, 0, 1, seed)
    gmsh.model.occ.synchronize()
    size = gmsh.model.mesh.field.add("MathEval")
    gmsh.model.mesh.field.setString(size, "F", f"min({cell}, {centre} + 0.3 * max(0, sqrt(x*x + y*y) - {BALL}))")
    gmsh.model.mesh.field.setAsBackgroundMesh(size)
    gmsh.model.mesh.generate(2)
    tags, places, _ = gmsh.model.mesh.getNodes()
    _, _, corners = gmsh.model.mesh.getElements(2)
    gmsh.finalize()
    used, triangles = numpy.unique(corners[0], return_inverse=True)
    order = numpy.argsort(tags)
    flat = places.reshape(-1, 3)[order[numpy.searchsorted(tags, used, sorter=order)]]
    points = numpy.vstack([flat - [0, 0, THICKNESS / 2], flat + [0, 0, THICKNESS / 2]])
    n, tetrahedra = len(flat), []
    for a, b, c in numpy.sort(triangles.reshape(-1, 3)):
        for cell_points in ((a, b, c, c + n), (a, b, c + n, b + n), (a, b + n, c + n, a + n)):
            p, q, r, s = cell_points
            places = points[[p, q, r, s]]
            turned = numpy.linalg.det(places[1:] - places[0]) < 0
            tetrahedra.append((p, q, s, r) if turned else (p, q, r, s))
    return points, numpy.array(tetrahedra)


def sectors(frame, inner, outer):
    """Parts of a ring, of at least a fiftieth of its cells."""
    mesh = meshio.read(frame)
    cells = numpy.vstack([c.data[:, :4] for c in mesh.cells if c.type.startswith("tetra")])
    centre = mesh.points[cells].mean(axis=1)
    distance = numpy.hypot(centre[:, 0], centre[:, 1])
    ring = numpy.flatnonzero((distance > inner) & (distance < outer))
    at_face = collections.defaultdict(list)
    for t in ring:
        for face in ((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)):
            at_face[tuple(sorted(cells[t][list(face)]))].append(t)
    parent = {t: t for t in ring}

    def root(t):
        while parent[t] != t:
            t = parent[t]
        return t

    for pair in at_face.values():
        if len(pair) == 2:
            parent[root(pair[0])] = root(pair[1])
    sizes = collections.Counter(root(t) for t in ring)
    return sum(size >= 0.02 * len(ring) for size in sizes.values())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sunder", type=Path)
    parser.add_argument("--cell", type=float, default=0.003, help="m, size of the triangles")
    parser.add_argument("--centre", type=float, help="m, size of those under the ball (as the others)")
    parser.add_argument("--radius", type=float, default=0.03, help="m")
    parser.add_argument("--seeds", type=int, default=3, help="meshes")
    parser.add_argument("--first-seed", type=int, default=1, help="of the first of them")
    parser.add_argument("--orders", type=int, nargs="*", default=[2])
    parser.add_argument("--one-frame", action="store_true", help="the disc's, with impact windows")
    parser.add_argument("--step", type=float, help="s, of the scene (1e-6; with --one-frame 1e-5)")
    parser.add_argument("--viscosity", type=float, default=5e-8, help="s, times the stiffness; of sub-steps")
    parser.add_argument("--set", nargs="*", default=[], metavar="KEY=VALUE", help="of the scene, as of `sunder run`")
    parser.add_argument("--speeds", type=float, nargs="*", default=[70, 140, 280], help="km/h")
    arguments = parser.parse_args()
    frames = {"time_step": arguments.step or 1e-6, "model": "corotational",
              "integrator": {"method": "sub_stepped", "damping": {"stiffness_factor": arguments.viscosity}}}
    if arguments.one_frame:
        frames = {"time_step": arguments.step or 1e-5}
    radius = arguments.radius
    print("| order | cells | km/h | first fan, us | sectors at 0.27, 0.42, 0.57 of the radius, by mesh | pieces | s | warnings |\n"
          "|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for order in arguments.orders:
            for speed in arguments.speeds:
                rows, first, pieces, warned, seconds = [], [], [], set(), 0
                for seed in range(arguments.first_seed, arguments.first_seed + arguments.seeds):
                    points, tetrahedra = disc(radius, arguments.cell, arguments.centre or arguments.cell, seed)
                    write_mesh(folder / "body.msh", points, tetrahedra)
                    scene = {**frames, "duration": 2e-4, "gravity": {"acceleration": [0, 0, 0]},
                             "fracture": {"crack": "object"},
                             "bodies": [{"mesh": "body.msh", "order": order, "material": PLEXIGLAS}],
                             "obstacles": [{"sphere": {"center": [0, 0, -THICKNESS / 2 - BALL - 1e-5], "radius": BALL},
                                            "velocity": [0, 0, speed / 3.6],
                                            "mass": 4 / 3 * math.pi * BALL**3 * 7800}]}
                    options = ["--frames", "2", *(word for key in arguments.set for word in ("--set", key))]
                    report, spent, _ = run_scene(arguments.sunder, folder, scene, options)
                    seconds += spent
                    warned |= {warning["code"] for warning in report["warnings"]}
                    frame = sorted((folder / "out" / "frames").glob("*.vtu"))[-1]
                    rows.append([sectors(frame, a * radius, b * radius) for a, b in ((.2, .35), (.35, .5), (.5, .65))])
                    lines = (folder / "out" / "events.jsonl").read_text().splitlines()
                    fan = next((line for line in lines if '"normal"' in line), None)
                    first.append(f"{1e6 * json.loads(fan)['time']:.0f}" if fan else "none")
                    pieces.append(str(report["components"]))
                told = "; ".join(", ".join(map(str, row)) for row in rows)
                print(f"| {order} | {len(tetrahedra)} | {speed:.0f} | {', '.join(first)} | {told} | {', '.join(pieces)} | "
                      f"{seconds:.0f} | {', '.join(sorted(warned))} |", flush=True)


if __name__ == "__main__":
    main()
