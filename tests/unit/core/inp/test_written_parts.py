"""Sheets, threads, contact, stages and motion in .inp files: what is written for each program, and what is refused."""

import re
from dataclasses import replace
from math import pi

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.inp.account import APPROXIMATED, LEFT_OUT, WRITTEN, by_verdict
from turgor.core.inp.tracks import statements
from turgor.core.inp.write_inp import write_inp
from turgor.core.model.contact import Contact
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.model.loads.load import DeckRows
from turgor.core.model.obstacles import Box, Obstacle, Plane, SelfContact, Sphere
from turgor.core.model.points import ReferencePoint
from turgor.core.model.supports import Displacement, Shift
from turgor.core.solvers.procedures.stages import Stage
from turgor.units import MPa, kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.05 * MPa), bulk_modulus=1 * MPa, density=1100.0)
PAPER = tg.Material(name="paper", law=tg.laws.Hooke(E=50 * MPa, nu=0.3))
THREAD = tg.Material(name="thread", law=tg.laws.Hooke(E=200 * MPa, nu=0.3))


@pytest.fixture(scope="module")
def mesh():
    return tg.mesh(tg.actuators.FastPneuNet(chambers=1, length=10 * mm).build(), size=5 * mm, cells="tetrahedra")


def model(mesh, sheet=None, **more):
    materials = {"body": RUBBER, "base": RUBBER} | ({} if sheet is None else {"strain_limiting_layer": sheet})
    given = {"supports": ["fixed"], "loads": [tg.Pressure("cavity", 5 * kPa)], "contact": Contact(self_contact=False)}
    return tg.Model(mesh, materials, **(given | more))


def written(folder, model, program="abaqus", **more):
    notes = write_inp(model, folder / "a.inp", program=program, **more)
    text = (folder / "a.inp").read_text(encoding="ascii")
    assert all(f"** {note}\n" in text for note in notes)
    return text, {note.what: note for note in notes}


@pytest.mark.parametrize(("program", "kind"), [("abaqus", "STRI65"), ("calculix", "S6")])
def test_shells(tmp_path, mesh, program, kind):
    text, notes = written(tmp_path, model(mesh, tg.Shell(PAPER, 0.1 * mm)), program)
    assert f"*ELEMENT, TYPE={kind}, ELSET=shell_strain_limiting_layer\n" in text
    assert "MATERIAL=shell_strain_limiting_layer\n0.1\n" in text
    assert notes["materials.strain_limiting_layer"].verdict == (WRITTEN if program == "abaqus" else APPROXIMATED)


def test_a_bending_stiffness_of_its_own_is_that_of_another_plate(tmp_path, mesh):
    own = 2e-4
    shell = tg.Shell(replace(PAPER, bending_stiffness=own, density=800.0), 0.1 * mm)
    text, _ = written(tmp_path, model(mesh, shell))
    label = "shell_strain_limiting_layer"
    E = float(re.search(rf"NAME={label}\n\*ELASTIC\n([^,]*), 0.3", text)[1])
    h = float(re.search(rf"MATERIAL={label}\n(\S*)\n", text)[1])
    density = float(re.search(rf"NAME={label}\n.*\n.*\n\*DENSITY\n(\S*)\n", text)[1])
    assert E * h == pytest.approx(50 * 0.1)  # N/mm
    assert E * h**3 / 12 / (1 - 0.3**2) == pytest.approx(own / 1e-3)  # N mm
    assert density * h == pytest.approx(800e-12 * 0.1)


def test_sheets_that_wrinkle(tmp_path, mesh):
    taut = tg.Membrane(PAPER, 0.1 * mm, compression=0)
    text, notes = written(tmp_path, model(mesh, taut))
    assert re.search(r"\*ELASTIC\n50, 0.3\n\*NO COMPRESSION\n\*MEMBRANE SECTION", text)
    assert "without the stiffness" not in notes["materials.strain_limiting_layer"].text
    _, notes = written(tmp_path, model(mesh, tg.Shell(PAPER, 0.1 * mm, compression=0)))
    assert "without the stiffness against bending" in notes["materials.strain_limiting_layer"].text
    with refused("'strain_limiting_layer'", "CalculiX", "tension only"):
        written(tmp_path, model(mesh, taut), "calculix")
    with refused("'strain_limiting_layer'", "0.2", "*NO COMPRESSION"):
        written(tmp_path, model(mesh, tg.Membrane(PAPER, 0.1 * mm, compression=0.2)))


def wound(**more):
    winding = Winding(angle_from_axis=0.0, spacing=2 * mm, axis=(1, 0, 0))
    given = {"face": "outside", "material": THREAD, "diameter": 0.2 * mm, "winding": winding, "form": "discrete"}
    return Fibers(**(given | more))


@pytest.fixture(scope="module", params=["tetrahedra", "hexahedra"])
def tube(request):
    return tg.mesh(tg.actuators.ExtendingCylinder(length=20 * mm).build(), size=8 * mm, cells=request.param)


def spun(tube, fibers):
    materials = dict.fromkeys(tube.regions, RUBBER)
    return tg.Model(tube, materials, ["fixed"], [], reinforcements=[fibers], contact=Contact(self_contact=False))


def test_threads_follow_the_sides_of_cells(tmp_path, tube):
    text, notes = written(tmp_path, spun(tube, wound()))
    places = {}
    for line in text.splitlines():
        if re.fullmatch(r"\d+(, \S+){3}", line) and "." in line:
            node, *at = line.split(", ")
            places[int(node)] = np.array(at, dtype=float)
    equations = re.findall(r"\*EQUATION\n(\d+)\n((?:\d+, \d, \S+.*\n)+)", text)
    assert len(equations) > 30
    for count, lines in equations:
        words = lines.replace("\n", ", ").strip(", ").split(", ")
        terms = [(int(words[k]), int(words[k + 1]), float(words[k + 2])) for k in range(0, len(words), 3)]
        assert len(terms) == int(count)
        assert sum(value for *_, value in terms) == pytest.approx(0, abs=1e-9)  # a shift of all moves the thread
        if tube.cell_type.side.nodes == 6:  # the middle of a curved side of nine nodes is elsewhere
            assert sum(value * places[n] for n, _, value in terms) == pytest.approx(np.zeros(3), abs=1e-8)
    assert re.search(r"\*NO COMPRESSION\n\*SOLID SECTION, ELSET=threads_1_slack", text)
    area = float(re.search(r"MATERIAL=threads_1_slack\n(\S*)\n", text)[1])
    assert area == pytest.approx(pi * 0.2**2 / 4)
    assert notes["fibers.outside"].verdict == APPROXIMATED
    both = spun(tube, wound(compression=0.25, form="smeared"))
    text, notes = written(tmp_path, both)
    shares = [float(re.search(rf"MATERIAL=threads_1{kind}\n(\S*)\n", text)[1]) / area for kind in ("", "_slack")]
    assert shares == pytest.approx([0.25, 0.75])
    assert "spreads over the face" in notes["fibers.outside"].text
    text, _ = written(tmp_path, both, "calculix")
    table = re.search(r"NONLINEAR\n\n(\S+), (\S+)\n(\S+), (\S+)\n(\S+), (\S+)\n", text)
    pushed, shorter, zero, _, pulled, longer = (float(each) for each in table.groups())
    assert (zero, pushed / pulled, shorter) == pytest.approx((0.0, -0.25, -longer))
    assert pulled == pytest.approx(200 * area)


def volume_of_wedges(text, label):
    nodes = {}
    block = re.search(rf"\*NODE, NSET={label}\n((?:\d.*\n)+)", text)[1]
    for line in block.splitlines():
        node, *at = line.split(", ")
        nodes[int(node)] = np.array(at, dtype=float)
    cells = re.search(rf"\*ELEMENT, TYPE=C3D6, ELSET={label}\n((?:\d.*\n)+)", text)[1]
    for line in cells.splitlines():
        _, a, b, c, d, _, _ = (int(each) for each in line.split(", "))
        yield np.cross(nodes[b] - nodes[a], nodes[c] - nodes[a]) @ (nodes[d] - nodes[a])


@pytest.mark.parametrize(
    "shape",
    [
        Plane(point=(0, 0, -5 * mm), normal=(0, 0, 1)),
        Sphere(center=(0, 0, -9 * mm), radius=4 * mm),
        Box(center=(0, 0, -9 * mm), size=(5 * mm, 5 * mm, 0.5 * mm), rounding=0.1 * mm),
    ],
)
def test_obstacles_are_wedges_that_are_not_turned_over(tmp_path, mesh, shape):
    plate = Obstacle(name="plate", shape=shape, friction=0.4, path=((0, (0, 0, 0)), (1, (0, 0, 2 * mm))))
    text, notes = written(tmp_path, model(mesh, contact=Contact(False, [plate])))
    assert min(volume_of_wedges(text, "rigid_plate")) > 0
    assert "PRESSURE-OVERCLOSURE=HARD\n*FRICTION, SLIP TOLERANCE=0.005\n0.4\n" in text
    assert "SURFACE TO SURFACE\ncontact_outside, rigid_plate\n" in text
    node = int(re.search(r"REF NODE=(\d+)", text)[1])
    assert f"*BOUNDARY, AMPLITUDE=ramp\n{node}, 1, 1, 0\n" in text and f"\n{node}, 3, 3, 2\n" in text
    assert f"\n{node}, 4, 4, 0\n" in text
    assert notes["obstacles.plate"].verdict == APPROXIMATED


@pytest.mark.parametrize(
    "shape", [Plane(point=(0, 0, -5 * mm), normal=(0, 0, 1)), Sphere(center=(0, 0, -9 * mm), radius=4 * mm)]
)
def test_obstacles_that_begin_elsewhere_and_go_on_in_stages(tmp_path, mesh, shape):
    def heights(start):
        path, turns = ((0, (0, 0, start)), (1, (0, 0, start))), ((0, (0, start, 0)), (1, (0, 3 * start, 0)))
        plate = Obstacle(name="plate", shape=shape, path=path, rotation=turns, about=(0, 0, -9 * mm))
        stages = tg.Stages([Stage("wait"), Stage("press", moves={"plate": (0, 0, start + 2 * mm)})])
        text, _ = written(tmp_path, model(mesh, contact=Contact(False, [plate])), procedure=stages)
        lines = re.search(r"\*NODE, NSET=rigid_plate\n((?:\d.*\n)+)", text)[1].splitlines()
        return text, np.array([line.split(", ")[3] for line in lines], dtype=float)

    (text, moved), (_, there) = heights(-3 * mm), heights(0.0)
    node = re.search(r"REF NODE=(\d+)", text)[1]
    assert f"\n{node}, 0, 0, -12\n" in text
    assert [float(each) for each in re.findall(rf"\n{node}, 3, 3, (.*)", text)] == pytest.approx([0.0, 2.0])
    assert [float(each) for each in re.findall(rf"\n{node}, 5, 5, (.*)", text)] == pytest.approx([-6e-3])
    assert moved.max() == pytest.approx(there.max() - 3.0, abs=0.3)  # a plane is drawn a little turned


def test_springs_and_penalties_of_obstacles(tmp_path, mesh):
    ball = Obstacle(name="ball", shape=Sphere(center=(0, 0, -9 * mm), radius=4 * mm), spring=80.0, stiffness=3e9)
    text, _ = written(tmp_path, model(mesh, contact=Contact(False, [ball])), "calculix")
    assert "PRESSURE-OVERCLOSURE=LINEAR\n3\n" in text
    assert re.findall(r"\*SPRING, ELSET=spring_ball_(\w)\n(\d)\n0.04\n", text) == [("x", "1"), ("z", "3")]  # of a half
    node = int(re.search(r"REF NODE=(\d+)", text)[1])
    assert f"\n{node}, 2, 2, 0\n" in text and f"\n{node}, 1, 1, 0\n" not in text
    moved = replace(ball, path=((0, (0, 0, 0)), (1, (1 * mm, 0, 0))))
    with refused("'ball'", "spring"):
        written(tmp_path, model(mesh, contact=Contact(False, [moved])))
    later = tg.Stages([tg.Stage("wait"), tg.Stage("move", moves={"ball": (1 * mm, 0, 0)})])
    with refused("'ball'", "spring"):
        write_inp(model(mesh, contact=Contact(False, [ball])), tmp_path / "model.inp", procedure=later)


def test_walls_that_meet_are_pairs(tmp_path):
    two = tg.mesh(tg.actuators.FastPneuNet(chambers=2, length=20 * mm).build(), size=6 * mm, cells="tetrahedra")
    question = model(two, contact=Contact(SelfContact(friction=0.2, elastic_slip=0.01 * mm)))
    text, _ = written(tmp_path, question)
    assert "\ncontact_outside, contact_outside\n" in text
    assert "*FRICTION, ELASTIC SLIP=0.01\n0.2\n" in text
    text, notes = written(tmp_path, question, "calculix")
    assert "\nwall_outside_1, wall_outside_2\n" in text
    sides = [re.search(rf"NAME=wall_outside_{k}, .*\n((?:\d.*\n)+)", text)[1].splitlines() for k in (1, 2)]
    assert all(sides) and not set(sides[0]) & set(sides[1])
    assert notes["contact.self_contact"].verdict == LEFT_OUT


SPANS = [(0, 1), (1, 3), (3, 4), (4, 5), (5, 6)]


def test_a_row_is_stated_where_it_changes():
    def pressure(value, *history):
        return DeckRows("*DSLOAD", history, (f"cavity, P, {value}",))

    rise, stay, fall = pressure(4, (0, 0), (1, 1)), pressure(4, (0, 1), (1, 1)), pressure(4, (0, 1), (1, 0))
    more = pressure(8, (0, 0), (1, 1))
    stages = statements([[rise], [stay], [fall, more], [pressure(8, (0, 1), (1, 0))], []], SPANS)
    assert [[(each.curve, each.rows) for each in stage] for stage in stages] == [
        [(((0, 0), (1, 1)), ("cavity, P, 4",))],
        [],
        [(((3, 0.5), (4, 1)), ("cavity, P, 8",))],
        [(((4, 1), (5, 0)), ("cavity, P, 8",))],
        [],
    ]


def test_stages_are_steps_that_state_what_changes(tmp_path, mesh):
    way = tg.Stages([
        Stage("press", loads=[tg.Pressure("outside", 1 * kPa)]),
        Stage("push", displacements=[Displacement("fixed", Shift((0, 0, 1 * mm)), "xyz")]),
        Stage("off", loads=[tg.Pressure("outside", 0.0)]),
    ])  # fmt: skip
    text, notes = written(tmp_path, model(mesh), procedure=way)
    steps = re.findall(r"\*\* stage (\w+)\n(.*?)\*END STEP", text, re.DOTALL)
    assert [name for name, _ in steps] == ["press", "push", "off"]
    rows = [re.findall(r"^\w+, (?:P|\d, \d), \S+$", step, re.MULTILINE) for _, step in steps]
    assert sorted(rows[0]) == ["cavity, P, 0.005", *(f"fixed, {k}, {k}, 0" for k in (1, 2, 3)), "outside, P, 0.001"]
    assert rows[1:] == [["fixed, 3, 3, 1"], ["outside, P, 0.001"]]
    assert notes["stages.push"].text == "*STATIC"


def test_what_a_later_stage_needs_is_written(tmp_path, mesh):
    warm, press = [tg.loads.Shrinkage("body", 0.02), tg.loads.Shrinkage("base", 0.01)], tg.Pressure("cavity", -3 * kPa)
    question = model(mesh, loads=[], contact=Contact())
    text, _ = written(tmp_path, question, procedure=tg.Stages([Stage("wait"), Stage("dry", loads=[*warm, press])]))
    assert re.findall(r"\*EXPANSION, ZERO=0.\n(\S+)", text) == ["-0.02", "-0.01"]
    assert "TYPE=TEMPERATURE\nNall, 0.\n" in text and "*TEMPERATURE, AMPLITUDE=" in text
    assert "\ncontact_cavity, contact_cavity\n" in text  # suction brings its walls together
    with refused("Shrinkage(body)", "later stage"):
        written(tmp_path, question, procedure=tg.Stages([Stage("a", loads=warm[:1]), Stage("b", loads=warm[1:])]))


def test_procedures(tmp_path, mesh):
    free = model(mesh)
    text, _ = written(tmp_path, free, procedure=tg.Dynamic(duration=0.2, mass_damping=3.0, velocity=(0, 0, 0.5)))
    assert "*DAMPING, ALPHA=3, BETA=0\n" in text and "TYPE=VELOCITY\nNall, 3, 500\n" in text
    assert re.search(r"\*DYNAMIC, ALPHA=-0.111111\n0.0002, 0.2, \S+, 0.004\n", text)
    assert "*AMPLITUDE, NAME=history_1, TIME=TOTAL TIME\n0, 0\n0.2, 1\n" in text
    text, _ = written(tmp_path, free, procedure=tg.ArcLength(at=(0.5,)))
    assert re.findall(r"\*STATIC, RIKS\n0.05, 1, \S+, 0.1, 1\n", text)  # one step, to the full load
    assert "*STATIC, STABILIZE=0.0005\n" in written(tmp_path, free, procedure=tg.Stabilized())[0]
    for procedure, said in (
        (tg.Dynamic(duration=0.2, mass_damping=3.0), "damping"), (tg.ArcLength(), "arc length"),
        (tg.Stabilized(), "viscous"),
    ):  # fmt: skip
        with refused("CalculiX", said):
            written(tmp_path, free, "calculix", procedure=procedure)
    hung = model(mesh, supports=["fixed", ReferencePoint("weight", face="tip", mass=0.1)])
    with refused("'weight'", "mass", "motion"):
        written(tmp_path, hung, procedure=tg.Dynamic(duration=0.2))
    with refused("VolumeControl", "static"):
        written(tmp_path, model(mesh, loads=[]), procedure=tg.VolumeControl(volume=1e-6))
    with refused("stage 'fill'", "VolumeControl"):
        written(tmp_path, model(mesh, loads=[]), procedure=tg.Stages([Stage("fill", tg.VolumeControl(volume=1e-6))]))


def test_what_differs_comes_first(tmp_path, mesh):
    _, notes = written(tmp_path, model(mesh, tg.Membrane(PAPER, 0.1 * mm)), "calculix")
    verdicts = [note.verdict for note in by_verdict(notes.values())]
    assert verdicts == sorted(verdicts, key=[LEFT_OUT, APPROXIMATED, WRITTEN].index) and APPROXIMATED in verdicts
