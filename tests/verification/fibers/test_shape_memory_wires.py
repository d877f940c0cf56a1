"""Shape-memory wires: the cosine law of Brinson (1993) alone, and a wire along a rubber bar that lifts a weight.

Exact for the law: the fractions by the formulas of the paper in one step, ξ = ξ₀ g(x) and 1 − ξ_s = (1 − ξ_s0) g(z),
while the wire takes many. Free recovery: ε = ε_L ξ_s0 g(x). Constrained recovery and weights: one equation for the
stress.
Problem in finite elements: a bar of neo-Hookean rubber, one end of which moves as a plane along x, with a wire along an
edge and a weight. The bar is in uniaxial tension: its length follows from one equation with the law of the wire.
Tolerances: 1e-9 for the law, which is the same at any step size; 1e-6 in finite elements, Newton's method.
"""

from math import cos, pi

import numpy as np
import pytest
from scipy.optimize import brentq

import meshes
import problems
import turgor as tg
from refused import refused
from turgor.core.materials.alloys.phases import Phases, WireStep
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.model.continued_model import continued
from turgor.core.solvers.stage_sequence import questions
from turgor.units import MPa, mm

ZERO = 273.15
ALLOY = tg.loads.ShapeMemoryAlloy.named("nitinol-brinson-1993")
DIAMETER = 0.25 * mm
SECTION = pi * DIAMETER**2 / 4


def g(x):
    """½ (1 + cos π x) between 0 and 1."""
    return 0.5 * (1 + cos(pi * min(max(x, 0.0), 1.0)))


def warm(stress, celsius):
    """What is left of the martensite of a wire that is heated."""
    return g((celsius - 34.5 - stress / MPa / 13.8) / 14.5)


def pulled(stress, celsius):
    """What is left of austenite and twinned martensite of a wire that is cooled or pulled."""
    return g((stress / MPa - 100 - 8 * max(celsius - 18.4, 0)) / 70)


def modulus(martensite):
    return 67e9 + martensite * (26.3e9 - 67e9)


def driven(start, path, strain_of):
    """Phases after a path of temperatures [°C], in many steps; ``strain_of(celsius)``."""
    for celsius in path:
        start, _ = WireStep(ALLOY, start, celsius + ZERO, 20 + ZERO).to(strain_of(celsius))
    return start


def loaded(start, celsius, stress):
    """Phases at a stress, by the strain that makes it."""

    def wrong(strain):
        return WireStep(ALLOY, start, celsius + ZERO, 20 + ZERO).to(strain)[0].stress - stress

    strain = brentq(wrong, 0, 0.2, xtol=1e-15)
    return WireStep(ALLOY, start, celsius + ZERO, 20 + ZERO).to(strain)[0], strain


@pytest.mark.parametrize("celsius", [30.0, 40.0, 44.0, 60.0])
def test_a_free_wire_recovers_its_length(celsius):
    start = Phases.at_rest(ALLOY, 20 + ZERO, 0.04)
    after = driven(start, np.linspace(20, celsius, 7), lambda _: -0.1)
    assert after.stress == 0
    assert 0.067 * after.detwinned == pytest.approx(0.04 * warm(0, celsius), rel=1e-9, abs=1e-15)


def test_a_fixed_wire_pulls_when_it_is_heated(record_verification):
    start = Phases.at_rest(ALLOY, 20 + ZERO, 0.01)
    after = driven(start, np.linspace(20, 60, 200), lambda _: 0.01)

    def wrong(stress):
        left = warm(stress, 60)
        return stress - modulus(left) * (0.01 - 0.01 * left)

    exact = brentq(wrong, 0, 600 * MPa)
    record_verification(
        claim="stress of a fixed wire, stretched by 1 % and heated to 60 °C [MPa]", source="Brinson (1993)",
        expected=exact / MPa, got=after.stress / MPa, tolerance="1e-9",
    )  # fmt: skip
    assert after.stress == pytest.approx(exact, rel=1e-9)


def test_a_wire_under_a_weight_runs_through_its_loop():
    stress = 200 * MPa
    at, _ = loaded(Phases.at_rest(ALLOY, 20 + ZERO, 0.0), 20, stress)
    assert at.detwinned == pytest.approx(1.0, abs=1e-12)
    for celsius in (30, 50, 55, 58, 70):
        at, strain = loaded(at, celsius, stress)
        left = warm(stress, celsius)
        assert strain == pytest.approx(stress / modulus(left) + 0.067 * left, rel=1e-9)
    for celsius in (50, 29, 26, 24, 20):
        at, strain = loaded(at, celsius, stress)
        formed = 1 - pulled(stress, celsius)
        assert strain == pytest.approx(stress / modulus(formed) + 0.067 * formed, rel=1e-9)


def test_cold_austenite_without_stress_is_twinned():
    hot = Phases(stress=0.0, temperature=80 + ZERO, detwinned=0.0, twinned=0.0)
    cold = driven(hot, np.linspace(80, 12, 30), lambda _: 0.0)
    assert (cold.detwinned, cold.twinned) == (0.0, pytest.approx(1 - g((18.4 - 12) / 9.4), rel=1e-9))


def test_slope_is_the_derivative_of_the_stress():
    cool, half = (Phases(stress=0.0, temperature=celsius + ZERO, detwinned=0.2, twinned=0.5) for celsius in (30, 42))
    for start, celsius, strain in ((cool, 16.0, 0.016), (cool, 70.0, 0.02), (half, 45.0, 0.009), (half, 47.0, 0.008)):
        step = WireStep(ALLOY, start, celsius + ZERO, 20 + ZERO)
        got = step.to(strain)[1]
        difference = (step.to(strain + 1e-7)[0].stress - step.to(strain - 1e-7)[0].stress) / 2e-7
        assert got == pytest.approx(difference, rel=1e-5)


BAR = (0.05, 0.01, 0.01)
RUBBER = problems.rubber(tg.laws.NeoHooke(C10=0.1 * MPa))


def wire(celsius, **more):
    through = [(0, 0, 0), (BAR[0], 0, 0)]
    return tg.loads.ShapeMemoryWire(
        **{"through": through, "diameter": DIAMETER, "alloy": "nitinol-brinson-1993", "strain": 0.0}
        | {"temperature": celsius + ZERO} | more
    )  # fmt: skip


def test_a_wire_lifts_a_weight_and_lets_it_down(record_verification):
    mesh = meshes.box(BAR, (2, 1, 1), kind=HEXAHEDRON)
    weight = 10.0
    planes = [tg.Fixed("x0", "x"), tg.Fixed("y0", "y"), tg.Fixed("z0", "z"), tg.supports.PlaneSection("x1")]
    model = tg.Model(mesh, {"body": RUBBER}, planes, [wire(20)])
    stages = tg.Stages(
        [
            tg.Stage("hang", loads=[tg.loads.Force("x1", (weight, 0, 0))]),
            tg.Stage("heat", loads=[wire(80)]),
            tg.Stage("cool", loads=[wire(24)]),
        ]
    )
    solution = problems.solve(model, stages)
    assert solution.complete
    ends = {state.stage: state for state in solution.states}

    def length(left, twinned=False):
        """Stretch of the bar when it and a wire with this detwinned martensite carry the weight."""

        def wrong(stretch):
            bar = 2 * 0.1 * MPa * 1e-4 * (stretch - stretch**-2)
            stress = (weight - bar) / SECTION
            fraction = left(stress)
            return stress / modulus(1 if twinned else fraction) + 0.067 * fraction - (stretch - 1)

        return brentq(wrong, 1, 1.2, xtol=1e-15)

    exact = {
        "hang": length(lambda stress: 1 - pulled(stress, 20), twinned=True),
        "heat": length(lambda stress: warm(stress, 80)),
        "cool": length(lambda stress: 1 - pulled(stress, 24)),
    }
    for stage, expected in exact.items():
        got = 1 + ends[stage].displacement[mesh.face_nodes("x1"), 0].mean() / BAR[0]
        record_verification(
            claim=f"stretch of a bar with a shape-memory wire and a weight, stage {stage}", source="Brinson (1993)",
            expected=expected, got=got, tolerance="1e-6",
        )  # fmt: skip
        assert got == pytest.approx(expected, rel=1e-6)
    assert 0.2 < (exact["hang"] - exact["cool"]) / (exact["hang"] - exact["heat"]) < 0.8  # halfway along the loop
    (result,) = tg.measures.cable_results(ends["heat"])
    assert result.name == "wire" and result.phases.martensite == 0
    assert result.tension[0] == pytest.approx(result.phases.stress * SECTION)


def test_a_wire_without_heat_stays_in_later_stages():
    mesh = meshes.box(BAR, (2, 1, 1), kind=HEXAHEDRON)
    cooled = wire(80, history=((0, 0), (0.5, 1), (1, 0)))
    model = tg.Model(mesh, {"body": RUBBER}, ["x0"], [cooled, tg.Traction("x1", (1.0, 0, 0), history=cooled.history)])
    (left,) = continued(model, (1.0, {}), []).loads
    assert left.name == "wire" and left.warming(1.0) == 0


def test_two_wires_of_one_name_are_refused():
    mesh = meshes.box(BAR, (2, 1, 1), kind=HEXAHEDRON)
    model = tg.Model(mesh, {"body": RUBBER}, ["x0"], [wire(80), wire(80, diameter=0.1 * mm)])
    with pytest.raises(tg.TurgorError) as error:
        tg.solve(model)
    assert "ShapeMemoryWire(wire) is stated twice" in str(error.value)


def test_a_stage_that_changes_a_wire_is_refused_before_the_run():
    mesh = meshes.box(BAR, (2, 1, 1), kind=HEXAHEDRON)
    model = tg.Model(mesh, {"body": RUBBER}, ["x0"], [])
    thicker = tg.Stages([tg.Stage("hot", loads=[wire(80)]), tg.Stage("cold", loads=[wire(5, diameter=1 * mm)])])
    with refused("cold", "ShapeMemoryWire(wire)", "twice"):
        questions(model, thicker)


@pytest.mark.parametrize("celsius", [70 - ZERO, -300, 1e4])
def test_a_temperature_without_a_unit_is_in_kelvin(celsius):
    with refused("temperature", "100 K to 1000 K", "70 °C"):
        wire(celsius)
