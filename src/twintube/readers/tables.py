"""Parquet, workbooks and JSON."""

import json
from pathlib import Path
from typing import Any

from twintube.readers.columns import MOST_COLUMNS, Columns, Request, UnreadableError

MOST_CELLS = 20_000_000  # of a sheet
DEEPEST = 3  # tables within tables of a JSON file


def parquet(path: str, _: Request) -> Columns:
    """Parquet, by its column names."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    columns = Columns()
    with pq.ParquetFile(path, memory_map=False) as file:
        rows = file.metadata.num_rows
        if rows < 0 or file.metadata.num_columns > MOST_COLUMNS:
            raise UnreadableError(f"{file.metadata.num_columns} columns, at most {MOST_COLUMNS} are read")
        for field in file.schema_arrow:
            kind = field.type
            number = pa.types.is_integer(kind) or pa.types.is_floating(kind) or pa.types.is_decimal(kind)
            columns.expect(field.name, rows if number else 0)
            if not number:
                columns.refused[field.name] = str(kind)[:60]
                continue
            column = file.read([field.name]).column(field.name).cast(pa.float64(), safe=False)
            columns.empty[field.name] = column.is_null().to_numpy()
            columns.values[field.name] = column.to_numpy()
    return columns


def workbook(path: str, request: Request) -> dict[str, Any]:
    """The rows of a sheet of a workbook, numbers, texts and None; where first rows are asked for, these of all sheets."""
    from python_calamine import CalamineWorkbook

    with CalamineWorkbook.from_path(path) as book:
        names = book.sheet_names
        sheet = request["sheet"] or names[0]
        if sheet not in names:
            raise UnreadableError(f"no sheet {sheet!r} among {', '.join(names)[:300]}")
        most, rows = request["first_rows"], {}
        for name in names if most else [sheet]:
            found = book.get_sheet_by_name(name)
            if found.total_height * found.total_width > MOST_CELLS:
                raise UnreadableError(f"sheet {name!r} has more than {MOST_CELLS} cells")
            cells = found.to_python(skip_empty_area=False, nrows=most)
            rows[name] = [[plain_cell(cell) for cell in row] for row in cells]
    return {"sheets": names, "sheet": sheet, "rows": rows}


def plain_cell(cell: Any) -> Any:
    """A number, a text or None; dates and times as ISO texts, durations in seconds."""
    if isinstance(cell, str):
        return cell if cell.strip() else None
    if isinstance(cell, bool):
        return str(cell)
    if hasattr(cell, "isoformat"):
        text = str(cell.isoformat())
        return text if ":" in text else f"{text}T00:00:00"  # midnight comes without its time
    return cell.total_seconds() if hasattr(cell, "total_seconds") else cell


def json_table(path: str, _: Request) -> Columns:
    """JSON: lists by name, a list of samples, or `columns` and `data`; a table within a table is looked for."""
    columns = Columns()
    collect(json.loads(Path(path).read_text(encoding="utf-8-sig")), columns, 0)
    if not columns.values and not columns.refused:
        raise UnreadableError("no table: must be lists by name, or a list of samples with names")
    return columns


def collect(content: Any, columns: Columns, depth: int) -> None:
    """Put the first table in `content` into `columns`."""
    if isinstance(content, list) and content and all(isinstance(sample, dict) for sample in content):
        for name in dict.fromkeys(name for sample in content for name in sample):
            columns.put(name, [sample.get(name) for sample in content])
        return
    if not isinstance(content, dict):
        return
    if collect_split(content, columns):
        return
    for name, item in content.items():
        values = item.get("values", item.get("data")) if isinstance(item, dict) else item
        if isinstance(values, list) and values and not any(isinstance(cell, (list, dict)) for cell in values):
            columns.put(name, values)
            if isinstance(item, dict) and isinstance(item.get("unit"), str):
                columns.units[name] = item["unit"][:60]
    if columns.values or columns.refused:
        units = content.get("units")
        if isinstance(units, dict):
            columns.units |= {name: str(unit)[:60] for name, unit in units.items() if name in columns.values}
        return
    for item in content.values():
        if depth < DEEPEST and not columns.values:
            collect(item, columns, depth + 1)


def collect_split(content: dict[str, Any], columns: Columns) -> bool:
    """Put a table of `columns` and `data` by rows, orient "split" of pandas, into `columns`; whether it is one."""
    names, rows = content.get("columns"), content.get("data")
    if not (isinstance(names, list) and isinstance(rows, list) and all(isinstance(row, list) for row in rows)):
        return False
    if any(len(row) != len(names) for row in rows):
        raise UnreadableError(f"`data` has rows of other lengths than `columns`, {len(names)}")
    for i, name in enumerate(names):
        columns.put(str(name), [row[i] for row in rows])
    return True
