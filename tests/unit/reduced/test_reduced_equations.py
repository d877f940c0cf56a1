"""The equations of a reduced model are those of the full one, contracted with its modes."""

from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest
from reduced_cases import PRESSURE, built, drive, finger, path, system

from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.reduced.parts.polynomials import Cubics, packed
from turgor.reduced.parts.touching import Touching
from turgor.reduced.settings import TRAINING
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.states.newton import Balance, follow, newton
from turgor.reduced.states.spline import Spline
from turgor.reduced.training import build as build_module
from turgor.reduced.training.assembly import assemble
from turgor.reduced.training.box import corners, inputs_of
from turgor.reduced.training.build import bases, modes_needed
from turgor.reduced.training.sampling import choose

RANDOM = np.random.default_rng(5)


def somewhere() -> tuple[np.ndarray, np.ndarray]:
    """Coordinates near a trained state that is no equilibrium, and its inputs."""
    made = built()
    place = len(made.y) // 2
    return made.y[place] * (1 + 0.02 * RANDOM.standard_normal(made.y.shape[1])), made.inputs[place]


def full_unknowns(y: np.ndarray) -> np.ndarray:
    """Unknowns of the full model at reduced coordinates."""
    made, r = built(), built().equations.sizes[0]
    moved, pressed = made.modes.vectors @ y[:r], made.stresses.vectors @ y[r:]
    return np.concatenate([moved, pressed])


def test_volume_and_constraint_are_the_full_ones_to_round_off():
    made, (y, _) = built(), somewhere()
    r = made.equations.sizes[0]
    values = made.equations.cubics.at(y[:r]).values
    moved = (made.modes.vectors @ y[:r]).reshape(-1, 3) * system().length
    mesh = finger().mesh
    volume = cavity_volume(mesh, "cavity", moved) / mesh.symmetry_factor / system().length ** 3
    assert values[0] == pytest.approx(volume, rel=1e-12)
    at = system().evaluate(full_unknowns(y), 0.0)
    lost = at.residual[3 * system().node_count :][: system().element.mean_count]
    assert values[1:] == pytest.approx(made.stresses.vectors.T @ lost, abs=1e-12 * np.abs(lost).sum())


def test_cubic_polynomials_are_the_sums_of_their_terms():
    R, q = 5, np.append(1.0, RANDOM.standard_normal(4))
    forms = RANDOM.standard_normal((3, R, R, R))
    forms = sum(forms.transpose(0, *order) for order in permutations((1, 2, 3)))
    at = Cubics(packed(forms), R).at(q[1:])
    assert at.values == pytest.approx(np.einsum("pijk,i,j,k->p", forms, q, q, q), rel=1e-12)
    assert at.gradients == pytest.approx(3 * np.einsum("pijk,j,k->pi", forms, q, q)[:, 1:], rel=1e-12)
    factors = np.array([1.0, -2.0, 0.5])
    assert at.hessian(factors) == pytest.approx(6 * np.einsum("p,pijk,k->ij", factors, forms, q)[1:, 1:], rel=1e-12)


def test_residual_without_sampling_is_the_projected_full_one():
    made, (y, inputs) = built(), somewhere()
    residual = made.whole.equations.at(y, inputs).residual
    full = system().evaluate(full_unknowns(y), inputs[1] / finger().pressures[0].pressure)
    assert not full.contacts.touch  # its search is a matter of its own
    projected = made.modes.vectors.T @ full.residual[: 3 * system().node_count]
    assert residual[: len(projected)] == pytest.approx(projected, abs=1e-10 * np.abs(full.residual).sum())


def test_contact_forces_are_the_projected_full_ones():
    made = built()
    moved = path().displacements[-1]
    at = system().evaluate(np.concatenate([moved.ravel(), path().mean_stresses[-1]]), 1.0)
    part, gaps = system().contact.parts[0], at.contacts.gaps[0]
    assert gaps.inside.any()
    projected = made.modes.vectors.T @ part.forces(at.contacts.position, gaps).ravel()
    touching = next(each for each in made.equations.parts if isinstance(each, Touching))
    force = touching.at(
        made.y[-1, : len(projected)]
    ).forces()  # at the projection of the state, which is a bit elsewhere
    assert force == pytest.approx(projected, abs=0.2 * np.abs(projected).max())


@pytest.mark.parametrize("place", [3, -1])
def test_tangents_are_derivatives(place):
    made = built()
    y, inputs = made.y[place], made.inputs[place]
    for equations in (made.equations, made.whole.equations):
        way, step = RANDOM.standard_normal(len(y)), 1e-6
        ends = [equations.at(y + sign * step * way, inputs).residual for sign in (1, -1)]
        difference = (ends[0] - ends[1]) / (2 * step)
        assert equations.at(y, inputs).tangent() @ way == pytest.approx(difference, abs=1e-6 * np.abs(difference).max())


def test_few_points_give_the_states_of_all_points():
    made = built()
    assert made.counts["points"] < 0.005 * len(made.whole.rubber.weights)
    for equations in (made.equations, made.whole.equations):
        found = follow(equations, made.y[3], (made.inputs[3], made.inputs[4]), made.size)
        assert isinstance(found, Balance)
        assert np.linalg.norm(found.at.y[:6] - made.y[4, :6]) < 5e-3 * made.size


def test_a_larger_wanted_error_needs_fewer_points():
    assert build_module.build(system(), drive(), [path()], 6, 0.05).counts["points"] < built().counts["points"]


def test_as_many_mean_stress_modes_as_displacement_modes_lock():
    """As many constraints as coordinates leave nothing to move: displacements are off, mean stresses without bounds."""
    made = built()
    basis, stresses = bases(system(), [path()], 6, 6)
    whole = assemble(system(), drive(), basis, stresses)
    assert basis.vectors == pytest.approx(made.modes.vectors)  # so the projection error is as good, the answer is not
    y = np.concatenate([made.y[4, :6], stresses.dual.T @ path().mean_stresses[3]])
    found = newton(whole.equations, y, made.inputs[5], made.size)
    half = newton(made.equations, made.y[4], made.inputs[5], made.size)
    assert isinstance(found, Balance)
    assert isinstance(half, Balance)
    errors = [np.linalg.norm(each.at.y[:6] - made.y[5, :6]) for each in (found, half)]
    assert errors[0] > 5 * errors[1]
    assert np.linalg.norm(found.at.y[6:]) > 50 * np.linalg.norm(half.at.y[6:])


def test_mean_stress_modes_are_half_as_many_and_not_too_many(monkeypatch):
    assert bases(system(), [path()], 6)[1].vectors.shape[1] == 3
    monkeypatch.setattr(build_module, "TRAINING", replace(TRAINING, pressed=2))
    assert bases(system(), [path()], 6)[1].vectors.shape[1] == 2


def test_rows_without_weights_amplify_soft_directions():
    """As many cells chosen by their forces, not by what these move: the error of the coordinates is larger."""
    made = built()
    whole, r = made.whole, made.equations.sizes[0]
    starts = np.append(np.flatnonzero(np.diff(whole.cells, prepend=-1)), len(whole.cells))
    ats = [whole.equations.at(y, inputs) for y, inputs in zip(made.y, made.inputs, strict=True)]
    inverses = [np.linalg.inv(at.tangent())[:r, :r] for at in ats]
    plain = [at.parts[0].forces(starts).T for at in ats]
    rows = np.vstack([inverse @ forces for inverse, forces in zip(inverses, plain, strict=True)])
    errors = []
    for matrix in (rows, np.vstack(plain)):
        chosen = choose(matrix, matrix.sum(axis=1), 0.0, 10)
        assert len(chosen.which) == 10
        errors.append(np.linalg.norm(rows[:, chosen.which] @ chosen.factors - rows.sum(axis=1)))
    assert errors[1] > 3 * errors[0]


def test_whole_cells_need_more_of_them_than_their_isochoric_energy_alone():
    """As many cells chosen with their mean stress and lost volume leave larger errors of the coordinates."""
    made, parts = built(), system()
    whole, (r, _) = made.whole, made.equations.sizes
    starts = np.append(np.flatnonzero(np.diff(whole.cells, prepend=-1)), len(whole.cells))
    order, points, rows = whole.cells[starts[:-1]], whole.rubber, []
    psi = np.einsum("qm,cmk->cqk", parts.element.tables.M, made.stresses.vectors[parts.element.mean[order]])
    psi = psi.reshape(len(points.weights), -1)
    for y, inputs in zip(made.y, made.inputs, strict=True):
        at = whole.equations.at(y, inputs)
        F = (np.eye(3).ravel() + points.gradients @ y[:r]).reshape(-1, 3, 3)
        J = np.linalg.det(F)
        slopes = np.einsum("p,pji,pijr->pr", J, np.linalg.inv(F), points.gradients.reshape(-1, 3, 3, r))
        stressed = np.add.reduceat((points.weights * (psi @ y[r:]))[:, None] * slopes, starts[:-1])
        lost = np.add.reduceat((points.weights * (J - 1))[:, None] * psi, starts[:-1])
        assert lost.sum(axis=0) == pytest.approx(at.cubics.values[1:], abs=1e-12)
        inverse, forces = np.linalg.inv(at.tangent())[:r], at.parts[0].forces(starts)
        rows.append((inverse[:, :r] @ forces.T, inverse @ np.hstack([forces + stressed, lost]).T))
    isochoric, whole_cells = (np.vstack(each) for each in zip(*rows, strict=True))
    errors = [
        choose(matrix, matrix.sum(axis=1), 0.0, 10).error * np.linalg.norm(matrix.sum(axis=1))
        for matrix in (isochoric, whole_cells)
    ]
    assert errors[1] > 10 * errors[0]


def test_plain_tangents_need_more_updates_next_to_a_stiff_sheet():
    made = built()
    equations, y, aim = made.whole.equations, made.y[3], made.inputs[6]
    at, updates = equations.at(y, aim), 0
    for updates in range(1, 31):  # noqa: B007
        update = -np.linalg.solve(at.tangent(), at.residual)
        at = equations.at(at.y + update, aim)
        if at is None or np.linalg.norm(update[:6]) < 1e-5 * made.size:
            break
    found = newton(equations, y, aim, made.size)
    assert isinstance(found, Balance)
    assert at is None or updates > found.iterations


def test_spline_goes_through_its_points_with_their_slopes():
    place = np.random.default_rng(0).uniform(0, 2, (40, 2))
    values, slopes = np.sin(place.sum(axis=1))[:, None], np.cos(place.sum(axis=1))[:, None, None] * np.ones((1, 1, 3))
    inputs = np.column_stack([np.zeros(40), place])  # the first input does not count
    spline = Spline.through(np.array([0.0, 0.5, 0.5]), *(np.concatenate([a, a[:1]]) for a in (inputs, values, slopes)))
    assert spline.at(inputs[4]) == pytest.approx(values[4], abs=1e-5)
    step = np.array([0.0, 1e-4, 0.0])
    slope = (spline.at(inputs[4] + step) - spline.at(inputs[4] - step)) / 2e-4
    assert slope == pytest.approx(slopes[4, :, 1], abs=1e-4)
    assert spline.at(np.array([0.0, 1.0, 0.7])) == pytest.approx([np.sin(1.7)], abs=2e-3)


def test_spline_of_one_input_is_the_cubic_one_of_hermite():
    x = np.array([[0.0], [1.0]])
    spline = Spline.through(np.ones(1), x, x**3, 3 * x[:, :, None] ** 2)
    assert spline.at(np.array([0.3])) == pytest.approx([0.027], abs=1e-6)


def test_corners_leave_rest_out():
    box = inputs_of(finger(), {"loads.pressure": (0.0, PRESSURE)})
    assert [corner.tolist() for corner in corners(box)] == [[PRESSURE]]


def test_training_of_many_inputs_begins_at_a_balanced_part_of_the_corners():
    names = tuple("abcdefghi")
    shares = np.array(corners(Inputs(names, np.zeros(9), np.ones(9), ("",) * 9)))
    assert (shares[0] == 1).all() and len(shares) == 16
    assert len(np.unique(shares[:, :4], axis=0)) == 16
    for i in range(9):
        for j in range(i):
            assert (np.unique(shares[:, [i, j]], axis=0, return_counts=True)[1] == 4).all()


def test_modes_at_first_are_as_many_as_the_states_need():
    count = modes_needed(system(), [path()], 1e-3, 12)
    states = path().displacements.reshape(len(path().displacements), -1)
    missed = []
    for modes in (count - 1, count):
        basis, _ = bases(system(), [path()], modes)
        missed.append(np.abs(states - states @ basis.dual @ basis.vectors.T).max() / np.abs(states).max())
    assert missed[1] <= 1e-3 < missed[0]
    assert modes_needed(system(), [path()], 1e-9, 3) == 3
