# SPDX-License-Identifier: MIT
"""Refusals and reports of readme_lines.py, on pages that the test writes.

    python3 readme_lines_test.py
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent

SERVER = """import http.server, os, signal, sys
signal.signal(signal.SIGINT, lambda *_: sys.exit(int(sys.argv[1])))
os.chdir(sys.argv[2])
class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_): pass
server = http.server.HTTPServer(("127.0.0.1", 0), Quiet)
print(f"http://127.0.0.1:{server.server_port}/#token=1", flush=True)
server.serve_forever()
"""


def block(after, *lines, kind="sh"):
    return "\n".join([f"<!-- after: {after} -->", f"```{kind}", *lines, "```", ""])


class ReadmeLines(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        self.addCleanup(self.folder.cleanup)

    def run_page(self, page, *options):
        (self.path / "page.md").write_text(page)
        return subprocess.run([sys.executable, "-B", HERE / "readme_lines.py", "--readme",
                               self.path / "page.md", "--build", self.path, *options],
                              capture_output=True, text=True, timeout=120, check=False)

    def assert_refused(self, page, *words):
        done = self.run_page(page, "--check")
        self.assertEqual(done.returncode, 2, done.stdout)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_rules_of_the_page(self):
        self.assert_refused("```sh\ntrue\n```\n", "page.md, line 1", "names one of the set-ups")
        self.assert_refused("<!-- after: git clone -->\n\nwords\n\n```sh\n./bootstrap run\n```\n",
                            "names one of the set-ups")
        self.assert_refused(block("apt install cowsay", "true"), "names one of the set-ups")
        self.assert_refused(block("./bootstrap run", "true", kind="text"), "line 2", "is not run")
        self.assert_refused(block("./bootstrap run", "true", "sunder run SCENE"), "line 4: SCENE")
        self.assert_refused(block("./bootstrap run", "echo 'half"), "line 3")
        self.assert_refused(block("git clone", "make"), "line 3", "./bootstrap")
        self.assert_refused("nothing here\n", "nothing to run")
        self.assertEqual(self.run_page(block("./bootstrap run", "echo README.md # SCENE"),
                                       "--check").returncode, 0)

    def test_lines_share_variables_and_a_folder(self):
        page = (block("git clone", "./bootstrap run")
                + block("./bootstrap run", "S=printf", "", "$S 1 >out/one  # writes")
                + block("./bootstrap all", "test 1 = \\", '  "$(cat out/one)"'))
        done = self.run_page(page)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(len(done.stdout.splitlines()), 3)
        scratch = self.path / "scratch"
        for after in ("./bootstrap run", "./bootstrap all"):
            done = self.run_page(page, "--after", after, "--scratch", scratch)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(len(done.stdout.splitlines()), 2)

    def test_a_failing_line(self):
        for line, code in (("sh -c 'echo because; exit 7'", 7), ("false; true", 1), ("false | cat", 1),
                           ("cat nowhere", 1)):
            done = self.run_page(block("./bootstrap run", line, "echo after"))
            self.assertEqual(done.returncode, 1)
            row = next(row for row in done.stdout.splitlines() if row.endswith(line))
            self.assertEqual(row.split()[3], str(code))
            self.assertIn("echo after", done.stdout)  # the others are run all the same
        self.assertIn("No such file", done.stdout)
        done = self.run_page(block("./bootstrap run", "echo 'error: why'; seq 30; exit 4"))
        self.assertRegex(done.stdout, r"\| error: why\n +\| 21\n")

    def test_a_warning(self):
        done = self.run_page(block("./bootstrap run", "echo 'warning: slender' >&2"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("| warning: slender", done.stdout)
        for line in ("echo main.cpp:3:4: warning: unused", "echo 'CMake Deprecation Warning at'"):
            self.assertEqual(self.run_page(block("./bootstrap run", line)).returncode, 1)
        done = self.run_page(block("./bootstrap run", "echo 'ends with 7 on a warning: one that counts'"))
        self.assertEqual(done.returncode, 0)

    def test_blocks_that_do_not_run(self):
        self.assert_refused("<!-- not run: -->\n```sh\ntrue\n```\n", "names one of the set-ups")
        self.assert_refused("<!-- not run: because -->\n```sh\ntrue\n```\n", "a reason belongs")
        done = self.run_page("<!-- not run: needs another machine -->\n```sh\nfalse\n```\n")
        self.assertEqual((done.returncode, len(done.stdout.splitlines())), (0, 1), done.stderr)
        done = self.run_page(block("./bootstrap run, with no_such_program", "false"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("no no_such_program", done.stdout)
        self.assert_refused(block("./bootstrap run, maybe", "true"), "names one of the set-ups")

    def test_blocks_that_are_written(self):
        page = ("<!-- file: out/a/scene.json -->\n```json\n{\"duration\": 3}\n```\n\n"
                + block("./bootstrap run", "grep '\"duration\": 3}' out/a/scene.json"))
        self.assertEqual(self.run_page(page).returncode, 0)
        self.assertEqual(self.run_page(page, "--quick").returncode, 1)  # a scene that ends early

    def test_warnings_and_exit_codes_that_are_announced(self):
        self.assertEqual(self.run_page(block("./bootstrap run, warns", "echo 'warning: slender'")).returncode, 0)
        for code, expected in ((3, 0), (4, 1), (0, 1)):
            line = f"sh -c 'exit {code}'  # ends with exit code 3"
            self.assertEqual(self.run_page(block("./bootstrap run", line)).returncode, expected, code)

    def test_the_readers_own_files(self):
        line = "cmp body.msh meshes/ball.msh && cmp mesh.msh body.msh && grep body.msh scene.json"
        self.assertEqual(self.run_page(block("./bootstrap run", line)).returncode, 0)

    def test_quick_leaves_out_long_lines_and_their_readers(self):
        page = block("./bootstrap run", "echo 1 >out/one  # a minute", "cat out/one", "echo short",
                     "cat out/bunny/report.json", "cat meshes/scenes/bar.json")
        done = self.run_page(page, "--quick")
        rows = done.stdout.splitlines()
        self.assertIn("long", rows[2])
        self.assertIn("needs line 3", rows[3])
        self.assertIn(" 0 ", rows[4])
        # With --quick every scene ends early.
        page = block("./bootstrap run", "grep '\"duration\": 0.05,' meshes/scenes/bar.json  # a minute")
        self.assertEqual(self.run_page(page, "--quick").returncode, 0)
        self.assertEqual(self.run_page(page).returncode, 1)

    def test_a_line_that_serves_a_page(self):
        (self.path / "server.py").write_text(SERVER)
        site = self.path / "site"
        site.mkdir()
        (site / "index.html").write_text('<script src="main.js"></script>')
        line = f"{sys.executable} {self.path}/server.py %d {site}  # ends with Ctrl-C"
        os.environ["DISPLAY"] = ":7"  # no line sees it
        self.addCleanup(os.environ.pop, "DISPLAY")
        done = self.run_page(block("./bootstrap run", 'test -z "$DISPLAY"', line % 0))
        self.assertEqual(done.returncode, 1)
        self.assertIn("404", done.stdout)
        (site / "main.js").write_text("1;")
        done = self.run_page(block("./bootstrap run", 'test -z "$DISPLAY"', line % 0))
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(self.run_page(block("./bootstrap run", line % 3)).returncode, 1)
        done = self.run_page(block("./bootstrap run", "true  # ends with Ctrl-C"))
        self.assertIn("no address", done.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=1)
