# SPDX-License-Identifier: MIT
"""The program's own texts keep the rules of the pages (tests/house/prose_test.py).

    python3 help_test.py SUNDER

Looked at: --help of every command, the descriptions of `sunder run --schema`, the meanings of `sunder run --columns`, and
the reasons that `sunder run --verbose` prints. At most 25 words per sentence, and none of the forbidden words. A text
after an option or a key is a cell: there a semicolon ends a sentence. In other text no semicolon stands.
"""

import json
import pathlib
import re
import sys
import tempfile
import unittest

PROJECT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "docs"), str(PROJECT / "tests/house")]
import make_reference  # noqa: E402
import prose_test  # noqa: E402

# Names of options and files, and lists of values, are code.
CODE = re.compile(r"--?[a-z][\w-]*(?:[ =][A-Z]+)?|\b[\w.]*_[\w.]*|\b[\w.-]*/[\w./*-]*\w|\"[^\"]*\"|\b[A-Z]{2,}(?:[.,_][A-Z]+)*\b")


def cell_faults(text):
    """Faults of a text after an option or a key."""
    found = prose_test.word_faults(text)
    for part in re.split(r"[.;:]\s+", text):
        found += [fault for fault in prose_test.sentence_faults(part) if "semicolon" not in fault]
    return found


def footer_faults(text):
    """Faults of the text below the options, lists and examples left out."""
    found, paragraph = [], []
    text = text.partition("\nExamples:")[0]
    for line in [*text.splitlines(), ""]:
        if line.startswith("  "):
            found += prose_test.word_faults(line)
        elif line:
            paragraph.append(line)
        if (not line or line.endswith(":")) and paragraph:
            whole = CODE.sub("`code`", " ".join(paragraph))
            if not whole.startswith("Exit codes:"):  # a list
                for sentence in prose_test.sentences(whole):
                    found += prose_test.sentence_faults(sentence)
            found += prose_test.word_faults(whole)
            paragraph = []
    return found


def help_texts(sunder):
    """Each command with the parts of its help."""
    found, waiting = {}, [()]
    while waiting:
        words = waiting.pop()
        shown = make_reference.Help(make_reference.run(sunder, *words, "--help"))
        found[" ".join(words)] = shown
        for heading, rows in shown.groups:
            if not words and heading not in ("Options", "Positionals") or heading == "Subcommands":
                waiting += [(*words, name) for name, _ in rows]
    return found


def descriptions(schema, path=""):
    """Each key of a schema with its description."""
    if "description" in schema:
        yield path, schema["description"]
    for key, value in schema.get("properties", {}).items():
        yield from descriptions(value, f"{path}.{key}")
    if isinstance(schema.get("items"), dict):
        yield from descriptions(schema["items"], path + "[]")


class Texts(unittest.TestCase):
    sunder = None

    def test_help(self):
        wrong = []
        for name, shown in help_texts(self.sunder).items():
            rows = [(names, text) for _, group in shown.groups for names, text in group]
            for where, text in (("summary", shown.summary), *rows):
                wrong += [f"sunder {name} --help, {where}: {fault}" for fault in cell_faults(text)]
            wrong += [f"sunder {name} --help, footer: {fault}" for fault in footer_faults(shown.footer)]
        self.assertEqual(wrong, [], "\n".join(wrong))

    def test_schema(self):
        schema = json.loads(make_reference.run(self.sunder, "run", "--schema"))
        wrong = [f"{path}: {fault}" for path, text in descriptions(schema) for fault in cell_faults(text)]
        self.assertEqual(wrong, [], "\n".join(wrong))

    def test_columns(self):
        files = json.loads(make_reference.run(self.sunder, "run", "--columns"))
        wrong = [f"{one['file']} {column['name']}: {fault}" for one in files for column in one["columns"]
                 for fault in cell_faults(column["meaning"])]
        self.assertEqual(wrong, [], "\n".join(wrong))

    def test_reasons_of_chosen_settings(self):
        wrong = []
        with tempfile.TemporaryDirectory() as folder:
            for accuracy in ("preview", "good", "reference"):
                report = json.loads(make_reference.run(
                    self.sunder, "run", PROJECT / "meshes/scenes/ball.json", "-o", f"{folder}/{accuracy}", "--json", "--quiet",
                    "--set", f"accuracy={accuracy}", "--set", "duration=1e-4", "--frames", "0"))
                chosen = report["settings"]["chosen"]
                self.assertGreater(len(chosen), 5)
                wrong += [f"{accuracy}, {one['key']}: {fault}" for one in chosen for fault in cell_faults(one["reason"])]
        self.assertEqual(wrong, [], "\n".join(wrong))

    def test_groups_and_moods(self):
        """Commands stand in groups, and the summary of each begins with a verb in the imperative."""
        program = help_texts(self.sunder)
        groups = [heading for heading, _ in program[""].groups if heading not in ("Options", "Positionals")]
        self.assertGreater(len(groups), 3)
        for name, shown in program.items():
            self.assertNotRegex(shown.summary, r"^[A-Z]\w+s\b", f"sunder {name}: a verb in the imperative begins it")


class ThisTest(unittest.TestCase):
    """The checks above can fail."""

    def test_faults_are_found(self):
        long = " ".join(["word"] * 26)
        self.assertEqual(len(cell_faults(long)), 1)
        self.assertEqual(len(cell_faults("It tells it")), 1)
        self.assertEqual(cell_faults("Folder; default: out/ and the name"), [])
        self.assertEqual(len(footer_faults(f"{long}.\n\nExit codes: {long}")), 1)
        self.assertEqual(len(footer_faults("All is well; nothing breaks.")), 1)
        self.assertEqual(len(footer_faults("Files:\n  a.csv  what somebody asked")), 1)
        self.assertEqual(footer_faults(f"Fine.\n\nExamples:\n  told {long}"), [])


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    Texts.sunder = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=sys.argv[:1])
