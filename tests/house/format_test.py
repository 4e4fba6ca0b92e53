# SPDX-License-Identifier: MIT
"""Sources have the format of .clang-format: `format_test.py PROJECT` prints each file that differs.

Needs clang-format 14, the one of Debian 12: others format otherwise. Exit code 77, skipped, without it.
"""

import pathlib
import shutil
import subprocess
import sys

PROJECT = pathlib.Path(sys.argv[1]).resolve()
SOURCES = ("*.cpp", "*.hpp", "*.h")


def main():
    formatter = shutil.which("clang-format-14")
    if not formatter:
        print("clang-format-14 is not installed")
        return 77
    names = subprocess.run(["git", "ls-files", *SOURCES], cwd=PROJECT, capture_output=True, text=True, check=True).stdout.split()
    assert len(names) > 500, names
    wrong = []
    for first in range(0, len(names), 50):
        said = subprocess.run([formatter, "--dry-run", *names[first:first + 50]], cwd=PROJECT, capture_output=True, text=True).stderr
        wrong += [line.split(":")[0] for line in said.splitlines() if "clang-format-violations" in line]
    for name in sorted(set(wrong)):
        print(f"{name}: run clang-format-14 -i {name}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
