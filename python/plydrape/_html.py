"""What a notebook shows of a scene, a result and others: a picture and a table, in a few kilobytes.

Colors are the notebook's own, so that a dark theme stays dark; red and green are readable on both.
Nothing is loaded, no script runs, and every text is escaped.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from plydrape import _plydrape, _shapes
from plydrape._values import give_one

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from plydrape import Equilibrium, Limits, Material, Plan, Ply, Result, Scene, Sheet, Span
    from plydrape.limits import Limit

Lines = Sequence["NDArray[np.float64]"]

WIDE, HIGH, EDGE = 300.0, 190.0, 10.0
"""Size of a picture and its empty edge (pixels)."""
LONG = 80
"""Texts that are longer go over several lines."""
MOST = 400
"""Lines or dots of a kind that a picture has at most."""
RED, GREEN, QUIET = "#e5484d", "#2f9e57", "#8b939e"
EYE = np.array([[0.88, 0.474, 0.0], [-0.228, 0.423, 0.877]])
"""To the right and upward in a picture, as in the view of the report."""
PLAN = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
SIDE = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


def page(body: str) -> str:
    """A piece of a notebook."""
    return f'<div class="plydrape" style="line-height:1.4;max-width:60em">{body}</div>'


def card(kind: str, title: str, picture: str, *parts: str) -> str:
    """A picture beside a title and tables."""
    head = f'<div><b>{escape(title)}</b> <span style="opacity:.7">{escape(kind)}</span></div>'
    left = f'<div style="flex:none">{picture}</div>' if picture else ""
    right = f'<div style="flex:1 1 20em;min-width:0">{head}{"".join(parts)}</div>'
    style = "display:flex;flex-wrap:wrap;gap:1em;align-items:flex-start"
    return page(f'<div style="{style}">{left}{right}</div>')


def table(rows: Iterable[Sequence[str]], head: Sequence[str] = ()) -> str:
    """A table of texts, each of them escaped already."""
    cell = "text-align:left;vertical-align:top;padding:.1em .6em .1em 0"
    short = f"{cell};white-space:nowrap"
    top = "".join(f'<th style="{short};font-weight:600">{one}</th>' for one in head)
    lines = [top] if head else []
    for row in rows:
        styled = [(short if len(one) < LONG else cell, one) for one in row]
        lines.append("".join(f'<td style="{style}">{one}</td>' for style, one in styled))
    body = "".join(f"<tr>{line}</tr>" for line in lines)
    whole = "border-collapse:collapse;margin:.3em 0;font-size:90%"
    return f'<div style="overflow-x:auto"><table style="{whole}">{body}</table></div>'


def pairs(values: dict[str, str]) -> str:
    """A table of names and values."""
    return table(
        [(f'<span style="opacity:.7">{escape(k)}</span>', escape(v)) for k, v in values.items()]
    )


def verdict(result: Result) -> str:
    """In words, with a sign for those who do not see its color."""
    ink, sign = (GREEN, "✓") if result.accepted else (RED, "✗")
    return f'<div style="color:{ink};font-weight:600">{sign} {result.verdict}</div>'


def limits(found: Limits) -> str:
    """The limits that are not kept, and the others folded up."""
    head = ("", "limit", "value", "allowed", "step", "where")
    broken = [limit_row(limit) for limit in found.values() if not limit.kept]
    kept = [limit_row(limit) for limit in found.values() if limit.kept]
    out = table(broken, head) if broken else ""
    if kept:
        count = "1 limit is kept" if len(kept) == 1 else f"{len(kept)} limits are kept"
        opened = "" if broken else " open"
        out += f"<details{opened}><summary>{count}</summary>{table(kept, head)}</details>"
    return out


def limit_row(limit: Limit) -> tuple[str, ...]:
    """A limit as a row."""
    ink, sign = (GREEN, "✓") if limit.kept else (RED, "✗")
    bound = "≤" if limit.sense == "at-most" else "≥"
    return (
        f'<span style="color:{ink}" title="{"kept" if limit.kept else "not kept"}">{sign}</span>',
        escape(limit.label),
        escape(limit.amount(limit.value)),
        escape(f"{bound} {limit.amount(limit.limit)}"),
        "" if limit.step is None else str(limit.step),
        escape(limit.where),
    )


class Picture:
    """Lines and dots of space, seen from one side."""

    def __init__(self, view: NDArray[np.float64], title: str) -> None:
        self.view, self.title = view, title
        self.parts: list[tuple[NDArray[np.float64], Callable[[NDArray[np.float64]], str]]] = []

    def lines(self, lines: Lines, ink: str, width: float = 1.2, dash: str = "") -> Picture:
        """Polylines (N, 3)."""
        extra = f' stroke-dasharray="{dash}"' if dash else ""
        for line in lines[:: max(1, -(-len(lines) // MOST))]:
            thin = np.asarray(line)[:: max(1, len(line) // 24)]
            thin = np.concatenate([thin, np.asarray(line)[-1:]])

            def drawn(points: NDArray[np.float64]) -> str:
                where = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
                return (
                    f'<polyline points="{where}" fill="none" stroke="{ink}" '
                    f'stroke-width="{width}"{extra}/>'
                )

            if np.isfinite(thin).all():
                self.parts.append((thin @ self.view.T, drawn))
        return self

    def dots(self, points: NDArray[np.float64], ink: str, radius: float) -> Picture:
        """Points (N, 3)."""
        kept = np.asarray(points)[:: max(1, -(-len(points) // MOST))]

        def drawn(places: NDArray[np.float64]) -> str:
            return "".join(
                f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{ink}"/>' for x, y in places
            )

        if len(kept):
            self.parts.append((kept @ self.view.T, drawn))
        return self

    def svg(self) -> str:
        """The picture, or nothing."""
        if not self.parts:
            return ""
        every = np.concatenate([points for points, _ in self.parts])
        low, high = every.min(axis=0), every.max(axis=0)
        size = np.maximum(high - low, 1e-12)
        scale = float(min((WIDE - 2 * EDGE) / size[0], (HIGH - 2 * EDGE) / size[1]))
        wide, tall = scale * size + 2 * EDGE
        drawn = "".join(
            draw((points - low) * scale * [1.0, -1.0] + [EDGE, tall - EDGE])
            for points, draw in self.parts
        )
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide:.0f}" height="{tall:.0f}" '
            f'viewBox="0 0 {wide:.1f} {tall:.1f}" role="img" style="max-width:100%">'
            f"<title>{escape(self.title)}</title>{drawn}</svg>"
        )


def flat(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """From above, or from the side where all points are in a row."""
    spread = np.ptp(points.reshape(-1, 3), axis=0)
    return SIDE if spread[1] < 1e-3 * max(spread[0], spread[2]) else PLAN


def scene(scene: Scene) -> str:
    """The ways of the grippers."""
    ply, positions = scene.ply, scene.positions
    picture = Picture(flat(positions), "ways of the grippers from the start, disc, to the end")
    edges = ply.catenaries[: _shapes.edges(ply.grippers)]
    start = positions[0]
    picture.lines([start[list(pair)] for pair in edges], QUIET, 0.8)
    picture.lines(list(positions.swapaxes(0, 1)), RED)
    picture.dots(start, "currentColor", 3.5).dots(positions[-1], RED, 2.2)
    mold = scene.mold
    rows = {
        "grippers": count(ply),
        "material": ply.material.name,
        "mold": "none" if mold is None else mold.kind,
        "steps": f"{len(positions)} in {scene.times[-1] - scene.times[0]:.4g} s",
    }
    if scene.errors is not None:
        rows["errors"] = f"{scene.errors['samples']} cells" if "samples" in scene.errors else "yes"
    return card("scene", scene.title, picture.svg(), pairs(rows))


def count(ply: Ply) -> str:
    """How many grippers hold a ply."""
    nu, nv = ply.grippers
    return f"{nu} × {nv}" if nu * nv == len(ply.ids) else str(len(ply.ids))


def result(result: Result, kind: str = "result", more: dict[str, str] | None = None) -> str:
    """The ply at the end, and the limits that decide."""
    steps = len(result.times)
    rows = {"steps": str(steps), "model": result.model, **(more or {})}
    if (tolerance := result.tolerance) is not None:
        rows["tolerates"] = f"errors of {tolerance['gripper_mm']:.2g} mm"
    if (sample := result.sample) is not None:
        rows["cells"] = (
            f"{sample.accepted} of {len(sample)} accepted, {sample.confidence:.0%} confidence"
        )
    picture = drape(result) if steps else ""
    return card(
        kind,
        result.title,
        picture,
        verdict(result),
        pairs(rows),
        limits(result.limits),
    )


def drape(result: Result) -> str:
    """The ply at the end by the model that decides, and red dots where a sheet is too high."""
    grippers = result.positions[-1]
    side = flat(grippers)
    picture = Picture(SIDE if side is SIDE else EYE, "the ply at the end")
    if result.model == "catenaries":
        lines = result.lines(-1)
        picture.lines(lines[: _shapes.edges(result.grid) or len(lines)], QUIET, 1.2)
    elif (sheet := result.sheet) is not None:
        wires(picture, sheet)
        if (limit := result.limits.get("height")) is not None:
            heights = np.nan_to_num(sheet.heights[-1]) * 1e3
            picture.dots(sheet.positions[-1][heights > limit.limit], RED, 1.6)
    return picture.dots(grippers, "currentColor", 3.5).svg()


def wires(picture: Picture, sheet: Sheet) -> None:
    """The sheet in its last state."""
    points = sheet.positions[-1]
    picture.lines([points[list(pair)] for pair in sheet.segments], QUIET, 0.6)


def plan(plan: Plan) -> str:
    """The drape along the planned motion."""
    more = {"motion": f"{plan.duration:.3g} s", "search": f"{plan.evaluations} drapes"}
    return result(plan.result, f"plan, {plan.method}", more)


def sheet(sheet: Sheet) -> str:
    """The sheet at its last state."""
    picture = Picture(EYE, "the sheet at the end")
    wires(picture, sheet)
    picture.dots(sheet.grippers[-1], "currentColor", 3.5)
    rows = {"nodes": str(len(sheet.places)), "states": str(len(sheet.steps))}
    return card("the whole ply", "Sheet", picture.svg(), pairs(rows))


def span(span: Span) -> str:
    """The span from the side."""
    x, z = span.points(41).T
    curve = np.column_stack([x, np.zeros_like(x), z])
    ends = curve[[0, -1]]
    picture = Picture(SIDE, "the span from the side").lines([ends], QUIET, 0.8, "4 3")
    picture.lines([curve], RED, 1.6).dots(ends, "currentColor", 3.5)
    rows = {
        "state": span.state,
        "run": f"{1e3 * span.run:.4g} mm",
        "length": f"{1e3 * span.length:.4g} mm",
        "horizontal force": "none" if span.force is None else f"{span.force:.4g} N",
        "sag": f"{1e3 * span.sag:.4g} mm",
        "slopes": ", ".join(f"{slope:.4g}" for slope in span.slopes),
    }
    return card("catenary", "Span", picture.svg(), pairs(rows))


def equilibrium(equilibrium: Equilibrium) -> str:
    """The hanging ply."""
    lines = list(equilibrium.points(17))
    side = flat(equilibrium.positions)
    picture = Picture(SIDE if side is SIDE else EYE, "the hanging ply")
    picture.lines(lines, QUIET).dots(equilibrium.positions, "currentColor", 3.5)
    forces = equilibrium.forces[np.isfinite(equilibrium.forces)]
    rows = {"status": equilibrium.status, "catenaries": str(len(lines))}
    if len(forces):
        rows["horizontal forces"] = f"{forces.min():.4g} to {forces.max():.4g} N"
    return card("hanging ply", "Equilibrium", picture.svg(), pairs(rows))


def ply(ply: Ply) -> str:
    """The flat ply with its grippers."""
    places = np.column_stack([ply.places, np.zeros(len(ply.places))])
    picture = Picture(PLAN, "the flat ply and its grippers")
    rings = [ring for ring in (ply.outline, *ply.holes) if ring is not None]
    for ring in rings:
        closed = np.concatenate([ring, ring[:1]])
        picture.lines([np.column_stack([closed, np.zeros(len(closed))])], "currentColor", 1.0)
    picture.lines([places[list(pair)] for pair in ply.catenaries], QUIET, 0.8)
    picture.dots(places, "currentColor", 3.5)
    u, v = (1e3 * side for side in ply.cell)
    rows = {"grippers": count(ply), "cell": f"{u:.4g} × {v:.4g} mm", "material": ply.material.name}
    return card("flat", "Ply", picture.svg(), pairs(rows))


# A curvature (1/m) of a fold: where the moment is a curve, the card says its value there.
BENT = 20.0


def material(material: Material) -> str:
    """The numbers of a material."""
    area = "²" if material.areal else ""
    rows = {"mass": f"{material.mass:.4g} kg/m{area}"}
    if material.flexural_rigidity is not None:
        rows["flexural rigidity"] = f"{material.flexural_rigidity:.4g} N·m²"
    if material.bending_rigidity is not None:
        warp, weft = material.bending_rigidity
        rows["bending rigidity"] = f"{warp:.4g} N·m along warp, {weft:.4g} N·m along weft"
        bent = material.moment([BENT])
        if bent is not None and not np.allclose(bent[0], np.multiply(BENT, (warp, weft))):
            rows["bending rigidity"] += ", at rest"
            warp, weft = bent[0]
            rows[f"moment at {BENT:g} 1/m"] = f"{warp:.4g} N along warp, {weft:.4g} N along weft"
    if material.locking_angle is not None:
        rows["locking angle"] = f"{np.rad2deg(material.locking_angle):.4g}°"
    rows["source"] = material.source
    return card("material", material.name, "", pairs(rows))


def give() -> None:
    """Gives the classes what a notebook asks them for."""
    shown: dict[type, Callable[[Any], str]] = {
        _plydrape.Scene: scene,
        _plydrape.Result: result,
        _plydrape.Plan: plan,
        _plydrape.Sheet: sheet,
        _plydrape.Span: span,
        _plydrape.Equilibrium: equilibrium,
        _plydrape.Ply: ply,
        _plydrape.Material: material,
    }
    for kind, show in shown.items():
        give_one(kind, _repr_html_=_method(show))


def _method(show: Callable[[Any], str]) -> Callable[[Any], str]:
    def _repr_html_(value: Any) -> str:
        return show(value)

    return _repr_html_
