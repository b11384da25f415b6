"""What the marks and colors of the figure of steps mean."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from matplotlib.cm import ScalarMappable
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator

from plydrape.plot._page import BLACK, MM, RED, TARGET, plain
from plydrape.plot._stage import TOUCHING

NAMES = {"gap": "gap to the mold (mm)", "height": "height z (mm)", "shear": "shear (°)"}

if TYPE_CHECKING:
    from plydrape.plot._page import Page
    from plydrape.plot._stage import Stage


def key(
    page: Page, stage: Stage, chosen: list[int], rect: tuple[float, float, float, float]
) -> None:
    """Marks and colors in this part of the page (left, bottom, width, height; shares of it).

    One below the other where there is room for it, in a free cell; else side by side, in a strip;
    in a narrow strip in two columns, with the colors below.
    """
    left, bottom, wide, high = rect
    tall = high * float(page.get_figheight()) / MM
    narrow = wide * float(page.get_figwidth()) / MM < 120.0
    marks = _marks(stage, chosen)
    style: dict[str, Any] = {"frameon": False, "borderpad": 0, "handlelength": 2.0}
    if tall > 25.0:
        corner = (left + 0.08 * wide, bottom + 0.93 * high)
        page.legend(handles=marks, loc="upper left", bbox_to_anchor=corner, **style)
        below = 0.07 * tall + 9.0 + 3.9 * len(marks)
        place = (left + 0.09 * wide, 1.0 - below / tall, 0.8 * wide)
    elif narrow:
        corner = (left + 0.02, bottom + high)
        page.legend(handles=marks, loc="upper left", bbox_to_anchor=corner, ncols=2, **style)
        place = (left + 0.06 * wide, 1.0 - 13.0 / tall, 0.88 * wide)
    else:
        corner = (left + 0.015, bottom + high / 2.0)
        page.legend(handles=marks, loc="center left", bbox_to_anchor=corner, ncols=2, **style)
        place = (left + 0.56 * wide, 0.58, 0.4 * wide)
    if stage.result.grid[1] > 1:
        x, y, length = place
        _bar(page, stage, (x, bottom + y * high, length, 2.2 / tall * high))


def _marks(stage: Stage, chosen: list[int]) -> list[Line2D]:
    """A sample and a name of every mark that is drawn."""
    catenaries = stage.result.model == "catenaries"
    marks = [Line2D([], [], color=RED, lw=1.0, label="catenary")] * catenaries
    if catenaries and any(stage.result.contact_lines(step) for step in chosen):
        ring: dict[str, Any] = {"marker": "o", "ms": 2.8, "mfc": "white", "mec": RED, "mew": 0.7}
        marks.append(Line2D([], [], color=RED, lw=1.5, label="touches the mold", **ring))
    marks.append(Line2D([], [], ls="", marker="o", ms=5.5, color=BLACK, label="gripper"))
    if stage.mold is not None and stage.result.net is not None:
        marks.append(Line2D([], [], color=TARGET, lw=0.8, label="outline of the ideal drape"))
    return marks


def _bar(page: Page, stage: Stage, rect: tuple[float, float, float, float]) -> None:
    """The colors and what they stand for."""
    axes = page.add_axes(rect)
    colors = ScalarMappable(stage.scale, "viridis")
    bar = page.colorbar(colors, cax=axes, orientation="horizontal")
    bar.set_label(NAMES[stage.color], labelpad=1.5, fontsize=7)
    if stage.color == "gap":
        bar.locator = LogLocator(subs=(1.0,))
        bar.formatter = FuncFormatter(
            lambda value, _: f"\u2264\u2009{value:g}" if value <= 1.01 * TOUCHING else f"{value:g}"
        )
        bar.minorticks_off()
    else:
        bar.locator = MaxNLocator(5, steps=[1, 2, 5, 10])
    plain(bar)
    bar.update_ticks()
    axes.tick_params(labelsize=6.5, length=2, pad=1.5)
