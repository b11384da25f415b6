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


def cell(rng: random.Random, world: str) -> Cell:
    """A random one: "usual", or the paper's ply in an "ideal" cell. Both draw the same numbers."""
    name = rng.choice((*SHIPPED, "between"))
    keys = {
        "name": '"between"',
        "source": '"drawn between the shipped plies"',
        "tension": '"1e6 N/m"',
    }
    for key, (least, most, unit) in BETWEEN.items():
        value = math.exp(rng.uniform(math.log(least), math.log(most)))
        keys[key] = f'"{value:.4g} {unit}"'
    friction = rng.choice(FRICTIONS)
    if world == "ideal":
        return Cell("krogh2018", {}, "ideal", friction)
    return Cell(name, keys if name == "between" else {}, "usual", friction)
