"""Files of FEBio as jobs: what each element becomes, and what is refused by its name and line."""

import numpy as np
import pytest

import turgor as tg
from deck_cases import deck
from febio_cases import BRICKS, DOMAIN, FIXED, POINTS, PULL, SETS, SOFT, feb
from refused import refused
from turgor.core.materials.laws.laws import ArrudaBoyce, CompressibleNeoHooke, MooneyRivlin, NeoHooke, Ogden, YeohN
from turgor.core.model.history import share_at

MPA = 1e6


def job_of(file, folder, **more):
    return tg.jobs.read_job(tg.files.import_deck(file, **more).write(folder, force=True))


def of_type(kind, constants):
    return f'<material id="1" name="SOFT" type="{kind}"><density>1</density>{constants}</material>'


@pytest.mark.parametrize(
    ("material", "law", "bulk"),
    [
        (of_type("incomp neo-Hookean", "<G>0.2</G><k>5</k>"), NeoHooke(C10=0.1 * MPA), 5 * MPA),
        (of_type("Mooney-Rivlin", "<c1>.1</c1><c2>.02</c2><k>5</k>"), MooneyRivlin(C10=1e5, C01=2e4), 5 * MPA),
        (of_type("Yeoh", "<c1>.1</c1><c2>.01</c2><k>5</k>"), YeohN(coefficients=(1e5, 1e4)), 5 * MPA),
        (
            of_type("Ogden", "<c1>.2</c1><m1>2</m1><c2>0</c2><m2>1</m2><c3>.04</c3><m3>-3</m3><k>5</k>"),
            Ogden.from_abaqus(mu=(0.1 * MPA, 0.02 * MPA), alpha=(2.0, -3.0)),
            5 * MPA,
        ),
        (of_type("Arruda-Boyce", "<mu>.1</mu><N>9</N><k>5</k>"), ArrudaBoyce(mu=1e5, locking_stretch=3.0), 5 * MPA),
        (of_type("neo-Hookean", "<E>.25</E><v>.25</v>"), CompressibleNeoHooke(mu=0.1 * MPA, nu=0.25), None),
        (of_type("isotropic elastic", "<E>.3</E><v>.25</v>"), NeoHooke(C10=0.06 * MPA), 0.2 * MPA),
    ],
)
def test_laws_of_febio(tmp_path, material, law, bulk):
    got = job_of(feb(tmp_path, material=material), tmp_path).materials["BLOCK"]
    assert type(got.law) is type(law)
    for name in law.__dataclass_fields__:
        np.testing.assert_allclose(getattr(got.law, name), getattr(law, name), rtol=1e-12)
    if bulk is not None:
        assert got.bulk_modulus == pytest.approx(bulk)


def test_relaxation_counts_from_the_slow_law(tmp_path):
    series = '<g1>0.25</g1><t1>3</t1><elastic type="Mooney-Rivlin"><c1>0.1</c1><c2>0</c2><k>5</k></elastic>'
    job = job_of(feb(tmp_path, material=of_type("uncoupled viscoelastic", series)), tmp_path)
    prony = job.materials["BLOCK"].viscoelasticity
    assert (prony.g, prony.tau, prony.moduli) == ((pytest.approx(0.2),), (3.0,), "long_term")
    assert prony.modulus([0.0])[0] == pytest.approx(1.25)  # G(0) = 1 + g1
    assert job.procedure.duration == pytest.approx(1.0)


def test_the_same_model_as_a_deck_is_the_same_job(tmp_path):
    theirs = job_of(deck(tmp_path), tmp_path)
    ours = job_of(feb(tmp_path), tmp_path)
    assert ours.supports == theirs.supports
    assert ours.loads == theirs.loads
    assert ours.procedure == theirs.procedure
    assert ours.materials["BLOCK"].law == theirs.materials["BLOCK"].law
    np.testing.assert_array_equal(ours.actuator.read().points, theirs.actuator.read().points)


def test_loads_and_their_curves(tmp_path):
    loads = (
        '<surface_load surface="LID" type="traction"><scale lc="1">2</scale><traction>0,0.1,0</traction></surface_load>'
        '<nodal_load node_set="TOP" type="nodal_force"><value lc="1">1,0,0</value></nodal_load>'
        '<nodal_load node_set="BOTTOM" type="nodal_load"><dof>z</dof><scale>3</scale></nodal_load>'
        '<body_load type="const"><x>0</x><y>0</y><z>10</z></body_load>'
    )
    curve = "<interpolate>SMOOTH</interpolate><points><pt>0,0</pt><pt>0.5,1</pt><pt>1,0</pt></points>"
    job = job_of(feb(tmp_path, loads=loads, curve=curve), tmp_path)
    by_type = sorted(job.loads, key=lambda load: (type(load).__name__, load.history[0][1]))
    pulled, pushed, gravity, traction = by_type
    assert traction.vector == pytest.approx((0, 0.2 * MPA, 0))
    assert [share_at(traction.history, s) for s in (0.25, 0.5, 1.0)] == pytest.approx([0.75, 1, 0])  # a parabola
    assert (gravity.direction, gravity.acceleration) == (pytest.approx((0, 0, -1)), pytest.approx(1e-2))
    assert share_at(gravity.history, 0.0) == 1
    assert job.materials["BLOCK"].density == pytest.approx(1e12)
    assert pulled.vector == pytest.approx((4, 0, 0))
    assert pushed.vector == pytest.approx((0, 0, 12))


def test_supports_of_febio_3_and_4_and_a_step_in_the_first_increment(tmp_path):
    boundary = (
        '<bc node_set="@surface:LID" type="fix"><dofs>x,y</dofs></bc>'
        '<bc node_set="TOP" type="prescribed displacement"><dof>z</dof><value lc="1">2</value></bc>' + FIXED
    )
    curve = "<interpolate>STEP</interpolate><points><pt>0,0</pt><pt>1,0.5</pt></points>"
    supports = job_of(feb(tmp_path, boundary=boundary, loads="", curve=curve), tmp_path).supports
    moved = next(each for each in supports if hasattr(each, "shift"))
    assert {(each.face, each.directions) for each in supports if each is not moved} == {
        ("BOTTOM", "z"),
        ("fixed", "xy"),
    }
    assert moved.shift == pytest.approx((0, 0, 1e-3))
    assert [share_at(moved.way, s) for s in (0.0, 0.05, 0.1, 1.0)] == pytest.approx([0, 0.5, 1, 1])


def test_smooth_curves_blend_parabolas(tmp_path):
    curve = "<interpolate>SMOOTH</interpolate><points><pt>0,0</pt><pt>.25,1</pt><pt>.5,0</pt><pt>1,1</pt></points>"
    (load,) = job_of(feb(tmp_path, curve=curve), tmp_path).loads
    shares = [share_at(load.history, s) for s in (0.125, 0.25, 0.375, 0.5, 0.75, 1.0)]
    # the first parabola, the mean of both parabolas between the inner points, the last parabola
    assert shares == pytest.approx([0.75, 1, 0.5625, 0, 0, 1], abs=2e-3)


def test_nodes_of_a_set_of_cells(tmp_path):
    mesh = BRICKS + SETS + '<ElementSet name="UPPER">2</ElementSet>'
    boundary = FIXED + FIXED.replace("BOTTOM", "@elem_set:UPPER").replace("<x_dof>1", "<x_dof>0")
    job = job_of(feb(tmp_path, mesh=mesh, boundary=boundary), tmp_path)
    assert sorted(each.directions for each in job.supports) == ["x", "yz"]


def test_steps_are_one_path(tmp_path):
    first = "<Control><time_steps>1</time_steps><step_size>1</step_size></Control>"
    file = feb(tmp_path, curve="<points><pt>0,0</pt><pt>4,1</pt></points>")
    text = file.read_text()
    start, end = text.index("<Control>"), text.index("<Globals>")
    second = first.replace("<time_steps>1", "<time_steps>3")
    steps = f'<Step><step id="1">{first}</step><step id="2">{second}</step></Step>'
    file.write_text(text[:start] + text[end:].replace("</febio_spec>", steps + "</febio_spec>"))
    job = job_of(file, tmp_path)
    assert job.procedure.at == (0.25,)
    assert share_at(job.loads[0].history, 0.25) == pytest.approx(0.25)
    file.write_text(file.read_text().replace("</step><step", f"<Boundary>{FIXED}</Boundary></step><step"))
    with refused("<bc", "is missing"):
        tg.files.import_deck(file)


RIGID = '<material id="2" name="PLATE" type="rigid body"><density>1</density></material>'
PLATE = '<Elements type="hex8" name="PLATE"><elem id="3">9,10,11,12,21,22,23,24</elem></Elements>'
CORNERS = "".join(
    f'<node id="{i}">{x},{y},30</node>' for i, (x, y) in enumerate(((0, 0), (10, 0), (10, 10), (0, 10)), 21)
)
STILL = "<Rx_dof>1</Rx_dof><Ry_dof>1</Ry_dof><Ru_dof>1</Ru_dof><Rv_dof>1</Rv_dof><Rw_dof>1</Rw_dof>"


def with_plate(folder, still):
    rigid = (
        f'<Rigid><rigid_bc type="rigid_fixed"><rb>PLATE</rb>{still}</rigid_bc>'
        '<rigid_bc type="rigid_displacement"><rb>PLATE</rb><dof>Rz</dof><value lc="1">2</value></rigid_bc></Rigid>'
    )
    domains = DOMAIN + '<SolidDomain name="PLATE" mat="PLATE"/>'
    mesh = BRICKS + PLATE + SETS
    return feb(folder, material=SOFT + RIGID, mesh=mesh, points=POINTS + CORNERS, domains=domains, loads="", more=rigid)


def test_nodes_of_a_rigid_body_that_does_not_turn_go_its_way(tmp_path):
    job = job_of(with_plate(tmp_path, STILL), tmp_path)
    moved = next(each for each in job.supports if hasattr(each, "shift"))
    assert (moved.face, moved.shift, moved.directions) == ("TOP", pytest.approx((0, 0, 2e-3)), "z")
    assert sorted(each.directions for each in job.supports if each is not moved) == ["xy", "z"]  # of TOP, too
    assert len(job.actuator.read().points) == len(tg.jobs.read_job(tmp_path / "block.toml").actuator.read().points)
    assert np.ptp(job.actuator.read().points[:, 2]) == pytest.approx(0.02)  # without the plate
    with refused("rigid body", "Rv"):
        tg.files.import_deck(with_plate(tmp_path, STILL.replace("<Rv_dof>1", "<Rv_dof>0")))


def two_blocks(folder, gap, kind, more=""):
    lower = POINTS.splitlines()[:8]
    upper = []
    for number, row in enumerate(lower, 31):
        x, y, z = (float(part) for part in row.split(">")[1].split("<")[0].split(","))
        upper.append(f'<node id="{number}">{x},{y},{z + 20 + gap}</node>')
    mesh = (
        BRICKS.replace("</Elements>", '<elem id="3">31,32,33,34,35,36,37,38</elem></Elements>')
        + SETS
        + '<NodeSet name="ROOF">35,36,37,38</NodeSet><Surface name="FOOT"><quad4 id="1">31,32,33,34</quad4></Surface>'
        '<SurfacePair name="p"><primary>FOOT</primary><secondary>LID</secondary></SurfacePair>'
    )
    contact = f'<Contact><contact surface_pair="p" type="{kind}">{more}</contact></Contact>'
    roof = FIXED.replace("BOTTOM", "ROOF")
    return feb(folder, mesh=mesh, points=POINTS + "".join(upper), boundary=FIXED + roof, more=contact)


def test_contact_and_ties_of_febio(tmp_path):
    file = two_blocks(tmp_path, 0.5, "sliding-elastic", "<fric_coeff>0.3</fric_coeff>")
    assert job_of(file, tmp_path).contact.self_contact.friction == 0.3
    tied = tg.files.import_deck(two_blocks(tmp_path, 0.0, "tied-elastic"))
    assert any("tied-elastic" in row.keyword and row.verdict == "taken" for row in tied.rows)
    assert "merge = false" not in tg.files.import_deck(two_blocks(tmp_path, 0.0, "tied-elastic")).job
    assert "merge = false" in tg.files.import_deck(two_blocks(tmp_path, 0.0, "sliding-elastic")).job


def test_shells_on_sides_of_febio(tmp_path):
    film = '<Elements type="quad4" name="FILM"><elem id="7">9,10,11,12</elem></Elements>'
    paper = '<material id="2" name="PAPER" type="isotropic elastic"><E>2000</E><v>0.2</v></material>'
    domains = DOMAIN + '<ShellDomain name="FILM" mat="PAPER"><shell_thickness>0.1</shell_thickness></ShellDomain>'
    file = feb(tmp_path, mesh=BRICKS + film + SETS, material=SOFT + paper, domains=domains)
    sheet = job_of(file, tmp_path).materials["FILM"]
    assert (type(sheet).__name__, sheet.thickness, sheet.material.law.E) == ("Shell", pytest.approx(1e-4), 2e9)


def test_cells_of_second_order(tmp_path):
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    edges = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
    points = [*corners, *(corners[list(edge)].mean(axis=0) for edge in edges), *[corners.mean(axis=0)] * 5]
    rows = "".join(f'<node id="{i}">{",".join(map(str, xyz))}</node>' for i, xyz in enumerate(points, 1))
    mesh = f'<Elements type="tet15" name="BLOCK"><elem id="1">{",".join(map(str, range(1, 16)))}</elem></Elements>'
    mesh += SETS.replace("1,2,3,4", "1,2,3").replace('quad4 id="1">9,10,11,12</quad4', 'tri3 id="1">1,2,4</tri3')
    mesh = mesh.replace('<n id="9"/><n id="10"/><n id="11"/><n id="12"/>', "1,2,4")
    job = job_of(feb(tmp_path, points=rows, mesh=mesh), tmp_path)
    assert len(job.actuator.read().points) == 10


@pytest.mark.parametrize(
    ("changes", "facts"),
    [
        ({"material": of_type("Holmes-Mow", "<E>1</E>")}, ("<material", "Holmes-Mow")),
        ({"material": SOFT.replace("<k>5</k>", '<k lc="1">5</k>')}, ("<k>",)),
        ({"control": "<analysis>TRANSIENT</analysis>"}, ("<Control>", "TRANSIENT", "DYNAMIC")),
        ({"curve": "<extend>REPEAT</extend><points><pt>0,0</pt><pt>0.5,1</pt></points>"}, ("surface_load",)),
        (
            {"curve": "<interpolate>STEP</interpolate><points><pt>0,0</pt><pt>0.5,1</pt><pt>1,2</pt></points>"},
            ("pressure",),
        ),
        ({"loads": PULL.replace("<linear>0", "<linear>1")}, ("<surface_load",)),
        ({"boundary": FIXED + '<bc node_set="TOP" type="linear constraint"/>'}, ("linear constraint",)),
        ({"more": '<Constraints><constraint type="volume"/></Constraints>'}, ("<constraint", "volume")),
        ({"more": "<Discrete><discrete/></Discrete>"}, ("<discrete>",)),
    ],
)
def test_elements_that_a_job_cannot_express_are_refused_by_line(tmp_path, changes, facts):
    file = feb(tmp_path, **changes)
    row = tg.files.import_deck(file, partial=True).missing[0]
    with refused(f"block.feb:{row.line}", "is missing", *facts):
        tg.files.import_deck(file)
    assert row.keyword.split()[0].rstrip(">") in file.read_text().splitlines()[row.line - 1]


@pytest.mark.parametrize(
    ("changes", "facts"),
    [
        ({"module": '<Module type="fluid"/>'}, ("line 3", "<Module")),
        ({"points": POINTS.replace('<node id="7">', '<node id="13">')}, ("<elem", "node 7")),
        ({"points": POINTS.replace("0., 10., 20.", "0., 10.")}, ("<node", "2 numbers")),
        ({"mesh": BRICKS.replace("7,8</elem>", "7</elem>") + SETS}, ("<elem", "hex8", 8)),
        ({"mesh": BRICKS + SETS.replace("1,2,3,4", "1,2,3,99")}, ("<NodeSet", "node 99")),
        ({"mesh": BRICKS + SETS.replace("1,2,3,4", "1,2,3,x")}, ("<NodeSet",)),
        ({"domains": DOMAIN.replace('mat="SOFT"', 'mat="SOFF"')}, ("<SolidDomain", "'SOFF'", "'SOFT'")),
        ({"boundary": FIXED.replace("BOTTOM", "BOTOM")}, ("<bc", "'BOTOM'", "'BOTTOM'")),
        ({"loads": PULL.replace("LID", "LYD")}, ("<surface_load", "'LYD'", "'LID'")),
        ({"loads": PULL.replace('lc="1"', 'lc="7"')}, ("<pressure>", "'7'")),
        ({"loads": PULL.replace("-0.03", "x")}, ("<pressure>", "'x'")),
        ({"material": SOFT.replace("<G>0.2</G>", "<G>0.2")}, ("line 7",)),
        ({"control": "<time_steps>0</time_steps>"}, ("<Control>", "time_steps")),
        ({"curve": "<points><pt>0,0</pt><pt>1</pt></points>"}, ("<pt>",)),
    ],
)
def test_damaged_files_of_febio_are_named_by_element_and_line(tmp_path, changes, facts):
    with refused("block.feb", "line", *facts):
        tg.files.import_deck(feb(tmp_path, **changes))


def test_entities_are_not_read(tmp_path):
    file = feb(tmp_path)
    text = file.read_text().replace("<febio_spec", '<!DOCTYPE a [<!ENTITY x SYSTEM "/etc/hostname">]>\n<febio_spec', 1)
    file.write_text(text.replace('name="SOFT"', 'name="&x;"'))
    with refused("line 2", "DOCTYPE"):
        tg.files.import_deck(file)


@pytest.mark.parametrize("text", ["", "<a/>", "<febio_spec><Mesh/></febio_spec>", "<febio_spec/>"])
def test_what_is_no_file_of_febio(tmp_path, text):
    file = tmp_path / "bad.feb"
    file.write_text(text)
    with refused("bad.feb", "line"):
        tg.files.import_deck(file)


def test_units_that_a_file_states(tmp_path):
    file = feb(tmp_path, module='<Module type="solid"><units>mm-kg-s</units></Module>')
    assert job_of(file, tmp_path).loads[0].pressure == pytest.approx(-30)
    assert job_of(file, tmp_path, units="mm, N, MPa").loads[0].pressure == pytest.approx(-30e3)


def test_a_second_load_on_a_face_is_not_lost(tmp_path):
    more = '<nodal_load node_set="TOP" type="nodal_force"><value lc="1">1,0,0</value></nodal_load>'
    pressed, pulled = job_of(feb(tmp_path, loads=PULL + more), tmp_path).loads
    assert (pressed.pressure, pulled.vector) == (pytest.approx(-30e3), pytest.approx((4, 0, 0)))
    other = PULL.replace("-0.03", "-0.05")
    with refused("<surface_load", "'LID'"):
        tg.files.import_deck(feb(tmp_path, loads=PULL + other))
    with refused("<nodal_load", "is missing"):
        tg.files.import_deck(feb(tmp_path, loads=more + more.replace(' lc="1"', "")))
