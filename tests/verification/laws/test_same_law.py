"""V22: a law gives the same answer whether it is written in invariants or in stretches, also beside other laws.

Problem: a clamped block of two materials, 3 × 1 × 1 with a bent axis, under pressure from below; at its edges
stretches are far apart, in its middle nearly equal.
Exact: Ogden with α = 2 is neo-Hookean, with 2 and −2 Mooney–Rivlin, so each region may be of either form in any
combination; Ogden with α = 4 is a generalized Rivlin law, since Σ λ⁴ = I₁² − 2 I₂, and its tangent is the same however
close two or three stretches are.
Source: review Eqs. 11, 12, 13 and 15. Tolerance: 1e-10 relative, what the Newton tolerance of 1e-12 leaves; 1e-9 for
the tangent, a factor of ten above what `spectral.CLOSE` promises.
"""

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.system import System
from turgor.core.materials.laws.laws import GeneralizedRivlin, Ogden

NEO, NEO_OGDEN = tg.laws.NeoHooke(C10=5e4), Ogden(mu=(1e5,), alpha=(2.0,))
MOONEY, MOONEY_OGDEN = tg.laws.MooneyRivlin(C10=3e4, C01=1e4), Ogden(mu=(6e4, -2e4), alpha=(2.0, -2.0))
KAPPA = 5e7


def _solve(first, second):
    mesh = meshes.bent_block()
    left = mesh.points[mesh.cells].mean(axis=1)[:, 2] < 0.005
    regions = {"body": np.flatnonzero(left), "base": np.flatnonzero(~left)}
    mesh = tg.Mesh(points=mesh.points, cells=mesh.cells, regions=regions, faces=mesh.faces)
    materials = {"body": problems.rubber(first), "base": problems.rubber(second, KAPPA)}
    model = tg.Model(mesh, materials, [tg.Fixed("x0")], [tg.Pressure("z0", 2e3)])
    return problems.solve(model, tg.Static(first_step=0.25, tolerance=1e-12))


@pytest.fixture(scope="module")
def by_invariants():
    solution = _solve(NEO, MOONEY)
    assert np.abs(solution.states[-1].displacement).max() > 0.005  # a sixth of the length: far from linear
    return solution


@pytest.mark.parametrize(
    ("name", "first", "second"),
    [
        ("both regions", NEO_OGDEN, MOONEY_OGDEN),
        ("the incompressible region", NEO_OGDEN, MOONEY),
        ("the compressible region", NEO, MOONEY_OGDEN),
    ],
)
def test_stretches_and_invariants_give_the_same_answer(name, first, second, by_invariants, record_verification):
    solution = _solve(first, second)
    state, expected = solution.states[-1], by_invariants.states[-1]
    pairs = {
        "displacement": (state.displacement, expected.displacement),
        "mean stress": (state.mean_stress, expected.mean_stress),
        "support forces": (state.nodal_force, expected.nodal_force),
        "Cauchy stress": (problems.fields(state).cauchy, problems.fields(expected).cauchy),
        "energy": (np.array(problems.energy(state)), np.array(problems.energy(expected))),
    }
    errors = {what: float(np.abs(a - b).max() / np.abs(b).max()) for what, (a, b) in pairs.items()}
    record_verification(
        claim=f"{name} in stretches instead of invariants: worst difference of {', '.join(pairs)}",
        source="V22, exact",
        expected=0.0,
        got=max(errors.values()),
        tolerance="1e-10",
    )
    assert max(errors.values()) < 1e-10, errors
    assert solution.iterations == by_invariants.iterations


@pytest.mark.parametrize("equal", [(1.2, 1.2, 1.2), (1.5, 0.8, 0.8), (0.6, 1.4, 1.4)], ids=str)
def test_tangent_is_the_same_however_close_stretches_are(equal, record_verification):
    quartic = Ogden(mu=(4e4,), alpha=(4.0,))
    rivlin = GeneralizedRivlin.from_names({"C20": 1e4, "C10": 6e4, "C01": -2e4})
    Q, mesh = problems.rotation((1, 2, 3), 0.7), meshes.box((0.02, 0.01, 0.01), (2, 1, 1))
    systems = [System(problems.one_material(mesh, law)) for law in (quartic, rivlin)]
    p = np.random.default_rng(3).uniform(-1, 1, mesh.vertex_count)
    errors = []
    for gap in [0.0, *np.logspace(-16, -0.5, 63)]:
        move = Q @ np.diag(equal + gap * np.array([0, -0.4, 1])) @ Q.T - np.eye(3)
        unknowns = np.concatenate([(mesh.points @ move.T).ravel() / systems[0].length, p])
        got, expected = (system.tangent(unknowns, 1.0).toarray() for system in systems)
        errors.append(np.abs(got - expected).max() / np.abs(expected).max())
    record_verification(
        claim=f"Ogden α = 4 against generalized Rivlin, tangent near stretches {equal}: worst entry over largest",
        source="V22, exact",
        expected=0.0,
        got=max(errors),
        tolerance="1e-9",
    )
    assert max(errors) < 1e-9
