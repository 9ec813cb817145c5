"""The command that writes the explorer."""

from pathlib import Path
from typing import Annotated

import typer

from twintube.cli.base import MODEL, app
from twintube.cli.outputs import keep_other
from twintube.common.files import write_text


@app.command(rich_help_panel=MODEL, epilog="Example: twintube explore --output explorer.html", former={"--parameters": ""})
def explore(
    files: Annotated[
        list[Path] | None, typer.Argument(metavar="DAMPER", help="Parameter files (TOML) beside SA1 to SA8.")
    ] = None,
    output: Annotated[Path, typer.Option(metavar="FILE", help="HTML file.")] = Path("explorer.html"),
) -> None:
    """Write a page that runs the damper in a browser.

    It shows chambers, loops, work and wheel load, live and against intact. It needs no network. What it computes is the
    native FMU, compiled for browsers.
    """
    from twintube.dampers import load
    from twintube.explorer.assemble import page

    if output.is_dir():
        raise IsADirectoryError(f"{output}: is a folder, must be a file")
    text = page([load(file) for file in files or []])
    keep_other(output, text.encode())
    write_text(output, text)
    typer.echo(f"{output}: {len(text.encode()) // 1000} kB; open it in a browser")
