# SPDX-License-Identifier: MIT
"""Pages are easy to read: short sentences, plain words, a beginning that names the aim, few pages.

    python3 prose_test.py PROJECT            the test
    python3 prose_test.py PROJECT PAGE...    prints the faults of these pages, for writers

Looked at: docs/ without docs/lab and the generated pages, and the pages of TOP. Left out are code, headings and comments.
A page in old_pages.txt is not rewritten yet; the test fails when such a page has no fault, or is gone.

Sentences: at most 25 words each, at most 16 on average per page. A code span or a formula is one word, a link counts by
its text. None begins with a word of OPENINGS, none has a semicolon.
Words: none that FORBIDDEN or PATTERNS find, in tables neither.
Tables: each column has a heading, and a sentence stands before the table.
Beginning: the first sentence of a tutorial, how-to or reference page starts with one of BEGINNINGS.
Terms: a page in docs/ that uses one of TERMS has a link to that entry of the glossary.
The whole: at most 31 pages and 46 200 words, and the lab grows no further.
"""

import pathlib
import re
import sys
import unittest

MOST_WORDS, MOST_ON_AVERAGE = 25, 16
MOST_PAGES, MOST_WORDS_OF_ALL, MOST_WORDS_OF_LAB = 32, 47700, 40000
TOP = ("README.md", "CONTRIBUTING.md", "SECURITY.md", "THIRD_PARTY.md", "meshes/README.md")
# Written by docs/make_reference.py, which has rules of its own (help_test.py).
GENERATED = ("docs/reference/commands.md", "docs/reference/scene.md", "docs/reference/output.md")
FORBIDDEN = (
    "tells", "tell", "told", "says", "said", "asks", "asked", "held against", "held by", "anew", "by itself",
    "by themselves", "beside", "nobody", "whoever", "whatever", "mend", "mends", "mended", "nought", "per cent", "wanted",
    "not met", "now", "at first", "null band", "rung", "rungs", "unasked", "that which",
    "color", "colors", "behavior", "center", "centers", "centered", "neighbor", "neighbors", "gray", "analyze", "modeling")
OPENINGS = ("What", "Who", "Whoever", "Whose", "Whatever")
MONTH = "(?:January|February|March|April|May|June|July|August|September|October|November|December)"
PATTERNS = (
    ("a date", re.compile(rf"\b20\d\d-\d\d(?:-\d\d)?\b|\b\d{{1,2}} {MONTH}\b|\b{MONTH} 20\d\d\b")),
    ("a commit", re.compile(r"(?<![\w#-])(?=[0-9a-f]*[a-f])(?=[0-9a-f]*\d)[0-9a-f]{7,40}(?![\w-])")),
    ("a number without its leading zero", re.compile(r"(?:^|[\s(|=<>~±-])\.\d")),
    ("`us` for µs", re.compile(r"\d\s?us\b|\(us\)")),
    ("`a` for `per`", re.compile(r"\d[\w.,]*\s+(?!in |for |of |at |as |to |by |or |is )[\w/^µ]+\s+an?\s+(?:step|sub-step|frame|tetrahedron|piece|fan|second|element"
                                 r"|node|split|face|cell|body|iteration|vertex|minute|run|call)\b")),
)
TEST_PATH = re.compile(r"\b[\w/]*_test\.(?:cpp|py)\b")
BEGINNINGS = ("This page lets you ", "After this page you can ", "With this page you can ", "On this page you ",
              "This page shows you how ", "At the end of this page you can ", "At the end of this page the reader can ")
WITH_BEGINNING = ("docs/tutorial/", "docs/howto/", "docs/reference/")
TERMS = {"fan": r"fans?", "impact-window": r"impact windows?", "rubble": r"rubble", "activity-level": r"activity levels?",
         "oracle": r"oracles?", "numerical-noise-band": r"numerical-noise bands?"}
GLOSSARY = "docs/explanation/glossary.md"

SENTENCE_END = re.compile(r"(?<=[.!?])[)\"*_]*\s+")
LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")
CODE = re.compile(r"(`+)(?:(?!\1).)+\1")
FORMULA = re.compile(r"\$[^$]+\$")
ENTITY = re.compile(r"&#?\w+;")
ITEM = re.compile(r"^\s*(?:[-*]|\d+\.)\s+")
RULE = re.compile(r"^\s*\|?[\s:|-]*-[\s:|-]*$")


def parts(page):
    """A page as (kind, number of the first line, text): `prose`, one per paragraph or item of a list, and `row`, one
    per line of a table. Headings come as `heading`; code, formulas of their own lines, HTML and comments are left out."""
    found, lines, first, closing = [], [], 0, None

    def close():
        if lines:
            found.append(("prose", first, " ".join(lines)))
            lines.clear()

    for number, text in enumerate(page.splitlines(), 1):
        stripped = text.strip()
        if closing:
            if closing in stripped:
                closing = None
        elif stripped.startswith(("```", "$$", "<!--")):
            close()
            mark = "-->" if stripped.startswith("<!--") else stripped[: 3 if stripped[0] == "`" else 2]
            if mark not in stripped[len(mark):]:
                closing = mark
        elif not stripped or stripped.startswith("<"):
            close()
        elif stripped.startswith(("#", "|")):
            close()
            found.append(("heading" if stripped[0] == "#" else "row", number, stripped))
        else:
            if ITEM.match(text):
                close()
            if not lines:
                first = number
            lines.append(ITEM.sub("", text).strip().lstrip("> "))
    close()
    return found


def sentences(text):
    """Sentences of a paragraph, links by their texts."""
    plain = LINK.sub(r"\1", text)
    return [part.strip() for part in SENTENCE_END.split(plain) if part.strip()]


def words(sentence):
    """How many words a sentence has: a code span and a formula are one, marks between blanks are none."""
    plain = FORMULA.sub("formula", CODE.sub("code", sentence))
    return sum(1 for word in plain.split() if re.search(r"\w", word))


def all_words(page):
    """How many words a page has, code and tables too, the marks of tables not."""
    return sum(1 for word in page.split() if re.search(r"\w", word))


def without_code(text):
    return ENTITY.sub(" ", FORMULA.sub("formula", CODE.sub("code", LINK.sub(r"\1", text))))


def word_faults(text):
    """Forbidden words and patterns in a text, code apart."""
    plain = without_code(text)
    found = [f"the word `{word}`" for word in FORBIDDEN if re.search(rf"\b{word}\b", plain, re.IGNORECASE)]
    return found + [f"{what}: {match[0].strip()}" for what, pattern in PATTERNS if (match := pattern.search(plain))]


def sentence_faults(sentence):
    """Faults of one sentence: its length, its first word, a semicolon."""
    found = []
    if words(sentence) > MOST_WORDS:
        found.append(f"{words(sentence)} words, at most {MOST_WORDS}: {sentence}")
    if sentence.split()[0].strip("*_\"'(,") in OPENINGS:
        found.append(f"begins with {sentence.split()[0]}: {sentence}")
    if ";" in without_code(sentence):
        found.append(f"a semicolon: {sentence}")
    return found


def cells(row):
    """Cells of a line of a table; a bar in code or after a backslash is text."""
    plain = CODE.sub(lambda m: m[0].replace("|", "/"), row).replace("\\|", "/")
    return [cell.strip() for cell in plain.strip().strip("|").split("|")]


def table_faults(found):
    """Columns without a heading, and tables without a sentence before them."""
    wrong = []
    for place, (kind, number, text) in enumerate(found):
        if kind != "row" or not RULE.match(text) or place == 0 or found[place - 1][0] != "row":
            continue
        if "" in cells(found[place - 1][2]):
            wrong.append(f"line {number - 1}: a column of the table has no heading")
        if place < 2 or found[place - 2][0] != "prose":
            wrong.append(f"line {number - 1}: no sentence stands before the table")
    return wrong


def faults(page, name="docs/tutorial/a.md"):
    """The faults of a page: `line N: what`."""
    found = parts(page)
    prose = [(number, text) for kind, number, text in found if kind == "prose"]
    wrong = table_faults(found)
    if name.startswith(WITH_BEGINNING) and not (prose and prose[0][1].startswith(BEGINNINGS)):
        wrong.append(f"line {prose[0][0] if prose else 1}: the first sentence begins with none of "
                     + ", ".join(f"`{words.strip()}`" for words in BEGINNINGS))
    for number, text in prose:
        for sentence in sentences(text):
            wrong += [f"line {number}: {fault}" for fault in sentence_faults(sentence)]
    for kind, number, text in found:
        if kind == "heading":
            continue
        wrong += [f"line {number}: {fault}" for fault in word_faults(text)]
        if kind == "row" and not RULE.match(text):
            wrong += [f"line {number}: {words(sentence)} words in a cell: {sentence}" for cell in cells(text)
                      for sentence in sentences(cell) if words(sentence) > MOST_WORDS]
        if name.startswith("docs/") and (match := TEST_PATH.search(text)):
            wrong.append(f"line {number}: the path of a test: {match[0]}")
    lengths = [words(sentence) for _, text in prose for sentence in sentences(text)]
    if lengths and sum(lengths) > MOST_ON_AVERAGE * len(lengths):
        wrong.append(f"line 1: {sum(lengths) / len(lengths):.1f} words per sentence on average, at most {MOST_ON_AVERAGE}")
    if name.startswith("docs/") and name != GLOSSARY:
        plain = " ".join(without_code(text) for kind, _, text in found if kind != "heading")
        wrong += [f"line 1: `{term}` is used and {GLOSSARY}#{term} not linked" for term, pattern in TERMS.items()
                  if re.search(rf"\b{pattern}\b", plain, re.IGNORECASE) and f"glossary.md#{term})" not in page]
    return wrong


def pages(project):
    """The pages that are looked at, by their paths from the root."""
    found = [path.relative_to(project).as_posix() for path in sorted((project / "docs").rglob("*.md"))]
    found = [name for name in found if not name.startswith("docs/lab/") and name not in GENERATED]
    return found + [name for name in TOP if (project / name).is_file()]


def read_old(project):
    path = project / "tests/house/old_pages.txt"
    lines = path.read_text(encoding="utf-8").splitlines() if path.is_file() else []
    return [line.strip() for line in lines if line.strip() and not line.startswith("#")]


def wrong_pages(texts, old):
    """Pages with faults that are not in the list, and lines of the list that are not needed."""
    wrong = []
    for name, text in texts.items():
        found = faults(text, name)
        if name not in old:
            wrong += [f"{name}, {fault}" for fault in found]
        elif not found:
            wrong.append(f"old_pages.txt: {name} has no fault: take the line out")
    return wrong + [f"old_pages.txt: {name} is gone: take the line out" for name in old if name not in texts]


def too_much(count, words_of_all, words_of_lab):
    """Figures above the limits of the whole."""
    return [f"{what}: {number}, at most {most}" for what, number, most in
            (("pages", count, MOST_PAGES), ("words of all pages", words_of_all, MOST_WORDS_OF_ALL),
             ("words of the lab", words_of_lab, MOST_WORDS_OF_LAB)) if number > most]


class TheProject(unittest.TestCase):
    project = None

    @classmethod
    def setUpClass(cls):
        cls.texts = {name: (cls.project / name).read_text(encoding="utf-8") for name in pages(cls.project)}

    def test_pages_are_plain(self):
        wrong = wrong_pages(self.texts, read_old(self.project))
        self.assertEqual(wrong, [], "\n".join(wrong))

    def test_the_whole_is_small(self):
        lab = sum(all_words(path.read_text(encoding="utf-8")) for path in (self.project / "docs/lab").rglob("*.md"))
        self.assertEqual(too_much(len(self.texts), sum(map(all_words, self.texts.values())), lab), [])


class ThisTest(unittest.TestCase):
    """The checks above can fail."""

    GOOD = "This page lets you read. "
    SHORT = "One two. " * 40

    def expect(self, count, text, name="docs/tutorial/a.md"):
        found = faults(f"# Title\n\n{self.GOOD}{self.SHORT}\n\n{text}\n", name)
        self.assertEqual(len(found), count, f"{text}: {found}")

    def test_a_long_sentence_is_found(self):
        just, long = " ".join(["word"] * 25) + ".", " ".join(["word"] * 26) + "."
        self.expect(0, f"{just} {just.capitalize()}")
        self.expect(1, long)
        self.expect(1, f"Short one.\n{long.capitalize()}")
        self.expect(1, f"- {just}\n- {long}")
        self.expect(1, f"A line.\n\n| a | b |\n|---|---|\n| {just} | {long} |")

    def test_long_sentences_on_average_are_found(self):
        for length, count in ((16, 0), (17, 1)):
            page = "This page lets you " + "word " * (length - 4) + ". " + (" ".join(["word"] * length) + ". ") * 9
            self.assertEqual(len(faults(page)), count, length)

    def test_code_headings_formulas_and_html_are_left_out(self):
        long = "told; " * 30
        self.expect(0, f"## {long}\n```\n{long}\n```\n   ```sh\n   {long}\n   ```\n<!-- {long} -->\n`{long}` is code.")
        self.expect(0, f"$$\n{long}\n$$\n<img alt='{long}'>\n\n$$ {long} $$\n\nThe value ${long}$ is large.\n<!--\n{long}\n-->")

    def test_forbidden_words_are_found(self):
        for word in FORBIDDEN:
            self.expect(1, f"A thing {word} x.")
            self.expect(1, f"A line.\n\n| a | b |\n|---|---|\n| {word} | `x` |")
        self.expect(0, "The teller is toldless, `told` and [here](told.md).")

    def test_patterns_are_found(self):
        for text in ("On 2026-11-27 it ran.", "On 27 November it ran.", "In November 2026 it ran.", "Of 0c2fbd52 it is.",
                     "A value of .5 is (.5).", "It takes 3 us.", "It takes 0.66 ms a step.", "It has 39 bytes a tetrahedron.",
                     "See tests/house/prose_test.py here."):
            self.expect(1, text)
        self.expect(0, "In 2008 [Song 2008] took 0.5 and 1000000 of 3.10.5 in 3 µs and 0.66 ms per step, by deadbeef.")
        self.expect(0, "See tests/house/prose_test.py here.", "CONTRIBUTING.md")

    def test_openings_and_semicolons_are_found(self):
        self.expect(1, "What breaks is glass.")
        self.expect(1, "All is well. **Who** reads it.")
        self.expect(1, "All is well; nothing breaks.")
        self.expect(0, "Whatsoever `a; b` and a&nbsp;b are.")

    def test_tables_without_headings_or_captions_are_found(self):
        self.expect(1, "A line.\n\n| | b |\n|---|---|\n| x | y |")
        self.expect(1, "## Title\n\n| a | b |\n|---|---|\n| x | y |")
        self.expect(0, "A line.\n\n| a | `b|` |\n|---|---|\n| x |  |")

    def test_targets_of_links_do_not_count(self):
        self.assertEqual(sentences("See [the page](told.txt). Then ![a picture](b.png)."),
                         ["See the page.", "Then a picture."])
        self.assertEqual(words("`a b c` is 1.5 m - long"), 5)

    def test_a_beginning_without_an_aim_is_found(self):
        for name, count in (("docs/tutorial/a.md", 1), ("docs/howto/a.md", 1), ("docs/explanation/a.md", 0)):
            self.assertEqual(len(faults("This page is about meshes.\n", name)), count)

    def test_terms_without_a_link_are_found(self):
        self.expect(1, "Fans open.")
        self.expect(0, "A [fan](../explanation/glossary.md#fan) opens, and fans do.")
        self.expect(0, "Fans open.", "README.md")

    def test_the_list_of_old_pages_is_kept_short(self):
        good, bad = self.GOOD, "What is told.\n"
        self.assertEqual(wrong_pages({"docs/howto/a.md": good, "docs/b.md": bad}, ["docs/b.md"]), [])
        self.assertEqual(len(wrong_pages({"docs/howto/a.md": good}, ["docs/howto/a.md", "docs/gone.md"])), 2)
        self.assertEqual(len(wrong_pages({"docs/b.md": bad}, [])), 2)

    def test_too_much_is_found(self):
        self.assertEqual(too_much(MOST_PAGES, MOST_WORDS_OF_ALL, MOST_WORDS_OF_LAB), [])
        self.assertEqual(len(too_much(MOST_PAGES + 1, MOST_WORDS_OF_ALL + 1, MOST_WORDS_OF_LAB + 1)), 3)


def print_faults(project, names):
    """Prints the faults of pages as their writer wants them; returns how many."""
    count = 0
    for name in names:
        path = project / name
        for fault in faults(path.read_text(encoding="utf-8"), path.resolve().relative_to(project).as_posix()):
            print(f"{name}, {fault}")
            count += 1
    return count


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    TheProject.project = pathlib.Path(sys.argv[1]).resolve()
    if len(sys.argv) > 2:
        sys.exit(1 if print_faults(TheProject.project, sys.argv[2:]) else 0)
    unittest.main(argv=sys.argv[:1])
