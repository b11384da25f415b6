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
            for key in vars(value):
                if not key.startswith("_"):
                    yield f"{module.__name__}.{name}.{key}", inspect.getattr_static(value, key)


def documented() -> dict[str, str]:
    """Documentation by name; what stands in two modules is taken once."""
    out: dict[str, str] = {}
    seen = set()
    for module in modules():
        for name, value in nouns(module):
            text = inspect.getdoc(getattr(value, "__func__", value)) or ""
            if text and text not in seen:
                seen.add(text)
                out[name] = text
    return out


EXAMPLES = {name: text for name, text in documented().items() if ">>>" in text}


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_prints_what_it_says(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """As someone would type it in the folder of the project."""
    monkeypatch.chdir(ROOT)
    scope = {"plydrape": plydrape, "np": np}
    example = doctest.DocTestParser().get_doctest(EXAMPLES[name], scope, name, None, 0)
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
