"""Names of the bodies of a mesh, from those of their regions and faces."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from turgor.core.meshing.bodies.bodies import find_bodies
from turgor.core.meshing.mesh import Mesh
from turgor.foundation.errors import TurgorError, unknown


@lru_cache(maxsize=4)  # measures of every state need it
def named_bodies(mesh: Mesh) -> dict[str, NDArray[np.int64]]:
    """Find the nodes of each body by its name, which `together` appended to the names of its regions and faces.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    dict of str to (n,) int array
        Empty where the names of a part have no common ending, as those of a single actuator.

    Examples
    --------
    >>> from turgor.core.geometry.solids import Block
    >>> from turgor.core.meshing.bodies.combine import together
    >>> from turgor.core.meshing.bodies.placing import placed
    >>> from turgor.core.meshing.generate import mesh
    >>> cube = mesh(Block().build(), size=20e-3)
    >>> list(named_bodies(together({"left": cube, "right_2": placed(cube, shift=(0.03, 0, 0))})))
    ['left', 'right_2']
    """
    out = {}
    for body in find_bodies(mesh):
        common = {name for name in body.faces if name.startswith("joint_") or name in mesh.cut_faces}
        names = [name for name in (*body.regions, *body.faces) if name not in common]
        endings = (names[0][k + 1 :] for k, letter in enumerate(names[0]) if letter == "_") if names[1:] else ()
        shared = next((ending for ending in endings if all(name.endswith(f"_{ending}") for name in names)), None)
        if shared is not None:
            out[shared] = body.nodes
    return out


def nodes_of_body(mesh: Mesh, name: str) -> NDArray[np.int64]:
    """Return the nodes of the body of a name.

    Parameters
    ----------
    mesh : Mesh
    name : str

    Returns
    -------
    (n,) int array

    Raises
    ------
    TurgorError
        If the mesh has no such body.
    """
    bodies = named_bodies(mesh)
    if not bodies:
        raise TurgorError(f"there is no body '{name}': the mesh is one actuator, and its parts have no names.")
    if name not in bodies:
        raise unknown("body", name, bodies)
    return bodies[name]
