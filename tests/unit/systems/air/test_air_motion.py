"""Chambers in motion: gas and reduced model are stepped together."""

from dataclasses import replace

import numpy as np
import pytest
from reduced_cases import moving

import turgor as tg
from refused import refused
from turgor.units import kPa, mm

VALVE = tg.air.Restriction(conductance=0.02e-8)
TUBE = tg.air.Tubing(diameter=2 * mm, length=0.5)
STEP = 2e-3


def actuator(**changes):
    return tg.air.MovingActuator(moving(), tg.real_time.Moving(**({"step": STEP, "stiffness_damping": 2e-3} | changes)))


def network(volume, push, process="isothermal"):
    made = tg.air.driven(volume, 15 * kPa, VALVE, TUBE, process=process)
    return made.with_part("valve", tg.air.ThreeWayValve("supply", "outlet", VALVE, push))


def energy_error(followed):
    errors = [abs(each.kinetic + each.strain + each.dissipated - each.work) for each in followed.energies]
    return max(errors) / max(each.work for each in followed.energies)


@pytest.mark.parametrize("process", ["isothermal", "adiabatic"])
def test_mass_and_energy_are_kept_and_the_motion_is_that_of_the_model_alone(process):
    """Filled within a few vibrations, and vented; the pressures of the network move the model alone as well."""
    times = np.arange(0.0, 0.0801, STEP)
    push = tg.air.Signal((0.0, np.nextafter(0.02, 0.0)), (1, -1))  # no step between both
    run = tg.air.simulate(network(actuator().chamber(), push, process), times[-1], times=times)
    followed = run.motions["actuator"]
    assert run.balance() < 1e-12
    assert energy_error(followed) < 3e-3
    assert max(each.kinetic for each in followed.energies) > 0.01 * max(each.work for each in followed.energies)
    volumes = run.volume("actuator")
    assert [answer.volumes["cavity"] for answer in followed.answers] == pytest.approx(volumes, rel=1e-7)
    alone = moving().follow(times, run.pressure("actuator"), actuator().moving)
    assert [answer.volumes["cavity"] for answer in alone.answers] == pytest.approx(volumes, rel=1e-6)
    assert run.response().column("tip_displacement_actuator").max() == pytest.approx(
        np.linalg.norm(followed.tip, axis=1).max()
    )
    assert (np.ptp(run.temperature("actuator")) > 1.0) == (process == "adiabatic")


def test_a_slow_fill_is_that_of_a_table():
    times, slow = np.linspace(0.0, 4.0, 41), tg.air.Restriction(conductance=0.02e-10)
    runs = []
    for volume in (tg.air.VolumeCurve.of_reduced(moving()), actuator(step=0.1).chamber()):
        made = tg.air.driven(volume, 6 * kPa, slow)
        runs.append(tg.air.simulate(made, 4.0, times=times))
    assert runs[0].pressure("actuator")[-1] > 2 * kPa
    assert runs[1].pressure("actuator") == pytest.approx(runs[0].pressure("actuator"), abs=0.01 * 6 * kPa)


def test_a_closed_valve_leaves_the_pressure_that_the_amount_of_gas_has_at_rest():
    """Two actuators in one network; the first is closed off after a moment."""
    nodes = {"supply": tg.air.Supply(15 * kPa), "first": tg.air.Chamber(actuator(stiffness_damping=0.02).chamber()),
             "second": tg.air.Chamber(actuator().chamber())}  # fmt: skip
    parts = {
        "fill": tg.air.OnOffValve("supply", "first", VALVE, tg.air.Signal((0.0, 0.012), (1, 0))),
        "other": tg.air.Connection("supply", "second", tg.air.Restriction(conductance=0.005e-8)),
    }
    run = tg.air.simulate(tg.air.Network(nodes=nodes, parts=parts), 0.15, times=[0.0, 0.06, 0.15])
    assert run.balance() < 1e-12
    mass = run.mass("first")
    assert mass[1] == pytest.approx(mass[2], rel=1e-12)
    at_rest = tg.real_time.at_gas(moving(), {"cavity": mass[2] / mass[0]})
    assert run.pressure("first")[2] == pytest.approx(at_rest.inputs[0], rel=0.01)
    assert run.pressure("second")[2] > run.pressure("second")[1]


def test_what_cannot_be_followed_is_refused():
    with refused("motion"):
        tg.air.MovingActuator(replace(moving(), masses=None), tg.real_time.Moving())
    with refused("1", "0 to 0"):
        actuator().chamber(1)
    one = actuator()
    twice = {"supply": tg.air.Supply(5 * kPa), "a": tg.air.Chamber(one.chamber()), "b": tg.air.Chamber(one.chamber())}
    ways = {f"to {name}": tg.air.Connection("supply", name, VALVE) for name in ("a", "b")}
    with refused("[0, 0]", "1"):
        tg.air.Network(nodes=twice, parts=ways)
    with refused("actuator", "motion", "VolumeCurve"):
        tg.air.performance(tg.air.driven(actuator().chamber(), 15 * kPa, VALVE), 8 * kPa)
    with refused("actuator", "12 kPa", error=tg.TurgorError):
        tg.air.simulate(network(actuator().chamber(), 1.0), 0.2)


def test_a_file_names_the_step(tmp_path):
    moving().save(tmp_path / "finger")
    (tmp_path / "air.toml").write_text(
        """
        duration = "0.1 s"

        [nodes.supply]
        type = "supply"
        pressure = "10 kPa"

        [nodes.finger]
        type = "chamber"
        reduced = "finger.reduced"
        step = "2 ms"
        damping = "1 ms"

        [parts.valve]
        type = "restriction"
        from = "supply"
        to = "finger"
        conductance = "0.02 dm³/(s bar)"
        """,
        encoding="utf-8",
    )
    chamber = tg.air.read_air(tmp_path / "air.toml").network.nodes["finger"].volume
    assert chamber.actuator.moving == tg.real_time.Moving(step=2e-3, stiffness_damping=1e-3)
