"""Content of the rows; it does not depend on processes and chunks."""

import json
import multiprocessing
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from twintube import studies
from twintube.claims.claim import relative
from twintube.dampers import load
from twintube.engine.simulate import simulate, work_between
from twintube.rig.signals import harmonic_block
from twintube.studies import execute
from twintube.studies.cases import chunk, version_mark

GRID = """
dampers = ["SA8", "SA1"]
oil_level = [0.4, 0.6, 1.0]
variant = [1, 2, 4]
velocity = [1.0, 1.5]
oscillations = [1, 2, 19]
[parameters]
"cavitation.Y_Re_cav" = [0.0, 0.1]
"reading.foam_decays" = [0, 1]
"""


def rows(text: str, folder: Path) -> list[dict[str, Any]]:
    (folder / "study.toml").write_text(text)
    output = folder / "new" / "out.parquet"
    count = studies.run(studies.load(folder / "study.toml"), output, processes=1, progress=False)
    table: list[dict[str, Any]] = pq.read_table(output).to_pylist()
    assert len(table) == count
    assert [p.name for p in output.parent.iterdir()] == ["out.parquet"]
    return table


def test_rows_are_in_the_order_of_the_grid(tmp_path: Path) -> None:
    table = rows(GRID, tmp_path)
    assert len(table) == 2 * 2 * 2 * 2 * 3 * 3 * 3
    assert [row["case"] for row in table] == [i for i in range(144) for _ in range(3)]
    assert [row["oscillation"] for row in table[:4]] == [1, 2, 19, 1]
    last = table[-1]
    assert (last["damper"], last["velocity"], last["cavitation.Y_Re_cav"], last["reading.foam_decays"]) == (
        "SA1",
        1.5,
        0.1,
        1,
    )
    assert (last["oil_level"], last["gas_preload"], last["variant"]) == (1.0, 1, 4)
    assert all(row["work_relative"] == pytest.approx(1.0) for row in table if row["oil_level"] == 1.0)


@pytest.mark.parametrize("published", [False, True])
def test_a_row_equals_the_simulation(published: bool, tmp_path: Path) -> None:
    settings = f"as_published = {str(published).lower()}\noil_level = 0.5\nvelocity = 1.572"
    row = rows(f'dampers = "SA8"\n{settings}', tmp_path)[1]
    block = harmonic_block(1.572)
    damper = load("SA8", as_published=published).with_(oil_level=0.5, gas_preload=0)
    run = simulate(damper, block.stroke, block.velocity, block.time)
    last = slice(block.marks[-2], block.marks[-1] + 1)
    assert row["oscillation"] == 19
    assert row["work_J"] == run.work[last][-1] - run.work[last][0]
    assert (row["work_relative"] == relative(load("SA8"), 0.5, 1.572)[18]) == published  # claims are as published
    assert row["peak_rebound_N"] == run.force[last][run.velocity[last] > 0].max()
    assert row["peak_compression_N"] == run.force[last][run.velocity[last] < 0].min() < 0


def test_variant_1_is_the_level_times_the_fluid_part(tmp_path: Path) -> None:
    table = rows('dampers = "SA8"\noil_level = [0.3, 0.6]\nvelocity = 1.0\nvariant = 1', tmp_path)
    block = harmonic_block(1.0)
    arguments = (block.stroke, block.velocity, block.marks, block.time)
    intact = load("SA8")
    fluid = work_between(intact.with_(F_FrS=0.0), *arguments)
    for row in table:
        degraded = intact.with_(oil_level=row["oil_level"], gas_preload=0, F_re=[0.0] * 20, F_co=[0.0] * 20)
        friction = work_between(degraded, *arguments)
        i = row["oscillation"] - 1
        assert row["work_J"] == pytest.approx(row["oil_level"] * fluid[i] + friction[i], rel=1e-12)


def test_variants_switch_foam_and_cavitation_off(tmp_path: Path) -> None:
    table = rows('dampers = "SA8"\noil_level = 0.56\nvelocity = 1.572\nvariant = [2, 3, 4]\noscillations = 19', tmp_path)
    basic, foaming, complete = (row["work_relative"] for row in table)
    assert min(basic, foaming) > 2 * complete
    block = harmonic_block(1.572)
    off = load("SA8").with_(oil_level=0.56, gas_preload=0, S_BV=0.0, S_PV=0.0, Y_Co_cav=0.0, Y_Re_cav=0.0)
    assert table[0]["work_J"] == work_between(off, block.stroke, block.velocity, block.marks, block.time)[18]


def test_a_record_is_one_row_after_the_preconditioning(tmp_path: Path) -> None:
    t = np.arange(0, 2, 0.002)
    lines = [f"{a:.4f},{30 * np.sin(9 * a):.6f}" for a in t]
    (tmp_path / "drive.csv").write_text("time [s],stroke [mm]\n" + "\n".join(lines))
    table = rows('dampers = "SA8"\noil_level = [0.4, 1.0]\nrecords = "drive.csv"\nvelocity = 0.5', tmp_path)
    assert [(row["signal"], row["oscillation"]) for row in table[4:]] == [("drive.csv", 1)] * 2
    assert table[5]["velocity"] is None
    assert table[5]["work_relative"] == 1.0
    assert 0.0 < table[4]["work_relative"] < 1.0


def test_equal_bytes_whatever_the_processes_and_chunks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "study.toml").write_text(GRID)
    study = studies.load(tmp_path / "study.toml")
    files = [tmp_path / f"{i}.parquet" for i in range(3)]
    studies.run(study, files[0], processes=1, progress=False)
    studies.run(studies.load(tmp_path / "study.toml"), files[1], processes=2, progress=False)
    monkeypatch.setattr(execute, "CHUNKS", 10)
    studies.run(study, files[2], processes=1, progress=False)
    assert len({file.read_bytes() for file in files}) == 1
    metadata = pq.read_schema(files[0]).metadata
    definition = json.loads(metadata[b"twintube.study"])
    assert definition["oil_level"] == [0.4, 0.6, 1.0]
    assert definition["dampers"]["SA8"]["V_oil"] == load("SA8").parameters.V_oil
    assert metadata[b"twintube.fingerprint"].decode() == version_mark()


def test_row_groups_are_full_whatever_the_chunks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(execute, "ROW_GROUP", 100)
    rows(GRID, tmp_path)
    meta = pq.read_metadata(tmp_path / "new" / "out.parquet")
    assert [meta.row_group(i).num_rows for i in range(meta.num_row_groups)] == [100, 100, 100, 100, 32]


def test_a_failing_case_is_named_and_leaves_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(*_: object) -> None:
        raise ValueError("boom")

    study = studies.load("oil_levels")
    monkeypatch.setattr("twintube.studies.cases.simulate_quietly", failing)
    with pytest.raises(studies.StudyError, match=r"case 0 \(SA8, .*oil_level=0.0.*boom"):
        studies.run(study, tmp_path / "out.parquet", processes=1, progress=False)
    assert list(tmp_path.iterdir()) == []


def test_a_killed_process_is_reported_and_leaves_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    table = execute.table

    def killing(*arguments: Any) -> pa.Table:
        for child in multiprocessing.active_children():
            child.kill()
        return table(*arguments)

    monkeypatch.setattr(execute, "table", killing)
    monkeypatch.setattr(execute, "AHEAD", 1)
    with pytest.raises(studies.StudyError, match="a process of this machine was killed"):
        studies.run(studies.load("oil_levels"), tmp_path / "out.parquet", processes=2, progress=False)
    assert list(tmp_path.iterdir()) == []


def test_another_version_of_the_program_is_refused() -> None:
    with pytest.raises(studies.StudyError, match="a worker has twintube"):
        chunk(studies.load("variants"), 0, 1, "0.0.1 abc")


def test_processes_must_be_positive(tmp_path: Path) -> None:
    with pytest.raises(studies.StudyError, match="processes = 0"):
        studies.run(studies.load("variants"), tmp_path / "out.parquet", processes=0)
