"""A user's files, opened with bounds: regular files of limited size, TOML of limited depth and length of names.

Writing is in files.py.
"""

import codecs
import re
import stat
import tomllib
from pathlib import Path
from typing import Any

from twintube.common.words import CONTROL, shown

MB = 1_000_000
TOML_BYTES = 1 * MB
TOML_DEPTH = 8  # tables and lists within each other
TOML_NAME = 200  # characters of a key
DOTTED = 16  # parts of a key `a.b.c`; the parser takes quadratic time
LARGEST_INTEGER = 2**63 - 1  # as TOML says
STRING = re.compile(r'"(?:[^"\\]|\\.)*"|\'[^\']*\'')


class ReadError(ValueError):
    """A file that cannot be read; the message is one line without the file's name."""


def check_regular(path: Path, most: int) -> None:
    """Raise ReadError unless the path is a regular file of at most `most` bytes; a missing file raises OSError."""
    if CONTROL.search(str(path)):
        raise ReadError("the name of the file holds a control character")
    status = path.stat()
    if stat.S_ISDIR(status.st_mode):
        raise ReadError("it is a folder, not a file")
    if not stat.S_ISREG(status.st_mode):
        raise ReadError("it is a pipe or a device, not a regular file")
    if status.st_size > most:
        raise ReadError(f"it has {status.st_size / MB:.0f} MB, at most {most / MB:.0f} MB are read")


def read_toml(path: Path) -> tuple[dict[str, Any], str]:
    """Content and text of a TOML file; raises ReadError and OSError."""
    check_regular(path, TOML_BYTES)
    try:
        with path.open("rb") as file:
            utf_16 = file.read(2) in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
        text = path.read_text(encoding="utf-16" if utf_16 else "utf-8-sig")
    except UnicodeDecodeError as error:
        row = error.object[: error.start].count(b"\n") + 1
        raise ReadError(f"line {row}: not a text in UTF-8") from error
    for number, line in enumerate(text.splitlines(), start=1):
        if any(part.count(".") > DOTTED for part in re.split(r"[=,\[\]{}]", STRING.sub("", line)) if len(part) > DOTTED):
            raise ReadError(f"line {number}: a key of more than {DOTTED} parts")
    try:
        content = tomllib.loads(text)
    except RecursionError as error:
        raise ReadError(f"more than {TOML_DEPTH} tables and lists within each other") from error
    except ValueError as error:  # the parser's own, and Python's about integers of thousands of digits
        raise ReadError(" ".join(str(error).split())) from error
    check_content(content)
    return content, text


def check_content(content: dict[str, Any]) -> None:
    """Raise ReadError where names are too long, levels too many, numbers too large or texts hold control characters."""
    waiting: list[tuple[str, Any, int]] = [("", content, 0)]
    while waiting:
        where, value, depth = waiting.pop()
        if depth > TOML_DEPTH:
            raise ReadError(f"{where}: more than {TOML_DEPTH} tables and lists within each other")
        if isinstance(value, dict):
            for key, item in value.items():
                if len(key) > TOML_NAME or CONTROL.search(key):
                    raise ReadError(f"key {shown(key)}: must have at most {TOML_NAME} characters and no control character")
                waiting.append((key, item, depth + 1))
        elif isinstance(value, list):
            waiting += [(where, item, depth + 1) for item in value]
        elif isinstance(value, str) and CONTROL.search(value):
            raise ReadError(f"{where} = {shown(value)}: must not hold control characters")
        elif isinstance(value, int) and abs(value) > LARGEST_INTEGER:
            raise ReadError(f"{where}: an integer of more than 64 bits")
