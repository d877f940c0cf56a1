"""turgor: finite element modeling of soft fluidic actuators, from a specimen to a design decision.

The names that most scripts need are here: ``import turgor as tg``. The others stand in namespaces, such as
``tg.actuators``, ``tg.laws`` and ``tg.measures``. Every name is imported on first use, so that a command that only
reads a file or prints an error does not wait for the engine. ``__init__.pyi`` lists the names, in the one form that
type checkers, editors and the lines below all read.
"""

import warnings
from importlib import import_module
from importlib.metadata import version
from typing import Any

from turgor._lazy import found, names_in

_NAMES = names_in(__file__)
_NAMESPACES = sorted(name for name, source in _NAMES.items() if source == "turgor")

#: Names of the release before that have another name now.
_RENAMED = {"Step": "Edit", "TestError": "FitResidual"}

#: Names of the release before that something else does now.
_INSTEAD = {
    "BlockedForce": "solve(setups.blocked_force(model, ...))",
    "Grasp": "solve(setups.grasp(model, ...), Static(max_step=0.1))",
}

__version__ = version("turgor")
__all__ = sorted(_NAMES)


def __getattr__(name: str) -> Any:
    if name in _NAMESPACES:
        return import_module(f"turgor.{name}")
    if name in _NAMES or name.startswith("_"):
        return found(name, _NAMES, globals())
    return _moved(name)


def __dir__() -> list[str]:
    return sorted({*globals(), *_NAMES})


def _moved(name: str) -> Any:
    """Give a name that stood here in the release before, and say where it is now."""
    now = _RENAMED.get(name, name)
    for each in _NAMESPACES:
        namespace = import_module(f"turgor.{each}")
        if now in namespace.__all__:
            warnings.warn(f"turgor.{name} is turgor.{each}.{now} now.", DeprecationWarning, stacklevel=3)
            return getattr(namespace, now)
    hint = f"; write {_INSTEAD[name]}" if name in _INSTEAD else ""
    raise AttributeError(f"module 'turgor' has no attribute '{name}'{hint}")
