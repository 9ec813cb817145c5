"""Processes that this one starts: they end with it, and what they die of does not reach it."""

import os
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from tests.data.conftest import RECORD
from tests.hardening.hostile import HEAD, changed, mat
from twintube import studies
from twintube.common.processes import pool
from twintube.data import check_dataset
from twintube.data.read import binary
from twintube.studies import execute

posix = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
GROUP = """
import os, sys, time
from twintube.common.processes import pool
if __name__ == "__main__":
    with pool(2) as workers:
        futures = [workers.submit(os.getpid) for _ in range(2)]
        pids = {future.result() for future in futures}
        waiting = [workers.submit(time.sleep, 300) for _ in range(2)]
        print(*pids, flush=True)
        [future.result() for future in waiting]
"""


def alive(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    state = Path(f"/proc/{pid}/stat")
    return not state.is_file() or state.read_text().rpartition(")")[2].split()[0] != "Z"


@posix
def test_workers_end_with_a_killed_parent(tmp_path: Path) -> None:
    script = tmp_path / "group.py"
    script.write_text(GROUP)
    with subprocess.Popen([sys.executable, str(script)], stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        pids = [int(pid) for pid in parent.stdout.readline().split()]
        assert pids
        assert all(alive(pid) for pid in pids)
        parent.kill()
        end = time.monotonic() + 20
        while any(alive(pid) for pid in pids) and time.monotonic() < end:
            time.sleep(0.05)
        assert not any(alive(pid) for pid in pids)


def test_a_pool_hands_out_work_and_begins_with_the_initializer() -> None:
    with pool(1, os.putenv, ("TWINTUBE_TEST", "1")) as workers:
        assert workers.submit(abs, -3).result() == 3


def test_a_scheduler_that_accepts_and_never_answers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr(execute, "CONNECTING", 1)
    accepted = []
    with socket.socket() as server:
        server.bind(("127.0.0.1", 0))
        server.listen()

        def accept() -> None:
            while True:
                try:
                    accepted.append(server.accept())
                except OSError:
                    return

        threading.Thread(target=accept, daemon=True).start()
        address = f"tcp://127.0.0.1:{server.getsockname()[1]}"
        begin = time.monotonic()
        with pytest.raises(studies.StudyError, match="accepts the connection and does not answer"):
            studies.run(studies.load("variants"), tmp_path / "out.parquet", cluster=address, progress=False)
        assert time.monotonic() - begin < 10
    assert list(tmp_path.iterdir()) == []


def fill(folder: Path, names: list[str]) -> None:
    (folder / "dataset.toml").write_text(HEAD + "".join(RECORD.format(name) for name in names))


@posix
def test_a_crash_of_the_reader_is_a_message_and_the_other_records_are_read(tmp_path: Path) -> None:
    time_ = np.arange(600) * 0.002
    fine = mat(**{"time": time_, "stroke": np.sin(6 * time_)})
    for name in ("a.mat", "c.mat"):
        fine(tmp_path / name)
    changed(144, 5)(tmp_path / "b.mat")
    fill(tmp_path, ["a.mat", "b.mat", "c.mat"])
    messages = {
        name: [f.message for f in check_dataset(tmp_path).findings if f.file == name] for name in ("a.mat", "b.mat", "c.mat")
    }
    assert messages["b.mat"] == ["the file is damaged: its reader ended by SIGSEGV"]
    for name in ("a.mat", "c.mat"):
        assert any("no unit, must be like 'time [s]'" in text for text in messages[name])


@posix
def test_many_crashes_are_not_all_tried(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(binary, "MOST_DEATHS", 2)
    names = [f"{i}.mat" for i in range(5)]
    for name in names:
        changed(144, 5)(tmp_path / name)
    fill(tmp_path, names)
    messages = [finding.message for finding in check_dataset(tmp_path).errors]
    assert [text.startswith("the file is damaged") for text in messages] == [True, True, False, False, False]
    assert messages[4] == "not read, because 2 files before it are damaged"


def slow_reader(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: str) -> str:
    script = tmp_path / "slow.py"
    script.write_text(f"import sys\n{code}\n")
    monkeypatch.setattr(binary, "PROGRAM", (str(script),))
    mat(time=np.arange(5))(tmp_path / "a.mat")
    fill(tmp_path, ["a.mat"])
    (finding,) = check_dataset(tmp_path).errors
    return finding.message


def test_a_reader_that_waits_is_ended_and_the_machine_may_be_the_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(binary, "BUSY", 0.02)
    message = slow_reader(tmp_path, monkeypatch, "import time; time.sleep(300)")
    assert message.startswith("reading took more than ")
    assert message.endswith(" s: the file is damaged, or the machine is too busy")


@posix
def test_the_time_of_a_reader_is_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(binary, "SECONDS", 1.0)
    message = slow_reader(
        tmp_path, monkeypatch, "from twintube.readers.__main__ import limit\nlimit(int(sys.argv[2]))\nwhile True: pass"
    )
    assert message == "the file is damaged: reading took more than 1 s of processor time"


def test_one_child_reads_all_binary_records_of_a_dataset(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    started: list[int] = []
    child = binary.child
    monkeypatch.setattr(binary, "child", lambda folder, files: started.append(len(files)) or child(folder, files))
    names = [f"{i}.mat" for i in range(8)]
    for name in names:
        mat(time=np.arange(5))(tmp_path / name)
    fill(tmp_path, names)
    check_dataset(tmp_path)
    assert started == [8]


def test_single_bytes_changed_anywhere_never_end_this_process(tmp_path: Path) -> None:
    rng = np.random.default_rng(1)
    names = [f"{i}.mat" for i in range(60)]
    for name in names:
        changed(int(rng.integers(128, 400)), int(rng.integers(0, 256)))(tmp_path / name)
    fill(tmp_path, names)
    begin = time.monotonic()
    assert check_dataset(tmp_path).errors
    assert time.monotonic() - begin < 60
