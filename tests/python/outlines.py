"""Drawings of one ply by ezdxf, as tests of the Rust crate read them.

`python tests/python/outlines.py` writes them anew. The ply is 400 mm by 200 mm with a round end,
and has holes that are drawn in as many ways as a version of DXF knows. What is around it is no
part of it: text, a hatch, a dimension, layers that are off or frozen, and the paper.
"""

from __future__ import annotations

from pathlib import Path

from ezdxf.document import Drawing
from ezdxf.filemanagement import new
from ezdxf.math import rational_bspline_from_arc

FOLDER = Path(__file__).resolve().parents[2] / "crates/plydrape-io/tests/it/outlines"

# version, name of the unit, unit of the header, units in a millimeter
VERSIONS = [
    ("R12", "none", 0, 1.0),
    ("R2000", "mm", 4, 1.0),
    ("R2007", "m", 6, 1e-3),
    ("R2010", "inch", 1, 1 / 25.4),
    ("R2018", "cm", 5, 0.1),
]


def drawing(version: str, unit: int, scale: float) -> Drawing:
    """The ply, its lengths multiplied."""
    old = version == "R12"
    document = new(version)
    document.units = unit
    for name in ["CUT", "HOLES", "NOTES", "HIDDEN", "FROZEN"]:
        document.layers.add(name)
    document.layers.get("HIDDEN").off()
    document.layers.get("FROZEN").freeze()
    model = document.modelspace()
    holes = {"layer": "HOLES"}

    def at(x: float, y: float) -> tuple[float, float]:
        return scale * x, scale * y

    ply = [(*at(0, 0), 0.0), (*at(400, 0), 1.0), (*at(400, 200), 0.0), (*at(0, 200), 0.0)]
    add = model.add_polyline2d if old else model.add_lwpolyline
    add(ply, format="xyb", close=True, dxfattribs={"layer": "CUT"})

    # holes: a circle, a slot of lines and arcs, an ellipse as a block, a circle seen from behind
    model.add_circle(at(60, 50), 20 * scale, dxfattribs=holes)
    model.add_arc(at(60, 140), 10 * scale, 90, 270, dxfattribs=holes)
    model.add_line(at(100, 130), at(60, 130), dxfattribs=holes)
    model.add_line(at(100, 150), at(60, 150), dxfattribs=holes)
    model.add_arc(at(100, 140), 10 * scale, -90, 90, dxfattribs=holes)
    document.blocks.new("ROUND").add_circle((0, 0), scale)
    stretched = {"layer": "HOLES", "xscale": 15, "yscale": 10, "rotation": 30}
    model.add_blockref("ROUND", at(220, 150), dxfattribs=stretched)
    behind = {"layer": "HOLES", "extrusion": (0, 0, -1)}
    model.add_circle((-340 * scale, 40 * scale), 5 * scale, dxfattribs=behind)
    if not old:
        model.add_ellipse(at(150, 60), (18 * scale, 24 * scale), 1 / 3, dxfattribs=holes)
        circle = rational_bspline_from_arc(at(300, 120), 25 * scale)
        model.add_spline(dxfattribs=holes).apply_construction_tool(circle)
        model.add_hatch(dxfattribs={"layer": "NOTES"}).paths.add_polyline_path(ply)
        model.add_linear_dim(base=at(0, -40), p1=at(0, 0), p2=at(400, 0)).render()

    model.add_text("ply 3", dxfattribs={"layer": "CUT", "height": 10 * scale})
    model.add_point(at(10, 10), dxfattribs={"layer": "CUT"})
    for layer in ["HIDDEN", "FROZEN"]:
        model.add_circle(at(0, 0), 900 * scale, dxfattribs={"layer": layer})
    document.paperspace().add_line((0, 0), (200, 100), dxfattribs={"layer": "CUT"})
    return document


def write() -> None:
    """Writes all drawings."""
    for version, name, unit, scale in VERSIONS:
        drawing(version, unit, scale).saveas(FOLDER / f"{version}_{name}.dxf")


if __name__ == "__main__":
    write()
