"""Settings of the shape measures: every number that was chosen, with its reason."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ShapeSettings:
    """Settings of center lines, sections and widths, tested in `tests/unit/core/results/shape`.

    Parameters
    ----------
    no_direction : float
        A line shorter than this share of the part, or a turn smaller than this [rad], has no direction: no plane,
        radius and pitch. Points whose thickness is less than this share of their extent lie in a plane, or on a line.
    center_line_pieces : tuple of int
        Numbers of pieces along the actuator; the first one for which the mesh is fine enough is taken.
    strain_sections : int
        Cross-sections between two stations.
    fewest_points : int
        Integration points that each piece must have for its map to be known.
    points_apart : int
        Points along a cell for each distance of sections that it is long.
    directions : int
        Directions across the actuator in which its width is measured, over half a turn.
    parts_of_edge : int
        Parts of each edge of a side of a cell, at whose corners the surface is sampled for its width.
    """

    no_direction: float = 1e-3
    center_line_pieces: tuple[int, ...] = (16, 12, 8, 6, 4)
    strain_sections: int = 5
    fewest_points: int = 40
    points_apart: int = 3
    directions: int = 12
    parts_of_edge: int = 4


SHAPE = ShapeSettings()
