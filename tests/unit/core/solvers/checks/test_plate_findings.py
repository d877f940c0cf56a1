"""Findings on the plate that stops a tip, on states made by hand: never touched (B24), not touched by the tip (B25)."""

from dataclasses import replace

import numpy as np
import pytest
import results_cases as cases

from turgor.core.model.contact import Contact
from turgor.core.model.obstacles import Obstacle, Plane
from turgor.core.setups.blocked_tip import blocked_force
from turgor.core.solvers.checks.plate import plate_findings
from turgor.core.solvers.solution import Touch
from turgor.units import kPa, mm

NOTHING = (0.0, 0.0, 0.0)


@pytest.fixture(scope="module")
def question():
    """A tip 1 mm above a plate."""
    return blocked_force(cases.model(cases.body(half=True), pressure=20 * kPa), direction="-z", distance=1 * mm)


def path(question, *, sinks, bears):
    """A tip that sinks, straight down, while the plate pushes on the lower edge at some places along x [mm]."""

    def sunk(points):
        return points - np.outer(points[:, 0] / cases.LENGTH, (0, 0, sinks))

    forces = np.zeros_like(question.mesh.points)
    for x in bears:
        forces[np.linalg.norm(question.mesh.points - [x * mm, 0, 0], axis=1) < 1e-9] += (0.1, 0, 1.0)
    area = 1e-6 if bears else 0.0
    touch = Touch(force=forces, pressure=forces[:, 2], area=area, penetration=0.0, place=np.zeros(3))
    first = replace(cases.state(question, load_factor=0.0), touches={"plate": nothing(question)})
    return [first, replace(cases.state(question, sunk), touches={"plate": touch})]


def nothing(question):
    zeros = np.zeros_like(question.mesh.points)
    return Touch(force=zeros, pressure=zeros[:, 0], area=0.0, penetration=0.0, place=np.zeros(3))


def test_a_tip_on_the_plate_is_what_is_meant(question):
    assert plate_findings(question, path(question, sinks=1 * mm, bears=(40,))) == ()
    assert plate_findings(question, path(question, sinks=1 * mm, bears=(40, 40, 40, 35))) == (), "1.25 of 40 mm"


@pytest.mark.parametrize(("sinks", "last", "nearest"), [(0.8 * mm, "0.2", "0.2"), (-3 * mm, "3.25", "1")])
def test_a_plate_that_is_never_touched(question, sinks, last, nearest):
    (finding,) = plate_findings(question, path(question, sinks=sinks, bears=()))
    assert (finding.code, finding.severity) == ("B24", "warning")
    said = f"blocked force is 0: at 20 kPa it was {last} mm away from the plate, and {nearest} mm where it was nearest."
    assert said in finding.message


def test_a_plate_that_was_touched_and_left_is_one(question):
    first, touched = path(question, sinks=1 * mm, bears=(40,))
    assert plate_findings(question, [first, touched, replace(first, load_factor=1.0)]) == ()


@pytest.mark.parametrize(
    ("sinks", "hovers"), [(0.3 * mm, ", while the tip is 0.7 mm away from the plate."), (1.1 * mm, ".")]
)
def test_a_keel_on_the_plate(question, sinks, hovers):
    """At 5 and 10 mm behind the tip; 5 % of the actuator are 2 mm."""
    (finding,) = plate_findings(question, path(question, sinks=sinks, bears=(30, 35)))
    assert (finding.code, finding.severity) == ("B25", "warning")
    who = "What bears on the plate is not the tip" if "while" in hovers else "Not the tip alone bears on the plate"
    assert (
        f"{who}: at the end of the path the force acts 7.5 mm behind it, around (32.5, 0, 0) mm at rest{hovers}"
        in finding.message
    )
    assert "hold = 'z'" in finding.advice


def test_other_obstacles_are_none(question):
    wall = Obstacle(name="plate", shape=Plane(point=(0, 0, -1), normal=(0, 0, 1)))
    other = replace(question, contact=Contact(obstacles=[wall]))
    assert plate_findings(other, path(question, sinks=0.0, bears=())) == ()
