"""Runs a study: runs of scenarios go to workers, rows come back, none is lost.

A *chunk* is a run of neighboring scenarios that takes a worker about a second: long enough for
its transport not to matter, short enough that little is lost with a worker. When a worker dies
its chunk is divided and given out again. So a scenario that kills its worker is soon alone
in its chunk; after `TRIES` deaths it becomes a row with an error.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Protocol

from .sample import Row
from .scenario import Batch, Task, failed

# Deaths of its worker after which a scenario is given up.
TRIES = 3
# Most scenarios of a chunk: a part file of rows should not grow without bound.
LARGEST = 2000
# Most scenarios of a lost chunk that is divided into single ones at once.
SMALL = 60


@dataclass(frozen=True)
class Chunk:
    """Scenarios `first`, …, `stop - 1`; `deaths` is how often they have killed a worker, alone."""

    first: int
    stop: int
    deaths: int = 0

    def __len__(self) -> int:
        """Number of scenarios."""
        return self.stop - self.first

    def divided(self) -> list[Chunk]:
        """In pieces of about the square root of its size, a small one in single scenarios."""
        size = math.isqrt(len(self)) if len(self) > SMALL else 1
        starts = range(self.first, self.stop, size)
        return [Chunk(start, min(start + size, self.stop)) for start in starts]


@dataclass(frozen=True)
class Lost:
    """A chunk whose worker died; `deaths` counts how often that happened, `cause` says why."""

    chunk: Chunk
    cause: str
    deaths: int = 1


@dataclass(frozen=True)
class Done:
    """A chunk and its rows."""

    chunk: Chunk
    batch: Batch


class Executor(Protocol):
    """Processes that run chunks, here or elsewhere."""

    def slots(self) -> int:
        """Number of chunks that should be under way."""

    def start(self, chunk: Chunk, values: list[Row]) -> None:
        """Gives a chunk out."""

    def wait(self) -> Done | Lost:
        """The next chunk that ended, either way.

        Raises
        ------
        StudyError
            No chunk can be run any more.

        """

    def close(self) -> None:
        """Ends what is under way."""


def run_chunks(
    executor: Executor,
    task: Task,
    values: list[Row],
    todo: Iterable[tuple[int, int]],
    keep: Callable[[Batch], None],
    every: float,
) -> None:
    """Runs the scenarios of the ranges `todo`; each batch of rows goes to `keep` once.

    Parameters
    ----------
    executor : Executor
        Runs the chunks; it is not closed.
    task : Task
        Makes the row of a scenario that is given up.
    values : list of Row
        The inputs of all scenarios.
    todo : iterable of tuple[int, int]
        Ranges of scenarios, first and stop.
    keep : callable
        Takes the rows.
    every : float
        Seconds that a chunk should take.

    Raises
    ------
    StudyError
        From the executor.

    """
    ranges = deque(Chunk(first, stop) for first, stop in todo if first < stop)
    again: deque[Chunk] = deque()
    running = 0
    size = Size(every)

    while ranges or again or running:
        while (ranges or again) and running < executor.slots():
            chunk = again.popleft() if again else _cut(ranges, size.now)
            executor.start(chunk, values[chunk.first : chunk.stop])
            running += 1

        ended = executor.wait()
        running -= 1
        if isinstance(ended, Done):
            keep(ended.batch)
            size.learn(len(ended.chunk), ended.batch.seconds)
            continue

        chunk = ended.chunk
        deaths = chunk.deaths + ended.deaths
        if len(chunk) > 1:
            again.extend(chunk.divided())
        elif deaths < TRIES:
            again.append(Chunk(chunk.first, chunk.stop, deaths))
        else:
            given_up = task.begun(chunk.first, values[chunk.first])
            why = f"its worker process died {deaths} times: {ended.cause}"
            keep(Batch(chunk.first, [given_up | failed("WorkerDied", why)]))


def _cut(ranges: deque[Chunk], size: int) -> Chunk:
    """Takes a chunk off the first range."""
    whole = ranges.popleft()
    stop = min(whole.first + size, whole.stop)
    if stop < whole.stop:
        ranges.appendleft(Chunk(stop, whole.stop))
    return Chunk(whole.first, stop)


class Size:
    """How many scenarios take that time, from the chunks so far; it at most quadruples."""

    def __init__(self, every: float) -> None:
        """Starts with one scenario."""
        self.every = every
        self.now = 1
        self._scenarios = 0.0
        self._seconds = 0.0

    def learn(self, scenarios: int, seconds: float) -> None:
        """Takes a chunk into account; older ones count less and less."""
        self._scenarios = 0.5 * self._scenarios + scenarios
        self._seconds = 0.5 * self._seconds + seconds
        rate = self._scenarios / max(self._seconds, 1e-9)
        self.now = max(1, min(int(rate * self.every), 4 * self.now, LARGEST))
