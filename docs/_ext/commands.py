"""Directives about the command `twintube`: its options, and the explorer page where the command exists.

`command-options` is a section per command: what it does, arguments, options, an example. `explorer` is a link to the
page that `twintube explore` writes while the documentation is built.
"""

import shutil
from pathlib import Path
from typing import Any

from command_names import known
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.util.docutils import SphinxDirective
from typer.testing import CliRunner

from twintube.cli import app as cli

EXPLORER = "explorer_page/explorer.html"
LOG = logging.getLogger(__name__)


def spelled(parameter: Any) -> str:
    """How an argument or option is written."""
    if parameter.param_type_name == "argument":
        return str(parameter.metavar)
    names = ", ".join((*parameter.opts, *parameter.secondary_opts))
    return names if parameter.is_flag else f"{names} {parameter.metavar}"


def default(parameter: Any) -> str:
    """The value of an option that is not given, where there is one to show."""
    value = parameter.default
    plain = isinstance(value, str | int | float | Path) and not isinstance(value, bool)
    return f" Default: {value}." if plain else ""


class CommandOptions(SphinxDirective):
    """All commands with their options, read off the program."""

    def run(self) -> list[nodes.Node]:
        """A section per command."""
        return [self.section(name, command) for name, command in known().items()]

    def section(self, name: str, command: Any) -> nodes.section:
        """One command."""
        section = nodes.section("", nodes.title(name, name), ids=[f"command-{name.replace(' ', '-')}"], names=[name])
        section += nodes.paragraph("", " ".join((command.help or "").split()))
        items = nodes.definition_list(classes=["options"])
        for parameter in command.params:
            if parameter.name == "help":
                continue
            text = f"{parameter.help or ''}{default(parameter)}"
            term = nodes.term("", "", nodes.literal("", spelled(parameter)))
            items += nodes.definition_list_item("", term, nodes.definition("", nodes.paragraph("", text)))
        if len(items):
            section += items
        if command.epilog:
            example = command.epilog.removeprefix("Example: ")
            section += nodes.literal_block(example, example, language="sh")
        return section


class Explorer(SphinxDirective):
    """A paragraph with a link, empty without the command."""

    def run(self) -> list[nodes.Node]:
        """The link."""
        if "explore" not in known():
            return []
        link = nodes.reference("", "Explorer", refuri=EXPLORER, internal=True)
        return [nodes.paragraph("", "", link, nodes.Text(": the model in the browser, in a single page."))]


def write_explorer(app: Sphinx, error: Exception | None) -> None:
    """Write the explorer's page beside the others, if this version has the command."""
    if error or app.builder.format != "html" or "explore" not in known():
        return
    target = Path(app.outdir) / EXPLORER
    shutil.rmtree(target.parent, ignore_errors=True)
    target.parent.mkdir()
    done = CliRunner().invoke(cli, ["explore", "--output", str(target)])
    if done.exit_code != 0 or not target.is_file():
        LOG.warning("twintube explore: %s", done.output or done.exception)


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directives."""
    app.add_directive("command-options", CommandOptions)
    app.add_directive("explorer", Explorer)
    app.connect("build-finished", write_explorer)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
