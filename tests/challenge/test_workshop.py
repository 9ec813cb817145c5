"""Datasets of the workshop: a strength of nothing does nothing, causes have their signs, and the folder is readable."""

from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from twintube.dampers import load
from twintube.data import load_dataset
from twintube.engine.simulate import simulate
from twintube.lab.workshop import motions, write
from twintube.lab.workshop.bench import Recorder, drive, measure
from twintube.lab.workshop.catalogue import all_cases, case_of
from twintube.lab.workshop.cause import Cause, Rubber, Run, Trial
from twintube.lab.workshop.faults import Late, Play, Scaled
from twintube.lab.workshop.fluid_causes import LateCheckValves, MixingLength, OilColumn, WarmOil, WornBleed, WornScale
from twintube.lab.workshop.other_causes import (
    BentRod,
    Dissolving,
    FoamCollapse,
    Leak,
    Refilled,
    ResidualPressure,
    RubberStop,
    SideLoad,
    WrongPreload,
)

DAMPER = load("SA8", as_published=True)
RATE = 4000.0


def trial(level: float = 0.5, speed: float = 0.786) -> Trial:
    """Slow strokes and two seconds of a sine."""
    x = motions.sine(0.04, speed, RATE, 1, 1.5)
    return Trial(0, "r", "harmonic", x, RATE, level, level == 1.0, 0.0)


def run(cause: Cause, level: float = 0.5) -> Run:
    cause.begin()
    return drive(trial(level), DAMPER, [cause])


PLAIN = {level: run(Cause(), level) for level in (0.5, 1.0)}


def rms(values: object) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def work(some: Run) -> float:
    """Energy [J] that the damper takes up."""
    return float(np.sum(some.force * some.v) / RATE)


def test_nothing_hidden_is_the_models_force() -> None:
    model = simulate(DAMPER.with_(oil_level=0.5, gas_preload=0), PLAIN[0.5].z, PLAIN[0.5].v)
    assert np.array_equal(PLAIN[0.5].force, np.asarray(model.force))


@pytest.mark.parametrize(
    "cause",
    [
        WarmOil(kelvin=0.0), OilColumn(stiffness=1e12), LateCheckValves(stroke=1e-12), MixingLength(length=1e-12), WornScale(),
        WornBleed(), WrongPreload(), ResidualPressure(exponent=1.0), RubberStop(onset=0.05), SideLoad(), BentRod(), Refilled(),
        FoamCollapse(), Dissolving(), Leak(), Scaled(), Late(), Play(),
    ],
    ids=lambda cause: type(cause).__name__,
)  # fmt: skip
def test_a_strength_of_nothing_does_nothing(cause: Cause) -> None:
    for level, plain in PLAIN.items():
        assert rms(run(cause, level).force - plain.force) < 1e-5 * rms(plain.force)


def test_a_hard_mount_is_none() -> None:
    hard = Cause(rubber=Rubber(1e12, 0.0, 0.0))
    assert rms(run(hard).force - PLAIN[0.5].force) < 1e-3 * rms(PLAIN[0.5].force)


def test_causes_have_their_signs() -> None:
    """Less work with warm oil and worn valves, more with friction; more gas pushes the rod out."""
    for level in (0.5, 1.0):
        late = [LateCheckValves(stroke=8e-3)] if level == 1.0 else []  # without oil no force is there at the reversal
        for weaker in (WarmOil(kelvin=30.0), WornScale(rebound=0.2), WornBleed(rebound=0.1), *late):
            assert work(run(weaker, level)) < 0.995 * work(PLAIN[level])
        for stronger in (SideLoad(extra=100.0), BentRod(extra=100.0)):
            assert work(run(stronger, level)) > 1.005 * work(PLAIN[level])
    assert np.mean(run(WrongPreload(ratio=1.6), 1.0).force) < np.mean(PLAIN[1.0].force) - 10.0
    assert np.mean(run(ResidualPressure(pressure=2e5)).force) < np.mean(PLAIN[0.5].force) - 10.0


def test_oil_decides_the_work() -> None:
    assert work(run(Refilled(shift=0.06))) > work(PLAIN[0.5])
    assert work(run(Leak(film=2e-6))) < work(PLAIN[0.5])
    leak = Leak(film=2e-6)
    run(leak, 1.0)  # it takes what the reserve has
    assert leak.lost == pytest.approx(2e-6 * np.abs(np.diff(trial().x)).sum(), rel=0.05)


def test_an_oil_column_is_late_and_a_stop_is_at_the_end() -> None:
    late = run(OilColumn(stiffness=4e5), 1.0)
    assert work(late) < work(PLAIN[1.0])
    turned = np.flatnonzero(np.diff(np.sign(late.v)) != 0)[2:]
    assert np.all(late.fluid[turned + 1] * late.v[turned + 1] <= 0.0)  # there is force of the stroke before
    stop = run(RubberStop(onset=0.035, at_10mm=2000.0))
    touched = np.abs(stop.extra) > 1.0
    assert touched.any() and stop.z[touched].min() > 0.035


@pytest.mark.parametrize("kind", ["points", "means", "filter"])
def test_channels_are_sampled_alike_and_a_delay_is_late(kind: str) -> None:
    recorder = Recorder(500.0, kind, 0.4)
    time, stroke, force = measure(trial(1.0), DAMPER, [], recorder)
    assert len(time) == len(stroke) == len(force) and np.diff(time) == pytest.approx(1 / 500.0)
    late = measure(trial(1.0), DAMPER, [Late(delay=4e-3)], recorder)[2]
    assert rms(late[2:] - force[:-2]) < 0.05 * rms(force)


def test_of_sixty_seeds_every_case_is_hidden_once() -> None:
    every = Counter((case.kind, case.hidden) for case in all_cases())
    for first in (1, 61):
        assert Counter((case.kind, case.hidden) for case in map(case_of, range(first, first + 60))) == every
    assert [case_of(seed).hidden for seed in range(1, 61)] != [case_of(seed).hidden for seed in range(61, 121)]


def test_a_dataset_is_readable_and_repeats(tmp_path: Path) -> None:
    truth = write(7, tmp_path / "a")
    again = write(7, tmp_path / "b")
    assert truth == again and truth["causes"] == list(case_of(7).causes)
    for file in (tmp_path / "a").iterdir():
        assert file.read_bytes() == (tmp_path / "b" / file.name).read_bytes()
    dataset = load_dataset(tmp_path / "a")
    assert len(dataset.records) == truth["records"]
    assert all(np.ptp(record.stroke) > 0.01 for record in dataset.records)
