"""Plans the molds of the examples with real plies in the usual cell, and prints a table of them.

    python benches/unseen/reach.py [--only NAME...] [--timeout SECONDS] [--plydrape PLYDRAPE]

Each scene is that of an example with another material and the preset of the cell; all else stays.
One row a plan: its verdict, how many of its cells with errors keep all limits, how high 95 % of
them end at most, what the plan tolerates, the largest load of a cup along the ply beside what it
holds with its safety, and how long all of it took.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import tempfile
from pathlib import Path
from typing import Any

from run import ROOT, cells, run

MATERIALS = ("prepreg_warm", "dry_carbon", "prepreg_cold")

MOLDS = {
    "04_dome": 3,
    "05_cylinder": 2,
    "06_saddle": 2,
    "08_stl_mold": 3,
    "10_shallow": 3,
    "13_cut_ply": 2,
    "14_bias_ply": 2,
    "16_fixture": 2,
    "17_robot": 2,
    "18_prepreg": 3,
}
"""Examples, and with how many of the materials."""

HEAD = [
    "mold",
    "material",
    "verdict",
    "cells",
    "95 % end at most (mm)",
    "tolerates of grippers (mm)",
    "of shear (×)",
    "of mass (×)",
    "cup (N)",
    "time (s)",
]


def scene(example: str, material: str) -> str:
    """The scene of an example with another material in the usual cell."""
    folder = ROOT / "examples" / example
    text = (folder / "scene.toml").read_text()
    text = re.sub(r'(?m)^material = "\w+"', f'material = "{material}"', text)
    text = re.sub(r'(?m)^file = "', f'file = "{folder}/', text)
    if "[cell]" in text:
        return re.sub(r'(?m)^preset = "\w+"', 'preset = "usual"', text)
    return text.replace("[ply]", '[cell]\npreset = "usual"\n\n[ply]', 1)


def limit(of: dict[str, Any], name: str) -> dict[str, Any]:
    """A limit by its name."""
    limits: list[dict[str, Any]] = of.get("limits") or []
    return next((limit for limit in limits if limit["name"] == name), {})


def number(value: object, digits: int = 2) -> str:
    """A number, or a dash where there is none."""
    return f"{value:.{digits}f}" if isinstance(value, int | float) else "–"


def between(ends: list[float] | None) -> str:
    """A range."""
    return f"{ends[0]:.2g} to {ends[1]:.2g}" if ends else "–"


def row(program: Path, example: str, material: str, timeout: float) -> list[str]:
    """The row of a plan."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.toml"
        file.write_text(scene(example, material))
        command = [str(program), "plan", str(file), "-o", f"{folder}/out", "--json", "--quiet"]
        done = run(command, timeout)
    printed: dict[str, Any] = json.loads(done.out) if done.out.strip() else {}
    sample, tolerance = (printed.get(name) or {} for name in ("sample", "tolerance"))
    slip = limit(printed, "slip")
    verdict = "**accepted**" if printed.get("accepted") and done.exit == 0 else "refused"
    if done.late or not printed or done.exit not in (0, 1):
        verdict = "out of time" if done.late else f"failed: exit {done.exit}"
    for limit_of in printed.get("infeasible_limits") or []:
        value = f"{limit_of['value']:.3g} {limit_of['unit']}"
        verdict = f"no motion keeps {limit_of['name']}: {value}"
    return [
        example,
        f"`{material}`",
        verdict,
        cells(printed) or "–",
        number(limit(sample, "height").get("value")),
        number(tolerance.get("gripper_mm")),
        between(tolerance.get("shear")),
        between(tolerance.get("mass")),
        f"{number(slip.get('value'), 1)} of {number(slip.get('limit'), 1)}" if slip else "–",
        number(done.seconds, 0),
    ]


def main() -> None:
    """Plans the scenes of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--only", nargs="+", default=list(MOLDS), choices=MOLDS, help="examples")
    parser.add_argument("--timeout", type=float, default=300.0, help="seconds a plan")
    parser.add_argument("--plydrape", type=Path, help="$PLYDRAPE or the release build unless given")
    options = parser.parse_args()
    program = options.plydrape or Path(os.environ.get("PLYDRAPE", ROOT / "target/release/plydrape"))
    for cell in (HEAD, ["---"] * len(HEAD)):
        print("| " + " | ".join(cell) + " |", flush=True)
    for example in options.only:
        for material in MATERIALS[: MOLDS[example]]:
            cell = row(program.resolve(), example, material, options.timeout)
            print("| " + " | ".join(cell) + " |", flush=True)


if __name__ == "__main__":
    main()
