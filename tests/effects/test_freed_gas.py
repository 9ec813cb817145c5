"""What becomes of the gas that cavitation frees: it stays, dissolves again, is limited, pushes oil."""

import math
from pathlib import Path

import numpy as np
import pytest

from twintube.core.effects import active
from twintube.dampers import Damper, ParameterError, load, names, to_toml
from twintube.dampers.freed_gas import (
    AS_PUBLISHED,
    DEFAULT,
    OWN,
    WAYS,
    acting,
    as_published,
    own_values,
    values_of,
    with_freed_gas,
)
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


def test_a_damper_is_loaded_with_the_default_and_as_published_without_any_effect() -> None:
    for name in names():
        assert acting(load(name)).startswith(f"{DEFAULT}: half of it dissolves again in 8.15 s")
        assert load(name) == with_freed_gas(load(name), DEFAULT)
        published = load(name, as_published=True)
        assert published == as_published(load(name)) == with_freed_gas(load(name), AS_PUBLISHED)
        assert active(published.parameters) == ()
        assert acting(published).startswith("stays: ")


@pytest.mark.parametrize("name", WAYS)
def test_a_file_says_what_freed_gas_does_and_reads_back_the_same(name: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    text = to_toml(load("SA8"))
    path.write_text(text.replace(f'freed_gas = "{DEFAULT}"', f'freed_gas = "{name}"'))
    own = load(path)
    assert own_values(own) == pytest.approx(values_of(name))
    assert to_toml(load(path)).count(f'freed_gas = "{name}"') == 1
    path.write_text(to_toml(own))
    assert load(path).parameters == own.parameters


def test_a_file_without_a_word_has_the_default_and_a_contradiction_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    lines = to_toml(load("SA8")).splitlines()
    at = next(i for i, line in enumerate(lines) if line.startswith("freed_gas"))
    silent = [*lines[:at], *lines[at + 1 :]]
    path.write_text("\n".join(silent))
    assert load(path).parameters == load("SA8").parameters
    rate = [line.replace("[gas_redissolution]", "[gas_redissolution]\nredissolution_rate = 0.0") for line in silent]
    path.write_text("\n".join(rate))
    assert load(path).parameters == load("SA8", as_published=True).parameters
    path.write_text("\n".join([lines[at], *rate]))
    with pytest.raises(ParameterError, match=r"line \d+: freed_gas = .* and gas_redissolution.redissolution_rate: give one"):
        load(path)
    path.write_text("\n".join([*lines[:at], 'freed_gas = "gone"', *lines[at + 1 :]]))
    with pytest.raises(ParameterError, match=r"line \d+: freed_gas = gone: must be one of stays, dissolves"):
        load(path)


@pytest.mark.parametrize("level", [0.9, 0.6])
def test_after_the_papers_rest_a_failed_damper_does_its_first_work_again(level: float) -> None:
    damper = load("SA8").with_(oil_level=level, gas_preload=0)
    healed, published = works(damper, REST), works(as_published(damper), REST)
    for found, heals in ((healed, True), (published, False)):
        first, last, again = found[0], found[-OSCILLATIONS - 2], found[-OSCILLATIONS]
        assert last < 0.5 * first  # it has failed
        assert (abs(again / first - 1) < 0.05) == heals


def test_gas_that_dissolves_heals_at_rest_and_displaced_oil_by_slow_strokes() -> None:
    damper = load("SA8").with_(oil_level=0.8, gas_preload=0)
    returning, displaced = with_freed_gas(damper, "dissolves"), with_freed_gas(damper, "pushes_oil")
    at_rest, stroked = (works(returning, 30.0, slow)[-OSCILLATIONS] for slow in (False, True))
    assert at_rest > 0.7 * stroked
    at_rest, stroked = (works(displaced, 30.0, slow)[-OSCILLATIONS] for slow in (False, True))
    assert at_rest < 0.7 * stroked
    assert at_rest == pytest.approx(works(displaced, 30.0, slow=False)[-OSCILLATIONS - 2], rel=0.05)


def test_displaced_oil_is_conserved_and_exhausted_oil_frees_what_it_holds() -> None:
    block = harmonic_block(1.572)
    damper = load("SA8", as_published=True).with_(oil_level=0.6, gas_preload=0)

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
            work_between(load("SA8", as_published=True).with_(oil_level=level, gas_preload=0), block.stroke, block.velocity, block.marks)[i]
            for level in levels
        ])  # fmt: skip
        assert np.all(np.diff(w) < 0)
        assert np.all(-np.diff(w) / w[0] < 10 * -np.diff(levels))


def test_a_parameter_set_with_its_own_way_is_left_alone() -> None:
    own = load("SA8").with_(redissolution_rate=0.5)
    assert with_freed_gas(own, DEFAULT) == own == as_published(own)
    assert acting(own) == "its own: redissolution_rate = 0.5"
    with pytest.raises(ParameterError, match="freed_gas = letters: must be one of stays, dissolves"):
        with_freed_gas(own, "letters")


def test_every_way_is_made_of_its_own_parameters() -> None:
    for item in WAYS.values():
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
