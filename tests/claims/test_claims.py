"""The claims are computed, complete and honest about what they rest on."""

import json
from dataclasses import asdict

import pytest

from twintube.calibrate import calibrate
from twintube.claims import Claim, evaluate
from twintube.claims.claim import FRONT, works
from twintube.parameters import load, names
from twintube.rig import BLOCKS


@pytest.fixture(scope="module")
def claims() -> dict[str, Claim]:
    return {c.id: c for c in evaluate()}


def test_all_fourteen_are_there(claims: dict[str, Claim]) -> None:
    assert list(claims) == [f"C{i}" for i in range(1, 15)]
    for claim in claims.values():
        assert claim.figures
        assert claim.needs or claim.id == "C8"
        json.dumps(asdict(claim))


def test_one_that_does_not_hold_says_why(claims: dict[str, Claim]) -> None:
    for claim in claims.values():
        assert bool(claim.reason) != claim.holds, claim.id


def test_calibrated_claims_are_no_evidence(claims: dict[str, Claim]) -> None:
    assert [c.id for c in claims.values() if c.calibrated] == ["C2", "C5", "C7"]
    assert [c.id for c in claims.values() if c.assumed] == ["C11", "C12"]
    assert not any(claims[i].evidence for i in ("C2", "C5", "C7", "C11", "C12"))


def test_a_claim_can_fail() -> None:
    """With cavitation in every damper that lost its preload, a full one loses work: C12 must notice."""
    other = {c.id: c for c in evaluate({"cavitation_needs": 1})}
    assert not other["C12"].holds


def test_figures_of_c4_are_those_of_the_works(claims: dict[str, Claim]) -> None:
    ratio = claims["C4"].figures["work_at_1.572_over_largest_below"]
    assert isinstance(ratio, dict)
    for name in FRONT:
        damper = load(name)
        last = [works(damper, damper.measured_levels[-1], v)[-1] for v in BLOCKS]
        assert ratio[name] == pytest.approx(last[-1] / max(last[:-1]), abs=1e-3)


@pytest.mark.parametrize("name", ["SA1", "SA8"])
def test_dead_length_in_the_file_is_the_calibrated_one(name: str) -> None:
    assert calibrate(load(name))[0].dead_length == pytest.approx(load(name).parameters.dead_length)


@pytest.mark.slow
@pytest.mark.parametrize("name", names())
def test_every_dead_length_is_the_calibrated_one(name: str) -> None:
    assert calibrate(load(name))[0].dead_length == pytest.approx(load(name).parameters.dead_length)
