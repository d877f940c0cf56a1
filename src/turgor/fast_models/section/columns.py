"""Columns of the response of a section: pressures, strains of the rod, sizes and forces of states."""

from collections.abc import Sequence
from math import sqrt

import numpy as np

from turgor.fast_models.section.equations import Equations
from turgor.fast_models.section.path import Point
from turgor.fast_models.section.stiffness import FORCE_NAMES, STRAIN_NAMES, forces_of, scales
from turgor.foundation.response import Column


def columns_of(equations: Equations, points: Sequence[Point]) -> list[Column]:
    """Read the columns of states.

    Parameters
    ----------
    equations : Equations
    points : sequence of Point

    Returns
    -------
    list of Column
    """
    columns = _pressures(equations, points)
    strains = np.array([p.unknowns.strains for p in points]).reshape(-1, 4) * scales(equations)[1]
    columns.append(Column("curvature", "1/m", np.hypot(strains[:, 2], strains[:, 3])))
    for name in ("curvature_y", "curvature_z", "twist", "stretch"):
        i = STRAIN_NAMES.index(name)
        columns.append(Column(name, "1/m" if i else "", strains[:, i]))
    columns += _sizes(equations, points)
    forces = np.array([forces_of(equations, p) for p in points]).reshape(-1, 4)
    columns += [Column(name, "N" if i == 0 else "Nm", forces[:, i]) for i, name in enumerate(FORCE_NAMES)]
    stretched = [equations.rubber.largest_stretches(p.unknowns.y, p.unknowns.strains) for p in points]
    table = np.array(stretched).reshape(-1, 2)
    columns += [Column(name, "", table[:, i]) for i, name in enumerate(("principal_stretch_p99", "largest_stretch"))]
    return columns


def _pressures(equations: Equations, points: Sequence[Point]) -> list[Column]:
    """One column if all cavities have the same pressure."""
    names = list(equations.cavities)
    table = np.array([p.unknowns.pressures for p in points]).reshape(len(points), len(names)) * equations.stress
    if not names:
        return []
    if (table == table[:, :1]).all():
        return [Column("pressure", "kPa", table[:, 0])]
    return [Column(f"{name}_pressure", "kPa", values) for name, values in zip(names, table.T, strict=True)]


def _sizes(equations: Equations, points: Sequence[Point]) -> list[Column]:
    """Volume of the cavities for each reference length, and how far cavities and outside balloon."""
    rest, columns = equations.rest, []

    def enclosed(loops: list, at: Point | None) -> float:
        state = rest if at is None else at.unknowns
        return float(sum(loop.volume(state.y, state.strains) for loop in loops))

    loops = list(equations.cavities.values())
    if loops:
        volumes = np.array([enclosed(loops, p) for p in points])
        columns.append(Column("cavity_volume_per_length", "mm2", volumes * equations.area))
    for name, chosen in (("cavity", loops), ("outside", [equations.outside])):
        if chosen:
            first = enclosed(chosen, None)
            ratio = [sqrt(max(enclosed(chosen, p) / p.unknowns.strains[0] / first, 0.0)) for p in points]
            columns.append(Column(f"{name}_ballooning", "", np.array(ratio)))
    return columns
