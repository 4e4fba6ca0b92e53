# SPDX-License-Identifier: MIT
"""Makes a copy of topology/ in which faults can be switched on at run time, one at a time.

    python3 mutate.py PROJECT MUTANTS.json OUT

Every entry of the list names a piece of text that stands exactly once in a file, and a fault's
replacement. In the copy the piece becomes a choice by `sunder_fault(number)`; the project's
own sources stay free of it. An entry with a text that is gone or stands twice is an error: the list
has to follow the sources.
"""

import json
import pathlib
import sys

PREAMBLE = """#include <cstdlib>
#ifndef SUNDER_FAULT_SWITCH
#define SUNDER_FAULT_SWITCH
namespace {
[[maybe_unused]] inline bool sunder_fault(int number) {
  static const char* const chosen = std::getenv("SUNDER_FAULT");
  static const int value = chosen == nullptr ? 0 : std::atoi(chosen);
  return value == number;
}
}  // namespace
#endif
"""


def choice(entry):
    """The text that takes the place of an entry's `find`."""
    original = entry["find"]
    if entry["kind"] == "expression":
        parts = [f"sunder_fault({f['number']}) ? ({f['replace']}) : " for f in entry["faults"]]
        return "(" + "".join(parts) + f"({original}))"
    if entry["kind"] == "statement":
        parts = [f"if (sunder_fault({f['number']})) {{ {f['replace']} }} else "
                 for f in entry["faults"]]
        return "".join(parts) + "{ " + original + " }"
    raise SystemExit(f"mutate.py: kind '{entry['kind']}' is neither expression nor statement")


def write_if_new(path, text):
    """Leaves an unchanged file alone, so that nothing is compiled again."""
    if path.exists() and path.read_text(encoding="utf-8") == text:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def main():
    project, list_path, out = (pathlib.Path(a) for a in sys.argv[1:4])
    entries = json.loads(list_path.read_text(encoding="utf-8"))
    numbers = [f["number"] for e in entries for f in e["faults"]]
    if sorted(numbers) != list(range(1, len(numbers) + 1)):
        raise SystemExit(f"mutate.py: {list_path}: faults are not numbered 1 to {len(numbers)}")
    by_file = {}
    for entry in entries:
        by_file.setdefault(entry["file"], []).append(entry)
    for name, file_entries in by_file.items():
        text = (project / name).read_text(encoding="utf-8")
        for entry in file_entries:
            count = text.count(entry["find"])
            if count != 1:
                raise SystemExit(f"mutate.py: {name}: this stands there {count} times instead of "
                                 f"once: {entry['find']!r} (fault {entry['faults'][0]['number']})")
            text = text.replace(entry["find"], choice(entry))
        # After `#pragma once` and the opening comments, before the first include.
        at = text.index("#include")
        write_if_new(out / name, text[:at] + PREAMBLE + text[at:])
    for path in out.rglob("*.[ch]pp"):
        if path.relative_to(out).as_posix() not in by_file:
            path.unlink()


if __name__ == "__main__":
    main()
