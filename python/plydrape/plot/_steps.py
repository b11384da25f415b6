"""Chosen steps in 3D, after the figure of the numerical example in Krogh et al. 2018."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, LogNorm, Normalize
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection
from mpl_toolkits.mplot3d.axes3d import Axes3D
from mpl_toolkits.mplot3d.proj3d import proj_transform

from plydrape import _shapes
from plydrape.plot import _hidden
from plydrape.plot._sheet import (
    BLACK,
    FRAME,
    GRID,
    MM,
    MOLD_DARK,
    MOLD_LIGHT,
    RED,
    TARGET,
    Sheet,
    breadth,
    style,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from plydrape import Result
    from plydrape.plot import Surface, Width

MOST_STEPS = 12
SHORT = 0.2
"""Length of a touching part, as a share of the cell, below which a ring marks it."""
TOUCHING = 0.1
"""Gap up to which the ply counts as touching in a picture (mm): the low end of its colours."""


@dataclass
class Stage:
    """What all panels share; lengths in mm."""

    result: Result
    record: dict[str, Any]
    colour: str
    view: tuple[float, float]
    intervals: int
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    scale: Normalize
    mold: tuple[NDArray[np.float64], NDArray[np.int64]] | None
    screen: _hidden.Screen | None

    def hides(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Whether the mold hides each of the points (N, 3) in m."""
        if self.screen is None:
            return np.zeros(len(points), dtype=bool)
        return self.screen.hides(points)


def figure(
    result: Result,
    steps: Sequence[int] | None,
    colour: Surface | None,
    view: tuple[float, float],
    columns: int | None,
    width: Width,
    title: str | None,
) -> Sheet:
    """See `plydrape.plot.steps`."""
    wide = breadth(width)
    chosen = _telling(result) if steps is None else _checked(result, steps)
    if not (np.isfinite(view).all() and abs(view[0]) <= 90.0):
        raise ValueError(f"no view has the angles elev {view[0]:g} and azim {view[1]:g} deg")
    stage = _stage(result, chosen, colour, view)
    most = 1 if wide < 120.0 and len(chosen) < 4 else 2 if wide < 120.0 else 3
    across = min(len(chosen), most if columns is None else columns)
    if across < 1:
        raise ValueError(f"{columns} columns are none; choose 1 or more")
    rows = -(-len(chosen) // across)

    # One frame for all panels: its projected size says how high a panel is.
    box = wide / across
    unit = _projected(stage)
    margin = np.array([5.0, 5.5])
    scale = (box - 2.0 * margin[0]) / unit[0]
    scale = min(scale, 75.0 / unit[1])
    panel = scale * unit[1] + 2.0 * margin[1] + 5.0
    free = rows * across - len(chosen)
    strip = 0.0 if free and across > 1 else 13.0 if wide > 120.0 else 21.0
    head = 6.0 if title else 0.0
    high = head + rows * panel + strip

    with style():
        sheet = Sheet(figsize=(wide * MM, high * MM))
        for k, step in enumerate(chosen):
            row, column = divmod(k, across)
            bottom = high - head - (row + 1) * panel
            at = (column * box / wide, bottom / high, box / wide, (panel - 5.0) / high)
            axes = sheet.add_axes(at, projection="3d", proj_type="ortho", computed_zorder=False)
            assert isinstance(axes, Axes3D)
            _frame(axes, stage, named=k == 0)
            _fit(axes, stage, scale * unit / np.array([box, panel - 5.0]))
            _panel(axes, stage, step)
            letter = f"{chr(97 + k)}  " if len(chosen) > 1 else ""
            corner = (at[0] + 2.0 / wide, at[1] + at[3] + 4.5 / high)
            sheet.text(*corner, f"{letter}{_caption(result, step)}", va="top", gid="caption")
        rect = (
            (0.0, 0.0, 1.0, strip / high)
            if strip
            else ((across - free) * box / wide, 0.0, free * box / wide, panel / high)
        )
        _key(sheet, stage, chosen, rect, upright=not strip or wide < 120.0)
        if title:
            sheet.suptitle(title, x=2.0 / wide, y=1.0 - 1.5 / high, ha="left", va="top")
    return sheet


def _telling(result: Result) -> list[int]:
    """Start, first contact, first shear, end, and the middle of the longest stretch between them."""
    last = len(result.times)
    summary = result.summary
    found = {1, last, summary.get("first_contact_step") or 1, summary.get("first_shear_step") or 1}
    chosen = sorted(step for step in found if 1 <= step <= last)
    long, start = max(((b - a, a) for a, b in zip(chosen, chosen[1:], strict=False)), default=(0, 1))
    if long > 1:
        chosen.append(start + long // 2)
    return sorted(chosen)


def _checked(result: Result, steps: Sequence[int]) -> list[int]:
    last = len(result.times)
    chosen = [int(step) for step in steps]
    if not chosen:
        raise ValueError("a figure needs at least one step")
    if len(chosen) > MOST_STEPS:
        raise ValueError(f"{len(chosen)} steps are too many for one figure; choose up to {MOST_STEPS}")
    for step in chosen:
        if not 1 <= step <= last:
            raise ValueError(f"the result has no step {step}; its steps are 1 to {last}")
    return chosen


def _caption(result: Result, step: int) -> str:
    what = []
    if len(result.times) > 1 and step == 1:
        what.append("start")
    if step == result.summary.get("first_contact_step"):
        what.append("first contact")
    if step == result.summary.get("first_shear_step"):
        what.append("first shear")
    if len(result.times) > 1 and step == len(result.times):
        what.append("end")
    return ", ".join([f"step {step}", " and ".join(what)] if what else [f"step {step}"])


def _stage(
    result: Result, chosen: list[int], colour: Surface | None, view: tuple[float, float]
) -> Stage:
    """The frame that holds all panels, and the scale of their colours."""
    record = result.to_dict()
    nu, nv = result.grid
    cells = max(1, (nu - 1) * (nv - 1))
    intervals = int(np.clip(np.sqrt(3000.0 / cells / len(chosen) ** 0.5), 1, 8))
    mold = record["scene"].get("mold")
    curved = mold is not None and mold["kind"] != "plane"
    kind = colour or ("gap" if curved else "height")
    if kind not in ("gap", "height", "shear"):
        raise ValueError(f'the ply can have the colour of its "gap", "height" or "shear", not "{kind}"')
    if kind == "gap" and mold is None:
        raise ValueError('without a mold there is no gap; choose colour="height" or "shear"')

    lines = [line for step in chosen for line in result.lines(step)]
    size = _shapes.radius(record)
    around = [_shapes.discs(result, step, size).reshape(-1, 3) for step in chosen]
    net = getattr(result, "net", None)
    every = np.concatenate([*lines, *around, *_shapes.outline(net)]) * 1e3
    low, high = every.min(axis=0), every.max(axis=0)
    ground = result.mold_surface(most=1200)
    patch = screen = None
    reach = float(np.linalg.norm((high - low)[:2]))
    if ground is not None and len(ground[1]) > 0:
        points, triangles = np.asarray(ground[0], float), np.asarray(ground[1], np.int64)
        # a mold that falls far away is shown as far as the picture goes
        floor, roof = low[2] - 0.35 * reach, high[2] + 0.35 * reach
        z = points[triangles, 2] * 1e3
        triangles = triangles[(z.min(axis=1) >= floor) & (z.max(axis=1) <= roof)]
        if len(triangles) > 0:
            patch = (points, triangles)
            used = points[np.unique(triangles)] * 1e3
            low, high = np.minimum(low, used.min(axis=0)), np.maximum(high, used.max(axis=0))
            screen = _hidden.Screen(points, triangles, _hidden.axes(*view), 0.015 * reach * 1e-3)
    thin = 0.06 * reach - (high[2] - low[2])
    if thin > 0.0:
        low[2], high[2] = low[2] - thin / 2.0, high[2] + thin / 2.0

    stage = Stage(result, record, kind, view, intervals, low, high, Normalize(), patch, screen)
    values = [value for step in chosen if (value := _values(stage, step)) is not None]
    known = np.concatenate(values)[np.isfinite(np.concatenate(values))] if values else np.zeros(0)
    bottom, top = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
    if kind == "gap":
        stage.scale = LogNorm(TOUCHING, max(top, 10.0 * TOUCHING))
    elif kind == "shear":
        stage.scale = Normalize(0.0, max(top, 1e-3))
    else:
        flat = max(0.0, 1.0 - (top - bottom))
        stage.scale = Normalize(bottom - flat / 2.0, top + flat / 2.0)
    return stage


def _values(stage: Stage, step: int) -> NDArray[np.float64] | None:
    """What colours each triangle of the ply: gap or height in mm, shear in deg."""
    ply = _shapes.ply(stage.result, step, stage.intervals)
    if ply is None:
        return None
    if stage.colour == "shear":
        return np.abs(ply.shear_deg)
    of = ply.gap if stage.colour == "gap" else ply.points[:, 2]
    value: NDArray[np.float64] = of[ply.triangles].mean(axis=1) * 1e3
    return np.maximum(value, TOUCHING) if stage.colour == "gap" else value


def _projected(stage: Stage) -> NDArray[np.float64]:
    """Width and height of the frame seen in this view (2,), in mm of the world."""
    right, up, _ = _hidden.axes(*stage.view)
    span = stage.high - stage.low
    return np.array([np.abs(right) @ span, np.abs(up) @ span])


def _frame(axes: Axes3D, stage: Stage, *, named: bool) -> None:
    """The box: few ticks, light walls; names and numbers in the first panel, the others are alike."""
    span = stage.high - stage.low
    axes.set_xlim(stage.low[0], stage.high[0])
    axes.set_ylim(stage.low[1], stage.high[1])
    axes.set_zlim(stage.low[2], stage.high[2])
    axes.view_init(*stage.view)
    axes.set_facecolor("none")
    names = ("x (mm)", "y (mm)", "z (mm)")
    for axis, name, length in zip((axes.xaxis, axes.yaxis, axes.zaxis), names, span, strict=True):
        axis.set_major_locator(MaxNLocator(2 if length < 0.5 * span.max() else 3, steps=[1, 2, 5, 10]))
        axis.set_pane_color((1.0, 1.0, 1.0, 0.0))
        axis._axinfo["grid"].update(color=GRID, linewidth=0.5)
        axis._axinfo["tick"].update(inward_factor=0.0, outward_factor=0.12)
        axis.line.set(color=FRAME, linewidth=0.6)
        if named:
            axis.set_label_text(name)
        else:
            axis.set_major_formatter("")
    axes.tick_params(pad=-3.5, labelsize=6.5)
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.labelpad = -5.5
        axis.label.set_fontsize(7)


def _fit(axes: Axes3D, stage: Stage, share: NDArray[np.float64]) -> None:
    """Makes the projected frame fill this share (2,) of the axes' width and height."""
    span = stage.high - stage.low
    axes.set_box_aspect(tuple(span))
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * span + stage.low
    axes.apply_aspect()
    x, y, _ = proj_transform(*corners.T, axes.get_proj())
    seen = np.ptp(axes.transData.transform(np.stack([x, y], axis=-1)), axis=0)
    bounds = axes.get_position(original=True).bounds
    room = np.array(bounds[2:]) * axes.figure.bbox.size
    have = float(seen[0] / room[0])
    axes.set_box_aspect(tuple(span), zoom=float(share[0] / have))


def _panel(axes: Axes3D, stage: Stage, step: int) -> None:
    """One step: mold, ply, catenaries, touching parts, grippers, each over the one before."""
    result = stage.result
    if stage.mold is not None:
        points, triangles = stage.mold
        inks = _shade(points, triangles)
        mold = Poly3DCollection(
            points[triangles] * 1e3, facecolors=inks, edgecolors=inks, linewidths=0.4, zorder=0, gid="mold"
        )
        axes.add_collection3d(mold, autolim=False)
        _lines(axes, stage, _shapes.outline(getattr(result, "net", None)), TARGET, 0.8, 1, "target")

    ply, value = _shapes.ply(result, step, stage.intervals), _values(stage, step)
    if ply is not None and value is not None:
        corners = ply.points[ply.triangles]
        seen = ~stage.hides(corners.mean(axis=1))
        inks = colormaps["viridis"](stage.scale(value[seen]))
        surface = Poly3DCollection(
            corners[seen] * 1e3, facecolors=inks, edgecolors=inks, linewidths=0.4, zorder=2, gid="ply"
        )
        axes.add_collection3d(surface, autolim=False)

    lines = result.lines(step)
    edges = _edges(result.grid)
    _lines(axes, stage, lines[:edges], RED, 1.0, 3, "edges")
    _lines(axes, stage, lines[edges:], RED, 0.5, 3, "diagonals")
    parts, spots = _touching(stage, step)
    _lines(axes, stage, parts, RED, 1.5, 4, "touching")
    if len(spots) > 0:
        x, y, z = spots[~stage.hides(spots)].T * 1e3
        size = {"markersize": 2.8, "markeredgewidth": 0.7}
        axes.plot(x, y, z, "o", mfc="white", mec=RED, zorder=5, gid="contact", **size)

    discs = _shapes.discs(result, step, _shapes.radius(stage.record))
    seen = ~stage.hides(result.positions[step - 1])
    grippers = Poly3DCollection(
        discs[seen] * 1e3, facecolors=BLACK, edgecolors="white", linewidths=0.4, zorder=6, gid="grippers"
    )
    axes.add_collection3d(grippers, autolim=False)


def _touching(stage: Stage, step: int) -> tuple[list[NDArray[np.float64]], NDArray[np.float64]]:
    """Touching parts, and a spot (N, 3) in each that is too short to be seen as a line; in m."""
    parts = _shapes.touching(stage.record, step)
    short = SHORT * min(stage.record["scene"]["cell"])
    spots = [_shapes.middle(part) for part in parts if _shapes.length(part) < short]
    return [part for part in parts if len(part) > 1], np.array(spots).reshape(-1, 3)


def _edges(grid: tuple[int, int]) -> int:
    """How many of the catenaries are edges; they come first."""
    nu, nv = grid
    return (nu - 1) * nv + nu * (nv - 1)


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
        shown, colors=ink, linewidths=width, zorder=order, gid=gid, capstyle="round", joinstyle="round"
    )
    axes.add_collection3d(collection, autolim=False)


def _shade(points: NDArray[np.float64], triangles: NDArray[np.int64]) -> NDArray[np.float64]:
    """Colours (T, 4) of a grey surface in light from above and the left."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0.0)
    normal *= np.where(normal[:, 2:] < 0.0, -1.0, 1.0)
    light = normal @ (np.array([-0.45, -0.25, 0.86]) / np.linalg.norm([-0.45, -0.25, 0.86]))
    grey = LinearSegmentedColormap.from_list("mold", [MOLD_DARK, MOLD_LIGHT])
    return np.asarray(grey(np.clip(0.15 + 0.85 * light, 0.0, 1.0)))


def _key(
    sheet: Sheet,
    stage: Stage,
    chosen: list[int],
    rect: tuple[float, float, float, float],
    *,
    upright: bool,
) -> None:
    """What marks and colours mean, in a strip below the panels or in a free cell."""
    left, bottom, wide, high = rect
    marks: list[Any] = [Line2D([], [], color=RED, lw=1.0, label="catenary")]
    if any(_shapes.touching(stage.record, step) for step in chosen):
        ring = {"marker": "o", "ms": 2.6, "mfc": "white", "mec": RED, "mew": 0.6}
        marks.append(Line2D([], [], color=RED, lw=1.7, label="touches the mold", **ring))
    marks.append(Line2D([], [], ls="", marker="o", ms=5.5, color=BLACK, label="gripper"))
    if stage.mold is not None and getattr(stage.result, "net", None) is not None:
        marks.append(Line2D([], [], color=TARGET, lw=0.8, label="outline of the ideal drape"))
    inches = sheet.get_size_inches()
    rooms = np.array([wide, high]) * inches / MM
    if upright:
        anchor = (left + 0.08 * wide, bottom + 0.92 * high) if rooms[1] > 25.0 else (left + 0.04, bottom + high)
        columns = 1 if rooms[1] > 25.0 else 2
        sheet.legend(
            handles=marks, loc="upper left", bbox_to_anchor=anchor, ncols=columns, frameon=False, borderpad=0,
            borderaxespad=0.2, handlelength=2.0, columnspacing=1.4,
        )
        tall = 6.0 + 3.6 * -(-len(marks) // columns)
        at = (left + 0.09 * wide, bottom + high - (tall + 8.0) / rooms[1] * high, 0.78 * wide, 2.2 / rooms[1] * high)
    else:
        sheet.legend(
            handles=marks, loc="center left", bbox_to_anchor=(0.015, bottom + 0.5 * high), ncols=2, frameon=False,
            borderpad=0, handlelength=2.0, columnspacing=1.6,
        )
        at = (0.56, bottom + 0.58 * high, 0.4, 2.2 / rooms[1] * high)
    if stage.result.grid[1] < 2:
        return
    names = {"gap": "gap to the mold (mm)", "height": "height z (mm)", "shear": "shear (°)"}
    axes = sheet.add_axes(at)
    bar = sheet.colorbar(ScalarMappable(stage.scale, "viridis"), cax=axes, orientation="horizontal")
    bar.set_label(names[stage.colour], labelpad=1.5, fontsize=7)
    if stage.colour == "gap":
        bar.locator = LogLocator(subs=(1.0,))
        bar.formatter = FuncFormatter(lambda value, _: "≤\u20090.1" if value <= TOUCHING * 1.01 else f"{value:g}")
        bar.minorticks_off()
    else:
        bar.locator = MaxNLocator(5)
    bar.outline.set_linewidth(0.4)  # type: ignore[operator]
    bar.update_ticks()
    axes.tick_params(labelsize=6.5, length=2, pad=1.5)


__all__ = ["figure"]
