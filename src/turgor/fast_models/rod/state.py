"""State of rods: frames of all nodes, internal forces, forces of contact."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from turgor.fast_models.rod.frames import exponential

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class RodState:
    """Where the nodes are at one load factor; the plates are the first nodes.

    Parameters
    ----------
    turn : (n, 3, 3) array
        Rotation matrices; their columns are the axes of the node.
    position : (n, 3) array [m]
    force : (e, 6) array [N, N m]
        Net force and moment on the middle of each element: what wall and pressure carry together.
    contact : (k, n) array [N]
        Forces of the planes on the nodes.
    load_factor : float
    velocity : (n, 6) array [m/s, rad/s] or None
        Twists of the nodes by time, in their own axes; None at rest.
    """

    turn: Array
    position: Array
    force: Array
    contact: Array
    load_factor: float = 0.0
    velocity: Array | None = None

    def moved(self, twists: Array, force: Array) -> "RodState":
        """Return the state moved by twists of the nodes (n, 6), with a change of the internal forces (e, 6)."""
        turn, shift = exponential(twists)
        return replace(
            self,
            turn=self.turn @ turn,
            position=self.position + (self.turn @ shift[:, :, None])[:, :, 0],
            force=self.force + force,
        )
