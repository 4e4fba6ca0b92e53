# SPDX-License-Identifier: MIT
"""Comments are plain: clauses that begin with what, who, whom or whose are rare.

    python3 comments_test.py PROJECT           the test
    python3 comments_test.py PROJECT FOLDER... prints the lines with such clauses, for writers

Such a clause stands for a thing that has a name ("what is struck" for a struck body). At most one comment line in a hundred
of each folder of the sources has one. Looked at: the text behind // in C++ and C sources, licence lines left out.
"""

import pathlib
import re
import subprocess
import sys
import unittest

FOLDERS = ("topology", "mechanics", "fracture", "apps", "tests", "examples")
MOST_PER_HUNDRED = 1
COMMENT = re.compile(r"(?:^|\s)///?<?(.*)")
HEADLESS = re.compile(r"\b(?:what|who|whom|whose)\b", re.IGNORECASE)
PROJECT = pathlib.Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else pathlib.Path(".")


def sources(folder):
    names = subprocess.run(["git", "ls-files", folder], cwd=PROJECT, capture_output=True, text=True, check=True).stdout.split()
    return [name for name in names if name.endswith((".cpp", ".hpp", ".h"))]


def comment_lines(text):
    """Number and text of each comment line."""
    for number, line in enumerate(text.splitlines(), 1):
        found = COMMENT.search(line)
        if found and found[1].strip() and "SPDX" not in line:
            yield number, found[1].strip()


def headless_lines(folder):
    """All comment lines of a folder, counted, and those with a headless clause."""
    count, headless = 0, []
    for name in sources(folder):
        for number, comment in comment_lines((PROJECT / name).read_text(encoding="utf-8")):
            count += 1
            if HEADLESS.search(comment):
                headless.append(f"{name}:{number}: {comment}")
    return count, headless


class Comments(unittest.TestCase):
    def test_clauses_are_found(self):
        text = "// Moves what is struck.\nint a;  ///< m, of whose centre\nint b;  // of struck bodies\n/// SPDX who\n"
        found = [number for number, comment in comment_lines(text) if HEADLESS.search(comment)]
        self.assertEqual(found, [1, 2])

    def test_headless_clauses_are_rare(self):
        for folder in FOLDERS:
            with self.subTest(folder=folder):
                count, headless = headless_lines(folder)
                self.assertGreater(count, 0)
                self.assertLessEqual(100 * len(headless), MOST_PER_HUNDRED * count, "\n".join(headless))


if __name__ == "__main__":
    if len(sys.argv) > 2:
        for folder in sys.argv[2:]:
            count, headless = headless_lines(folder)
            print(*headless, f"{folder}: {len(headless)} of {count} comment lines", sep="\n")
    else:
        unittest.main(argv=sys.argv[:1])
