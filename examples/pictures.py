#!/usr/bin/env python3
"""The pictures of the examples: straight.png by `plydrape simulate`, planned.png by `plan`.

    examples/pictures.py RESULTS           makes them from what scripts/examples left in RESULTS
    examples/pictures.py --moving RESULTS  makes the moving picture alone
    examples/pictures.py --check RESULTS   compares the numbers of the drapes that they show
    examples/pictures.py --list            names the molds that have them, those that a plan solves
    examples/pictures.py --compared        names those that both models are compared on

A picture is `figure.svg` as Chromium draws it, with a small palette. Beside the pictures,
numbers.json has the outcome of both drapes. A check compares these numbers and no bytes of
pictures, which depend on fonts and browsers. Making pictures needs Chromium and Pillow.

The moving picture, draping.webp of the dome, shows the states of the sheet that both drapes kept,
side by side. Making it needs the Python package with its extra `plot`.

Where both models are compared, straight_both.png shows the catenaries on the left and the sheet on
the right, at first contact and at the end.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from PIL import Image
    from plydrape import Result

EXAMPLES = Path(__file__).resolve().parent
SOLVED = (
    "01_flat_sheared_mold",
    "04_dome",
    "05_cylinder",
    "06_saddle",
    "08_stl_mold",
    "10_shallow",
)

COMPARED = ("01_flat_sheared_mold", "04_dome", "06_saddle")

# the mold of the moving picture; its pictures a second, how long the last one stays (s), the size
# of each half and of the lines of text above and below, in pixels
MOVING = "04_dome"
FRAMES, RATE, STAYS = 44, 11, 3.0
HALF, ABOVE, BELOW = (400, 276), 58, 44

# relative difference of numbers that rounding explains, and the same of folds of a sheet, which
# may go another way after it
ROUNDING = 1e-6
FOLDING = 0.005

# what is kept of what a sheet says beside its measures
SHEET = ("ridge_max_mm", "bridge_max_mm", "first_contact_step")


def folders(results: Path, name: str) -> dict[str, Path]:
    """The folder of results behind each picture of an example."""
    found = {"straight": results / name, "planned": results / f"{name}.plan"}
    if name in COMPARED:
        found["straight catenaries"] = results / f"{name}.catenaries"
    return found


def numbers(folder: Path) -> dict[str, object]:
    """The outcome of a drape.

    Of a sheet four digits of the height and what belongs to it, and where the catenaries were
    draped beside it their first contact; of catenaries six digits of each measure.
    """
    content = json.loads((folder / "result.json").read_text())
    summary = content["summary"]
    if summary["model"] == "sheet":
        sheet = summary["sheet"]
        found = {
            "accepted": summary["accepted"],
            "height_mm": summary["final"]["height_mm"],
            "height_share": summary["height_share"],
            "shear_deg": summary["worst"]["shear_deg"],
            **{key: sheet[key] for key in SHEET},
        }
        kept: dict[str, object] = {
            key: float(f"{value:.4g}") if isinstance(value, float) else value
            for key, value in found.items()
        }
        if "also" in content:
            beside = content["also"]["summary"]
            kept["catenaries_first_contact_step"] = beside["catenaries"]["first_contact_step"]
        return kept
    hanging = summary["catenaries"]
    out: dict[str, object] = {
        "accepted": summary["accepted"],
        "steps": summary["steps"],
        "first_contact_step": hanging["first_contact_step"],
        "first_shear_step": hanging["first_shear_step"],
    }
    for key in ("worst", "final"):
        for name, value in summary[key].items():
            if value is not None:
                out[f"{key} {name}"] = float(f"{value:.6g}")
    return out


def differ(old: object, new: object, rounding: float = ROUNDING) -> bool:
    """Whether two values differ by more than rounding."""
    if isinstance(old, float) and isinstance(new, float):
        return abs(old - new) > max(rounding, 10 * rounding * max(abs(old), abs(new)))
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
                rounding = ROUNDING if picture.endswith("catenaries") else FOLDING
                if differ(before.get(key), found.get(key), rounding):
                    was, now = before.get(key), found.get(key)
                    print(f"{name}, {picture}: {key} was {was}, is {now}", file=sys.stderr)
                    old = 1
    if old:
        print("pictures are old: examples/pictures.py makes them anew", file=sys.stderr)
    else:
        print("the pictures of the examples show what the program computes")
    return old


def raster(figure: Path) -> Image.Image:
    """Draws an SVG file."""
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
        return Image.open(raw).convert("RGB")


def save(image: Image.Image, picture: Path) -> None:
    """Writes a PNG file with a small palette."""
    from PIL import Image

    # by coverage: the scale of colors keeps its steps
    palette = image.quantize(
        160,
        method=Image.Quantize.MAXCOVERAGE,
        kmeans=2,
        dither=Image.Dither.NONE,
    )
    palette.save(picture, optimize=True)


def draw(figure: Path, picture: Path) -> None:
    """Draws an SVG file as a PNG file."""
    save(raster(figure), picture)


def compare(figures: list[Path], picture: Path) -> None:
    """Draws the last two of three panels of two figures side by side, with the models' names."""
    from PIL import Image, ImageDraw, ImageFont

    images = [raster(figure) for figure in figures]
    width, height = images[0].size
    # a head line of 46 points, three panels and a legend of 42
    top = 46 + (height - 88) // 3 - 6
    both = Image.new("RGB", (2 * width, height - top + 40), "white")
    pen = ImageDraw.Draw(both)
    for n, (image, name) in enumerate(zip(images, ("catenaries", "sheet"), strict=True)):
        both.paste(image.crop((0, top, width, height)), (n * width, 40))
        pen.text((n * width + 28, 8), name, fill="#2D323A", font=ImageFont.load_default(24))
    size = (both.width * 3 // 4, both.height * 3 // 4)
    save(both.resize(size, Image.Resampling.LANCZOS), picture)


def moving(results: Path, picture: Path) -> None:
    """Draws the sheet along both motions of the mold, frame by frame."""
    import plydrape
    from PIL import Image

    of = folders(results, MOVING)
    halves = [plydrape.Result.read(of[key] / "result.json") for key in ("straight", "planned")]
    ends = [numbers(of[key])["height_mm"] for key in ("straight", "planned")]
    heads = (
        ("straight down", f"touches too early: folds up to {ends[0]:.1f} mm high stay"),
        ("planned by plydrape", f"rolled on from the middle: {ends[1]:.1f} mm at most"),
    )
    frames = []
    for frame in range(FRAMES):
        image = Image.new("RGB", (2 * HALF[0], ABOVE + HALF[1] + BELOW), "white")
        for n, result in enumerate(halves):
            step = 1 + round(frame / (FRAMES - 1) * (len(result.times) - 1))
            image.paste(state(result, step), (n * HALF[0], ABOVE))
        words(image, heads)
        frames.append(image)
    stay = [1000 // RATE] * (FRAMES - 1) + [round(1000 * STAYS)]
    options: dict[str, Any] = {
        "duration": stay,
        "loop": 0,
        "quality": 72,
        "method": 6,
        "minimize_size": True,
    }
    frames[0].save(picture, save_all=True, append_images=frames[1:], **options)
    print(f"{picture.relative_to(EXAMPLES.parent)}: {picture.stat().st_size / 1e3:.0f} kB")


def state(result: Result, step: int) -> Image.Image:
    """One step of a sheet, as the package draws it, with a rod on each gripper."""
    import plydrape.view
    import pyvista
    from PIL import Image

    pyvista.OFF_SCREEN = True
    # drawn larger than shown: edges become smooth
    size = [2 * side for side in HALF]
    plotter: Any = pyvista.Plotter(off_screen=True, window_size=size)
    plydrape.view.sheet3d(result, step, forces=False, plotter=plotter)
    plotter.remove_scalar_bar()
    plotter.set_background("white")
    assert result.sheet is not None
    for pad in result.sheet.grippers[step - 1]:
        top = (pad[0], pad[1], pad[2] + 0.03)
        rod = pyvista.Line(pad, top).tube(radius=0.0022)
        plotter.add_mesh(rod, color="#7c8490", lighting=False)
    plotter.enable_parallel_projection()
    plotter.camera_position = [(0.42, -0.78, 0.5), (0.0, 0.0, -0.006), (0.0, 0.0, 1.0)]
    plotter.camera.parallel_scale = 0.186
    drawn = plotter.screenshot(return_img=True)
    plotter.close()
    return Image.fromarray(drawn).resize(HALF, Image.Resampling.LANCZOS)


def words(image: Image.Image, heads: tuple[tuple[str, str], tuple[str, str]]) -> None:
    """What each half shows, and below the scale of colors of the height."""
    from matplotlib import colormaps
    from PIL import ImageDraw, ImageFont

    pen = ImageDraw.Draw(image)
    large, small = ImageFont.load_default(19), ImageFont.load_default(15)
    for n, (head, says) in enumerate(heads):
        pen.text((n * HALF[0] + 22, 8), head, fill="#14161A", font=large)
        pen.text((n * HALF[0] + 22, 34), says, fill="#4A515C", font=small)
    top, left, width = ABOVE + HALF[1] + 14, 318, 260
    for x in range(width):
        red, green, blue, _ = colormaps["viridis"](x / (width - 1), bytes=True)
        pen.line([(left + x, top), (left + x, top + 14)], fill=(int(red), int(green), int(blue)))
    pen.text((left - 12, top - 2), "height over the mold  0.1 mm", "#2D323A", small, "ra")
    pen.text((left + width + 12, top - 2), "10 mm and more", "#2D323A", small)


def keep(results: Path, name: str) -> None:
    """Writes the numbers of an example."""
    kept = {picture: numbers(folder) for picture, folder in folders(results, name).items()}
    (EXAMPLES / name / "numbers.json").write_text(json.dumps(kept, indent=1) + "\n")


def make(results: Path) -> None:
    """Makes all pictures and the numbers beside them."""
    for name in SOLVED:
        of = folders(results, name)
        for motion in ("straight", "planned"):
            draw(of[motion] / "figure.svg", EXAMPLES / name / f"{motion}.png")
        if name in COMPARED:
            figures = [of[key] / "figure.svg" for key in ("straight catenaries", "straight")]
            compare(figures, EXAMPLES / name / "straight_both.png")
        keep(results, name)
        print(f"examples/{name}: straight.png, planned.png, numbers.json")
    moving(results, EXAMPLES / MOVING / "draping.webp")
    draw(results / "hemisphere_net" / "shear.svg", EXAMPLES.parent / "docs/hemisphere_shear.png")


def main(arguments: list[str]) -> int:
    """Runs the command."""
    match arguments:
        case ["--list"]:
            print("\n".join(SOLVED))
        case ["--compared"]:
            print("\n".join(COMPARED))
        case ["--moving", results]:
            moving(Path(results), EXAMPLES / MOVING / "draping.webp")
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
