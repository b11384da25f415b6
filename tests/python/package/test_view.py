"""The scene of PyVista holds the numbers of the result."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, cast

import numpy as np
import plydrape
import pytest
import pyvista
from plydrape import view

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
SIDES = 10


@pytest.fixture(autouse=True)
def off_screen(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """No window is opened, and plotters are closed."""
    monkeypatch.setattr(pyvista, "OFF_SCREEN", True)
    yield
    pyvista.close_all()


def mesh(plotter: pyvista.Plotter, name: str) -> Any:
    """What an actor of this name draws."""
    return cast(Any, plotter.actors[name]).mapper.dataset


def test_the_ply_has_the_points_and_values_of_the_surface(dome: plydrape.Result) -> None:
    """Points, triangles, gap and height at the points, shear in the triangles of a cell."""
    ply = mesh(view.scene3d(dome, 27, intervals=4), "ply")
    surface = dome.surface(27, intervals=4)
    assert ply.points == pytest.approx(surface.points, abs=1e-7)
    assert (ply.faces.reshape(-1, 4)[:, 1:] == surface.triangles).all()
    assert ply["gap_mm"] == pytest.approx(surface.gap * 1e3)
    assert ply["height_mm"] == pytest.approx(surface.points[:, 2] * 1e3)
    # each cell has 2 x 4 x 4 triangles with its shear
    assert np.sort(ply["shear_deg"]) == pytest.approx(np.sort(dome.shear_deg[26].repeat(32)))


def test_shear_belongs_to_the_cell_it_is_of(shallow: plydrape.Result) -> None:
    """The triangles around the middle of the cell [i, j]."""
    shear = shallow.shear_deg[29]
    assert len(np.unique(shear.round(6))) > 6
    ply = mesh(view.scene3d(shallow, 30), "ply")
    middles, places = ply.cell_centers().points, shallow.positions[29].reshape(4, 4, 3)
    for j in range(3):
        for i in range(3):
            middle = places[j : j + 2, i : i + 2].mean(axis=(0, 1))
            near = np.linalg.norm((middles - middle)[:, :2], axis=1).argsort()[:8]
            assert ply["shear_deg"][near] == pytest.approx(shear[j, i])


def test_catenaries_are_tubes_about_their_lines(flat: plydrape.Result) -> None:
    """The rings of a tube have their middles on the points of the line, then on its ends: caps."""
    plotter = view.scene3d(flat, 10)
    lines = flat.lines(10)
    for name, part in (("edges", lines[:10]), ("diagonals", lines[10:])):
        tubes = mesh(plotter, name)
        apart = [view._apart(line) for line in part]
        points = np.concatenate([np.concatenate([line, line[[0, -1]]]) for line in apart])
        rings = tubes.points.reshape(-1, SIDES, 3)
        assert rings.mean(axis=1) == pytest.approx(points, abs=1e-6)
        radius = np.linalg.norm(rings - rings.mean(axis=1, keepdims=True), axis=2)
        assert radius.max() < 1.5e-3


def test_grippers_are_plates_about_their_places(flat: plydrape.Result) -> None:
    """Middle at the position, flat across the normal that the tilt is measured from."""
    plates = mesh(view.scene3d(flat, 4), "grippers").points.reshape(8, 2, -1, 3)
    assert plates.mean(axis=(1, 2)) == pytest.approx(flat.positions[3], abs=1e-7)
    normal = plates[:, 1].mean(axis=1) - plates[:, 0].mean(axis=1)
    up = normal[:, 2] / np.linalg.norm(normal, axis=1)
    assert np.rad2deg(np.arccos(up)) == pytest.approx(flat.tilts_deg[3], abs=1e-2)
    assert flat.tilts_deg[3].max() > 30.0


def test_the_mold_is_the_molds_surface(dome: plydrape.Result) -> None:
    """Each point on the sphere of 0.6 m; without the mold neither it nor the target is there."""
    plotter = view.scene3d(dome)
    points = mesh(plotter, "mold").points
    away = np.linalg.norm(points - [0.0, 0.0, -0.6], axis=1)
    assert away == pytest.approx(np.full(len(points), 0.6), abs=1e-6)
    bare = view.scene3d(dome, mold=False, diagonals=False).actors
    assert not {"mold", "target", "diagonals"} & set(bare) and "ply" in bare


def test_a_scene_is_seen(dome: plydrape.Result, tmp_path: Path) -> None:
    """The picture has the red of lines, the black of grippers, the gray of the mold, viridis."""
    plotter = view.scene3d(dome, 25)
    picture = np.asarray(plotter.screenshot(str(tmp_path / "step.png"), return_img=True))
    assert (tmp_path / "step.png").stat().st_size > 5000
    r, g, b = (picture[..., k].astype(int) for k in range(3))
    share = {
        "red": ((r > 150) & (g < 80) & (b < 80)).mean(),
        "black": ((r < 40) & (g < 40) & (b < 40)).mean(),
        "gray": ((abs(r - b) < 25) & (r > 90) & (r < 235) & (abs(r - g) < 25)).mean(),
        "viridis": ((abs(r - g) > 40) & (r < 200) & (g > 60)).mean(),
    }
    assert all(found > 0.002 for found in share.values()), share
    assert (picture == 255).all(axis=2).mean() < 0.9


def test_colors_and_steps(dome: plydrape.Result, flat: plydrape.Result) -> None:
    """The range of the bar, a step counted from the end, a plotter of one's own."""
    plotter = view.scene3d(dome, -1, color="shear", limits=(0.0, 2.0))
    mapper = cast(Any, plotter.actors["ply"]).mapper
    assert tuple(mapper.scalar_range) == (0.0, 2.0)
    assert mapper.array_name == "shear_deg"
    assert mesh(plotter, "ply").points == pytest.approx(dome.surface(30).points, abs=1e-7)
    own = pyvista.Plotter()
    assert view.scene3d(flat, 3, plotter=own) is own
    assert cast(Any, own.actors["ply"]).mapper.array_name == "height_mm"
    wishes: list[tuple[plydrape.Result, dict[str, Any], str]] = [
        (dome, {"step": 0}, "no step 0"),
        (dome, {"step": 31}, "no step 31; its steps are 1 to 30"),
        (dome, {"step": -31}, "no step -31"),
        (dome, {"color": "speed"}, '"gap", "height" or "shear"'),
        (dome, {"intervals": 0}, "intervals"),
    ]
    for result, options, message in wishes:
        with pytest.raises(ValueError, match=message):
            view.scene3d(result, **options)


def test_a_strip_without_mold_is_a_scene(strip: plydrape.Result) -> None:
    """Lines and grippers; there is no surface to color."""
    plotter = strip.scene3d(1)
    assert {"edges", "grippers"} <= set(plotter.actors)
    assert not {"ply", "mold"} & set(plotter.actors)
    with pytest.raises(ValueError, match="without a mold there is no gap"):
        view.scene3d(strip, color="gap")


def test_the_extra_is_named_where_it_is_missing() -> None:
    """The module can be imported without PyVista; the scene says what to install."""
    program = """
import sys
sys.modules["pyvista"] = None
import plydrape.view
result = plydrape.simulate(plydrape.Scene.read(sys.argv[1]))
try:
    result.scene3d()
except ImportError as fault:
    print(fault)
"""
    scene = str(EXAMPLES / "01_flat_sheared_mold/scene.toml")
    command = [sys.executable, "-c", program, scene]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    line = "PyVista is missing; install it with: pip install pyvista"
    assert done.stdout.strip() == line


def test_the_sheet_has_its_nodes_and_the_forces_on_its_pads(sheet: plydrape.Result) -> None:
    """Points, heights and shear of the last state; an arrow for each pad."""
    held = sheet.sheet
    assert held is not None
    plotter = view.sheet3d(sheet)
    cells = mesh(plotter, "sheet")
    assert cells.points == pytest.approx(held.positions[-1], abs=1e-7)
    assert (cells.faces.reshape(-1, 5)[:, 1:] == held.cells).all()
    assert cells["height_mm"] == pytest.approx(held.heights[-1] * 1e3)
    assert cells["shear_deg"] == pytest.approx(np.rad2deg(held.shear[-1]))
    assert {"mold", "grippers", "forces"} <= set(plotter.actors)
    # a quarter of a cell has the step of its node, as long as that is not to come
    parts = mesh(view.sheet3d(sheet, 1, color="landing"), "sheet")
    assert parts.n_cells == 4 * len(held.cells)
    assert np.isnan(parts["landing_step"]).all()


def test_a_result_without_a_sheet_is_refused(flat: plydrape.Result) -> None:
    """The message says what to do."""
    with pytest.raises(ValueError, match='model="sheet"'):
        view.sheet3d(flat)
