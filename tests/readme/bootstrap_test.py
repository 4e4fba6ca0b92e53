# SPDX-License-Identifier: MIT
"""The installs, builds and runs of ./bootstrap for each of its words, with stand-ins that log
calls.

    python3 bootstrap_test.py
"""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

PROJECT = pathlib.Path(__file__).resolve().parents[2]
# When the stand-in of cmake configures, it leaves CMake's entry for whether there are tests.
STAND_IN = """#!/bin/sh
call="${0##*/} $*"
printf "%s\\n" "$call" >>"$CALLS"
case "$call" in
  "cmake --preset"*) mkdir -p build/release
    echo "$*" | sed -n 's/.*-D\\(BUILD_TESTING\\)=\\([A-Z]*\\).*/\\1:BOOL=\\2/p' >build/release/CMakeCache.txt ;;
  "dpkg-query"*) [ -n "$NOTHING_INSTALLED" ] || for name; do echo "$name install ok installed"; done ;;
esac
"""
TOOLS = ("cmake", "ninja", "ctest", "apt-get", "dpkg-query", "node", "npm", "sudo", "python3")
NEEDED = ("bash", "sh", "dirname", "grep", "sed", "cat", "rm", "mkdir", "id", "env")


class Bootstrap(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        self.tools = self.path / "tools"
        self.tools.mkdir()
        for name in TOOLS:
            self.stand_in(self.tools / name)
        for name in NEEDED:
            (self.tools / name).symlink_to(shutil.which(name))
        self.stand_in(self.path / "build/release/sunder")
        shutil.copy(PROJECT / "bootstrap", self.path)

    def stand_in(self, path):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(STAND_IN)
        path.chmod(0o755)

    def bootstrap(self, *words, **variables):
        """The exit code, the calls, and the standard error."""
        calls = self.path / "calls.tmp"
        calls.write_text("")
        environment = {"PATH": str(self.tools), "CALLS": str(calls), **variables}
        done = subprocess.run([self.path / "bootstrap", *words], env=environment, timeout=60,
                              capture_output=True, text=True, check=False)
        wanted = [call for call in calls.read_text().splitlines() if not call.startswith("dpkg")]
        return done.returncode, wanted, done.stderr

    def test_run_builds_the_program_alone(self):
        code, calls, said = self.bootstrap("run")
        self.assertEqual(code, 0)
        self.assertEqual(calls[:2], ["cmake --preset release -DBUILD_TESTING=OFF",
                                     "cmake --build --preset release --target sunder"])
        self.assertRegex(calls[2], "^sunder run meshes/scenes/bunny.json -o out/bunny")
        self.assertEqual(len(calls), 3)
        self.assertRegex(said, r"next:\nbootstrap:   build/release/sunder ")
        self.assertIn("./bootstrap all", said)

    def test_all_builds_what_every_command_needs(self):
        code, calls, said = self.bootstrap("all")
        self.assertEqual(code, 0)
        self.assertEqual(calls, ["cmake --preset release -DBUILD_TESTING=OFF",
                                 "cmake --build --preset release --target sunder sunder-bench page sunder_doors sunder_c python"])
        self.assertIn("sunder view", said)

    def test_tests_without_and_with_long_ones(self):
        for words, ending in ((("test",), " --label-exclude ^long$"), (("test", "all"), "")):
            code, calls, _ = self.bootstrap(*words)
            self.assertEqual(code, 0)
            self.assertEqual(calls, ["cmake --preset release -DBUILD_TESTING=ON",
                                     "cmake --build --preset release",
                                     "ctest --preset release -j 2" + ending])

    def test_docs_compiles_nothing(self):
        code, calls, _ = self.bootstrap("docs")
        self.assertEqual((code, calls), (0, ["python3 -B docs/site/make_site.py"]))

    def test_a_folder_with_tests_keeps_them(self):
        self.bootstrap("build")
        for word in ("run", "all"):
            self.assertEqual(self.bootstrap(word)[1][0], "cmake --preset release -DBUILD_TESTING=ON")

    def test_packages_of_each_word(self):
        def installed(*words):
            return " ".join(call for call in self.bootstrap(*words, NOTHING_INSTALLED="yes")[1] if " install " in call)
        run, test = installed("run"), installed("test")
        self.assertIn(" g++ ", run)
        for name in ("catch2", "ccache", "nodejs", "npm", "python3"):
            self.assertNotIn(f" {name}", run)
        self.assertIn(" catch2 ", test)
        for name in ("python3-sphinx", "doxygen"):
            self.assertIn(f" {name} ", test)
            self.assertIn(f" {name} ", installed("docs"))
        self.assertNotIn(" g++ ", installed("docs"))
        # node and npm are there already, whoever brought them.
        python = " python3-dev python3-numpy python3-matplotlib pybind11-dev"
        self.assertEqual(installed("all"), run + " gnuplot-nox" + python)
        self.assertIn(python, test)

    def test_without_npm_the_page_is_refused(self):
        (self.tools / "npm").unlink()
        code, calls, said = self.bootstrap("all", NOTHING_INSTALLED="yes")
        self.assertEqual(code, 1)
        self.assertTrue(any(call.endswith("nodejs npm") for call in calls))
        self.assertFalse(any(call.startswith("cmake") for call in calls))
        self.assertIn("node (18 or newer) and npm are needed", said)
        self.assertEqual(self.bootstrap("run")[0], 0)

    def test_other_words(self):
        for words in ((), ("tset",), ("run", "all"), ("test", "long"), ("test all", "run")):
            code, calls, said = self.bootstrap(*words)
            self.assertEqual((code, calls), (2, []), words)
            self.assertIn("usage:", said)
        done = subprocess.run([self.path / "bootstrap", "--help"], capture_output=True, text=True, check=True)
        named = set(re.findall(r"^(?:usage:|\s*) *(\./bootstrap [a-z]+(?: all)?)", done.stdout, re.MULTILINE))
        self.assertEqual(named, {f"./bootstrap {word}" for word in ("run", "all", "test", "test all", "build", "docs")})

    def test_ccache_that_comes_later_changes_no_command(self):
        """A build folder keeps to the ccache that it found, or did not find, when it was made."""
        text = (PROJECT / "CMakeLists.txt").read_text(encoding="utf-8")
        lookup = re.search(r"if\(NOT DEFINED CACHE\{SUNDER_CCACHE\}\)\n.*?\nendif\(\)\n", text, re.DOTALL)
        (self.path / "CMakeLists.txt").write_text(
            f"cmake_minimum_required(VERSION 3.25)\nproject(a NONE)\n{lookup[0]}"
            'message(STATUS "launcher: ${SUNDER_CCACHE}")\n')
        self.stand_in(self.path / "later/ccache")
        configure = [shutil.which("cmake"), "-S", self.path, "-B", self.path / "b"]
        for first in (["-DSUNDER_CCACHE=SUNDER_CCACHE-NOTFOUND"], []):  # as a search leaves it; then again
            done = subprocess.run([*configure, *first], capture_output=True, text=True, check=True,
                                  env={**os.environ, "PATH": f"{self.path / 'later'}:{os.environ['PATH']}"})
            self.assertIn("launcher: SUNDER_CCACHE-NOTFOUND", done.stdout)

    def test_nothing_is_fetched_while_configuring(self):
        fetches = re.compile(r"FetchContent|ExternalProject|file\s*\(\s*DOWNLOAD|execute_process\s*\([^)]*(npm|NPM|git|curl)")
        for pattern in ("CMakeLists.txt", "*.cmake"):
            for path in PROJECT.rglob(pattern):
                if path.relative_to(PROJECT).parts[0] not in ("build", "out") and "node_modules" not in path.parts:
                    self.assertIsNone(fetches.search(path.read_text(encoding="utf-8")), path)


if __name__ == "__main__":
    unittest.main(verbosity=1)
