"""States of bodies before loading: shrinkage, pre-stretch, temperature, and stiffness that comes and goes.

Problems: a bonded strip of two layers of which one shrinks (Timoshenko 1925, Analysis of bi-metal thermostats, eq. 4,
with equal layers κ = 3 ε / (2 h)); a bar that was stretched and is fixed, freed, or frozen in a longer shape and
released; a ring that was stretched around its axis and contracts; a tube that is inflated warm.
Exact: uniaxial neo-Hooke; the ring by quadrature of its radial equilibrium; the others from the same model at rest.
Tolerances: Newton's method for homogeneous states; 1 % for Timoshenko, whose strip is thin and bends little.
"""

import dataclasses

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from turgor.loads import Hardening, PreStretch, Shrinkage, Stiffness, Swelling, Temperature

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON

C10 = problems.NEO_HOOKE.C10
RUBBER = problems.rubber(problems.NEO_HOOKE)
PLANES = (tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("z0", "z"))


def _bar(loads, supports=PLANES, material=RUBBER):
    return tg.Model(meshes.box((0.01, 0.01, 0.01), (2, 1, 1), kind=HEXAHEDRON), {"body": material}, supports, loads)


def _length(state):
    nodes = state.model.mesh.face_nodes("x1")
    return 1 + state.displacement[nodes, 0].mean() / 0.01


def _force(load, stretch):
    """Nominal stress of neo-Hooke in tension."""
    return 2 * C10 * load * (stretch - stretch**-2)


@pytest.mark.parametrize(
    ("load", "stretches"),
    [
        (Shrinkage("body", 0.1), (0.9, 0.9, 0.9)),
        (Swelling("body", 1.331), (1.1, 1.1, 1.1)),
        (Temperature("body", 393.15, expansion=3e-4), (1.03, 1.03, 1.03)),
        (PreStretch("body", 1.44), (1 / 1.44, 1.2, 1.2)),
        (PreStretch("body", 1.2, (0, 0, 2), "across"), (1 / 1.2, 1 / 1.2, 1.44)),
    ],
    ids=lambda value: type(value).__name__,
)
def test_free_body_takes_its_rest_without_stress(load, stretches, record_verification):
    state = problems.solve(_bar([load])).states[-1]
    place = problems.current(state)
    got = np.ptp(place, axis=0) / 0.01
    stress = float(np.abs(problems.fields(state).von_mises).max()) / C10
    record_verification(
        claim=f"length of a free body, {load.kind}", source="definition", expected=stretches[0], got=float(got[0]),
        tolerance="1e-9",
    )  # fmt: skip
    assert got == pytest.approx(stretches, rel=1e-9)
    assert stress < 1e-8 and problems.energy(state) < 1e-12


def test_bar_that_was_stretched_pulls_at_its_clamps(record_verification):
    model = _bar([PreStretch("body", 1.3)], (*PLANES, tg.Fixed("x1", "x")))
    solution = problems.solve(model)
    state = solution.states[-1]
    exact = 2 * C10 * (1.3**2 - 1 / 1.3) * 1e-4  # true stress on the area of the mesh
    got = problems.reaction(state, "x1")[0]
    record_verification(
        claim="force of a fixed bar that was stretched by 1.3", source="uniaxial neo-Hooke", expected=exact, got=got,
        tolerance="1e-8",
    )  # fmt: skip
    assert got == pytest.approx(exact, rel=1e-8)
    assert problems.energy(state) == pytest.approx(C10 * (1.3**2 + 2 / 1.3 - 3) * 1e-6, rel=1e-8)
    assert float(problems.fields(state).stretch.max()) == pytest.approx(1.3, rel=1e-9)


def _strip(load, low=RUBBER):
    length, height = 40e-3, 2e-3
    mesh = meshes.box((length, 2e-3, height), (10, 1, 2), kind=HEXAHEDRON)
    upper = mesh.points[mesh.cells].mean(axis=1)[:, 2] > height / 2
    mesh = dataclasses.replace(mesh, regions={"low": np.flatnonzero(~upper), "high": np.flatnonzero(upper)})
    mesh = meshes.with_faces(mesh, pin=meshes.single_node(meshes.node_at(mesh, (0, 0, 0)), 9))
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("pin", "z")]
    return tg.Model(mesh, {"low": low, "high": RUBBER}, supports, [load])


def _curvature(state):
    mesh = state.model.mesh
    end = mesh.face_nodes("x1")
    return -np.polyfit(mesh.points[end, 2], state.displacement[end, 0], 1)[0] / 40e-3


def test_two_layers_bend_as_timoshenko_says(record_verification):
    state = problems.solve(_strip(Shrinkage("high", 0.002))).states[-1]
    exact = 1.5 * 0.002 / 2e-3
    record_verification(
        claim="curvature of two layers, one of which shrinks by 0.2 % [1/m]", source="Timoshenko (1925)",
        expected=exact, got=_curvature(state), tolerance="1 %",
    )  # fmt: skip
    assert _curvature(state) == pytest.approx(exact, rel=0.01)


def test_heat_bends_two_layers_of_unequal_stiffness(record_verification):
    """Timoshenko (1925), eq. 4, equal thickness, n = 4 times the stiffness below: κ = 24 ε / (h (14 + n + 1/n))."""
    stiff = problems.rubber(tg.laws.NeoHooke(C10=4 * C10))
    state = problems.solve(_strip(Temperature("high", "30 °C", expansion=2e-4), stiff)).states[-1]
    exact = -24 * 0.002 / (2e-3 * (14 + 4 + 1 / 4))
    record_verification(
        claim="curvature of two layers, the softer of which is 10 K warmer [1/m]", source="Timoshenko (1925)",
        expected=exact, got=_curvature(state), tolerance="1 %",
    )  # fmt: skip
    assert _curvature(state) == pytest.approx(exact, rel=0.01)


def test_heat_bends_two_layers_like_the_same_growth():
    warm = problems.solve(_strip(Temperature("high", "60 °C", rest="20 °C", expansion=3e-4))).states[-1]
    grown = problems.solve(_strip(Shrinkage("high", -0.012))).states[-1]
    assert warm.displacement == pytest.approx(grown.displacement, abs=1e-11)
    assert _curvature(warm) < 0


def _ring(counts):
    """Inner radius of a ring that was stretched around its axis, computed and exact [m]."""
    inner, outer, stretch = 10e-3, 15e-3, 1.3
    mesh = meshes.tube_sector(inner, outer, 2e-3, counts, kind=HEXAHEDRON)
    model = tg.Model(
        mesh, {"body": RUBBER}, [tg.Fixed("z0", "z"), tg.Fixed("z1", "z")],
        [PreStretch("body", stretch, (0, 0, 1), "around")],
    )  # fmt: skip
    state = problems.solve(model).states[-1]
    nodes = mesh.face_nodes("cavity")
    got = float(np.hypot(*problems.current(state)[nodes, :2].T).mean())

    def pressure(new):  # what remains on the outside, of the plane strain map r² = R² + c
        c = new**2 - inner**2

        def difference(R):
            r = np.sqrt(R**2 + c)
            hoop, radial = stretch * r / R, R / r / np.sqrt(stretch)
            return 2 * C10 * (hoop**2 - radial**2) / r * (R / r)

        return quad(difference, inner, outer)[0]

    return got, brentq(pressure, 0.5 * inner, inner)


def test_ring_contracts_as_its_radial_equilibrium_says(record_verification):
    (coarse, exact), (got, _) = _ring((1, 2, 1)), _ring((2, 4, 1))
    rate = float(np.log2(abs(coarse / exact - 1) / abs(got / exact - 1)))
    record_verification(
        claim="rate at which this radius converges", source="theory", expected=4.0, got=rate, tolerance="at least 3"
    )
    assert rate > 3
    record_verification(
        claim="inner radius of a ring that was stretched around its axis [mm]", source="quadrature",
        expected=exact * 1e3, got=got * 1e3, tolerance="1e-4",
    )  # fmt: skip
    assert got == pytest.approx(exact, rel=1e-4)


def test_warm_rubber_network_is_stiffer_in_proportion_to_kelvin():
    pull = tg.Traction("x1", (0.3 * C10, 0, 0))
    cold = problems.solve(_bar([pull])).states[-1]
    more = tg.Traction("x1", (0.3 * C10 * 353.15 / 293.15, 0, 0))
    warm = problems.solve(_bar([more, Temperature("body", "80 °C", modulus="rubber")])).states[-1]
    assert _length(warm) == pytest.approx(_length(cold), rel=1e-9)
    table = Temperature("body", "80 °C", modulus=[("20 °C", 1.0), ("80 °C", 353.15 / 293.15)])
    assert _length(problems.solve(_bar([more, table])).states[-1]) == pytest.approx(_length(cold), rel=1e-9)


def test_frozen_core_keeps_its_shape(record_verification):
    """A bar melts to a tenth, is pulled, freezes with its whole stiffness, and is released."""
    pull, none = tg.Traction("x1", (0.05 * C10, 0, 0)), tg.Traction("x1", (0.0, 0, 0))
    stages = tg.Stages(
        [
            tg.Stage("melt", loads=[Stiffness("body", 0.1)]),
            tg.Stage("pull", loads=[pull]),
            tg.Stage("freeze", loads=[Hardening("body", 1.0)]),
            tg.Stage("release", loads=[none]),
        ]
    )
    solution = problems.solve(_bar([]), stages)
    assert solution.complete
    ends = {state.stage: state for state in solution.states}
    pulled = brentq(lambda x: _force(0.1, x) - 0.05 * C10, 1, 3)
    assert _length(ends["pull"]) == pytest.approx(pulled, rel=1e-7)
    assert ends["freeze"].displacement == pytest.approx(ends["pull"].displacement, abs=1e-12)
    exact = brentq(lambda x: _force(0.1, x) + _force(1.0, x / pulled) / pulled, 1, pulled)
    record_verification(
        claim="stretch of a bar that froze at 1.1 and is released", source="two networks in tension", expected=exact,
        got=_length(ends["release"]), tolerance="1e-7",
    )  # fmt: skip
    assert _length(ends["release"]) == pytest.approx(exact, rel=1e-7)


def test_stiffness_counts_from_the_shape_of_the_mesh():
    pull = tg.Traction("x1", (0.3 * C10, 0, 0))
    stages = tg.Stages([tg.Stage("pull", loads=[pull]), tg.Stage("stiffer", loads=[Stiffness("body", 3.0)])])
    state = problems.solve(_bar([]), stages).states[-1]
    exact = brentq(lambda x: _force(3.0, x) - 0.3 * C10, 1, 3)
    assert _length(state) == pytest.approx(exact, rel=1e-7)


@pytest.mark.parametrize("procedure", [tg.ArcLength(), tg.Stabilized()], ids=lambda p: type(p).__name__)
def test_procedures_agree_on_shrinkage_with_pressure(procedure):
    loads = [Shrinkage("high", 0.02), tg.Pressure("z0", 50.0)]
    model = _strip(loads[0])
    model = tg.Model(model.mesh, dict(model.materials), model.supports, loads)
    state = problems.solve(model, procedure).states[-1]
    reference = problems.solve(model).states[-1]
    assert state.load_factor == 1.0
    assert _curvature(state) == pytest.approx(_curvature(reference), rel=1e-3)


def test_energy_of_a_state_is_in_the_balance_of_a_motion():
    """Walls that hold a bar which shrinks do no work, and the bar takes up energy all the same."""
    held = (*PLANES, tg.Fixed("x1", "x"))
    loads = [Shrinkage("body", 0.2), Stiffness("body", 2.0)]
    model = _bar(loads, held, problems.rubber(problems.NEO_HOOKE, density=1000.0))
    energies = problems.solve(model, tg.Dynamic(duration=0.05, accuracy=1e-3)).states[-1].energies
    assert energies.strain == pytest.approx(problems.energy(problems.solve(model).states[-1]), rel=1e-3)
    assert abs(energies.missing) < 1e-3 * energies.strain


def test_a_body_on_stiff_paper_melts_before_any_load():
    """Nothing moves, and what paper leaves is round-off, which there is no force to compare with."""
    mesh = meshes.box((0.04, 0.01, 0.01), (4, 1, 1), kind=HEXAHEDRON)
    paper = tg.Shell(tg.Material(name="paper", law=tg.laws.Hooke(E=1e10, nu=0.3)), 5e-4)
    model = tg.Model(mesh, {"body": RUBBER, "z0": paper}, ["x0"], [Stiffness("body", 1e-3)])
    solution = problems.solve(model, tg.Static(first_step=1.0))
    assert solution.complete and np.abs(solution.states[-1].displacement).max() < 1e-9
