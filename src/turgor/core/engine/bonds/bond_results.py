"""Bonds of a state: damage, distance and the energy that was spent, on the faces between bodies."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.bonds.bond_term import BondTerm, bond_terms
from turgor.core.engine.cells.internal_variables import Memory, bonds_of
from turgor.core.engine.term import Setting
from turgor.core.model.model import Model
from turgor.foundation.display import brief

Array = NDArray[np.float64]

#: Damage from which a point counts as open: the traction is gone up to a millionth.
OPEN = 1 - 1e-6


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BondResult:
    """Bond in a state, at the points of its sides.

    Parameters
    ----------
    name : str
    place : (k, q, 3) array [m]
        Places at rest.
    area : (k, q) array [m²]
        Area at rest that belongs to each point, of the modeled part.
    bonded : (k, q) bool array
        Where it was bonded at rest: all but the flaw.
    damage : (k, q) array [-]
        0 as new, 1 open.
    gap : (k, q) array [m]
        Distance across the bond.
    use : (k, q) array [-]
        Opening and slip over those at the strength, λ: damage begins at 1.
    energy : (k, q) array [J/m²]
        Energy per area that the damage has taken.
    nodal_damage : (n,) array [-]
        Damage at the nodes of the mesh on both sides, zero elsewhere.
    """

    name: str
    place: Array
    area: Array
    bonded: NDArray[np.bool_]
    damage: Array
    gap: Array
    use: Array
    energy: Array
    nodal_damage: Array

    __repr__ = brief

    @property
    def opened(self) -> NDArray[np.bool_]:
        """Where the bond has opened since the start, (k, q)."""
        return np.asarray(self.bonded & (self.damage >= OPEN))

    @property
    def mean_damage(self) -> float:
        """Mean of the damage over the area that was bonded at rest."""
        area = self.area * self.bonded
        return float((area * self.damage).sum() / area.sum()) if area.any() else 0.0


def bond_results(model: Model, displacement: Array, memory: Memory | None) -> dict[str, BondResult]:
    """Return the bonds of a state by their names.

    Parameters
    ----------
    model : Model
    displacement : (n, 3) array [m]
    memory : Memory or None
        That of the state.

    Returns
    -------
    dict
        Empty for a model without bonds.
    """
    known, rest = bonds_of(memory), model.mesh.points
    return {term.name: _result(term, (rest, displacement), known.get(term.name)) for term in terms_of(model)}


def terms_of(model: Model) -> list[BondTerm]:
    """The terms of the bonds of a model in SI units."""
    if not model.bonds:
        return []
    points = model.mesh.points
    return list(bond_terms(Setting(model, points, np.zeros(points.shape, dtype=bool), np.empty((0, 0)), 1.0, 1.0)))


def _result(term: BondTerm, at: tuple[Array, Array], memory: Array | None) -> BondResult:
    damage = term.start if memory is None else memory[0]
    points, displacement = at
    use, gap = term.use(points + displacement)
    return BondResult(
        name=term.name, place=np.einsum("qa,fai->fqi", term.table.N, points[term.sides]), area=term.weights,
        bonded=term.start == 0, damage=damage, gap=gap, use=use,
        energy=np.zeros_like(damage) if memory is None else memory[1],
        nodal_damage=_at_nodes(term, damage, len(points)),
    )  # fmt: skip


def _at_nodes(term: BondTerm, damage: Array, count: int) -> Array:
    """Mean damage of the sides around each node, weighted by area."""
    out = np.zeros(count)
    of_side, area = (term.weights * damage).sum(axis=1), term.weights.sum(axis=1)
    for nodes in (term.sides, term.partners):
        flat, corners = nodes.ravel(), nodes.shape[1]
        total = np.bincount(flat, np.repeat(of_side, corners), count)
        whole = np.bincount(flat, np.repeat(area, corners), count)
        out = np.maximum(out, np.divide(total, whole, out=np.zeros(count), where=whole > 0))
    return out
