"""What a formulation is, and what is drawn for it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from worlds.bench import faults
from worlds.bench.plan import RNG, chance, sign
from worlds.challenge import mechanics
from worlds.challenge.plan import Bench
from worlds.model.run import Constants, Run

Apply = Callable[[Run, float, Constants], None]
Draw = Callable[[RNG, Bench], dict[str, Any]]
Truth = Callable[[float, Constants], dict[str, float]]


@dataclass(frozen=True)
class Formulation:
    """One way in which a cause shows."""

    name: str
    stage: str  # setup, forces or sensors
    apply: Apply
    lowest: float  # strength, in the unit of `apply`
    highest: float
    draw: Draw = lambda rng, bench: {}
    truth: Truth = lambda x, c: {}
    needs: frozenset[str] = frozenset()  # of the bench: degraded, intact, fast, cavitation, foam, rest, single_speed


@dataclass(frozen=True)
class Cause:
    """A hidden cause; `kind` is none, effect, fault or outside."""

    kind: str
    formulations: tuple[Formulation, ...]
    label: str = ""  # the contract's name where it is not the key


def signed(rng: RNG, bench: Bench) -> dict[str, Any]:
    """A sign, and the rate of the recorder."""
    return {"sign": sign(rng), "fs": bench.recorder.fs}


def drawn(function: Callable[[RNG], dict[str, Any]]) -> Draw:
    """A draw that needs no bench but its largest stroke."""
    return lambda rng, bench: {**function(rng), "reach": bench.reach}


def files(rng: RNG, bench: Bench) -> dict[str, Any]:
    """Some of the files, at most half, and a sign."""
    count = int(rng.integers(1, max(2, len(bench.records) // 3)))
    chosen = [int(i) for i in rng.choice(len(bench.records), count, replace=False)]
    return {**signed(rng, bench), "files": chosen, "from": len(bench.records) // 2, "file": chosen[0]}


def odd(rng: RNG, bench: Bench) -> dict[str, Any]:
    """One file, and another damper."""
    others = [f"SA{i}" for i in range(1, 9) if f"SA{i}" != bench.damper.name]
    return {**files(rng, bench), "damper": str(rng.choice(others))}


def units(rng: RNG, bench: Bench) -> dict[str, Any]:
    """A wrong unit of force or stroke."""
    unit = [(1 / 4.44822, 1.0), (1 / 9.80665, 1.0), (0.1, 1.0), (1.0, 1 / 25.4), (1e-3, 1.0)][int(rng.integers(5))]
    return {**files(rng, bench), "unit": unit}


def state(rng: RNG, bench: Bench) -> dict[str, Any]:
    """One of the degraded states, and a sign."""
    return {**signed(rng, bench), "state": float(rng.choice([r.level for r in bench.records if not r.preload]))}


def gas(rng: RNG, bench: Bench) -> dict[str, Any]:
    """In which states the gas is other than recorded, with which sign."""
    return mechanics.gas_constants(rng, bench.states)


def intact_gas(rng: RNG, bench: Bench) -> dict[str, Any]:
    """More or less pressure in the intact state."""
    return {"where": "intact", "sign": sign(rng), "n": rng.uniform(1.0, 1.3)}


def rig(rng: RNG, bench: Bench) -> dict[str, Any]:
    """What the outside troubles need."""
    return {
        "hertz": rng.uniform(40, 150), "zeta": rng.uniform(0.02, 0.1), "mains": float(rng.choice([50.0, 60.0])),
        "to_zero": chance(rng, 0.5), "seed": int(rng.integers(1 << 30)), "largest": bench.largest,
    }  # fmt: skip


def settling(rng: RNG, bench: Bench) -> dict[str, Any]:
    """Sign and settling time."""
    return {**signed(rng, bench), "settling": rng.uniform(5, 30)}


def some(apply: Apply) -> Apply:
    """In some files only."""
    return lambda run, x, c: apply(run, x, c) if run.record.number in c["files"] else None


def flip(run: Run, x: float, c: Constants) -> None:
    """Tension is negative."""
    run.force = -run.force


def flip_stroke(run: Run, x: float, c: Constants) -> None:
    """The stroke is positive in compression."""
    run.stroke = -run.stroke


def wrong_unit(run: Run, x: float, c: Constants) -> None:
    """A unit by name, another by number."""
    run.unit = c["unit"]


def later(run: Run, x: float, c: Constants) -> None:
    """The cell was set to zero anew in the middle of the campaign: wrong by `x` [N] from a record on."""
    if run.record.number >= c["from"]:
        faults.scaled(run, zero=c["sign"] * x)


def lost(run: Run, x: float, c: Constants) -> None:
    """The force channel holds its value or falls to zero six times, for the share `x` of the time in all."""
    starts = np.random.default_rng([c["seed"], run.record.number]).uniform(0, 1, 6)
    length = x * (run.time[-1] - run.start) / 6.0
    faults.dropouts(run, starts, np.full(6, length), to_zero=c["to_zero"])


def value(name: str, *, sign_: bool = True, more: float = 0.0) -> Truth:
    """The strength itself is the value, with its sign, added to `more`."""
    return lambda x, c: {name: more + x * (c["sign"] if sign_ else 1.0)}


def carried(rng: RNG, bench: Bench) -> dict[str, Any]:
    """Whether the leak goes on between the records."""
    return {"carried": chance(rng, 0.5)}


def power(rng: RNG, bench: Bench) -> dict[str, Any]:
    """The power of the foam's law."""
    return {"power": float(rng.choice([1.0, 1.0, 1.5]))}
