"""`scripts/fuzz picks`: many offsets answered by one `plydrape replan --json`, in constant memory.

Offsets, pairs of points, lines that are refused and lines that are no JSON come in turn, and each
gets its one line. The memory of the process is read after this many lines, each ten times as many.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from random import Random

from .kills import SCENE
from .options import binary_of, seconds_or_count

GROWTH = 1.02  # of memory, from the first reading to the last
FIRST = 1000  # lines before it is read first


def line(rng: Random) -> tuple[str, bool]:
    """A line of standard input, and whether it says an offset."""
    x, y, yaw = (round(rng.uniform(-5, 5), 3) for _ in range(3))
    match rng.randrange(20):
        case 0:
            return rng.choice(('{"offset": {"x": "3"}}', "{", '{"offset": {"x": 1e999}}')), False
        case 1:
            return '{"offset": {"x": 9e5}}', False
        case 2 | 3 | 4:
            pairs = [
                {"planned": [a, b], "seen": [a + x / 1e3, b + y / 1e3]}
                for a, b in ((0.0, 0.0), (0.1, 0.0), (0.0, 0.1))
            ]
            return json.dumps({"point": pairs}), True
        case _:
            return json.dumps(
                {"offset": {"x": x / 1e3, "y": f"{y} mm", "yaw": f"{yaw / 5} deg"}}
            ), True


def resident(process: int) -> int:
    """Memory of a process (kB)."""
    for entry in Path(f"/proc/{process}/status").read_text().splitlines():
        if entry.startswith("VmRSS:"):
            return int(entry.split()[1])
    raise SystemExit(f"fuzz: no memory of process {process} is known")


def main() -> int:
    """Asks for many offsets; the exit code."""
    parser = argparse.ArgumentParser("scripts/fuzz picks", description=__doc__.partition("\n")[0])
    seconds_or_count(parser)
    options = parser.parse_args()
    binary, most = binary_of(options), min(options.count, 10**9)
    rng, found, answered = Random(options.seed), [], 0
    readings: dict[int, int] = {}
    with tempfile.TemporaryDirectory(prefix="plydrape-picks-") as name:
        folder = Path(name)
        (folder / "scene.toml").write_text(SCENE.format(title="a", height=75))
        plan = ["plan", "scene.toml", "--without-errors", "-q", "-o", "plan"]
        subprocess.run([str(binary), *plan], cwd=folder, check=True)
        child = subprocess.Popen(
            [str(binary), "replan", "plan/result.json", "--json"],
            cwd=folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        assert child.stdin is not None and child.stdout is not None
        began, due = time.monotonic(), FIRST
        while answered < most:
            if options.seconds and time.monotonic() - began > options.seconds:
                break
            asked, is_offset = line(rng)
            child.stdin.write(asked.encode() + b"\n")
            child.stdin.flush()
            said = child.stdout.readline()
            answered += 1
            try:
                answer = json.loads(said, parse_constant=lambda number: found.append(number))
            except ValueError:
                found.append(f"{asked}: {said[:200]!r}")
                break
            if ("error" not in answer) != is_offset:
                found.append(f"{asked}: {said[:200]!r}")
            if answered == due:
                readings[answered] = resident(child.pid)
                due *= 10
        readings[answered] = resident(child.pid)
        child.stdin.close()
        if (code := child.wait()) != 2:  # that of the worst answer
            found.append(f"exit {code}")
    first, last = readings[min(readings)], readings[max(readings)]
    if last > GROWTH * first:
        found.append(f"memory grew from {first} to {last} kB")
    sys.stdout.writelines(f"BROKEN {what}\n" for what in found[:20])
    memory = ", ".join(f"{kb / 1024:.1f} MB after {n}" for n, kb in sorted(readings.items()))
    print(f"{answered} picks of seed {options.seed} in one process, {len(found)} faults: {memory}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
