"""The mesh generator, loaded when a mesh is first made: a run that finds its mesh on disk does without.

Names are those of ``netgen.meshing``.
"""

from typing import Any


def __getattr__(name: str) -> Any:
    import netgen.meshing

    return getattr(netgen.meshing, name)
