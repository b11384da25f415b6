"""Meshes: STL, OBJ, PLY and Abaqus files; vertices, faces, counts and keywords changed."""

from __future__ import annotations

import math
import struct
from random import Random

from . import case, scene, toml, values
from .case import Files, Kind

Point = tuple[float, float, float]
Face = tuple[int, ...]


def surface(rng: Random) -> tuple[list[Point], list[Face]]:
    """Vertices and triangles of a bump over a square of 0.6 m, in mm."""
    n = rng.choice((2, 4, 7))
    axis = [-150 + 600 * k / (n - 1) for k in range(n)]
    points = [(x, y, 20 * math.sin(x / 150) * math.cos(y / 150)) for y in axis for x in axis]
    corners = [n * j + i for j in range(n - 1) for i in range(n - 1)]
    faces: list[Face] = [f for c in corners for f in ((c, c + 1, c + n + 1), (c, c + n + 1, c + n))]
    return points, faces


def spoilt(rng: Random, points: list[Point], faces: list[Face]) -> str:
    """Changes vertices or faces in place; says how."""
    v, f = rng.randrange(len(points)), rng.randrange(len(faces))
    match rng.randrange(9):
        case 0:
            point = list(points[v])
            point[rng.randrange(3)] = values.number(rng, 100)
            points[v] = (point[0], point[1], point[2])
            return f"vertex {v} is {points[v]}"
        case 1:
            faces[f] = faces[f][::-1]
            return f"face {f} is turned over"
        case 2:
            faces.append(faces[f])
            return f"face {f} is there again"
        case 3:
            del faces[f :: rng.choice((1, 2, 1000))][:-1]
            return f"faces from {f} are gone"
        case 4:
            other = rng.choice((0, v, len(points), len(points) + 7))
            faces[f] = (*faces[f][:-1], other)
            return f"face {f} has the corner {other}"
        case 5:
            points.append((points[v][0], points[v][1], points[v][2] + rng.choice((0, 1e-9, 300))))
            faces.append((*faces[f][:2], len(points) - 1))
            return f"a fin on face {f}"
        case 6:
            scale = values.number(rng)
            axis = rng.randrange(3)
            points[:] = [
                (p[0], p[1], p[2] * scale) if axis == 2 else (p[0] * scale, p[1], p[2])
                for p in points
            ]
            return f"axis {axis} times {scale!r}"
        case 7:
            count = rng.choice((4, 5, 1000, 10_000))
            ring = [2 * math.pi * k / count for k in range(count)]
            first = len(points)
            points.extend((2000 + 100 * math.cos(a), 100 * math.sin(a), 0.0) for a in ring)
            faces.append(tuple(range(first, first + count)))
            return f"a polygon of {count} corners"
        case _:
            points[v] = points[rng.randrange(len(points))]
            return f"vertex {v} lies on another"


def triangles(points: list[Point], faces: list[Face]) -> list[list[Point]]:
    """Three corners of each face; a corner that is not there is the first."""
    return [[points[n] if n < len(points) else points[0] for n in face[:3]] for face in faces]


def ascii_stl(points: list[Point], faces: list[Face]) -> bytes:
    """STL as text."""
    facets = [
        "facet normal 0 0 1\nouter loop\n"
        + "".join("vertex {!r} {!r} {!r}\n".format(*p) for p in t)
        + "endloop\nendfacet\n"
        for t in triangles(points, faces)
    ]
    return ("solid mold\n" + "".join(facets) + "endsolid mold\n").encode()


def binary_stl(points: list[Point], faces: list[Face]) -> bytes:
    """STL in bytes."""
    facets = [
        struct.pack("<12fH", 0, 0, 1, *(single(x) for p in t for x in p), 0)
        for t in triangles(points, faces)
    ]
    return b"mold".ljust(80) + struct.pack("<I", len(facets)) + b"".join(facets)


def single(value: float) -> float:
    """The value if 32 bits hold it, else infinite."""
    return (
        value if not math.isfinite(value) or abs(value) < 3.4e38 else math.copysign(math.inf, value)
    )


def obj(points: list[Point], faces: list[Face]) -> bytes:
    """Wavefront OBJ."""
    lines = ["v {!r} {!r} {!r}".format(*p) for p in points]
    lines += ["f " + " ".join(str(n + 1) for n in face) for face in faces]
    return ("\n".join(lines) + "\n").encode()


def ply(points: list[Point], faces: list[Face]) -> bytes:
    """PLY as text: not read by plydrape, so it has to be refused."""
    head = (
        f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(faces)}\n"
        "property list uchar int vertex_indices\nend_header\n"
    )
    lines = ["{!r} {!r} {!r}".format(*p) for p in points]
    lines += [f"{len(face)} " + " ".join(map(str, face)) for face in faces]
    return (head + "\n".join(lines) + "\n").encode()


def inp(points: list[Point], faces: list[Face]) -> bytes:
    """An Abaqus deck of one part and one instance."""
    nodes = [f"{n + 1}, {x!r}, {y!r}, {z!r}" for n, (x, y, z) in enumerate(points)]
    elements = [f"{n + 1}, " + ", ".join(str(k + 1) for k in face) for n, face in enumerate(faces)]
    deck = ["*Heading", "*Part, name=mold", "*Node", *nodes, "*Element, type=R3D3", *elements]
    deck += ["*End Part", "*Assembly, name=all", "*Instance, name=mold-1, part=mold", "0, 0, 0"]
    return "\n".join([*deck, "*End Instance", "*End Assembly", ""]).encode()


FORMATS = {
    "ascii.stl": ascii_stl,
    "binary.stl": binary_stl,
    "mold.obj": obj,
    "mold.ply": ply,
    "mold.inp": inp,
}


def files(rng: Random) -> Files:
    """A scene with a mesh, sound or with its geometry spoilt."""
    name = rng.choice((*FORMATS, "mold.inp", "mold.obj"))
    if name == "mold.ply" and rng.random() < 0.7:
        name = "mold.inp"
    points, faces = surface(rng)
    if rng.random() < 0.4:
        spoilt(rng, points, faces)
    table = {
        "ply": {"grippers": [3, 2], "cell": ["100 mm", "100 mm"], "material": "krogh2018"},
        "mold": {"kind": "mesh", "file": name, "unit": "mm"},
        "grippers": {"spacing": ["98 mm", "98 mm"], "height": "60 mm", "origin": "centered"},
        "target": {"seed": "middle", "origin": ["150 mm", "150 mm"], "mesh": "25 mm"},
        "motion": {"kind": "straight", "steps": 3},
        "plan": scene.PLAN,
    }
    return {scene.NAME: toml.text(table).encode(), name: FORMATS[name](points, faces)}


# Lines that mean something in one of the formats.
LINES = (
    *(
        "f 1 2 3",
        "f -1 -2 -3",
        "f 1//1 2//2 3//3",
        "f 0 1 2",
        "f 1 2",
        "v 0 0 0 0.5",
        "v 1e200 0 0",
    ),
    *("vp 0 0", "vt 0 0", "usemtl a", "f 1/2/3 4/5/6 7", "l 1 2 3", "f 99999999999999999999 1 2"),
    *(
        "*Instance, name=again, part=mold",
        "*End Instance",
        "*Part, name=mold",
        "*End Part",
        "*Node",
    ),
    *("*Element, type=S4R", "*Element, type=S8R", "*Element, type=C3D8", "*Include, input=x.inp"),
    *(
        "*Node, nset=a",
        "*Nset, nset=a, generate",
        "1, 1e308, 1, 0, 0, 0, 30",
        "0, 0, 0, 0, 0, 0, 90",
    ),
    *(
        "1e200, 0, 0",
        "*Assembly",
        "**",
        "*",
        "*,",
        "*Node,",
        "*Element, type=",
        "1, 2, 3",
        "1, 1, 1, 1",
    ),
    *(
        "solid",
        "endsolid",
        "facet normal nan nan nan",
        "vertex 1e39 0 0",
        "vertex 1 2",
        "outer loop",
    ),
)


def line(rng: Random, files: Files) -> str:
    """Puts a line of meaning at some place, or changes a number in one."""
    name = next(name for name in files if name != scene.NAME)
    content = files[name]
    if isinstance(content, case.Odd):
        return "no mesh to change"
    lines = content.split(b"\n")
    at = rng.randrange(len(lines) + 1)
    if rng.random() < 0.4:
        new = rng.choice(LINES)
        lines.insert(at, new.encode())
    else:
        at = min(at, len(lines) - 1)
        fields = lines[at].split(b" ")
        new = repr(rng.choice((values.number(rng, 100), rng.randint(-3, 60))))
        fields[rng.randrange(len(fields))] = new.encode()
        lines[at] = b" ".join(fields)
    files[name] = b"\n".join(lines)
    return f"{name}, line {at + 1}: {new}"


def many(rng: Random, files: Files) -> str:
    """Many instances of the part of a deck, or a count of triangles that is not true."""
    name = next(name for name in files if name != scene.NAME)
    content = files[name]
    if isinstance(content, case.Odd):
        return "no mesh to enlarge"
    if name == "mold.inp":
        count = rng.choice((2, 100, 10_000))
        more = [
            f"*Instance, name=i{n}, part=mold\n{1000 * n}, 0, 0\n*End Instance\n"
            for n in range(count)
        ]
        files[name] = content.replace(b"*End Assembly", "".join(more).encode() + b"*End Assembly")
        return f"{name}: {count} instances more"
    if name == "binary.stl":
        count = rng.choice((0, 1, 2**16, 2**31, 2**32 - 1))
        files[name] = content[:80] + struct.pack("<I", count) + content[84:]
        return f"{name} says it has {count} triangles"
    files[name] = content * 2
    return f"{name} twice, one behind the other"


def ending(rng: Random, files: Files) -> str:
    """The mesh under the name of another format."""
    name = next(name for name in files if name != scene.NAME)
    other = rng.choice(
        ("mold.stl", "mold.obj", "mold.inp", "MOLD.OBJ", "mold", "mold.step", ".stl")
    )
    table = scene.table(files)
    if table is None or not isinstance(table.get("mold"), dict) or other in files:
        return "no scene to change"
    table["mold"]["file"] = other
    files[scene.NAME], files[other] = toml.text(table).encode(), files.pop(name)
    return f"{name} is called {other}"


KIND = Kind(
    files=files,
    mutations=(
        (10, line),
        (0.5, many),
        (0.5, ending),
        (2, scene.change),
        (3, case.damage(".stl", ".obj", ".inp", ".ply", "mold", ".step", ".OBJ")),
        (0.2, case.odd_file),
    ),
    commands=scene.COMMANDS,
)
