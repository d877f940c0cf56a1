"""Magnitudes against the range of the field, one bad model for each row of the table; a sound model is silent."""

import re
from dataclasses import replace
from math import inf
from pathlib import Path

import numpy as np
import pytest
import results_cases as cases

from turgor.core.materials.laws.laws import ArrudaBoyce, Gent, Hooke, NeoHooke, Yeoh
from turgor.core.materials.material import Material
from turgor.core.model.contact import Contact
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.model.loads import Gravity, Pressure
from turgor.core.model.model import Model
from turgor.core.model.obstacles import Obstacle, Plane, Sphere
from turgor.core.model.sheets import Membrane
from turgor.core.model.supports import Fixed
from turgor.core.solvers.checks.early_findings import early_findings
from turgor.core.solvers.checks.plausibility.check import implausible
from turgor.core.solvers.checks.plausibility.question import Question
from turgor.core.solvers.checks.plausibility.table import ROWS
from turgor.core.solvers.procedures.sealed import Sealed
from turgor.core.solvers.procedures.stages import Stage, Stages
from turgor.core.solvers.procedures.static import Static
from turgor.core.solvers.procedures.volume_control import VolumeControl
from turgor.foundation.finding import Severity
from turgor.units import GPa, MPa, kPa, mL, mm

MESH = cases.body()
CLAMPED = Fixed("fixed")
KEVLAR = Material(name="Kevlar", law=Hooke(E=31 * GPa, nu=0.36))
GROUND = Obstacle(name="ground", shape=Plane(point=(0, 0, -1 * mm), normal=(0, 0, 1)))


def model(rubber=cases.RUBBER, loads=None, mesh=MESH, supports=(CLAMPED,), sheets=None, **more):
    pressed = [Pressure("cavity", 20 * kPa)] if loads is None else loads
    return Model(mesh, {"body": rubber, "base": rubber, **(sheets or {})}, supports, pressed, **more)


def rubber(law, **more):
    return Material(name="rubber", law=law, **more)


def scaled(factor):
    return replace(MESH, points=factor * MESH.points)


def sheet(law=KEVLAR.law, thickness=0.1 * mm):
    return {"fixed": Membrane(replace(KEVLAR, law=law), thickness)}


def ball(height):
    return Contact(obstacles=[Obstacle(name="ball", shape=Sphere(center=(0, 0, height), radius=0.01))])


def wound(**how):
    return (Fibers(face="outside", material=KEVLAR, diameter=how.pop("diameter", 0.2 * mm), winding=Winding(**how)),)


def found(question, procedure=None):
    return implausible(Question(model=question, procedure=procedure or Static()))


SOUND = model(
    rubber(NeoHooke(C10=0.12 * MPa), density=1130.0),
    [Pressure("cavity", 20 * kPa), Gravity()],
    reinforcements=wound(turns=20.0, spacing=2 * mm, hand="both"),
    contact=Contact(obstacles=[GROUND]),
    sheets=sheet(),
)

BAD = [
    ("P01", "modulus of a rubber is 96 Pa", model(rubber(NeoHooke(C10=48.0)))),
    ("P01", "modulus of a rubber is 96 GPa", model(rubber(NeoHooke(C10=48 * GPa)))),
    ("P01", "0.5 times its shear modulus: the Poisson's ratio", model(rubber(NeoHooke(C10=1e5), bulk_modulus=1e5))),
    ("P01", "locking stretch in uniaxial tension is 1.06", model(rubber(Gent(mu=2e5, Jm=0.01)))),
    ("P01", "locking stretch in uniaxial tension is 1.2", model(rubber(ArrudaBoyce(mu=2e5, locking_stretch=1.02)))),
    ("P01", "density of a rubber is 1.07 kg/m³", model(rubber(NeoHooke(C10=1e5), density=1.07))),
    ("P01", "sheet or thread is 6.5 kPa", model(sheets=sheet(Hooke(E=6.5e3, nu=0.2)))),
    ("P02", "gauge pressure is 22.5 MPa; usual is at most 2 MPa", model(loads=[Pressure("cavity", 22.5 * MPa)])),
    ("P02", "5 MPa: the ratio of pressure to Young's modulus", model(loads=[Pressure("cavity", 5 * MPa)])),
    ("P02", "20 Pa: the ratio of pressure to Young's modulus", model(loads=[Pressure("cavity", 20.0)])),
    ("P02", "acceleration is 1e+06 m/s²", model(rubber(NeoHooke(C10=1e5), density=1e3), [Gravity(acceleration=1e6)])),
    ("P03", "longest side is 40 m", model(mesh=scaled(1e3))),
    ("P03", "mean wall is", model(mesh=scaled(1e-3))),
    ("P03", "thickness of a sheet is 100 nm", model(sheets=sheet(thickness=1e-7))),
    ("P03", "diameter of a thread is 8 mm", model(reinforcements=wound(turns=1.0, spacing=10 * mm, diameter=8 * mm))),
    ("P04", "turns of a thread is 1e+06", model(reinforcements=wound(turns=1e6, spacing=2 * mm))),
    ("P05", "'ball', 1.01 m away", model(contact=ball(-1.02))),
]  # fmt: skip


def test_a_sound_model_is_silent():
    assert found(SOUND) == ()
    assert found(model(), VolumeControl(volume=0.5 * mL)) == ()


def test_metals_are_no_rubber():
    """A part of steel, alone or beside rubber, and a sheet of steel: their moduli and densities are usual."""
    law, bulk = NeoHooke(C10=40 * GPa), 175 * GPa
    steel = Material(name="steel", law=law, bulk_modulus=bulk, density=7850.0)
    rubber_too = {"body": cases.RUBBER, "base": steel}
    pressed = [Pressure("cavity", 20 * kPa)]
    assert found(model(steel)) == ()
    assert found(Model(MESH, rubber_too, [CLAMPED], pressed)) == ()
    foil = Membrane(Material(name="foil", law=Hooke(E=200 * GPa, nu=0.3), density=7850.0), 0.1 * mm)
    assert found(model(sheets={"fixed": foil})) == ()


@pytest.mark.parametrize(("code", "said", "bad"), BAD, ids=[said for _, said, _ in BAD])
def test_a_magnitude_outside_the_field_is_a_warning(code, said, bad):
    told = [each for each in found(bad) if said in each.message]
    assert [each.code for each in told] == [code]
    assert told[0].severity is Severity.WARNING
    assert told[0].advice


def test_what_is_impossible_is_an_error():
    there_and_back = Pressure("cavity", -500 * kPa, history=[(0, 0), (0.5, 1), (1, 0)])
    (below,) = [each for each in found(model(loads=[there_and_back])) if each.code == "L08"]
    assert below.severity is Severity.ERROR
    assert "the gauge pressure is -500 kPa; possible is at least -101 kPa (vacuum)" in below.message
    (drained,) = found(model(), VolumeControl(volume=-20 * mL))
    assert (drained.code, drained.severity) == ("L08", Severity.ERROR)


def test_numbers_of_the_procedure():
    (few,) = found(model(), Static(max_iterations=1))
    assert few.code == "P06"
    assert "procedure.max_iterations: the number of iterations is 1; usual is 4 to 1000" in few.message


def test_layers_of_paper_and_rigid_plates_are_no_rubber():
    paper = Material(name="paper", law=NeoHooke(C10=1.35 * GPa), bulk_modulus=3.6 * GPa)
    plate = Material(name="plate", law=NeoHooke(C10=50 * MPa))
    for stiff in (paper, plate):
        both = Model(MESH, {"body": cases.RUBBER, "base": stiff}, [Fixed("fixed")], [Pressure("cavity", 20 * kPa)])
        assert found(both) == ()
    (told,) = found(Model(MESH, {"body": plate, "base": plate}, [Fixed("fixed")], []))
    assert "the initial shear modulus of a rubber is 100 MPa" in told.message
    steel = Material(name="steel", law=NeoHooke(C10=480 * GPa))
    (told,) = found(Model(MESH, {"body": steel, "base": cases.RUBBER}, [Fixed("fixed")], []))
    assert "the initial shear modulus of a stiff part is 960 GPa" in told.message


def test_a_sealed_cavity_keeps_its_volume():
    assert found(model(loads=[]), Sealed()) == ()


def test_equal_materials_are_named_together():
    body, base = (Material(name=name, law=NeoHooke(C10=48.0)) for name in ("body", "base"))
    soft = Model(MESH, {"body": body, "base": base}, [Fixed("fixed")], [])
    (told,) = found(soft)
    assert told.message.startswith("Material 'body and base': ")


def test_the_obstacle_comes_nearer_along_its_path():
    far = Sphere(center=(20 * mm, 0, -1.0), radius=5 * mm)
    coming = Obstacle(name="ball", shape=far, path=[(0, (0, 0, 0)), (1, (0, 0, 0.99))])
    assert found(model(contact=Contact(obstacles=[coming]))) == ()


def test_everything_held_is_an_error():
    held = model(supports=[Fixed("fixed"), Fixed("outside"), Fixed("tip")])
    (told,) = [each for each in early_findings(held, Static()) if each.code == "B09"]
    assert told.severity is Severity.ERROR
    assert "(fixed, outside, tip): the actuator cannot move" in told.message
    assert not [each for each in early_findings(model(), Static()) if each.code == "B09"]


def early(code, **given):
    """Early findings of a code."""
    return [each for each in early_findings(model(**given), Static()) if each.code == code]


def test_pressure_on_a_cavity_that_is_held_moves_nothing():
    (told,) = early("B27", supports=[Fixed("fixed"), Fixed("cavity")])
    assert told.message == "The supports hold the whole surface of 'cavity': pressure in it moves nothing."
    assert not early("B27", supports=[Fixed("fixed"), Fixed("cavity", "z")])


def test_the_tip_held_instead_of_the_base():
    (told,) = early("B28", supports=[Fixed("tip")])
    assert "its displacement is 0 throughout" in told.message
    assert told.advice.startswith("Clamp fixed instead")
    assert not early("B28")
    assert not early("B28", supports=[Fixed("fixed"), Fixed("tip")])  # a blocked tip
    assert not early("B28", supports=[Fixed("tip"), Fixed("fixed", "z")])


def test_two_pressures_on_one_cavity_add_up():
    (told,) = early("L10", loads=[Pressure("cavity", 3e3), Pressure("cavity", 5e3)])
    assert told.message == "2 pressures act on 'cavity' (3 kPa, 5 kPa): they add up."
    assert not early("L10", loads=[Pressure("cavity", 3e3), Pressure("outside", 5e3)])


def test_early_findings_come_by_weight_and_once():
    bad = model(
        rubber(Yeoh(C10=1e5, C20=-2e4), density=1.0), [Pressure("cavity", -500 * kPa)],
        reinforcements=(replace(wound(turns=2.0, spacing=2 * mm)[0], compression=1.0),),
    )  # fmt: skip
    told = early_findings(bad, Stages([Stage("one", Static()), Stage("two", Static())]))
    assert [each.severity for each in told] == sorted((each.severity for each in told), key=list(Severity)[::-1].index)
    assert len(told) == len(set(told))
    assert [each.code for each in told] == ["L08", "M06", "P01", "B04"]


def test_every_row_is_read_and_stands_in_the_documents():
    text = (Path(__file__).parents[5] / "docs" / "findings.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([BDGLMNP]\d\d) \| (.+?) \| (.+?) \| (.+?) \|$", text, re.MULTILINE)
    assert rows == [(row.code, row.quantity, row.range_text, row.source) for row in ROWS]
    assert all(row.low < row.high and (row.low > -inf or row.high < inf) for row in ROWS)
    assert np.all([row.holds(row.low) or row.low == -inf for row in ROWS])
