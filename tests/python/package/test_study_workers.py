"""Workers that die: no row is lost, none comes twice, and a deadly scenario is a row."""

from __future__ import annotations

import os
import random
import signal
import sys
from collections import deque
from typing import Any

import pytest
from deadly import Deadly
from plydrape.study import local
from plydrape.study.chunks import TRIES, Chunk, Done, Lost, run_chunks
from plydrape.study.error import StudyError
from plydrape.study.local import Local
from plydrape.study.sample import Row
from plydrape.study.scenario import Batch, Line
from studies import study


class Unreliable:
    """An executor without processes: it loses a share of its chunks, and those with a victim."""

    def __init__(self, seed: int, victims: set[int]) -> None:
        """The seed decides what is lost and in which order chunks end."""
        self.random = random.Random(seed)
        self.victims = victims
        self.jobs: deque[Chunk] = deque()
        self.deaths = 0

    def slots(self) -> int:
        """Two to four."""
        return self.random.randint(2, 4)

    def start(self, chunk: Chunk, values: list[Row]) -> None:
        """Keeps the chunk; it has its values."""
        assert len(values) == len(chunk)
        self.jobs.append(chunk)

    def wait(self) -> Done | Lost:
        """Any of the chunks ends, well or not."""
        self.jobs.rotate(self.random.randrange(len(self.jobs)))
        chunk = self.jobs.popleft()
        scenarios = range(chunk.first, chunk.stop)
        if self.victims & set(scenarios) or (len(chunk) > 1 and self.random.random() < 0.3):
            self.deaths += 1
            return Lost(chunk, "by chance")
        rows: list[Line] = [{"scenario": k, "error": None} for k in scenarios]
        return Done(chunk, Batch(chunk.first, rows, {}, self.random.uniform(0.0, 2.0)))

    def close(self) -> None:
        """Nothing to end."""


@pytest.mark.parametrize("seed", range(20))
def test_each_scenario_is_kept_once_whatever_is_lost(seed: int) -> None:
    """Of 300, some done before; those that kill their worker are kept with an error."""
    made = study(300)
    executor = Unreliable(seed, {5, 177, 299})
    kept: list[Batch] = []
    todo = [(0, 40), (60, 61), (100, 300)]
    run_chunks(executor, made.task, made.values, todo, kept.append, every=0.5)
    rows = [row for batch in sorted(kept, key=lambda batch: batch.first) for row in batch.rows]
    assert [row["scenario"] for row in rows] == [k for a, b in todo for k in range(a, b)]
    assert {row["scenario"] for row in rows if row["error"]} == {5, 177, 299}
    for batch in kept:
        run = range(batch.first, batch.first + len(batch.rows))
        assert [row["scenario"] for row in batch.rows] == list(run)


def test_a_deadly_scenario_is_soon_alone() -> None:
    """Of the largest chunk: divided twice, then tried until it is given up."""
    made = study(2000)
    executor = Unreliable(0, {1234})
    executor.random.random = lambda: 1.0  # type: ignore[method-assign]
    run_chunks(executor, made.task, made.values, [(0, 2000)], lambda _: None, every=1e9)
    assert executor.deaths <= 2 + TRIES


def test_a_scenario_that_kills_its_worker_is_a_row() -> None:
    """Real processes, real SIGKILL; the rows beside it are as ever."""
    made = study(30)
    task = Deadly(**vars(made.task) | {"victim": 11})
    kept: list[Batch] = []
    executor = Local(task, workers=2)
    try:
        run_chunks(executor, task, made.values, [(0, 30)], kept.append, every=0.2)
    finally:
        executor.close()
    rows = {row["scenario"]: row for batch in kept for row in batch.rows}
    assert set(rows) == set(range(30)) and sum(len(b.rows) for b in kept) == 30
    assert rows[11]["error_kind"] == "WorkerDied" and "SIGKILL" in str(rows[11]["error"])
    assert rows[11]["grippers.height"] == made.values[11][1]
    wanted = {k: made.task.row(k, made.values[k], {}) for k in range(30) if k != 11}
    assert {k: row for k, row in rows.items() if k != 11} == wanted


def test_a_killed_worker_costs_no_row() -> None:
    """One is killed from outside while it works; another takes its place."""
    made = study(120)
    executor = Local(made.task, workers=2)
    kept: list[Batch] = []
    killed: list[int] = []

    def keep(batch: Batch) -> None:
        kept.append(batch)
        if len(kept) in (3, 6):
            killed.append(executor.pids[0])
            os.kill(killed[-1], signal.SIGKILL)

    try:
        run_chunks(executor, made.task, made.values, [(0, 120)], keep, every=0.05)
        # The dead are replaced, and nobody else is there.
        assert len(killed) == 2 and not set(killed) & set(executor.pids)
        assert len(executor.pids) <= 2
    finally:
        executor.close()
    rows = [row for batch in sorted(kept, key=lambda batch: batch.first) for row in batch.rows]
    assert rows == [made.task.row(k, made.values[k], {}) for k in range(120)]
    assert not executor.pids


def test_a_worker_that_cannot_be_started_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody waits for it forever."""
    monkeypatch.setattr(sys, "executable", "/no/such/python")
    made = study(2)
    executor = Local(made.task, workers=1)
    executor.start(Chunk(0, 2), made.values)
    try:
        ended = executor._ended.get(timeout=20)
    finally:
        executor.close()
    assert isinstance(ended, StudyError)
    assert "a worker process cannot be started: No such file or directory" in str(ended)


def test_a_worker_killed_while_it_starts_is_begun_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """Twice in a row, as two kills can meet the same place; the rows are as ever."""
    ask = local._ask
    killed: list[int] = []

    def unlucky(process: Any, job: Any, first: bytes | None = None) -> Any:
        if first is not None and len(killed) < 2:
            killed.append(process.pid)
            process.kill()
        return ask(process, job, first)

    monkeypatch.setattr(local, "_ask", unlucky)
    made = study(6)
    executor = Local(made.task, workers=1)
    kept: list[Batch] = []
    try:
        run_chunks(executor, made.task, made.values, [(0, 6)], kept.append, every=0.05)
    finally:
        executor.close()
    assert len(killed) == 2
    rows = [row for batch in sorted(kept, key=lambda batch: batch.first) for row in batch.rows]
    assert rows == [made.task.row(k, made.values[k], {}) for k in range(6)]


def test_a_worker_of_another_version_is_refused() -> None:
    """Its rows would be of another program."""
    made = study(4)
    task = Deadly(**vars(made.task) | {"version": "9.9.9"})
    executor = Local(task, workers=1)
    try:
        with pytest.raises(StudyError, match=r"plydrape 0\..*the study 9\.9\.9"):
            run_chunks(executor, task, made.values, [(0, 4)], lambda _: None, every=1.0)
    finally:
        executor.close()
