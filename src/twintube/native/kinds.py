"""Types of the kernel's subset of Python, and what they are in C.

A record is a dataclass of numbers (`core/variables.py`) and becomes a struct with the layout of the aligned structured dtype
of numpy; a bundle is a NamedTuple of arrays and numbers. Arrays are C-contiguous; a row of one is an array again.
"""

import ast
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NoReturn


class SubsetError(SyntaxError):
    """A source leaves the subset; the message names file and line."""


@dataclass(frozen=True)
class Kind:
    """A type; `of` is the record, the bundle, or the type of an array's elements."""

    word: str  # float | int | bool | none | record | records | fixed | array | bundle | results
    of: str = ""
    rank: int = 0
    parts: tuple["Kind", ...] = ()

    @property
    def number(self) -> bool:
        """Whether it is a whole or a real number."""
        return self.word in ("float", "int")

    @property
    def whole(self) -> bool:
        """Whether values are reached by reference."""
        return self.word in ("record", "records", "fixed", "array", "bundle")


FLOAT, INT, BOOL, NONE = Kind("float"), Kind("int"), Kind("bool"), Kind("none")
C_NUMBERS = {"float": "double", "int": "int64_t", "bool": "bool"}
# Names of `common/arrays.py`.
ARRAYS = {
    "Vector": Kind("array", "float", 1),
    "Table": Kind("array", "float", 2),
    "Stack": Kind("array", "float", 3),
    "Counts": Kind("array", "int", 1),
    "Addresses": Kind("array", "int", 2),
}
STRUCTS = {kind: name.lower() for name, kind in ARRAYS.items()}
FOLDED = {"math": math, "abs": abs, "min": min, "max": max}  # of what may stand in a constant
SIZES = ("rows", "columns", "layers")


@dataclass(frozen=True)
class Member:
    """A field of a record or a bundle; `size` is above 1 for an array inside a record."""

    name: str
    kind: Kind
    size: int = 1
    says: str = ""


@dataclass(frozen=True)
class Types:
    """Records and bundles by their names; `alike` are names for one that has another."""

    prefix: str
    records: dict[str, tuple[Member, ...]]
    bundles: dict[str, tuple[Member, ...]]
    alike: Mapping[str, str]

    def named(self, name: str) -> Kind | None:
        """The type of a name, if it is one."""
        name = self.alike.get(name, name)
        if name in self.records:
            return Kind("record", name)
        if name in self.bundles:
            return Kind("bundle", name)
        return {"float": FLOAT, "int": INT, "bool": BOOL, "T": FLOAT, **ARRAYS}.get(name)

    def annotated(self, node: ast.expr | None) -> Kind | None:  # noqa: PLR0911 - a return for each kind
        """The type that an annotation says, if it is one of the subset."""
        match node:
            case None | ast.Constant(value=None):
                return NONE
            case ast.Constant(value=str(text)):
                return self.annotated(ast.parse(text, mode="eval").body)
            case ast.Name(id=name) | ast.Attribute(attr=name):
                return self.named(name)
            case ast.Subscript(value=ast.Name(id="tuple"), slice=ast.Tuple(elts=[ast.Name(id="float"), ast.Constant()])):
                return Kind("fixed", "float")
            case ast.Subscript(value=ast.Name(id="tuple"), slice=ast.Tuple(elts=elements)):
                parts = [self.annotated(element) for element in elements]
                known = tuple(part for part in parts if part is not None and part.word in C_NUMBERS)
                return Kind("results", parts=known) if len(known) == len(parts) else None
            case ast.Subscript(value=ast.Name(id="Sequence"), slice=ast.Name() as of):
                kind = self.annotated(of)
                return Kind("records", kind.of) if kind is not None and kind.word == "record" else None
        return None

    def c_name(self, kind: Kind, function: str = "") -> str:  # noqa: PLR0911 - a return for each kind
        """A type in C, ready for a name behind it; `function` is whose results a struct holds."""
        match kind.word:
            case "record" | "records":
                return f"struct {self.prefix}{kind.of} *"
            case "bundle":
                return f"const struct {self.prefix}{kind.of} *"
            case "fixed":
                return "const double *"
            case "array":
                return f"struct {self.prefix}{STRUCTS[kind]} "
            case "results":
                return f"struct {self.prefix}{function} "
            case "none":
                return "void "
        return f"{C_NUMBERS[kind.word]} "

    def members(self, kind: Kind) -> dict[str, Member]:
        """The fields of a record or a bundle by name."""
        table = self.bundles if kind.word == "bundle" else self.records
        return {member.name: member for member in table[kind.of]}


def refuse(path: str, node: ast.AST, what: str) -> NoReturn:
    """Raise SubsetError at a place of a source."""
    raise SubsetError(f"{path}:{getattr(node, 'lineno', 0)}: {what}: not in the subset that C is made of")


def read_class(types: Types, node: ast.ClassDef, path: str, constants: Mapping[str, float]) -> None:
    """Add the record or bundle that a class is; one that has its name as base goes on where that ends, as effects' do."""
    bases = [types.alike.get(name, name) for base in node.bases if (name := last_name(base)) is not None]
    inherited: list[Member] = []
    for base in reversed(bases):  # as dataclasses order them
        inherited += types.records.get(base, ())
    own = tuple(
        member(types, item, path, constants)
        for item in node.body
        if isinstance(item, ast.AnnAssign) and isinstance(item.target, ast.Name)
    )
    name = types.alike.get(node.name, node.name)
    if "NamedTuple" in bases:
        types.bundles[name] = own
    else:
        types.records[name] = (*inherited, *own)


def is_record(node: ast.ClassDef) -> bool:
    """Whether a class holds numbers or arrays: a NamedTuple, or a dataclass whose fields are of the table of variables."""
    values = [item.value for item in node.body if isinstance(item, ast.AnnAssign)]
    described = all(isinstance(v, ast.Call) and last_name(v.func) == "var" for v in values)
    return "NamedTuple" in map(last_name, node.bases) or (bool(node.decorator_list) and described)


def member(types: Types, item: ast.AnnAssign, path: str, constants: Mapping[str, float]) -> Member:
    """A field of a record or bundle with what its description says."""
    assert isinstance(item.target, ast.Name)
    kind = types.annotated(item.annotation)
    if kind is None or kind.word not in ("float", "int", "fixed", "array"):
        refuse(path, item, f"field {item.target.id} of type {ast.unparse(item.annotation)}")
    if not isinstance(item.value, ast.Call):
        return Member(item.target.id, kind)
    size = next((word.value for word in item.value.keywords if word.arg == "size"), ast.Constant(1))
    values = [str(argument.value) for argument in item.value.args if isinstance(argument, ast.Constant)]
    says = f"[{values[2]}] {values[3]}" if values[2] != "1" else values[3]
    return Member(item.target.id, kind, int(constant(size, constants) or 1), says)


def last_name(node: ast.expr) -> str | None:
    """`Parameters` of `variables.Parameters` or `Generic[T]`'s `Generic`."""
    match node:
        case ast.Name(id=name) | ast.Attribute(attr=name) | ast.Subscript(value=ast.Name(id=name)):
            return name
        case ast.Call(func=function):
            return last_name(function)
    return None


def constant(node: ast.expr, constants: Mapping[str, float]) -> float | None:
    """The value of an expression of numbers and constants, computed by Python; None where it is none."""
    for part in ast.walk(node):
        match part:
            case ast.Name(id=name) if name not in constants and name not in FOLDED:
                return None
            case ast.Attribute(value=ast.Name(id="math")) | ast.Name() | ast.Constant(value=int() | float()):
                continue
            case ast.BinOp() | ast.UnaryOp() | ast.operator() | ast.unaryop() | ast.expr_context() | ast.Call():
                continue
        return None
    code = compile(ast.fix_missing_locations(ast.Expression(node)), "<constant>", "eval")
    value = eval(code, {"__builtins__": {}, **FOLDED, **constants})
    return value if type(value) in (int, float) else None
