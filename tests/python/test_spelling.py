"""README and all documents are spelled as in the United States."""

from __future__ import annotations

from pathlib import Path

import pytest
from spelling import ROOT, changes, documents, private, program, programs, prose, spelled


@pytest.mark.parametrize("path", documents(), ids=lambda path: str(path.relative_to(ROOT)))
def test_a_document_has_one_spelling(path: Path) -> None:
    """`python3 tests/python/spelling.py --fix` changes what is found."""
    text = path.read_text(encoding="utf-8")
    assert list(prose(text)) == [] and list(private(path, text)) == []


@pytest.mark.parametrize("path", programs(), ids=lambda path: str(path.relative_to(ROOT)))
def test_what_a_program_says_has_one_spelling(path: Path) -> None:
    """As above; keys and names are changed by hand."""
    text = path.read_text(encoding="utf-8")
    assert list(changes(path, text)) == [] and list(private(path, text)) == []


def test_texts_of_a_program_are_changed_and_names_are_not() -> None:
    """One word alone, a key, a value of a format and a comment within the code are names."""
    rust = (
        "/// The fibre of `centre`, in metres.\n// a neighbour\n"
        'let fibre = format!("{colour} of a fibre, centre_line"); key("fibre_angle", "colour");\n'
    )
    assert program(rust, ".rs") == rust.replace("The fibre", "The fiber").replace(
        "in metres", "in meters"
    ).replace("a fibre,", "a fiber,")
    python = '"""Draws.\n\n    colour: The colour of a fibre.\n"""\nx(colour="grey")\n'
    assert program(python, ".py") == python.replace("The colour of a fibre", "The color of a fiber")


def test_names_and_private_phrases_are_listed() -> None:
    """Names of a program count, but where it reads such words; phrases count everywhere."""
    text = "let fibre_angle = 1;\n/// Those of a net.\n// a length is wanted\n// told apart"
    found = [(line, phrase) for line, phrase, _ in private(Path("a.rs"), text)]
    assert found == [(1, "fibre"), (2, "/// Those of"), (3, "is wanted")]
    assert [n for n, _, _ in private(Path("crates/plydrape-io/src/scene/units.rs"), text)] == [2, 3]
    assert [n for n, _, _ in private(Path("a.md"), text)] == [2, 3]


def test_words_are_changed_and_code_is_not() -> None:
    """Stems and endings, with their capitals; keys, formulas, links and blocks stay."""
    assert spelled("Fibres, coloured and centred, of millimetres") == (
        "Fibers, colored and centered, of millimeters"
    )
    assert spelled("Two per cent of misspelt signs") == "Two percent of misspelled signs"
    assert spelled("a vectorised programme, programmed precisely") == (
        "a vectorized program, programmed precisely"
    )
    text = "`fibre_angle` $metre$ [x](colour.md)\n```text\nfibre\n```\nthe fibre"
    assert [(number, ours) for number, _, ours in prose(text)] == [(5, "the fiber")]
