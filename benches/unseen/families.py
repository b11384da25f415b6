"""Families of molds: shapes of the scene file, formulas, and a triangle mesh."""

from __future__ import annotations

import itertools
import math
import struct
from collections.abc import Callable

from molds import Draw, Height, Mold
from units import angle, length

CHORD_ERROR = 2.5e-4
"""Distance of a mesh's triangles from its surface, of the longer side of a cell."""

WALL = 0.8
"""Where a round hollow is a wall, of its radius from the middle."""


def plane(draw: Draw, tilt_deg: float, shear_deg: float) -> Mold:
    """A plane through a random point."""
    x, y, z = draw.place()
    climb = draw.rng.uniform(-180.0, 180.0)
    rise = math.tan(math.radians(tilt_deg))
    a, b = rise * math.cos(math.radians(climb)), rise * math.sin(math.radians(climb))
    keys = {
        "kind": '"plane"',
        "point": f"[{length(x)}, {length(y)}, {length(z)}]",
        "tilt": angle(tilt_deg),
        "tilt_direction": angle(climb),
    }
    return Mold(keys, lambda p, q: z + a * (p - x) + b * (q - y), (x, y), shear_deg)


def flat(draw: Draw) -> Mold:
    """A level plane on which the ply is sheared."""
    return plane(draw, 0.0, draw.rng.uniform(0.0, 25.0))


def tilted(draw: Draw) -> Mold:
    """A tilted plane; one in three shears the ply a little."""
    shear = draw.rng.uniform(2.0, 15.0) if draw.rng.random() < 1.0 / 3.0 else 0.0
    return plane(draw, math.degrees(draw.slope), shear)


def round_height(radius: float, distance: float, inside: bool) -> float:
    """Height of a circle of a radius over its middle, at a distance from it."""
    if distance > (WALL if inside else 1.0) * radius:
        return math.inf if inside else math.nan
    height = math.sqrt(radius**2 - distance**2)
    return -height if inside else height


def sphere(draw: Draw, inside: bool) -> Mold:
    """A sphere."""
    r = 1.0 / draw.curvature
    keys = {"kind": '"sphere"', "radius": length(r)}
    if inside:
        keys["side"] = '"inside"'
    return draw.posed(keys, lambda x, y: round_height(r, math.hypot(x, y), inside))


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
    return draw.posed(keys, lambda _, y: round_height(r, abs(y), inside), tilt_deg=5.0)


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
    keys = {"kind": '"saddle"', "radii": f"[{length(a)}, {length(b)}]", **draw.sides()}
    return draw.posed(keys, draw.square(lambda x, y: x * x / (2.0 * a) - y * y / (2.0 * b)))


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


def hat(draw: Draw) -> Mold:
    """A crest between two smooth steps, as a stringer has it with its fillets."""
    s = math.tan(draw.slope)
    w = max(0.77 * s / draw.bend, draw.rng.uniform(0.2, 0.6) * draw.reach)
    a = w * draw.rng.uniform(1.0, 2.5)
    k = s * w

    def local(x: float, _: float) -> float:
        return k * (math.tanh((x + a) / w) - math.tanh((x - a) / w))

    return draw.formula(
        f"{k:.6g}*(tanh((x + {a:.6g})/{w:.6g}) - tanh((x - {a:.6g})/{w:.6g}))", local
    )


def cone(draw: Draw) -> Mold:
    """A cone about z; the ply is so far from its tip that no cell turns too far."""
    s = math.tan(draw.slope)
    r = 1.5 * draw.half + draw.rng.uniform(1.0, 3.0) * s / draw.bend
    return draw.formula(
        f"{s:.6g}*({r:.6g} - sqrt((x + {r:.6g})^2 + y^2))",
        lambda x, y: s * (r - math.hypot(x + r, y)),
    )


def blade(draw: Draw) -> Mold:
    """A cambered surface that turns along itself, as a blade does."""
    k = 0.6 * draw.curvature * draw.rng.choice((-1.0, 1.0))
    c = 0.6 * draw.curvature * draw.rng.choice((-1.0, 1.0))
    return draw.formula(
        f"{k:.6g}*x*y + {c / 2.0:.6g}*y^2", lambda x, y: k * x * y + c * y * y / 2.0
    )


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
    return draw.posed(keys, lambda x, y: round_height(tube, abs(math.hypot(x, y) - ring), inside))


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
        return k * ((a * x * x + b * y * y) / 2.0 + c * x * y + p * x**3 + q * y**3)

    # a chord of the length e is e² k/8 off the surface
    edge = math.sqrt(8.0 * CHORD_ERROR * max(draw.array.cell) / (k * curved))
    file = stl(local, draw.half, math.ceil(2.0 * draw.half / edge))
    keys = {"kind": '"mesh"', "file": '"{name}.stl"', "unit": '"mm"'}
    return draw.posed(keys, draw.square(local), mesh=file)


def stl(local: Height, half: float, divisions: int) -> bytes:
    """A binary STL in millimeters of the square ±half (m), each of its squares cut in two."""
    places = [half * (2.0 * n / divisions - 1.0) for n in range(divisions + 1)]
    points = [[(1e3 * x, 1e3 * y, 1e3 * local(x, y)) for y in places] for x in places]

    def triangle(*corners: tuple[float, float, float]) -> bytes:
        return struct.pack("<12fH", 0.0, 0.0, 0.0, *(c for p in corners for c in p), 0)

    records = []
    for row, after in itertools.pairwise(points):
        for (a, d), (b, c) in zip(itertools.pairwise(row), itertools.pairwise(after), strict=True):
            records += [triangle(a, b, c), triangle(a, c, d)]
    header = b"a mold of a random scene, millimeters".ljust(80)
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
    "hat": hat,
    "cone": cone,
    "blade": blade,
    "ellipsoid": ellipsoid,
    "torus": torus,
    "mesh": mesh,
}
