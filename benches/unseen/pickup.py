"""Where the grippers of a random scene pick the ply up: above its target, or beside it, turned."""

from __future__ import annotations

import math
import random

from ideal import Drape, RefusedError
from molds import Mold
from plies import Array
from units import angle, length

SPACING = (0.95, 0.995)
"""Distance of neighbours at pick-up, of the fabric between them."""

SAG = 1.8
"""Depth to which the middle of a cell hangs, at most, in cells times the root of the share by which
neighbours are closer: 24 mm in cells of 100 mm that are 2 % closer."""

HEIGHT = (0.3, 1.5)
"""Height of a pick-up above the mold's top, in cells; more where the ply would hang into it."""

ABOVE = 0.6
"""Share of the scenes whose pick-up is above the target."""

FARTHEST = 1.0
"""Farthest that a pick-up is beside the target (m)."""

TURN_DEG = 90.0
"""Largest angle from a pick-up's heading to the target's (degrees)."""


class Rectangle:
    """The level rectangle of grippers."""

    def __init__(self, ply: Array, spacing: tuple[float, float], heading: float) -> None:
        """Of its spacing, as a share of the fabric, and its heading (degrees)."""
        u, v = (share * extent / 2.0 for share, extent in zip(spacing, ply.extent, strict=True))
        c, s = math.cos(math.radians(heading)), math.sin(math.radians(heading))
        self.halves = ((u * c, u * s), (-v * s, v * c))
        """From its middle to the middle of its far sides along u and v (m)."""

    def at(self, middle: tuple[float, float], u: float, v: float) -> tuple[float, float]:
        """The place at shares of both halves from its middle."""
        (a, b), (c, d) = self.halves
        return middle[0] + u * a + v * c, middle[1] + u * b + v * d

    def ground(self, mold: Mold, middle: tuple[float, float]) -> float:
        """The highest point of the mold below it; nan if there is none (m)."""
        shares = [n / 10.0 for n in range(-10, 11)]
        heights = [mold.height(*self.at(middle, u, v)) for u in shares for v in shares]
        return max((h for h in heights if not math.isnan(h)), default=math.nan)


def pick_up(
    rng: random.Random, ply: Array, mold: Mold, drape: Drape, heading: float
) -> tuple[str, dict[str, str]]:
    """The name of the place and the keys of `[grippers]`, for a target's heading (degrees)."""
    spacing = (rng.uniform(*SPACING), rng.uniform(*SPACING))
    distances = [share * side for share, side in zip(spacing, ply.cell, strict=True)]
    keys = {"spacing": f"[{length(distances[0])}, {length(distances[1])}]"}
    cell = max(ply.cell)
    clear = SAG * math.sqrt(1.0 - min(spacing)) * cell
    if rng.random() < ABOVE:
        below = Rectangle(ply, spacing, heading).ground(mold, drape.middle)
        lift = rng.uniform(max(HEIGHT[0] * cell, clear), HEIGHT[1] * cell)
        height = max(drape.top, below) + lift
        return "above", {**keys, "height": length(height), "origin": '"centred"'}

    highest = drape.top + HEIGHT[1] * cell
    for _ in range(100):
        turned = heading + rng.uniform(-TURN_DEG, TURN_DEG)
        away = rng.uniform(1.0, 2.0) * ply.reach + rng.uniform(0.0, 4.0) * cell
        away = min(away, FARTHEST * ply.scale)
        towards = rng.uniform(0.0, 2.0 * math.pi)
        x = drape.middle[0] + away * math.cos(towards)
        y = drape.middle[1] + away * math.sin(towards)
        rectangle = Rectangle(ply, spacing, turned)
        below = rectangle.ground(mold, (x, y))
        # from as low as the drape's lowest point: a table beside the mold
        lowest = (drape.bottom if math.isnan(below) else max(drape.bottom, below)) + clear
        if lowest > highest:
            continue  # a wall rises there
        first = rectangle.at((x, y), -1.0, -1.0)
        return "beside", {
            **keys,
            "height": length(rng.uniform(lowest, highest)),
            "origin": f"[{length(first[0])}, {length(first[1])}]",
            "direction": angle(turned),
        }
    raise RefusedError("no room beside")
