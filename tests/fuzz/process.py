"""Runs a command in a process of its own, within bounds of time and memory."""

from __future__ import annotations

import contextlib
import os
import resource
import signal
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from time import monotonic

from .case import Outlet

MEMORY = 2 << 30  # bytes of address space; Python with its libraries needs twice that
FILE = 256 << 20  # bytes of the largest file
INTERRUPTED = ("simulate", "plan")


@dataclass(frozen=True)
class Ended:
    """How a command ended."""

    command: tuple[str, ...]
    code: int
    stdout: bytes
    stderr: bytes
    seconds: float
    cpu: float
    interrupted: bool
    killed: bool


@dataclass(frozen=True)
class Program:
    """The program under test, and the surroundings that it runs in."""

    binary: Path
    python: str
    # What a drape or a plan may take (s) before it is asked to end by Ctrl-C; then, and for all
    # commands that only read and write, twice that time.
    patience: float = 5.0

    def has_studies(self) -> bool:
        """Whether Python has the package that runs studies."""
        command_line = [self.python, "-c", "import plydrape.study"]
        try:
            return subprocess.run(command_line, capture_output=True, check=False).returncode == 0
        except OSError:
            return False

    def run(
        self, command: Sequence[str], folder: Path, outlet: Outlet = Outlet.KEPT, room: int = FILE
    ) -> Ended:
        """Runs it in a folder. `room` is what a full disk takes of a file (bytes)."""
        command_line = [str(self.binary), *command]
        surroundings = {
            "PATH": os.environ.get("PATH", ""),
            "NO_COLOR": "1",
            # a bound on files would leave half of a compiled module for every later process
            "PYTHONDONTWRITEBYTECODE": "1",
            "RUST_BACKTRACE": "0",
            "PLYDRAPE_PYTHON": self.python,
            "RAYON_NUM_THREADS": "2",
            "OPENBLAS_NUM_THREADS": "1",
        }
        memory = 2 * MEMORY if command[0] == "study" else MEMORY
        bounded = room if outlet is Outlet.NO_ROOM else FILE

        def limit() -> None:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
            resource.setrlimit(resource.RLIMIT_CPU, (60, 60))
            resource.setrlimit(resource.RLIMIT_FSIZE, (bounded, bounded))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        with contextlib.ExitStack() as stack:
            full = stack.enter_context(Path("/dev/full").open("wb"))
            both = outlet is Outlet.BOTH_FULL
            began, cpu = monotonic(), children()
            child = subprocess.Popen(
                command_line,
                cwd=folder,
                env=surroundings,
                stdin=subprocess.DEVNULL,
                stdout=full if both or outlet is Outlet.STDOUT_FULL else subprocess.PIPE,
                stderr=full if both or outlet is Outlet.STDERR_FULL else subprocess.PIPE,
                preexec_fn=limit,
                # SIGXFSZ stays ignored, as it is in Python: a full disk is an error, not a signal
                restore_signals=False,
                start_new_session=True,
            )
            interrupted = killed = False
            try:
                can = command[0] in INTERRUPTED
                stdout, stderr = child.communicate(timeout=self.patience * (1 if can else 2))
            except subprocess.TimeoutExpired:
                interrupted = True
                child.send_signal(signal.SIGINT)
                try:
                    stdout, stderr = child.communicate(timeout=self.patience * 2 if can else 1.0)
                except subprocess.TimeoutExpired:
                    killed = True
                    os.killpg(child.pid, signal.SIGKILL)
                    stdout, stderr = child.communicate()
            finally:
                if child.returncode is None:  # someone ends the fuzzer
                    os.killpg(child.pid, signal.SIGKILL)
                    child.wait()
        if not can and interrupted:
            killed = True  # it was not meant to need that long
        return Ended(
            command=tuple(command),
            code=child.returncode,
            stdout=stdout or b"",
            stderr=stderr or b"",
            seconds=monotonic() - began,
            cpu=children() - cpu,
            interrupted=interrupted,
            killed=killed,
        )


def children() -> float:
    """Time that the processor spent on child processes that have ended (s)."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime
