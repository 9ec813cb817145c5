"""dataset.toml: what is wrong with it is said with key and line, all at once."""

from collections.abc import Callable
from pathlib import Path

import pytest

from tests.data.conftest import RECORD, good
from twintube.dampers import load, to_toml
from twintube.data import DataError, check_dataset, load_dataset, report
from twintube.data.findings import unconfirmed

Make = Callable[..., Path]
GOOD = 'title = "Test"\ndamper = "SA8"\n' + RECORD.format("a.csv")


def test_all_keys(folder: Make, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(to_toml(load("SA8")))
    text = GOOD.replace("SA8", "mine.toml").replace("oil_level = 0.56", "oil_volume_mL = 153").replace("false", "true")
    path = folder({"a.csv": good()}, toml=text + 'start_temperature_degC = 25\nsplit = "heldout"\n')
    for where in (path, str(path), path / "dataset.toml"):
        dataset = load_dataset(where)
        assert dataset.title == "Test"
        assert dataset.damper.name == "SA8"
        (record,) = dataset.records
        assert record.oil_level == pytest.approx(153e-6 / dataset.damper.parameters.V_oil)
        assert (record.gas_preload, record.start_temperature, record.split) == (True, 25.0, "heldout")


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ('title = "Test"', "title = 3", 1, "title = 3: must be a text"),
        ('damper = "SA8"', "", None, "damper is missing"),
        ('damper = "SA8"', 'damper = "SA9"', 2, "neither a file nor one of SA1"),
        ('damper = "SA8"', 'damper = "SA8"\nforce_sing = 1', 3, "unknown force_sing, did you mean force_sign?"),
        ('damper = "SA8"', 'damper = "SA8"\nforce_sign = 0', 3, "force_sign = 0: must be 1 or -1"),
        ('damper = "SA8"', 'damper = "SA8"\ndelimiter = "ab"', 3, "must be one character or 'whitespace'"),
        ('damper = "SA8"', 'damper = "SA8"\nencoding = "utf-9"', 3, "must be a text encoding"),
        ('damper = "SA8"', 'damper = "SA8"\nstroke_offset = "3 N"', 3, "must be a length with unit like '-12.5 mm'"),
        (
            'damper = "SA8"',
            'damper = "SA8"\ncolumns = {"strok [mm]" = "x"}',
            3,
            "unknown 'strok [mm]', did you mean stroke?",
        ),
        ('file = "a.csv"', "", 3, "record 1: file is missing"),
        ('measurement = "harmonic"', 'measurement = "sine"', 5, "must be one of quasi-static, harmonic, stochastic"),
        ('measurement = "harmonic"', 'mesurement = "harmonic"', 5, "unknown mesurement, did you mean measurement?"),
        ("oil_level = 0.56", "oil_level = 56", 6, "oil_level = 56: must be a number from 0 to 1"),
        ("oil_level = 0.56", "oil_level = nan", 6, "oil_level = nan: must be a number from 0 to 1"),
        ("oil_level = 0.56", "oil_volume_mL = 900", 6, "oil_volume_mL = 900: must be from 0 to"),
        ("oil_level = 0.56", "oil_volume_mL = -1", 6, "oil_volume_mL = -1: must be a number from 0 to"),
        ("oil_level = 0.56", "", 3, "oil_level or oil_volume_mL is missing"),
        ("oil_level = 0.56", "oil_level = 0.5\noil_volume_mL = 100", 3, "both are given"),
        (
            "gas_preload = false",
            "gas_preload = 2",
            7,
            "gas_preload = 2: must be true (present), false (lost), a share from 0 to 1 or 'unknown'",
        ),
        ("gas_preload = false", "", 3, "gas_preload is missing"),
        ("gas_preload = false", "gas_preload = false\nsplit = 'test'", 8, "split = 'test': must be one of fit, heldout"),
        ("gas_preload = false", "gas_preload = false\nstart_temperature_degC = 298", 8, "must be from -60 to 200 degC"),
        (RECORD.format("a.csv"), "", None, "no [[record]]: the dataset is empty"),
        (RECORD.format("a.csv"), RECORD.format("a.csv") * 2, 8, "record 2: file = 'a.csv' is named by a record before"),
        ("[[record]]", "[record]", None, "no [[record]]: the dataset is empty"),
        ("title = ", "title ", None, "cannot be read: Expected '=' after a key"),
    ],
)
def test_bad_manifest(folder: Make, old: str, new: str, line: int | None, message: str) -> None:
    assert old in GOOD
    with pytest.raises(DataError) as caught:
        load_dataset(folder({"a.csv": good()}, toml=GOOD.replace(old, new)))
    hits = [f for f in caught.value.findings if message in f.message]
    assert hits, caught.value
    assert (hits[0].severity, hits[0].file, hits[0].row) == ("error", "dataset.toml", line)


def test_errors_of_manifest_and_records_come_together(folder: Make) -> None:
    text = GOOD.replace("SA8", "SA9") + RECORD.format("b.csv").replace("0.56", "7") + RECORD.format("c.csv")
    bad = good()
    bad["force [N]"] = -bad["force [N]"]
    found = check_dataset(folder({"a.csv": good(), "b.csv": bad}, toml=text)).errors
    assert [(f.file, f.column, f.row) for f in found[:2]] == [
        ("dataset.toml", "oil_level", 11),
        ("dataset.toml", "damper", 2),
    ]
    assert [f.file for f in found[2:]] == ["b.csv", "c.csv"]


def test_no_folder(tmp_path: Path) -> None:
    with pytest.raises(DataError, match=r"dataset\.toml: cannot be read"):
        load_dataset(tmp_path / "nowhere")


def test_a_record_twice_under_two_names(folder: Make) -> None:
    findings = load_dataset(folder({"a.csv": good(), "b.csv": good()})).findings
    (found,) = [finding for finding in findings if finding.severity == "warning"]
    assert str(found) == "warning: b.csv: the same samples as a.csv: recorded twice?"


def test_what_is_not_sure_is_said_until_it_is_deleted(folder: Callable[..., Path]) -> None:
    two = {"a.csv": good(), "b.csv": good(1601)}
    entry = RECORD + 'not_sure = ["measurement: a guess", "force: N is guessed"]\n'
    toml = 'not_sure = ["damper: a guess"]\ndamper = "SA8"\n' + entry.format("a.csv") + entry.format("b.csv")
    findings = load_dataset(folder(two, toml=toml)).findings
    said = [f for f in findings if f.message.startswith("not confirmed: ")]
    assert [(f.severity, f.row) for f in said] == [("warning", 1)] + [("warning", 8)] * 2 + [("warning", 14)] * 2
    assert len(unconfirmed(findings)) == 3
    lines = [line for line in report(findings).splitlines() if "not confirmed" in line]
    assert lines[0].startswith("warning: dataset.toml, line 1, not_sure: not confirmed: damper: a guess; delete this entry")
    assert lines[1].endswith("(the like at 1 more place: line 14)") and len(lines) == 3
    rest = toml.replace('"damper: a guess"', "").replace('"measurement: a guess", "force: N is guessed"', "")
    assert not unconfirmed(load_dataset(folder(two, toml=rest)).findings)
