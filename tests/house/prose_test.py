# SPDX-License-Identifier: MIT
"""The tutorials are easy to read: short sentences, plain words, a beginning that names the aim.

    python3 prose_test.py PROJECT

Looked at: docs/tutorial/*.md, without code blocks, tables, headings and comments.
Sentences: at most 25 words. A code span is one word. A link counts by its text, not by its target.
Words: none of FORBIDDEN.
Beginning: the first sentence starts with the words of BEGINNING.
"""

import pathlib
import re
import sys
import unittest

MOST_WORDS = 25
FORBIDDEN = ("tells", "told", "held against", "anew", "by itself")
BEGINNING = "At the end of this page the reader can"
SENTENCE_END = re.compile(r"(?<=[.!?])\s+")
LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")
ITEM = re.compile(r"^\s*(?:[-*]|\d+\.)\s+")


def paragraphs(page):
    """Prose of a page as (number of the first line, text), one per paragraph or item of a list."""
    found, first, lines, in_code = [], 0, [], False

    def close():
        if lines:
            found.append((first, " ".join(lines)))
            lines.clear()

    for number, text in enumerate(page.splitlines(), 1):
        if text.startswith("```"):
            in_code = not in_code
            close()
        elif in_code or not text.strip() or text.startswith(("#", "|", "<!--")):
            close()
        else:
            if ITEM.match(text):
                close()
            if not lines:
                first = number
            lines.append(ITEM.sub("", text).strip())
    close()
    return found


def sentences(text):
    """Sentences of a paragraph, links by their texts."""
    plain = LINK.sub(r"\1", text)
    return [part.strip() for part in SENTENCE_END.split(plain) if part.strip()]


def words(sentence):
    """How many words a sentence has: a code span is one, marks between blanks are none."""
    plain = re.sub(r"`[^`]*`", "code", sentence)
    return sum(1 for word in plain.split() if re.search(r"\w", word))


def faults(page):
    """The faults of a page."""
    wrong = []
    found = paragraphs(page)
    if not found or not found[0][1].startswith(BEGINNING):
        wrong.append(f"the first sentence begins with other words than `{BEGINNING}`")
    for number, text in found:
        for sentence in sentences(text):
            if words(sentence) > MOST_WORDS:
                wrong.append(f"line {number}: {words(sentence)} words, at most {MOST_WORDS}: {sentence}")
        plain = re.sub(r"`[^`]*`", "", LINK.sub(r"\1", text)).lower()
        wrong += [f"line {number}: the word `{word}`" for word in FORBIDDEN
                  if re.search(rf"\b{word}\b", plain)]
    return wrong


class TheProject(unittest.TestCase):
    project = None

    def test_tutorials_are_plain(self):
        pages = sorted((self.project / "docs/tutorial").glob("*.md"))
        self.assertTrue(pages, "no tutorial")
        for page in pages:
            self.assertEqual(faults(page.read_text(encoding="utf-8")), [], page.name)


class ThisTest(unittest.TestCase):
    """The checks above can fail."""

    GOOD = BEGINNING + " read.\n"

    def test_a_long_sentence_is_found(self):
        just, long = " ".join(["word"] * 25) + ".", " ".join(["word"] * 26) + "."
        self.assertEqual(faults(f"{self.GOOD}\n{just} {just.capitalize()}\n"), [])
        self.assertEqual(len(faults(f"{self.GOOD}\n{long}\n")), 1)
        self.assertEqual(len(faults(f"{self.GOOD}\nShort one.\n{long.capitalize()}\n")), 1)
        self.assertEqual(len(faults(f"{self.GOOD}\n- {just}\n- {long}\n")), 1)

    def test_code_tables_and_headings_are_left_out(self):
        long = " ".join(["told"] * 30)
        page = f"# {long}\n{self.GOOD}\n```\n{long}\n```\n| {long} |\n<!-- {long} -->\n`{long}` is code.\n"
        self.assertEqual(faults(page), [])

    def test_forbidden_words_are_found(self):
        for word in FORBIDDEN:
            self.assertEqual(len(faults(f"{self.GOOD}\nA thing {word} x.\n")), 1, word)
        self.assertEqual(faults(f"{self.GOOD}\nThe teller is toldless.\n"), [])

    def test_targets_of_links_do_not_count(self):
        self.assertEqual(sentences("See [the page](told.txt). Then ![a picture](b.png)."),
                         ["See the page.", "Then a picture."])
        self.assertEqual(words("`a b c` is 1.5 m - long"), 5)

    def test_a_beginning_without_an_aim_is_found(self):
        self.assertEqual(len(faults("This page is about meshes.\n")), 1)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    TheProject.project = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=sys.argv[:1])
