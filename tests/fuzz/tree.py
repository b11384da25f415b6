"""Changes in values made of dicts and lists, as TOML and JSON files hold them."""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Iterator
from random import Random
from typing import Any

from . import values

Path = tuple[str | int, ...]


def get(tree: Any, path: Path) -> Any:
    """The value at a path."""
    for key in path:
        tree = tree[key]
    return tree


def put(tree: Any, path: Path, value: Any) -> None:
    """Replaces a value."""
    get(tree, path[:-1])[path[-1]] = value


def put_everywhere(tree: Any, key: str, value: Any) -> None:
    """Replaces the value of a key wherever it occurs."""
    for at in tree if isinstance(tree, dict) else range(len(tree)):
        if at == key:
            tree[at] = value
        elif isinstance(tree[at], (dict, list)):
            put_everywhere(tree[at], key, value)


def name(path: Path) -> str:
    """A path as people write it: a.b[3]."""
    return "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path).lstrip(".")


def choose(rng: Random, tree: Any) -> Path | None:
    """A place; all keys are as likely as each other, however long the lists in them are."""
    path: Path = ()
    while True:
        here = get(tree, path)
        keys: list[str | int] = []
        if isinstance(here, dict):
            keys = list(here)
        elif isinstance(here, list):
            keys = list(range(len(here)))
        if not keys or (path and rng.random() < 0.12):
            return path or None
        path = (*path, rng.choice(keys))


def change(rng: Random, tree: Any) -> str:
    """Changes one place, and says how."""
    path = choose(rng, tree)
    if path is None:
        return "nothing to change"
    value, parent = get(tree, path), get(tree, path[:-1])
    match rng.randrange(20):
        case 0:
            del parent[path[-1]]
            return f"{name(path)} is gone"
        case 1 if isinstance(path[-1], str):
            key = misspelt(rng, path[-1])
            parent[key] = parent.pop(path[-1])
            return f"{name(path)} is called {key!r}"
        case 2:
            other = of_another_type(rng, value)
        case 3 if (elsewhere := choose(rng, tree)) is not None:
            other = copy.deepcopy(get(tree, elsewhere))
        case _:
            other = like(rng, value)
    put(tree, path, other)
    return f"{name(path)} = {json.dumps(other, default=str)[:60]}"


def change_number(rng: Random, tree: Any) -> str:
    """Gives another size to a number, or to all in the same place of a list's items."""
    alike: dict[str, list[Path]] = {}
    for path in numbers(tree):
        alike.setdefault(name(tuple(key for key in path if isinstance(key, str))), []).append(path)
    if not alike:
        return "no number to change"
    # a section of many numbers is not much more likely than one of few
    sections: dict[str, list[str]] = {}
    for place in sorted(alike):
        sections.setdefault(place.split(".")[0], []).append(place)
    weights = [math.sqrt(len(places)) for places in sections.values()]
    place = rng.choice(rng.choices(list(sections.values()), weights)[0])
    paths = alike[place] if rng.random() < 0.25 else [rng.choice(alike[place])]
    value = like(rng, get(tree, paths[0]))
    if rng.random() < 0.5 and isinstance(value, float):
        value = float(rng.choice((0, -1, 1e-308, 1e-9, 1e9, 1e15, 1e200, 1e308)))
    for path in paths:
        put(tree, path, value)
    return f"{name(paths[0])} = {value!r}" + (f", and {len(paths) - 1} others" if paths[1:] else "")


def numbers(tree: Any, at: Path = ()) -> Iterator[Path]:
    """The places of all numbers, and of texts that begin with one."""
    if isinstance(tree, (dict, list)):
        for key in tree if isinstance(tree, dict) else range(len(tree)):
            yield from numbers(tree[key], (*at, key))
    elif (isinstance(tree, (int, float)) and not isinstance(tree, bool)) or (
        isinstance(tree, str) and tree[:1].lstrip("-").isdigit()
    ):
        yield at


def misspelt(rng: Random, key: str) -> str:
    """A key with a slip of the pen."""
    at = rng.randrange(len(key) + 1)
    return rng.choice(
        (key[:at] + key[at + 1 :], key[:at] + "x" + key[at:], key.upper(), key[::-1], "")
    )


def of_another_type(rng: Random, value: Any) -> Any:
    """A value that can hardly be meant."""
    number, text = values.number(rng), values.text(rng)
    return rng.choice(
        (number, text, True, False, [], {}, [value], [[number]], {"a": text}, [text] * 3)
    )


def like(rng: Random, value: Any) -> Any:
    """An awkward value of the same type."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        other = values.number(rng, value)
        near = rng.choice((0, 1, -1, 2, 3, 7, 100, 10_000, 1_000_000, value - 1, value + 1))
        return near if rng.random() < 0.7 else other
    if isinstance(value, float):
        return values.number(rng, value)
    if isinstance(value, str):
        return text_like(rng, value)
    if isinstance(value, list):
        return list_like(rng, value)
    if isinstance(value, dict):
        left = dict(value)
        for key in rng.sample(list(left), k=min(len(left), rng.choice((1, 1, 2)))):
            del left[key]
        return left
    return rng.choice((0, 1.5, "", [], {}))  # null of JSON


def text_like(rng: Random, value: str) -> str:
    """A number with its unit gets another number or another unit; a word gets another."""
    parts = value.split(" ", 1)
    try:
        size = float(parts[0])
    except ValueError:
        return values.text(rng)
    unit = parts[1] if len(parts) == 2 else ""
    if rng.random() < 0.15:
        unit = rng.choice(values.UNITS)
    return f"{values.number(rng, size)!r} {unit}" if rng.random() < 0.9 else values.text(rng)


def list_like(rng: Random, value: list[Any]) -> list[Any]:
    """The list with an item more, less, twice, in another order, or all alike."""
    other = copy.deepcopy(value)
    match rng.randrange(6):
        case 0:
            return other[: rng.randrange(len(other) + 1)]
        case 1 if other:
            return [*other, copy.deepcopy(other[-1])]
        case 2:
            rng.shuffle(other)
            return other
        case 3 if other:
            return [other[0]] * len(other)
        case 4 if other:
            return other * rng.choice((2, 3, 50))
        case _:
            other[len(other) // 2 :] = [like(rng, item) for item in other[len(other) // 2 :]]
            return other
