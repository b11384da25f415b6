"""Workers of a Dask cluster.

The task travels with every chunk: data that was put on a worker beforehand would be lost with it.
The scheduler itself gives a chunk to other workers when one dies, three times unless it is
configured otherwise; only then does it count as lost here.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import pickle
import time
from collections.abc import Iterator
from concurrent import futures
from functools import lru_cache
from typing import TYPE_CHECKING

from .chunks import TRIES, Chunk, Done, Lost
from .error import StudyError
from .sample import Row
from .scenario import Batch, Task

if TYPE_CHECKING:
    from distributed import Future

# Seconds to wait for the scheduler, and for its first worker.
PATIENCE = 30
AGAIN = "the finished rows are kept; start the study again to go on"


class Cluster:
    """An executor on the cluster of a scheduler.

    Examples
    --------
    >>> executor = Cluster(task, "tcp://10.0.0.1:8786")  # doctest: +SKIP

    """

    def __init__(self, task: Task, address: str) -> None:
        """Connects.

        Raises
        ------
        StudyError
            There is no scheduler at the address, or it has no workers.

        """
        from distributed import Client, as_completed

        try:
            self._client = Client(address, timeout=PATIENCE, set_as_default=False)
        except (OSError, ValueError) as error:
            raise StudyError(
                f"there is no Dask scheduler at {address!r}: {error}",
                help="start one with `dask scheduler` and give the address that it prints, "
                "as in tcp://10.0.0.1:8786",
            ) from error
        try:
            self._client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError as error:
            self._client.close()
            raise StudyError(
                f"the Dask scheduler at {address} has no workers",
                help=f"start some with `dask worker {address}`",
            ) from error
        self._address = address
        self._task = pickle.dumps(task)
        self._chunks: dict[object, Chunk] = {}
        self._ended = as_completed([], loop=self._client.loop)
        self._threads = (0, -1.0)

    def slots(self) -> int:
        """One chunk under way and one waiting for each thread; workers may come and go."""
        threads, since = self._threads
        if since < 0 or time.monotonic() - since > 2.0:
            with self._connected():
                threads = sum(self._client.nthreads().values())
            self._threads = (threads, time.monotonic())
        return max(2 * threads, 2)

    def start(self, chunk: Chunk, values: list[Row]) -> None:
        """Gives a chunk to the scheduler."""
        with self._connected():
            future = self._client.submit(work, self._task, chunk.first, values, pure=False)
        self._chunks[future.key] = chunk
        self._ended.add(future)

    def wait(self) -> Done | Lost:
        """The next chunk that ended."""
        from distributed import KilledWorker

        with self._connected():
            future: Future[Batch] = next(self._ended)
            while future.status in ("lost", "pending"):
                # Its worker died before the rows were fetched: Dask runs it again.
                self._ended.add(future)
                future = next(self._ended)
            chunk = self._chunks.pop(future.key)
            if future.status == "finished":
                return Done(chunk, future.result())
            if future.status != "error":
                raise ConnectionError(f"a chunk is {future.status}")
            error = future.exception()
        if isinstance(error, KilledWorker):
            return Lost(chunk, "killed on the Dask cluster", TRIES)
        if isinstance(error, StudyError):
            raise error
        if isinstance(error, ImportError):
            raise StudyError(
                f"a Dask worker cannot import what it needs: {error}",
                help="install the same version of plydrape on every worker",
            )
        raise StudyError(f"a Dask worker failed: {type(error).__name__}: {error}", help=AGAIN)

    @contextlib.contextmanager
    def _connected(self) -> Iterator[None]:
        """Says that the scheduler cannot be reached."""
        try:
            yield
        except (OSError, asyncio.CancelledError, futures.CancelledError) as error:
            raise StudyError(
                f"the Dask scheduler at {self._address} is gone: {error}", help=AGAIN
            ) from error

    def close(self) -> None:
        """Withdraws what is under way and leaves the cluster as it was."""
        self._client.close()


def work(task: bytes, first: int, values: list[Row]) -> Batch:
    """Runs a chunk; this is what the workers call."""
    # Dask has as many threads as it was given; plydrape adds none, if it is not loaded yet.
    os.environ.setdefault("RAYON_NUM_THREADS", "1")
    return _loaded(task).batch(first, values)


@lru_cache(maxsize=2)
def _loaded(task: bytes) -> Task:
    loaded: Task = pickle.loads(task)
    return loaded
