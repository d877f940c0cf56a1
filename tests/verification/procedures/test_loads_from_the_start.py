"""A weight that is there from the start, with a pull or a push that grows besides.

Problem: bar of 2 × 1 × 1 between frictionless planes, neo-Hookean, incompressible. A traction that stretches it by 1.2
acts from the start, and another one grows until the stretch is 1.5. The second problem is the first with a history of
the same loads that begins at zero.
Exact: stretch λ at the tractions μ (λ − λ^-2), at load factor 0 and 1.
Source: uniaxial tension of a neo-Hookean body, Holzapfel 2000, section 6.5.
Tolerance: 1e-8, since the elements hold linear fields exactly.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from refused import refused
from turgor.core.meshing.cells import HEXAHEDRON

MU = problems.NEO_HOOKE.shear_modulus
SUPPORTS = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("z0", "z")]


def stress(stretch: float) -> float:
    return MU * (stretch - stretch**-2)


@pytest.mark.parametrize(
    "procedure", [tg.Static(tolerance=1e-11), tg.ArcLength(tolerance=1e-11)], ids=["static", "arc"]
)
def test_a_bar_begins_stretched(procedure, record_verification):
    mesh = meshes.box((2.0, 1.0, 1.0), (1, 1, 1), kind=HEXAHEDRON)
    first = tg.Traction("x1", (stress(1.2), 0, 0), history="constant")
    more = tg.loads.Force("x1", (stress(1.5) - stress(1.2), 0, 0))
    model = problems.one_material(mesh, problems.NEO_HOOKE, np.inf, SUPPORTS)
    states = problems.solve(tg.Model(mesh, model.materials, SUPPORTS, [first, more]), procedure).states
    stretches = [1 + state.displacement[mesh.face_nodes("x1"), 0].mean() / 2 for state in (states[0], states[-1])]
    record_verification(
        f"Traction from the start, {type(procedure).__name__}: stretch at load factor 0 and 1",
        "Holzapfel 2000, section 6.5",
        "1.2; 1.5",
        f"{stretches[0]:.9g}; {stretches[1]:.9g}",
        "1e-8",
    )
    assert (states[0].load_factor, states[-1].load_factor) == (0.0, 1.0)
    assert stretches == pytest.approx([1.2, 1.5], rel=1e-8)


def test_a_run_goes_on_from_its_folder(tmp_path):
    """What is on file of the weight and of the pull is not solved again."""
    mesh = meshes.box((2.0, 1.0, 1.0), (1, 1, 1), kind=HEXAHEDRON)
    loads = [tg.Traction("x1", (stress(1.2), 0, 0), history="constant"), tg.loads.Force("x1", (0.1 * MU, 0, 0))]
    model = problems.one_material(mesh, problems.NEO_HOOKE, np.inf, SUPPORTS)
    model = tg.Model(mesh, model.materials, SUPPORTS, loads)
    whole = problems.solve(model)

    def killed(iteration, state):
        if state is not None and state.load_factor > 0.3:
            raise RuntimeError("killed")

    with pytest.raises(RuntimeError):
        problems.solve(model, folder=tmp_path, progress=killed)
    resumed = tg.resume(tmp_path)
    assert [state.load_factor for state in resumed.states] == [state.load_factor for state in whole.states]
    assert resumed.states[-1].displacement == pytest.approx(whole.states[-1].displacement, abs=1e-12)
    stopped = problems.solve(model, stop=lambda state: "weight" if len(state.model.loads) == 1 else None, throw=False)
    assert not stopped.complete and stopped.message.startswith("Loads that are there from the start:")


def test_a_stage_begins_where_the_last_one_ended():
    pull = tg.Traction("x1", (stress(1.2), 0, 0), history="constant")
    with refused("'pull'", "Traction(x1)", "begin with 0"):
        tg.Stage("pull", loads=[pull])
    mesh = meshes.box((2.0, 1.0, 1.0), (1, 1, 1), kind=HEXAHEDRON)
    model = problems.one_material(mesh, problems.NEO_HOOKE, np.inf, SUPPORTS)
    stages = tg.Stages([tg.Stage("more", loads=[tg.Traction("x1", (stress(1.5), 0, 0))])])
    states = problems.solve(tg.Model(mesh, model.materials, SUPPORTS, [pull]), stages).states
    assert states[-1].displacement[mesh.face_nodes("x1"), 0].mean() / 2 == pytest.approx(0.5, rel=1e-5)


def test_a_moving_face_waits_for_the_weight():
    """A face that moves later stays where it is while the weight comes: the end is that of both, whatever the way."""
    mesh = meshes.box((2.0, 1.0, 1.0), (1, 1, 1), kind=HEXAHEDRON)
    move = tg.Displacement("x1", (0.4, 0, 0), "x")
    ends = []
    for history in ("constant", ((0, 0), (0.5, 1), (1, 1))):
        model = problems.one_material(mesh, problems.NEO_HOOKE, 100 * MU, [*SUPPORTS, move])
        loads = [tg.Traction("y1", (0, 0.2 * MU, 0), history=history)]
        solution = problems.solve(tg.Model(mesh, model.materials, model.supports, loads), tg.Static(tolerance=1e-11))
        ends.append((solution.states[0], solution.states[-1]))
    begun, ended = ends[0]
    assert np.abs(begun.displacement[mesh.face_nodes("x1"), 0]).max() < 1e-12
    assert begun.displacement[mesh.face_nodes("y1"), 1].mean() > 0.02
    assert ended.displacement == pytest.approx(ends[1][1].displacement, abs=1e-8)
    assert np.abs(ends[1][0].displacement).max() == 0
