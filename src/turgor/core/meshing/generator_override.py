"""Override of the mesh generator, while a function runs that would generate a mesh."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from turgor.core.geometry.geometry import Geometry
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.settings import MeshSettings

#: ``make(geometry, settings) -> Mesh``.
Make = Callable[[Geometry, MeshSettings], Mesh]

#: What makes meshes instead of the generator; None where that does.
INSTEAD: ContextVar[Make | None] = ContextVar("instead", default=None)


@contextmanager
def meshing_instead(make: Make | None) -> Iterator[None]:
    """Let a function make meshes instead of the generator, as long as the block runs.

    A model as a function of its dimensions generates a mesh by itself, wherever it wants to. So a mesh that moves can
    take the place of the one that it would generate, and nothing is generated in vain.

    Parameters
    ----------
    make : callable or None
        ``make(geometry, settings) -> Mesh``; None for the generator.
    """
    before = INSTEAD.set(make)
    try:
        yield
    finally:
        INSTEAD.reset(before)
