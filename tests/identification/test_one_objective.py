"""`identify` and `simulate --record` report one error, also where records state a gas pressure or temperature."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.core.checks import KELVIN
from twintube.dampers import Damper, load, to_toml
from twintube.dampers.freed_gas import as_published
from twintube.dampers.gas_spring import at_pressure, gas_factors
from twintube.engine.simulate import simulate
from twintube.identification import identify
from twintube.rig.plan import quasi_static
from twintube.rig.signals import harmonic_block

BLOCKS = (0.05, 0.17, 0.4)


@pytest.fixture(scope="module")
def truth() -> Damper:
    """A gas spring that is less than the area of the rod makes of the stated pressure, as a seal's friction and heat do."""
    return load("SA8", as_published=True).with_(F_0=140.0)


def bench(path: Path, truth: Damper, keys: str, noise: float, others: tuple[str, ...] = ()) -> Path:
    """Records of the intact damper, with `keys` in dataset.toml; `others` are pressures of one more sine each."""
    path.mkdir()
    rng = np.random.default_rng(4)
    (path / "start.toml").write_text(to_toml(truth.with_(F_0=300.0, F_re=[1.2 * F for F in truth.parameters.F_re])))
    toml = 'title = "One objective"\ndamper = "start.toml"\n'
    slow = quasi_static(truth)
    jobs = [("slow", "quasi-static", keys, slow.time[::5], slow.stroke[::5], truth)]
    jobs += [(f"h{v}", "harmonic", keys, (b := harmonic_block(v, dt=2e-3)).time, b.stroke, truth) for v in BLOCKS]
    for i, other in enumerate(others):
        b = harmonic_block(0.25, dt=2e-3)
        charged = at_pressure(replace(truth, gas_pressure=6e5), 1e5 * float(other))
        jobs.append((f"other{i}", "harmonic", f'gas_pressure = "{other} bar"\n', b.time, b.stroke, charged))
    for name, kind, said, t, z, damper in jobs:
        force = simulate(damper, z, np.gradient(z, t), t).force
        table = np.column_stack([t, 1e3 * z + rng.normal(0, noise, len(z)), force + rng.normal(0, 3.0, len(z))])
        np.savetxt(path / f"{name}.csv", table, "%.7g", ",", header="time [s],stroke [mm],force [N]", comments="")
        toml += f'[[record]]\nfile = "{name}.csv"\nmeasurement = "{kind}"\noil_level = 1.0\ngas_preload = true\n{said}'
    (path / "dataset.toml").write_text(toml)
    return path


def told(output: str) -> float:
    """The error [N] that simulate prints."""
    return float(re.search(r"simulated: ([\d.]+) N RMSE", output).group(1))  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("keys", "noise"),
    [
        ("", 0.02),
        ('gas_pressure = "18 bar"\n', 0.01),
        ('gas_pressure = "3.5 bar"\nstart_temperature_degC = 61.0\n', 0.0),
    ],
)
def test_both_report_the_error_of_the_records_a_set_was_identified_from(
    tmp_path: Path, truth: Damper, keys: str, noise: float
) -> None:
    folder = bench(tmp_path / "bench", truth, keys, noise)
    result = identify(folder)
    # The F-v curve is that of the temperature the records say, and the law of temperature begins there.
    curve = result.identification.damper.parameters.T_curve
    assert curve == pytest.approx(61.0 + KELVIN if "start_temperature" in keys else truth.parameters.T_curve)
    (folder / "identified.toml").write_text(to_toml(result.identification.damper))
    dataset = folder / "dataset.toml"
    dataset.write_text(dataset.read_text().replace("start.toml", "identified.toml"))
    for row in result.validation:
        output = tmp_path / "simulation.csv"
        call = CliRunner().invoke(app, ["simulate", "--record", str(folder / f"{row.name}.csv"), "--output", str(output)])
        assert told(call.output) == pytest.approx(row.force_rmse, abs=0.06)  # a digit is printed
        assert row.force_rmse < 0.05 * row.force_peak
        output.unlink()


def test_the_identified_gas_spring_belongs_to_the_stated_pressure(tmp_path: Path, truth: Damper) -> None:
    """A second pressure changes the gas force by the ratio of the pressures, not to the area of the rod times it."""
    folder = bench(tmp_path / "bench", truth, 'gas_pressure = "6 bar"\n', 0.0, others=("3", "12"))
    result = identify(folder)
    damper = result.identification.damper
    assert damper.gas_pressure == 6e5
    assert abs(damper.parameters.F_0 - 140.0) < 10.0
    assert any("at 6 bar; not fitted: other0, other1" in remark for remark in result.remarks)
    assert {row.name for row in result.validation} >= {"other0", "other1"}
    for row in result.validation:
        assert row.force_rmse < 0.05 * row.force_peak  # with rod area times pressure it would be 100 N and more
    written = folder / "identified.toml"
    written.write_text(to_toml(damper))
    assert load(written).gas_pressure == 6e5


def test_gas_factors_follow_the_pressure_that_the_spring_was_measured_at(truth: Damper) -> None:
    assert gas_factors(truth, None) == (1.0, 1.0)
    assert gas_factors(replace(truth, gas_pressure=8e5), 8e5) == (1.0, 1.0)
    force, stiffness = gas_factors(replace(truth, gas_pressure=8e5), 4e5)
    assert force == pytest.approx(0.5)
    assert stiffness == pytest.approx(5 / 9)
    area = np.pi / 4 * truth.parameters.D_PR**2
    assert gas_factors(truth, 140.0 / area) == pytest.approx((1.0, 1.0))
    assert as_published(truth) == truth
