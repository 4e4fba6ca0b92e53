# SPDX-License-Identifier: MIT
"""Thin things of glass and the bodies that strike them: panes, a cup, a vase, a beam, a tile."""
import math

import numpy

from second_order import KUHN, block

GLASS = {"young_modulus": 7e10, "poisson_ratio": 0.22, "density": 2500, "tensile_strength": 4e7,
         "toughness": 7.5e5}


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
            # A prism of the hub; its diagonals leave the outer side as the next ring has it.
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
    base = {"time_step": 1e-4, "duration": 0.001}
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
