# SPDX-License-Identifier: MIT
"""Where a kernel is known to differ from the expectations, why, and its counts after loading."""

KEYS = ("vertices", "edges", "faces", "tetrahedra", "components", "boundary_faces",
        "boundary_sheets")

COPY = "CGAL's map has no such check: the copy is sewn to the tetrahedron it repeats"
TWIST = ("CGAL's map has no such check: the faces where the twist closes cannot be sewn and stay "
         "apart, which ones depends on the order of sewing")
BLIND = ("CGAL's map has no such check: the first two tetrahedra of each face are sewn, others "
         "stay apart")
POINTS = "CGAL's map knows no points: four corners are four, whatever they are called"
NOTHING = "CGAL's map has no such check: it is empty"

# Managed sew<3> and unsew<3> of CGAL, as topology/suite/kernels/cgal_kernel.cpp loads it.
CGAL = {
    "17-twisted-ring/refused": (TWIST, (20, 61, 66, 24, 1, 36, 1)),
    "18-copies/duplicate": (COPY, (4, 6, 4, 2, 1, 0, 0)),
    "18-copies/mirrored": (COPY, (4, 6, 4, 2, 1, 0, 0)),
    "18-copies/duplicate-in-a-body": (COPY, (12, 34, 36, 13, 1, 20, 1)),
    "18-copies/mirrored-in-a-body": (COPY, (12, 34, 36, 13, 1, 20, 1)),
    "19-three-on-a-face/refused": (BLIND, (9, 15, 11, 3, 2, 10, 2)),
    "21-defects/repeated-point": (POINTS, (9, 15, 11, 3, 2, 10, 2)),
    "21-defects/no-tetrahedron": (NOTHING, (0, 0, 0, 0, 0, 0, 0)),
    "21-defects/empty": (NOTHING, (0, 0, 0, 0, 0, 0, 0)),
    "32-not-orientable/closed": (TWIST, (18, 60, 80, 36, 1, 16, 2)),
    "32-not-orientable/less-a-ball": (TWIST, (19, 63, 81, 35, 1, 22, 2)),
    "32-not-orientable/projective-plane-times-interval": (TWIST, (20, 67, 78, 30, 1, 36, 1)),
    "32-not-orientable/cone-over-the-projective-plane": (TWIST, (11, 29, 29, 10, 1, 18, 1)),
    "42-refused-bodies/third-on-an-inner-face": (BLIND, (22, 63, 68, 25, 2, 36, 2)),
    "42-refused-bodies/every-tetrahedron-twice": (BLIND, (38, 115, 128, 48, 3, 64, 3)),
    "42-refused-bodies/every-tetrahedron-mirrored-too": (BLIND, (38, 115, 128, 48, 3, 64, 3)),
    "42-refused-bodies/one-of-two-twisted": (TWIST, (38, 118, 130, 48, 2, 68, 2)),
    "42-refused-bodies/repeated-point-inside": (POINTS, (22, 62, 66, 24, 2, 36, 2)),
}


def known_differences(fixture):
    """Of a fixture named "family/case"; empty for nearly all."""
    if fixture not in CGAL:
        return []
    why, counts = CGAL[fixture]
    return [{"kernel": "cgal", "why": why, "counts": dict(zip(KEYS, counts))}]
