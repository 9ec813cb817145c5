"""Sources in the kernel's subset of Python to one C99 text that needs `math.h` only.

The text holds the records, the functions that the entries call, and the constants and helpers that these need. Names begin
with a prefix, functions are static: several such texts, or FMUs, can be parts of one program.
"""

import ast
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from twintube.native.functions import Writer
from twintube.native.kinds import C_NUMBERS, SIZES, STRUCTS, Kind, Member, Types, constant, is_record, read_class, refuse
from twintube.native.source import Source, arguments_of, comments_of, refuse_at
from twintube.native.terms import Function, Known

HELPERS = {
    "max": "double {0}max(double a, double b)\n{{\n    return b > a ? b : a;\n}}",
    "min": "double {0}min(double a, double b)\n{{\n    return b < a ? b : a;\n}}",
    "whole_max": "int64_t {0}whole_max(int64_t a, int64_t b)\n{{\n    return b > a ? b : a;\n}}",
    "whole_min": "int64_t {0}whole_min(int64_t a, int64_t b)\n{{\n    return b < a ? b : a;\n}}",
    "whole_abs": "int64_t {0}whole_abs(int64_t a)\n{{\n    return a < 0 ? -a : a;\n}}",
    # Rounded down as Python does; of a division by zero, which Python refuses, 0.
    "floor_div": "int64_t {0}floor_div(int64_t a, int64_t b)\n{{\n"
    "    return b == 0 ? 0 : a / b - ((a % b != 0) && ((a < 0) != (b < 0)));\n}}",
    "modulo": "int64_t {0}modulo(int64_t a, int64_t b)\n{{\n"
    "    return b == 0 ? 0 : a % b + ((a % b != 0) && ((a < 0) != (b < 0)) ? b : 0);\n}}",
}  # min and max give the first where one is NaN, as Python does


@dataclass(frozen=True)
class Equations:
    """What is translated: sources by their paths, the functions to be called from outside, what their names begin with.

    `alike` are records by the other name under which effects know them. `outer` are functions that are written in C: their
    text by their name, their arguments are those of the function of this name in the sources.
    """

    sources: Mapping[str, str]
    entries: Sequence[str]
    prefix: str = "kernel_"
    alike: Mapping[str, str] = field(default_factory=lambda: {"Frame": "State"})
    outer: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Translation:
    """The C, and of each entry how it is called: `library.py` reads it."""

    text: str
    calls: str


class Reader:
    """The sources of equations as trees: functions, records and constants by name."""

    def __init__(self, equations: Equations) -> None:
        self.equations = equations
        self.types = Types(equations.prefix, {}, {}, equations.alike)
        self.constants: dict[str, float] = {}
        self.several: set[str] = set()
        self.remarks: dict[str, str] = {}
        self.functions: dict[str, Source] = {}
        for path, text in equations.sources.items():
            self.read(path, text)

    def read(self, path: str, text: str) -> None:
        """Take up one source; raises SubsetError where a name has two meanings."""
        comments = comments_of(text)
        for node in ast.parse(text).body:
            match node:
                case ast.FunctionDef():
                    if node.name in self.functions:
                        refuse(path, node, f"`{node.name}`, which is also a function of {self.functions[node.name].path}")
                    self.functions[node.name] = Source(node, comments, path)
                case ast.ClassDef() if is_record(node):
                    read_class(self.types, node, path, self.constants)
                case ast.Assign(targets=[ast.Tuple(elts=targets)], value=ast.Tuple(elts=values)):
                    for target, value in zip(targets, values, strict=False):
                        self.keep(target, value)
                case ast.Assign(targets=[target], value=value):
                    self.keep(target, value)
                    if isinstance(target, ast.Name) and not comments.get(node.lineno, (True, ""))[0]:
                        self.remarks[target.id] = comments[node.lineno][1]

    def keep(self, target: ast.expr, node: ast.expr) -> None:
        """Keep a constant, if it is a number; a name of several values has none for the functions."""
        value = constant(node, self.constants)
        if value is None or not isinstance(target, ast.Name):
            return
        if target.id in self.several or self.constants.get(target.id, value) != value:
            self.several.add(target.id)
            self.constants.pop(target.id, None)
        else:
            self.constants[target.id] = value

    def ordered(self) -> list[str]:
        """The entries and what they call, every function below those that it calls; raises SubsetError on a recursion."""
        done: list[str] = []

        def place(name: str, above: tuple[str, ...]) -> None:
            source = self.functions[name]
            if name in above:
                refuse(source.path, source.node, f"`{name}` calls itself")
            if name in done:
                return
            if name not in self.equations.outer:
                for node in ast.walk(source.node):
                    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in self.functions:
                        place(node.func.id, (*above, name))
            done.append(name)

        for name in self.equations.entries:
            if name not in self.functions:
                raise KeyError(f"no source has the function {name}")
            place(name, ())
        return done


def translated(equations: Equations, *, exported: bool = False) -> Translation:
    """The C of equations; `exported` entries can be called from outside a library. Raises SubsetError."""
    reader = Reader(equations)
    functions: dict[str, Function] = {}
    known = Known(reader.types, reader.constants, functions)
    bodies = []
    for name in reader.ordered():
        source = reader.functions[name]
        result = reader.types.annotated(source.node.returns)
        if result is None or result.whole or (exported and name in equations.entries and result.word == "results"):
            refuse_at(source, source.node, f"the result of `{name}`")
        function = Function(name, arguments_of(source, known), result)
        if name in equations.outer:
            bodies.append(equations.outer[name])
            functions[name] = Function(name, function.arguments, result, frozenset(range(len(function.arguments))))
            continue
        writer = Writer(source, known, function)
        if result.word == "results":
            bodies.append(struct(equations.prefix + name, result_members(result.parts)))
        bodies.append(writer.text(exported=exported and name in equations.entries))
        functions[name] = Function(name, function.arguments, result, writer.written())
    entries = [functions[name] for name in equations.entries]
    text = "\n".join([*head(reader, known, functions.values()), *bodies])
    return Translation(text, "\n".join(call_of(reader.types, entry) for entry in entries))


def result_members(parts: Sequence[Kind]) -> list[str]:
    """The members of a struct of results."""
    return [f"{C_NUMBERS[part.word]} r{i};" for i, part in enumerate(parts)]


def head(reader: Reader, known: Known, functions: Iterable[Function]) -> list[str]:
    """Includes, structs, constants and helpers."""
    types, prefix = reader.types, reader.equations.prefix
    kinds = [kind for function in functions for _, kind in function.arguments]
    bundles = [name for name in types.bundles if any(kind.word == "bundle" and kind.of == name for kind in kinds)]
    kinds += [item.kind for name in bundles for item in types.bundles[name]]
    records = {kind.of for kind in kinds if kind.word in ("record", "records")}
    arrays = {kind for kind in kinds if kind.word == "array"}
    arrays |= {Kind("array", kind.of, rank) for kind in arrays for rank in range(1, kind.rank)}
    parts = ["#include <math.h>\n#include <stdbool.h>\n#include <stdint.h>\n"]
    parts.append("#ifndef M_PI\n#define M_PI 3.14159265358979323846\n#endif\n")
    for kind, name in STRUCTS.items():
        if kind in arrays:
            element = "double" if kind.of == "float" else "int64_t"
            sizes = ", ".join(SIZES[: kind.rank])
            parts.append(struct(prefix + name, [f"{element} *data;", f"int64_t {sizes};"]))
    for name, members in types.records.items():
        if name in records:
            parts.append(struct(prefix + name, [field_of(types, item) for item in members]))
    for name in bundles:
        parts.append(struct(prefix + name, [field_of(types, item) for item in types.bundles[name]]))
    for name, value in reader.constants.items():
        if name in known.used:
            said = f" /* {reader.remarks[name]} */" if name in reader.remarks else ""
            parts.append(
                f"static const {'int64_t' if isinstance(value, int) else 'double'} {prefix}{name} = {value!r};{said}"
            )
    for name, text in HELPERS.items():
        if name in known.used:
            parts.append(f"\nstatic {text.format(prefix)}")
    return [*parts, ""]


def struct(name: str, members: Sequence[str]) -> str:
    """A struct."""
    return "\n".join([f"struct {name} {{", *(f"    {member}" for member in members), "};", ""])


def field_of(types: Types, item: Member) -> str:
    """A member of a struct with what is said of it."""
    said = f" /* {item.says} */" if item.says else ""
    if item.kind.word == "fixed":
        return f"double {item.name}[{item.size}];{said}"
    return f"{types.c_name(item.kind)}{item.name};{said}"


def call_of(types: Types, function: Function) -> str:
    """How an entry is called: its result, its name and for each argument name and type, `!` behind one that is changed."""
    words = [function.result.word, types.prefix + function.name]
    for i, (name, kind) in enumerate(function.arguments):
        words.append(f"{name}:{code(types, kind)}{'!' if i in function.writes else ''}")
    return " ".join(words)


def code(types: Types, kind: Kind) -> str:
    """A type in a few letters: `float`, `record1000` of as many bytes, `float2` an array of two directions."""
    match kind.word:
        case "record" | "records":
            return f"{kind.word}{8 * sum(item.size for item in types.records[kind.of])}"
        case "bundle":
            return f"({','.join(code(types, item.kind) for item in types.bundles[kind.of])})"
        case "array":
            return f"{kind.of}{kind.rank}"
    return kind.word


def guarded(text: str, name: str) -> str:
    """A text as a header."""
    guard = re.sub(r"\W", "_", name).upper()
    return f"#ifndef {guard}\n#define {guard}\n\n{text}\n#endif\n"
