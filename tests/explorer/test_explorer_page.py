"""The command and its file: one page that needs nothing else."""

import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

from twintube.cli import app
from twintube.native import units

LARGEST = 500_000  # bytes


def test_the_page_is_one_file_without_a_network(explorer: Path) -> None:
    text = explorer.read_text(encoding="utf-8")
    assert len(text.encode()) <= LARGEST
    assert not re.search(r"""<(?:script|link|img|iframe)[^>]*\b(?:src|href)\s*=\s*["'](?!data:)""", text)
    assert not re.search(r"\beval\(|\bnew Function\b|\bfetch\(|XMLHttpRequest|@import", text)
    assert "default-src 'none'" in text
    assert "The MIT License (MIT)" in text and "Leon Sorokin" in text  # of the plotting library
    assert text.count("</script>") == text.count("<script") == 4  # a damper's name ends none


@pytest.mark.parametrize(("arguments", "message"), [
    (["none.toml"], "neither a file nor one of"),
    (["--output", "."], "is a folder, must be a file"),
    (["--output", "no/such/folder.html"], "does not exist"),
])  # fmt: skip
def test_bad_input_is_answered_with_one_line(
    arguments: list[str], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(app, ["explore", *arguments])
    assert done.exit_code == 2 and message in done.stderr and len(done.stderr.splitlines()) == 1
    assert not list(tmp_path.iterdir())


def test_without_the_module_the_command_says_how_to_make_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(units, "LIBRARIES", tmp_path)
    done = CliRunner().invoke(app, ["explore", "--output", str(tmp_path / "explorer.html")])
    assert done.exit_code == 2
    assert done.stderr == "error: no library for wasm32-wasi: `python -m twintube.native wasm32-wasi` makes it\n"
