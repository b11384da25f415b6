"""Rows of a study against drapes made by hand."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import plydrape
import plydrape.study
import pyarrow.parquet as pq
import pytest
from plydrape.study import Study
from plydrape.study.run import run
from studies import PAPER, grid, judged, rows, study, table


def test_a_relative_rigidity_is_the_scene_with_that_number() -> None:
    """The material's 9e-6 N m² times 0.8, 1 and 1.2, written into a scene by hand."""
    made = grid(ply__material__flexural_rigidity={"relative": [0.8, 1.2], "points": 3})
    outcome = run(made, workers=1)
    for row, wanted in zip(rows(outcome.table()), (0.8 * 9e-6, 9e-6, 1.2 * 9e-6), strict=True):
        assert row["ply.material.flexural_rigidity"] == pytest.approx(wanted, rel=1e-14)
        rigidity = f"{row['ply.material.flexural_rigidity']!r} N m^2"
        material = f'{{ mass = "0.3143 kg/m", flexural_rigidity = "{rigidity}" }}'
        text = PAPER.read_text().replace('"krogh2018"', material)
        by_hand = judged(plydrape.simulate(plydrape.Scene.parse(text)))
        assert {key: row[key] for key in by_hand} == by_hand
        assert row["error"] is None and row["version"] == plydrape.__version__


def test_errors_of_the_scene_move_each_gripper_all_along() -> None:
    """The cell of row 3 is draw 3 of the scene: each gripper off by one vector of the given law."""
    made = study(5)
    row = rows(run(made, workers=1).table())[3]
    text = PAPER.read_text().replace('"75 mm"', f'"{row["grippers.height"]!r} mm"')
    exact = plydrape.Scene.parse(text + '[errors]\ngripper = { position = { bound = "1 mm" } }\n')
    off = made.scene(3).positions - exact.positions
    assert np.ptp(off, axis=0).max() < 1e-15 and 0 < np.abs(off).max() <= 1e-3
    drawn = np.array([gripper["position"] for gripper in exact.draw(3)["grippers"]])
    assert off[0] == pytest.approx(drawn, abs=1e-15)
    distances = np.linalg.norm(off[0], axis=1)
    rms = np.sqrt((distances**2).mean())
    assert row["errors.gripper.position.rms"] == pytest.approx(rms, rel=1e-9)
    # A straight motion ends at the ideal place: what is off there is the error.
    assert row["value_landing_gripper"] == pytest.approx(1e3 * distances.max(), rel=1e-9)


def test_a_followed_plan_is_the_motion_of_its_result(tmp_path: Path) -> None:
    """Under the conditions it was made for it drapes as it did, under others otherwise."""
    plan = plydrape.plan(plydrape.Scene.read(PAPER), method="stepwise", without_errors=True)
    plan.write(tmp_path)
    made = Study.of(
        {
            "scene": str(PAPER),
            "command": "follow",
            "plan": str(tmp_path / "result.json"),
            "sampling": "grid",
            "vary": {"ply.cell.0": {"values": ["100 mm", "100.5 mm"]}},
        }
    )
    same, other = rows(run(made, workers=1).table())
    worst = {k: value for k, value in plan.result.summary["worst"].items() if value is not None}
    assert {f"worst_{key}" for key in worst} == {key for key in same if key.startswith("worst_")}
    for key, value in worst.items():
        assert same[f"worst_{key}"] == pytest.approx(value, rel=1e-6, abs=1e-9), key
    # Half a millimeter more fabric in each edge along u stays as slack.
    assert same["final_slack_mm"] < 0.1 < other["final_slack_mm"]


def test_each_scenario_may_be_planned() -> None:
    """The row is that of the plan's result."""
    made = Study.of(
        {
            "scene": str(PAPER),
            "command": "plan",
            "sampling": "grid",
            "vary": {
                "plan.method": {"values": ["stepwise"]},
                "plan.steps": {"values": [30]},
                "grippers.height": {"values": ["75 mm"]},
            },
        }
    )
    (row,) = rows(run(made, workers=1).table())
    by_hand = judged(plydrape.plan(made.scene(0), without_errors=True).result)
    assert {key: row[key] for key in by_hand} == by_hand
    assert row["plan.method"] == "stepwise" and row["evaluations"] >= 1


def test_one_failing_scene_is_a_row_and_no_end() -> None:
    """Grippers farther apart than their fabric are refused; the others are draped."""
    made = grid(grippers__spacing__0={"values": ["97 mm", "130 mm", "98 mm"]})
    first, failed, last = rows(run(made, workers=1).table())
    assert first["error"] is None and last["error"] is None and last["worst_slack_mm"] > 0
    assert failed["error_kind"] == "SceneError" and "apart" in failed["error"]
    assert failed["worst_slack_mm"] is None and failed["accepted"] is None
    assert failed["grippers.spacing.0"] == 130.0


def test_a_study_of_failures_alone_has_its_rows_too(tmp_path: Path) -> None:
    """Grippers farther apart than their fabric; only the lower end of the range is a scene."""
    made = study(4, vary={"grippers.spacing.0": {"from": "99.9 mm", "to": "400 mm"}})
    outcome = run(made, output=tmp_path / "out", workers=1)
    assert all(row["error"] for row in rows(outcome.table()))
    assert outcome.accepted_share is None and outcome.summary["failed"] == 4
    assert outcome.summary["accepted"]["share"] is None and outcome.summary["errors"]


def test_rows_do_not_depend_on_workers_or_parts(tmp_path: Path) -> None:
    """One worker or two, long parts or short: the same files, byte for byte."""
    contents = []
    for name, workers, every in (("a", 1, 1.0), ("b", 2, 0.02), ("c", 2, 1e-9)):
        run(study(40), output=tmp_path / name, workers=workers, every=every)
        files = ("study.parquet", "summary.json")
        contents.append([(tmp_path / name / file).read_bytes() for file in files])
    assert contents[0] == contents[1] == contents[2]
    # The shortest have one scenario in each part.
    assert len(list((tmp_path / "c" / "rows").iterdir())) == 40


def test_a_row_can_be_made_again_on_its_own() -> None:
    """`study.scene(k)` is the scene of row k."""
    made = study(6)
    outcome = run(made, workers=1)
    for k in (0, 5):
        by_hand = judged(plydrape.simulate(made.scene(k)))
        assert {key: rows(outcome.table())[k][key] for key in by_hand} == by_hand
    with pytest.raises(IndexError):
        made.scene(6)


def test_rows_are_typed_and_have_units(tmp_path: Path) -> None:
    """Any reader of Parquet sees them."""
    run(study(3), output=tmp_path / "out", workers=1)
    schema = pq.read_schema(tmp_path / "out" / "study.parquet")
    types: dict[str, Any] = {field.name: str(field.type) for field in schema}
    assert (types["scenario"], types["accepted"], types["error"]) == ("int64", "bool", "string")
    assert types["worst_slack_mm"] == types["grippers.height"] == "double"
    assert types["stopped"] == "string"
    units = {
        name: schema.field(name).metadata[b"unit"].decode()
        for name in (
            "grippers.height",
            "errors.gripper.position.rms",
            "value_slack_ratio",
            "limit_tilt",
            "worst_tilt_deg",
            "final_gripper_load_n",
        )
    }
    assert list(units.values()) == ["mm", "m", "%", "°", "deg", "N"]
    # An interrupted or finished study is read from its parts.
    again = plydrape.study.read(tmp_path / "out")
    assert again.table().equals(pq.read_table(tmp_path / "out" / "study.parquet"))
    assert again.inputs == study(3).names


def test_margins_are_what_is_left_of_a_limit() -> None:
    """Positive where the limit is kept, whether it is the most or the least allowed."""
    for row in rows(run(table(4), workers=1).table()):
        for key in ("tilt", "slack_ratio", "contact_share", "gripper_distance"):
            value, limit = row[f"value_{key}"], row[f"limit_{key}"]
            sign = -1 if key in ("contact_share", "gripper_distance") else 1
            assert row[f"margin_{key}"] == pytest.approx(sign * (1 - value / limit))
            assert row[f"ok_{key}"] == (row[f"margin_{key}"] >= 0)
        assert row["accepted"] == all(v for k, v in row.items() if k.startswith("ok_"))


def test_a_plan_on_mounts_is_followed_where_the_robot_holds_them(tmp_path: Path) -> None:
    """Not where the pads are: the mounts between them would give way once more."""
    scene = plydrape.Scene(
        ply={"grippers": [2, 2], "cell": ["100 mm", "100 mm"], "material": "krogh2018"},
        grippers={
            "spacing": ["98 mm", "98 mm"],
            "height": "75 mm",
            "stiffness": {"lateral": "0.1 N/mm", "axial": "0.1 N/mm"},
        },
        motion={"kind": "hold"},
        sheet={"mesh": "50 mm"},
    )
    result = plydrape.simulate(scene)
    result.write(str(tmp_path / "held"))
    table = {"scene": scene, "command": "follow", "plan": str(tmp_path / "held"), "samples": 1}
    vary = {"ply.material.mass": {"relative": [1, 1.01]}}
    motion = Study.of(table | {"vary": vary}).motion
    assert motion is not None
    assert abs(result.positions - scene.positions).max() > 1e-5
    np.testing.assert_allclose(motion.positions, scene.positions, atol=1e-12)
