"""Hash of the source of a study's function, so that runs of older code are not taken for those of the present one."""

import ast
import hashlib
import inspect
import sys
from collections.abc import Callable
from textwrap import dedent
from types import FunctionType
from typing import Any

from turgor.studies.runs.settings import RUNS


def code_digest(function: Callable[..., Any]) -> str:
    """Return a hash of the source of a function, and of the functions, classes and constants of its file that it names.

    A change elsewhere in the file, such as of a plot, leaves the hash as it is. Other modules are not looked at.

    Parameters
    ----------
    function : callable
        Function of a module.

    Returns
    -------
    str
        Empty for functions of turgor, whose saved runs stay, and where there is no source.

    Examples
    --------
    >>> code_digest(code_digest)
    ''
    """
    module = sys.modules.get(function.__module__)
    if module is None or module.__name__.split(".")[0] == "turgor":
        return ""
    waiting: list[Any] = [inspect.unwrap(function)]
    sources: dict[str, str] = {}
    while waiting:
        each = waiting.pop()
        text = _source(each)
        sources[each.__qualname__] = text
        for name in _names(text):
            member = vars(module).get(name)
            if isinstance(member, FunctionType | type):
                if member.__module__ == module.__name__ and member.__qualname__ not in sources:
                    waiting.append(member)
            elif isinstance(member, int | float | str | tuple):
                sources[name] = repr(member)
    if not any(sources.values()):
        return ""
    return hashlib.sha256(repr(sorted(sources.items())).encode()).hexdigest()[: RUNS.letters]


def _source(each: Any) -> str:
    try:
        return dedent(inspect.getsource(each))
    except (OSError, TypeError):  # typed at a prompt, or compiled
        return ""


def _names(text: str) -> list[str]:
    try:
        tree = ast.parse(text)
    except SyntaxError:  # a function inside an expression
        return []
    return sorted({node.id for node in ast.walk(tree) if isinstance(node, ast.Name)})
