#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the sample scenes and the paper's scenes, and writes their table into README.md.

    meshes/scenes/measure.py SUNDER [SCENE ...] [--set KEY=VALUE ...] [--print] [--keep DIR]

Scenes: every meshes/scenes/*.json and meshes/scenes/paper/*.json, or those named. The table stands
in meshes/scenes/README.md between two markers; other pages link to it. With --set, --print or named
scenes the table goes to standard output and README.md stays as it is: there it describes whole
runs of the scene files as they are. --keep leaves the folders of the runs in DIR.

Each run has one thread and two frames. Processor seconds are of the whole command; they depend on
the machine, the other columns do not. Exit code 1 when a run fails."""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

SCENES = pathlib.Path(__file__).resolve().parent
PAGE = SCENES / "README.md"
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"
HEAD = """| scene | mode | tetrahedra | simulated, s | processor, s | fans | pieces | pieces of one tetrahedron | share of mass in them | warnings |
|---|---|---|---|---|---|---|---|---|---|
"""


def sample_scenes():
    """The scene files of the table: the samples, then the paper's."""
    files = [*sorted(SCENES.glob("*.json")), *sorted((SCENES / "paper").glob("*.json"))]
    return [file for file in files if not file.name.endswith(".schema.json")]


def default_mode(program):
    """The word that `fracture.crack` has where a scene leaves it out, by the program's schema."""
    printed = subprocess.run([program, "run", "--schema"], check=True, capture_output=True)
    return json.loads(printed.stdout)["properties"]["fracture"]["properties"]["crack"]["default"]


def mode_of(scene, report, changes, default):
    """The crack mode of a run: a --set, the file's key, what `accuracy` chose, or the default."""
    mode = json.loads(scene.read_text(encoding="utf-8")).get("fracture", {}).get("crack", default)
    for choice in report["settings"]["chosen"]:
        if choice["key"] == "fracture.crack":
            mode = choice["value"]
    for change in changes:
        key, _, value = change.partition("=")
        if key == "fracture.crack":
            mode = value
    return mode


def processor_seconds(words):
    """Runs a command; its processor seconds. SystemExit with its errors where it fails."""
    with tempfile.TemporaryFile() as errors:
        child = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=errors)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode != 0:
            errors.seek(0)
            sys.exit(f"{' '.join(words)}: exit code {child.returncode}\n"
                     f"{errors.read().decode(errors='replace')}")
    return usage.ru_utime + usage.ru_stime


def single_share(table):
    """Share of the mass in pieces of one tetrahedron, by a run's fragments.csv."""
    with open(table, newline="", encoding="utf-8") as file:
        pieces = [(int(row["tetrahedra"]), float(row["mass"])) for row in csv.DictReader(file)]
    return sum(mass for count, mass in pieces if count == 1) / sum(mass for _, mass in pieces)


def name_of(scene):
    """The scene's file as the page links to it."""
    file = scene.relative_to(SCENES) if scene.is_relative_to(SCENES) else scene
    return f"[{file.with_suffix('').as_posix()}]({file.as_posix()})"


def line_of(program, scene, changes, default, folder):
    """Runs a scene; its line of the table."""
    words = [program, "run", str(scene), "-o", str(folder), "--frames", "2", "--threads", "1",
             "--quiet"]
    for change in changes:
        words += ["--set", change]
    seconds = processor_seconds(words)
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    warnings = sorted({warning["code"] for warning in report["warnings"]})
    pieces = report["fragments"]
    cells = [name_of(scene), f"`{mode_of(scene, report, changes, default)}`", report["tetrahedra"],
             f"{report['time']:.4g}", f"{seconds:.2g}" if seconds < 10 else f"{seconds:.0f}",
             report["fans"], pieces["count"], pieces["single_tetrahedra"],
             f"{single_share(folder / 'fragments.csv'):.2g}",
             ", ".join(f"`{code}`" for code in warnings) or "none"]
    return "| " + " | ".join(map(str, cells)) + " |\n"


def with_table(page, table):
    """The page with the table between its markers."""
    before, begin, rest = page.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        sys.exit(f"{PAGE}: no place for the table: {BEGIN} and {END} are not there in this order")
    return f"{before}{BEGIN}\n{table}{END}{after}"


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="SUNDER")
    parser.add_argument("scenes", metavar="SCENE", nargs="*", type=pathlib.Path)
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], dest="changes")
    parser.add_argument("--print", action="store_true", dest="printed")
    parser.add_argument("--keep", metavar="DIR", type=pathlib.Path)
    arguments = parser.parse_intermixed_args(words)
    program = str(pathlib.Path(arguments.program).resolve())
    scenes = [scene.resolve() for scene in arguments.scenes] or sample_scenes()
    default = default_mode(program)
    table = HEAD
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or pathlib.Path(temporary)
        for number, scene in enumerate(scenes):
            print(f"{scene.name} ...", file=sys.stderr)
            table += line_of(program, scene, arguments.changes, default,
                             folder / f"{number}_{scene.stem}")
    if arguments.printed or arguments.changes or arguments.scenes:
        print(table, end="")
    else:
        PAGE.write_text(with_table(PAGE.read_text(encoding="utf-8"), table), encoding="utf-8")


if __name__ == "__main__":
    main()
