"""The page in one file: template, style, scripts, content and module joined."""

import base64
import hashlib
import json
from collections.abc import Sequence
from importlib.resources import files

import jinja2

from twintube import web
from twintube.dampers import Damper
from twintube.explorer.content import content
from twintube.explorer.module import module
from twintube.version import __version__

FOLDER = files("twintube.explorer")
# In the order in which they are joined: what a file uses at once stands before it.
SCRIPTS = ("unit", "excitation", "state", "compute", "tube", "charts", "tour", "controls", "main")
CHAMBERS = (("V1", "rebound"), ("V2", "compression"), ("V3", "reserve"))
CHARTS = (  # identifier, title, text for screen readers
    ("chart-s", "Force over stroke", "Force over stroke of this damper and the intact one"),
    ("chart-v", "Force over velocity", "Force over velocity of this damper and the intact one"),
    ("chart-work", "Work", "Work of every oscillation, or second of a drive; the same values are in the table below"),
    ("chart-k", "Degradation factor", "Fluid force over that of the intact damper (k_degr), over time"),
    ("chart-load", "Wheel load", "Wheel load over time with this damper and with the intact one"),
)


def part(name: str) -> str:
    """A file of the page."""
    return FOLDER.joinpath("page", name).read_text(encoding="utf-8")


def script_hash(text: str) -> str:
    """A script as the page's security policy names it."""
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii") + "'"


def page(own: Sequence[Damper] = ()) -> str:
    """The page with SA1 to SA8 and the user's dampers, of which the first is shown; raises BuildError."""
    wasm = module()
    data = content(own)
    data["shown"] = data["dampers"][0]["name"] if own else "SA8"
    library, program = web.library(), web.plots() + "".join(part(f"{name}.js") for name in SCRIPTS)
    environment = jinja2.Environment(autoescape=False, undefined=jinja2.StrictUndefined)  # all texts are the package's own
    return environment.from_string(part("page.html")).render(
        hashes=" ".join(map(script_hash, (library, program))),
        style=web.library_style() + part("page.css"),
        library=library,
        program=program,
        # No text of a user can end the element.
        content=json.dumps(data, separators=(",", ":")).replace("<", "\\u003c"),
        module=base64.b64encode(wasm).decode("ascii"),
        chambers=CHAMBERS,
        charts=CHARTS,
        car=data["car"],
        version=__version__,
        uplot=web.library_version(),
    )
