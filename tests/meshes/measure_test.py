# SPDX-License-Identifier: MIT
"""The script that measures the sample scenes: its modes, shares and page, and a short run of `bar`.

    python3 measure_test.py PROJECT SUNDER
"""
import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest

PROJECT, PROGRAM = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
sys.path.insert(0, str(PROJECT / "meshes/scenes"))
import measure  # noqa: E402

NOTHING_CHOSEN = {"settings": {"chosen": []}}


def scene_file(folder, fracture):
    """A scene file that has only these keys of `fracture`."""
    path = pathlib.Path(folder) / "scene.json"
    path.write_text(json.dumps({"fracture": fracture}), encoding="utf-8")
    return path


class Parts(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_mode_is_the_last_word(self):
        """The default, the file's key over it, a --set over both."""
        bare = scene_file(self.folder, {})
        self.assertEqual(measure.mode_of(bare, NOTHING_CHOSEN, [], "object"), "object")
        chosen = {"settings": {"chosen": [{"key": "fracture.crack", "value": "cohesive"}]}}
        self.assertEqual(measure.mode_of(bare, chosen, [], "object"), "cohesive")
        said = scene_file(self.folder, {"crack": "paper"})
        self.assertEqual(measure.mode_of(said, NOTHING_CHOSEN, [], "object"), "paper")
        self.assertEqual(measure.mode_of(said, NOTHING_CHOSEN, ["fracture.crack=cohesive"], "object"),
                         "cohesive")

    def test_share_of_mass_in_single_tetrahedra(self):
        table = pathlib.Path(self.folder) / "fragments.csv"
        table.write_text("component,tetrahedra,mass\r\n0,7,3\r\n1,1,0.75\r\n2,1,0.25\r\n",
                         encoding="utf-8")
        self.assertEqual(measure.single_share(table), 0.25)

    def test_table_goes_between_its_markers(self):
        page = f"above\n{measure.BEGIN}\nold\n{measure.END}\nbelow\n"
        self.assertEqual(measure.with_table(page, "new\n"),
                         f"above\n{measure.BEGIN}\nnew\n{measure.END}\nbelow\n")
        with self.assertRaises(SystemExit):
            measure.with_table("a page without markers", "new\n")

    def test_page_has_the_markers(self):
        measure.with_table(measure.PAGE.read_text(encoding="utf-8"), "new\n")

    def test_scenes_are_those_of_both_folders(self):
        names = [measure.name_of(scene) for scene in measure.sample_scenes()]
        self.assertIn("[bar](bar.json)", names)
        self.assertIn("[paper/bunny](paper/bunny.json)", names)
        self.assertFalse([name for name in names if "schema" in name])


class Run(unittest.TestCase):
    def printed_lines(self, *words):
        """Lines of the table that the script prints."""
        page = measure.PAGE.read_bytes()
        table = io.StringIO()
        with contextlib.redirect_stdout(table), contextlib.redirect_stderr(io.StringIO()):
            measure.main([str(PROGRAM), *words])
        self.assertEqual(measure.PAGE.read_bytes(), page, "a table of changed runs is not the page's")
        return table.getvalue().splitlines()

    def test_short_bar(self):
        lines = self.printed_lines(str(PROJECT / "meshes/scenes/bar.json"), "--set", "duration=0.005",
                                   "--set", "fracture.crack=paper")
        self.assertEqual(len(lines), 3)
        cells = [cell.strip() for cell in lines[2].strip("|").split("|")]
        self.assertEqual(cells[:4], ["[bar](bar.json)", "`paper`", "3456", "0.005"])
        self.assertEqual(cells[6:9], ["1", "0", "0"])

    def test_failing_scene(self):
        with self.assertRaises(SystemExit) as failure:
            self.printed_lines(str(PROJECT / "meshes/scenes/bar.json"), "--set", "duration=-1")
        self.assertIn("exit code 3", str(failure.exception))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
