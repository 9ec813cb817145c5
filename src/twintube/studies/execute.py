"""A study computed on the cores of this machine or on a Dask cluster, and written to one Parquet file.

The cases go out in chunks and come back in the order of the grid, so that the file does not depend on who computed
what: equal versions on equal machines give equal bytes.
"""

from collections.abc import Callable, Generator, Sequence
from concurrent.futures import CancelledError
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing
from importlib import import_module
from itertools import islice
from os import cpu_count
from pathlib import Path
from threading import Thread
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from twintube.common.arrays import Array
from twintube.common.bars import Bar
from twintube.common.files import replacing
from twintube.common.processes import MOST, pool
from twintube.studies.cases import RESULTS, chunk, version_mark
from twintube.studies.definition import FIELDS, Study, StudyError
from twintube.version import __version__

ROW_GROUP = 65536
CHUNKS, LARGEST_CHUNK = 512, 200
CONNECTING = 30  # [s]
RETRIES = 3
SMALL = 2e7  # samples: some 3 s in one process
AHEAD = 16  # chunks for each process, because blocks take 2 to 50 ms
UNITS = {"work_J": "J", "work_relative": "1", "peak_rebound_N": "N", "peak_compression_N": "N"}
Span = tuple[int, int]
# From a study, a span of its cases and the version mark that its process must have, whose parameter is named `expected`.
Work = Callable[[Any, int, int, str], Any]


def run(
    study: Study, output: Path, *, processes: int | None = None, cluster: str | None = None, progress: bool = True
) -> int:
    """Compute a study and write it to the Parquet file `output`, whole or not at all; returns the number of rows.

    Args:
        study: what to compute.
        output: the file; one row per case and oscillation, cases in the order of the grid.
        processes: how many run on this machine; if None all cores, or one where starting the others would take longer.
        cluster: address of a Dask scheduler, e.g. `"tcp://10.0.0.1:8786"`, that computes instead of this machine.
        progress: show a bar on standard error.

    Raises:
        StudyError: a case failed, the workers are gone, or the cluster cannot be used.

    """
    if processes is not None and processes < 1:
        raise StudyError(f"processes = {processes}: must be at least 1")
    if output.is_dir():
        raise StudyError(f"{output} is a folder, not a file")
    size = min(LARGEST_CHUNK, max(1, len(study) // CHUNKS))
    spans = [(start, min(start + size, len(study))) for start in range(0, len(study), size)]
    if cluster is not None:
        parts = on_cluster(chunk, study, version_mark(), spans, cluster)
    else:
        count = processes or ((cpu_count() or 1) if study.samples > SMALL else 1)
        parts = locally(chunk, study, version_mark(), spans, count)
    rows = 0
    with (
        replacing(output) as part,
        closing(parts),
        pq.ParquetWriter(part, schema(study), compression="zstd") as writer,
        Bar(total=len(study), unit="case", leave=False, disable=None if progress else True) as bar,
    ):
        waiting: list[pa.Table] = []
        for span, values in zip(spans, parts, strict=True):
            waiting.append(table(study, span, values))
            rows += waiting[-1].num_rows
            bar.update(span[1] - span[0])
            if sum(part_table.num_rows for part_table in waiting) >= ROW_GROUP:
                joined = pa.concat_tables(waiting)
                writer.write_table(joined.slice(0, ROW_GROUP).combine_chunks(), row_group_size=ROW_GROUP)
                waiting = [joined.slice(ROW_GROUP)]
        if waiting:
            writer.write_table(pa.concat_tables(waiting).combine_chunks(), row_group_size=ROW_GROUP)
    return rows


def locally(work: Work, study: Any, mark: str, spans: Sequence[Span], processes: int) -> Generator[Any, None, None]:
    """What `work(study, start, stop, mark)` returns for each span, in order, from processes of this machine."""
    if min(processes, len(spans)) == 1:
        yield from (work(study, start, stop, mark) for start, stop in spans)
        return
    count = min(processes, len(spans), MOST)
    with pool(count, keep, (work, study, mark)) as workers:
        try:
            # Not `map`: it would keep all results of a large study in memory.
            todo = iter(spans)
            running = [workers.submit(kept_work, *span) for span in islice(todo, AHEAD * count)]
            while running:
                yield running.pop(0).result()
                running += [workers.submit(kept_work, *span) for span in islice(todo, 1)]
        except BrokenProcessPool as error:
            raise StudyError("a process of this machine was killed (out of memory?): nothing is written") from error
        finally:
            workers.shutdown(wait=True, cancel_futures=True)


KEPT: dict[str, tuple[Work, Any, str]] = {}


def keep(work: Work, study: Any, mark: str) -> None:
    """What a process of `locally` is given once."""
    KEPT["study"] = (work, study, mark)


def kept_work(start: int, stop: int) -> Any:
    """The work on the study that this process was given."""
    work, study, mark = KEPT["study"]
    return work(study, start, stop, mark)


def unchanged(study: Any) -> Any:
    """The study itself: a task, and no scattered datum, because a lost task's result is computed again."""
    return study


def on_cluster(work: Work, study: Any, mark: str, spans: Sequence[Span], address: str) -> Generator[Any, None, None]:
    """As `locally`, from the workers of a Dask scheduler; what a killed worker had is done again."""
    try:
        dask: Any = import_module("distributed")
    except ImportError as error:
        raise StudyError(f"a cluster needs Dask ({error}): pip install 'twintube[cluster]'") from error
    with connected(dask, address) as client:
        try:
            client.wait_for_workers(1, timeout=CONNECTING)
        except TimeoutError as error:
            raise StudyError(f"the Dask scheduler at {address} has no workers after {CONNECTING} s") from error
        shared = client.submit(unchanged, study, pure=True)
        starts, stops = zip(*spans, strict=True)
        options = {"expected": mark, "pure": True, "retries": RETRIES}
        futures = client.map(work, [shared] * len(spans), starts, stops, **options)
        futures.reverse()
        try:
            while futures:
                yield futures.pop().result()  # and the cluster forgets it
        except dask.KilledWorker as error:
            raise StudyError(f"a chunk of cases went down with every worker that tried it: {error}") from error
        except (CancelledError, ImportError, OSError, RuntimeError) as error:
            raise StudyError(f"the cluster at {address} failed: {' '.join(str(error).split())}") from error


def connected(dask: Any, address: str) -> Any:
    """A client of the scheduler; raises StudyError after CONNECTING seconds.

    In a thread, because Dask waits without limit for a server that accepts the connection and says nothing.
    """
    outcome: list[Any] = []

    def connect() -> None:
        try:
            outcome.append(dask.Client(address, timeout=CONNECTING, set_as_default=False))
        except Exception as error:
            outcome.append(error)

    thread = Thread(target=connect, daemon=True)
    thread.start()
    thread.join(CONNECTING + 1)
    if not outcome:
        raise StudyError(f"no Dask scheduler at {address}: it accepts the connection and does not answer for {CONNECTING} s")
    if isinstance(outcome[0], Exception):
        raise StudyError(f"no Dask scheduler at {address}: {' '.join(str(outcome[0]).split())}") from outcome[0]
    return outcome[0]


def schema(study: Study) -> pa.Schema:
    """Columns with their units, and what the file was made from; no date, so that equal studies give equal files."""
    columns = [
        column("case", pa.int64(), "1"),
        column("damper", pa.string(), "1"),
        column("signal", pa.string(), "1"),
        column("velocity", pa.float64(), "m/s"),
        column("amplitude", pa.float64(), "m"),
        *(
            column(name, pa.int64() if FIELDS[name].metadata["integer"] else pa.float64(), FIELDS[name].metadata["unit"])
            for name in study.parameters
        ),
        column("oil_level", pa.float64(), "1"),
        column("gas_preload", pa.float64(), "1"),
        column("variant", pa.int64(), "1"),
        column("oscillation", pa.int64(), "1"),
        *(column(name, pa.float64(), UNITS[name]) for name in RESULTS),
    ]
    about = {"twintube.version": __version__, "twintube.fingerprint": version_mark(), "twintube.study": study.text}
    return pa.schema(columns, metadata=about)


def definition_of(output: Path) -> str | None:
    """The definition of the study that a file is the result of; None where it is none."""
    try:
        about = pq.read_schema(output).metadata or {}
    except (OSError, pa.ArrowException):
        return None
    text: bytes | None = about.get(b"twintube.study")
    return None if text is None else text.decode()


def column(name: str, kind: pa.DataType, unit: str) -> pa.Field:
    """A column that carries its unit."""
    return pa.field(name, kind, metadata={"unit": unit})


def table(study: Study, span: Span, values: Array) -> pa.Table:
    """The rows of a chunk: what each case was, and what came out."""
    cases = [(number, study.case(number)) for number in range(*span)]
    each = [(number, case, oscillation) for number, case in cases for oscillation in study.rows(case)]
    signals = [study.signals[case.signal] for _, case, _ in each]
    columns = [
        [number for number, _, _ in each],
        [study.dampers[case.damper].name for _, case, _ in each],
        [signal.name for signal in signals],
        [None if np.isnan(signal.velocity) else signal.velocity for signal in signals],
        [None if np.isnan(signal.amplitude) else signal.amplitude for signal in signals],
        *([case.values[i] for _, case, _ in each] for i in range(len(study.parameters))),
        [case.oil_level for _, case, _ in each],
        [case.gas_preload for _, case, _ in each],
        [case.variant for _, case, _ in each],
        [oscillation for _, _, oscillation in each],
        *values.T,
    ]
    described = schema(study)
    arrays = [pa.array(values, kind) for values, kind in zip(columns, described.types, strict=True)]
    return pa.Table.from_arrays(arrays, schema=described)
