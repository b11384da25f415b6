"""What not every user needs: Matplotlib, PyVista, OpenCASCADE; asked for only when used."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from plydrape.errors import ExtraError


def load(module: str, *, package: str, name: str) -> ModuleType:
    """The module, or an `ExtraError` that says how it is installed.

    Parameters
    ----------
    module : str
        Name of the module.
    package : str
        Name by which an index of packages knows it.
    name : str
        What it is called.

    Returns
    -------
    ModuleType
        The module.

    Examples
    --------
    >>> plydrape._extra.load("json", package="json", name="JSON").__name__
    'json'
    >>> plydrape._extra.load("no_such_module", package="matplotlib", name="Matplotlib")
    Traceback (most recent call last):
    plydrape.errors.ExtraError: Matplotlib is missing; install it with: pip install matplotlib

    """
    try:
        return import_module(module)
    except ModuleNotFoundError as missing:
        # a module that is there but lacks one of its own is another fault
        if missing.name is None or module.split(".")[0] != missing.name.split(".")[0]:
            raise
        raise ExtraError(name, package) from missing
