"""The CAD shape of a PneuNet with trapezoidal bellows has the volumes, faces and names that its dimensions say."""

from math import cos, pi, tan

import pytest
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.trapezoidal_pneunet import TrapezoidalPneuNet
from turgor.units import deg, mm

FACES = {"cavity", "fixed", "outside", "strain_limiting_layer", "tip"}


@pytest.mark.parametrize(("chambers", "length", "lean", "wall"), [(8, 110, 10, 1.5), (3, 50, 20, 1), (1, 20, 0, 2)])
@pytest.mark.parametrize("symmetric", [True, False])
def test_volumes_computed_by_hand(chambers, length, lean, wall, symmetric):
    actuator = TrapezoidalPneuNet(
        chambers=chambers, length=length * mm, flank_angle=lean * deg, wall=wall * mm, symmetric=symmetric
    )
    a, share = lean * deg, 2 if symmetric else 1
    foot = (length - 4 - (chambers - 1)) / chambers
    rise = 15 - 5 - wall  # above the roof between the bellows
    outer = length * (5 + wall) + chambers * rise * (foot - rise * tan(a))
    # the air's flanks: those outside, moved inwards by the wall, from the ceiling at 5 mm up to 13.5 mm
    low = foot + 2 * wall * tan(a) - 2 * wall / cos(a)
    inner = (length - 4) * 2 + chambers * 8.5 * (low - 8.5 * tan(a))
    assert_shape(
        actuator, solid=(outer * 20 - inner * 16) / share, cavities={"cavity": inner * 16 / share},
        regions={"body", "base"}, faces=FACES | ({"symmetry_y"} if symmetric else set()),
    )  # fmt: skip


def test_the_flanks_are_as_thick_as_the_wall():
    wall, lean = 1.5, 10 * deg
    actuator = TrapezoidalPneuNet(chambers=2, length=30 * mm, symmetric=False)
    flanks = [face for face in actuator.build().shape.faces if abs(abs(_normal(face)[0]) - cos(lean)) < 1e-6]
    planes = sorted(
        (_normal(face)[0] > 0, sum(c * n for c, n in zip(face.center, _normal(face), strict=True))) for face in flanks
    )
    # for each of the two directions: an outer and an inner flank of each of the two bellows
    for direction in (False, True):
        results = [place for side, place in planes if side == direction]
        assert len(results) == 4
        assert results[1] - results[0] == pytest.approx(wall, rel=1e-6)
        assert results[3] - results[2] == pytest.approx(wall, rel=1e-6)


def _normal(face):
    """Unit normal of a planar face from three of its vertices: of the two, the one that does not point down."""
    a, b, c = (vertex.p for vertex in list(face.vertices)[:3])
    u, v = [b[i] - a[i] for i in range(3)], [c[i] - a[i] for i in range(3)]
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    size = sum(x * x for x in n) ** 0.5 * (1 if n[2] >= 0 else -1)
    return tuple(x / size for x in n) if size else n


def test_areas_of_the_ends_with_an_end_block_and_an_inlet():
    actuator = TrapezoidalPneuNet(chambers=2, length=30 * mm, clamp_length=10 * mm, inlet_diameter=1.5 * mm)
    result = areas(actuator.build())
    assert result["fixed"] == pytest.approx(10 * 6.5 - pi / 8 * 1.5**2 + 10 * (10 + 10 + 6.5), rel=1e-6)
    assert result["tip"] == pytest.approx(10 * 6.5)
    assert result["strain_limiting_layer"] == pytest.approx(10 * 40)


@pytest.mark.parametrize("options", [{}, {"clamp_length": 8 * mm, "inlet_diameter": 1.5 * mm}])
def test_it_meshes_coarsely(options):
    assert_meshes(TrapezoidalPneuNet(chambers=2, length=30 * mm, **options), size=4 * mm)


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"flank_angle": 60 * deg}, ("flank_angle", "60 deg", "0 deg to 36.03 deg", "12.38 mm")),
        ({"flank_angle": -1 * deg}, ("flank_angle", "-1 deg", "0 deg to 36.03 deg", "12.38 mm")),
        ({"flank_angle": "10 deg"}, ("flank_angle", "'10 deg'", "radians")),
        ({"flank_angle": 35 * deg}, ("top_wall", "1.5 mm", "2.286 mm to 9.99 mm")),
        ({"top_wall": 10 * mm}, ("top_wall", "10 mm", "0.01 mm to 9.99 mm")),
        ({"wall": 7.4 * mm}, ("wall", "7.4 mm", "0.01 mm to 7.314 mm", "12.38 mm")),
        ({"wall": 10 * mm}, ("wall", "10 mm", "0.01 mm to 9.97 mm", "15 mm")),
        ({"gap": 16 * mm}, ("gap", "16 mm", "0.01 mm to 15.574 mm", 8, "110 mm")),
        ({"end_wall": 60 * mm}, ("end_wall", "60 mm", "0.01 mm to 51.02 mm", 8, "110 mm")),
        ({"side_wall": 11 * mm}, ("side_wall", "11 mm", "0.01 mm to 9.995 mm", "20 mm")),
        ({"channel_height": 12 * mm}, ("channel_height", "12 mm", "0.01 mm to 11.96 mm", "15 mm")),
        ({"inlet_diameter": 2 * mm}, ("inlet_diameter", "2 mm", "0 mm to 1.99 mm", "16 mm x 2 mm")),
    ],
)
def test_an_impossible_dimension_is_refused(wrong, facts):
    with refused(*facts):
        TrapezoidalPneuNet(**wrong)


def test_flanks_as_steep_as_allowed_are_built():
    for lean, top_wall in ((36.029, 5), (35, 2.286)):
        geometry = TrapezoidalPneuNet(flank_angle=lean * deg, top_wall=top_wall * mm).build()
        a, height = lean * deg, 10 - top_wall  # of the air in a bellows
        low = (110 - 4 - 7) / 8 + 2 * 1.5 * tan(a) - 2 * 1.5 / cos(a)
        cavity = ((110 - 4) * 2 + 8 * height * (low - height * tan(a))) * 16
        assert geometry.cavity_volumes["cavity"] == pytest.approx(cavity / 2 * mm**3)
