"""The CAD kernel, loaded when a shape is first made: a run that finds its mesh on disk does without.

Names are those of ``netgen.occ``.
"""

from importlib import import_module
from typing import Any


def __getattr__(name: str) -> Any:
    return getattr(import_module("netgen.occ"), name)
