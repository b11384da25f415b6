"""A real Dask cluster on this machine: a scheduler and two workers as processes of their own."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest
from deadly import Deadly
from distributed import Client
from plydrape.study import Study, StudyError, workers
from plydrape.study.folder import Folder
from plydrape.study.run import run
from plydrape.study.scenario import Line
from studies import study

DASK = [sys.executable, "-m", "dask"]
HERE = str(Path(__file__).parent)


@dataclass
class Processes:
    """The cluster of a test."""

    address: str
    scheduler: subprocess.Popen[bytes]
    workers: list[subprocess.Popen[bytes]]

    def add_worker(self) -> None:
        """One more, of one thread."""
        options = ["--nthreads", "1", "--no-nanny", "--no-dashboard", "--memory-limit", "0"]
        log = subprocess.DEVNULL
        search = os.environ | {"PYTHONPATH": HERE}
        command = [*DASK, "worker", self.address, *options]
        self.workers.append(subprocess.Popen(command, stdout=log, stderr=log, env=search))


@pytest.fixture
def processes(tmp_path: Path) -> Iterator[Processes]:
    """A scheduler on a free port with two workers; all end with the test."""
    log = tmp_path / "scheduler.log"
    with open(log, "wb") as file:
        command = [*DASK, "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
        scheduler = subprocess.Popen(command, stdout=file, stderr=file, cwd=tmp_path)
    started: Processes | None = None
    try:
        deadline = time.monotonic() + 30
        while (at := re.search(r"Scheduler at:\s+(tcp://\S+:\d+)", log.read_text())) is None:
            assert scheduler.poll() is None and time.monotonic() < deadline, log.read_text()
            time.sleep(0.05)
        started = Processes(at[1], scheduler, [])
        started.add_worker()
        started.add_worker()
        yield started
    finally:
        for process in [scheduler, *(started.workers if started else [])]:
            process.kill()
            process.wait()


def test_a_killed_dask_worker_costs_no_row(
    processes: Processes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`kill -9` of one of two in the middle: the rows are those of a local run, byte for byte."""
    with Client(processes.address, set_as_default=False) as client:
        client.wait_for_workers(2, timeout=30)

    made = study(240)
    seen: list[int] = []
    keep = Folder.keep

    def keeping(self: Folder, rows: list[Line], study: Study) -> None:
        keep(self, rows, study)
        seen.append(len(rows))
        if len(seen) == 2:
            processes.workers[0].send_signal(signal.SIGKILL)

    monkeypatch.setattr(Folder, "keep", keeping)
    run(made, output=tmp_path / "dask", scheduler=processes.address, every=0.1)
    monkeypatch.undo()
    assert processes.workers[0].wait(10) == -signal.SIGKILL
    assert processes.workers[1].poll() is None
    assert sum(seen) == 240 and len(seen) > 2
    run(made, output=tmp_path / "local", workers=2)
    for name in ("study.parquet", "summary.json"):
        there, here = (tmp_path / where / name for where in ("dask", "local"))
        assert there.read_bytes() == here.read_bytes()


def test_a_scenario_that_kills_dask_workers_is_a_row(processes: Processes) -> None:
    """It kills four, and there are more; the rows beside it are as ever."""
    made = study(3)
    task = Deadly(**vars(made.task) | {"victim": 1})
    for _ in range(6):
        processes.add_worker()
    lines = workers.on_cluster(task, made.values, [0, 1, 2], processes.address, every=1.0)
    rows = {line["scenario"]: line for line in lines if line is not None}
    assert set(rows) == {0, 1, 2} and rows[1]["error_kind"] == "WorkerDied"
    assert rows[0] == made.task.row(0, made.values[0]) and rows[2]["error"] is None


def test_a_scheduler_that_goes_away_ends_the_study(
    processes: Processes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With a message; what was finished is kept and the study goes on without it."""
    made = study(400)
    keep = Folder.keep

    def keeping(self: Folder, rows: list[Line], study: Study) -> None:
        keep(self, rows, study)
        processes.scheduler.kill()

    monkeypatch.setattr(Folder, "keep", keeping)
    with pytest.raises(StudyError, match=r"(?s)is gone.*finished rows are kept"):
        run(made, output=tmp_path / "out", scheduler=processes.address, every=0.1)
    monkeypatch.undo()
    assert list((tmp_path / "out" / "rows").glob("part-*"))
    assert run(made, output=tmp_path / "out", workers=2).table().num_rows == 400


def test_no_scheduler_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """With how to start one."""
    monkeypatch.setattr(workers, "PATIENCE", 1)
    with pytest.raises(StudyError, match=r"no Dask scheduler at.*`dask scheduler`"):
        run(study(2), scheduler="tcp://127.0.0.1:9")
