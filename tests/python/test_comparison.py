"""The guide's table of both models shows what is kept beside the pictures of the examples."""

from __future__ import annotations

import json
import re

import pytest
from program import ROOT

ROW = re.compile(
    r"^\| \[[^]]*\]\(\.\./\.\./examples/(?P<name>\w+)/scene\.toml\) \| (?P<rest>.*) \|$"
)
CHAPTER = (ROOT / "docs" / "guide" / "sheet.md").read_text(encoding="utf-8")
ROWS = [row for row in map(ROW.match, CHAPTER.splitlines()) if row]


def test_the_table_has_both_motions_of_three_scenes() -> None:
    """Every row is found by the expression above."""
    assert len(ROWS) == 6


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row['name']}-{row['rest'].split()[0]}")
def test_a_row_shows_the_kept_numbers(row: re.Match[str]) -> None:
    """`examples/pictures.py --check` compares those with new drapes."""
    motion, *figures = row["rest"].split(" | ")
    kept = json.loads((ROOT / "examples" / row["name"] / "numbers.json").read_text())[motion]
    verdicts = {True: "accepted", False: "refused"}
    assert figures == [
        str(kept["catenaries_first_contact_step"]),
        str(kept["first_contact_step"]),
        verdicts[kept["accepted"]],
        f"{kept['height_mm']:.2f}",
        f"{kept['ridge_max_mm']:.2f}",
        f"{kept['bridge_max_mm']:.2f}",
        f"{100 * kept['height_share']:.0f}",
        f"{kept['shear_deg']:.0f}",
    ]


@pytest.mark.parametrize("name", sorted({row["name"] for row in ROWS}))
def test_the_catenaries_of_a_straight_path_say_the_same_on_their_own(name: str) -> None:
    """They are draped beside the sheet and without it."""
    kept = json.loads((ROOT / "examples" / name / "numbers.json").read_text())
    alone = kept["straight catenaries"]
    assert kept["straight"]["catenaries_first_contact_step"] == alone["first_contact_step"]
