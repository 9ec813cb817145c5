"""The C sources of one damper: those of `fmu_src/native`, and the table of variables with its start values."""

from importlib.resources import files
from pathlib import Path

from twintube.dampers import Damper
from twintube.fmu.description import model_name
from twintube.fmu.equations import checked, digest
from twintube.fmu.table import Variable, variables

FOLDER = Path(str(files("twintube.fmu_sources")))
NATIVE = FOLDER / "native"
FIXED = ("fmi2.c", "unit.h", "checks.h", "damper.h", "access.h", "state.h", "kernel.h", "subset.h")
COMPILED = "fmi2.c"  # it includes all others
CAPABILITIES = {
    "canInterpolateInputs": "true",
    "canNotUseMemoryManagementFunctions": "false",
    "maxOutputDerivativeOrder": "0",  # forces jump where a phase runs out: no derivative would be exact
    "providesDirectionalDerivative": "false",  # outputs do not depend on the inputs of the moment
    "canRunAsynchronuously": "false",
}
LOG_CATEGORIES = ("logStatusError", "logStatusWarning")
# The order of the F-v curve's memory in `struct damper`.
CURVES = ("v_re", "F_re", "v_co", "F_co")


def place(variable: Variable) -> str:
    """Where a variable is in `struct memory`."""
    name = variable.item.name
    if variable.causality == "input":
        return name
    if variable.causality == "output":
        return f"out.{name}"
    if name in CURVES:
        return f"wanted.fv[{CURVES.index(name)}][{variable.index}]"
    return f"wanted.p.{name}"


def bound(value: float | None, sign: str) -> str:
    """A bound as a number of C."""
    return f"{sign}INFINITY" if value is None else repr(float(value))


def identity(damper: Damper, guid: str) -> str:
    """The text of `model.h`; the prefix is for static linking, as the standard asks of sources."""
    return "\n".join([
        "/* Made by `twintube fmu`: what this model is called. For a shared library define the prefix as nothing. */",
        "#ifndef MODEL_H", "#define MODEL_H", "",
        "#ifndef FMI2_FUNCTION_PREFIX",
        f"#define FMI2_FUNCTION_PREFIX {model_name(damper)}_",
        "#endif", "",
        f'#define MODEL_GUID "{guid}"',
        f'#define MODEL_EQUATIONS "{digest()[:15]}"', "",
        "#endif", "",
    ])  # fmt: skip


def table(damper: Damper) -> str:
    """The text of `variables.h`."""
    rows, starts = [], []
    for variable in variables(damper):
        meta = variable.item.metadata
        role = variable.variability if variable.causality == "parameter" else variable.causality
        rows.append(
            f'    {{"{variable.name}", "{meta["unit"]}", {"INTEGER" if variable.integer else "REAL"}, {role.upper()}, '
            f"offsetof(struct memory, {place(variable)}), {bound(meta['lower'], '-')}, {bound(meta['upper'], '')}}},"
        )
        starts.append(f"    {float(variable.start or 0.0)!r}, /* {variable.name} */")
    return "\n".join([
        "/* Made by `twintube fmu`: all variables by their value references, and their start values. */",
        "#ifndef VARIABLES_H", "#define VARIABLES_H", "",
        "static const struct variable VARIABLE[] = {", *rows, "};", "",
        "static const double START[] = {", *starts, "};", "", "#endif", "",
    ])  # fmt: skip


def sources(damper: Damper, guid: str) -> dict[str, str]:
    """All files by name; raises StaleTranslationError where `kernel.h` is not the translation of the equations."""
    made = {"model.h": identity(damper, guid), "variables.h": table(damper)}
    texts = {name: (NATIVE / name).read_text(encoding="utf-8") for name in FIXED}
    checked(texts["kernel.h"])
    return texts | made
