"""Labels of columns and measures, and numbers as people read them."""

from __future__ import annotations

import math

# the package itself is still being loaded when it loads this
from plydrape._plydrape import measures

# Most characters of a value in a message.
MOST = 80
# What is measured, by the name of its limit and by its key in a step.
BY_NAME = {measure.name: measure for measure in measures()}
BY_KEY = {measure.key: measure for measure in measures()}


def amount(x: float) -> str:
    """A number with four digits that say something.

    Examples
    --------
    >>> amount(0.0305123), amount(879.4521), amount(0.0), amount(9e-06)
    ('0.03051', '879.5', '0', '9e-06')

    """
    if x == 0 or not math.isfinite(x):
        return "0" if x == 0 else str(x)
    if abs(x) < 1e-9:
        return f"{x:.0e}"
    return f"{x:.4g}"


def shown(value: object) -> str:
    """A value as a message has it: as Python writes it, with the middle left out of a long one.

    Examples
    --------
    >>> shown("75 mm"), shown("9" * 5000)[:3], len(shown("9" * 5000))
    ("'75 mm'", "'99", 80)

    """
    try:
        text = repr(value)
    except (ValueError, RecursionError):  # too many digits, or nested too deep
        return f"a {type(value).__name__} too long to show"
    return text if len(text) <= MOST else f"{text[: MOST - 16]}…{text[-15:]}"


def name(key: str) -> str:
    """A column's label.

    Examples
    --------
    >>> name("value_slack_ratio"), name("worst_force_n"), name("first_contact_step")
    ('slack ratio', 'worst horizontal force', 'first contact step')

    """
    part, _, rest = key.partition("_")
    if part in ("worst", "final") and rest in BY_KEY:
        return f"{part} {BY_KEY[rest].label}"
    return key if "." in key else key.removeprefix("value_").replace("_", " ")


def is_least(limit: str) -> bool:
    """Whether a limit of this name is the least allowed, not the most.

    Examples
    --------
    >>> is_least("contact_share"), is_least("tilt")
    (True, False)

    """
    return limit in BY_NAME and BY_NAME[limit].sense == "at-least"
