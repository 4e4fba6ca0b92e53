# SPDX-License-Identifier: MIT
"""The table of all families in README.md, from the files as they are."""

import json

HEAD = """| family | shows | cases | operations | splits | tetrahedra | source |
|---|---|---|---|---|---|---|
"""
BEGIN, END = "<!-- table: by make_suite.py -->\n", "<!-- end of table -->\n"


def tetrahedra(case):
    if "built" in case:
        return case["built"]["counts"]["tetrahedra"]
    return len(case["body"]["tetrahedra"])


def row(path):
    data = json.loads(path.read_text())
    operations = [o["after"] for c in data["cases"] for o in c.get("operations", [])]
    splits = sum(sum(after.get("tally", {}).values()) for after in operations)
    sizes = sorted(map(tetrahedra, data["cases"]))
    size = f"{sizes[0]}" if sizes[0] == sizes[-1] else f"{sizes[0]} to {sizes[-1]}"
    return (f"| `{data['name']}` | {data['shows']} | {len(data['cases'])} | {len(operations)} | "
            f"{splits} | {size} | {data['source']} |\n")


def readme(old, paths):
    """The page with its table made anew."""
    before, rest = old.split(BEGIN)
    rows = map(row, sorted(paths, key=lambda path: path.stem))
    return before + BEGIN + HEAD + "".join(rows) + END + rest.split(END)[1]
