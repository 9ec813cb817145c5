"""Formulas as MathML, made by docutils when the pages are built: no script, nothing is loaded from elsewhere."""

import re
from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx

WORD = re.compile(r"_\{([\w,]{2,})\}")  # indices of several letters are upright


def mathml(latex: str, *, block: bool = False) -> str:
    """A formula."""
    return str(tex2mathml(WORD.sub(r"_{\\text{\1}}", latex), as_block=block))


def formula(translator: Any, node: nodes.Element) -> None:
    """A formula within a line."""
    translator.body.append(mathml(node.astext()))
    raise nodes.SkipNode


def display(translator: Any, node: nodes.Element) -> None:
    """A formula of its own."""
    translator.body.append(f'<div class="math">{mathml(node.astext(), block=True)}</div>')
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the renderer as `html_math_renderer = "mathml"`."""
    app.add_html_math_renderer("mathml", (formula, None), (display, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
