# SPDX-License-Identifier: MIT
"""The first 24 fixtures. `page`: their numbers as known beforehand."""

from itertools import permutations

import shapes
from case import Case, box_case
from family import Family
from operations import BALL, SHATTERS, fan, glue, plane, shatters, split, split_side
from twin import Glued

PAGE = "topology cases, section 2, fixture "
def splits_of(*texts):
    """Page numbers of single splits: "1,2", or "3,3 new" where a component must appear."""
    pages = {}
    for n, text in enumerate(texts):
        counts, *new = text.split()
        pages[n] = {"split": counts, "separations": len(new)}
    return pages


def one():
    body = shapes.one_tetrahedron()
    yield Case("four-faces", body, [split(1, 2, 3), split(0, 2, 3), split_side(0, 2),
                                    split_side(0, 3), *SHATTERS[:1]],
               page={"built": {"cells": (4, 6, 4, 1, 1), "chi": 1, "betti": BALL},
                     "file": (4, 6, 4),
                     "after": {n: {"cells": (4, 6, 4, 1, 1), "tally": {}} for n in range(5)}})


def two():
    body = shapes.two_tetrahedra()
    whole = {"cells": (5, 9, 7, 2, 1), "chi": 1, "betti": BALL}
    apart = {"cells": (8, 12, 8, 2, 2)}
    cut = apart | {"split": "3,3", "separations": 1, "predicted": 1}
    yield Case("split-and-glue", body, [split(0, 1, 2), glue(0, 1, 2), split_side(1, 4),
                                        split(0, 1, 2), glue(2, 1, 0), split_side(0, 3)],
               page={"built": whole, "file": (5, 9, 7),
                     "after": {0: cut, 1: whole, 2: cut, 3: apart | {"tally": {}}, 4: whole,
                               5: cut}})
    yield Case("fan-at-each-corner", body, [fan(0, 0, 0, 1), glue(0, 1, 2), fan(3, 0, 0, 1),
                                            fan(4, 1, 2, 3), fan(2, 0, 0, -1)])
    yield Case("plane", body, [plane((0, 0, 1), 0), glue(0, 1, 2), plane((0, 0, 1), 5),
                               plane((0, 0, -2), 0.25)])


def edge_contact():
    yield Case("as-it-is", shapes.two_sharing_an_edge(), [*SHATTERS[:1], split(0, 1, 2)],
               page={"built": {"cells": (8, 12, 8, 2, 2), "chi": 2, "betti": (2, 0, 0)},
                     "file": (6, 11, 8), "after": {0: {"tally": {}}}})


def vertex_contact():
    yield Case("as-it-is", shapes.two_sharing_a_vertex(),
               [*SHATTERS[:1], fan(0, 1, 1, 1, tetrahedron=0), fan(0, 1, 1, 1, tetrahedron=1)],
               page={"built": {"cells": (8, 12, 8, 2, 2), "chi": 2, "betti": (2, 0, 0)},
                     "file": (7, 12, 8), "after": {0: {"tally": {}}}})


def closed_fans():
    for k in (3, 4, 6):
        texts = ["1,2"] + ["3,3 new"] * (k - 1)
        pages = splits_of(*texts)
        pages[k - 1] |= {"cells": (4 * k, 6 * k, 4 * k, k, k)}
        yield Case(f"k-{k}", shapes.closed_fan(k), [split(0, 1, 2 + i) for i in range(k)],
                   page={"built": {"cells": (k + 2, 3 * k + 1, 3 * k, k, 1), "chi": 1,
                                   "betti": BALL},
                         "file": (k + 2, 3 * k + 1, 3 * k), "after": pages})
        yield Case(f"k-{k}-fan", shapes.closed_fan(k),
                   [fan(0, 1, 0.25, 0), fan(1, -0.25, 1, 0, tetrahedron=0), *SHATTERS[1:2]])


def open_fan():
    body = shapes.open_fan(4)
    yield Case("middle-face", body, [split(0, 1, 4), glue(0, 1, 4), split(0, 1, 3)],
               page={"built": {"cells": (7, 15, 13, 4, 1)}, "file": (7, 15, 13),
                     "after": {0: {"split": "3,3", "separations": 1,
                                   "cells": (10, 18, 14, 4, 2)}}})
    yield from shatters("all", body)


def octahedron():
    body = shapes.octahedron_star()
    built = {"cells": (7, 18, 20, 8, 1), "chi": 1, "betti": BALL}
    halves = {"cells": (12, 26, 24, 8, 2)}
    round_about = splits_of("0,1", "1,2", "1,2", "3,3 new")
    round_about[0] |= {"cells": (7, 19, 21, 8, 1)}
    round_about[3] |= halves
    crossed = splits_of("0,1", "0,1", "2,3", "3,3 new")
    crossed[3] |= halves
    yield Case("round", body, [split(0, 1, 2), split(0, 2, 3), split(0, 3, 4), split(0, 4, 1)],
               shows="after the first cut 19 edges and 21 faces, of which a file can tell 18 and "
                     "20 apart",
               page={"built": built, "file": (7, 18, 20), "after": round_about})
    yield Case("opposite-first", body,
               [split(0, 1, 2), split(0, 3, 4), split(0, 2, 3), split(0, 4, 1)],
               page={"built": built, "file": (7, 18, 20), "after": crossed})
    yield Case("fan", body, [fan(0, 0, 0, 1), glue(0, 1, 2), glue(0, 2, 3),
                             fan(0, 1, 0.25, 0.125)],
               page={"after": {0: halves | {"separations": 1}}})
    yield Case("plane-through-centres", body, [plane((1, -1, 0), 0), plane((0, 0, 1), 0.25)],
               shows="centres exactly on the plane count as positive")
    yield from shatters("all", body)


def figure_4():
    body = shapes.ring(3, 3)
    built = {"cells": (32, 112, 128, 48, 1), "chi": 0, "betti": (1, 1, 0)}
    pages = splits_of("1,2", "3,3", "1,2", "3,3 new")
    pages[1] |= {"predicted": 1, "betti": (1, 0, 0)}
    pages[3] |= {"cells": (40, 122, 132, 48, 2), "chi": 2}
    sections = [split(1, 5, 21), split(1, 17, 21), split(9, 13, 29), split(9, 25, 29)]
    yield Case("two-sections", body, sections,
               page={"built": built, "file": (32, 112, 128), "after": pages})
    yield Case("glued-again", body, sections[:3] + [glue(1, 17, 21), glue(1, 5, 21), sections[3],
                                                    glue(9, 13, 29), glue(9, 25, 29)],
               page={"after": {7: built}})
    yield Case("fans", body, [fan(5, 1, 0, 0), fan(1, 1, 0, 0), fan(22, 0, 1, 0),
                              fan(10, 0, 1, 0), fan(26, 1, 1, 0)])
    yield from shatters("all", body, page={"built": built})


def figure_5():
    faces = {"a": (1, 4, 14), "b": (4, 14, 17), "c": (4, 7, 17)}
    said = {"abc": ("0,1", "0,2", "3,3"), "bac": ("0,1", "0,2", "3,3"),
            "acb": ("0,1", "1,2", "2,3"), "bca": ("0,1", "2,3", "1,2"),
            "cab": ("1,2", "0,1", "2,3"), "cba": ("1,2", "1,2", "1,2")}
    assert set(said) == {"".join(p) for p in permutations("abc")}
    for order, texts in said.items():
        pages = splits_of(*texts)
        fooled = texts[2] == "3,3"
        pages[1] |= {"betti": (1, 1, 0) if fooled else BALL}
        pages[2] |= {"cells": (30, 104, 123, 48, 1), "predicted": int(fooled), "betti": BALL}
        yield Case(order, shapes.kuhn_box(2, 2, 2), [split(*faces[f]) for f in order],
                   page={"built": {"cells": (27, 98, 120, 48, 1), "chi": 1, "betti": BALL},
                         "file": (27, 98, 120), "after": pages})


def cavity():
    solid, hollow = shapes.kuhn_box(3, 3, 3), shapes.shell(3, 3, 3)
    cuts = [fan(21, 0, 0, 1), fan(42, 1, 2, 3), plane((0, 0, 1), 1), split(0, 1, 5),
            split(0, 1, 21), plane((1, 1, 0.5), 3.125)]
    yield Case("solid", solid, cuts,
               page={"built": {"cells": (64, 279, 378, 162, 1), "chi": 1, "betti": BALL,
                               "sheets": 1}, "file": (64, 279, 378)})
    yield Case("cavity", hollow, cuts,
               page={"built": {"cells": (64, 278, 372, 156, 1), "chi": 2, "betti": (1, 0, 1),
                               "sheets": 2}, "file": (64, 278, 372)})
    yield Case("tunnel-into-the-cavity", hollow, [fan(21, 0, 0, 1), fan(21, 1, 0, 0)])


def channels():
    body = shapes.crossing_channels()
    built = {"cells": (64, 266, 332, 132, 1), "chi": -2, "betti": (1, 3, 0)}
    yield Case("three-handles", body, [plane((1, 0, 0), 1), plane((0, 1, 0), 1),
                                       plane((0, 0, 1), 1.5)],
               shows="each false positive cuts a handle: at most three before a separation",
               page={"built": built, "file": (64, 266, 332),
                     "after": {0: {"predicted": 2, "separations": 1},
                               1: {"predicted": 4, "separations": 2},
                               2: {"predicted": 4, "separations": 4}}})
    yield from shatters("all", body)


def interior_crack():
    body = shapes.kuhn_box(4, 4, 4)
    pages = splits_of("0,0", "0,1")
    pages[0] |= {"betti": (1, 0, 1), "sheets": 2}
    pages[1] |= {"betti": (1, 0, 1)}
    yield Case("two-faces", body, [split(32, 37, 62), split(32, 57, 62), glue(32, 37, 62),
                                   fan(62, 0, 0, 1), fan(62, 1, 1, 1)],
               shows="a crack inside cannot be told by vertex numbers: it needs a list of sides",
               page={"built": {"cells": (125, 604, 864, 384, 1)}, "file": (125, 604, 864),
                     "after": pages})


def growing_disc(body, centre):
    """The faces opposite to a centre, each in its turn one that makes a disc grow."""
    glued = Glued(body[1])
    link = [4 * t + glued.tets[t].index(centre) for t in glued.around[centre]]
    order = []
    while link:
        for h in link:
            trial = Glued(body[1])
            for done in order + [h]:
                answer = trial.split(done)
            grown = len(answer["vertices"]), len(answer["edges"])
            if grown in ((0, 1), (1, 2), (3, 3)) or not order:
                break
        order.append(h)
        link.remove(h)
    return [(h // 4, glued.tets[h // 4][h % 4]) for h in order]


def cut_out_star():
    body = shapes.kuhn_box(4, 4, 4)
    sides = growing_disc(body, 62)
    assert len(sides) == 24
    last = {"cells": (139, 640, 888, 384, 2), "chi": 3, "betti": (2, 0, 1), "split": "3,3",
            "separations": 1, "predicted": 1}
    yield Case("link-faces-as-a-growing-disc", body, [split_side(*side) for side in sides],
               page={"built": {"cells": (125, 604, 864, 384, 1)}, "after": {23: last},
                     "total": {"0,0": 1, "0,1": 11, "1,2": 11, "3,3": 1}})


def closed():
    body = shapes.simplex_boundary()
    whole = {"cells": (5, 10, 10, 5, 1), "chi": 0, "b3": 1}
    yield Case("first-cut", body, [split_side(0, 1), glue(2, 3, 4), split(0, 1, 2),
                                   fan(4, 1, 2, 3)],
               page={"built": whole, "file": (5, 10, 10),
                     "after": {0: {"split": "0,0", "chi": 1, "b3": 0}, 1: whole}})
    yield from shatters("all", body)


def pinched_bar():
    built = {"cells": (20, 61, 66, 24, 1), "chi": 1}
    at_vertex = shapes.bent_bar(4, {(0, 0): (0, 0)})
    at_edge = shapes.bent_bar(4, {(0, 0): (0, 0), (0, 1): (0, 1)})
    for name, body, file in (("at-a-vertex", at_vertex, (19, 61, 66)),
                             ("at-an-edge", at_edge, (18, 60, 66))):
        far = max(t for t in range(24) if 0 in body[1][t])
        cuts = [fan(0, 0, 1, 0, tetrahedron=0), fan(0, 0, 1, 0.5, tetrahedron=far),
                plane((1, 0.5, 0), 0.125), plane((0, 0, 1), 0.5)]
        yield Case(name, body, cuts, page={"built": built, "file": file})
        yield from shatters(name, body)


def orientable_ring():
    body = shapes.joined_ring(4)
    yield Case("cut-through", body, [plane((0, 1, 0), 0.125), plane((1, 0.25, 0.125), 0.0625)],
               page={"built": {"cells": (16, 56, 64, 24, 1), "chi": 0, "betti": (1, 1, 0)},
                     "file": (16, 56, 64)})
    yield from shatters("all", body)


def twisted_ring():
    body = shapes.joined_ring(4, twisted=True)
    glued = Glued(body[1])
    assert list(glued.counts().values())[:5] == [16, 56, 64, 24, 1] and not glued.orientable()
    yield Case("refused", body, page={"file": (16, 56, 64)})


def copies():
    points, tets = shapes.one_tetrahedron()
    blind = Glued([(0, 1, 2, 3), (1, 0, 2, 3)])
    assert list(blind.counts().values())[:5] == [4, 6, 4, 2, 1]
    yield Case("duplicate", (points, tets + [(1, 2, 0, 3)]), page={"file": (4, 6, 4)})
    yield Case("mirrored", (points, tets + [(1, 0, 2, 3)]), page={"file": (4, 6, 4)})
    points, tets = shapes.kuhn_box(2, 1, 1)
    yield Case("duplicate-in-a-body", (points, tets + [tets[3]]))
    a, b, c, d = tets[3]
    yield Case("mirrored-in-a-body", (points, tets + [(b, a, c, d)]))


def three_on_a_face():
    points, tets = shapes.two_tetrahedra()
    points = points + [(0.25, 0.25, -2)]
    tets = tets + [(1, 0, 2, 5)]
    assert list(Glued(tets, at_most=3).counts().values())[:5] == [9, 15, 11, 3, 2]
    yield Case("refused", (points, tets), page={"file": (6, 12, 10)})


def inverted():
    points, tets = shapes.two_tetrahedra()
    turned = {"cells": (5, 9, 7, 2, 1)}
    for name, second in (("second", (0, 1, 2, 4)), ("second-otherwise", (1, 0, 4, 2))):
        yield Case(name, (points, [tets[0], second]), [split(0, 1, 2), glue(0, 1, 2)],
                   page={"built": turned})
    yield Case("both", (points, [(1, 0, 2, 3), (0, 1, 2, 4)]), [split(0, 1, 2)],
               page={"built": turned})
    points, tets = shapes.kuhn_box(2, 2, 1)
    some = [(t[1], t[0], t[2], t[3]) if n % 5 == 2 else t for n, t in enumerate(tets)]
    yield Case("some-of-a-box", (points, some),
               [fan(4, 1, 0, 0), plane((0, 0, 1), 0.5), *SHATTERS[2:]])


def defects():
    points, tets = shapes.two_tetrahedra()
    yield Case("repeated-point", (points, tets + [(0, 1, 1, 4)]))
    yield Case("flat", (points + [(1, 0, 1)], tets + [(0, 1, 3, 5)]),
               [split(0, 1, 3), split(0, 1, 2)],
               shows="no volume: a warning here, an error for those who compute with it")
    yield Case("unused-point", (points + [(9, 9, 9)], tets), [split(0, 1, 2)])
    yield Case("coincident-points", (points + [points[0]], [tets[0], (1, 5, 2, 4)]),
               [split(0, 1, 2)], shows="a crack: two points in one place are two")
    yield Case("index-out-of-range", (points, [tets[0], (1, 0, 2, 5)]))
    yield Case("index-beyond-31-bits", (points, [tets[0], (1, 0, 2, 4294967295)]))
    yield Case("no-tetrahedron", (points, []))
    yield Case("empty", ([], []))
    yield Case("folded", (points[:4] + [(0.25, 0.25, 0.25)], tets), [split(0, 1, 2)],
               shows="the second lies inside the first: volumes disagree, topology does not care")
    yield Case("several", (points + [points[1]],
                           tets + [(0, 1, 2, 9), (2, 2, 3, 4), tets[0], (1, 0, 2, 5)]))


def two_bodies():
    body = shapes.side_by_side(shapes.two_tetrahedra(), shapes.one_tetrahedron())
    yield Case("cut-one", body, [split(0, 1, 2), split(5, 6, 7), glue(0, 1, 2)],
               page={"built": {"cells": (9, 15, 11, 3, 2)}, "file": (9, 15, 11)})
    body = shapes.side_by_side(shapes.kuhn_box(2, 1, 1), shapes.octahedron_star())
    yield Case("larger", body, [fan(12, 0, 0, 1), plane((1, 0, 0), 1), *SHATTERS])


def total():
    for n in (2, 4):
        count = 6 * n ** 3
        heap = {"cells": (4 * count, 6 * count, 4 * count, count, count)}
        yield from shatters(f"n-{n}", shapes.kuhn_box(n, n, n), page={"after": {0: heap}})


def total_6000():
    heap = {"cells": (24000, 36000, 24000, 6000, 6000)}
    for order, operation in zip(("rising", "falling", "seeded"), SHATTERS):
        yield box_case(f"n-10-{order}", (10, 10, 10), [operation], page={"after": {0: heap}})


def several_at_once():
    body = shapes.ring(3, 3)
    yield Case("ring-by-a-plane", body, [plane((1, 0, 0), 1), plane((0, 1, 0), 1)],
               page={"after": {0: {"separations": 1}}})
    yield Case("ring-at-both-ends", body, [plane((0.25, 1, 0), 1.5)])
    body = shapes.joined_ring(8)
    yield Case("joined-ring", body, [plane((0, 1, 0), 0.0625), plane((1, 0, 0), 0.0625),
                                     *SHATTERS[2:]],
               page={"built": {"betti": (1, 1, 0)}, "after": {0: {"separations": 1}}})


def family(number, name, shows, cases, slow=False):
    return Family(f"{number:02}-{name}", shows, PAGE + str(number), cases, slow)


FAMILIES = [
    family(1, "one-tetrahedron", "a face without a neighbour cannot be split", one),
    family(2, "two-tetrahedra", "a body comes apart and together again", two),
    family(3, "edge-contact", "an edge in common is no face in common", edge_contact),
    family(4, "vertex-contact", "a vertex in common is no face in common", vertex_contact),
    family(5, "closed-fan", "a closed fan opens with its first cut and loses a piece with each "
           "other", closed_fans),
    family(6, "open-fan", "the middle face of an open fan halves it", open_fan),
    family(7, "octahedron-star", "two faces and two edges may have the same points", octahedron),
    family(8, "figure-4", "the first section of a ring fools the oracle, the second parts it "
           "(figure 4)", figure_4),
    family(9, "figure-5", "the order of a fan's faces decides whether the oracle is fooled "
           "(figure 5, section 4.2)", figure_5),
    family(10, "cavity", "a cavity is a second sheet of the boundary", cavity),
    family(11, "crossing-channels", "three handles, each of which can fool the oracle once",
           channels),
    family(12, "interior-crack", "a crack inside begins as a lens-shaped void", interior_crack),
    family(13, "star-cut-out", "an enclosed piece is a component like others", cut_out_star),
    family(14, "closed-map", "the first cut of a closed map makes its boundary", closed),
    family(15, "pinched-bar", "a bar bent until its ends touch stays a bar", pinched_bar),
    family(16, "joined-ring", "a bar whose ends are joined is a ring", orientable_ring),
    family(17, "twisted-ring", "a body that cannot be oriented is refused", twisted_ring),
    family(18, "copies", "a tetrahedron given twice is refused", copies),
    family(19, "three-on-a-face", "a face of three tetrahedra is refused", three_on_a_face),
    family(20, "inverted", "an inverted tetrahedron is turned over; orbits do not care", inverted),
    family(21, "defects", "each defect has its own code", defects),
    family(22, "two-bodies", "a cut in one body leaves the other alone", two_bodies),
    family(23, "total-shatter", "a body split at every face is a heap of tetrahedra", total),
    family(23, "total-shatter-6000", "a heap of 6 000 tetrahedra, in three orders",
           total_6000, slow=True),
    family(24, "several-at-once", "one operation may split a component in several places",
           several_at_once),
]
