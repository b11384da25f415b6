"""The folder of a study.

    study.results/
        study.json        what the study is: definition, check sum, version of plydrape
        rows/             one part-FIRST-LAST.parquet for each finished run of scenarios
        study.parquet     all rows in order            } when all are done
        summary.json      the figures of the page      }
        summary.html      the page                     }

Every file is written whole or not at all: under a hidden name, brought to the disk, renamed.
What stands in `rows/` is what is done; nothing else is remembered. What the name of a part says is
compared with its rows, here and in `run.py`. A file of the finished study that exists is never
written over. Only one process at a time may work in the folder. A folder that holds anything else
is refused.
"""

from __future__ import annotations

import contextlib
import errno
import json
import os
import re
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import IO, Any

import plydrape

from .definition import Study
from .error import StudyError

NAME = "study.json"
PART = re.compile(r"part-(?P<first>\d+)-(?P<last>\d+)\.parquet")
OTHER = "choose another folder with -o, or move this one away"


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
                whole(manifest, text(described(study)))
            for rest in self.rows.glob(".*.tmp"):
                rest.unlink()
        except OSError as error:
            why = error.strerror or error
            raise StudyError(f"`{self.path}` cannot be used: {why}", help=OTHER) from error

    def _compare(self, study: Study) -> None:
        """Refuses a folder whose rows are not of this study."""
        earlier = read_manifest(self.path)
        if earlier.get("program") != f"plydrape {plydrape.__version__}":
            raise StudyError(
                f"`{self.path}` was begun with {earlier.get('program')}, and this is "
                f"plydrape {plydrape.__version__}",
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

    def parts(self) -> list[tuple[int, int, Path]]:
        """Finished runs of scenarios: first, stop and file, in order.

        Raises
        ------
        StudyError
            Two of them hold the same scenario, or the name of one holds none.

        """
        found = sorted(_parts(self.rows))
        for first, stop, path in found:
            if stop <= first:
                raise StudyError(
                    f"`{path}`: the name ends with a scenario before its first", help="remove it"
                )
        for (_, stop, path), (first, _, other) in pairwise(found):
            if first < stop:
                raise StudyError(
                    f"`{path}` and `{other.name}` hold the same scenarios",
                    help="remove one of them",
                )
        return found

    def keep(self, first: int, rows: int, content: bytes) -> None:
        """Writes the part file of finished scenarios."""
        whole(self.rows / f"part-{first:06}-{first + rows - 1:06}.parquet", content)

    def missing(self) -> list[str]:
        """The files of the finished study that are not there."""
        return [name for name in FINISHED if not os.path.lexists(self.path / name)]

    def finish(self, contents: Mapping[str, bytes]) -> list[str]:
        """Writes files of the finished study; the names of those that were not there before.

        Raises
        ------
        StudyError
            One is there, and not what the rows give.

        """
        for name, content in contents.items():
            path = self.path / name
            if os.path.lexists(path) and not same(path, content):
                raise StudyError(
                    f"`{path}` is not what the rows give: it was changed, or made of earlier "
                    "rows; so it stays",
                    help="move it away and run the same command again: all rows are finished",
                )
        absent = [name for name in contents if name in self.missing()]
        for name in absent:
            whole(self.path / name, contents[name])
        return absent

    def close(self) -> None:
        """Lets others in."""
        if self._lock is not None:
            self._lock.close()


LOCK = ".lock"
# The files of a finished study.
FINISHED = ("study.parquet", "summary.json", "summary.html")
# What the system says where room is lacking: no space, quota, largest file.
FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


def _parts(rows: Path) -> Iterator[tuple[int, int, Path]]:
    for path in rows.glob("*.parquet") if rows.is_dir() else ():
        if name := PART.fullmatch(path.name):
            yield int(name["first"]), int(name["last"]) + 1, path


def missing(parts: list[tuple[int, int, Path]], total: int) -> list[tuple[int, int]]:
    """The ranges of scenarios, first and stop, that no part holds.

    Examples
    --------
    >>> missing([(2, 4, Path("a"))], 6)
    [(0, 2), (4, 6)]

    """
    gaps, at = [], 0
    for first, stop, _ in parts:
        gaps.append((at, first))
        at = stop
    gaps.append((at, total))
    return [(first, stop) for first, stop in gaps if first < stop]


def described(study: Study) -> dict[str, Any]:
    """The content of study.json."""
    return {
        "format": "plydrape-study",
        "version": 1,
        "program": f"plydrape {plydrape.__version__}",
        "checksum": study.checksum,
        "definition": study.described(),
    }


def read_manifest(path: Path) -> dict[str, Any]:
    """The content of a folder's study.json.

    Raises
    ------
    StudyError
        There is none, or it is none of plydrape.

    """
    try:
        manifest = json.loads((path / NAME).read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise StudyError(f"`{path}` is no study's folder: it has no {NAME}", help=OTHER) from error
    except (OSError, ValueError) as error:
        raise StudyError(f"`{path / NAME}` cannot be read: {error}", help=OTHER) from error
    except RecursionError as error:
        raise StudyError(
            f"`{path / NAME}` cannot be read: it is nested too deep", help=OTHER
        ) from error
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
    if isinstance(earlier, dict) and isinstance(now, dict):
        found: list[str] = []
        for key in [*now, *(key for key in earlier if key not in now)]:
            inner = f"{path}.{key}" if path else key
            if key not in now or key not in earlier:
                found.append(f"`{inner}`")
            else:
                found += differing(earlier[key], now[key], inner)
        return found[:5]
    return [] if earlier == now else [f"`{path}`"]


def text(value: Any) -> bytes:
    """A value as indented JSON with a line feed."""
    return (json.dumps(value, indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode()


def same(path: Path, content: bytes) -> bool:
    """Whether a file has this content; False where it cannot be read."""
    try:
        return path.stat().st_size == len(content) and path.read_bytes() == content
    except OSError:
        return False


def whole(path: Path, content: bytes) -> None:
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
