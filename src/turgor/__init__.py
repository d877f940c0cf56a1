"""turgor: finite element modeling of soft fluidic actuators, from a specimen to a design decision.

Every public name is here, flat: ``import turgor as tg``. The rooms are imported on first use, so that a command that
only reads a file or prints an error does not wait for the engine. Which names there are says ``__init__.pyi``, in the
one form that type checkers, editors and the lines below all read.
"""

import re
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from typing import Any

_LINE = re.compile(r"^from (\S+) import (\w+) as \2$", re.MULTILINE)
_ROOM_OF = {name: room for room, name in _LINE.findall(Path(__file__).with_suffix(".pyi").read_text("utf-8"))}

__version__ = version("turgor")
__all__ = sorted(_ROOM_OF)


def __getattr__(name: str) -> Any:
    if name not in _ROOM_OF:
        raise AttributeError(f"module 'turgor' has no attribute '{name}'")
    value = getattr(import_module(_ROOM_OF[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *_ROOM_OF])
