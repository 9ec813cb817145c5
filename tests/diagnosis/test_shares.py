"""A part of the gas preload that is lost is found with an interval, and one that is stated is believed and judged."""

from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from tests.diagnosis.specimen import own_law
from twintube.dampers import load
from twintube.data import LoadedDataset, Record
from twintube.diagnosis import StateAnswer, answer, states
from twintube.diagnosis.bench import Bench
from twintube.diagnosis.contract import as_json
from twintube.diagnosis.frame import Frame
from twintube.diagnosis.records.prepare import prepare
from twintube.diagnosis.shares import SHARES, Asked, nearest, ways
from twintube.diagnosis.sizes import USUAL
from twintube.diagnosis.state import STEP
from twintube.report.diagnosis import state as page

SA3 = load("SA3", as_published=True)
SHARE = 0.4
CATALOGUE = ("gas_spring", "valve_wear", "force_offset")


def records(gas: float | None) -> list[Record]:
    """Two sines of a full damper off its law that has lost a part of its gas, of which a file says what is given."""
    several = []
    for i, speed in enumerate((0.3, 0.6)):
        run = small.run(speed, damper=SA3, gas=SHARE)
        several.append(replace(small.record(run, own_law(run), seed=i), oil_level=None, gas_preload=gas, state="1"))
    return several


def found(gas: float | None) -> StateAnswer:
    return states(LoadedDataset("small", SA3, records(gas), []))[0]


@pytest.fixture(scope="module")
def unknown() -> StateAnswer:
    return found(None)


def test_a_part_of_the_gas_is_found_with_its_interval(unknown: StateAnswer) -> None:
    p = unknown.posterior
    low, high = p.gas_interval()
    assert low <= p.gas <= high
    assert low <= SHARE <= high
    assert low > 0.0 and high < 1.0
    assert max(p.gas_there, p.tared) < 0.05
    assert unknown.as_json()["gas_preload"] == {"value": round(p.gas, 4), "interval": [round(low, 4), round(high, 4)]}
    text = f"its gas preload is at {100 * p.gas:.0f} % ({100 * low:.0f} to {100 * high:.0f} %)"
    assert text in page.sentence(unknown)


def test_a_share_that_is_stated_as_it_was_found_changes_nothing(unknown: StateAnswer) -> None:
    other = found(unknown.posterior.gas).posterior
    assert other.as_stated > 0.95
    assert other.level == pytest.approx(unknown.posterior.level, abs=0.02)
    assert other.interval() == pytest.approx(unknown.posterior.interval(), abs=0.03)
    assert other.gas == pytest.approx(unknown.posterior.gas, abs=0.02)


def test_a_stated_share_is_judged() -> None:
    """A damper whose file is right lacks nothing; its fill is answered with the share that was stated."""
    told = [replace(r, oil_level=1.0) for r in records(SHARE)]
    entry = as_json(answer(LoadedDataset("small", SA3, told, []), catalogue=CATALOGUE))
    assert entry["verdict"] in ("none", "tolerance")
    assert entry["state"][0]["stated"] == {"oil_level": 1.0, "gas_preload": SHARE}
    assert entry["state"][0]["as_stated"] > 0.9


def test_where_oil_is_full_every_simulation_says_the_same_of_every_share() -> None:
    """The gas changes nothing but its own force there, which goes with its share in a straight line.

    What gain and delay of the bench make of that force is left out: it is less than what divides a cell of the grid.
    """
    bench = Bench(SA3, prepare(LoadedDataset("small", SA3, records(None), [])))
    mine = np.ones(len(bench.records), dtype=bool)
    several = []
    for share in (0.0, 0.5, 1.0):
        states = bench.states.copy()
        states[:, 1] = share
        errors = bench.measured - bench.with_states(states)
        several.append(Asked(Frame(bench, states), np.column_stack([errors, ways(bench, mine)]), share).at(USUAL))
    for other in several[1:]:
        assert other == pytest.approx(several[0], abs=STEP)
    assert several[0][0, nearest(SHARE)] > several[0][0, [0, len(SHARES) - 1]].max()
    bench.threads.shutdown()
