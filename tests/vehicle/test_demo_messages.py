"""The sentences above the pictures of the main job: they say what the figures say, also where there is little to say."""

from typing import Any

import pytest

from twintube.demo import messages


def entry(level: float, band: tuple[float, float], failed: float | None = None) -> dict[str, Any]:
    return {"oil_level": level, "bands": {"all_over_intact": list(band)}, "time_to_failure_s": failed}


def result(*blocks: list[dict[str, Any]]) -> dict[str, Any]:
    speeds = [{"speed_kmh": v, "oil_levels": entries} for v, entries in zip((30.0, 50.0), blocks, strict=True)]
    return {"damper": "SA8", "seconds": 120.0, "speeds": speeds}


def test_the_wheel_load_rises_from_the_first_level_that_is_sure_at_every_speed() -> None:
    slow = [entry(0.6, (1.2, 1.5)), entry(0.5, (1.05, 2.0)), entry(0.4, (1.39, 2.6)), entry(0.3, (1.5, 2.93))]
    fast = [entry(0.6, (1.2, 1.5)), entry(0.5, (1.2, 2.0)), entry(0.4, (1.5, 2.2)), entry(0.3, (1.5, 2.1))]
    text = messages.over_oil_level(result(slow, fast))
    assert text == ("With 40 % oil and less, SA8 lets the wheel load fluctuate 39 to 193 % more than intact, "
                    "over the shaded band")  # fmt: skip
    unsure = [entry(0.3, (1.05, 2.0))]
    assert messages.over_oil_level(result(unsure, unsure)).startswith("At no oil level does SA8")


@pytest.mark.parametrize(
    ("failed", "begin"),
    [(30.0, "After 30 s at 50 km/h, SA8 with 80 % oil"), (0.0, "From the start at 50 km/h"), (None, "SA8 keeps")],
)
def test_the_time_of_the_loss_is_that_of_the_highest_level_that_loses(failed: float | None, begin: str) -> None:
    block = [entry(0.9, (1.0, 1.0)), entry(0.8, (1.0, 1.0), failed)]
    assert messages.development(result(block, block)).startswith(begin)


@pytest.mark.parametrize(
    ("times", "told"),
    [
        ((30.0, 10.0, None), "after 30 s, after 10 s or not within 240 s: the freed gas decides"),
        ((0.0, 0.0, 0.0), "from the start, whatever the freed gas does"),
    ],
)
def test_what_the_freed_gas_decides_is_said_only_where_it_decides(times: tuple[float | None, ...], told: str) -> None:
    table = {"seconds": 240.0, "speeds_kmh": [30.0, 50.0], "oil_levels": [0.9, 0.8],
             "freed_gas_ways": {str(i): [[None, None], [None, time]] for i, time in enumerate(times)}}  # fmt: skip
    shown = {"damper": "SA8", "time_to_failure": table, "moments": {"speed_kmh": 50.0, "oil_level": 0.8}}
    assert messages.failure(shown) == f"SA8 with 80 % oil at 50 km/h loses half of its damping {told}"


def test_the_assumption_that_is_named_moves_the_rise_most() -> None:
    bars = {0.9: {"road": (1.0, 1.02), "links": (1.0, 1.0)}, 0.8: {"road": (1.6, 1.65), "links": (1.0, 1.83)}}
    text = messages.bands(bars, 50.0)
    assert text.startswith("Most depends on links: with 80 % oil") and text.endswith("between 0 % and +83 %")


def test_resonances_are_told_with_two_digits() -> None:
    text = messages.spectrum([("body", 1.625, 203.4), ("wheel", 12.1, 4.83)], "SA8")
    assert "200 times" in text and "body (1.6 Hz)" in text and "4.8 times" in text
