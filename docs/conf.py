"""Settings of the user guide: Sphinx with MyST Markdown; `scripts/guide` builds it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sphinx.application import Sphinx

project = "plydrape"
extensions = ["myst_parser"]
include_patterns = ["index.md", "guide/*.md", "theory.md"]

# Formulas between dollars, as GitHub shows them, and anchors at headings.
myst_enable_extensions = ["dollarmath", "amsmath", "deflist"]
myst_heading_anchors = 3

html_theme = "furo"
html_title = "plydrape"
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
pygments_style = "friendly"
pygments_dark_style = "monokai"


def setup(app: Sphinx) -> None:
    """Calls `without_outer_links` for every page that is read."""
    app.connect("source-read", without_outer_links)


def without_outer_links(_app: Sphinx, _page: str, source: list[str]) -> None:
    """Names DESIGN.md instead of linking it: right on GitHub, but no page of the guide."""
    source[0] = source[0].replace("[DESIGN.md](../DESIGN.md)", "`DESIGN.md`")
