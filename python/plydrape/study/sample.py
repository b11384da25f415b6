"""Which scenarios a study has: a grid, a Latin hypercube or a Sobol sequence.

The table of inputs is a pure function of the definition and its seed. Workers get rows of it and
draw nothing themselves; errors of the scene are drawn by the scene (`errors.py`).

Source: scipy.stats.qmc.
"""

from __future__ import annotations

import itertools
import warnings
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from .definition import Study
    from .workers import Row


def values(study: Study) -> list[Row]:
    """The inputs of every scenario, in the order of the study's `inputs`.

    Shape: one tuple a scenario, one value an input, in the input's unit.
    """
    if study.sampling == "grid":
        return list(itertools.product(*(x.grid() for x in study.inputs)))
    if not study.inputs:
        return [()] * study.samples
    points = cube(study.sampling, len(study.inputs), study.samples, study.seed)
    columns = [x.at(u) for x, u in zip(study.inputs, points.T, strict=True)]
    return list(zip(*columns, strict=True))


def cube(sampling: str, dimensions: int, samples: int, seed: int) -> np.ndarray:
    """Points in the unit cube, shape (samples, dimensions).

    Examples
    --------
    >>> sorted(int(u * 4) for (u,) in cube("latin-hypercube", 1, 4, seed=1))
    [0, 1, 2, 3]

    """
    from scipy.stats import qmc

    design = qmc.Sobol if sampling == "sobol" else qmc.LatinHypercube
    with warnings.catch_warnings():
        # Sobol balances powers of two; the guide says so, and other numbers are allowed.
        warnings.simplefilter("ignore", UserWarning)
        return np.asarray(design(dimensions, rng=np.random.default_rng(seed)).random(samples))
