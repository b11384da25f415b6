"""What has gone through a pickle or result.json is used, and does what the original does."""

import copy
import multiprocessing
import pickle
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import plydrape
import pytest

SCENE = """
[ply]
grippers = [3, 2]
cell = ["100 mm", "100 mm"]
material = "prepreg_warm"

[mold]
kind = "sphere"
radius = "0.8 m"
position = [0, 0, "-0.8 m"]

[grippers]
spacing = ["98 mm", "98 mm"]
height = "30 mm"
origin = "centered"

[target]
seed = "middle"

[motion]
kind = "straight"
steps = 4

[sheet]
mesh = "50 mm"

[errors]
samples = 2
gripper = { position = { deviation = "0.1 mm" } }
"""

CUT = """
[ply]
size = ["330 mm", "230 mm"]
warp = "45 deg"
holes = [{ middle = ["165 mm", "115 mm"], diameter = "40 mm" }]
grippers = [3, 2]
cell = ["100 mm", "100 mm"]
material = "prepreg_warm"

[mold]
kind = "cylinder"
radius = "0.8 m"
position = [0, 0, "-0.8 m"]

[grippers]
pad_radius = "20 mm"
spacing = ["98 mm", "98 mm"]
height = "30 mm"
origin = "centered"
direction = "45 deg"

[target]
direction = "45 deg"

[motion]
kind = "straight"
steps = 3

[sheet]
mesh = "25 mm"
"""

AIR = """
[ply]
grippers = [3, 2]
cell = ["100 mm", "100 mm"]
material = "krogh2018"

[grippers]
spacing = ["98 mm", "98 mm"]
height = "75 mm"

[model]
kind = "catenaries"
"""


def stored(value: Any) -> Any:
    """A value as another process gets it."""
    return pickle.loads(pickle.dumps(value))


def arrays(sheet: plydrape.Sheet | None) -> list[Any]:
    """What is in the sheet of a result."""
    assert sheet is not None
    return [sheet.positions, sheet.shear, sheet.tension, sheet.contact]


def same(a: list[Any], b: list[Any]) -> bool:
    """Whether arrays are the same, number by number."""
    return all(np.array_equal(p, q, equal_nan=True) for p, q in zip(a, b, strict=True))


@pytest.fixture(scope="module", params=[SCENE, CUT], ids=["array", "cut"])
def scene(request: pytest.FixtureRequest) -> plydrape.Scene:
    """A scene whose target is an ideal drape."""
    return plydrape.Scene.parse(request.param)


@pytest.fixture(scope="module")
def result(scene: plydrape.Scene) -> plydrape.Result:
    """Drape here."""
    return plydrape.simulate(scene)


def test_a_stored_scene_drapes_as_its_original(
    scene: plydrape.Scene, result: plydrape.Result
) -> None:
    """Once and twice stored, and changed after it was stored."""
    once = stored(scene)
    assert once == scene and plydrape.simulate(once) == result
    assert plydrape.simulate(stored(once)) == result
    assert plydrape.simulate(copy.deepcopy(scene)) == result
    moved = [kept.with_motion(2 * kept.times, kept.positions) for kept in (scene, once)]
    assert plydrape.simulate(moved[0]) == plydrape.simulate(moved[1])
    limited = [kept.replace(limits={"height": "2 mm"}) for kept in (scene, once)]
    assert plydrape.simulate(limited[0]) == plydrape.simulate(limited[1])
    if "warp" not in (scene.text or ""):
        # catenaries need yarns from cup to cup
        assert plydrape.outcome(once).result == plydrape.outcome(scene).result
    nets = [kept.net for kept in (scene, once) if kept.net is not None]
    assert len(nets) == 2
    assert nets[0] == nets[1] and same(*([net.nodes, net.shear_deg] for net in nets))


def test_a_stored_scene_is_planned_as_its_original() -> None:
    """A few candidates of the search, and what the stored plan has is that of the plan."""
    scene = plydrape.Scene.parse(SCENE)
    short = scene.replace(plan={"evaluations": 3})
    told = [plydrape.plan(kept, without_errors=True) for kept in (short, stored(short))]
    plans = [*told, stored(told[0])]
    for plan in plans:
        assert plan.accepted == plans[0].accepted
        assert same([plan.times, plan.positions], [plans[0].times, plans[0].positions])
        assert plan.result == plans[0].result
    drapes = [scene.with_motion(plan.times, plan.positions) for plan in plans]
    assert plydrape.simulate(drapes[0]) == plydrape.simulate(drapes[2])


def test_a_stored_result_is_used_as_its_original(result: plydrape.Result, tmp_path: Path) -> None:
    """Its sheet and its files are those of the result; as are those of one that was read."""
    again = stored(result)
    folders = [tmp_path / name for name in ("first", "pickled", "read")]
    files = result.write(folders[0])
    again.write(folders[1])
    read = plydrape.Result.read(folders[0])
    read.write(folders[2])
    for other in (again, read):
        assert other == result and same(arrays(other.sheet), arrays(result.sheet))
        assert same(arrays(stored(other).sheet), arrays(result.sheet))
    for file in files:
        for folder in folders[1:]:
            assert (folder / file.name).read_bytes() == file.read_bytes(), file.name


@dataclass
class Case:
    """A value, and a list of arrays that come from its use."""

    value: Any
    used: Callable[[Any], list[Any]]


def solved(solver: plydrape.Solver) -> list[Any]:
    """Forces of two starts, the second from the first."""
    solver.forget()
    start = plydrape.Scene.parse(AIR).positions[0]
    return [solver.solve(share * start).forces for share in (1.0, 0.99)]


def values() -> dict[str, Case]:
    """One of each class that can be stored, with what is done with it."""
    scene = plydrape.Scene.parse(SCENE)
    result = plydrape.simulate(scene, also="catenaries")
    outcome = plydrape.outcome(scene)
    solver = plydrape.Solver.of(plydrape.Scene.parse(AIR))
    assert scene.mold is not None
    points = np.array([[0.01, 0.02, 0.1], [0.1, -0.05, 0.0]])
    start = plydrape.Scene.parse(AIR).positions[0]
    equilibria = plydrape.batch.equilibria(solver, np.stack([start, 0.99 * start]))
    return {
        "Mold": Case(scene.mold, lambda mold: [mold.closest_points(points).points]),
        "ClosestPoints": Case(scene.mold.closest_points(points), lambda c: [c.points, c.normals]),
        "Net": Case(scene.net, lambda net: [net.nodes, net.shear_deg]),
        "Ply": Case(scene.ply, lambda ply: [ply.places, ply.cell]),
        "Material": Case(
            scene.ply.material, lambda m: [m.shear_force([0.1, 0.2]), m.tension(0.01)]
        ),
        "Measure": Case(plydrape.measures()[0], lambda measure: [measure.factor]),
        "Sample": Case(result.sample, lambda sample: [sample.heights_mm, sample.spread_mm]),
        "Sheet": Case(result.sheet, arrays),
        "Drape": Case(result.also, lambda drape: [drape.positions, drape.loads]),
        "Surface": Case(result.surface(2), lambda s: [s.points, s.triangles]),
        "Outcome": Case(outcome, lambda o: [o.forces, o.shear, o.tilts]),
        "Solver": Case(solver, solved),
        "Equilibria": Case(equilibria, lambda e: [e.forces, e.slopes]),
        "Span": Case(
            plydrape.Span(run=0.098, length=0.1, weight=3.0, flexural_rigidity=9e-6),
            lambda span: [span.points(5), span.sag, span.force],
        ),
    }


def test_every_class_that_is_stored_is_used_afterwards() -> None:
    """All of them by name, none left out, with the same numbers."""
    from plydrape import _values

    cases = values()
    tested_elsewhere = {"Plan", "Result", "Scene"}
    names = {kind.__name__ for kind in _values.VALUES} | {"Solver"}
    assert set(cases) == names - tested_elsewhere
    for name, case in cases.items():
        assert type(case.value).__name__ == name
        assert same(case.used(stored(case.value)), case.used(case.value)), name
        assert same(case.used(copy.copy(case.value)), case.used(case.value)), name


def draped(scene: plydrape.Scene) -> plydrape.Result:
    """The work of a worker: it uses what was sent, and its answer is sent back."""
    return plydrape.simulate(scene)


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_another_process_drapes_a_scene_that_is_sent(
    method: str,
) -> None:
    """However processes are started, after this one has draped with all of its threads."""
    scene = plydrape.Scene.parse(SCENE)
    result = plydrape.simulate(scene)
    context = multiprocessing.get_context(method)
    with ProcessPoolExecutor(1, mp_context=context) as executor:
        assert list(executor.map(draped, [scene, scene])) == [result, result]
    with context.Pool(1) as pool:
        assert pool.map(draped, [scene]) == [result]


def test_joblib_and_dask_drape_a_scene_that_is_sent() -> None:
    """Where they are installed."""
    scene = plydrape.Scene.parse(SCENE)
    result = plydrape.simulate(scene)
    joblib = pytest.importorskip("joblib")
    made = joblib.Parallel(n_jobs=2, backend="loky")(
        joblib.delayed(draped)(scene) for _ in range(2)
    )
    assert made == [result, result]
    from joblib.externals.loky import get_reusable_executor

    get_reusable_executor().shutdown(
        wait=True
    )  # its workers would wait for more, beside other tests
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=1, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        assert client.gather(client.map(draped, [scene])) == [result]
