"""No command replaces the result of another input unasked, and names tell a damper's states apart."""

import json
from itertools import islice
from pathlib import Path
from types import SimpleNamespace

import fmpy
import pytest
from typer.testing import CliRunner, Result

from twintube.cli import app
from twintube.cli.outputs import MARK
from twintube.dampers import load, to_toml
from twintube.engine.simulate import InputError
from twintube.fmu.description import model_name
from twintube.vehicle.plan import plan


@pytest.fixture(autouse=True)
def in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def run(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


def refused(done: Result, *words: str) -> None:
    assert done.exit_code == 2, done.output
    assert done.stderr.count("\n") == 1
    assert all(word in done.stderr for word in words), done.stderr


@pytest.mark.parametrize(
    ("command", "first", "second", "file"),
    [
        (["simulate", "--velocity", "2"], ["SA8"], ["SA1"], "simulation.csv"),
        (["fmu", "--ssv"], ["SA8"], ["SA8", "--gas-lost"], "parameters.ssv"),
        (["study"], ["one.toml"], ["two.toml"], "study.parquet"),
    ],
)
def test_a_file_at_its_default_place_is_replaced_by_the_same_result_only(
    command: list[str], first: list[str], second: list[str], file: str
) -> None:
    for name, level in (("one", 0.5), ("two", 0.6)):
        text = f'dampers = "SA8"\nvelocity = 2.0\noscillations = 1\noil_level = {level}\n'
        Path(f"{name}.toml").write_text(text)
    assert run(*command, *first).exit_code == 0
    content = Path(file).read_bytes()
    assert run(*command, *first).exit_code == 0
    refused(run(*command, *second), f"{file} holds another result", f"--output {file}")
    assert Path(file).read_bytes() == content
    assert run(*command, *second, "--output", file).exit_code == 0
    assert Path(file).read_bytes() != content


def test_fmus_of_a_damper_intact_worn_and_extended_lie_in_one_folder() -> None:
    extended = load("SA8").with_(fade_kelvin=0.01)
    Path("extended.toml").write_text(to_toml(extended).replace('name = "SA8"', 'name = "SA8-extended"'))
    Path("mine.toml").write_text(to_toml(load("SA8").with_(S_PV=0.4)))
    here = ["--platform", fmpy.platform]
    for arguments in (["SA8"], ["SA8", "--oil-level", "0.56", "--gas-lost"], ["extended.toml"]):
        assert run("fmu", *arguments, *here).exit_code == 0
    built = {path.stem: fmpy.read_model_description(str(path)) for path in Path().glob("*.fmu")}
    assert set(built) == {"twintube_SA8", "twintube_SA8_oil_56_no_gas", "twintube_SA8_extended"}
    assert all(description.modelName == name for name, description in built.items())
    assert all(description.coSimulation.modelIdentifier == name for name, description in built.items())
    assert run("fmu", "SA8", *here).exit_code == 0
    refused(run("fmu", "mine.toml", *here), "twintube_SA8.fmu holds another result")
    assert run("fmu", "mine.toml", *here, "--output", "twintube_SA8.fmu").exit_code == 0


def test_the_model_name_says_the_state() -> None:
    damper = load("SA8")
    worn = damper.with_(oil_level=0.56044, gas_preload=0)
    names = [damper, worn, damper.with_(gas_preload=0), load("SA8", as_published=True), damper.with_(displaced_share=1.0)]
    assert [model_name(each) for each in names] == [
        "twintube_SA8",
        "twintube_SA8_oil_56_044_no_gas",
        "twintube_SA8_no_gas",
        "twintube_SA8_as_published",
        "twintube_SA8",  # a way of its own: its file has a name of its own
    ]


@pytest.mark.parametrize("command", ["diagnose", "identify"])
def test_a_folder_keeps_the_answer_to_another_dataset(command: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def computing(*arguments: object, **options: object) -> None:
        raise InputError("it computes")

    monkeypatch.setattr("twintube.diagnosis.diagnose", computing)
    monkeypatch.setattr("twintube.identification.identify_dataset", computing)
    for name in ("first", "second"):
        assert run("example", name).exit_code == 0
    output, main = {"diagnose": ("diagnosis", "diagnosis.json"), "identify": ("identified", "identification.json")}[command]
    assert run(command, "first").stderr.endswith("error: it computes\n")
    Path(output).mkdir(exist_ok=True)
    (Path(output) / main).write_text("{}")
    refused(run(command, "first"), f"{output} holds a result") if command == "diagnose" else None
    made_from = {"command": command, "dataset": str(Path("first").resolve())}
    (Path(output) / MARK).write_text(json.dumps(made_from))
    assert run(command, "first").stderr.endswith("error: it computes\n")
    refused(run(command, "second"), f"{output} holds a result made from dataset =", "first", "another folder with --output")
    assert (Path(output) / main).read_text() == "{}"
    assert run(command, "second", "--output", "elsewhere").stderr.endswith("error: it computes\n")


def test_a_folder_says_which_command_of_a_group_made_it(monkeypatch: pytest.MonkeyPatch) -> None:
    made = SimpleNamespace(page=Path("out/index.html"), pictures=())
    monkeypatch.setattr("twintube.report.paper.reproduce.reproduce", lambda *arguments, **options: made)
    assert run("paper", "figures", "--output", "out").exit_code == 0
    assert json.loads((Path("out") / MARK).read_text())["command"] == "paper figures"


def test_an_interrupted_identification_goes_on_and_no_other_takes_its_journal(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*arguments: object, **options: object) -> None:
        raise InputError("interrupted")

    monkeypatch.setattr("twintube.identification.identify_dataset", interrupted)
    for name in ("first", "second"):
        assert run("example", name).exit_code == 0
    assert run("identify", "first").stderr.endswith("error: interrupted\n")
    assert Path("identified/journal").is_dir()
    assert run("identify", "first", "--quick").stderr.endswith("error: interrupted\n")
    refused(run("identify", "second"), "identified holds a result made from dataset =", "first")


def test_the_excitations_of_another_damper_stay_and_the_fmu_reads_those_made_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the first two signals; tests/rig writes them all."""
    monkeypatch.setattr("twintube.vehicle.plan.plan", lambda *arguments: islice(plan(*arguments), 2))
    assert run("paper", "rig", "SA8", "--for-fmu").exit_code == 0
    assert run("paper", "rig", "SA8", "--for-fmu").exit_code == 0
    refused(run("paper", "rig", "SA1", "--for-fmu"), "rig holds a result made from damper = SA8")
    head, first = Path("rig/01_quasi_static.csv").read_text().splitlines()[:2]
    assert head == "time,stroke,velocity"
    assert abs(float(first.split(",")[1])) < 0.1  # m


def test_what_simulate_writes_for_the_fmu_drives_it(sa8_native: Path) -> None:
    from fmpy.util import read_csv

    assert run("simulate", "SA8", "--for-fmu", "--velocity", "1").exit_code == 0
    table = read_csv("simulation.csv")
    result = fmpy.simulate_fmu(str(sa8_native), input=table, stop_time=1.0, output_interval=1e-3, output=["force"])
    found = result["force"]
    expected = table["force"][: len(found)]
    apart = abs(found - [expected[abs(table["time"] - t).argmin()] for t in result["time"]])
    assert apart.max() < 0.05 * abs(table["force"]).max()
