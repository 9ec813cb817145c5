"""The examples of README.md, CONTRIBUTING.md and docs/ are run as printed, page by page, in a folder of their own.

    <!-- not run: reason -->   before a block that cannot be run here
    <!-- file: NAME -->        before a block that is the text of a file, which later blocks of the page may use
    <!-- output -->            before lines that the block above it prints; ... stands for anything

Commands within the text are not run, but their names and options are checked.
"""

import io
import os
import re
import shlex
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import typer
import yaml
from typer.testing import CliRunner

from twintube.cli import app

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
RUN_ELSEWHERE = {"main": "tests/vehicle", "test": ".ci/run"}  # marks of the README's two commands
LANGUAGES = {"sh", "python", "toml", "text", "xml", "lua", "json", "yaml", ""}
OTHERS = {"fmpy": ["-m", "fmpy"], "python": []}  # commands beside `twintube`, run by this Python


@dataclass(frozen=True)
class Block:
    """A fenced block with the comment in the line before it."""

    page: str
    line: int
    language: str
    mark: str
    text: str


def blocks(path: Path) -> Iterator[Block]:
    lines = path.read_text(encoding="utf-8").splitlines()
    begin, before = None, ""
    for i, line in enumerate(lines):
        if begin is None and line.startswith("```"):
            begin = i
            before = next((text for text in reversed(lines[:i]) if text.strip()), "")
        elif begin is not None and line.startswith("```"):
            mark = re.fullmatch(r"<!-- (.*) -->", before)
            language = lines[begin].removeprefix("```").strip()
            yield Block(path.name, begin + 1, language, mark[1] if mark else "", "\n".join(lines[begin + 1 : i]) + "\n")
            begin = None
    assert begin is None, f"{path.name}: line {begin}: a block without end"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> Path:
    """An empty working folder."""
    monkeypatch.chdir(tmp_path)
    if "twintube explore" in request.node.callspec.params["page"].read_text(encoding="utf-8"):
        request.getfixturevalue("explorer_module")
    return tmp_path


def run_shell(block: Block) -> str:
    """Run a block, a command a line: `twintube`, fmpy, or a Python file that the page has written. Returns what it prints."""
    printed = ""
    for line in block.text.replace("\\\n", " ").splitlines():
        words = shlex.split(line, comments=True)
        if not words:
            continue
        where = f"{block.page}: line {block.line}: {line}"
        if words[0] in OTHERS and (words[0] != "python" or Path(words[1]).is_file()):
            command = [sys.executable, *OTHERS[words[0]], *words[1:]]
            run = subprocess.run(command, capture_output=True, text=True, check=False)
            assert run.returncode == 0, f"{where}\n{run.stdout}\n{run.stderr}"
            printed += run.stdout
            continue
        assert words[0] == "twintube", f"mark the block as not run, or use twintube: {where}"
        target = words[words.index(">") + 1] if ">" in words else None
        words = words[: words.index(">")] if target else words
        done = CliRunner().invoke(app, words[1:])
        assert done.exit_code == 0, f"{where}\n{done.output}\n{done.exception!r}"
        if target:
            Path(target).write_text(done.stdout, encoding="utf-8")
        printed += done.output
    return printed


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_blocks_of_a_page_run(page: Path, folder: Path) -> None:
    printed = ""
    for block in blocks(page):
        where = f"{block.page}: line {block.line}"
        kind, _, detail = block.mark.partition(": ")
        assert block.language in LANGUAGES, where
        if kind == "not run":
            assert detail.strip(), f"{where}: a reason is missing"
        elif kind == "file":
            (folder / detail).parent.mkdir(parents=True, exist_ok=True)
            (folder / detail).write_text(block.text, encoding="utf-8")
        elif block.language == "sh" and kind not in RUN_ELSEWHERE:
            printed = run_shell(block)
        elif block.language == "python":
            with redirect_stdout(io.StringIO()) as out:
                exec(compile(block.text, f"{page}:{block.line}", "exec"), {"__name__": "__main__"})
            printed = out.getvalue()
        elif kind == "output":
            for line in block.text.splitlines():
                assert re.search(".*".join(map(re.escape, line.split("..."))), printed), f"{where}: {line}\n{printed}"
        if block.language == "toml":
            tomllib.loads(block.text)
    assert Path.cwd() == folder


def test_the_workflow_runs_the_commands_of_its_page() -> None:
    """What the page on CI tries by hand, which the test above runs, is what its workflow does."""
    written = list(blocks(ROOT / "docs" / "ci.md"))
    (workflow,) = (yaml.safe_load(block.text) for block in written if block.language == "yaml")
    (steps,) = (job["steps"] for job in workflow["jobs"].values())
    assert all(("run" in step) != ("uses" in step) for step in steps)
    tried = [line for block in written if block.language == "sh" for line in block.text.splitlines()]
    assert [step["run"] for step in steps if "run" in step and not step["run"].startswith("pip ")] == tried


def inline(page: Path) -> Iterator[str]:
    """The commands in the running text: `twintube ...` between backquotes."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    yield from re.findall(r"`(twintube [^`]+)`", text)


def check_options(words: list[str], where: str) -> None:
    """The words behind `twintube` name a command and options of it."""
    command: Any = typer.main.get_command(app)
    for word in words:
        if not hasattr(command, "commands") or word.startswith("-"):
            break
        assert word in command.commands, where
        command = command.commands[word]
    known = {name for parameter in command.params for name in (*parameter.opts, *parameter.secondary_opts)}
    options = {word.split("=")[0] for word in words if word.startswith("-") and not word.lstrip("-")[:1].isdigit()}
    assert options <= known | {"-h", "--help"}, where


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_commands_in_the_text_exist_with_their_options(page: Path) -> None:
    for text in inline(page):
        words = shlex.split(text.replace("[", "").replace("]", ""), comments=True)[1:]
        check_options(words, f"{page.name}: {text}")


def test_every_page_is_reached_from_the_readme() -> None:
    linked: set[str] = set()
    waiting = ["README.md"]
    while waiting:
        page = waiting.pop()
        linked.add(page)
        text = (ROOT / page).read_text(encoding="utf-8")
        for target in re.findall(r"\]\(([^)#:]+\.md)(?:#[\w-]*)?\)", text):
            path = os.path.relpath((ROOT / page).parent / target, ROOT)
            assert (ROOT / path).is_file(), f"{page} links to {target}"
            if path not in linked:
                waiting.append(path)
    assert {str(path.relative_to(ROOT)) for path in PAGES} <= linked


def test_links_to_sections_lead_somewhere() -> None:
    def anchors(path: Path) -> set[str]:
        titles = re.findall(r"^#+ (.+)$", path.read_text(encoding="utf-8"), re.MULTILINE)
        return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}

    for page in PAGES:
        for target, section in re.findall(r"\]\(([^)#:]*)#([\w-]+)\)", page.read_text(encoding="utf-8")):
            assert section in anchors(page.parent / target if target else page), f"{page.name}: {target}#{section}"
