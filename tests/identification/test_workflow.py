"""From a dataset folder to an identified damper: marks, the four steps, held-out records, a killed run."""

import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from benchmarks.identify import records_of
from twintube.cli import app
from twintube.dampers import Damper, load, to_toml
from twintube.data import DataError, Record
from twintube.engine.simulate import InputError, simulate
from twintube.fitting.oscillations import beginnings
from twintube.fitting.parameters import TABLE_6
from twintube.identification import PAPER, QUICK, Budget, Harmonic, Objective, harmonic, identify, identify_damper, workflow
from twintube.identification.sines import identify_sines, saturation
from twintube.provenance import files
from twintube.rig.plan import quasi_static
from twintube.rig.signals import BLOCKS, harmonic_block

UNKNOWN = {"X_Re": 0.5, "L_PV": 0.5, "G_PV": 0.5, "X_Co1": 0.5, "X_Co2": 0.5}


def measured(time: np.ndarray, stroke: np.ndarray, force: np.ndarray | None = None, name: str = "a") -> Record:
    force = 1000 * np.gradient(stroke, time) if force is None else force
    velocity = np.gradient(stroke, time)
    return Record(
        name, name + ".csv", "harmonic", 0.5, False, None, None, time, stroke, force, velocity, "measured", None, ()
    )  # fmt: skip


def test_block_is_located_behind_preconditioning_and_rest() -> None:
    """Six slow oscillations, a rest, 19 fast ones, a rest, five slow ones; noise and an offset of the stroke."""
    rng = np.random.default_rng(0)
    dt, A = 2e-3, 0.045
    slow, fast = (np.arange(0, n * 2 * np.pi * A / v, dt) * v / A for n, v in ((6, 0.05), (19, 0.524)))
    rest = np.zeros(5000)
    stroke = A * np.concatenate([np.sin(slow), rest, np.sin(fast), rest, np.sin(slow)])
    stroke = stroke + 0.002 + rng.normal(0, 5e-6, len(stroke))
    block = harmonic(measured(np.arange(len(stroke)) * dt, stroke))
    assert len(block.marks) == 20
    assert block.top_speed == pytest.approx(0.524, rel=0.01)
    begins = (len(slow) + len(rest)) * dt
    assert block.time[block.marks[0]] == pytest.approx(begins, abs=0.02)
    assert block.time[-1] == pytest.approx(begins + len(fast) * dt, abs=0.02)
    assert len(block.time) < len(slow) + len(fast) + 1500  # the rest before keeps little more than its ends


def test_a_record_of_a_single_velocity_is_all_measured() -> None:
    t = np.arange(0, 10.001, 0.002)
    block = harmonic(measured(t, 0.02 * np.sin(2 * np.pi * t)))
    assert len(block.marks) == 11


def test_no_oscillation_is_refused() -> None:
    t = np.arange(0, 1, 0.002)
    with pytest.raises(InputError, match=r"a\.csv: no full oscillation"):
        harmonic(measured(t, 0.02 * t))
    assert len(beginnings(np.zeros(10))) == 0


def test_friction_of_sines_is_the_kernel_s() -> None:
    damper = load("SA7", as_published=True).with_(k_high=1.0, F_FrS=40.0, sigma_0=4e4, delta_D=1.0)
    block = harmonic_block(0.05)
    result = simulate(damper, block.stroke, block.velocity)
    np.testing.assert_allclose(40.0 * saturation(block.stroke, 1e-3), result.F_friction, rtol=0, atol=1e-6)


def test_sines_alone_give_an_intact_damper_that_predicts() -> None:
    """Without a quasi-static record: a block that was not fitted comes out to a few percent of its peak."""
    truth = load("SA1", as_published=True)
    rng = np.random.default_rng(2)
    records = []
    for v in BLOCKS[:7]:
        block = harmonic_block(v, 0.04, dt=5e-4)
        force = simulate(truth, block.stroke, block.velocity).force
        force = force + rng.normal(0, 0.01 * np.abs(force).max(), len(force))
        records.append(harmonic(measured(block.time, block.stroke, force)))
    held_out = records.pop(3)
    other = truth.with_(F_FrS=5.0, c_gas=1.0, F_0=0.0, F_re=[2 * F for F in truth.parameters.F_re])
    fit = identify_sines(other, records)
    force = simulate(fit.damper, held_out.stroke, held_out.velocity).force
    assert np.sqrt(np.mean((force - held_out.force) ** 2)) < 0.04 * np.abs(held_out.force).max()
    assert fit.offset == 0.0
    assert pytest.approx(truth.parameters.F_0, abs=0.05 * truth.parameters.F_0 + 10) == fit.damper.parameters.F_0


def assert_identified(truth: Damper, velocities: tuple[float, ...], budget: Budget) -> None:
    """Records of the model itself, 1 % noise: no determined parameter's interval misses the truth."""
    records = records_of(truth, velocities, noise=0.01)
    result = identify_damper(truth.with_(**UNKNOWN), None, [], records, budget=budget)
    determined = [e for e in result.estimates if e.determined]
    assert not [e for e in determined if not e.low <= getattr(truth.parameters, e.name) <= e.high]
    names = {e.name for e in determined}
    assert {"X_Re", "v_cav", "Y_Co_cav", "Y_Re_cav"} <= names
    assert len(names) < len(result.estimates)


def test_truth_lies_in_the_intervals_and_the_undetermined_are_named() -> None:
    assert_identified(load("SA7", as_published=True), BLOCKS[1::2], Budget((24, 30), (32, 40), (24, 80), (32, 80)))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["SA1", "SA7", "SA8"])
def test_truth_lies_in_the_intervals_with_the_paper_s_budget(name: str) -> None:
    assert_identified(load(name, as_published=True), BLOCKS, PAPER)


def folder_of(path: Path, truth: Damper, start: Damper) -> Path:
    """A small dataset folder: quasi-static, intact and one degraded level at two velocities."""
    path.mkdir()
    (path / "start.toml").write_text(to_toml(start))
    toml = 'title = "Bench"\ndamper = "start.toml"\n'
    signal = quasi_static(truth)
    jobs = [("slow", "quasi-static", 1.0, 1, signal.time[::5], signal.stroke[::5], signal.velocity[::5])]
    for level, preload in ((1.0, 1), (truth.measured_levels[0], 0)):
        for v in (BLOCKS[2], BLOCKS[4]):
            block = harmonic_block(v, dt=2e-3)
            jobs.append((f"h{level:.2f}_{v}", "harmonic", level, preload, block.time, block.stroke, block.velocity))
    for name, kind, level, preload, t, z, v in jobs:
        force = simulate(truth.with_(oil_level=level, gas_preload=preload), z, v).force
        table = np.column_stack([t, z * 1e3, force])
        np.savetxt(path / f"{name}.csv", table, "%.7g", ",", header="time [s],stroke [mm],force [N]", comments="")
        toml += f'[[record]]\nfile = "{name}.csv"\nmeasurement = "{kind}"\noil_level = {level}\n'
        toml += f"gas_preload = {'true' if preload else 'false'}\n"
    (path / "dataset.toml").write_text(toml)
    return path


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Path:
    truth = load("SA8", as_published=True)
    start = truth.with_(**UNKNOWN, F_FrS=60.0, F_re=[1.3 * F for F in truth.parameters.F_re])
    return folder_of(tmp_path_factory.mktemp("identify") / "bench", truth, start)


def command(bench: Path, output: Path) -> list[str]:
    return [sys.executable, "-m", "twintube", "identify", str(bench), "--output", str(output), "--quick"]


class BrokenOffError(Exception):
    """Ends a run in the middle."""


@pytest.mark.parametrize("method", [pytest.param("de", marks=pytest.mark.slow), "pso"])
def test_a_broken_off_run_goes_on_and_ends_the_same(bench: Path, tmp_path: Path, method: str) -> None:
    tiny = Budget((8, 3), (12, 3), (8, 3), (32, 3))
    whole = identify(bench, method=method, budget=tiny, journal=tmp_path / "whole").identification
    titles = ["Table 6", "Tables 7 and 8", "all together"]
    assert [step.title for step in whole.steps] == (titles if method == "pso" else titles[2:])
    calls: list[str] = []

    def breaking(title: str, error: float) -> None:
        calls.append(title)
        if len(calls) == 8:
            raise BrokenOffError

    with pytest.raises(BrokenOffError):
        identify(bench, method=method, budget=tiny, journal=tmp_path / "broken", progress=breaking)
    kept = [path.read_text() for path in sorted((tmp_path / "broken").glob("*.jsonl"))]
    assert any(kept)
    again = identify(bench, method=method, budget=tiny, journal=tmp_path / "broken").identification
    assert again.damper.parameters == whole.damper.parameters
    assert again.estimates == whole.estimates
    resumed = [path.read_text() for path in sorted((tmp_path / "broken").glob("*.jsonl"))]
    assert all(new.startswith(old) for old, new in zip(kept, resumed, strict=False))


@pytest.mark.slow
def test_command_identifies_and_a_killed_run_ends_the_same(bench: Path, tmp_path: Path) -> None:
    whole, killed = tmp_path / "whole", tmp_path / "killed"
    done = subprocess.run(command(bench, whole), capture_output=True, text=True, check=True)
    assert "are held out" in done.stdout
    run = subprocess.Popen(command(bench, killed), stderr=subprocess.DEVNULL)
    journal = killed / "journal"
    while run.poll() is None and len(list(journal.glob("*.jsonl"))) < 2:
        time.sleep(0.02)
    os.kill(run.pid, signal.SIGKILL)
    run.wait()
    assert not (killed / "identified.toml").exists()
    again = subprocess.run(command(bench, killed), capture_output=True, text=True, check=True)
    assert again.stdout.replace("killed", "whole") == done.stdout.replace("killed", "whole")
    for name in ("identified.toml", "identification.json"):
        assert (killed / name).read_text() == (whole / name).read_text()
    assert not journal.exists()
    summary = json.loads((whole / "identification.json").read_text())
    assert summary["heldout"]["work_error_first"] < 0.05
    damper = load(whole / "identified.toml", as_published=True)
    assert damper.parameters.F_FrS == pytest.approx(25.0, rel=0.1)
    assert "identified from 'Bench'" in damper.sources["degradation"]
    assert "fv" not in damper.assumed
    page = (whole / "report.html").read_text()
    assert "http" not in page.replace("http://www.w3.org", "")
    assert "held out" in page


def test_bad_input_gives_a_single_line(bench: Path, tmp_path: Path) -> None:
    result = CliRunner().invoke(app, ["identify", str(bench), "--output", str(tmp_path / "x"), "--method", "pos"])
    assert result.exit_code == 2
    assert "--method pos: must be one of de, pso" in result.output
    assert not (tmp_path / "x").exists()


def test_a_folder_is_identified_by_the_public_function(bench: Path, tmp_path: Path) -> None:
    """Of the intact records alone, which need no search."""
    head, *records = (bench / "dataset.toml").read_text().split("[[record]]\n")
    for file in bench.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    (tmp_path / "dataset.toml").write_text("[[record]]\n".join([head, *(r for r in records if "preload = true" in r)]))
    result = identify(tmp_path, budget=QUICK, seed=3)
    assert result.identification.damper.parameters.F_FrS == pytest.approx(25.0, rel=0.1)
    assert result.identification.steps == []
    assert any("only the intact damper is identified" in remark for remark in result.remarks)
    assert any("measured up to 0.524 m/s" in remark for remark in result.remarks)
    assert "measured up to 0.524 m/s" in result.identification.damper.sources["fv"]
    for e in result.identification.estimates:
        assert e.low <= e.value <= e.high
    assert {e.name for e in result.identification.estimates} == {"F_FrS", "sigma_0", "F_0", "c_gas"}
    with pytest.raises(DataError, match=r"dataset\.toml"):
        identify(tmp_path / "nowhere")


def test_a_run_resumed_after_an_upgrade_uses_no_value_of_the_former_program(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    damper, block = load("SA7", as_published=True), harmonic_block(0.524)
    record = Harmonic(0.6, 0, block.time, block.stroke, block.velocity, 900 * block.velocity, block.marks)
    records = [record, replace(record, oil_level=0.5)]
    objective = Objective(damper, TABLE_6, records, with_work=False)
    before = workflow.journal_file(tmp_path, 0, objective)
    assert workflow.journal_file(tmp_path, 0, Objective(damper, TABLE_6, records, with_work=False)) == before
    assert workflow.journal_file(tmp_path, 0, Objective(damper, TABLE_6, records[:1], with_work=False)) != before
    monkeypatch.setattr(workflow, "fingerprint", lambda module: f"other equations of {module}")
    assert workflow.journal_file(tmp_path, 0, objective) != before
    assert workflow.journal_file(None, 0, objective) is None


def test_the_fingerprint_of_the_workflow_covers_the_equations() -> None:
    names = {path.name for path in files("twintube.identification.workflow")}
    assert {"model.py", "forces.py", "loops.py", "simulation.py", "objective.py", "uncertainty.py"} <= names
