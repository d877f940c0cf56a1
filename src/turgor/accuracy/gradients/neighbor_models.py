"""Neighbors: models at nearby values of a number, in the unknowns of the model between them."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.equilibrium import Equilibrium, constraint_of
from turgor.accuracy.gradients.moved_mesh import same_cells
from turgor.accuracy.gradients.settings import GRADIENTS
from turgor.accuracy.gradients.variation import Variation
from turgor.core.engine.contact.part import SearchMode
from turgor.core.engine.contact.terms import Contacts
from turgor.core.engine.system import Evaluation, System
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.contact import Contact
from turgor.core.model.model import Model
from turgor.core.solvers.constraints.constraint import Constraint
from turgor.core.solvers.solution import State
from turgor.core.solvers.states import state_of
from turgor.foundation.errors import TurgorError
from turgor.foundation.round_off import ROUND_OFF

Array = NDArray[np.float64]

#: Steps from the value and weights of the difference quotient: central, and one-sided where one side does not exist.
#: All are exact for parabolas.
CENTRAL = ((1, 0.5), (-1, -0.5))
FORWARD = ((0, -1.5), (1, 2.0), (2, -0.5))
BACKWARD = ((0, 1.5), (-1, -2.0), (-2, 0.5))


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """The model at one value of a number: the residual of equilibrium, errors of conditions, and the equations.

    Parameters
    ----------
    at : Evaluation
    errors : (k,) array
    """

    at: Evaluation
    errors: Array


@dataclass(frozen=True, eq=False)
class Neighbor:
    """A model at a nearby value of a number, under the constraint of the state between.

    Parameters
    ----------
    base : Equilibrium
    system : System
        Scaled as that of ``base``.
    model : Model
        That of the system, with all that may touch.
    constraint : Constraint
    steps : int
        How far from the value, in steps of the difference.
    weight : float
        In the difference quotient.
    """

    base: Equilibrium
    system: System
    model: Model
    constraint: Constraint
    steps: int
    weight: float

    @cached_property
    def prescribed(self) -> Array:
        """Scaled values of the fixed unknowns."""
        return self.system.prescribed_values(self.base.state.load_factor)

    @cached_property
    def contacts(self) -> Contacts | None:
        """The partners of contact at the state, which stay; None where the parts of contact are others."""
        own, known = self.system.contact.parts, self.base.system.contact.parts
        alike = len(own) == len(known) and all(
            np.array_equal(a.surface.sides, b.surface.sides) for a, b in zip(own, known, strict=True)
        )
        return self.base.at.contacts if alike else None

    def look(self, unknowns: Array, scalars: Array) -> Place | None:
        """Evaluate equations and conditions at changes of unknowns and scalars; None where a cell turns inside out."""
        base, factor = self.base, self.base.state.load_factor
        place = base.at.unknowns + unknowns, base.scalars + scalars
        how = SearchMode.KEEP if self.contacts is not None else SearchMode.FOLLOW
        at = self.constraint.evaluate(place[0], factor, place[1], self.contacts, how)
        if at is None:
            return None
        return Place(at, self.constraint.target.conditions(place[0], factor, place[1]).errors)

    def state(self, place: Place) -> State:
        """Return the state at a place."""
        known = self.base.state
        result = state_of(self.system, place.at, known.unstable_modes)
        return replace(result, model=self.model, driven=known.driven, time=known.time, stage=known.stage)


@dataclass(frozen=True, slots=True, eq=False)
class Neighbors:
    """Models at nearby values of one number, with which differences are taken.

    Parameters
    ----------
    name : str
        Of the number.
    step : float [SI]
    each : tuple of Neighbor
    """

    name: str
    step: float
    each: tuple[Neighbor, ...]

    def prescribed_rates(self) -> Array:
        """Rates (h,) at which supports move the fixed unknowns."""
        moved = sum(each.weight * each.prescribed for each in self.each)
        return np.asarray(moved / self.step)

    def look(self, rates: Array) -> tuple[Place, ...]:
        """Evaluate all, each with the unknowns moved at rates.

        Raises
        ------
        TurgorError
            If a cell turns inside out.
        """
        places = []
        for each in self.each:
            place = each.look(each.steps * self.step * rates, np.zeros(len(each.base.scalars)))
            if place is None:
                raise TurgorError(f"a cell turns inside out where '{self.name}' changes by little; mesh more finely.")
            places.append(place)
        return tuple(places)

    def difference(self, values: Callable[[Neighbor, Place], Array], places: tuple[Place, ...]) -> Array:
        """Return the difference quotient of what a function gives at each place."""
        pairs = zip(self.each, places, strict=True)
        return np.asarray(sum(each.weight * values(each, place) for each, place in pairs) / self.step)


def neighbors_of(base: Equilibrium, variation: Variation, name: str) -> Neighbors:
    """Make the models at nearby values of one number of a variation.

    Where one side is not allowed, such as a share beyond 1, or has other cells, the other side alone is taken. Where
    the mesh moves another way on the other side, the derivative is that of a number that grows.

    Parameters
    ----------
    base : Equilibrium
    variation : Variation
    name : str

    Returns
    -------
    Neighbors

    Raises
    ------
    TurgorError
        If neither side is allowed.
    """
    step, errors = variation.step(name), []
    known = {0: (base.system, base.state.model, base.constraint)}

    def at(steps: int, weight: float) -> Neighbor:
        if steps not in known:
            known[steps] = _neighbor(base, variation, name, steps)
        return Neighbor(base, *known[steps], steps, weight)

    for stencil in (CENTRAL, FORWARD, BACKWARD):
        try:
            neighbors = Neighbors(name, step, tuple(at(*point) for point in stencil))
        except TurgorError as error:
            errors.append(error)
            continue
        if stencil is not CENTRAL or not _turns(base.system, neighbors):
            return neighbors
    raise TurgorError(f"'{name}' cannot change by little: {errors[-1]}") from errors[-1]


def _turns(middle: System, neighbors: Neighbors) -> bool:
    """Whether nodes move another way on the other side of a value, so that there are two derivatives."""
    more, less = (each.system.points for each in neighbors.each)
    second, first = np.abs(more + less - 2 * middle.points).max(), np.abs(more - less).max()
    return bool(second > GRADIENTS.kink * first + ROUND_OFF.zero)


def _neighbor(base: Equilibrium, variation: Variation, name: str, steps: int) -> tuple[System, Model, Constraint]:
    values = variation.moved(name, steps)
    model = variation.model(values)
    procedure = base.procedure if variation.procedure is None else variation.procedure(values)
    _check_cells(base.state.model.mesh, model.mesh, name)
    contact_model, touching = _touching(base, model)
    system = base.systems.near(model, contact_model, touching, base.system)
    if system.size != base.system.size or not np.array_equal(system.prescribed, base.system.prescribed):
        raise TurgorError(_other_unknowns(base, name))
    for part, known in zip(system.contact.parts, base.system.contact.parts, strict=False):
        if part.penalty_scale.shape == known.penalty_scale.shape:
            part.penalty_scale = known.penalty_scale
    return system, model, constraint_of(system, base.state, procedure)


def _touching(base: Equilibrium, model: Model) -> tuple[Model, bool]:
    """The model with what may touch at the state, none where nothing does; the search took a third of the time."""
    if not (base.at.contacts.touch or base.system.contact.bodies.names):
        return replace(model, contact=Contact(self_contact=False)), False
    known = base.state.model.contact.for_mesh(base.state.model.mesh)
    return replace(model, contact=Contact(known or False, model.contact.obstacles, model.contact.tolerance)), True


def _check_cells(known: Mesh, mesh: Mesh, name: str) -> None:
    """Refuse a mesh with other cells, whose nodes cannot be those of the state."""
    if not same_cells(known, mesh):
        raise TurgorError(
            f"the mesh has other cells where '{name}' changes by little, so its nodes do not move along; take "
            "hexahedra, another size of the cells, or tetrahedra of one part that turgor generates."
        )


def _other_unknowns(base: Equilibrium, name: str) -> str:
    """Say why the equations have other unknowns: most often, two equal rubbers become different."""
    rubbers = base.state.model.region_materials
    if len(rubbers) > 1:
        return (
            f"the regions {' and '.join(rubbers)} have rubbers that are alike and would not be where '{name}' changes; "
            "change both together, with a comma between their keys, or let them differ."
        )
    return f"the equations have other unknowns where '{name}' changes by little."
