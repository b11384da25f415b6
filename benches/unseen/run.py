"""`scripts/unseen`: plans random scenes one after the other and says how many are accepted.

Draws the scenes of a seed into a folder, unless they are there, and writes one row a scene to
plans.csv as soon as it is planned; what has a row is not planned again. Prints a line a scene, and
at the end tables in Markdown: the share accepted and the times by family, size, ply, material and
start, what stopped the others, and apart from these every scene whose program crashed, printed a
NaN or ended with another exit code than 0 or 1. With --keep they become the result in the
repository.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any

from cells import WORLDS
from ideal import Plydrape
from plies import SIZES
from scenes import Task, drawn_again, write
from summary import tables

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]

GRACE = 60.0
"""Time that a plan which is asked to end may take to write its best (s)."""


@dataclass(frozen=True)
class Run:
    """How one run of the program ended."""

    exit: int
    """Its exit code; below zero the signal that ended it."""
    late: bool
    """Whether it was asked to end because its time was over."""
    seconds: float
    memory_mb: float
    """Peak resident memory."""
    out: str
    """What it printed on standard output."""
    error: str
    """What it printed on standard error."""


def run(command: list[str], timeout: float) -> Run:
    """Runs a program, with the time and memory of that process alone; `measure.py` says how."""
    with tempfile.TemporaryDirectory() as folder:
        report, out, error = (Path(folder) / name for name in ("report.json", "out", "error"))
        measure = [sys.executable, "-I", "-S", str(Path(__file__).with_name("measure.py"))]
        with out.open("wb") as to, error.open("wb") as errors:
            subprocess.run(
                [*measure, str(report), str(timeout), str(GRACE), *command],
                stdin=subprocess.DEVNULL,
                stdout=to,
                stderr=errors,
                check=False,
            )
        texts = [file.read_bytes().decode(errors="replace") for file in (out, error)]
        if not report.is_file():
            raise RuntimeError(f"{command[0]} could not be measured:\n{texts[1]}")
        measured = json.loads(report.read_text(encoding="utf-8"))
    return Run(**measured, out=texts[0], error=texts[1])


def excess(limit: dict[str, Any]) -> float:
    """How many times the allowed a value is; above one it is exceeded."""
    value, allowed = float(limit["value"]), float(limit["limit"])
    # a limit that a larger value keeps, or a smaller one breaks, is the least that is allowed
    if limit["ok"] == (value > allowed):
        value, allowed = allowed, value
    return value / allowed if allowed else float("inf" if value else 0.0)


def worst(printed: dict[str, Any]) -> dict[str, Any]:
    """The limit that is exceeded most, without errors or else with them; or the closest one."""
    sample = printed.get("sample") or {}
    limits, with_errors = (
        [limit for limit in of.get("limits") or [] if limit["value"] is not None]
        for of in (printed, sample)
    )
    exceeded = [[limit for limit in of if not limit["ok"]] for of in (limits, with_errors)]
    return max(exceeded[0] or exceeded[1] or limits, key=excess, default={})


def cells(printed: dict[str, Any]) -> str:
    """How many of the cells with errors that were draped keep all limits."""
    draped = (printed.get("sample") or {}).get("cells") or []
    return f"{sum(cell['accepted'] for cell in draped)} of {len(draped)}" if draped else ""


def helps(printed: dict[str, Any]) -> str:
    """The change of the scene that helps most, of those that were tried."""
    helping = [tried for tried in printed.get("tried", []) if tried["helps"]]
    if not helping:
        return ""
    change, near = helping[0]["change"], helping[0]["near"]
    if isinstance(change, dict):
        change = " ".join(f"{name} {value}" for name, value in change.items())
    limit = near["limit"]
    if limit["ok"]:
        return f"{change}: {near['kept']} of {near['cells']} cells"
    return f"{change}: {limit['name']} {limit['value']:.3g} {limit['unit']}"


def row_of(scene: dict[str, str], done: Run) -> dict[str, str]:
    """The row of a scene that was planned."""
    printed: dict[str, Any] = {}
    lines = done.error.strip().splitlines()
    message = lines[0].strip() if lines else ""
    try:
        printed = json.loads(done.out)
    except json.JSONDecodeError:
        message = message or "no JSON"
    if re.search(r"\bnan\b", done.out + done.error, re.IGNORECASE):
        result, message = "failed", "NaN"
    elif done.late:
        result = "out of time"
    elif done.exit not in (0, 1) or not printed:
        result = "failed"
    else:
        result = "accepted" if printed["accepted"] and done.exit == 0 else "not accepted"
    end, limit = printed.get("final") or {}, worst(printed)

    def number(value: object, digits: int) -> str:
        return f"{value:.{digits}f}" if isinstance(value, int | float) else ""

    return {
        **scene,
        "result": result,
        "time (s)": number(done.seconds, 2),
        "drapes": number(printed.get("evaluations"), 0),
        "height (mm)": number(end.get("height_mm"), 3),
        "position (mm)": number(end.get("position_mm"), 3),
        "cells": cells(printed),
        "limit": limit.get("name", ""),
        "value": number(limit.get("value"), 3),
        "allowed": number(limit.get("limit"), 3),
        "unit": limit.get("unit", ""),
        "where": limit.get("where", ""),
        "helps": helps(printed),
        "memory (MB)": number(done.memory_mb, 0),
        "exit": str(done.exit),
        "message": message,
    }


def read(path: Path) -> list[dict[str, str]]:
    """The rows of a table."""
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def keep(text: str, command: str, drawn: str) -> None:
    """Makes tables the result in the repository, with how they were made."""
    command_of_state = ["git", "describe", "--always", "--dirty"]
    state = subprocess.run(command_of_state, cwd=ROOT, capture_output=True, text=True, check=False)
    head = f"# The last run of `scripts/unseen`\n\n`{command}`, {date.today()}, "
    head += f"{state.stdout.strip() or 'no commit'}, {os.cpu_count()} cores. {drawn}\n\n"
    (HERE / "result.md").write_text(head + text, encoding="utf-8")


def main() -> None:
    """Draws and plans the scenes of the command line."""
    parser = argparse.ArgumentParser("scripts/unseen", description=__doc__.partition("\n")[0])
    parser.add_argument("--seed", type=int, required=True, help="of all scenes")
    parser.add_argument("--count", type=int, default=100, help="number of scenes")
    parser.add_argument("--world", choices=WORLDS, default="usual", help="the cell and its plies")
    parser.add_argument("--sizes", nargs="+", choices=SIZES, default=list(SIZES), help="of arrays")
    parser.add_argument("--only", nargs="+", help="plan these numbers or families alone")
    parser.add_argument("--timeout", type=float, default=900.0, help="seconds a scene")
    parser.add_argument("--plydrape", type=Path, help="$PLYDRAPE or the release build unless given")
    parser.add_argument("-o", "--output", type=Path, help="folder of scenes and rows")
    parser.add_argument("--keep", action="store_true", help="make this the repository's result")
    options = parser.parse_args()
    program = options.plydrape or Path(os.environ.get("PLYDRAPE", ROOT / "target/release/plydrape"))
    program = program.resolve()
    if not program.is_file():
        parser.error(f"there is no program {program}: build it by `cargo build --release`")
    if options.count < 1:
        parser.error("--count is 1 or more")
    folder = options.output or ROOT / "target" / "unseen" / f"{options.world}-{options.seed}"

    # scenes do not depend on how many there are, so more of them are the same ones and others
    table, again = folder / "scenes.csv", folder / "drawn_again.txt"
    if not table.is_file() or len(read(table)) < options.count:
        task = Task(options.seed, options.sizes, options.world)
        again.write_text(
            drawn_again(options.count, write(task, options.count, folder, Plydrape(program)))
        )

    rows = read(folder / "plans.csv") if (folder / "plans.csv").is_file() else []
    planned = {row["scene"] for row in rows}
    for scene in read(table)[: options.count]:
        name = scene["scene"]
        wanted = not options.only or {name, scene["family"]} & set(options.only)
        if name in planned or not wanted:
            continue
        with tempfile.TemporaryDirectory() as results:
            command = [str(program), "plan", str(folder / f"{name}.toml"), "-o", results]
            row = row_of(scene, run([*command, "--json", "--quiet"], options.timeout))
        rows.append(row)
        with (folder / "plans.csv").open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(row))
            writer.writeheader()
            writer.writerows(rows)
        limit = f"{row['limit']} {row['value']} {row['unit']}".strip()
        parts = [row["result"], f"{row['time (s)']} s", limit]
        if row["cells"]:
            parts.append(f"{row['cells']} cells with errors keep all")
        print(f"{name} {row['family']}: {', '.join(parts)}", flush=True)
    text = tables(rows)
    print(text)
    if options.keep:
        keep(text, f"scripts/unseen {shlex.join(sys.argv[1:])}", again.read_text())


if __name__ == "__main__":
    main()
