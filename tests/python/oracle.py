"""The ply's equilibrium, solved a second time: an independent reference for the Rust engine.

States the whole nonlinear program of Krogh et al. 2018, eq. (5), in its full space of horizontal
forces H and shared slopes s:

    minimize 1/2 |H|^2   subject to   L_i(H_i, slopes) = L_set,i (1 + H_i sec(theta_i) / EA),
                                      |s_j| <= tan(max_tilt)

with free slopes on the ply's free boundary, one slope for colinear edges on both sides of a
gripper, the slopes of diagonals from the plane through their cell's edges, shear kinematics and
slopes that shearing cells constrain. Nothing is eliminated: the engine may reduce the problem,
this does not.

Solver: SciPy's SLSQP with exact first derivatives (complex steps through the span), from the
feasible point that hangs every span at the slopes of its chords. Forces are scaled by that point's,
lengths by their derivatives there. SLSQP stops when its merit function no longer moves, which
leaves errors up to 1e-6 in flat directions (asked for more it runs in place); so the point is
polished by Newton's method on the KKT system of the active set SLSQP found, second derivatives by
central differences of the exact gradients. Differences only steer Newton: the residual it drives to
zero is exact. Slopes that would leave their bounds join the active set, bounds with a multiplier of
the wrong sign leave it. Ipopt was the other choice; it would want the two forms of the span
rewritten in its symbols, and its answer would have to be polished as well, as its interior point
stays off the active bounds.

The moment-balance rule is a square system: lengths of the edges, and EI z'' equal on both sides of
each shared slope that is not at its limit; Newton with exact derivatives, then the diagonals.

SI units: m, N, N m^2; slopes are rise over run.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from oracle_span import Mask, Real, Spans, buckling_number, excess, force_for, response
from scipy.optimize import minimize

Index = NDArray[np.intp]
Gripper = tuple[int, int]

EDGE_U, EDGE_V, RISING, FALLING = "u", "v", "rising", "falling"


@dataclass(frozen=True)
class Problem:
    """A hanging ply between nu x nv held grippers.

    ``positions``: (nv, nu, 3) (m). ``cell``: fabric lengths a along u, b along v (m). ``mass``
    (kg/m), ``rigidity`` EI (N m^2), ``axial_stiffness`` EA (N, may be infinite), ``gravity``
    (m/s^2), ``max_tilt`` (rad), ``rule``: "min-force" or "moment-balance". ``constrained``: whether
    shearing cells constrain slopes, fully from the shear angle ``onset`` (rad) on.
    """

    positions: Real
    cell: tuple[float, float] = (0.1, 0.1)
    mass: float = 0.3143
    rigidity: float = 9e-6
    axial_stiffness: float = 1e5
    gravity: float = 9.8
    max_tilt: float = float(np.radians(40.0))
    rule: str = "min-force"
    constrained: bool = True
    onset: float = float(np.radians(3.0))

    @property
    def size(self) -> tuple[int, int]:
        """Grippers along u and v."""
        return int(self.positions.shape[1]), int(self.positions.shape[0])


@dataclass(frozen=True)
class Catenary:
    """One line of fabric: its family, its grippers (i, j) and its fabric length (m)."""

    direction: str
    ends: tuple[Gripper, Gripper]
    length: float
    shearing: bool = False


@dataclass
class Net:
    """Catenaries and what determines each slope.

    ``catenaries``: edges along u, along v, then two diagonals a cell, i running fastest.
    ``shared``: (gripper, line) of each unknown slope. ``planes``: at each gripper that shearing
    cells constrain the gradient (dz/dx, dz/dy) of their mean plane and its weight.
    ``run``, ``rise``: (n, ) (m). ``horizontal``: unit vectors from first to second end (n, 2).
    ``hanging``: which catenaries have an unknown force.
    """

    catenaries: list[Catenary]
    shared: list[tuple[Gripper, str]]
    planes: dict[Gripper, tuple[Real, float]]
    run: Real
    rise: Real
    horizontal: Real
    hanging: Mask
    edge_of: dict[tuple[Gripper, Gripper], int] = field(default_factory=dict)

    @property
    def edges(self) -> int:
        """Number of edges; they come first."""
        return sum(c.direction in (EDGE_U, EDGE_V) for c in self.catenaries)


def build(problem: Problem) -> Net:
    """The net of a problem: shear kinematics, then the three slope rules and governed slopes."""
    nu, nv = problem.size
    a, b = problem.cell
    at = problem.positions

    def step(g: Gripper, h: Gripper) -> Real:
        return np.asarray(at[h[1], h[0]] - at[g[1], g[0]])

    lines: list[Catenary] = []
    for j in range(nv):
        lines += [Catenary(EDGE_U, ((i, j), (i + 1, j)), a) for i in range(nu - 1)]
    for j in range(nv - 1):
        lines += [Catenary(EDGE_V, ((i, j), (i, j + 1)), b) for i in range(nu)]
    flat = float(np.hypot(a, b))
    for j in range(nv - 1):
        for i in range(nu - 1):
            rising: tuple[Gripper, Gripper] = ((i, j), (i + 1, j + 1))
            falling: tuple[Gripper, Gripper] = ((i + 1, j), (i, j + 1))
            taut = [float(np.linalg.norm(step(*ends))) for ends in (rising, falling)]
            longer = int(np.argmax(taut))
            lengths, shears = [flat, flat], [False, False]
            if taut[longer] > flat:
                shears[longer] = True
                lengths[1 - longer] = float(np.sqrt(2.0 * flat**2 - taut[longer] ** 2))
            lines += [
                Catenary(RISING, rising, lengths[0], shears[0]),
                Catenary(FALLING, falling, lengths[1], shears[1]),
            ]

    steps = np.array([step(*line.ends) for line in lines])
    run, rise = np.hypot(steps[:, 0], steps[:, 1]), steps[:, 2]

    planes = constraints(problem, lines, steps) if problem.constrained else {}
    shared = [
        ((i, j), name)
        for name, axis, count in ((EDGE_U, 0, nu), (EDGE_V, 1, nv))
        for j in range(nv)
        for i in range(nu)
        if 0 < (i, j)[axis] < count - 1 and (i, j) not in planes
    ]
    chord = np.hypot(run, rise)
    length = np.array([line.length for line in lines])
    # Without constraints a stretched diagonal hangs on, overstretched, so that the slopes of least
    # force do not jump as it becomes taut.
    hanging = np.array([not (line.shearing and problem.constrained) for line in lines])
    if np.isinf(problem.axial_stiffness):
        hanging &= chord < length
    horizontal = steps[:, :2] / run[:, None]
    net = Net(lines, shared, planes, run, rise, horizontal, hanging)
    net.edge_of = {line.ends: index for index, line in enumerate(lines)}
    return net


def constraints(
    problem: Problem, lines: list[Catenary], steps: Real
) -> dict[Gripper, tuple[Real, float]]:
    """The plane that shearing cells prescribe at each gripper, as its gradient, and its weight.

    A shearing cell is a taut sheet. Its plane z = gradient . (x, y) contains the shearing diagonal
    and is parallel to the other one: two linear equations. At a gripper several planes are averaged
    as unit normals (-dz/dx, -dz/dy, 1)/|...|, each with a weight that grows from 0 at the onset of
    shear to 1 at the shear angle ``onset``; what is left of the unconstrained slope is the product
    of what each plane leaves.
    """
    a, b = problem.cell
    found: dict[Gripper, list[tuple[Real, float]]] = {}
    for n, line in enumerate(lines):
        if not line.shearing:
            continue
        other = n + 1 if line.direction == RISING else n - 1
        ways = np.stack([steps[n], steps[other]])
        gradient = np.linalg.solve(ways[:, :2], ways[:, 2])
        normal = np.append(-gradient, 1.0)
        normal /= np.linalg.norm(normal)
        # Law of cosines: the sides a, b meet at a right angle plus the shear angle.
        d = float(np.linalg.norm(steps[n]))
        shear = float(np.arccos((a * a + b * b - d * d) / (2.0 * a * b))) - np.pi / 2.0
        share = min(shear / problem.onset, 1.0)
        weight = 3.0 * share**2 - 2.0 * share**3
        for gripper in line.ends:
            found.setdefault(gripper, []).append((normal, weight))
    out = {}
    for gripper, planes in found.items():
        mean = np.sum([w * normal for normal, w in planes], axis=0)
        left = float(np.prod([1.0 - w for _, w in planes]))
        out[gripper] = (-mean[:2] / mean[2], 1.0 - left)
    return out


@dataclass
class State:
    """Lengths, slopes and moments of the whole ply at one point (H, s), and their derivatives.

    Variables: the forces of the hanging catenaries in order, then the shared slopes; m in all.
    ``gap``: (hanging,) arc length less the length to reach (m); ``gap_by``: (hanging, m).
    ``slopes``: (n, 2) end slopes of every catenary. ``jump``: (shared,) moment before less moment
    behind each shared slope (N m); ``jump_by``: (shared, m).
    """

    gap: Real
    gap_by: Real
    slopes: Real
    jump: Real
    jump_by: Real


class Model:
    """Evaluates a problem's constraints at a point (H, s)."""

    def __init__(self, problem: Problem) -> None:
        """Builds the net and its spans."""
        self.problem = problem
        self.net = build(problem)
        net = self.net
        self.rows: Index = np.flatnonzero(net.hanging)
        self.forces = int(self.rows.size)
        self.variables = self.forces + len(net.shared)
        self.column = {int(row): index for index, row in enumerate(self.rows)}
        self.shared = {key: self.forces + n for n, key in enumerate(net.shared)}
        self.length = np.array([line.length for line in net.catenaries])
        self.chord = np.hypot(net.run, net.rise)
        self.bound = float(np.tan(problem.max_tilt))
        self.constrained = self.constrained_ends()
        prescribed = np.zeros((len(net.catenaries), 2), bool)
        for index, line in enumerate(net.catenaries):
            for end, gripper in enumerate(line.ends):
                key = (gripper, line.direction)
                prescribed[index, end] = (
                    index >= net.edges or key in self.shared or (index, end) in self.constrained
                )
        weight = problem.mass * problem.gravity
        n = len(net.catenaries)
        self.spans = Spans(
            net.run,
            net.rise,
            weight * self.chord / net.run,
            np.full(n, problem.rigidity),
            prescribed,
        )
        # The hanging branch of each span ends at the first buckling load of its end conditions.
        euler = [buckling_number(bool(first), bool(second)) for first, second in prescribed]
        self.lowest = np.array(euler) * problem.rigidity / net.run**2
        # Length to reach: L (1 + H sec / EA).
        self.softness = self.length * self.spans.secant / problem.axial_stiffness
        diagonals = range(net.edges, n)
        self.planes = {(row, end): self.plane(row, end) for row in diagonals for end in (0, 1)}

    def constrained_ends(self) -> dict[tuple[int, int], float]:
        """Slope of each end of an edge that shearing cells constrain: (edge, end).

        The vertical plane through the edge cuts the cells' plane along the edge's horizontal
        direction. At the onset of shear it is mixed with the edge's slope in the ply without
        constraints.
        """
        net = self.net
        free = None
        if any(0.0 < weight < 1.0 for _, weight in net.planes.values()):
            free = unconstrained(self.problem)
        out = {}
        for index, line in enumerate(net.catenaries[: net.edges]):
            for end, gripper in enumerate(line.ends):
                if gripper in net.planes:
                    gradient, weight = net.planes[gripper]
                    slope = float(gradient @ net.horizontal[index])
                    if weight < 1.0 and free is not None:
                        slope = (1.0 - weight) * float(free[index, end]) + weight * slope
                    out[index, end] = slope
        return out

    def edge_slopes(self, s: Real) -> Real:
        """Prescribed slopes of all catenaries (n, 2) for shared slopes s; 0 where none is known."""
        out = np.zeros((len(self.net.catenaries), 2))
        for index, line in enumerate(self.net.catenaries[: self.net.edges]):
            for end, gripper in enumerate(line.ends):
                key = (gripper, line.direction)
                if key in self.shared:
                    out[index, end] = s[self.shared[key] - self.forces]
                elif (index, end) in self.constrained:
                    out[index, end] = self.constrained[index, end]
        return out

    def plane(self, diagonal: int, end: int) -> list[tuple[int, int, float]]:
        """The edges of a diagonal's cell at one of its grippers: (edge, its end, weight).

        The slope of the plane through both edge slopes, along the diagonal, is their weighted sum:
        the diagonal's horizontal direction is that combination of the edges' directions.
        """
        line = self.net.catenaries[diagonal]
        here, there = line.ends[end], line.ends[1 - end]
        out: list[tuple[int, int]] = []
        for corner in ((there[0], here[1]), (here[0], there[1])):
            ends = (here, corner) if here < corner else (corner, here)
            out.append((self.net.edge_of[ends], 0 if ends[0] == here else 1))
        directions = np.stack([self.net.horizontal[edge] for edge, _ in out], axis=1)
        weights = np.linalg.solve(directions, self.net.horizontal[diagonal])
        return [(edge, tip, float(w)) for (edge, tip), w in zip(out, weights, strict=True)]

    def evaluate(self, x: Real, diagonals: bool = True) -> State:
        """The state at forces and shared slopes ``x``, shape (variables,)."""
        net, edges = self.net, self.net.edges
        forces = np.ones(len(net.catenaries))
        forces[self.rows] = x[: self.forces]
        slopes = self.edge_slopes(x[self.forces :])
        slopes_by = np.zeros((*slopes.shape, self.variables))
        gap = np.zeros(len(net.catenaries))
        gap_by = np.zeros((len(net.catenaries), self.variables))
        bends, bends_by = np.zeros_like(slopes), np.zeros_like(slopes_by)

        for index, line in enumerate(net.catenaries[:edges]):
            for end, gripper in enumerate(line.ends):
                if (gripper, line.direction) in self.shared:
                    slopes_by[index, end, self.shared[gripper, line.direction]] = 1.0
        straight = [r for r in range(edges) if not net.hanging[r]]
        for row in straight:  # taut and inextensible: its free ends have the chord's slope
            for end in (0, 1):
                if not self.spans.prescribed[row, end]:
                    slopes[row, end] = net.rise[row] / net.run[row]

        def absorb(rows: Index) -> None:
            r = response(self.spans.take(rows), forces[rows], slopes[rows])
            incoming = slopes_by[rows].copy()
            for n, row in enumerate(rows):
                column = self.column[int(row)]

                def chain(by: Real, n: int = n, column: int = column) -> Real:
                    out: Real = by[..., 1:] @ incoming[n]
                    out[..., column] += by[..., 0]
                    return out

                gap[row] = r.excess[n] + self.chord[row] - self.length[row]
                gap[row] -= self.softness[row] * forces[row]
                gap_by[row] = chain(r.excess_by[n])
                gap_by[row, column] -= self.softness[row]
                bends[row], bends_by[row] = r.curvatures[n], chain(r.curvatures_by[n])
                slopes[row], slopes_by[row] = r.slopes[n], chain(r.slopes_by[n])

        absorb(self.rows[self.rows < edges])
        if diagonals:
            for row in range(edges, len(net.catenaries)):
                if not net.hanging[row]:
                    slopes[row] = net.rise[row] / net.run[row]
                    continue
                for end in (0, 1):
                    parts = self.planes[row, end]
                    slopes[row, end] = sum(w * slopes[e, tip] for e, tip, w in parts)
                    slopes_by[row, end] = sum(
                        (w * slopes_by[e, tip] for e, tip, w in parts), np.zeros(self.variables)
                    )
            hanging = self.rows[self.rows >= edges]
            if hanging.size:
                absorb(hanging)

        rigidity = self.problem.rigidity
        jump, jump_by = np.zeros(len(net.shared)), np.zeros((len(net.shared), self.variables))
        for n, (gripper, name) in enumerate(net.shared):
            i, j = gripper
            before = ((i - 1, j), gripper) if name == EDGE_U else ((i, j - 1), gripper)
            behind = (gripper, (i + 1, j)) if name == EDGE_U else (gripper, (i, j + 1))
            left, right = net.edge_of[before], net.edge_of[behind]
            jump[n] = rigidity * (bends[left, 1] - bends[right, 0])
            jump_by[n] = rigidity * (bends_by[left, 1] - bends_by[right, 0])
        return State(gap[self.rows], gap_by[self.rows], slopes, jump, jump_by)

    def hang(self, s: Real) -> Real:
        """The forces (hanging,) of all catenaries for given shared slopes: scalar roots."""
        slopes = self.edge_slopes(s)
        forces = np.zeros(self.forces)
        for n, row in enumerate(self.rows):
            one = self.spans.take(np.array([row]))
            for end in (0, 1):
                if row >= self.net.edges:
                    parts = self.planes[int(row), end]
                    slopes[row, end] = sum(w * slopes[e, tip] for e, tip, w in parts)
            args = (one, slopes[row : row + 1], float(self.length[row]))
            forces[n] = force_for(*args, self.problem.axial_stiffness)
            slopes[row] = np.real(excess(one, forces[n : n + 1], slopes[row : row + 1])[1][0])
        return forces

    def chord_slopes(self) -> Real:
        """Mean chord slope of the edges around each shared slope, kept inside its bounds."""
        out: list[float] = []
        for (i, j), name in self.net.shared:
            di, dj = (1, 0) if name == EDGE_U else (0, 1)
            pair = [((i - di, j - dj), (i, j)), ((i, j), (i + di, j + dj))]
            rows = [self.net.edge_of[ends] for ends in pair]
            out.append(float(np.mean(self.net.rise[rows] / self.net.run[rows])))
        inside: Real = np.clip(np.array(out), -0.95 * self.bound, 0.95 * self.bound)
        return inside


_UNCONSTRAINED: dict[str, Real] = {}


def unconstrained(problem: Problem) -> Real:
    """Slopes of all catenaries where shearing cells constrain none, solved once per run."""
    key = f"{problem} {problem.positions.tobytes().hex()}"
    if key not in _UNCONSTRAINED:
        _UNCONSTRAINED[key] = solve(replace(problem, constrained=False)).slopes
    return _UNCONSTRAINED[key]


@dataclass(frozen=True)
class Solution:
    """Forces (N, NaN where the model gives none) and end slopes of all catenaries.

    ``forces``: (n,), ``slopes``: (n, 2), in the order of ``net.catenaries``. ``shared``: (k,) the
    unknown slopes, ``active``: (k,) which are at their limit. ``residual``: scaled KKT or balance
    residual. ``curvature``: smallest eigenvalue of the objective's second derivative along the
    constraints (positive: a strict minimum); NaN for moment-balance and without free slopes.
    ``above_buckling``: (n,) H less the first buckling load (N), positive on the hanging branch.
    """

    net: Net
    forces: Real
    slopes: Real
    shared: Real
    active: Mask
    residual: float
    curvature: float
    multipliers: Real
    above_buckling: Real

    @property
    def sound(self) -> bool:
        """A strict minimum (or a balance) to rounding, on the hanging branch of every span."""
        on_branch = np.all(self.above_buckling[~np.isnan(self.forces)] > 0.0)
        return bool(on_branch and self.residual < 1e-9 and not self.curvature <= 0.0)


def solve(problem: Problem, start: Real | None = None) -> Solution:
    """The equilibrium of a problem by its own slope rule, from shared slopes ``start`` if given.

    A start that leads nowhere is replaced by random slopes, the same in every run: with stiff plies
    in compression SLSQP may run into the end of a hanging branch, where lengths are singular.
    """
    model = Model(problem)
    rng = np.random.default_rng(0)
    s = model.chord_slopes() if start is None else start
    for _ in range(20):
        rule = balance if problem.rule == "moment-balance" else least_force
        try:
            found = rule(model, s)
        except (RuntimeError, np.linalg.LinAlgError):
            found = None
        if found is not None and found.sound:
            return found
        s = rng.uniform(-0.6, 0.6, s.size) * model.bound
    raise RuntimeError("no start led to an equilibrium")


def finish(
    model: Model, x: Real, active: Mask, residual: float, curvature: float, multipliers: Real
) -> Solution:
    """Packs a solved point."""
    forces = np.full(len(model.net.catenaries), np.nan)
    forces[model.rows] = x[: model.forces]
    slopes = model.evaluate(x).slopes
    s = x[model.forces :]
    above = forces - model.lowest
    return Solution(model.net, forces, slopes, s, active, residual, curvature, multipliers, above)


# --- min-force ---------------------------------------------------------------------------------


@dataclass
class Scaled:
    """The program in scaled variables y = x / unit; constraints about as steep as the forces."""

    model: Model
    unit: Real
    steep: Real
    size: float
    last: tuple[bytes, tuple[Real, Real]] = (b"", (np.zeros(0), np.zeros(0)))

    @classmethod
    def around(cls, model: Model, x: Real) -> Scaled:
        """Scaled at a feasible point."""
        n = model.forces
        typical = np.maximum(np.abs(x[:n]), 1e-3 * float(np.max(np.abs(x[:n]), initial=1e-12)))
        unit = np.concatenate([typical, np.ones(model.variables - n)])
        by = np.diagonal(model.evaluate(x).gap_by[:, :n])
        return cls(model, unit, 1.0 / np.abs(by * typical), float(np.sum(typical**2)))

    def objective(self, y: Real) -> float:
        """Half the square of the forces' norm, scaled."""
        h = (y * self.unit)[: self.model.forces]
        return float(0.5 * h @ h / self.size)

    def gradient(self, y: Real) -> Real:
        """Derivative of :meth:`objective`."""
        out = np.zeros_like(y)
        n = self.model.forces
        out[:n] = y[:n] * self.unit[:n] ** 2 / self.size
        return out

    def constraints(self, y: Real) -> tuple[Real, Real]:
        """Scaled length gaps and their derivative; SLSQP asks for each, one after the other."""
        if self.last[0] != y.tobytes():
            state = self.model.evaluate(y * self.unit)
            found = state.gap * self.steep, state.gap_by * self.steep[:, None] * self.unit
            self.last = y.tobytes(), found
        return self.last[1]

    def kkt(self, y: Real, multipliers: Real) -> Real:
        """Derivative of the Lagrangian, then the constraints."""
        c, by = self.constraints(y)
        return np.concatenate([self.gradient(y) + by.T @ multipliers, c])


def least_force(model: Model, s: Real) -> Solution:
    """min-force: SLSQP on the full space, then Newton on the KKT system."""
    x = np.concatenate([model.hang(s), s])
    n, bound = model.forces, model.bound
    if model.variables == n:  # no unknown slope: the feasible point is the only one
        scaled = Scaled.around(model, x)
        residual = float(np.max(np.abs(scaled.constraints(x / scaled.unit)[0])))
        return finish(model, x, np.zeros(0, bool), residual, np.nan, np.zeros(0))
    scaled = Scaled.around(model, x)
    y = x / scaled.unit
    answer = minimize(
        scaled.objective,
        y,
        jac=scaled.gradient,
        method="SLSQP",
        bounds=[(low, np.inf) for low in model.lowest[model.rows] / scaled.unit[:n]]
        + [(-bound, bound)] * (model.variables - n),
        constraints={
            "type": "eq",
            "fun": lambda p: scaled.constraints(p)[0],
            "jac": lambda p: scaled.constraints(p)[1],
        },
        options={"ftol": 1e-10, "maxiter": 100},
    )
    return settle(scaled, np.asarray(answer.x, float))


def refine(problem: Problem, forces: Real, shared: Real) -> Solution:
    """The min-force equilibrium next to a given point: forces (hanging,), shared slopes (k,)."""
    model = Model(problem)
    x = np.concatenate([forces, shared])
    scaled = Scaled.around(model, x)
    return settle(scaled, x / scaled.unit)


def settle(scaled: Scaled, y: Real) -> Solution:
    """Polishes a point near the answer, with the active set it shows, corrected as needed."""
    model = scaled.model
    n, bound = model.forces, model.bound
    slope = np.arange(n, model.variables)
    active = np.abs(np.abs(y[slope]) - bound) < 1e-9

    for _ in range(20):
        y[slope[active]] = np.sign(y[slope[active]]) * bound
        free = np.concatenate([np.arange(n), slope[~active]])
        y, multipliers, hessian, residual = polish(scaled, y, free)
        outside = np.abs(y[slope]) > bound * (1.0 + 1e-12)
        pull = scaled.kkt(y, multipliers)[slope] * np.sign(y[slope])
        wrong = active & (pull > 1e-9)  # the objective would fall inward: let go
        if not outside.any() and not wrong.any():
            break
        y[slope] = np.clip(y[slope], -bound, bound)
        active = (active | outside) & ~wrong
    else:
        raise RuntimeError("no active set of slope bounds satisfies the KKT conditions")
    _, by = scaled.constraints(y)
    _, _, rows = np.linalg.svd(by[:, free])
    null = rows[by.shape[0] :].T
    curvature = float(np.min(np.linalg.eigvalsh(null.T @ hessian @ null), initial=np.inf))
    gradient = scaled.kkt(y, multipliers)[slope]
    return finish(
        model, y * scaled.unit, active, residual, curvature, np.where(active, gradient, 0.0)
    )


def polish(scaled: Scaled, y: Real, free: Index) -> tuple[Real, Real, Real, float]:
    """Newton on the KKT system over the ``free`` variables.

    Returns the point, the multipliers, the Lagrangian's Hessian over ``free`` and the residual.
    """
    by = scaled.constraints(y)[1]
    rows = by.shape[0]
    fit = np.linalg.lstsq(by[:, free].T, -scaled.gradient(y)[free], rcond=None)[0]
    multipliers = np.asarray(fit, np.float64)
    pick = np.concatenate([free, y.size + np.arange(rows)])
    hessian = np.zeros((free.size, free.size))
    best, history = np.inf, (y, multipliers)
    for turn in range(12):
        residual = scaled.kkt(y, multipliers)[pick]
        norm = float(np.max(np.abs(residual)))
        if norm < 0.5 * best:
            best, history = norm, (y.copy(), multipliers.copy())
        # it has converged, or it has left: a scaled residual is about 1 far from any answer
        if turn > 0 and (best < 1e-11 or norm > 1e4):
            break
        _, by = scaled.constraints(y)
        for column, variable in enumerate(free):
            step = np.zeros_like(y)
            step[variable] = 1e-5
            ahead, behind = scaled.kkt(y + step, multipliers), scaled.kkt(y - step, multipliers)
            hessian[:, column] = (ahead - behind)[free] / 2e-5
        matrix = np.block([[hessian, by[:, free].T], [by[:, free], np.zeros((rows, rows))]])
        update: Real = np.linalg.solve(matrix, -residual)
        y = y.copy()
        y[free] += update[: free.size]
        multipliers = multipliers + update[free.size :]
    y, multipliers = history
    return y, multipliers, (hessian + hessian.T) / 2.0, best


# --- moment-balance ----------------------------------------------------------------------------


def balance(model: Model, s: Real) -> Solution:
    """moment-balance: lengths and continuous moments of the edges, by Newton; then diagonals."""
    n, bound = model.forces, model.bound
    edges = int(np.sum(model.rows < model.net.edges))
    x = np.concatenate([model.hang(s), s])
    slope = np.arange(n, model.variables)
    active = np.zeros(slope.size, bool)

    def system(x: Real) -> tuple[Real, Real, State]:
        state = model.evaluate(x, diagonals=False)
        free = np.concatenate([np.arange(edges), slope[~active]])
        value = np.concatenate([state.gap[:edges], state.jump[~active]])
        by = np.concatenate([state.gap_by[:edges], state.jump_by[~active]])[:, free]
        scale = 1.0 / np.max(np.abs(by), axis=1)
        return value * scale, by * scale[:, None], state

    residual = np.inf
    for _ in range(20):
        free = np.concatenate([np.arange(edges), slope[~active]])
        residual = newton(system, x, free, hang=lambda p: refit(model, p, edges))
        state = system(x)[2]
        outside = np.abs(x[slope]) > bound * (1.0 + 1e-12)
        # The energy's derivative with respect to a slope is the jump; at a limit it points outward.
        wrong = active & (state.jump * np.sign(x[slope]) > 0.0)
        if not outside.any() and not wrong.any():
            break
        x[slope] = np.clip(x[slope], -bound, bound)
        active = (active | outside) & ~wrong
        x[slope[active]] = np.sign(x[slope[active]]) * bound
        x[:n] = model.hang(x[slope])
    else:
        raise RuntimeError("no active set of slope bounds balances the moments")
    x[edges:n] = model.hang(x[slope])[edges:]
    return finish(model, x, active, residual, np.nan, np.where(active, state.jump, 0.0))


def refit(model: Model, x: Real, edges: int) -> None:
    """Hangs every edge anew at the slopes of ``x``."""
    x[:edges] = model.hang(x[model.forces :])[:edges]


def newton(
    system: Callable[[Real], tuple[Real, Real, State]],
    x: Real,
    free: Index,
    hang: Callable[[Real], None],
) -> float:
    """Newton in place over ``free``; the slopes step, the forces are hung anew while far away."""
    best, kept = np.inf, x.copy()
    for _ in range(40):
        value, by, _ = system(x)
        norm = float(np.max(np.abs(value), initial=0.0))
        if norm < 0.5 * best:
            best, kept = norm, x.copy()
        elif best < 1e-12:
            break
        update = np.linalg.solve(by, -value)
        x[free] += update
        if np.max(np.abs(update), initial=0.0) > 1e-3:
            hang(x)
    x[:] = kept
    return best
