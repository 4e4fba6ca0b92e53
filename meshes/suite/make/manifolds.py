# SPDX-License-Identifier: MIT
"""Bodies that no space holds: lens spaces, products, homology spheres, cones over surfaces."""

from itertools import combinations

import complexes
import shapes
from case import Case
from complexes import facets, placed, renamed, without
from family import Family
from operations import fan, glue, mixture, plane, shatters, split
from twin import Glued

NOWHERE = " (points anywhere: folded)"


def closed_and_holed(name, tets, seed, closed, holed, shatter="falling"):
    """A closed manifold, and the same less one tetrahedron. `closed`, `holed`: (betti over GF(2),
    homology over Z in words), asserted."""
    for kind, body, (betti, b3) in (("closed", placed(tets, seed), closed),
                                    ("less-a-ball", placed(without(tets, 0), seed), holed)):
        page = {"built": {"betti": betti, "b3": b3}}
        yield Case(f"{name}-{kind}-mixture", body, mixture(body, seed), page=page)
        yield Case(f"{name}-{kind}-shatter", body, [{"shatter": shatter}], page=page)


def lens_spaces():
    yield from closed_and_holed("projective-space", facets(complexes.PROJECTIVE_SPACE), 29,
                                ((1, 1, 1), 1), ((1, 1, 1), 0))
    for p, q, betti in ((2, 1, (1, 1, 1)), (3, 1, (1, 0, 0)), (5, 2, (1, 0, 0))):
        yield from closed_and_holed(f"lens-{p}-{q}", complexes.lens_space(p, q), 29 + p,
                                    (betti, 1), (betti, 0))


def products():
    tets = complexes.circle_times_sphere()
    yield from closed_and_holed("circle-times-sphere", tets, 30, ((1, 1, 1), 1), ((1, 1, 1), 0),
                                "rising")
    torus = complexes.three_torus()
    yield from closed_and_holed("three-torus", torus, 31, ((1, 3, 3), 1), ((1, 3, 3), 0))


def twisted():
    tets = complexes.circle_times_sphere(twisted=True)
    assert not Glued(tets).orientable()
    yield Case("closed", placed(tets, 32))
    yield Case("less-a-ball", placed(without(tets, 0), 32))
    plane_times_interval = prism(projective_plane())
    assert not Glued(plane_times_interval).orientable()
    yield Case("projective-plane-times-interval", placed(plane_times_interval, 33))
    yield Case("cone-over-the-projective-plane", placed(cone(projective_plane()), 34))


def poincare():
    tets = facets(complexes.POINCARE_SPHERE)
    yield from closed_and_holed("poincare-sphere", tets, 35, ((1, 0, 0), 1), ((1, 0, 0), 0))


def torus():
    """Seven points, each pair an edge (Moebius, Csaszar)."""
    return [tuple(sorted(((i + a) % 7, (i + b) % 7, (i + c) % 7)))
            for i in range(7) for a, b, c in ((0, 1, 3), (0, 2, 3))]


def projective_plane():
    """Six points, each pair an edge."""
    return [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 1, 5),
            (1, 2, 4), (2, 3, 5), (1, 3, 4), (2, 4, 5), (1, 3, 5)]


def sphere():
    return list(combinations(range(4), 3))


def cone(triangles, apex=100):
    return renamed([(*t, apex) for t in triangles])


def prism(triangles):
    """A surface times an interval."""
    return renamed([tuple([(0, p) for p in t[:k + 1]] + [(1, p) for p in t[k:]])
                    for t in triangles for k in range(3)])


def elsewhere(triangles, by):
    return [tuple(p + by for p in t) for t in triangles]


def cones():
    suspended = renamed([(*t, apex) for t in torus() for apex in (100, 101)])
    body = placed(suspended, 36)
    page = {"built": {"betti": (1, 0, 2), "b3": 1}}
    yield Case("suspended-torus-mixture", body, mixture(body, 36, 1), page=page,
               shows="a vertex may have a torus around it: one orbit, not a manifold")
    yield from shatters("suspended-torus", body, page=page)
    body = placed(cone(torus()), 37)
    yield Case("cone-over-a-torus", body,
               [fan(7, 1, 0, 0), fan(7, 0, 1, 0, tetrahedron=0), {"shatter": "rising"}],
               page={"built": {"betti": (1, 0, 0), "sheets": 1}})
    body = placed(cone(sphere() + elsewhere(torus(), 10) + elsewhere(sphere(), 20)), 38)
    yield Case("three-cones-at-one-point", body, mixture(body, 38, 1) + [{"shatter": {"seed": 3}}],
               page={"built": {"sheets": 3}}, shows="one point, three vertices")
    thick = placed(prism(torus()), 39)
    yield Case("thick-torus", thick, mixture(thick, 39) + [{"shatter": "falling"}],
               page={"built": {"betti": (1, 2, 1), "sheets": 2}})


def pinches():
    two_cubes = shapes.kuhn_cubes((2, 2, 1), lambda i, j, k: i == j)
    yield Case("two-cubes-at-an-edge", two_cubes, mixture(two_cubes, 40),
               page={"built": {"chi": 2, "sheets": 2}})
    edge_only = shapes.kuhn_cubes((2, 2, 3), lambda i, j, k: k != 1 or i != j)
    yield Case("edge-alone", edge_only, [*mixture(edge_only, 41), {"shatter": "falling"}],
               shows="an edge may be pinched where none of its ends is")
    strangled = shapes.kuhn_cubes((2, 2, 2), lambda i, j, k: not i == j == k)
    yield Case("strangled-vertex", strangled,
               [fan(13, 1, -1, 0), fan(13, 1, 1, -2), fan(13, 0, 1, 0), {"shatter": "rising"}],
               page={"built": {"betti": (1, 0, 0), "chi": 1}},
               shows="two hollows meet at a vertex from opposite sides: an annulus around it is "
                     "still one orbit")
    yield from shatters("strangled-vertex", strangled)
    box = shapes.kuhn_box(2, 2, 2)
    quarter = ((9, 10, 13), (9, 12, 13)), ((13, 14, 17), (13, 16, 17)), ((10, 11, 14), (10, 13, 14))
    yield Case("two-cracks-meet", box,
               [split(*f) for faces in quarter for f in faces] + [split(12, 13, 16),
                                                                  glue(9, 10, 13)],
               shows="two cracks that touch at a vertex from opposite sides do not split it, nor "
                     "does a third; closing their ring does")
    chain = shapes.kuhn_cubes((3, 3, 3), lambda i, j, k: i == j == k)
    yield Case("cubes-corner-to-corner", chain, [plane((0, 0, 1), 1.5), {"shatter": "rising"}],
               page={"built": {"chi": 3, "sheets": 3}})


FAMILIES = [
    Family("28-cones", "vertices with surfaces other than discs and spheres around them" + NOWHERE,
           "the 7-point torus of Moebius and Csaszar, suspended, coned and thickened", cones),
    Family("29-pinches", "bodies that touch themselves at points and edges",
           "topology cases, section 3; pseudomanifolds", pinches),
    Family("30-lens-spaces", "torsion: RP3 has b1 = 1 over GF(2) and 0 over Q" + NOWHERE,
           "RP3 with 11 points: D. W. Walkup, Acta Math. 125 (1970); L(p,q): the join of two "
           "circles modulo Z/p, made smaller by contracting edges", lens_spaces),
    Family("31-products", "handles that no cut in space has" + NOWHERE,
           "S1 x S2 and the three-torus, built here", products),
    Family("32-not-orientable", "bodies that a 3-map cannot hold are refused" + NOWHERE,
           "the twisted product of S1 and S2; RP2 times an interval and the cone over it",
           twisted),
    Family("33-poincare-sphere", "less a ball it has the homology of a ball and is none" + NOWHERE,
           "A. Bjorner, F. H. Lutz, Experiment. Math. 9 (2000)", poincare),
]
