"""One step in 3D: mold, ply, catenaries, touching parts, grippers, each over the one before."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import LinearSegmentedColormap
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from plydrape import _shapes
from plydrape.plot._page import BLACK, MOLD_DARK, MOLD_LIGHT, RED, TARGET
from plydrape.plot._stage import values

if TYPE_CHECKING:
    from mpl_toolkits.mplot3d.axes3d import Axes3D
    from numpy.typing import NDArray

    from plydrape.plot._stage import Stage

SHORT = 0.2
"""Length of a touching part, as a share of the cell, below which a ring marks it."""
LIGHT = np.array([-0.45, -0.25, 0.86])
"""Where the light on the mold comes from."""


def panel(axes: Axes3D, stage: Stage, step: int) -> None:
    """One step: mold, ply, catenaries, touching parts, grippers, each over the one before."""
    result = stage.result
    if stage.mold is not None:
        points, triangles = stage.mold
        inks = _shade(points, triangles)
        mold = Poly3DCollection(
            points[triangles] * 1e3,
            facecolors=inks,
            edgecolors=inks,
            linewidths=0.4,
            zorder=0,
            gid="mold",
        )
        axes.add_collection3d(mold, autolim=False)
        _lines(axes, stage, _shapes.outline(result.net), TARGET, 0.8, 1, "target")

    ply, value = _shapes.ply(result, step, stage.intervals), values(stage, step)
    if ply is not None and value is not None:
        corners = ply.points[ply.triangles]
        seen = ~stage.hides(corners.mean(axis=1))
        inks = colormaps["viridis"](stage.scale(value[seen]))
        surface = Poly3DCollection(
            corners[seen] * 1e3,
            facecolors=inks,
            edgecolors=inks,
            linewidths=0.4,
            zorder=2,
            gid="ply",
        )
        axes.add_collection3d(surface, autolim=False)

    lines = _shapes.lines(result, step)
    edges = _shapes.edges(result.grid)
    _lines(axes, stage, lines[:edges], RED, 1.0 * stage.fine, 3, "edges")
    _lines(axes, stage, lines[edges:], RED, 0.5 * stage.fine, 3, "diagonals")
    parts, dots = _touching(stage, step)
    _lines(axes, stage, parts, RED, 1.5 * stage.fine, 4, "touching")
    if len(dots) > 0:
        x, y, z = dots[~stage.hides(dots)].T * 1e3
        size = {"markersize": 2.8 * stage.fine, "markeredgewidth": 0.7 * stage.fine}
        axes.plot(x, y, z, "o", mfc="white", mec=RED, zorder=5, gid="contact", **size)

    discs = _shapes.discs(result, step, _shapes.radius(result))
    seen = ~stage.hides(result.positions[step - 1])
    grippers = Poly3DCollection(
        discs[seen] * 1e3,
        facecolors=BLACK,
        edgecolors="white",
        linewidths=0.4 * stage.fine,
        zorder=6,
        gid="grippers",
    )
    axes.add_collection3d(grippers, autolim=False)


def _touching(stage: Stage, step: int) -> tuple[list[NDArray[np.float64]], NDArray[np.float64]]:
    """Touching parts, and a point (N, 3) in each that is too short to be seen as a line; in m."""
    if stage.result.model != "catenaries":
        return [], np.zeros((0, 3))
    parts = stage.result.contact_lines(step)
    short = SHORT * min(stage.result.cell)
    dots = [_shapes.middle(part) for part in parts if _shapes.length(part) < short]
    return [part for part in parts if len(part) > 1], np.array(dots).reshape(-1, 3)


def _lines(
    axes: Axes3D,
    stage: Stage,
    lines: Sequence[NDArray[np.float64]],
    ink: str,
    width: float,
    order: int,
    gid: str,
) -> None:
    """Polylines (N, 3) in m without what the mold hides of them."""
    shown = []
    for line in lines:
        seen = ~stage.hides(line)
        cuts = np.flatnonzero(np.diff(seen)) + 1
        for run, kept in zip(np.split(line, cuts), np.split(seen, cuts), strict=True):
            if kept[0] and len(run) > 1:
                shown.append(run * 1e3)
    collection = Line3DCollection(
        shown,
        colors=ink,
        linewidths=width,
        zorder=order,
        gid=gid,
        capstyle="round",
        joinstyle="round",
    )
    axes.add_collection3d(collection, autolim=False)


def _shade(points: NDArray[np.float64], triangles: NDArray[np.int64]) -> NDArray[np.float64]:
    """Colors (T, 4) of a gray surface in light from above and the left."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0.0)
    normal *= np.where(normal[:, 2:] < 0.0, -1.0, 1.0)
    light = normal @ (LIGHT / np.linalg.norm(LIGHT))
    gray = LinearSegmentedColormap.from_list("mold", [MOLD_DARK, MOLD_LIGHT])
    return np.asarray(gray(np.clip(0.15 + 0.85 * light, 0.0, 1.0)))
