#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills runs at random moments and compares the results of `sunder run --resume` with runs that
never stopped, byte by byte.

    tests/experiments/kills/kills.py build/release/sunder [--kills 200] [--seed 1] [--scene NAME] [--long [--duration S]] [--cost]

A kill is SIGKILL, SIGTERM, SIGHUP, or a power cut: SIGKILL, after which the folder holds the synced
data and, by chance, some of the rest: names without contents, files half written, renames that
did not happen (sync_shim.c, compiled here, records the calls of fsync). A third of the runs are
killed again as they go on. Where there is no checkpoint yet the run begins again, which is counted.
Compared is every file but checkpoints; of report.json all but wall times.
Scenes: bar, block, monolith, bunny, cut to some seconds. --long: five kills of one run of about ten
minutes on an idle machine (the bunny to --duration, s; of a slower one a shorter time will do). --cost: processor and wall time with a checkpoint every second, and without.
The exit code is 1 when a byte differs."""
import argparse
import json
import os
import pathlib
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

TREE = pathlib.Path(__file__).resolve().parents[3]
SCENES = {"bar": 1.0, "block": 2.5, "monolith": 0.12, "bunny": 0.024}  # s
LONG = ["--set", "output.checkpoint.minutes=0.5"]


class Disk:
    """The disk after a power cut: the contents and names that were synced."""

    def __init__(self):
        self.contents, self.names, self.open = {}, {}, []

    def saw(self, path):
        try:
            if os.path.isdir(path):
                self.names[path] = {e.name: (e.inode(), e.is_dir()) for e in os.scandir(path)}
                return
            file = os.open(path, os.O_RDONLY)  # stays open: the number of the file is not used again
            self.open.append(file)
            with open(path, "rb") as f:
                self.contents[os.fstat(file).st_ino] = f.read()
        except FileNotFoundError:
            pass

    def close(self):
        for file in self.open:
            os.close(file)

    def cut_power(self, folder, chance):
        """Brings the folder into a possible state after a power cut."""
        now = {e.name: e for e in os.scandir(folder)}
        synced = self.names.get(str(folder), {})
        keeps_names = chance.random() < 0.5  # later names may have reached the disk, or not
        files = {}
        for name, entry in now.items():
            if entry.is_dir():
                if name in synced or keeps_names:
                    self.cut_power(pathlib.Path(entry.path), chance)
                else:
                    shutil.rmtree(entry.path)
            elif keeps_names or synced.get(name, (0,))[0] == entry.inode():
                files[name] = self.content(entry, chance)
        for name, (inode, is_dir) in synced.items():
            if not is_dir and name not in files and not keeps_names:
                files[name] = self.contents.get(inode, b"")
        for name, entry in now.items():
            if not entry.is_dir():
                os.unlink(entry.path)
        for name, text in files.items():
            (pathlib.Path(folder) / name).write_bytes(text)

    def content(self, entry, chance):
        text = pathlib.Path(entry.path).read_bytes()
        safe = self.contents.get(entry.inode(), b"")
        if not text.startswith(safe):
            return safe
        return text[:chance.randint(len(safe), len(text))]


def listen(ear, disk):
    said = b""
    try:
        while chunk := ear.recv(65536):
            said += chunk
            while b"\n" in said:
                path, said = said.split(b"\n", 1)
                disk.saw(path.decode())
                ear.sendall(b".")
    except (BrokenPipeError, ConnectionResetError):
        return  # killed while it waited


def processor_seconds(pid):
    """Processor time of a process; none once it has ended."""
    try:
        stat = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(stat[11]) + int(stat[12])) / os.sysconf("SC_CLK_TCK")
    except (FileNotFoundError, ProcessLookupError):
        return None


def run(words, shim, kill_after=None, how=None, folder=None, chance=None):
    """Runs a command to its end or to a kill, so many seconds of the processor on (so that other programs on
    the machine do not move it); whether it was killed, and its exit code."""
    disk, (ear, mouth) = Disk(), socket.socketpair()
    environment = dict(os.environ)
    if how == "power":
        environment |= {"LD_PRELOAD": str(shim), "SYNC_FD": str(mouth.fileno())}
    child = subprocess.Popen(list(map(str, words)), env=environment, pass_fds=[mouth.fileno()],
                             stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    mouth.close()
    thread = threading.Thread(target=listen, args=(ear, disk))
    thread.start()
    while kill_after is not None and child.poll() is None and (processor_seconds(child.pid) or 0) < kill_after:
        time.sleep(0.005)
    killed = kill_after is not None and child.poll() is None
    if killed:
        child.send_signal({"term": signal.SIGTERM, "hup": signal.SIGHUP}.get(how, signal.SIGKILL))
    _, said = child.communicate()
    thread.join()
    if killed and how == "power" and folder.is_dir():
        disk.cut_power(folder, chance)
    disk.close()
    return killed, child.returncode, said.decode()


def files_of(folder):
    found = {}
    for path in sorted(folder.rglob("*")):
        if not path.is_file() or path.suffix == ".checkpoint":
            continue
        text = path.read_bytes()
        if path.name == "report.json":
            report = json.loads(text)
            for key in ("step_ms", "stage_ms", "fan_us"):
                report.pop(key, None)
            report["oracle"].pop("fan_us", None)
            text = json.dumps(report).encode()
        found[str(path.relative_to(folder))] = text
    return found


def differing(a, b):
    return sorted(k for k in a.keys() | b.keys() if a.get(k) != b.get(k))


def one_kill(sunder, shim, words, reference, took, out, chance):
    """Kills a run once or twice, lets it go on; the kills, and the files that differ."""
    shutil.rmtree(out, ignore_errors=True)
    done = []
    command = [sunder, "run", *words, "-o", out]
    kills = 2 if chance.random() < 1 / 3 else 1
    while True:
        how = chance.choice(["kill", "term", "hup", "power"])
        limit = chance.uniform(0, 0.9 * took) if kills > 0 else None  # a run may take less than the first
        killed, code, said = run(command, shim, limit, how, out, chance)
        done.append(how if killed else f"exit {code}")
        kills -= 1
        if not killed and code == 0:
            return done, differing(reference, files_of(out))
        if not killed and "no_checkpoint" not in said:
            return done, [said.strip()]
        if not killed:
            done[-1] = "anew"
        resume = killed and (out / "checkpoints").is_dir()
        command = [sunder, "run", "--resume", out, "--quiet"] if resume else \
            [sunder, "run", *words, "-o", out, "--force"]


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("sunder", type=pathlib.Path)
    words.add_argument("--kills", type=int, default=200)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--scene", default="", help="of the four, this one only")
    words.add_argument("--long", action="store_true")
    words.add_argument("--duration", type=float, default=0.5)
    words.add_argument("--cost", action="store_true")
    said = words.parse_args()
    sunder = said.sunder.resolve()
    chance = random.Random(said.seed)
    wrong = 0
    with tempfile.TemporaryDirectory() as place:
        place = pathlib.Path(place).resolve()
        shim = place / "sync_shim.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-o", shim, pathlib.Path(__file__).with_name("sync_shim.c"),
                        "-ldl"], check=True)
        if said.cost:
            for name, duration in SCENES.items():
                for label, minutes in (("off", 0), ("each s", 1 / 60)):
                    start, before = time.monotonic(), os.times()
                    subprocess.run([sunder, "run", TREE / f"meshes/scenes/{name}.json", "--quiet", "-o", place / "cost",
                                    "--force", "--set", f"duration={duration}",
                                    "--set", f"output.checkpoint.minutes={minutes}"],
                                   check=True, capture_output=True)
                    after = os.times()
                    print(f"{name:10} checkpoints {label:7} {time.monotonic() - start:7.2f} s on the wall, "
                          f"{after.children_user + after.children_system - before.children_user - before.children_system:7.2f} s of processor")
            return 0
        scenes = [("bunny", ["--set", f"duration={said.duration}", *LONG])] if said.long else \
            [(name, ["--set", f"duration={d}", "--set", "output.checkpoint.minutes=0.005"]) for name, d in SCENES.items()]
        for name, settings in scenes:
            if said.scene not in ("", name):
                continue
            words = [TREE / f"meshes/scenes/{name}.json", "--quiet", "--frames", 15, *settings]
            before = os.times()
            run([sunder, "run", *words, "-o", place / name], shim)
            after, reference = os.times(), files_of(place / name)
            took = after.children_user + after.children_system - before.children_user - before.children_system
            kinds, bad = {}, 0
            for k in range(5 if said.long else said.kills // len(scenes)):
                done, files = one_kill(sunder, shim, words, reference, took, place / "killed", chance)
                for how in done:
                    kinds[how] = kinds.get(how, 0) + 1
                print(f"{name}: {k + 1} of its runs", end="\r", file=sys.stderr, flush=True)
                if files:
                    bad += 1
                    print(f"{name}: kill {k} ({', '.join(done)}): {' '.join(files[:5])}")
            print(f"{name:10} {took:6.1f} s of the processor, {len(reference)} files; {kinds}; {bad} differ", flush=True)
            wrong += bad
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
