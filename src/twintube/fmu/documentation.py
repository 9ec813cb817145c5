"""The documentation page inside the FMU, made from the table of variables and the parameter set."""

import base64
import io
from dataclasses import fields
from html import escape

from twintube import __version__
from twintube.core.effects import Parameters
from twintube.core.variables import Inputs, Outputs, fmi_name
from twintube.dampers import Damper
from twintube.dampers.closures import OWN, acting
from twintube.fmu import reference

STYLE = (
    "body{font-family:sans-serif;max-width:84em;padding:0 2em;margin:2em auto;color:#222}table{border-collapse:collapse}"
    "td,th{border-bottom:1px solid #ccc;padding:.2em .7em;text-align:left;vertical-align:top}.assumed{color:#a40}"
    "td:nth-child(7),td:nth-child(9){min-width:17em}"
)
MEANING = """
<p>Inputs are the values at the start of a communication step: the damper moves from its own stroke to
<em>stroke + velocity &middot; step</em>, and the velocity holds within the step. Give the mean velocity of the coming step
where you know it. Outputs are those at the end of the step and change in doStep only. The error shrinks in proportion
to the communication step; 1 ms is usual.</p>
<p>A degraded damper must be preconditioned before its force means anything: the paper moves it six times at
0.05 m/s. At rest the model holds still, however long,
unless an effect that acts with time is switched on.</p>
"""
GAS = """
<p><strong>Gas that cavitation frees</strong> in this FMU &ndash; {}. The paper's equations 40 and 41 alone never give it
back: that suits blocks of seconds, to which they were fitted; over minutes of cavitation no oil would be left. Which closure
is right is not published. The parameters {} choose it; all 0 are the paper's equations.</p>
"""
KINDS = {
    "native": """
<p>Compiled code without dependencies for Linux (glibc 2.17 or newer, x86-64), Windows (x86-64) and macOS (x86-64 and arm64);
the C99 sources are inside, <em>fmi2.c</em> is the one to compile.</p>
<p>With the first derivative of the velocity set as input derivative, the velocity goes evenly within the coming step; it
holds for one step only. The stroke's derivative is the velocity and is not needed.</p>
<p>A refused value or step (stroke beyond the tube, NaN, negative or mistimed step, parameter out of its range) is answered
by <em>fmi2Error</em>, a log message that names the quantity, its value and the allowed range, and the state as before.</p>
""",
    "python": """
<p>A refused step (stroke beyond the tube, NaN, negative step, parameter out of its range) is answered by
<em>fmi2Discard</em>, a log message of status Error that names the quantity, its value and the allowed range, and the
state as before.</p>
<p>This FMU carries its equations as Python source and runs them in the Python 3.11 or newer of the host computer; it
needs no package, only that Python's shared library is found.</p>
""",
}


def picture(damper: Damper) -> str:
    """Force over stroke and over velocity in the reference run, as a PNG in a data address."""
    from matplotlib.figure import Figure

    t, z, v, force, _ = zip(*reference.rows(damper), strict=True)
    last = slice(len(t) // 2, None)
    figure = Figure(figsize=(9, 3.2), layout="constrained")
    for axes, x, label in zip(figure.subplots(1, 2, sharey=True), (z, v), ("stroke [m]", "velocity [m/s]"), strict=True):
        axes.plot(x[last], force[last], color="#204a87")
        axes.set_xlabel(label)
        axes.grid(alpha=0.3)
    figure.axes[0].set_ylabel("force [N]")
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=110, metadata={"Software": None})
    return "data:image/png;base64," + base64.b64encode(data.getvalue()).decode()


def chosen_by() -> str:
    """The names of the parameters that choose the closure, as HTML."""
    return ", ".join(f"<em>{fmi_name(item)}</em>" for item in fields(Parameters) if item.name in OWN)


def origin(damper: Damper, name: str, group: str) -> str:
    """Where a parameter's value comes from, as HTML."""
    for key in (name, group):
        if key in damper.assumed:
            return f'<span class="assumed">assumed: {escape(damper.assumed[key])}</span>'
    for key in (name, group):
        if key in damper.sources:
            return escape(damper.sources[key])
    return ""


def page(damper: Damper, kind: str) -> str:
    """One self-contained HTML page for a kind of FMU."""
    rows = []
    amplitude = reference.AMPLITUDE * damper.parameters.stroke_max
    for record, causality in ((Inputs, "input"), (Outputs, "output"), (Parameters, "parameter")):
        for item in fields(record):
            meta, name = item.metadata, fmi_name(item)
            value = getattr(damper.parameters, item.name) if record is Parameters else ""
            text = f"{len(value)} values" if isinstance(value, list) else f"{value:g}" if value != "" else ""
            limits = ", ".join(
                f"{word} {bound:g}" for word, bound in (("from", meta["lower"]), ("to", meta["upper"])) if bound is not None
            )
            cells = (name, meta["symbol"], causality, meta["unit"], text, limits, meta["description"], meta["source"])
            came = origin(damper, name, meta["group"]) if record is Parameters else ""
            rows.append("<tr>" + "".join(f"<td>{escape(c)}</td>" for c in cells) + f"<td>{came}</td></tr>")
    heads = ("name", "symbol", "causality", "unit", "value", "range", "meaning", "source", "origin of the value")
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>twintube {escape(damper.name)}</title>'
        f"<style>{STYLE}</style><h1>twintube: {escape(damper.name)}</h1><p>{escape(damper.title)}. Semi-physical model of "
        "a twin-tube shock absorber after oil and gas loss, after Schramm, Zwosta, Prokop, Vehicles 2025, 7(1), 26, "
        f"doi 10.3390/vehicles7010026. Version {__version__}.</p>{MEANING}"
        f"{GAS.format(escape(acting(damper)), chosen_by())}{KINDS[kind]}"
        f'<figure><img alt="force over stroke and velocity" src="{picture(damper)}"><figcaption>Second half of the '
        f"reference run in extra/twintube: {reference.FREQUENCY:g} Hz, {amplitude * 1e3:.0f} mm, with the start values of "
        "this FMU.</figcaption></figure><table><tr>"
        + "".join(f"<th>{h}</th>" for h in heads)
        + "</tr>"
        + "\n".join(rows)
        + "</table></html>"
    )
