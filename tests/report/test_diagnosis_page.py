"""The page of a diagnosis: every verdict, one file, what a browser makes of it."""

import json
import re
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import matplotlib.image
import numpy as np
import pytest
from click.testing import Result
from typer.testing import CliRunner

from tests.diagnosis import small
from tests.report.test_page import parsed
from twintube.cli import app
from twintube.core.checks import tube_limit
from twintube.core.effects import EFFECTS
from twintube.dampers import Damper, load
from twintube.data import Record
from twintube.diagnosis.fits.candidates import candidates
from twintube.diagnosis.records.prepare import prepared
from twintube.diagnosis.records.record import PreparedRecord
from twintube.diagnosis.result import (
    VERDICTS,
    Alternative,
    Cause,
    Diagnosis,
    Errors,
    Estimate,
    Gain,
    Map,
    RecordResult,
    Tried,
    as_json,
)
from twintube.engine.simulate import simulate
from twintube.readable import amount, digits, percent, with_interval
from twintube.report.answer import confidence, has_extension, lines, next_step, number
from twintube.report.diagnosis import BADGES, cause_tables, doubt, open_values, write_report
from twintube.report.diagnosis_loop import telling, typical
from twintube.report.diagnosis_records import broken, closed, compared, models, oscillations, parts, shown, work
from twintube.report.engineering import in_words, is_share, meaning
from twintube.rig.signals import harmonic_block

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
NOISE = 8.0  # [N]
SENTENCES = {
    "cause": "A rubber mount in series explains the deviation: compliance 5.0 mm/kN.",
    "none": "Nothing is missing: the model agrees with the data within the noise.",
    "recalibrate": "The model needs other values of its parameters, but no further effect.",
    "ambiguous": "A rubber mount and compressible oil explain these records equally well.",
    "unexplained": "The deviation is real, but no candidate explains it.",
    "measurement_fault": "The force channel reads 5 % too low; the damper needs no further effect.",
}


def state(damper: Damper, level: float) -> Damper:
    return damper.with_(oil_level=level, gas_preload=int(level >= 1))


def measure(truth: Damper, level: float, v: float, rng: np.random.Generator) -> Record:
    """A record of the model itself, with noise."""
    block = harmonic_block(v, dt=1e-3, rest=2.0, start="rebound")
    force = simulate(state(truth, level), block.stroke, block.velocity, block.time).force
    force = force + rng.normal(0, NOISE, len(force))
    name = f"h{level * 100:.0f}_{v:g}"
    return Record(name, name + ".csv", "harmonic", level, level >= 1, None, None, block.time, block.stroke, force,
                  block.velocity, "measured", None, ())  # fmt: skip


def force_of(damper: Damper, record: Record, case: PreparedRecord) -> np.ndarray:
    """Mean simulated force over the intervals of a prepared record."""
    found = simulate(state(damper, record.oil_level), record.stroke, record.velocity, record.time).force
    total = np.concatenate([[0.0], np.cumsum((found[1:] + found[:-1]) / 2 * np.diff(record.time))])
    at = np.searchsorted(record.time, case.time)
    return np.concatenate([found[:1], np.diff(total[at]) / np.diff(case.time)])


def results(
    truth: Damper, base: Damper, recalibrated: Damper, extended: Damper, gain: float, levels: tuple[float, ...]
) -> list[RecordResult]:
    rng = np.random.default_rng(0)
    found = []
    for level in levels:
        for i, v in enumerate((0.131, 0.524, 1.048) if len(levels) > 1 else (0.262, 0.524)):
            record = measure(truth, level, v, rng)
            case = prepared(record, tube_limit(base.parameters))
            forces = [force_of(damper, record, case) for damper in (base, recalibrated, extended)]
            forces[2] = forces[2] * gain
            weight = np.where(case.judged, 1 / case.noise, 0.0)
            found.append(RecordResult(case, "heldout" if i == 1 else "fit", case.force, *forces, weight))
    return found


def rms(records: list[RecordResult], name: str) -> Errors:
    """Errors over records; noise_floor is that of the records."""
    if name == "noise_floor":
        return Errors(float(np.mean([r.noise for r in records])), 0.4)
    force = np.mean([r.rms(getattr(r, name)) ** 2 for r in records]) ** 0.5
    off = np.concatenate([work(r.record, getattr(r, name)) - work(r.record, r.measured) for r in records])
    return Errors(float(force), float(np.sqrt(np.mean(off**2))))


def residual_maps(records: list[RecordResult]) -> list[Map]:
    joined = {k: np.concatenate([getattr(r.record, k)[1:] for r in records]) for k in ("stroke", "velocity", "time")}
    joined["cycle"] = np.concatenate([r.record.cycle[1:].astype(float) for r in records])
    joined["oil level"] = np.concatenate([np.full(len(r.base) - 1, r.record.oil_level) for r in records])
    joined["acceleration"] = np.concatenate([np.gradient(r.record.velocity, r.record.time)[1:] for r in records])
    base, extended = (np.concatenate([(r.measured - getattr(r, k))[1:] for r in records]) for k in ("base", "extended"))
    units = {"stroke": "m", "velocity": "m/s", "time": "s", "oil level": "1", "acceleration": "m/s2", "cycle": ""}
    found = []
    for name, x in joined.items():
        levels = np.unique(x)
        edges = np.append(levels, levels[-1] + 1) - 0.1 if len(levels) < 5 else np.linspace(x.min(), x.max() + 1e-9, 13)
        which = [(x >= a) & (x < b) for a, b in zip(edges, edges[1:], strict=False)]
        centres = levels if len(levels) < 5 else (edges[1:] + edges[:-1]) / 2
        floor = np.where([w.any() for w in which], np.mean([r.noise for r in records]), np.nan)
        stats = [
            [f(y[w]) if w.any() else np.nan for w in which]
            for f, y in (
                (lambda e: np.sqrt(np.mean(e**2)), base),
                (lambda e: np.sqrt(np.mean(e**2)), extended),
                (np.mean, base),
            )
        ]
        found.append(Map(name, units[name], centres, np.array(stats[0]), np.array(stats[1]), floor, np.array(stats[2])))
    return found


def tried(chosen: str) -> list[Tried]:
    names = [
        "mount_compliance",
        "fluid_lag",
        *sorted(set(EFFECTS) - {"mount_compliance", "fluid_lag"}),
        "channel_delay",
        "force_gain",
    ]
    gains = np.r_[0.95, 0.88, np.linspace(0.3, -0.2, len(names) - 3), -7.0]
    first = [
        Tried(1, n, float(g), (float(g - 0.06 * (1 + abs(g))), float(g + 0.03)),
              "chosen" if n == chosen else "rejected",
              "largest gain on held-out records" if n == chosen else "close to the best" if g > 0.5 else "gain within its uncertainty")
        for n, g in zip(names, gains, strict=True)
    ]  # fmt: skip
    second = [Tried(2, n, float(g), (float(g - 0.04), float(g + 0.04)), "rejected", "less than 5 % of what is left")
              for n, g in zip(names[1:], np.linspace(0.03, -0.1, len(names) - 1), strict=True)]  # fmt: skip
    return first + (second if chosen else [])


@cache
def example(verdict: str) -> Diagnosis:
    """A diagnosis of each kind: the truth is what the verdict says."""
    base = load("SA8", as_published=True)
    mount = base.with_(C_mount=5e-6)
    new = base.with_(X_Re=0.1, k_high=min(5.0, base.parameters.k_high * 3 + 0.5))
    truth, recalibrated, extended, gain = {
        "cause": (mount, base.with_(k_high=base.parameters.k_high + 0.1), mount, 1.0),
        "ambiguous": (mount, base, mount, 1.0),
        "none": (base, base, base, 1.0),
        "recalibrate": (new, new, new, 1.0),
        "unexplained": (mount, base, base, 1.0),
        "measurement_fault": (base.with_(wear_re=-0.05, wear_co=-0.05), base, base, 0.95),
    }[verdict]
    records = results(truth, base, recalibrated, extended, gain, (1.0, 0.4) if verdict == "cause" else (0.6,))
    splits = {s: [r for r in records if r.split == s] for s in ("heldout", "fit")}
    gains = Gain(0.96, 0.95, (0.91, 0.97), 0.82)
    causes = {
        "cause": [Cause("mount_compliance", EFFECTS["mount_compliance"].title, EFFECTS["mount_compliance"].cause, {
            "C_mount": Estimate(5.02e-6, 4.9e-6, 5.15e-6, "m/N", (0.0, 1e-4), 0.0), "tau_mount": Estimate(1.1e-3, 0.6e-3, 1.6e-3, "s", (0.0, 1.9e-3), 0.0)}, gains)],
        "measurement_fault": [Cause("force_gain", "Force gain", "The load cell's sensitivity is wrong.",
                                    {"force_gain": Estimate(0.95, 0.948, 0.952, "1", (0.5, 2.0), 1.0)}, gains)],
    }  # fmt: skip
    causes["ambiguous"] = causes["cause"]
    likely = {
        "cause": "mount_compliance",
        "ambiguous": "mount_compliance",
        "measurement_fault": "force_gain",
        "unexplained": "unknown",
    }
    return Diagnosis(
        title="Bench, SA8 <42 & more>", verdict=verdict, sentence=SENTENCES[verdict], causes=causes.get(verdict, []),
        alternatives=[Alternative("fluid_lag", 0.88, "records of small strokes at high frequency")] if verdict in ("cause", "ambiguous") else [],
        errors={s: {n: rms(some, n) for n in ("base", "recalibrated", "extended", "noise_floor")} for s, some in splits.items()},
        where="" if verdict == "none" else "after every reversal, most at 1.05 m/s, alike at all oil levels.",
        signature="a force of both signs after reversals, about 3 ms late." if verdict == "unexplained" else "",
        maps=residual_maps(records)[: 6 if verdict == "cause" else 2], tried=tried("mount_compliance" if verdict == "cause" else ""), records=records, base=base,
        recalibrated=recalibrated, extended=extended,
        next_measurements=[] if verdict == "none" else ["A sine of 5 mm at 10 Hz", "A rest of 300 s, then the same block"],
        structure={"base": [records[0].record.name], "recalibrated": [], "extended": []},
        probabilities={likely.get(verdict, verdict): 0.93, "fluid_lag": 0.06, "seal_leak": 0.01},
        remarks=["2 records of less than 3 oscillations give no noise of their own"] if verdict == "cause" else [], seconds=42.3,
    )  # fmt: skip


@pytest.fixture(scope="module")
def pages(tmp_path_factory) -> dict[str, Path]:
    found = {}
    for verdict in VERDICTS:
        folder = tmp_path_factory.mktemp(verdict)
        files = write_report(example(verdict), folder)
        assert all(file.is_file() for file in files)
        found[verdict] = folder / "report.html"
    return found


@pytest.mark.parametrize("verdict", VERDICTS)
def test_every_verdict(pages, verdict):
    text = pages[verdict].read_text(encoding="utf-8")
    page = parsed(text)
    assert page.loads and all(uri.startswith("data:image/png;base64,") for uri in page.loads)
    said = re.sub(r"<script.*?</script>", "", text, flags=re.DOTALL)
    assert not re.search(r"https?://|@import|url\(", said)
    assert not re.search(r"<script[^>]*\bsrc", text)
    assert SENTENCES[verdict] in text and BADGES[verdict][0] in text
    assert {link[1:] for link in page.links} <= page.anchors
    assert "nan" not in re.sub(r"base64,[^\"]*", "", said)
    assert "SA8 &lt;42 &amp; more&gt;" in text and "Computed in 42 s" in text


def test_empty_parts_vanish(pages):
    texts = {verdict: page.read_text(encoding="utf-8") for verdict, page in pages.items()}
    assert "Values" not in texts["none"] and "extended.toml" not in texts["none"] + texts["unexplained"]
    assert "that of the noise" in texts["none"] and "extended model" not in texts["none"] + texts["unexplained"]
    assert "5.02 mm/kN" in texts["cause"] and "4.90 to 5.15 mm/kN" in texts["cause"]
    assert "Parameters that were recalibrated" in texts["recalibrate"] and "X_Re" in texts["recalibrate"]
    assert "What no candidate explains" in texts["unexplained"]
    assert "fault accounted for" in texts["measurement_fault"]
    assert "extended.toml" in texts["cause"] and "extended.toml" not in texts["measurement_fault"]


def test_a_curve_is_not_drawn_twice():
    names = {verdict: [m.name for m in compared(example(verdict))] for verdict in ("cause", "none", "recalibrate")}
    assert names == {"cause": ["base", "extended"], "none": ["base"], "recalibrate": ["base", "recalibrated"]}


def test_oscillations_and_their_work():
    """Nineteen of them, without the slow ones before; the work is that of the dense record."""
    record = measure(load("SA8", as_published=True), 0.6, 0.524, np.random.default_rng(1))
    case = prepared(record, 1.0)
    block = oscillations(case)
    assert len(block) == 19 and [name for name, _ in parts(case)] == ["first oscillation", "oscillation 19"]
    marks = harmonic_block(0.524, dt=1e-3, rest=2.0, start="rebound").marks
    dense = [np.trapezoid(record.force[a : b + 1], record.stroke[a : b + 1]) for a, b in zip(marks, marks[1:], strict=False)]
    assert work(case, case.force) == pytest.approx(np.array(dense), rel=0.01)
    ends = closed(case, block[0])
    assert len(ends) == len(block[0]) + 1 and closed(case, block[-1])[0] == block[-1][0] - 1


def test_held_out_records_come_first():
    assert [r.split for r in shown(example("cause"))] == ["heldout"] * 2 + ["fit"] * 4


def test_numbers_for_readers():
    assert with_interval(-0.0312, -0.04, -0.022, "1") == ("-3.1 %", "-4.0 to -2.2 %")
    assert with_interval(0.95, 0.948, 0.952, "1", share=False) == ("0.950", "0.948 to 0.952")
    shown = [is_share(*both) for both in [("end_stop", "loss_stop"), ("end_stop", "power_stop"), ("force_gain", "gain")]]
    assert shown == [True, False, False]
    assert with_interval(1.1e-3, float("nan"), 2e-3, "s") == ("1.1 ms", "–")
    assert percent(-1e-5) == "0.0 %"
    assert (percent(0.99996), percent(1.0)) == ("99.9 %", "100 %")
    assert (percent(0.953), percent(-70.0), percent(0.004), percent(float("nan"))) == ("95 %", "below −999 %", "0.4 %", "–")
    assert digits(12345.6, 30.0) == "12346"


def test_a_range_is_shown_in_the_unit_of_its_value():
    late = Estimate(0.02, 0.0199, 0.02, "s", (0.0, 0.02), 0.0)
    assert (late.at_bound, doubt(late, share=False)) == (True, "at the end of its range, 0 to 20 ms")
    stop = Estimate(-0.0422, -0.0425, -0.0419, "m", (-0.0422, 0.0422), 0.0)
    assert doubt(stop, share=False) == "at the end of its range, -42.2 to 42.2 mm"
    assert doubt(Estimate(0.01, 0.0, 0.015, "s", (0.0, 0.02), 0.0), share=False) == "not determined by these records"


def test_causes_with_a_gain_in_common_share_a_row():
    cause = example("cause").causes[0]
    other = replace(cause, effect="fluid_lag", title="Lag of the fluid force")
    fault = replace(cause, effect="sign_flip", title="Sign of the force channel", gain=Gain(0.5, 0.5, (0.4, 0.6), 0.3))
    _, gains = cause_tables([fault, cause, other])
    assert [row[0] for row in gains.rows] == ["Sign of the force channel", f"{cause.title} and Lag of the fluid force"]


def test_records_without_oscillations_and_none_at_all(tmp_path):
    """A drive is drawn as a whole; a fault that leaves no records to show still gives a page."""
    some = example("cause")
    rng = np.random.default_rng(3)
    time = np.arange(0, 6, 2e-3)
    stroke = np.interp(time, time[::100], 0.01 * np.cumsum(rng.normal(size=30)) / 3)
    velocity = np.gradient(stroke, time)
    force = 1000 * velocity + rng.normal(0, NOISE, len(time))
    drive = Record(
        "road", "road.csv", "stochastic", 0.6, False, None, None, time, stroke, force, velocity, "measured", None, ()
    )
    case = prepared(drive, 1.0)
    result = RecordResult(case, "fit", case.force, 0.9 * case.force, 0.9 * case.force, case.force, np.ones(len(case.time)))
    assert not oscillations(case) and parts(case)[0][0] == "whole record"
    one = replace(some, records=[result], errors={"fit": some.errors["fit"], "heldout": {}}, maps=[], tried=[], causes=[])
    names = {file.name for file in write_report(one, tmp_path)}
    assert names == {"answer.png", "loops.png", "residual.png", "errors.png", "report.html"}
    nothing = replace(one, records=[], errors={}, verdict="measurement_fault")
    assert [file.name for file in write_report(nothing, tmp_path)] == ["report.html"]


def test_the_answer_is_alike_on_page_and_terminal_and_in_json(pages):
    d = example("cause")
    value, label = number(d)
    assert value.count("→") == 1 and value in pages["cause"].read_text(encoding="utf-8")
    held = as_json(d)["error"]
    assert value == " → ".join(amount(held[name]["force_rmse_N"], "N") for name in ("base", "extended"))
    assert amount(held["noise_floor"]["force_rmse_N"], "N") in label and "95 %" in label
    assert f"{value}: {label}" in lines(d)
    assert confidence(d) == (
        "Very likely (93 %); next: compressible oil and late check valves (6 %), oil leaks past the rod seal (1 %)"
    )


def test_nothing_named_shows_no_success(pages):
    for verdict in ("none", "unexplained"):
        d = replace(example("cause"), verdict=verdict, causes=[], extended=example("cause").base)
        assert "→" not in number(d)[0] and "goes away" not in number(d)[1]
        assert [m.name for m in compared(d)] == ["base"]
        assert models(d)[-1].label == "nearest candidate, not named"
    assert "tolerance of 3 %" in next_step(replace(example("none"), tolerance=0.03))


def test_next_steps():
    steps = {verdict: next_step(example(verdict)) for verdict in VERDICTS}
    assert EFFECTS["mount_compliance"].decides in steps["cause"]
    assert "records of small strokes" in steps["ambiguous"]
    assert "known weight" in steps["measurement_fault"] and "diagnose again" in steps["measurement_fault"]
    assert steps["none"].startswith("Nothing to do") and "about 3 ms late" in steps["unexplained"]
    assert {verdict for verdict in VERDICTS if has_extension(example(verdict))} == {"cause", "ambiguous", "recalibrate"}


def test_a_fault_that_is_named_twice_is_as_probable_and_mended_once():
    d = example("measurement_fault")
    twice = replace(d, causes=[*d.causes, *d.causes])
    assert confidence(twice) == confidence(d) and next_step(twice) == next_step(d)


def test_the_picture_shows_where_the_error_falls_most():
    d = example("cause")
    result = telling(d)
    assert result.split == "heldout"
    falls = {r.record.name: (r.rms(r.base) - r.rms(r.extended)) / r.record.peak for r in d.records if r.split == "heldout"}
    assert falls[result.record.name] == max(falls.values())
    which, ends = typical(d, result)
    assert "of 19" in which and not which.startswith("oscillation 1 ")
    assert np.isfinite(broken(result, result.base, ends)).all()
    left_out = replace(result, weight=np.zeros_like(result.weight))
    assert np.isnan(broken(left_out, result.base, ends)).all()


def test_only_what_the_records_determine_is_a_value():
    cause = example("cause").causes[0]
    idle = Estimate(1e-3, -1e-3, 3e-3, "1", (-0.8, 1.0), 0.0)
    wear = Estimate(0.3, 0.29, 0.31, "1", (-0.8, 1.0), 0.0)
    worn = replace(cause, effect="valve_wear", title="Change", parameters={"wear_re": wear, "wear_co": idle})
    assert (list(worn.determined), worn.undetermined) == (["wear_re"], ["wear_co"])
    loose = replace(
        cause, parameters={**cause.parameters, "tau_mount": Estimate(1e-3, 0.0, 0.0019, "s", (0.0, 1.9e-3), 0.0)}
    )
    entry = as_json(replace(example("cause"), causes=[loose], tolerance=0.02))
    assert (entry["tolerance"], list(entry["causes"][0]["parameters"])) == (0.02, ["C_mount"])
    assert entry["causes"][0]["undetermined"] == ["tau_mount"]
    assert all(not value["doubt"] for value in entry["causes"][0]["parameters"].values())
    assert open_values([loose]) == [
        f"{cause.title}, without a value of its own: tau_mount (not determined by these records)."
    ]


def test_progress_in_words():
    assert in_words("a single cause: start of mount_compliance") == "trying: rubber mount in series"
    assert in_words("a further cause, 2 in all: force_offset") == "trying another cause as well: zero of the load cell"
    inside = in_words("within the records: a single cause: start of mount_compliance")
    assert inside == "in the records that are left, trying: rubber mount in series"
    assert in_words("instead of fluid_lag: start of valve_wear") == (
        "trying instead of compressible oil and late check valves: change of the F-v curve"
    )
    assert in_words("without recalibrate") == "trying without other known parameters"
    assert in_words("reading the records") == "reading the records"


@pytest.fixture
def diagnosed(monkeypatch):
    """The command with a diagnosis that is computed already."""

    def run(verdict: str, folder: Path, *options: str) -> Result:
        def answer(path: Path, progress: Callable[[str], None], *, tolerance: float = 0.0) -> Diagnosis:
            progress("reading the records")
            return replace(example(verdict), tolerance=tolerance)

        monkeypatch.setattr("twintube.diagnosis.diagnose", answer)
        monkeypatch.setattr("twintube.report.diagnosis.write_report", lambda diagnosis, output: [])
        return CliRunner().invoke(app, ["diagnose", "data", "--output", str(folder), *options])

    return run


def test_the_command_writes_what_is_named_and_leaves_nothing_of_an_earlier_run(diagnosed, tmp_path):
    out = tmp_path / "out"
    first = diagnosed("cause", out)
    assert first.exit_code == 0, first.output
    assert load(out / "extended.toml", as_published=True).parameters == example("cause").extended.parameters
    assert first.stdout.splitlines()[:-1] == lines(example("cause")) and "extended.toml" in first.stdout
    second = diagnosed("none", out, "--tolerance", "3%")
    assert second.exit_code == 0 and "extended.toml" not in second.stdout and "tolerance of 3 %" in second.stdout
    assert not (out / "extended.toml").exists()
    content = json.loads((out / "diagnosis.json").read_text())
    assert content["tolerance"] == pytest.approx(0.03) and content["next_step"] in second.stdout


@pytest.mark.parametrize("text", ["three", "3", "30%", "-1%", "nan", "5,5%", ""])
def test_a_wrong_tolerance_is_one_line(diagnosed, tmp_path, text):
    result = diagnosed("none", tmp_path / "out", "--tolerance", text)
    assert result.exit_code == 2 and result.stderr.count("\n") == 1
    assert result.stderr.startswith(f"error: --tolerance {text}: must be ")
    assert not (tmp_path / "out").exists()


def browse(page: Path, *options: str) -> str:
    """What headless Chromium prints for a page; it goes nowhere else."""
    browser = next((found for name in BROWSERS if (found := shutil.which(name))), None)
    if browser is None:
        pytest.skip(f"no browser: none of {', '.join(BROWSERS)} is installed")
    switches = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync",
                "--disable-background-networking", "--disable-component-update", f"--user-data-dir={page.parent / 'profile'}"]  # fmt: skip
    done = subprocess.run(
        [browser, *switches, *options, page.as_uri()], capture_output=True, text=True, timeout=60, check=True
    )
    return done.stdout


def test_in_a_browser(pages):
    page = pages["cause"]
    dom = browse(page, "--dump-dom")
    head = re.search(r'<div class="headline found">(.*?)</p>', dom, re.DOTALL)
    assert head and SENTENCES["cause"] in head[1] and "cause named" in head[1]
    shot = page.parent / "shot.png"
    browse(page, f"--screenshot={shot}", "--window-size=1200,6000")
    image = matplotlib.image.imread(shot)[..., :3]
    assert image.shape[:2] == (6000, 1200)
    assert image.std() > 0.05 and all(strip.std() > 0.02 for strip in np.array_split(image, 6))


def test_every_value_says_what_it_is() -> None:
    problem = small.problem([small.record(small.run(0.3, small.DEGRADED))])
    names = {f.name for candidate in candidates(problem) for f in candidate.free}
    assert names > {"force_gain", "clock_error", "level_error"}
    assert [name for name in sorted(names) if not meaning(name)] == []
