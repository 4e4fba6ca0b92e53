# SPDX-License-Identifier: MIT
"""Links and headers as make_site.py treats them; needs none of the site's packages.

    python3 site_test.py
"""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs/site"))
import make_site  # noqa: E402


class Site(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)
        self.pages = make_site.Pages(self.path / "source", self.path / "extra")

    def test_links_lead_to_the_staged_pages(self):
        for page, text, staged in (
                ("README.md", "[a](docs/tutorial/start.md#top)", "[a](../tutorial/start.md#top)"),
                ("docs/tutorial/start.md", "[a](../../README.md) [b](energy.md)", "[a](../project/readme.md) [b](energy.md)"),
                ("docs/index.md", "[the licence](../LICENSE)", "[the licence](files/LICENSE)"),
                ("README.md", "[`docs`](docs) and `[b](gone.md)`", "`docs` and `[b](gone.md)`"),
                ("README.md", '<img src="docs/images/bunny.png">', '<img src="../files/docs/images/bunny.png">'),
                ("README.md", '<a href="docs/index.md">', '<a href="../index.html">'),
                ("README.md", "```sh\n[a](gone.md)\n```\n[b](#c)", "```sh\n[a](gone.md)\n```\n[b](#c)")):
            self.assertEqual(self.pages.staged(page, text), staged)
        self.assertEqual(self.pages.wrong, [])
        self.assertTrue((self.path / "source/files/LICENSE").is_file())
        self.assertTrue((self.path / "extra/files/docs/images/bunny.png").is_file())

    def test_a_link_to_nothing_is_found(self):
        self.pages.staged("docs/index.md", "[a](gone.md) [b](../gone.txt)")
        self.assertEqual(len(self.pages.wrong), 2)

    def test_broken_links_of_the_site_are_found(self):
        (self.path / "a.html").write_text('<a href="b.html#there"></a><a href="b.html#gone"></a><img src="c.png">'
                                          '<a href="#x" id="x"></a><a href="#y"></a><a href="https://example.org/z"></a>')
        (self.path / "b.html").write_text('<p id="there"></p>')
        self.assertEqual(make_site.broken_links(self.path),
                         ["a.html: #y: no such anchor", "a.html: b.html#gone: no such anchor", "a.html: c.png: no such file"])

    def test_headers_without_what_sphinx_cannot_read(self):
        for header, text in (("namespace sunder {\nint a;\n}  // namespace sunder\n", "\nint a;\n\n"),
                             ("template <class T>\nCounter(int, T C::*) -> Counter<T>;\nint a;", "\nint a;"),
                             ("typedef struct a {\n  int b;\n} a;\ntypedef struct c c;\n", "struct a {\n  int b;\n};\n\n"),
                             ("constexpr auto all = [] {\n  f();\n}();\n", "constexpr auto all;\n")):
            self.assertEqual(make_site.for_sphinx(header), text)

    def test_each_public_header_has_a_page(self):
        names = [name for name, _ in make_site.doors()]
        self.assertIn("simulation", names)
        self.assertEqual(len(names), len(set(names)))


if __name__ == "__main__":
    unittest.main()
