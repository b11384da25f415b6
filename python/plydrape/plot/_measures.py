"""The measures over the steps: small panels, each with its limit and its worst step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from plydrape.plot._sheet import DARK, GRID, LINE, MM, QUIET, RED, Sheet, breadth, style

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from plydrape import Result
    from plydrape.plot import Width

ROW = 32.0
"""Height of a row of panels (mm)."""


@dataclass(frozen=True)
class Measure:
    """How a measure is shown."""

    label: str
    unit: str
    factor: float = 1.0
    """From the unit of `result.measures` to the unit shown, which is the unit of its limit."""
    limit: str = ""
    """The name of its limit in `result.limits`, where it has one."""
    least: bool = False
    """Whether the limit is the least that is allowed."""
    at_end: bool = False
    """Whether the limit holds at the last step only."""


MEASURES = {
    "slack_mm": Measure("slack", "mm"),
    "slack_ratio": Measure("slack ratio", "%", 1e2, "slack_ratio", at_end=True),
    "wrinkle_mm": Measure("wrinkle amplitude", "mm"),
    "overstretch": Measure("overstretch", "%", 1e2, "overstretch"),
    "overstretch_mm": Measure("overstretch", "mm"),
    "gap_mm": Measure("gap", "mm"),
    "contact_share": Measure("contact share", "%", 1e2, "contact_share", least=True, at_end=True),
    "bridging_mm": Measure("bridging", "mm", 1.0, "bridging", at_end=True),
    "landing_error_mm": Measure("landing error", "mm", 1.0, "landing_contact", at_end=True),
    "fibre_angle_deg": Measure("fibre angle", "°", 1.0, "fibre_angle", at_end=True),
    "shear_deg": Measure("shear", "°", 1.0, "shear"),
    "tilt_deg": Measure("tilt", "°", 1.0, "tilt"),
    "force_n": Measure("horizontal force", "N", 1.0, "force"),
    "gripper_distance_mm": Measure("gripper distance", "mm", 1.0, "gripper_distance", least=True),
    "workspace_mm": Measure("outside workspace", "mm", 1.0, "workspace"),
}


def figure(
    result: Result,
    names: Sequence[str] | None,
    against: str,
    columns: int | None,
    width: Width,
    title: str | None,
) -> Sheet:
    """See `plydrape.plot.measures`."""
    if against not in ("step", "time"):
        raise ValueError(f'measures can be drawn against "step" or "time", not "{against}"')
    wide = breadth(width)
    chosen = _chosen(result.measures, names)
    across = columns or (3 if wide > 120.0 else 2)
    if across < 1:
        raise ValueError(f"{columns} columns are none; choose 1 or more")
    across = min(across, len(chosen))
    rows = -(-len(chosen) // across)
    x = np.arange(1, len(result.times) + 1, dtype=float) if against == "step" else result.times
    limits = {limit["name"]: limit for limit in result.limits}

    with style():
        # what the marks mean stands in the free cells of the last row, else in a strip below
        free = rows * across - len(chosen)
        inside = free * wide / across > 60.0
        narrow = wide / across < 50.0
        head, foot = 6.0 if title else 1.0, 0.0 if inside else 9.0 if wide > 120.0 else 19.0
        high = head + (ROW + 2.0 * narrow) * rows + foot
        sheet = Sheet(figsize=(wide * MM, high * MM), layout="constrained")
        engine = sheet.get_layout_engine()
        assert engine is not None
        rect = (0, foot / high, 1, 1 - (foot + head) / high)
        engine.set(w_pad=0.05, h_pad=0.03, rect=rect)  # type: ignore[call-arg]
        axes = sheet.subplots(rows, across, sharex=True, squeeze=False).ravel()
        first = result.summary["first_contact_step"]
        for k, panel in enumerate(axes):
            if k >= len(chosen):
                panel.set_axis_off()
                continue
            name = chosen[k]
            shown = MEASURES[name]
            if first is not None:
                panel.axvline(x[first - 1], color=QUIET, lw=0.7, ls=":", zorder=1)
            limit = limits.get(shown.limit) if shown.limit else None
            _draw(panel, x, result.measures[name] * shown.factor, shown, limit, narrow=narrow)
            if k + across >= len(chosen):
                panel.tick_params(labelbottom=True)
            if k // across == rows - 1:
                panel.set_xlabel("step" if against == "step" else "time (s)")
            if against == "step":
                panel.xaxis.set_major_locator(MaxNLocator(5, integer=True, steps=[1, 2, 5, 10]))
        _legend(sheet, axes[len(chosen)] if inside else None, contact=first is not None)
        if title:
            sheet.suptitle(title, x=2.0 / wide, y=1.0 - 1.5 / high, ha="left", va="top")
        sheet.align_ylabels()
    return sheet


def _chosen(measures: dict[str, NDArray[np.float64]], names: Sequence[str] | None) -> list[str]:
    """Names of measures that have a value."""
    meant = [name for name in MEASURES if name in measures and np.isfinite(measures[name]).any()]
    if names is None:
        return [name for name in meant if name != "overstretch_mm"]
    for name in names:
        if name not in measures or name not in MEASURES:
            raise ValueError(f'there is no measure "{name}"; there are {", ".join(meant)}')
        if name not in meant:
            raise ValueError(f'the measure "{name}" has no value at any step of this result')
    if not names:
        raise ValueError("choose at least one measure")
    return list(names)


def _draw(
    panel: Axes,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    shown: Measure,
    limit: dict[str, Any] | None,
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
    panel.set_title(shown.label, loc="left", pad=13 if narrow else 3)
    panel.set_ylabel("deg" if shown.unit == "°" else shown.unit, labelpad=2)

    # The worst is what the limit judges; without a limit it is the largest value.
    exceeded = limit is not None and not limit["ok"]
    if limit is not None and limit["step"] is not None:
        worst = limit["step"] - 1
    else:
        worst = int(np.nanargmax(y))
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
        bound = float(limit["limit"])
        values.append(bound)
        panel.axhline(
            bound, color=RED if exceeded else QUIET, lw=0.9, dashes=(4, 2.5), zorder=2, gid="limit"
        )
        sign = "≥" if shown.least else "≤"
        when = "end: " if shown.at_end else ""
        text = f"{when}{sign}\u2009{bound:g}{'' if shown.unit == '°' else chr(0x2009)}{shown.unit}"
        ink = RED if exceeded else QUIET
        place: dict[str, Any] = {"xycoords": "axes fraction", "textcoords": "offset points"}
        place |= {"ha": "right", "va": "bottom", "fontsize": 7, "color": ink, "gid": "bound"}
        panel.annotate(text, (1, 1), (0, 3), **place)

    # From zero where that is near, with room for the line at both ends.
    low, high = min(values), max(values)
    if low > 0.0 and low < 0.6 * high:
        low = 0.0
    span = high - low if high > low else max(abs(high), 1.0)
    panel.set_ylim(low - 0.06 * span, high + 0.1 * span)
    panel.set_xlim(x[0] - 0.02 * (x[-1] - x[0] or 1.0), x[-1] + 0.02 * (x[-1] - x[0] or 1.0))
    panel.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]))


def _legend(sheet: Sheet, room: Axes | None, *, contact: bool) -> None:
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
            label="judged by the limit, else the largest",
        ),
        Line2D([], [], color=RED, ls="", marker="X", ms=5, mew=0.5, label="limit exceeded"),
    ]
    if contact:
        marks.append(Line2D([], [], color=QUIET, lw=0.7, ls=":", label="first contact"))
    if room is not None:
        box = room.legend(
            handles=marks, loc="center left", frameon=False, handlelength=2.4, borderpad=0
        )
    else:
        columns = 3 if sheet.get_figwidth() > 120 * MM else 1
        box = sheet.legend(
            handles=marks,
            loc="lower center",
            ncols=columns,
            frameon=False,
            handlelength=2.4,
            borderpad=0.1,
        )
    box.set_in_layout(False)


__all__ = ["MEASURES", "figure"]
