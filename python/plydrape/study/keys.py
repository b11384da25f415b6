"""Numbers within the tables of a scene, each by its dotted path: `ply.cell.0`.

The tables are plain dicts and lists, as TOML has them. Nothing here changes a table; what is put
in goes into a copy of the tables on its way, and all others are shared.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Mapping
from inspect import signature
from typing import Any

# the package itself is still being loaded when it loads this
from plydrape import _plydrape

from .error import StudyError
from .labels import shown

Value = float | int | str | bool
Tables = Mapping[str, Any]

# The tables that a scene may have: its arguments in Python.
SCENE = tuple(
    name for name in signature(_plydrape.Scene).parameters if name not in ("title", "base")
)
# The numbers of a scene that are whole.
WHOLE = {
    "ply.grippers.0",
    "ply.grippers.1",
    "motion.steps",
    "plan.steps",
    "plan.evaluations",
    "plan.seed",
    "sheet.keep",
    "errors.seed",
    "errors.samples",
}
# What has no effect on a command, and why.
IDLE = {
    "simulate": (("plan",), "`simulate` reads nothing of [plan]"),
    "plan": (("motion",), "`plan` finds a motion of its own"),
    "follow": (
        (
            "plan",
            "motion",
            "grippers.spacing",
            "grippers.height",
            "grippers.origin",
            "grippers.middle",
            "grippers.direction",
            "grippers.positions",
            "grippers.parallel_to_mold",
        ),
        "`follow` takes start and motion from the plan",
    ),
}

QUANTITY = re.compile(
    r"\s*(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(?P<unit>[^\s\d,].*?)?\s*"
)
# Characters of a number with its unit: the time that the pattern takes grows with their square.
LONGEST = 1000


class Absent:
    """In place of a value that the scene does not give."""


ABSENT = Absent()


def quantity(value: object) -> tuple[float, str] | None:
    """Splits a number with its unit; None for what is neither a number nor such a text.

    Examples
    --------
    >>> quantity("98 mm"), quantity(0.5), quantity("path")
    ((98.0, 'mm'), (0.5, ''), None)

    """
    if isinstance(value, bool):
        return None
    if isinstance(value, int | float):
        try:
            return float(value), ""
        except OverflowError:
            return None
    if isinstance(value, str) and len(value) <= LONGEST and (found := QUANTITY.fullmatch(value)):
        return float(found["number"]), found["unit"] or ""
    return None


def look(tables: Tables, key: str) -> Any:
    """What the scene has at a path, or ABSENT where a table lacks its last key.

    Raises
    ------
    StudyError
        The path leads through something that is not there, with what is.

    Examples
    --------
    >>> look({"ply": {"cell": ["100 mm", 0.1]}}, "ply.cell.0")
    '100 mm'

    """
    parts = key.split(".")
    if parts[0] not in SCENE:
        raise StudyError(
            f"`{key}` is no number of a scene",
            help=f"a path begins with {', '.join(SCENE)}{nearest(parts[0], SCENE)}",
            key=key,
        )
    here: Any = tables
    for depth, part in enumerate(parts):
        path = ".".join(parts[:depth])
        if isinstance(here, Mapping):
            if part in here:
                here = here[part]
                continue
            if depth == len(parts) - 1 or depth == 0:
                return ABSENT
            raise StudyError(
                f"`{key}` leads nowhere: `{path}` has no `{part}`",
                help=f"it has {', '.join(here)}{nearest(part, here)}",
                key=key,
            )
        if isinstance(here, list):
            if part.isdigit() and int(part) < len(here):
                here = here[int(part)]
                continue
            raise StudyError(
                f"`{key}` leads nowhere: `{path}` is a list of {len(here)}",
                help=f"its entries are `{path}.0` to `{path}.{len(here) - 1}`",
                key=key,
            )
        raise StudyError(
            f"`{key}` leads nowhere: `{path}` is {shown(here)}",
            help=f"vary `{path}` itself",
            key=key,
        )
    return here


def put(tables: Tables, key: str, value: Value) -> dict[str, Any]:
    """The tables with a value at a path; a table or key that is absent is added.

    Examples
    --------
    >>> put({"ply": {"cell": [1, 2]}}, "ply.cell.1", 3)
    {'ply': {'cell': [1, 3]}}

    """
    return _put(tables, key.split("."), value)  # type: ignore[no-any-return]


def _put(here: Any, parts: list[str], value: Value) -> Any:
    if not parts:
        return value
    first, rest = parts[0], parts[1:]
    if isinstance(here, list):
        at = int(first)
        return [*here[:at], _put(here[at], rest, value), *here[at + 1 :]]
    inner = here.get(first, {}) if rest else None
    return {**here, first: _put(inner, rest, value)}


def idle(command: str, key: str) -> str | None:
    """Why a key has no effect on a command, or None where it has."""
    keys, why = IDLE[command]
    return why if any(key == k or key.startswith(f"{k}.") for k in keys) else None


def nearest(name: str, known: Any) -> str:
    """A question that names the known name nearest to one that is not known; may be empty."""
    close = difflib.get_close_matches(name, list(map(str, known)), n=1)
    return f"; did you mean `{close[0]}`?" if close else ""
