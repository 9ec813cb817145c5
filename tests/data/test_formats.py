"""The same record through every format, and foreign files read by what dataset.toml says about them."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.data.conftest import RECORD, Columns, as_csv, good
from twintube.common.extras import extra_of
from twintube.data import GRADIENT, MEASURED, Record, check_dataset, load_dataset
from twintube.readers import KINDS
from twintube.readers.__main__ import READERS

Make = Callable[..., Path]
SHORT = {"time": "time [s]", "stroke": "stroke [mm]", "velocity": "velocity [mm/s]", "force": "force [N]"}
MAPPING = 'columns = {"time [s]" = "Tout", "stroke [mm]" = "x_F[0]", "velocity [mm/s]" = "x_F[1]", "force [N]" = "x_F[2]"}\n'


def one(path: Path) -> Record:
    (record,) = load_dataset(path).records
    return record


def is_good(record: Record, rtol: float = 1e-6) -> None:
    for name, header in SHORT.items():
        factor = 1.0 if name in {"time", "force"} else 1e-3
        np.testing.assert_allclose(getattr(record, name), good()[header] * factor, rtol=rtol, atol=1e-8)


def matrix(c: Columns) -> Any:
    return np.column_stack([c["stroke [mm]"], c["velocity [mm/s]"], c["force [N]"]])


def hdf5(path: Path, groups: dict[str, Any], header: bool = True) -> None:
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w", userblock_size=512 if header else 0) as file:
        for name, values in groups.items():
            file[name] = values
    if header:
        with path.open("r+b") as raw:
            raw.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")


def test_csv(folder: Make) -> None:
    record = one(folder({"a.csv": good()}))
    is_good(record)
    assert (record.name, record.file, record.measurement, record.oil_level) == ("a", "a.csv", "harmonic", 0.56)
    assert (record.gas_preload, record.start_temperature, record.split) == (False, None, None)
    assert (record.velocity_source, record.temperature) == (MEASURED, None)


def test_other_units_and_temperature(folder: Make) -> None:
    c = good()
    other = {
        "force [kN]": c["force [N]"] / 1000,
        "time [ms]": c["time [s]"] * 1000,
        "stroke [m]": c["stroke [mm]"] / 1000,
        "velocity [m/s]": c["velocity [mm/s]"] / 1000,
        "temperature [K]": np.full(1501, 300.0),
    }
    record = one(folder({"a.csv": other}))
    is_good(record)
    assert record.temperature is not None
    np.testing.assert_allclose(record.temperature, 26.85)


def test_missing_velocity_is_made_and_says_so(folder: Make) -> None:
    c = good()
    del c["velocity [mm/s]"]
    record = one(folder({"a.csv": c}))
    assert record.velocity_source == GRADIENT
    np.testing.assert_array_equal(record.velocity, np.gradient(record.stroke, record.time))


def test_parquet(folder: Make) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    parquet = pytest.importorskip("pyarrow.parquet")
    path = folder({"a.parquet": None})
    parquet.write_table(pyarrow.table(good()), path / "a.parquet")
    is_good(one(path))
    spoilt = good()
    spoilt["force [N]"] = [*spoilt["force [N]"][:5], None, *spoilt["force [N]"][6:]]
    parquet.write_table(pyarrow.table(spoilt), path / "a.parquet")
    (found,) = check_dataset(path).errors
    assert str(found) == "error: a.parquet: sample 5, column 'force [N]': the cell is empty"


def test_matlab_v5(folder: Make) -> None:
    from scipy.io import savemat

    path = folder({"a.mat": None}, 'damper = "SA8"\n' + MAPPING)
    c = good()
    savemat(path / "a.mat", {"Tout": c["time [s]"], "x_F": matrix(c), "remark": "text", "f": 1.0})
    is_good(one(path))
    (path / "dataset.toml").write_text('damper = "SA8"\n' + RECORD.format("a.mat") + MAPPING.replace("x_F", "log.x_F"))
    savemat(path / "a.mat", {"Tout": c["time [s]"], "log": {"x_F": matrix(c)}})
    is_good(one(path))


def test_matlab_v73(folder: Make) -> None:
    path = folder({"a.mat": None}, 'damper = "SA8"\n' + MAPPING)
    c = good()
    hdf5(path / "a.mat", {"Tout": c["time [s]"][None, :], "x_F": matrix(c).T})  # MATLAB stores by columns
    is_good(one(path))
    hdf5(path / "a.mat", {"Tout": c["time [s]"][None, :], "x_F": matrix(c).T}, header=False)
    is_good(one(path))


def test_matlab_defects(folder: Make) -> None:
    from scipy.io import savemat

    c = good()
    path = folder({"a.mat": None, "b.mat": None, "c.mat": "no file of MATLAB", "d.mat": None}, 'damper = "SA8"\n' + MAPPING)
    table = matrix(c)
    table[77, 2] = np.nan
    savemat(path / "a.mat", {"Tout": c["time [s]"], "x_F": table})
    savemat(path / "b.mat", {"Tout": c["time [s]"][:-1], "x_F": matrix(c)})
    savemat(path / "d.mat", {"tout": c["time [s]"], "x_F": matrix(c)})
    found = "\n".join(map(str, check_dataset(path).errors))
    assert "a.mat: sample 77, column 'force [N]': nan is not a finite number" in found
    assert "b.mat: column 'time [s]': 1500 samples where another column of the file has 1501" in found
    assert "c.mat: not a readable .mat file" in found
    assert "d.mat: column 'time [s]': the file has no 'Tout' but tout, x_F[0], x_F[1], x_F[2], did you mean tout?" in found


def mdf(path: Path, c: Columns, unit: str = "mm", late: float = 0.0, names: dict[str, str] | None = None) -> None:
    asammdf = pytest.importorskip("asammdf")
    t = c["time [s]"]
    units = {"stroke": unit, "velocity": "mm/s", "force": "N"}
    with asammdf.MDF(version="4.10") as file:
        for name, its in units.items():
            start = late if name == "force" else 0.0
            called = (names or {}).get(name, name)
            file.append([asammdf.Signal(samples=c[SHORT[name]], timestamps=t + start, name=called, unit=its)])
        file.save(path, overwrite=True)


def test_mdf(folder: Make) -> None:
    path = folder({"a.mf4": None})
    mdf(path / "a.mf4", good())
    is_good(one(path))
    columns = 'columns = {"stroke [mm]" = "Weg", "force [N]" = "Kraft", "time [s]" = "time"}\n'
    folder({"a.mf4": None}, 'damper = "SA8"\n' + columns)
    mdf(path / "a.mf4", good(), names={"stroke": "Weg", "force": "Kraft"})
    assert one(path).velocity_source == GRADIENT
    mdf(path / "a.mf4", good(), unit="m", names={"stroke": "Weg", "force": "Kraft"})
    assert "the file gives 'Weg' in m, not in mm" in str(check_dataset(path).errors[0])


def test_mdf_defects(folder: Make) -> None:
    path = folder({"a.mf4": None, "b.mf4": "x"})
    mdf(path / "a.mf4", good(), late=0.1)
    late, broken = check_dataset(path).errors
    assert "channel 'force' is not sampled at the times of channel 'stroke'" in late.message
    assert "not a readable .mf4 file" in broken.message


def test_a_missing_package_is_named(folder: Make, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "asammdf", None)
    (found,) = check_dataset(folder({"a.mf4": "x"})).errors
    assert found.message == ".mf4 files need the package asammdf: pip install 'twintube[mdf]'"


def test_foreign_text(folder: Make) -> None:
    c = good()
    rows = zip(*c.values(), strict=True)
    text = "Prüfstand 3\n\n" + "\n".join(";".join(f"{x:.7g}".replace(".", ",") for x in row) for row in rows) + "\n\n"
    how = f'columns = {list(c)}\ndelimiter = ";"\ndecimal = ","\nencoding = "latin-1"\nskip_rows = 2'
    path = folder({"a.txt": None}, f'damper = "SA8"\n{how}')
    (path / "a.txt").write_bytes(text.encode("latin-1"))
    is_good(one(path))
    (path / "a.txt").write_bytes(text.replace("30,", "x", 1).encode("latin-1"))
    row = next(i for i, line in enumerate(text.split("\n"), start=1) if "30," in line)
    assert [f.row for f in check_dataset(path).errors] == [row]


def test_foreign_header(folder: Make) -> None:
    text = as_csv(good()).replace("stroke [mm]", "Weg / mm").replace("force [N]", "Kraft")
    text = text.replace("time [s]", "t").replace("velocity [mm/s]", "v")
    columns = '{"time [s]" = "t", "stroke [mm]" = "Weg / mm", "velocity [mm/s]" = "v", "force [N]" = "Kraft"}'
    is_good(one(folder({"a.csv": text}, f'damper = "SA8"\ncolumns = {columns}')))


def test_signs_and_zero_only_as_stated(folder: Make) -> None:
    c = good()
    c["stroke [mm]"] = 12 - c["stroke [mm]"]
    c["velocity [mm/s]"] = -c["velocity [mm/s]"]
    path = folder({"a.csv": c})
    assert "stroke_sign = -1" in str(check_dataset(path).errors[0])
    is_good(one(folder({"a.csv": c}, 'damper = "SA8"\nstroke_sign = -1\nstroke_offset = "12 mm"')), rtol=1e-4)


def test_a_record_has_the_last_word_on_how_to_read_it(folder: Make) -> None:
    c = good()
    c["force [N]"] = -c["force [N]"]
    toml = 'damper = "SA8"\nforce_sign = -1\n' + RECORD.format("a.csv") + RECORD.format("b.csv") + "force_sign = 1\n"
    for record in load_dataset(folder({"a.csv": c, "b.csv": good()}, toml=toml)).records:
        is_good(record)


def test_the_table_names_a_reader_for_every_ending_and_a_file_of_another_is_told_all(tmp_path: Path) -> None:
    for ending, kind in KINDS.items():
        assert kind.reader == "text" or kind.reader in READERS, ending
        assert kind.package in ("", "scipy") or extra_of(kind.package) in ("formats", "mdf"), ending
    (tmp_path / "a.foo").write_text("1,2\n")
    (tmp_path / "dataset.toml").write_text('damper = "SA8"\n' + RECORD.format("a.foo"))
    message = "; ".join(finding.message for finding in check_dataset(tmp_path).errors)
    assert all(ending in message for ending in KINDS), message
