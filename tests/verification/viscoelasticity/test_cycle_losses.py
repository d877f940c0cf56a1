"""V17: a pressure cycle loses what the rubber dissipates: the loop of pressure and volume, and its energies.

Problem: a thick sphere and a finger of one chamber, filled and emptied, of rubber with a Prony series, with stress
softening, with both, with neither.
Exact: in the sphere every point is in equibiaxial tension, so the radius of the cavity gives the stress history at
every point, and their integral the pressure; the work of all points is the area of the loop. Of softening alone the
loss has a closed form at every point. In the finger: the work of the stresses at the quadrature points.
Source: `stress_history`, quadrature over the wall by Gauss points; `softening_dissipation`.
Tolerance: 0.1 % of the largest pressure, that of the mesh; 1 % of the area of a loop, whose trapezoids are coarse;
1e-9 of the work for rubber that forgets.
"""

from dataclasses import replace

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.cells import kernels_geometry
from turgor.core.engine.cells.element import element_of
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.materials.history.softening import Mullins, softening_dissipation
from turgor.core.materials.history.stress_history import stress_history
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.solvers.procedures.static import Static

INNER, OUTER = 10 * problems.MM, 15 * problems.MM
SERIES = Prony(g=(0.15, 0.1), tau=(1.0, 8.0), moduli="long_term")
MULLINS = Mullins(r=1.8, m=5e3)
TWICE = ((0, 0), (0.25, 1), (0.5, 0), (0.75, 1), (1, 0))
DURATION = 12.0
CASES = {"relaxing": (SERIES, None), "softening": (None, MULLINS), "both": (SERIES, MULLINS)}


def cycled(model_of, series=None, mullins=None, steps=80):
    rubber = replace(problems.rubber(problems.YEOH), viscoelasticity=series, stress_softening=mullins)
    at = tuple(np.arange(1, steps + 1) / steps)  # the same pressures on every way
    return problems.solve(model_of(rubber), Static(duration=DURATION, at=at, first_step=0.1, tolerance=1e-9))


def sphere(rubber):
    mesh = meshes.sphere_octant(INNER, OUTER, 2, 2, kind=HEXAHEDRON)
    return tg.Model(mesh, {"body": rubber}, [], [tg.Pressure("cavity", 60e3, TWICE)])


def finger(rubber):
    mesh = tg.mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3)
    return tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 12e3, TWICE)])


def loop(solution):
    """Pressure and cavity volume of every state, and the area of the loop [J]."""
    response = tg.measure(solution, tg.cavity_volume, mesh_error=False)
    pressure, volume = response.column("pressure"), response.column("cavity_volume")
    return pressure, float((0.5 * (pressure[1:] + pressure[:-1]) * np.diff(volume)).sum())


def wall(points=12):
    """Radii at rest and weights of their shells [m³]."""
    x, w = np.polynomial.legendre.leggauss(points)
    radius = 0.5 * (INNER + OUTER) + 0.5 * (OUTER - INNER) * x
    return radius, 0.5 * (OUTER - INNER) * w * 4 * np.pi * radius**2


@pytest.mark.parametrize("case", CASES)
def test_sphere(case, record_verification):
    solution = cycled(sphere, *CASES[case])
    rubber = solution.model.region_materials["body"]
    time = np.array([state.time for state in solution.states])
    inner = np.array([problems.mean_radius(state, "cavity", (0, 1, 2)) for state in solution.states])
    applied, area = loop(solution)
    expected, work, softened = np.zeros(len(time)), 0.0, 0.0
    for radius, volume in zip(*wall(), strict=True):
        now = np.cbrt(radius**3 + inner**3 - INNER**3)
        history = stress_history(rubber, "equibiaxial", time, now / radius)
        # dp = 2 (σθ − σr)/r dr with dr = R²/r² dR: the volume of a shell, 4πR² dR, over 4π r³
        expected += 2 * now / radius * history.nominal_stress * volume / (4 * np.pi * now**3)
        work += volume * history.work[-1]
        top = now.max() / radius
        I1 = 2 * top**2 + top**-4
        energy = problems.YEOH.energy(I1, None)
        softened += volume * float(softening_dissipation(MULLINS, energy))
    worst = np.abs(applied - expected).max() / applied.max()
    record_verification(
        claim=f"sphere filled twice, {case}: pressure that its radius asks for; area of the loop [mJ]",
        source="quadrature of stress_history",
        expected=[0.0, 1e3 * work],
        got=[worst, 1e3 * area],
        tolerance="1e-3 of the largest pressure, 1 %",
    )
    assert worst < 1e-3
    assert area == pytest.approx(work, rel=1e-2)
    if case == "softening":  # all of it in the first cycle
        assert area == pytest.approx(softened, rel=1e-2)
        emptied = (time >= DURATION / 4) & (time <= DURATION / 2)
        again = time >= DURATION / 2
        way_back = np.interp(applied[again], applied[emptied][::-1], inner[emptied][::-1])
        assert inner[again] == pytest.approx(way_back, rel=1e-7)


def stress_work(solution):
    """Work of the stresses at the quadrature points over the path, of the whole actuator [J], by trapezoids."""
    model = solution.model
    element, total, before = element_of(model), 0.0, None
    r = element.tables
    mesh = model.mesh
    Jinv, weight = kernels_geometry.reference_geometry(element.shape, mesh.points, mesh.cells, r.dN, r.weights)
    for state in solution.states:
        F = kernels_geometry.deformation_gradients(element.shape, mesh.cells, state.displacement, r.dN, Jinv)
        inverse = np.linalg.inv(F)
        S = np.linalg.det(F)[..., None, None] * inverse @ problems.fields(state).cauchy @ inverse.swapaxes(-1, -2)
        E = 0.5 * F.swapaxes(-1, -2) @ F
        if before is not None:
            total += float((weight * np.einsum("cqij,cqij->cq", 0.5 * (S + before[0]), E - before[1])).sum())
        before = S, E
    return total * model.mesh.symmetry_factor


@pytest.mark.parametrize("case", CASES)
def test_finger(case, record_verification):
    solution = cycled(finger, *CASES[case])
    area = loop(solution)[1]
    work = stress_work(solution)
    record_verification(
        claim=f"finger filled twice, {case}: area of the loop of pressure and volume [mJ]",
        source="work of the stresses",
        expected=1e3 * work,
        got=1e3 * area,
        tolerance="1 %",
    )
    assert area == pytest.approx(work, rel=1e-2)
    assert area > 0


def test_rubber_that_forgets_loses_nothing(record_verification):
    solution = cycled(finger)
    pressure, area = loop(solution)
    volume = tg.measure(solution, tg.cavity_volume, mesh_error=False).column("cavity_volume")
    lost = abs(area) / (pressure.max() * np.ptp(volume))
    claim = "finger filled twice, rubber that forgets: area of the loop over pressure times volume"
    record_verification(claim, "V17, exact", 0.0, lost, "1e-9")
    assert lost < 1e-9
