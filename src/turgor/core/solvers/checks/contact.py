"""Checks of contact: walls that met without contact, walls that overlap at rest, contact that penetrates too deep."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from turgor.core.engine.contact.friction import mean_elastic_slip
from turgor.core.engine.system import System
from turgor.core.meshing.quality.mirror_gap import find_mirror_walls, mirror_gap
from turgor.core.meshing.quality.overlaps import overlap_at_rest
from turgor.core.meshing.quality.proximity import find_facing_walls, smallest_gap
from turgor.core.meshing.wedge import sectors
from turgor.core.model.contact import SELF
from turgor.core.model.drive import common_pressure, drive_text, pressed_together, rises
from turgor.core.model.model import Model
from turgor.core.solvers.checks.settings import REPORTS
from turgor.core.solvers.solution import State
from turgor.foundation.finding import Finding, Severity
from turgor.units import mm, um


def check_contact(model: Model) -> tuple[Finding, ...]:
    """Find walls that overlap at rest although contact should keep them apart (B07).

    Parameters
    ----------
    model : Model

    Returns
    -------
    tuple of Finding
    """
    mesh = model.mesh
    if not len(mesh.cells) or not mesh.cell_type.side.triangles or model.contact.for_mesh(mesh) is None:
        return ()  # films that lie on each other are where they should be, or refused
    place = overlap_at_rest(mesh)
    if place is None:
        return ()
    x, y, z = (coordinate / mm for coordinate in place)
    return (
        Finding(
            code="B07",
            severity=Severity.WARNING,
            message=f"The mesh overlaps itself at rest, for instance at ({x:.3g}, {y:.3g}, {z:.3g}) mm; contact leaves "
            "these walls alone.",
            advice="Move the bodies apart before meshing, or mend the mesh there.",
        ),
    )


def deep_penetrations(states: Sequence[State]) -> tuple[Finding, ...]:
    """Say which contacts penetrate deeper than their tolerance in the last state (B06).

    Parameters
    ----------
    states : sequence of State
        The path.

    Returns
    -------
    tuple of Finding
        One for each such contact.
    """
    findings = []
    for name, touch in states[-1].touches.items() if states else ():
        if touch.share > 1:
            who = "Walls of the actuator penetrate each other" if name == SELF else f"The actuator penetrates '{name}'"
            findings.append(
                Finding(
                    code="B06",
                    severity=Severity.WARNING,
                    message=f"{who} by up to {touch.penetration / um:.3g} µm in the last state, at the worst place "
                    f"{touch.share:.3g} times as deep as the tolerance allows.",
                    advice=f"Round sharp edges that press, refine the mesh there, or raise the stiffness of "
                    f"{'self_contact' if name == SELF else 'the obstacle'}; forces are still in balance.",
                )
            )
    return tuple(findings)


def elastic_slips(system: System, states: Sequence[State]) -> tuple[Finding, ...]:
    """Say where points that stick have slipped elastically by a large part of how far the actuator moves (B26).

    Parameters
    ----------
    system : System
        Whose contact the states have.
    states : sequence of State
        The path.

    Returns
    -------
    tuple of Finding
        One for each such contact.
    """
    if not states or states[-1].memory is None:
        return ()
    findings, moved = [], float(np.linalg.norm(states[-1].displacement, axis=1).max())
    for part, history in zip(system.contact.parts, states[-1].memory.friction, strict=False):
        slip = 0.0 if history is None else mean_elastic_slip(history) * system.length
        if slip > REPORTS.large_share * moved:
            who = "The actuator slips on itself" if part.name == SELF else f"The actuator slips on '{part.name}'"
            findings.append(
                Finding(
                    code="B26",
                    severity=Severity.WARNING,
                    message=f"{who} elastically by {slip / um:.3g} µm on average where friction lets it stick, and it "
                    f"moves by {moved / um:.4g} µm at most.",
                    advice="State a smaller elastic_slip for "
                    f"{'self-contact' if part.name == SELF else 'the obstacle'}, such as a tenth of what is found.",
                )
            )
    return tuple(findings)


def meeting_walls(model: Model, states: Sequence[State]) -> tuple[Finding, ...]:
    """Find the load at which walls without contact first met (B02); results beyond it are not physical.

    The check compares the outer walls, and the walls of each cavity that is pressed together, with each other and with
    their mirror images. 20-node hexahedra, which serve comparisons with other codes, are left out.

    Parameters
    ----------
    model : Model
    states : sequence of State
        The path, from the undeformed state.

    Returns
    -------
    tuple of Finding
    """
    findings = []
    for cavity in _unguarded(model, states):
        facing, mirrors = find_facing_walls(model.mesh, cavity=cavity), find_mirror_walls(model.mesh, cavity)
        points = model.mesh.points
        met = {
            "": _first_contact(states, (smallest_gap(facing, state.displacement) for state in states)),
            " their mirror image": _first_contact(
                states, (mirror_gap(mirrors, points + state.displacement) for state in states)
            ),
        }
        first = {whom: factor for whom, factor in met.items() if factor is not None}
        if first:
            whom = min(first, key=lambda each: first[each])
            findings.append(_met(model, cavity, whom, first[whom]))
    return (*findings, *_met_next_sector(model, states))


def _met_next_sector(model: Model, states: Sequence[State]) -> tuple[Finding, ...]:
    """Find the load at which outer walls of a wedge first met those of the next sector, which no contact stops."""
    wedge = model.mesh.wedge
    if wedge is None:
        return ()
    pair = sectors(model.mesh, 2)
    facing = find_facing_walls(pair.mesh)
    alone = [np.setdiff1d(pair.nodes[i], pair.nodes[1 - i]) for i in range(2)]
    within = np.array([[np.isin(wall, nodes).all() for nodes in alone] for wall in facing.walls], dtype=bool)
    within = within.reshape(-1, 2)
    a, b = facing.pairs.reshape(-1, 2).T
    between = (within[a, 0] & within[b, 1]) | (within[a, 1] & within[b, 0])
    facing = replace(facing, pairs=facing.pairs.reshape(-1, 2)[between])
    gaps = (smallest_gap(facing, pair.displacement(wedge, state.displacement)) for state in states)
    factor = _first_contact(states, gaps)
    if factor is None:
        return ()
    load = drive_text(model, factor, 3) or f"load factor {factor:.3g}"
    return (
        Finding(
            code="B02",
            severity=Severity.ERROR,
            message=f"Outer walls met those of the next sector of the wedge at {load}; beyond it they pass through "
            "each other, because contact between sectors is not modeled.",
            advice=f'Model mirror planes or the whole part (symmetry = "none"), or use the results below {load} only.',
        ),
    )


def _unguarded(model: Model, states: Sequence[State]) -> tuple[str | None, ...]:
    """Cavities whose walls are pressed together without contact; None stands for the outer walls."""
    mesh, contact = model.mesh, model.contact
    if not mesh.cell_type.side.triangles:
        return ()
    outside = (None,) if contact.for_mesh(mesh) is None else ()
    pressed, guarded = set(pressed_together(model)), contact.self_contact is not None
    for state in () if guarded else states:  # a procedure may find the pressure, and draw fluid off
        acting = {name: p for name, p in state.pressures.items() if name in mesh.cavities}
        pressed |= {name for name, p in acting.items() if p < max(0.0, *acting.values())}
    return (*outside, *(name for name in mesh.cavities if name in pressed and not guarded))


def _first_contact(states: Sequence[State], measured: Iterable[float]) -> float | None:
    """Load factor at which a gap first closed; None where none did. States beyond it are not measured."""
    gaps: list[float] = []
    for gap in measured:
        gaps.append(gap)
        if not np.isfinite(gaps[0]):
            return None
        if gaps[-1] <= 0:
            factors = [s.load_factor for s in states[: len(gaps)]]
            if len(gaps) == 1:
                return 0.0
            from scipy.interpolate import PchipInterpolator  # slow to load, and not needed before a solve

            if (np.diff(factors) > 0).all():
                return float(PchipInterpolator(factors, gaps).roots(extrapolate=False).min())
            places = np.arange(len(gaps))  # the load fell on the way, and does not order the states
            return float(np.interp(PchipInterpolator(places, gaps).roots(extrapolate=False).min(), places, factors))
    return None


def _met(model: Model, cavity: str | None, whom: str, factor: float) -> Finding:
    load, pressures = f"load factor {factor:.3g}", drive_text(model, factor, 3)
    common = common_pressure(model.loads)
    if common is not None and rises(common):
        load = pressures
    elif pressures:
        load += f" ({pressures})"
    walls = "Outer walls" if cavity is None else f"Walls of {cavity}"
    return Finding(
        code="B02",
        severity=Severity.ERROR,
        message=f"{walls} met{whom} at {load}; beyond it they pass through each other, because self-contact is off.",
        advice=f"Switch self-contact on, or use the results below {load} only.",
    )
