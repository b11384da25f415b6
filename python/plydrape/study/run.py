"""Runs a study: from its definition to its rows, summary and page."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from .chunks import Executor, run_chunks
from .definition import Study
from .error import StudyError, require
from .folder import FINISHED, Folder, missing, text
from .outcome import LAST, Outcome
from .progress import Progress
from .scenario import Batch

# Processes of one machine; a slip of the pen is likelier than more.
MOST_WORKERS = 1024
REMOVE = "remove it: the scenarios that its name says are then run again"


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

    The same study gives the same rows, whatever runs it and however often it was interrupted. A
    finished study is only read; `ran` of the outcome is then 0.

    Parameters
    ----------
    study : str or path or mapping or Study
        a study file, a dict with its keys, or a `Study`.
    output : str or path, optional
        Folder of the rows; `NAME.results` beside the file NAME.toml unless given. A study
        without a file keeps its rows in memory.
    scheduler : str, optional
        Address of a Dask scheduler; processes of this machine unless given.
    workers : int, optional
        Number of such processes; one a core unless given.
    progress : bool, default True
        a bar on standard error, if that is a terminal.
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
    require("scipy", "pyarrow", *(["distributed"] if scheduler else []))
    if not isinstance(study, Study):
        study = Study.of(study) if isinstance(study, Mapping) else Study.read(study)
    if workers is not None and workers < 1:
        raise StudyError(f"{workers} workers can do nothing", help="give 1 or more")
    if workers is not None and workers > MOST_WORKERS:
        raise StudyError(
            f"{workers} workers are more than one machine can have",
            help=f"give {MOST_WORKERS} or fewer, or the address of a Dask scheduler",
        )
    if output is None and study.file is None:
        with tempfile.TemporaryDirectory(prefix="plydrape-study-") as hidden:
            outcome = _run(study, Path(hidden), scheduler, workers, progress, every)
            return Outcome(outcome.table(), outcome.title, None)
    path = Path(output) if output is not None else beside(study)
    return _run(study, path, scheduler, workers, progress, every)


def beside(study: Study) -> Path:
    """The folder of a study that names none."""
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
        parts = folder.parts()
        if parts and parts[-1][1] > len(study):
            raise StudyError(
                f"`{parts[-1][2]}`: the study has {len(study)} scenarios, which count from 0",
                help="remove it: it is not of this study",
            )
        todo = missing(parts, len(study))
        left = sum(stop - first for first, stop in todo)
        for part in parts if left else []:
            compare(read_part(*part, columns=known(study)), *part, study)
        bar = Progress(len(study), len(study) - left, progress)

        def keep(batch: Batch) -> None:
            rows = table.table(batch.rows, batch.units, study.inputs)
            folder.keep(batch.first, len(batch.rows), table.content(rows))
            bar.add(len(batch.rows), sum(row["error"] is not None for row in batch.rows))

        if left:
            executor = _executor(study, scheduler, min(workers or cores(), left))
            try:
                run_chunks(executor, study.task, study.values, todo, keep, every)
            finally:
                executor.close()
                bar.close()

        tables = []
        for part in folder.parts():
            tables.append(read_part(*part))
            compare(tables[-1], *part, study)
        rows = table.joined(tables)
        outcome = Outcome(rows, study.title, path)
        make: dict[str, Callable[[], bytes]] = {
            "study.parquet": lambda: table.content(rows),
            "summary.json": lambda: text(outcome.summary),
            "summary.html": lambda: page.html(outcome, study).encode(),
        }
        # What a finished study has is left as it is, with what its user may have added.
        names = FINISHED if left else folder.missing()
        outcome.ran = left
        outcome.written = folder.finish({name: make[name]() for name in names})
        return outcome
    finally:
        folder.close()


def read_part(first: int, stop: int, path: Path, columns: list[str] | None = None) -> Any:
    """The rows of a part file, which are those of the scenarios that its name says.

    Parameters
    ----------
    first : int
        The first scenario.
    stop : int
        The one behind the last.
    path : Path
        The file.
    columns : list of str, optional
        Those that are read, if the file has them; all unless given.

    Raises
    ------
    StudyError
        It is damaged, or holds other scenarios.

    """
    from . import table

    try:
        rows = table.read(path, columns)
        held = rows["scenario"].to_pylist()
        absent = [name for name in LAST if not columns and name not in rows.column_names]
        if absent:
            raise KeyError(f"it has no column {absent[0]}")
    except MemoryError:
        raise
    except Exception as error:
        raise StudyError(f"`{path}` cannot be read: {error}", help=REMOVE) from error
    if len(held) != stop - first or held != list(range(first, stop)):
        expected = (
            f"the scenarios {first} to {stop - 1}" if stop - first > 1 else f"scenario {first}"
        )
        raise StudyError(
            f"`{path}` should hold {expected}, as its name says, and holds {ranged(held)}",
            help=REMOVE,
        )
    return rows


def ranged(held: list[int]) -> str:
    """The scenarios of a part as text.

    Examples
    --------
    >>> ranged([24, 25, 26]), ranged([7])
    ('24 to 26', '7')

    """
    if not held or None in held:
        return "rows without a scenario" if held else "no rows"
    if held == list(range(held[0], held[0] + len(held))):
        return f"{held[0]} to {held[-1]}" if len(held) > 1 else str(held[0])
    return f"{len(held)} rows between {min(held)} and {max(held)}"


def known(study: Study) -> list[str]:
    """The columns that are known before anything runs."""
    return ["scenario", "seed", "version", *(x.key for x in study.inputs)]


def compare(rows: Any, first: int, stop: int, path: Path, study: Study) -> None:
    """Compares what a part holds with what is known of its scenarios.

    Raises
    ------
    StudyError
        The part is of another study.

    """
    begun = [study.task.begun(k, study.values[k]) for k in range(first, stop)]
    for name in known(study):
        if name not in rows.column_names or rows[name].to_pylist() != [row[name] for row in begun]:
            raise StudyError(
                f"`{path}` is not of this study: the column `{name}` is another", help=REMOVE
            )


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
