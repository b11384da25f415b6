"""Tables: starts, motions and height grids as CSV, in scenes that read them."""

from __future__ import annotations

import math
from random import Random
from typing import Any

from . import case, scene, toml, values
from .case import Files, Kind

Rows = list[list[str]]


def csv(rows: Rows, mark: str = ",") -> bytes:
    """Rows as a file."""
    return "".join(mark.join(row) + "\n" for row in rows).encode()


def start(rng: Random) -> Rows:
    """Where 3 × 2 grippers start."""
    grid = [(i, j) for j in range(2) for i in range(3)]
    rows = [[str(i), str(j), f"{98 * i}", f"{98 * j}", "75"] for i, j in grid]
    return [["i", "j", "x (mm)", "y (mm)", "z (mm)"], *rows]


def motion(rng: Random) -> Rows:
    """Four steps of 3 × 2 grippers, from above onto the mold."""
    head = ["t (s)", "gripper", "x (m)", "y (m)", "z (m)", "qx", "qy", "qz", "qw"]
    level = ["0", "0", "0", "1"]
    rows = [
        [
            str(t),
            f"{i}-{j}",
            f"{0.099 * i:.4f}",
            f"{0.099 * j:.4f}",
            f"{0.06 - 0.02 * t:.4f}",
            *level,
        ]
        for t in range(4)
        for j in range(2)
        for i in range(3)
    ]
    kept = 9 if rng.random() < 0.5 else 5
    return [row[:kept] for row in [head, *rows]]


def heights(rng: Random) -> Rows:
    """A shallow bowl over a square of 0.6 m."""
    axis = range(-200, 401, 100)
    rows = [[str(x), str(y), f"{1e-4 * math.hypot(x, y) ** 2:.3f}"] for y in axis for x in axis]
    return [["x (mm)", "y (mm)", "z (mm)"], *rows]


TABLES = {"start.csv": start, "motion.csv": motion, "heights.csv": heights}


def files(rng: Random) -> Files:
    """A scene that reads one of the tables."""
    name = rng.choice(sorted(TABLES))
    table: dict[str, dict[str, Any]] = {
        "ply": {"grippers": [3, 2], "cell": ["100 mm", "100 mm"], "material": "krogh2018"},
        "mold": {"kind": "plane"},
        "grippers": {"spacing": ["98 mm", "98 mm"], "height": "75 mm"},
        "target": {"shear": "5 deg"},
        "motion": {"kind": "straight", "steps": 4},
        "plan": scene.PLAN,
    }
    match name:
        case "start.csv":
            table["grippers"] = {"positions": name}
        case "motion.csv":
            table["motion"] = {"kind": "file", "file": name}
            del table["grippers"]
        case _:
            table["mold"] = {"kind": "height-grid", "file": name}
            table["grippers"] = {**table["grippers"], "height": "120 mm"}
    return {scene.NAME: toml.text(table).encode(), name: csv(TABLES[name](rng))}


def change(rng: Random, files: Files) -> str:
    """Changes a cell, a column, a row, a unit, or how cells are set apart."""
    name = next(name for name in files if name.endswith(".csv"))
    content = files[name]
    if isinstance(content, case.Odd):
        return "no table to change"
    rows = [line.split(",") for line in content.decode(errors="replace").splitlines()] or [[""]]
    what, mark = changed(rng, rows), ","
    if rng.random() < 0.05:
        mark = rng.choice((";", "\t", " ", ", ", "|", '","'))
        what += f", cells apart by {mark!r}"
    files[name] = csv(rows, mark)
    return f"{name}: {what}"


def changed(rng: Random, rows: Rows) -> str:
    """Changes the rows in place; says how."""
    row, column = rng.randrange(len(rows)), rng.randrange(max(len(rows[0]), 1))
    cell = [r[column] for r in rows[1:] if column < len(r)]
    match rng.randrange(10):
        case 0:
            del rows[row]
            return f"row {row} is gone"
        case 1:
            rows.append(list(rows[row]))
            return f"row {row} is there again"
        case 2:
            other = rng.randrange(len(rows))
            rows[row], rows[other] = rows[other], rows[row]
            return f"rows {row} and {other} are swapped"
        case 3:
            rows[0][column:column] = [rng.choice(("extra", "x (m)", "t (s)", "", "gripper", "i"))]
            return f"a column more at {column}"
        case 4:
            for r in rows:
                del r[column : column + 1]
            return f"column {column} is gone"
        case 5:
            unit = rng.choice(values.UNITS)
            rows[0] = [
                f"{c.split(' (')[0]} ({unit})" if n == column else c for n, c in enumerate(rows[0])
            ]
            return f"column {column} is in {unit!r}"
        case 6 if cell:
            for r in rows[1:]:
                r[column : column + 1] = [cell[0]]
            return f"column {column} is {cell[0]} everywhere"
        case 7 if cell:
            factor = values.number(rng)
            for r in rows[1:]:
                r[column : column + 1] = [scaled(c, factor) for c in r[column : column + 1]]
            return f"column {column} times {factor!r}"
        case _:
            content = rng.choice(
                (repr(values.number(rng)), values.text(rng), "0-9", "9-9", "-1", "1e5000")
            )
            rows[row][column : column + 1] = [content]
            return f"row {row}, column {column} is {content!r:.40}"


def scaled(cell: str, factor: float) -> str:
    """A cell times a factor, if it is a number."""
    try:
        return repr(float(cell) * factor)
    except (ValueError, OverflowError):
        return cell


KIND = Kind(
    files=files,
    mutations=((10, change), (1, scene.change), (3, case.damage(".csv")), (0.3, case.odd_file)),
    commands=scene.COMMANDS,
)
