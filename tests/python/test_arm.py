"""The joints of the arm in programs bring the flange to where the motion has it.

This is found by the URDF file and the arithmetic of these tests alone.
"""

from __future__ import annotations

import csv
import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from numpy.typing import NDArray
from program import ROOT, run
from test_pick_up import planned

Array = NDArray[np.float64]

ROBOTS = ROOT / "crates" / "plydrape-io" / "robots"
ARM = "abb_irb4600_60_205"
WORLD = {"position": [1.675, -0.424, -0.111], "yaw": np.radians(270.0)}
LIMITS = {"arm_miss", "joint_speed", "joint_margin", "arm_singularity"}


def turn(axis: Array, angle: float) -> Array:
    """A turn about an axis through the origin, after Rodrigues."""
    x, y, z = axis / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    rotation: Array = np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k
    return rotation


def frame(rotation: Array, place: Array) -> Array:
    """A placement as a matrix of four rows."""
    pose = np.eye(4)
    pose[:3, :3] = rotation
    pose[:3, 3] = place
    return pose


def part(joint: ET.Element, tag: str) -> dict[str, str]:
    """The attributes of a part of a joint."""
    found = joint.find(tag)
    assert found is not None
    return found.attrib


def fixed(origin: ET.Element | None) -> Array:
    """The placement of an ``origin``: turns about the fixed axes x, y and z, then a move."""
    numbers = {"xyz": "0 0 0", "rpy": "0 0 0"} | ({} if origin is None else dict(origin.attrib))
    place, angles = (np.array([float(n) for n in numbers[key].split()]) for key in ("xyz", "rpy"))
    x, y, z = (turn(axis, angle) for axis, angle in zip(np.eye(3), angles, strict=True))
    return frame(z @ y @ x, place)


class Arm:
    """The chain of joints of a URDF file from a link at the foot to another one."""

    def __init__(self, path: Path, foot: str = "base", end: str = "tool0") -> None:
        joints = {
            part(joint, "child")["link"]: joint
            for joint in ET.parse(path).getroot().findall("joint")
        }
        chain, link = [], end
        while link != foot:
            chain.append(joints[link])
            link = part(joints[link], "parent")["link"]
        self.chain = chain[::-1]

    def moving(self) -> list[ET.Element]:
        """The joints that turn."""
        return [joint for joint in self.chain if joint.attrib["type"] == "revolute"]

    def flange(self, angles: Array) -> Array:
        """Where the flange is."""
        pose, left = np.eye(4), list(angles)
        for joint in self.chain:
            pose = pose @ fixed(joint.find("origin"))
            if joint.attrib["type"] == "revolute":
                axis = np.array([float(n) for n in part(joint, "axis")["xyz"].split()])
                pose = pose @ frame(turn(axis, left.pop(0)), np.zeros(3))
        return pose


@pytest.fixture(scope="module")
def plan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The plan of the example with one robot."""
    return planned("17_robot", tmp_path_factory.mktemp("plans"))


def exported(plan: Path, kind: str, folder: Path) -> Path:
    """The files of a plan for a controller."""
    run("export", str(plan / "result.json"), "--to", kind, "-o", str(folder / kind), "--quiet")
    return folder / kind


def read(path: Path) -> Any:
    """A YAML file, by the reader in C: the one in Python takes seconds for a trajectory."""
    return yaml.load(path.read_text(), yaml.CSafeLoader)


def wide(folder: Path) -> tuple[Array, list[Array]]:
    """Times, and the flange in the frame of the mold, as ``*_wide.csv`` has them."""
    (path,) = folder.glob("*_wide.csv")
    with path.open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    names = list(rows[0])

    def column(key: str) -> Array:
        name = next(name for name in names if name.startswith(key))
        return np.array([float(row[name]) for row in rows])

    places = np.stack([column(f"flange {c}") for c in ("x", "y", "z")], axis=1)
    x, y, z, w = (column(f"flange q{c}") for c in ("x", "y", "z", "w"))
    poses = []
    for n, place in enumerate(places):
        axis, sine = np.array([x[n], y[n], z[n]]), np.linalg.norm([x[n], y[n], z[n]])
        rotation = np.eye(3) if sine == 0 else turn(axis, 2 * np.arctan2(sine, w[n]))
        poses.append(frame(rotation, place))
    return column("t (s)"), poses


def test_one_trajectory_of_arm_and_axes_brings_the_flange_to_its_poses(
    plan: Path, tmp_path: Path
) -> None:
    """By the chain of the URDF file the joints are the flange of the table at every sample.

    They stay within the speeds of all joints, and 5° from their ends.
    """
    arm = Arm(ROBOTS / f"{ARM}.urdf")
    times, poses = wide(exported(plan, "rapid", tmp_path))
    trajectory = read(exported(plan, "ros2", tmp_path) / "trajectory.yaml")
    names = [joint.attrib["name"] for joint in arm.moving()]
    assert trajectory["joint_names"][:6] == names
    assert len(trajectory["joint_names"]) == 6 + 36
    angles = np.array([point["positions"][:6] for point in trajectory["points"]])
    assert len(angles) == len(times) == len(poses)
    world = frame(turn(np.array([0.0, 0.0, 1.0]), WORLD["yaw"]), np.array(WORLD["position"]))
    for q, pose in zip(angles, poses, strict=True):
        found, wanted = arm.flange(q), world @ pose
        np.testing.assert_allclose(found, wanted, atol=2e-7)
    for n, joint in enumerate(arm.moving()):
        limit = part(joint, "limit")
        margin = min(
            angles[:, n].min() - float(limit["lower"]), float(limit["upper"]) - angles[:, n].max()
        )
        assert margin > np.radians(5.0)
        assert np.abs(np.diff(angles[:, n]) / np.diff(times)).max() < float(limit["velocity"])


def test_the_description_brings_the_tool_to_its_place(plan: Path, tmp_path: Path) -> None:
    """With the joints of the trajectory ``array.urdf`` has the tool where the table has it."""
    folder = exported(plan, "ros2", tmp_path)
    arm = Arm(folder / "array.urdf", "ply_foot", "ply_tool")
    _, poses = wide(exported(plan, "rapid", tmp_path))
    trajectory = read(folder / "trajectory.yaml")
    points, names = trajectory["points"], trajectory["joint_names"]
    world = frame(turn(np.array([0.0, 0.0, 1.0]), WORLD["yaw"]), np.array(WORLD["position"]))
    # of the example: 300 mm above the frame, looking down on it
    flange = frame(turn(np.array([1.0, 0.0, 0.0]), np.pi), np.array([0.0, 0.0, 0.3]))
    for n in (0, len(points) // 2, len(points) - 1):
        found = arm.flange(np.array(points[n]["positions"][:6]))
        np.testing.assert_allclose(found, world @ poses[n] @ np.linalg.inv(flange), atol=2e-7)
    controllers = read(folder / "controllers.yaml")
    assert controllers["ply_controller"]["ros__parameters"]["joints"] == names


def test_the_verdict_says_what_the_motion_takes_of_the_arm(plan: Path) -> None:
    """Reach, speeds, ends and singularities are judged; the margin is that of the ranges."""
    summary = json.loads((plan / "result.json").read_text())["summary"]
    limits = {verdict["name"]: verdict for verdict in summary["limits"]}
    assert limits.keys() >= LIMITS
    assert all(limits[name]["ok"] for name in LIMITS)
    arm, record = Arm(ROBOTS / f"{ARM}.urdf"), summary["tool"]["arm"]
    margins = []
    for joint, (low, high) in zip(arm.moving(), record["ranges_deg"], strict=True):
        limit = part(joint, "limit")
        lower, upper = (np.degrees(float(limit[key])) for key in ("lower", "upper"))
        margins.append(min(low - lower, upper - high))
    assert min(margins) == pytest.approx(limits["joint_margin"]["value"], abs=1e-6)
    # the example stands where every configuration that reaches its first pose follows to the end
    assert record["configurations"] == record["keeping"] > 0


def test_programs_begin_with_the_joints_of_the_record(plan: Path, tmp_path: Path) -> None:
    """The first point of RAPID, KRL and URScript is in joints: those of the record."""
    start = json.loads((plan / "result.json").read_text())["summary"]["tool"]["arm"]["start_deg"]
    (rapid,) = (
        path for path in exported(plan, "rapid", tmp_path).glob("*.mod") if "_cell" not in path.name
    )
    found = re.search(r"MoveAbsJ \[\[([^\]]*)\]", rapid.read_text())
    assert found is not None
    np.testing.assert_allclose([float(n) for n in found[1].split(",")], start, atol=1e-5)
    # the quarter turns of axes 1, 4 and 6 are those of the joints there
    quarters = re.search(r"TriggL \[\[.*?\],\[.*?\],\[([^\]]*)\]", rapid.read_text())
    assert quarters is not None
    cf = [int(n) for n in quarters[1].split(",")]
    assert cf[:3] == [int(np.floor((start[n] + 1e-7) / 90)) for n in (0, 3, 5)]
    (krl,) = exported(plan, "krl", tmp_path).glob("*.src")
    found = re.search(r"PTP \{E6AXIS: (A1 .*?),E1", krl.read_text())
    assert found is not None
    np.testing.assert_allclose([float(a.split()[1]) for a in found[1].split(",")], start, atol=1e-5)
    (script,) = (
        path
        for path in exported(plan, "urscript", tmp_path).glob("*.script")
        if "_cell" not in path.name
    )
    found = re.search(r"movej\(\[([^\]]*)\]", script.read_text())
    assert found is not None
    np.testing.assert_allclose(
        np.degrees([float(n) for n in found[1].split(",")]), start, atol=1e-5
    )


SMALL = """
[ply]
grippers = [2, 2]
cell = ["100 mm", "100 mm"]
material = "prepreg_warm"
[grippers]
spacing = ["98 mm", "98 mm"]
height = "75 mm"
[motion]
kind = "hold"
[robot]
arm = "ur20"
[tool]
flange = { position = [0, 0, "0.2 m"], rotation = ["180 deg", 0, 0] }
"""


def simulated(scene: str, folder: Path) -> Any:
    """What ``simulate`` prints of a scene."""
    (folder / "scene.toml").write_text(scene)
    return json.loads(
        run("simulate", str(folder / "scene.toml"), "-o", str(folder / "out"), "--json").stdout
    )


def test_an_arm_that_is_too_far_away_is_refused_with_how_far(tmp_path: Path) -> None:
    """A ply at four meters, which no configuration reaches: the verdict says how far it misses."""
    told = simulated(SMALL + 'world = { position = ["4 m", 0, "0.5 m"] }\n', tmp_path)
    limits = {verdict["name"]: verdict for verdict in told["limits"]}
    assert not told["accepted"]
    assert not limits["arm_miss"]["ok"]
    # the links from shoulder to flange, one behind the other, are shorter than 2.3 meters
    assert limits["arm_miss"]["value"] > 1000 * (np.hypot(4.0, 0.5 - 0.2363) - 2.3)
    assert told["tool"]["arm"]["configurations"] == 0


def test_links_of_the_arm_keep_clear_of_what_stands_in_the_cell(tmp_path: Path) -> None:
    """A plate where the upper arm begins is hit by it, and five meters beside it is not."""
    world = 'world = { position = ["0.9 m", 0, "0.3 m"] }\n'
    plate = """
[[obstacles]]
name = "plate"
box = { size = ["400 mm", "400 mm", "20 mm"] }
position = ["-0.9 m", "SIDE", "-0.0637 m"]
"""
    for side, hits in (("0 m", True), ("5 m", False)):
        folder = tmp_path / side.replace(" ", "")
        folder.mkdir()
        told = simulated(SMALL + world + plate.replace("SIDE", side), folder)
        (verdict,) = (v for v in told["limits"] if v["name"] == "clearance")
        assert "arm's" in verdict["where"] and "plate" in verdict["where"]
        assert verdict["ok"] != hits
        assert (verdict["value"] < 0) == hits
