"""Result files by objects: the columns of result.json put together again.

They are described in docs/guide/result_file.md.

Written from that page alone, so that a reader in another language finds there what it needs.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

Entry = dict[str, Any]


def read(path: Path) -> Entry:
    """The whole file; its steps as `steps` makes them, those of the other model too."""
    content: Entry = json.loads(path.read_text())
    parts = [content, content["also"]] if "also" in content else [content]
    for part in parts:
        part["steps"] = steps(part["steps"], content)
    return content


def rows(columns: Entry, keys: list[str] | None = None) -> list[Entry]:
    """Columns of equal length as a list of objects."""
    keys = list(columns) if keys is None else keys
    values = zip(*(columns[key] for key in keys), strict=True)
    return [dict(zip(keys, row, strict=True)) for row in values]


def steps(of_model: list[Entry], content: Entry) -> list[Entry]:
    """Every step by a model with its grippers; of catenaries with lists of these and of cells."""
    grid = content["scene"]["ply"]["grid"]
    lines = rows(content.get("catenaries", {}))
    contacts: list[Entry | None] = [None] * len(lines)
    out = []
    for columns in of_model:
        step = {key: columns[key] for key in ("step", "time", "measures")}
        step["grippers"] = grippers(columns["grippers"], grid["nu"])
        if "solver" in columns:
            step["solver"] = columns["solver"]
            step["slopes"] = rows(columns["slopes"])
            step["cells"] = [
                {"cell": [n % (grid["nu"] - 1), n // (grid["nu"] - 1)], **cell}
                for n, cell in enumerate(rows(columns["cells"]))
            ]
            step["catenaries"] = catenaries(lines, columns, contacts)
        out.append(step)
    return out


def grippers(columns: Entry, nu: int) -> list[Entry]:
    """The grippers of a step, with what a file leaves out where it says nothing."""
    count = len(columns["position"])
    usual = {
        "commanded": columns["position"],
        "slide_mm": [0.0] * count,
        "holds": [True] * count,
        "target_distance_mm": [None] * count,
    }
    whole = rows({**usual, **columns})
    return [{"id": [n % nu, n // nu], **gripper} for n, gripper in enumerate(whole)]


def catenaries(lines: list[Entry], columns: Entry, contacts: list[Entry | None]) -> list[Entry]:
    """The catenaries of a step; `contacts` are those of the step before, and become this one's."""
    own = columns["catenaries"]
    out = [
        {**line, "length": length, "shearing": False, "spans": [], "bridging": None}
        for line, length in zip(lines, own["length"], strict=True)
    ]
    for n, force in zip(own["shearing"], own["shear_force_N"], strict=True):
        out[n] |= {"shearing": True, "shear_force_N": force}
    for span in rows(columns["spans"]):
        out[span.pop("catenary")]["spans"].append(span)
    for bridge in rows(columns["bridging"]):
        out[bridge.pop("catenary")]["bridging"] = bridge
    for new in rows(columns["contact"]):
        n, before = new["catenary"], new["before"]
        old = contacts[n] if new["grown"] else None
        contact = {}
        for key in ("points", "arc", "landing_error_mm"):
            values, kept = new[key], [] if old is None else old[key]
            contact[key] = None if values is None else values[:before] + kept + values[before:]
        contact["fiber_angle_deg"] = new["fiber_angle_deg"]
        contacts[n] = contact if contact["arc"] else None
    for line, held in zip(out, contacts, strict=True):
        line["contact"] = held
    return out


def slack_mm(span: Entry, whole: float) -> float:
    """Fabric of a span beyond its path (mm), none within rounding of the `whole` catenary's."""
    excess = float(span["length"] - span["path"])
    return 0.0 if excess <= 1e-12 * whole else 1e3 * excess


def overstretch_mm(span: Entry, whole: float) -> float:
    """Way of a span beyond its fabric (mm)."""
    return slack_mm({"length": span["path"], "path": span["length"]}, whole)
