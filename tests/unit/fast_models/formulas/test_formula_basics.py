"""Formulas: assumptions in docstring and data, families, findings, errors, and that responses behave like others."""

import inspect
from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.fast_models.formulas.catalog import FORMULAS
from turgor.foundation.response import Column
from turgor.units import deg, kPa, mm

F = tg.formulas
RUBBER = tg.Material(name="test rubber", law=tg.laws.NeoHooke(C10=0.12e6))
THREAD = tg.Material(name="thread", law=tg.laws.Hooke(E=31067e6, nu=0.36))
FINGER = tg.actuators.FiberReinforcedBender()


def threads(angle, hand="right"):
    winding = tg.Winding(angle_from_axis=angle * deg, spacing=2 * mm, hand=hand)
    return tg.Fibers(face="outside", material=THREAD, diameter=0.1778 * mm, winding=winding)


#: Threads along the axis that resist a push, as stiff rods would; a tube that gets shorter pushes them.
PUSHED = replace(threads(0), compression=1.0)


def codes(response):
    return {finding.code for finding in response.findings}


@pytest.mark.parametrize("about", FORMULAS, ids=lambda about: about.name)
def test_the_docstring_states_the_assumptions(about):
    text = " ".join((inspect.getdoc(getattr(F, about.name)) or "").split())
    assert f"Assumptions: {' '.join(about.assumptions)}" in text
    assert F.about(about.name) is about
    assert set(about.families) <= set(dir(tg.actuators))


def test_every_formula_takes_its_families_and_no_other():
    calls = {
        "constant_curvature": lambda part: F.constant_curvature(part, _angles()),
        "euler_bernoulli": lambda part: F.euler_bernoulli(part, RUBBER, 1 * kPa),
        "fiber_reinforced_bender": lambda part: F.fiber_reinforced_bender(part, RUBBER, 1 * kPa),
        "thick_tube": lambda part: F.thick_tube(part, RUBBER, 1 * kPa),
        "wound_tube": lambda part: F.wound_tube(part, RUBBER, threads(60, "both"), [1 * kPa]),
        "ideal_mckibben": lambda part: F.ideal_mckibben(part, threads(25, "both"), 1 * kPa),
        "mckibben": lambda part: F.mckibben(part, RUBBER, threads(25, "both"), [1 * kPa]),
        "castigliano_bellows": lambda part: F.castigliano_bellows(part, RUBBER, 1 * kPa),
    }
    assert set(calls) == {about.name for about in FORMULAS if about.families}
    for name, call in calls.items():
        about = F.about(name)
        for family in about.families:
            part = getattr(tg.actuators, family)()
            response = call(part)
            assert isinstance(response, tg.Response)
            assert name in response.source.text
            assert about in F.formulas_for(part)
        with refused(name, *about.families, "FastPneuNet"):
            call(tg.FastPneuNet())


def _angles():
    return tg.Response(columns=(Column("bending_angle", "deg", [0.0, 1.0]),), source=tg.laws.Source(text="a ruler"))


def test_a_number_is_a_path_and_a_list_stays():
    tube = tg.actuators.ExtendingCylinder()
    path = F.thick_tube(tube, RUBBER, 20 * kPa)
    assert path["pressure_kPa"] == pytest.approx(np.linspace(0, 20, 21))
    assert len(F.thick_tube(tube, RUBBER, [5 * kPa, 20 * kPa])) == 2
    assert path.plot("cavity_volume").axes[0].get_ylabel() == "cavity volume [mL]"


def test_findings_travel_with_a_saved_response(tmp_path):
    response = F.euler_bernoulli(tg.actuators.EccentricBender(), RUBBER, 1 * kPa)
    assert codes(response) == {"F02"}
    assert tg.Response.load(response.save(tmp_path / "bent")).findings == response.findings


@pytest.mark.parametrize(
    ("material", "words"),
    [
        ({"bulk_modulus": 5e6}, "compressible"),
        ({"viscoelasticity": tg.laws.Prony(g=(0.2,), tau=(1.0,), moduli="long_term")}, "relaxes"),
        ({"stress_softening": tg.laws.Mullins(r=1.5, m=1e4, beta=0.1)}, "softens"),
        ({"permanent_set": tg.laws.PermanentSet(stress=1e6, exponent=2.0)}, "keeps a permanent set"),
    ],
)
def test_what_the_material_does_besides_is_said(material, words):
    more = tg.Material(name="silicone", law=RUBBER.law, **material)
    (finding,) = (each for each in F.thick_tube(tg.actuators.ExtendingCylinder(), more, 1 * kPa).findings)
    assert finding.code == "F01"
    assert words in finding.message


def test_findings_where_assumptions_fail():
    tested = tg.Material(name="tested", law=RUBBER.law, stretch_range=(1.0, 1.2))
    tube = tg.actuators.ExtendingCylinder()
    assert "M01" in codes(F.thick_tube(tube, tested, inner_stretch=1.5))
    assert codes(F.thick_tube(tube, tested, inner_stretch=1.2)) == set()
    assert "F05" in codes(F.thick_tube(tg.actuators.ExtendingCylinder(length=40 * mm), RUBBER, 1 * kPa))
    assert "F03" in codes(F.euler_bernoulli(FINGER, RUBBER, 100 * kPa))
    assert codes(F.euler_bernoulli(FINGER, RUBBER, 1 * kPa)) == set()
    assert "F08" in codes(F.fiber_reinforced_bender(FINGER, RUBBER, 20 * kPa))
    assert "F10" in codes(F.fiber_reinforced_bender(tg.actuators.FiberReinforcedBender(length=1.0), RUBBER, 90 * kPa))
    assert "F04" not in codes(F.wound_tube(tube, RUBBER, threads(55), [20 * kPa]))
    assert "F04" in codes(F.wound_tube(tube, RUBBER, [threads(30, "both"), PUSHED], [20 * kPa]))
    assert {"F06", "F12"} <= codes(F.castigliano_bellows(tg.actuators.BellowsOfRevolution(), RUBBER, 10.0))
    assert "F09" in codes(F.ideal_mckibben(tg.actuators.ContractingTube(), threads(25, "both"), 1 * kPa))


def test_bad_input_names_field_and_value():
    tube, muscle = tg.actuators.ExtendingCylinder(), tg.actuators.ContractingTube()
    stiff = tg.Material(name="paper", law=tg.laws.Hooke(E=1e9, nu=0.3))
    hoops = replace(threads(90), winding=tg.Winding(angle_from_axis=90 * deg, starts=3))
    cases = [
        (lambda: F.thick_tube(tube, RUBBER), ["pressure", "inner_stretch"]),
        (lambda: F.thick_tube(tube, RUBBER, -1.0), ["pressure", -1, "0 or more"]),
        (lambda: F.thick_tube(tube, RUBBER, inner_stretch=0.9), ["inner_stretch", 0.9, "1 or more"]),
        (lambda: F.thick_tube(tube, RUBBER, 1e3, ends="clsed"), ["ends", "'clsed'", "'closed'"]),
        (lambda: F.thick_tube(tube, stiff, 1e3), ["'paper'", "Hooke", "NeoHooke"]),
        (lambda: F.wound_tube(tube, RUBBER, threads(60), [1e3], wall="thik"), ["wall", "'thik'", "'thick'"]),
        (lambda: F.wound_tube(tube, RUBBER, threads(60), [2e3, 1e3]), ["pressure", "2 to 1 kPa"]),
        (lambda: F.wound_tube(tube, RUBBER, [threads(90), threads(0)], [1e3], inextensible=True), ["2 directions"]),
        (lambda: F.wound_tube(tube, RUBBER, [hoops], [1e3]), ["starts", 3, "spacing"]),
        (lambda: F.ideal_mckibben(muscle, threads(25), 1e3), ["hand", "'right'", "'both'"]),
        (lambda: F.ideal_mckibben(muscle, threads(25, "both"), 1e3, -0.2), ["contraction", -0.2, -0.1034]),
        (lambda: F.mckibben(muscle, RUBBER, threads(25, "both"), [1e3], [0.1, 0.2]), ["[0.1, 0.2]", "1 pressures"]),
        (lambda: F.mckibben(muscle, RUBBER, threads(25, "both"), [1e3], -0.2), ["contraction", -0.2, "25 deg"]),
        (lambda: F.euler_bernoulli(FINGER, {"skin": RUBBER}, 1e3), ["'body'", "skin"]),
        (lambda: F.fiber_reinforced_bender(FINGER, RUBBER, 1e8), ["pressure", "100000 kPa", "1485 kPa", "6 times"]),
        (
            lambda: F.castigliano_bellows(tg.actuators.ParallelBellows(), RUBBER, 1.0, shares=(1, 0)),
            ["(1, 0)", "three"],
        ),
        (lambda: F.HollowSphere(inner_radius=-1 * mm, wall=1 * mm), ["inner_radius", "-1 mm", "0.01 mm to 1000 mm"]),
        (lambda: F.about("thick_tub"), ["formula", "'thick_tub'", "'thick_tube'"]),
    ]
    for call, facts in cases:
        with refused(*facts):
            call()


def test_a_law_that_locks_is_followed_until_there():
    gent = tg.Material(name="Gent", law=tg.laws.Gent(mu=0.24e6, Jm=10.0))
    sphere = F.HollowSphere(inner_radius=10 * mm, wall=5 * mm)
    path = F.thick_sphere(sphere, gent, inner_stretch=1.5)
    assert np.isfinite(path["pressure"]).all()
    with refused("pressure", "50000 kPa", "345.3 kPa", "1.35 times"):
        F.thick_sphere(sphere, tg.Material(name="Gent", law=tg.laws.Gent(mu=0.24e6, Jm=1.0)), 50e6)


def test_constants_that_numpy_computed_are_taken():
    rubber = tg.Material(name="computed", law=tg.laws.NeoHooke(C10=np.float64(0.12e6)), bulk_modulus=np.float64(1e9))
    tube = tg.actuators.ExtendingCylinder()
    assert F.thick_tube(tube, rubber, [10 * kPa])["pressure"][0] == pytest.approx(10 * kPa)
