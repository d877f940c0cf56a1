"""V01.4: a free body has six motions without stiffness, also under pressure in a closed cavity.

Problem: the tangent of a free hollow cube at rest, and in equilibrium under a cavity pressure that stretches it by
a quarter; incompressible neo-Hookean. Without supports its six rigid motions are the only null vectors: fewer would
mean a stress that is not objective or a wrong pressure stiffness, more a spurious mode of the element.
Tolerance: null eigenvalues below 1e-9 of the largest, the seventh above 1e-5 of it (it is a soft bending mode of the
cube's wall, or a mean stress mode, three orders above the first bound).
"""

import numpy as np

import meshes
import problems
import turgor as tg
from turgor.core.engine.system import System


def _rigid_motions(x):
    turns = [np.cross(axis, x) for axis in np.eye(3)]
    shifts = [np.broadcast_to(axis, x.shape) for axis in np.eye(3)]
    return [motion.ravel() / np.linalg.norm(motion) for motion in [*shifts, *turns]]


def test_free_body_with_pressurized_cavity_has_six_null_modes(record_verification):
    mesh, supports = problems.pinned(meshes.hollow_box())
    model = problems.one_material(mesh, problems.NEO_HOOKE, supports=supports, loads=[tg.Pressure("cavity", 1.2e5)])
    state = problems.solve(model, tg.Static(tolerance=1e-11)).states[-1]
    stretch = np.ptp(problems.current(state)[mesh.face_nodes("cavity")], axis=0).max() * 3
    assert stretch > 1.2  # the state is far from rest, or the test would say little

    system = System(model)
    displaced = np.concatenate([state.displacement.ravel() / system.length, state.mean_stress / system.stress_scale])
    counts = []
    for unknowns, load_factor in ((np.zeros(system.size), 0.0), (displaced, 1.0)):
        tangent = system.tangent(unknowns, load_factor).toarray()
        assert np.abs(tangent - tangent.T).max() < 1e-12 * np.abs(tangent).max()
        size = np.sort(np.abs(np.linalg.eigvalsh(tangent)))
        counts.append(int((size < 1e-9 * size[-1]).sum()))
        assert size[6] > 1e-5 * size[-1]
        x = mesh.points + (unknowns[: 3 * len(mesh.points)] * system.length).reshape(-1, 3)
        for motion in _rigid_motions(x):
            assert np.abs(tangent[:, : motion.size] @ motion).max() < 1e-9 * size[-1]
    record_verification(
        claim="null eigenvalues of a free hollow cube, at rest and under cavity pressure",
        source="V01, six rigid motions",
        expected=[6, 6],
        got=counts,
        tolerance="exact",
    )
    assert counts == [6, 6]
