# SPDX-License-Identifier: MIT
"""Runs the suite against the kernel with one fault at a time and says which fixture kills it.

    python3 run_mutants.py --program build/release/tests/mutants/sunder_mutant [--only NUMBER]

With --test the program is a test of its own (Catch2), and any failure in it kills the fault.
Exit code 0 when the unharmed kernel passes and every fault is killed, 1 otherwise.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parent.parent
# A table that forgets makes a search grow for ever: it shall find no memory before others do not.
LIMITED = ["sh", "-c", 'ulimit -v 1500000; exec "$0" "$@"']


def run(command, number, seconds):
    """(fixture where it ended, how): how is None when the fault survived."""
    environment = dict(os.environ, SUNDER_FAULT=str(number))
    try:
        done = subprocess.run(LIMITED + [str(c) for c in command], env=environment,
                              capture_output=True, text=True, errors="replace", timeout=seconds,
                              check=False)
        lines, code = done.stdout.splitlines(), done.returncode
    except subprocess.TimeoutExpired as hung:
        out = hung.stdout or b""
        lines = (out if isinstance(out, str) else out.decode()).splitlines()
        return lines[-1] if lines else "-", f"no answer within {seconds:.0f} s"
    if code == 0:
        return lines[-1] if lines else "-", None
    if code == 1 and lines[-1].startswith("killed: "):
        return lines[-2], lines[-1][len("killed: "):]
    failed = [line for line in lines if ": failed: " in line]
    if code > 0 and failed:
        return pathlib.Path(failed[0].split(":")[0]).name, failed[0].split(": failed: ")[1][:100]
    if code < 0:
        return lines[-1] if lines else "-", f"ended by signal {-code}"
    raise SystemExit(f"run_mutants.py: fault {number}: exit code {code}: {done.stderr.strip()}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, help="sunder_mutant, see tests/mutants")
    parser.add_argument("--fixtures", default=PROJECT / "meshes/suite", help="folder of fixtures")
    parser.add_argument("--test", action="store_true", help="the program is a test")
    parser.add_argument("--list", default=HERE / "mutants.json", type=pathlib.Path,
                        help="the faults")
    parser.add_argument("--seconds", type=float, default=300, help="time limit of one fault")
    parser.add_argument("--only", type=int, help="number of one fault")
    arguments = parser.parse_args()
    entries = json.loads(arguments.list.read_text(encoding="utf-8"))
    command = [arguments.program] + (["-r", "compact", "-a"] if arguments.test
                                     else [arguments.fixtures])
    faults = {0: ("-", "none: the kernel as it is")}
    for entry in entries:
        for fault in entry["faults"]:
            faults[fault["number"]] = (entry["file"], fault["what"])
    numbers = sorted(faults) if arguments.only is None else [arguments.only]
    started = time.monotonic()

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        results = pool.map(lambda n: run(command, n, arguments.seconds), numbers)
        survived = []
        for number, (fixture, how) in zip(numbers, results):
            file, what = faults[number]
            if number == 0 and how is not None:
                sys.exit(f"the unharmed kernel fails: {fixture}: {how}")
            if number > 0 and how is None:
                survived.append(number)
            fate = f"{fixture}: {how}" if how else ("passes" if number == 0 else "SURVIVED")
            print(f"{number:3}  {what}\n     {file}\n     {fate}", flush=True)
    killed = len([n for n in numbers if n > 0]) - len(survived)
    print(f"{killed} of {killed + len(survived)} faults killed, "
          f"{time.monotonic() - started:.0f} s")
    sys.exit(1 if survived else 0)


if __name__ == "__main__":
    main()
