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
    motion, verdict, *figures = row["rest"].split(" | ")
    kept = json.loads((ROOT / "examples" / row["name"] / "numbers.json").read_text())
    lines, sheet = kept[motion], kept[f"{motion} sheet"]
    assert verdict == ("accepted" if lines["accepted"] else "refused")
    assert not sheet["accepted"]
    assert figures == [
        str(lines["first_contact_step"]),
        str(sheet["first_contact_step"]),
        f"{sheet['height_max_mm']:.1f}",
        f"{sheet['ridge_max_mm']:.1f}",
        f"{sheet['bridge_max_mm']:.1f}",
        f"{100 * sheet['height_share_above_half_mm']:.0f}",
        f"{sheet['shear_max_deg']:.0f}",
    ]
