"""The VTK series of a drape, read by VTK's own reader."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import plydrape
import pytest
import record
from exported import RADIUS, SCENE, Numbers, Result, made, pieces
from scipy.spatial.transform import Rotation

pytest.importorskip("vtk", reason="NOT TESTED: scripts/venv --heavy")
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand, vtkStringArray
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

DIRECTIONS = {"u": 0, "v": 1, "rising": 2, "falling": 3}
STATES = {"hanging": 0, "overstretched": 1, "straight": 2, "lying": 3}


@dataclass(frozen=True)
class Poly:
    """What a file holds."""

    points: Numbers
    verts: list[list[int]]
    lines: list[list[int]]
    polys: list[list[int]]
    at_points: dict[str, Any]
    in_cells: dict[str, Any]
    fields: dict[str, Any]


def cells(array: Any) -> list[list[int]]:
    """Points of every cell."""
    ends = vtk_to_numpy(array.GetOffsetsArray())
    return [
        part.tolist() for part in np.split(vtk_to_numpy(array.GetConnectivityArray()), ends)[1:-1]
    ]


def named(data: Any) -> dict[str, Any]:
    """Arrays by name, none of them with a number that is none; lists of texts."""
    found: dict[str, Any] = {}
    for array in [data.GetAbstractArray(k) for k in range(data.GetNumberOfArrays())]:
        if isinstance(array, vtkStringArray):
            count = array.GetNumberOfValues()
            found[array.GetName()] = [array.GetValue(k) for k in range(count)]
            continue
        found[array.GetName()] = values = vtk_to_numpy(array)
        assert np.isfinite(values).all()
    return found


def read(path: Path) -> Poly:
    """A file by ParaView's reader, which must report neither errors nor warnings."""
    messages: list[str] = []
    reader = vtkXMLPolyDataReader()
    for event in [vtkCommand.ErrorEvent, vtkCommand.WarningEvent]:
        reader.AddObserver(event, lambda _, what: messages.append(what))
    reader.SetFileName(str(path))
    assert reader.CanReadFile(str(path)) == 1
    reader.Update()
    assert messages == [] and reader.GetErrorCode() == 0
    data = reader.GetOutput()
    return Poly(
        vtk_to_numpy(data.GetPoints().GetData()),
        cells(data.GetVerts()),
        cells(data.GetLines()),
        cells(data.GetPolys()),
        named(data.GetPointData()),
        named(data.GetCellData()),
        named(data.GetFieldData()),
    )


def collection(path: Path) -> list[tuple[float, int, str]]:
    """Times, parts and files of a series."""
    root = ET.parse(path).getroot()
    assert root.get("type") == "Collection"
    for entry in root.iter("DataSet"):
        assert entry.attrib["file"].startswith(entry.attrib["name"])
    return [
        (float(entry.attrib["timestep"]), int(entry.attrib["part"]), entry.attrib["file"])
        for entry in root.findall("./Collection/DataSet")
    ]


@dataclass(frozen=True)
class Exported:
    """A result and its files for VTK."""

    result: Result
    folder: Path

    def step(self, name: str, index: int) -> Poly:
        """A part of a step."""
        return read(self.folder / f"{name}_{index + 1:04}.vtp")


@pytest.fixture(scope="module", params=["simulate", "plan"])
def drape(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Exported:
    """A drape on a ball, by either command."""
    result = made(request.param, tmp_path_factory.mktemp(request.param))
    return Exported(result, result.export("vtk"))


def test_every_file_is_in_a_series_and_opens(drape: Exported) -> None:
    """The series name exactly the files that are there, at the times of the steps."""
    times = [step["time"] for step in drape.result.steps]
    numbers = [f"{step['step']:04}" for step in drape.result.steps]
    named_in = {"mold.vtp"}
    for name in ["ply", "catenaries", "grippers"]:
        files = [f"{name}_{number}.vtp" for number in numbers]
        series = collection(drape.folder / f"{name}.pvd")
        assert series == [(t, 0, file) for t, file in zip(times, files, strict=True)]
        named_in |= set(files)
        for time, _, file in series:
            assert read(drape.folder / file).fields["TimeValue"].tolist() == [time]
    everything = collection(drape.folder / "drape.pvd")
    assert [entry[0] for entry in everything] == sorted(4 * times)
    assert {entry[2] for entry in everything} == named_in
    for time in times:
        assert [part for t, part, _ in everything if t == time] == [0, 1, 2, 3]
    assert {path.name for path in drape.folder.glob("*.vtp")} == named_in
    assert read(drape.folder / "mold.vtp").polys


def test_catenaries_are_those_of_the_result(drape: Exported) -> None:
    """Every piece is one line through the same points, with the same numbers to the last bit."""
    touched = False
    drawn = plydrape.Result.read(drape.result.folder / "result.json")
    for index, step in enumerate(drape.result.steps):
        poly = drape.step("catenaries", index)
        found = list(pieces(step))
        whole = [{*map(tuple, line)} for line in drawn.lines(index + 1)]
        assert not poly.verts and not poly.polys and len(poly.lines) == len(found)
        for joined, n, (line, span) in zip(
            poly.lines, poly.in_cells["catenary"], found, strict=True
        ):
            points = poly.points[joined]
            if span is None:
                # a touch in a single point is a line from it to itself
                due = line["contact"]["points"]
                assert np.array_equal(points, due * (2 if len(due) == 1 else 1))
            # a part of the line that the package draws from gripper to gripper
            assert {*map(tuple, points)} <= whole[n]
        spans = [(line, span) for line, span in found if span is not None]
        held = poly.in_cells["state"] != 4
        assert held.tolist() == [span is not None for _, span in found]
        touched |= not held.all()

        def of_line(key: str, found: Any = found) -> list[Any]:
            return [line[key] for line, _ in found]

        data = poly.in_cells
        kinds = of_line("kind")
        assert data["kind"].tolist() == [not kind.startswith("edge") for kind in kinds]
        assert data["direction"].tolist() == [
            DIRECTIONS[kind.removeprefix("edge-")] for kind in kinds
        ]
        assert data["set_length_m"].tolist() == of_line("length")
        assert data["shearing"].tolist() == of_line("shearing")
        for end in ["from", "to"]:
            ids = np.column_stack([data[f"{end}_i"], data[f"{end}_j"]])
            assert ids.tolist() == of_line(end)
        lines = [step["catenaries"][n] for n in data["catenary"]]
        assert all(line is piece[0] for line, piece in zip(lines, found, strict=True))
        assert data["state"][held].tolist() == [STATES[span["hold"]] for _, span in spans]
        forces = [span["H_N"] for _, span in spans]
        assert data["has_force"][held].tolist() == [force is not None for force in forces]
        assert data["H_N"][held].tolist() == [force or 0.0 for force in forces]
        slack = np.array([record.slack_mm(span, line["length"]) for line, span in spans])
        stretch = np.array([record.overstretch_mm(span, line["length"]) for line, span in spans])
        length = np.array([span["length"] for _, span in spans])
        assert data["length_m"][held].tolist() == length.tolist()
        assert data["slack_mm"][held].tolist() == slack.tolist()
        assert data["overstretch_mm"][held].tolist() == stretch.tolist()
        assert np.allclose(data["slack_ratio"][held], slack / length / 1e3, rtol=1e-14, atol=0)
        shares = stretch / [line["length"] for line, _ in spans] / 1e3
        assert np.allclose(data["overstretch"][held], shares, rtol=1e-14, atol=0)
        if "wrinkle_mm" in step["measures"]:
            worst = step["measures"]["wrinkle_mm"]["value"]
            assert data["wrinkle_mm"][data["kind"] == 0].max() <= worst * (1 + 1e-12)
        for name in ["H_N", "has_force", "slack_mm", "overstretch"]:
            assert not data[name][~held].any()
        for joined, state in zip(poly.lines, data["state"], strict=True):
            assert (poly.at_points["contact"][joined] == (state > 2)).all()
    assert touched


def test_grippers_are_those_of_the_result(drape: Exported) -> None:
    """Places, tilts and orientations to the last bit; normals as SciPy turns the z axis."""
    for index, step in enumerate(drape.result.steps):
        poly, grippers = drape.step("grippers", index), step["grippers"]
        assert poly.verts == [[k] for k in range(len(grippers))]
        data = poly.at_points
        assert np.array_equal(poly.points, [g["position"] for g in grippers])
        assert np.array_equal(np.column_stack([data["i"], data["j"]]), [g["id"] for g in grippers])
        assert data["name"] == ["g{}_{}".format(*g["id"]) for g in grippers]
        quaternions = [g["quaternion"] for g in grippers]
        assert np.array_equal(data["quaternion"], quaternions)
        assert data["tilt_deg"].tolist() == [g["tilt_deg"] for g in grippers]
        normals = Rotation.from_quat(quaternions).apply([0, 0, 1])
        assert np.abs(data["Normals"] - normals).max() < 1e-14
        targets = [g["target_distance_mm"] for g in grippers]
        assert data["has_target"].tolist() == [t is not None for t in targets]
        assert data["target_distance_mm"].tolist() == [t or 0.0 for t in targets]


def test_the_surface_joins_the_grippers_and_faces_up(drape: Exported) -> None:
    """Corners of cells are the grippers; gap, fabric, fibers and shear are what they say."""
    content = drape.result.content["scene"]
    (nu, nv), cell = content["ply"]["grid"].values(), content["ply"]["cell"]
    near = content["settings"]["contact"]["tolerance"]
    for index, step in enumerate(drape.result.steps):
        poly = drape.step("ply", index)
        data = poly.at_points
        assert not poly.verts and not poly.lines
        assert data["z_m"].tolist() == poly.points[:, 2].tolist()
        outside = np.linalg.norm(poly.points - [0, 0, -RADIUS], axis=1) - RADIUS
        assert np.abs(data["gap_mm"] - 1e3 * outside).max() < 1e-9

        # places in the fabric: a grid, with a gripper at every corner of a cell
        fabric = np.column_stack([data["u_m"], data["v_m"]])
        assert fabric.min() == 0.0
        assert np.allclose(fabric.max(axis=0), [(nu - 1) * cell[0], (nv - 1) * cell[1]])
        for gripper in step["grippers"]:
            place = np.multiply(gripper["id"], cell)
            [corner] = np.flatnonzero(np.linalg.norm(fabric - place, axis=1) < 1e-12)
            assert np.linalg.norm(poly.points[corner] - gripper["position"]) <= near

        # quads: right-handed in the fabric, so their normals point up; fibers along their sides
        quads = np.array(poly.polys)
        assert quads.shape[1] == 4
        a, b, c, d = (poly.points[quads[:, k]] for k in range(4))
        assert (np.cross(c - a, d - b)[:, 2] > 0).all()
        sides = fabric[quads[:, 1]] - fabric[quads[:, 0]], fabric[quads[:, 3]] - fabric[quads[:, 0]]
        assert (sides[0][:, 0] > 0).all() and (sides[0][:, 1] == 0).all()
        assert (sides[1][:, 1] > 0).all() and (sides[1][:, 0] == 0).all()
        warp, weft = ("u", "v") if content["ply"]["warp"] == "u" else ("v", "u")
        for name, direction in [("warp", warp), ("weft", weft)]:
            fibers = data[name]
            assert np.abs(np.linalg.norm(fibers, axis=1) - 1).max() < 1e-14
            chord = b - a if direction == "u" else d - a
            along = np.einsum("ij,ij->i", fibers[quads[:, 0]], chord)
            # a ruck of what slack there is stands up to 45 degrees steep within a quad
            assert (along > np.cos(np.pi / 4) * np.linalg.norm(chord, axis=1)).all()

        # every quad knows its cell of the ply
        ids = np.column_stack([poly.in_cells["cell_i"], poly.in_cells["cell_j"]])
        middle = fabric[quads].mean(axis=1)
        assert np.array_equal(ids, (middle // cell).astype(int))
        shears = {tuple(c["cell"]): c["shear_deg"] for c in step["cells"]}
        assert poly.in_cells["shear_deg"].tolist() == [shears[tuple(i)] for i in ids.tolist()]


def test_the_mold_is_the_ball_of_the_scene(drape: Exported) -> None:
    """Its corners lie on the sphere, its normals stand on it, its triangles face the ply."""
    mold = read(drape.folder / "mold.vtp")
    radii = mold.points - [0, 0, -RADIUS]
    assert np.abs(np.linalg.norm(radii, axis=1) - RADIUS).max() < 1e-9
    assert np.abs(mold.at_points["Normals"] - radii / RADIUS).max() < 1e-8
    a, b, c = mold.points[np.array(mold.polys)].swapaxes(0, 1)
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()


def test_a_strip_has_neither_surface_nor_mold(tmp_path_factory: pytest.TempPathFactory) -> None:
    """A strip between two grippers that do not move is a series of one step, of two parts."""
    text = SCENE.replace("[4, 3]", "[2, 1]").split("[mold]")[0]
    text += '[grippers]\nspacing = ["98 mm", "98 mm"]\nheight = 0\n[motion]\nkind = "hold"\n'
    result = made("simulate", tmp_path_factory.mktemp("strip"), text)
    strip = Exported(result, result.export("vtk"))
    parts = ["catenaries_0001.vtp", "grippers_0001.vtp"]
    assert [entry[::2] for entry in collection(strip.folder / "drape.pvd")] == [
        (0.0, part) for part in parts
    ]
    assert sorted(path.name for path in strip.folder.glob("*.vtp")) == parts
    [span] = result.steps[0]["catenaries"][0]["spans"]
    poly = strip.step("catenaries", 0)
    [line] = plydrape.Result.read(result.folder / "result.json").lines(1)
    assert np.array_equal(poly.points, line)
    assert poly.in_cells["has_force"].tolist() == [1] and poly.in_cells["H_N"] == [span["H_N"]]
