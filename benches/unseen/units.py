"""Lengths, angles and tables as a scene file has them."""

from __future__ import annotations


def length(value: float) -> str:
    """A length (m) in mm; adding 0 makes −0 a plain 0."""
    return f'"{value * 1e3 + 0.0:.6g} mm"'


def angle(value: float) -> str:
    """An angle in degrees."""
    return f'"{value + 0.0:.5g} deg"'


def table(name: str, keys: dict[str, str]) -> str:
    """A table and its keys."""
    return f"\n[{name}]\n" + "".join(f"{key} = {value}\n" for key, value in keys.items())
