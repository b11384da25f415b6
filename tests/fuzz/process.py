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

# What a drape may take (s). One that takes longer is asked to end (Ctrl-C), and then has to.
PATIENCE = 5.0
# From then to the end (s); for commands that read and write only, all of their time.
GRACE = 10.0
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
    interrupted: bool
    killed: bool


@dataclass(frozen=True)
class Program:
    """The program under test, and the surroundings that it runs in."""

    binary: Path
    python: str

    def run(
        self, command: Sequence[str], folder: Path, outlet: Outlet = Outlet.KEPT, room: int = FILE
    ) -> Ended:
        """Runs it in a folder. `room` is what a full disk takes of a file (bytes)."""
        words = [str(self.binary), *command]
        surroundings = {
            "PATH": os.environ.get("PATH", ""),
            "NO_COLOR": "1",
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
            began = monotonic()
            child = subprocess.Popen(
                words,
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
                stdout, stderr = child.communicate(timeout=PATIENCE if can else GRACE)
            except subprocess.TimeoutExpired:
                interrupted = True
                child.send_signal(signal.SIGINT)
                try:
                    stdout, stderr = child.communicate(timeout=GRACE if can else 1.0)
                except subprocess.TimeoutExpired:
                    killed = True
                    os.killpg(child.pid, signal.SIGKILL)
                    stdout, stderr = child.communicate()
        if not can and interrupted:
            killed = True  # it was not meant to need that long
        taken = monotonic() - began
        command = tuple(command)
        return Ended(
            command, child.returncode, stdout or b"", stderr or b"", taken, interrupted, killed
        )
