"""Rules of casting: what a mold and its rubber allow, before anything is computed."""

import pytest

import turgor as tg
from refused import refused
from turgor.studies.optimization.manufacture import core
from turgor.units import deg, mm

BASE = {"wall": 1 * mm, "gap": 1.5 * mm}


def finger(values):
    return tg.FastPneuNet(chambers=4, length=40 * mm, **values)


def broken(values, **casting):
    rules = tg.studies.casting_rules(finger, tg.studies.Casting(**casting))
    return [why for why in (rule.broken(values) for rule in rules) if why]


def test_a_finger_that_can_be_cast_breaks_no_rule():
    assert broken(BASE) == []


def test_walls_webs_and_cores_have_a_smallest_thickness():
    assert broken({**BASE, "wall": 0.9 * mm}) == ["walls of at least 1 mm"]
    assert broken({**BASE, "gap": 0.7 * mm}) == ["web of the mold of at least 0.8 mm"]
    assert broken({**BASE, "wall": 2 * mm}, smallest_pin=5 * mm) == ["core of at least 5 mm"]


def test_draft_makes_webs_thinner_at_their_end():
    # 12 mm deep: 2 · 12 mm · tan 1° = 0.42 mm
    assert broken(BASE, draft=1 * deg, smallest_web=1.05 * mm) == []
    (told,) = broken(BASE, draft=1 * deg, smallest_web=1.1 * mm)
    assert told == "web of the mold of at least 1.1 mm at its end, with a draft of 1 deg"


def test_webs_are_not_too_deep_for_their_thickness():
    assert broken(BASE, deepest=8.1) == []
    assert broken(BASE, deepest=7.9) == ["web of the mold at most 7.9 times as deep as thick"]


def test_dimensions_that_cannot_be_built_break_the_rules():
    told = broken({**BASE, "wall": 20 * mm})
    assert len(told) == 5 and "wall is 20 mm; allowed is" in told[0]


@pytest.mark.parametrize("chambers", [1, 2, 3, 5])
@pytest.mark.parametrize("family", [tg.actuators.FastPneuNet, tg.actuators.SlowPneuNet])
def test_the_core_is_the_inside_of_a_chamber(family, chambers):
    actuator = family(chambers=chambers, length=chambers * 12 * mm, width=60 * mm)
    thickness, depth = core(actuator)
    channel = actuator.cavity_volumes["cavity"]  # of the half
    for wider in (1, 2):  # what the chambers add where they are wider is their section times the width
        more = family(chambers=chambers, length=chambers * 12 * mm, width=(60 + wider) * mm)
        section = (more.cavity_volumes["cavity"] - channel) / (wider * mm / 2)
        if chambers in (1, 2) or family is tg.actuators.SlowPneuNet:
            assert section == pytest.approx(chambers * thickness * depth)
        else:  # the outer ones have an end wall of 2 mm beside an inner wall of 1 mm
            assert section == pytest.approx((chambers * thickness + (chambers - 2) * mm) * depth)


def test_there_is_no_mold_for_other_families():
    def tube(values):
        return tg.actuators.ExtendingCylinder(wall=values["wall"])

    (first, *_) = tg.studies.casting_rules(tube)
    assert "there is no mold with webs and pins for ExtendingCylinder" in first.broken({"wall": 2 * mm})
    rules = tg.studies.casting_rules(tube, tg.studies.Casting(mold=False))
    assert [rule.broken({"wall": 2 * mm}) for rule in rules] == [""] * 5
    assert rules[0].broken({"wall": 0.5 * mm}) == "walls of at least 1 mm"


@pytest.mark.parametrize(
    ("given", "facts"),
    [
        ({"smallest_wall": -1.0}, ["smallest_wall", "-1000 mm", "0 mm to 100 mm"]),
        ({"draft": 1.0}, ["draft", "57.2958 deg", "0 deg to 30 deg"]),
        ({"deepest": 0.5}, ["deepest", 0.5, "1 or more"]),
    ],
)
def test_numbers_out_of_range_are_refused(given, facts):
    with refused(*facts):
        tg.studies.Casting(**given)
