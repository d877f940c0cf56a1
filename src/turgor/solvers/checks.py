"""Checks around a solve: rigid motions left free, walls that meet."""

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import PchipInterpolator

from turgor.engine.boundary import held_components
from turgor.errors import TurgorError
from turgor.finding import Finding, Severity
from turgor.meshing.proximity import FacingWalls, find_facing_walls, smallest_gap
from turgor.meshing.surface import outer_triangles
from turgor.model.drive import common_pressure, drive_text, kinks, pressures_at, rises
from turgor.model.model import Model
from turgor.solvers.solution import State


def check_supports(model: Model) -> None:
    """Refuse a model whose supports leave a rigid motion or the mean stress free (B01)."""
    supports = held_components(model)
    mask, local = supports.mask, supports.frames.to_local
    points = model.mesh.points - model.mesh.points.mean(axis=0)
    size = float(np.abs(points).max())
    motions = []
    for axis in range(3):
        translation = np.zeros_like(points)
        translation[:, axis] = 1.0
        motions.append(local(translation)[mask])
        motions.append(local(np.cross(np.eye(3)[axis], points / size))[mask])
    held = np.linalg.matrix_rank(np.array(motions), tol=1e-6 * max(1.0, np.sqrt(mask.sum()))) if mask.any() else 0
    if held < 6:
        raise TurgorError(
            f"the supports leave {6 - held} of 6 rigid motions free (B01); hold a face, for example Fixed('fixed')."
        )
    surface = np.unique(outer_triangles(model.mesh))
    if mask[surface].all() and all(material.incompressible for material in model.region_materials.values()):
        raise TurgorError(
            "the supports prescribe the whole surface of an incompressible body (B01), which leaves its mean stress "
            "undetermined; leave a direction of one face free or give the material a bulk_modulus."
        )


def meeting_walls(model: Model, states: Sequence[State]) -> tuple[Finding, ...]:
    """Find the load at which walls first met (B02); results beyond it are not physical without contact.

    Looked at are the outer walls, and the walls of each cavity that is pressed together: by a higher pressure in
    another one, or by less than the pressure of the air around. 20-node hexahedra, which serve comparisons with other
    codes, are not watched.
    """
    if not model.mesh.cell_type.side.triangles:
        return ()
    found = []
    for cavity in (None, *pressed_together(model)):
        first = _first_contact(find_facing_walls(model.mesh, cavity=cavity), states)
        if first is not None:
            found.append(_met(model, cavity, first))
    return tuple(found)


def pressed_together(model: Model) -> tuple[str, ...]:
    """Name the cavities whose pressure is at some load below that of another one, or below zero."""
    found = set()
    for factor in (*kinks(model), 1.0):
        pressures = {name: p for name, p in pressures_at(model, factor).items() if name in model.mesh.cavities}
        found |= {name for name, pressure in pressures.items() if pressure < max(0.0, *pressures.values())}
    return tuple(name for name in model.mesh.cavities if name in found)


def unloaded_cavities(model: Model) -> tuple[Finding, ...]:
    """Say which cavities have no pressure of their own while others have one (B03)."""
    loaded = {load.face for load in model.pressures}
    empty = [name for name in model.mesh.cavities if name not in loaded]
    if not empty or len(empty) == len(model.mesh.cavities):
        return ()
    return (
        Finding(
            code="B03",
            severity=Severity.NOTE,
            message=f"No pressure is stated for {', '.join(empty)}: it stays open to the air, at 0 kPa.",
            advice=f"Give it one under [loads.{empty[0]}] if it should have any.",
        ),
    )


def _first_contact(walls: FacingWalls, states: Sequence[State]) -> float | None:
    """Load factor at which the gap between walls was first closed; None where it never was."""
    gaps: list[float] = []
    for state in states:
        gaps.append(smallest_gap(walls, state.displacement))
        if not np.isfinite(gaps[0]):
            return None
        if gaps[-1] <= 0:
            factors = [s.load_factor for s in states[: len(gaps)]]
            return float(PchipInterpolator(factors, gaps).roots(extrapolate=False).min()) if len(gaps) > 1 else 0.0
    return None


def _met(model: Model, cavity: str | None, factor: float) -> Finding:
    load, pressures = f"load factor {factor:.3g}", drive_text(model, factor, 3)
    common = common_pressure(model)
    if common is not None and rises(common):
        load = pressures
    elif pressures:
        load += f" ({pressures})"
    walls = "Outer walls" if cavity is None else f"Walls of {cavity}"
    return Finding(
        code="B02",
        severity=Severity.ERROR,
        message=f"{walls} met at {load}; beyond it they pass through each other, because no contact is defined.",
        advice=f"Use the results below {load} only, or ask for a lower pressure.",
    )
