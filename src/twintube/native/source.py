"""A function of a source before it is written in C: its tree, comments and arguments, and where names are first stored."""

import ast
import io
import re
import tokenize
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NoReturn

from twintube.native.kinds import Kind, refuse
from twintube.native.mathematics import MATH, ROUNDED
from twintube.native.terms import Known, quiet

# Words of C, by which nothing can be called.
TAKEN = {
    "auto", "break", "case", "char", "const", "continue", "default", "do", "double", "else", "enum", "extern", "float",
    "for", "goto", "if", "inline", "int", "long", "register", "restrict", "return", "short", "signed", "sizeof", "static",
    "struct", "switch", "typedef", "union", "unsigned", "void", "volatile", "while", "true", "false", "bool",
    *MATH, *ROUNDED,
}  # fmt: skip
UNSAID = re.compile(r"(noqa|fmt|type|pragma)\b")  # of comments that speak to tools


@dataclass(frozen=True)
class Source:
    """A function of a source: its tree, the comments of its file by line, and where it stands."""

    node: ast.FunctionDef
    comments: Mapping[int, tuple[bool, str]]
    path: str


def comments_of(text: str) -> dict[int, tuple[bool, str]]:
    """The comments of a source by line: whether nothing else stands there, and what they say."""
    found = {}
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        said = token.string.lstrip("# ").replace("*/", "* /")
        if token.type == tokenize.COMMENT and not UNSAID.match(said):
            found[token.start[0]] = (token.line.lstrip().startswith("#"), said)
    return found


def arguments_of(source: Source, known: Known) -> tuple[tuple[str, Kind], ...]:
    """Names and types of a function's arguments."""
    given = source.node.args
    if given.vararg or given.kwarg or given.kwonlyargs or given.posonlyargs or given.defaults:
        refuse_at(source, source.node, f"the arguments of `{source.node.name}`: only plain ones")
    found = []
    for argument in given.args:
        kind = known.types.annotated(argument.annotation)
        if argument.arg in TAKEN:
            refuse_at(source, argument, f"argument `{argument.arg}`, a word of C")
        if kind is None or kind.word in ("none", "results"):
            written = ast.unparse(argument.annotation) if argument.annotation else "no type"
            refuse_at(source, argument, f"argument `{argument.arg}` of {written}")
        found.append((argument.arg, kind))
    return tuple(found)


def refuse_at(source: Source, node: ast.AST, what: str) -> NoReturn:
    """Raise SubsetError at a place of a function."""
    refuse(source.path, node, what)


def steady(end: ast.expr, body: Sequence[ast.stmt], constants: Mapping[str, float]) -> bool:
    """Whether the end of a loop is the same in every turn: numbers, constants and names that the loop does not set."""
    stored = {
        item.id for part in body for item in ast.walk(part) if isinstance(item, ast.Name) and isinstance(item.ctx, ast.Store)
    }
    if (
        isinstance(end, ast.Call)
        and isinstance(end.func, ast.Name)
        and end.func.id == "len"
        and isinstance(end.args[0], ast.Name)
    ):
        return end.args[0].id not in stored
    names = {item.id for item in ast.walk(end) if isinstance(item, ast.Name)}
    return quiet(end) and not names & stored


def first_stores(function: ast.FunctionDef) -> Iterator[ast.Name]:
    """The stores at which C may declare a name: the first place of it, above and around all others."""
    seen: dict[str, list[tuple[tuple[int, ...], ast.Name, bool]]] = {}

    def note(node: ast.AST, block: tuple[int, ...], *, direct: bool) -> None:
        for item in in_turn(node):
            seen.setdefault(item.id, []).append((block, item, direct and isinstance(item.ctx, ast.Store)))

    def walk(statements: Sequence[ast.stmt], block: tuple[int, ...]) -> None:
        for statement in statements:
            inside = [part for part in ("body", "orelse") if getattr(statement, part, None)]
            if not inside:
                note(statement, block, direct=True)
                continue
            for name in ("test", "iter"):
                if hasattr(statement, name):
                    note(getattr(statement, name), block, direct=False)
            for part in inside:
                walk(getattr(statement, part), (*block, id(getattr(statement, part))))

    walk(function.body, ())
    for places in seen.values():
        block, first, stored = places[0]
        if stored and all(other[: len(block)] == block for other, _, _ in places):
            yield first


def in_turn(node: ast.AST) -> Iterator[ast.Name]:
    """The names of a statement in the order in which they are used: values before what they are assigned to."""
    match node:
        case ast.Assign(targets=targets, value=value):
            yield from in_turn(value)
            for target in targets:
                yield from in_turn(target)
        case ast.AugAssign(target=ast.Name(id=name) as target, value=value):
            yield ast.Name(name, ast.Load())
            yield from in_turn(value)
            yield target
        case ast.AnnAssign(target=target, value=ast.expr() as value):
            yield from in_turn(value)
            yield from in_turn(target)
        case ast.Name():
            yield node
        case _:
            for child in ast.iter_child_nodes(node):
                yield from in_turn(child)
