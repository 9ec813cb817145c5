"""The C that is written from the table of variables and from what the checks say: the same for all dampers, so committed.

`python -m twintube.fmu` writes it anew.
"""

import json
from pathlib import Path

from twintube.common.files import write_text
from twintube.core import consistency, messages
from twintube.core.checks import VELOCITY
from twintube.fmu.model import Model
from twintube.fmu.table import TIME, lengths
from twintube.native.units import MODELS, NATIVE


def bound(value: float | None, sign: str) -> str:
    """A bound as a number of C."""
    return f"{sign}INFINITY" if value is None else repr(float(value))


def quoted(text: str) -> str:
    """A text as C writes it."""
    return json.dumps(text)


def said() -> str:
    """The text of `messages.h`: the templates of `core/messages.py` as macros, and the limits that the checks share."""
    texts = {name: text for name, text in vars(messages).items() if name.isupper() and isinstance(text, str)}
    rules = [messages.RULES[number] for number in range(1, len(messages.RULES) + 1)]
    limits = {
        "LONGEST": consistency.LONGEST,
        "SAFE_STEP": consistency.SAFE_STEP,
        "LOWEST_VELOCITY": float(VELOCITY["lower"]),
        "HIGHEST_VELOCITY": float(VELOCITY["upper"]),
    }
    return "\n".join([
        "/* Generated from what the interpreter says: texts and limits of the checks. */",
        "#ifndef MESSAGES_H", "#define MESSAGES_H", "",
        *(f"#define SAY_{name} {quoted(text)}" for name, text in texts.items()), "",
        "/* By the numbers of the rules in kernel.h. */",
        "static const char *const RULE[] = {", '    "",', *(f"    {quoted(text)}," for text in rules), "};", "",
        f"static const char *const MODE[] = {{{', '.join(quoted(text) for text in messages.MODES)}}};", "",
        *(f"#define {name} {value!r}" for name, value in limits.items()), "",
        "#endif", "",
    ])  # fmt: skip


def table(model: Model) -> str:
    """The text of `variables.h`: all variables but their start values; the time is last, as FMI 2.0 has none."""
    rows = []
    listed = (*model.variables, TIME)
    for variable, length in zip(listed, lengths(listed, arrays=True), strict=True):
        meta = variable.item.metadata
        role = variable.variability if variable.causality == "parameter" else variable.causality
        unit, kind = messages.suffix(meta["unit"]), "INTEGER" if variable.integer else "REAL"
        rows.append(
            f'    {{"{variable.name}", "{unit}", {kind}, {role.upper()}, {length}, '
            f"offsetof(struct memory, {variable.place}), {bound(meta['lower'], '-')}, {bound(meta['upper'], '')}}},"
        )
    return "\n".join([
        "/* Generated from the table of variables: all of the model by their value references. */",
        "#ifndef VARIABLES_H", "#define VARIABLES_H", "",
        "static const struct variable VARIABLE[] = {", *rows, "};", "", "#endif", "",
    ])  # fmt: skip


def texts(model: Model) -> dict[str, str]:
    """What is generated for a model, by file name."""
    return {"variables.h": table(model), "messages.h": said()}


def write() -> None:
    """Write all of it; any damper and any car will do."""
    from twintube.dampers import load
    from twintube.fmu.car import car_model
    from twintube.fmu.description import damper_model
    from twintube.vehicle.cars import load_car
    from twintube.vehicle.full.run import full_car

    damper = load("SA8")
    models = {"damper": damper_model(damper), "car": car_model(full_car(load_car(), [damper] * 4), 0.0)}
    for name, model in models.items():
        write_text(Path(NATIVE, MODELS[name], "variables.h"), table(model))
    write_text(NATIVE / "messages.h", said())
