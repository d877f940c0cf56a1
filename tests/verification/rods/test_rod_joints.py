"""Chambers, rods in series and in parallel, and contact with planes against closed forms.

Problems and exact answers: (a) a pressure in an eccentric chamber: stretch P A / EA, curvature P A z / EI, a circle.
(b) a rod cut into three of different elements is the same rod. (c) three rods between two plates, a small pressure in
one: as one rod with the bending stiffness EI + EA z². (d) a cantilever of which the tip rests on a plane: the force of
the plane. (e) a long one that lies down: it lifts off over (72 EI d / q)^(1/4), and the clamp carries 2/3 of the weight
of this piece. (f) a hanging rod: stretch by its weight. (d) and (e) are linear theory, for a drop of 1/1000 and less.
Tolerance: round-off for (a), 1e-6 for (b), 1e-3 for (c) and (d), one element for (e).
"""

import numpy as np
import pytest
from rod_cases import slender
from turgor.loads import Gravity
from turgor.obstacles import Plane
from turgor.rods import (
    ChamberPressure,
    LineLoad,
    Place,
    PlateForce,
    PressureTable,
    Rod,
    RodChamber,
    RodModel,
    RodSection,
    static,
)

STIFFNESS = np.diag([100.0, 30.0, 30.0, 1e-3, 2e-3, 2e-3])


def test_pressure_in_a_chamber(record_verification):
    section = RodSection(stiffness=STIFFNESS, chambers=(RodChamber(area=1e-4, offset=(0.0, 4e-3)),))
    solution = static(RodModel(rods=[Rod(section=section, length=0.1)], loads=[ChamberPressure(pressure=50e3)]))
    shape, expected = solution.shape(), [1 + 5.0 / 100, 0, 0, 0, 5.0 * 4e-3 / 2e-3, 0]
    record_verification("eccentric chamber: strains", "exact", expected, shape.strain[7], "1e-10")
    assert shape.strain == pytest.approx(np.tile(expected, (16, 1)), abs=1e-10)
    assert np.abs(shape.force).max() < 1e-10, "nothing else pulls"
    assert shape.wall_force[3] == pytest.approx([5.0, 0, 0, 0, 0.02, 0], abs=1e-10)
    assert solution.response()["curvature"][-1] == pytest.approx(10.0 / 1.05)


def test_a_table_says_the_same(record_verification):
    table = PressureTable(pressure=[0, 20e3, 50e3], strain=[[0] * 6, [0.02, 0, 0, 0, 4, 0], [0.05, 0, 0, 0, 10, 0]])
    tips = []
    for chamber in (RodChamber(area=1e-4, offset=(0.0, 4e-3)), RodChamber(table=table)):
        section = RodSection(stiffness=STIFFNESS, chambers=(chamber,))
        loads = [ChamberPressure(pressure=50e3), PlateForce(force=(0, 0.1, 0.2))]
        tips.append(static(RodModel(rods=[Rod(section=section, length=0.1)], loads=loads), at=5).tip)
    record_verification("chamber with a table: tip", "the same problem", tips[0][-1], tips[1][-1], "1e-9")
    assert tips[1] == pytest.approx(tips[0], abs=1e-9)


def test_rods_in_series(record_verification):
    loads = [PlateForce(plate="tip", force=(0, 3.0, 2.0)), LineLoad(force=(1.0, 0, 4.0))]
    whole = static(RodModel(rods=[Rod(section=slender(), length=1.0, elements=40)], loads=loads)).tip[-1]
    pieces = [
        Rod(name="a", section=slender(), length=0.5, elements=20, end="1"),
        Rod(name="b", section=slender(), length=0.3, elements=16, start="1", end="2"),
        Rod(name="c", section=slender(), length=0.2, elements=8, start="2"),
    ]
    cut = static(RodModel(rods=pieces, loads=loads)).tip[-1]
    record_verification("three rods in series as one: tip", "the same problem", whole, cut, "1e-6")
    assert cut == pytest.approx(whole, abs=1e-6)


def test_rods_in_parallel(record_verification):
    offset, area, pressure = 20e-3, 1e-4, 10.0
    rods = []
    for name, height in (("upper", offset), ("middle", 0.0), ("lower", -offset)):
        place = Place(position=(0, 0, height))
        section = RodSection(stiffness=STIFFNESS, chambers=(RodChamber(area=area),))
        rods.append(Rod(name=name, section=section, length=0.1, start_at=place, end_at=place))
    solution = static(RodModel(rods=rods, loads=[ChamberPressure(pressure=pressure, rod="upper")]))
    expected = pressure * area * offset * 0.1 / (3 * 2e-3 + 2 * 100 * offset**2)
    angle = solution.response()["bending_angle"][-1]
    record_verification("three rods in parallel, pressure in one: angle", "linear theory", expected, angle, "1e-3")
    assert angle == pytest.approx(expected, rel=1e-3)
    assert solution.tip[-1, 0] - 0.1 == pytest.approx(pressure * area / 300 * 0.1, rel=1e-3)


def test_tip_rests_on_a_plane(record_verification):
    drop, load = 1e-3, 20e-3
    plane = Plane(point=(0, 0, -drop), normal=(0, 0, 1))
    rod = Rod(section=slender(), length=1.0)
    solution = static(RodModel(rods=[rod], loads=[LineLoad(force=(0, 0, -load))], planes=[plane]))
    expected = 3 * (load / 8 - drop)
    force = solution.states[-1].contact[0]
    record_verification("tip on a plane: force of the plane", "linear theory", expected, force[-1], "1e-3")
    assert force[-1] == pytest.approx(expected, rel=1e-3)
    assert np.abs(force[:-1]).max() == 0
    assert solution.tip[-1, 2] == pytest.approx(-drop, abs=1e-9)


def test_a_long_rod_lies_down(record_verification):
    drop, load, elements = 1e-3, 2.0, 64
    plane = Plane(point=(0, 0, -drop), normal=(0, 0, 1))
    rod = Rod(section=slender(), length=1.0, elements=elements)
    solution = static(RodModel(rods=[rod], loads=[LineLoad(force=(0, 0, -load))], planes=[plane]))
    free = (72 * drop / load) ** 0.25
    shape, force = solution.shape(), solution.states[-1].contact[0]
    first = shape.arc[1:][force > 0][0]
    carried = solution.reaction("base")[2]
    record_verification(
        "rod that lies down: where it touches, force of the clamp", "linear theory",
        (free, 2 / 3 * load * free), (first, carried), "an element, 2 %",
    )  # fmt: skip
    assert first == pytest.approx(free, abs=1 / elements)
    assert carried == pytest.approx(2 / 3 * load * free, rel=0.02)
    assert carried + force.sum() == pytest.approx(load, rel=1e-9)
    assert shape.position[:, 2].min() > -drop - 1e-9


def test_hanging_rod_stretches(record_verification):
    section = RodSection.from_moduli(EA=10.0, GA=10.0, EI=1.0, GJ=1.0, mass_per_length=0.2)
    solution = static(RodModel(rods=[Rod(section=section, length=1.0)], loads=[Gravity((1, 0, 0), 10.0)]))
    expected = 0.2 * 10 / (2 * 10)
    record_verification("hanging rod: how far its end sinks", "exact", expected, solution.tip[-1, 0] - 1, "1e-3")
    assert solution.tip[-1, 0] - 1 == pytest.approx(expected, rel=1e-3)
    assert solution.reaction("base")[0] == pytest.approx(-2.0)
