"""README and all documents are spelled as in the United States."""

from __future__ import annotations

from pathlib import Path

import pytest
from spelling import ROOT, documents, prose, spelled


@pytest.mark.parametrize("path", documents(), ids=lambda path: str(path.relative_to(ROOT)))
def test_a_document_has_one_spelling(path: Path) -> None:
    """`python3 tests/python/spelling.py --fix` changes what is found."""
    assert list(prose(path.read_text(encoding="utf-8"))) == []


def test_words_are_changed_and_code_is_not() -> None:
    """Stems and endings, with their capitals; keys, formulas, links and blocks stay."""
    assert spelled("Fibres, coloured and centred, of millimetres") == (
        "Fibers, colored and centered, of millimeters"
    )
    assert spelled("a vectorised programme, programmed precisely") == (
        "a vectorized program, programmed precisely"
    )
    text = "`fibre_angle` $metre$ [x](colour.md)\n```text\nfibre\n```\nthe fibre"
    assert [(number, ours) for number, _, ours in prose(text)] == [(5, "the fiber")]
