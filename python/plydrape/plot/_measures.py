"""The measures over the steps: small panels, each with its limit and its worst step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.textpath import TextPath
from matplotlib.ticker import MaxNLocator

import plydrape
from plydrape.plot._page import DARK, GRID, LINE, MM, QUIET, RED, Page, breadth, style

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from plydrape import Limit, Limits, Measure, Result
    from plydrape.plot import Width

ROW, LOW = 32.0, 26.0
"""Height of a row of panels (mm), and how low it gets to fit a page."""
HEAD = 2.0
"""More height where the limit is below the name (mm)."""
PAGE = 285.0
"""Height of a page between its margins (mm)."""
LARGE, SMALL = 8.0, 6.5
"""Size of names, and how small they get to fit (pt)."""
BESIDE = 15.0
"""Width of a panel's axis with its numbers and unit (mm)."""


MEASURES = {measure.key: measure for measure in plydrape.measures() if measure.scope != "whole"}
"""What steps may have, by key."""
ALSO = ("slack_mm", "gap_mm", "force_n", "gripper_load_n")
"""What a reader looks for beside the limits."""


def figure(
    result: Result,
    names: Sequence[str] | None,
    against: str,
    columns: int | None,
    width: Width,
    title: str | None,
) -> Page:
    """See `plydrape.plot.measures`."""
    if against not in ("step", "time"):
        raise ValueError(f'measures can be drawn against "step" or "time", not "{against}"')
    wide = breadth(width)
    limits = result.limits
    chosen = _chosen(result.measures, names, limits)
    across = columns or (3 if wide > 120.0 else 2)
    if across < 1:
        raise ValueError(f"there cannot be {columns} columns; choose 1 or more")
    across = min(across, len(chosen))
    rows = -(-len(chosen) // across)
    x = np.arange(1, len(result.times) + 1, dtype=float) if against == "step" else result.times

    with style():
        # what the marks mean is in the free cells of the last row, else in a strip below
        free = rows * across - len(chosen)
        inside = free * wide / across > 60.0
        room = wide / across - BESIDE
        narrow = any(_wide(MEASURES[name], limits) > room for name in chosen)
        head, foot = 6.0 if title else 1.0, 0.0 if inside else 9.0 if wide > 120.0 else 19.0
        row = min(ROW + HEAD * narrow, max((PAGE - head - foot) / rows, LOW))
        high = head + row * rows + foot
        page = Page(figsize=(wide * MM, high * MM), layout="constrained")
        engine = page.get_layout_engine()
        assert engine is not None
        rect = (0, foot / high, 1, 1 - (foot + head) / high)
        engine.set(w_pad=0.05, h_pad=0.03, rect=rect)  # type: ignore[call-arg]
        axes = page.subplots(rows, across, sharex=True, squeeze=False).ravel()
        first = result.first_contact_step
        for k, panel in enumerate(axes):
            if k >= len(chosen):
                panel.set_axis_off()
                continue
            name = chosen[k]
            shown = MEASURES[name]
            if first is not None:
                panel.axvline(x[first - 1], color=QUIET, lw=0.7, ls=":", zorder=1)
            values = result.measures[name] * shown.factor
            _draw(panel, x, values, shown, limits.get(shown.name), room, narrow=narrow)
            if k + across >= len(chosen):
                panel.tick_params(labelbottom=True)
            if k // across == rows - 1:
                panel.set_xlabel("step" if against == "step" else "time (s)")
            if against == "step":
                panel.xaxis.set_major_locator(MaxNLocator(5, integer=True, steps=[1, 2, 5, 10]))
        _legend(page, axes[len(chosen)] if inside else None, contact=first is not None)
        if title:
            page.suptitle(title, x=2.0 / wide, y=1.0 - 1.5 / high, ha="left", va="top")
        page.align_ylabels()
    return page


def _chosen(
    measures: dict[str, NDArray[np.float64]],
    names: Sequence[str] | None,
    limits: Limits,
) -> list[str]:
    """Keys of measures that have a value, those with a limit first."""
    meant = [name for name in MEASURES if np.isfinite(measures.get(name, np.nan)).any()]
    meant.sort(key=lambda name: MEASURES[name].name not in limits)
    if names is None:
        shown = [name for name in meant if MEASURES[name].name in limits or name in ALSO]
        return shown or meant
    for name in names:
        if name not in MEASURES:
            raise ValueError(f'there is no measure "{name}"; there are {", ".join(meant)}')
        if name not in meant:
            raise ValueError(f'the measure "{name}" has no value at any step of this result')
    if not names:
        raise ValueError("choose at least one measure")
    return list(names)


def _wide(shown: Measure, limits: Limits) -> float:
    """How wide name and limit are beside each other (mm)."""
    limit = limits.get(shown.name)
    name = _length(shown.label, LARGE)
    return name if limit is None else name + 2.0 + _length(_bound(shown, limit), 7.0)


def _length(text: str, size: float) -> float:
    """How long a text of this many points is (mm)."""
    return float(TextPath((0, 0), text, size=size).get_extents().width) / 72.0 / MM


def _bound(shown: Measure, limit: Limit) -> str:
    """A limit in words: when it counts, which way, how much."""
    unit = "" if shown.shown == "1" else shown.shown
    sign = "≥" if shown.sense == "at-least" else "≤"
    when = "end: " if shown.scope == "end" else ""
    return f"{when}{sign}\u2009{limit.limit:g}{'' if unit == '°' else chr(0x2009)}{unit}"


def _draw(
    panel: Axes,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    shown: Measure,
    limit: Limit | None,
    room: float,
    *,
    narrow: bool,
) -> None:
    """One measure: its line, its limit, its worst step."""
    panel.grid(color=GRID, lw=0.5)
    panel.set_axisbelow(True)
    panel.spines[["top", "right"]].set_visible(False)
    # a value between two steps without one has no line
    alone = (
        np.isfinite(y) & ~np.isfinite(np.r_[np.nan, y[:-1]]) & ~np.isfinite(np.r_[y[1:], np.nan])
    )
    marks = [int(k) for k in np.flatnonzero(alone)]
    panel.plot(x, y, color=LINE, lw=1.0, marker=".", ms=3, markevery=marks, zorder=3, gid="values")
    size = min(max(LARGE * room / _length(shown.label, LARGE), SMALL), LARGE)
    panel.set_title(shown.label, loc="left", pad=13 if narrow else 3, fontsize=size)
    panel.set_ylabel("" if shown.shown == "1" else shown.shown.replace("°", "deg"), labelpad=2)

    # The worst is what the limit judges; without a limit it is the worst of all steps.
    exceeded = limit is not None and not limit.kept
    if limit is not None and limit.step is not None:
        worst = limit.step - 1
    else:
        worst = int(np.nanargmin(y) if shown.sense == "at-least" else np.nanargmax(y))
    if np.isfinite(y[worst]):
        mark: dict[str, Any] = {"marker": "o", "ms": 3.5}
        if exceeded:
            mark = {"marker": "X", "ms": 5.0, "mew": 0.5}
        ink = RED if exceeded else DARK
        panel.plot(
            x[worst], y[worst], ls="", color=ink, zorder=5, gid="worst", clip_on=False, **mark
        )

    values = [*y[np.isfinite(y)]]
    if limit is not None:
        bound = limit.limit
        values.append(bound)
        panel.axhline(
            bound, color=RED if exceeded else QUIET, lw=0.9, dashes=(4, 2.5), zorder=2, gid="limit"
        )
        ink = RED if exceeded else QUIET
        place: dict[str, Any] = {"xycoords": "axes fraction", "textcoords": "offset points"}
        place |= {"ha": "right", "va": "bottom", "fontsize": 7, "color": ink, "gid": "bound"}
        panel.annotate(_bound(shown, limit), (1, 1), (0, 3), **place)

    # From zero where that is near, with room for the line at both ends.
    low, high = min(values), max(values)
    if low > 0.0 and low < 0.6 * high:
        low = 0.0
    span = high - low if high > low else max(abs(high), 1.0)
    panel.set_ylim(low - 0.06 * span, high + 0.1 * span)
    panel.set_xlim(x[0] - 0.02 * (x[-1] - x[0] or 1.0), x[-1] + 0.02 * (x[-1] - x[0] or 1.0))
    panel.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]))


def _legend(page: Page, room: Axes | None, *, contact: bool) -> None:
    """What the marks mean, in a free cell or in a strip at the bottom."""
    marks = [
        Line2D([], [], color=LINE, label="worst of each step"),
        Line2D([], [], color=QUIET, lw=0.9, dashes=(4, 2.5), label="limit (end: at the last step)"),
        Line2D(
            [],
            [],
            color=DARK,
            ls="",
            marker="o",
            ms=3.5,
            label="judged by the limit, else the worst",
        ),
        Line2D([], [], color=RED, ls="", marker="X", ms=5, mew=0.5, label="limit exceeded"),
    ]
    if contact:
        marks.append(Line2D([], [], color=QUIET, lw=0.7, ls=":", label="first contact"))
    if room is not None:
        box = room.legend(
            handles=marks, loc="center left", frameon=False, handlelength=2.4, borderpad=0
        )
        box.set_in_layout(False)
    else:
        columns = 3 if page.get_figwidth() > 120 * MM else 1
        page.legend(
            handles=marks,
            loc="lower center",
            ncols=columns,
            frameon=False,
            handlelength=2.4,
            borderpad=0.1,
        )


__all__ = ["MEASURES", "figure"]
