"""Runs a study: from its definition to its rows, summary and page."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .carry import Executor, carry_out
from .definition import Study
from .error import StudyError, require
from .folder import Folder, missing, text
from .outcome import Outcome
from .progress import Progress
from .scenario import Batch


def run(
    study: str | os.PathLike[str] | Mapping[str, Any] | Study,
    *,
    output: str | os.PathLike[str] | None = None,
    scheduler: str | None = None,
    workers: int | None = None,
    progress: bool = True,
    every: float = 1.0,
) -> Outcome:
    """Runs every scenario of a study that has no row yet.

    The same study gives the same rows, whatever runs it and however often it was interrupted.

    Args:
        study: a study file, a dict with its keys, or a `Study`.
        output: folder of the rows; `NAME.results` beside the file NAME.toml unless given. A study
            without a file keeps its rows in memory.
        scheduler: address of a Dask scheduler; processes of this machine unless given.
        workers: number of such processes; one a core unless given.
        progress: a bar on standard error, if that is a terminal.
        every: seconds of work after which rows are written.

    Returns:
        All rows, with their summary.

    Raises:
        StudyError: the definition, the folder or the cluster is refused.
        SceneError: the scene is refused.
        KeyboardInterrupt: on Ctrl-C. Finished rows are in the folder; the same call goes on.

    Example:
        >>> import plydrape.study
        >>> plydrape.study.run("study.toml", output="rows")  # doctest: +SKIP

    """
    require("scipy", "pyarrow", *(["distributed"] if scheduler else []))
    if not isinstance(study, Study):
        study = Study.of(study) if isinstance(study, Mapping) else Study.read(study)
    if workers is not None and workers < 1:
        raise StudyError(f"{workers} workers can do nothing", help="give 1 or more")
    if output is None and study.file is None:
        with tempfile.TemporaryDirectory(prefix="plydrape-study-") as hidden:
            outcome = _run(study, Path(hidden), scheduler, workers, progress, every)
            return Outcome(outcome.table(), outcome.title, None)
    path = Path(output) if output is not None else beside(study)
    return _run(study, path, scheduler, workers, progress, every)


def beside(study: Study) -> Path:
    """The folder of a study that was not told of one."""
    assert study.file is not None
    return study.file.with_name(f"{study.file.stem}.results")


def _run(
    study: Study,
    path: Path,
    scheduler: str | None,
    workers: int | None,
    progress: bool,
    every: float,
) -> Outcome:
    from . import page, table

    folder = Folder(path)
    try:
        folder.begin(study)
        todo = missing(folder.parts(), len(study))
        left = sum(stop - first for first, stop in todo)
        bar = Progress(len(study), len(study) - left, progress)

        def keep(batch: Batch) -> None:
            rows = table.table(batch.rows, batch.units, study.inputs)
            folder.keep(batch.first, len(batch.rows), table.content(rows))
            bar.add(len(batch.rows), sum(row["error"] is not None for row in batch.rows))

        if left:
            executor = _executor(study, scheduler, min(workers or cores(), left))
            try:
                carry_out(executor, study.task, study.values, todo, keep, every)
            finally:
                executor.close()
                bar.close()

        rows = table.joined([read_part(part) for _, _, part in folder.parts()])
        outcome = Outcome(rows, study.title, path)
        folder.write("study.parquet", table.content(rows))
        folder.write("summary.json", text(outcome.summary))
        folder.write("summary.html", page.html(outcome, study).encode())
        return outcome
    finally:
        folder.close()


def read_part(path: Path) -> Any:
    """The rows of a part file.

    Raises:
        StudyError: it is damaged.

    """
    from . import table

    try:
        return table.read(path)
    except Exception as error:
        raise StudyError(
            f"`{path}` cannot be read: {error}",
            help="remove it: its scenarios are then run again",
        ) from error


def _executor(study: Study, scheduler: str | None, workers: int) -> Executor:
    if scheduler is not None:
        from .cluster import Cluster

        return Cluster(study.task, scheduler)
    from .local import Local

    return Local(study.task, workers)


def cores() -> int:
    """Number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
