# SPDX-License-Identifier: MIT
"""`sunder run --columns` lists each column and key that runs write, and no other.

    python3 output_columns_test.py SUNDER MESHES

Runs a few scenes of milliseconds, reads every file, and compares both ways: a key that a run wrote is in the list; one of
the list is in a run, in each run where it has no condition.
"""

import collections
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

BAR = {"mesh": "bar.msh",
       "material": {"young_modulus": 30e9, "density": 2400, "tensile_strength": 3e6, "fracture_energy": 33},
       "cuts": [{"plane": {"point": [0.4, 0, 0], "normal": [1, 0, 0]},
                 "box": {"minimum": [0, 0, 0], "maximum": [1, 1, 0.1001]}}],
       "held": [{"minimum": [0, 0, 0], "maximum": [1e-6, 1, 1]},
                {"minimum": [0.799999, 0, 0], "maximum": [1, 1, 1], "velocity": [0.05, 0, 0]}]}
SCENES = {
    "cohesive": {"bodies": [BAR], "time_step": 1e-4, "duration": 0.004, "fracture": {"crack": "cohesive"},
                 "output": {"frames": 2}},
    # A body with a load.
    "paper": {"bodies": [{**BAR, "loads": [{"minimum": [0, 0, 0.0999], "maximum": [1, 1, 1], "force": [0, 0, -1]}]}],
              "time_step": 1e-4, "duration": 0.003, "fracture": {"crack": "paper"},
              "energy_ledger": False, "display_time_constant": 0, "output": {"frames": 2}},
    # A body of order 2, a free ball that breaks it, and cracks that have opened.
    "ball": {"bodies": [{"mesh": "monolith.msh", "order": 2, "material": {"tensile_strength": 1e6}}],
             "obstacles": [{"plane": {}},
                           {"sphere": {"center": [0, -0.36, 1], "radius": 0.2}, "velocity": [0, 10, 0], "mass": 80}],
             "time_step": 1e-3, "duration": 0.03, "output": {"frames": 3, "crack_surface": "smooth"}},
}
# Keys of runs that this test does not make.
OF_OTHER_RUNS = "the run continues another with `--from`"


def nested(value, listed, prefix=""):
    """Keys of a value in the way of the list: dots, [] for elements; a listed key ends the search, and the names in
    its value come as `key/name`."""
    found = set()
    for key, inner in value.items():
        name = f"{prefix}{key}"
        if name in listed:
            found.add(name)
            if isinstance(inner, dict):
                found |= {f"{name}/{part}" for part in inner}
        elif isinstance(inner, dict):
            found |= nested(inner, listed, name + ".")
        elif isinstance(inner, list) and inner and isinstance(inner[0], dict):
            for one in inner:
                found |= nested(one, listed, name + "[].")
        elif not (isinstance(inner, list) and not inner):
            found.add(name)
    return found


def without_rows(name):
    """The name of a column of history.csv with letters for rows of the scene's lists, as the list has it."""
    for pattern, letters in ((r"^obstacle_\d+_", "obstacle_K_"), (r"^body_\d+_load_\d+_", "body_B_load_L_"),
                             (r"^body_\d+_held_\d+_", "body_B_held_H_")):
        name = re.sub(pattern, letters, name)
    return name


def kind_of_line(line):
    return ("first line" if "log" in line else "last line" if "end" in line else
            "line per release" if "release" in line else "line per fan")


def written(folder, listed):
    """The names in the files of a run: (file, part) to a list of sets, one per record."""
    found = collections.defaultdict(list)
    for path in sorted(folder.iterdir()):
        if path.suffix == ".csv":
            with path.open(newline="", encoding="utf-8") as file:
                names = tuple(next(csv.reader(file)))
            if path.name == "history.csv":
                names = tuple(dict.fromkeys(map(without_rows, names)))
            found[path.name, ""].append(names)
        elif path.name == "report.json":
            found[path.name, ""].append(nested(json.loads(path.read_text()), listed[path.name, ""]))
        elif path.name == "events.jsonl":
            for text in path.read_text().splitlines():
                line = json.loads(text)
                part = kind_of_line(line)
                found[path.name, part].append(nested(line, listed[path.name, part]))
    for path in (folder / "frames").glob("*.vtu"):
        head = path.read_bytes().split(b"<AppendedData")[0].decode()
        for part, tag in (("points", "PointData"), ("cells", "CellData")):
            block = re.search(rf"<{tag}>(.*?)</{tag}>", head, re.DOTALL)[1]
            found["frames/*.vtu", part].append(set(re.findall(r'Name="([^"]+)"', block)))
    return found


class Columns(unittest.TestCase):
    sunder = meshes = None

    def test_list_and_files_agree(self):
        listed = {(one["file"], one["part"]): {c["name"]: c for c in one["columns"]}
                  for one in json.loads(subprocess.run([self.sunder, "run", "--columns"], capture_output=True,
                                                       check=True, text=True).stdout)}
        found = collections.defaultdict(list)
        with tempfile.TemporaryDirectory() as folder:
            for name, scene in SCENES.items():
                for body in scene["bodies"]:
                    body["mesh"] = str(self.meshes / pathlib.Path(body["mesh"]).name)
                path = pathlib.Path(folder) / f"{name}.json"
                path.write_text(json.dumps(scene))
                out = pathlib.Path(folder) / name
                done = subprocess.run([self.sunder, "run", path, "-o", out, "--quiet"], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                for key, records in written(out, listed).items():
                    found[key] += records
        self.assertEqual(set(found), {key for key, columns in listed.items() if columns})
        for key, records in found.items():
            self.compare(key, records, listed[key])

    def compare(self, key, records, columns):
        if isinstance(records[0], tuple):
            seen = set().union(*records)
            self.assertEqual(seen, set(columns), key)
            for record in records:
                always = {name for name, column in columns.items() if not column["when"]}
                self.assertLessEqual(always, set(record), key)
                self.assertEqual(list(record), [name for name in columns if name in record], key)
            return
        plain = [{name for name in record if "/" not in name} for record in records]
        inner = {name for record in records for name in record if "/" in name}
        self.assertEqual(set().union(*plain) - set(columns), set(), f"{key}: written and not listed")
        seen = set().union(*plain)
        for name, column in columns.items():
            if column["when"] != OF_OTHER_RUNS:
                self.assertIn(name, seen, f"{key}: listed and never written")
            # Keys of lists are missing where a list is empty.
            if not column["when"] and "[]" not in name:
                self.assertTrue(all(name in record for record in plain), f"{key}: {name} is not in every run")
        for name in inner:
            outer, part = name.split("/")
            meaning = columns[outer]["meaning"]
            if part not in ("mean", "median", "p99", "max"):
                self.assertIn(f"`{part}`", meaning, f"{key}: {outer} holds {part}, which its meaning does not name")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    Columns.sunder, Columns.meshes = (pathlib.Path(name).resolve() for name in sys.argv[1:])
    unittest.main(argv=sys.argv[:1])
