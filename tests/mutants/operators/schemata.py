# SPDX-License-Identifier: MIT
"""Puts every mutant of the operators (operators.py) into a copy of the sources, each behind a switch.

    python3 schemata.py PROJECT OUT

OUT/topology/... are the copies, OUT/mutants.json lists the mutants, OUT/sunder_fault.hpp is the
switch: the variable SUNDER_FAULT has the number of the one that is on, as in ../mutate.py. Mutants
that do not compile are found by libclang, counted, and left out of the copies.
"""

import collections
import concurrent.futures
import hashlib
import json
import pathlib
import pickle
import re
import sys

import clang.cindex as ci
from operators import Sites

FOLDERS = ["topology/base", "topology/kernel", "topology/cells", "topology/mesh"]
ROOM = 2000  # numbers of one file, so that a change of one leaves the copies of others alone
OPTIONS = ["-x", "c++", "-std=c++20", "-DNDEBUG", "-w", "-Wno-c++11-narrowing", "-Wno-error"]

SWITCH = """// SPDX-License-Identifier: MIT
// Written by schemata.py. Which mutant is on, and which were asked for.
#pragma once
#include <cstdlib>
#include <type_traits>
inline int sunder_chosen_fault =
    std::getenv("SUNDER_FAULT") == nullptr ? 0 : std::atoi(std::getenv("SUNDER_FAULT"));
inline unsigned char sunder_reached_faults[1 << 18];
inline bool sunder_fault(int number) {
  sunder_reached_faults[number] = 1;
  return number == sunder_chosen_fault;
}
/// In functions that the compiler may evaluate: there no mutant is on.
constexpr bool sunder_fault_at_run_time(int number) {
  if (std::is_constant_evaluated()) return false;
  return sunder_fault(number);
}
"""


def flat(text):
    """One line without comments."""
    text = re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', lambda m: m.group(1) or " ", text, flags=re.S)
    return " ".join(text.split())


def nested(sites):
    """(site, [nested ...]) trees of sites; outer ones first where ranges are equal."""
    sites = sorted(sites, key=lambda s: (s.start, -s.end, s.kind != "statement"))
    trees, open_ = [], []
    for site in sites:
        while open_ and open_[-1][0].end <= site.start:
            open_.pop()
        if open_ and site.end > open_[-1][0].end:
            raise SystemExit(f"schemata.py: sites cross at {site.function}: {site.alternatives}")
        node = (site, [])
        (open_[-1][1] if open_ else trees).append(node)
        open_.append(node)
    return trees


class File:
    """One source: its mutants and its copy."""

    def __init__(self, project, name, base, cache, depends):
        self.name, self.base = name, base
        state = hashlib.sha256(depends + (project / name).read_bytes()).hexdigest()
        kept = pickle.loads(cache.read_bytes()) if cache.exists() else ("", None)
        if kept[0] != state:
            kept = (state, self.parse(project, name))
            cache.parent.mkdir(parents=True, exist_ok=True)
            cache.write_bytes(pickle.dumps(kept))
        self.found = kept[1]
        self.list_mutants()

    @staticmethod
    def parse(project, name):
        index = ci.Index.create()
        path = project / name
        unit = index.parse(str(path), OPTIONS + [f"-I{project}"],
                           options=ci.TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
        errors = [d for d in unit.diagnostics if d.severity >= ci.Diagnostic.Error]
        if errors:
            raise SystemExit(f"schemata.py: {name}: {errors[0]}")
        return Sites(path, unit)

    def list_mutants(self):
        self.mutants = []
        again = collections.Counter()
        for site in sorted(self.found.sites.values(), key=lambda s: (s.start, s.end, s.kind)):
            original = flat(self.found.text(site.start, site.end))
            mark = self.found.mark_of(site.function)
            for operator, text in site.alternatives:
                same = site.same.get(text)
                text = flat(text)
                key = (site.function, original, text)
                again[key] += 1
                self.mutants.append({
                    "number": self.base + len(self.mutants) + 1, "file": self.name,
                    "line": self.found.source[:site.start].count(b"\n") + 1,
                    "function": site.function, "operator": operator, "original": original,
                    "mutant": text, "nth": again[key], "code": mark, "site": site, **({"same": same} if same else {})})
        if len(self.mutants) >= ROOM:
            raise SystemExit(f"schemata.py: {self.name} has {len(self.mutants)} mutants: ROOM is too small")

    def copy(self, dropped):
        by_site = collections.defaultdict(list)
        for m in self.mutants:
            if m["number"] not in dropped:
                by_site[id(m["site"])].append(m)
        trees = nested([s for s in self.found.sites.values() if by_site[id(s)]])
        body = self.render(trees, by_site, 0, len(self.found.source))
        place = re.search(r"#pragma once\n", body) or re.search(r"(?=#include)", body)
        return body[:place.end()] + '#include "sunder_fault.hpp"\n' + body[place.end():]

    def render(self, trees, by_site, start, end):
        out, at = [], start
        for site, inner in trees:
            out.append(self.found.text(at, site.start))
            original = self.render(inner, by_site, site.start, site.end)
            asked = "sunder_fault_at_run_time" if site.at_compile_time else "sunder_fault"
            mutants = [(f"{asked}({m['number']})", f"/*@{m['number']}*/", m["mutant"])
                       for m in by_site[id(site)]]
            if site.kind == "statement":
                out.append("{ " + "".join(f"if ({ask})\n{mark} {{ {text} }}\nelse " for ask, mark, text in mutants)
                           + "{ " + original + " } }")
            else:
                cast = "static_cast<bool>" if site.is_bool else ""
                out.append("(" + "".join(f"{ask}\n{mark} ? {cast}({text})\n: " for ask, mark, text in mutants)
                           + f"{cast}({original}))")
            at = site.end
        out.append(self.found.text(at, end))
        return "".join(out)


def write_if_new(path, text):
    """Leaves an unchanged file alone, so that nothing is compiled again."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return False
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return True


def included(name, texts):
    """The headers of these rooms that a source includes, directly or not: its parse depends on
    them."""
    found, todo = set(), [name]
    while todo:
        more = {n.decode() for n in re.findall(rb'#include "(topology/[^"]+)"', texts[todo.pop()])}
        todo += sorted(n for n in more if n in texts and n not in found)
        found |= more
    return b"".join(texts[n] for n in sorted(found) if n in texts)


def errors_of(project, out, source):
    """Numbers of the mutants that do not compile when `source` is, and errors that no mutant's line has."""
    unit = ci.Index.create().parse(str(source), OPTIONS + [f"-I{out}", f"-I{project}", "-ferror-limit=0"])
    numbers, unblamed = set(), set()
    for d in unit.diagnostics:
        if d.severity < ci.Diagnostic.Error:
            continue
        found = []
        places = [d.location] + [n.location for n in d.children]
        for at in places:
            if at.file is None:
                continue
            line = pathlib.Path(at.file.name).read_text(encoding="utf-8").splitlines()[at.line - 1]
            found = re.findall(r"/\*@(\d+)\*/", line)
            if found:
                break
        if not found:
            unblamed.add(str(d))
        numbers.update(int(n) for n in found)
    return numbers, unblamed


def main():
    project, out = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
    write_if_new(out / "sunder_fault.hpp", SWITCH)
    names = sorted(p.relative_to(project).as_posix() for folder in FOLDERS
                   for p in (project / folder).rglob("*.[ch]pp"))
    here = pathlib.Path(__file__).resolve().parent
    texts = [(project / n).read_bytes() for n in names] + [(here / n).read_bytes() for n in ("operators.py", "schemata.py")]
    stamp, state = out / "stamp", hashlib.sha256(b"\0".join(texts)).hexdigest()
    if stamp.exists() and stamp.read_text(encoding="utf-8") == state:
        return
    depends = {n: (here / "operators.py").read_bytes() + included(n, dict(zip(names, texts))) for n in names}
    pool = concurrent.futures.ProcessPoolExecutor(2)
    files = dict(zip(names, pool.map(File, *zip(*[(project, name, ROOM * k, out / "parsed" / name, depends[name])
                                                   for k, name in enumerate(names)]))))
    dropped = set()
    # Mutants that did not compile the last time, by file, as a new file moves the numbers of those
    # behind it: tried again when their file changed.
    known = out / "dropped_of_files.json"
    stale = {name for name, f in files.items() if write_if_new(out / "originals" / name, f.found.source.decode())}
    if known.exists():
        dropped = {files[name].base + n for name, own in json.loads(known.read_text(encoding="utf-8")).items()
                   if name in files and name not in stale for n in own}
    for name, file in files.items():
        write_if_new(out / name, file.copy(dropped))
    # Headers first by themselves, then the sources, which instantiate them. A file that compiled
    # the last time need not be tried again, unless it or a header that it includes is new.
    clean = out / "clean.json"
    compiled = json.loads(clean.read_text(encoding="utf-8")) if clean.exists() else {}

    def states():
        copies = {n: (out / n).read_bytes() for n in names}
        return {n: hashlib.sha256(t + included(n, copies)).hexdigest() for n, t in copies.items()}

    is_new = [n for n, state_now in states().items() if compiled.get(n) != state_now]
    unblamed = set()
    for kind in (".hpp", ".cpp"):
        todo = [n for n in is_new if n.endswith(kind)]
        while todo:
            answers = list(pool.map(errors_of, *zip(*[(project, out, out / n) for n in todo])))
            todo = [n for n, (numbers, _) in zip(todo, answers) if numbers - dropped]
            more = set().union(*(numbers for numbers, _ in answers)) - dropped
            unblamed.update(*(errors for _, errors in answers))
            dropped |= more
            for n in {names[m // ROOM] for m in more}:
                write_if_new(out / n, files[n].copy(dropped))
    if unblamed:
        sys.exit("schemata.py: no mutant is to blame for\n" + "\n".join(sorted(unblamed)))
    clean.write_text(json.dumps(states()), encoding="utf-8")
    of_files = {name: [n - f.base for n in sorted(dropped) if names[n // ROOM] == name] for name, f in files.items()}
    known.write_text(json.dumps(of_files), encoding="utf-8")
    for path in out.glob("topology/**/*.[ch]pp"):
        if path.relative_to(out).as_posix() not in files:
            path.unlink()
    left_out = collections.Counter(k for f in files.values() for k, n in f.found.left_out.items() for _ in range(n))
    left_out["does not compile"] = len(dropped)
    mutants = [{k: v for k, v in m.items() if k != "site"}
               for f in files.values() for m in f.mutants if m["number"] not in dropped]
    write_if_new(out / "mutants.json", json.dumps({"left_out": left_out, "mutants": mutants}, indent=1) + "\n")
    stamp.write_text(state, encoding="utf-8")
    print(f"{len(mutants)} mutants in {len(files)} files; left out: {dict(left_out)}")


if __name__ == "__main__":
    main()
