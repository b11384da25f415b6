"""The Python package as Markdown, made from its sources: the page guide/api.md.

Nothing is imported, so the page can be made where the package is not installed. What is compiled is
read from its stubs.
"""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1] / "python" / "plydrape"
COMPILED = PACKAGE / "_plydrape.pyi"

# What can be imported from where, in the order of the page: title, module, file, names (all public
# ones of the file if None).
PARTS: list[tuple[str, str, Path, list[str] | None]] = [
    ("Scenes, drapes and plans", "plydrape", COMPILED,
     ["Scene", "simulate", "Result", "Drape", "Sheet", "plan", "Plan", "Sample", "measures",
      "Measure"]),
    ("Ply, mold and ideal drape", "plydrape", COMPILED,
     ["Ply", "Material", "materials", "fit", "Mold", "Surface", "ClosestPoints", "Net"]),
    ("Equilibria and derivatives", "plydrape", COMPILED,
     ["Solver", "Equilibrium", "Jacobian", "outcome", "Outcome", "Span"]),
    ("Limits", "plydrape", PACKAGE / "limits.py", None),
    ("Many at once: `plydrape.batch`", "plydrape.batch", COMPILED,
     ["simulate_all", "equilibria", "Equilibria"]),
    ("Studies: `plydrape.study`", "plydrape.study", PACKAGE / "study" / "__init__.py", None),
    ("Notebooks: `plydrape.notebook`", "plydrape.notebook", PACKAGE / "notebook.py", None),
    ("STEP and IGES: `plydrape.cad`", "plydrape.cad", PACKAGE / "cad.py", None),
    ("Errors", "plydrape", PACKAGE / "errors.py", None),
]  # fmt: skip

# Names that a module gives to what is compiled.
RENAMED = {"plydrape.batch.simulate_all": "plydrape.batch.simulate"}

# Sections of a docstring, as numpydoc has them, and how they are called here.
HEADS = {
    "Parameters": "Arguments",
    "Attributes": "Attributes",
    "Returns": "Returns",
    "Yields": "Yields",
    "Raises": "Raises",
    "Notes": "Notes",
    "Examples": "Examples",
}
Definition = ast.ClassDef | ast.FunctionDef


def markdown() -> str:
    """A section for each part, with its classes and functions."""
    lines: list[str] = []
    for title, module, file, names in PARTS:
        found = definitions(file)
        lines += ["", f"## {title}", ""]
        for name in names if names is not None else public(file, found):
            lines += shown(found[name], module)
    return "\n".join(lines)


def definitions(file: Path) -> dict[str, Definition]:
    """Classes and functions of a file; of a package also those that it takes from its modules."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    found: dict[str, Definition] = {}
    for node in tree.body:
        if isinstance(node, Definition):
            found[node.name] = node
        elif isinstance(node, ast.ImportFrom) and node.level == 1 and node.module:
            inner = definitions(file.parent / f"{node.module}.py")
            names = (alias.name for alias in node.names)
            found |= {name: inner[name] for name in names if name in inner}
    return found


def public(file: Path, found: dict[str, Definition]) -> list[str]:
    """The names in `__all__`, or all that do not begin with an underscore."""
    for node in ast.parse(file.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return [name for name in ast.literal_eval(node.value) if name in found]
    return [name for name in found if not name.startswith("_")]


def shown(node: Definition, module: str) -> Iterator[str]:
    """The heading of a class or a function, what it takes, and what it does."""
    name = f"{module}.{node.name}"
    yield from ["", f"### `{RENAMED.get(name, name)}`", ""]
    if isinstance(node, ast.FunctionDef):
        yield from [signature(node, node.name), *text(node)]
        return
    start = next((one for one in members(node) if one.name in ("__new__", "__init__")), None)
    if start is not None:
        yield signature(start, node.name)
    yield from text(node)
    properties = [one for one in members(node) if is_property(one)]
    if properties:
        yield from [
            "",
            "```{table}",
            ":class: members",
            "",
            "| property | what it is |",
            "|---|---|",
        ]
        for one in properties:
            what = " ".join(summary(one).split()).replace("|", "\\|")
            kind = ast.unparse(one.returns) if one.returns else ""
            kind = short(kind).replace("|", "\\|")
            yield f"| `{one.name}`: `{kind}` | {what} |"
        yield "```"
    for one in members(node):
        if not is_property(one) and not one.name.startswith("_"):
            yield from [
                "",
                f"#### `{node.name}.{one.name}`",
                "",
                signature(one, one.name),
                *text(one),
            ]


def members(node: ast.ClassDef) -> list[ast.FunctionDef]:
    """Methods and properties of a class."""
    return [one for one in node.body if isinstance(one, ast.FunctionDef)]


def is_property(node: ast.FunctionDef) -> bool:
    """Whether it is read without a call."""
    return any("property" in ast.unparse(one) for one in node.decorator_list)


def summary(node: Definition) -> str:
    """The docstring before its first section and example."""
    first = re.split(r"\n\s*\n", ast.get_docstring(node) or "")
    return first[0]


def signature(node: ast.FunctionDef, name: str) -> str:
    """The call, one argument a line where it is long."""
    args = node.args
    kept = [*args.posonlyargs, *args.args]
    first = len(kept) - len(args.defaults)
    parts = [
        argument(arg, args.defaults[n - first] if n >= first else None)
        for n, arg in enumerate(kept)
        if arg.arg not in ("self", "cls")
    ]
    if args.kwonlyargs:
        parts.append("*")
        parts += [argument(*one) for one in zip(args.kwonlyargs, args.kw_defaults, strict=True)]
    returns = ast.unparse(node.returns) if node.returns else "None"
    arrow = "" if node.name in ("__new__", "__init__") else f" -> {short(returns)}"
    line = f"{name}({', '.join(parts)}){arrow}"
    if len(line) > 80:
        inner = "".join(f"    {part},\n" for part in parts)
        line = f"{name}(\n{inner}){arrow}"
    return f"```python\n{line}\n```\n"


def argument(arg: ast.arg, default: ast.expr | None) -> str:
    """An argument with its type and default."""
    kind = f": {short(ast.unparse(arg.annotation))}" if arg.annotation else ""
    if default is None:
        return arg.arg + kind
    return (
        f"{arg.arg}{kind} = {ast.unparse(default)}" if kind else f"{arg.arg}={ast.unparse(default)}"
    )


def short(kind: str) -> str:
    """A type without the modules that everybody knows."""
    return re.sub(r"\b(?:typing|numpy\.typing|numpy|builtins|pathlib|os)\.", "", kind)


def text(node: Definition) -> Iterator[str]:
    """A docstring, its sections as lists and its examples as blocks."""
    lines = inspect.cleandoc(ast.get_docstring(node) or "").splitlines()
    head = ""
    block: list[str] = []
    for n, line in enumerate(lines):
        under = lines[n + 1] if n + 1 < len(lines) else ""
        if line in HEADS and under == "-" * len(line):
            yield from part(head, block)
            head, block = line, []
        elif not (line and n > 0 and lines[n - 1] in HEADS and set(line) == {"-"}):
            block.append(line)
    yield from part(head, block)


def part(head: str, block: list[str]) -> Iterator[str]:
    """One section of a docstring."""
    body = inspect.cleandoc("\n".join(["", *block])).strip("\n")
    if not body:
        return
    yield ""
    if head == "Examples":
        yield from examples(body)
    elif head in ("Returns", "Yields"):
        kind, _, what = body.partition("\n")
        yield f"**{HEADS[head]}** `{kind}`: {' '.join(what.split())}"
    elif head in ("Parameters", "Attributes", "Raises"):
        yield from [f"**{HEADS[head]}**", ""]
        for entry in re.split(r"\n(?=\S)", body):
            name, _, what = entry.partition("\n")
            name, _, kind = name.partition(" : ")
            said = f" ({code(kind)})" if kind else ""
            yield f"- `{name}`{said}: {' '.join(what.split())}"
    elif head:
        yield from [f"**{HEADS[head]}**", "", body]
    else:
        yield body


def code(kind: str) -> str:
    """A type in words: `float` or `str`, default `0.0`."""
    words = re.split(r"( or |, optional$|, default | of )", kind)
    return "".join(one if n % 2 or not one else f"`{one}`" for n, one in enumerate(words))


def examples(body: str) -> Iterator[str]:
    """Examples as blocks, with the sentences between them."""
    for one in re.split(r"\n\s*\n", body):
        yield from ["```pycon", one, "```", ""] if one.startswith(">>>") else [one, ""]
