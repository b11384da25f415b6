"""The folder of a study.

    study.results/
        study.json        what the study is: definition, check sum, version of plydrape
        rows/             one part-FIRST.parquet for the scenarios of each second or so
        study.parquet     all rows in order            } when all are done
        summary.json      their summary                }

Every file is written whole or not at all: under a hidden name, brought to the disk, renamed.
What is in `rows/` is done; nothing else is remembered. What the name of a part says is compared
with its rows, and the rows with the study. Only one process at a time may work in the folder. A
folder that holds anything else is refused.
"""

from __future__ import annotations

import contextlib
import errno
import json
import os
import re
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import plydrape

from .definition import Study
from .error import StudyError
from .scenario import Line, unit

if TYPE_CHECKING:
    import pyarrow as pa

NAME = "study.json"
LOCK = ".lock"
# The files of a finished study.
FINISHED = ("study.parquet", "summary.json")
PART = re.compile(r"part-(\d+)\.parquet")
# What closes a row; everything else is in the order in which it was measured.
LAST = ("seed", "version", "error", "error_kind")
OTHER = "choose another folder with -o, or move this one away"
REMOVE = "remove it: its scenarios are then run again"
# What the system says where room is lacking: no space, quota, largest file.
FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


class Folder:
    """The folder of a study that is being run."""

    def __init__(self, path: Path) -> None:
        """Nothing is touched yet."""
        self.path = path
        self.rows = path / "rows"
        self._lock: IO[bytes] | None = None

    def begin(self, study: Study) -> None:
        """Makes the folder, or takes it up again.

        Raises
        ------
        StudyError
            It holds another study, or something else, or is in use.

        """
        manifest = self.path / NAME
        try:
            found = {entry.name for entry in self.path.iterdir()} if self.path.is_dir() else set()
            # A study that was cut off before its first file leaves these.
            if not manifest.is_file() and found - {LOCK, "rows", f".{NAME}.tmp"}:
                raise StudyError(f"`{self.path}` is not empty, and no study's folder", help=OTHER)
            self.rows.mkdir(parents=True, exist_ok=True)
            self._hold()
            if manifest.is_file():
                self._compare(study)
            else:
                write(manifest, text(described(study)))
            for rest in self.rows.glob(".*.tmp"):
                rest.unlink()
        except OSError as error:
            why = error.strerror or error
            raise StudyError(f"`{self.path}` cannot be used: {why}", help=OTHER) from error

    def _compare(self, study: Study) -> None:
        """Refuses a folder whose rows are not of this study."""
        earlier = read_manifest(self.path)
        program = f"plydrape {plydrape.__version__}"
        if earlier.get("program") != program:
            raise StudyError(
                f"`{self.path}` was begun with {earlier.get('program')}, and this is {program}",
                help=f"go on with that version, or {OTHER}",
            )
        if earlier.get("checksum") != study.checksum:
            changed = differing(earlier.get("definition", {}), study.described())
            raise StudyError(
                f"`{self.path}` holds rows of another definition: "
                f"{', '.join(changed) or 'the sample'} changed since",
                help=OTHER,
            )

    def _hold(self) -> None:
        """Keeps others out until this process ends, however it ends."""
        self._lock = open(self.path / LOCK, "ab")  # noqa: SIM115
        try:
            import fcntl
        except ImportError:  # Windows has no such lock.
            return
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise StudyError(
                f"another process is running a study in `{self.path}`",
                help="wait for it, or end it",
            ) from error

    def parts(self, columns: list[str] | None = None) -> list[tuple[Path, pa.Table]]:
        """Finished rows, or some of their columns, by the file that has them.

        Raises
        ------
        StudyError
            One is damaged, has other scenarios than its name says, or those of another one.

        """
        found: list[tuple[Path, pa.Table]] = []
        holders: dict[int, Path] = {}
        for path in sorted(p for p in self.rows.glob("*.parquet") if PART.fullmatch(p.name)):
            rows = read_part(path, columns)
            for scenario in rows["scenario"].to_pylist():
                if scenario in holders:
                    raise StudyError(
                        f"`{path}` and `{holders[scenario].name}` hold the same scenario, "
                        f"{scenario}",
                        help="remove one of them",
                    )
                holders[scenario] = path
            found.append((path, rows))
        return found

    def keep(self, rows: list[Line], study: Study) -> None:
        """Writes the part file of finished scenarios."""
        rows = sorted(rows, key=lambda row: int(row["scenario"] or 0))
        write(self.rows / f"part-{rows[0]['scenario']:06}.parquet", content(table(rows, study)))

    def close(self) -> None:
        """Lets others in."""
        if self._lock is not None:
            self._lock.close()


def read_part(path: Path, columns: list[str] | None = None) -> pa.Table:
    """The rows of a part file, or some of their columns.

    Raises
    ------
    StudyError
        It is damaged, or begins with another scenario than its name says.

    """
    import pyarrow.parquet as pq

    try:
        rows = pq.ParquetFile(path).read(columns)
        scenarios = rows["scenario"].to_pylist()
        absent = [name for name in LAST if not columns and name not in rows.column_names]
        if absent:
            raise KeyError(f"it has no column {absent[0]}")
        if not scenarios or None in scenarios:
            raise ValueError("it has no rows, or one without a scenario")
    except MemoryError:
        raise
    except Exception as error:
        raise StudyError(f"`{path}` cannot be read: {error}", help=REMOVE) from error
    name = PART.fullmatch(path.name)
    if name is None or int(name[1]) != scenarios[0]:
        raise StudyError(
            f"`{path}` begins with scenario {scenarios[0]}, and not as its name says", help=REMOVE
        )
    return rows


def table(rows: list[Line], study: Study) -> pa.Table:
    """Rows as a table; a column's unit is in its field's metadata as `unit`."""
    import pyarrow as pa

    names = list(dict.fromkeys(name for row in rows for name in row if name not in LAST))
    # Columns that may be empty have their types all the same.
    types = dict.fromkeys(("stopped", "error", "error_kind"), pa.string())
    columns = {
        name: pa.array([row.get(name) for row in rows], types.get(name)) for name in (*names, *LAST)
    }
    units = {name: unit(name, study.inputs) for name in columns}
    fields = [
        pa.field(name, column.type, metadata={"unit": units[name]} if units[name] else None)
        for name, column in columns.items()
    ]
    return pa.Table.from_arrays(list(columns.values()), schema=pa.schema(fields))


def joined(tables: list[pa.Table]) -> pa.Table:
    """Parts as one table in the order of its scenarios.

    A part whose scenarios all failed lacks the measures; they are empty there.

    Raises
    ------
    StudyError
        A column has different types in them.

    """
    import pyarrow as pa

    # Columns are in the order of the first part with the most of them.
    fullest = max(tables, key=lambda part: part.num_columns)
    try:
        whole = pa.concat_tables([fullest.slice(0, 0), *tables], promote_options="permissive")
    except pa.ArrowException as error:
        raise StudyError(
            f"the parts in `rows` do not fit together: {error}",
            help="remove those that are not of this study: their scenarios are then run again",
        ) from error
    first = [name for name in whole.column_names if name not in LAST]
    return whole.select([*first, *LAST]).sort_by("scenario").combine_chunks()


def content(rows: pa.Table) -> bytes:
    """The table as the bytes of a Parquet file; the same table, the same bytes."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    sink = pa.BufferOutputStream()
    pq.write_table(rows, sink, compression="zstd")
    return bytes(memoryview(sink.getvalue()))


def described(study: Study) -> dict[str, Any]:
    """The content of study.json."""
    return {
        "format": "plydrape-study",
        "version": 2,
        "program": f"plydrape {plydrape.__version__}",
        "checksum": study.checksum,
        "definition": study.described(),
    }


def read_manifest(path: Path) -> dict[str, Any]:
    """The content of a folder's study.json.

    Raises
    ------
    StudyError
        There is none, or plydrape did not write it.

    """
    try:
        manifest = json.loads((path / NAME).read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise StudyError(f"`{path}` is no study's folder: it has no {NAME}", help=OTHER) from error
    except (OSError, ValueError, RecursionError) as error:
        raise StudyError(f"`{path / NAME}` cannot be read: {error}", help=OTHER) from error
    if not isinstance(manifest, dict) or manifest.get("format") != "plydrape-study":
        raise StudyError(f"`{path / NAME}` is no study of plydrape", help=OTHER)
    definition = manifest.get("definition")
    if not isinstance(definition, dict) or not isinstance(definition.get("title"), str):
        raise StudyError(f"`{path / NAME}` has no definition of a study", help=OTHER)
    return manifest


def differing(earlier: Any, now: Any, path: str = "") -> list[str]:
    """The paths at which two definitions differ, at most five.

    Examples
    --------
    >>> differing({"seed": 1, "scene": {"a": 1}}, {"seed": 2, "scene": {"a": 1}})
    ['`seed`']

    """
    if not (isinstance(earlier, dict) and isinstance(now, dict)):
        return [] if earlier == now else [f"`{path}`"]
    found: list[str] = []
    for key in dict.fromkeys([*now, *earlier]):
        inner = f"{path}.{key}" if path else key
        if key in now and key in earlier:
            found += differing(earlier[key], now[key], inner)
        else:
            found.append(f"`{inner}`")
    return found[:5]


def text(value: Any) -> bytes:
    """A value as indented JSON with a line feed."""
    return (json.dumps(value, indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode()


def write(path: Path, content: bytes) -> None:
    """Writes a file whole or not at all; it may replace an earlier one.

    Raises
    ------
    StudyError
        It cannot be written; nothing is left of it.

    """
    hidden = path.with_name(f".{path.name}.tmp")
    try:
        with open(hidden, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(hidden, path)
    except BaseException as error:  # Ctrl-C too leaves nothing half.
        with contextlib.suppress(OSError):
            hidden.unlink(missing_ok=True)
        if not isinstance(error, OSError):
            raise
        remedy = "make room" if error.errno in FULL else "make the folder one that can be written"
        raise StudyError(
            f"`{path}` cannot be written: {error.strerror or error}",
            help=f"{remedy} and run the same command again, which goes on: finished rows are "
            "kept; or choose another folder with -o",
        ) from error
    # The new name is on the disk too; not every system lets a folder be opened.
    with contextlib.suppress(OSError):
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)
