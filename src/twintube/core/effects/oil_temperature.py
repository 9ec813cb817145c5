"""Heat: the oil thins, so that the fluid force fades; the gas presses harder and the friction falls.

The damper is one heat store with one way out (lumped capacity, Newton cooling); H is the heat in it beyond that of the
start: dH/dt = P - H / cooling_time. Viscosity falls exponentially with temperature (Reynolds), and so does the laminar
part of the force, by exp(-fade_heat (H + H_start)), H_start being the heat at the start beyond that at the temperature of
the F-v curve. Heat capacity and viscosity index act only through their ratio `fade_heat`. The pressure drop a mu v + b v^2
of a passage is laminar by 1 / (1 + turbulence |v|), turbulence being b / (a mu); the rest goes with the density, of which
`thin_density` is what viscosity loses, in logarithms.

Where the temperature is measured it is the input, and the law of the damper makes the forces of it (kernel/temperature.py).
What a damper does beyond that law are fade_kelvin and friction_kelvin, in the same exponential way. Where nothing is
measured gas_heat makes the gas follow the retained heat.

With `warm_heat` [K/J] the heat store has a temperature: that from outside plus warm_heat H. Fluid force, friction and gas
then go as the law of the damper says (kernel/temperature.py), and nothing of the above is needed.
"""

import math
from dataclasses import dataclass

from twintube.core import variables
from twintube.core.frame import Frame
from twintube.core.kernel.forces import gas_rise
from twintube.core.variables import var

TITLE = "Heat of oil and gas"
CAUSE = "Heat, of the dissipated work or from outside, thins the oil, eases the friction and raises the gas pressure."
ABSENCE = "The measured fluid force falls below the model's while the damper gets warm, and comes back after a rest."
DECIDES = "the tube's temperature, or a rest of ten minutes within a record: heat goes, lost oil does not come back"
NEEDS_TIME = True
ORDER = 120
THICKEST = 2.0  # logarithm of the force of cold oil over that of the F-v curve, at most


@dataclass(frozen=True, slots=True)
class Parameters(variables.Parameters):
    """Fade and cooling; what a kelvin changes."""

    fade_heat: float = var("oil_temperature", "", "1/J", "relative loss of fluid force per retained heat", lower=0,
                           upper=1e-3, source="Reynolds 1886 (viscosity)", default=0.0,
                           role="strength")  # fmt: skip
    cooling_time: float = var("oil_temperature", "", "s", "time constant of the cooling", lower=5, upper=2000,
                              source="Newton's law of cooling, lumped", default=300.0, role="scale")  # fmt: skip
    H_start: float = var("oil_temperature", "", "J", "heat at the start beyond the F-v curve's",
                         lower=-2e4, upper=6e4, source="700 J/K", default=0.0,
                         role="start")  # fmt: skip
    fade_kelvin: float = var("oil_temperature", "", "1/K", "relative loss of fluid force per kelvin, beyond the law",
                             lower=-0.02, upper=0.08, source="Reynolds 1886 (viscosity)", default=0.0,
                             role="strength")  # fmt: skip
    friction_kelvin: float = var("oil_temperature", "", "1/K", "relative loss of friction per kelvin, beyond the law",
                                 lower=-0.02, upper=0.03, source="seals soften, the film thins", default=0.0,
                                 role="strength")  # fmt: skip
    turbulence: float = var("oil_temperature", "", "s/m", "turbulent over laminar pressure drop per velocity",
                            lower=0, upper=20, source="Hagen-Poiseuille, Bernoulli",
                            default=0.0, role="law")  # fmt: skip
    thin_density: float = var("oil_temperature", "", "1", "relative loss of density over that of viscosity", lower=0,
                              upper=0.05, source="mineral oil; Dixon, Shock Absorber Handbook",
                              default=0.02, role="law")  # fmt: skip
    warm_heat: float = var("oil_temperature", "", "K/J", "rise of the temperature per retained heat, 1 / heat capacity",
                         lower=0, upper=0.01, source="lumped heat capacity, 700 J/K", default=0.0,
                         role="strength")  # fmt: skip
    gas_heat: float = var("oil_temperature", "", "1/J", "relative rise of the preload per retained heat", lower=0,
                          upper=1e-3, source="ideal gas, lumped heat capacity", default=0.0, role="law")  # fmt: skip


@dataclass(slots=True)
class State(Frame):
    """The heat store."""

    heat: float = var("oil_temperature", "H", "J", "heat retained since the start", default=0.0)


def oil_temperature_phases(p: Parameters, s: State, way: float, dt: float) -> None:
    """Cool down over `dt` [s]."""
    s.heat *= math.exp(-dt / p.cooling_time)


def oil_temperature_warming(p: Parameters, s: State) -> float:
    """What the retained heat adds [K] to the temperature given from outside, which then is that around the damper."""
    return p.warm_heat * s.heat


def oil_temperature_scale_fluid(p: Parameters, s: State, v: float) -> float:
    """Share of the fluid force that is left [1]."""
    kelvin = s.T - p.T_curve
    thin = math.exp(min(THICKEST, -p.fade_heat * (p.H_start + s.heat) - p.fade_kelvin * kelvin))
    laminar = 1.0 / (1.0 + p.turbulence * abs(v))
    return laminar * thin + (1.0 - laminar) * math.pow(thin, p.thin_density)


def oil_temperature_scale_friction(p: Parameters, s: State, z: float, v: float) -> float:
    """Share of the friction that is left [1]."""
    return math.exp(-p.friction_kelvin * (s.T - p.T_curve))


def oil_temperature_elastic(p: Parameters, s: State, z: float) -> float:
    """Force [N] by which that of the preload changes at the stroke `z` [m]."""
    hotter = p.gas_heat * (p.H_start + s.heat)
    return p.gas_preload * hotter * (gas_rise(p, p.F_0, p.c_gas, z) - p.F_0)


def oil_temperature_finish(p: Parameters, s: State, dt: float) -> None:
    """Take up the step's work, less what of it has already gone."""
    share = dt / p.cooling_time
    kept = (1.0 - math.exp(-share)) / share if share > 1e-9 else 1.0
    # Where stroke and velocity of a record do not agree, a step can do negative work.
    s.heat = max(0.0, s.heat + s.W_step * kept)
