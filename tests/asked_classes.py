"""Files of turgor that ask for the class of an object."""

import ast
from pathlib import Path

import turgor

ROOT = Path(turgor.__file__).parent


def files_that_ask(classes, without=()):
    """List the files, outside some folders, that ask for one of the classes by name."""
    paths = sorted(path for path in ROOT.rglob("*.py") if path.parent.relative_to(ROOT).as_posix() not in without)
    texts = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in paths}
    return [name for name, text in texts.items() if any(each in text for each in classes) and asked(text) & classes]


def asked(text):
    """Names in the second argument of isinstance, in patterns and comparisons of classes, and as keys of tables.

    Examples
    --------
    >>> sorted(asked("isinstance(a, b.Force | Moment)"))
    ['Force', 'Moment', 'b']
    >>> sorted(asked("type(a) is Force"))
    ['Force', 'a', 'type']
    >>> asked("{Gravity: 1}[type(a)]")
    {'Gravity'}
    >>> asked("match a:\\n    case Gravity():\\n        pass")
    {'Gravity'}
    """
    kinds = []
    for node in ast.walk(ast.parse(text)):
        match node:
            case ast.Call(func=ast.Name(id="isinstance" | "issubclass"), args=[_, kind]):
                kinds.append(kind)
            case ast.MatchClass(cls=kind):
                kinds.append(kind)
            case ast.Compare() if "type(" in ast.unparse(node):
                kinds.append(node)
            case ast.Dict(keys=keys):
                kinds += [key for key in keys if isinstance(key, ast.Name)]
    inner = [part for kind in kinds for part in ast.walk(kind)]
    return {getattr(part, "id", None) or getattr(part, "attr", None) for part in inner} - {None}
