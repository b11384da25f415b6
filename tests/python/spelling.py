"""The spelling of what a user reads, that of the United States, and plain words.

    python3 tests/python/spelling.py             lists other spellings, and phrases to replace
    python3 tests/python/spelling.py --fix       changes the spellings

Prose is Markdown outside of code; in the blocks of the guide what the program
prints; in programs the texts of several words and the comments that become documentation. Names and
keys in programs are listed too, and changed by hand.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FILES = (
    "README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "DESIGN.md",
    "docs/**/*.md",
    "benches/*.md",
    "viewer/*.md",
)
PROGRAMS = (
    "crates/*/src/**/*.rs",
    "crates/*/tests/**/*.rs",
    "python/plydrape/**/*.py",
    "python/plydrape/*.pyi",
    "tests/python/**/*.py",
    "viewer/src/**/*.ts",
    "viewer/src/**/*.html",
    "viewer/test/**/*.ts",
)
TEXTS = (
    "crates/*/src/**/*.toml",
    "crates/*/tests/**/*.snap",
    "examples/**/*.toml",
    "materials/**/*.toml",
)

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
    "misspelt": "misspelled",
    "signalled": "signaled",
    "travelled": "traveled",
}
# what no name or key of a program has; a file of these is one that reads such words
NAMED = re.compile(r"fibre|neighbour|colour|metre|centre|centring|centred|behaviour|licence", re.I)
READS = re.compile(
    r"scene/(choice|diagnostic|units|limits)\.rs$|measure/mod\.rs$|result/contact\.rs$"
    r"|it/(scenes|books)\.rs$|_occ\.py$|opening\.ts$"
)
# phrases of a private meaning, and what an engineer writes
PHRASES = {
    r"\b(?:is|are|was|were) wanted\b": "must be, expected",
    r"\bstands? (?:an|no|any) errors?\b": "tolerates",
    r"\b(?:is|are|was|were) told(?! apart)\b": "has, reports, is called with",
    r"\bby and by\b": "step by step",
    r"\bstands? (?:here|over (?:it|them|the))\b": "is given here, overrides",
    r"(?:///|//!|/\*\*|\"\"\") ?(?:Those of|The same (?:of|with|as|in|for))\b": "the noun itself",
    r"\b(?:crumbs?|strands?|complaints?|unmet)\b": "short free segment, curve, diagnostic",
}
PRIVATE = [(re.compile(phrase), ours) for phrase, ours in PHRASES.items()]
# words whose ending differs
CENTRED = re.compile(r"\bcentred\b", re.I)
PER_CENT = re.compile(r"\bper cent\b", re.I)
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
    text = PER_CENT.sub(lambda found: like(found[0], "percent"), text)
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
    fence, console = "", False
    for number, line in enumerate(text.split("\n"), start=1):
        mark = FENCE.match(line)
        if mark:
            console = "console" in line or "text" in line if not fence else console
            fence = "" if fence and mark[1].startswith(fence) else fence or mark[1]
            continue
        if fence:
            # in a block of the guide, what a program prints
            if console and not line.startswith(("$ ", "  --")) and worded(line) != line:
                yield number, line, worded(line)
            continue
        parts = CODE.split(line)
        parts[::2] = [spelled(part) for part in parts[::2]]
        # a link leads to a heading, which is prose
        parts[1::2] = [ANCHOR.sub(lambda found: spelled(found[0]), part) for part in parts[1::2]]
        if "".join(parts) != line:
            yield number, line, "".join(parts)


# what is code within a text: code marks, values in formats, names with underscores, paths, calls,
# keys before `=` or `:`, words in capitals and in quotes
NAMES = re.compile(
    r"""(`[^`]*`|\{[^{}]*\}|\w*_\w+|\w+(?:::|\.)\w+|\w+\(|\b\w+ ?=|\b[A-Z]{2,}\b"""
    r"""|\\?["']\w+\\?["']|(?m:^\s*\w+:))"""
)
RUST = re.compile(
    r"""(?P<skip>'(?:\\.[^']*|[^'\\])'|//(?![/!])[^\n]*)"""
    r"""|(?P<text>///[^\n]*|//![^\n]*|r(?P<marks>\#*)".*?"(?P=marks)|"(?:\\.|[^"\\])*")""",
    re.S,
)
PYTHON = re.compile(
    r"""(?P<skip>\#[^\n]*)"""
    r"""|(?P<text>\"\"\".*?\"\"\"|\'\'\'.*?\'\'\'|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')""",
    re.S,
)
SCRIPT = re.compile(
    r"""(?P<skip>//[^\n]*)"""
    r"""|(?P<text>/\*.*?\*/|`(?:\\.|[^`\\])*`|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'"""
    r"""|(?<=>)[^<>{}=;]+(?=<))""",
    re.S,
)
GRAMMARS = {".rs": RUST, ".py": PYTHON, ".pyi": PYTHON, ".ts": SCRIPT, ".html": SCRIPT}


def worded(text: str) -> str:
    """A text of several words without its names; one word alone is a name itself."""
    if not re.search(r"\w\s+\S", text):
        return text
    parts = NAMES.split(text)
    parts[::2] = [spelled(part) for part in parts[::2]]
    return "".join(parts)


def program(text: str, suffix: str) -> str:
    """The source of a program with its texts spelled so."""

    def ours(found: re.Match[str]) -> str:
        return found[0] if found["skip"] else worded(found[0])

    return GRAMMARS[suffix].sub(ours, text)


def changes(path: Path, text: str) -> Iterator[tuple[int, str, str]]:
    """Lines of a file that are spelled otherwise: number, line as it is, line as it should be."""
    if path.suffix == ".md":
        yield from prose(text)
        return
    if path.suffix in GRAMMARS:
        new = program(text, path.suffix)
    elif path.suffix == ".toml":
        lines = [line.partition("#") for line in text.split("\n")]
        new = "\n".join(code + mark + worded(said) for code, mark, said in lines)
    else:
        new = "\n".join(map(worded, text.split("\n")))
    pairs = zip(text.split("\n"), new.split("\n"), strict=True)
    for number, (old, ours) in enumerate(pairs, start=1):
        if old != ours:
            yield number, old, ours


def private(path: Path, text: str) -> Iterator[tuple[int, str, str]]:
    """Phrases of a private meaning and names of another spelling: line, as it is, what to write."""
    is_code = path.suffix in GRAMMARS and not READS.search(path.as_posix())
    for number, line in enumerate(text.split("\n"), start=1):
        for phrase, ours in PRIVATE:
            if found := phrase.search(line):
                yield number, found[0], ours
        if is_code and (found := NAMED.search(line)):
            yield number, found[0], "the spelling of the United States"


def documents() -> list[Path]:
    """All documents whose prose counts."""
    return sorted(path for name in FILES for path in ROOT.glob(name))


def programs() -> list[Path]:
    """All programs and texts of theirs."""
    found = {path for name in PROGRAMS + TEXTS for path in ROOT.glob(name)}
    own = {Path(__file__).resolve(), ROOT / "tests/python/test_spelling.py"}
    return sorted(path for path in found - own if "node_modules" not in path.parts)


def main(arguments: list[str]) -> int:
    """Lists or changes other spellings."""
    wrong = 0
    for path in documents() + programs():
        text = path.read_text(encoding="utf-8")
        lines = text.split("\n")
        for number, line, ours in changes(path, text):
            wrong += 1
            lines[number - 1] = ours
            words = set(re.findall(r"\w+", line)) - set(re.findall(r"\w+", ours))
            print(f"{path.relative_to(ROOT)}:{number}: {', '.join(sorted(words))}")
        for number, found, ours in private(path, text):
            wrong += 1
            print(f"{path.relative_to(ROOT)}:{number}: {found}: {ours}")
        if arguments == ["--fix"]:
            path.write_text("\n".join(lines), encoding="utf-8")
    return int(wrong > 0 and arguments != ["--fix"])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
