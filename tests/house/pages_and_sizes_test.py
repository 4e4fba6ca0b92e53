# SPDX-License-Identifier: MIT
"""Cited pages are there, every header is tested or says where, and nothing grows too big.

    python3 pages_and_sizes_test.py PROJECT

Documents: every name that ends in .md, in a C++ file or a script, is a file of the project: from
its root, from the folder of the file that cites it, in docs/ or in docs/reference.
Headers: each has a test of its own name (tests/**/NAME_test.cpp) or a line in untested_headers.txt.
Sizes: a C++ file has at most 400 lines and a folder 25 C++ files, or a line in large.txt.
Faults: the text that one of tests/mutants/*.json changes stands once in its source.
Both lists are of lines `path: words`; a line that is no longer needed fails the test.
"""

import json
import pathlib
import re
import sys
import tempfile
import unittest

from rooms import sources

HERE = pathlib.Path(__file__).resolve().parent
MOST_LINES, MOST_FILES = 400, 25
CITED = re.compile(r"(?<![\w./-])[\w./-]*[\w-]\.md\b")
SOURCE = re.compile(r"(?<![\w./-])[a-z][\w-]*/[\w./-]*\.(?:hpp|cpp|py)\b")
TEST = re.compile(r"tests/[\w./-]+_test\.(?:cpp|py)")


def scripts(project):
    """Python and CMake files of the project, by their paths from the root."""
    found = {}
    for top in ("topology", "mechanics", "fracture", "apps", "tests", "meshes", "docs"):
        for pattern in ("*.py", "CMakeLists.txt"):
            for path in sorted((project / top).rglob(pattern)):
                found[path.relative_to(project).as_posix()] = path.read_text(encoding="utf-8")
    return found


def missing_documents(project, texts, written=()):
    """Names of documents that are nowhere. `written`: names that programs write or tests make up."""
    missing = []
    for name, text in texts.items():
        for cited in sorted(set(CITED.findall(text)) - set(written)):
            # In code a path may begin with that of a folder of the project.
            inner = re.sub(r"^(\.\.|/)+", "", cited)
            places = (project / inner, (project / name).parent / cited,
                      project / "docs" / cited, project / "docs/reference" / cited)
            if not any(place.is_file() for place in places):
                missing.append(f"{name} cites {cited}")
    return missing


def pages(project):
    """The project's documents, by their paths from the root."""
    found = {}
    for path in (*project.glob("*.md"), *(project / "docs").rglob("*.md"),
                 *(project / "meshes").rglob("*.md")):
        found[path.relative_to(project).as_posix()] = path.read_text(encoding="utf-8")
    return found


def missing_sources(pages, exists):
    """Sources that pages cite and that are not there. CHANGELOG.md speaks of the past,
    <sunder/...> of headers that the build makes, and out/... of files that commands write: none is looked at."""
    return [f"{name} cites {cited}" for name, text in pages.items() if name != "CHANGELOG.md"
            for cited in sorted(set(SOURCE.findall(text)))
            if not (cited.startswith(("sunder/", "out/")) or exists(cited) or exists(f"tests/{cited}"))]


def read_list(text):
    """Lines `path: words` as a dictionary, and a list of the other lines."""
    entries, bad = {}, []
    for line in text.splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        path, mark, words = line.partition(": ")
        if not mark or not words.strip() or path in entries:
            bad.append(line)
        else:
            entries[path] = words.strip()
    return entries, bad


def untested_headers(files, entries, exists):
    """Faults of headers and of the list of those without a test of their own name.
    `exists(path)`: whether a file of the project is there."""
    tested = {pathlib.PurePosixPath(f).name.removesuffix("_test.cpp")
              for f in files if f.startswith("tests/") and f.endswith("_test.cpp")}
    headers = {f for f in files if f.endswith(".hpp") and not f.startswith("tests/")}
    has_test = {h for h in headers if pathlib.PurePosixPath(h).stem in tested}
    wrong = [f"{h} has neither a test of its name nor a reason in untested_headers.txt"
             for h in sorted(headers - has_test - set(entries))]
    for path, words in entries.items():
        if path not in headers:
            wrong.append(f"untested_headers.txt: {path} is gone")
        elif path in has_test:
            wrong.append(f"untested_headers.txt: {path} has a test now")
        named = TEST.findall(words)
        if not named:
            wrong.append(f"untested_headers.txt: {path} names no test")
        wrong += [f"untested_headers.txt: {path} names {t}, which is not there"
                  for t in named if not exists(t)]
    return wrong


def faults_without_a_place(entries, text_of):
    """Faults chosen by hand (tests/mutants/*.json) with a text that is not once in its source."""
    return [f"{e['file']}: {e['find']}" for e in entries if text_of(e["file"]).count(e["find"]) != 1]


def too_large(files, entries):
    """Files and folders above the limits that the list does not excuse, and excuses not needed."""
    large = {name: f"{text.count(chr(10))} lines" for name, text in files.items()
             if text.count("\n") > MOST_LINES}
    count = {}
    for name in files:
        folder = name.rsplit("/", 1)[0]
        count[folder] = count.get(folder, 0) + 1
    large |= {folder: f"{n} C++ files" for folder, n in count.items() if n > MOST_FILES}
    wrong = [f"{name} has {size}" for name, size in large.items() if name not in entries]
    wrong += [f"large.txt: {name} is within the limits or gone"
              for name in entries if name not in large]
    return wrong


class TheProject(unittest.TestCase):
    project = None

    @classmethod
    def setUpClass(cls):
        cls.files = sources(cls.project)

    def entries(self, name):
        entries, bad = read_list((HERE / name).read_text(encoding="utf-8"))
        self.assertEqual(bad, [], f"{name}: lines are `path: words`, a path once")
        return entries

    def test_cited_documents_are_there(self):
        # Written by `bench paper --markdown`, the scripts of conversions and `suite --export`.
        written = ("paper.md", "p.md", "PAGE.md", "page.md", "suite.md")
        texts = self.files | scripts(self.project)
        # These make up names, and name pages as the site has them.
        for name in ("tests/house/pages_and_sizes_test.py", "tests/house/prose_test.py",
                     "tests/house/figures_test.py", "tests/docs/site_test.py",
                     "docs/site/make_site.py"):
            texts.pop(name)
        self.assertEqual(missing_documents(self.project, texts, written), [])

    def test_sources_that_pages_cite_are_there(self):
        self.assertEqual(missing_sources(pages(self.project),
                                         lambda path: (self.project / path).is_file()), [])

    def test_headers_are_tested(self):
        wrong = untested_headers(self.files, self.entries("untested_headers.txt"),
                                 lambda path: (self.project / path).is_file())
        self.assertEqual(wrong, [])

    def test_names_of_tests_reach_ctest(self):
        """CTest takes a name with `;` for a list, and one that begins with `-` for an option: nothing is run then."""
        bad = [f"{path}: {name}" for path, text in self.files.items()
               for name in re.findall(r'TEST_CASE\(\s*"((?:[^"\\]|\\.)*)"', text)
               if ";" in name or name.startswith("-")]
        self.assertEqual(bad, [])

    def test_faults_by_hand_fit_the_sources(self):
        for path in sorted((self.project / "tests/mutants").glob("*.json")):
            entries = json.loads(path.read_text(encoding="utf-8"))
            wrong = faults_without_a_place(entries, lambda f: (self.project / f).read_text(encoding="utf-8"))
            self.assertEqual(wrong, [], path.name)

    def test_files_and_folders_are_small(self):
        self.assertEqual(too_large(self.files, self.entries("large.txt")), [])


class ThisTest(unittest.TestCase):
    """The checks above can fail."""

    def test_a_missing_document_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            project = pathlib.Path(folder)
            for path in ("docs/here.md", "meshes/README.md", "a/NOTE.md"):
                (project / path).parent.mkdir(exist_ok=True)
                (project / path).touch()
            texts = {"a/b.hpp": "// (docs/here.md, here.md; meshes/README.md, NOTE.md) x.mdl",
                     "a/c.cpp": "// see design.md and docs/gone.md.",
                     "a/d.cpp": '"written.md"'}
            self.assertEqual(missing_documents(project, texts, ("written.md",)),
                             ["a/c.cpp cites design.md", "a/c.cpp cites docs/gone.md"])

    def test_a_missing_source_is_found(self):
        texts = {"docs/a.md": "`tests/a_test.cpp`, x/c_test.cpp, kernel.hpp; ../x/y.hpp, apps/b.hpp, out/d.py",
                 "CHANGELOG.md": "apps/gone.hpp"}
        there = {"tests/a_test.cpp", "tests/x/c_test.cpp"}
        self.assertEqual(missing_sources(texts, there.__contains__),
                         ["docs/a.md cites apps/b.hpp"])

    def test_an_untested_header_and_stale_lines_are_found(self):
        files = {"a/tested.hpp": "", "a/excused.hpp": "", "a/bare.hpp": "",
                 "tests/a/tested_test.cpp": "", "tests/a/other_test.cpp": "", "tests/a/own.hpp": ""}
        entries = {"a/excused.hpp": "tests/a/other_test.cpp, plain data"}
        self.assertEqual(len(untested_headers(files, entries, files.__contains__)), 1)
        entries["a/bare.hpp"] = "tests/a/gone_test.cpp, plain data"
        entries["a/tested.hpp"] = "tests/a/other_test.cpp"
        entries["a/gone.hpp"] = "tests/a/other_test.cpp"
        wrong = untested_headers(files, entries, files.__contains__)
        self.assertEqual(wrong, ["untested_headers.txt: a/bare.hpp names tests/a/gone_test.cpp, "
                                 "which is not there",
                                 "untested_headers.txt: a/tested.hpp has a test now",
                                 "untested_headers.txt: a/gone.hpp is gone"])
        self.assertIn("untested_headers.txt: a/bare.hpp names no test",
                      untested_headers(files, {"a/bare.hpp": "obvious"}, files.__contains__))

    def test_what_is_too_large_is_found(self):
        files = {f"a/{i}.cpp": "" for i in range(MOST_FILES + 1)}
        files["b/long.cpp"] = "\n" * (MOST_LINES + 1)
        files["b/just.cpp"] = "\n" * MOST_LINES
        self.assertEqual(len(too_large(files, {})), 2)
        self.assertEqual(too_large(files, {"a": "why", "b/long.cpp": "why"}), [])
        self.assertEqual(len(too_large(files, {"a": "", "b/long.cpp": "", "b/just.cpp": ""})), 1)

    def test_a_fault_without_a_place_is_found(self):
        faults = [{"file": "a", "find": "b + c"}, {"file": "a", "find": "d"}, {"file": "a", "find": "e"}]
        self.assertEqual(faults_without_a_place(faults, {"a": "b + c; d; d;"}.get), ["a: d", "a: e"])

    def test_lists_are_read(self):
        self.assertEqual(read_list("# words\n\na/b.hpp: why not\n"), ({"a/b.hpp": "why not"}, []))
        self.assertEqual(read_list("a: b\na: c\nno words\n")[1], ["a: c", "no words"])


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    TheProject.project = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=sys.argv[:1])
