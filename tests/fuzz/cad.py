"""`scripts/fuzz cad`: damaged STEP and IGES files, read by `plydrape.cad`.

OpenCASCADE makes sound files of a cap, a patch, a free-form face and a box. Mutations know the
formats: they change numbers, references, keywords and types of entities, leave lines out, put
them in twice or elsewhere, and damage bytes; the sections of an IGES file are counted again, as
otherwise only the counts would be tested. Each file is read in a process of its own:

- It ends within 20 s of processor time and 4 GB.
- What is read is finite; what is refused is a `CadError` with one short message.
- Where OpenCASCADE crashes, is busy for too long or has no memory, `plydrape.cad.read` says so,
  which is tried of the first cases of each kind.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib.util
import os
import re
import resource
import shutil
import signal
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from random import Random

from . import values
from .options import ROOT, seconds_or_count

CPU = 20  # seconds of a small input
MEMORY = 4 << 30  # bytes of address space
KEEP = ROOT / "target" / "fuzz-cad"
# How a reading ends, as exit codes of its process.
READ, REFUSED, NO_MEMORY, WRONG = 0, 3, 4, 5
# Signals of a crash, and that of too much processor time, which users' way bounds more narrowly.
ENDED = tuple(
    -getattr(signal, f"SIG{name}") for name in ("SEGV", "ABRT", "FPE", "BUS", "ILL", "XCPU")
)
TRIED = 10  # crashes of each kind that are read by users' way too
ANGLE = 0.17  # between triangles (rad)


def sound(folder: Path) -> dict[str, list[bytes]]:
    """Files that OpenCASCADE writes, by ending."""
    from math import pi

    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeTorus
    from OCP.Geom import Geom_BezierSurface
    from OCP.gp import gp_Ax3, gp_Cylinder, gp_Dir, gp_Pnt, gp_Sphere
    from OCP.IGESControl import IGESControl_Writer
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer
    from plydrape import _occ

    def net() -> object:
        module = __import__("OCP.OCP.collections", fromlist=["x"])
        poles = module.Array2_gp_Pnt(1, 4, 1, 4)
        for i in range(4):
            for j in range(4):
                poles.SetValue(i + 1, j + 1, gp_Pnt(100 * i, 100 * j, 20 * ((i * j) % 3)))
        return BRepBuilderAPI_MakeFace(Geom_BezierSurface(poles), 1e-6).Face()

    at = gp_Ax3(gp_Pnt(0, 0, -200), gp_Dir(0, 0, 1))
    along = gp_Ax3(gp_Pnt(0, -150, 0), gp_Dir(0, 1, 0), gp_Dir(0, 0, 1))
    shapes = [
        BRepBuilderAPI_MakeFace(gp_Sphere(at, 200), 0, 2 * pi, pi / 4, pi / 2).Face(),
        BRepBuilderAPI_MakeFace(gp_Cylinder(along, 200), -0.5, 0.7, 0, 300).Face(),
        BRepPrimAPI_MakeBox(300, 200, 50).Shape(),
        BRepPrimAPI_MakeTorus(200, 60).Shape(),
    ]
    with contextlib.suppress(Exception):  # arrays of points have other names in other versions
        shapes.append(net())
    made: dict[str, list[bytes]] = {".step": [], ".iges": []}
    with _occ.quiet():
        for shape in shapes:
            step, iges = STEPControl_Writer(), IGESControl_Writer("MM", 0)
            step.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
            step.Write(str(folder / "a.step"))
            iges.AddShape(shape)
            iges.ComputeModel()
            iges.Write(str(folder / "a.iges"))
            for ending, files in made.items():
                files.append((folder / f"a{ending}").read_bytes())
    return made


NUMBER = re.compile(rb"[-+]?\d+\.\d*(?:[eED][-+]?\d+)?")
REFERENCE = re.compile(rb"#\d+")
KEYWORD = re.compile(rb"[A-Z_]{6,}")
FIELD = re.compile(rb"-?\d+")


def swapped(rng: Random, content: bytes, pattern: re.Pattern[bytes], new: list[bytes]) -> bytes:
    """One match is another text, or that of another match."""
    found = list(pattern.finditer(content))
    if not found:
        return content
    at = rng.choice(found)
    text = rng.choice(new) if new and rng.random() < 0.5 else rng.choice(found)[0]
    return content[: at.start()] + text + content[at.end() :]


def mutated(rng: Random, content: bytes, is_step: bool) -> bytes:
    """The file with one more change."""
    number = repr(values.number(rng, 100)).encode()
    whole = str(rng.choice((0, -1, 1, 7, 1000, 2**31 - 1, 2**31, 10**12))).encode()
    match rng.randrange(9):
        case 0 | 1:
            return swapped(rng, content, NUMBER, [number, b"1.E308", b"0.", b"-1.E-300"])
        case 2 if is_step:
            return swapped(rng, content, REFERENCE, [b"#" + whole.lstrip(b"-"), b"#1", b"$", b"*"])
        case 3 if is_step:
            return swapped(rng, content, KEYWORD, [b"PLANE", b"CIRCLE", b"B_SPLINE_CURVE", b"X"])
        case 2 | 3 | 4:
            return swapped(rng, content, FIELD, [whole])
        case 5:
            lines = content.split(b"\n")
            a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
            match rng.randrange(3):
                case 0:
                    del lines[a]
                case 1:
                    lines.insert(b, lines[a])
                case _:
                    lines[a], lines[b] = lines[b], lines[a]
            return b"\n".join(lines)
        case 6:
            return content[: rng.randrange(len(content))]
        case 7:
            at = rng.randrange(len(content))
            return content[:at] + bytes([rng.randrange(256)]) + content[at + 1 :]
        case _:
            a, b = sorted(rng.randrange(len(content)) for _ in range(2))
            at = rng.randrange(len(content))
            return content[:at] + content[a : min(b, a + 200)] + content[at:]


def counted(content: bytes) -> bytes:
    """An IGES file whose lines have 80 columns, and whose sections are numbered and counted."""
    counts: Counter[str] = Counter()
    out = []
    for line in content.split(b"\n"):
        body = line.rstrip(b"\r").ljust(80)[:73]
        section = line[72:73].decode("latin-1")
        if section not in "SGDP" or not section:
            continue
        counts[section] += 1
        out.append(body + b"%7d" % counts[section])
    ends = "".join(f"{s}{counts[s]:7}" for s in "SGDP")
    return b"\n".join([*out, (ends.ljust(72) + "T      1").encode(), b""])


def reading(path: Path) -> int:
    """Reads the file in this process; how that ends."""
    import numpy as np
    from plydrape import _occ
    from plydrape.errors import CadError

    try:
        points, triangles = _occ.read_here(path, None, ANGLE, None)
    except CadError as error:
        print(str(error)[:300], file=sys.stderr)
        return REFUSED if is_short(str(error)) else WRONG
    except MemoryError:
        return NO_MEMORY
    except BaseException as error:
        print(f"{type(error).__name__}: {error}"[:500], file=sys.stderr)
        return WRONG
    if len(triangles) and np.isfinite(points).all():
        return READ
    print("what is read is not finite", file=sys.stderr)
    return WRONG


def is_short(message: str) -> bool:
    """Whether a message is one line that can be read."""
    return 0 < len(message) < 2000 and "\n" not in message


def is_refused(path: Path) -> bool:
    """Whether a file is refused by the way that users have."""
    from plydrape import cad
    from plydrape.errors import CadError

    try:
        cad.read(path)
    except CadError as error:
        return is_short(str(error))
    return False


def ended(path: Path) -> tuple[int, str]:
    """Reads the file in a process of its own: its exit code, or the negative number of a signal."""
    said = path.with_suffix(".said")
    child = os.fork()
    if child == 0:
        code = WRONG
        try:
            resource.setrlimit(resource.RLIMIT_CPU, (CPU, CPU + 1))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            handle = os.open(said, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
            os.dup2(handle, 1)
            os.dup2(handle, 2)
            code = reading(path)
            sys.stderr.flush()
        finally:
            os._exit(code)
    _, status = os.waitpid(child, 0)
    return os.waitstatus_to_exitcode(status), said.read_text(errors="replace")[-500:]


def main() -> int:
    """Reads damaged files; the exit code."""
    parser = argparse.ArgumentParser("scripts/fuzz cad", description=__doc__.partition("\n")[0])
    seconds_or_count(parser)
    options = parser.parse_args()
    if any(importlib.util.find_spec(name) is None for name in ("OCP", "plydrape")):
        print("NO STEP AND IGES: OpenCASCADE is missing; scripts/venv --heavy installs it")
        return 0
    import plydrape.cad

    counts: Counter[str] = Counter()
    kinds: Counter[str] = Counter()
    crashes: Counter[int] = Counter()
    began, number, slowest = time.monotonic(), 0, 0.0
    with tempfile.TemporaryDirectory(prefix="plydrape-cad-") as name:
        folder = Path(name)
        files = sound(folder)
        # what is loaded once is loaded by all
        plydrape.cad.read(folder / "a.step")
        while number < options.count:
            if options.seconds and time.monotonic() - began > options.seconds:
                break
            rng = Random(f"{options.seed} cad {number}")
            ending = rng.choice(list(files))
            content = rng.choice(files[ending])
            for _ in range(rng.choice((1, 1, 2, 4, 8))):
                content = mutated(rng, content, ending == ".step") or b" "
            if ending == ".iges" and rng.random() < 0.8:
                content = counted(content)
            path = folder / f"case{ending}"
            path.write_bytes(content)
            used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            code, said = ended(path)
            if code in ENDED or code == NO_MEMORY:
                crashes[code] += 1
                if crashes[code] > TRIED or is_refused(path):
                    code = REFUSED
            slowest = max(slowest, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - used)
            number += 1
            if code in (READ, REFUSED):
                counts[f"{ending}: {'read' if code == READ else 'refused'}"] += 1
                continue
            how = signal.Signals(-code).name if code < 0 else f"exit {code}"
            what = f"{ending}: {how}: {said.strip().splitlines()[-1][:80] if said.strip() else ''}"
            kinds[what] += 1
            if kinds[what] == 1:
                KEEP.mkdir(parents=True, exist_ok=True)
                kept = KEEP / f"{options.seed}-{number}{ending}"
                shutil.copy2(path, kept)
                print(f"BROKEN {what}\n  kept as {kept}", flush=True)
    print("\n".join(f"{n:>7}  {what}" for what, n in sorted((counts + kinds).items())))
    rate = number / max(time.monotonic() - began, 1e-9)
    print(
        f"cad: {number} inputs, {rate:.0f} a second, seed {options.seed}, "
        f"OpenCASCADE crashed or did not end on {sum(crashes.values())}, "
        f"{sum(kinds.values())} faults; the slowest took {slowest:.1f} s"
    )
    return 1 if kinds else 0


if __name__ == "__main__":
    sys.exit(main())
