#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the meshes of the chart scenes beside itself, to the byte the same everywhere.

    python3 meshes/scenes/charts/make_meshes.py [--check]

--check writes nothing and tells whether the files are what would be written.
"""
import pathlib
import sys
from itertools import permutations


def box(cells, corner, size):
    """Kuhn's six tetrahedra a cell; points as rows (k (ny + 1) + j) (nx + 1) + i."""
    nx, ny, nz = cells
    points = [
        tuple(corner[a] + size[a] * (i, j, k)[a] / cells[a] for a in range(3))
        for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)
    ]
    row = lambda p: (p[2] * (ny + 1) + p[1]) * (nx + 1) + p[0]
    tetrahedra = []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                for order in permutations(range(3)):
                    p = [i, j, k]
                    path = [row(p)]
                    for axis in order:
                        p[axis] += 1
                        path.append(row(p))
                    odd = order in ((0, 2, 1), (1, 0, 2), (2, 1, 0))
                    tetrahedra.append((path[0], path[2], path[1], path[3]) if odd else tuple(path))
    return points, tetrahedra


def medit(points, tetrahedra):
    """The text of a MEDIT file; `tests/experiments` write theirs with it too."""
    lines = ["MeshVersionFormatted 2", "Dimension 3", f"Vertices\n{len(points)}"]
    lines += ["%r %r %r 0" % p for p in points]
    lines.append(f"Tetrahedra\n{len(tetrahedra)}")
    lines += [" ".join(str(v + 1) for v in t) + " 0" for t in tetrahedra]
    return "\n".join(lines + ["End\n"])


MESHES = {
    # 1 m long, square, one cell thick: the flat bar of docs/lab/impact.md in fewer cells.
    "bar": box((20, 1, 1), (0, 0, 0), (1, 0.05, 0.05)),
    # Slender enough to bend, short enough to be small; x = 0 is held.
    "cantilever": box((8, 2, 2), (0, -0.1, -0.1), (1, 0.2, 0.2)),
    # About its middle, for turning.
    "rod": box((10, 1, 1), (-0.5, -0.05, -0.05), (1, 0.1, 0.1)),
    # Three different moments of inertia.
    "slab": box((4, 2, 1), (-0.4, -0.2, -0.1), (0.8, 0.4, 0.2)),
}


def main():
    here = pathlib.Path(__file__).parent
    same = True
    for name, mesh in MESHES.items():
        path, text = here / f"{name}.mesh", medit(*mesh)
        if "--check" in sys.argv:
            same &= path.read_text() == text
        else:
            path.write_text(text)
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
