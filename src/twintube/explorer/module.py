"""The WebAssembly module: the C sources of the native FMU, the loops of `explorer.c` and the translated quarter car."""

from twintube.dampers import load
from twintube.fmu import sources
from twintube.fmu.assemble import BuildError
from twintube.fmu.binaries import filled
from twintube.fmu.description import damper_model
from twintube.native.units import EXPLORER, MODULE, LibraryError, library

# Any damper would do: a page sets all parameters before it starts a unit.
DAMPER = "SA8"


def module() -> bytes:
    """The module that the package brings; raises BuildError where it is missing or of other sources."""
    model = damper_model(load(DAMPER))
    try:
        sources.model_sources(model, "explorer")
        return filled(library(EXPLORER, MODULE), "explorer", sources.starts(model))
    except (LibraryError, sources.StaleTableError) as error:
        raise BuildError(str(error)) from error
