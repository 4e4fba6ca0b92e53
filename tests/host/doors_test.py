# SPDX-License-Identifier: MIT
"""Holds the public headers to their word: each compiles alone, without a warning, and leads to no forbidden header.
The C++ of README.md and how-to pages compiles as well, or is a part of tests/host/tear, which
docs/howto/embed.md shows.

    python3 doors_test.py FOLDER_OF_DOORS EIGEN "FLAG;FLAG" PROJECT COMPILER...

The compiler lists the headers that a header leads to (-MD). Compilers that are not installed are
passed over, but one must be.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

# As parts of the path of a header. Allowed are the doors themselves, Eigen, the compiler's own.
FORBIDDEN = ("nlohmann", "CLI", "EGL", "epoxy", "GL", "catch2", "fmt", "CGAL", "boost", "gmp.h", "Spectra", "expat.h",
             "zlib.h", "png.h", "topology", "mechanics", "fracture", "apps")
# <sunder/cgal_map.hpp> is there to show CGAL, which brings Boost and GMP.
OF_CGAL = ("CGAL", "boost", "gmp.h")
FLAGS = ["-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wshadow", "-pedantic", "-Werror"]


def compile_text(text, compiler, folder, eigen, *flags):
    """The compiler's messages about a source, and the files it has read."""
    with tempfile.TemporaryDirectory() as work:
        source, list_of_read = pathlib.Path(work, "alone.cpp"), pathlib.Path(work, "alone.d")
        source.write_text(text, encoding="utf-8")
        # CGAL's own headers warn with -pedantic, but lie where the compiler takes them for the system's.
        done = subprocess.run([compiler, *FLAGS, *flags, "-I", folder, "-isystem", eigen,
                               "-MD", "-MF", list_of_read, source], capture_output=True, text=True, check=False)
        read = list_of_read.read_text(encoding="utf-8").split() if list_of_read.exists() else []
        return ("" if done.returncode == 0 else done.stderr or "failed without a word"), read


def complaints(compiler, header, folder, eigen, forbidden):
    """Faults of one public header, which a source includes twice and nothing else: a text each."""
    said, read = compile_text(2 * f"#include <{header}>\n", compiler, folder, eigen)
    found = [f"{compiler}, {header}: {said}"] if said else []
    for path in read:
        if not path.startswith(eigen) and set(pathlib.PurePath(path).parts) & set(forbidden):
            found.append(f"{header} leads to {path}")
    if not found and not any(path.endswith(header) for path in read):
        found.append(f"{compiler} does not say that it has read {header}")
    return found


class Doors(unittest.TestCase):
    folder, eigen, project, compilers = "", "", "", []

    def blocks_of(self, page):
        """The C++ that a page shows."""
        text = pathlib.Path(self.project, page).read_text(encoding="utf-8")
        return re.findall(r"^```cpp\n(.*?)^```", text, re.MULTILINE | re.DOTALL)

    def torn(self):
        """The program of a fracture law of one's own."""
        return pathlib.Path(self.project, "tests/host/tear/main.cpp").read_text(encoding="utf-8")

    def test_each_compiles_alone_and_leads_to_nothing_forbidden(self):
        doors = sorted(path.name for path in pathlib.Path(self.folder, "sunder").glob("*.hpp"))
        self.assertIn("simulation.hpp", doors)
        for door in doors:
            forbidden = FORBIDDEN if door != "cgal_map.hpp" else set(FORBIDDEN) - set(OF_CGAL)
            for compiler in self.compilers:
                with self.subTest(door=door, compiler=compiler):
                    self.assertEqual(complaints(compiler, f"sunder/{door}", self.folder, self.eigen, forbidden), [])

    def test_the_lines_of_the_pages_compile(self):
        for page in ("README.md", "docs/howto/embed.md", "docs/howto/resume_and_replay.md"):
            blocks = [block for block in self.blocks_of(page) if block not in self.torn()]
            self.assertTrue(blocks, f"{page} shows no C++")
            for block in blocks:
                said, _ = compile_text(block, self.compilers[0], self.folder, self.eigen,
                                       "-Wno-unused-variable")
                self.assertEqual(said, "", f"{page}\n{block}")

    def test_the_law_of_the_page_is_of_a_program(self):
        shown = [block for block in self.blocks_of("docs/howto/embed.md") if block in self.torn()]
        self.assertEqual(len(shown), 3)

    def test_a_bad_header_is_seen(self):
        """The test itself: a header that needs another, one that warns, one that leads to fmt by a detour."""
        bad = {"needs.hpp": "#pragma once\ninline std::vector<int> f() { return {}; }\n",
               "warns.hpp": "#pragma once\ninline int f(int unused) { return 0; }\n",
               "detour.hpp": "#pragma once\n#include <sunder/fmt/format.hpp>\n",
               "fmt/format.hpp": "#pragma once\n"}
        with tempfile.TemporaryDirectory() as folder:
            for name, text in bad.items():
                path = pathlib.Path(folder, "sunder", name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            for name in ("needs.hpp", "warns.hpp", "detour.hpp"):
                for compiler in self.compilers:
                    with self.subTest(name=name, compiler=compiler):
                        self.assertEqual(len(complaints(compiler, f"sunder/{name}", folder, self.eigen, FORBIDDEN)), 1)


if __name__ == "__main__":
    Doors.folder, Doors.eigen = sys.argv[1], str(pathlib.Path(sys.argv[2]).resolve())
    FLAGS += sys.argv[3].split(";")
    Doors.project = sys.argv[4]
    Doors.compilers = [c for c in dict.fromkeys(sys.argv[5:]) if shutil.which(c)]
    if not Doors.compilers:
        sys.exit("none of the compilers is installed")
    unittest.main(argv=sys.argv[:1], verbosity=2)
