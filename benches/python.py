"""How long Python waits: one equilibrium, many, many drapes, beside the same without Python.

The same in Rust: `equilibrium_4x2_again` and `equilibrium_4x2_cold` of `cargo bench --bench speed`.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import plydrape

ROOT = Path(__file__).resolve().parents[1]


def median(work: Callable[[], object], repeats: int, inner: int) -> float:
    """Median time of one of `inner` calls (s)."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        for _ in range(inner):
            work()
        times.append((time.perf_counter() - start) / inner)
    return statistics.median(times)


def main() -> None:
    """Prints a table."""
    scene = plydrape.Scene.read(ROOT / "examples" / "01_flat_sheared_mold" / "scene.toml")
    solver, positions = plydrape.Solver.of(scene), scene.positions[0]
    again = median(lambda: solver.solve(positions), 21, 2000)
    print(f"4 x 2 equilibrium, the same place again: {again * 1e6:.1f} us a call")

    def cold() -> None:
        solver.forget()
        solver.solve(positions)

    print(f"4 x 2 equilibrium, cold: {median(cold, 21, 1000) * 1e6:.1f} us for both calls")

    noise = np.random.default_rng(0).normal(0, 1e-3, (200_000, *positions.shape))
    rates = {}
    for threads in (1, 2):
        start = time.perf_counter()
        found = plydrape.batch.equilibria(solver, positions + noise, threads=threads)
        rates[threads] = len(found) / (time.perf_counter() - start)
        assert found.converged.all()
        print(f"batch of cold 4 x 2 equilibria, {threads} threads: {rates[threads]:.0f} a second")
    print(f"two threads do {rates[2] / rates[1] / 2:.1%} of two cores' worth")

    scenes = [scene] * 2000
    for threads in (1, 2):
        start = time.perf_counter()
        plydrape.batch.simulate(scenes, threads=threads)
        rates[threads] = len(scenes) / (time.perf_counter() - start)
        print(f"batch of drapes of the example, {threads} threads: {rates[threads]:.0f} a second")
    print(f"two threads do {rates[2] / rates[1] / 2:.1%} of two cores' worth")


if __name__ == "__main__":
    main()
