"""Where a study's scene comes from, and the files that it depends on."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

import plydrape
from plydrape.errors import of_file

from .error import StudyError, toml
from .keys import SCENE, Tables, nearest
from .labels import shown
from .vary import Input

SCENE_KEY = 'name one: scene = "scene.toml"'


def document(path: Path, kind: str) -> dict[str, Any]:
    """A TOML file as tables.

    Raises
    ------
    StudyError
        It is absent, or no TOML; the message has line and column.

    """
    reader = toml()
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError as error:
        fault = StudyError(f"there is no {kind} `{path}`", help="check its name and folder")
        raise of_file(fault, "FileNotFoundError", path) from error
    except (OSError, UnicodeDecodeError) as error:
        raise StudyError(
            f"the {kind} `{path}` cannot be read: {error}",
            help="name a TOML file in UTF-8 that you may read",
        ) from error
    try:
        return dict(reader.loads(text))
    except reader.TOMLDecodeError as error:
        raise StudyError(
            f"the {kind} `{path}` is no TOML: {error}",
            help="write `key = value` under a `[table]`, each key once, text in double quotes",
        ) from error
    except ValueError as error:  # Python converts no digits beyond a few thousands.
        raise StudyError(
            f"the {kind} `{path}` has a whole number of too many digits",
            help="write a number that a scene can have",
        ) from error
    except RecursionError as error:
        raise StudyError(
            f"the {kind} `{path}` is nested too deep",
            help="look for brackets that are not closed",
        ) from error


def scene(choice: object, base: Path) -> tuple[dict[str, Any], Path]:
    """The tables of the scene, and the folder that its paths are relative to.

    Raises
    ------
    StudyError
        There is no scene, or no way to vary it.
    SceneError
        The scene file is refused.

    """
    if isinstance(choice, Mapping):
        tables, home = dict(native(choice)), base
        for key in tables:
            if key not in (*SCENE, "title"):
                raise StudyError(
                    f"`{key}` is no table of a scene",
                    help=f"they are {', '.join(SCENE)}{nearest(key, SCENE)}",
                    key="scene",
                )
        return tables, home
    if isinstance(choice, plydrape.Scene):
        if choice.text is None:
            raise StudyError(
                "this scene has no text whose numbers could vary",
                help="give its file, or its tables as a dict",
                key="scene",
            )
        try:
            tables = choice.to_dict()
        except ValueError as error:
            raise StudyError(
                f"the scene cannot vary: {error}",
                help="give its file, or its tables as a dict",
                key="scene",
            ) from error
        return tables, Path(tables.pop("base", base))
    if isinstance(choice, str | os.PathLike):
        path = base / choice
        if not os.path.isfile(path):  # also where a name is too long for the system
            raise StudyError(
                f"`scene` = {shown(str(choice))}: there is no such file",
                help=f"the path is relative to {base.resolve()}",
                key="scene",
            )
        # Read by plydrape first: its messages point at the line.
        plydrape.Scene.read(str(path))
        return document(path, "scene"), path.parent
    what = "is missing" if choice is None else f"= {shown(choice)} is no scene"
    raise StudyError(f"`scene` {what}", help=SCENE_KEY, key="scene")


def native(value: Any) -> Any:
    """Plain Python values, for a scene given with NumPy's."""
    if isinstance(value, Mapping):
        return {str(key): native(inner) for key, inner in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, list | tuple):
        return [native(inner) for inner in value]
    return value


def expanded(tables: Tables, home: Path, varied: Mapping[str, Any]) -> dict[str, Any]:
    """The scene with its material in place of the material's name, if a number of it varies.

    Raises
    ------
    StudyError
        The material is neither shipped nor a file that can be read.

    """
    name = tables.get("ply", {}).get("material")
    if not isinstance(name, str) or not any(key.startswith("ply.material.") for key in varied):
        return dict(tables)
    if name in plydrape.materials():
        material = toml().loads(plydrape.Material.text(name))
    else:
        material = document(home / name, "material")
    return {**tables, "ply": {**tables["ply"], "material": material}}


def files(tables: Tables, home: Path, inputs: Iterable[Input]) -> dict[str, str]:
    """Check sums of the files that a scene names: every text that is the path of one."""
    texts = set(_texts([tables, *(list(x.numbers) for x in inputs)]))
    return {name: _checksum(home / name) for name in sorted(texts) if os.path.isfile(home / name)}


def _texts(value: Any) -> Iterator[str]:
    """All texts among values, in whatever tables and lists they are."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping | list):
        for inner in value.values() if isinstance(value, Mapping) else value:
            yield from _texts(inner)


def _checksum(path: Path) -> str:
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return "absent"
