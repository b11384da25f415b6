"""`python -m plydrape.study STUDY`: what `plydrape study` runs."""

from __future__ import annotations

import argparse
import sys

from plydrape import PlydrapeError

from .definition import Study
from .error import StudyError
from .outcome import Outcome
from .run import beside, run
from .words import amount, name

EXIT_CODES = """\
Exit codes:
  0    done: every scenario has its row
  2    bad input: the message names the file, the key and the remedy
  130  interrupted: the same command goes on
"""


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
    given = parser().parse_args(arguments)
    folder = given.output
    try:
        study = Study.read(given.study)
        folder = folder or beside(study)
        outcome = run(
            study,
            output=folder,
            scheduler=given.scheduler,
            workers=given.workers,
            progress=not given.quiet,
        )
    except StudyError as error:
        where = f"{error.file}: " if error.file else ""
        return refuse(f"{where}{error.message}", error.help)
    except PlydrapeError as error:
        return refuse(str(error), "")
    except KeyboardInterrupt:
        print(
            f"interrupted: finished rows are in {folder}; the same command goes on",
            file=sys.stderr,
        )
        return 130
    if not given.quiet:
        print(told(outcome, study))
    return 0


def refuse(message: str, remedy: str) -> int:
    """Says what is wrong, as the other commands do."""
    print(f"  × {message}" + (f"\n  help: {remedy}" if remedy else ""), file=sys.stderr)
    return 2


def told(outcome: Outcome, study: Study) -> str:
    """What the command prints: counts, a table of the judged measures, files."""
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
        at = entry["percentiles"]
        cells = [amount(at[q]) for q in ("50", "5", "95")]
        limit = "varies" if entry["limit"] is None else amount(entry["limit"])
        driver = entry["driver"]
        by = f"{driver} ({entry['correlations'][driver]:+.2f})" if driver else "–"
        lines.append(
            f"{name(key):<17}{cells[0]:>10}{cells[1]:>10}{cells[2]:>10}{limit:>9}  "
            f"{entry['unit']:<6}{100 * entry['exceeded']:>7.1f} %  {by}"
        )
    if accepted["share"] is None:
        lines += ["", "nothing was draped: see the column `error`"]
    else:
        low, high = (100 * x for x in accepted["interval"])
        lines += [
            "",
            f"accepted {100 * accepted['share']:.1f} % of {about['draped']} drapes "
            f"(95 % interval {low:.1f} to {high:.1f} %)",
        ]
    files = ("study.parquet", "summary.json", "summary.html")
    return "\n".join([*lines, "", *(f"wrote {outcome.folder}/{file}" for file in files)])


if __name__ == "__main__":
    sys.exit(main())
