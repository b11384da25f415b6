"""What comes with an extra: Matplotlib, PyVista, OpenCASCADE; asked for only when used."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from plydrape.errors import ExtraError


def load(module: str, *, extra: str, name: str) -> ModuleType:
    """The module, or a `ExtraError` that says which extra brings it.

    Example:
        >>> plydrape._extra.load("json", extra="plot", name="JSON").__name__
        'json'
        >>> plydrape._extra.load("no_such_module", extra="plot", name="Matplotlib")
        Traceback (most recent call last):
        plydrape.errors.ExtraError: Matplotlib is missing; install it with: pip install ...

    """
    try:
        return import_module(module)
    except ModuleNotFoundError as missing:
        # a module that is there but lacks one of its own is another fault
        if missing.name is None or module.split(".")[0] != missing.name.split(".")[0]:
            raise
        raise ExtraError(name, extra) from missing
