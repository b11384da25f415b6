"""Random scenes that no example shows, to prove the planner on: python benches/unseen/scenes.py.

Writes N scenes (000.toml, 001.toml, ...) and a table of them, scenes.csv. The same seed gives the same
bytes, and scene n does not depend on how many are written. Families take turns. Draws that cannot be
planned are drawn again: the ideal drape (`plydrape net`) has to exist, to shear by at most 30 degrees and
to tilt no gripper by more than 30 degrees (joints tilt by 40), and `plydrape check` has to read the scene. How many were drawn again is printed.

    python benches/unseen/scenes.py --seed 7 --count 100 -o /tmp/unseen --plydrape target/release/plydrape
"""

from __future__ import annotations

import argparse
import csv
import json
import math
import random
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from molds import FAMILIES, Array, Draw, Mold, angle, length

ROOT = Path(__file__).resolve().parents[2]

MAX_SHEAR_DEG = 30.0
"""Largest shear of an ideal drape (degrees)."""

MAX_TILT_DEG = 30.0
"""Largest tilt of a gripper at its target (degrees)."""

LIGHT_SHEAR_DEG = 3.0
"""Largest shear of an ideal drape for a light ply (degrees): sheared in the air, it folds."""

CELL = (0.050, 0.150)
"""Smallest and largest side of a cell (m)."""

SLIMMEST = 0.6
"""Shorter side of a cell, of the longer one, at least."""

SPACING = (0.95, 0.995)
"""Distance of neighbours at pick-up, of the fabric between them."""

SAG = 1.8
"""Depth to which the middle of a cell hangs, at most, in cells and roots of the share that neighbours are
closer: 24 mm for cells of 100 mm that are 2 mm closer (the table of docs/theory/sheet.md)."""

PICK_UP = (0.3, 1.5)
"""Height of the pick-up above the mold's top, in cells; higher where the ply would hang into the mold."""

SIZES = {"small": (0.55, 6, 16), "medium": (0.30, 17, 30), "large": (0.15, 31, 120)}
"""Size classes: share of the scenes, fewest and most grippers."""

GRIPPERS = ((3, 12), (2, 10))
"""Fewest and most grippers along both axes."""

LONGEST = 3
"""Most cells along one axis for each along the other."""

LIGHT = {
    "cao2008_plain": 0.15,
    "petrak2025_cotton_twill": 0.05,
    "petrak2025_polyester_plain": 0.05,
    "petrak2025_polyester_twill": 0.05,
}
"""Materials of light plies, and the share of the scenes with little shear that each has."""


class RefusedError(Exception):
    """A draw that is no fair task, with the reason."""


@dataclass(frozen=True)
class Drape:
    """What `plydrape net` says of the ideal drape."""

    shear_deg: float
    """Largest shear of a cell."""
    tilt_deg: float
    """Largest angle of the ply to the plane at a gripper."""
    middle: tuple[float, float]
    """Mean place of the grippers (m)."""
    bottom: float
    """Height of its lowest point (m)."""
    top: float
    """Height of its highest point (m)."""


@dataclass(frozen=True)
class Scene:
    """A scene and what the table says of it."""

    text: str
    files: dict[str, bytes]
    row: dict[str, str]


class Plydrape:
    """The program that judges whether a scene is a fair task."""

    def __init__(self, program: Path) -> None:
        self.program = program

    def run(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """What it says."""
        command = [str(self.program), *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def check(self, scene: Path) -> None:
        """Refuses a scene that it refuses; its warnings are about straight ways, which no plan follows."""
        done = self.run("check", str(scene))
        if done.returncode != 0:
            sys.stderr.write(done.stderr)
            raise RefusedError("check")

    def drape(self, scene: Path, array: Array) -> Drape:
        """The ideal drape of a scene; refuses one that does not exist."""
        folder = scene.with_suffix(".net")
        done = self.run("net", str(scene), "-o", str(folder), "--json")
        if done.returncode == 1:
            raise RefusedError("no ideal drape")
        if done.returncode != 0:
            sys.stderr.write(done.stderr)
            raise RefusedError("net")
        printed = json.loads(done.stdout)
        with (folder / "nodes.csv").open(newline="") as file:
            nodes = {
                (int(row["i"]), int(row["j"])): tuple(float(row[c]) for c in "xyz")
                for row in csv.DictReader(file)
            }
        divisions = [
            (count - 1) // (number - 1)
            for count, number in zip(printed["nodes"], array.grippers, strict=True)
        ]
        grippers = [
            (i * divisions[0], j * divisions[1])
            for i in range(array.grippers[0])
            for j in range(array.grippers[1])
        ]
        places = [nodes[node] for node in grippers]
        heights = [place[2] for place in nodes.values()]
        return Drape(
            shear_deg=printed["max_shear_deg"],
            tilt_deg=max(tilt(nodes, node) for node in grippers),
            middle=tuple(sum(p[n] for p in places) / len(places) for n in range(2)),  # type: ignore[arg-type]
            bottom=min(heights),
            top=max(heights),
        )


def tilt(nodes: dict[tuple[int, int], tuple[float, ...]], node: tuple[int, int]) -> float:
    """Angle of the net at a node to the plane (degrees), from its neighbours."""
    along = []
    for step in ((1, 0), (0, 1)):
        ends = [
            nodes.get((node[0] + sign * step[0], node[1] + sign * step[1]), nodes[node])
            for sign in (-1, 1)
        ]
        along.append([b - a for a, b in zip(*ends, strict=True)])
    (a, b, c), (p, q, r) = along
    normal = (b * r - c * q, c * p - a * r, a * q - b * p)
    return math.degrees(math.atan2(math.hypot(*normal[:2]), normal[2]))


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


def seed_of(rng: random.Random, ply: Array) -> tuple[str, tuple[float, float]]:
    """The fabric point that is laid first, as TOML and from the ply's middle (m)."""
    if rng.random() < 0.6:
        return '"middle"', (0.0, 0.0)
    # on a node of the net, which divides every cell
    quarters = [rng.randint(0, 4 * (number - 1)) for number in ply.grippers]
    place = [side * n / 4.0 for side, n in zip(ply.cell, quarters, strict=True)]
    away = [p - extent / 2.0 for p, extent in zip(place, ply.extent, strict=True)]
    return "[" + ", ".join(length(p) for p in place) + "]", (away[0], away[1])


def target(rng: random.Random, ply: Array, mold: Mold) -> dict[str, str]:
    """Where the ply shall end: its middle about where the mold wants it."""
    seed, (u, v) = seed_of(rng, ply)
    heading = rng.uniform(-90.0, 90.0)
    along, across = math.radians(heading), math.radians(heading + 90.0 - mold.shear_deg)
    x = mold.middle[0] + u * math.cos(along) + v * math.cos(across)
    y = mold.middle[1] + u * math.sin(along) + v * math.sin(across)
    keys = {
        "seed": seed,
        "origin": f"[{length(x)}, {length(y)}]",
        "direction": angle(heading),
    }
    if mold.shear_deg:
        keys["shear"] = angle(mold.shear_deg)
    if rng.random() < 0.15:
        keys["generators"] = '"least-shear"'
    return keys


def corners(ply: Array, spacing: tuple[float, float], heading: float) -> list[list[float]]:
    """Half sides of the rectangle of grippers as vectors (m)."""
    half = [share * extent / 2.0 for share, extent in zip(spacing, ply.extent, strict=True)]
    c, s = math.cos(math.radians(heading)), math.sin(math.radians(heading))
    return [[half[0] * c, half[0] * s], [-half[1] * s, half[1] * c]]


def ground(
    mold: Mold,
    ply: Array,
    spacing: tuple[float, float],
    heading: float,
    middle: tuple[float, float],
) -> float:
    """Highest point of the mold below the rectangle of grippers; nan if there is none (m)."""
    (a, b), (c, d) = corners(ply, spacing, heading)
    shares = [n / 10.0 for n in range(-10, 11)]
    heights = [
        mold.height(middle[0] + s * a + t * c, middle[1] + s * b + t * d)
        for s in shares
        for t in shares
    ]
    return max((h for h in heights if not math.isnan(h)), default=math.nan)


def start(
    rng: random.Random, ply: Array, mold: Mold, drape: Drape, heading: float
) -> tuple[str, dict[str, str]]:
    """Where the grippers pick the ply up: above the target, or beside it and turned."""
    spacing = (rng.uniform(*SPACING), rng.uniform(*SPACING))
    cell = max(ply.cell)
    clear = SAG * math.sqrt(1.0 - min(spacing))
    keys = {"spacing": "[" + ", ".join(map(length, map(float.__mul__, spacing, ply.cell))) + "]"}
    if rng.random() < 0.6:
        top = max(drape.top, ground(mold, ply, spacing, heading, drape.middle))
        lift = rng.uniform(max(PICK_UP[0], clear), PICK_UP[1]) * cell
        return "above", {**keys, "height": length(top + lift), "origin": '"centred"'}

    for _ in range(100):
        turned = heading + rng.uniform(-90.0, 90.0)
        away = min(
            rng.uniform(0.5, 1.0) * 2.0 * ply.reach + rng.uniform(0.0, 4.0) * cell, ply.scale
        )
        towards = rng.uniform(0.0, 2.0 * math.pi)
        x = drape.middle[0] + away * math.cos(towards)
        y = drape.middle[1] + away * math.sin(towards)
        below = ground(mold, ply, spacing, turned, (x, y))
        # from as low as the drape's lowest point: a table beside the mold
        lowest = drape.bottom if math.isnan(below) else max(drape.bottom, below)
        highest = drape.top + PICK_UP[1] * cell
        if lowest + clear * cell > highest:
            continue  # a wall rises there
        height = rng.uniform(lowest + clear * cell, highest)
        (a, b), (c, d) = corners(ply, spacing, turned)
        return "beside", {
            **keys,
            "height": length(height),
            "origin": f"[{length(x - a - c)}, {length(y - b - d)}]",
            "direction": angle(turned),
        }
    raise RefusedError("no room beside")


def material(rng: random.Random, drape: Drape) -> str:
    """The prepreg of the paper; a lighter ply now and then, where it hardly shears."""
    names = [*LIGHT, "krogh2018"]
    name = rng.choices(names, [*LIGHT.values(), 1.0 - sum(LIGHT.values())])[0]
    return name if drape.shear_deg <= LIGHT_SHEAR_DEG else "krogh2018"


def table(name: str, keys: dict[str, str]) -> str:
    """A table of the scene."""
    return f"\n[{name}]\n" + "".join(f"{key} = {value}\n" for key, value in keys.items())


def attempt(
    rng: random.Random, name: str, family: str, sizes: list[str], scale: float, program: Plydrape
) -> Scene:
    """One draw; refused if it is no fair task."""
    size, ply = array(rng, sizes, scale)
    mold = FAMILIES[family](Draw(rng, ply))
    aim = target(rng, ply, mold)
    title = f'title = "Unseen {name}: {family}, {ply.grippers[0]} x {ply.grippers[1]} grippers"\n'
    mold_keys = {key: value.replace("{name}", name) for key, value in mold.keys.items()}

    def write(folder: str, grippers: dict[str, str], of: str) -> tuple[Path, str]:
        keys = {
            "grippers": f"[{ply.grippers[0]}, {ply.grippers[1]}]",
            "cell": f"[{length(ply.cell[0])}, {length(ply.cell[1])}]",
            "material": f'"{of}"',
        }
        text = title + table("ply", keys) + table("mold", mold_keys)
        if grippers:
            text += table("grippers", grippers)
        text += table("target", aim)
        path = Path(folder) / f"{name}.toml"
        path.write_text(text)
        return path, text

    with tempfile.TemporaryDirectory() as folder:
        for ending, data in mold.files.items():
            (Path(folder) / f"{name}.{ending}").write_bytes(data)
        path, _ = write(folder, {}, "krogh2018")
        drape = program.drape(path, ply)
        if drape.shear_deg > MAX_SHEAR_DEG:
            raise RefusedError("shear")
        if drape.tilt_deg > MAX_TILT_DEG:
            raise RefusedError("tilt")
        of = material(rng, drape)
        where, grippers = start(rng, ply, mold, drape, float(aim["direction"].split()[0][1:]))
        path, text = write(folder, grippers, of)
        program.check(path)
    row = {
        "scene": name,
        "family": family,
        "size": size,
        "grippers": f"{ply.grippers[0]}x{ply.grippers[1]}",
        "cell (mm)": "x".join(f"{1e3 * side:.6g}" for side in ply.cell),
        "material": of,
        "start": where,
        "shear (deg)": f"{drape.shear_deg:.2f}",
        "tilt (deg)": f"{drape.tilt_deg:.2f}",
    }
    return Scene(text, mold.files, row)


def family_of(seed: int, index: int) -> str:
    """The family of a scene: all of them in every round, each round in an order of its own."""
    names = list(FAMILIES)
    random.Random(f"{seed} round {index // len(names)}").shuffle(names)
    return names[index % len(names)]


def main() -> None:
    """Writes the scenes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition(":")[0])
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--sizes", default=",".join(SIZES), help="size classes to draw from")
    parser.add_argument("--scale", type=float, default=1.0, help="of all lengths")
    parser.add_argument("--plydrape", type=Path, default=ROOT / "target" / "release" / "plydrape")
    options = parser.parse_args()
    program, refused = Plydrape(options.plydrape.resolve()), Counter[str]()
    options.output.mkdir(parents=True, exist_ok=True)
    rows = []
    for index in range(options.count):
        family, name = family_of(options.seed, index), f"{index:03d}"
        rng = random.Random(f"{options.seed} scene {index}")
        while True:
            try:
                scene = attempt(rng, name, family, options.sizes.split(","), options.scale, program)
                break
            except RefusedError as reason:
                refused[f"{family}: {reason}"] += 1
        (options.output / f"{name}.toml").write_text(scene.text)
        for ending, data in scene.files.items():
            (options.output / f"{name}.{ending}").write_bytes(data)
        rows.append(scene.row)
    with (options.output / "scenes.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    reasons = ", ".join(f"{reason} {count}" for reason, count in sorted(refused.items()))
    print(f"{len(rows)} scenes, {refused.total()} drawn again: {reasons}", file=sys.stderr)


if __name__ == "__main__":
    main()
