"""The hostile inputs."""

from typing import Any

import numpy as np

from tests.data.conftest import RECORD
from tests.hardening.hostile import (
    CAR,
    CSV,
    DAMPER,
    ESC,
    HEAD,
    ROWS,
    STUDY,
    Hostile,
    car,
    changed,
    damper,
    dataset,
    fifo,
    file_of,
    hdf5,
    header,
    manifest,
    mat,
    mf4,
    parquet,
    record,
    study,
    words,
)

LINE = np.arange(301.0)
GOOD: dict[str, Any] = {"time [s]": LINE * 0.002, "stroke [mm]": LINE % 50, "force [N]": LINE}
MANY = 5000
GERMAN = "time [s];stroke [mm];force [N]\n" + "".join(f"0,{i:03d};1,5;20,5\n" for i in range(50))


def changed_byte(place: int) -> Any:
    def spoil(data: bytearray) -> None:
        data[place] ^= 0xFF

    return spoil


CSV_FILES = {
    "empty": record("", "the file is empty"),
    "only line feeds": record("\n\n\n", "the file is empty"),
    "NUL": record("\0" * 100, "no column 'time [s]'"),
    "NUL in a cell": record(CSV.replace("0.002,1", "0.002,\0"), "is not a finite number"),
    "binary": record(bytes(range(256)) * 40, "not a text in utf-8"),
    "numbers for a header": record(ROWS, "set `columns`"),
    "names twice": record("time [s],stroke [mm],stroke [mm]\n0,1,2\n", "two columns are named 'stroke [mm]'"),
    "semicolons": record(CSV.replace(",", ";"), "set delimiter = ';'"),
    "tabs": record(CSV.replace(",", "\t"), "set delimiter = '\\t'"),
    "German": record(GERMAN, "decimal = ','"),
    "German under three commas": dataset(GERMAN.replace(";", ","), "cells where 3 columns are named"),
    "one quote to the end": record(CSV + '0.3,"' + "1,2\n" * 60_000, "text table"),
    "a field of 1 MB": record("time [s],stroke [mm]\n0," + "9" * 1_000_000 + "\n", "text table"),
    "a number of 100,000 digits": record("time [s],stroke [mm]\n0," + "9" * 100_000 + "\n1,2\n", "is not a finite number"),
    "10,000 columns": record(",".join(f"c{i}" for i in range(10_000)) + "\n0\n", "10000 columns, at most 256"),
    "200,000 columns": record(",".join("c" for _ in range(200_000)) + "\n0\n", "200000 columns, at most 256"),
    "100,000 cells in a row": record("time [s],stroke [mm]\n0,1\n" + "1," * 100_000 + "\n", "cells where 2 columns are named"),
    "short rows": record("time [s],stroke [mm]\n0\n1\n", "the cell is empty"),
    "NaN": record(CSV.replace("0.002,1", "0.002,nan"), "'nan' is not a finite number"),
    "infinity": record(CSV.replace("0.002,1", "0.002,-inf"), "'-inf' is not a finite number"),
    "1e999": record(CSV.replace("0.002,1", "0.002,1e999"), "'1e999' is not a finite number"),
    "1_000": record(CSV.replace("0.002,1", "0.002,1_0"), "'1_0' is not a finite number"),
    "hexadecimal": record(CSV.replace("0.002,1", "0.002,0x10"), "'0x10' is not a finite number"),
    "formula of a spreadsheet": record(CSV.replace("0.002,1", "0.002,=1+1"), "'=1+1' is not a finite number"),
    "decimal comma": record(CSV.replace("0.002,1,", '0.002,"1,5",'), "set decimal = ','?"),
    "time repeated": record(CSV.replace("0.004,", "0.002,"), "is not after the row before"),
    "time back": record(CSV.replace("0.004,", "-1,"), "is not after the row before"),
    "one sample": record("time [s],stroke [mm]\n0,1\n", "at least 2 are needed"),
    "outside the tube": record(CSV.replace("[mm]", "[km]"), "velocity = 500000 m/s: must be a number from"),
    "too fast": record(CSV.replace("time [s]", "time [us]"), "velocity = "),
    "escape in a header": record(CSV.replace("stroke [mm]", ESC), "no column 'stroke [mm]'"),
    "escape in a cell": record(CSV.replace("0.002,1", f"0.002,{ESC}"), "is not a finite number"),
    "no time": record(CSV.replace("time [s]", "t"), "no column 'time [s]'"),
    "stroke twice": record(CSV.replace("force [N]", "stroke [m]"), "stroke is there already"),
    "a day that is not there": record("time,stroke [mm]\n31.02.2026 12:00:00,1\n31.02.2026 12:00:01,2\n", "is not a date"),
    "hour 99": record("time,stroke [mm]\n12:00:00,1\n99:00:00,2\n", "'99:00:00' is no time like '12:00:00'"),
    "thousands point": dataset("time [s];stroke [mm];force [N]\n0,0;2.189;1,5\n0,1;2,5;1,5\n", "'2.189' holds a point where decimal is ','",
                               "delimiter = ';'\ndecimal = ','"),
    "thousands point in the wrong place": dataset("time [s];stroke [mm];force [N]\n0,0;12.34,5;1,5\n0,1;2,5;1,5\n",
                                         "'12.34,5' holds a point", "delimiter = ';'\ndecimal = ','"),
    "mixed decimals": dataset("time [s];stroke [mm];force [N]\n0,0;1,5;1,5\n0.1;2,5;1,5\n", "'0.1' holds a point",
                              "delimiter = ';'\ndecimal = ','"),
    "delimiter is the decimal": dataset(CSV, "delimiter and decimal are both ','", "decimal = ','"),
    "20,000 blocks": record((CSV[:31] + "0,1,2\n1,2,3\n2,3,4\n") * 20_000, "the file has 20000 blocks"),
    "50,000 segments": record("LabVIEW Measurement\n" + "Channels\t2\n***End_of_Header***\nX_Value\tA\n" * 50_000, "49999 blocks", "a.lvm"),
    "a head of LabVIEW alone": record("LabVIEW Measurement\n" * 50_000, "a file of LabVIEW without", "a.lvm"),
    "200,000 rows of texts": record("a,b\n" + "x,y\n" * 200_000, "no column 'time [s]'"),
    "500,000 blank rows": record("\n" * 250_000 + CSV[:31] + ",,\n" * 250_000, "0 samples, at least 2 are needed"),
    "full-width digits": record(CSV.replace("0.002,1,", "0.002,\uff11,"), "is not a finite number"),
    "skip all rows": dataset(CSV, "skip_rows = 90000: the file has fewer rows", "skip_rows = 90000"),
}  # fmt: skip

UNITS = {
    "power tower": header("9**9**9"),
    "power of a power": header("mm**9**9"),
    "exponent of two digits": header("mm**99"),
    "arithmetic": header("mm + 1 mm"),
    "factor": header("2 mm"),
    "division by zero": header("mm/0"),
    "brackets": header("((((((((((((((((((((((((((mm"),
    "closing first": header(")mm("),
    "call": header("__import__('os')"),
    "attribute": header("mm.__class__.__mro__"),
    "lambda": header("(lambda:0)()"),
    "subscript": header("mm[0]"),
    "long": header("m" * 10_000),
    "many factors": header("*".join("m" for _ in range(29))),
    "NUL": header("m\0m"),
    "escape": header(ESC),
    "other quantity": header("kg"),
    "unknown": header("fathomless"),
    "none": record(CSV.replace(" [mm]", ""), "no unit, must be like 'stroke [m]'"),
    "comma": damper("D_li = 0.0298", 'D_li = "29,8 mm"', "must be one number and its unit"),
    "quotient": damper("D_li = 0.0298", 'D_li = "1/0 m"', "'1/0 m' is not a quantity in m"),
    "tower as a value": damper("D_li = 0.0298", 'D_li = "9**9**9**9 m"', "is not a quantity in m"),
    "sum as a value": damper("D_li = 0.0298", 'D_li = "20 mm + 9.8 mm"', "is not a quantity in m"),
    "1e999 m": damper("D_li = 0.0298", 'D_li = "1e999 m"', "D_li = inf m: must be a number from"),
    "long quantity": damper("D_li = 0.0298", f'D_li = "{"9" * 5000} mm"', "is not a quantity in m"),
    "no unit in a text": damper("D_li = 0.0298", 'D_li = "0.0298"', "is not a quantity in m"),
    "offset unit": damper("D_li = 0.0298", 'D_li = "20 degC"', "is not a quantity in m"),
}  # fmt: skip

ENCODINGS = {
    name: dataset(CSV, "must be a text encoding", f"encoding = '{name}'")
    for name in ("idna", "punycode", "utf-7", "rot13", "base64", "unicode_escape", "raw_unicode_escape", "undefined", "zip", "",
                 "utf-9", "x" * 199, "../../etc/passwd", "utf-8\\u00e9")
} | {
    "UTF-16 without its mark": record(CSV.encode("utf-16-le"), "set encoding = 'utf-16-le'"),
    "UTF-16 cut": record(CSV.encode("utf-16")[:-1], "not a text in utf-16"),
    "UTF-8 read as UTF-16": dataset(CSV.encode()[: len(CSV) // 2 * 2], "no column 'time [s]'", "encoding = 'utf-16'"),
    "UTF-8 read as ASCII": dataset(CSV.replace("force", "für").encode(), "not a text in ascii", "encoding = 'ascii'"),
    "UTF-32 cut": dataset(CSV.encode("utf-32")[:-3], "not a text in utf-32", "encoding = 'utf-32'"),
    "overlong UTF-8": record(CSV.encode() + b"\xc0\xaf", "not a text in utf-8"),
    "surrogate": record(CSV.encode() + b"\xed\xa0\x80", "not a text in utf-8"),
    "Latin-1 parameter file": file_of("damper", DAMPER.encode("utf-8") + b"# \xfc\n", "not a text in UTF-8"),
}  # fmt: skip

MANIFESTS = {
    "empty": manifest("", "damper is missing"),
    "not TOML": manifest("<html>", "cannot be read"),
    "binary": manifest(bytes(range(256)), "cannot be read"),
    "NUL": manifest(HEAD + "\0", "cannot be read"),
    "NUL escaped": manifest(HEAD.replace("Test", "\\u0000"), "control characters"),
    "escape sequence": manifest(HEAD.replace("Test", "\\u001b[31m"), "control characters"),
    "escape in a key": manifest(HEAD + '"\\u001b[31m" = 1\n', "control character"),
    "direction of writing": manifest(HEAD.replace("Test", "\\u202Etset"), "control characters"),
    "title of two lines": manifest(HEAD.replace('"Test"', '"a\\nb"') + RECORD.format("a.csv"), "must be a text of one line"),
    "title as a number": manifest(HEAD.replace('"Test"', "1") + RECORD.format("a.csv"), "title = 1: must be a text"),
    "title of 10,000 characters": manifest(HEAD.replace("Test", "x" * 10_000), "at most 200 characters"),
    "integer of 5000 digits": manifest(HEAD + f"skip_rows = {'9' * 5000}\n", "cannot be read"),
    "hexadecimal of 5000 digits": manifest(HEAD + f"skip_rows = 0x{'f' * 5000}\n", "more than 64 bits"),
    "skip_rows = 2e9": manifest(HEAD + "skip_rows = 2000000000\n", "skip_rows = 2000000000: must be an integer from 0 to"),
    "skip_rows of a float": manifest(HEAD + "skip_rows = 2e9\n", "must be an integer"),
    "lists within lists": manifest(HEAD + f"columns = {'[' * 3000}{']' * 3000}\n", "within each other"),
    "ten lists within lists": manifest(HEAD + f"columns = {'[' * 10}{']' * 10}\n", "more than 8 tables and lists"),
    "tables within tables": manifest(HEAD + f"columns = {'{a = ' * 3000}1{'}' * 3000}\n", "within each other"),
    "a key of 100,000 parts": manifest(HEAD + "a." * 100_000 + "a = 1\n", "a key of more than 16 parts"),
    "a key of 100,000 parts in a table": manifest(HEAD + "x = {" + "a." * 100_000 + "a = 1}\n", "a key of more than 16 parts"),
    "a header of 100,000 parts": manifest(HEAD + "[" + "a." * 100_000 + "a]\n", "a key of more than 16 parts"),
    "a long key": manifest(HEAD + "k" * 50_000 + " = 1\n", "at most 200 characters"),
    "5000 unknown keys": manifest(HEAD + "".join(f"k{i} = 1\n" for i in range(MANY)), "4995 more unknown keys"),
    "5000 records": manifest(HEAD + "".join(RECORD.format(f"{i}.csv") for i in range(MANY)), "5000 records, at most 1000"),
    "900 records of one file": manifest(HEAD + RECORD.format("a.csv") * 900, "is named by a record before"),
    "2 MB": manifest(HEAD + "# " + "x" * 2_000_000, "it has 2 MB, at most 1 MB"),
    "records as a table": manifest(HEAD + "[record]\nfile = 'a.csv'\n", "no [[record]]"),
    "records as a number": manifest(HEAD + "record = 1\n", "no [[record]]"),
    "damper as a number": manifest('damper = 1\n' + RECORD.format("a.csv"), "damper = 1: must be"),
    "damper in a folder": manifest('damper = "."\n' + RECORD.format("a.csv"), "it is a folder"),
    "file in a folder": manifest(HEAD + RECORD.format("."), "unknown format"),
    "file with NUL": manifest(HEAD + RECORD.format("a\\u0000.csv"), "control characters"),
    "file of 5000 letters": manifest(HEAD + RECORD.format("a" * 5000 + ".csv"), "at most 1000 characters"),
    "file of 190 letters per folder": manifest(HEAD + RECORD.format("a" * 190 + "/a.csv"), "cannot be read"),
    "unknown format": manifest(HEAD + RECORD.format("a.pdf"), "unknown format '.pdf'"),
    "oil level nan": manifest(HEAD + RECORD.format("a.csv").replace("0.56", "nan"), "oil_level = nan: must be"),
    "oil level 60": manifest(HEAD + RECORD.format("a.csv").replace("0.56", "60"), "(60 % is 0.6)"),
    "oil level as a list": manifest(HEAD + RECORD.format("a.csv").replace("0.56", "[1]"), "oil_level = [1]: must be"),
    "preload 1.5": manifest(HEAD + RECORD.format("a.csv").replace("false", "1.5"), "must be true (present), false (lost), a share"),
    "measurement as a list": manifest(HEAD + RECORD.format("a.csv").replace('"harmonic"', "[]"), "measurement = []: must be"),
    "state with a blank of no width": manifest(HEAD + RECORD.format("a.csv") + 'state = "a\\u200b"\n', "state = 'a\\u200b': must be"),
    "reference as a text": manifest(HEAD + RECORD.format("a.csv") + 'reference = "yes"\n', "reference = 'yes': must be"),
    "reference_s nan": manifest(HEAD + RECORD.format("a.csv") + "reference_s = [0, nan]\n", "reference_s = [0, nan]: must be"),
    "split as a table": manifest(HEAD + RECORD.format("a.csv") + "split = {}\n", "split = {}: must be"),
    "power tower as a pressure": manifest(HEAD + RECORD.format("a.csv") + 'gas_pressure = "9**9**9 bar"\n', "must be a gauge"),
    "power tower as a scale": manifest(HEAD + 'channels = {force = {scale = "1 9**9**9/V"}}\n', "must be like '500 N/V'"),
    "a column that is a list": manifest(HEAD + "channels = {force = {column = [1]}}\n", "must be the name of a column"),
    "5000 windows": manifest(HEAD + RECORD.format("a.csv") + f"exclude = {[[0, 1]] * MANY}\n", "at most 1000"),
    "a window from nan": manifest(HEAD + RECORD.format("a.csv") + "exclude = [[nan, 1]]\n", "must be a list like"),
    "start inf": manifest(HEAD + RECORD.format("a.csv") + "start_s = inf\n", "start_s = inf: must be a time"),
    "sample rate inf": manifest(HEAD + "sample_rate_Hz = inf\n", "sample_rate_Hz = inf: must be a number"),
    "sign 1.5": manifest(HEAD + "force_sign = 1.5\n", "force_sign = 1.5: must be 1 or -1"),
    "sign as a list": manifest(HEAD + "force_sign = [1]\n", "force_sign = [1]: must be 1 or -1"),
    "delimiter of a line feed": manifest(HEAD + 'delimiter = "\\n"\n', "must be one character"),
    "delimiter of a quote": manifest(HEAD + "delimiter = '\"'\n", "must be one character"),
    "decimal as a number": manifest(HEAD + "decimal = 1\n", "decimal = 1: must be '.' or ','"),
    "offset inf": manifest(HEAD + "stroke_offset = 'inf m'\n", "stroke_offset"),
    "offset 1e300 m": manifest(HEAD + "stroke_offset = '1e300 m'\n", "stroke_offset"),
    "temperature as a date": manifest(HEAD + RECORD.format("a.csv") + "start_temperature_degC = 2020-01-01\n", "must be from"),
    "columns as a number": manifest(HEAD + "columns = 1\n", "columns = 1: must be a list of headers"),
    "columns of numbers": manifest(HEAD + "columns = [1, 2]\n", "must be a list of headers"),
    "5000 columns": manifest(HEAD + f"columns = {[f'c{i}' for i in range(MANY)]}\n", "must be a list of headers"),
    "a pipe": manifest(fifo, "a pipe or a device"),
}  # fmt: skip

DAMPERS = {
    "empty": file_of("damper", "", "start from a complete file"),
    "one group": file_of("damper", "[geometry]\nD_a = 0.04\n", "twintube dampers SA8 > mine.toml"),
    "binary": file_of("damper", bytes(range(256)), "x.toml: "),
    "pipe": file_of("damper", fifo, "a pipe or a device"),
    "2 MB": file_of("damper", "# " + "x" * 2_000_000, "at most 1 MB"),
    "foam = 1": file_of("damper", "foam = 1\n" + DAMPER.replace("[foam]", "[fom]"), "foam = 1: must be a table"),
    "fv = 1": file_of("damper", "fv = 1\n", "fv = 1: must be a table [fv]"),
    "sources = 1": file_of("damper", "sources = 1\n", "sources = 1: must be a table"),
    "a source as a number": damper("[sources]", "[sources]\nx = 1", "sources.x = 1: must be a text"),
    "an assumption as a list": damper("[assumed]", "[assumed]\nx = []", "assumed.x = []: must be a text"),
    "name as a number": damper('name = "SA8"', "name = 8", "name = 8: must be a text"),
    "name as a table": damper('name = "SA8"', "name = {}", "name = {}: must be a text"),
    "name of 5000 letters": damper('name = "SA8"', f'name = "{"x" * 5000}"', "at most 200 characters"),
    "name of two lines": damper('name = "SA8"', 'name = "a\\nb"', "must be a text of one line"),
    "NUL in the name": damper('name = "SA8"', 'name = "a\\u0000b"', "control characters"),
    "escape in the name": damper('name = "SA8"', 'name = "\\u001b]0;x\\u0007"', "control characters"),
    "preload inf": damper("gas_preload = 1.0", "gas_preload = inf", "gas_preload = inf: must be a number from 0 to 1"),
    "preload nan": damper("gas_preload = 1.0", "gas_preload = nan", "gas_preload = nan: must be a number from 0 to 1"),
    "preload 1.5": damper("gas_preload = 1.0", "gas_preload = 1.5", "gas_preload = 1.5: must be a number from 0 to 1"),
    "preload 1e300": damper("gas_preload = 1.0", "gas_preload = 1e300", "gas_preload = 1e+300: must be a number from 0 to 1"),
    "measured_oil = 1": damper("measured_oil = ", "measured_oil = 1 # ", "measured_oil: 1 must be a list"),
    "measured_oil nan": damper("measured_oil = [", "measured_oil = [nan, ", "measured_oil = nan m3: must be a number from 0"),
    "measured_oil -1": damper("measured_oil = [", "measured_oil = [-1, ", "measured_oil = -1 m3: must be a number from 0"),
    "measured_oil 1e308": damper("measured_oil = [", "measured_oil = [1e308, ", "measured_oil = 1e+308 m3: must be a number"),
    "measured_oil of 5000": damper("measured_oil = [", f"measured_oil = [{'0.0001, ' * MANY}", "a list of at most 20 volumes"),
    "measured_amplitude inf": damper("measured_amplitude = 0.045", "measured_amplitude = inf", "measured_amplitude = inf m"),
    "measured_amplitude -1": damper("measured_amplitude = 0.045", "measured_amplitude = -1", "measured_amplitude = -1 m"),
    "measured_amplitude []": damper("measured_amplitude = 0.045", "measured_amplitude = []", "measured_amplitude: []"),
    "a value as a table": damper("D_li = 0.0298", "D_li = {}", "geometry.D_li: {} is not a number"),
    "a value as a list": damper("D_li = 0.0298", "D_li = [1]", "geometry.D_li: [1] is not a number"),
    "a value as a date": damper("D_li = 0.0298", "D_li = 2020-01-01", "is not a number"),
    "a value of 5000 digits": damper("D_li = 0.0298", f"D_li = {'9' * 5000}", "mine.toml: "),
    "a value of 1300 digits in hexadecimal": damper("D_li = 0.0298", f"D_li = 0x{'f' * 1300}", "more than 64 bits"),
    "nan": damper("D_li = 0.0298", "D_li = nan", "geometry.D_li = nan m: must be a number from"),
    "-inf": damper("D_li = 0.0298", "D_li = -inf", "geometry.D_li = -inf m: must be a number from"),
    "5000 unknown keys": damper("[geometry]", "[geometry]\n" + "".join(f"k{i} = 1\n" for i in range(MANY)), "more unknown keys"),
    "5000 unknown tables": file_of("damper", "".join(f"[t{i}]\n" for i in range(MANY)), "more unknown keys"),
    "unit as a number": damper("[fv]", "[fv]\nvelocity_unit = 1", "fv: 1 is not a unit like 'm/s'"),
    "unit of a tower": damper("[fv]", "[fv]\nvelocity_unit = '9**9**9'", "fv: '1 9**9**9' is not a quantity in m/s"),
    "curve of texts": damper("rebound = [\n", 'rebound = [\n["a", "b"],\n', "must be a list of [velocity, force] pairs"),
    "curve of 5000 points": damper("rebound = [\n", "rebound = [\n" + "[1, 1],\n" * MANY, "points, must be from 2 to 20"),
    "curve of infinite force": damper("rebound = [\n", "rebound = [[0.1, 1], [0.2, inf]]\nother = [\n", "fv."),
    "curve of nan": damper("rebound = [\n", "rebound = [[0.1, 1], [nan, 2]]\nother = [\n", "fv."),
    "curve of 1e308": damper("rebound = [\n", "rebound = [[1e307, 1e307], [1e308, 1e308]]\nother = [\n", "fv."),
}  # fmt: skip

CARS = {
    "empty": file_of("car", "", "the table front is missing"),
    "binary": file_of("car", bytes(range(256)), "x.toml: "),
    "pipe": file_of("car", fifo, "a pipe or a device"),
    "front = 1": file_of("car", "front = 1\n" + CAR.replace("[front]", "[frnt]"), "front = 1: must be a table"),
    "band = 1": file_of("car", "band = 1\n" + CAR.replace("[band]", "[bnd]"), "band = 1: must be a table"),
    "sources as numbers": car("[sources]", "[sources]\nx = 1", "sources.x = 1: must be a text"),
    "name as a number": car('name = "passat_b8"', "name = 1", "name = 1: must be a text"),
    "escape in the title": car('title = "', 'title = "\\u001b[2J', "control characters"),
    "mass in mm": car('"405 kg"', '"405 mm"', "'405 mm' is not a quantity in kg"),
    "mass nan": car('"405 kg"', "nan", "front.m_body = nan kg"),
    "mass of a tower": car('"405 kg"', '"9**9**9 kg"', "is not a quantity in kg"),
    "mass 1/0": car('"405 kg"', '"1/0 kg"', "is not a quantity in kg"),
    "ratio inf": car("ratio = 0.98", "ratio = inf", "front.ratio = inf"),
    "band of three": car("ratio = [0.8, 1.0]", "ratio = [0.8, 1.0, 2.0]", "band.ratio: must be [smallest, largest]"),
    "band turned round": car("ratio = [0.8, 1.0]", "ratio = [1.0, 0.8]", "band.ratio: 1 must not be above 0.8"),
    "band of lists": car("ratio = [0.8, 1.0]", "ratio = [[], []]", "is not a number"),
    "5000 unknown keys": car("[front]", "[front]\n" + "".join(f"k{i} = 1\n" for i in range(MANY)), "more unknown keys"),
}  # fmt: skip

STUDIES = {
    "empty": study("", "dampers is missing"),
    "binary": file_of("study", bytes(range(256)), "x.toml: "),
    "pipe": file_of("study", fifo, "a pipe or a device"),
    "dampers = 1": study("dampers = 1\n", "must be a list of at least one string"),
    "names of one damper": study('dampers = ["SA8", "mine.toml"]\n', "2 of them are named SA8", mine_toml=DAMPER),
    "5000 dampers": study(f"dampers = {[f'd{i}' for i in range(MANY)]}\n", "5000 names, at most 1000"),
    "a damper that is a pipe": study('dampers = ["p.toml"]\n', "a pipe or a device", p_toml=fifo),
    "title as a table": study(STUDY + "title = {}\n", "title = {}: must be a text"),
    "count = 1e9": study(STUDY.replace("[0.6]", "{from = 0, to = 1, count = 1000000000}"), "count = 1000000000: must be"),
    "count as a text": study(STUDY.replace("[0.6]", "{from = 0, to = 1, count = 'a'}"), "count = 'a': must be"),
    "range to infinity": study(STUDY.replace("[0.6]", "{from = 0, to = inf, count = 5}"), "must be finite"),
    "range of lists": study(STUDY.replace("[0.6]", "{from = [], to = 1, count = 5}"), "is not a number"),
    "50,000 values": study(STUDY.replace("[0.6]", str([i / 50_000 for i in range(50_000)])), "50000 values, at most 10000"),
    "1e8 cases": study(STUDY.replace("[0.6]", "{from = 0, to = 1, count = 10000}").replace(
        "velocity = 0.5", "velocity = {from = 1, to = 2, count = 10000}"), "the grid has 100000000 cases"),
    "1e8 blocks": study(STUDY.replace("velocity = 0.5", "velocity = {from = 1, to = 2, count = 10000}\n"
                                      "amplitude = {from = 0.001, to = 0.002, count = 10000}"), "the grid has 100000000 cases"),
    "a million geometries": study(STUDY + "[parameters]\n'geometry.V_oil' = {from = 0.0002, to = 0.0003, count = 10000}\n"
                                  "'geometry.D_a' = {from = 0.04, to = 0.05, count = 50}\n", "500000 geometries, at most 10000"),
    "oil level 60": study(STUDY.replace("0.6", "60"), "oil_level = 60: must be a number from 0 to 1"),
    "preload 1.5": study(STUDY + "gas_preload = [1.5]\n", "gas_preload = 1.5: must be"),
    "velocity of a tower": study(STUDY.replace("0.5", "'9**9**9 m/s'"), "is not a quantity in m/s"),
    "velocity of 5000 digits": study(STUDY.replace("velocity = 0.5", f"velocity = {'9' * 5000}"), "x.toml: "),
    "block of an hour": study(STUDY.replace("velocity = 0.5", "velocity = 0.001\ntime_step = 1e-5"), "samples, at most"),
    "parameters = 1": study(STUDY + "parameters = 1\n", "parameters: must be a table"),
    "5000 parameters": study(STUDY + "[parameters]\n" + "".join(f"k{i} = 1\n" for i in range(MANY)), "and "),
    "5000 unknown keys": study(STUDY + "".join(f"k{i} = 1\n" for i in range(MANY)), "more unknown keys"),
    "deep parameters": study(STUDY + f"[parameters]\nx = {'{a = ' * 3000}1{'}' * 3000}\n", "within each other"),
    "a record that is a pipe": study(STUDY + 'records = ["p.csv"]\n', "a pipe or a device", p_csv=fifo),
    "a damaged record": study(STUDY + 'records = ["p.mat"]\n', "the file is damaged", p_mat=changed(144, 5)),
}  # fmt: skip

MATLAB = {
    "array class 5": dataset(changed(144, 5), "the file is damaged: its reader ended by SIGSEGV", name="a.mat"),
    "array class 0": dataset(changed(144, 0), "not a readable .mat file", name="a.mat"),
    "array class 2": dataset(changed(144, 2), "not a readable .mat file", name="a.mat"),
    "size of the array": dataset(changed(135, 0x7F), "a.mat: ", name="a.mat"),
    "version": dataset(changed(125, 9), "not a readable .mat file", name="a.mat"),
    "empty": dataset(b"", "not a readable .mat file", name="a.mat"),
    "text": dataset("no file of MATLAB", "not a readable .mat file", name="a.mat"),
    "texts for numbers": dataset(mat(time="a", stroke="b"), "no column 'time [s]'", name="a.mat"),
    "structs within structs": dataset(
        mat(a={"a": {"a": {"a": {"a": {"a": {"a": {"a": {"a": {"a": {"a": {"time": LINE}}}}}}}}}}}),
        "structs within structs", name="a.mat"),
    "70 million values in 70 kB": dataset(mat(time=np.zeros(70_000_000, np.int8)), "declares 70000000 values", name="a.mat"),
    "2000 variables": dataset(mat(**{f"v{i}": LINE[:2] for i in range(2000)}), "more than 1000 columns", name="a.mat"),
    "a pipe": dataset(fifo, "a pipe or a device", name="a.mat"),
}  # fmt: skip


def huge(file: Any) -> None:
    file.create_dataset("time", shape=(10**12,), dtype="f8", chunks=(1000,))


def wide(file: Any) -> None:
    for i in range(1500):
        file[f"v{i}"] = LINE[:2]


def elsewhere(file: Any) -> None:
    file.create_dataset("time", shape=(100,), dtype="f8", external=[("/dev/zero", 0, 800)])


def deep(file: Any) -> None:
    file["/".join("g" * 300) + "/time"] = LINE


HDF5 = {
    "declared 8 TB": dataset(hdf5(huge), "declares 1000000000000 values", name="a.mat"),
    "1500 variables": dataset(hdf5(wide), "more than 1000 columns", name="a.mat"),
    "values of another file": dataset(hdf5(elsewhere), "has its values in another file", name="a.mat"),
    "300 groups": dataset(hdf5(deep), "a column's name has", name="a.mat"),
    "only the signature": dataset(b"\x89HDF\r\n\x1a\n", "not a readable .mat file", name="a.mat"),
    "signature and zeros": dataset(b"\x89HDF\r\n\x1a\n" + bytes(5000), "not a readable .mat file", name="a.mat"),
    "empty group": dataset(hdf5(lambda file: file.create_group("x")), "no column 'time [s]'", name="a.mat"),
}

PARQUET = {
    "cut": dataset(parquet(GOOD, cut=100), "not a readable .parquet file", name="a.parquet"),
    "empty": dataset(b"", "not a readable .parquet file", name="a.parquet"),
    "magic alone": dataset(b"PAR1PAR1", "not a readable .parquet file", name="a.parquet"),
    "footer of 2 GB": dataset(b"PAR1" + bytes(100) + b"\xff\xff\xff\x7fPAR1", "not a readable .parquet file", name="a.parquet"),
    "texts": dataset(parquet(GOOD | {"stroke [mm]": ["x"] * 301}), "holds string, must hold numbers", name="a.parquet"),
    "lists": dataset(parquet(GOOD | {"stroke [mm]": [[1.0]] * 301}), "must hold numbers", name="a.parquet"),
    "structs": dataset(parquet(GOOD | {"stroke [mm]": [{"a": [{"b": 1}]}] * 301}), "must hold numbers", name="a.parquet"),
    "switches": dataset(parquet(GOOD | {"stroke [mm]": [True] * 301}), "must hold numbers", name="a.parquet"),
    "nothing": dataset(parquet(GOOD | {"stroke [mm]": [None] * 301}), "must hold numbers", name="a.parquet"),
    "a cell of nothing": dataset(parquet(GOOD | {"stroke [mm]": [None, *[1.0] * 300]}), "the cell is empty", name="a.parquet"),
    "2000 columns": dataset(parquet({f"c{i}": [1.0] for i in range(2000)}), "2000 columns, at most 1000", name="a.parquet"),
    "a long name": dataset(parquet({"n" * 5000: [1.0]}), "name has 5000 characters", name="a.parquet"),
    "no rows": dataset(parquet({name: [] for name in GOOD}), "must hold numbers", name="a.parquet"),
}  # fmt: skip

MDF = {
    "empty": dataset(b"", "not a readable .mf4 file", name="a.mf4"),
    "text": dataset("MDF     4.10 but nothing else", "not a readable .mf4 file", name="a.mf4"),
    "zeros": dataset(bytes(5000), "not a readable .mf4 file", name="a.mf4"),
    "damaged header": dataset(mf4(changed_byte(70)), "a.mf4: ", name="a.mf4"),
    "damaged links": dataset(mf4(changed_byte(90)), "a.mf4: ", name="a.mf4"),
    "a pipe": dataset(fifo, "a pipe or a device", name="a.mf4"),
}

WORKBOOKS = {
    "empty": dataset(b"", "not a readable .xlsx file", name="a.xlsx"),
    "text": dataset(CSV, "not a readable .xlsx file", name="a.xlsx"),
    "a ZIP archive cut": dataset(b"PK\x03\x04" + bytes(100), "not a readable .xlsx file", name="a.xlsx"),
    "an old one of zeros": dataset(bytes.fromhex("d0cf11e0a1b11ae1") + bytes(2000), "a.xls: ", name="a.xls"),
    "a pipe": dataset(fifo, "a pipe or a device", name="a.xlsx"),
}

JSON = {
    "empty": dataset("", "not a readable .json file", name="a.json"),
    "cut": dataset('{"time [s]": [0, 1', "not a readable .json file", name="a.json"),
    "UTF-16": dataset('{"time [s]": [0, 1]}'.encode("utf-16"), "not a readable .json file", name="a.json"),
    "a number": dataset("1", "no table: must be lists by name", name="a.json"),
    "lists within lists": dataset("[" * 100_000 + "]" * 100_000, "not a readable .json file", name="a.json"),
    "tables within tables": dataset('{"a":' * 500 + "1" + "}" * 500, "no table: must be lists by name", name="a.json"),
    "2000 columns": dataset("{" + ",".join(f'"c{i}": [1]' for i in range(2000)) + "}", "more than 1000 columns", name="a.json"),
    "switches": dataset('{"time [s]": [true, false]}', "holds bool, must hold numbers", name="a.json"),
    "5000 digits": dataset('{"time [s]": [0, ' + "9" * 5000 + "]}", "not a readable .json file", name="a.json"),
    "NaN": dataset('{"time [s]": [0, NaN], "stroke [mm]": [1, 2], "force [N]": [1, 2]}', "nan is not a finite number", name="a.json"),
    "rows of other lengths": dataset('{"columns": ["time [s]", "b"], "data": [[1]]}', "rows of other lengths", name="a.json"),
}  # fmt: skip

PIPES = {
    "record": record(fifo, "a pipe or a device"),
    "record of a dataset": dataset(fifo, "a pipe or a device"),
    "/dev/zero as a record": words("unknown format", "simulate", "SA8", "--record", "/dev/zero"),
    "/dev/zero as a damper": words("a pipe or a device", "simulate", "/dev/zero"),
    "/dev/zero as a study": words("a pipe or a device", "study", "/dev/zero"),
    "/dev/zero as a car": words("a pipe or a device", "ride", "SA8", "--car", "/dev/zero"),
    "a folder as a damper": words("it is a folder", "dampers", "{}"),
    "a folder as a study": words("it is a folder", "study", "{}"),
    "a folder as a record": words("unknown format", "simulate", "SA8", "--record", "{}"),
    "a folder without dataset.toml": words("twintube new-dataset", "check", "{}"),
    "a dataset that is a pipe": Hostile(("check", "{}/dataset.toml"), "a pipe or a device", {"dataset.toml": fifo}),
}

ARGUMENTS = {
    "unknown damper": words("did you mean SA8?", "dampers", "sa8"),
    "damper of 5000 letters": words("File name too long", "dampers", "x" * 5000),
    "damper with escape": words("control character", "dampers", f"{ESC}x"),
    "empty damper": words("it is a folder", "dampers", ""),
    "oil level 60": words("(60 % is 0.6)", "simulate", "SA8", "--oil-level", "60"),
    "oil level nan": words("oil_level = nan", "simulate", "SA8", "--oil-level", "nan"),
    "oil level inf": words("oil_level = inf", "simulate", "SA8", "--oil-level", "inf"),
    "oil level as a text": words("Invalid value for '--oil-level'", "simulate", "SA8", "--oil-level", "much"),
    "velocity nan": words("velocity = nan", "simulate", "SA8", "--velocity", "nan"),
    "velocity 1e308": words("velocity = 1e+308", "simulate", "SA8", "--velocity", "1e308"),
    "velocity -1": words("velocity = -1", "simulate", "SA8", "--velocity", "-1"),
    "block of an hour": words("takes 283 s", "simulate", "SA8", "--velocity", "0.001"),
    "amplitude inf": words("amplitude = inf", "simulate", "SA8", "--amplitude-mm", "inf"),
    "amplitude beyond the tube": words("stroke = ", "simulate", "SA8", "--amplitude-mm", "400"),
    "output in a missing folder": words("does not exist", "simulate", "SA8", "--output", "{}/a/b/c.csv"),
    "output in a file": Hostile(("simulate", "SA8", "--output", "{}/f/c.csv"), "is not a folder", {"f": "x"}),
    "rig into a missing folder": words("does not exist", "paper", "rig", "SA8", "--output", "{}/a/b/c"),
    "study into a missing folder": words("does not exist", "study", "variants", "--output", "{}/a/b/c.parquet"),
    "ssv into a missing folder": words("does not exist", "fmu", "--ssv", "SA8", "--output", "{}/a/b/c.ssv"),
    "negative seed": words("Invalid value for '--seed'", "paper", "rig", "SA8", "--seed", "-1"),
    "no processes": words("processes = 0: must be at least 1", "study", "variants", "--processes", "0", "--output", "{}/o.parquet"),
    "unknown study": words("did you mean variants?", "study", "variant", "--output", "{}/o.parquet"),
    "unknown command": words("No such command", "simulat"),
    "unknown option": words("No such option", "simulate", "SA8", "--oil", "1"),
    "reading of a text": words("must be NAME=NUMBER", "paper", "claims", "--reading", "leak_carries_oil=x"),
    "reading inf": words("must be NAME=NUMBER", "paper", "claims", "--reading", "leak_carries_oil=inf"),
    "unknown start": words("--start x: must be one of", "paper", "calibrate", "SA8", "--start", "x"),
    "unknown car": words("unknown car x", "ride", "SA8", "--car", "x"),
    "speed 0": words("Invalid value for '--speed'", "ride", "SA8", "--speed", "0"),
    "no dataset": words("no such folder", "identify", "nowhere", "--output", "{}/o"),
    "unknown method": words("--method x", "identify", "nowhere", "--method", "x", "--output", "{}/o"),
}  # fmt: skip

KINDS = {
    "CSV": CSV_FILES,
    "units": UNITS,
    "encodings": ENCODINGS,
    "dataset.toml": MANIFESTS,
    "dampers": DAMPERS,
    "cars": CARS,
    "studies": STUDIES,
    "MATLAB": MATLAB,
    "HDF5": HDF5,
    "Parquet": PARQUET,
    "MDF": MDF,
    "workbooks": WORKBOOKS,
    "JSON": JSON,
    "pipes and folders": PIPES,
    "arguments": ARGUMENTS,
}
