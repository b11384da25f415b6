"""Equilibria, their derivatives and batches from Python, against differences and each other."""

from pathlib import Path
from typing import Literal

import numpy as np
import plydrape
import pytest
from numpy.typing import NDArray
from studies import PAPER

Array = NDArray[np.float64]
Wrt = Literal["grippers", "lengths", "material"]
FLAT = Path(__file__).resolve().parents[3] / "examples" / "01_flat_sheared_mold" / "scene.toml"
RULES: list[Literal["moment-balance", "min-force"]] = ["moment-balance", "min-force"]


def ply(
    cell: tuple[float, float] = (0.1, 0.09),
    scale: dict[str, float] | None = None,
    areal: bool = True,
) -> plydrape.Ply:
    """A ply of 4 × 3 grippers; `scale` multiplies numbers of its material."""
    numbers = {"mass": 0.314, "bending_rigidity_warp": 9e-5, "bending_rigidity_weft": 5e-5}
    if not areal:
        numbers = {"mass": 0.0314, "flexural_rigidity": 9e-6}
    material: dict[str, object] = {
        name: value * (scale or {}).get(name, 1.0) for name, value in numbers.items()
    }
    if areal:
        material["mass"] = f"{material['mass']!r} kg/m^2"
    return plydrape.Ply(grippers=[4, 3], cell=cell, material=material, warp="v")


def places(seed: int) -> Array:
    """Grippers near a slack array, some cells sheared: nothing is symmetric or level."""
    j, i = np.divmod(np.arange(12), 4)
    level = np.stack([0.097 * i + 0.014 * (j > 1), 0.086 * j, 0.004 * i * j], axis=1)
    return level + np.random.default_rng(seed).normal(0, 4e-4, (12, 3))


def solve(
    ply: plydrape.Ply, positions: Array, rule: Literal["moment-balance", "min-force"]
) -> plydrape.Equilibrium:
    """From nothing."""
    return plydrape.Solver(ply, slopes=rule).solve(positions)


def compare(
    jacobian: plydrape.Jacobian,
    column: int,
    low: plydrape.Equilibrium,
    high: plydrape.Equilibrium,
    step: float,
) -> None:
    """One column of a Jacobian against a central difference over `step`."""
    parts = {
        "forces": (jacobian.forces, low.forces, high.forces),
        "slopes": (jacobian.slopes, low.slopes, high.slopes),
        "shear": (jacobian.shear, low.shear, high.shear),
        "points": (jacobian.points(9), low.points(9), high.points(9)),
    }
    for name, (exact, below, above) in parts.items():
        difference = (above - below) / step
        exact = exact.reshape(*difference.shape, -1)[..., column]
        assert np.array_equal(np.isnan(exact), np.isnan(difference)), name
        # the error of the difference is of its second order and of rounding over the step
        scale = np.nanmax(np.abs(difference)) + 1e-9
        assert np.nanmax(np.abs(exact - difference)) < 2e-5 * scale, (name, column)


@pytest.mark.parametrize("rule", RULES)
def test_an_equilibrium_says_how_it_was_found(
    rule: Literal["moment-balance", "min-force"],
) -> None:
    """The error of the lengths is that of the lines as drawn, and what ended early is counted."""
    base = plydrape.Ply(grippers=[4, 1], cell=[0.1, 0.1], material="krogh2018")
    places = np.stack([0.097 * np.arange(4), np.zeros(4), np.zeros(4)], axis=1)
    equilibrium = solve(base, places, rule)
    lines = np.diff(equilibrium.points(4001), axis=1)
    lengths = np.linalg.norm(lines, axis=2).sum(axis=1)
    # the fabric stretches by H/EA, and a polyline of this many parts is 1e-8 short
    assert np.abs(lengths / 0.1 - 1.0).max() < 1e-5
    assert equilibrium.status == "converged"
    assert 0.0 <= equilibrium.length_residual < 1e-9 and equilibrium.residual < 1e-6
    assert equilibrium.early_ends["line_searches"] == 0
    assert all(isinstance(count, int) and count >= 0 for count in equilibrium.early_ends.values())


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("areal", [True, False])
def test_jacobians_agree_with_central_differences(
    rule: Literal["moment-balance", "min-force"], areal: bool
) -> None:
    """To every gripper coordinate, both lengths and every number of the material."""
    base, positions = ply(areal=areal), places(5)
    equilibrium = solve(base, positions, rule)
    assert (equilibrium.shear > 0).any() and (equilibrium.shear == 0).any()

    grippers = equilibrium.jacobian(wrt="grippers")
    for n, k in [(0, 0), (1, 2), (5, 0), (5, 1), (5, 2), (11, 1)]:
        h = 1e-7
        low, high = positions.copy(), positions.copy()
        low[n, k] -= h
        high[n, k] += h
        compare(
            grippers,
            3 * n + k,
            solve(base, low, rule),
            solve(base, high, rule),
            high[n, k] - low[n, k],
        )

    lengths = equilibrium.jacobian(wrt="lengths")
    for k in range(2):
        low_cell, high_cell = [0.1, 0.09], [0.1, 0.09]
        low_cell[k] -= 1e-7
        high_cell[k] += 1e-7
        low_ply = ply((low_cell[0], low_cell[1]), areal=areal)
        high_ply = ply((high_cell[0], high_cell[1]), areal=areal)
        compare(
            lengths,
            k,
            solve(low_ply, positions, rule),
            solve(high_ply, positions, rule),
            high_cell[k] - low_cell[k],
        )

    material = equilibrium.jacobian(wrt="material")
    assert len(material.names) == (3 if areal else 2)
    values = {"mass": 0.314, "bending_rigidity_warp": 9e-5, "bending_rigidity_weft": 5e-5}
    if not areal:
        values = {"mass": 0.0314, "flexural_rigidity": 9e-6}
    for k, name in enumerate(material.names):
        low_ply, high_ply = (ply(scale={name: 1 + s * 1e-5}, areal=areal) for s in (-1, 1))
        compare(
            material,
            k,
            solve(low_ply, positions, rule),
            solve(high_ply, positions, rule),
            2e-5 * values[name],
        )


def test_moving_everything_alike_changes_nothing() -> None:
    """The sum of the derivatives over all grippers is that of a rigid motion: only points move."""
    equilibrium = solve(ply(), places(2), "moment-balance")
    jacobian = equilibrium.jacobian(wrt="grippers")
    scale = np.nanmax(np.abs(jacobian.forces))
    assert np.nanmax(np.abs(jacobian.forces.sum(axis=-2))) < 1e-9 * scale
    together = jacobian.points(5).sum(axis=-2)
    assert np.allclose(together, np.broadcast_to(np.eye(3), together.shape), atol=1e-9)


@pytest.mark.parametrize("rule", RULES)
def test_a_batch_is_its_equilibria_one_by_one(rule: Literal["moment-balance", "min-force"]) -> None:
    """To the last bit, whatever the number of threads."""
    base = ply()
    positions = np.stack([places(seed) for seed in range(40)])
    solver = plydrape.Solver(base, slopes=rule)
    one, two = (plydrape.batch.equilibria(solver, positions, threads=n) for n in (1, 2))
    assert len(one) == 40 and one.converged.all()
    assert np.array_equal(one.forces, two.forces, equal_nan=True)
    for n in range(40):
        alone = solve(base, positions[n], rule)
        assert np.array_equal(alone.forces, one.forces[n], equal_nan=True)
        assert np.array_equal(alone.slopes, one.slopes[n])
        assert np.array_equal(alone.shear, one.shear[n])


def test_a_batch_of_drapes_is_its_drapes_one_by_one() -> None:
    """The same text of result.json."""
    scene = plydrape.Scene.read(FLAT)
    scenes = [
        scene.with_motion(scene.times, scene.positions + np.array([0, 0, h])) for h in (0, 1e-3)
    ]
    for scene, result in zip(scenes, plydrape.batch.simulate(scenes), strict=True):
        assert plydrape.simulate(scene).to_json() == result.to_json()


def test_an_equilibrium_that_is_not_found_says_so() -> None:
    """Grippers at one place, far beyond any slope: an error, or with check=False a status."""
    base = plydrape.Ply(
        grippers=[3, 1], cell=[0.1, 0.1], material={"mass": 0.3, "flexural_rigidity": 0.0}
    )
    solver = plydrape.Solver(base)
    equilibrium = solver.solve(np.array([[0, 0, 0], [0.098, 0, 0], [0.196, 0, 0]]))
    with pytest.raises(plydrape.SolveError, match="rigidity of the material is zero"):
        equilibrium.jacobian(wrt="material")
    assert equilibrium.jacobian(wrt="lengths").names == ["u", "v"]


def test_a_span_agrees_with_the_command_line_and_the_limp_limit() -> None:
    """Sag of a limp span is that of the catenary, z = (H/w)(cosh(wx/H) - 1)."""
    span = plydrape.Span(
        run=0.1, length=0.1002, weight=3.0, flexural_rigidity=0.0, axial_stiffness=np.inf
    )
    assert span.force is not None
    a = span.force / 3.0
    # small-sag: the parabola's arc length differs in order (sag/run)^4
    assert span.sag == pytest.approx(a * (np.cosh(0.05 / a) - 1), rel=2e-3)
    assert np.allclose(span.heights([0, 0.1]), 0, atol=1e-15)
    for slopes in [(0.1, None), (0.1, -0.1)]:
        held = plydrape.Span(
            run=0.1, length=0.101, weight=3.0, flexural_rigidity=1e-5, slopes=slopes
        )
        assert held.slopes[0] == pytest.approx(0.1, abs=1e-12)
    with pytest.raises(ValueError, match="run is 0; expected a positive number"):
        plydrape.Span(run=0.0, length=0.1, weight=3.0, flexural_rigidity=0.0)


def outcome_at(scene: plydrape.Scene, n: int, k: int, h: float) -> plydrape.Outcome:
    """The drape with one gripper's last position moved."""
    positions = scene.positions
    positions[-1, n, k] += h
    return plydrape.outcome(scene.with_motion(scene.times, positions))


def test_an_outcome_changes_with_its_targets_as_it_says() -> None:
    """Against central differences of whole drapes, hanging and sheared at the end."""
    scene = plydrape.Scene(
        ply={"grippers": [4, 2], "cell": [0.1, 0.09], "material": "krogh2018"},
        grippers={"spacing": ["98 mm", "88 mm"], "height": "75 mm"},
        target={"positions": places(3)[4:].reshape(2, 4, 3)},
        model={"kind": "catenaries"},
    )
    middle = plydrape.outcome(scene)
    assert (middle.shear > 0).any()
    for n, k in [(0, 2), (1, 0), (6, 1), (6, 2)]:
        low, high = outcome_at(scene, n, k, -1e-6), outcome_at(scene, n, k, 1e-6)
        for name in ("overstretch", "forces", "shear", "tilts"):
            exact = getattr(middle, f"{name}_jacobian")[:, n, k]
            difference = (getattr(high, name) - getattr(low, name)) / 2e-6
            scale = np.nanmax(np.abs(difference)) + 1e-6
            assert np.nanmax(np.abs(exact - difference)) < 1e-4 * scale, (name, n, k)


def test_an_outcome_has_the_drapes_own_numbers() -> None:
    """On a mold at the end: tilt, shear and overstretch are those that the result judges."""
    scene = plydrape.Scene.read(PAPER)
    outcome = plydrape.outcome(scene)
    result = outcome.result
    assert result.to_json() == plydrape.simulate(scene).to_json()
    assert np.allclose(np.rad2deg(outcome.tilts), result.tilts_deg[-1], atol=1e-9)
    shear = np.rad2deg(outcome.shear).reshape(result.shear_deg[-1].shape)
    assert np.allclose(np.nan_to_num(shear), result.shear_deg[-1], atol=1e-9)
    edges = 3 * 2 + 4
    worst = result.measures["overstretch_mm"][-1]
    assert outcome.overstretch[:edges].max() * 1e3 == pytest.approx(worst, abs=1e-9)


@pytest.mark.parametrize("name", ["01_flat_sheared_mold", "ideal_dome"])
def test_a_landed_outcome_changes_with_its_targets_as_it_says(name: str) -> None:
    """Lying rests as well: against whole drapes whose last step ends a micrometer aside."""
    scene = plydrape.Scene.read(FLAT.parents[1] / name / "scene.toml")
    middle = plydrape.outcome(scene)
    worst = int(middle.overstretch.argmax())
    gripper = int(scene.ply.catenaries[worst, 0])
    for k in range(2):
        low, high = (outcome_at(scene, gripper, k, h) for h in (-1e-6, 1e-6))
        difference = (high.overstretch - low.overstretch) / 2e-6
        exact = middle.overstretch_jacobian[:, gripper, k]
        # the same is caught: contact that begins between the two would jump
        same = np.abs(difference - exact) < 1e-3
        assert same[worst] and same.mean() > 0.8, (difference, exact)
