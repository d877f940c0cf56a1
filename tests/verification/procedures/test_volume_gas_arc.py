"""V04: procedures that drive by volume, gas or arc length: what they refuse, how they end, what they leave behind."""

import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import meshes
import turgor as tg
from problems import NEO_HOOKE, rubber, solve
from refused import refused
from turgor.core.engine.algebra.linear import SingularTangentError
from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.results.drive import drive_of
from turgor.core.results.files.vtu import write_series
from turgor.core.solvers.checks.contact import meeting_walls
from turgor.core.solvers.path_outcomes import reached
from turgor.core.solvers.pressures import pressure_text, pressures_of
from turgor.core.solvers.procedures.arc_length import ArcLength
from turgor.core.solvers.procedures.auto import Auto
from turgor.core.solvers.procedures.gas_mass import GasMass
from turgor.core.solvers.procedures.volume_control import VolumeControl
from turgor.units import kPa, mL

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))


def sphere(*loads):
    return tg.Model(meshes.sphere_octant(10e-3, 15e-3, 1, 2), {"body": RUBBER}, [], loads)


def bar(*loads, contact=None):
    """A bar with two cavities, one above the other."""
    return tg.Model(meshes.two_cavities(), {"body": RUBBER}, [tg.Fixed("x0")], loads, contact=contact)


def test_each_cavity_gets_its_volume_and_has_its_pressure(record_verification):
    solution = solve(bar(), VolumeControl(volume={"cavity_1": 0.1 * mL, "cavity_2": -0.08 * mL}, max_step=0.5))
    response = tg.measure(solution, tg.cavity_volume, mesh_error=False)
    rest, last = (np.array([response.column(f"cavity_{k}_volume")[i] for k in (1, 2)]) for i in (0, -1))
    assert last - rest == pytest.approx([0.1 * mL, -0.08 * mL], rel=1e-5)
    assert response.names[:5] == (
        "load_factor", "cavity_1_pressure", "cavity_2_pressure", "injected_volume", "injected_volume_cavity_1",
    )  # fmt: skip
    assert response.column("injected_volume")[-1] == pytest.approx(0.02 * mL)
    assert drive_of(response) == "injected_volume"
    assert response.column("cavity_1_pressure")[-1] > 0 > response.column("cavity_2_pressure")[-1]
    # the same pressures as loads bring back the same volumes
    pressures = pressures_of(solution.states[-1])
    again = solve(bar(*(tg.Pressure(name, pressure) for name, pressure in pressures.items())), tg.Static())
    result, expected = tg.cavity_volume(again.states[-1]) / mL, last.sum() / mL
    claim = "two cavities under the pressures that two given volumes took: volume of both [mL]"
    record_verification(claim, "V04, two procedures", expected, result, "1e-6")
    assert result == pytest.approx(expected, rel=1e-6)


def test_another_cavity_may_have_a_pressure_that_is_stated():
    solution = solve(bar(tg.Pressure("cavity_2", 5 * kPa)), VolumeControl(volume={"cavity_1": 0.05 * mL}, max_step=0.5))
    assert pressures_of(solution.states[-1])["cavity_2"] == 5 * kPa
    assert "cavity_2 5 kPa" in pressure_text(solution.states[-1])
    column = tg.measure(solution, tg.cavity_volume, mesh_error=False).column("cavity_2_pressure")
    assert column == pytest.approx([5 * kPa * state.load_factor for state in solution.states])


@pytest.mark.parametrize(
    ("model", "procedure", "facts"),
    [
        (bar(), VolumeControl(volume=1e-7), ["procedure.volume", "cavity_1, cavity_2"]),
        (bar(), VolumeControl(volume={"cavity_3": 1e-7}), ["procedure.volume", "'cavity_3'", "'cavity_2'"]),
        (
            sphere(tg.Pressure("cavity", 1.0)),
            GasMass(mass_ratio=2.0),
            ["cavity", "pressure load", "procedure.mass_ratio"],
        ),
        (sphere(tg.Pressure("cavity", 1.0, history="s**2")), ArcLength(), ["ArcLength", "load factor"]),
        (sphere(tg.Pressure("cavity", 1.0, history="s**2")), Auto(), ["auto", "load factor"]),
    ],
)
def test_what_cannot_be_driven_is_refused(model, procedure, facts):
    with refused(*facts):
        solve(model, procedure)


@pytest.mark.parametrize(
    ("kind", "changes", "facts"),
    [
        (VolumeControl, {"volume": 0.0}, ["procedure.volume", "0 m³"]),
        (VolumeControl, {"volume": {}}, ["procedure.volume", "no cavity"]),
        (VolumeControl, {"volume": {"cavity": 0.0}}, ["procedure.volume.cavity", "0 m³"]),
        (VolumeControl, {"volume": 1e-6, "first_step": 2.0}, ["procedure.first_step", 2, 1]),
        (GasMass, {"mass_ratio": 0.0}, ["procedure.mass_ratio", 0, 1000]),
        (GasMass, {"exponent": 2.0}, ["procedure.exponent", 2, "1 to 1.7"]),
        (GasMass, {"ambient": -1.0}, ["procedure.ambient", "-1 Pa", "1e8 Pa"]),
        (GasMass, {"at": (0.0,)}, ["procedure.at", 0, "(0, 1]"]),
        (ArcLength, {"max_stretch": 1.0}, ["procedure.max_stretch", 1]),
        (ArcLength, {"max_displacement": 0.0}, ["procedure.max_displacement", "0 m"]),
        (ArcLength, {"min_step": 0.5}, ["procedure.min_step", 0.5, "first_step", 0.05]),
        (Auto, {"past": 1.0}, ["procedure.past", 1, 1000]),
        (Auto, {"tolerance": 1.0}, ["procedure.tolerance", 1, "1e-12 to 0.01"]),
    ],
)
def test_bad_procedure_names_field_value_and_range(kind, changes, facts):
    with refused(*facts):
        kind(**changes)


def test_stop_progress_and_limit_of_steps():
    seen = []
    volume = VolumeControl(volume=20 * mL)
    solution = solve(
        sphere(), volume, throw=False, progress=lambda *args: seen.append(args),
        stop=lambda state: "far enough" if state.pressures["cavity"] > 50 * kPa else None,
    )  # fmt: skip
    assert solution.status is tg.Status.STOPPED
    assert "far enough" in solution.message
    assert f"{solution.states[-1].pressures['cavity'] / kPa:.4g} kPa" in solution.message
    assert [state for _, state in seen if state is not None] == list(solution.states[1:])
    assert sum(step.iterations for step in solution.steps) == sum(state is None for _, state in seen)
    with refused("step_limit", "47.95 kPa", "3 steps", error=tg.solutions.SolveError):
        solve(sphere(), VolumeControl(volume=20 * mL, max_step=0.02, max_steps=3))


def test_interrupt_keeps_the_path_so_far():
    def press_control_c(iteration, state):
        if state is not None and len(state.pressures) and state.load_factor > 0.05:
            raise KeyboardInterrupt

    solution = solve(sphere(), VolumeControl(volume=20 * mL), progress=press_control_c, throw=False)
    assert solution.status is tg.Status.INTERRUPTED
    assert solution.states[-1].load_factor > 0.05


def test_arc_length_ends_at_the_load_that_was_asked_for(record_verification):
    solution = solve(sphere(tg.Pressure("cavity", 80 * kPa)), ArcLength(at=(0.25, 0.5)))
    factors = [state.load_factor for state in solution.states]
    assert solution.status is tg.Status.CONVERGED
    assert factors[-1] == 1.0
    assert {0.25, 0.5} <= set(factors)
    assert factors == sorted(factors)
    by_load = solve(sphere(tg.Pressure("cavity", 80 * kPa)), tg.Static()).states[-1]
    apart = np.abs(solution.states[-1].displacement - by_load.displacement).max() / 10e-3
    claim = "sphere under 80 kPa, by arc length and by load: largest difference of displacement over the inner radius"
    record_verification(claim, "V04, two procedures", 0.0, apart, "1e-6")
    assert apart < 1e-6


def test_arc_length_ends_at_a_displacement_and_makes_requested_states_on_both_branches():
    model = sphere(tg.Pressure("cavity", 125 * kPa))
    solution = solve(model, ArcLength(max_displacement=12e-3, at=(0.9,)))
    crossings = [state for state in solution.states if state.load_factor == 0.9]
    moved = [np.linalg.norm(state.displacement, axis=1).max() for state in crossings]
    assert solution.status is tg.Status.FOLLOWED
    assert not solution.converged
    assert "largest displacement has reached" in solution.message
    assert len(crossings) == 2
    assert moved[0] < 5e-3 < moved[1]
    assert np.linalg.norm(solution.states[-1].displacement, axis=1).max() >= 12e-3


def test_auto_is_load_control_where_nothing_turns():
    procedure = Auto(first_step=0.3, at=(0.4,))
    solution = solve(sphere(tg.Pressure("cavity", 50 * kPa)), procedure)
    plain = solve(sphere(tg.Pressure("cavity", 50 * kPa)), tg.Static(first_step=0.3, at=(0.4,)))
    assert solution.status is tg.Status.CONVERGED
    assert solution.procedure is procedure
    assert [state.load_factor for state in solution.states] == [state.load_factor for state in plain.states]
    assert not solution.limit_points
    assert not solution.findings


def test_auto_takes_the_arc_where_other_loads_act(record_verification):
    pull = tg.Traction("outside", (1.0, 0.0, 0.0))  # next to nothing, but no pressure
    solution = solve(sphere(tg.Pressure("cavity", 125 * kPa), pull), Auto(max_stretch=2.0))
    (limit,) = solution.limit_points
    assert solution.status is tg.Status.FOLLOWED
    claim = "sphere of one cell through the wall beside another load, by Auto: limit pressure [kPa]"
    record_verification(claim, "V04, exact", 118.4, limit.pressure / kPa, "0.5 %")
    assert limit.pressure == pytest.approx(118.4 * kPa, rel=5e-3)
    assert solution.states[limit.state].load_factor == limit.load_factor == max(s.load_factor for s in solution.states)


def test_a_path_that_falls_is_numbered_for_paraview(tmp_path):
    solution = solve(sphere(tg.Pressure("cavity", 125 * kPa)), ArcLength(max_stretch=1.8))
    text = write_series(tmp_path, solution).read_text(encoding="utf-8")
    assert "timestep is the number of the state" in text
    assert f'timestep="{len(solution.states) - 1}"' in text
    volume = solve(sphere(), VolumeControl(volume=1 * mL))
    assert "timestep is the load factor" in write_series(tmp_path, volume).read_text(encoding="utf-8")
    assert "cavity_pressure" in (tmp_path / "state_0001.vtu").read_text(encoding="utf-8")


def fails_sometimes(monkeypatch, when):
    """Let factorizations fail as at a singular tangent: ``when(geometric stress or None)``."""
    factor = Tangent.factor

    def failing(self, at, geometric=None, jump=None):
        if when(geometric):
            raise SingularTangentError("a pivot is zero")
        return factor(self, at, geometric, jump)

    monkeypatch.setattr(Tangent, "factor", failing)


def test_a_singular_tangent_is_left_by_another_stress(monkeypatch):
    good = solve(sphere(), VolumeControl(volume=1 * mL)).states[-1]
    fails_sometimes(monkeypatch, lambda geometric: geometric is not None)
    again = solve(sphere(), VolumeControl(volume=1 * mL)).states[-1]
    assert again.pressures["cavity"] == pytest.approx(good.pressures["cavity"], rel=1e-6)


def test_a_tangent_that_stays_singular_ends_the_run_with_the_reason(monkeypatch):
    fails_sometimes(monkeypatch, lambda geometric: True)
    solution = solve(sphere(), VolumeControl(volume=1 * mL), throw=False)
    assert solution.status is tg.Status.STEP_TOO_SMALL
    assert "a pivot is zero" in solution.message
    assert len(solution.states) == 1
    assert solution.states[0].unstable_modes is None


def test_walls_that_meet_where_the_load_falls_are_found():
    """The gap closes on the way from load factor 0.5 to 0.4, past a maximum of the load."""
    mesh = meshes.two_cavities()
    alone = tg.Contact(self_contact=False)
    model = bar(tg.Pressure("cavity_1", -2 * kPa), contact=alone)  # a cavity that is pressed together is watched
    states = []
    for factor, shift in ((0.0, 0.0), (0.5, 1.5e-3), (0.4, 2.5e-3)):
        squeezed = np.clip((mesh.points[:, 2:] - 2e-3) / 2e-3, 0.0, 1.0)  # cavity_1 lies between 2 and 4 mm
        down = squeezed * [0.0, 0.0, -shift]
        states.append(
            tg.solutions.State(
                model=model,
                load_factor=factor,
                displacement=down,
                mean_stress=np.empty(0),
                nodal_force=np.zeros_like(down),
            )
        )
    (result,) = [finding for finding in meeting_walls(model, states) if "cavity_1" in finding.message]
    (pressure,) = re.findall(r"met at (-[\d.]+) kPa", result.message)
    assert -2 * 0.5 < float(pressure) < -2 * 0.4


def test_an_equilibrium_that_no_volume_holds_is_called_unstable():
    procedure = VolumeControl(volume=1 * mL)
    solution = solve(sphere(), procedure)
    states = [replace(state, unstable_modes=int(state.load_factor > 0.5)) for state in solution.states]
    task = SimpleNamespace(procedure=procedure)
    outcomes = [
        reached(SimpleNamespace(task=task, states=each, steps=solution.steps, limits=solution.limit_points))
        for each in (solution.states, states)
    ]
    assert solution.message == outcomes[0].message
    outcome = outcomes[1]
    first = next(state for state in states if state.unstable_modes)
    assert f"From an injected volume of {first.driven['injected_volume'] / mL:.4g} mL" in outcome.message
    assert outcome.advice


def test_a_corner_of_the_pressure_is_no_limit_point():
    """A pressure next door that rises and falls takes that of a sealed cavity along, with a corner where it turns."""
    other = tg.Pressure("cavity_2", 20 * kPa, history=((0, 0), (0.5, 1), (1, 0)))
    solution = solve(bar(other), VolumeControl(volume={"cavity_1": 1e-3 * mL}, max_step=0.25))
    pressures = {state.load_factor: state.pressures["cavity_1"] for state in solution.states}
    assert max(pressures, key=pressures.__getitem__) == 0.5
    assert pressures[1.0] < 0.2 * pressures[0.5]
    assert solution.limit_points == ()


def test_walls_that_a_pump_draws_together_touch():
    """A flat void is emptied by three fifths: its walls meet, as they do where suction is stated."""
    mesh = meshes.hollow_box(3)
    mesh = meshes.with_points(mesh, mesh.points * np.array([30, 30, 4.5]) * 1e-3)
    model = tg.Model(mesh, {"body": rubber(NEO_HOOKE)}, [tg.Fixed("z0")], [])
    drawn = -0.6 * 10 * 10 * 1.5 * 1e-9
    last = solve(model, VolumeControl(volume=drawn)).states[-1]
    assert last.touches["self"].area > 30e-6
    alone = replace(model, contact=tg.Contact(self_contact=False))
    through = solve(alone, VolumeControl(volume=drawn))
    assert [each.code for each in through.findings if "cavity" in each.message] == ["B02"]
    assert last.pressures["cavity"] < 2 * through.states[-1].pressures["cavity"] < 0
