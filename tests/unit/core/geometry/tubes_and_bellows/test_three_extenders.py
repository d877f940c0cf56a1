"""The CAD shape of three extenders has the volumes, faces and names that its dimensions say."""

from math import pi, sqrt

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.three_extenders import ThreeExtenders
from turgor.units import mm

FACES = {"fixed", "interface", "outside", "tip", "winding"}


@pytest.mark.parametrize("symmetric", [False, True])
@pytest.mark.parametrize(
    ("inner", "wall", "length", "cap", "side", "plate", "margin", "inlet"),
    [(6.35, 2, 100, 5, 30, 4, 3, 0), (3, 1, 20, 2, 8.5, 1, 0.5, 0), (10, 5, 200, 20, 60, 10, 10, 4)],
)
def test_volumes_computed_by_hand(inner, wall, length, cap, side, plate, margin, inlet, symmetric) -> None:
    robot = ThreeExtenders(
        inner_radius=inner * mm, wall=wall * mm, length=length * mm, cap=cap * mm, side=side * mm,
        plate_thickness=plate * mm, plate_margin=margin * mm, inlet_diameter=inlet * mm, symmetric=symmetric,
    )  # fmt: skip
    cavity = pi * inner**2 * (length - 2 * cap) + pi / 4 * inlet**2 * (plate + cap)
    plates = 2 * plate * pi * (side / sqrt(3) + inner + wall + margin) ** 2
    filled = plates + 3 * pi * (inner + wall) ** 2 * length
    cavities = {"cavity_1": cavity, "cavity_2": cavity, "cavity_3": cavity}
    if symmetric:
        cavities = {"cavity_1": cavity / 2, "cavity_2": cavity}
    assert_shape(
        robot,
        solid=(filled - 3 * cavity) / (2 if symmetric else 1),
        cavities=cavities,
        regions={"body", "plate"},
        faces=FACES | set(cavities) | ({"symmetry_y"} if symmetric else set()),
    )


def test_areas_of_the_default_whole() -> None:
    plate = pi * (30 / sqrt(3) + 8.35 + 3) ** 2
    cylinder = pi * 8.35**2
    assert areas(ThreeExtenders().build()) == pytest.approx(
        {
            **{f"cavity_{i}": 2 * pi * 6.35 * 90 + 2 * pi * 6.35**2 for i in (1, 2, 3)},
            "fixed": plate,
            "tip": plate,
            "winding": 3 * 2 * pi * 8.35 * 100,
            "interface": 6 * cylinder,
            "outside": 2 * (plate - 3 * cylinder) + 2 * 4 * 2 * sqrt(plate * pi),
        }
    )


def test_the_cylinders_form_an_equilateral_triangle_with_the_first_above() -> None:
    centers = {}
    for face in ThreeExtenders().build().shape.faces:
        if face.name.startswith("cavity") and face.bounding_box[1][0] - face.bounding_box[0][0] < 1e-3:
            centers[face.name] = complex(face.center.y, face.center.z)
    first, second, third = (centers[f"cavity_{i}"] for i in (1, 2, 3))
    assert [abs(first - second), abs(second - third), abs(third - first)] == pytest.approx([30, 30, 30])
    assert first == pytest.approx(complex(0, 30 / sqrt(3)), abs=1e-9)
    assert second.real < 0 < third.real


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"side": 10 * mm}, ("side", "10 mm", "16.71 mm to 2000 mm", "16.7 mm")),
        ({"cap": 50 * mm}, ("cap", "50 mm", "0.1 mm to 49.995 mm", "100 mm")),
        ({"wall": 0.0}, ("wall", "0 mm", "0.1 mm to 200 mm")),
        ({"inner_radius": -1 * mm}, ("inner_radius", "-1 mm", "0.5 mm to 200 mm")),
        ({"length": 100.0}, ("length", "100000 mm", "1 mm to 2000 mm", "unit")),
        ({"plate_thickness": 0.0}, ("plate_thickness", "0 mm", "0.1 mm to 200 mm")),
        ({"plate_margin": 0.0}, ("plate_margin", "0 mm", "0.1 mm to 1000 mm")),
        ({"inlet_diameter": 13 * mm}, ("inlet_diameter", "13 mm", "0.01 mm to 12.68 mm")),
        ({"symmetric": None}, ("symmetric", "None", "True or False")),
    ],
)
def test_dimensions_that_cannot_be_are_refused(wrong, facts) -> None:
    with refused(*facts):
        ThreeExtenders(**wrong)


def test_a_short_one_meshes_coarsely() -> None:
    assert_meshes(ThreeExtenders(length=25 * mm, symmetric=True), size=5 * mm)
