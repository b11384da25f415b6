"""One scenario: values are put into the scene, it is draped, and a flat row is read off.

This is all that runs in a worker; it needs plydrape and NumPy only. Whatever goes wrong with one
scenario becomes the `error` of its row.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

import plydrape

from . import errors
from .keys import SCENE, Tables, Value, put
from .labels import BY_KEY, BY_NAME, is_least
from .vary import Input

Numbers = np.ndarray[Any, Any]

# What a row may hold; None is an empty field.
Line = dict[str, float | int | str | bool | None]
# Units of what a summary says beside its measures, by the end of its name.
UNITS = {"mm": "mm", "deg": "deg", "n": "N", "j": "J"}


@dataclass(frozen=True, eq=False)
class Motion:
    """Where grippers go: times (S,) in s, positions (S, G, 3) in m."""

    times: Numbers
    positions: Numbers

    @property
    def checksum(self) -> str:
        """The check sum of all its numbers."""
        parts = (np.ascontiguousarray(a, dtype="<f8") for a in (self.times, self.positions))
        return hashlib.sha256(b"".join(part.tobytes() for part in parts)).hexdigest()


@dataclass(frozen=True, eq=False)
class Task:
    """Everything that the rows depend on; see `Study` for its attributes."""

    tables: Tables
    base: str
    command: str
    inputs: tuple[Input, ...]
    motion: Motion | None
    terms: tuple[str, ...]
    seed: int
    version: str

    def row(self, scenario: int, values: Sequence[Value]) -> Line:
        """The row of one scenario."""
        row = self.begun(scenario, values)
        try:
            scene = self.nominal(values)
            # The errors are an input, on record also where the drape fails.
            if self.real(scene):
                row |= errors.columns(self.terms, scene.draw(scenario))
                scene = scene.with_errors(scenario)
            row |= self.measured(scene)
        except (KeyboardInterrupt, SystemExit):
            raise
        except BaseException as error:  # A panic of the extension is no Exception.
            row |= failed(type(error).__name__, message(error))
        return row

    def begun(self, scenario: int, values: Sequence[Value]) -> Line:
        """The part of a row that is known before anything runs."""
        row: Line = {"scenario": scenario, "seed": self.seed, "version": self.version}
        row |= {"error": None, "error_kind": None}
        return row | {x.key: value for x, value in zip(self.inputs, values, strict=True)}

    def scene(self, scenario: int, values: Sequence[Value]) -> plydrape.Scene:
        """The scene of one scenario.

        Raises
        ------
        SceneError
            It is refused.

        """
        scene = self.nominal(values)
        return scene.with_errors(scenario) if self.real(scene) else scene

    def real(self, scene: plydrape.Scene) -> bool:
        """Whether the scenario is draped in a real cell and not in the nominal one."""
        return self.command != "plan" and scene.errors is not None

    def nominal(self, values: Sequence[Value]) -> plydrape.Scene:
        """The scene with its varied numbers, along its own motion or the one that is followed."""
        tables = self.tables
        for x, value in zip(self.inputs, values, strict=True):
            tables = put(tables, x.key, x.written(value))
        scene = build(tables, self.base, self.mold)
        if self.motion is None:
            return scene
        return scene.with_motion(self.motion.times, self.motion.positions, slow=True)

    @cached_property
    def mold(self) -> plydrape.Mold | None:
        """The mold that all scenarios share, so that its file is read once; None if it varies."""
        if "mold" not in self.tables or any(x.key.startswith("mold.") for x in self.inputs):
            return None
        return build(self.tables, self.base).mold

    def measured(self, scene: plydrape.Scene) -> Line:
        """Drapes, or plans, and reads off the measures."""
        if self.command == "plan":
            plan = plydrape.plan(scene, without_errors=scene.errors is None)
            row: Line = {"evaluations": int(plan.evaluations), "duration": float(plan.duration)}
            return row | measures(plan.result)
        return measures(plydrape.simulate(scene))


def build(tables: Tables, base: str, mold: plydrape.Mold | None = None) -> plydrape.Scene:
    """The scene of its tables, on the mold if one is given.

    Raises
    ------
    SceneError
        It is refused.

    Examples
    --------
    >>> ply = {"grippers": [2, 1], "cell": [0.1, 0.1], "material": "krogh2018"}
    >>> tables = {"ply": ply, "grippers": {"height": "75 mm", "spacing": ["98 mm", "98 mm"]}}
    >>> tables |= {"motion": {"kind": "hold"}, "tool": {"residual": "2 mm"}}
    >>> build(tables, "").to_dict()["tool"]
    {'residual': '2 mm'}

    """
    known = {key: tables[key] for key in SCENE if key in tables}
    if mold is not None:
        known["mold"] = mold
    return plydrape.Scene(title=tables.get("title"), base=base, **known)


def measures(result: plydrape.Result) -> Line:
    """All numbers of a result's summary, and what became of each limit.

    `worst_…` and `final_…` are those of all steps and of the last, `stopped` says why a drape ended
    where no ply would have survived it. Of each limit there is `value_…`, `limit_…`, `ok_…`, and
    `margin_…`: what is left of the limit as a share of it, negative where it is exceeded, None
    where it is zero. Where the value is not finite, the limit is not kept and the drape not
    accepted. All of it is by the model that decides; `sheet.…` and `catenaries.…` are what that
    alone says beside its measures.
    """
    summary = result.summary
    sound = all(math.isfinite(limit["value"]) for limit in summary["limits"])
    row: Line = {
        "accepted": result.accepted and sound,
        "converged": result.converged,
        "first_contact_step": result.first_contact_step,
    }
    row |= plain(summary, "")
    for part in ("worst", "final"):
        measured = {key: value for key, value in summary[part].items() if value is not None}
        row |= {f"{part}_{key}": value for key, value in measured.items()}
    for limit in summary["limits"]:
        name, value, allowed = limit["name"], float(limit["value"]), float(limit["limit"])
        left = value - allowed if is_least(name) else allowed - value
        row[f"value_{name}"] = value
        row[f"limit_{name}"] = allowed
        row[f"ok_{name}"] = bool(limit["ok"]) and math.isfinite(value)
        row[f"margin_{name}"] = left / allowed if allowed else None
    for model in ("sheet", "catenaries"):
        row |= plain(summary.get(model, {}), f"{model}.")
    return row


def plain(values: dict[str, Any], model: str) -> Line:
    """The values of a summary that a row can hold and does not have already."""
    return {
        f"{model}{key}": value
        for key, value in values.items()
        if (isinstance(value, bool | int | float | str) or value is None)
        and key not in ("accepted", "first_contact_step")
    }


def unit(column: str, inputs: Iterable[Input]) -> str:
    """The unit of a column; empty where it has none.

    Examples
    --------
    >>> unit("worst_tilt_deg", ()), unit("limit_tilt", ()), unit("errors.pick_up.yaw", ())
    ('deg', '°', 'rad')

    """
    for x in inputs:
        if x.key == column:
            return x.unit
    part, _, rest = column.partition("_")
    if part in ("worst", "final") and rest in BY_KEY:
        return BY_KEY[rest].unit.removeprefix("1")
    if part in ("value", "limit") and rest in BY_NAME:
        return BY_NAME[rest].shown
    if part in ("ok", "margin"):
        return ""
    if column == "duration":
        return "s"
    return errors.unit(column) or UNITS.get(column.rpartition("_")[2], "")


def message(error: BaseException) -> str:
    """An error's text; that of a refused scene without its line, because no file has it."""
    if isinstance(error, plydrape.SceneError):
        return f"{error.message}; {error.help}" if error.help else error.message
    return str(error)


def failed(kind: str, text: str) -> Line:
    """The part of a row that says why there is no result."""
    return {"error": text or kind, "error_kind": kind}
