"""What files say is shown harmlessly: on the terminal, in pictures, in messages."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from tests.data.conftest import good
from twintube import __version__
from twintube.cli import app
from twintube.common.reading import ReadError, read_toml
from twintube.common.words import LONGEST, listed, printable, shown
from twintube.dampers import ParameterError, load, to_toml
from twintube.dampers.quantity import quantity
from twintube.data import read_motion

RUNNER = CliRunner()


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("\x1b[31mred", "\\x1b[31mred"),
        ("a\0b\rc\x7f", "a\\x00b\\rc\\x7f"),
        ("\u202etxt", "\\u202etxt"),
        ("\u2028", "\\u2028"),
        ("\ud800", "\\ud800"),
        ("Prüfstand µm\n\tzwei", "Prüfstand µm\n\tzwei"),
    ],
)
def test_control_characters_are_written_out(text: str, printed: str) -> None:
    assert printable(text) == printed


def test_long_texts_are_cut() -> None:
    assert len(printable("x" * 10 * LONGEST)) < LONGEST + 50
    assert len(shown(["x" * 1000] * 1000)) < 1000
    assert shown(16**5000) == "a huge integer"
    assert listed("abcdef", 3) == "a, b, c and 3 more"


def test_a_dollar_in_a_name_is_not_a_formula() -> None:
    from twintube.report.common import style

    figure, axes = style.canvas()
    names = ["price $5", "a$b_$c^$", "$\\frac{$"]
    axes[0, 0].set_yticks(range(3), [style.plain(name) for name in names])
    for name in names:
        style.title(axes[0, 0], style.plain(name))
        assert style.png(figure).startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("29.8 mm", "m", 0.0298),
        ("1 inch", "m", 0.0254),
        ("2 in", "m", 0.0508),
        ("10 lbf", "N", 44.4822161526),
        ("70 N.s/m", "N*s/m", 70.0),
        ("70 N·s/m", "N*s/m", 70.0),
        ("70 N s/m", "N*s/m", 70.0),
        ("0.2 N/(mm/s)", "N*s/m", 200.0),
        ("273 cm^3", "m3", 0.000273),
        ("273 cm³", "m3", 0.000273),
        ("2 m**-1", "1/m", 2.0),
        ("60 %", "1", 0.6),
        ("-1.5e-3m", "m", -0.0015),
    ],
)
def test_units_of_engineers(text: str, unit: str, value: float) -> None:
    assert quantity(text, unit) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    "text", ["mm + 1 mm", "9**9**9 m", "1/0 m", "29,8 mm", "2 3 mm", "1 mm**99", "1 m**2**2", "1 m)", "m", ""]
)
def test_arithmetic_is_not_a_quantity(text: str) -> None:
    with pytest.raises(ValueError, match="is not a quantity in m"):
        quantity(text, "m")


def test_damper_keeps_integers_and_takes_no_fraction_of_a_switch() -> None:
    with pytest.raises(ParameterError, match=r"venting = 0\.5: must be an integer"):
        load("SA8").with_(venting=0.5)
    with pytest.raises(ParameterError, match="venting = inf: must be an integer"):
        load("SA8").with_(venting=float("inf"))


def test_a_byte_order_mark_is_not_part_of_toml(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text("\ufeff" + to_toml(load("SA8")), encoding="utf-8")
    assert load(tmp_path / "mine.toml").parameters == load("SA8").parameters
    with pytest.raises(ReadError, match="it is a folder"):
        read_toml(tmp_path)


def test_the_version() -> None:
    run = RUNNER.invoke(app, ["--version"])
    assert (run.exit_code, run.output) == (0, f"twintube {__version__}\n")


def test_an_output_folder_is_made_in_a_folder_that_exists(tmp_path: Path) -> None:
    path = tmp_path / "new" / "a.csv"
    assert RUNNER.invoke(app, ["simulate", "SA8", "--velocity", "1", "--output", str(path)]).exit_code == 0
    assert path.is_file()


@pytest.mark.parametrize("ending", [".csv", ".parquet", ".tsv"])
def test_a_simulated_record_may_have_any_format_of_a_dataset(tmp_path: Path, ending: str) -> None:
    columns = {name: values for name, values in good().items() if name != "force [N]"}
    path = tmp_path / f"a{ending}"
    if ending == ".parquet":
        import pyarrow as pa
        import pyarrow.parquet as pq

        pq.write_table(pa.table(columns), path)
    else:
        sign = {".csv": ",", ".tsv": "\t"}[ending]
        rows = [
            sign.join(columns),
            *(sign.join(f"{x!r}" for x in map(float, row)) for row in zip(*columns.values(), strict=True)),
        ]
        path.write_text("\n".join(rows))
    time, stroke, velocity = read_motion(path)
    assert time == pytest.approx(columns["time [s]"])
    assert stroke == pytest.approx(columns["stroke [mm]"] / 1000)
    assert velocity == pytest.approx(columns["velocity [mm/s]"] / 1000)
