# SPDX-License-Identifier: MIT
"""The wheel of the Python module: CMake builds it, setuptools packs it.

SUNDER_BUILD_FOLDER, where set, is a build folder of CMake that is used as it is. Otherwise build/wheel is configured with
the module alone, without pictures, the page's server, benchmarks and tests.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

TREE = pathlib.Path(__file__).resolve().parent
VERSION = re.search(r"project\(sunder VERSION ([\d.]+)", (TREE / "CMakeLists.txt").read_text())[1]
LEFT_OUT = ("RENDERER", "VIEW", "BENCH")


class BuildByCMake(build_ext):
    def build_extension(self, ext):
        folder = os.environ.get("SUNDER_BUILD_FOLDER")
        if folder is None:
            folder = TREE / "build/wheel/cmake"
            subprocess.run(["cmake", "-S", TREE, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DBUILD_TESTING=OFF", *(f"-DSUNDER_BUILD_{part}=OFF" for part in LEFT_OUT),
                            f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "sunder_python"], check=True)
        made = list((pathlib.Path(folder) / "python/sunder").glob("_sunder*.so"))
        if len(made) != 1:
            raise SystemExit(f"no module in {folder}: install pybind11-dev, python3-dev and python3-numpy")
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(made[0], target)


(TREE / "build/wheel").mkdir(parents=True, exist_ok=True)
setup(
    name="sunder",
    version=VERSION,
    description="Breaks tetrahedral bodies on an exact 3-map",
    license="MIT",
    license_files=["LICENSE", "THIRD_PARTY.md"],
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["sunder"],
    package_dir={"sunder": "apps/python/sunder"},
    package_data={"sunder": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("sunder._sunder", [])],
    cmdclass={"build_ext": BuildByCMake},
    options={"build": {"build_base": "build/wheel"}, "egg_info": {"egg_base": "build/wheel"}},
)
