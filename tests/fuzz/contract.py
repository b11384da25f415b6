"""What plydrape promises of every run, and how a run broke it.

- It ends, in time, by itself, with a documented exit code.
- Bad input gets one printable message with a remedy, and is not called a fault of plydrape.
- A folder is written whole or not at all, nothing else is left behind, and inputs stay as they are.
- Files can be read, and hold no NaN and no infinity.
"""

from __future__ import annotations

import json
import math
import re
import struct
import unicodedata
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn
from xml.etree import ElementTree

from .case import Outlet
from .process import Ended

CODES = (0, 1, 2, 3, 4, 130)
# Codes with which files are written; with 4 unless the message says that none was.
DONE = (0, 1, 3, 4, 130)
NOTHING_WRITTEN = "no file was written"
SIMULATED = {"result.json", "steps.csv", "trajectory.csv", "report.html"}
WRITTEN = {
    "simulate": SIMULATED,
    "plan": SIMULATED | {"motion.csv", "plan.json"},
    "net": {"nodes.csv", "net.vtp", "mold.vtp"},
    "report": {"report.html"},
    "study": {"study.parquet", "summary.json"},
}
LONGEST_MESSAGE = 20_000
# Below the message; or in its sentence, where a file cannot be made, or a study's scene is refused.
REMEDY = re.compile(r"^ +help: |choose|make room|^  × \S+\.toml:.*; ", re.MULTILINE)
IN_SENTENCE = re.compile(r"[:;][│\s]+[a-z]+\s")


@dataclass(frozen=True)
class Fault:
    """A promise that was broken, and how that shows."""

    promise: str
    detail: str

    def key(self, command: str) -> str:
        """A key that is the same for faults that are alike: without numbers and quoted values."""
        detail = re.sub(r'`[^`]*`|"[^"]*"|\'[^\']*\'', "…", self.detail.split("\n")[0])
        place = re.search(r"crates/\S+\.rs:\d+|[\w/]+\.(py|rs):\d+", self.detail)
        alike = place[0] if place else re.sub(r"[-+.\d]*\d", "#", detail)[:60]
        return f"{command}: {self.promise}: {alike}"


def faults(ended: Ended, folder: Path, before: dict[str, bytes], outlet: Outlet) -> list[Fault]:
    """Everything that is wrong with a run; `before` are the files that it found."""
    found = [*of_ending(ended), *of_messages(ended, outlet), *of_inputs(folder, before)]
    if found and ended.killed:
        return found  # what a killed program leaves is no fault of its own
    return found + list(of_folder(ended, folder, before))


def of_ending(ended: Ended) -> Iterator[Fault]:
    """Faults of time, signals and exit codes."""
    text = ended.stderr.decode(errors="replace")
    if "panicked at" in text or ended.code == 101:
        yield Fault("no panic", text[-600:] or "exit 101")
    elif ended.killed:
        doing = "waits" if ended.cpu < 0.2 else "computes"
        yield Fault("ends in time", f"it still {doing} after {ended.seconds:.0f} s")
    elif "Traceback (most recent call last)" in text:
        yield Fault("no traceback", "\n".join(text.strip().splitlines()[-1:]) + "\n" + text[-1500:])
    elif ended.code < 0:
        yield Fault("no signal", f"signal {-ended.code}: {text[-300:]}")
    elif ended.code not in CODES:
        yield Fault("a documented exit code", f"exit {ended.code}: {text[-300:]}")


def of_messages(ended: Ended, outlet: Outlet) -> Iterator[Fault]:
    """Faults of what was printed."""
    for name, content in (("output", ended.stdout), ("error", ended.stderr)):
        try:
            text = content.decode()
        except UnicodeDecodeError as error:
            yield Fault("printable words", f"standard {name} is not UTF-8: {error}")
            continue
        strange = {c for c in text if unicodedata.category(c) == "Cc" and c not in "\n\t"}
        if strange:
            yield Fault(
                "printable words", f"control characters in standard {name}\n{sorted(strange)!r}"
            )
    text = ended.stderr.decode(errors="replace")
    if len(text) > LONGEST_MESSAGE:
        yield Fault("a short message", f"{len(text)} bytes on standard error")
    unseen = outlet in (Outlet.STDERR_FULL, Outlet.BOTH_FULL)
    if ended.code in (2, 4) and not unseen and "Traceback" not in text:
        heads = [line for line in text.splitlines() if line.startswith("  × ")]
        usage = text.startswith("error: ")  # of the command line itself
        if len(heads) != 1 and not usage:
            yield Fault("one message", f"{len(heads)} messages: {text[:500]}")
        elif (
            not usage
            and not REMEDY.search(text)
            and not (ended.command[0] in ("export", "report") and IN_SENTENCE.search(text))
        ):
            yield Fault("a remedy", text[:500].strip())
    if "please report it" in " ".join(text.replace("│", "").split()):
        yield Fault("no fault of its own", text[:500])
    if ended.code in (0, 1) and "  × " in text:
        yield Fault("one message", f"exit {ended.code} with a message: {text[:500]}")


def of_inputs(folder: Path, before: dict[str, bytes]) -> Iterator[Fault]:
    """Faults of the files that were there before."""
    for name, content in before.items():
        path = folder / name
        if not path.is_file() or path.read_bytes() != content:
            yield Fault("inputs stay as they are", f"{name} was changed")


def of_folder(ended: Ended, folder: Path, before: dict[str, bytes]) -> Iterator[Fault]:
    """Faults of the folder that was written, and of what is left beside it."""
    out, command = folder / "out", ended.command[0]
    done = ended.code in DONE and NOTHING_WRITTEN not in ended.stderr.decode(errors="replace")
    if any(Path(name).parts[0] == "out" for name in before):
        found = {str(path.relative_to(folder)) for path in out.rglob("*")}
        # what cannot be printed may end the run before anything is written
        if done and ended.code != 4:
            yield Fault("what is the user's stays", f"exit {ended.code}, though it is in the way")
        elif more := found - set(before):
            yield Fault("what is the user's stays", f"exit {ended.code}, but more\n{sorted(more)}")
        return
    for path in folder.rglob("*"):
        if path.name.startswith((".plydrape-", ".tmp")) or path.suffix in (".tmp", ".part"):
            yield Fault(
                "nothing is left behind", f"{path.relative_to(folder).parts[0]}: {path.name[:10]}"
            )
            return
    if command == "new":
        made = [p for p in folder.rglob("*.toml") if "mine" in p.parts]
        if not done and (made or (folder / "mine").exists()):
            yield Fault("written whole or not at all", f"exit {ended.code}, but something was made")
        elif done and (not made or not made[0].read_bytes().endswith(b"\n")):
            yield Fault("written whole or not at all", f"exit {ended.code}, but no scene")
        return
    if command == "check" or not done:
        if out.exists():
            left = sorted(p.name for p in out.rglob("*"))
            yield Fault("written whole or not at all", f"exit {ended.code}, but a folder\n{left}")
        return
    if (ended.code == 3 or (ended.code == 4 and not ended.stderr)) and not out.exists():
        return  # no solution, and nothing to show; or nothing, and nowhere to say so
    names = {p.name for p in out.iterdir()} if out.is_dir() else set()
    if missing := WRITTEN.get(command, set()) - names:
        yield Fault("written whole or not at all", f"exit {ended.code}, but no {sorted(missing)}")
    if command != "study":
        yield from of_manifest(out, names)
    for name in sorted(names):
        yield from of_file(out / name)


def of_manifest(out: Path, names: set[str]) -> Iterator[Fault]:
    """Faults of the list that the folder keeps of its files: check sums and lengths."""
    try:
        manifest: dict[str, Any] = json.loads((out / ".plydrape").read_bytes())
        is_sealed = manifest["sealed"]
        listed = {name: entry["contents"] for name, entry in manifest["files"].items()}
    except (OSError, ValueError, LookupError, TypeError) as error:
        yield Fault("written whole or not at all", f"the list of files: {error!r}")
        return
    if is_sealed is not True:
        yield Fault("written whole or not at all", "the list of files has no seal")
    if set(listed) != names - {".plydrape"}:
        yield Fault(
            "written whole or not at all", f"not as listed\n{sorted(listed)}\n{sorted(names)}"
        )
        return
    for name, stamps in listed.items():
        content = (out / name).read_bytes()
        if stamps != [{"crc32": zlib.crc32(content), "length": len(content)}]:
            yield Fault("written whole or not at all", f"{name} is not what the list says")


# NaN or infinity as a word of its own, not in a name or in quotes; in SVG also behind a letter.
NOT_A_NUMBER = re.compile(r"(?i)(?<![\w.\"'#])[-+.]*(nan|inf|infinity)(?![\w\"'])")
IN_SVG = re.compile(r"(?<![a-z])[-+]?(NaN|inf)(?![a-z])")


def of_file(path: Path) -> Iterator[Fault]:
    """Faults of one written file."""
    name = re.sub(r"_\d+", "_#", path.name)
    try:
        if path.suffix == ".json":
            json.loads(path.read_bytes(), parse_constant=refuse)
        elif name == "report.html":
            of_page(path.read_text())
        elif path.suffix in (".svg", ".pvd"):
            of_xml(path.read_text())
        elif path.suffix == ".vtp":
            of_vtk(path.read_bytes())
        elif path.suffix in (".csv", ".yaml", ".inp"):
            of_text(path.read_text(), "**" if path.suffix == ".inp" else "#")
    except NotFiniteError as error:
        yield Fault("no NaN and no infinity", f"{name}: {error}")
    except (ValueError, ElementTree.ParseError, struct.error, KeyError) as error:
        yield Fault("files can be read", f"{name}: {error}")


class NotFiniteError(Exception):
    """A NaN or an infinity was found."""


def refuse(where: str) -> NoReturn:
    """Says where it is."""
    raise NotFiniteError(where)


def of_text(text: str, comment: str) -> None:
    """No number in a table or a deck is NaN or infinite."""
    lower = text.lower()
    if "nan" not in lower and "inf" not in lower:
        return
    for number, line in enumerate(text.splitlines(), 1):
        found = None if line.startswith(comment) else NOT_A_NUMBER.search(line)
        if found and '"' not in line[: found.start()]:
            refuse(f"line {number}: {line[:80]}")


def of_xml(text: str) -> None:
    """No attribute holds NaN or infinity."""
    root = ElementTree.fromstring(text)
    if "NaN" not in text and "inf" not in text:
        return
    for item in root.iter():
        for key, value in item.attrib.items():
            if IN_SVG.search(value):
                refuse(f"{key} of {item.tag}")


def of_page(text: str) -> None:
    """The data in a page are JSON, and end where they should."""
    marked = re.search(
        r'<script type="application/json" id="plydrape-data">(.*?)</script>', text, re.S
    )
    if not marked:
        raise ValueError("no data in it")
    json.loads(marked[1], parse_constant=refuse)


def of_vtk(content: bytes) -> None:
    """Every array of floating-point numbers is finite."""
    head, _, tail = content.partition(b'<AppendedData encoding="raw">')
    data = tail[tail.index(b"_") + 1 :] if tail else b""
    end = b"</VTKFile>" if tail else b""
    for item in ElementTree.fromstring(head + end).iter("DataArray"):
        kind, code = item.attrib["type"], {"Float64": "d", "Float32": "f"}
        if kind not in code or item.attrib["format"] != "appended":
            continue
        at = int(item.attrib["offset"])
        (size,) = struct.unpack_from("<Q", data, at)
        count = size // struct.calcsize(code[kind])
        if not all(map(math.isfinite, struct.unpack_from(f"<{count}{code[kind]}", data, at + 8))):
            refuse(item.attrib["Name"])
