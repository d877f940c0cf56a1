"""Cables in results: where each runs in a state, its tension, and the phases of a shape-memory wire."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cables.cable_term import CableTerm
from turgor.core.engine.cables.cables import terms_of
from turgor.core.engine.cables.wire_term import WireTerm
from turgor.core.engine.cells.internal_variables import bonds_of
from turgor.core.engine.term import Configuration
from turgor.core.materials.alloys.phases import Phases
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.solvers.solution import State
from turgor.foundation.display import brief
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class CableResult:
    """A tendon or a shape-memory wire in one state.

    Parameters
    ----------
    name : str
        Name of a wire; the points of a tendon without a name.
    guides : (g, 3) array [m]
        Where its guides are now.
    tension : (g - 1,) array [N]
        Tension of the whole cable in each piece, from the motor to the end.
    travel : float [m]
        By how much its way through the guides is shorter than at rest.
    phases : Phases or None
        Stress, temperature and fractions of martensite of a shape-memory wire.
    strain : float
        Strain of a wire from its length before it was stretched; of a tendon that of its way through the guides.
    """

    name: str
    guides: Array
    tension: Array
    travel: float
    phases: Phases | None
    strain: float

    __repr__ = brief


def cable_results(state: State | StateFields) -> tuple[CableResult, ...]:
    """Read the tensions of every cable of the model off a state, and the phases of every wire.

    Parameters
    ----------
    state : State or StateFields

    Returns
    -------
    tuple of CableResult
        In the order of the loads.
    """
    at = state if isinstance(state, StateFields) else StateFields(state)
    place = Configuration(at.mesh.points + at.state.displacement, at.state.load_factor, bonds=bonds_of(at.state.memory))
    return tuple(_result(term, place) for term in terms_of(at.model))


def _result(term: CableTerm, at: Configuration) -> CableResult:
    pulled, rest = term.pulled(at), float(term.rest_lengths.sum())
    travel = rest - float(pulled.lengths.sum())
    phases, strain = (term.answer(at)[0], term.strain(at)) if isinstance(term, WireTerm) else (None, -travel / rest)
    return CableResult(
        name=term.load.place, guides=term.guides(at), tension=pulled.tensions / term.laid.part, travel=travel,
        phases=phases, strain=strain,
    )  # fmt: skip


def cables_with_tension(at: StateFields) -> list[tuple[Array, Array]]:
    """Cables of the modeled part, (g, 3) [m] each, with the tension of the whole cable at their guides, (g,) [N]."""
    return [(each.guides, np.append(each.tension, each.tension[-1])) for each in cable_results(at)]


def largest_tension(at: StateFields) -> float:
    """Largest tension of a cable at its motor [N]."""
    return float(max(each.tension[0] for each in _some(at)))


def end_tension(at: StateFields) -> float:
    """Smallest tension of a cable at its end [N]."""
    return float(min(each.tension[-1] for each in _some(at)))


def largest_travel(at: StateFields) -> float:
    """By how much the way of a cable through its guides is shorter than at rest [m], the largest."""
    return float(max(each.travel for each in _some(at)))


def wire_stress_of(at: StateFields) -> float:
    """Largest stress of a wire [Pa]."""
    return max(each.stress for each in _wires(at))


def wire_temperature_of(at: StateFields) -> float:
    """Highest temperature of a wire [K]."""
    return max(each.temperature for each in _wires(at))


def wire_martensite_of(at: StateFields) -> float:
    """Smallest fraction of martensite of a wire."""
    return min(each.martensite for each in _wires(at))


def _wires(at: StateFields) -> list[Phases]:
    phases = [each.phases for each in cable_results(at) if each.phases is not None]
    if not phases:
        raise TurgorError("the model has no shape-memory wire; a stage that does not heat one states it, too.")
    return phases


def _some(at: StateFields) -> tuple[CableResult, ...]:
    cables = cable_results(at)
    if not cables:
        raise TurgorError("the model has no cable; a stage that does not pull states it with a tension of 0.")
    return cables
