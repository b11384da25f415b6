"""OpenCASCADE: reads STEP and IGES, meshes their faces, joins the faces where they meet.

OpenCASCADE divides each edge once for both of its faces. Nodes on a shared edge are therefore
joined by their number along the edge, not by their distance, and the surface has no cracks.

Of twenty damaged files it crashes on one or so, and some keep it busy without end. It therefore
runs in a process of its own, whose time has a bound.
"""

from __future__ import annotations

import math
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from plydrape._extra import load
from plydrape.errors import CadError, ExtraError

if TYPE_CHECKING:
    from numpy.typing import NDArray

FINE = 1.0 / 5000.0
"""The tolerance if none is given, as a share of the diagonal of the part's box."""

SEAM = 0.1
"""Faces are joined along edges that are closer than this share of the tolerance."""

STEP_UNITS = {
    "millimetre": 1e-3,
    "centimetre": 1e-2,
    "metre": 1.0,
    "micrometre": 1e-6,
    "inch": 0.0254,
    "foot": 0.3048,
}
"""Names of units in STEP files, and their meters."""


REFUSED, MISSING = 3, 4
"""Exit codes of the process that reads: its `CadError` is in a file; there is no OpenCASCADE."""

TOO_LONG = -signal.SIGXCPU if hasattr(signal, "SIGXCPU") else None
"""Exit code of a process that a signal ends after its processor time; None without this signal."""

PROGRAM = """\
import sys
sys.path = [path for path in sys.path if path]
from plydrape._occ import child
sys.exit(child())
"""
"""What the process runs, by a way that takes no folder `plydrape` of the current one for it."""

BUSY = (15.0, 60.0)
"""Processor time (s) that reading may take where the system bounds it, and more for 10⁶ bytes."""

REPAIR = "repair the part in the program that made it, or export the faces as an STL or OBJ file"


def read(
    path: Path, chord: float | None, angle: float, unit: float | None
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Triangles of a file's faces, read in a process of its own.

    Parameters
    ----------
    path : path
        A file that ends in .step, .stp, .iges or .igs.
    chord : float or None
        Most distance between triangles and faces (m); a share of the part if None.
    angle : float
        Most angle between neighboring triangles (rad).
    unit : float or None
        What one unit of the file is (m), where the file says it wrongly.

    Returns
    -------
    tuple of ndarray, ndarray
        Points (P, 3) in m and triangles (T, 3), turned as the faces are.

    Raises
    ------
    CadError
        The file is refused, or OpenCASCADE has crashed.
    ExtraError
        OpenCASCADE is not installed.

    """
    with tempfile.TemporaryDirectory(prefix="plydrape-cad-") as folder:
        surroundings = os.environ | {"PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
        seconds = BUSY[0] + BUSY[1] * path.stat().st_size / 1e6
        given = [str(path), folder, repr(chord), repr(angle), repr(unit), repr(seconds)]
        done = subprocess.run(
            [sys.executable, "-c", PROGRAM, *given],
            env=surroundings,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            check=False,
        )
        if done.returncode == MISSING:
            raise ExtraError("OpenCASCADE", "cadquery-ocp-novtk")
        if done.returncode == REFUSED:
            raise CadError((Path(folder) / "refused").read_text(encoding="utf-8"))
        if done.returncode == TOO_LONG:
            raise CadError(
                f"{path}: OpenCASCADE is busy for more than {seconds:.0f} s of processor time; "
                f"{REPAIR}, or give a larger tolerance"
            )
        if done.returncode != 0:
            said = done.stderr.decode(errors="replace").strip().splitlines()
            why = f"fails: {said[-1][:200]}" if said and done.returncode > 0 else "crashes on it"
            raise CadError(f"{path}: OpenCASCADE {why}; {REPAIR}")
        with np.load(Path(folder) / "read.npz") as arrays:
            return arrays["points"], arrays["triangles"]


def bound(seconds: float) -> None:
    """Ends this process by a signal after this much processor time, where the system can do so."""
    if find_spec("resource") is None:
        return
    import resource

    most = math.ceil(seconds)
    _, hard = resource.getrlimit(resource.RLIMIT_CPU)
    if hard == resource.RLIM_INFINITY or most < hard:
        resource.setrlimit(resource.RLIMIT_CPU, (most, hard))


def child() -> int:
    """Reads the file of the arguments, and writes what is in it, or why not; the exit code."""
    path, folder, *numbers = sys.argv[1:]
    chord, angle, unit, seconds = (None if text == "None" else float(text) for text in numbers)
    assert angle is not None
    assert seconds is not None
    bound(seconds)
    try:
        points, triangles = read_here(Path(path), chord, angle, unit)
    except ExtraError:
        return MISSING
    except CadError as error:
        (Path(folder) / "refused").write_text(str(error), encoding="utf-8")
        return REFUSED
    np.savez(Path(folder) / "read.npz", points=points, triangles=triangles)
    return 0


def read_here(
    path: Path, chord: float | None, angle: float, unit: float | None
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Reads a CAD file in this process, which ends where OpenCASCADE crashes; see `read`.

    Raises
    ------
    CadError
        The file is refused.

    """
    need("gp")
    with quiet():
        source = step if path.suffix.lower() in (".step", ".stp") else iges
        try:
            shape, scale = source(path, unit)
            if shape is None or shape.IsNull() or not faces(shape):
                raise CadError(f"{path}: no face in it; a mold needs surfaces, not only curves")
            deflection = FINE * size(shape) if chord is None else chord / scale
            shape = sewn(shape, SEAM * deflection)
            points, triangles = mesh(shape, deflection, angle)
        except Exception as error:
            if not type(error).__module__.startswith("OCP."):
                raise
            why = " ".join(str(error).split())[:200]
            raise CadError(f"{path}: OpenCASCADE cannot read it ({why}); {REPAIR}") from error
    points = points * scale
    if len(triangles) == 0 or not np.isfinite(points).all():
        raise CadError(f"{path}: its faces could not be divided into triangles; {REPAIR}")
    return points, triangles


def need(module: str) -> ModuleType:
    """A module of OpenCASCADE."""
    return load(f"OCP.{module}", package="cadquery-ocp-novtk", name="OpenCASCADE")


def step(path: Path, unit: float | None) -> tuple[Any, float]:
    """The shape of a STEP file, and the meters of one of its units."""
    reader = need("STEPControl").STEPControl_Reader()
    _read(reader, path, "STEP")
    scale = 1e-3  # the reader brings all units to mm
    if unit is not None:
        names = [_sequence() for _ in range(3)]
        reader.FileUnits(*names)
        said = {name.ToCString().lower() for name in names[0]}
        if len(said) != 1 or not said <= STEP_UNITS.keys():
            raise CadError(
                f"{path}: its unit cannot be replaced, for it says "
                f"{' and '.join(sorted(said)) or 'none'}; leave `unit` out"
            )
        scale *= unit / STEP_UNITS[said.pop()]
    reader.TransferRoots()
    return reader.OneShape(), scale


def iges(path: Path, unit: float | None) -> tuple[Any, float]:
    """The shape of an IGES file, and the meters of one of its units."""
    reader = need("IGESControl").IGESControl_Reader()
    _read(reader, path, "IGES")
    if reader.IGESModel().NbEntities() == 0:
        raise CadError(f"{path}: this is no IGES file")
    scale = 1e-3
    if unit is not None:
        scale *= unit / (reader.IGESModel().GlobalSection().UnitValue() * 1e-3)
    reader.TransferRoots()
    return reader.OneShape(), scale


def _read(reader: Any, path: Path, kind: str) -> None:
    status = reader.ReadFile(str(path))
    if status != need("IFSelect").IFSelect_ReturnStatus.IFSelect_RetDone:
        raise CadError(f"{path}: this is no {kind} file")


def _sequence() -> Any:
    return load(
        "OCP.OCP.collections", package="cadquery-ocp-novtk", name="OpenCASCADE"
    ).Sequence_TCollection_AsciiString()


def sewn(shape: Any, tolerance: float) -> Any:
    """The faces of a shape, joined along edges that are no more than `tolerance` apart."""
    sewing = need("BRepBuilderAPI").BRepBuilderAPI_Sewing(tolerance)
    sewing.Add(shape)
    sewing.Perform()
    joined = sewing.SewedShape()
    return shape if joined.IsNull() else joined


def size(shape: Any) -> float:
    """The diagonal of a shape's box; 0 if there is nothing."""
    box = need("Bnd").Bnd_Box()
    need("BRepBndLib").BRepBndLib.AddOptimal_s(shape, box, False, False)
    return 0.0 if box.IsVoid() else float(np.sqrt(box.SquareExtent()))


def faces(shape: Any) -> list[Any]:
    """The faces of a shape, with their orientation."""
    top = need("TopAbs").TopAbs_ShapeEnum
    explorer = need("TopExp").TopExp_Explorer(shape, top.TopAbs_FACE)
    cast = need("TopoDS").TopoDS.Face
    out = []
    while explorer.More():
        out.append(cast(explorer.Current()))
        explorer.Next()
    return out


def mesh(
    shape: Any, deflection: float, angle: float
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Triangles of a shape's faces, joined where faces share an edge.

    Parameters
    ----------
    shape : Any
        The shape.
    deflection : float
        Most distance of a triangle from its face.
    angle : float
        Most angle between neighboring triangles (rad).

    Returns
    -------
    tuple of ndarray, ndarray
        Points (P, 3) and triangles (T, 3) in the unit of the shape, turned as the faces are.

    """
    settings = need("IMeshTools").IMeshTools_Parameters()
    settings.Deflection = settings.DeflectionInterior = deflection
    settings.Angle = settings.AngleInterior = angle
    settings.ControlSurfaceDeflection = True
    need("BRepMesh").BRepMesh_IncrementalMesh(shape, settings)
    places: list[NDArray[np.float64]] = []
    corners: list[NDArray[np.int64]] = []
    joints: dict[int, list[tuple[Any, NDArray[np.int64]]]] = {}
    pairs = [np.zeros((0, 2), np.int64)]
    count = 0
    for face in faces(shape):
        where = need("TopLoc").TopLoc_Location()
        held = need("BRep").BRep_Tool.Triangulation_s(face, where)
        if held is None:
            continue
        points, triangles = _triangulation(face, held, where)
        for edge, nodes, point in _edges(face, held, where):
            shared = nodes + count
            if point:
                pairs.append(np.stack([shared[:-1], shared[1:]], axis=-1))
            # the same edge of another face, or of this one where it closes on itself
            known = joints.setdefault(hash(edge), [])
            pairs += [
                np.stack([other, shared], axis=-1)
                for same, other in known
                if same.IsSame(edge) and len(other) == len(shared)
            ]
            known.append((edge, shared))
        places.append(points)
        corners.append(triangles + count)
        count += len(points)
    if not corners:
        return np.zeros((0, 3)), np.zeros((0, 3), np.int64)
    return merged(np.concatenate(places), np.concatenate(corners), np.concatenate(pairs))


def _triangulation(
    face: Any, held: Any, where: Any
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Points and triangles of a face, moved and turned as the face is."""
    move = where.Transformation()
    nodes = (held.Node(k + 1).Transformed(move) for k in range(held.NbNodes()))
    points = np.array([(p.X(), p.Y(), p.Z()) for p in nodes]).reshape(-1, 3)
    corners = (held.Triangle(k + 1) for k in range(held.NbTriangles()))
    triangles = np.array([[t.Value(k) - 1 for k in (1, 2, 3)] for t in corners], np.int64)
    if face.Orientation() == need("TopAbs").TopAbs_Orientation.TopAbs_REVERSED:
        triangles = triangles[:, ::-1]
    return points, triangles.reshape(-1, 3)


def _edges(face: Any, held: Any, where: Any) -> Iterator[tuple[Any, NDArray[np.int64], bool]]:
    """The edges of a face, the nodes along each, and whether it is but a point."""
    top, tool = need("TopAbs").TopAbs_ShapeEnum, need("BRep").BRep_Tool
    cast = need("TopoDS").TopoDS.Edge
    explorer = need("TopExp").TopExp_Explorer(face, top.TopAbs_EDGE)
    while explorer.More():
        edge = cast(explorer.Current())
        explorer.Next()
        line = tool.PolygonOnTriangulation_s(edge, held, where)
        if line is not None:
            nodes = np.array([line.Node(k + 1) - 1 for k in range(line.NbNodes())], np.int64)
            yield edge, nodes, bool(tool.Degenerated_s(edge))


def groups(count: int, pairs: NDArray[np.int64]) -> NDArray[np.int64]:
    """The smallest number of the group of each of `count` things that pairs (N, 2) connect.

    Examples
    --------
    >>> groups(5, np.array([[3, 1], [3, 4]])).tolist()
    [0, 1, 2, 1, 1]

    """
    root = np.arange(count)
    # numbers fall until none does; groups are short, so this ends after a few rounds
    while True:
        before = root.copy()
        low = root[pairs].min(axis=1)
        for side in (0, 1):
            np.minimum.at(root, pairs[:, side], low)
        root = root[root]
        if (root == before).all():
            return root


def merged(
    points: NDArray[np.float64], triangles: NDArray[np.int64], pairs: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Points without those that a pair (N, 2) says are another one, and the triangles that remain.

    Examples
    --------
    >>> square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    >>> points, triangles = plydrape._occ.merged(
    ...     square, np.array([[0, 1, 2], [3, 4, 5]]), np.array([[0, 3], [2, 4]])
    ... )
    >>> len(points), triangles.tolist()
    (4, [[0, 1, 2], [0, 2, 3]])

    """
    root = groups(len(points), pairs)
    root = root[triangles]
    flat = (root[:, 0] == root[:, 1]) | (root[:, 1] == root[:, 2]) | (root[:, 2] == root[:, 0])
    used, triangles = np.unique(root[~flat], return_inverse=True)
    return points[used], triangles.reshape(-1, 3).astype(np.int64)


@contextmanager
def quiet() -> Iterator[None]:
    """OpenCASCADE tells what it does on the standard output; not while this lasts."""
    messenger = need("Message").Message.DefaultMessenger_s()
    printers = list(messenger.Printers())
    for printer in printers:
        messenger.RemovePrinter(printer)
    try:
        yield
    finally:
        for printer in printers:
            messenger.AddPrinter(printer)
