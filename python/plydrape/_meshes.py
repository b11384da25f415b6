"""Results, sheets and molds as meshes of PyVista, in m: what the methods `to_pyvista` give.

PyVista is installed by `pip install pyvista`.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from plydrape import _shapes
from plydrape._extra import load

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pyvista
    from numpy.typing import NDArray

    from plydrape import Mold, Result, Sheet, Surface

INTERVALS = 8
"""Pieces of a cell between catenaries along each side."""


def meshes(result: Result, step: int = -1) -> pyvista.MultiBlock:
    """Mold, grippers and ply of a step as meshes with their numbers.

    "grippers" are points with "tilt_deg", the "normal" of the ply and the "load_N" on them, by the
    model that decides; "sheet" is that of `sheet_mesh`, where the sheet was draped. Where
    catenaries were, "ply" has "gap_mm" and "height_mm" at its points and "shear_deg" in its
    triangles, and "catenaries" has "force_n" and "slack_mm" of each line. What is not known is nan.
    """
    pv = load("pyvista", package="pyvista", name="PyVista")
    chosen = _step(result, step)
    out = pv.MultiBlock()
    surface = result.mold_surface()
    if surface is not None and len(surface[1]) > 0:
        out["mold"] = _triangles(pv, surface[0], surface[1].astype(np.int64))
    hanging = _shapes.hanging(result)
    if hanging is not None and chosen <= len(hanging.times):
        ply = _shapes.between(result, chosen, INTERVALS)
        if ply is not None:
            out["ply"] = _ply_mesh(pv, ply)
        catenaries = _polylines(pv, result.lines(chosen))
        catenaries.cell_data["force_n"] = result.forces[chosen - 1]
        catenaries.cell_data["slack_mm"] = result.slack_mm[chosen - 1]
        out["catenaries"] = catenaries
    grippers = pv.PolyData(result.positions[chosen - 1])
    grippers.point_data["tilt_deg"] = result.tilts_deg[chosen - 1]
    up = np.array([[0.0, 0.0, 1.0]])
    grippers.point_data["normal"] = _shapes.turned(result.quaternions[chosen - 1], up)[:, 0]
    grippers.point_data["load_N"] = result.loads[chosen - 1]
    out["grippers"] = grippers
    sheet = result.sheet
    if sheet is not None and chosen in sheet.steps:
        out["sheet"] = sheet_mesh(sheet, chosen)
    blocks: pyvista.MultiBlock = out
    return blocks


def sheet_mesh(sheet: Sheet, step: int = -1) -> pyvista.PolyData:
    """The sheet of a step as a mesh of its cells.

    It has "height_mm", "contact" and "landing_step" at its nodes, nan where there is none, and
    "shear_deg" in its cells.
    """
    pv = load("pyvista", package="pyvista", name="PyVista")
    state = _shapes.state(sheet, step)
    mesh = _quads(pv, sheet.positions[state], np.asarray(sheet.cells, np.int64))
    mesh.point_data["height_mm"] = sheet.heights[state] * 1e3
    mesh.point_data["contact"] = sheet.contact[state]
    landing = np.asarray(sheet.landing_step, float)
    landing[landing == 0.0] = np.nan
    mesh.point_data["landing_step"] = landing
    mesh.cell_data["shear_deg"] = np.rad2deg(sheet.shear[state])
    made: pyvista.PolyData = mesh
    return made


def surface_mesh(surface: Surface) -> pyvista.StructuredGrid:
    """The ply between catenaries as a structured grid, with "gap_mm" at its points."""
    pv = load("pyvista", package="pyvista", name="PyVista")
    grid: pyvista.StructuredGrid = pv.StructuredGrid()
    grid.points = surface.points
    grid.dimensions = (*surface.size, 1)
    grid.point_data["gap_mm"] = surface.gap * 1e3
    return grid


def mold_mesh(
    mold: Mold,
    low: Sequence[float | str],
    high: Sequence[float | str],
    most: int = 20_000,
) -> pyvista.PolyData:
    """A mold over a rectangle of the plan as triangles."""
    pv = load("pyvista", package="pyvista", name="PyVista")
    points, triangles = mold.patch(low, high, most=most)
    made: pyvista.PolyData = _triangles(pv, points, triangles.astype(np.int64))
    return made


def _step(result: Result, step: int) -> int:
    """The number of a step, from 1; -1 is the last."""
    last = len(result.times)
    chosen = step if step > 0 else last + 1 + step
    if step == 0 or not 1 <= chosen <= last:
        raise ValueError(f"the result has no step {step}; its steps are 1 to {last}")
    return chosen


def _polylines(pv: Any, lines: Sequence[NDArray[np.float64]]) -> Any:
    """Polylines (N, 3), a cell each."""
    ends = np.cumsum([0, *(len(line) for line in lines)])
    cells = [np.r_[b - a, np.arange(a, b)] for a, b in pairwise(ends)]
    return pv.PolyData(np.concatenate(lines), lines=np.concatenate(cells))


def _ply_mesh(pv: Any, ply: _shapes.Ply) -> Any:
    """The ply between the catenaries with its numbers."""
    mesh = _triangles(pv, ply.points, ply.triangles)
    mesh.point_data["gap_mm"] = ply.gap * 1e3
    mesh.point_data["height_mm"] = ply.points[:, 2] * 1e3
    mesh.cell_data["shear_deg"] = ply.shear_deg
    return mesh


def _triangles(pv: Any, points: NDArray[np.float64], triangles: NDArray[np.int64]) -> Any:
    faces = np.column_stack([np.full(len(triangles), 3), triangles])
    return pv.PolyData(np.asarray(points, float), faces.ravel())


def _quads(pv: Any, points: NDArray[np.float64], cells: NDArray[np.int64]) -> Any:
    return pv.PolyData(points, np.insert(cells, 0, 4, axis=1).ravel())
