"""What a study shows: how each measure is distributed, what drives it, how many are accepted.

The share of accepted drapes has Wilson's interval; what drives a measure is found by Spearman's
rank correlation, which sees any steady rise or fall, straight or not. A correlation smaller than
1.96/√(n − 1) is what independent numbers show by chance once in twenty times, and names no driver.
"""

from __future__ import annotations

import math
from collections import Counter
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

from . import table

# Normal quantile of a two-sided 95 % interval.
Z = 1.959963984540054
QUANTILES = (0, 5, 25, 50, 75, 95, 100)
# Columns that are no measures.
ASIDE = ("scenario", "seed", "version", "error", "error_kind")


def wilson(hits: int, of: int) -> tuple[float, float] | None:
    """Wilson's 95 % interval of a share; None of nothing.

    Examples
    --------
    >>> [round(x, 4) for x in wilson(5, 10)]
    [0.2366, 0.7634]

    """
    if of == 0:
        return None
    share = hits / of
    middle = share + Z * Z / (2 * of)
    half = Z * math.sqrt(share * (1 - share) / of + Z * Z / (4 * of * of))
    scale = 1 + Z * Z / of
    return max(0.0, (middle - half) / scale), min(1.0, (middle + half) / scale)


def summary(rows: pa.Table, inputs: list[str]) -> dict[str, Any]:
    """All figures of the page as plain JSON values.

    Parameters
    ----------
    rows : pa.Table
        Rows of a study.
    inputs : list of str
        Its columns that are inputs.

    """
    count = rows.num_rows
    draped = rows.filter(pc.is_null(rows["error"]))
    hits = int(verdicts(draped).sum())
    units = table.units(rows)
    causes = {name: x for name in inputs if (x := numbers(draped, name)) is not None}
    about = {}
    for name in draped.column_names:
        if name in inputs or name in ASIDE or name.startswith(("limit_", "margin_", "ok_")):
            continue
        values = verdicts(draped).astype(float) if name == "accepted" else numbers(draped, name)
        if values is not None and np.isfinite(values).any():
            about[name] = measure(name, values, causes, draped, units)
    kinds = Counter(
        (kind, pattern(text))
        for kind, text in zip(listed(rows, "error_kind"), listed(rows, "error"), strict=True)
        if text is not None
    )
    return {
        "scenarios": count,
        "draped": draped.num_rows,
        "failed": count - draped.num_rows,
        "accepted": {
            "count": hits,
            "share": hits / draped.num_rows if draped.num_rows else None,
            "interval": wilson(hits, draped.num_rows),
        },
        "chance": chance(draped.num_rows),
        "inputs": {
            name: {"unit": units.get(name, "")} | spread(numbers(rows, name)) for name in inputs
        },
        "measures": about,
        "errors": [
            {"kind": kind, "text": text, "count": number}
            for (kind, text), number in sorted(kinds.items(), key=lambda x: (-x[1], x[0]))
        ],
    }


def measure(
    name: str,
    values: np.ndarray[Any, Any],
    causes: dict[str, np.ndarray[Any, Any]],
    draped: pa.Table,
    units: dict[str, str],
) -> dict[str, Any]:
    """The figures of one measure."""
    related = {cause: correlation(x, values) for cause, x in causes.items()}
    about = spread(values) | {
        "unit": units.get(name, ""),
        "correlations": related,
        "driver": driver(related, int(np.isfinite(values).sum())),
    }
    limit = name.removeprefix("value_")
    if limit != name:
        allowed = numbers(draped, f"limit_{limit}")
        assert allowed is not None
        kept = allowed[np.isfinite(allowed)]
        about["limit"] = float(kept[0]) if kept.size and (kept == kept[0]).all() else None
        oks = [ok for ok in kept_limit(draped, limit) if ok is not None]
        about["exceeded"] = sum(not ok for ok in oks) / len(oks) if oks else None
    return about


def verdicts(draped: pa.Table) -> np.ndarray[Any, Any]:
    """Which drapes are accepted: those that say so and break no limit."""
    accepted = np.array([value is True for value in flags(draped, "accepted")], dtype=bool)
    for name in draped.column_names:
        if name.startswith("value_"):
            kept = kept_limit(draped, name.removeprefix("value_"))
            accepted &= np.array([ok is not False for ok in kept], dtype=bool)
    return accepted


def kept_limit(draped: pa.Table, limit: str) -> list[bool | None]:
    """Whether each drape keeps a limit: not with a value that is not finite; None where not judged.

    Examples
    --------
    >>> rows = {"value_slack": [0.1, math.nan, None], "ok_slack": [True, True, None]}
    >>> kept_limit(pa.table(rows), "slack")
    [True, False, None]

    """
    values = draped[f"value_{limit}"].to_pylist()
    oks = flags(draped, f"ok_{limit}") or [None] * len(values)
    return [
        ok if value is None or math.isfinite(value) else False
        for value, ok in zip(values, oks, strict=True)
    ]


def correlation(x: np.ndarray[Any, Any], y: np.ndarray[Any, Any]) -> float | None:
    """Spearman's rank correlation; None where a column is constant or has under 3 numbers.

    Examples
    --------
    >>> correlation(np.array([1.0, 2.0, 3.0]), np.array([1.0, 8.0, 27.0]))
    1.0

    """
    from scipy.stats import spearmanr

    both = np.isfinite(x) & np.isfinite(y)
    x, y = x[both], y[both]
    if x.size < 3 or constant(x) or constant(y):
        return None
    return round(float(spearmanr(x, y).statistic), 12)


def constant(x: np.ndarray[Any, Any]) -> bool:
    """Whether all numbers are the same but for rounding: its ranks would be noise."""
    return bool(np.ptp(x) <= 1e-12 * np.abs(x).max())


def chance(count: int) -> float:
    """The rank correlation that independent numbers exceed once in twenty times."""
    return 1.0 if count < 3 else min(1.0, Z / math.sqrt(count - 1))


def driver(related: dict[str, float | None], count: int) -> str | None:
    """The input with the strongest correlation, if that is more than chance."""
    known = {name: abs(rho) for name, rho in related.items() if rho is not None}
    if not known:
        return None
    name = max(known, key=lambda key: known[key])
    return name if known[name] > chance(count) else None


def spread(values: np.ndarray[Any, Any] | None) -> dict[str, Any]:
    """Mean and percentiles; empty of no numbers."""
    if values is None or not np.isfinite(values).any():
        return {}
    values = values[np.isfinite(values)]
    percentiles = np.percentile(values, QUANTILES)
    # Scaled, since the sum of the largest numbers overflows.
    scale = float(np.abs(values).max()) if np.abs(values).max() > 1e290 else 1.0
    mean = (values / scale).mean() * scale
    return {
        "count": int(values.size),
        "mean": float(mean),
        "percentiles": {str(q): float(p) for q, p in zip(QUANTILES, percentiles, strict=True)},
    }


def pattern(text: str) -> str:
    """An error's text without its numbers, so that the same trouble counts as one.

    Examples
    --------
    >>> pattern("grippers g0_0 and g1_0 are 100.2 mm apart")
    'grippers g·_· and g·_· are · mm apart'

    """
    import re

    text = re.sub(r"\bg\d+_\d+\b", "g·_·", text)
    return re.sub(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.]*\d)", "·", text)


def numbers(rows: pa.Table, name: str) -> np.ndarray[Any, Any] | None:
    """A column as floats, nan where empty; booleans as 0 and 1; None of a column of text."""
    if name not in rows.column_names:
        return None
    column = rows[name]
    if pa.types.is_string(column.type) or pa.types.is_null(column.type):
        return None
    values = [np.nan if value is None else float(value) for value in column.to_pylist()]
    return np.array(values, dtype=float)


def flags(rows: pa.Table, name: str) -> list[bool | None]:
    """A column of booleans."""
    return rows[name].to_pylist() if name in rows.column_names else []


def listed(rows: pa.Table, name: str) -> list[Any]:
    """A column as a list."""
    return rows[name].to_pylist()  # type: ignore[no-any-return, unused-ignore]
