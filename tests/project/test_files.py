"""Files are written whole or not at all, also by two runs at once."""

import os
import stat
from pathlib import Path
from threading import Barrier, Thread

import pytest

from twintube.common.files import replacing, write_bytes, write_text


def test_a_file_is_replaced_whole(tmp_path: Path) -> None:
    path = tmp_path / "result.json"
    write_text(path, "one")
    write_bytes(path, b"two")
    assert path.read_bytes() == b"two"
    assert list(tmp_path.iterdir()) == [path]


def test_an_error_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "result.json"
    write_text(path, "old")
    with pytest.raises(RuntimeError), replacing(path) as part:
        part.write_text("half")
        raise RuntimeError
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_two_runs_on_one_output_each_write_a_whole_file(tmp_path: Path) -> None:
    path, together = tmp_path / "result.bin", Barrier(2)

    def run(content: bytes) -> None:
        with replacing(path) as part, part.open("wb") as file:
            for i in range(50):
                file.write(content)
                if i == 25:
                    together.wait()

    threads = [Thread(target=run, args=(letter * 1000,)) for letter in (b"a", b"b")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert path.read_bytes() in (b"a" * 50000, b"b" * 50000)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(os.name != "posix", reason="modes of POSIX")
def test_a_result_is_as_public_as_other_new_files(tmp_path: Path) -> None:
    (tmp_path / "plain").write_text("")
    write_text(tmp_path / "result", "")
    modes = {stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("plain", "result")}
    assert len(modes) == 1
