#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Builds the site from the project's pages: build/docs/html/index.html.

    docs/site/make_site.py [--out build/docs] [--page FOLDER]

Needs sphinx, MyST, furo, sphinx-copybutton, breathe, doxygen, cmake and KaTeX, all of them Debian packages that
`./bootstrap docs` installs. Pages are those of docs/ and the README files; a page of the API comes from each public header.
--page: the built page of the simulator (docs/howto/embed.md); default: build/wasm/page, else build/page, where it is there.

Warnings of Sphinx are errors. Each link to a file of the site, and each anchor, is checked in the HTML.
Exit codes: 0 done, 1 a page or link is wrong, 2 usage, 77 a program is missing.
"""

import argparse
import html.parser
import os
import pathlib
import posixpath
import re
import shutil
import subprocess
import sys
import urllib.parse

PROJECT = pathlib.Path(__file__).resolve().parents[2]
SITE = PROJECT / "docs/site"
KATEX = pathlib.Path("/usr/share/javascript/katex")
PYTHON = "/usr/bin/python3"  # Debian's, which has Debian's packages
MODULES = ("sphinx", "myst_parser", "furo", "sphinx_copybutton", "breathe")
# Pages outside docs/, and where they are in the site.
OTHER_PAGES = {"README.md": "project/readme.md", "CONTRIBUTING.md": "project/contributing.md",
               "SECURITY.md": "project/security.md", "THIRD_PARTY.md": "project/third_party.md",
               "CHANGELOG.md": "project/changelog.md", "meshes/README.md": "project/meshes.md",
               "meshes/scenes/README.md": "project/scenes.md", "meshes/suite/README.md": "project/suite.md",
               "tests/README.md": "project/tests.md", "tests/mutants/README.md": "project/mutants.md",
               "tests/experiments/io/README.md": "project/conversions.md",
               "tests/topology/io/data/README.md": "project/mesh_file_data.md"}
SECTIONS = (("Start", ""), ("Tutorials", "tutorial/"), ("How-to guides", "howto/"), ("Reference", "reference/"),
            ("Explanation", "explanation/"), ("API", "api/"), ("Project", "project/"), ("Lab notebook", "lab/"))
LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\]\()([^()\s]+)((?:\s+\"[^\"]*\")?\))")
ATTRIBUTE = re.compile(r"\b(src|href|srcset|poster)=\"([^\"]+)\"")
CODE = re.compile(r"^\s*```.*?^\s*```[^\n]*$|(`+)(?:(?!\1)[^\n])+\1", re.DOTALL | re.MULTILINE)


def missing_programs():
    found = [name for name in ("sphinx-build", "doxygen", "cmake", "dot") if not shutil.which(name)]
    if not (KATEX / "katex.min.js").is_file():
        found.append("libjs-katex")
    done = subprocess.run([PYTHON, "-c", "import " + ", ".join(MODULES)], capture_output=True, check=False) \
        if pathlib.Path(PYTHON).exists() else None
    return found + ([] if done and done.returncode == 0 else ["one of the modules " + ", ".join(MODULES)])


class Pages:
    """The pages of the project, staged for Sphinx."""

    def __init__(self, source, extra):
        self.source, self.extra, self.wrong = source, extra, []
        self.places = {path.relative_to(PROJECT).as_posix(): path.relative_to(PROJECT / "docs").as_posix()
                       for path in sorted((PROJECT / "docs").rglob("*.md"))}
        self.places |= {name: place for name, place in OTHER_PAGES.items() if (PROJECT / name).is_file()}

    def target(self, page, link, in_html):
        """A link of a page as one of the staged page; None where nothing of the site is meant."""
        path, mark, anchor = link.partition("#")
        if "://" in link or link.startswith(("mailto:", "#")) or not path:
            return link
        name = posixpath.normpath(posixpath.join(posixpath.dirname(page), urllib.parse.unquote(path)))
        here = posixpath.dirname(self.places[page])
        if name in self.places:
            place = self.places[name]
            if in_html:
                place = place.removesuffix(".md") + ".html"
            return posixpath.relpath(place, here or ".") + mark + anchor
        if (PROJECT / name).is_dir():
            return None
        if not (PROJECT / name).is_file():
            self.wrong.append(f"{page}: {link} is no file")
            return None
        place = "files/" + name
        copy = (self.extra if in_html else self.source) / place
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(PROJECT / name, copy)
        return posixpath.relpath(place, here or ".")

    def staged(self, page, text):
        """The text of a page with links as the staged page has them."""
        def link(match):
            target = self.target(page, match[2], in_html=False)
            if target is None:  # a folder: its words alone
                return match[1].lstrip("!")[1:-2]
            return match[1] + target + match[3]

        def attribute(match):
            target = self.target(page, match[2], in_html=True)
            return f'{match[1]}="{target}"' if target else match[0]

        # Code is put aside, for links in code and for code in links.
        aside = []

        def put_aside(code):
            aside.append(code[0])
            return f"\0{len(aside) - 1}\0"

        text = ATTRIBUTE.sub(attribute, LINK.sub(link, CODE.sub(put_aside, text)))
        return re.sub(r"\0(\d+)\0", lambda match: aside[int(match[1])], text)

    def write(self):
        for page, place in self.places.items():
            out = self.source / place
            out.parent.mkdir(parents=True, exist_ok=True)
            text = (PROJECT / page).read_text(encoding="utf-8")
            out.write_text(self.staged(page, text), encoding="utf-8")

    def toctree(self, more):
        """The hidden list of all pages, in the order in which index.md links them."""
        index = self.source / "index.md"
        text = index.read_text(encoding="utf-8")
        linked = [match[2].partition("#")[0] for match in LINK.finditer(text)]
        names = [name for name in (*self.places.values(), *more) if name != "index.md"]
        order = {name: (linked.index(name) if name in linked else len(linked), name) for name in names}
        order["api/headers.md"] = (0, "")
        blocks = []
        for caption, folder in SECTIONS:
            chosen = sorted((name for name in names if name.startswith(folder) and (folder or "/" not in name)),
                            key=order.get)
            if chosen:
                blocks += ["```{toctree}", ":hidden:", f":caption: {caption}", "", *(name[:-3] for name in chosen), "```", ""]
        index.write_text(text + "\n" + "\n".join(blocks), encoding="utf-8")


def doors():
    """The public headers, each with its subject."""
    text = (PROJECT / "apps/library/doors.cmake").read_text(encoding="utf-8")
    return re.findall(r'^door\((\w+) "([^"]+)"', text, re.MULTILINE)


# Code in headers that Sphinx 5 takes for an error, and its replacement.
FOR_SPHINX = (
    # The same namespace on several pages; each page names it.
    (r"^(?:namespace sunder \{|\}  // namespace sunder)$", ""),
    # Guides for template arguments, as functions with the name of their class.
    (r"^template <[^\n]*>\n\w+\([^;]*\) -> [^;]*;$", ""),
    (r" = \[\] \{.*?^\}\(\);$", ";"),
    # C: a struct and its name of its own.
    (r"^typedef struct (\w+) \1;$", ""),
    (r"^typedef (struct|enum) (\w+) \{(.*?)^\} \2;$", r"\1 \2 {\3};"),
)


def for_sphinx(header):
    """A header without the code that Sphinx cannot read."""
    for pattern, text in FOR_SPHINX:
        header = re.sub(pattern, text, header, flags=re.MULTILINE | re.DOTALL)
    return header


def list_of_headers(folder):
    """The page of all public headers, with a graph of their includes."""
    rows, arrows = [], []
    for name, about in doors():
        rows.append(f"| [`<sunder/{name}.hpp>`]({name}.md) | {about} |")
        includes = re.findall(r"#include <sunder/(\w+)\.hpp>", (folder / f"{name}.hpp").read_text(encoding="utf-8"))
        arrows += [f"  {name} -> {one};" for one in includes]
    graph = ["```{graphviz}", "digraph headers {", "  rankdir=BT;", "  node [shape=box, fontname=\"sans-serif\"];", *arrows, "}", "```"]
    return "\n".join(["# Public headers", "", "This page lets you find the header for a task. The C functions are in "
                      "[`sunder.h`](sunder.md).", "", "| header | content |", "|---|---|", *rows, "",
                      "An arrow leads from a header to one that it includes:", "", *graph, ""])


def write_api(source, out):
    """A page per public header, from doxygen's XML. Returns their names and the folder of the XML."""
    headers, xml = out / "headers", out / "doxygen"
    subprocess.run(["cmake", "-D", f"SOURCE={PROJECT}", "-D", f"OUTPUT={headers}", "-D", "FLAGS=-",
                    "-P", PROJECT / "apps/library/make_doors.cmake"], check=True)
    shutil.copyfile(PROJECT / "apps/host/sunder.h", headers / "sunder/sunder.h")
    for header in (headers / "sunder").iterdir():
        header.write_text(for_sphinx(header.read_text(encoding="utf-8")), encoding="utf-8")
    settings = {"INPUT": headers / "sunder", "OUTPUT_DIRECTORY": xml, "GENERATE_HTML": "NO", "GENERATE_LATEX": "NO",
                "GENERATE_XML": "YES", "XML_PROGRAMLISTING": "NO", "EXTRACT_ALL": "YES", "QUIET": "YES", "WARNINGS": "NO",
                "MARKDOWN_SUPPORT": "YES", "AUTOLINK_SUPPORT": "NO", "STRIP_FROM_PATH": headers,
                "FILE_PATTERNS": "*.hpp *.h", "MACRO_EXPANSION": "YES", "EXTENSION_MAPPING": "h=C++",
                "EXCLUDE_SYMBOLS": "counters_of"}
    xml.mkdir(exist_ok=True)
    (out / "Doxyfile").write_text("".join(f"{key} = {value}\n" for key, value in settings.items()))
    subprocess.run(["doxygen", out / "Doxyfile"], check=True)
    (source / "api").mkdir()
    pages = ["api/headers.md"]
    (source / pages[0]).write_text(list_of_headers(headers / "sunder"))
    for name, about in [*doors(), ("sunder.h", "C functions over an engine, for hosts in other languages.")]:
        file = name if name.endswith(".h") else f"{name}.hpp"
        title = file if name.endswith(".h") else f"&lt;sunder/{file}&gt;"
        space = "" if name.endswith(".h") else " All names are in the namespace `sunder`."
        pages.append(f"api/{name.removesuffix('.h')}.md")
        (source / pages[-1]).write_text(f"# {title}\n\n{about}{space}\n\n```{{doxygenfile}} {file}\n:project: sunder\n```\n")
    return pages, xml / "xml"


def write_live(source, extra, page):
    """The page of the live simulator, and the simulator where it is built."""
    if page:
        shutil.copytree(page, extra / "live", dirs_exist_ok=True)
        text = ('<p><a class="reference external" href="live/index.html">Start the simulator</a></p>\n\n'
                "The page loads about 1 MB. Choose a scene at the top left, and press the space bar to start it.\n")
    else:
        text = "This copy of the site has no simulator. `cmake --preset wasm` builds it.\n"
    (source / "live.md").write_text("# The simulator in your browser\n\nThis page lets you break a body in the browser, without "
                                    f"any install.\n\n{text}")


class Links(html.parser.HTMLParser):
    """The anchors and links of a page of HTML."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            elif name in ("href", "src", "poster") and value:
                self.links.append(value)


def broken_links(html_folder):
    """Links of the site to files and anchors that are not there. Files below live/ are not ours."""
    pages = {path: Links(path.read_text(encoding="utf-8")) for path in html_folder.rglob("*.html")
             if "live" not in path.relative_to(html_folder).parts[:-1]}
    wrong = []
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            name = f"{path.relative_to(html_folder)}: {link}"
            if not target.is_file():
                wrong.append(f"{name}: no such file")
            elif parts.fragment and target in pages and urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                wrong.append(f"{name}: no such anchor")
    return sorted(set(wrong))


def build(out, page):
    """Builds the site; returns the faults."""
    source, extra, result = out / "source", out / "extra", out / "html"
    for folder in (source, extra, out / "static"):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
    shutil.copytree(KATEX, out / "static/katex", ignore=shutil.ignore_patterns("*.mjs", "*.ttf", "katex.js", "katex.css"))
    pages = Pages(source, extra)
    pages.write()
    api, xml = write_api(source, out)
    write_live(source, extra, page)
    pages.toctree([*api, "live.md"])
    if pages.wrong:
        return pages.wrong
    shutil.rmtree(result, ignore_errors=True)
    environment = os.environ | {"SUNDER_DOXYGEN": str(xml), "SUNDER_EXTRA": str(extra), "SUNDER_STATIC": str(out / "static")}
    done = subprocess.run(["sphinx-build", "-b", "html", "-q", "-W", "--keep-going", "-c", SITE,
                           "-d", out / "doctrees", source, result], env=environment, check=False)
    return broken_links(result) if done.returncode == 0 else ["Sphinx warned, see above"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=PROJECT / "build/docs")
    parser.add_argument("--page", type=pathlib.Path)
    arguments = parser.parse_args()
    if missing := missing_programs():
        print("skipped: not installed: " + ", ".join(missing) + " (./bootstrap docs installs all)", file=sys.stderr)
        return 77
    built = [path for path in (PROJECT / "build/wasm/page", PROJECT / "build/page") if (path / "index.html").is_file()]
    wrong = build(arguments.out.resolve(), arguments.page or (built[0] if built else None))
    for text in wrong:
        print(f"error: {text}", file=sys.stderr)
    if not wrong:
        print(arguments.out / "html/index.html")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
