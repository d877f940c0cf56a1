"""Directions along the axes, as procedures name them, and what can be added to a contact."""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from turgor.errors import TurgorError
from turgor.meshing.mesh import Mesh
from turgor.model.contact import Contact
from turgor.model.obstacles import Obstacle, Vector

#: Unit vectors by name.
DIRECTIONS: Mapping[str, Vector] = MappingProxyType(
    {
        "+x": (1.0, 0.0, 0.0), "-x": (-1.0, 0.0, 0.0), "+y": (0.0, 1.0, 0.0),
        "-y": (0.0, -1.0, 0.0), "+z": (0.0, 0.0, 1.0), "-z": (0.0, 0.0, -1.0),
    }
)  # fmt: skip


def mirrored_axes(mesh: Mesh) -> tuple[int, ...]:
    """Return the axes across which a half or quarter model is cut: 0, 1 or 2 for every face ``symmetry_*``."""
    return tuple(int(np.ptp(mesh.points[mesh.face_nodes(name)], axis=0).argmin()) for name in mesh.symmetry_faces)


def unmirrored(mesh: Mesh, vector: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a vector (3,) without the parts that the mirror images of the modeled part take back."""
    out = np.array(vector, dtype=np.float64)
    out[list(mirrored_axes(mesh))] = 0.0
    return out


def check_unmirrored(mesh: Mesh, what: str, direction: str) -> None:
    """Refuse a direction across a mirror plane."""
    if "xyz".index(direction[1]) in mirrored_axes(mesh):
        raise TurgorError(
            f"{what} is '{direction}', across the mirror plane of a half model; model the whole actuator "
            "(symmetric=False), or choose a direction in the plane."
        )


def with_obstacles(contact: Contact, what: str, added: tuple[Obstacle, ...]) -> Contact:
    """Return a contact with further obstacles; ``what`` adds them, for the message if a name is taken.

    Examples
    --------
    >>> from turgor.model.obstacles import Plane
    >>> floor = Obstacle(name="floor", shape=Plane(point=(0, 0, 0), normal=(0, 0, 1)))
    >>> [each.name for each in with_obstacles(Contact(), "the test", (floor,)).obstacles]
    ['floor']
    """
    taken = {obstacle.name for obstacle in contact.obstacles}
    for obstacle in added:
        if obstacle.name in taken:
            raise TurgorError(f"{what} adds an obstacle '{obstacle.name}', but the model has one; rename that one.")
    return with_contact(contact, (*contact.obstacles, *added))


def with_contact(contact: Contact, obstacles: tuple[Obstacle, ...]) -> Contact:
    """Return a contact with other obstacles and the rest as it was."""
    return contact.with_obstacles(obstacles)
