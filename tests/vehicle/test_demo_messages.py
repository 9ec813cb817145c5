"""The sentences above the pictures of the main job: they say what the figures say, also where there is little to say."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from twintube.demo import messages, pictures
from twintube.demo.ride import RideCase


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
    ("failed", "told"),
    [
        (30.0, "At 50 km/h, SA8 with 80 % oil has less than half of the intact damping power for the first time between "
               "30 and 40 s"),
        (None, "SA8 keeps more than half of its damping power for 120 s at 50 km/h at every level drawn"),
    ],
)  # fmt: skip
def test_the_time_of_the_loss_is_that_of_the_highest_level_that_loses(failed: float | None, told: str) -> None:
    block = [entry(0.9, (1.0, 1.0)), entry(0.8, (1.0, 1.0), failed)]
    assert messages.development(result(block, block)) == told


@pytest.mark.parametrize(
    ("times", "told"),
    [
        ((30.0, 10.0, None), "between 30 and 40 s, between 10 and 20 s or not within 240 s: the freed gas decides"),
        ((0.0, 0.0, 0.0), "between 0 and 10 s, whatever the freed gas does"),
    ],
)
def test_what_the_freed_gas_decides_is_said_only_where_it_decides(times: tuple[float | None, ...], told: str) -> None:
    table = {"seconds": 240.0, "speeds_kmh": [30.0, 50.0], "oil_levels": [0.9, 0.8],
             "freed_gas_ways": {str(i): [[None, None], [None, time]] for i, time in enumerate(times)}}  # fmt: skip
    shown = {"damper": "SA8", "time_to_failure": table, "moments": {"speed_kmh": 50.0, "oil_level": 0.8}}
    begin = "SA8 with 80 % oil at 50 km/h first has less than half of the intact damping power"
    assert messages.failure(shown) == f"{begin} {told}"


def test_the_assumption_that_is_named_moves_the_rise_most() -> None:
    bars = {0.9: {"road": (1.0, 1.02), "links": (1.0, 1.0)}, 0.8: {"road": (1.6, 1.65), "links": (1.0, 1.83)}}
    text = messages.bands(bars, 50.0)
    assert text.startswith("Most depends on links: with 80 % oil") and text.endswith("between 0 % and +83 %")


def test_resonances_are_told_with_two_digits() -> None:
    text = messages.spectrum([("body", 1.625, 203.4), ("wheel", 12.1, 4.83)], "SA8")
    assert "200 times" in text and "at 1.62 Hz" in text and "4.8 times" in text


def test_the_spectrum_is_compared_at_the_frequency_that_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """White noise with a sine at another frequency in each ride: at the worn one's, the intact one has noise only."""
    said: list[Any] = []
    monkeypatch.setattr(pictures.messages, "spectrum", lambda grown, where: said.extend(grown) or where)
    monkeypatch.setattr(pictures, "save", lambda *args, **_: tmp_path)
    time = np.arange(0.0, 120.0, 0.01)
    noise = np.random.default_rng(0).standard_normal(len(time))

    def driven(frequency: float, preload: int) -> Any:
        load = noise + 10.0 * np.sin(2 * np.pi * frequency * time)
        return SimpleNamespace(case=RideCase(50.0, 1.0 if preload else 0.4, preload), time=time, wheel_load=load)

    what = {"damper": "SA8", "seconds": 120.0, "axle": "rear", "car": {"title": "car"}}
    pictures.spectrum(tmp_path, what, [driven(1.25, 1), driven(2.0, 0)])
    body, wheel = said
    assert body[1] == pytest.approx(2.0) and body[2] > 100
    assert wheel[2] == pytest.approx(1.0, abs=0.1)
