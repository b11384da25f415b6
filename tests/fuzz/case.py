"""A case: sound files, what is done to them, and the command that gets them.

Everything of a case follows from its seed, kind and number. Each mutation has a seed of its own, so
that one can be left out and the others still do what they did.
"""

from __future__ import annotations

import enum
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random

from . import values


class Odd(enum.Enum):
    """What is in a file's place without being a file with contents."""

    PIPE = "a named pipe that nobody writes"
    FOLDER = "a folder"
    LOOP = "a link to itself"
    ENDLESS = "a link to /dev/zero"
    GONE = "nothing"
    HUGE = "a file of 3 GiB"


Files = dict[str, bytes | Odd]
Mutation = Callable[[Random, Files], str]


class Outlet(enum.Enum):
    """Where the command's output goes."""

    KEPT = "kept"
    STDOUT_FULL = ">/dev/full"
    STDERR_FULL = "2>/dev/full"
    BOTH_FULL = ">/dev/full 2>/dev/full"
    NO_ROOM = "no room for files"


class Occupied(enum.Enum):
    """What is of the user's where the output folder goes."""

    NOTHING = "nothing"
    FILE = "`out` is a file"
    FOREIGN = "`out` holds other files of the same names"
    GARBAGE = "`out` holds a list of files that is none"


# Names that commands write.
NAMES = (
    *("result.json", "steps.csv", "trajectory.csv", "report.html", "plan.json"),
    "sheet.npz",
    *("net.vtp", "mold.vtp", "ply.inp", "drape.pvd", "trajectory.yaml"),
)


@dataclass(frozen=True)
class Kind:
    """One kind of input: sound files, mutations with their weights, commands with theirs."""

    files: Callable[[Random], Files]
    mutations: Sequence[tuple[float, Mutation]]
    commands: Sequence[tuple[float, Sequence[str]]]


@dataclass(frozen=True)
class Case:
    """What one run of the command gets."""

    name: str
    files: Callable[[], Files]
    steps: tuple[tuple[Mutation, str], ...]
    command: tuple[str, ...]
    outlet: Outlet = Outlet.KEPT
    occupied: Occupied = Occupied.NOTHING

    @classmethod
    def of(cls, kind: Kind, name: str) -> Case:
        """The case of a name, as in "7 scene 123"."""
        rng = Random(name)
        count = rng.choice((0, 1, 1, 1, 1, 2, 2, 4))
        weights, mutations = [w for w, _ in kind.mutations], [m for _, m in kind.mutations]
        chosen = sorted(rng.choices(range(len(mutations)), weights, k=count))
        steps = tuple((mutations[n], f"{name} step {i}") for i, n in enumerate(chosen))
        commands = [c for _, c in kind.commands]
        command = rng.choices(commands, [w for w, _ in kind.commands])[0]
        outlet = Outlet.KEPT if rng.random() < 0.96 else rng.choice(list(Outlet))
        occupied = Occupied.NOTHING
        if "-o" in command and command[0] != "study" and rng.random() < 0.05:
            occupied = rng.choice(list(Occupied))

        def files() -> Files:
            return kind.files(Random(f"{name} files"))

        return cls(name, files, steps, tuple(command), outlet, occupied)

    def without(self, step: int) -> Case:
        """The same case with one mutation less."""
        return replace(self, steps=self.steps[:step] + self.steps[step + 1 :])

    def write(self, folder: Path) -> list[str]:
        """Writes the mutated files into an empty folder; what was done to them."""
        files = self.files()
        done = [mutate(Random(seed), files) for mutate, seed in self.steps]
        for name, content in files.items():
            place(folder / name, content)
        self.occupy(folder / "out")
        if self.occupied is not Occupied.NOTHING:
            done.append(self.occupied.value)
        return done

    def occupy(self, out: Path) -> None:
        """Puts what is the user's in the way."""
        match self.occupied:
            case Occupied.FILE:
                out.write_text("mine\n")
            case Occupied.FOREIGN:
                out.mkdir()
                for name in NAMES:
                    (out / name).write_text("mine\n")
            case Occupied.GARBAGE:
                out.mkdir()
                (out / ".plydrape").write_text("mine\n")
            case Occupied.NOTHING:
                pass


def place(path: Path, content: bytes | Odd) -> None:
    """Puts a file, or what is in its place."""
    match content:
        case bytes():
            path.write_bytes(content)
        case Odd.PIPE:
            os.mkfifo(path)
        case Odd.FOLDER:
            path.mkdir()
        case Odd.LOOP:
            path.symlink_to(path.name)
        case Odd.ENDLESS:
            path.symlink_to("/dev/zero")
        case Odd.HUGE:
            with path.open("wb") as file:
                file.truncate(3 << 30)
        case Odd.GONE:
            pass


def odd_file(rng: Random, files: Files) -> str:
    """Puts something else in the place of a file."""
    name = rng.choice(sorted(files))
    files[name] = rng.choice((*Odd, b"", b"\n", b"\x00" * 64))
    return f"{name} is {files[name]!r}"


def damage(*endings: str) -> Mutation:
    """A mutation of the bytes of a file with one of these endings."""

    def mutate(rng: Random, files: Files) -> str:
        names = [name for name in sorted(files) if name.endswith(endings)]
        name = rng.choice(names) if names else ""
        content = files.get(name, Odd.GONE)
        if isinstance(content, Odd):
            return "no bytes to damage"
        files[name], what = values.damaged(rng, content)
        return f"{name}: {what}"

    return mutate
