"""F-v curves and other parameters in a wrong unit: refused, or doubted in a warning; the point (0, 0) is read."""

import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.core.kernel import fluid_force
from twintube.dampers import Damper, ParameterError, load, names, to_toml
from twintube.errors import InputWarning

GOOD = to_toml(load("SA5"))
REBOUND, COMPRESSION = [[0.06, 180], [0.25, 700], [1.2, 1900]], [[0.06, 90], [0.25, 260], [1.2, 600]]  # m/s, N


def file(folder: Path, rebound: object, compression: object, v: str = "m/s", F: str = "N") -> Path:
    head, rest = GOOD.split("[fv]")
    curve = f'[fv]\nvelocity_unit = "{v}"\nforce_unit = "{F}"\nrebound = {rebound}\ncompression = {compression}\n'
    path = folder / "own.toml"
    path.write_text(head + curve + rest[rest.index("[sources]") :])
    return path


def scaled(v: float, F: float) -> tuple[list[list[float]], list[list[float]]]:
    return [[a * v, b * F] for a, b in REBOUND], [[a * v, b * F] for a, b in COMPRESSION]


def silent(path: Path) -> Damper:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return load(path)


@pytest.mark.parametrize("name", names())
def test_no_named_damper_is_doubted(name: str) -> None:
    silent(Path(name))


@pytest.mark.parametrize(
    ("v", "F", "units"), [(1e3, 1.0, ("mm/s", "N")), (1.0, 1e-3, ("m/s", "kN")), (100, 1e-1, ("cm/s", "daN"))]
)
def test_the_right_unit_gives_the_same_curve_in_silence(tmp_path: Path, v: float, F: float, units: tuple[str, str]) -> None:
    right, same = (silent(file(tmp_path, *curve)) for curve in ((REBOUND, COMPRESSION), scaled(1.0, 1.0)))
    same = silent(file(tmp_path, *scaled(v, F), *units))
    for speed in np.linspace(-3.0, 3.0, 13):
        assert fluid_force(same.parameters, speed) == pytest.approx(fluid_force(right.parameters, speed))


@pytest.mark.parametrize("v", [1e3, 100.0])
def test_a_velocity_beyond_all_simulations_is_refused_with_its_point(tmp_path: Path, v: float) -> None:
    rebound, compression = scaled(v, 1.0)
    number = 1 + next(i for i, (a, _) in enumerate(rebound) if a > 20.0)
    expected = rf"own\.toml: line \d+: fv\.rebound: velocity {number} = {rebound[number - 1][0]:g} m/s: must be a number from 0 to 20 m/s; check velocity_unit = 'm/s'"
    with pytest.raises(ParameterError, match=expected):
        load(file(tmp_path, rebound, compression))


def test_exchanged_columns_are_refused(tmp_path: Path) -> None:
    exchanged = [[b, a] for a, b in REBOUND]
    with pytest.raises(ParameterError, match=r"velocity 1 = 180 m/s: .* that the pairs are \[velocity, force\]"):
        load(file(tmp_path, exchanged, COMPRESSION))


@pytest.mark.parametrize(
    ("v", "F", "units", "doubt"),
    [
        (1.0, 1e-3, ("m/s", "N"), "rebound: 1.6[0-9]* N at 1 m/s is less than the friction, 50 N"),
        (1e3, 1e-3, ("mm/s", "N"), "compression: 0.5[0-9]* N at 1 m/s is less than the friction, 50 N"),
        (1.0, 1.0, ("mm/s", "N"), r"rebound: .* N at 1 m/s would be .* bar, the inner tube bursts at 722 bar"),
        (1.0, 1.0, ("m/s", "kN"), r"compression: .* N at 1 m/s would be .* bar, the inner tube bursts at 722 bar"),
    ],
)
def test_another_unit_is_doubted(tmp_path: Path, v: float, F: float, units: tuple[str, str], doubt: str) -> None:
    with pytest.warns(InputWarning, match=rf"own\.toml: line \d+: fv\.{doubt}; check velocity_unit and force_unit"):
        load(file(tmp_path, *scaled(v, F), *units))


@pytest.mark.parametrize("zero", [[0, 0], [0.0, 0.0], [-0.0, 0]])
def test_the_point_zero_changes_nothing(tmp_path: Path, zero: list[float]) -> None:
    plain = silent(file(tmp_path, REBOUND, COMPRESSION))
    assert silent(file(tmp_path, [zero, *REBOUND], [zero, *COMPRESSION])).parameters == plain.parameters


def test_the_point_zero_and_another_are_a_line(tmp_path: Path) -> None:
    p = silent(file(tmp_path, [[0, 0], [0.5, 800]], COMPRESSION)).parameters
    assert [fluid_force(p, v) for v in (0.1, 0.5, 2.0)] == pytest.approx([160, 800, 3200])


def test_twenty_points_and_zero_are_read(tmp_path: Path) -> None:
    many = [[0, 0], *([0.1 * i, 100 * i] for i in range(1, 21))]
    assert silent(file(tmp_path, many, COMPRESSION)).parameters.F_re[-1] == 2000.0
    with pytest.raises(ParameterError, match=r"fv\.rebound: 22 points, must be from 2 to 20"):
        load(file(tmp_path, [*many, [2.5, 2500]], COMPRESSION))


@pytest.mark.parametrize(
    ("rebound", "message"),
    [
        ([[0, 35], *REBOUND], r"fv\.rebound: point 1 = \[0, 35 N\]: at velocity 0 the force must be 0 N"),
        ([[0, 0], [0, 0], *REBOUND], r"fv\.rebound: velocity 1 = 0 m/s must be above 0 m/s \(counted without \[0, 0\]\)"),
        ([[0, 0], [0.2, 500], [0.1, 900]], r"velocity 2 = 0\.1 m/s must be above .* \(counted without \[0, 0\]\)"),
        ([[-0.05, -200], [0, 0], [0.05, 200]], r"fv\.rebound: point 1 = \[-0\.05 m/s, -200 N\]: must not be negative"),
    ],
)
def test_other_points_at_rest_are_refused(tmp_path: Path, rebound: object, message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        load(file(tmp_path, rebound, COMPRESSION))


@pytest.mark.parametrize(
    ("name", "value", "doubt"),
    [
        (
            "sigma_0",
            "250.0",
            r"friction\.sigma_0 = 250 N/m: the friction of 50 N would need 0\.4 m to turn round, more than stroke_max",
        ),
        ("c_gas", "3.09", r"gas_spring\.c_gas = 3\.09 N/m: the gas would make about 3\.1e\+03 N/m"),
        ("c_gas_lost", "90000.0", r"gas_spring\.c_gas_lost = 90000 N/m: the gas would make about"),
    ],
)
def test_values_that_are_hardly_meant_are_doubted(tmp_path: Path, name: str, value: str, doubt: str) -> None:
    path = tmp_path / "own.toml"
    path.write_text(re.sub(rf"^{name} = \S+", f"{name} = {value}", GOOD, flags=re.MULTILINE))
    with pytest.warns(InputWarning, match=rf"own\.toml: line \d+: {doubt}"):
        load(path)


def test_commands_say_it_once_and_go_on(tmp_path: Path) -> None:
    path = file(tmp_path, *scaled(1.0, 1e-3))
    done = CliRunner().invoke(app, ["fmu", "--ssv", str(path), "--output", str(tmp_path / "own.ssv")])
    said = done.stderr.splitlines()
    assert done.exit_code == 0
    assert [line.split(":")[:2] for line in said] == [["warning", " own.toml"]] * 2
    assert len(set(said)) == 2
