"""Documentation: `python -m sphinx -b html -W --keep-going docs build/docs`."""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_ext"))

import tables

from twintube import __version__

project, author = "twintube", "the twintube authors"
version = release = __version__
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinx_gallery.gen_gallery",
    "commands",
    "equations",
    "mathml",
    "records",
]
exclude_patterns = ["_ext", "_templates", "gallery"]

myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_heading_anchors = 4
highlight_language = "text"

autodoc_default_options = {"members": True, "exclude-members": "__new__"}
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
default_role = "code"
autosummary_generate = True

sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "examples",
    "filename_pattern": "/",
    "within_subsection_order": "FileNameSortKey",
    "abort_on_example_error": True,
    "capture_repr": (),
    "download_all_examples": False,
    "plot_gallery": True,
    "remove_config_comments": True,
    "reset_modules": ("matplotlib", "gallery_style.reset"),
    "notebook_extensions": {},
    "show_memory": False,
    "show_signature": False,
    "write_computation_times": False,
}

templates_path = ["_templates"]

html_theme = "furo"
html_title = f"twintube {version}"
html_static_path = ["_static"]
html_css_files = ["style.css"]
html_js_files = ["access.js"]
html_math_renderer = "mathml"
html_show_copyright = False
html_show_sphinx = False
html_copy_source = False
html_show_sourcelink = False


def adapt(app: object, name: str, text: list[str]) -> None:
    """Tables of the code."""
    text[0] = tables.written(text[0])


def setup(app: object) -> None:
    """Called by Sphinx."""
    app.connect("source-read", adapt)  # type: ignore[attr-defined]
