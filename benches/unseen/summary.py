"""Tables of plans of random scenes, in Markdown."""

from __future__ import annotations

import statistics
from collections import Counter

Row = dict[str, str]

ACCEPTED, FAILED, LATE = "accepted", "failed", "out of time"

COLUMNS = ("family", "size", "ply", "material", "friction", "start")
"""By which scenes are counted."""


def markdown(head: list[str], rows: list[list[str]]) -> str:
    """A table; nothing where there is no row."""
    lines = [head, ["---"] * len(head), *rows] if rows else []
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def share(rows: list[Row]) -> str:
    """How many of some scenes are accepted."""
    return f"{sum(row['result'] == ACCEPTED for row in rows)}/{len(rows)}"


def middle(rows: list[Row], column: str, digits: int) -> str:
    """Median of a column."""
    values = [float(row[column]) for row in rows if row[column]]
    return f"{statistics.median(values):.{digits}f}" if values else ""


def largest(rows: list[Row], column: str, digits: int) -> str:
    """Largest value of a column."""
    values = [float(row[column]) for row in rows if row[column]]
    return f"{max(values):.{digits}f}" if values else ""


def groups(rows: list[Row], column: str) -> str:
    """Share and times by the values of a column, and of all scenes."""
    names = list(dict.fromkeys(row[column] for row in rows))
    if column != "size":
        names.sort()
    parts = [(name, [row for row in rows if row[column] == name]) for name in names]
    head = [column, "accepted", "median (s)", "worst (s)", "median drapes", "memory (MB)"]
    return markdown(
        head,
        [
            [
                name,
                share(group),
                middle(group, "time (s)", 1),
                largest(group, "time (s)", 1),
                middle(group, "drapes", 0),
                largest(group, "memory (MB)", 0),
            ]
            for name, group in [*parts, ("all", rows)]
        ],
    )


def tables(rows: list[Row]) -> str:
    """All tables of some rows."""
    refused = [row for row in rows if row["result"] not in (ACCEPTED, FAILED)]
    failed = [row for row in rows if row["result"] == FAILED]
    text = f"{share(rows)} scenes accepted\n"
    text += "".join(f"\n{groups(rows, column)}" for column in COLUMNS)
    stopped = Counter(
        row["result"] if row["result"] == LATE else row["limit"] or row["result"] for row in refused
    )
    if refused:
        text += "\nWhat stopped the others: "
        text += ", ".join(f"{limit} {count}" for limit, count in stopped.most_common()) + "\n\n"
    text += markdown(
        [
            *("scene", "family", "grippers", "start", "result", "height (mm)", "cells"),
            *("limit", "value", "allowed", "helps", "time (s)"),
        ],
        [
            [
                *(row[name] for name in ("scene", "family", "grippers", "start", "result")),
                row["height (mm)"],
                row["cells"],
                f"{row['limit']}, {row['where']}" if row["where"] else row["limit"],
                f"{row['value']} {row['unit']}".strip(),
                f"{row['allowed']} {row['unit']}".strip(),
                row.get("helps", ""),
                row["time (s)"],
            ]
            for row in refused
        ],
    )
    if failed:
        text += "\nFailed:\n\n" + markdown(
            ["scene", "family", "grippers", "exit", "message"],
            [
                [row[name] for name in ("scene", "family", "grippers", "exit", "message")]
                for row in failed
            ],
        )
    return text
