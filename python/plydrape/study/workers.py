"""Drapes scenarios in processes of this machine or on a Dask cluster.

`concurrent.futures` and Dask hand scenarios out; this file gives each one to them, takes its row,
and says what became of a scenario whose worker died.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import pickle
import queue
import signal
import threading
from collections import deque
from collections.abc import Callable, Generator, Iterator
from concurrent import futures
from concurrent.futures.process import BrokenProcessPool
from functools import lru_cache
from itertools import islice
from multiprocessing.connection import Connection
from typing import Any

import plydrape

from .error import StudyError
from .keys import Value
from .scenario import Line, Task, failed

Row = tuple[Value, ...]

# Deaths of its worker after which a scenario is given up.
TRIES = 3
# One thread for each process, whatever is inside.
THREADS = dict.fromkeys(
    ("RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"
)
# Seconds to wait for the scheduler, and for its first worker.
PATIENCE = 30
# Scenarios that a cluster has at once: more than it has threads.
AHEAD = 2000
AGAIN = "the finished rows are kept; start the study again to go on"
SAME = "install the same version of plydrape on every worker"


def work(task: bytes, scenario: int, values: Row) -> Line:
    """The row of a scenario; this is what workers call.

    Raises
    ------
    StudyError
        This process has another version of plydrape than the study's.

    """
    # Dask has as many threads as it was given; plydrape adds none, if it is not in use yet.
    os.environ.setdefault("RAYON_NUM_THREADS", "1")
    loaded = _loaded(task)
    if plydrape.__version__ != loaded.version:
        raise StudyError(
            f"a worker has plydrape {plydrape.__version__}, the study {loaded.version}", help=SAME
        )
    return loaded.row(scenario, values)


@lru_cache(maxsize=2)
def _loaded(task: bytes) -> Task:
    """The task, once for each process: it has the mold, whose file is read once."""
    loaded: Task = pickle.loads(task)
    return loaded


def here(
    task: Task, values: list[Row], todo: list[int], workers: int, every: float
) -> Generator[Line | None, None, None]:
    """Rows of processes of this machine, as they are finished; None after `every` idle seconds.

    A pool ends as a whole when one of its processes dies. What was under way is then draped alone,
    and a scenario whose process dies three times is a row with an error.

    Raises
    ------
    StudyError
        No worker can be started, or one failed.

    """
    payload = pickle.dumps(task)
    left = deque(todo)
    while left:
        lost: list[int] = []

        def jobs(lost: list[int] = lost) -> Iterator[int]:
            while left and not lost:
                yield left.popleft()

        with Pool(min(workers, len(left))) as pool:

            def submit(scenario: int, pool: Pool = pool) -> futures.Future[Line]:
                return pool.submit(work, payload, scenario, values[scenario])

            for ended in _ended(submit, jobs(), 2 * workers, every):
                if ended is None:
                    yield None
                    continue
                scenario, future = ended
                try:
                    yield future.result()
                except BrokenProcessPool:
                    lost.append(scenario)
        for scenario in sorted(lost):
            yield _alone(task, payload, scenario, values[scenario])


def _alone(task: Task, payload: bytes, scenario: int, values: Row) -> Line:
    """The row of a scenario in a process of its own; an error where that dies again and again."""
    for _ in range(TRIES):
        with Pool(1) as pool, contextlib.suppress(BrokenProcessPool):
            return pool.submit(work, payload, scenario, values).result()
    why = f"its worker process died {TRIES} times"
    return task.begun(scenario, values) | failed("WorkerDied", why)


def _ended(
    submit: Callable[[int], Any], todo: Iterator[int], ahead: int, every: float
) -> Iterator[tuple[int, Any] | None]:
    """Scenarios and their futures as they end, `ahead` under way; None after idle seconds."""
    ready: queue.SimpleQueue[Any] = queue.SimpleQueue()
    under_way: dict[Any, int] = {}
    while True:
        for scenario in islice(todo, ahead - len(under_way)):
            future = submit(scenario)
            under_way[future] = scenario
            future.add_done_callback(ready.put)
        if not under_way:
            return
        try:
            future = ready.get(timeout=every)
        except queue.Empty:
            yield None
        else:
            yield under_way.pop(future), future


class Pool:
    """Processes of this machine that end with their client, however it ends.

    Each listens to a pipe. It closes with the client, or when the client wants to end at once.
    """

    def __init__(self, workers: int) -> None:
        """Nothing is started yet."""
        self._workers = workers
        context = multiprocessing.get_context("spawn")
        ear, self._mouth = context.Pipe(duplex=False)
        self._ear = ear
        self._pool = futures.ProcessPoolExecutor(workers, context, _begin, (ear,))

    def __enter__(self) -> Pool:
        """Starts the processes.

        Raises
        ------
        StudyError
            One cannot be started, or ends before it begins.

        """
        try:
            with _starting():
                first = [self._pool.submit(os.getpid) for _ in range(self._workers)]
            for ready in first:
                ready.result()
        except (OSError, BrokenProcessPool) as error:
            self.__exit__(StudyError)
            why = getattr(error, "strerror", None) or error
            raise StudyError(
                f"a worker process cannot be started: {why}",
                help="take fewer with --workers; and a script that runs a study must do so below "
                '`if __name__ == "__main__":`, since workers import it',
            ) from error
        except BaseException:
            self.__exit__(StudyError)
            raise
        return self

    def submit(self, call: Callable[..., Line], *arguments: Any) -> futures.Future[Line]:
        """The future of a call; it has failed where a process of the pool has died."""
        try:
            return self._pool.submit(call, *arguments)
        except BrokenProcessPool as error:
            failed: futures.Future[Line] = futures.Future()
            failed.set_exception(error)
            return failed

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        """Ends the processes: at once where something went wrong."""
        if kind is not None:
            self._mouth.close()
        self._pool.shutdown(wait=True, cancel_futures=True)
        self._mouth.close()
        self._ear.close()


def _begin(ear: Connection) -> None:
    """Begins a worker: Ctrl-C is for the client alone, and who ends with it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    mask = getattr(signal, "pthread_sigmask", None)
    if mask is not None:
        mask(signal.SIG_UNBLOCK, {signal.SIGTERM})
    threading.Thread(target=_listen, args=(ear,), daemon=True).start()


def _listen(ear: Connection) -> None:
    """Ends this process when the client closes the pipe, or is gone."""
    with contextlib.suppress(EOFError, OSError):
        ear.recv()
    os._exit(1)


@contextlib.contextmanager
def _starting() -> Iterator[None]:
    """What processes inherit that are started within: one thread each, and no Ctrl-C.

    A client that is interrupted here would leave one that waits for what it shall do, and says so.
    """
    before = {name: os.environ.get(name) for name in THREADS}
    os.environ.update(THREADS)
    mask = getattr(signal, "pthread_sigmask", None)
    if mask is not None:
        held = mask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM})
    try:
        yield
    finally:
        if mask is not None:
            mask(signal.SIG_SETMASK, held)
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def on_cluster(
    task: Task, values: list[Row], todo: list[int], scheduler: Any, every: float
) -> Generator[Line | None, None, None]:
    """Rows of a Dask cluster, as they are finished; None after `every` idle seconds.

    When a worker dies, the scheduler itself gives its scenarios to others, three times unless it
    is configured otherwise.

    Raises
    ------
    StudyError
        There is no scheduler, it has no workers, it went away, or a worker failed.

    """
    from distributed import Client, KilledWorker

    payload = pickle.dumps(task)
    try:
        client = Client(scheduler, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise StudyError(
            f"there is no Dask scheduler at {scheduler!r}: {error}",
            help="start one with `dask scheduler` and give the address that it prints, "
            "as in tcp://10.0.0.1:8786",
        ) from error
    with client:
        try:
            client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError as error:
            raise StudyError(
                f"the Dask scheduler at {scheduler} has no workers",
                help=f"start some with `dask worker {scheduler}`",
            ) from error

        def submit(scenario: int) -> Any:
            return client.submit(work, payload, scenario, values[scenario], pure=False)

        for ended in _ended(submit, iter(todo), AHEAD, every):
            if ended is None:
                yield None
                continue
            scenario, future = ended
            try:
                row = future.result()
            except KilledWorker as error:
                why = f"its workers of the Dask cluster died again and again: {error}"
                row = task.begun(scenario, values[scenario]) | failed("WorkerDied", why)
            except StudyError:
                raise
            except (OSError, futures.CancelledError) as error:
                raise StudyError(
                    f"the Dask scheduler at {scheduler} is gone: {error}", help=AGAIN
                ) from error
            except Exception as error:
                raise StudyError(
                    f"a Dask worker failed: {type(error).__name__}: {error}", help=SAME
                ) from error
            yield row
