"""Both channels of the other sign in degraded records, of which only a simulation tells it."""

from collections.abc import Sequence
from dataclasses import replace

import pytest

from tests.diagnosis import small
from twintube.dampers import load
from twintube.data import LoadedDataset, Record
from twintube.identification import harmonic
from twintube.identification.remarks import signs


@pytest.fixture(scope="module")
def records() -> list[Record]:
    return small.records(speeds=(0.4, 0.8), levels=(small.DEGRADED,))


def remarked(records: Sequence[Record]) -> list[str]:
    return signs(LoadedDataset("Small", load("SA8"), list(records), []), [harmonic(r) for r in records])


def test_turned_records_are_remarked_with_the_keys(records: list[Record]) -> None:
    turned = [replace(r, stroke=-r.stroke, velocity=-r.velocity, force=-r.force) for r in records]
    assert remarked(records) == []
    (remark,) = remarked(turned)
    assert "force_sign = -1 and stroke_sign = -1" in remark
    assert remarked([*turned[:1], *records[1:]]) == []  # nobody knows which of them


def test_a_damper_with_less_oil_than_stated_is_not_remarked(records: list[Record]) -> None:
    assert remarked([replace(r, oil_level=1.0, gas_preload=True) for r in records]) == []
    dry = small.records(speeds=(0.4, 0.8), levels=(0.15,))
    assert remarked([replace(r, oil_level=1.0, gas_preload=True) for r in dry]) == []
