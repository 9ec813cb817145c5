"""The page of an identification of intact records alone."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from tests.identification.test_noisy_strokes import record
from twintube.dampers import load
from twintube.data import LoadedDataset
from twintube.identification import Result, identify_dataset
from twintube.report.identification.page import page
from twintube.report.identification.pictures import works

SIZES = {0.131: 0.02, 0.2: 0.01, 0.3: 0.02}  # amplitude [m] by velocity [m/s]


def result() -> Result:
    records = [record(load("SA1", as_published=True), v, 1, 0.0, size) for v, size in SIZES.items()]
    drive = replace(records[1], measurement="stochastic", name="drive")
    return identify_dataset(LoadedDataset("Bench", load("SA1", as_published=True), [*records, drive], []))


def test_page_of_intact_records(tmp_path: Path) -> None:
    identified = result()
    page(identified, "found").write(tmp_path)
    text = (tmp_path / "report.html").read_text()
    assert "F_FrS" in text and "1, 1 stochastic" in text
    assert "Measured up to 0.3 m/s" in text
    assert text.count('"label":"100% oil') == 3  # to look into
    assert repr(identified) == "<Result: SA1-identified from 3 of 4 records>"
    assert set(identified.to_dataframe().loc["drive", ["work_first", "work_last"]]) == {
        identified.validation[-1].work_measured[0]
    }
    parameters = identified.identification.to_dataframe()
    assert parameters.loc["F_FrS", "unit"] == "N" and (parameters["low"] <= parameters["high"]).all()
    axes = works([row for row in identified.validation if row.measurement == "harmonic"]).axes[0]
    lines = [line for line in axes.lines if line.get_linestyle() == "-" and len(line.get_xdata()) > 1]
    # Two of the records have equal amplitudes: the work between them rises, without a dent at the third.
    assert [np.round(np.asarray(line.get_xdata()), 2).tolist() for line in lines] == [[0.13, 0.3]]
