"""Settings of the user guide: Sphinx with MyST Markdown; `scripts/guide` builds it."""

from __future__ import annotations

import html
import os
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from docutils.nodes import SkipNode
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.util import logging

# beside this file, for Sphinx too
sys.path.insert(0, str(Path(__file__).resolve().parent))
import api

if TYPE_CHECKING:
    from docutils import nodes
    from sphinx.application import Sphinx
    from sphinx.writers.html5 import HTML5Translator

project = "plydrape"
extensions = ["myst_parser"]
include_patterns = ["index.md", "guide/*.md", "theory/*.md"]

# Formulas between dollars, as GitHub shows them, and anchors at headings.
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3

html_theme = "furo"
html_title = "plydrape"
html_static_path = ["guide.css"]
html_css_files = ["guide.css"]
html_extra_path = ["live.html"]
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_math_renderer = "mathml"
pygments_style = "a11y-high-contrast-light"
pygments_dark_style = "a11y-high-contrast-dark"

# The documentation of the Rust crates, where scripts/guide has made it: it stands beside the guide.
CRATES = {"plydrape": "computes", "plydrape_io": "reads and writes files"}


def rust() -> str:
    """Links to the documentation of the crates."""
    if not os.environ.get("PLYDRAPE_RUSTDOC"):
        return ""
    links = (
        f'<li><p><a class="reference external" href="../rust/{name}/index.html">'
        f"<code>{name}</code></a>: {what}</p></li>"
        for name, what in CRATES.items()
    )
    return f"<ul>{''.join(links)}</ul>\n"


# Pages whose tables are made from the Python sources.
MADE = {"guide/api": api.markdown, "guide/rust": rust}
# What people type into the search, and the page that answers it: entries of the index come before
# all matches of words.
SOUGHT = {
    "guide/not_accepted": ["my plan is not accepted", "plan not accepted", "not accepted"],
    "guide/duration": ["how long does a plan take"],
    "guide/exactness": ["how exact must my robot be"],
}
# The page whose tables have a style of their own, which its Markdown cannot say.
KEYS = "guide/keys"
TABLE = re.compile(r"(?:^\|.*\n)+", re.M)

# A link to a document that is no page of the guide.
OUTER_LINK = re.compile(r"\[((?:DESIGN|CONTRIBUTING|SECURITY)\.md)\]\((?:\.\./)+\1\)")

TAG = re.compile(r"\\tag\{(.*?)\}")

# What `tex2mathml` does not know, in words that it does.
SPELLINGS = [
    (re.compile(r"\\tfrac(\d)(\d)"), r"\\frac{\1}{\2}"),
    (re.compile(r"\\dots"), r"\\ldots"),
    (re.compile(r"\\(?:[bB]ig|textstyle)(?![a-zA-Z])"), ""),
]


def setup(app: Sphinx) -> None:
    """Formulas become MathML, which browsers draw without a script from elsewhere."""
    app.add_html_math_renderer("mathml", (inline_formula, None), (formula, None))
    app.connect("source-read", without_outer_links)
    app.connect("source-read", with_tables)


def without_outer_links(_app: Sphinx, _page: str, source: list[str]) -> None:
    """Names documents instead of linking them: right on GitHub, but no pages of the guide."""
    source[0] = OUTER_LINK.sub(r"`\1`", source[0])


def with_tables(_app: Sphinx, page: str, source: list[str]) -> None:
    """Adds what is made when the guide is built, entries of the index, and the style of tables."""
    if page == KEYS:
        source[0] = TABLE.sub(
            lambda table: f"```{{table}}\n:class: keys\n\n{table[0]}```\n", source[0]
        )
    entries = "".join(f"```{{index}} ! {sought}\n```\n" for sought in SOUGHT.get(page, []))
    source[0] = entries + source[0]
    if page in MADE:
        source[0] += "\n" + MADE[page]()


def inline_formula(page: HTML5Translator, node: nodes.math) -> None:
    """A formula within a line."""
    page.body.append(mathml(node, block=False))
    raise SkipNode


def formula(page: HTML5Translator, node: nodes.math_block) -> None:
    """A formula in a line of its own, its number at the right."""
    number = TAG.search(node.astext())
    shown = f'<span class="number">({html.escape(number[1])})</span>' if number else ""
    page.body.append(f'<div class="formula">{mathml(node, block=True)}{shown}</div>\n')
    raise SkipNode


def mathml(node: nodes.Element, *, block: bool) -> str:
    """The formula of a node; one that cannot be read is a warning, hence an error."""
    text = TAG.sub("", node.astext())
    for pattern, known in SPELLINGS:
        text = pattern.sub(known, text)
    try:
        return str(tex2mathml(text, as_block=block))
    except MathError as error:
        logging.getLogger(__name__).warning("formula: %s", error, location=node)
        return f"<code>{html.escape(text)}</code>"
