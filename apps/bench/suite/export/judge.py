#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# The suite's side of the protocol, on exported fixtures: asks a kernel in another process about
# each body, step by step, and says where an answer is not the expected one. Needs Python 3.8 on a
# POSIX system and nothing else. README.md beside it says how to use it.
import argparse
import fnmatch
import json
import os
import selectors
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from xml.sax.saxutils import quoteattr

COUNTS = ["vertices", "edges", "faces", "tetrahedra", "components", "boundary_faces",
          "boundary_sheets"]
MOST_SILENT = 3  # fixtures without an answer, one after the other, after which a kernel is given up


class Lost(Exception):
    """The kernel's process ended or spoke nonsense."""


class Silent(Lost):
    """It gave no answer in its time."""


class Mismatch(Exception):
    """An answer that is not the expected one."""


def quoted(text, most=80):
    """The start of a text from a process, with characters outside printable ASCII as \\xNN."""
    line = text.split("\n", 1)[0]
    shown = "".join(c if " " <= c <= "~" else f"\\x{ord(c):02x}" for c in line[:most])
    return f'"{shown}{"..." if len(line) > most else ""}"'


class Child:
    """A process under /bin/sh, in a process group of its own, that is asked and answers in lines."""

    def __init__(self, command):
        self.process = subprocess.Popen(["/bin/sh", "-c", command], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, start_new_session=True, bufsize=0)
        self.to, self.out = self.process.stdin.fileno(), self.process.stdout.fileno()
        os.set_blocking(self.to, False)
        os.set_blocking(self.out, False)
        self.received, self.ended = b"", False

    def exchange(self, to_send, seconds):
        """Writes and reads as far as possible now, or waits for it. Gives the rest to send, and
        whether anything happened."""
        with selectors.DefaultSelector() as ready:
            if not self.ended:
                ready.register(self.out, selectors.EVENT_READ)
            if to_send:
                ready.register(self.to, selectors.EVENT_WRITE)
            if not ready.get_map():
                return to_send, False
            events = ready.select(seconds)
        for key, _ in events:
            if key.fd == self.out:
                got = os.read(self.out, 1 << 16)
                self.received += got
                self.ended = not got
            else:
                try:
                    to_send = to_send[os.write(self.to, to_send[:1 << 16]):]
                except BrokenPipeError:
                    to_send = b""  # it reads no more, but may have answered
        return to_send, bool(events)

    def how_it_ended(self):
        try:
            code = self.process.wait(2)  # dying takes a while where a core is dumped
        except subprocess.TimeoutExpired:
            return "closed its output"
        if code < 0:
            return f"was ended by signal {-code} ({signal.Signals(-code).name})"
        return f"ended with exit code {code}"

    def ask(self, text, seconds, longest):
        """The one line that comes back for these whole lines."""
        self.exchange(b"", 0)
        if self.received:
            raise Lost(f"it had said {quoted(self.received.decode('latin-1'))} without being asked")
        to_send, deadline = memoryview(text.encode()), time.monotonic() + seconds
        while True:
            end = self.received.find(b"\n")
            if end >= 0 and not to_send:
                line, self.received = self.received[:end], self.received[end + 1:]
                if self.received:
                    raise Lost(f"its answer {quoted(line.decode('latin-1'))} has another line, "
                               f"{quoted(self.received.decode('latin-1'))}")
                return line.decode("latin-1").rstrip("\r")
            if self.ended:
                raise Lost("it " + self.how_it_ended())
            if len(self.received) > longest:
                raise Lost(f"its answer is longer than {longest} bytes and begins "
                           + quoted(self.received[:200].decode("latin-1")))
            left = deadline - time.monotonic()
            if left <= 0:
                raise Silent(f"no answer within {seconds:.3g} s")
            to_send, happened = self.exchange(to_send, min(left, 0.1))
            if not happened and self.process.poll() is not None:
                # Its last output may have come between the two looks.
                to_send, happened = self.exchange(to_send, 0)
                if not happened:
                    raise Lost(f"it {self.how_it_ended()} and left its output to another process")

    def close(self, in_peace):
        """Kills all of the process group; in peace after a quit and a second to follow it."""
        to_send, deadline = b"quit\n", time.monotonic() + (1 if in_peace else 0)
        while not self.ended and time.monotonic() < deadline:
            to_send, _ = self.exchange(to_send, 0.02)
            self.received = b""
            if not to_send and not self.process.stdin.closed:
                self.process.stdin.close()
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            try:
                pipe.close()
            except OSError:
                pass


class Words:
    """The words of one answer, taken from front to back; whatever does not fit is `Lost`."""

    def __init__(self, line, expected):
        self.line, self.expected = line, expected
        self.left = [w for w in line.split(" ") if w][::-1]

    def refuse(self):
        raise Lost(f'expected "{self.expected}", got {quoted(self.line)}')

    def word(self):
        if not self.left:
            self.refuse()
        return self.left.pop()

    def number(self, most=(1 << 64) - 1):
        word = self.word()
        if not (word.isascii() and word.isdigit()) or int(word) > most:
            self.refuse()
        return int(word)

    def numbers(self, n, most=(1 << 32) - 1):
        return [self.number(most) for _ in range(n)]

    def keyword(self, expected):
        if self.word() != expected:
            self.refuse()

    def skip(self, word):
        if self.left and self.left[-1] == word:
            self.left.pop()
            return True
        return False

    def end(self):
        if self.left:
            self.refuse()


class Kernel:
    """A kernel in another process; started anew, with the next body, after it was lost."""

    def __init__(self, command, seconds):
        self.command, self.seconds, self.child, self.name = command, seconds, None, ""
        self.start()

    def start(self):
        self.tetrahedra, self.child = 0, Child(self.command)

        def hello(words):
            words.keyword("hello")
            words.keyword("1")
            self.name = words.word()
            if not all("!" <= c <= "~" for c in self.name):
                words.refuse()
            gifts = set(words.left)
            words.left = [w for w in words.left if w not in ("glue", "homology", "orientable")]
            return gifts

        self.gifts = self.ask("hello 1", "hello 1 NAME [glue] [homology] [orientable]", hello)

    def ask(self, text, expected, parse):
        try:
            seconds = self.seconds * (1 + self.tetrahedra / 10000)
            line = self.child.ask(text + "\n", seconds, 65536 + 64 * self.tetrahedra)
            words = Words(line, expected)
            answer = parse(words)
            words.end()
            return answer
        except Lost as lost:
            self.stop(in_peace=False)
            raise type(lost)(f"asked {quoted(text)}: {lost}") from None

    def stop(self, in_peace=True):
        if self.child:
            self.child.close(in_peace)
            self.child = None

    def load(self, points, tetrahedra):
        if self.child is None:
            self.start()
        self.tetrahedra = len(tetrahedra)
        lines = [f"mesh {len(points)} {len(tetrahedra)}"]
        lines += [" ".join("nan" if x is None else repr(x) for x in p) for p in points]
        lines += [" ".join(map(str, t)) for t in tetrahedra]

        def taken(words):
            if words.skip("ok"):
                return True
            words.keyword("refused")
            words.left = []
            return False

        return self.ask("\n".join(lines), "ok | refused REASON", taken)

    def split(self, t, p):
        """None on the boundary, else points, edges (both rising), whether a component came apart."""

        def parse(words):
            if words.skip("boundary"):
                return None
            words.keyword("split")
            vertices = sorted(words.numbers(words.number(3)))
            edges = sorted(sorted(words.numbers(2)) for _ in range(words.number(3)))
            return vertices, edges, words.number(1) == 1

        return self.ask(f"split {t} {p}", "boundary | split N p... M a b... S", parse)

    def glue(self, a, b):
        def parse(words):
            if words.skip("ok"):
                return True
            words.keyword("refused")
            return False

        return self.ask(f"glue {a[0]} {a[1]} {b[0]} {b[1]}", "ok | refused", parse)

    def counts(self):
        def parse(words):
            words.keyword("counts")
            return words.numbers(7, (1 << 64) - 1)

        return self.ask("counts", "counts V E F T C BF BS", parse)

    def classes(self, question, n):
        def parse(words):
            words.keyword(question)
            return words.numbers(n)

        return self.ask(question, f"{question} and {n} numbers", parse)

    def homology(self):
        def parse(words):
            words.keyword("homology")
            if words.skip("none"):
                return None
            betti = words.numbers(4, (1 << 64) - 1)
            return betti, [[words.number() for _ in range(words.number())] for _ in range(4)]

        return self.ask("homology", "homology none | homology b0 b1 b2 b3 and 4 x (N torsion...)",
                        parse)

    def orientable(self):
        def parse(words):
            words.keyword("orientable")
            return words.number(1) == 1

        return self.ask("orientable", "orientable 1|0", parse)


class Twin:
    """Which sides are glued; vertices and components by union-find."""

    def __init__(self, tetrahedra):
        self.tetrahedra, self.glued, waiting = tetrahedra, {}, {}
        for t, corners in enumerate(tetrahedra):
            for p in corners:
                face = tuple(sorted(q for q in corners if q != p))
                if face in waiting:
                    self.glue((t, p), waiting[face])
                waiting[face] = (t, p)

    def glue(self, a, b):
        """Whether both were free."""
        if a in self.glued or b in self.glued or a == b:
            return False
        self.glued[a], self.glued[b] = b, a
        return True

    def split(self, a):
        if a in self.glued:
            del self.glued[self.glued.pop(a)]

    def classes(self):
        """The first corner of each corner's vertex, and the first tetrahedron of each component."""
        corner, component = list(range(4 * len(self.tetrahedra))), list(range(len(self.tetrahedra)))

        def root(parent, x):
            while parent[x] != x:
                parent[x] = x = parent[parent[x]]
            return x

        def join(parent, x, y):
            x, y = root(parent, x), root(parent, y)
            parent[max(x, y)] = min(x, y)

        for (t, p), (u, _) in self.glued.items():
            if t < u:
                join(component, t, u)
                for i, q in enumerate(self.tetrahedra[t]):
                    if q != p:
                        join(corner, 4 * t + i, 4 * u + self.tetrahedra[u].index(q))
        return [root(corner, x) for x in range(len(corner))], [root(component, x)
                                                               for x in range(len(component))]


def compare(what, expected, answered):
    if expected != answered:
        raise Mismatch(f"{what}: expected {expected}, answered {answered}")


def compare_classes(what, name, expected, numbers):
    first = {}
    for i, number in enumerate(numbers):
        there = first.setdefault(number, i)
        if there != expected[i]:
            a = min(there, expected[i])
            if expected[i] < i:
                raise Mismatch(f"{what}: {name(expected[i])} and {name(i)}: expected one, answered two")
            raise Mismatch(f"{what}: {name(a)} and {name(i)}: expected two, answered one")


class Trial:
    """One fixture's case on one kernel."""

    def __init__(self, case, kernel):
        self.kernel, self.case = kernel, case
        self.tetrahedra = case["body"]["tetrahedra"]
        self.steps, self.known = 0, ""

    def run(self):
        loaded = self.kernel.load(self.case["body"]["points"], self.tetrahedra)
        for known in self.case.get("known_differences", []):
            if known["kernel"] == self.kernel.name:
                return self.meet(known, loaded)
        refused = self.case.get("refused", False)
        compare("loading", "refused" if refused else "accepted", "accepted" if loaded else "refused")
        if refused:
            return
        self.twin = Twin(self.tetrahedra)
        self.look(self.case["built"])
        for operation in self.case["operations"]:
            if "glue" in operation and "glue" not in self.kernel.gifts:
                return  # later operations need it
            self.steps += 1
            self.step(operation)

    def meet(self, known, loaded):
        """Compares the answers with a known difference; nothing else is judged then."""
        expected = known.get("counts")
        compare("known difference", "accepted" if expected else "refused",
                "accepted" if loaded else "refused")
        if expected:
            self.look_counts(expected)
        self.known = known["why"]

    def step(self, operation):
        after = operation["after"]
        if "split" in operation:
            side = (operation["split"]["tetrahedron"], operation["split"]["opposite"])
            face = sorted(set(self.tetrahedra[side[0]]) - {side[1]})
            self.look_split(face, after["splits"][0], self.kernel.split(*side))
            self.twin.split(side)
        else:
            a, b = [(s["tetrahedron"], s["opposite"]) for s in operation["glue"]]
            compare("gluing", self.twin.glue(a, b), self.kernel.glue(a, b))
        self.look(after)

    def look_split(self, face, expected, answer):
        of = "face " + " ".join(map(str, face))
        refused = expected.get("refused", False)
        compare(f"splitting {of}", "a boundary face" if refused else "a split",
                "a split" if answer else "a boundary face")
        if answer:
            compare(f"split vertices of {of}", expected["vertices"], answer[0])
            compare(f"split edges of {of}", expected["edges"], answer[1])
            compare(f"separation by {of}", expected["separated"], answer[2])

    def look_counts(self, expected):
        for what, answered in zip(COUNTS, self.kernel.counts()):
            compare(what.replace("_", " "), expected[what], answered)

    def look(self, after):
        if "counts" in after:
            self.look_counts(after["counts"])
            vertices, components = self.twin.classes()
            corner = lambda i: f"point {self.tetrahedra[i // 4][i % 4]} of tetrahedron {i // 4}"
            compare_classes("vertices", corner, vertices,
                            self.kernel.classes("vertices", len(vertices)))
            compare_classes("components", lambda t: f"tetrahedron {t}", components,
                            self.kernel.classes("components", len(components)))
        if "homology" in after and "homology" in self.kernel.gifts:
            answer = self.kernel.homology()
            if answer:
                compare("Betti numbers over Z", after["homology"]["betti"], answer[0])
                compare("torsion", after["homology"]["torsion"], answer[1])
        if "orientable" in after and "orientable" in self.kernel.gifts:
            compare("orientable", after["orientable"], self.kernel.orientable())


def judge(case, kernel):
    """{result: same, known, DIFFERS or LOST; why; step; silent}."""
    trial = Trial(case, kernel)
    try:
        trial.run()
    except Mismatch as mismatch:
        return {"result": "DIFFERS", "why": str(mismatch), "step": trial.steps}
    except Lost as lost:
        return {"result": "LOST", "why": str(lost), "step": trial.steps,
                "silent": isinstance(lost, Silent)}
    return {"result": "known" if trial.known else "same", "why": trial.known, "step": trial.steps}


def read_cases(folder):
    """(name, case) of all cases of a folder's fixture files, in the order of their names."""
    cases = []
    for path in sorted(folder.glob("*.json")):
        if path.name.endswith(".schema.json"):
            continue
        family = json.loads(path.read_text())
        for case in family["cases"]:
            for operation in case.get("operations", []):
                if not isinstance(operation.get("split", {}), dict) or "after" not in operation:
                    raise ValueError(f"{path}: not an exported fixture (sunder suite --export)")
            cases.append((f'{family["name"]}/{case["name"]}', case))
    return cases


def junit(kernel, rows, started):
    """JUnit XML of (name, verdict, seconds): failure a wrong answer, error a kernel lost."""
    kind = {"DIFFERS": "failure", "LOST": "error", "known": "skipped"}
    lines = []
    for name, verdict, seconds in rows:
        family, _, case = name.partition("/")
        tag, inside = kind.get(verdict["result"]), ""
        if tag:
            what = "" if tag == "skipped" else f' type="{verdict["result"]}"'
            text = f'after step {verdict["step"]}: {verdict["why"]}'
            inside = f"<{tag}{what} message={quoteattr(quoted(text, 1000)[1:-1])}/>"
        lines.append(f"    <testcase classname={quoteattr(kernel + '.' + family)} "
                     f'name={quoteattr(case)} time="{seconds:.6f}">{inside}</testcase>')
    count = lambda result: sum(v["result"] == result for _, v, _ in rows)
    when = time.strftime("%Y-%m-%dT%H:%M:%S", time.gmtime(started))
    return "\n".join([
        '<?xml version="1.0" encoding="UTF-8"?>', "<testsuites>",
        f'  <testsuite name={quoteattr(kernel)} package="sunder.suite" id="0" timestamp="{when}" '
        f'hostname={quoteattr(quoted(socket.gethostname(), 255)[1:-1])} tests="{len(rows)}" '
        f'failures="{count("DIFFERS")}" errors="{count("LOST")}" skipped="{count("known")}" '
        f'time="{sum(s for _, _, s in rows):.3f}">', "    <properties/>", *lines,
        "    <system-out/>", "    <system-err/>", "  </testsuite>", "</testsuites>", ""])


def seconds_of(text):
    seconds = float(text)
    if not 0 < seconds <= 86400:
        raise ValueError
    return seconds


def parse_arguments():
    parser = argparse.ArgumentParser(
        description="Judges a topology kernel by exported fixtures.",
        epilog="Exit codes: 0 no mismatch, 1 mismatches, 2 usage, or a command that is no kernel, "
               "3 fixtures that cannot be read, 4 the JUnit file not written.")
    parser.add_argument("kernel", help="shell command of a program that speaks the protocol")
    parser.add_argument("filter", nargs="?", default="",
                        help="part of the fixtures' names, or a pattern with * ? [ ] for the whole")
    parser.add_argument("--fixtures", type=Path, default=Path(__file__).parent / "fixtures",
                        metavar="DIR", help="default: fixtures beside this file")
    parser.add_argument("--timeout", type=seconds_of, default=10, metavar="SECONDS",
                        help="for an answer about a small body; 1 + T / 10 000 times as long for one "
                             "of T tetrahedra (default: 10)")
    parser.add_argument("--fail-fast", action="store_true", help="end at the first mismatch")
    parser.add_argument("--junit", type=Path, metavar="FILE", help="write JUnit XML, too")
    return parser.parse_args()


def judge_all(cases, kernel, fail_fast):
    """Prints a line a fixture; gives (name, verdict, seconds) of each."""
    rows, silent, width = [], 0, max(len(name) for name, _ in cases)
    print(f'{"fixture":<{width}}{"tetrahedra":>12}{"steps":>10}{"result":>10}{"seconds":>10}')
    for name, case in cases:
        start = time.monotonic()
        if silent < MOST_SILENT:
            verdict = judge(case, kernel)
            silent = silent + 1 if verdict.get("silent") else 0
        else:
            verdict = {"result": "LOST", "step": 0, "why": "not asked: it gave no answer in "
                       f"{MOST_SILENT} fixtures one after the other"}
        seconds = time.monotonic() - start
        rows.append((name, verdict, seconds))
        size, result = len(case["body"]["tetrahedra"]), verdict["result"]
        print(f'{name:<{width}}{size:>12}{verdict["step"]:>10}{result:>10}{seconds:>10.2f}')
        if verdict["why"]:
            when = f'after step {verdict["step"]}: ' if result != "known" else ""
            print(f'  {when}{quoted(verdict["why"], 1000)[1:-1]}')
        sys.stdout.flush()
        if fail_fast and result in ("DIFFERS", "LOST"):
            break
    return rows


def main():
    arguments = parse_arguments()
    try:
        cases = read_cases(arguments.fixtures)
    except (OSError, ValueError, KeyError) as error:
        print(f"judge.py: fixtures cannot be read: {error!r}", file=sys.stderr)
        return 3
    wanted = arguments.filter
    if not set(wanted) & set("*?["):
        wanted = f"*{wanted}*"
    chosen = [(name, case) for name, case in cases if fnmatch.fnmatchcase(name, wanted)]
    if not chosen:
        print(f"judge.py: no fixture of {arguments.fixtures} is called like '{arguments.filter}'",
              file=sys.stderr)
        return 2 if cases else 3
    started = time.time()
    try:
        kernel = Kernel(arguments.kernel, arguments.timeout)
    except Lost as lost:
        print(f"judge.py: kernel '{arguments.kernel}': {lost}", file=sys.stderr)
        return 2
    try:
        rows = judge_all(chosen, kernel, arguments.fail_fast)
    finally:
        kernel.stop()
    wrong = sum(v["result"] in ("DIFFERS", "LOST") for _, v, _ in rows)
    left = len(chosen) - len(rows)
    print(f"{kernel.name}: {len(rows)} fixtures, {sum(v['step'] for _, v, _ in rows)} steps, "
          f"{wrong} mismatches" + (f"; ended there, {left} fixtures not judged" if left else ""))
    if arguments.junit:
        try:
            arguments.junit.write_text(junit(kernel.name, rows, started), encoding="ascii")
        except OSError as error:
            print(f"judge.py: {error}", file=sys.stderr)
            return 4
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
