"""Bonds: consistent tangent, no moment, doubled nodes, what remembers them, and who refuses them."""

import numpy as np
import pytest

import meshes
import turgor as tg
from bond_cases import BOND, SIDE, cube, in_two, pulled
from refused import refused
from turgor.accuracy.adaptivity.mesh_error import why_not
from turgor.accuracy.gradients.checks import depends_on_history
from turgor.core.engine.algebra.rings import rings_of
from turgor.core.engine.bonds.bond_results import bond_results
from turgor.core.engine.system import System
from turgor.core.inp.write_inp import write_inp
from turgor.core.meshing.bodies.bodies import find_bodies
from turgor.core.meshing.bodies.parted import partners
from turgor.core.meshing.quality.self_contact import may_meet
from turgor.reduced.training.assembly import check_reducible
from turgor.units import mm

SOFT = tg.Material(name="soft", law=tg.laws.NeoHooke(C10=50e3))


def glued(**bond):
    glue = tg.bodies.Bond(name="glue", between=("low", "high"), **(BOND | bond))
    return tg.Model(cube(), SOFT, "z0", tg.Traction("z1", (10e3, 0.0, 20e3)), bonds=glue)


def opened(system, rng, by):
    """Scaled unknowns of a rough motion whose upper block moves, too."""
    mesh = system.model.mesh
    displacement = 2e-4 * rng.normal(size=mesh.points.shape)
    displacement[np.unique(mesh.cells[mesh.regions["high"]])] += by
    return system.unknowns(displacement, np.zeros(system.element.mean_count))


@pytest.mark.parametrize(("rule", "by"), [("benzeggagh-kenane", (1e-3, 5e-4, 1.5e-3)), ("power", (1e-3, 0.0, -2e-4))])
def test_the_tangent_is_that_of_finite_differences(rule, by):
    rng = np.random.default_rng(3)
    system = System(glued(mixed_mode=rule, exponent=2.0))
    at = opened(system, rng, by)
    history = system.history(system.remembered(system.evaluate(0.8 * at, 1.0)))
    assert 0 < history.bonds["glue"][0].max() < 1
    tangent = system.tangent(at, 1.0, history).toarray()
    assert np.abs(tangent - tangent.T).max() > 1e-4  # peel and shear differ
    for column in rng.choice(system.size, 25, replace=False):
        step = np.zeros(system.size)
        step[column] = 1e-6
        ends = [system.residual(at + sign * step, 1.0, history) for sign in (1, -1)]
        assert (ends[0] - ends[1]) / 2e-6 == pytest.approx(tangent[:, column], abs=1e-7 * np.abs(tangent).max())


def test_the_forces_have_no_sum_and_no_moment():
    system = System(glued())
    (term,) = system.terms.bonds
    at = system.evaluate(opened(system, np.random.default_rng(4), (1e-3, 2e-4, 1e-3)), 0.0)
    forces, place = np.zeros_like(system.points), system.configuration(at)
    term.add_forces(forces, place)
    size = np.linalg.norm(forces)
    assert size > 1e-3
    assert np.abs(forces.sum(axis=0)).max() < 1e-12 * size
    assert np.abs(np.cross(place.position, forces).sum(axis=0)).max() < 1e-11 * size


def test_nodes_between_the_regions_are_doubled():
    model = glued()
    assert [len(model.mesh.points) - len(cube().points), model.mesh.parted] == [9, (("glue_low", "glue_high"),)]
    one, other = partners(model.mesh, ("glue_low", "glue_high"))
    assert (model.mesh.points[one] == model.mesh.points[other]).all()
    assert not np.intersect1d(one, other).size
    assert len(find_bodies(model.mesh)) == 1  # the bond joins them
    assert not may_meet(model.mesh)
    assert tg.Model(model.mesh, SOFT, "z0", [], bonds=model.bonds).mesh is model.mesh


def test_a_third_region_joins_the_end_of_a_bond():
    mesh = in_two(meshes.box((SIDE, SIDE, SIDE), (2, 1, 2)), SIDE / 2)
    beyond = np.flatnonzero(mesh.points[mesh.cells][:, :4, 0].mean(axis=1) > SIDE / 2)
    regions = {name: np.setdiff1d(cells, beyond) for name, cells in mesh.regions.items()} | {"rest": beyond}
    three = tg.Mesh(points=mesh.points, cells=mesh.cells, regions=regions, faces=mesh.faces)
    glue = tg.bodies.Bond(name="glue", between=("low", "high"), **BOND)
    parted = tg.Model(three, SOFT, "z0", [], bonds=glue).mesh
    one, other = partners(parted, ("glue_low", "glue_high"))
    same = one == other
    assert same.sum() == 3  # at the end of the bond
    assert parted.points[one[same], 0] == pytest.approx(SIDE / 2)
    system = System(tg.Model(three, SOFT, "z0", [], bonds=glue))
    at = opened(system, np.random.default_rng(5), (0.0, 0.0, 5e-4))
    tangent, step = system.tangent(at, 1.0).toarray(), np.zeros(system.size)
    column = 3 * int(one[same][0]) + 2
    step[column] = 1e-6
    ends = [system.residual(at + sign * step, 1.0) for sign in (1, -1)]
    assert (ends[0] - ends[1]) / 2e-6 == pytest.approx(tangent[:, column], abs=1e-6)


def test_rings_of_both_sides_stay_apart():
    mesh = tg.mesh(tg.actuators.BellowsOfRevolution(folds=1).build(), size=6 * mm, cells="axisymmetric")
    x = mesh.points[mesh.cells, 0].mean(axis=1)
    low = x < np.median(x)
    regions = {"low": np.flatnonzero(low), "high": np.flatnonzero(~low)}
    halves = tg.Mesh(points=mesh.points, cells=mesh.cells, regions=regions, faces=mesh.faces, revolved=mesh.revolved)
    glue = tg.bodies.Bond(name="glue", between=("low", "high"), **BOND)
    parted = tg.Model(halves, SOFT, "fixed", [], bonds=glue).mesh
    one, other = partners(parted, ("glue_low", "glue_high"))
    apart, leader = one != other, rings_of(parted).leader
    assert apart.any()
    assert (leader[one] != leader[other])[apart].all()
    assert set(leader[one][apart]) <= set(one)


def test_the_next_stage_goes_on_with_the_damage():
    end = 2 * BOND["energy_peel"] / BOND["peel_strength"]
    model = pulled((0.0, 0.0, 0.5 * end))
    stages = tg.Stages(
        [tg.Stage(name="pull"), tg.Stage(name="back", displacements=[tg.Displacement("z1", (0, 0, 0.25 * end))])]
    )
    last = tg.solve(model, stages, progress=False).states[-1]
    first = tg.solve(model, progress=False).states[-1]
    damage = [bond_results(s.model, s.displacement, s.memory)["glue"].damage for s in (first, last)]
    assert damage[0].min() > 0.88
    assert damage[1] == pytest.approx(damage[0], rel=1e-3)


def test_the_energy_of_a_stabilized_run_is_balanced():
    end = 2 * BOND["energy_peel"] / BOND["peel_strength"]
    solution = tg.solve(pulled((0.0, 0.0, 1.2 * end)), tg.Stabilized(max_step=0.05), progress=False)
    energies = solution.states[-1].energies
    assert energies.lasting == pytest.approx(BOND["energy_peel"] * SIDE**2, rel=1e-6)
    assert abs(energies.missing) < 0.02 * energies.work


def test_the_energy_is_balanced_where_a_damaged_bond_closes_again():
    end = 2 * BOND["energy_peel"] / BOND["peel_strength"]
    model = pulled((0.0, 0.0, 0.5 * end), history=((0, 0), (0.5, 1), (1, 0.5)))
    states = tg.solve(model, tg.Stabilized(max_step=0.05), progress=False).states
    top = model.mesh.face_nodes("z1")
    force = states[-1].nodal_force[top, 2].sum()
    assert states[-1].energies.strain == pytest.approx(0.5 * force * 0.25 * end, rel=0.01)  # along the secant
    assert abs(states[-1].energies.missing) < 0.02 * max(state.energies.work for state in states)


def test_a_load_beyond_the_strength_ends_with_its_reason():
    glue = tg.bodies.Bond(name="glue", between=("low", "high"), **BOND)
    model = tg.Model(cube(), SOFT, "z0", tg.Traction("z1", (0.0, 0.0, 40e3)), bonds=glue)
    solution = tg.solve(model, tg.Static(min_step=0.01), progress=False, throw=False)
    assert not solution.converged
    assert "The bond 'glue' is at its strength" in solution.message
    found = next(finding for finding in solution.findings if finding.code == "T04")
    assert "between 'low' and 'high'" in found.message


@pytest.mark.parametrize(
    ("bond", "said"),
    [
        ({"peel_strength": -1.0}, ("peel_strength", "-1")),
        ({"stiffness": 1e6}, ("stiffness", "1e+06 Pa/m", "5e+06 Pa/m")),
        ({"mixed_mode": "pwer"}, ("mixed_mode", "power")),
        ({"exponent": 0.5}, ("exponent", "0.5", "1 to 10")),
        ({"between": ("low", "low")}, ("between", "low")),
        ({"between": ("low", "hihg")}, ("hihg", "high")),
        ({"unbonded": ((1.0, 0.0, 0.0), (0.0, 1.0, 1.0))}, ("unbonded", "glue")),
    ],
)
def test_refusals_name_the_key(bond, said):
    with refused(*said):
        tg.Model(
            cube(), SOFT, "z0", [], bonds=tg.bodies.Bond(**({"name": "glue", "between": ("low", "high")} | BOND | bond))
        )


def test_what_cannot_have_bonds_says_so(tmp_path):
    model = glued()
    with refused("bond 'glue'", ".inp"):
        write_inp(model, tmp_path / "a.inp")
    with refused("bond"):
        check_reducible(System(model))
    solution = tg.solve(pulled((0.0, 0.0, 1e-5)), progress=False)
    assert "the bond 'glue' is damaged" in why_not(solution)
    assert "the bond 'glue' is damaged" in depends_on_history(solution, solution.states[-1])
    with refused("bond 'glue'"):
        tg.solve(model, guide=solution, progress=False)
