"""What a case of the truth set is: an actuator, its materials, what holds and drives it, and what is measured."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import turgor as tg
from turgor.units import kPa

NO_CONTACT = tg.Contact(self_contact=False)
#: Steps of the set, as times the default size; those that are refined start from the default one.
STEPS = {"double": 2.0, "default": 1.0, "half": 0.5, "quarter": 0.25, "target": 1.0, "refined": 1.0, "graded": 1.0}
#: The step with a size of its own and short cells beside sharp edges.
GRADED = "graded"
#: Those whose mesh error is estimated.
ESTIMATED = ("double", "default", "half")


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A loaded actuator.

    Parameters
    ----------
    name : str
        Short name, for the command line and the table of values.
    title : str
        What it is, with its pressure and materials.
    actuator : dataclass of dimensions
        Makes the geometry with its ``build()``.
    materials : mapping of str to Material, Shell or Membrane
        As `turgor.Model` takes them.
    pressures : mapping of str to float [kPa]
        Pressure of each cavity, by its face.
    measures : tuple of Measure
        What the case is made for; the first one is the headline.
    third_order_size : float [mm]
        Mesh size of the independent code.
    kinds : tuple of str
        Cells that the family can be filled with.
    jumps : bool
        Whether the mean stress jumps inside the body, so that the element of the version before is compared at more
        sizes than the default one.
    face_sizes : mapping of str to float [mm]
        Smaller sizes of the independent code for some faces.
    bisections : tuple of float
        Shares of the cells of the independent code that are bisected, round by round.
    layers : int
        Layers of thin cells of the independent code along re-entrant edges, each an eighth as thick as the next one.
    layered_rims : bool
        Whether the rims of held faces and of borders between regions get such layers too.
    graded : (float, float) or None [mm]
        Where sharp edges decide the error: size of hexahedra, and length of those beside the edges, for the reference.
    confirmed : str
        Step of the hexahedra that confirm the third order where none are graded.
    first : str
        Whose values are the reference: of the third order, of hexahedra, or the mean of both discretizations.
    """

    name: str
    title: str
    actuator: Any
    materials: Mapping[str, Any]
    pressures: Mapping[str, float]
    measures: tuple[tg.measures.Measure, ...]
    third_order_size: float
    supports: tuple[Any, ...] = (tg.Fixed("fixed"),)
    reinforcements: tuple[tg.Fibers, ...] = ()
    contact: tg.Contact = NO_CONTACT
    kinds: tuple[str, ...] = ("tetrahedra", "hexahedra")
    jumps: bool = False
    face_sizes: Mapping[str, float] = field(default_factory=dict)
    bisections: tuple[float, ...] = (0.1, 0.02)
    layers: int = 0
    layered_rims: bool = False
    graded: tuple[float, float] | None = None
    confirmed: str = "half"
    first: str = "third order"

    @property
    def touches(self) -> bool:
        """Whether walls meet each other or an obstacle, which the independent code cannot model."""
        return self.contact.self_contact is not None or bool(self.contact.obstacles)

    def model(self, mesh: tg.Mesh, formulation: str = "mixed") -> tg.Model:
        """The question on a mesh."""
        return tg.Model(
            mesh,
            materials=self.materials,
            supports=self.supports,
            loads=[tg.Pressure(face, value * kPa) for face, value in self.pressures.items()],
            formulation=formulation,
            reinforcements=self.reinforcements,
            contact=self.contact,
        )
