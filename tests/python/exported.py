"""Small drapes on a ball, simulated and planned, and what `plydrape export` makes of them."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import record
from program import run

RADIUS = 0.5
DURATION = "duration = 3.3"
SCENE = f"""
title = "A ply on a ball"
[model]
kind = "catenaries"
[ply]
grippers = [4, 3]
cell = ["100 mm", "80 mm"]
material = "krogh2018"
[mold]
kind = "sphere"
radius = {RADIUS}
position = [0, 0, {-RADIUS}]
[grippers]
spacing = ["98 mm", "78 mm"]
height = "50 mm"
origin = "centered"
direction = "20 deg"
[target]
seed = "middle"
direction = "20 deg"
[motion]
kind = "straight"
steps = 12
{DURATION}
[plan]
steps = 10
evaluations = 2
"""

Numbers = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Result:
    """A folder of results and what its result file says."""

    folder: Path
    content: dict[str, Any]

    @property
    def steps(self) -> list[dict[str, Any]]:
        """Every step of the drape."""
        steps: list[dict[str, Any]] = self.content["steps"]
        return steps

    @property
    def ids(self) -> list[tuple[int, int]]:
        """Grid indices of all grippers, in the order of the file."""
        return [tuple(gripper["id"]) for gripper in self.steps[0]["grippers"]]

    def table(self, name: str) -> tuple[Numbers, Numbers]:
        """Times of a table of poses; x, y, z, qx, qy, qz, qw of all grippers at each."""
        with (self.folder / name).open(newline="") as file:
            rows = list(csv.reader(file))[1:]
        count = len(self.ids)
        assert [row[1] for row in rows[:count]] == [f"g{i}_{j}" for i, j in self.ids]
        numbers = np.array([[float(row[0]), *map(float, row[2:9])] for row in rows])
        numbers = numbers.reshape(-1, count, 8)
        return numbers[:, 0, 0], numbers[:, :, 1:]

    def export(self, kind: str, *flags: str) -> Path:
        """The files of one kind, made from the result file and the states of its sheet alone."""
        home = self.folder.parent / f"alone_{self.folder.name}_{kind}"
        home.mkdir()
        for file in (self.folder / "result.json", self.folder / "sheet.npz"):
            if file.exists():
                (home / file.name).write_bytes(file.read_bytes())
        options = ["--to", kind, "-o", str(home / kind), "--even-if-rejected", *flags]
        run("export", str(home / "result.json"), *options)
        return home / kind


def made(command: str, home: Path, text: str = SCENE) -> Result:
    """The results of a scene by `simulate` or `plan`."""
    # how long a plan takes follows from the limits of its grippers
    text = text.replace(DURATION, "") if command == "plan" else text
    (home / "scene.toml").write_text(text)
    run(command, str(home / "scene.toml"), "-o", str(home / command), "--quiet", "--without-errors")
    return Result(home / command, record.read(home / command / "result.json"))


def pieces(
    step: dict[str, Any],
) -> Iterator[tuple[dict[str, Any], dict[str, Any] | None]]:
    """Every drawn piece of every catenary: the catenary, and the span or None for its contact."""
    for line in step["catenaries"]:
        for span in line["spans"]:
            # a segment of no length has no points, and one that lies whole is drawn by its contact
            lies = span["hold"] == "lying"
            if not lies or 0.0 < span["length"] < line["length"]:
                yield line, span
        if line["contact"]:
            yield line, None
