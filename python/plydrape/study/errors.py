"""Errors of a real cell: what the scene's [errors] give each scenario.

Scenario n is draped in the cell of draw n. The draws are those of `plydrape.Scene.draw`: this
file names their numbers and draws none. Waves of the mold are no column: their directions and
phases say nothing about a measure.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

# Terms of [errors]: names of their columns, the unit of these, and where a draw has the numbers.
TERMS: dict[str, tuple[tuple[str, ...], str, tuple[str, ...]]] = {
    "frame.position": (("x", "y", "z"), "m", ("frame", "shift")),
    "frame.angle": (("x", "y", "z"), "rad", ("frame", "turn")),
    "gripper.position": (("rms",), "m", ("grippers", "position")),
    "gripper.stroke": (("rms",), "", ("grippers", "stroke")),
    "pick_up.offset": (("u", "v"), "m", ("pick_up", "offset")),
    "pick_up.yaw": ((), "rad", ("pick_up", "yaw")),
    "material.areal_mass": ((), "", ("material", "areal_mass")),
    "material.bending": ((), "", ("material", "bending")),
    "material.shear": ((), "", ("material", "shear")),
    "material.length": ((), "", ("material", "length")),
    "mold.offset": (("x", "y", "z"), "m", ("mold", "motion", "shift")),
    "mold.tilt": (("x", "y"), "rad", ("mold", "motion", "turn")),
}


def terms(tables: Mapping[str, Any], varied: Iterable[str]) -> tuple[str, ...]:
    """The terms that a scene has, or gets from varied keys.

    Examples
    --------
    >>> terms({"errors": {"pick_up": {"yaw": {"bound": 0.01}}}}, ["errors.frame.angle.bound"])
    ('frame.angle', 'pick_up.yaw')

    """
    table = tables.get("errors", {})
    keys = tuple(varied)

    def there(term: str) -> bool:
        part, name = term.split(".")
        return name in table.get(part, {}) or any(k.startswith(f"errors.{term}.") for k in keys)

    return tuple(filter(there, TERMS))


def with_cell(tables: Mapping[str, Any], errors: Mapping[str, Any] | None) -> Mapping[str, Any]:
    """The tables of a scene with the terms that its cell gives written out.

    Parameters
    ----------
    tables
        The tables of the scene.
    errors
        `plydrape.Scene.errors` of these tables; None of a cell without errors.

    """
    if errors is None:
        return tables
    table: dict[str, Any] = {key: errors[key] for key in ("seed", "samples", "share")}
    for term in (*TERMS, "mold.waviness"):
        part, name = term.split(".")
        ((law, value),) = errors[part][name].items()
        if value != (1.0 if law == "factor" else 0.0):
            table.setdefault(part, {})[name] = {law: value}
    if "waviness" in table.get("mold", {}):
        table["mold"]["wavelength"] = errors["mold"]["wavelength"]
    return {**tables, "errors": table}


def names(chosen: Iterable[str]) -> list[str]:
    """Columns of terms.

    Examples
    --------
    >>> names(["pick_up.offset", "pick_up.yaw"])
    ['errors.pick_up.offset.u', 'errors.pick_up.offset.v', 'errors.pick_up.yaw']

    """
    return [
        f"errors.{term}.{part}" if part else f"errors.{term}"
        for term in chosen
        for part in TERMS[term][0] or ("",)
    ]


def unit(column: str) -> str:
    """The unit of a column of a term; empty of another column.

    Examples
    --------
    >>> unit("errors.pick_up.offset.u"), unit("errors.material.length"), unit("accepted")
    ('m', '', '')

    """
    return next((unit for term, (_, unit, _) in TERMS.items() if column in names([term])), "")


def columns(chosen: Iterable[str], draw: Mapping[str, Any]) -> dict[str, float]:
    """The numbers of a draw in the columns of terms: of the grippers the root mean square distance.

    Examples
    --------
    >>> columns(["pick_up.offset"], {"pick_up": {"offset": [0.001, -0.002]}})
    {'errors.pick_up.offset.u': 0.001, 'errors.pick_up.offset.v': -0.002}

    """
    row: dict[str, float] = {}
    for term in chosen:
        parts, _, path = TERMS[term]
        if path[0] == "grippers":
            each = np.array([gripper[path[1]] for gripper in draw["grippers"]])
            numbers = [float(np.sqrt(np.mean(np.sum(each**2, axis=1))))]
        else:
            value: Any = draw
            for key in path:
                value = value[key]
            numbers = list(value)[: len(parts)] if parts else [float(value)]
        row |= dict(zip(names([term]), numbers, strict=True))
    return row
