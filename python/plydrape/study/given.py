"""Single keys of a study, each refused with its value and what would be right."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

import plydrape

from .error import StudyError
from .keys import nearest
from .law import Input
from .scenario import Motion

# More scenarios than any machine here will drape; a slip of the pen is likelier.
MOST = 10_000_000


def one_of(table: Mapping[str, Any], key: str, known: tuple[str, ...], usual: str) -> str:
    """A word out of several.

    Raises:
        StudyError: it is another.
    """
    value = table.get(key, usual)
    if value not in known:
        quoted = [f'"{name}"' for name in known]
        raise StudyError(
            f"`{key}` = {value!r} is not known",
            help=f"it is one of {', '.join(quoted)}{nearest(str(value), known)}",
            key=key,
        )
    return str(value)


def whole(table: Mapping[str, Any], key: str, usual: int | None, least: int) -> int:
    """A whole number; `usual` is None where it has to be given.

    Raises:
        StudyError: it is absent, no whole number, or less than the least.
    """
    value = table.get(key, usual)
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value < 2**63:
        raise StudyError(
            f"`{key}` is missing" if value is None else f"`{key}` = {value!r} does not count",
            help=f"write a whole number of {least} or more, as in {key} = {max(least, 256)}",
            key=key,
        )
    return value


def scenarios(table: Mapping[str, Any], sampling: str, laws: tuple[Input, ...]) -> int:
    """Number of scenarios: as given, or of a grid as follows.

    Raises:
        StudyError: none is given, or too many are.
    """
    if sampling == "grid":
        if "samples" in table:
            raise StudyError(
                f"`samples` = {table['samples']!r} says nothing to a grid",
                help="remove it: a grid has every combination of its numbers",
                key="samples",
            )
        samples = math.prod(len(x.grid()) for x in laws)
    else:
        samples = whole(table, "samples", None, least=1)
    if samples > MOST:
        raise StudyError(
            f"{samples} scenarios are more than {MOST}", help="split the study", key="samples"
        )
    return samples


def motion(table: Mapping[str, Any], command: str, base: Path) -> Motion | None:
    """The motion of the plan that is followed, or None with other commands.

    Raises:
        StudyError: it is absent, or given with another command.
        ResultError: it is no result of this version.
    """
    given = table.get("plan")
    if command != "follow":
        if given is None:
            return None
        raise StudyError(
            f'`plan` = {given!r} goes with command = "follow" only, and this is {command!r}',
            help="remove it, or follow the plan",
            key="plan",
        )
    if not isinstance(given, str | os.PathLike):
        raise StudyError(
            "`plan` is missing: what is to be followed?",
            help='name a finished plan: plan = "scene.plan/result.json"',
            key="plan",
        )
    path = base / given
    if path.is_dir():
        path = path / "result.json"
    result = plydrape.Result.read(str(path))
    return Motion(np.array(result.times), np.array(result.positions))


def plain(value: Any) -> Any:
    """Plain JSON: lists for tuples and arrays, text for what is infinite."""
    if isinstance(value, Mapping):
        return {str(key): plain(inner) for key, inner in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, list | tuple):
        return [plain(inner) for inner in value]
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if isinstance(value, str | int | float | bool) or value is None:
        return value
    return str(value)
