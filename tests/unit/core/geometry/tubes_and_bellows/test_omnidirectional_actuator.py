"""The CAD shape of an omnidirectional actuator has the volumes, faces and names that its dimensions say."""

from math import asin, cos, hypot, pi, sin, sqrt

import pytest
from scipy.integrate import quad
from tube_cases import areas, assert_meshes, assert_shape

from refused import refused
from turgor.core.geometry.actuators.omnidirectional_actuator import OmnidirectionalActuator
from turgor.core.geometry.parts.chambers import SHAPES, ChamberSection
from turgor.units import mm


def section_area(shape: str, count: int, size: float, reach: float, web: float) -> float:
    if shape == "ring_sector":  # rings of a width that the webs leave
        return quad(lambda r: 2 * r * (pi / count - asin(web / 2 / r)), reach - size, reach)[0]
    return {"c": pi * size**2 / 4, "s": pi * size**2 / 8, "t": sqrt(3) / 4 * size**2}[shape[0]]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(
    ("count", "length", "radius", "size", "wall", "web", "bore", "cap"),
    [
        (3, 60, 12.5, 7, 2, 2, 0, 5),
        (2, 30, 10, 6, 1, 3, 0.5, 2),
        (4, 100, 20, 8, 3, 1.5, 2, 10),
        (7, 20, 15, 5, 1, 1, 3, 1),
        (3, 40, 12.5, 4, 2, 9, 0, 5),
    ],
)
def test_volumes_computed_by_hand(shape, count, length, radius, size, wall, web, bore, cap) -> None:
    chamber = section_area(shape, count, size, radius - wall, web) * (length - 2 * cap)
    filled = pi * (radius**2 - bore**2) * length
    for symmetric in (False, True):
        actuator = OmnidirectionalActuator(
            chambers=count, length=length * mm, outer_radius=radius * mm, chamber_shape=shape, chamber_size=size * mm,
            wall=wall * mm, web=web * mm, bore_radius=bore * mm, cap=cap * mm, symmetric=symmetric,
        )  # fmt: skip
        cavities = {f"cavity_{i}": chamber for i in range(1, count + 1)}
        if symmetric:  # the chambers on the mirror plane count half, the others once for the two that they stand for
            on_mirror = {"cavity_1", f"cavity_{count // 2 + 1}"} if count % 2 == 0 else {"cavity_1"}
            cavities = {f"cavity_{i}": chamber for i in range(1, count // 2 + 2)}
            cavities |= dict.fromkeys(on_mirror, chamber / 2)
        assert_shape(
            actuator,
            solid=(filled - count * chamber) / (2 if symmetric else 1),
            cavities=cavities,
            regions={"body"},
            faces={*cavities, "fixed", "outside", "tip", *(["symmetry_y"] if symmetric else [])},
        )


@pytest.mark.parametrize("symmetric", [False, True])
def test_chambers_follow_counterclockwise_from_the_top(symmetric) -> None:
    # seen from the tip, y points to the right: the second chamber lies on the left, the third on the right
    middle = {}
    for face in OmnidirectionalActuator(symmetric=symmetric).build().shape.faces:
        low, high = face.bounding_box
        middle.setdefault(face.name, []).append(((low[1] + high[1]) / 2, (low[2] + high[2]) / 2))
    right = "cavity_2" if symmetric else "cavity_3"
    assert all(z > 0 for _, z in middle["cavity_1"])
    assert all(y > 0 > z for y, z in middle[right])
    if not symmetric:
        assert all(y < 0 and z < 0 for y, z in middle["cavity_2"])


def shortest(section: ChamberSection, steps: int = 400) -> tuple[float, float, float]:
    """Distances of an outline from its neighbor (by halves), from the axis and from the middle, by sampling it."""
    beside, axis, middle = [], [], []
    y0, z0 = section.middle()
    for start, end, arc in section.outline().edges:
        for i in range(steps):
            point = along(start, end, arc, i / steps)
            beside.append(point[1] * sin(pi / section.count) - point[0] * cos(pi / section.count))
            axis.append(hypot(*point))
            middle.append(hypot(point[0] - y0, point[1] - z0))
    return 2 * min(beside), min(axis), min(middle)


def along(start, end, arc, share) -> tuple[float, float]:
    """Point on an edge at a share of its way."""
    chord = complex(end[0] - start[0], end[1] - start[1])
    if not arc:
        way = chord * share
    else:
        turn = complex(cos(arc), sin(arc)) - 1
        way = chord * (complex(cos(arc * share), sin(arc * share)) - 1) / turn
    return start[0] + way.real, start[1] + way.imag


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(("count", "size"), [(2, 9), (3, 8), (5, 5), (8, 4)])
def test_walls_between_chambers_and_around_the_axis(shape, count, size) -> None:
    section = ChamberSection(shape=shape, count=count, size=float(size), reach=10.5, web=1.0)
    between, nearest, room = shortest(section)
    assert section.between == pytest.approx(between, abs=0.02)
    assert section.nearest == pytest.approx(nearest, abs=0.02)
    assert section.room <= room + 1e-9
    assert section.room == pytest.approx(room, rel=0.1)


def test_ends_inlets_and_bore() -> None:
    plain = OmnidirectionalActuator()
    whole = OmnidirectionalActuator(inlet_diameter=2 * mm, clamp_length=10 * mm, bore_radius=1 * mm)
    duct = pi * (10 + 5)
    for name in ("cavity_1", "cavity_2", "cavity_3"):
        assert (whole.cavity_volumes[name] - plain.cavity_volumes[name]) * 1e9 == pytest.approx(duct)
    added = pi * 12.5**2 * 10 - 3 * duct - pi * 70
    assert (whole.solid_volume - plain.solid_volume) * 1e9 == pytest.approx(added)
    of_plain, of_whole = areas(plain.build()), areas(whole.build())
    assert [of_plain["fixed"], of_plain["tip"]] == pytest.approx([pi * 12.5**2] * 2)
    assert of_whole["tip"] == pytest.approx(pi * (12.5**2 - 1))
    assert of_whole["fixed"] == pytest.approx(pi * (12.5**2 - 1 - 3) + 10 * 2 * pi * 12.5)
    assert of_whole["outside"] - of_plain["outside"] == pytest.approx(70 * 2 * pi)  # the bore
    assert of_whole["cavity_2"] - of_plain["cavity_2"] == pytest.approx(15 * 2 * pi - pi)


@pytest.mark.parametrize("shape", SHAPES)
def test_each_inlet_ends_in_its_own_chamber(shape) -> None:
    actuator = OmnidirectionalActuator(chambers=4, chamber_shape=shape, chamber_size=5 * mm, inlet_diameter=1 * mm)
    places = {"cavity_1": (0, 1), "cavity_2": (-1, 0), "cavity_3": (0, -1), "cavity_4": (1, 0)}
    ducts = [face for face in actuator.build().shape.faces if face.name in places and face.center.x < 5]
    assert {face.name for face in ducts} == set(places)
    for face in ducts:
        y, z = places[face.name]
        assert y * face.center.y + z * face.center.z > 5


def test_the_thinnest_wall() -> None:
    assert OmnidirectionalActuator().smallest_wall == pytest.approx(2 * mm)
    between = 2 * (6 * sin(pi / 3) - 4.5) * mm
    assert OmnidirectionalActuator(chamber_size=9 * mm).smallest_wall == pytest.approx(between)
    assert OmnidirectionalActuator(bore_radius=1.5 * mm).smallest_wall == pytest.approx(1 * mm)
    ring = OmnidirectionalActuator(chamber_shape="ring_sector", web=1.2 * mm)
    assert ring.smallest_wall == pytest.approx(1.2 * mm)


@pytest.mark.parametrize("shape", SHAPES)
def test_the_largest_chambers_can_be_built(shape) -> None:
    with refused("chamber_size", "30 mm", "3 chambers") as caught:
        OmnidirectionalActuator(chamber_shape=shape, chamber_size=30 * mm, bore_radius=1 * mm)
    largest = float(str(caught.value).split(" mm to ")[1].split()[0])
    OmnidirectionalActuator(chamber_shape=shape, chamber_size=largest * mm, bore_radius=1 * mm).build()
    with refused("chamber_size", f"0.01 mm to {largest:.10g} mm"):
        OmnidirectionalActuator(chamber_shape=shape, chamber_size=(largest + 0.002) * mm, bore_radius=1 * mm)


@pytest.mark.parametrize(
    ("wrong", "facts"),
    [
        ({"chambers": 9}, ("chambers", 9, "2 to 8")),
        ({"chamber_shape": "ringsector"}, ("chamber_shape", "ringsector", "ring_sector")),
        ({"chamber_size": 12 * mm}, ("chamber_size", "12 mm", "0.01 mm to 9.74 mm", "3 chambers")),
        ({"bore_radius": 3 * mm}, ("chamber_size", "8 mm", "0.01 mm to 7.49 mm", "3 chambers")),
        ({"bore_radius": 13 * mm}, ("bore_radius", "13 mm", "0.01 mm to 12.46 mm")),
        ({"wall": 13 * mm}, ("wall", "13 mm", "0.01 mm to 12.47 mm")),
        ({"cap": 30 * mm}, ("cap", "30 mm", "0.01 mm to 29.995 mm", "60 mm")),
        ({"length": 60.0}, ("length", "60000 mm", "1 mm to 2000 mm", "unit")),
        ({"clamp_length": -1 * mm}, ("clamp_length", "-1 mm", "0.01 mm to 1000 mm")),
        ({"inlet_diameter": 9 * mm}, ("inlet_diameter", "9 mm", "0.01 mm to 7.98 mm")),
        ({"chamber_shape": "ring_sector", "web": 19 * mm}, ("web", "19 mm", "0.01 mm to 18.169 mm", "3 ring sectors")),
        ({"symmetric": "yes"}, ("symmetric", "yes", "True or False")),
    ],
)  # fmt: skip
def test_dimensions_that_cannot_be_are_refused(wrong, facts) -> None:
    with refused(*facts):
        OmnidirectionalActuator(**wrong)


@pytest.mark.parametrize("shape", SHAPES)
def test_each_shape_meshes_coarsely(shape) -> None:
    assert_meshes(OmnidirectionalActuator(chamber_shape=shape, length=30 * mm, symmetric=True), size=5 * mm)
