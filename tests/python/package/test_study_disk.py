"""Disks and outputs that take no more: one message, exit code 2, nothing half, and it goes on."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from plydrape.study import StudyError
from plydrape.study.folder import write as write_whole
from plydrape.study.run import run
from studies import write

resource = pytest.importorskip("resource")
FULL = Path("/dev/full")
# The command, with a part for each scenario, however fast the machine is.
SINGLE = (
    "import functools, sys; from plydrape.study import __main__ as command; "
    "command.run = functools.partial(command.run, every=1e-9); sys.exit(command.main())"
)


def command(
    path: Path,
    most: int = -1,
    stdout: int = subprocess.PIPE,
    stderr: int = subprocess.PIPE,
    single: bool = False,
) -> tuple[int, str]:
    """The exit code and what it says on standard error; no file grows beyond `most` bytes.

    It writes no compiled modules: Python 3.11 would leave half of one for every later process.
    """
    module = ("-c", SINGLE) if single else ("-m", "plydrape.study")
    done = subprocess.run(
        [sys.executable, *module, str(path), "--workers", "1"],
        stdout=stdout,
        stderr=stderr,
        text=True,
        timeout=120,
        env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"},
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)),
    )
    return done.returncode, done.stderr


def test_a_file_that_cannot_be_written_ends_with_2_and_the_study_goes_on(tmp_path: Path) -> None:
    """First the parts are too large, then the table of all rows; the system says so (EFBIG)."""
    path = write(tmp_path, 40)
    results = tmp_path / "study.results"
    code, said = command(path, 10_000)
    assert code == 2 and "Traceback" not in said and said.count("×") == 1
    assert "part-000000.parquet` cannot be written: File too large" in said
    assert "help: make room and run the same command again" in said
    assert sorted(p.name for p in results.rglob("*")) == [".lock", "rows", "study.json"]

    # Enough for a part of a single scenario.
    code, said = command(path, 55_000, single=True)
    assert code == 2 and "cannot be written: File too large" in said
    kept = {p.name: p.stat().st_mtime_ns for p in results.glob("rows/*")}
    assert kept and not list(results.rglob("*.tmp"))
    assert command(path) == (0, "")
    assert kept.items() <= {p.name: p.stat().st_mtime_ns for p in results.glob("rows/*")}.items()
    run(path, output=tmp_path / "whole", workers=1)
    for name in ("study.parquet", "summary.json"):
        assert (results / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()
    assert pq.read_metadata(results / "study.parquet").num_rows == 40


def test_a_full_disk_is_named(tmp_path: Path) -> None:
    """ENOSPC of the system's own full device; the name that was there before stays."""
    if not FULL.exists():
        pytest.skip("NOT CHECKED: this system has no /dev/full")
    (tmp_path / "file").write_bytes(b"before")
    (tmp_path / ".file.tmp").symlink_to(FULL)
    with pytest.raises(StudyError, match=r"file` cannot be written: No space left.*make room"):
        write_whole(tmp_path / "file", b"after")
    assert [p.name for p in tmp_path.iterdir()] == ["file"]
    assert (tmp_path / "file").read_bytes() == b"before"


def test_output_that_cannot_be_written_ends_with_4(tmp_path: Path) -> None:
    """The rows are there; a reader that has seen enough is no failure."""
    path = write(tmp_path, 3)
    if not FULL.exists():
        pytest.skip("NOT CHECKED: this system has no /dev/full")
    full = os.open(FULL, os.O_WRONLY)
    code, said = command(path, stdout=full)
    silent, _ = command(path, stdout=full, stderr=full)
    os.close(full)
    assert (code, silent) == (4, 4) and "Traceback" not in said
    assert said.startswith("  × standard output cannot be written: No space left on device")
    assert (tmp_path / "study.results" / "study.parquet").is_file()

    read, written = os.pipe()
    os.close(read)
    assert command(path, stdout=written) == (0, "")
    os.close(written)
