"""The fuzzer notices a program that breaks a promise: here small programs that each break one."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

# Refuses all input as it should.
REFUSE = 'print("  × nothing is right\\n  help: no idea", file=sys.stderr); sys.exit(2)'
# Writes files into `out`, with the list of their check sums.
WRITE = """
def write(sealed=True, **files):
    os.mkdir("out")
    listed = {}
    for name, text in files.items():
        name = name.replace("_", ".")
        open("out/" + name, "w").write(text)
        stamp = {"crc32": zlib.crc32(text.encode()), "length": len(text.encode())}
        listed[name] = {"by": sys.argv[1], "contents": [stamp]}
    open("out/.plydrape", "w").write(json.dumps({"sealed": sealed, "files": listed}))
"""

# What a program does when it should write `out`, and the promise that it breaks so.
FAULTS = {
    "panics": (
        "print(\"thread 'main' panicked at crates/a/src/b.rs:7\", file=sys.stderr); sys.exit(101)",
        "no panic: crates/a/src/b.rs:7",
    ),
    "crashes": ("os.kill(os.getpid(), signal.SIGSEGV)", "no signal: signal"),
    "waits for ever": ("import time; time.sleep(60)", "ends in time: it still waits"),
    "raises": ("raise KeyError(3)", "no traceback: KeyError"),
    "ends with a code of its own": ("sys.exit(77)", "a documented exit code"),
    "refuses without a word": ("sys.exit(2)", "one message"),
    "has no remedy": ('print("  × wrong", file=sys.stderr); sys.exit(2)', "a remedy"),
    "calls bad input its own fault": (
        'print("  × NaN, please\\n  │ report it\\n  help: no", file=sys.stderr); sys.exit(2)',
        "no fault of its own",
    ),
    "repeats escape sequences": (
        'print("  × \\x1b[31mred\\n  help: none", file=sys.stderr); sys.exit(2)',
        "printable words",
    ),
    "leaves half a folder": (f'os.mkdir("out"); {REFUSE}', "written whole or not at all"),
    "leaves out files": ('write(steps_csv="step\\n1\\n")', "written whole or not at all"),
    "leaves a list without a seal": (
        'write(sealed=False, a_csv="step\\n1\\n")',
        "the list of files has no seal",
    ),
    "leaves its stage": (f'os.mkdir(".plydrape-a1"); {REFUSE}', "nothing is left behind"),
    "writes NaN into a table": ('write(steps_csv="step,x\\n1,NaN\\n")', "no NaN and no infinity"),
    "writes infinity as JSON": ('write(a_json="[1, Infinity]")', "no NaN and no infinity"),
    "writes NaN into a path": (
        """write(a_svg='<svg><path d="M1 2LNaN 3"/></svg>')""",
        "no NaN and no infinity",
    ),
    "writes infinity into a deck": (
        'write(a_inp="*NODE\\n1, inf, 0\\n")',
        "no NaN and no infinity",
    ),
    "writes a page without data": ('write(report_html="<p>")', "files can be read"),
    "writes broken XML": ('write(a_svg="<svg>")', "files can be read"),
    "changes its input": (
        f'open("scene.toml", "a").write("#"); {REFUSE}',
        "inputs stay as they are",
    ),
    "writes over files": (
        'import shutil; shutil.rmtree("out", True); write(steps_csv="step\\n1\\n")',
        "what is the user's stays",
    ),
    "throws dice": (
        'print(f"  × {os.getpid()}\\n  help: no", file=sys.stderr); sys.exit(2)',
        "the same again",
    ),
    "accepts when it checks, and refuses when it drapes": (
        f"sys.exit(0) if sys.argv[1] == 'check' else 0; {REFUSE}",
        "check refuses what cannot be draped",
    ),
}


def program(folder: Path, body: str) -> Path:
    """A program that stands for plydrape."""
    path = folder / "plydrape"
    head = f"#!{sys.executable} -IS\nimport json, os, signal, sys, zlib\n"
    path.write_text(f"{head}{WRITE}\n{body}\n")
    path.chmod(0o755)
    return path


def fuzz(binary: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Runs the fuzzer on a program, with scenes."""
    command = [str(ROOT / "scripts" / "fuzz"), "--binary", str(binary)]
    command += ["--keep", str(binary.parent / "kept")]
    command += ["--kind", "scene", "--jobs", "1", *options]
    surroundings = os.environ | {"PYTHON": sys.executable}
    return subprocess.run(
        command, env=surroundings, capture_output=True, text=True, timeout=120, check=False
    )


def test_a_program_that_keeps_its_promises_passes(tmp_path: Path) -> None:
    """Every case is run and no fault is reported."""
    done = fuzz(program(tmp_path, REFUSE), "--cases", "20")
    assert (done.returncode, done.stderr) == (0, "")
    assert "20 cases of seed 0" in done.stdout
    assert "every promise was kept" in done.stdout


@pytest.mark.parametrize("fault", FAULTS)
def test_a_broken_promise_is_reported_and_repeats(tmp_path: Path, fault: str) -> None:
    """The fault is named, its files are kept, and its case alone shows it again."""
    body, promise = FAULTS[fault]
    binary = program(tmp_path, body)
    # what shows in few cases needs more of them
    rare = promise[:11] in ("the same ag", "check refus", "what is the")
    slow = ("--patience", "0.2") if "time" in promise else ()
    done = fuzz(binary, "--cases", "60" if rare else "3" if slow else "12", *slow)
    assert done.returncode == 1, done.stdout + done.stderr
    lines = done.stdout.splitlines()
    start = next(n for n, line in enumerate(lines) if line.startswith("BROKEN") and promise in line)
    again = next(line for line in lines[start:] if line.startswith("  scripts/fuzz"))
    assert "--kind scene --seed 0 --case" in again
    kept = [path.read_text() for path in tmp_path.glob("kept/scene-0-*/fault.txt")]
    assert any(promise in text and again.strip() in text for text in kept)

    repeated = fuzz(binary, "--case", again.split()[-1], *slow)
    assert repeated.returncode == 1
    assert any("BROKEN" in line and promise in line for line in repeated.stdout.splitlines())


def test_a_seed_gives_the_same_cases(tmp_path: Path) -> None:
    """Two campaigns of a seed print the same, another seed something else."""
    binary = program(tmp_path, FAULTS["panics"][0])
    first, second, other = (fuzz(binary, "--cases", "12", "--seed", s) for s in ("5", "5", "6"))
    assert first.stdout == second.stdout
    assert first.stdout != other.stdout


def test_a_mutation_that_the_fault_does_not_need_is_left_out(tmp_path: Path) -> None:
    """A program that fails at any scene is reported with the scene as it was shipped."""
    done = fuzz(program(tmp_path, FAULTS["panics"][0]), "--cases", "12")
    reports = done.stdout.split("BROKEN ")[1:]
    assert reports
    for report in reports:
        lines = report.split("\n\n")[0].splitlines()[1:]
        commands = [line for line in lines if line.startswith("  ") and line[2] != "|"]
        assert [line.split()[0] for line in commands] == ["plydrape", "scripts/fuzz"], report
