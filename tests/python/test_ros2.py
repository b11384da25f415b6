"""What ROS 2's own formats say of a drape: read by PyYAML, rosbags and mcap-ros2-support."""

from __future__ import annotations

import csv
import runpy
import sys
import types
import xml.etree.ElementTree as ET
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import plydrape
import pytest
import yaml
from exported import RADIUS, SCENE, Numbers, Result, made, pieces
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.interfaces import QosDurability, QosReliability
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore
from scipy.spatial.transform import Rotation

TRAJECTORY = "trajectory_msgs/msg/JointTrajectory"
MARKERS = "visualization_msgs/msg/MarkerArray"
FRAMES = "tf2_msgs/msg/TFMessage"
OUTPUTS = "control_msgs/msg/DynamicInterfaceGroupValues"
TOPICS = {
    "/plydrape/trajectory": TRAJECTORY,
    "/plydrape/loads": TRAJECTORY,
    "/plydrape/vacuum": OUTPUTS,
    "/tf": FRAMES,
    "/tf_static": FRAMES,
    "/plydrape/mold": MARKERS,
    "/plydrape/ply": MARKERS,
}
LATCHED = ["/plydrape/trajectory", "/plydrape/loads", "/plydrape/mold", "/tf_static"]
# Of Jazzy and later; rosbags does not have it.
OUTPUT_MESSAGES = {
    OUTPUTS: """
        std_msgs/Header header
        string[] interface_groups
        control_msgs/InterfaceValue[] interface_values
    """,
    "control_msgs/msg/InterfaceValue": "string[] interface_names\nfloat64[] values",
}
MOUNTS = 'stiffness = { lateral = "2 N/mm", axial = "5 N/mm" }\n'


TOOL = """
[tool]
axes = [
    { direction = "x", stroke = ["-9 mm", "9 mm"], speed = "0.1 m/s" },
    { direction = "z", stroke = ["-40 mm", "60 mm"], speed = "0.2 m/s" },
]
flange = { position = [0, "20 mm", "300 mm"], rotation = ["180 deg", 0, "10 deg"] }
world = { position = ["1.4 m", 0, "0.5 m"] }
"""


def typestore(distribution: Stores = Stores.ROS2_HUMBLE) -> Typestore:
    """The messages of a distribution, and those for outputs."""
    store = get_typestore(distribution)
    for name, text in OUTPUT_MESSAGES.items():
        store.register(get_types_from_msg(text, name))
    return store


@dataclass(frozen=True)
class Exported:
    """A result and its files for ROS 2."""

    result: Result
    folder: Path

    @property
    def bag(self) -> Path:
        """The bag."""
        return self.folder / "trajectory.mcap"

    @cached_property
    def message(self) -> dict[str, Any]:
        """The trajectory of the YAML file."""
        text = (self.folder / "trajectory.yaml").read_text()
        message: dict[str, Any] = yaml.load(text, yaml.CSafeLoader)
        return message

    def decoded(self, topic: str) -> list[tuple[int, Any]]:
        """Times (ns) and messages of a topic, by rosbags."""
        store = typestore()
        with Reader(self.bag) as reader:
            chosen = [c for c in reader.connections if c.topic == topic]
            return [
                (time, store.deserialize_cdr(raw, connection.msgtype))
                for connection, time, raw in reader.messages(connections=chosen)
            ]


def exported(command: str, home: Path) -> Exported:
    """The results of the scene, and their files."""
    result = made(command, home)
    return Exported(result, result.export("ros2", "--tf"))


@pytest.fixture(scope="module")
def simulated(tmp_path_factory: pytest.TempPathFactory) -> Exported:
    """A drape along straight paths: only its steps are known."""
    return exported("simulate", tmp_path_factory.mktemp("simulated"))


@pytest.fixture(scope="module")
def planned(tmp_path_factory: pytest.TempPathFactory) -> Exported:
    """A plan: its motion is known at all times."""
    return exported("plan", tmp_path_factory.mktemp("planned"))


@pytest.fixture(params=["simulated", "planned"])
def either(request: pytest.FixtureRequest) -> Exported:
    """One after the other."""
    found: Exported = request.getfixturevalue(request.param)
    return found


@pytest.fixture(scope="module")
def mounted(tmp_path_factory: pytest.TempPathFactory) -> Exported:
    """A drape of a sheet from grippers on mounts, which have a preload besides."""
    home = tmp_path_factory.mktemp("mounted")
    scene = SCENE.replace('kind = "catenaries"', 'kind = "sheet"\n[sheet]\nmesh = "40 mm"')
    result = made("simulate", home, scene.replace("[target]", MOUNTS + "[target]"))
    return Exported(result, result.export("ros2", "--tf"))


@pytest.fixture(scope="module")
def carried(tmp_path_factory: pytest.TempPathFactory) -> Exported:
    """A drape from grippers on a frame at a flange, with two axes each."""
    result = made("simulate", tmp_path_factory.mktemp("carried"), SCENE + TOOL)
    return Exported(result, result.export("ros2", "--tf"))


def table(export: Exported) -> tuple[Numbers, Numbers]:
    """The poses that the trajectory shall hold: a plan's samples, a drape's steps."""
    motion = export.result.folder / "motion.csv"
    return export.result.table("motion.csv" if motion.exists() else "trajectory.csv")


def pose(transform: Any) -> list[float]:
    """A transform of either reader in the order of the tables."""
    place, turn = transform.translation, transform.rotation
    return [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w]


def nanoseconds(duration: Any) -> int:
    """A duration in nanoseconds."""
    return int(duration.sec) * 1_000_000_000 + int(duration.nanosec)


def axes(export: Exported) -> list[str]:
    """Free grippers are gantries of three axes each."""
    return [f"g{i}_{j}_{axis}" for i, j in export.result.ids for axis in "xyz"]


def places(poses: Numbers) -> Numbers:
    """Positions of the axes, from the poses of the table."""
    found: Numbers = poses[:, :, :3].reshape(len(poses), -1)
    return found


def test_the_yaml_holds_the_numbers_of_the_table(either: Exported) -> None:
    """Every position to the last bit, times to the nanosecond, three axes a gripper in order."""
    message = either.message
    times, poses = table(either)
    assert list(message) == ["header", "joint_names", "points"]
    assert message["header"] == {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "ply_mold"}
    assert message["joint_names"] == axes(either)
    found = np.array([point["positions"] for point in message["points"]])
    assert np.array_equal(found, places(poses))
    clock = [p["time_from_start"] for p in message["points"]]
    seconds = np.array([t["sec"] + 1e-9 * t["nanosec"] for t in clock])
    assert np.abs(seconds - times).max() < 0.6e-9
    assert seconds[0] == 0.0 and (np.diff(seconds) > 0).all()


def test_rosbags_decodes_the_numbers_of_the_table(either: Exported) -> None:
    """The message of the bag is that of the YAML file."""
    [(time, message)] = either.decoded("/plydrape/trajectory")
    times, poses = table(either)
    assert time == 0 and message.header.frame_id == "ply_mold"
    assert message.joint_names == axes(either)
    found = np.array([point.positions for point in message.points])
    assert np.array_equal(found, places(poses))
    clock = [nanoseconds(point.time_from_start) for point in message.points]
    assert clock == [round(t * 1e9) for t in times]
    assert clock[0] == 0 and (np.diff(clock) > 0).all()
    for found_point, written in zip(message.points, either.message["points"], strict=True):
        for name in ["velocities", "accelerations", "effort"]:
            assert written[name] == getattr(found_point, name).tolist()


def test_frames_are_the_poses_of_the_table(either: Exported) -> None:
    """A frame for every pad at every time of the table, to the last bit but the turn's length."""
    times, poses = table(either)
    frames = either.decoded("/tf")
    with either.bag.open("rb") as file:
        noted = {each.name: each.metadata for each in make_reader(file).iter_metadata()}
    stated = noted["plydrape_program"]
    assert stated["accepted"] == str(either.result.content["summary"]["accepted"]).lower()
    assert [time for time, _ in frames] == [round(time * 1e9) for time in times]
    for number, (i, j) in enumerate(either.result.ids):
        moved = [message.transforms[number] for _, message in frames]
        assert {each.child_frame_id for each in moved} == {f"ply_g{i}_{j}"}
        assert {each.header.frame_id for each in moved} == {"ply_mold"}
        found = np.array([pose(each.transform) for each in moved])
        assert np.array_equal(found[:, :3], poses[:, number, :3])
        turned = Rotation.from_quat(found[:, 3:]).inv() * Rotation.from_quat(poses[:, number, 3:])
        assert turned.magnitude().max() < 1e-7


def test_the_mold_stands_in_the_world_and_the_vacuum_holds_from_start_to_end(
    either: Exported,
) -> None:
    """Until a scene says more: at its origin, and all grippers at once."""
    [(_, fixed)] = either.decoded("/tf_static")
    [mold] = fixed.transforms
    assert (mold.header.frame_id, mold.child_frame_id) == ("world", "ply_mold")
    assert pose(mold.transform) == [0, 0, 0, 0, 0, 0, 1]
    times, _ = table(either)
    names = [f"g{i}_{j}" for i, j in either.result.ids]
    commands = either.decoded("/plydrape/vacuum")
    assert [time for time, _ in commands] == [0, round(times[-1] * 1e9)]
    texts = yaml.load_all((either.folder / "vacuum.yaml").read_text(), yaml.CSafeLoader)
    for (_, command), written, value in zip(commands, texts, [1.0, 0.0], strict=True):
        assert command.interface_groups == names == written["interface_groups"]
        for output in command.interface_values:
            assert output.interface_names == ["vacuum"] and output.values.tolist() == [value]


def test_mcap_ros2_support_decodes_the_same_by_the_schemas_in_the_bag(either: Exported) -> None:
    """A second reader, which knows the messages only from the bag."""
    steps, seen = len(either.result.steps), dict.fromkeys(TOPICS, 0)
    with either.bag.open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()])
        assert reader.get_header().profile == "ros2"
        for schema, channel, _, message in reader.iter_decoded_messages():
            assert schema is not None and schema.name == TOPICS[channel.topic]
            assert (schema.encoding, channel.message_encoding) == ("ros2msg", "cdr")
            seen[channel.topic] += 1
            if channel.topic == "/plydrape/trajectory":
                found = np.array([point.positions for point in message.points])
                assert np.array_equal(found, places(table(either)[1]))
            if channel.topic == "/plydrape/vacuum":
                assert len(message.interface_groups) == len(either.result.ids)
            if channel.topic == "/plydrape/ply":
                discs = [m for m in message.markers if m.ns == "grippers"]
                points = [[m.pose.position.x, m.pose.position.y, m.pose.position.z] for m in discs]
                step = either.result.steps[seen[channel.topic] - 1]
                assert points == [g["position"] for g in step["grippers"]]
    frames = seen.pop("/tf")
    assert frames == len(table(either)[0])
    once = dict.fromkeys(LATCHED, 1)
    assert seen == {**once, "/plydrape/vacuum": 2, "/plydrape/ply": steps}


@pytest.mark.parametrize("distribution", ["HUMBLE", "JAZZY", "KILTED"])
def test_another_encoder_writes_the_same_bytes(planned: Exported, distribution: str) -> None:
    """Decoded and encoded again by rosbags' own definitions, a message is what it was.

    The padding is nobody's business; both write zeros.
    """
    store = typestore(Stores[f"ROS2_{distribution}"])
    with Reader(planned.bag) as reader:
        assert {c.topic: c.msgtype for c in reader.connections} == TOPICS
        for connection, _, raw in reader.messages():
            message = store.deserialize_cdr(raw, connection.msgtype)
            again = bytes(store.serialize_cdr(message, connection.msgtype))
            assert again == bytes(raw), connection.topic


def test_loads_are_those_of_the_table_and_of_the_springs(mounted: Exported) -> None:
    """One sliding joint a gripper and axis: effort is the load (N), position the preload (m).

    Of stiffness k: F = -k p.

    1e-6 N is above the rounding of positions of a meter times k.
    """
    [(time, message)] = mounted.decoded("/plydrape/loads")
    assert time == 0 and message.header.frame_id == "ply_mold"
    ids = mounted.result.ids
    assert message.joint_names == [f"g{i}_{j}_{axis}" for i, j in ids for axis in "xyz"]
    with (mounted.result.folder / "trajectory.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    for name, unit, factor in [("load", "N", 1.0), ("preload", "mm", 1e-3)]:
        columns = [f"{name} {axis} ({unit})" for axis in "xyz"]
        wanted = np.array([[float(row[column]) for column in columns] for row in rows])
        found = [p.effort if name == "load" else p.positions for p in message.points]
        assert np.allclose(np.array(found).reshape(-1, 3), factor * wanted, rtol=1e-14, atol=0)
    stiffness = np.tile([2e3, 2e3, 5e3], len(ids))
    for point in message.points:
        assert np.abs(point.effort + stiffness * point.positions).max() < 1e-6
        assert np.abs(point.effort).max() > 0.01
    text = (mounted.folder / "loads.yaml").read_text()
    written = yaml.load(text, yaml.CSafeLoader)
    assert written["points"][3]["effort"] == message.points[3].effort.tolist()
    head = "# lateral_stiffness_n_per_mm: 2.0\n# axial_stiffness_n_per_mm: 5.0\nheader:"
    assert head in text
    if not mounted.result.content["summary"]["accepted"]:
        assert text.startswith("# NOT ACCEPTED: ")
    with mounted.bag.open("rb") as file:
        noted = {each.name: each.metadata for each in make_reader(file).iter_metadata()}
    assert noted["plydrape_mounts"]["axial_stiffness_n_per_mm"] == "5.0"


def test_late_subscribers_get_what_is_sent_once(planned: Exported) -> None:
    """Trajectory and mold are kept for them, shapes of the ply are not; none is lost."""
    with Reader(planned.bag) as reader:
        for connection in reader.connections:
            [offered] = connection.ext.offered_qos_profiles  # type: ignore[union-attr]
            latched = connection.topic in LATCHED
            kept = QosDurability.TRANSIENT_LOCAL if latched else QosDurability.VOLATILE
            assert offered.durability == kept
            assert offered.reliability == QosReliability.RELIABLE


def test_a_simulated_drape_has_no_velocities(simulated: Exported) -> None:
    """Between its steps nothing is known."""
    for point in simulated.message["points"]:
        assert point["velocities"] == [] and point["accelerations"] == []


def test_velocities_are_those_of_the_positions(planned: Exported) -> None:
    """A cubic through positions and velocities meets the positions half way.

    Of samples that far apart it is off by (2h)⁴/384 of the fourth derivative, which is about the
    jerk over h: the jerk has a limit, and may jump by twice that.
    """
    points = planned.message["points"]
    times, poses = table(planned)
    found = places(poses)
    velocities = np.array([point["velocities"] for point in points])
    assert (velocities[[0, -1]] == 0).all()
    # the last sample is nearer than the others
    h, wide = times[1], slice(1, -3)
    jerk = planned.result.content["scene"]["limits"]["jerk"]
    before, after = found[wide], found[3:-1]
    middle = (before + after) / 2 + 2 * h * (velocities[wide] - velocities[3:-1]) / 8
    off = np.abs(middle - found[2:-2]).max()
    assert off < 2 * jerk * h**3
    assert np.abs(velocities).max() > 0.01


def by_name(message: Any) -> dict[tuple[str, int], Any]:
    """Markers by namespace and number: no two have the same."""
    markers = {(marker.ns, marker.id): marker for marker in message.markers}
    assert len(markers) == len(message.markers)
    return markers


def coordinates(points: Any) -> Numbers:
    """Points of a marker."""
    return np.array([[p.x, p.y, p.z] for p in points]).reshape(-1, 3)


def rounded(chord: Iterable[float]) -> tuple[float, ...]:
    """Coordinates (m) without what is rounding beside a millimeter."""
    return tuple(round(float(c), 15) + 0.0 for c in chord)


def test_markers_are_the_shape_of_the_step_at_its_time(either: Exported) -> None:
    """Discs, catenaries and contact lie where the result has them; the surface joins them."""
    messages = either.decoded("/plydrape/ply")
    steps = either.result.steps
    assert [time for time, _ in messages] == [round(step["time"] * 1e9) for step in steps]
    touched = False
    drawn = plydrape.Result.read(either.result.folder / "result.json")
    for index, ((_, message), step) in enumerate(zip(messages, steps, strict=True)):
        markers = by_name(message)
        for number, gripper in enumerate(step["grippers"]):
            disc = markers["grippers", number]
            place, turn = disc.pose.position, disc.pose.orientation
            assert [place.x, place.y, place.z] == gripper["position"]
            assert [turn.x, turn.y, turn.z, turn.w] == gripper["quaternion"]
            assert disc.type == 3 and disc.scale.z < 0.2 * disc.scale.x

        contacts = [line["contact"]["points"] for line, span in pieces(step) if span is None]
        touches = [points[0] for points in contacts if len(points) == 1]
        points = markers["contact", 1]
        assert points.type == 7 and points.action == (0 if touches else 2)
        assert np.array_equal(coordinates(points.points), np.array(touches).reshape(-1, 3))
        due = [point for line in contacts for pair in pairwise(line) for point in pair]
        touched |= bool(due)
        lying = markers["contact", 0]
        assert lying.type == 5 and lying.action == (0 if due else 2)
        assert np.array_equal(coordinates(lying.points), np.array(due).reshape(-1, 3))
        # spans are pieces of the lines from gripper to gripper, ten chords each
        for key, edges in enumerate([True, False]):
            spans = [
                line["kind"].startswith("edge") == edges
                for line, span in pieces(step)
                if span is not None
            ]
            lines = [
                line
                for line, state in zip(drawn.lines(index + 1), step["catenaries"], strict=True)
                if state["kind"].startswith("edge") == edges
            ]
            # components that are rounding beside others are written as 0 in one of the two
            known = {rounded((*a, *b)) for line in lines for a, b in pairwise(line)}
            marker = markers["catenaries", key]
            assert marker.type == 5 and marker.action == (0 if any(spans) else 2)
            found = coordinates(marker.points).reshape(-1, 6)
            assert len(found) == 10 * sum(spans)
            assert {rounded(chord) for chord in found} <= known

        sheet = markers["ply", 0]
        corners = coordinates(sheet.points)
        assert sheet.type == 11 and len(corners) % 3 == 0 and len(sheet.colors) == len(corners)
        # where the ply is in contact it lies on the mold, its gripper as near as that counts
        near = either.result.content["scene"]["settings"]["contact"]["tolerance"]
        for gripper in step["grippers"]:
            assert np.linalg.norm(corners - gripper["position"], axis=1).min() <= near
        a, b, c = corners.reshape(-1, 3, 3).swapaxes(0, 1)
        assert (np.cross(b - a, c - a)[:, 2] > 0).all()
        assert all(marker.header.frame_id == "ply_mold" for marker in message.markers)
    assert touched


def test_the_mold_is_in_the_bag_once(planned: Exported) -> None:
    """Its corners lie on the sphere of the scene, and its triangles face the ply."""
    [(time, message)] = planned.decoded("/plydrape/mold")
    [mold] = message.markers
    assert time == 0 and mold.type == 11
    a, b, c = coordinates(mold.points).reshape(-1, 3, 3).swapaxes(0, 1)
    for corner in [a, b, c]:
        distance = np.linalg.norm(corner - [0, 0, -RADIUS], axis=1)
        assert np.abs(distance - RADIUS).max() < 1e-9
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()


def test_a_strip_without_a_mold_has_neither_surface_nor_mold(
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    """One strip between two grippers at rest: one point at time 0."""
    home = tmp_path_factory.mktemp("strip")
    text = SCENE.replace("[4, 3]", "[2, 1]").split("[mold]")[0]
    text += '[grippers]\nspacing = ["98 mm", "98 mm"]\nheight = 0\n[motion]\nkind = "hold"\n'
    result = made("simulate", home, text)
    strip = Exported(result, result.export("ros2", "--tf"))
    with Reader(strip.bag) as reader:
        topics = {c.topic for c in reader.connections}
        assert topics == set(TOPICS) - {"/plydrape/mold"}
    [(_, message)] = strip.decoded("/plydrape/ply")
    assert {marker.ns for marker in message.markers} == {"catenaries", "contact", "grippers"}
    [(_, trajectory)] = strip.decoded("/plydrape/trajectory")
    assert [nanoseconds(point.time_from_start) for point in trajectory.points] == [0]


def frame(export: Exported, names: tuple[str, str], topic: str = "/tf") -> list[Numbers]:
    """The transforms (4 x 4) from a frame to another at each message."""
    found = []
    for _, message in export.decoded(topic):
        for each in message.transforms:
            if (each.header.frame_id, each.child_frame_id) == names:
                matrix = np.eye(4)
                numbers = pose(each.transform)
                matrix[:3, 3] = numbers[:3]
                matrix[:3, :3] = Rotation.from_quat(numbers[3:]).as_matrix()
                found.append(matrix)
    return found


@pytest.mark.parametrize("kind", ["planned", "carried"])
def test_the_description_brings_the_axes_to_the_places_of_the_table(
    request: pytest.FixtureRequest, kind: str
) -> None:
    """Read as URDF: joints in their limits bring each gripper from mold or flange to its place."""
    export: Exported = request.getfixturevalue(kind)
    times, poses = table(export)
    robot = ET.parse(export.folder / "array.urdf").getroot()
    links = [link.attrib["name"] for link in robot.findall("link")]
    joints = {joint.attrib["name"]: joint for joint in robot.findall("joint")}
    names = export.message["joint_names"]
    assert list(joints) == names and len(links) == len(set(links)) == len(names) + 1
    values = np.array([point["positions"] for point in export.message["points"]])

    def attribute(joint: ET.Element, part: str, key: str) -> str:
        element = joint.find(part)
        assert element is not None
        return element.attrib[key]

    def numbers(joint: ET.Element, part: str, key: str) -> Numbers:
        return np.array([float(number) for number in attribute(joint, part, key).split()])

    # all joints slide, so each adds its origin and its stroke in the frame of the root
    shifts = {links[0]: np.zeros((len(times), 3))}
    for number, joint in enumerate(joints.values()):
        assert joint.attrib["type"] == "prismatic"
        stroke = values[:, number]
        assert numbers(joint, "limit", "lower") <= stroke.min() + 1e-12
        assert numbers(joint, "limit", "upper") >= stroke.max() - 1e-12
        parent, child = (attribute(joint, end, "link") for end in ("parent", "child"))
        moved = np.outer(stroke, numbers(joint, "axis", "xyz"))
        shifts[child] = shifts[parent] + numbers(joint, "origin", "xyz") + moved
    carrier = [np.eye(4)] * len(times)
    if kind == "carried":
        [tool] = frame(export, ("ply_flange", "ply_tool"), "/tf_static")
        carrier = [flange @ tool for flange in frame(export, ("ply_mold", "ply_flange"))]
    assert links[0] == {"planned": "ply_mold", "carried": "ply_tool"}[kind]
    for number, (i, j) in enumerate(export.result.ids):
        last = [name for name in names if name.startswith(f"g{i}_{j}_")][-1]
        local = np.c_[shifts[f"{last}_slide"], np.ones(len(times))]
        found = np.einsum("nij,nj->ni", np.array(carrier), local)[:, :3]
        assert np.abs(found - poses[:, number, :3]).max() < 1e-8


@pytest.mark.parametrize("kind", ["planned", "carried"])
def test_the_launch_file_starts_controllers_of_all_that_is_commanded(
    request: pytest.FixtureRequest, kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What it spawns commands the joints of the trajectory and the groups of the vacuum."""
    export: Exported = request.getfixturevalue(kind)
    for name in ["launch", "launch_ros", "launch_ros.actions"]:
        module = types.ModuleType(name)
        module.LaunchDescription = list  # type: ignore[attr-defined]
        module.Node = dict  # type: ignore[attr-defined]
        monkeypatch.setitem(sys.modules, name, module)
    launched = runpy.run_path(str(export.folder / "array.launch.py"))
    publisher, manager, spawner = launched["generate_launch_description"]()
    text = (export.folder / "array.urdf").read_text()
    assert publisher["parameters"] == [{"robot_description": text}]
    assert manager["parameters"] == [
        {"robot_description": text},
        str((export.folder / "controllers.yaml").resolve()),
    ]
    parameters = {
        name: part["ros__parameters"]
        for name, part in yaml.safe_load((export.folder / "controllers.yaml").read_text()).items()
    }
    kinds = parameters.pop("controller_manager")
    assert kinds.pop("update_rate") == 500
    assert spawner["arguments"] == list(kinds)
    assert {name: each["type"].split("/")[1] for name, each in kinds.items()} == {
        "joint_state_broadcaster": "JointStateBroadcaster",
        "ply_controller": "JointTrajectoryController",
        "ply_vacuum": "GpioCommandController",
    }
    assert parameters["ply_controller"]["joints"] == export.message["joint_names"]
    [_, command] = export.decoded("/plydrape/vacuum")[0]
    groups = {name: {"interfaces": ["vacuum"]} for name in command.interface_groups}
    assert parameters["ply_vacuum"]["gpios"] == list(groups)
    assert parameters["ply_vacuum"]["command_interfaces"] == groups
    # what is commanded is there in the description
    control = ET.fromstring(text).find("ros2_control")
    assert control is not None
    described = {(part.tag, part.attrib["name"]) for part in control if part.tag != "hardware"}
    joints = {("joint", name) for name in export.message["joint_names"]}
    assert described == joints | {("gpio", name) for name in groups}
