"""Contact under every procedure: the same state as under a static pressure, and energies that balance.

Problem: an eighth of a sphere, 10 mm inside, 12 mm outside, neo-Hookean C10 = 0.12 MPa, that presses on a plane 0.2 mm
above its pole, at rest or coming 2 mm nearer. Volume control and an amount of gas find a pressure; `Static` at that
pressure must find the same state. A load that grows in time, or against viscous forces, must end there too.
A block of 10 × 10 × 5 mm is pressed by a plane that comes slowly, and rubbed by it; another one falls on a plane.
Exact: equality where nothing rubs and the tolerance of Newton's method is all that differs; in balance the floor
carries the weight; the energy balance of every motion, with what is stored in the contact, what moving planes and a
raised contact stiffness put in, and what friction takes.
Tolerance: 1e-6 of the largest displacement and of the force; 1 % for the slow ramp and the block that has come to
rest; 0.2 % of the energy for slow motions (the error of the trapezoidal rule), 1 % where L05 would warn.
"""

import numpy as np
import pytest

import contact_cases
import meshes
import problems
import turgor as tg
from problems import MM
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.solvers.energies import imbalance

VOLUME = 4 / 3 * np.pi * (10 * MM) ** 3
PRECISE = {"tolerance": 1e-9}
NEARER = ((0, (0, 0, 0)), (1, (0, 0, -2 * MM)))
RUBBER = problems.rubber(problems.NEO_HOOKE, density=1070.0)


def _at_a_plane(mesh, height, *, path=(), supports=(), loads=(), up=False, friction=0.0):
    """A body under a plane, or over one."""
    shape = tg.obstacles.Plane(point=(0, 0, height), normal=(0, 0, 1 if up else -1))
    plate = tg.obstacles.Obstacle(name="plate", shape=shape, path=path, friction=friction)
    contact = tg.Contact(self_contact=False, obstacles=[plate])
    return tg.Model(mesh, {"body": RUBBER}, supports, loads, contact=contact)


def _sphere(pressure=None, path=()):
    mesh = meshes.sphere_octant(10 * MM, 12 * MM, 2, 1, kind=HEXAHEDRON)
    loads = [] if pressure is None else [tg.Pressure("cavity", pressure)]
    return _at_a_plane(mesh, 12.2 * MM, path=path, loads=loads)


def _apart(state, other):
    """Differences of displacement and force, relative."""
    forces = [contact_cases.push(each.touches["plate"]) for each in (state, other)]
    assert forces[1][2] < -0.01  # they touch
    return [contact_cases.apart(state.displacement, other.displacement), contact_cases.apart(*forces)]


FILLED = {
    "injected volume": tg.VolumeControl(volume=0.6 * VOLUME, **PRECISE),
    "amount of gas": tg.GasMass(mass_ratio=1.8, **PRECISE),
}


@pytest.mark.parametrize("path", [(), NEARER], ids=["still", "moving"])
@pytest.mark.parametrize("name", FILLED)
def test_pressure_that_is_found_gives_the_same_state(name, path, record_verification):
    state = problems.solve(_sphere(path=path), FILLED[name]).states[-1]
    same = _sphere(state.pressures["cavity"], path)
    errors = _apart(state, problems.solve(same, tg.Static(**PRECISE)).states[-1])
    record_verification(
        claim=f"sphere against a {'moving ' if path else ''}plane, {name} against the pressure that it reports: "
        "displacement, force, relative",
        source="the same problem",
        expected=[0.0, 0.0],
        got=errors,
        tolerance="1e-6",
    )
    assert max(errors) < 1e-6


@pytest.mark.parametrize(
    "procedure",
    [tg.ArcLength(**PRECISE), tg.Auto(**PRECISE), tg.Stabilized(tolerance=1e-8)],
    ids=["arc length", "auto", "stabilized"],
)
def test_other_ways_to_a_pressure(procedure, record_verification):
    """The stabilized run is that against a moving plane, whose work is a third of all."""
    viscous = isinstance(procedure, tg.Stabilized)
    model = _sphere(20e3, NEARER) if viscous else _sphere(20e3)
    solution = problems.solve(model, procedure)
    errors = _apart(solution.states[-1], problems.solve(model, tg.Static(**PRECISE)).states[-1])
    record_verification(
        claim=f"sphere against a plane, {type(procedure).__name__} against Static: displacement, force, relative",
        source="the same problem",
        expected=[0.0, 0.0],
        got=errors,
        tolerance="1e-6",
    )
    assert solution.converged
    assert max(errors) < 1e-6
    if viscous:
        assert imbalance(solution.states) < 2e-3
        assert len(solution.steps) < 40


def test_friction_along_an_arc_is_that_of_small_load_steps(record_verification):
    """The last state of an arc is sought with the friction history before it, not with that of the state beyond it."""
    mesh = meshes.sphere_octant(10 * MM, 12 * MM, 2, 1, kind=HEXAHEDRON)
    model = _at_a_plane(mesh, 12.2 * MM, loads=[tg.Pressure("cavity", 20e3)], friction=0.4)
    fine = problems.solve(model, tg.Static(first_step=0.02, max_step=0.02)).states[-1].touches["plate"]
    arc = problems.solve(model, tg.ArcLength()).states[-1].touches["plate"]
    off = contact_cases.apart(arc.force, fine.force)
    record_verification(
        claim="rough sphere against a plane, ArcLength against Static in 50 steps: contact forces, relative",
        source="the same problem",
        expected=0.0,
        got=off,
        tolerance="0.045 (large steps of the arc)",
    )
    assert off < 0.045


def test_a_slow_plane_presses_as_at_rest(record_verification):
    """The penetration makes the contact stiffness rise ten times on the way."""
    mesh = contact_cases.block((2, 2, 1))
    path = ((0, (0, 0, 0)), (1, (0, 0, -1 * MM)))
    model = _at_a_plane(mesh, 5.2 * MM, path=path, supports=[tg.Fixed("z0")])
    still = problems.solve(model, tg.Static(max_step=0.1)).states[-1]
    moved = problems.solve(model, tg.Dynamic(duration=1.0, stiffness_damping=5e-3))
    forces = [float(contact_cases.push(each.touches["plate"])[2]) for each in (moved.states[-1], still)]
    lost = imbalance(moved.states)
    record_verification(
        claim="block pressed slowly by a plane: force [N]; share of the energy that is missing",
        source="static path; balance",
        expected=[forces[1], 0.0],
        got=[forces[0], lost],
        tolerance="1 %, 0.2 %",
    )
    assert forces[0] == pytest.approx(forces[1], rel=0.01)
    assert lost < 2e-3
    assert moved.findings == ()


def _falling(duration, **more):
    """A block 0.2 mm above a floor, with nothing that holds it but two mirror planes; its weight comes in 20 ms."""
    weight = tg.Gravity((0, 0, -1), 9.81, tg.over_time([(0, 0), (0.02, 1), (duration, 1)], duration=duration))
    mirrors = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y")]
    model = _at_a_plane(contact_cases.block((1, 1, 1)), -0.2 * MM, supports=mirrors, loads=[weight], up=True)
    return problems.solve(model, tg.Dynamic(duration=duration, stiffness_damping=5e-3, **more))


def test_block_bounces_on_the_floor(record_verification):
    """The touch lasts for a millisecond: it takes short steps, and with longer ones L05 warns."""
    precise, coarse = (_falling(0.03, accuracy=accuracy) for accuracy in (4e-6, 1e-3))
    lost = imbalance(precise.states)
    lowest = min(float(state.displacement[:, 2].mean()) for state in precise.states)
    record_verification(
        claim="block that bounces on a floor: share of the energy that is missing",
        source="balance",
        expected=0.0,
        got=lost,
        tolerance="1 %",
    )
    assert lost < 0.01
    assert precise.findings == ()
    assert "L05" in [finding.code for finding in coarse.findings]
    assert any(state.touches["plate"].area > 0 for state in precise.states)
    assert -0.21 * MM < lowest < -0.2 * MM
    assert precise.states[-1].displacement[:, 2].mean() > lowest + 0.02 * MM


def test_floor_carries_the_weight(record_verification):
    """With friction in the air, proportional to the mass, it comes to rest; longer steps keep it ringing."""
    last = _falling(0.1, mass_damping=1000.0, accuracy=1e-5).states[-1]
    weight = 1070.0 * 9.81 * 10 * 10 * 5 * MM**3
    result = float(contact_cases.push(last.touches["plate"])[2])
    record_verification(
        claim="block that has come to rest on a floor: force on it [N]",
        source="balance",
        expected=weight,
        got=result,
        tolerance="0.1 %",
    )
    assert result == pytest.approx(weight, rel=0.001)


@pytest.mark.parametrize("procedure", [tg.Stabilized(), tg.Dynamic(duration=1.0, stiffness_damping=5e-3)])
def test_friction_is_counted(procedure, record_verification):
    """A plane presses a block and is drawn over it: friction takes three times what the block stores."""
    path = ((0, (0, 0, 0)), (0.3, (0, 0, -0.7 * MM)), (1, (4 * MM, 0, -0.7 * MM)))
    model = _at_a_plane(contact_cases.block((1, 1, 1)), 5.2 * MM, path=path, supports=[tg.Fixed("z0")], friction=0.3)
    solution = problems.solve(model, procedure)
    energies = solution.states[-1].energies
    lost = imbalance(solution.states)
    record_verification(
        claim=f"plane drawn over a block with friction, {type(procedure).__name__}: share of the energy missing",
        source="balance",
        expected=0.0,
        got=lost,
        tolerance="0.2 %",
    )
    force = contact_cases.push(solution.states[-1].touches["plate"])
    assert lost < 0.002
    assert energies.dissipated > 2 * energies.strain
    assert force[0] == pytest.approx(-0.3 * force[2], rel=1e-3)
    if isinstance(procedure, tg.Stabilized):  # viscous forces are told apart
        assert energies.viscous < 1e-3 * energies.strain
