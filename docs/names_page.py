"""The page of all public names, written from the namespaces and docstrings: `make reference` renews it.

A test compares the page with what this script writes, and asks that the reference shows every name.
"""

import ast
import inspect
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import turgor as tg

DOCS = Path(__file__).parent
SHOWN = re.compile(r"^\.\. automodule:: ([\w.]+)", re.MULTILINE)

INTRO = """\
# All public names

What may be imported, by namespace, with the first sentence of its documentation. A name leads to the page with
parameters, units, errors and an example. What is not on this page is private and may change without notice.
"""


def page() -> str:
    """Write the page."""
    tables = (
        f"\n## {name}\n\n{words}\n\n| name | what it is |\n|---|---|\n{rows}" for name, words, rows in namespaces()
    )
    return INTRO + "".join(tables)


def namespaces() -> Iterator[tuple[str, str, str]]:
    """Name, first sentence and rows of ``tg`` and of every namespace in it."""
    inner = {name: value for name in tg.__all__ if isinstance(value := getattr(tg, name), ModuleType)}
    for name, module in {"tg": tg, **{f"tg.{name}": value for name, value in inner.items()}}.items():
        rows = "".join(row(name, each, module) for each in public(module))
        yield name, sentence(module.__doc__), rows


def public(module: ModuleType) -> list[str]:
    """Names that a namespace has, without the namespaces in it."""
    names = getattr(module, "__all__", None) or [name for name in dir(module) if not name.startswith("_")]
    return [name for name in names if not isinstance(getattr(module, name), ModuleType)]


def row(namespace: str, name: str, module: ModuleType) -> str:
    """Row of one name."""
    where, value = documented_in(name, module), getattr(module, name)
    if isinstance(value, float):
        return f"| `{namespace}.{name}` | {value:.10g} in SI units |\n"
    if isinstance(value, tg.measures.Measure):
        words: str | None = f"Measure [{value.unit or '1'}]: {value.definition}."
    else:
        words = comment(where, name) or inspect.getdoc(value)
    return f"| {{py:obj}}`{namespace}.{name} <{where}.{name}>` | {sentence(words)} |\n"


def documented_in(name: str, module: ModuleType) -> str:
    """Module that the reference shows, and that holds the name."""
    value: Any = getattr(module, name)
    own = value.__module__ if hasattr(value, "__qualname__") else ""
    return own if own in shown() else imports(module).get(name, module.__name__)


def shown() -> set[str]:
    """Modules that the pages of the reference show."""
    return {name for path in sorted(DOCS.glob("reference/*.md")) for name in SHOWN.findall(path.read_text("utf-8"))}


def imports(module: ModuleType) -> dict[str, str]:
    """Module from which a namespace takes each of its names."""
    tree = ast.parse(Path(str(module.__file__)).read_text("utf-8"))
    taken = (node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module)
    return {alias.asname or alias.name: str(node.module) for node in taken for alias in node.names}


def comment(module: str, name: str) -> str:
    """Comment ``#:`` above a number or table."""
    source = Path(str(import_module(module).__file__)).read_text("utf-8")
    match = re.search(rf"((?:^#:.*\n)+){name}\b", source, re.MULTILINE)
    return " ".join(line.removeprefix("#:").strip() for line in match[1].splitlines()) if match else ""


def sentence(text: str | None) -> str:
    """First paragraph of a documentation, as Markdown in a cell."""
    first = " ".join((text or "").split("\n\n")[0].split())
    return first.replace("``", "`").replace("|", "\\|")


def main() -> None:
    """Write the page."""
    (DOCS / "reference" / "names.md").write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
