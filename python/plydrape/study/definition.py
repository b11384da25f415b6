"""A study as it is written, checked: which scene, which numbers vary and how, and what is run.

Everything is refused before anything runs, with file, key, value and remedy. The check ends with
the scene's own: it must be sound, and each varied key must be one that it takes.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import plydrape

from . import errors, sample, source
from .error import StudyError, require
from .keys import Value, nearest, put
from .labels import shown
from .scenario import Motion, Task, build, message
from .vary import LARGEST, Input, inputs

if TYPE_CHECKING:
    from .workers import Row

COMMANDS = ("simulate", "plan", "follow")
SAMPLINGS = ("latin-hypercube", "sobol", "grid")
KEYS = ("title", "scene", "command", "plan", "sampling", "samples", "max_scenarios", "seed", "vary")
VARY = 'as in [vary] "grippers.height" = { from = "60 mm", to = "90 mm" }'
# Scenarios of a study that does not say how many it may have: a slip of the pen is likelier.
MOST = 1_000_000
# Bytes of memory that a row takes at the end, when all rows become one table and its summary.
ROW = 3000
# Points that SciPy's Sobol sequence has, and inputs that it can vary.
SOBOL_POINTS, SOBOL_INPUTS = 2**30, 21201


@dataclass(frozen=True)
class Study:
    """Many scenes made of one.

    Attributes
    ----------
    title
        That of the scene unless given.
    tables
        The scene as plain dicts and lists, its material expanded where that is varied.
    base
        Folder that the scene's paths are relative to.
    command
        "simulate", "plan" or "follow".
    sampling
        "latin-hypercube", "sobol" or "grid".
    samples
        Number of scenarios; of a grid it follows from its numbers.
    seed
        Of the sample.
    inputs
        What varies.
    motion
        Of "follow": times (S,) in s and positions (S, G, 3) in m.
    files
        Check sums of the files that the scene names.
    file
        The study file, or None.

    Examples
    --------
    >>> study = Study.of(
    ...     {
    ...         "scene": {
    ...             "ply": {"grippers": [2, 1], "cell": [0.1, 0.1], "material": "krogh2018"},
    ...             "grippers": {"spacing": ["98 mm", "98 mm"], "height": "75 mm"},
    ...             "motion": {"kind": "hold"},
    ...         },
    ...         "samples": 8,
    ...         "vary": {"ply.material.flexural_rigidity": {"relative": [0.8, 1.2]}},
    ...     }
    ... )
    >>> len(study), study.names
    (8, ['ply.material.flexural_rigidity'])

    """

    title: str
    tables: dict[str, Any]
    base: str
    command: str
    sampling: str
    samples: int
    seed: int
    inputs: tuple[Input, ...]
    motion: Motion | None = None
    files: Mapping[str, str] = field(default_factory=dict)
    file: Path | None = None

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Study:
        """Reads a study file; its paths are relative to it.

        Parameters
        ----------
        path : str or path
            The study file.

        Returns
        -------
        Study
            The study.

        Raises
        ------
        StudyError
            The file cannot be read or says what cannot be.
        SceneError
            The scene is refused.

        Examples
        --------
        >>> study = plydrape.study.Study.read("examples/study/study.toml")
        >>> study.names
        ['grippers.stiffness.lateral']

        """
        path = Path(path)
        table = source.document(path, "study")
        return _study(table, path.parent, path)

    @classmethod
    def of(cls, table: Mapping[str, Any], base: str | os.PathLike[str] = ".") -> Study:
        """A study of a dict with the keys of a study file.

        `scene` may be a path, the tables of a scene as a dict, or a `plydrape.Scene` with text.

        Parameters
        ----------
        table : mapping
            A dict with the keys of a study file.
        base : str or path, default "."
            Folder of the files that it names.

        Returns
        -------
        Study
            The study.

        Raises
        ------
        As `read`.

        Examples
        --------
        >>> scene = "examples/02_hanging_strip/scene.toml"
        >>> vary = {"ply.material.mass": {"values": [0.3, 0.32]}}
        >>> len(plydrape.study.Study.of({"scene": scene, "sampling": "grid", "vary": vary}))
        2

        """
        return _study(table, Path(base), None)

    def __len__(self) -> int:
        """Number of scenarios."""
        return self.samples

    @property
    def names(self) -> list[str]:
        """Names of the columns of inputs: the varied keys, and those of errors."""
        return [x.key for x in self.inputs] + errors.names(self.terms)

    @property
    def terms(self) -> tuple[str, ...]:
        """Terms of the scene's [errors] that scenarios have; plans are of no one cell."""
        if self.command == "plan":
            return ()
        return errors.terms(self.tables, (x.key for x in self.inputs))

    @cached_property
    def values(self) -> list[Row]:
        """The inputs of each scenario: a tuple of numbers in the inputs' units."""
        return sample.values(self)

    @cached_property
    def task(self) -> Task:
        """What a worker needs to know to run any of the scenarios."""
        return Task(
            tables=self.tables,
            base=self.base,
            command=self.command,
            inputs=self.inputs,
            motion=self.motion,
            terms=self.terms,
            seed=self.seed,
            version=plydrape.__version__,
        )

    def scene(self, scenario: int) -> plydrape.Scene:
        """The scene of one scenario, to look at it on its own: `plydrape.simulate(it)`.

        Parameters
        ----------
        scenario : int
            Number of the scenario, from 0.

        Returns
        -------
        plydrape.Scene
            Its scene.

        Raises
        ------
        SceneError
            The scene is refused, as it was in the study.
        IndexError
            There is no such scenario.

        Examples
        --------
        >>> study = plydrape.study.Study.read("examples/study/study.toml")
        >>> study.scene(0).ply.grippers
        (3, 3)

        """
        return self.task.scene(range(len(self))[scenario], self.values[scenario])

    @cached_property
    def checksum(self) -> str:
        """The check sum of everything that the rows depend on, but for the version of plydrape."""
        text = json.dumps([self.described(), self.values], sort_keys=True)
        return "sha256:" + hashlib.sha256(text.encode()).hexdigest()

    def described(self) -> dict[str, Any]:
        """The definition as plain JSON values: strict JSON, infinite numbers as text.

        Returns
        -------
        dict
            The study as plain values.

        Examples
        --------
        >>> study = plydrape.study.Study.read("examples/study/study.toml")
        >>> study.described()["seed"]
        1

        """
        about = {
            "title": self.title,
            "command": self.command,
            "sampling": self.sampling,
            "scenarios": len(self),
            "seed": self.seed,
            "inputs": [vars(x) for x in self.inputs],
            "motion": self.motion.checksum if self.motion else None,
            "scene": self.tables,
            "files": dict(self.files),
        }
        plain = json.loads(json.dumps(about, default=str), parse_constant=str)
        return dict(plain)


def _study(table: Mapping[str, Any], base: Path, file: Path | None) -> Study:
    """Checks a table; every error gets the name of the file."""
    try:
        return _checked(table, base, file)
    except StudyError as error:
        if error.file is None and file is not None:
            raise StudyError(
                error.message, help=error.help, file=str(file), key=error.key
            ) from error
        raise


def _checked(table: Mapping[str, Any], base: Path, file: Path | None) -> Study:
    require("scipy")
    # The keys themselves.
    for key in table:
        if key not in KEYS:
            raise StudyError(
                f"`{key}` is no key of a study",
                help=f"its keys are {', '.join(KEYS)}{nearest(key, KEYS)}",
                key=key,
            )
    command = _one_of(table, "command", COMMANDS)
    sampling = _one_of(table, "sampling", SAMPLINGS)
    seed = _whole(table, "seed", 0, least=0)
    title = table.get("title")
    if title is not None and not isinstance(title, str):
        raise StudyError(
            f"`title` = {shown(title)} is no text", help="put it in quotes", key="title"
        )

    # The scene, sound as it is.
    tables, home = source.scene(table.get("scene"), base)
    varied = table.get("vary", {})
    if not isinstance(varied, Mapping):
        raise StudyError(f"`vary` = {shown(varied)} is no table", help=VARY, key="vary")
    tables = source.expanded(tables, home, varied)
    motion = _motion(table, command, base)

    # What varies.
    if "cell" in tables:
        tables = dict(errors.with_cell(tables, build(tables, str(home.resolve())).errors))
    laws = inputs(varied, tables, command, sampling)
    real = command != "plan" and "errors" in tables
    if real and sampling == "grid":
        raise StudyError(
            "the scene's `errors` have no grid: they are drawn",
            help='use sampling = "latin-hypercube", or leave [errors] out of the scene',
            key="sampling",
        )
    if not laws and not real:
        raise StudyError("`vary` names nothing that varies", help=VARY, key="vary")
    study = Study(
        title=title or str(tables.get("title", "")) or (file.stem if file else "Study"),
        tables=tables,
        base=str(home.resolve()),
        command=command,
        sampling=sampling,
        samples=_scenarios(table, sampling, laws),
        seed=seed,
        inputs=laws,
        motion=motion,
        files=source.files(tables, home, laws),
        file=file,
    )
    _probe(study)
    return study


def _one_of(table: Mapping[str, Any], key: str, known: tuple[str, ...]) -> str:
    """A name out of several, of which the first is the default."""
    value = table.get(key, known[0])
    if value not in known:
        quoted = [f'"{name}"' for name in known]
        raise StudyError(
            f"`{key}` = {shown(value)} is not known",
            help=f"it is one of {', '.join(quoted)}{nearest(str(value), known)}",
            key=key,
        )
    return str(value)


def _whole(table: Mapping[str, Any], key: str, usual: int | None, least: int) -> int:
    """A whole number; `usual` is None where it has to be given."""
    value = table.get(key, usual)
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= LARGEST:
        raise StudyError(
            f"`{key}` is missing" if value is None else f"`{key}` = {shown(value)} does not count",
            help=f"write a whole number of {least} or more, as in {key} = {max(least, 256)}; "
            f"the largest is {LARGEST}",
            key=key,
        )
    return value


def _scenarios(table: Mapping[str, Any], sampling: str, laws: tuple[Input, ...]) -> int:
    """Number of scenarios: as written, or of a grid as follows. Nothing is made yet."""
    most = _whole(table, "max_scenarios", MOST, least=1)
    if sampling == "grid":
        if "samples" in table:
            raise StudyError(
                f"`samples` = {shown(table['samples'])} says nothing to a grid",
                help="remove it: a grid has every combination of its numbers",
                key="samples",
            )
        samples, maker = math.prod(x.count for x in laws), "the grid"
        remedy = "give fewer points or values"
    else:
        samples = _whole(table, "samples", None, least=1)
        maker, remedy = f"`samples` = {samples}", "write fewer"
    if samples > most:
        number = str(samples) if samples <= LARGEST else f"about 1e{len(str(samples)) - 1}"
        raise StudyError(
            f"{maker} makes {number} scenarios, which is more than {most}; their rows would take "
            f"about {_size(samples * ROW)} of memory",
            help=f"{remedy}, or allow them by max_scenarios = {min(samples, LARGEST)}",
            key="vary" if sampling == "grid" else "samples",
        )
    if sampling == "sobol" and (samples > SOBOL_POINTS or len(laws) > SOBOL_INPUTS):
        raise StudyError(
            f"a Sobol sequence has no {samples} points of {len(laws)} numbers: it ends at "
            f"{SOBOL_POINTS} points and {SOBOL_INPUTS} numbers",
            help='use sampling = "latin-hypercube"',
            key="samples",
        )
    return samples


def _size(count: int) -> str:
    """Bytes in a unit that makes their number small.

    Examples
    --------
    >>> _size(3_000), _size(3 * 10**15), _size(10**40)
    ('3 kB', '3 PB', 'more than 1000 EB')

    """
    for power, unit in enumerate(("B", "kB", "MB", "GB", "TB", "PB", "EB")):
        if count < 1000 ** (power + 1):
            return f"{count / 1000**power:.3g} {unit}"
    return "more than 1000 EB"


def _motion(table: Mapping[str, Any], command: str, base: Path) -> Motion | None:
    """The motion of the plan that is followed, or None with other commands."""
    plan = table.get("plan")
    if command != "follow":
        if plan is None:
            return None
        raise StudyError(
            f'`plan` = {shown(plan)} goes with command = "follow" only, and this is {command!r}',
            help="remove it, or follow the plan",
            key="plan",
        )
    if not isinstance(plan, str | os.PathLike):
        raise StudyError(
            "`plan` is missing: what is to be followed?",
            help='name a finished plan: plan = "scene.plan/result.json"',
            key="plan",
        )
    path = base / plan
    result = plydrape.Result.read(str(path / "result.json" if path.is_dir() else path))
    # grippers that pick the ply up have come to it before, and a motion begins with its first step
    times = np.array(result.times)
    return Motion(times - times[0], np.array(result.commanded))


def _probe(study: Study) -> None:
    """Builds the scene with each varied key at its middle and its ends.

    Values that no scene takes are failures of a scenario; a key with none that it takes is a
    mistake in the study.
    """
    scene = build(study.tables, study.base)
    if study.motion is not None:
        try:
            scene.with_motion(study.motion.times, study.motion.positions, slow=True)
        except (plydrape.PlydrapeError, ValueError) as error:
            raise StudyError(
                f"the scene cannot follow this plan: {error}",
                help="give the plan of this scene, or of one with the same array",
                key="plan",
            ) from error
    for x in study.inputs:
        faults: list[tuple[Value, plydrape.PlydrapeError]] = []
        mold = None if x.key.startswith("mold.") else scene.mold
        for value in x.at([0.5, 1e-9, 1.0 - 1e-9]):
            try:
                build(put(study.tables, x.key, x.written(value)), study.base, mold)
                break
            except plydrape.PlydrapeError as fault:
                faults.append((x.written(value), fault))
        else:
            refused, why = faults[0]
            raise StudyError(
                f"`{x.key}` cannot vary like this: with {shown(refused)} the scene is refused",
                help=message(why),
                key=x.key,
            )
