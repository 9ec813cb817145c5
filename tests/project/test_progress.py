"""What a long command says while it works: no time left before that means something."""

import io

import pytest

from twintube.common.bars import Bar


@pytest.mark.parametrize("initial", [0, 40])
def test_the_time_left_is_told_from_a_tenth_of_the_work_on(initial: int) -> None:
    with Bar(total=140, initial=initial, file=io.StringIO()) as bar:
        left = (140 - initial) // 10
        assert "<" not in str(bar)
        bar.update(left - 1)
        assert "<" not in str(bar) and f"{initial + left - 1}/140" in str(bar)
        bar.update(1)
        assert "<" in str(bar)
