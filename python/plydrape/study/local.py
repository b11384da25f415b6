"""Worker processes on this machine."""

from __future__ import annotations

import contextlib
import os
import pickle
import queue
import signal
import subprocess
import sys
import threading
from typing import Any

from .chunks import Chunk, Done, Lost
from .error import StudyError
from .sample import Row
from .scenario import Task
from .worker import READY, START, THREADS

Job = tuple[Chunk, list[Row]]

# A process may be killed while it starts; one that never starts is at fault itself.
BEGINNINGS = 3


class Local:
    """An executor of `workers` processes, each looked after by a thread of the client.

    Examples
    --------
    >>> executor = Local(task, workers=2)  # doctest: +SKIP

    """

    def __init__(self, task: Task, workers: int) -> None:
        """Starts the threads; each starts its process with its first chunk."""
        self._task = pickle.dumps(task)
        self._jobs: queue.Queue[Job | None] = queue.Queue()
        self._ended: queue.Queue[Done | Lost | StudyError] = queue.Queue()
        self._processes: set[subprocess.Popen[bytes]] = set()
        self._lock = threading.Lock()
        self._closed = False
        self._workers = workers
        for _ in range(workers):
            threading.Thread(target=self._look_after, daemon=True).start()

    def slots(self) -> int:
        """One chunk under way and one waiting for each worker."""
        return 2 * self._workers

    def start(self, chunk: Chunk, values: list[Row]) -> None:
        """Gives a chunk to the next worker that is free."""
        self._jobs.put((chunk, values))

    def wait(self) -> Done | Lost:
        """The next chunk that ended."""
        while True:
            # With a timeout, so that Ctrl-C is heard on every system.
            with contextlib.suppress(queue.Empty):
                ended = self._ended.get(timeout=0.5)
                if isinstance(ended, StudyError):
                    raise ended
                return ended

    def close(self) -> None:
        """Ends the processes."""
        with self._lock:
            self._closed = True
            processes = list(self._processes)
        for process in processes:
            process.kill()
        for process in processes:
            process.wait()
        for _ in range(self._workers):
            self._jobs.put(None)

    @property
    def pids(self) -> list[int]:
        """Process ids of the workers that live."""
        with self._lock:
            return [process.pid for process in self._processes]

    def _look_after(self) -> None:
        """Feeds one worker; nobody waits for a thread that has ended."""
        try:
            self._feed()
        except StudyError as error:
            self._ended.put(error)
        except Exception as error:
            fault = f"the thread of a worker failed: {type(error).__name__}: {error}"
            self._ended.put(StudyError(fault))

    def _feed(self) -> None:
        """Gives chunks to one worker; a new one takes the place of a dead one.

        Raises
        ------
        StudyError
            No worker can be started.

        """
        process: subprocess.Popen[bytes] | None = None
        while (job := self._jobs.get()) is not None and not self._closed:
            chunk, values = job
            process = process or self._begin()
            try:
                answer = _ask(process, (chunk.first, values))
            except (EOFError, OSError, pickle.UnpicklingError):
                self._ended.put(Lost(chunk, self._end(process)))
                process = None
                continue
            if isinstance(answer, StudyError):
                self._ended.put(answer)
            elif isinstance(answer, BaseException):
                fault = f"a worker failed: {type(answer).__name__}: {answer}"
                self._ended.put(StudyError(fault))
            else:
                self._ended.put(Done(chunk, answer))
        if process is not None:
            self._end(process)

    def _begin(self) -> subprocess.Popen[bytes]:
        """A process that is ready to work.

        Raises
        ------
        StudyError
            The system starts none, or it ends before that, three times.

        """
        for _ in range(BEGINNINGS):
            try:
                process = subprocess.Popen(
                    [sys.executable, "-c", START, *(path or os.getcwd() for path in sys.path)],
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    env=os.environ | THREADS,
                    # Ctrl-C is for the client alone.
                    start_new_session=True,
                )
            except OSError as error:
                raise StudyError(
                    f"a worker process cannot be started: {error.strerror or error}",
                    help="take fewer with --workers",
                ) from error
            with self._lock:
                self._processes.add(process)
                if self._closed:
                    process.kill()
            with contextlib.suppress(EOFError, OSError, pickle.UnpicklingError):
                if _ask(process, None, first=self._task) == READY:
                    return process
            cause = self._end(process)
        raise StudyError(f"a worker process ends before it begins: {cause}", help="see above")

    def _end(self, process: subprocess.Popen[bytes]) -> str:
        """Ends a process; returns why it had ended."""
        for pipe in (process.stdin, process.stdout):
            with contextlib.suppress(OSError):
                if pipe is not None:
                    pipe.close()
        try:
            code = process.wait(timeout=5.0)
        except subprocess.TimeoutExpired:
            process.kill()
            code = process.wait()
        with self._lock:
            self._processes.discard(process)
        if code >= 0:
            return f"exit code {code}"
        with contextlib.suppress(ValueError):
            return signal.Signals(-code).name
        return f"signal {-code}"


def _ask(process: subprocess.Popen[bytes], job: Any, first: bytes | None = None) -> Any:
    """Sends a pickle and reads the answer."""
    assert process.stdin is not None and process.stdout is not None
    process.stdin.write(pickle.dumps(job) if first is None else first)
    process.stdin.flush()
    return pickle.load(process.stdout)
