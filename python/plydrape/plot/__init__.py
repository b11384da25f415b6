"""Figures of a result for a paper, drawn by Matplotlib.

    steps      chosen steps in 3D, after the figure of Krogh et al. 2018
    measures   slack, overstretch, shear, force and the others over the steps, each with its limit
    shear_map  the shear angle of every cell of the ideal drape
    sheet      the sheet on the flat fabric: height over the mold, order of landing, shear, tension

Each function makes a new `matplotlib.figure.Figure` and touches nothing else: no figure of
`pyplot`, no setting. A notebook shows it as the last value of a cell; `figure.savefig("steps.pdf")`
writes it. Widths are those of a column of print, text is 8 pt. Matplotlib is installed by
`pip install matplotlib`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

from plydrape import _extra, _plydrape

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from plydrape import Net, Result

__all__ = ["measures", "plot", "shear_map", "sheet", "steps"]

Width = str | float
"""Width of a figure: "single" is 89 mm, "double" 183 mm; or a length, as "120 mm"."""

Map = Literal["height", "landing", "shear", "tension"]
"""What a map of the sheet tells: height over the mold, order of landing, shear, tension."""

Surface = Literal["gap", "height", "shear"]
"""What the color of the ply tells: gap to the mold, height z, shear angle of its cells."""


def plot(
    result: Result, kind: Literal["steps", "measures", "shear", "sheet"] = "steps", **options: Any
) -> Figure:
    """The figure of this kind; `options` are those of `steps`, `measures`, `shear_map` or `sheet`.

    Raises
    ------
    ValueError
        There is no such kind.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene)
    >>> figure = plydrape.plot.plot(result, "measures", width="single")
    >>> round(25.4 * figure.get_figwidth())
    89

    """
    if kind == "steps":
        return steps(result, **options)
    if kind == "measures":
        return measures(result, **options)
    if kind == "shear":
        return shear_map(result, **options)
    if kind == "sheet":
        return sheet(result, **options)
    raise ValueError(f'there is no plot "{kind}"; choose "steps", "measures", "shear" or "sheet"')


def steps(
    result: Result,
    steps: Sequence[int] | None = None,
    *,
    color: Surface | None = None,
    elev: float | str = "28 deg",
    azim: float | str = "-62 deg",
    columns: int | None = None,
    width: Width = "double",
    title: str | None = None,
) -> Figure:
    """Chosen steps in 3D by the model that decides, one panel each, all in one frame and one scale.

    Black discs are the grippers, tilted with the ply; the gray line on the mold is the outline of
    the ideal drape. Of catenaries, which are red lines, those parts are thick that touch the mold,
    with a ring in the middle of each. What the mold hides from this view is left out, so choose the
    view here and not by turning the axes later.

    Parameters
    ----------
    result : Result
        The result.
    steps : sequence of int, optional
        Steps to show, counted from 1. If None: the start, the first contact, of catenaries the
        first shear, the end, and one in the middle of the longest stretch between them.
    color : Surface, optional
        What the color of the ply tells; if None the gap to a curved mold, else the height.
    elev : float or str, default "28 deg"
        Angle of the view above the xy plane (rad, or a text with a unit), -90 to 90 deg.
    azim : float or str, default "-62 deg"
        Angle of the view about z (rad, or a text with a unit).
    columns : int, optional
        Panels side by side; if None as many as fit the width, at most 3.
    width : Width, default "double"
        "single" (89 mm), "double" (183 mm) or a length, as "120 mm".
    title : str, optional
        A line above the panels; none by default, a paper has a caption.

    Raises
    ------
    ImportError
        Matplotlib is not installed.
    ValueError
        No such step, none at all, one of a sheet that was not kept, or a view or width that cannot
        be.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene, model="catenaries")
    >>> figure = plydrape.plot.steps(result, [1, 26, 30], width="single")
    >>> [text.get_text() for text in figure.texts]
    ['a  step 1, start', 'b  step 26, first contact', 'c  step 30, end']

    """
    _need()
    from plydrape.plot import _steps

    view = (_degrees(elev, "elev"), _degrees(azim, "azim"))
    return _steps.figure(result, steps, color, view, columns, width, title)


def measures(
    result: Result,
    names: Sequence[str] | None = None,
    *,
    against: Literal["step", "time"] = "step",
    columns: int | None = None,
    width: Width = "double",
    title: str | None = None,
) -> Figure:
    """The worst value of each measure over the steps by the model that decides, a small panel each.

    A limit is a dashed line, with its value beside the name; "end" says that it holds at the last
    step only. A dot marks the step that the limit judges, or the largest value where there is no
    limit; a cross where the limit is exceeded. The dotted line is the first contact.

    Parameters
    ----------
    result : Result
        The result.
    names : sequence of str, optional
        Names of `result.measures` in the order wanted; if None those with a limit, then loads on
        grippers, and of catenaries slack, gap and force.
    against : {"step", "time"}, default "step"
        What runs to the right, the number of the step or its time (s).
    columns : int, optional
        Panels side by side; if None 3 on a double column, 2 on a single one.
    width : Width, default "double"
        "single" (89 mm), "double" (183 mm) or a length, as "120 mm".
    title : str, optional
        A line above the panels; none by default.

    Raises
    ------
    ImportError
        Matplotlib is not installed.
    ValueError
        No such measure, or one without a value at any step.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene)
    >>> figure = plydrape.plot.measures(result, ["tilt_deg", "strain"])
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['deg', '%']

    """
    _need()
    from plydrape.plot import _measures

    return _measures.figure(result, names, against, columns, width, title)


def shear_map(
    net: Net | Result,
    *,
    view: Literal["both", "fabric", "plan"] = "both",
    signed: bool = False,
    most: float | str | None = None,
    width: Width = "double",
    title: str | None = None,
) -> Figure:
    """The shear angle of every cell of the ideal drape's net.

    Left on the flat fabric with the coordinates u and v of the net, right on the mold seen from
    above. The largest angle is ringed. Cells with a missing node stay white.

    Parameters
    ----------
    net : Net or Result
        A net, or a result whose ideal drape has one.
    view : {"both", "fabric", "plan"}, default "both"
        Which of both to draw.
    signed : bool, default False
        False colors the amount from 0 on, which is what a locking angle limits; True the
        angle with its sign, in two hues from a white zero.
    most : float or str, optional
        End of the colors (rad, or a text with a unit); if None the largest amount. For
        maps that are to be compared.
    width : Width, default "double"
        "single" (89 mm), "double" (183 mm) or a length, as "120 mm".
    title : str, optional
        A line above the panels; none by default.

    Raises
    ------
    ImportError
        Matplotlib is not installed.
    ValueError
        The result has no ideal drape, or the net has no cell with all its nodes.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene)
    >>> figure = plydrape.plot.shear_map(result, view="fabric")
    >>> figure.axes[0].get_xlabel()
    'u (mm)'

    """
    _need()
    from plydrape.plot import _shear

    end = None if most is None else _degrees(most, "most")
    return _shear.figure(net, view, signed, end, width, title)


def sheet(
    result: Result,
    show: Map | Sequence[Map] = ("height", "landing"),
    step: int = -1,
    *,
    width: Width = "double",
    title: str | None = None,
) -> Figure:
    """Maps of the draped sheet on the flat fabric.

    The height over the mold has one scale for all results, by orders of size from 0.1 to 10 mm: a
    red line is the limit, a ring the highest node. The order of landing is that of the whole drape:
    the step in which a node came to the mold and stayed; what is in the air at the end is gray.
    Black discs are the grippers.

    Parameters
    ----------
    result : Result
        The result, of a drape with the sheet.
    show : Map or sequence of Map, default ("height", "landing")
        One map or several, up to four.
    step : int, default -1
        The step whose height, shear and tension are shown, from 1; -1 is the last that was
        kept, -2 the one before.
    width : Width, default "double"
        "single" (89 mm), "double" (183 mm) or a length, as "120 mm".
    title : str, optional
        A line above the panels; none by default.

    Raises
    ------
    ImportError
        Matplotlib is not installed.
    ValueError
        The result has no sheet, none of that step, or no mold for the height.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene, model="sheet")
    >>> figure = plydrape.plot.sheet(result)
    >>> [axes.get_title(loc="left") for axes in figure.axes[:2]]
    ['a  height over the mold, step 30', 'b  order of landing']

    """
    _need()
    from plydrape.plot import _fabric

    return _fabric.figure(result, show, step, width, title)


def _need() -> None:
    _extra.load("matplotlib", package="matplotlib", name="Matplotlib")


def _degrees(angle: float | str, name: str) -> float:
    return math.degrees(_plydrape._si(angle, "angle", name))
