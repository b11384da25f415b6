"""The page that the figures share: its size, its type and its colors.

Colors are those of the report. Viridis grows evenly lighter, also for
color-blind eyes and in gray print; the scale with a sign is ColorBrewer's PuOr, safe for
color-blind eyes.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from typing import TYPE_CHECKING, Any

from cycler import cycler
from matplotlib.figure import Figure
from matplotlib.style import context as style_context

from plydrape._plydrape import _si

if TYPE_CHECKING:
    from matplotlib.colorbar import Colorbar

    from plydrape.plot import Width

MM = 1.0 / 25.4
"""A millimeter (inch)."""

DARK = "#2d323a"
QUIET = "#59636f"
GRID = "#dfe2e7"
FRAME = "#a0a6af"
MOLD_DARK, MOLD_LIGHT = "#8a929e", "#f0f3f6"
TARGET = "#586270"
RED = "#d61921"
BLACK = "#14161a"
LINE = "#27415f"

SETTINGS: dict[str, Any] = {
    "font.family": "sans-serif",
    "font.size": 8,
    "axes.titlesize": 8,
    "axes.labelsize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "figure.titlesize": 9,
    "axes.linewidth": 0.6,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "lines.linewidth": 1.0,
    "axes.edgecolor": FRAME,
    "axes.labelcolor": DARK,
    "axes.titlecolor": DARK,
    "text.color": DARK,
    "xtick.color": FRAME,
    "ytick.color": FRAME,
    "xtick.labelcolor": DARK,
    "ytick.labelcolor": DARK,
    "axes.facecolor": "white",
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "axes.formatter.useoffset": False,
    "axes.unicode_minus": True,
    "axes.prop_cycle": cycler(color=[LINE]),
    "text.usetex": False,
}


class Page(Figure):
    """A figure that a notebook shows without `pyplot`."""

    def _repr_png_(self) -> bytes:
        picture = BytesIO()
        self.savefig(picture, format="png", dpi=150)
        return picture.getvalue()


@contextmanager
def style() -> Iterator[None]:
    """Matplotlib's own settings with ours while a figure is made; then the user's again."""
    with style_context(["default", SETTINGS]):
        yield


def breadth(width: Width) -> float:
    """The width of a page (mm)."""
    if isinstance(width, str):
        if width in ("single", "double"):
            return 89.0 if width == "single" else 183.0
        if not width[:1].isdigit():
            raise ValueError(f'there is no width "{width}"; "single", "double" or a length')
    wide = 1e3 * _si(width, "length", "width")
    if not 40.0 <= wide <= 1000.0:
        raise ValueError(
            f'a figure can be 40 to 1000 mm wide, not {wide:g} mm; expected a length, as "120 mm"'
        )
    return wide


def plain(bar: Colorbar) -> None:
    """A color bar with a thin frame, made of shapes and not of dots."""
    bar.outline.set_linewidth(0.4)
    if bar.solids is not None:
        bar.solids.set(rasterized=False, edgecolor="face")
