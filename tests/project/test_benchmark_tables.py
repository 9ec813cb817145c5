"""The commands that make tables of the documentation anew give what the pages say."""

import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

from benchmarks import __main__ as command
from benchmarks import gas_path
from benchmarks.dead_length import rises, turning
from benchmarks.gas_path_page import sign
from benchmarks.importer_jobs import COLUMNS
from benchmarks.importer_runs import NO_ERRORS
from benchmarks.importers import REFERENCE, REFUSED, as_table
from benchmarks.marked_pages import parts
from benchmarks.small_strokes import bench_small_strokes
from benchmarks.tiring import row
from twintube import load
from twintube.core.kernel.forces import P_AMBIENT
from twintube.dampers.dead_length import prepared, reserve_gas
from twintube.dampers.freed_gas import SOLUBILITY, condition
from twintube.dampers.variants import scalar_factor
from twintube.vehicle.cars import load_car

DOCS = Path(__file__).parents[2] / "docs"


def rows(head: str, page: str = "inspection.md") -> list[list[str]]:
    """The cells of all rows of a page that begin with the expression `head`, without bold."""
    lines = (DOCS / page).read_text(encoding="utf-8").replace("**", "").splitlines()
    return [line.strip("| ").split(" | ")[1:] for line in lines if re.match(rf"\| {head} \|", line)]


def test_small_strokes() -> None:
    found = bench_small_strokes()
    for name, state in (("SA1", "50"), ("SA4", "50"), ("SA6", "40"), ("SA8", "56")):
        (said,) = rows(f"{name} at {state} %", "claims.md")
        assert [f"{x:.2f}" for x in found[name][f"{state}% oil"].values()] == said[:4]
    assert {x for states in found.values() for x in states["90% oil"].values()} == {1.0}


@pytest.mark.parametrize("name", ["SA8", "SA7", "SA1"])
def test_where_eusama_turns(name: str) -> None:
    (said,) = rows(rf"{name} \(\d+ mm\)")
    for length, cell in ((0.06, said[0]), (0.11, said[5])):
        assert f"{turning(load(name).with_(dead_length=length))} %" == cell


def test_the_wheel_load_at_the_longest_dead_length() -> None:
    found = rises(load("SA8").with_(dead_length=0.11))
    page = " ".join((DOCS / "inspection.md").read_text(encoding="utf-8").split())
    half, less = ([found[f"{level} {v} km/h pushes_oil"] for v in (30, 50)] for level in ("50%", "40%"))
    assert f"110 mm {half[0]:g} and {half[1]:g} % (30 and 50 km/h) are left" in page
    assert f"at 40 % it is {less[0]:g} and {less[1]:g} %" in page


@pytest.mark.parametrize(
    ("head", "changes", "level"),
    [("intact", 1.0, None), ("F-v curve x 0.75", 0.75, None), ("F-v curve x 0.5", 0.5, None), ("90 % oil", 1.0, 0.9)],
)
def test_the_plate_that_watches(head: str, changes: float, level: float | None) -> None:
    damper = load("SA8").with_(**scalar_factor(changes)) if level is None else condition(load("SA8"), level, 0)
    found = row(damper, 6.0)
    figures = [f"{found[name]:.2f}" for name in ("first", "largest", "growth", "force growth")]
    assert [*figures, f"{100 * found['off the plate']:.0f} %"] in rows(re.escape(head), "inspection_tiring.md")


@pytest.mark.parametrize("name", ["SA7", "SA8"])
def test_the_gas_of_a_leak_is_in_balance(name: str) -> None:
    """Gas is free or dissolved; only what is dissolved in the oil that leaks goes."""
    damper, steps = load(name), 20000
    p, d = damper.parameters, prepared(damper.parameters)
    oil, room, solubility = p.V_oil, reserve_gas(p, d), sum(SOLUBILITY) / 2
    filled = pressure = P_AMBIENT + d.F_0 / d.A_rod
    leak = 0.6 * p.V_oil / steps
    for _ in range(steps):
        gas = pressure * (room + solubility * oil) - pressure * solubility * leak
        oil, room = oil - leak, room + leak
        pressure = gas / (room + solubility * oil)
    share = (pressure - P_AMBIENT) / (filled - P_AMBIENT)
    assert gas_path.in_service(damper, 0.4) == pytest.approx(share, rel=1e-3)  # Euler, first order
    assert gas_path.in_service(damper, 1.0) == pytest.approx(1.0)


def test_the_wheel_load_along_the_loss_of_oil_and_gas(monkeypatch: pytest.MonkeyPatch) -> None:
    levels = rows("50 km/h", "open_choices.md")[0]
    monkeypatch.setattr(gas_path, "LEVELS", (0.6,))
    monkeypatch.setattr(gas_path, "SHARES", (1.0,))
    found = gas_path.rises(load("SA8"), load_car(), 50.0)
    for name in ("gas at 100%", "as in service"):
        cell = found[f"50 km/h, {name}"]["60%"]
        (said,) = rows(name.replace("%", " %"), "open_choices.md")
        assert said[levels.index("60 % oil")] == f"{sign(cell['least'])} to {sign(cell['most'])}"


def figures(table: str) -> dict[str, dict[str, str]]:
    """What a table of importers was made from."""
    lines, _, notes = table.partition("\n\n")
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines.splitlines()]
    found = {tool: dict(zip(rows[0][1:], cells, strict=True)) for tool, *cells in rows[2:]}
    for note in notes.splitlines():
        where, _, words = note.removeprefix("- ").partition(": ")
        whats, _, tool = where.partition(" in ")
        found[tool] |= dict.fromkeys(whats.split(" and "), REFUSED + words)
    return found


def test_the_page_has_the_table_of_importers() -> None:
    _, table, _ = parts(DOCS / "import.md", "importers")
    found = figures(table)
    assert as_table(found) == table
    assert all(tuple(cells) == COLUMNS for cells in found.values())
    for cell in (cell for cells in found.values() for cell in cells.values()):
        assert cell in ("", REFERENCE, NO_ERRORS) or cell.startswith(REFUSED) or 0 <= float(cell) < 1e-9


def test_the_command_writes_between_the_marks_only(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    cells = dict.fromkeys(COLUMNS, "1e-16") | {COLUMNS[-1]: f"{REFUSED}version 2.0, unknown"}
    monkeypatch.setitem(command.BENCHMARKS, "importers", lambda: {"tool 1.0": cells})
    page = tmp_path / "page.md"
    page.write_text("before\n<!-- table: importers -->\nold\n<!-- end of table -->\nafter\n", encoding="utf-8")
    run = CliRunner().invoke(command.app, ["importers", "--output", str(page)])
    assert run.exit_code == 0, run.output
    before, table, after = parts(page, "importers")
    assert (before, after) == ("before\n<!-- table: importers -->\n", "<!-- end of table -->\nafter\n")
    assert figures(table) == {"tool 1.0": cells}
    page.write_text("no marks\n", encoding="utf-8")
    run = CliRunner().invoke(command.app, ["importers", "--output", str(page)])
    assert (run.exit_code, page.read_text(encoding="utf-8")) == (2, "no marks\n")
    assert "the lines <!-- table: importers --> and <!-- end of table --> are missing" in run.output
