"""The spelling of the project's prose: that of the United States.

    python3 tests/python/spelling.py             lists other spellings in the documents
    python3 tests/python/spelling.py --fix       changes them

Prose is what stands in Markdown outside of code. Keys, names in programs and what the program
prints are code: `fibre_angle` is a key of the format and stays.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FILES = ("README.md", "CHANGELOG.md", "DESIGN.md", "docs/**/*.md", "benches/*.md", "viewer/*.md")

# stems with all that may follow them
STEMS = {
    "fibre": "fiber",
    "colour": "color",
    "metre": "meter",
    "centre": "center",
    "neighbour": "neighbor",
    "behaviour": "behavior",
    "favour": "favor",
    "grey": "gray",
    "licence": "license",
    "catalogue": "catalog",
    "artefact": "artifact",
    "analyse": "analyze",
    "judgement": "judgment",
    "learnt": "learned",
    "modell": "model",
    "labell": "label",
    "cancelled": "canceled",
    "programme": "program",
    "aluminium": "aluminum",
}
# words whose ending differs
CENTRED = re.compile(r"\bcentred\b", re.I)
BEFORE_ISE = (
    "organ|recogn|normal|optim|initial|minim|maxim|vector|linear|symmetr|discret|summar|serial|"
    "special|util|visual"
)
ISE = re.compile(rf"\b(\w*(?:{BEFORE_ISE}))is(e|ed|es|ing|ation)\b", re.I)
WORD = re.compile(rf"\b\w*?(?:{'|'.join(STEMS)})\w*", re.I)
FENCE = re.compile(r"^ *(`{3,}|~{3,})")
# code in a line, formulas, and the targets of links and pictures
CODE = re.compile(r"(`+[^`]*`+|\$[^$]*\$|\]\([^)]*\)|https?://\S+|<!--.*?-->)")

ANCHOR = re.compile(r"(?<=#)[^)]*(?=\)$)")


def spelled(text: str) -> str:
    """The text in the spelling of the United States."""
    text = ISE.sub(r"\1iz\2", CENTRED.sub(lambda found: like(found[0], "centered"), text))
    return WORD.sub(lambda found: stem(found[0]), text)


def stem(word: str) -> str:
    """A word with its stem spelled so; a program may be `programmed`."""
    if re.match(r"programm(ed|er|ing)", word, re.I):
        return word
    for other, ours in STEMS.items():
        found = re.search(other, word, re.I)
        if found:
            word = word[: found.start()] + like(found[0], ours) + word[found.end() :]
    return word


def like(old: str, new: str) -> str:
    """The new word with the first letter of the old one."""
    return new.capitalize() if old[0].isupper() else new


def prose(text: str) -> Iterator[tuple[int, str, str]]:
    """Lines whose prose is spelled otherwise: number, line as it is, line as it should be."""
    fence = ""
    for number, line in enumerate(text.split("\n"), start=1):
        mark = FENCE.match(line)
        if mark:
            fence = "" if fence and mark[1].startswith(fence) else fence or mark[1]
            continue
        if fence:
            continue
        parts = CODE.split(line)
        parts[::2] = [spelled(part) for part in parts[::2]]
        # a link leads to a heading, which is prose
        parts[1::2] = [ANCHOR.sub(lambda found: spelled(found[0]), part) for part in parts[1::2]]
        if "".join(parts) != line:
            yield number, line, "".join(parts)


def documents() -> list[Path]:
    """All documents whose prose counts."""
    return sorted(path for name in FILES for path in ROOT.glob(name))


def main(arguments: list[str]) -> int:
    """Lists or changes other spellings."""
    wrong = 0
    for path in documents():
        text = path.read_text(encoding="utf-8")
        lines = text.split("\n")
        for number, line, ours in prose(text):
            wrong += 1
            lines[number - 1] = ours
            words = set(re.findall(r"\w+", line)) - set(re.findall(r"\w+", ours))
            print(f"{path.relative_to(ROOT)}:{number}: {', '.join(sorted(words))}")
        if arguments == ["--fix"]:
            path.write_text("\n".join(lines), encoding="utf-8")
    return int(wrong > 0 and arguments != ["--fix"])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
