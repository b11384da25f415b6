"""Programs for robots, checked by tools from elsewhere: rapidchecker for RAPID, krllint for KRL."""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING

import pytest
from exported import SCENE, made

if TYPE_CHECKING:
    from pathlib import Path

TOOL = """
[tool]
axes = [
    { direction = "x", stroke = ["-10 mm", "10 mm"], speed = "0.1 m/s" },
    { direction = "z", stroke = ["-80 mm", "80 mm"], speed = "0.2 m/s" },
]
flange = { position = [0, 0, "300 mm"], rotation = ["180 deg", 0, 0] }
world = { position = ["1.4 m", 0, "0.5 m"] }
[robot]
arm = "abb_irb4600_60_205"
"""


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The programs of a drape by a known arm with more axes than a controller moves."""
    result = made("simulate", tmp_path_factory.mktemp("programs"), SCENE + TOOL)
    return {kind: result.export(kind) for kind in ("rapid", "krl")}


def run(*command: str) -> str:
    """What a checker says."""
    found = subprocess.run(
        [sys.executable, "-m", *command], capture_output=True, text=True, check=False
    )
    return found.stdout + found.stderr


def test_rapidchecker_finds_no_error(programs: dict[str, Path], tmp_path: Path) -> None:
    """Neither in the program nor in the file of the cell, and an error in a broken copy."""
    files = sorted(programs["rapid"].glob("*.mod"))
    assert len(files) == 2
    assert any("MoveAbsJ" in file.read_text() for file in files)
    for file in files:
        assert "No RAPID format errors found" in run("rapidchecker", str(file)), file
    broken = tmp_path / "broken.mod"
    broken.write_text(files[0].read_text().replace("ENDMODULE", ""))
    assert "No RAPID format errors found" not in run("rapidchecker", str(broken))


def test_krllint_finds_no_error(programs: dict[str, Path]) -> None:
    """It warns of indentation alone."""
    files = [*programs["krl"].glob("*.src"), *programs["krl"].glob("*.dat")]
    assert len(files) == 2
    assert any("E6AXIS" in file.read_text() for file in files)
    for file in files:
        said = run("krllint", str(file))
        assert "0 found errors" in said and "0 fatal errors" in said, said
