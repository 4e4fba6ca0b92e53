# SPDX-License-Identifier: MIT
"""Runs the tests that reach each mutant of the operators, quickest first, until one kills it.

    python3 run_operators.py --build build/release/tests/mutants/operators [--only topology/kernel]

Results go to results.jsonl in the build folder, a line per mutant as it is known; a run goes on
where the last one ended. A mutant keeps its result while the code of its function stands. A proof
in survivors.json names that code too (`code`), and has to be looked at again once it is another.
`--again` asks survivors without a proof once more, as after new tests or with more time (`--most`).
At the end: the score by file.
Exit code 0 when every survivor has its proof in survivors.json, 1 otherwise.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import signal
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
HIDDEN = "[.too_large]"


def key_of(mutant):
    return tuple(mutant[k] for k in ("file", "function", "original", "mutant", "nth", "code"))


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
        width = collections.Counter(name for names in self.reaching.values() for name in names)
        for names in self.reaching.values():
            names.sort(key=lambda n: width[n] * (0.02 + self.seconds[n]))

    def order(self, mutant, kills, most):
        """Names of the cases to ask, `most` seconds in all: first those that killed the most mutants
        of the same function and file for the time they take, then those that reach little and are quick."""
        names = self.reaching[mutant["number"]]
        gain = {n: (8 * kills[mutant["file"], mutant["function"]][n] + kills[mutant["file"]][n]) / (0.002 + self.seconds[n])
                for n in names}
        likely = sorted((n for n in names if gain[n] > 0), key=gain.get, reverse=True)[:4]
        total = 0.0
        for name in likely + [n for n in names if n not in likely]:
            if total > 0 and total + self.seconds[name] > most:
                continue
            total += self.seconds[name]
            yield name


class Server:
    """`sunder_operators --serve`: forks for each mutant, so that shared data are read once."""

    def __init__(self, program):
        self.process = subprocess.Popen(
            ["prlimit", f"--as={MEMORY}", "--core=0", program, "--serve"], text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, cwd=tempfile.gettempdir())

    def ask(self, tests, number, names):
        """(case that failed, how), or None when all pass."""
        limits = [0.4 + 6 * tests.seconds[n] for n in names]
        self.process.stdin.write("\t".join([str(number)] + [f"{n}\t{s:.2f}" for n, s in zip(names, limits)]) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline().split()
        if not answer:
            sys.exit("run_operators.py: sunder_operators --serve has ended")
        if answer == ["passed"]:
            return None
        at, code = int(answer[0]), int(answer[1])
        if code == 128 + signal.SIGPROF:
            return names[at], f"more than {limits[at]:.2f} s"
        return names[at], "a wrong answer" if code < 128 else f"signal {code - 128}"


class Results:
    """The result of each mutant, in a file that grows by lines."""

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


def run_all(tests, mutants, results, arguments):
    """Judges the mutants that have no result yet."""
    wanted = ("survived", "unreached") if arguments.again else ("",)
    todo = [m for m in mutants if results.known.get(key_of(m), {"status": ""})["status"] in wanted]
    if arguments.again:
        proved, _ = proofs_of(mutants, results.known)
        todo = [m for m in todo if key_of(m) not in proved]
    kills = collections.defaultdict(collections.Counter)
    for key, result in results.known.items():
        if result["status"] == "killed":
            kills[key[0]][result["by"]] += 1
            kills[key[:2]][result["by"]] += 1
    local, done = threading.local(), 0

    def one(mutant):
        nonlocal done
        if arguments.until and time.time() > arguments.until:
            return
        if not hasattr(local, "server"):
            local.server = Server(tests.program)
        started, key = time.monotonic(), key_of(mutant)
        names = list(tests.order(mutant, kills, arguments.most))
        result = {"key": key, "status": "survived" if names else "unreached"}
        killed = local.server.ask(tests, mutant["number"], names) if names else None
        if killed:
            result.update(status="killed", by=killed[0], how=killed[1])
            kills[key[0]][killed[0]] += 1
            kills[key[:2]][killed[0]] += 1
        result["seconds"] = round(time.monotonic() - started, 2)
        results.add(result)
        done += 1
        if done % 50 == 0:
            print(f"{done} of {len(todo)}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        list(pool.map(one, todo))


def run_hidden(program, mutants, results):
    """Runs the case of meshes too large to number, which takes 18 GB, on survivors without a
    proof."""
    proved, _ = proofs_of(mutants, results.known)
    for m in mutants:
        key = key_of(m)
        if results.known.get(key, {"status": ""})["status"] not in ("survived", "unreached") or key in proved:
            continue
        done = subprocess.run([program, HIDDEN], env=dict(os.environ, SUNDER_FAULT=str(m["number"])),
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        if done.returncode != 0:
            how = "a wrong answer" if done.returncode > 0 else f"signal {-done.returncode}"
            results.add({"key": key, "status": "killed", "by": HIDDEN, "how": how})


def wanted_of(entry):
    """The keys that the mutants of an entry have: one text and its mutant, several of them
    (`changes`, each with its `nth` behind where there are more), or any change in the function."""
    place = {k: entry[k] for k in ("file", "function")}
    if "changes" in entry:
        return [place | dict(zip(("original", "mutant", "nth"), change)) for change in entry["changes"]]
    return [place | {k: entry[k] for k in ("original", "mutant", "nth") if k in entry}]


def proofs_of(mutants, known):
    """survivors.json by the key of each mutant, and proofs by the types alone; an entry that fits
    no survivor, or one of a function with code that has changed since, is an error."""
    entries = json.loads((HERE / "survivors.json").read_text(encoding="utf-8"))
    proved, wrong = {}, []
    for entry in entries:
        for wanted in wanted_of(entry):
            fits = [m for m in mutants if all(m[k] == v for k, v in wanted.items())]
            if not fits:
                wrong.append(f"no mutant is {wanted}")
            if changed := {m["code"] for m in fits} - {entry.get("code")}:
                wrong.append(f"{entry['file']} {entry['function']} has changed since its proof: if that holds still, "
                             f"give it \"code\": \"{min(changed)}\"")
                continue
            for m in fits:
                result = known.get(key_of(m))
                if result and result["status"] == "killed":
                    wrong.append(f"{wanted} is killed by {result['by']}")
                proved[key_of(m)] = entry
    for m in mutants:
        if "same" in m:
            if known.get(key_of(m), {"status": ""})["status"] == "killed":
                wrong.append(f"{key_of(m)} is killed, though {m['same']}")
            proved.setdefault(key_of(m), {"rule": m["same"]})
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
    """Writes score and proofs into tests/mutants/README.md, and the unjudged survivors next to
    it."""
    mutants = listed["mutants"]
    lines = ["", *table(mutants, known, proved), "", "Left out: " + ", ".join(
        f"{n} x {why}" for why, n in sorted(listed["left_out"].items())) + ".", "",
        "### Proved to change nothing", ""]
    rules = collections.Counter(e["rule"] for k, e in proved.items() if "rule" in e and known.get(k))
    lines += [f"- {n} by their types alone: {why}." for why, n in sorted(rules.items())]
    for entry in {id(e): e for e in proved.values() if "rule" not in e}.values():
        count = sum(e is entry for e in proved.values())
        changes = entry.get("changes", [[entry["original"], entry["mutant"]]] if "original" in entry else [])
        change = "; ".join(f"`{c[0]}` as `{c[1]}`" for c in changes) or "whatever is changed"
        lines.append(f"- `{entry['file']}`, `{entry['function']}`: {change}"
                     + (f" ({count} places)" if count > max(1, len(changes)) else "") + ". " + " ".join(entry["proof"]))
    page = PROJECT / "tests/mutants/README.md"
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
    parser.add_argument("--again", action="store_true", help="those that survived without a proof, and nothing else")
    parser.add_argument("--hidden", action="store_true",
                        help=f"ask these the hidden case {HIDDEN}, which takes 18 GB and a minute each")
    parser.add_argument("--most", type=float, default=30, help="seconds of test cases for one mutant")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--until", type=float, help="stop to begin mutants at this time (epoch)")
    parser.add_argument("--survivors", action="store_true", help="list survivors without a proof")
    parser.add_argument("--no-run", action="store_true", help="tell what is known")
    parser.add_argument("--publish", action="store_true", help="write score and proofs into tests/mutants/README.md")
    arguments = parser.parse_args()
    listed = json.loads((arguments.build / "mutated/mutants.json").read_text(encoding="utf-8"))
    mutants = [m for m in listed["mutants"] if m["file"].startswith(arguments.only)]
    random.Random(1).shuffle(mutants)  # so that a part of them is a fair sample
    mutants.sort(key=lambda m: next(i for i, room in enumerate(ORDER) if m["file"].startswith(room)))
    results = Results(arguments.build / "results.jsonl")
    if arguments.hidden:
        run_hidden(str((arguments.build / "sunder_operators").resolve()), mutants, results)
    elif not arguments.no_run:
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
