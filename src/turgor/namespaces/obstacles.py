"""Obstacles: rigid shapes that an actuator touches."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.model.obstacles import Box as Box
    from turgor.core.model.obstacles import Cylinder as Cylinder
    from turgor.core.model.obstacles import Obstacle as Obstacle
    from turgor.core.model.obstacles import Plane as Plane
    from turgor.core.model.obstacles import RigidShape as RigidShape
    from turgor.core.model.obstacles import RigidSurface as RigidSurface
    from turgor.core.model.obstacles import SelfContact as SelfContact
    from turgor.core.model.obstacles import Sphere as Sphere
    from turgor.core.model.obstacles import TriangulatedShape as TriangulatedShape
    from turgor.core.model.rigid import read_rigid as read_rigid
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
