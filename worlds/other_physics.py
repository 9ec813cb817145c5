"""Before and after on a damper with other physics: the virtual rig, whose force is no kernel's, on the bench of `imperfect`.

Its causes are those of `imperfect` that the rig knows as physics of its own, or that lie in the channels.
"""

from collections.abc import Callable
from dataclasses import asdict, replace
from typing import Any, Final

import numpy as np

from twintube import load
from twintube.common.arrays import Array
from twintube.lab.virtual_rig import VirtualDamper, run, virtual_damper
from twintube.lab.virtual_rig.dimensions import DIMENSIONS
from worlds.bench.plan import RNG, Motion, span
from worlds.imperfect.bench import AMPLITUDES, Fault, draw_bench, sine, triangle
from worlds.imperfect.causes import CAUSES
from worlds.imperfect.law import RATE, Law
from worlds.imperfect.session import Damper, Day, Driven, draw_day, session
from worlds.imperfect.world import IDENTIFYING, STATED_WRONGLY, UNCHANGED, World, of_cause, truth

STATES: Final = ("oil_lost", "oil_and_gas_lost", "preload_lost")
LEAK: Final = "leak"  # during the session, out of the damper of STATES
CHANNELS: Final = ("gain", "zero", "delay", "stroke", "signs", "unit")
# Changes of the rig's own damper, each under the cause of `imperfect` whose name and range it has.
INSIDE: Final[dict[str, Callable[[RNG, VirtualDamper], VirtualDamper]]] = {
    "gas_leaked": lambda rng, d: replace(d, preload=d.preload * (1.0 - span(rng, 0.05, 0.8))),
    "bleed_wear": lambda rng, d: replace(d, piston_bleed=d.piston_bleed * (1.0 + span(rng, 0.03, 0.5))),
    "blow_off_wear": lambda rng, d: replace(d, piston_crack=d.piston_crack * (1.0 - span(rng, 0.03, 0.4))),
    "side_load": lambda rng, d: with_friction(d, span(rng, 3.0, 100.0)),
    "foam": lambda rng, d: replace(d, foam=span(rng, 0.004, 0.1)),  # 0.4 to 10 mm of the chambers' 100
}
HOT: Final = "hot_run"
WARMER: Final = (3.0, 60.0)  # [K] by which it begins above the room


def with_friction(damper: VirtualDamper, more: float) -> VirtualDamper:
    """The damper with more friction [N]."""
    return replace(damper, F_static=damper.F_static + more, F_sliding=damper.F_sliding + more)


def way_out(stroke: Array) -> float:
    """Way of the rod out of the damper [m]."""
    return float(np.maximum(np.diff(stroke), 0.0).sum())


def force(damper: VirtualDamper, z: Array, level: float, *, preload: bool, room: float, warmer: float) -> Array:
    """Force of the rig [N] (n,) at strokes [m] at RATE, with oil that is `warmer` [K] than the room."""
    times, warm = np.arange(len(z)) / RATE, room + warmer
    return run(damper, times, np.asarray(z, dtype=np.float64), level, gas_preload=preload, temperature_degC=warm).force


def rig_on(
    healthy: VirtualDamper, damper: VirtualDamper, day: Day, state: dict[str, Any], *, fault: Fault, warmer: float
) -> Damper:
    """A virtual damper in a session; `state` holds oil_level and gas_preload where they are not as delivered."""
    level, preload = float(state.get("oil_level", 1.0)), bool(state.get("gas_preload", 1))
    same = damper == healthy and (level, preload, fault, warmer) == (1.0, True, Fault(), 0.0)

    def driven(i: int, motion: Motion) -> Driven:
        nonlocal level
        own = force(damper, motion.stroke, level, preload=preload, room=day.room, warmer=warmer)
        level -= damper.leak * way_out(motion.stroke) / damper.V_oil
        read = fault.sign * fault.stroke_gain * motion.stroke  # what the damper would do at the stroke that is read
        plain = own if same else force(healthy, read, 1.0, preload=True, room=day.room, warmer=0.0)
        return Driven(own, plain, day.room + warmer)

    return driven


def virtual_rig(seed: int) -> World:
    """Reference records as delivered, and later ones of another day, after one cause or none."""
    rng = np.random.default_rng([seed, 3])
    name = str(rng.choice(sorted(DIMENSIONS)))
    healthy, bench = virtual_damper(name), draw_bench(rng)
    bench = replace(bench, temperature=str(rng.choice(["start", "none"])))  # the rig's oil has no thermocouple
    amplitude = float(rng.choice([a for a in AMPLITUDES[1:] if a <= 0.9 * healthy.half]))
    speeds = [0.05, *sorted(float(v) for v in rng.choice(IDENTIFYING[1:], 4, replace=False))]
    first = [triangle(2e-3, amplitude, "_a"), *(sine(bench, v, amplitude, "_a") for v in speeds)]
    again = sorted(float(v) for v in rng.choice(speeds, int(rng.integers(2, 4)), replace=False))
    later = [sine(bench, v, amplitude, "_b") for v in again]
    key = "" if rng.random() < UNCHANGED else str(rng.choice([*STATES, *CHANNELS, *INSIDE, LEAK, HOT]))
    damper, warmer = healthy, 0.0
    drawn: dict[str, Any] = {}
    if key == HOT:
        warmer = span(rng, *WARMER)
        drawn = {"warmer_K": warmer}
    elif key in INSIDE:
        damper = INSIDE[key](rng, healthy)
        drawn = {item: value for item, value in asdict(damper).items() if value != asdict(healthy)[item]}
    elif key:
        drawn = CAUSES[key].draw(rng, Law(load(name), {}, 0.0, 1, 1e-3, 0.0), amplitude)
    state = drawn if key in (*STATES, LEAK) else {}
    if key == LEAK:
        lost = (drawn["oil_level"] - drawn["oil_level_end"]) * healthy.V_oil
        damper = replace(healthy, leak=lost / sum(way_out(item.motion.stroke) for item in later))
    fault = Fault(**drawn) if key in CHANNELS else Fault()
    days = draw_day(rng), draw_day(rng)
    new = rig_on(healthy, healthy, days[0], {}, fault=Fault(), warmer=0.0)
    used = rig_on(healthy, damper, days[1], state, fault=fault, warmer=warmer)
    before = session(rng, bench, days[0], first, Fault(), damper=new, reference=True)
    after = session(rng, bench, days[1], later, fault, damper=used, reference=False)
    wrong = bool(rng.random() < STATED_WRONGLY)
    level = state.get("oil_level_end", state.get("oil_level", 1.0))
    facts = truth("virtual_rig", seed, name, level=level, preload=bool(state.get("gas_preload", 1)), bench=bench)
    facts |= of_cause(CAUSES[key], drawn, after, bench) if key else {}
    return World(name, bench, (True, wrong), [*before, *after], facts | {"stated_as_full": wrong})
