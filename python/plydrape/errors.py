"""What can go wrong, with the words of the command line."""

from __future__ import annotations


class PlydrapeError(Exception):
    """Any error of plydrape.

    Example:
        >>> issubclass(plydrape.SceneError, plydrape.PlydrapeError)
        True
    """


class SceneError(PlydrapeError, ValueError):
    r"""A refused scene: where it is at fault, what is wrong there, and what would be right.

    Attributes:
        file: The file at fault, as it was named.
        line: Its line, counted from 1; None where there is no place to point at.
        column: Its column in characters, counted from 1; None likewise.
        message: What is wrong.
        help: What would be right.

    Example:
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

    Attributes:
        status: How the solve ended: `stalled`, `iteration-limit`, `length-not-met` or
            `mounts-not-balanced`.
        iterations: Iterations on the slopes.
        residual: What is left of the rule of the slopes, scaled to a slope.

    Example:
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

    Example:
        >>> plydrape.plan(plydrape.Scene.read("examples/02_hanging_strip/scene.toml"))
        Traceback (most recent call last):
        plydrape.errors.PlanError: the scene has no mold to lay the ply on
    """


class ResultError(PlydrapeError, ValueError):
    """A file that is no result of this version: cut short, changed, older, newer, or foreign.

    Example:
        >>> plydrape.Result.parse("{}")
        Traceback (most recent call last):
        plydrape.errors.ResultError: `result.json` is not a result of plydrape: ...
    """


class OutputError(PlydrapeError, OSError):
    """Files that could not be written; none was, then.

    Example:
        >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
        >>> plydrape.simulate(scene).write("README.md")
        Traceback (most recent call last):
        plydrape.errors.OutputError: README.md is not a folder: ...
    """


class CadError(PlydrapeError, ValueError):
    """A CAD file that cannot be read, or surfaces in it that cannot be turned into triangles.

    Example:
        >>> import plydrape.cad
        >>> plydrape.cad.read("mold.dwg")
        Traceback (most recent call last):
        plydrape.errors.CadError: mold.dwg: expected a file that ends in .step, ...
    """


class ExtraError(PlydrapeError, ImportError):
    """A package that an extra of plydrape brings is not installed; the text says which extra.

    Example:
        >>> raise plydrape.ExtraError("Matplotlib", "plot")
        Traceback (most recent call last):
        plydrape.errors.ExtraError: Matplotlib is missing; install it with: pip install ...
    """

    def __init__(self, package: str, extra: str) -> None:
        """`package` is missing, which `plydrape[extra]` brings."""
        super().__init__(f'{package} is missing; install it with: pip install "plydrape[{extra}]"')
        self.name = package
