"""The inputs of scenarios: grids, samples and placement errors, against what defines them."""

from __future__ import annotations

from collections import Counter
from itertools import product

import numpy as np
import pytest
from plydrape.study.law import Choice, Input, Normal, Uniform, Whole
from plydrape.study.placement import Placement
from plydrape.study.sample import cube
from scipy import stats
from studies import grid, study


def test_a_grid_is_the_product_of_its_numbers() -> None:
    """Every combination once; the last key runs fastest."""
    made = grid(
        grippers__height={"from": "60 mm", "to": "90 mm", "points": 3},
        motion__steps={"values": [10, 20]},
        model__slopes={"values": ["min-force", "moment-balance"]},
    )
    wanted = product([60.0, 75.0, 90.0], [10, 20], ["min-force", "moment-balance"])
    assert made.values == list(wanted) and len(made) == 12


def test_the_size_of_a_grid_is_known_before_it_is_made() -> None:
    """Against the numbers themselves, for ranges that have fewer and more whole numbers."""
    for lower in (-3, 0, 5):
        for width in range(12):
            for points in range(1, 30):
                x = Input("motion.steps", Whole(lower, lower + width), points=points)
                even = (
                    np.linspace(lower, lower + width, points) if points > 1 else [lower + width / 2]
                )
                assert x.count == len(x.grid()), (lower, width, points)
                assert set(x.grid()) == {round(float(number)) for number in even}
    assert Input("a", Uniform(0.0, 1.0), points=7).count == 7
    assert Input("a", Choice((1, 2, 3))).count == 3


def test_a_latin_hypercube_has_one_scenario_in_each_stratum() -> None:
    """N samples, N strata of equal probability, for each input on its own."""
    made = study(40)
    for column, (low, high) in enumerate([(7.2e-6, 10.8e-6), (60.0, 90.0)]):
        numbers = np.array([float(row[column]) for row in made.values])
        strata = np.floor((numbers - low) / (high - low) * 40).astype(int)
        assert sorted(strata) == list(range(40))


def test_a_sobol_sample_of_256_is_balanced_in_every_cell() -> None:
    """A (0, 8, 2)-net: one of 256 points in each box of 2^-a by 2^-(8-a)."""
    points = cube("sobol", 2, 256, seed=3)
    for a in range(9):
        across, up = 2**a, 2 ** (8 - a)
        boxes = Counter((int(x * across), int(y * up)) for x, y in points)
        assert len(boxes) == 256 and set(boxes.values()) == {1}


@pytest.mark.parametrize("sampling", ["latin-hypercube", "sobol"])
def test_a_seed_is_a_sample(sampling: str) -> None:
    """The same seed gives the same numbers to the last bit, another gives others."""
    made = [study(32, sampling=sampling, seed=seed).values for seed in (5, 5, 6)]
    assert made[0] == made[1] != made[2]


def test_laws_have_the_quantiles_of_their_distributions() -> None:
    """Against SciPy's inverse distribution functions."""
    for u in (1e-6, 0.02, 0.31, 0.5, 0.975, 1 - 1e-9):
        assert Normal(75.0, 2.0).at(u) == pytest.approx(stats.norm(75.0, 2.0).ppf(u), rel=1e-12)
        assert Uniform(60.0, 90.0).at(u) == pytest.approx(stats.uniform(60.0, 30.0).ppf(u))
        assert Whole(3, 9).at(u) == stats.randint(3, 10).ppf(u)
    assert np.isfinite([Normal(0.0, 1.0).at(u) for u in (0.0, 1.0)]).all()


def test_whole_numbers_and_choices_come_up_equally_often() -> None:
    """In a sample of 600 each of six a hundred times."""
    u = (np.arange(600) + 0.5) / 600
    for law in (Whole(5, 10), Choice(("a", "b", "c", "d", "e", "f"))):
        assert set(Counter(law.at(x) for x in u).values()) == {100}
    assert study(50, vary={"motion.steps": {"from": 20, "to": 40}}).inputs[0].whole
    assert Input("x", Whole(1, 10)).numeric and not Input("x", Choice(("a",))).numeric


def test_placement_errors_are_those_of_their_law() -> None:
    """Kolmogorov and Smirnov find no difference; each scenario and each gripper has its own."""
    normal = Placement("normal", (0.5,), "mm")
    drawn = np.array([normal.errors(7, k, 8) for k in range(200)])
    assert stats.kstest(drawn.ravel(), stats.norm(0, 0.5e-3).cdf).pvalue > 0.01
    assert len(np.unique(drawn)) == drawn.size
    even = Placement("uniform", (-1.0, 1.0), "mm", "xy")
    drawn = np.array([even.errors(7, k, 8) for k in range(200)])
    assert stats.kstest(drawn[..., :2].ravel(), stats.uniform(-1e-3, 2e-3).cdf).pvalue > 0.01
    assert not drawn[..., 2].any()


def test_placement_errors_do_not_depend_on_the_number_of_scenarios() -> None:
    """Scenario 3 has its errors in every study of the same seed."""
    law = Placement("normal", (1.0,), "mm")
    assert (law.errors(1, 3, 8) == law.errors(1, 3, 8)).all()
    assert (law.errors(1, 3, 8) != law.errors(2, 3, 8)).all()
