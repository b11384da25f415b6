"""Meshes of PyVista hold the numbers of the result."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any, cast

import numpy as np
import plydrape
import pytest

pytest.importorskip("pyvista", reason="NOT TESTED: scripts/venv --heavy")

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


def block(result: plydrape.Result, name: str, step: int = -1) -> Any:
    """A block of a step."""
    return cast(Any, result.to_pyvista(step))[name]


def test_the_ply_has_the_points_and_values_of_the_surface(dome: plydrape.Result) -> None:
    """Points, triangles, gap and height at the points, shear in the triangles of a cell."""
    ply = block(dome, "ply", 27)
    surface = dome.surface(27, intervals=8)
    assert ply.points == pytest.approx(surface.points, abs=1e-7)
    assert (ply.faces.reshape(-1, 4)[:, 1:] == surface.triangles).all()
    assert ply["gap_mm"] == pytest.approx(surface.gap * 1e3)
    assert ply["height_mm"] == pytest.approx(surface.points[:, 2] * 1e3)
    # each cell has 2 x 8 x 8 triangles with its shear
    assert np.sort(ply["shear_deg"]) == pytest.approx(np.sort(dome.shear_deg[26].repeat(128)))


def test_shear_belongs_to_the_cell_it_is_of(shallow: plydrape.Result) -> None:
    """The triangles around the middle of the cell [i, j]."""
    shear = shallow.shear_deg[29]
    assert len(np.unique(shear.round(6))) > 6
    ply = block(shallow, "ply", 30)
    middles, places = ply.cell_centers().points, shallow.positions[29].reshape(4, 4, 3)
    for j in range(3):
        for i in range(3):
            middle = places[j : j + 2, i : i + 2].mean(axis=(0, 1))
            near = np.linalg.norm((middles - middle)[:, :2], axis=1).argsort()[:8]
            assert ply["shear_deg"][near] == pytest.approx(shear[j, i])


def test_grippers_and_catenaries_have_the_numbers_of_their_step(flat: plydrape.Result) -> None:
    """Places, tilts and loads of the grippers; the normal is what the tilt is measured from."""
    grippers, lines = block(flat, "grippers", 4), block(flat, "catenaries", 4)
    assert grippers.points == pytest.approx(flat.positions[3], abs=1e-7)
    up = np.clip(grippers["normal"][:, 2], -1.0, 1.0)
    assert np.rad2deg(np.arccos(up)) == pytest.approx(flat.tilts_deg[3], abs=1e-4)
    assert flat.tilts_deg[3].max() > 30.0
    assert grippers["load_N"] == pytest.approx(flat.loads[3])
    assert lines["slack_mm"] == pytest.approx(flat.slack_mm[3])
    assert lines.points == pytest.approx(np.concatenate(flat.lines(4)), abs=1e-7)


def test_the_mold_is_the_molds_surface(dome: plydrape.Result) -> None:
    """Each point on the sphere of 0.6 m."""
    points = block(dome, "mold").points
    away = np.linalg.norm(points - [0.0, 0.0, -0.6], axis=1)
    assert away == pytest.approx(np.full(len(points), 0.6), abs=1e-6)


def test_a_strip_without_mold_has_lines_and_grippers(strip: plydrape.Result) -> None:
    """There is no surface; a step that is not there is refused."""
    assert set(strip.to_pyvista(1).keys()) == {"catenaries", "grippers"}
    last = len(strip.times)
    for step in (0, last + 1, -last - 1):
        with pytest.raises(ValueError, match=f"no step {step}; its steps are 1 to {last}"):
            strip.to_pyvista(step)


def test_the_sheet_has_its_nodes_and_its_numbers(sheet: plydrape.Result) -> None:
    """Points, heights, landing and shear of the last state."""
    held = sheet.sheet
    assert held is not None
    cells = cast(Any, held.to_pyvista())
    assert cells.points == pytest.approx(held.positions[-1], abs=1e-7)
    assert (cells.faces.reshape(-1, 5)[:, 1:] == held.cells).all()
    assert cells["height_mm"] == pytest.approx(held.heights[-1] * 1e3)
    assert cells["shear_deg"] == pytest.approx(np.rad2deg(held.shear[-1]))
    landed = np.asarray(held.landing_step)
    assert (np.isnan(cells["landing_step"]) == (landed == 0)).all()


def test_pyvista_is_named_where_it_is_missing() -> None:
    """The package can be imported without it; the method says what to install."""
    program = """
import sys
sys.modules["pyvista"] = None
import plydrape
result = plydrape.simulate(plydrape.Scene.read(sys.argv[1]))
try:
    result.to_pyvista()
except ImportError as fault:
    print(fault)
"""
    scene = str(EXAMPLES / "01_flat_sheared_mold/scene.toml")
    command = [sys.executable, "-c", program, scene]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    line = "PyVista is missing; install it with: pip install pyvista"
    assert done.stdout.strip() == line
