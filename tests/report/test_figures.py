"""Every figure: computed statements; stand-ins and assumptions are named in the picture itself."""

import json

import pytest

from twintube.engine.simulate import simulate
from twintube.identification import Harmonic
from twintube.report.common import style
from twintube.report.paper.context import Context
from twintube.report.paper.figures import FIGURES
from twintube.report.paper.records import Job, excitation
from twintube.report.paper.reproduce import BASES, summary
from twintube.report.paper.statement import as_json
from twintube.rig.plan import at_oil_level

DRAWN = (3, 7, 8, 11, 12, 14, 16, 17, 18, 19, 27, 28, 29, 31, 33)
WITH_STAND_IN = {3, 7, 8, 11, *range(19, 34)}


class ModelRecords:
    """Records simulated with the model itself instead of the virtual rig."""

    def __init__(self, dampers):
        self.dampers = dampers

    def get(self, job: Job) -> Harmonic:
        signal = excitation(job.damper, job.kind, job.value)
        run = simulate(at_oil_level(self.dampers[job.damper], job.level), signal.stroke, signal.velocity)
        return Harmonic(job.level, int(job.level >= 1), signal.time, run.stroke, run.velocity, run.force, signal.marks)


@pytest.fixture(scope="module")
def context(tmp_path_factory) -> Context:
    shared = Context(tmp_path_factory.mktemp("report"))
    shared.records = ModelRecords(shared.dampers)
    shared._fits = dict(shared.dampers)  # as if the identification had returned the true damper
    return shared


@pytest.fixture(scope="module")
def plots(context):
    return {number: FIGURES[number].draw(context) for number in DRAWN}


def picture_text(plot) -> str:
    """All text of a picture, in one line."""
    figure = plot.figure
    titles = [ax.get_title(loc="left") for ax in figure.axes]
    return " ".join([*(text.get_text() for text in figure.texts), *titles]).replace("\n", " ")


@pytest.mark.parametrize("number", DRAWN)
def test_figure(plots, number):
    plot = plots[number]
    assert plot.number == number and plot.statements
    assert bool(plot.stand_ins) == (number in WITH_STAND_IN)
    if plot.stand_ins:
        assert style.STAND_IN.lower() in picture_text(plot).lower()
    for value in plot.assumed:
        assert value in picture_text(plot)
    for statement in plot.statements:
        assert statement.basis in BASES
        assert (statement.holds is None) == (statement.basis == "not checkable")
        assert statement.numbers or statement.holds is None
        if statement.holds is not True:
            assert statement.reason, statement.statement
    json.dumps(as_json(plot))


def test_a_model_reproduces_its_own_records(plots):
    """Statements that compare model and measurement must hold if the measurements are the model's."""
    assert plots[19].statements[-1].holds and plots[27].statements[0].holds
    assert plots[29].statements[0].holds and plots[31].statements[0].holds


def test_a_statement_can_fail(context, monkeypatch):
    """With the doubled force of the stand-in, no picture may state that the model reproduces it."""
    get = context.records.get
    monkeypatch.setattr(context.records, "get", lambda job: doubled(get(job)), raising=False)
    assert FIGURES[29].draw(context).statements[0].holds is False
    assert FIGURES[27].draw(context).statements[-1].holds is False


def doubled(r: Harmonic) -> Harmonic:
    return Harmonic(r.oil_level, r.gas_preload, r.time, r.stroke, r.velocity, 2 * r.force, r.marks)


def test_a_claim_counts_once(plots):
    rows = summary([as_json(plots[8]), as_json(plots[8])]).rows
    assert sum(int(cell) for row in rows for cell in row[2:]) == len(plots[8].statements)
