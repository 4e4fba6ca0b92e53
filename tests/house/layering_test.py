# SPDX-License-Identifier: MIT
"""Holds the house to its table of rooms (rooms.py, CONTRIBUTING.md): the permitted includes, no
circles in the simulation, and where CGAL and the GPL may be seen.

    python3 layering_test.py PROJECT COMPILE_COMMANDS

Quoted includes are followed through the project's files. For a source that leads to CGAL the
compiler lists the files read (-M), so that conditional includes count only when they are taken.
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

import rooms
from rooms import includes, sources

GPL = re.compile(r"SPDX-License-Identifier:.*\bGPL-")  # \b: the L of LGPL is no word's end
TOOL = "apps/sunder-mesh/"
# The GPL parts' own test, itself under the GPL.
TOOL_TEST = "tests/meshes/sunder_mesh_parts_test.cpp"
# Where files must not lead back to themselves, a header and its source taken as one.
NO_CIRCLES = "fracture/simulation/"
# Functions of libm that round by the processor, and Eigen's that call them: topology/base/elementary.hpp has ours.
OF_PROCESSOR = re.compile(r"\bstd::(?:a?(?:sin|cos|tan)h?|atan2|exp2?|expm1|log2?|log10|log1p|pow|cbrt|hypot|"
                          r"[tl]gamma|erfc?)\(|\bcomputeDirect\(|\bAngleAxisd?\(|\bslerp\(|\bangularDistance\(")
RESULTS = ("topology/", "mechanics/", "fracture/", "apps/output/", "apps/scene/", "apps/host/")


def reach(graph, start):
    """Every project file that `start` leads to, with the file that includes it."""
    parent, stack = {start: None}, [start]
    while stack:
        name = stack.pop()
        for target in sorted(graph[name][0]):
            if target not in parent:
                parent[target] = name
                stack.append(target)
    return parent


def path_to(parent, name):
    path = [name]
    while parent[path[-1]] is not None:
        path.append(parent[path[-1]])
    return " <- ".join(path)


def sees_cgal(graph, start):
    """The way from `start` to a CGAL header, or none."""
    parent = reach(graph, start)
    for name in parent:
        for target in graph[name][1]:
            if target.startswith("CGAL/"):
                return f"<{target}> <- {path_to(parent, name)}"
    return None


def is_of_tool(name):
    return name.startswith(TOOL) or name == TOOL_TEST


def wrong_directions(graph):
    """Includes that the table of rooms does not allow, and files that stand in no room."""
    wrong = []
    for name, (own, _) in graph.items():
        if name.startswith("tests/"):
            continue
        if rooms.room_of(name) is None:
            wrong.append(f"{name} stands in no room of tests/house/rooms.py")
            continue
        allowed = rooms.allowed(rooms.room_of(name))
        for target in sorted(own):
            if rooms.room_of(target) not in allowed:
                wrong.append(f"{name} includes {target}")
    return wrong


def uses_of_the_tool(graph):
    """Files outside sunder-mesh that include it."""
    return [f"{name} includes {target}, which is under the GPL" for name, (own, _) in graph.items()
            for target in own if target.startswith(TOOL) and not is_of_tool(name)]


def circles(graph, folder):
    """Units of `folder` (a header with its source) that lead back to themselves by includes within
    it: each as the sorted names of those that are on one circle."""
    units = {}
    for name, (own, _) in graph.items():
        if name.startswith(folder):
            unit = name.rsplit(".", 1)[0]
            targets = {t.rsplit(".", 1)[0] for t in own if t.startswith(folder)} - {unit}
            units.setdefault(unit, set()).update(targets)

    def beyond(unit):
        seen, stack = set(), [unit]
        while stack:
            for target in units.get(stack.pop(), ()):
                if target not in seen:
                    seen.add(target)
                    stack.append(target)
        return seen

    reached = {unit: beyond(unit) for unit in units}
    return sorted({tuple(sorted(v for v in reached[u] if u in reached[v]))
                   for u in units if u in reached[u]})


def public_headers_with_cgal(graph):
    """Headers of mechanics, fracture and apps that lead to CGAL. They take topology's public
    headers with them; topology's internal ones may see it."""
    wrong = []
    for name in graph:
        is_public = name.endswith(".hpp") and name.split("/")[0] in ("mechanics", "fracture", "apps")
        if is_public and not is_of_tool(name):
            way = sees_cgal(graph, name)
            if way:
                wrong.append(way)
    return wrong


def sources_with_cgal(graph):
    """Sources outside topology, the tests and sunder-mesh that lead to CGAL."""
    wrong = []
    for name in graph:
        if name.endswith(".cpp") and name.split("/")[0] in ("mechanics", "fracture", "apps"):
            way = None if is_of_tool(name) else sees_cgal(graph, name)
            if way:
                wrong.append(way)
    return wrong


def files_read(command, folder):
    """The files that the compiler reads for one entry of compile_commands.json."""
    words, kept = shlex.split(command), []
    while words:
        word = words.pop(0)
        if word == "-o":
            words.pop(0)
        elif word != "-c":
            kept.append(word)
    # A launcher (ccache behind cmake -E env) stands before the compiler; it has nothing to cache.
    compiler = next(k for k, w in enumerate(kept) if re.search(r"(\+\+|cc|clang)(-\d+)?$", w)
                    and "ccache" not in w)
    done = subprocess.run([*kept[compiler:], "-M"], cwd=folder, capture_output=True, text=True,
                          check=True)
    return done.stdout.replace("\\\n", " ").split(": ", 1)[1].split()


def sources_of(source):
    """The sources that a file of compile_commands.json holds: itself, or those that CMake joined in it."""
    if "Unity" not in source.parts:
        return [source]
    return [pathlib.Path(target) for _, target in rooms.INCLUDE.findall(source.read_text(encoding="utf-8"))]


def is_under_gpl(header):
    """By the SPDX line, which every header of CGAL has."""
    head = pathlib.Path(header).read_text(encoding="utf-8", errors="replace")[:4000]
    return GPL.search(head) is not None


class TheProject(unittest.TestCase):
    project = commands = None

    @classmethod
    def setUpClass(cls):
        cls.graph = includes(sources(cls.project))

    def test_includes_go_up_the_table_of_rooms_only(self):
        self.assertEqual(wrong_directions(self.graph), [])

    def test_the_table_itself_has_no_circle(self):
        for row, (name, _, sees) in enumerate(rooms.ROOMS):
            for other in rooms.allowed(name) - {name}:
                self.assertLess(rooms.NAMES.index(other), row, f"{name} may include {other}")

    def test_every_room_exists(self):
        for name in rooms.NAMES:
            self.assertTrue(any(f.startswith(name + "/") for f in self.graph), name)

    def test_the_page_shows_the_table(self):
        page = (self.project / "CONTRIBUTING.md").read_text(encoding="utf-8")
        self.assertEqual(rooms.with_table(page), page,
                         "python3 tests/house/rooms.py . --write brings CONTRIBUTING.md up to date")

    def test_nobody_includes_the_tool_under_the_gpl(self):
        self.assertEqual(uses_of_the_tool(self.graph), [])

    def test_the_simulation_has_no_circles(self):
        self.assertEqual(circles(self.graph, NO_CIRCLES), [])

    def test_no_public_header_leads_to_cgal(self):
        self.assertEqual(public_headers_with_cgal(self.graph), [])

    def test_only_topology_sees_cgal(self):
        self.assertEqual(sources_with_cgal(self.graph), [])

    def test_no_library_reaches_a_header_under_the_gpl(self):
        entries = json.loads(self.commands.read_text(encoding="utf-8"))
        looked_at, seen = 0, set()
        for entry in entries:
            source = pathlib.Path(entry["directory"], entry["file"]).resolve()
            names = [s.relative_to(self.project).as_posix() for s in sources_of(source)
                     if s.is_relative_to(self.project)]
            names = {name for name in names if name in self.graph and not is_of_tool(name)
                     and sees_cgal(self.graph, name)} - seen
            if not names:
                continue
            seen |= names  # the mutants compile the same sources once more
            with self.subTest(source=source):
                read = [h for h in files_read(entry["command"], entry["directory"])
                        if "/CGAL/" in h]
                self.assertNotEqual(read, [])
                self.assertEqual([h for h in read if is_under_gpl(h)], [])
            looked_at += 1
        self.assertGreater(looked_at, 0, "no source of the build sees CGAL: this test looks away")

    def test_no_result_depends_on_the_processor(self):
        self.assertEqual(calls_of_processor(sources(self.project)), [])

    def test_every_source_carries_its_licence(self):
        for name, text in sources(self.project).items():
            expected = "GPL-3.0-or-later" if is_of_tool(name) else "MIT"
            with self.subTest(source=name):
                self.assertEqual(text.split("\n", 1)[0],
                                 f"// SPDX-License-Identifier: {expected}")


def calls_of_processor(texts):
    """Calls in the sources of results with a last bit that depends on the processor: file, line,
    call."""
    found = []
    for name, text in texts.items():
        if not name.startswith(RESULTS):
            continue
        for number, line in enumerate(text.splitlines(), 1):
            call = OF_PROCESSOR.search(line.split("//")[0])
            if call:
                found.append((name, number, call.group()))
    return found


class ThisTest(unittest.TestCase):
    """The checks above can fail."""

    def graph(self, **files):
        return includes({name.replace("__", "/") + (".cpp" if name.endswith("_cpp") else ".hpp"): t
                         for name, t in files.items()})

    def test_a_call_of_the_processor_is_found(self):
        texts = {"mechanics/a.cpp": "x = std::pow(y, 3);\n// std::sin(x) is not ours\nz = sine(y);",
                 "apps/render/b.cpp": "x = std::sin(y);", "fracture/c.cpp": "s.computeDirect(m);"}
        self.assertEqual(calls_of_processor(texts), [("mechanics/a.cpp", 1, "std::pow("),
                                                     ("fracture/c.cpp", 1, "computeDirect(")])

    def test_cgal_behind_two_headers_is_found(self):
        graph = self.graph(mechanics__a='#include "topology/b.hpp"',
                           topology__b='#include "topology/c.hpp"',
                           topology__c="  # include <CGAL/Cell_attribute.h>")
        self.assertEqual(public_headers_with_cgal(graph),
                         ["<CGAL/Cell_attribute.h> <- topology/c.hpp <- topology/b.hpp"
                          " <- mechanics/a.hpp"])

    def test_an_include_up_the_house_is_found(self):
        graph = includes({
            "topology/kernel/kernel.hpp": '#include "topology/mesh/check.hpp"',
            "topology/mesh/check.hpp": '#include "topology/base/ids.hpp"',
            "topology/base/ids.hpp": "",
            "mechanics/step.hpp": '#include "mechanics/solver/factor.hpp"',
            "mechanics/solver/factor.hpp": '#include "topology/base/ids.hpp"',
            "mechanics/state/columns.hpp": '#include "topology/kernel/kernel.hpp"',
            "mechanics/solver/factor.cpp": '#include "mechanics/step.hpp"',
            "fracture/energy/relax.hpp": '#include "mechanics/step.hpp"',
            "fracture/algorithms/fan.hpp": '#include "fracture/energy/relax.hpp"'})
        self.assertEqual(sorted(wrong_directions(graph)),
                         ["fracture/algorithms/fan.hpp includes fracture/energy/relax.hpp",
                          "mechanics/solver/factor.cpp includes mechanics/step.hpp",
                          "mechanics/state/columns.hpp includes topology/kernel/kernel.hpp",
                          "topology/kernel/kernel.hpp includes topology/mesh/check.hpp"])

    def test_a_file_without_a_room_is_found(self):
        graph = includes({"fracture/news/odd.hpp": "", "fracture/algorithms/fan.hpp": ""})
        self.assertEqual(len(wrong_directions(graph)), 1)

    def test_a_circle_through_a_source_is_found(self):
        graph = includes({"a/step.hpp": "", "a/step.cpp": '#include "a/ledger.hpp"',
                          "a/ledger.hpp": '#include "a/step.hpp"', "a/ledger.cpp": "",
                          "a/plan.hpp": "", "a/plan.cpp": '#include "a/plan.hpp"\n'
                                                          '#include "a/step.hpp"'})
        self.assertEqual(circles(graph, "a/"), [("a/ledger", "a/step")])

    def test_the_tool_is_nobodys_library(self):
        graph = includes({"apps/sunder/run/run.cpp": '#include "apps/sunder-mesh/surface.hpp"',
                          "apps/sunder-mesh/surface.hpp": ""})
        self.assertEqual(len(uses_of_the_tool(graph)), 1)

    def test_a_page_out_of_date_is_found(self):
        page = f"words\n{rooms.BEGIN}| old |\n{rooms.END}more\n"
        self.assertNotEqual(rooms.with_table(page), page)
        self.assertEqual(rooms.with_table(rooms.with_table(page)), rooms.with_table(page))

    def test_the_licences_are_told_apart(self):
        with tempfile.TemporaryDirectory() as folder:
            header = pathlib.Path(folder, "h.h")
            for licence, is_gpl in (("GPL-3.0-or-later OR LicenseRef-Commercial", True),
                                    ("LGPL-3.0-or-later OR LicenseRef-Commercial", False),
                                    ("( GPL-3.0-or-later OR LicenseRef-Commercial ) AND MIT", True),
                                    ("BSL-1.0", False)):
                header.write_text(f"// SPDX-License-Identifier: {licence}\n")
                self.assertEqual(is_under_gpl(header), is_gpl, licence)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    TheProject.project = pathlib.Path(sys.argv[1]).resolve()
    TheProject.commands = pathlib.Path(sys.argv[2])
    unittest.main(argv=sys.argv[:1])
