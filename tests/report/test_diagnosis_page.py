"""The page of a diagnosis says what it rests on, and draws no certainty where it has none."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

from tests.diagnosis import small
from twintube.dampers import load
from twintube.diagnosis import Answer
from twintube.diagnosis.heldout import HeldOut
from twintube.report.common.html_page import Headline, Page
from twintube.report.diagnosis import changes, page


def test_it_names_the_damper_and_what_of_it_is_assumed() -> None:
    text = page.taken(load("SA8"))
    assert "taken to be SA8" in text
    assert "Assumed in that parameter set, not measured: F-v curve, friction, gas force, dead length (80 mm)." in text
    assert "Assumed" not in page.taken(replace(load("SA8"), assumed={}))


def test_it_tells_motions_and_fills() -> None:
    full = small.record(small.run(0.3))
    open_fill = replace(full, oil_level=None, gas_preload=None)
    assert page.covered([full, open_fill]) == (
        "Covered: 2 records up to 0.30 m/s and 45 mm from the middle; fills: 100 % oil, gas kept, unknown. "
        "It says nothing of faster strokes."
    )


def test_the_limits_are_not_folded() -> None:
    found: Any = SimpleNamespace(damper=load("SA8"), records=(small.record(small.run(0.3)),), changes=None)
    text = Page("A title", [page.limits(cast(Answer, found))], headline=Headline("An answer")).html
    assert "<details open><summary><h2>What this cannot say</h2>" in text


def test_what_nothing_explains_has_no_bar_of_a_probability() -> None:
    left = (HeldOut("fast", 126.0, 125.0, 4.0),)
    found: Any = SimpleNamespace(unexplained="what is left comes and goes", held_out=left, changes=object())
    (ax,) = changes.picture(cast(Answer, found)).axes
    assert ax.get_xlabel() == "force error, RMS [N]"
    assert max(bar.get_width() for bar in cast(Any, ax.patches)) == 126.0


def test_a_cause_that_makes_left_out_records_worse_has_no_bar_of_a_probability_either() -> None:
    """Over 99 % and "the records cannot tell" would contradict each other."""
    only = SimpleNamespace(name="oil_displacement", kind="effect", probability=1.0, found=object())
    found: Any = SimpleNamespace(
        unexplained="", doubted=True, doubting=("none",), compared=False, faults=(), changes=SimpleNamespace(hypotheses=[only]),
        named=(only, SimpleNamespace(name="none", kind="none", probability=0.0, found=None)),
        held_out=(HeldOut("slow", 10.0, 4.0, 2.0), HeldOut("fast", 37.0, 67.0, 3.0)),
    )  # fmt: skip
    (ax,) = changes.picture(cast(Answer, found)).axes
    assert ax.get_xlabel() == "force error, RMS [N]"
    assert changes.sentence(cast(Answer, found)) == (
        "The records cannot tell: freed gas displaces oil explains all records best (over 99 %), "
        "but nothing is missing predicts records that were left out better."
    )
