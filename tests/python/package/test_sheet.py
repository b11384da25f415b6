"""The sheet of a result: its arrays, its file, and who drapes it.

The mesh is coarse: nothing here is about the cloth.
"""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import plydrape
import plydrape.study
import pytest
from plydrape.study import Study
from program import binary
from studies import PAPER, rows

COARSE = PAPER.read_text().replace("[contact]", '[sheet]\nmesh = "25 mm"\n\n[contact]')


@pytest.fixture(scope="module")
def scene() -> plydrape.Scene:
    """The paper's example; its own model are the catenaries."""
    return plydrape.Scene.parse(COARSE)


@pytest.fixture(scope="module")
def result(scene: plydrape.Scene) -> plydrape.Result:
    """It draped by the sheet."""
    return plydrape.simulate(scene, model="sheet")


def sheet_of(result: plydrape.Result) -> plydrape.Sheet:
    """Sheet, which it has."""
    assert result.sheet is not None
    return result.sheet


def test_the_arrays_have_their_documented_shapes(result: plydrape.Result) -> None:
    """Lines every 25 mm: 13 by 5 nodes, 12 by 4 cells, 12 · 5 + 13 · 4 segments."""
    sheet = sheet_of(result)
    states, nodes, cells, segments, grippers = 30, 65, 48, 112, 8
    shapes = {
        "steps": (states,),
        "times": (states,),
        "positions": (states, nodes, 3),
        "places": (nodes, 2),
        "areas": (nodes,),
        "segments": (segments, 2),
        "cells": (cells, 4),
        "landing_step": (nodes,),
        "heights": (states, nodes),
        "contact": (states, nodes),
        "shear": (states, cells),
        "tension": (states, segments),
        "grippers": (states, grippers, 3),
        "pad_forces": (states, grippers, 3),
        "pad_quaternions": (states, grippers, 4),
    }
    assert {name: getattr(sheet, name).shape for name in shapes} == shapes
    assert sheet.contact.dtype == bool and sheet.positions.dtype == float
    assert sheet.steps.tolist() == list(range(1, 31))


def test_the_arrays_are_those_of_one_sheet(result: plydrape.Result) -> None:
    """The mold is z = 0; grippers go where the motion has them; what lies has landed."""
    sheet = sheet_of(result)
    assert np.array_equal(sheet.heights, sheet.positions[:, :, 2])
    assert np.allclose(sheet.grippers, result.positions, atol=1e-12)
    assert sheet.areas.sum() == pytest.approx(0.3 * 0.1, rel=1e-12)
    along = sheet.positions[0][sheet.segments]
    lengths = np.linalg.norm(along[:, 1] - along[:, 0], axis=1)
    assert np.allclose(lengths, 0.025, rtol=1e-3)
    assert np.array_equal(sheet.landing_step > 0, sheet.contact[-1])
    last, worst = result.summary["final"], result.summary["worst"]
    assert 1e3 * sheet.heights[-1].max() == pytest.approx(last["height_mm"], rel=1e-9)
    shear = np.degrees(np.abs(sheet.shear).max())
    assert shear == pytest.approx(worst["shear_deg"], rel=1e-9)
    # vertical forces of the ply on its grippers are its weight, in the air
    weight = 3.143 * 0.03 * 9.8
    assert sheet.pad_forces[0, :, 2].sum() == pytest.approx(-weight, rel=1e-3)
    assert np.allclose(sheet.pad_forces, result.loads, atol=1e-12)


def test_one_model_decides(scene: plydrape.Scene, result: plydrape.Result) -> None:
    """Its verdict is that of the result, and the other model beside it changes nothing."""
    assert result.model == "sheet" and result.also is None
    alone = plydrape.simulate(scene)
    assert alone.model == "catenaries" and alone.sheet is None and "sheet" not in alone.summary
    assert {*alone.limits} != {*result.limits}
    slippery = plydrape.Scene.parse(COARSE + "friction = 0.3\n")
    flat = plydrape.simulate(slippery, model="sheet")
    assert flat.accepted and flat.converged and not result.accepted
    assert not plydrape.simulate(slippery, model="catenaries").accepted

    both = plydrape.simulate(slippery, model="sheet", also="catenaries")
    assert both.accepted and both.summary == flat.summary and both.limits == flat.limits
    for name in ("times", "positions", "commanded", "quaternions", "tilts_deg", "loads"):
        assert np.array_equal(getattr(both, name), getattr(flat, name)), name
    assert {*both.measures} == {*flat.measures}


def test_the_other_model_stands_beside(scene: plydrape.Scene, result: plydrape.Result) -> None:
    """It comes out as it does alone, and has no verdict."""
    alone = plydrape.simulate(scene)
    for both, other in (
        (plydrape.simulate(scene, model="sheet", also="catenaries"), alone),
        (plydrape.simulate(scene, also="sheet"), result),
        (plydrape.batch.simulate([scene], also="sheet")[0], result),
    ):
        beside = both.also
        assert beside is not None and beside.model == other.model != both.model
        assert not {"accepted", "limits"} & {*dir(beside)}
        judged = {"accepted", "limits", "sample", "tolerance", "tool", "world"}
        kept = {key: value for key, value in other.summary.items() if key not in judged}
        assert beside.summary == kept
        for name in ("times", "positions", "commanded", "quaternions", "tilts_deg", "loads"):
            assert np.array_equal(getattr(beside, name), getattr(other, name)), name
        assert {*beside.measures} == {*other.measures}
        assert np.array_equal(both.forces, alone.forces, equal_nan=True)
        assert np.array_equal(sheet_of(both).positions, sheet_of(result).positions)
        again = pickle.loads(pickle.dumps(beside))
        assert again == beside and np.array_equal(again.loads, beside.loads)


def test_catenaries_that_were_not_draped_say_how_to_ask_for_them(result: plydrape.Result) -> None:
    """Of every array, line and table."""
    for name in ("forces", "slack_mm", "contact", "shear_deg"):
        with pytest.raises(ValueError, match='also="catenaries"'):
            getattr(result, name)
    for call in (result.lines, result.contact_lines, result.surface):
        with pytest.raises(ValueError, match='also="catenaries"'):
            call(1)
    with pytest.raises(ValueError, match='also="catenaries"'):
        result.to_pandas("catenaries")
    assert "catenary" not in result.to_xarray().dims
    assert not {"slack_mm", "force_n"} & {*result.measures}


def test_a_folder_gives_the_same_sheet(result: plydrape.Result, tmp_path: Path) -> None:
    """By `Result.read` and by `numpy.load`; a file that was changed is refused."""
    written = result.write(tmp_path / "out")
    assert "sheet.npz" in {path.name for path in written}
    again = plydrape.Result.read(tmp_path / "out" / "result.json")
    sheet, read = sheet_of(result), sheet_of(again)
    for name in ("positions", "places", "heights", "contact", "shear", "tension", "pad_forces"):
        assert np.array_equal(getattr(sheet, name), getattr(read, name)), name
    assert read.summary == sheet.summary
    with np.load(tmp_path / "out" / "sheet.npz") as arrays:
        assert np.array_equal(arrays["positions"], sheet.positions)
        assert np.array_equal(arrays["height"], sheet.heights)
    # once more from there
    again.write(tmp_path / "copy")
    bytes_of = [(tmp_path / name / "sheet.npz").read_bytes() for name in ("out", "copy")]
    assert bytes_of[0] == bytes_of[1]

    file = tmp_path / "out" / "sheet.npz"
    file.write_bytes(bytes_of[0][:-1])
    with pytest.raises(plydrape.ResultError, match=r"sheet\.npz"):
        _ = again.sheet
    with pytest.raises(plydrape.OutputError):
        again.write(tmp_path / "third")
    assert not (tmp_path / "third").exists()


def test_a_batch_drapes_sheets(scene: plydrape.Scene, result: plydrape.Result) -> None:
    """On all cores as alone, to the last bit."""
    for other in plydrape.batch.simulate([scene, scene], model="sheet"):
        assert np.array_equal(sheet_of(other).positions, sheet_of(result).positions)
    assert plydrape.batch.simulate([scene])[0].sheet is None


def test_a_study_has_columns_of_the_sheet() -> None:
    """Less friction, a lower ply; the share of accepted drapes is by the sheet."""
    made = Study.of(
        {
            "scene": str(PAPER),
            "sampling": "grid",
            "vary": {
                "model.kind": {"values": ["sheet"]},
                "sheet.mesh": {"values": ["25 mm"]},
                "contact.friction": {"values": ["30 %", "3000 %"]},
            },
        }
    )
    outcome = plydrape.study.run(made, workers=1, progress=False)
    slippery, sticky = rows(outcome.table())
    assert slippery["error"] is None and sticky["error"] is None
    assert slippery["accepted"] and not sticky["accepted"]
    assert slippery["final_height_mm"] < 0.5 < sticky["final_height_mm"]
    assert sticky["value_height"] == sticky["final_height_mm"]
    assert not sticky["ok_height"] and sticky["limit_height"] == 0.5
    assert sticky["sheet.nodes"] == 65 and sticky["status"] == "converged"
    # what catenaries alone are judged by has no column
    assert sticky["model"] == "sheet" and "ok_slack_ratio" not in sticky
    assert outcome.accepted_share == 0.5
    units = {f.name: (f.metadata or {}).get(b"unit") for f in outcome.table().schema}
    assert units["height_rms_mm"] == b"mm" and units["value_height"] == b"mm"


def test_a_scene_without_a_sheet_is_refused_before_anything_runs() -> None:
    """The paper's own numbers alone say nothing of tension and shear."""
    bare = '{ mass = "0.3143 kg/m", flexural_rigidity = "9e-6 N m^2" }'
    scene = plydrape.Scene.parse(COARSE.replace('"krogh2018"', bare))
    for call in (
        lambda: plydrape.simulate(scene, model="sheet"),
        lambda: plydrape.simulate(scene, also="sheet"),
        lambda: plydrape.batch.simulate([scene], model="sheet"),
        lambda: plydrape.plan(scene, also="sheet"),
        lambda: plydrape.simulate(scene.with_motion(scene.times, scene.positions), model="sheet"),
    ):
        with pytest.raises(plydrape.SceneError, match="tension") as refused:
            call()
        assert refused.value.help
    with pytest.raises(ValueError, match='model is "cloth"; expected "sheet" or "catenaries"'):
        plydrape.simulate(scene, model="cloth")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match='also is "cloth"; expected "sheet" or "catenaries"'):
        plydrape.simulate(scene, also="cloth")  # type: ignore[arg-type]
    with pytest.raises(plydrape.SceneError, match="beside the one that decides is that one"):
        plydrape.simulate(scene, also="catenaries")


@pytest.mark.parametrize("option", ["--model", "--also"])
def test_a_model_that_cannot_drape_is_refused_as_on_the_command_line(
    option: str, tmp_path: Path
) -> None:
    """Message, remedy, line and column are those of `plydrape simulate`."""
    bare = '{ mass = "0.3143 kg/m", flexural_rigidity = "9e-6 N m^2" }'
    file = tmp_path / "scene.toml"
    file.write_text(COARSE.replace('"krogh2018"', bare))
    asked: dict[str, Any] = {option.removeprefix("--"): "sheet"}
    with pytest.raises(plydrape.SceneError) as refused:
        plydrape.simulate(plydrape.Scene.read(file), **asked)
    error = refused.value
    done = subprocess.run(
        [binary(), "simulate", file, option, "sheet", "-o", tmp_path / "out"],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "COLUMNS": "1000", "NO_COLOR": "1"},
    )
    assert done.returncode == 2
    said = "".join(done.stderr.replace("│", " ").split())
    assert "".join(error.message.split()) in said and "".join(error.help.split()) in said
    assert error.line is not None and f"scene.toml:{error.line}:{error.column}" in said


def test_an_interrupt_ends_the_drape_of_a_sheet_at_once() -> None:
    """A sheet of 3 600 nodes takes long; Ctrl-C after half a second is heard within 0.2 s."""
    fine = plydrape.Scene.parse(COARSE.replace('"25 mm"', '"3 mm"'))
    sent: list[float] = []

    def interrupt() -> None:
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.5, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        plydrape.simulate(fine, model="sheet")
    assert time.perf_counter() - sent[0] < 0.2


def test_pads_let_go_at_the_time_of_their_events() -> None:
    """All after the motion and a dwell: one state more than steps, held by nothing."""
    scene = plydrape.Scene.parse(
        COARSE.replace('kind = "catenaries"', 'kind = "sheet"') + '\n[release]\ndwell = "2 s"\n'
    )
    result = plydrape.simulate(scene)
    kinds = [(event["time"], event["kind"], len(event["grippers"])) for event in result.events]
    assert kinds == [(0.0, "grip", 8), (29.0, "press", 8), (31.0, "release", 8)]
    sheet = sheet_of(result)
    assert sheet.steps[-2:].tolist() == [30, 30] and sheet.times[-2:].tolist() == [29.0, 31.0]
    assert sheet.pad_holds[:-1].all() and not sheet.pad_holds[-1].any()
    assert not sheet.pad_forces[-1].any()
    with pytest.raises(plydrape.SceneError, match=r"leave out \[release\]"):
        plydrape.simulate(scene, model="catenaries")


def test_pads_hold_to_the_end_without_a_release(result: plydrape.Result) -> None:
    """No events, and every state is held."""
    assert result.events == [] and sheet_of(result).pad_holds.all()
