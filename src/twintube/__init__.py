"""Semi-physical model of a twin-tube shock absorber that has lost oil and gas.

load            a damper: one of the paper's eight by its name, or a parameter file
simulate        forces and volumes of a damper over a record
harmonic_block  the excitation of the paper's test rig
build_fmu       the damper as FMI 2.0 co-simulation FMU
identify        the parameters from measured data
diagnose        what state a damper is in, what has changed, and what the simulation lacks, from measured data
plot            the picture of what simulate, identify and diagnose return, as does their own plot()
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from twintube.common.showing import DRAWS

if TYPE_CHECKING:
    from twintube.common.showing import Figure
    from twintube.dampers import Damper as Damper
    from twintube.dampers import ParameterError as ParameterError
    from twintube.dampers import load as load
    from twintube.diagnosis import diagnose as diagnose
    from twintube.engine.simulate import simulate as simulate
    from twintube.engine.simulation import Simulation as Simulation
    from twintube.errors import InputError as InputError
    from twintube.errors import InputWarning as InputWarning
    from twintube.fmu import BuildError as BuildError
    from twintube.fmu import build_fmu as build_fmu
    from twintube.identification import identify as identify
    from twintube.rig import Signal as Signal
    from twintube.rig import harmonic_block as harmonic_block
    from twintube.version import __version__ as __version__

# Imported where they are first used: scipy and the FMU tools take seconds.
HOMES = {
    "twintube.dampers": ("Damper", "ParameterError", "load"),
    "twintube.engine.simulate": ("simulate",),
    "twintube.engine.simulation": ("Simulation",),
    "twintube.errors": ("InputError", "InputWarning"),
    "twintube.diagnosis": ("diagnose",),
    "twintube.fmu": ("BuildError", "build_fmu"),
    "twintube.identification": ("identify",),
    "twintube.rig": ("Signal", "harmonic_block"),
    "twintube.version": ("__version__",),  # nor is there one before the package is installed
}
__all__ = [name for names in (*HOMES.values(), ("plot",)) for name in names]


def plot(result: Any) -> "Figure":
    """The picture of a result as a figure of pyplot; raises TypeError for what has none."""
    from twintube.report.plot import picture

    return picture(result)


DRAWS.append(plot)

if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        for home, names in HOMES.items():
            if name in names:
                return getattr(import_module(home), name)
        raise AttributeError(f"module 'twintube' has no attribute {name!r}")

    def __dir__() -> list[str]:
        return sorted(__all__)
