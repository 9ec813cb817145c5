"""What expressions of C are made of: terms with type and binding, and what a function's text may refer to."""

import ast
from collections.abc import Mapping
from dataclasses import dataclass, field

from twintube.native.kinds import FLOAT, INT, Kind, Types

# How tightly C binds: an operand that binds less is put in brackets.
CHOICE, OR, AND, COMPARED, SUM, PRODUCT, UNARY, ATOM = range(1, 9)


@dataclass(frozen=True)
class Function:
    """A function as callers see it; `writes` are the numbers of the arguments that it changes."""

    name: str
    arguments: tuple[tuple[str, Kind], ...]
    result: Kind
    writes: frozenset[int] = frozenset()


@dataclass
class Known:
    """What a function's text may refer to; helpers of C that it needs are noted in `used`."""

    types: Types
    constants: Mapping[str, float]
    functions: Mapping[str, Function]
    used: set[str] = field(default_factory=set)


@dataclass(frozen=True)
class Term:
    """An expression in C: its text, its type, and how tightly its outermost operator binds."""

    text: str
    kind: Kind
    level: int = ATOM

    def within(self, level: int) -> str:
        """The text as an operand of an operator of a level."""
        return self.text if self.level >= level else f"({self.text})"


def number(value: float) -> Term:
    """A number as C writes it: all its digits, and a sign in brackets."""
    kind = INT if isinstance(value, int) else FLOAT
    text = repr(value) if kind == INT or "inf" not in repr(value) else repr(value).replace("inf", "INFINITY")
    return Term(text, kind, UNARY if value < 0 else ATOM)


def quiet(node: ast.expr) -> bool:
    """Whether an expression is of local numbers alone."""
    return not any(isinstance(item, ast.Attribute | ast.Subscript | ast.Call) for item in ast.walk(node))
