"""What a study shows: how each measure is distributed, what drives it, how many are accepted.

The share of accepted drapes has Wilson's interval; what drives a measure is found by Spearman's
rank correlation, which sees any steady rise or fall, straight or not. A correlation smaller than
1.96/√(n − 1) is what independent numbers show by chance once in twenty times, and names no driver.
"""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa

Numbers = np.ndarray[Any, Any]

# Normal quantile of a two-sided 95 % interval.
Z = 1.959963984540054
QUANTILES = (0, 5, 25, 50, 75, 95, 100)
# Columns that are no measures.
ASIDE = ("scenario", "seed", "version", "error", "error_kind")
# Names of grippers and numbers, which differ between errors of the same kind.
VARYING = r"\bg\d+_\d+\b|(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.]*\d)"


def summary(rows: pa.Table, inputs: list[str]) -> dict[str, Any]:
    """All figures of a study as plain JSON values.

    Parameters
    ----------
    rows : pa.Table
        Rows of a study.
    inputs : list of str
        Its columns that are inputs.

    """
    metadata = {field.name: field.metadata or {} for field in rows.schema}
    units = {name: about.get(b"unit", b"").decode() for name, about in metadata.items()}
    frame = rows.to_pandas()
    draped = frame[frame["error"].isna()]
    accepted = verdicts(draped)
    hits, count = int(accepted.sum()), len(draped)
    causes = {name: x for name in inputs if (x := numbers(draped[name])) is not None}
    measures = {}
    for name in draped.columns:
        if name in inputs or name in ASIDE or name.startswith(("limit_", "margin_", "ok_")):
            continue
        values = accepted.astype(float) if name == "accepted" else numbers(draped[name])
        if values is None or not np.isfinite(values).any():
            continue
        related = {cause: correlation(x, values) for cause, x in causes.items()}
        measures[name] = spread(values) | {
            "unit": units[name],
            "correlations": related,
            "driver": driver(related, int(np.isfinite(values).sum())),
        }
        if name.startswith("value_"):
            measures[name] |= judged(draped, name.removeprefix("value_"))
    return {
        "scenarios": len(frame),
        "draped": count,
        "failed": len(frame) - count,
        "accepted": {
            "count": hits,
            "share": hits / count if count else None,
            "interval": wilson(hits, count),
        },
        "chance": chance(count),
        "inputs": {name: {"unit": units[name]} | spread(numbers(frame[name])) for name in inputs},
        "measures": measures,
        "errors": troubles(frame[frame["error"].notna()]),
    }


def wilson(hits: int, count: int) -> tuple[float, float] | None:
    """Wilson's 95 % interval of a share; None of nothing.

    Examples
    --------
    >>> [round(x, 4) for x in wilson(5, 10)]
    [0.2366, 0.7634]

    """
    from scipy import stats

    if count == 0:
        return None
    interval = stats.binomtest(hits, count).proportion_ci(method="wilson")
    return float(interval.low), float(interval.high)


def verdicts(draped: pd.DataFrame) -> Numbers:
    """Which drapes are accepted: those that say so and break no limit."""
    if "accepted" not in draped:  # All scenarios failed.
        return np.zeros(len(draped), bool)
    accepted = (draped["accepted"] == True).to_numpy(bool)  # noqa: E712  None is not accepted
    for name in draped.columns:
        if name.startswith("value_"):
            accepted = accepted & (kept(draped, name.removeprefix("value_")) != 0.0)
    return accepted


def kept(draped: pd.DataFrame, limit: str) -> Numbers:
    """1 where a drape keeps a limit, 0 where not or where its value is not finite; else nan.

    Examples
    --------
    >>> import pandas as pd
    >>> kept(pd.DataFrame({"value_slack": [0.1, np.inf], "ok_slack": [True, True]}), "slack")
    array([1., 0.])

    """
    oks = draped[f"ok_{limit}"].to_numpy(float)
    values = draped[f"value_{limit}"].to_numpy(float)
    # A value that is not a number is empty in a row that is not judged, or that says it keeps it.
    return np.where(np.isfinite(values) | np.isnan(oks), oks, 0.0)


def judged(draped: pd.DataFrame, limit: str) -> dict[str, Any]:
    """The limit, if all drapes have the same, and the share of those that exceed it."""
    allowed = numbers(draped[f"limit_{limit}"])
    assert allowed is not None
    allowed = np.unique(allowed[np.isfinite(allowed)])
    oks = kept(draped, limit)
    oks = oks[~np.isnan(oks)]
    return {
        "limit": float(allowed[0]) if allowed.size == 1 else None,
        "exceeded": float((oks == 0.0).mean()) if oks.size else None,
    }


def correlation(x: Numbers, y: Numbers) -> float | None:
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


def constant(x: Numbers) -> bool:
    """Whether all numbers are the same but for rounding: its ranks would be noise."""
    return bool(np.ptp(x) <= 1e-12 * np.abs(x).max())


def chance(count: int) -> float:
    """The rank correlation that independent numbers exceed once in twenty times."""
    return 1.0 if count < 3 else min(1.0, Z / math.sqrt(count - 1))


def driver(related: dict[str, float | None], count: int) -> str | None:
    """The input with the strongest correlation, if that is more than chance."""
    known = {name: abs(rho) for name, rho in related.items() if rho is not None}
    name = max(known, key=lambda key: known[key], default=None)
    return name if name is not None and known[name] > chance(count) else None


def spread(values: Numbers | None) -> dict[str, Any]:
    """Mean and percentiles; empty of no numbers."""
    if values is None or not np.isfinite(values).any():
        return {}
    values = values[np.isfinite(values)]
    percentiles = np.percentile(values, QUANTILES)
    return {
        "count": int(values.size),
        # Divided first, since the sum of the largest numbers overflows.
        "mean": float((values / values.size).sum()),
        "percentiles": {str(q): float(p) for q, p in zip(QUANTILES, percentiles, strict=True)},
    }


def troubles(failed: pd.DataFrame) -> list[dict[str, Any]]:
    """Errors and how often they came, most often first; without numbers, so that like ones meet."""
    texts = failed["error"].astype(str).str.replace(VARYING, "·", regex=True)
    counts = Counter(zip(failed["error_kind"], texts, strict=True))
    found = [{"kind": kind, "text": text, "count": n} for (kind, text), n in counts.items()]
    return sorted(found, key=lambda trouble: (-trouble["count"], trouble["kind"], trouble["text"]))


def numbers(column: pd.Series[Any]) -> Numbers | None:
    """A column as floats, nan where empty; booleans as 0 and 1; None of a column of text."""
    try:
        return column.to_numpy(float)
    except (TypeError, ValueError):
        return None
