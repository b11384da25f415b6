"""What the panels of steps share: the frame around the ply, the mold, the scale of colors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import LogNorm, Normalize

from plydrape import _shapes
from plydrape.plot import _hidden

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from plydrape import Result
    from plydrape.plot import Surface

TOUCHING = 0.1
"""Gap up to which the ply counts as touching in a picture (mm): the low end of its colors."""
DEEP = 0.35
"""How far a mold is drawn below and above the ply at most, as a share of the ply's diagonal."""
THIN = 0.06
"""Least height of the frame, as a share of that diagonal."""


@dataclass
class Stage:
    """What all panels share; lengths in mm."""

    result: Result
    color: str
    view: tuple[float, float]
    intervals: int
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    scale: Normalize
    mold: tuple[NDArray[np.float64], NDArray[np.int64]] | None
    screen: _hidden.Screen | None
    fine: float = 1.0
    """Width of lines as a share of the usual one, less than 1 where cells are small."""

    def hides(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Whether the mold hides each of the points (N, 3) in m."""
        if self.screen is None:
            return np.zeros(len(points), dtype=bool)
        return self.screen.hides(points)


def stage(
    result: Result, chosen: list[int], color: Surface | None, view: tuple[float, float]
) -> Stage:
    """The frame that holds all panels, and the scale of their colors."""
    nu, nv = result.grid
    cells = max(1, (nu - 1) * (nv - 1))
    intervals = int(np.clip(np.sqrt(3000.0 / cells / len(chosen) ** 0.5), 1, 8))
    mold = result.mold
    curved = mold is not None and mold.kind != "plane"
    kind = color or ("gap" if curved else "height")
    if kind not in ("gap", "height", "shear"):
        raise ValueError(
            f'the ply can have the color of its "gap", "height" or "shear", not "{kind}"'
        )
    if kind == "gap" and mold is None:
        raise ValueError('without a mold there is no gap; choose color="height" or "shear"')

    lines = [line for step in chosen for line in _shapes.lines(result, step)]
    size = _shapes.radius(result)
    around = [_shapes.discs(result, step, size).reshape(-1, 3) for step in chosen]
    net = result.net
    plies = [ply for step in chosen if (ply := _shapes.ply(result, step, 1)) is not None]
    fabric = [ply.points for ply in plies]
    every = np.concatenate([*lines, *around, *fabric, *_shapes.outline(net)]) * 1e3
    low, high = every.min(axis=0), every.max(axis=0)
    surface = result.mold_surface(most=1200)
    patch = screen = None
    reach = float(np.linalg.norm((high - low)[:2]))
    if surface is not None and len(surface[1]) > 0:
        points, triangles = np.asarray(surface[0], float), np.asarray(surface[1], np.int64)
        # a mold that falls far away is shown as far as the picture goes
        floor, roof = low[2] - DEEP * reach, high[2] + DEEP * reach
        z = points[triangles, 2] * 1e3
        triangles = triangles[(z.min(axis=1) >= floor) & (z.max(axis=1) <= roof)]
        if len(triangles) > 0:
            patch = (points, triangles)
            used = points[np.unique(triangles)] * 1e3
            low, high = np.minimum(low, used.min(axis=0)), np.maximum(high, used.max(axis=0))
            screen = _hidden.Screen(points, triangles, _hidden.axes(*view), 0.015 * reach * 1e-3)
    thin = THIN * reach - (high[2] - low[2])
    if thin > 0.0:
        low[2], high[2] = low[2] - thin / 2.0, high[2] + thin / 2.0

    shared = Stage(result, kind, view, intervals, low, high, Normalize(), patch, screen)
    found = [value for step in chosen if (value := values(shared, step)) is not None]
    known = np.concatenate(found)[np.isfinite(np.concatenate(found))] if found else np.zeros(0)
    bottom, top = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
    if kind == "gap":
        shared.scale = LogNorm(TOUCHING, max(top, 10.0 * TOUCHING))
    elif kind == "shear":
        shared.scale = Normalize(0.0, max(top, 1e-3))
    else:
        flat = max(0.0, 1.0 - (top - bottom))
        shared.scale = Normalize(bottom - flat / 2.0, top + flat / 2.0)
    return shared


def values(stage: Stage, step: int) -> NDArray[np.float64] | None:
    """What colors each triangle of the ply: gap or height in mm, shear in deg."""
    ply = _shapes.ply(stage.result, step, stage.intervals)
    if ply is None:
        return None
    if stage.color == "shear":
        return np.abs(ply.shear_deg)
    height = ply.gap if stage.color == "gap" else ply.points[:, 2]
    value: NDArray[np.float64] = height[ply.triangles].mean(axis=1) * 1e3
    return np.maximum(value, TOUCHING) if stage.color == "gap" else value


def projected(stage: Stage) -> NDArray[np.float64]:
    """Width and height of the frame seen in this view (2,), in mm of the world."""
    right, up, _ = _hidden.axes(*stage.view)
    span = stage.high - stage.low
    return np.array([np.abs(right) @ span, np.abs(up) @ span])
