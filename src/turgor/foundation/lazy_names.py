"""Public names that are imported on first use.

A module lists its names as imports under ``if TYPE_CHECKING``, one line each. Type checkers and editors follow these
lines; they do not run. `names_in` reads the same lines as where to import each name from.
"""

import re
from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

_LINE = re.compile(r"^    from (\S+) import (?:\(\s*)?(\w+) as \2,?$", re.MULTILINE)


def names_in(file: str) -> dict[str, str]:
    """Read the public names of a module: for each of them the module that defines it.

    Parameters
    ----------
    file : str
        ``__file__`` of the module.

    Returns
    -------
    dict of str to str
    """
    return {name: source for source, name in _LINE.findall(Path(file).read_text("utf-8"))}


def imported(name: str, names: dict[str, str], namespace: dict[str, Any]) -> Any:
    """Import a public name and store it in its module, so that the next use finds it at once.

    Parameters
    ----------
    name : str
    names : dict of str to str
        What `names_in` gave.
    namespace : dict of str to object
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
        raise AttributeError(f"module '{namespace['__name__']}' has no attribute '{name}'")
    source = names[name]
    module = import_module(source)
    # a namespace is a module of the package, which has no such name before it is imported
    inside = source == namespace["__name__"] or not hasattr(module, name)
    namespace[name] = import_module(f"{source}.{name}") if inside else getattr(module, name)
    return namespace[name]


def public(file: str, namespace: dict[str, Any]) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Make ``__getattr__``, ``__dir__`` and ``__all__`` of a module that lists its public names.

    Parameters
    ----------
    file : str
        ``__file__`` of the module.
    namespace : dict of str to object
        Its ``globals()``.

    Returns
    -------
    tuple
    """
    names = names_in(file)
    return partial(imported, names=names, namespace=namespace), lambda: sorted({*namespace, *names}), sorted(names)
