"""The user guide does what it says: every command is run, its exit code and its output compared."""

from __future__ import annotations

import re
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from guide import Block, Command, Reader, absent, blocks, matches, recorded
from guide import reader as follower
from program import ROOT, binary

CHAPTERS = [ROOT / "docs" / "index.md", *sorted((ROOT / "docs" / "guide").glob("*.md"))]
NAMES = [chapter.stem for chapter in CHAPTERS]
# Chapters whose commands plan for minutes.
LONG = ("bias", "cell", "planning", "robot")
RUN = [
    pytest.param(chapter, id=chapter.stem, marks=[pytest.mark.long] * (chapter.stem in LONG))
    for chapter in CHAPTERS
]

# What a block may be called. Everything else, a misspelt `console` above all, is an error.
KNOWN = {"console", "sh", "text", "toml", "json", "csv", "python", "matlab", "{toctree}", "{math}"}


def blocks_of(chapter: Path) -> list[Block]:
    """All blocks of a chapter."""
    return list(blocks(chapter.read_text(encoding="utf-8")))


def left_out() -> list[tuple[str, Block]]:
    """Blocks of commands that are not run here, each with its chapter."""
    return [
        (chapter.stem, block)
        for chapter in CHAPTERS
        for block in blocks_of(chapter)
        if block.info == "sh" or absent(block)
    ]


@pytest.mark.parametrize("chapter", RUN)
def test_a_chapter_does_what_it_says(chapter: Path, tmp_path: Path) -> None:
    """A reader who types the commands in their order gets these exit codes and this output."""
    reader = follower(tmp_path, binary())
    for block in blocks_of(chapter):
        if block.caption is not None:
            reader.write(block)
        elif block.info == "console" and not absent(block):
            for command in block.commands():
                code, printed = reader.run(command)
                place = f"{chapter.name}, line {command.line}: $ {command.text}"
                assert code == command.code, f"{place}\nexit {code}, not {command.code}\n{printed}"
                if command.shown:
                    shown = "\n".join(command.shown)
                    same = matches(command.shown, printed)
                    assert same, f"{place}\nshown:\n{shown}\n\nprinted:\n{printed}"


@pytest.mark.parametrize("chapter", CHAPTERS, ids=NAMES)
def test_no_command_escapes_the_test(chapter: Path) -> None:
    """They are in `console` blocks, or in `sh` blocks with the reason why they are not run."""
    for block in blocks_of(chapter):
        place = f"{chapter.name}, line {block.line}"
        if block.info.startswith("{code-block}"):
            assert block.caption, f"{place}: a code-block is a file and has a :caption:"
            continue
        assert block.info in KNOWN, f"{place}: a block of the unknown kind `{block.info}`"
        if block.info == "console":
            assert block.not_run is None and block.commands(), place
            continue
        assert (block.info == "sh") == (block.not_run is not None), (
            f"{place}: run, or not run: why?"
        )
        loose = [line for line in block.body if line.startswith(("$ ", "plydrape "))]
        assert block.info == "sh" or not loose, f"{place}: `{loose}` is not run"


@pytest.mark.parametrize(
    ("name", "block"), left_out(), ids=[f"{name}-{block.line}" for name, block in left_out()]
)
def test_commands_that_are_not_run_here(name: str, block: Block) -> None:
    """Lists them with the reason."""
    commands = block.body if block.info == "sh" else [c.text for c in block.commands()]
    why = block.not_run or f"there is no {' '.join(absent(block))} here"
    pytest.skip(f"NOT RUN, {name}: {'; '.join(commands)} ({why})")


@pytest.mark.parametrize("chapter", CHAPTERS, ids=NAMES)
def test_links_to_other_sites_are_well_formed(chapter: Path) -> None:
    """They are not fetched: the tests need no network. Links within the guide are Sphinx's part."""
    for link in re.findall(r"\]\(([a-z]+:[^)]*)\)", chapter.read_text(encoding="utf-8")):
        parts = urlsplit(link)
        assert parts.scheme == "https" and "." in parts.netloc and " " not in link, link


def test_a_wrong_exit_code_and_wrong_output_are_found(tmp_path: Path) -> None:
    """The comparison itself can fail: on codes, on changed, missing and further lines."""
    text = "```console\n$ echo one; echo 1.25 mm # exit 3\none\n1.25 mm\n$ cd /; false\n```\n"
    (block,) = blocks(text)
    first, second = block.commands()
    assert (first.code, second.code) == (3, 0)
    reader = Reader(tmp_path, [])
    assert reader.run(first) == (0, "one\n1.25 mm\n")
    assert reader.run(second)[0] == 1 and reader.here == Path("/")

    printed = "one\ntwo\n1.25 mm\n"
    assert matches(["one", "…", "1.25 mm"], printed) and matches(["…", "two", "…"], printed)
    for wrong in (["one"], ["one", "1.25 mm"], ["one", "two", "1.… mm"], ["…", "two"], ["…", "x"]):
        assert not matches(wrong, printed), wrong


def test_words_are_compared_exactly_and_numbers_nearly() -> None:
    """A fifth is allowed, and a unit of the last digit; times of the machine may be any."""
    line = "plan after 10 drapes, in 3.2 s: height 0.35 mm at (100.0, 70.0) mm, edge g2_1–g3_1"
    same = "plan after 11 drapes, in 40 s: height 0.31 mm at (5.0, 7.0) mm, edge g0_0–g1_0"
    assert matches([line], same)
    for wrong in ("0.25 mm", "0.35 m", "0.35 mm high"):
        assert not matches([line], line.replace("0.35 mm", wrong)), wrong
    assert matches(["a   1.0    -0.5"], "a 1.1 -0.5") and not matches(["a 1.0"], "a -1.0")


def test_numbers_are_recorded_and_lines_filled_in() -> None:
    """What is shown keeps its words and gets the numbers that were printed."""
    printed = "head\n  1   2.5 mm\n  2   3.5 mm\n\naccepted\n"
    assert recorded(["head", "…", "  2   9.5 mm", "", "accepted"], printed) == [
        *["head", "…", "  2   3.5 mm", "", "accepted"]
    ]
    assert recorded(["head", "@", "…cepted"], printed) == printed.splitlines()
    assert recorded(["head", "…", "refused"], printed) is None


def test_a_continued_line_is_one_command() -> None:
    """As in a shell; a file's caption is its name."""
    text = "```console\n$ echo a \\\n    b\na b\n```\n"
    text += "```{code-block} toml\n:caption: x.toml\n\na = 1\n```\n"
    console, file = blocks(text)
    assert console.commands() == [Command(2, "echo a \\\n    b", 0, ["a b"])]
    assert (file.caption, file.body) == ("x.toml", ["a = 1"])
