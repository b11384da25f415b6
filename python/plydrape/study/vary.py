"""The table [vary]: which numbers of the scene vary, and by which law.

The laws are SciPy's distributions. A number of a scenario is the inverse of the distribution
function at a coordinate u of the design of experiments, which is in (0, 1).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .error import StudyError
from .keys import ABSENT, WHOLE, Tables, Value, idle, look, quantity
from .labels import shown

FORMS = (
    'write { from = "60 mm", to = "90 mm" }, { values = [...] }, { deviation = "1 mm" }, '
    "or { relative = [0.8, 1.2] }"
)
RELATIVE = "write relative = [0.8, 1.2], or the same with { from, to }, { values } or { deviation }"
# Whole numbers up to here are exact also as floating-point numbers.
EXACT = 2**53
# Whole numbers end here in scenes and in Parquet.
LARGEST = 2**63 - 1
# A normal law has no value at 0 and at 1: u keeps this distance from both.
EDGE = 2.0**-53


@dataclass(frozen=True)
class Input:
    """A number of the scene that varies.

    Attributes
    ----------
    key
        Its dotted path in the scene.
    law
        "uniform", "normal" or "values".
    numbers
        Both ends, mean and deviation, or all values, in `unit`.
    unit
        Unit of its numbers as the scene writes it; empty for plain numbers, which are SI.
    points
        On a grid, into how many numbers a range is divided.
    whole
        Whether every number is a whole one.

    """

    key: str
    law: str
    numbers: tuple[Value, ...]
    unit: str = ""
    points: int | None = None
    whole: bool = False

    @property
    def numeric(self) -> bool:
        """False for names such as "path" or "stepwise", which have no order."""
        return not any(isinstance(number, str | bool) for number in self.numbers)

    def at(self, u: Any) -> list[Value]:
        """Values at probabilities u, shape (N,).

        Examples
        --------
        >>> Input("grippers.height", "uniform", (60.0, 90.0)).at([0.5])
        [75.0]

        """
        from scipy import stats

        u = np.clip(u, EDGE, 1.0 - EDGE)
        if self.law == "values":
            places = stats.randint(0, len(self.numbers)).ppf(u)
            return [self.numbers[int(place)] for place in places]
        first, second = map(float, self.numbers)
        if self.law == "normal":
            values = stats.norm(first, second).ppf(u)
        elif self.whole:
            values = stats.randint(first, second + 1).ppf(u).astype(int)
        else:
            values = stats.uniform(first, second - first).ppf(u)
        return list(values.tolist())

    def grid(self) -> list[Value]:
        """Numbers on a grid: evenly from end to end, none twice.

        Examples
        --------
        >>> Input("motion.steps", "uniform", (1, 10), points=4, whole=True).grid()
        [1, 4, 7, 10]

        """
        if self.law == "values":
            return list(self.numbers)
        lower, upper = map(float, self.numbers)
        if self.count == 1:
            lower = upper = (lower + upper) / 2
        even = np.linspace(lower, upper, self.count)
        return list((np.unique(np.rint(even)).astype(int) if self.whole else even).tolist())

    @property
    def count(self) -> int:
        """How many numbers it has on a grid, without making them.

        Examples
        --------
        >>> Input("motion.steps", "uniform", (1, 10), points=4, whole=True).count
        4

        """
        if self.law == "values":
            return len(self.numbers)
        assert self.points is not None
        if not self.whole:
            return self.points
        return min(self.points, int(self.numbers[1]) - int(self.numbers[0]) + 1)

    def written(self, value: Value) -> Value:
        """The value as the scene has it: with its unit, and with all its digits.

        Examples
        --------
        >>> Input("grippers.height", "uniform", (60.0, 90.0), "mm").written(75.25)
        '75.25 mm'

        """
        if isinstance(value, str | bool) or not self.unit:
            return value
        return f"{value!r} {self.unit}"


def inputs(
    varied: Mapping[str, Any], tables: Tables, command: str, sampling: str
) -> tuple[Input, ...]:
    """The inputs of a study, in the order in which they are written.

    Raises
    ------
    StudyError
        A key that the scene has not, or a law that cannot be.

    """
    found = []
    for key, other in itertools.permutations(varied, 2):
        if key.startswith(f"{other}."):
            raise StudyError(
                f"`{key}` varies within `{other}`, which varies itself",
                help="vary one of them",
                key=key,
            )
    for key, spec in varied.items():
        if key == "placement":
            raise StudyError(
                "`placement` is no key of [vary]: errors are those of the scene",
                help='write gripper = { position = { deviation = "1 mm" } } in [errors] of the '
                'scene, or vary "errors.gripper.position.deviation"',
                key=key,
            )
        if (why := idle(command, key)) is not None:
            raise StudyError(f"`{key}` changes nothing: {why}", help="remove it", key=key)
        found.append(_Line(key, spec, look(tables, key), sampling).input())
    return tuple(found)


# A law, its numbers and their unit.
Law = tuple[str, tuple[Value, ...], str]


class _Line:
    """One line of [vary], with what the scene has at its key."""

    def __init__(self, key: str, spec: Any, own: Any, sampling: str) -> None:
        self.key = key
        self.own = own
        self.sampling = sampling
        if isinstance(own, Mapping | list):
            names = own if isinstance(own, Mapping) else range(len(own))
            raise StudyError(
                f"`{key}` is no number but {'a table' if isinstance(own, Mapping) else 'a list'}",
                help=f"vary one of {', '.join(f'{key}.{name}' for name in names)}",
                key=key,
            )
        if not isinstance(spec, Mapping):
            raise StudyError(f"`{key}` = {shown(spec)} is no law", help=FORMS, key=key)
        self.spec = dict(spec)

    def error(self, what: str, remedy: str) -> StudyError:
        """The error for this line."""
        return StudyError(f"`{self.key}` = {shown(self.spec)} {what}", help=remedy, key=self.key)

    def input(self) -> Input:
        """The input that the line describes."""
        spec = dict(self.spec)
        points = self._points(spec)
        if "relative" in spec:
            if len(spec) > 1:
                raise self.error("says more than one law", FORMS)
            law, numbers, unit = self._relative(spec["relative"])
        else:
            law, numbers, unit = self._law(spec, self.own)
        x = self._whole(Input(self.key, law, numbers, unit, points))
        self._bounded(x)
        if self.sampling == "grid":
            if law == "normal":
                raise self.error("is normal, which has no grid", "write from, to and points")
            if law == "uniform" and points is None:
                raise self.error(
                    "does not say how many numbers of the range a grid has", "add points = 5"
                )
        return x

    def _points(self, spec: dict[str, Any]) -> int | None:
        points = spec.pop("points", None)
        if points is None:
            return None
        if isinstance(points, bool) or not isinstance(points, int) or points < 1:
            raise self.error("has no whole number of points", "write points = 5")
        if self.sampling != "grid" or "values" in spec:
            raise self.error("has points", 'they divide a range of sampling = "grid"; remove them')
        return points

    def _law(self, spec: dict[str, Any], own: Any) -> Law:
        """The law of a table; `own` is the mean unless the table has one."""
        keys = set(spec)
        if keys == {"from", "to"}:
            (lower, upper), unit = self._numbers([spec["from"], spec["to"]])
            if lower >= upper:
                raise self.error("is an empty range", "`from` must be less than `to`")
            return "uniform", (lower, upper), unit
        if keys in ({"deviation"}, {"mean", "deviation"}):
            mean = spec.get("mean", own)
            if mean is ABSENT:
                raise self.error("has no mean, nor has the scene one", 'add mean = "…"')
            (middle, deviation), unit = self._numbers([mean, spec["deviation"]])
            if deviation <= 0:
                raise self.error("does not vary", "the deviation must be more than 0")
            return "normal", (middle, deviation), unit
        if keys == {"values"}:
            return self._choice(spec["values"])
        raise self.error("is no law", FORMS)

    def _choice(self, values: Any) -> Law:
        if not isinstance(values, list | tuple) or not values:
            raise self.error("has no values", 'write values = ["60 mm", "75 mm"]')
        texts = all(isinstance(value, str) and quantity(value) is None for value in values)
        numbers, unit = tuple(values), ""
        kinds = {type(value) for value in values}
        plain = kinds == {bool} or (kinds == {int} and max(map(abs, values)) <= LARGEST)
        if not texts and not plain:
            found, unit = self._numbers(list(values))
            numbers = tuple(found)
        if len(set(numbers)) < len(numbers):
            raise self.error("has a value twice", "give each once")
        return "values", numbers, unit

    def _relative(self, spec: Any) -> Law:
        """Factors on the scene's own number become numbers."""
        own = quantity(self.own)
        if own is None or own[0] == 0 or not math.isfinite(own[0]):
            what = "gives none" if self.own is ABSENT else f"has {shown(self.own)}"
            raise self.error(
                f"is relative to the scene's own number, and the scene {what}",
                "write the number into the scene, or its range here",
            )
        number, unit = own
        if isinstance(spec, list | tuple) and len(spec) == 2:
            spec = {"from": spec[0], "to": spec[1]}
        if not isinstance(spec, Mapping):
            raise self.error("has no factors", RELATIVE)
        law, factors, factor_unit = self._law(dict(spec), 1.0)
        if factor_unit or not Input("", law, factors).numeric:
            raise self.error("has factors with a unit", RELATIVE)
        numbers = [number * float(factor) for factor in factors]
        if law == "uniform":
            numbers.sort()
        elif law == "normal":
            numbers[1] = abs(numbers[1])
        return law, tuple(numbers), unit

    def _bounded(self, x: Input) -> None:
        """Refuses numbers that overflow: as factors, as the width of a range, far off the mean."""
        numbers = [float(number) for number in x.numbers] if x.numeric else []
        if x.law == "uniform":
            numbers.append(numbers[1] - numbers[0])
        elif x.law == "normal":
            numbers.append(abs(numbers[0]) + 10 * numbers[1])
        if not all(map(math.isfinite, numbers)):
            raise self.error(
                "goes beyond the largest floating-point number, 1.8e308",
                "write numbers that a scene can have",
            )

    def _whole(self, x: Input) -> Input:
        """The input with whole numbers, where its key counts something or its values are whole."""
        whole = all(type(number) is int for number in x.numbers)
        if self.key in WHOLE and x.numeric and x.law != "normal":
            if any(abs(float(number)) > EXACT for number in x.numbers):
                raise self.error(
                    f"goes beyond {EXACT}, the largest whole number that can vary", "write less"
                )
            numbers = tuple(round(float(number)) for number in x.numbers)
            return Input(x.key, x.law, numbers, x.unit, x.points, whole=True)
        if self.key in WHOLE:
            raise self.error("is no law of whole numbers", "write from and to, or values")
        return Input(x.key, x.law, x.numbers, x.unit, x.points, whole)

    def _numbers(self, values: list[Value]) -> tuple[list[float], str]:
        """Numbers that have one unit in common."""
        found = []
        for value in values:
            split = quantity(value)
            if split is None or not math.isfinite(split[0]):
                raise StudyError(
                    f"`{self.key}`: {shown(value)} is no number",
                    help='write a number, or a number with its unit as in "98 mm"',
                    key=self.key,
                )
            found.append(split)
        units = {unit for _, unit in found}
        if len(units) > 1:
            raise StudyError(
                f"`{self.key}`: {', '.join(map(repr, values))} are in different units",
                help="write all of them in one",
                key=self.key,
            )
        return [number for number, _ in found], units.pop()
