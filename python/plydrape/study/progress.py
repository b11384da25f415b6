"""A bar on standard error while a study runs; nothing where that is no terminal."""

from __future__ import annotations

import sys
import time
from typing import TextIO

WIDTH = 30


class Progress:
    """How many scenarios are done, and how long the rest will take."""

    def __init__(self, total: int, done: int, shown: bool, stream: TextIO | None = None) -> None:
        """`done` were done in an earlier run."""
        self._stream = stream or sys.stderr
        self._shown = shown and self._stream.isatty()
        self._total, self._before, self._done, self._failed = total, done, done, 0
        self._start = self._last = time.monotonic()
        self._draw()

    def add(self, done: int, failed: int) -> None:
        """So many more are done, and so many of them failed."""
        self._done += done
        self._failed += failed
        if time.monotonic() - self._last > 0.1 or self._done == self._total:
            self._draw()

    def close(self) -> None:
        """Clears the line."""
        if self._shown:
            print("\r\x1b[K", end="", file=self._stream, flush=True)

    def _draw(self) -> None:
        if not self._shown:
            return
        self._last = time.monotonic()
        share = self._done / self._total if self._total else 1.0
        bar = "█" * int(share * WIDTH) + "░" * (WIDTH - int(share * WIDTH))
        text = f"{bar} {self._done} of {self._total} scenarios"
        new = self._done - self._before
        if new:
            left = (self._last - self._start) / new * (self._total - self._done)
            text += f", {left // 60:.0f}:{left % 60:02.0f} left"
        if self._failed:
            text += f", {self._failed} failed"
        print(f"\r\x1b[K{text}", end="", file=self._stream, flush=True)
