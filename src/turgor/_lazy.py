"""Public names that are imported on first use.

A stub (``.pyi``) beside a module lists its names, one line each. Type checkers and editors read the stub as what the
module holds; `names_in` reads the same lines as where to import each name from.
"""

import re
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

_LINE = re.compile(r"^from (\S+) import (\w+) as \2$", re.MULTILINE)


def names_in(file: str) -> dict[str, str]:
    """Read the stub of a module: for each public name, the module that defines it.

    Parameters
    ----------
    file : str
        ``__file__`` of the module.

    Returns
    -------
    dict of str to str
    """
    return {name: source for source, name in _LINE.findall(Path(file).with_suffix(".pyi").read_text("utf-8"))}


def found(name: str, names: dict[str, str], held: dict[str, Any]) -> Any:
    """Import a public name and keep it in its module, so that the next use finds it at once.

    Parameters
    ----------
    name : str
    names : dict of str to str
        What `names_in` gave.
    held : dict of str to object
        ``globals()`` of the module.

    Returns
    -------
    object

    Raises
    ------
    AttributeError
        If there is no such name.
    """
    if name not in names:
        raise AttributeError(f"module '{held['__name__']}' has no attribute '{name}'")
    held[name] = getattr(import_module(names[name]), name)
    return held[name]


def public(file: str, held: dict[str, Any]) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Make ``__getattr__``, ``__dir__`` and ``__all__`` of a module whose names stand in its stub.

    Parameters
    ----------
    file : str
        ``__file__`` of the module.
    held : dict of str to object
        Its ``globals()``.

    Returns
    -------
    tuple
    """
    names = names_in(file)
    return lambda name: found(name, names, held), lambda: sorted({*held, *names}), sorted(names)
