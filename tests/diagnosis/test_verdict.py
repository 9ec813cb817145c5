"""The verdict is decided in one function, from scores and figures; its sentences name every cause and it contradicts no figure."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from twintube.diagnosis.fits.candidates import LOSING, RECALIBRATE, Candidate
from twintube.diagnosis.fits.options import Option, Selection
from twintube.diagnosis.measurement.faults import Fault
from twintube.diagnosis.result import Errors, Estimate, Gain, Map, Signature, Tried
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.verdict.verdict import Judgement, judge, sentence
from twintube.diagnosis.verdict.where import describe

COUNT = 1000  # held-out samples
SCORE = 2000.0  # of the model without a cause, twice the negative log-likelihood
LEAST = 0.01  # strength that every measurement has
TURNED = Fault("sign_flip", "Sign of the force channel", "The force channel has the other sign.", -1.0)
UNIT = Fault("unit_error", "Unit of the force", "The force channel holds kN for N.", 1000.0)
GOOD = Gain(0.9, 0.9, (0.8, 0.95), 0.7)
FOUND = Estimate(0.2, 0.15, 0.25, "1", (-0.8, 1.0), 0.0)


def candidate(name: str, title: str, fault: bool = False) -> Candidate:
    return Candidate(name, title, "", (), ("strength",), {}, fault, "a further record", {"strength": LEAST})


KNOWN = {
    c.name: c
    for c in (
        candidate("valve_wear", "Change of the F-v curve"),
        candidate("fluid_lag", "Lag of the fluid force"),
        candidate("side_load_friction", "Friction"),
        candidate("position_friction", "Friction at a place"),
        candidate("force_gain", "Calibration of the force channel", fault=True),
        candidate("oil_level_error", "Fill"),
    )
}


def option(*names: str, score: float) -> Option:
    squares = np.full(1, COUNT * np.exp(score / COUNT))
    return Option(names, (), (), np.ones(1), np.zeros(1), squares, score)


def selection(final: Option, *others: Option, start: float = SCORE) -> Selection:
    first = option(*(final.names[:1] or ("valve_wear",)), score=final.score)
    first_model = option(score=start)
    return Selection(first_model, [[first, *others]], list(final.names), final, first_model, COUNT, 10.0, (), [])


def judged(
    chosen: Selection,
    *,
    value: Estimate = FOUND,
    seen: Sequence[Signature] = (),
    forces: tuple[float, float, float] = (100.0, 14.0, 10.0),
    works: tuple[float, float, float] = (0.0, 0.0, 0.0),
    gain: Gain = GOOD,
    faults: Sequence[Fault] = (),
    attempts: Sequence[Tried] = (),
) -> Judgement:
    """The verdict; `forces` [N] and `works` [J] are the held-out errors of base and extended model and of noise."""
    names = ("base", "extended", "noise_floor")
    errors = {name: Errors(force, work) for name, force, work in zip(names, forces, works, strict=True)}
    estimates = {name: {"strength": value} for name in KNOWN}
    return judge(chosen, KNOWN, estimates, list(seen), errors, gain, list(faults), attempts)


def test_a_cause_is_no_rival_of_itself_with_another() -> None:
    both = selection(option("valve_wear", "fluid_lag", score=1.0), option("fluid_lag", score=1.0))
    assert judged(both).verdict == "cause"
    assert judged(selection(option("valve_wear", score=1.0), option("fluid_lag", score=1.0))).verdict == "ambiguous"


@pytest.mark.parametrize(
    ("names", "score", "gain", "verdict"),
    [
        ((), RULES.right * COUNT, 0.0, "none"),
        ((), SCORE, 0.0, "unexplained"),
        (("valve_wear",), 0.0, 0.9, "cause"),
        (("valve_wear",), 0.9 * SCORE, 0.1, "unexplained"),
        (("valve_wear", "fluid_lag"), 0.0, 0.9, "cause"),
        ((RECALIBRATE,), 0.0, 0.9, "recalibrate"),
        (("force_gain",), 0.0, 0.9, "measurement_fault"),
    ],
)
def test_the_verdict_follows_from_what_is_chosen_and_what_is_left(
    names: tuple[str, ...], score: float, gain: float, verdict: str
) -> None:
    forces = (10.5, 10.5, 10.0) if verdict == "none" else (100.0, 14.0, 10.0)
    judgement = judged(selection(option(*names, score=score)), gain=replace(GOOD, heldout=gain), forces=forces)
    assert (judgement.verdict, judgement.remaining) == (verdict, verdict)
    assert bool(judgement.causes) == (verdict in ("cause", "measurement_fault"))


@pytest.mark.parametrize(
    "figures",
    [
        {"gain": replace(GOOD, heldout=-1.63)},
        {"gain": replace(GOOD, heldout=0.0)},
        {"gain": replace(GOOD, heldout_interval=(-0.1, 0.95))},
        {"forces": (100.0, 101.0, 10.0)},
        {"forces": (10.0, 9.0, 10.0)},
        {"value": replace(FOUND, low=-0.05)},
        {"value": replace(FOUND, value=1.0, low=0.9, high=1.0)},
        {"value": replace(FOUND, value=0.5 * LEAST, low=0.4 * LEAST, high=0.6 * LEAST)},
        {"value": replace(FOUND, value=0.63, low=0.6, high=0.66)},
    ],
    ids=["worse", "no gain", "gain open", "error rises", "base at noise", "interval holds zero", "end of range", "every measurement's",
         "another damper"],
)  # fmt: skip
@pytest.mark.parametrize("name", ["valve_wear", "force_gain"])
def test_no_cause_is_named_against_a_figure(name: str, figures: dict[str, object]) -> None:
    chosen = selection(option(name, score=0.0))
    judgement = judged(chosen, **figures)  # type: ignore[arg-type]
    base, _, floor = figures.get("forces", (100.0, 20.0, 10.0))  # type: ignore[misc]
    verdict = "none" if base <= RULES.quiet * floor else "unexplained"
    assert (judgement.verdict, judgement.causes, judgement.kept) == (verdict, [], [])
    assert judged(chosen, **figures | {"forces": (10.5, 10.6, 10.0)}).verdict == "none"  # type: ignore[arg-type]


def test_a_large_leak_is_no_stiffer_damper() -> None:
    leak = replace(FOUND, value=0.45, low=0.44, high=0.46, unit="m/s")
    assert judged(selection(option("valve_wear", score=0.0)), value=leak).verdict == "cause"
    stiffer = judged(selection(option("valve_wear", score=0.0)), value=replace(leak, unit="1"))
    assert stiffer.verdict == "unexplained" and "identify this damper first" in stiffer.doubts["valve_wear"]


def test_whatever_the_figures_are_a_named_cause_agrees_with_them() -> None:
    rng = np.random.default_rng(7)
    named = 0
    for _ in range(2000):
        middle, base = rng.uniform(-0.2, 1.2), rng.uniform(0.0, 100.0)
        wide, spread = rng.uniform(0.0, 0.5, 2)
        gain = Gain(0.9, middle, (middle - wide, min(1.0, middle + wide)), 0.0)
        x = rng.uniform(-0.8, 1.0)
        value = replace(FOUND, value=x, low=max(-0.8, x - spread), high=min(1.0, x + spread))
        forces = (base, base * rng.uniform(0.1, 1.2), base * rng.uniform(0.0, 1.2))
        names = (("valve_wear",), ("force_gain",), ("valve_wear", "fluid_lag"))[rng.integers(3)]
        score = rng.uniform(0.0, SCORE)
        chosen = selection(option(*names, score=score), option("fluid_lag", score=score + rng.uniform(0.0, 100.0)))
        judgement = judged(chosen, value=value, forces=forces, gain=gain)
        if judgement.verdict in ("cause", "ambiguous", "measurement_fault"):
            named += 1
            assert judgement.causes == list(names)
            assert gain.heldout > 0.0 and gain.heldout_interval[0] > 0.0
            assert forces[1] < forces[0] and forces[2] < forces[0]
            assert abs(value.value) > LEAST and not value.low <= 0.0 <= value.high and not value.at_bound
        else:
            assert (judgement.causes, judgement.kept) == ([], [])
        assert judgement.verdict != "none" or forces[0] <= RULES.quiet * forces[2]
    assert named > 100


def test_a_doubt_is_said() -> None:
    end = replace(FOUND, value=1.0, low=0.9, high=1.0)
    text = sentence(judged(selection(option("valve_wear", score=0.0)), value=end), KNOWN, [])
    assert "no known cause" in text and "at the end of its range, -0.8 to 1" in text


def test_what_follows_much_must_explain_more_where_much_is_left() -> None:
    for name, gain, left, verdict in (
        ("fluid_lag", 0.7, 50.0, "unexplained"), ("fluid_lag", 0.7, 12.0, "cause"), ("fluid_lag", 0.95, 50.0, "cause"),
        ("fluid_lag", 0.85, 50.0, "unexplained"), (RECALIBRATE, 0.85, 50.0, "recalibrate"), ("valve_wear", 0.7, 50.0, "cause"), ("force_gain", 0.95, 50.0, "unexplained"), (RECALIBRATE, 0.7, 50.0, "unexplained"), (RECALIBRATE, 0.7, 12.0, "recalibrate"),
    ):  # fmt: skip
        chosen = selection(option(name, score=0.5 * SCORE))
        assert judged(chosen, gain=replace(GOOD, heldout=gain), forces=(100.0, left, 10.0)).verdict == verdict


def test_equal_candidates_are_ambiguous_and_unequal_candidates_are_not() -> None:
    final = option("valve_wear", score=0.0)
    near, far = option("fluid_lag", score=5.0), option("fluid_lag", score=500.0)
    judgement = judged(selection(final, near))
    assert (judgement.verdict, [o.names for o in judgement.rivals]) == ("ambiguous", [("fluid_lag",)])
    assert "lag of the fluid force" in sentence(judgement, KNOWN, [])
    assert judged(selection(final, far)).verdict == "cause"
    assert judged(replace(selection(final, near), neutral=("fluid_lag",))).verdict == "cause"


def test_a_gain_that_leaves_noise_alone_has_rivals_within_noise_only() -> None:
    score = 0.4 * RULES.close * SCORE  # beyond noise
    for name, left, verdict in (
        ("force_gain", 10.0, "measurement_fault"),
        ("force_gain", 14.0, "ambiguous"),
        ("side_load_friction", 10.0, "ambiguous"),
    ):
        chosen = selection(option(name, score=0.0), option("fluid_lag", score=score))
        assert judged(chosen, forces=(100.0, left, 10.0)).verdict == verdict
    noise = selection(option("force_gain", score=0.0), option("fluid_lag", score=5.0))
    assert judged(noise, forces=(100.0, 10.0, 10.0)).verdict == "ambiguous"


@pytest.mark.parametrize(("other", "verdict"), [("position_friction", "cause"), ("fluid_lag", "ambiguous")])
def test_a_friction_that_follows_a_good_part_of_another_is_no_rival(other: str, verdict: str) -> None:
    score = 0.5 * SCORE
    others = [option(other, score=(1.0 + 0.5 * RULES.law_apart) * score)]
    chosen = selection(option("side_load_friction", score=score), *others)
    assert judged(chosen, forces=(100.0, 20.0, 10.0)).verdict == verdict
    assert judged(selection(option("side_load_friction", score=score), option(other, score=score))).verdict == "ambiguous"


@pytest.mark.parametrize(("left", "verdict"), [(0.0, "cause"), (1.0, "ambiguous")])
def test_a_fill_that_leaves_far_more_than_noise_may_be_a_leak(left: float, verdict: str) -> None:
    """A fill that is wrong all along has no other formulation; a leak, which has, loses most of it before."""
    final = option("oil_level_error", score=left * COUNT)
    gained = SCORE - left * COUNT
    leak = option(*LOSING, score=final.score + 0.9 * RULES.contents_apart * gained)
    other = option("fluid_lag", score=final.score + 0.9 * RULES.contents_apart * gained)
    for rival, said in ((leak, verdict), (other, "cause")):
        assert judged(selection(final, rival), forces=(100.0, 10.5, 10.0)).verdict == said


def test_a_signature_decides_where_it_is_a_good_part_of_the_error() -> None:
    final = option("valve_wear", score=0.0)
    play = Signature("backlash", "the joint has play", 1.01 * RULES.shows * 100.0)
    judgement = judged(selection(final), seen=[play])
    assert (judgement.verdict, judgement.causes) == ("unexplained", [])
    assert "the joint has play" in sentence(judgement, KNOWN, [])
    assert judged(selection(final), seen=[replace(play, size=0.5 * play.size)]).verdict == "cause"
    # A cause that leaves noise alone leaves nothing to the signature.
    assert judged(selection(final), seen=[play], forces=(100.0, 10.5, 10.0)).verdict == "cause"


def test_what_repeats_in_every_oscillation_is_no_cause_where_the_model_is_right_within_noise() -> None:
    """A ring after a step of the model's own force; a line of the mains does not repeat, and counts as noise."""
    nothing = selection(option(score=0.0), start=0.0)
    ring = Signature("ringing", "the force rings at about 20 Hz", 20.0, repeats=True)
    good, bad = (10.5, 10.5, 10.0), (30.0, 30.0, 10.0)
    assert judged(nothing, seen=[ring], forces=good).verdict == "none"
    assert judged(nothing, seen=[ring], forces=bad).verdict == "unexplained"
    assert judged(nothing, seen=[replace(ring, repeats=False)], forces=good).verdict == "unexplained"


def test_forces_that_were_cut_do_not_hide_a_cause_and_nothing_cut_off_is_called_good() -> None:
    cut = Signature("saturation", "the force is clipped at 1800 N", np.inf)
    assert judged(selection(option("valve_wear", score=0.0)), seen=[cut]).verdict == "cause"
    assert judged(selection(option(score=0.0), start=0.0), seen=[cut]).verdict == "unexplained"


def test_faults_that_were_put_right_come_first_and_what_is_left_is_said() -> None:
    judgement = judged(selection(option("valve_wear", score=0.0)), faults=[TURNED, UNIT])
    assert (judgement.verdict, judgement.remaining) == ("measurement_fault", "cause")
    text = sentence(judgement, KNOWN, [TURNED, UNIT])
    assert text.startswith("The measurement is faulty: the force channel has the other sign; the force channel holds kN")
    assert text.count("put right") == 1
    assert "The cause: change of the F-v curve." in text


def test_several_causes_are_listed_as_several() -> None:
    text = sentence(judged(selection(option("valve_wear", "fluid_lag", score=0.0))), KNOWN, [])
    assert text.startswith("Two causes: (1) change of the F-v curve; (2) lag of the fluid force.")


def test_a_cause_whose_row_on_the_page_allows_for_no_gain_is_not_named() -> None:
    chosen = selection(option("valve_wear", score=20.0))
    rows = [Tried(1, "valve_wear", 0.9, (low, 1.0), "chosen", "") for low in (0.1, -0.1)]
    assert judged(chosen, attempts=rows[:1]).causes == ["valve_wear"]
    assert judged(chosen, attempts=rows[1:]).verdict == "unexplained"


def test_where_noise_is_left_a_cause_explains_half_at_least() -> None:
    chosen = selection(option("valve_wear", score=20.0))
    forces = (11.5, 11.0, 10.0)
    assert judged(chosen, forces=forces, gain=replace(GOOD, heldout=0.55)).causes == ["valve_wear"]
    assert judged(chosen, forces=forces, gain=replace(GOOD, heldout=0.25)).verdict == "unexplained"


def test_within_noise_an_effect_is_named_by_what_it_explains_and_a_fault_by_half_of_the_misfit() -> None:
    forces = (10.8, 10.05, 10.0)
    wear, late = selection(option("valve_wear", score=20.0)), selection(option("fluid_lag", score=20.0))
    assert judged(wear, forces=forces).causes == ["valve_wear"]
    assert judged(wear, forces=forces, gain=replace(GOOD, heldout=0.25)).verdict == "none"
    assert judged(late, forces=forces).verdict == "none", "sampling moves steps, too"
    assert judged(late, forces=(11.4, 10.05, 10.0)).verdict == "unexplained"
    assert judged(late, forces=(11.6, 10.05, 10.0)).causes == ["fluid_lag"]
    for score, causes in ((0.6 * SCORE, []), (0.4 * SCORE, ["force_gain"])):
        assert judged(selection(option("force_gain", score=score)), forces=forces).causes == causes


def test_a_fault_that_was_put_right_is_not_named_again_where_its_removal_leaves_noise() -> None:
    gain = Fault("force_gain", "Calibration", "The force channel reads 5 % too much from b on.", 1.05)
    for base, causes in ((10.5, []), (14.0, ["force_gain"])):
        chosen = selection(option("force_gain", score=0.2 * SCORE))
        assert judged(chosen, forces=(base, 10.0, 10.0), faults=[gain]).causes == causes


def test_within_noise_no_cause_is_named_that_something_else_surpasses_by_far() -> None:
    for score, causes in ((0.7 * SCORE, []), (0.2 * SCORE, ["valve_wear"])):
        chosen = selection(option("valve_wear", score=score), option("fluid_lag", score=0.05 * SCORE))
        assert judged(replace(chosen, neutral=("fluid_lag",)), forces=(10.8, 10.05, 10.0)).causes == causes


def test_a_rival_of_one_of_two_causes_is_judged_beside_the_other() -> None:
    pair = selection(option("side_load_friction", "valve_wear", score=1.0), option("position_friction", score=1.1))
    rounds = [[option("side_load_friction", score=30.0), option("position_friction", score=30.5)]]
    alike = replace(pair, rounds=rounds, beside=[option("valve_wear", "position_friction", score=2.0)])
    apart = replace(pair, rounds=rounds, beside=[option("valve_wear", "position_friction", score=0.1 * SCORE)])
    judgement = judged(alike)
    assert judgement.verdict == "ambiguous" and [o.names[-1] for o in judgement.rivals] == ["position_friction"]
    text = sentence(judgement, KNOWN, [])
    assert "Two causes: change of the F-v curve; and friction or friction at a place, which" in text
    assert judged(apart).verdict == "cause"


def test_a_rival_of_the_second_of_two_causes_is_judged_beside_the_first() -> None:
    """As of a compliance of the oil in place of a mount, beside friction: the friction is sure."""
    pair = selection(option("side_load_friction", "valve_wear", score=1.0), option("fluid_lag", score=9.0))
    first = [option("side_load_friction", score=30.0), option("valve_wear", score=35.0)]
    for score, verdict in ((2.0, "ambiguous"), (0.1 * SCORE, "cause")):
        second = [option("side_load_friction", "valve_wear", score=1.0),
                  option("side_load_friction", "fluid_lag", score=score)]  # fmt: skip
        judgement = judged(replace(pair, rounds=[first, second], beside=[]))
        assert judgement.verdict == verdict
        assert [o.names[-1] for o in judgement.rivals] == (["fluid_lag"] if verdict == "ambiguous" else [])


def test_a_cause_is_not_named_where_other_parameters_explain_far_more() -> None:
    chosen = selection(option("fluid_lag", score=10.0))
    better = replace(option(RECALIBRATE, score=5.0), squares=0.5 * chosen.final.squares)
    judgement = judged(replace(chosen, recalibrated=better))
    assert judgement.verdict == "unexplained"
    assert "other values of the degradation parameters explain far more" in sentence(judgement, KNOWN, [])
    assert judged(replace(chosen, recalibrated=replace(better, squares=0.9 * chosen.final.squares))).verdict == "cause"


def test_what_became_superfluous_beside_a_cause_is_its_rival() -> None:
    first, second = option("valve_wear", score=1.0), option("fluid_lag", score=2.0)
    kept = replace(selection(second), rounds=[[first, second]])
    judgement = judged(kept)
    assert judgement.verdict == "ambiguous" and [o.names for o in judgement.rivals] == [("valve_wear",)]


def residual(quantity: str, means: Sequence[float], about: float) -> Map:
    """A map of errors with these means, and a spread `about` each."""
    mean = np.array(means)
    size = np.hypot(mean, about)
    return Map(quantity, "m", np.arange(len(means)) / 10.0, size, size / 2, np.ones(len(means)), mean)


def test_an_error_that_is_the_same_everywhere_is_described_as_a_constant() -> None:
    """Both channels of the other sign turn the force of the gas: nothing is larger at any place, and all is wrong."""
    turned = [residual("stroke", (115.0, 112.0, np.nan, 118.0), 8.0), residual("time", (116.0, 113.0), 8.0)]
    assert describe(turned).startswith("everywhere by 115 N (measured above simulated)")
    assert "less gas" in describe(turned) and "both of the other sign" in describe(turned)
    assert "everywhere" not in describe([residual("stroke", (5.0, 5.0, 60.0), 8.0)])
    assert "everywhere" not in describe([residual("stroke", (50.0, -50.0, 50.0), 1.0)])
