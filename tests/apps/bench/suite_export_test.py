#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The archive of `sunder suite --export` on trial, by itself: its bytes and checksums, its judge on a
kernel that is right, on wrong ones and on every way to be none.

    python3 suite_export_test.py SUNDER FIXTURES     the program; a folder of fixtures
"""
import hashlib
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

PROGRAM, FIXTURES = (Path(word).resolve() for word in sys.argv[1:3])


def run(words, **more):
    return subprocess.run([str(w) for w in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          stdin=subprocess.DEVNULL, text=True, errors="replace", **more)


class Archive(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.archive = cls.folder / "suite.tar.gz"
        done = run([PROGRAM, "suite", "--fixtures", FIXTURES, "--export", cls.archive])
        assert done.returncode == 0, done.stderr
        with tarfile.open(cls.archive) as archive:
            cls.members = archive.getmembers()
            archive.extractall(cls.folder)
        cls.suite = cls.folder / "sunder-suite"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def judge(self, kernel, *options):
        """The judge for a user with nothing but the archive and Python."""
        return run([sys.executable, "-I", self.suite / "judge.py", kernel, *options],
                   cwd=self.folder, env={"PATH": os.environ["PATH"]})

    def minimal(self, old="", new=""):
        """minimal.py, with one text in it exchanged for another."""
        text = (self.suite / "minimal.py").read_text()
        self.assertIn(old, text)
        path = self.folder / "changed.py"
        path.write_text(text.replace(old, new))
        return f"exec {sys.executable} {path}"

    def test_the_same_fixtures_give_the_same_bytes(self):
        again = self.folder / "again.tar.gz"
        time.sleep(1.1)  # past the next second, were there a time in it
        run([PROGRAM, "suite", "--fixtures", FIXTURES, "--export", again], cwd=self.folder)
        self.assertEqual(self.archive.read_bytes(), again.read_bytes())
        for member in self.members:
            self.assertEqual((member.mtime, member.uid, member.gid), (0, 0, 0), member.name)

    def test_every_file_has_its_checksum(self):
        lines = (self.suite / "SHA256SUMS").read_text().splitlines()
        sums = dict(reversed(line.split("  ")) for line in lines)
        there = {str(p.relative_to(self.suite)) for p in self.suite.rglob("*") if p.is_file()}
        self.assertEqual(there, {*sums, "SHA256SUMS"})
        self.assertLess({"README.md", "suite.md", "LICENSE", "judge.py", "minimal.py", "minimal.cpp", "serve.hpp",
                         "fixtures/fixture.schema.json"}, there)
        for name, digest in sums.items():
            self.assertEqual(hashlib.sha256((self.suite / name).read_bytes()).hexdigest(), digest)

    def test_the_program_judges_by_the_unpacked_fixtures_too(self):
        done = run([PROGRAM, "suite", "--fixtures", self.suite / "fixtures", "--kernel", "sunder"])
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_right_kernel_passes(self):
        report = self.folder / "right.xml"
        done = self.judge(self.minimal(), "--junit", report)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        fixtures = len(list((self.suite / "fixtures").glob("*.json"))) - 1
        self.assertIn(f"minimal: {fixtures} fixtures, ", done.stdout)
        self.assertIn(" 0 mismatches", done.stdout)
        suite = xml.parse(report).getroot().find("testsuite")
        self.assertEqual((suite.get("tests"), suite.get("failures"), suite.get("errors")),
                         (str(fixtures), "0", "0"))
        self.assertEqual(len(suite.findall("testcase")), fixtures)

    def compiled(self, old="", new=""):
        """minimal.cpp as a program, with one text in it exchanged for another."""
        text = (self.suite / "minimal.cpp").read_text()
        self.assertIn(old, text)
        source, program = self.suite / "changed.cpp", self.folder / "changed"
        source.write_text(text.replace(old, new))
        done = run([os.environ.get("CXX", "c++"), "-std=c++17", "-O2", "-Wall", "-Wextra", source, "-o", program])
        source.unlink()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return f"exec {program}"

    @unittest.skipUnless(shutil.which(os.environ.get("CXX", "c++")), "no compiler of C++ is installed")
    def test_the_kernel_in_cpp_passes_and_a_broken_one_does_not(self):
        done = self.judge(self.compiled())
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(" 0 mismatches", done.stdout)
        lies = {("parted.edges.push_back({a, b});", "{}"): "split edges of face",
                ("parted.separated = !meet(here, there, {});", ""): "separation by face",
                ("sheets.size()}", "sheets.size() + 1}"): "boundary sheets: expected"}
        for (old, new), text in lies.items():
            with self.subTest(lie=old):
                done = self.judge(self.compiled(old, new), "--fail-fast")
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                self.assertIn(text, done.stdout)

    def test_wrong_answers_are_told_with_the_fixture_and_the_step(self):
        lies = {
            ("edges = [e for e", "edges = [] and [e for e"): "split edges of face",
            ("vertices = [p for p in face if apart((p,))]", "vertices = face"): "split vertices of face",
            ("int(apart(()))]", "0]"): "separation by face",
            ('return "boundary"', 'return "split 0 0 0"'): "a boundary face",
            ("cells = [count(1),", "cells = [count(1) + 1,"): "vertices: expected",
            ("boundary, sheets]", "boundary, sheets + 1]"): "boundary sheets: expected",
            ("return self.numbers([(t, ()) for t in range(len(self.tetrahedra))])",
             "return [0] * len(self.tetrahedra)"): "components: tetrahedron",
            ("return self.numbers([(t, (p,)) for t, row in enumerate(self.tetrahedra) for p in row])",
             "return [p for row in self.tetrahedra for p in row]"): "vertices: point",
            ('= b, a\n        return "ok"', '= b, a\n        return "refused"'): "gluing",
            ('return "ok" if self.orientable() else', 'return'): "loading",
            ("int(kernel.orientable())", "0"): "orientable: expected",
        }
        for (old, new), text in lies.items():
            with self.subTest(lie=new):
                report = self.folder / "wrong.xml"
                done = self.judge(self.minimal(old, new), "--fail-fast", "--junit", report)
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                self.assertIn("DIFFERS", done.stdout)
                self.assertIn(text, done.stdout)
                suite = xml.parse(report).getroot().find("testsuite")
                self.assertEqual(suite.get("failures"), "1")
                self.assertIn(text, suite.findall("testcase")[-1].find("failure").get("message"))

    def test_every_way_to_be_no_kernel_is_told_within_its_time(self):
        mesh = "for i in 1 2 3 4 5 6 7 8; do read q; done; "  # two tetrahedra
        ways = {
            "sleep 1000": "no answer within 1 s",
            "kill -STOP $$": "no answer within 1 s",
            "trap '' TERM HUP; while :; do sleep 1; done": "no answer within 1 s",
            "(trap '' TERM; sleep 1000) & wait": "no answer within 1 s",
            "exec 0<&-; exec sleep 1000": "no answer within 1 s",
            "exit 3": "ended with exit code 3",
            "kill -SEGV $$": "was ended by signal 11",
            "exec 1>&-; sleep 1000": "closed its output",
            "sleep 1000 & exit 4": "exit code 4 and left its output to another process",
            "yes | tr -d '\\n'": "its answer is longer than",
            mesh + "echo good morning; read q": 'expected "ok | refused REASON", got "good morning"',
            mesh + "printf 'ok\\nok\\n'; read q": "has another line",
            mesh + "printf '\\033[2J\\n'; read q": "\\x1b[2J",
            mesh + "echo ok; read q; echo counts 5 9 7 2 1 6; read q": 'got "counts 5 9 7 2 1 6"',
            mesh + "echo ok; read q; echo counts 5 9 7 2 1 6 1 1; read q": 'got "counts',
            mesh + "echo ok; read q; echo counts 5 9 7 2 1 6 -1; read q": 'got "counts',
            mesh + "echo ok; read q; echo counts 5 9 7 2 1 6 1; read q; "
                   "echo vertices 0 1 2 3 1 0 2 4294967296; read q": 'got "vertices',
        }
        for way, text in ways.items():
            with self.subTest(way=way):
                start = time.monotonic()
                done = self.judge(f"read q; echo hello 1 stub; {way}", "two-tetrahedra",
                                  "--timeout", "1", "--fail-fast")
                self.assertLess(time.monotonic() - start, 100)  # not the 1 000 that some sleep
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                self.assertIn("LOST", done.stdout)
                self.assertIn(text, done.stdout)
                self.assertNotIn("Traceback", done.stderr)

    def test_a_kernel_that_is_always_silent_is_given_up(self):
        report = self.folder / "silent.xml"
        done = self.judge("read q; echo hello 1 stub; sleep 1000", "--timeout", "1", "--junit", report)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout.count("no answer within"), 3)
        self.assertIn("not asked: it gave no answer in 3 fixtures one after the other", done.stdout)
        suite = xml.parse(report).getroot().find("testsuite")
        self.assertEqual(suite.get("errors"), suite.get("tests"))

    def test_exit_codes(self):
        kernel = self.minimal()
        self.assertEqual(self.judge("exit 7").returncode, 2)
        self.assertEqual(self.judge("read q; echo hello 2 late").returncode, 2)
        self.assertEqual(self.judge(kernel, "none-such").returncode, 2)
        for bad in ("0", "-1", "nan", "inf", "soon"):
            self.assertEqual(self.judge(kernel, "--timeout", bad).returncode, 2)
        self.assertEqual(self.judge(kernel, "--fixtures", self.folder / "none").returncode, 3)
        plain = self.folder / "plain"
        plain.mkdir()
        (plain / "a.json").write_text("[1, 2")
        self.assertEqual(self.judge(kernel, "--fixtures", plain).returncode, 3)
        done = self.judge(kernel, "--fixtures", FIXTURES)  # not exported: operations to resolve
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn("not an exported fixture", done.stderr)
        self.assertEqual(self.judge(kernel, "two-tetrahedra", "--junit", "/nowhere/at/all.xml").returncode, 4)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
