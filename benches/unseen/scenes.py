"""Random scenes that no example shows, to prove the planner on.

Writes N scenes (000.toml, 001.toml, ...) and scenes.csv, a table of them. The same seed gives the
same bytes, and a scene does not depend on how many are written. Families of molds take turns. A
draw that nobody can lay is drawn again, which is counted by reason: the ideal drape of
`plydrape net` has to exist, to shear by at most 30 degrees and to tilt no gripper by more than 30
degrees, and `plydrape check` has to read the scene and to warn of no edge that touches the mold
before its cup and stays there, with the ply of the usual cell. No planner is asked.
"""

from __future__ import annotations

import csv
import random
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from blanks import blank
from cells import Cell, cells
from families import FAMILIES
from ideal import Plydrape, RefusedError
from molds import Draw, Mold
from pickup import pick_up
from plies import array
from targets import target
from units import table


@dataclass(frozen=True)
class Task:
    """What is drawn from."""

    seed: int
    sizes: list[str]
    """Size classes of the arrays."""
    world: str = "usual"
    """The cell: "usual", with real plies, or "ideal", with the paper's ply in the same scenes."""


@dataclass(frozen=True)
class Scene:
    """A scene as a file, its mold, and its row of the table."""

    text: str
    mold: Mold
    row: dict[str, str]


def family_of(seed: int, index: int) -> str:
    """The family of a scene: all of them in every round, each round in an order of its own."""
    names = list(FAMILIES)
    turn = index // len(names)
    random.Random(f"{seed} round {turn}").shuffle(names)
    return names[index % len(names)]


def scene(task: Task, index: int, program: Plydrape, refused: Counter[str]) -> Scene:
    """The scene of a number; counts what was drawn again."""
    rng, family = random.Random(f"{task.seed} scene {index}"), family_of(task.seed, index)
    while True:
        try:
            return draw(rng, f"{index:03d}", family, task, program)
        except RefusedError as reason:  # noqa: PERF203
            refused[f"{family}: {reason}"] += 1


def draw(rng: random.Random, name: str, family: str, task: Task, program: Plydrape) -> Scene:
    """One draw; refused if nobody can lay it."""
    size, ply = array(rng, task.sizes)
    worlds = cells(rng)
    world = worlds[task.world]
    fabric = blank(rng, ply, world.overhang)
    mold = FAMILIES[family](Draw(rng, ply, fabric.edge))
    heading, aim = target(rng, ply, fabric, mold.middle, mold.shear_deg)
    tables = {
        "ply": fabric.keys,
        "mold": {key: value.replace("{name}", name) for key, value in mold.keys.items()},
        "target": aim,
        "contact": {"friction": world.friction},
    }
    title = (
        f"Unseen {name}: {family}, {fabric.name}, {ply.grippers[0]} × {ply.grippers[1]} grippers"
    )

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.toml"
        path.with_suffix(".stl").write_bytes(mold.mesh)
        path.write_text(text(title, world, tables), encoding="utf-8")
        drape = program.drape(path, None if fabric.first else ply, mold.height)
        start = pick_up(rng, ply, mold, drape, heading, above=fabric.first is not None)
        # both worlds have the scenes that can be laid in the usual one
        for judged in (worlds[each] for each in dict.fromkeys(("usual", task.world))):
            tables["grippers"] = start.taut(judged.material).keys(ply)
            path.write_text(text(title, judged, tables), encoding="utf-8")
            program.check(path, may_fold=judged.preset != "usual")
    row = {
        "scene": name,
        "family": family,
        "size": size,
        "ply": fabric.name,
        "grippers": f"{ply.grippers[0]} × {ply.grippers[1]}",
        "cell (mm)": " × ".join(f"{1e3 * side:.6g}" for side in ply.cell),
        "material": world.material,
        "friction": world.friction.strip('"'),
        "start": start.name,
        "shear (deg)": f"{drape.shear_deg:.2f}",
        "tilt (deg)": f"{drape.tilt_deg:.2f}",
    }
    return Scene(text(title, world, tables), mold, row)


def text(title: str, world: Cell, tables: dict[str, dict[str, str]]) -> str:
    """A scene in a world, of its other tables."""
    ply, others = tables["ply"], {name: keys for name, keys in tables.items() if name != "ply"}
    material = {"ply.material": world.keys} if world.keys else {}
    named = {} if world.keys else {"material": f'"{world.material}"'}
    cell = {"cell": {"preset": f'"{world.preset}"'}, "ply": {**ply, **named}}
    scene = {**cell, **others, **material}
    return f'title = "{title}"\n' + "".join(table(*each) for each in scene.items())


def write(task: Task, count: int, folder: Path, program: Plydrape) -> Counter[str]:
    """Writes scenes and their table; what was drawn again, by family and reason."""
    folder.mkdir(parents=True, exist_ok=True)
    refused, rows = Counter[str](), []
    for index in range(count):
        made = scene(task, index, program, refused)
        path = folder / f"{index:03d}.toml"
        path.write_text(made.text, encoding="utf-8")
        if made.mold.mesh:
            path.with_suffix(".stl").write_bytes(made.mold.mesh)
        rows.append(made.row)
    with (folder / "scenes.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    return refused


def drawn_again(count: int, refused: Counter[str]) -> str:
    """How many scenes were drawn, and how many drawn again for which reason, in a sentence."""
    reasons = ", ".join(f"{reason} ({number})" for reason, number in sorted(refused.items()))
    return f"{count} scenes; {refused.total()} drawn again{': ' if reasons else ''}{reasons}."
