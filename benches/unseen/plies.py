"""Plies of random scenes: arrays of grippers in size classes, cells, materials, targets."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

from units import angle, length

SIZES = {"small": (0.55, 6, 16), "medium": (0.30, 17, 30), "large": (0.15, 31, 120)}
"""Size classes: share of the scenes, fewest and most grippers."""

GRIPPERS = ((3, 12), (2, 10))
"""Fewest and most grippers along both axes."""

LONGEST = 3
"""Most cells along one axis for each along the other."""

CELL = (0.050, 0.150)
"""Smallest and largest side of a cell (m)."""

SLIMMEST = 0.6
"""Shorter side of a cell, of the longer one, at least."""

LIGHT = {
    "cao2008_plain": 0.15,
    "petrak2025_cotton_twill": 0.05,
    "petrak2025_polyester_plain": 0.05,
    "petrak2025_polyester_twill": 0.05,
}
"""Materials of light plies, and the share of the scenes with little shear that each has."""

LIGHT_SHEAR_DEG = 3.0
"""Largest shear of an ideal drape for a light ply (degrees): sheared in the air, it folds."""


@dataclass(frozen=True)
class Array:
    """The grippers and the fabric between them."""

    grippers: tuple[int, int]
    """Number along u and v."""
    cell: tuple[float, float]
    """Fabric between neighbors, along u and v (m)."""
    scale: float
    """Of all lengths."""

    @property
    def extent(self) -> tuple[float, float]:
        """Fabric between the outermost grippers, along u and v (m)."""
        return (self.grippers[0] - 1) * self.cell[0], (self.grippers[1] - 1) * self.cell[1]

    @property
    def reach(self) -> float:
        """Fabric from the middle to a corner (m)."""
        return math.hypot(*self.extent) / 2.0


def array(rng: random.Random, sizes: list[str], scale: float) -> tuple[str, Array]:
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
    cell = [longer * scale, shorter * scale]
    rng.shuffle(cell)
    return size, Array((nu, nv), (cell[0], cell[1]), scale)


def seed(rng: random.Random, ply: Array) -> tuple[str, tuple[float, float]]:
    """The fabric point that is laid first, as TOML and from the ply's middle (m)."""
    if rng.random() < 0.6:
        return '"middle"', (0.0, 0.0)
    # quarters of cells, so that it lies on a node of the net
    quarters = [rng.randint(0, 4 * (number - 1)) for number in ply.grippers]
    place = [side * n / 4.0 for side, n in zip(ply.cell, quarters, strict=True)]
    away = [p - extent / 2.0 for p, extent in zip(place, ply.extent, strict=True)]
    return "[" + ", ".join(length(p) for p in place) + "]", (away[0], away[1])


def target(
    rng: random.Random, ply: Array, middle: tuple[float, float], shear_deg: float
) -> tuple[float, dict[str, str]]:
    """Where the ply shall end, its middle about over a place: heading (degrees) and keys."""
    point, (u, v) = seed(rng, ply)
    heading = rng.uniform(-90.0, 90.0)
    along, across = math.radians(heading), math.radians(heading + 90.0 - shear_deg)
    x = middle[0] + u * math.cos(along) + v * math.cos(across)
    y = middle[1] + u * math.sin(along) + v * math.sin(across)
    keys = {"seed": point, "origin": f"[{length(x)}, {length(y)}]", "direction": angle(heading)}
    if shear_deg:
        keys["shear"] = angle(shear_deg)
    if rng.random() < 0.15:
        keys["generators"] = '"least-shear"'
    return heading, keys


def material(rng: random.Random, shear_deg: float) -> str:
    """The prepreg of the paper; a lighter ply now and then, where the ideal drape hardly shears."""
    names = [*LIGHT, "krogh2018"]
    name = rng.choices(names, [*LIGHT.values(), 1.0 - sum(LIGHT.values())])[0]
    return name if shear_deg <= LIGHT_SHEAR_DEG else "krogh2018"


def scaled(scale: float) -> dict[str, dict[str, str]]:
    """The prepreg, and what else a scene says, so that all lengths times a scale is the same task.

    The weight of a line stays, so forces grow with the lengths, and EI with their third power.
    """
    return {
        "ply.material": {
            "name": f'"krogh2018, scaled by {scale:g}"',
            "source": '"krogh2018 with EI times the third power of the scale"',
            "mass": '"0.3143 kg/m"',
            "flexural_rigidity": f'"{9e-6 * scale**3:.6g} N m^2"',
            "tension": '"1e6 N/m"',
            "shear_curve": '"5 N/m"',
        },
        "model": {"axial_stiffness": f'"{100.0 * scale:g} kN"'},
        "contact": {"tolerance": length(0.0002 * scale)},
        "limits": {
            "bridging": length(0.001 * scale),
            "landing_gripper": length(0.0005 * scale),
            "height": length(0.0005 * scale),
            "position": length(0.002 * scale),
            "gripper_load": f'"{10.0 * scale:g} N"',
            "speed": f'"{0.25 * scale:g} m/s"',
            "acceleration": f'"{scale:g} m/s^2"',
            "jerk": f'"{10.0 * scale:g} m/s^3"',
        },
    }
