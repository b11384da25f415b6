"""What the tests of studies share: small studies of the paper's example."""

from __future__ import annotations

import json
import shutil
import tempfile
from pathlib import Path
from typing import Any

import plydrape
import pyarrow as pa
from plydrape.study import Study

ROOT = Path(__file__).resolve().parents[3]
HOME = tempfile.TemporaryDirectory(prefix="plydrape-studies-")


def by_catenaries(name: str) -> Path:
    """A copy of an example whose model is the catenaries: studies drape it many times."""
    folder = Path(HOME.name) / name
    shutil.copytree(ROOT / "examples" / name, folder)
    scene = folder / "scene.toml"
    text = scene.read_text(encoding="utf-8")
    if 'kind = "catenaries"' not in text:
        text = text.replace("[model]\n", '[model]\nkind = "catenaries"\n')
    scene.write_text(text, encoding="utf-8")
    return scene


PAPER = by_catenaries("01_flat_sheared_mold")
by_catenaries("02_hanging_strip")

# Three inputs, the last of them errors of all grippers: none of the rows is accepted, all differ.
VARIED: dict[str, dict[str, Any]] = {
    "ply.material.flexural_rigidity": {"relative": [0.8, 1.2]},
    "grippers.height": {"from": "60 mm", "to": "90 mm"},
    "errors.gripper.position.bound": {"values": ["1 mm"]},
}


def table(samples: int = 24, **more: Any) -> dict[str, Any]:
    """A study as a dict."""
    return {"scene": str(PAPER), "samples": samples, "seed": 1, "vary": VARIED} | more


def study(samples: int = 24, **more: Any) -> Study:
    """A study of the paper's example."""
    return Study.of(table(samples, **more))


def grid(**vary: Any) -> Study:
    """A grid over numbers of the paper's example; dots in keys are written as two underscores."""
    varied = {key.replace("__", "."): spec for key, spec in vary.items()}
    return Study.of({"scene": str(PAPER), "sampling": "grid", "vary": varied})


def write(folder: Path, samples: int, name: str = "study.toml", **more: Any) -> Path:
    """The same study as a file: TOML strings and tables are JSON's but for the colons."""
    lines = [f"{key} = {json.dumps(value)}" for key, value in table(samples, **more).items()]
    lines = [line for line in lines if not line.startswith("vary")]
    lines += ["[vary]"]
    for key, spec in (more.get("vary") or VARIED).items():
        inner = ", ".join(f"{k} = {json.dumps(v)}" for k, v in spec.items())
        lines.append(f'"{key}" = {{ {inner} }}')
    path = folder / name
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def rows(table: pa.Table) -> list[dict[str, Any]]:
    """The rows as dicts."""
    found: list[dict[str, Any]] = table.to_pylist()
    return found


def judged(result: plydrape.Result) -> dict[str, Any]:
    """What the row of a result must say, read off its summary here once more."""
    summary = result.summary
    wanted: dict[str, Any] = {
        key: summary[key] for key in ("accepted", "model", "status", "stopped", "steps")
    }
    report = summary["catenaries"]
    wanted["first_contact_step"] = report["first_contact_step"]
    wanted["catenaries.equilibria"] = report["equilibria"]
    wanted["converged"] = result.converged
    for part in ("worst", "final"):
        measured = {key: value for key, value in summary[part].items() if value is not None}
        wanted |= {f"{part}_{key}": value for key, value in measured.items()}
    for limit in summary["limits"]:
        name = limit["name"]
        wanted |= {f"value_{name}": limit["value"], f"limit_{name}": limit["limit"]}
        wanted[f"ok_{name}"] = limit["ok"]
    return wanted
