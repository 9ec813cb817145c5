"""Balancing the records is explicit: problems do not change, and a selector has its start from the beginning."""

from dataclasses import replace

import numpy as np
import pytest

from tests.diagnosis import small
from twintube.diagnosis.fits.candidates import RECALIBRATE, candidates, nuisances
from twintube.diagnosis.fits.fit import Problem
from twintube.diagnosis.fits.options import Fold, Option
from twintube.diagnosis.records.seen import DELAY, INERTIA
from twintube.diagnosis.rules import RULES
from twintube.diagnosis.selection.select import Selector


@pytest.fixture(scope="module")
def problem() -> Problem:
    return small.problem(small.records(lambda r: r.force - np.where(r.velocity > 0, 0.1, 0.05) * r.fluid))


def test_a_balanced_problem_is_another_problem(problem: Problem) -> None:
    before = problem.shared({}).copy()
    misfit = problem.misfits(problem.residual({}))
    balanced = problem.balanced(misfit)
    assert np.array_equal(problem.shared({}), before)
    assert np.array_equal(balanced.residual({}), problem.residual({}))
    sums = np.add.reduceat(balanced.shared({}) ** 2, problem.starts[:-1]) / problem.counts
    assert sums == pytest.approx(np.minimum(misfit, 1.0))


def test_a_selector_balances_its_records_and_leaves_the_given_ones(problem: Problem) -> None:
    half = len(problem.records) // 2
    fitted, held = problem.with_records(problem.records[:half]), problem.with_records(problem.records[half:])
    selector = Selector(fitted, candidates(problem), [Fold(fitted, held)])
    assert np.all(fitted.share == 1.0)
    assert selector.start.names == ()
    misfit = selector.start.fits[0].misfit
    expected = np.repeat(1 / np.sqrt(np.maximum(1.0, misfit)), np.diff(fitted.starts))
    assert selector.whole.share == pytest.approx(expected)
    assert selector.folds[0].fitted.share == pytest.approx(expected)
    assert selector.count == held.counts.sum()


@pytest.fixture(scope="module")
def selector(problem: Problem) -> Selector:
    return crossed(problem)


def crossed(problem: Problem) -> Selector:
    """Every second record is held out in turn."""
    halves = [problem.with_records(problem.records[i::2]) for i in (0, 1)]
    folds = [Fold(*halves), Fold(*halves[::-1])]
    return Selector(problem, candidates(problem), folds)


def changed(selector: Selector, names: tuple[str, ...], squares: list[float]) -> Option:
    """A model that leaves so much of the squared error of each held-out record, as a share of that of the start."""
    start = selector.start
    misfit = start.misfit * np.array(squares)
    return replace(
        start, names=names, misfit=misfit, squares=selector.counts * misfit, score=float(selector.logs(misfit).sum())
    )


def test_a_search_looks_at_the_records_that_are_wrong(problem: Problem) -> None:
    count = len(problem.records)
    for i in range(count):
        misfit = np.where(np.arange(count) == i, 30.0, 1.0)
        names = [record.name for record in problem.sparse(2, misfit).records]
        assert problem.records[i].name in names and len(names) == 2
    assert len(problem.sparse(2, np.full(count, 30.0)).records) == 2
    assert problem.sparse(count, np.ones(count)) is problem


def test_worth_is_what_most_records_gain(selector: Selector) -> None:
    start = selector.start
    assert selector.worth(start, changed(selector, ("valve_wear",), [0.2, 0.2, 0.2, 0.2]))
    assert not selector.worth(start, start)
    for squares, reason in (
        ([1.0, 1.0, 1.0, 1.0], "not more than noise"),
        ([1.0, 1.0, 1.0, 0.01], "a single held-out record"),
        ([1 - 0.5 * RULES.least_share] * 4, "not more than noise"),
        ([0.5, 0.5, 0.5, 5.0], "a single held-out record"),  # the squared error rises, and the others gain too little
        ([0.3, 0.3, 0.3, 4.0], "takes less than 1%"),  # the squared error rises
        ([0.3, 0.3, 0.3, 2.3], "might not fall"),
    ):
        option = changed(selector, ("valve_wear",), squares)
        assert reason in selector.against(start, option) and not selector.worth(start, option)


def test_a_further_cause_must_take_a_good_part_of_what_is_left(selector: Selector) -> None:
    first = changed(selector, ("valve_wear",), [0.2, 0.2, 0.2, 0.2])
    least, little, some, much = (changed(selector, ("valve_wear", "fluid_lag"), [x] * 4) for x in (0.18, 0.17, 0.1, 0.02))
    assert not selector.worth(first, least)
    assert "of what is left" in selector.against(first, little)
    assert selector.worth(first, some)
    assert selector.worth(first, much)


def test_other_parameters_are_not_known_from_a_single_record(selector: Selector) -> None:
    wrong = 10.0 / selector.start.misfit
    for asking, worth in ((1, False), (2, True)):
        before = changed(selector, (), [*wrong[:asking], *(1.2 / selector.start.misfit)[asking:]])
        option = changed(selector, (RECALIBRATE,), list(1.0 / selector.start.misfit))
        assert selector.worth(before, option) == worth
        assert worth or "not known from a single record" in selector.against(before, option)


def test_a_second_cause_explains_a_good_part_of_the_error_or_of_its_logarithm_unless_it_is_late(selector: Selector) -> None:
    first = changed(selector, ("gas_spring",), list(8.0 / selector.start.misfit))
    assert RULES.second_share * (selector.start.misfit.mean() - 1.0) > 8.0 - 3.0
    for name, left, worth in (
        ("side_load_friction", 3.0, True),
        ("side_load_friction", 6.0, False),
        ("fluid_lag", 3.0, False),
    ):
        both = changed(selector, ("gas_spring", name), list(left / selector.start.misfit))
        assert selector.worth(first, both) == worth


def test_a_second_factor_of_the_force_leaves_noise_alone(selector: Selector) -> None:
    mean = float(selector.start.misfit.mean())
    first = changed(selector, ("valve_wear",), [0.5] * 4)
    for name, left, worth in (("oil_temperature", 4.0, False), ("oil_temperature", 1.0, True), ("gas_spring", 4.0, True)):
        both = changed(selector, ("valve_wear", name), [left / mean] * 4)
        assert selector.worth(first, both) == worth
    assert "as another cause does" in selector.against(
        first, changed(selector, ("valve_wear", "force_gain"), [4.0 / mean] * 4)
    )


def test_a_cause_and_its_start_are_those_of_the_truth(selector: Selector) -> None:
    cost, points = selector.beginning(selector.start, "valve_wear")
    assert cost < (1 - RULES.promise) * selector.sketched(selector.start)
    strengths = selector.known("valve_wear").strength
    assert {name: np.sign(x) for name, x in points[0].items() if name in strengths} == {"wear_re": -1.0, "wear_co": -1.0}
    worn = selector.extended(selector.start, "valve_wear")
    assert {name for name in worn.fits[0].values if name in strengths} == {"wear_re", "wear_co"}
    assert selector.acts(worn) and selector.worth(selector.start, worn)
    values = selector.refitted(worn, thorough=True).values
    assert (values["wear_re"], values["wear_co"]) == (pytest.approx(-0.1, abs=0.01), pytest.approx(-0.05, abs=0.01))
    late = selector.extended(selector.start, "channel_delay")
    assert not (selector.acts(late) and selector.worth(selector.start, late))


def test_beside_a_cause_what_sampling_leaves_open_goes_first_where_it_leaves_noise_alone(selector: Selector) -> None:
    mean = float(selector.start.misfit.mean())
    gain, short, far = (
        changed(selector, names, [left / mean] * 4)
        for names, left in (
            (("stroke_gain",), 4.0),
            (("stroke_gain", "channel_delay"), 1.0),
            (("stroke_gain", "channel_delay"), 3.0),
        )
    )
    assert selector.preferred(gain, short)
    assert not any(selector.preferred(*pair) for pair in ((gain, far), (gain, None), (selector.start, short)))


def test_what_makes_the_force_late_twice_is_not_sought(selector: Selector) -> None:
    assert selector.alike("channel_delay", ("fluid_lag",))
    assert not selector.alike("channel_delay", ("valve_wear",))
    assert not selector.alike("valve_wear", ("fluid_lag",))


def test_what_is_too_short_for_the_sampling_joins_every_model_and_is_no_cause(problem: Problem) -> None:
    """A lag below a sample that explains the records best is how they were sampled."""
    seen = crossed(problem)
    tau = 0.5 * seen.candidates["fluid_lag"].least["tau_fluid"]
    fits = tuple(replace(fit, values={**fit.values, "tau_fluid": tau}) for fit in seen.start.fits)
    short = replace(changed(seen, ("fluid_lag",), [0.3] * 4), fits=fits)
    better = replace(
        changed(seen, ("valve_wear",), [0.2] * 4), fits=tuple(replace(f, values={**f.values, "wear_re": -0.1}) for f in fits)
    )
    assert not seen.acts(short) and seen.acts(better)
    assert not seen.seen_through_sampling(seen.start, [better, short])
    assert seen.sampling == ()
    assert seen.seen_through_sampling(seen.start, [short])
    assert seen.sampling == ("fluid_lag",) == seen.start.names
    (lag,) = (f for f in seen.free(("fluid_lag",), short.fits[0].values) if f.name == "tau_fluid")
    assert lag.high == pytest.approx(seen.candidates["fluid_lag"].least["tau_fluid"])
    assert not seen.alike("channel_delay", seen.sampling)  # a true delay may still be a cause


def test_what_parameters_explain_that_nobody_knows_so_well_is_no_cause(problem: Problem) -> None:
    """At the edge between two states a thousandth of a parameter's range explains much."""
    seen = crossed(problem)
    tiny = changed(seen, ("recalibrate",), [0.17] * 4)
    wear = changed(seen, ("valve_wear",), [0.15] * 4)
    wear = replace(wear, fits=tuple(replace(f, values={**f.values, "wear_re": -0.1}) for f in wear.fits))
    assert seen.acts(wear) and not seen.acts(tiny)
    assert seen.taken(seen.start, [wear]) is wear
    assert seen.taken(seen.start, [wear, tiny]) is None
    assert not seen.seen_through_sampling(seen.start, [tiny]) and seen.sampling == ()


def test_what_something_too_short_for_the_sampling_explains_as_well_is_no_cause(problem: Problem) -> None:
    """A filter that the model without the first cause had not shown, beside it; a delay at its limit tells nothing of it."""
    seen = crossed(problem)
    late = next(f.high for f in nuisances(problem) if f.name == DELAY)

    def option(name: str, left: float, **values: float) -> Option:
        fits = tuple(replace(fit, values={**fit.values, **values}) for fit in seen.start.fits)
        return replace(changed(seen, (name,), [left] * 4), fits=fits)

    lag = option("fluid_lag", 0.30, tau_fluid=3.0 * seen.candidates["fluid_lag"].least["tau_fluid"])
    short, limit = option(DELAY, 0.31, channel_delay=0.5 * late), option("fluid_lag", 0.31, channel_delay=late)
    wear = option("valve_wear", 0.30, wear_re=-0.1)
    assert seen.usual(seen.start, lag, [lag, short])
    assert not seen.usual(seen.start, lag, [lag, limit]), "the delay does not end within the sampling"
    assert not seen.usual(seen.start, lag, [lag, option(DELAY, 0.6, channel_delay=0.5 * late)])
    assert not seen.usual(seen.start, wear, [wear, short])
    # A mass at the clamp is exact: what is worse by more than noise does not stand for it.
    mass = option(INERTIA, 0.30, clamp_inertia=3.0)
    assert seen.usual(seen.start, mass, [mass, option(DELAY, 0.30, channel_delay=0.5 * late)])
    assert not seen.usual(seen.start, mass, [mass, short])
    # A wear that a gain within the calibration does as well.
    several = (fit.free[0] for fit in wear.fits)
    wear = replace(wear, fits=tuple(replace(fit, free=(f,) * 9) for fit, f in zip(wear.fits, several, strict=True)))
    assert seen.usual(seen.start, wear, [wear, option("force_gain", 0.31, force_gain=0.999)])
    assert not seen.usual(seen.start, wear, [wear, option("force_gain", 0.31, force_gain=0.98)])
    assert not seen.usual(seen.start, wear, [wear, option("force_gain", 0.6, force_gain=0.999)])
    assert not seen.short(limit) and seen.short(short)


def test_a_single_record_beyond_noise_is_not_right(selector: Selector) -> None:
    """Noise that is estimated too large in the others does not make up for it."""
    misfit = np.array([0.5, 0.5, 0.5, 2.5])
    quiet = replace(selector.start, misfit=misfit, score=float(selector.logs(misfit).sum()))
    assert quiet.score < 0.0 and not selector.right(quiet)
    calm = np.minimum(misfit, 1.0)
    assert selector.right(replace(selector.start, misfit=calm, score=float(selector.logs(calm).sum())))


def test_at_one_velocity_a_gain_is_no_second_cause_beside_heat(selector: Selector, problem: Problem) -> None:
    """A constant factor is another temperature at the start there."""
    assert not selector.alike("force_gain", ("oil_temperature",))
    single = problem.with_records([record for record in problem.records if record.top_speed > 0.9])
    halves = [single.with_records([record.alternate(half) for record in single.records]) for half in (0, 1)]
    inside = Selector(single, candidates(single), [Fold(*halves), Fold(*halves[::-1])])
    assert inside.alike("force_gain", ("oil_temperature",)) and inside.alike("valve_wear", ("oil_temperature",))
    assert not inside.alike("side_load_friction", ("oil_temperature",))
    assert not inside.alike("oil_temperature", ("force_gain",))
    assert len(inside.counts) == RULES.parts * len(single.records)


def test_of_two_frictions_that_explain_nearly_as_much_the_simpler_is_taken(
    selector: Selector, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(selector, "acts", lambda o: True)
    monkeypatch.setattr(selector, "worth", lambda before, after: True)
    start, (fit, *others) = selector.start, selector.start.fits

    def option(name: str, gained: float) -> Option:
        free = (fit.free[0],) * (4 if name == "position_friction" else 2)
        fits = (replace(fit, free=free), *others)
        return replace(start, names=(name,), score=start.score * (1.0 - gained), fits=fits)

    simple, rich, wear = option("side_load_friction", 0.60), option("position_friction", 0.61), option("valve_wear", 0.60)
    assert selector.taken(start, [rich, wear, simple]) is simple
    much = option("position_friction", 0.90)
    assert selector.taken(start, [much, wear, simple]) is much
    assert selector.taken(start, [rich, wear]) is rich
    # A gain is exact: what a curve explains beyond it, and beyond noise, is not its formulation.
    gain, curve = (replace(o, names=(name,)) for o, name in ((simple, "force_gain"), (rich, "valve_wear")))
    assert selector.taken(start, [curve, gain]) is curve
    noise = replace(gain, score=curve.score + 0.5 * selector.limit)
    assert selector.taken(start, [curve, noise]) is noise


def test_a_simpler_law_beside_another_cause_is_compared_with_a_law_that_follows_both(
    selector: Selector, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(selector, "acts", lambda o: True)
    monkeypatch.setattr(selector, "worth", lambda before, after: True)
    start, (fit, *others) = selector.start, selector.start.fits

    def option(*names: str, gained: float) -> Option:
        fits = (replace(fit, free=(fit.free[0],) * (4 if "position_friction" in names else 2)), *others)
        return replace(
            start, names=names, score=start.score * (1.0 - gained), squares=start.squares * (1 - gained), fits=fits
        )

    rich, simple = option("position_friction", gained=0.95), option("side_load_friction", gained=0.85)
    for gained, chosen in ((0.99, ("side_load_friction", "valve_wear")), (0.94, ("position_friction",))):
        both = option("side_load_friction", "valve_wear", gained=gained)
        monkeypatch.setattr(selector, "tried", lambda current, label, most, progress, both=both: [both])
        final, rounds = selector.simpler(rich, [[rich, simple]], lambda text: None)
        assert final.names == chosen
        assert [options[0].names[-1] for options in rounds] == list(chosen)
    # A law that is far from the best is no beginning.
    far = option("side_load_friction", gained=0.5)
    assert selector.simpler(rich, [[rich, far]], lambda text: None)[0] is rich


def test_a_calibration_is_taken_where_it_is_best_by_both_measures(
    selector: Selector, monkeypatch: pytest.MonkeyPatch
) -> None:
    def option(name: str, score: float, squares: float) -> Option:
        return replace(selector.start, names=(name,), score=score, squares=np.full_like(selector.start.squares, squares))

    monkeypatch.setattr(selector, "acts", lambda o: True)
    monkeypatch.setattr(selector, "worth", lambda before, after: True)
    calm, loud = option("foam_decay", 2.0, 1.0), option("foam_decay", 2.0, 9.0)
    calibrated = option("recalibrate", 1.0, 5.0)
    assert selector.taken(selector.start, [calibrated, calm]) is calm
    assert selector.taken(selector.start, [calibrated, loud]) is calibrated


def test_a_calibration_that_explains_few_records_is_not_preferred_to_a_cause_in_most(
    selector: Selector, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A step that falls otherwise in two records holds much of the squared error."""
    monkeypatch.setattr(selector, "acts", lambda o: True)
    monkeypatch.setattr(selector, "worth", lambda before, after: True)
    start = selector.start
    few, most = (
        changed(selector, ("recalibrate",), [0.001, 1, 1, 1]),
        changed(selector, ("gas_spring",), [0.2, 0.2, 0.2, 0.2]),
    )
    some = changed(selector, ("gas_spring",), [0.9, 0.9, 0.9, 0.9])
    gained = {option.names: start.score - option.score for option in (few, most)}
    assert selector.improved(start, few) == 1 and selector.improved(start, most) == 4
    several = sorted((few, most), key=lambda o: o.score)
    assert gained["gas_spring",] > RULES.near_best * gained["recalibrate",]
    assert selector.taken(start, several) is most
    assert selector.taken(start, [few, some]) is few, "it explains far less"


def test_a_calibration_counts_against_an_unknown_history_where_it_leaves_little(
    problem: Problem, monkeypatch: pytest.MonkeyPatch
) -> None:
    selector = crossed(problem)
    selector.history = False
    monkeypatch.setattr(selector, "tried", lambda *some: [])
    monkeypatch.setattr(selector, "calibrated", dict)
    for left, shown in ((0.1, False), (0.04, True)):
        misfit = list((1.0 + left * (selector.start.misfit - 1.0)) / selector.start.misfit)
        option = changed(selector, (RECALIBRATE,), misfit)
        monkeypatch.setattr(selector, "extended", lambda *some, option=option: option)
        monkeypatch.setattr(selector, "acts", lambda o: True)
        recalibrated, options = selector.single(lambda text: None)
        assert recalibrated is option and options == [option] * shown
        assert not selector.enough(option)
