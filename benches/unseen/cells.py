"""The world of random scenes: the cell, the material of the ply, and how it sticks."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

SHIPPED = ("dry_carbon", "prepreg_warm", "prepreg_cold")
"""Materials of the size of real plies; a quarter of the scenes has each, a quarter one between."""

BETWEEN = {
    "mass": (0.2, 0.4, "kg/m^2"),
    "bending_rigidity_warp": (1e-5, 9e-5, "N m"),
    "bending_rigidity_weft": (1e-5, 9e-5, "N m"),
    "shear_curve": (15.0, 80.0, "N/m"),
}
"""Keys of a material between those, with least and largest value and unit; logarithms are even."""

WORLDS = ("usual", "ideal")
"""Real plies in a usual cell, and the paper's ply in an ideal one."""

BENDING = {"dry_carbon": 0.0201, "prepreg_warm": 0.0187, "prepreg_cold": 0.0308}
"""Bending lengths of the shipped plies (m), of the limper direction."""

EDGE = 0.5
"""Fabric that hangs over on a mold that sticks, in bending lengths. A longer edge touches the mold
before its cup does, and a fold stays beside it whatever the motion."""

OVERHANG = 0.060
"""Most fabric that hangs over on a mold that does not (m)."""

GRAVITY = 9.80665
"""In m/s²."""

FRICTIONS = ('"stick"', '"stick"', "0.3", "0.6")
"""How plies stick: a half does, a quarter each slides by a coefficient of friction."""


@dataclass(frozen=True)
class Cell:
    """What a ply is made of and lies on."""

    material: str
    """Name of the material."""
    keys: dict[str, str]
    """Its table, where it has no shipped name."""
    preset: str
    """Which cell holds the ply."""
    friction: str
    """As in `[contact]`."""
    overhang: float
    """Most fabric beyond the outermost cups (m)."""


def cells(rng: random.Random) -> dict[str, Cell]:
    """A random one by world: a real ply in a usual cell, the paper's ply in an ideal one."""
    name = rng.choice((*SHIPPED, "between"))
    drawn = {
        key: math.exp(rng.uniform(math.log(least), math.log(most)))
        for key, (least, most, _) in BETWEEN.items()
    }
    friction = rng.choice(FRICTIONS)
    rigidity = min(drawn["bending_rigidity_warp"], drawn["bending_rigidity_weft"])
    between = (rigidity / (GRAVITY * drawn["mass"])) ** (1.0 / 3.0)
    sticks = friction == '"stick"'
    overhang = EDGE * BENDING.get(name, between) if sticks else OVERHANG
    keys = {
        "name": '"between"',
        "source": '"drawn between the shipped plies"',
        "tension": '"1e6 N/m"',
        **{key: f'"{value:.4g} {BETWEEN[key][2]}"' for key, value in drawn.items()},
    }
    usual = Cell(name, keys if name == "between" else {}, "usual", friction, overhang)
    return {"usual": usual, "ideal": Cell("krogh2018", {}, "ideal", friction, overhang)}
