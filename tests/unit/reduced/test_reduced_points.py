"""Forces on reference points as inputs: averaging points, and rigid faces, which combined modes keep rigid."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import turgor as tg
from refused import refused
from turgor.core.engine.runtime import EngineOptions
from turgor.core.engine.system import System
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.core.model.points import ReferencePoint
from turgor.reduced.reduce import Budget, reduce
from turgor.reduced.states.reduced import Reduced
from turgor.reduced.training.reference_points import with_points
from turgor.units import MPa, kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.02 * MPa), density=1100.0)
KINDS = ("averaging", "rigid")


def finger(coupling: str, force: tuple[float, ...] = (0, 0, 0.01), **changes: object) -> tg.Model:
    """Half of a chamber with a plate of 2 g on its tip."""
    mesh = swept_mesh(tg.FastPneuNet(chambers=1, length=12 * mm).build(), Fineness(size=6 * mm))
    point = ReferencePoint("plate", "tip", coupling=coupling, mass=0.002, **changes)
    loads = [tg.Pressure("cavity", 1 * kPa), tg.Gravity(), tg.loads.Force("plate", force)]
    return tg.Model(mesh, {"body": RUBBER, "base": RUBBER}, [tg.Fixed("fixed"), point], loads)


@cache
def reduced(coupling: str) -> Reduced:
    """Pressure, and a force on the point."""
    box = {"loads.pressure": (0.0, 1e3), "loads.plate.vector.3": (-0.05, 0.05)}
    budget = Budget(held_out=1, steps=4, paths=4, modes=12)
    return reduce(finger(coupling), box, budget=budget, options=EngineOptions(threads=1))


@pytest.mark.parametrize("coupling", KINDS)
def test_answer_is_that_of_the_full_model(coupling: str) -> None:
    assert reduced(coupling).held_out.worst < 0.005
    answer = reduced(coupling).solve({"pressure": 700.0, "plate.vector.3": 0.04})
    model = finger(coupling, (0, 0, 0.04))
    loads = [tg.Pressure("cavity", 700.0), *model.loads[1:]]
    supports = [each for each in model.supports if not each.mirror]
    true = tg.solve(tg.Model(model.mesh, dict(model.materials), supports, loads)).states[-1]
    largest = np.abs(true.displacement).max()
    assert answer.displacement == pytest.approx(true.displacement, abs=0.005 * largest)
    state = answer.state()
    assert tg.tip_displacement(state) == pytest.approx(tg.tip_displacement(true), rel=0.005)
    assert state.points["plate"].displacement == pytest.approx(true.points["plate"].displacement, abs=0.005 * largest)


def test_face_of_combined_modes_stays_rigid() -> None:
    answer = reduced("rigid").solve({"pressure": 850.0, "plate.vector.3": -0.045})
    mesh = answer.reduced.model.mesh
    x = mesh.points[mesh.face_nodes("tip")]
    moved = x + answer.displacement[mesh.face_nodes("tip")]
    rest, now = x - x.mean(axis=0), moved - moved.mean(axis=0)
    stretch = np.linalg.svd(np.linalg.lstsq(rest, now, rcond=None)[0])[1][:2]
    assert stretch == pytest.approx([1.0, 1.0], abs=1e-4)


def test_a_rigid_point_turns_with_its_face_at_any_angle() -> None:
    system = System(finger("rigid"))
    turn = Rotation.from_rotvec([0.0, 1.1, 0.0]).as_matrix()
    moved = (system.points @ turn.T - system.points)[: len(system.model.mesh.points)]
    (carrier,) = system.carriers
    place = with_points(system, moved.reshape(-1, 1)).reshape(-1, 3)[carrier.node]
    assert place == pytest.approx((turn - np.eye(3)) @ carrier.at / system.length, abs=1e-9)


def test_what_points_leave_out_is_refused_by_name() -> None:
    box = {"loads.pressure": (0.0, 1e3)}
    middle = System(finger("rigid")).carriers[0].at
    with refused("plate", "plane"):
        tg.reduce(finger("rigid", at=(middle[0] + 5 * mm, 0, middle[2])), box)
    with refused("plate", "averaging"):
        tg.reduce(finger("averaging", at=(middle[0], 0, middle[2] + 1 * mm)), box)
    with refused("spring"):
        tg.reduce(finger("rigid", spring=10.0), box)
