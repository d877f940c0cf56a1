"""Bodies besides the actuator: simple solids, meshes placed, mirrored and put together, and bonds between bodies."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.geometry.shapes.film_shape import Patch as Patch
    from turgor.core.geometry.solids import Ball as Ball
    from turgor.core.geometry.solids import Block as Block
    from turgor.core.geometry.solids import Film as Film
    from turgor.core.geometry.solids import RoundBar as RoundBar
    from turgor.core.meshing.bodies.combine import together as together
    from turgor.core.meshing.bodies.half import half_of as half_of
    from turgor.core.meshing.bodies.placing import mirrored as mirrored
    from turgor.core.meshing.bodies.placing import placed as placed
    from turgor.core.meshing.quality.cell_quality import MeshQuality as MeshQuality
    from turgor.core.meshing.quality.cell_quality import quality as quality
    from turgor.core.model.bonds import Bond as Bond
    from turgor.core.model.embedded import EmbeddedThreads as EmbeddedThreads
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
