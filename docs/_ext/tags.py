"""From the tags `Eq. n` in the kernel to the lines that carry out each equation; needs the standard library only."""

import ast
import re
from collections import defaultdict
from dataclasses import dataclass
from functools import cache
from pathlib import Path

KERNEL = Path(__file__).parents[2] / "src" / "twintube" / "core" / "kernel"
FILES = ("forces", "prepare", "rebound", "compression", "step")
TAG = re.compile(r"Eq\. (\d+(?:-\d+)?(?:(?:, | and )\d+(?:-\d+)?)*)")
LONGEST = 12  # lines of an excerpt


@dataclass(frozen=True)
class Place:
    """Where a file of the kernel names an equation; `end` is the last line of the excerpt."""

    file: str
    line: int
    end: int

    @property
    def text(self) -> str:
        """The lines of the excerpt, without their common indentation."""
        lines = source(self.file)[self.line - 1 : self.end]
        common = min(indent(line) for line in lines if line.strip())
        return "\n".join(line[common:] for line in lines)


@cache
def source(file: str) -> list[str]:
    """The lines of a file of the kernel."""
    return (KERNEL / f"{file}.py").read_text(encoding="utf-8").splitlines()


def numbers(text: str) -> list[int]:
    """The numbers of `14, 15 and 27-29`, in their order."""
    found: list[int] = []
    for first, last in re.findall(r"(\d+)(?:-(\d+))?", text):
        found += range(int(first), int(last or first) + 1)
    return found


def indent(line: str) -> int:
    """Blanks at the beginning of a line."""
    return len(line) - len(line.lstrip())


def excerpt_end(file: str, line: int) -> int:
    """The last line of the statements that follow the comment at `line`, or of the function whose docstring it is."""
    lines = source(file)
    first = lines[line - 1]
    if not first.lstrip().startswith("#"):
        return line
    end = line
    while end < min(len(lines), line + LONGEST - 1):
        after = lines[end]
        is_comment = after.lstrip().startswith("#")
        code_began = not lines[end - 1].lstrip().startswith("#")
        if not after.strip() or indent(after) < indent(first) or (is_comment and code_began):
            break
        end += 1
    return end - lines[end - 1].endswith(":")


def docstrings(file: str) -> dict[int, int]:
    """For every line of a function's docstring the line of its `def`."""
    found: dict[int, int] = {}
    for node in ast.walk(ast.parse("\n".join(source(file)))):
        if isinstance(node, ast.FunctionDef) and ast.get_docstring(node) is not None:
            text = node.body[0]
            found |= dict.fromkeys(range(text.lineno, (text.end_lineno or text.lineno) + 1), node.lineno)
    return found


@cache
def places() -> dict[int, list[Place]]:
    """The places of every equation, file by file, each once."""
    found: dict[int, list[Place]] = defaultdict(list)
    for file in FILES:
        functions = docstrings(file)
        for line, text in enumerate(source(file), 1):
            for match in TAG.finditer(text):
                begin = functions.get(line, line)
                end = line if line in functions else excerpt_end(file, line)
                for number in numbers(match[1]):
                    place = Place(file, begin, end)
                    if place not in found[number]:
                        found[number].append(place)
    return dict(found)
