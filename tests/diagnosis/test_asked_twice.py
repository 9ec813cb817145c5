"""The same records asked otherwise: another stated level within its tolerance, another order of the files."""

from dataclasses import replace

import pytest

from tests.diagnosis import small
from tests.diagnosis.specimen import own_law
from twintube.dampers import load
from twintube.data import LoadedDataset
from twintube.diagnosis import Answer, answer

LEVEL = small.DEGRADED
CATALOGUE = ("valve_wear", "smooth_transition", "force_gain", "channel_delay")  # what a few per cent look like


def asked(stated: float | None, *, backwards: bool = False) -> Answer:
    """The answer to three records of a damper that is off its set and holds 56 % of its oil.

    A file says more or less, or that nobody knows.
    """
    records = []
    for i, speed in enumerate((0.131, 0.524, 1.048)):
        run = small.run(speed, LEVEL, turns=4, slow=2)
        records.append(
            replace(small.record(run, own_law(run), seed=i), oil_level=stated, gas_preload=None if stated is None else False)
        )
    records = records[::-1] if backwards else records
    return answer(LoadedDataset("Small", load("SA8", as_published=True), records, []), catalogue=CATALOGUE)


@pytest.fixture(scope="module")
def as_it_is() -> Answer:
    return asked(LEVEL)


def test_the_answer_does_not_depend_on_how_it_is_asked(as_it_is: Answer) -> None:
    other = asked(LEVEL - 0.02, backwards=True)
    likeliest = []
    for found in (as_it_is, other):
        assert found.changes is not None
        first = found.changes.hypotheses[0]
        assert first.name == "none" and first.found is not None
        levels = [x for name, x in first.found.levels.items() if name.startswith("oil_level")]
        assert levels == pytest.approx([LEVEL], abs=0.003)
        likeliest.append(first.found.values)
    assert likeliest[0] == likeliest[1]


def test_a_fill_that_nobody_states_is_that_of_the_hypotheses(as_it_is: Answer) -> None:
    assert as_it_is.changes is not None and as_it_is.changes.hypotheses[0].found is not None
    (level,) = (x for name, x in as_it_is.changes.hypotheses[0].found.levels.items() if name.startswith("oil_level"))
    (unknown,) = asked(None).states
    low, high = unknown.posterior.interval()
    assert low < level < high
    assert unknown.posterior.gas_lost > 0.99
