"""Scores a motion of the grippers on one of the published scenes, by a complete drape of plydrape.

    python benches/instance/score.py dome_paper my_motion.csv

The motion is a table like the ``motion.csv`` of the scene: time, gripper, and the place where the
robot holds it. It starts where ours starts. What is printed are the figures of the drape beside
ours. The binary is $PLYDRAPE, or else the release build, or else the one on the path.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
NAMES = sorted(path.parent.name for path in HERE.glob("*/scene.toml"))

START = 1e-4
"""How far from ours a motion may start (m)."""

SHOWN = {
    "accepted": "accepted, without errors",
    "cells": "cells with errors that are accepted",
    "height_mm": "largest height at the end (mm)",
    "height_share": "share of the area over the limit of the height",
    "height_rms_mm": "height, root of the mean square (mm)",
    "out_of_plane_deg": "largest slope out of the mold (°)",
    "position_mm": "largest error of position (mm)",
    "fiber_angle_deg": "largest error of the fiber angle (°)",
    "shear_deg": "largest shear on the way (°)",
    "gripper_force_n": "largest force on a cup (N)",
    "duration_s": "time (s)",
}
"""The figures, the first of which counts first."""


def places(path: Path) -> dict[tuple[float, str], list[float]]:
    """Where each gripper is held (m) at each time (s)."""
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]
    return {(float(row[0]), row[1]): [float(x) for x in row[2:5]] for row in rows}


def check_start(name: str, motion: Path) -> None:
    """Ends the program if a motion starts elsewhere than ours."""
    ours, theirs = places(HERE / name / "motion.csv"), places(motion)
    first = [min(time for time, _ in found) for found in (ours, theirs)]
    for (time, gripper), place in ours.items():
        if time > first[0]:
            continue
        other = theirs.get((first[1], gripper))
        if other is None or max(abs(a - b) for a, b in zip(place, other, strict=True)) > START:
            raise SystemExit(f"{gripper} does not start at {place} m, where ours starts")


def program() -> str:
    """The binary."""
    built = HERE.parents[1] / "target" / "release" / "plydrape"
    found = os.environ.get("PLYDRAPE") or (str(built) if built.is_file() else None)
    found = found or shutil.which("plydrape")
    if found is None:
        raise SystemExit("there is no plydrape: set $PLYDRAPE to it")
    return found


def drape(name: str, motion: Path, folder: Path, with_errors: bool = False) -> dict[str, Any]:
    """The figures of a scene's drape along a motion; the result is left in a folder."""
    shutil.copy(HERE / name / "scene.toml", folder / "scene.toml")
    shutil.copy(motion, folder / "motion.csv")
    command = [program(), "simulate", str(folder / "scene.toml"), "-o", str(folder / "out")]
    command += ["--json"] if with_errors else ["--json", "--without-errors"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    # a motion that is not accepted, and one that was not draped to its end, have figures too
    if not done.stdout:
        raise SystemExit(done.stderr)
    summary = json.loads(done.stdout)
    found = {**summary["worst"], **{key: summary[key] for key in SHOWN if key in summary}}
    final = ("height_mm", "out_of_plane_deg", "position_mm", "fiber_angle_deg")
    found |= {key: summary["final"][key] for key in final}
    complete = summary["status"] == "converged"
    found["accepted"] = complete and all(row["ok"] for row in summary["limits"])
    cells = (summary.get("sample") or {}).get("cells") if with_errors else None
    found["cells"] = cells and [sum(cell["accepted"] for cell in cells), len(cells)]
    figures: dict[str, Any] = {key: rounded(found.get(key)) for key in SHOWN}
    keys = ("name", "value", "limit", "unit", "ok")
    figures["limits"] = [{key: rounded(row[key]) for key in keys} for row in summary["limits"]]
    return figures


def rounded(value: Any) -> Any:
    """A number in five digits."""
    return float(f"{value:.5g}") if isinstance(value, float) else value


def table() -> str:
    """Our figures of all scenes, as the guide shows them."""
    shown = [key for key in SHOWN if key not in ("height_rms_mm", "shear_deg")]
    lines = ["| scene | " + " | ".join(SHOWN[key] for key in shown) + " |"]
    lines.append("|---" * (len(shown) + 1) + "|")
    for name in NAMES:
        ours = json.loads((HERE / name / "figures.json").read_text())
        texts = [text(ours[key]) for key in shown]
        lines.append(f"| `{name}` | " + " | ".join(texts) + " |")
    return "\n".join(lines) + "\n"


def text(value: Any) -> str:
    """A figure with three digits."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        return "{} of {}".format(*value)
    return "–" if value is None else f"{value:.3g}"


def main() -> None:
    """Scores one motion, or prints the table of ours."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("scene", choices=NAMES, nargs="?")
    parser.add_argument("motion", type=Path, nargs="?")
    parser.add_argument(
        "--with-errors", action="store_true", help="drape cells with the scene's errors too"
    )
    parser.add_argument("--json", action="store_true", help="print JSON instead of a table")
    parser.add_argument("--table", action="store_true", help="print the table of our figures")
    args = parser.parse_args()
    if args.table:
        sys.stdout.write(table())
        return
    if args.scene is None or args.motion is None:
        parser.error("give a scene and a motion")
    check_start(args.scene, args.motion)
    with tempfile.TemporaryDirectory() as home:
        figures = drape(args.scene, args.motion, Path(home), args.with_errors)
    if args.json:
        print(json.dumps(figures, indent=1))
        return
    ours = json.loads((HERE / args.scene / "figures.json").read_text())
    print(f"{'':48} {'yours':>10} {'ours':>10}")
    for key, label in SHOWN.items():
        print(f"{label:48} {text(figures[key]):>10} {text(ours[key]):>10}")
    for row in figures["limits"]:
        if not row["ok"]:
            print(f"not kept: {row['name']} {row['value']} {row['unit']}, limit {row['limit']}")


if __name__ == "__main__":
    main()
