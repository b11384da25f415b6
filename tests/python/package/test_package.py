"""The package says the same as the command line, and lets Python live beside it."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any, cast

import numpy as np
import plydrape
import pytest
from program import binary

ROOT = Path(__file__).resolve().parents[3]
EXAMPLE = ROOT / "examples" / "01_flat_sheared_mold" / "scene.toml"
SLOW = ROOT / "examples" / "07_cubic" / "scene.toml"


def test_a_drape_is_the_command_lines(tmp_path: Path) -> None:
    """Same scene, same bytes of result.json and of every other file."""
    command = [str(binary()), "simulate", str(EXAMPLE), "-o", str(tmp_path / "cli"), "--quiet"]
    subprocess.run(command, check=False)
    result = plydrape.simulate(plydrape.Scene.read(EXAMPLE))
    written = result.write(tmp_path / "python")
    assert len(written) >= 5
    for file in written:
        assert file.read_bytes() == (tmp_path / "cli" / file.name).read_bytes(), file.name


def test_a_plan_is_the_command_lines(tmp_path: Path) -> None:
    """Same scene and seed, same plan."""
    folder = str(tmp_path / "cli")
    cli = [
        str(binary()),
        "plan",
        str(EXAMPLE),
        "-o",
        folder,
        "--quiet",
        "--seed",
        "3",
        "--without-errors",
    ]
    subprocess.run(cli, check=True)
    plan = plydrape.plan(plydrape.Scene.read(EXAMPLE), seed=3, without_errors=True)
    assert plan.accepted
    for file in plan.write(tmp_path / "python"):
        assert file.read_bytes() == (tmp_path / "cli" / file.name).read_bytes(), file.name


@pytest.mark.long
def test_a_plan_is_improved_until_its_time_is_over() -> None:
    """A search that shall improve its plan takes more drapes; without time it is whole too."""
    text = EXAMPLE.read_text(encoding="utf-8")
    assert "[plan]" not in text
    scene = plydrape.Scene.parse(text + "\n[plan]\nevaluations = 20\n", base=EXAMPLE.parent)
    first = plydrape.plan(scene, without_errors=True)
    improved = plydrape.plan(scene, improve=True, without_errors=True)
    assert first.accepted and improved.accepted
    assert improved.evaluations - improved.decisions > first.evaluations - first.decisions > 0
    assert not improved.time_over
    short = plydrape.plan(scene, improve=True, time="1 ms", without_errors=True)
    assert short.time_over and short.evaluations < first.evaluations
    assert plydrape.plan(scene, time=0.001, without_errors=True).time_over


def test_a_time_that_is_none_is_refused() -> None:
    """It has to be longer than nothing, and one with a unit a time."""
    scene = plydrape.Scene.read(EXAMPLE)
    for refused in (0, -1.0, float("nan"), "5 mm", "soon", "0 s"):
        with pytest.raises(ValueError, match="time"):
            plydrape.plan(scene, time=refused)


def test_a_search_goes_on_from_its_memory() -> None:
    """The second search begins where the first one ended: it is no worse."""
    scene = plydrape.Scene.read(EXAMPLE)
    first = plydrape.plan(scene, without_errors=True)
    second = plydrape.plan(scene, checkpoint=first.checkpoint, without_errors=True)
    assert second.accepted
    with pytest.raises(ValueError, match=r"plan\.json"):
        plydrape.plan(scene, checkpoint="{}")


def test_arrays_are_the_result_files_numbers(tmp_path: Path) -> None:
    """Positions, forces, measures and lines, against the JSON text."""
    result = plydrape.simulate(plydrape.Scene.read(EXAMPLE), also="catenaries")
    whole = json.loads(result.to_json())
    checksum = result.to_dict().pop("checksum")
    assert result.to_dict() == {**whole, "checksum": checksum}
    assert result.summary == whole["summary"]
    assert result.limits == plydrape.Limits.of(whole["summary"]["limits"])
    assert result.accepted == whole["summary"]["accepted"]
    steps = whole["steps"]
    positions = [step["grippers"]["position"] for step in steps]
    assert np.array_equal(result.positions, positions)
    tilts = [step["grippers"]["tilt_deg"] for step in steps]
    assert np.array_equal(result.tilts_deg, tilts)
    loads = [step["grippers"]["force_N"] for step in steps]
    assert np.array_equal(result.loads, loads)
    known = {name for step in steps for name in step["measures"]}
    assert {*result.measures} == known
    for name, values in result.measures.items():
        for step, value in zip(steps, values, strict=True):
            found = step["measures"].get(name)
            assert value == found["value"] if found is not None else np.isnan(value), name
    assert result.also is not None and result.also.summary == whole["also"]["summary"]
    for number in (1, 26, -1):
        step = whole["also"]["steps"][number - 1 if number > 0 else number]
        names = zip(whole["catenaries"]["from"], whole["catenaries"]["to"], strict=True)
        for line, ends_at in zip(result.lines(number), names, strict=True):
            ends = [step["grippers"]["position"][i + 4 * j] for i, j in ends_at]
            assert np.allclose(line[[0, -1]], ends, rtol=0, atol=1e-12)
    written = result.write(tmp_path)
    again = plydrape.Result.read(next(file for file in written if file.name == "result.json"))
    assert again.to_json() == result.to_json()


def test_measures_are_what_results_hold() -> None:
    """Their keys are those of the steps, and the worst of their values are those of the limits."""
    measures = plydrape.measures()
    by_name = {measure.name: measure for measure in measures}
    assert len(by_name) == len({measure.key for measure in measures}) == len(measures)
    shared = {"tilt", "tilt_rate", "gripper_distance", "position", "penetration", "strain"}
    own = {"sheet": {"height", "out_of_plane"}, "catenaries": {"contact_share", "slack_ratio"}}
    for model, others in (("sheet", "catenaries"), ("catenaries", "sheet")):
        result = plydrape.simulate(plydrape.Scene.read(EXAMPLE), model=cast(Any, model))
        assert shared | own[model] <= {*result.limits}
        assert not own[others] & {*result.limits}
        of_its_model(result, by_name)


def of_its_model(result: plydrape.Result, by_name: dict[str, plydrape.Measure]) -> None:
    """What one model measures is in the order of tables, and its limits are the worst of that."""
    stepwise = [measure.key for measure in by_name.values() if measure.scope != "whole"]
    assert list(result.measures) == [key for key in stepwise if key in result.measures]
    measured = {key for key, value in result.summary["worst"].items() if value is not None}
    assert measured == {*result.measures}
    for name, limit in result.limits.items():
        measure = by_name[name]
        if measure.key not in stepwise:
            continue
        values = result.measures[measure.key]
        least = measure.sense == "at-least"
        worst = np.nanmin(values) if least else np.nanmax(values)
        value = values[-1] if measure.scope == "end" else worst
        assert limit.value == pytest.approx(value * measure.factor, abs=1e-12), measure
        assert limit.unit == measure.shown
        beyond = limit.limit - limit.value if least else limit.value - limit.limit
        assert limit.kept == (beyond <= 0.0)


def test_keyword_arguments_are_a_scene_file() -> None:
    """NumPy numbers, strings with units and a written file make the same drape."""
    scene = plydrape.Scene(
        title="Flat",
        ply={"grippers": np.array([4, 2]), "cell": np.array([0.1, 0.1]), "material": "krogh2018"},
        mold={"kind": "plane"},
        grippers={"spacing": ("98 mm", "98 mm"), "height": np.float64(0.075)},
        target={"origin": [0, 0], "direction": "20 deg", "shear": np.deg2rad(20.0)},
        model={"kind": "catenaries"},
    )
    assert scene.text is not None
    written = plydrape.Scene.parse(scene.text)
    one, other = plydrape.simulate(scene), plydrape.simulate(written)
    assert one.to_dict()["steps"] == other.to_dict()["steps"]


def test_a_ply_is_picked_up_from_keywords_too() -> None:
    """The pads stand on the table, as far apart as the fabric; another motion has its own lift."""
    scene = plydrape.Scene(
        ply={"grippers": [3, 2], "cell": [0.1, 0.1], "material": "krogh2018"},
        mold={"kind": "plane", "point": [0, 0, "-200 mm"]},
        grippers={"spacing": ["98 mm", "98 mm"], "height": "60 mm"},
        motion={"kind": "hold"},
        sheet={"mesh": "25 mm"},
        pick_up={"height": "10 mm"},
    )
    first, last = scene.positions[0].reshape(-1, 3), scene.positions[-1].reshape(-1, 3)
    assert first[:, 2] == pytest.approx(0.01)
    assert np.linalg.norm(first[1] - first[0]) == pytest.approx(0.1)
    assert last[:, 2] == pytest.approx(0.06)
    gap = plydrape.simulate(scene).limits["table_gap"]
    assert gap.kept
    assert gap.step == len(scene.times)
    moved = scene.with_motion(scene.times, scene.positions)
    assert "table_gap" not in plydrape.simulate(moved).limits
    with pytest.raises(ValueError, match="know no table"):
        plydrape.simulate(scene, also="catenaries")


def test_a_mold_of_triangles_is_the_mold_of_its_file(tmp_path: Path) -> None:
    """A scene on triangles from Python against the same triangles read from a file."""
    folder = ROOT / "examples" / "08_stl_mold"
    text = (folder / "scene.toml").read_text()
    from_file = plydrape.Scene.parse(text, base=folder)
    assert from_file.mold is not None and from_file.target is not None
    low, high = from_file.target.min(axis=0) - 10, from_file.target.max(axis=0) + 10
    points, corners = from_file.mold.patch((low[0], low[1]), (high[0], high[1]), most=1 << 30)
    mold = plydrape.Mold.triangles(points, corners)
    places = np.random.default_rng(1).uniform(low + 10, high - 10, (100, 3))
    ours, theirs = mold.closest_points(places), from_file.mold.closest_points(places)
    assert np.allclose(ours.points, theirs.points, rtol=0, atol=1e-12)
    assert np.allclose(ours.normals, theirs.normals, rtol=0, atol=1e-9)


REFUSED = {
    "key": "[ply]\ngripers = [4, 2]\n",
    "unit": '[ply]\ngrippers = [4, 2]\ncell = ["100 kg", "100 mm"]\nmaterial = "krogh2018"\n',
    "not toml": "[ply\n",
    "empty": "",
}


@pytest.mark.parametrize("fault", REFUSED)
def test_a_refused_scene_speaks_as_the_command_line(fault: str, tmp_path: Path) -> None:
    """Message, remedy, line and column are those of `plydrape check`."""
    file = tmp_path / "scene.toml"
    file.write_text(REFUSED[fault])
    with pytest.raises(plydrape.SceneError) as refused:
        plydrape.Scene.read(file)
    error = refused.value
    done = subprocess.run(
        [binary(), "check", file],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "COLUMNS": "1000", "NO_COLOR": "1"},
    )
    assert done.returncode == 2
    # without the spaces at which lines are broken
    said = "".join(done.stderr.replace("│", " ").split())
    assert "".join(error.message.split()) in said and "".join(error.help.split()) in said
    if error.line is not None:
        assert f"scene.toml:{error.line}:{error.column}" in said
        assert f":{error.line}:{error.column}: " in str(error)
    assert isinstance(error, ValueError) and isinstance(error, plydrape.PlydrapeError)


def test_wrong_arguments_say_what_is_wanted() -> None:
    """Shapes, non-finite numbers, unknown words, steps that are not there."""
    scene = plydrape.Scene.read(EXAMPLE)
    result = plydrape.simulate(scene, model="catenaries")
    solver = plydrape.Solver.of(scene)
    with pytest.raises(ValueError, match=r"shape \(2, 7, 3\); expected \(steps, 8, 3\)"):
        scene.with_motion([0, 1], np.zeros((2, 7, 3)))
    with pytest.raises(ValueError, match="time of step 2"):
        scene.with_motion([0, 0], scene.positions[:2])
    with pytest.raises(ValueError, match="NaN"):
        solver.solve(np.full((8, 3), np.nan))
    with pytest.raises(ValueError, match=r"shape \(7, 3\); expected \(8, 3\)"):
        solver.solve(np.zeros((7, 3)))
    with pytest.raises(IndexError, match="no step 31"):
        result.lines(31)
    with pytest.raises(ValueError, match="stl"):
        result.export("stl", "x")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=r"ply\[\"cell\"\]\[0\] is of type object"):
        plydrape.Scene(ply={"cell": [object()]})
    with pytest.raises(plydrape.ResultError, match=r"result\.json"):
        plydrape.Result.read(EXAMPLE)
    with pytest.raises(plydrape.PlanError, match="no mold"):
        plydrape.plan(plydrape.Scene.read(ROOT / "examples" / "02_hanging_strip" / "scene.toml"))
    with pytest.raises(ValueError, match=r"triangles holds 4; there are 4 points"):
        plydrape.Mold.triangles(np.eye(4)[:, :3], [[0, 1, 4]])


def test_an_output_that_is_in_the_way_stays(tmp_path: Path) -> None:
    """A file of the user's is not overwritten, and nothing else is written."""
    result = plydrape.simulate(plydrape.Scene.read(EXAMPLE))
    (tmp_path / "steps.csv").write_text("mine")
    with pytest.raises(plydrape.OutputError, match=r"steps\.csv was not written by plydrape"):
        result.write(tmp_path)
    assert [file.name for file in tmp_path.iterdir()] == ["steps.csv"]
    page = result.report(tmp_path / "page" / "report.html")
    assert page.read_text().startswith("<!doctype html>")


def test_another_thread_runs_while_a_drape_is_computed() -> None:
    """A long drape leaves the interpreter free: a loop beside it is never kept waiting."""
    scene = plydrape.Scene.read(SLOW)
    drape = threading.Thread(target=lambda: plydrape.simulate(scene))
    gaps = []
    drape.start()
    before = time.perf_counter()
    while drape.is_alive():
        time.sleep(0.001)
        now = time.perf_counter()
        gaps.append(now - before)
        before = now
    drape.join()
    # held, there would be one gap as long as the drape, over a second
    assert len(gaps) > 100 and max(gaps) < 0.5


INTERRUPTED = f"""
import signal, sys, threading, time
import plydrape

scene = plydrape.Scene.read({str(SLOW)!r})
sent = []

def send():
    time.sleep(1.0)
    sent.append(time.perf_counter())
    signal.raise_signal(signal.SIGINT)

threading.Thread(target=send).start()
try:
    for _ in range(30):
        plydrape.%s(scene)
except KeyboardInterrupt:
    print(time.perf_counter() - sent[0])
"""


@pytest.mark.parametrize("work", ["plan", "simulate"])
def test_an_interrupt_is_heard_at_once(work: str) -> None:
    """Ctrl-C comes back as KeyboardInterrupt within 0.2 s, in the middle of seconds of work."""
    command = [sys.executable, "-c", INTERRUPTED % work]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    assert float(done.stdout) < 0.2, done.stdout
    assert signal.SIGINT.value == 2


def test_progress_is_told_and_may_break_off() -> None:
    """What the callback raises ends the work and comes back."""
    scene = plydrape.Scene.read(SLOW)
    told: list[tuple[int, int, str]] = []

    def listen(done: int, most: int, stage: str) -> None:
        told.append((done, most, stage))
        if done > 3:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        plydrape.simulate(scene, progress=listen)
    assert told[-1][1:] == (30, "draping") and told == sorted(told)


def test_objects_cross_processes_by_their_text() -> None:
    """A scene and a result say all that another process needs."""
    scene = plydrape.Scene.read(EXAMPLE)
    assert scene.text is not None
    again = plydrape.Scene.parse(scene.text, base=EXAMPLE.parent)
    assert np.array_equal(again.positions, scene.positions)
    result = plydrape.simulate(scene)
    assert plydrape.Result.parse(result.to_json()).to_json() == result.to_json()
