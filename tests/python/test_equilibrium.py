"""The program's equilibria against an independent solver of the same nonlinear program.

Every H and every slope of every catenary, for random gripper configurations of every kind. The
reference is `oracle.py`: full space, SciPy's SLSQP, polished; it knows nothing of the engine.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import program
import pytest
from configurations import RULES, Configuration, drawn, paper, solved
from oracle import Solution, refine, solve

CONFIGURATIONS = drawn()


def compare(step: Any, reference: Solution) -> None:
    """All forces to 1e-6 of themselves or of a typical one, all slopes to 1e-6."""
    assert step["solver"]["status"] == "converged"
    ours = {line.ends: n for n, line in enumerate(reference.net.catenaries)}
    assert len(step["catenaries"]) == len(ours)
    typical = float(np.nanmedian(np.abs(reference.forces)))
    wrong = []
    for theirs in step["catenaries"]:
        ends = (tuple(theirs["from"]), tuple(theirs["to"]))
        n = ours[ends]
        line = reference.net.catenaries[n]
        name = f"{line.direction} {ends[0]} - {ends[1]}"
        assert theirs["kind"].removeprefix("edge-") == line.direction, name
        assert theirs["shearing"] == line.shearing, name
        (span,) = theirs["spans"]
        if not line.shearing:
            assert theirs["length"] == pytest.approx(line.length, rel=1e-12), name
        force, wanted = span["H_N"], reference.forces[n]
        if np.isnan(wanted):
            if force is not None:
                wrong.append(f"{name}: H {force} N, should have none")
        elif force is None or abs(force - wanted) > 1e-6 * max(abs(wanted), typical):
            wrong.append(f"{name}: H {force} N, should be {wanted}")
        for end in (0, 1):
            slope, wanted = span["slopes"][end], reference.slopes[n, end]
            if abs(slope - wanted) > 1e-6:
                wrong.append(f"{name}: slope {end} {slope}, should be {wanted}")
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize(
    "case", [c for c in CONFIGURATIONS if not c.ambiguous], ids=lambda c: c.name
)
def test_equilibrium_agrees_with_an_independent_solver(case: Configuration, tmp_path: Path) -> None:
    """1e-6 is the promise; the oracle's own error is below 1e-9 (`test_oracle.py`)."""
    step = program.simulate(case.problem, tmp_path)
    reference = solved(case)
    if case.limited:
        assert reference.active.any()
    compare(step, reference)


@pytest.mark.parametrize("case", [c for c in CONFIGURATIONS if c.ambiguous], ids=lambda c: c.name)
def test_one_of_many_equilibria_is_one(case: Configuration, tmp_path: Path) -> None:
    """A stiff ply in compression has several; started at the program's, the oracle stays there."""
    step = program.simulate(case.problem, tmp_path)
    net = solved(case).net  # no shear here: every catenary hangs
    spans = {
        (tuple(c["from"]), tuple(c["to"]), c["kind"].removeprefix("edge-")): c["spans"][0]
        for c in step["catenaries"]
    }
    forces = np.array([spans[(*line.ends, line.direction)]["H_N"] for line in net.catenaries])
    starts = {(key[0], key[2]): span["slopes"][0] for key, span in spans.items()}
    shared = np.array([starts[key] for key in net.shared])
    if case.problem.rule == "min-force":
        reference = refine(case.problem, forces, shared)
        assert reference.curvature > 0.0
    else:
        reference = solve(case.problem, shared)
    assert np.all(reference.above_buckling > 0.0)
    compare(step, reference)


@pytest.mark.parametrize("rule", RULES)
def test_start_of_the_paper_s_example_agrees(rule: str, tmp_path: Path) -> None:
    """The reference solution of the model's description, with and without axial stiffness."""
    for number, stiffness in enumerate((np.inf, 1e5)):
        folder = tmp_path / str(number)
        folder.mkdir()
        problem = paper(rule, stiffness)
        compare(program.simulate(problem, folder), solve(problem))
