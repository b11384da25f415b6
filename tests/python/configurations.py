"""Random gripper configurations, each of a known kind: the same ones in every run.

A configuration is drawn until it is of its kind and no edge is longer than its fabric (the program
refuses a ply that is torn at the start). Lengths in meters, angles in radians.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from oracle import Net, Problem, Solution, build, solve
from oracle_span import Real

RULES = ("min-force", "moment-balance")


@dataclass(frozen=True)
class Configuration:
    """A problem, its name, and what kind it was drawn to be.

    A stiff ply in compression has many equilibria, by either slope rule, as buckled strips do; the
    configurations that show this say so in their name, all others have one (`test_oracle.py`).
    """

    name: str
    problem: Problem
    kind: str

    @property
    def limited(self) -> bool:
        """Whether it was drawn to have slopes at the limit of the ball joints."""
        return "stairs" in self.name or "narrow joint" in self.name

    @property
    def ambiguous(self) -> bool:
        """Whether it has several equilibria."""
        return "of many equilibria" in self.name


def grid(nu: int, nv: int, spacing: tuple[float, float], shear: float = 0.0) -> Real:
    """Level positions (nv, nu, 3); shear turns the lines along v."""
    i, j = np.meshgrid(np.arange(nu), np.arange(nv))
    x = i * spacing[0] + j * spacing[1] * np.sin(shear)
    y = j * spacing[1] * np.cos(shear)
    return np.stack([x, y, np.zeros_like(x)], axis=-1)


def paper(rule: str = "min-force", axial_stiffness: float = np.inf) -> Problem:
    """The start of the paper's example: 4 x 2 grippers 98 mm apart, level, cells of 100 mm."""
    return Problem(grid(4, 2, (0.098, 0.098)), axial_stiffness=axial_stiffness, rule=rule)


def is_kind(net: Net, kind: str) -> bool:
    """Whether a net shears as its kind says and all its catenaries have slack."""
    chord = np.hypot(net.run, net.rise)
    length = np.array([line.length for line in net.catenaries])
    shearing = np.array([line.shearing for line in net.catenaries])
    cells = (len(net.catenaries) - net.edges) // 2
    if np.any((chord > (1.0 - 2e-5) * length) & ~shearing):
        return False
    wanted = {
        "slack": shearing.sum() == 0,
        "partly sheared": 0 < shearing.sum() < cells,
        "fully sheared": shearing.sum() == cells,
    }
    return bool(wanted[kind])


def draw(
    seed: int, kind: str, base: Real, noise: float, heights: float, problem: Problem | None = None
) -> Problem:
    """Positions around ``base`` until the ply is of its kind; leaning, at random heights."""
    rng = np.random.default_rng(seed)
    model = problem or Problem(base)
    for _ in range(2000):
        at = base + rng.uniform(-1.0, 1.0, base.shape) * np.array([noise, noise, heights])
        lean = rng.uniform(-0.05, 0.05, 2)
        at[..., 2] += 0.2 + at[..., :2] @ lean
        candidate = replace(model, positions=at)
        if is_kind(build(candidate), kind):
            return candidate
    raise AssertionError(f"no {kind} configuration from seed {seed}")


def staircase(nu: int, nv: int, tread: float, riser: float) -> Real:
    """Each column higher than the one before: chords steeper than the ball joints turn."""
    at = grid(nu, nv, (tread, 0.097))
    at[..., 2] = np.arange(nu) * riser
    return at


def zigzag(nu: int, nv: int, spacing: float, shear: float) -> Real:
    """Rows shifted to and fro: neighboring cells shear in opposite senses."""
    at = grid(nu, nv, (spacing, spacing * float(np.cos(shear))))
    at[..., 0] += (np.arange(nv) % 2)[:, None] * spacing * np.sin(shear)
    return at


def inclined(base: Real, climb: float, towards: float, turn: float = 0.0) -> Real:
    """Level positions turned about z by ``turn``, then climbing by ``climb`` in one direction."""
    out = base.copy()
    x, y = base[..., 0], base[..., 1]
    x, y = x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)
    along = x * np.cos(towards) + y * np.sin(towards)
    across = y * np.cos(towards) - x * np.sin(towards)
    z = along * np.sin(climb)
    along = along * np.cos(climb)
    out[..., 0] = along * np.cos(towards) - across * np.sin(towards)
    out[..., 1] = along * np.sin(towards) + across * np.cos(towards)
    out[..., 2] = z
    return out


def mirrored(base: Real) -> Real:
    """The mirror image in the plane y = 0."""
    out = base.copy()
    out[..., 1] *= -1.0
    return out


def material(**changes: float) -> Problem:
    """The paper's material with changes; positions come later."""
    cell = (changes.pop("a", 0.1), changes.pop("b", 0.1))
    return Problem(np.zeros((1, 2, 3)), cell=cell, **changes)  # type: ignore[arg-type]


def drawn() -> list[Configuration]:
    """All drawn configurations, by rule in turn."""
    deg = float(np.radians(1.0))
    plain = material()
    rows: list[tuple[str, str, int, Real, float, float, Problem]] = []
    for nu, nv in ((4, 2), (3, 3), (5, 3), (2, 2), (3, 1), (4, 1), (6, 1), (2, 1)):
        rows.append(
            ("slack", f"{nu}x{nv}", 10 * nu + nv, grid(nu, nv, (0.096,) * 2), 1e-3, 6e-3, plain)
        )
    for nu, nv in ((4, 2), (3, 3), (5, 3)):
        base = grid(nu, nv, (0.0975, 0.0975), shear=2.8 * deg)
        rows.append(("partly sheared", f"{nu}x{nv}", 20 * nu + nv, base, 1e-3, 4e-3, plain))
    for nu, nv, angle in ((4, 2, 20.0), (3, 3, -14.0), (5, 3, 10.0), (2, 2, 25.0)):
        base = grid(nu, nv, (0.097, 0.097), shear=angle * deg)
        rows.append(("fully sheared", f"{nu}x{nv}", 30 * nu + nv, base, 8e-4, 5e-3, plain))
    for nu, nv, angle, towards in ((4, 2, 15.0, 0.5), (3, 3, 15.0, 2.2), (4, 3, -15.0, 4.0)):
        base = grid(nu, nv, (0.097, 0.097), shear=angle * deg)
        seed = 40 * nu + nv
        climbs = inclined(base, 20 * deg, towards, turn=towards / 3.0)
        rows += [
            ("fully sheared", f"incline {nu}x{nv}", seed, climbs, 5e-4, 3e-3, plain),
            ("fully sheared", f"mirrored {nu}x{nv}", seed, mirrored(climbs), 5e-4, 3e-3, plain),
        ]
    for nu, nv, angle, towards in ((2, 2, 4.5, 0.5), (4, 2, 4.8, 1.5), (3, 3, -4.6, 3.0)):
        # the cells shear from 2.97 degrees on: here by 1 to 2
        base = inclined(grid(nu, nv, (0.0975, 0.0975), shear=angle * deg), 15 * deg, towards, 0.4)
        rows.append(("fully sheared", f"onset {nu}x{nv}", 50 * nu + nv, base, 2e-4, 2e-3, plain))
    rows += [
        ("fully sheared", "zigzag 3x3", 81, zigzag(3, 3, 0.097, 12 * deg), 5e-4, 4e-3, plain),
        ("fully sheared", "zigzag 4x3", 82, zigzag(4, 3, 0.097, 12 * deg), 5e-4, 4e-3, plain),
        ("slack", "stairs 4x2", 83, staircase(4, 2, 0.071, 0.0645), 5e-4, 1e-3, plain),
        ("slack", "stairs 3x1", 84, staircase(3, 1, 0.065, 0.0700), 5e-4, 1e-3, plain),
        ("slack", "stairs 3x3", 85, staircase(3, 3, 0.071, 0.0640), 5e-4, 1e-3, plain),
        ("slack", "narrow joint 4x2", 86, grid(4, 2, (0.096,) * 2), 1e-3, 8e-3,
         material(max_tilt=1.5 * deg)),
        ("slack", "narrow joint 5x3", 87, grid(5, 3, (0.096,) * 2), 1e-3, 8e-3,
         material(max_tilt=2.5 * deg)),
        ("partly sheared", "narrow joint 4x2", 88, grid(4, 2, (0.0975,) * 2, 2.8 * deg), 1e-3, 5e-3,
         material(max_tilt=1.0 * deg)),
        ("slack", "oblong 4x2", 89, grid(4, 2, (0.116, 0.077)), 1e-3, 5e-3,
         material(a=0.12, b=0.08)),
        ("slack", "inextensible 3x3", 90, grid(3, 3, (0.097,) * 2), 1e-3, 4e-3,
         material(axial_stiffness=np.inf)),
        ("slack", "soft 4x2", 91, grid(4, 2, (0.098,) * 2), 1e-3, 4e-3,
         material(axial_stiffness=300.0)),
        ("slack", "stiff strip 4x1", 92, grid(4, 1, (0.096,) * 2), 1e-3, 4e-3,
         material(rigidity=9e-5)),
        ("slack", "stiff 4x2", 97, grid(4, 2, (0.096,) * 2), 1e-3, 4e-3,
         material(rigidity=9e-5)),
        ("slack", "compressed 2x2", 93, grid(2, 2, (0.096,) * 2), 1e-3, 3e-3,
         material(rigidity=9e-4)),
        ("fully sheared", "compressed 4x2", 98, grid(4, 2, (0.096,) * 2, 15 * deg), 5e-4, 3e-3,
         material(rigidity=9e-4)),
        ("slack", "of many equilibria 4x1", 92, grid(4, 1, (0.096,) * 2), 1e-3, 4e-3,
         material(rigidity=2e-4)),
        ("slack", "of many equilibria 4x2", 93, grid(4, 2, (0.096,) * 2), 1e-3, 3e-3,
         material(rigidity=9e-4)),
        ("slack", "nearly taut 4x2", 94, grid(4, 2, (0.0997,) * 2), 1e-4, 1e-3, plain),
        ("partly sheared", "nearly taut 3x3", 95, grid(3, 3, (0.0996,) * 2, 0.6 * deg), 2e-4, 1e-3,
         plain),
    ]  # fmt: skip
    out = []
    for kind, name, seed, base, noise, heights, model in rows:
        problem = draw(seed, kind, base, noise, heights, model)
        out += [
            Configuration(f"{kind} {name} {rule}", replace(problem, rule=rule), kind)
            for rule in RULES
        ]
    return out


_SOLVED: dict[str, Solution] = {}


def solved(case: Configuration) -> Solution:
    """The oracle's equilibrium of a configuration, solved once per run."""
    if case.name not in _SOLVED:
        _SOLVED[case.name] = solve(case.problem)
    return _SOLVED[case.name]
