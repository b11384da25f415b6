"""Reads the chapters of the user guide: commands, what they show, the files they write.

- A block `console` holds commands behind `$ ` (a backslash continues a line) and below each what
  it prints. `# exit 2` behind a command is the exit code it has to have; 0 if absent.
- What is shown stands for all that is printed, as one machine printed it. Words have to be the
  same; numbers within a fifth, so that small changes and other machines pass; how long the machine
  took, and where of several equal places something is, may differ. A line `…` stands for lines that
  are left out. A command with nothing below it may print what it likes.
- A block `{code-block}` with a `:caption:` is a file of that name.
- Commands that are not run are in a block `sh` below a comment `<!-- not run: why -->`. Those
  that need a program which may be missing, or a module of Python, are in a `console` block below
  `<!-- needs: program python:module … -->`.

    PLYDRAPE=target/checked/plydrape .venv/bin/python tests/python/guide.py docs/guide/planning.md

records what the commands of chapters print now: it replaces the numbers of the lines that are
shown, and a line `@` by all lines that were printed there.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path

FENCE = re.compile(r"^(?P<fence>`{3,})(?P<info>.*)$")
COMMENT = re.compile(r"^<!-- (?P<key>not run|needs): (?P<text>.+?) -->$")
EXIT = re.compile(r"\s+# exit (?P<code>\d+)$")
ELLIPSIS = "…"
EXPAND = "@"

NUMBER = re.compile(r"[-−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
TOKEN = re.compile(rf"(?<![\w.]){NUMBER.pattern}|\w+|[^\w\s]")
# places that symmetry or rounding may exchange: grippers, cells, points of the fabric
NAME = re.compile(r"\bg\d+_\d+|\[\d+,\d+\]|\(-?[\d.]+, -?[\d.]+\)")
ROW = re.compile(r" +(\d+) +[\d.]+ ")
# how long something takes, which is written before it begins and every minute
PROGRESS = re.compile(r"plydrape: (\d+ (s|min|h)\b|draping at most )")
# how long the machine took, and versions
FREE = re.compile(r"(?<=\bin )[\d.]+ s|\b\d+\.\d+\.\d+\b")


@dataclass
class Command:
    """A command, the code it has to end with, and what the guide shows of its output."""

    line: int
    text: str
    code: int = 0
    shown: list[str] = field(default_factory=list)


@dataclass
class Block:
    """One fenced block of a chapter."""

    line: int
    info: str
    body: list[str]
    caption: str | None = None
    not_run: str | None = None
    needs: str | None = None

    def commands(self) -> list[Command]:
        """The commands of a console block."""
        commands: list[Command] = []
        continued = False
        for number, text in enumerate(self.body, start=self.line + 1):
            if continued:
                commands[-1].text += "\n" + text
            elif text.startswith("$ "):
                commands.append(Command(number, text[2:]))
            elif commands:
                commands[-1].shown.append(text)
            else:
                raise ValueError(f"line {number}: a console block begins with a command, `$ …`")
            continued = text.endswith("\\") and (continued or text.startswith("$ "))
        for command in commands:
            if code := EXIT.search(command.text):
                command.code = int(code["code"])
                command.text = command.text[: code.start()]
        return commands


def blocks(text: str) -> Iterator[Block]:
    """The fenced blocks of a chapter in their order."""
    block: Block | None = None
    fence = ""
    comment: dict[str, str] = {}
    for number, line in enumerate(text.splitlines(), start=1):
        if block is not None:
            if line == fence:
                if block.info.startswith("{code-block}"):
                    take_caption(block)
                yield block
                block = None
            else:
                block.body.append(line)
        elif opening := FENCE.match(line):
            fence = opening["fence"]
            block = Block(number, opening["info"].strip(), [])
            block.not_run, block.needs = comment.get("not run"), comment.get("needs")
            comment = {}
        elif said := COMMENT.match(line):
            comment[said["key"]] = said["text"]
        elif line.strip():
            comment = {}
    if block is not None:
        raise ValueError(f"line {block.line}: the block is not closed")


def take_caption(block: Block) -> None:
    """Takes the options off a directive; the caption is the name of the file it shows."""
    while block.body and block.body[0].startswith(":"):
        option = block.body.pop(0)
        block.line += 1
        if option.startswith(":caption:"):
            block.caption = option.removeprefix(":caption:").strip()
    if block.body and not block.body[0]:
        block.body.pop(0)
        block.line += 1


def absent(block: Block) -> list[str]:
    """Programs, and modules of Python, that the block needs and that are not on this machine."""

    def is_here(name: str) -> bool:
        module = name.removeprefix("python:")
        return (shutil.which(name) if module == name else find_spec(module)) is not None

    return [name for name in (block.needs or "").split() if not is_here(name)]


def matches(shown: list[str], printed: str) -> bool:
    """Whether what the guide shows is what was printed: words exactly, numbers nearly."""
    return aligned(shown, printed, agree) is not None


def recorded(shown: list[str], printed: str) -> list[str] | None:
    """What the guide shows, with the lines that were printed; None where the words differ.

    A line `@` becomes all the lines that were printed there.
    """
    found = aligned(shown, printed, alike)
    if found is None:
        return None
    lines = content(printed)
    out: list[str] = []
    for n, (line, at) in enumerate(zip(shown, found, strict=False)):
        if line.strip() == EXPAND:
            after = next((place for place in found[n + 1 :] if place is not None), len(lines))
            before = (
                next((place for place in found[n - 1 :: -1] if place is not None), -1) if n else -1
            )
            out += lines[before + 1 : after]
        else:
            out.append(line if at is None else lines[at])
    return out + [""] * (len(shown) - len(found))


def content(printed: str) -> list[str]:
    """Printed lines without what is empty around them, and without what a slow machine adds."""
    lines = (line.rstrip() for line in printed.strip("\n").splitlines())
    return [line for line in lines if not PROGRESS.match(line)]


def aligned(
    shown: list[str], printed: str, same: Callable[[str, str], bool]
) -> list[int | None] | None:
    """Which printed line each shown one stands for, None for `…`; None if they do not match."""
    lines = content(printed)
    wanted = "\n".join(line.rstrip() for line in shown).strip("\n").split("\n")
    # for each wanted line the printed lines it may stand for, each with the one before
    ways: list[dict[int, int]] = [{0: 0}]
    for line in wanted:
        before = ways[-1]
        if line.strip() in (ELLIPSIS, EXPAND):
            least = min(before)
            ways.append(
                {at: max(p for p in before if p <= at) for at in range(least, len(lines) + 1)}
            )
        else:
            ways.append({at + 1: at for at in before if at < len(lines) and same(line, lines[at])})
        if not ways[-1]:
            return None
    if len(lines) not in ways[-1]:
        return None
    at, found = len(lines), list[int | None]()
    for line, way in zip(reversed(wanted), reversed(ways[1:]), strict=True):
        skipped = line.strip() in (ELLIPSIS, EXPAND)
        found.append(None if skipped else at - 1)
        at = way[at]
    return found[::-1]


def agree(shown: str, printed: str) -> bool:
    """Whether words are the same, and numbers nearly, as another machine may print them."""
    if ELLIPSIS in shown and ELLIPSIS not in printed:
        return False
    ours, theirs = parts(shown), parts(printed)
    return [kind for kind, _ in ours] == [kind for kind, _ in theirs] and all(
        near(a, b) for (_, a), (_, b) in zip(ours, theirs, strict=True)
    )


def alike(shown: str, printed: str) -> bool:
    """Whether words are the same; numbers may be any, and `…` any text."""
    # a row of a table of steps is the same step
    first, row = (ROW.match(line) for line in (shown, printed))
    if first and row and first[1] != row[1]:
        return False
    pieces = [[kind for kind, _ in parts(piece)] for piece in shown.split(ELLIPSIS)]
    if len(pieces) == 1:
        return pieces[0] == [kind for kind, _ in parts(printed)]
    token = {"#": NUMBER.pattern, "§": ".*?"}
    pattern = ".*".join(
        r"\s*".join(token.get(kind, re.escape(kind)) for kind in piece) for piece in pieces
    )
    return re.fullmatch(rf"\s*{pattern}\s*", printed) is not None


def parts(line: str) -> list[tuple[str, str]]:
    """Words of a line as they are, and numbers as `#`, each with its text."""
    line = FREE.sub("§", NAME.sub("§", line))
    found = []
    for match in TOKEN.finditer(line):
        text = match[0]
        found.append(("#", text) if NUMBER.fullmatch(text) else (text, text))
    return found


def near(shown: str, printed: str) -> bool:
    """Whether two numbers are the same but for what another machine or a small change explains."""
    if shown == printed or not NUMBER.fullmatch(shown):
        return shown == printed
    a, b = (float(text.replace("−", "-")) for text in (shown, printed))
    digits = len(shown.partition(".")[2]) if "e" not in shown else 0
    return abs(a - b) <= 0.2 * max(abs(a), abs(b)) + 10.0**-digits


class Reader:
    """Follows a chapter in a folder of its own, as a reader does in a terminal."""

    def __init__(self, folder: Path, paths: list[Path]) -> None:
        """Starts in the folder, with the programs of `paths` before all others."""
        self.folder = folder
        self.here = folder
        self.environment = dict(os.environ)
        search = [*map(str, paths), self.environment["PATH"]]
        self.environment["PATH"] = os.pathsep.join(search)
        self.environment["COLUMNS"] = "100"

    def write(self, block: Block) -> None:
        """Writes the file that the block shows."""
        assert block.caption is not None
        path = (self.here / block.caption).resolve()
        assert path.is_relative_to(self.folder.resolve()), f"{path} is outside the folder"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(block.body) + "\n", encoding="utf-8")

    def run(self, command: Command) -> tuple[int, str]:
        """Runs a command where the last one ended; its exit code and all that it printed."""
        where = self.folder / ".where"
        script = f"{command.text}\ncode=$?\npwd >'{where}'\nexit $code\n"
        done = subprocess.run(
            ["bash", "-c", script],
            cwd=self.here,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=1200,
            check=False,
        )
        if where.is_file():
            self.here = Path(where.read_text(encoding="utf-8").strip())
            where.unlink()
        return done.returncode, done.stdout


def reader(folder: Path, program: Path) -> Reader:
    """A reader in a folder with the program and the examples."""
    programs = folder / "bin"
    programs.mkdir()
    (programs / "plydrape").symlink_to(program.resolve())
    made = shutil.ignore_patterns("*.results", "*.plan", "*.compare", "*.net")
    root = Path(__file__).resolve().parents[2]
    shutil.copytree(root / "examples", folder / "plydrape" / "examples", ignore=made)
    return Reader(folder / "plydrape", [programs, Path(sys.executable).parent])


def record(chapter: Path, program: Path) -> int:
    """Runs a chapter's commands and writes down what they print; how many do not match."""
    text = chapter.read_text(encoding="utf-8")
    lines = text.splitlines()
    changed: list[tuple[int, int, list[str]]] = []
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        follower = reader(Path(folder), program)
        for block in blocks(text):
            if block.caption is not None:
                follower.write(block)
            if block.info != "console" or absent(block):
                continue
            for command in block.commands():
                code, printed = follower.run(command)
                first = command.line + command.text.count("\n")
                now = recorded(command.shown, printed) if command.shown else []
                if code != command.code or now is None:
                    wrong += 1
                    print(f"{chapter.name}, line {command.line}: $ {command.text}: exit {code}")
                    print(printed)
                elif now != command.shown:
                    changed.append((first, first + len(command.shown), now))
    for begin, end, now in reversed(changed):
        lines[begin:end] = now
    chapter.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"{chapter.name}: {len(changed)} outputs changed, {wrong} do not match")
    return wrong


if __name__ == "__main__":
    binary = Path(os.environ.get("PLYDRAPE", "target/checked/plydrape"))
    sys.exit(sum(record(Path(name), binary) for name in sys.argv[1:]) > 0)
