"""The same file from a Dask cluster on loopback, one of whose two workers is killed half way."""

import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pyarrow as pa
import pytest

from twintube import studies
from twintube.studies import execute

# Slow blocks: some 20 ms for each case.
LONG = """
dampers = ["SA8", "SA1"]
oil_level = {from = 0.1, to = 0.9, count = 9}
velocity = 0.05
variant = [2, 4]
[parameters]
"foam.B" = {from = 0.1, to = 1.0, count = 3}
"""


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """Address of a scheduler, and its two workers."""
    distributed = pytest.importorskip("distributed")
    file = tmp_path / "scheduler.json"

    def start(*arguments: str) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", *arguments, "--scheduler-file", str(file)]
        with (tmp_path / f"log{len(processes)}").open("wb") as log:
            processes.append(subprocess.Popen(command, stdout=log, stderr=log, cwd=tmp_path))
        return processes[-1]

    processes: list[subprocess.Popen[bytes]] = []
    try:
        start("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
        options = ("--no-nanny", "--nthreads", "1", "--host", "127.0.0.1", "--no-dashboard")
        workers = [start("distributed.cli.dask_worker", *options, "--name", f"w{i}") for i in range(2)]
        end = time.monotonic() + 30
        while not file.is_file() and time.monotonic() < end:
            time.sleep(0.05)
        with distributed.Client(scheduler_file=str(file), set_as_default=False) as client:
            client.wait_for_workers(2, timeout=30)
            address = client.scheduler_info()["address"]
        yield address, workers
    finally:
        for process in processes:
            process.kill()
            process.wait()


def test_a_killed_worker_loses_nothing(
    tmp_path: Path, cluster: tuple[str, list[subprocess.Popen[bytes]]], monkeypatch: pytest.MonkeyPatch
) -> None:
    distributed = pytest.importorskip("distributed")
    address, workers = cluster
    (tmp_path / "study.toml").write_text(LONG)
    study = studies.load(tmp_path / "study.toml")
    local, remote = tmp_path / "local.parquet", tmp_path / "remote.parquet"

    chunks = 0
    state: dict[str, int] = {}
    table = execute.table

    def killing(*arguments: Any) -> pa.Table:
        nonlocal chunks, state
        chunks += 1
        if chunks == len(study) // 2:
            time.sleep(0.5)  # finished results wait to be fetched
            with distributed.Client(address, set_as_default=False) as client:
                state = client.run_on_scheduler(
                    lambda dask_scheduler: {
                        "open": sum(task.state != "memory" for task in dask_scheduler.tasks.values()),
                        "lost": sum(
                            [w.name for w in task.who_has or ()] == ["w0"] for task in dask_scheduler.tasks.values()
                        ),
                    }
                )
            workers[0].kill()
            workers[0].wait()
        return table(*arguments)

    with monkeypatch.context() as patch:
        patch.setattr(execute, "table", killing)
        count = studies.run(study, remote, cluster=address, progress=False)
    assert state["open"] > 0, "the study was over before the worker was killed"
    assert state["lost"] > 0, "the killed worker had nothing to lose"
    assert workers[0].poll() is not None
    assert workers[1].poll() is None
    assert count == 2 * len(study)
    studies.run(study, local, processes=2, progress=False)
    assert remote.read_bytes() == local.read_bytes()


def test_no_scheduler(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr(execute, "CONNECTING", 1)
    with pytest.raises(studies.StudyError, match=r"no Dask scheduler at tcp://127.0.0.1:9: "):
        studies.run(studies.load("variants"), tmp_path / "out.parquet", cluster="tcp://127.0.0.1:9", progress=False)
    assert list(tmp_path.iterdir()) == []


def test_without_dask_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(studies.StudyError, match=r"pip install 'twintube\[cluster\]'"):
        studies.run(studies.load("variants"), tmp_path / "out.parquet", cluster="tcp://127.0.0.1:9", progress=False)
