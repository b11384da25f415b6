"""The files of `plydrape net` in other programs' readers: meshio for VTK's, csv for the table."""

from __future__ import annotations

import csv
import importlib.util
import json
import math
from pathlib import Path

import numpy as np
import pytest
from program import run

pyvista = pytest.importorskip("pyvista", reason="NOT TESTED: scripts/venv --heavy")

ROOT = Path(__file__).parents[2]

SCENE = """
title = "A ply on a ball"
[ply]
grippers = [2, 2]
cell = ["150 mm", "100 mm"]
material = "krogh2018"
[mold]
kind = "sphere"
radius = "120 mm"
position = [0, 0, "-120 mm"]
[target]
seed = "middle"
mesh = "5 mm"
direction = "20 deg"
shear = "10 deg"
edges = "along"
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The files of one net, and what --json printed."""
    home = tmp_path_factory.mktemp("net")
    (home / "ball.toml").write_text(SCENE)
    done = run("net", str(home / "ball.toml"), "-o", str(home / "out"), "--json")
    (home / "out" / "printed.json").write_text(done.stdout)
    return home / "out"


def test_vtk_reads_the_net_that_the_table_lists(folder: Path) -> None:
    """Points are the rows of nodes.csv, to the last bit."""
    net = pyvista.read(folder / "net.vtp")
    with (folder / "nodes.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    places = [[float(row[name]) for name in ["x", "y", "z"]] for row in rows]
    assert np.array_equal(net.points, places)
    for name in ["u", "v", "i", "j"]:
        assert np.array_equal(net.point_data[name], [float(row[name]) for row in rows])
    assert np.array_equal(net.point_data["shear_deg"], [float(row["shear_deg"]) for row in rows])


def test_cells_shear_as_their_fibers_stand(folder: Path) -> None:
    """Fiber directions are unit vectors; the angle between them is 90° less the signed shear.

    Both are of the cell's middle: chords there against tangents, equal up to the square of mesh
    over radius, (5/120)² or 0.1°.
    """
    net = pyvista.read(folder / "net.vtp")
    assert net.regular_faces.shape[1] == 4
    u, v = (net.cell_data[name] for name in ("fiber_u", "fiber_v"))
    assert np.allclose(np.linalg.norm(u, axis=1), 1, atol=1e-14)
    assert np.allclose(np.linalg.norm(v, axis=1), 1, atol=1e-14)
    shear = np.degrees(np.arcsin(np.sum(u * v, axis=1)))
    assert np.max(np.abs(shear - net.cell_data["signed_shear_deg"])) < 0.1
    printed = json.loads((folder / "printed.json").read_text())
    size = net.cell_data["shear_deg"]
    assert printed["max_shear_deg"] == pytest.approx(size.max(), abs=1e-12)
    assert printed["mean_shear_deg"] == pytest.approx(size.mean(), abs=1e-12)


def test_edges_are_arcs_of_the_mesh_width(folder: Path) -> None:
    """On a sphere an edge is an arc of a great circle: its chord is 2R sin(mesh/2R)."""
    net = pyvista.read(folder / "net.vtp")
    ring = net.points[net.regular_faces]
    chords = np.linalg.norm(np.roll(ring, -1, axis=1) - ring, axis=2)
    assert np.allclose(chords, 0.24 * math.sin(0.005 / 0.24), rtol=0, atol=1e-12)


def test_the_mold_lies_on_its_sphere_under_the_net(folder: Path) -> None:
    """The mold's points are on the sphere, and its box in plan holds the net."""
    mold, net = (pyvista.read(folder / name) for name in ("mold.vtp", "net.vtp"))
    assert mold.is_all_triangles
    assert np.allclose(
        np.linalg.norm(mold.points - np.array([0, 0, -0.12]), axis=1), 0.12, atol=1e-9
    )
    assert np.all(mold.points.min(axis=0)[:2] < net.points.min(axis=0)[:2])
    assert np.all(mold.points.max(axis=0)[:2] > net.points.max(axis=0)[:2])


def test_the_hemisphere_has_the_nodes_of_an_independent_net(tmp_path: Path) -> None:
    """The example's nodes are those of the SciPy peer, which shares no code or method with ours.

    The peer's generator cells come from SLSQP with a tolerance of 5e-9 on their shear, which places
    its nodes to a micrometer on a sphere of one meter.
    """
    spec = importlib.util.spec_from_file_location("peer", ROOT / "benches" / "peers" / "net.py")
    assert spec is not None and spec.loader is not None
    peer = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(peer)
    scene = ROOT / "examples" / "hemisphere_net" / "scene.toml"
    printed = json.loads(run("net", str(scene), "-o", str(tmp_path / "out"), "--json").stdout)
    with (tmp_path / "out" / "nodes.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    nodes = np.full((24, 24, 3), np.nan)
    for row in rows:
        nodes[int(row["i"]), int(row["j"])] = [float(row[name]) for name in ["x", "y", "z"]]
    theirs = peer.net()
    assert np.abs(nodes - theirs).max() < 2e-6
    shear = np.degrees(peer.cell_shear(theirs))
    assert abs(printed["max_shear_deg"] - shear.max()) < 1e-3
    assert abs(printed["mean_shear_deg"] - shear.mean()) < 1e-3
    assert abs(printed["max_shear_deg"] - 38.005) < 0.01
    assert abs(printed["mean_shear_deg"] - 10.533) < 0.01
    assert printed["max_edge_error"] < 1e-9 and printed["off_mold"] == 0
