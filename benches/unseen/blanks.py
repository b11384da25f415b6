"""The fabric of random scenes: how it is cut, how its warp runs, and which cups hold it."""

from __future__ import annotations

import random
from dataclasses import dataclass

from plies import Array
from units import angle, length

KINDS = {
    "rectangle": 0.5,
    "corner off": 0.1,
    "hole": 0.1,
    "notch": 0.1,
    "cup off": 0.1,
    "bias": 0.1,
}
"""Kinds of fabric, and the share of the scenes that each has."""

EDGED = 0.6
"""Share of the rectangles with fabric beyond the outermost cups."""

MARGIN = 0.25
"""Least fabric around the outermost cups of a ply that is cut, of the most that may hang over."""

CORNER = (0.4, 1.0)
"""Legs of a corner that is cut off, in cells beyond the margin."""

HOLE = (0.2, 0.5)
"""Diameter of a hole in the middle of a cell, of the cell's shorter side."""

NOTCH = ((0.2, 0.6), (0.2, 0.7))
"""Width and depth of a notch, as a dart leaves it, in cells; the depth beyond the margin."""

BIAS_DEG = (45.0, -45.0, 90.0)
"""Warps of half of the plies that run at an angle to the array; the others are anywhere between."""


@dataclass(frozen=True)
class Blank:
    """A ply as it is cut and held."""

    name: str
    """Its kind."""
    keys: dict[str, str]
    """Keys of the table `[ply]` without the material."""
    edge: float
    """Fabric beyond the outermost cups (m)."""
    first: tuple[float, float] | None = None
    """Where the first cup holds the drawing (m); none of a rectangle that is given by its cups."""
    warp_deg: float = 0.0
    """Angle from the rows of the array to the warp (degrees)."""


def blank(rng: random.Random, ply: Array, overhang: float) -> Blank:
    """A random one under an array of cups, with so much fabric beyond them at most (m)."""
    name = rng.choices(list(KINDS), list(KINDS.values()))[0]
    keys = {
        "grippers": f"[{ply.grippers[0]}, {ply.grippers[1]}]",
        "cell": f"[{length(ply.cell[0])}, {length(ply.cell[1])}]",
    }
    if name == "rectangle":
        if rng.random() < EDGED:
            edge = round(rng.uniform(0.0, overhang), 3)
            return Blank(name, {**keys, "overhang": length(edge)}, edge)
        return Blank(name, keys, 0.0)

    margin = round(rng.uniform(MARGIN * overhang, overhang), 3)
    size = [extent + 2.0 * margin for extent in ply.extent]
    keys["size"] = f"[{length(size[0])}, {length(size[1])}]"
    # a cup of 2 mm around its point is on the ply, or it does not hold
    array = {"margin": length(min(margin, 0.002)), "partly": '"leave-off"'}
    warp_deg = 0.0
    if name == "corner off":
        u, v = (margin + rng.uniform(*CORNER) * side for side in ply.cell)
        points = [
            (0.0, 0.0),
            (size[0], 0.0),
            (size[0], size[1] - v),
            (size[0] - u, size[1]),
            (0.0, size[1]),
        ]
        del keys["size"]
        keys["outline"] = polygon(points)
    elif name == "hole":
        cell = [rng.randrange(number - 1) + 0.5 for number in ply.grippers]
        u, v = (margin + side * n for side, n in zip(ply.cell, cell, strict=True))
        diameter = rng.uniform(*HOLE) * min(ply.cell)
        keys["holes"] = (
            f"[{{ middle = [{length(u)}, {length(v)}], diameter = {length(diameter)} }}]"
        )
    elif name == "notch":
        # between two cups of the row along v = 0
        u = margin + (rng.randrange(ply.grippers[0] - 1) + 0.5) * ply.cell[0]
        half = 0.5 * rng.uniform(*NOTCH[0]) * ply.cell[0]
        depth = margin + rng.uniform(*NOTCH[1]) * ply.cell[1]
        points = [(0.0, 0.0), (u - half, 0.0), (u, depth), (u + half, 0.0), (size[0], 0.0)]
        del keys["size"]
        keys["outline"] = polygon([*points, (size[0], size[1]), (0.0, size[1])])
    elif name == "cup off":
        rows = [["#"] * ply.grippers[0] for _ in range(ply.grippers[1])]
        off = rng.randrange(ply.grippers[0] * ply.grippers[1])
        rows[off // ply.grippers[0]][off % ply.grippers[0]] = "."
        array["holds"] = "[" + ", ".join(f'"{"".join(row)}"' for row in rows) + "]"
    else:
        warp_deg = rng.choice(BIAS_DEG) if rng.random() < 0.5 else rng.uniform(-90.0, 90.0)
        keys["warp"] = angle(warp_deg)
    keys["array"] = "{ " + ", ".join(f"{key} = {value}" for key, value in array.items()) + " }"
    return Blank(name, keys, margin, (margin, margin), warp_deg)


def polygon(points: list[tuple[float, float]]) -> str:
    """Corners of an outline, as TOML."""
    return "[" + ", ".join(f"[{length(u)}, {length(v)}]" for u, v in points) + "]"
