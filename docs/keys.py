"""Every key of a scene as Markdown, made from the JSON Schema: `python docs/keys.py` writes it."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import tomllib

Json = dict[str, Any]

DOCS = Path(__file__).resolve().parent
PAGE = DOCS / "guide" / "keys.md"
CHOICE_OF_TABLES = ("anyOf", "oneOf")

# "Friction, 0 unless given." has its default in its description, as all of them have.
DEFAULTS = [
    re.compile(r"(?:^|[,;.]\s+)(?P<default>(?:[^,;.]|\.(?=\d))+?) unless given\b"),
    re.compile(r"\s*Unless given,? (?P<default>[^.]+)\."),
]
BLOCK = re.compile(r"^```(?:\{code-block\} )?toml\n(.*?)^```", re.M | re.S)

# Examples of keys that no scene of the repository and no chapter of the guide uses.
LIKELY = {
    "bodies[].mesh": '"cup.stl"',
    "bodies[].unit": '"mm"',
    "grippers.holding_force": '"15 N"',
    "grippers.pad_radius": '"15 mm"',
    "grippers.slip_force": '"6 N"',
    "grippers.positions": '"start.csv"',
    "limits.workspace": '[["-1 m", "1 m"], ["-1 m", "1 m"], [0, "0.8 m"]]',
    "mold.normal": "[0, 0.1, 1]",
    "mold.ring_radius": '"1.2 m"',
    "mold.spanned": '"8 mm"',
    "mold.tube_radius": '"0.3 m"',
    "motion.duration": '"29 s"',
    "obstacles[].box.at": '[0, 0, "20 mm"]',
    "obstacles[].cylinder.from": '"0 mm"',
    "obstacles[].cylinder.radius": '"40 mm"',
    "obstacles[].cylinder.to": '"300 mm"',
    "plan.improve": "true",
    "plan.move_limit": '"5 mm"',
    "ply.holes": '[{ middle = ["125 mm", "125 mm"], diameter = "40 mm" }]',
    "ply.holes[].diameter": '"40 mm"',
    "ply.material.bending_rigidity_warp": '"9e-5 N m"',
    "ply.material.bending_rigidity_weft": '"8e-5 N m"',
    "ply.material.flexural_rigidity": '"9e-6 N m^2"',
    "ply.material.mass": '"314 g/m^2"',
    "ply.material.shear_curve": '"5 N/m"',
    "ply.material.tension": '"1e6 N/m"',
    "ply.material.locking_angle": '"50 deg"',
    "ply.material.locking_test": '"picture frame, 23 C"',
    "ply.material.name": '"my prepreg"',
    "ply.material.source": '"our own tests"',
    "ply.material.shear_curve.angle": '[0, "10 deg", "30 deg"]',
    "ply.material.shear_curve.force": "[0, 4, 20]",
    "ply.material.shear_curve.polynomial": "[5, 0, 12]",
    "ply.material.tension.force": "[0, 500, 2000]",
    "ply.material.tension.strain": '[0, "0.1 %", "0.3 %"]',
    "ply.outline.file": '"blank.dxf"',
    "ply.outline.unit": '"mm"',
    "ply.outline": '"blank.dxf"',
    "ply.outline.layers": '["CUT"]',
    "ply.outline.tolerance": '"0.1 mm"',
    "ply.piece.block": '"P1"',
    "ply.piece.label": '"FRONT"',
    "ply.piece.point": '["120 mm", "80 mm"]',
    "ply.points": '[["20 mm", "20 mm"], ["120 mm", "20 mm"]]',
    "sheet.keep": "50",
    "target.positions": '"target.csv"',
    "target.trim": '"trim.csv"',
    "tool.residual": '"2 mm"',
    "tool.world.rotation": '[0, 0, "90 deg"]',
}

# what is no bare quantity: words to choose from, and what has its least value from the schema
WORDS = re.compile("[`≥]|^table$")
UNIT = re.compile(r" \((?:m|rad|s|N|Hz|Pa|m/s|m/s²|m/s³|rad/s|rad/s²|N/m|N·m|N·m²)\)")


def page() -> str:
    """The page: its head, and all tables."""
    head = PAGE.read_text(encoding="utf-8").split("\n## ", 1)[0]
    return re.sub(r"\n{3,}", "\n\n", f"{head.rstrip()}\n\n{markdown().strip()}\n")


def markdown() -> str:
    """Tables of all keys, one for each table of a scene."""
    schema = json.loads((DOCS / "scene.schema.json").read_text(encoding="utf-8"))
    used = examples()
    scene = {**schema, "properties": {"title": schema["properties"]["title"]}}
    parts = [section(schema, "", scene, used)]
    for name, key in schema["properties"].items():
        if name != "title":
            parts += tables(schema, name, key, used)
    return "\n".join(parts)


def tables(schema: Json, path: str, key: Json, used: Json) -> Iterator[str]:
    """The section of a table of a scene, and those of the tables in it."""
    many = key.get("type") == "array"
    for table in alternatives(schema, key["items"] if many else key):
        properties = table.get("properties")
        # a term of an error is a table of one key, which the text above all of them explains
        if properties is None or is_term(properties):
            continue
        here = f"{path}[]" if many else path
        yield section(schema, here, table, used)
        for name, inner in properties.items():
            yield from tables(schema, f"{here}.{name}", inner, used)


def alternatives(schema: Json, key: Json) -> list[Json]:
    """What a key may hold, references followed."""
    if "$ref" in key:
        return alternatives(schema, schema["$defs"][unquote(key["$ref"]).rsplit("/", 1)[1]])
    for choice in CHOICE_OF_TABLES:
        if choice in key:
            return [one for option in key[choice] for one in alternatives(schema, option)]
    return [key]


def section(schema: Json, path: str, table: Json, used: Json) -> str:
    """The heading of a table and its keys."""
    level = "##" if path.count(".") == 0 else "###"
    name = path.replace("[].", ".")
    name = f"[[{name[:-2]}]]" if name.endswith("[]") else f"[{name}]"
    lines = ["", f"{level} `{name}`" if path else "## Before all tables", ""]
    lines += [sentence(table["description"]) if path else "", ""]
    lines += ["| key | meaning | unit | default | allowed | found in practice | example |"]
    lines += ["|---" * 7 + "|"]
    needed = table.get("required", [])
    for key, held in table["properties"].items():
        meaning, default = parted(held.get("description", ""))
        if key in needed:
            default = "**needed**"
        example = used.get(f"{path}.{key}".strip(".")) or likely(
            schema, f"{path}.{key}", held, default
        )
        shown = f"`{key} = {example}`" if example else ""
        meaning += choices(schema, held)
        units, ranges = kinds(schema, held)
        if limits := bounds(schema, held):
            ranges = [text if WORDS.search(text) else f"{text}, {limits}" for text in ranges]
        allowed, usual = " or ".join(ranges), found(schema, held)
        row = [f"`{key}`", meaning, ", ".join(units), default, allowed, usual, shown]
        lines.append("| " + " | ".join(cell.replace("|", "\\|") or "–" for cell in row) + " |")
    return "\n".join([*lines, ""])


def sentence(text: str) -> str:
    """A description in one line; tables that it names are shown as such."""
    return re.sub(r"(?<![`\w])(\[[a-z]+\])(?!\()", r"`\1`", " ".join(text.split()))


def parted(description: str) -> tuple[str, str]:
    """The meaning and the default of a key."""
    text = sentence(description)
    for pattern in DEFAULTS:
        if found := pattern.search(text):
            default = found["default"].strip()
            if "unless given" in found[0].lower():
                text = text[: found.start()] + text[found.end() :]
            break
    else:
        default = ""
    text = UNIT.sub("", text).strip()
    text = re.sub(r"^[,;:]\s*", "", text)
    return text + ("" if text.endswith(".") else "."), default


def choices(schema: Json, key: Json) -> str:
    """What each word means that a key may hold."""
    words = [
        f' `"{option["const"]}"`: {sentence(option["description"])}'
        for option in alternatives(schema, key)
        if "const" in option and "description" in option
    ]
    return "".join(words)


def kinds(schema: Json, key: Json) -> tuple[list[str], list[str]]:
    """Units of a key and what it may hold, each without repetition."""
    units: list[str] = []
    ranges: list[str] = []
    words: list[str] = []
    for option in alternatives(schema, key):
        unit, allowed = kind(schema, option)
        if "const" in option or "enum" in option:
            words.append(allowed)
            continue
        if unit and unit not in units:
            units.append(unit)
        if allowed and allowed not in ranges:
            ranges.append(allowed)
    return units, ([", ".join(words)] if words else []) + ranges


def kind(schema: Json, option: Json) -> tuple[str, str]:
    """The unit of one option and what it may hold."""
    if "const" in option:
        return "", f'`"{option["const"]}"`'
    if "enum" in option:
        return "", ", ".join(f'`"{value}"`' for value in option["enum"])
    about = option.get("description", "")
    match option.get("type"):
        case "number":
            quantity, _, unit = about.partition(" in ")
            return ("1" if about == "a ratio" else unit), article(quantity or "number")
        case "integer":
            return "", "integer" + (f" ≥ {option['minimum']}" if "minimum" in option else "")
        case "string":
            if about.endswith("with its unit"):
                return "", ""
            words = option.get("examples", [])
            if len(words) > 1:
                return "", ", ".join(f'`"{word}"`' for word in words)
            return "", article(about) if words else "text"
        case "boolean":
            return "", "`true`, `false`"
        case "array":
            units, inner = kinds(schema, option["items"])
            count = option.get("minItems")
            many = "list of " if count is None else f"{count} × "
            return ", ".join(units), many + " or ".join(inner)
        case "object":
            if is_term(properties := option.get("properties", {})):
                words = ("deviation", "bound", "factor")[: len(properties)]
                return kinds(schema, properties["bound"])[0][0], " or ".join(
                    f"`{w}`" for w in words
                )
            return "", "table"
    return "", ""


def is_term(properties: Json) -> bool:
    """Whether these are the keys of an error."""
    return {"bound", "deviation"} <= set(properties) <= {"bound", "deviation", "factor"}


def number(schema: Json, key: Json) -> Json:
    """The plain number that a key may be, or each value of a list."""
    for option in alternatives(schema, key):
        if option.get("type") == "number":
            return option
        inner = option.get("items") or option.get("properties", {}).get("bound")
        if inner and (plain := number(schema, inner)):
            return plain
    return {}


def bounds(schema: Json, key: Json) -> str:
    """The range of a number: > 0, < 90 deg."""
    plain = number(schema, key)
    above, below = plain.get("exclusiveMinimum"), plain.get("exclusiveMaximum")
    least: float | None = plain.get("minimum", above)
    most: float | None = plain.get("maximum", below)
    if least is None or (least < 0 and not is_angle(plain)):
        return ""
    if most and least == -most:
        return f"{math.degrees(least):g} to {math.degrees(most):g} deg"
    if (least, most, above) == (0, 1, None):
        return "0 to 1"
    if plain["description"] == "a ratio" and least >= 1:
        return f"≥ {least:g}"
    # what is far below anything that somebody would write is zero
    text = "> 0" if above == 0 or least > 0 else "≥ 0"
    if is_angle(plain) and below:
        return f"{text}, < {math.degrees(below):g} deg"
    return f"{text}, ≤ 1" if most == 1 else text


def is_angle(plain: Json) -> bool:
    """Whether a number is an angle."""
    return bool(plain.get("description") == "an angle in rad")


def found(schema: Json, key: Json) -> str:
    """What is found in practice of a number."""
    return str(number(schema, key).get("x-usual", ""))


def ranges() -> dict[str, str]:
    """The range of every number in a table of a scene that has one."""
    schema = json.loads((DOCS / "scene.schema.json").read_text(encoding="utf-8"))
    texts = {}
    for name, table in schema["properties"].items():
        for option in alternatives(schema, table):
            for key, held in option.get("properties", {}).items():
                scalar = any(inner.get("type") == "number" for inner in alternatives(schema, held))
                if scalar and (text := bounds(schema, held)):
                    texts[f"{name}.{key}"] = text
    return texts


def article(text: str) -> str:
    """A quantity without its article."""
    return re.sub(r"^an? ", "", text)


def likely(schema: Json, path: str, key: Json, default: str) -> str:
    """A value that somebody would write: one of the list above, the default, a word."""
    if path in LIKELY:
        return LIKELY[path]
    if quantity(schema, key) and key.get("examples"):
        value = key["examples"][0]
        return str(value) if isinstance(value, float) else shown(value)
    if re.match(r"[\d\"]", default):
        return default if re.fullmatch(r'[\d.]+|".*"', default) else f'"{default}"'
    return invented(schema, key) if not quantity(schema, key) else ""


def quantity(schema: Json, key: Json) -> bool:
    """Whether it is a number with a unit, or a list of such."""
    return any(
        option.get("description", "").endswith("with its unit")
        or ("items" in option and quantity(schema, option["items"]))
        for option in alternatives(schema, key)
    )


def invented(schema: Json, key: Json) -> str:
    """An example from the schema."""
    for option in alternatives(schema, key):
        if "const" in option:
            return f'"{option["const"]}"'
        if option.get("examples"):
            return shown(option["examples"][0])
        if option.get("type") == "array":
            inner = invented(schema, option["items"])
            return "[" + ", ".join([inner] * option.get("minItems", 2)) + "]" if inner else ""
        if is_term(option.get("properties", {})):
            return f"{{ bound = {invented(schema, option['properties']['bound'])} }}"
    return ""


def examples() -> Json:
    """The first short value of each key in the scenes of the examples and of the guide."""
    found: Json = {}
    texts = [path.read_text() for path in sorted((DOCS.parent / "examples").glob("*/scene.toml"))]
    for page in sorted((DOCS / "guide").glob("*.md")):
        blocks = BLOCK.findall(page.read_text())
        texts += [re.sub(r"^:caption:.*\n", "", block) for block in blocks]
    for text in texts:
        with suppress(tomllib.TOMLDecodeError):
            collect("", tomllib.loads(text), found)
    return found


def collect(path: str, value: Any, found: Json) -> None:
    """Keeps a value and those in it by their paths."""
    if isinstance(value, dict):
        for key, inner in value.items():
            collect(f"{path}.{key}".strip("."), inner, found)
        if value and not any(isinstance(inner, dict | list) for inner in value.values()):
            keep(path, value, found)
        return
    if isinstance(value, list) and value and isinstance(value[0], dict):
        for inner in value:
            collect(f"{path}[]", inner, found)
        return
    keep(path, value, found)


def keep(path: str, value: Any, found: Json) -> None:
    """Keeps a value that is short enough for a table."""
    if path not in found and len(text := shown(value)) <= 44:
        found[path] = text


def shown(value: Any) -> str:
    """A value as TOML."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {shown(inner)}" for key, inner in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(shown, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
