"""What the contact cases share: blocks against obstacles, and how contact is read from a state. Units of `problems`."""

import numpy as np

import meshes
import problems
import turgor as tg
from problems import MM
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Obstacle, RigidShape, RigidSurface
from turgor.core.solvers.solution import State, Touch

#: Contact stiffness [Pa/m] at which 0.1 MPa of pressure penetrates by 1 µm.
STIFF = 1e11

#: Newton tolerance where a statement holds exactly.
EXACT = tg.Static(first_step=0.1, max_step=0.1, tolerance=1e-10)


def pushed(shape: RigidShape, way: tuple[float, float, float] = (0.0, 0.0, 0.0), **more) -> Obstacle:
    """An obstacle called ``plate`` that moves along ``way`` [mm] in proportion to the load factor."""
    path = () if not any(way) else ((0, (0, 0, 0)), (1, tuple(np.array(way) * MM)))
    return Obstacle(**{"name": "plate", "shape": shape, "path": path, "stiffness": STIFF} | more)


def block(counts=(3, 3, 2), size=(10, 10, 5), kind=HEXAHEDRON, place=None) -> tg.Mesh:
    """A block from the origin to ``size`` [mm], faces x0 … z1."""
    return meshes.box(tuple(np.array(size) * MM), counts, place, kind=kind)


def standing(mesh: tg.Mesh, *obstacles: Obstacle, supports=(), loads=(), law=problems.NEO_HOOKE) -> tg.Model:
    """A body of incompressible rubber that stands on z0, clamped there, with obstacles around and no self-contact."""
    contact = Contact(self_contact=False, obstacles=obstacles)
    materials = {"body": problems.rubber(law)}
    return tg.Model(mesh, materials, [tg.Fixed("z0"), *supports], loads, contact=contact)


def slab(thickness: float, level: float = 5.0) -> RigidSurface:
    """A closed plate of triangles, 16 mm wide, from z = ``level`` upwards; its thickness and level in mm."""
    heights = (level, level + thickness)
    corners = np.array([[x, y, z] for z in heights for y in (-3, 13) for x in (-3, 13)], dtype=float) * MM
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    triangles = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    return RigidSurface(points=corners, triangles=triangles)


def push(touch: Touch) -> np.ndarray:
    """Force of a contact on the modeled part, (3,) [N]."""
    return np.asarray(touch.force.sum(axis=0))


def moment(state: State, touch: Touch, about=(0.0, 0.0, 0.0)) -> np.ndarray:
    """Moment of a contact's forces on the modeled part about a point, (3,) [N m]."""
    return np.asarray(np.cross(problems.current(state) - np.array(about), touch.force).sum(axis=0))


def apart(one, other) -> float:
    """Largest difference over the largest value."""
    return float(np.abs(np.asarray(one) - other).max() / np.abs(other).max())
