"""Every defect is caught with file, column and row, and none is repaired."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.data.conftest import Columns, as_csv, good
from twintube.data import DataError, Finding, check_dataset, load_dataset

T, Z, V, F = "time [s]", "stroke [mm]", "velocity [mm/s]", "force [N]"
Make = Callable[..., Path]


def without_remarks(findings: list[Finding]) -> list[Finding]:
    return [finding for finding in findings if finding.severity != "remark"]


def put(column: str, i: int, value: Any) -> Callable[[Columns], Columns]:
    def spoil(c: Columns) -> Columns:
        return c | {column: [*c[column][:i], value, *c[column][i + 1 :]]}

    return spoil


def scale(column: str, factor: float) -> Callable[[Columns], Columns]:
    return lambda c: c | {column: c[column] * factor}


def rename(old: str, new: str) -> Callable[[Columns], Columns]:
    return lambda c: {new if name == old else name: values for name, values in c.items()}


def without(*columns: str) -> Callable[[Columns], Columns]:
    return lambda c: {name: values for name, values in c.items() if name not in columns}


def cut(first: int, last: int) -> Callable[[Columns], Columns]:
    return lambda c: {name: np.delete(values, slice(first, last)) for name, values in c.items()}


def both(*spoilers: Callable[[Columns], Columns]) -> Callable[[Columns], Columns]:
    def spoil(c: Columns) -> Columns:
        for one in spoilers:
            c = one(c)
        return c

    return spoil


def held(first: int, last: int) -> Callable[[Columns], Columns]:
    """All channels but the time stand still."""

    def spoil(c: Columns) -> Columns:
        result = {name: np.array(values) for name, values in c.items()}
        for name in (Z, V, F):
            if name in result:
                result[name][first:last] = result[name][first]
        return result

    return spoil


def jittered(c: Columns) -> Columns:
    t = c[T] + np.random.default_rng(2).uniform(-0.0002, 0.0002, len(c[T]))
    return c | {T: t, Z: 30 * np.sin(2 * np.pi * t)}


def one_cycle_back(c: Columns) -> Columns:
    force = np.array(c[F])
    force[500:1000] *= -1
    return c | {F: force}


ERRORS = {
    "empty cell": (put(Z, 10, ""), Z, 12, "the cell is empty"),
    "text": (put(F, 10, "over"), F, 12, "'over' is not a finite number"),
    "NaN": (put(F, 7, "NaN"), F, 9, "'NaN' is not a finite number"),
    "infinite": (put(V, 7, "-inf"), V, 9, "'-inf' is not a finite number"),
    "spaces": (put(F, 7, "  "), F, 9, "the cell is empty"),
    "underscore": (put(F, 7, "1_0"), F, 9, "'1_0' is not a finite number"),
    "decimal comma": (put(Z, 7, '"1,5"'), Z, 9, "'1,5' is not a finite number"),
    "time back": (put(T, 10, 0.001), T, 12, "time goes back: 0.001 s after 0.018 s"),
    "time repeated": (put(T, 10, 0.018), T, 12, "time is repeated: 0.018 s after 0.018 s"),
    "gap": (cut(700, 800), T, 702, "gap: step of up to 0.202 s where 0.002 s is usual, must be at most 10 times that"),
    "time in ms": (scale(T, 1000), T, None, "time step = 2 s: must be from 1e-05 to 0.5 s; s and ms mixed up?"),
    "time in s": (both(scale(T, 1e-3), without(V)), T, None, "time step = 2e-06 s"),
    "m called mm": (scale(Z, 1e-3), Z, None, "must be from 0.0005 to 1 m; it does not move, or m and mm mixed up?"),
    "mm called m": (rename(Z, "stroke [m]"), "stroke [m]", None, "must be from 0.0005 to 1 m; m and mm mixed up?"),
    "kN called N": (scale(F, 1e-3), F, None, "must be from 10 to 100000 N; it does not move, or N and kN mixed up?"),
    "N called kN": (rename(F, "force [kN]"), "force [kN]", None, "to 100000 N; N and kN mixed up?"),
    "unknown unit": (rename(Z, "stroke [mmm]"), "stroke [mmm]", None, "unit 'mmm' is not a unit of stroke"),
    "unit of something else": (rename(Z, "stroke [N]"), "stroke [N]", None, "unit 'N' is not a unit of stroke"),
    "no text of a unit": (rename(Z, "stroke [)(]"), "stroke [)(]", None, "unit ')(' is not a unit of stroke"),
    "no unit": (rename(Z, "stroke"), "stroke", None, "no unit, must be like 'stroke [m]'"),
    "no column": (without(F), "force", None, "no column 'force [N]' among time [s], stroke [mm], velocity [mm/s]"),
    "misspelt": (rename(Z, "strok [mm]"), "stroke", None, "did you mean strok?"),
    "no mm/s": (rename(V, "velocity [m/s]"), "velocity [m/s]", 2, "velocity up to 189"),
    "velocity in m/s": (
        scale(V, 1e-3),
        V,
        None,
        "velocity is 0.001 times the derivative of the stroke, must be 0.95 to 1.05",
    ),
    "velocity sign": (scale(V, -1), V, None, "times the derivative of the stroke, must be 0.95 to 1.05: wrong sign?"),
    "velocity gain": (scale(V, 1.2), V, None, "wrong gain?"),
    "other velocity": (lambda c: c | {V: np.cos(7 * c[T]) * 180}, V, None, "velocity is not the derivative of the stroke"),
    "force sign": (scale(F, -1), F, None, "set force_sign = -1 or stroke_sign = -1"),
    "outside the tube": (put(Z, 400, 200.0), Z, 402, "stroke up to 0.2 m: the tube allows -0.1"),
    "repeated samples": (held(500, 520), Z, 503, "stroke and force stay identical while the damper moves"),
    "repeated, no velocity": (
        both(held(500, 520), without(V)),
        Z,
        503,
        "repeated samples (19 such rows, the last is row 521)",
    ),
    "degC called K": (lambda c: c | {"temperature [K]": c[T] + 20}, "temperature [K]", 2, "degC and K mixed up?"),
    "two samples": (cut(1, 1501), "", None, "1 samples, at least 2 are needed"),
    "two strokes": (
        lambda c: c | {"stroke [m]": c[Z] / 1000},
        "stroke [m]",
        None,
        "stroke is there already as 'stroke [mm]'",
    ),
}


@pytest.mark.parametrize(("spoil", "column", "row", "message"), ERRORS.values(), ids=ERRORS)
def test_errors(folder: Make, spoil: Callable[[Columns], Columns], column: str, row: int | None, message: str) -> None:
    path = folder({"bad.csv": spoil(good()), "good.csv": good()})
    with pytest.raises(DataError) as caught:
        load_dataset(path)
    hits = [f for f in caught.value.findings if message in f.message]
    assert hits, caught.value
    assert (hits[0].severity, hits[0].file, hits[0].column) == ("error", "bad.csv", column)
    assert row is None or hits[0].row == row
    assert not [f for f in caught.value.findings if f.file == "good.csv"]
    assert [record.file for record in check_dataset(path).records] == ["good.csv"]


WARNINGS = {
    "small gap": (cut(700, 702), T, 702, "small gap: step of up to 0.006 s where 0.002 s is usual"),
    "jitter": (jittered, T, None, "jitter: the step varies by"),
    "offset": (lambda c: c | {Z: c[Z] + 10}, Z, None, "offset: the stroke runs from"),
    "velocity offset": (lambda c: c | {V: c[V] + 10}, V, None, "offset: mean velocity 0.00999 m/s beyond"),
    "late velocity": (lambda c: c | {V: np.roll(c[V], 8)}, V, None, "velocity explains the stroke but for"),
    "one sample repeated": (held(500, 502), Z, 503, "stroke and force as in the sample before while the damper moves"),
    "gradient": (lambda c: c | {V: np.gradient(c[Z], c[T])}, V, None, "velocity is just the central difference"),
    "one cycle": (one_cycle_back, F, None, "work of a cycle = "),
    "other column": (lambda c: c | {"pressure [bar]": c[T]}, "", None, "not used: 'pressure [bar]'"),
    "no cycle": (cut(200, 1501), F, None, "no full cycle of stroke"),
}


@pytest.mark.parametrize(("spoil", "column", "row", "message"), WARNINGS.values(), ids=WARNINGS)
def test_warnings(folder: Make, spoil: Callable[[Columns], Columns], column: str, row: int | None, message: str) -> None:
    dataset = load_dataset(folder({"odd.csv": spoil(good())}))
    hits = [f for f in dataset.findings if message in f.message]
    assert hits, dataset.findings
    assert (hits[0].severity, hits[0].file, hits[0].column) == ("warning", "odd.csv", column)
    assert row is None or hits[0].row == row
    assert dataset.records[0].findings == tuple(without_remarks(dataset.findings))


def test_blocks_may_be_sampled_differently(folder: Make) -> None:
    c = good()
    keep = np.append(np.arange(0, 800, 4), np.arange(800, 1501))
    dataset = load_dataset(folder({"two.csv": {name: values[keep] for name, values in c.items()}}))
    assert [f.message for f in without_remarks(dataset.findings)] == ["the sampling changes: steps from 0.002 to 0.008 s"]


def test_good_data_gives_no_finding(folder: Make) -> None:
    dataset = load_dataset(folder({"good.csv": good()}))
    assert without_remarks(dataset.findings) == []
    assert dataset.records[0].usable.all()


def test_rest_is_no_repeated_sample(folder: Make) -> None:
    c = {name: np.concatenate([values[:1000], np.full(500, values[1000]), values[1000:]]) for name, values in good().items()}
    c[T] = np.arange(len(c[Z])) * 0.002
    c[V][1000:1501] = 0.0
    c[F][1000:1501] = 50.0
    c[Z][1000:1501] = c[Z][1000]
    assert not [f for f in check_dataset(folder({"rest.csv": c})).findings if "identical" in f.message]


def test_all_records_report_at_once(folder: Make) -> None:
    spoilt = {f"{i}.csv": spoil(good()) for i, (spoil, *_) in enumerate(ERRORS.values())}
    path = folder(spoilt | {"good.csv": good(), "absent.csv": None, "empty.csv": "", "x.doc": "x"})
    with pytest.raises(DataError) as caught:
        load_dataset(path)
    for i, (_, column, _, message) in enumerate(ERRORS.values()):
        assert any(f.file == f"{i}.csv" and f.column == column and message in f.message for f in caught.value.findings), (
            message
        )
    text = str(caught.value)
    assert "error: absent.csv: cannot be read" in text
    assert "error: empty.csv: the file is empty" in text
    assert "error: x.doc: unknown format '.doc', must be one of .csv" in text
    assert text.splitlines()[0] == f"Test: {len(check_dataset(path).errors)} errors"


def test_two_defects_of_one_record_are_both_reported(folder: Make) -> None:
    found = check_dataset(folder({"bad.csv": both(scale(F, -1), put(Z, 10, "x"), put(V, 20, ""))(good())})).errors
    assert [(f.column, f.row) for f in found[:2]] == [(Z, 12), (V, 22)]
    assert "force_sign" in found[2].message


@pytest.mark.parametrize(
    ("text", "row", "message"),
    [
        ("time [s],stroke [mm],stroke [mm],force [N]\n0,1,1,1\n", 1, "two columns are named 'stroke [mm]'"),
        ("time [s],stroke [mm],force [N]\n0,1,1\n1,1,1,1\n", 3, "4 cells where 3 columns are named"),
        ("time [s],stroke [mm],force [N]\n0,1,1\n1,1\n2,2,2", 3, "the cell is empty"),
        ("time [s],stroke [mm],force [N]\n0,1,1\n,,1\n2,2,2", 3, "the cell is empty"),
        ("time [s],stroke [mm],force [N]\n", None, "0 samples, at least 2 are needed"),
    ],
)
def test_tables_out_of_shape(folder: Make, text: str, row: int | None, message: str) -> None:
    found = check_dataset(folder({"bad.csv": text})).errors
    assert [f for f in found if f.row == row and message in f.message], found


def test_not_utf8(folder: Make) -> None:
    path = folder({"a.csv": None})
    (path / "a.csv").write_bytes(as_csv(good()).encode() + b"\xff\n")
    assert check_dataset(path).errors[0].row == 1503


def turning(slower: float = 1.0) -> Columns:
    """A triangle of 1.57 m/s at 128 Hz, whose rig turns within a sample; the velocity column times a factor."""
    t = np.arange(400) / 128.0
    period = 4 * 40.0 / 1570.0
    phase = (t / period + 0.19) % 1.0
    z = 40.0 * (1.0 - 4.0 * np.abs(phase - 0.5))
    v = np.where(phase < 0.5, 1570.0, -1570.0)
    return {T: t, Z: z, V: slower * v, F: np.sign(v) * 500.0}


def test_a_rig_that_turns_between_two_samples_has_a_velocity_that_belongs_to_its_stroke(folder: Make) -> None:
    findings = check_dataset(folder({"a.csv": turning()})).findings
    assert not [f for f in findings if f.column == V and f.severity == "error"]
    wrong = check_dataset(folder({"a.csv": turning(0.8)})).findings
    assert [f for f in wrong if "times the derivative of the stroke" in f.message]
