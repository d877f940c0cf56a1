"""Linear equations with other supports: what is prescribed, what follows already, and what other equations imply."""

import numpy as np
import pytest
from lattice_cases import KINDS, lattice
from turgor.supports import Displacement, Equation, Fixed, NodesAt, PlaneSection, ReferencePoint, Roller, Tied

import turgor as tg
from refused import refused
from turgor.core.engine.algebra.boundary import prescribed_components
from turgor.core.engine.ties import with_equations
from turgor.core.solvers.checks.supports import free_motions

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.05e6), bulk_modulus=1e6)


def corner(*at: float) -> NodesAt:
    return NodesAt(f"corner_{'_'.join(f'{x:g}' for x in at)}", near=at)


def model_of(*supports) -> tg.Model:
    return tg.Model(lattice((2, 1, 1), KINDS["hex"]), RUBBER, supports, [tg.Traction("x1", (1.0, 0, 0))])


def moved(model: tg.Model, seed: int = 0) -> np.ndarray:
    """Random displacements that all supports allow."""
    supports = with_equations(prescribed_components(model), model)
    components = np.random.default_rng(seed).standard_normal(supports.mask.shape)
    values = supports.values(np.zeros_like(components), 1.0)
    components = np.where(supports.mask, values, components).ravel()
    components[supports.ties.followers] = 0.0
    return supports.frames.to_global(supports.ties.fill(components).reshape(-1, 3))


@pytest.mark.parametrize(
    "others",
    [
        [Fixed("x0", "xyz")],
        [PlaneSection("x1"), Fixed("x0", "x")],
        [Roller(corner(1, 1, 1), (1, 1, 0))],
        [ReferencePoint("plate", "x1")],
        [Displacement(corner(1, 0, 0), (0, 2e-3, 0))],
    ],
    ids=["fixed", "section", "roller", "plate", "moved"],
)
def test_an_equation_is_true_with_every_other_support(others) -> None:
    lever = Equation("lever", [(corner(1, 1, 1), "x", 1), (corner(1, 0, 0), (0, 1, 2), 0.5), (corner(0, 0, 1), "z", 3)])
    model = model_of(*others, lever)
    (nodes,), (vectors,) = lever.equations(model.mesh)
    u = moved(model)
    assert np.abs(u[nodes]).max() > 0.01
    assert np.einsum("mi,mi->", u[nodes], vectors) == pytest.approx(0.0, abs=1e-12)


def test_equations_in_a_chain_and_twice_are_taken_once() -> None:
    chain = [
        Equation(f"{k}", [(corner(*one), "x", 1), (corner(*other), "x", -1)])
        for k, (one, other) in enumerate(
            [((0, 0, 0), (1, 0, 0)), ((1, 0, 0), (1, 1, 0)), ((1, 1, 0), (0, 1, 0)), ((0, 1, 0), (0, 0, 0))]
        )
    ]
    model = model_of(Fixed("x1", "z"), *chain)
    u = moved(model)
    same = u[[corner(*at).nodes(model.mesh)[0] for at in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))], 0]
    assert np.ptp(same) < 1e-12
    ties = with_equations(prescribed_components(model), model).ties
    assert len(np.unique(ties.followers)) == 3
    assert not np.isin(ties.leaders, ties.followers).any()


def test_an_equation_of_what_is_moved_otherwise_is_refused() -> None:
    held = Equation("rod", [(corner(1, 0, 0), "x", 1), (corner(0, 0, 0), "x", -1)])
    model = model_of(Fixed("x0"), Displacement("x1", (1e-3, 0, 0)), held)
    with refused("'rod'"):
        prescribed = prescribed_components(model)
        with_equations(prescribed, model)
    still = model_of(Fixed("x0"), Fixed("x1"), held)
    assert not len(with_equations(prescribed_components(still), still).ties.followers)


def test_equations_count_as_supports_of_bodies() -> None:
    bare = [Fixed(corner(0, 0, 0)), Fixed(corner(0, 1, 0), "x")]
    assert free_motions(model_of(*bare)) == 2
    hinge = Equation("hinge", [(corner(1, 0, 0), "z", 1), (corner(0, 0, 0), "z", -1)])
    assert free_motions(model_of(*bare, hinge)) == 1


def test_two_bodies_are_joined_by_equations_and_ties() -> None:
    other = tg.bodies.placed(lattice((2, 2, 2), KINDS["hex"]), shift=(1, 0, 0))
    mesh = tg.bodies.together({"near": lattice((2, 1, 1), KINDS["hex"]), "far": other})
    load = [tg.Traction("x1_far", (1.0, 0, 0))]

    def free(*more) -> int:
        return free_motions(tg.Model(mesh, RUBBER, [Fixed("x0_near"), *more], load))

    assert free() == 6
    assert free(Equation("pin", [(corner(2, 0, 0), "x", 1), (corner(0, 0, 0), "x", -1)])) == 5
    assert free(Tied("x0_far", "x1_near")) == 0
    with refused("x1_far", "1e+03 mm", "0.5 %"):
        free(Tied("x1_far", "x1_near"))
