"""Where the grippers of a random scene pick the ply up: above its target, or beside it, turned."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass, replace

from ideal import Drape, RefusedError
from molds import Mold
from plies import Array
from units import angle, length

SPACING = (0.95, 0.995)
"""Distance of neighbors at pick-up, of the fabric between them."""

SAG = 1.8
"""Depth to which the middle of a cell hangs, at most, in cells times the root of the share by which
neighbors are closer: 24 mm in cells of 100 mm that are 2 % closer."""

HEIGHT = (0.3, 1.5)
"""Height of a pick-up above the mold's top, in cells; more where the ply would hang into it."""

ABOVE = 0.6
"""Share of the scenes whose pick-up is above the target."""

FARTHEST = 1.0
"""Farthest that a pick-up is beside the target (m)."""

TURN_DEG = 90.0
"""Largest angle from a pick-up's heading to the target's (degrees)."""


MAX_HANG_DEG = 35.0
"""Largest angle at which the ply may hang from its grippers (degrees); their joints tilt by 40."""

STEEPNESS = {"krogh2018": 6.0}
"""Square of a hanging ply's slope at a gripper, over the sum of the shares by which its neighbors
are closer than their fabric: 6 for parabolas."""

FOLDED = 11.0
"""The same for a light ply, which hangs in folds: 40 degrees were seen where a parabola has 32."""


@dataclass(frozen=True)
class PickUp:
    """A level rectangle of grippers."""

    name: str
    """Above the target, or beside it."""
    slack: tuple[float, float]
    """How much closer neighbors are than the fabric between them, as a share of it."""
    height: float
    """Height of the grippers (m)."""
    middle: tuple[float, float] | None = None
    """Middle of the rectangle (m); above the target's where there is none."""
    heading: float = 0.0
    """Heading of u (degrees); that of the target where there is no middle."""

    def taut(self, material: str) -> PickUp:
        """The same, with neighbors so far apart that the ply hangs no steeper than it may."""
        steep = STEEPNESS.get(material, FOLDED) * sum(self.slack)
        share = min(1.0, math.tan(math.radians(MAX_HANG_DEG)) ** 2 / steep)
        return replace(self, slack=(share * self.slack[0], share * self.slack[1]))

    def keys(self, ply: Array) -> dict[str, str]:
        """The table `[grippers]`."""
        spacing = [(1.0 - slack) * side for slack, side in zip(self.slack, ply.cell, strict=True)]
        keys: dict[str, str] = {
            "spacing": f"[{length(spacing[0])}, {length(spacing[1])}]",
            "height": length(self.height),
        }
        if self.middle is None:
            return {**keys, "origin": '"centered"'}
        x, y = Rectangle(ply, self.slack, self.heading).at(self.middle, -1.0, -1.0)
        origin = f"[{length(x)}, {length(y)}]"
        return {**keys, "origin": origin, "direction": angle(self.heading)}


class Rectangle:
    """Places in a level rectangle of grippers."""

    def __init__(self, ply: Array, slack: tuple[float, float], heading: float) -> None:
        """Of the shares by which neighbors are closer than their fabric; heading in degrees."""
        u, v = ((1.0 - s) * extent / 2.0 for s, extent in zip(slack, ply.extent, strict=True))
        c, s = math.cos(math.radians(heading)), math.sin(math.radians(heading))
        self.halves = ((u * c, u * s), (-v * s, v * c))
        """From its middle to the middle of its far sides along u and v (m)."""

    def at(self, middle: tuple[float, float], u: float, v: float) -> tuple[float, float]:
        """The place at shares of both halves from its middle."""
        (a, b), (c, d) = self.halves
        return middle[0] + u * a + v * c, middle[1] + u * b + v * d

    def height_below(self, mold: Mold, middle: tuple[float, float]) -> float:
        """The highest point of the mold below it; nan if there is none (m)."""
        shares = [n / 10.0 for n in range(-10, 11)]
        heights = [mold.height(*self.at(middle, u, v)) for u in shares for v in shares]
        return max((h for h in heights if not math.isnan(h)), default=math.nan)


def pick_up(
    rng: random.Random, ply: Array, mold: Mold, drape: Drape, heading: float, *, above: bool
) -> PickUp:
    """A random one for a target's heading (degrees), or one `above` it."""
    slack = (1.0 - rng.uniform(*SPACING), 1.0 - rng.uniform(*SPACING))
    cell = max(ply.cell)
    clear = SAG * math.sqrt(max(slack)) * cell
    if rng.random() < ABOVE or above:
        below = Rectangle(ply, slack, heading).height_below(mold, drape.middle)
        lift = rng.uniform(max(HEIGHT[0] * cell, clear), HEIGHT[1] * cell)
        return PickUp("above", slack, max(drape.top, below) + lift)

    highest = drape.top + HEIGHT[1] * cell
    for _ in range(100):
        turned = heading + rng.uniform(-TURN_DEG, TURN_DEG)
        away = rng.uniform(1.0, 2.0) * ply.reach + rng.uniform(0.0, 4.0) * cell
        away = min(away, FARTHEST)
        towards = rng.uniform(0.0, 2.0 * math.pi)
        x = drape.middle[0] + away * math.cos(towards)
        y = drape.middle[1] + away * math.sin(towards)
        below = Rectangle(ply, slack, turned).height_below(mold, (x, y))
        # from as low as the drape's lowest point: a table beside the mold
        lowest = (drape.bottom if math.isnan(below) else max(drape.bottom, below)) + clear
        if lowest <= highest:  # no wall rises there
            return PickUp("beside", slack, rng.uniform(lowest, highest), (x, y), turned)
    raise RefusedError("no room beside")
