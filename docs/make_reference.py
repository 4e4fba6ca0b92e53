#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the generated reference pages from the program: commands.md, scene.md and output.md.

    docs/make_reference.py SUNDER [--mesh SUNDER_MESH] [--check] [--pages docs/reference]

SUNDER: the built program, with sunder-bench next to it. commands.md comes from --help of every command, scene.md from
`sunder run --schema`, output.md from `sunder run --columns`.
--mesh: the built sunder-mesh, the last section of commands.md. Left out: that section stays as the page has it.
--check: writes nothing, compares the pages with those that would be written.

Exit codes: 0 done, 1 a page differs, 2 usage or the program cannot be run, 77 the rest is done and sunder-mesh is not built.
"""

import argparse
import difflib
import json
import pathlib
import re
import subprocess
import sys

PROJECT = pathlib.Path(__file__).resolve().parents[1]
MARK = "<!-- Written by docs/make_reference.py from the program. Changes belong into the program's texts. -->"
LINKED_PAGE = re.compile(r"\(?\b(docs/[\w/-]+\.md(?:#[\w-]+)?)\)?")


def run(sunder, *words):
    done = subprocess.run([sunder, *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"error: sunder {' '.join(map(str, words))} ended with {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def linked(text):
    """Names of pages as links from docs/reference/."""
    def link(match):
        path = match[1].removeprefix("docs/")
        name = path.rsplit("/", 1)[-1]
        target = path.removeprefix("reference/") if path.startswith("reference/") else "../" + path
        shown = f"[{name}]({target})"
        return f"({shown})" if match[0].startswith("(") else shown
    return LINKED_PAGE.sub(link, text)


def cell(text):
    """A text as one cell of a table."""
    return linked(" ".join(text.split()).replace("|", "\\|").replace("<", "&lt;"))


def code_cell(text):
    return "`" + text.replace("|", "\\|") + "`" if text else ""


# commands.md

class Help:
    """The parts of a help text; two empty lines stand before its footer."""

    def __init__(self, text):
        lines = text.splitlines()
        self.summary = lines[0].strip()
        usage = next(i for i, line in enumerate(lines) if line.startswith("Usage: "))
        self.usage = lines[usage].removeprefix("Usage: ").replace("[OPTIONS]", "[options]")
        self.groups = []   # (heading, [(names, text)])
        self.footer = ""
        place = usage + 1
        while place < len(lines):
            line = lines[place]
            place += 1
            if line != "Examples:" and re.fullmatch(r"\S[^:]*:", line) and lines[place].startswith("  ") \
                    and any(lines[place - 3:place - 1]):
                self.groups.append((line[:-1], []))
            elif self.groups and line.startswith("  ") and line.strip():
                overflows = place < len(lines) and lines[place].startswith(" " * 30)
                self.add_row(line, overflows)
            elif line.startswith("[Option Group"):
                heading = line.strip("[]").removeprefix("Option Group: ")
                if lines[place].strip() and not lines[place].strip().startswith(("[", "Options:", "Positionals:")):
                    heading = lines[place].strip()
                    place += 1
                self.groups.append((heading, []))
            elif line.strip() and not line.startswith(" "):
                self.footer = "\n".join(lines[place - 1:]).strip("\n")
                break

    def add_row(self, line, overflows):
        """Adds an option, or the text of the last one. `overflows`: its names leave no room for its text."""
        rows = self.groups[-1][1]
        indent = len(line) - len(line.lstrip())
        text_column = 28 + indent
        if line.strip() in ("Options:", "Positionals:") or line.strip().startswith("[Exactly"):
            return
        if indent >= 30:
            rows[-1] = (rows[-1][0], line.strip())
        elif overflows:
            rows.append((line.strip(), ""))
        else:
            rows.append((line[:text_column].strip(), line[text_column:].strip()))


def option_cells(names, text):
    """An option's names and its text. The options that exclude it or that it needs join the text."""
    extra = []
    for word in ("Excludes", "Needs"):
        if match := re.search(rf"\s{word}: ((?:-\S+|[A-Z]+)(?: (?:-\S+|[A-Z]+))*)", names):
            others = " ".join(f"`{name}`" for name in match[1].split())
            extra.append(f"{'Not together with' if word == 'Excludes' else 'Needs'} {others}.")
            names = names.replace(match[0], "")
    if match := re.search(r" ENUM:\{(.*?)\}", names):
        values = [value.partition("->")[0] for value in match[1].split(",")]
        extra.append("One of " + ", ".join(f"`{value}`" for value in values) + ".")
        names = names.replace(match[0], " WORD")
    names = names.replace("{false}", "")
    names = re.sub(r":(?:POSITIVE|NONNEGATIVE|\{[^}]*\}|(?:INT|UINT|FLOAT) in \[[^]]*\]|\(.*\)|[\d|]+:\{.*\})",
                   "", names)
    names = names.replace(" REQUIRED", "").replace(" TEXT", "").replace("-o,--", "-o, --")
    names = names.replace("FLOAT x 3", "X,Y,Z").replace("UINT=[1280,720] x 2", "WIDTH,HEIGHT=1280,720")
    names = re.sub(r" (?:UINT|INT)\b", " N", names).replace(" FLOAT", " X")
    return code_cell(names), cell(" ".join([text + ("." if text and text[-1] not in ".!?" else ""), *extra]))


def page(title, lines):
    return "\n".join([f"# {title}", "", MARK, "", *lines]).rstrip("\n") + "\n"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def help_section(shown, name, level):
    """A section for a help text, and the names of its subcommands."""
    lines = [f"{'#' * level} {name}", "", linked(shown.summary) + ".", "", "```text", shown.usage, "```", ""]
    nested = []
    for heading, rows in shown.groups:
        if heading == "Subcommands":
            nested = [names for names, _ in rows]
            continue
        cells = [option_cells(names, text) for names, text in rows if not names.startswith("-h,")]
        if not cells:
            continue
        kind = "argument" if heading == "Positionals" else "option"
        intro = {"Positionals": "Arguments:", "Options": "Options:"}.get(heading, heading[0].upper() + heading[1:] + ":")
        lines += [intro, "", *table((kind, "meaning"), cells), ""]
    if shown.footer:
        lines += ["```text", shown.footer, "```", ""]
    return lines, nested


def command_section(sunder, words, level):
    lines, nested = help_section(Help(run(sunder, *words, "--help")), " ".join(words), level)
    for name in nested:
        lines += command_section(sunder, [*words, name], level + 1)
    return lines


def mesh_section(mesh, old):
    """The section of sunder-mesh, a program of its own. Where it is not built, as the page has it."""
    if not mesh or not mesh.is_file():
        _, heading, section = old.partition("\n## sunder-mesh\n")
        return (heading + section).strip("\n").splitlines()
    lines, _ = help_section(Help(run(mesh.resolve(), "--help")), "sunder-mesh", 2)
    return lines[:4] + ["It is a program of its own: `cmake --build build/release --target sunder-mesh` builds "
                        "`build/release/apps/sunder-mesh/sunder-mesh`.", ""] + lines[4:]


def commands_page(sunder, mesh, old):
    program = Help(run(sunder, "--help"))
    lines = ["This page lets you look up every command of `sunder` with its options, units and exit codes.",
             "`sunder COMMAND --help` prints the same text.", ""]
    groups = [(heading, rows) for heading, rows in program.groups if heading not in ("Options", "Positionals")]
    lines += ["The commands by purpose:", ""]
    rows = [(heading, f"[`{names}`](#{names})", cell(text) + ".") for heading, rows in groups for names, text in rows]
    lines += table(("group", "command", "purpose"), rows) + [""]
    lines += [linked(program.footer), ""]
    for _, rows in groups:
        for name, _ in rows:
            lines += command_section(sunder, [name], 2)
    return page("Commands", lines + mesh_section(mesh, old))


# scene.md

def type_of(schema):
    """The type of a value in words."""
    if "anyOf" in schema:
        return " or ".join(type_of(one) for one in schema["anyOf"])
    if "const" in schema:
        return f"`{json.dumps(schema['const'])}`"
    if "enum" in schema:
        return ", ".join(f"`{word}`" for word in schema["enum"])
    kind = schema.get("type")
    if kind == "array":
        items = schema["items"]
        if schema.get("maxItems") == 3:
            return "3 numbers"
        return "list of " + ("objects" if items.get("type") == "object" else
                             type_of(items) if "enum" in items else items.get("type", "value") + "s")
    if isinstance(kind, list):
        return " or ".join(kind)
    text = {"integer": "whole number", "boolean": "`true`, `false`"}.get(kind, kind)
    return text + range_of(schema)


def number(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


def range_of(schema):
    parts = []
    if "exclusiveMinimum" in schema:
        parts.append("> " + number(schema["exclusiveMinimum"]))
    if "minimum" in schema:
        parts.append(">= " + number(schema["minimum"]))
    if schema.get("maximum", 1e300) < 4e9:
        parts.append("<= " + number(schema["maximum"]))
    return ", " + ", ".join(parts) if parts else ""


def is_object(schema):
    """Whether a value can be an object: one, or a name in its place."""
    kind = schema.get("type")
    return kind == "object" or isinstance(kind, list) and "object" in kind


def default_of(schema, required):
    if required:
        return "required"
    if "Left out: chosen by accuracy" in schema.get("description", ""):
        return "chosen"
    if "default" not in schema or is_object(schema):
        return ""
    value = schema["default"]
    if value == "" or value == []:
        return "empty"
    if isinstance(value, list):
        return "`[" + ", ".join(number(one) for one in value) + "]`"
    return f"`{number(value)}`" if isinstance(value, float) else f"`{json.dumps(value)}`"


def meaning_of(schema):
    """A description without its unit; and the unit."""
    text, _, unit = schema.get("description", "").partition(". Unit: ")
    if text.startswith("Unit: "):
        text, unit = "", text.removeprefix("Unit: ")
    text = re.sub(r"\. Left out: chosen by accuracy \(docs/[\w/]+\.md\)", "", text)
    for word in schema.get("enum", ()):  # "off: nothing breaks"
        text = re.sub(rf"(?<![\w`.]){word}(?=[:,;]| or )", f"`{word}`", text)
    return text, unit


def scene_section(schema, path, lines):
    """A section for an object, then one for each object in it."""
    title = path or "Scene"
    lines += [f"## {title}", ""]
    text, _ = meaning_of(schema)
    lines += [linked(text or "The scene file itself") + ".", ""]
    if "oneOf" in schema:
        names = [f"`{one['required'][0]}`" for one in schema["oneOf"]]
        lines += ["Exactly one of " + ", ".join(names) + " is given.", ""]
    rows, inner = [], []
    for key, value in schema["properties"].items():
        kind = value
        name = f"{path}.{key}" if path else key
        if value.get("type") == "array" and value["items"].get("type") == "object":
            kind, name = {**value["items"], "description": value["description"]}, name + "[]"
        if is_object(kind) and set(kind["properties"]) != {"axis", "angle"}:
            inner.append((kind, name))
            shown = "list of objects" if name.endswith("[]") else "object"
            if isinstance(kind["type"], list):
                shown += " or name"
            meaning = f"{meaning_of(value)[0]}: [{name}](#{anchor(name)})"
            unit = ""
        else:
            is_rotation = kind.get("type") == "object"
            shown = "`axis` (3 numbers) and `angle`" if is_rotation else type_of(value)
            meaning, unit = meaning_of(value)
            unit = "degrees" if is_rotation else unit
        rows.append((f"`{key}`", shown, unit, default_of(value, key in schema.get("required", ())),
                     cell(meaning) + ("" if meaning.endswith((".", ")")) and "](" in meaning else ".")))
    lines += table(("key", "type", "unit", "default", "meaning"), rows) + [""]
    for kind, name in inner:
        scene_section(kind, name, lines)


def anchor(heading):
    """The anchor that GitHub and MyST give a heading."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


SMALLEST_SCENE = """{
  "bodies": [{"mesh": "body.msh", "translation": [0, 0, 1]}],
  "obstacles": [{"plane": {}}],
  "time_step": 1e-3,
  "duration": 1
}"""


def scene_page(sunder):
    schema = json.loads(run(sunder, "run", "--schema"))
    lines = ["This page lets you look up every key of a scene file with its type, unit, default and meaning.",
             "A scene is a JSON file in SI units. `sunder run --schema` prints the same keys as a JSON schema, with which "
             "an editor completes and checks them.", "",
             "A default of *chosen* means that the program chooses the value by `accuracy`, from mesh, material and speeds.",
             "`settings` in `report.json` lists each chosen value with its reason ([output.md](output.md)).",
             "An unknown key is an error, and the message names the nearest known key.",
             "`--set` changes one key for one run: `--set bodies.0.material.tensile_strength=2e6`.", "",
             "The smallest scene has one body that falls on the ground:", "",
             "```json", SMALLEST_SCENE, "```", ""]
    schema = {**schema, "description": ""}
    scene_section(schema, "", lines)
    return page("Scene files", lines)


# output.md

def output_page(sunder):
    files = json.loads(run(sunder, "run", "--columns"))
    lines = ["This page lets you look up every file that `sunder run` writes, with each column and key.",
             "`sunder run --columns` prints the same list as JSON. Units are SI, and a column without a unit is a number, "
             "a word or a ratio.", "",
             "All values except wall times are the same bytes on every run of the same scene, with any number of threads.",
             "Wall times are `step_ms`, `stage_ms`, `fan_us` and `settings.expected` of `report.json`.", "",
             "The files in the folder of a run:", ""]
    seen, rows = set(), []
    for one in files:
        if one["file"] not in seen:
            seen.add(one["file"])
            name = f"[`{one['file']}`](#{anchor(one['file'])})" if one["columns"] else f"`{one['file']}`"
            meaning = "Log of the run, one JSON object per line." if one["file"] == "events.jsonl" else one["meaning"]
            rows.append((name, cell(meaning.replace(", one row per node", ""))))
    lines += table(("file", "content"), rows) + [""]
    seen.clear()
    for one in files:
        if not one["columns"]:
            continue
        if one["file"] not in seen:
            lines += [f"## {one['file']}", ""]
            seen.add(one["file"])
        if one["part"]:
            lines += [f"### {one['file']}: {one['part']}", ""]
        lines += [cell(one["meaning"]), ""]
        head = ("name", "unit", "meaning", "present if")
        rows = [(code_cell(c["name"]), c["unit"], cell(c["meaning"]), cell(c["when"] or "always")) for c in one["columns"]]
        width = 4 if any(c["when"] for c in one["columns"]) else 3
        lines += table(head[:width], [row[:width] for row in rows])
        lines += [""]
    return page("Files of a run", lines)


PAGES = {"commands.md": commands_page, "scene.md": scene_page, "output.md": output_page}
SKIPPED = 77


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sunder", type=pathlib.Path)
    parser.add_argument("--mesh", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--pages", type=pathlib.Path, default=PROJECT / "docs/reference")
    arguments = parser.parse_args()
    if not arguments.sunder.is_file():
        print(f"error: {arguments.sunder} is no file: build the targets sunder and sunder-bench", file=sys.stderr)
        return 2
    fine = True
    for name, make in PAGES.items():
        path = arguments.pages / name
        old = path.read_text(encoding="utf-8") if path.is_file() else ""
        more = (arguments.mesh, old) if make is commands_page else ()
        text = make(arguments.sunder.resolve(), *more)
        if not arguments.check:
            path.write_text(text, encoding="utf-8")
            continue
        if old != text:
            fine = False
            print("".join(line + "\n" for line in list(difflib.unified_diff(
                old.splitlines(), text.splitlines(), f"docs/reference/{name}", "by the program", "", "", 1, ""))[:40]))
            print(f"docs/reference/{name} differs: run docs/make_reference.py build/release/sunder "
                  "--mesh build/release/apps/sunder-mesh/sunder-mesh", file=sys.stderr)
    if fine and arguments.mesh and not arguments.mesh.is_file():
        print(f"skipped: {arguments.mesh} is not built, the section sunder-mesh of commands.md is not compared", file=sys.stderr)
        return SKIPPED
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
