"""The published scenes of benches/instance: their files, and the script that scores motions."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from program import ROOT, binary

INSTANCE = ROOT / "benches" / "instance"


def score(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Runs the script with the binary under test."""
    command = [sys.executable, str(INSTANCE / "score.py"), *arguments]
    environment = os.environ | {"PLYDRAPE": str(binary())}
    return subprocess.run(
        command, capture_output=True, text=True, timeout=300, check=False, env=environment
    )


def test_the_published_files_are_those_of_their_checksums() -> None:
    """Every file of every scene has a line, and nothing is published without one."""
    lines = (INSTANCE / "SHA256SUMS").read_text().splitlines()
    sums = {name: digest for digest, _, name in (line.partition("  ") for line in lines)}
    folders = [path.parent for path in INSTANCE.glob("*/scene.toml")]
    files = {str(path.relative_to(INSTANCE)) for folder in folders for path in folder.iterdir()}
    assert len(folders) == 6 and files == set(sums)
    for name, digest in sums.items():
        assert hashlib.sha256((INSTANCE / name).read_bytes()).hexdigest() == digest, name
    size = sum((INSTANCE / name).stat().st_size for name in sums)
    assert size < 3e6


def test_our_motion_has_our_figures() -> None:
    """The cheapest scene, draped anew along the published motion."""
    done = score("flat_paper", str(INSTANCE / "flat_paper" / "motion.csv"), "--json")
    assert done.returncode == 0, done.stderr
    ours = json.loads((INSTANCE / "flat_paper" / "figures.json").read_text())
    found = json.loads(done.stdout)
    limits = zip(found.pop("limits"), ours.pop("limits"), strict=True)
    assert found.pop("cells") is ours.pop("cells") is None, "an ideal cell has no errors"
    assert found == pytest.approx(ours, rel=1e-3, abs=1e-6)
    for row, due in limits:
        assert (row["name"], row["ok"]) == (due["name"], due["ok"])
        assert row["value"] == pytest.approx(due["value"], rel=1e-2, abs=1e-3), row["name"]


def test_a_motion_from_elsewhere_is_no_answer(tmp_path: Path) -> None:
    """A motion must start where ours does; the message says where that is."""
    motion = (INSTANCE / "flat_paper" / "motion.csv").read_text()
    (tmp_path / "motion.csv").write_text(motion.replace(",0.075000", ",0.005000"))
    done = score("flat_paper", str(tmp_path / "motion.csv"))
    assert done.returncode == 1 and "does not start at [0.0, 0.0, 0.075] m" in done.stderr


def test_the_guide_has_the_table_of_the_figures() -> None:
    """What the page "Beat this" shows is what the script prints from the files."""
    done = score("--table")
    assert done.returncode == 0, done.stderr
    assert done.stdout in (ROOT / "docs" / "guide" / "instance.md").read_text()
