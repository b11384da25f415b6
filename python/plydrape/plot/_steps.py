"""Chosen steps in 3D, after the figure of the numerical example in Krogh et al. 2018."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from mpl_toolkits.mplot3d.axes3d import Axes3D

from plydrape.plot._frame import frame
from plydrape.plot._key import key
from plydrape.plot._page import MM, Page, breadth, style
from plydrape.plot._panel import panel as draw
from plydrape.plot._stage import projected
from plydrape.plot._stage import stage as staged

if TYPE_CHECKING:
    from plydrape import Result
    from plydrape.plot import Surface, Width

MOST_STEPS = 12
CAPTION = 5.0
"""Height of the line above a panel (mm)."""
CELL = 7.0
"""Cells smaller than this on the page (mm) get thinner lines."""
LEFT_RIGHT, TOP_BOTTOM = (9.5, 8.0), (1.0, 8.0)
"""Room around the box for its numbers and names (mm)."""


def figure(
    result: Result,
    steps: Sequence[int] | None,
    color: Surface | None,
    view: tuple[float, float],
    columns: int | None,
    width: Width,
    title: str | None,
) -> Page:
    """See `plydrape.plot.steps`."""
    wide = breadth(width)
    chosen = _telling(result) if steps is None else _checked(result, steps)
    if not (np.isfinite(view).all() and abs(view[0]) <= 90.0):
        raise ValueError(f"no view has the angles elev {view[0]:g} and azim {view[1]:g} deg")
    stage = staged(result, chosen, color, view)
    most = 1 if wide < 120.0 and len(chosen) < 4 else 2 if wide < 120.0 else 3
    across = min(len(chosen), most if columns is None else columns)
    if across < 1:
        raise ValueError(f"there cannot be {columns} columns; choose 1 or more")
    rows = -(-len(chosen) // across)

    # One frame for all panels: its projected size says how high a panel is.
    box = wide / across
    unit = projected(stage)
    scale = min((box - sum(LEFT_RIGHT)) / unit[0], 75.0 / unit[1])
    panel = CAPTION + scale * unit[1] + sum(TOP_BOTTOM)
    side = max(box, panel)
    stage.fine = float(np.clip(min(stage.result.cell) * 1e3 * scale / CELL, 0.2, 1.0))
    free = rows * across - len(chosen)
    strip = 0.0 if free and across > 1 else 13.0 if wide >= 120.0 else 21.0
    head = 6.0 if title else 0.0
    high = head + rows * panel + strip

    with style():
        page = Page(figsize=(wide * MM, high * MM))
        for k, step in enumerate(chosen):
            row, column = divmod(k, across)
            bottom = high - head - (row + 1) * panel
            # a square as large as the panel at least, for Matplotlib cuts off what leaves it
            middle = (
                column * box + (box + LEFT_RIGHT[0] - LEFT_RIGHT[1]) / 2.0,
                bottom + TOP_BOTTOM[1] + scale * unit[1] / 2.0,
            )
            at = (
                (middle[0] - side / 2.0) / wide,
                (middle[1] - side / 2.0) / high,
                side / wide,
                side / high,
            )
            axes = page.add_axes(at, projection="3d", proj_type="ortho", computed_zorder=False)
            assert isinstance(axes, Axes3D)
            frame(axes, stage, scale * unit[0] / side, named=k == 0)
            draw(axes, stage, step)
            letter = f"{chr(97 + k)}  " if len(chosen) > 1 else ""
            corner = ((column * box + 2.0) / wide, (bottom + panel - 1.0) / high)
            page.text(*corner, f"{letter}{_caption(result, step)}", va="top", gid="caption")
        rect = (
            (0.0, 0.0, 1.0, strip / high)
            if strip
            else ((across - free) * box / wide, 0.0, free * box / wide, panel / high)
        )
        key(page, stage, chosen, rect)
        if title:
            page.suptitle(title, x=2.0 / wide, y=1.0 - 1.5 / high, ha="left", va="top")
    return page


def _telling(result: Result) -> list[int]:
    """Start, first contact, first shear, end, and the middle of the longest stretch."""
    last, shear = len(result.times), _first_shear(result)
    sheet = result.sheet if result.model == "sheet" else None
    kept = list(range(1, last + 1)) if sheet is None else sorted({*sheet.steps.tolist()})

    def shown(step: int) -> int:
        """The first step from there on of which a picture can be made."""
        return next((number for number in kept if number >= step), kept[-1])

    found = {1, last, result.first_contact_step or 1, shear or 1}
    chosen = sorted({shown(step) for step in found if 1 <= step <= last})
    long, start = max(((b - a, a) for a, b in pairwise(chosen)), default=(0, 1))
    if long > 1:
        chosen.append(shown(start + long // 2))
    return sorted({*chosen})


def _first_shear(result: Result) -> int | None:
    """The first step in which a cell between catenaries shears, where these decide."""
    catenaries: dict[str, int | None] = result.summary.get("catenaries", {})
    return catenaries.get("first_shear_step")


def _checked(result: Result, steps: Sequence[int]) -> list[int]:
    last = len(result.times)
    chosen = [int(step) for step in steps]
    if not chosen:
        raise ValueError("a figure needs at least one step")
    if len(chosen) > MOST_STEPS:
        raise ValueError(
            f"{len(chosen)} steps are too many for one figure; choose up to {MOST_STEPS}"
        )
    for step in chosen:
        if not 1 <= step <= last:
            raise ValueError(f"the result has no step {step}; its steps are 1 to {last}")
    return chosen


def _caption(result: Result, step: int) -> str:
    what = []
    if len(result.times) > 1 and step == 1:
        what.append("start")
    if step == result.first_contact_step:
        what.append("first contact")
    if step == _first_shear(result):
        what.append("first shear")
    if len(result.times) > 1 and step == len(result.times):
        what.append("end")
    return ", ".join([f"step {step}", " and ".join(what)] if what else [f"step {step}"])
