"""Findings and measures of tearing on paths that are made by formula: uniform stretch along x."""

from dataclasses import replace

import numpy as np
import pytest
from solver_cases import RUBBER, bar

import turgor as tg
from refused import refused
from turgor.core.engine.cells.element import element_of
from turgor.core.materials.crack_growth import CRACK_GROWTH, CrackGrowth, tearing_energy_of_crack
from turgor.core.materials.failure_tables import failure_tables, read_crack_growth, read_strength
from turgor.core.solvers.checks.tearing.findings import tearing_findings
from turgor.core.solvers.solution import Solution, State, Status
from turgor.units import MPa

MU = RUBBER.law.shear_modulus
SOURCE = {"source": "made up"}


def path(material, stretches, **more):
    """States of the bar in uniaxial stretch; the mean stress makes the sides free."""
    question = tg.Model(bar(), {"body": material}, [tg.Fixed("fixed")], [], **more)
    states = []
    for factor, stretch in zip(np.linspace(0, 1, len(stretches)), stretches, strict=True):
        along = np.array([stretch, stretch**-0.5, stretch**-0.5])
        mean = MU / 3 * (stretch**2 - 1 / stretch)
        points = question.mesh.points
        states.append(
            State(
                model=question,
                load_factor=float(factor),
                displacement=points * along - points,
                mean_stress=np.full(element_of(question).mean_count, mean),
                nodal_force=np.zeros_like(points),
            )
        )
    return states


def solved(states):
    procedure = tg.Static()
    return Solution(
        model=states[0].model, procedure=procedure, states=tuple(states), status=Status.CONVERGED, message=""
    )


def bearing(**numbers):
    return replace(RUBBER, strength=read_strength({**numbers, **SOURCE}))


def test_the_load_of_half_the_elongation_at_break_is_interpolated():
    (found,) = tearing_findings(path(bearing(elongation_at_break=1.0), [1.0, 1.4, 1.8]))
    assert found.code == "T01"
    assert found.message.startswith("'body' of 'rubber'")
    assert "passes half of its elongation at break (stretch 2) at load factor 0.625 and reaches 80 % of it" in (
        found.message
    )


def test_beyond_the_elongation_at_break_it_tears():
    (found,) = tearing_findings(path(bearing(elongation_at_break=0.5), [1.0, 1.4, 1.8]))
    assert "and all of it at load factor 0.625" in found.message
    assert "Expect it to tear" in found.advice


def test_little_stretch_is_no_finding_and_neither_is_a_material_that_states_nothing():
    assert tearing_findings(path(bearing(elongation_at_break=1.0), [1.0, 1.2, 1.49])) == ()
    assert tearing_findings(path(RUBBER, [1.0, 3.0])) == ()


def test_a_state_before_loading_counts_at_its_own_load_factor():
    load = tg.loads.PreStretch("body", 1.75, history=((0, 0), (0.5, 1), (1, 0)))
    states = path(bearing(elongation_at_break=1.0), [1.0, 1.0, 1.0])
    model = replace(states[0].model, loads=(load,))
    (found,) = tearing_findings([replace(each, model=model) for each in states])
    assert "passes half of its elongation at break (stretch 2) at load factor 0.333" in found.message


def test_nominal_stress_is_compared_with_the_strength():
    stretch = 2.0
    nominal = MU * (stretch - stretch**-2)
    states = path(bearing(tensile_strength=nominal / 0.8), [1.0, stretch])
    (found,) = tearing_findings(states)
    assert found.code == "T02"
    assert "reaches 80 % of it" in found.message
    response = tg.measure(solved(states), "strength_share")
    assert response["strength_share"] == pytest.approx([0.0, 0.8], abs=1e-6)


def test_the_place_is_near_a_face_of_the_cell():
    (found,) = tearing_findings(path(bearing(elongation_at_break=1.0), [1.0, 1.8]))
    assert "near the faces 'fixed' and 'top'" in found.message


def test_a_sheet_is_compared_by_its_own_stress():
    film = tg.Material(
        name="film", law=tg.laws.Hooke(E=10 * MPa, nu=0.0), strength=read_strength({"tensile_strength": 4e6, **SOURCE})
    )
    question = path(RUBBER, [1.0])[0].model
    sheet = replace(question, materials={"body": RUBBER, "fixed": tg.Membrane(film, 1e-4)})
    points = question.mesh.points
    states = [
        replace(each, model=sheet, displacement=points * [1.0, scale, 1.0] - points)
        for scale, each in zip((1.0, 1.2), path(RUBBER, [1.0, 1.0]), strict=True)
    ]
    response = tg.measure(solved(states), "strength_share")
    green = 0.5 * (1.2**2 - 1)
    assert response["strength_share"][-1] == pytest.approx(1.2 * 10e6 * green / 4e6)
    assert "The sheet on 'fixed'" in tearing_findings(states)[0].message


def test_cracking_energy_is_the_whole_energy_in_simple_tension():
    stretches = np.linspace(1, 2, 41)
    growing = replace(RUBBER, crack_growth=CRACK_GROWTH["natural rubber"])
    response = tg.measure(
        solved(path(growing, stretches)), "cracking_energy_p99", "tearing_energy", "log_cycles_to_tear"
    )
    energy = MU / 2 * (stretches**2 + 2 / stretches - 3)
    assert response["cracking_energy_p99"] == pytest.approx(energy, rel=3e-3, abs=1.0)
    flaw = growing.crack_growth.flaw
    assert response["tearing_energy"] == pytest.approx(
        tearing_energy_of_crack(energy, stretches, flaw), rel=5e-3, abs=1e-4
    )
    assert response["log_cycles_to_tear"][0] == 12


def test_cycles_are_the_integral_of_the_growth_law():
    law = CrackGrowth(rate=2e-7, exponent=2.5, flaw=5e-5, threshold=20.0)
    per_length, critical = 4e6, 2e3
    lengths = np.geomspace(law.flaw, critical / per_length, 20001)
    rate = law.rate * (per_length * lengths / 1e3) ** law.exponent
    assert float(law.cycles(per_length, critical)) == pytest.approx(np.trapezoid(1 / rate, lengths), rel=1e-5)
    assert float(law.cycles(per_length, faster=10.0)) == pytest.approx(float(law.cycles(per_length)) / 10)
    assert float(law.cycles(0.99 * 20.0 / law.flaw)) == np.inf
    assert float(law.cycles(1.01 * critical / law.flaw, critical)) == 0.0


def test_life_is_a_note_or_a_warning():
    slow = replace(bearing(tear_strength=2e3), crack_growth=CRACK_GROWTH["natural rubber"])
    (note,) = tearing_findings(path(slow, np.linspace(1, 1.2, 5)))
    assert (note.code, note.severity) == ("T03", "note")
    assert "does not grow" in note.message
    large = CrackGrowth(rate=1e-6, exponent=2.0, flaw=1e-3, spread=5.0)
    (warning,) = tearing_findings(path(replace(slow, crack_growth=large), np.linspace(1, 2, 11)))
    assert (warning.code, warning.severity) == ("T03", "warning")
    assert "% of its tear strength" in warning.message
    assert "in about 900 cycles (180 to 4,500)" in warning.message  # c₀ (1 − T/Tc) / (r T²)


def test_measures_without_the_numbers_that_they_need_say_so():
    states = path(RUBBER, [1.0, 1.5])
    with refused("break_share", "elongation_at_break", "strength"):
        tg.measure(solved(states), "break_share")
    with refused("log_cycles_to_tear", "crack_growth"):
        tg.measure(solved(states), "log_cycles_to_tear")


def test_tables_read_back_to_the_same():
    material = replace(bearing(elongation_at_break=3.0, tear_strength="5 N/mm"), crack_growth=read_crack_growth(
        {"like": "natural rubber", "flaw": "0.2 mm"}))  # fmt: skip
    tables = failure_tables(material)
    assert read_strength(tables["strength"]) == material.strength
    assert read_crack_growth(tables["crack_growth"]) == material.crack_growth


def test_wrong_tables_are_answered_with_what_is_needed():
    with refused("natural ruber", "natural rubber"):
        read_crack_growth("natural ruber")
    with refused("rate", "exponent", "natural rubber"):
        read_crack_growth({"flaw": "0.1 mm"})
    with refused("exponent", 1, "more than 1"):
        CrackGrowth(rate=1e-7, exponent=1.0, flaw=1e-4)
    with refused("film", "crack_growth", "for rubbers"):
        tg.Material(name="film", law=tg.laws.Hooke(E=1e9, nu=0.3), crack_growth=CRACK_GROWTH["natural rubber"])
