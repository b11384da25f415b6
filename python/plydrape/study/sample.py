"""Which scenarios a study has: a grid, a Latin hypercube or a Sobol sequence.

The table of inputs is a pure function of the definition and its seed. Workers get rows of it and
draw nothing themselves, but for placement errors (`placement.py`), which have a generator of
their own for each scenario.

Source: scipy.stats.qmc.
"""

from __future__ import annotations

import itertools
import warnings
from typing import TYPE_CHECKING

import numpy as np

from .keys import Value

if TYPE_CHECKING:
    from .definition import Study

Row = tuple[Value, ...]


def values(study: Study) -> list[Row]:
    """The inputs of every scenario, in the order of the study's `inputs`.

    Shape: one tuple a scenario, one value an input, in the input's unit.
    """
    if study.sampling == "grid":
        return list(itertools.product(*(x.grid() for x in study.inputs)))
    unit = cube(study.sampling, len(study.inputs), study.samples, study.seed)
    return [
        tuple(x.law.at(float(u)) for x, u in zip(study.inputs, row, strict=True)) for row in unit
    ]


def cube(sampling: str, dimensions: int, samples: int, seed: int) -> np.ndarray:
    """Points in the unit cube, shape (samples, dimensions).

    Examples
    --------
    >>> sorted(int(u * 4) for (u,) in cube("latin-hypercube", 1, 4, seed=1))
    [0, 1, 2, 3]

    """
    from scipy.stats import qmc

    if dimensions == 0:
        return np.empty((samples, 0))
    generator = np.random.default_rng(seed)
    if sampling == "sobol":
        with warnings.catch_warnings():
            # It balances powers of two; the guide says so, and other numbers are allowed.
            warnings.simplefilter("ignore", UserWarning)
            return np.asarray(qmc.Sobol(dimensions, scramble=True, rng=generator).random(samples))
    return np.asarray(qmc.LatinHypercube(dimensions, rng=generator).random(samples))
