"""The verdict is decided in one function, from scores alone; its sentences name every cause."""

from dataclasses import replace

import numpy as np
import pytest

from twintube.diagnosis.candidates import Candidate
from twintube.diagnosis.faults import Fault
from twintube.diagnosis.result import Signature
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.select import RECALIBRATE, Option, Selection
from twintube.diagnosis.verdict import judge, sentence

COUNT = 1000  # held-out samples
SCORE = 2000.0  # of the model without a cause, twice the negative log-likelihood
TURNED = Fault("sign_flip", "Sign of the force channel", "The force channel has the other sign.", -1.0)
UNIT = Fault("unit_error", "Unit of the force", "The force channel holds kN for N.", 1000.0)


def candidate(name: str, title: str, fault: bool = False) -> Candidate:
    return Candidate(name, title, "", (), (), {}, fault, "a further record")


KNOWN = {
    c.name: c
    for c in (
        candidate("valve_wear", "Change of the F-v curve"),
        candidate("fluid_lag", "Lag of the fluid force"),
        candidate("force_gain", "Calibration of the force channel", fault=True),
    )
}


def option(*names: str, score: float) -> Option:
    return Option(names, (), np.ones(1), np.zeros(1), 0.0, score)


def selection(final: Option, *others: Option) -> Selection:
    start = option(score=SCORE)
    first = option(*(final.names[:1] or ("valve_wear",)), score=final.score)
    return Selection(start, [[first, *others]], list(final.names), final, start, COUNT, 10.0)


@pytest.mark.parametrize(
    ("names", "score", "verdict"),
    [
        ((), RULES.right * COUNT, "none"),
        ((), SCORE, "unexplained"),
        (("valve_wear",), 0.0, "cause"),
        (("valve_wear",), 0.9 * SCORE, "unexplained"),
        (("valve_wear", "fluid_lag"), 0.0, "cause"),
        ((RECALIBRATE,), 0.0, "recalibrate"),
        (("force_gain",), 0.0, "measurement_fault"),
    ],
)
def test_the_verdict_follows_from_what_is_chosen_and_what_is_left(
    names: tuple[str, ...], score: float, verdict: str
) -> None:
    judgement = judge(selection(option(*names, score=score)), KNOWN, [], 100.0, [])
    assert (judgement.verdict, judgement.remaining) == (verdict, verdict)
    assert bool(judgement.causes) == (verdict in ("cause", "measurement_fault"))


def test_equal_candidates_are_ambiguous_and_unequal_candidates_are_not() -> None:
    final = option("valve_wear", score=0.0)
    near, far = option("fluid_lag", score=5.0), option("fluid_lag", score=500.0)
    judgement = judge(selection(final, near), KNOWN, [], 100.0, [])
    assert (judgement.verdict, [o.names for o in judgement.rivals]) == ("ambiguous", [("fluid_lag",)])
    assert "lag of the fluid force" in sentence(judgement, KNOWN, [])
    assert judge(selection(final, far), KNOWN, [], 100.0, []).verdict == "cause"


def test_a_signature_decides_where_it_is_a_good_part_of_the_error() -> None:
    final = option("valve_wear", score=0.0)
    play = Signature("backlash", "the joint has play", 1.01 * RULES.shows * 100.0)
    judgement = judge(selection(final), KNOWN, [play], 100.0, [])
    assert (judgement.verdict, judgement.causes) == ("unexplained", [])
    assert "the joint has play" in sentence(judgement, KNOWN, [])
    small = replace(play, size=0.5 * play.size)
    assert judge(selection(final), KNOWN, [small], 100.0, []).verdict == "cause"


def test_faults_that_were_put_right_come_first_and_what_is_left_is_said() -> None:
    judgement = judge(selection(option("valve_wear", score=0.0)), KNOWN, [], 100.0, [TURNED, UNIT])
    assert (judgement.verdict, judgement.remaining) == ("measurement_fault", "cause")
    text = sentence(judgement, KNOWN, [TURNED, UNIT])
    assert text.startswith("The measurement is faulty: the force channel has the other sign; the force channel holds kN")
    assert text.count("put right") == 1
    assert "The cause: change of the F-v curve." in text


def test_several_causes_are_listed_as_several() -> None:
    judgement = judge(selection(option("valve_wear", "fluid_lag", score=0.0)), KNOWN, [], 100.0, [])
    text = sentence(judgement, KNOWN, [])
    assert text.startswith("Two causes: (1) change of the F-v curve; (2) lag of the fluid force.")
