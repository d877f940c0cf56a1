"""Needs: which kernels a model needs."""

from collections.abc import Iterable
from dataclasses import dataclass

from turgor.core.engine.contact.build import may_touch
from turgor.core.materials.laws.laws import StretchLaw
from turgor.core.materials.material import Material
from turgor.core.model.model import DISPLACEMENT, Model


@dataclass(frozen=True, slots=True, kw_only=True)
class Needs:
    """Which kernels a model needs, besides those that all models need.

    Parameters
    ----------
    nodes : int
        Nodes of an element.
    mixed : bool
        Whether elements have mean stresses.
    sides : int
        Nodes of the sides that may touch each other or an obstacle; 0 if none can.
    stretches : bool
        Whether a law is one in stretches, or a material is history-dependent.
    sheets : bool
        Whether faces have membranes.
    """

    nodes: int = 10
    mixed: bool = True
    sides: int = 0
    stretches: bool = False
    sheets: bool = False

    @staticmethod
    def of(model: Model) -> "Needs":
        """Return the needs of a model."""
        kind = model.mesh.cell_type
        return Needs(
            nodes=model.mesh.carrying_cells.shape[1],
            mixed=model.formulation != DISPLACEMENT,
            sides=kind.side.nodes if may_touch(model) else 0,
            stretches=in_stretches(model.region_materials.values()),
            sheets=bool(model.membranes),
        )


def in_stretches(materials: Iterable[Material]) -> bool:
    """Return whether any material needs the kernels of laws in stretches."""
    return any(isinstance(each.law, StretchLaw) or each.remembers for each in materials)
