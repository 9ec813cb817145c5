"""Fields of records in the API pages: types, defaults and the comments behind the fields, which hold units and shapes."""

import inspect
import re
from dataclasses import MISSING, fields, is_dataclass
from typing import Any

from sphinx.application import Sphinx

ANY_ARRAY = re.compile(  # as Python writes out `twintube.arrays.Array`
    r"(?:numpy\.)?ndarray\[tuple\[(?:typing\.)?Any, \.\.\.\], "
    r"(?:numpy\.)?dtype\[(?:numpy\.)?floating(?:\[(?:typing\.)?Any\])?\]\]"
)
PREFIX = re.compile(r"\b(?:typing|collections\.abc|twintube(?:\.\w+)*)\.(?=[A-Z])")
COMMENT = re.compile(r"^    (\w+):[^#\n]*(?:#\s*(.*))?$", re.MULTILINE)


def add_fields(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Append the fields of a dataclass to its docstring."""
    if what != "class" or not is_dataclass(obj):
        return
    comments = dict(COMMENT.findall(inspect.getsource(obj)))
    lines += ["", "Fields:", ""]
    for item in fields(obj):
        value = "" if item.default is MISSING else f", default ``{item.default!r}``"
        comment = item.metadata.get("description") or comments.get(item.name, "")
        kind = item.type.__name__ if isinstance(item.type, type) else ANY_ARRAY.sub("Array", str(item.type))
        kind = PREFIX.sub("", kind)
        lines.append(f"* ``{item.name}`` (``{kind}``{value}){': ' + comment if comment else ''}")
    lines.append("")


def shorten(
    app: Sphinx, what: str, name: str, obj: Any, options: Any, signature: str | None, returns: str | None
) -> tuple[str | None, str | None]:
    """Write arrays as `Array`; a record says its fields in a list of their own."""
    if what == "class" and is_dataclass(obj):
        return "", returns
    return tuple(text and ANY_ARRAY.sub("Array", text) for text in (signature, returns))  # type: ignore[return-value]


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the hook."""
    app.connect("autodoc-process-docstring", add_fields)
    app.connect("autodoc-process-signature", shorten)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
