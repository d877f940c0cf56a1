"""Checks around a solve: rigid motions left free, walls that meet."""

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import PchipInterpolator

from turgor.engine.boundary import held_components
from turgor.errors import TurgorError
from turgor.finding import Finding, Severity
from turgor.meshing.proximity import find_facing_walls, smallest_gap
from turgor.meshing.surface import outer_triangles
from turgor.model.model import Model
from turgor.solvers.solution import State


def check_supports(model: Model) -> None:
    """Refuse a model whose supports leave a rigid motion or the mean stress free (B01)."""
    mask = held_components(model).mask
    points = model.mesh.points - model.mesh.points.mean(axis=0)
    size = float(np.abs(points).max())
    motions = []
    for axis in range(3):
        translation = np.zeros_like(points)
        translation[:, axis] = 1.0
        motions.append(translation[mask])
        motions.append(np.cross(np.eye(3)[axis], points / size)[mask])
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
    """Find the load at which outer walls first met (B02); results beyond it are not physical without contact."""
    walls = find_facing_walls(model.mesh)
    gaps: list[float] = []
    for state in states:
        gaps.append(smallest_gap(walls, state.displacement))
        if not np.isfinite(gaps[0]):
            return ()
        if gaps[-1] <= 0:
            factors = [s.load_factor for s in states[: len(gaps)]]
            first = PchipInterpolator(factors, gaps).roots(extrapolate=False).min() if len(gaps) > 1 else 0.0
            return (_met(model, float(first)),)
    return ()


def _met(model: Model, factor: float) -> Finding:
    load = f"load factor {factor:.3g}"
    if model.pressures:
        load = f"{model.pressures[0].pressure * factor / 1e3:.3g} kPa"
    return Finding(
        code="B02",
        severity=Severity.ERROR,
        message=f"Outer walls met at {load}; beyond it they pass through each other, because no contact is defined.",
        advice=f"Use the results below {load} only, or ask for a lower pressure.",
    )
