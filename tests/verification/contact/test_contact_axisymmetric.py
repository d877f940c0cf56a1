"""A bellows on an axisymmetric mesh is sucked together until its walls touch; pressure and rubber balance in energy.

Problem: one fold, walls apart at rest, -10 kPa. Without contact the walls pass through each other and the path ends
before; with it the load is reached.
Expected: the energy that the rubber stores is the work of the pressure, ∫ p dV, whether walls touch or not, because
contact without friction does none. Tolerance: 1 %, of the trapezoids over 40 steps and of the penetration.
The walls penetrate each other by less than 2 % of their thickness, and alike all around.
"""

import numpy as np
import pytest

import problems
import turgor as tg
from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.units import MPa, kPa, mm

PRESSURE = -10 * kPa


@pytest.mark.slow
def test_walls_of_a_bellows_touch(record_verification):
    bellows = tg.actuators.BellowsOfRevolution(folds=1)
    mesh = tg.mesh(bellows.build(), size=6 * mm, cells="axisymmetric")
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1 * MPa))
    model = tg.Model(mesh, {"body": rubber}, [tg.Fixed("fixed")], [tg.Pressure("cavity", PRESSURE)])
    solution = problems.solve(model, tg.Static(at=np.linspace(0.025, 1, 40)))
    states = solution.states
    volume = np.array([cavity_volume(mesh, "cavity", state.displacement) for state in states])
    pressure = PRESSURE * np.array([state.load_factor for state in states])
    work = float(np.sum((pressure[1:] + pressure[:-1]) / 2 * np.diff(volume)))
    stored = 4 * problems.energy(states[-1])
    response = tg.measure(solution, "contact_area", "deepest_penetration")
    record_verification("bellows, walls touching: stored energy over work", "energy", 1.0, stored / work, "1 %")
    assert response.column("contact_area")[-1] > 100 * mm**2
    assert response.column("contact_area")[1] == 0
    assert stored == pytest.approx(work, rel=1e-2)
    assert response.column("deepest_penetration")[-1] < 0.02 * bellows.wall
    u, radii = states[-1].displacement, np.hypot(*mesh.points[:, 1:].T)
    radial = np.einsum("ni,ni->n", u[:, 1:], mesh.points[:, 1:]) / radii
    place = np.round(np.stack([mesh.points[:, 0], radii], axis=1) / mm, 6)
    _, ring = np.unique(place, axis=0, return_inverse=True)
    ring = ring.ravel()
    for along in (u[:, 0], radial):
        high, low = np.full(ring.max() + 1, -1.0), np.full(ring.max() + 1, 1.0)
        np.maximum.at(high, ring, along)
        np.minimum.at(low, ring, along)
        assert (high - low).max() < 1e-9 * mm
