#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs README.md, or another page, line by line, as it stands, and judges each line.

    tests/readme/readme_lines.py [--after SET-UP] [--quick] [--build build/release] [--scratch FOLDER]
                                 [--readme README.md] [--check] [--compiler c++]

Each block ```sh, ```cpp or ```python of the page stands after a comment:
  <!-- after: SET-UP -->              it runs; SET-UP is `git clone`, `./bootstrap run` or `./bootstrap all`
  <!-- after: SET-UP, warns -->       it runs, and its lines may print warnings
  <!-- after: SET-UP, with gmsh -->   it runs where the programs named are installed
  <!-- not run: REASON -->            it does not run
A block of another kind after <!-- file: PATH --> is written to that file, as a reader would. Blocks after `git clone`
hold calls of ./bootstrap only; in_debootstrap.sh runs those. Of the others each line of sh is run by bash with the
variables that lines before it set; a block of cpp is compiled against the installed libraries of the build folder, and
run; a block of python is run by Debian's python3 with the build folder's module, where that was built. A line fails where it ends with another code than 0, or with another than its comment names (`ends with exit code 1`), or
prints a warning. Words in capitals alone (SCENE) are refused: no line has a gap to fill. `sunder` is that of the build
folder; scene.json, body.msh and mesh.msh are the reader's own, here the sample ball.

A line of `sunder view`, or with the comment `ends with Ctrl-C`, is started without a display. It is
asked for the page at the address that it prints and for the files that this page names, and ended
by SIGINT. A line with `minute` in its comment has the label `long`, every other one `quick`.

Without options every line runs. --after: only blocks of this set-up (variables are set by all).
--quick: every scene of the scratch copy ends after 0.05 s at the latest; lines with the label `long` that
name no scene are left out, and lines that read their output in out/. --check: only reads the page.
--scratch: the folder where lines run and write, kept; default: a new one, removed. It shows the
repository's files, a copy of meshes, the build folder as build/release, and out/bunny where it is there.

Exit codes: 0 all is well, 1 a line failed or warned, 2 usage, or the page breaks a rule above.
"""

import argparse
import collections
import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import urllib.parse
import urllib.request

PROJECT = pathlib.Path(__file__).resolve().parents[2]
SET_UPS = ("git clone", "./bootstrap run", "./bootstrap all")
COMMENT = re.compile(r"^<!-- (after|not run|file): (.*) -->$")
EXIT_CODE = re.compile(r"\bends with exit code (\d+)")
ASSIGNMENT = re.compile(r"^[A-Za-z_]\w*=\S*\s*(#.*)?$")
BOOTSTRAP = re.compile(r"^\./bootstrap( [a-z]+)+\s*(#.*)?$")
WARNING = re.compile(r"^\W*warning:|: warning:|^CMake [\w ]*Warning")  # sunder, compiler, CMake
ERROR = re.compile(r"^\W*error:|: (fatal )?error:|^CMake Error")
ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/")
SCENE = re.compile(r"\bmeshes/scenes/[\w/.-]+\.json\b")
OUTPUT = re.compile(r"\bout/[\w.-]+")
LONGEST = 3600  # seconds that a line may take
SCENES_END = 0.05  # seconds of a scene, for --quick

Block = collections.namedtuple("Block", "after kind number lines warns programs")
Line = collections.namedtuple("Line", "number text")
Outcome = collections.namedtuple("Outcome", "seconds code warnings text")


def block_of(mark, kind, number, lines):
    """A block after the comment `mark` (its word and its text, or nothing), and its faults. A block
    that is neither run nor written is None."""
    word, text = mark or (None, "")
    if word == "file":
        return Block("file", text, number, lines, False, []), []
    if kind not in ("sh", "cpp", "python"):
        wrong = [] if word is None else [f"line {number}: a comment names a set-up for a block that is not run"]
        return None, wrong
    if word == "not run":
        return None, [] if len(text.split()) > 1 else [f"line {number}: a reason belongs to `not run`"]
    after, *more = [part.strip() for part in text.split(",")]
    programs = [program for part in more if part.startswith("with ") for program in part.split()[1:]]
    known = all(part == "warns" or part.startswith("with ") for part in more)
    wrong = [] if after in SET_UPS and known else [
        f"line {number}: no comment before this block names one of the set-ups {', '.join(SET_UPS)}: write "
        f"<!-- after: {SET_UPS[1]} -->, or <!-- not run: REASON -->"]
    return Block(after, kind, number, lines, "warns" in more, programs), wrong


def read_blocks(page):
    """Blocks that are run or written, and their faults."""
    blocks, wrong, mark, kind, lines = [], [], None, None, []
    for number, text in enumerate(page.splitlines(), 1):
        if kind is None and text.startswith("```"):
            kind, first, lines = text[3:].strip(), number, []
        elif kind is not None and text.startswith("```"):
            block, faulty = block_of(mark, kind, first, lines)
            blocks += [block] if block else []
            wrong += faulty
            kind, mark = None, None
        elif kind is not None:
            lines.append(Line(number, text))
        elif match := COMMENT.match(text):
            mark = (match[1], match[2])
        elif text.strip():
            mark = None
    return blocks, wrong


def commands(block):
    """Lines of a block of sh, those that end with a backslash joined with the next."""
    joined = []
    for line in block.lines:
        if joined and joined[-1].text.endswith("\\"):
            joined[-1] = Line(joined[-1].number, joined[-1].text[:-1] + line.text)
        elif line.text.strip() and not line.text.startswith("#"):
            joined.append(line)
    return joined


def comment_of(text):
    """The text after the first # that begins a word."""
    match = re.search(r"(?:^|\s)#\s*(.*)", text)
    return match[1] if match else ""


def is_long(text):
    return "minute" in comment_of(text)


def is_interactive(text):
    return "ends with Ctrl-C" in comment_of(text) or re.match(r"(?:\S*/)?(?:\$S|sunder) view ", text) is not None


def gaps(text):
    """Words in capitals alone, which a reader would have to replace."""
    try:
        words = shlex.split(text, comments=True)
    except ValueError as error:
        return [str(error)]
    return [word for word in words if re.fullmatch(r"\[?[A-Z]{3,}\]?(\.\.\.)?", word)]


def faults(blocks):
    """Lines that break a rule of the page."""
    wrong = []
    for block in blocks:
        for line in commands(block) if block.kind == "sh" else ():
            if block.after == "git clone" and not BOOTSTRAP.match(line.text):
                wrong.append(f"line {line.number}: only calls of ./bootstrap stand after `git clone`")
            for word in gaps(line.text):
                wrong.append(f"line {line.number}: {word}: a line has to run as it stands")
    return wrong


def shorter(scene):
    """A scene that ends early."""
    return re.sub(r'("duration": )([\d.e+-]+)', lambda m: m[1] + str(min(float(m[2]), SCENES_END)), scene)


def shorten_scenes(folder):
    """Lets every scene below a folder end early."""
    for path in folder.rglob("*.json"):
        path.write_text(shorter(path.read_text(encoding="utf-8")), encoding="utf-8")


def write_own_files(scratch, quick):
    """The reader's own scene and meshes."""
    scene = json.loads((scratch / "meshes/scenes/ball.json").read_text(encoding="utf-8"))
    scene["name"] = "scene"
    scene["bodies"][0]["mesh"] = "body.msh"
    scene.pop("$schema", None)
    if quick:
        scene["duration"] = 4.2e-3  # a step of 1/240 s fits in
        scene["bodies"][0]["translation"] = [0, 0, 1]  # it does not come to the floor
    (scratch / "scene.json").write_text(json.dumps(scene))
    for name in ("body.msh", "mesh.msh"):
        shutil.copyfile(scratch / "meshes/ball.msh", scratch / name)


def make_scratch(scratch, build, quick):
    """The repository as lines see it, with folders of its own to write to."""
    scratch.mkdir(parents=True, exist_ok=True)
    if (scratch / "build").exists():
        return  # goes on where an earlier call ended
    for entry in PROJECT.iterdir():
        if entry.name not in (".git", "build", "out", "meshes"):
            (scratch / entry.name).symlink_to(entry)
    (scratch / "build").mkdir()
    (scratch / "build/release").symlink_to(build)
    shutil.copytree(PROJECT / "meshes", scratch / "meshes")
    if quick:
        shorten_scenes(scratch / "meshes/scenes")
    write_own_files(scratch, quick)
    (scratch / "out").mkdir()
    if (PROJECT / "out/bunny").is_dir():
        shutil.copytree(PROJECT / "out/bunny", scratch / "out/bunny")


def page_is_there(address):
    """Asks for the page and for each file that it names; raises an error if one is missing."""
    with urllib.request.urlopen(address, timeout=20) as answer:
        html = answer.read().decode()
    names = [name for name in re.findall(r'(?:src|href)="([^"#:]+)"', html)]
    if not any(name.endswith(".js") for name in names):
        raise OSError("the page names no script")
    for name in names:
        with urllib.request.urlopen(urllib.parse.urljoin(address, name), timeout=20) as answer:
            if not answer.read():
                raise OSError(f"{name} is empty")


def use_and_interrupt(process, output):
    """Waits for an address in a line's output, asks for the page, and types Ctrl-C."""
    problem, end = "no address was printed in 60 s", time.monotonic() + 60
    while time.monotonic() < end and process.poll() is None:
        match = ADDRESS.search(output.read_text(errors="replace"))
        if match:
            try:
                page_is_there(match[0])
                problem = ""
            except OSError as error:
                problem = f"{match[0]}: {error}"
            break
        time.sleep(0.1)
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGINT)
    return problem


def run_line(prelude, text, scratch):
    """Runs one line in a shell of its own, without a keyboard and without a display."""
    output = scratch / "printed.tmp"
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    environment["PATH"] = f"{scratch / 'build/release'}:{environment['PATH']}"
    script = "\n".join(["set -eo pipefail", *prelude, text])
    start, problem = time.monotonic(), ""
    with output.open("wb") as file:
        process = subprocess.Popen(["bash", "-c", script], cwd=scratch, env=environment,
                                   stdin=subprocess.DEVNULL, stdout=file, stderr=file,
                                   start_new_session=True)
        if is_interactive(text):
            problem = use_and_interrupt(process, output)
        try:
            code = process.wait(60 if is_interactive(text) else LONGEST)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            code, problem = process.wait(), problem or "did not end"
    printed = output.read_text(errors="replace")
    output.unlink()
    if problem:
        printed += f"\n{problem}\n"
        code = code or 1
    return Outcome(time.monotonic() - start, code, count_warnings(printed), printed)


def count_warnings(printed):
    return sum(1 for line in printed.splitlines() if WARNING.search(line))


def run_program(block, build, scratch, compiler):
    """Compiles a block of C++ as a host does that has the library installed, and runs it."""
    host = scratch / "host"
    shutil.rmtree(host, ignore_errors=True)
    host.mkdir()
    (host / "main.cpp").write_text("\n".join(line.text for line in block.lines) + "\n")
    (host / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(host LANGUAGES CXX)\n"
        "find_package(sunder REQUIRED)\nadd_executable(host main.cpp)\n"
        "target_compile_options(host PRIVATE -Wall -Wextra)\n"
        "target_link_libraries(host PRIVATE sunder::sunder)\n")
    quoted = {name: shlex.quote(str(path)) for name, path in
              (("build", build), ("prefix", host / "installed"), ("host", host))}
    quoted["compiler"] = shlex.quote(compiler)
    return run_line(
        ["{",
         "cmake --install {build} --component library --prefix {prefix}".format(**quoted),
         "cmake -S {host} -B {host}/built -G Ninja -DCMAKE_PREFIX_PATH={prefix} -DCMAKE_BUILD_TYPE=Release "
         "-DCMAKE_CXX_COMPILER={compiler}".format(**quoted),
         "cmake --build {host}/built".format(**quoted), "} 2>&1"],
        "{host}/built/host".format(**quoted), scratch)


def run_python(block, scratch):
    """Runs a block of Python with the module, without a display."""
    script = scratch / "block.py"
    script.write_text("\n".join(line.text for line in block.lines) + "\n")
    return run_line(["export MPLBACKEND=Agg PYTHONPATH=build/release/python"], "/usr/bin/python3 -B block.py", scratch)


def expected_code(text):
    """The exit code that a line's comment names."""
    match = EXIT_CODE.search(comment_of(text))
    return int(match[1]) if match else 0


def report(number, label, outcome, text, warns=False):
    """One row of the table, and the output of a line that failed or warned. `warns`: it may."""
    if outcome is None:
        print(f"{number:5}  {label:<12} {'-':>7} {'-':>5} {'-':>5}  {text}", flush=True)
        return True
    fine = outcome.code == expected_code(text) and (warns or outcome.warnings == 0)
    print(f"{number:5}  {label:<12} {outcome.seconds:7.1f} {outcome.code:5} {outcome.warnings:5}  {text}",
          flush=True)
    if not fine:
        lines = outcome.text.splitlines()
        told = [line for line in lines if WARNING.search(line) or ERROR.search(line)]
        shown = told + [line for line in lines[-10:] if outcome.code and line not in told]
        print("".join(f"       | {line}\n" for line in shown), end="", flush=True)
    return fine


def run_shell_block(block, arguments, scratch, prelude, missing):
    """Runs the lines of a block of sh. `missing`: parts of out/ that no line has written, and why."""
    fine = True
    for line in commands(block):
        text = line.text.strip()
        if ASSIGNMENT.match(text):
            prelude.append(text)
            continue
        if block.after == "git clone" or (arguments.after and block.after != arguments.after):
            continue
        reads = [name for name in OUTPUT.findall(text) if name in missing]
        absent = [f"no {name}" for name in block.programs if not shutil.which(name)]
        if arguments.quick and is_interactive(text) and " view " in text and not (arguments.build / "page").is_dir():
            absent.append("no page")
        if absent or arguments.quick and (reads or (is_long(text) and not SCENE.search(text))):
            label = absent[0] if absent else f"needs {missing[reads[0]]}" if reads else "long"
            missing.update({name: f"line {line.number}" for name in OUTPUT.findall(text)
                            if name not in missing})
            fine &= report(line.number, label, None, text)
            continue
        fine &= report(line.number, "long" if is_long(text) else "quick",
                       run_line(prelude, text, scratch), text, block.warns)
    return fine


def write_block(block, scratch, quick):
    """Writes a block to its file, as a reader does with an editor."""
    path = scratch / block.kind
    path.parent.mkdir(parents=True, exist_ok=True)
    text = "\n".join(line.text for line in block.lines) + "\n"
    path.write_text(shorter(text) if quick else text, encoding="utf-8")


def run_blocks(blocks, arguments, scratch):
    """Runs the blocks that the options choose, in the page's order."""
    build = arguments.build.resolve()
    make_scratch(scratch, build, arguments.quick)
    if arguments.quick:
        print(f"quick: scenes end after {SCENES_END} s; long lines without a scene are left out")
    print(f"{'line':>5}  {'label':<12} {'seconds':>7} {'exit':>5} {'warn.':>5}  command")
    fine, prelude = True, []
    missing = {} if (scratch / "out/bunny").is_dir() else {"out/bunny": "bootstrap"}
    for block in blocks:
        if block.after == "file":
            write_block(block, scratch, arguments.quick)
        elif block.kind == "sh":
            fine &= run_shell_block(block, arguments, scratch, prelude, missing)
        elif arguments.after and block.after != arguments.after:
            continue
        elif block.kind == "python":
            made = any((build / "python/sunder").glob("_sunder*.so"))
            fine &= report(block.number, "quick" if made else "no module", run_python(block, scratch) if made else None,
                           "the program of Python")
        else:
            fine &= report(block.number, "quick", run_program(block, build, scratch, arguments.compiler),
                           "the program, compiled and run")
    return fine


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--after", choices=SET_UPS[1:])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--build", type=pathlib.Path, default=PROJECT / "build/release")
    parser.add_argument("--scratch", type=pathlib.Path)
    parser.add_argument("--readme", type=pathlib.Path, default=PROJECT / "README.md")
    parser.add_argument("--compiler", default="c++")
    arguments = parser.parse_args()
    page = arguments.readme.read_text(encoding="utf-8")
    blocks, wrong = read_blocks(page)
    wrong += faults(blocks)
    if not re.search(r"^```(?:sh|cpp|python)$", page, re.MULTILINE):
        wrong.append("no block of sh, cpp or python: nothing to run")
    for text in wrong:
        print(f"{arguments.readme.name}, {text}", file=sys.stderr)
    if wrong:
        return 2
    if arguments.check:
        return 0
    if arguments.scratch:
        return 0 if run_blocks(blocks, arguments, arguments.scratch.resolve()) else 1
    with tempfile.TemporaryDirectory(prefix="sunder_readme_") as folder:
        return 0 if run_blocks(blocks, arguments, pathlib.Path(folder)) else 1


if __name__ == "__main__":
    sys.exit(main())
