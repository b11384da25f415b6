"""Shared by all Python tests: their order on processes, one thread each, drapes that many need."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from plydrape import Result

# Before NumPy is loaded: many small solves are slower on several threads.
for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")

# An image of a container often forbids compiled modules. Then each of the hundreds of processes
# that tests start would compile SciPy, pandas and the like once more, which takes seconds.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# A shell that runs the tests in the background ignores Ctrl-C for them and all that they start.
signal.signal(signal.SIGINT, signal.default_int_handler)

# Files whose tests share what takes long to make, such as equilibria that the oracle has solved.
TOGETHER = {
    "test_oracle.py": "oracle",
    "test_equilibrium.py": "oracle",
    "test_inp.py": "CalculiX",
    "test_ngsolve.py": "NGSolve",
    "test_net.py": "net",
    "test_notebook.py": "notebook",
    "test_ros2.py": "ROS 2",
    "test_sheet_peer.py": "MuJoCo",
    "test_unseen.py": "unseen",
    "test_vtk.py": "VTK",
}

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Leaves out what takes minutes, unless all cases are asked for."""
    if item.get_closest_marker("long") and "PLYDRAPE_LONG" not in os.environ:
        pytest.skip("NOT RUN: it takes minutes; scripts/soak runs it")


def scope(test: str) -> str:
    """Tests of one scope run on one process, one after the other; the largest scopes begin."""
    return TOGETHER.get(Path(test.partition("::")[0]).name, test)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Tests that share much stay together; each other one goes where there is room."""
    from xdist.scheduler import LoadScopeScheduling

    scheduling = LoadScopeScheduling(config, log)
    scheduling._split_scope = scope
    return scheduling


def drape(name: str) -> Result:
    """The example of a name in an ideal cell, along its motion, with the catenaries alone."""
    # it loads NumPy, which shall see the setting above
    import plydrape

    scene = plydrape.Scene.read(EXAMPLES / name / "scene.toml")
    return plydrape.simulate(scene.replace(cell={"preset": "ideal"}), model="catenaries")


@pytest.fixture(scope="session")
def flat() -> Result:
    """The paper's example: limits are exceeded, the mold is a plane."""
    return drape("01_flat_sheared_mold")


@pytest.fixture(scope="session")
def sheet() -> Result:
    """A sheet over the dome with few nodes, three of its six states kept."""
    import plydrape

    path = EXAMPLES / "ideal_dome" / "scene.toml"
    text = path.read_text().replace("steps = 30", "steps = 6")
    text += '[sheet]\nmesh = "50 mm"\nkeep = 3\n'
    return plydrape.simulate(plydrape.Scene.parse(text, base=path.parent))


@pytest.fixture(scope="session")
def dome() -> Result:
    """A dome, draped straight."""
    return drape("ideal_dome")


@pytest.fixture(scope="session")
def shallow() -> Result:
    """A mold without symmetry, draped straight: no cell is like another."""
    return drape("08_stl_mold")


@pytest.fixture(scope="session")
def strip() -> Result:
    """One row of grippers, no mold."""
    return drape("02_hanging_strip")
