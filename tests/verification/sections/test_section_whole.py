"""V22: the section of an actuator does what the middle of the whole actuator does.

Problems: an eccentric bender and a tube wound with one family of smeared threads, 120 mm long, with end walls; half and
whole of 27-node hexahedra. Their strains are read between 40 % and 60 % of the length (`turgor.measures.rod_strains`).
Reference: the section alone, at the same pressures.
Tolerance: 0.1 % of curvature, twist and 1 % of what stretches, where the meshes of the whole actuators are a little
coarser; ends reach about one diameter far.
"""

import numpy as np
import pytest

import problems
import turgor as tg
from turgor.units import deg, kPa, mm

KEVLAR = tg.Material(name="thread", law=tg.laws.Hooke(E=31067e6, nu=0.3))
MEASURES = (tg.measures.middle_curvature_y, tg.measures.middle_twist, tg.measures.middle_stretch)


def both(actuator, pressure, reinforcements=()):
    """Responses of the whole actuator and of its section at the same pressures."""
    materials = {"body": problems.rubber(problems.NEO_HOOKE)}
    mesh = tg.mesh(actuator.build(), size=4 * mm, cells="hexahedra")
    loads = [tg.Pressure("cavity", pressure)]
    model = tg.Model(mesh, materials, [tg.Fixed("fixed")], loads, reinforcements=reinforcements)
    whole = tg.measure(problems.solve(model), *MEASURES)
    section = tg.Section(actuator, materials, reinforcements=reinforcements)
    return whole, section.solve(whole["pressure"][1:]).response


@pytest.mark.slow
def test_eccentric_bender(record_verification):
    whole, alone = both(tg.actuators.EccentricBender(length=120 * mm), 40 * kPa)
    got, expected = whole["middle_curvature_y"][1:], alone["curvature_y"]
    record_verification(
        claim="whole eccentric bender, middle: κ [1/m] up to 40 kPa",
        source="the section alone",
        expected=expected[-3:],
        got=got[-3:],
        tolerance="0.3 %",
    )
    assert got[-3:] == pytest.approx(expected[-3:], rel=3e-3)
    assert whole["middle_stretch"][-1] - 1 == pytest.approx(alone["stretch"][-1] - 1, rel=0.01)
    # bending of a section without reinforcement starts with the square of the pressure
    power = np.diff(np.log(expected)) / np.diff(np.log(alone["pressure"]))
    assert power[0] == pytest.approx(2, abs=0.1)


@pytest.mark.slow
def test_wound_tube(record_verification):
    winding = tg.Winding(angle_from_axis=60 * deg, spacing=2 * mm)
    threads = tg.Fibers(face="outside", material=KEVLAR, diameter=0.1778 * mm, winding=winding, compression=1.0)
    whole, alone = both(tg.actuators.TwistingTube(length=120 * mm), 30 * kPa, [threads])
    rows = [("twist", "twist [1/m]", 1e-3), ("stretch", "stretch", 1e-4)]
    for name, text, tolerance in rows:
        got, expected = whole[f"middle_{name}"][-3:], alone[name][-3:]
        record_verification(
            claim=f"whole tube wound at 60° from the axis, middle: {text} up to 30 kPa",
            source="the section alone",
            expected=expected,
            got=got,
            tolerance=f"{tolerance:g}",
        )
        assert got == pytest.approx(expected, rel=tolerance)
