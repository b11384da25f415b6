"""What a study refuses, and the error about what is not installed."""

from __future__ import annotations

from importlib.util import find_spec
from types import ModuleType

from plydrape.errors import ExtraError, PlydrapeError


class StudyError(PlydrapeError, ValueError):
    """A study that cannot be run as it is written.

    Attributes
    ----------
    message
        What is wrong, with the key and its value.
    help
        What would be right.
    file
        The study file, or None.
    key
        The key at fault as a dotted path, or None.

    Examples
    --------
    >>> try:
    ...     raise StudyError("`samples` = 0 does not count", help="write 1 or more")
    ... except StudyError as error:
    ...     print(error)
    `samples` = 0 does not count; write 1 or more

    """

    def __init__(
        self,
        message: str,
        *,
        help: str = "",  # noqa: A002  as in SceneError
        file: str | None = None,
        key: str | None = None,
    ) -> None:
        """Keeps the parts; `str()` of the error is all of them in one line."""
        where = f"{file}: " if file else ""
        super().__init__(f"{where}{message}" + (f"; {help}" if help else ""))
        self.message = message
        self.help = help
        self.file = file
        self.key = key


def toml() -> ModuleType:
    """The reader of TOML: the standard library's, before Python 3.11 the package tomli.

    Raises
    ------
    ExtraError
        Python is older than 3.11 and tomli is not installed.

    """
    try:
        import tomllib as reader
    except ImportError:
        try:
            import tomli as reader  # type: ignore[no-redef, import-not-found, unused-ignore]
        except ImportError as error:
            raise ExtraError("tomli", "tomli") from error
    return reader


def require(*modules: str) -> None:
    """Reports at the start, not after an hour, that a package is missing.

    Raises
    ------
    ExtraError
        One of the modules is not installed.

    Examples
    --------
    >>> require("json")

    """
    missing = [module for module in modules if find_spec(module) is None]
    if missing:
        raise ExtraError(missing[0], " ".join(missing))
