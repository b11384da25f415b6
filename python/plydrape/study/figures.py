"""Small pictures of the summary page, as SVG that takes its colors from the page.

Plain shapes, no script; each has a text for those who do not see it. Lengths are in pixels of the
picture's own frame, which the page scales.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np

from .labels import amount

WIDTH, HEIGHT = 340, 150
LEFT, RIGHT, TOP, BOTTOM = 8, 8, 20, 24
Numbers = np.ndarray[Any, Any]
# Points of a scatter: more only make it darker.
POINTS = 500


@dataclass(frozen=True)
class Axis:
    """Numbers along a line of pixels.

    Attributes
    ----------
    low, high
        Its ends.
    start, end
        Their pixels.

    """

    low: float
    high: float
    start: float
    end: float

    def at(self, x: float) -> float:
        """The pixel of a number, to a hundredth."""
        share = (x - self.low) / (self.high - self.low)
        return round(self.start + share * (self.end - self.start), 2)

    def holds(self, x: float) -> bool:
        """Whether a number is on it."""
        return self.low <= x <= self.high

    def ticks(self, most: int = 5) -> list[float]:
        """Round numbers on it, at most so many.

        Examples
        --------
        >>> Axis(0.0, 9.3, 0, 100).ticks()
        [0.0, 2.0, 4.0, 6.0, 8.0]

        """
        rough = (self.high - self.low) / most
        power = 10.0 ** math.floor(math.log10(rough))
        step = next(s * power for s in (1, 2, 5, 10) if s * power >= rough * (1 - 1e-9))
        first, last = math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9)
        return [float(f"{i * step:.12g}") for i in range(first, last + 1)]


def span(values: Numbers, limit: float | None) -> tuple[float, float]:
    """The range that a picture shows: all values but far outliers, and the limit if it is near."""
    low, high = float(values.min()), float(values.max())
    inner = np.percentile(values, (1, 99))
    reach = 3.0 * max(float(inner[1] - inner[0]), 1e-300)
    low, high = max(low, float(inner[0]) - reach), min(high, float(inner[1]) + reach)
    if limit is not None:
        wide = high - low
        if low - 0.6 * wide <= limit <= high + 0.6 * wide:
            low, high = min(low, limit), max(high, limit)
    # From zero, where zero is near: most measures are sizes.
    if 0 < low < 0.35 * high:
        low = 0.0
    margin = 0.03 * (high - low) or 0.5 * abs(high) or 1.0
    return (low if low == 0.0 else low - margin), high + margin


def edges(values: Numbers, low: float, high: float, limit: float | None) -> list[float]:
    """Edges of a histogram's bins, after Freedman and Diaconis; the limit is one of them."""
    quarter, three = np.percentile(values, (25, 75))
    width = 2.0 * float(three - quarter) / len(values) ** (1 / 3)
    bins = min(max(int((high - low) / width) if width > 0 else 12, 12), 40)
    step = (high - low) / bins
    start = low
    if limit is not None and low < limit < high:
        start = limit - math.ceil((limit - low) / step - 1e-9) * step
    count = math.ceil((high - start) / step - 1e-9)
    return [start + i * step for i in range(count + 1)]


def histogram(values: Numbers, limit: float | None, at_least: bool, unit: str, about: str) -> str:
    """How values are distributed, those beyond the limit in its color.

    Parameters
    ----------
    values : Numbers
        Finite numbers, at least one.
    limit : float or None
        The limit, or None.
    at_least : bool
        Whether the limit is the least allowed.
    unit : str
        Of both.
    about : str
        What it is of, for its text.

    """
    low, high = span(values, limit)
    x = Axis(low, high, LEFT, WIDTH - RIGHT)
    marks = edges(values, low, high, limit)
    counts, _ = np.histogram(values, marks)
    y = Axis(0.0, float(max(counts.max(), 1)), HEIGHT - BOTTOM, TOP)
    parts = []
    for count, left, right in zip(counts, marks, marks[1:], strict=False):
        if count == 0:
            continue
        middle = 0.5 * (left + right)
        over = limit is not None and (middle < limit if at_least else middle > limit)
        a, b = max(x.at(left), LEFT), min(x.at(right), WIDTH - RIGHT)
        top = y.at(float(count))
        parts.append(
            f'<rect class="{"over" if over else "bar"}" x="{a + 0.5:.2f}" y="{top}" '
            f'width="{max(b - a - 1, 0.6):.2f}" height="{HEIGHT - BOTTOM - top:.2f}"/>'
        )
    parts += [base(), *(tick(x, t) for t in x.ticks()), mark(x, limit, unit)]
    beyond = int(((values < low) | (values > high)).sum())
    if beyond:
        parts.append(
            f'<text class="quiet" x="{WIDTH - RIGHT}" y="{TOP + 12}" text-anchor="end">'
            f"{beyond} beyond the picture</text>"
        )
    return svg(parts, f"Histogram of {about}")


def scatter(
    x: Numbers,
    y: Numbers,
    limit: float | None,
    kept: Numbers,
    about: str,
) -> str:
    """A measure over an input; of many scenarios some, evenly out of all.

    Parameters
    ----------
    x : Numbers
        The input.
    y : Numbers
        The measure; all are finite and of one length.
    limit : float or None
        Of the measure, or None.
    kept : Numbers
        Whether the limit is.
    about : str
        What it is of, for its text.

    """
    chosen = np.unique(np.linspace(0, len(x) - 1, min(len(x), POINTS)).astype(int))
    across = Axis(*ends(x), 40, WIDTH - RIGHT)
    up = Axis(*span(y, limit), HEIGHT - BOTTOM, TOP)
    parts = []
    for value in up.ticks(4):
        h = up.at(value)
        parts.append(f'<line class="grid" x1="40" x2="{WIDTH - RIGHT}" y1="{h}" y2="{h}"/>')
        parts.append(
            f'<text class="tick" x="34" y="{h + 3.5}" text-anchor="end">{amount(value)}</text>'
        )
    if limit is not None and up.holds(limit):
        h = up.at(limit)
        parts.append(f'<line class="limit" x1="40" x2="{WIDTH - RIGHT}" y1="{h}" y2="{h}"/>')
    for i in chosen:
        if up.holds(float(y[i])):
            kind = "dot" if kept[i] else "dot over"
            parts.append(
                f'<circle class="{kind}" cx="{across.at(float(x[i]))}" '
                f'cy="{up.at(float(y[i]))}" r="2"/>'
            )
    parts += [base(40), *(tick(across, t) for t in across.ticks(4))]
    return svg(parts, f"Scatter of {about}")


def ends(x: Numbers) -> tuple[float, float]:
    """The range of an input with a little around it."""
    low, high = float(x.min()), float(x.max())
    margin = 0.03 * (high - low) or 0.5 * abs(high) or 1.0
    return low - margin, high + margin


def mark(x: Axis, limit: float | None, unit: str) -> str:
    """The limit as a line, or text where it lies if that is outside."""
    if limit is None:
        return ""
    label = f"limit {amount(limit)} {escape(unit)}"
    if not x.holds(limit):
        left = limit < x.low
        anchor = "start" if left else "end"
        at = float(LEFT if left else WIDTH - RIGHT)
        label = f"← {label}" if left else f"{label} →"
        return f'<text class="limit" x="{at}" y="12" text-anchor="{anchor}">{label}</text>'
    at = x.at(limit)
    anchor, off = ("end", -4) if at > 0.65 * WIDTH else ("start", 4)
    if at < 0.1 * WIDTH:
        anchor, off = "start", 4
    return (
        f'<line class="limit" x1="{at}" x2="{at}" y1="4" y2="{HEIGHT - BOTTOM}"/>'
        f'<text class="limit" x="{at + off}" y="12" text-anchor="{anchor}">{label}</text>'
    )


def base(left: float = LEFT) -> str:
    """The line on which a picture stands."""
    h = HEIGHT - BOTTOM
    return f'<line class="axis" x1="{left}" x2="{WIDTH - RIGHT}" y1="{h}" y2="{h}"/>'


def tick(x: Axis, value: float) -> str:
    """A number below the axis."""
    at, h = x.at(value), HEIGHT - BOTTOM
    return (
        f'<line class="axis" x1="{at}" x2="{at}" y1="{h}" y2="{h + 4}"/>'
        f'<text class="tick" x="{at}" y="{h + 16}" text-anchor="middle">{amount(value)}</text>'
    )


def svg(parts: list[str], about: str) -> str:
    """A picture of its parts."""
    return (
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{escape(about)}">'
        f"{''.join(parts)}</svg>"
    )
