"""A catalogue says what may be the cause: nothing else is looked at."""

import re

import pytest

from tests.diagnosis import small
from twintube.dampers import load
from twintube.data import LoadedDataset
from twintube.diagnosis import answer

DATASET = LoadedDataset("Small", load("SA8", as_published=True), small.records(lambda r: r.force + 80.0, (0.3, 0.6)), [])


def test_only_what_the_catalogue_names_can_be_the_cause() -> None:
    found = answer(DATASET, catalogue=["force_gain", "gas_spring"])
    assert found.changes is not None
    singles = {part for h in found.changes.hypotheses if h.kind in ("effect", "fault") for part in h.name.split("+")}
    assert singles == {"force_gain", "gas_spring"}


@pytest.mark.parametrize(
    ("catalogue", "said"),
    [
        (["gas_sprig"], "catalogue: 'gas_sprig': must be one of end_stop, "),
        ("gas_spring", "catalogue = 'gas_spring': must be a list of some of end_stop, "),
        ([], "catalogue = []: must be a list of some of end_stop, "),
    ],
)
def test_a_catalogue_of_something_else_is_refused(catalogue: list[str] | str, said: str) -> None:
    with pytest.raises(ValueError, match=re.escape(said)):
        answer(DATASET, catalogue=catalogue)
