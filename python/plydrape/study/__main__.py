"""`python -m plydrape.study STUDY`: what `plydrape study` runs."""

from __future__ import annotations

import argparse
import contextlib
import math
import os
import signal
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO

from plydrape import PlydrapeError

from .definition import Study
from .error import StudyError
from .labels import amount, name
from .outcome import Outcome
from .run import beside, run

EXIT_CODES = """\
Exit codes:
  0    done: every scenario has its row
  2    bad input, or a file that cannot be written: the message names it, and the remedy
  4    standard output could not be written: the rows are in their folder
  130  interrupted by Ctrl-C or SIGTERM: the same command goes on
"""
# Kinds of errors that are printed; all are in summary.json.
TROUBLES = 5
NOTHING = "nothing was run or written"
# Signals with these handlers are not for Python.
UNHEARD = (signal.SIG_IGN, None)


def parser() -> argparse.ArgumentParser:
    """The options."""
    parser = argparse.ArgumentParser(
        prog="plydrape study",
        description="Drape many scenes made of one: a grid or a random sample of its numbers.",
        epilog=EXIT_CODES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("study", help="the study file, TOML")
    parser.add_argument(
        "-o", "--output", metavar="DIR", help="folder of the rows; NAME.results unless given"
    )
    parser.add_argument(
        "--scheduler", metavar="ADDRESS", help="a Dask scheduler; processes here unless given"
    )
    parser.add_argument(
        "--workers",
        metavar="N",
        type=int,
        help="processes on this machine; one a core unless given",
    )
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing but errors")
    return parser


def main(arguments: list[str] | None = None) -> int:
    """Runs a study; the exit code."""
    options = parser().parse_args(arguments)
    with interruptible():
        return command(options)


def command(options: argparse.Namespace) -> int:
    """Runs the study of the options; the exit code."""
    folder = None
    try:
        study = Study.read(options.study)
        folder = Path(options.output or beside(study))
        outcome = run(
            study,
            output=folder,
            scheduler=options.scheduler,
            workers=options.workers,
            progress=not options.quiet,
        )
    except StudyError as error:
        where = f"{error.file}: " if error.file else ""
        return refuse(f"{where}{error.message}", error.help)
    except PlydrapeError as error:
        return refuse(str(error), "")
    except MemoryError:
        return refuse("the memory does not suffice for this study", "run fewer scenarios")
    except OSError as error:
        return refuse(f"the study cannot be run: {error}", "")
    except KeyboardInterrupt:
        kept = f"finished rows are in {folder}" if folder and folder.is_dir() else "nothing was run"
        write(f"interrupted: {kept}; the same command goes on", sys.stderr)
        return 130
    return 0 if options.quiet else show(report(outcome, study))


@contextlib.contextmanager
def interruptible() -> Iterator[None]:
    """SIGTERM ends the work like Ctrl-C; within a second of it either counts no more.

    Those who end a process, such as `timeout`, may send a signal to it and to its group, and the
    second would interrupt the end of the first.
    """
    last = -math.inf

    def end(number: int, frame: object) -> None:
        nonlocal last
        if time.monotonic() - last > 1.0:
            last = time.monotonic()
            raise KeyboardInterrupt

    try:
        # What is ignored stays so, as Ctrl-C in a script's background.
        heard = [s for s in (signal.SIGINT, signal.SIGTERM) if signal.getsignal(s) not in UNHEARD]
        before = [(s, signal.signal(s, end)) for s in heard]
    except ValueError:  # Only the main thread has signals.
        before = []
    try:
        yield
    finally:
        for number, handler in before:
            # After an interruption the process ends: a second signal finds nothing to end.
            signal.signal(number, handler if last == -math.inf else signal.SIG_IGN)


def show(text: str) -> int:
    """Prints on standard output; the exit code."""
    error = write(text, sys.stdout)
    # A reader that has seen enough, such as `head`, is no failure.
    if error is None or isinstance(error, BrokenPipeError):
        return 0
    why = error.strerror or error
    refuse(f"standard output cannot be written: {why}", "the rows are in their folder")
    return 4


def refuse(message: str, remedy: str) -> int:
    """Says what is wrong, as the other commands do; the exit code."""
    write(f"  × {message}" + (f"\n  help: {remedy}" if remedy else ""), sys.stderr)
    return 2


def write(text: str, stream: TextIO) -> OSError | None:
    """Prints on a stream; why that is not possible, if so."""
    try:
        print(text, file=stream, flush=True)
    except OSError as error:
        # Python would try once more at its end.
        with contextlib.suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        return error
    return None


def report(outcome: Outcome, study: Study) -> str:
    """What the command prints: counts, a table of the judged measures, errors, files."""
    about = outcome.summary
    accepted = about["accepted"]
    lines = [
        study.title,
        f"{about['scenarios']} scenarios ({study.sampling}, seed {study.seed}), "
        f"{about['failed']} failed",
        "",
        f"{'measure':<17}{'median':>10}{'5 %':>10}{'95 %':>10}{'limit':>9}  "
        f"{'unit':<6}{'not kept':>9}  driven by",
    ]
    for key, entry in about["measures"].items():
        if not key.startswith("value_"):
            continue
        percentiles = entry["percentiles"]
        cells = [amount(percentiles[q]) for q in ("50", "5", "95")]
        limit = "varies" if entry["limit"] is None else amount(entry["limit"])
        driver = entry["driver"]
        cause = f"{driver} ({entry['correlations'][driver]:+.2f})" if driver else "–"
        lines.append(
            f"{name(key):<17}{cells[0]:>10}{cells[1]:>10}{cells[2]:>10}{limit:>9}  "
            f"{entry['unit']:<6}{100 * entry['exceeded']:>7.1f} %  {cause}"
        )
    if accepted["share"] is None:
        lines += ["", "nothing was draped"]
    else:
        low, high = (100 * x for x in accepted["interval"])
        lines += [
            "",
            f"accepted {100 * accepted['share']:.1f} % of {about['draped']} drapes "
            f"(95 % interval {low:.1f} to {high:.1f} %)",
        ]
    lines += [f"{x['count']} failed: {x['kind']}: {x['text']}" for x in about["errors"][:TROUBLES]]
    wrote = [f"wrote {outcome.folder}/{file}" for file in outcome.written]
    return "\n".join([*lines, "", *(wrote or [f"{outcome.folder} was finished before: {NOTHING}"])])


if __name__ == "__main__":
    sys.exit(main())
