#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Attacks `sunder view` as other programs of the machine, and pages of other origins, can:

    view_attack.py SUNDER [--only WORD] [--long MINUTES] [--seed N]

starts the server on one tetrahedron, makes every attack (or those with WORD in their name) and
prints its cost: the time until the page was answered and the growth of the server's memory. Bounds
on times and memory are wide, so that no slow machine fails them. Exit code 1 where one was broken.

--long sends random and half-right requests from eight clients for some minutes, with the token and
without, among idle and slow connections; the page must be answered all the while, the memory stay
bounded, and the process live to its end by SIGINT.
"""
import argparse
import gzip
import json
import pathlib
import random
import re
import resource
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

PATIENCE = 60  # seconds until an answer counts as none; a slow machine needs a few
MEGABYTE = 1 << 20

MESH = """MeshVersionFormatted 2
Dimension 3
Vertices
4
0 0 0 0
1 0 0 0
0 1 0 0
0 0 1 0
Tetrahedra
1
1 2 3 4 0
End
"""
MATERIAL = {"young_modulus": 1e9, "poisson_ratio": 0.2, "density": 1000, "tensile_strength": 1e6}
SCENE = {"bodies": [{"mesh": "body.mesh", "material": MATERIAL}]}
SECRET = "root:x:0:0:secret"


class Server:
    """`sunder view` on a scene of its own, with a page of 3 MB."""

    def __init__(self, program):
        self.home = tempfile.TemporaryDirectory(prefix="sunder-attack-")
        folder = pathlib.Path(self.home.name)
        self.scene = folder / "scene.json"
        (folder / "body.mesh").write_text(MESH)
        (folder / "secret").write_text(SECRET + "\n")
        self.write_scene(json.dumps(SCENE))
        (folder / "page").mkdir()
        (folder / "page/index.html").write_text("the page")
        (folder / "page/main.js").write_bytes(b"x" * (3 * MEGABYTE))
        words = [program, "view", str(self.scene), "--headless", "--page", str(folder / "page")]
        self.process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        address = self.process.stdout.readline().strip()
        found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/#token=([0-9a-f]+)", address)
        if not found:
            raise SystemExit(f"no address: {address!r}")
        self.port, self.token = int(found[1]), found[2]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        self.home.cleanup()

    def write_scene(self, text):
        self.scene.write_text(text)

    def connect(self, room=None):
        client = socket.socket()
        client.settimeout(PATIENCE)
        if room:
            client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, room)
        client.connect(("127.0.0.1", self.port))
        return client

    def head(self, first, *headers, token=False):
        lines = [f"{first} HTTP/1.1", f"Host: 127.0.0.1:{self.port}", *headers]
        if token:
            lines.append(f"X-Sunder-Token: {self.token}")
        return "\r\n".join([*lines, "", ""]).encode()

    def ask(self, work, body=b"{}"):
        """Status and body of a request as the page makes it."""
        client = self.connect()
        with client:
            length = f"Content-Length: {len(body)}"
            client.sendall(self.head(f"POST /api/{work}", length, "Connection: close", token=True) + body)
            return answer_of(client)

    def load(self, settings=()):
        text = json.dumps({"settings": list(settings)}).encode()
        return self.ask("load", struct.pack("<Q", len(text)) + text)

    def page_time(self):
        """Seconds until the page is there, for a client that has just come."""
        start = time.monotonic()
        with self.connect() as client:
            client.sendall(self.head("GET /", "Connection: close"))
            status, body = answer_of(client)
        return time.monotonic() - start if (status, body) == (200, b"the page") else float("inf")

    def peak(self):
        """The most memory that the server has had, in MB."""
        text = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(r"VmHWM:\s+(\d+) kB", text)[1]) / 1024


def answer_of(client):
    """Status and body of an answer; 0 where none comes."""
    data = b""
    try:
        while more := client.recv(65536):
            data += more
            head, end, body = data.partition(b"\r\n\r\n")
            length = re.search(rb"(?i)\r\ncontent-length: *(\d+)", head)
            if end and length and len(body) >= int(length[1]):
                break
    except OSError:
        pass
    first = re.match(rb"HTTP/1\.1 (\d{3})", data)
    return (int(first[1]) if first else 0), data.partition(b"\r\n\r\n")[2]


def pour(client, bytes_, most):
    """Sends `bytes_` over and over, up to `most` bytes or until the server has enough."""
    sent = 0
    try:
        while sent < most:
            client.sendall(bytes_)
            sent += len(bytes_)
    except OSError:
        pass
    return sent


class Crowd:
    """Clients that take up connections until the end of a `with`."""

    def __init__(self):
        self.clients, self.ends = [], threading.Event()
        self.worker = None

    def add(self, server, count, first=b"", room=None):
        for _ in range(count):
            try:
                client = server.connect(room)
                client.sendall(first)
                self.clients.append(client)
            except OSError:
                pass

    def trickle(self, byte):
        """Each client sends one more byte now and then."""

        def work():
            while not self.ends.wait(0.5):
                for client in self.clients:
                    try:
                        client.send(byte)
                    except OSError:
                        pass

        self.worker = threading.Thread(target=work)
        self.worker.start()

    def open_count(self):
        count = 0
        for client in self.clients:
            client.setblocking(False)
            try:
                while client.recv(65536):
                    pass
            except BlockingIOError:
                count += 1
            except OSError:
                pass
        return count

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.ends.set()
        if self.worker:
            self.worker.join()
        for client in self.clients:
            client.close()


ATTACKS = []


def attack(function):
    ATTACKS.append(function)
    return function


def refused(server, first, *headers, token=False, expect, body=400 * MEGABYTE):
    """A request that is refused: its answer comes before a byte of its body is sent, and a body
    that is sent all the same takes no memory. Gives words on the faults, and the growth."""
    wrong = []
    with server.connect() as client:
        client.sendall(server.head(first, *headers, token=token))
        status, _ = answer_of(client)
    if status != expect:
        wrong.append(f"{first}: {status} without its body, {expect} expected")
    before = server.peak()
    with server.connect() as client:
        client.sendall(server.head(first, *headers, token=token))
        pour(client, b"x" * MEGABYTE, body)
    growth = server.peak() - before
    if growth > 150:
        wrong.append(f"{first}: {growth:.0f} MB")
    return wrong, growth


def growth_since(server, before, wrong):
    """MB by which the server's peak has grown; more than 100 are noted in `wrong`."""
    growth = server.peak() - before
    if growth > 100:
        wrong.append(f"{growth:.0f} MB")
    return growth


@attack
def bodies_that_are_refused(server):
    length = f"Content-Length: {400 * MEGABYTE}"
    wrong, most = [], 0
    for first, headers, token, expect in [
        ("POST /api/load", ["Origin: http://other.example", length], True, 403),
        ("POST /api/load", [length], False, 403),
        ("POST /api/load", [length, "X-Sunder-Token: guess"], False, 403),
        ("POST /api/nothing", [length], True, 404),
        ("PUT /api/load", [length], True, 405),
        ("POST /index.html", [length], False, 405),
        ("GET /index.html", [length], False, 400),
        ("POST /api/load", ["Content-Length: 99999999999"], True, 413),
        ("POST /api/step", [length], True, 413),
        ("POST /api/load", ["Transfer-Encoding: chunked"], True, 411),
        ("POST /api/load", ["Transfer-Encoding: chunked", length], True, 411),
        ("POST /api/load", [], True, 411),
        ("POST /api/load", ["Content-Length: 5", "Content-Length: 6"], True, 400),
    ]:
        more, growth = refused(server, first, *headers, token=token, expect=expect)
        wrong, most = wrong + more, max(most, growth)
    return wrong, f"{most:.1f} MB for bodies of 400 MB"


@attack
def body_that_hides_a_request(server):
    with server.connect() as client:
        inner = server.head("GET /")
        head = server.head("POST /api/open", "Origin: http://other.example", f"Content-Length: {len(inner)}")
        client.sendall(head + inner)
        answers = b""
        try:
            while more := client.recv(65536):
                answers += more
        except OSError:
            pass
    count = answers.count(b"HTTP/1.1 ")
    return ([] if count == 1 else [f"{count} answers to one request"]), f"{count} answer"


@attack
def heads_without_end(server):
    wrong, before = [], server.peak()
    for begin, more in [
        (b"", b"x" * MEGABYTE),
        (b"GET /", b"x" * MEGABYTE),
        (server.head("GET /")[:-2] + b"X: ", b"x" * MEGABYTE),
        (server.head("GET /")[:-2], b"".join(b"X-%d: x\r\n" % k for k in range(90_000))),
        (server.head("GET /")[:-2], b"\r" * MEGABYTE),
    ]:
        with server.connect() as client:
            client.sendall(begin)
            pour(client, more, 300 * MEGABYTE)
    with server.connect() as client:
        client.sendall(server.head("GET /")[:-2] + b"X: x\r\n" * 20_000)
        status, _ = answer_of(client)
    if status not in (0, 431):
        wrong.append(f"a head of 120 kB is answered by {status}")
    growth = growth_since(server, before, wrong)
    return wrong, f"{growth:.1f} MB for heads of 300 MB"


@attack
def answers_and_bodies_that_swell(server):
    before, wrong = server.peak(), []
    with server.connect() as client:
        ranges = ",".join(["0-"] * 2500)
        client.sendall(server.head("GET /main.js", f"Range: bytes={ranges}", "Connection: close"))
        status, body = answer_of(client)
    if (status, len(body)) != (200, 3 * MEGABYTE):
        wrong.append(f"2 500 ranges: {status}, {len(body)} bytes")
    bomb = gzip.compress(b"[" * (60 * MEGABYTE), 9)[: 1 << 16]
    with server.connect() as client:
        headers = [f"Content-Length: {len(bomb)}", "Content-Encoding: gzip", "Connection: close"]
        client.sendall(server.head("POST /api/step", *headers, token=True) + bomb)
        answer_of(client)
    growth = growth_since(server, before, wrong)
    return wrong, f"{growth:.1f} MB"


@attack
def long_headers_on_a_small_stack(server):
    """A regular expression that calls itself for each character needs more."""
    usual = resource.getrlimit(resource.RLIMIT_STACK)
    resource.setrlimit(resource.RLIMIT_STACK, (2 * MEGABYTE, usual[1]))
    try:
        with Server(server.process.args[0]) as other:
            for header in ("Range: bytes=" + "1" * 8100, "range: bytes=" + ",".join(["0-"] * 2700),
                           "Accept-Encoding: " + "a," * 4000, "Content-Type: " + "a;" * 4000):
                with other.connect() as client:
                    client.sendall(other.head("GET /", header, "Connection: close"))
                    status, body = answer_of(client)
                if (status, body) != (200, b"the page"):
                    return [f"{header[:20]}: {status}"], ""
    finally:
        resource.setrlimit(resource.RLIMIT_STACK, usual)
    return [], ""


def page_among(server, crowd, *, count=5):
    """The longest that the page takes, asked for a few times."""
    times = [server.page_time() for _ in range(count)]
    late = [t for t in times if t > PATIENCE / 2]
    return ([f"the page took {max(times):.1f} s"] if late else []), max(times)


@attack
def idle_connections(server):
    with Crowd() as crowd:
        crowd.add(server, 64)
        wrong, longest = page_among(server, crowd)
        still = crowd.open_count()
    # Before the idle ones ended, not after: they have a minute.
    if still == 0:
        wrong.append("the idle connections had ended before the page came")
    return wrong, f"page in {longest:.3f} s, {still} of 64 still there"


@attack
def slow_senders_of_heads(server):
    with Crowd() as crowd:
        crowd.add(server, 64, b"GET / HTTP/1.1\r\nHost: ")
        crowd.trickle(b"x")
        wrong, longest = page_among(server, crowd)
        # They end by a time for the whole head, though each byte comes in time.
        end = time.monotonic() + PATIENCE
        while crowd.open_count() and time.monotonic() < end:
            time.sleep(0.1)
        if left := crowd.open_count():
            wrong.append(f"{left} slow senders are still there after {PATIENCE} s")
    return wrong, f"page in {longest:.3f} s"


@attack
def slow_senders_of_bodies(server):
    with Crowd() as crowd:
        crowd.add(server, 64, server.head("POST /api/step", "Content-Length: 60000", token=True))
        crowd.add(server, 64, server.head("POST /api/step", "Content-Length: 60000"))
        crowd.trickle(b"x")
        wrong, longest = page_among(server, crowd)
    return wrong, f"page in {longest:.3f} s"


@attack
def slow_readers(server):
    before = server.peak()
    with Crowd() as crowd:
        crowd.add(server, 64, server.head("GET /main.js"), room=2048)
        wrong, longest = page_among(server, crowd)
    growth = growth_since(server, before, wrong)
    return wrong, f"page in {longest:.3f} s, {growth:.1f} MB"


@attack
def idle_and_slow_together(server):
    before = server.peak()
    with Crowd() as idle, Crowd() as slow:
        idle.add(server, 64)
        slow.add(server, 64, b"GET / HTTP/1.1\r\nX: ")
        slow.trickle(b"x")
        wrong, longest = page_among(server, slow)
        if server.ask("open")[0] != 200:
            wrong.append("the engine did not answer")
    return wrong, f"page in {longest:.3f} s, {server.peak() - before:.1f} MB"


@attack
def more_connections_than_there_may_be(server):
    before = server.peak()
    with Crowd() as crowd:
        crowd.add(server, 700)
        wrong, longest = page_among(server, crowd)
    growth = growth_since(server, before, wrong)
    return wrong, f"page in {longest:.3f} s among {len(crowd.clients)}, {growth:.1f} MB"


@attack
def deep_scene(server):
    server.load()
    wrong = []
    for text in ("[" * 60_000 + "]" * 60_000, "[" * 60_000, '{"bodies":' * 60_000):
        server.write_scene(text)
        for work in (lambda: server.ask("stamp"), lambda: server.ask("scene")):
            if work()[0] != 200:
                wrong.append("a deep scene has no stamp or text")
        if server.load()[0] != 400:
            wrong.append("a deep scene is loaded")
        for work in ("step", "read", "inspect", "restore", "forget"):
            if server.ask(work, text.encode()[:60_000])[0] != 400:
                wrong.append(f"a deep request {work} is answered")
    server.write_scene(json.dumps(SCENE))
    return wrong, ""


@attack
def files_that_are_no_meshes(server):
    wrong = []
    changed = json.loads(json.dumps(SCENE))
    for name in ("secret", "/etc/passwd"):
        changed["bodies"][0]["mesh"] = name
        server.write_scene(json.dumps(changed))
        status, body = server.load()
        if status != 400 or b"root:" in body:
            wrong.append(f"{name}: {status} {body[:100]!r}")
    server.write_scene(json.dumps(SCENE))
    for setting in ("bodies.0.mesh=/etc/passwd", 'bodies=[{"mesh":"/etc/passwd"}]'):
        status, body = server.load([setting])
        if status != 400 or b"root:" in body:
            wrong.append(f"{setting}: {status} {body[:100]!r}")
    return wrong, ""


def end_time(server, number):
    """Exit code and seconds from a signal to the end."""
    start = time.monotonic()
    server.process.send_signal(number)
    try:
        return server.process.wait(PATIENCE), time.monotonic() - start
    except subprocess.TimeoutExpired:
        return None, float("inf")


@attack
def end_by_signal(server):
    """With idle connections, and during a step request that takes longer than anybody waits."""
    wrong, times = [], []
    for number in (signal.SIGINT, signal.SIGTERM):
        with Server(server.process.args[0]) as other, Crowd() as crowd:
            crowd.add(other, 8)
            other.load()
            body = b'{"count": 2000000000}'
            crowd.add(other, 1, other.head("POST /api/step", f"Content-Length: {len(body)}", token=True) + body)
            other.page_time()
            code, seconds = end_time(other, number)
        times.append(seconds)
        if code != 0:
            wrong.append(f"{number.name}: exit code {code} after {seconds:.1f} s")
    return wrong, "ended in " + ", ".join(f"{t:.3f} s" for t in times)


def random_request(server, rng):
    """Bytes that are no request, nearly one, or one."""
    kind = rng.randrange(6)
    if kind == 0:
        return rng.randbytes(rng.randrange(1, 40_000))
    method = rng.choice(["GET", "HEAD", "POST", "PUT", "PRI", "OPTIONS", "", "G\0T"])
    works = ["open", "scene", "stamp", "load", "act", "step", "read", "inspect", "save", "forget", "restore"]
    path = rng.choice(["/", "/main.js", "/%2e%2e/secret", "/api/", "/" + "a" * rng.randrange(9000)]
                      + [f"/api/{work}" for work in works])
    body = rng.choice([b"", b"{}", rng.randbytes(rng.randrange(200)), b"[" * rng.randrange(70_000),
                       b'{"columns": [0, 1, 2, 3, 4, 99], "count": 2, "vertex": 1, "step": 1}'])
    length = rng.choice([len(body)] * 4 + [0, -1, 1 << 40, len(body) + 5, "x"])
    headers = [f"Content-Length: {length}"]
    for _ in range(rng.randrange(4)):
        headers.append(rng.choice(["Transfer-Encoding: chunked", "Expect: 100-continue", "Range: bytes=0-,0-", ": x",
                                   "Origin: null", "Connection: close", "Content-Encoding: gzip", "X: " + "x" * 9000,
                                   "Content-Type: multipart/form-data; boundary=x", "\0: \0"]))
    bytes_ = bytearray(server.head(f"{method} {path}", *headers, token=rng.random() < 0.7) + body)
    if kind == 1:
        for _ in range(rng.randrange(1, 6)):
            bytes_[rng.randrange(len(bytes_))] = rng.randrange(256)
    if kind == 2:
        del bytes_[rng.randrange(len(bytes_)):]
    return bytes(bytes_)


def long_attack(server, minutes, seed):
    end = time.monotonic() + 60 * minutes
    counts = [0] * 8
    server.load()

    def client_of(row):
        rng = random.Random(seed * 1000 + row)
        while time.monotonic() < end:
            try:
                with server.connect() as client:
                    client.settimeout(rng.choice([0.01, 0.1, 1]))
                    for _ in range(rng.randrange(1, 4)):
                        client.sendall(random_request(server, rng))
                    while rng.random() < 0.9 and client.recv(65536):
                        pass
            except OSError:
                pass
            counts[row] += 1

    clients = [threading.Thread(target=client_of, args=(row,)) for row in range(len(counts))]
    for client in clients:
        client.start()
    wrong, longest = [], 0.0
    while time.monotonic() < end:
        with Crowd() as crowd:
            crowd.add(server, 40)
            crowd.add(server, 40, b"GET / HTTP/1.1\r\nX: ")
            crowd.add(server, 20, server.head("GET /main.js"), room=2048)
            more, time_of_page = page_among(server, crowd, count=20)
        wrong, longest = wrong + more, max(longest, time_of_page)
        if server.process.poll() is not None:
            wrong.append(f"the server ended with {server.process.returncode}")
            break
    for client in clients:
        client.join()
    peak = server.peak() if server.process.poll() is None else float("inf")
    if peak > 400:
        wrong.append(f"{peak:.0f} MB at its peak")
    code, seconds = end_time(server, signal.SIGINT)
    if code != 0:
        wrong.append(f"SIGINT: exit code {code}")
    return wrong, f"{sum(counts)} requests, page in {longest:.3f} s at the longest, peak {peak:.0f} MB, ended in {seconds:.3f} s"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--only", default="", metavar="WORD")
    parser.add_argument("--long", type=float, default=0, metavar="MINUTES")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    if most < 2048 and most != resource.RLIM_INFINITY:
        print("skipped: this process may not open 2 048 files")
        sys.exit(77)
    usual, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (max(usual, 2048), most))
    attacks = [a for a in ATTACKS if arguments.only in a.__name__]
    if arguments.long:
        attacks = [lambda server: long_attack(server, arguments.long, arguments.seed)]
        attacks[0].__name__ = "long"
    failures = 0
    for one in attacks:
        with Server(arguments.program) as server:
            start = time.monotonic()
            try:
                wrong, figures = one(server)
            except (OSError, FileNotFoundError) as error:
                wrong, figures = [f"{type(error).__name__}: {error}"], ""
            if one.__name__ != "long" and server.process.poll() is not None:
                wrong.append(f"the server ended with {server.process.returncode}")
            seconds = time.monotonic() - start
        failures += bool(wrong)
        print(f"{'FAILED' if wrong else 'ok    '} {one.__name__}: {'; '.join([*wrong, figures])} ({seconds:.1f} s)", flush=True)
    sys.exit(1 if failures or not attacks else 0)


if __name__ == "__main__":
    main()
