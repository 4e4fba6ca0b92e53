# SPDX-License-Identifier: MIT
"""Compares survivors with the program by random answers of the whole library (outputs_main.cpp).

    python3 check_survivors.py --build build/release/tests/mutants/operators

With each survivor on, the program has to print the same as without: else the mutant changes an
answer, and no proof can say otherwise. Says of every survivor whether it was reached and whether it
differs; results go to `outputs.jsonl` in the build folder, and a run goes on where the last ended.
Exit code 1 when a mutant that survivors.json proves to change nothing changes an answer, or when
nothing here reaches it.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys

from run_operators import MEMORY, Results, key_of, proofs_of


def outputs(program, rounds, seed, number, limit):
    """{area: number} as far as the program came."""
    command = ["prlimit", f"--cpu={limit}", f"--as={MEMORY}", "--core=0", program, str(rounds), str(seed)]
    done = subprocess.run(command, env=dict(os.environ, SUNDER_FAULT=str(number)), stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True, check=False)
    areas = dict(line.split() for line in done.stdout.splitlines())
    if done.returncode != 0:
        areas["end"] = str(done.returncode)
    return areas


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", required=True, type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=150)
    parser.add_argument("--seed", type=int, default=20261124)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="", help="what the names of files begin with")
    parser.add_argument("--proved", action="store_true", help="those with a proof alone, all of them anew")
    arguments = parser.parse_args()
    program = str((arguments.build / "sunder_operator_outputs").resolve())
    listed = json.loads((arguments.build / "mutated/mutants.json").read_text(encoding="utf-8"))["mutants"]
    known = Results(arguments.build / "results.jsonl").known
    proved, wrong = proofs_of(listed, known)
    checked = Results(arguments.build / "outputs.jsonl")
    reached_path = arguments.build / "outputs_reached.txt"
    subprocess.run([program, str(arguments.rounds), str(arguments.seed)], stdout=subprocess.DEVNULL, check=True,
                   env=dict(os.environ, SUNDER_REACHED=str(reached_path)))
    reached = {int(n) for n in reached_path.read_text(encoding="utf-8").split()}
    right = outputs(program, arguments.rounds, arguments.seed, 0, 600)
    survivors = [m for m in listed if known.get(key_of(m), {"status": ""})["status"] in ("survived", "unreached")
                 and m["file"].startswith(arguments.only)]
    if arguments.proved:
        survivors = [m for m in survivors if key_of(m) in proved]

    def one(mutant):
        key = key_of(mutant)
        if not arguments.proved and key in checked.known:
            return
        result = {"key": key, "reached": mutant["number"] in reached, "differs": []}
        if result["reached"]:
            got = outputs(program, arguments.rounds, arguments.seed, mutant["number"], 60)
            result["differs"] = sorted(a for a in right | got if right.get(a) != got.get(a))
        checked.add(result)

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(one, survivors))
    counts = {"the same": 0, "differs": 0, "not reached": 0}
    for m in survivors:
        result = checked.known[key_of(m)]
        what = "differs" if result["differs"] else "the same" if result["reached"] else "not reached"
        counts[what] += 1
        entry = proved.get(key_of(m), {})
        # An entry may say itself that nothing reaches it; one proved by its types need not be
        # reached.
        expected = {"the same"} if entry.get("reached", True) else {"not reached"}
        if "rule" in entry:
            expected = {"the same", "not reached"}
        if entry and what not in expected:
            wrong.append(f"{m['file']}:{m['line']} {m['original']} -> {m['mutant']}: {what} {result['differs']}")
    print(f"{len(survivors)} survivors on {arguments.rounds} rounds of each area: {counts}")
    for line in wrong:
        print(f"survivors.json: {line}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
