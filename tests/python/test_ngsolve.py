"""The script of ``--to ngsolve`` drapes as plydrape's sheet does: a square hung at four corners."""

from __future__ import annotations

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from program import run

SQUARE = """
title = "A square hung at four corners"
[ply]
grippers = [2, 2]
cell = ["100 mm", "100 mm"]
[ply.material]
mass = "0.3143 kg/m^2"
bending_rigidity_warp = "9e-5 N m"
bending_rigidity_weft = "9e-5 N m"
shear_curve = "5 N/m"
tension = "20000 N/m"
[grippers]
spacing = ["98 mm", "98 mm"]
height = "75 mm"
[motion]
kind = "hold"
"""


def test_ngsolve_hangs_a_square_as_the_sheet_does(tmp_path: Path) -> None:
    """All fabric points within 2 % of the sag, and the cups carry the weight."""
    if not all(importlib.util.find_spec(name) for name in ("ngsolve", "scipy")):
        pytest.skip("NOT COMPARED WITH NGSOLVE: scripts/test --heavy fetches it")
    (tmp_path / "scene.toml").write_text(SQUARE)
    run("simulate", str(tmp_path / "scene.toml"), "-o", str(tmp_path / "run"), "--quiet")
    result, folder = tmp_path / "run" / "result.json", tmp_path / "ngsolve"
    run("export", str(result), "--to", "ngsolve", "-o", str(folder), "--quiet")
    times = ["--hang", "0.6", "--rest", "0.4", "--step", "5e-3"]
    subprocess.run([sys.executable, "drape.py", *times], cwd=folder, timeout=600, check=True)

    found = json.loads(run("compare", str(result), str(folder), "--json").stdout)
    (step,) = found["steps"]
    sag = 75.0 - step["lowest_mm"]["plydrape"]
    assert sag > 10.0
    assert step["apart_max_mm"] < 0.02 * sag
    assert step["shear_deg"]["peer"] == pytest.approx(step["shear_deg"]["plydrape"], abs=0.5)

    # the page has it beside the sheet
    page = [
        "report",
        str(result),
        "--compare",
        str(folder),
        "-o",
        str(tmp_path / "page"),
        "--quiet",
    ]
    run(*page)
    assert '"peer":{"name":"NGSolve"' in (tmp_path / "page" / "report.html").read_text()

    drape = json.loads((folder / "drape.json").read_text())
    carried = np.sum(drape["states"][-1]["forces"], axis=0)
    weight = 0.3143 * 9.80665 * 0.1 * 0.1
    assert carried == pytest.approx([0.0, 0.0, -weight], abs=0.01 * weight)
