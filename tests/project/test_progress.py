"""What a long command says while it works: that it still does, and no time left before that means something."""

import io
import time

import pytest

from twintube.cli import progress
from twintube.common.bars import Bar


def test_a_long_silence_is_broken(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(progress, "EVERY", 0.05)
    with progress.progress() as say:
        time.sleep(0.2)  # nothing is being done yet
        say("library 1 of 4")
        time.sleep(0.3)
    lines = capsys.readouterr().err.splitlines()
    assert lines[0].endswith(" s  library 1 of 4")
    assert len(lines) > 1 and all(line.endswith(" s  still library 1 of 4") for line in lines[1:])


@pytest.mark.parametrize("initial", [0, 40])
def test_the_time_left_is_told_from_a_tenth_of_the_work_on(initial: int) -> None:
    with Bar(total=140, initial=initial, file=io.StringIO()) as bar:
        left = (140 - initial) // 10
        assert "<" not in str(bar)
        bar.update(left - 1)
        assert "<" not in str(bar) and f"{initial + left - 1}/140" in str(bar)
        bar.update(1)
        assert "<" in str(bar)
