"""V16-4: forces of contact balance, frictionless ones have no tangential part, and no work is lost.

Exact: (1) the forces of self-contact sum to zero and so do their moments; (2) a frictionless plane pushes along its
normal only, a ball has no moment about its center, an endless bar neither a moment about its axis nor a force along it;
(3) the support carries what the obstacle pushes with; (4) work of the pressure, or of the plate that moves, is the
energy of the rubber and of the penetration. Tolerance: 1e-10 of the force for (1) and (2), which hold point by point;
1e-7 for (3), a hundred times the Newton tolerance; 0.2 % for (4), the error of the trapezoidal rule where contact
begins.
"""

import numpy as np
import pytest

import contact_cases
import contact_meshes
import meshes
import problems
import turgor as tg
from problems import MM
from turgor.core.engine.faces.surfaces import enclosed_volume
from turgor.core.engine.system import System
from turgor.core.model.contact import SELF, Contact
from turgor.core.model.obstacles import Cylinder, Plane, SelfContact, Sphere

ABOVE = {
    "plane": Plane(point=(0, 0, 5 * MM), normal=(0, 0, -1)),
    "ball": Sphere(center=(4 * MM, 5.5 * MM, 12 * MM), radius=7 * MM),
    "bar": Cylinder(center=(4 * MM, 5.5 * MM, 12 * MM), axis=(1, 0.2, 0), radius=7 * MM),
}


def _under(name, way=1.0):
    """A block under an obstacle that comes down by 1 mm."""
    obstacle = contact_cases.pushed(ABOVE[name], (0, 0, -way))
    return problems.solve(contact_cases.standing(contact_cases.block(), obstacle), contact_cases.EXACT).states[-1]


@pytest.fixture(scope="module", params=ABOVE)
def pressed(request):
    return request.param, _under(request.param)


def _against(record, claim, error, tolerance):
    record(claim=claim, source="V16-4, exact", expected=0.0, got=error, tolerance=tolerance)
    assert error < float(tolerance)


def test_self_contact_has_no_resultant(record_verification):
    """Two bodies of unlike meshes, bent into each other: forces and moments about the origin."""
    lower = contact_cases.block((2, 2, 1))
    upper = contact_meshes.moved(contact_cases.block((3, 3, 1), (8, 8, 5)), (1.3 * MM, 0.6 * MM, 5.1 * MM))
    mesh = contact_meshes.together({"lower": lower, "upper": upper})

    def turned(points, load_factor):
        turn = problems.rotation((1, 2, 0), 0.15 * load_factor)
        middle = np.array([5, 5, 10.1]) * MM
        return (points - middle) @ turn.T + middle - points - [0, 0, 0.8 * MM * load_factor]

    supports = [tg.Fixed("lower_z0"), tg.Displacement("upper_z1", turned)]
    materials = {"body": problems.rubber(problems.NEO_HOOKE)}
    for friction in (0.0, 0.5):
        contact = Contact(SelfContact(stiffness=1e10, friction=friction))
        state = problems.solve(tg.Model(mesh, materials, supports, [], contact=contact)).states[-1]
        touch = state.touches[SELF]
        size = float(np.abs(touch.force).sum())
        error = float(np.abs(contact_cases.push(touch)).max()) / size
        turning = float(np.abs(contact_cases.moment(state, touch)).max()) / (size * 10 * MM)
        with_ = f"friction {friction:g}"
        _against(record_verification, f"bodies in contact, {with_}: sum of the forces over their size", error, "1e-10")
        if not friction:
            _against(record_verification, "bodies in contact: moment of the forces over their size", turning, "1e-10")
        assert size > 1


def test_frictionless_force_has_no_tangential_part(pressed, record_verification):
    name, state = pressed
    touch = state.touches["plate"]
    size = float(np.abs(touch.force).sum())
    if name == "plane":
        sideways = float(np.abs(touch.force[:, :2]).max()) / size
    else:
        center = np.array(ABOVE[name].center) + touch.place
        turning = contact_cases.moment(state, touch, center) / (7 * MM)
        sideways = float(np.abs(turning).max())
        if name == "bar":
            axis = np.array(ABOVE[name].axis)
            sideways = max(abs(float(turning @ axis)), abs(float(contact_cases.push(touch) @ axis)))
        sideways /= size
    claim = f"frictionless {name}: force or moment that only friction can make, over the force"
    _against(record_verification, claim, sideways, "1e-10")


def test_support_carries_the_push(pressed, record_verification):
    name, state = pressed
    push = contact_cases.push(state.touches["plate"])
    error = contact_cases.apart(problems.reaction(state, "z0"), -push)
    _against(record_verification, f"block under a {name}: support's reaction plus push, over the push", error, "1e-7")
    assert push[2] < -1


def _penetration_energy(state):
    """Energy stored by the penalty [J]."""
    system = System(state.model)
    contacts = system.contact.look((state.model.mesh.points + state.displacement) / system.length, _none(), 1.0)
    return system.contact.energy(contacts, _none()) * system.stress_scale * system.length**3


def _none():
    return np.zeros((0, 3))


@pytest.mark.parametrize("stiffness", [1e10, 1e11])
def test_work_of_a_plate(stiffness, record_verification):
    """The plate comes down by a fifth of the height, in 20 steps; the softer one stores 3 % of the work."""
    plate = contact_cases.pushed(ABOVE["plane"], (0, 0, -1), stiffness=stiffness)
    model = contact_cases.standing(contact_cases.block((2, 2, 1)), plate)
    factors = tuple(np.arange(1, 21) / 20)
    states = problems.solve(model, tg.Static(first_step=0.05, max_step=0.05, at=factors, tolerance=1e-9)).states
    force = np.array([-contact_cases.push(state.touches["plate"])[2] if state.touches else 0.0 for state in states])
    way = np.array([state.load_factor for state in states]) * MM
    _energies(record_verification, f"plate, {stiffness:.0e} Pa/m", float(np.trapezoid(force, way)), states[-1])


def _energies(record, name, work, state):
    penetration = _penetration_energy(state)
    ratio = work / (problems.energy(state) + penetration)
    claim = f"{name}: work over the energy of rubber and penetration, of which the latter has {penetration / work:.1%}"
    record(claim, "V16-4, exact", 1.0, ratio, "0.2 %")
    assert ratio == pytest.approx(1, abs=2e-3)
    return penetration / work


def test_work_of_a_pressure(record_verification):
    """A hollow cube is blown up between its support and a plate that it meets on the way."""
    cube = meshes.hollow_box()
    mesh = meshes.with_points(cube, 30 * MM * cube.points)
    plate = contact_cases.pushed(Plane(point=(0, 0, 30.3 * MM), normal=(0, 0, -1)))
    load = tg.Pressure("cavity", 1.5e5)
    model = contact_cases.standing(mesh, plate, loads=[load], law=problems.YEOH)
    factors = tuple(np.arange(1, 31) / 30)
    states = problems.solve(model, tg.Static(first_step=1 / 30, max_step=1 / 30, at=factors, tolerance=1e-9)).states
    volume = [-enclosed_volume(problems.current(state), mesh.face("cavity")) for state in states]
    pressure = [load.at(state.load_factor) for state in states]
    work = float(np.trapezoid(pressure, volume))
    assert states[-1].touches["plate"].area > 0.02 * (30 * MM) ** 2
    assert _energies(record_verification, "hollow cube at a plate", work, states[-1]) < 0.01
