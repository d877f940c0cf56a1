"""States of threads before loading: shrinkage, swelling, pre-stretch and temperature of windings.

Problems: a bar of neo-Hookean rubber (C10 = 0.1 MPa, 20 × 4 × 4 mm) with 16 threads along its sides, smeared and
discrete, free or between fixed planes; a quarter of a slice of a tube whose hoops shrink.
Exact: threads of the length λ₀ without stress, for one in the mesh, have the tension E A (λ / λ₀ − 1). The rubber of
the free bar has 2 C10 (λ − λ⁻²) times its section, and both add up to nothing; between fixed planes the threads alone
pull. A thick tube under pressure follows `fiber_tube`, whose families have the same length without stress. A thin tube
of the thickness t and a given length has 2 C10 t (λ − λ⁻³) + k (λ / λ₀ − 1) = 0, with the stiffness k of hoops per
width. Tolerances: 1e-6 for homogeneous states; 0.2 % of the widening of the thick tube, as in V07; 2 % for the thin
one, whose radius is 50 times its thickness.
"""

import numpy as np
import pytest
from scipy.optimize import brentq
from turgor.loads import Hardening, PreStretch, Shrinkage, Stiffness, Swelling, Temperature

import meshes
import problems
import slices
import turgor as tg
from differences import difference
from fiber_tube import FiberTube
from refused import refused
from turgor.core.engine.fibers.fiber_term import BendingTerm
from turgor.core.engine.system import System
from turgor.core.engine.term import Configuration
from turgor.core.materials.strength import Strength
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.solvers.checks.tearing.uses import uses
from turgor.reduced.training.box import inputs_of
from turgor.units import MPa, mm

LENGTH, SIDE, C10 = 20 * mm, 4 * mm, 0.1 * MPa
COUNT, STRETCHING = 16, 100 * MPa * np.pi / 4 * (0.1 * mm) ** 2
FORMS = ("smeared", "discrete")
PLANE = (tg.supports.PlaneSection("x1"),)
HELIX = tg.Winding(angle_from_axis=0.7, spacing=2 * mm, hand="both")


def _threads(**more):
    sources = dict.fromkeys(("tensile_strength", "elongation_at_break"), "chosen")
    bears = Strength(tensile_strength=10 * MPa, elongation_at_break=0.2, sources=sources)
    thread = tg.Material(name="thread", law=tg.laws.Hooke(E=100 * MPa, nu=0.3), strength=bears)
    straight = tg.Winding(angle_from_axis=0.0, spacing=1 * mm)
    stated = {"face": ("y0", "y1", "z0", "z1"), "winding": straight, "name": "threads"} | more
    return tg.Fibers(material=thread, diameter=0.1 * mm, **stated)


def _bar(loads, more=PLANE, **fibers):
    mesh = meshes.box((LENGTH, SIDE, SIDE), (2, 1, 1), kind=HEXAHEDRON)
    edges = [tg.supports.NodesAt(f"edge_{face}", edge=("x0", face)) for face in ("y0", "z0")]
    supports = [tg.Fixed("x0", "x"), tg.Fixed(edges[0], "y"), tg.Fixed(edges[1], "z"), *more]
    rubber = problems.rubber(tg.laws.NeoHooke(C10=C10))
    return tg.Model(mesh, {"body": rubber}, supports, loads, reinforcements=[_threads(**fibers)])


def _stretch(rest, stiffness=1.0, compression=0.0):
    """Length of the free bar over that in the mesh, for threads of the length ``rest`` without stress."""

    def force(x):
        share = stiffness * (1.0 if x >= rest else compression)
        return 2 * C10 * SIDE**2 * (x - x**-2) + COUNT * STRETCHING * share * (x / rest - 1)

    return brentq(force, 0.5, 2.0, xtol=1e-14)


WARM = Temperature("threads", 333.15, expansion=-1e-3, modulus=[(293.15, 1.0), (333.15, 0.5)])
SEVERAL = (Shrinkage("threads", 0.1), PreStretch("threads", 1.1), Stiffness("threads", 3.0))
#: Loads, length of the threads without stress, stiffness over that of their material, share of it in compression.
CASES = {
    "pre-stretch": ((PreStretch("threads", 1.05),), 1 / 1.05, 1.0, 0.0),
    "shrinkage": ((Shrinkage("threads", 0.1),), 0.9, 1.0, 0.0),
    "swelling of rods": ((Swelling("threads", 1.1**3),), 1.1, 1.0, 1.0),
    "heat": ((WARM,), 0.96, 0.5, 0.0),
    "two states and a factor": (SEVERAL, 0.9 / 1.1, 3.0, 0.0),
}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("case", CASES)
def test_threads_along_a_free_bar(case, form, record_verification):
    loads, rest, stiffness, compression = CASES[case]
    state = problems.solve(_bar(loads, form=form, compression=compression)).states[-1]
    got, expected = np.ptp(problems.current(state)[:, 0]) / LENGTH, _stretch(rest, stiffness, compression)
    record_verification(
        claim=f"bar with {form} threads along it, {case}: stretch",
        source="sum of the forces of rubber and threads",
        expected=expected,
        got=got,
        tolerance="1e-6",
    )
    assert abs(expected - 1) > 0.01
    assert got == pytest.approx(expected, rel=1e-6)
    (result,) = tg.measures.fiber_results(state)
    assert result.stretch == pytest.approx(expected / rest, rel=1e-6)
    assert result.tension == pytest.approx(stiffness * STRETCHING * (expected / rest - 1), rel=1e-5)
    rubber = C10 * SIDE**2 * LENGTH * (expected**2 + 2 / expected - 3)
    threads = COUNT * STRETCHING * stiffness * LENGTH * rest * 0.5 * (expected / rest - 1) ** 2
    assert problems.energy(state) == pytest.approx(rubber + threads, rel=1e-5)


@pytest.mark.parametrize("form", FORMS)
def test_threads_between_fixed_planes_pull_alone(form, record_verification):
    state = problems.solve(_bar([PreStretch("threads", 1.04)], [tg.Fixed("x1", "x")], form=form)).states[-1]
    got, expected = float(problems.reaction(state, "x1")[0]), COUNT * STRETCHING * 0.04
    record_verification(
        claim=f"bar between fixed planes with {form} threads stretched to 1.04: force [N]",
        source="Hooke's law of the threads",
        expected=expected,
        got=got,
        tolerance="1e-6",
    )
    assert got == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("form", FORMS)
def test_threads_use_their_strength_by_their_tension(form):
    loads = [PreStretch("threads", 1.08), Stiffness("threads", 0.5)]
    state = problems.solve(_bar(loads, [tg.Fixed("x1", "x")], form=form)).states[-1]
    stretch, stress = uses(state.model, state.displacement, lambda: problems.fields(state), 1.0)
    assert (stretch.value, stress.value) == pytest.approx((1.08, 0.5 * 100 * MPa * 0.08), rel=1e-6)
    assert (stretch.share, stress.share) == pytest.approx((0.08 / 0.2, 4 / 10), rel=1e-6)
    early = uses(state.model, state.displacement, lambda: problems.fields(state), 0.5)
    assert early[0].value == pytest.approx(1.08**0.5, rel=1e-6)


def test_threads_that_swell_go_slack():
    state = problems.solve(_bar([Swelling("threads", 1.1)])).states[-1]
    (result,) = tg.measures.fiber_results(state)
    assert np.abs(state.displacement).max() < 1e-9 * LENGTH
    assert result.stretch == pytest.approx(1.1 ** (-1 / 3))
    assert result.tension == pytest.approx(0.0, abs=1e-12)


def test_state_of_threads_follows_its_history():
    load = Shrinkage("threads", 0.1, history=((0, 0), (0.5, 1), (1, 0.5)))
    states = problems.solve(_bar([load]), tg.Static(at=(0.5,))).states
    lengths = {round(s.load_factor, 6): np.ptp(problems.current(s)[:, 0]) / LENGTH for s in states}
    assert lengths[0.5] == pytest.approx(_stretch(0.9), rel=1e-6)
    assert lengths[1.0] == pytest.approx(_stretch(0.9**0.5), rel=1e-6)


@pytest.mark.parametrize("procedure", [tg.ArcLength(), tg.Stabilized()], ids=lambda p: type(p).__name__)
def test_other_procedures_reach_the_same_length(procedure):
    state = problems.solve(_bar([Shrinkage("threads", 0.1)]), procedure).states[-1]
    assert np.ptp(problems.current(state)[:, 0]) / LENGTH == pytest.approx(_stretch(0.9), rel=1e-4)


def test_energy_of_threads_is_in_the_balance_of_a_motion():
    model = _bar([Shrinkage("threads", 0.1)], [tg.Fixed("x1", "x")])
    heavy = problems.rubber(tg.laws.NeoHooke(C10=C10), density=1000.0)
    model = tg.Model(model.mesh, heavy, model.supports, model.loads, reinforcements=model.reinforcements)
    energies = problems.solve(model, tg.Dynamic(duration=0.05, accuracy=1e-3)).states[-1].energies
    assert energies.strain == pytest.approx(COUNT * STRETCHING * LENGTH * 0.9 * 0.5 * (1 / 0.9 - 1) ** 2, rel=1e-3)
    assert abs(energies.missing) < 1e-3 * energies.strain


def test_tension_by_the_shrinkage(record_verification):
    solution = problems.solve(_bar([Shrinkage("threads", 0.1)]), tg.Static(tolerance=1e-10))
    got = tg.gradient(solution, "maximum_fiber_tension", ["loads.shrinkage.linear"], options=problems.OPTIONS)
    h = 1e-5
    high, low = (STRETCHING * (_stretch(rest) / rest - 1) for rest in (0.9 - h, 0.9 + h))
    record_verification(
        claim="bar with threads along it: tension by their shrinkage [N]",
        source="derivative of the exact tension",
        expected=(high - low) / (2 * h),
        got=got["maximum_fiber_tension", "loads.shrinkage.linear"],
        tolerance="1e-4",
    )
    assert got["maximum_fiber_tension", "loads.shrinkage.linear"] == pytest.approx((high - low) / (2 * h), rel=1e-4)


# %% Tubes whose hoops shrink

INNER, OUTER, HOOPS = 6.35 * mm, 8.35 * mm, 2000.0  # N/m


def test_hoops_that_shrink_tighten_a_thick_tube(record_verification):
    tube = FiberTube(inner=INNER, outer=OUTER, shear_modulus=2 * C10, families=[(HOOPS, 0.0)], rest=0.9)
    law, hoops = tg.laws.NeoHooke(C10=C10), slices.family(HOOPS, 0.0)
    model = slices.wound(slices.quarter(INNER, OUTER), law, [hoops], loads=[Shrinkage("outside", 0.1)])
    pressure = 5e3
    (result,) = slices.follow(model, [(pressure, 1.0)])
    a, pull, _ = tube.inflated(pressure, 1.0)
    record_verification(
        claim="tube of 5 kPa with hoops that shrink by 10 %: inner radius [mm], pull at its ends [N]",
        source="extension and inflation, exact",
        expected=[a / mm, pull],
        got=[result.inner / mm, result.pull],
        tolerance="0.2 % of the change of the radius, 0.2 %",
    )
    assert a / INNER < 0.95
    assert result.inner / INNER - 1 == pytest.approx(a / INNER - 1, rel=2e-3)
    assert result.pull == pytest.approx(pull, rel=2e-3)


def test_hoops_that_cool_tighten_a_thin_tube(record_verification):
    wall, cold = 0.2 * mm, Temperature("outside", 253.15, expansion=2e-3)
    radius, stiffness, rest = 50 * wall, 200.0, 1 - 0.08
    mesh = slices.quarter(radius - wall / 2, radius + wall / 2, (1, 3, 1))
    supports = [tg.Fixed("z0", "z"), tg.Fixed("z1", "z")]
    model = slices.wound(mesh, tg.laws.NeoHooke(C10=C10), [slices.family(stiffness, 0.0)], supports, [cold])
    state = problems.solve(model).states[-1]
    got = problems.mean_radius(state, "outside", (0, 1)) / (radius + wall / 2)

    def force(x):
        return 2 * C10 * wall * (x - x**-3) + stiffness * (x / rest - 1)

    expected = brentq(force, 0.5, 1.0)
    record_verification(
        claim="thin tube with hoops that cool by 40 K: change of its radius",
        source="tension of a membrane in plane strain",
        expected=expected - 1,
        got=got - 1,
        tolerance="2 %",
    )
    assert -0.07 < expected - 1 < -0.03
    assert got - 1 == pytest.approx(expected - 1, rel=0.02)
    force_around = tg.measures.winding_force_per_length(state)
    assert force_around == pytest.approx(stiffness * (expected / rest - 1), rel=0.02)


# %% Equations and refusals


@pytest.mark.parametrize("form", FORMS)
def test_tangent_with_states_of_threads_is_the_derivative_of_the_residual(form, record_verification):
    loads = [Shrinkage("threads", 0.1), Stiffness("threads", 0.3)]
    model = _bar(loads, [], form=form, winding=HELIX, compression=0.5, bending=form == "discrete")
    system = System(model)
    rng = np.random.default_rng(3)
    unknowns = rng.normal(0, 0.02, system.size)
    free = np.flatnonzero(~system.prescribed)
    exact = difference(system, unknowns, h=1e-6)[np.ix_(free, free)]
    tangent = system.tangent(unknowns, 1.0).toarray()[np.ix_(free, free)]
    error = float(np.abs(tangent - exact).max() / np.abs(exact).max())
    record_verification(
        claim=f"tangent against differences of the residual, {form} threads with states: worst entry over the largest",
        source="V24",
        expected=0.0,
        got=error,
        tolerance="1e-6",
    )
    assert error < 1e-6
    plain = System(tg.Model(model.mesh, model.materials, model.supports, [], reinforcements=model.reinforcements))
    assert np.abs(system.residual(unknowns, 1.0) - plain.residual(unknowns, 1.0)).max() > 1e-3
    assert system.residual(unknowns, 0.0) == pytest.approx(plain.residual(unknowns, 0.0), abs=1e-14)


def test_energy_has_the_forces_of_threads_with_states_as_its_slope():
    model = _bar([Shrinkage("threads", 0.1)], [], form="discrete", winding=HELIX, bending=True)
    system = System(model)
    rng = np.random.default_rng(4)
    unknowns, way = np.zeros(system.size), np.zeros(system.size)
    nodes = 3 * system.node_count
    unknowns[:nodes], way[:nodes] = rng.normal(0, 0.02, nodes), rng.normal(0, 1, nodes)
    here, h = system.points + system.split(unknowns)[0], 1e-6
    step = h * system.split(way)[0]
    slope = (system.terms.energy(here + step, 1.0) - system.terms.energy(here - step, 1.0)) / (2 * h)
    forces = system.terms.forces(Configuration(here, 1.0))[0]
    assert slope == pytest.approx(float((forces * step).sum() / h), rel=1e-6)


def test_bending_of_threads_takes_their_length_and_stiffness():
    model = _bar(
        [Shrinkage("threads", 0.1), Stiffness("threads", 0.3)], [], form="discrete", winding=HELIX, bending=True
    )
    system = System(model)
    (bent,) = (term for term in system.terms.all if isinstance(term, BendingTerm))
    moved = system.points + np.random.default_rng(5).normal(0, 0.02, system.points.shape)
    assert bent.energy(moved) > 0
    assert bent.at(1.0).energy(moved) == pytest.approx(0.3 / 0.9 * bent.energy(moved), rel=1e-12)
    assert bent.at(0.0).energy(moved) == pytest.approx(bent.energy(moved), rel=1e-12)


def test_what_threads_cannot_have_is_refused():
    with refused("hardening", "'threads'", "winding", "harden"):
        _bar([Hardening("threads", 1.0)])
    with refused("shrinkage", "'thread'", "'threads'"):
        _bar([Shrinkage("thread", 0.01)])
    with refused("pre-stretch", "'threads'", "winding", "direction"):
        _bar([PreStretch("threads", 1.1, (0, 0, 1))])
    with refused("pre-stretch", "'body'", "form 'thread'"):
        _bar([PreStretch("body", 1.1, form="thread")])
    with refused("shrinkage", "'body'", "a body and a winding"):
        _bar([Shrinkage("body", 0.01)], name="body")
    with refused("temperature", "'threads'", "'thread'", "thermal expansion"):
        _bar([Temperature("threads", 333.15)])


def test_other_programs_and_reduced_models_refuse_states_of_threads(tmp_path):
    model = _bar([Shrinkage("threads", 0.01)])
    with refused("winding", "Shrinkage(threads)", ".inp"):
        tg.files.write_inp(model, tmp_path / "bar.inp", program="abaqus")
    with refused("reduced", "Shrinkage(threads)"):
        inputs_of(model, {"loads.shrinkage.linear": (0.0, 0.01)})
