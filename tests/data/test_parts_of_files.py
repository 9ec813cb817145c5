"""Parts of MATLAB, MDF and Excel files: read by a name or a key that chooses them, or refused with the true reason."""

import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.data.conftest import RECORD, good
from tests.data.test_dyno_files import workbook
from twintube.data import Record, check_dataset, load_dataset

Make = Callable[..., Path]
T, Z, F = "time [s]", "stroke [mm]", "force [N]"
HEAD = 'damper = "SA8"\n'


def columns(time: str, stroke: str, force: str) -> str:
    return f'{HEAD}columns = {{"{T}" = "{time}", "{Z}" = "{stroke}", "{F}" = "{force}"}}\n'


def is_good(record: Record) -> None:
    c = good()
    for values, name, factor in ((record.time, T, 1.0), (record.stroke, Z, 1e3), (record.force, F, 1.0)):
        np.testing.assert_allclose(values * factor, c[name], rtol=1e-6, atol=1e-9)


def single(path: Path) -> Record:
    (record,) = load_dataset(path).records
    return record


def said(path: Path) -> str:
    return "\n".join(map(str, check_dataset(path).findings))


def cells(*parts: Any) -> Any:
    array = np.empty((1, len(parts)), dtype=object)
    for i, part in enumerate(parts):
        array[0, i] = part
    return array


def structs(*parts: dict[str, Any]) -> Any:
    array = np.empty((1, len(parts)), dtype=[(name, object) for name in parts[0]])
    for i, part in enumerate(parts):
        array[0, i] = tuple(part.values())
    return array


c = good()
t, z, f = (np.array(c[name]) for name in (T, Z, F))
MAT: dict[str, tuple[dict[str, Any], str]] = {
    "one signal": ({"log": {"time": t[:, None], "signals": {"values": np.c_[z, f]}}},
                   columns("log.time", "log.signals.values[0]", "log.signals.values[1]")),
    "two signals": ({"log": {"time": t[:, None], "signals": structs({"values": z[:, None], "label": "z"}, {"values": np.c_[f, z], "label": "f"})}},
                    columns("log.time", "log.signals[0].values", "log.signals[1].values[0]")),
    "cells": ({"x": cells("remark", t, z, f)}, columns("x[1]", "x[2]", "x[3]")),
    "one cell": ({"x": cells({"t": t, "y": np.c_[z, f]})}, columns("x.t", "x.y[0]", "x.y[1]")),
    "1 x 1 x N": ({"t": t, "x": z.reshape(1, 1, -1), "F": f.reshape(1, -1, 1)}, columns("t", "x", "F")),
    "1 x 2 x N": ({"t": t, "x": np.stack([z, f]).reshape(1, 2, -1)}, columns("t", "x[0]", "x[1]")),
    "others of other lengths": ({"t": t, "x": z, "F": f, "log": np.arange(5000.0)}, columns("t", "x", "F")),
}  # fmt: skip


def test_parts_of_matlab_files(folder: Make) -> None:
    from scipy.io import savemat

    toml = HEAD
    path = folder({}, toml=toml)
    for name, (values, top) in MAT.items():  # all in one dataset: one process reads them
        savemat(path / f"{name}.mat", values)
        toml += RECORD.format(f"{name}.mat") + top.removeprefix(HEAD)
    records = load_dataset(folder({}, toml=toml)).records
    assert [record.name for record in records] == list(MAT)
    for record in records:
        is_good(record)


NOT_READ: dict[str, tuple[Any, str]] = {
    "cells": (cells(t, z, "x"), "a cell array of 3 cells (x[0] to x[2])"),
    "structs": (structs({"a": t}, {"a": z}), "a struct array of 2 elements (x[0] to x[1])"),
    "many structs": (structs(*[{"a": 1.0}] * 70), "a struct array of 70 elements, at most 64 are read"),
    "matrix": (np.c_[z, f, t], "a matrix of 3 columns (x[0] to x[2])"),
    "3-D": (np.zeros((2, 3, 40)), "an array of 2 x 3 x 40"),
    "wide": (np.zeros((100, 90)), "an array of 100 x 90"),
    "text": ("abc", "text"),
    "complex": (z + 1j, "complex numbers"),
    "empty": (np.zeros((0, 0)), "an empty array"),
}


def test_what_a_matlab_variable_is_where_it_is_no_column(folder: Make) -> None:
    from scipy.io import savemat

    toml = columns("t", "x", "F")
    path = folder({}, toml=toml)
    for name, (value, _) in NOT_READ.items():
        savemat(path / f"{name}.mat", {"t": t, "x": value, "F": f})
        toml += RECORD.format(f"{name}.mat")
    found = said(folder({}, toml=toml))
    for name, (_, what) in NOT_READ.items():
        assert f"error: {name}.mat: column '{Z}': 'x' holds {what}, must hold numbers" in found
    assert "has no 'x'" not in found


def element(kind: int, data: bytes) -> bytes:
    return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)


def test_an_object_in_a_matlab_file(folder: Make) -> None:
    from scipy.io import savemat

    path = folder({"a.mat": None}, columns("t", "ts", "F"))
    savemat(path / "a.mat", {"t": t, "x": z, "F": f})
    inner = element(
        14,
        element(6, struct.pack("<II", 13, 0))
        + element(5, struct.pack("<ii", 1, 2))
        + element(1, b"")
        + element(6, bytes(8)),
    )
    texts = b"".join(element(1, text) for text in (b"ts", b"MCOS", b"timeseries"))
    file = (path / "a.mat").read_bytes()
    (path / "a.mat").write_bytes(
        file[:128] + element(14, element(6, struct.pack("<II", 17, 0)) + texts + inner) + file[128:]
    )
    assert "'ts' holds an object of class timeseries, which only MATLAB reads" in said(path)
    (path / "dataset.toml").write_text(columns("t", "x", "F") + RECORD.format("a.mat"))
    is_good(single(path))


def test_parts_of_matlab_v73(folder: Make) -> None:
    h5py = pytest.importorskip("h5py")
    path = folder({"a.mat": None}, columns("log.time", "log.signals[0].values", "log.signals[1].values[1]"))
    with h5py.File(path / "a.mat", "w") as file:
        stored = file.create_group("#refs#")
        stored["a"], stored["b"], stored["c"] = z[None], np.stack([t, f]), t.reshape(-1, 1, 1)
        file["log/time"] = t[None]
        values = file.create_dataset("log/signals/values", shape=(2, 1), dtype=h5py.ref_dtype)
        values[0, 0], values[1, 0] = stored["a"].ref, stored["b"].ref
        for name, parts in (("x", ("c", "a", "b")), ("one", ("a",))):
            array = file.create_dataset(name, shape=(len(parts), 1), dtype=h5py.ref_dtype)
            array.attrs["MATLAB_class"] = np.bytes_(b"cell")
            for i, part in enumerate(parts):
                array[i, 0] = stored[part].ref
        ts = file.create_dataset("ts", data=np.arange(6, dtype="u4")[None])
        ts.attrs["MATLAB_class"], ts.attrs["MATLAB_object_decode"] = np.bytes_(b"timeseries"), 3
        file["n"] = np.zeros((40, 3, 2))
    is_good(single(path))
    for names in (("x[0]", "x[1]", "x[2][1]"), ("log.time", "one", "x[2][1]")):
        (path / "dataset.toml").write_text(columns(*names) + RECORD.format("a.mat"))
        is_good(single(path))
    (path / "dataset.toml").write_text(columns("x", "ts", "n") + RECORD.format("a.mat"))
    for what in (
        "'x' holds 3 cells (x[0] to x[2])",
        "'ts' holds an object of class timeseries",
        "'n' holds an array of 2 x 3 x 40",
    ):
        assert what in said(path)


def test_a_loop_of_cells_ends(folder: Make) -> None:
    h5py = pytest.importorskip("h5py")
    path = folder({"a.mat": None})
    with h5py.File(path / "a.mat", "w") as file:
        array = file.create_dataset("x", shape=(2, 1), dtype=h5py.ref_dtype)
        array[0, 0] = array[1, 0] = array.ref
    assert "structs within structs, more than 8" in said(path)


Channels = list[tuple[str, str, slice]]
ALL, THIRD = slice(None), slice(None, None, 3)
BOTH: Channels = [("stroke", Z, ALL), ("force", F, ALL)]
SLOW: Channels = [("stroke", Z, THIRD), ("force", F, THIRD)]


def mdf(file_name: Path, groups: dict[str, Channels], invalid: Any = None) -> None:
    asammdf = pytest.importorskip("asammdf")
    with asammdf.MDF(version="4.10") as file:
        for title, channels in groups.items():
            signals = [
                asammdf.Signal(samples=np.array(c[key])[part], timestamps=t[part], name=name, unit=key.split(" [")[1][:-1],
                               invalidation_bits=invalid if name == "force" else None)
                for name, key, part in channels
            ]  # fmt: skip
            file.append(signals, acq_name=title.strip())
        file.save(file_name, overwrite=True)


@pytest.mark.parametrize("group", ['"Bench"', "1"])
def test_a_channel_group_is_chosen(folder: Make, group: str) -> None:
    path = folder({"a.mf4": None})
    mdf(path / "a.mf4", {"CAN": SLOW, "Bench": BOTH})
    assert "channel 'stroke' is in the groups 0 'CAN', 1 'Bench': set group, name or number" in said(path)
    (path / "dataset.toml").write_text(HEAD + RECORD.format("a.mf4") + f"group = {group}\n")
    is_good(single(path))
    records = RECORD.format("a.mf4") + "group = 0\n" + RECORD.format("a.mf4") + f"group = {group}\n"
    (path / "dataset.toml").write_text(HEAD + records)
    assert [len(record.time) for record in load_dataset(path).records] == [501, 1501]


APART = {"CAN": SLOW[:1], "Bench": BOTH[1:]}
TWICE = "channel 'force' is there 2 times in group 0 'A': name one of them in `columns`, force[0] to force[1]"
GROUPS: dict[str, tuple[dict[str, Channels], str, str]] = {
    "no name": (
        {"CAN": SLOW, "Bench": BOTH},
        'group = "Rig"',
        "group = 'Rig': no such channel group among 0 'CAN', 1 'Bench'",
    ),
    "no number": ({"CAN": SLOW, "Bench": BOTH}, "group = 2", "group = 2: no such channel group"),
    "name twice": (
        {"CAN": SLOW, "CAN ": BOTH},
        'group = "CAN"',
        "several channel groups of this name among 0 'CAN', 1 'CAN'",
    ),
    "other times": (APART, "", "channel 'force' is not sampled at the times of channel 'stroke'"),
    "where": (APART, "", "they are in group 1 'Bench' and group 0 'CAN'"),
    "elsewhere": ({"CAN": BOTH[:1], "Bench": BOTH[1:]}, "group = 1", "channel 'stroke' is not in group 1 but in 0 'CAN'"),
    "channel twice": ({"A": [*BOTH, BOTH[1]]}, "", TWICE),
}


def test_what_is_said_of_channel_groups(folder: Make) -> None:
    toml = HEAD
    path = folder({}, toml=toml)
    for name, (groups, key, _) in GROUPS.items():
        mdf(path / f"{name}.mf4", groups)
        toml += RECORD.format(f"{name}.mf4") + key + "\n"
    found = said(folder({}, toml=toml)).splitlines()
    for name, (_, _, message) in GROUPS.items():
        assert any(f"{name}.mf4" in line and message in line for line in found), found


def test_a_name_twice_in_a_group(folder: Make) -> None:
    path = folder({"a.mf4": None}, columns("time", "stroke", "force[1]"))
    mdf(path / "a.mf4", {"A": [BOTH[0], ("force", Z, ALL), BOTH[1]]})
    is_good(single(path))


def test_invalid_samples(folder: Make) -> None:
    path = folder({"a.mf4": None})
    invalid = np.zeros(1501, dtype=bool)
    invalid[30:42] = True
    mdf(path / "a.mf4", {"A": BOTH}, invalid)
    (error,) = check_dataset(path).errors
    assert (error.row, error.counted, error.column) == (30, "sample", "force [N]")
    assert (
        "the sample is marked as invalid in the file; start_s and end_s cut a record (12 such samples, the last is sample 41)"
        in error.message
    )
    (path / "dataset.toml").write_text(HEAD + RECORD.format("a.mf4") + "start_s = 0.1\n")
    assert len(single(path).time) == 1451


def test_blank_rows_of_a_sheet(folder: Make) -> None:
    pytest.importorskip("python_calamine")
    path = folder({"a.xlsx": None})
    rows: list[list[Any]] = [["Bench 4"], [], ["Time", "Stroke", "Force"], [], ["[s]", "[mm]", "[N]"], []]
    for i, row in enumerate(zip(t, z, f, strict=True)):
        rows += [list(row)] + ([[], []] if i % 100 == 99 else [])
    (path / "a.xlsx").write_bytes(workbook({"Data": rows}))
    (path / "dataset.toml").write_text(HEAD + "skip_rows = 2\n" + RECORD.format("a.xlsx"))
    is_good(single(path))
    assert "a.xlsx: row 107: skipped 30 blank rows between the others" in said(path)
