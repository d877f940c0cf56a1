"""Energy that a system stores at an evaluation."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.cells.internal_variables import NOTHING, History
from turgor.core.engine.cells.stabilization import penalty_energy
from turgor.core.engine.evaluation import Evaluation
from turgor.core.engine.system import System

Array = NDArray[np.float64]


def stored_energy(system: System, unknowns: Array, load_factor: float, history: History | None = None) -> float:
    """Strain energy of cells, membranes and fibers of the modeled part [J].

    The same as `turgor.core.engine.fields.strain_energy`, without building the geometry again. ``history`` is that
    of the step, where the rubber relaxes or softens.
    """
    cells, penalty, _ = _cell_energies(system, unknowns, load_factor, history)
    bonds = NOTHING if history is None else history.bonds
    terms = system.terms.energy(system.points + system.split(unknowns)[0], load_factor, bonds)
    return (cells + penalty + terms) * system.stress_scale * system.length**3


def work_of_states(system: System, before: Evaluation, after: Evaluation) -> float:
    """Energy that states bring into the modeled part in a step [J]: by the trapezoidal rule, nothing moving.

    A body that shrinks between walls takes up energy without any motion of a load. The mean stress does work on the
    volume that it would have, so that the term of its constraint counts, too.
    """
    if not system.has_states:
        return 0.0
    total = 0.0
    for at in (before, after):
        ends = [_energy_at(system, at, each.load_factor) for each in (before, after)]
        total += 0.5 * (ends[1] - ends[0])
    return total * system.stress_scale * system.length**3


def _energy_at(system: System, at: Evaluation, load_factor: float) -> float:
    """Scaled energy of cells and terms at the place of an evaluation with the states of a load factor."""
    terms = system.terms.energy(system.configuration(at).position, load_factor)
    return sum(_cell_energies(system, at.unknowns, load_factor, at.history), terms)


def _cell_energies(
    system: System, unknowns: Array, load_factor: float, history: History | None
) -> tuple[float, float, float]:
    """Scaled energy of the laws and the volume, of the penalty, and the term of the constraint ∫ p (J − 1 − p/κ) dV."""
    e, r, cells = system.element, system.element.tables, system.rubber.at(load_factor)
    rubber = cells.materials
    u, p = system.split(unknowns)
    I1, I2, J = cells.kinematics(u)
    compliance = rubber.compliance[:, None]
    mean = np.einsum("qm,cm->cq", r.M, p[e.mean]) if e.modes else (J - 1) / compliance
    lost = J - 1 - mean * compliance
    W = rubber.energy(I1, I2, cells.gradients_of_laws(u), history or rubber.rest)
    density = W / system.stress_scale + 0.5 * mean**2 * compliance
    penalty = float(penalty_energy(cells.penalty, cells.dV, lost).sum())
    return float((cells.dV * density).sum()), penalty, float((cells.dV * mean * lost).sum())


def contact_energy(system: System, at: Evaluation) -> float:
    """Energy of the modeled part in contact penetration, and in the springs of obstacles [J]."""
    scaled = system.contact.energy(at.contacts, system.springs(at.unknowns))
    return scaled * system.stress_scale * system.length**3


def lasting_loss(system: System, at: Evaluation) -> float:
    """Energy of the modeled part that softening, permanent set and bonds have dissipated, up to an evaluation [J]."""
    memory = system.remembered(at)
    if memory is None:
        return 0.0
    remembers = bool(memory.largest or memory.flow)
    softened = float((system.dV * system.materials.softening_loss(memory)).sum()) if remembers else 0.0
    bonds = [float((term.weights * memory.bonds[term.name][1]).sum()) for term in system.terms.bonds]
    return softened * system.length**3 + sum(bonds) * system.length**2
