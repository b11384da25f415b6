"""The page of a result inside a notebook."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plydrape import Result

__all__ = ["Page", "show"]

LOWEST, HIGHEST = 200, 4000
"""Heights that a frame can have (pixels)."""


class Page:
    """The page of a result, in a frame of its own when a notebook shows it.

    The page travels inside the notebook, so it is there in JupyterLab, in VS Code and in what
    nbconvert makes, also without plydrape and without a network. It can run its own script but
    cannot reach the notebook around it.
    """

    def __init__(self, title: str, html: str, height: int) -> None:
        """A page of this title and text, in a frame this high (pixels)."""
        self.title, self.html, self.height = title, html, height

    def _repr_html_(self) -> str:
        # A page as an attribute: of all its characters only these two end it or mean another.
        page = self.html.replace("&", "&amp;").replace('"', "&quot;")
        return (
            f'<iframe title="{escape(self.title)}" width="100%" height="{self.height}" '
            'style="border: 1px solid #d9dde3; box-sizing: border-box; display: block" '
            f'sandbox="allow-scripts allow-downloads allow-modals" srcdoc="{page}"></iframe>'
        )

    def __repr__(self) -> str:
        return (
            f'<plydrape.Page of "{self.title}": a notebook shows it; '
            'elsewhere write it with result.report("page.html") and open it in a browser>'
        )


def show(result: Result, height: int = 640) -> Page:
    """The page of a result, the last value of a cell in a notebook.

    Parameters
    ----------
    result : Result
        The result.
    height : int, default 640
        Height of the frame (pixels), 200 to 4000.

    Returns
    -------
    Page
        The page.

    Raises
    ------
    ValueError
        No frame is that high.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene)
    >>> plydrape.notebook.show(result)
    <plydrape.Page of "Flat mold, ply sheared by 20 deg": a notebook shows it; ...>

    """
    if not LOWEST <= height <= HIGHEST:
        raise ValueError(f"a frame can be {LOWEST} to {HIGHEST} pixels high, not {height}")
    return Page(result.title, result.html(), int(height))
