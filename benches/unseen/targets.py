"""Where the plies of random scenes shall end."""

from __future__ import annotations

import math
import random

from blanks import Blank
from plies import Array
from units import angle, length

Place = tuple[float, float]


def seed(rng: random.Random, ply: Array) -> tuple[Place | None, Place]:
    """What is laid first, from the first cup and from the ply's middle (m); none is the middle."""
    if rng.random() < 0.6:
        return None, (0.0, 0.0)
    # quarters of cells, so that it lies on a node of the net
    quarters = [rng.randint(0, 4 * (number - 1)) for number in ply.grippers]
    u, v = (side * n / 4.0 for side, n in zip(ply.cell, quarters, strict=True))
    return (u, v), (u - ply.extent[0] / 2.0, v - ply.extent[1] / 2.0)


def target(
    rng: random.Random, ply: Array, blank: Blank, middle: tuple[float, float], shear_deg: float
) -> tuple[float, dict[str, str]]:
    """Where the ply shall end, its middle about over a place: heading of the array, and keys."""
    point, (u, v) = seed(rng, ply)
    # of fabric whose warp runs at an angle to the array, the middle is laid first, without shear
    if blank.warp_deg:
        point, (u, v), shear_deg = None, (0.0, 0.0), 0.0
    heading = rng.uniform(-90.0, 90.0)
    along, across = math.radians(heading), math.radians(heading + 90.0 - shear_deg)
    x = middle[0] + u * math.cos(along) + v * math.cos(across)
    y = middle[1] + u * math.sin(along) + v * math.sin(across)
    keys = {
        "seed": '"middle"',
        "origin": f"[{length(x)}, {length(y)}]",
        "direction": angle(heading + blank.warp_deg),
    }
    if point:
        first = blank.first or (0.0, 0.0)
        keys["seed"] = f"[{length(first[0] + point[0])}, {length(first[1] + point[1])}]"
    if shear_deg:
        keys["shear"] = angle(shear_deg)
    if rng.random() < 0.15:
        keys["generators"] = '"least-shear"'
    return heading, keys
