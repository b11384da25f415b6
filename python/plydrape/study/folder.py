"""The folder of a study.

    study.results/
        study.json        what the study is: definition, check sum, version of plydrape
        rows/             one part-FIRST-LAST.parquet for each finished run of scenarios
        study.parquet     all rows in order            } when all are done
        summary.json      the figures of the page      }
        summary.html      the page                     }

Every file is written whole or not at all: under a hidden name, brought to the disk, renamed.
What stands in `rows/` is what is done; nothing else is remembered. Only one process at a time
may work in the folder. A folder that holds anything else is refused.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
from collections.abc import Iterator
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

        Raises:
            StudyError: it holds another study, or something else, or is in use.

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
            raise StudyError(f"`{self.path}` cannot be used: {error}", help=OTHER) from error

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

        Raises:
            StudyError: two of them hold the same scenario.

        """
        found = sorted(_parts(self.rows))
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

    def write(self, name: str, content: bytes) -> Path:
        """Writes a file of the finished study."""
        whole(self.path / name, content)
        return self.path / name

    def close(self) -> None:
        """Lets others in."""
        if self._lock is not None:
            self._lock.close()


LOCK = ".lock"


def _parts(rows: Path) -> Iterator[tuple[int, int, Path]]:
    for path in rows.glob("*.parquet") if rows.is_dir() else ():
        if name := PART.fullmatch(path.name):
            yield int(name["first"]), int(name["last"]) + 1, path


def missing(parts: list[tuple[int, int, Path]], total: int) -> list[tuple[int, int]]:
    """The ranges of scenarios, first and stop, that no part holds.

    Example:
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

    Raises:
        StudyError: there is none, or it is none of plydrape.

    """
    try:
        manifest = json.loads((path / NAME).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise StudyError(f"`{path}` is no study's folder: {error}", help=OTHER) from error
    if not isinstance(manifest, dict) or manifest.get("format") != "plydrape-study":
        raise StudyError(f"`{path / NAME}` is no study of plydrape", help=OTHER)
    return manifest


def differing(earlier: Any, now: Any, path: str = "") -> list[str]:
    """The paths at which two definitions differ, at most five.

    Example:
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


def whole(path: Path, content: bytes) -> None:
    """Writes a file whole or not at all; it may replace an earlier one."""
    hidden = path.with_name(f".{path.name}.tmp")
    with open(hidden, "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    os.replace(hidden, path)
    # The new name is on the disk too; not every system lets a folder be opened.
    with contextlib.suppress(OSError):
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)
