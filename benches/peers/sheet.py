"""The peer of the sheet: the same woven ply as point masses and springs in MuJoCo.

Every crossing of two fabric lines is a body with three slide joints and the mass of its share of
the ply. What holds them together are MuJoCo's tendons:

- a *spatial* tendon along each yarn segment, of stiffness EA' · width / length;
- two spatial tendons along the diagonals of each cell, of stiffness G · d² / (2 · area), d the
  diagonal at rest. In a trellis of stiff yarns their moment is 2 G sin(γ/2) per area: within 0.3 %
  of the line G γ up to a shear angle γ of 20 deg. (They add to the tension of the yarns what G is
  to EA', which must be small.)
- *fixed* tendons, one for each of x, y and z, over three neighbours of a line: their length is the
  second difference of the line, their stiffness that of the bending rigidity.

Pinned nodes are mocap bodies, moved from outside. The mold is a plane or a sphere; nodes touch it
as small balls, in MuJoCo's soft contact with an elliptic friction cone. The steps are those of the
integrator `discrete`, implicit in position, so that the stiff yarns do not limit the time step.

    python benches/peers/sheet.py          # seconds and heights, as JSON
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]
Path = Callable[[float], Real]
"""Places (n, 3) of the pinned nodes over the time (s)."""

BALL = 1e-3
"""Radius of the ball by which a node touches the mold (m); the mold is set back by as much."""


@dataclass(frozen=True)
class Ply:
    """A rectangular ply whose lines stand at ``u`` and ``v``; node (i, j) has the number j nu + i."""

    u: Real
    v: Real
    areal_mass: float
    rigidity: tuple[float, float]
    """Bending rigidity per width D' along u and along v (N m)."""
    tension: float
    """Tension stiffness per width EA' (N/m)."""
    shear: float
    """Slope of the shear force per length over the shear angle G (N/m per rad)."""
    gravity: float = 9.8

    def places(self) -> Real:
        """Fabric coordinates (nodes, 2)."""
        v, u = np.meshgrid(self.v, self.u, indexing="ij")
        return np.stack([u.ravel(), v.ravel()], axis=1)

    def nearest(self, points: Real) -> NDArray[np.int64]:
        """Numbers of the nodes at fabric points (n, 2)."""
        return nearest(self.places(), points)


@dataclass(frozen=True)
class Plane:
    """The mold z = 0."""

    def geom(self) -> str:
        """It as MuJoCo's shape, set back by the balls of the nodes."""
        return f'type="plane" size="9 9 1" pos="0 0 {-BALL}"'


@dataclass(frozen=True)
class Sphere:
    """A ball as mold."""

    centre: tuple[float, float, float]
    radius: float

    def geom(self) -> str:
        """It as MuJoCo's shape, set back by the balls of the nodes."""
        x, y, z = self.centre
        return f'type="sphere" size="{self.radius - BALL}" pos="{x} {y} {z}"'


@dataclass(frozen=True)
class Settings:
    """How MuJoCo steps; the defaults suit steps of a ply of some kg/m² in cells of 5 to 20 mm."""

    step: float = 1e-3
    """Time step (s). The transverse stiffness of taut yarns is explicit: beyond 2 ms it rings."""
    drag: float = 20.0
    """Force of a still air per mass and speed (1/s): near the lowest frequencies of a hung cell."""
    tolerance: float = 1e-5
    """Relative residual of each step's linear system, and MuJoCo's tolerance with contact."""
    iterations: int = 2000
    """Largest number of its iterations."""
    solref: tuple[float, float] = (4e-3, 1.0)
    """Time constant (s) and damping ratio of contact."""
    impratio: float = 100.0
    """How much stiffer contact is along the mold than across: so little creeps."""


def nearest(places: Real, points: Real) -> NDArray[np.int64]:
    """Numbers of the places (nodes, 2) closest to points (n, 2)."""
    gap = np.linalg.norm(places[None] - np.asarray(points, float)[:, None], axis=2)
    return np.asarray(gap.argmin(axis=1))


def widths(lines: Real) -> Real:
    """Half the spacing to each side of every line (m)."""
    half = np.diff(lines) / 2.0
    return np.concatenate([half, [0.0]]) + np.concatenate([[0.0], half])


class Sheet:
    """A ply that hangs from its pinned nodes and falls onto a mold."""

    def __init__(
        self,
        ply: Ply,
        pinned: NDArray[np.int64],
        mold: Plane | Sphere | None = None,
        friction: float = 0.0,
        settings: Settings | None = None,
    ) -> None:
        """The ply lies flat on z = 0, its pins where they are in the fabric."""
        self.ply, self.pinned = ply, np.asarray(pinned)
        self.settings = settings or Settings()
        self._flat = np.column_stack([ply.places(), np.zeros(len(ply.u) * len(ply.v))])
        self._free = np.setdiff1d(np.arange(len(self._flat)), self.pinned)
        self.model = mujoco.MjModel.from_xml_string(self._xml(mold, friction))
        self.data = mujoco.MjData(self.model)
        self.pins = self._flat[self.pinned]

    def positions(self) -> Real:
        """Where the nodes are (nodes, 3)."""
        found = self._flat.copy()
        found[self._free] += self.data.qpos.reshape(-1, 3)
        found[self.pinned] = self.pins
        return found

    def place(self, positions: Real) -> None:
        """Puts the nodes (nodes, 3) somewhere, at rest."""
        self.data.qpos[:] = (positions - self._flat)[self._free].ravel()
        self.data.qvel[:] = 0.0
        self.hold(positions[self.pinned])

    def hold(self, pins: Real) -> None:
        """Puts the pinned nodes (n, 3) somewhere."""
        self.pins = np.array(pins)
        self.data.mocap_pos[:] = self.pins
        # The pinned part of second differences is no joint: the spring's rest length takes it.
        rest = -(self._pin_weights @ (self.pins - self._flat[self.pinned]))
        self.model.tendon_lengthspring[self._first_bend :] = rest.reshape(-1, 1)

    def follow(self, path: Path, start: float, end: float) -> None:
        """Moves the pins from one time to another (s)."""
        steps = max(1, round((end - start) / self.settings.step))
        for k in range(1, steps + 1):
            self.hold(path(start + (end - start) * k / steps))
            mujoco.mj_step(self.model, self.data)

    def settle(self, speed: float = 1e-3, longest: float = 5.0) -> bool:
        """Steps until no node is faster than ``speed`` (m/s) over 20 ms; whether that came."""
        calm = 0
        for _ in range(round(longest / self.settings.step)):
            mujoco.mj_step(self.model, self.data)
            calm = calm + 1 if np.abs(self.data.qvel).max() < speed else 0
            if calm * self.settings.step >= 0.02:
                return True
        return False

    def warnings(self) -> int:
        """How often MuJoCo has warned, of a step that was not solved to the tolerance or worse."""
        return sum(int(warning.number) for warning in self.data.warning)

    def _xml(self, mold: Plane | Sphere | None, friction: float) -> str:
        """The model, in MuJoCo's format."""
        s, free, pinned = self.settings, set(self._free.tolist()), self.pinned.tolist()
        mass = self.ply.areal_mass * np.outer(widths(self.ply.v), widths(self.ply.u)).ravel()
        ball = f'<geom size="{BALL}" contype="1" conaffinity="0"/>' if mold else ""
        bodies = []
        for node in sorted(free):
            x, y, z = self._flat[node]
            joints = "".join(
                f'<joint name="{axis}{node}" type="slide" axis="{way}"'
                f' damping="{s.drag * mass[node]}"/>'
                for axis, way in zip("xyz", ["1 0 0", "0 1 0", "0 0 1"], strict=True)
            )
            inertia = f'<inertial pos="0 0 0" mass="{mass[node]}" diaginertia="1e-9 1e-9 1e-9"/>'
            site = f'<site name="s{node}"/>'
            bodies.append(f'<body pos="{x} {y} {z}">{inertia}{joints}{site}{ball}</body>')
        for node in pinned:
            x, y, z = self._flat[node]
            bodies.append(f'<body mocap="true" pos="{x} {y} {z}"><site name="s{node}"/></body>')
        if mold:
            bodies.append(f'<geom {mold.geom()} contype="0" conaffinity="1"/>')
        return f"""<mujoco>
<compiler inertiafromgeom="false"/>
<option timestep="{s.step}" gravity="0 0 {-self.ply.gravity}" integrator="discrete"
 solver="Newton" jacobian="sparse" cone="elliptic" impratio="{s.impratio}"
 tolerance="{s.tolerance}" iterations="{s.iterations}"/>
<default><geom condim="3" friction="{friction} 0 0" solimp="0.99 0.999 0.0001"
 solref="{s.solref[0]} {s.solref[1]}"/></default>
<worldbody>{"".join(bodies)}</worldbody>
<tendon>{self._springs()}{self._bending(pinned)}</tendon>
</mujoco>"""

    def _springs(self) -> str:
        """Yarn segments and diagonals."""
        ply, nu = self.ply, len(self.ply.u)
        wide_u, wide_v = widths(ply.u), widths(ply.v)
        springs = []

        def spring(a: int, b: int, stiffness: float) -> None:
            rest = float(np.linalg.norm(self._flat[b] - self._flat[a]))
            springs.append(
                f'<spatial stiffness="{stiffness}" springlength="{rest}">'
                f'<site site="s{a}"/><site site="s{b}"/></spatial>'
            )

        for j in range(len(ply.v)):
            for i in range(nu):
                node = j * nu + i
                if i + 1 < nu:
                    spring(node, node + 1, ply.tension * wide_v[j] / (ply.u[i + 1] - ply.u[i]))
                if j + 1 < len(ply.v):
                    spring(node, node + nu, ply.tension * wide_u[i] / (ply.v[j + 1] - ply.v[j]))
                if i + 1 < nu and j + 1 < len(ply.v):
                    a, b = ply.u[i + 1] - ply.u[i], ply.v[j + 1] - ply.v[j]
                    stiffness = ply.shear * (a * a + b * b) / (2.0 * a * b)
                    spring(node, node + nu + 1, stiffness)
                    spring(node + 1, node + nu, stiffness)
        self._first_bend = len(springs)
        return "".join(springs)

    def _bending(self, pinned: list[int]) -> str:
        """Second differences along the lines: ½ D' · width · length · (curvature)² for each."""
        ply, nu = self.ply, len(self.ply.u)
        tendons, weights = [], []

        def bend(triple: list[int], before: float, after: float, rigidity: float) -> None:
            # Curvature from three points; a length in the unit of the middle spacing.
            span = (before + after) / 2.0
            terms = np.array([1.0 / before, -1.0 / before - 1.0 / after, 1.0 / after]) * span
            pull = np.zeros(len(pinned))
            joints = []
            for node, term in zip(triple, terms, strict=True):
                if node in pinned:
                    pull[pinned.index(node)] = term
                else:
                    joints.append((node, term))
            weights.append(pull)
            for axis in "xyz":
                tendons.append(
                    f'<fixed stiffness="{rigidity / span**3}" springlength="0">'
                    + "".join(f'<joint joint="{axis}{n}" coef="{c}"/>' for n, c in joints)
                    + "</fixed>"
                )

        wide_u, wide_v = widths(ply.u), widths(ply.v)
        for j in range(len(ply.v)):
            for i in range(nu):
                node = j * nu + i
                if 0 < i < nu - 1:
                    before, after = ply.u[i] - ply.u[i - 1], ply.u[i + 1] - ply.u[i]
                    bend([node - 1, node, node + 1], before, after, ply.rigidity[0] * wide_v[j])
                if 0 < j < len(ply.v) - 1:
                    before, after = ply.v[j] - ply.v[j - 1], ply.v[j + 1] - ply.v[j]
                    bend([node - nu, node, node + nu], before, after, ply.rigidity[1] * wide_u[i])
        self._pin_weights = np.array(weights)
        return "".join(tendons)


NU, NV, CELL, SPACING, HEIGHT = 4, 2, 0.1, 0.098, 0.075
"""The paper's grippers: counts, fabric between them, places at the start (m)."""

GRIPPERS = np.array([(i * CELL, j * CELL) for j in range(NV) for i in range(NU)])
"""Fabric points of the grippers (8, 2)."""

START = np.column_stack([GRIPPERS * (SPACING / CELL), np.full(NU * NV, HEIGHT)])


def parallelogram(shear: float) -> Real:
    """The paper's target: grippers on z = 0, sheared by an angle (rad)."""
    u, v = GRIPPERS.T
    return np.column_stack([u + v * np.sin(shear), v * np.cos(shear), np.zeros(len(u))])


def hanging(spacing: int, mass: float, shear: float, settings: Settings | None = None) -> Sheet:
    """The paper's ply in its start, at rest; ``spacing``: segments a cell, ``mass``: kg/m².

    D' and EA' are those of the paper's lines over 100 mm for 3.143 kg/m², and in proportion.
    """
    u, v = (np.linspace(0.0, n * CELL, n * spacing + 1) for n in (NU - 1, NV - 1))
    scale = mass / 3.143
    ply = Ply(u, v, mass, (9e-5 * scale, 9e-5 * scale), 1e6 * scale, shear)
    sheet = Sheet(ply, ply.nearest(GRIPPERS), settings=settings)
    sheet.place(bellied(ply))
    sheet.settle()
    return sheet


def bellied(ply: Ply) -> Real:
    """A first shape for the start: every cell sags by a tenth."""
    u, v = ply.places().T
    sag = 0.1 * CELL * (np.abs(np.sin(np.pi * u / CELL)) + np.abs(np.sin(np.pi * v / CELL)))
    return np.column_stack([u * SPACING / CELL, v * SPACING / CELL, HEIGHT - sag])
