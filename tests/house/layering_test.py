# SPDX-License-Identifier: MIT
"""Holds the house's dependencies to design.md: who may include what, and where CGAL may be seen.

    python3 layering_test.py PROJECT COMPILE_COMMANDS

Quoted includes are followed through the project's files. What a source that leads to CGAL really
reads is asked of the compiler (-M), so that conditional includes count only when they are taken.
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
GPL = re.compile(r"SPDX-License-Identifier:.*\bGPL-")  # \b: the L of LGPL is no word's end
ROOMS = ("topology", "mechanics", "fracture", "apps")
TOOL = "apps/sunder-mesh/"
# The GPL parts' own test, itself under the GPL.
TOOL_TEST = "tests/meshes/sunder_mesh_parts_test.cpp"
# What the siblings share: plain meshes, ids, findings, assertions.
SHARED = {"topology/mesh/tet_mesh.hpp", "topology/kernel/ids.hpp", "topology/kernel/finding.hpp",
          "topology/kernel/assert.hpp"}
MAY_INCLUDE = {"topology": {"topology"}, "mechanics": {"mechanics"},
               "fracture": {"topology", "mechanics", "fracture"},
               "apps": {"topology", "mechanics", "fracture", "apps"}}


def sources(project):
    """Every C++ file of the project, by its path from the root."""
    found = {}
    for room in (*ROOMS, "tests"):
        for path in sorted((project / room).rglob("*.[ch]pp")):
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
    """Includes against the one way apps -> fracture -> {mechanics, topology}."""
    wrong = []
    for name, (own, _) in graph.items():
        room = name.split("/")[0]
        for target in own:
            is_allowed = (room == "tests" or target.split("/")[0] in MAY_INCLUDE[room]
                          or (room == "mechanics" and target in SHARED))
            if not is_allowed:
                wrong.append(f"{name} includes {target}")
            if target.startswith(TOOL) and not is_of_tool(name):
                wrong.append(f"{name} includes {target}, which is under the GPL")
    return wrong


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
    """What the compiler reads for one entry of compile_commands.json."""
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


def is_under_gpl(header):
    """By the SPDX line, which every header of CGAL has."""
    head = pathlib.Path(header).read_text(encoding="utf-8", errors="replace")[:4000]
    return GPL.search(head) is not None


class TheProject(unittest.TestCase):
    project = commands = None

    @classmethod
    def setUpClass(cls):
        cls.graph = includes(sources(cls.project))

    def test_includes_point_one_way(self):
        self.assertEqual(wrong_directions(self.graph), [])

    def test_no_public_header_leads_to_cgal(self):
        self.assertEqual(public_headers_with_cgal(self.graph), [])

    def test_only_topology_sees_cgal(self):
        self.assertEqual(sources_with_cgal(self.graph), [])

    def test_no_library_reaches_a_header_under_the_gpl(self):
        entries = json.loads(self.commands.read_text(encoding="utf-8"))
        looked_at = 0
        for entry in entries:
            source = pathlib.Path(entry["directory"], entry["file"]).resolve()
            if not source.is_relative_to(self.project):
                continue
            name = source.relative_to(self.project).as_posix()
            if name not in self.graph or is_of_tool(name) or not sees_cgal(self.graph, name):
                continue
            with self.subTest(source=name):
                read = [h for h in files_read(entry["command"], entry["directory"])
                        if "/CGAL/" in h]
                self.assertNotEqual(read, [])
                self.assertEqual([h for h in read if is_under_gpl(h)], [])
            looked_at += 1
        self.assertGreater(looked_at, 0, "no source of the build sees CGAL: this test looks away")

    def test_every_source_carries_its_licence(self):
        for name, text in sources(self.project).items():
            expected = "GPL-3.0-or-later" if is_of_tool(name) else "MIT"
            with self.subTest(source=name):
                self.assertEqual(text.split("\n", 1)[0],
                                 f"// SPDX-License-Identifier: {expected}")


class ThisTest(unittest.TestCase):
    """The checks above can fail."""

    def graph(self, **files):
        return includes({name.replace("__", "/") + (".cpp" if name.endswith("_cpp") else ".hpp"): t
                         for name, t in files.items()})

    def test_cgal_behind_two_headers_is_found(self):
        graph = self.graph(mechanics__a='#include "topology/b.hpp"',
                           topology__b='#include "topology/c.hpp"',
                           topology__c="  # include <CGAL/Cell_attribute.h>")
        self.assertEqual(public_headers_with_cgal(graph),
                         ["<CGAL/Cell_attribute.h> <- topology/c.hpp <- topology/b.hpp"
                          " <- mechanics/a.hpp"])

    def test_a_backward_include_is_found(self):
        graph = self.graph(topology__a='#include "mechanics/b.hpp"', mechanics__b="",
                           mechanics__c='#include "topology/kernel/kernel.hpp"', topology__kernel="",
                           mechanics__d='#include "topology/kernel/ids.hpp"', topology__ids="")
        self.assertEqual(sorted(wrong_directions(graph)),
                         ["mechanics/c.hpp includes topology/kernel/kernel.hpp",
                          "topology/a.hpp includes mechanics/b.hpp"])

    def test_the_tool_is_nobodys_library(self):
        graph = includes({"apps/sunder/run/run.cpp": '#include "apps/sunder-mesh/surface.hpp"',
                          "apps/sunder-mesh/surface.hpp": ""})
        self.assertEqual(len(wrong_directions(graph)), 1)

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
