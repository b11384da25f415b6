"""Every notebook of the examples runs from top to bottom, as someone would run it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import nbclient
import nbformat
import pytest

FOLDER = Path(__file__).resolve().parents[3] / "examples" / "notebooks"
NOTEBOOKS = sorted(path.name for path in FOLDER.glob("*.ipynb"))


def read(name: str) -> Any:
    """A notebook."""
    return nbformat.read(FOLDER / name, as_version=4)  # type: ignore[no-untyped-call]


def test_there_are_notebooks() -> None:
    """Numbered in the order in which they are to be read."""
    assert len(NOTEBOOKS) >= 3
    assert all(re.fullmatch(r"\d\d_[a-z_]+\.ipynb", name) for name in NOTEBOOKS)


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_is_kept_without_outputs(name: str) -> None:
    """Outputs are made by whoever runs it; a change of one number is a change of one line."""
    book = read(name)
    nbformat.validate(book)
    code = [cell for cell in book.cells if cell.cell_type == "code"]
    assert code and book.cells[0].cell_type == "markdown"
    assert not any(cell.outputs or cell.execution_count for cell in code)
    assert (FOLDER / name).stat().st_size < 40_000
    longest = max(len(line) for cell in book.cells for line in cell.source.splitlines())
    assert longest <= 130, longest


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_runs(name: str) -> None:
    """Without an error or a warning, in its own folder, and it shows pictures."""
    book = read(name)
    settings = {"metadata": {"path": str(FOLDER)}}
    nbclient.NotebookClient(book, timeout=120, kernel_name="python3", resources=settings).execute()
    outputs = [output for cell in book.cells for output in cell.get("outputs", [])]
    warnings = [output.text for output in outputs if output.get("name") == "stderr"]
    assert not warnings
    kinds = {kind for output in outputs for kind in output.get("data", {})}
    assert "image/png" in kinds
