"""What can go wrong, with the words of the command line."""

from __future__ import annotations

import errno
import os
from functools import cache
from typing import Any


class PlydrapeError(Exception):
    """Any error of plydrape.

    One about a file that the file system refuses is Python's exception for that too, as
    FileNotFoundError or PermissionError, and has its `filename`.

    Examples
    --------
    >>> issubclass(plydrape.SceneError, plydrape.PlydrapeError)
    True
    >>> try:
    ...     plydrape.Scene.read("no/such/scene.toml")
    ... except FileNotFoundError as error:
    ...     print(isinstance(error, plydrape.SceneError), error.filename)
    True no/such/scene.toml

    """

    def __str__(self) -> str:
        # an OSError with a file name would make a text of its own
        return str(self.args[0]) if self.args else ""

    def __reduce__(self) -> tuple[Any, ...]:
        fields = {name: getattr(self, name) for name in SYSTEM if hasattr(self, name)}
        kind, system = getattr(self, "_both", (type(self), None))
        return _again, (kind, system, self.args, {**fields, **self.__dict__})


SYSTEM = ("errno", "strerror", "filename", "name", "path")
"""What Python's own exceptions hold beside their dict."""
NUMBERS: dict[type[OSError], int] = {
    FileNotFoundError: errno.ENOENT,
    PermissionError: errno.EACCES,
    IsADirectoryError: errno.EISDIR,
    OSError: errno.EIO,
}


def of_file(error: PlydrapeError, system: str, path: str | os.PathLike[str]) -> PlydrapeError:
    """The same error as one of the file system too.

    Parameters
    ----------
    error : PlydrapeError
        The error.
    system : str
        Name of Python's exception for it.
    path : str or path
        The file that the file system refused.

    Returns
    -------
    PlydrapeError
        An error with the same text and fields, and `filename` and `errno`.

    Examples
    --------
    >>> error = plydrape.CadError("mold.step: there is no such file")
    >>> both = plydrape.errors.of_file(error, "FileNotFoundError", "mold.step")
    >>> isinstance(both, plydrape.CadError), isinstance(both, FileNotFoundError), both.filename
    (True, True, 'mold.step')

    """
    kind = next((one for one in NUMBERS if one.__name__ == system), OSError)
    fields = {"filename": os.fspath(path), "errno": NUMBERS[kind]}
    fields["strerror"] = os.strerror(NUMBERS[kind])
    return _again(type(error), kind, error.args, {**error.__dict__, **fields})


@cache
def _both(kind: type[PlydrapeError], system: type[OSError]) -> type[PlydrapeError]:
    """A class of errors that is also one of Python's own about files."""
    name = f"{kind.__name__.removesuffix('Error')}{system.__name__}"
    bases = (kind,) if issubclass(kind, system) else (kind, system)
    fields = {"__module__": __name__, "__doc__": kind.__doc__, "_both": (kind, system)}
    return type(name, bases, fields)


def _again(
    kind: type[PlydrapeError],
    system: type[OSError] | None,
    args: tuple[Any, ...],
    fields: dict[str, Any],
) -> PlydrapeError:
    """An error with these fields, without a call of its class."""
    made: Any = kind if system is None else _both(kind, system)  # type: ignore[arg-type]
    error = (system or kind).__new__(made)
    error.args = args
    for name, value in fields.items():
        setattr(error, name, value)
    assert isinstance(error, PlydrapeError)
    return error


class SceneError(PlydrapeError, ValueError):
    r"""A refused scene: where it is at fault, what is wrong there, and what would be right.

    Attributes
    ----------
    file
        The file at fault, as it was named.
    line
        Its line, counted from 1; None where there is no place to point at.
    column
        Its column in characters, counted from 1; None likewise.
    message
        What is wrong.
    help
        What would be right.

    Examples
    --------
    >>> import plydrape
    >>> try:
    ...     plydrape.Scene.parse("[ply]\ngripers = [4, 2]")
    ... except plydrape.SceneError as error:
    ...     print(error.line, error.column, error.message)
    2 1 `gripers` is no key here

    """

    def __init__(
        self,
        text: str,
        *,
        file: str = "",
        line: int | None = None,
        column: int | None = None,
        message: str = "",
        help: str = "",  # noqa: A002  the library's name
    ) -> None:
        """`text` says it all; the fields say it in parts."""
        super().__init__(text)
        self.file = file
        self.line = line
        self.column = column
        self.message = message or text
        self.help = help


class SolveError(PlydrapeError, ArithmeticError):
    """An equilibrium that was not found.

    Attributes
    ----------
    status
        How the solve ended: `stalled`, `iteration-limit` or `length-not-met`.
    iterations
        Iterations on the slopes.
    residual
        What is left of the rule of the slopes, scaled to a slope.

    Examples
    --------
    >>> limp = {"mass": 0.3, "flexural_rigidity": 0.0}
    >>> ply = plydrape.Ply(grippers=[2, 1], cell=[0.1, 0.1], material=limp)
    >>> equilibrium = plydrape.Solver(ply).solve([[0, 0, 0], [0.098, 0, 0]])
    >>> equilibrium.jacobian(wrt="material")
    Traceback (most recent call last):
    plydrape.errors.SolveError: a rigidity of the material is zero: ...

    """

    def __init__(
        self,
        text: str,
        *,
        status: str = "",
        iterations: int = 0,
        residual: float = float("nan"),
    ) -> None:
        """`text` says it all; the fields say it in parts."""
        super().__init__(text)
        self.status = status
        self.iterations = iterations
        self.residual = residual


class PlanError(PlydrapeError, ValueError):
    """A scene that has nothing to plan, or an earlier plan that does not belong to it.

    Examples
    --------
    >>> plydrape.plan(plydrape.Scene.read("examples/02_hanging_strip/scene.toml"))
    Traceback (most recent call last):
    plydrape.errors.PlanError: the scene has no mold to lay the ply on

    """


class ResultError(PlydrapeError, ValueError):
    """A file that is no result of this version: cut short, changed, older, newer, or foreign.

    Examples
    --------
    >>> plydrape.Result.parse("{}")
    Traceback (most recent call last):
    plydrape.errors.ResultError: `result.json` is not a result of plydrape: ...

    """


class OutputError(PlydrapeError, OSError):
    """Files that could not be written; none was, then.

    Examples
    --------
    >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    >>> plydrape.simulate(scene).write("README.md")
    Traceback (most recent call last):
    plydrape.errors.OutputError: README.md is not a folder: ...

    """


class CadError(PlydrapeError, ValueError):
    """A CAD file that cannot be read, or surfaces in it that cannot be turned into triangles.

    Examples
    --------
    >>> import plydrape.cad
    >>> plydrape.cad.read("mold.dwg")
    Traceback (most recent call last):
    plydrape.errors.CadError: mold.dwg: expected a file that ends in .step, ...

    """


class ExtraError(PlydrapeError, ImportError):
    """A package that only a part of plydrape needs is not installed; the text says how it is.

    Examples
    --------
    >>> raise plydrape.ExtraError("PyVista", "pyvista")
    Traceback (most recent call last):
    plydrape.errors.ExtraError: PyVista is missing; install it with: pip install pyvista

    """

    def __init__(self, name: str, package: str) -> None:
        """What is missing, and the name by which an index of packages knows it."""
        super().__init__(f"{name} is missing; install it with: pip install {package}")
        self.name = name
