"""Figures of the summary against SciPy and planted truths."""

from __future__ import annotations

import json
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest
from plydrape.study import Outcome, Study
from plydrape.study.run import run
from plydrape.study.scenario import measures
from plydrape.study.summary import correlation, spread, troubles, wilson
from scipy import stats
from studies import study, table


def planted(count: int, seed: int) -> Outcome:
    """Rows whose measure rises with `b` alone, steeply and not straight, under noise."""
    random = np.random.default_rng(seed)
    a, b, c = random.uniform(size=(3, count))
    measure = np.exp(5.0 * b) + random.normal(0.0, 5.0, count)
    columns: dict[str, object] = {"scenario": range(count), "a": a, "b": b, "c": c}
    columns |= {"accepted": measure < 20.0, "value_slack": measure, "limit_slack": [20.0] * count}
    columns |= {"ok_slack": measure < 20.0, "value_noise": random.normal(size=count)}
    columns |= {"limit_noise": [9.0] * count, "ok_noise": [True] * count}
    texts = {"version": "0", "error": None, "error_kind": None}
    columns |= {"seed": [seed] * count}
    columns |= {name: pa.array([text] * count, pa.string()) for name, text in texts.items()}
    rows = pa.table({name: pa.array(list(x)) for name, x in columns.items()})  # type: ignore[call-overload]
    return Outcome(rows, "planted", None)


@pytest.mark.parametrize("seed", range(5))
def test_a_planted_driver_is_found(seed: int) -> None:
    """And nothing is made of noise beyond what chance gives."""
    outcome = planted(200, seed)
    measures = outcome.summary["measures"]
    assert measures["value_slack"]["driver"] == measures["accepted"]["driver"] == "b"
    assert outcome.correlations["value_slack"]["b"] > 0.85  # type: ignore[operator]
    assert outcome.correlations["accepted"]["b"] < -0.7  # type: ignore[operator]
    assert abs(outcome.correlations["value_slack"]["a"]) < 0.2  # type: ignore[arg-type]
    expected = stats.spearmanr(outcome.table()["b"], outcome.table()["value_slack"]).statistic
    assert outcome.correlations["value_slack"]["b"] == pytest.approx(expected, abs=1e-11)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_value_that_is_not_finite_is_not_accepted(value: float) -> None:
    """Whatever the row says: neither in the share, nor at its limit, nor in what drives it."""
    random = np.random.default_rng(3)
    count, harmed = 40, 10
    measure = random.uniform(0.0, 1.0, count)
    measure[:harmed] = value
    texts = {name: pa.array([None] * count, pa.string()) for name in ("error", "error_kind")}
    columns: dict[str, Any] = {"scenario": range(count), "a": np.arange(count) >= harmed}
    columns |= {"accepted": [True] * count, "value_slack": measure, "ok_slack": [True] * count}
    columns |= {"limit_slack": [2.0] * count, "seed": [1] * count, "version": ["0"] * count}
    outcome = Outcome(pa.table(columns | texts), "planted", None)
    about = outcome.summary
    assert about["accepted"]["count"] == count - harmed
    assert about["accepted"]["interval"] == wilson(count - harmed, count)
    assert about["measures"]["value_slack"]["exceeded"] == harmed / count
    assert about["measures"]["value_slack"]["count"] == count - harmed
    assert about["measures"]["accepted"]["correlations"]["a"] == pytest.approx(1.0)
    json.dumps(about, allow_nan=False)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_row_with_a_value_that_is_not_finite_is_not_accepted(value: float) -> None:
    """Even where the drape says that it keeps the limit."""
    limit = {"name": "tilt", "limit": 40.0, "unit": "°", "ok": True}
    for given, expected in ((30.0, True), (value, False)):
        result = SimpleNamespace(
            accepted=True,
            converged=True,
            first_contact_step=None,
            summary={
                "stopped": None,
                "worst": {},
                "final": {},
                "limits": [limit | {"value": given}],
            },
        )
        row = measures(result)  # type: ignore[arg-type]
        assert row["ok_tilt"] is expected and row["accepted"] is expected


def test_the_largest_numbers_have_a_mean() -> None:
    """Their sum overflows, and summary.json holds finite numbers alone."""
    assert spread(np.array([1.0e308, 1.7e308, 0.0]))["mean"] == pytest.approx(0.9e308)
    small = np.random.default_rng(1).normal(size=100)
    assert spread(small)["mean"] == pytest.approx(small.mean(), rel=1e-12)


def test_noise_has_a_driver_about_as_often_as_chance_has_it() -> None:
    """Three inputs at 5 % each: in 60 studies of noise about 9; 25 would be no chance."""
    named = sum(
        planted(60, seed).summary["measures"]["value_noise"]["driver"] is not None
        for seed in range(60)
    )
    assert named < 25


def test_the_interval_is_wilsons() -> None:
    """Against SciPy's, without continuity correction."""
    for hits, of in ((0, 10), (3, 10), (10, 10), (512, 10000), (1, 1)):
        expected = stats.binomtest(hits, of).proportion_ci(method="wilson")
        assert wilson(hits, of) == pytest.approx((expected.low, expected.high), abs=1e-12)
    assert wilson(0, 0) is None


def test_constant_columns_have_no_correlation() -> None:
    """Nor have two numbers, nor a column that differs by rounding alone."""
    x = np.arange(10.0)
    assert correlation(x, np.full(10, 3.0)) is None
    assert correlation(x, 3.0 + 1e-15 * x) is None
    assert correlation(x[:2], x[:2]) is None
    assert correlation(x, np.where(x < 4, np.nan, -x)) == -1.0


def test_height_drives_the_landing_of_straight_paths() -> None:
    """From higher up the paper's diagonals touch later, nearer to their place; the rigidity of a
    ply this limp changes nothing that one could see.
    """
    varied = {
        "grippers.height": {"from": "60 mm", "to": "90 mm"},
        "ply.material.flexural_rigidity": {"relative": [0.8, 1.2]},
    }
    outcome = run(study(60, vary=varied), workers=2)
    landing = outcome.summary["measures"]["value_position"]
    assert landing["driver"] == "grippers.height"
    assert landing["correlations"]["grippers.height"] < -0.7


def test_equal_troubles_count_as_one() -> None:
    """Whatever their numbers."""
    made = Study.of(table(30, vary={"grippers.spacing.0": {"from": "95 mm", "to": "130 mm"}}))
    outcome = run(made, workers=1)
    (trouble,) = outcome.summary["errors"]
    assert trouble["kind"] == "SceneError" and trouble["count"] == outcome.summary["failed"] > 15
    texts = ["H = -1.5e-3 N in step 12", "g0_0 is off", "H = 7 N in step 3", "g12_1 is off"]
    failed = pd.DataFrame({"error_kind": "SolverError", "error": [*texts, "H = 1 N in step 1"]})
    found = [(trouble["text"], trouble["count"]) for trouble in troubles(failed)]
    assert found == [("H = · N in step ·", 3), ("· is off", 2)]
    # Accepted is a share of those that were draped.
    assert outcome.summary["draped"] == 30 - trouble["count"]
