"""The equations in C99: the sources of kernel, effects and model, joined, typed and translated by pyccel.

Developers run `python -m twintube.fmu.translate` after a change of the equations; it needs pyccel (and the gfortran that
its installation asks for). The C that it writes is committed, so that users need neither.

pyccel writes readable C of scalars and records that needs `math.h` only, but takes arrays from a header library of some
thousand lines. The kernel only reads the F-v curve, so `subset.h` stands in for that library with what is used of it.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from importlib.resources import files
from pathlib import Path

from twintube.common.files import write_text
from twintube.fmu.equations import CAR, DAMPER, Equations, joined_source, marked

NATIVE = Path(str(files("twintube.fmu_sources"))) / "native"
TARGET = NATIVE / "kernel.h"
TARGETS = {TARGET: DAMPER, NATIVE / "car" / "kernel.h": CAR}
MODULE = "kernel"


def translated(equations: Equations = DAMPER) -> str:
    """The text of a `kernel.h`; raises RuntimeError with what pyccel says."""
    return marked(converted(joined_source(equations), MODULE), equations)


def converted(source: str, module: str) -> str:
    """A typed Python source as a C header whose names begin with `module`; raises RuntimeError with what pyccel says."""
    pyccel = shutil.which("pyccel", path=str(Path(sys.executable).parent)) or shutil.which("pyccel")
    if pyccel is None:
        raise RuntimeError("pyccel is not installed: pip install pyccel (its installation needs gfortran)")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / f"{module}.py").write_text(source, encoding="utf-8")
        done = subprocess.run(
            [pyccel, "compile", "--language", "C", "--convert-only", f"{module}.py"],
            cwd=folder, capture_output=True, text=True, check=False,
        )  # fmt: skip
        output = {path.suffix: path.read_text(encoding="utf-8") for path in folder.rglob(f"{module}.[ch]")}
        if done.returncode != 0 or len(output) != 2:
            raise RuntimeError(f"pyccel failed:\n{done.stdout}{done.stderr}")
        return header(output[".h"], output[".c"], module)


def header(declared: str, defined: str, module: str) -> str:
    """A header of records and static functions, so that several FMUs can be linked into one program."""
    records = re.findall(r"^struct \w+ \{\n.*?^\};\n", declared, re.DOTALL | re.MULTILINE)
    # The wrapper sets the records up itself.
    records = [re.sub(r" *bool is_freed;\n", "", record) for record in records]
    bodies = re.split(r"^/\*\.+\*/\n", defined, flags=re.MULTILINE)[1:]
    bodies = [body for body in bodies if body.strip() and not re.match(r"void \w+__(init|drop)\(", body)]
    parts = [re.sub(r"^(?=(?:double|void|bool|int64_t) \w+\()", "static ", commented(body), flags=re.M) for body in bodies]
    guard = f"{module.upper()}_H"
    text = "\n".join([f"#ifndef {guard}", f"#define {guard}", "", '#include "subset.h"', "", *records, *parts, "#endif", ""])
    return re.sub(rf"\b{module}__(?=\w)", f"{module}_", re.sub(r"INT64_C\((\d+)\)", r"\1", text))


def commented(body: str) -> str:
    """A function with its docstring as a single comment, without pyccel's rulers."""
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
    """Write each `kernel.h` among the sources of the FMUs."""
    for target, equations in TARGETS.items():
        write_text(target, translated(equations))


if __name__ == "__main__":
    main()
