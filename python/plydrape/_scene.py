"""A scene as plain values, and with some of them changed."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from inspect import signature
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from plydrape import Mold, Scene


def to_dict(scene: Scene) -> dict[str, Any]:
    """Keyword arguments of a scene as values that JSON can carry."""
    tables = scene._tables()
    if "positions" in (motion := tables.get("motion") or {}):
        tables["motion"] = {name: np.asarray(values).tolist() for name, values in motion.items()}
    if (mold := tables.get("mold")) is not None and not isinstance(mold, dict):
        tables["mold"] = mesh(mold)
    return tables


def mesh(mold: Mold) -> dict[str, Any]:
    """A mold of triangles as lists."""
    if (made := mold.mesh()) is None:
        raise ValueError(
            f"the mold of the scene is a plydrape.Mold of kind {mold.kind!r}, which no table says: "
            "pickle the scene, or make it with mold=dict(kind=…)"
        )
    points, triangles = made
    return {"points": points.tolist(), "triangles": triangles.tolist()}


def replace(scene: Scene, **changes: Any) -> Scene:
    """The scene with other values."""
    from plydrape import Scene

    names = signature(Scene).parameters
    for name in changes:
        if name not in names:
            close = get_close_matches(name, names, 1)
            guess = f"did you mean {close[0]!r}? " if close else ""
            known = ", ".join(names)
            raise TypeError(f"a scene has no {name!r}; {guess}there are {known}")
    return Scene(**merged(scene._tables(), changes))


def merged(table: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """A table with changes in it: dicts go into dicts, None takes a key away."""
    out = dict(table)
    for key, value in changes.items():
        held = out.get(key)
        if value is None:
            out.pop(key, None)
        elif isinstance(value, Mapping) and isinstance(held, Mapping) and alike(held, value):
            out[key] = merged(held, value)
        else:
            out[key] = value
    return out


def alike(held: Mapping[str, Any], value: Mapping[str, Any]) -> bool:
    """Whether a change goes into a table: not where it is of another kind, or made of arrays."""
    arrays = {"positions", "points"}
    if arrays & {*held, *value} and not arrays & {*held} & {*value}:
        return False
    return "kind" not in value or value["kind"] == held.get("kind")
