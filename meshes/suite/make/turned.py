# SPDX-License-Identifier: MIT
"""Boxes and planes turned together: centres that lie on a plane but for rounding."""

from fractions import Fraction

import shapes
from case import Case
from family import Family
from operations import fan, plane


def turned(vector):
    """By rotations of 3-4-5 and 5-12-13 triangles; only the last step rounds."""
    x, y, z = (Fraction(v) for v in vector)
    x, y = (3 * x - 4 * y) / 5, (4 * x + 3 * y) / 5
    y, z = (5 * y - 12 * z) / 13, (12 * y + 5 * z) / 13
    return float(x), float(y), float(z)


def turned_planes():
    points, tets = shapes.kuhn_box(3, 3, 3)
    body = [turned(p) for p in points], tets
    for name, normal in (("x", (-2, 1, 1)), ("y", (1, -2, 1)), ("z", (1, 1, -2))):
        n = turned(normal)
        yield Case(f"across-{name}", body, [fan(21, *n), fan(42, *n), fan(22, *(-v for v in n)),
                                            plane(n, 0)])


FAMILIES = [
    Family("44-turned-planes", "centres that rounding keeps off the plane count as on it",
           "built here", turned_planes),
]
