"""FMUs of both versions and both kinds under random steps, and a master of variable step with a stiff unit beside the damper."""

from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest

from twintube.common.arrays import Array
from twintube.core.instance import Instance
from twintube.dampers import load
from twintube.demo.damper_fmu import DamperFmu

WORN = {"oil_level": 0.56, "gas_preload": 0}
BODY, SPEED = 0.04, 2 * np.pi * 1.5  # [m], [rad/s] the motion at the foot of the stiff unit
MOUNT, LOSS, ROD = 1e6, 300.0, 1.5  # [N/m], [N s/m], [kg]: a rod on a rubber mount, 130 Hz
TOLERANCE = 2e-4  # [m/s] in a step


def lengths(seed: int, number: int) -> list[float]:
    random = np.random.default_rng(seed)
    return (random.choice([0.0, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2], number) * random.random(number)).tolist()


def moves(seed: int) -> list[tuple[float, float, float]]:
    """Stroke with noise, velocity of the moment, length."""
    random, time, found = np.random.default_rng(seed), 0.0, []
    for h in lengths(seed, 600):
        stroke = BODY * np.sin(SPEED * time) + 20e-6 * random.standard_normal()
        found.append((float(stroke), float(BODY * SPEED * np.cos(SPEED * time)), h))
        time += h
    return found


def by_instance(path: list[tuple[float, float, float]]) -> list[float]:
    unit = Instance(asdict(load("SA8").with_(**WORN).parameters))
    assert unit.begin() == ""
    forces = []
    for unit.inputs.stroke, unit.inputs.velocity, h in path:
        assert unit.move(0.0, h) == ""
        forces.append(unit.o.force)
    return forces


def by_fmu(fmu: Path, path: list[tuple[float, float, float]]) -> list[float]:
    with DamperFmu(fmu, **WORN) as unit:
        return [unit.step(*step) for step in path]


@pytest.mark.parametrize("seed", [1, 2])
def test_both_kinds_give_the_same_bits_in_any_steps(sa8_fmu: Path, seed: int) -> None:
    assert by_fmu(sa8_fmu, moves(seed)) == by_instance(moves(seed))


def test_fmi_3_gives_the_same_bits_in_any_steps(sa8_fmi3: Path) -> None:
    assert by_fmu(sa8_fmi3, moves(3)) == by_instance(moves(3))


class Mounted:
    """A rod on a rubber mount that the damper pulls at: exact for a force that is held."""

    def __init__(self) -> None:
        self.state = np.array([0.0, BODY * SPEED])  # place [m], velocity [m/s]
        self.time = 0.0

    def rate(self, time: float, state: Array, force: float) -> Array:
        foot, moving = BODY * np.sin(SPEED * time), BODY * SPEED * np.cos(SPEED * time)
        return np.array([state[1], (MOUNT * (foot - state[0]) + LOSS * (moving - state[1]) - force) / ROD])

    def step(self, force: float, h: float) -> None:
        n = max(1, int(np.ceil(h / 2e-5)))
        for _ in range(n):  # Runge-Kutta, far below the master's tolerance
            t, x, d = self.time, self.state, h / n
            k1 = self.rate(t, x, force)
            k2 = self.rate(t + d / 2, x + d / 2 * k1, force)
            k3 = self.rate(t + d / 2, x + d / 2 * k2, force)
            k4 = self.rate(t + d, x + d * k3, force)
            self.state, self.time = x + d / 6 * (k1 + 2 * k2 + 2 * k3 + k4), t + d


class Master:
    """Both units in turn; a step that is done in two halves and differs by too much is taken back and made shorter."""

    def __init__(self, fmu: Path) -> None:
        self.damper, self.rod = DamperFmu(fmu, **WORN), Mounted()
        self.force, self.refused = 0.0, 0

    def both(self, h: float) -> None:
        place = self.rod.state[0]
        self.rod.step(self.force, h)
        velocity = (self.rod.state[0] - place) / h
        self.force = self.damper.step(float(place), float(velocity), h)

    def kept(self) -> tuple[object, ...]:
        return self.damper.fmu.getFMUState(), self.damper.now.value, self.rod.state.copy(), self.rod.time, self.force

    def back(self, kept: tuple[object, ...]) -> None:
        state, self.damper.now.value, self.rod.state, self.rod.time, self.force = kept  # type: ignore[assignment]
        self.damper.fmu.setFMUState(state)

    def run(self, until: float) -> Array:
        """Times, lengths and forces (n, 3)."""
        rows, h = [], 1e-4
        while self.rod.time < until - 1e-12:
            h = min(h, until - self.rod.time)
            start = self.kept()
            self.both(h)
            whole = self.rod.state[1]
            self.back(start)
            self.both(h / 2)
            self.both(h / 2)
            error = abs(self.rod.state[1] - whole) / TOLERANCE
            if error > 1.0 and h > 1e-6:
                self.back(start)
                self.refused += 1
            else:
                rows.append((self.rod.time, h, self.force))
            self.damper.fmu.freeFMUState(start[0])
            h = float(np.clip(h * np.clip(0.8 / np.sqrt(max(error, 1e-6)), 0.3, 2.0), 1e-6, 5e-3))
        return np.array(rows)


def test_a_master_of_variable_step_with_a_stiff_unit(sa8_native: Path) -> None:
    """It takes steps back and over an order of magnitude of lengths; forces and work are those of short steps."""
    master = Master(sa8_native)
    with master.damper:
        rows = master.run(1.0)
        work = master.damper.outputs()["work"]
    fixed = Master(sa8_native)
    with fixed.damper:
        exact = []
        while fixed.rod.time < 1.0 - 1e-9:
            fixed.both(2e-5)
            exact.append((fixed.rod.time, fixed.force))
        expected = fixed.damper.outputs()["work"]
    times, forces = np.array(exact).T
    assert master.refused > 10
    assert rows[:, 1].max() > 10 * rows[:, 1].min()
    assert work == pytest.approx(expected, rel=0.01)
    off = np.abs(rows[:, 2] - np.interp(rows[:, 0], times, forces))
    # Where gas runs out the rod rings on its mount for some 5 ms, twice in each of three strokes: then a phase counts.
    assert np.median(off) < 1.0
    assert np.sum(rows[off > 50.0, 1]) < 6 * 5e-3
