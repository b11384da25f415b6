"""`scripts/fuzz threads`: every command once with one thread and once with two, to the same bytes.

The commands, their inputs and the folders they write have the same names in both places. Every file
is compared, with the exit code and what they print but for the time that they took. A command that
is not listed here is named, so that a new one is not forgotten.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import tomllib

from . import scene
from .kills import OFFSET, SCENE, STUDY, Contents, contents
from .options import ROOT, binary_of, python_of, seconds_or_count

LINES = (
    '{"offset": {"x": 0.003, "y": -0.0015, "yaw": "0.8 deg"}}\n'
    '{"offset": {"x": "3"}}\n'
    '{"offset": {"x": 0.001}}\n'
)
TABLES = {
    "bias.csv": "displacement (mm),force (N)\n"
    + "".join(f"{2 * k},{0.02 * k * k + 0.1 * k}\n" for k in range(25)),
    # pulled for 1.5 s, and held
    "timed.csv": "time (s),displacement (mm),force (N)\n"
    + "".join(
        f"{k / 10},{2 * min(k, 15)},{0.1 * min(k, 15) + 0.5 * 0.9 ** abs(k - 15) - 0.5 * 0.9**15}\n"
        for k in range(40)
    ),
    "overhang.csv": "overhang (mm)\n62\n64.5\n63\n",
    "hang.csv": "x (mm),z (mm)\n0,0\n10,-1.2\n20,-4.1\n30,-9.5\n40,-17.2\n",
    "moments.csv": "curvature (1/m),moment (N)\n"
    + "".join(f"{2 * k},{2e-4 * k}\n" for k in range(12)),
}
BOOK = """\
[mold]
kind = "sphere"
radius = "0.6 m"
position = [0, 0, "-0.6 m"]

[ply]
material = "krogh2018"
thickness = "0.3 mm"
grippers = [2, 2]
cell = ["100 mm", "100 mm"]

[grippers]
spacing = ["99 mm", "99 mm"]
height = "50 mm"
origin = "centered"

[target]
seed = "middle"

[plan]
steps = 6
evaluations = 2

[[plies]]
title = "first"

[[plies]]
title = "second"
"""
# Commands that only print what is in the program, and those that are tried under another name.
WITHOUT_INPUT = ("schema", "limits", "man", "completions bash", "completions zsh", "new mine")
# Scenes of the examples that are also planned.
PLANNED = ("01_flat_sheared_mold", "ideal_dome", "04_dome", "17_robot")
FORMATS = (
    "csv",
    "inp",
    "ngsolve",
    "pattern",
    "boundary",
    "ros2",
    "rapid",
    "krl",
    "urscript",
    "vtk",
)


# How long something took: in a sentence, in JSON, and how far a search was.
TOOK = re.compile(
    rb"(?<= in )[\d.]+ (\xc2\xb5s|ms|s|min|h)\b( \d+ (s|min))?"
    rb'|(?<="time_s":)[\d.e-]+|(?<="plan_time_s":)[\d.e-]+|(?<="mean_equilibrium_us":)[\d.e-]+'
    rb"|^plydrape: .*(\n  .*)*\n",
    re.MULTILINE,
)


def write(folder: Path) -> list[str]:
    """Writes all inputs; the commands, each after those whose files it reads."""
    for name, text in TABLES.items():
        (folder / name).write_text(text)
    (folder / "flat.toml").write_text(SCENE.format(title="flat", height=75))
    (folder / "flat.study.toml").write_text(STUDY.format(scene="flat"))
    (folder / "offset.toml").write_text(OFFSET.format(x=3))
    (folder / "lines").write_text(LINES)
    (folder / "book.toml").write_text(BOOK)
    scenes: list[str] = []
    plans: list[str] = []
    for place in sorted(ROOT.glob("examples/*/scene.toml")):
        name, mold = place.parent.name, tomllib.loads(place.read_text()).get("mold", {}).get("file")
        if mold and not (Path(mold).name == mold and (place.parent / mold).is_file()):
            continue  # a mold that is not part of the project
        shutil.copytree(place.parent, folder / name)
        (folder / name / "scene.toml").write_text(scene.short(place.read_text()))
        one = f"{name}/scene.toml"
        scenes += [
            f"check {one} --html -o out/{name}.check",
            f"check {one} --json",
            f"net {one} -o out/{name}.net",
            f"simulate {one} -o out/{name}.sheet --model sheet --also catenaries --verbose",
            f"simulate {one} -o out/{name}.catenaries --model catenaries --json",
        ]
        if name in PLANNED:
            plans.append(f"plan {one} -o out/{name}.plan")
    commands = [
        *WITHOUT_INPUT,
        "check mine/scene.toml",
        "check flat.toml",
        "plan flat.toml -o out/plan --verbose",
        "plan flat.toml -o out/compare --compare",
        "plan flat.toml -o out/stepwise --method stepwise --anyway --json",
        "plan flat.toml -o out/again --continue out/plan",
        "plan book.toml -o out/book",
        "report out/plan -o out/page",
        "replan out/plan --picked offset.toml -o out/moved",
        "replan out/plan --picked offset.toml -o out/moved2 --json --rate 50",
        "replan out/plan --json < lines",
        "span --run 98mm --length 100mm --material krogh2018 --theory exact",
        "fit bias bias.csv --width 50mm --length 150mm",
        "fit rate timed.csv --width 100mm --length 250mm --json",
        "fit frame bias.csv --json",
        "fit overhang --warp overhang.csv --weft overhang.csv --mass 300g/m^2",
        "fit hang --warp hang.csv --mass 300g/m^2 --length 50mm",
        "fit moments --warp moments.csv -o out/moments.toml",
        "compare out/plan out/nothing",
        "template rapid",
        "template krl-src",
        "study flat.study.toml -o out/study --workers THREADS",
    ]
    commands += [*exports("plan"), *exports("moved"), *scenes, *exports("17_robot.sheet")]
    return [*commands, *exports("04_dome.sheet"), *plans, *exports("17_robot.plan")]


def exports(source: str) -> list[str]:
    """All exports of a result."""
    ask = "export out/{0} --to {1} --even-if-rejected -o out/{0}.{1}"
    return [ask.format(source, to) for to in FORMATS]


def forgotten(binary: Path, commands: list[str]) -> list[str]:
    """Commands of the program, and formats and fits, that none of these is."""
    asked = ("", "fit ")
    found = []
    for prefix in asked:
        text = subprocess.run(
            [str(binary), *prefix.split(), "--help"], capture_output=True, text=True, check=True
        ).stdout
        listed = text.partition("Commands:\n")[2].partition("\n\n")[0]
        names = re.findall(r"^  (\w+) ", listed, re.MULTILINE)
        found += [prefix + name for name in names if name != "help"]
    return [name for name in found if not any(c.startswith(name) for c in commands)]


def ran(binary: Path, command: str, folder: Path, threads: int) -> tuple[int, bytes, bytes]:
    """Runs a command; its exit code and what it printed."""
    words, _, given = command.replace("THREADS", str(threads)).partition(" < ")
    surroundings = os.environ | {
        "RAYON_NUM_THREADS": str(threads),
        "NO_COLOR": "1",
        "PLYDRAPE_PYTHON": python_of(),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    text = (folder / given).read_bytes() if given else b""
    done = subprocess.run(
        [str(binary), *words.split()],
        cwd=folder,
        env=surroundings,
        input=text,
        capture_output=True,
        check=False,
    )
    return done.returncode, TOOK.sub(b"", done.stdout), TOOK.sub(b"", done.stderr)


def differences(one: Contents, two: Contents) -> Iterator[str]:
    """Files that are not the same."""
    for name in sorted(one.keys() | two.keys()):
        # rows of a study are in as many parts as they took seconds
        if "/rows/" in name or one.get(name) == two.get(name):
            continue
        if name not in one or name not in two:
            yield f"{name} is there once"
            continue
        a, b = one[name], two[name]
        at = next((k for k, (x, y) in enumerate(zip(a, b, strict=False)) if x != y), 0)
        yield f"{name}, byte {at}: {a[at - 20 : at + 30]!r}, {b[at - 20 : at + 30]!r}"


def main() -> int:
    """Runs all commands; the exit code."""
    parser = argparse.ArgumentParser("scripts/fuzz threads", description=__doc__.partition("\n")[0])
    seconds_or_count(parser)
    options = parser.parse_args()
    binary = binary_of(options)
    found: list[str] = []
    codes: dict[int, int] = {}
    began, done = time.monotonic(), 0
    with tempfile.TemporaryDirectory(prefix="plydrape-threads-") as name:
        folders = [Path(name) / "one" / "here", Path(name) / "two" / "here"]
        commands: list[str] = []
        for folder in folders:
            (folder / "out").mkdir(parents=True)
            commands = write(folder)
        found += [f"{command}: is not run here" for command in forgotten(binary, commands)]
        seen: set[str] = set()
        for command in commands[: options.count]:
            if options.seconds and time.monotonic() - began > options.seconds:
                break
            one, two = (ran(binary, command, f, n) for n, f in enumerate(folders, 1))
            done += 1
            codes[one[0]] = codes.get(one[0], 0) + 1
            for what, a, b in zip(("exit code", "output", "messages"), one, two, strict=True):
                if a != b:
                    found.append(f"{command}: {what}: {a!r:.300} and {b!r:.300}")
            if one[0] not in (0, 1, 2, 3):
                found.append(f"{command}: exit {one[0]}: {one[2].decode()[:300]}")
            files = [contents(folder) for folder in folders]
            for what in differences(*files):
                if what.partition(",")[0] not in seen:
                    seen.add(what.partition(",")[0])
                    found.append(f"{command}: {what}")
            for text in found:
                if text not in seen:
                    seen.add(text)
                    print(f"BROKEN {text}", flush=True)
    refused = codes.get(2, 0)
    print(
        f"{done} of {len(commands)} commands wrote the same bytes with one thread and with two but "
        f"for {len(found)} differences; {refused} were refused, as they should be for their input"
    )
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
