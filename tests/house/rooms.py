# SPDX-License-Identifier: MIT
"""The rooms of the house: their purposes and permitted includes. CONTRIBUTING.md shows this table.

    python3 rooms.py PROJECT          prints the table as CONTRIBUTING.md has it
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
    ("topology/base", "ids, plain meshes, findings, counters: shared by all, without a map", ()),
    ("topology/kernel", "the 3-map: darts, cells, attributes, `split_face`, fans, components, invariants",
     ("topology/base",)),
    ("topology/mesh", "meshes as files hold them: check, survey, repair, crack, boundary, building a map",
     ("topology/base", "topology/kernel")),
    ("topology/cells", "operations that change cells: divided edges, refinement, plane cuts, columns, a journal",
     ("topology/base", "topology/kernel", "topology/mesh")),
    ("topology/io", "mesh files, one folder per format", ("topology/base", "topology/kernel", "topology/mesh")),
    ("topology/suite", "the judge of kernels: fixtures, slow twins, homology, random runs",
     ("topology/base", "topology/kernel", "topology/mesh", "topology/io")),
    ("mechanics/state", "columns, components, materials, loads, settings",
     ("topology/base",)),
    ("mechanics/frame", "rotations, rigid frames, mean axes", ("topology/base", "mechanics/state")),
    ("mechanics/element", "strain, stress, elastic force and energy of tetrahedra",
     ("topology/base", "mechanics/state", "mechanics/frame")),
    ("mechanics/solver", "assembled stiffness, block factor, columns of the inverse",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element")),
    ("mechanics/integrators", "a step of one component in the floating frame, response to impulses",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver")),
    ("mechanics/baselines", "integrators for comparison",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver",
      "mechanics/integrators")),
    ("mechanics", "one step of all components, building and rebuilding of components",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver",
      "mechanics/integrators", "mechanics/baselines")),
    ("mechanics/statics", "equilibrium and modes",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver",
      "mechanics/integrators", "mechanics")),
    ("mechanics/ties", "ties: data and law of faces that are apart and still hold",
     ("topology/base", "mechanics/state")),
    ("mechanics/contact/shapes", "obstacles, surfaces of pieces, nearest points, near pairs",
     ("topology/base", "mechanics/state")),
    ("mechanics/contact/solver", "impulses of contact rows between bodies, without a mesh",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/ties")),
    ("mechanics/contact", "a step with contact: detection, rows, passes, ties, bounces, impacts",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver",
      "mechanics/integrators", "mechanics", "mechanics/ties", "mechanics/contact/shapes",
      "mechanics/contact/solver")),
    ("mechanics/rubble", "rubble: rigid bodies in contact, with a clock of their own",
     ("topology/base", "mechanics/state", "mechanics/frame", "mechanics/element", "mechanics/solver",
      "mechanics/integrators", "mechanics/contact/shapes")),
    ("fracture/cracks", "cracks as surfaces: sides of tetrahedra, anchors",
     ("topology/base", "topology/kernel", "mechanics/state", "mechanics/ties")),
    ("fracture/algorithms", "node stress, threshold, plane, fan, split: algorithms 3 and 4 of the paper",
     ("topology/base", "topology/kernel", "mechanics/state", "mechanics/frame", "mechanics/element",
      "fracture/cracks")),
    ("fracture/strength", "random strength, faces cut before the start",
     ("topology/base", "topology/kernel", "topology/mesh", "mechanics/state", "fracture/cracks", "fracture/algorithms")),
    ("fracture/energy", "energy that a crack releases, and energy left in motion",
     ("topology/base", "topology/kernel", "mechanics/*", "fracture/algorithms")),
    ("fracture/scene", "bodies and settings of a simulation, every key once",
     ("topology/base", "topology/kernel", "mechanics/state", "mechanics/contact",
      "mechanics/contact/shapes", "fracture/algorithms", "fracture/strength")),
    ("fracture/breaking", "choice and order of the vertices that break, or the fans of a script",
     ("topology/base", "topology/kernel", "mechanics/state", "mechanics/element", "mechanics/contact",
      "mechanics/contact/shapes",
      "fracture/cracks", "fracture/algorithms", "fracture/energy")),
    ("fracture/ties", "ties of fans, and their release",
     ("topology/base", "topology/kernel", "mechanics/state", "mechanics/element",
      "mechanics/contact", "mechanics/ties", "mechanics/contact/shapes", "fracture/cracks", "fracture/algorithms", "fracture/breaking")),
    ("fracture/simulation", "bodies in motion: steps and their reports",
     ("topology/base", "topology/kernel", "topology/mesh", "topology/cells", "mechanics/*", "fracture/cracks", "fracture/algorithms",
      "fracture/strength", "fracture/energy", "fracture/scene", "fracture/breaking",
      "fracture/ties")),
    ("fracture/saving", "a simulation as a file",
     ("topology/base", "topology/kernel", "topology/mesh", "topology/io", "mechanics/*", "fracture/cracks",
      "fracture/algorithms", "fracture/strength", "fracture/energy", "fracture/scene", "fracture/breaking",
      "fracture/simulation")),
    ("apps/scene", "scene files, JSON to settings",
     ("topology/base", "topology/kernel", "topology/mesh", "topology/io", "mechanics/*", "fracture/*")),
    ("apps/output", "fragments, tables and frames of a simulation",
     ("topology/base", "topology/kernel", "topology/mesh", "topology/io", "mechanics/*", "fracture/*")),
    ("apps/render", "pictures of triangles, without map and mechanics", ("topology/base",)),
    ("apps/host", "C functions for hosts in any language, native and WebAssembly",
     ("topology/*", "mechanics/*", "fracture/*", "apps/scene", "apps/output")),
    ("apps/sunder", "the program, one folder per command",
     ("topology/*", "mechanics/*", "fracture/*", "apps/scene", "apps/output", "apps/render", "apps/host")),
    ("apps/bench", "sunder-bench: measurements, charts, judging kernels",
     ("topology/*", "mechanics/*", "fracture/*", "apps/scene", "apps/output", "apps/render",
      "apps/sunder")),
    ("apps/python", "the Python module",
     ("topology/*", "mechanics/*", "fracture/*", "apps/scene", "apps/output", "apps/host", "apps/sunder")),
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
    lines = ["| source directory | contents | may include |", "|---|---|---|"]
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
        page = pathlib.Path(sys.argv[1], "CONTRIBUTING.md")
        page.write_text(with_table(page.read_text(encoding="utf-8")), encoding="utf-8")
    elif len(sys.argv) == 2:
        print(table(), end="")
    else:
        sys.exit(__doc__)
