"""Shared by all Python tests: one thread per process, and drapes that several look at."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from plydrape import Result

# Before NumPy is loaded: many small solves are slower on several threads.
for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def drape(name: str) -> Result:
    """The example of a name, along its motion."""
    # it loads NumPy, which shall see the setting above
    import plydrape

    return plydrape.simulate(plydrape.Scene.read(EXAMPLES / name / "scene.toml"))


@pytest.fixture(scope="session")
def flat() -> Result:
    """The paper's example: limits are exceeded, the mold is a plane."""
    return drape("01_flat_sheared_mold")


@pytest.fixture(scope="session")
def dome() -> Result:
    """A dome, draped straight."""
    return drape("04_dome")


@pytest.fixture(scope="session")
def shallow() -> Result:
    """A mold without symmetry, draped straight: no cell is like another."""
    return drape("08_stl_mold")


@pytest.fixture(scope="session")
def strip() -> Result:
    """One row of grippers, no mold."""
    return drape("02_hanging_strip")
