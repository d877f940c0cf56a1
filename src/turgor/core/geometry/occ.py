"""The CAD kernel, loaded when a shape is first made: a run that finds its mesh on disk does without.

Names are those of ``netgen.occ``.
"""

from typing import Any


def __getattr__(name: str) -> Any:
    import netgen.occ

    return getattr(netgen.occ, name)
