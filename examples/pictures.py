#!/usr/bin/env python3
"""The pictures of the examples: straight.png by `plydrape simulate`, planned.png by `plan`.

    examples/pictures.py RESULTS           makes them from what scripts/examples left in RESULTS
    examples/pictures.py --check RESULTS   compares the numbers of the drapes that they show
    examples/pictures.py --list            names the molds that have them, those that a plan solves

A picture is `figure.svg` as Chromium draws it, with a small palette. Beside the pictures,
numbers.json has the outcome of both drapes. A check compares these numbers and no bytes of
pictures, which depend on fonts and browsers. Making pictures needs Chromium and Pillow.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parent
SOLVED = (
    "01_flat_sheared_mold",
    "04_dome",
    "05_cylinder",
    "06_saddle",
    "08_stl_mold",
    "10_shallow",
)

# relative difference of numbers that rounding explains
ROUNDING = 1e-6


def folders(results: Path, name: str) -> dict[str, Path]:
    """The folder of results behind each picture of an example."""
    return {"straight": results / name, "planned": results / f"{name}.plan"}


def numbers(folder: Path) -> dict[str, object]:
    """The outcome of a drape, six digits of each number."""
    summary = json.loads((folder / "result.json").read_text())["summary"]
    out: dict[str, object] = {
        key: summary[key] for key in ("accepted", "steps", "first_contact_step", "first_shear_step")
    }
    for key in ("worst", "final"):
        for name, value in summary[key].items():
            if value is not None:
                out[f"{key} {name}"] = float(f"{value:.6g}")
    return out


def differ(old: object, new: object) -> bool:
    """Whether two values differ by more than rounding."""
    if isinstance(old, float) and isinstance(new, float):
        return abs(old - new) > max(ROUNDING, 10 * ROUNDING * max(abs(old), abs(new)))
    return old != new


def check(results: Path) -> int:
    """Compares the numbers of all drapes; 1 if one differs."""
    old = 0
    for name in SOLVED:
        kept = json.loads((EXAMPLES / name / "numbers.json").read_text())
        for picture, folder in folders(results, name).items():
            found = numbers(folder)
            before = kept[picture]
            for key in sorted({*found, *before}):
                if differ(before.get(key), found.get(key)):
                    was, now = before.get(key), found.get(key)
                    print(f"{name}, {picture}: {key} was {was}, is {now}", file=sys.stderr)
                    old = 1
    if old:
        print("pictures are old: examples/pictures.py makes them anew", file=sys.stderr)
    else:
        print("the pictures of the examples show what the program computes")
    return old


def draw(figure: Path, picture: Path) -> None:
    """Draws an SVG file as a PNG file."""
    from PIL import Image

    sizes = re.search(r'width="(\d+)" height="(\d+)"', figure.read_text()[:200])
    if sizes is None:
        raise SystemExit(f"{figure} does not begin with its width and height")
    with tempfile.TemporaryDirectory() as place:
        raw = Path(place) / "raw.png"
        options = [
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--hide-scrollbars",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
        ]
        command = ["chromium", *options, f"--user-data-dir={place}/profile"]
        command += [f"--window-size={sizes[1]},{sizes[2]}", f"--screenshot={raw}"]
        subprocess.run([*command, figure.resolve().as_uri()], check=True, capture_output=True)
        image = Image.open(raw).convert("RGB")
        # by coverage: the scale of colours keeps its steps
        palette = image.quantize(
            160,
            method=Image.Quantize.MAXCOVERAGE,
            kmeans=2,
            dither=Image.Dither.NONE,
        )
        palette.save(picture, optimize=True)


def make(results: Path) -> None:
    """Makes all pictures and the numbers beside them."""
    for name in SOLVED:
        kept = {}
        for picture, folder in folders(results, name).items():
            draw(folder / "figure.svg", EXAMPLES / name / f"{picture}.png")
            kept[picture] = numbers(folder)
        (EXAMPLES / name / "numbers.json").write_text(json.dumps(kept, indent=1) + "\n")
        print(f"examples/{name}: straight.png, planned.png, numbers.json")
    draw(results / "hemisphere_net" / "shear.svg", EXAMPLES.parent / "docs/hemisphere_shear.png")


def main(arguments: list[str]) -> int:
    """Runs the command."""
    match arguments:
        case ["--list"]:
            print("\n".join(SOLVED))
        case ["--check", results]:
            return check(Path(results))
        case [results] if not results.startswith("-"):
            make(Path(results))
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
