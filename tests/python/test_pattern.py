"""A flat pattern and a boundary as DXF, PDF and CSV, read by ezdxf and pypdf.

The files are those that tests/it/pattern.rs of the crate plydrape-io compares with what is
written today. The ply is 300 mm by 200 mm without a corner, with a triangular hole and six
grippers; its warp runs at 45 degrees.
"""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import outlines
import pytest
from ezdxf import units
from ezdxf.document import Drawing
from ezdxf.filemanagement import readfile
from pypdf import PdfReader

FILES = outlines.FOLDER.parent / "snapshots"
TITLE = "Ply 3 – Größe 5 µm ^ (45°)"
NAMES = [f"g{i}_{j}" for i in range(3) for j in range(2)]


def file(name: str) -> Path:
    """A written file."""
    return FILES / f"it__pattern__{name.replace('.', '_')}.snap.{name.rpartition('.')[2]}"


def sound(path: Path) -> Drawing:
    """A drawing in millimeters in which ezdxf finds nothing wrong and nothing to mend."""
    document = readfile(path)
    audit = document.audit()
    assert not audit.errors and not audit.fixes
    assert document.dxfversion == "AC1024" and document.units == units.MM
    return document


def entities(document: Drawing, query: str) -> list[Any]:
    """Entities of the drawing that a query finds, in their order."""
    return list(document.modelspace().query(query))


def test_a_pattern_has_its_lines_on_their_layers() -> None:
    """Closed polylines through the corners, counterclockwise around the ply."""
    drawing = sound(file("pattern.dxf"))
    [cut] = entities(drawing, '*[layer=="CUT"]')
    [hole] = entities(drawing, '*[layer=="HOLES"]')
    corners = [(100, 0), (400, 0), (400, 150), (350, 200), (100, 200)]
    assert cut.closed and np.abs(np.array(cut.get_points("xy")) - corners).max() < 1e-9
    inner = {(round(x, 9), round(y, 9)) for x, y in hole.get_points("xy")}
    assert hole.closed and inner == {(200, 100), (250, 100), (225, 140)}


def test_a_pattern_names_its_grippers_where_they_hold() -> None:
    """Circles of the pads with their names in the middle."""
    drawing = sound(file("pattern.dxf"))
    circles = entities(drawing, 'CIRCLE[layer=="GRIPPERS"]')
    places = [(150 + 100 * i, 50 + 100 * j) for i in range(3) for j in range(2)]
    assert [(c.dxf.center.x, c.dxf.center.y) for c in circles] == places
    assert {c.dxf.radius for c in circles} == {12}
    texts = entities(drawing, 'TEXT[layer=="GRIPPERS"]')
    assert [text.plain_text() for text in texts] == NAMES
    assert [(t.dxf.align_point.x, t.dxf.align_point.y) for t in texts] == places
    [title] = entities(drawing, 'TEXT[layer=="TITLE"]')
    assert title.plain_text() == TITLE


def test_the_arrow_of_a_pattern_points_along_the_warp() -> None:
    """From its tail to its tip at 45 degrees."""
    drawing = sound(file("pattern.dxf"))
    shaft, head = entities(drawing, 'LWPOLYLINE[layer=="FIBER"]')
    tip, tail = np.array(shaft.get_points("xy"))
    assert np.degrees(np.arctan2(*(tip - tail)[::-1])) == pytest.approx(45)
    assert np.array(head.get_points("xy"))[1] == pytest.approx(tip)


def test_a_boundary_is_lines_in_space() -> None:
    """POLYLINE entities in space with the points of the table, in millimeters."""
    with file("boundary.csv").open(newline="") as table:
        header, *rows = csv.reader(table)
    assert header == ["polyline", "point", "x (m)", "y (m)", "z (m)"]
    lines = entities(sound(file("boundary.dxf")), "POLYLINE")
    assert [line.dxf.layer for line in lines] == ["BOUNDARY", "BOUNDARY"]
    for line, name in zip(lines, ["ply 3, boundary", "hole"], strict=True):
        due = [[1e3 * float(x) for x in row[2:]] for row in rows if row[0] == name]
        assert line.is_3d_polyline and line.is_closed == (due[0] == due[-1])
        found = np.array([v.dxf.location.xyz for v in line.vertices])
        assert np.abs(found - (due[:-1] if line.is_closed else due)).max() < 1e-8


def test_a_page_has_the_size_of_the_ply_and_all_names() -> None:
    """The size is 300 mm by 200 mm and a margin of 25 mm; text is text."""
    reader = PdfReader(file("pattern.pdf"), strict=True)
    [page] = reader.pages
    size = [float(side) * page.user_unit * 25.4 / 72 for side in page.mediabox[2:]]
    assert size == pytest.approx([350, 250], abs=1e-3)
    assert page.extract_text().splitlines() == [*NAMES, "warp", "100 mm", TITLE]
    assert reader.metadata is not None and reader.metadata.title == TITLE


def test_drawings_that_the_crate_reads_are_those_of_ezdxf() -> None:
    """Entities are those that ezdxf would write now; dates and identifiers are not compared."""
    for version, name, unit, scale in outlines.VERSIONS:
        path = outlines.FOLDER / f"{version}_{name}.dxf"
        kept = readfile(path).modelspace()
        made = outlines.drawing(version, unit, scale).modelspace()
        assert [e.dxftype() for e in kept] == [e.dxftype() for e in made]
        assert [e.dxf.layer for e in kept] == [e.dxf.layer for e in made]
