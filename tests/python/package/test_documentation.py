"""Every example in the package's documentation runs and prints what it says."""

import doctest
import importlib
import inspect
import pkgutil
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import plydrape
import pytest

ROOT = Path(__file__).resolve().parents[3]
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def modules() -> Iterator[ModuleType]:
    """The package and all that is in it, but for commands."""
    yield plydrape
    for found in pkgutil.walk_packages(plydrape.__path__, "plydrape."):
        if not found.name.endswith("__main__"):
            yield importlib.import_module(found.name)


def nouns(module: ModuleType) -> Iterator[tuple[str, Any]]:
    """What a module defines for others, and the methods of its classes."""
    yield module.__name__, module
    for name, value in vars(module).items():
        own = getattr(value, "__module__", None) in (module.__name__, "plydrape")
        if name.startswith("_") or not own or not (inspect.isclass(value) or callable(value)):
            continue
        yield f"{module.__name__}.{name}", value
        if inspect.isclass(value):
            # a compiled class lists its properties in any order
            for key in sorted(vars(value)):
                part = inspect.getattr_static(value, key)
                # what a field means is said by its class
                if not key.startswith("_") and (callable(part) or hasattr(part, "__get__")):
                    yield f"{module.__name__}.{name}.{key}", part


def documented() -> dict[str, tuple[str, ModuleType]]:
    """Documentation by name, and its place; what is in two modules is taken once."""
    out: dict[str, tuple[str, ModuleType]] = {}
    seen = set()
    for module in modules():
        for name, value in nouns(module):
            text = inspect.getdoc(getattr(value, "__func__", value)) or ""
            if text and text not in seen:
                seen.add(text)
                out[name] = (text, module)
    return out


EXAMPLES = {name: found for name, found in documented().items() if ">>>" in found[0]}


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_prints_what_it_says(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """As someone would type it in the folder of the project."""
    if name.endswith(".to_pyvista"):
        pytest.importorskip("pyvista", reason="NOT TESTED: scripts/venv --heavy")
    monkeypatch.chdir(ROOT)
    text, module = EXAMPLES[name]
    scope = {**vars(module), "plydrape": plydrape, "np": np}
    example = doctest.DocTestParser().get_doctest(text, scope, name, None, 0)
    printed: list[str] = []
    runner = doctest.DocTestRunner(optionflags=FLAGS)
    runner.run(example, out=printed.append)
    assert runner.summarize(verbose=False).failed == 0, "".join(printed)


def test_everything_public_is_documented() -> None:
    """Every name of the package says what it is, every method too."""
    known = documented()
    bare = [
        name
        for module in modules()
        for name, value in nouns(module)
        if not inspect.getdoc(getattr(value, "__func__", value)) and name not in known
    ]
    assert not bare


def called() -> Iterator[tuple[str, Any]]:
    """Classes and functions that users call by name, and the methods of these classes."""
    for module in (plydrape, plydrape.batch, plydrape.study):
        for name in module.__all__:
            value = getattr(module, name)
            if not callable(value):
                continue
            yield f"{module.__name__}.{name}", value
            if inspect.isclass(value):
                for key, part in vars(value).items():
                    if not key.startswith("_") and callable(getattr(value, key)):
                        yield f"{module.__name__}.{name}.{key}", part


def test_everything_that_is_called_has_an_example() -> None:
    """Whoever asks for help sees how it is used."""
    bare = [
        name
        for name, value in called()
        if ">>>" not in (inspect.getdoc(getattr(value, "__func__", value)) or "")
    ]
    assert not bare
