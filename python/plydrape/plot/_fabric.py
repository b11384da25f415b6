"""Maps of a draped sheet on the flat fabric: height, order of landing, shear, tension."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import BoundaryNorm, LogNorm, Normalize, SymLogNorm
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator
from matplotlib.tri import Triangulation

from plydrape import _shapes
from plydrape.plot._page import BLACK, GRID, MM, RED, Page, breadth, plain, style

if TYPE_CHECKING:
    from matplotlib.colorbar import Colorbar

    from plydrape import Result
    from plydrape.plot import Width

LOW, HIGH = 0.1, 10.0
"""Ends of the colors of heights (mm), of every sheet."""
NAMES = {
    "height": "height over the mold",
    "landing": "order of landing",
    "shear": "shear",
    "tension": "tension",
}
NEVER = "#c9ced6"
"""What is in the air at the end."""


class _Sheet:
    """The arrays of a sheet in the state that is shown; fabric coordinates in mm."""

    def __init__(self, result: Result, step: int) -> None:
        sheet = result.sheet
        if sheet is None:
            raise ValueError(
                'the result has no sheet; drape its scene with model="sheet" or also="sheet"'
            )
        self.result = result
        self.state = _shapes.state(sheet, step)
        self.step = int(sheet.steps[self.state])
        self.places = np.asarray(sheet.places) * 1e3
        self.cells = np.asarray(sheet.cells, np.int64)
        self.segments = np.asarray(sheet.segments, np.int64)
        self.landing = np.asarray(sheet.landing_step)
        self.height = np.asarray(sheet.heights)[self.state] * 1e3
        self.shear = np.rad2deg(np.asarray(sheet.shear)[self.state])
        self.tension = np.asarray(sheet.tension)[self.state]
        # heights beside catenaries are judged by nobody
        self.limit = result.limits.get("height")


def figure(result: Result, show: Sequence[str], step: int, width: Width, title: str | None) -> Page:
    """See `plydrape.plot.sheet`."""
    shown = [show] if isinstance(show, str) else list(show)
    if not shown or any(name not in NAMES for name in shown):
        known = ", ".join(f'"{name}"' for name in NAMES)
        raise ValueError(f"a sheet has the maps {known}, not {show!r}")
    sheet = _Sheet(result, step)
    if "height" in shown and not np.isfinite(sheet.height).any():
        raise ValueError("without a mold there is no height over it")

    wide = breadth(width)
    across = len(shown) if wide > 120.0 and len(shown) < 3 else 2 if wide > 120.0 else 1
    rows = -(-len(shown) // across)
    size = np.ptp(sheet.places, axis=0)
    room = wide / across - 34.0
    panel = float(np.clip(room * size[1] / size[0], 14.0, 1.15 * room)) + 18.0
    head = 6.0 if title else 0.0
    high = rows * panel + head
    draw: dict[str, Callable[[Axes, _Sheet], tuple[ScalarMappable, str]]] = {
        "height": _height,
        "landing": _landing,
        "shear": _shear,
        "tension": _tension,
    }
    with style():
        page = Page(figsize=(wide * MM, high * MM), layout="constrained")
        engine = page.get_layout_engine()
        assert engine is not None
        engine.set(rect=(0, 0, 1, 1 - head / high))  # type: ignore[call-arg]
        axes = page.subplots(rows, across, squeeze=False).ravel()
        for letter, axis, name in zip("abcd", axes, shown, strict=False):
            colors, label = draw[name](axis, sheet)
            _frame(axis, sheet)
            bar = page.colorbar(colors, ax=axis, aspect=22, pad=0.02)
            _scale(bar, name, label)
            tag = f"{letter}  " if len(shown) > 1 else ""
            at = "" if name == "landing" else f", step {sheet.step}"
            axis.set_title(f"{tag}{NAMES[name]}{at}", loc="left", pad=4)
        for axis in axes[len(shown) :]:
            axis.remove()
        if title:
            page.suptitle(title, x=2.0 / wide, y=1.0 - 1.5 / high, ha="left", va="top")
    return page


def _height(axis: Axes, sheet: _Sheet) -> tuple[ScalarMappable, str]:
    """Between the nodes, with a line at the limit and a ring at the highest node."""
    known = np.isfinite(sheet.height)
    cells = sheet.cells[known[sheet.cells].all(axis=1)]
    # four triangles around the middle of each cell, so that no diagonal shows
    value = np.concatenate([np.where(known, sheet.height, 0.0), sheet.height[cells].mean(axis=1)])
    value = np.maximum(value, LOW)
    u, v = np.concatenate([sheet.places, sheet.places[cells].mean(axis=1)]).T
    middle = len(sheet.places) + np.arange(len(cells))
    sides = [np.column_stack([cells[:, k], cells[:, (k + 1) % 4], middle]) for k in range(4)]
    mesh = Triangulation(u, v, np.concatenate(sides))
    norm = LogNorm(LOW, HIGH)
    axis.tripcolor(mesh, value, norm=norm, cmap="viridis", shading="gouraud", gid="height")
    limit = None if sheet.limit is None else sheet.limit.limit
    if limit is not None and value.min() < limit < value.max():
        lines = axis.tricontour(mesh, value, [limit], colors=RED, linewidths=0.9)
        lines.set_gid("limit")
    highest = int(np.argmax(np.where(known, sheet.height, -np.inf)))
    _ring(axis, sheet, sheet.places[highest], f"{sheet.height[highest]:.2g} mm")
    note = "" if limit is None else f"; red line: limit {limit:g} mm"
    return ScalarMappable(norm, "viridis"), f"mm{note}"


def _landing(axis: Axes, sheet: _Sheet) -> tuple[ScalarMappable, str]:
    """The part of each cell that is nearest to a node has that node's step; gray never landed."""
    step = sheet.landing[sheet.cells].ravel()
    landed = step > 0
    parts = _shapes.quarters(sheet.places, sheet.cells).reshape(-1, 4, 2)
    never = PolyCollection(
        list(parts[~landed]), facecolors=NEVER, edgecolors="face", linewidths=0.3
    )
    never.set_gid("never")
    axis.add_collection(never)
    low, high = (int(step[landed].min()), int(step[landed].max())) if landed.any() else (1, 1)
    norm = (
        BoundaryNorm(np.arange(low, high + 2) - 0.5, 256)
        if high - low < 12
        else Normalize(low, high)
    )
    whole = PolyCollection(
        list(parts[landed]), cmap="viridis", norm=norm, edgecolors="face", linewidths=0.3
    )
    whole.set_array(step[landed])
    whole.set_gid("landing")
    axis.add_collection(whole)
    note = "; gray: in the air" if not landed.all() else ""
    return ScalarMappable(norm, "viridis"), f"step{note}"


def _shear(axis: Axes, sheet: _Sheet) -> tuple[ScalarMappable, str]:
    """The cells in the color of their shear angle, in two hues from a white zero."""
    most = max(float(np.abs(sheet.shear).max()), 1e-3)
    norm = Normalize(-most, most)
    cells = PolyCollection(
        list(sheet.places[sheet.cells]), cmap="PuOr_r", norm=norm, edgecolors="face", linewidths=0.3
    )
    cells.set_array(sheet.shear)
    cells.set_gid("shear")
    axis.add_collection(cells)
    worst = int(np.argmax(np.abs(sheet.shear)))
    at = sheet.places[sheet.cells[worst]].mean(axis=0)
    _ring(axis, sheet, at, f"{sheet.shear[worst]:.1f}°".replace("-", "\u2212"))
    return ScalarMappable(norm, "PuOr_r"), "°"


def _tension(axis: Axes, sheet: _Sheet) -> tuple[ScalarMappable, str]:
    """The yarns in the color of their tension, by orders of size; pressed ones in another hue."""
    most = max(float(np.abs(sheet.tension).max()), 10.0)
    norm = SymLogNorm(1.0, vmin=-most, vmax=most)
    width = float(np.clip(180.0 / np.sqrt(len(sheet.segments)), 0.8, 4.0))
    yarns = LineCollection(
        list(sheet.places[sheet.segments]), cmap="PuOr_r", norm=norm, linewidths=width
    )
    yarns.set_array(sheet.tension)
    yarns.set_gid("tension")
    axis.add_collection(yarns)
    axis.set_facecolor("#9aa2ad")
    return ScalarMappable(norm, "PuOr_r"), "N/m"


def _scale(bar: Colorbar, name: str, label: str) -> None:
    """Ticks that can be read, and the unit."""
    if name == "height":
        bar.locator = FixedLocator([0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0])
        ends = {LOW: "\u2264\u2009", HIGH: "\u2265\u2009"}
        bar.formatter = FuncFormatter(lambda value, _: f"{ends.get(round(value, 6), '')}{value:g}")
        bar.minorticks_off()
    elif name == "landing":
        bar.locator = MaxNLocator(6, integer=True, steps=[1, 2, 5, 10])
        bar.formatter = FuncFormatter(lambda value, _: f"{value:.0f}")
        bar.minorticks_off()
    elif name == "shear":
        bar.locator = MaxNLocator(6, steps=[1, 2, 5, 10])
    bar.set_label(label)
    plain(bar)
    bar.update_ticks()


def _frame(axis: Axes, sheet: _Sheet) -> None:
    """Equal scales, the outline of the ply, and the grippers."""
    low, high = sheet.places.min(axis=0), sheet.places.max(axis=0)
    edge = 0.03 * float((high - low).max())
    axis.set_aspect("equal", adjustable="box", anchor="N")
    axis.set_xlim(low[0] - edge, high[0] + edge)
    axis.set_ylim(low[1] - edge, high[1] + edge)
    axis.set_xlabel("u (mm)")
    axis.set_ylabel("v (mm)")
    axis.spines[["top", "right"]].set_visible(False)
    axis.grid(color=GRID, lw=0.4)
    axis.set_axisbelow(True)
    for part in (axis.xaxis, axis.yaxis):
        part.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    cups = sheet.result.ply.places * 1e3
    axis.plot(
        *cups.T,
        "o",
        ms=3.6,
        mfc=BLACK,
        mec="white",
        mew=0.6,
        zorder=4,
        gid="grippers",
        clip_on=False,
    )


def _ring(axis: Axes, sheet: _Sheet, at: Any, text: str) -> None:
    """A ring around a place with its value, on the side where there is more room."""
    middle = (sheet.places.min(axis=0) + sheet.places.max(axis=0)) / 2.0
    right = -1 if at[0] > middle[0] else 1
    axis.plot(*at, "o", ms=7, mfc="none", mec="white", mew=2.2, zorder=5)
    axis.plot(*at, "o", ms=7, mfc="none", mec=RED, mew=1.1, zorder=6, gid="largest")
    axis.annotate(
        text,
        at,
        (7 * right, 0),
        textcoords="offset points",
        ha="left" if right > 0 else "right",
        va="center",
        fontsize=7,
        color=BLACK,
        zorder=7,
        path_effects=[withStroke(linewidth=2.4, foreground="white")],
    )
