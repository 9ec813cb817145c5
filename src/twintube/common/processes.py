"""Worker processes that end with their parent, also where it is killed."""

import os
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context, parent_process
from threading import Thread
from typing import Any

MOST = 61  # Windows waits for no more handles


def pool(
    workers: int | None = None, initializer: Callable[..., None] | None = None, arguments: tuple[Any, ...] = ()
) -> ProcessPoolExecutor:
    """A pool of at most `workers` processes (default: one for each core), started anew: forked threads would hang.

    Each worker calls `initializer(*arguments)` first, and ends as soon as the parent does.
    """
    count = min(workers or os.cpu_count() or 1, MOST)
    return ProcessPoolExecutor(count, get_context("spawn"), initializer=begin, initargs=(initializer, arguments))


def begin(initializer: Callable[..., None] | None, arguments: tuple[Any, ...]) -> None:
    """What a worker does first."""
    Thread(target=end_with_parent, daemon=True).start()
    if initializer is not None:
        initializer(*arguments)


def end_with_parent() -> None:
    """Wait for the end of the parent, then end this process."""
    parent = parent_process()
    if parent is not None:
        parent.join()  # the parent's end of a pipe closes, whatever it dies of
        os._exit(1)
