"""Fields of records in the API pages: types, defaults and the comments behind the fields, which hold units and shapes."""

import inspect
import re
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, TypeVar

from numpy.typing import ArrayLike
from sphinx.application import Sphinx
from sphinx.util.typing import stringify_annotation

from twintube.common.arrays import Array

MODES = ("fully-qualified-except-typing", "fully-qualified", "smart")
NAMED = {"Array": Array, "ArrayLike": ArrayLike}
# Types as autodoc writes them out, and the names that the code uses.
WRITTEN = {stringify_annotation(kind, mode): name for name, kind in NAMED.items() for mode in MODES}
PREFIX = re.compile(r"\b(?:typing|collections\.abc|twintube(?:\.\w+)*)\.(?=[A-Z])")
COMMENT = re.compile(r"^    (\w+):[^#\n]*(?:#\s*(.*))?$", re.MULTILINE)


def named(text: str) -> str:
    """The types of arrays by their names."""
    for written, name in WRITTEN.items():
        text = text.replace(written, name)
    return text


def described(metadata: Any) -> str:
    """`damper force [N]` of a variable of the table."""
    return f"{metadata['description']} [{metadata['unit']}]" if "description" in metadata else ""


def add_fields(  # noqa: PLR0917 - as Sphinx calls it
    app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]
) -> None:
    """Append the fields of a dataclass to its docstring."""
    if what != "class" or not is_dataclass(obj):
        return
    comments = dict(COMMENT.findall(inspect.getsource(obj)))
    lines += ["", "Fields:", ""]
    for item in fields(obj):
        value = "" if item.default is MISSING else f", default ``{item.default!r}``"
        comment = described(item.metadata) or comments.get(item.name, "")
        # Fields of the table of outputs are arrays in a simulation.
        kind = (
            "Array"
            if isinstance(item.type, TypeVar)
            else PREFIX.sub("", named(item.type if isinstance(item.type, str) else stringify_annotation(item.type)))
        )
        lines.append(f"* ``{item.name}`` (``{kind}``{value}){': ' + comment if comment else ''}")
    lines.append("")


def shorten(  # noqa: PLR0917 - as Sphinx calls it
    app: Sphinx, what: str, name: str, obj: Any, options: Any, signature: str | None, returns: str | None
) -> tuple[str | None, str | None]:
    """Write arrays as `Array`; a record says its fields in a list of their own."""
    if what == "class" and is_dataclass(obj):
        return "", returns
    return signature and named(signature), returns and named(returns)


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the hook."""
    app.connect("autodoc-process-docstring", add_fields)
    app.connect("autodoc-process-signature", shorten)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
