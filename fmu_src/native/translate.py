"""The equations in C99: the sources of kernel, effects and model, joined, typed and translated by pyccel.

Developers run `python -m fmu_src.native.translate` after a change of the equations; it needs pyccel (and the gfortran that
its installation asks for). The C that it writes is committed, so that users need neither.

pyccel writes readable C of scalars and records that needs `math.h` only, but takes arrays from a header library of some
thousand lines. The kernel only reads the F-v curve, so `subset.h` stands in for that library with what is used of it.
"""

import ast
import hashlib
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path

from twintube import effects
from twintube.compiled import PACKAGE, SOURCES
from twintube.variables import FV_POINTS, Derived, Flow

FOLDER = Path(__file__).parent
MODULE = "kernel"
MODEL = "model.py"
RECORDS = {"Parameters": effects.Parameters, "Derived": Derived, "State": effects.State, "Flow": Flow}
ARGUMENTS = {"p": "Parameters", "d": "Derived", "s": "State", "f": "Flow"}
ENTRIES = ("set_up", "start", "advance")  # what the wrapper calls
INTEGERS = ("effects_active", "effects_parts")  # of the functions made from the effects' files, what returns an int


def record_source(name: str, record: type) -> str:
    """A record as the class with a typed `__init__` that pyccel wants; arrays are handed in, the rest starts at 0."""
    arrays = [item.name for item in fields(record) if item.metadata["size"] > 1]
    arguments = "".join(f", {item}: 'float[:]'" for item in arrays)
    lines = [f"class {name}:", f"    def __init__(self: '{name}'{arguments}):"]
    for item in fields(record):
        start = item.name if item.name in arrays else "0" if item.metadata["integer"] else "0.0"
        lines.append(f"        self.{item.name} = {start}")
    return "\n".join(lines)


def signature(node: ast.FunctionDef) -> str:
    """The first line of a function with the types that pyccel needs; those of the records go by the arguments' names."""
    arguments = []
    for argument in node.args.args:
        written = ast.unparse(argument.annotation) if argument.annotation else "float"
        kind = ARGUMENTS.get(argument.arg, written.replace("list[float]", "float[:]"))
        arguments.append(f"{argument.arg}: {kind!r}")
    returned = ast.unparse(node.returns) if node.returns else "None"
    if node.name.startswith("effects_"):
        returns = any(isinstance(item, ast.Return) and item.value is not None for item in ast.walk(node))
        returned = ("int" if node.name in INTEGERS else "float") if returns else "None"
    arrow = "" if returned == "None" else f" -> {returned!r}"
    return f"def {node.name}({', '.join(arguments)}){arrow}:"


def functions(text: str) -> dict[str, str]:
    """The functions of a source by name: typed, with its constants in place of their names, comments kept.

    pyccel would make global variables of the constants.
    """
    body = ast.parse(text).body
    values: dict[str, float] = {"FV_POINTS": FV_POINTS}
    for node in body:
        match node:
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.Constant(value=int() | float() as value)):
                values[name] = value
    lines = text.splitlines()
    found = {}
    for node in body:
        if isinstance(node, ast.FunctionDef):
            inside = "\n".join(lines[node.body[0].lineno - 1 : node.end_lineno])
            for name, value in values.items():
                inside = re.sub(rf"\b{name}\b", repr(value), inside)
            found[node.name] = f"{signature(node)}\n{inside}"
    return found


def ordered(found: dict[str, str], entries: Sequence[str]) -> list[str]:
    """The entries and what they call, every function below those that it calls; raises ValueError on a recursion."""
    done: list[str] = []

    def place(name: str, above: tuple[str, ...]) -> None:
        if name in above:
            raise ValueError(f"{name} calls itself")
        if name not in done:
            for node in ast.walk(ast.parse(found[name])):
                if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in found:
                    place(node.func.id, (*above, name))
            done.append(name)

    for name in entries:
        place(name, ())
    return done


def joined_source() -> str:
    """One typed module of all equations, as pyccel reads it."""
    texts = [(PACKAGE / name).read_text(encoding="utf-8") for name in SOURCES]
    texts += [*effects.sources().values(), effects.dispatch_source(), effects.reset_source()]
    texts.append((PACKAGE / MODEL).read_text(encoding="utf-8"))
    found: dict[str, str] = {}
    for text in texts:
        found |= functions(text)
    parts = ["import math", *(record_source(name, record) for name, record in RECORDS.items())]
    parts += [found[name] for name in ordered(found, ENTRIES)]
    return "\n\n\n".join(parts) + "\n"


def digest() -> str:
    """Of the joined source; stands in the translated file, so that a test sees whether it is current."""
    return hashlib.sha256(joined_source().encode()).hexdigest()[:16]


def translated() -> str:
    """The text of `kernel.h`; raises RuntimeError with what pyccel says."""
    pyccel = shutil.which("pyccel", path=str(Path(sys.executable).parent)) or shutil.which("pyccel")
    if pyccel is None:
        raise RuntimeError("pyccel is not installed: pip install pyccel (its installation needs gfortran)")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / f"{MODULE}.py").write_text(joined_source(), encoding="utf-8")
        done = subprocess.run(
            [pyccel, "compile", "--language", "C", "--convert-only", f"{MODULE}.py"],
            cwd=folder, capture_output=True, text=True, check=False,
        )  # fmt: skip
        made = {path.suffix: path.read_text(encoding="utf-8") for path in folder.rglob(f"{MODULE}.[ch]")}
        if done.returncode != 0 or len(made) != 2:
            raise RuntimeError(f"pyccel failed:\n{done.stdout}{done.stderr}")
        return header(made[".h"], made[".c"])


def header(declared: str, defined: str) -> str:
    """One header of records and static functions, so that several FMUs can be linked into one program."""
    records = re.findall(r"^struct \w+ \{\n.*?^\};\n", declared, re.DOTALL | re.MULTILINE)
    # The wrapper sets the records up itself.
    records = [re.sub(r" *bool is_freed;\n", "", record) for record in records]
    bodies = re.split(r"^/\*\.+\*/\n", defined, flags=re.MULTILINE)[1:]
    bodies = [body for body in bodies if body.strip() and not re.match(r"void \w+__(init|drop)\(", body)]
    parts = [re.sub(r"^(?=(?:double|void|bool|int64_t) \w+\()", "static ", commented(body), flags=re.M) for body in bodies]
    note = f"/* Made by fmu_src/native/translate.py from the Python sources {digest()}; do not edit. */"
    text = "\n".join(
        [note, "#ifndef KERNEL_H", "#define KERNEL_H", "", '#include "subset.h"', "", *records, *parts, "#endif", ""]
    )
    return re.sub(r"\bkernel__(?=\w)", "kernel_", re.sub(r"INT64_C\((\d+)\)", r"\1", text))


def commented(body: str) -> str:
    """A function with its docstring as one comment, without pyccel's rulers."""
    lines: list[str] = []
    said: list[str] = []
    for line in body.splitlines():
        comment = re.fullmatch(r"( *)/\*(.*?)\s*\*/", line)
        if comment and not comment[1]:
            if not re.fullmatch(r"_+", comment[2]):
                said.append(comment[2].strip())
            continue
        if said:
            lines += ["/* " + "\n   ".join(filter(None, said)) + " */"]
            said = []
        lines.append(f"{comment[1]}/* {comment[2].strip()} */" if comment else line)
    text = "\n".join(lines) + "\n"
    # pyccel declares a result also where it returns an expression.
    return text if "result =" in text else re.sub(r" *\w+ result;\n", "", text)


def main() -> None:
    """Write the C file beside this one."""
    (FOLDER / "kernel.h").write_text(translated(), encoding="utf-8")


if __name__ == "__main__":
    main()
