"""What can go wrong, with the words of the command line."""

from __future__ import annotations


class PlydrapeError(Exception):
    """Any error of plydrape."""


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
        status: How the solve ended: `stalled` or `iteration-limit`.
        iterations: Iterations on the slopes.
        residual: Newton step of the slopes still to go.
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
    """A scene that has nothing to plan, or an earlier plan that does not belong to it."""


class ResultError(PlydrapeError, ValueError):
    """A file that is no result of this version: cut short, changed, older, newer, or foreign."""


class OutputError(PlydrapeError, OSError):
    """Files that could not be written; none was, then."""


class ExtraError(PlydrapeError, ImportError):
    """A package that an extra of plydrape brings is not installed; the text says which extra."""

    def __init__(self, package: str, extra: str) -> None:
        """`package` is missing, which `plydrape[extra]` brings."""
        super().__init__(f'{package} is missing; install it with: pip install "plydrape[{extra}]"')
        self.name = package
