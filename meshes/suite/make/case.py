# SPDX-License-Identifier: MIT
"""Runs a case's operations on the glued body and writes down what comes out."""

import math
from collections import Counter
from fractions import Fraction

from differences import known_differences
from findings import findings
from homology import betti_mod, integer_homology, orbit_complex, universal_coefficients
from shapes import Random, centroid, kuhn_box
from twin import Glued, file_cells

# Above these numbers an expectation would be large, or slow to make or to hold a kernel against.
LISTED_SPLITS = 200
FIELDS_UP_TO = 7000
INTEGERS_UP_TO = 1700


class Case:
    """`body`: (points, tetrahedra). `written`: how the JSON gives it, where that is shorter.
    `cracks`: labels, as the JSON has them. `page`: numbers known beforehand, held against what is
    computed."""

    def __init__(self, name, body, operations=(), **more):
        self.name, self.body, self.operations = name, body, list(operations)
        self.shows = more.pop("shows", None)
        self.written = more.pop("written", None)
        self.page = more.pop("page", {})
        self.cracks = more.pop("cracks", [])
        assert not more, more


def box_case(name, cells, operations=(), **more):
    """A box that the JSON only names."""
    return Case(name, kuhn_box(*cells), operations, written={"kuhn_box": list(cells)}, **more)


# Directions and centres that differ by less are equal (docs/reference/suite.md).
EQUAL = Fraction(1, 10**6)


def canonical(normal):
    """Divided by its component of largest magnitude, the first of those equal to 1e-6; exact."""
    normal = [Fraction(x) for x in normal]
    largest = max(map(abs, normal))
    return [x / next(y for y in normal if abs(y) >= (1 - EQUAL) * largest) for x in normal]


def is_positive(points, tet, normal, at):
    """Exact sign; what lies on the plane to the tolerance is positive. The kernels decide in
    floating point: no centre of the suite may be near to the tolerance's edge."""
    normal = canonical(normal)
    centre = centroid(points, tet)
    value = sum(a * (x - Fraction(y)) for a, x, y in zip(normal, centre, at))
    if value != 0:
        size = max([abs(x) for p in tet for x in points[p]] + [abs(x) for x in at])
        radius = max(math.dist(centre, points[p]) for p in tet)
        tolerance = float(EQUAL) * radius + 2e-15 * float(size)
        limit = math.hypot(*normal) * tolerance
        if abs(value) < 0.99 * limit:
            return True
        assert abs(value) > 1.01 * limit, f"{tet} is too near to the tolerance's edge"
    return value >= 0


def faces_between(glued, tets, positive, through=None):
    """Glued faces (through a point) from a positive to a negative one of the tetrahedra."""
    faces = []
    for t in sorted(tets):
        for p in range(4):
            across = glued.other[4 * t + p]
            if across < 0 or not positive[t] or glued.tets[t][p] == through:
                continue
            if not positive[across // 4]:
                faces.append(4 * t + p)
    return faces


def fan_faces(glued, points, fan):
    point = fan["point"]
    star = glued.vertex_corners(fan.get("tetrahedron", glued.around[point][0]), point)
    positive = {t: is_positive(points, glued.tets[t], fan["normal"], points[point]) for t in star}
    return faces_between(glued, star, positive, point)


def plane_faces(glued, points, plane):
    normal = [Fraction(x) for x in plane["normal"]]
    foot = Fraction(plane["offset"]) / sum(x * x for x in normal)
    at = [foot * x for x in normal]
    positive = [is_positive(points, t, normal, at) for t in glued.tets]
    return faces_between(glued, range(len(glued.tets)), positive)


def break_faces(glued, cracks, what):
    """At all copies of the point, from positive tetrahedra to negative ones."""
    crack = cracks[what["crack"]]
    sides = dict.fromkeys(crack["positive"], 1) | dict.fromkeys(crack["negative"], -1)
    around = glued.around[what["point"]]
    return faces_where(glued, around, what["point"],
                       lambda t, u: sides.get(t) == 1 and sides.get(u) == -1)


def faces_where(glued, tets, through, differ):
    """Glued faces of these tetrahedra, that have a point, between t and u with differ(t, u)."""
    return [h for t in sorted(tets) for h in range(4 * t, 4 * t + 4)
            if glued.tets[t][h % 4] != through and glued.other[h] >= 0
            and differ(t, glued.other[h] // 4)]


def check_breaks(case, intact, glued):
    """Breaks alone: the faces split are the union over the breaks, in this order and reversed."""
    breaks = [operation["break"] for operation in case.operations]
    again = Glued(case.body[1])
    union = {h for b in breaks for h in break_faces(again, case.cracks, b)}
    cut = {h for h, across in enumerate(intact) if across >= 0 > glued.other[h]}
    assert cut == union | {intact[h] for h in union}
    for b in reversed(breaks):
        again.split_all(break_faces(again, case.cracks, b))
    assert again.other == glued.other and again.counts() == glued.counts()


def shatter_faces(glued, intact, order):
    faces = [h for h, across in enumerate(intact) if across > h]
    if order == "falling":
        faces.reverse()
    elif order != "rising":
        Random(order["seed"]).shuffle(faces)
    return [h for h in faces if glued.other[h] >= 0]


def half_face_of(glued, face):
    """A face named by its points (seen from its lower tetrahedron) or by one of its sides."""
    if isinstance(face, dict):
        t = face["tetrahedron"]
        return 4 * t + glued.tets[t].index(face["opposite"])
    return glued.sides[tuple(sorted(face))][0]


def faces_of(glued, intact, case, operation):
    points = case.body[0]
    (kind, what), = operation.items()
    if kind == "split":
        return [half_face_of(glued, what)]
    if kind == "fan":
        return fan_faces(glued, points, what)
    if kind == "plane":
        return plane_faces(glued, points, what)
    if kind == "break":
        return break_faces(glued, case.cracks, what)
    return shatter_faces(glued, intact, what)


def named(glued, operation):
    """The operation; a fan at a point with several vertices gets the lowest tetrahedron there."""
    fan = operation.get("fan", {"tetrahedron": None})
    if "tetrahedron" in fan or glued.vertex_orbits(fan["point"]) == 1:
        return operation
    return {"fan": {"tetrahedron": glued.around[fan["point"]][0]} | fan}


def run(glued, intact, case, operation):
    """Does one operation; the answers of its splits (None for a glue)."""
    if "glue" not in operation:
        return glued.split_all(faces_of(glued, intact, case, operation))
    a = half_face_of(glued, operation["glue"])
    assert glued.other[a] < 0 <= intact[a], f"{operation} glues what is not parted"
    glued.glue(a, intact[a])
    return None


def euler(counts):
    return counts["vertices"] - counts["edges"] + counts["faces"] - counts["tetrahedra"]


def state(glued):
    """What is expected of the body as it is now."""
    counts = glued.counts()
    expected = {"counts": counts, "euler_characteristic": euler(counts)}
    if len(glued.tets) > FIELDS_UP_TO:
        return expected
    columns = orbit_complex(glued)
    betti = {f"GF({p})": betti_mod(columns, p) for p in (2, 3)}
    expected["betti"] = betti
    for numbers in betti.values():
        assert numbers[0] - numbers[1] + numbers[2] - numbers[3] == euler(counts)
        assert numbers[0] == counts["components"]
    if len(glued.tets) <= INTEGERS_UP_TO:
        homology = expected["homology"] = integer_homology(columns)
        for p in (2, 3):
            assert betti[f"GF({p})"] == universal_coefficients(homology, p)
    expected["orientable"] = glued.orientable()
    return expected


def check_laws(before, after, answer):
    """The laws of a split (docs/reference/suite.md), for an operation that is a single one."""
    s_v, s_e = len(answer["vertices"]), len(answer["edges"])
    change = {key: after["counts"][key] - before["counts"][key] for key in before["counts"]}
    assert (change["vertices"], change["edges"], change["faces"]) == (s_v, s_e, 1), change
    assert (s_v == 0 or s_e >= 2) and (s_v < 2 or s_e == 3)
    assert change["components"] == (1 if answer["separated"] else 0)
    assert not answer["separated"] or s_v == 3
    if "betti" in after:
        old, new = before["betti"]["GF(2)"], after["betti"]["GF(2)"]
        jump = tuple(n - o for n, o in zip(new, old))[:3] if old[3] == new[3] else None
        allowed = {(0, 0): {(0, 0, 1), None}, (0, 1): {(0, 0, 0)}, (1, 2): {(0, 0, 0)},
                   (2, 3): {(0, 0, 0)}, (0, 2): {(0, 0, -1), (0, 1, 0)},
                   (1, 3): {(0, 0, -1), (0, 1, 0)}, (3, 3): {(1, 0, 0), (0, -1, 0)},
                   (0, 3): {(0, 2, 0), (0, 1, -1), (0, 0, -2)}}
        assert jump in allowed[s_v, s_e], (s_v, s_e, jump)


def what_splits_did(answers):
    """The expectations about an operation's own splits."""
    done = [a for a in answers if a is not None]
    expected = {}
    if len(answers) <= LISTED_SPLITS:
        expected["splits"] = [{"refused": True} if a is None else a for a in answers]
    tally = Counter((len(a["vertices"]), len(a["edges"])) for a in done)
    expected["tally"] = {f"{v},{e}": n for (v, e), n in sorted(tally.items())}
    expected["predicted"] = sum(1 for a in done if len(a["vertices"]) == 3)
    expected["separations"] = sum(1 for a in done if a["separated"])
    return expected


def hold_against_page(page, expected, splits):
    """Compares what a page says: cells (V, E, F, T, CC), chi, betti (b0, b1, b2), ..."""
    counts = expected["counts"]
    five = tuple(counts[k] for k in ("vertices", "edges", "faces", "tetrahedra", "components"))
    said = {"cells": five, "chi": expected["euler_characteristic"],
            "sheets": counts["boundary_sheets"]}
    if "betti" in expected:
        said["betti"] = tuple(expected["betti"]["GF(2)"][:3])
        said["b3"] = expected["betti"]["GF(2)"][3]
    if splits is not None:
        said["tally"] = splits["tally"]
        said["predicted"], said["separations"] = splits["predicted"], splits["separations"]
        said["split"] = next(iter(splits["tally"]), None)
    for key, value in page.items():
        assert said[key] == value, f"page says {key} {value}, computed {said[key]}"


def written(family, case):
    """The case of a family as the JSON holds it, every expectation computed."""
    points, tets = case.body
    codes, refused = findings(points, tets)
    result = {"name": case.name}
    if case.shows:
        result["shows"] = case.shows
    result["body"] = case.written or {"points": points, "tetrahedra": tets}
    result["findings"] = codes
    if refused:
        result["refused"] = True
        assert not case.operations
    usable = tets and not {"index_out_of_range", "repeated_vertex"} & set(codes)
    if usable:
        result["file_cells"] = file_cells(tets)
        assert case.page.get("file", tuple(result["file_cells"])) == tuple(result["file_cells"])
    if not refused:
        run_case(case, result)
    if differences := known_differences(f"{family}/{case.name}"):
        result["known_differences"] = differences
    return result


def run_case(case, result):
    glued = Glued(case.body[1])
    intact = list(glued.other)
    now = result["built"] = state(glued)
    hold_against_page(case.page.get("built", {}), now, None)
    if case.cracks:
        result["cracks"] = case.cracks
    result["operations"] = []
    pages = case.page.get("after", {})
    for n, operation in enumerate(case.operations):
        before, operation = now, named(glued, operation)
        answers = run(glued, intact, case, operation)
        now = state(glued)
        splits = None if answers is None else what_splits_did(answers)
        if answers is not None and len(answers) == 1 and answers[0] is not None:
            check_laws(before, now, answers[0])
        hold_against_page(pages.get(n, {}), now, splits)
        result["operations"].append(operation | {"after": (splits or {}) | now})
    assert set(pages) <= set(range(len(case.operations)))
    if case.operations and all("break" in operation for operation in case.operations):
        check_breaks(case, intact, glued)
    if "total" in case.page:
        total = Counter()
        for operation in result["operations"]:
            total.update(operation["after"].get("tally", {}))
        assert total == case.page["total"], f"page says {case.page['total']}, computed {total}"
