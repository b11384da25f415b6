"""Reads the chapters of the user guide: commands, what they show, the files they write.

- A block `console` holds commands behind `$ ` (a backslash continues a line) and below each what
  it prints. `# exit 2` behind a command is the exit code it has to have; 0 if absent.
- What is shown stands for all that is printed. A line `…` stands for any lines, `…` within a line
  for any text. A command with nothing below it may print what it likes.
- A block `{code-block}` with a `:caption:` is a file of that name.
- Commands that are not run stand in a block `sh` below a comment `<!-- not run: why -->`. Those
  that need a program which may be missing stand in a `console` block below
  `<!-- needs: program program … -->`.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

FENCE = re.compile(r"^(?P<fence>`{3,})(?P<info>.*)$")
COMMENT = re.compile(r"^<!-- (?P<key>not run|needs): (?P<text>.+?) -->$")
EXIT = re.compile(r"\s+# exit (?P<code>\d+)$")
ELLIPSIS = "…"


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
    """Programs that the block needs and that are not on this machine."""
    return [name for name in (block.needs or "").split() if shutil.which(name) is None]


def matches(shown: list[str], printed: str) -> bool:
    """Whether what the guide shows is what was printed, but for `…`."""
    lines = [line.rstrip() for line in printed.strip("\n").splitlines()]
    wanted = "\n".join(line.rstrip() for line in shown).strip("\n").split("\n")

    # For each wanted line, the places up to which the printed lines may have been used.
    places = {0}
    for line in wanted:
        if line.strip() == ELLIPSIS:
            places = set(range(min(places), len(lines) + 1))
            continue
        pattern = re.compile(".*".join(re.escape(part) for part in line.split(ELLIPSIS)))
        places = {at + 1 for at in places if at < len(lines) and pattern.fullmatch(lines[at])}
        if not places:
            return False
    return len(lines) in places


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
            timeout=120,
            check=False,
        )
        if where.is_file():
            self.here = Path(where.read_text(encoding="utf-8").strip())
            where.unlink()
        return done.returncode, done.stdout
