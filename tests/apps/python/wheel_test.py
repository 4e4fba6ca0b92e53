# SPDX-License-Identifier: MIT
"""The wheel of the Python module: python3 wheel_test.py PROJECT BUILD_FOLDER

Builds it without a network from the build folder, installs it elsewhere, and breaks a body with it. Leaves the tree as it was.
Skipped (77) without pip, setuptools or wheel.
"""

import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import zipfile

PROJECT, BUILD = sys.argv[1:]
PIP = [sys.executable, "-m", "pip", "--disable-pip-version-check"]
OFFLINE = {**os.environ, "PIP_NO_INDEX": "1", "SUNDER_BUILD_FOLDER": BUILD}
USE = """
import sunder
sim = sunder.Simulation({"bodies": [{"mesh": sunder.box((1, 0.1, 0.1), (10, 2, 2)), "translation": [0, 0, 0.07],
    "velocity": [0, 0, -8], "material": {"tensile_strength": 1e6}}], "obstacles": [{"plane": {}}], "duration": 0.01})
print(sunder.__file__, max(report.pieces for report in sim.run()))
"""


def run(*command, **more):
    done = subprocess.run(command, capture_output=True, text=True, timeout=1200, **more)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def tree():
    return sorted(entry.name for folder in (".", "apps", "apps/python", "apps/python/sunder")
                  for entry in (pathlib.Path(PROJECT) / folder).iterdir() if entry.name not in ("build", "__pycache__"))


def main():
    if any(importlib.util.find_spec(name) is None for name in ("pip", "setuptools", "wheel")):
        print("skipped: pip, setuptools or wheel is not installed")
        return 77
    before = tree()
    with tempfile.TemporaryDirectory() as folder:
        run(*PIP, "wheel", PROJECT, "--no-deps", "--no-build-isolation", "-w", folder, env=OFFLINE)
        wheels = list(pathlib.Path(folder).glob("sunder-*.whl"))
        assert len(wheels) == 1, wheels
        names = zipfile.ZipFile(wheels[0]).namelist()
        for name in ("sunder/__init__.py", "sunder/_api.py", "sunder/__init__.pyi", "sunder/py.typed"):
            assert name in names, names
        assert sum(name.startswith("sunder/_sunder.") for name in names) == 1, names
        assert any(name.endswith("LICENSE") for name in names), names
        place = pathlib.Path(folder) / "place"
        run(*PIP, "install", "--no-deps", "--target", place, wheels[0], env=OFFLINE)
        printed = run(sys.executable, "-B", "-c", USE, env={**os.environ, "PYTHONPATH": str(place)}, cwd=folder)
        path, pieces = printed.split()
        assert path.startswith(str(place)) and int(pieces) > 1, printed
        # A build folder without the module is named, and nothing is packed.
        wrong = subprocess.run([*PIP, "wheel", PROJECT, "--no-deps", "--no-build-isolation", "-w", folder + "/no"],
                               capture_output=True, text=True, timeout=600, env={**OFFLINE, "SUNDER_BUILD_FOLDER": folder})
        assert wrong.returncode != 0
    assert tree() == before, set(tree()) ^ set(before)
    return 0


if __name__ == "__main__":
    sys.exit(main())
