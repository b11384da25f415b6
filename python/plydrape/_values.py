"""What all values have in common: they are pickled, copied and compared by what they hold.

A value does not change, so a copy of it is the value itself. What is pickled is whole: the mesh of
a mold and the states of a sheet are in it, and no file is read where it comes back.
"""

from __future__ import annotations

from typing import Any

from plydrape import _plydrape

VALUES = (
    _plydrape.ClosestPoints,
    _plydrape.Drape,
    _plydrape.Equilibria,
    _plydrape.Material,
    _plydrape.Measure,
    _plydrape.Mold,
    _plydrape.Net,
    _plydrape.Outcome,
    _plydrape.Plan,
    _plydrape.Ply,
    _plydrape.Result,
    _plydrape.Sample,
    _plydrape.Scene,
    _plydrape.Sheet,
    _plydrape.Span,
    _plydrape.Surface,
)
"""Classes whose objects never change."""

SOLVED = (_plydrape.Equilibrium, _plydrape.Jacobian)
"""Classes whose objects never change, but hold what no other process has."""


def restore(name: str, version: str, state: str, file: bytes | None) -> Any:
    """The object of a class with a state that this or another version wrote."""
    try:
        return _plydrape._restore(name, state, file)
    except ValueError as fault:
        if version == _plydrape.__version__:
            raise
        raise ValueError(
            f"this {name} was pickled by plydrape {version} and cannot be read by "
            f"{_plydrape.__version__}: keep scenes as TOML and results as result.json"
        ) from fault


def reduced(value: Any) -> tuple[Any, ...]:
    """How a value is pickled."""
    state, file = _plydrape._state(value, True)
    return restore, (type(value).__name__, _plydrape.__version__, state, file)


def same(value: Any, other: object) -> Any:
    """Whether two values of a class hold the same."""
    if type(other) is not type(value):
        return NotImplemented
    return value is other or _plydrape._state(value, False) == _plydrape._state(other, False)


def hashed(value: Any) -> int:
    """A hash that is the same for values that hold the same."""
    return hash(_plydrape._state(value, False))


def itself(value: Any, memo: object = None) -> Any:
    """A copy of what never changes."""
    return value


def forgetful(solver: Any, memo: object = None) -> Any:
    """A copy of a solver: of the same ply and rules, without a last equilibrium."""
    kind, state = reduced(solver)
    return kind(*state)


def give() -> None:
    """Gives the classes their methods."""
    for kind in (*VALUES, *SOLVED):
        give_one(kind, __copy__=itself, __deepcopy__=itself, __reduce__=reduced)
    for kind in VALUES:
        give_one(kind, __eq__=same, __hash__=hashed)
    give_one(_plydrape.Solver, __copy__=forgetful, __deepcopy__=forgetful, __reduce__=reduced)


def give_one(kind: type, **methods: Any) -> None:
    """Gives a class methods by their names."""
    for name, method in methods.items():
        setattr(kind, name, method)
