"""Needs: which compiled loops a model has to have."""

from collections.abc import Iterable
from dataclasses import dataclass

from turgor.core.engine.contact.build import may_touch
from turgor.core.materials.laws.laws import StretchLaw
from turgor.core.materials.material import Material
from turgor.core.model.model import DISPLACEMENT, Model


@dataclass(frozen=True, slots=True, kw_only=True)
class Needs:
    """Which loops a model needs, beside those that all need.

    Parameters
    ----------
    nodes : int
        Nodes of a cell.
    mixed : bool
        Whether cells have mean stresses.
    sides : int
        Nodes of the sides that may touch each other or an obstacle; 0 where nothing can.
    stretches : bool
        Whether a law is one in stretches, or a rubber remembers.
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
        """Those of a model."""
        kind = model.mesh.cell_type
        return Needs(
            nodes=kind.nodes,
            mixed=model.formulation != DISPLACEMENT,
            sides=kind.side.nodes if may_touch(model) else 0,
            stretches=in_stretches(model.region_materials.values()),
            sheets=bool(model.membranes),
        )


def in_stretches(materials: Iterable[Material]) -> bool:
    """Whether any material needs the loops of laws in stretches."""
    return any(
        isinstance(each.law, StretchLaw) or each.viscoelasticity is not None or each.stress_softening is not None
        for each in materials
    )
