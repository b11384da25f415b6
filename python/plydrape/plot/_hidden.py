"""What of a picture the mold hides, seen from infinitely far away.

Matplotlib draws whole collections over one another. The mold is therefore drawn first and
everything else over it, without what lies behind the mold.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

PAIRS = 4_000_000
"""Pairs of points and triangles that are looked at in one go."""


def axes(elev: float, azim: float) -> NDArray[np.float64]:
    """Right, up and towards the eye (3, 3) of a view with these angles (deg)."""
    e, a = np.deg2rad(elev), np.deg2rad(azim)
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    eye = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    return np.stack([right, np.cross(eye, right), eye])


class Screen:
    """A surface of triangles that hides what is behind it."""

    def __init__(
        self,
        points: NDArray[np.float64],
        triangles: NDArray[np.int64],
        view: NDArray[np.float64],
        depth: float,
    ) -> None:
        """A surface seen along `view`; what is less than `depth` (m) behind it is seen."""
        self.view, self.depth = view, depth
        a, b, c = (points[triangles[:, k]] @ view.T for k in range(3))
        twice = _cross(b[:, :2] - a[:, :2], c[:, :2] - a[:, :2])
        seen = np.abs(twice) > 1e-9 * np.abs(twice).max(initial=1e-300)
        # a surface whose upper side is seen everywhere hides nothing that is above it
        if (twice * (np.cross(b - a, c - a) @ view[:, 2]) > 0.0).all():
            seen[:] = False
        self.corners = [corner[seen] for corner in (a, b, c)]
        self.twice = twice[seen]

    def hides(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Whether the surface hides each of the points (N, 3): (N,)."""
        out = np.zeros(len(points), dtype=bool)
        if len(self.twice) == 0:
            return out
        at = points @ self.view.T
        chunk = max(1, PAIRS // len(self.twice))
        for k in range(0, len(points), chunk):
            out[k : k + chunk] = self._hides(at[k : k + chunk])
        return out

    def _hides(self, at: NDArray[np.float64]) -> NDArray[np.bool_]:
        a, b, c = self.corners
        p = at[:, None, :2]
        # areas of the three parts of a triangle that the point sees, as shares of the whole
        first = _cross(b[:, :2] - p, c[:, :2] - p) / self.twice
        second = _cross(c[:, :2] - p, a[:, :2] - p) / self.twice
        third = 1.0 - first - second
        inside = (first >= 0.0) & (second >= 0.0) & (third >= 0.0)
        front = first * a[:, 2] + second * b[:, 2] + third * c[:, 2]
        return np.asarray((inside & (front > at[:, None, 2] + self.depth)).any(axis=1))


def _cross(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
