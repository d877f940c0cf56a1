"""The CAD shape of a revolute joint has the volumes, faces and names that its dimensions say."""

from math import pi

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.revolute_joint import RevoluteJoint
from turgor.units import mm

FACES = {"fixed", "interface", "outside", "tip"}


@pytest.mark.parametrize("symmetric", [False, True])
@pytest.mark.parametrize("actuators", [1, 2])
@pytest.mark.parametrize(
    ("length", "width", "plate", "arm", "hinge", "gap", "inner", "wall", "cap", "offset", "margin"),
    [
        (60, 18, 4, 6, 2, 6, 5, 1.5, 4, 13, 2),
        (30, 8, 1, 2, 2, 1, 2, 1, 1, 4.5, 0.5),
        (200, 60, 20, 9, 1, 50, 8, 4, 30, 40, 9),
    ],
)
def test_volumes_computed_by_hand(
    length, width, plate, arm, hinge, gap, inner, wall, cap, offset, margin, actuators, symmetric
) -> None:
    joint = RevoluteJoint(
        actuators=actuators, length=length * mm, width=width * mm, plate_thickness=plate * mm, arm_height=arm * mm,
        hinge_thickness=hinge * mm, hinge_length=gap * mm, inner_radius=inner * mm, wall=wall * mm, cap=cap * mm,
        offset=offset * mm, margin=margin * mm, symmetric=symmetric,
    )  # fmt: skip
    share, free = (2 if symmetric else 1), length - 2 * plate
    cavity = pi * inner**2 * (free - 2 * cap)
    above = offset + inner + wall + margin
    height = 2 * above if actuators == 2 else above + arm / 2 + margin
    links = width * (2 * plate * height + arm * (free - gap) + hinge * gap)
    body = actuators * (pi * (inner + wall) ** 2 * free - cavity)
    names = ["cavity"] if actuators == 1 else ["cavity_1", "cavity_2"]
    assert_shape(
        joint,
        solid=(links + body) / share,
        cavities=dict.fromkeys(names, cavity / share),
        regions={"body", "link", "hinge"},
        faces=FACES | set(names) | ({"symmetry_y"} if symmetric else set()),
    )


def test_areas_of_the_default_whole() -> None:
    cylinder, tube = pi * 6.5**2, 2 * pi * 6.5 * 52
    plate, chamber = 18 * 43, 2 * pi * 5 * 44 + 2 * pi * 5**2
    sides = 2 * 4 * 2 * (18 + 43) + 46 * 2 * (18 + 6) + 6 * 2 * (18 + 2)
    assert areas(RevoluteJoint(symmetric=False).build()) == pytest.approx(
        {
            "cavity_1": chamber,
            "cavity_2": chamber,
            "fixed": plate,
            "tip": plate,
            "interface": 4 * cylinder + 2 * 18 * 6 + 2 * 18 * 2,
            "outside": sides + 2 * tube + 2 * (plate - 2 * cylinder - 18 * 6) + 2 * 18 * (6 - 2),
        }
    )


def test_each_cylinder_has_its_inlet() -> None:
    plain, joint = RevoluteJoint(), RevoluteJoint(inlet_diameter=3 * mm)
    for name in ("cavity_1", "cavity_2"):
        added = joint.cavity_volumes[name] - plain.cavity_volumes[name]
        assert added * 1e9 == pytest.approx(pi * 1.5**2 * 8 / 2)
    assert areas(joint.build())["fixed"] == pytest.approx(18 * 43 / 2 - pi * 1.5**2)


def test_the_first_cylinder_lies_above() -> None:
    faces = RevoluteJoint().build().shape.faces
    assert all(face.bounding_box[0][2] > 0 for face in faces if face.name == "cavity_1")
    assert all(face.bounding_box[1][2] < 0 for face in faces if face.name == "cavity_2")


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"actuators": 3}, ("actuators", 3, "1 to 2")),
        ({"offset": 8 * mm}, ("offset", "8 mm", "9.51 mm to 1000 mm", "13 mm", "6 mm")),
        ({"width": 12 * mm}, ("width", "12 mm", "13 mm to 1000 mm", "13 mm")),
        ({"hinge_thickness": 7 * mm}, ("hinge_thickness", "7 mm", "0.1 mm to 6 mm")),
        ({"hinge_length": 52 * mm}, ("hinge_length", "52 mm", "0.1 mm to 51.98 mm")),
        ({"plate_thickness": 30 * mm}, ("plate_thickness", "30 mm", "0.1 mm to 29.98 mm", "60 mm")),
        ({"cap": 26 * mm}, ("cap", "26 mm", "0.01 mm to 25.995 mm", "52 mm")),
        ({"inlet_diameter": 10 * mm}, ("inlet_diameter", "10 mm", "0.01 mm to 9.98 mm")),
        ({"wall": 0.0}, ("wall", "0 mm", "0.1 mm to 200 mm")),
        ({"length": 60.0}, ("length", "60000 mm", "1 mm to 2000 mm", "unit")),
    ],
)
def test_dimensions_that_cannot_be_are_refused(wrong, facts) -> None:
    with refused(*facts):
        RevoluteJoint(**wrong)


@pytest.mark.parametrize("actuators", [1, 2])
def test_a_short_one_meshes_coarsely(actuators) -> None:
    assert_meshes(RevoluteJoint(length=30 * mm, actuators=actuators), size=5 * mm)
