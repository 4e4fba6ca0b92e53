# SPDX-License-Identifier: MIT
"""The rooms of the house: what each is for and what it may include. docs/house.md shows this table.

    python3 rooms.py PROJECT          prints the table as docs/house.md has it
    python3 rooms.py PROJECT --write  writes it there
"""

import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)

# A room is the folder with all folders in it that are not rooms themselves. It may include itself
# and the rooms named, which stand above it in this table, so nothing can go round in a circle.
# "a/*": every room of a.
ROOMS = (
    ("topology/base", "ids, plain meshes, findings, counters: what knows no map and all rooms share", ()),
    ("topology/kernel", "the 3-map: darts, cells, attributes, `split_face`, fans, components, invariants",
     ("topology/base",)),
    ("topology/mesh", "meshes as files hold them: check, survey, repair, crack, boundary; a map made of one",
     ("topology/base", "topology/kernel")),
    ("topology/cells", "operations that change cells: edges divided, refinement, plane cuts; columns, a journal",
     ("topology/base", "topology/kernel", "topology/mesh")),
    ("topology/io", "mesh files, a folder a format", ("topology/base", "topology/kernel", "topology/mesh")),
    ("topology/suite", "what judges a kernel: fixtures, slow twins, homology, random runs",
     ("topology/base", "topology/kernel", "topology/mesh", "topology/io")),
    ("mechanics/state", "columns, components, materials, loads, settings: what is saved or chosen",
     ("topology/base",)),
    ("mechanics/frame", "rotations, rigid frames, mean axes", ("topology/base", "mechanics/state")),
    ("mechanics/element", "strain, stress, elastic force and energy of tetrahedra",
     ("topology/base", "mechanics/state", "mechanics/frame")),
    ("mechanics/solver", "assembled stiffness, block factor, columns of the inverse",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element")),
    ("mechanics/integrators", "a step of one component in the floating frame; answers to impulses",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver")),
    ("mechanics/baselines", "integrators that ours is compared with",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver",
      "mechanics/integrators")),
    ("mechanics", "one step of all components; components made, placed and rebuilt",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver",
      "mechanics/integrators", "mechanics/baselines")),
    ("mechanics/statics", "equilibrium and modes",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver",
      "mechanics/integrators", "mechanics")),
    ("mechanics/ties", "faces that are apart and still hold: their data and their law",
     ("topology/base", "mechanics/state")),
    ("mechanics/contact/shapes", "obstacles, surfaces of pieces, nearest points, pairs that are near",
     ("topology/base", "mechanics/state")),
    ("mechanics/contact/solver", "impulses of rows of contacts between bodies that respond; no mesh",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/ties")),
    ("mechanics/contact", "a step with contact: detection, rows, passes, ties, bounces, impacts",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver",
      "mechanics/integrators", "mechanics", "mechanics/ties", "mechanics/contact/shapes",
      "mechanics/contact/solver")),
    ("mechanics/rubble", "rigid bodies that touch, on a clock of their own",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver",
      "mechanics/integrators", "mechanics/contact/shapes")),
    ("fracture/cracks", "cracks as surfaces: sides of tetrahedra, anchors",
     ("topology/base", "topology/kernel", "mechanics/state", "mechanics/ties")),
    ("fracture/algorithms", "node stress, threshold, plane, fan, split: algorithms 3 and 4 of the paper",
     ("topology/base", "topology/kernel", "mechanics/state", "mechanics/frame", "mechanics/element",
      "fracture/cracks")),
    ("fracture/strength", "strength drawn at random, faces cut before the start",
     ("topology/base", "topology/kernel", "topology/mesh", "mechanics/state", "fracture/cracks", "fracture/algorithms")),
    ("fracture/energy", "energy that a crack releases, and what it leaves in motion",
     ("topology/base", "topology/kernel", "mechanics/*", "fracture/algorithms")),
    ("fracture/scene", "bodies and all that a user chooses of a simulation; every key once",
     ("topology/base", "topology/kernel", "mechanics/state", "mechanics/contact",
      "mechanics/contact/shapes", "fracture/algorithms", "fracture/strength")),
    ("fracture/breaking", "which vertices break in a run and in what order; or the fans of a script",
     ("topology/base", "topology/kernel", "mechanics/state", "mechanics/element", "mechanics/contact",
      "mechanics/contact/shapes",
      "fracture/cracks", "fracture/algorithms", "fracture/energy")),
    ("fracture/ties", "faces of fans tied, and released once their ties are spent",
     ("topology/base", "topology/kernel", "mechanics/state", "mechanics/element",
      "mechanics/contact", "mechanics/ties", "mechanics/contact/shapes", "fracture/cracks", "fracture/algorithms", "fracture/breaking")),
    ("fracture/simulation", "a body in motion: its steps and what they report",
     ("topology/base", "topology/kernel", "topology/mesh", "topology/cells", "mechanics/*", "fracture/cracks", "fracture/algorithms",
      "fracture/strength", "fracture/energy", "fracture/scene", "fracture/breaking",
      "fracture/ties")),
    ("fracture/saving", "a simulation as a file, to go on with later",
     ("topology/base", "topology/kernel", "topology/mesh", "topology/io", "mechanics/*", "fracture/cracks",
      "fracture/algorithms", "fracture/strength", "fracture/energy", "fracture/scene", "fracture/breaking",
      "fracture/simulation")),
    ("apps/scene", "scene files, JSON to settings",
     ("topology/base", "topology/kernel", "topology/mesh", "topology/io", "mechanics/*", "fracture/*")),
    ("apps/output", "fragments, tables and frames of a simulation",
     ("topology/base", "topology/kernel", "topology/mesh", "topology/io", "mechanics/*", "fracture/*")),
    ("apps/render", "pictures of triangles; knows no map and no mechanics", ("topology/base",)),
    ("apps/host", "C functions for hosts in any language, natively and as WebAssembly",
     ("topology/*", "mechanics/*", "fracture/*", "apps/scene", "apps/output")),
    ("apps/sunder", "the program, a folder a command",
     ("topology/*", "mechanics/*", "fracture/*", "apps/scene", "apps/output", "apps/render", "apps/host")),
    ("apps/bench", "sunder-bench: measurements, charts, kernels judged",
     ("topology/*", "mechanics/*", "fracture/*", "apps/scene", "apps/output", "apps/render",
      "apps/sunder")),
    ("apps/sunder-mesh", "surfaces to tetrahedra, under the GPL",
     ("topology/base", "topology/kernel", "topology/mesh", "topology/io")),
)
NAMES = tuple(name for name, _, _ in ROOMS)
TOPS = ("topology", "mechanics", "fracture", "apps")


def sources(project):
    """Every C++ file of the project, by its path from the root."""
    found = {}
    for top in (*TOPS, "tests"):
        for path in sorted((project / top).rglob("*.[ch]pp")):
            found[path.relative_to(project).as_posix()] = path.read_text(encoding="utf-8")
    return found


def includes(files):
    """For each file: the project's files it includes, and the others as they are written."""
    graph = {}
    for name, text in files.items():
        own, outside = set(), set()
        for mark, target in INCLUDE.findall(text):
            beside = (pathlib.PurePosixPath(name).parent / target).as_posix()
            if mark == '"' and target in files:
                own.add(target)
            elif mark == '"' and beside in files:
                own.add(beside)
            else:
                outside.add(target)
        graph[name] = (own, outside)
    return graph


def room_of(name):
    """The room a file stands in: the longest that its path begins with; none is an error."""
    rooms = [room for room in NAMES if name.startswith(room + "/")]
    return max(rooms, key=len, default=None)


def allowed(room):
    """Every room that `room` may include, itself among them."""
    seen = {room}
    for entry in next(sees for name, _, sees in ROOMS if name == room):
        if entry.endswith("/*"):
            top = entry[:-2]
            seen.update(name for name in NAMES if name == top or name.startswith(top + "/"))
        else:
            seen.add(entry)
    return seen


def table():
    """The table of rooms in Markdown."""
    lines = ["| room | what it is for | may include |", "|---|---|---|"]
    for name, purpose, sees in ROOMS:
        shown = ", ".join(f"`{s}`" for s in sees)
        lines.append(f"| `{name}` | {purpose} | {shown or 'nothing'} |")
    return "\n".join(lines) + "\n"


BEGIN, END = "<!-- rooms: begin -->\n", "<!-- rooms: end -->\n"


def with_table(page):
    """The page with the present table between the two marks."""
    before, rest = page.split(BEGIN)
    after = rest.split(END)[1]
    return before + BEGIN + table() + END + after


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[2] == "--write":
        house = pathlib.Path(sys.argv[1], "docs", "house.md")
        house.write_text(with_table(house.read_text(encoding="utf-8")), encoding="utf-8")
    elif len(sys.argv) == 2:
        print(table(), end="")
    else:
        sys.exit(__doc__)
