"""Scenes: the examples and the template; keys, values, units changed, and added by the schema."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from random import Random
from typing import Any
from urllib.parse import unquote

import tomllib

from . import case, toml, tree, values
from .case import Files, Kind

ROOT = Path(__file__).resolve().parents[2]
NAME = "scene.toml"

# Few steps and drapes, so that a case takes a moment.
MOTION, PLAN = {"steps": 4}, {"steps": 6, "evaluations": 2}
# Steps of a plan: also one that is interrupted ends with a drape along all of them.
MOST_PLANNED = 100


def short(text: str) -> str:
    """A sound scene with few steps."""
    table = tomllib.loads(text)
    if table.get("motion", {}).get("kind") == "straight":
        table["motion"] |= MOTION
    if "mold" in table:
        table["plan"] = table.get("plan", {}) | PLAN
    return toml.text(table)


@cache
def examples() -> list[Files]:
    """Shipped scenes with the files that they name, and the template."""
    found: list[Files] = []
    shipped = [*ROOT.glob("examples/*/scene.toml"), *ROOT.glob("crates/*/src/scene/template.toml")]
    for place in sorted(shipped):
        text = place.read_text()
        mold = tomllib.loads(text).get("mold", {}).get("file")
        if mold and not (Path(mold).name == mold and (place.parent / mold).is_file()):
            continue  # a mold that is not part of the project
        files: Files = {NAME: short(text).encode()}
        if mold:
            files[mold] = (place.parent / mold).read_bytes()
        found.append(files)
    return found


def files(rng: Random) -> Files:
    """One of them."""
    return dict(rng.choice(examples()))


def table(files: Files) -> dict[str, Any] | None:
    """The scene as plain values, if it can still be read."""
    content = files[NAME]
    if isinstance(content, case.Odd):
        return None
    try:
        return tomllib.loads(content.decode())
    except (ValueError, RecursionError):
        return None


def change(rng: Random, files: Files) -> str:
    """Changes a value, a unit, a type or a key; half the time a number."""
    scene = table(files)
    if scene is None:
        return "no scene to change"
    what = (tree.change if rng.random() < 0.5 else tree.change_number)(rng, scene)
    plan = scene.get("plan")
    steps = plan.get("steps") if isinstance(plan, dict) else None
    if isinstance(steps, int) and MOST_PLANNED < steps <= 10_000:
        scene["plan"]["steps"] = MOST_PLANNED  # sound, and would take long
    files[NAME] = toml.text(scene).encode()
    return what


def add(rng: Random, files: Files) -> str:
    """Puts a section, or a key into one, by the schema of scenes."""
    scene = table(files)
    if scene is None:
        return "no scene to add to"
    root = schema()
    section = rng.choice([key for key in root["properties"] if key != "title"])
    node = resolved(root["properties"][section])
    here = scene.get(section)
    keys = node.get("properties", {})
    if isinstance(here, dict) and keys and rng.random() < 0.8:
        key = rng.choice(list(keys))
        here[key] = sample(rng, keys[key])
        what = f"{section}.{key} = {here[key]!r:.60}"
    else:
        scene[section] = sample(rng, node)
        what = f"[{section}] = {scene[section]!r:.60}"
    files[NAME] = toml.text(scene).encode()
    return what


@cache
def schema() -> Any:
    """The JSON Schema of scenes."""
    return json.loads((ROOT / "docs" / "scene.schema.json").read_text())


def resolved(node: Any) -> Any:
    """What a reference stands for; of several possible forms the first that is a table."""
    while True:
        if "$ref" in node:
            node = schema()["$defs"][unquote(node["$ref"].rsplit("/", 1)[-1])]
        elif forms := node.get("anyOf") or node.get("oneOf"):
            node = next((f for f in map(resolved, forms) if "properties" in f), {"type": "null"})
        else:
            return node


def sample(rng: Random, node: Any, depth: int = 0) -> Any:
    """A value that the schema allows, with sizes of everyday."""
    if "$ref" in node:
        return sample(rng, schema()["$defs"][unquote(node["$ref"].rsplit("/", 1)[-1])], depth)
    if "const" in node:
        return node["const"]
    if "enum" in node:
        return rng.choice(node["enum"])
    if forms := node.get("anyOf") or node.get("oneOf"):
        return sample(rng, rng.choice(forms), depth)
    kinds = node.get("type", "number")
    kind = rng.choice(kinds) if isinstance(kinds, list) else kinds
    match kind:
        case "object":
            keys, needed = node.get("properties", {}), node.get("required", [])
            taken = [k for k in keys if k in needed or rng.random() < 0.4]
            return {key: sample(rng, keys[key], depth + 1) for key in taken}
        case "array":
            least, most = node.get("minItems", 1), min(node.get("maxItems", 4), 4)
            count = rng.randint(least, max(least, most))
            return [sample(rng, node.get("items", {}), depth + 1) for _ in range(count)]
        case "boolean":
            return rng.random() < 0.5
        case "integer":
            return rng.choice((0, 1, 2, 3, 4, 8))
        case "string":
            choices = [
                *node.get("examples", []),
                "100 mm",
                "10 deg",
                "0.1*x^2 - 0.2*y^2 + 0.01*x*y",
            ]
            return rng.choice(choices) if rng.random() < 0.9 else values.text(rng)
        case _:
            return rng.choice((0.0, 0.05, 0.1, 0.3, 0.5, 1.0, 2.0, -0.1))


def large(rng: Random, files: Files) -> str:
    """Asks for much: grippers, steps, a long formula, a fine mesh."""
    scene = table(files)
    if scene is None:
        return "no scene to enlarge"
    size = rng.choice((100, 1000, 20_000))
    sum_of = "+".join(["x^2"] * size)
    what = rng.choice(
        (
            ("motion", {"kind": "straight", "steps": rng.choice((1000, 1_000_000))}),
            ("mold", {"kind": "formula", "z": f"0.01*({sum_of})", "x": [-1, 1], "y": [-1, 1]}),
            (
                "mold",
                {"kind": "formula", "z": "(" * size + "0" + ")" * size, "x": [-1, 1], "y": [-1, 1]},
            ),
            ("mold", {"kind": "formula", "z": "-" * size + "x", "x": [-1, 1], "y": [-1, 1]}),
            ("mold", {"kind": "formula", "z": "x" + "^1" * size, "x": [-1, 1], "y": [-1, 1]}),
            ("target", {"mesh": rng.choice(("1 mm", "0.1 mm", 1e-9))}),
            ("ply", {"grippers": rng.choice(([60, 60], [500, 2], [2000, 2000], [2**40, 2]))}),
        )
    )
    section, keys = what
    here = scene.get(section)
    scene[section] = (here if isinstance(here, dict) and section != "mold" else {}) | keys
    files[NAME] = toml.text(scene).encode()
    return f"[{section}] {keys!r:.60}"


def places(rng: Random, files: Files) -> str:
    """Puts grippers by a table: in one point, in a line, very far away, one above the other."""
    scene = table(files)
    if scene is None:
        return "no scene to place"
    ply = scene.get("ply")
    size = ply.get("grippers") if isinstance(ply, dict) else None
    match size:
        case [int(nu), int(nv)] if 1 <= nu <= 9 and 1 <= nv <= 9:
            pass
        case _:
            nu, nv = 2, 2
    far, step = (
        rng.choice((0.0, 1.0, 1e9, 1e159, 1e200, 1e308)),
        rng.choice((0.0, 1e-9, 0.05, 0.098, 0.1)),
    )
    axes = rng.choice(((1, 1, 0), (1, 0, 0), (0, 0, 1), (1, 1, 1)))
    rows = [[[far + u * step * axes[0], v * step * axes[1], 0.05 + (u + v) * step * axes[2]]
             for u in range(nu)] for v in range(nv)]  # fmt: skip
    if rng.random() < 0.5:
        rng.choice(rng.choice(rows))[rng.randrange(3)] = values.number(rng)
    section = rng.choice(("grippers", "grippers", "target"))
    scene[section] = {"positions": rows}
    files[NAME] = toml.text(scene).encode()
    return f"{section}.positions from {far} by {step}"


DRAPE = ("simulate", NAME, "-o", "out")
COMMANDS = (
    (40, ("check", NAME)),
    (20, (*DRAPE, "-q")),
    (5, DRAPE),
    (5, (*DRAPE, "--json")),
    (8, ("net", NAME, "-o", "out")),
    (2, ("net", NAME, "-o", "out", "--json")),
    (6, ("plan", NAME, "--anyway", "-o", "out", "--threads", "1")),
    (
        2,
        ("plan", NAME, "--anyway", "-o", "out", "--threads", "1", "--method", "stepwise", "--json"),
    ),
)

KIND = Kind(
    files=files,
    mutations=(
        (10, change),
        (5, add),
        (1, places),
        (0.3, large),
        (3, case.damage(NAME)),
        (0.2, case.odd_file),
    ),
    commands=(*COMMANDS, (1, ("new", "mine"))),
)
