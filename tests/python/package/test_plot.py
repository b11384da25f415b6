"""What the figures draw is what the result holds."""

from __future__ import annotations

import sys
from io import BytesIO
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, cast

import matplotlib as mpl
import numpy as np
import plydrape
import pytest
from matplotlib import colormaps
from matplotlib.backends.backend_agg import FigureCanvasAgg
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection
from plydrape import plot

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import NDArray
    from plydrape import Net


def named(figure: Any, gid: str, panel: int = 0) -> Any:
    """The artist of this name in a panel, or None."""
    found = [artist for artist in figure.axes[panel].get_children() if artist.get_gid() == gid]
    assert len(found) < 2, f"{len(found)} artists are named {gid}"
    return found[0] if found else None


def segments(figure: Any, gid: str, panel: int = 0) -> list[NDArray[np.float64]]:
    """The polylines (N, 3) of a name, in mm."""
    lines = named(figure, gid, panel)
    assert isinstance(lines, Line3DCollection)
    return [np.asarray(line) for line in lines._segments3d]


def corners(figure: Any, gid: str, panel: int = 0) -> NDArray[np.float64]:
    """The polygons (N, corners, 3) of a name, in mm."""
    faces = named(figure, gid, panel)
    assert isinstance(faces, Poly3DCollection)
    return np.asarray(faces._faces)


def cells(figure: Figure, panel: int = 0) -> Any:
    """The colored cells of a shear map."""
    return figure.axes[panel].collections[0]


def drawn(figure: Figure) -> bytes:
    """The figure as PNG: it can be drawn without a display."""
    page = BytesIO()
    figure.savefig(page, format="png", dpi=60)
    return page.getvalue()


def painter(figure: Figure) -> Any:
    """What measures texts, after the layout is done."""
    figure.draw_without_rendering()
    return cast(Any, FigureCanvasAgg(figure)).get_renderer()


def texts(figure: Figure) -> list[str]:
    """What is written above the panels."""
    return [text.get_text() for text in figure.texts]


def test_catenaries_are_drawn_where_they_hang(flat: plydrape.Result) -> None:
    """Every point of every line, in mm; edges first, then diagonals."""
    figure = plot.steps(flat, [1, 26], elev="60 deg")
    for panel, step in enumerate((1, 26)):
        lines = flat.lines(step)
        shown = segments(figure, "edges", panel) + segments(figure, "diagonals", panel)
        assert len(lines) == len(shown) == 16
        for line, drawing in zip(lines, shown, strict=True):
            assert drawing == pytest.approx(line * 1e3)


def test_grippers_are_discs_about_their_places(flat: plydrape.Result) -> None:
    """The middle is the position, the normal makes the tilt with the vertical."""
    figure = plot.steps(flat, [4], elev="60 deg")
    discs = corners(figure, "grippers")
    assert discs.mean(axis=1) == pytest.approx(flat.positions[3] * 1e3)
    radius = np.linalg.norm(discs - discs.mean(axis=1, keepdims=True), axis=2)
    assert radius == pytest.approx(np.full(radius.shape, 12.0))
    # columns of the rotation that a quaternion is: u along x, v along y
    x, y, z, w = flat.quaternions[3].T
    u = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)], axis=-1)
    v = np.stack([2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)], axis=-1)
    assert discs[:, 0] == pytest.approx(flat.positions[3] * 1e3 + 12.0 * u)
    assert discs[:, 7] == pytest.approx(flat.positions[3] * 1e3 + 12.0 * v)
    normal = np.cross(discs[:, 0] - discs.mean(axis=1), discs[:, 7] - discs.mean(axis=1))
    up = normal[:, 2] / np.linalg.norm(normal, axis=1)
    assert np.rad2deg(np.arccos(up)) == pytest.approx(flat.tilts_deg[3], abs=1e-4)
    assert flat.tilts_deg[3].max() > 30.0


@pytest.mark.parametrize("color", ["height", "gap", "shear"])
def test_the_ply_has_the_color_of_its_values(shallow: plydrape.Result, color: str) -> None:
    """Triangles are the surface's; their colors are viridis of what the color bar says."""
    kind, step = cast(Any, color), 30 if color == "shear" else 27
    figure = plot.steps(shallow, [step], color=kind, elev="89 deg")
    faces, surface = corners(figure, "ply"), shallow.surface(step, intervals=8)
    assert faces == pytest.approx(surface.points[surface.triangles] * 1e3)
    low, high = figure.axes[-1].get_xlim()
    middles = surface.points[surface.triangles].mean(axis=1)
    if color == "shear":
        # the cell that a triangle is in, by its number along u and v
        j, i = np.divmod(surface.triangles.astype(int), surface.size[0])
        i, j = (np.floor(n.mean(axis=1) / 8).astype(int) for n in (i, j))
        share = np.abs(shallow.shear_deg[step - 1][j, i]) / high
        assert low == 0.0 and high == pytest.approx(np.abs(shallow.shear_deg[step - 1]).max())
    elif color == "height":
        share = (middles[:, 2] * 1e3 - low) / (high - low)
    else:
        gap = np.maximum(surface.gap[surface.triangles].mean(axis=1) * 1e3, 0.1)
        share = np.log(gap / low) / np.log(high / low)
        assert low == pytest.approx(0.1) and high == pytest.approx(gap.max())
    assert share.std() > 0.05
    inks = named(figure, "ply")._facecolor3d
    assert inks == pytest.approx(colormaps["viridis"](share), abs=0.02)


def test_contact_is_marked(flat: plydrape.Result) -> None:
    """None at the start; at the first contact rings at the diagonals of summary.first_contact."""
    figure = plot.steps(flat, [1, 26, 30])
    assert named(figure, "contact", 0) is None and not segments(figure, "touching", 0)
    rings = np.stack(named(figure, "contact", 1).get_data_3d(), axis=-1)
    ends = [
        [flat.positions[25, i + 4 * j] for i, j in (line["from"], line["to"])]
        for line in flat.summary["catenaries"]["first_contact"]
    ]
    middles = np.mean(ends, axis=1) * 1e3
    assert len(rings) == len(middles) == 3
    assert rings[:, 2] == pytest.approx(0.0, abs=1e-9)
    assert np.linalg.norm((rings - middles)[:, :2], axis=1).max() < 20.0
    along = sum(
        np.linalg.norm(np.diff(line, axis=0), axis=1).sum()
        for line in segments(figure, "touching", 2)
    )
    assert along > 0.9 * flat.contact[29].sum() * 1e3 > 0.0


def test_the_mold_hides_what_is_behind_it() -> None:
    """A hemisphere seen from the front: what is behind is hidden, what is on it or above is not."""
    from plydrape.plot._hidden import Screen, axes

    angle, height = np.meshgrid(np.linspace(0, 2 * np.pi, 49), np.linspace(0, np.pi / 2, 13))
    points = np.stack(
        [np.cos(angle) * np.cos(height), np.sin(angle) * np.cos(height), np.sin(height)], axis=-1
    )
    k = np.arange(12)[:, None] * 49 + np.arange(48)
    halves = [np.stack([k, k + 1, k + 50], -1), np.stack([k, k + 50, k + 49], -1)]
    triangles = np.concatenate(halves).reshape(-1, 3)
    view = axes(20.0, -90.0)
    assert view @ view.T == pytest.approx(np.eye(3))
    screen = Screen(points.reshape(-1, 3), triangles, view, 0.05)
    places = np.array([[0, -1, 0], [0, 1, 0], [0, 0, 1], [0, 1, 1.5], [2, 0, 0], [0, 1.5, 0.1]])
    assert screen.hides(places.astype(float)).tolist() == [False, True, False, False, False, True]


def test_telling_steps_are_chosen(flat: plydrape.Result, dome: plydrape.Result) -> None:
    """Start, first shear, first contact, end, and the middle of the longest stretch."""
    assert texts(plot.steps(flat)) == [
        "a  step 1, start",
        "b  step 5, first shear",
        "c  step 15",
        "d  step 26, first contact",
        "e  step 30, end",
    ]
    words = texts(plot.steps(dome, width="single"))
    assert any("first contact" in word for word in words) and words[0] == "a  step 1, start"


def test_panels_share_frame_and_scale(dome: plydrape.Result) -> None:
    """Equal aspect: the box has the ratios of its limits, the same in each panel."""
    figure = plot.steps(dome, [1, 20, 30])
    panels = cast(Any, figure.axes[:3])
    limits = [(p.get_xlim3d(), p.get_ylim3d(), p.get_zlim3d()) for p in panels]
    assert limits[0] == limits[1] == limits[2]
    spans = np.ptp(np.array(limits[0]), axis=1)
    for panel in panels:
        box = (
            panel.get_box_aspect()
            if hasattr(panel, "get_box_aspect") and False
            else panel._box_aspect
        )
        assert box / box[0] == pytest.approx(spans / spans[0])


@pytest.mark.parametrize(
    ("elev", "width"), [("5 deg", "double"), (0.5, "single"), ("75 deg", "120 mm")]
)
def test_nothing_leaves_the_sheet(dome: plydrape.Result, elev: Any, width: Any) -> None:
    """Every text and every panel's box is inside; texts of the first panel do not overlap."""
    figure = plot.steps(dome, [1, 15, 30], elev=elev, width=width)
    renderer = painter(figure)
    sheet = figure.bbox
    for text in [*figure.texts, *figure.axes[0].texts]:
        box = text.get_window_extent(renderer)
        assert box.x0 >= sheet.x0 - 1 and box.x1 <= sheet.x1 + 1, text.get_text()
        assert box.y0 >= sheet.y0 - 1 and box.y1 <= sheet.y1 + 1, text.get_text()
    legend = figure.legends[0].get_window_extent(renderer)
    for text in figure.axes[0].texts:
        assert not legend.overlaps(text.get_window_extent(renderer)), text.get_text()


@pytest.mark.parametrize(
    ("width", "mm"), [("single", 89.0), ("double", 183.0), (0.12, 120.0), ("120 mm", 120.0)]
)
def test_widths_are_those_of_print(flat: plydrape.Result, width: Any, mm: float) -> None:
    """Of each kind of figure; the text is 8 pt or a little smaller."""
    for kind in ("steps", "measures", "shear"):
        figure = plot.plot(flat, cast(Any, kind), width=width)
        assert figure.get_figwidth() * 25.4 == pytest.approx(mm)
        assert figure.get_figheight() * 25.4 < 300.0
        words = [text for text in figure.findobj(mpl.text.Text) if text.get_text()]
        sizes = {float(text.get_fontsize()) for text in words}
        assert min(sizes) >= 6.5 and max(sizes) <= 8.0


def test_measures_are_those_of_the_result(flat: plydrape.Result) -> None:
    """Values, limits and judged steps of all that have a meaning, in the unit of the limit."""
    figure = plot.measures(flat)
    limits = flat.limits
    panels = {axes.get_title(loc="left"): k for k, axes in enumerate(figure.axes)}
    assert "outside workspace" not in panels and "force" not in panels
    cases = [
        ("slack", "slack_mm", 1.0, None, "mm"),
        ("slack ratio", "slack_ratio", 100.0, "slack_ratio", "%"),
        ("overstretch", "overstretch", 100.0, "overstretch", "%"),
        ("tilt", "tilt_deg", 1.0, "tilt", "deg"),
        ("position of landed points", "position_mm", 1.0, "position", "mm"),
        ("tilt rate", "tilt_rate_deg_s", 1.0, "tilt_rate", "deg/s"),
        ("horizontal force", "force_n", 1.0, None, "N"),
        ("contact share", "contact_share", 100.0, "contact_share", "%"),
        ("gripper distance", "gripper_distance_mm", 1.0, "gripper_distance", "mm"),
    ]
    for title, name, factor, limit, unit in cases:
        panel = panels[title]
        x, y = named(figure, "values", panel).get_data()
        assert x == pytest.approx(np.arange(1, 31))
        assert y == pytest.approx(flat.measures[name] * factor, nan_ok=True)
        assert figure.axes[panel].get_ylabel() == unit
        at, value = named(figure, "worst", panel).get_data()
        if limit is None:
            assert value[0] == np.nanmax(y) and named(figure, "limit", panel) is None
            continue
        judged = limits[limit]
        assert (at[0], value[0]) == (judged.step, pytest.approx(judged.value))
        assert named(figure, "limit", panel).get_ydata() == [judged.limit] * 2
        marker = named(figure, "worst", panel).get_marker()
        assert marker == ("o" if judged.kept else "X")
        low, high = figure.axes[panel].get_ylim()
        assert low <= min(judged.limit, np.nanmin(y)) and high >= max(judged.limit, np.nanmax(y))
    assert not limits["overstretch"].kept and limits["tilt"].kept


def test_measures_with_a_limit_come_first(flat: plydrape.Result) -> None:
    """Whatever is judged has its panel, before what is only looked at."""
    figure = plot.measures(flat)
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    bounded = [named(figure, "limit", k) is not None for k in range(len(titles))]
    assert bounded == sorted(bounded, reverse=True)
    measured = {measure.name: measure for measure in plydrape.measures()}
    assert titles[sum(bounded) :] == ["horizontal force", "slack", "gap"]
    judged = [measured[name] for name in flat.limits]
    of_steps = {measure.label for measure in judged if measure.key in flat.measures}
    assert of_steps == set(titles[: sum(bounded)])


def test_measures_run_over_time(dome: plydrape.Result) -> None:
    """The times of the steps, and the first contact at its time."""
    figure = plot.measures(dome, ["tilt_deg"], against="time")
    assert named(figure, "values").get_xdata() == pytest.approx(dome.times)
    assert figure.axes[0].get_xlabel() == "time (s)"
    first = dome.first_contact_step
    assert first is not None
    dotted = [line for line in figure.axes[0].lines if line.get_linestyle() == ":"]
    assert dotted[0].get_xdata() == pytest.approx([dome.times[first - 1]] * 2)


def test_measure_titles_do_not_overlap(flat: plydrape.Result) -> None:
    """Name and limit are beside each other, or above each other if they are too long."""
    for width in ("single", 0.12, "double", "30 cm"):
        figure = plot.measures(flat, width=cast(Any, width))
        renderer = painter(figure)
        for panel, axes in enumerate(figure.axes):
            bound = named(figure, "bound", panel)
            name = cast(Any, axes)._left_title.get_window_extent(renderer)
            assert name.x1 <= figure.bbox.x1
            if bound is not None:
                assert not name.overlaps(bound.get_window_extent(renderer)), bound.get_text()


def test_the_shear_map_colors_each_cell(shallow: plydrape.Result) -> None:
    """On the fabric at its u and v, from above at x and y; the ring is at the largest amount."""
    net = shallow.net
    assert net is not None
    figure = plot.shear_map(shallow)
    for panel in (0, 1):
        shown = cells(figure, panel)
        assert np.asarray(shown.get_array()) == pytest.approx(np.abs(net.shear_deg).ravel())
        assert shown.get_clim() == pytest.approx((0.0, np.abs(net.shear_deg).max()))
    paths = [path.vertices for path in cells(figure).get_paths()]
    step = np.array(net.mesh) * 1e3
    assert paths[1][0] == pytest.approx([0.0, step[1]]) and paths[1][2] == pytest.approx(
        [step[0], 2 * step[1]]
    )
    above = [path.vertices for path in cells(figure, 1).get_paths()]
    assert above[1][1] == pytest.approx(net.nodes[1, 1, :2] * 1e3)
    i, j = np.unravel_index(np.abs(net.shear_deg).argmax(), net.shear_deg.shape)
    x, y = named(figure, "largest").get_data()
    assert (x[0], y[0]) == pytest.approx(((i + 0.5) * step[0], (j + 0.5) * step[1]))


def test_a_signed_shear_map_has_white_at_zero(dome: plydrape.Result) -> None:
    """Both ends at the same amount, the values with their sign."""
    net = dome.net
    assert net is not None
    shown = cells(plot.shear_map(net, signed=True, view="plan", most="5 deg"))
    assert np.asarray(shown.get_array()) == pytest.approx(net.shear_deg.ravel())
    assert net.shear_deg.min() < 0.0 < net.shear_deg.max()
    assert shown.get_clim() == (-5.0, 5.0)
    assert shown.get_cmap()(0.5)[:3] == pytest.approx((0.97, 0.97, 0.97), abs=0.02)


def test_cells_without_a_node_stay_white() -> None:
    """A net with a missing corner: its cell is left out, the others keep their colors."""
    u, v = np.meshgrid(np.arange(4) * 0.1, np.arange(3) * 0.2, indexing="ij")
    nodes = np.stack([u, v, 0 * u], axis=-1)
    nodes[3, 2] = np.nan
    shear = np.arange(6, dtype=float).reshape(3, 2)
    shear[2, 1] = np.nan
    net = cast("Net", SimpleNamespace(nodes=nodes, shear_deg=shear, mesh=np.array([0.1, 0.2])))
    shown = cells(plot.shear_map(net), 1)
    assert np.asarray(shown.get_array()) == pytest.approx([0, 1, 2, 3, 4])


def test_a_strip_without_mold_is_drawn(strip: plydrape.Result) -> None:
    """Lines and grippers; no surface, no colors, no shear to map."""
    figure = plot.steps(strip)
    assert named(figure, "ply") is None and named(figure, "mold") is None
    assert len(segments(figure, "edges")) == strip.grid[0] - 1
    drawn(figure)
    drawn(plot.measures(strip))
    with pytest.raises(ValueError, match="without a mold there is no gap"):
        plot.steps(strip, color="gap")
    with pytest.raises(ValueError, match="no ideal drape"):
        plot.shear_map(strip)


def test_bad_wishes_are_refused(flat: plydrape.Result) -> None:
    """With what there is instead."""
    wishes: list[tuple[str, dict[str, Any], str]] = [
        ("steps", {"steps": [0]}, "no step 0; its steps are 1 to 30"),
        ("steps", {"steps": [31]}, "no step 31"),
        ("steps", {"steps": []}, "at least one step"),
        ("steps", {"steps": list(range(1, 20))}, "too many"),
        ("steps", {"color": "speed"}, '"gap", "height" or "shear"'),
        ("steps", {"elev": "91 deg"}, "no view"),
        ("steps", {"columns": 0}, "columns"),
        ("steps", {"width": "triple"}, '"single", "double"'),
        ("measures", {"width": 3.0}, "40 to 1000 mm"),
        ("measures", {"names": ["slck_mm"]}, 'no measure "slck_mm"; there are overstretch'),
        ("measures", {"names": ["workspace_mm"]}, "no value at any step"),
        ("measures", {"names": []}, "at least one measure"),
        ("measures", {"against": "speed"}, '"step" or "time"'),
        ("shear", {"view": "side"}, '"fabric", "plan" and "both"'),
        ("shear", {"most": -1.0}, "cannot end"),
        ("movie", {}, '"steps", "measures", "shear" or "sheet"'),
    ]
    for kind, options, message in wishes:
        with pytest.raises(ValueError, match=message):
            plot.plot(flat, cast(Any, kind), **options)


def test_nothing_of_the_users_is_touched(flat: plydrape.Result) -> None:
    """Settings and figures of pyplot stay; the user's style does not reach our figure."""
    import matplotlib.pyplot as plt

    plt.switch_backend("Agg")
    plt.close("all")
    own = plt.figure()
    wishes: dict[Any, Any] = {
        "font.size": 30.0,
        "font.weight": "bold",
        "axes.facecolor": "red",
        "grid.alpha": 0.1,
    }
    with mpl.rc_context(wishes):
        before = dict(mpl.rcParams)
        figures = [flat.plot(kind) for kind in ("steps", "measures", "shear")]
        assert dict(mpl.rcParams) == before
    assert plt.get_fignums() == [own.number]
    assert plt.gcf() is own
    for figure in figures:
        assert mpl.colors.to_hex(figure.axes[0].get_facecolor()) != "#ff0000"
        assert {text.get_fontweight() for text in figure.findobj(mpl.text.Text)} == {"normal"}
        drawn(figure)
    plt.close("all")


def test_figures_are_vectors(dome: plydrape.Result) -> None:
    """PDF and SVG hold no picture of dots, and are small enough for a paper."""
    cases: list[tuple[Any, str, bytes]] = [
        ("steps", "pdf", b"/Subtype /Image"),
        ("measures", "svg", b"<image"),
        ("shear", "svg", b"<image"),
    ]
    for kind, form, dots in cases:
        page = BytesIO()
        dome.plot(kind).savefig(page, format=form)
        assert dots not in page.getvalue(), (kind, form)
        assert len(page.getvalue()) < 2_000_000, (kind, form, len(page.getvalue()))


def test_a_package_is_named_where_it_is_missing(
    flat: plydrape.Result, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One line that says what to install."""
    gone = ("matplotlib", "mpl_toolkits", "plydrape.plot._")
    for name in [name for name in sys.modules if name.startswith(gone)]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    for kind in ("steps", "measures", "shear"):
        with pytest.raises(ImportError, match=r"Matplotlib is missing.*pip install matplotlib"):
            flat.plot(kind)


def test_maps_of_the_sheet_hold_its_nodes_cells_and_yarns(sheet: plydrape.Result) -> None:
    """Colors of cells, steps of landing and yarns are those of the result's arrays."""
    held = sheet.sheet
    assert held is not None
    figure = plot.sheet(sheet, ["height", "landing", "shear", "tension"])
    assert len(drawn(figure)) > 10_000
    shear, tension = named(figure, "shear", 2), named(figure, "tension", 3)
    assert np.asarray(shear.get_array()) == pytest.approx(np.rad2deg(held.shear[-1]))
    assert np.asarray(tension.get_array()) == pytest.approx(held.tension[-1])
    assert np.array(tension.get_segments()) == pytest.approx(held.places[held.segments] * 1e3)
    landed = held.landing_step[held.cells].ravel()
    assert (named(figure, "landing", 1).get_array() == landed[landed > 0]).all()
    assert len(named(figure, "never", 1).get_paths()) == (landed == 0).sum()
    # the highest node is ringed, on the scale that all results share
    highest = int(held.heights[-1].argmax())
    x, y = named(figure, "largest").get_data()
    assert (x[0], y[0]) == pytest.approx(tuple(held.places[highest] * 1e3))
    assert named(figure, "height").get_clim() == (0.1, 10.0)


def test_a_map_of_no_sheet_or_no_state_is_refused(
    sheet: plydrape.Result, flat: plydrape.Result
) -> None:
    """The message says what to do."""
    with pytest.raises(ValueError, match='model="sheet"'):
        plot.sheet(flat)
    with pytest.raises(ValueError, match="no state of step 2; 3 of the steps 1 to 6 were kept"):
        plot.sheet(sheet, step=2)
    with pytest.raises(ValueError, match='maps "height"'):
        plot.sheet(sheet, cast(Any, "slack"))


def test_a_notebook_crops_a_figure_around_its_legend(flat: plydrape.Result) -> None:
    """It saves by the box of what is drawn: what lies beyond would be moved onto the axes."""
    names = ["slack_ratio", "overstretch", "landing_error_mm", "tilt_deg", "force_n", "shear_deg"]
    sheet = flat.plot("measures", names=names)
    sheet.canvas.draw()
    (legend,) = sheet.legends
    box = sheet.get_tightbbox()
    assert box.y0 * sheet.dpi <= legend.get_window_extent().y0
