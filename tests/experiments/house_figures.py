#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Figures of a checkout's house: sizes, and how many files a reader opens. Prints Markdown.

    python3 house_figures.py CHECKOUT [CHECKOUT ...]     one column of totals a checkout
    python3 house_figures.py --folders CHECKOUT          and a row a folder

Needs universal-ctags (Debian: universal-ctags), which finds functions and where they end.

How it counts
  lines       neither blank nor comment only, of C++ files
  functions   definitions from their first line to their closing brace, lambdas not apart
  call graph  an identifier before "(" in a function's body is a call of every function of that
              name in the same file, else of those that a header declares which the file includes,
              else of those that one declares which it leads to. Neither types nor overloads are
              looked at. Functions of one line (accessors) are left out.
  algorithm   files that hold the named function, its callees, and the callees of those that are in
              its own file: the files that a reader of the algorithm has to open
  JSON to VTU the shortest chains of calls from the command to each milestone, all functions on
              them counted once, and the files that hold them: the least that a reader passes
  leads to    project headers that a header includes, directly or not
"""

import argparse
import collections
import json
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

TOPS = ("topology", "mechanics", "fracture", "apps")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
CALL = re.compile(r"\b([A-Za-z_]\w*)\s*(?:<[\w:, ]*>\s*)?\(")
# Text that is not code to a reader: comments, strings, characters.
QUIET = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'',
                   re.DOTALL)

# Names in the order of preference: the first that the checkout defines is meant.
ALGORITHMS = (("1, deformation forces", ("deformation_forces",)),
              ("2, fitted motion", ("fit_motion",)),
              ("3, finding fractures", ("find_fractures",)),
              ("4, splitting a fan", ("split_fan",)))
START = ("run_run", "run_command", "run_scene", "add_run_command")
MILESTONES = (("read_scene",), ("build_simulation", "make_simulation"), ("advance_with_contact",),
              ("find_contacts",), ("solve_contacts",), ("predict",), ("step_floating_frame",),
              ("adopt",), ("find_fractures",), ("choose_fan",), ("split_fan",), ("split_face",),
              ("rebuild",), ("close_ledger",), ("choose_rungs",), ("approach",), ("write_vtu",))


def sources(root, tops=TOPS):
    return {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8")
            for top in tops for path in sorted((root / top).rglob("*.[ch]pp"))}


def code_only(text):
    """The text without comments, and with strings emptied; lines stay where they are."""
    def blank(match):
        found = match.group(0)
        kept = "\n" * found.count("\n")
        return kept if found.startswith(("//", "/*")) else '""' + kept
    return QUIET.sub(blank, text)


def code_lines(text):
    return sum(1 for line in code_only(text).split("\n") if line.strip())


def functions(root, files):
    """(name, file, first line, last line) of every function definition, and the headers in which
    each name is declared."""
    done = subprocess.run(["ctags", "--output-format=json", "--fields=+ne", "--c++-kinds=fp",
                           "--language-force=C++", "--sort=no", "-f", "-", *files], cwd=root,
                          capture_output=True, text=True, check=True)
    found, declared = [], collections.defaultdict(set)
    for line in done.stdout.splitlines():
        tag = json.loads(line)
        if tag.get("_type") != "tag" or tag["name"].startswith("__anon"):
            continue
        name = tag["name"].split("::")[-1]
        if tag["path"].endswith(".hpp"):
            declared[name].add(tag["path"])
        if tag["kind"] == "function" and "end" in tag:
            found.append((name, tag["path"], tag["line"], tag["end"]))
    return found, declared


def unit(file):
    """A header and its source are one."""
    return file.rsplit(".", 1)[0]


class House:
    """One checkout, read once."""

    def __init__(self, root):
        self.root = pathlib.Path(root).resolve()
        self.files = sources(self.root)
        self.functions, self.declared = functions(self.root, list(self.files))
        self.includes = {name: {t for t in INCLUDE.findall(text) if t in self.files}
                         for name, text in self.files.items()}
        self.defined = collections.defaultdict(list)
        for f in self.functions:
            if f[3] > f[2]:
                self.defined[f[0]].append(f)
        self.code = {name: code_only(text).split("\n") for name, text in self.files.items()}
        self.reached = {}

    def leads_to(self, file):
        """Headers that a file includes, directly or not; itself left out."""
        if file not in self.reached:
            seen, stack = set(), [file]
            while stack:
                for target in self.includes[stack.pop()] - seen - {file}:
                    seen.add(target)
                    stack.append(target)
            self.reached[file] = seen
        return self.reached[file]

    def meant(self, name, file):
        """Definitions that a call of `name` in `file` may mean, the nearest ones."""
        all_of_name = self.defined.get(name, [])
        here = [f for f in all_of_name if f[1] == file]
        headers = self.declared[name]
        if here or not headers & self.leads_to(file):
            return here
        found = set()
        for header in headers & self.includes[file] or headers & self.leads_to(file):
            at_home = [f for f in all_of_name if unit(f[1]) == unit(header)]
            found.update(at_home or [f for f in all_of_name if header in self.leads_to(f[1])])
        return sorted(found)

    def calls(self, function):
        name, file, first, last = function
        body = "\n".join(self.code[file][first - 1:last])
        body = body[body.find("{"):] if "{" in body else ""
        called = {f for word in set(CALL.findall(body)) for f in self.meant(word, file)}
        return called - {function}

    def one_of(self, names):
        """Definitions of the first of the names that has any, outside apps if there are such."""
        for name in names:
            if self.defined[name]:
                inner = [f for f in self.defined[name] if not f[1].startswith("apps/")]
                return inner or self.defined[name]
        return []

    def files_to_open(self, names):
        """Files of the definitions and of their callees; calls in the same file are followed."""
        opened, seen, stack = set(), set(), list(self.one_of(names))
        homes = {f[1] for f in stack}
        while stack:
            function = stack.pop()
            if function in seen:
                continue
            seen.add(function)
            opened.add(function[1])
            if function[1] in homes:
                stack += self.calls(function)
        return opened

    def chain(self, start, milestones):
        """Functions on the shortest chains of calls from `start` to each milestone."""
        parent = {f: None for f in self.one_of(start)}
        queue = collections.deque(parent)
        while queue:
            function = queue.popleft()
            for called in sorted(self.calls(function)):
                if called not in parent:
                    parent[called] = function
                    queue.append(called)
        on_chain, missed = set(), []
        for names in milestones:
            ends = [f for f in self.one_of(names) if f in parent]
            if not ends:
                missed.append(names[0])
                continue
            step = ends[0]
            while step is not None:
                on_chain.add(step)
                step = parent[step]
        return on_chain, missed

    def sizes(self, files):
        """Files, lines, largest file, lengths of functions: of the named files."""
        files = set(files)
        lengths = sorted(last - first + 1 for _, file, first, last in self.functions
                         if file in files) or [0]
        largest = max(files, key=lambda name: self.files[name].count("\n"))
        return {"files": len(files), "lines": sum(code_lines(self.files[f]) for f in files),
                "largest": self.files[largest].count("\n"), "largest_name": largest,
                "median": statistics.median_low(lengths),
                "p90": lengths[min(len(lengths) - 1, int(0.9 * len(lengths)))],
                "longest": lengths[-1]}


def folder_table(house):
    rows = ["| folder | files | lines | largest file | functions: median | 90 % | longest |",
            "|---|---|---|---|---|---|---|"]
    folders = collections.defaultdict(list)
    for name in house.files:
        folders[name.rsplit("/", 1)[0]].append(name)
    for folder, files in sorted(folders.items()):
        s = house.sizes(files)
        rows.append(f"| `{folder}` | {s['files']} | {s['lines']} | {s['largest']} | {s['median']} |"
                    f" {s['p90']} | {s['longest']} |")
    return rows


def total_rows(house):
    """(name, figure) of a whole checkout."""
    folders = collections.Counter(name.rsplit("/", 1)[0] for name in house.files)
    s = house.sizes(house.files)
    rows = [("C++ files outside tests", s["files"]), ("lines of them", s["lines"]),
            ("folders", len(folders)), ("most files in a folder", max(folders.values())),
            ("largest file", f"{s['largest']} ({pathlib.PurePosixPath(s['largest_name']).name})"),
            ("functions' lines: median, 90 %, longest",
             f"{s['median']}, {s['p90']}, {s['longest']}")]
    for title, names in ALGORITHMS:
        rows.append((f"files to open for algorithm {title}", len(house.files_to_open(names))))
    on_chain, missed = house.chain(START, MILESTONES)
    note = f", without {', '.join(missed)}" if missed else ""
    rows.append(("functions, files from scene JSON to VTU",
                 f"{len(on_chain)}, {len({f[1] for f in on_chain})}{note}"))
    for name in house.files:
        if name.endswith("/split_fan.hpp"):
            rows.append(("project headers that split_fan.hpp leads to", len(house.leads_to(name))))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("checkout", nargs="+", type=pathlib.Path)
    parser.add_argument("--folders", action="store_true", help="a row a folder too")
    parser.add_argument("--names", action="store_true", help="name the files and functions counted")
    given = parser.parse_args()
    if not shutil.which("ctags") or "Universal" not in subprocess.run(
            ["ctags", "--version"], capture_output=True, text=True).stdout:
        sys.exit("house_figures.py: universal-ctags is needed (Debian: apt install universal-ctags)")
    houses = [House(root) for root in given.checkout]
    columns = [total_rows(house) for house in houses]
    print("| | " + " | ".join(str(root) for root in given.checkout) + " |")
    print("|---" * (len(houses) + 1) + "|")
    for rows in zip(*columns):
        print(f"| {rows[0][0]} | " + " | ".join(str(figure) for _, figure in rows) + " |")
    for house in houses:
        if given.folders:
            print(f"\n{house.root}\n")
            print("\n".join(folder_table(house)))
        if given.names:
            print(f"\n{house.root}\n")
            for title, names in ALGORITHMS:
                print(f"algorithm {title}:", *sorted(house.files_to_open(names)))
            for name, file, first, _ in sorted(house.chain(START, MILESTONES)[0],
                                               key=lambda f: (f[1], f[2])):
                print(f"  {file}:{first} {name}")


if __name__ == "__main__":
    main()
