"""Arrays of grippers of random scenes in size classes, and their cells."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

SIZES = {"small": (0.55, 4, 16), "medium": (0.30, 17, 30), "large": (0.15, 31, 120)}
"""Size classes: share of the scenes, fewest and most grippers."""

GRIPPERS = ((2, 12), (2, 10))
"""Fewest and most grippers along both axes."""

LONGEST = 3
"""Most cells along one axis for each along the other."""

CELL = (0.050, 0.150)
"""Smallest and largest side of a cell (m)."""

SLIMMEST = 0.6
"""Shorter side of a cell, of the longer one, at least."""

LARGEST = 1.5
"""Largest side of the fabric between the outermost grippers (m)."""


@dataclass(frozen=True)
class Array:
    """The grippers and the fabric between them."""

    grippers: tuple[int, int]
    """Number along u and v."""
    cell: tuple[float, float]
    """Fabric between neighbors, along u and v (m)."""

    @property
    def extent(self) -> tuple[float, float]:
        """Fabric between the outermost grippers, along u and v (m)."""
        return (self.grippers[0] - 1) * self.cell[0], (self.grippers[1] - 1) * self.cell[1]

    @property
    def reach(self) -> float:
        """Fabric from the middle to a corner (m)."""
        return math.hypot(*self.extent) / 2.0


def array(rng: random.Random, sizes: list[str]) -> tuple[str, Array]:
    """An array of one of the size classes, and the name of the class."""
    size = rng.choices(sizes, [SIZES[name][0] for name in sizes])[0]
    _, fewest, most = SIZES[size]
    while True:
        nu, nv = (rng.randint(*span) for span in GRIPPERS)
        slim = max(nu - 1, nv - 1) > LONGEST * min(nu - 1, nv - 1)
        if fewest <= nu * nv <= most and not slim:
            break
    if rng.random() < 0.3:
        nu, nv = nv, nu
    longer = round(rng.uniform(*CELL), 3)
    shorter = longer
    if rng.random() < 0.6:
        shorter = round(rng.uniform(max(CELL[0], SLIMMEST * longer), longer), 3)
    cell = [longer, shorter]
    rng.shuffle(cell)
    ply = Array((nu, nv), (cell[0], cell[1]))
    if max(ply.extent) > LARGEST:
        return array(rng, sizes)
    return size, ply
