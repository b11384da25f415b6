#!/usr/bin/env python3
"""The pictures of the examples: straight.png by `plydrape simulate`, planned.png by `plan`.

    examples/pictures.py RESULTS           makes them from what scripts/examples left in RESULTS
    examples/pictures.py --moving RESULTS  makes the moving picture alone
    examples/pictures.py --check RESULTS   compares the numbers of the drapes that they show
    examples/pictures.py --list            names the molds that have them, those that a plan solves
    examples/pictures.py --compared        names those that both models are compared on

A picture shows two steps as the page report.html draws them in Chromium, see viewer/pictures.mjs,
with a small palette. Beside the pictures, numbers.json has the outcome of both drapes. A check
compares these numbers and no bytes of pictures, which depend on fonts and browsers. Making pictures
needs Chromium, Pillow and Matplotlib.

The moving picture, draping.webp of the dome, shows both drapes side by side.

Where both models are compared, straight_both.png shows the catenaries above and the sheet below, at
first contact and at the end.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from PIL import Image, ImageFont

EXAMPLES = Path(__file__).resolve().parent
ROOT = EXAMPLES.parent
SOLVED = (
    "01_flat_sheared_mold",
    "04_dome",
    "05_cylinder",
    "06_saddle",
    "08_stl_mold",
    "10_shallow",
    "ideal_dome",
)

COMPARED = ("01_flat_sheared_mold", "06_saddle", "ideal_dome")

# the mold of the moving picture; its pictures a second, how long the last one stays (s), the width
# of each half and the height of the lines of text above and below, in pixels
MOVING = "04_dome"
FRAMES, RATE, STAYS = 44, 11, 3.0
HALF, ABOVE, BELOW = 430, 58, 40

# the size of a panel on the page, what is left white around it and between the parts, the heights
# of the title and of a line above each panel, in pixels
PANEL, EDGE, TITLE, LINE = (480, 340), 14, 46, 30
DARK, QUIET, GREEN, RED = "#14161A", "#4A515C", "#1A6E33", "#A11218"

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


class Shown(NamedTuple):
    """A drape in a picture: its folder of results, the model, and its steps with their names."""

    folder: Path
    model: str
    steps: dict[int, str]


def draw(shown: list[Shown]) -> list[tuple[list[Image.Image], Image.Image]]:
    """The panels of each drape, cut to what is drawn in any of them, and the scale of its colors.

    All are drawn twice as large as the page shows them: made small, their edges are smooth.
    """
    from PIL import Image, ImageChops

    with tempfile.TemporaryDirectory() as place:
        orders = [
            {
                "report": str((one.folder / "report.html").resolve()),
                "model": one.model,
                "color": {"sheet": "over_mold", "catenaries": "gap"}[one.model],
                "size": PANEL,
                "pixels": 2,
                "steps": list(one.steps),
                "folder": f"{place}/{n}",
            }
            for n, one in enumerate(shown)
        ]
        command = [str(ROOT / "scripts/viewer"), "run", "--silent", "pictures"]
        subprocess.run(command, input=json.dumps(orders), check=True, text=True)

        def read(n: int, name: str) -> Image.Image:
            return Image.open(f"{place}/{n}/{name}.png").convert("RGB")

        found = [
            ([read(n, str(step)) for step in one.steps], read(n, "legend"))
            for n, one in enumerate(shown)
        ]
    white = Image.new("RGB", found[0][0][0].size, "white")
    boxes = [ImageChops.difference(p, white).getbbox() for panels, _ in found for p in panels]
    drawn = [box for box in boxes if box is not None]
    left, top = (min(box[c] for box in drawn) for c in (0, 1))
    right, bottom = (max(box[c] for box in drawn) for c in (2, 3))
    return [([p.crop((left, top, right, bottom)) for p in panels], bar) for panels, bar in found]


def halved(image: Image.Image) -> Image.Image:
    """A picture of half the size."""
    from PIL import Image

    return image.resize((image.width // 2, image.height // 2), Image.Resampling.LANCZOS)


def font(size: int, bold: bool = False) -> ImageFont.FreeTypeFont:
    """The font of Matplotlib."""
    from matplotlib.font_manager import FontProperties, findfont
    from PIL import ImageFont

    weight = "bold" if bold else "normal"
    return ImageFont.truetype(findfont(FontProperties("DejaVu Sans", weight=weight)), size)


def compose(title: str, accepted: bool, shown: list[Shown]) -> Image.Image:
    """A row of panels for each drape, with a line above each panel and the colors at the end."""
    from PIL import Image, ImageDraw

    rows = [([halved(panel) for panel in panels], halved(bar)) for panels, bar in draw(shown)]
    wide, high = rows[0][0][0].size
    scale = max(bar.width for _, bar in rows)
    row = LINE + max(high, *(bar.height for _, bar in rows)) + EDGE
    columns = len(rows[0][0])
    size = (EDGE + columns * (wide + 2 * EDGE) + scale + EDGE, TITLE + len(rows) * row)
    image = Image.new("RGB", size, "white")
    pen = ImageDraw.Draw(image)
    pen.text((EDGE, TITLE / 2), title, DARK, font(17, bold=True), "lm")
    start = EDGE + pen.textlength(title, font(17, bold=True)) + 16
    verdict, ink = ("✓ accepted", GREEN) if accepted else ("✗ not accepted", RED)
    pen.text((start, TITLE / 2), verdict, ink, font(14, bold=True), "lm")
    for n, ((panels, bar), one) in enumerate(zip(rows, shown, strict=True)):
        top = TITLE + n * row
        for k, (panel, name) in enumerate(zip(panels, one.steps.values(), strict=True)):
            left = EDGE + k * (wide + 2 * EDGE)
            pen.text((left, top + LINE / 2), name, DARK, font(13), "lm")
            image.paste(panel, (left, top + LINE + (row - LINE - EDGE - high) // 2))
        middle = top + LINE + (row - LINE - EDGE - bar.height) // 2
        image.paste(bar, (size[0] - scale - EDGE, middle))
    return image


def two_steps(folder: Path, *, model: str = "sheet", fronts: bool = False) -> Shown:
    """First contact and end of a drape; in place of the first contact, half-way on to the end."""
    summary = json.loads((folder / "result.json").read_text())["summary"]
    contact, last = summary[model]["first_contact_step"], summary["steps"]
    first = (contact + last) // 2 if fronts else contact
    what = "rolled on" if fronts else "first contact"
    height = summary["final"]["height_mm"] if model == "sheet" else None
    end = "" if height is None else f", up to {height:.2g} mm over the mold"
    name = model.capitalize()
    steps = {first: f"{name}, step {first}: {what}", last: f"{name}, step {last}: end{end}"}
    return Shown(folder, model, steps)


def title(folder: Path) -> tuple[str, bool]:
    """The title of a drape, and whether it is accepted."""
    content = json.loads((folder / "result.json").read_text())
    return content["scene"]["title"], content["summary"]["accepted"]


def save(image: Image.Image, picture: Path) -> None:
    """Writes a PNG file with a small palette."""
    from PIL import Image

    # by coverage: the scale of colors keeps its steps
    palette = image.quantize(
        96,
        method=Image.Quantize.MAXCOVERAGE,
        kmeans=2,
        dither=Image.Dither.NONE,
    )
    palette.save(picture, optimize=True)
    print(f"{picture.relative_to(ROOT)}: {picture.stat().st_size / 1e3:.0f} kB")


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


def moving(results: Path, picture: Path) -> None:
    """Draws the sheet along both motions of the mold, frame by frame."""
    from PIL import Image

    drapes = folders(results, MOVING)
    both = [drapes[key] for key in ("straight", "planned")]
    lasts = [json.loads((one / "result.json").read_text())["summary"]["steps"] for one in both]
    numbered = [
        [1 + round(frame / (FRAMES - 1) * (last - 1)) for frame in range(FRAMES)] for last in lasts
    ]
    drawn = draw(
        [
            Shown(one, "sheet", dict.fromkeys(steps, ""))
            for one, steps in zip(both, numbered, strict=True)
        ]
    )
    ends = [numbers(one)["height_mm"] for one in both]
    heads = (
        ("straight down", f"touches too early: folds up to {ends[0]:.1f} mm high stay"),
        ("planned by plydrape", f"rolled on from the middle: {ends[1]:.1f} mm at most"),
    )
    wide, high = drawn[0][0][0].size
    half = (HALF, round(HALF * high / wide))
    ground = Image.new("RGB", (2 * HALF + 3 * EDGE, ABOVE + half[1] + BELOW), "white")
    words(ground, heads)
    frames = []
    for frame in range(FRAMES):
        image = ground.copy()
        for n, ((panels, _), steps) in enumerate(zip(drawn, numbered, strict=True)):
            panel = panels[list(dict.fromkeys(steps)).index(steps[frame])]
            small = panel.resize(half, Image.Resampling.LANCZOS)
            image.paste(small, (EDGE + n * (HALF + EDGE), ABOVE))
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
    print(f"{picture.relative_to(ROOT)}: {picture.stat().st_size / 1e3:.0f} kB")


def words(image: Image.Image, heads: tuple[tuple[str, str], tuple[str, str]]) -> None:
    """What each half shows, and below the scale of colors of the height."""
    from matplotlib import colormaps
    from PIL import ImageDraw

    pen = ImageDraw.Draw(image)
    for n, (head, says) in enumerate(heads):
        left = EDGE + n * (HALF + EDGE)
        pen.text((left, 18), head, DARK, font(17, bold=True), "lm")
        pen.text((left, 42), says, QUIET, font(13), "lm")
    width = 260
    left, top = (image.width - width) // 2 + 30, image.height - BELOW + 14
    for x in range(width):
        red, green, blue, _ = colormaps["viridis"](x / (width - 1), bytes=True)
        pen.line([(left + x, top), (left + x, top + 14)], fill=(int(red), int(green), int(blue)))
    pen.text((left - 10, top + 7), "height over the mold  0.1 mm", DARK, font(12), "rm")
    pen.text((left + width + 10, top + 7), "10 mm and more", DARK, font(12), "lm")


def keep(results: Path, name: str) -> None:
    """Writes the numbers of an example."""
    kept = {picture: numbers(folder) for picture, folder in folders(results, name).items()}
    (EXAMPLES / name / "numbers.json").write_text(json.dumps(kept, indent=1) + "\n")


def make(results: Path) -> None:
    """Makes all pictures and the numbers beside them."""
    for name in SOLVED:
        drapes = folders(results, name)
        for motion, what in (("straight", "straight paths"), ("planned", "planned")):
            head, accepted = title(drapes[motion])
            rows = [two_steps(drapes[motion], fronts=motion == "planned")]
            save(compose(f"{head}, {what}", accepted, rows), EXAMPLES / name / f"{motion}.png")
        if name in COMPARED:
            head, accepted = title(drapes["straight"])
            rows = [
                two_steps(drapes["straight catenaries"], model="catenaries"),
                two_steps(drapes["straight"]),
            ]
            both = compose(f"{head}, straight paths", accepted, rows)
            save(both, EXAMPLES / name / "straight_both.png")
        keep(results, name)
    moving(results, EXAMPLES / MOVING / "draping.webp")
    save(raster(results / "hemisphere_net" / "shear.svg"), ROOT / "docs/hemisphere_shear.png")


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
