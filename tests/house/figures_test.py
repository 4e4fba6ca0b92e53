# SPDX-License-Identifier: MIT
"""Figures of the sample scenes have one owner: the table of meshes/scenes/README.md, which measure.py writes.

    python3 figures_test.py PROJECT

Looked at: sentences and lines of tables outside docs/lab. One that names a sample (`bunny`, `monolith.json`) together with
a number of pieces or fans, or with a time that it takes, must
- have the number of the sample in the table, or
- link to the page that owns the number (in docs/lab, or meshes/scenes/README.md), or
- stand in own_figures.txt, as `page, number unit: reason`. A line of that list that is not needed fails the test.
Two pages cannot give two numbers for one sample then.
"""

import pathlib
import re
import sys
import unittest

import prose_test

HERE = pathlib.Path(__file__).resolve().parent
OWNER = "meshes/scenes/README.md"
COUNT = re.compile(r"\b(\d[\d  ]*) (pieces|fans)\b")
TIME = re.compile(r"\btakes?(?: about)? ([\d.]+) (s|seconds|min|minutes)\b")
OWNED = re.compile(r"\]\((?:[\w./-]*/)?(?:lab/[\w-]+\.md|scenes/README\.md)(?:#[\w-]*)?\)")


def table_of(page):
    """Sample to its figures, {"pieces": {...}, "fans": {...}}, with those of the paper's scene of this name."""
    rows = page.partition("<!-- measured: begin -->")[2].partition("<!-- measured: end -->")[0].strip().splitlines()
    head = prose_test.cells(rows[0])
    found = {}
    for row in rows[2:]:
        cells = prose_test.cells(row)
        name = re.match(r"\[(?:paper/)?([\w-]+)\]", cells[0])[1]
        for unit in ("pieces", "fans"):
            found.setdefault(name, {}).setdefault(unit, set()).add(cells[head.index(unit)])
    return found


def statements(page):
    """Sentences and lines of tables with the number of their first line."""
    for kind, number, text in prose_test.parts(page):
        if kind == "prose":
            # Links count here, so they stay in the sentence.
            yield from ((number, part) for part in prose_test.SENTENCE_END.split(text))
        elif kind == "row":
            yield number, text


def figures(page, samples):
    """Figures of samples in a page: (line, sample, number, unit), without sentences that link to the owner."""
    named = re.compile(rf"\b({'|'.join(sorted(samples))})(?:\.json)?\b")
    for line, text in statements(page):
        sample = named.search(text)
        if not sample or OWNED.search(text):
            continue
        for number, unit in (*COUNT.findall(text), *TIME.findall(text)):
            yield line, sample[1], re.sub(r"\D", "", number) if unit in ("pieces", "fans") else number, unit


def wrong_figures(pages, table, own):
    """Figures without an owner, and lines of the list that are not needed. `own`: (page, "22 pieces") to its reason."""
    wrong, used = [], set()
    for name, page in pages.items():
        for line, sample, number, unit in figures(page, table):
            if number in table[sample].get(unit, ()):
                continue
            if (name, f"{number} {unit}") in own:
                used.add((name, f"{number} {unit}"))
                continue
            known = " or ".join(sorted(table[sample].get(unit, ()))) or "no"
            wrong.append(f"{name}, line {line}: {sample} with {number} {unit}, the table of {OWNER} has {known}: link to "
                         "the page that owns the number")
    return wrong + [f"own_figures.txt: {page}, {figure} is not needed" for page, figure in own if (page, figure) not in used]


def read_own(text):
    found = {}
    for line in text.splitlines():
        if line.strip() and not line.startswith("#"):
            match = re.fullmatch(r"(\S+), ([\d.]+ \w+): \S.*", line)
            if not match:
                raise ValueError(f"own_figures.txt: `{line}` is not `page, number unit: reason`")
            found[match[1], match[2]] = line
    return found


class TheProject(unittest.TestCase):
    project = None

    def test_figures_of_samples_have_one_owner(self):
        pages = {name: (self.project / name).read_text(encoding="utf-8") for name in prose_test.pages(self.project)}
        table = table_of((self.project / OWNER).read_text(encoding="utf-8"))
        own = read_own((HERE / "own_figures.txt").read_text(encoding="utf-8"))
        wrong = wrong_figures(pages, table, own)
        self.assertEqual(wrong, [], "\n".join(wrong))


class ThisTest(unittest.TestCase):
    """The checks above can fail."""

    TABLE = {"bunny": {"pieces": {"65"}, "fans": {"499"}}, "bar": {"pieces": {"2"}, "fans": {"16"}}}

    def expect(self, count, text, own=()):
        wrong = wrong_figures({"docs/a.md": text}, self.TABLE, dict.fromkeys(own, ""))
        self.assertEqual(len(wrong), count, f"{text}: {wrong}")

    def test_other_numbers_are_found(self):
        self.expect(0, "The bunny has 65 pieces and 499 fans.")
        self.expect(1, "The bunny has 65 pieces and 500 fans.")
        self.expect(1, "| `bunny.json` | 1 241 pieces |")
        self.expect(1, "The run of the bunny takes 137 s.")
        self.expect(0, "The bunny has 3 ears. It has 70 pieces.")
        self.expect(0, "The bunny has 70 pieces ([paper](lab/paper.md)), 71 pieces ([s](../meshes/scenes/README.md#measured)).")

    def test_the_list_is_kept_short(self):
        self.expect(0, "The bunny has 70 pieces.", [("docs/a.md", "70 pieces")])
        self.expect(1, "The bunny has 65 pieces.", [("docs/a.md", "70 pieces")])
        self.assertRaises(ValueError, read_own, "docs/a.md, 70 pieces:")

    def test_the_table_is_read(self):
        page = ("<!-- measured: begin -->\n| scene | fans | pieces |\n|---|---|---|\n| [bunny](bunny.json) | 499 | 65 |\n"
                "| [paper/bunny](paper/bunny.json) | 1739 | 928 |\n<!-- measured: end -->\n")
        self.assertEqual(table_of(page), {"bunny": {"fans": {"499", "1739"}, "pieces": {"65", "928"}}})


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    TheProject.project = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=sys.argv[:1])
