"""Runs the notebooks of the examples: their outputs are recorded, and compared by numbers.

    tests/python/notebooks.py [NAME…]     runs notebooks and records their outputs

Pictures are recorded with few dots, since they are looked at and not measured. A page of a result
is left out, because it is megabytes; a sentence replaces it. Of texts the words are
compared as they are and numbers nearly, as in the guide (`guide.agree`). Pictures are not compared.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from itertools import zip_longest
from pathlib import Path
from typing import Any

import nbclient
import nbformat
from guide import agree

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "notebooks"
LARGEST = 100_000
"""Characters of an output that is recorded, but of a picture."""
QUIET = (
    "import matplotlib\n"
    "import warnings\n"
    "matplotlib.rcParams['figure.dpi'] = 72\n"
    "from matplotlib_inline.backend_inline import set_matplotlib_formats\n"
    "set_matplotlib_formats('png', bbox_inches='tight', dpi=80)\n"
)
"""What runs before a notebook that is recorded: light pictures."""


def names() -> list[str]:
    """The notebooks, in the order in which they are to be read."""
    return sorted(path.name for path in FOLDER.glob("*.ipynb"))


def read(name: str) -> Any:
    """A notebook."""
    return nbformat.read(FOLDER / name, as_version=4)  # type: ignore[no-untyped-call]


def executed(book: Any) -> Any:
    """The notebook as it is after all of its cells have run, from top to bottom in its folder."""
    book = nbformat.from_dict(book)  # type: ignore[no-untyped-call]
    settings = {"metadata": {"path": str(FOLDER)}}
    client = nbclient.NotebookClient(book, timeout=300, kernel_name="python3", resources=settings)
    with client.setup_kernel():
        assert client.kc is not None
        client.kc.execute(QUIET, store_history=False)
        for number, cell in enumerate(book.cells):
            client.execute_cell(cell, number)
    for cell in book.cells:
        cell.metadata.pop("execution", None)
        cell.outputs = [light(output) for output in cell.get("outputs", [])] or cell.get("outputs")
        if cell.cell_type != "code":
            cell.pop("outputs")
    book.metadata.pop("language_info", None)
    return book


def light(output: Any) -> Any:
    """An output without what is too large to be recorded."""
    data = output.get("data", {})
    for kind, value in list(data.items()):
        if isinstance(value, str) and not kind.startswith("image/") and len(value) > LARGEST:
            del data[kind]
    return output


def texts(cell: Any) -> Iterator[str]:
    """The lines that a cell has printed, and of its value the text; what is a picture is none."""
    for output in cell.get("outputs", []):
        if output.output_type == "stream":
            yield from "".join(output.text).splitlines()
        else:
            plain = "".join(output.get("data", {}).get("text/plain", ""))
            # a picture, a page, or another value that says where it is in the memory
            if "image/png" not in output.get("data", {}) and " at 0x" not in plain:
                yield from plain.splitlines()


def differences(recorded: Any, now: Any) -> list[str]:
    """Lines of a notebook that are not what was recorded."""
    found = []
    for number, (before, after) in enumerate(zip(recorded.cells, now.cells, strict=True)):
        for one, other in zip_longest(texts(before), texts(after)):
            if one is None or other is None or not agree(one, other):
                found.append(f"cell {number}: recorded {one!r}, now {other!r}")
    return found


def record(name: str) -> None:
    """Runs a notebook and writes it with its outputs."""
    book = executed(read(name))
    with (FOLDER / name).open("w", encoding="utf-8") as file:
        nbformat.write(book, file)  # type: ignore[no-untyped-call]


if __name__ == "__main__":
    for chosen in sys.argv[1:] or names():
        record(Path(chosen).name)
        print(chosen, (FOLDER / Path(chosen).name).stat().st_size, "bytes")
