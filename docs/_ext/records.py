"""Fields of records in the API pages: types, defaults and the comments behind the fields, which hold units and shapes."""

import inspect
import re
from dataclasses import MISSING, fields, is_dataclass
from typing import Any

from sphinx.application import Sphinx

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
        kind = item.type if isinstance(item.type, str) else getattr(item.type, "__name__", str(item.type))
        kind = kind if kind.isidentifier() else str(item.type).replace("typing.", "")
        lines.append(f"* ``{item.name}`` (``{kind}``{value}){': ' + comment if comment else ''}")
    lines.append("")


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the hook."""
    app.connect("autodoc-process-docstring", add_fields)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
