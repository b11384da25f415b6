"""A plan with a pick-up is the whole cycle: pads come to the ply, lift it, lay it, and leave."""

from __future__ import annotations

import csv
import json
import os
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from program import ROOT, run

Array = NDArray[np.float64]

TABLE = 0.02
CLEARANCE = 0.05
RETREAT = 0.02
CENTER = np.array([0.0, 0.0, -1.0])


@dataclass
class Motion:
    """What ``motion.csv`` says, by time and gripper."""

    times: Array
    places: Array
    vacuum: Array


def read(path: Path) -> Motion:
    """Reads a motion as anybody would."""
    with path.open() as file:
        rows = list(csv.DictReader(file))
    times = np.array(sorted({float(row["t (s)"]) for row in rows}))
    count = len(rows) // len(times)
    columns = ("x (m)", "y (m)", "z (m)")
    places = np.array([[float(row[c]) for c in columns] for row in rows])
    vacuum = np.array([int(row["vacuum"]) for row in rows])
    return Motion(times, places.reshape(-1, count, 3), vacuum.reshape(-1, count))


def planned(name: str, folder: Path) -> Path:
    """The plan of an example, which the tests before these have made, or these do."""
    made = Path(os.environ.get("PLYDRAPE_EXAMPLES", folder)) / f"{name}.plan"
    if not made.is_dir():
        made = folder / f"{name}.plan"
        scene = ROOT / "examples" / name / "scene.toml"
        run("plan", str(scene), "-o", str(made), "--quiet", "--without-errors")
    return made


@pytest.fixture(scope="module")
def plan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The plan of the example with one robot."""
    return planned("17_robot", tmp_path_factory.mktemp("plans"))


def times(plan: Path) -> dict[str, float]:
    """When the vacuum of the first gripper does what."""
    events = json.loads((plan / "result.json").read_text())["summary"]["events"]
    return {event["kind"]: event["time"] for event in events}


def test_pads_stand_on_the_flat_ply_when_the_vacuum_goes_on(plan: Path) -> None:
    """On the table, as far apart as the fabric between them is long, for the time of the grip."""
    motion, at = read(plan / "motion.csv"), times(plan)
    standing = (motion.times >= at["grip"]) & (motion.times <= at["grip"] + 0.49)
    assert standing.sum() > 40
    first, last = motion.places[standing][0], motion.places[standing][-1]
    assert np.abs(last - first).max() < 1e-9
    assert np.abs(first[:, 2] - TABLE).max() < 1e-6
    # g0_0, g1_0, ... run along u first, 4 of them, then 3 rows along v
    grid = first.reshape(3, 4, 3)
    for axis in (0, 1):
        apart = np.linalg.norm(np.diff(grid, axis=axis), axis=2)
        assert np.abs(apart - 0.1).max() < 1e-6
    # they came straight down
    way = first - motion.places[0]
    assert np.abs(way - [0.0, 0.0, -CLEARANCE]).max() < 1e-6
    assert not motion.vacuum[motion.times < at["grip"] - 1e-9].any()
    assert motion.vacuum[
        (motion.times > at["grip"] + 1e-9) & (motion.times < at["release"] - 1e-9)
    ].all()


def test_pads_leave_along_the_normals_of_the_mold(plan: Path) -> None:
    """Nothing holds the ply when they do, and they end above the mold; the mold is a sphere."""
    motion, at = read(plan / "motion.csv"), times(plan)
    leaving = motion.times > at["release"] + 1e-9
    assert leaving.sum() > 20
    assert not motion.vacuum[leaving].any()
    before = motion.places[motion.times <= at["release"]][-1]
    normals = (before - CENTER) / np.linalg.norm(before - CENTER, axis=1)[:, None]
    ways = motion.places[leaving] - before
    along = np.einsum("tgc,gc->tg", ways, normals)
    aside = np.linalg.norm(ways - along[:, :, None] * normals, axis=2)
    near = (along > 1e-3) & (along < 0.3 * RETREAT)
    assert near.any()
    assert (aside[near] / along[near]).max() < np.tan(np.radians(2))
    assert (along[-1] > 0.9 * RETREAT).all()
    up = motion.places[-1] - before - RETREAT * normals
    assert np.abs(up - [0.0, 0.0, CLEARANCE]).max() < 1e-3


def test_the_whole_cycle_keeps_its_speed(plan: Path) -> None:
    """By differences of the written samples: that of the scene on the way down and on the mold."""
    motion, at = read(plan / "motion.csv"), times(plan)
    steps = np.diff(motion.times)[:, None, None]
    speed = np.linalg.norm(np.diff(motion.places, axis=0) / steps, axis=2).max(axis=1)
    before = motion.times[1:] <= at["grip"]
    after = motion.times[:-1] >= at["press"]
    assert before.any()
    assert after.any()
    assert speed[before | after].max() <= 0.25 * 1.001
    # the transport may be faster, and is
    assert 0.3 < speed.max() <= 1.0 * 1.001


def test_the_sheet_lies_on_its_table_and_leaves_it(plan: Path) -> None:
    """It is flat there, and no cup carries it; after the lift all of it hangs from the cups."""
    result = json.loads((plan / "result.json").read_text())
    lifted = result["scene"]["pick_up"]["lift_steps"]
    with (plan / "trajectory.csv").open() as file:
        rows = list(csv.DictReader(file))
    moments = sorted({float(row["t (s)"]) for row in rows})
    assert moments[0] == pytest.approx(times(plan)["grip"] + 0.5)

    def loads(step: int) -> Array:
        own = [row for row in rows if float(row["t (s)"]) == moments[step]]
        return np.array([[float(row[f"load {c} (N)"]) for c in "xyz"] for row in own])

    weight = 0.3143 * 9.81 * 0.3 * 0.2
    assert np.linalg.norm(loads(0), axis=1).max() < 0.01 * weight
    # the ply is on its way and swings a little
    assert 0.8 < -loads(lifted)[:, 2].sum() / weight < 1.3
    limits = {limit["name"]: limit for limit in result["summary"]["limits"]}
    gap = limits["table_gap"]
    assert gap["ok"]
    assert gap["step"] == lifted + 1
    assert 5.0 < gap["value"] < 40.0


def test_robot_programs_grip_where_the_arm_stands_on_the_ply(plan: Path, tmp_path: Path) -> None:
    """In the order of a cell, and with the inputs of the vacuum where the scene waits for them."""
    for robot, expected in {
        "rapid": (
            r"SetDO vac_g0_0,1",
            r"WaitDI vac_ok_g0_0,1",
            r"WaitTime 0\.4",
            r"SetDO vac_g0_0,0",
            r"MoveL",
        ),
        "krl": (
            r"VAC_G0_0=TRUE",
            r"WAIT FOR VAC_OK_G0_0 OR",
            r"WAIT SEC 0\.4",
            r"VAC_G0_0=FALSE",
            r"SPL ",
        ),
        "urscript": (
            r"vac_g0_0_\w+\(True\)",
            r"while not vac_ok_g0_0",
            r"sleep\(0\.4",
            r"vac_g0_0_\w+\(False\)",
            r"go_ply",
        ),
    }.items():
        run(
            "export",
            str(plan / "result.json"),
            "--to",
            robot,
            "-o",
            str(tmp_path / robot),
            "--even-if-rejected",
            "--quiet",
        )
        files = (tmp_path / robot).glob("*.*")
        (text,) = [
            f.read_text()
            for f in files
            if f.suffix in (".mod", ".src", ".script") and "_cell" not in f.stem
        ]
        places: list[int] = []
        begin = text.index("MoveAbsJ") if robot == "rapid" else 0
        for pattern in expected:
            found = re.compile(pattern).search(text, places[-1] if places else begin)
            assert found, (robot, pattern)
            places.append(found.start())
        # the arm moves before it grips
        moves = {"rapid": "TriggL", "krl": "SPL ", "urscript": "  go_ply"}[robot]
        assert text.index(moves) < places[0], robot


def test_a_plan_without_a_pick_up_says_that_it_begins_in_the_air(
    plan: Path, tmp_path: Path
) -> None:
    """In the words of its verdict, where one that has it does not."""
    words = "the ply begins in the air"
    for folder, begins in ((plan, False), (planned("04_dome", tmp_path), True)):
        data = json.loads((folder / "result.json").read_text())
        assert ("pick_up" in data["scene"]) is not begins
        page = (folder / "report.html").read_text()
        assert (words in page) is begins


def test_a_replanned_cycle_comes_to_the_ply_where_it_lies(plan: Path, tmp_path: Path) -> None:
    """The way down is moved with the ply; the departure stays where it was."""
    offset = tmp_path / "offset.toml"
    offset.write_text('[offset]\nx = "4 mm"\ny = "-3 mm"\n')
    moved = tmp_path / "moved"
    run("replan", str(plan / "result.json"), "--picked", str(offset), "-o", str(moved), "--quiet")
    planned, again = read(plan / "motion.csv"), read(moved / "motion.csv")
    assert np.abs(again.places[0] - planned.places[0] - [0.004, -0.003, 0.0]).max() < 1e-6
    assert np.abs(again.places[-1] - planned.places[-1]).max() < 1e-6
    grip = times(moved)["grip"]
    standing = again.places[(again.times >= grip) & (again.times <= grip + 0.49)]
    assert np.abs(standing - standing[0]).max() < 1e-6


def test_a_plan_with_a_pick_up_can_be_followed(plan: Path) -> None:
    """Its steps begin after the way to the ply, and a followed motion with the first of them."""
    from plydrape.study import Study
    from plydrape.study.run import run as study

    made = Study.of(
        {
            "scene": str(ROOT / "examples" / "17_robot" / "scene.toml"),
            "command": "follow",
            "plan": str(plan / "result.json"),
            "samples": 1,
            "vary": {"limits.height": {"values": ["1 mm"]}},
        }
    )
    [row] = study(made, workers=1).table().to_pylist()
    result = json.loads((plan / "result.json").read_text())
    assert result["steps"][0]["time"] > 0.5
    assert row["error"] is None and row["steps"] == result["summary"]["steps"]
