"""Studies: the shipped one with few samples, of a small scene; keys, laws and ranges changed."""

from __future__ import annotations

from random import Random
from typing import Any

import tomllib

from . import case, scene, toml, tree, values
from .case import Files, Kind

NAME = "study.toml"

ERRORS = "errors.gripper.position.bound"
# What may vary, in sound ways.
VARIED: dict[str, list[Any]] = {
    "ply.material.flexural_rigidity": [{"relative": [0.8, 1.2]}, {"values": [8e-6, 9e-6]}],
    "ply.material.mass": [{"relative": [0.95, 1.05]}, {"from": "0.3 kg/m", "to": "0.32 kg/m"}],
    "grippers.height": [{"from": "60 mm", "to": "90 mm"}, {"mean": "75 mm", "deviation": "1 mm"}],
    "target.shear": [{"values": ["5 deg", "10 deg"]}],
    ERRORS: [{"from": "0.1 mm", "to": "1 mm"}, {"values": ["0.02 mm"]}],
}


def files(rng: Random) -> Files:
    """A study of two scenarios of the paper's example."""
    sampling = rng.choice(("latin-hypercube", "sobol", "grid", "latin-hypercube"))
    table: dict[str, Any] = {
        "title": "A study",
        "scene": scene.NAME,
        "command": rng.choice(("simulate", "simulate", "simulate", "plan")),
        "sampling": sampling,
        "seed": 1,
    }
    if sampling != "grid":
        table["samples"] = 2
    # a plan with errors is judged in many cells, which is sound, and would take long
    known = [key for key in VARIED if table["command"] != "plan" or key != ERRORS]
    keys = rng.sample(sorted(known), k=rng.randint(1, 3))
    table["vary"] = {key: rng.choice(VARIED[key]) for key in keys}
    sound = (scene.ROOT / "examples" / "01_flat_sheared_mold" / "scene.toml").read_text()
    return {NAME: toml.text(table).encode(), scene.NAME: scene.short(sound).encode()}


def change(rng: Random, files: Files) -> str:
    """Changes a value, a type or a key of the study, or adds a varied key."""
    content = files[NAME]
    if isinstance(content, case.Odd):
        return "no study to change"
    try:
        table = tomllib.loads(content.decode())
    except (ValueError, RecursionError):
        return "no study to change"
    if rng.random() < 0.2 and isinstance(table.get("vary"), dict):
        key = rng.choice(
            (*VARIED, "grippers.nothing", "ply", "title", "mold.radius", values.text(rng))
        )
        law = {
            rng.choice(("from", "to", "values", "relative", "mean", "deviation")): values.text(rng)
        }
        table["vary"][key] = rng.choice((law, values.number(rng), *VARIED.get(key, [])))
        what = f"vary {key!r} = {table['vary'][key]!r}"
    else:
        what = tree.change(rng, table)
    samples = table.get("samples")
    if isinstance(samples, int) and 5 < samples <= 1_000_000:
        table["samples"] = 5  # sound, and would take long: a drape of the sheet takes a second
    if table.get("command") == "plan" and isinstance(table.get("vary"), dict):
        table["vary"].pop(ERRORS, None)
    files[NAME] = toml.text(table).encode()
    return what


KIND = Kind(
    files=files,
    mutations=((10, change), (2, scene.change), (2, case.damage(NAME)), (0.2, case.odd_file)),
    commands=((1, ("study", NAME, "-o", "out", "--workers", "1")),),
)
