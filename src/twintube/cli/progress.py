"""What a long command says while it works."""

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import typer

EVERY = 15.0  # [s] after which it says again what it is doing


@contextmanager
def progress() -> Iterator[Callable[[str], None]]:
    """Says on standard error what is being done, with the seconds since the beginning, and that it still is."""
    began = time.monotonic()
    doing, changed, ended = "", threading.Event(), threading.Event()

    def line(text: str) -> None:
        typer.echo(f"{time.monotonic() - began:4.0f} s  {text}", err=True)

    def say(text: str) -> None:
        nonlocal doing
        doing = text
        changed.set()
        line(text)

    def watch() -> None:
        while not ended.is_set():
            if not changed.wait(EVERY) and doing:
                line(f"still {doing}")
            changed.clear()

    watching = threading.Thread(target=watch, daemon=True)
    watching.start()
    try:
        yield say
    finally:
        ended.set()
        changed.set()
        watching.join()
