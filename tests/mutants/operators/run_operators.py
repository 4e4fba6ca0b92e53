# SPDX-License-Identifier: MIT
"""Runs the tests that reach each mutant of the operators, quickest first, until one kills it.

    python3 run_operators.py --build build/release/tests/mutants/operators [--only topology/kernel]

Results go to RESULTS in the build folder, a line a mutant as it is known; a run goes on where the
last one ended. What has a result keeps it while its file, function and text stand; `--again` asks
those that survived once more, as after new tests or with more time (`--most`). At the end: the score by file.
Exit code 0 when every survivor has its proof in survivors.json, 1 otherwise.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parent.parent.parent
BEGIN, END = "<!-- score: begin -->", "<!-- score: end -->"
ORDER = ["topology/kernel", "topology/cells", "topology/mesh", "topology/base"]
MEMORY = 1 << 30  # bytes of a run: a mutant may allocate without end


def key_of(mutant):
    return tuple(mutant[k] for k in ("file", "function", "original", "mutant", "nth"))


class Tests:
    """Test cases with the seconds each takes and the mutants each asks for, no mutant on."""

    def __init__(self, program, path):
        self.program = program
        stamp = path.with_suffix(".stamp")
        fresh = stamp.exists() and stamp.stat().st_mtime >= pathlib.Path(program).stat().st_mtime
        if not fresh:
            path.unlink(missing_ok=True)
            done = subprocess.run(["nice", program], env=dict(os.environ, SUNDER_REACHED=str(path)),
                                  stdout=subprocess.PIPE, text=True, check=False)
            if done.returncode != 0:
                sys.exit(f"run_operators.py: tests fail without a mutant:\n{done.stdout[-3000:]}")
            stamp.touch()
        self.seconds, self.reaching = {}, collections.defaultdict(list)
        for line in path.read_text(encoding="utf-8").splitlines():
            name, seconds, numbers = line.split("\t")
            self.seconds[name] = float(seconds)
            for n in numbers.split():
                self.reaching[int(n)].append(name)
        for names in self.reaching.values():
            names.sort(key=self.seconds.get)

    def batches(self, number, most):
        """Names of cases to run in one process: 8, 32, 128, ...; `most` seconds in all."""
        names, total = [], 0.0
        for name in self.reaching[number]:
            total += self.seconds[name]
            if names and total > most:
                break
            names.append(name)
        at, size = 0, 8
        while at < len(names):
            yield names[at:at + size]
            at, size = at + size, 4 * size


def run(tests, number, names):
    """(case that failed, how), or None when all pass."""
    seconds = sum(tests.seconds[n] for n in names)
    limit = 0.4 + 6 * seconds
    with tempfile.NamedTemporaryFile("w", suffix=".cases") as cases:
        cases.write("".join(f'"{n}"\n' for n in (re.sub(r'([\\,"])', r"\\\1", name) for name in names)))
        cases.flush()
        command = ["nice", "-n", "1", "prlimit", f"--as={MEMORY}", "--core=0",
                   tests.program, "-f", cases.name, "--abort", "-r", "compact"]
        files = {m.group(1) for m in (re.match(r"fixture (\d+-[^/ ]*)", n) for n in names) if m}
        process = subprocess.Popen(command, text=True, env=dict(
            os.environ, SUNDER_FAULT=str(number), SUNDER_FIXTURES=" ".join(sorted(files)),
            SUNDER_SECONDS=str(limit)),
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, errors="replace",
                                   cwd=tempfile.gettempdir())
        try:
            out, _ = process.communicate(timeout=60 + 20 * limit)
        except subprocess.TimeoutExpired:
            process.kill()
            out, _ = process.communicate()
            return names[-1], "no answer"
    code = process.returncode
    began = [line[len("case: "):] for line in out.splitlines() if line.startswith("case: ")]
    if code == 0:
        if len(began) != len(names):
            sys.exit(f"run_operators.py: {len(began)} cases of {len(names)} ran: {names}")
        return None
    case = began[-1] if began else "start of the program"
    if code == -27:  # SIGPROF
        return case, f"more than {limit:.2f} s"
    return case, "a wrong answer" if 0 < code < 128 else f"signal {-code if code < 0 else code - 128}"


class Results:
    """What is known of each mutant, in a file that grows by lines."""

    def __init__(self, path):
        self.path, self.lock, self.known = path, threading.Lock(), {}
        if path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                r = json.loads(line)
                self.known[tuple(r["key"])] = r

    def add(self, result):
        with self.lock:
            self.known[tuple(result["key"])] = result
            with self.path.open("a", encoding="utf-8") as out:
                out.write(json.dumps(result) + "\n")


def judge(tests, mutant, most):
    started = time.monotonic()
    result = {"key": key_of(mutant), "status": "survived" if tests.reaching[mutant["number"]] else "unreached"}
    for names in tests.batches(mutant["number"], most):
        killed = run(tests, mutant["number"], names)
        if killed:
            result.update(status="killed", by=killed[0], how=killed[1])
            break
    result["seconds"] = round(time.monotonic() - started, 2)
    return result


def run_all(tests, mutants, results, arguments):
    """Judges what has no result yet."""
    wanted = ("survived", "unreached") if arguments.again else ("",)
    todo = [m for m in mutants if results.known.get(key_of(m), {"status": ""})["status"] in wanted]
    done = 0

    def one(mutant):
        nonlocal done
        if arguments.until and time.time() > arguments.until:
            return
        results.add(judge(tests, mutant, arguments.most))
        done += 1
        if done % 50 == 0:
            print(f"{done} of {len(todo)}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(one, todo))


def proofs_of(mutants, known):
    """survivors.json by the key of each mutant; an entry that fits no survivor is an error."""
    entries = json.loads((HERE / "survivors.json").read_text(encoding="utf-8"))
    proved, wrong = {}, []
    for entry in entries:
        wanted = {k: entry[k] for k in ("file", "function", "original", "mutant", "nth") if k in entry}
        fits = [m for m in mutants if all(m[k] == v for k, v in wanted.items())]
        if not fits:
            wrong.append(f"no mutant is {wanted}")
        for m in fits:
            result = known.get(key_of(m))
            if result and result["status"] == "killed":
                wrong.append(f"{wanted} is killed by {result['by']}")
            proved[key_of(m)] = entry
    return proved, wrong


def table(mutants, known, proved):
    """Lines of Markdown: the score by file."""
    counts = collections.defaultdict(collections.Counter)
    for m in mutants:
        result = known.get(key_of(m))
        status = result["status"] if result else "not run"
        if status in ("survived", "unreached") and key_of(m) in proved:
            status = "proved"
        for name in (m["file"], "all"):
            counts[name][status] += 1
            counts[name]["mutants"] += 1
    lines = ["| file | mutants | killed | proved to change nothing | survive, not yet looked at | not run |",
             "|---|---|---|---|---|---|"]
    for name in sorted(counts, key=lambda n: (n == "all", n)):
        c = counts[name]
        lines.append(f"| `{name}` | {c['mutants']} | {c['killed']} | {c['proved']} | "
                     f"{c['survived'] + c['unreached']} | {c['not run']} |")
    return lines


def publish(listed, known, proved):
    """Writes score and proofs into docs/mutation.md, and what is not yet looked at beside this."""
    mutants = listed["mutants"]
    lines = ["", *table(mutants, known, proved), "", "Left out: " + ", ".join(
        f"{n} x {why}" for why, n in sorted(listed["left_out"].items())) + ".", "",
        "### Proved to change nothing", ""]
    for entry in {id(e): e for e in proved.values()}.values():
        count = sum(e is entry for e in proved.values())
        lines.append(f"- `{entry['file']}`, `{entry['function']}`: `{entry['original']}` as `{entry['mutant']}`"
                     + (f" ({count} places)" if count > 1 else "") + ". " + " ".join(entry["proof"]))
    page = PROJECT / "docs/mutation.md"
    head, rest = page.read_text(encoding="utf-8").split(BEGIN)
    page.write_text(head + BEGIN + "\n".join(lines) + "\n" + END + rest.split(END)[1], encoding="utf-8")
    left = [f"{m['file']}: {m['function']}: {m['original']}  ->  {m['mutant']}" + (f"  (no. {m['nth']})" if m["nth"] > 1 else "")
            + ("  (no test reaches it)" if known[key_of(m)]["status"] == "unreached" else "")
            for m in mutants if known.get(key_of(m), {"status": ""})["status"] in ("survived", "unreached")
            and key_of(m) not in proved]
    (HERE / "not_yet_looked_at.txt").write_text("\n".join(sorted(left)) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", required=True, type=pathlib.Path, help="tests/mutants/operators of the build")
    parser.add_argument("--only", default="", help="what the names of files begin with")
    parser.add_argument("--again", action="store_true", help="those that survived, and nothing else")
    parser.add_argument("--most", type=float, default=30, help="seconds of test cases for one mutant")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--until", type=float, help="stop to begin mutants at this time (epoch)")
    parser.add_argument("--survivors", action="store_true", help="list survivors without a proof")
    parser.add_argument("--no-run", action="store_true", help="tell what is known")
    parser.add_argument("--publish", action="store_true", help="write score and proofs into docs/mutation.md")
    arguments = parser.parse_args()
    listed = json.loads((arguments.build / "mutated/mutants.json").read_text(encoding="utf-8"))
    mutants = [m for m in listed["mutants"] if m["file"].startswith(arguments.only)]
    random.Random(1).shuffle(mutants)  # so that a part of them is a fair sample
    mutants.sort(key=lambda m: next(i for i, room in enumerate(ORDER) if m["file"].startswith(room)))
    results = Results(arguments.build / "results.jsonl")
    if not arguments.no_run:
        tests = Tests(str((arguments.build / "sunder_operators").resolve()), arguments.build / "reached.tsv")
        run_all(tests, mutants, results, arguments)
    proved, wrong = proofs_of(listed["mutants"], results.known)
    print("\n".join(table(mutants, results.known, proved)))
    open_ = [m for m in mutants if results.known.get(key_of(m), {"status": ""})["status"] in
             ("survived", "unreached") and key_of(m) not in proved]
    if arguments.survivors:
        for m in open_:
            print(f"{m['file']}:{m['line']} #{m['number']} {results.known[key_of(m)]['status']} {m['function']}: "
                  f"{m['original']}  ->  {m['mutant']}")
    for line in wrong:
        print(f"survivors.json: {line}")
    if arguments.publish:
        publish(listed, results.known, proved)
    sys.exit(1 if open_ or wrong else 0)


if __name__ == "__main__":
    main()
