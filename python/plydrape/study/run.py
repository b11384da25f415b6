"""Runs a study: from its definition to its rows and their summary."""

from __future__ import annotations

import contextlib
import os
import sys
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TextIO

from .definition import Study
from .error import StudyError, require
from .folder import FINISHED, REMOVE, Folder, content, joined, text, write
from .outcome import Outcome
from .scenario import Line

# Processes of one machine; a slip of the pen is likelier than more.
MOST_WORKERS = 1024


def run(
    study: str | os.PathLike[str] | Mapping[str, Any] | Study,
    *,
    output: str | os.PathLike[str] | None = None,
    scheduler: Any = None,
    workers: int | None = None,
    progress: bool = True,
    every: float = 1.0,
) -> Outcome:
    """Runs every scenario of a study that has no row yet.

    The same study gives the same rows, whatever runs it and however often it was interrupted. A
    finished study is only read; `ran` of the outcome is then 0. Processes of this machine import
    the script that calls this: such a script does it below `if __name__ == "__main__":`.

    Parameters
    ----------
    study : str or path or mapping or Study
        A study file, a dict with its keys, or a `Study`.
    output : str or path, optional
        Folder of the rows; `NAME.results` beside the file NAME.toml unless given. A study
        without a file keeps its rows in memory.
    scheduler : str or cluster, optional
        Address of a Dask scheduler, or what else `distributed.Client` takes, such as a
        `LocalCluster`; processes of this machine unless given.
    workers : int, optional
        Number of such processes; one a core unless given.
    progress : bool, default True
        A line on standard error, if that is a terminal.
    every : float, default 1.0
        Seconds of work after which rows are written.

    Returns
    -------
    Outcome
        All rows, with their summary.

    Raises
    ------
    StudyError
        The definition, the folder or the cluster is refused, or a file cannot be
        written. Finished rows are in the folder; the same call goes on.
    SceneError
        The scene is refused.
    KeyboardInterrupt
        On Ctrl-C. Finished rows are in the folder; the same call goes on.

    Examples
    --------
    >>> import plydrape.study
    >>> plydrape.study.run("study.toml", output="rows")  # doctest: +SKIP

    """
    require("scipy", "pyarrow", "pandas", *(["distributed"] if scheduler else []))
    if not isinstance(study, Study):
        study = Study.of(study) if isinstance(study, Mapping) else Study.read(study)
    if workers is not None and not 1 <= workers <= MOST_WORKERS:
        raise StudyError(
            f"{workers} workers are not possible on one machine",
            help=f"give 1 to {MOST_WORKERS}, or the address of a Dask scheduler",
        )
    with contextlib.ExitStack() as stack:
        memory = output is None and study.file is None
        if memory:
            output = stack.enter_context(tempfile.TemporaryDirectory(prefix="plydrape-study-"))
        folder = Folder(Path(output) if output is not None else beside(study))
        stack.callback(folder.close)
        folder.begin(study)
        outcome = _run(study, folder, scheduler, workers or cores(), progress, every)
        if memory:
            outcome.folder = None
        return outcome


def beside(study: Study) -> Path:
    """The folder of a study that names none."""
    assert study.file is not None
    return study.file.with_name(f"{study.file.stem}.results")


def _run(
    study: Study, folder: Folder, scheduler: Any, workers: int, progress: bool, every: float
) -> Outcome:
    from .workers import here, on_cluster

    # What is done.
    known = ["scenario", "seed", "version", *(x.key for x in study.inputs)]
    done: set[int] = set()
    for path, rows in folder.parts(known):
        compare(rows, path, study, known)
        done.update(rows["scenario"].to_pylist())
    todo = [k for k in range(len(study)) if k not in done]

    # What is left.
    if todo:
        common = (study.task, study.values, todo)
        if scheduler is None:
            lines = here(*common, min(workers, len(todo)), every)
        else:
            lines = on_cluster(*common, scheduler, every)
        batch: list[Line] = []
        last = time.monotonic()
        with contextlib.closing(lines), Progress(len(study), len(done), progress) as bar:
            try:
                for line in lines:
                    if line is not None:
                        batch.append(line)
                        bar.add(line["error"] is not None)
                    if batch and time.monotonic() - last >= every:
                        batch, ended = [], batch
                        folder.keep(ended, study)
                        last = time.monotonic()
            finally:
                if batch:
                    folder.keep(batch, study)

    # What they say. A finished study is left as it is, with what its user may have added.
    outcome = Outcome(joined([rows for _, rows in folder.parts()]), study.title, folder.path)
    outcome.ran = len(todo)
    for name in FINISHED:
        if todo or not os.path.lexists(folder.path / name):
            table = name == "study.parquet"
            write(folder.path / name, content(outcome.table()) if table else text(outcome.summary))
            outcome.written.append(name)
    return outcome


def compare(rows: Any, path: Path, study: Study, known: list[str]) -> None:
    """Compares what a part holds with what is known of its scenarios.

    Raises
    ------
    StudyError
        The part is of another study.

    """
    scenarios = rows["scenario"].to_pylist()
    if not 0 <= min(scenarios) <= max(scenarios) < len(study):
        raise StudyError(
            f"`{path}` is not of this study: it has {len(study)} scenarios, which count from 0",
            help=REMOVE,
        )
    begun = [study.task.begun(k, study.values[k]) for k in scenarios]
    for name in known:
        if name not in rows.column_names or rows[name].to_pylist() != [row[name] for row in begun]:
            raise StudyError(
                f"`{path}` is not of this study: the column `{name}` is another", help=REMOVE
            )


def cores() -> int:
    """Number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class Progress:
    """A line on standard error while a study runs; nothing where that is no terminal."""

    def __init__(self, total: int, done: int, shown: bool, stream: TextIO | None = None) -> None:
        """`done` were done in an earlier run."""
        self._stream = stream or sys.stderr
        self._shown = shown and self._stream.isatty()
        self._total, self._before, self._done, self._failed = total, done, done, 0
        self._start = self._last = time.monotonic()

    def __enter__(self) -> Progress:
        """Shows how many were done before."""
        self._draw()
        return self

    def add(self, failed: bool) -> None:
        """One more is done."""
        self._done += 1
        self._failed += failed
        if time.monotonic() - self._last > 0.1 or self._done == self._total:
            self._draw()

    def __exit__(self, *_: object) -> None:
        """Clears the line."""
        if self._shown:
            print("\r\x1b[K", end="", file=self._stream, flush=True)

    def _draw(self) -> None:
        if not self._shown:
            return
        self._last = time.monotonic()
        text = f"{self._done} of {self._total} scenarios"
        if new := self._done - self._before:
            left = (self._last - self._start) / new * (self._total - self._done)
            text += f", {left // 60:.0f}:{left % 60:02.0f} left"
        if self._failed:
            text += f", {self._failed} failed"
        print(f"\r\x1b[K{text}", end="", file=self._stream, flush=True)
