"""Runs CalculiX on a deck and reads what it prints; reads decks and changes them."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

Array = NDArray[np.float64]

KINDS = {"displacements": "U", "forces": "RF", "total force": "RF total"}
KIND = re.compile(r" (displacements|forces|total force) .* for set (\S+) and time")


def ccx(deck: str, folder: Path, seconds: float = 600.0) -> dict[str, Array]:
    """Solves a deck to its end and returns the last printed values, by node set and kind.

    "GRIPPERS U" has one row a node, its number and three components; "GRIPPERS RF total" one row.
    """
    program = shutil.which("ccx")
    if program is None:
        message = "NOT COMPARED WITH CALCULIX: there is no ccx; apt-get install calculix-ccx"
        assert not os.environ.get("CI"), message
        pytest.skip(message)
    (folder / "deck.inp").write_text(deck)
    done = subprocess.run(
        [program, "-i", "deck"],
        cwd=folder,
        env=os.environ | {"OMP_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        timeout=seconds,
        check=False,
    )
    errors = [line for line in done.stdout.splitlines() if "*ERROR" in line]
    assert done.returncode == 0 and not errors, f"{errors}\n{done.stdout[-2000:]}"
    assert "Job finished" in done.stdout
    return printed((folder / "deck.dat").read_text())


def printed(text: str) -> dict[str, Array]:
    """The last block of each kind in a .dat file."""
    blocks: dict[str, Any] = {}
    name = None
    for line in text.splitlines():
        if found := KIND.match(line):
            name = f"{found[2]} {KINDS[found[1]]}"
            blocks[name] = []
        elif line.strip() and name is not None:
            blocks[name].append([float(word) for word in line.split()])
    return {name: np.array(rows) for name, rows in blocks.items()}


class Deck:
    """A deck, read by its keywords: a reader of its own, which knows nothing of the writer."""

    def __init__(self, text: str) -> None:
        """Splits the text into keywords with their parameters and data."""
        self.text = text
        self.blocks: list[tuple[str, dict[str, str], list[list[str]]]] = []
        for line in text.splitlines():
            if line.startswith("**"):
                continue
            if line.startswith("*"):
                keyword, *rest = [part.strip() for part in line[1:].split(",")]
                pairs = [part.partition("=") for part in rest]
                self.blocks.append((keyword, {key: value for key, _, value in pairs}, []))
            else:
                fields = [field.strip() for field in line.split(",")]
                assert all(len(field) <= 20 for field in fields), f"too wide a field: {line}"
                self.blocks[-1][2].append(fields)

    def find(self, keyword: str, **parameters: str) -> list[tuple[dict[str, str], list[list[str]]]]:
        """All blocks of a keyword with the given parameters."""
        return [
            (has, data)
            for name, has, data in self.blocks
            if name == keyword and parameters.items() <= has.items()
        ]

    def nodes(self) -> dict[int, Array]:
        """Places (m) of all nodes, by number."""
        rows = [row for _, data in self.find("NODE") for row in data]
        return {int(row[0]): np.array([float(x) for x in row[1:]]) for row in rows}

    def elements(self, kind: str) -> list[list[int]]:
        """Nodes of all elements of a type."""
        rows = [row for _, data in self.find("ELEMENT", TYPE=kind) for row in data]
        return [[int(n) for n in row[1:]] for row in rows]

    def node_set(self, name: str) -> list[int]:
        """Node numbers of a set."""
        ((_, data),) = self.find("NSET", NSET=name)
        return [int(field) for row in data for field in row]

    def numbers(self, keyword: str, **parameters: str) -> list[float]:
        """All numbers of the one block of a keyword."""
        ((_, data),) = self.find(keyword, **parameters)
        return [float(field) for row in data for field in row if field]

    def section(self) -> tuple[Array, float, float]:
        """Young's and shear moduli (Pa), density (kg/m³) and thickness (m) of the ply."""
        moduli = np.array(self.numbers("ELASTIC", TYPE="ENGINEERING CONSTANTS"))
        density = next(float(data[0][0]) for _, data in self.find("DENSITY"))
        (thickness,) = self.numbers("SHELL SECTION", ELSET="PLY")
        return moduli, density, thickness

    def coarser(self) -> str:
        """The same ply in elements of twice the side, on the nodes that are there."""
        places = self.nodes()
        lines = ["*ELEMENT, TYPE=S8R, ELSET=PLY"]
        fine = self.elements("S8R")
        corner = {nodes[0]: nodes for nodes in fine}
        origin = places[fine[0][0]]
        axes = [places[fine[0][k]] - origin for k in (1, 3)]
        for number, nodes in enumerate(fine, 1):
            way = places[nodes[0]] - origin
            steps = [round(float(way @ axis / (axis @ axis))) for axis in axes]
            if any(step % 2 for step in steps):
                continue
            a = corner[nodes[0]]
            b, d = corner[a[1]], corner[a[3]]
            c = corner[a[2]]
            ring = [a[0], b[1], c[2], d[3], a[1], b[2], c[3], d[0]]
            lines.append(", ".join(map(str, [number, *ring])))
        head, _, tail = self.text.partition("*ELEMENT, TYPE=S8R, ELSET=PLY\n")
        return head + "\n".join(lines) + "\n" + tail[tail.index("*NSET") :]
