"""Study files: what the grid is made of, and what is refused with the file and the key named."""

from pathlib import Path

import numpy as np
import pytest

from twintube import studies
from twintube.dampers import load, to_toml
from twintube.rig.signals import BLOCKS
from twintube.studies.definition import StudyCase


def written(folder: Path, text: str) -> Path:
    path = folder / "study.toml"
    path.write_text(text)
    return path


def test_the_grid_is_the_product_and_its_last_axis_runs_fastest(tmp_path: Path) -> None:
    study = studies.load(
        written(
            tmp_path,
            """
            dampers = ["SA8", "SA1"]
            oil_level = {from = 0.0, to = 0.4, count = 5}
            variant = [2, 4]
            velocity = ["500 mm/s", 1.0]
            amplitude = ["45 mm", "20 mm", "10 mm"]
            [parameters]
            "cavitation.Y_Re_cav" = [0.0, 0.1]
            foam.B = 0.5
            """,
        )
    )
    assert study.shape == (2, 6, 2, 1, 5, 1, 2)
    assert len(study) == 240
    assert study.oil_levels == (0.0, 0.1, 0.2, 0.3, 0.4)
    assert [(s.velocity, s.amplitude) for s in study.signals[:4]] == [(0.5, 0.045), (0.5, 0.02), (0.5, 0.01), (1.0, 0.045)]
    assert study.case(0) == StudyCase(0, 0, (0.0, 0.5), 0.0, 0, 2)
    assert study.case(1) == StudyCase(0, 0, (0.0, 0.5), 0.0, 0, 4)
    assert study.case(2) == StudyCase(0, 0, (0.0, 0.5), 0.1, 0, 2)
    assert study.case(10) == StudyCase(0, 0, (0.1, 0.5), 0.0, 0, 2)
    assert study.case(20) == StudyCase(0, 1, (0.0, 0.5), 0.0, 0, 2)
    assert study.case(239) == StudyCase(1, 5, (0.1, 0.5), 0.4, 0, 4)
    assert len({study.case(i) for i in range(240)}) == 240


def test_the_preload_goes_with_the_oil_unless_given(tmp_path: Path) -> None:
    study = studies.load(written(tmp_path, 'dampers = "SA8"\noil_level = [0.5, 1.0]\nvelocity = 0.5'))
    assert [study.case(i).gas_preload for i in range(2)] == [0, 1]
    study = studies.load(written(tmp_path, 'dampers = "SA8"\noil_level = [0.5, 1.0]\nvelocity = 0.5\ngas_preload = [0, 1]'))
    assert [(study.case(i).oil_level, study.case(i).gas_preload) for i in range(4)] == [(0.5, 0), (0.5, 1), (1, 0), (1, 1)]


def test_the_named_studies() -> None:
    variants, levels = studies.load("variants"), studies.load("oil_levels")
    assert variants.variants == (1, 2, 3, 4)
    assert variants.oil_levels == (load("SA8").measured_levels[0],)
    assert levels.oil_levels == tuple(i / 10 for i in range(11))
    for study in (variants, levels):
        assert [s.velocity for s in study.signals] == list(BLOCKS)
        assert study.oscillations == (1, 19)


def test_records_and_own_dampers_are_found_beside_the_study(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(to_toml(load("SA8")).replace('name = "SA8"', 'name = "mine"'))
    (tmp_path / "drive.csv").write_text("time [s],stroke [mm]\n" + "".join(f"{i * 0.01},{i}\n" for i in range(20)))
    study = studies.load(written(tmp_path, 'dampers = ["mine.toml"]\nrecords = ["drive.csv"]\noscillations = "all"'))
    assert [d.name for d in study.dampers] == ["mine"]
    assert [s.name for s in study.signals] == ["drive.csv"]
    assert np.allclose(study.signals[0].speed, 0.1)
    assert study.rows(study.case(0)) == (1,)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "dampers is missing"),
        ("dampers = [", "Invalid value"),
        ('dampers = ["SA9"]', "line 1: dampers: unknown damper"),
        ("dampers = []", "line 1: dampers: must be a list of at least one string"),
        ('dampers = ["SA8", "SA8"]', "line 1: dampers: SA8 stands in the list twice"),
        ('dampers = "SA8"\noil_levels = [1.0]', "line 2: unknown oil_levels, did you mean oil_level?"),
        ('dampers = "SA8"\noil_level = [0.5, 1.7]', "line 2: oil_level = 1.7: must be a number from 0 to 1"),
        ('dampers = "SA8"\noil_level = [nan]', "line 2: oil_level = nan: must be a number"),
        ('dampers = "SA8"\noil_level = []', "line 2: oil_level: the list is empty"),
        ('dampers = "SA8"\noil_level = [0.5, 0.5]', "line 2: oil_level: a value stands in the list twice: 0.5"),
        ('dampers = "SA8"\noil_level = {from = 0, to = 1}', "line 2: oil_level: a range has the keys from, to and count"),
        ('dampers = "SA8"\noil_level = {from = 0, to = 1, count = 0}', "count = 0: must be an integer from 1"),
        ('dampers = "SA8"\noil_level = [true]', "line 2: oil_level: True is not a number"),
        ('dampers = "SA8"\nvariant = [5]', "line 2: variant = 5: must be a number from 1 to 4"),
        ('dampers = "SA8"\nvariant = [1.5]', "line 2: variant = 1.5: must be an integer"),
        ('dampers = "SA8"\nvelocity = ["1 kg"]', "line 2: velocity: '1 kg' is not a quantity in m/s"),
        ('dampers = "SA8"\namplitude = ["200 mm"]', "SA8: amplitude = 0.2 m: must be a number from 0 to 0.1"),
        ('dampers = "SA8"\nvelocity = 0.001', "samples, at most 4000000 are possible; raise time_step"),
        ('dampers = "SA8"\noscillations = [20]', "line 2: oscillations = 20: must be a number from 1 to 19"),
        ('dampers = "SA8"\ntime_step = [1e-4, 2e-4]', "line 2: time_step: must be a single value"),
        ('dampers = "SA8"\nrecords = ["no.csv"]', "line 2: records: "),
        ('dampers = "SA8"\nparameters = 1', "line 2: parameters: must be a table"),
        (
            'dampers = "SA8"\n[parameters]\n"cavitation.Y_Re" = [0.1]',
            "line 3: unknown parameters.cavitation.Y_Re, did you mean cavitation.Y_Re_cav?",
        ),
        ('dampers = "SA8"\n[parameters]\n"foam.B" = [-1]', "line 3: parameters.foam.B = -1: must be a number from 0 to 1"),
        ('dampers = "SA8"\n[parameters]\n"fv.F_re" = [1.0]', "line 3: parameters.fv.F_re, a curve and not a number"),
        ('dampers = "SA8"\n[parameters]\noil_level = [1.0]', "parameters.oil_level: belongs to the top of the file"),
        (
            'dampers = "SA8"\n[parameters]\n"geometry.D_PR" = ["40 mm"]',
            "geometry.D_PR = 0.04: geometry.D_PR = 0.04 m: must be",
        ),
        (
            'dampers = "SA8"\noil_level = {from = 0, to = 1, count = 1000}\nvelocity = {from = 1, to = 2, count = 1001}',
            "the grid has 1001000 cases, at most 1000000",
        ),
    ],
)
def test_bad_studies(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(studies.StudyError) as caught:
        studies.load(written(tmp_path, text))
    assert str(caught.value).startswith("study.toml: ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_unknown_name() -> None:
    with pytest.raises(studies.StudyError, match=r"unknown study variant: .* did you mean variants"):
        studies.load("variant")
