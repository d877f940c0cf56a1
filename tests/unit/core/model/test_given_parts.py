"""What scripts plausibly give to the public names: the plain forms are taken, the others are answered in a sentence."""

from dataclasses import replace

import numpy as np
import pytest
import solver_cases

import turgor as tg
from refused import refused
from turgor.units import kPa, mL, mm

MESH = solver_cases.bar()
LAW = tg.laws.NeoHooke(C10=0.1e6)
RUBBER = tg.Material(name="rubber", law=LAW)
PAPER = tg.laws.Hooke(E=1e9, nu=0.3)
FIXED = (tg.Fixed("fixed"),)
PUSH = tg.Traction("top", (0, 0, 1e3))
FINGER = tg.FastPneuNet(chambers=1, length=10 * mm)


def model(materials=RUBBER, supports=FIXED, loads=(PUSH,), **more) -> tg.Model:
    return tg.Model(MESH, materials, supports, loads, **more)


def same(one: tg.Model, other: tg.Model) -> bool:
    return (one.supports, one.loads) == (other.supports, other.loads) and one.region_materials["body"].law == LAW


@pytest.mark.parametrize(
    "made",
    [
        lambda: model(supports="fixed"),
        lambda: model(supports=["fixed"]),
        lambda: model(supports=tg.Fixed("fixed")),
        lambda: model(loads=PUSH),
        lambda: model(materials={"body": LAW}),
        lambda: model(materials=LAW),
        lambda: model(materials={"body": tg.laws.NeoHooke(C10="0.1 MPa")}),
        lambda: model(materials={"body": tg.laws.NeoHooke(C10=np.array(1e5))}),
        lambda: model(loads=tg.Traction("top", ["0 Pa", 0, "1 kPa"])),
        lambda: model(loads=tg.Traction("top", np.array([0, 0, 1e3]))),
    ],
)
def test_plain_forms_say_the_same(made):
    assert same(made(), model())


def test_plain_values_of_other_names():
    assert tg.Pressure("cavity", "5 kPa") == tg.Pressure("cavity", 5 * kPa)
    assert tg.VolumeControl(volume="5 mL").volume == 5 * mL
    assert tg.Dynamic(duration="2 s").duration == 2.0
    assert tg.Membrane(PAPER, "0.1 mm").thickness == 0.1 * mm
    assert tg.Membrane("kevlar-fiber", 0.1 * mm).material.law == tg.from_library("kevlar-fiber").law
    move = tg.Displacement("top", (0, 0, "1 mm"))
    assert np.array_equal(move.value(np.zeros((1, 3)), 0.5), [[0, 0, 0.5 * mm]])
    assert tg.mesh(FINGER, size="5 mm").unknown_count == tg.mesh(FINGER.build(), size=5 * mm).unknown_count


def ranged(stretches):
    """A rubber that was fitted to some stretches."""
    return tg.Material(name="x", law=tg.laws.NeoHooke(C10=1e5), stretch_range=stretches)


def lost_node():
    """A mesh with a node that is nowhere."""
    points = MESH.points.copy()
    points[2, 0] = np.nan
    return replace(MESH, points=points)


REFUSED = [
    # (what the message states, made with)
    (
        ("pressure on 'cavity'", "shape (2,)", "in Pa", "'60 kPa'"),
        lambda: tg.Pressure("cavity", np.array([1, 2]) * kPa),
    ),
    (("pressure on 'cavity' is nan", "in Pa"), lambda: tg.Pressure("cavity", np.nan)),
    (("pressure on 'cavity'", "'5 mm'", "length"), lambda: tg.Pressure("cavity", "5 mm")),
    (("pressure on 'cavity' is True", "in Pa"), lambda: tg.Pressure("cavity", True)),
    (("5000.0", "a name", "'cavity'"), lambda: tg.Pressure(5 * kPa, "cavity")),
    (("traction on 'top' is nan", "in Pa"), lambda: tg.Traction("top", (0, 0, np.nan))),
    (("traction on 'top' is 1000.0", "three numbers"), lambda: tg.Traction("top", 1e3)),
    (("gravity", "direction", "zero vector"), lambda: tg.Gravity((0, 0, 0))),
    (("NeoHooke", "C10 is (1+2j)", "in Pa"), lambda: tg.laws.NeoHooke(C10=1 + 2j)),
    (("NeoHooke", "C10", "shape (2,)"), lambda: tg.laws.NeoHooke(C10=np.ones(2))),
    (("NeoHooke", "C10", "'0.11'", "unit"), lambda: tg.laws.NeoHooke(C10="0.11")),
    (("Ogden", "mu 1 is None", "in Pa"), lambda: tg.laws.Ogden(mu=[None], alpha=[2.0])),
    (("'x'", "stretch_range is 2.0", "above 0"), lambda: ranged(2.0)),
    (("'x'", "stretch_range is (2, 1)", "above 0"), lambda: ranged((2, 1))),
    (("'x'", "stretch_range is 'a'", "a finite number"), lambda: ranged((1, "a"))),
    (("node 2", "[nan, "), lost_node),
    ((f"node {len(MESH.points)}", f"0..{len(MESH.points) - 1}"), lambda: replace(MESH, cells=MESH.cells + 1)),
    (("'x'", "law is 100000.0"), lambda: tg.Material(name="x", law=1e5)),
    (("membrane is 100000.0", "Material"), lambda: tg.Membrane(1e5, 0.1 * mm)),
    (("'fixed'", "directions is 'ab'"), lambda: tg.Fixed("fixed", "ab")),
    (("support", "['fixed']", "a name"), lambda: tg.Fixed(["fixed"])),
    (("a Traction", "supports"), lambda: model(supports=[PUSH])),
    (("'top'", "loads"), lambda: model(loads=["top"])),
    (("loads is 5",), lambda: model(loads=5)),
    (("materials.body", "'elastosil-m4601'"), lambda: model({"body": "elastosil-m4601"})),
    (("materials.body", "'elastosil'", "'elastosil-m4601'"), lambda: model({"body": "elastosil"})),
    (("materials.body", "class Yeoh", "Material"), lambda: model({"body": tg.Yeoh})),
    (("materials is [1]", "Material"), lambda: model([1])),
    (("contact is ['plate']",), lambda: model(contact=["plate"])),
    (("mesh", "a FastPneuNet", "a Mesh"), lambda: tg.Model(FINGER, RUBBER, "fixed", PUSH)),
    (("geometry is a Mesh", "an actuator"), lambda: tg.mesh(MESH)),
    (("geometry", "class FastPneuNet"), lambda: tg.mesh(tg.FastPneuNet)),
    (("geometry is 'part.step'",), lambda: tg.mesh("part.step")),
    (("mesh size", "'3'", "unit"), lambda: tg.mesh(FINGER, size="3")),
    (("model is a Mesh", "a Model"), lambda: tg.solve(MESH)),
    (("procedure", "class Static", "Static()"), lambda: tg.solve(model(), tg.Static)),
    (("procedure.max_step is 'a'", "a number"), lambda: tg.Static(max_step="a")),
    (("procedure.max_steps is 2.5", "whole number"), lambda: tg.Static(max_steps=2.5)),
    (("procedure.mass_ratio.cavity is [1]", "a number"), lambda: tg.GasMass(mass_ratio={"cavity": [1]})),
    (("options is 5", "EngineOptions"), lambda: tg.solve(model(), options=5)),
    (("stop is 5", "function"), lambda: tg.solve(model(), stop=5)),
    (("obstacles is 5", "Obstacle"), lambda: tg.Contact(obstacles=5)),
    (("obstacle 'a'", "shape is 5"), lambda: tg.obstacles.Obstacle(name="a", shape=5)),
    (("report", "a Model", "a Solution"), lambda: tg.report(model(), "x.html")),
    (("model is a Mesh", "a Model"), lambda: tg.natural_frequencies(MESH)),
    (("computed is a Model", "a Response"), lambda: tg.compare(model(), model())),
    (("solution is a Model", "a Solution", "solve(model)"), lambda: tg.measure(model())),
]


@pytest.mark.parametrize(("facts", "make"), REFUSED)
def test_anything_else_is_answered_in_a_sentence(facts, make):
    with refused(*facts):
        make()
