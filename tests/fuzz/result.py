"""Results: written by the command, changed, and sealed again, so that their contents are judged.

The check sum of a result file, its last value, is the CRC-32 of all that precedes it.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Callable
from random import Random
from typing import Any

from . import case, tree
from .case import Files, Kind

NAME = "result.json"
KEY = '"checksum":'


def sealed(text: str) -> str:
    """The text with the check sum that belongs to it; as it is where it has no place for one."""
    start = text.rfind(KEY + '"')
    if start < 0:
        return text
    head = text[: start + len(KEY)]
    crc = zlib.crc32(head.encode(errors="replace"))
    return f'{head}"crc32:{crc:08x}"}}\n'


def json_text(result: Any) -> str:
    """JSON as plydrape writes it."""
    return sealed(json.dumps(result, separators=(",", ":"), ensure_ascii=False))


def opened(files: Files) -> Any:
    """The result as plain values, if it can still be read."""
    content = files[NAME]
    if isinstance(content, case.Odd):
        return None
    try:
        return json.loads(content)
    except (ValueError, RecursionError):
        return None


def change(rng: Random, files: Files) -> str:
    """Changes a value anywhere in the result, most often a number, and seals it."""
    result = opened(files)
    if result is None:
        return "no result to change"
    what = (tree.change if rng.random() < 0.15 else tree.change_number)(rng, result)
    files[NAME] = json_text(result).encode(errors="replace")
    return what


def everywhere(rng: Random, files: Files) -> str:
    """Changes a key wherever it occurs, and seals the result."""
    result = opened(files)
    if result is None:
        return "no result to change"
    chosen = tree.choose(rng, result)
    if chosen is None:
        return "nothing to change"
    other = tree.like(rng, tree.get(result, chosen))
    key = next(part for part in reversed(chosen) if isinstance(part, str))
    tree.put_everywhere(result, key, other)
    files[NAME] = json_text(result).encode(errors="replace")
    return f"every {key} = {other!r:.60}"


def damage(rng: Random, files: Files) -> str:
    """Damages the bytes, and seals the result if it still has a place for a check sum."""
    what = case.damage(NAME)(rng, files)
    content = files[NAME]
    if isinstance(content, bytes) and rng.random() < 0.7:
        try:
            files[NAME] = sealed(content.decode()).encode(errors="replace")
        except ValueError:
            return what
    return what


def kind(written: Callable[[], list[bytes]]) -> Kind:
    """The kind, with results that the command wrote."""
    return Kind(
        files=lambda rng: {NAME: rng.choice(written())},
        mutations=((12, change), (2, everywhere), (1, damage), (0.1, case.odd_file)),
        commands=(
            (20, ("report", NAME, "-o", "out")),
            *(
                (6, ("export", NAME, "--to", to, "--even-if-rejected", "-o", "out"))
                for to in ("csv", "inp", "ros2", "vtk")
            ),
        ),
    )
