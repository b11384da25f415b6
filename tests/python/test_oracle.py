"""The oracle itself: it may judge if it agrees with printed numbers and with itself."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import oracle_span as span
import program
import pytest
from configurations import Configuration, drawn, grid, inclined, mirrored, paper, solved
from oracle import RISING, Model, Problem, Solution, solve
from oracle_span import Spans
from scipy.integrate import quad

CONFIGURATIONS = drawn()
WEIGHT = 0.3143 * 9.8

# --- One span ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("run", "slopes", "force", "sag_mm"),
    [
        (0.098, (None, None), 0.41728, 8.7022),
        (0.098, (0.0, 0.0), 0.32795, 8.8647),
        (0.090, (None, None), 0.15086, 19.4616),
    ],
)
def test_span_has_the_forces_and_sags_of_the_model_page(
    run: float, slopes: tuple[float | None, float | None], force: float, sag_mm: float
) -> None:
    """Printed in the project's description of the model: EI = 9e-6 N m^2, w = 0.3143 * 9.8 N/m."""
    one, ends = span.spans(run, 0.0, WEIGHT, 9e-6, slopes)
    found = span.force_for(one, ends, 0.1)
    assert found == pytest.approx(force, abs=0.5e-5)
    assert span.sag(one, found, ends) * 1e3 == pytest.approx(sag_mm, abs=0.5e-4)


def test_limp_span_is_the_parabola_of_its_exact_length() -> None:
    """Textbook: a parabola of run l and sag d has arc length l/2 sqrt(1+u^2) + l^2/(8d) asinh(u).

    With u = 4d/l and H = q l^2 / (8d). Not the estimate H = sqrt(q^2 l^3 / (24 excess)), which is
    0.4313 N here, 0.9 % more.
    """
    run, weight = 0.098, 3.08
    one, ends = span.spans(run, 0.0, weight, 0.0, (None, None))
    found = span.force_for(one, ends, 0.1)
    depth = span.sag(one, found, ends)
    assert depth == pytest.approx(weight * run**2 / (8.0 * found), rel=1e-12)
    u = 4.0 * depth / run
    arc = run / 2.0 * np.hypot(1.0, u) + run**2 / (8.0 * depth) * np.arcsinh(u)
    assert arc == pytest.approx(0.1, rel=1e-12)


def test_span_has_the_small_sag_values_of_the_strip_cases() -> None:
    """Solved by others, given to 16 digits; 1e-9 is for their tolerance."""
    for case in program.data("strip_cases.json")["cases"]:
        run, rise, length = (case[key] * 1e-3 for key in ("span_mm", "rise_mm", "length_mm"))
        one, ends = span.spans(run, rise, case["w_N_per_m"], case["EI"], tuple(case["end_slopes"]))
        found = span.force_for(one, ends, length)
        wanted = case["small_sag"]
        assert found == pytest.approx(wanted["H_N"], rel=1e-9), case["id"]
        depth = span.sag(one, found, ends) * 1e3
        assert depth == pytest.approx(wanted["sag_vertical_mm"], rel=1e-9), case["id"]
        z = span.stations(one, found, ends)[1] * 1e3
        np.testing.assert_allclose(z, wanted["z_stations_mm"], atol=1e-9, err_msg=case["id"])


def test_first_buckling_loads_are_euler_s() -> None:
    """pi^2 pinned, 4.4934^2 (tan x = x) held at one end, 4 pi^2 held at both."""
    assert span.buckling_number(False, False) == pytest.approx(-(np.pi**2), rel=1e-12)
    assert span.buckling_number(False, True) == pytest.approx(-(4.493409457909064**2), rel=1e-12)
    assert span.buckling_number(True, True) == pytest.approx(-4.0 * np.pi**2, rel=1e-12)


def random_spans(n: int, kl: float, seed: int) -> tuple[Spans, span.Real, span.Real]:
    """n spans with a given k run, their forces and their end slopes."""
    rng = np.random.default_rng(seed)
    run, rise = rng.uniform(0.05, 0.2, n), rng.uniform(-0.05, 0.05, n)
    rigidity = np.full(n, 1e-4)
    held = rng.random((n, 2)) < 0.5
    force = kl**2 * rigidity / run**2
    sagging = 10.0 ** rng.uniform(-2, 0.5, n) * force / run
    return Spans(run, rise, sagging, rigidity, held), force, rng.uniform(-0.8, 0.8, (n, 2))


@pytest.mark.parametrize("kl", [9.0, 10.0, 11.0])
def test_both_routes_give_the_same_shape_where_both_hold(kl: float) -> None:
    """Galerkin and scaled exponentials share no formula; 1e-12 is a few thousand roundings."""
    many, force, slopes = random_spans(100, kl, seed=7)
    share = np.tile(np.linspace(0.0, 1.0, 41), (100, 1))
    a = span.solve(many, force, slopes, share, route="galerkin")
    b = span.solve(many, force, slopes, share, route="layered")
    assert np.max(np.abs(a.turn - b.turn)) < 1e-12
    assert np.max(np.abs(a.height - b.height) / many.run[:, None]) < 1e-12
    assert np.max(np.abs(a.curvatures - b.curvatures) * many.run[:, None] / kl) < 1e-11


@pytest.mark.parametrize("kl", [1e-3, 1.0, 9.9, 10.1, 100.0, 1e4])
def test_arc_length_does_not_depend_on_the_quadrature(kl: float) -> None:
    """Twice and four times the Gauss points move the excess length by rounding alone."""
    many, force, slopes = random_spans(60, kl, seed=11)
    once, *more = (np.real(span.excess(many, force, slopes, points)[0]) for points in (10, 20, 40))
    np.testing.assert_allclose([once, once], more, rtol=1e-11)


@pytest.mark.parametrize("kl", [0.1, 5.0, 30.0, 300.0])
def test_arc_length_is_that_of_an_adaptive_quadrature_of_the_slope(kl: float) -> None:
    """SciPy's quad of sqrt(1 + z'^2) itself, split where the end layers end."""
    many, force, slopes = random_spans(6, kl, seed=13)
    value = np.real(span.excess(many, force, slopes)[0]) + many.chord
    for n in range(6):
        one = many.take(np.array([n]))

        def stretch(t: float, one: Spans = one, n: int = n) -> float:
            shape = span.solve(one, force[n : n + 1], slopes[n : n + 1], np.array([[t]]))
            slope = float(np.real(shape.turn[0, 0])) + float(one.rise[0] / one.run[0])
            return float(np.hypot(1.0, slope))

        layer = min(8.0 / kl, 0.25)
        cuts = [0.0, layer, 0.5, 1.0 - layer, 1.0]
        pieces = [quad(stretch, a, b, epsabs=1e-13, epsrel=1e-12)[0] for a, b in pairwise(cuts)]
        assert value[n] == pytest.approx(sum(pieces) * one.run[0], rel=1e-11)


@pytest.mark.parametrize("kl", [0.5, 9.0, 30.0])
def test_solution_satisfies_the_differential_equation(kl: float) -> None:
    """H z'' - EI z'''' = q integrated twice: H y - EI y'' + EI(chord of y'') = -q x (l - x) / 2.

    y'' by fourth-order central differences of y', whose error at this step is below 1e-7.
    """
    many, force, slopes = random_spans(20, kl, seed=17)
    t = np.linspace(0.1, 0.9, 9)
    d = 1e-3 / max(1.0, kl / 5.0)
    share = np.tile(np.concatenate([t + m * d for m in (-2, -1, 0, 1, 2)]), (20, 1))
    shape = span.solve(many, force, slopes, share)
    u = np.split(np.real(shape.turn), 5, axis=1)
    bend = (u[0] - 8 * u[1] + 8 * u[3] - u[4]) / (12 * d * many.run[:, None])
    height = np.split(np.real(shape.height), 5, axis=1)[2]
    ends = np.real(shape.curvatures)
    lever = ends[:, :1] * (1 - t) + ends[:, 1:] * t
    x = t * many.run[:, None]
    left = force[:, None] * height - many.rigidity[:, None] * (bend - lever)
    right = -many.load[:, None] * x * (many.run[:, None] - x) / 2.0
    size = np.max(np.abs(right), axis=1, keepdims=True)
    size += force[:, None] * np.max(np.abs(height), axis=1, keepdims=True)
    assert np.max(np.abs(left - right) / size) < 1e-7


def test_complex_step_derivatives_agree_with_central_differences() -> None:
    """Tension, compression and both routes; 1e-6 is what central differences can do."""
    for kl in (2.0, 9.0, 25.0):
        many, force, slopes = random_spans(30, kl, seed=19)
        if kl == 2.0:
            force = -force  # kappa = -4: compression short of the first buckling load
        exact = span.response(many, force, slopes)
        h = 1e-6 * np.abs(force)
        ahead, behind = (np.real(span.excess(many, force + m * h, slopes)[0]) for m in (1, -1))
        np.testing.assert_allclose(exact.excess_by[:, 0], (ahead - behind) / (2 * h), rtol=1e-6)
        for end in (0, 1):
            d = np.zeros_like(slopes)
            d[:, end] = 1e-6
            ahead, behind = (np.real(span.excess(many, force, slopes + m * d)[0]) for m in (1, -1))
            central = (ahead - behind) / 2e-6
            assert np.max(np.abs(exact.excess_by[:, 1 + end] - central) / many.run) < 1e-8


# --- The ply -----------------------------------------------------------------------------------


def by_direction(solution: Solution, direction: str) -> span.Real:
    """Forces of one family of catenaries."""
    rows = [n for n, line in enumerate(solution.net.catenaries) if line.direction == direction]
    return solution.forces[rows]


def test_min_force_ply_is_the_reference_of_the_model_page() -> None:
    """4 x 2, 98 mm, level, inextensible; printed in the project's description of the model."""
    found = solve(paper())
    np.testing.assert_allclose(found.shared, np.array([-1, 1, -1, 1]) * 0.022395, atol=0.5e-6)
    row = [0.372456, 0.332103, 0.372456]
    np.testing.assert_allclose(by_direction(found, "u"), row * 2, atol=0.5e-6)
    np.testing.assert_allclose(by_direction(found, "v"), 0.417284, atol=0.5e-6)
    across = [0.605601, 0.574293, 0.605601]
    for direction in ("rising", "falling"):
        np.testing.assert_allclose(by_direction(found, direction), across, atol=0.51e-6)
    assert np.linalg.norm(found.forces) == pytest.approx(1.897002, abs=0.5e-6)


def test_moment_balance_ply_is_the_reference_of_the_model_page() -> None:
    """4 x 2, 98 mm, level, inextensible; printed in the project's description of the model."""
    found = solve(paper("moment-balance"))
    np.testing.assert_allclose(found.shared, np.array([-1, 1, -1, 1]) * 0.00130, atol=0.5e-5)
    row = [0.37426, 0.32819, 0.37426]
    np.testing.assert_allclose(by_direction(found, "u"), row * 2, atol=0.5e-5)


def test_enough_configurations_of_every_kind() -> None:
    """At least 24 by each rule: slack, partly and fully sheared, at their slope limits."""
    by_rule = [c for c in CONFIGURATIONS if c.problem.rule == "min-force"]
    assert len(by_rule) >= 24 and len(CONFIGURATIONS) == 2 * len(by_rule)
    for kind, least in (("slack", 12), ("partly sheared", 4), ("fully sheared", 4)):
        assert sum(c.kind == kind for c in by_rule) >= least
    assert sum(c.limited for c in by_rule) >= 5


@pytest.mark.parametrize("case", CONFIGURATIONS, ids=lambda c: c.name)
def test_oracle_satisfies_its_own_optimality_conditions(case: Configuration) -> None:
    """KKT (or balance) residual at rounding, a strict minimum, every bound with its right sign."""
    found = solved(case)
    assert found.residual < 1e-9
    assert np.all(found.above_buckling[~np.isnan(found.forces)] > 0.0), "off the hanging branch"
    limit = np.tan(case.problem.max_tilt)
    assert np.all(np.abs(found.shared) <= limit * (1 + 1e-12))
    # At a limit the objective (or the energy) falls outward: derivative and slope differ in sign.
    outward = found.multipliers * np.sign(found.shared)
    assert np.all(outward[found.active] < 0.0)
    if case.limited:
        assert found.active.any(), "drawn to have a slope at its limit, but has none"
    if case.problem.rule == "min-force" and found.shared.size:
        assert found.curvature > 0.0


@pytest.mark.parametrize(
    "case", [c for c in CONFIGURATIONS if not c.ambiguous], ids=lambda c: c.name
)
def test_equilibrium_is_the_same_from_another_start(case: Configuration) -> None:
    """From random slopes the same point: so a solver may be judged by it, whatever its start."""
    found = solved(case)
    if not found.shared.size:
        return
    rng = np.random.default_rng(5)
    start = rng.uniform(-0.6, 0.6, found.shared.size) * np.tan(case.problem.max_tilt)
    again = solve(case.problem, start)
    np.testing.assert_allclose(again.shared, found.shared, atol=1e-9)
    np.testing.assert_allclose(again.forces, found.forces, rtol=1e-8, atol=1e-10)


def test_min_force_is_a_minimum_among_neighboring_slopes() -> None:
    """The full-space answer against the reduced one: hang the ply at random slopes nearby."""
    rng = np.random.default_rng(29)
    for case in CONFIGURATIONS:
        if case.problem.rule != "min-force" or case.ambiguous:
            continue
        found = solved(case)
        model = Model(case.problem)
        least = float(np.nansum(found.forces**2))
        for _ in range(3 if found.shared.size else 0):
            s = found.shared + rng.uniform(-0.02, 0.02, found.shared.size)
            s = np.clip(s, -model.bound, model.bound)
            assert float(np.sum(model.hang(s) ** 2)) >= least * (1.0 - 1e-12)


def test_mirrored_ply_has_the_same_forces_and_opposite_slopes() -> None:
    """An invariant: the grid numbered backwards along u."""
    for case in CONFIGURATIONS[:24:3]:
        flipped = replace(case.problem, positions=case.problem.positions[:, ::-1].copy())
        one, two = solved(case), solve(flipped)
        nu = case.problem.size[0]
        for n, line in enumerate(one.net.catenaries):
            there = tuple((nu - 1 - i, j) for i, j in line.ends)
            m = next(m for m, c in enumerate(two.net.catenaries) if {*c.ends} == {*there})
            assert two.forces[m] == pytest.approx(one.forces[n], rel=1e-8, nan_ok=True)


@pytest.mark.parametrize("climb", [0.0, 20.0])
@pytest.mark.parametrize("shear", [15.0, -15.0])
def test_sheared_ply_in_a_plane_has_the_plane_s_slopes(climb: float, shear: float) -> None:
    """By geometry: a plane that climbs by 20 degrees anywhere, fully sheared cells in it.

    Every edge at a constrained gripper has the slope of the plane in its own direction, which is
    that of its chord.
    """
    for towards in np.radians(np.arange(0.0, 360.0, 30.0)):
        at = grid(4, 3, (0.097, 0.097), shear=float(np.radians(shear)))
        at = inclined(at, float(np.radians(climb)), float(towards), turn=0.7)
        for places in (at, mirrored(at)):
            model = Model(Problem(places))
            chords = model.net.rise / model.net.run
            assert len(model.net.planes) == 10
            for (edge, _), slope in model.constrained.items():
                assert slope == pytest.approx(chords[edge], abs=1e-12)


def test_constraint_begins_with_the_unconstrained_slope_and_ends_with_the_plane_s() -> None:
    """The weight at the onset of shear: one cell, its far corner 10 mm up, beyond either end."""
    side, up = 0.099, 0.01

    def cell(angle: float) -> Problem:
        at = grid(2, 2, (side, side), shear=float(np.radians(angle)))
        at[1, 1, 2] = up
        return Problem(at)

    def angle(shear: float) -> float:
        """Of the grid, where the ply shears so: 2 side^2 (1 + sin) + up^2 = 2 0.1^2 (1 + sin)."""
        diagonal = 0.02 * (1.0 + np.sin(np.radians(shear)))
        return float(np.degrees(np.arcsin((diagonal - up**2) / (2.0 * side**2) - 1.0)))

    begins = cell(angle(0.0) + 1e-4)
    # the edges and the other diagonal keep slack
    assert [c.direction for c in Model(begins).net.catenaries if c.shearing] == [RISING]
    free = solve(replace(begins, constrained=False)).slopes
    np.testing.assert_allclose(solve(begins).slopes[:4], free[:4], atol=1e-4)
    before, after = solve(cell(angle(3.0) - 1e-4)), solve(cell(angle(3.0) + 1e-4))
    np.testing.assert_allclose(before.slopes[:4], after.slopes[:4], atol=1e-4)
    weights = [weight for _, weight in Model(cell(angle(3.0) + 1e-4)).net.planes.values()]
    assert weights == [1.0, 1.0]
    assert not np.allclose(after.slopes[:4], free[:4], atol=1e-2)


def test_overstretched_edge_pulls_with_its_axial_stiffness() -> None:
    """EA = 1e5 N and a chord 1 % too long: H = EA * strain / sec, but for what little it sags."""
    at = grid(3, 1, (0.096, 0.1))
    at[0, 2, 0] = 0.096 + 0.101
    found = solve(Problem(at))
    assert found.forces[1] == pytest.approx(1e5 * 0.01, rel=1e-4)
    assert found.residual < 1e-9
