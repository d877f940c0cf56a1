"""The CAD shape of bellows has the volumes, walls, faces and names that its dimensions say."""

from math import pi, sqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.bellows_of_revolution import BellowsOfRevolution
from turgor.core.geometry.parts.folds import Folds
from turgor.units import mm

FACES = {"cavity", "fixed", "outside", "tip"}
MIRRORS = {(True, True): {"symmetry_y", "symmetry_z"}, (True, False): {"symmetry_y"}, (False, True): set()}
SHARES = {(True, True): 4, (True, False): 2, (False, True): 1}


def cone(low: float, high: float, length: float) -> float:
    return pi * length * (low**2 + low * high + high**2) / 3


def fold(low: float, high: float, neck: float, crest: float) -> float:
    """Volume inside one rounded fold: an arc at the neck and one at the crest on each side, a step between them."""
    at_neck = quad(lambda x: pi * (low + neck - sqrt(neck**2 - x**2)) ** 2, 0, neck)[0]
    at_crest = quad(lambda x: pi * (high - crest + sqrt(crest**2 - x**2)) ** 2, 0, crest)[0]
    return 2 * (at_neck + at_crest)


@pytest.mark.parametrize("part", MIRRORS)
@pytest.mark.parametrize(
    ("folds", "inner", "outer", "wall", "pitch", "cap"),
    [(4, 8, 16, 1.5, 10, 4), (1, 3, 5, 1.9, 3, 1), (3, 10, 40, 1, 4, 7)],
)
def test_volumes_of_straight_folds_computed_by_hand(folds, inner, outer, wall, pitch, cap, part) -> None:
    bellows = BellowsOfRevolution(
        folds=folds, inner_radius=inner * mm, outer_radius=outer * mm, wall=wall * mm, pitch=pitch * mm,
        cap=cap * mm, fold_shape="straight", symmetric=part[0], quarter=part[1],
    )  # fmt: skip
    neck = bellows._folds.neck_radius / mm
    climb = outer - neck
    assert (neck - inner) / sqrt(1 + (2 * climb / pitch) ** 2) == pytest.approx(wall, rel=1e-9)  # across the wall
    cavity = 2 * folds * cone(inner, inner + climb, pitch / 2)
    filled = 2 * folds * cone(neck, outer, pitch / 2) + 2 * cap * pi * neck**2
    assert_shape(
        bellows,
        solid=(filled - cavity) / SHARES[part],
        cavities={"cavity": cavity / SHARES[part]},
        regions={"body"},
        faces=FACES | MIRRORS[part],
    )


@pytest.mark.parametrize("part", MIRRORS)
@pytest.mark.parametrize(
    ("folds", "inner", "outer", "wall", "pitch", "cap"),
    [(4, 8, 16, 1.5, 10, 4), (2, 3, 9, 0.5, 4, 1), (1, 20, 40, 4, 20, 2)],
)
def test_volumes_of_rounded_folds_computed_by_hand(folds, inner, outer, wall, pitch, cap, part) -> None:
    bellows = BellowsOfRevolution(
        folds=folds, inner_radius=inner * mm, outer_radius=outer * mm, wall=wall * mm, pitch=pitch * mm,
        cap=cap * mm, symmetric=part[0], quarter=part[1],
    )  # fmt: skip
    small, large, neck = pitch / 4 - wall / 2, pitch / 4 + wall / 2, inner + wall
    cavity = folds * fold(inner, outer - wall, large, small)
    filled = folds * fold(neck, outer, small, large) + 2 * cap * pi * neck**2
    geometry = bellows.build()
    assert bellows.solid_volume * 1e9 == pytest.approx((filled - cavity) / SHARES[part], rel=1e-7)  # of the quadrature
    assert geometry.cavity_volume * 1e9 == pytest.approx(cavity / SHARES[part], rel=1e-7)
    assert set(geometry.faces) == FACES | MIRRORS[part]


@pytest.mark.parametrize("shape", ["rounded", "straight"])
def test_the_wall_is_as_thick_as_stated(shape) -> None:
    faces = BellowsOfRevolution(fold_shape=shape, wall=1.3 * mm, folds=1).build().shape.faces
    outside = [face for face in faces if face.name == "outside"]
    gaps = [face.Distance(wall) for face in faces if face.name == "cavity" for wall in outside]
    assert min(gaps) == pytest.approx(1.3, rel=1e-6)


@pytest.mark.parametrize(("quarter", "lowest"), [(True, 0), (False, -16)])
def test_the_modeled_part_has_y_and_z_above_the_mirror_planes(quarter, lowest) -> None:
    shape = BellowsOfRevolution(fold_shape="straight", quarter=quarter).build().shape
    assert all(face.center.y > 0 for face in shape.faces if face.name in ("cavity", "outside"))
    corners = [vertex.p for vertex in shape.vertices]
    assert min(corner.z for corner in corners) == pytest.approx(lowest, abs=1e-6)
    assert max(corner.z for corner in corners) == pytest.approx(16)


def test_ends_and_inlet() -> None:
    plain = BellowsOfRevolution(symmetric=False)
    held = BellowsOfRevolution(symmetric=False, inlet_diameter=4 * mm, clamp_length=10 * mm)
    duct = pi * 2**2 * (10 + 4)
    assert (held.cavity_volumes["cavity"] - plain.cavity_volumes["cavity"]) * 1e9 == pytest.approx(duct)
    assert (held.solid_volume - plain.solid_volume) * 1e9 == pytest.approx(10 * pi * 9.5**2 - duct)
    of_plain, of_held = areas(plain.build()), areas(held.build())
    assert [of_plain["fixed"], of_plain["tip"], of_held["tip"]] == pytest.approx([pi * 9.5**2] * 3)
    assert of_held["fixed"] == pytest.approx(pi * (9.5**2 - 2**2) + 10 * 2 * pi * 9.5)
    assert of_held["outside"] == pytest.approx(of_plain["outside"])
    assert of_held["cavity"] - of_plain["cavity"] == pytest.approx(14 * 2 * pi * 2 - pi * 2**2)


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"folds": 0}, ("folds", 0, "1 to 50")),
        ({"fold_shape": "strait"}, ("fold_shape", "strait", "straight")),
        ({"inner_radius": 0.0}, ("inner_radius", "0 mm", "0.5 mm to 1000 mm")),
        ({"outer_radius": 8 * mm}, ("outer_radius", "8 mm", "8.03 mm to 1000 mm")),
        ({"outer_radius": 16.0}, ("outer_radius", "16000 mm", "8.03 mm to 1000 mm", "unit")),
        ({"pitch": 20 * mm}, ("pitch", "20 mm", "0.1 mm to 15.96 mm", "8 mm", "16 mm")),
        ({"wall": 4 * mm}, ("wall", "4 mm", "0.01 mm to 2.99 mm", "10 mm", "8 mm", "16 mm")),
        ({"wall": 6 * mm, "pitch": 15 * mm}, ("wall", "6 mm", "0.01 mm to 0.49 mm", "15 mm", "8 mm", "16 mm")),
        ({"cap": 0.0}, ("cap", "0 mm", "0.1 mm to 1000 mm")),
        ({"clamp_length": -1 * mm}, ("clamp_length", "-1 mm", "0.1 mm to 1000 mm")),
        ({"inlet_diameter": 16 * mm}, ("inlet_diameter", "16 mm", "0.1 mm to 15.99 mm")),
        ({"quarter": 1}, ("quarter", 1, "True or False")),
    ],
)
def test_dimensions_that_cannot_be_are_refused(wrong, facts) -> None:
    with refused(*facts):
        BellowsOfRevolution(**wrong)


@st.composite
def corrugations(draw: st.DrawFn) -> Folds:
    """Admissible folds of every shape, from shallow to deep and from thin to thick."""
    shape = draw(st.sampled_from(["rounded", "straight"]))
    inner = draw(st.floats(5, 50)) * mm
    height = inner * draw(st.floats(0.1, 3))
    pitch = max(height * draw(st.floats(0.1, 1.8)), 0.1 * mm)
    room = min(height - pitch / 2 - 0.01 * mm, pitch / 2 - 0.02 * mm) if shape == "rounded" else height - 0.01 * mm
    wall = max(room * draw(st.floats(0.05, 0.9)), 0.01 * mm)
    return Folds(
        count=draw(st.integers(1, 4)),
        inner_radius=inner,
        outer_radius=inner + height,
        wall=wall,
        pitch=pitch,
        shape=shape,
    )


@settings(max_examples=25, deadline=None)
@given(folds=corrugations())
def test_any_admissible_folds_give_the_shape_that_they_say(folds: Folds) -> None:
    bellows = BellowsOfRevolution(
        folds=folds.count, inner_radius=folds.inner_radius, outer_radius=folds.outer_radius, wall=folds.wall,
        pitch=folds.pitch, fold_shape=folds.shape, cap=max(folds.wall, 0.1 * mm),
    )  # fmt: skip
    geometry = bellows.build()  # raises if a CAD volume is off by 1e-9
    assert len(geometry.shape.solids) == 1
    assert areas(geometry)["tip"] * mm**2 == pytest.approx(pi / 4 * folds.neck_radius**2, rel=1e-9)


@pytest.mark.parametrize("shape", ["rounded", "straight"])
def test_the_default_meshes_coarsely(shape) -> None:
    assert_meshes(BellowsOfRevolution(fold_shape=shape, folds=2), size=4 * mm)
