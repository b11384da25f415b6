"""The table [vary]: what varies, and how."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import Any

from .error import StudyError
from .keys import ABSENT, WHOLE, Tables, Value, idle, look, quantity
from .labels import shown
from .law import Choice, Input, Law, Normal, Uniform, Whole, finite
from .placement import LENGTHS, Placement

FORMS = (
    'write { from = "60 mm", to = "90 mm" }, { values = [...] }, { deviation = "1 mm" }, '
    "or { relative = [0.8, 1.2] }"
)
RELATIVE = "write relative = [0.8, 1.2], or the same with { from, to }, { values } or { deviation }"
# Placement errors end where sizes of a scene do (m).
FARTHEST = 1e4
# Whole numbers up to here are exact also as floating-point numbers.
EXACT = 2**53
PLACEMENT = 'write placement = { deviation = "1 mm" }, or { from = "-1 mm", to = "1 mm" }'


def inputs(
    varied: Mapping[str, Any], tables: Tables, command: str, sampling: str
) -> tuple[Input, ...]:
    """The inputs of a study, in the order in which they are written.

    Raises
    ------
    StudyError
        a key that the scene has not, or a law that cannot be.

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
            continue
        if (why := idle(command, key)) is not None:
            raise StudyError(f"`{key}` changes nothing: {why}", help="remove it", key=key)
        found.append(_Spec(key, spec, look(tables, key), sampling).input())
    return tuple(found)


def placement(varied: Mapping[str, Any], command: str, sampling: str) -> Placement | None:
    """How grippers err, or None where the table has no such key.

    Raises
    ------
    StudyError
        It cannot be, or not with this command or sampling.

    """
    if "placement" not in varied:
        return None
    spec = varied["placement"]
    if sampling == "grid":
        raise StudyError(
            "`placement` has no grid: its errors are drawn",
            help='use sampling = "latin-hypercube"',
            key="placement",
        )
    if command == "plan":
        raise StudyError(
            '`placement` does not go with command = "plan": a plan knows where its grippers are',
            help='plan once, then vary placement with command = "follow"',
            key="placement",
        )
    if not isinstance(spec, Mapping):
        raise StudyError(
            f"`placement` = {shown(spec)} is no table", help=PLACEMENT, key="placement"
        )
    keys = set(spec) - {"axes"}
    axes = spec.get("axes", "xyz")
    if not isinstance(axes, str) or not axes or axes not in ("xyz", "xy", "xz", "yz", *"xyz"):
        raise StudyError(
            f"`placement.axes` = {shown(axes)} are no axes",
            help='write "xyz" or some of them in this order, as in "xy"',
            key="placement",
        )
    if keys == {"deviation"}:
        kind, bounds = "normal", [spec["deviation"]]
    elif keys == {"from", "to"}:
        kind, bounds = "uniform", [spec["from"], spec["to"]]
    else:
        raise StudyError(
            f"`placement` = {shown(dict(spec))} says no law", help=PLACEMENT, key="placement"
        )
    numbers, unit = _numbers("placement", bounds)
    if unit not in LENGTHS:
        raise StudyError(
            f"`placement` is in `{unit}`, which is no length known here",
            help=f"use one of {', '.join(filter(None, LENGTHS))}",
            key="placement",
        )
    if (kind == "normal" and numbers[0] <= 0) or (kind == "uniform" and numbers[0] >= numbers[1]):
        raise StudyError(
            f"`placement` = {shown(dict(spec))} is empty", help=PLACEMENT, key="placement"
        )
    if max(map(abs, numbers)) * LENGTHS[unit] > FARTHEST:
        raise StudyError(
            f"`placement` = {shown(dict(spec))} is more than {FARTHEST / 1000:g} km",
            help='write how far grippers err, as in "1 mm": is the unit right?',
            key="placement",
        )
    return Placement(kind, tuple(numbers), unit, axes)


class _Spec:
    """One line of [vary], with what the scene has at its key."""

    def __init__(self, key: str, spec: Any, own: Any, sampling: str) -> None:
        self.key = key
        self.own = own
        self.sampling = sampling
        if isinstance(own, Mapping | list):
            inside = [
                f"{key}.{name}" for name in (own if isinstance(own, Mapping) else range(len(own)))
            ]
            raise StudyError(
                f"`{key}` is no number but {'a table' if isinstance(own, Mapping) else 'a list'}",
                help=f"vary one of {', '.join(inside)}",
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
            law, unit = self._relative(spec["relative"])
        else:
            law, unit = self._law(spec, self.own)
        self._bounded(law)
        if self.key in WHOLE:
            law = self._whole(law)
        if self.sampling == "grid":
            if isinstance(law, Normal):
                raise self.error("is normal, which has no grid", "write from, to and points")
            if not isinstance(law, Choice) and points is None:
                raise self.error(
                    "does not say how many numbers of the range a grid has", "add points = 5"
                )
        return Input(self.key, law, unit, points)

    def _points(self, spec: dict[str, Any]) -> int | None:
        points = spec.pop("points", None)
        if points is None:
            return None
        if isinstance(points, bool) or not isinstance(points, int) or points < 1:
            raise self.error("has no whole number of points", "write points = 5")
        if self.sampling != "grid" or "values" in spec:
            raise self.error("has points", 'they divide a range of sampling = "grid"; remove them')
        return points

    def _law(self, spec: dict[str, Any], own: Any) -> tuple[Law, str]:
        """The law of a table, and the unit of its numbers; `own` is the usual mean."""
        keys = set(spec)
        if keys == {"from", "to"}:
            (lower, upper), unit = _numbers(self.key, [spec["from"], spec["to"]])
            if lower >= upper:
                raise self.error("is an empty range", "`from` must be less than `to`")
            return Uniform(lower, upper), unit
        if keys in ({"deviation"}, {"mean", "deviation"}):
            mean = spec.get("mean", own)
            if mean is ABSENT:
                raise self.error("has no mean, nor has the scene one", 'add mean = "…"')
            (middle, deviation), unit = _numbers(self.key, [mean, spec["deviation"]])
            if deviation <= 0:
                raise self.error("does not vary", "the deviation must be more than 0")
            return Normal(middle, deviation), unit
        if keys == {"values"}:
            return self._choice(spec["values"])
        raise self.error("is no law", FORMS)

    def _choice(self, values: Any) -> tuple[Law, str]:
        if not isinstance(values, list | tuple) or not values:
            raise self.error("has no values", 'write values = ["60 mm", "75 mm"]')
        texts = all(isinstance(value, str) and quantity(value) is None for value in values)
        if texts or (len(kinds := {type(value) for value in values}) == 1 and kinds <= {bool, int}):
            law, unit = Choice(tuple(values)), ""
        else:
            numbers, unit = _numbers(self.key, list(values))
            law = Choice(tuple(numbers))
        if len(set(law.values)) < len(law.values):
            raise self.error("has a value twice", "give each once")
        return law, unit

    def _relative(self, spec: Any) -> tuple[Law, str]:
        """Factors on the scene's own number become numbers."""
        own = quantity(self.own)
        if own is None or own[0] == 0 or not finite(own[0]):
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
        law, of_factors = self._law(dict(spec), 1.0)
        if of_factors or (isinstance(law, Choice) and not Input("", law).numeric):
            raise self.error("has factors with a unit", RELATIVE)
        if isinstance(law, Uniform):
            ends = sorted((number * law.lower, number * law.upper))
            return Uniform(*ends), unit
        if isinstance(law, Normal):
            return Normal(number * law.mean, abs(number) * law.deviation), unit
        assert isinstance(law, Choice)
        return Choice(tuple(number * float(value) for value in law.values)), unit

    def _bounded(self, law: Law) -> None:
        """Refuses numbers that overflow: as factors, as the width of a range, far off the mean."""
        if isinstance(law, Uniform):
            sound = finite(law.lower, law.upper, law.upper - law.lower)
        elif isinstance(law, Normal):
            sound = finite(abs(law.mean) + 10 * law.deviation)
        else:
            numbers = law.values if isinstance(law, Choice) and Input("", law).numeric else ()
            sound = finite(*map(float, numbers))
        if not sound:
            raise self.error(
                "goes beyond the largest floating-point number, 1.8e308",
                "write numbers that a scene can have",
            )

    def _whole(self, law: Law) -> Law:
        """The law of a number that counts something."""
        ends: tuple[Value, ...] = ()
        if isinstance(law, Uniform):
            ends = (law.lower, law.upper)
        elif isinstance(law, Choice) and Input("", law).numeric:
            ends = law.values
        if any(abs(float(end)) > EXACT for end in ends):
            raise self.error(
                f"goes beyond {EXACT}, the largest whole number that can vary", "write less"
            )
        if isinstance(law, Uniform):
            law = Whole(round(law.lower), round(law.upper))
        elif isinstance(law, Choice) and Input("", law).numeric:
            law = Choice(tuple(round(float(value)) for value in law.values))
        if not Input(self.key, law).whole:
            raise self.error("is no law of whole numbers", "write from and to, or values")
        return law


def _numbers(key: str, values: list[Value]) -> tuple[list[float], str]:
    """Numbers that have one unit in common."""
    found = []
    for value in values:
        split = quantity(value)
        if split is None or not finite(split[0]):
            raise StudyError(
                f"`{key}`: {shown(value)} is no number",
                help='write a number, or a number with its unit as in "98 mm"',
                key=key,
            )
        found.append(split)
    units = {unit for _, unit in found}
    if len(units) > 1:
        raise StudyError(
            f"`{key}`: {', '.join(map(repr, values))} are in different units",
            help="write all of them in one",
            key=key,
        )
    return [number for number, _ in found], units.pop()
