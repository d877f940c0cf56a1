"""States of sheets before loading: shrinkage, pre-stretch, swelling and temperature of membranes and shells.

Problems: a film alone that is free, or fixed at its ends; a woven one; a shell on a block of rubber that shrinks.
Exact: the free film is the stress-free state, and the fixed one has the force E h w ½ (1 − g²) for a stress-free
stretch g (Hooke's law of Green's strain). A strip of rubber of the height H under a film of the stiffness A per width
that shrinks by ε bends by κ = ε A (H/2) / (D (1 + A/(E₀H) + A H²/(4 D))), D = E₀H³/12 and E₀ = 4 μ in plane strain
(composite beam, Timoshenko 1925 with a film of no thickness). Tolerances: Newton's method for homogeneous states; 2 %
for the beam, of its finite strains.
"""

import numpy as np
import pytest
from turgor.loads import Hardening, PreStretch, Shrinkage, Stiffness, Swelling, Temperature

import meshes
import problems
import turgor as tg
from refused import refused
from turgor.core.engine.faces.membrane_term import largest_tension
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.units import GPa, MPa, mm

E, NU, THICKNESS, WIDTH = 1 * GPa, 0.3, 0.1 * mm, 50 * mm
SIDES = (tg.Fixed("film", "z"), tg.Fixed("left", "x"), tg.Fixed("near", "y"))


def _film(loads, more=(), law=None, **sheet):
    corners = ((0, 0, 0), (0, WIDTH, 0), (2 * WIDTH, WIDTH, 0), (2 * WIDTH, 0, 0))
    patch = tg.bodies.Patch(corners=corners, faces=("film",), edges=("left", "far", "right", "near"))
    mesh = tg.mesh(tg.bodies.Film(patches=(patch,)), size=WIDTH)
    film = tg.Material(name="film", law=law or tg.laws.Hooke(E=E, nu=NU))
    return tg.Model(mesh, {"film": tg.Membrane(film, THICKNESS, **sheet)}, [*SIDES, *more], loads)


CASES = [
    (Shrinkage("film", 0.02), (0.98, 0.98)),
    (Swelling("film", 1.061208), (1.02, 1.02)),
    (Temperature("film", 353.15, expansion=3e-4), (1.018, 1.018)),
    (PreStretch("film", 1.02), (1 / 1.02, 1.02**0.5)),
    (PreStretch("film", 1.02, (0, 0, 1), "across"), (1 / 1.02, 1 / 1.02)),
]


@pytest.mark.parametrize(("load", "stretches"), CASES, ids=lambda value: type(value).__name__)
def test_free_film_takes_its_rest_and_a_fixed_one_pulls(load, stretches, record_verification):
    free = problems.solve(_film([load])).states[-1]
    size = np.ptp(problems.current(free), axis=0)[:2] / (2 * WIDTH, WIDTH)
    assert size == pytest.approx(stretches, rel=1e-8)
    assert np.abs(largest_tension(free.model, "film", free.displacement, 1.0)[1]).max() < 1e-6 * E
    assert np.abs(largest_tension(free.model, "film", free.displacement, 0.5)[1]).max() > 1e-3 * E
    state = problems.solve(_film([load], [tg.Fixed("right", "x")])).states[-1]
    pull = float(state.nodal_force[state.model.mesh.face_nodes("right"), 0].sum())
    expected = E * THICKNESS * WIDTH * 0.5 * (1 - stretches[0] ** 2)
    record_verification(
        claim=f"film with fixed ends, {load.kind}: force [N]",
        source="Hooke's law",
        expected=expected,
        got=pull,
        tolerance="1e-6",
    )
    assert pull == pytest.approx(expected, rel=1e-6)


def test_state_grows_with_its_history_and_fades():
    load = Shrinkage("film", 0.02, history=((0, 0), (0.5, 1), (1, 0.25)))
    states = problems.solve(_film([load]), tg.Static(at=(0.5,))).states
    lengths = {round(s.load_factor, 6): np.ptp(problems.current(s)[:, 0]) / (2 * WIDTH) for s in states}
    assert lengths[0.5] == pytest.approx(0.98, rel=1e-8)
    assert lengths[1.0] == pytest.approx(0.98**0.25, rel=1e-8)


def test_woven_film_is_pulled_by_the_modulus_of_its_warp():
    law = tg.laws.Woven(E=E, E_weft=0.2 * E, nu=0.2, G=0.05 * E)
    state = problems.solve(_film([Shrinkage("film", 0.01)], [tg.Fixed("right", "x")], law, warp=(1, 0, 0))).states[-1]
    pull = float(state.nodal_force[state.model.mesh.face_nodes("right"), 0].sum())
    assert pull == pytest.approx(E * THICKNESS * WIDTH * 0.5 * (1 - 0.99**2), rel=1e-6)


@pytest.mark.parametrize("kind", [tg.Shell, tg.Membrane])
def test_film_that_shrinks_bends_a_strip(kind, record_verification):
    length, height, eps, mu = 40 * mm, 1 * mm, 0.004, 1 * MPa
    mesh = meshes.box((length, 2 * mm, height), (20, 1, 1), kind=HEXAHEDRON)
    sheet = kind(tg.Material(name="film", law=tg.laws.Hooke(E=30 * MPa, nu=0.0)), 0.02 * mm)
    corner = tg.supports.NodesAt("corner", edge=("x0", "z0"))
    supports = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("y1", "y"), tg.Fixed(corner, "z")]
    rubber = problems.rubber(tg.laws.NeoHooke(C10=mu / 2))
    state = problems.solve(tg.Model(mesh, {"body": rubber, "z1": sheet}, supports, [Shrinkage("z1", eps)])).states[-1]
    moved = problems.current(state)[mesh.face_nodes("x1")]
    angle = np.arctan2(np.ptp(moved[:, 0]), np.ptp(moved[:, 2]))
    plane, stiffness = 4 * mu, 30 * MPa * 0.02 * mm
    bending = plane * height**3 / 12
    shared = 1 + stiffness / (plane * height) + stiffness * height**2 / (4 * bending)
    curvature = eps * stiffness * height / (2 * bending * shared)
    record_verification(
        claim=f"strip of rubber under a film that shrinks, {kind.__name__}: angle of its end [rad]",
        source="composite beam",
        expected=curvature * length,
        got=float(angle),
        tolerance="2 %",
    )
    assert angle == pytest.approx(curvature * length, rel=0.02)


def test_what_sheets_cannot_have_is_refused():
    with refused("shrinkage", "'film'", "wrinkles", "compression = 0"):
        _film([Shrinkage("film", 0.01)], compression=0.0)
    with refused("stiffness", "'film'", "sheet"):
        _film([Stiffness("film", 0.5)])
    with refused("hardening", "'film'", "sheet"):
        _film([Hardening("film", 1.0)])
    with refused("pre stretch", "1.3", "small strains", "1.11"):
        _film([PreStretch("film", 1.3)])
    with refused("shrinkage", "'left' is a face without a sheet", "film"):
        _film([Shrinkage("left", 0.01)])


def test_inp_files_refuse_states_of_sheets(tmp_path):
    mesh = meshes.box((10 * mm, 10 * mm, 2 * mm), (1, 1, 1), kind=HEXAHEDRON)
    sheet = tg.Membrane(tg.Material(name="film", law=tg.laws.Hooke(E=30 * MPa, nu=0.0)), 0.02 * mm)
    rubber = problems.rubber(problems.NEO_HOOKE, 1 * GPa)
    model = tg.Model(mesh, {"body": rubber, "z1": sheet}, ["x0"], [Shrinkage("z1", 0.01)])
    with refused("Shrinkage", "state of a sheet", ".inp"):
        tg.files.write_inp(model, tmp_path / "strip.inp")
