"""Obstacles: rigid shapes that an actuator touches."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.model.obstacles import Box as Box
    from turgor.model.obstacles import Cylinder as Cylinder
    from turgor.model.obstacles import Obstacle as Obstacle
    from turgor.model.obstacles import Plane as Plane
    from turgor.model.obstacles import RigidSurface as RigidSurface
    from turgor.model.obstacles import SelfContact as SelfContact
    from turgor.model.obstacles import Sphere as Sphere
    from turgor.model.rigid import read_rigid as read_rigid
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
