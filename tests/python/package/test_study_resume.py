"""Interrupted studies go on: nothing is repeated, nothing lost, nothing mixed."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import plydrape.study
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from plydrape.study import Study, StudyError
from plydrape.study.__main__ import main
from plydrape.study.folder import FINISHED, Folder
from plydrape.study.run import run
from studies import study, write

SAMPLES = 240
RUN = "import sys, plydrape.study as s; s.run(sys.argv[1], workers=2, every=0.05, progress=False)"
# The command, which writes a part twenty times a second: three parts are there at once.
OFTEN = (
    "import functools, sys; from plydrape.study import __main__ as command; "
    "command.run = functools.partial(command.run, every=0.05); sys.exit(command.main())"
)


def workers_of(client: subprocess.Popen[bytes]) -> list[int]:
    """Process ids of the workers of a client."""
    if not Path(f"/proc/{client.pid}/task/{client.pid}/children").exists():
        client.kill()
        pytest.skip("NOT CHECKED: this system does not list the children of a process")
    threads = Path(f"/proc/{client.pid}/task").iterdir()
    children = [int(p) for t in threads for p in (t / "children").read_text().split()]
    # Beside them there is a tracker of multiprocessing.
    return [p for p in children if b"spawn_main" in Path(f"/proc/{p}/cmdline").read_bytes()]


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
    for name in ("study.parquet", "summary.json"):
        assert (results / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()


def test_workers_end_with_their_client(tmp_path: Path) -> None:
    """Nobody goes on computing for a client that is gone."""
    client = begin(write(tmp_path, 4000))
    workers = workers_of(client)
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


def test_a_finished_study_is_left_as_it_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A note in a file stays, no file is written; one line says so, the exit code is 0."""
    path = write(tmp_path, 8)
    assert main([str(path), "--workers", "1"]) == 0
    first = capsys.readouterr().out
    results = tmp_path / "study.results"
    with open(results / "summary.json", "a", encoding="utf-8") as file:
        file.write("my note")
    before = {p: (p.stat().st_mtime_ns, p.read_bytes()) for p in results.rglob("*") if p.is_file()}
    assert main([str(path)]) == 0
    after = {p: (p.stat().st_mtime_ns, p.read_bytes()) for p in results.rglob("*") if p.is_file()}
    assert after == before
    # The same figures; instead of the files that were written, one line.
    second = capsys.readouterr().out
    said = f"{results} was finished before: nothing was run or written\n"
    assert second == first[: first.index("wrote ")] + said


def test_only_what_is_missing_of_a_finished_study_is_written(tmp_path: Path) -> None:
    """Each of its files, byte for byte as before; the others keep a note."""
    path = write(tmp_path, 4)
    run(path, workers=1)
    results = tmp_path / "study.results"
    for name in FINISHED:
        content = (results / name).read_bytes()
        others = [results / other for other in FINISHED if other != name]
        for other in others:
            other.write_bytes(other.read_bytes() + b"note")
        noted = [other.read_bytes() for other in others]
        (results / name).unlink()
        assert run(path, workers=1).written == [name]
        assert (results / name).read_bytes() == content
        assert [other.read_bytes() for other in others] == noted
        for other in others:
            other.write_bytes(other.read_bytes().removesuffix(b"note"))


def part(first: int) -> str:
    """Name of a part file."""
    return f"part-{first:06}.parquet"


@pytest.fixture(scope="module")
def divided(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a study of 12 scenarios whose parts hold 1, 4 and 7 of them."""
    folder = tmp_path_factory.mktemp("divided")
    run(write(folder, 12), workers=1, every=1e9)
    rows = folder / "study.results" / "rows"
    whole = pq.read_table(folder / "study.results" / "study.parquet")
    for old in rows.iterdir():
        old.unlink()
    for first, stop in ((0, 1), (1, 5), (5, 12)):
        pq.write_table(whole.slice(first, stop - first), rows / part(first))
    return folder


def copied(rows: Path) -> str:
    """A part over another."""
    shutil.copy(rows / part(5), rows / part(0))
    return r"part-000000.parquet` begins with scenario 5, and not as its name says; remove it"


def twice(rows: Path) -> str:
    """Scenarios in two parts."""
    whole = [pq.read_table(rows / part(first)) for first in (0, 1)]
    pq.write_table(pa.concat_tables(whole), rows / part(0))
    return "part-000001.parquet` and `part-000000.parquet` hold the same scenario, 1; remove one"


def emptied(rows: Path) -> str:
    """No rows."""
    pq.write_table(pq.read_table(rows / part(1)).slice(0, 0), rows / part(1))
    return "part-000001.parquet` cannot be read: it has no rows.*remove it"


def stripped(rows: Path) -> str:
    """No numbers of scenarios."""
    pq.write_table(pq.read_table(rows / part(1)).drop(["scenario"]), rows / part(1))
    return "part-000001.parquet` cannot be read.*remove it"


def unjudged(rows: Path) -> str:
    """No column that says why there is no result."""
    pq.write_table(pq.read_table(rows / part(1)).drop(["error"]), rows / part(1))
    return "part-000001.parquet` cannot be read: .*no column error.*remove it"


def other_types(rows: Path) -> str:
    """Texts in a column of numbers."""
    table = pq.read_table(rows / part(1))
    at = table.column_names.index("worst_slack_mm")
    texts = pa.array(["a", "b", "c", "d"])
    pq.write_table(table.set_column(at, "worst_slack_mm", texts), rows / part(1))
    return "parts in `rows` do not fit together: .*worst_slack_mm.*remove those"


def beyond(rows: Path) -> str:
    """Scenarios that the study has not."""
    table = pq.read_table(rows / part(5))
    later = table.set_column(0, "scenario", pa.array(range(12, 19)))
    pq.write_table(later, rows / part(12))
    return "part-000012.parquet` is not of this study: it has 12 scenarios.*remove it"


def foreign(rows: Path) -> str:
    """The right numbers, of a study with other heights."""
    table = pq.read_table(rows / part(1))
    at = table.column_names.index("grippers.height")
    other = pa.array([80.0, 81.0, 82.0, 83.0])
    pq.write_table(table.set_column(at, "grippers.height", other), rows / part(1))
    return "part-000001.parquet` is not of this study: the column `grippers.height`"


HARMS = [copied, twice, emptied, stripped, beyond, foreign, unjudged, other_types]
# What is seen in the columns that are read before scenarios are run.
EARLY = [copied, twice, emptied, stripped, beyond, foreign]


@pytest.mark.parametrize(
    ("harm", "complete"), [*((h, True) for h in HARMS), *((h, False) for h in EARLY)]
)
def test_a_part_that_does_not_agree_with_its_name_is_refused(
    tmp_path: Path,
    divided: Path,
    harm: Callable[[Path], str],
    complete: bool,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Exit code 2 and one message, whether scenarios are left to run or not; nothing is written."""
    shutil.copytree(divided, tmp_path, dirs_exist_ok=True)
    rows = tmp_path / "study.results" / "rows"
    match = harm(rows)
    if not complete:
        (rows / part(5)).unlink()
    before = {p: p.stat().st_mtime_ns for p in (tmp_path / "study.results").rglob("*")}
    assert main([str(tmp_path / "study.toml"), "--quiet"]) == 2
    said = capsys.readouterr()
    assert re.search(match.replace("; remove", r"\n  help: remove"), said.err, re.DOTALL)
    assert said.out == "" and said.err.count("×") == 1
    assert {p: p.stat().st_mtime_ns for p in (tmp_path / "study.results").rglob("*")} == before


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ('{"a":' * 100_000 + "1" + "}" * 100_000, "study.json` cannot be read: .*recursion"),
        ('{"seed": ' + "9" * 5000 + "}", "study.json` cannot be read"),
        ('{"format": "plydrape-study"}', "study.json` has no definition"),
        ("[]", "study.json` is no study of plydrape"),
    ],
    ids=["deep", "long", "short", "foreign"],
)
def test_a_damaged_study_json_is_one_message(
    tmp_path: Path, content: str, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """With exit code 2, and for readers of the rows too."""
    path = write(tmp_path, 2)
    run(path, workers=1)
    (tmp_path / "study.results" / "study.json").write_text(content)
    if "no definition" not in words:
        assert main([str(path)]) == 2
        said = capsys.readouterr().err
        assert re.search(words, said) and "help: choose another folder" in said
    with pytest.raises(StudyError, match=words):
        plydrape.study.read(tmp_path / "study.results")


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
    """The second is refused; the first is not disturbed."""
    first = Folder(tmp_path / "out")
    first.begin(study(2))
    with pytest.raises(StudyError, match="another process is running"):
        run(study(2), output=tmp_path / "out", workers=1)
    first.close()
    assert run(study(2), output=tmp_path / "out", workers=1).table().num_rows == 2


def test_a_damaged_part_is_named(tmp_path: Path) -> None:
    """With it removed, its scenarios are run again and the study is as before."""
    path = write(tmp_path, 12)
    run(path, workers=1, every=0.01)
    whole = (tmp_path / "study.results" / "study.parquet").read_bytes()
    part = sorted((tmp_path / "study.results" / "rows").iterdir())[1]
    part.write_bytes(part.read_bytes()[:100])
    with pytest.raises(StudyError, match=f"{part.name}` cannot be read.*remove it"):
        run(path, workers=1)
    part.unlink()
    run(path, workers=1)
    assert (tmp_path / "study.results" / "study.parquet").read_bytes() == whole


@pytest.mark.parametrize("how", ["Ctrl-C", "SIGTERM", "SIGTERM twice"])
def test_an_interrupted_study_keeps_what_is_finished(tmp_path: Path, how: str) -> None:
    """Exit code 130, a word on how to go on, no worker left, nothing half; going on works."""
    path = write(tmp_path, 3000)
    command = [sys.executable, "-c", OFTEN, str(path), "--workers", "2"]
    client = subprocess.Popen(command, stderr=subprocess.PIPE, start_new_session=True)
    results = tmp_path / "study.results"
    deadline = time.monotonic() + 30
    while len(list(results.glob("rows/part-*"))) < 3:
        assert client.poll() is None and time.monotonic() < deadline
        time.sleep(0.01)
    workers = workers_of(client)
    assert len(workers) == 2 and all(alive(pid) for pid in workers)
    if how == "Ctrl-C":
        os.killpg(client.pid, signal.SIGINT)
    else:
        # To the client alone, as `kill` sends it; twice, as `timeout` does.
        os.kill(client.pid, signal.SIGTERM)
        if how == "SIGTERM twice":
            time.sleep(0.01)
            os.kill(client.pid, signal.SIGTERM)
    _, said = client.communicate(timeout=30)
    # The client has waited for its workers: they are gone when it is.
    assert not any(alive(pid) for pid in workers)
    assert client.returncode == 130, said.decode()
    assert "the same command goes on" in said.decode() and "Traceback" not in said.decode()
    assert not list(results.rglob("*.tmp"))
    kept = {p.name: p.stat().st_mtime_ns for p in results.glob("rows/*")}
    assert 3 <= plydrape.study.read(results).table().num_rows < 3000
    again = subprocess.Popen(command, stderr=subprocess.PIPE, start_new_session=True)
    deadline = time.monotonic() + 30
    while len(list(results.glob("rows/part-*"))) < len(kept) + 2:
        assert again.poll() is None and time.monotonic() < deadline
        time.sleep(0.01)
    again.terminate()
    again.communicate(timeout=30)
    assert again.returncode == 130
    assert kept.items() < {p.name: p.stat().st_mtime_ns for p in results.glob("rows/*")}.items()
