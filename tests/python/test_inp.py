"""Decks of `plydrape export --to inp`, solved by CalculiX and read by meshio and a reader of ours.

CalculiX knows nothing of catenaries: it hangs a sheet of shells from the same grippers.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import plydrape
import pytest
import record
from calculix import Array, Deck, ccx
from program import ROOT, run

AREAL_MASS, RIGIDITY, GRAVITY = 3.143, 9e-5, 9.8
"""The paper's ply, as strips of 100 mm: kg/m², N m, m/s²."""

HANGING = """
title = "A ply that hangs"
[ply]
grippers = [{nu}, {nv}]
cell = ["100 mm", "100 mm"]
# krogh2018 without its shear slope: shells of 100 N/m per rad can be solved
material = {{ mass = "0.3143 kg/m", flexural_rigidity = "9.0e-6 N m^2" }}
[grippers]
spacing = ["98 mm", "98 mm"]
height = "75 mm"
[motion]
kind = "hold"
[model]
kind = "catenaries"
gravity = 9.8
axial_stiffness = 1e4
"""


@dataclass
class Drape:
    """A result and the deck made from it."""

    result: Any
    lines: Callable[[int], list[Array]]
    """The catenaries of a step from gripper to gripper (m)."""
    deck: Deck


def drape(scene: Path, home: Path) -> Drape:
    """Simulates a scene and exports its deck from the result alone."""
    run("simulate", str(scene), "-o", str(home / "out"), "--quiet")
    result = home / "out" / "result.json"
    # five times the usual tension strains less than 1e-4
    tension = ("--tension", "1e5 N/m")
    run("export", str(result), "--to", "inp", *tension, "-o", str(home / "deck"), "--quiet")
    deck = Deck((home / "deck" / "ply.inp").read_text())
    return Drape(record.read(result), plydrape.Result.read(result).lines, deck)


def hanging(nu: int, nv: int, home: Path) -> Drape:
    """The paper's ply, hung 98 mm apart, without a mold."""
    (home / "scene.toml").write_text(HANGING.format(nu=nu, nv=nv))
    return drape(home / "scene.toml", home)


@pytest.fixture(scope="module")
def ply(tmp_path_factory: pytest.TempPathFactory) -> Drape:
    """3 by 2 grippers."""
    return hanging(3, 2, tmp_path_factory.mktemp("ply"))


@pytest.fixture(scope="module")
def strip(tmp_path_factory: pytest.TempPathFactory) -> Drape:
    """Two grippers that rise by 20 mm and close up by 1 mm, in two seconds."""
    home = tmp_path_factory.mktemp("strip")
    rows = ["t,gripper,x,y,z"]
    for t, left, right, height in [(0, 0, 98, 75), (1, 0, 98, 95), (2, 0.5, 97.5, 95)]:
        rows += [
            f"{t},0-0,{left / 1e3},0,{height / 1e3}",
            f"{t},1-0,{right / 1e3},0,{height / 1e3}",
        ]
    (home / "motion.csv").write_text("\n".join([*rows, ""]))
    scene = HANGING.format(nu=2, nv=1).replace('"hold"', '"file"\nfile = "motion.csv"')
    scene = scene.split("[grippers]")[0] + "[motion]" + scene.split("[motion]")[1]
    (home / "scene.toml").write_text(scene)
    return drape(home / "scene.toml", home)


@pytest.fixture(scope="module")
def dome(tmp_path_factory: pytest.TempPathFactory) -> Drape:
    """4 by 4 grippers lay a ply on a dome."""
    return drape(ROOT / "examples" / "ideal_dome" / "scene.toml", tmp_path_factory.mktemp("dome"))


@pytest.fixture(scope="module")
def cell(tmp_path_factory: pytest.TempPathFactory) -> Drape:
    """2 by 2 grippers: a cell whose edges have no neighbors."""
    return hanging(2, 2, tmp_path_factory.mktemp("cell"))


@pytest.fixture(scope="module")
def solved(cell: Drape, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Array]:
    """The hanging cell by CalculiX, to the end of the deck."""
    return ccx(cell.deck.text, tmp_path_factory.mktemp("ccx"))


def sag_of_model(drape: Drape, cell: int, row: int) -> float:
    """Depth (m) of the model's catenary along u below its grippers, in the last step."""
    (edge,) = [
        n
        for n, line in enumerate(drape.result["steps"][-1]["catenaries"])
        if line["from"] == [cell, row] and line["to"] == [cell + 1, row]
    ]
    heights = drape.lines(-1)[edge][:, 2]
    return float(heights[0] - heights.min())


def sag_of_sheet(drape: Drape, found: dict[str, Array], cell: int, row: int) -> float:
    """Depth (m) of the sheet in the middle of that edge; the grippers are level."""
    nu = drape.result["scene"]["ply"]["grid"]["nu"]
    node = drape.deck.node_set("MIDDLE_U")[row * (nu - 1) + cell]
    rows = found["MIDDLE_U U"]
    (moved,) = rows[rows[:, 0] == node]
    return float(found["GRIPPERS U"][:, 3].mean() - moved[3])


def test_a_sheet_sags_at_its_long_edges_as_the_catenaries_do(
    cell: Drape, solved: dict[str, Array]
) -> None:
    """Within 12 %, and deeper, since the sheet loads the middle of its edges.

    It cannot be much deeper than two straight halves of the fabric, half of 100 mm over half of
    98 mm; 2 % are left for its strain beside the grippers.
    """
    for row in (0, 1):
        ours, theirs = sag_of_model(cell, 0, row), sag_of_sheet(cell, solved, 0, row)
        assert abs(theirs / ours - 1) < 0.12, f"{ours * 1e3:.2f} mm, CalculiX {theirs * 1e3:.2f} mm"
        assert ours < theirs < 1.02 * np.sqrt(0.05**2 - 0.049**2)


def test_the_grippers_carry_the_weight(cell: Drape, solved: dict[str, Array]) -> None:
    """Reactions add up to the ply's weight: areal mass times g times its area.

    CalculiX prints the forces inside the sheet at the held nodes, so without the weight that acts
    on these nodes themselves. A corner of an element of eight nodes has -1/12 of the element's
    weight; each gripper holds a corner of one element. Of a cut ply grippers hold several.
    """
    weight = AREAL_MASS * GRAVITY * 0.1 * 0.1
    own = -4 / 12 * weight / len(cell.deck.elements("S8R"))
    force = solved["GRIPPERS RF total"][0]
    assert force[2] + own == pytest.approx(weight, rel=1e-4)
    assert np.abs(force[:2]).max() < 1e-6 * weight


def test_the_mesh_is_fine_enough(cell: Drape, solved: dict[str, Array], tmp_path: Path) -> None:
    """Elements of twice the side change the sag by less than 5 %; those of half by less still."""
    coarse = ccx(cell.deck.coarser(), tmp_path)
    fine = sag_of_sheet(cell, solved, 0, 0)
    assert sag_of_sheet(cell, coarse, 0, 0) == pytest.approx(fine, rel=0.05)


def test_a_strip_of_shells_is_a_span(strip: Drape, tmp_path: Path) -> None:
    """Held along whole lines a strip has no width to differ by: shells and span agree.

    This is at the end of its motion, so CalculiX followed the tables through both steps. The
    small-sag span sags by a few tenths of a percent more than the exact elastica.
    """
    found = ccx(strip.deck.text, tmp_path)
    assert sag_of_sheet(strip, found, 0, 0) == pytest.approx(sag_of_model(strip, 0, 0), rel=0.015)


def test_a_clamped_strip_bends_as_its_rigidity_says(strip: Drape, tmp_path: Path) -> None:
    """The tip of a cantilever sinks by q L^4/(8 D), in linear theory."""
    model = strip.deck.text[: strip.deck.text.index("*AMPLITUDE")]
    load = [
        "*STEP",
        "*STATIC",
        "*BOUNDARY",
        "g0_0, 1, 6",
        "*DLOAD",
        f"PLY, GRAV, {GRAVITY}, 0, 0, -1",
        "*NODE PRINT, NSET=g1_0",
        "U",
        "*END STEP",
    ]
    tip = -ccx(model + "\n".join([*load, ""]), tmp_path)["G1_0 U"][:, 3]
    assert tip == pytest.approx(AREAL_MASS * GRAVITY * 0.1**4 / (8 * RIGIDITY), rel=0.01)


def test_the_section_has_the_ply_s_numbers(ply: Drape) -> None:
    """E h³/12 is the rigidity, E h the axial stiffness, density times h the mass, all per area."""
    moduli, density, h = ply.deck.section()
    assert moduli[:2] * h**3 / 12 == pytest.approx(RIGIDITY, rel=1e-8)
    assert moduli[:2] * h == pytest.approx(1e4 / 0.1, rel=1e-8)
    assert density * h == pytest.approx(AREAL_MASS, rel=1e-8)
    assert "ASSUMED" in ply.deck.text, "the material has no shear curve"


@pytest.mark.parametrize("name", ["ply", "dome"])
def test_tables_lead_the_grippers_through_every_step(
    name: str, request: pytest.FixtureRequest
) -> None:
    """Flat node plus table is the result's gripper in every step, a second later in time."""
    drape: Drape = request.getfixturevalue(name)
    places = drape.deck.nodes()
    moves = {
        (data[0][0], int(data[0][1])): has["AMPLITUDE"]
        for has, data in drape.deck.find("BOUNDARY")
        if "AMPLITUDE" in has
    }
    assert moves
    for k, first in enumerate(drape.result["steps"][0]["grippers"]):
        gripper = "g{}_{}".format(*first["id"])
        (node,) = drape.deck.node_set(gripper)
        for axis in range(3):
            due = [step["grippers"][k]["position"][axis] for step in drape.result["steps"]]
            table = moves.get((gripper, axis + 1))
            if table is None:
                assert due == pytest.approx([places[node][axis]] * len(due), abs=1e-9)
                continue
            pairs = np.array(drape.deck.numbers("AMPLITUDE", NAME=table)).reshape(-1, 2)
            assert pairs[:2].tolist() == [[0.0, 0.0], [0.1, 0.0]], "flat while gravity grows"
            times = [1.0 + step["time"] for step in drape.result["steps"]]
            assert pairs[2:, 0] == pytest.approx(times)
            assert places[node][axis] + pairs[2:, 1] == pytest.approx(due, abs=1e-9)


@pytest.mark.parametrize("name", ["ply", "strip", "dome"])
def test_meshio_reads_the_deck(name: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    """Quadrilaterals of eight nodes cover the flat ply: as many as due, and no gap."""
    drape: Drape = request.getfixturevalue(name)
    (tmp_path / "ply.inp").write_text(drape.deck.text)
    mesh = meshio.read(tmp_path / "ply.inp")
    cells = {block.type: block.data for block in mesh.cells}
    grid = drape.result["scene"]["ply"]["grid"]
    along, across = grid["nu"] - 1, max(grid["nv"] - 1, 1)
    n, m = 10 * along, 10 * across
    quads = cells["quad8"]
    assert len(quads) == n * m
    assert len(np.unique(quads)) == (n + 1) * (m + 1) + n * (m + 1) + m * (n + 1)
    corners = mesh.points[quads[:, :4]]
    twice = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    assert np.linalg.norm(twice, axis=1).sum() / 2 == pytest.approx(along * across * 0.01)
    if name == "dome":
        triangles = mesh.points[cells["triangle"]]
        ball = np.linalg.norm(triangles - [0, 0, -0.6], axis=2)
        assert ball == pytest.approx(0.6, abs=1e-9), "the mold's corners are on the dome"
        normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        assert (normals[:, 2] > 0).all(), "its upper side is the one that touches"


def test_calculix_takes_a_deck_with_a_mold(tmp_path: Path) -> None:
    """CalculiX reads all of the deck, and solves the first hundred thousandth of each step.

    Four grippers on the dome: the mold is as finely divided as below sixteen.
    """
    scene = (ROOT / "examples" / "ideal_dome" / "scene.toml").read_text()
    (tmp_path / "scene.toml").write_text(scene.replace("grippers = [4, 4]", "grippers = [2, 2]"))
    text, share = drape(tmp_path / "scene.toml", tmp_path).deck.text, 1e-5
    assert text.count("*STEP") == 2 and "*CONTACT PAIR" in text
    lines = text.splitlines()
    for k, line in enumerate(lines):
        if line.startswith("*STATIC"):
            period = share * float(lines[k + 1].split(",")[1])
            lines[k + 1] = f"{period}, {period}"
        if line.startswith("PLY, GRAV"):
            lines[k] = f"PLY, GRAV, {share * GRAVITY}, 0, 0, -1"
    found = ccx("\n".join([*lines, ""]), tmp_path)
    assert np.isfinite(found["GRIPPERS U"]).all() and len(found["GRIPPERS U"]) == 4


def test_a_sheet_rests_on_the_mold(tmp_path: Path) -> None:
    """Held 3 mm above a plane, a small ply that would sag by 5 mm touches it and is carried by it.

    It stays above the plane but for the depth of the penalty, and the grippers do not feel all of
    the weight; slack between them and the plane even pushes them up. The plane is a mesh of two
    triangles, since CalculiX looks for contact in all that there are.
    """
    scene = HANGING.format(nu=2, nv=2).replace("75 mm", "3 mm")
    scene = scene.replace("100 mm", "60 mm").replace("98 mm", "58.8 mm")
    corners = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
    (tmp_path / "mold.obj").write_text(corners + "f 1 2 3\nf 1 3 4\n")
    mold = '[mold]\nkind = "mesh"\nfile = "mold.obj"\nunit = "m"\n'
    (tmp_path / "scene.toml").write_text(scene + mold)
    plane = drape(tmp_path / "scene.toml", tmp_path)
    found = ccx(plane.deck.text, tmp_path)
    heights = 0.003 + found["MIDDLE_U U"][:, 3]
    assert (heights > -2e-4).all() and (heights < 0.0012).any()
    # the mass of a line, on a strip of one cell
    weight = AREAL_MASS * (0.100 / 0.060) * GRAVITY * 0.060**2
    assert found["GRIPPERS RF total"][0][2] < 0.9 * weight


def test_a_cut_ply_hangs_from_its_grippers(tmp_path: Path) -> None:
    """CalculiX hangs a ply with a corner off and a hole: reactions add up to its own weight.

    The elements cover the ply to half an element at its boundary. Of each element that a gripper
    holds by a corner, -1/12 of the weight acts on the held node and is no reaction.
    """
    scene = HANGING.replace("{{", "{").replace("}}", "}").replace("98 mm", "49 mm")
    cut = """outline = [[0, 0], ["80 mm", 0], ["80 mm", "55 mm"], ["55 mm", "80 mm"], [0, "80 mm"]]
holes = [{ middle = ["35 mm", "35 mm"], diameter = "25 mm" }]
grippers = [2, 2]
cell = ["50 mm", "50 mm"]
array = { middle = ["35 mm", "35 mm"], margin = "5 mm" }"""
    scene = scene.replace('grippers = [{nu}, {nv}]\ncell = ["100 mm", "100 mm"]', cut)
    (tmp_path / "scene.toml").write_text(scene)
    ply = drape(tmp_path / "scene.toml", tmp_path)
    places, elements = ply.deck.nodes(), ply.deck.elements("S8R")
    corners = np.array([[places[node] for node in nodes[:4]] for nodes in elements])
    diagonals = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    areas = np.linalg.norm(np.cross(*diagonals), axis=1) / 2
    due = 0.08**2 - 0.025**2 / 2 - np.pi * 0.0125**2
    assert areas.sum() == pytest.approx(due, rel=0.05)

    found = ccx(ply.deck.text, tmp_path)
    _, density, thickness = ply.deck.section()
    held = set(ply.deck.node_set("GRIPPERS"))
    touching = np.array([len(held.intersection(nodes[:4])) for nodes in elements])
    weights = density * thickness * GRAVITY * areas
    force = found["GRIPPERS RF total"][0]
    assert len(held) == 4
    assert force[2] - (touching * weights).sum() / 12 == pytest.approx(weights.sum(), rel=1e-4)
