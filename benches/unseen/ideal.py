"""The ideal drape of a scene as `plydrape net` finds it, and whether it is a fair task."""

from __future__ import annotations

import csv
import json
import math
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from molds import Height
from plies import Array

MAX_SHEAR_DEG = 30.0
"""Largest shear of an ideal drape (degrees)."""

MAX_TILT_DEG = 30.0
"""Largest tilt of a gripper at its target (degrees); its joint tilts by 40."""

STEP = 5e-4
"""Step of the differences that give a slope (m)."""

FOLDS = "touch the mold first, and stick short of their places"
"""What `check` says of a ply whose edge hangs too far over on a mold that sticks."""

SPRINGS_BACK = "the ply springs back"
"""What `check` says of a ply that does not stay where it is laid, whatever the motion."""

SLIDES = "let go of: the ply slides"
"""What it says of a ply that does not stay on a slope."""

IN_CELLS = "cells of the sample"
"""What it says as well if the nominal ply stays, and too many plies of the sample do not."""

CRASH = 101
"""Exit code of a program that panics."""


class RefusedError(Exception):
    """A draw that is no fair task, with the reason."""


@dataclass(frozen=True)
class Drape:
    """Where everything should end."""

    shear_deg: float
    """Largest shear of a cell."""
    tilt_deg: float
    """Largest angle of the mold to the plane at a gripper."""
    middle: tuple[float, float]
    """Mean place x, y of the grippers (m)."""
    bottom: float
    """Height of its lowest point (m)."""
    top: float
    """Height of its highest point (m)."""


class Plydrape:
    """The program that judges scenes."""

    def __init__(self, program: Path) -> None:
        """Of the program's file."""
        self.program = program

    def run(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Runs it; above exit code 1 the scene is refused, and why is printed.

        A program that crashes is no judge: its scene is not drawn again.
        """
        command = [str(self.program), *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode < 0 or done.returncode == CRASH:
            raise RuntimeError(f"{' '.join(command)} crashed:\n{done.stderr}")
        if done.returncode > 1:
            sys.stderr.write(done.stderr)
            raise RefusedError(f"exit {done.returncode} of {arguments[0]}")
        return done

    def check(self, scene: Path, *, may_fold: bool) -> None:
        """Refuses what `check` refuses, and what it says no motion lays flat.

        It may warn of straight ways, which no plan follows.
        """
        warnings = json.loads(self.run("check", str(scene), "--json").stdout)["warnings"]
        if not may_fold and any(FOLDS in warning for warning in warnings):
            raise RefusedError("an edge folds")
        if any(SLIDES in warning for warning in warnings):
            raise RefusedError("slides")
        springs_back = [warning for warning in warnings if SPRINGS_BACK in warning]
        if any(IN_CELLS in warning for warning in springs_back):
            raise RefusedError("springs back in the stiffest cells")
        if springs_back:
            raise RefusedError("springs back")

    def drape(self, scene: Path, ply: Array | None, height: Height) -> Drape:
        """The ideal drape; refused if there is none, or if it shears or tilts too much."""
        folder = scene.with_suffix(".net")
        done = self.run("net", str(scene), "-o", str(folder), "--json")
        if done.returncode == 1:
            raise RefusedError("no ideal drape")
        drape = read(folder / "nodes.csv", json.loads(done.stdout), ply, height)
        if drape.shear_deg > MAX_SHEAR_DEG:
            raise RefusedError("shear")
        if drape.tilt_deg > MAX_TILT_DEG:
            raise RefusedError("tilt")
        return drape


def read(table: Path, printed: dict[str, float], ply: Array | None, height: Height) -> Drape:
    """The ideal drape from its nodes; every gripper of an array holds one of them.

    Of a ply that is cut any node on it may be under a gripper; the net goes on around it.
    """
    heights, grippers = [], []
    with table.open(newline="") as file:
        for row in csv.DictReader(file):
            if row["on_ply"] == "0":
                continue
            heights.append(float(row["z"]))
            cells = [
                float(row[axis]) / side
                for axis, side in zip("uv", ply.cell if ply else (), strict=False)
            ]
            if all(abs(share - round(share)) < 1e-6 for share in cells):
                grippers.append((float(row["x"]), float(row["y"])))
    assert ply is None or len(grippers) == ply.grippers[0] * ply.grippers[1]
    x, y = (sum(axis) / len(grippers) for axis in zip(*grippers, strict=True))
    return Drape(
        shear_deg=printed["max_shear_deg"],
        tilt_deg=max(slope(height, place) for place in grippers),
        middle=(x, y),
        bottom=min(heights),
        top=max(heights),
    )


def slope(height: Height, place: tuple[float, float]) -> float:
    """Angle of a mold to the plane over a place (degrees), by central differences."""
    x, y = place
    along = height(x + STEP, y) - height(x - STEP, y), height(x, y + STEP) - height(x, y - STEP)
    return math.degrees(math.atan2(math.hypot(*along), 2.0 * STEP))
