"""Drapes of shipped examples that several tests look at."""

from pathlib import Path

import plydrape
import pytest

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


def drape(name: str) -> plydrape.Result:
    """The example of a name, along its motion."""
    return plydrape.simulate(plydrape.Scene.read(EXAMPLES / name / "scene.toml"))


@pytest.fixture(scope="session")
def flat() -> plydrape.Result:
    """The paper's example: limits are exceeded, the mold is a plane."""
    return drape("01_flat_sheared_mold")


@pytest.fixture(scope="session")
def dome() -> plydrape.Result:
    """A dome, draped straight."""
    return drape("04_dome")


@pytest.fixture(scope="session")
def shallow() -> plydrape.Result:
    """A mold without symmetry, draped straight: no cell is like another."""
    return drape("08_stl_mold")


@pytest.fixture(scope="session")
def strip() -> plydrape.Result:
    """One row of grippers, no mold."""
    return drape("02_hanging_strip")
