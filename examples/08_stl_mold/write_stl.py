"""Writes mold.stl: a shallow, doubly curved mold as a binary STL in millimeters.

The surface is z = -x^2/2 + 3x^3/5 - 9y^2/10 + 4xy/5 (meters) over x, y from -60 to 380 mm, on a
grid of 10 mm, each square cut in two triangles. Needs Python alone: python3 write_stl.py
"""

import struct
from pathlib import Path

LOW, HIGH, STEP = -60, 380, 10


def height(x: float, y: float) -> float:
    """Height in mm over a place in mm."""
    x, y = x / 1000, y / 1000
    return 1000 * (-(x**2) / 2 + 3 * x**3 / 5 - 9 * y**2 / 10 + 4 * x * y / 5)


def triangle(*corners: tuple[float, float]) -> bytes:
    """One record of the file; readers work out the normal, which is left zero."""
    values = [0.0, 0.0, 0.0]
    for x, y in corners:
        values += [x, y, height(x, y)]
    return struct.pack("<12fH", *values, 0)


def main() -> None:
    """Writes the file beside this one."""
    places = range(LOW, HIGH, STEP)
    records = []
    for y in places:
        for x in places:
            a, b, c, d = (x, y), (x + STEP, y), (x + STEP, y + STEP), (x, y + STEP)
            records += [triangle(a, b, c), triangle(a, c, d)]
    header = b"shallow doubly curved mold, millimeters".ljust(80)
    data = header + struct.pack("<I", len(records)) + b"".join(records)
    Path(__file__).with_name("mold.stl").write_bytes(data)


if __name__ == "__main__":
    main()
