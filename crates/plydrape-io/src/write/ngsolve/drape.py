"""Drapes the motion of a result of plydrape in the finite element code NGSolve.

    pip install ngsolve==6.2.2608 scipy
    python drape.py                        # reads ply.json, writes drape.json

The ply is a nonlinear Koiter shell after Neunteufel and Schöberl (arXiv 2304.13806): a
displacement of second order in quads along the fibers, and moments as unknowns of their own
(elements of Hellan, Herrmann and Johnson), so that the kinks between elements bend too. The
energy per area is

    T (|a1| - 1)^2 / 2 + T (|a2| - 1)^2 / 2 + (integral of tau over gamma) + bending,

with the fiber vectors a1 and a2, the shear sin(gamma) = a1 . a2 / (|a1| |a2|), the tension
stiffness T, the shear curve tau and two flexural rigidities. The stretch of a fiber is taken at
two points of Gauss along it, which keeps thin shells from locking. T is far below that of a
yarn: 2e4 N/m, unless the export was told otherwise. Newton's method converges then, and fibers
strain by less than 0.1 % under the weight of a ply; with 1e6 N/m every turn within an iteration
makes false tension.

Gravity acts from the start, and time steps are implicit (Euler's), because the ply snaps from
fold to fold and a static solver finds no way through. Cups are springs to where the robot holds
them. The mold is a signed distance on a grid. Contact is that of plydrape's sheet: a node below
the mold is pushed back, and held along the mold where it touched until it is clear again.
Friction and tack bound that hold if the scene has them. All units are SI. There is no slip
under cups, and no tilt limit.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

import ngsolve as ng
import numpy as np
import scipy.sparse as sp
from netgen.meshing import Element1D, Element2D, FaceDescriptor, MeshPoint, Pnt
from netgen.meshing import Mesh as Netgen
from ngsolve import BilinearForm, CoefficientFunction, GridFunction, InnerProduct, Norm, grad
from scipy.interpolate import RegularGridInterpolator
from scipy.sparse.linalg import splu
from scipy.spatial.transform import Rotation, Slerp

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("--step", type=float, default=4e-3, help="time step (s)")
parser.add_argument("--hang", type=float, default=1.0, help="time before the motion (s)")
parser.add_argument("--longest", type=float, default=4.0, help="longest time of the motion (s)")
parser.add_argument("--rest", type=float, default=1.0, help="time after it (s)")
parser.add_argument("--drag", type=float, default=2.0, help="of still air, per mass (1/s)")
parser.add_argument("--twist", type=float, default=0.1, help="rigidity in twist, of the mean one")
parser.add_argument("--green", action="store_true", help="shear as 2 E12, not as the angle")
args = parser.parse_args()
home = Path(__file__).resolve().parent
ply = json.loads((home / "ply.json").read_text())
corner, quads = np.array(ply["nodes"]), np.array(ply["quads"])

# The flat ply, in fabric coordinates.
netgen = Netgen(dim=2)
netgen.Add(FaceDescriptor(surfnr=1, domin=1, bc=1))
vertex = [netgen.Add(MeshPoint(Pnt(u, v, 0.0))) for u, v in corner]
for quad in quads:
    netgen.Add(Element2D(1, [vertex[k] for k in quad]))
pairs = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
for (a, b), beside in zip(*np.unique(pairs, axis=0, return_counts=True), strict=True):
    if beside == 1:
        netgen.Add(Element1D([vertex[a], vertex[b]], index=1))
netgen.SetBCName(0, "boundary")
mesh = ng.Mesh(netgen)

# Unknowns: displacements from the flat ply, and moments that vanish across a free boundary.
scalar, linear = ng.H1(mesh, order=2), ng.H1(mesh, order=1)
space = scalar * scalar * scalar * ng.HDivDiv(mesh, order=1, dirichlet="boundary")
*u, moment = space.TrialFunction()
*du, test = space.TestFunction()
flat = [CoefficientFunction((1.0, 0.0, 0.0)), CoefficientFunction((0.0, 1.0, 0.0))]


def fibers(x: list) -> list:
    """Fiber vectors a1 and a2 of a displacement."""
    return [flat[k] + CoefficientFunction(tuple(grad(part)[k] for part in x)) for k in (0, 1)]


def gauss(along_u: int, along_v: int) -> ng.IntegrationRule:
    """Gauss's points of a quad."""
    (x, wx), (y, wy) = map(np.polynomial.legendre.leggauss, (along_u, along_v))
    places = [((1 + a) / 2, (1 + b) / 2) for a in x for b in y]
    return ng.IntegrationRule(places, [a * b / 4 for a in wx for b in wy])


# Energy of stretch and shear.
a1, a2 = fibers(u)
gamma = InnerProduct(a1, a2) if args.green else ng.asin(InnerProduct(a1, a2) / Norm(a1) / Norm(a2))
angles, forces = ply["shear"]
work = ng.BSpline(2, [angles[0], *angles], forces).Integrate()
membrane = BilinearForm(space, symmetric=True)
for energy, rule in [
    (0.5 * ply["tension"] * (Norm(a1) - 1.0) ** 2, gauss(2, 3)),
    (0.5 * ply["tension"] * (Norm(a2) - 1.0) ** 2, gauss(3, 2)),
    (work(ng.sqrt(gamma * gamma + 1e-12)), gauss(2, 2)),
]:
    term = ng.SymbolicEnergy(energy.Compile())
    term.SetIntegrationRule(ng.ET.QUAD, rule)
    membrane += term

# Bending: moments times the second derivatives along the normal, with the jumps of slope at the
# sides of elements, less the moments' own energy. The normal is that of the time step before, as a
# continuous field; the published form has that of the unknown displacement.
normal = GridFunction(linear * linear * linear)
out = ng.specialcf.normal(2)
twist = args.twist * np.sqrt(ply["rigidity"][0] * ply["rigidity"][1])


def curved(x: list, m: CoefficientFunction) -> CoefficientFunction:
    """Moments times curvatures within an element."""
    return along_normal([InnerProduct(m, part.Operator("hesse")) for part in x])


def kinked(x: list, m: CoefficientFunction) -> CoefficientFunction:
    """Moments times the slope across the side of an element, without that of the flat ply."""
    return -along_normal([grad(part) * out for part in x]) * InnerProduct(out, m * out)


def along_normal(x: list) -> CoefficientFunction:
    """The part of a vector along the normal."""
    a, b, c = (n * part for n, part in zip(normal.components, x, strict=True))
    return a + b + c


stiff = ply["rigidity"]
own = moment[0, 0] * test[0, 0] / stiff[0] + moment[1, 1] * test[1, 1] / stiff[1]
own += 2.0 * moment[0, 1] * test[0, 1] / twist
bending = BilinearForm(space, symmetric=False)
bending += ng.SymbolicBFI(curved(u, test) + curved(du, moment) - own, intrule=gauss(3, 3))
bending += ng.SymbolicBFI(kinked(u, test) + kinked(du, moment), element_boundary=True)

# Nodes of the quads: corners, middles of sides, middles. A node has the share of Simpson's rule.
local = [(a, b) for b in (0.0, 0.5, 1.0) for a in (0.0, 0.5, 1.0)]
number: dict[tuple[float, ...], int] = {}
area: list[float] = []
for quad in corner[quads]:
    low, high = quad[0], quad[2]
    for a, b in local:
        key = tuple(np.round(low + (high - low) * [a, b], 9))
        if number.setdefault(key, len(area)) == len(area):
            area.append(0.0)
        share = (4 if a == 0.5 else 1) * (4 if b == 0.5 else 1) / 36.0
        area[number[key]] += share * float(np.prod(high - low))
place, areas = np.array(list(number)), np.array(area)
nodes, size = len(place), scalar.ndof


def shapes(points: np.ndarray) -> sp.csr_matrix:
    """Values of the shape functions at fabric points (n, 2); an empty row beyond the quads."""
    rows, columns, values = [], [], []
    for row, (a, b) in enumerate(points):
        if mesh.Contains(a, b):
            found = mesh(a, b)
            element = ng.ElementId(ng.VOL, found.nr)
            dofs = list(scalar.GetDofNrs(element))
            rows += [row] * len(dofs)
            columns += dofs
            values += list(scalar.GetFE(element).CalcShape(*found.pnt[:2]))
    return sp.csr_matrix((values, (rows, columns)), shape=(len(points), size))


at_nodes, at_points = shapes(place), shapes(np.array(ply["points"]))
known = np.diff(at_points.indptr) > 0
free = np.flatnonzero([bool(bit) for bit in space.FreeDofs()])
others = sp.csr_matrix((3 * nodes, space.ndof - 3 * size))
to_nodes = sp.hstack([sp.block_diag([at_nodes] * 3), others]).tocsc()
moving = to_nodes[:, free].tocsr()
rest = np.concatenate([place.T.ravel(), np.zeros(nodes)])
rows_of = lambda x: x.reshape(3, -1).T  # noqa: E731  nodes (n, 3) of x, y and z one after the other
mass = np.tile(ply["mass"] * areas, 3)
weight = np.concatenate([np.zeros(2 * nodes), -ply["gravity"] * ply["mass"] * areas])

# Where the robot holds the cups: from the flat ply to the first step, then along the motion.
origin, axes = np.array(ply["origin"]), np.array(ply["axes"])
grippers = ply["grippers"]
steps = np.array(ply["time"]) - ply["time"][0]
pace = min(1.0, args.longest / steps[-1]) if steps[-1] > 0.0 else 1.0
times = np.concatenate([[0.0, 0.5 * args.hang], args.hang + pace * steps])
upright = Rotation.from_matrix(np.column_stack([*axes, np.cross(*axes)]))
cups = []
for gripper in grippers:
    middle = np.array(gripper["place"])
    reach = gripper["radius"] + 1e-6 * np.sqrt(areas.sum())
    held = np.flatnonzero(np.linalg.norm(place - middle, axis=1) <= reach)
    arms = np.column_stack([place[held] - middle, np.zeros(len(held))])
    path = np.array(gripper["positions"])
    path = np.vstack([origin + middle @ axes, path[:1], path])
    turns = Rotation.from_quat(gripper["quaternions"])
    turns = Slerp(times, Rotation.concatenate([upright, turns[:1], turns]))
    until = np.inf if gripper["release"] is None else args.hang + pace * gripper["release"]
    cups.append((held, arms, path, turns, until, np.array(gripper["stiffness"])))

# The mold.
mold, contact = ply["mold"], ply["contact"]
if mold:
    sides = zip(mold["low"], mold["shape"], strict=True)
    grid = [low + mold["pitch"] * np.arange(count) for low, count in sides]
    field = RegularGridInterpolator(grid, np.reshape(mold["distance"], mold["shape"]))
    box = np.array([(line[0], line[-1]) for line in grid]).T
press = ply["mass"] * ply["gravity"] / contact["depth"] * areas
for held, *_, spring in cups:
    # a cup on its mount presses far harder than the ply weighs
    press[held] += 50.0 * spring[2] / len(held)


def distance(x: np.ndarray) -> np.ndarray:
    """Signed distance of places (n, 3) from the mold."""
    return field(np.clip(x, *box)) if mold else np.full(len(x), np.inf)


def normals(x: np.ndarray) -> np.ndarray:
    """Unit normals of the mold at places (n, 3)."""
    by = 0.1 * mold["pitch"]
    slope = np.stack([distance(x + by * e) - distance(x - by * e) for e in np.eye(3)], axis=1)
    return slope / np.linalg.norm(slope, axis=1, keepdims=True)


def springs(x: np.ndarray, now: float) -> tuple[np.ndarray, sp.csr_matrix, np.ndarray]:
    """Forces of cups and mold on nodes (n, 3), their stiffness, and the loads on the cups."""
    force, stiffness = np.zeros((nodes, 3)), np.zeros((nodes, 3, 3))
    loads = np.zeros((len(cups), 3))
    for k, (held, arms, path, turn, until, spring) in enumerate(cups):
        if now <= until:
            goal = [np.interp(now, times, path[:, axis]) for axis in range(3)]
            goal = goal + turn(min(now, times[-1])).apply(arms)
            pull = (goal - x[held]) * spring / len(held)
            force[held] += pull
            stiffness[held] += np.diag(spring) / len(held)
            loads[k] = -pull.sum(axis=0)
    depth = -distance(x)
    near = np.flatnonzero((depth > 0.0) | np.isfinite(anchor[:, 0]))
    if len(near):
        normal, depth, k = normals(x[near]), np.maximum(depth[near], 0.0), press[near, None]
        across = normal[:, :, None] * normal[:, None, :]
        slide = np.where(np.isfinite(anchor[near]), anchor[near] - x[near], 0.0)
        slide -= normal * (normal * slide).sum(axis=1, keepdims=True)
        force[near] += k * (depth[:, None] * normal + slide)
        stiffness[near] += (k * (depth > 0.0)[:, None])[..., None] * across
        stiffness[near] += (k * np.isfinite(anchor[near, :1]))[..., None] * (np.eye(3) - across)
    i, j = np.divmod(np.arange(9), 3)
    at = [(np.arange(nodes)[:, None] + nodes * axis).ravel() for axis in (i, j)]
    return force.T.ravel(), sp.csr_matrix((stiffness.ravel(), at), (3 * nodes,) * 2), loads


def hold(x: np.ndarray) -> None:
    """Lets go of nodes that are clear, anchors those that touch, and lets nodes slip."""
    gap = distance(x)
    anchor[gap > contact["clear"]] = np.nan
    fresh = (gap < 0.0) & ~np.isfinite(anchor[:, 0])
    anchor[fresh] = x[fresh]
    if contact["friction"] is not None:
        bound = contact["tack"] / press * areas + contact["friction"] * np.maximum(-gap, 0.0)
        slide = anchor - x
        length = np.linalg.norm(slide, axis=1)
        slips = length > bound
        anchor[slips] = (x + slide * (bound / np.maximum(length, 1e-300))[:, None])[slips]


# From the flat ply on, step by step.
state = GridFunction(space)
q, residual = state.vec.FV().NumPy(), state.vec.CreateVector()
solve_nodes = splu(at_nodes.tocsc())
for axis in range(3):
    start = origin + place @ axes
    moved = start[:, axis] - rest.reshape(3, -1)[axis]
    q[axis * size : (axis + 1) * size] = solve_nodes.solve(moved)


def csr(form: BilinearForm) -> sp.csr_matrix:
    """The matrix of a form."""
    return sp.csr_matrix(tuple(map(np.array, form.mat.CSR())), (space.ndof,) * 2)


anchor = np.full((nodes, 3), np.nan)
x, speed, now, step = rest + to_nodes @ q, np.zeros(3 * nodes), 0.0, args.step
landed, states, counts = np.full(nodes, np.nan), [], {"steps": 0, "solves": 0, "refused": 0}
moments = [*(args.hang + pace * steps), times[-1] + args.rest]
began = time.process_time()
while len(states) < len(moments):
    due = moments[len(states)]
    h = due - now if due - now < 1.5 * step else step
    f1, f2 = fibers(state.components[:3])
    for k, part in enumerate(normal.components):
        part.Set(ng.Normalize(ng.Cross(f1, f2))[k])
    bending.Assemble()
    bent = csr(bending)
    before, last = q.copy(), np.inf
    for _ in range(20):
        membrane.AssembleLinearization(state.vec)
        membrane.Apply(state.vec, residual)
        y = rest + to_nodes @ q
        force, stiffness, loads = springs(rows_of(y), now + h)
        force += weight - mass * ((y - x - h * speed) / h**2 + args.drag * (y - x) / h)
        stiffness = stiffness + sp.diags(mass * (1.0 / h**2 + args.drag / h))
        matrix = (csr(membrane) + bent)[free][:, free] + moving.T @ stiffness @ moving
        right = moving.T @ force - (residual.FV().NumPy() + bent @ q)[free]
        change = splu(matrix.tocsc(), diag_pivot_thresh=1e-3).solve(right)
        last = np.abs(moving @ change).max()
        q[free] += change * min(1.0, 5e-3 / last)
        counts["solves"] += 1
        if not last < 1.0 or last < 1e-6:
            break
    if not last < 1e-6:
        q[:], step = before, 0.5 * h
        counts["refused"] += 1
        if step < 1e-6:
            raise SystemExit(f"at {now:.4f} s no time step is short enough")
        continue
    counts["steps"] += 1
    y = rest + to_nodes @ q
    speed, x, now = (y - x) / h, y, now + h
    step = min(args.step, 1.5 * step)
    hold(rows_of(x))
    landed[np.isnan(landed) & np.isfinite(anchor[:, 0])] = max(0.0, now - args.hang) / pace
    if now > due - 1e-9:
        shown = np.column_stack([at_points @ q[k * size : (k + 1) * size] for k in range(3)])
        shown[:, :2] += np.array(ply["points"])
        lies = areas[np.isfinite(anchor[:, 0])].sum() / areas.sum()
        states.append({
            "positions": [list(p) if ok else None for p, ok in zip(shown, known, strict=True)],
            "forces": loads.tolist(), "lies": lies,
        })  # fmt: skip
        low, fast = rows_of(x)[:, 2].min(), np.abs(speed).max()
        print(f"state {len(states)} of {len(moments)}: lowest {1e3 * low:.2f} mm,", end=" ")
        print(f"{100 * lies:.0f} % lie, {1e3 * fast:.1f} mm/s, {counts},", end=" ")
        print(f"{time.process_time() - began:.0f} s of CPU", flush=True)

touch = None
if np.isfinite(landed).any():
    first = int(np.nanargmin(landed))
    touch = {"time": landed[first], "place": place[first].tolist()}
report = {
    "format": "plydrape-ngsolve-drape",
    "version": 1,
    "result": ply["result"],
    "settings": vars(args),
    "cpu_s": round(time.process_time() - began, 1),
    **counts,
    "first_touch": touch,
    "states": states,
}
(home / "drape.json").write_text(json.dumps(report))
