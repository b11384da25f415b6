"""The peer of the sheet: the same woven ply as point masses and springs in MuJoCo.

Every crossing of two fabric lines is a body with three slide joints and the mass of its share of
the ply. What holds them together are MuJoCo's tendons:

- a *spatial* tendon along each yarn segment, of stiffness EA' · width / length;
- two spatial tendons along the diagonals of each cell, of stiffness G · d² / (2 · area), d the
  diagonal at rest. In a trellis of stiff yarns, sheared by an angle g, their moment per area is
  2 G sin(g/2): within 0.6 % of G g up to 20 deg. (They add to the tension of the yarns what G is to
  EA', which must be small.)
- *fixed* tendons, one for each of x, y and z, over three neighbors of a line: their length is the
  second difference of the line, their stiffness that of the bending rigidity.

Pinned nodes are mocap bodies, moved from outside. The mold is a plane or a sphere; nodes touch it
as small balls, in MuJoCo's soft contact. Friction is its elliptic cone. To stick without a cap is
no large coefficient there, because a node that slips in MuJoCo's convex cone is lifted by it: a tie
along the mold, an equality of two fixed tendons, holds while the node touches. The steps are those
of the integrator `discrete`, implicit in position, so that stiff yarns do not limit them.

    python benches/peers/sheet.py          # seconds on one core and heights, as JSON
"""

from __future__ import annotations

import json
import time
from dataclasses import dataclass
from itertools import pairwise

import mujoco
import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]

BALL = 1e-3
"""Radius of the ball by which a node touches the mold (m); the mold is set back by as much."""


@dataclass(frozen=True)
class Ply:
    """A rectangular ply with lines at ``u`` and ``v``; node (i, j) has the number j nu + i."""

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

    def height(self, positions: Real) -> tuple[Real, Real]:
        """Heights (n,) over the mold of places (n, 3), and unit normals (n, 3)."""
        return positions[:, 2], np.tile([0.0, 0.0, 1.0], (len(positions), 1))


@dataclass(frozen=True)
class Sphere:
    """A ball as mold."""

    center: tuple[float, float, float]
    radius: float

    def geom(self) -> str:
        """It as MuJoCo's shape, set back by the balls of the nodes."""
        x, y, z = self.center
        return f'type="sphere" size="{self.radius - BALL}" pos="{x} {y} {z}"'

    def height(self, positions: Real) -> tuple[Real, Real]:
        """Heights (n,) over the mold of places (n, 3), and unit normals (n, 3)."""
        way = positions - np.array(self.center)
        distance = np.linalg.norm(way, axis=1)
        return np.asarray(distance - self.radius), way / distance[:, None]


@dataclass(frozen=True)
class Settings:
    """How MuJoCo steps; the defaults suit steps of a ply of some kg/m² in cells of 5 to 20 mm."""

    step: float = 1e-3
    """Time step (s). The transverse stiffness of taut yarns is explicit: beyond 2 ms it rings."""
    drag: float = 10.0
    """Force of a still air per mass and speed (1/s): near the lowest frequencies of a hung cell."""
    tolerance: float = 1e-4
    """Relative residual of each step's linear system, and MuJoCo's tolerance with contact."""
    iterations: int = 2000
    """Largest number of its iterations."""
    solref: tuple[float, float] = (4e-3, 1.0)
    """Time constant (s) and damping ratio of contact."""
    impratio: float = 100.0
    """How much stiffer a friction cone is along the mold than across: so little creeps."""
    margin: float = 0.7
    """Share of the longest stable step that taut yarns allow."""
    clear: float = 5e-5
    """Height over the mold from which a node that stuck is free again (m)."""


def nearest(places: Real, points: Real) -> NDArray[np.int64]:
    """Numbers of the places (nodes, 2) closest to points (n, 2)."""
    gap = np.linalg.norm(places[None] - np.asarray(points, float)[:, None], axis=2)
    return np.asarray(gap.argmin(axis=1))


def widths(lines: Real) -> Real:
    """Half the spacing to each side of every line (m)."""
    half = np.diff(lines) / 2.0
    return np.asarray(np.concatenate([half, [0.0]]) + np.concatenate([[0.0], half]))


class Sheet:
    """A ply that hangs from its pinned nodes and falls onto a mold."""

    def __init__(
        self,
        ply: Ply,
        pinned: NDArray[np.int64],
        mold: Plane | Sphere | None = None,
        friction: float | None = None,
        settings: Settings | None = None,
    ) -> None:
        """The ply lies flat on z = 0, its pins where they are in the fabric.

        Without a ``friction`` coefficient what touches the mold sticks.
        """
        self.ply, self.pinned, self.mold = ply, np.asarray(pinned), mold
        self.sticks = mold is not None and friction is None
        self.settings = settings or Settings()
        self._flat = np.column_stack([ply.places(), np.zeros(len(ply.u) * len(ply.v))])
        self._free = np.setdiff1d(np.arange(len(self._flat)), self.pinned)
        self.model = mujoco.MjModel.from_xml_string(self._xml(mold, friction))
        self.data = mujoco.MjData(self.model)
        self._rest = self.model.tendon_lengthspring[: self._first_bend, 0].copy()
        self._lightest = float(self.model.body_mass[self.model.body_mass > 0.0].min())
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
        self.model.tendon_lengthspring[self._first_bend : self._first_hold] = rest.reshape(-1, 1)

    def step(self) -> None:
        """One time step, no longer than the tension of the yarns allows."""
        self.model.opt.timestep = min(self.settings.step, self._stable())
        mujoco.mj_step(self.model, self.data)
        if self.sticks:
            self._stick()

    def _stable(self) -> float:
        """Longest step (s): taut yarns hold a node across with 4 T / l each way, explicitly."""
        stretch = self.data.ten_length[: self._first_bend] - self._rest
        taut = float((self.model.tendon_stiffness[: self._first_bend] * stretch / self._rest).max())
        if self.data.time == 0.0 or taut <= 0.0:
            return self.settings.step
        return self.settings.margin * float(np.sqrt(self._lightest / (2.0 * taut)))

    def _stick(self) -> None:
        """Holds along the mold every free node that touches it, until it is clear again."""
        assert self.mold is not None
        active = self.data.eq_active.reshape(-1, 2)
        found = self.positions()[self._free]
        height, normal = self.mold.height(found)
        active[(height > self.settings.clear) & (active[:, 0] == 1)] = 0
        for k in np.flatnonzero((height <= 0.0) & (active[:, 0] == 0)):
            # Two tangents, as coefficients of the three joints of a fixed tendon each.
            first = np.cross([0.0, 1.0, 0.0], normal[k])
            first /= np.linalg.norm(first)
            tangents = np.array([first, np.cross(normal[k], first)])
            at = self.model.tendon_adr[self._first_hold + 2 * k]
            self.model.wrap_prm[at : at + 6] = tangents.ravel()
            shift = found[k] - self._flat[self._free[k]]
            self.model.eq_data[2 * k : 2 * k + 2, 0] = tangents @ shift
            active[k] = 1

    def follow(self, before: Real, after: Real, seconds: float) -> None:
        """Moves the pins straight from places (n, 3) to others."""
        began = self.data.time
        while (now := (self.data.time - began) / seconds) < 1.0:
            self.hold(before + (after - before) * now)
            self.step()
        self.hold(after)

    def settle(self, speed: float = 2e-3, longest: float = 5.0) -> bool:
        """Steps until no node is faster than ``speed`` (m/s) over 20 ms; whether that came."""
        end = self.data.time + longest
        restless = self.data.time
        while self.data.time < end:
            self.step()
            if np.abs(self.data.qvel).max() >= speed:
                restless = self.data.time
            if self.data.time - restless >= 0.02:
                return True
        return False

    def warnings(self) -> int:
        """How often MuJoCo has warned, of a step that was not solved to the tolerance or worse."""
        return sum(int(warning.number) for warning in self.data.warning)

    def _xml(self, mold: Plane | Sphere | None, friction: float | None) -> str:
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
        soft = f'solref="{s.solref[0]} {s.solref[1]}" solimp="0.99 0.999 0.0001"'
        ties = "".join(
            f'<tendon tendon1="t{node}{way}" active="false"/>'
            for node in (self._free if self.sticks else [])
            for way in "uv"
        )
        return f"""<mujoco>
<compiler inertiafromgeom="false"/>
<option timestep="{s.step}" gravity="0 0 {-self.ply.gravity}" integrator="discrete"
 solver="Newton" jacobian="sparse" cone="elliptic" impratio="{s.impratio}"
 tolerance="{s.tolerance}" iterations="{s.iterations}"/>
<default><geom condim="{3 if friction else 1}" friction="{friction or 0.0} 0 0" {soft}/>
<equality {soft}/></default>
<worldbody>{"".join(bodies)}</worldbody>
<tendon>{self._springs()}{self._bending(pinned)}{self._holds()}</tendon>
<equality>{ties}</equality>
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

    def _holds(self) -> str:
        """Two tendons for each free node, along the mold: ties while it sticks."""
        return "".join(
            f'<fixed name="t{node}{way}">'
            + "".join(f'<joint joint="{axis}{node}" coef="1"/>' for axis in "xyz")
            + "</fixed>"
            for node in (self._free if self.sticks else [])
            for way in "uv"
        )

    def _bending(self, pinned: list[int]) -> str:
        """Second differences along the lines: ½ D' · width · length · (curvature)² for each."""
        ply, nu = self.ply, len(self.ply.u)
        tendons, weights = [], []

        def bend(triple: list[int], before: float, after: float, rigidity: float) -> None:
            # Curvature from three points; a length in the unit of the middle spacing.
            span = (before + after) / 2.0
            weight = np.array([1.0 / before, -1.0 / before - 1.0 / after, 1.0 / after]) * span
            pull = np.zeros(len(pinned))
            joints = []
            for node, term in zip(triple, weight, strict=True):
                if node in pinned:
                    pull[pinned.index(node)] = term
                else:
                    joints.append((node, term))
            weights.append(pull)
            for axis in "xyz":
                terms = "".join(f'<joint joint="{axis}{n}" coef="{c}"/>' for n, c in joints)
                stiffness = rigidity / span**3
                tendons.append(f'<fixed stiffness="{stiffness}" springlength="0">{terms}</fixed>')

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
        self._first_hold = self._first_bend + len(tendons)
        return "".join(tendons)


def drape(
    ply: Ply,
    grippers: Real,
    places: Real,
    mold: Plane | Sphere | None = None,
    friction: float | None = None,
    seconds: float = 3.0,
    settings: Settings | None = None,
) -> Real:
    """Where the nodes are in every step (steps, nodes, 3), at rest in the first and the last one.

    Each gripper pins the node nearest to its fabric point, ``grippers`` (n, 2), and moves straight
    from step to step through its ``places`` (steps, n, 3), which takes ``seconds`` in all.
    """
    sheet = Sheet(ply, ply.nearest(grippers), mold, friction, settings)
    sheet.place(sagging(ply, grippers, places[0]))
    sheet.settle()
    states = [sheet.positions()]
    for before, after in pairwise(places):
        sheet.follow(before, after, seconds / (len(places) - 1))
        states.append(sheet.positions())
    if len(places) > 1:
        sheet.settle(longest=0.1)
        states[-1] = sheet.positions()
    return np.array(states)


def sagging(ply: Ply, grippers: Real, places: Real) -> Real:
    """A first shape (nodes, 3): the grippers' places as a map of the fabric, lower between them."""
    basis = np.column_stack([grippers, np.ones(len(grippers))])
    affine = np.linalg.lstsq(basis, places, rcond=None)[0]
    fabric = ply.places()
    shape = np.column_stack([fabric, np.ones(len(fabric))]) @ affine
    away = np.linalg.norm(fabric[:, None] - grippers[None], axis=2).min(axis=1)
    shape[:, 2] -= 0.2 * away
    nodes = ply.nearest(grippers)
    shape[nodes] = places
    return np.asarray(shape)


NU, NV, CELL, SPACING, HEIGHT = 4, 2, 0.1, 0.098, 0.075
"""The paper's grippers: counts, fabric between them, distance and height at the start (m)."""

GRIPPERS = np.array([(i * CELL, j * CELL) for j in range(NV) for i in range(NU)])
"""Fabric points of the grippers (8, 2)."""

START = np.column_stack([GRIPPERS * (SPACING / CELL), np.full(NU * NV, HEIGHT)])
"""Their places in the first step (8, 3)."""


def paper_ply(segments: int, mass: float, shear: float) -> Ply:
    """The paper's ply with some segments a cell, its mass (kg/m²) and shear slope (N/m per rad).

    3.143 kg/m² are the paper's lines over their 100 mm; bending and tension go with the mass.
    """
    u, v = (np.linspace(0.0, n * CELL, n * segments + 1) for n in (NU - 1, NV - 1))
    share = mass / 3.143
    return Ply(u, v, mass, (9e-5 * share, 9e-5 * share), 1e6 * share, shear)


def straight(steps: int = 30, shear_deg: float = 20.0) -> Real:
    """The paper's straight paths (steps, 8, 3), onto a parallelogram on z = 0."""
    u, v = GRIPPERS.T
    shear = np.radians(shear_deg)
    end = np.column_stack([u + v * np.sin(shear), v * np.cos(shear), np.zeros(len(u))])
    return np.asarray(START + (end - START) * np.linspace(0.0, 1.0, steps)[:, None, None])


def main() -> None:
    """Hangs and drapes the paper's ply at the meshes of the tables, and prints what that takes."""
    report = {}
    for name, ply, places in [
        ("hanging, 8.3 mm", paper_ply(12, 0.3143, 2.0), START[None]),
        ("straight path, 10 mm", paper_ply(10, 3.143, 5.0), straight()),
    ]:
        began = time.process_time()
        states = drape(ply, GRIPPERS, places, Plane() if len(places) > 1 else None)
        height = states[-1, :, 2] * 1e3
        report[name] = {
            "nodes": len(height),
            "seconds": round(time.process_time() - began, 1),
            "height_min_mm": round(float(height.min()), 3),
            "height_max_mm": round(float(height.max()), 3),
            "height_rms_mm": round(float(np.sqrt(np.mean(height**2))), 3),
        }
    print(json.dumps(report, indent=2))


if __name__ == "__main__":
    main()
