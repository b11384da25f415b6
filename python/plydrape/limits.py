"""Limits of an accepted drape, judged: what was measured, what is allowed, where and when."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any, Literal

from plydrape import _plydrape

__all__ = ["Limit", "Limits"]

MEASURES = {measure.name: measure for measure in _plydrape.measures()}
WORDS = {"at-most": "at most", "at-least": "at least"}


@dataclass(frozen=True, repr=False)
class Limit:
    """A limit, judged.

    Attributes
    ----------
    name : str
        Its name: its key in `limits` of a scene.
    label : str
        What it is called in tables.
    value : float
        The worst value that was measured, in `unit`; nan of a limit that could not be judged, and
        `where` says why.
    limit : float
        The value that is allowed, in `unit`.
    unit : str
        Unit of both: "mm", "°", "N", "%"; empty of plain numbers.
    sense : {"at-most", "at-least"}
        Which way it bounds.
    kept : bool
        Whether it is kept.
    step : int or None
        The step of that value, from 1; None of what no step has.
    where : str
        The place on the ply in words; empty of what has none.
    place : tuple of float or None
        That place in space, x, y and z (m).

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> plydrape.simulate(scene).limits["tilt"]
    <plydrape.Limit tilt: 28.64 °, at most 40 °, kept; step 9, gripper g3_0>

    """

    name: str
    label: str
    value: float
    limit: float
    unit: str
    sense: Literal["at-most", "at-least"]
    kept: bool
    step: int | None
    where: str
    place: tuple[float, float, float] | None

    def __repr__(self) -> str:
        at = ", ".join(
            [f"step {self.step}"] * (self.step is not None) + [self.where] * bool(self.where)
        )
        return (
            f"<plydrape.Limit {self.name}: {self.amount(self.value)}, {WORDS[self.sense]} "
            f"{self.amount(self.limit)}, {'kept' if self.kept else 'not kept'}"
            f"{'; ' if at else ''}{at}>"
        )

    def amount(self, value: float) -> str:
        """A value in four digits with the unit.

        Parameters
        ----------
        value : float
            A number in `unit`.

        Returns
        -------
        str
            The number and the unit.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> tilt = plydrape.simulate(scene).limits["tilt"]
        >>> tilt.amount(tilt.limit)
        '40 °'

        """
        return f"{value:.4g} {self.unit}".rstrip()


class Limits(Mapping[str, Limit]):
    """Judged limits by their names, in the order of tables.

    Parameters
    ----------
    limits : iterable of Limit
        The limits.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> limits = plydrape.simulate(scene).limits
    >>> limits["height"].kept, limits["height"].unit
    (False, 'mm')
    >>> [limit.name for limit in limits.values() if not limit.kept]
    ['strain', 'fiber_angle', 'height', 'out_of_plane', 'position']

    """

    def __init__(self, limits: Iterable[Limit]) -> None:
        self._limits = {limit.name: limit for limit in limits}

    @classmethod
    def of(cls, verdicts: Iterable[Mapping[str, Any]]) -> Limits:
        """Limits as result.json has them.

        Parameters
        ----------
        verdicts : iterable of dict
            Dicts with name, value, limit, unit, ok, step, where and place.

        Returns
        -------
        Limits
            The same by name.

        Examples
        --------
        >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
        >>> result = plydrape.simulate(scene)
        >>> plydrape.Limits.of(result.summary["limits"]) == result.limits
        True

        """
        return cls(_limit(verdict) for verdict in verdicts)

    def __getitem__(self, name: str) -> Limit:
        try:
            return self._limits[name]
        except KeyError:
            raise LimitKeyError(name, self._limits) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._limits)

    def __len__(self) -> int:
        return len(self._limits)

    def __repr__(self) -> str:
        broken = [name for name, limit in self._limits.items() if not limit.kept]
        said = f"not kept: {', '.join(broken)}" if broken else "all kept"
        return f"<plydrape.Limits, {len(self)} of them, {said}>"

    def _repr_html_(self) -> str:
        from plydrape import _html

        return _html.page(_html.limits(self))


class LimitKeyError(KeyError):
    """A limit that was not judged, with the names of those that were."""

    def __init__(self, name: object, known: Iterable[str]) -> None:
        """`name` is not among `known`."""
        super().__init__(name)
        self.known = tuple(known)

    def __str__(self) -> str:
        (name,) = self.args
        close = get_close_matches(str(name), self.known, 1)
        guess = f"did you mean {close[0]!r}? " if close else ""
        return f"no limit {name!r} was judged; {guess}there are {', '.join(self.known) or 'none'}"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (*self.args, self.known)


def _limit(verdict: Mapping[str, Any]) -> Limit:
    measure = MEASURES[verdict["name"]]
    place = verdict.get("place")
    return Limit(
        name=measure.name,
        label=measure.label,
        value=verdict["value"] if verdict.get("judged", True) else math.nan,
        limit=verdict["limit"],
        unit=verdict["unit"],
        sense="at-least" if measure.sense == "at-least" else "at-most",
        kept=verdict["ok"],
        step=verdict.get("step"),
        where=verdict.get("where") or "",
        place=None if place is None else (place[0], place[1], place[2]),
    )
