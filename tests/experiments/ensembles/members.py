# SPDX-License-Identifier: MIT
"""Seeded meshes of one body: its surface is turned at random, filled by `sunder-mesh`, and the mesh turned back."""
import itertools
import math
import pathlib
import random
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "meshes/scenes/charts"))
from make_meshes import medit


def box(low, high):
    """Points and outward triangles of a box."""
    points = [(x, y, z) for z in (low[2], high[2]) for y in (low[1], high[1]) for x in (low[0], high[0])]
    return points, [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6),
                    (0, 6, 2), (1, 3, 7), (1, 7, 5)]


def ball(radius, halvings=4):
    """An octahedron's triangles cut in four `halvings` times, on the sphere about the origin."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(halvings):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                sum_ = [x + y for x, y in zip(points[a], points[b])]
                length = math.hypot(*sum_)
                points.append(tuple(x / length for x in sum_))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    return [tuple(radius * x for x in p) for p in points], faces


def read_off(text):
    words = text.split()
    count, faces = int(words[1]), int(words[2])
    numbers = words[4:]
    points = [tuple(map(float, numbers[3 * k:3 * k + 3])) for k in range(count)]
    corners = list(map(int, numbers[3 * count:]))
    return points, [tuple(corners[4 * k + 1:4 * k + 4]) for k in range(faces)]


def off(points, faces):
    return (f"OFF\n{len(points)} {len(faces)} 0\n" + "".join("%r %r %r\n" % tuple(p) for p in points) +
            "".join("3 %d %d %d\n" % f for f in faces))


def rotation(source):
    """Rows of an evenly distributed rotation."""
    q = [source.gauss(0, 1) for _ in range(4)]
    w, x, y, z = (c / math.hypot(*q) for c in q)
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)))


def turned(rows, points):
    return [tuple(sum(a * b for a, b in zip(row, p)) for row in rows) for p in points]


def read_msh(text):
    """Points and tetrahedra of `sunder-mesh`'s output: one block of nodes numbered from 1, MSH
    4.1."""
    part = lambda name: text.split(f"${name}\n")[1].split(f"\n$End{name}")[0].split("\n")
    nodes, elements = part("Nodes"), part("Elements")
    count = int(nodes[0].split()[1])
    points = [tuple(map(float, line.split())) for line in nodes[2 + count:2 + 2 * count]]
    return points, [tuple(int(v) - 1 for v in line.split()[1:]) for line in elements[2:]]


def filled(program, surface, size, sharp, rows):
    """A surface turned, filled with tetrahedra of circumradius `size` (m) at most and turned back, as MEDIT; coordinates
    are rounded to 1e-9 m so that flat sides are flat."""
    points, faces = surface
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "surface.off").write_text(off(turned(rows, points), faces))
        subprocess.run([program, folder / "surface.off", "-o", folder / "mesh.msh", "--facet-size", str(size), "--cell-size",
                        str(size), "--feature-angle", "60" if sharp else "0"], check=True, capture_output=True, timeout=120)
        points, tetrahedra = read_msh((folder / "mesh.msh").read_text())
    back = turned(list(zip(*rows)), points)
    # Adding 0 makes -0.0 of a rounding 0.0.
    return medit([tuple(round(x, 9) + 0.0 for x in p) for p in back], tetrahedra)


def make_mesh(build, surface, size, sharp, seed, path):
    """Writes a mesh of the surface, turned by the seed. A mesh that `sunder check` refuses (the
    mesher leaves a tetrahedron without volume now and then in thin bodies) is named and made again
    from another turn."""
    path.parent.mkdir(parents=True, exist_ok=True)
    for attempt in itertools.count():
        rows = rotation(random.Random(f"turn {seed}" + (f" again {attempt}" if attempt else "")))
        path.write_text(filled(build / "apps/sunder-mesh/sunder-mesh", surface, size, sharp, rows))
        if subprocess.run([build / "sunder", "check", path], capture_output=True).returncode == 0:
            return
        path.unlink()
        print(f"{path.name}: refused, turned anew", file=sys.stderr)
