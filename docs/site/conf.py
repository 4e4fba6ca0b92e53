# SPDX-License-Identifier: MIT
# The site's settings for Sphinx. make_site.py calls it, with the folder of doxygen's XML in SUNDER_DOXYGEN.
import os
import re
import pathlib

PROJECT = pathlib.Path(__file__).resolve().parents[2]

project = "Sunder"
copyright = "the authors of Sunder, MIT licence"
release = re.search(r"VERSION (\d+\.\d+\.\d+)", (PROJECT / "CMakeLists.txt").read_text())[1]
extensions = ["myst_parser", "sphinx.ext.graphviz", "sphinx.ext.mathjax", "sphinx_copybutton", "breathe"]
root_doc = "index"
source_suffix = {".md": "markdown"}

myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 4
myst_dmath_allow_digits = False  # 5$ and $x are no formulas
suppress_warnings = ["myst.header"]  # headings that skip a level

# Formulas are drawn by KaTeX from the site's own files.
mathjax_path = "render_math.js"

breathe_projects = {"sunder": os.environ["SUNDER_DOXYGEN"]}
breathe_default_project = "sunder"
breathe_default_members = ("members", "undoc-members")

graphviz_output_format = "svg"

html_theme = "furo"
html_title = f"Sunder {release}"
html_static_path = [str(PROJECT / "docs/site/static"), os.environ["SUNDER_STATIC"]]
html_css_files = ["site.css"]
html_extra_path = [os.environ["SUNDER_EXTRA"]]
html_copy_source = False
html_show_sphinx = False
pygments_style = "friendly"
copybutton_exclude = ".linenos, .gp"
