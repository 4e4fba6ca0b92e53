# SPDX-License-Identifier: MIT
"""Each question of docs/lab/newcomers.md is answered within three clicks from README.md.

    python3 newcomers_test.py

A row of its table has a path of links and words in quotes. Each link leads to a section. The section links the next page
of the path, and the words stand in the last section.
"""

import pathlib
import posixpath
import re
import sys
import unittest

PROJECT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "docs/site"))
import make_site  # noqa: E402

PAGE, MOST_CLICKS = "docs/lab/newcomers.md", 3


def links(page, text):
    """The pages that a page links, by their paths from the root, each with its section or an empty text."""
    found = []
    for match in make_site.LINK.finditer(text):
        path, _, section = match[2].partition("#")
        found.append((posixpath.normpath(posixpath.join(posixpath.dirname(page), path)) if path else page, section))
    return found


def anchor(heading):
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def sections(text):
    """The text below each heading, down to the next one, by the heading's anchor."""
    found, name, in_code = {}, "", False
    for line in text.splitlines():
        in_code ^= line.startswith("```")
        if line.startswith("#") and not in_code:
            name = anchor(line.lstrip("#"))
            found.setdefault(name, "")
        else:
            found[name] = found.get(name, "") + " " + line.strip()
    return {key: " ".join(words.split()) for key, words in found.items()}


def questions(text):
    """Rows of the table: question, path, words of the answer."""
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if re.match(r"\| \d", line)]
    return [(question, links(PAGE, path), answer.strip('"')) for _, question, path, answer in rows]


def faults(question, path, answer, texts):
    """Faults of one row. `texts`: page -> text."""
    wrong = [] if path[0][0] == "README.md" else [f"{question} does not begin at README.md"]
    if len(path) - 1 > MOST_CLICKS:
        wrong.append(f"{question} takes {len(path) - 1} clicks")
    for page, section in path:
        if section not in sections(texts[page]):
            wrong.append(f"{question} {page} has no section {section}")
    for (page, section), (after, _) in zip(path, path[1:]):
        if after not in [target for target, _ in links(page, sections(texts[page]).get(section, ""))]:
            wrong.append(f"{question} {page}#{section} does not link {after}")
    page, section = path[-1]
    if answer not in sections(texts[page]).get(section, ""):
        wrong.append(f"{question} {page}#{section} does not have the words: {answer}")
    return wrong


class Newcomers(unittest.TestCase):
    def test_each_question_is_answered(self):
        rows = questions((PROJECT / PAGE).read_text(encoding="utf-8"))
        self.assertGreaterEqual(len(rows), 10)
        wrong = []
        for question, path, answer in rows:
            texts = {page: (PROJECT / page).read_text(encoding="utf-8") for page, _ in path}
            wrong += faults(question, path, answer, texts)
        self.assertEqual(wrong, [], "\n".join(wrong))

    def test_faults_are_found(self):
        texts = {"README.md": "# A\n[b](docs/index.md)\n## Z\n", "docs/index.md": "# B\n## C c\nIt\ndoes.\n## D\n[a](../README.md)"}
        path = [("README.md", "a"), ("docs/index.md", "c-c")]
        self.assertEqual(faults("Q?", path, "It does.", texts), [])
        for path, answer in ((path, "It does not."), ([("README.md", "z"), *path[1:]], "It does."), (path[1:], "It does."),
                             (path[:1] + [("docs/index.md", "e")], "")):
            self.assertEqual(len(faults("Q?", path, answer, texts)), 1, path)
        round_and_round = [path[0], ("docs/index.md", "d")] * 3
        self.assertEqual(faults("Q?", round_and_round, "[a]", texts), ["Q? takes 5 clicks"])

    def test_rows_are_read(self):
        text = "| no. | x |\n|---|---|\n| 1 | Why? | [a](../../README.md#a) → [b](../index.md) | \"So.\" |\n"
        self.assertEqual(questions(text), [("Why?", [("README.md", "a"), ("docs/index.md", "")], "So.")])


if __name__ == "__main__":
    unittest.main()
