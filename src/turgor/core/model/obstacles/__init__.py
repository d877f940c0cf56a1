"""Obstacles: rigid bodies that the actuator may touch, a file for each shape."""

from turgor.core.model.obstacles.box import Box as Box
from turgor.core.model.obstacles.cylinder import Cylinder as Cylinder
from turgor.core.model.obstacles.obstacle import Obstacle as Obstacle
from turgor.core.model.obstacles.obstacle import Path as Path
from turgor.core.model.obstacles.obstacle import Plate as Plate
from turgor.core.model.obstacles.obstacle import SelfContact as SelfContact
from turgor.core.model.obstacles.obstacle import check_friction as check_friction
from turgor.core.model.obstacles.plane import Plane as Plane
from turgor.core.model.obstacles.rigid_shape import RigidShape as RigidShape
from turgor.core.model.obstacles.rigid_shape import Vector as Vector
from turgor.core.model.obstacles.rigid_surface import RigidSurface as RigidSurface
from turgor.core.model.obstacles.sphere import Sphere as Sphere
from turgor.core.model.obstacles.triangulated_shape import TriangulatedShape as TriangulatedShape
