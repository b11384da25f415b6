"""How one number of a scene varies: evenly, normally, or over a list.

Every law is a function from u in (0, 1), which is what designs of experiments are made of, to the
number: the inverse of its distribution function.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist

from .keys import Value

# The largest number below 1: a normal law has no value at 0 and at 1.
EDGE = 1.0 - 2.0**-53


@dataclass(frozen=True)
class Uniform:
    """Evenly from the lower to the upper end."""

    lower: float
    upper: float

    def at(self, u: float) -> Value:
        """The number at u.

        Examples
        --------
        >>> Uniform(60.0, 90.0).at(0.5)
        75.0

        """
        return self.lower + (self.upper - self.lower) * u

    def grid(self, points: int) -> list[Value]:
        """So many numbers, evenly from end to end.

        Examples
        --------
        >>> Uniform(60.0, 90.0).grid(3)
        [60.0, 75.0, 90.0]

        """
        if points == 1:
            return [self.at(0.5)]
        return [*(self.at(i / (points - 1)) for i in range(points - 1)), self.upper]


@dataclass(frozen=True)
class Whole:
    """Each whole number from the lower to the upper end with the same probability."""

    lower: int
    upper: int

    def at(self, u: float) -> Value:
        """The number at u.

        Examples
        --------
        >>> Whole(1, 3).at(0.5)
        2

        """
        return self.lower + min(int(u * self.count), self.count - 1)

    @property
    def count(self) -> int:
        """How many numbers there are."""
        return self.upper - self.lower + 1

    def grid(self, points: int) -> list[Value]:
        """So many whole numbers from end to end, none twice.

        Examples
        --------
        >>> Whole(1, 10).grid(4)
        [1, 4, 7, 10]

        """
        if points >= self.count:
            return list(range(self.lower, self.upper + 1))
        even = Uniform(self.lower, self.upper).grid(points)
        return list(dict.fromkeys(round(float(x)) for x in even))


@dataclass(frozen=True)
class Normal:
    """Normally distributed."""

    mean: float
    deviation: float

    def at(self, u: float) -> Value:
        """The number at u; the ends of (0, 1) are drawn in by 1e-16.

        Examples
        --------
        >>> Normal(75.0, 2.0).at(0.5)
        75.0

        """
        return NormalDist(self.mean, self.deviation).inv_cdf(min(max(u, 1.0 - EDGE), EDGE))


@dataclass(frozen=True)
class Choice:
    """Each entry of a list with the same probability."""

    values: tuple[Value, ...]

    def at(self, u: float) -> Value:
        """The entry at u.

        Examples
        --------
        >>> Choice(("once", "cut")).at(0.7)
        'cut'

        """
        return self.values[min(int(u * len(self.values)), len(self.values) - 1)]


Law = Uniform | Whole | Normal | Choice


@dataclass(frozen=True)
class Input:
    """A number of the scene that varies.

    Attributes
    ----------
    key
        Its dotted path in the scene.
    law
        How it varies, in `unit`.
    unit
        Unit of its numbers as the scene writes it; empty for plain numbers, which are SI.
    points
        On a grid, into how many numbers a range is divided.

    """

    key: str
    law: Law
    unit: str = ""
    points: int | None = None

    @property
    def numeric(self) -> bool:
        """False for names such as "path" or "stepwise", which have no order."""
        values = self.law.values if isinstance(self.law, Choice) else ()
        return not any(isinstance(value, str | bool) for value in values)

    @property
    def whole(self) -> bool:
        """True where every number is a whole one."""
        if isinstance(self.law, Choice):
            return all(type(value) is int for value in self.law.values)
        return isinstance(self.law, Whole)

    def grid(self) -> list[Value]:
        """Its numbers on a grid."""
        if isinstance(self.law, Choice):
            return list(self.law.values)
        assert not isinstance(self.law, Normal) and self.points is not None
        return self.law.grid(self.points)

    @property
    def count(self) -> int:
        """How many numbers it has on a grid, without making them.

        Examples
        --------
        >>> Input("motion.steps", Whole(1, 10), points=4).count
        4

        """
        if isinstance(self.law, Choice):
            return len(self.law.values)
        assert self.points is not None
        return min(self.points, self.law.count) if isinstance(self.law, Whole) else self.points

    def probes(self) -> list[Value]:
        """Its middle and its ends, to see whether a scene takes them."""
        return [self.law.at(u) for u in (0.5, 1e-9, 1.0 - 1e-9)]

    def written(self, value: Value) -> Value:
        """The value as it stands in the scene: with its unit, and with all its digits.

        Examples
        --------
        >>> Input("grippers.height", Uniform(60.0, 90.0), "mm").written(75.25)
        '75.25 mm'

        """
        if isinstance(value, str | bool) or not self.unit:
            return value
        return f"{value!r} {self.unit}"


def finite(*numbers: float) -> bool:
    """Whether all numbers are."""
    return all(math.isfinite(number) for number in numbers)
