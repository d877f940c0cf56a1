"""Evaluation: the residual at given unknowns, with what the tangent needs again, and the stresses."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.additions import Addition
from turgor.core.engine.cells.cell_materials import Isochoric
from turgor.core.engine.cells.internal_variables import History
from turgor.core.engine.contact.terms import Contacts

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Stresses:
    """Second Piola–Kirchhoff stresses that enter the geometric stiffness, scaled.

    Parameters
    ----------
    cells : (c, q, 7) array
        Six components, and the mean stress of the volume penalty.
    terms : sequence of array
        Those of each term, such as membranes and fibers.
    """

    cells: Array
    terms: Sequence[Array]

    @staticmethod
    def combine(parts: "Sequence[tuple[float, Stresses]]") -> "Stresses":
        """Weighted sum, for extrapolation."""
        cells = sum(weight * part.cells for weight, part in parts)
        weights, columns = [weight for weight, _ in parts], zip(*(part.terms for _, part in parts), strict=True)
        terms = [np.asarray(sum(w * a for w, a in zip(weights, column, strict=True))) for column in columns]
        return Stresses(np.asarray(cells), terms)


@dataclass(frozen=True, slots=True, eq=False)
class Evaluation:
    """The residual at given unknowns, and what the tangent needs again.

    Parameters
    ----------
    unknowns : (size,) array
        Scaled displacement, node by node along the directions of each, then scaled mean stress.
    load_factor : float
    residual : (size,) array
        Internal minus external force; then the violation of the volume constraint.
    external : (size,) array
        External force alone.
    isochoric : Isochoric
        What the laws say at all points, scaled.
    contacts : Contacts
        The contacts found.
    contact_force : float
        Size of the contact forces on the free nodes.
    unknown_pressures : (k,) array or None
        Scaled pressures of the controlled faces.
    history : History
        What rubber and friction brought into the step.
    addition : Addition or None
        Forces besides those of the model.
    """

    unknowns: Array
    load_factor: float
    residual: Array
    external: Array
    isochoric: Isochoric
    contacts: Contacts
    contact_force: float
    unknown_pressures: Array | None
    history: History
    addition: Addition | None = None
