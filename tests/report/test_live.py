"""Records to look into: the page in a browser shows the values that it was given, every control works, nothing is said."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from twintube.report.common import style
from twintube.report.common.html_page import Page, Section
from twintube.report.identification.live import MOST_POINTS, Curve, Look, live

CURVES = [Curve("measured", "measured", style.INK), Curve("base", "base model <b>", style.BLUE, (6, 4)),
          Curve("other", "other model", style.GREEN, shown=False)]  # fmt: skip


def look(name: str, turns: int) -> Look:
    t = np.linspace(2.0, 2.0 + turns, 100 * turns + 1)
    s, v = 0.04 * np.sin(2 * np.pi * t), 0.08 * np.pi * np.cos(2 * np.pi * t)
    measured = 900.0 * v
    measured[5] = np.nan
    forces = {"measured": measured, "base": 850.0 * v, "other": 0.0 * v}
    return Look(name, f"Remark on {name}.", t, s, v, forces, list(range(0, 100 * turns + 1, 100)))


@pytest.fixture
def page(chromium: Any, tmp_path: Path) -> Iterator[Any]:
    part = live(CURVES, [look("first </script>", 3), look("second", 20)])
    file = tmp_path / "page.html"
    file.write_text(Page("Live", [Section("records", "Records", live=part)]).html, encoding="utf-8")
    said: list[str] = []
    shown = chromium.new_page(viewport={"width": 900, "height": 900})
    shown.on("console", lambda message: said.append(message.text))
    shown.on("pageerror", lambda error: said.append(str(error)))
    shown.goto(file.as_uri())
    yield shown
    shown.close()
    assert said == []


def values(page: Any) -> str:
    return str(page.inner_text("#look-values"))


def test_values_are_those_of_the_record(page: Any) -> None:
    first = look("", 3)
    # Of several oscillations the second one is shown, which no ramp precedes.
    page.fill("#look-point", "25")
    i = 125
    wanted = (
        f"t = {first.time[i] - first.time[0]:.3f} s, s = {1e3 * first.stroke[i]:.1f} mm, v = {first.velocity[i]:.3f} m/s: "
        f"measured {first.forces['measured'][i]:.1f} N, base model <b> {first.forces['base'][i]:.1f} N"
    )
    assert values(page).replace("-0.0", "0.0") == wanted.replace("-0.0", "0.0")
    page.select_option("#look-part", label="all")
    page.fill("#look-point", "5")
    assert "measured – N" in values(page)  # not compared there


def test_curves_are_switched_and_differences_shown(page: Any) -> None:
    page.fill("#look-point", "3")
    page.check("#look-curves input >> nth=2")
    assert "other model 0.0 N" in values(page)
    page.uncheck("#look-curves input >> nth=1")
    assert "base model" not in values(page)
    page.select_option("#look-over", label="time, difference to the measurement")
    first = look("", 3)
    assert f"other model {first.forces['measured'][103]:.1f} N" in values(page)
    assert "measured " not in values(page).split(":")[1]
    for box in range(3):
        page.uncheck(f"#look-curves input >> nth={box}")
    assert values(page).endswith("no curve is chosen")


def test_the_pointer_reads_off_the_nearest_sample(page: Any) -> None:
    box = page.locator("#look .u-over").bounding_box()
    page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 2)
    match = re.search(r"s = (-?[\d.]+) mm.*measured (-?[\d.]+) N", values(page))
    assert match
    # The largest force is in the middle of the stroke.
    assert abs(float(match[1])) < 6 and float(match[2]) > 200


def test_another_record_has_its_own_parts(page: Any) -> None:
    page.select_option("#look-record", label="second")
    assert page.inner_text("#look-remark") == "Remark on second."
    parts = page.locator("#look-part option").all_inner_texts()
    assert parts[-1] == f"oscillation {(MOST_POINTS - 1) // 100}"  # what is beyond is left out


def test_curves_are_seen_on_dark_paper(page: Any) -> None:
    ink = "getComputedStyle(document.documentElement).getPropertyValue('--look-measured').trim()"
    assert page.evaluate(ink) == style.INK
    page.emulate_media(color_scheme="dark")
    assert page.evaluate(ink) == style.DARK[style.INK]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_labels_and_contrast(page: Any, scheme: Any) -> None:
    page.emulate_media(color_scheme=scheme)
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-playwright-python is not installed")
    for width in (360, 900):
        page.set_viewport_size({"width": width, "height": 900})
        page.wait_for_timeout(50)
        assert page.evaluate("document.documentElement.scrollWidth") <= width
    found = axe.Axe().run(page).response["violations"]
    assert [(item["id"], item["nodes"][0]["html"]) for item in found] == []


def test_no_records_no_part() -> None:
    assert live(CURVES, []) == ""
