"""Physical causes in gas, stops and friction, and those inside the balance of oil, gas and foam."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from twintube.core.kernel.forces import stribeck
from twintube.dampers import Damper
from twintube.lab.workshop.cause import Cause, Run, Trial
from twintube.lab.workshop.fluid_causes import AIR

Array = NDArray[np.float64]


@dataclass
class WrongPreload(Cause):
    """The intact damper has another gas pressure: force and stiffness times a ratio (p A_rod; c = A_rod^2 p / V)."""

    ratio: float = 1.0

    def damper(self, damper: Damper, trial: Trial) -> Damper:
        """Other gas spring with preload."""
        p = damper.parameters
        return damper.with_(F_0=p.F_0 * self.ratio, c_gas=p.c_gas * self.ratio) if trial.preload else damper


@dataclass
class ResidualPressure(Cause):
    """Preload not all gone: polytropic air in the reserve, F = -A_rod (p - p_a), p V^n constant."""

    pressure: float = 0.0  # gauge at stroke 0 [Pa]
    exponent: float = 1.0

    def force(self, run: Run) -> None:
        """What this law adds to the isothermal one at ambient pressure."""
        if run.trial.preload:
            return
        p = run.damper.parameters
        rod = 0.25 * np.pi * p.D_PR**2
        half = 0.5 * (p.h_l - p.dead_length)
        inner = 0.25 * np.pi * p.D_li**2
        reserve = 0.25 * np.pi * (p.D_a**2 - p.D_la**2) * p.h_l
        gas = reserve + (2 * inner - rod) * half - p.oil_level * p.V_oil  # all that is not oil at stroke 0
        ratio = gas / (gas + rod * run.z)
        run.gas -= rod * ((AIR + self.pressure) * ratio**self.exponent - AIR * ratio)


@dataclass
class RubberStop(Cause):
    """Rubber beyond a stroke: F = F10 (u / 10 mm)^n, a share lost in hysteresis (Battermann and Koehler, Elastomere)."""

    side: float = 1.0  # 1 rebound, -1 compression
    onset: float = 0.03
    at_10mm: float = 1000.0
    power: float = 1.7
    loss: float = 0.15

    def force(self, run: Run) -> None:
        """Against the motion into the stop."""
        depth = np.maximum(self.side * run.z - self.onset, 0.0)
        inward = np.tanh(self.side * run.v / 0.02)
        run.extra += self.side * self.at_10mm * (depth / 0.01) ** self.power * (1.0 + self.loss * inward)


@dataclass
class FoamBump(Cause):
    """Cellular polyurethane stop that locks: F = k u / (1 - u / h) (rational law; Blundell and Harty, Multibody Systems)."""

    side: float = -1.0
    onset: float = 0.03
    stiffness: float = 4e4
    height: float = 0.03

    def force(self, run: Run) -> None:
        """Against the motion into the stop."""
        depth = np.maximum(self.side * run.z - self.onset, 0.0)
        run.extra += self.side * self.stiffness * depth / (1.0 - np.minimum(depth / self.height, 0.9))


def rubbing(run: Run) -> Array:
    """Dahl state (n,) from -1 to 1: the model's friction over its saturated value."""
    p = run.damper.parameters
    scale = np.array([stribeck(p, float(v)) for v in run.v])
    full = p.F_FrS * (1.0 + p.oil_loss_gain * (1.0 - p.oil_level))
    result: Array = run.friction / (scale * full)
    return result


@dataclass
class SideLoad(Cause):
    """Strut under side force: Coulomb friction `extra` [N] more, whatever the stroke (Reimpell, "McPherson")."""

    extra: float = 0.0

    def force(self, run: Run) -> None:
        """With the sign of the Dahl state."""
        run.friction += self.extra * rubbing(run)


@dataclass
class BentRod(Cause):
    """Bent rod: the normal force in guide and piston grows as their distance shrinks: N = Q (1 + e / (l0 - z))."""

    extra: float = 0.0  # friction at the middle [N]
    overhang: float = 0.15  # e [m]
    distance: float = 0.13  # l0 [m]

    def force(self, run: Run) -> None:
        """Larger towards full extension."""
        size = (1.0 + self.overhang / (self.distance - run.z)) / (1.0 + self.overhang / self.distance)
        run.friction += self.extra * size * rubbing(run)


@dataclass
class Refilled(Cause):
    """Other oil in the damper than recorded: `shift` [share of the intact volume] in all degraded states, or in some."""

    shift: float = 0.0
    levels: tuple[float, ...] = ()

    def damper(self, damper: Damper, trial: Trial) -> Damper:
        """The true level."""
        degraded = not trial.preload and trial.level < 0.995
        if not degraded or (self.levels and trial.level not in self.levels):
            return damper
        return damper.with_(oil_level=min(1.0, max(0.0, trial.level + self.shift)))


@dataclass
class OtherLaws(Cause):
    """Other values of the degradation parameters than those of the set."""

    changes: dict[str, float] = field(default_factory=dict)

    def damper(self, damper: Damper, trial: Trial) -> Damper:
        """The true parameters."""
        return damper.with_(**self.changes)


@dataclass
class FoamCollapse(Cause):
    """Foam to oil and gas: first order (drainage of all) or at a constant rate (front at the surface); Bikerman, Foams."""

    rate: float = 0.0  # [1/s]
    front: float = 0.0  # [m3/s] in all
    acts_inside: bool = True

    def act(self, state: Any, derived: Any, trial: Trial, dt: float, way: float, fluid: float) -> None:
        """In each chamber."""
        total = sum(float(state[f"{c}_foam"]) for c in ("V1", "V2", "V3"))
        if total <= 0:
            return
        share = 1.0 - np.exp(-self.rate * dt) if self.rate > 0 else min(1.0, self.front * dt / total)
        for c in ("V1", "V2", "V3"):
            foam, oil = float(state[f"{c}_foam"]) * share, float(state[f"{c}_foam_oil"]) * share
            state[f"{c}_foam"] -= foam
            state[f"{c}_foam_oil"] -= oil
            state[f"{c}_oil"] += oil
            if c != "V3":
                state[f"{c}_gas"] += foam - oil


@dataclass
class Dissolving(Cause):
    """Freed gas goes back into the oil, dV/dt = -r V (mass transfer); with `pressed`, r grows with the pressure (Henry)."""

    rate: float = 0.0
    pressed: float = 0.0  # fluid force at which the rate is twice as large [N], 0: constant rate
    acts_inside: bool = True

    def act(self, state: Any, derived: Any, trial: Trial, dt: float, way: float, fluid: float) -> None:
        """Gas of the chambers first, else that of the reserve, becomes oil again."""
        rate = self.rate * (1.0 + fluid / self.pressed) if self.pressed > 0 else self.rate
        left = float(state["V_cav"]) * (1.0 - np.exp(-rate * dt))
        if left <= 0:
            return
        state["V_cav"] -= left
        for c in ("V2", "V1"):
            part = min(left, float(state[f"{c}_gas"]))
            state[f"{c}_gas"] -= part
            state[f"{c}_oil"] += part
            left -= part
        state["V3_oil"] += left


@dataclass
class Leak(Cause):
    """Oil past the rod seal: a film per stroke (Mueller and Nau) or an orifice, q = C sqrt(p) (Merritt)."""

    film: float = 0.0  # [m3/m]
    orifice: float = 0.0  # [m3/s] at 1 bar
    refilled: bool = True  # each state filled afresh by volume; else the loss goes on through all states
    lost: float = 0.0
    all_lost: float = 0.0
    state: tuple[float, bool] = (-1.0, True)
    acts_inside: bool = True

    def begin(self) -> None:
        """Full."""
        self.lost, self.all_lost, self.state = 0.0, 0.0, (-1.0, True)

    def damper(self, damper: Damper, trial: Trial) -> Damper:
        """The level at the start of the record."""
        if self.refilled and self.state != (trial.level, trial.preload):
            self.lost = 0.0
        self.state = (trial.level, trial.preload)
        return damper.with_(oil_level=max(0.0, trial.level - self.lost / damper.parameters.V_oil))

    def act(self, state: Any, derived: Any, trial: Trial, dt: float, way: float, fluid: float) -> None:
        """Out of the reserve, into which the guide drains."""
        pressure = fluid / float(derived["A_1"]) / 1e5 + (5.0 if trial.preload else 0.0)
        gone = min(self.film * way + self.orifice * np.sqrt(pressure) * dt, float(state["V3_oil"]))
        state["V3_oil"] -= gone
        self.lost += gone
        self.all_lost += gone
        self.values["lost_mL"] = round(float(self.all_lost) * 1e6, 2)
