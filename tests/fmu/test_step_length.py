"""Both kinds of FMU say once that a communication step is too long for a wheel in the loop, and never of shorter ones."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from twintube import load
from twintube.core.consistency import SAFE_STEP, time_slack
from twintube.core.variables import blank
from twintube.demo.damper_fmu import DamperFmu
from twintube.vehicle.cars import load_car
from twintube.vehicle.quarter_car import Motion, damper_stroke, damper_velocity, leapfrog_step
from twintube.vehicle.ride import track

HOP = 2.0 * np.pi * 12.0  # [rad/s] of a car's wheel


def moved(damper: DamperFmu, steps: list[float], begin: float = 0.0) -> None:
    """A slow sine, in these steps."""
    times = begin + np.concatenate([[0.0], np.cumsum(steps)])
    for time, after in pairwise(times.tolist()):
        damper.step(0.02 * np.sin(3.0 * time), 0.06 * np.cos(3.0 * time), after - time)


@pytest.mark.parametrize("h", [2.5e-3, 5e-3, 1e-2, 4e-2])
def test_a_long_step_is_warned_of_once(sa8_fmu: Path, h: float) -> None:
    with DamperFmu(sa8_fmu) as damper:
        moved(damper, [h] * 40)
        (said,) = damper.messages
    assert said.startswith(
        f"Warning: time 0 s: communication step = {h:g} s: with a wheel in the loop at most 0.002 s are safe"
    )


@pytest.mark.parametrize("steps", [[1e-4] * 50, [1e-3] * 50, [2e-3] * 50, [0.0, 2e-3, 0.0, 5e-4, 1.7e-3]])
def test_what_is_safe_is_not_warned_of(sa8_fmu: Path, steps: list[float]) -> None:
    with DamperFmu(sa8_fmu) as damper:
        moved(damper, steps)
        assert damper.messages == []


def test_two_milliseconds_stay_so_with_the_rounding_of_late_times(sa8_native: Path) -> None:
    """Importers give differences of times that they added up."""
    with DamperFmu(sa8_native) as damper:
        damper.now.value = 1e5
        damper.fmu.reset()
        damper.fmu.setupExperiment(startTime=1e5)
        damper.fmu.enterInitializationMode()
        damper.fmu.exitInitializationMode()
        moved(damper, [2e-3] * 200, 1e5)
        assert damper.messages == []


def test_the_first_long_step_among_short_ones_is_named(sa8_fmu: Path) -> None:
    with DamperFmu(sa8_fmu) as damper:
        moved(damper, [1e-3] * 10 + [4e-3] + [1e-3] * 10 + [8e-3] * 10)
        (said,) = damper.messages
    assert said.startswith("Warning: time 0.01 s: communication step = 0.004 s")


def test_a_state_brings_back_whether_it_was_said(sa8_fmu: Path) -> None:
    with DamperFmu(sa8_fmu) as damper:
        kept = damper.fmu.getFMUState()
        for times in (1, 2):  # from the state before the warning it is said again
            moved(damper, [5e-3] * 3)
            assert len(damper.messages) == times
            after = damper.fmu.getFMUState()
            damper.fmu.setFMUState(kept)
            damper.now.value = 0.0
        damper.fmu.setFMUState(after)
        damper.now.value = 0.015
        moved(damper, [5e-3] * 3)
        assert len(damper.messages) == 2


def test_a_wheel_in_the_loop_is_warned_of_though_all_inputs_are_right(sa8_native: Path) -> None:
    """The road of the documentation's table at its 10 ms, where the intact damper looks worn, and at 2 ms."""
    car = load_car().corner(load("SA8"))
    for every, warnings in ((4, 0), (20, 1)):  # steps of the car of 0.5 ms in a communication step
        on, m = track(50.0, 2.0, dt=5e-4), blank(Motion)
        with DamperFmu(sa8_native) as damper:
            force = damper.outputs()["force"]
            for i, (height, rate) in enumerate(zip(on.heights.tolist(), on.rates.tolist(), strict=True)):
                if i % every == 0:
                    force = damper.step(damper_stroke(car, m), damper_velocity(car, m), every * 5e-4)
                leapfrog_step(car, m, height, rate, force, 0.0, 5e-4)
            assert len(damper.messages) == warnings


def test_the_limit_costs_the_wheel_a_thirtieth_of_its_damping() -> None:
    """A force that comes one and a half steps late damps a hop of 12 Hz by the cosine of its lag."""
    left = [np.cos(1.5 * h * HOP) for h in (SAFE_STEP, 5e-3, 1e-2)]
    assert left == pytest.approx([0.97, 0.84, 0.43], abs=0.01)
    assert time_slack(0.0, SAFE_STEP) < 0.01 * SAFE_STEP
