"""Options that the long runs share."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def seconds_or_count(parser: argparse.ArgumentParser) -> None:
    """Adds the seed, how long and how often, and the program."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    default = Path(os.environ.get("PLYDRAPE", target / "release" / "plydrape"))
    parser.add_argument("--seed", type=int, default=0, help="of all cases (default 0)")
    parser.add_argument("--seconds", type=float, help="time to run; no bound unless given")
    parser.add_argument("--count", type=int, default=sys.maxsize, help="most cases")
    parser.add_argument(
        "--binary", type=Path, default=default, help="$PLYDRAPE or the release build unless given"
    )


def binary_of(options: argparse.Namespace) -> Path:
    """The program."""
    binary: Path = options.binary.resolve()
    if not os.access(binary, os.X_OK):
        raise SystemExit(f"there is no program {binary}: cargo build --release, or name it")
    return binary


def python_of() -> str:
    """The Python that has the package."""
    venv = ROOT / ".venv" / "bin" / "python"
    return os.environ.get("PLYDRAPE_PYTHON") or (str(venv) if venv.is_file() else "python3")
