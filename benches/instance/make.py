"""Makes the published scenes anew: plans each, thins the motion, and writes what is published.

    python benches/instance/make.py [--plans FOLDER]

FOLDER may have plans that were made before, as FOLDER/NAME/result.json; scenes without one are
planned, which takes minutes. It needs NumPy.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import json
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
import score

ROOT = score.HERE.parents[1]
USUAL_PRESET = 'preset = "usual"'

SCENES: dict[str, tuple[str, str, dict[str, str]]] = {
    "flat_paper": ("01_flat_sheared_mold", "Flat mold, sheared by 20 deg, the paper's ply", {}),
    "dome_paper": ("ideal_dome", "Dome, the paper's ply", {}),
    "flat_warm": (
        "01_flat_sheared_mold",
        "Flat mold, sheared by 20 deg, warm prepreg",
        {"krogh2018": "prepreg_warm"},
    ),
    "cylinder_warm": (
        "18_prepreg",
        "Cylinder, warm prepreg, 24 cups",
        {USUAL_PRESET: 'preset = "ideal"'},
    ),
    "cylinder_dry_usual": (
        "05_cylinder",
        "Cylinder, dry carbon, usual cell",
        {"prepreg_warm": "dry_carbon"},
    ),
    "dome_warm_usual": ("04_dome", "Dome, warm prepreg, usual cell", {}),
}
"""Name: the example that it comes from, its title, and what is replaced in it."""

STATES = 6
"""Steps of which states are published, evenly over the motion."""

START = ("spacing", "height", "origin", "direction")
"""Keys of [grippers] that say where the motion starts, which its file says too."""


def problem(name: str) -> str:
    """The scene to be planned."""
    example, title, changes = SCENES[name]
    lines = (ROOT / "examples" / example / "scene.toml").read_text().splitlines()
    # comments are about the example
    text = "\n".join(re.sub(r"\s*#.*", "", line) for line in lines if not line.startswith("#"))
    text = re.sub(r'title = ".*"', f'title = "{title}"', text.strip())
    for old, new in changes.items():
        text = text.replace(old, new)
    return text + "\n"


def judged(text: str) -> str:
    """The scene whose motion is a file."""
    lines, table = [], ""
    for line in text.splitlines():
        table = line if line.startswith("[") else table
        key = line.partition("=")[0].strip()
        if table == "[motion]" or (table == "[grippers]" and key in START):
            continue
        lines.append(line)
    motion = ["[motion]", 'kind = "file"', 'file = "motion.csv"']
    body = re.sub(r"\[grippers\]\n+(?=\[|$)", "", "\n".join(lines))
    return "\n".join([body.rstrip(), "", *motion, ""])


def write(path: Path, head: list[str], rows: Iterable[list[str]]) -> None:
    """A table."""
    with path.open("w", newline="", encoding="utf-8") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(head)
        out.writerows(rows)


def publish(name: str, plan: Path) -> None:
    """The files of a scene, from its plan."""
    folder = score.HERE / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    (folder / "problem.toml").write_text(problem(name))
    (folder / "scene.toml").write_text(judged(problem(name)))
    with (plan / "trajectory.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    motion = ([*digits(row[:1], 9), row[1], *digits(row[2:5], 12)] for row in rows[1:])
    write(folder / "motion.csv", rows[0][:5], motion)

    with tempfile.TemporaryDirectory() as home:
        usual = USUAL_PRESET in problem(name)
        figures = score.drape(name, folder / "motion.csv", Path(home), with_errors=usual)
        states = np.load(Path(home) / "out" / "sheet.npz")
        result = json.loads((Path(home) / "out" / "result.json").read_text())
        publish_states(folder, states, figures, result)


def publish_states(folder: Path, states: Any, figures: dict[str, Any], result: Any) -> None:
    """Loads, states and wrinkles of a drape, and its figures."""
    names = ["g{}_{}".format(*gripper) for gripper in grippers(result)]
    steps = list(zip(states["step"], states["time"], states["pad_forces"], strict=True))
    loads = [
        [str(step), f"{time:.4f}", gripper, *digits(force, 4)]
        for step, time, forces in steps
        for gripper, force in zip(names, forces, strict=True)
    ]
    write(folder / "loads.csv", ["step", "t (s)", "gripper", "x (N)", "y (N)", "z (N)"], loads)

    places = 1e3 * states["places"]
    lines = [sorted(set(np.round(places[:, axis], 6)))[::2] for axis in (0, 1)]
    rounded = np.round(places, 6)
    coarse = [n for n, (u, v) in enumerate(rounded) if u in lines[0] and v in lines[1]]
    kept = sorted({int(n) for n in np.linspace(0, len(steps) - 1, STATES).round()})
    rows = [
        [str(steps[n][0]), *digits(places[k], 3), *digits(1e3 * states["positions"][n, k], 3)]
        for n in kept
        for k in coarse
    ]
    head = ["step", "u (mm)", "v (mm)", "x (mm)", "y (mm)", "z (mm)"]
    write(folder / "states.csv", head, rows)
    heights = 1e3 * states["height"][-1]
    rows = [
        [*digits(at, 3), *digits([height], 4)] for at, height in zip(places, heights, strict=True)
    ]
    write(folder / "wrinkles.csv", ["u (mm)", "v (mm)", "height (mm)"], rows)
    (folder / "figures.json").write_text(json.dumps(figures, indent=1) + "\n")


def grippers(result: Any) -> list[Any]:
    """Columns and rows of the grippers, in the order of all tables."""
    grid = result["scene"]["ply"]["grid"]
    return [(i, j) for j in range(grid["nv"]) for i in range(grid["nu"])]


def digits(values: Any, count: int) -> list[str]:
    """Numbers with so many decimals; adding 0 makes −0 a plain 0."""
    return [f"{round(float(value), count) + 0.0:.{count}f}" for value in values]


def checksums() -> str:
    """A line for each published file."""
    files = sorted(path for name in score.NAMES for path in (score.HERE / name).iterdir())
    sums = ((hashlib.sha256(path.read_bytes()).hexdigest(), path) for path in files)
    return "".join(f"{digest}  {path.relative_to(score.HERE)}\n" for digest, path in sums)


def main() -> None:
    """Plans what is not planned yet, and publishes all of it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--plans", type=Path, help="folder of plans that were made before")
    parser.add_argument("--only", choices=SCENES, nargs="*", help="these scenes alone")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as home:
        for name in args.only or SCENES:
            plan = (args.plans or Path(home)) / name
            if not (plan / "result.json").is_file():
                scene = Path(home) / f"{name}.toml"
                scene.write_text(problem(name))
                command = [score.program(), "plan", str(scene), "-o", str(plan), "--quiet"]
                done = subprocess.run(command, check=False)
                # the best plan counts, accepted or not
                if done.returncode > 1:
                    sys.exit(done.returncode)
            publish(name, plan)
            print(f"made {name}", flush=True)
    score.NAMES[:] = sorted(path.parent.name for path in score.HERE.glob("*/scene.toml"))
    (score.HERE / "SHA256SUMS").write_text(checksums())


if __name__ == "__main__":
    main()
