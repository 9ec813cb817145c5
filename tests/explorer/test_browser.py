"""The page in a browser: it shows the package's numbers, every control works, nothing is said on the console."""

import math
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.explorer.conftest import OWN
from twintube.core.kernel.temperature import thickness
from twintube.dampers import load
from twintube.engine.simulate import simulate
from twintube.rig.plan import amplitude
from twintube.rig.signals import OSCILLATIONS, PRECONDITIONING, V_PRECONDITIONING, oscillations
from twintube.vehicle.cars import load_car
from twintube.vehicle.ride import measures, ride, track

SAMPLES = 400  # of an oscillation on the page
PHASE = 0.75
WIDTHS = (360, 800, 1600)


class View:
    """A page, with what it says on the console."""

    def __init__(self, browser: Any, file: Path, **options: Any) -> None:
        self.file, self.said = file, []  # type: ignore[var-annotated]
        self.page = browser.new_page(**options)
        self.page.on("console", lambda message: self.said.append(message.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.on(
            "request", lambda request: self.said.extend([request.url] * (not request.url.startswith(("file:", "data:"))))
        )

    def open(self, address: str = "") -> "View":
        self.page.goto("about:blank")
        self.page.goto(self.file.as_uri() + address)
        self.page.wait_for_selector("html[data-ready]", state="attached", timeout=20_000)
        return self

    def summary(self) -> str:
        return str(self.page.inner_text("#summary"))

    def now(self) -> float:
        """The time [s] that is shown."""
        return float(self.page.inner_text("#place").split()[0])

    def until(self, condition: Callable[[], bool]) -> None:
        """Wait; the page's policy lets nobody wait inside it."""
        for _ in range(100):
            if condition():
                return
            self.page.wait_for_timeout(30)
        raise AssertionError("waited in vain")


@pytest.fixture
def view(chromium: Any, explorer: Path) -> Iterator[View]:
    shown = View(chromium, explorer, viewport={"width": 1200, "height": 900})
    yield shown
    shown.page.close()
    assert shown.said == []


def block_work(name: str, v: float, **state: float) -> list[float]:
    """Work [J] of every oscillation of a block with the page's samples."""
    damper = load(name).with_(**state)
    reach = amplitude(damper)
    step = 2 * np.pi * reach / SAMPLES
    slow = oscillations(V_PRECONDITIONING, reach, PRECONDITIONING, step / V_PRECONDITIONING, PHASE)
    fast = oscillations(v, reach, OSCILLATIONS, step / v, PHASE)
    rest = float(slow[0][-1]) + float(fast[0][1])
    time, stroke, velocity = (np.concatenate(pair) for pair in zip(slow, (fast[0] + rest, *fast[1:]), strict=True))
    work = simulate(damper, stroke, velocity, time).work
    return list(np.diff(work[len(slow[0]) + SAMPLES * np.arange(OSCILLATIONS + 1)]))


def test_a_block_shows_the_work_that_the_package_computes(view: View) -> None:
    view.open("#damper=SA8&oil=56&velocity=1.572")
    rows = view.page.eval_on_selector_all("#work-rows tr", "rows => rows.map(row => [...row.cells].map(c => c.textContent))")
    expected = zip(block_work("SA8", 1.572, oil_level=0.56, gas_preload=0), block_work("SA8", 1.572), strict=True)
    for row, works in zip(rows, expected, strict=True):
        # Shown with two decimals; the unit integrates the velocity where `simulate` is given the stroke.
        assert [float(cell) for cell in row[1:3]] == pytest.approx(works, abs=0.03, rel=1e-4)


def test_a_cold_damper_does_the_work_that_the_package_computes(view: View) -> None:
    """The worn damper and the intact one are as cold; the slider ends where the law ends."""
    view.open("#damper=SA8&oil=70&temperature=-20")
    cells = view.page.eval_on_selector("#work-rows tr", "row => [...row.cells].map(c => c.textContent)")
    worn, intact = map(float, cells[1:3])
    damper = load("SA8")
    k = math.exp(thickness(damper.parameters, 253.15))
    for work, state in ((worn, {"oil_level": 0.7, "gas_preload": 0}), (intact, {})):
        no_friction = block_work("SA8", 1.048, **state, F_FrS=0.0)[0]
        rubbed = block_work("SA8", 1.048, **state)[0] - no_friction
        assert work == pytest.approx(k * no_friction + k**0.5 * rubbed, rel=1e-3)
    ends = [view.page.get_attribute("#temperature", end) for end in ("min", "max")]
    assert ends == ["-30", "80"]
    assert "-20 °C" in view.summary()


def test_a_drive_shows_the_wheel_load_that_the_package_computes(view: View) -> None:
    view.open("#damper=SA8&oil=50&excitation=drive&speed=50&gas=return")
    match = re.search(r"coefficient ([\d.]+), intact ([\d.]+) .* work (\d+) %", view.summary())
    assert match is not None
    damper, corner = load("SA8"), load_car().corner(load("SA8"))
    route = track(50.0, round(view.now()))
    worn, intact = (
        ride(damper.with_(oil_level=level, gas_preload=gas), corner, route) for level, gas in ((0.5, 0), (1.0, 1))
    )
    figures = measures(worn, corner, intact)
    assert float(match[1]) == pytest.approx(figures["dlc"], abs=0.001)
    assert float(match[2]) == pytest.approx(measures(intact, corner)["dlc"], abs=0.001)
    assert int(match[3]) / 100 == pytest.approx(figures["damping_work_share"], abs=0.01)


def test_every_control_changes_the_result_and_the_address_restores_it(view: View) -> None:
    page = view.open().page
    assert page.input_value("#damper") == OWN  # one's own damper comes first, its name as text
    page = view.open("#damper=SA1&oil=56").page
    seen = [view.summary()]
    actions = [
        lambda: page.select_option("#damper", "SA8"),
        lambda: page.focus("#oil") or page.keyboard.press("ArrowLeft"),
        lambda: page.focus("#temperature") or page.keyboard.press("ArrowLeft"),
        lambda: page.focus("#velocity") or page.keyboard.press("End"),
        lambda: page.uncheck("[name=foam]"),
        lambda: page.uncheck("[name=cavitation]"),
        lambda: page.click("summary:has-text('Effects beyond')") or page.check("[value=valve_wear]"),
        lambda: page.check("[name=preload]"),
        lambda: page.check("[value=ramp]"),
        lambda: page.check("[value=sine]"),
        lambda: page.focus("#amplitude") or page.keyboard.press("Home"),
        lambda: page.check("[value=drive]"),
        lambda: page.uncheck("[name=preload]"),
        lambda: page.select_option("#road", "E"),
        lambda: page.check("[name=cavitation]"),
        lambda: page.select_option("#gas", "pushes_oil"),
    ]
    for action in actions:
        action()
        seen.append(view.summary())
        assert seen[-1] != seen[-2], len(seen)
    page.check("[name=factor]")
    assert page.is_visible("#factor-key")
    view.until(lambda: "factor=yes" in page.evaluate("location.hash"))
    address = page.evaluate("location.hash")
    view.open(address)
    assert view.summary() == seen[-1] and page.is_checked("[name=factor]")
    assert page.evaluate("location.hash") == address
    view.open("#damper=none&oil=1e9&excitation=<b>&effects=x,y&time=-1")  # nothing of it is taken
    assert page.input_value("#damper") == OWN


def test_it_plays_pauses_and_steps(view: View) -> None:
    page = view.open("#velocity=1.572&slow=1&time=0.5").page
    assert view.now() == 0.5
    page.click("#play")
    view.until(lambda: view.now() > 0.7)
    page.keyboard.press("Space")  # on the button
    assert page.inner_text("#play") == "Play"
    paused = view.now()
    assert paused < 3.0
    page.click("#on")
    assert view.now() > paused
    page.click("#jump-back")
    page.click("#jump-back")
    assert view.now() < paused
    page.focus("#scrub")
    page.keyboard.press("End")
    assert page.inner_text("#place").split()[0] == page.inner_text("#place").split()[3]
    page.click("#play")  # at the end: begins again
    view.until(lambda: view.now() < 1.0)
    heights = page.eval_on_selector_all("#tube rect", "rects => rects.map(rect => Number(rect.getAttribute('height')))")
    assert min(heights) >= 0.0


def test_the_tour_has_five_findings_with_figures(view: View) -> None:
    page = view.open().page
    figures = []
    for number in range(1, 6):
        page.click("#tour li:first-child button" if number == 1 else "#tour-on")
        assert page.inner_text("#tour-title").startswith(f"{number} of 5")
        figures.append([float(text) for text in re.findall(r"([\d.]+) (?:%|J)", page.inner_text("#tour-figures"))])
    slow, fast, levels, cavitation, factor = figures
    assert slow[0] == pytest.approx(100, abs=1)
    assert fast[1] < 0.5 * fast[0] < fast[2]
    assert levels[0] > 90 and levels[4] < 10  # beside each work its level
    assert cavitation[0] < 10 and cavitation[1] > 75
    assert factor[0] > factor[1] == 56 and factor[2] < 10 and factor[3] == 56
    page.click("#tour-end")
    assert not page.is_visible("#tour-step")


def test_a_step_of_the_tour_is_read_beside_its_picture_and_ends_with_a_change(view: View) -> None:
    page = view.open().page
    page.set_viewport_size({"width": 1280, "height": 900})
    for number in range(1, 6):
        view.open(f"#tour={number}")
        boxes = {name: page.locator(name).bounding_box() for name in ("#tour-step", "#tube", "#chart-s", "#player")}
        for name in ("#tour-step", "#tube", "#chart-s"):
            assert boxes[name]["y"] + boxes[name]["height"] < boxes["#player"]["y"], (number, name)
    page.click("#play")
    page.click("#play")
    assert page.is_visible("#tour-step")  # it is what is shown, only earlier
    page.focus("#oil")
    page.keyboard.press("ArrowLeft")
    assert not page.is_visible("#tour-step")
    view.until(lambda: "tour" not in page.evaluate("location.hash"))


def test_a_drive_draws_the_intact_damper_in_its_loops(view: View) -> None:
    page = view.open("#damper=SA8&oil=50&excitation=drive&time=0").page
    inked = """id => { const canvas = document.querySelector(`#${id} .u-wrap > canvas`);
        const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
        let count = 0; for (let i = 3; i < data.length; i += 4) count += data[i] > 0; return count / (data.length / 4); }"""
    grid = 0.06  # of the picture that axes, grid and names take
    assert page.evaluate(inked, "chart-s") > 2 * grid


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_contrast_labels_and_widths(chromium: Any, explorer: Path, scheme: str) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-playwright-python is not installed")
    for address in ("#tour=5", "#damper=SA8&excitation=drive"):
        shown = View(chromium, explorer, color_scheme=scheme).open(address)
        shown.page.evaluate("document.querySelectorAll('details').forEach(part => part.open = true)")
        for width in WIDTHS:
            shown.page.set_viewport_size({"width": width, "height": 800})
            shown.page.wait_for_timeout(50)
            assert shown.page.evaluate("document.documentElement.scrollWidth") <= width
        found = axe.Axe().run(shown.page).response["violations"]
        assert [(item["id"], item["nodes"][0]["html"]) for item in found] == []
        shown.page.close()
        assert shown.said == []
