"""The example that fits a rigidity: it comes back, and is worth what it says."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "examples" / "fitting"))

import fit_rigidity as example


@pytest.mark.parametrize("rigidity", [2e-6, 9e-6, 1.5e-5])
def test_a_rigidity_comes_back_from_an_exact_shape(rigidity: float) -> None:
    """Without noise, from guesses to both sides; far stiffer strips arch upwards."""
    for guess in (rigidity / 20, rigidity * 3):
        found = example.fit(example.heights(rigidity), guess)
        assert found.rigidity == pytest.approx(rigidity, rel=1e-6)


def test_slopes_are_those_of_the_heights() -> None:
    """Exact derivative against a central difference."""
    h = 1e-10
    difference = (example.heights(9e-6 + h) - example.heights(9e-6 - h)) / (2 * h)
    assert np.allclose(example.slopes(9e-6), difference, rtol=1e-5, atol=1e-5)


def test_the_error_is_as_large_as_it_says() -> None:
    """Over many measurements, errors over the stated deviation have mean 0 and deviation 1."""
    fits = [example.fit(example.measure(9e-6, 5e-5, seed)) for seed in range(40)]
    errors = np.array([(found.rigidity - 9e-6) / found.deviation for found in fits])
    # of 40 standard normal numbers: 3.5 deviations of their mean and of their scatter
    assert abs(errors.mean()) < 3.5 / np.sqrt(40)
    assert abs(errors.std() - 1) < 3.5 / np.sqrt(80)
    assert max(abs(found.rigidity / 9e-6 - 1) for found in fits) < 0.15
