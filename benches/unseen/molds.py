"""Molds of random scenes: what every family draws, and the pose of a mold.

A family draws the slope that its surface shall have near the array's corners and takes its
curvature from it, bounded by how far a mold may turn along one cell.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import dataclass, field

from plies import Array
from units import angle, length

Height = Callable[[float, float], float]
"""Height of a mold over a place (m): nan beside the mold, inf where it rises like a wall."""

Vector = tuple[float, float, float]

FLATTEST_DEG, STEEPEST_DEG = 8.0, 27.0
"""Slopes between which a family aims near the array's corners (degrees)."""

TURN_OF_A_CELL = 0.35
"""Largest angle by which a mold turns along one cell (rad)."""

MIDDLE_OFF = 0.3
"""Farthest that the ply's middle lies from the mold's along each axis, of the array's reach."""

PLACE = (1.0, 1.0, 0.3)
"""How far from the origin of the scene a mold is, at most, in x, y and z (m)."""


@dataclass(frozen=True)
class Mold:
    """A mold as a scene has it."""

    keys: dict[str, str]
    """Keys of the table `[mold]` and their values as TOML."""
    height: Height
    """Over a place of the scene."""
    middle: tuple[float, float]
    """Place x, y over which the ply's middle shall lie (m)."""
    shear_deg: float = 0.0
    """Shear at the seed of the drape (degrees)."""
    mesh: bytes = b""
    """The file of a mesh."""


@dataclass(frozen=True)
class Pose:
    """Pose of a mold: turned about the fixed axes x, then y, then z, and moved."""

    turn: Vector
    """Angles (degrees)."""
    place: Vector
    """Where the mold's own origin is (m)."""
    axes: list[list[float]] = field(init=False)
    """Rows of the rotation matrix."""

    def __post_init__(self) -> None:
        """Works out the matrix."""
        a, b, c = (math.cos(math.radians(t)) for t in self.turn)
        p, q, r = (math.sin(math.radians(t)) for t in self.turn)
        rows = [
            [c * b, c * q * p - r * a, c * q * a + r * p],
            [r * b, r * q * p + c * a, r * q * a - c * p],
            [-q, b * p, b * a],
        ]
        object.__setattr__(self, "axes", rows)

    def outward(self, p: Vector) -> list[float]:
        """A point of the mold in the scene."""
        turned = [sum(a * x for a, x in zip(row, p, strict=True)) for row in self.axes]
        return [o + t for o, t in zip(self.place, turned, strict=True)]

    def inward(self, p: Vector) -> list[float]:
        """A point of the scene in the mold's own frame."""
        away = [x - o for x, o in zip(p, self.place, strict=True)]
        columns = zip(*self.axes, strict=True)
        return [sum(a * x for a, x in zip(column, away, strict=True)) for column in columns]

    def height(self, local: Height) -> Height:
        """The height over a place of the scene, by Newton's method on a nearly upright mold."""

        def height(x: float, y: float) -> float:
            z = self.place[2]
            for _ in range(20):
                u, v, w = self.inward((x, y, z))
                surface = local(u, v)
                if not math.isfinite(surface):
                    return surface
                before = z
                z -= (w - surface) / self.axes[2][2]
                if z == before:  # as every further step would leave it
                    break
            return z

        return height

    def keys(self) -> dict[str, str]:
        """Its keys in a scene."""
        return {
            "position": "[" + ", ".join(length(p) for p in self.place) + "]",
            "rotation": "[" + ", ".join(angle(t) for t in self.turn) + "]",
        }


class Draw:
    """Random numbers for the mold of one array with an edge of fabric beyond its cups."""

    def __init__(self, rng: random.Random, array: Array, edge: float) -> None:
        """Draws what every family needs."""
        self.rng = rng
        self.array = array
        self.reach = array.reach
        self.bend = TURN_OF_A_CELL / max(array.cell)
        """Largest curvature (1/m)."""
        self.slope = math.radians(rng.uniform(FLATTEST_DEG, STEEPEST_DEG))
        """Slope that the mold shall have near the array's corners (rad)."""
        self.curvature = min(math.sin(self.slope) / self.reach, self.bend)
        """Curvature of a round mold that has this slope there (1/m)."""
        self.middle = (self.near(MIDDLE_OFF * self.reach), self.near(MIDDLE_OFF * self.reach))
        """The ply's middle in the mold's own plan (m)."""
        corner = self.reach + math.sqrt(2.0) * edge
        self.half = max(1.3 * self.reach, corner) + math.hypot(*self.middle)
        """Half of the side of a square that holds the ply however it is turned (m)."""

    def near(self, size: float) -> float:
        """A number within ±size."""
        return self.rng.uniform(-size, size)

    def place(self) -> Vector:
        """Position of a mold (m)."""
        x, y, z = (self.near(size) for size in PLACE)
        return x, y, z

    def posed(
        self, keys: dict[str, str], local: Height, *, tilt_deg: float = 0.0, mesh: bytes = b""
    ) -> Mold:
        """A mold that is turned about z, tilted by up to an angle, and put anywhere."""
        turn = (self.near(tilt_deg), self.near(tilt_deg), self.rng.uniform(-180.0, 180.0))
        pose = Pose(turn, self.place())
        x, y, _ = pose.outward((*self.middle, local(*self.middle)))
        return Mold({**keys, **pose.keys()}, pose.height(local), (x, y), mesh=mesh)

    def square(self, local: Height) -> Height:
        """The height within the square that holds the ply; there is no mold beyond it."""
        return lambda x, y: local(x, y) if max(abs(x), abs(y)) <= self.half else math.nan

    def sides(self) -> dict[str, str]:
        """The keys of that square."""
        side = f"[{length(-self.half)}, {length(self.half)}]"
        return {"x": side, "y": side}

    def formula(self, z: str, local: Height) -> Mold:
        """A formula over the square, and the same as a function."""
        keys = {"kind": '"formula"', "z": f'"{z}"', **self.sides()}
        return self.posed(keys, self.square(local))
