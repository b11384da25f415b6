"""A measured pick-up from Python: a plan is corrected by an offset or by points."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from plydrape import Plan, PlanError, Scene, SceneError, plan, simulate

SCENE = Path(__file__).resolve().parents[2] / "examples" / "01_flat_sheared_mold" / "scene.toml"
OFFSET: dict[str, float | str | Sequence[float | str]] = {
    "x": "3 mm",
    "y": -0.0015,
    "yaw": "0.8 deg",
}


@pytest.fixture(scope="module")
def planned() -> Plan:
    """The paper's example."""
    return plan(Scene.read(SCENE), without_errors=True)


def test_the_grippers_start_where_the_ply_lies_and_land_as_planned(planned: Plan) -> None:
    """Turned about the middle of the grippers and shifted; the end is the planned one."""
    moved = planned.result.replan(offset=OFFSET)
    start = planned.result.positions[0]
    middle = start.reshape(-1, 3).mean(axis=0)
    cosine, sine = np.cos(np.radians(0.8)), np.sin(np.radians(0.8))
    turn = np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    due = (start - middle) @ turn.T + middle + [0.003, -0.0015, 0]
    # of places of 1 m, as rounded as doubles are
    assert np.abs(moved.positions[0] - due).max() < 1e-12
    assert (moved.positions[-1] == planned.result.positions[-1]).all()
    assert moved.accepted


def test_points_give_the_offset_that_moved_them(planned: Plan) -> None:
    """Three of the grippers, where the ply was planned and where it lies."""
    start = planned.result.positions[0].reshape(-1, 3)
    moved = planned.result.replan(offset=OFFSET)
    seen = moved.positions[0].reshape(-1, 3)
    pairs = [(start[n, :2].tolist(), seen[n, :2].tolist()) for n in (0, 3, 7)]
    again = planned.result.replan(points=pairs)
    assert np.abs(again.positions - moved.positions).max() < 1e-12


def test_what_cannot_be_replanned_is_refused_with_a_remedy(planned: Plan) -> None:
    """One point, a length without a unit, a drape that was not planned."""
    with pytest.raises(SceneError, match="takes two points or more, and their number is 1"):
        planned.result.replan(points=[((0.0, 0.0), (0.001, 0.0))])
    with pytest.raises(SceneError, match="has no unit"):
        planned.result.replan(offset={"x": "3"})
    with pytest.raises(PlanError, match="plan"):
        simulate(Scene.read(SCENE), model="catenaries").replan(offset=OFFSET)
