"""Workers that die: no row is lost, none comes twice, and a deadly scenario is a row."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest
from deadly import Deadly
from plydrape.study import StudyError
from plydrape.study.scenario import Line
from plydrape.study.workers import Pool, _starting, here
from studies import study, write


def by_number(lines: Iterable[Line | None]) -> dict[int, Line]:
    """Rows by their scenarios, none of which comes twice."""
    rows: dict[int, Line] = {}
    for line in lines:
        if line is not None:
            number = line["scenario"]
            assert isinstance(number, int) and number not in rows
            rows[number] = line
    return rows


def test_a_scenario_that_kills_its_worker_is_a_row() -> None:
    """Real processes, real SIGKILL; the rows beside it are as ever."""
    made = study(30)
    task = Deadly(**vars(made.task) | {"victim": 11})
    rows = by_number(here(task, made.values, list(range(30)), workers=2, every=1.0))
    assert set(rows) == set(range(30))
    assert rows[11]["error_kind"] == "WorkerDied" and "died 3 times" in str(rows[11]["error"])
    assert rows[11]["grippers.height"] == made.values[11][1]
    wanted = {k: made.task.row(k, made.values[k]) for k in range(30) if k != 11}
    assert {k: row for k, row in rows.items() if k != 11} == wanted


def test_a_killed_worker_costs_no_row() -> None:
    """One is killed from outside while it works, twice; others take its place and end too."""
    made = study(120)
    others = set(multiprocessing.active_children())
    killed: list[int] = []
    lines: list[Line | None] = []
    for line in here(made.task, made.values, list(range(120)), workers=2, every=1.0):
        lines.append(line)
        if len(lines) in (30, 60):
            workers = set(multiprocessing.active_children()) - others
            worker = next(p for p in workers if p.pid not in killed)
            assert worker.pid is not None
            killed.append(worker.pid)
            os.kill(worker.pid, signal.SIGKILL)
    assert len(killed) == 2
    assert by_number(lines) == {k: made.task.row(k, made.values[k]) for k in range(120)}
    assert set(multiprocessing.active_children()) <= others


def test_only_what_is_left_to_do_is_done() -> None:
    """Scenarios that were done before are not run again."""
    made = study(20)
    assert set(by_number(here(made.task, made.values, [3, 4, 19], 2, 1.0))) == {3, 4, 19}


def test_workers_end_when_their_rows_are_wanted_no_more() -> None:
    """As after Ctrl-C, or where a row cannot be written."""
    made = study(200)
    others = set(multiprocessing.active_children())
    lines = here(made.task, made.values, list(range(200)), workers=2, every=1.0)
    assert next(line for line in lines if line is not None)["error"] is None
    assert len(set(multiprocessing.active_children()) - others) == 2
    lines.close()
    assert set(multiprocessing.active_children()) <= others


def test_an_interruption_waits_until_workers_are_started() -> None:
    """Otherwise one that has not got its task yet would end with a traceback; later all hear it."""

    def held() -> set[signal.Signals | int]:
        return set(signal.pthread_sigmask(signal.SIG_BLOCK, []))

    before = held()
    with _starting():
        assert {signal.SIGINT, signal.SIGTERM} <= held()
    assert held() == before
    with Pool(1) as pool:
        found = pool._pool.submit(signal.pthread_sigmask, signal.SIG_BLOCK, [])
        assert signal.SIGTERM not in found.result()


def test_a_worker_that_cannot_be_started_is_an_error() -> None:
    """Nobody waits for it forever."""
    made = study(2)
    multiprocessing.set_executable("/no/such/python")
    try:
        with pytest.raises(StudyError, match="a worker process cannot be started"):
            by_number(here(made.task, made.values, [0, 1], workers=1, every=1.0))
    finally:
        multiprocessing.set_executable(sys.executable)


def test_a_script_without_a_guard_is_one_message(tmp_path: Path) -> None:
    """Workers import the script that runs a study; it says what to write, and no row is lost."""
    write(tmp_path, 4)
    script = tmp_path / "script.py"
    script.write_text("import plydrape.study\nplydrape.study.run('study.toml', workers=1)\n")
    done = subprocess.run(
        [sys.executable, script.name], cwd=tmp_path, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 1
    last = done.stderr.strip().splitlines()[-1]
    assert "a worker process cannot be started" in last and '__name__ == "__main__"' in last
    assert not list(tmp_path.glob("study.results/rows/*"))


def test_a_worker_of_another_version_is_refused() -> None:
    """Its rows would be of another program."""
    made = study(4)
    task = Deadly(**vars(made.task) | {"version": "9.9.9"})
    with pytest.raises(StudyError, match=r"plydrape 0\..*the study 9\.9\.9"):
        by_number(here(task, made.values, [0, 1, 2, 3], workers=1, every=1.0))
