"""Plain values as TOML text."""

from __future__ import annotations

import json
import math
from typing import Any


def text(table: dict[str, Any]) -> str:
    """A TOML file: plain keys first, then one section for each table."""
    plain = [f"{key(k)} = {value(v)}" for k, v in table.items() if not isinstance(v, dict)]
    sections = [
        "\n".join([f"\n[{key(k)}]", *(f"{key(n)} = {value(x)}" for n, x in v.items())])
        for k, v in table.items()
        if isinstance(v, dict)
    ]
    return "\n".join([*plain, *sections, ""])


def key(name: str) -> str:
    """A key, in quotes where it needs them."""
    bare = name and name.isascii() and name.replace("_", "").replace("-", "").isalnum()
    return name if bare else value(name)


def value(item: Any) -> str:
    """A value on one line."""
    if isinstance(item, bool):
        return "true" if item else "false"
    if isinstance(item, float):
        if math.isfinite(item):
            return repr(item)
        return "nan" if math.isnan(item) else ("inf" if item > 0 else "-inf")
    if isinstance(item, str):
        # JSON's escapes are TOML's, but for DEL
        return json.dumps(item, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(item, list):
        return "[" + ", ".join(value(x) for x in item) + "]"
    if isinstance(item, dict):
        return "{ " + ", ".join(f"{key(k)} = {value(v)}" for k, v in item.items()) + " }"
    return str(item)  # whole numbers, dates
