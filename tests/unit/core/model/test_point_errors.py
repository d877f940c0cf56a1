"""Reference points that cannot be, and what cannot act on them: refused with a sentence; those that can, described."""

import numpy as np
import pytest
from turgor.loads import Force, Hanging, Moment
from turgor.measures import of_point
from turgor.supports import Hinge, NodesAt, PlaneSection, ReferencePoint, Rotation

import rig
import turgor as tg
from refused import refused
from turgor.core.engine.points.motion import PointMotion
from turgor.core.engine.system import System
from turgor.core.inp.write_inp import write_inp
from turgor.core.results.measures.measures import find_measure
from turgor.core.solvers.checks.supports import check_supports, free_motions
from turgor.core.solvers.solution import State
from turgor.views.report import describe

PLATE = ReferencePoint("plate", "x1")


@pytest.mark.parametrize(
    ("values", "facts"),
    [
        ({"name": "my plate"}, ("'my plate'", "underscores")),
        ({"face": NodesAt("rim", edge=("x0", "x1"))}, ("'plate'", "NodesAt", "'tip'")),
        ({"coupling": "rigd"}, ("coupling", "'plate'", "'rigd'", "'rigid'")),
        ({"mass": -1.0}, ("'plate'", "mass is -1.0", "0 or more")),
        ({"spring": (1.0, -2.0, 0.0)}, ("'plate'", "spring is (1.0, -2.0, 0.0)", "0 or more")),
        ({"inertia": (3.0, 1.0, 1.0)}, ("'plate'", "inertia is (3.0, 1.0, 1.0)", "three moments")),
        ({"at": (0.0, 1.0)}, ("'plate'", "at is (0.0, 1.0)", "three numbers")),
    ],
)
def test_a_point_out_of_range_is_refused(values, facts):
    with refused(*facts):
        ReferencePoint(**{"name": "plate", "face": "x1", **values})


@pytest.mark.parametrize(
    ("point", "supports", "loads", "facts"),
    [
        (ReferencePoint("plate", "x2"), (), (), ("x2", "x0, x1, y0, y1, z0, z1")),
        (ReferencePoint("y0", "x1"), (), (), ("'y0'", "face")),
        (PLATE, (PLATE,), (), ("reference points", "'plate'")),
        (PLATE, (Rotation("plat"),), (), ("plat", "plate")),
        (PLATE, (Rotation("plate"), Hinge("plate")), (), ("rotation", "'plate'", "Rotation or Hinge")),
        (PLATE, (tg.Fixed("plate", "xy"), tg.Fixed("plate", "y")), (), ("two supports", "'plate'")),
        (PLATE, (), (Moment("plte", (0, 0, 1)),), ("moment load", "'plte'", "'plate'")),
        (PLATE, (), (Hanging("x1", 1.0),), ("hanging load", "'x1'", "plate")),
        (PLATE, (), (Force("x1", (0, 0, 1), follower=True),), ("force on 'x1'", "ReferencePoint", "Pressure")),
    ],
)
def test_what_does_not_fit_the_model_is_refused(point, supports, loads, facts):
    with refused(*facts):
        rig.rig(point, supports, loads)


@pytest.mark.parametrize(
    ("point", "supports", "facts"),
    [
        (PLATE, (tg.Fixed("y0"),), ("'plate'", "5 of the 25", "'x1'")),
        (PLATE, (PlaneSection("x1"),), ("'plate'", "25 of the 25", "'x1'")),
        (PLATE, (ReferencePoint("again", "x1"),), ("'plate' and 'again'", "rigid faces")),
    ],
)
def test_a_rigid_face_is_held_by_its_point_alone(point, supports, facts):
    with refused(*facts):
        System(rig.rig(point, supports))
    System(rig.rig(ReferencePoint("plate", "x1", coupling="averaging"), supports))


@pytest.mark.parametrize("load", [Moment("plate", (1.0, 0, 0)), Hanging("plate", 1.0, (0, 1, 0))])
def test_what_has_no_mirror_image_is_refused(load):
    with refused("'plate'", "mirror image", "'symmetry_y'", "symmetric = false"):
        rig.rig(PLATE, loads=[load], mesh=rig.bar(half=True))
    with refused("rotation of 'plate'", "(1.0, 0.0, 0.0)", "about y", "symmetric = false"):
        System(rig.rig(PLATE, [Rotation("plate", 1.0, (1, 0, 0))], mesh=rig.bar(half=True)))
    with refused("'plate'", "1 mm along y", "0 mm"):
        System(rig.rig(ReferencePoint("plate", "x1", at=(0.04, 0.001, 0.0)), mesh=rig.bar(half=True)))


@pytest.mark.parametrize(
    ("holds", "free"),
    [
        ((), 6),
        ((tg.Fixed("plate"),), 3),
        ((tg.Fixed("plate"), Hinge("plate", "y")), 1),
        ((tg.Fixed("plate"), Hinge("plate", (1, 2, 3))), 1),
        ((tg.Fixed("plate"), Rotation("plate", 1.0, (1, 2, 3), tilts=True)), 2),
        ((Rotation("plate"),), 3),
        ((tg.Fixed("plate"), Rotation("plate")), 0),
    ],
)
@pytest.mark.parametrize("coupling", ["rigid", "averaging"])
def test_a_point_holds_the_motions_that_it_holds(holds, free, coupling):
    point = ReferencePoint("plate", "x1", coupling=coupling)
    mesh = rig.bar()
    model = tg.Model(mesh, rig.rig(point).materials, [point, *holds], [])
    assert free_motions(model) == free
    sprung = ReferencePoint("plate", "x1", coupling=coupling, spring=1.0, rotational_spring=1.0)
    check_supports(tg.Model(mesh, model.materials, [sprung], []))


@pytest.mark.parametrize("axis", ["w", (0, 0, 0), (1, 2)])
def test_a_hinge_needs_an_axis(axis):
    with refused("hinge of 'plate'", "axis is"):
        Hinge("plate", axis)


def test_a_hinge_between_mirror_planes_turns_about_their_normal_or_not_at_all():
    still, turns = (
        System(rig.rig(PLATE, [Hinge("plate", axis)], mesh=rig.bar(half=True))) for axis in ((1, 1, 0), (0, 2, 0))
    )
    free = [int((~s.prescribed[3 * s.carriers[0].arrows[:, None] + np.arange(3)]).sum()) for s in (still, turns)]
    assert free == [0, 4]
    with refused("rotation of 'plate'", "(1.0, 1.0, 0.0)", "about y"):
        System(rig.rig(PLATE, [Rotation("plate", 1.0, (1, 1, 0), tilts=True)], mesh=rig.bar(half=True)))


def test_it_is_described_and_measured():
    supports = [tg.Fixed("plate", "x"), Hinge("plate", "y")]
    model = rig.rig(PLATE, supports, [Moment("plate", (0, 0.02, 0)), Hanging("plate", 0.1)], bulk_modulus=5e6)
    said = " ".join([*describe.supports(model), *describe.loads(model)])
    assert "x1 moves rigidly with the reference point plate." in said
    assert "plate may turn about y only." in said
    assert "Moment (0, 0.02, 0) N m on plate, its axis fixed in space." in said
    assert "Weight of 0.1 kg hanging from plate" in said
    assert find_measure("plate_reaction_moment_y").unit == "Nm"
    with refused("rotaton", "rotation"):
        of_point("plate", "rotaton", "x")


@pytest.mark.parametrize(
    ("point", "supports", "loads", "facts"),
    [
        (ReferencePoint("plate", "x1", coupling="averaging"), (), (), ("'plate'", "CalculiX", "5 %")),
        (ReferencePoint("plate", "x1", rotational_spring=1.0), (), (), ("'plate'", "rotational spring")),
        (ReferencePoint("plate", "x1", mass=1.0, center=(0, 0, 0)), (), (), ("'plate'", "center")),
        (PLATE, (Hinge("plate", (1, 1, 0)),), (), ("hinge of 'plate'", "(1.0, 1.0, 0.0)", "x, y and z")),
        (PLATE, (Rotation("plate", 1.0, tilts=True),), (), ("'plate'", "tilts")),
        (PLATE, (), (Moment("plate", (0, 1, 0), follower=True),), ("moment on 'plate'", "follows")),
    ],
)
def test_what_has_no_form_in_inp_files_is_refused(tmp_path, point, supports, loads, facts):
    model = rig.rig(point, supports, loads, bulk_modulus=5e6)
    with refused(*facts):
        write_inp(model, tmp_path / "model.inp")


def test_an_inp_file_of_abaqus_has_couplings(tmp_path):
    file = tmp_path / "model.inp"
    point = ReferencePoint("plate", "x1", coupling="averaging", mass=0.1, spring=(20.0, 0, 0))
    write_inp(rig.rig(point, [tg.Fixed("plate", "x")], [Moment("plate", (0, 0.02, 0))]), file, program="abaqus")
    text = file.read_text()
    node = len(rig.bar().points) + 1
    assert f"*NODE\n{node}, 40, " in text
    assert f"*COUPLING, CONSTRAINT NAME=tie_plate, REF NODE={node}, SURFACE=x1\n*DISTRIBUTING\n1, 6\n" in text
    assert f"*BOUNDARY\n{node}, 1\n" in text
    assert f"*CLOAD, AMPLITUDE=ramp\n{node}, 5, 20\n" in text  # N mm
    assert "*SPRING, ELSET=spring_plate_x\n1\n0.02\n" in text  # N/mm


def test_its_rotation_is_read_as_vector_and_twist():
    turn = Rotation("plate", 1.5 * np.pi, (0, 0, 1))
    motion = PointMotion(
        displacement=np.array([1e-3, 0, 0]), rotation=turn.matrix(1.0), force=np.array([0, 2.0, 0]),
        moment=np.array([0, 0, 3.0]), multipliers=np.zeros((2, 3)),
    )  # fmt: skip
    model = rig.rig(PLATE)
    nothing = np.zeros_like(model.mesh.points)
    state = State(
        model=model, load_factor=1.0, displacement=nothing, mean_stress=np.zeros(0), nodal_force=nothing,
        points={"plate": motion},
    )  # fmt: skip
    assert of_point("plate", "displacement", "x")(state) == 1e-3
    assert of_point("plate", "rotation", "z")(state) == pytest.approx(-0.5 * np.pi)  # the shorter way
    assert of_point("plate", "twist", "z")(state) == pytest.approx(-0.5 * np.pi)
    assert of_point("plate", "twist", "z").unwrap
    assert of_point("plate", "twist", "x")(state) == pytest.approx(0.0)
    assert of_point("plate", "reaction", "y")(state) == 2.0
    assert of_point("plate", "reaction_moment", "z")(state) == 3.0
    with refused("plat_rotation_z", "plat", "plate"):
        of_point("plat", "rotation", "z")(state)
