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
from .labels import shown
from .law import Input
from .scenario import Motion

# Scenarios of a study that does not say how many it may have: a slip of the pen is likelier.
MOST = 1_000_000
# Bytes of memory that a row takes at the end, when all rows become one table and its summary.
ROW = 3000
# Points that SciPy's Sobol sequence has, and inputs that it can vary.
SOBOL_POINTS, SOBOL_INPUTS = 2**30, 21201
# Levels of tables and lists that a study may have; a scene in it has six.
DEEPEST = 32
# Whole numbers end here in scenes and in Parquet.
LARGEST = 2**63 - 1


def bounded(table: Mapping[str, Any]) -> None:
    """Looks at every value once: nothing is nested too deep, no whole number is too large.

    Raises
    ------
    StudyError
        Something is.

    Examples
    --------
    >>> bounded({"samples": 8})

    """
    left: list[tuple[str, int, Any]] = [("", 0, table)]
    while left:
        path, depth, value = left.pop()
        if isinstance(value, int) and abs(value) > LARGEST:
            digits = round(value.bit_length() * math.log10(2))
            raise StudyError(
                f"`{path}` is a whole number of about {digits} digits",
                help=f"the largest possible is {LARGEST}",
                key=path,
            )
        if not isinstance(value, Mapping | list | tuple):
            continue
        if depth == DEEPEST:
            raise StudyError(
                f"`{path[:60]}…` is nested more than {DEEPEST} levels deep",
                help="no key of a study is: look for brackets that are not closed",
                key=path,
            )
        inner = value.items() if isinstance(value, Mapping) else enumerate(value)
        before = f"{path}." if path else ""
        left += [(f"{before}{key}", depth + 1, below) for key, below in inner]


def one_of(table: Mapping[str, Any], key: str, known: tuple[str, ...], usual: str) -> str:
    """A name out of several.

    Raises
    ------
    StudyError
        It is another.

    """
    value = table.get(key, usual)
    if value not in known:
        quoted = [f'"{name}"' for name in known]
        raise StudyError(
            f"`{key}` = {shown(value)} is not known",
            help=f"it is one of {', '.join(quoted)}{nearest(str(value), known)}",
            key=key,
        )
    return str(value)


def whole(table: Mapping[str, Any], key: str, usual: int | None, least: int) -> int:
    """A whole number; `usual` is None where it has to be given.

    Raises
    ------
    StudyError
        It is absent, no whole number, or less than the least.

    """
    value = table.get(key, usual)
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= LARGEST:
        raise StudyError(
            f"`{key}` is missing" if value is None else f"`{key}` = {shown(value)} does not count",
            help=f"write a whole number of {least} or more, as in {key} = {max(least, 256)}",
            key=key,
        )
    return value


def scenarios(table: Mapping[str, Any], sampling: str, laws: tuple[Input, ...]) -> int:
    """Number of scenarios: as written, or of a grid as follows. Nothing is made yet.

    Raises
    ------
    StudyError
        None is given, or more than `max_scenarios`, with what they would take.

    """
    most = whole(table, "max_scenarios", MOST, least=1)
    if sampling == "grid":
        if "samples" in table:
            raise StudyError(
                f"`samples` = {shown(table['samples'])} says nothing to a grid",
                help="remove it: a grid has every combination of its numbers",
                key="samples",
            )
        samples, source = math.prod(x.count for x in laws), "the grid"
        remedy = "give fewer points or values"
    else:
        samples = whole(table, "samples", None, least=1)
        source, remedy = f"`samples` = {samples}", "write fewer"
    if samples > most:
        number = str(samples) if samples <= LARGEST else f"about 1e{len(str(samples)) - 1}"
        raise StudyError(
            f"{source} makes {number} scenarios, which is more than {most}; their rows would take "
            f"about {size(samples * ROW)} of memory",
            help=f"{remedy}, or allow them by max_scenarios = {min(samples, LARGEST)}",
            key="vary" if sampling == "grid" else "samples",
        )
    if sampling == "sobol" and (samples > SOBOL_POINTS or len(laws) > SOBOL_INPUTS):
        raise StudyError(
            f"a Sobol sequence has no {samples} points of {len(laws)} numbers: it ends at "
            f"{SOBOL_POINTS} points and {SOBOL_INPUTS} numbers",
            help='use sampling = "latin-hypercube"',
            key="samples",
        )
    return samples


def size(count: int) -> str:
    """Bytes in a unit that makes their number small.

    Examples
    --------
    >>> size(3_000), size(3 * 10**15), size(10**40)
    ('3 kB', '3 PB', 'more than 1000 EB')

    """
    for power, unit in enumerate(("B", "kB", "MB", "GB", "TB", "PB", "EB")):
        if count < 1000 ** (power + 1):
            return f"{count / 1000**power:.3g} {unit}"
    return "more than 1000 EB"


def motion(table: Mapping[str, Any], command: str, base: Path) -> Motion | None:
    """The motion of the plan that is followed, or None with other commands.

    Raises
    ------
    StudyError
        It is absent, or given with another command.
    ResultError
        It is no result of this version.

    """
    plan = table.get("plan")
    if command != "follow":
        if plan is None:
            return None
        raise StudyError(
            f'`plan` = {shown(plan)} goes with command = "follow" only, and this is {command!r}',
            help="remove it, or follow the plan",
            key="plan",
        )
    if not isinstance(plan, str | os.PathLike):
        raise StudyError(
            "`plan` is missing: what is to be followed?",
            help='name a finished plan: plan = "scene.plan/result.json"',
            key="plan",
        )
    path = base / plan
    if path.is_dir():
        path = path / "result.json"
    result = plydrape.Result.read(str(path))
    return Motion(np.array(result.times), np.array(result.commanded))


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
