"""What a stage takes over from the one before: every part of the contact finds its own history again."""

from dataclasses import replace

import numpy as np
from turgor.obstacles import SelfContact

import turgor as tg
from turgor.core.engine.cells.internal_variables import Memory
from turgor.core.engine.system import System
from turgor.core.solvers.restart import Restart
from turgor.core.solvers.solution import State
from turgor.units import kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1e6))


def _half_finger() -> tg.Model:
    """Half a finger: its walls meet each other and their mirror images, with the same sides."""
    mesh = tg.mesh(tg.FastPneuNet(chambers=2, length=20 * mm).build(), size=4 * mm)
    contact = tg.Contact(SelfContact(friction=0.3))
    loads = [tg.Pressure("cavity", 1 * kPa)]
    return tg.Model(mesh, dict.fromkeys(mesh.regions, RUBBER), [tg.Fixed("fixed")], loads, contact=contact)


def test_friction_of_half_a_model_goes_on_in_the_next_stage() -> None:
    model = _half_finger()
    system = System(model)
    rubbing, mirrored = system.contact.parts
    assert rubbing.name == mirrored.name and np.array_equal(rubbing.surface.sides, mirrored.surface.sides)
    rest = system.evaluate(np.zeros(system.size), 0.0)
    assert rest is not None
    friction = system.remembered(rest).friction
    assert friction[0] is not None
    rubbing.penalty_scale = 2 * rubbing.penalty_scale
    nodes = model.mesh.points
    state = State(
        model=model,
        load_factor=0.0,
        displacement=np.zeros_like(nodes),
        mean_stress=np.zeros(model.mesh.vertex_count),
        nodal_force=np.zeros_like(nodes),
        memory=Memory(stress={}, largest={}, friction=friction),
    )
    restart, following = Restart.of(system, state), System(replace(model))
    restart.restore(following)
    assert restart.history(following).friction[0] is friction[0]
    scales = [part.penalty_scale for part in following.contact.parts]
    assert np.array_equal(scales[0], rubbing.penalty_scale) and np.array_equal(scales[1], mirrored.penalty_scale)
