"""MeshSettings: how a geometry is meshed."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshSettings:
    """How a geometry is meshed; `mesh` says what each setting does, and checks it against the geometry.

    Parameters
    ----------
    size : float or None [m]
        Largest edge length aimed at; None takes `default_size` of the cells and the quality.
    quality : str
        ``"draft"``, ``"normal"`` or ``"fine"``: the mesh error that is requested, 10 %, 2 % or 0.5 %.
    grading : float [-]
        How fast cells may grow away from small ones: 0.1 slowly, 1 at once.
    face_sizes : mapping of str to float [m]
        Smaller sizes for some faces, by name.
    wall_cells : int
        Cells at least through every wall: 1 to 4.
    cells : str or None
        ``"tetrahedra"``, ``"hexahedra"`` or ``"axisymmetric"``; None takes what suits the geometry, see
        `chosen_settings`.
    ignore_features_below : float or None [m]
        Fillets and other rounds of a smaller radius make cells no smaller; None decides by itself.

    Examples
    --------
    >>> MeshSettings(size=2e-3).grading
    0.5
    """

    size: float | None = None
    quality: str = "normal"
    grading: float = 0.5
    face_sizes: Mapping[str, float] = field(default_factory=dict)
    wall_cells: int = 1
    cells: str | None = None
    ignore_features_below: float | None = None
