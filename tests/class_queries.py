"""Which classes a file asks for: a new class of the kind would need a change there."""

import ast
from collections.abc import Collection
from pathlib import Path

import turgor

ROOT = Path(turgor.__file__).parent


def files_that_query(classes: Collection[str], without: Collection[str] = ()) -> list[str]:
    """List the files of turgor, outside some folders, that ask for one of the classes by name."""
    paths = sorted(path for path in ROOT.rglob("*.py") if path.parent.relative_to(ROOT).as_posix() not in without)
    texts = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in paths}
    named = {name: text for name, text in texts.items() if any(each in text for each in classes)}
    return [name for name, text in named.items() if queried(text) & set(classes)]


def queried(text: str) -> set[str]:
    """Return names of classes to which a file compares values.

    Examples
    --------
    >>> sorted(queried("isinstance(a, b.Force | Moment); type(a) is Spin; type(a).__name__ == 'Weight'"))
    ['Force', 'Moment', 'Spin', 'Weight', 'b']
    >>> queried("match a:\\n    case Gravity():\\n        pass"), queried("{Gravity: 1}[type(a)]")
    ({'Gravity'}, {'Gravity'})
    """
    kinds: list[ast.AST] = []
    for node in ast.walk(ast.parse(text)):
        match node:
            case ast.Call(func=ast.Name(id="isinstance" | "issubclass"), args=[_, kind]) | ast.MatchClass(cls=kind):
                kinds.append(kind)
            case ast.Compare(left=left, comparators=right) if any(map(_of_type, [left, *right])):
                kinds += [side for side in (left, *right) if not _of_type(side)]
            case ast.Dict(keys=keys):
                kinds += [key for key in keys if isinstance(key, ast.Name)]
    parts = [part for kind in kinds for part in ast.walk(kind)]
    names = {getattr(part, "id", getattr(part, "attr", getattr(part, "value", None))) for part in parts}
    return {name for name in names if isinstance(name, str)}


def _of_type(node: ast.expr) -> bool:
    """Whether an expression is the class of a value, or its name."""
    text = ast.unparse(node)
    return text.startswith("type(") or text.endswith(("__class__", "__class__.__name__"))
