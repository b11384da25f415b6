"""The box in the figure of steps: light walls, few ticks, names along the front edges."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.proj3d import proj_transform

from plydrape.plot import _hidden
from plydrape.plot._page import FRAME, GRID

if TYPE_CHECKING:
    from mpl_toolkits.mplot3d.axes3d import Axes3D
    from numpy.typing import NDArray

    from plydrape.plot._stage import Stage

ROOM = (26.0, 26.0, 11.0)
"""Length of an edge that a number needs (pt): along x, y and z."""


def frame(axes: Axes3D, stage: Stage, wide: float, *, named: bool) -> None:
    """The box, this wide as a share of the axes, with names and numbers if it is to be named."""
    axes.set_xlim(stage.low[0], stage.high[0])
    axes.set_ylim(stage.low[1], stage.high[1])
    axes.set_zlim(stage.low[2], stage.high[2])
    axes.view_init(*stage.view)
    axes.set_facecolor("none")
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.set_major_formatter("")
        axis.set_pane_color((1.0, 1.0, 1.0, 0.0))
        axis._axinfo["grid"].update(color=GRID, linewidth=0.5)
        axis._axinfo["tick"].update(inward_factor=0.0, outward_factor=0.0)
        axis.line.set_visible(False)
    _fit(axes, stage, wide)
    for k, edge in enumerate(_edges(stage)):
        # as many numbers as there is room for along the edge, in points
        ends = _screen(axes, edge)
        room = float(np.linalg.norm(ends[1] - ends[0])) * 72.0 / axes.figure.dpi
        most = int(np.clip(room / ROOM[k], 1, 4))
        axis = (axes.xaxis, axes.yaxis, axes.zaxis)[k]
        axis.set_major_locator(MaxNLocator(most, steps=[1, 2, 5, 10]))
        axes.plot(*edge.T, color=FRAME, lw=0.6, zorder=-1, gid="frame")
        if named:
            _names(axes, stage, k, edge)


def _fit(axes: Axes3D, stage: Stage, wide: float) -> None:
    """Makes the projected box this wide, as a share of the axes' width."""
    span = stage.high - stage.low
    axes.set_box_aspect(tuple(span))
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    axes.apply_aspect()
    seen = np.ptp(_screen(axes, corners * span + stage.low), axis=0)
    axes.set_box_aspect(tuple(span), zoom=float(wide * axes.bbox.width / seen[0]))


def _edges(stage: Stage) -> list[NDArray[np.float64]]:
    """The edges (2, 3) that carry ticks: along x and y the lowest seen, along z the leftmost."""
    right, up, _ = _hidden.axes(*stage.view)
    out = []
    for k in range(3):
        others = [c for c in range(3) if c != k]
        best: Any = None
        for first in (stage.low, stage.high):
            for second in (stage.low, stage.high):
                edge = np.stack([stage.low, stage.high])
                edge[:, others[0]], edge[:, others[1]] = first[others[0]], second[others[1]]
                middle = edge.mean(axis=0)
                rank = middle @ (right if k == 2 else up)
                if best is None or rank < best[0] - 1e-9:
                    best = (rank, edge)
        out.append(best[1])
    return out


def _names(axes: Axes3D, stage: Stage, k: int, edge: NDArray[np.float64]) -> None:
    """Numbers at the ticks of an edge and its name beyond them, away from the box."""
    right, up, _ = _hidden.axes(*stage.view)
    flat = np.stack([edge @ right, edge @ up], axis=-1)
    along = flat[1] - flat[0]
    away = np.array([-along[1], along[0]]) / max(float(np.linalg.norm(along)), 1e-12)
    middle = (stage.low + stage.high) / 2.0
    if away @ (flat.mean(axis=0) - [middle @ right, middle @ up]) < 0.0:
        away = -away
    side = "left" if away[0] > 0.4 else "right" if away[0] < -0.4 else "center"
    style: dict[str, Any] = {"textcoords": "offset points", "ha": side, "va": "center"}
    low, high = edge[:, k]
    axis = (axes.xaxis, axes.yaxis, axes.zaxis)[k]
    reach = 5.0 if side == "center" else 3.0
    longest = 1
    for tick in axis.get_major_locator().tick_values(low, high):
        if low - 1e-9 <= tick <= high + 1e-9:
            at = edge[0].copy()
            at[k] = tick
            text = f"{tick:g}".replace("-", "\u2212")
            longest = max(longest, len(text))
            axes.annotate(text, _flat(axes, at), reach * away, fontsize=6.5, gid="tick", **style)
    # the name of z is on top of its edge, where no other panel is
    beyond = reach + (9.0 if side == "center" else 5.0 + 3.6 * longest * abs(away[0]))
    place, shift = (edge[1], np.array([0.0, 7.0])) if k == 2 else (edge.mean(axis=0), beyond * away)
    style["ha"] = "center" if k == 2 else side
    name = f"{'xyz'[k]} (mm)"
    axes.annotate(name, _flat(axes, place), shift, fontsize=7, gid="name", **style)


def _flat(axes: Axes3D, point: NDArray[np.float64]) -> tuple[float, float]:
    """Where a point (3,) in mm is drawn, in the plane coordinates of the axes."""
    x, y, _ = proj_transform(*point, axes.get_proj())
    return float(x), float(y)


def _screen(axes: Axes3D, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Where points (N, 3) in mm are drawn (N, 2), in dots of the page."""
    x, y, _ = proj_transform(*points.T, axes.get_proj())
    return np.asarray(axes.transData.transform(np.stack([x, y], axis=-1)))
