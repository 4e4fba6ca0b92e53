#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the fixtures of the topology suite (*.json), every expectation computed here.

    make_suite.py [FAMILY...]           write them (all, or those whose names start so)
    make_suite.py --check [FAMILY...]   say which files differ from what would be written; exit 1
    make_suite.py --small ...           leave out the families that take more than seconds

Needs nothing but Python's standard library and shares nothing with the C++ kernels: union-find
over corners and edges, homology by elimination. The bytes depend on nothing but these scripts.
With python3-jsonschema installed, every file is also held against fixture.schema.json.
"""

import argparse
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "make"))

import families  # noqa: E402
from case import written  # noqa: E402
from layout import text_of  # noqa: E402
from overview import readme  # noqa: E402

try:
    import jsonschema
except ImportError:
    jsonschema = None


def fixture(family):
    return {"$schema": "fixture.schema.json", "name": family.name, "shows": family.shows,
            "source": family.source, "cases": [written(family.name, c) for c in family.cases()]}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("family", nargs="*", help="beginning of a name, such as 09")
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    parser.add_argument("--small", action="store_true", help="leave out the slow families")
    return parser.parse_args()


def main():
    options = arguments()
    schema = json.loads((HERE / "fixture.schema.json").read_text())
    chosen = [f for f in families.ALL
              if (not options.family or any(f.name.startswith(n) for n in options.family))
              and not (options.small and f.slow)]
    if not chosen:
        sys.exit("make_suite.py: no family has such a name")
    differing = []
    for family in chosen:
        data = json.loads(text := text_of(fixture(family)))
        if jsonschema:
            jsonschema.validate(data, schema)
        path = HERE / f"{family.name}.json"
        if options.check:
            if not path.exists() or path.read_text() != text:
                differing.append(path.name)
        else:
            path.write_text(text)
            print(f"{path.name}: {len(data['cases'])} cases, {len(text)} bytes", flush=True)
    files = {p.name for p in HERE.glob("*.json")} - {"fixture.schema.json"}
    differing += sorted(files - {f"{f.name}.json" for f in families.ALL})
    page = HERE / "README.md"
    text = readme(page.read_text(), [HERE / name for name in files])
    if not options.check:
        page.write_text(text)
    elif page.read_text() != text:
        differing.append(page.name)
    for name in differing:
        print(f"{name} is not what make_suite.py makes")
    sys.exit(1 if differing else 0)


if __name__ == "__main__":
    main()
