"""Rows as Parquet: one type for each column, whatever a part of the study happens to hold."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from .error import StudyError
from .law import Input
from .scenario import Line

INTEGERS = {
    "scenario",
    "seed",
    "steps",
    "steps_planned",
    "first_contact_step",
    "evaluations",
    "catenaries.first_shear_step",
    "catenaries.all_shear_step",
    "catenaries.equilibria",
    "sheet.nodes",
    "sheet.time_steps",
    "sheet.solves",
}
BOOLEANS = {"accepted", "converged"}
TEXTS = {"version", "model", "status", "stopped", "error", "error_kind"}
# What closes a row; everything else stands in the order in which it was measured.
LAST = ("seed", "version", "error", "error_kind")


def column_type(name: str, inputs: Iterable[Input]) -> pa.DataType:
    """The type of a column.

    Examples
    --------
    >>> column_type("accepted", ()), column_type("worst_slack_mm", ())
    (DataType(bool), DataType(double))

    """
    for x in inputs:
        if x.key == name:
            if not x.numeric:
                return pa.bool_() if isinstance(x.law.at(0.5), bool) else pa.string()
            return pa.int64() if x.whole else pa.float64()
    if name in INTEGERS:
        return pa.int64()
    if name in BOOLEANS or name.startswith("ok_"):
        return pa.bool_()
    return pa.string() if name in TEXTS else pa.float64()


def table(rows: list[Line], units: dict[str, str], inputs: tuple[Input, ...]) -> pa.Table:
    """Rows as a table; a column's unit stands in its field's metadata as `unit`."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    names = [name for name in names if name not in LAST] + list(LAST)
    fields = [
        pa.field(
            name,
            column_type(name, inputs),
            metadata={"unit": units[name]} if name in units else None,
        )
        for name in names
    ]
    columns = [pa.array([row.get(f.name) for row in rows], f.type) for f in fields]
    return pa.Table.from_arrays(columns, schema=pa.schema(fields))


def joined(tables: list[pa.Table]) -> pa.Table:
    """Parts as one table in the order of its scenarios.

    A part whose scenarios all failed lacks the measures; they are empty there.

    Raises
    ------
    StudyError
        a column has different types in them.

    """
    tables = sorted(tables, key=lambda part: part["scenario"][0].as_py())
    # Columns stand as the first part that drapes has them.
    fullest = max(tables, key=lambda part: part.num_columns)
    try:
        whole = pa.concat_tables([fullest.slice(0, 0), *tables], promote_options="default")
    except pa.ArrowException as error:
        raise StudyError(
            f"the parts in `rows` do not fit together: {error}",
            help="remove those that are not of this study: their scenarios are then run again",
        ) from error
    first = [name for name in whole.column_names if name not in LAST]
    return whole.select([*first, *LAST]).combine_chunks()


def units(rows: pa.Table) -> dict[str, str]:
    """Units of the columns that have one."""
    return {
        field.name: field.metadata[b"unit"].decode()
        for field in rows.schema
        if field.metadata and b"unit" in field.metadata
    }


def content(rows: pa.Table) -> bytes:
    """The table as the bytes of a Parquet file; the same table, the same bytes."""
    sink = pa.BufferOutputStream()
    pq.write_table(rows, sink, compression="zstd")
    return bytes(memoryview(sink.getvalue()))


def read(path: Any, columns: list[str] | None = None) -> pa.Table:
    """A table of a Parquet file, or some of its columns.

    Raises
    ------
    OSError
        It cannot be read.
    pyarrow.ArrowInvalid
        It is no Parquet.

    """
    return pq.ParquetFile(path).read(columns)
