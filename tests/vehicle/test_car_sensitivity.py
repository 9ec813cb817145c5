"""`python -m benchmarks car_sensitivity`: every assumed value reaches the car, and the figures are those of the drives."""

import json
import math
from pathlib import Path

import pytest
from typer.testing import CliRunner

from twintube.cli.base import standalone
from twintube.cli.tables import car_sensitivity
from twintube.dampers import ParameterError, load
from twintube.dampers.freed_gas import DEFAULT
from twintube.vehicle.cars import FOLDER, METAS, load_car
from twintube.vehicle.full import sensitivity as study
from twintube.vehicle.full.catalogue import MANEUVERS
from twintube.vehicle.full.sensitivity import ASSUMED, FORCES, Assumed, Variant, growth, plus, times


@pytest.fixture
def passat() -> Variant:
    return Variant(load_car(), load("SA7"), load("SA8"))


@pytest.mark.parametrize("name", sorted(path.stem for path in FOLDER.glob("*.toml")))
@pytest.mark.parametrize("item", ASSUMED, ids=lambda item: item.title)
def test_both_ends_of_every_value_are_admissible_and_change_what_they_name(item: Assumed, name: str) -> None:
    variant = Variant(load_car(name), load("SA7"), load("SA8"))
    assert item.reason
    for end in (item.low, item.high):
        changed = variant.with_(item, end)
        if item.tables == (FORCES,):
            assert changed.front.parameters.F_re[-1] == pytest.approx(end * variant.front.parameters.F_re[-1])
            continue
        for table in item.tables:
            for key in METAS[table]:
                before, after = ({**v.car.axles, **v.car.whole}[table][key] for v in (variant, changed))
                wanted = before / end if key in item.inverse else before
                if key in item.names:
                    wanted = before + end if item.adds else before * end
                assert after == pytest.approx(wanted), (table, key)


def test_a_value_out_of_its_range_is_refused(passat: Variant) -> None:
    with pytest.raises(ParameterError, match=r"^heavy: body.height = 5.5 m: must be a number from 0.1 to 3 m"):
        passat.with_(times("heavy", 1.0, 10.0, "", ["body"], "height"), 10.0)


def test_growth_is_worn_over_intact_on_the_same_road_and_nan_where_it_was_not_driven() -> None:
    name = MANEUVERS["braking"].headline[0]
    common = {"maneuver": "braking", "road": "D"}
    entries = [
        common | {"seed": seed, "oil_level": oil, "model": DEFAULT} | figures
        for seed, oil, figures in (
            (1, 1.0, {name: 20.0}), (1, 0.5, {name: 25.0}), (2, 1.0, {name: 40.0}), (2, 0.5, {"failed": "a piston"}),
        )
    ]  # fmt: skip
    (values,) = growth(entries).values()
    assert values[0] == pytest.approx(0.25) and math.isnan(values[1])


def test_table_picture_and_figures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    few = (
        plus("height", -0.05, 0.05, "test", ["body"], "height", unit="m"),
        times("grip", 0.8, 1.0, "test", study.TYRES, *study.PEAK),
    )
    drives = (("braking", "smooth"), ("braking", "D"))
    for module in ("twintube.vehicle.full.sensitivity", "twintube.report.car.sensitivity"):
        monkeypatch.setattr(f"{module}.ASSUMED", few)
        monkeypatch.setattr(f"{module}.DRIVES", drives)
    file, out = tmp_path / "s.json", tmp_path / "page"
    run = CliRunner().invoke(
        standalone(car_sensitivity), ["--seeds", "1", "--draws", "3", "--json", str(file), "--output", str(out)]
    )
    assert run.exit_code == 0, run.output
    found = json.loads(file.read_text())
    assert [(h["maneuver"], h["road"]) for h in found["headlines"]] == list(drives)
    for headline in found["headlines"]:
        assert len(headline["nominal"]) == 1 and len(headline["draws"]) == len(headline["draws_scalar_factor"]) == 3
        # The high end of the grip is the car as it is.
        assert headline["ends"]["grip"][1] == pytest.approx(headline["nominal"][0], abs=1e-12)
        assert set(headline["ends"]) == {"height", "grip"}
    assert run.output.count("| height | -50 to +50 mm |") == 1
    assert (out / "sensitivity.png").read_bytes().startswith(b"\x89PNG")
    assert "All assumed values" in (out / "sensitivity.html").read_text(encoding="utf-8")
    run = CliRunner().invoke(standalone(car_sensitivity), ["--oil-level", "1"])
    assert run.exit_code == 2 and run.output == "error: oil_level = 1: must be below 1 for a worn damper\n"
