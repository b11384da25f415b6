"""The twenty lines of the front page, from a mold to a planned motion, say the same in both
languages.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from program import ROOT

NUMBER = re.compile(r"-?\d+\.\d+")


def in_rust() -> Path:
    """The example of the library as it was built; skips where it was not."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    folder = os.environ.get("PLYDRAPE_EXAMPLE_BINARIES", target / "checked" / "examples")
    path = Path(folder) / "dome"
    if not path.is_file():
        pytest.skip("NOT COMPARED: cargo build --profile checked -p plydrape --example dome")
    return path


def printed(*command: str | Path) -> str:
    """What a program prints."""
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=600)
    return done.stdout


def test_rust_and_python_print_the_same_numbers() -> None:
    """Duration, verdict, and every limit with its name and unit, line by line."""
    rust = printed(in_rust())
    python = printed(sys.executable, ROOT / "examples" / "first_plan.py")
    assert NUMBER.sub("#", python) == NUMBER.sub("#", rust)
    # both round the same doubles
    assert NUMBER.findall(python) == NUMBER.findall(rust)
    assert "accepted: true" in python and len(python.splitlines()) > 10
