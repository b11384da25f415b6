"""What README and the guide say of other files is so."""

from __future__ import annotations

import copy
import importlib.util
import json
import re
import shutil
import subprocess
from pathlib import Path
from types import ModuleType
from typing import Any

import plydrape
import pytest
import tomllib
from program import ROOT, binary

README = (ROOT / "README.md").read_text(encoding="utf-8")
VALIDATION = (ROOT / "docs" / "guide" / "validation.md").read_text(encoding="utf-8")
TESTS = re.findall(r"`([\w/.]+)::(\w+)`", VALIDATION)


def made(name: str) -> ModuleType:
    """A module of the guide's own, which makes a page of it."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "docs" / f"{name}.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def numbers(name: str) -> dict[str, dict[str, float]]:
    """What is kept of the drapes of an example, which `.ci/run` compares with new ones."""
    text = (ROOT / "examples" / name / "numbers.json").read_text()
    kept: dict[str, dict[str, float]] = json.loads(text)
    return kept


def test_the_readme_is_short() -> None:
    """One screen: 900 words."""
    assert len(README.split()) <= 900


def test_every_document_says_the_version_of_the_program() -> None:
    """The workspace's, in README, guide, citation, changelog and page."""

    def text(name: str) -> str:
        return (ROOT / name).read_text(encoding="utf-8")

    (version,) = re.findall(r'^version = "(.*)"$', text("Cargo.toml"), re.M)
    assert plydrape.__version__ == version
    assert f"[release {version}](docs/guide/install.md)" in README
    assert f"\nversion: {version}\n" in text("CITATION.cff")
    first = re.search(r"^## \[(?!Unreleased)(.*?)\]", text("CHANGELOG.md"), re.M)
    assert first is not None and first[1] == version
    named = r"plydrape[- ](\d+\.\d+\.\d+)\b"
    for path in sorted((ROOT / "docs").rglob("*.md")):
        found = set(re.findall(named, path.read_text(encoding="utf-8")))
        assert found <= {version}, f"{path.name}: {found}"
    page = text("crates/plydrape-io/src/lib.rs")
    assert 'PROGRAM: &str = concat!("plydrape ", env!("CARGO_PKG_VERSION"))' in page


def test_the_design_is_short() -> None:
    """What a newcomer asks: 60 questions, 6 000 words."""
    text = (ROOT / "DESIGN.md").read_text(encoding="utf-8")
    assert len(text.split()) <= 6000 and len(re.findall(r"^###", text, re.M)) <= 60


def test_the_quick_start_has_two_commands() -> None:
    """One plans a shipped example, one runs all tests."""
    (block,) = re.findall(r"## Quick start.*?```sh\n(.*?)```", README, re.S)
    plan, tests = block.splitlines()
    scene = plan.removeprefix("cargo run --release -- plan ")
    assert scene != plan and (ROOT / scene).is_file()
    assert tests == "scripts/test" and (ROOT / tests).is_file()


def test_links_of_the_readme_lead_to_files() -> None:
    """Pictures and documents of the repository."""
    for link in re.findall(r"\]\(([^):#]+)(?:#[^)]*)?\)", README):
        assert (ROOT / link).exists(), link


def test_the_readme_shows_the_kept_numbers() -> None:
    """Heights on the dome, and the verdict of the first command."""
    dome, flat = numbers("04_dome"), numbers("01_flat_sheared_mold")
    assert f"folds of {dome['straight']['height_mm']:.1f} mm stay" in README
    assert f"ends {dome['planned']['height_mm']:.1f} mm high" in README
    assert re.search(rf"^height +{flat['planned']['height_mm']} ", README, re.M)


def test_the_readme_counts_the_random_scenes_as_the_benchmark_does() -> None:
    """Accepted plans of all that were tried."""
    accepted, tried = re.findall(r"Of (\d+) random scenes (\d+)", README)[0][::-1]
    table = (ROOT / "benches" / "README.md").read_text(encoding="utf-8")
    assert f"**{accepted} of {tried} are accepted" in table
    last = (ROOT / "benches" / "unseen" / "result.md").read_text(encoding="utf-8")
    small = r"Of (\d+) small ones\s+with real plies.*?, (\d+) were"
    [(tried, accepted)] = re.findall(small, README)
    assert f"\n{accepted}/{tried} scenes accepted\n" in last and "--sizes small" in last


@pytest.mark.parametrize(("file", "name"), TESTS, ids=[name for _, name in TESTS])
def test_a_comparison_is_a_test(file: str, name: str) -> None:
    """The cases in the table of the validation can be run."""
    text = (ROOT / file).read_text(encoding="utf-8")
    assert re.search(rf"\b(?:fn|def) {name}\(", text)


def test_every_table_of_a_scene_has_its_keys_on_the_page() -> None:
    """All tables of the schema that have keys; each key with what it means."""
    page = made("keys").markdown()
    schema = json.loads((ROOT / "docs" / "scene.schema.json").read_text())
    tables = [schema, *schema["$defs"].values()]
    for table in tables:
        for key, of in table.get("properties", {}).items():
            if "$ref" in of or of.get("type") == "array":
                continue
            assert f"| `{key}` | " in page, key
    rows = [line for line in page.splitlines() if line.startswith("| `")]
    assert len(rows) > 150 and not any("|  |" in row for row in rows)


def test_the_page_of_all_keys_is_made_from_the_schema() -> None:
    """The file in the sources is what `python docs/keys.py` writes."""
    made_now = made("keys").page()
    assert (ROOT / "docs" / "guide" / "keys.md").read_text(encoding="utf-8") == made_now


def test_the_template_has_keys_of_the_schema_and_their_defaults() -> None:
    """What `plydrape new` writes, also behind a `#`, are keys of their tables.

    A value that it sets is the default of its key, or says the default of the usual cell.
    """
    schema = json.loads((ROOT / "docs" / "scene.schema.json").read_text(encoding="utf-8"))
    source = ROOT / "crates" / "plydrape-io" / "src" / "scene" / "template.toml"

    def keys(part: dict[str, Any]) -> dict[str, Any]:
        while "properties" not in part:
            choices = part.get("anyOf", []) + part.get("oneOf", [])
            tables = [one for one in choices if "$ref" in one or one.get("type") == "object"]
            name = part.get("$ref", "").rsplit("/", 1)[-1]
            part = schema["$defs"][name] if name else part.get("items") or tables[0]
        found: dict[str, Any] = part["properties"]
        return found

    known, count = schema["properties"], 0
    others: dict[str, Any] = {}
    for line in source.read_text(encoding="utf-8").splitlines():
        if head := re.match(r"(?:# )?\[{1,2}([a-z_.]+)\]{1,2}", line):
            known = schema["properties"]
            for part in head[1].split("."):
                known = keys(known[part])
        elif entry := re.match(r"(# )?([a-z_]+) = (\S.*)$", line):
            assert entry[2] in known, line
            count += 1
            default = known[entry[2]].get("default")
            if entry[1] is None and default is not None:
                value = tomllib.loads(f"value = {entry[3]}")["value"]
                if value not in (default, f"{default} Pa"):
                    others[entry[2]] = value
    assert count > 120
    # a scene in the usual cell has mounts that give, and more drapes
    assert others == {"evaluations": 400}


@pytest.mark.skipif(shutil.which("cargo") is None, reason="there is no cargo")
def test_the_package_needs_nothing_compiled_anew_that_the_program_has() -> None:
    """Every dependency of both has the same features in either build, so each is compiled once."""

    def features(crate: str) -> dict[str, set[str]]:
        tree = ["cargo", "tree", "--offline", "-p", crate, "-e", "normal,build", "--prefix", "none"]
        done = subprocess.run(
            [*tree, "-f", "{p}|{f}"], cwd=ROOT, capture_output=True, text=True, check=True
        )
        found: dict[str, set[str]] = {}
        for line in done.stdout.splitlines():
            name, listed = line.split("|")
            found.setdefault(name.split(" (")[0], set()).add(listed.removesuffix(" (*)"))
        return found

    program, package = features("plydrape-cli"), features("plydrape-py")
    both = program.keys() & package.keys()
    assert len(both) > 100
    assert {name for name in both if program[name] != package[name]} == set()


def test_examples_of_keys_are_what_a_scene_takes(tmp_path: Path) -> None:
    """All limits at once, each with its example."""
    limits = made("keys").markdown().split("## `[limits]`")[1].split("\n## ")[0]
    examples = re.findall(r"\| `(\w+ = [^|]+)` \|$", limits, re.M)
    scene = tmp_path / "scene.toml"
    text = (ROOT / "examples" / "05_cylinder" / "scene.toml").read_text()
    # how far fabric may slide is no limit where it never does
    text = text.replace("[grippers]", '[grippers]\nslip_force = "10 N"')
    assert "[limits]" not in text
    scene.write_text("\n".join([text, "[limits]", *examples, ""]))
    done = subprocess.run([binary(), "check", scene], capture_output=True, text=True, check=False)
    assert done.returncode == 0 and len(examples) >= 30, done.stderr


BASE: dict[str, dict[str, Any]] = {
    "ply": {"grippers": [4, 3], "cell": ["100 mm", "100 mm"], "material": "krogh2018"},
    "mold": {"kind": "cylinder", "radius": "0.5 m", "position": [0, 0, "-0.5 m"]},
    "grippers": {"spacing": ["98 mm", "98 mm"], "height": "60 mm", "origin": "centered"},
    "target": {"seed": "middle"},
    "motion": {"kind": "straight"},
}
TORUS = {"kind": "torus", "ring_radius": "1.2 m", "tube_radius": "0.3 m"}
TILTED = {"kind": "plane", "tilt": "12 deg", "tilt_direction": "30 deg"}
MESH = {"kind": "mesh", "file": "mold.stl", "unit": "mm"}
# what a table or a key needs beside it
BESIDE: dict[str, dict[str, Any]] = {
    "pick_up": {"height": 0},
    "robot": {"arm": "ur20"},
    "ply.warp": {"size": ["350 mm", "260 mm"]},
}
MOLDS = {
    "ring_radius": TORUS,
    "spanned": MESH,
    "tube_radius": TORUS,
    "tilt": TILTED,
    "tilt_direction": TILTED,
}
# values beyond a range, and what is said of them
BEYOND: dict[str, list[tuple[float | str, str]]] = {
    "> 0": [(0, "is zero"), (-1e-6, "is negative")],
    "≥ 0": [(-1e-6, "is negative")],
    "≥ 1": [(0.99, "is too small")],
    "0 to 1": [(-1e-6, "is negative"), ("101 %", "is more than")],
    "> 0, ≤ 1": [(0, "is zero"), (1.01, "is more than")],
    "> 0, < 90 deg": [(0, "is zero"), ("91 deg", "is a right angle or more")],
    "≥ 0, < 90 deg": [(-1e-6, "is negative"), ("91 deg", "is a right angle or more")],
    "-90 to 90 deg": [("91 deg", "a right angle or more"), ("-91 deg", "a right angle or more")],
    "-360 to 360 deg": [("361 deg", "is more than a"), ("-361 deg", "is more than a")],
}


@pytest.mark.parametrize(("path", "limits"), made("keys").ranges().items())
def test_what_is_beyond_the_range_of_a_key_is_refused(path: str, limits: str) -> None:
    """With the words that say so."""
    table, key = path.split(".")
    tables = copy.deepcopy(BASE)
    if table == "mold":
        tables["mold"] = dict(MOLDS.get(key, tables["mold"]))
    if table == "robot":
        tables["tool"] = {}
    tables.setdefault(table, {}).update(BESIDE.get(table, {}) | BESIDE.get(path, {}))
    for value, words in BEYOND[limits]:
        tables[table][key] = value
        with pytest.raises(plydrape.SceneError) as refused:
            plydrape.Scene(**tables)  # type: ignore[arg-type]
        assert words in refused.value.message, refused.value


def test_every_public_name_of_the_package_is_on_its_page() -> None:
    """The stubs are those of the package that is installed."""
    page = made("api").markdown()
    for name in plydrape.__all__:
        if name not in ("__version__", "batch", "study"):
            assert re.search(rf"^### `plydrape\.(?:\w+\.)?{name}`$", page, re.M), name
    for name in plydrape.batch.__all__:
        assert f"### `plydrape.batch.{name}`" in page, name
    for name in plydrape.study.__all__:
        assert f"### `plydrape.study.{name}`" in page, name


# How a program or a library that a test compares with is named in the table.
PEERS = {
    "calculix": "CalculiX",
    "ezdxf": "ezdxf",
    "meshio": "meshio",
    "mujoco": "MuJoCo",
    "pypdf": "pypdf",
    "rosbags": "rosbags",
    "scipy": "SciPy",
    "toppra": "TOPP-RA",
    "vtk": "VTK",
    "yaml": "PyYAML",
}
IMPORT = re.compile(r"""(?:^\s*(?:import|from) |(?:importorskip|import_module)\(")(\w+)""", re.M)


def test_every_program_that_tests_compare_with_is_in_the_table() -> None:
    """Of a new peer the table of the validation has a row."""
    files = [*(ROOT / "tests" / "python").glob("*.py"), *(ROOT / "benches" / "peers").glob("*.py")]
    named = {name for file in files for name in IMPORT.findall(file.read_text(encoding="utf-8"))}
    assert named & set(PEERS) > {"calculix", "scipy", "toppra"}
    for name in named & set(PEERS):
        assert PEERS[name] in VALIDATION, name


def test_the_validation_says_that_no_drape_was_measured() -> None:
    """As long as no row of the table is a measured drape; README says it too."""
    assert "**No measured drape is among them.**" in VALIDATION
    assert "**No measured drape is among the comparisons yet.**" in README
