"""The documentation as a site: the pages of this folder as they are, and the docstrings of the library."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE / "_site"), str(HERE.parent / "src")]

project = "heartfit"
copyright = "the heartfit contributors, BSD-3-Clause"
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.apidoc",
    "mathml",
    "navigation",
    "prose",
    "studies",
]
exclude_patterns = ["_site"]
html_theme = "furo"
html_title = "heartfit"
html_static_path = ["_site/static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False
toc_object_entries = (
    False  # the navigation of every page would copy an entry for each function of the library
)

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4

apidoc_modules = [
    {"path": "../src/heartfit", "destination": "api", "separate_modules": False, "max_depth": 1}
]
apidoc_module_first = True
autodoc_default_options = {"members": True, "show-inheritance": True, "member-order": "bysource"}
autodoc_typehints = "signature"
autodoc_preserve_defaults = True

# types of other libraries have no pages here, and none is fetched; type variables, private names and
# aliases have no page at all
nitpick_ignore_regex = [
    ("py:.*", r"(?!heartfit\b).*"),
    ("py:class", r"heartfit\..*\.(_\w+|[A-Z]|Place|Value|Row)"),
]
suppress_warnings = ["ref.python"]  # "slice" is a type, and the name of two fields
