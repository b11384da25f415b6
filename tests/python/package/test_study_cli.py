"""`python -m plydrape.study`, as a user calls it."""

from __future__ import annotations

import io
import re
from pathlib import Path

import pytest
from plydrape.study.__main__ import main
from plydrape.study.run import Progress
from studies import write


def test_a_study_is_run_and_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Exit code 0, the share, a line a limit, and the files, which are there."""
    path = write(tmp_path, 10)
    assert main([str(path)]) == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert "10 scenarios (latin-hypercube, seed 1), 0 failed" in said.out
    assert re.search(r"^slack ratio .* 0\.05  % ", said.out, re.MULTILINE)
    assert "accepted 0.0 % of 10 drapes (95 % interval 0.0 to 27.8 %)" in said.out
    files = re.findall(r"^wrote (.*)$", said.out, re.MULTILINE)
    assert len(files) == 2 and all(Path(file).is_file() for file in files)
    assert Path(files[0]).parent == tmp_path / "study.results"


def test_quiet_is_quiet(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Also in another folder, with one worker."""
    path = write(tmp_path, 4)
    assert main([str(path), "--quiet", "-o", str(tmp_path / "a" / "b"), "--workers", "1"]) == 0
    assert capsys.readouterr() == ("", "")
    assert (tmp_path / "a" / "b" / "study.parquet").is_file()


@pytest.mark.parametrize(
    ("options", "change", "words"),
    [
        ([], {"seed": "one"}, ["study.toml: `seed` = 'one'", "help: write a whole number"]),
        (["--workers", "0"], {}, ["0 workers"]),
        ([], {"scene": "absent.toml"}, ["no such file"]),
    ],
)
def test_bad_input_ends_with_2(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    options: list[str],
    change: dict[str, str],
    words: list[str],
) -> None:
    """One message with the key and the remedy, and no results."""
    path = write(tmp_path, 4, **change)
    assert main([str(path), *options]) == 2
    said = capsys.readouterr()
    assert said.out == "" and said.err.startswith("  × ")
    assert all(word in said.err for word in words)
    assert not (tmp_path / "study.results").exists()


def test_a_refused_scene_ends_with_2(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With the scene's own message."""
    (tmp_path / "scene.toml").write_text("[ply]\ngripers = [4, 2]\n")
    assert main([str(write(tmp_path, 4, scene="scene.toml"))]) == 2
    assert "gripers" in capsys.readouterr().err


class Terminal(io.StringIO):
    """A terminal that remembers."""

    def isatty(self) -> bool:
        """It is one."""
        return True


def test_progress_is_for_terminals_alone() -> None:
    """It counts what was done before, and what failed."""
    terminal, file = Terminal(), io.StringIO()
    for stream in (terminal, file):
        with Progress(100, 40, shown=True, stream=stream) as bar:
            for k in range(60):
                bar.add(failed=k < 3)
    assert file.getvalue() == ""
    shown = terminal.getvalue()
    assert "40 of 100" in shown and "100 of 100 scenarios" in shown and "3 failed" in shown
    assert shown.endswith("\x1b[K")
