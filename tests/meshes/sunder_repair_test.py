#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs sunder-repair as `sunder break` does: unions, cavities, wraps, exit codes, repeatable bytes.

    python3 sunder_repair_test.py PROGRAM
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path()
FACES = [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4),
         (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6), (3, 0, 4), (3, 4, 7)]
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def off(*cubes):
    """Cubes of (low corner, side, faces) as one OFF file."""
    points, faces = [], []
    for low, side, own in cubes:
        faces += [[len(points) + c for c in f] for f in own]
        points += [[low + side * x for x in p] for p in CORNERS]
    return "OFF\n%d %d 0\n" % (len(points), len(faces)) + "".join(
        "%.17g %.17g %.17g\n" % tuple(p) for p in points) + "".join("3 %d %d %d\n" % tuple(f) for f in faces)


def volume(path):
    words = path.read_text(encoding="ascii").split()
    assert words[0] == "OFF"
    points, faces = int(words[1]), int(words[2])
    numbers = [float(w) for w in words[4:4 + 3 * points]]
    x = [numbers[3 * i:3 * i + 3] for i in range(points)]
    rows = [int(w) for w in words[4 + 3 * points:]]
    total = 0
    for f in range(faces):
        a, b, c = (x[r] for r in rows[4 * f + 1:4 * f + 4])
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    return total


class Repair(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.out = pathlib.Path(self.folder.name) / "out.off"

    def run_on(self, text, *options):
        path = pathlib.Path(self.folder.name) / "in.off"
        path.write_text(text, encoding="ascii")
        return subprocess.run([PROGRAM, path, self.out, *options], capture_output=True, text=True, timeout=120, check=False)

    def test_overlapping_shells_become_one(self):
        done = self.run_on(off((0, 1, FACES), (0.5, 1, FACES)))
        self.assertEqual(done.returncode, 0, done.stderr)
        answer = json.loads(done.stdout)
        self.assertEqual((answer["method"], answer["shells"], answer["crossing_shells"]), ("union", 2, 0))
        self.assertAlmostEqual(volume(self.out), 2 - 0.125, 9)
        before = self.out.read_bytes()
        self.run_on(off((0, 1, FACES), (0.5, 1, FACES)))
        self.assertEqual(self.out.read_bytes(), before)

    def test_a_shell_that_looks_inward_is_cut_out(self):
        inward = [(a, c, b) for a, b, c in FACES]
        done = self.run_on(off((0, 1, FACES), (0.25, 0.5, inward)))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(volume(self.out), 0.875, 9)

    def test_what_has_no_union_is_wrapped_if_allowed(self):
        text = off((0, 1, FACES[:10]))
        refused = self.run_on(text)
        self.assertEqual(refused.returncode, 3)
        self.assertIn("not_united", refused.stderr)
        self.assertFalse(self.out.exists())
        done = self.run_on(text, "--alpha", "0.05", "--offset", "0.01")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["method"], "wrap")
        self.assertGreater(volume(self.out), 0)

    def test_a_wrap_is_simplified(self):
        counts = []
        for triangles in ("300", "100000"):
            done = self.run_on(off((0, 1, FACES)), "--wrap", "--alpha", "0.05", "--offset", "0.02",
                               "--triangles", triangles)
            self.assertEqual(done.returncode, 0, done.stderr)
            counts.append(json.loads(done.stdout)["triangles"])
            self.assertAlmostEqual(volume(self.out), 1.04 ** 3, delta=0.03)
        self.assertLess(counts[0], 1000)
        self.assertGreater(counts[1], 2 * counts[0])

    def test_mistakes_have_exit_codes(self):
        self.assertEqual(self.run_on("no surface").returncode, 3)
        self.assertEqual(self.run_on(off((0, 1, FACES)), "--alpha", "-1").returncode, 2)
        self.assertEqual(self.run_on(off((0, 1, FACES)), "--wrap").returncode, 2)
        self.out = pathlib.Path(self.folder.name) / "none" / "none" / "out.off"
        self.assertEqual(self.run_on(off((0, 1, FACES))).returncode, 4)


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv[1])
    if not PROGRAM.exists():
        print("sunder-repair has not been built: skipped")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
