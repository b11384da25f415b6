"""The peer of the speed table: one 4 x 2 equilibrium as a practitioner would solve it in SciPy.

After Krogh et al. 2018: unknowns are all horizontal forces and the shared slopes, lengths are sums
of distances along 100-point polylines of the closed-form shape, the gradients of the lengths are
finite differences per catenary put together by the chain rule, the gradient of the objective is
analytic, the optimizer is SLSQP.

Prints one JSON object: the median time of a cold equilibrium (start of the paper's example, from
the parabola's forces and level slopes) and of a warm one (its second step, from the first), what
they cost in iterations, and the forces found. SI units. `cold_us` and `warm_us` are with NumPy
working on all catenaries at once; the `_by_catenary` times are of the same code called catenary by
catenary, as the paper describes it.

    OPENBLAS_NUM_THREADS=1 python benches/peers/slsqp.py
"""

from __future__ import annotations

import json
import statistics
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

Real = NDArray[np.float64]

NU, NV = 4, 2
CELL, SPACING, HEIGHT = 0.1, 0.098, 0.075
WEIGHT, RIGIDITY, AXIAL = 0.3143 * 9.8, 9e-6, 1e5
SHEAR, STEPS = float(np.radians(20.0)), 30
LIMIT = float(np.tan(np.radians(40.0)))
POINTS = 100
RUNS = 31

# Edges along u, edges along v, diagonals; each with its two grippers, numbered j * NU + i.
EDGES = [(j * NU + i, j * NU + i + 1) for j in range(NV) for i in range(NU - 1)]
EDGES += [(i, i + NU) for i in range(NU)]
DIAGONALS = [pair for i in range(NU - 1) for pair in ((i, i + NU + 1), (i + 1, i + NU))]
ENDS = np.array(EDGES + DIAGONALS)
N_EDGES, N = len(EDGES), len(ENDS)
SHARED = {1: 0, 2: 1, 5: 2, 6: 3}  # slopes along u at the inner grippers


def positions(step: int) -> Real:
    """Gripper positions (8, 3) in a step of the paper's example, counted from 1."""
    i, j = np.tile(np.arange(NU), NV), np.repeat(np.arange(NV), NU)
    start = np.stack([i * SPACING, j * SPACING, np.full(NU * NV, HEIGHT)], axis=1)
    x = i * CELL + j * CELL * np.sin(SHEAR)
    end = np.stack([x, j * CELL * np.cos(SHEAR), np.zeros(NU * NV)], axis=1)
    return np.asarray(start + (end - start) * (step - 1) / (STEPS - 1))


def shape(
    run: Real, rise: Real, force: Real, slopes: Real, held: NDArray[np.bool_]
) -> tuple[Real, Real]:
    """Lengths (n,) of the polylines and the slopes at both ends (n, 2).

    ``run``, ``rise``, ``force``: (n,); ``slopes``, ``held``: (n, 2). With k = sqrt(H / EI),
    z = h x/l - q x (l-x) / 2H + A (e^(-kx) - 1 + ..) + B (..): the constants A and B of the two end
    layers follow from zero moment or the prescribed slope at each end.
    """
    k = np.sqrt(force / RIGIDITY)
    load = WEIGHT * np.hypot(run, rise) / run
    p = np.exp(-k * run)
    # Shape functions a = e^(-kx) and b = e^(-k(l-x)), less the chords through their ends.
    sink = (1.0 - p) / run
    chord = rise / run
    bend = load / force
    # Slope at the ends: chord -+ bend l/2 + A (a' + sink) + B (b' - sink); moment: k^2 (A a + B b).
    a11 = np.where(held[:, 0], -k + sink, 1.0)
    a12 = np.where(held[:, 0], k * p - sink, p)
    a21 = np.where(held[:, 1], -k * p + sink, p)
    a22 = np.where(held[:, 1], k - sink, 1.0)
    r1 = np.where(held[:, 0], slopes[:, 0] - chord + bend * run / 2.0, -bend / k**2)
    r2 = np.where(held[:, 1], slopes[:, 1] - chord - bend * run / 2.0, -bend / k**2)
    det = a11 * a22 - a12 * a21
    big_a, big_b = (r1 * a22 - a12 * r2) / det, (a11 * r2 - a21 * r1) / det

    t = np.linspace(0.0, 1.0, POINTS)
    x = run[:, None] * t
    first = np.exp(-k[:, None] * x)
    second = first[:, ::-1]
    z = rise[:, None] * t - (bend * run**2 / 2.0)[:, None] * (t * (1.0 - t))
    z += big_a[:, None] * (first - 1.0 + (1.0 - p)[:, None] * t)
    z += big_b[:, None] * (second - p[:, None] - (1.0 - p)[:, None] * t)
    dx = run / (POINTS - 1)
    length = np.sqrt(dx[:, None] ** 2 + np.diff(z, axis=1) ** 2).sum(axis=1)

    left = chord - bend * run / 2.0 + big_a * (-k + sink) + big_b * (k * p - sink)
    right = chord + bend * run / 2.0 + big_a * (-k * p + sink) + big_b * (k - sink)
    return length, np.stack([left, right], axis=1)


def shape_by_catenary(
    run: Real, rise: Real, force: Real, slopes: Real, held: NDArray[np.bool_]
) -> tuple[Real, Real]:
    """The same as :func:`shape`, one call for each catenary."""
    cuts = [slice(n, n + 1) for n in range(run.size)]
    parts = [shape(run[c], rise[c], force[c], slopes[c], held[c]) for c in cuts]
    return np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])


class Ply:
    """The length constraints of the ply at given gripper positions (all cells slack)."""

    def __init__(self, at: Real, one_by_one: bool = False) -> None:
        """Geometry: runs, rises, which slopes are held, and the planes at the diagonals' ends."""
        self.shape = shape_by_catenary if one_by_one else shape
        d = at[ENDS[:, 1]] - at[ENDS[:, 0]]
        self.run, self.rise = np.hypot(d[:, 0], d[:, 1]), d[:, 2]
        self.flat = np.where(np.arange(N) < N_EDGES, CELL, CELL * np.sqrt(2.0))
        self.soft = self.flat * np.hypot(self.run, self.rise) / self.run / AXIAL
        if np.any(np.hypot(self.run, self.rise) >= self.flat):
            raise ValueError("a cell shears: the peer only does slack plies")
        self.held = np.ones((N, 2), bool)
        self.held[:N_EDGES] = False
        # Which shared slope holds an edge's end: spread (2 edges, 4 slopes).
        self.spread = np.zeros((N_EDGES, 2, len(SHARED)))
        for row, ends in enumerate(EDGES[: 2 * (NU - 1)]):
            for end in (0, 1):
                if ends[end] in SHARED:
                    self.held[row, end] = True
                    self.spread[row, end, SHARED[ends[end]]] = 1.0
        # Slope of a diagonal's end: weighted slopes of its cell's two edges there.
        self.plane = np.zeros((N - N_EDGES, 2, N_EDGES, 2))
        flat = d[:, :2] / self.run[:, None]
        for row, pair in enumerate(DIAGONALS):
            for end in (0, 1):
                here, there = pair[end], pair[1 - end]
                corners = (here // NU * NU + there % NU, there // NU * NU + here % NU)
                edges = [EDGES.index((min(here, c), max(here, c))) for c in corners]
                weights = np.linalg.solve(flat[edges].T, flat[N_EDGES + row])
                for edge, weight in zip(edges, weights, strict=True):
                    self.plane[row, end, edge, EDGES[edge].index(here)] = weight

    def start(self) -> Real:
        """Forces of the parabolas, level slopes."""
        excess = self.flat - np.hypot(self.run, self.rise)
        return np.concatenate([np.sqrt(WEIGHT**2 * self.run**3 / (24.0 * excess)), np.zeros(4)])

    def lengths(self, v: Real) -> Real:
        """Length of each catenary less the length to reach, relative (n,)."""
        force, slopes = v[:N], np.zeros((N, 2))
        e, d = slice(0, N_EDGES), slice(N_EDGES, N)
        slopes[e] = self.spread @ v[N:]
        out = np.empty(N)
        out[e], ends = self.shape(self.run[e], self.rise[e], force[e], slopes[e], self.held[e])
        slopes[d] = np.tensordot(self.plane, ends, 2)
        out[d], _ = self.shape(self.run[d], self.rise[d], force[d], slopes[d], self.held[d])
        gap: Real = (out - self.flat - self.soft * force) / self.flat
        return gap

    def jacobian(self, v: Real) -> Real:
        """Derivative of :meth:`lengths`, (n, n + 4): forward differences in H and both slopes."""
        force, slopes = v[:N], np.zeros((N, 2))
        e, d = slice(0, N_EDGES), slice(N_EDGES, N)
        slopes[e] = self.spread @ v[N:]
        out = np.zeros((N, N + 4))

        length_by, ends_by, ends = differences(self, e, force[e], slopes[e])
        ends_all = np.zeros((N_EDGES, 2, N + 4))  # slopes of the edges' ends by all unknowns
        ends_all[np.arange(N_EDGES), :, np.arange(N_EDGES)] = ends_by[:, :, 0]
        ends_all[:, :, N:] = np.einsum("ned,nds->nes", ends_by[:, :, 1:], self.spread)
        out[np.arange(N_EDGES), np.arange(N_EDGES)] = length_by[:, 0]
        out[e, N:] = np.einsum("nd,nds->ns", length_by[:, 1:], self.spread)

        slopes[d] = np.tensordot(self.plane, ends, 2)
        length_by, _, _ = differences(self, d, force[d], slopes[d])
        tips = np.tensordot(self.plane, ends_all, 2)
        out[d] = np.einsum("nd,nds->ns", length_by[:, 1:], tips)
        rows = np.arange(N_EDGES, N)
        out[rows, rows] += length_by[:, 0]

        out[np.arange(N), np.arange(N)] -= self.soft
        return out / self.flat[:, None]


def differences(ply: Ply, rows: slice, force: Real, slopes: Real) -> tuple[Real, Real, Real]:
    """Forward differences of length (n, 3) and end slopes (n, 2, 3) by H, s1, s2; end slopes.

    One call of :func:`shape` for the point and its three neighbors.
    """
    n = force.size
    step_h, step_s = 1e-7 * np.maximum(1.0, np.abs(force)), 1e-7
    forces, ends = np.tile(force, 4), np.tile(slopes, (4, 1))
    forces[n : 2 * n] += step_h
    ends[2 * n : 3 * n, 0] += step_s
    ends[3 * n :, 1] += step_s
    length, tips = ply.shape(
        np.tile(ply.run[rows], 4),
        np.tile(ply.rise[rows], 4),
        forces,
        ends,
        np.tile(ply.held[rows], (4, 1)),
    )
    steps = np.stack([step_h, np.full(n, step_s), np.full(n, step_s)], axis=1)
    length_by = (length[n:].reshape(3, n) - length[:n]).T / steps
    tips_by = np.moveaxis(tips[n:].reshape(3, n, 2) - tips[:n], 0, -1) / steps[:, None, :]
    return length_by, tips_by, tips[:n]


def solve(ply: Ply, start: Real) -> Any:
    """SLSQP from a start; raises unless it converges."""

    def objective(v: Real) -> float:
        return float(0.5 * v[:N] @ v[:N])

    def gradient(v: Real) -> Real:
        return np.concatenate([v[:N], np.zeros(v.size - N)])

    found = minimize(
        objective,
        start,
        jac=gradient,
        method="SLSQP",
        bounds=[(1e-3, None)] * N + [(-LIMIT, LIMIT)] * 4,
        constraints={"type": "eq", "fun": ply.lengths, "jac": ply.jacobian},
        options={"ftol": 1e-9, "maxiter": 200},
    )
    if not found.success:
        raise RuntimeError(str(found.message))
    return found


def timed(at: Real, start: Real | None, one_by_one: bool = False) -> tuple[float, Any]:
    """Median time of RUNS solves (us), set-up of the ply included, and the last answer."""
    times = []
    found = None
    for _ in range(RUNS):
        begin = time.perf_counter()
        ply = Ply(at, one_by_one)
        found = solve(ply, ply.start() if start is None else start)
        times.append((time.perf_counter() - begin) * 1e6)
    return statistics.median(times), found


def main() -> None:
    """Times both and prints the JSON object."""
    first, second = positions(1), positions(2)
    ply = Ply(first)
    solve(ply, ply.start())  # everything loaded
    cold_us, cold = timed(first, None)
    warm_us, warm = timed(second, cold.x)
    cold_singly_us, _ = timed(first, None, one_by_one=True)
    warm_singly_us, _ = timed(second, cold.x, one_by_one=True)
    print(
        json.dumps(
            {
                "cold_us": round(cold_us, 1),
                "warm_us": round(warm_us, 1),
                "cold_by_catenary_us": round(cold_singly_us, 1),
                "warm_by_catenary_us": round(warm_singly_us, 1),
                "norm_H": float(np.linalg.norm(cold.x[:N])),
                "cold_iterations": int(cold.nit),
                "warm_iterations": int(warm.nit),
                "largest_length_error": float(np.max(np.abs(ply.lengths(cold.x)))),
                "warm_norm_H": float(np.linalg.norm(warm.x[:N])),
                "H_N": [float(h) for h in cold.x[:N]],
                "slopes": [float(s) for s in cold.x[N:]],
                "runs": RUNS,
            }
        )
    )


if __name__ == "__main__":
    main()
