"""The command line: it does its job with status 0, or says why not in one line with status 2."""

import csv
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any, get_type_hints

import fmpy
import pytest
import typer
from typer.testing import CliRunner

from twintube import claims
from twintube.cli import app

RUNNER = CliRunner()


TOP: Any = typer.main.get_command(app)
COMMANDS = sorted([
    *(name for name, command in TOP.commands.items() if name != "paper" and not command.hidden),
    *(f"paper {name}" for name in TOP.commands["paper"].commands),
])  # fmt: skip


def has(command: Any, option: str) -> bool:
    """Whether a command has an option."""
    return any(option in parameter.opts for parameter in command.params)


@pytest.mark.parametrize("command", COMMANDS)
def test_help_is_for_a_person(command: str) -> None:
    run = RUNNER.invoke(app, [*command.split(), "-h"])
    assert run.exit_code == 0
    assert f"Example: twintube {command}" in run.output
    assert not re.search(r"<\w|None|PATH|TEXT|FLOAT", run.output)  # units and names, no types of Python


@pytest.mark.parametrize("group", [[], ["paper"]])
def test_commands_are_grouped_and_sorted_and_no_line_is_cut(group: list[str]) -> None:
    run = RUNNER.invoke(app, [*group, "--help"], env={"COLUMNS": "80"})
    sections = re.findall(r"^(\w[\w ]*):\n((?:  .*\n)+)", run.output, re.MULTILINE)
    titles = [title for title, _ in sections if title != "Options"]
    assert titles == (["Paper"] if group else ["Model and FMU", "Bench data", "Vehicle", "Paper"])
    found = []
    for title, body in sections:
        if title != "Options":
            rows = re.findall(r"^  (\S+) +(\S.*\.)$", body, re.MULTILINE)
            assert len(rows) == body.count("\n"), title  # every command has one whole line
            assert [name for name, _ in rows] == sorted(name for name, _ in rows)
            found += [name for name, _ in rows]
    shown = TOP.commands["paper"].commands if group else TOP.commands
    assert set(found) == {name for name, command in shown.items() if not command.hidden}
    assert len(found) <= 19


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("claims", "twintube paper claims"),
        ("reproduce", "twintube paper figures"),
        ("readings", "twintube paper readings"),
        ("calibrate", "twintube paper calibrate"),
        ("rig", "twintube paper rig"),
        ("ssv", "twintube fmu --ssv"),
        ("container", "twintube ssp --container"),
        ("sensitivity", "python -m benchmarks sensitivity"),
        ("car-sensitivity", "python -m benchmarks car_sensitivity"),
    ],
)
def test_a_former_command_runs_and_says_the_new_one(old: str, new: str) -> None:
    run = RUNNER.invoke(app, [old, "-h"])
    assert run.exit_code == 0 and "Usage: " in run.stdout
    assert run.stderr == f"'twintube {old}' is '{new}' now; the former name works until the next release\n"


def test_former_options_are_read_and_said(tmp_path: Path) -> None:
    for words, said in (
        (["inspect", "--with-preload", "--car", "none"], "twintube inspect: --with-preload is --gas-kept now"),
        (["drive", "--write=a.csv"], "twintube drive: --write is --output now"),
        (["fmu", "--parameters", "none.toml"], "twintube fmu: --parameters none.toml is just none.toml now"),
        (["demo", "--damper", "SA9"], "twintube demo: --damper SA9 is just SA9 now"),
        (["new-dataset", "--damper", "SA9", str(tmp_path / "x")], "twintube new-dataset: --damper SA9 is just SA9 now"),
        (["explore", "--parameters", "a.toml", "--parameters", "b.toml"], "--parameters b.toml is just b.toml now"),
    ):
        run = RUNNER.invoke(app, words)
        *former, error = run.stderr.splitlines()
        assert run.exit_code == 2 and error.startswith("error: ") and "No such" not in error, run.stderr
        assert any(said in line for line in former)
        assert not any(
            option in RUNNER.invoke(app, [words[0], "-h"]).output for option in said.split() if option == words[1]
        )
    missing = RUNNER.invoke(app, ["fmu", "--parameters"])
    assert missing.exit_code == 2 and "No such option: --parameters" in missing.stderr


def test_variables_are_shown_beside_the_dampers() -> None:
    assert RUNNER.invoke(app, ["dampers", "--variables"]).stdout == RUNNER.invoke(app, ["variables"]).stdout
    both = RUNNER.invoke(app, ["dampers", "SA8", "--variables"])
    assert both.exit_code == 2 and "--variables: are those of every damper, leave out SA8" in both.stderr


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--container", "--speed", "50"], "--speed: not with --container"),
        (["--step-ms", "2"], "--step-ms: only with --container"),
    ],
)
def test_options_of_the_other_output_are_refused(arguments: list[str], message: str) -> None:
    run = RUNNER.invoke(app, ["ssp", *arguments])
    assert run.exit_code == 2 and message in run.stderr


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["nonsense"], "error: No such command 'nonsense'; see "),
        (["--nope"], "error: No such option: --nope; see "),
        (["ride"], "error: Missing argument 'DAMPER'; see "),
        (["fmu", "--kind", "x"], "error: Invalid value for '--kind': 'x' is not one of 'native', 'python'; see "),
    ],
)
def test_a_wrong_command_line_is_answered_in_one_line(arguments: list[str], message: str) -> None:
    run = RUNNER.invoke(app, arguments)
    assert run.exit_code == 2
    assert run.stderr.startswith(message)
    assert run.stderr.count("\n") == 1


@pytest.mark.parametrize("option", ["--version", "--help"])
def test_help_imports_nothing_scientific(option: str) -> None:
    script = f"import sys\nfrom twintube.cli import app\napp(['{option}'], standalone_mode=False)\nprint(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    slow = {"numpy", "scipy", "pandas", "numba", "pint", "matplotlib", "fmpy", "tqdm", "rich", "pydantic"}
    assert not slow & set(done.stdout.splitlines()[-1].split())


@pytest.mark.parametrize(
    ("typed", "offered"),
    [
        ("simulate SA", {f"SA{i}" for i in range(1, 9)}),
        ("pap", {"paper"}),
        ("paper ", {"calibrate", "claims", "figures", "readings", "rig"}),
        ("ride SA8 --road-class ", set("ABCDE")),
        ("fmu --platform l", {"linux64"}),
        ("fmu --platform x", {"x86_64-linux", "x86_64-windows", "x86_64-darwin"}),
    ],
)
def test_the_shell_completes(typed: str, offered: set[str]) -> None:
    line = f"twintube {typed}"
    asked = {"_TWINTUBE_COMPLETE": "complete_bash", "COMP_WORDS": line, "COMP_CWORD": str(len(line.split(" ")) - 1)}
    run = RUNNER.invoke(app, [], prog_name="twintube", env=asked)
    assert set(run.output.split()) == offered


def test_the_values_in_the_help_are_those_of_the_library() -> None:
    from twintube import dampers
    from twintube.cli import fmu, options, ssp
    from twintube.dampers.freed_gas import WAYS
    from twintube.fmu import container
    from twintube.fmu.platforms import PLATFORMS, PLATFORMS_3, Fmi, Kind, Ssp
    from twintube.identification import METHODS
    from twintube.inspection import METHODS as INSPECTIONS
    from twintube.rig import signals
    from twintube.vehicle import cars, ride, road
    from twintube.vehicle.full.catalogue import MANEUVERS
    from twintube.vehicle.full.study import WORN

    assert options.dampers() == dampers.names()
    assert (tuple(PLATFORMS), tuple(PLATFORMS_3)) == (options.PLATFORMS, options.PLATFORMS_3)
    assert set(container.PLATFORMS) <= set(options.PLATFORMS)
    assert tuple(road.GD_N0) == options.ROADS
    assert tuple(sorted(path.stem for path in cars.FOLDER.glob("*.toml"))) == options.CARS
    assert tuple(WAYS) == options.FREED_GAS
    assert set(options.MANEUVERS) | {"table3"} == set(MANEUVERS)
    assert set(options.WORN) == set(WORN)
    assert tuple(INSPECTIONS) == options.INSPECTIONS
    assert tuple(METHODS) == options.SEARCHES
    assert (tuple(signals.STARTS), signals.START) == (options.STARTS, options.START)
    assert options.STEP_MS == 1e3 * ride.DT
    types = get_type_hints(fmu.fmu) | {"ssp": get_type_hints(ssp.ssp)["version"]}
    assert (types["kind"], types["fmi"], types["ssp"]) == (Kind, Fmi, Ssp)


def test_dampers_are_listed_and_shown(tmp_path: Path) -> None:
    *listed, meaning = RUNNER.invoke(app, ["dampers"]).output.splitlines()
    assert len(listed) == 8
    assert "chambers full down to 58.0% (51%-63%)" in listed[-1] and "(A_1 + A_2) l / 2" in meaning
    shown = RUNNER.invoke(app, ["dampers", "SA8"]).output
    assert re.search(r"dead_length = 0\.08 # m: .* 58\.0% of the intact oil", shown)
    (tmp_path / "copy.toml").write_text(shown)
    assert RUNNER.invoke(app, ["dampers", str(tmp_path / "copy.toml")]).output == shown


def test_simulate_a_block(tmp_path: Path) -> None:
    out = tmp_path / "new" / "loop.csv"
    run = RUNNER.invoke(
        app, ["simulate", "SA8", "--oil-level", "0.6", "--gas-lost", "--velocity", "1.0", "--output", str(out)]
    )
    assert run.exit_code == 0, run.output
    rows = list(csv.reader(out.open()))
    assert rows[0][:4] == ["time [s]", "stroke [m]", "velocity [m/s]", "force [N]"]
    assert len(rows) > 1000


@pytest.mark.parametrize("command", [name for name, command in TOP.commands.items() if has(command, "--gas-lost")])
def test_gas_may_be_a_share_wherever_it_may_be_lost(command: str) -> None:
    assert has(TOP.commands[command], "--gas")


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--gas", "0.4", "--gas-lost"], "--gas 0.4 and --gas-lost: give one of them"),
        (["--gas", "1", "--gas-kept"], "--gas 1 and --gas-kept: give one of them"),
        (["--gas", "40"], "--gas 40: must be a number from 0 to 1"),
        (["--gas", "nan"], "--gas nan: must be a number from 0 to 1"),
    ],
)
@pytest.mark.parametrize("command", ["simulate SA8", "ride SA8", "inspect SA8 --scatter 0", "fmu SA8"])
def test_a_share_of_the_gas_is_given_once_and_within_its_range(command: str, options: list[str], said: str) -> None:
    run = RUNNER.invoke(app, [*command.split(), *options])
    assert (run.exit_code, run.stderr) == (2, f"error: {said}\n")


def test_a_share_of_the_gas_lies_between_kept_and_lost(tmp_path: Path) -> None:
    dissipated = []
    for options in (["--gas-kept"], ["--gas", "0.4"], ["--gas-lost"]):
        arguments = ["simulate", "SA8", "--oil-level", "0.7", "--velocity", "1.572", "--output", str(tmp_path / "o.csv")]
        run = RUNNER.invoke(app, [*arguments, *options])
        assert run.exit_code == 0, run.output
        dissipated.append(float(re.findall(r"([\d.]+) J dissipated", run.output)[0]))
        (tmp_path / "o.csv").unlink()
    assert dissipated == sorted(dissipated, reverse=True)


def test_a_ride_on_cold_dampers(tmp_path: Path) -> None:
    """Both dampers are cold: stiffer, so that the intact one too lets the wheel load fluctuate in another way."""
    found = []
    for i, options in enumerate(([], ["--temperature", "23"], ["--temperature", "-20"])):
        file = tmp_path / f"{i}.json"
        run = RUNNER.invoke(app, ["ride", "SA8", "--oil-level", "0.7", "--seconds", "20", "--json", str(file), *options])
        assert run.exit_code == 0, run.output
        found.append(json.loads(file.read_text()))
    assert "SA8, 70 % oil, gas kept, -20 degC; freed gas" in run.output
    assert [each["temperature_degC"] for each in found] == [None, 23.0, -20.0]
    assert found[0]["intact"]["dlc"] == pytest.approx(found[1]["intact"]["dlc"], rel=1e-9)
    assert abs(found[2]["intact"]["dlc"] / found[0]["intact"]["dlc"] - 1.0) > 0.01
    refused = RUNNER.invoke(app, ["ride", "SA8", "--temperature", "-300"])
    assert (refused.exit_code, refused.stderr) == (
        2,
        "error: --temperature = -300 degC: must be a number from -123.15 to 226.85 degC\n",
    )


def test_simulate_a_record(tmp_path: Path) -> None:
    record = tmp_path / "in.csv"
    record.write_text("time [ms],stroke [mm]\n" + "".join(f"{i},{i * 0.5}\n" for i in range(50)))
    out = tmp_path / "out.csv"
    run = RUNNER.invoke(app, ["simulate", "SA8", "--record", str(record), "--output", str(out)])
    assert run.exit_code == 0, run.output
    rows = list(csv.DictReader(out.open()))
    assert float(rows[-1]["stroke [m]"]) == pytest.approx(0.0245)
    assert float(rows[-1]["velocity [m/s]"]) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time [s],stroke [mm]\n0,1\n1,x\n", "in.csv: row 3, column 'stroke [mm]': 'x' is not a finite number"),
        ("time [s],stroke [mm]\n0,1\n1,nan\n", "in.csv: row 3, column 'stroke [mm]': 'nan' is not a finite number"),
        ("time [s],stroke [mm]\n0,1\n0,2\n", "in.csv: row 3, column 'time [s]': 0 s is not after the row before"),
        ("time [s],stroke [N]\n0,1\n1,2\n", "in.csv: column 'stroke [N]': unit 'N' is not a unit of stroke"),
        (
            "time [s],strok [mm]\n0,1\n1,2\n",
            "in.csv: column 'stroke': no column 'stroke [mm]' among time [s], strok [mm], did you mean strok?",
        ),
        ("time [s],stroke [mm]\n0,1\n1,200\n", "sample 1: stroke = 0.2 m: must be a number from -0.1"),
        ("", "in.csv: the file is empty"),
    ],
)
def test_bad_records(tmp_path: Path, text: str, message: str) -> None:
    record = tmp_path / "in.csv"
    record.write_text(text)
    run = RUNNER.invoke(app, ["simulate", "SA8", "--record", str(record), "--output", str(tmp_path / "out.csv")])
    assert run.exit_code == 2
    assert message in run.stderr
    assert run.stderr.startswith("error: ")
    assert run.stderr.count("\n") == 1
    assert [p.name for p in tmp_path.iterdir()] == ["in.csv"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["simulate", "SA9"], "error: unknown damper SA9"),
        (["simulate", "SA8", "--oil-level", "1.7"], "error: SA8: oil_level = 1.7: must be a number from 0 to 1"),
        (["simulate", "SA8", "--velocity", "nan"], "error: velocity = nan m/s"),
        (["simulate", "SA8", "--amplitude-mm", "200"], "stroke = "),
        (
            ["paper", "claims", "--reading", "leaks=1"],
            "error: --reading leaks=1: must be NAME=NUMBER with a name of leak_carries_oil",
        ),
        (["paper", "figures", "--figure", "99"], "error: figure 99: must be one of 3, 5"),
        (["paper", "figures", "--processes", "0"], "error: processes = 0: must be at least 1"),
        (["paper", "figures", "--figure", "18", "--output", "/dev/null/x"], "error: "),
        (["identify", "nowhere"], "error: "),
        (["paper", "claims", "--reading", "foam_decays=7"], "reading.foam_decays = 7: must be a number from 0 to 1"),
    ],
)
def test_bad_arguments(arguments: list[str], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    run = RUNNER.invoke(app, arguments)
    assert run.exit_code == 2
    assert message in run.stderr
    assert list(tmp_path.iterdir()) == []


def test_unwritable_output(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    run = RUNNER.invoke(app, ["simulate", "SA8", "--output", str(tmp_path / "file" / "x.csv")])
    assert run.exit_code == 2
    assert run.stderr.startswith("error: ")


def test_claims_as_json(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(claims, "EVALUATORS", claims.EVALUATORS[:2])  # tests/claims evaluates all
    out = tmp_path / "claims.json"
    run = RUNNER.invoke(app, ["paper", "claims", "--json", str(out)])
    assert run.exit_code == 0, run.output
    found = json.loads(out.read_text())
    assert [c["id"] for c in found] == ["C1", "C2"]
    assert {"id", "holds", "figures", "needs"} <= set(found[0])
    assert "evidence: " in run.output


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["SA9"], "error: unknown damper SA9"),
        (["SA8", "--oil-level", "1.7"], "oil_level = 1.7: must be a number from 0 to 1"),
        (["SA8", "--platform", "vax"], "platform = vax: must be one of linux64, aarch64-linux, win64, darwin64"),
    ],
)
def test_build_fmu_bad_arguments(arguments: list[str], message: str, tmp_path: Path) -> None:
    run = RUNNER.invoke(app, ["fmu", *arguments, "--output", str(tmp_path)])
    assert run.exit_code == 2
    assert message in run.stderr
    assert list(tmp_path.iterdir()) == []


def test_build_fmu_of_a_users_own_damper(tmp_path: Path) -> None:
    mine = tmp_path / "mine.toml"
    mine.write_text(RUNNER.invoke(app, ["dampers", "SA8"]).output.replace('name = "SA8"', 'name = "My damper"'))
    run = RUNNER.invoke(app, ["fmu", str(mine), "--platform", fmpy.platform, "--output", str(tmp_path)])
    assert run.exit_code == 0, run.output
    assert (tmp_path / "twintube_My_damper.fmu").is_file()


def test_ride_says_when_the_damping_is_lost(tmp_path: Path) -> None:
    file = tmp_path / "ride.json"
    arguments = ["ride", "SA8", "--oil-level", "0.5", "--gas-lost", "--seconds", "30", "--json", str(file)]
    run = RUNNER.invoke(app, arguments)
    assert run.exit_code == 0, run.output
    found = json.loads(file.read_text())
    assert {"dlc", "dlc_window", "time_to_failure_s", "damping_work_J", "contact_loss_share"} <= set(found)
    assert found["dlc"] > 1.1 * found["intact"]["dlc"]
    assert found["time_to_failure_s"] is not None
    assert found["freed_gas"].startswith("dissolves")
    for option in (["--freed-gas", "stays"], ["--as-published"]):
        published = RUNNER.invoke(app, [*arguments, *option])
        assert published.exit_code == 0
        assert json.loads(file.read_text())["freed_gas"].startswith("stays")
    both = RUNNER.invoke(app, [*arguments, "--freed-gas", "limited", "--as-published"])
    assert both.exit_code == 2 and "give one of them" in both.stderr


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--road-class", "F"], "error: --road-class F: must be one of A, B, C, D, E"),
        (["--freed-gas", "x"], "error: --freed-gas x: must be one of stays, dissolves"),
        (["--car", "x"], "error: unknown car x: neither a file nor one of escort, passat_b8"),
        (["--oil-level", "2"], "error: SA8: oil_level = 2: must be a number from 0 to 1"),
    ],
)
def test_ride_answers_bad_input_with_one_line(arguments: list[str], message: str) -> None:
    run = RUNNER.invoke(app, ["ride", "SA8", *arguments])
    assert run.exit_code == 2
    assert run.stderr.startswith(message)
    assert run.stderr.count("\n") == 1
