"""The documentation page inside the FMU, generated from the table of variables and the parameter set."""

from dataclasses import fields
from html import escape

from twintube.common.words import printable
from twintube.core.effects import Parameters
from twintube.core.variables import fmi_name
from twintube.dampers import Damper
from twintube.dampers.freed_gas import OWN, acting
from twintube.fmu import reference, related
from twintube.fmu.picture import svg
from twintube.fmu.platforms import Fmi
from twintube.fmu.table import Variable, variables
from twintube.version import __version__

STYLE = (
    "body{font-family:sans-serif;max-width:70em;padding:0 1.5em;margin:2em auto;color:#222;line-height:1.4}"
    "svg{max-width:60em}table{border-collapse:collapse;width:100%;font-size:.92em}"
    "td,th{border-bottom:1px solid #ccc;padding:.25em .6em;text-align:left;vertical-align:top}"
    "td:nth-child(2),td:nth-child(3){white-space:nowrap}td:nth-child(4){width:55%}"
    "h2{margin-top:1.6em}td small{color:#555}td small.assumed{color:#a40}"
)
MEANING = """
<p>Inputs are the values at the start of a communication step: the damper moves from its own stroke to
<em>stroke + velocity &middot; step</em>, and the velocity holds within the step. Give the mean velocity of the coming step
where you know it. Outputs are those at the end of the step and change in doStep only. The error shrinks in proportion
to the communication step. With a wheel in the loop 1 ms is usual and 2 ms the most: at 10 ms an intact damper already lets
the wheel load fluctuate a quarter more, as a worn one would. Of a step above 2 ms a warning is logged, once in a run. A
motion that does not answer to the force, as one from a record, may have longer steps.</p>
<p><em>temperature</em> may stay unconnected: it then is that at which the parameters hold. <em>heat_flow</em> is for a
thermal model: the work dissipated in the last step over its length. Beyond <em>temperature.T_cold</em> and
<em>temperature.T_hot</em> fluid force and friction stay as there, and a warning is logged once in a run.</p>
<p>A degraded damper must be preconditioned before its force means anything: the paper moves it six times at
0.05 m/s. At rest the model holds still, however long,
unless an effect that acts with time is switched on.</p>
"""
GAS = """
<p><strong>Gas that cavitation frees</strong> in this FMU &ndash; {}. The paper's equations 40 and 41 alone never give it
back: that suits blocks of seconds, to which they were fitted; over minutes of cavitation no oil would be left. Which way
is right is not published. The parameters {} choose it; all 0 are the paper's equations, as published.</p>
"""
STROKE = """
<p>The range of the stroke is that of the start values: the piston stays inside the tube. It moves with
<em>geometry.h_l</em> and <em>geometry.dead_length</em>.</p>
"""
NEEDS_PYTHON = """This FMU runs its equations in Python 3.11 or newer, in the process of the importer. It needs no package.

Importers written in Python (fmpy, libcosimpy, ecospy) have what it needs. Other importers on Linux do not: the library in
binaries/linux64 names no Python library, so that loading it ends with "undefined symbol: _Py_NoneStruct". Load Python's
library first, for instance

    LD_PRELOAD=libpython3.11.so.1.0 fmusim ...

On Windows python3.dll and the runtime of Microsoft Visual C++ must be on the search path. The native kind of this FMU needs
neither.
"""
CAUSALITIES = ("input", "output", "parameter")
NATIVE = """
<p>Compiled code that needs nothing but the C library of its system, for those of these platforms that <em>binaries</em> has:
{platforms}. The C99 sources are inside; compile <em>{source}</em>.</p>
{motion}
<p>A refused value or step (stroke beyond the tube, NaN, negative or mistimed step, parameter out of its range) is answered
by <em>{error}</em>, a log message that names the quantity, its value and the allowed range, and the state as before.</p>
<p>A serialized state is accepted by an FMU with the same {key} only. Steps of at most 1e-9 s count as rounding: no time
passes for effects.</p>
"""
WORDS = {
    2: {
        "platforms": """<em>linux64</em> (x86-64, glibc 2.17 or newer), <em>aarch64-linux</em> (ARM, glibc 2.17 or newer),
<em>win64</em> (x86-64), <em>darwin64</em> (macOS 11 or newer, x86-64 and arm64)""",
        "source": "fmi2.c",
        "motion": """<p>With the first derivative of the velocity set as input derivative, the velocity goes evenly within
the coming step; it holds for one attempt at a step, also a refused one. The stroke's derivative is the velocity and is not
needed.</p>""",
        "error": "fmi2Error",
        "key": "GUID",
    },
    3: {
        "platforms": """<em>x86_64-linux</em> and <em>aarch64-linux</em> (glibc 2.17 or newer), <em>x86_64-windows</em>,
<em>x86_64-darwin</em> and <em>aarch64-darwin</em> (macOS 11 or newer)""",
        "source": "fmi3.c",
        "motion": """<p>Each branch of the F-v curve is an array of velocities and one of forces. There is no event mode, no
intermediate update and no early return. Warnings are logged where the importer has turned logging on.</p>""",
        "error": "fmi3Error",
        "key": "instantiation token",
    },
}
PYTHON = """
<p>A refused value or step (stroke beyond the tube, NaN, negative or mistimed step, parameter out of its range) is logged
with status Error; the message names the quantity, its value and the allowed range. The coming step is answered by
<em>fmi2Discard</em>, with the state as before. Every message goes to Python's logger <em>twintube.fmu</em>; the FMI log has
it where the importer has turned logging on. The GUID is not checked, as pythonfmu does not pass it on.</p>
<p>This FMU carries its equations as Python source and runs them in the importer's process by Python 3.11 or newer. It needs
no package. Importers written in Python run it as they are; others must load Python's shared library first, see
<em>externalDependencies.txt</em>.</p>
"""


def text(words: str) -> str:
    """Words from a parameter file as HTML."""
    return escape(printable(words))


def picture(damper: Damper) -> str:
    """Force over stroke and over velocity in the second half of the reference run, as SVG."""
    rows = reference.rows(damper)
    _, z, v, force, _ = zip(*rows[len(rows) // 2 :], strict=True)
    return svg([("stroke [m]", z), ("velocity [m/s]", v)], "force [N]", force, "force over stroke and over velocity")


def chosen_by() -> str:
    """The names of the parameters that choose what freed gas does, as HTML."""
    return ", ".join(f"<em>{fmi_name(item)}</em>" for item in fields(Parameters) if item.name in OWN)


def origin(damper: Damper, name: str, group: str) -> str:
    """Where a parameter's value comes from, as HTML."""
    for key in (name, group):
        if key in damper.assumed:
            return f'<small class="assumed">assumed: {text(damper.assumed[key])}</small>'
    for key in (name, group):
        if key in damper.sources:
            return f"<small>value: {text(damper.sources[key])}</small>"
    return ""


def interval(lower: float | None, upper: float | None) -> str:
    """A range in words; empty where there is none."""
    if lower is not None and upper is not None:
        return f"{lower:.4g} to {upper:.4g}"
    return f"from {lower:.4g}" if lower is not None else f"up to {upper:.4g}" if upper is not None else ""


def row(damper: Damper, variable: Variable, size: int) -> str:
    """A row of the table; an array has a single row."""
    meta = variable.item.metadata
    name = fmi_name(variable.item)
    unit = "" if meta["unit"] == "1" else meta["unit"]
    value = f"{size} values" if size > 1 else "" if variable.start is None else f"{variable.start:g} {unit}"
    bounds = interval(*variable.bounds)
    about = [meta["symbol"], variable.variability if variable.causality == "parameter" else ""]
    lines = [escape(meta["description"]), f"<small>{escape(meta['source'])}</small>" if meta["source"] else ""]
    lines += [origin(damper, name, meta["group"])] if variable.causality == "parameter" else []
    cells = (
        escape(name).replace(".", ".<wbr>") + f"<br><small>{escape(', '.join(filter(None, about)))}</small>",
        escape(value or unit),
        escape(f"{bounds} {unit}" if bounds else ""),
        "<br>".join(filter(None, lines)),
    )
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def table(damper: Damper, causality: str) -> str:
    """All variables of a causality."""
    rows = [
        row(damper, variable, variable.item.metadata["size"])
        for variable in variables(damper)
        if variable.causality == causality and variable.index < 1
    ]
    what = "meaning, source, origin of the value" if causality == "parameter" else "meaning, source"
    heads = ("name, symbol", "unit" if causality == "output" else "start value", "range", what)
    return "<table><tr>" + "".join(f"<th>{head}</th>" for head in heads) + "</tr>" + "\n".join(rows) + "</table>"


def page(damper: Damper, kind: str, fmi: Fmi = 2) -> str:
    """A self-contained HTML page for a kind of FMU and a version of FMI."""
    amplitude = reference.AMPLITUDE * damper.parameters.stroke_max
    name, title = text(damper.name), text(damper.title)
    about = PYTHON if kind == "python" else NATIVE.format(**WORDS[fmi])
    tables = "".join(f"<h2>{causality.capitalize()}s</h2>{table(damper, causality)}" for causality in CAUSALITIES)
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>twintube {name}</title>'
        '<meta name="viewport" content="width=device-width">'
        f"<style>{STYLE}</style><h1>twintube: {name}</h1><p>{title}. Semi-physical model of "
        "a twin-tube shock absorber after oil and gas loss, after Schramm, Zwosta, Prokop, Vehicles 2025, 7(1), 26, "
        f"doi 10.3390/vehicles7010026. Version {__version__}.</p>{MEANING}"
        f"{GAS.format(text(acting(damper)), chosen_by())}{about}"
        f"<figure>{picture(damper)}<figcaption>Second half of the "
        f"reference run in {related.FOLDER}: {reference.FREQUENCY:g} Hz, {amplitude * 1e3:.0f} mm, with the start values of "
        f"this FMU.</figcaption></figure>{STROKE}{tables}</html>"
    )
