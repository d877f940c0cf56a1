"""Tables and polynomials of an actuator, with their errors."""

import json
from dataclasses import replace

import numpy as np
import pytest
from reduced_cases import PRESSURE, reduced
from scipy.spatial.transform import Rotation

import turgor as tg
from refused import refused
from turgor.reduced.states.estimate import KnownErrors
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.states.known_measures import KnownMeasures
from turgor.systems.robots.backbone import backbone_of
from turgor.systems.robots.tables.arc import arc_of, arc_places
from turgor.systems.robots.tables.polynomial import fitted
from turgor.systems.robots.tables.tabulate import whole_turn
from turgor.systems.robots.tables.tip_forces import tip_forces_of


@pytest.fixture(scope="module")
def table():
    return tg.robots.tabulate(reduced(), 30)


def test_polynomials_are_as_close_to_the_reduced_model_as_they_state(table):
    answer = reduced().solve(0.377 * PRESSURE)
    values = {"tip_x": answer.tip[0] + 22e-3, "volume_cavity": answer.volumes["cavity"]}
    for name, value in values.items():
        polynomial = table.polynomials[name]
        assert abs(polynomial.at([[0.377 * PRESSURE]])[0] - value) < 2 * polynomial.error
        assert polynomial.error < 1e-3 * np.ptp(table.response[name])


def test_turns_and_places_of_the_tip_are_those_of_the_full_measures(table):
    answer = reduced().solve(PRESSURE)
    row = int(table.response["loads_pressure"].argmax())
    assert table.response["tip_z"][row] - table.response["tip_z"][0] == pytest.approx(answer.tip[2], rel=1e-6)
    bent = tg.bending_angle(answer.state())
    assert table.response["bending_angle"][row] == pytest.approx(bent, rel=1e-4)
    assert table.response["tip_turn_y"][row] == pytest.approx(bent, rel=0.1), "the tip does not stay plane"
    assert table.response["curvature_z"][row] < 0, "it bends down"


def test_files_state_units_and_all_errors(table, tmp_path):
    csv, document = table.save(tmp_path, "finger")
    assert "arc_length_mm" in csv.read_text().splitlines()[0]
    made = json.loads(document.read_text())
    assert made["inputs"] == [{"key": "loads.pressure", "low": 0.0, "high": PRESSURE}]
    assert made["polynomials"]["tip_x"]["largest_error"] == table.polynomials["tip_x"].error > 0
    assert made["errors"]["held_out_displacement_over_largest"] == reduced().held_out.worst
    assert (made["rows_fitted"], made["rows_tested"]) == (20, 10)
    assert not [name for name in made["errors"] if name.startswith("mesh")]
    nothing = np.full((2, 2), np.nan)
    known = KnownMeasures(names=("bending_angle", "volume"), mesh=np.array([[0.01, np.nan], [0.02, np.nan]]),
                          inputs=nothing, values=nothing, reduction=nothing)  # fmt: skip
    errors = replace(table, reduced=replace(reduced(), measures=known)).errors
    assert {name: error for name, error in errors.items() if name.startswith("mesh")} == {"mesh_bending_angle": 0.02}


def test_an_arc_is_found_again_from_places_off_its_axis():
    shares, bends, length = np.linspace(0, 1, 9), np.array([-20.0, 35.0]), 0.06
    curvature = np.hypot(*bends)
    axis = np.array([0, -bends[1], bends[0]]) / curvature
    turns = Rotation.from_rotvec(np.outer(curvature * length * shares, axis)).as_matrix()
    rest = np.column_stack([0.055 * shares, 0 * shares, 2e-3 * (shares > 0)])
    places = arc_places(bends, length, shares) + np.einsum("mab,b->ma", turns, [0, 0, 2e-3]) * (shares > 0)[:, None]
    arc = arc_of(places, turns, rest)
    assert (arc.curvature, arc.length) == pytest.approx((curvature, length), rel=1e-6)
    assert arc.direction == pytest.approx(np.arctan2(35, -20), rel=1e-6)
    assert arc.misfit < 1e-9
    assert whole_turn(turns) == pytest.approx(curvature * length * axis), "139 degrees"


def test_turns_beyond_half_a_turn_are_counted_on():
    turns = Rotation.from_rotvec(np.outer(np.linspace(0, 4.5, 8), [0, 1, 0])).as_matrix()
    assert whole_turn(turns) == pytest.approx([0, 4.5, 0])


def test_a_polynomial_states_the_error_at_other_points():
    s = np.linspace(0, 1, 40)[:, None]
    box = np.zeros(1), np.ones(1)
    cubic = fitted((s[::2], s[::2, 0] ** 3), (s[1::2], s[1::2, 0] ** 3), box)
    assert cubic.degree == 3
    assert cubic.error < 1e-12
    kink = fitted((s[::2], np.abs(s[::2, 0] - 0.5)), (s[1::2], np.abs(s[1::2, 0] - 0.5)), box)
    assert 0.005 < kink.error < 0.1


def with_tip_force():
    """The finger with a force on its tip along z as a second input, in its old modes."""
    known = reduced()
    column = known.tip[2] / 50
    equations = replace(
        known.equations,
        pressures=np.column_stack([known.equations.pressures, np.zeros(len(known.faces))]),
        forces=np.column_stack([known.equations.forces, column]),
    )
    high = np.array([PRESSURE, 5.0])
    box = Inputs(("loads.pressure", "loads.tip.vector.3"), np.array([0.0, -5.0]), high, ("kPa", "N"))
    more = np.column_stack([known.trained_inputs, np.zeros(len(known.trained_inputs))])
    return replace(known, inputs=box, equations=equations, trained_inputs=more, known=KnownErrors(), spline=None)


def test_stiffness_and_blocked_force_come_from_forces_on_the_tip():
    made = with_tip_force()
    forces = tip_forces_of(made)
    newton = made.scales[1] * made.scales[0] ** 2 * 2 / 50  # of a half model, by a unit of the input
    assert forces.places == (1,)
    assert forces.axes[0] == pytest.approx([0, 0, newton])
    answer = made.at(np.array([1e3, 0.0]))
    up, down = (made.at(np.array([1e3, force])) for force in (0.02, -0.02))
    row = forces.row(answer)
    assert row["stiffness_z", "N/m"] == pytest.approx(0.04 * newton / (up.tip[2] - down.tip[2]), rel=1e-3)
    blocked = row["blocked_force_z", "N"]
    assert abs(made.at(np.array([1e3, -blocked / newton])).tip[2]) < 1e-6 * abs(answer.tip[2])
    assert np.isnan(forces.row(made.at(np.array([PRESSURE, 0.0])))["blocked_force_z", "N"]), "it needs more than 5 N"


def test_short_tables_and_too_many_links_are_refused():
    with refused("11", "12"):
        tg.robots.tabulate(reduced(), 11)
    with refused("1", "60"):
        backbone_of(reduced(), 1)
