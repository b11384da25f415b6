"""The flexural rigidity of a strip of ply from points of its shape.

A strip hangs over three grippers, the middle one raised: so close together that its shape tells how
stiff it is. Points of it are measured, here made up with noise. SciPy's least squares turns the
rigidity until the model's strip goes through them, by the model's exact derivatives.

    python examples/fitting/fit_rigidity.py
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import plydrape
from numpy.typing import NDArray
from scipy.optimize import least_squares

Array = NDArray[np.float64]

CELL = 0.05
"""Fabric between neighboring grippers (m)."""
GRIPPERS = np.array([[0.0, 0.0, 0.0], [0.0475, 0.0, 0.01], [0.095, 0.0, 0.0]])
"""Where the grippers are (m)."""
MASS = 0.3143
"""Mass per length of the strip (kg/m), weighed. Shape alone tells only rigidity over weight."""
STATIONS = 25
"""Points on each span."""


def equilibrium(rigidity: float) -> plydrape.Equilibrium:
    """The strip at a flexural rigidity (N·m²)."""
    material = {"mass": MASS, "flexural_rigidity": rigidity}
    ply = plydrape.Ply(grippers=[3, 1], cell=[CELL, CELL], material=material)
    return plydrape.Solver(ply).solve(GRIPPERS)


def heights(rigidity: float) -> Array:
    """Heights of the points between the grippers (m), shape (2 · (STATIONS - 2),)."""
    return equilibrium(rigidity).points(STATIONS)[:, 1:-1, 2].ravel()


def slopes(rigidity: float) -> Array:
    """How these heights change with the rigidity (m per N·m²), the same shape."""
    jacobian = equilibrium(rigidity).jacobian(wrt="material")
    column = jacobian.names.index("flexural_rigidity")
    return jacobian.points(STATIONS)[:, 1:-1, 2, column].ravel()


@dataclass(frozen=True)
class Fit:
    """A rigidity and what it is worth."""

    rigidity: float
    """Flexural rigidity EI (N·m²)."""
    deviation: float
    """Its standard deviation (N·m²), from the scatter of the points around the fit."""
    evaluations: int
    """Equilibria that the search took."""


def fit(measured: Array, guess: float = 1e-6) -> Fit:
    """The rigidity whose strip passes closest to measured heights (m).

    The search is for the logarithm of the rigidity, which any real number may be.
    """
    found = least_squares(
        lambda log: heights(np.exp(log[0])) - measured,
        x0=[np.log(guess)],
        jac=lambda log: (slopes(np.exp(log[0])) * np.exp(log[0]))[:, None],
        bounds=np.log([1e-12, 1.0]),
        xtol=1e-12,
        ftol=1e-12,
        gtol=1e-15,
    )
    scatter = np.sum(found.fun**2) / (measured.size - 1)
    log_deviation = np.sqrt(scatter / np.sum(found.jac**2))
    rigidity = float(np.exp(found.x[0]))
    return Fit(rigidity, rigidity * float(log_deviation), int(found.nfev))


def measure(rigidity: float, noise: float, seed: int) -> Array:
    """Heights as a camera would see them, with normal errors of `noise` (m)."""
    true = heights(rigidity)
    return true + np.random.default_rng(seed).normal(0.0, noise, true.size)


def main() -> None:
    """Makes up a measurement and gets the rigidity back."""
    true, noise = 9e-6, 5e-5
    found = fit(measure(true, noise, seed=1))
    print(f"true     {true * 1e6:.3f} N·mm²")
    print(f"fitted   {found.rigidity * 1e6:.3f} ± {found.deviation * 1e6:.3f} N·mm²")
    points = 2 * (STATIONS - 2)
    print(f"from {points} points with {noise * 1e3} mm of noise")


if __name__ == "__main__":
    main()
