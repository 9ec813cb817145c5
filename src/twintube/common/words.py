"""Texts for messages: nothing from a file reaches a terminal as a control sequence, nothing long floods it."""

import re
import reprlib
from collections.abc import Iterable
from typing import Any

# Control characters but tab and line feed, line separators, what turns the direction of writing, what XML does not allow.
CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u2028\u2029\u202a-\u202e\u2066-\u2069\ud800-\udfff\ufffe\uffff]")
LONGEST = 4000  # characters of a message's line
LONG = 80  # of a name

SHORT = reprlib.Repr()
SHORT.maxlevel, SHORT.maxstring, SHORT.maxother, SHORT.maxlong = 2, LONG, LONG, LONG


def escaped(match: re.Match[str]) -> str:
    """A character as Python writes it, with a backslash."""
    return match.group().encode("unicode_escape").decode("ascii")


def printable(text: str) -> str:
    """The text with control characters written as Python does, and with long lines cut; tabs and line feeds stay."""
    lines = (line if len(line) <= LONGEST else f"{line[:LONGEST]} ... ({len(line)} characters)" for line in text.split("\n"))
    return CONTROL.sub(escaped, "\n".join(lines))


def shown(value: Any) -> str:
    """A value of a file as Python writes it, shortened."""
    try:
        return SHORT.repr(value)
    except ValueError:  # an integer beyond the digits that Python converts
        return "a huge integer"


def counted(number: int, word: str) -> str:
    """`1 error`, `2 errors`."""
    return f"{number} {word}" if number == 1 else f"{number} {word}s"


def short(text: str) -> str:
    """A name, its middle left out where it is long."""
    return text if len(text) <= LONG else f"{text[: LONG // 2]}...{text[-LONG // 2 :]}"


def listed(texts: Iterable[str], most: int = 20) -> str:
    """The first of some names, `a, b, c and 7 more`."""
    names = [short(text) for text in texts]
    rest = len(names) - most
    return ", ".join(names[:most]) + (f" and {rest} more" if rest > 0 else "")


def lower(title: str) -> str:
    """A title inside a sentence; abbreviations such as F-v keep their capitals."""
    return title if title[1:2].isupper() or title[1:2] == "-" else title[0].lower() + title[1:]
