"""V15: a plate on a light bar vibrates as a mass on springs, and the energies of its motion balance.

Problem: a bar with a rigid plate of 1 kg and known inertia at its end; the bar weighs 4 mg. The stiffness comes from
static solves with a small force and a small torque on the plate.
Exact: the frequencies along and about the axis are √(k/m)/2π and √(k_t/I)/2π.
Then a lighter plate, its center of mass beside the point, is spun up by a torque that ends: work, kinetic and strain
energy have to balance, and the arrows to stay orthonormal.
Tolerance: 1e-4 for the frequencies, because the force stretches the bar a little; 1 % for the energies of finite steps.
"""

import numpy as np
import pytest
from turgor.loads import Force, Hanging, Moment
from turgor.supports import ReferencePoint

import problems
import rig
import turgor as tg

MASS, INERTIA = 1.0, 2e-5
SMALL = {"bulk_modulus": 1e9, "density": 1.0}


@pytest.mark.parametrize("coupling", ["rigid", "averaging"])
def test_a_plate_vibrates_on_a_bar(coupling, record_verification):
    plate = ReferencePoint("plate", "x1", coupling=coupling, mass=MASS, inertia=(INERTIA, 1e-5, 1e-5))

    def moved(load):
        return (
            problems.solve(rig.rig(plate, loads=[load], **SMALL), tg.Static(tolerance=1e-8)).states[-1].points["plate"]
        )

    along = 1e-4 / moved(Force("plate", (1e-4, 0.0, 0.0))).displacement[0]
    about = 1e-6 / moved(Moment("plate", (1e-6, 0.0, 0.0))).rotation[2, 1]
    expected = sorted([np.sqrt(along / MASS) / 2 / np.pi, np.sqrt(about / INERTIA) / 2 / np.pi])
    result = tg.natural_frequencies(rig.rig(plate, **SMALL), count=4, options=problems.OPTIONS).frequencies[2:]
    record_verification(
        f"plate on a bar, {coupling}: frequencies about and along the axis [Hz]", "mass on a spring", expected,
        result.tolist(), "1e-4",
    )  # fmt: skip
    assert result == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("coupling", ["rigid", "averaging"])
def test_the_energies_of_a_spinning_plate_balance(coupling, record_verification):
    plate = ReferencePoint(
        "plate", "x1", coupling=coupling, mass=0.02, inertia=(2e-6, 1e-6, 1e-6), center=(45e-3, 2e-3, 6e-3)
    )
    loads = [
        Moment("plate", (1e-2, 3e-3, 0.0), history=[(0, 0), (0.5, 1), (0.8, 0), (1, 0)]),
        Hanging("plate", 0.02, history=[(0, 0), (0.5, 1), (1, 1)]),
    ]
    model = rig.rig(plate, loads=loads, bulk_modulus=50e6, density=1000.0, mesh=rig.bar(counts=(2, 1, 1)))
    states = problems.solve(model, tg.Dynamic(duration=0.02)).states
    last = states[-1].points["plate"]
    assert np.degrees(np.arccos((np.trace(last.rotation) - 1) / 2)) > 10
    assert last.rotation @ last.rotation.T == pytest.approx(np.eye(3), abs=1e-8)
    missing = max(abs(state.energies.missing) for state in states) / states[-1].energies.work
    record_verification(f"spinning plate, {coupling}: energy that is missing", "balance", 0.0, missing, "1 %")
    assert states[-1].energies.kinetic > 0.05 * states[-1].energies.work
    assert missing < 0.01
