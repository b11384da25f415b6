"""One span of ply, solved a second time: an independent reference for the Rust engine.

Solves ``H z'' - EI z'''' = q`` over a horizontal run, each end with a free slope (``z'' = 0``) or a
prescribed one, after Krogh et al. 2018, eq. (2). Written from the equation alone; two routes that
share nothing with each other nor with the engine's series:

* **Beam-column superposition** (``k run >= 10``). With the moment ``M = EI z''`` the equation is
  ``M'' - k^2 M = -q``, whose solution for given end moments is two scaled hyperbolic sines and a
  constant; twice integrated it gives ``H y = M(x) - M_1 (1-x/l) - M_2 x/l - q x (l-x)/2`` for the
  height y above the chord. Prescribed slopes are two linear equations for the end moments. Only
  decaying exponentials occur.
* **Legendre-Galerkin** (everything else, any sign of H). The weak form
  ``EI (y'', v'') + H (y', v') = -q (1, v)`` in the span of the double integrals of the Legendre
  polynomials; the end slopes are the first two coefficients and free slopes are natural boundary
  conditions. Convergence is faster than exponential: 40 functions reach rounding up to
  ``k run = 12``. The smallest eigenvalue of the same matrices is the first buckling load, where
  the hanging branch ends.

``EI = 0`` is the parabola; it takes no prescribed slopes.

All functions work on n spans at once and on complex input, so that derivatives come from complex
steps, exact to rounding. SI units throughout: m, N, N m^2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.optimize import brentq

Real = NDArray[np.float64]
Mask = NDArray[np.bool_]
Array = NDArray[np.float64] | NDArray[np.complex128]

FUNCTIONS = 40
LAYERED_FROM = 10.0
STEP = 1e-40


@dataclass(frozen=True)
class Spans:
    """n spans and what holds their ends.

    ``run``, ``rise`` (m), ``load`` = m g sec(theta) (N/m of run), ``rigidity`` EI (N m^2): (n,).
    ``prescribed``: shape (n, 2), true where the slope of that end is prescribed.
    """

    run: Real
    rise: Real
    load: Real
    rigidity: Real
    prescribed: Mask

    def take(self, rows: NDArray[np.intp]) -> Spans:
        """The spans at ``rows``."""
        return Spans(
            self.run[rows],
            self.rise[rows],
            self.load[rows],
            self.rigidity[rows],
            self.prescribed[rows],
        )

    @property
    def chord(self) -> Real:
        """Distance of the ends (m), shape (n,)."""
        return np.hypot(self.run, self.rise)

    @property
    def secant(self) -> Real:
        """sec(theta) = chord / run, shape (n,)."""
        return self.chord / self.run


def spans(
    run: float,
    rise: float,
    weight: float,
    rigidity: float,
    slopes: tuple[float | None, float | None],
) -> tuple[Spans, Real]:
    """One span as a batch of one, and its end slopes, shape (1, 2); None is a free slope."""
    secant = float(np.hypot(run, rise)) / run
    held = np.array([[slope is not None for slope in slopes]])
    values = np.array([[0.0 if slope is None else slope for slope in slopes]])
    one = Spans(
        np.array([run]), np.array([rise]), np.array([weight * secant]), np.array([rigidity]), held
    )
    return one, values


# --- Legendre-Galerkin -------------------------------------------------------------------------


@dataclass(frozen=True)
class Basis:
    """Functions on t in [-1, 1] that vanish at both ends.

    Function 0 has slope 1 at t = -1 and 0 at t = 1, function 1 the reverse, all others have none.
    ``curvature``, ``slope``, ``height``: Legendre coefficients, one function a row.
    ``bending``, ``tension``: the Gram matrices of curvature and slope. ``integral``: of the height.
    """

    curvature: Real
    slope: Real
    height: Real
    bending: Real
    tension: Real
    integral: Real


@lru_cache(maxsize=1)
def basis() -> Basis:
    """The Galerkin basis: double integrals of Legendre polynomials."""
    n = FUNCTIONS
    curvature = np.zeros((n, n + 3))
    slope = np.zeros((n, n + 3))
    height = np.zeros((n, n + 3))
    for row in range(n):
        curvature[row, row] = 1.0
        # d/dt (P_{m+1} - P_{m-1}) = (2m+1) P_m; the two lowest are made to vanish at both ends.
        if row == 0:
            slope[row, 1] = 1.0
            height[row, [0, 2]] = -1.0 / 3.0, 1.0 / 3.0
        elif row == 1:
            slope[row, 2] = 1.0 / 3.0
            height[row, [1, 3]] = -1.0 / 15.0, 1.0 / 15.0
        else:
            slope[row, [row + 1, row - 1]] = 1.0 / (2 * row + 1), -1.0 / (2 * row + 1)
            up, down = 1.0 / (2 * row + 3), 1.0 / (2 * row - 1)
            height[row, [row + 2, row, row - 2]] = np.array([up, -up - down, down]) / (2 * row + 1)
    nodal = np.eye(n)
    nodal[:2, :2] = [[-0.5, 1.5], [0.5, 1.5]]
    curvature, slope, height = nodal @ curvature, nodal @ slope, nodal @ height
    weights = 2.0 / (2.0 * np.arange(n + 3) + 1.0)
    return Basis(
        curvature,
        slope,
        height,
        (curvature * weights) @ curvature.T,
        (slope * weights) @ slope.T,
        2.0 * height[:, 0],
    )


@lru_cache(maxsize=4)
def buckling_number(first_held: bool, second_held: bool) -> float:
    """H run^2 / EI of the first buckling load (negative) of these end conditions."""
    b = basis()
    free = [
        index
        for index in range(FUNCTIONS)
        if (not first_held, not second_held, True)[min(index, 2)]
    ]
    bending, tension = b.bending[np.ix_(free, free)], b.tension[np.ix_(free, free)]
    # Largest eigenvalue of (tension, bending): the well-conditioned way round.
    largest = eigh(tension, bending, eigvals_only=True)[-1]
    return float(-4.0 / largest)


def galerkin(s: Spans, force: Array, slopes: Array) -> Array:
    """Coefficients of the height above the chord, shape (n, FUNCTIONS) (m)."""
    b = basis()
    half = s.run / 2.0
    kappa = force * s.run**2 / s.rigidity
    matrix: NDArray[Any] = b.bending + (kappa / 4.0)[:, None, None] * b.tension
    right = -(s.load / s.rigidity * half**4)[:, None] * b.integral
    held = (slopes - (s.rise / s.run)[:, None]) * half[:, None]
    right = right.astype(np.result_type(matrix, held))
    for end in (0, 1):
        rows = np.flatnonzero(s.prescribed[:, end])
        matrix[rows, end, :] = 0.0
        matrix[rows, end, end] = 1.0
        right[rows, end] = held[rows, end]
    out: Array = np.linalg.solve(matrix, right[..., None])[..., 0]
    return out


# --- Beam-column superposition -----------------------------------------------------------------


def end_moments(s: Spans, force: Array, slopes: Array) -> tuple[Array, Array, Array]:
    """k (1/m) and both end moments less the membrane moment Q = q EI / H (N m), shape (n,) each."""
    k = np.sqrt(force / s.rigidity)
    membrane = s.load * s.rigidity / force
    p = np.exp(-k * s.run)
    c, d = (1.0 + p * p) / (1.0 - p * p), 2.0 * p / (1.0 - p * p)
    turn = force[:, None] * (slopes - (s.rise / s.run)[:, None])
    inverse = 1.0 / s.run
    # Free end: M = 0. Prescribed end: H (z' - h/l) in terms of both moments.
    shape = (s.run.size,)
    one = np.ones(shape)
    held_1, held_2 = s.prescribed[:, 0], s.prescribed[:, 1]
    a11 = np.where(held_1, inverse - k * c, one)
    a12 = np.where(held_1, k * d - inverse, 0.0)
    a21 = np.where(held_2, inverse - k * d, 0.0)
    a22 = np.where(held_2, k * c - inverse, one)
    r1 = np.where(held_1, turn[:, 0] + s.load * s.run / 2.0, -membrane)
    r2 = np.where(held_2, turn[:, 1] - s.load * s.run / 2.0, -membrane)
    determinant = a11 * a22 - a12 * a21
    return k, (r1 * a22 - a12 * r2) / determinant, (a11 * r2 - a21 * r1) / determinant


# --- Both together -----------------------------------------------------------------------------


@dataclass(frozen=True)
class Shape:
    """Solved spans at their stations.

    ``height``: z above the chord (m), ``turn``: z' less the chord's slope, shape (n, m).
    ``slopes``: z' at both ends, ``curvatures``: z'' at both ends (1/m), shape (n, 2).
    """

    height: Array
    turn: Array
    slopes: Array
    curvatures: Array


def layered(s: Spans, force: Array) -> Mask:
    """Where the superposition of exponentials is the better route, shape (n,)."""
    kappa = np.zeros(s.run.shape)
    stiff = s.rigidity > 0.0
    kappa[stiff] = np.real(force)[stiff] * s.run[stiff] ** 2 / s.rigidity[stiff]
    return np.asarray(stiff & (kappa >= LAYERED_FROM**2))


def solve(s: Spans, force: Array, slopes: Array, share: Real, route: str = "best") -> Shape:
    """The shape for given horizontal forces (N, shape (n,)) and end slopes (shape (n, 2)).

    ``share``: stations as shares x / run, shape (n, m). Slopes of free ends are ignored.
    ``route`` = "galerkin" or "layered" forces one of the two routes.
    """
    kind = np.result_type(force, slopes)
    n, m = share.shape
    height, turn = np.zeros((n, m), kind), np.zeros((n, m), kind)
    ends, bends = np.zeros((n, 2), kind), np.zeros((n, 2), kind)

    by_layers = layered(s, force) if route == "best" else np.full(n, route == "layered")
    limp = np.flatnonzero(s.rigidity == 0.0)
    thick = np.flatnonzero(~by_layers & (s.rigidity > 0.0))
    thin = np.flatnonzero(by_layers & (s.rigidity > 0.0))

    if limp.size:
        g, h, t = s.take(limp), force[limp], share[limp]
        unit = (g.load * g.run / h)[:, None]
        turn[limp] = unit * (t - 0.5)
        height[limp] = -unit * g.run[:, None] * t * (1.0 - t) / 2.0
        ends[limp] = (g.rise / g.run)[:, None] + unit * np.array([-0.5, 0.5])
        bends[limp] = (g.load / h)[:, None]
    if thick.size:
        g, b = s.take(thick), basis()
        c = galerkin(g, force[thick], slopes[thick])
        t = 2.0 * share[thick] - 1.0
        half = (g.run / 2.0)[:, None]
        # one table where all spans have the same stations, as in every quadrature of the length
        table = legendre.legvander(t[:1] if (t == t[0]).all() else t, FUNCTIONS + 2)
        height[thick] = (table @ (c @ b.height)[:, :, None])[:, :, 0]
        turn[thick] = (table @ (c @ b.slope)[:, :, None])[:, :, 0] / half
        ends[thick] = (g.rise / g.run)[:, None] + c[:, :2] / half
        signs = (-1.0) ** np.arange(FUNCTIONS + 3)
        modes = c @ b.curvature
        bends[thick] = np.stack([modes @ signs, modes.sum(axis=1)], axis=1) / half**2
    if thin.size:
        g, h, t = s.take(thin), force[thin], share[thin]
        k, m1, m2 = end_moments(g, h, slopes[thin])
        membrane = g.load * g.rigidity / h
        k_, m1_, m2_, h_ = k[:, None], m1[:, None], m2[:, None], h[:, None]
        run, load = g.run[:, None], g.load[:, None]
        p = np.exp(-k_ * run)
        x = t * run

        def at(x: Real) -> tuple[Array, Array]:
            """Moment less Q, and its derivative."""
            first, second = np.exp(-k_ * x), np.exp(-k_ * (run - x))
            q = 1.0 - p * p
            moment = (m1_ * (first - p * second) + m2_ * (second - p * first)) / q
            shear = k_ * (m2_ * (second + p * first) - m1_ * (first + p * second)) / q
            return moment, shear

        moment, shear = at(x)
        # The constant Q of the moments cancels against the chord through them.
        height[thin] = (moment - m1_ * (1.0 - t) - m2_ * t - load * x * (run - x) / 2.0) / h_
        turn[thin] = (load * (x - run / 2.0) + shear + (m1_ - m2_) / run) / h_
        edge = np.concatenate([np.zeros_like(run), run], axis=1)
        outer = (load * (edge - run / 2.0) + at(edge)[1] + (m1_ - m2_) / run) / h_
        ends[thin] = (g.rise / g.run)[:, None] + outer
        bends[thin] = (np.stack([m1, m2], axis=1) + membrane[:, None]) / g.rigidity[:, None]
    ends = np.where(s.prescribed & (s.rigidity > 0.0)[:, None], slopes, ends)
    return Shape(height, turn, ends, bends)


# --- Arc length --------------------------------------------------------------------------------

LAYER_PANELS = np.array([0.0, 0.5, 1.0, 2.0, 3.0, 4.5, 6.5, 9.0, 13.0, 20.0, 40.0])


@lru_cache(maxsize=4)
def gauss(points: int) -> tuple[Real, Real]:
    """Nodes and weights of Gauss-Legendre on [-1, 1]."""
    return legendre.leggauss(points)


def quadrature(s: Spans, force: Array, points: int = 10) -> tuple[Real, Real]:
    """Shares x / run and weights of Gauss-Legendre panels that resolve the end layers, (n, m)."""
    n = s.run.size
    node, weight = gauss(points)
    k = np.zeros(n)
    thin = layered(s, force)
    k[thin] = np.sqrt(np.real(force)[thin] / s.rigidity[thin]) * s.run[thin]
    layer = np.full((n, LAYER_PANELS.size), 0.25)
    layer[~thin] = np.linspace(0.0, 0.25, LAYER_PANELS.size)
    layer[thin] = np.minimum(LAYER_PANELS / k[thin][:, None], 0.25)
    # From the end of the layer to mid-span, four panels.
    inner = layer[:, -1:] + (0.5 - layer[:, -1:]) * np.linspace(0.0, 1.0, 5)[1:]
    left = np.concatenate([layer, inner], axis=1)
    edges = np.concatenate([left, 1.0 - left[:, -2::-1]], axis=1)
    width = np.diff(edges, axis=1)[:, :, None]
    middle = (edges[:, 1:, None] + edges[:, :-1, None]) / 2.0
    return (
        (middle + width / 2.0 * node).reshape(n, -1),
        (width / 2.0 * weight).reshape(n, -1),
    )


def excess(s: Spans, force: Array, slopes: Array, points: int = 10) -> tuple[Array, Array, Array]:
    """Arc length less chord (m, shape (n,)), end slopes and end curvatures (1/m), shape (n, 2).

    The difference is integrated itself, without cancellation: with T the chord's slope and
    tau = z' - T, whose integral vanishes, S = sqrt(1+T^2), R = sqrt(1+z'^2), the integrand
    R - S - T tau / S equals tau^2 (S R - T (T+tau) + 1) / (S (R+S)^2).
    """
    share, weight = quadrature(s, force, points)
    shape = solve(s, force, slopes, share)
    tangent = (s.rise / s.run)[:, None]
    secant = s.secant[:, None]
    tau = shape.turn
    root = np.sqrt(1.0 + (tangent + tau) ** 2)
    top = secant * root - tangent * (tangent + tau) + 1.0
    value = tau**2 * top / (secant * (root + secant) ** 2)
    return (value * weight).sum(axis=1) * s.run, shape.slopes, shape.curvatures


@dataclass(frozen=True)
class Response:
    """Excess length, end slopes and end curvatures of n spans and their exact derivatives.

    ``excess`` (n,), ``slopes`` and ``curvatures`` (n, 2); the ``_by`` fields add a last axis of 3:
    derivatives with respect to H, first and second end slope.
    """

    excess: Real
    slopes: Real
    curvatures: Real
    excess_by: Real
    slopes_by: Real
    curvatures_by: Real


def response(s: Spans, force: Real, slopes: Real) -> Response:
    """Values and complex-step derivatives of :func:`excess`."""
    n = s.run.size
    rows = np.tile(np.arange(n), 3)
    forces, ends = force[rows].astype(complex), slopes[rows].astype(complex)
    forces[:n] += 1j * STEP
    ends[n : 2 * n, 0] += 1j * STEP
    ends[2 * n :, 1] += 1j * STEP
    e, t, c = excess(s.take(rows), forces, ends)
    by = [np.moveaxis(np.imag(a).reshape(3, n, *a.shape[1:]), 0, -1) / STEP for a in (e, t, c)]
    return Response(np.real(e[:n]), np.real(t[:n]), np.real(c[:n]), by[0], by[1], by[2])


# --- The force that gives a length -------------------------------------------------------------


def force_for(s: Spans, slopes: Real, length: float, axial_stiffness: float = np.inf) -> float:
    """H (N) of one span so that its arc length is ``length (1 + H sec / EA)``.

    Bracketed on the hanging branch, from the first buckling load of its end conditions to
    infinity, in the logarithm of the distance to that load, where both limits are smooth. With
    EA = inf a chord as long as the fabric has no force: ValueError.
    """
    slack = length - float(s.chord[0])
    soft = length * float(s.secant[0]) / axial_stiffness
    if axial_stiffness == np.inf and slack <= 0.0:
        raise ValueError(
            f"chord {float(s.chord[0])} m, fabric {length} m: straight, without a force"
        )
    lowest = 0.0
    if s.rigidity[0] > 0.0:
        ends = bool(s.prescribed[0, 0]), bool(s.prescribed[0, 1])
        lowest = buckling_number(*ends) * float(s.rigidity[0] / s.run[0] ** 2)

    def surplus(w: float) -> float:
        force = lowest + float(np.exp(w))
        value = float(np.real(excess(s, np.array([force]), slopes)[0][0]))
        return value - (slack + soft * force)

    start = float(np.sqrt(s.load[0] ** 2 * s.run[0] ** 3 / (24.0 * max(slack, 1e-9 * length))))
    low = high = float(np.log(start))
    while surplus(low) < 0.0:
        low -= 1.0
    while surplus(high) > 0.0:
        high += 1.0
    if low == high:
        return lowest + float(np.exp(low))
    return lowest + float(np.exp(brentq(surplus, low, high, xtol=1e-15, rtol=1e-15)))


def stations(s: Spans, force: float, slopes: Real, count: int = 11) -> tuple[Real, Real]:
    """x and z (m) at ``count`` equally spaced stations of one span, from its first end."""
    share = np.linspace(0.0, 1.0, count)[None, :]
    height = np.real(solve(s, np.array([force]), slopes, share).height[0])
    return share[0] * s.run[0], share[0] * s.rise[0] + height


def sag(s: Spans, force: float, slopes: Real) -> float:
    """Largest vertical distance below the chord (m) of one span."""
    center, width = 0.5, 0.5
    best = 0.0
    for _ in range(12):  # each pass narrows the window around the deepest of 201 stations tenfold
        share = np.clip(np.linspace(center - width, center + width, 201), 0.0, 1.0)[None, :]
        depth = -np.real(solve(s, np.array([force]), slopes, share).height[0])
        deepest = int(np.argmax(depth))
        best = max(best, float(depth[deepest]))
        center, width = float(share[0, deepest]), width / 10.0
    return best
