"""A task that kills its worker: a module of its own, since workers import it."""

from __future__ import annotations

import os
import signal
from collections.abc import Sequence
from dataclasses import dataclass

from plydrape.study.keys import Value
from plydrape.study.scenario import Line, Task


@dataclass(frozen=True, eq=False)
class Deadly(Task):
    """Scenario `victim` kills the process that runs it, every time."""

    victim: int = -1

    def row(self, scenario: int, values: Sequence[Value]) -> Line:
        """The row, or the end."""
        if scenario == self.victim:
            os.kill(os.getpid(), signal.SIGKILL)
        return super().row(scenario, values)
