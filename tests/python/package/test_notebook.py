"""A notebook shows the page and the plots, and so does what is made of it."""

from __future__ import annotations

import os
import re
import subprocess
from html import unescape
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import matplotlib.image
import nbclient
import nbconvert
import nbformat
import numpy as np
import plydrape
import pytest
from plydrape import notebook

ROOT = Path(__file__).resolve().parents[3]
SCENE = ROOT / "examples" / "01_flat_sheared_mold" / "scene.toml"


def chromium() -> str:
    """The browser under test; skips where there is none."""
    for path in (os.environ.get("CHROMIUM"), "/usr/bin/chromium", "/usr/bin/google-chrome"):
        if path and Path(path).is_file():
            return path
    pytest.skip("NOT SEEN IN A BROWSER: no Chromium; set CHROMIUM")


@pytest.fixture(scope="module")
def result() -> plydrape.Result:
    """The paper's example, with the catenaries that the page draws."""
    return plydrape.simulate(plydrape.Scene.read(SCENE), model="catenaries")


@pytest.fixture(scope="module")
def executed() -> Any:
    """A notebook with the page and a plot, run by a kernel of its own."""
    book = nbformat.v4.new_notebook()  # type: ignore[no-untyped-call]
    cells = [
        "import plydrape\n"
        f"scene = plydrape.Scene.read({str(SCENE)!r})\n"
        "result = plydrape.simulate(scene, model='catenaries')\n"
        "result.show()",
        "result.plot()",
        "result.plot('measures', names=['slack_mm'])",
    ]
    book.cells = [nbformat.v4.new_code_cell(cell) for cell in cells]  # type: ignore[no-untyped-call]
    nbclient.NotebookClient(book, timeout=60, kernel_name="python3").execute()
    return book


class Frames(HTMLParser):
    """The frames of a page."""

    def __init__(self) -> None:
        """None found yet."""
        super().__init__()
        self.found: list[dict[str, str | None]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Keeps what a frame says."""
        if tag == "iframe":
            self.found.append(dict(attrs))


def frame(html: str) -> dict[str, str | None]:
    """The only frame of a page."""
    parser = Frames()
    parser.feed(html)
    assert len(parser.found) == 1
    return parser.found[0]


def test_the_frame_holds_the_whole_page(result: plydrape.Result) -> None:
    """As an attribute that a browser reads back character by character."""
    html = notebook.show(result, height=500)._repr_html_()
    found = frame(html)
    assert found["srcdoc"] == result.html()
    assert found["height"] == "500" and found["title"] == result.title
    # its own script runs, what surrounds it is out of reach
    sandbox = (found["sandbox"] or "").split()
    assert "allow-scripts" in sandbox and "allow-same-origin" not in sandbox


def test_no_title_or_page_escapes_its_attribute() -> None:
    """Quotes, brackets and entities come back as they went in."""
    page = '<p title="a">&quot; &amp;amp; \'</p></iframe><script>"</script>'
    title = '"><script>alert(1)</script>'
    found = frame(notebook.Page(title, page, 300)._repr_html_())
    assert found["srcdoc"] == page and found["title"] == title
    assert found["srcdoc"] != unescape(page)


def test_outside_a_notebook_it_says_what_to_do(result: plydrape.Result) -> None:
    """One line of text; heights that no frame has are refused."""
    text = repr(result.show())
    assert "result.report(" in text and result.title in text and "\n" not in text
    for height in (0, 10_000):
        with pytest.raises(ValueError, match="200 to 4000"):
            result.show(height=height)


def test_plots_are_shown_without_pyplot(executed: Any) -> None:
    """The last value of a cell is a picture; the page is HTML with a text for other readers."""
    kinds = [set(cell.outputs[0].data) for cell in executed.cells]
    assert kinds == [{"text/plain", "text/html"}] + 2 * [{"text/plain", "image/png"}]
    assert all(len(cell.outputs) == 1 for cell in executed.cells)


def seen(html: str, folder: Path, name: str) -> np.ndarray[Any, np.dtype[np.float64]]:
    """What a browser shows of a page (rows, columns, 3), 0 to 255."""
    (folder / f"{name}.html").write_text(html)
    picture = folder / f"{name}.png"
    command = [
        chromium(),
        "--headless",
        "--no-sandbox",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        # the virtual clock waits for this process alone
        "--disable-features=IsolateSandboxedIframes",
        "--virtual-time-budget=15000",
        "--window-size=1200,800",
        f"--screenshot={picture}",
        (folder / f"{name}.html").as_uri(),
    ]
    subprocess.run(command, capture_output=True, timeout=90, check=True)
    return np.asarray(matplotlib.image.imread(picture)[..., :3], float) * 255


def test_the_page_lives_in_the_html_made_of_a_notebook(executed: Any, tmp_path: Path) -> None:
    """Red catenaries, drawn by its script in 3D; none if scripts are forbidden."""
    html, _ = nbconvert.HTMLExporter().from_notebook_node(executed)  # type: ignore[no-untyped-call]
    # what it would load from elsewhere is not needed
    html = re.sub(r'<script src="https?://[^"]*"></script>', "", html)
    html = re.sub(r"<img[^>]*>", "", html)

    def red(name: str, page: str) -> int:
        difference = np.abs(seen(page, tmp_path, name) - [214.0, 25.0, 33.0]).max(axis=2)
        return int((difference < 12).sum())

    alive = red("alive", html)
    dead = red("dead", html.replace('sandbox="allow-scripts', 'sandbox="'))
    assert alive > 500 and dead < 50, (alive, dead)
