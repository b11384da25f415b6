"""The inputs of scenarios: grids and samples, against what defines them."""

from __future__ import annotations

from collections import Counter
from itertools import product
from statistics import NormalDist

import numpy as np
import pytest
from plydrape.study.sample import cube
from plydrape.study.vary import Input
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
                x = Input("k", "uniform", (lower, lower + width), "", points, whole=True)
                even = (
                    np.linspace(lower, lower + width, points) if points > 1 else [lower + width / 2]
                )
                assert x.count == len(x.grid()), (lower, width, points)
                assert set(x.grid()) == {round(float(number)) for number in even}
    assert Input("a", "uniform", (0.0, 1.0), points=7).count == 7
    assert Input("a", "values", (1, 2, 3)).count == 3


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
    """Against the inverse distribution functions of Python's standard library, or by hand."""
    u = [1e-6, 0.02, 0.31, 0.5, 0.975, 1 - 1e-9]
    normal = NormalDist(75.0, 2.0)
    assert Input("x", "normal", (75.0, 2.0)).at(u) == pytest.approx([*map(normal.inv_cdf, u)])
    assert Input("x", "uniform", (60.0, 90.0)).at(u) == pytest.approx([60 + 30 * x for x in u])
    whole = Input("x", "uniform", (3, 9), whole=True).at(u)
    assert whole == [3 + int(7 * x) for x in u] and {type(x) for x in whole} == {int}
    for ends in ((0.0, 1.0), (5.0, 1.0)):
        assert np.isfinite(Input("x", "normal", ends).at([0.0, 1.0])).all()


def test_whole_numbers_and_choices_come_up_equally_often() -> None:
    """In a sample of 600 each of six a hundred times."""
    u = (np.arange(600) + 0.5) / 600
    names = Input("x", "values", ("a", "b", "c", "d", "e", "f"))
    whole = Input("x", "uniform", (5, 10), whole=True)
    for x in (whole, names):
        assert set(Counter(x.at(u)).values()) == {100}
    assert study(50, vary={"motion.steps": {"from": 20, "to": 40}}).inputs[0].whole
    assert whole.numeric and not names.numeric
