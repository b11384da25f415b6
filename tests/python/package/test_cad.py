"""STEP and IGES files, made here by OpenCASCADE, against the exact surfaces they hold."""

from __future__ import annotations

import re
import subprocess
import sys
from collections import Counter
from itertools import pairwise
from math import cos, pi, radians, sin
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

pytest.importorskip("OCP", reason="NOT TESTED: scripts/venv --heavy")

import plydrape
from OCP.BRepAlgoAPI import BRepAlgoAPI_Fuse
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace
from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
from OCP.gp import gp_Ax3, gp_Cylinder, gp_Dir, gp_Pln, gp_Pnt, gp_Sphere
from OCP.IGESControl import IGESControl_Writer
from OCP.Interface import Interface_Static
from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer
from plydrape import _occ, cad

if TYPE_CHECKING:
    from numpy.typing import NDArray

RADIUS = 200.0
"""Radius of the surfaces (mm)."""
TILT = radians(40.0)
"""How far the cap and the patch reach from their top (rad)."""


def cap(*, reverse: bool = False, top: float = 0.0) -> Any:
    """A spherical cap about the z axis, its highest point at z = `top` (mm)."""
    at = gp_Ax3(gp_Pnt(0, 0, top - RADIUS), gp_Dir(0, 0, 1))
    face = BRepBuilderAPI_MakeFace(gp_Sphere(at, RADIUS), 0, 2 * pi, pi / 2 - TILT, pi / 2).Face()
    return face.Reversed() if reverse else face


def patch(low: float, high: float, length: float = 300.0) -> Any:
    """A patch of a cylinder about the y axis between two angles from the top (rad)."""
    at = gp_Ax3(gp_Pnt(0, -length / 2, 0), gp_Dir(0, 1, 0), gp_Dir(0, 0, 1))
    return BRepBuilderAPI_MakeFace(gp_Cylinder(at, RADIUS), low, high, 0, length).Face()


def step(path: Path, *shapes: Any, unit: str = "MM") -> Path:
    """Writes a STEP file with its numbers in this unit."""
    Interface_Static.SetCVal_s("write.step.unit", unit)
    with quiet():
        writer = STEPControl_Writer()
        for shape in shapes:
            writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
        writer.Write(str(path))
    return path


def iges(path: Path, *shapes: Any, unit: str = "MM") -> Path:
    """Writes an IGES file with its numbers in this unit, each shape on its own."""
    with quiet():
        writer = IGESControl_Writer(unit, 0)
        for shape in shapes:
            writer.AddShape(shape)
        writer.ComputeModel()
        writer.Write(str(path))
    return path


def quiet() -> Any:
    """OpenCASCADE writes on the standard output."""
    return _occ.quiet()


@pytest.fixture
def within(monkeypatch: pytest.MonkeyPatch) -> None:
    """Files are read within this process: to start one that loads OpenCASCADE takes a second.

    That a process of its own reads the same is seen by the patch, the command, and bad input.
    """
    monkeypatch.setattr(_occ, "read", _occ.read_here)


def sampled(found: cad.Triangles) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Middles of triangles and of their sides (N, 3), and the areas of the triangles."""
    a, b, c = (found.points[found.triangles[:, k]] for k in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return np.concatenate([(a + b + c) / 3, (a + b) / 2, (b + c) / 2, (c + a) / 2]), areas


def uses(found: cad.Triangles) -> Counter[int]:
    """How many edges belong to one triangle, to two, to more."""
    t = found.triangles
    edges = np.sort(np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]]), axis=1)
    return Counter(np.unique(edges, axis=0, return_counts=True)[1].tolist())


def ways(found: cad.Triangles) -> Counter[int]:
    """How often edges are used in a direction: once where all triangles face one side."""
    t = found.triangles
    edges = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    return Counter(np.unique(edges, axis=0, return_counts=True)[1].tolist())


@pytest.mark.usefixtures("within")
@pytest.mark.parametrize("tolerance", [1e-3, 1e-4, 2e-5])
def test_a_cap_from_step_lies_on_its_sphere_within_the_tolerance(
    tmp_path: Path, tolerance: float
) -> None:
    """The file is in mm, the result in m; the area tends to 2 pi R^2 (1 - cos tilt)."""
    path = step(tmp_path / "cap.step", cap())
    found = cad.read(path, tolerance=tolerance, angle_deg=45.0)
    radius = RADIUS * 1e-3
    middle = np.array([0.0, 0.0, -radius])
    assert np.abs(np.linalg.norm(found.points - middle, axis=1) - radius).max() < 1e-9
    places, areas = sampled(found)
    depth = radius - np.linalg.norm(places - middle, axis=1)
    assert depth.min() > -1e-9
    # not finer than asked by an order either: the tolerance is obeyed, not ignored
    assert 0.1 * tolerance < depth.max() <= tolerance
    exact = 2 * pi * radius**2 * (1 - cos(TILT))
    assert areas.sum() == pytest.approx(exact, rel=4 * tolerance / radius / TILT)


def test_a_patch_from_iges_lies_on_its_cylinder_within_the_tolerance(tmp_path: Path) -> None:
    """Area R 2 tilt times length; the patch is one face, so its border is all that is used once."""
    found = cad.read(iges(tmp_path / "patch.igs", patch(-TILT, TILT)), tolerance="0.05 mm")
    radius = RADIUS * 1e-3
    away = np.linalg.norm(found.points[:, [0, 2]], axis=1)
    assert np.abs(away - radius).max() < 1e-9
    places, areas = sampled(found)
    depth = radius - np.linalg.norm(places[:, [0, 2]], axis=1)
    assert 0.005e-3 < depth.max() <= 0.05e-3
    assert areas.sum() == pytest.approx(2 * TILT * radius * 0.3, rel=1e-3)
    assert np.ptp(found.points[:, 1]) == pytest.approx(0.3, abs=1e-9)


@pytest.mark.usefixtures("within")
def test_the_angle_divides_what_the_tolerance_leaves_coarse(tmp_path: Path) -> None:
    """Two triangles that meet on a circle of n chords differ by 360 deg / n."""
    path = step(tmp_path / "patch.stp", patch(-TILT, TILT))
    counts = []
    for angle in (40.0, 10.0, 2.0):
        found = cad.read(path, tolerance=0.05, angle_deg=angle)
        x = np.unique(np.round(found.points[:, 0], 9))
        turns = np.diff(np.arcsin(x / (RADIUS * 1e-3)))
        assert turns.max() <= radians(angle) * (1 + 1e-9)
        counts.append(len(x))
    assert counts[0] < counts[1] < counts[2]


@pytest.mark.usefixtures("within")
@pytest.mark.parametrize("unit", ["MM", "M", "INCH"])
def test_the_unit_of_the_file_is_read(tmp_path: Path, unit: str) -> None:
    """The same part written in mm, m and inches is the same in m."""
    for path in (
        step(tmp_path / "cap.step", cap(), unit=unit),
        iges(tmp_path / "cap.iges", cap(), unit=unit),
    ):
        width = np.ptp(cad.read(path).points[:, 0])
        assert width == pytest.approx(2e-3 * RADIUS * sin(TILT), rel=1e-3), path.name


@pytest.mark.usefixtures("within")
def test_a_wrong_unit_can_be_replaced(tmp_path: Path) -> None:
    """A file that says mm and holds inches is 25.4 times as large, one that holds m 1000 times."""
    for path in (step(tmp_path / "cap.step", cap()), iges(tmp_path / "cap.iges", cap())):
        said = np.ptp(cad.read(path, tolerance="1 mm").points, axis=0)
        for unit, factor in (("mm", 1.0), ("in", 25.4), ("m", 1000.0)):
            found = cad.read(path, unit=unit, tolerance=1e-3 * factor)
            assert np.ptp(found.points, axis=0) == pytest.approx(factor * said, rel=1e-6)


@pytest.mark.usefixtures("within")
def test_faces_that_meet_share_their_corners(tmp_path: Path) -> None:
    """A solid box is closed: each edge has two triangles, and the outside is outside."""
    box = BRepPrimAPI_MakeBox(gp_Pnt(70, -20, 30), 100.0, 200.0, 300.0).Solid()
    found = cad.read(step(tmp_path / "box.step", box))
    assert len(found.points) == 8 and len(found.triangles) == 12
    assert uses(found) == {2: 18}
    assert ways(found) == {1: 36}
    a, b, c = (found.points[found.triangles[:, k]] for k in range(3))
    assert np.einsum("ij,ij->", a, np.cross(b, c)) / 6 == pytest.approx(0.1 * 0.2 * 0.3)


@pytest.mark.usefixtures("within")
def test_curved_faces_that_meet_have_no_crack(tmp_path: Path) -> None:
    """A box with a cap fused on it: the circle between plane and sphere is divided once."""
    box = BRepPrimAPI_MakeBox(gp_Pnt(-300, -300, -100), 600.0, 600.0, 60.0).Solid()
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeSphere

    ball = BRepPrimAPI_MakeSphere(gp_Pnt(0, 0, -RADIUS), RADIUS).Solid()
    found = cad.read(step(tmp_path / "fused.step", BRepAlgoAPI_Fuse(box, ball).Shape()))
    assert set(uses(found)) == {2} and set(ways(found)) == {1}
    assert found.points[:, 2].max() == pytest.approx(0.0, abs=1e-9)


@pytest.mark.usefixtures("within")
def test_faces_that_lie_side_by_side_are_joined(tmp_path: Path) -> None:
    """IGES holds faces without what joins them: a cylinder in three patches is one surface."""
    angles = [-TILT, -0.2, 0.3, TILT]
    parts = [patch(a, b) for a, b in pairwise(angles)]
    found = cad.read(iges(tmp_path / "parts.igs", *parts), tolerance="0.05 mm")
    once = uses(found)[1]
    border = found.points[:, 1]
    ends = np.isclose(np.abs(border), 0.15).sum()
    # two straight sides of one piece each or more, and two round ends
    assert set(uses(found)) == {1, 2} and once < ends + 20
    seams = np.isclose(np.arctan2(found.points[:, 0], found.points[:, 2]), 0.3, atol=1e-9)
    corners = Counter(map(tuple, np.round(found.points[seams], 9).tolist()))
    assert len(corners) >= 2 and set(corners.values()) == {1}
    plydrape.Mold.triangles(found.points, found.triangles)


@pytest.mark.usefixtures("within")
@pytest.mark.parametrize("reverse", [False, True])
def test_a_surface_is_turned_up(tmp_path: Path, reverse: bool) -> None:
    """Whichever side of the cap the file calls its front."""
    found = cad.read(step(tmp_path / "cap.step", cap(reverse=reverse)))
    a, b, c = (found.points[found.triangles[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0.0).all()


@pytest.mark.usefixtures("within")
def test_the_default_tolerance_follows_the_size(tmp_path: Path) -> None:
    """A 5000th of the diagonal of the box of the part."""
    found = cad.read(step(tmp_path / "cap.step", cap()), angle_deg=45.0)
    radius, reach = RADIUS * 1e-3, RADIUS * 1e-3 * sin(TILT)
    diagonal = np.hypot(np.hypot(2 * reach, 2 * reach), radius * (1 - cos(TILT)))
    depth = radius - np.linalg.norm(sampled(found)[0] + [0.0, 0.0, radius], axis=1)
    assert 0.1 * diagonal / 5000 < depth.max() <= diagonal / 5000


def refused(path: Path, **options: Any) -> str:
    """What `cad.read` says against it."""
    with pytest.raises(plydrape.PlydrapeError) as fault:
        cad.read(path, **options)
    assert isinstance(fault.value, ValueError) and isinstance(fault.value, cad.CadError)
    return str(fault.value)


def test_bad_input_is_refused_in_one_line(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """The file and what is wrong with it; OpenCASCADE itself stays silent."""
    for name, kind in (("text.step", "STEP"), ("text.igs", "IGES")):
        (tmp_path / name).write_text("no CAD at all\n")
        assert refused(tmp_path / name).endswith(f"this is no {kind} file")
    assert refused(tmp_path / "none.step").endswith("none.step: there is no such file")
    assert "expected a file that ends in .step" in refused(tmp_path / "mold.dwg")
    line = BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(100, 0, 0)).Edge()
    assert "no face in it" in refused(step(tmp_path / "line.step", line))
    assert "no face in it" in refused(iges(tmp_path / "line.igs", line))
    good = step(tmp_path / "cap.step", cap())
    capfd.readouterr()
    for tolerance in ("0.1", "0 mm", "-1 mm", "1 parsec", "mm", 0.0, -1.0, float("nan")):
        assert 'expected a length above 0 such as "0.1 mm"' in refused(good, tolerance=tolerance)
    assert "no unit of length" in refused(good, unit="parsec")
    assert "above 0 to 90" in refused(good, angle_deg=0.0)
    assert "this is no STEP file" in refused(tmp_path / "text.step")
    assert capfd.readouterr().out == ""


def halfway(line: NDArray[np.float64]) -> NDArray[np.float64]:
    """The point in the middle of the length of a line (N, 3)."""
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]
    return np.array([np.interp(along[-1] / 2, along, line[:, c]) for c in range(3)])


@pytest.mark.usefixtures("within")
@pytest.mark.parametrize("ending", [".stl", ".obj"])
def test_a_converted_mold_drapes_as_the_exact_one(tmp_path: Path, ending: str) -> None:
    """A flat dome: grippers and fabric end where those on the formula do, within the tolerance."""
    out = tmp_path / f"dome{ending}"
    at = gp_Ax3(gp_Pnt(0, 0, -600), gp_Dir(0, 0, 1))
    dome = BRepBuilderAPI_MakeFace(gp_Sphere(at, 600.0), 0, 2 * pi, pi / 2 - 0.45, pi / 2).Face()
    cad.convert(step(tmp_path / "dome.step", dome), out, tolerance="0.05 mm", angle_deg=4.0)
    exact = {"kind": "sphere", "radius": 0.6, "position": [0, 0, -0.6]}
    drapes = []
    for mold in (exact, {"kind": "mesh", "file": str(out), "unit": "mm"}):
        scene = plydrape.Scene(
            ply={"grippers": [3, 3], "cell": [0.1, 0.1], "material": "krogh2018"},
            mold=mold,
            grippers={"spacing": [0.098, 0.098], "height": 0.05, "origin": "centered"},
            target={"seed": "middle"},
            motion={"kind": "straight", "steps": 8},
            model={"kind": "catenaries"},
        )
        drapes.append(plydrape.simulate(scene))
    assert drapes[0].first_contact_step == drapes[1].first_contact_step
    nets = [drape.net for drape in drapes]
    assert nets[0] is not None and nets[1] is not None
    assert nets[0].nodes == pytest.approx(nets[1].nodes, abs=1e-4)
    assert drapes[0].positions == pytest.approx(drapes[1].positions, abs=1e-4)
    lines = zip(drapes[0].lines(8), drapes[1].lines(8), strict=True)
    for one, other in lines:
        assert halfway(one) == pytest.approx(halfway(other), abs=1e-3)
    here, there = (drape.measures["gap_mm"][0] for drape in drapes)
    assert here == pytest.approx(there, abs=0.1)


@pytest.mark.usefixtures("within")
def test_a_mold_is_made_without_a_file(tmp_path: Path) -> None:
    """Heights of the cap over the plan."""
    mold = cad.mold(step(tmp_path / "cap.step", cap()), tolerance="0.02 mm")
    places = np.array([[0.0, 0.0], [0.05, 0.02], [-0.1, 0.06]])
    exact = np.sqrt(0.2**2 - (places**2).sum(axis=1)) - 0.2
    assert mold.heights(places) == pytest.approx(exact, abs=0.03e-3)
    assert np.isnan(mold.heights([[0.19, 0.0]])).all()


@pytest.mark.usefixtures("within")
def test_both_formats_hold_the_same_triangles(tmp_path: Path) -> None:
    """An STL has single precision, an OBJ all digits; both are in mm."""
    path = step(tmp_path / "cap.step", cap())
    found = cad.convert(path, tmp_path / "cap.obj", tolerance="1 mm")
    cad.convert(path, tmp_path / "cap.stl", tolerance="1 mm")
    rows = [line.split() for line in (tmp_path / "cap.obj").read_text().splitlines()]
    places = np.array([row[1:] for row in rows if row[0] == "v"], float)
    corners = np.array([row[1:] for row in rows if row[0] == "f"], int) - 1
    assert places == pytest.approx(found.points * 1e3, abs=1e-12)
    assert (corners == found.triangles).all()
    stl = (tmp_path / "cap.stl").read_bytes()
    assert len(stl) == 84 + 50 * len(found.triangles)
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    facets = np.frombuffer(stl[84:], record)
    assert facets["corners"] == pytest.approx(places[corners], abs=2e-5)
    assert (facets["normal"][:, 2] > 0).all()


@pytest.mark.usefixtures("within")
def test_a_file_is_written_whole_or_not_at_all(tmp_path: Path) -> None:
    """What was there stays when the input is bad; no draft is left behind."""
    out = tmp_path / "mold.stl"
    out.write_text("as it was")
    (tmp_path / "bad.step").write_text("nothing")
    with pytest.raises(cad.CadError):
        cad.convert(tmp_path / "bad.step", out)
    assert out.read_text() == "as it was"
    good = step(tmp_path / "cap.step", cap())
    with pytest.raises(cad.CadError, match=r"expected a name that ends in \.stl or \.obj"):
        cad.convert(good, tmp_path / "mold.ply")
    with pytest.raises(cad.CadError, match="cannot be written"):
        cad.convert(good, tmp_path / "absent" / "mold.stl")
    (tmp_path / "folder.stl").mkdir()
    with pytest.raises(cad.CadError, match="cannot be written"):
        cad.convert(good, tmp_path / "folder.stl")
    cad.convert(good, out)
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"mold.stl", "bad.step", "cap.step", "folder.stl"}
    assert len(out.read_bytes()) > 84


def test_the_command_converts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One line about the mesh, one about the file; exit 2 and one line for bad input."""
    plane = BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, 5), gp_Dir(0, 0, 1)), 0, 40, 0, 30).Face()
    path = step(tmp_path / "plane.step", plane)
    command = [sys.executable, "-W", "error", "-m", "plydrape.cad", "plane.step", "-o", "plane.stl"]
    command += ["--tolerance", "0.1mm"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines() == [
        "2 triangles, in mm: x 0 to 40, y 0 to 30, z 5 to 5",
        'wrote plane.stl; in the scene: file = "plane.stl", unit = "mm"',
    ]
    assert cad.main([str(path), "-o", str(tmp_path / "plane.dwg")]) == 2
    assert capsys.readouterr().err.startswith("error: ")


def test_a_package_is_named_where_it_is_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Not before it is used: the module itself can be imported without OpenCASCADE."""
    path = step(tmp_path / "cap.step", cap())
    stub = 'raise ModuleNotFoundError("No module named OCP", name="OCP")\n'
    (tmp_path / "OCP.py").write_text(stub)
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ImportError, match=r"pip install cadquery-ocp-novtk"):
        cad.read(path)


@pytest.mark.parametrize(
    ("end", "words"),
    [
        ("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)", "crashes on it"),
        ("raise MemoryError", "fails: MemoryError"),
    ],
)
def test_a_crash_of_opencascade_is_an_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, end: str, words: str
) -> None:
    """It crashes on one damaged file of twenty or so; here the process that reads ends so."""
    path = step(tmp_path / "cap.step", cap())
    monkeypatch.setattr(_occ, "PROGRAM", end)
    with pytest.raises(cad.CadError, match=rf"cap\.step: OpenCASCADE {words}; repair the part"):
        cad.read(path)


def test_a_file_that_keeps_opencascade_busy_is_an_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Here the process that reads is busy for ever, and the bound is that of an empty file."""
    path = step(tmp_path / "cap.step", cap())
    busy = (
        "import sys; from plydrape import _occ; _occ.bound(float(sys.argv[-1]))\nwhile True: pass"
    )
    monkeypatch.setattr(_occ, "PROGRAM", busy)
    monkeypatch.setattr(_occ, "BUSY", (1.0, 0.0))
    with pytest.raises(cad.CadError, match=r"cap\.step: OpenCASCADE is busy for more than 1 s"):
        cad.read(path)


def test_what_opencascade_refuses_is_an_error(tmp_path: Path) -> None:
    """A radius that is no length fails in the middle of its work, by an exception of its own."""
    path = step(tmp_path / "cap.step", cap())
    text = path.read_text()
    path.write_text(re.sub(r"(SPHERICAL_SURFACE\('',#\d+,)200\.", r"\g<1>-1.E308", text))
    assert path.read_text() != text
    with pytest.raises(cad.CadError, match=r"cap\.step: .*"):
        cad.read(path)
