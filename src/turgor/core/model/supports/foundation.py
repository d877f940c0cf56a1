"""Foundation: a face on springs, along its normal and across it."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from turgor.core.meshing.mesh import Mesh
from turgor.core.model.supports.support import Support
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity, number
from turgor.foundation.given import name as name_of
from turgor.units import kPa, mm


@dataclass(frozen=True, slots=True)
class Foundation(Support):
    """Bed a face on springs that are fixed to the ground (Winkler foundation).

    The springs push and pull in proportion to the displacement, counted from rest, along the normal that the face has
    at rest and across it. What only pushes is an obstacle.

    Parameters
    ----------
    face : str
        Name of the face.
    normal : float [Pa/m]
        Stress per displacement along the normal; 0 or more.
    tangential : float [Pa/m]
        Stress per displacement across the normal; 0 or more.

    Raises
    ------
    TurgorError
        If a stiffness is negative, or both are zero.

    Examples
    --------
    >>> Foundation("bottom", "20 kPa/mm").text()
    'bottom is bedded on springs of 20 kPa/mm along its normal and 0 kPa/mm across it.'
    """

    face: str
    normal: float = field(metadata={"dimension": "contact stiffness"}, default=0.0)
    tangential: float = field(metadata={"dimension": "contact stiffness"}, default=0.0)

    if TYPE_CHECKING:

        def __init__(self, face: str, normal: Quantity = 0.0, tangential: Quantity = 0.0) -> None: ...

    def __post_init__(self) -> None:
        what = f"foundation of '{name_of(self.face, 'face of a foundation', 'bottom')}'"
        for key in ("normal", "tangential"):
            value = number(getattr(self, key), f"{what}: {key}", "contact stiffness")
            object.__setattr__(self, key, value)
            if value < 0:
                raise TurgorError(f"{what}: {key} is {value:g} Pa/m; allowed is 0 or more.")
        if not self.normal + self.tangential > 0:
            raise TurgorError(f"{what}: normal and tangential are both 0 Pa/m; give one of them, such as '20 kPa/mm'.")

    @property
    def bedding(self) -> tuple[float, float]:
        """Stiffness per area along the normal and across it."""
        return self.normal, self.tangential

    def text(self) -> str:
        """Return the sentence of a report."""
        normal, across = (value * mm / kPa for value in self.bedding)
        return (
            f"{self.face} is bedded on springs of {normal:g} kPa/mm along its normal and {across:g} kPa/mm across it."
        )

    def check(self, mesh: Mesh) -> None:
        """Refuse a cut through the whole, which is no surface."""
        if self.face in mesh.cut_faces:
            raise TurgorError(f"foundation of '{self.face}': this face is a cut through the whole part, no surface.")

    def job_text(self) -> dict[str, object]:
        """Return the table of its stiffness."""
        stated = {"normal_stiffness": self.normal, "tangential_stiffness": self.tangential}
        return {key: f"{value * mm / kPa:.17g} kPa/mm" for key, value in stated.items() if value}
