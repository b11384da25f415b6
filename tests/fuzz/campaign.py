"""Many cases: run, judged, made smaller where they break a promise, and kept."""

from __future__ import annotations

import multiprocessing
import os
import shlex
import shutil
import tempfile
import traceback
import zlib
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property
from multiprocessing.queues import SimpleQueue
from pathlib import Path
from random import Random
from time import monotonic

from . import contract, mesh, result, scene, study, table
from .case import Case, Files, Kind, Occupied, Outlet
from .contract import Fault
from .process import Ended, Program

NAMES = ("scene", "table", "mesh", "result", "study")
# A study starts Python, so there are fewer of them.
ROUND = ("scene", "table", "mesh", "result") * 6 + ("study",)


@contextmanager
def workshop() -> Iterator[Path]:
    """A folder in memory, if there is one, gone at the end."""
    shm = Path("/dev/shm")
    base = shm if os.access(shm, os.W_OK) else None
    with tempfile.TemporaryDirectory(prefix="plydrape-fuzz-", dir=base) as folder:
        yield Path(folder)


@dataclass(frozen=True)
class Broken:
    """A case that broke a promise."""

    key: str
    kind: str
    number: int
    fault: Fault
    command: str
    steps: list[str]


@dataclass
class Fuzzer:
    """Runs cases of a seed."""

    program: Program
    seed: int
    keep: Path
    # the kinds of the cases, one after the other
    kinds_in_turn: tuple[str, ...] = ROUND
    seen: set[str] = field(default_factory=set)
    codes: Counter[str] = field(default_factory=Counter)

    def kind(self, number: int) -> str:
        """The kind of a case."""
        return self.kinds_in_turn[number % len(self.kinds_in_turn)]

    def case(self, kind: str, number: int) -> Case:
        """The case of a number."""
        return Case.of(self.kinds[kind], f"{self.seed} {kind} {number}")

    @cached_property
    def kinds(self) -> dict[str, Kind]:
        """All kinds by name."""
        return {
            "scene": scene.KIND,
            "table": table.KIND,
            "mesh": mesh.KIND,
            "result": result.kind(lambda: self.results),
            "study": study.KIND,
        }

    @cached_property
    def results(self) -> list[bytes]:
        """Results of the program itself: drapes and plans of short examples."""
        program = replace(self.program, patience=60.0)

        def result_of(numbered: tuple[int, Files]) -> bytes | None:
            number, files = numbered
            place = folder / str(number)
            place.mkdir()
            for name, content in files.items():
                assert isinstance(content, bytes)
                (place / name).write_bytes(content)
            command = "simulate" if number % 3 else "plan"
            program.run((command, scene.NAME, "-o", "out", "-q", "--without-errors"), place)
            found = place / "out" / result.NAME
            small = found.is_file() and found.stat().st_size < 250_000
            return found.read_bytes() if small else None

        with workshop() as folder, ThreadPoolExecutor(os.cpu_count()) as workers:
            found = workers.map(result_of, enumerate(scene.examples()))
            written = [content for content in found if content is not None]
        if not written:
            raise SystemExit("fuzz: the program wrote no result of any example")
        return written

    def run(self, number: int) -> list[Broken]:
        """Runs one case; what is new of its faults, each with as few mutations as show it."""
        kind = self.kind(number)
        case = self.case(kind, number)
        found = []
        for fault, ended in self.judge(case):
            key = fault.key(ended.command[0])
            if key in self.seen:
                self.codes["faults seen before"] += 1
                continue
            self.seen.add(key)
            smaller = self.smaller(case, key)
            found.append(self.kept(key, kind, number, smaller, fault, ended))
        return found

    def judge(self, case: Case) -> list[tuple[Fault, Ended]]:
        """Runs a case, now and then twice or with what follows of it; its faults."""
        rng = Random(f"{case.name} judged")
        command, follow = case.command, rng.random()
        with workshop() as folder:
            one = folder / "one"
            ended, found = self.attempt(case, one, rng.choice((0, 100, 5_000, 100_000)))
            self.codes[f"{command[0]}: exit {ended.code}"] += 1
            if found or case.outlet is not Outlet.KEPT:
                return found
            free = case.occupied is Occupied.NOTHING
            if command[0] == "simulate" and ended.code == 2 and free and follow < 0.3:
                check = self.program.run(("check", scene.NAME), one)
                if check.code == 0:
                    fault = Fault(
                        "check refuses what cannot be draped", ended.stderr.decode()[:500]
                    )
                    found.append((fault, ended))
            wrote = one / "out" / result.NAME
            if ended.code in contract.DONE and wrote.is_file() and follow < 0.15:
                found += self.read_back(wrote, folder, rng)
            if follow > 0.95 and command[0] != "study" and not ended.interrupted:
                two = folder / "two"
                again, _ = self.attempt(case, two, 0)
                if not again.interrupted and (fault_of := differ(ended, again, one, two)):
                    found.append((fault_of, ended))
            return found

    def attempt(
        self, case: Case, folder: Path, room: int
    ) -> tuple[Ended, list[tuple[Fault, Ended]]]:
        """Writes and runs a case in a new folder; how it ended, and its faults."""
        folder.mkdir()
        case.write(folder)
        before = {
            str(path.relative_to(folder)): path.read_bytes()
            for path in folder.rglob("*")
            if path.is_file() and not path.is_symlink() and path.stat().st_size < 1 << 26
        }
        ended = self.program.run(case.command, folder, case.outlet, room)
        return ended, [(f, ended) for f in contract.faults(ended, folder, before, case.outlet)]

    def read_back(self, wrote: Path, folder: Path, rng: Random) -> list[tuple[Fault, Ended]]:
        """What the command wrote, it reads."""
        to = rng.choice(("csv", "inp", "ngsolve", "ros2", "vtk"))
        found = []
        for name, options in (("report", ()), ("export", ("--to", to, "--even-if-rejected"))):
            place = folder / name
            place.mkdir()
            ended = self.program.run((name, str(wrote), *options, "-o", "out"), place)
            faults = contract.faults(ended, place, {}, Outlet.KEPT)
            if ended.code == 2 and name == "report":
                faults.append(Fault("what is written can be read", ended.stderr.decode()[:500]))
            found += [(fault, ended) for fault in faults]
        return found

    def smaller(self, case: Case, key: str) -> Case:
        """The case without the mutations that the fault does not need."""

        def shows(other: Case) -> bool:
            return any(fault.key(ended.command[0]) == key for fault, ended in self.judge(other))

        for plainer in (
            replace(case, outlet=Outlet.KEPT),
            replace(case, occupied=Occupied.NOTHING),
        ):
            if plainer != case and shows(plainer):
                case = plainer
        for step in reversed(range(len(case.steps))):
            if shows(case.without(step)):
                case = case.without(step)
        return case

    def kept(
        self, key: str, kind: str, number: int, case: Case, fault: Fault, ended: Ended
    ) -> Broken:
        """Keeps the files of a case, and says how it is run again."""
        place = self.keep / f"{kind}-{self.seed}-{number}-{zlib.crc32(key.encode()):08x}"
        text = shlex.join(["plydrape", *ended.command])
        command = f"{text} {case.outlet.value if case.outlet is not Outlet.KEPT else ''}".rstrip()
        shutil.rmtree(place, ignore_errors=True)  # of an earlier campaign
        place.mkdir(parents=True)
        steps = case.write(place)
        again = f"scripts/fuzz --kind {kind} --seed {self.seed} --case {number}"
        lines = [key, "", fault.detail, "", *steps, "", command, again, ""]
        (place / "fault.txt").write_text("\n".join(lines))
        return Broken(key, kind, number, fault, command, steps)


def differ(one: Ended, two: Ended, first: Path, second: Path) -> Fault | None:
    """How two runs of the same case differ, if they do."""
    if one.code != two.code or one.stderr != two.stderr:
        return Fault(
            "the same again", f"exit {one.code}, then {two.code}\n{two.stderr.decode()[:300]}"
        )
    for path in sorted((first / "out").rglob("*")):
        other = second / path.relative_to(first)
        if path.is_file() and (not other.is_file() or other.read_bytes() != path.read_bytes()):
            return Fault("the same again", f"{path.name} differs")
    return None


def work(
    fuzzer: Fuzzer, worker: int, jobs: int, most: int, until: float, out: SimpleQueue[object]
) -> None:
    """Cases of one worker, until there are enough or the time is over."""
    done = 0
    try:
        for number in range(worker, most, jobs):
            if monotonic() > until:
                break
            for broken in fuzzer.run(number):
                out.put(broken)
            done += 1
    except Exception:
        # a fault of the fuzzer itself
        out.put(f"case {number}: {traceback.format_exc()}")
    except KeyboardInterrupt:
        pass
    out.put((done, fuzzer.codes))


def campaign(
    fuzzer: Fuzzer, jobs: int, most: int, seconds: float, report: Callable[[Broken], None]
) -> tuple[int, Counter[str], Counter[str]]:
    """Runs cases on several workers: how many, how they ended, and the faults found by key."""
    if "result" in fuzzer.kinds_in_turn:
        assert fuzzer.results  # once, for all workers
    out: SimpleQueue[object] = multiprocessing.SimpleQueue()
    until = monotonic() + seconds
    fork = multiprocessing.get_context("fork")
    workers = [
        fork.Process(target=work, args=(fuzzer, n, jobs, most, until, out)) for n in range(jobs)
    ]
    for worker in workers:
        worker.start()
    done, codes, found, running = 0, Counter[str](), Counter[str](), jobs
    while running:
        try:
            message = out.get()
        except KeyboardInterrupt:
            continue  # the workers end too, and say how far they came
        match message:
            case Broken() as broken:
                if not found[broken.key]:
                    report(broken)
                found[broken.key] += 1
            case str(failure):
                raise SystemExit(f"fuzz: {failure}")
            case (int(count), Counter() as ends):
                done, codes, running = done + count, codes + ends, running - 1
    for worker in workers:
        worker.join()
    return done, codes, found
