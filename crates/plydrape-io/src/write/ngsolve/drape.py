"""Drapes the motion of a result of plydrape in the finite element code NGSolve.

    pip install ngsolve==6.2.2608 scipy
    python drape.py                        # reads ply.json, writes drape.json

The ply is a nonlinear Koiter shell after Neunteufel and Schöberl (arXiv 2304.13806): displacements
of second order in quads along the fibers, and moments as unknowns of their own (elements of Hellan,
Herrmann and Johnson), so that the kinks between elements bend too. The energy per area is

    T (|a1| - 1)^2 / 2 + T (|a2| - 1)^2 / 2 + (integral of tau over gamma) + bending,

with the fiber vectors a1 and a2, the shear sin(gamma) = a1 . a2 / (|a1| |a2|), the tension
stiffness T, the shear curve tau and two flexural rigidities, to which the lips of cups add theirs.
Gravity acts from the start, and time steps are implicit (Euler's), because the ply snaps from fold
to fold. Cups are springs to where the robot holds them. Contact is that of plydrape's sheet: a node
below the mold is pushed back, and held along the mold where it touched until it is clear again. All
units are SI.
"""

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

home = Path(__file__).resolve().parent
ply = json.loads((home / "ply.json").read_text())
parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
for name, (value, meaning) in ply["settings"].items():
    parser.add_argument(f"--{name}", type=float, default=value, help=f"{meaning}; {value}")
args = parser.parse_args()

# The flat ply in fabric coordinates: quads, and the sides that belong to a single one.
corner, quads = np.array(ply["nodes"]), np.array(ply["quads"])
sides = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
sides, count = np.unique(sides, axis=0, return_counts=True)
netgen = Netgen(dim=2)
netgen.Add(FaceDescriptor(surfnr=1, domin=1, bc=1))
vertex = [netgen.Add(MeshPoint(Pnt(u, v, 0.0))) for u, v in corner]
for quad in quads:
    netgen.Add(Element2D(1, [vertex[k] for k in quad]))
for side in sides[count == 1]:
    netgen.Add(Element1D([vertex[k] for k in side], index=1))
netgen.SetBCName(0, "boundary")
mesh = ng.Mesh(netgen)

# Unknowns: displacements from the flat ply, and moments that vanish across a free boundary.
scalar = ng.H1(mesh, order=2)
space = scalar * scalar * scalar * ng.HDivDiv(mesh, order=1, dirichlet="boundary")
*u, moment = space.TrialFunction()
*du, test = space.TestFunction()
free = np.flatnonzero([bool(bit) for bit in space.FreeDofs()])


def fibers(x):
    """Fiber vectors a1 and a2 of a displacement."""
    flat = [CoefficientFunction((1.0, 0.0, 0.0)), CoefficientFunction((0.0, 1.0, 0.0))]
    return [flat[k] + CoefficientFunction(tuple(grad(part)[k] for part in x)) for k in (0, 1)]


def gauss(along_u, along_v):
    """Gauss's points of a quad: two of them along a fiber keep its stretch from locking."""
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

# Bending: moments times curvatures along the normal, less moments times the slopes across the sides
# of elements, less the moments' own energy. The normal is that of the time step before, as a
# continuous field; the published form has that of the unknown displacement.
normal = GridFunction(ng.H1(mesh, order=1) ** 3)
bending = BilinearForm(space, symmetric=False)
out = ng.specialcf.normal(2)
for x, m in ((u, test), (du, moment)):
    parts = list(zip(normal.components, x, strict=True))
    curvature = sum(n * InnerProduct(m, part.Operator("hesse")) for n, part in parts)
    slope = sum(n * (grad(part) * out) for n, part in parts)
    bending += ng.SymbolicBFI(curvature, intrule=gauss(3, 3))
    bending += ng.SymbolicBFI(-slope * InnerProduct(out, m * out), element_boundary=True)
warp, weft = ply["rigidity"]
# The soft lip of a cup bends with the ply as long as the cup holds it, and does not resist twist.
holds = [ng.Parameter(1.0) for _ in ply["grippers"]]
lip = CoefficientFunction(0.0)
for cup, hold_on in zip(ply["grippers"], holds, strict=True):
    if cup["lip"]:
        (a, b), (reach, rigidity) = cup["place"], cup["lip"]
        under = ng.IfPos(reach**2 - (ng.x - a) ** 2 - (ng.y - b) ** 2, 1.0, 0.0)
        lip += hold_on * rigidity * under
own = moment[0, 0] * test[0, 0] / (warp + lip) + moment[1, 1] * test[1, 1] / (weft + lip)
own += 2.0 * moment[0, 1] * test[0, 1] / (args.twist * np.sqrt(warp * weft))
bending += ng.SymbolicBFI(-own, intrule=gauss(3, 3))


def shapes(points):
    """Values of the shape functions at fabric points (n, 2); an empty row beyond the quads."""
    rows, columns, values = [], [], []
    for row, (a, b) in enumerate(points):
        if mesh.Contains(a, b):
            found = mesh(a, b)
            element = ng.ElementId(ng.VOL, found.nr)
            columns += (dofs := scalar.GetDofNrs(element))
            rows += [row] * len(dofs)
            values += list(scalar.GetFE(element).CalcShape(*found.pnt[:2]))
    return sp.csr_matrix((values, (rows, columns)), shape=(len(points), scalar.ndof))


# Nodes of the quads: corners, middles of sides, middles. Each has its share of the area.
low, high = corner[quads[:, 0]], corner[quads[:, 2]]
place = [low + (high - low) * [a, b] for a in (0.0, 0.5, 1.0) for b in (0.0, 0.5, 1.0)]
place = np.unique(np.round(np.vstack(place), 9), axis=0)
nodes, size = len(place), scalar.ndof
at_nodes, at_points = shapes(place), shapes(np.array(ply["points"]))
integrals = ng.LinearForm(scalar.TestFunction() * ng.dx).Assemble().vec.FV().NumPy()
areas = splu(at_nodes.T.tocsc()).solve(integrals)
mass = ply["mass"] * areas
# from unknowns to places: x, y and z of a node are neighbors
to_nodes = [sp.kron(at_nodes, axis[:, None]) for axis in np.eye(3)]
to_nodes += [sp.csr_matrix((3 * nodes, space.ndof - 3 * size))]
to_nodes = sp.hstack(to_nodes).tocsc()
moving = to_nodes[:, free].tocsr()

# Where the robot holds the cups: from the flat ply to the first step, then along the motion.
origin, axes = np.array(ply["origin"]), np.array(ply["axes"])
flat_turn = Rotation.from_matrix(np.column_stack([*axes, np.cross(*axes)])).as_quat()
steps = np.array(ply["time"]) - ply["time"][0]
pace = min(1.0, args.longest / max(steps[-1], 1e-9))
times = np.concatenate([[0.0, 0.5 * args.hang], args.hang + pace * steps])
cups = []
for cup in ply["grippers"]:
    arms = np.column_stack([place - cup["place"], np.zeros(nodes)])
    held = np.linalg.norm(arms, axis=1) <= cup["radius"] + 1e-6 * np.sqrt(areas.sum())
    # A mount that yields acts on the mean of the nodes under a lip: each bears as much as its area,
    # and none whose opposite is beyond the ply.
    mean = bool(cup["lip"]) and cup["yields"] and cup["radius"] == 0.0
    if mean:
        inside = [mesh.Contains(*(2.0 * np.array(cup["place"]) - point)) for point in place]
        held |= (np.linalg.norm(arms, axis=1) <= cup["lip"][0]) & inside
    shares = areas[held] / areas[held].sum() if mean else np.full(held.sum(), 1.0 / held.sum())
    if mean and held.sum() > 2:
        # the mean of their places in the flat is the middle of the cup
        middle = shares @ arms[held, :2]
        off = arms[held, :2] - middle
        spread = (off * shares[:, None]).T @ off
        shares = shares * (1.0 - off @ np.linalg.pinv(spread) @ middle)
    path, turns = np.array(cup["positions"]), np.array(cup["quaternions"])
    path = np.vstack([origin + cup["place"] @ axes, path[:1], path])
    turns = Slerp(times, Rotation.from_quat(np.vstack([flat_turn, turns[:1], turns])))
    until = np.inf if cup["release"] is None else args.hang + pace * cup["release"]
    spring = shares[:, None] * cup["stiffness"]
    bears = shares if mean else None
    cups.append((np.flatnonzero(held), arms[held], bears, path, turns, until, spring))

# The mold. A cup presses far harder than the ply weighs, and contact under it is as much stiffer.
mold, contact = ply["mold"], ply["contact"]
if mold:
    ends = zip(mold["low"], mold["shape"], strict=True)
    grid = [start + mold["pitch"] * np.arange(count) for start, count in ends]
    field = RegularGridInterpolator(grid, np.reshape(mold["distance"], mold["shape"]))
press = mass * ply["gravity"] / contact["depth"]
for held, *_, spring in cups:
    press[held] += 50.0 * spring[:, 2]


def distance(x):
    """Signed distance of places (n, 3) from the mold."""
    return field(np.clip(x, [line[0] for line in grid], [line[-1] for line in grid]))


def normals(x):
    """Unit normals of the mold at places (n, 3); zero beyond its grid."""
    by = 0.1 * mold["pitch"]
    slope = np.stack([distance(x + by * e) - distance(x - by * e) for e in np.eye(3)], axis=1)
    return slope / np.maximum(np.linalg.norm(slope, axis=1, keepdims=True), 1e-300)


def springs(x, now):
    """Forces of cups and mold on nodes (n, 3), their stiffness, and the loads on the cups."""
    force, stiffness = np.zeros((nodes, 3)), np.zeros((nodes, 3, 3))
    loads = []
    for held, arms, bears, path, turn, until, spring in cups:
        goal = [np.interp(now, times, along) for along in path.T]
        # a pad turns what it holds; a lip leaves it free to turn and to bend
        goal = goal + (
            turn(min(now, times[-1])).apply(arms) if bears is None else x[held] - bears @ x[held]
        )
        pull = (goal - x[held]) * spring * (now <= until)
        force[held] += pull
        stiffness[held] += spring[:, :, None] * np.eye(3) * (now <= until)
        loads.append(-pull.sum(axis=0))
    if mold:
        n, depth, k = normals(x), np.maximum(-distance(x), 0.0)[:, None], press[:, None]
        sticks = np.isfinite(anchor)
        slide = np.where(sticks, anchor - x, 0.0)
        slide -= n * (n * slide).sum(axis=1, keepdims=True)
        force += k * (depth * n + slide)
        across = n[:, :, None] * n[:, None, :]
        stiffness += (k * (depth > 0.0))[..., None] * across
        stiffness += (k * sticks)[..., None] * (np.eye(3) - across)
    return force, stiffness, np.array(loads)


def hold(x):
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


def csr(form):
    """The matrix of a form."""
    return sp.csr_matrix(tuple(map(np.array, form.mat.CSR())), (space.ndof,) * 2)


# From the flat ply on, step by step.
flat = np.pad(place, ((0, 0), (0, 1)))
state, anchor = GridFunction(space), np.full((nodes, 3), np.nan)
q, residual = state.vec.FV().NumPy(), state.vec.CreateVector()
q[: 3 * size] = splu(at_nodes.tocsc()).solve(origin + place @ axes - flat).T.ravel()
x = flat + (to_nodes @ q).reshape(-1, 3)
speed, now, step = np.zeros((nodes, 3)), 0.0, args.step
states, touch, counts = [], None, {"steps": 0, "solves": 0, "refused": 0}
moments = [*times[2:], times[-1] + args.rest]
while len(states) < len(moments):
    due = moments[len(states)]
    h = due - now if due - now < 1.5 * step else step
    along = ng.Normalize(ng.Cross(*fibers(state.components[:3])))
    for k, part in enumerate(normal.components):
        part.Set(along[k])
    for hold_on, (*_, until, _spring) in zip(holds, cups, strict=True):
        hold_on.Set(float(now <= until))
    bending.Assemble()
    bent, before = csr(bending), q.copy()
    for _ in range(20):
        membrane.AssembleLinearization(state.vec)
        membrane.Apply(state.vec, residual)
        y = flat + (to_nodes @ q).reshape(-1, 3)
        force, stiffness, loads = springs(y, now + h)
        inertia = (y - x - h * speed) / h**2 + args.drag * (y - x) / h + [0.0, 0.0, ply["gravity"]]
        force -= mass[:, None] * inertia
        stiffness += (mass * (1.0 / h**2 + args.drag / h))[:, None, None] * np.eye(3)
        stiffness = sp.bsr_matrix((stiffness, np.arange(nodes), np.arange(nodes + 1)))
        matrix = (csr(membrane) + bent)[free][:, free] + moving.T @ stiffness @ moving
        right = moving.T @ force.ravel() - (residual.FV().NumPy() + bent @ q)[free]
        # symmetric, positive in displacements and negative in moments: it needs no other pivots
        factors = splu(matrix.tocsc(), "MMD_AT_PLUS_A", 0.0, options={"SymmetricMode": True})
        change = factors.solve(right)
        last = np.abs(moving @ change).max()
        q[free] += change * min(1.0, 5e-3 / last)
        counts["solves"] += 1
        if not 1e-6 <= last < 1.0:
            break
    if not last < 1e-6:
        q[:], step = before, 0.5 * h
        counts["refused"] += 1
        if step < 1e-6:
            raise SystemExit(f"at {now:.4f} s no time step is short enough")
        continue
    counts["steps"] += 1
    y = flat + (to_nodes @ q).reshape(-1, 3)
    speed, x, now, step = (y - x) / h, y, now + h, min(args.step, 1.5 * step)
    if mold:
        hold(x)
    lies = np.isfinite(anchor[:, 0])
    if touch is None and lies.any():
        touch = {"time": max(0.0, now - args.hang) / pace, "place": place[lies.argmax()].tolist()}
    if now > due - 1e-9:
        moved = at_points @ q[: 3 * size].reshape(3, -1).T
        moved[:, :2] += ply["points"]
        moved[np.diff(at_points.indptr) == 0] = np.nan
        known = [None if np.isnan(point[0]) else point for point in moved.tolist()]
        share = areas[lies].sum() / areas.sum()
        states.append({"positions": known, "forces": loads.tolist(), "lies": share})
        low, took = 1e3 * x[:, 2].min(), time.process_time()
        print(f"state {len(states)} of {len(moments)}, {took:.0f} s of CPU, {counts}:", end=" ")
        print(f"lowest {low:.2f} mm, {share:.0%} lie", flush=True)

report = {
    "format": "plydrape-ngsolve-drape", "version": 1, "result": ply["result"],
    "settings": vars(args), "cpu_s": round(time.process_time(), 1), **counts,
    "first_touch": touch, "states": states,
}  # fmt: skip
(home / "drape.json").write_text(json.dumps(report))
