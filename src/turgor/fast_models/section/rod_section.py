"""Section of a rod from the solution of a section: what pressure does to a slender actuator, for rods of any shape."""

import numpy as np
from numpy.typing import NDArray

from turgor.fast_models.rod.sections.chamber import PressureTable, RodChamber
from turgor.fast_models.rod.sections.section import UNIFORM, RodSection
from turgor.fast_models.section.plane import tables
from turgor.fast_models.section.solution import SectionSolution
from turgor.foundation.errors import TurgorError

Array = NDArray[np.float64]


def rod_section(
    solution: SectionSolution,
    *,
    shear: float | tuple[float, float] | None = None,
    mass_per_length: float | None = None,
    name: str = "cavity",
) -> RodSection:
    """Make the section of a rod that answers to pressure as a solved section does.

    The rod has one chamber with a table of strains and stiffness at each pressure of the solution. Its axis is the
    reference line of the section, the line through the centroid of the solids.

    Parameters
    ----------
    solution : SectionSolution
        Of a section under one pressure that rises from zero, without other loads.
    shear : float or (float, float) or None [N]
        Stiffness against shear in y and z, which a section under uniform strains cannot tell. By default a third of the
        stiffness against stretch, as of a solid incompressible section: slender rods hardly shear.
    mass_per_length : float or None [kg/m]
        Needed for gravity and motion.
    name : str
        Name of the chamber.

    Returns
    -------
    RodSection
        A strain that a mirror plane of the section keeps at rest gets an estimate: the stiffness against stretch times
        the squared radius of gyration of the solids against bending, a third of the sum of both against twist. A rod
        that leaves the plane needs the solution of the whole section.

    Raises
    ------
    TurgorError
        If there is no single pressure that rises from zero, or other loads act.

    Examples
    --------
    >>> import turgor as tg
    >>> from turgor.units import kPa, mm
    >>> rubber = tg.Material(name="silicone", law=tg.laws.NeoHooke(C10=0.12e6))
    >>> bender = tg.Section(tg.actuators.EccentricBender(), {"body": rubber}, size=3 * mm)
    >>> solution = bender.solve([0 * kPa, 15 * kPa, 30 * kPa])
    >>> rod = rod_section(solution)
    >>> bent = rod.chambers[0].table.strain_at(30 * kPa)
    >>> bool(np.isclose(bent[4], solution.response["curvature_y"][-1]))
    True
    """
    response = solution.response
    pressure = _rising_pressure(solution)
    _no_other_loads(solution)
    strain = np.zeros((len(pressure), 6))
    strain[:, UNIFORM] = np.column_stack(
        [response["stretch"] - 1, response["twist"], response["curvature_y"], response["curvature_z"]]
    )
    strain -= strain[0]
    gyration = _gyration(solution)
    stiffness = np.array([_whole(solution.stiffness(row).matrix, gyration, shear) for row in range(len(pressure))])
    table = PressureTable(pressure=pressure, strain=strain, stiffness=stiffness)
    return RodSection(
        stiffness=stiffness[0],
        mass_per_length=mass_per_length,
        chambers=(RodChamber(name=name, table=table),),
        source=response.source,
    )


def _rising_pressure(solution: SectionSolution) -> Array:
    if "pressure" not in solution.response:
        raise TurgorError(
            "the section has several pressures, or none; a chamber of a rod needs a path of one pressure. Solve the "
            "section once for each chamber, with the other cavities at zero."
        )
    pressure = np.asarray(solution.response["pressure"])
    if len(pressure) < 2 or pressure[0] != 0 or not (np.diff(pressure) > 0).all():
        raise TurgorError(
            f"the section has {len(pressure)} states, the first at {pressure[0]:g} Pa; a rod needs pressures that rise "
            "from 0: begin the list of pressures with 0."
            if len(pressure)
            else "the section has no state; a rod needs pressures that rise from 0."
        )
    return pressure


def _no_other_loads(solution: SectionSolution) -> None:
    table = solution.response
    largest = max(float(np.abs(table["pressure"]).max()) * 1e-12, 1e-9)
    for name in ("axial_force", "torque", "moment_y", "moment_z"):
        if np.abs(table[name]).max() > largest:
            raise TurgorError(
                f"{name} of the section is up to {np.abs(table[name]).max():.3g} besides the pressure; a rod needs the "
                "section under pressure alone, and takes forces and moments itself."
            )


def _gyration(solution: SectionSolution) -> Array:
    """Squared radii of gyration of the solids about y and z (2,) [m²]."""
    equations = solution._equations
    plane, areas = equations.plane, equations.rubber.vectors.weights
    at = np.einsum("qa,cai->cqi", tables().N, plane.points[plane.quads]) * plane.length
    return np.asarray(np.einsum("cq,cqi->i", areas, at[..., :0:-1] ** 2) / areas.sum())


def _whole(matrix: Array, gyration: Array, shear: float | tuple[float, float] | None) -> Array:
    """Stiffness for six strains (6, 6), with estimates where mirror planes hold a strain."""
    matrix = matrix.copy()
    for i, radius in zip((2, 3), gyration, strict=True):
        matrix[i, i] = matrix[i, i] or matrix[0, 0] * radius
    matrix[1, 1] = matrix[1, 1] or (matrix[2, 2] + matrix[3, 3]) / 3
    full = np.zeros((6, 6))
    full[np.ix_(UNIFORM, UNIFORM)] = (matrix + matrix.T) / 2
    across = np.broadcast_to(matrix[0, 0] / 3 if shear is None else shear, 2)
    full[1, 1], full[2, 2] = across
    return full
