"""Every way in which a solve ends: its status, message and advice, and the path so far."""

import numpy as np
import pytest
from solver_cases import RUBBER, bar, model

from refused import refused
from turgor.core.engine.algebra.linear import available_solvers
from turgor.core.engine.runtime import EngineOptions
from turgor.core.materials.laws.laws import Hooke, NeoHooke
from turgor.core.materials.material import Material
from turgor.core.model.loads import Pressure
from turgor.core.model.model import Model
from turgor.core.model.sheets import Membrane
from turgor.core.model.supports import Displacement, Fixed
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.solution import SolveError, Status
from turgor.core.solvers.solve import solve


def test_converged_path_starts_at_rest_and_ends_at_the_full_load():
    solution = solve(model(), Static(at=(0.37,)))
    factors = [state.load_factor for state in solution.states]
    assert solution.status is Status.CONVERGED
    assert factors[0] == 0.0
    assert factors[-1] == 1.0
    assert 0.37 in factors  # hit exactly, not approached
    assert "Reached load factor 1" in solution.message


def test_stop_ends_early_with_the_reason_and_the_path_so_far():
    solution = solve(model(), stop=lambda state: "far enough" if state.load_factor > 0.1 else None, throw=False)
    assert solution.status is Status.STOPPED
    assert "far enough" in solution.message
    assert 0.1 < solution.states[-1].load_factor < 1


def test_interrupt_keeps_the_path_so_far():
    def press_control_c(iteration, state):
        if state is not None and state.load_factor > 0.1:
            raise KeyboardInterrupt

    solution = solve(model(), progress=press_control_c, throw=False)
    assert solution.status is Status.INTERRUPTED
    assert solution.states[-1].load_factor > 0.1


def test_step_limit_raises_with_the_solution_inside():
    with refused("step_limit", "load factor 0.03", "3 steps", "procedure.max_steps") as caught:
        solve(model(), Static(first_step=0.01, max_step=0.01, max_steps=3))
    assert isinstance(caught.value, SolveError)
    assert len(caught.value.solution.states) == 4


def test_impossible_load_stops_with_a_diagnosis():
    # a tip force a thousand times the modulus turns the two cells inside out at any step allowed
    solution = solve(model(-1e9), Static(min_step=1e-3), throw=False)
    assert solution.status in (Status.LIMIT_POINT, Status.STEP_TOO_SMALL)
    assert solution.advice
    assert len(solution.states) >= 1
    assert not solution.steps[-1].accepted


def test_free_body_is_refused():
    free = Model(bar(), {"body": RUBBER}, [Fixed("fixed", "x")], [Pressure("top", 1.0)])
    with refused("3 of 6", "B01", "'fixed'"):
        solve(free)


def test_undetermined_mean_stress_is_refused():
    still = Displacement("*", lambda points, load_factor: np.zeros_like(points))
    with refused("B01", "incompressible", "bulk_modulus"):
        solve(Model(bar(), {"body": RUBBER}, [still], []))
    soft = Material(name="soft", law=NeoHooke(C10=0.1e6), bulk_modulus=1e8)
    assert solve(Model(bar(), {"body": soft}, [still], [])).converged


def test_linear_solvers_agree():
    if "mkl-pardiso" not in available_solvers():
        pytest.skip("MKL is optional")
    ends = [
        solve(model(), options=EngineOptions(linear_solver=name)).states[-1].displacement
        for name in ("rslab", "mkl-pardiso")
    ]
    assert np.allclose(*ends, rtol=0, atol=1e-8 * np.abs(ends[0]).max())


def test_threads_do_not_change_the_answer():
    one, two = (solve(model(), options=EngineOptions(threads=n)).states[-1].displacement for n in (1, 2))
    assert np.array_equal(one, two)


def test_unknown_linear_solver_names_the_known_ones():
    with refused("rslap", "rslab"):
        solve(model(), options=EngineOptions(linear_solver="rslap"))


def test_stiff_membrane_takes_the_load():
    sheet = Membrane(Material(name="sheet", law=Hooke(E=1e9, nu=0.3)), 1e-4)
    bare = solve(model()).states[-1]
    clad = solve(Model(bar(), {"body": RUBBER, "top": sheet}, [Fixed("fixed")], model().loads)).states[-1]
    assert np.abs(clad.displacement).max() < np.abs(bare.displacement).max()


@pytest.mark.parametrize(
    ("changes", "facts"),
    [
        ({"first_step": 0.0}, ("procedure.first_step", 0, "more than 0 up to 1")),
        ({"max_step": 1.5}, ("procedure.max_step", 1.5, "more than 0 up to 1")),
        ({"min_step": 0.2, "first_step": 0.1}, ("procedure.min_step is 0.2", "first_step, 0.1")),
        ({"tolerance": 1.0}, ("procedure.tolerance", 1, "1e-12 to 0.01")),
        ({"at": (1.5,)}, ("procedure.at", 1.5, "(0, 1]")),
        ({"max_iterations": 0}, ("procedure.max_iterations", 0, "1 or more")),
    ],
)
def test_bad_procedure_names_field_value_and_range(changes, facts):
    with refused(*facts):
        Static(**changes)
