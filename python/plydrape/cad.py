"""Molds from CAD: the faces of a STEP or IGES file as triangles.

    read     points and triangles (m)
    mold     a `plydrape.Mold` of these triangles
    convert  a file of these triangles for the `[mold]` of a scene

    $ python -m plydrape.cad mold.step -o mold.stl --tolerance 0.1mm

Faces are read with the unit that the file says. OpenCASCADE is installed by
`pip install cadquery-ocp-novtk`.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from plydrape import _occ
from plydrape._plydrape import _si
from plydrape.errors import CadError, of_file

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from plydrape import Mold

__all__ = ["CadError", "Triangles", "convert", "mold", "read"]

UNITS = {"um": 1e-6, "mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}
"""Names of units of length, and their meters."""


class Triangles(NamedTuple):
    """A surface of triangles."""

    points: NDArray[np.float64]
    """Corners (P, 3) in m; each is there once, also where faces meet."""
    triangles: NDArray[np.int64]
    """Indices (T, 3) of the corners of each triangle, counter-clockwise seen from above."""


def read(
    path: str | os.PathLike[str],
    *,
    tolerance: float | str | None = None,
    angle_deg: float = 10.0,
    unit: str | None = None,
) -> Triangles:
    """The faces of a STEP or IGES file as one surface of triangles.

    Parameters
    ----------
    path : str or path
        A file that ends in .step, .stp, .iges or .igs.
    tolerance : float or str, optional
        Most distance between triangles and faces: in m, or as a str with its unit,
        "0.1 mm". If None a 5000th of the diagonal of the part's box.
    angle_deg : float, default 10.0
        Most angle between neighboring triangles on a curved face (deg), above 0 to 90.
    unit : str, optional
        What one unit of the file is ("mm", "in", ...), where the file says it wrongly.

    Returns
    -------
    Triangles
        Points (P, 3) in m and triangles (T, 3). Faces that meet share their corners. Each connected
        part is turned so that it is seen from above; a closed one so that it is seen from outside.

    Raises
    ------
    CadError
        No such file, not of its kind, without a face, so damaged that OpenCASCADE fails or
        crashes, which ends no more than a process of its own, or a tolerance that makes no sense.
    ImportError
        OpenCASCADE is not installed.

    Examples
    --------
    >>> points, triangles = plydrape.cad.read("mold.step")  # doctest: +SKIP
    >>> plydrape.cad.read("mold.dwg")
    Traceback (most recent call last):
    plydrape...CadError: mold.dwg: expected a file that ends in .step, .stp, .iges or .igs

    """
    where = Path(path)
    kind = where.suffix.lower()
    if kind not in (".step", ".stp", ".iges", ".igs"):
        raise CadError(f"{where}: expected a file that ends in .step, .stp, .iges or .igs")
    if not where.is_file():
        raise of_file(CadError(f"{where}: there is no such file"), "FileNotFoundError", where)
    if not 0.0 < angle_deg <= 90.0:
        raise CadError(
            f"an angle of {angle_deg:g} deg between triangles; above 0 to 90 makes sense"
        )
    chord = None if tolerance is None else _length(tolerance)
    if unit is not None and unit not in UNITS:
        raise CadError(f'"{unit}" is no unit of length; there are {", ".join(UNITS)}')
    factor = None if unit is None else UNITS[unit]

    points, triangles = _occ.read(where, chord, float(np.deg2rad(angle_deg)), factor)
    return Triangles(points, _upward(points, triangles))


def mold(
    path: str | os.PathLike[str],
    *,
    tolerance: float | str | None = None,
    angle_deg: float = 10.0,
    unit: str | None = None,
) -> Mold:
    """The faces of a STEP or IGES file as a mold for a scene; arguments and errors as of `read`.

    Parameters
    ----------
    path : str or path
        A file that ends in .step, .stp, .iges or .igs.
    tolerance : float or str, optional
        As of `read`.
    angle_deg : float, default 10.0
        As of `read`.
    unit : str, optional
        As of `read`.

    Returns
    -------
    Mold
        The mold.

    Raises
    ------
    ValueError
        The faces are no mold: they overlap, or more than two meet at one edge.

    Examples
    --------
    >>> mold = plydrape.cad.mold("mold.step", tolerance="0.1 mm")  # doctest: +SKIP
    >>> scene = plydrape.Scene(mold=mold, ply=ply, target={})  # doctest: +SKIP

    """
    from plydrape import Mold

    found = read(path, tolerance=tolerance, angle_deg=angle_deg, unit=unit)
    return Mold.triangles(found.points, found.triangles)


def convert(
    path: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    tolerance: float | str | None = None,
    angle_deg: float = 10.0,
    unit: str | None = None,
) -> Triangles:
    """Writes the faces of a STEP or IGES file as triangles in millimeters; arguments as of `read`.

    A scene takes the file: `[mold]`, `kind = "mesh"`, `file = "mold.stl"`, `unit = "mm"`. The file
    is written whole or not at all, and replaces one of that name.

    Parameters
    ----------
    path : str or path
        The STEP or IGES file.
    out : str or path
        The file to write: a binary STL (.stl) or a Wavefront OBJ (.obj), which has all digits.
    tolerance : float or str, optional
        See `read`.
    angle_deg : float, default 10.0
        See `read`.
    unit : str, optional
        See `read`.

    Returns
    -------
    Triangles
        What was written, in m.

    Raises
    ------
    CadError
        As of `read`, or the ending of `out` is another, or it cannot be written.

    Examples
    --------
    >>> plydrape.cad.convert("mold.step", "mold.stl")  # doctest: +SKIP
    >>> plydrape.cad.convert("mold.step", "mold.ply")
    Traceback (most recent call last):
    plydrape...CadError: mold.ply: expected a name that ends in .stl or .obj

    """
    target = Path(out)
    writers = {".stl": _stl, ".obj": _obj}
    if target.suffix.lower() not in writers:
        raise CadError(f"{target}: expected a name that ends in .stl or .obj")
    found = read(path, tolerance=tolerance, angle_deg=angle_deg, unit=unit)
    content = writers[target.suffix.lower()](found)
    try:
        handle, draft = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    except OSError as fault:
        raise CadError(f"{target}: cannot be written: {fault.strerror}") from fault
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        mask = os.umask(0)
        os.umask(mask)
        Path(draft).chmod(0o666 & ~mask)
        Path(draft).replace(target)
    except OSError as fault:
        raise CadError(f"{target}: cannot be written: {fault.strerror}") from fault
    finally:
        Path(draft).unlink(missing_ok=True)
    return found


def _length(value: float | str) -> float:
    """A length (m) from a number of meters or a text with a unit."""
    has_unit = not isinstance(value, str) or value.rstrip()[-1:].isalpha()
    try:
        found = _si(value, "length", "tolerance") if has_unit else 0.0
    except ValueError:
        found = 0.0
    if not found > 0.0:
        text = f'"{value}"' if isinstance(value, str) else f"{value} m"
        raise CadError(f'a tolerance of {text}; expected a length above 0 such as "0.1 mm"')
    return found


def _upward(points: NDArray[np.float64], triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    """Triangles turned so that each connected part faces up, a closed part outwards."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]]])
    part = _occ.groups(len(points), edges)
    part = part[triangles[:, 0]]
    a, b, c = (points[triangles[:, k]] - points.mean(axis=0) for k in range(3))
    normal = np.cross(b - a, c - a)
    up = np.bincount(part, normal[:, 2], len(points))
    area = np.bincount(part, np.linalg.norm(normal, axis=1), len(points))
    volume = np.bincount(part, np.einsum("ij,ij->i", a, np.cross(b, c)), len(points))
    flip = np.where(np.abs(up) > 1e-9 * area, up < 0.0, volume < 0.0)[part]
    out = triangles.copy()
    out[flip] = out[flip][:, ::-1]
    return out


def _stl(found: Triangles) -> bytes:
    """A binary STL in mm."""
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    facets = np.zeros(len(found.triangles), record)
    corners = found.points[found.triangles] * 1e3
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    facets["normal"] = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0.0)
    facets["corners"] = corners
    head = b"plydrape: binary STL, millimeters".ljust(80)
    return head + len(facets).to_bytes(4, "little") + facets.tobytes()


def _obj(found: Triangles) -> bytes:
    """A Wavefront OBJ in mm."""
    places = [f"v {x!r} {y!r} {z!r}" for x, y, z in (found.points * 1e3).tolist()]
    corners = [f"f {a} {b} {c}" for a, b, c in (found.triangles + 1).tolist()]
    return "\n".join(["# plydrape: millimeters", *places, *corners, ""]).encode()


def main(arguments: Sequence[str] | None = None) -> int:
    """The command: writes a mesh, says what it is; 0, or 2 if the input is bad."""
    about = "Turns the faces of a STEP or IGES file into a mesh for the mold of a scene."
    parser = argparse.ArgumentParser("python -m plydrape.cad", description=about)
    parser.add_argument("file", help="a .step, .stp, .iges or .igs file")
    parser.add_argument("-o", "--output", required=True, help="an .stl or .obj file to write")
    parser.add_argument(
        "--tolerance", help='most distance from the faces, "0.1mm"; default: diagonal / 5000'
    )
    parser.add_argument(
        "--angle", type=float, default=10.0, help="most angle between triangles, degrees (10)"
    )
    parser.add_argument(
        "--unit", help=f"what one unit of the file is, if it says it wrongly: {', '.join(UNITS)}"
    )
    given = parser.parse_args(arguments)
    try:
        found = convert(
            given.file,
            given.output,
            tolerance=given.tolerance,
            angle_deg=given.angle,
            unit=given.unit,
        )
    except (CadError, ImportError) as fault:
        print(f"error: {fault}", file=sys.stderr)
        return 2
    low, high = found.points.min(axis=0) * 1e3, found.points.max(axis=0) * 1e3
    span = ", ".join(f"{c} {a:.4g} to {b:.4g}" for c, a, b in zip("xyz", low, high, strict=True))
    print(f"{len(found.triangles)} triangles, in mm: {span}")
    print(f'wrote {given.output}; in the scene: file = "{given.output}", unit = "mm"')
    return 0


if __name__ == "__main__":
    sys.exit(main())
