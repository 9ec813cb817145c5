"""What becomes of the gas that cavitation frees: letter, return, exhaustion, displacement."""

import math

import numpy as np
import pytest

from twintube.core.effects import active
from twintube.dampers import Damper, ParameterError, load, names
from twintube.dampers.closures import CLOSURES, DEFAULT, LETTER, OWN, acting, closed, has_own
from twintube.engine.simulate import simulate, work_between
from twintube.rig.plan import OSCILLATIONS, recovery_plan, recovery_signal, recovery_velocities
from twintube.rig.signals import harmonic_block

REST = 180.0  # [s] of the paper between two measurements


def works(damper: Damper, rest: float, slow: bool = True) -> np.ndarray:
    """Works of the long block and of the block after the rest, relative to the intact damper's first oscillation [1]."""
    s = recovery_signal(damper, recovery_velocities(damper)[0], rest, slow)
    found = work_between(damper, s.stroke, s.velocity, s.marks, s.time)
    intact = work_between(damper.with_(oil_level=1.0, gas_preload=1), s.stroke, s.velocity, s.marks, s.time)
    return np.asarray(found / intact[0])


def test_the_letter_is_the_damper_as_loaded() -> None:
    for name in names():
        assert closed(load(name), LETTER) == load(name)
        assert active(load(name).parameters) == ()


@pytest.mark.parametrize("level", [0.9, 0.6])
def test_after_the_papers_rest_a_failed_damper_does_its_first_work_again(level: float) -> None:
    damper = load("SA8").with_(oil_level=level, gas_preload=0)
    healed, letter = works(closed(damper), REST), works(damper, REST)
    for found, heals in ((healed, True), (letter, False)):
        first, last, again = found[0], found[-OSCILLATIONS - 2], found[-OSCILLATIONS]
        assert last < 0.5 * first  # it has failed
        assert (abs(again / first - 1) < 0.05) == heals


def test_gas_that_dissolves_heals_at_rest_and_displaced_oil_by_slow_strokes() -> None:
    damper = load("SA8").with_(oil_level=0.8, gas_preload=0)
    returning, displaced = closed(damper, "return"), closed(damper, "displaced")
    at_rest, stroked = (works(returning, 30.0, slow)[-OSCILLATIONS] for slow in (False, True))
    assert at_rest > 0.7 * stroked
    at_rest, stroked = (works(displaced, 30.0, slow)[-OSCILLATIONS] for slow in (False, True))
    assert at_rest < 0.7 * stroked
    assert at_rest == pytest.approx(works(displaced, 30.0, slow=False)[-OSCILLATIONS - 2], rel=0.05)


def test_displaced_oil_is_conserved_and_exhausted_oil_frees_what_it_holds() -> None:
    block = harmonic_block(1.572)
    damper = load("SA8").with_(oil_level=0.6, gas_preload=0)

    def freed(**parameters: float) -> float:
        return float(simulate(damper.with_(**parameters), block.stroke, block.velocity, block.time).V_cav[-1])

    oil = 0.6 * damper.parameters.V_oil
    assert freed(displaced_share=1.0) == 0.0
    assert freed() > 0.25 * oil
    assert 0.15 * oil < freed(exhaustion=5.0) < oil / 5.0
    assert freed(exhaustion=9.7) == pytest.approx(0.103 * oil, rel=0.1)


def test_cavitation_grows_with_the_oil_loss_without_a_jump() -> None:
    """First and 19th oscillation at 1.572 m/s from full, preload lost, to 90 %: 1 % of oil costs at most 10 % of work."""
    block = harmonic_block(1.572)
    levels = (1.0, 0.9999, 0.999, 0.99, 0.95, 0.9)
    for i in (0, -1):
        w = np.array([
            work_between(load("SA8").with_(oil_level=level, gas_preload=0), block.stroke, block.velocity, block.marks)[i]
            for level in levels
        ])  # fmt: skip
        assert np.all(np.diff(w) < 0)
        assert np.all(-np.diff(w) / w[0] < 10 * -np.diff(levels))


def test_a_parameter_set_with_its_own_closure_is_left_alone() -> None:
    own = load("SA8").with_(redissolution_rate=0.5)
    assert has_own(own)
    assert closed(own) == own
    assert acting(own) == "its own: redissolution_rate = 0.5"
    assert acting(closed(load("SA8"))).startswith(f"{DEFAULT}: half of the gas dissolves again in 8.15 s")
    assert acting(load("SA8")).startswith("letter: ")
    with pytest.raises(ParameterError, match="unknown closure letters: must be one of letter, return"):
        closed(own, "letters")


def test_every_closure_is_made_of_its_own_parameters() -> None:
    for item in CLOSURES.values():
        assert set(item.parameters) <= set(OWN)
        assert all(math.isfinite(value) and value > 0 for value in item.parameters.values())


@pytest.mark.parametrize("name", ["SA4", "SA7", "SA8"])
def test_the_deciding_plan_is_above_the_threshold_and_free_of_jumps(name: str) -> None:
    damper = load(name)
    plan = list(recovery_plan(damper))
    assert len(plan) == 12
    for m in plan:
        assert np.all(np.diff(m.signal.time) > 0)
        v = np.abs(m.signal.velocity).max()
        assert v > 1.1 * damper.parameters.v_cav
        rates = np.abs(np.diff(m.signal.velocity)) / np.diff(m.signal.time)
        assert rates.max() < 2 * v**2 / 0.045
        long = m.signal.time[m.signal.marks[-OSCILLATIONS - 2]] - m.signal.time[m.signal.marks[0]]
        assert long == pytest.approx(60.0, abs=1.0)
