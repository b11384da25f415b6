"""Runs the plydrape binary and reads what it writes."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import pytest
import record
from oracle import Problem

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT.parent / "shared" / "data"


def binary() -> Path:
    """The program under test: $PLYDRAPE or the release build; skips where there is none."""
    path = Path(os.environ.get("PLYDRAPE", ROOT / "target" / "release" / "plydrape"))
    if not path.is_file():
        pytest.skip(f"NOT COMPARED WITH THE PROGRAM: no binary at {path}; cargo build --release")
    return path


def data(name: str) -> Any:
    """A JSON file of reference data kept beside the project; skips where it is absent."""
    path = DATA / name
    if not path.is_file():
        pytest.skip(f"NOT COMPARED WITH REFERENCE DATA: {path} is absent")
    return json.loads(path.read_text())


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Runs plydrape. Exit 1 (limits exceeded) is an answer; anything above fails the test."""
    command = [str(binary()), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode in (0, 1), f"{command}\nexit {done.returncode}\n{done.stderr}"
    return done


def number(value: float) -> str:
    """A TOML float that reads back as the same number."""
    return "inf" if value == float("inf") else repr(float(value))


def stiffness(value: float) -> str:
    """An axial stiffness; a soft one is believed with its unit alone."""
    return "inf" if value == float("inf") else f'"{value!r} N"'


def scene(problem: Problem) -> str:
    """The problem as a scene file that holds its grippers still."""
    nu, nv = problem.size
    rows = [
        "  [" + ", ".join("[" + ", ".join(number(c) for c in p) + "]" for p in row) + "],"
        for row in problem.positions
    ]
    return "\n".join(
        [
            "[ply]",
            f"grippers = [{nu}, {nv}]",
            f"cell = [{number(problem.cell[0])}, {number(problem.cell[1])}]",
            "[ply.material]",
            'name = "of the test"',
            'source = "Krogh et al. 2018, Table 1, unless the test changes it"',
            f'mass = "{number(problem.mass)} kg/m"',
            f'flexural_rigidity = "{number(problem.rigidity)} N m^2"',
            "[grippers]",
            "positions = [",
            *rows,
            "]",
            f'max_tilt = "{number(problem.max_tilt * 180.0 / 3.141592653589793)} deg"',
            "[motion]",
            'kind = "hold"',
            "[model]",
            'kind = "catenaries"',
            f'slopes = "{problem.rule}"',
            f"axial_stiffness = {stiffness(problem.axial_stiffness)}",
            f"gravity = {number(problem.gravity)}",
            "",
        ]
    )


def simulate(problem: Problem, folder: Path) -> Any:
    """The first step of the result file of a problem."""
    path = folder / "scene.toml"
    path.write_text(scene(problem))
    run("simulate", str(path), "-o", str(folder / "out"), "--json")
    return record.read(folder / "out" / "result.json")["steps"][0]
