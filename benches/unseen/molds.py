"""Molds of random scenes: families of surfaces, drawn so that they suit an array of grippers.

Every family draws the slope at the array's corners and takes its curvature from it, bounded by how much
the mold may turn along one cell. Lengths follow from the array, so a scaled array has a scaled mold.
"""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Callable
from dataclasses import dataclass, field

Height = Callable[[float, float], float]
"""Height of a mold over a place (m): nan beside the mold, inf where it rises like a wall."""

FLATTEST_DEG, STEEPEST_DEG = 8.0, 27.0
"""Slopes between which a family aims near the array's corners (degrees)."""

TURN_OF_A_CELL = 0.35
"""Largest angle by which a mold turns along one cell (rad); more cannot be followed by its grippers."""

MIDDLE_OFF = 0.3
"""Farthest that the ply's middle lies from the mold's, of the array's reach, along each axis."""

CHORD_ERROR = 2.5e-4
"""Distance of a mesh's triangles from its surface, of the array's longer cell side."""


@dataclass(frozen=True)
class Array:
    """What a mold has to suit."""

    grippers: tuple[int, int]
    cell: tuple[float, float]
    """Fabric between neighbouring grippers, along u and v (m)."""
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
    files: dict[str, bytes] = field(default_factory=dict)
    """Endings of further files, and what is in them."""


def length(value: float) -> str:
    """A length (m) as TOML, in mm."""
    return f'"{value * 1e3 + 0.0:.6g} mm"'


def angle(value: float) -> str:
    """An angle (degrees) as TOML."""
    return f'"{value + 0.0:.5g} deg"'


class Draw:
    """Random numbers for the mold of one array."""

    def __init__(self, rng: random.Random, array: Array) -> None:
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
        self.half = 1.3 * self.reach + math.hypot(*self.middle)
        """Half of the side of a mold that holds the ply however it is turned (m)."""

    def near(self, size: float) -> float:
        """A number within ±size."""
        return self.rng.uniform(-size, size)

    def posed(
        self,
        keys: dict[str, str],
        local: Height,
        *,
        tilt_deg: float = 0.0,
        files: dict[str, bytes] | None = None,
    ) -> Mold:
        """A mold turned about z and put anywhere; one with a tilt is turned about x and y too."""
        turn = (self.near(tilt_deg), self.near(tilt_deg), self.rng.uniform(-180.0, 180.0))
        place = tuple(self.near(size * self.array.scale) for size in (1.0, 1.0, 0.3))
        axes = rotation(turn)

        def out(p: tuple[float, float, float]) -> list[float]:
            return [place[n] + sum(axes[n][k] * p[k] for k in range(3)) for n in range(3)]

        def height(x: float, y: float) -> float:
            z = place[2]
            for _ in range(20):
                d = (x - place[0], y - place[1], z - place[2])
                p = [sum(axes[n][k] * d[n] for n in range(3)) for k in range(3)]
                ground = local(p[0], p[1])
                if not math.isfinite(ground):
                    return ground
                z -= (p[2] - ground) / axes[2][2]
            return z

        x, y, _ = out((*self.middle, local(*self.middle)))
        pose = {
            "position": "[" + ", ".join(length(p) for p in place) + "]",
            "rotation": "[" + ", ".join(angle(a) for a in turn) + "]",
        }
        return Mold({**keys, **pose}, height, (x, y), files=files or {})

    def formula(self, z: str, local: Height) -> Mold:
        """A formula over a square, which `local` evaluates."""
        half = self.half

        def within(x: float, y: float) -> float:
            return local(x, y) if max(abs(x), abs(y)) <= half else math.nan

        side = f"[{length(-half)}, {length(half)}]"
        return self.posed({"kind": '"formula"', "z": f'"{z}"', "x": side, "y": side}, within)


def rotation(turn: tuple[float, float, float]) -> list[list[float]]:
    """The matrix of turns about the fixed axes x, then y, then z (degrees)."""
    (a, b, c), (p, q, r) = ([f(math.radians(t)) for t in turn] for f in (math.cos, math.sin))
    return [
        [c * b, c * q * p - r * a, c * q * a + r * p],
        [r * b, r * q * p + c * a, r * q * a - c * p],
        [-q, b * p, b * a],
    ]


def plane(draw: Draw, tilt_deg: float, shear_deg: float) -> Mold:
    """A plane through a random point."""
    x, y, z = (draw.near(size * draw.array.scale) for size in (1.0, 1.0, 0.3))
    climb = draw.rng.uniform(-180.0, 180.0)
    rise = math.tan(math.radians(tilt_deg))
    along = (rise * math.cos(math.radians(climb)), rise * math.sin(math.radians(climb)))
    keys = {
        "kind": '"plane"',
        "point": f"[{length(x)}, {length(y)}, {length(z)}]",
        "tilt": angle(tilt_deg),
        "tilt_direction": angle(climb),
    }
    ground: Height = lambda p, q: z + along[0] * (p - x) + along[1] * (q - y)  # noqa: E731
    return Mold(keys, ground, (x, y), shear_deg)


def flat(draw: Draw) -> Mold:
    """A level plane on which the ply is sheared."""
    return plane(draw, 0.0, draw.rng.uniform(0.0, 25.0))


def tilted(draw: Draw) -> Mold:
    """A tilted plane; one in three shears the ply a little."""
    shear = draw.rng.uniform(2.0, 15.0) if draw.rng.random() < 1.0 / 3.0 else 0.0
    return plane(draw, math.degrees(draw.slope), shear)


def cap(radius: float, distance2: float, inside: bool) -> float:
    """Height of a round surface over its axis or centre; inside, a wall from 80 % of the radius on."""
    if distance2 > (0.64 if inside else 1.0) * radius**2:
        return math.inf if inside else math.nan
    height = math.sqrt(radius**2 - distance2)
    return -height if inside else height


def sphere(draw: Draw, inside: bool) -> Mold:
    """A sphere."""
    r = 1.0 / draw.curvature
    keys = {"kind": '"sphere"', "radius": length(r)}
    if inside:
        keys["side"] = '"inside"'
    return draw.posed(keys, lambda x, y: cap(r, x * x + y * y, inside))


def dome(draw: Draw) -> Mold:
    """A sphere from outside."""
    return sphere(draw, inside=False)


def bowl(draw: Draw) -> Mold:
    """A sphere from inside, or a paraboloid."""
    if draw.rng.random() < 0.5:
        return sphere(draw, inside=True)
    k = draw.curvature / 2.0
    return draw.formula(f"{k:.6g}*(x^2 + y^2)", lambda x, y: k * (x * x + y * y))


def round_beam(draw: Draw, inside: bool) -> Mold:
    """A cylinder about x whose axis may climb."""
    r = 1.0 / draw.curvature
    keys = {"kind": '"cylinder"', "radius": length(r)}
    if inside:
        keys["side"] = '"inside"'
    return draw.posed(keys, lambda _, y: cap(r, y * y, inside), tilt_deg=5.0)


def cylinder(draw: Draw) -> Mold:
    """A cylinder from outside."""
    return round_beam(draw, inside=False)


def trough(draw: Draw) -> Mold:
    """A cylinder from inside."""
    return round_beam(draw, inside=True)


def saddle(draw: Draw) -> Mold:
    """Up along x and down along y, with different radii."""
    radii = [1.0 / (draw.curvature * share) for share in (1.0, draw.rng.uniform(0.4, 1.0))]
    draw.rng.shuffle(radii)
    a, b = radii
    side = f"[{length(-draw.half)}, {length(draw.half)}]"
    keys = {
        "kind": '"saddle"',
        "radii": f"[{length(a)}, {length(b)}]",
        "x": side,
        "y": side,
    }

    def local(x: float, y: float) -> float:
        within = max(abs(x), abs(y)) <= draw.half
        return x * x / (2.0 * a) - y * y / (2.0 * b) if within else math.nan

    return draw.posed(keys, local)


def gutter(draw: Draw) -> Mold:
    """Two slopes that meet in a round bottom: z = s √(y² + r²)."""
    s = math.tan(draw.slope)
    r = max(s / draw.bend, draw.rng.uniform(0.2, 1.0) * draw.reach)
    return draw.formula(
        f"{s:.6g}*sqrt(y^2 + {r * r:.6g})", lambda _, y: s * math.sqrt(y * y + r * r)
    )


def waves(draw: Draw) -> Mold:
    """A sine along x, or across both axes; not steeper and not more curved than the others."""
    number = 2.0 * math.pi / (draw.rng.uniform(1.2, 4.0) * 2.0 * draw.reach)
    size = min(math.tan(draw.slope) / number, draw.bend / number**2)
    if draw.rng.random() < 0.6:
        return draw.formula(
            f"{size:.6g}*sin({number:.6g}*x)", lambda x, _: size * math.sin(number * x)
        )
    other = number * draw.rng.uniform(0.3, 1.0)
    return draw.formula(
        f"{size:.6g}*sin({number:.6g}*x)*cos({other:.6g}*y)",
        lambda x, y: size * math.sin(number * x) * math.cos(other * y),
    )


def twist(draw: Draw) -> Mold:
    """A plane that turns along itself: z = k x y."""
    k = draw.curvature * draw.rng.choice((-1.0, 1.0))
    return draw.formula(f"{k:.6g}*x*y", lambda x, y: k * x * y)


def ramp(draw: Draw) -> Mold:
    """A smooth step: the slope is that of tanh(x/w), the curvature at most 0.77 slope/w."""
    s = math.tan(draw.slope)
    w = max(0.77 * s / draw.bend, draw.rng.uniform(0.3, 1.0) * draw.reach)
    return draw.formula(f"{s * w:.6g}*tanh(x/{w:.6g})", lambda x, _: s * w * math.tanh(x / w))


def ellipsoid(draw: Draw) -> Mold:
    """The top of an ellipsoid with three axes; its square lies well within."""
    a, b = (draw.half / 0.64 * draw.rng.uniform(1.0, 1.5) for _ in range(2))
    c = min(a, b) ** 2 * draw.curvature
    return draw.formula(
        f"{c:.6g}*sqrt(1 - x^2/{a * a:.6g} - y^2/{b * b:.6g})",
        lambda x, y: c * math.sqrt(1.0 - (x / a) ** 2 - (y / b) ** 2),
    )


def torus(draw: Draw) -> Mold:
    """A piece of a ring about z, the ply on its crest or in its hollow."""
    tube = 1.0 / draw.curvature
    ring = tube * draw.rng.uniform(1.5, 4.0)
    inside = draw.rng.random() < 0.4
    keys = {"kind": '"torus"', "ring_radius": length(ring), "tube_radius": length(tube)}
    if inside:
        keys["side"] = '"inside"'
    draw.middle = (ring + draw.middle[0], 0.0)
    return draw.posed(keys, lambda x, y: cap(tube, (math.hypot(x, y) - ring) ** 2, inside))


def mesh(draw: Draw) -> Mold:
    """A doubly curved cubic as triangles."""
    a, b, c = (draw.near(1.0) for _ in range(3))
    p, q = (draw.near(0.1) / draw.reach for _ in range(2))

    def gradient(x: float, y: float) -> float:
        return math.hypot(a * x + c * y + 3.0 * p * x * x, b * y + c * x + 3.0 * q * y * y)

    # as steep as wanted on a circle about the ply's middle, unless that bends cells too much
    turns = [2.0 * math.pi * n / 32.0 for n in range(32)]
    x, y = draw.middle
    steepest = max(
        gradient(x + draw.reach * math.cos(t), y + draw.reach * math.sin(t)) for t in turns
    )
    curved = max(abs(a), abs(b)) + abs(c) + 6.0 * max(abs(p), abs(q)) * draw.reach
    k = min(math.tan(draw.slope) / steepest, draw.bend / curved)

    def local(x: float, y: float) -> float:
        if max(abs(x), abs(y)) > draw.half:
            return math.nan
        return k * ((a * x * x + b * y * y) / 2.0 + c * x * y + p * x**3 + q * y**3)

    # a chord of the length e is e² k/8 off the surface
    edge = math.sqrt(8.0 * CHORD_ERROR * max(draw.array.cell) / (k * curved))
    file = stl(local, draw.half, math.ceil(2.0 * draw.half / edge))
    keys = {"kind": '"mesh"', "file": '"{name}.stl"', "unit": '"mm"'}
    return draw.posed(keys, local, files={"stl": file})


def stl(local: Height, half: float, divisions: int) -> bytes:
    """A binary STL in millimetres of the square ±half (m), every small square cut in two triangles."""
    places = [half * (2.0 * n / divisions - 1.0) for n in range(divisions + 1)]
    points = [[(1e3 * x, 1e3 * y, 1e3 * local(x, y)) for y in places] for x in places]
    records = []
    for i in range(divisions):
        for j in range(divisions):
            a, b = points[i][j], points[i + 1][j]
            c, d = points[i + 1][j + 1], points[i][j + 1]
            for corners in ((a, b, c), (a, c, d)):
                records.append(struct.pack("<12fH", 0.0, 0.0, 0.0, *sum(corners, ()), 0))
    header = b"a mold of a random scene, millimetres".ljust(80)
    return header + struct.pack("<I", len(records)) + b"".join(records)


FAMILIES: dict[str, Callable[[Draw], Mold]] = {
    "flat": flat,
    "tilted": tilted,
    "dome": dome,
    "bowl": bowl,
    "cylinder": cylinder,
    "trough": trough,
    "saddle": saddle,
    "gutter": gutter,
    "waves": waves,
    "twist": twist,
    "ramp": ramp,
    "ellipsoid": ellipsoid,
    "torus": torus,
    "mesh": mesh,
}
