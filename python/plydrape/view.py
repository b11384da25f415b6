"""A step of a result as a scene of PyVista: to turn, to cut, to add to, to take pictures of.

PyVista is installed by `pip install pyvista`. Without a display set
`pyvista.OFF_SCREEN = True` first; VTK 9.4 and later then draws by EGL or OSMesa, without X. VTK has
one setting for all plotters of how it draws faces in one place; a scene sets it to polygon offset.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from plydrape import _shapes
from plydrape._extra import load

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pyvista
    from numpy.typing import NDArray

    from plydrape import Mold, Result, Sheet, Surface

__all__ = ["meshes", "mold_mesh", "scene3d", "sheet3d", "sheet_mesh", "surface_mesh"]

RED, BLACK, MOLD, TARGET, DARK = "#d61921", "#14161a", "#d6dce4", "#586270", "#2d323a"
FORCE = "#1a5fb4"
TOUCHING = 0.1
"""Gap up to which the ply counts as touching in a picture (mm): the low end of its colors."""
SIDES = 10
"""Sides of a tube."""
CLEAR = 10.0
"""Height from which on all of a sheet has one color (mm): the high end of its colors."""
AIR = "#b4b9c1"
SHEET_NAMES = {
    "height": "height over the mold (mm)",
    "landing": "lands in step",
    "shear": "shear (deg)",
}
NAMES = {"gap": "gap to the mold (mm)", "height": "height z (mm)", "shear": "shear (deg)"}


def scene3d(
    result: Result,
    step: int = -1,
    *,
    color: Literal["gap", "height", "shear"] | None = None,
    limits: tuple[float, float] | None = None,
    mold: bool = True,
    diagonals: bool = True,
    intervals: int = 8,
    plotter: pyvista.Plotter | None = None,
) -> pyvista.Plotter:
    """Mold, ply and grippers of a step by the model that decides, in m.

    Each is an actor of the plotter by its name: "mold", "target", "ply", "grippers", and of
    catenaries "edges", "diagonals" and "touching". Lines are tubes and grippers plates, only to be
    seen well. The ply holds "gap_mm" and "height_mm" at its points and "shear_deg" in its
    triangles.

    Parameters
    ----------
    result : Result
        The result.
    step : int, default -1
        The step, from 1; -1 is the last, -2 the one before.
    color : {"gap", "height", "shear"}, optional
        What the ply's color tells; if None the gap to a curved mold, else the height. The
        gap has a logarithmic scale from 0.1 mm on.
    limits : tuple[float, float], optional
        Ends of the colors in the unit of the bar; if None those of this step. For pictures
        that are to be compared.
    mold : bool, default True
        Whether to show the mold.
    diagonals : bool, default True
        Whether to show the diagonals.
    intervals : int, default 8
        Pieces of a cell along each side, 1 or more.
    plotter : pyvista.Plotter, optional
        Where to add them; if None a new plotter that looks at them from the front left.

    Returns
    -------
    pyvista.Plotter
        The plotter: `.show()` opens it, `.screenshot("step.png")` writes it.

    Raises
    ------
    ImportError
        PyVista is not installed.
    ValueError
        No such step, none of a sheet that was not kept, or a color that the result cannot have.

    Examples
    --------
    >>> import pyvista
    >>> pyvista.OFF_SCREEN = True
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene)
    >>> plotter = plydrape.view.scene3d(result, 26, color="height")
    >>> plotter.actors["ply"].mapper.dataset.n_points
    341
    >>> plotter.close()

    """
    pv = load("pyvista", package="pyvista", name="PyVista")
    last, chosen = len(result.times), _step(result, step)
    if intervals < 1:
        raise ValueError(f"{intervals} intervals in a cell; 1 or more make a surface")
    curved = result.mold is not None and result.mold.kind != "plane"
    kind = color or ("gap" if curved else "height")
    if kind not in NAMES:
        raise ValueError(
            f'the ply can have the color of its "gap", "height" or "shear", not "{kind}"'
        )
    if kind == "gap" and result.mold is None:
        raise ValueError('without a mold there is no gap; choose color="height" or "shear"')

    new = plotter is None
    out: Any = pv.Plotter() if plotter is None else plotter
    if mold:
        _mold(pv, out, result, 0.05 * _shapes.radius(result))
    ply = _shapes.ply(result, chosen, intervals)
    if ply is not None:
        _ply(pv, out, ply, kind, limits)
    lines = _shapes.lines(result, chosen)
    edges = _shapes.edges(result.grid)
    radius = _shapes.radius(result)
    _lines(pv, out, lines[:edges], "edges", RED, 0.07 * radius)
    if diagonals:
        _lines(pv, out, lines[edges:], "diagonals", RED, 0.04 * radius)
    if lines:
        _lines(pv, out, result.contact_lines(chosen), "touching", RED, 0.13 * radius)
    discs = _prisms(pv, _shapes.discs(result, chosen, radius), 0.28 * radius)
    out.add_mesh(discs, color=BLACK, name="grippers")
    if new:
        _look(out, f"{result.title}: step {chosen} of {last}")
    shown: pyvista.Plotter = out
    return shown


def sheet3d(
    result: Result,
    step: int = -1,
    *,
    color: Literal["height", "landing", "shear"] | None = None,
    limits: tuple[float, float] | None = None,
    mold: bool = True,
    forces: bool = True,
    plotter: pyvista.Plotter | None = None,
) -> pyvista.Plotter:
    """The sheet of a step with its mold, its pads and the forces on them, in m.

    Each is an actor of the plotter by its name: "mold", "target", "sheet", "grippers", "forces".
    The sheet holds "height_mm", "contact" and "landing_step" at its nodes, nan where there is none,
    and "shear_deg" in its cells; with the color of the landing its quarters of cells hold
    "landing_step". The longest arrow is 0.7 of the shorter side of a cell between grippers; the
    title says how large its force is.

    Parameters
    ----------
    result : Result
        The result, of a drape with the sheet.
    step : int, default -1
        The step, from 1; -1 is the last that was kept, -2 the one before.
    color : {"height", "landing", "shear"}, optional
        What the sheet's color tells; if None the height over the mold, without a mold the
        shear. The height has a logarithmic scale from 0.1 to 10 mm, the same for all results.
    limits : tuple[float, float], optional
        Ends of the colors in the unit of the bar; if None those of this step.
    mold : bool, default True
        Whether to show the mold.
    forces : bool, default True
        Whether to show the forces of the sheet on the pads.
    plotter : pyvista.Plotter, optional
        Where to add them; if None a new plotter that looks at them from the front left.

    Returns
    -------
    pyvista.Plotter
        The plotter: `.show()` opens it, `.screenshot("step.png")` writes it.

    Raises
    ------
    ImportError
        PyVista is not installed.
    ValueError
        The result has no sheet, none of that step, or a color that it cannot have.

    Examples
    --------
    >>> import pyvista
    >>> pyvista.OFF_SCREEN = True
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene, model="sheet")
    >>> plotter = plydrape.view.sheet3d(result)
    >>> plotter.actors["sheet"].mapper.dataset.n_points
    341
    >>> plotter.close()

    """
    pv = load("pyvista", package="pyvista", name="PyVista")
    sheet = result.sheet
    if sheet is None:
        raise ValueError(
            'the result has no sheet; drape its scene with model="sheet" or also="sheet"'
        )
    state = _shapes.state(sheet, step)
    chosen = int(sheet.steps[state])
    kind = color or ("shear" if result.mold is None else "height")
    if kind not in SHEET_NAMES:
        raise ValueError(
            f'the sheet can have the color of its "height", "landing" or "shear", not "{kind}"'
        )
    if kind != "shear" and result.mold is None:
        raise ValueError(f'without a mold there is no {kind}; choose color="shear"')

    new = plotter is None
    out: Any = pv.Plotter() if plotter is None else plotter
    radius = _shapes.radius(result)
    if mold:
        _mold(pv, out, result, 0.05 * radius)
    mesh = sheet_mesh(sheet, chosen)
    parts = None
    if kind == "landing":
        # the part of a cell that is nearest to a node has its step, as long as that is not to come
        cells, landing = np.asarray(sheet.cells, np.int64), mesh["landing_step"]
        parts = _quads(pv, _shapes.quarters(np.asarray(mesh.points), cells).reshape(-1, 3))
        parts.cell_data["landing_step"] = np.where(landing <= chosen, landing, np.nan)[
            cells
        ].ravel()
    _sheet(out, mesh, parts, kind, limits)

    pads = np.asarray(sheet.grippers)[state]
    angle = np.linspace(0.0, 2.0 * np.pi, 28, endpoint=False)
    arm = 0.6 * radius * np.stack([np.cos(angle), np.sin(angle), np.zeros(28)], axis=-1)
    discs = pads[:, None] + _shapes.turned(np.asarray(sheet.pad_quaternions)[state], arm)
    out.add_mesh(_prisms(pv, discs, 0.2 * radius), color=BLACK, name="grippers")
    force = np.asarray(sheet.pad_forces)[state]
    most = float(np.linalg.norm(force, axis=1).max())
    title = f"{result.title}: step {chosen} of {len(result.times)}"
    if forces and most > 0.0:
        arrows = pv.PolyData(pads)
        arrows["force_N"] = force
        shape = pv.Arrow(tip_length=0.22, tip_radius=0.07, shaft_radius=0.025)
        scaled = arrows.glyph(
            orient="force_N", scale="force_N", factor=0.7 * min(result.cell) / most, geom=shape
        )
        out.add_mesh(scaled, color=FORCE, name="forces")
        title += f", forces up to {most:.3g} N"
    if new:
        _look(out, title)
    shown: pyvista.Plotter = out
    return shown


def meshes(result: Result, step: int = -1, *, intervals: int = 8) -> pyvista.MultiBlock:
    """Mold, grippers and ply of a step as meshes with their numbers, in m.

    "grippers" are points with "tilt_deg", the "normal" of the ply and the "load_N" on them, by the
    model that decides; "sheet" is that of `sheet_mesh`, where the sheet was draped. Where
    catenaries were, "ply" has "gap_mm" and "height_mm" at its points and "shear_deg" in its
    triangles, and "catenaries" has "force_n" and "slack_mm" of each line. What is not known is nan.

    Parameters
    ----------
    result : Result
        The result.
    step : int, default -1
        The step, from 1; -1 is the last, -2 the one before.
    intervals : int, default 8
        Pieces of a cell along each side, 1 or more.

    Returns
    -------
    pyvista.MultiBlock
        The blocks by their names, as far as the result has them.

    Raises
    ------
    ImportError
        PyVista is not installed.
    ValueError
        No such step.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> blocks = plydrape.view.meshes(plydrape.simulate(scene, also="catenaries"), 26)
    >>> blocks["catenaries"].n_cells, blocks["grippers"].n_points
    (16, 8)

    """
    pv = load("pyvista", package="pyvista", name="PyVista")
    chosen = _step(result, step)
    out = pv.MultiBlock()
    surface = result.mold_surface()
    if surface is not None and len(surface[1]) > 0:
        out["mold"] = _triangles(pv, surface[0], surface[1].astype(np.int64))
    hanging = _shapes.hanging(result)
    if hanging is not None and chosen <= len(hanging.times):
        ply = _shapes.between(result, chosen, intervals)
        if ply is not None:
            out["ply"] = _ply_mesh(pv, ply)
        catenaries = _polylines(pv, result.lines(chosen))
        catenaries.cell_data["force_n"] = result.forces[chosen - 1]
        catenaries.cell_data["slack_mm"] = result.slack_mm[chosen - 1]
        out["catenaries"] = catenaries
    grippers = pv.PolyData(result.positions[chosen - 1])
    grippers.point_data["tilt_deg"] = result.tilts_deg[chosen - 1]
    up = np.array([[0.0, 0.0, 1.0]])
    grippers.point_data["normal"] = _shapes.turned(result.quaternions[chosen - 1], up)[:, 0]
    grippers.point_data["load_N"] = result.loads[chosen - 1]
    out["grippers"] = grippers
    sheet = result.sheet
    if sheet is not None and chosen in sheet.steps:
        out["sheet"] = sheet_mesh(sheet, chosen)
    blocks: pyvista.MultiBlock = out
    return blocks


def sheet_mesh(sheet: Sheet, step: int = -1) -> pyvista.PolyData:
    """The sheet of a step as a mesh of its cells, in m.

    It has "height_mm", "contact" and "landing_step" at its nodes, nan where there is none, and
    "shear_deg" in its cells.

    Parameters
    ----------
    sheet : Sheet
        The sheet.
    step : int, default -1
        The step, from 1; -1 is the last that was kept, -2 the one before.

    Returns
    -------
    pyvista.PolyData
        The mesh.

    Raises
    ------
    ImportError
        PyVista is not installed.
    ValueError
        No state of that step was kept.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> mesh = plydrape.view.sheet_mesh(plydrape.simulate(scene).sheet)
    >>> mesh.n_points, float(mesh["height_mm"].max().round(1))
    (341, 4.5)

    """
    pv = load("pyvista", package="pyvista", name="PyVista")
    state = _shapes.state(sheet, step)
    mesh = _quads(pv, sheet.positions[state], np.asarray(sheet.cells, np.int64))
    mesh.point_data["height_mm"] = sheet.heights[state] * 1e3
    mesh.point_data["contact"] = sheet.contact[state]
    landing = np.asarray(sheet.landing_step, float)
    landing[landing == 0.0] = np.nan
    mesh.point_data["landing_step"] = landing
    mesh.cell_data["shear_deg"] = np.rad2deg(sheet.shear[state])
    made: pyvista.PolyData = mesh
    return made


def surface_mesh(surface: Surface) -> pyvista.StructuredGrid:
    """The ply of a step as a structured grid, in m, with "gap_mm" at its points.

    Parameters
    ----------
    surface : Surface
        The surface.

    Returns
    -------
    pyvista.StructuredGrid
        The grid: points along u, along v, and 1.

    Raises
    ------
    ImportError
        PyVista is not installed.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/04_dome/scene.toml")
    >>> surface = plydrape.simulate(scene, model="catenaries").surface(-1, intervals=2)
    >>> plydrape.view.surface_mesh(surface).dimensions
    (7, 7, 1)

    """
    pv = load("pyvista", package="pyvista", name="PyVista")
    grid: pyvista.StructuredGrid = pv.StructuredGrid()
    grid.points = surface.points
    grid.dimensions = (*surface.size, 1)
    grid.point_data["gap_mm"] = surface.gap * 1e3
    return grid


def mold_mesh(
    mold: Mold,
    low: Sequence[float | str],
    high: Sequence[float | str],
    most: int = 20_000,
) -> pyvista.PolyData:
    """A mold over a rectangle of the plan as triangles, in m.

    Parameters
    ----------
    mold : Mold
        The mold.
    low : sequence of float or str
        Lowest x and y (m, or texts with a unit).
    high : sequence of float or str
        Highest x and y (m, or texts with a unit).
    most : int, default 20000
        About how many triangles at most.

    Returns
    -------
    pyvista.PolyData
        The mesh.

    Raises
    ------
    ImportError
        PyVista is not installed.

    Examples
    --------
    >>> mold = plydrape.Scene.read("examples/04_dome/scene.toml").mold
    >>> plydrape.view.mold_mesh(mold, (-0.1, -0.1), (0.1, 0.1), 200).n_cells <= 200
    True

    """
    pv = load("pyvista", package="pyvista", name="PyVista")
    points, triangles = mold.patch(low, high, most=most)
    made: pyvista.PolyData = _triangles(pv, points, triangles.astype(np.int64))
    return made


def _step(result: Result, step: int) -> int:
    """The number of a step, from 1; -1 is the last."""
    last = len(result.times)
    chosen = step if step > 0 else last + 1 + step
    if step == 0 or not 1 <= chosen <= last:
        raise ValueError(f"the result has no step {step}; its steps are 1 to {last}")
    return chosen


def _sheet(out: Any, mesh: Any, parts: Any, kind: str, limits: tuple[float, float] | None) -> None:
    """The sheet's cells and a bar of their colors; the order of landing is that of `parts`."""
    name = {"height": "height_mm", "landing": "landing_step", "shear": "shear_deg"}[kind]
    if kind == "height":
        low, high = TOUCHING, CLEAR
    elif kind == "shear":
        high = max(float(np.abs(mesh[name]).max()), 1e-3)
        low = -high
    else:
        landed = mesh[name][np.isfinite(mesh[name])]
        low, high = (landed.min(), landed.max()) if len(landed) > 0 else (0.0, 1.0)
        high = max(high, low + 1.0)
    low, high = limits or (float(low), float(high))
    labels = {"height": 3, "shear": 5, "landing": int(np.clip(high - low + 1.0, 2, 4))}[kind]
    digits = "%.0f" if kind == "landing" else "%.3g"
    bar: dict[str, Any] = {"title": SHEET_NAMES[kind] + "\n", "color": DARK, "fmt": digits}
    bar |= {"title_font_size": 20, "label_font_size": 18, "n_labels": labels}
    bar |= {"width": 0.4, "height": 0.08, "position_x": 0.55, "position_y": 0.03}
    out.add_mesh(
        mesh if parts is None else parts,
        scalars=name,
        cmap="PuOr_r" if kind == "shear" else "viridis",
        clim=(low, high),
        log_scale=kind == "height",
        nan_color=AIR,
        lighting=kind == "shear",
        show_edges=parts is None,
        edge_color="#ffffff",
        edge_opacity=0.25,
        show_scalar_bar=True,
        scalar_bar_args=bar,
        name="sheet",
    )


def _mold(pv: Any, out: Any, result: Result, radius: float) -> None:
    """The mold under and around the ply, and where the ply should end on it."""
    surface = result.mold_surface()
    if surface is not None and len(surface[1]) > 0:
        mesh = _triangles(pv, surface[0], surface[1].astype(np.int64))
        out.add_mesh(mesh, color=MOLD, smooth_shading=True, ambient=0.12, diffuse=0.95, name="mold")
        # the mold is drawn as if it were a hair farther away, so that a ply on it covers it
        mapper = out.actors["mold"].mapper
        mapper.SetResolveCoincidentTopologyToPolygonOffset()
        mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 60.0)
        _lines(pv, out, _shapes.outline(result.net), "target", TARGET, radius)


def _ply(
    pv: Any, out: Any, ply: _shapes.Ply, kind: str, limits: tuple[float, float] | None
) -> None:
    """The ply with its values and a bar of its colors."""
    mesh = _ply_mesh(pv, ply)
    name = {"gap": "gap_mm", "height": "height_mm", "shear": "shear_deg"}[kind]
    values = mesh[name]
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    if kind == "gap":
        low, high = TOUCHING, max(10.0 ** np.ceil(np.log10(max(high, TOUCHING))), 10.0 * TOUCHING)
    elif kind == "shear":
        low, high = 0.0, max(high, 1e-3)
    elif high - low < 1.0:
        low, high = (low + high - 1.0) / 2.0, (low + high + 1.0) / 2.0
    low, high = limits or (low, high)
    bar: dict[str, Any] = {"title": NAMES[kind] + "\n", "color": DARK, "fmt": "%.3g"}
    bar |= {"title_font_size": 20, "label_font_size": 18, "n_labels": 5}
    bar |= {"width": 0.4, "height": 0.08, "position_x": 0.55, "position_y": 0.03}
    if kind == "gap":
        # between whole powers of ten the labels are those powers
        bar["n_labels"] = max(2, 1 + round(float(np.log10(high / low))))
    out.add_mesh(
        mesh,
        scalars=name,
        cmap="viridis",
        clim=(low, high),
        log_scale=kind == "gap",
        lighting=False,
        show_scalar_bar=True,
        scalar_bar_args=bar,
        name="ply",
    )


def _lines(
    pv: Any, out: Any, lines: Sequence[NDArray[np.float64]], name: str, ink: str, radius: float
) -> None:
    """Polylines (N, 3) as tubes, so that they stand out of the surface that they lie in."""
    kept = [line for one in lines if len(line := _apart(one)) > 1]
    if not kept:
        return
    tubes = _polylines(pv, kept).tube(radius=radius, n_sides=SIDES)
    out.add_mesh(tubes, color=ink, lighting=False, name=name)


def _polylines(pv: Any, lines: Sequence[NDArray[np.float64]]) -> Any:
    """Polylines (N, 3), a cell each."""
    ends = np.cumsum([0, *(len(line) for line in lines)])
    cells = [np.r_[b - a, np.arange(a, b)] for a, b in pairwise(ends)]
    return pv.PolyData(np.concatenate(lines), lines=np.concatenate(cells))


def _ply_mesh(pv: Any, ply: _shapes.Ply) -> Any:
    """The ply between the catenaries with its numbers."""
    mesh = _triangles(pv, ply.points, ply.triangles)
    mesh.point_data["gap_mm"] = ply.gap * 1e3
    mesh.point_data["height_mm"] = ply.points[:, 2] * 1e3
    mesh.cell_data["shear_deg"] = ply.shear_deg
    return mesh


def _apart(line: NDArray[np.float64]) -> NDArray[np.float64]:
    """A polyline without points on the one before."""
    far = np.linalg.norm(np.diff(line, axis=0), axis=1) > 1e-7
    return line[np.r_[True, far]]


def _triangles(pv: Any, points: NDArray[np.float64], triangles: NDArray[np.int64]) -> Any:
    faces = np.column_stack([np.full(len(triangles), 3), triangles])
    return pv.PolyData(np.asarray(points, float), faces.ravel())


def _quads(pv: Any, points: NDArray[np.float64], cells: NDArray[np.int64] | None = None) -> Any:
    """Cells (C, 4) of points; if None each four points are one."""
    corners = np.arange(len(points)).reshape(-1, 4) if cells is None else cells
    return pv.PolyData(points, np.insert(corners, 0, 4, axis=1).ravel())


def _prisms(pv: Any, rims: NDArray[np.float64], thick: float) -> Any:
    """Flat polygons (G, N, 3) as plates of a thickness."""
    count, corners = rims.shape[:2]
    normal = np.cross(rims[:, 1] - rims[:, 0], rims[:, 2] - rims[:, 1])
    normal *= 0.5 * thick / np.linalg.norm(normal, axis=1, keepdims=True)
    points = np.stack([rims - normal[:, None], rims + normal[:, None]], axis=1)
    number = np.arange(count * 2 * corners).reshape(count, 2, corners)
    low, high = number[:, 0], number[:, 1]
    walls = np.stack([low, np.roll(low, -1, 1), np.roll(high, -1, 1), high], axis=-1)
    plates = np.concatenate([low[:, ::-1], high])
    faces = [np.column_stack([np.full(len(plates), corners), plates]).ravel()]
    faces.append(np.insert(walls.reshape(-1, 4), 0, 4, axis=1).ravel())
    return pv.PolyData(points.reshape(-1, 3), np.concatenate(faces))


def _look(out: Any, title: str) -> None:
    """White ground, axes, a title, and the view of the report."""
    out.set_background("white")
    out.add_text(title, position="upper_left", font_size=10, color=DARK, name="title")
    out.add_axes(color=DARK, line_width=3)
    out.enable_parallel_projection()
    out.camera_position = [(0.42, -0.78, 0.48), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)]
    out.reset_camera()
    out.camera.zoom(1.15)
