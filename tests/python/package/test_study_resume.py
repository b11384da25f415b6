"""Interrupted studies go on: nothing is repeated, nothing lost, nothing mixed."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import plydrape.study
import pyarrow.parquet as pq
import pytest
from plydrape.study import Study, StudyError
from plydrape.study.folder import Folder
from plydrape.study.run import run
from studies import study, write

SAMPLES = 240
RUN = "import sys, plydrape.study as s; s.run(sys.argv[1], workers=2, every=0.05, progress=False)"


def begin(path: Path) -> subprocess.Popen[bytes]:
    """A client in a process of its own, with at least three parts written."""
    client = subprocess.Popen([sys.executable, "-c", RUN, str(path)])
    rows = path.with_name("study.results") / "rows"
    deadline = time.monotonic() + 30
    while len(list(rows.glob("part-*"))) < 3:
        assert client.poll() is None and time.monotonic() < deadline
        time.sleep(0.005)
    return client


def test_a_killed_client_repeats_and_loses_no_row(tmp_path: Path) -> None:
    """SIGKILL twice in the middle; what was written before stays, byte for byte."""
    path = write(tmp_path, SAMPLES)
    results = tmp_path / "study.results"
    before: dict[str, tuple[int, bytes]] = {}
    for _ in range(2):
        client = begin(path)
        client.kill()
        client.wait()
        parts = {p.name: (p.stat().st_mtime_ns, p.read_bytes()) for p in results.glob("rows/p*")}
        assert before.items() <= parts.items()
        before = parts
        done = plydrape.study.read(results).table().num_rows
        assert 3 <= done < SAMPLES and not (results / "study.parquet").exists()
    run(path, workers=2)
    after = {p.name: (p.stat().st_mtime_ns, p.read_bytes()) for p in results.glob("rows/p*")}
    assert before.items() < after.items()
    assert sum(pq.read_metadata(p).num_rows for p in results.glob("rows/*")) == SAMPLES

    run(Study.read(path), output=tmp_path / "whole", workers=2)
    for name in ("study.parquet", "summary.json", "summary.html"):
        assert (results / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()


def test_workers_end_with_their_client(tmp_path: Path) -> None:
    """Nobody goes on computing for a client that is gone."""
    client = begin(write(tmp_path, 4000))
    children = Path(f"/proc/{client.pid}/task/{client.pid}/children")
    if not children.exists():
        client.kill()
        pytest.skip("NOT CHECKED: this system does not list the children of a process")
    threads = Path(f"/proc/{client.pid}/task").iterdir()
    workers = [int(p) for t in threads for p in (t / "children").read_text().split()]
    assert len(workers) == 2
    client.kill()
    client.wait()
    deadline = time.monotonic() + 10
    while any(alive(pid) for pid in workers):
        assert time.monotonic() < deadline
        time.sleep(0.02)


def alive(pid: int) -> bool:
    """Whether a process runs; one that has ended and was not waited for does not."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"


def test_a_finished_study_runs_nothing_again(tmp_path: Path) -> None:
    """The second run writes no part."""
    path = write(tmp_path, 8)
    run(path, workers=1)
    rows = tmp_path / "study.results" / "rows"
    times = {p.name: p.stat().st_mtime_ns for p in rows.iterdir()}
    outcome = run(path, workers=1)
    assert {p.name: p.stat().st_mtime_ns for p in rows.iterdir()} == times
    assert outcome.table().num_rows == 8


def test_a_changed_definition_is_refused(tmp_path: Path) -> None:
    """The message says what changed; the rows stay as they are."""
    run(write(tmp_path, 4), workers=1)
    before = sorted((tmp_path / "study.results" / "rows").iterdir())
    for change, word in (({"seed": 9}, "`seed`"), ({"samples": 5}, "`scenarios`")):
        path = write(tmp_path, **({"samples": 4} | change))  # type: ignore[arg-type]
        with pytest.raises(StudyError, match=f"{word}.* changed"):
            run(path, workers=1)
    assert sorted((tmp_path / "study.results" / "rows").iterdir()) == before


def test_another_version_does_not_go_on(tmp_path: Path) -> None:
    """Its rows could differ."""
    path = write(tmp_path, 4)
    run(path, workers=1)
    manifest = tmp_path / "study.results" / "study.json"
    content = json.loads(manifest.read_text())
    manifest.write_text(json.dumps(content | {"program": "plydrape 0.0.1"}))
    with pytest.raises(StudyError, match=r"begun with plydrape 0\.0\.1"):
        run(path, workers=1)


def test_a_folder_of_something_else_is_left_alone(tmp_path: Path) -> None:
    """Nothing is written into it."""
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    with pytest.raises(StudyError, match="not empty, and no study's folder"):
        run(study(2), output=tmp_path / "mine", workers=1)
    assert [p.name for p in (tmp_path / "mine").iterdir()] == ["notes.txt"]


def test_two_cannot_run_in_one_folder(tmp_path: Path) -> None:
    """The second is told so; the first is not disturbed."""
    first = Folder(tmp_path / "out")
    first.begin(study(2))
    with pytest.raises(StudyError, match="another process is running"):
        run(study(2), output=tmp_path / "out", workers=1)
    first.close()
    assert run(study(2), output=tmp_path / "out", workers=1).table().num_rows == 2


def test_a_damaged_part_is_named(tmp_path: Path) -> None:
    """With it removed, its scenarios are run again and the study is as before."""
    path = write(tmp_path, 12)
    run(path, workers=1)
    whole = (tmp_path / "study.results" / "study.parquet").read_bytes()
    part = sorted((tmp_path / "study.results" / "rows").iterdir())[1]
    part.write_bytes(part.read_bytes()[:100])
    with pytest.raises(StudyError, match=f"{part.name}` cannot be read.*remove it"):
        run(path, workers=1)
    part.unlink()
    run(path, workers=1)
    assert (tmp_path / "study.results" / "study.parquet").read_bytes() == whole


def test_ctrl_c_keeps_what_is_finished(tmp_path: Path) -> None:
    """Exit code 130, and a word on how to go on; going on works."""
    path = write(tmp_path, 3000)
    command = [sys.executable, "-m", "plydrape.study", str(path), "--workers", "2"]
    client = subprocess.Popen(command, stderr=subprocess.PIPE, start_new_session=True)
    rows = tmp_path / "study.results" / "rows"
    deadline = time.monotonic() + 30
    while len(list(rows.glob("part-*"))) < 3:
        assert client.poll() is None and time.monotonic() < deadline
        time.sleep(0.01)
    os.killpg(client.pid, signal.SIGINT)
    _, said = client.communicate(timeout=30)
    assert client.returncode == 130, said.decode()
    assert "the same command goes on" in said.decode() and "Traceback" not in said.decode()
    assert 3 <= plydrape.study.read(tmp_path / "study.results").table().num_rows < 3000
