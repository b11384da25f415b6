"""Placement errors: every gripper stands beside where it should be, all along the motion.

Each coordinate of each gripper has one error, drawn anew for each scenario from
`numpy.random.default_rng([seed, scenario])`. They are not dimensions of the sampled cube: there
are three for every gripper, none of them stands out, and a Sobol sequence loses its balance in
hundreds of dimensions. So the few inputs of interest are spread evenly, and the many errors
are drawn plainly; a scenario's errors do not depend on how many scenarios there are.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

# Units of length that a study may write, in meters.
LENGTHS = {"": 1.0, "m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "in": 0.0254}
COLUMNS = ("placement.rms", "placement.largest")


@dataclass(frozen=True)
class Placement:
    """How grippers err.

    Attributes
    ----------
    kind
        "normal" about zero, or "uniform".
    numbers
        The deviation; or the lower and the upper end; in `unit`.
    unit
        a unit of length; empty for meters.
    axes
        The coordinates that err, such as "xyz" or "xy".

    """

    kind: str
    numbers: tuple[float, ...]
    unit: str = ""
    axes: str = "xyz"

    def errors(self, seed: int, scenario: int, grippers: int) -> np.ndarray[Any, Any]:
        """The errors of one scenario, shape (grippers, 3), in meters.

        Examples
        --------
        >>> Placement("normal", (1.0,), "mm", "xy").errors(1, 0, 8)[:, 2].any()
        np.False_

        """
        generator = np.random.default_rng([seed, scenario])
        shape = (grippers, len(self.axes))
        if self.kind == "normal":
            drawn = generator.normal(0.0, self.numbers[0], shape)
        else:
            drawn = generator.uniform(self.numbers[0], self.numbers[1], shape)
        errors = np.zeros((grippers, 3))
        errors[:, ["xyz".index(axis) for axis in self.axes]] = drawn * LENGTHS[self.unit]
        return errors

    def columns(self, errors: np.ndarray[Any, Any]) -> dict[str, float]:
        """How far the grippers are off: root mean square and largest distance, in `unit`."""
        distances = np.linalg.norm(errors, axis=1) / LENGTHS[self.unit]
        sizes = (np.sqrt(np.mean(distances**2)), distances.max())
        return {name: float(size) for name, size in zip(COLUMNS, sizes, strict=True)}
