"""Results as tables of pandas and data sets of xarray, asked for only when used."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import plydrape
from plydrape import _shapes
from plydrape._extra import load

if TYPE_CHECKING:
    import pandas
    import xarray

    from plydrape import Drape, Ply, Result, Sheet

TABLES = ("measures", "grippers", "catenaries", "limits")
MEASURES = {measure.key: measure for measure in plydrape.measures()}


def result_frame(result: Result, table: str) -> pandas.DataFrame:
    """See `Result.to_pandas`."""
    if table not in TABLES:
        known = '", "'.join(TABLES)
        raise ValueError(f'there is no table "{table}"; choose "{known}"')
    pd = load("pandas", package="pandas", name="pandas")
    columns = {
        "measures": _measures,
        "grippers": _grippers,
        "catenaries": _catenaries,
        "limits": _limits,
    }
    frame: pandas.DataFrame = pd.DataFrame(columns[table](result))
    return frame


def _steps(result: Result | Drape, each: int = 1) -> dict[str, Any]:
    """Number and time of each step, for so many rows a step."""
    steps = np.arange(1, len(result.times) + 1)
    return {"step": np.repeat(steps, each), "time": np.repeat(result.times, each)}


def _measures(result: Result) -> dict[str, Any]:
    return {**_steps(result), **result.measures}


def _grippers(result: Result) -> dict[str, Any]:
    ids, steps = result.ply.ids, len(result.times)
    columns = {
        **_steps(result, len(ids)),
        "gripper": names(result.ply) * steps,
        "i": np.tile(ids[:, 0], steps),
        "j": np.tile(ids[:, 1], steps),
    }
    columns |= zip("xyz", result.positions.reshape(-1, 3).T, strict=True)
    columns |= zip(("qx", "qy", "qz", "qw"), result.quaternions.reshape(-1, 4).T, strict=True)
    columns["tilt_deg"] = result.tilts_deg.ravel()
    columns |= zip(("load_x", "load_y", "load_z"), result.loads.reshape(-1, 3).T, strict=True)
    return columns


def _catenaries(result: Result) -> dict[str, Any]:
    ends, steps = result.ply.catenaries, len(result.forces)
    known = np.array(names(result.ply), dtype=object)
    drape = _shapes.hanging(result)
    assert drape is not None
    return {
        **_steps(drape, len(ends)),
        "catenary": np.tile(np.arange(len(ends)), steps),
        "from": np.tile(known[ends[:, 0]], steps),
        "to": np.tile(known[ends[:, 1]], steps),
        "force": result.forces.ravel(),
        "slack_mm": result.slack_mm.ravel(),
        "contact": result.contact.ravel(),
    }


def _limits(result: Result) -> dict[str, Any]:
    limits = list(result.limits.values())
    fields = ("name", "label", "value", "limit", "unit", "sense", "kept", "step", "where")
    columns: dict[str, Any] = {field: [getattr(one, field) for one in limits] for field in fields}
    nowhere = (np.nan,) * 3
    places = np.array([one.place or nowhere for one in limits], float).reshape(-1, 3)
    return columns | dict(zip("xyz", places.T, strict=True))


def names(ply: Ply) -> list[str]:
    """The names of grippers in files: g2_0."""
    return [f"g{i}_{j}" for i, j in ply.ids]


def result_dataset(result: Result) -> xarray.Dataset:
    """See `Result.to_xarray`."""
    xr = load("xarray", package="xarray", name="xarray")
    ply, steps = result.ply, len(result.times)
    nu, nv = result.grid
    whole = nu * nv == len(ply.ids)
    at = ["u", "v"] if whole else ["gripper"]

    def grippers(values: Any, *axes: str) -> tuple[list[str], Any]:
        """Numbers of grippers: i runs fastest in the arrays, and u is the first axis here."""
        values = np.asarray(values)
        if whole:
            values = values.reshape(steps, nv, nu, *values.shape[2:]).swapaxes(1, 2)
        return ["step", *at, *axes], values

    variables = {
        "positions": (*grippers(result.positions, "xyz"), _said("m", "position of the grippers")),
        "quaternions": (
            *grippers(result.quaternions, "xyzw"),
            _said("1", "orientation of the grippers: z along the normal of the ply, x along u"),
        ),
        "tilts_deg": (
            *grippers(result.tilts_deg),
            _said("degree", "angle between the normal of the ply and the stem of the gripper"),
        ),
        "loads": (*grippers(result.loads, "xyz"), _said("N", "force of the ply on the grippers")),
    }
    if _shapes.hanging(result) is not None:
        variables |= _of_catenaries(result)
    for key, values in result.measures.items():
        measure = MEASURES[key]
        unit = "degree" if measure.unit == "deg" else measure.unit or "1"
        said = _said(unit, f"{measure.label}, worst of the step")
        variables[f"worst_{key}"] = (["step"], values, said)
    coordinates: dict[str, Any] = {
        "step": np.arange(1, steps + 1),
        "time": (["step"], result.times, _said("s", "time")),
        "xyz": list("xyz"),
        "xyzw": list("xyzw"),
    }
    if whole:
        u, v = ply.places.reshape(nv, nu, 2).transpose(2, 1, 0)
        coordinates["u"] = (["u"], u[:, 0], _said("m", "fabric coordinate of the grippers along u"))
        coordinates["v"] = (["v"], v[0], _said("m", "fabric coordinate of the grippers along v"))
    else:
        coordinates["gripper"] = names(ply)
    if _shapes.hanging(result) is not None:
        ends = np.array(names(ply), dtype=str)[ply.catenaries]
        coordinates["from"] = (["catenary"], ends[:, 0])
        coordinates["to"] = (["catenary"], ends[:, 1])
    attributes = {"title": result.title, "program": result.program, "model": result.model}
    made: xarray.Dataset = xr.Dataset(
        variables, coordinates, {**attributes, "accepted": int(result.accepted)}
    )
    return made


def _of_catenaries(result: Result) -> dict[str, Any]:
    """What catenaries alone have; of a drape that ended before that which decides, nan follows."""
    steps = len(result.times)

    def filled(values: Any) -> Any:
        values = np.asarray(values, float)[:steps]
        rest = np.full((steps - len(values), *values.shape[1:]), np.nan)
        return np.concatenate([values, rest])

    shear = filled(result.shear_deg)
    cells = ["cell_u", "cell_v"] if shear.ndim == 3 else ["cell"]
    lines = ["step", "catenary"]
    return {
        "forces": (lines, filled(result.forces), _said("N", "horizontal force of the catenary")),
        "slack_mm": (lines, filled(result.slack_mm), _said("mm", "slack of the catenary")),
        "contact": (lines, filled(result.contact), _said("m", "length in contact with the mold")),
        "shear_deg": (
            ["step", *cells],
            shear.swapaxes(1, 2) if shear.ndim == 3 else shear,
            _said("degree", "shear angle of the cell"),
        ),
    }


def sheet_dataset(sheet: Sheet) -> xarray.Dataset:
    """See `Sheet.to_xarray`."""
    xr = load("xarray", package="xarray", name="xarray")
    node, pad = ["state", "node"], ["state", "gripper"]
    variables = {
        "positions": ([*node, "xyz"], sheet.positions, _said("m", "position of the nodes")),
        "heights": (node, sheet.heights, _said("m", "height over the mold")),
        "contact": (node, sheet.contact, _said("1", "whether the node touches the mold")),
        "landing_step": (["node"], sheet.landing_step, _said("1", "step of landing, 0 of none")),
        "areas": (["node"], sheet.areas, _said("m2", "fabric area of the node")),
        "shear": (["state", "cell"], sheet.shear, _said("rad", "shear angle of the cell")),
        "tension": (["state", "segment"], sheet.tension, _said("N/m", "tension per width")),
        "grippers": ([*pad, "xyz"], sheet.grippers, _said("m", "position of the pads")),
        "pad_forces": ([*pad, "xyz"], sheet.pad_forces, _said("N", "force of the ply on the pad")),
        "pad_quaternions": (
            [*pad, "xyzw"],
            sheet.pad_quaternions,
            _said("1", "orientation of the pads: z along the normal, x along u"),
        ),
        "pad_holds": (pad, sheet.pad_holds, _said("1", "whether the pad holds the ply")),
        "cells": (["cell", "corner"], sheet.cells, _said("1", "nodes around the cell")),
        "segments": (["segment", "end"], sheet.segments, _said("1", "nodes at the ends")),
    }
    u, v = sheet.places.T
    coordinates = {
        "step": (["state"], sheet.steps, _said("1", "step of the motion, from 1")),
        "time": (["state"], sheet.times, _said("s", "time")),
        "u": (["node"], u, _said("m", "fabric coordinate along u")),
        "v": (["node"], v, _said("m", "fabric coordinate along v")),
        "xyz": list("xyz"),
        "xyzw": list("xyzw"),
    }
    made: xarray.Dataset = xr.Dataset(variables, coordinates)
    return made


def _said(unit: str, what: str) -> dict[str, str]:
    return {"units": unit, "long_name": what}
