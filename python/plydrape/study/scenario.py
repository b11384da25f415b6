"""One scenario: values are put into the scene, it is draped, and a flat row is read off.

This is all that runs in a worker; it needs plydrape and NumPy only. Whatever goes wrong with one
scenario becomes the `error` of its row.
"""

from __future__ import annotations

import hashlib
import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

import plydrape

from . import errors as cell
from .error import StudyError
from .keys import SCENE, Tables, Value, put
from .labels import BY_KEY, is_least
from .law import Input
from .placement import Placement

Numbers = np.ndarray[Any, Any]

# What a row may hold; None is an empty field.
Cell = float | int | str | bool | None
Line = dict[str, Cell]


# Units of what a summary says beside its measures, by the end of its name.
UNITS = {"mm": "mm", "deg": "deg", "n": "N", "j": "J"}


@dataclass(frozen=True, eq=False)
class Motion:
    """Where grippers go: times (S,) in s, positions (S, G, 3) in m."""

    times: Numbers
    positions: Numbers

    @property
    def checksum(self) -> str:
        """Of all its numbers."""
        parts = (np.ascontiguousarray(a, dtype="<f8") for a in (self.times, self.positions))
        return hashlib.sha256(b"".join(part.tobytes() for part in parts)).hexdigest()


@dataclass
class Batch:
    """Rows of neighboring scenarios.

    Attributes
    ----------
    first
        Index of the first.
    rows
        One for each.
    units
        Of those columns that have one.
    seconds
        Time that the rows took.

    """

    first: int
    rows: list[Line]
    units: dict[str, str] = field(default_factory=dict)
    seconds: float = 0.0


@dataclass(frozen=True, eq=False)
class Task:
    """Everything that the rows depend on; see `Study` for its attributes."""

    tables: Tables
    base: str
    command: str
    inputs: tuple[Input, ...]
    placement: Placement | None
    motion: Motion | None
    terms: tuple[str, ...]
    seed: int
    version: str

    def batch(self, first: int, values: Sequence[Sequence[Value]]) -> Batch:
        """The rows of the scenarios `first`, `first + 1`, …, given their inputs.

        Raises
        ------
        StudyError
            This process has another version of plydrape than the study's.

        """
        if plydrape.__version__ != self.version:
            raise StudyError(
                f"a worker has plydrape {plydrape.__version__}, the study {self.version}",
                help="install the same version everywhere",
            )
        start = time.perf_counter()
        batch = Batch(first, [])
        for scenario, row in enumerate(values, start=first):
            batch.rows.append(self.row(scenario, row, batch.units))
        batch.seconds = time.perf_counter() - start
        return batch

    def row(self, scenario: int, values: Sequence[Value], units: dict[str, str]) -> Line:
        """The row of one scenario; units of its columns are added to `units`."""
        row = self.begun(scenario, values)
        units.update({x.key: x.unit for x in self.inputs if x.unit})
        try:
            scene = self.with_values(values)
            # The placement errors are an input, on record also where the drape fails.
            errors = self.errors(scenario, scene)
            if self.placement is not None and errors is not None:
                row.update(self.placement.columns(errors))
                units.update(
                    dict.fromkeys(self.placement.columns(errors), self.placement.unit or "m")
                )
            moved = self.moved(scene, errors)
            if self.real(moved):
                row.update(cell.columns(self.terms, moved.draw(scenario)))
                units.update(cell.units(self.terms))
                moved = moved.with_errors(scenario)
            row.update(self.measured(moved, units))
        except (KeyboardInterrupt, SystemExit):
            raise
        except BaseException as error:  # A panic of the extension is no Exception.
            row.update(failed(type(error).__name__, message(error)))
        return row

    def begun(self, scenario: int, values: Sequence[Value]) -> Line:
        """The part of a row that is known before anything runs."""
        inputs = {x.key: value for x, value in zip(self.inputs, values, strict=True)}
        return {
            "scenario": scenario,
            "seed": self.seed,
            "version": self.version,
            "error": None,
            "error_kind": None,
            **inputs,
        }

    def scene(self, scenario: int, values: Sequence[Value]) -> plydrape.Scene:
        """The scene of one scenario.

        Raises
        ------
        SceneError
            It is refused.

        """
        scene = self.with_values(values)
        moved = self.moved(scene, self.errors(scenario, scene))
        return moved.with_errors(scenario) if self.real(moved) else moved

    def real(self, scene: plydrape.Scene) -> bool:
        """Whether the scenario is draped in a real cell and not in the nominal one."""
        return self.command != "plan" and scene.errors is not None

    def with_values(self, values: Sequence[Value]) -> plydrape.Scene:
        """The scene with its varied numbers, along its own motion."""
        tables = self.tables
        for x, value in zip(self.inputs, values, strict=True):
            tables = put(tables, x.key, x.written(value))
        return build(tables, self.base, self.mold)

    @cached_property
    def mold(self) -> plydrape.Mold | None:
        """The mold that all scenarios share, so that its file is read once; None if it varies."""
        if "mold" not in self.tables or any(x.key.startswith("mold.") for x in self.inputs):
            return None
        return build(self.tables, self.base).mold

    def errors(self, scenario: int, scene: plydrape.Scene) -> Numbers | None:
        """The placement errors, shape (G, 3), in m; None where grippers do not err."""
        if self.placement is None:
            return None
        positions = scene.positions if self.motion is None else self.motion.positions
        return self.placement.errors(self.seed, scenario, np.shape(positions)[1])

    def moved(self, scene: plydrape.Scene, errors: Numbers | None) -> plydrape.Scene:
        """The scene along the motion that is followed, off by the errors."""
        if self.motion is None and errors is None:
            return scene
        motion = self.motion or Motion(np.asarray(scene.times), np.asarray(scene.positions))
        off = motion.positions if errors is None else motion.positions + errors
        return scene.with_motion(motion.times, off)

    def measured(self, scene: plydrape.Scene, units: dict[str, str]) -> Line:
        """Drapes, or plans, and reads off the measures."""
        if self.command == "plan":
            plan = plydrape.plan(scene, without_errors=scene.errors is None)
            row = {"evaluations": int(plan.evaluations), "duration": float(plan.duration)}
            units["duration"] = "s"
            return row | measures(plan.result, units)
        return measures(plydrape.simulate(scene), units)


def build(tables: Tables, base: str, mold: plydrape.Mold | None = None) -> plydrape.Scene:
    """The scene of its tables, on the mold if one is given.

    Raises
    ------
    SceneError
        It is refused.

    """
    known = {key: tables[key] for key in SCENE if key in tables}
    if mold is not None:
        known["mold"] = mold
    return plydrape.Scene(title=tables.get("title"), base=base, **known)


def measures(result: plydrape.Result, units: dict[str, str]) -> Line:
    """All numbers of a result's summary, and what became of each limit.

    `worst_…` and `final_…` are those of all steps and of the last, `stopped` says why a drape ended
    where no ply would have survived it. Of each limit there is
    `value_…`, `limit_…` (both in the unit added to `units`), `ok_…`, and `margin_…`: what is
    left of the limit as a share of it, negative where it is exceeded, None where it is zero. Where
    the value is not finite, the limit is not kept and the drape not accepted. All of it is by the
    model that decides; `sheet.…` and `catenaries.…` are what that alone says beside its measures.
    """
    summary = result.summary
    limits = summary["limits"]
    sound = {limit["name"]: math.isfinite(limit["value"]) for limit in limits}
    row: Line = {
        "accepted": result.accepted and all(sound.values()),
        "converged": result.converged,
        "first_contact_step": result.first_contact_step,
    }
    row |= plain(summary, "", units)
    for part in ("worst", "final"):
        for key, value in summary[part].items():
            if value is None:
                continue
            row[f"{part}_{key}"] = value
            if BY_KEY[key].unit not in ("", "1"):
                units[f"{part}_{key}"] = BY_KEY[key].unit
    row |= judged(limits, units)
    for model in ("sheet", "catenaries"):
        row |= plain(summary.get(model, {}), f"{model}.", units)
    return row


def plain(values: dict[str, Any], model: str, units: dict[str, str]) -> Line:
    """Those of a summary's values that a row can hold and does not have already."""
    row: Line = {}
    for key, value in values.items():
        held = isinstance(value, bool | int | float | str) or value is None
        if held and key not in ("accepted", "first_contact_step"):
            row[f"{model}{key}"] = value
            if unit := UNITS.get(key.rpartition("_")[2]):
                units[f"{model}{key}"] = unit
    return row


def judged(limits: list[dict[str, Any]], units: dict[str, str]) -> Line:
    """What became of each limit."""
    row: Line = {}
    for limit in limits:
        name, value, allowed = limit["name"], float(limit["value"]), float(limit["limit"])
        left = value - allowed if is_least(name) else allowed - value
        row[f"value_{name}"] = value
        row[f"limit_{name}"] = allowed
        row[f"ok_{name}"] = bool(limit["ok"]) and math.isfinite(value)
        row[f"margin_{name}"] = left / allowed if allowed else None
        units[f"value_{name}"] = units[f"limit_{name}"] = str(limit["unit"])
    return row


def message(error: BaseException) -> str:
    """An error's text; a refused scene without its line, which is none of a file's."""
    if isinstance(error, plydrape.SceneError):
        return f"{error.message}; {error.help}" if error.help else error.message
    return str(error)


def failed(kind: str, text: str) -> Line:
    """The part of a row that says why there is no result."""
    return {"error": text or kind, "error_kind": kind}
