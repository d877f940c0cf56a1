"""Round-off: by how much two values may differ that are equal, as a share of the size of what is compared."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RoundOffSettings:
    """Settings of comparisons.

    Parameters
    ----------
    mesh_digits : float
        Nodes of a mesh, and planes and normals from them: mesh files have seven digits, so that a plane face of a
        mesh that was read (`tests/unit/core/meshing`) is plane up to this.
    same : float
        Places, directions and sums after many operations in double precision, or numbers that a user has typed.
    zero : float
        A result of one operation in double precision that would be zero without round-off, such as sin(π).
    """

    mesh_digits: float = 1e-6
    same: float = 1e-9
    zero: float = 1e-12


ROUND_OFF = RoundOffSettings()
