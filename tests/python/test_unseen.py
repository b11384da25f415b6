"""The random scenes of benches/unseen, and how their plans are counted."""

from __future__ import annotations

import csv
import json
import math
import random
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import plydrape
import pytest
import tomllib
from cells import BENDING, GRAVITY
from families import FAMILIES
from ideal import MAX_SHEAR_DEG, MAX_TILT_DEG, Plydrape
from molds import Draw
from pickup import MAX_HANG_DEG, PickUp
from plies import SIZES, Array
from program import binary, run
from reach import MATERIALS, MOLDS
from reach import scene as usual
from run import Run, row_of
from run import run as timed
from scenes import Scene, Task, scene, write
from summary import tables
from units import table

TASK = Task(seed=909, sizes=list(SIZES))
COUNT = 20


@pytest.fixture(scope="module")
def scenes() -> list[Scene]:
    """Twenty scenes of a seed, one of which was too steep and drawn again."""
    program = Plydrape(binary())
    return [scene(TASK, index, program, Counter()) for index in range(COUNT)]


@pytest.fixture(scope="module")
def nets(scenes: list[Scene], tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Folders of their ideal drapes."""
    home = tmp_path_factory.mktemp("unseen")
    folders = []
    for made in scenes:
        path = home / f"{made.row['scene']}.toml"
        path.write_text(made.text, encoding="utf-8")
        path.with_suffix(".stl").write_bytes(made.mold.mesh)
        assert run("check", str(path)).returncode == 0
        done = run("net", str(path), "-o", str(path.with_suffix("")), "--json")
        assert done.returncode == 0
        (path.with_suffix("") / "printed.json").write_text(done.stdout)
        folders.append(path.with_suffix(""))
    return folders


def nodes(folder: Path) -> list[dict[str, float]]:
    """The nodes of an ideal drape that are on the ply."""
    with (folder / "nodes.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    # a node of a ply that is cut has no place in an array
    on = [row for row in rows if row["on_ply"] == "1"]
    return [{name: float(text) for name, text in row.items() if text} for row in on]


def tilt(net: dict[tuple[int, int], list[float]], node: tuple[int, int]) -> float:
    """Angle of a net to the plane at a node (degrees), from the neighbors that it has."""
    (i, j), here = node, net[node]
    along = [
        [b - a for a, b in zip(net.get(before, here), net.get(after, here), strict=True)]
        for before, after in [((i - 1, j), (i + 1, j)), ((i, j - 1), (i, j + 1))]
    ]
    normal = np.cross(np.array(along[0]), np.array(along[1]))
    return math.degrees(math.atan2(math.hypot(normal[0], normal[1]), normal[2]))


def test_a_seed_gives_the_same_bytes(scenes: list[Scene], tmp_path: Path) -> None:
    """And a scene does not depend on how many are written: of ten the first are those of twenty."""
    write(TASK, 10, tmp_path, Plydrape(binary()))
    due = {f"{made.row['scene']}.toml": made.text.encode() for made in scenes[:10]}
    due |= {f"{made.row['scene']}.stl": made.mold.mesh for made in scenes[:10] if made.mold.mesh}
    assert len(due) == 11  # ten scenes and the mesh of one
    found = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    rows = list(csv.DictReader(found.pop("scenes.csv").decode().splitlines()))
    assert found == due and rows == [made.row for made in scenes[:10]]


def test_worlds_differ_in_cell_and_material_alone() -> None:
    """The paper's ply in an ideal cell is drawn the same mold, cut, target and friction."""
    program = Plydrape(binary())
    ideal = Task(TASK.seed, TASK.sizes, "ideal")
    for index in range(4):
        usual, paper = (scene(task, index, program, Counter()) for task in (TASK, ideal))
        assert 'preset = "ideal"' in paper.text and 'material = "krogh2018"' in paper.text
        for name in ("family", "ply", "grippers", "cell (mm)", "friction", "shear (deg)"):
            assert usual.row[name] == paper.row[name]


def test_no_edge_of_a_ply_that_sticks_is_longer_than_half_its_bending_length() -> None:
    """The bending lengths are those of the materials; longer edges touch the mold and fold."""
    for name, length in BENDING.items():
        ply = plydrape.Material.shipped(name)
        assert ply.bending_rigidity is not None
        fall = min(ply.bending_rigidity) / (GRAVITY * ply.mass)
        assert length == pytest.approx(fall ** (1 / 3), rel=5e-3)


def test_every_family_has_its_turn(scenes: list[Scene]) -> None:
    """Each of the seventeen once before any has its second turn."""
    names = [made.row["family"] for made in scenes]
    assert sorted(names[: len(FAMILIES)]) == sorted(FAMILIES)
    assert len(set(names[len(FAMILIES) :])) == COUNT - len(FAMILIES)


@pytest.mark.parametrize("family", FAMILIES)
def test_a_mold_is_below_all_of_its_ply(family: str) -> None:
    """However the ply is turned: its corners, and those of the edge beyond its cups."""
    for seed in range(20):
        array, edge = Array((2, 2), (0.109, 0.088)), 0.046
        mold = FAMILIES[family](Draw(random.Random(seed), array, edge))
        corner = math.hypot(*(0.5 * side + edge for side in array.extent))
        for turn in range(0, 360, 5):
            cos, sin = math.cos(math.radians(turn)), math.sin(math.radians(turn))
            x, y = mold.middle[0] + corner * cos, mold.middle[1] + corner * sin
            assert math.isfinite(mold.height(x, y)), (seed, turn)


def test_the_ideal_drape_lies_on_the_mold_that_was_drawn(
    scenes: list[Scene], nets: list[Path]
) -> None:
    """Numbers are written with six digits, and a mesh is off by a chord's height."""
    for made, folder in zip(scenes, nets, strict=True):
        off = 1e-4 if made.mold.mesh else 2e-5
        for node in nodes(folder):
            assert abs(made.mold.height(node["x"], node["y"]) - node["z"]) < off, made.text


def test_ideal_drapes_keep_to_what_tilt_and_shear_allow(
    scenes: list[Scene], nets: list[Path]
) -> None:
    """Tilts again from the net: over 10 mm at a corner a mold turns by up to 4 degrees."""
    for made, folder in zip(scenes, nets, strict=True):
        printed = json.loads((folder / "printed.json").read_text())
        assert printed["max_shear_deg"] <= MAX_SHEAR_DEG
        assert float(made.row["tilt (deg)"]) <= MAX_TILT_DEG
        if made.row["ply"] != "rectangle":
            continue  # its grippers are no nodes of the net
        net = {
            (int(node["i"]), int(node["j"])): [node["x"], node["y"], node["z"]]
            for node in nodes(folder)
        }
        count = [int(number) for number in made.row["grippers"].split(" × ")]
        divisions = [(n - 1) // (c - 1) for n, c in zip(printed["nodes"], count, strict=True)]
        steepest = max(
            tilt(net, (i * divisions[0], j * divisions[1]))
            for i in range(count[0])
            for j in range(count[1])
        )
        assert steepest == pytest.approx(float(made.row["tilt (deg)"]), abs=2.0)


def test_the_ply_hangs_clear_of_the_mold_within_the_tilt_of_its_grippers(
    scenes: list[Scene], nets: list[Path]
) -> None:
    """Held still where it is picked up, by catenaries; small arrays hang by 1 degree more.

    No catenaries run between cups across the yarns, so plies on the bias are not among them.
    """
    for made, folder in zip(scenes, nets, strict=True):
        if made.row["ply"] == "bias":
            continue
        path = folder.with_name(f"{folder.name}.held.toml")
        # catenaries hold their grippers rigidly
        text = made.text.replace('preset = "usual"', 'preset = "ideal"')
        path.write_text(text + '\n[motion]\nkind = "hold"\n', encoding="utf-8")
        done = run("simulate", str(path), "--model", "catenaries", "--json")
        printed = json.loads(done.stdout)
        assert printed["catenaries"]["first_contact_step"] is None, made.text
        assert printed["worst"]["tilt_deg"] < MAX_HANG_DEG + 1.0, made.text


def test_a_loose_pick_up_is_drawn_taut_to_the_angle_it_may_hang_at(tmp_path: Path) -> None:
    """Catenaries of the least spacing hang 3 degrees too steeply; then they hang at 35 degrees."""
    ply = Array((3, 3), (0.1, 0.1))
    loose = PickUp("above", (0.05, 0.05), 0.5)
    tilts = []
    for name, pick_up in {"loose": loose, "taut": loose.taut("krogh2018")}.items():
        text = '[ply]\ngrippers = [3, 3]\ncell = [0.1, 0.1]\nmaterial = "krogh2018"\n'
        text += '[mold]\nkind = "plane"\n[target]\nseed = "middle"\n[motion]\nkind = "hold"\n'
        path = tmp_path / f"{name}.toml"
        path.write_text(text + table("grippers", pick_up.keys(ply)))
        done = run("simulate", str(path), "--model", "catenaries", "--json")
        tilts.append(json.loads(done.stdout)["worst"]["tilt_deg"])
    assert tilts[0] > MAX_HANG_DEG + 2.0
    assert tilts[1] == pytest.approx(MAX_HANG_DEG, abs=1.0)
    assert loose.taut("cao2008_plain").slack == pytest.approx((0.0223, 0.0223), abs=1e-4)


SCENE = {
    "scene": "000",
    "family": "dome",
    "size": "small",
    "ply": "rectangle",
    "grippers": "3 × 2",
    "material": "dry_carbon",
    "friction": "0.3",
    "start": "above",
}


def plan(accepted: bool, height: float) -> str:
    """What the planner prints, as far as it is read."""
    limit = {"name": "height", "value": height, "limit": 0.5, "unit": "mm", "where": "somewhere"}
    end, limits = {"height_mm": height}, [{**limit, "ok": height <= 0.5}]
    return json.dumps({"accepted": accepted, "evaluations": 7, "final": end, "limits": limits})


@pytest.mark.parametrize(
    ("code", "out", "result"),
    [
        (0, plan(True, 0.2), "accepted"),
        (1, plan(False, 0.9), "not accepted"),
        (0, plan(False, 0.9), "not accepted"),
        (0, plan(True, math.nan), "failed"),
        (3, plan(True, 0.2), "failed"),
        (-6, "", "failed"),
        (0, "", "failed"),
    ],
)
def test_a_plan_is_accepted_not_accepted_or_failed(code: int, out: str, result: str) -> None:
    """Any exit code but 0 and 1, a NaN, and silence are failures."""
    row = row_of(SCENE, Run(code, False, 1.5, 20.0, out, ""))
    assert row["result"] == result
    if result == "not accepted":
        assert row["limit"] == "height" and row["value"] == "0.900"


def test_a_plan_that_only_errors_refuse_is_listed_with_the_limit_that_they_break() -> None:
    """With how many of the cells keep all limits; before, it had the closest limit that is kept."""
    printed = json.loads(plan(False, 0.4))
    high = {**printed["limits"][0], "value": 1.3, "ok": False}
    draped = [{"accepted": accepted} for accepted in (False, True, False)]
    out = json.dumps({**printed, "sample": {"limits": [high], "cells": draped}})
    row = row_of(SCENE, Run(1, False, 1.5, 20.0, out, ""))
    assert (row["limit"], row["value"], row["cells"]) == ("height", "1.300", "1 of 3")
    assert row["height (mm)"] == "0.400"
    assert "| 000 | dome | 3 × 2 | above | not accepted | 0.400 | 1 of 3 | height" in tables([row])


def test_a_refused_plan_is_listed_with_the_change_that_helps_most() -> None:
    """By the cells that then keep every limit, or by what is exceeded without errors."""
    printed = json.loads(plan(False, 0.9))
    limit = printed["limits"][0]

    def listed(change: object, height: float, *, helps: bool = True) -> str:
        near = {"limit": {**limit, "value": height, "ok": height <= 0.5}, "kept": 7, "cells": 8}
        tried = [{"change": change, "near": near, "helps": helps}]
        out = json.dumps({**printed, "tried": tried})
        return row_of(SCENE, Run(1, False, 1.5, 20.0, out, ""))["helps"]

    assert listed({"friction": 0.3}, 0.4) == "friction 0.3: 7 of 8 cells"
    assert listed("stick", 0.8) == "stick: height 0.8 mm"
    assert listed({"grippers": [4, 3]}, 0.8, helps=False) == ""


def test_examples_are_planned_with_real_plies_in_the_usual_cell(tmp_path: Path) -> None:
    """Each scene of the table has its material and the preset of the cell, and finds its mold."""
    for example, count in MOLDS.items():
        for material in MATERIALS[:count]:
            keys = tomllib.loads(usual(example, material))
            assert keys["cell"]["preset"] == "usual", example
            assert keys["ply"]["material"] == material, example
    file = tmp_path / "mesh.toml"
    file.write_text(usual("08_stl_mold", "prepreg_warm"))
    run("check", str(file))


def test_time_and_memory_are_those_of_the_program() -> None:
    """It sleeps for 0.2 s and holds 200 MB; what this process holds is not counted."""
    held = bytearray(b"a") * 500_000_000
    script = "import time; x = bytearray(b'a' * 100_000_000); time.sleep(0.2); print('out')"
    done = timed([sys.executable, "-c", script], 60.0)
    del held
    assert done.exit == 0 and not done.late and done.out == "out\n"
    assert 0.2 <= done.seconds < 30.0
    assert 100.0 < done.memory_mb < 400.0


def test_a_program_that_takes_too_long_is_ended() -> None:
    """Its row says so."""
    late = timed([sys.executable, "-c", "import time; time.sleep(100)"], 0.2)
    assert late.late and late.seconds < 50.0
    assert row_of(SCENE, late)["result"] == "out of time"


def test_tables_count_every_scene() -> None:
    """Accepted ones in shares, others in a list, failed ones apart."""
    ends = [(0, plan(True, 0.2)), (1, plan(False, 0.9)), (-11, "")]
    rows = [row_of(SCENE, Run(code, False, 2.0, 20.0, out, "")) for code, out in ends]
    text = tables(rows)
    assert "1/3 scenes accepted" in text
    assert "| dome | 1/3 | 2.0 | 2.0 | 7 | 20 |" in text
    assert "What stopped the others: height 1\n" in text
    assert "| 000 | dome | 3 × 2 | -11 | no JSON |" in text
