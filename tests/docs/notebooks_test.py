# SPDX-License-Identifier: MIT
"""Executes the notebooks of docs/notebooks, cell by cell, as Jupyter would, and holds them to their form:
plain, in order, no outputs stored.

    python3 notebooks_test.py PROJECT BUILD [NOTEBOOK...]

The module is that of BUILD. A notebook asserts what it shows.
"""

import contextlib
import io
import json
import os
import pathlib
import sys
import tempfile
import unittest

MOST_BYTES = 20_000


def code_of(book):
    return ["".join(cell["source"]) for cell in book["cells"] if cell["cell_type"] == "code"]


def faults(text):
    """What is wrong with the form of a notebook: a text each."""
    book, wrong = json.loads(text), []
    if (book["nbformat"], book["nbformat_minor"]) != (4, 5):
        wrong.append("is not of the format 4.5")
    if len(text) > MOST_BYTES:
        wrong.append(f"has {len(text)} bytes, allowed are {MOST_BYTES}")
    if len({cell["id"] for cell in book["cells"]}) < len(book["cells"]):
        wrong.append("has two cells of one id")
    for cell in book["cells"]:
        if cell["cell_type"] == "code" and (cell["outputs"] or cell["execution_count"] is not None):
            wrong.append(f"stores outputs of the cell {cell['id']}")
    if not any("assert" in code for code in code_of(book)):
        wrong.append("asserts nothing")
    return wrong


def execute(path):
    """Runs the cells of a notebook in one namespace, in its folder. Its outputs are returned."""
    os.environ["MPLBACKEND"] = "Agg"
    names, printed = {"__name__": "__main__"}, io.StringIO()
    before = os.getcwd()
    os.chdir(path.parent)
    try:
        with contextlib.redirect_stdout(printed):
            for number, code in enumerate(code_of(json.loads(path.read_text(encoding="utf-8"))), 1):
                exec(compile(code, f"{path.name}, code cell {number}", "exec"), names)
    finally:
        os.chdir(before)
    return printed.getvalue()


class Notebooks(unittest.TestCase):
    project, names = pathlib.Path(), []

    def test_forms_are_plain(self):
        paths = sorted((self.project / "docs/notebooks").glob("*.ipynb"))
        self.assertGreaterEqual(len(paths), 4)
        for path in paths:
            self.assertEqual(faults(path.read_text(encoding="utf-8")), [], path.name)

    def test_a_stored_output_is_a_fault(self):
        path = next((self.project / "docs/notebooks").glob("*.ipynb"))
        book = json.loads(path.read_text(encoding="utf-8"))
        cell = next(cell for cell in book["cells"] if cell["cell_type"] == "code")
        cell["execution_count"] = 3
        self.assertIn(f"stores outputs of the cell {cell['id']}", faults(json.dumps(book)))

    def test_a_wrong_claim_is_a_failure(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "wrong.ipynb")
            path.write_text(json.dumps({"cells": [{"cell_type": "code", "source": ["a = 1\n", "print(a)"]},
                                                  {"cell_type": "code", "source": ["assert a == 2"]}]}))
            with self.assertRaises(AssertionError):
                execute(path)

    def test_every_cell_runs(self):
        for path in sorted((self.project / "docs/notebooks").glob("*.ipynb")):
            if self.names and path.stem not in self.names:
                continue
            with self.subTest(notebook=path.name):
                print(path.name, execute(path), sep="\n", file=sys.stderr)


if __name__ == "__main__":
    Notebooks.project = pathlib.Path(sys.argv[1]).resolve()
    sys.path.insert(0, str(pathlib.Path(sys.argv[2], "python").resolve()))
    Notebooks.names = sys.argv[3:]
    unittest.main(argv=sys.argv[:1], verbosity=2)
