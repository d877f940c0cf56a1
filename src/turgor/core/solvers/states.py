"""States: the one place where an evaluation becomes a `State` in SI units."""

import numpy as np

from turgor.core.engine.contact.points_part import contact_area, nodal_pressure
from turgor.core.engine.points.read_motion import motions
from turgor.core.engine.system import Evaluation, System
from turgor.core.model.drive import pressures_at
from turgor.core.solvers.solution import State, Touch


def state_of(system: System, at: Evaluation, modes: int | None) -> State:
    """Return the state of an evaluation; procedures add what else they know with `dataclasses.replace`.

    Parameters
    ----------
    system : System
    at : Evaluation
        Of the last step; the memory of the rubber is that at the end of the step that has begun.
    modes : int or None
        Unstable modes; None where they were not counted.

    Returns
    -------
    State
    """
    displacement, mean_stress = system.physical(at.unknowns)
    return State(
        model=system.model,
        load_factor=at.load_factor,
        displacement=displacement,
        mean_stress=mean_stress,
        nodal_force=system.nodal_forces(at),
        points=motions(system, at),
        unstable_modes=modes,
        pressures=acting_pressures(system, at),
        touches=touches(system, at),
        memory=system.remembered(at),
    )


def acting_pressures(system: System, at: Evaluation) -> dict[str, float]:
    """Gauge pressures [Pa] in every cavity and on every pressed face, stated or unknown; none where nothing presses."""
    if at.unknown_pressures is None and not system.model.pressures:
        return {}
    by_face = pressures_at(system.model, at.load_factor)
    if (unknown := at.unknown_pressures) is not None:
        by_face |= {name: float(p) * system.stress_scale for name, p in zip(system.controlled, unknown, strict=True)}
    return by_face


def touches(system: System, at: Evaluation) -> dict[str, Touch]:
    """Forces, areas and penetration of every contact in a state, in SI units, by its name."""
    length, stress = system.length, system.stress_scale
    count = len(system.model.mesh.points)
    out: dict[str, Touch] = {}
    for part, gaps in zip(system.contact.parts, at.contacts.gaps, strict=True):
        force = -part.forces(at.contacts.position, gaps)[:count]  # on the body: against the internal force
        one = Touch(
            force=force * stress * length**2,
            pressure=nodal_pressure(part, gaps, count) * stress,
            area=contact_area(part, gaps) * length**2,
            penetration=max(0.0, -float(gaps.pressed.min(initial=0.0))) * length,
            place=gaps.pose.place * length,
            share=system.contact.share_of_tolerance(part, gaps),
        )
        out[part.name] = one if part.name not in out else _both(out[part.name], one)
    return out


def _both(a: Touch, b: Touch) -> Touch:
    """Two parts of one contact."""
    return Touch(
        force=a.force + b.force,
        pressure=np.maximum(a.pressure, b.pressure),
        area=a.area + b.area,
        penetration=max(a.penetration, b.penetration),
        place=a.place,
        share=max(a.share, b.share),
    )
