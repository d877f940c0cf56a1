"""Terms: the one list of what adds to the equations besides cells and contact, and the sums over it."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from turgor.core.engine.algebra.pattern import Pattern, locate, scatter_add
from turgor.core.engine.bonds.bond_term import BondTerm, bond_terms
from turgor.core.engine.cables.cables import cable_terms
from turgor.core.engine.cells.internal_variables import NOTHING
from turgor.core.engine.centrifugal_term import centrifugal_terms
from turgor.core.engine.faces.dead_loads import dead_terms
from turgor.core.engine.faces.membrane_term import membrane_terms
from turgor.core.engine.faces.plate_edges import plate_terms
from turgor.core.engine.faces.pressure_term import PressureTerm, pressure_terms
from turgor.core.engine.faces.states.sheet_state_term import sheet_state_terms
from turgor.core.engine.faces.thrust_term import ThrustTerm, thrust_terms
from turgor.core.engine.fibers.fiber_term import fiber_terms
from turgor.core.engine.liquids.liquid_term import liquid_terms
from turgor.core.engine.points.average_term import average_terms
from turgor.core.engine.points.bearing_term import bearing_terms
from turgor.core.engine.points.foundation_term import foundation_terms
from turgor.core.engine.points.rigid_term import rigid_terms
from turgor.core.engine.points.spring_term import spring_terms
from turgor.core.engine.points.turning_term import turning_terms
from turgor.core.engine.term import Configuration, Setting, Term

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

#: What makes the terms of a model. A new kind of term is a file with its class, and one name here; a load may bring its
#: own.
TERMS: tuple[Callable[[Setting], Sequence[Term]], ...] = (
    pressure_terms,
    thrust_terms,
    liquid_terms,
    centrifugal_terms,
    membrane_terms,
    sheet_state_terms,
    plate_terms,
    foundation_terms,
    fiber_terms,
    cable_terms,
    dead_terms,
    rigid_terms,
    average_terms,
    bearing_terms,
    spring_terms,
    turning_terms,
    bond_terms,
    lambda setting: [term for load in setting.model.loads for term in load.terms(setting)],
)


class Terms:
    """Sums over all terms of a model, in scaled units.

    Parameters
    ----------
    setting : Setting
    """

    def __init__(self, setting: Setting) -> None:
        self.all: list[Term] = [term for make in TERMS for term in make(setting)]
        mesh = setting.model.mesh
        self._middles = np.unique(mesh.cells[:, mesh.carrying_cells.shape[1] :])
        self._positions: list[NDArray[np.int32]] = []

    @property
    def symmetric(self) -> bool:
        """Whether all forces have a potential."""
        return all(term.symmetric for term in self.all)

    @property
    def couplings(self) -> list[Ints]:
        """Degrees of freedom that are tied across cells or at middles that follow, a row for each tie."""
        return [term.unknowns for term in self.all if term.couples or self._ends_at_middles(term)]

    def _ends_at_middles(self, term: Term) -> bool:
        """Whether a term has forces on middles that follow, which no cell couples."""
        return bool(len(self._middles)) and bool(np.isin(term.unknowns // 3, self._middles).any())

    def locate(self, pattern: Pattern) -> None:
        """Find where the entries of all terms go in the tangent."""
        self._positions = []
        for term in self.all:
            unknowns = term.unknowns
            rows, columns = np.tril_indices(unknowns.shape[1])
            entries = (unknowns[:, rows].ravel(), unknowns[:, columns].ravel())
            self._positions.append(locate(pattern.indptr, pattern.indices, *entries))

    def forces(self, at: Configuration) -> tuple[Array, Array]:
        """Internal forces, and external forces of loads, (n, 3) each."""
        internal, external = np.zeros_like(at.position), np.zeros_like(at.position)
        for term in self.at(at.load_factor):
            term.add_forces(external if term.external else internal, at)
        return internal, external

    def at(self, load_factor: float) -> list[Term]:
        """All terms at a load factor."""
        return [term.at(load_factor) for term in self.all]

    def unit_forces(self, position: Array, count: int) -> list[Array]:
        """External forces (n, 3) of a scaled pressure of one on each of the first ``count`` controlled faces."""
        pressed = [term for term in self.all if isinstance(term, PressureTerm | ThrustTerm)]
        by_place = [[term.unit_forces(position) for term in pressed if term.place == place] for place in range(count)]
        return [np.sum(forces, axis=0) for forces in by_place]

    @property
    def bonds(self) -> list[BondTerm]:
        """The terms of bonds."""
        return [term for term in self.all if isinstance(term, BondTerm)]

    @property
    def remembering(self) -> list[Term]:
        """The terms with internal variables: bonds, wires and cables with friction."""
        return [term for term in self.all if term.memory_key]

    def energy(self, position: Array, load_factor: float, bonds: Mapping[str, Array] = NOTHING) -> float:
        """Scaled energy that all terms store, with internal variables of bonds; those at rest if none are given."""
        stored = sum((term.energy(position) for term in self.at(load_factor)), 0.0)
        return stored + sum(term.stored(position, bonds.get(term.name)) for term in self.bonds)

    def remembered(self, at: Configuration) -> dict[str, Array]:
        """Internal variables of the terms at the end of a step."""
        return {term.memory_key: term.remembered(at) for term in self.remembering}

    def stresses(
        self, at: Configuration, update: Array | None = None, last: Sequence[Array] | None = None
    ) -> list[Array]:
        """Stresses of each term, linearized for an update where one is given; ``last`` are those before it."""
        update, terms = np.zeros_like(at.position) if update is None else update, self.at(at.load_factor)
        if last is None:
            return [term.stresses(at.position, update) for term in terms]
        return [term.continued(at.position, update, one) for term, one in zip(terms, last, strict=True)]

    def correction(self, at: Configuration, given: Sequence[Array]) -> Array | None:
        """Forces (n, 3) of the stresses that the tangent is linearized about; None where no term has any."""
        terms = self.at(at.load_factor)
        parts = (term.correction(at, stresses) for term, stresses in zip(terms, given, strict=True))
        corrections = [part for part in parts if part is not None]
        return np.sum(corrections, axis=0) if corrections else None

    def tangents(self, at: Configuration, given: Sequence[Array] | None) -> list[Array]:
        """Symmetric parts of the tangents of all terms; the given stresses enter the geometric one."""
        stresses, terms = self.stresses(at) if given is None else given, self.at(at.load_factor)
        return [term.tangents(at, stress) for term, stress in zip(terms, stresses, strict=True)]

    def add(self, data: Array, tangents: Sequence[Array]) -> None:
        """Add the tangents of all terms to the lower triangle."""
        for positions, tangent in zip(self._positions, tangents, strict=True):
            scatter_add(data, positions, tangent)

    def unsymmetric_matrix(self, at: Configuration, size: int) -> sp.csc_matrix | None:
        """Unsymmetric tangents of a few unknowns, such as those of moments; None where there are none."""
        parts = [part for term in self.all if (part := term.unsymmetric(at, size)) is not None]
        return sum(parts[1:], parts[0]).tocsc() if parts else None

    def skew_matrix(self, at: Configuration, size: int) -> sp.csc_matrix | None:
        """Skew part of the tangents of forces without a potential; None where there are none."""
        total: sp.csc_matrix | None = None
        for term in self.all:
            if term.symmetric:
                continue
            unknowns = term.unknowns
            count = unknowns.shape[1]
            rows = np.repeat(unknowns, count, axis=1).ravel()
            columns = np.tile(unknowns, (1, count)).ravel()
            part = sp.csc_matrix((term.skew(at).ravel(), (rows, columns)), shape=(size, size))
            total = part if total is None else (total + part).tocsc()
        return total
