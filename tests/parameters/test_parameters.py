"""Parameter sets: what the paper published is what is in the files; bad files get a clear answer."""

import csv
import tomllib
from dataclasses import fields
from pathlib import Path

import pytest

from twintube.core.checks import problems
from twintube.core.variables import FV_POINTS, Parameters
from twintube.dampers import ParameterError, load, names, to_toml

# Table 9 of the paper, typed in anew: the files must hold exactly this.
TABLE_9 = """
X_Re      0.20 0.16 0.13 0.13 0.30 0.08 0.00 0.01
L_PV      0.59 0.90 0.01 0.10 0.90 0.74 0.00 0.06
G_PV      0.01 0.00 0.27 0.02 0.00 0.00 0.49 0.01
X_Co1     0.00 0.14 0.01 0.04 0.10 0.07 0.00 0.15
X_Co2     0.59 0.24 0.13 0.37 0.43 0.29 0.16 0.94
S_BV      0.07 1.00 1.00 0.29 0.10 0.17 0.00 0.94
S_BVoil   0.20 0.43 0.19 0.00 0.27 0.02 0.44 1.00
S_PV      1.00 0.00 0.61 0.93 0.26 0.28 0.02 0.72
S_PVoil   0.00 0.44 1.00 0.44 0.17 0.42 0.00 0.15
B         0.90 0.81 0.23 0.73 0.94 1.00 0.34 0.38
E         48.24 26.01 13.6 50.0 92.38 12.58 0.41 8.68
v_cav     1.00 0.90 1.05 0.00 0.95 0.00 0.70 0.90
Y_Co_cav  0.04 0.03 0.03 0.00 0.04 0.00 0.05 0.20
Y_Re_cav  0.04 0.02 0.03 0.00 0.04 0.00 0.05 0.20
"""
TABLE_5_MM = """
D_a   45.5 41.2 50.2 41.2 46.6 38.0 50.0 41.4
D_PR  22 13 25 13 25 14 25 13
D_li  32 29.9 35.9 30 36 27 35.8 29.8
D_la  34.8 32 38.65 32 38.6 29 38.6 32.1
h_l   326 277.9 326 277.9 328 225.7 326 331
"""
OIL_ML = {"SA1": (321, 161, 112), "SA2": (264, 166, 106), "SA3": (371, 226, 148), "SA4": (239, 160, 96),
          "SA5": (332, 239, 133), "SA6": (153, 95, 61), "SA7": (354, 194, 114), "SA8": (273, 153, 83)}  # fmt: skip


def table(text: str) -> dict[str, list[float]]:
    return {row[0]: [float(x) for x in row[1:]] for row in csv.reader(text.split("\n"), delimiter=" ", skipinitialspace=True)
            if row}  # fmt: skip


def test_there_are_the_papers_eight_dampers() -> None:
    assert names() == [f"SA{i}" for i in range(1, 9)]


@pytest.mark.parametrize("index", range(8))
def test_published_values(index: int) -> None:
    damper = load(f"SA{index + 1}")
    for symbol, row in table(TABLE_9).items():
        assert getattr(damper.parameters, symbol) == row[index], symbol
    for symbol, row in table(TABLE_5_MM).items():
        assert getattr(damper.parameters, symbol) == pytest.approx(row[index] * 1e-3), symbol
    full, *rest = OIL_ML[damper.name]
    assert damper.parameters.V_oil == pytest.approx(full * 1e-6)
    assert damper.measured_levels == pytest.approx([x / full for x in rest])


@pytest.mark.parametrize("name", names())
def test_every_value_is_sourced_or_marked_assumed(name: str) -> None:
    damper = load(name)
    assert problems(damper.parameters) == []
    for item in fields(Parameters):
        group = item.metadata["group"]
        if not group or group == "reading":
            continue
        full = f"{group}.{item.name}"
        assert any(key in origin for key in (full, group) for origin in (damper.sources, damper.assumed)), full
        if "unpublished" in item.metadata["source"] and group != "degradation":
            assert full in damper.assumed or group in damper.assumed, full


def test_round_trip(tmp_path: Path) -> None:
    damper = load("SA3").with_(oil_level=0.61, gas_preload=0)
    path = tmp_path / "mine.toml"
    path.write_text(to_toml(damper))
    again = load(path)
    assert again.parameters == damper.parameters
    assert len(tomllib.loads(path.read_text())["fv"]["rebound"]) < FV_POINTS  # as given, without the continuation
    assert again.sources == damper.sources
    assert again.assumed == damper.assumed


GOOD = to_toml(load("SA8"))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('D_li = 0.0298 # m', 'D_li = "29.8 kg"', r"mine\.toml: line \d+: geometry\.D_li: '29\.8 kg' is not a quantity in m"),
        ("D_li = 0.0298 # m", 'D_li = "298 mm"', r"line \d+: geometry\.D_li = 0\.298 m: must be a number from 0\.01 to 0\.15 m"),
        ("D_li = 0.0298 # m", "D_li = true", r"geometry\.D_li: True is not a number"),
        ("D_li = 0.0298 # m", "D_li = nan", r"geometry\.D_li = nan m: must be a number"),
        ("D_li = 0.0298 # m\n", "", r"geometry\.D_li is missing"),
        ("D_li = 0.0298 # m", "D_il = 0.0298", r"line \d+: unknown geometry\.D_il, did you mean D_li\?"),
        ("[foam]", "[fom]", r"unknown fom, did you mean foam\?"),
        ("oil_level = 1.0", "oil_level = 1.7", r"line \d+: oil_level = 1\.7: must be a number from 0 to 1"),
        ("X_Re = 0.01", "X_Re = -0.01", r"line \d+: degradation\.X_Re = -0\.01: must be a number from 0 to 1"),
        ("D_PR = 0.013 # m", "D_PR = 0.03", r"geometry\.D_PR = 0\.03 m: must be below geometry\.D_li = 0\.0298 m"),
        ("V_oil = 0.000273 # m3", 'V_oil = "100 mL"', r"geometry\.V_oil = 0\.0001 m3: must be at least"),
        ("stroke_max = 0.08 # m", 'stroke_max = "200 mm"', r"geometry\.stroke_max = 0\.2 m: must be below 0\.1\d+ m"),
        ("rebound = [\n", "rebound = [\n" + 20 * "    [0.2, 5000],\n", r"fv\.rebound: \d\d points, must be from 2 to 20"),
        ("rebound = [\n", "rebound = 3\nother = [\n", r"fv\.rebound: must be a list of \[velocity, force\] pairs"),
    ],
)  # fmt: skip
def test_bad_files_name_file_line_quantity_and_range(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert old in GOOD
    path = tmp_path / "mine.toml"
    path.write_text(GOOD.replace(old, new, 1))
    with pytest.raises(ParameterError, match=message):
        load(path)


def test_curve_must_be_monotone(tmp_path: Path) -> None:
    text = GOOD[: GOOD.index("[fv]")] + (
        '[fv]\nvelocity_unit = "mm/s"\nforce_unit = "kN"\nrebound = [[50, 0.5], [100, 0.4]]\n'
        "compression = [[50, 0.1], [50, 0.2]]\n"
    )
    path = tmp_path / "mine.toml"
    path.write_text(text)
    with pytest.raises(ParameterError) as caught:
        load(path)
    assert "fv.rebound: not monotone, force 2 = 400 N must be at least the force before it, 500 N" in str(caught.value)
    assert "fv.compression: velocity 2 = 0.05 m/s must be above the velocity before it, 0.05 m/s" in str(caught.value)


def test_unknown_damper_and_broken_file(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="unknown damper SA9: neither a file nor one of SA1, "):
        load("SA9")
    path = tmp_path / "mine.toml"
    path.write_text("[geometry\n")
    with pytest.raises(ParameterError, match=r"mine\.toml: .*line 1"):
        load(path)


def test_with_checks_its_values() -> None:
    with pytest.raises(ParameterError, match="unknown parameter oil_levl, did you mean oil_level"):
        load("SA8").with_(oil_levl=0.5)
    with pytest.raises(ParameterError, match=r"oil_level = 1\.7: must be a number from 0 to 1"):
        load("SA8").with_(oil_level=1.7)
