"""Settings of meshes from files: every number that was chosen, with its reason."""

from dataclasses import dataclass

from turgor.units import deg


@dataclass(frozen=True, slots=True)
class MeshFileSettings:
    """Tolerances for equal, plane and curved sides and for cavities in a mesh from a file (`test_exchange_mending`).

    Parameters
    ----------
    mirror_off : float
        Nodes of a mirror plane that are further off it than this share of the size are no slips.
    least_turn, most_turn : float [rad]
        Boundary sides that meet at an angle in this range show a curved surface made of flat pieces.
    curved_share : float
        Share of edges at such angles from which on a surface counts as curved.
    same_node : float
        Nodes nearer to each other than this share of the shortest cell edge are one node written twice.
    on_surface : float
        A side lies on a surface when its corners and middle are nearer than this share of its mean edge.
    pocket : float
        Sides on a surface are an open cavity where they make more than this share of it; the rest are openings.
    near : float
        An inner surface that lies nowhere further away than this share of the cavity's size is taken for it.
    volume : float
        Cells fill a surface, and a turned section a part, up to this share of the volume: free-form edges miss less.
    """

    mirror_off: float = 0.02
    least_turn: float = 2 * deg
    most_turn: float = 45 * deg
    curved_share: float = 0.05
    same_node: float = 1e-3
    on_surface: float = 0.05
    pocket: float = 0.5
    near: float = 0.15
    volume: float = 1e-3


MESH_FILE = MeshFileSettings()
