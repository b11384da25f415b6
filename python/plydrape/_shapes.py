"""Shapes of a result that pictures share: grippers, touching parts, target, sheared ply."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from plydrape import Drape, Result, Sheet

GRIPPER = 0.12
"""Radius of a gripper as a share of the shorter side of a cell; it is drawn, not modeled."""


class Ply(NamedTuple):
    """The ply's surface of one step, with a value for its color at every triangle or point."""

    points: NDArray[np.float64]
    """Points (P, 3) in m."""
    triangles: NDArray[np.int64]
    """Indices (T, 3) of points."""
    gap: NDArray[np.float64]
    """Gap to the mold (P,) in m; nan without a mold."""
    shear_deg: NDArray[np.float64]
    """Shear angle of the cell that each triangle is in (T,) in deg."""


def hanging(result: Result) -> Result | Drape | None:
    """Which drape of a result is that of the catenaries; None where these were not draped."""
    drapes = (result, result.also)
    return next((drape for drape in drapes if drape and drape.model == "catenaries"), None)


def ply(result: Result, step: int, intervals: int) -> Ply | None:
    """The ply of a step (from 1) by the model that decides; None for a strip without a surface."""
    if result.model == "catenaries":
        return between(result, step, intervals)
    sheet = result.sheet
    assert sheet is not None
    cells = np.asarray(sheet.cells, np.int64)
    if len(cells) == 0:
        return None
    shown = state(sheet, step)
    triangles = np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])
    shear = np.tile(np.rad2deg(sheet.shear[shown]), 2)
    return Ply(sheet.positions[shown], triangles, np.asarray(sheet.heights[shown], float), shear)


def lines(result: Result, step: int) -> list[NDArray[np.float64]]:
    """The catenaries of a step where these decide; none of a sheet."""
    return result.lines(step) if result.model == "catenaries" else []


def between(result: Result, step: int, intervals: int) -> Ply | None:
    """The ply between the catenaries of a step (from 1); None for a strip."""
    nu, nv = result.grid
    if nu < 2 or nv < 2:
        return None
    surface = result.surface(step, intervals=intervals)
    triangles = np.asarray(surface.triangles, np.int64)
    # Points run along u first; the cell of a triangle follows from the middle of its corners.
    across = (nu - 1) * intervals + 1
    i = np.floor((triangles % across).mean(axis=1) / intervals).astype(np.int64)
    j = np.floor((triangles // across).mean(axis=1) / intervals).astype(np.int64)
    shear = np.asarray(result.shear_deg[step - 1], float)[j, i]
    gap = np.asarray(surface.gap, float)
    return Ply(np.asarray(surface.points, float), triangles, gap, shear)


def edges(grid: tuple[int, int]) -> int:
    """How many of the catenaries are edges; they come first, then the diagonals."""
    nu, nv = grid
    return (nu - 1) * nv + nu * (nv - 1)


def radius(result: Result) -> float:
    """Radius of a gripper's disc (m)."""
    u, v = result.cell
    return GRIPPER * (min(u, v) if result.grid[1] > 1 else u)


def discs(result: Result, step: int, size: float, corners: int = 28) -> NDArray[np.float64]:
    """The edges of the grippers' discs at a step (G, corners, 3) in m, tilted with the ply."""
    angle = np.linspace(0.0, 2.0 * np.pi, corners, endpoint=False)
    arm = size * np.stack([np.cos(angle), np.sin(angle), np.zeros(corners)], axis=-1)
    middle = result.positions[step - 1][:, None, :]
    return np.asarray(middle + turned(result.quaternions[step - 1], arm))


def turned(quaternions: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points (N, 3) turned by each quaternion (G, 4) x, y, z, w: (G, N, 3)."""
    axis, w = quaternions[:, None, :3], quaternions[:, None, 3:]
    once = 2.0 * np.cross(axis, points[None, :, :])
    return np.asarray(points[None, :, :] + w * once + np.cross(axis, once))


def outline(net: Any) -> list[NDArray[np.float64]]:
    """The sides of the ideal drape on the mold, polylines (N, 3) in m of the nodes it has."""
    if net is None:
        return []
    nodes = np.asarray(net.nodes, float)
    sides = [nodes[:, 0], nodes[-1], nodes[::-1, -1], nodes[0, ::-1]]
    whole = [side[np.isfinite(side).all(axis=1)] for side in sides]
    return [side for side in whole if len(side) > 1]


def length(line: NDArray[np.float64]) -> float:
    """The length of a polyline (N, 3)."""
    return float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())


def middle(line: NDArray[np.float64]) -> NDArray[np.float64]:
    """The point halfway along a polyline (N, 3)."""
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]
    return np.array([np.interp(along[-1] / 2.0, along, line[:, c]) for c in range(3)])


def quarters(points: NDArray[np.float64], cells: NDArray[np.int64]) -> NDArray[np.float64]:
    """For each corner of cells (C, 4) of points (P, N) the part nearest to it, (C, 4, 4, N)."""
    corners = points[cells]
    middle = np.broadcast_to(corners.mean(axis=1, keepdims=True), corners.shape)
    after = (corners + np.roll(corners, -1, axis=1)) / 2.0
    return np.stack([corners, after, middle, np.roll(after, 1, axis=1)], axis=2)


def state(sheet: Sheet, step: int) -> int:
    """The number of the last state of a step, from 1; -1 is the last step kept, -2 that before."""
    steps = np.asarray(sheet.steps)
    kept = np.unique(steps)
    if step < 0 and -step <= len(kept):
        step = int(kept[step])
    found = np.flatnonzero(steps == step)
    if len(found) == 0:
        raise ValueError(
            f"the sheet has no state of step {step}; "
            f"{len(kept)} of the steps {kept[0]} to {kept[-1]} were kept"
        )
    return int(found[-1])
