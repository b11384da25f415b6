"""`scripts/fuzz`: what it takes, and what it prints."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from .campaign import NAMES, ROUND, Broken, Fuzzer, campaign
from .process import Program

ROOT = Path(__file__).resolve().parents[2]


def parser() -> argparse.ArgumentParser:
    """The options."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    parser = argparse.ArgumentParser(
        prog="scripts/fuzz",
        description="Runs plydrape on damaged and strange input. The same seed, the same cases. "
        "Exit codes: 0 all promises were kept, 1 some were broken; the cases are kept.",
    )
    parser.add_argument("--seed", type=int, default=0, help="of all cases (default 0)")
    parser.add_argument("--seconds", type=float, help="time to run; 60 unless --cases is given")
    parser.add_argument("--cases", type=int, help="most cases to run")
    parser.add_argument(
        "--case", type=int, help="run this one only, as a report names it; needs --kind"
    )
    parser.add_argument("--kind", choices=NAMES, help="of input; all in turn unless given")
    parser.add_argument(
        "--patience", type=float, default=5.0, help="seconds until a drape gets Ctrl-C (default 5)"
    )
    parser.add_argument("--jobs", type=int, default=2, help="processes (default 2)")
    parser.add_argument(
        "--binary",
        type=Path,
        default=Path(os.environ.get("PLYDRAPE", target / "release" / "plydrape")),
        help="the program; $PLYDRAPE or the release build unless given",
    )
    parser.add_argument(
        "--keep",
        type=Path,
        default=target / "fuzz",
        help="folder of broken cases (default target/fuzz)",
    )
    return parser


def main() -> int:
    """Runs the campaign; the exit code."""
    options = parser().parse_args()
    binary = options.binary.resolve()
    if not os.access(binary, os.X_OK):
        parser().error(
            f"there is no program {binary}: cargo build --release, or name it by --binary"
        )
    if options.case is not None and options.kind is None:
        parser().error("--case needs the --kind of the case")
    venv = ROOT / ".venv" / "bin" / "python"
    python = os.environ.get("PLYDRAPE_PYTHON") or (str(venv) if venv.is_file() else "python3")
    program = Program(binary, python, options.patience)
    kinds: tuple[str, ...] = (options.kind,) if options.kind else ROUND
    if "study" in kinds and not program.has_studies():
        if options.kind:
            parser().error(
                f"{python} has no package plydrape; name one that has by PLYDRAPE_PYTHON"
            )
        print(f"NO STUDIES: {python} has no package plydrape")
        kinds = tuple(kind for kind in kinds if kind != "study")
    fuzzer = Fuzzer(program, options.seed, options.keep, kinds)

    if options.case is not None:
        found = fuzzer.run(options.case)
        for broken in found:
            show(broken, fuzzer)
        print("\n".join(f"{n:>7}  {what}" for what, n in sorted(fuzzer.codes.items())))
        return 1 if found else 0

    most = options.cases if options.cases is not None else sys.maxsize
    seconds = options.seconds or (60.0 if options.cases is None else float("inf"))
    done, codes, found_keys = campaign(
        fuzzer, options.jobs, most, seconds, lambda broken: show(broken, fuzzer)
    )
    print(f"\n{done} cases of seed {options.seed}; how commands ended:")
    print("\n".join(f"{n:>7}  {what}" for what, n in sorted(codes.items())))
    if found_keys:
        print(f"{len(found_keys)} kinds of faults; their first cases are in {options.keep}")
        print("\n".join(f"  {key}" for key in sorted(found_keys)))
        return 1
    print("every promise was kept")
    return 0


def show(broken: Broken, fuzzer: Fuzzer) -> None:
    """Prints a broken case, and the command that repeats it."""
    steps = [f"  {step}"[:200] for step in broken.steps]
    detail = [f"  | {line}"[:200] for line in broken.fault.detail.splitlines()[:8]]
    again = f"scripts/fuzz --kind {broken.kind} --seed {fuzzer.seed} --case {broken.number}"
    print(
        "\n".join([f"BROKEN {broken.key}", *detail, *steps, f"  {broken.command}", f"  {again}"]),
        flush=True,
    )


if __name__ == "__main__":
    sys.exit(main())
