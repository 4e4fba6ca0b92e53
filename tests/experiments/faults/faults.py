#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes each call of the system that a command makes fail once, and each allocation by its call stack
once, and judges the remains.

    tests/experiments/faults/faults.py build/release/sunder [--quick] [--only WORD] [--without NAME ...]
                                       [--kind KIND] [--most N] [--once] [--seed 1]

fault_shim.c, compiled here and preloaded, counts the calls of a command first, then lets one fail in
each further run. Kinds: malloc (operator new with it; once a distinct call stack), write, fwrite,
fsync, rename, open, mkdir, ftruncate, close, unlink, popen, memfd, thread, getrandom. `view` is asked for its page, a
scene and some steps, then ended as by Ctrl-C. Pictures by gnuplot need it installed. For every run:

- no signal, no run of more than a minute, an exit code of --help;
- with 0 everything is as without the fault, the output too; else standard error says something;
- every file that was to be replaced is the old one or the new one, whole; nothing lies next to it;
- of a run's folder every file is whole, and the log ends with a line.

A row per command and kind: calls or stacks, runs, how they ended, the faults. Exit code 1 where
there was a fault. --most N: at most N runs of each, drawn at random; --once: a call stack that
failed in one command is not failed in those after it (most are common to all); --quick: few, for
the tests. `demo` takes half a minute per run."""
import argparse
import collections
import http.client
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import urllib.error
import urllib.request

HERE = pathlib.Path(__file__).resolve().parent
TREE = HERE.parents[2]
KINDS = ["malloc", "write", "fwrite", "fsync", "rename", "open", "mkdir", "ftruncate", "close", "unlink",
         "popen", "memfd", "thread", "getrandom"]
DOCUMENTED = {0, 1, 2, 3, 4, 5, 6, 7}
NAMES = {3: "input", 4: "not written", 5: "failed"}

SCENE = {
    "name": "fault",
    "bodies": [{"mesh": "box.msh", "velocity": [0, 0, -6], "translation": [0, 0, 0.001],
                "material": {"young_modulus": 1e8, "tensile_strength": 1e5}}],
    "obstacles": [{"plane": {"normal": [0, 0, 1]}}],
    "time_step": 5e-4, "duration": 4e-3,
    "output": {"frames": 2, "checkpoint": {"steps": 4, "minutes": 0}},
}
HELD = SCENE | {"bodies": [{"mesh": "box.msh", "held": [{"minimum": [-1, -1, -1], "maximum": [2, 2, 1e-6]}]}],
                "obstacles": []}

# Words of each command; `out`: its output, one file, several or a folder.
COMMANDS = {
    "check": ["check", "box.msh", "--json"],
    "convert msh": ["convert", "box.vtu", "out.msh"],
    "convert mesh": ["convert", "box.msh", "out.mesh"],
    "convert vtu": ["convert", "box.msh", "out.vtu"],
    "convert vtk": ["convert", "box.msh", "out.vtk"],
    "convert node": ["convert", "box.msh", "out.node"],
    "convert inp": ["convert", "box.msh", "out.inp"],
    "convert ovm": ["convert", "box.msh", "out.ovm"],
    "convert stl": ["convert", "box.stl", "out.stl"],
    "convert gz": ["convert", "box.msh", "out.msh.gz"],
    "split": ["split", "box.msh", "--plane", "0,0,1,0.5", "-o", "out.msh"],
    "cut": ["cut", "box.msh", "out.msh", "--plane", "0,0,1,0.4", "--exact"],
    "refine": ["refine", "box.msh", "out.msh"],
    "static": ["static", "held.json", "-o", "out.vtu"],
    "modes": ["modes", "held.json", "-o", "out.vtu"],
    "run": ["run", "scene.json", "--quiet", "-o", "out"],
    "resume": ["run", "--resume", "done", "--until", "6e-3", "--quiet"],
    "branch": ["run", "--resume", "done", "--from", "4", "-o", "out", "--quiet"],
    "replay": ["run", "scene.json", "--quiet", "-o", "out", "--replay", "done/events.jsonl"],
    "export glb": ["export", "done", "out.glb"],
    "export obj": ["export", "done", "out.obj"],
    "export msh": ["export", "done", "out.msh"],
    "render": ["render", "done", "out.png", "--size", "64,64"],
    "fragments": ["fragments", "done", "--json"],
    "fragments png": ["fragments", "done", "--png", "out.png"],
    "view": ["view", "scene.json", "--headless", "--page", "page"],
    "chart": ["chart", "scene.json", "--quantity", "position", "--method", "floating_frame", "--levels", "0",
              "--steps", "5e-4,2.5e-4", "--within", "1e9", "-o", "out", "--quiet"],
    "bench formats": ["bench", "formats", "--cells", "1", "--runs", "3", "--keep", "out", "--quiet"],
    "bench kernel": ["bench", "kernel", "--quick", "--runs", "1", "--csv", "out.csv", "--plot", "out.png", "--quiet"],
    "completion": ["completion", "bash"],
    "man": ["man", "run"],
    "suite export": ["suite", "--export", "out.tar.gz"],
    "demo": ["demo", "-o", "out", "--quiet"],
}
FOLDERS = {"run": "out", "resume": "done", "branch": "out", "replay": "out", "demo": "out"}
# The end of an OpenGL driver without memory, or without a thread (Mesa's waits for ever), is its
# own.
NOT_OURS = {(name, kind) for name in ("render", "demo") for kind in ("malloc", "thread")}
# They write and print times: their output has to be whole, not to be the same.
TIMED = {"chart", "bench formats", "bench kernel"}
QUICK = ["convert vtu", "split", "run", "resume"]


class Bench:
    def __init__(self, sunder, place):
        self.sunder, self.place = sunder, place
        self.shim = place / "fault_shim.so"
        subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", self.shim, HERE / "fault_shim.c", "-ldl"],
                       check=True)
        self.inputs = place / "inputs"
        self.inputs.mkdir()
        (self.inputs / "scene.json").write_text(json.dumps(SCENE))
        (self.inputs / "held.json").write_text(json.dumps(HELD))
        shutil.copy(TREE / "meshes/cube.msh", self.inputs / "box.msh")
        for name in ("box.vtu",):
            self.plain(["convert", "box.msh", name], self.inputs)
        (self.inputs / "box.stl").write_text(STL)
        (self.inputs / "page").mkdir()
        (self.inputs / "page/index.html").write_text("<p>a page</p>")
        self.plain(["run", "scene.json", "--quiet", "-o", "done"], self.inputs)

    def plain(self, words, folder):
        done = subprocess.run([self.sunder, *words], cwd=folder, capture_output=True, timeout=120)
        if done.returncode != 0:
            sys.exit(f"sunder {' '.join(words)}: {done.stderr.decode()}")

    def fresh(self):
        folder = self.place / "work"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.inputs, folder)
        return folder

    def run(self, words, folder, kind, at=0, stack=None):
        """Runs a command with a fault; its exit code (negative: a signal; None: too long), its
        standard output and error, and the log."""
        log = self.place / "log"
        log.unlink(missing_ok=True)
        environment = dict(os.environ) | {"LD_PRELOAD": str(self.shim), "FAULT_KIND": kind, "FAULT_AT": str(at),
                                          "FAULT_LOG": str(log)}
        if stack:
            environment["FAULT_STACK"] = stack
        child = subprocess.Popen([self.sunder, *words], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        late = threading.Event()
        clock = threading.Timer(900 if words[0] == "demo" else 120, lambda: (late.set(), child.kill()))
        clock.start()
        if words[0] == "view":
            look_at(child)
        out, err = child.communicate()
        clock.cancel()
        code, err = None if late.is_set() else child.returncode, err.decode(errors="replace")
        return code, out, err, log.read_text().split() if log.exists() else []


def look_at(server):
    """The requests of a page, whatever comes back; then Ctrl-C."""
    told = re.match(rb"(http://[\d.:]+/)#token=(\w+)", server.stdout.readline())
    if not told:
        return  # it ended, or does so now
    url, token = (word.decode() for word in told.groups())
    settings = b'{"settings": []}'
    for work, body in (("", None), ("api/open", b""), ("api/load", len(settings).to_bytes(8, "little") + settings),
                       ("api/step", b'{"count": 6, "columns": [0]}'), ("api/save", b"{}"),
                       ("api/restore", b'{"step": 6}'), ("api/stamp", b"{}")):
        try:
            asked = urllib.request.Request(url + work, body, {"X-Sunder-Token": token})
            urllib.request.urlopen(asked, timeout=60).read()
        except (OSError, urllib.error.URLError, ValueError, http.client.HTTPException):
            pass
    server.send_signal(signal.SIGINT)


def files_of(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def is_whole(name, text):
    """Whether a file of a run can be seen to be whole."""
    if name.endswith(".json"):
        try:
            json.loads(text)
        except ValueError:
            return False
    if name.endswith((".vtu", ".pvd")):
        return text.rstrip().endswith(b"</VTKFile>")
    if name.endswith(".msh"):
        return text.endswith(b"$EndElements\n")
    if name.endswith(".png"):
        return text.startswith(b"\x89PNG") and text.endswith(b"IEND\xaeB`\x82")
    return not name.endswith((".csv", ".jsonl")) or text == b"" or text.endswith(b"\n")


class Judge:
    def __init__(self, bench, name):
        self.bench, self.name, self.words = bench, name, COMMANDS[name]
        self.before = files_of(bench.fresh())
        code, self.out, err, _ = self.run("none")
        if code != 0:
            sys.exit(f"{name}: {err}")
        self.after = files_of(bench.place / "work")
        self.written = [n for n in self.after if self.after[n] != self.before.get(n)]
        self.is_folder = name in FOLDERS

    def run(self, kind, at=0, stack=None):
        folder = self.bench.fresh()
        # The files to be written are there already, except folders of runs, which nobody replaces.
        if kind != "none" and not self.is_folder:
            for name in self.written:
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                (folder / name).write_bytes(b"old\n")
        return self.bench.run(self.words, folder, kind, at, stack)

    def wrong(self, code, out, err):
        if code is None:
            return "hangs"
        if code < 0:
            return f"signal {-code}"
        if code not in DOCUMENTED:
            return f"exit code {code}"
        if code != 0 and not (err.strip() or out.strip()):  # check --json reports in its object
            return f"exit code {code}, and nothing said"
        now = files_of(self.bench.place / "work")
        if self.is_folder:
            for name, text in now.items():
                if name.endswith("run.lock"):
                    continue  # holds nobody once its process is gone
                if name.endswith(".part") or name not in self.after and not name.startswith(FOLDERS[self.name]):
                    return f"{name} is left"
                if not is_whole(name, text):
                    return f"{name} is half"
            lost = [n for n in self.before if n not in now and not n.endswith(".checkpoint")]
            if lost and self.name != "resume":
                return f"{lost[0]} is lost"
            now = {n: text for n, text in now.items() if not n.endswith("run.lock")}
            if code == 0 and set(now) != set(self.after):
                return f"exit code 0 with other files: {sorted(set(now) ^ set(self.after))[0]}"
            timed = ("report.json", ".checkpoint")
            other = code == 0 and [n for n in now if not n.endswith(timed) and now[n] != self.after[n]]
            if other:
                return f"exit code 0 and another {other[0]}"
            return None
        for name in self.written:
            if name not in now:
                return f"{name} is lost"
            timed = self.name in TIMED and name.endswith((".csv", ".png")) and is_whole(name, now[name])
            if now[name] not in (b"old\n", self.after[name]) and not timed:
                return f"{name} is half"
            if code == 0 and (now[name] == b"old\n" if timed else now[name] != self.after[name]):
                return f"exit code 0 and {name} is not written"
        for name in now:
            if name not in self.after:
                return f"{name} is left"
        if code == 0 and out != self.out and self.name not in TIMED | {"view"}:
            return "exit code 0 and another output"
        return None


def faults_of(kind, log):
    """Each call that may fail. Threads may make a stack's first call come somewhat earlier another time."""
    if kind != "malloc":
        return [{"at": k + 1} for k in range(len(log))]
    return [{"stack": stack, "at": max(0, number - number // 20 - 100)}
            for stack, number in zip(log[::2], map(int, log[1::2]))]


def sweep(judge, kind, most, chance, known):
    """All faults of a kind in a command but `known` stacks; the row's numbers and the errors."""
    faults = faults_of(kind, judge.run(kind)[3])
    all_of_them = len(faults)
    faults = [f for f in faults if "stack" not in f or f["stack"] not in known]
    if most and len(faults) > most:
        faults = chance.sample(faults, most)
    ends, wrong, missed = collections.Counter(), [], 0
    for fault in faults:
        code, out, err, said = judge.run(kind, **fault)
        if "failed" not in said and code == 0:
            missed += 1  # another stack this time: nothing failed
            continue
        known.add(fault.get("stack"))
        ends[code] += 1
        if what := judge.wrong(code, out, err):
            wrong.append((fault, what, err.strip().splitlines()[:3]))
    return all_of_them, len(faults) - missed, ends, wrong


STL = """solid box
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid box
"""


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("sunder", type=pathlib.Path)
    words.add_argument("--quick", action="store_true")
    words.add_argument("--only", default="")
    words.add_argument("--without", nargs="*", default=[])
    words.add_argument("--kind", default="")
    words.add_argument("--most", type=int, default=0)
    words.add_argument("--once", action="store_true")
    words.add_argument("--seed", type=int, default=1)
    said = words.parse_args()
    chance = random.Random(said.seed)
    most = 4 if said.quick and not said.most else said.most
    failed, known = 0, set()
    with tempfile.TemporaryDirectory() as place:
        bench = Bench(said.sunder.resolve(), pathlib.Path(place).resolve())
        for name in QUICK if said.quick else COMMANDS:
            if said.only not in name or name in said.without:
                continue
            judge = Judge(bench, name)
            for kind in KINDS:
                if said.kind not in ("", kind) or (name, kind) in NOT_OURS:
                    continue
                calls, runs, ends, wrong = sweep(judge, kind, most, chance, known if said.once else set())
                if calls == 0:
                    continue
                told = ", ".join(f"{n} x {c}" for c, n in sorted(ends.items(), key=str))
                print(f"{name:14} {kind:10} {calls:6} {runs:6}  exit codes {told}; {len(wrong)} wrong", flush=True)
                for fault, what, err in wrong[:20]:
                    print(f"    {fault}: {what}; said {err}", flush=True)
                failed += len(wrong)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
