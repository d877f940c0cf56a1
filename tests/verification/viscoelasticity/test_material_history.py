"""V17: finite elements relax, creep and soften as the material does at a point.

Problem: a cube of irregular cells stretched along x, its sides free: suddenly by 1.5 and held; in cycles with a Prony
series, with stress softening, with both, with a network that flows and with a permanent set; laws in invariants and in
stretches. The pull is the reaction over the area.
Exact: the relaxation of `test_relaxation`; `stress_history` of the material at the times of the states, which takes the
same steps. Source: the recursion of `turgor.core.materials.history.viscoelastic`.
Tolerance: 1e-4 for the relaxation, the error of a ramp of 0.1 ms; 1e-6 against the material, with a tolerance of 1e-10
for Newton's method. The tangent is compared with central differences, 1e-6 of its largest entry.
"""

from dataclasses import replace
from math import inf

import numpy as np
import pytest

import meshes
import problems
import turgor as tg
from turgor.core.engine.system import System
from turgor.core.materials.history.bergstrom_boyce import BergstromBoyce
from turgor.core.materials.history.permanent_set import PermanentSet
from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.stress_history import stress_history
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.laws.laws import Ogden
from turgor.core.solvers.procedures.static import Static

TIMES = np.array([0.5, 1, 2, 5, 10, 20, 50, 100])
TABLE = [0.2321620, 0.2188951, 0.2049315, 0.1930402, 0.1866552, 0.1807618, 0.1775040, 0.1773345]  # MPa
SERIES = Prony(g=(0.2, 0.1), tau=(1.0, 10.0), moduli="instantaneous")
SLOW = replace(SERIES, moduli="long_term")
MULLINS = Mullins(r=1.8, m=8e3, beta=0.1)
OGDEN = Ogden(mu=(8e4, 2e3, -1e4), alpha=(1.7, 5.0, -2.3))
FLOWING = BergstromBoyce(stiffness=1.5, rate=0.2, stress=1e5, exponent=3.0)
SETTING = PermanentSet(stress=3e6, exponent=1.5, onset=2e4)
RIVLIN = tg.laws.MooneyRivlin(C10=0.08e6, C01=0.03e6)


def remembering(law, series=None, mullins=None, plastic=None, bulk_modulus=inf):
    rubber = problems.rubber(law, bulk_modulus)
    return replace(rubber, viscoelasticity=series, stress_softening=mullins, permanent_set=plastic)


def cube(material, stretch):
    """An irregular cube whose end face is moved to a stretch that depends on the load factor."""
    mesh = meshes.box((1.0, 1.0, 1.0), (2, 2, 2))
    inside = np.setdiff1d(np.arange(len(mesh.points)), meshes.surface(mesh))
    points = mesh.points.copy()
    points[inside] += np.random.default_rng(7).uniform(-0.03, 0.03, (len(inside), 3))
    mesh = meshes.with_points(mesh, points)
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("z0", "z")]
    supports.append(tg.Displacement("x1", lambda X, t: (stretch(t) - 1) * X, "x"))
    return tg.Model(mesh, materials={"body": material}, supports=supports, loads=[])


def pulls(solution):
    """Force on the unit area of the end face at every state [Pa]."""
    return np.array([problems.reaction(state, "x1")[0] for state in solution.states])


def test_relaxation_after_a_sudden_stretch(record_verification):
    model = cube(remembering(problems.NEO_HOOKE, SERIES), lambda t: 1 + 0.5 * min(t / 1e-6, 1.0))
    procedure = Static(duration=100.0, at=(1e-6, *(TIMES / 100)), max_step=1.0, first_step=1.0)
    solution = problems.solve(model, procedure)
    assert [state.time for state in solution.states] == pytest.approx([0, 1e-4, *TIMES])
    result = pulls(solution)[2:] / 1e6
    record_verification(
        claim="cube stretched to 1.5 at once: pull at 0.5, 1, 2, 5, 10, 20, 50, 100 s [MPa]",
        source="V17, exact",
        expected=TABLE,
        got=result,
        tolerance="1e-4",
    )
    assert result == pytest.approx(TABLE, rel=1e-4)
    # the fields know what the state remembers
    cauchy = problems.fields(solution.states[-1]).cauchy
    assert cauchy[..., 0, 0] == pytest.approx(1.5e6 * TABLE[-1], rel=1e-4)


CASES = {
    "relaxing, invariants": (RIVLIN, SERIES, None),
    "relaxing, stretches": (OGDEN, SLOW, None),
    "softening, invariants": (RIVLIN, None, MULLINS),
    "softening, stretches": (OGDEN, None, MULLINS),
    "both, invariants": (RIVLIN, SLOW, MULLINS),
    "both, stretches": (OGDEN, SERIES, MULLINS),
    "flowing, stretches": (OGDEN, FLOWING, None),
    "setting and softening, invariants": (RIVLIN, None, MULLINS, SETTING),
    "flowing, setting and softening, invariants": (RIVLIN, FLOWING, MULLINS, SETTING),
}


def cycles(t):
    """Stretch to 1.6, back to 1.1, to 1.6 again, on to 1.8 and back to 1.1."""
    return np.interp(t, [0, 0.2, 0.4, 0.6, 0.7, 1.0], [1, 1.6, 1.1, 1.6, 1.8, 1.1])


@pytest.mark.parametrize("case", CASES)
def test_cycles_follow_the_material(case, record_verification):
    material = remembering(*CASES[case])
    at = tuple(np.linspace(0.05, 1.0, 20).round(3))
    solution = problems.solve(cube(material, cycles), Static(duration=8.0, at=at, max_step=0.05, tolerance=1e-10))
    time = np.array([state.time for state in solution.states])
    exact = stress_history(material, "uniaxial", time, cycles(time / 8.0)).nominal_stress
    result = pulls(solution)
    worst = np.abs(result - exact).max() / exact.max()
    record_verification(
        claim=f"cube in three cycles, {case}: pull against the material's own history, of the largest",
        source="stress_history",
        expected=0.0,
        got=worst,
        tolerance="1e-6",
    )
    assert worst < 1e-6
    if material.viscoelasticity is None:  # reloading to the same stretch follows the unloading
        down, up = result[4:9][::-1], result[8:13]
        assert up == pytest.approx(down, rel=1e-6)
        assert up[2] < 0.9 * result[2]


@pytest.mark.parametrize("case", CASES)
def test_the_tangent_is_the_derivative_of_the_residual(case, record_verification):
    errors = [_tangent_error(case, further, bulk) for further in (0.8, 1.3) for bulk in (inf, 1e6)]
    claim = f"tangent against differences, {case}: unloading and loading, incompressible and compressible"
    record_verification(claim, "V17, V24", [0.0] * 4, errors, "1e-6 of the largest entry")
    assert max(errors) < 1e-6


def _tangent_error(case, further, bulk_modulus):
    """Worst entry of tangent less differences, over the largest."""
    material = remembering(*CASES[case], bulk_modulus=bulk_modulus)
    mesh = meshes.box((0.02, 0.01, 0.01), (1, 1, 1), lambda X: X + 3 * X[:, [1, 2, 0]] ** 2)
    system = System(tg.Model(mesh, {"body": material}, [tg.Fixed("x0")], []))
    rng = np.random.default_rng(3)
    u = mesh.points @ (0.3 * rng.uniform(-1, 1, (3, 3)))
    first = system.unknowns(u, rng.uniform(-1, 1, mesh.vertex_count) * system.stress_scale)
    memory = system.remembered(system.evaluate(first, 0.0, history=system.history(step=0.7)))
    history = system.history(memory, 0.4)
    x = further * first + rng.normal(0, 1e-3, system.size)
    tangent = system.tangent(x, 0.0, history).toarray()
    h, columns = 1e-5, []
    for step in h * np.eye(system.size):
        ends = [system.residual(x + sign * step, 0.0, history) for sign in (1, -1)]
        columns.append((ends[0] - ends[1]) / (2 * h))
    difference = np.array(columns).T
    return float(np.abs(tangent - difference).max() / np.abs(tangent).max())


@pytest.mark.parametrize("case", ["relaxing, invariants", "both, stretches"])
def test_newton_needs_no_more_iterations(case):
    law, series, mullins = CASES[case]
    procedure = Static(duration=8.0, at=tuple(np.linspace(0.05, 1.0, 20).round(3)), max_step=0.05)
    plain = problems.solve(cube(problems.rubber(law), cycles), procedure)
    result = problems.solve(cube(remembering(law, series, mullins), cycles), procedure)
    assert result.iterations <= plain.iterations + len(plain.steps) // 2


def test_without_a_duration_everything_has_relaxed(record_verification):
    """And constants of a slow test give what they give without a Prony series."""
    at = (0.1, 0.2)
    plain, slow, quick = (
        pulls(problems.solve(cube(material, cycles), Static(at=at, tolerance=1e-10)))
        for material in (problems.rubber(RIVLIN), remembering(RIVLIN, SLOW), remembering(RIVLIN, SERIES))
    )
    claim = "cube without a duration: pull over that of its law, long-term and instantaneous constants"
    record_verification(claim, "V17, exact", [1.0, 0.7], [slow[-1] / plain[-1], quick[-1] / plain[-1]], "1e-8")
    assert slow == pytest.approx(plain, rel=1e-8)
    assert quick == pytest.approx(0.7 * plain, rel=1e-8)
