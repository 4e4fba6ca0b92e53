# SPDX-License-Identifier: MIT
"""Runs sunder-mesh as its user does: exit codes, messages, repeatable bytes.

    python3 sunder_mesh_test.py PROGRAM MESHES

Exits with 77 (ctest: skipped) when the program has not been built. Uses the bunny's surface where
Debian's libcgal-demo is installed.
"""

import json
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import unittest

SURFACES = pathlib.Path("/usr/share/doc/libcgal-demo/data.tar.gz")
BUNNY = ["--up", "y", "--height", "0.15", "--ground", "--region", "bunny", "--facet-size", "0.012",
         "--cell-size", "0.0084", "--facet-distance", "0.0036", "--tetrahedra", "6142"]

TETRAHEDRON = """OFF
4 4 0
0 0 0
1 0 0
0 1 0
0 0 1
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
"""


class SunderMesh(unittest.TestCase):
    program = meshes = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_it(self, *arguments):
        return subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True,
                              check=False)

    def surface(self, text, name="in.off"):
        path = self.folder / name
        path.write_text(text)
        return path

    def refused(self, code, *arguments, exit_code=3):
        """Runs on arguments that must be refused with the finding `code`, nothing written."""
        out = self.folder / "out.msh"
        done = self.run_it(*arguments, "-o", out)
        self.assertEqual(done.returncode, exit_code, done.stderr)
        self.assertIn(f"[{code}]", done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertFalse(out.exists())

    def test_help_names_units_and_defaults(self):
        done = self.run_it("--help")
        self.assertEqual(done.returncode, 0)
        for word in ("--tetrahedra", "default", "degrees", "Exit codes", "m"):
            self.assertIn(word, done.stdout)

    def test_usage_errors_exit_with_2(self):
        out = self.folder / "out.msh"
        for arguments in ([], ["-o", out], ["--box", "1,2", "-o", out],
                          ["--box", "1,2,3", "--ring", "2,1,1", "-o", out],
                          ["--box", "1,-2,3", "-o", out], ["--ring", "1,2,1", "-o", out],
                          ["--box", "1,1,1", "-o", out, "--facet-size", "0"],
                          ["--box", "1,1,1", "-o", out, "--facet-angle", "45"],
                          ["--box", "1,1,1", "-o", out, "--up", "w"],
                          ["--box", "1,1,1", "-o", out, "--unknown"], ["--box", "1,1,1"]):
            done = self.run_it(*arguments)
            self.assertEqual(done.returncode, 2, (arguments, done.stderr))
            self.assertNotEqual(done.stderr, "")
            self.assertFalse(out.exists())

    def test_a_bad_surface_is_refused_by_name(self):
        self.refused("cannot_open", self.folder / "absent.off")
        self.refused("unknown_format", self.surface(TETRAHEDRON, "in.xyz"))
        self.refused("not_a_surface", self.surface("nonsense"))
        self.refused("not_a_surface", self.surface(TETRAHEDRON[:40]))
        self.refused("empty_surface", self.surface("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"))
        self.refused("open_surface", self.surface(TETRAHEDRON.replace("4 4 0", "4 3 0", 1)
                                                  .replace("3 1 2 3\n", "")))
        fin = TETRAHEDRON.replace("4 4 0", "5 5 0").replace("0 0 1\n3", "0 0 1\n5 5 5\n3", 1)
        self.refused("non_manifold_surface", self.surface(fin + "3 0 1 4\n"))

    def test_a_file_that_cannot_be_written_exits_with_4(self):
        file = self.folder / "a file"
        file.write_text("")
        done = self.run_it("--box", "1,1,1", "--facet-size", "0.5", "-o", file / "out.msh")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("[cannot_write]", done.stderr)

    def test_refinement_without_end_is_stopped(self):
        self.refused("mesh_too_large", "--box", "1,1,1", "--facet-size", "0.02", "--max-vertices",
                     "500")

    def test_a_box_is_filled(self):
        out = self.folder / "box.msh"
        done = self.run_it("--box", "1,0.5,2", "--facet-size", "0.15", "-o", out, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        figures = json.loads(done.stdout)
        self.assertEqual(figures["components"], 1)
        # Sharp edges are kept, so the volume is the box's.
        self.assertAlmostEqual(figures["volume"], 1.0, delta=1e-9)
        self.assertEqual(figures["bounding_box"], [[-0.5, -0.25, 0], [0.5, 0.25, 2]])
        self.assertGreaterEqual(figures["dihedral_angle"][0], 10)

    def test_obj_and_stl_are_read_like_off(self):
        points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        triangles = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        obj = "".join("v %g %g %g\n" % p for p in points) + "".join(
            "f %d %d %d\n" % tuple(v + 1 for v in t) for t in triangles)
        stl = "solid t\n" + "".join(
            "facet normal 0 0 0\nouter loop\n" + "".join("vertex %g %g %g\n" % points[v] for v in t)
            + "endloop\nendfacet\n" for t in triangles) + "endsolid t\n"
        volumes = []
        for name, text in (("t.off", TETRAHEDRON), ("t.obj", obj), ("t.stl", stl)):
            done = self.run_it(self.surface(text, name), "--feature-angle", "60", "--json", "-o",
                               self.folder / "t.msh")
            self.assertEqual(done.returncode, 0, (name, done.stderr))
            volumes.append(json.loads(done.stdout)["volume"])
        for volume in volumes:
            self.assertAlmostEqual(volume, 1 / 6, delta=1e-9)

    def test_the_same_command_gives_the_same_bytes(self):
        files = [self.folder / name for name in ("a.msh", "b.msh")]
        for path in files:
            done = self.run_it("--ring", "0.5,0.3,0.2", "--tetrahedra", "3000", "--tries", "6",
                               "-o", path)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(files[0].read_bytes(), files[1].read_bytes())

    @unittest.skipUnless(SURFACES.is_file(), "libcgal-demo is not installed")
    def test_the_bunny_is_what_the_readme_command_makes(self):
        with tarfile.open(SURFACES) as archive:
            archive.extract("data/meshes/bunny00.off", self.folder)
        done = self.run_it(self.folder / "data/meshes/bunny00.off", *BUNNY, "--json", "-o",
                           self.folder / "bunny.msh")
        self.assertEqual(done.returncode, 0, done.stderr)
        figures = json.loads(done.stdout)
        self.assertLessEqual(abs(figures["tetrahedra"] / 6142 - 1), 0.03)
        self.assertLessEqual(abs(figures["vertices"] / 1363 - 1), 0.03)
        self.assertGreaterEqual(figures["dihedral_angle"][0], 10)
        # Another processor or CGAL may round otherwise, so the bytes are printed but not demanded.
        same = (self.folder / "bunny.msh").read_bytes() == (self.meshes / "bunny.msh").read_bytes()
        print("bunny.msh:", "same bytes" if same else "other bytes than the committed file")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    if not pathlib.Path(sys.argv[1]).is_file():
        print("sunder-mesh has not been built: skipped")
        sys.exit(77)
    SunderMesh.program, SunderMesh.meshes = sys.argv[1], pathlib.Path(sys.argv[2])
    unittest.main(argv=sys.argv[:1])
