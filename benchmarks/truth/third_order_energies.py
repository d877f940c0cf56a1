"""Energies of the independent code: rubbers, follower pressure, membranes, smeared fibers, held radii, in mm, N, MPa.

NGSolve differentiates them. Of turgor's engine nothing is used; the energy of a law is called with NGSolve's symbols.
"""

import math
from collections.abc import Iterator
from typing import Any

import ngsolve as ng

import turgor as tg
from turgor.core.model.supports import Radial

MPA, MM = 1e6, 1e-3
#: Bulk modulus [MPa] of rubbers that keep their volume: the zero block of the matrix gets a small negative diagonal.
NEARLY_INCOMPRESSIBLE = 1e5
#: Stiffness that holds the radius of a face [MPa/mm]; rubber walls have about 0.1.
RADIAL_PENALTY = 1e4


def rubber_energy(material: tg.Material, u: Any, mean: Any) -> Any:
    """Energy density W(Ī₁, Ī₂) + p (J − 1) − p²/(2κ)."""
    F = ng.Id(3) + ng.Grad(u)
    C, J = F.trans * F, ng.Det(F)
    first = ng.Trace(C)
    second = 0.5 * (first * first - ng.Trace(C * C))
    shrunk = (J * J) ** (-1 / 3)  # a power of J itself would be no number where an iterate turns a corner inside out
    isochoric = material.law.energy(first * shrunk, second * shrunk * shrunk) / MPA
    bulk = material.bulk_modulus / MPA if math.isfinite(material.bulk_modulus) else NEARLY_INCOMPRESSIBLE
    return isochoric + mean * (J - 1) - mean * mean / (2 * bulk)


def surface_energies(case: Any, u: Any, load: Any, rounding: Any) -> Iterator[tuple[str, Any]]:
    """Faces and their energies per area: pressure, membranes, fibers, held radii."""
    normal = ng.specialcf.normal(3)
    tangential = ng.Id(3) - ng.OuterProduct(normal, normal)
    F = ng.Id(3) + ng.Grad(u).Trace()
    moved = ng.CF((ng.x, ng.y, ng.z)) + u.Trace()
    for face, pressure in case.pressures.items():  # −p V, V = −∫ x · cof(F) N / 3: the normal points into the cavity
        yield face, load * pressure * 1e3 / MPA / 3 * ng.InnerProduct(moved, ng.Cof(F) * normal)
    for face, sheet in case.materials.items():
        if isinstance(sheet, tg.Shell):
            raise RuntimeError(f"{case.name}: '{face}' is a shell, which this code does not have")
        if isinstance(sheet, tg.Membrane):
            yield face, membrane_energy(sheet, F * tangential, tangential)
    for fibers in case.reinforcements:
        names = (fibers.face,) if isinstance(fibers.face, str) else fibers.face
        for direction in thread_directions(fibers, normal, tangential):
            yield "|".join(names), thread_energy(fibers, ng.Norm(F * direction), rounding)
    for support in case.supports:
        if isinstance(support, Radial):
            arm = ng.CF((0.0, ng.y, ng.z))  # the axis is x
            yield support.face, RADIAL_PENALTY / 2 * (u.Trace() * arm / ng.Norm(arm)) ** 2


def membrane_energy(sheet: tg.Membrane, F: Any, tangential: Any) -> Any:
    """Plane stress of Hooke's law in Green's strain of the surface, times the thickness [N/mm]."""
    law = sheet.material.law
    strain = 0.5 * (F.trans * F - tangential)
    squares, trace = ng.InnerProduct(strain, strain), ng.Trace(strain)
    factor = law.E / MPA / (1 - law.nu**2) * sheet.thickness / MM / 2
    return factor * ((1 - law.nu) * squares + law.nu * trace * trace)


def thread_directions(fibers: tg.Fibers, normal: Any, tangential: Any) -> Iterator[Any]:
    """Directions of the threads in their face; right-handed ones turn counterclockwise around x as they advance."""
    winding = fibers.winding
    angle = winding.angle_from_axis
    if angle is None:
        angle = math.pi / 2 - winding.angle_from_circumference
    axis = ng.CF(winding.axis)
    lengthwise = tangential * axis
    lengthwise = lengthwise / ng.Norm(lengthwise)
    around = ng.Cross(axis, normal)
    around = around / ng.Norm(around)
    one = angle < 1e-9 or angle > math.pi / 2 - 1e-9 or winding.hand == "right"
    for turn in (1.0,) if one else (-1.0,) if winding.hand == "left" else (1.0, -1.0):
        yield math.cos(angle) * lengthwise + turn * math.sin(angle) * around


def thread_energy(fibers: tg.Fibers, stretch: Any, rounding: Any) -> Any:
    """½ E A (λ − 1)² over the spacing [N/mm]; below λ = 1 the share that is left in compression, rounded off at 1."""
    stiffness = fibers.stretching_stiffness / (fibers.winding.spacing / MM)
    strain = stretch - 1
    taut = (strain + ng.sqrt(strain * strain + rounding * rounding)) / 2
    return 0.5 * stiffness * (fibers.compression * strain * strain + (1 - fibers.compression) * taut * taut)
