"""Numbers and names as people read them."""

from __future__ import annotations

import math

# Names that are not their key with spaces.
NAMES = {
    "placement.rms": "placement error, rms",
    "placement.largest": "placement error, largest",
    "fibre_angle": "fibre angle",
}


def amount(x: float) -> str:
    """A number with four digits that say something.

    Example:
        >>> amount(0.0305123), amount(879.4521), amount(0.0), amount(9e-06)
        ('0.03051', '879.5', '0', '9e-06')

    """
    if x == 0 or not math.isfinite(x):
        return "0" if x == 0 else str(x)
    if abs(x) < 1e-9:
        return f"{x:.0e}"
    return f"{x:.4g}"


def name(key: str) -> str:
    """A column's name in words.

    Example:
        >>> name("value_slack_ratio"), name("worst_slack_mm")
        ('slack ratio', 'worst slack mm')

    """
    key = key.removeprefix("value_")
    return NAMES.get(key, key if "." in key else key.replace("_", " "))
