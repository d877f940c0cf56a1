"""Windings: values that cannot be are refused with a sentence, and what is laid otherwise than asked is said."""

from dataclasses import replace
from math import acos, pi

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.fibers.smeared import course_of
from turgor.core.geometry.actuators.fiber_reinforced_cylinder import FiberReinforcedCylinder
from turgor.core.materials.laws.laws import Hooke, NeoHooke
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.solvers.checks.fibers import check_fibers
from turgor.core.solvers.outcomes import stuck
from turgor.core.solvers.solution import State, Step
from turgor.units import deg, kPa, mm

KEVLAR = tg.Material(name="kevlar", law=Hooke(E=31067e6, nu=0.36))
RUBBER = tg.Material(name="rubber", law=NeoHooke(C10=0.12e6))
WINDING = Winding(angle_from_axis=60 * deg, spacing=2 * mm)
FIBERS = {"face": "outside", "material": KEVLAR, "diameter": 0.1778 * mm, "winding": WINDING}


@pytest.fixture(scope="module")
def tube():
    return tg.mesh(FiberReinforcedCylinder(length=40 * mm, symmetric=False).build(), size=7 * mm, cells="hexahedra")


@pytest.mark.parametrize(
    ("field", "value", "facts"),
    [
        ("angle_from_axis", "60 deg", ("angle_from_axis", "60 deg")),
        ("spacing", "2 mm", ("spacing", "2 mm")),
        ("spacing", True, ("spacing", "True")),
        ("hand", 3, ("hand", "'3'", "left, right")),
        ("axis", "x", ("axis", "'x'", "(1, 0, 0)")),
        ("axis", (0, 0, 0), ("axis", "(0, 0, 0)", "(1, 0, 0)")),
        ("axis", (1, 0), ("axis", "(1, 0)", "(1, 0, 0)")),
    ],
)
def test_a_winding_refuses_what_it_cannot_be(field, value, facts):
    with refused(*facts):
        replace(WINDING, **{field: value})


@pytest.mark.parametrize(
    ("field", "value", "facts"),
    [
        ("face", (), ("face is ()", "'outside'")),
        ("face", 3, ("face is 3", "'outside'")),
        ("face", ("tip", 3), ("face is ('tip', 3)", "'outside'")),
        ("face", ["outside", "outside"], ("fiber face", "['outside', 'outside']", "twice")),
        ("within", 3, ("within is 3", "two corners")),
        ("within", ((0, 0, 0),), ("within is ((0, 0, 0),)", "two corners")),
        ("within", ((0, 0), (1, 1)), ("within is ((0, 0), (1, 1))", "two corners")),
        ("within", (("a", 0, 0), (1, 1, 1)), ("within is (('a', 0, 0), (1, 1, 1))", "two corners")),
        ("within", ((0, 0, 0), (np.nan, 1, 1)), ("within is ((0, 0, 0), (nan, 1, 1))", "two corners")),
        ("diameter", "2 mm", ("diameter", "'2 mm'", "0.2*mm")),
        ("compression", "1", ("compression", "'1'", "a number")),
        ("material", 3, ("'outside'", "'3'", "NoneType", "Hooke")),
        ("material", RUBBER, ("'outside'", "'rubber'", "NeoHooke", "Hooke")),
        ("winding", None, ("'outside'", "winding is None", "Winding")),
        ("form", 3, ("form", "'3'", "discrete, smeared")),
    ],
)
def test_fibers_refuse_what_they_cannot_be(field, value, facts):
    with refused(*facts):
        Fibers(**(FIBERS | {field: value}))


def checked(tube, *, EA=800.0, form="smeared", within=None, compression=0.0, **winding):
    """The findings about a winding of the tube, and its model."""
    material = tg.Material(name="thread", law=Hooke(E=EA / (pi * (0.5 * mm) ** 2 / 4), nu=0.36))
    fibers = Fibers(
        face="outside", material=material, diameter=0.5 * mm, form=form, within=within, compression=compression,
        winding=Winding(**winding),
    )  # fmt: skip
    model = tg.Model(
        tube, {"body": RUBBER}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 10 * kPa)], reinforcements=(fibers,)
    )
    return {finding.code: finding for finding in check_fibers(model)}, model


def test_threads_that_lie_farther_apart_than_asked_are_told_with_the_angle_that_fits(tube):
    asked = {"form": "discrete", "spacing": 2 * mm}
    result, model = checked(tube, angle_from_axis=87 * deg, **asked)
    assert result["B21"].severity == "warning"
    assert "Threads on outside are 2.746 mm apart instead of 2 mm: their number is whole." in str(result["B21"])
    perimeter = course_of(tube, model.reinforcements[0]).perimeter
    angle = float(str(result["B21"]).split("angle_from_axis = ")[1].split(" deg")[0])
    assert angle == pytest.approx(acos(2 * mm / perimeter) / deg, abs=0.01)
    assert "B21" not in checked(tube, angle_from_axis=angle * deg, **asked)[0]
    assert "B21" not in checked(tube, angle_from_axis=60 * deg, **asked)[0]
    assert "B21" not in checked(tube, angle_from_axis=87 * deg, spacing=2 * mm)[0]  # smeared threads are as asked
    assert checked(tube, angle_from_axis=90 * deg, form="discrete", spacing=3 * mm)[0]["B21"].severity == "note"


def test_a_spacing_that_contradicts_the_pitch_is_refused(tube):
    with refused("spacing", "3 mm", "pitch of 4 mm", "3.988 mm"):
        checked(tube, pitch=4 * mm, spacing=3 * mm)
    with refused("spacing", "9 mm", "10 turns", "3.988 mm"):
        checked(tube, turns=10, spacing=9 * mm)
    assert not checked(tube, pitch=4 * mm, spacing=2 * mm)[0]  # two threads


def test_nearly_hoops_of_both_hands_are_told_to_count_twice(tube):
    assert "are twice as stiff as one" in str(checked(tube, pitch=4 * mm, starts=1, hand="both")[0]["B22"])
    for other in ({"pitch": 4 * mm, "starts": 1}, {"angle_from_circumference": 0.0, "spacing": 4 * mm, "hand": "both"}):
        assert "B22" not in checked(tube, **other)[0]


@pytest.mark.parametrize("form", ["smeared", "discrete"])
def test_a_box_beside_the_face_is_refused_before_the_solve(tube, form):
    with refused("outside", "(1000, 0, 0) to (2000, 1000, 1000) mm"):
        checked(tube, form=form, angle_from_axis=60 * deg, spacing=3 * mm, within=((1, 0, 0), (2, 1, 1)))


def test_threads_too_stiff_to_become_slack_are_told_before_and_after_the_solve(tube):
    hoops = {"angle_from_axis": 90 * deg, "spacing": 2 * mm}
    assert "B23" not in checked(tube, EA=1e4, **hoops)[0]
    assert "B23" not in checked(tube, EA=1e6, compression=1.0, **hoops)[0]
    result, model = checked(tube, EA=5e4, **hoops)
    assert "(E A = 5e+04 N) are about 44,000 times as stiff as the wall" in str(result["B23"])
    assert "Give them compression = 1 if they stay tight everywhere" in str(result["B23"])
    at_rest = np.zeros_like(tube.points)
    rest = State(
        model=model, load_factor=0.0, displacement=at_rest, mean_stress=np.zeros(tube.vertex_count), nodal_force=at_rest
    )
    step = Step(load_factor=0.1, increment=2.6e-4, iterations=15, residual=1.0, accepted=False, seconds=0.1)
    outcome = stuck(model, [rest], [step], lost_stability=False)
    assert "Fibers are so stiff that it was not found which of them are slack." in outcome.message
    assert outcome.advice.startswith("Give them compression = 1 if they stay tight everywhere")
