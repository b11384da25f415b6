"""Every notebook of the examples runs from top to bottom and says what it was recorded to say."""

from __future__ import annotations

import copy
import re

import nbformat
import notebooks
import pytest
from notebooks import FOLDER, read

NOTEBOOKS = notebooks.names()
# A notebook that plans for minutes.
LONG = "02_robust_plan.ipynb"
RUN = [pytest.param(name, marks=[pytest.mark.long] * (name == LONG)) for name in NOTEBOOKS]


def test_there_are_notebooks() -> None:
    """Numbered in the order in which they are to be read."""
    assert len(NOTEBOOKS) >= 3
    assert all(re.fullmatch(r"\d\d_[a-z_]+\.ipynb", name) for name in NOTEBOOKS)


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_is_kept_with_its_outputs(name: str) -> None:
    """Whoever looks at it on the web sees its numbers and pictures; it stays light."""
    book = read(name)
    nbformat.validate(book)
    code = [cell for cell in book.cells if cell.cell_type == "code"]
    assert code and book.cells[0].cell_type == "markdown"
    assert [cell.execution_count for cell in code] == list(range(1, len(code) + 1))
    kinds = {kind for cell in code for out in cell.outputs for kind in out.get("data", {})}
    assert "image/png" in kinds
    assert (FOLDER / name).stat().st_size < 800_000
    longest = max(len(line) for cell in book.cells for line in cell.source.splitlines())
    assert longest <= 130, longest


@pytest.mark.parametrize("name", RUN)
def test_a_notebook_says_what_was_recorded(name: str) -> None:
    """Without an error or a warning, in its own folder; `scripts/notebooks` records it anew."""
    recorded = read(name)
    now = notebooks.executed(copy.deepcopy(recorded))
    outputs = [output for cell in now.cells for output in cell.get("outputs", [])]
    warnings = [output.text for output in outputs if output.get("name") == "stderr"]
    assert not warnings
    assert notebooks.differences(recorded, now) == []


def test_a_changed_number_is_found() -> None:
    """In what is printed and in the value of a cell; a last digit is none."""
    recorded = read(NOTEBOOKS[0])
    changed = copy.deepcopy(recorded)
    printed = [out for cell in changed.cells for out in cell.get("outputs", []) if "text" in out]
    printed[0].text = re.sub(r"\b30\b", "41", printed[0].text)
    assert any("now" in found for found in notebooks.differences(recorded, changed))
