"""The page of open measurements says what the model says, and what it says is refutable."""

import re
from pathlib import Path

import numpy as np
import pytest

from benchmarks.oil_leak import (
    AMPLITUDES,
    FALLS,
    FAST,
    SLOW,
    dead_lengths,
    force_left,
    level_at,
    levels,
    missing_at,
    with_valves_of,
)
from benchmarks.oil_leak_page import DIRECTIONS, GONE, build, by_stroke, volume_row
from twintube.dampers import freed_gas, load
from twintube.dampers.toml import names
from twintube.engine.simulate import simulate
from twintube.rig import harmonic_block

PAGE = (Path(__file__).parents[2] / "docs" / "claims.md").read_text(encoding="utf-8")
STEP = 0.1  # of the grid of the missing oil
MIDDLE = AMPLITUDES[1]


def published() -> dict[tuple[str, float], tuple[float, float]]:
    """Least and most missing oil of the page at the middle stroke, by direction and fall."""
    row = re.compile(r"\| (\w+), (\d+)% \|[^|]*\| ([\d.]+) to ([\d.]+) \|")
    return {(found[1], int(found[2]) / 100): (float(found[3]), float(found[4])) for found in row.finditer(PAGE)}


@pytest.mark.parametrize(
    ("name", "valves"), [("SA1", "SA1"), ("SA5", "SA8"), ("SA7", "SA3"), ("SA8", "SA4"), ("SA2", "SA7")]
)
def test_the_force_falls_within_the_published_band(name: str, valves: str) -> None:
    for damper in dead_lengths(load(name)):
        for key, value in missing_at(with_valves_of(damper, valves), MIDDLE).items():
            least, most = published()[key]
            assert least - 1e-9 <= value <= most + 1e-9, (key, value)


def test_the_ends_of_the_published_band_are_reached() -> None:
    builds = [("SA3", "SA3"), ("SA7", "SA7"), ("SA8", "SA5"), ("SA8", "SA4")]
    found = [missing_at(with_valves_of(load(name), valves), MIDDLE) for name, valves in builds]
    for key, ends in published().items():
        values = [case[key] for case in found]
        assert (min(values), max(values)) == pytest.approx(ends), key


def test_the_band_of_the_page_is_that_of_its_text() -> None:
    assert set(published()) == {(direction, fall) for direction in DIRECTIONS for fall in FALLS}
    assert max(most for _, most in published().values()) + STEP == pytest.approx(GONE)
    assert min(least for least, _ in published().values()) == 0.0
    assert f"V_c - {GONE:g} A_2 a" in PAGE and f"V_c + {STEP:g} A_2 a" in PAGE


def test_the_rows_of_the_builds_are_current() -> None:
    for name in names():
        published_row = next(line for line in PAGE.splitlines() if line.startswith(f"| {name} |"))
        row = build(name, volume_row(load(name)), {"highest 50%": 1.0, "lowest 50%": 0.0})
        assert published_row.split(" | ")[:-1] == row.split(" | ")[:-1]


def test_fast_levels_of_a_build_lie_in_its_row() -> None:
    row = next(line for line in PAGE.splitlines() if line.startswith("| SA8 |"))
    highest, lowest = (int(level) / 100 for level in re.findall(r"(\d+)% to (\d+)% \|$", row)[0])
    short, long = dead_lengths(load("SA8"))
    found = level_at(short, MIDDLE, freed_gas.DEFAULT), level_at(long, MIDDLE, freed_gas.DEFAULT)
    assert all(lowest <= case[direction, 0.5] <= highest for case in found for direction in DIRECTIONS)


@pytest.mark.parametrize("way", freed_gas.VARIED)
def test_freed_gas_does_not_matter_below_the_speed_of_cavitation(way: str) -> None:
    damper = load("SA7")
    assert damper.parameters.v_cav > SLOW
    level = levels(damper).oil_level(0.4, MIDDLE)
    assert force_left(damper, level, SLOW, MIDDLE, way) == force_left(damper, level, SLOW, MIDDLE, freed_gas.DEFAULT)


@pytest.mark.parametrize(("name", "valves"), [("SA1", "SA1"), ("SA6", "SA5"), ("SA8", "SA8"), ("SA3", "SA7")])
@pytest.mark.parametrize("share", [0.1, 0.5, 0.8])
def test_rebound_loses_a_corner_and_is_whole_behind_it(name: str, valves: str, share: float) -> None:
    damper = with_valves_of(load(name), valves)
    block = harmonic_block(SLOW, MIDDLE)
    worn = freed_gas.condition(damper, levels(damper).oil_level(share, MIDDLE), 0)
    left = simulate(worn, block.stroke, block.velocity, block.time).k_degr[block.marks[-2] : block.marks[-1]]
    moving = block.velocity[block.marks[-2] : block.marks[-1]] > 0.05
    beginning = left[moving] <= 0.3 + 1e-9  # the largest X_Re of Table 9
    whole = left[moving] > 0.9
    assert np.mean(beginning | whole) > 0.99
    assert np.all(np.diff(whole.astype(int)) >= 0)


def test_a_longer_stroke_keeps_the_rebound_force_down_to_less_oil() -> None:
    damper = load("SA8")
    at = [levels(damper).oil_level(missing_at(damper, amplitude)["rebound", 0.5], amplitude) for amplitude in AMPLITUDES]
    assert at[0] > at[1] > at[2]


@pytest.mark.parametrize("v", [SLOW, FAST])
def test_the_intact_force_does_not_know_the_stroke(v: float) -> None:
    for amplitude in AMPLITUDES:
        assert force_left(load("SA8"), 1.0, v, amplitude, freed_gas.DEFAULT) == pytest.approx((1.0, 1.0), abs=1e-3)


def test_a_table_has_a_column_for_every_stroke() -> None:
    band = {"least": 0.0, "most": 1.0}
    table = by_stroke({f"{stroke}, rebound, 10%": band for stroke in ("25 mm", "50 mm")})
    assert table[-1] == "| rebound, 10% | 0.0 to 1.0 | 0.0 to 1.0 |"
