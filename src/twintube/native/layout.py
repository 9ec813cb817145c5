"""Lines of C: comments, and lines that are too long."""

from textwrap import wrap

WIDTH = 120


def remark(text: str) -> list[str]:
    """A text as a comment in C."""
    lines = [line.strip() for line in text.strip().replace("*/", "* /").splitlines()]
    return [
        ("/* " if i == 0 else "   " if line else "") + line + (" */" if i == len(lines) - 1 else "")
        for i, line in enumerate(lines)
    ]


def folded(line: str) -> list[str]:
    """A line of C, cut where it is too long."""
    if len(line) <= WIDTH:
        return [line]
    indent = len(line) - len(line.lstrip())
    return wrap(line, WIDTH, subsequent_indent=" " * (indent + 8), break_long_words=False, break_on_hyphens=False)
