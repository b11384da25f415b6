"""The time-optimal law of a plan beside TOPP-RA, a solver for robots that knows nothing of ours.

TOPP-RA (Pham and Pham 2018) has no bound of jerk. So where jerk and tilt rate are out of reach, a
plan takes the time that TOPP-RA finds along its path, and otherwise it takes longer.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import plydrape
import pytest
from numpy.typing import NDArray
from scipy.interpolate import BSpline

toppra = pytest.importorskip("toppra", reason="TOPP-RA, the peer of the time law, is not installed")

Real = NDArray[np.float64]

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SPEED, ACCELERATION = 0.25, 1.0
"""Limits of every gripper (m/s, m/s²)."""
DIRECTIONS = 64
"""Sides of the polygon that stands for the circle of accelerations: it is within 0.12 % of it."""
STATIONS = 800


def planned(limits: str, folder: Path) -> dict[str, Any]:
    """The record of a small plan of the paper's example under limits of its own."""
    path = EXAMPLES / "01_flat_sheared_mold"
    text = (path / "scene.toml").read_text() + limits
    text = text.replace("[model]", '[model]\nkind = "catenaries"')
    scene = plydrape.Scene.parse(text, base=path)
    plydrape.plan(scene, method="stepwise", without_errors=True).write(folder)
    record: dict[str, Any] = json.loads((folder / "result.json").read_text())["plan"]
    return record


def spline(record: dict[str, Any]) -> tuple[BSpline, float]:
    """The path of all grippers, side by side, by the definition in the documentation."""
    steps = np.array(record["path"])
    spacing = np.array(record["spacing"])
    assert len(spacing) == len(steps) - 1, "steps were merged: choose another example"
    begin = steps[0] + (steps[1] - steps[0]) * spacing[0] / (2 * spacing[0] + spacing[1])
    end = steps[-1] + (steps[-2] - steps[-1]) * spacing[-1] / (2 * spacing[-1] + spacing[-2])
    points = np.concatenate([steps[:1], [begin], steps[1:-1], [end], steps[-1:]])
    knots = np.concatenate([[0.0], np.cumsum(spacing)])
    knots = np.concatenate([[0.0] * 3, knots, [knots[-1]] * 3])
    return BSpline(knots, points.reshape(len(points), -1), 3), float(knots[-1])


def least_time(record: dict[str, Any]) -> float:
    """The least time of TOPP-RA along the path, under the limits of speed and acceleration (s)."""
    curve, length = spline(record)

    class Path(toppra.interpolator.AbstractGeometricPath):  # type: ignore[misc,name-defined]
        dof = curve.c.shape[1]
        path_interval = np.array([0.0, length])

        def __call__(self, at: Any, order: int = 0) -> Any:
            return curve(at, order)

    class Speed(toppra.constraint.LinearConstraint):  # type: ignore[misc,name-defined]
        def compute_constraint_params(self, path: Any, at: Real, *_: Any) -> Any:
            slope = path(at, 1).reshape(len(at), -1, 3)
            fastest = np.linalg.norm(slope, axis=2).max(axis=1)
            most = (SPEED / fastest) ** 2
            return None, None, None, None, None, None, np.column_stack([0 * most, most])

    class Acceleration(toppra.constraint.LinearConstraint):  # type: ignore[misc,name-defined]
        def compute_constraint_params(self, path: Any, at: Real, *_: Any) -> Any:
            first, second = (path(at, n).reshape(len(at), -1, 3) for n in (1, 2))
            # both lie in one plane: the directions of a polygon in it
            along = first / np.linalg.norm(first, axis=2, keepdims=True)
            across = second - np.sum(second * along, axis=2, keepdims=True) * along
            across /= np.maximum(np.linalg.norm(across, axis=2, keepdims=True), 1e-300)
            angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
            ways = np.cos(angles)[:, None] * along[:, :, None]
            ways = ways + np.sin(angles)[:, None] * across[:, :, None]
            a = np.einsum("ngdc,ngc->ngd", ways, first).reshape(len(at), -1)
            b = np.einsum("ngdc,ngc->ngd", ways, second).reshape(len(at), -1)
            sides = a.shape[1]
            return a, b, 0 * a, np.eye(sides), np.full(sides, ACCELERATION), None, None

        def __init__(self) -> None:
            super().__init__()
            self.identical = True

    stations = np.linspace(0.0, length, STATIONS + 1)
    solver = toppra.algorithm.TOPPRA(
        [Speed(), Acceleration()], Path(), gridpoints=stations, solver_wrapper="seidel"
    )
    _, speeds, _ = solver.compute_parameterization(0.0, 0.0)
    assert speeds is not None
    return float(np.sum(2 * np.diff(stations) / (speeds[1:] + speeds[:-1])))


LIMITS = f"""
[limits]
speed = {SPEED}
acceleration = {ACCELERATION}
"""


def test_without_jerk_a_plan_takes_the_time_of_toppra(tmp_path: Path) -> None:
    """One percent is room for the polygon, the stations and a millisecond for acceleration."""
    record = planned(LIMITS + 'jerk = 1e3\ntilt_rate = "5e5 deg/s"\n', tmp_path / "plan")
    ratio = record["law"][-1][0] / least_time(record)
    assert 0.995 < ratio < 1.01, ratio


def test_jerk_and_tilt_rate_take_more_time_than_toppra(tmp_path: Path) -> None:
    """What is forbidden besides can only take longer, and the plan says that it does."""
    record = planned(LIMITS + 'jerk = 10.0\ntilt_rate = "90 deg/s"\n', tmp_path / "plan")
    assert record["law"][-1][0] > 1.02 * least_time(record)
    assert {limit["name"] for limit in record["limited_by"]} & {"jerk", "tilt_rate"}
