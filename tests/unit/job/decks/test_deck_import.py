"""Decks as jobs: what each keyword becomes, and what is refused by name and line."""

import numpy as np
import pytest

import turgor as tg
from deck_cases import CELLS, FIXED, NODES, PULL, deck, step
from refused import refused
from turgor.core.materials.laws.laws import (
    ArrudaBoyce,
    GeneralizedRivlin,
    Hyperfoam,
    MooneyRivlin,
    NeoHooke,
    Ogden,
    Yeoh,
    YeohN,
)
from turgor.core.model.history import share_at
from turgor.job.meshes import mesh_of

MPA = 1e6


def job_of(file, folder, **more):
    return tg.jobs.read_job(tg.files.import_deck(file, **more).write(folder, force=True))


@pytest.mark.parametrize(
    ("lines", "law", "bulk"),
    [
        ("*HYPERELASTIC, NEO HOOKE\n0.1, 0.4\n", NeoHooke(C10=0.1 * MPA), 5 * MPA),
        ("*HYPERELASTIC, MOONEY-RIVLIN\n0.1, 0.02, 0.4\n", MooneyRivlin(C10=0.1 * MPA, C01=0.02 * MPA), 5 * MPA),
        ("*HYPERELASTIC, YEOH\n0.1,0.01,0.001,0.4,0.,0.\n", Yeoh(C10=1e5, C20=1e4, C30=1e3), 5 * MPA),
        (
            "*HYPERELASTIC, REDUCED POLYNOMIAL, N=2\n0.1,0.01,0.4,0.\n",
            YeohN(coefficients=(0.1 * MPA, 0.01 * MPA)),
            5 * MPA,
        ),
        (
            "*HYPERELASTIC, POLYNOMIAL, N=2\n0.1,0.02,0.,0.003,0.,0.4,0.\n",
            GeneralizedRivlin(coefficients=((1, 0, 0.1 * MPA), (0, 1, 0.02 * MPA), (1, 1, 0.003 * MPA))),
            5 * MPA,
        ),
        (
            "*HYPERELASTIC, OGDEN, N=2\n0.1,2.,0.02,-3.,0.4,0.\n",
            Ogden.from_abaqus(mu=(0.1 * MPA, 0.02 * MPA), alpha=(2.0, -3.0)),
            5 * MPA,
        ),
        ("*HYPERELASTIC, ARRUDA-BOYCE\n0.1, 3., 0.\n", ArrudaBoyce(mu=0.1 * MPA, locking_stretch=3.0), np.inf),
        ("*HYPERFOAM, N=1\n0.1, 4., 0.2\n", Hyperfoam.from_abaqus(mu=(0.1 * MPA,), alpha=(4.0,), nu=(0.2,)), None),
        (
            "*HYPERFOAM, N=2\n0.1, 4., 0.02, -2., 0.2, 0.1\n",
            Hyperfoam.from_abaqus(mu=(0.1 * MPA, 0.02 * MPA), alpha=(4.0, -2.0), nu=(0.2, 0.1)),
            None,
        ),
        ("*ELASTIC\n0.3, 0.25\n", NeoHooke(C10=0.06 * MPA), 0.2 * MPA),
    ],
)
def test_laws_and_their_resistance_to_volume(tmp_path, lines, law, bulk):
    material = job_of(deck(tmp_path, material=lines), tmp_path).materials["BLOCK"]
    assert type(material.law) is type(law)
    for name in law.__dataclass_fields__:
        np.testing.assert_allclose(getattr(material.law, name), getattr(law, name), rtol=1e-12)
    if bulk is not None:
        assert material.bulk_modulus == pytest.approx(bulk)


def test_density_relaxation_and_softening(tmp_path):
    relaxing = "*HYPERELASTIC, NEO HOOKE, MODULI=INSTANTANEOUS\n0.1, 0.\n*VISCOELASTIC, TIME=PRONY\n0.2, 0., 3.\n"
    material = job_of(deck(tmp_path, material=relaxing + "*DENSITY\n1.1e-9\n"), tmp_path).materials["BLOCK"]
    assert material.density == pytest.approx(1100)
    assert (material.viscoelasticity.g, material.viscoelasticity.tau) == ((0.2,), (3.0,))
    assert material.viscoelasticity.moduli == "instantaneous"
    soft = "*HYPERELASTIC, NEO HOOKE\n0.1, 0.\n*MULLINS EFFECT\n2., 0.01, 0.1\n"
    mullins = job_of(deck(tmp_path, material=soft), tmp_path).materials["BLOCK"].stress_softening
    assert (mullins.r, mullins.m, mullins.beta) == (2.0, pytest.approx(10e3), 0.1)


def test_loads_follow_steps_and_amplitudes(tmp_path):
    late = "*AMPLITUDE, NAME=LATE\n0., 0., 1., 0., 3., 1.\n"
    moved = step(FIXED.replace("BOTTOM, 1, 3", "TOP, 3, 3, 2."))
    pressed = step("*DSLOAD, AMPLITUDE=LATE\nLID, P, 0.04\n", period=3.0)
    job = job_of(deck(tmp_path, model=FIXED + late, steps=moved + pressed), tmp_path)
    (lid,) = job.loads
    assert lid.pressure == pytest.approx(40e3)
    assert [share_at(lid.history, s) for s in (0.25, 0.5, 0.75, 1.0)] == pytest.approx([0, 0, 0.5, 1])
    top = next(each for each in job.supports if each.place == "TOP")
    assert top.shift == (0, 0, pytest.approx(2e-3))
    assert [share_at(top.way, s) for s in (0.125, 0.25, 1.0)] == pytest.approx([0.5, 1, 1])
    assert job.procedure.at == (0.25,)


def test_a_new_set_of_loads_ends_the_former_ones(tmp_path):
    steps = step(PULL) + step("*DSLOAD, OP=NEW\n")
    (lid,) = job_of(deck(tmp_path, steps=steps), tmp_path).loads
    assert [share_at(lid.history, s) for s in (0.5, 0.75, 1.0)] == pytest.approx([1, 0.5, 0])


def test_forces_of_a_uniform_traction_act_on_the_face_and_others_on_their_nodes(tmp_path):
    (force,) = job_of(deck(tmp_path, steps=step("*CLOAD\nTOP, 3, 0.25\n")), tmp_path).loads
    assert force.face == "pulled"
    assert force.vector == pytest.approx((0, 0, 1))
    uneven = job_of(deck(tmp_path, steps=step("*CLOAD\nTOP, 3, 0.25\n9, 3, 0.25\n")), tmp_path).loads
    assert {each.place: each.vector[2] for each in uneven} == pytest.approx(
        {"node_9": 0.5, "node_10": 0.25, "node_11": 0.25, "node_12": 0.25}
    )


def test_directions_of_a_transform(tmp_path):
    turned = "*TRANSFORM, NSET=TOP, TYPE=R\n1., 1., 0., -1., 1., 0.\n*BOUNDARY\nTOP, 1\n"
    job = job_of(deck(tmp_path, model=FIXED + turned), tmp_path)
    (roller,) = (each for each in job.supports if type(each).__name__ == "Roller")
    np.testing.assert_allclose(roller.along, np.array([1, 1, 0]) / np.sqrt(2), atol=1e-8)


def test_forces_along_directions_of_a_cylinder(tmp_path):
    around = "*TRANSFORM, NSET=TOP, TYPE=C\n0., 0., 0., 0., 0., 1.\n"
    pushes = step("*CLOAD\n10, 2, 1.\n11, 1, 2.\n9, 3, 3.\n")
    loads = job_of(deck(tmp_path, model=FIXED + around, steps=pushes), tmp_path).loads
    by_node = {each.place: each.vector for each in loads}
    assert by_node["node_10"] == pytest.approx((0, 1, 0))  # at x = 10 mm, y = 0
    assert by_node["node_11"] == pytest.approx((np.sqrt(2), np.sqrt(2), 0))
    assert by_node["node_9"] == pytest.approx((0, 0, 3))  # on the axis


def test_the_third_direction_of_a_rectangular_transform_is_right_handed(tmp_path):
    turned = "*TRANSFORM, NSET=TOP\n0., 1., 0., -1., 0., 0.\n"
    pushes = step("*CLOAD\n10, 2, 1.\n11, 3, 2.\n")
    loads = job_of(deck(tmp_path, model=FIXED + turned, steps=pushes), tmp_path).loads
    by_node = {each.place: each.vector for each in loads}
    assert by_node["node_10"] == pytest.approx((-1, 0, 0))
    assert by_node["node_11"] == pytest.approx((0, 0, 2))


def test_an_open_surface_is_no_cavity_whatever_its_name(tmp_path):
    mesh = (NODES + CELLS).replace("NAME=LID", "NAME=cavity")
    (load,) = job_of(deck(tmp_path, mesh=mesh, steps=step("*DSLOAD\ncavity, P, 0.01\n")), tmp_path).loads
    assert load.face == "pressed"


def test_supports_of_nodes_that_are_no_face_or_all(tmp_path):
    model = FIXED + "*BOUNDARY\nALL, 2\n9, PINNED\n"
    supports = job_of(deck(tmp_path, model=model, steps=step("*CLOAD\n12, 3, 1.\n")), tmp_path).supports
    places = {each.directions: each.face for each in supports}
    assert places["y"].box is not None
    assert places["xz"].node_set  # the bottom and one corner of the top
    restated = step(PULL) + step("*BOUNDARY, OP=NEW\nBOTTOM, 1, 3\n")
    assert not tg.files.import_deck(deck(tmp_path, steps=restated)).missing


def test_mirror_planes_of_exported_halves_stay_mirror_planes(tmp_path):
    mesh = (NODES + CELLS).replace("NSET=Y0", "NSET=symmetry_y")
    model = FIXED + "*BOUNDARY\nsymmetry_y, 2\n"
    job = job_of(deck(tmp_path, mesh=mesh, model=model, steps=step("*CLOAD\nTOP, 3, 0.25\n")), tmp_path)
    assert "symmetry_y" in job.geometry().faces
    assert [each.place for each in job.supports] == ["BOTTOM"]
    assert job.loads[0].vector == pytest.approx((0, 0, 2))  # that of the whole block


def test_contact_and_ties(tmp_path):
    other = NODES.replace("*NODE, NSET=ALL\n", "*NODE\n").splitlines()[1:9]
    shifted = [
        f"{i + 20}, {x}, {y}, {float(z) + GAP}" for i, (_, x, y, z) in enumerate(row.split(",") for row in other)
    ]
    second = "*NODE\n" + "\n".join(shifted) + "\n*ELEMENT, TYPE=C3D8, ELSET=BLOCK\n3, 20,21,22,23,24,25,26,27\n"
    surface = "*SURFACE, NAME=FOOT, TYPE=ELEMENT\n3, S1\n"
    pair = (
        "*SURFACE INTERACTION, NAME=RUB\n*FRICTION\n0.3\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n5.\n"
        "*CONTACT PAIR, INTERACTION=RUB\nFOOT, LID\n"
    )
    fixed = FIXED + "*BOUNDARY\n24, 1, 3\n25, 1, 3\n26, 1, 3\n27, 1, 3\n"
    mesh = NODES + CELLS + second + surface
    job = job_of(deck(tmp_path, mesh=mesh, model=pair + fixed), tmp_path)
    assert job.contact.self_contact.friction == 0.3
    assert job.contact.self_contact.stiffness == pytest.approx(5e9)  # MPa/mm
    assert type(job.procedure).__name__ == "Static"
    loose = pair + FIXED + "*BOUNDARY\n24, 1, 2\n25, 1\n"
    assert type(job_of(deck(tmp_path, mesh=mesh, model=loose), tmp_path).procedure).__name__ == "Stabilized"
    adjusted = pair.replace("=RUB\nFOOT", "=RUB, ADJUST=0.1\nFOOT")
    with refused("*CONTACT PAIR", "ADJUST=0.1"):
        tg.files.import_deck(deck(tmp_path, mesh=mesh, model=adjusted + fixed))
    touching = mesh.replace(f"{GAP + 0.0}", "20.0")
    closed = touching.replace(f"{GAP + 10.0}", "30.0")
    apart = job_of(deck(tmp_path, mesh=closed, model=pair + fixed), tmp_path)
    assert len(mesh_of(apart, apart.geometry()).points) == 45 + 27  # nodes of both bodies where they touch
    tied = tg.files.import_deck(deck(tmp_path, mesh=closed, model="*TIE, NAME=GLUE\nFOOT, LID\n" + fixed))
    assert any(row.keyword.startswith("TIE") and row.verdict == "taken" for row in tied.rows)


#: Height of the second body in the test of contact.
GAP = 20.5


def test_sheets_on_sides(tmp_path):
    film = "*ELEMENT, TYPE=S4, ELSET=FILM\n7, 9,10,11,12\n"
    section = "*MATERIAL, NAME=PAPER\n*ELASTIC\n2000., 0.2\n*SHELL SECTION, ELSET=FILM, MATERIAL=PAPER\n0.1\n"
    sheet = job_of(deck(tmp_path, mesh=NODES + CELLS + film, model=section + FIXED), tmp_path).materials["FILM"]
    assert (type(sheet).__name__, sheet.thickness, sheet.material.law.E) == ("Shell", pytest.approx(1e-4), 2e9)


@pytest.mark.parametrize(
    ("changes", "keyword"),
    [
        ({"model": FIXED + "*RIGID BODY, NSET=TOP\n"}, "*RIGID BODY"),
        ({"model": FIXED + "*MPC\nPLANE, TOP\n"}, "*MPC"),
        ({"material": "*HYPERELASTIC, VAN DER WAALS\n0.1,3.,0.,0.,0.\n"}, "*HYPERELASTIC, VAN DER WAALS"),
        ({"material": "*HYPERELASTIC, YEOH\n0.1,0.,0.,0.4,0.1,0.\n"}, "D2"),
        ({"material": "*ELASTIC\n1.,0.3\n*PLASTIC\n0.1,0.\n"}, "*PLASTIC"),
        ({"steps": step("*DLOAD\nBLOCK, CORIO, 1.,0.,0.,0.,0.,0.,1.\n")}, "CORIO"),
        ({"steps": "*STEP\n*FREQUENCY\n5\n*END STEP\n"}, "*STEP"),
        ({"steps": step(PULL) + step("*BOUNDARY, OP=NEW\n9, 1, 3\n")}, "OP=NEW"),
        ({"steps": step("*DSLOAD, AMPLITUDE=NONE\nLID, P, 1.\n")}, "'NONE'"),
        ({"steps": step("*DSLOAD\nLYD, P, 1.\n")}, "'LID'"),
        ({"model": FIXED + "*BOUNDARY\nTOPP, 1\n"}, "'TOP'"),
    ],
)
def test_what_a_job_cannot_express_is_refused_by_name_and_line(tmp_path, changes, keyword):
    file = deck(tmp_path, **changes)
    line = next(row for row in tg.files.import_deck(file, partial=True).missing).line
    with refused(f"block.inp:{line}", keyword):
        tg.files.import_deck(file)
    assert file.read_text().splitlines()[line - 1].startswith("*")


def test_a_partial_job_says_what_it_lacks(tmp_path):
    read = tg.files.import_deck(deck(tmp_path, model=FIXED + "*RIGID BODY, NSET=TOP\n"), partial=True)
    assert "# It is another model than the deck" in read.job
    assert "*RIGID BODY, NSET=TOP is missing" in read.job


def test_every_keyword_has_a_row(tmp_path):
    file = deck(tmp_path)
    read = tg.files.import_deck(file)
    lines = [n for n, text in enumerate(file.read_text().splitlines(), 1) if text.startswith("*")]
    ends = [n for n, text in enumerate(file.read_text().splitlines(), 1) if text.startswith("*END")]
    assert sorted({row.line for row in read.rows}) == [n for n in lines if n not in ends]


def test_units_fit_each_other(tmp_path):
    job = job_of(deck(tmp_path), tmp_path, units="cm, N, N/cm2")
    assert pytest.approx(0.1e4) == job.materials["BLOCK"].law.C10
    assert np.ptp(job.actuator.read().points[:, 2]) == pytest.approx(0.2)
    for wrong, why in (("mm, N, kPa", "1e+06 Pa"), ("mm, N", "mm, N, MPa"), ("mm, Nn, MPa", "'Nn'")):
        with refused(why):
            tg.files.import_deck(deck(tmp_path), units=wrong)


def test_files_are_not_replaced(tmp_path):
    read = tg.files.import_deck(deck(tmp_path))
    read.write(tmp_path)
    with refused("block.toml"):
        read.write(tmp_path)


@pytest.mark.parametrize(
    ("model", "loads", "facts"),
    [
        ("*DSLOAD\nLID, P, 0.1\n", PULL, ("*DSLOAD", "this place")),
        ("", PULL + "*CONTACT PAIR, INTERACTION=A\nLID, LID\n", ("*CONTACT PAIR", "this place")),
        ("*NSET, NSET=NONE\n", PULL + "*BOUNDARY\nNONE, 1\n", ("*BOUNDARY", "'NONE'", "no nodes")),
        ("*SURFACE, NAME=BARE\n7, S1\n", "*DSLOAD\nBARE, P, 1.\n", ("*DSLOAD", "'BARE'", "no sides")),
    ],
)
def test_nothing_is_dropped_without_a_word(tmp_path, model, loads, facts):
    with refused(*facts):
        tg.files.import_deck(deck(tmp_path, model=FIXED + model, steps=step(loads)))


def test_names_of_an_instance(tmp_path):
    file = deck(
        tmp_path, model=FIXED.replace("BOTTOM", "Part-1-1.BOTTOM"), steps=step(PULL.replace("LID", 'P-1."LID"'))
    )
    assert [load.face for load in job_of(file, tmp_path).loads] == ["LID"]
