"""Every procedure, with every kind of contact, keeps its run in a folder and goes on from there to the same end.

A procedure keeps values of its own between two steps, and contact adds to them, so a value that no file can hold shows
in one combination only.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import meshes
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.solvers.procedures import listed
from turgor.units import kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1e6), density=1000.0)
OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)
TOUCHING = tg.obstacles.Plane(point=(0, 0, 12.05 * mm), normal=(0, 0, -1))
STEPS = {"first_step": 0.5, "max_step": 0.5}

#: Contact of the actuator: none, with itself, with a rough plane, with a plane on a spring, and of two kinds at once.
CONTACTS: dict[str, Callable[[], tg.Contact]] = {
    "no contact": lambda: tg.Contact(self_contact=False),
    "self-contact": lambda: tg.Contact(self_contact=tg.obstacles.SelfContact(friction=0.3)),
    "plane": lambda: tg.Contact(self_contact=False, obstacles=[plate(friction=0.3)]),
    "sprung plane and self-contact": lambda: tg.Contact(self_contact=True, obstacles=[plate(spring=500.0)]),
}

#: One procedure of each kind; `Stages` begins with two of them.
PROCEDURES: dict[str, object] = {
    "static": tg.Static(**STEPS),
    "volume": tg.VolumeControl(volume=0.1e-6, **STEPS),
    "gas": tg.GasMass(mass_ratio=1.1, **STEPS),
    "sealed": tg.Sealed(**STEPS),
    "arc length": tg.ArcLength(first_step=0.5),
    "auto": tg.Auto(**STEPS),
    "dynamic": tg.Dynamic(duration=0.01, first_step=5e-3, max_step=5e-3, adaptive=False),
    "stabilized": tg.Stabilized(**STEPS),
    "stages": tg.Stages((tg.Stage("first", tg.Static(**STEPS)), tg.Stage("then", tg.GasMass(mass_ratio=1.1, **STEPS)))),
}


class Killed(BaseException):
    """Ends a run as a signal would: nothing catches it."""


def plate(**more) -> tg.obstacles.Obstacle:
    return tg.obstacles.Obstacle(name="plate", shape=TOUCHING, **more)


def model_of(contact: str, procedure: str) -> tg.Model:
    mesh = meshes.sphere_octant(10 * mm, 12 * mm, 1, 1, kind=HEXAHEDRON)
    face = "outside" if procedure in ("volume", "gas", "sealed") else "cavity"  # those know no pressure in a cavity
    loads = [tg.Pressure(face, 5 * kPa)]
    return tg.Model(mesh, {"body": RUBBER}, [], loads, contact=CONTACTS[contact]())


def test_every_kind_of_procedure_is_here() -> None:
    assert set(listed.PROCEDURES.values()) <= {type(each) for each in PROCEDURES.values()}


@pytest.mark.parametrize("contact", CONTACTS)
@pytest.mark.parametrize("name", PROCEDURES)
def test_a_run_is_kept_and_goes_on(name: str, contact: str, tmp_path: Path) -> None:
    model, procedure = model_of(contact, name), PROCEDURES[name]
    whole = tg.solve(model, procedure, options=OPTIONS, throw=False)
    assert len(whole.states) > 2

    accepted = []

    def cut(iteration: object, state: object) -> None:
        if state is not None:
            accepted.append(state)
        elif len(accepted) > 1:  # within the step after the second that was accepted
            raise Killed

    try:
        tg.solve(model, procedure, options=OPTIONS, progress=cut, folder=tmp_path, throw=False)
    except Killed:
        assert len(tg.load(tmp_path).states) > 1
    again = tg.resume(tmp_path, throw=False)
    assert (again.status, len(again.states)) == (whole.status, len(whole.states))
    scale = max(np.abs(state.displacement).max() for state in whole.states)
    for one, other in zip(again.states, whole.states, strict=True):
        assert np.abs(one.displacement - other.displacement).max() <= 1e-9 * scale
    assert tg.load(tmp_path).status is whole.status
