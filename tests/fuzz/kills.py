"""`scripts/fuzz kills`: runs that are ended at a random moment, and what they leave.

A run is undisturbed once, and its folder is kept. Then it is ended again and again, by SIGKILL,
SIGTERM or SIGINT, at any moment of it or while it writes; half of the time the folder holds the
good result of another run. Of studies the command is ended, one of its workers, or a scheduler or a
worker of a Dask cluster. After each:

- The process has ended, with its signal or a documented exit code, and so have all it started.
- Every file of the folder is whole, and one that its list knows; what reads the folder reads it, or
  says that the run was cut off.
- The result that was there is there, byte by byte, or the one that the run should make, or after a
  request to end one that is accepted.
- The same command, or `plan --continue` where there is a state of the search, ends as the
  undisturbed run did, with the same bytes, and nothing hidden or unfinished is left.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import zlib
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from threading import Lock
from typing import BinaryIO

from .contract import CODES, Fault
from .options import binary_of, python_of, seconds_or_count

ROOT = Path(__file__).resolve().parents[2]
ENDED_IN = 60.0  # seconds from a signal to the end, on a machine that does other things too
SIGNALS = (signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT)

SCENE = """\
title = "{title}"

[ply]
grippers = [2, 2]
cell = ["100 mm", "100 mm"]
material = "krogh2018"

[mold]
kind = "plane"

[grippers]
spacing = ["98 mm", "98 mm"]
height = "{height} mm"
max_tilt = "40 deg"

[target]
shear = "20 deg"

[plan]
steps = 20

[tool]
axes = [
  {{ direction = "x", stroke = ["-30 mm", "30 mm"] }},
  {{ direction = "y", stroke = ["-30 mm", "30 mm"] }},
  {{ direction = "z", stroke = ["-60 mm", "60 mm"] }},
]

[motion]
kind = "straight"
steps = 10

[model]
kind = "catenaries"
"""
OFFSET = '[offset]\nx = "{x} mm"\ny = "-1.5 mm"\nyaw = "0.8 deg"\n'
STUDY = """\
scene = "{scene}.toml"
samples = 24
seed = 1

[vary]
"ply.material.flexural_rigidity" = {{ relative = [0.8, 1.2] }}
"grippers.height" = {{ from = "60 mm", to = "90 mm" }}
"errors.gripper.position.bound" = {{ values = ["1 mm"] }}
"""
FORMATS = ("csv", "inp", "pattern", "ros2", "rapid", "krl", "urscript", "vtk")
MOST = 100_000  # runs of one campaign
# Which run is ended how often.
SHARES: dict[str, float] = {
    "plan": 24,
    "export": 34,
    "replan": 18,
    "simulate": 8,
    "study": 12,
    "cluster": 4,
}


@dataclass(frozen=True)
class Run:
    """A command that writes `out`; and one for another input, whose folder may be there before."""

    name: str
    command: tuple[str, ...]
    other: tuple[str, ...]


def runs(format_: str) -> dict[str, Run]:
    """The commands by name."""

    def both(name: str, command: str, other: str) -> Run:
        return Run(name, tuple(command.split()), tuple(other.split()))

    planned = "plan {}.toml --without-errors -q -o out"
    study = "study {}.study.toml -q --workers 2 -o out"
    return {
        "plan": both("plan", planned.format("a"), planned.format("b")),
        "simulate": both("simulate", "simulate a.toml -q -o out", "simulate b.toml -q -o out"),
        "replan": both(
            "replan",
            "replan plan/result.json --picked a.offset.toml -q -o out",
            "replan plan/result.json --picked b.offset.toml -q -o out",
        ),
        "export": both(
            "export",
            f"export plan/result.json --to {format_} -q -o out",
            f"export other/result.json --to {format_} -q -o out",
        ),
        # another study's folder is refused, so that there is none before
        "study": both("study", study.format("a"), study.format("a")),
        "cluster": both("cluster", study.format("a"), study.format("a")),
    }


Contents = dict[str, bytes]


def contents(folder: Path) -> Contents:
    """All files of a folder by path."""
    files = (path for path in sorted(folder.rglob("*")) if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def alive(session: int) -> list[str]:
    """What runs of a session, by command line."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError, ValueError):
            fields = stat.read_text().rpartition(")")[2].split()
            if int(fields[3]) == session and fields[0] not in "ZX":
                line = (stat.parent / "cmdline").read_bytes().replace(b"\0", b" ").decode()
                found.append(f"{stat.parent.name} {line[:100]}")
    return found


@dataclass
class Cluster:
    """A Dask scheduler and two workers, started again where they were ended."""

    python: str
    folder: Path
    scheduler: subprocess.Popen[bytes] | None = None
    workers: list[subprocess.Popen[bytes]] = field(default_factory=list)
    address: str = ""

    def ready(self) -> None:
        """Starts what is not there."""
        if self.scheduler is None or self.scheduler.poll() is not None:
            self.close()
            log = self.folder / "scheduler.log"
            with log.open("wb") as file:
                options = ["scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
                self.scheduler = self.started(options, file)
            deadline = time.monotonic() + ENDED_IN
            while (at := re.search(r"Scheduler at:\s+(tcp://\S+:\d+)", log.read_text())) is None:
                if self.scheduler.poll() is not None or time.monotonic() > deadline:
                    raise SystemExit(f"fuzz: there is no Dask scheduler\n{log.read_text()}")
                time.sleep(0.05)
            self.address = at[1]
        self.workers = [worker for worker in self.workers if worker.poll() is None]
        while len(self.workers) < 2:
            options = ["--nthreads", "1", "--no-nanny", "--no-dashboard", "--memory-limit", "0"]
            self.workers.append(
                self.started(["worker", self.address, *options], subprocess.DEVNULL)
            )

    def started(self, options: list[str], log: BinaryIO | int) -> subprocess.Popen[bytes]:
        """A process of Dask."""
        return subprocess.Popen(
            [self.python, "-m", "dask", *options],
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            cwd=self.folder,
            start_new_session=True,
        )

    def close(self) -> None:
        """Ends all."""
        for process in [*self.workers, *([self.scheduler] if self.scheduler else [])]:
            process.kill()
            process.wait()
        self.scheduler, self.workers = None, []


@dataclass
class Kills:
    """Ends runs of a seed."""

    binary: Path
    python: str
    seed: int
    shop: Path
    counts: Counter[str] = field(default_factory=Counter)
    seconds: dict[str, float] = field(default_factory=dict)
    whole: dict[tuple[str, ...], tuple[int, Contents]] = field(default_factory=dict)
    cluster: Cluster | None = None
    # held where a run is undisturbed, and where the cluster is used
    once: Lock = field(default_factory=Lock)
    clustered: Lock = field(default_factory=Lock)

    def prepare(self) -> None:
        """Writes what the runs read."""
        for name, height, x in (("a", 75, 3), ("b", 73, 2)):
            (self.shop / f"{name}.toml").write_text(SCENE.format(title=name, height=height))
            (self.shop / f"{name}.offset.toml").write_text(OFFSET.format(x=x))
            (self.shop / f"{name}.study.toml").write_text(STUDY.format(scene=name))
        for name, folder in (("a", "plan"), ("b", "other")):
            command = ("plan", f"{name}.toml", "--without-errors", "-q", "-o", folder)
            done = self.start(command, self.shop)
            _, stderr = done.communicate()
            if done.returncode != 0:
                raise SystemExit(f"fuzz: no plan that is accepted: {stderr.decode()}")

    def start(self, command: tuple[str, ...], folder: Path) -> subprocess.Popen[bytes]:
        """Starts a command in a session of its own."""
        surroundings = {
            "PATH": os.environ.get("PATH", ""),
            "NO_COLOR": "1",
            "PYTHONDONTWRITEBYTECODE": "1",
            "PLYDRAPE_PYTHON": self.python,
            "RAYON_NUM_THREADS": "1",
            "OPENBLAS_NUM_THREADS": "1",
        }
        return subprocess.Popen(
            [str(self.binary), *command],
            cwd=folder,
            env=surroundings,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            start_new_session=True,
        )

    def undisturbed(self, command: tuple[str, ...]) -> tuple[int, Contents]:
        """The exit code and the folder of a run that nobody ends, once."""
        with self.once, self.bench() as folder:
            if command not in self.whole:
                began = time.monotonic()
                done = self.start(command, folder)
                _, stderr = done.communicate()
                if done.returncode not in (0, 1):
                    raise SystemExit(f"fuzz: {' '.join(command)}: {stderr.decode()}")
                self.seconds[command[0]] = time.monotonic() - began
                self.whole[command] = (done.returncode, contents(folder / "out"))
        return self.whole[command]

    @contextlib.contextmanager
    def bench(self) -> Iterator[Path]:
        """A folder with the inputs, gone afterwards."""
        with tempfile.TemporaryDirectory(dir=self.shop, prefix="bench-") as name:
            folder = Path(name)
            for path in self.shop.iterdir():
                if path.is_file():
                    shutil.copy2(path, folder)
                elif path.name in ("plan", "other"):
                    (folder / path.name).symlink_to(path)
            yield folder

    def run(self, number: int) -> Iterator[Fault]:
        """Ends one run; what is wrong afterwards."""
        rng = Random(f"{self.seed} kills {number}")
        shares = {k: v for k, v in SHARES.items() if self.cluster or k not in ("study", "cluster")}
        name = rng.choices(list(shares), list(shares.values()))[0]
        run = runs(rng.choice(FORMATS))[name]
        code, wanted = self.undisturbed(run.command)
        is_study = run.command[0] == "study"
        _, before = self.undisturbed(run.other) if not is_study and rng.random() < 0.5 else (0, {})
        how = rng.choice(SIGNALS)
        shared = self.clustered if name == "cluster" else contextlib.nullcontext()
        with shared, self.bench() as folder:
            out = folder / "out"
            for path, content in before.items():
                (out / path).parent.mkdir(parents=True, exist_ok=True)
                (out / path).write_bytes(content)
            command = run.command
            if name == "cluster" and self.cluster:
                self.cluster.ready()
                command = (*command, "--scheduler", self.cluster.address)
            process = self.start(command, folder)
            victim = self.end(process, name, out, how, rng)
            try:
                _, stderr = process.communicate(timeout=ENDED_IN)
            except subprocess.TimeoutExpired:
                yield Fault("ends in time", f"{name}, {victim}: {alive(process.pid)}")
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                return
            text = stderr.decode(errors="replace")
            ended = "signal" if process.returncode < 0 else f"exit {process.returncode}"
            self.counts[f"{name}: {victim} by {how.name}: {ended}"] += 1
            yield from self.ending(process, victim, how, text)
            yield from self.left(folder, victim, how, before, wanted, code, is_study)
            yield from self.again(run, folder, rng, code, before, wanted)

    def end(
        self, process: subprocess.Popen[bytes], name: str, out: Path, how: int, rng: Random
    ) -> str:
        """Waits for the moment, and ends the run or what works for it; which of them."""
        whole = self.seconds[process.args[1]]  # type: ignore[index]
        deadline = time.monotonic() + whole * rng.uniform(0.0, 1.05)
        while_writing = name != "study" and rng.random() < 0.5
        while process.poll() is None:
            if while_writing:
                if writes(out):
                    time.sleep(rng.uniform(0.0, 0.02))
                    break
                time.sleep(0.0005)
            elif time.monotonic() >= deadline:
                break
            else:
                time.sleep(0.002)
        victim = "command"
        if name == "study":
            victim = rng.choice(("command", "worker"))
        elif name == "cluster":
            victim = rng.choice(("command", "worker", "scheduler"))
        target = process.pid
        if victim == "worker" and name == "study":
            workers = [line for line in alive(process.pid) if "spawn_main" in line]
            if not workers:
                victim = "command"
            else:
                target = int(rng.choice(workers).split()[0])
        elif victim != "command" and self.cluster:
            cluster = self.cluster
            chosen = cluster.scheduler if victim == "scheduler" else rng.choice(cluster.workers)
            assert chosen is not None
            target = chosen.pid
        if victim != "command" or process.poll() is None:
            with contextlib.suppress(ProcessLookupError):
                os.kill(target, how)
        return victim

    def ending(
        self, process: subprocess.Popen[bytes], victim: str, how: int, text: str
    ) -> Iterator[Fault]:
        """What is wrong with how it ended."""
        code = process.returncode
        if "panicked at" in text or "Traceback" in text:
            yield Fault("no panic", text[-800:])
        if code not in CODES and not (code == -how and victim == "command"):
            yield Fault("a documented exit code", f"exit {code}: {text[-300:]}")
        deadline = time.monotonic() + ENDED_IN
        while left := alive(process.pid):
            if time.monotonic() > deadline:
                yield Fault("all that it started has ended", "\n".join(left))
                os.killpg(process.pid, signal.SIGKILL)
                return
            time.sleep(0.02)

    def left(
        self,
        folder: Path,
        victim: str,
        how: int,
        before: Contents,
        wanted: Contents,
        code: int,
        is_study: bool,
    ) -> Iterator[Fault]:
        """What is wrong with what it left."""
        out = folder / "out"
        asked = how != signal.SIGKILL or victim != "command"
        hidden = [p for p in folder.rglob("*") if p.name.startswith(".plydrape-")]
        if asked and hidden:
            yield Fault("nothing is left behind", f"{hidden}")
        if is_study:
            yield from torn_rows(out, asked)
            return
        yield from torn(out)
        if not out.is_dir():
            if before:
                yield Fault("a result that was there is not lost", "there is no folder")
            return
        name = "result.json"
        if name in before:
            path = out / name
            found = path.read_bytes() if path.is_file() else b""
            kept = found in (before[name], wanted[name])
            if not kept and not (asked and accepted(found)):
                yield Fault("a result that was there is not lost", f"{found[:200]!r}")
        elif before and not all((out / n).is_file() for n in before if n in wanted):
            yield Fault("a result that was there is not lost", f"{sorted(contents(out))}")
        # what reads it takes it, or says why not
        if (out / name).is_file():
            report = self.start(("report", "out", "-q", "-o", "page"), folder)
            _, stderr = report.communicate()
            text = " ".join(stderr.decode().split())
            sealed = is_sealed(out)
            self.counts["a folder of two runs, which is refused"] += not sealed
            if report.returncode != (0 if sealed else 2) or (not sealed and "help:" not in text):
                yield Fault("a result can be read, or is refused", f"{report.returncode}: {text}")

    def again(
        self,
        run: Run,
        folder: Path,
        rng: Random,
        code: int,
        before: Contents,
        wanted: Contents,
    ) -> Iterator[Fault]:
        """What is wrong with the next run."""
        if run.name == "export":  # files of other names stay
            wanted = before | wanted
        out, command = folder / "out", run.command
        for path in folder.glob("out?*"):  # a plan beside a better one
            yield from torn(path)
            shutil.rmtree(path)
        if command[0] == "plan" and (out / "search.json").is_file() and rng.random() < 0.7:
            command = (*command, "--continue", "out")
            self.counts["plan --continue"] += 1
        done = self.start(command, folder)
        _, stderr = done.communicate()
        if done.returncode != code:
            text = f"{' '.join(command)}: exit {done.returncode}, not {code}: {stderr.decode()}"
            yield Fault("the next run ends as an undisturbed one", text)
            return
        found = contents(out)
        listed = ".plydrape"
        for name in sorted(found.keys() | wanted.keys()):
            # the rows of a study are in as many parts as it had runs
            apart = name.startswith("rows/") and not Path(name).name.startswith(".")
            if name != listed and not apart and found.get(name) != wanted.get(name):
                is_there = "another" if name in found and name in wanted else "more or less"
                text = f"{' '.join(command)}: {is_there}: {name}"
                yield Fault("the next run writes the same bytes", text)
        hidden = [p for p in folder.rglob(".*") if p.name not in (listed, ".lock")]
        if hidden or not is_sealed(out):
            yield Fault("the next run clears what is left", f"{hidden or 'no seal'}")


def writes(out: Path) -> bool:
    """Whether files are being staged for a folder."""
    # what goes while it is listed is no fault
    with contextlib.suppress(FileNotFoundError):
        return any(out.glob(".plydrape-*/new-*")) or any(out.glob("**/.*.tmp"))
    return False


def accepted(result: bytes) -> bool:
    """Whether a result is."""
    with contextlib.suppress(ValueError, LookupError, TypeError):
        return json.loads(result)["summary"]["accepted"] is True
    return False


def is_sealed(out: Path) -> bool:
    """Whether the files of a folder belong together."""
    try:
        return json.loads((out / ".plydrape").read_bytes())["sealed"] is True
    except FileNotFoundError:
        return True


def torn(out: Path) -> Iterator[Fault]:
    """Files that the list of a folder does not know, or that are not whole."""
    if not out.is_dir():
        return
    files = {path.name: path for path in out.iterdir() if path.is_file()}
    listed: dict[str, list[dict[str, int]]] = {}
    if ".plydrape" in files:
        try:
            manifest = json.loads(files.pop(".plydrape").read_bytes())
            listed = {name: entry["contents"] for name, entry in manifest["files"].items()}
        except (ValueError, LookupError, TypeError) as error:
            yield Fault("files are whole", f"the list of files: {error!r}")
            return
    for name, path in files.items():
        content = path.read_bytes()
        stamp = {"crc32": zlib.crc32(content), "length": len(content)}
        if stamp not in listed.get(name, []):
            yield Fault("files are whole", f"{name} of {len(content)} bytes: not as it is listed")


def torn_rows(out: Path, asked: bool) -> Iterator[Fault]:
    """Files of a study that are not whole, or unfinished where it was not ended by force."""
    for path in sorted(out.rglob("*")) if out.is_dir() else []:
        if path.suffix == ".tmp" and path.is_file() and asked:
            yield Fault("nothing is left behind", path.name)
        elif path.suffix == ".parquet":
            from pyarrow import parquet

            try:
                parquet.read_table(path)
            except (OSError, ValueError) as error:
                yield Fault("files are whole", f"{path.name}: {error}")
        elif path.suffix == ".json":
            try:
                json.loads(path.read_bytes())
            except ValueError as error:
                yield Fault("files are whole", f"{path.name}: {error}")


def main(show: Callable[[str], None] = print) -> int:
    """Ends runs until it is enough; the exit code."""
    parser = argparse.ArgumentParser("scripts/fuzz kills", description=__doc__.partition("\n")[0])
    seconds_or_count(parser)
    parser.add_argument("--number", type=int, help="end this run only, as a report names it")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time (default 2)")
    options = parser.parse_args()
    python = python_of()
    with tempfile.TemporaryDirectory(prefix="plydrape-kills-") as shop:
        kills = Kills(binary_of(options), python, options.seed, Path(shop))
        needed = [python, "-c", "import plydrape.study, pyarrow, distributed"]
        if subprocess.run(needed, capture_output=True, check=False).returncode == 0:
            kills.cluster = Cluster(python, Path(shop))
        else:
            show(f"NO STUDIES: {python} has no package plydrape with `study` and `dask`")
        kills.prepare()
        found: Counter[str] = Counter()
        began, done = time.monotonic(), 0

        def run(number: int) -> list[Fault] | None:
            if options.seconds and time.monotonic() - began > options.seconds:
                return None
            return list(kills.run(number))

        numbers = (
            [options.number] if options.number is not None else range(min(options.count, MOST))
        )
        try:
            with ThreadPoolExecutor(options.jobs) as pool:
                for number, faults in zip(numbers, pool.map(run, numbers), strict=True):
                    done += faults is not None
                    for fault in faults or []:
                        found[fault.promise] += 1
                        again = f"scripts/fuzz kills --seed {options.seed} --number {number}"
                        show(f"BROKEN {fault.promise}\n  {fault.detail[:1500]}\n  {again}")
                        sys.stdout.flush()
        finally:
            if kills.cluster:
                kills.cluster.close()
    show("\n".join(f"{n:>7}  {what}" for what, n in sorted(kills.counts.items())))
    promise = "; ".join(f"{n} times broken: {what}" for what, n in found.items())
    show(f"{done} runs ended of seed {options.seed}: {promise or 'every promise was kept'}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
