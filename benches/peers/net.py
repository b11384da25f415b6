"""The peer of the net: the hemisphere of Krogh et al. 2021, as one would drape it in SciPy.

A pin-jointed net of straight bars on the unit sphere z = sqrt(1 - x^2 - y^2), as published with
KinDrape: cells along the four generator arms are placed one by one, each by SLSQP over the plan
positions of its two new nodes, so that the sum of its four corners' shear angles is least while its
bars keep their length; every other node is the root of two length conditions in its plan position.

Prints one JSON object: the median time of a net (ms), the largest and the mean shear of its cells
(degrees; a cell's shear is the mean of its four corners), the largest error of a bar (m), and some
nodes (m). A file as argument receives all nodes.

    OPENBLAS_NUM_THREADS=1 python benches/peers/net.py [nodes.csv]
"""

from __future__ import annotations

import json
import math
import statistics
import sys
import time

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize, root

Real = NDArray[np.float64]
Index = tuple[int, int]

NU, NV = 24, 24
MESH = 0.075
SEED: Index = (11, 11)
START = (-MESH / 2.0, -MESH / 2.0)
RUNS = 5

# Right, up, left, down: where each arm grows, and on which side its cells' known edge ends.
AHEAD: list[Index] = [(1, 0), (0, 1), (-1, 0), (0, -1)]
ASIDE: list[Index] = [(0, 1), (-1, 0), (0, -1), (1, 0)]


def on_sphere(x: float, y: float) -> tuple[float, float, float]:
    """The point of the sphere over (x, y)."""
    return (x, y, math.sqrt(max(1.0 - x * x - y * y, 0.0)))


def corners(a: Real, b: Real, c: Real, d: Real) -> list[float]:
    """Shear of the four corners of the cell a, b, c, d (rad): how far each is from 90 degrees."""
    ring = [a, b, c, d]
    shear = []
    for n in range(4):
        u, v = ring[(n + 1) % 4] - ring[n], ring[n - 1] - ring[n]
        cosine = float(u @ v) / math.sqrt(float(u @ u) * float(v @ v))
        shear.append(abs(math.acos(max(-1.0, min(1.0, cosine))) - math.pi / 2.0))
    return shear


def bar(a: Real, b: Real) -> float:
    """Length of a bar less what it should be (m)."""
    return math.dist(a, b) - MESH


def generator_cell(known: tuple[Real, Real], guess: Real) -> tuple[Real, Real, Real]:
    """The two new nodes of an arm's cell, beside both known ones, and the steps to them."""
    first, second = known

    def place(steps: Real) -> tuple[Real, Real]:
        near = np.array(on_sphere(first[0] + steps[0], first[1] + steps[1]))
        far = np.array(on_sphere(second[0] + steps[2], second[1] + steps[3]))
        return near, far

    def shear(steps: Real) -> float:
        near, far = place(steps)
        return sum(corners(first, second, far, near))

    def bars(steps: Real) -> Real:
        near, far = place(steps)
        return np.array([bar(first, near), bar(near, far), bar(far, second)])

    found = minimize(
        shear,
        guess,
        method="SLSQP",
        constraints={"type": "eq", "fun": bars},
        options={"ftol": 5e-9, "maxiter": 100},
    )
    near, far = place(found.x)
    return near, far, found.x


def free_node(inner: Real, a: Real, b: Real) -> Real:
    """The node a bar away from both a and b, on the other side of them than ``inner``."""

    def bars(plan: Real) -> list[float]:
        p = np.array(on_sphere(plan[0], plan[1]))
        return [bar(a, p), bar(b, p)]

    found = root(bars, (a + b - inner)[:2], tol=1e-14)
    return np.array(on_sphere(found.x[0], found.x[1]))


def net() -> Real:
    """All nodes (nu, nv, 3)."""
    x = np.full((NU, NV, 3), np.nan)
    x[SEED] = on_sphere(*START)
    # the seed's first bar, in the vertical plane along v, as the public code has it
    i, j = SEED
    up = root(lambda s: [bar(x[SEED], np.array(on_sphere(START[0], START[1] + s[0])))], [MESH])
    x[i, j + 1] = on_sphere(START[0], START[1] + up.x[0])

    starts: list[Index] = [(i, j), (i + 1, j + 1), (i, j + 1), (i, j)]
    counts = [NU - 1 - i, NV - 2 - j, i, j]
    for arm in range(4):
        (p, q), (au, av), (su, sv) = starts[arm], AHEAD[arm], ASIDE[arm]
        guess = 0.75 * MESH * np.array([au, av, au, av], float)
        for _ in range(counts[arm]):
            known = (x[p, q], x[p + su, q + sv])
            near, far, guess = generator_cell(known, guess)
            x[p + au, q + av], x[p + au + su, q + av + sv] = near, far
            p, q = p + au, q + av

    for su in (1, -1):
        for sv in (1, -1):
            for q in range(j + sv, NV if sv > 0 else -1, sv):
                for p in range(i + su, NU if su > 0 else -1, su):
                    if np.isnan(x[p, q, 0]):
                        x[p, q] = free_node(x[p - su, q - sv], x[p - su, q], x[p, q - sv])
    return x


def cell_shear(x: Real) -> Real:
    """Mean shear of each cell's corners (nu - 1, nv - 1), rad."""
    return np.array(
        [
            [
                np.mean(corners(x[i, j], x[i + 1, j], x[i + 1, j + 1], x[i, j + 1]))
                for j in range(NV - 1)
            ]
            for i in range(NU - 1)
        ]
    )


def main() -> None:
    """Times the net and prints the JSON object."""
    times = []
    for _ in range(RUNS):
        begin = time.perf_counter()
        x = net()
        times.append((time.perf_counter() - begin) * 1e3)
    shear = np.degrees(cell_shear(x))
    bars = [np.linalg.norm(np.diff(x, axis=axis), axis=2) for axis in (0, 1)]
    print(
        json.dumps(
            {
                "net_ms": round(statistics.median(times), 1),
                "largest_shear_deg": float(shear.max()),
                "mean_shear_deg": float(shear.mean()),
                "largest_bar_error": float(max(np.abs(b - MESH).max() for b in bars)),
                "corner_node": x[0, 0].tolist(),
                "runs": RUNS,
            }
        )
    )
    if len(sys.argv) > 1:
        np.savetxt(sys.argv[1], x.reshape(-1, 3), fmt="%.17g", delimiter=",")


if __name__ == "__main__":
    main()
